"""The checker refuses proofs of bounds that are wrong. They come from the folder named by SELFOSC_BOUNDED: one file that refutes, one
that bounds, and one that bounds with an unknown delay."""

import copy
import json
import math
import os
from pathlib import Path

import pytest
from flint import arb

import bounded
import boxes
import motion
from check import Refused

FOLDER = Path(os.environ["SELFOSC_BOUNDED"])
FILES = {name: json.loads((FOLDER / f"{name}.json").read_text()) for name in ("refuted", "consistent")}
LATE = json.loads((FOLDER / "late.json").read_text())


def of_motion(certificate):
    """Combinations of rows by the motion. A contradiction needs all its rows; a cut without one of them goes less far, so that of the
    proof without a contradiction all are changed."""
    steps = [step for stage in certificate["stages"] for step in stage["steps"] if not isinstance(step, str)]
    whats = [what for step in steps for what in step.values() if "by" in what and "modulating_functions" not in what["by"]]
    contradictions = [what["rows"] for what in whats if len(what.get("rows", [])) > 1]
    return contradictions[:1] or [cut["rows"] for what in whats for cut in what["cuts"] if len(cut["rows"]) > 1]


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
    shown, verified, modulated, taken = bounded.check(FILES[name])
    assert shown.startswith(name) and verified > 0 and modulated > 0 and taken == 0


@pytest.mark.parametrize("change", [drop, alter, negate])
@pytest.mark.parametrize("name", FILES)
def test_a_changed_combination_is_refused(name, change):
    certificate = copy.deepcopy(FILES[name])
    for rows in of_motion(certificate):
        change(rows)
    with pytest.raises(Refused):
        bounded.check(certificate)


@pytest.mark.parametrize("upper", [True, False])
def test_a_cut_goes_as_far_as_is_shown_and_no_further(upper):
    sign = 1 if upper else -1
    cut = lambda end: {"unknown": 0, "upper": upper, "end": sign * end}
    side = (-2.0, 3.0) if upper else (-3.0, 2.0)
    reached = lambda end, most: boxes.reached(cut(end), side, lambda: most)
    end = lambda *given: sign * reached(*given)["end"]
    assert end(1.0, arb(0.5)) == end(1.0, None) == 1.0
    assert 2.5 <= end(1.0, arb(2.5)) <= 2.5 + 1e-14
    assert reached(1.0, arb("inf")) is None and reached(1.0, arb("nan")) is None
    # Beyond the box nothing needs to be shown.
    assert end(3.5, arb("inf")) == 3.5
    # One that is to leave nothing must leave nothing, by whichever bound below the box.
    assert end(-4.0, arb(-5)) == -4.0
    assert -3.0 <= end(-4.0, arb(-3)) < -2.0
    for most in (arb(-1), arb("inf"), arb("nan")):
        with pytest.raises(Refused):
            reached(-4.0, most)


def test_a_cut_that_says_more_than_its_rows_show_changes_nothing(monkeypatch):
    certificate, asked = copy.deepcopy(FILES["consistent"]), []

    def noted(cut, side, most):
        asked.append((cut, side, most()))
        return boxes.reached(cut, side, lambda: asked[-1][2])

    with monkeypatch.context() as patched:
        patched.setattr(bounded, "reached", noted)
        shown = bounded.check(certificate)
    cut, side, most = [own for own in asked if own[0]["rows"]][-1]
    sign = 1 if cut["upper"] else -1
    cut["end"] = float((sign * arb(most) + arb(side[0] if cut["upper"] else side[1])) / 2)
    assert not most <= sign * cut["end"]
    assert bounded.check(certificate) == shown


