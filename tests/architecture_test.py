#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""Includes go down the floors only, each room uses only its third-party libraries, and every source has its header.

Usage: architecture_test.py SOURCE_DIR
"""
import pathlib
import re
import sys

FLOORS = {
    "evidence": 0, "geometry": 0,
    "sensors": 1, "grids": 1,
    "perception": 2, "mapping": 2, "sim": 2, "datasets": 2,
    "tracking": 3,
    "localization": 4,
    "results": 5,
    "evaluation": 6,
    "apps": 7,
    "python": 7,
}

# Rooms that use fewer rooms than their floor allows.
ONLY = {
    "python": {"evidence"},
}

# Prefix of an include -> the rooms that may have it. Eigen is everywhere but in evidence.
THIRD_PARTY = {
    "Eigen/": set(FLOORS) - {"evidence", "python"},
    "opencv2/core": {"sensors", "perception", "sim", "datasets", "tracking", "localization", "results", "evaluation",
                     "apps"},
    "opencv2/imgproc": {"perception", "sim", "datasets", "results"},
    "opencv2/imgcodecs": {"datasets", "results"},
    "boost/": {"tracking"},
    "ceres/": {"localization"},
    "mrpt/": {"evaluation"},
    "yaml-cpp/": {"sim", "datasets"},
    "tbb/": {"mapping"},
    "oneapi/": {"mapping"},
    "fmt/": {"results", "evaluation", "apps"},
    "CLI/": {"apps"},
    "pybind11/": {"python"},
    "nlohmann/": {"apps"},
    "zlib.h": {"datasets"},
    "unistd.h": {"apps", "datasets"},
    "fcntl.h": {"datasets"},
    "sys/": {"apps", "datasets"},
}

LICENSE = ("SPDX-FileCopyrightText: The Credo Authors", "SPDX-License-Identifier: Apache-2.0")


def faults_of(path, room):
    text = path.read_text(encoding="utf-8")
    lines = text.splitlines()
    if len(lines) < 2 or LICENSE[0] not in lines[0] or LICENSE[1] not in lines[1]:
        yield f"{path}:1: the two-line SPDX header is missing"
    for number, line in enumerate(lines, 1):
        quoted = re.match(r'\s*#\s*include\s+"([^"]+)"', line)
        angled = re.match(r"\s*#\s*include\s+<([^>]+)>", line)
        if quoted:
            other = quoted.group(1).split("/")[0]
            if other not in FLOORS:
                yield f"{path}:{number}: include from the root of the tree: \"{quoted.group(1)}\""
            elif other != room and FLOORS[other] >= FLOORS[room]:
                yield f"{path}:{number}: {room} (floor {FLOORS[room]}) may not use {other} (floor {FLOORS[other]})"
            elif other != room and other not in ONLY.get(room, FLOORS):
                yield f"{path}:{number}: {room} uses {', '.join(ONLY[room])} only, not {other}"
        if angled:
            name = angled.group(1)
            prefix = next((p for p in THIRD_PARTY if name.startswith(p)), None)
            if prefix is not None and room not in THIRD_PARTY[prefix]:
                yield f"{path}:{number}: {room} may not use <{name}>"
            if prefix is None and ("/" in name or name.endswith((".h", ".hpp"))):
                yield f"{path}:{number}: <{name}> is no library of this house (see docs/decisions)"


def main():
    root = pathlib.Path(sys.argv[1])
    faults, files = [], 0
    for room in FLOORS:
        for path in sorted((root / room).rglob("*.[ch]pp")):
            files += 1
            faults += faults_of(path, room)
    for fault in faults:
        print(fault)
    print(f"{files} files, {len(faults)} faults")
    sys.exit(1 if faults or files == 0 else 0)


if __name__ == "__main__":
    main()
