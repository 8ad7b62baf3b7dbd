"""Outputs to the second order hold motions that are computed another way, and steps in slanted boxes that say too much are refused."""

import copy
import random
from fractions import Fraction

import pytest
from flint import arb, arb_mat

import bounded
import second_order
from boxes import Box, Frame
from check import Refused
from motion import advance_point
from polynomials import Poly, ball
from second_order import ONE, ZERO, Enclosure, Strays

TERMS = {
    "linear": {"gain": 1.0, "linear": 0.5},
    "quadratic": {"gain": 1.0, "quadratic": 0.6},
    "mixed": {"gain": 1.0, "linear": 0.3, "quadratic": 0.5},
    "cubic": {"gain": 1.0, "linear": 0.3, "cubic": 0.4},
    "spring": {"gain": 1.0, "linear": 0.3, "quadratic": 0.5, "stiffness": 0.3},
    "lag": {"gain": 1.0, "linear": 0.3, "quadratic": 0.5, "lag_rate": 8.0},
}
STEP, DISTURBANCE = 0.125, 0.02


def certificate(terms, delay=0.25, until=9.5, records=1):
    """Without readings and steps; a delay of None is unknown, and about a quarter."""
    count = int(until / STEP) + 1
    record = {
        "time_s": [STEP * k for k in range(count)],
        "reading": [0.0] * count,
        "error": 0.01,
        "levels": [1.0, -1.0] * 3,
        "switched_s": [[1.0 + 2.5 * i] * 2 for i in range(5)],
        "jitter_s": 0.0,
    }
    ranges = [[v / 2, 2 * v] for v in terms.values()] + ([[0.0, 0.5]] if delay is None else []) + [[-1.0, 1.0]] * records
    windows = [[r, 6, count - 1] for r in range(records)]
    return {
        "terms": list(terms),
        "middle_speed": 0.5 if {"linear", "quadratic"} <= set(terms) else 0.0,
        "least_linear": -1.0,
        "fastest": 5.0,
        "records": [copy.deepcopy(record) for _ in range(records)],
        "from": ranges,
        "stages": [{"delay_s": delay, "windows": windows, "from": ranges, "left": ranges, "steps": []}],
        "witness": None,
        "statement": bounded.statement(False, False, ("", "")),
    }


def stage_of(item):
    return bounded.Stage(item, [bounded.Record(record) for record in item["records"]], item["stages"][0])


def truth_of(terms, delay=0.25, records=1):
    start = [0.0, 0.3] + ([0.9] if "lag_rate" in terms else [])
    return list(terms.values()) + ([0.25] if delay is None else []) + [DISTURBANCE] * records + start * records


def exact_motion(equation, state, u, h):
    """By the closed form where drag is linear alone, else by a point's motion in steps of its own."""
    if equation.has == {"gain", "linear", "disturbance"}:
        b, force = equation.at["linear"], equation.at["gain"] * u + equation.at["disturbance"]
        fade = (-b * h).exp()
        return [state[0] + force / b * h + (state[1] - force / b) * (ONE - fade) / b, force / b + (state[1] - force / b) * fade, ZERO]
    start = state if "lag_rate" in equation.has else [state[0], state[1], u]
    return advance_point(equation, start, u, h)[0]


def outputs(stage, theta, index=0):
    """At every sample, of one parameter."""
    record, (first, (_, begin, end)) = stage.records[index], next((w, x) for w, x in enumerate(stage.windows) if x[0] == index)
    values = [arb(0)] * len(stage.box)
    for place, value in zip(stage.framed(), theta):
        values[place] = arb(value)
    equation = stage.equation(values, index)
    delay = Fraction(float(values[len(stage.terms)])) if stage.delay is None else Fraction(stage.delay)
    state = [values[stage.start(first, k)] if k < stage.size else ZERO for k in range(3)]
    instants = sorted({Fraction(t) for t in record.time[begin:]} | {Fraction(t) + delay for t in record.switched})
    now, found = Fraction(record.time[begin]), {begin: state[0]}
    for t in instants:
        if t > now:
            u = record.levels[sum(Fraction(s) + delay <= now for s in record.switched)]
            state, now = exact_motion(equation, state, arb(u), ball(t - now)), t
        if t in record.time:
            found[record.time.index(float(t))] = state[0]
    return {k: x for k, x in found.items() if begin <= k <= end}


