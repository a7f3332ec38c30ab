# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""docs/evidence/python.md shows what the module says."""
import doctest
import pathlib
import unittest

PAGE = pathlib.Path(__file__).parents[2] / "docs" / "evidence" / "python.md"


class PageTest(unittest.TestCase):
    def test_what_is_shown_is_what_is_said(self):
        result = doctest.testfile(str(PAGE), module_relative=False, encoding="utf-8")
        self.assertEqual(result.failed, 0)
        self.assertGreater(result.attempted, 10)


if __name__ == "__main__":
    unittest.main()
