# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""What the Python API adds to evidence/: types of arguments and results, protocols, arrays, errors."""
import copy
import itertools
import math
import pickle
import unittest

import numpy as np

from credo import evidence
from credo.evidence import (BinaryMass, CanonicalDecomposition, FixedLogCommonality, Fold, Frame, GridMass,
                            LogCommonality, LogEvidence, MassFunction, OpenBinaryMass, OpenWorldMatcher, ProductFrame,
                            RampBelief, Refining)

ABC = Frame.shafer(["A", "B", "C"])
FREE = Frame.free_dsm(["A", "B", "C"])
HYBRID = Frame.hybrid(["A", "B", "C"], empty=["A ∩ B", "C"])
M1 = MassFunction(ABC, {"A": 0.6, "A ∪ B": 0.1, "Θ": 0.3})
M2 = MassFunction(ABC, {"B": 0.5, "B ∪ C": 0.2, "Θ": 0.3})


def random_masses(count, frame=ABC, seed=1):
    """Mass functions with every proposition focal, and so normal and not dogmatic."""
    random = np.random.default_rng(seed)
    propositions = frame.propositions()
    for _ in range(count):
        yield MassFunction(frame, zip(propositions, random.dirichlet(np.ones(len(propositions)))))


class FrameTest(unittest.TestCase):
    def test_says_how_it_is_made(self):
        for frame in ABC, FREE, HYBRID, Frame.hybrid(["A", "B"], ["A ∩ B"]):
            self.assertEqual(eval(repr(frame)), frame)
        self.assertEqual([ABC.model, FREE.model, HYBRID.model], ["shafer", "free", "hybrid"])
        self.assertEqual(HYBRID.empty, ["A ∩ B", "C"])
        self.assertEqual((len(ABC), ABC.names, ABC.index("B")), (3, ["A", "B", "C"], 1))

    def test_is_a_key(self):
        self.assertEqual(hash(Frame.shafer(["A", "B", "C"])), hash(ABC))
        self.assertEqual(len({ABC, FREE, HYBRID, Frame.free_dsm(["A", "B", "C"])}), 3)

    def test_errors_say_what_was_found(self):
        with self.assertRaisesRegex(ValueError, "no element 'D'; it has: A, B, C"):
            ABC["A ∪ D"]
        with self.assertRaisesRegex(ValueError, "given twice"):
            Frame.shafer(["A", "A"])
        with self.assertRaisesRegex(ValueError, "too many to list"):
            Frame.shafer([str(i) for i in range(30)]).propositions()
        with self.assertRaises(TypeError):
            Frame.shafer("AB")


class PropositionTest(unittest.TestCase):
    def test_has_the_algebra_of_sets(self):
        a, b, c = ABC.elements
        self.assertEqual(a | b, ABC["A ∪ B"])
        self.assertEqual((a | b) & (b | c), b)
        self.assertEqual((a | b) - b, a)
        self.assertEqual(~a, b | c)
        self.assertTrue(a <= (a | b) and (a | b) >= a and not (a | b) <= a and not a >= (a | b))
        self.assertTrue(a and not a & b)
        self.assertTrue((a | b).meets(b | c) and not a.meets(b))
        self.assertEqual(((a | c).regions, (a | c).cardinality, ABC.from_regions([0, 2])), ([0, 2], 2, a | c))

    def test_equal_ones_are_one_key(self):
        self.assertEqual({ABC["A ∪ B"]: 1}[ABC["B | A"]], 1)
        self.assertEqual(HYBRID["A ∩ B"], HYBRID["∅"])
        self.assertEqual(hash(HYBRID["A ∩ B"]), hash(HYBRID["∅"]))
        self.assertNotEqual(ABC["A"], FREE["A"])
        self.assertNotEqual(ABC["A"], "A")

    def test_of_another_frame_is_refused(self):
        other = Frame.shafer(["A", "B"])
        for use in (lambda: ABC["A"] | other["A"], lambda: M1.belief(other["A"]), lambda: ABC["A"] <= other["A"],
                    lambda: MassFunction(ABC, {other["A"]: 1.0})):
            with self.assertRaisesRegex(ValueError, "'A' is of another frame"):
                use()

    def test_complements_need_elements_that_exclude_each_other(self):
        with self.assertRaises(ValueError):
            ~FREE["A"]

    def test_is_an_index_beyond_64_elements_too(self):
        frame = Frame.shafer([f"e{i}" for i in range(100)])
        self.assertEqual(frame["e3 ∪ e99"].__index__(), 2**3 + 2**99)


