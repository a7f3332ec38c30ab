# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""Where masses come from: shapes at numbers and arrays, their fitting, and the matching of sensor models."""
import copy
import math
import pickle
import unittest

import numpy as np

from credo import evidence
from credo.evidence import BinaryMass, Breakpoint, GridMass, PiecewiseBelief, RampBelief, batch

RAMP = RampBelief(max_yes=0.8, yes_full_until=0.1, yes_zero_from=0.3, max_no=0.6, no_zero_until=0.2, no_full_from=0.5)
SHAPE = PiecewiseBelief("alignment", "mean residual", "standard deviations",
                        [Breakpoint("good until", 1, yes=0.9), Breakpoint("doubtful", 2, 0.1, 0.2),
                         Breakpoint("bad from", 4, no=0.8)])


def labelled(count, seed):
    """x in [0, 1], and labels that are True with a probability of x."""
    random = np.random.default_rng(seed)
    x = random.random(count)
    return x, random.random(count) < x


class ShapesTest(unittest.TestCase):
    def test_arrays_are_what_their_numbers_are(self):
        x = np.array([[0.0, 0.15, 0.25], [0.4, 3.0, math.nan]])
        for shape in RAMP, SHAPE:
            masses = shape(x)
            self.assertEqual((masses.shape, masses.dtype), ((2, 3, 3), np.float64))
            for i in np.ndindex(x.shape):
                self.assertEqual(list(masses[i]), list(shape(x[i])))
            np.testing.assert_array_equal(shape(x.T), masses.transpose(1, 0, 2))
            np.testing.assert_array_equal(shape([1, 2]), shape(np.array([1.0, 2.0])))
            self.assertEqual(shape(np.empty((0, 4))).shape, (0, 4, 3))
            self.assertEqual(shape([0.2]).shape, (1, 3))
            self.assertEqual([shape(np.float32(2)), shape(np.array(2))], [shape(2.0)] * 2)

    def test_what_was_not_measured_says_nothing(self):
        self.assertEqual(SHAPE(math.nan), BinaryMass.vacuous())

    def test_masses_of_arrays_are_readings(self):
        distances = np.linspace(0.0, 0.6, 12).reshape(3, 4)
        masses, kept = batch.dempster(RAMP(distances), RAMP(distances))
        self.assertEqual(kept, 0)
        np.testing.assert_allclose(masses[1, 2], list(evidence.dempster([RAMP(distances[1, 2])] * 2).mass))

    def test_say_how_they_are_made(self):
        self.assertEqual(eval(repr(SHAPE)), SHAPE)
        self.assertEqual((SHAPE.name, SHAPE.quantity), ("alignment", "mean residual"))
        self.assertEqual(SHAPE.unit, "standard deviations")
        self.assertEqual([b.x for b in SHAPE.breakpoints], [1, 2, 4])
        self.assertEqual(PiecewiseBelief.from_text(SHAPE.to_text()), SHAPE)
        for value in SHAPE, SHAPE.breakpoints[0]:
            self.assertEqual(pickle.loads(pickle.dumps(value)), value)
            self.assertEqual(copy.copy(value), value)

    def test_ramps_are_a_kind_of_them(self):
        shape = evidence.piecewise(RAMP, "gap", "distance", "m")
        x = np.linspace(-0.1, 0.7, 33)
        np.testing.assert_allclose(shape(x), RAMP(x), atol=1e-12)
        self.assertIn("yes_full_until", " ".join(b.name for b in shape.breakpoints))

    def test_errors_say_what_was_found(self):
        for breakpoints, why in (([], "breakpoint"), ([Breakpoint("a", 1, 0.8, 0.3)], "a"),
                                 ([Breakpoint("a", 1), Breakpoint("b", 0)], "b")):
            with self.assertRaisesRegex(ValueError, why):
                PiecewiseBelief("name", "quantity", "1", breakpoints)
        with self.assertRaisesRegex(ValueError, "line 1"):
            PiecewiseBelief.from_text("nonsense")
        with self.assertRaises(TypeError):
            SHAPE("far")


