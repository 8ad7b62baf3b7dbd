"""Hats and speeds over motions that are known, and false variants of each part, which known motions contradict."""

import math
import random

import pytest

import bounded
import modulating
import velocities
from check import Refused

INSIDE = 0.999
PIECES = 8
DRAGS = {
    "linear": {"linear": (0.7, 0.4, 1.6)},
    "driving": {"linear": (-0.3, -0.6, 0.4), "quadratic": (0.9, 0.5, 1.4)},
    "quadratic": {"quadratic": (1.1, 0.6, 2.0)},
    "mixed": {"linear": (1.2, 0.8, 1.9), "quadratic": (0.7, 0.4, 1.1)},
    "cubic": {"linear": (0.4, 0.2, 0.8), "cubic": (0.9, 0.5, 1.4)},
    "lag": {"linear": (0.7, 0.4, 1.6), "lag_rate": (6.0, 5.5, 9.0)},
    "spring": {"linear": (0.6, 0.3, 0.9), "stiffness": (0.25, 0.1, 0.5)},
}
# Velocities are known so much too low and too high where tangents are to be seen.
UNSURE = dict.fromkeys(DRAGS, (0.0, 0.0)) | {"quadratic": (0.6, 0.05), "cubic": (0.6, 0.05), "mixed": (0.6, 0.05)}
LATE = ("linear", "mixed", "spring", "lag")


def rate(values, middle, state, u):
    x, v, f = state
    f = f if "lag_rate" in values else u
    drag = values.get("linear", 0) * v + values.get("quadratic", 0) * (abs(v) - 2 * middle) * v + values.get("cubic", 0) * v**3
    return v, values["gain"] * f + values["disturbance"] - drag - values.get("stiffness", 0) * x, values.get("lag_rate", 0) * (u - f)


def moved(values, middle, state, u, h):
    """By the classical Runge-Kutta method; linear drag alone in closed form."""
    if set(values) == {"gain", "disturbance", "linear"}:
        (x, v, f), b = state, values["linear"]
        steady, gone = (values["gain"] * u + values["disturbance"]) / b, -math.expm1(-b * h)
        return x + steady * h + (v - steady) * gone / b, steady + (v - steady) * (1 - gone), f
    parts = max(1, math.ceil(h / 0.004))
    h /= parts
    for _ in range(parts):
        rates = [rate(values, middle, state, u)]
        for part in (0.5, 0.5, 1.0):
            rates.append(rate(values, middle, [z + part * h * r for z, r in zip(state, rates[-1])], u))
        state = [z + h / 6 * (a + 2 * b + 2 * c + d) for z, a, b, c, d in zip(state, *rates)]
    return state