class MassFunctionTest(unittest.TestCase):
    def test_reads_as_a_mapping(self):
        self.assertEqual((M1["A"], M1[ABC["A ∪ B"]], M1["C"], len(M1)), (0.6, 0.1, 0.0, 3))
        self.assertEqual(dict(M1), {ABC["A"]: 0.6, ABC["A ∪ B"]: 0.1, ABC["Θ"]: 0.3})
        self.assertEqual(list(M1), M1.keys())
        self.assertEqual(list(zip(M1.keys(), M1.values())), M1.items())
        self.assertTrue("A" in M1 and "C" not in M1)
        self.assertEqual(repr(M1), "MassFunction({'A': 0.6, 'A ∪ B': 0.1, 'Θ': 0.3})")
        self.assertEqual(str(M1), "{A: 0.6, A ∪ B: 0.1, Θ: 0.3}")

    def test_is_made_of_mappings_and_of_pairs(self):
        self.assertEqual(MassFunction(ABC, {ABC["A"]: 0.6, "B | A": 0.1, "Θ": 0.3}), M1)
        self.assertEqual(MassFunction(ABC, iter([("A", 0.5), ("A", 0.1), ("A ∪ B", 0.1), ("Θ", 0.3)])), M1)
        self.assertEqual(MassFunction(ABC, M1), M1)
        self.assertEqual(MassFunction.with_rest_unknown(ABC, {"A": 0.25, "B": 0.25})["Θ"], 0.5)

    def test_has_its_special_kinds(self):
        self.assertTrue(MassFunction.vacuous(ABC).is_vacuous)
        self.assertTrue(MassFunction.categorical(ABC, "A").is_categorical)
        self.assertEqual(MassFunction.simple_support(ABC, "A", 0.75)["Θ"], 0.25)
        self.assertTrue(MassFunction.bayesian(ABC, np.array([0.5, 0.25, 0.25])).is_bayesian)
        self.assertTrue(MassFunction.bayesian(ABC, [1, 0, 0]).is_dogmatic)
        consonant = MassFunction.consonant(ABC, np.array([1.0, 0.5, 0.25]))
        self.assertTrue(consonant.is_consonant and consonant.is_normal)
        self.assertEqual([consonant.plausibility(e) for e in ABC.elements], [1.0, 0.5, 0.25])

    def test_what_constraints_empty_counts_as_the_empty_set(self):
        mass = MassFunction(HYBRID, [("A ∩ B", 0.25), ("C", 0.25), ("A", 0.5)])
        self.assertEqual(mass.items(), [(HYBRID["A"], 0.5), (HYBRID["∅"], 0.5)] if mass.keys()[0] else
                         [(HYBRID["∅"], 0.5), (HYBRID["A"], 0.5)])
        self.assertEqual((mass["∅"], mass.conflict, sum(dict(mass).values()), len(mass.focals)), (0.5, 0.5, 1.0, 3))

    def test_errors_say_what_was_found(self):
        for masses, why in (({"A": 0.5}, "sum to 0.5"), ({"A": math.nan}, r"m\(A\) = nan"),
                            ({"A": 1.5, "B": -0.5}, "must be in"), ({"D": 1.0}, "no element 'D'")):
            with self.assertRaisesRegex(ValueError, why):
                MassFunction(ABC, masses)
        for wrong in {"A": "much"}, [0.5], 7, {3: 1.0}:
            with self.assertRaises(TypeError):
                MassFunction(ABC, wrong)
        with self.assertRaisesRegex(ValueError, "one dimension; got 2"):
            MassFunction.bayesian(ABC, np.ones((3, 1)) / 3)

    def test_belief_is_below_pignistic_is_below_plausibility(self):
        for mass in random_masses(20):
            for each in ABC.propositions():
                self.assertLessEqual(mass.belief(each), mass.pignistic(each) + 1e-12)
                self.assertLessEqual(mass.pignistic(each), mass.plausibility(each) + 1e-12)
                self.assertAlmostEqual(mass.plausibility(each), 1.0 - mass.belief(~each))

    def test_probabilities_are_arrays(self):
        np.testing.assert_allclose(M1.pignistic_regions(), [0.75, 0.15, 0.1])
        np.testing.assert_allclose(M1.plausibility_transform(), np.array([1.0, 0.4, 0.3]) / 1.7)
        np.testing.assert_allclose(M1.dsmp_regions(0.1).sum(), 1.0)
        with self.assertRaises(ValueError):  # a domain error of the library
            MassFunction.categorical(ABC, "∅").pignistic("A")

    def test_decides(self):
        decision = M1.decide()
        self.assertEqual((decision.choice, decision.rejected), (ABC["A"], False))
        self.assertAlmostEqual(decision.margin, 0.6)
        self.assertTrue(M1.decide(min_margin=0.7).rejected)
        self.assertEqual(M1.decide(["B", "B ∪ C"], criterion="plausibility").choice, ABC["B"])
        with self.assertRaisesRegex(ValueError, "'belief', 'plausibility', 'pignistic'; got 'best'"):
            M1.decide(criterion="best")

    def test_is_discounted(self):
        self.assertEqual(M1.discount(0.5), MassFunction(ABC, {"A": 0.3, "A ∪ B": 0.05, "Θ": 0.65}))
        self.assertEqual(M1.contextual_discount([1.0, 1.0, 1.0]), M1)
        self.assertEqual(M1.decay(2.0, half_life=2.0), M1.discount(0.5))
        self.assertEqual(evidence.reliability_after(math.inf, 1.0), 0.0)
        with self.assertRaises(ValueError):
            M1.discount(1.5)