def enclosure(stage, theta, share, lower=None, aside=0.0, radii=None):
    """Over a box about a parameter, or aside of it by so many radii."""
    places = stage.framed()
    radii = radii or [share * max(abs(v), 0.1) for v in theta]
    lower = lower or [[0.0] * r for r in range(len(places))]
    centre = [v - aside * r for v, r in zip(theta, radii)]
    frame = Frame(places, centre, lower)
    z = [((aside - 1) * r, (aside + 1) * r) for r in radii]
    sides = list(stage.box)
    for row, place in enumerate(places):
        sides[place] = frame.side(row, z)
    return Enclosure(stage, Box(sides, frame, z), frame, bounded.whole(stage.windows)), centre, radii


def misfits(stage, found, centre, lower, z, index=0):
    """What outputs of one parameter are off the polynomials, over the rests; and the largest."""
    exact = [arb(c) for c in centre]
    theta = [c + arb(own) + sum((arb(m) * arb(other) for m, other in zip(row, z)), ZERO) for c, own, row in zip(exact, z, lower)]
    w = arb_mat([[arb(own) - m] for own, m in zip(z, found.middle)])
    first = next(window for window, item in enumerate(stage.windows) if item[0] == index)
    worst = largest = 0.0
    rest = 0.0
    for sample, output in outputs(stage, theta, index).items():
        poly = found.rows["reading", first, sample, True]
        value = poly.c + stage.records[index].error + (poly.l * w)[0, 0]
        if poly.q is not None:
            value += (w.transpose() * (poly.q * w))[0, 0]
        off = output - value
        assert poly.rest.union(ZERO).is_finite()
        if not poly.rest.overlaps(off):
            worst = max(worst, 2.0)
        largest, rest = max(largest, float(abs(off).upper())), max(rest, float(poly.rest.rad()))
    return worst, largest, rest


def corners(radii, count, aside=0.0, seed=1):
    chosen = random.Random(seed)
    for trial in range(count):
        ends = [chosen.choice([-1.0, 1.0]) if trial % 2 == 0 else chosen.uniform(-1, 1) for _ in radii]
        yield [(aside + e * (1 - 2**-30)) * r for e, r in zip(ends, radii)]


def slanted(count):
    return [[0.3 * (-1) ** (r + c) / (1 + r - c) for c in range(r)] for r in range(count)]


@pytest.mark.parametrize("delay", [0.25, None])
@pytest.mark.parametrize("kind", TERMS)
def test_motions_are_held(kind, delay):
    # With the delay unknown samples lie within, at the end and outside of the spans in which the command is either level.
    stage = stage_of(certificate(TERMS[kind], delay))
    theta = truth_of(TERMS[kind], delay)
    lower = slanted(len(theta))
    found, centre, radii = enclosure(stage, theta, 0.004, lower)
    for z in corners(radii, 2 if kind == "lag" else 4):
        worst, largest, rest = misfits(stage, found, centre, lower, z)
        assert worst == 0 and rest < 0.01


@pytest.mark.parametrize("kind", ["linear", "mixed"])
def test_ranges_without_zero_hold_motions(kind):
    stage = stage_of(certificate(TERMS[kind]))
    theta = truth_of(TERMS[kind])
    lower = slanted(len(theta))
    straight = [[0.0] * r for r in range(len(theta))]
    found, centre, radii = enclosure(stage, theta, 0.004, straight, 5.0)
    about, _, _ = enclosure(stage, theta, 0.004, straight)
    for z in corners(radii, 4, 5.0):
        assert misfits(stage, found, centre, straight, z)[0] == 0
    # About the middle the rest is what it is of a box about its centre.
    name = "reading", 0, 70, True
    assert float(found.rows[name].rest.rad()) < 1.2 * float(about.rows[name].rest.rad())
    found, centre, radii = enclosure(stage, theta, 0.002, lower, -3.0)
    for z in corners(radii, 2, -3.0):
        assert misfits(stage, found, centre, lower, z)[0] == 0


def test_two_records_have_their_own_motions():
    stage = stage_of(certificate(TERMS["mixed"], records=2, until=6.0))
    theta = truth_of(TERMS["mixed"], records=2)
    theta[4], theta[6] = 0.05, 0.2
    lower = slanted(len(theta))
    found, centre, radii = enclosure(stage, theta, 0.004, lower)
    for z in corners(radii, 2):
        assert all(misfits(stage, found, centre, lower, z, index)[0] == 0 for index in (0, 1))