class Known:
    """A motion, its readings, a box around its parameters, and what is enclosed over it."""

    def __init__(self, drag, seed, delayed=False, error=1e-5, wide=1.0):
        rng = random.Random(f"{drag} {seed}")
        self.rng, terms = rng, DRAGS[drag]
        middle = 0.45 if {"linear", "quadratic"} <= set(terms) else 0.0
        true = {"gain": rng.uniform(0.8, 1.3)}
        true |= {name: rng.uniform(value, 0.5 * (value + high)) for name, (value, _, high) in terms.items()}
        disturbance, delay = rng.uniform(-0.1, 0.2), rng.uniform(0.1, 0.3)
        times = sorted(0.1 * k + rng.uniform(0, 0.03) for k in range(110))
        switched = [1.5 + 1.9 * k + rng.uniform(0, 0.3) for k in range(4)]
        levels = [1.0, -0.9, 1.1, -1.0, 0.8]
        state, now = (0.2, rng.uniform(-0.6, 0.6), rng.uniform(-0.9, 0.9)), times[0]
        self.speeds, self.between, xs = [state[1]], [], [state[0]]
        for end in times[1:]:
            passed = []
            stops = [now + (end - now) * (k + 1) / PIECES for k in range(PIECES)]
            for stop in sorted(stops + [t + delay for t in switched if now < t + delay < end]):
                force = levels[sum(t + delay <= now for t in switched)]
                state, now = moved(true | {"disturbance": disturbance}, middle, state, force, stop - now), stop
                passed.append(state[1])
            self.between.append(passed)
            self.speeds.append(state[1])
            xs.append(state[0])
        readings = [x + INSIDE * error * rng.choice((-1, 1, rng.uniform(-1, 1))) for x in xs]
        span = lambda value, low, high: [value - wide * (value - low), value + wide * (high - value)]
        box = [span(true["gain"], 0.5, 2.0)] + [span(true[name], low, high) for name, (_, low, high) in terms.items()]
        self.theta = [true["gain"], *(true[name] for name in terms)] + ([delay] if delayed else []) + [disturbance]
        if delayed:
            box.append([delay, delay + 0.04] if seed % 2 else [delay - 0.04, delay])
        box.append(span(disturbance, -0.3, 0.4))
        record = {"time_s": times, "reading": readings, "error": error, "jitter_s": 0.0, "levels": levels}
        record["switched_s"] = [[t, t] for t in switched]
        certificate = {"terms": ["gain", *terms], "middle_speed": middle, "least_linear": -2.0, "fastest": 3.0}
        item = {"delay_s": None if delayed else delay, "shooting": [[0, 4, len(times) - 1]], "from": box, "left": None, "steps": []}
        self.stage = bounded.Stage(certificate, [bounded.Record(record)], item)
        self.modulating = modulating.Modulating(self.stage)
        self.count = len(times)
        assert all(low <= value <= high for value, (low, high) in zip(self.theta, box))

    def hat(self):
        first = self.rng.choice((self.modulating.tracks[0].first, self.rng.randrange(4, self.count - 24)))
        middle = first + self.rng.randrange(1, 12)
        return [first, middle, middle + self.rng.randrange(1, 12)]

    def combination(self, most):
        row = lambda: {"modulated": {"record": 0, "samples": self.hat(), "above": self.rng.random() < 0.5}}
        return [[row(), self.rng.uniform(0.1, 3)] for _ in range(self.rng.randint(1, most))]

    def at_truth(self):
        """The box shrunk to the truth in all but the delay and the lag's rate."""
        keep = self.modulating.late_by()
        box = [side if place in keep else (value, value) for place, (value, side) in enumerate(zip(self.theta, self.stage.box))]
        return box + list(self.stage.box[len(box) :])


def missed(known, most=3, tries=20, unsure=(0.0, 0.0)):
    """How many inequalities by multipliers the truth contradicts: over the box, and over the box but for the truth of the terms."""
    speeds, misses = known.modulating.speeds(known.stage.box), 0
    speeds[0].between = [(a - unsure[0], b + unsure[1]) for a, b in speeds[0].between]
    for box in (known.stage.box, known.at_truth()):
        for _ in range(tries):
            place, sign = known.rng.randrange(len(known.theta)), known.rng.choice((1, -1))
            bound = known.modulating.bound(box, speeds, (place, sign), known.combination(most))
            misses += bool(bound < sign * known.theta[place] - 1e-9)
    return misses


def outside(known):
    """Whether a true velocity is outside of its enclosure, or nothing is left."""
    try:
        (speeds,) = known.modulating.speeds(known.stage.box)
    except modulating.Nothing:
        return True
    first = known.modulating.tracks[0].first
    true, between = known.speeds[first:], known.between[first:]
    at = any(not a - 1e-9 <= v <= b + 1e-9 for a, v, b in zip(speeds.low, true, speeds.high))
    return at or any(not a - 1e-9 <= v <= b + 1e-9 for (a, b), passed in zip(speeds.between, between) for v in passed)


CASES = [(drag, delayed) for drag in DRAGS for delayed in (False, True) if not delayed or drag in LATE]


