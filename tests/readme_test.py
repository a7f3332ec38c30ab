#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""The README's C++ is a piece of an example that is compiled and run, its commands are commands, its links lead somewhere,
and what it shows of the demo is what the demo says.

Usage: readme_test.py SOURCE_DIR CREDO
"""
import pathlib
import re
import subprocess
import sys
import tempfile


NUMBER = re.compile(r"[0-9]+(?:\.[0-9]+)?")


def same_line(shown, said):
    """The same words, and numbers as another machine's arithmetic may give them; times may be any."""
    timeless = lambda text: re.sub(r"[0-9.]+ ms", "_ ms", text)
    shown, said = timeless(shown), timeless(said)
    squeezed = lambda text: " ".join(NUMBER.sub("0", text).split())
    if squeezed(shown) != squeezed(said):
        return False
    pairs = zip(map(float, NUMBER.findall(shown)), map(float, NUMBER.findall(said)))
    return all(abs(a - b) <= 0.05 + 0.05 * abs(a) for a, b in pairs)


def shown_but_not_said(readme, credo):
    """The first line of the demo's block in the README that is not in its output, in order."""
    block = re.search(r"^```\n(demo: .*?)```", readme, re.S | re.M)
    if not block:
        return "(no block of output)"
    with tempfile.TemporaryDirectory() as folder:
        said = subprocess.run([credo, "demo", "--out", str(pathlib.Path(folder) / "demo")], capture_output=True, text=True,
                              check=True).stdout.splitlines()
    for line in block.group(1).splitlines():
        if line in ("", "…"):
            continue
        found = next((i for i, candidate in enumerate(said) if same_line(line, candidate)), None)
        if found is None:
            return line
        said = said[found + 1:]
    return None


def main():
    root, credo = pathlib.Path(sys.argv[1]), sys.argv[2]
    readme = (root / "README.md").read_text(encoding="utf-8")
    faults = []
    if len(readme.splitlines()) > 150:
        faults.append("README.md has more than 150 lines")

    squeeze = lambda text: " ".join(text.split())
    examples = [squeeze(path.read_text(encoding="utf-8")) for path in sorted((root / "examples").glob("*.cpp"))]
    snippets = re.findall(r"```cpp\n(.*?)```", readme, re.S)
    for snippet in snippets:
        if not any(squeeze(snippet) in example for example in examples):
            faults.append("a C++ snippet of README.md is in no example:\n" + snippet)
    if not snippets:
        faults.append("README.md shows no C++")

    known = subprocess.run([credo, "--help"], capture_output=True, text=True, check=True).stdout
    for command in set(re.findall(r"^credo ([a-z]+)", readme, re.M)):
        if not re.search(rf"^  {command}\b", known, re.M):
            faults.append(f"README.md runs `credo {command}`, which is no sub-command")
    for script in set(re.findall(r"^(scripts/[a-z-]+)", readme, re.M)):
        if not (root / script).exists():
            faults.append(f"README.md runs {script}, which is not there")
    if line := shown_but_not_said(readme, credo):
        faults.append(f"README.md shows what the demo does not say:\n{line}")
    for link in re.findall(r"\]\(([^)#]+)\)", readme):
        if "://" not in link and not (root / link).exists():
            faults.append(f"README.md links to {link}, which is not there")

    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