@pytest.mark.parametrize("kind", ["linear", "quadratic", "mixed", "spring", "lag"])
def test_the_rest_is_of_the_third_order(kind):
    stage = stage_of(certificate(TERMS[kind]))
    theta = truth_of(TERMS[kind])
    straight = [[0.0] * r for r in range(len(theta))]
    rests = []
    for share in (0.008, 0.004, 0.002):
        found, _, _ = enclosure(stage, theta, share, straight)
        rests.append(float(found.rows["reading", 0, 76, True].rest.rad()))
    assert all(6.5 < a / b < 13 for a, b in zip(rests, rests[1:])), rests


def held(kind, delay=0.25, share=0.01):
    stage = stage_of(certificate(TERMS[kind], delay))
    theta = truth_of(TERMS[kind], delay)
    lower = slanted(len(theta))
    found, centre, radii = enclosure(stage, theta, share, lower)
    return all(misfits(stage, found, centre, lower, z)[0] == 0 for z in corners(radii, 4))


def flat(poly):
    return Poly(poly.space, poly.c, poly.l, None, poly.rest)


def without_squares(monkeypatch):
    product = Poly.__mul__
    monkeypatch.setattr(Poly, "__mul__", lambda a, b: flat(product(a, b)))


def without_strays(monkeypatch):
    monkeypatch.setattr(Strays, "moved", lambda self, gain, added: self)


def without_the_kink(monkeypatch):
    monkeypatch.setattr(second_order, "beyond", lambda v, sign: ZERO)


def without_the_span(monkeypatch):
    fraction = second_order.exact
    monkeypatch.setattr(second_order, "exact", lambda x: round(fraction(x) * 100) / Fraction(100))


@pytest.mark.parametrize("kind", ["linear", "mixed"])
@pytest.mark.parametrize("wrong", [without_squares, without_strays])
def test_without_a_part_corners_are_missed(kind, wrong, monkeypatch):
    assert held(kind)
    wrong(monkeypatch)
    assert not held(kind)


def test_a_crossing_without_its_doubt_misses_motions(monkeypatch):
    # Of all that is unknown it is the velocity at the beginning, of either sign.
    terms = {"gain": 1.0, "quadratic": 0.1}
    stage, theta = stage_of(certificate(terms, until=3.0)), [1.0, 0.1, 0.02, 0.0, 0.0]
    straight = [[0.0] * r for r in range(5)]

    def all_held():
        found, centre, radii = enclosure(stage, theta, 0, straight, 0.0, [1e-9] * 4 + [0.3])
        return all(misfits(stage, found, centre, straight, z)[0] == 0 for z in corners(radii, 12))

    assert all_held()
    without_the_kink(monkeypatch)
    assert not all_held()


def test_switchings_at_one_instant_miss_motions(monkeypatch):
    assert held("linear", None, 0.01)
    without_the_span(monkeypatch)
    assert not held("linear", None, 0.01)


RADII = [0.002, 0.002, 0.002, 0.0009, 0.02]
SLANT = [[], [0.5], [0.25, -0.5], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0, -1.5]]
TIGHT = 0.001


def by_readings(above):
    """The velocity at the beginning by how far the vehicle gets in a second."""
    y = 0.5 / (1 - 2.718281828459045**-0.5)
    return [[{"reading": {"window": 0, "sample": k, "above": own}}, y] for k, own in ((14, above), (6, not above))]


@pytest.fixture(autouse=True)
def hats_that_show_anything(monkeypatch):
    """They, and how a problem is posed, have tests of their own."""
    monkeypatch.setattr(bounded, "posed", lambda item: (item["records"], item, item["stages"][0]["delay_s"], ("", "")))
    monkeypatch.setattr(bounded.Hats, "show", lambda hats, box, kind, what: None if kind == "exclude" else what["cuts"])


def of_steps(*steps, narrowed=True):
    """A proof over a box about the truth, to which a step by hats leads; readings without errors."""
    item = certificate(TERMS["linear"])
    item["records"][0].update(error=TIGHT, switched_s=[[2.0 + 2.5 * i] * 2 for i in range(5)])
    stage, theta = stage_of(item), truth_of(TERMS["linear"])
    for sample, x in outputs(stage, theta).items():
        item["records"][0]["reading"][sample] = float(x.mid())
    cuts = []
    for place, value, radius in zip(stage.framed(), theta, RADII):
        cuts += [{"unknown": place, "upper": upper, "end": value + radius * sign, "rows": []} for upper, sign in ((True, 1), (False, -1))]
    item["stages"][0]["left"] = [[v - 1.01 * r, v + 1.01 * r] for v, r in zip(theta[:3], RADII)]
    item["stages"][0]["steps"] = [{"contract": {"by": {"hats": 1}, "cuts": cuts}}] * narrowed + list(steps)
    return item