@pytest.mark.parametrize("drag, delayed", CASES)
def test_known_motions_meet_all_that_is_shown(drag, delayed):
    for seed in range(2):
        known = Known(drag, seed, delayed, error=10.0 ** -(2 + 2 * seed), wide=1.0 - 0.6 * seed)
        assert not outside(known)
        assert missed(known) == 0


def without_errors(patch):
    """Velocities are what they were."""
    bound = modulating.Modulating.bound

    def changed(self, box, speeds, *others):
        (track,) = self.tracks
        error, track.error = track.error, modulating.ZERO
        found = bound(self, box, speeds, *others)
        track.error = error
        return found

    patch.setattr(modulating.Modulating, "bound", changed)


def without_rest(patch):
    init = modulating.Tangent.__init__

    def changed(self, *args):
        init(self, *args)
        self.rest = modulating.NONE

    patch.setattr(modulating.Tangent, "__init__", changed)


def at_mean_throughout(patch):
    intervals = modulating.Weight.intervals
    patch.setattr(modulating.Weight, "intervals", lambda self: ((k, mean, area, modulating.ZERO) for k, mean, area, _ in intervals(self)))


def early_instead_of_late(patch):
    middle = modulating.middle_of
    patch.setattr(modulating, "middle_of", lambda ends: -middle(ends))


def without_the_delays_range(patch):
    pushed, behind = modulating.Modulating.pushed, modulating.Modulating.behind
    changed = lambda whole, force, by_delay, *by_rate: (force, force, modulating.NONE, *by_rate)
    patch.setattr(modulating.Modulating, "pushed", lambda *args: changed(*pushed(*args)))
    patch.setattr(modulating.Modulating, "behind", lambda *args: changed(*behind(*args)))


def with_the_other_slope_by_the_delay(patch):
    pushed = modulating.Modulating.pushed
    changed = lambda whole, force, by_delay: (whole, force, modulating.minus(by_delay))
    patch.setattr(modulating.Modulating, "pushed", lambda *args: changed(*pushed(*args)))


def without_the_middle_speed(patch):
    init = modulating.Tangent.__init__
    patch.setattr(modulating.Tangent, "__init__", lambda self, low, high, middle=None: init(self, low, high, middle and modulating.ZERO))


def prompt_instead_of_late(patch):
    patch.setattr(modulating.Modulating, "behind", lambda self, weight, speeds: (*self.pushed(weight, speeds.axis), modulating.NONE))


def by_the_middle_rate(patch):
    behind = modulating.Modulating.behind
    changed = lambda whole, force, by_delay, by_rate: (force, force, by_delay, modulating.NONE)
    patch.setattr(modulating.Modulating, "behind", lambda *args: changed(*behind(*args)))


def nothing_before(patch):
    behind = modulating.Modulating.behind

    def changed(self, weight, speeds):
        first, speeds.first_force = speeds.first_force, (modulating.arb(speeds.track.record.levels[0]),) * 2
        found = behind(self, weight, speeds)
        speeds.first_force = first
        return found

    patch.setattr(modulating.Modulating, "behind", changed)


def every_area_above(patch):
    parts = modulating.Weight.parts
    patch.setattr(modulating.Weight, "parts", lambda self, k: (sum(parts(self, k), modulating.ZERO), modulating.ZERO))


FALSE_HATS = [
    (without_errors, "linear", False),
    (without_rest, "quadratic", False),
    (without_rest, "cubic", False),
    (at_mean_throughout, "linear", False),
    (early_instead_of_late, "linear", False),
    (without_the_delays_range, "linear", True),
    (with_the_other_slope_by_the_delay, "linear", True),
    (without_the_middle_speed, "mixed", False),
    (prompt_instead_of_late, "lag", False),
    (by_the_middle_rate, "lag", False),
    (without_the_delays_range, "lag", True),
    (nothing_before, "lag", False),
    (every_area_above, "quadratic", False),
]


