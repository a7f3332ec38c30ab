# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""The closed forms on frames of two elements: that they agree with the general types, and what they refuse."""
import math
import unittest

import numpy as np

from credo import evidence
from credo.evidence import (BinaryMass, FixedLogCommonality, Frame, GridMass, LogCommonality, LogEvidence,
                            MassFunction, OpenBinaryMass, RampBelief)

VACUOUS = MassFunction.vacuous(Frame.shafer(["YES", "NO"]))


class TwoElementsTest(unittest.TestCase):
    def test_closed_forms_agree_with_the_general_ones(self):
        frame = Frame.shafer(["YES", "NO"])
        sources = [BinaryMass(0.6, 0.1), BinaryMass(0.2, 0.5), BinaryMass(0.3, 0.3)]
        general = [m.to_mass_function(frame) for m in sources]
        for name in evidence.rules().keys() - {"bold"}:
            closed, fused = (getattr(evidence, name)(s) for s in (sources, general))
            masses = [fused.mass[s] for s in ("YES", "NO", "Θ")]
            if name in ("conjunctive", "cautious"):
                np.testing.assert_allclose(list(closed), [*masses, fused.conflict], atol=1e-12, err_msg=name)
            else:
                np.testing.assert_allclose([*closed.mass, closed.conflict], [*masses, fused.conflict], atol=1e-12,
                                           err_msg=name)
        np.testing.assert_allclose(list(evidence.average(sources, weights=[1, 2, 1]).mass), [0.325, 0.35, 0.325])
        self.assertIsNone(evidence.dempster(BinaryMass(yes=1.0), BinaryMass(no=1.0)))

    def test_ignorance_is_neutral_in_the_repaired_rules(self):
        sources = [BinaryMass(0.6, 0.1), BinaryMass(0.2, 0.5)]
        for rule in evidence.pcr5_plus, evidence.pcr6_plus:
            np.testing.assert_allclose(list(rule(*sources, BinaryMass()).mass), list(evidence.pcr5(sources).mass),
                                       atol=1e-12)

    def test_what_binary_masses_cannot_is_refused(self):
        with self.assertRaisesRegex(TypeError, "bold is not defined"):
            evidence.bold(BinaryMass(0.5), BinaryMass(0.5))
        with self.assertRaises(TypeError):
            evidence.pcr5_plus(VACUOUS, VACUOUS)
        with self.assertRaisesRegex(ValueError, "unknown = 0"):
            evidence.cautious(BinaryMass(yes=1.0))

    def test_masses_are_checked_and_read_out(self):
        yes, no, unknown = BinaryMass(0.5, 0.25)
        self.assertEqual((yes, no, unknown), (0.5, 0.25, 0.25))
        self.assertEqual((BinaryMass(0.5, 0.25).belief(), BinaryMass(0.5, 0.25).plausibility()), (0.5, 0.75))
        self.assertEqual(BinaryMass(0.5, 0.25).discount(0.0), BinaryMass.vacuous())
        for make in (lambda: BinaryMass(0.8, 0.3), lambda: BinaryMass(math.nan), lambda: GridMass(-0.1),
                     lambda: BinaryMass(0.5).discount(math.nan), lambda: GridMass(0.5).discount(2.0),
                     lambda: RampBelief(max_yes=0.8, max_no=0.8, no_full_from=0.1),
                     lambda: OpenBinaryMass(0.5, 0.4, 0.2), lambda: OpenBinaryMass(conflict=math.nan)):
            with self.assertRaises(ValueError):
                make()

    def test_what_the_cautious_rule_gives_it_takes(self):
        a, b, c = BinaryMass(0.6, 0.1), BinaryMass(0.2, 0.5), BinaryMass(0.3, 0.3)
        both = evidence.cautious(a, b)
        np.testing.assert_allclose(list(evidence.cautious(both, c)), list(evidence.cautious(a, b, c)))
        np.testing.assert_allclose(list(evidence.cautious([both, both])), list(both))
        with self.assertRaisesRegex(TypeError, "pcr6 is not defined for masses that hold conflict"):
            evidence.pcr6(both, a)
        with self.assertRaisesRegex(TypeError, "OpenBinaryMass or BinaryMass"):
            evidence.cautious(both, VACUOUS)

    def test_bold_masses_agree_with_the_general_rule(self):
        masses = [(0.3, 0.2, 0.1), (0.1, 0.4, 0.2)]
        frame = Frame.shafer(["YES", "NO"])
        general = evidence.bold([MassFunction(frame, {"YES": y, "NO": n, "∅": k, "Θ": 1 - y - n - k})
                                 for y, n, k in masses]).mass
        closed = evidence.bold(OpenBinaryMass(*m) for m in masses)
        np.testing.assert_allclose(list(closed), [general[s] for s in ("YES", "NO", "Θ", "∅")], atol=1e-12)
        with self.assertRaisesRegex(ValueError, "empty set"):
            evidence.bold(OpenBinaryMass(0.5), BinaryMass(0.5))

    def test_evidence_is_taken_out_again(self):
        whole = evidence.conjunctive(BinaryMass(0.6, 0.1), BinaryMass(0.2, 0.5))
        np.testing.assert_allclose(list(evidence.decombine(whole, BinaryMass(0.2, 0.5))), [0.6, 0.1, 0.3, 0.0],
                                   atol=1e-12)
        self.assertIsNone(evidence.decombine(OpenBinaryMass(yes=0.1), BinaryMass(yes=0.9)))
        with self.assertRaisesRegex(ValueError, "dogmatic"):
            evidence.decombine(whole, BinaryMass(yes=1.0))

    def test_contextual_discounting_is_that_of_the_frame(self):
        mass, frame = BinaryMass(0.5, 0.3), Frame.shafer(["YES", "NO"])
        general = BinaryMass.from_mass_function(mass.to_mass_function(frame).contextual_discount([0.9, 0.4]))
        np.testing.assert_allclose(list(mass.contextual_discount(if_yes=0.9, if_no=0.4)), list(general))
        for wrong in (-0.1, 0.5), (0.5, math.nan):
            with self.assertRaises(ValueError):
                mass.contextual_discount(*wrong)

    def test_ramps_give_ignorance_for_what_was_not_measured(self):
        self.assertEqual(RampBelief(max_yes=0.8)(math.nan), BinaryMass.vacuous())

    def test_grid_masses_are_dsmc(self):
        both = evidence.dsmc(GridMass(empty=0.5), GridMass(occupied=0.5))
        self.assertEqual(list(both), [0.25, 0.25, 0.25, 0.25])
        self.assertEqual(evidence.dsmc([]), GridMass.vacuous())
        self.assertEqual((both.belief("occupied", "free"), both.belief("occupied", "exclusive")), (0.5, 0.25))
        self.assertIsNone(GridMass(conflict=1.0).without_conflict())
        with self.assertRaisesRegex(ValueError, "'free', 'exclusive'; got 'open'"):
            both.belief("occupied", "open")
        with self.assertRaisesRegex(ValueError, "epsilon"):
            both.dsmp("occupied", "free", -1.0)
        with self.assertRaisesRegex(ValueError, "epsilon"):
            both.dsmp("occupied", "free", math.inf)

    def test_rules_take_grid_masses_under_the_exclusive_model(self):
        frame = Frame.shafer(["empty", "occupied"])
        cells = [GridMass(0.6, 0.1), GridMass(0.2, 0.5), GridMass(0.3, 0.3)]
        general = [MassFunction(frame, {"empty": m.empty, "occupied": m.occupied, "Θ": m.unknown}) for m in cells]
        for name in "dempster", "yager", "dsmh", "pcr2", "pcr5", "pcr6":
            count = 2 if name.startswith("pcr5") or name == "pcr6" else 3
            mass, conflict = getattr(evidence, name)(cells[:count])
            fused = evidence.rules()[name](general[:count])
            expected = [fused.mass["empty"], fused.mass["occupied"], 0.0, fused.mass["Θ"], fused.conflict]
            np.testing.assert_allclose([*mass, conflict], expected, atol=1e-12, err_msg=name)
        self.assertEqual(evidence.conjunctive(cells), evidence.dsmc(cells))
        np.testing.assert_allclose(list(evidence.average(cells)), [1.1 / 3, 0.3, 0.0, 1.0 / 3])
        np.testing.assert_allclose(list(evidence.disjunctive(cells[:2])), [0.12, 0.05, 0.0, 0.83])
        self.assertIsNone(evidence.dempster(GridMass(empty=1.0), GridMass(occupied=1.0)))
        with self.assertRaisesRegex(ValueError, "of two sources; got 3"):
            evidence.pcr5(cells)
        with self.assertRaisesRegex(TypeError, "dubois_prade is not defined for grid masses"):
            evidence.dubois_prade(cells)
        with self.assertRaises(TypeError):
            evidence.dempster(cells[0], BinaryMass())

    def test_evidence_adds_up_to_dempsters_rule(self):
        sources = [BinaryMass(0.6, 0.1), BinaryMass(0.2, 0.5), BinaryMass(0.3, 0.3)]
        a, b, c = map(evidence.log_evidence, sources)
        fused = evidence.dempster(sources).mass
        np.testing.assert_allclose(list((a + b + c).normalised_mass()), list(fused), atol=1e-12)
        np.testing.assert_allclose(list((a + b + c - b - c).normalised_mass()), [0.6, 0.1, 0.3], atol=1e-12)
        self.assertAlmostEqual((a + b + c).pignistic(), fused.pignistic())
        self.assertAlmostEqual((a + b).plausibility_probability(), 1 / (1 + math.exp((a + b).no - (a + b).yes)))
        self.assertEqual(LogEvidence().normalised_mass(), BinaryMass.vacuous())
        self.assertEqual(LogEvidence(800.0, 800.0).pignistic(), 0.5)
        cell = evidence.log_commonality(GridMass(empty=0.1, occupied=0.6), reliability=0.9)
        self.assertAlmostEqual(evidence.log_evidence(cell).yes, cell.evidence_for_occupied())
        with self.assertRaisesRegex(ValueError, "discount it first"):
            evidence.log_evidence(BinaryMass(yes=1.0))
        for wrong in math.nan, math.inf:
            with self.assertRaisesRegex(ValueError, "finite"):
                LogEvidence(wrong)

    def test_cells_add_and_subtract(self):
        reading = evidence.log_commonality(GridMass(occupied=0.7), reliability=0.9)
        cell = LogCommonality() + reading + reading
        np.testing.assert_allclose(list(cell.masses()), list(evidence.dsmc(*[GridMass(occupied=0.63)] * 2)))
        fixed = cell.quantise()
        self.assertEqual(fixed - reading.quantise() + reading.quantise(), fixed)
        self.assertAlmostEqual(fixed.value().occupied, cell.occupied, places=6)
        self.assertFalse(fixed.saturated)
        for make in (lambda: LogCommonality(0.1), lambda: LogCommonality(math.nan),
                     lambda: LogCommonality(-math.inf, -math.inf, -math.inf), lambda: LogCommonality(-1.0, -1.0, 0.0),
                     lambda: FixedLogCommonality(1),
                     lambda: cell.discount(-0.1), lambda: evidence.log_commonality(GridMass(), 1.0)):
            with self.assertRaises(ValueError):
                make()


if __name__ == "__main__":
    unittest.main()