def frame():
    return {"centre": truth_of(TERMS["linear"]), "lower": SLANT}


def cut(unknown, upper, end, rows=()):
    return {"unknown": unknown, "upper": upper, "end": end, "rows": list(rows)}


def speed(upper, end):
    return cut(4, upper, 0.3 + (end if upper else -end), by_readings(upper))


def source(by):
    """All windows, where a motion is followed."""
    return by if by == "same" else {by: 99}


def contract(by, *cuts):
    return {"contract": {"by": source(by), "cuts": list(cuts)}}


def turn(by, into, *cuts):
    return {"turn": {"by": source(by), "frame": into, "cuts": list(cuts)}}


def exclude(by, rows=()):
    return {"exclude": {"by": source(by), "rows": list(rows)}}


def part(coordinate, at):
    return {"part": {"coordinate": coordinate, "at": at}}


def divide(unknown, at):
    return {"divide": {"unknown": unknown, "at": at}}


# What two readings leave of the velocity at the beginning, drag and inertia being as uncertain as they are.
REACHED = 0.0055
BEFORE = contract("slanted", speed(True, REACHED))
ROWS = by_readings(True)

ACCEPTED = {
    "contract": (BEFORE, contract("same", speed(False, REACHED)), "keep"),
    "by the box itself": (contract("slanted", cut(0, True, 1.0021)), "keep"),
    "turn": (turn("slanted", frame(), cut(4, True, 0.009, ROWS)), "keep"),
    "turn by the same": (BEFORE, turn("same", frame()), "keep"),
    "turn in the frame": (turn("slanted", frame()), turn("slanted", None, cut(4, True, 0.009, ROWS)), contract("same"), "keep"),
    "part": (turn("slanted", frame()), part(4, 0.001), "keep", contract("slanted"), contract("same"), "keep"),
    "part and divide": (
        turn("slanted", frame()),
        contract("slanted"),
        part(1, 0.0),
        divide(0, 1.0),
        "keep",
        contract("same"),
        "keep",
        "keep",
    ),
    "nothing in common": (
        turn("slanted", frame()),
        part(1, 0.0),
        contract("hats", cut(1, False, 0.5005)),
        contract("hats", cut(0, True, 1.0005)),
        exclude("slanted"),
        "keep",
    ),
    "a coordinate of nothing": (turn("slanted", frame()), part(0, 0.0), turn("slanted", None, cut(0, True, 0.0)), "keep", "keep"),
}


@pytest.mark.parametrize("name", ACCEPTED)
def test_steps_are_accepted(name):
    steps = ACCEPTED[name]
    _, verified, by_hats, taken = bounded.check(of_steps(*steps))
    motions = [s for s in steps if not isinstance(s, str) and next(iter(s)) not in ("part", "divide")]
    assert verified + by_hats + taken == len(motions) + 1


REFUSED = {
    "a range that is not empty": (contract("slanted", cut(4, True, 0.1, ROWS)), "keep"),
    "a coordinate's that is not empty": (turn("slanted", frame(), cut(4, True, -0.1, ROWS)), "keep"),
    "the same without a motion": (contract("same"), "keep"),
    "the same of another frame": (BEFORE, turn("same", frame()), contract("same"), "keep"),
    "a part without a frame": (part(0, 0.0), "keep", "keep"),
    "a part outside of its range": (turn("slanted", frame()), part(0, 1.0), "keep", "keep"),
    "a part left over": (turn("slanted", frame()), part(0, 0.0), "keep"),
    "a turn into no frame": (turn("slanted", None), "keep"),
    "a turn by other rows": (turn("chain", frame()), "keep"),
    "a frame that is not triangular": (turn("slanted", frame() | {"lower": [[1.0]] + SLANT[1:]}), "keep"),
    "a frame of too few": (turn("slanted", {"centre": frame()["centre"][:4], "lower": SLANT[:4]}), "keep"),
    "an unknown of no frame": (contract("slanted", cut(9, True, 1.0)), "keep"),
    "a negative multiplier": (contract("slanted", cut(4, True, 0.31, [[ROWS[0][0], -1.0]])), "keep"),
    "a row of another sample": (exclude("slanted", [[{"reading": {"window": 0, "sample": 5, "above": True}}, 1.0]]),),
    "no contradiction": (exclude("slanted", ROWS),),
    "something in common": (turn("slanted", frame()), part(0, 0.0), "keep", exclude("slanted")),
}


