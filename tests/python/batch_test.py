# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""credo.evidence.batch: the same as the functions of BinaryMass, cell by cell, on arrays of any layout."""
import unittest

import numpy as np

from credo import evidence
from credo.evidence import BinaryMass, OpenBinaryMass, batch

RULES = ["conjunctive", "dempster", "yager", "disjunctive", "pcr2", "pcr5", "cautious", "average"]
CERTAIN = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


def random_masses(shape, seed, dtype=np.float64):
    return np.random.default_rng(seed).dirichlet(np.ones(3), shape).astype(dtype)


def masses_in(result):
    return result[0] if isinstance(result, tuple) else result


def scalar(rule, a, b):
    fused = getattr(evidence, rule)(BinaryMass(*a[:2]), BinaryMass(*b[:2]))
    return list(fused) if isinstance(fused, OpenBinaryMass) else list(fused.mass)


class BatchTest(unittest.TestCase):
    map = random_masses((40, 30), 1)
    reading = random_masses((40, 30), 2)

    def test_every_cell_is_what_the_rule_of_two_masses_gives(self):
        for rule in RULES:
            expected = [[scalar(rule, a, b) for a, b in zip(*rows)] for rows in zip(self.map, self.reading)]
            result = masses_in(getattr(batch, rule)(self.map, self.reading))
            self.assertEqual(result.shape, np.shape(expected), rule)
            np.testing.assert_allclose(result, expected, atol=1e-14, err_msg=rule)

    def test_a_new_array_is_made_and_nothing_else_is_written(self):
        map, reading = self.map.copy(), self.reading.copy()
        for rule in RULES:
            result = masses_in(getattr(batch, rule)(map, reading))
            self.assertFalse(np.shares_memory(result, map), rule)
        batch.discount(map, 0.5)
        np.testing.assert_array_equal(map, self.map)
        np.testing.assert_array_equal(reading, self.reading)

    def test_the_result_may_go_to_the_map_itself(self):
        for rule in RULES:
            start = batch.conjunctive(self.map, self.reading) if rule in ("conjunctive", "cautious") else self.map
            expected = masses_in(getattr(batch, rule)(start, self.reading))
            map = start.copy()
            self.assertIs(masses_in(getattr(batch, rule)(map, self.reading, out=map)), map, rule)
            np.testing.assert_array_equal(map, expected, err_msg=rule)
            if start is self.map:
                reading = self.reading.copy()
                getattr(batch, rule)(self.map, reading, out=reading)
                np.testing.assert_array_equal(reading, expected, err_msg=rule)

    def test_any_shape_and_layout_will_do(self):
        for rule in RULES:
            expected = masses_in(getattr(batch, rule)(self.map, self.reading))
            apart = np.moveaxis(np.ascontiguousarray(np.moveaxis(self.map, -1, 0)), 0, -1)
            np.testing.assert_array_equal(masses_in(getattr(batch, rule)(apart, self.reading)), expected)
            turned = masses_in(getattr(batch, rule)(self.map[::-1, ::2], self.reading[::-1, ::2]))
            np.testing.assert_array_equal(turned, expected[::-1, ::2])
            one = masses_in(getattr(batch, rule)(self.map[3, 4], self.reading[3, 4]))
            np.testing.assert_array_equal(one, expected[3, 4])
            none = masses_in(getattr(batch, rule)(np.empty((0, 7, 3)), np.empty((0, 7, 3))))
            self.assertEqual(none.shape, (0, 7, expected.shape[-1]))

    def test_single_precision_stays_single(self):
        for rule in RULES:
            result = masses_in(getattr(batch, rule)(self.map.astype(np.float32), self.reading.astype(np.float32)))
            self.assertEqual(result.dtype, np.float32)
            np.testing.assert_allclose(result, masses_in(getattr(batch, rule)(self.map, self.reading)), atol=1e-6)
        self.assertEqual(batch.discount(self.map.astype(np.float32), 0.5).dtype, np.float32)

    def test_conflict_is_kept_from_reading_to_reading(self):
        open_masses = batch.conjunctive(batch.conjunctive(self.map, self.reading), self.map)
        sources = [BinaryMass(*cells[5, 6, :2]) for cells in (self.map, self.reading, self.map)]
        np.testing.assert_allclose(open_masses[5, 6], list(evidence.conjunctive(sources)), atol=1e-14)
        np.testing.assert_allclose(open_masses.sum(axis=-1), 1.0)
        both, _ = batch.cautious(self.map, self.reading)
        np.testing.assert_allclose(batch.cautious(both, self.reading)[0], both, atol=1e-12)

    def test_cells_without_a_result_keep_their_mass_and_are_counted(self):
        map = np.concatenate([CERTAIN, self.map[0]])
        reading = np.concatenate([CERTAIN[::-1], self.reading[0]])
        masses, kept = batch.dempster(map, reading)
        self.assertEqual(kept, 2)
        np.testing.assert_array_equal(masses[:2], CERTAIN)
        masses, kept = batch.cautious(map, reading)
        self.assertEqual(kept, 2)
        np.testing.assert_array_equal(masses[:2, :3], CERTAIN)
        np.testing.assert_array_equal(batch.yager(CERTAIN, CERTAIN[::-1]), [[0, 0, 1]] * 2)

    def test_discounting_is_that_of_each_mass(self):
        discounted = batch.discount(self.map, 0.25)
        np.testing.assert_allclose(discounted[1, 2], list(BinaryMass(*self.map[1, 2, :2]).discount(0.25)), atol=1e-15)
        np.testing.assert_array_equal(batch.discount(self.map, 0.0)[..., 2], 1.0)
        for wrong in -0.1, 1.1, np.nan:
            with self.assertRaisesRegex(ValueError, r"\[0, 1\]"):
                batch.discount(np.empty((0, 3)), wrong)

    def test_what_is_no_array_of_masses_is_refused(self):
        for wrong, why in ((self.map[..., :2], r"shape \(\.\.\., 3\).* got float64 of \(40, 30, 2\)"),
                           (np.float64(1.0), r"got float64 of \(\)"),
                           (self.map.astype(int), "float64 or float32; got int64"),
                           (self.map.astype(">f8"), "got >f8"), ("masses", "got <U6"), ([[1.0], [1.0, 2.0]], "numbers")):
            with self.assertRaisesRegex(ValueError, "the map must be an array of .*" + why):
                batch.pcr2(wrong, self.reading)
            with self.assertRaisesRegex(ValueError, "the reading must be an array of .*" + why):
                batch.pcr2(self.map, wrong)
        with self.assertRaisesRegex(ValueError, r"got float64 of \(40, 30, 4\)"):
            batch.pcr2(batch.conjunctive(self.map, self.reading), self.reading)
        for wrong in self.reading[0], self.reading.astype(np.float32):
            with self.assertRaisesRegex(ValueError, r"each cell of the map.* for a map float64 of \(40, 30, 3\)"):
                batch.dempster(self.map, wrong)

    def test_a_result_goes_only_where_it_fits(self):
        locked = self.map.copy()
        locked.flags.writeable = False
        for wrong in (self.map[:10], self.map.astype(np.float32), locked, np.asfortranarray(self.map), [], 7,
                      np.empty((40, 30, 4))):
            with self.assertRaisesRegex(ValueError, r"out must be a writeable .* float64 of \(40, 30, 3\)"):
                batch.pcr5(self.map, self.reading, out=wrong)
        memory = np.zeros((41, 30, 3))
        for map, reading, out in ((memory[1:], self.reading, memory[:-1]), (self.map, memory[:-1], memory[1:])):
            with self.assertRaisesRegex(ValueError, "overlaps"):
                batch.pcr5(map, reading, out=out)


if __name__ == "__main__":
    unittest.main()