class PickleTest(unittest.TestCase):
    def test_values_come_back_equal(self):
        values = [ABC, FREE, HYBRID, FREE["A ∩ B"], M1, evidence.dempster(M1, M2).mass, evidence.conjunctive(M1, M2).mass,
                  MassFunction(HYBRID, {"A ∩ B": 0.3, "A": 0.7}), BinaryMass(0.1, 0.2), GridMass(0.1, 0.2, 0.3),
                  OpenBinaryMass(0.1, 0.2, 0.3), LogEvidence(0.1, 0.2),
                  LogCommonality(-0.1, -0.2, -0.3), FixedLogCommonality(-1, -2, -3), RampBelief(max_yes=0.5),
                  *(evidence.pcr6(a, b).mass for a, b in zip(random_masses(20, FREE), random_masses(20, FREE, 2)))]
        for value in values:
            for again in pickle.loads(pickle.dumps(value)), copy.copy(value), copy.deepcopy(value):
                self.assertEqual(again, value)
                self.assertEqual(repr(again), repr(value))

    def test_forms_that_constraints_empty_are_kept(self):
        mass = MassFunction(HYBRID, {"A ∩ B": 0.3, "C": 0.2, "A": 0.5})
        other = MassFunction.categorical(HYBRID, "B")
        again = pickle.loads(pickle.dumps(mass))
        self.assertEqual(evidence.dsmh(again, other).mass, evidence.dsmh(mass, other).mass)


