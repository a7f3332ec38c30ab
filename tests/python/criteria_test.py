# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""Beliefs that rest on several criteria: matches, tracks, wholes of parts, kinds."""
import math
import unittest

import numpy as np

from credo import evidence
from credo.evidence import BinaryMass, FourKindMass, OpenBinaryMass

YES, NO = BinaryMass(yes=1.0), BinaryMass(no=1.0)


class GatedMatchTest(unittest.TestCase):
    def test_needs_little_conflict_and_more_yes_than_no(self):
        a, b = BinaryMass(0.6, 0.1), BinaryMass(0.5, 0.2)
        mass, match = evidence.gated_match(a, b)
        self.assertTrue(match)
        self.assertEqual(mass, evidence.conjunctive(a, b))
        self.assertIsInstance(mass, OpenBinaryMass)
        self.assertFalse(evidence.gated_match([a, b], max_conflict=0.1).match)
        self.assertFalse(evidence.gated_match(BinaryMass(0.2, 0.3)).match)
        self.assertFalse(evidence.gated_match().match)
        with self.assertRaises(TypeError):
            evidence.gated_match(0.5)


class TrackTest(unittest.TestCase):
    def test_lives_as_its_rule_says(self):
        observation = BinaryMass(0.7, 0.1)
        track = evidence.start_track(observation, match_yes=0.6)
        sources = [evidence.discount_by_own_denial(observation), evidence.match_support(0.6)]
        self.assertEqual([track.mass, track.conflict], list(evidence.yager(sources)))
        track = evidence.update_track(track.mass, observation, 0.6, rule="dempster")
        self.assertTrue(track.keep)
        np.testing.assert_allclose(list(track.mass), list(evidence.dempster(
            evidence.start_track(observation, 0.6).mass, *sources).mass), atol=1e-12)
        missed = evidence.miss_track(track.mass)
        self.assertEqual(missed.mass, evidence.yager(track.mass, BinaryMass(no=0.2)).mass)
        self.assertFalse(evidence.miss_track(track.mass, miss=BinaryMass(no=0.99)).keep)

    def test_total_conflict_is_none_under_dempsters_rule(self):
        self.assertIsNone(evidence.miss_track(YES, miss=NO, rule="dempster"))
        self.assertIsNone(evidence.update_track(NO, YES, 1.0, rule="dempster"))
        self.assertTrue(evidence.miss_track(YES, miss=NO).keep)

    def test_errors_say_what_was_found(self):
        for wrong in -0.1, 1.5, math.nan:
            for use in (lambda: evidence.match_support(wrong), lambda: evidence.start_track(YES, wrong),
                        lambda: evidence.update_track(YES, YES, wrong)):
                with self.assertRaisesRegex(ValueError, r"match_yes must be in \[0, 1\]"):
                    use()
        with self.assertRaisesRegex(ValueError, "'dempster', 'yager'; got 'pcr6'"):
            evidence.start_track(YES, 0.5, rule="pcr6")


class WholeTest(unittest.TestCase):
    criteria = [BinaryMass(0.5, 0.1)]
    parts = [(BinaryMass(0.8, 0.1), 0.5), (BinaryMass(0.2, 0.6), 1.0)]

    def test_rests_on_its_discounted_parts(self):
        discounted = [mass.discount(reliability) for mass, reliability in self.parts]
        for rule in "dempster", "yager":
            whole = evidence.whole_from_all_parts(self.criteria, self.parts, rule)
            self.assertEqual(list(whole), list(evidence.rules()[rule](self.criteria + discounted)))
        mean = evidence.mean_part(self.parts)
        np.testing.assert_allclose(list(mean), list(evidence.average(discounted).mass))
        self.assertEqual(list(evidence.whole_from_mean_part(self.criteria, self.parts)),
                         list(evidence.yager(self.criteria + [mean])))
        self.assertEqual(evidence.mean_part([]), BinaryMass.vacuous())
        self.assertIsNone(evidence.whole_from_all_parts([YES], [(NO, 1.0)], "dempster"))
        with self.assertRaisesRegex(ValueError, "reliability"):
            evidence.mean_part([(YES, 1.5)])

    def test_two_parts_and_a_kind_are_combined_in_two_steps(self):
        a, b, kind = BinaryMass(0.5, 0.1), BinaryMass(0.4, 0.3), BinaryMass(0.6, 0.2)
        joint = evidence.joint_existence(a, b, kind, "yager")
        self.assertEqual(joint.mass, evidence.yager(evidence.yager(a, b).mass, kind).mass)
        self.assertIsNone(evidence.joint_existence(YES, NO, kind, "dempster"))


class FourKindsTest(unittest.TestCase):
    def test_criteria_tell_the_kinds_apart(self):
        for deviation, gap, kind in (-90, 0, 0), (90, 0, 1), (0, 0, 2), (0, 1, 3):
            which, whether = evidence.which_kind(deviation), evidence.whether_regular(gap)
            mass = FourKindMass(which, whether)
            self.assertEqual(mass.most_believed(), kind)
            self.assertAlmostEqual(sum(mass.one) + sum(mass.one_or_other) + mass.other + mass.regular + mass.unknown, 1)
            self.assertAlmostEqual(sum(which.one_or_other) + which.unknown, 1)
            self.assertAlmostEqual(whether.regular + whether.other + whether.unknown, 1)
            beliefs = [mass.belief_in_kind(k) for k in range(4)]
            self.assertEqual(max(range(4), key=lambda k: beliefs[k].belief()), kind)
        self.assertEqual(evidence.which_kind(90, committed=0.5).one_or_other, [0, 0.5, 0])
        self.assertEqual((evidence.which_kind(math.nan).unknown, evidence.whether_regular(math.nan).unknown), (1, 1))
        self.assertEqual(evidence.whether_regular(2, regular_until=3, other_from=4).other, 0)

    def test_errors_say_what_was_found(self):
        mass = FourKindMass(evidence.which_kind(0), evidence.whether_regular(0))
        for use, why in ((lambda: mass.belief_in_kind(4), "got 4"), (lambda: mass.belief_in_kind(-1), "got -1"),
                         (lambda: evidence.which_kind(0, level_until=math.nan), "level_until"),
                         (lambda: evidence.whether_regular(0, other_from=math.inf), "other_from"),
                         (lambda: evidence.which_kind(0, committed=1.5), "committed"),
                         (lambda: evidence.whether_regular(0, committed=math.nan), "committed")):
            with self.assertRaisesRegex(ValueError, why):
                use()


if __name__ == "__main__":
    unittest.main()
