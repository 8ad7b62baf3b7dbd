"""The checker refuses proofs of oscillations that are wrong. They come from the folder named by SELFOSC_OSCILLATIONS: of a loop with kinks,
with a hyperbolic tangent, with a polynomial, and with a bias, one folder each."""

import copy
import json
import os
from pathlib import Path

import pytest

import oscillation
from check import Refused

FOLDER = Path(os.environ["SELFOSC_OSCILLATIONS"])
FILES = {f"{path.parent.name}-{path.stem}": json.loads(path.read_text()) for path in sorted(FOLDER.glob("*/oscillation-*.json"))}


def share(part):
    def change(document):
        document["omega_radius_rad_s"] *= part
        document["radii"] = [[part * side for side in pair] for pair in document["radii"]]

    return change


def other_gain(document):
    document["plant"]["numerator"] = [1.001 * c for c in document["plant"]["numerator"]]


def off(field, radius):
    def change(document):
        holder, key = field(document)
        holder[key] += 6.0 * radius(document)

    return change


CHANGES = {
    "an amplitude off by three widths": off(lambda d: (d["harmonics"][0], 0), lambda d: d["radii"][0][0]),
    "a frequency off by three widths": off(lambda d: (d, "omega_rad_s"), lambda d: d["omega_radius_rad_s"]),
    "a ten-thousandth of the box": share(1e-4),
    "a gain off by 0.1 %": other_gain,
    "a dead time off by 0.1 ms": lambda d: d["plant"].update(delay_s=d["plant"]["delay_s"] + 1e-4),
    "a third harmonic of the other sign": lambda d: d["harmonics"].__setitem__(1, [-x for x in d["harmonics"][1]]),
    "no remainder": lambda d: d.update(remainder=0.0),
    "a harmonic without radius": lambda d: d["radii"].__setitem__(2, [0.0, 0.0]),
    "an imaginary first harmonic": lambda d: d["harmonics"][0].__setitem__(1, 1e-3),
    "an amplitude below zero": lambda d: d["harmonics"][0].__setitem__(0, -d["harmonics"][0][0]),
    "a harmonic too few": lambda d: d["harmonics"].pop(),
    "a plant that is not strictly proper": lambda d: d["plant"].update(numerator=d["plant"]["denominator"]),
    "another claim": lambda d: d.update(claim="none"),
    "another format": lambda d: d.update(format=1),
    "other orders": lambda d: d.update(orders="all" if d["orders"] == "odd" else "odd"),
}


def test_there_is_one_of_each_kind():
    assert {document["characteristic"]["kind"] for document in FILES.values()} == set(oscillation.KINDS)


@pytest.mark.parametrize("name", FILES)
def test_what_the_command_writes_is_accepted(name):
    amplitude, omega = oscillation.check(FILES[name])
    assert amplitude > 0 and omega > 0


@pytest.mark.parametrize("name", [name for name in FILES if name.startswith(("kinked", "biased"))])
def test_a_tenth_of_a_box_is_refused(name):
    """With kinks a box is as wide as the harmonics above; a smooth one is as wide as the roundings of doubles, which balls do not have."""
    false_one = copy.deepcopy(FILES[name])
    share(0.1)(false_one)
    with pytest.raises(Refused, match="no contraction"):
        oscillation.check(false_one)


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("name", FILES)
def test_a_false_proof_is_refused(name, change):
    false_one = copy.deepcopy(FILES[name])
    CHANGES[change](false_one)
    with pytest.raises(Refused):
        oscillation.check(false_one)