class DenseTest(unittest.TestCase):
    def test_entries_are_found_by_proposition(self):
        dense = M1.to_dense()
        self.assertEqual((dense.shape, dense.dtype), ((8,), np.float64))
        for proposition, mass in M1.items():
            self.assertEqual(dense[proposition], mass)
        self.assertEqual(MassFunction.from_dense(ABC, dense), M1)

    def test_transforms_make_new_arrays_and_invert_each_other(self):
        dense = M1.to_dense()
        for there, back, measure in ((evidence.mass_to_commonality, evidence.commonality_to_mass, M1.commonality),
                                     (evidence.mass_to_implicability, evidence.implicability_to_mass,
                                      M1.implicability)):
            values = there(dense)
            self.assertIsNot(values, dense)
            np.testing.assert_array_equal(dense, M1.to_dense())
            for proposition in ABC.propositions():
                self.assertAlmostEqual(values[proposition], measure(proposition))
            np.testing.assert_allclose(back(values), dense, atol=1e-15)

    def test_commonalities_make_mass_functions_or_none(self):
        product = evidence.mass_to_commonality(M1.to_dense()) * evidence.mass_to_commonality(M2.to_dense())
        self.assertLess(evidence.jousselme_distance(MassFunction.from_commonality(ABC, product),
                                                    evidence.conjunctive(M1, M2).mass), 1e-7)
        self.assertIsNone(MassFunction.from_commonality(ABC, product[::-1]))

    def test_shapes_are_checked(self):
        for wrong in np.ones(3), np.ones((2, 2)), []:
            with self.assertRaises(ValueError):
                evidence.mass_to_commonality(wrong)
        with self.assertRaises(ValueError):
            MassFunction.from_dense(ABC, np.ones(4) / 4)
        with self.assertRaises(ValueError):
            CanonicalDecomposition(ABC, np.zeros(4))

    def test_decomposition_is_recomposed(self):
        weights = M1.decompose().log_weights
        self.assertEqual(weights.shape, (8,))
        for proposition, mass in CanonicalDecomposition(ABC, weights).recompose().items():
            self.assertAlmostEqual(mass, M1[proposition])
        with self.assertRaisesRegex(ValueError, "dogmatic"):
            MassFunction.categorical(ABC, "A").decompose()


class RulesTest(unittest.TestCase):
    def test_take_sources_one_by_one_or_as_any_iterable(self):
        expected = evidence.dempster(M1, M2)
        for fused in evidence.dempster([M1, M2]), evidence.dempster(m for m in (M1, M2)), \
                evidence.rules()["dempster"](M1, M2):
            self.assertEqual((fused.mass, fused.conflict), (expected.mass, expected.conflict))
        mass, conflict = expected
        self.assertAlmostEqual(conflict, 0.6 * 0.7)
        self.assertEqual(evidence.dempster(M1).mass, M1)

    def test_are_all_there_with_their_laws(self):
        for name, rule in evidence.rules().items():
            self.assertEqual(name, rule.name)
            sources = [m.discount(0.5) for m in random_masses(3)]
            if name == "bold":
                sources = [evidence.conjunctive(m, M1, M2).mass for m in sources]
            fused = getattr(evidence, name)(sources)
            self.assertAlmostEqual(sum(fused.mass.values()), 1.0)
            if rule.laws.commutative:
                turned = rule(reversed(sources))
                self.assertLess(evidence.jousselme_distance(fused.mass, turned.mass), 1e-7)
            in_order = evidence.fold_in_order(name, sources)
            self.assertEqual(rule.laws.associative,
                             evidence.jousselme_distance(fused.mass, in_order.mass) < 1e-7, name)

    def test_total_conflict_is_none_where_there_is_no_result(self):
        a, b = MassFunction.categorical(ABC, "A"), MassFunction.categorical(ABC, "B")
        self.assertIsNone(evidence.dempster(a, b))
        self.assertEqual(evidence.conjunctive(a, b).conflict, 1.0)
        self.assertTrue(evidence.yager(a, b).mass.is_vacuous)
        self.assertIsNone(a.condition("B"))
        self.assertIsNone(evidence.conjunctive(a, b).mass.normalised())
        self.assertEqual(evidence.conflict_between(a, b), 1.0)

    def test_refuse_what_is_no_source(self):
        with self.assertRaisesRegex(ValueError, "at least one"):
            evidence.pcr5()
        with self.assertRaisesRegex(ValueError, "different frames"):
            evidence.pcr5(M1, MassFunction.vacuous(FREE))
        for wrong in ((M1, "A"), (M1, BinaryMass(0.5)), (BinaryMass(0.5), M1), (7,), ([M1], [M2])):
            with self.assertRaises(TypeError):
                evidence.dempster(*wrong)

    def test_folds_are_of_associative_rules_only(self):
        fold = Fold("dempster", M1)
        self.assertTrue(fold.add(M2))
        self.assertEqual((fold.mass, fold.rule), (evidence.dempster(M1, M2).mass, "dempster"))
        certain = Fold("dempster", MassFunction.categorical(ABC, "A"))
        self.assertFalse(certain.add(MassFunction.categorical(ABC, "B")))
        self.assertEqual(certain.mass, MassFunction.categorical(ABC, "A"))
        for name, rule in evidence.rules().items():
            if not rule.laws.associative:
                with self.assertRaisesRegex(TypeError, name):
                    Fold(name, M1)
        with self.assertRaisesRegex(ValueError, "no rule 'best'"):
            Fold("best", M1)

    def test_averages_are_weighted_on_request(self):
        self.assertAlmostEqual(evidence.average(M1, M2).mass["A"], 0.3)
        self.assertAlmostEqual(evidence.average(M1, M2, weights=[3, 1]).mass["A"], 0.45)
        for wrong in [], [1], [-1, 2]:
            with self.assertRaises(ValueError):
                evidence.average(M1, M2, weights=wrong)

    def test_evidence_is_taken_out_again(self):
        whole = evidence.conjunctive(M1, M2).mass
        for proposition, mass in evidence.decombine(whole, M2).items():
            self.assertAlmostEqual(mass, M1[proposition])

    def test_distance_is_a_metric(self):
        for a, b in zip(random_masses(10), random_masses(10, seed=2)):
            self.assertEqual(evidence.jousselme_distance(a, a), 0.0)
            self.assertAlmostEqual(evidence.jousselme_distance(a, b), evidence.jousselme_distance(b, a))


