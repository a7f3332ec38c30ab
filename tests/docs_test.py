#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""What docs/evidence shows is run: under `<!-- output: NAME -->` stands what the example NAME prints, byte for byte, its C++ is a
piece of a program that the tests build, and so are the lines of its CMake; links lead somewhere, and the map of headers has all.

Usage: docs_test.py SOURCE_DIR FOLDER_OF_EXAMPLES
With CREDO_UPDATE_DOCS=1 in the environment the outputs on the pages are replaced instead.
"""
import os
import pathlib
import re
import subprocess
import sys

OUTPUT = re.compile(r"(<!-- output: (\S+) -->\n```\n)(.*?)(```)", re.S)


def printed_by(program):
    return subprocess.run([program], capture_output=True, text=True, check=True).stdout


def with_present_outputs(text, programs):
    """The page as it should be: every marked block holds what its program prints now."""
    return OUTPUT.sub(lambda block: block[1] + printed_by(programs / block[2]) + block[4], text)


def faults_of(page, text, root, programs):
    for block in OUTPUT.finditer(text):
        if block[3] != printed_by(programs / block[2]):
            yield f"{page.name}: {block[2]} prints something else (run this test with CREDO_UPDATE_DOCS=1)"
    if text.count("<!-- output:") != len(OUTPUT.findall(text)):
        yield f"{page.name}: a mark of an output has no block under it"

    squeeze = lambda code: " ".join(code.split())
    built = [squeeze(path.read_text(encoding="utf-8")) for path in sorted((root / "examples").rglob("*.cpp"))]
    for snippet in re.findall(r"```cpp\n(.*?)```", text, re.S):
        if not any(squeeze(snippet) in program for program in built):
            yield f"{page.name}: this C++ is in no example:\n{snippet}"
    project = (root / "tests/package/CMakeLists.txt").read_text(encoding="utf-8").splitlines()
    for snippet in re.findall(r"```cmake\n(.*?)```", text, re.S):
        for line in snippet.splitlines():
            if line not in project:
                yield f"{page.name}: this CMake is not in tests/package:\n{line}"
    yield from dead_links(page, text)


def anchors(text):
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in re.findall(r"^#+ (.*)$", text, re.M)}


def dead_links(page, text):
    for link in re.findall(r"\]\(([^)]+)\)", text):
        file, _, anchor = link.partition("#")
        target = page.parent / file if file else page
        if "://" in link:
            continue
        if not target.exists() or (anchor and anchor not in anchors(target.read_text(encoding="utf-8"))):
            yield f"{page.name} links to {link}, which is not there"


def main():
    root, programs = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    faults, shown = [], set()
    for page in sorted((root / "docs/evidence").glob("*.md")):
        text = page.read_text(encoding="utf-8")
        if os.environ.get("CREDO_UPDATE_DOCS"):
            text = with_present_outputs(text, programs)
            page.write_text(text, encoding="utf-8")
        faults += faults_of(page, text, root, programs)
        shown |= {block[2] for block in OUTPUT.finditer(text)}
    for example in sorted((root / "examples/evidence").glob("*.cpp")):
        if example.stem not in shown:
            faults.append(f"no page shows what {example.name} prints")

    first_page = (root / "docs/evidence/README.md").read_text(encoding="utf-8")
    for header in sorted((root / "evidence").glob("*.hpp")):
        if f"`{header.name}`" not in first_page:
            faults.append(f"the map of headers in README.md lacks {header.name}")

    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
