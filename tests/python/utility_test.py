# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""Expectations and acts, the generalized Bayesian theorem and summarization, as Python calls them."""
import copy
import math
import pickle
import unittest

import numpy as np

from credo import evidence
from credo.evidence import Frame, MassFunction

ABC = Frame.shafer(["A", "B", "C"])
FREE = Frame.free_dsm(["A", "B", "C"])
MASS = MassFunction(ABC, {"A": 0.5, "B ∪ C": 0.25, "Θ": 0.25})
VALUES = np.array([1.0, 2.0, 6.0])
UTILITIES = np.array([[1.0, 2.0, 6.0], [2.0, 2.0, 2.0], [0.5, 0.5, 1.0]])
EXPECTATIONS = MassFunction.lower_expectation, MassFunction.pignistic_expectation, MassFunction.upper_expectation


class UtilityTest(unittest.TestCase):
    def test_expectations_are_those_of_the_worst_the_middle_and_the_best(self):
        self.assertEqual([expected(MASS, VALUES) for expected in EXPECTATIONS], [1.25, 2.25, 3.5])
        self.assertEqual(MASS.lower_expectation([1, 2, 6]), 1.25)
        self.assertEqual(MASS.pignistic_expectation(VALUES), MASS.pignistic_regions() @ VALUES)

    def test_acts_are_rows(self):
        self.assertEqual(MASS.best_act(UTILITIES, pessimism=1.0).choice, 1)
        self.assertEqual(MASS.best_act(UTILITIES, pessimism=0.0).choice, 0)
        self.assertEqual(MASS.undominated_acts(UTILITIES), [0, 1])
        best = MASS.best_act_pignistic(UTILITIES)
        self.assertEqual((best.choice, best.value, best.margin), (0, 2.25, 0.25))
        self.assertEqual(MASS.best_act_pignistic(UTILITIES[:1]).margin, math.inf)

    def test_arrays_are_read_by_index_whatever_their_layout(self):
        for same in np.asfortranarray(UTILITIES), np.repeat(UTILITIES, 2, axis=1)[:, ::2], UTILITIES.tolist():
            self.assertEqual(MASS.best_act(same, 0.5), MASS.best_act(UTILITIES, 0.5))

    def test_decisions_are_values(self):
        best = MASS.best_act(UTILITIES, 1.0)
        for again in pickle.loads(pickle.dumps(best)), copy.deepcopy(best):
            self.assertEqual((again, repr(again)), (best, "ActDecision(choice=1, value=2.0, margin=0.75)"))
        self.assertNotEqual(best, MASS.best_act(UTILITIES, 0.0))

    def test_errors_say_what_was_found(self):
        for wrong in VALUES, UTILITIES.reshape(1, 9), UTILITIES[np.newaxis]:
            for use in MASS.best_act_pignistic, MASS.undominated_acts, lambda u: MASS.best_act(u, 1.0):
                with self.assertRaisesRegex(ValueError, r"the shape \(acts, 3\); got \("):
                    use(wrong)
        with self.assertRaisesRegex(ValueError, "one utility for each"):
            MASS.best_act_pignistic(np.empty((0, 3)))
        with self.assertRaisesRegex(ValueError, r"pessimism must be in \[0, 1\]; got nan"):
            MASS.best_act(UTILITIES, math.nan)
        for mass, values, why in ((MASS, VALUES[:2], "got 2"), (MASS, [1, 2, math.inf], "finite"),
                                  (MASS, UTILITIES, "one dimension; got 2"),
                                  (MassFunction.vacuous(FREE), VALUES, "Shafer"),
                                  (MassFunction.categorical(ABC, "∅"), VALUES, "total conflict")):
            for expected in EXPECTATIONS:
                with self.assertRaisesRegex(ValueError, why):
                    expected(mass, values)


class GeneralizedBayesTest(unittest.TestCase):
    def test_with_a_prior_it_is_bayes_theorem(self):
        prior, likelihoods = np.array([0.5, 0.3, 0.2]), np.array([0.1, 0.8, 0.4])
        said = MassFunction.generalized_bayes(ABC, likelihoods)
        posterior = evidence.dempster(MassFunction.bayesian(ABC, prior), said).mass
        np.testing.assert_allclose(posterior.pignistic_regions(), prior * likelihoods / (prior @ likelihoods))
        self.assertAlmostEqual(said.conflict, 0.9 * 0.2 * 0.6)

    def test_errors_say_what_was_found(self):
        for frame, wrong in (ABC, [0.1, 0.2]), (ABC, [0.1, 0.2, 1.1]), (ABC, [0.1, 0.2, math.nan]), (FREE, [1, 1, 1]):
            with self.assertRaises(ValueError):
                MassFunction.generalized_bayes(frame, wrong)
        with self.assertRaisesRegex(ValueError, "plausibilities must have one dimension; got 2"):
            MassFunction.generalized_bayes(ABC, np.ones((1, 3)))


class SummarizationTest(unittest.TestCase):
    def test_the_largest_masses_stay_the_others_go_to_their_union(self):
        mass = MassFunction(ABC, {"A": 0.6, "B": 0.25, "C": 0.15})
        self.assertEqual(mass.summarized(2), MassFunction(ABC, {"A": 0.6, "B ∪ C": 0.4}))
        self.assertEqual(mass.summarized(3), mass)
        with self.assertRaises(ValueError):
            mass.summarized(0)


if __name__ == "__main__":
    unittest.main()