class FittingTest(unittest.TestCase):
    def test_a_shape_follows_the_truth(self):
        fit = evidence.fit_shape(*labelled(5000, 1), "match", "score", "1")
        self.assertEqual((fit.direction, fit.samples, fit.ignored), ("rising", 5000, 0))
        for x in 0.1, 0.5, 0.9:
            mass = fit.shape(x)
            self.assertTrue(mass.belief() - 0.02 <= x <= mass.plausibility() + 0.02, (x, mass))
        judged = evidence.calibration_of(fit.shape, *labelled(5000, 2), bins=20)
        self.assertEqual((judged.samples, judged.bins), (5000, 20))
        self.assertLessEqual(judged.refuted, 0.1)
        self.assertLess(judged.calibration_error, 0.05)
        self.assertEqual(fit.held_out.samples, 2500)

    def test_the_direction_is_found_or_given(self):
        x, labels = labelled(200, 3)
        self.assertEqual(evidence.fit_shape(-x, labels, "match", "score", "1").direction, "falling")
        fit = evidence.fit_shape(x, labels, "match", "score", "1", breakpoints=4, direction="falling")
        self.assertEqual(fit.direction, "falling")
        self.assertLessEqual(len(fit.shape.breakpoints), 4)
        with self.assertRaisesRegex(ValueError, "'rising', 'falling'; got 'up'"):
            evidence.fit_shape(x, labels, "match", "score", "1", direction="up")

    def test_what_is_not_finite_is_counted(self):
        fit = evidence.fit_shape([1.0, math.nan, 2.0], [False, True, True], "match", "score", "1")
        self.assertEqual((fit.samples, fit.ignored), (2, 1))
        self.assertIsNone(evidence.fit_shape([1.0], [True], "match", "score", "1").held_out)

    def test_samples_are_checked(self):
        for x, labels, why in (([1.0, 2.0], [True], r"shape \(2,\); got bool of \(1,\)"), ([1.0], [1], "got int64"),
                               ([[1.0]], [True], "one dimension"), ([], [], "float64"),
                               ([math.inf], [True], "finite")):
            with self.assertRaisesRegex(ValueError, why):
                evidence.fit_shape(x, labels, "match", "score", "1")
            with self.assertRaisesRegex(ValueError, why):
                evidence.calibration_of(SHAPE, x, labels)
        for wrong in {"name": ""}, {"confidence": 1.0}, {"breakpoints": 0}:
            with self.assertRaises(ValueError):
                evidence.fit_shape([1.0], [True], **({"name": "match", "quantity": "score", "unit": "1"} | wrong))

    def test_predictive_beliefs_narrow_with_the_trials(self):
        self.assertEqual(evidence.predictive_belief(0, 0, 0.95), BinaryMass.vacuous())
        few, many = evidence.predictive_belief(7, 10, 0.95), evidence.predictive_belief(700, 1000, 0.95)
        self.assertTrue(few.belief() < many.belief() < 0.7 < many.plausibility() < few.plausibility())
        self.assertAlmostEqual(few.belief(), 0.3475, places=4)  # Clopper and Pearson
        with self.assertRaises(ValueError):
            evidence.predictive_belief(2, 1, 0.95)


class MatchingTest(unittest.TestCase):
    def test_probabilities_go_there_and_back(self):
        for matching in "pignistic", "plausibility":
            mass = BinaryMass(0.5, 0.2)
            probability = evidence.matched_probability(mass, matching)
            np.testing.assert_allclose(list(evidence.mass_with(probability, mass.unknown, matching)), list(mass))
            self.assertAlmostEqual(evidence.matched_log_odds(mass, matching),
                                   math.log(probability / (1 - probability)))
            least = evidence.most_unknown_with(probability, matching)
            self.assertAlmostEqual(least.unknown, evidence.largest_unknown_with(probability, matching))
            cell = evidence.grid_mass_with(0.7, 0.2, 0.1, matching)
            self.assertAlmostEqual(evidence.matched_probability(cell, matching), 0.7)
            self.assertAlmostEqual(cell.conflict, 0.1)
            self.assertAlmostEqual(evidence.most_unknown_grid_mass_with(0.5, 0.1, matching).unknown, 0.9)
        self.assertEqual(evidence.matched_probability(BinaryMass(0.5, 0.1), "pignistic"), 0.7)

    def test_errors_say_what_was_found(self):
        with self.assertRaisesRegex(ValueError, "'pignistic', 'plausibility'; got 'best'"):
            evidence.matched_probability(BinaryMass(), "best")
        with self.assertRaises(ValueError):
            evidence.mass_with(0.9, 0.5, "pignistic")
        with self.assertRaises(ValueError):
            evidence.matched_log_odds(GridMass(conflict=1.0), "pignistic")
        with self.assertRaises(TypeError):
            evidence.matched_probability(0.5, "pignistic")


if __name__ == "__main__":
    unittest.main()