class RefinementTest(unittest.TestCase):
    coarse = Frame.shafer(["wet", "dry"])
    fine = Frame.shafer(["rain", "snow", "sun"])
    refining = Refining(coarse, fine, {"dry": "sun", "wet": fine["rain ∪ snow"]})

    def test_coarsening_undoes_refining(self):
        mass = MassFunction.simple_support(self.coarse, "wet", 0.75)
        self.assertEqual(self.refining.refine(mass)["rain ∪ snow"], 0.75)
        self.assertEqual(self.refining.coarsen(self.refining.refine(mass)), mass)
        self.assertEqual(self.refining.refine_set("dry"), self.fine["sun"])
        self.assertEqual(self.refining.coarsen_set("rain"), self.coarse["wet"])
        self.assertEqual(self.refining.coarsen_set_inner("rain ∪ sun"), self.coarse["dry"])
        self.assertEqual(self.refining.coarsen_inner(MassFunction.categorical(self.fine, "rain")).conflict, 1.0)

    def test_images_are_checked(self):
        for images, why in (({"wet": "rain"}, "empty"), ({"wet": "rain", "dry": "sun"}, "snow"),
                            ({"damp": "rain"}, "'damp'")):
            with self.assertRaisesRegex(ValueError, why):
                Refining(self.coarse, self.fine, images)

    def test_products_extend_and_give_marginals(self):
        product = ProductFrame([self.coarse, Frame.shafer(["cold", "warm"])])
        self.assertEqual(product.frame.names, ["wet × cold", "wet × warm", "dry × cold", "dry × warm"])
        mass = MassFunction.simple_support(self.coarse, "wet", 0.75)
        self.assertEqual(product.marginal(product.extend(mass, 0), 0), mass)
        self.assertTrue(product.marginal(product.extend(mass, 0), 1).is_vacuous)
        self.assertEqual((len(product), product.factor(1).coarse.names), (2, ["cold", "warm"]))
        for use in product.factor, lambda i: product.extend(mass, i), lambda i: product.marginal(mass, i):
            with self.assertRaisesRegex(IndexError, "2 factors"):
                use(2)


