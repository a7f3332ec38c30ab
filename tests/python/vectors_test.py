# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""The golden vectors (tests/data/vectors.json) through the Python API."""
import collections
import json
import os
import pathlib
import unittest

from credo import evidence
from credo.evidence import Frame, MassFunction, OpenWorldMatcher, RampBelief

VECTORS = pathlib.Path(os.environ.get("CREDO_VECTORS")
                       or pathlib.Path(__file__).parents[1] / "data" / "vectors.json")


class TotalConflict(Exception):
    pass


def text_of(name):
    return "∅" if name == "0" else name.replace("n", "∩").replace("u", "∪")


def frame_of(case):
    names = [str(i + 1) for i in range(case["n"])]
    model = case.get("model", "free")
    if model == "shafer":
        return Frame.shafer(names)
    return Frame.free_dsm(names) if model == "free" else Frame.hybrid(names, [text_of(e) for e in case["empty"]])


def mass_of(frame, masses):
    return MassFunction(frame, {text_of(name): mass for name, mass in masses.items()})


def masses_of(case):
    return [mass_of(frame_of(case), masses) for masses in case["masses"]]


def name_of(proposition):
    """As the vectors write it; they write Θ out."""
    frame, text = proposition.frame, str(proposition)
    if text == "Θ":
        return "u".join(str(name) for name, element in zip(frame.names, frame.elements) if element)
    return "0" if text == "∅" else text.replace(" ∩ ", "n").replace(" ∪ ", "u")


def written(mass):
    return {name_of(proposition): value for proposition, value in mass.items()}


def mass_in(fused):
    if fused is None:
        raise TotalConflict
    return written(fused.mass)


def measures(case):
    mass = mass_of(frame_of(case), case["mass"])
    functions = {"bel": mass.belief, "pl": mass.plausibility, "q": mass.commonality, "betp": mass.pignistic,
                 "dsmp": lambda proposition: mass.dsmp(proposition, case["eps"])}
    return {name: {name_of(each): function(each) for each in mass.frame.propositions()}
            for name, function in functions.items()}


def open_world(case, normalise):
    matcher = OpenWorldMatcher(case["triplets"])
    masses = matcher.normalised() if normalise else matcher.open()
    if masses is None:
        raise TotalConflict
    out = {"*": masses.none, "T": masses.unknown}
    out |= {f"P{i + 1}": mass for i, mass in enumerate(masses.match)}
    return out if normalise else out | {"0": masses.conflict}


def ramp(case):
    shape = RampBelief(case["ymax"], case["y0"], case["y1"], case["nmax"], case["n0"], case["n1"])
    mass = shape(case["x"])
    return {"1": mass.yes, "2": mass.no, "1u2": mass.unknown}


RULES = {"conj": "conjunctive", "dsmc": "conjunctive", "dempster": "dempster", "yager": "yager",
         "dubois_prade": "dubois_prade", "dsmh": "dsmh", "disjunctive": "disjunctive", "pcr2": "pcr2", "pcr5": "pcr5",
         "pcr6": "pcr6"}
OPERATIONS = {
    **{op: lambda case, rule=rule: mass_in(getattr(evidence, rule)(masses_of(case))) for op, rule in RULES.items()},
    "fold": lambda case: mass_in(evidence.fold_in_order(RULES[case["rule"]], masses_of(case))),
    "measures": measures,
    "discount": lambda case: written(mass_of(frame_of(case), case["mass"]).discount(case["alpha"])),
    "discounted_dsmc": lambda case: mass_in(
        evidence.conjunctive(m.discount(p) for m, p in zip(masses_of(case), case["p"]))),
    "open_world": lambda case: open_world(case, True),
    "open_world_unnormalised": lambda case: open_world(case, False),
    "ramp_bpa": ramp,
}


def difference(expected, got, at="out"):
    """Where the two differ by more than 1e-11 + 1e-9 |expected|; what one does not name is 0."""
    if isinstance(expected, dict):
        for key in expected.keys() | got.keys():
            if found := difference(expected.get(key, 0.0), got.get(key, 0.0), f"{at}.{key}"):
                return found
        return None
    if abs(expected - got) <= 1e-11 + 1e-9 * abs(expected):
        return None
    return f"{at}: expected {expected}, got {got}"


def failure_of(case):
    try:
        out = OPERATIONS[case["op"]](case["in"])
    except TotalConflict:
        return None if case.get("error") == "total_conflict" else "unexpected total conflict"
    return f"expected the error {case['error']}" if "error" in case else difference(case["out"], out)


class VectorsTest(unittest.TestCase):
    def test_every_operation_agrees(self):
        run = collections.Counter()
        for case in json.loads(VECTORS.read_text(encoding="utf-8"))["cases"]:
            if case["op"] in OPERATIONS:
                run[case["op"]] += 1
                self.assertIsNone(failure_of(case), case["id"])
        self.assertEqual(set(run), set(OPERATIONS))
        print(f"{sum(run.values())} cases of {len(run)} operations")

    def test_a_difference_is_found(self):
        case = {"id": "x", "op": "discount", "in": {"n": 2, "model": "shafer", "alpha": 0.5, "mass": {"1": 1.0}},
                "out": {"1": 0.5, "1u2": 0.5000000002}}
        self.assertIsNone(failure_of(case))
        self.assertIsNotNone(failure_of(case | {"out": {"1": 0.5, "1u2": 0.500000002}}))
        self.assertIsNotNone(failure_of({"op": "discount", "in": case["in"], "error": "total_conflict"}))


if __name__ == "__main__":
    unittest.main()