@pytest.mark.parametrize("change, drag, delayed", FALSE_HATS, ids=[f"{c.__name__}-{d}-{late}" for c, d, late in FALSE_HATS])
def test_false_hats_are_contradicted(change, drag, delayed, monkeypatch):
    error = 1e-3 if change is without_errors else 1e-7
    wide = 0.05 if delayed or change is nothing_before else 1.0
    misses = lambda: missed(Known(drag, 1, delayed, error, wide), most=2, tries=100, unsure=UNSURE[drag])
    assert misses() == 0
    change(monkeypatch)
    assert misses() > 0


def test_the_weighed_position_is_enclosed_and_by_chords_alone_it_is_not():
    # A motion that is back at the same place at every sample.
    record = bounded.Record(
        {"time_s": [0.1 * k for k in range(40)], "reading": [0.0] * 40, "error": 1e-9, "jitter_s": 0.0, "levels": [1.0], "switched_s": []}
    )
    track, turns = velocities.Track(record, 0), 20 * math.pi
    for l, m, r in ((0, 3, 9), (5, 6, 8), (11, 20, 31)):
        weight = modulating.Weight(track, [((l, m, r), modulating.arb(1))])
        # `int W (1 - cos)` is that of one: the hat's corners are at whole turns.
        exact = modulating.arb(record.time[r] - record.time[l]) / 2
        within = lambda fastest: modulating.Weighed(weight, Between([(-fastest, fastest)] * 39)).place()
        low, high = within(modulating.arb(turns))
        assert low <= exact - 1e-6 and exact + 1e-6 <= high
        low, high = within(modulating.ZERO)
        assert high < exact


class Between:
    def __init__(self, between):
        self.between = between


def errors_left_out(patch):
    init = velocities.Track.__init__

    def changed(self, record, first):
        error, record.error = record.error, 0.0
        init(self, record, first)
        record.error = error

    patch.setattr(velocities.Track, "__init__", changed)


def one_way_throughout(patch):
    patch.setattr(velocities.Speeds, "even_times", lambda self: [[0, self.track.count - 1, 0]])


def without_pushes(patch):
    brakes = velocities.Speeds.brakes_only
    patch.setattr(velocities.Speeds, "brakes_only", lambda self, up, down: brakes(self, [modulating.ZERO] * len(up), [modulating.ZERO] * len(down)))


def without_drag(patch):
    patch.setattr(velocities.Axis, "most", lambda self, a, b: modulating.ZERO)


def with_the_least_drag(patch):
    most = velocities.Axis.most
    patch.setattr(velocities.Axis, "most", lambda self, a, b: -most(self, -a, -a))


def without_what_drives(patch):
    init = velocities.Axis.__init__

    def changed(self, *args):
        init(self, *args)
        self.driving = modulating.ZERO
        self.own = tuple(max(end, modulating.ZERO) for end in self.own)

    patch.setattr(velocities.Axis, "__init__", changed)


def by_the_earliest_delay(patch):
    acting = velocities.Speeds.acting

    def changed(self):
        delay, self.axis.delay = self.axis.delay, (self.axis.delay[0],) * 2
        found = acting(self)
        self.axis.delay = delay
        return found

    patch.setattr(velocities.Speeds, "acting", changed)


def between_the_ends(patch):
    patch.setattr(velocities, "lowest_between", lambda a, b, rates, lasted: min(a, b))


def the_spring_left_out(patch):
    patch.setattr(velocities.Speeds, "pushes", lambda self: self.pushed)


FALSE_SPEEDS = [
    (errors_left_out, "linear", False),
    (one_way_throughout, "quadratic", False),
    (without_pushes, "linear", False),
    (without_drag, "cubic", False),
    (with_the_least_drag, "mixed", False),
    (without_what_drives, "driving", False),
    (by_the_earliest_delay, "linear", True),
    (between_the_ends, "spring", False),
    (the_spring_left_out, "spring", False),
]