@pytest.mark.parametrize("name", REFUSED)
def test_steps_are_refused(name):
    with pytest.raises(Refused):
        bounded.check(of_steps(*REFUSED[name]))


TOO_MUCH = {
    "by rows": ((contract("slanted", speed(True, REACHED / 2)),), lambda box: box.sides[4][1], (0.3 + REACHED / 2, 0.3 + REACHED)),
    "by rows of the same": (
        (BEFORE, contract("same", speed(False, REACHED / 2))),
        lambda box: -box.sides[4][0],
        (REACHED / 2 - 0.3, REACHED - 0.3),
    ),
    "of a coordinate": ((turn("slanted", frame(), cut(4, True, 0.002, ROWS)),), lambda box: box.z[4][1], (0.002, 0.009)),
    "of a coordinate, by no rows": ((turn("slanted", frame(), cut(4, True, 0.009)),), lambda box: box.z[4][1], (0.009, 0.05)),
    "by the box itself": ((contract("slanted", cut(0, True, 1.0019)),), lambda box: box.sides[0][1], (1.0019, 1.0021)),
}


@pytest.mark.parametrize("name", TOO_MUCH)
def test_a_cut_that_says_too_much_goes_as_far_as_is_shown(name):
    steps, end, (stated, shown) = TOO_MUCH[name]
    item = of_steps(*steps)
    stage = stage_of(item)
    walk, boxes = bounded.Walk(stage, "stage"), [Box(stage.box)]
    for step in item["stages"][0]["steps"]:
        boxes += walk.step(boxes.pop(), step)
    (box,) = boxes
    assert stated < end(box) <= shown


def test_a_reading_that_is_off_contradicts():
    rows = [[{"reading": {"window": 0, "sample": k, "above": own}}, 1.0] for k, own in ((30, False), (6, True))]
    item = of_steps(exclude("slanted", rows))
    with pytest.raises(Refused):
        bounded.check(item)
    item["records"][0]["reading"][30] += 0.2
    item["stages"][0].update(left=None)
    item["statement"] = bounded.statement(True, False, ("", ""))
    bounded.check(item)


def test_what_is_left_may_be_what_the_frame_leaves():
    item = of_steps()
    item["stages"][0]["left"] = [[0.998, 1.002], [0.498, 0.5012], [0.018, 0.022]]
    stage = stage_of(item)
    sides = list(stage.box)
    sides[:3] = [(0.998, 1.002), (0.498, 0.502), (0.018, 0.022)]
    tied = Frame(stage.framed(), truth_of(TERMS["linear"]), [[], [3.0]] + [[0.0] * r for r in (2, 3, 4)])
    z = [(-1.0, 1.0), (-0.008, -0.005)] + [(-9.0, 9.0)] * 3
    walk = bounded.Walk(stage, "stage")
    assert walk.step(Box(sides, tied, z), "keep") == []
    for box in (Box(sides), Box(sides, tied, [z[0], (-0.008, -0.004), *z[2:]])):
        with pytest.raises(Refused):
            walk.step(box, "keep")


def test_meeting_narrows_axes_and_coordinates():
    frame_ = Frame([0, 1], [1.0, 2.0], [[], [10.0]])
    box = Box([(0.0, 2.0), (1.0, 3.0)], frame_, [(-1.0, 1.0), (-1.0, 1.0)]).met()
    assert [(float(a), float(b)) for a, b in box.sides] == [(0.0, 2.0), (1.0, 3.0)]
    box = Box([(1.5, 2.0), (1.0, 3.0)], frame_, [(-1.0, 1.0), (-5.0, 1.0)]).met()
    assert [(float(a), float(b)) for a, b in box.z] == [(0.5, 1.0), (-5.0, -4.0)]
    assert [(float(a), float(b)) for a, b in box.sides] == [(1.5, 2.0), (2.0, 3.0)]
    assert Box([(1.5, 2.0), (1.0, 3.0)], frame_, [(-1.0, 1.0), (-1.0, 1.0)]).met() is None
