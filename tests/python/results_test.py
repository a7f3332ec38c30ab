# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""What rules and decisions give is a value: it compares, copies, pickles, and so comes back from other processes."""
import copy
import inspect
import multiprocessing
import pickle
import unittest

from credo import evidence
from credo.evidence import BinaryMass, CanonicalDecomposition, Frame, GridMass, MassFunction

ABC = Frame.shafer(["A", "B", "C"])
HYBRID = Frame.hybrid(["A", "B", "C"], empty=["A ∩ B", "C"])
M1 = MassFunction(ABC, {"A": 0.6, "A ∪ B": 0.1, "Θ": 0.3})
M2 = MassFunction(ABC, {"B": 0.5, "B ∪ C": 0.2, "Θ": 0.3})
YES, NO = BinaryMass(0.6, 0.1), BinaryMass(0.2, 0.5)
OCCUPIED, EMPTY = GridMass(occupied=0.7), GridMass(empty=0.5, occupied=0.1)


def results():
    """Made anew at each call; no two are equal."""
    return [evidence.dempster(M1, M2), evidence.pcr6(M1, M2), evidence.conjunctive(M1, M2), M1.normalised(),
            evidence.dsmh(MassFunction(HYBRID, {"A ∩ B": 0.3, "A": 0.7}), MassFunction.categorical(HYBRID, "B")),
            evidence.dempster(YES, NO), evidence.pcr5(YES, NO), evidence.conjunctive(YES, NO),
            evidence.dempster(OCCUPIED, EMPTY), evidence.yager(OCCUPIED, EMPTY),
            M1.decide(), M1.decide(min_margin=0.9), M1.decide(criterion="belief"), M2.decide(), M1.decompose(),
            M2.decompose(), *evidence.rules().values()]


def fused(masses):
    return evidence.dempster(masses)


class ResultsTest(unittest.TestCase):
    def test_equal_ones_are_equal_and_others_are_not(self):
        for i, a in enumerate(results()):
            for k, b in enumerate(results()):
                self.assertEqual(a == b, i == k, (a, b))
            self.assertNotEqual(a, "A")

    def test_same_mass_met_in_another_conflict_is_another_result(self):
        half = MassFunction.categorical(ABC, "A"), MassFunction(ABC, {"A": 0.5, "B": 0.5})
        with_conflict, without = evidence.dempster(half), evidence.dempster(half[0])
        self.assertEqual(with_conflict.mass, without.mass)
        self.assertNotEqual(with_conflict, without)

    def test_come_back_equal_from_pickle_and_copy(self):
        for result in results():
            for again in pickle.loads(pickle.dumps(result)), copy.copy(result), copy.deepcopy(result):
                self.assertEqual(again, result)
                self.assertEqual(repr(again), repr(result))

    def test_every_type_that_compares_pickles(self):
        types = [there for there in vars(evidence).values() if inspect.isclass(there)]
        compared = {there.__name__ for there in types if "__eq__" in vars(there)}
        self.assertEqual(compared, {there.__name__ for there in types if "__setstate__" in vars(there)})
        self.assertLessEqual({type(result).__name__ for result in results()}, compared)

    def test_what_is_unpickled_is_checked(self):
        make, arguments, state = M1.decompose().__reduce_ex__(2)[:3]
        with self.assertRaisesRegex(ValueError, "one weight for each"):
            make(*arguments).__setstate__((state[0], state[1][1:]))
        self.assertEqual(CanonicalDecomposition(*state), M1.decompose())

    def test_come_back_from_other_processes(self):
        pairs = [(M1, M2), (YES, NO), (OCCUPIED, EMPTY),
                 (MassFunction.categorical(ABC, "A"), MassFunction.categorical(ABC, "B"))]
        expected = [evidence.dempster(pair) for pair in pairs]
        self.assertIsNone(expected[-1])
        with multiprocessing.get_context("fork").Pool(2) as pool:
            self.assertEqual(pool.map(fused, pairs), expected)
            self.assertEqual(pool.map(evidence.rules()["dempster"], pairs), expected)


if __name__ == "__main__":
    unittest.main()
