#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""The Python module where it is installed, and the Debian packages: what is in them, and that it works.

Usage: python_test.py BUILD_DIR CMAKE
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD, CMAKE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
USE = """
from credo import evidence
frame = evidence.Frame.shafer(["A", "B"])
print(evidence.__file__, evidence.MassFunction.simple_support(frame, "A", 0.5))
"""


def run(*command, **options):
    return subprocess.run(list(map(str, command)), check=True, capture_output=True, text=True, **options).stdout


def used_from(prefix):
    """What a program says that has no other module of ours; -I keeps the working folder out of it."""
    packages = prefix / "lib" / "python3" / "dist-packages"
    return packages, run(sys.executable, "-I", "-c", f"import sys; sys.path.insert(0, {str(packages)!r})\n{USE}")


class InstalledTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def check_use(self, prefix):
        packages, said = used_from(prefix)
        self.assertIn(str(packages), said)
        self.assertIn("{A: 0.5, Θ: 0.5}", said)
        for text in "__init__.py", "py.typed", "evidence/__init__.pyi", "evidence/batch.pyi":
            self.assertTrue((packages / "credo" / text).exists(), text)

    def test_the_component_works_where_it_is_installed(self):
        run(CMAKE, "--install", BUILD, "--component", "python", "--prefix", self.folder)
        self.check_use(self.folder)
        self.assertFalse((self.folder / "include").exists())

    @unittest.skipUnless(shutil.which("dpkg-deb"), "no dpkg-deb: not Debian")
    def test_the_debian_packages_have_their_fields_and_work(self):
        run(CMAKE.with_name("cpack"), "--config", BUILD / "CPackConfig.cmake", "-B", self.folder)
        found = {path.name.split("_")[0]: path for path in self.folder.glob("*.deb")}
        self.assertEqual(set(found), {"libcredo-evidence-dev", "python3-credo"})
        for name, section, summary in (("libcredo-evidence-dev", "libdevel", "Belief functions in C++"),
                                       ("python3-credo", "python", "Belief functions in Python")):
            fields = {key: run("dpkg-deb", "-f", found[name], key).strip()
                      for key in ("Architecture", "Section", "Description", "Maintainer", "Depends")}
            self.assertEqual(fields["Architecture"], run("dpkg", "--print-architecture").strip())
            self.assertEqual(fields["Section"], section)
            self.assertEqual(fields["Description"].splitlines()[0], summary)
            self.assertEqual(fields["Maintainer"], "The Credo Authors")
            run("dpkg-deb", "-x", found[name], self.folder / "root")
            self.assertTrue((self.folder / "root/usr/share/doc" / name / "copyright").exists())
        depends = fields["Depends"]  # of python3-credo
        major, minor = sys.version_info[:2]
        for needed in ("python3-numpy", f"python3 (>= {major}.{minor})", f"python3 (<< {major}.{minor + 1})", "libc6",
                       "libstdc++6"):
            self.assertIn(needed, depends)
        self.check_use(self.folder / "root" / "usr")
        self.assertTrue((self.folder / "root/usr/include/credo/evidence/rules.hpp").exists())
        self.assertTrue(list((self.folder / "root/usr").rglob("libcredo_evidence.a")))
        self.assertTrue(list((self.folder / "root/usr").rglob("credo-evidence-targets.cmake")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