def shift_a_reading(certificate):
    readings = certificate["records"][0]["reading"]
    # By a few steps of the sensor, so that the search box stays the same.
    readings[len(readings) // 2] += 3 * certificate["records"][0]["quantum"]


def test_a_witness_that_misses_a_reading_is_refused():
    certificate = copy.deepcopy(FILES["consistent"])
    shift_a_reading(certificate)
    with pytest.raises(Refused):
        bounded.check(certificate)


def test_a_witness_may_begin_before_the_first_shooting_interval():
    assert LATE["witness"]["first"][0] < LATE["stages"][0]["shooting"][0][1]
    shown, verified, modulated, _ = bounded.check(LATE)
    assert shown.startswith("consistent") and verified > 0 and modulated > 0


@pytest.mark.parametrize("place", ["gain", "position", "velocity"])
def test_a_witness_outside_of_what_is_searched_is_refused(place):
    certificate = copy.deepcopy(LATE)
    values, first = certificate["witness"]["values"], certificate["witness"]["first"][0]
    if place == "gain":
        values[0] = 2 * certificate["searched"]["from"][0][1]
    elif place == "position":
        values[-2] = certificate["records"][0]["reading"][first] + 0.55 * certificate["records"][0]["quantum"]
    else:
        values[-1] = 1.1 * certificate["searched"]["fastest"]
    with pytest.raises(Refused, match="not in the search box"):
        bounded.check(certificate)


def test_modulating_functions_use_readings_before_the_first_shooting_interval_where_all_commands_are_known():
    certificate = copy.deepcopy(LATE)
    rows, searched, delay, _ = bounded.posed(certificate)
    item = certificate["stages"][0] | {"from": searched["from"], "delay_s": delay}
    stage = bounded.Stage(searched, [bounded.Record(own) for own in rows], item)
    [track] = bounded.Modulating(stage).tracks
    stamps = certificate["records"][0]["time_s"]
    longest = searched["from"][len(searched["terms"])][1]
    assert stamps[track.first] - stamps[0] >= longest > stamps[track.first - 1] - stamps[0]


def test_narrower_bounds_are_refused():
    certificate = copy.deepcopy(FILES["consistent"])
    left = certificate["stages"][-1]["left"]
    left[0][1] = (left[0][0] + left[0][1]) / 2
    with pytest.raises(Refused):
        bounded.check(certificate)


@pytest.mark.parametrize("enough", [1, 2, 4, 8])
def test_a_walk_that_is_refused_is_made_anew_with_shorter_steps(monkeypatch, enough):
    class Walk:
        verified = 1

        def __init__(self, stage, name):
            self.made = stage, name

        def go(self):
            bounded.require(motion.Steps.shorter >= enough, "steps are too long")

    monkeypatch.setattr(bounded, "Walk", Walk)
    if enough <= max(bounded.SHORTER):
        assert bounded.walked("stage", "its name").made == ("stage", "its name")
    else:
        with pytest.raises(Refused):
            bounded.walked("stage", "its name")
    assert motion.Steps.shorter == 1


@pytest.mark.parametrize("enough", [4, 8])
def test_a_witness_is_followed_anew_with_shorter_steps(monkeypatch, enough):
    followed = bounded.Stage.motion

    def doubtful(stage, *args):
        nodes, places = followed(stage, *args)
        room = arb(0, 0 if motion.Steps.shorter >= enough else 2 * stage.records[0].error)
        return [(n, (over, [point[0] + room, *point[1:]], slopes)) for n, (over, point, slopes) in nodes], places

    monkeypatch.setattr(bounded.Stage, "motion", doubtful)
    if enough <= max(bounded.SHORTER):
        assert bounded.check(FILES["consistent"])
    else:
        with pytest.raises(Refused, match="the witness misses a reading"):
            bounded.check(FILES["consistent"])


def test_shorter_steps_leave_less_in_doubt_and_hold_what_a_motion_does(monkeypatch):
    def slope(shorter):
        monkeypatch.setattr(motion.Steps, "shorter", shorter)
        over = motion.Equation({"gain": arb(1), "quadratic": motion.span(0.4, 0.6)}, 0)
        at = motion.Equation({"gain": arb(1), "quadratic": arb(0.5)}, 0)
        followed = motion.Motion(
            over, at, [("start", motion.V)], [motion.span(-0.1, 0.1)], [arb(0), motion.span(0.9, 1.1), arb(1)], [arb(0), arb(1), arb(1)]
        )
        followed.advance(arb(1), arb(1), arb(0.6))
        return followed.slopes[0][motion.V]

    widths = [float(slope(shorter).rad()) for shorter in bounded.SHORTER]
    assert widths[0] > 1.2 * widths[1] > 1.2 * 1.05 * widths[2]
    # Of hyperbolic tangents, with the drag in the middle.
    terminal, rate = 2**0.5, 0.5**0.5
    ends = [terminal * math.tanh(rate * 0.6 + math.atanh(v / terminal)) for v in (0.9, 1.1)]
    assert slope(4).contains(arb((ends[1] - ends[0]) / 0.2))