class OpenWorldTest(unittest.TestCase):
    triplets = np.array([[0.8, 0.1, 0.1], [0.1, 0.7, 0.2], [0.0, 0.5, 0.5]])

    def test_takes_and_gives_arrays(self):
        matcher = OpenWorldMatcher(self.triplets)
        masses = matcher.normalised()
        self.assertEqual(masses.match.shape, (3,))
        self.assertAlmostEqual(masses.match.sum() + masses.none + masses.unknown, 1.0)
        self.assertAlmostEqual(matcher.pignistic().match.sum() + matcher.pignistic().none, 1.0)
        self.assertTrue(np.all(matcher.plausibility().match >= masses.match))
        decision = matcher.decide_by_mass()
        self.assertEqual((decision.kind, decision.candidate), ("matched", 0))
        self.assertEqual(matcher.decide_by_pignistic(min_margin=0.9).kind, "undecided")
        np.testing.assert_allclose(evidence.assignment_weight(self.triplets),
                                   np.log((1 - self.triplets[:, 1]) / (1 - self.triplets[:, 0])))

    def test_without_candidates_nothing_matches(self):
        for empty in [], np.empty((0, 3)):
            self.assertEqual(OpenWorldMatcher(empty).open().none, 1.0)
            self.assertEqual(OpenWorldMatcher(empty).decide_by_pignistic().kind, "none")

    def test_total_conflict_is_none(self):
        matcher = OpenWorldMatcher([[1, 0, 0], [1, 0, 0]])
        self.assertTrue(matcher.total_conflict)
        self.assertEqual([matcher.normalised(), matcher.plausibility(), matcher.pignistic()], [None] * 3)
        self.assertEqual(matcher.decide_by_pignistic().kind, "undecided")

    def test_rows_are_checked(self):
        for wrong in ([0.5, 0.5, 0.0], [[0.5, 0.5]], [[0.5, 0.6, 0.0]], [[math.nan, 0.0, 1.0]], [[-0.1, 0.1, 1.0]]):
            with self.assertRaises(ValueError):
                OpenWorldMatcher(wrong)


class RelationTest(unittest.TestCase):
    def test_is_the_most_plausible_of_all(self):
        random = np.random.default_rng(1)
        for _ in range(20):
            triplets = random.dirichlet(np.ones(3), (3, 4))
            best = max(self.log_plausibility(triplets, columns)
                       for columns in itertools.product([None, 0, 1, 2, 3], repeat=3)
                       if len({c for c in columns if c is not None}) == sum(c is not None for c in columns))
            relation = evidence.most_plausible_relation(triplets)
            self.assertAlmostEqual(relation.log_plausibility, best)
            self.assertAlmostEqual(self.log_plausibility(triplets, relation.column_of_row), best)

    @staticmethod
    def log_plausibility(triplets, columns):
        return sum(math.log(1 - (no if columns[row] == column else yes))
                   for row, pairs in enumerate(triplets) for column, (yes, no, _) in enumerate(pairs))

    def test_rows_may_stay_alone(self):
        self.assertEqual(evidence.most_plausible_relation([[[0.1, 0.8, 0.1]]]).column_of_row, [None])
        self.assertEqual(evidence.most_plausible_relation(np.empty((2, 0, 3))).column_of_row, [None, None])
        self.assertEqual(evidence.most_plausible_relation(np.empty((0, 2, 3))).column_of_row, [])

    def test_total_conflict_is_none(self):
        self.assertIsNone(evidence.most_plausible_relation([[[1, 0, 0], [1, 0, 0]]]))

    def test_evidence_is_checked(self):
        for wrong, why in (([[0.5, 0.5, 0.0]], r"\(rows, columns, 3\).* got \(1, 3\)"),
                           ([[[0.5, 0.5]]], "rows, columns"),
                           ([[[0.8, 0.1, 0.1], [0.5, 0.6, 0.0]]], "mass 1 of the evidence")):
            with self.assertRaisesRegex(ValueError, why):
                evidence.most_plausible_relation(wrong)


if __name__ == "__main__":
    unittest.main()