@pytest.mark.parametrize("change, drag, delayed", FALSE_SPEEDS, ids=[f"{c.__name__}-{d}" for c, d, _ in FALSE_SPEEDS])
def test_false_speeds_miss_known_ones(change, drag, delayed, monkeypatch):
    error, wide = 1e-2 if change is errors_left_out else 1e-4, 1.0 if change is errors_left_out else 0.05
    caught = lambda: [outside(Known(drag, seed, delayed, error, wide)) for seed in (1, 2)]
    assert not any(caught())
    change(monkeypatch)
    assert any(caught())


def contradiction(known):
    """Two hats under unlike commands, with multipliers by which a disturbance cancels, over boxes with too little gain."""
    box = known.at_truth()
    gain, record = known.theta[0], known.stage.records[0]
    box[0] = (0.3 * gain, 0.6 * gain)
    box[known.stage.common] = (-5.0, 5.0)
    for at in range(10, known.count - 20):
        for other in range(10, known.count - 20):
            hat, against = [at, at + 6, at + 12], [other, other + 6, other + 12]
            areas = [record.time[h[2]] - record.time[h[0]] for h in (hat, against)]
            rows = [[{"modulated": {"record": 0, "samples": h, "above": a}}, 1 / area] for h, a, area in zip((hat, against), (False, True), areas)]
            yield box, rows


def ends(cuts):
    return [cut["end"] for cut in cuts]


def test_a_contradiction_needs_all_its_hats_and_a_cut_says_no_more_than_they_show():
    known = Known("mixed", 1)
    (speeds,) = [known.modulating.speeds(known.stage.box)]
    sharp = sorted((float(known.modulating.bound(box, speeds, None, rows)), n) for n, (box, rows) in enumerate(contradiction(known)) if n % 97 == 0)
    found = list(contradiction(known))[sharp[0][1]]
    assert sharp[0][0] < 0
    box, rows = found
    # The velocities of the whole box hold over a part of it.
    known.modulating.speeds = lambda box: speeds
    assert known.modulating.show(box, "exclude", {"rows": rows}) is None
    for kept in ([], rows[:1], rows[1:], [[rows[0][0], -rows[0][1]], rows[1]], [[rows[0][0], 3 * rows[0][1]], rows[1]]):
        with pytest.raises(Refused):
            known.modulating.show(box, "exclude", {"rows": kept})
    place = known.stage.common
    shown = float(known.modulating.bound(box, speeds, (place, 1), rows[1:]))
    cut = lambda end: {"cuts": [{"unknown": place, "upper": True, "end": end, "rows": rows[1:]}]}
    assert ends(known.modulating.show(box, "contract", cut(shown + 1e-9))) == [shown + 1e-9]
    assert ends(known.modulating.show(box, "contract", cut(shown - 1e-9))) == pytest.approx([shown], rel=1e-14)
    assert ends(known.modulating.show(box, "contract", cut(shown - 1e-9)))[0] >= shown


def test_a_beginning_says_no_more_than_its_speeds():
    known = Known("linear", 2)
    place = known.stage.start(0, 1)
    end = float(known.modulating.speeds(known.stage.box)[0].high[4 - known.modulating.tracks[0].first])
    cut = lambda end: {"cuts": [{"unknown": place, "upper": True, "end": end, "rows": []}]}
    assert ends(known.modulating.show(known.stage.box, "contract", cut(end + 1e-9))) == [end + 1e-9]
    assert ends(known.modulating.show(known.stage.box, "contract", cut(end - 1e-9)))[0] >= end


def test_a_hat_is_verified_where_all_commands_are_known_be_that_before_the_first_window():
    known = Known("linear", 2)
    first = known.modulating.tracks[0].first
    assert 0 < first < 4
    hat = lambda l: {"rows": [[{"modulated": {"record": 0, "samples": [l, 6, 9], "above": True}}, 1.0]]}
    with pytest.raises(Refused):
        known.modulating.show(known.stage.box, "exclude", hat(first))
    with pytest.raises(modulating.Unsupported):
        known.modulating.show(known.stage.box, "exclude", hat(first - 1))
