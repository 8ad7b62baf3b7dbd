"""The checker refuses proofs of bounds that are wrong. They come from the folder named by SELFOSC_BOUNDED: one file that refutes, one
that bounds."""

import copy
import json
import os
from pathlib import Path

import pytest

import bounded
from check import Refused

FOLDER = Path(os.environ["SELFOSC_BOUNDED"])
FILES = {name: json.loads((FOLDER / f"{name}.json").read_text()) for name in ("refuted", "consistent")}


def of_motion(certificate):
    """Combinations of rows by the motion, contradictions first: these need all their rows, and a contradiction among cuts is the last of
    them. A cut may say less than its rows show, the last ones, over the narrowest boxes, by least."""
    steps = [step for step in certificate["stages"][0]["steps"] if not isinstance(step, str)]
    for step in sorted(reversed(steps), key=lambda step: "exclude" not in step):
        if "divide" in step or "part" in step:
            continue
        (what,) = step.values()
        if "hats" not in what["by"] and (what.get("rows") or what.get("cuts")):
            rows = what["rows"] if "rows" in what else what["cuts"][-1]["rows"]
            if len(rows) > 1:
                yield rows


def heaviest(rows):
    return max(range(len(rows)), key=lambda place: rows[place][1])


def drop(rows):
    rows.pop(heaviest(rows))


def alter(rows):
    rows[heaviest(rows)][1] *= 3


def negate(rows):
    rows[heaviest(rows)][1] *= -1


@pytest.mark.parametrize("name", FILES)
def test_what_the_command_writes_is_accepted(name):
    shown, verified, by_hats, taken = bounded.check(FILES[name])
    assert shown.startswith(name) and verified > 0 and by_hats > 0 and taken == 0


@pytest.mark.parametrize("change", [drop, alter, negate])
@pytest.mark.parametrize("name", FILES)
def test_a_changed_combination_is_refused(name, change):
    certificate = copy.deepcopy(FILES[name])
    change(next(of_motion(certificate)))
    with pytest.raises(Refused):
        bounded.check(certificate)


def shift_a_reading(certificate):
    readings = certificate["records"][0]["reading"]
    readings[len(readings) // 2] += 40 * certificate["records"][0]["error"]


CHANGES = {
    "a missing step": lambda c: c["stages"][0]["steps"].pop(),
    "a step too many": lambda c: c["stages"][0]["steps"].append("keep"),
    "another statement": lambda c: c.update(statement="no parameter at all"),
    "another format": lambda c: c.update(format=3),
    "another equation": lambda c: c.update(terms=["gain", "sound"]),
    "a window too early": lambda c: c["stages"][0].update(delay_s=1e9),
    "a stage with another delay": lambda c: c["stages"].insert(0, c["stages"][0] | {"delay_s": 0.0, "left": c["stages"][0]["from"], "steps": ["keep"]}),
    "no stage": lambda c: c["stages"].clear(),
    "a missing field": lambda c: c.pop("records"),
}


@pytest.mark.parametrize("change", CHANGES)
def test_refused(change, tmp_path):
    certificate = copy.deepcopy(FILES["refuted"])
    CHANGES[change](certificate)
    path = tmp_path / "proof.json"
    path.write_text(json.dumps(certificate))
    with pytest.raises(Refused):
        bounded.check_file(path)


def test_a_witness_that_misses_a_reading_is_refused():
    certificate = copy.deepcopy(FILES["consistent"])
    shift_a_reading(certificate)
    with pytest.raises(Refused):
        bounded.check(certificate)


def test_narrower_bounds_are_refused():
    certificate = copy.deepcopy(FILES["consistent"])
    left = certificate["stages"][-1]["left"]
    left[0][1] = (left[0][0] + left[0][1]) / 2
    with pytest.raises(Refused):
        bounded.check(certificate)
