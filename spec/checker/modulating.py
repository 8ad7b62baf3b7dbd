"""Steps by hats: the equation of motion weighed over stretches of a record, over boxes too wide to follow the motion.

For a weight W that is linear between samples and zero at both ends, `int W v'` is by parts `- int W' v`, a sum over positions at samples
by how the slope of W changes there. So `v' = gain f + disturbance - D(v) - stiffness x` becomes

    sum kink_s x_s = gain int W f + disturbance int W - int W D(v) - stiffness int W x,

an equality that every motion meets, linear in the parameters. Multipliers of hats are the weight that is the sum of these hats, each
as often as its multiplier says, so that what hats have in common is in doubt once only. Positions are the readings to within their errors,
`int W v` is by the ways between samples, powers of v are tangents with a range for the rest over the velocities of that interval, and
these are enclosed from readings, the command and the box (`velocities.py`). Only readings from where all commands that act are in the file are
used, be that before the first window, and no speed beyond the certificate's `fastest` is looked for from there on.
"""

from bisect import bisect_right
from fractions import Fraction

from flint import arb, fmpq

from boxes import reached
from check import require
from motion import ZERO
from velocities import Axis, HALF, NONE, Nothing, Speeds, Track, corners, minus, plus


class Unsupported(Exception):
    """What is not verified here."""


class Weight:
    """A sum of hats over the samples of a track: its heights, and by how much its slope changes at each."""

    def __init__(self, track, hats):
        self.track, self.hats, self.kinks = track, hats, {}
        for (l, m, r), factor in hats:
            left, right = factor / (track.stamps[m] - track.stamps[l]), factor / (track.stamps[r] - track.stamps[m])
            for sample, kink in ((l, left), (m, -left - right), (r, right)):
                self.kinks[sample] = self.kinks.get(sample, ZERO) + kink
        self.first, self.last = min(self.kinks), max(self.kinks)
        self.heights, self.slopes, self.areas = {self.first: ZERO}, {}, {self.first: ZERO}
        slope = ZERO
        for k in range(self.first, self.last):
            slope += self.kinks.get(k, ZERO)
            lasted = track.lasted[k]
            self.slopes[k], self.heights[k + 1] = slope, self.heights[k] + slope * lasted
            self.areas[k + 1] = self.areas[k] + HALF * lasted * (self.heights[k] + self.heights[k + 1])
        self.area = self.areas[self.last]

    def at(self, instant):
        """The height at an instant, a fraction, and the area after it."""
        k = bisect_right(self.track.instant, instant) - 1
        if k < self.first:
            return ZERO, self.area
        if k >= self.last:
            return ZERO, ZERO
        since = number(instant - self.track.instant[k])
        height = self.heights[k] + self.slopes[k] * since
        return height, self.area - self.areas[k] - HALF * since * (self.heights[k] + height)

    def during(self, least, most):
        """All heights from one instant to another."""
        k, until = bisect_right(self.track.instant, least), bisect_right(self.track.instant, most)
        heights = [self.at(least)[0], self.at(most)[0]]
        heights += [self.heights[sample] for sample in range(max(k, self.first), min(until, self.last + 1))]
        return min(h.lower() for h in heights), max(h.upper() for h in heights)

    def intervals(self):
        """Each with the weight's mean, its area, and the integral of how far it is from its mean."""
        for k in range(self.first, self.last):
            a, b = self.heights[k], self.heights[k + 1]
            lasted, mean = self.track.lasted[k], HALF * (a + b)
            yield k, mean, mean * lasted, abs(b - a) * lasted / 4

    def parts(self, k):
        """The areas above and below zero in an interval."""
        a, b, lasted = self.heights[k], self.heights[k + 1], self.track.lasted[k]
        if (a > 0 and b < 0) or (a < 0 and b > 0):
            parts = [HALF * lasted * end * end / (abs(a) + abs(b)) for end in (a, b)]
            return (parts[0], parts[1]) if a > 0 else (parts[1], parts[0])
        # Of one sign, but for rounding: what has the other is a triangle at most, and the area is known.
        area = HALF * (a + b) * lasted
        above, below = (HALF * lasted * max(end, ZERO) for end in (max(a.upper(), b.upper()), max(-a.lower(), -b.lower())))
        if below < above:
            below = ZERO.union(below)
            return area + below, below
        above = ZERO.union(above)
        return above, above - area


def number(fraction):
    return arb(fmpq(fraction.numerator, fraction.denominator))


class Tangent:
    """A function of the velocity about a point of a range: `constant + slope v + rest`, the rest from zero up, or down, or both."""

    def __init__(self, low, high, middle_speed=None):
        # Any point will do: a float near the middle.
        p = arb(float((low + high).mid()) / 2)
        far = max(abs(low - p).upper(), abs(high - p).upper())
        if middle_speed is None:
            # v^3 = p^3 + 3 p^2 (v - p) + (v - p)^2 (v + 2 p).
            self.slope, value = 3 * p * p, p**3
            self.rest = min(((low + 2 * p) * far**2).lower(), ZERO), max(((high + 2 * p) * far**2).upper(), ZERO)
        else:
            # |v| v - 2 middle v, whose second derivative is two with the sign of v.
            self.slope, value = 2 * (abs(p) - middle_speed), p * (abs(p) - 2 * middle_speed)
            square = (far**2).upper()
            self.rest = (ZERO if low >= 0 else -square), (ZERO if high <= 0 else square)
        self.constant = value - self.slope * p


class Weighed:
    """Integrals under a weight, over a box, each by its ends: a ball's radius has few digits."""

    def __init__(self, weight, speeds):
        self.weight, self.speeds, self.track = weight, speeds, weight.track

    def of_ways(self, slopes):
        """`int W slope v`, with a slope for every interval: readings' errors sum up by how the weights differ from one to the next."""
        total, errors, off, before = ZERO, ZERO, ZERO, ZERO
        for k, mean, _, differs in self.weight.intervals():
            slope, (low, high) = slopes(k), self.speeds.between[k]
            weight = slope * mean
            total += weight * (self.track.reading[k + 1] - self.track.reading[k])
            errors += abs(weight - before)
            before = weight
            # The weight is not at its mean throughout: what it is more in one half it is less in the other.
            off += abs(slope) * differs * HALF * (high - low)
        off += (errors + abs(before)) * self.track.error
        return (total - off).lower(), (total + off).upper()

    def of_tangents(self, tangent):
        tangents = {k: tangent(*self.speeds.between[k]) for k, *_ in self.weight.intervals()}
        least = most = ZERO
        for k, _, area, _ in self.weight.intervals():
            own, (above, below) = tangents[k], self.weight.parts(k)
            low, high = own.rest
            least += own.constant * area + low * above - high * below
            most += own.constant * area + high * above - low * below
        return plus(self.of_ways(lambda k: tangents[k].slope), (least.lower(), most.upper()))

    def velocity(self):
        return self.of_ways(lambda _: arb(1))

    def place(self):
        """`int W x`: a position is off the chord between samples by a quarter of what velocities differ, times the time, at most."""
        total = off = ZERO
        for k, _, area, _ in self.weight.intervals():
            a, b, lasted = self.track.reading[k], self.track.reading[k + 1], self.track.lasted[k]
            low, high = self.speeds.between[k]
            rise = self.weight.heights[k + 1] - self.weight.heights[k]
            total += HALF * (a + b) * area + rise * (b - a) * lasted / 12
            off += (self.track.error + (high - low) * lasted / 4) * sum(self.weight.parts(k), ZERO)
        return (total - off).lower(), (total + off).upper()


class Modulating:
    """What steps by hats show of a stage's boxes."""

    def __init__(self, stage):
        self.stage = stage
        names = ("quadratic", "cubic", "stiffness", "lag_rate")
        require(all(low >= 0 for name, (low, _) in zip(stage.terms, stage.box) if name in names), "a term's range is negative")
        self.tracks = [Track(record, stage.acted(record)) for record in stage.records]

    def speeds(self, box):
        return [Speeds(self.stage, track, Axis(self.stage, box, n), box, n) for n, track in enumerate(self.tracks)]

    def show(self, box, kind, what):
        """The cuts, each over what those before it leave, as far as they follow; `None` where nothing is left of a box, or Refused."""
        try:
            speeds = self.speeds(box)
        except Nothing:
            return None
        if kind == "exclude":
            require(what["rows"] and self.bound(box, speeds, None, what["rows"]) < 0, "the box is not excluded")
            return None
        box, cuts = list(box), []
        for cut in what["cuts"]:
            place, sign = int(cut["unknown"]), 1 if cut["upper"] else -1
            require(0 <= place < len(box), "no such unknown")
            low, high = box[place]
            by_rows = lambda: self.bound(box, speeds, (place, sign), cut["rows"])
            by_speeds = lambda: sign * self.beginning(speeds, place, sign)
            cut = reached(cut, box[place], by_rows if cut["rows"] else by_speeds)
            if cut is None:
                continue
            cuts.append(cut)
            box[place] = (low, min(high, cut["end"])) if sign > 0 else (max(low, cut["end"]), high)
            if box[place][0] > box[place][1]:
                return None
        return cuts

    def beginning(self, speeds, place, sign):
        """An end of the velocity at a window's beginning."""
        for window, (record, first, _) in enumerate(self.stage.shooting):
            if place == self.stage.start(window, 1):
                sample = first - self.tracks[record].first
                return speeds[record].high[sample] if sign > 0 else speeds[record].low[sample]
        require(False, "no velocity at a window's beginning")

    def bound(self, box, speeds, objective, combination):
        """At least the largest value of an unknown times a sign, or of zero, over what is in a box, from multipliers."""
        stage = self.stage
        total, rest, hats, rows = ZERO, {}, {}, {}
        stage.bound(rows, [ZERO] * len(box))
        if objective:
            rest[objective[0]] = arb(objective[1]), arb(objective[1])
        for origin, y in combination:
            y = float(y)
            require(0 <= y < float("inf"), "a multiplier is negative")
            if isinstance(origin, dict) and "modulated" in origin:
                at = origin["modulated"]
                record, samples = int(at["record"]), [int(n) for n in at["samples"]]
                require(0 <= record < len(self.tracks) and samples == sorted(set(samples)) and len(samples) == 3, "no such hat")
                track = self.tracks[record]
                samples = [n - track.first for n in samples]
                require(samples[2] < track.count, "no such hat")
                if samples[0] < 0:
                    raise Unsupported
                hats.setdefault(record, []).append((samples, arb(y if at["above"] else -y)))
                continue
            slopes, limit = rows[key_of(origin)]
            total += y * limit
            for place, slope in slopes:
                own = (-y * slope).lower(), (-y * slope).upper()
                rest[place] = plus(rest.get(place, NONE), own)
        for record, own in hats.items():
            weight = Weight(self.tracks[record], own)
            value, coefficients = self.weighed(weight, speeds[record], record, objective)
            total += value
            for place, slope in coefficients:
                rest[place] = plus(rest.get(place, NONE), slope)
        for place, slope in rest.items():
            low, high = map(arb, box[place])
            if place in self.late_by():
                # What is known of it is by its difference from its middle.
                middle = middle_of((low, high))
                total += arb(objective[1]) * middle
                low, high = low - middle, high - middle
            total += corners(slope, (low, high))[1]
        return total.upper()

    def late_by(self):
        """What the command comes late by: the places of the delay and of the lag's rate."""
        delay, rate = [] if self.stage.delay is not None else [len(self.stage.terms)], "lag_rate"
        return delay + [place for place, term in enumerate(self.stage.terms) if term == rate]

    def weighed(self, weight, speeds, record, objective):
        """Position's part of the equality under a weight, less all others: a number, and what each unknown multiplies."""
        stage, track, axis = self.stage, weight.track, speeds.axis
        value = sum((kink * track.reading[k] + abs(kink) * track.error for k, kink in weight.kinks.items()), ZERO)
        weighed, area = Weighed(weight, speeds), -weight.area
        coefficients = [(stage.common + record, (area.lower(), area.upper()))]
        for place, term in enumerate(stage.terms):
            if term == "gain":
                whole, force, *slopes = self.pushed(weight, axis) if axis.rate is None else self.behind(weight, speeds)
                for own, slope, ends in zip(self.late_by(), slopes if stage.delay is None else slopes[1:], self.late_ends(axis)):
                    if objective and objective[0] == own:
                        coefficients.append((own, minus(corners(axis.gain, slope))))
                    else:
                        force = plus(force, corners(slope, [end - middle_of(ends) for end in ends]))
                if not (objective and objective[0] in self.late_by()) and whole[1] - whole[0] < force[1] - force[0]:
                    force = whole
                coefficients.append((place, minus(force)))
            elif term == "linear":
                coefficients.append((place, weighed.velocity()))
            elif term == "quadratic":
                coefficients.append((place, weighed.of_tangents(lambda a, b: Tangent(a, b, axis.middle))))
            elif term == "cubic":
                coefficients.append((place, weighed.of_tangents(Tangent)))
            elif term == "stiffness":
                coefficients.append((place, weighed.place()))
        return value, coefficients

    def late_ends(self, axis):
        return ([axis.delay] if self.stage.delay is None else []) + ([axis.rate] if axis.rate is not None else [])

    def pushed(self, weight, axis):
        """`int W f` for all delays, at their middle, and the range of its slope by the delay."""
        record = weight.track.record
        middle, least, most = map(fraction, (middle_of(axis.delay), *axis.delay))
        force, by_delay = arb(record.levels[0]) * weight.area, NONE
        for edge, at in enumerate(map(Fraction, record.switched)):
            drop = arb(record.levels[edge]) - arb(record.levels[edge + 1])
            force -= drop * weight.at(at + middle)[1]
            if least < most:
                by_delay = plus(by_delay, corners((drop.lower(), drop.upper()), weight.during(at + least, at + most)))
        middle = ends_of(force)
        return plus(middle, corners(by_delay, [end - middle_of(axis.delay) for end in axis.delay])), middle, by_delay


    def behind(self, weight, speeds):
        """The same through a lag, with the slope by its rate.

        By parts with `f' = rate (u - f)`, `int W f = int W u + sum drop_e M(e) + (f - u at the beginning) M(beginning)`, e the instants at
        which the command drops, M(t) the integral of `W(t + s) exp(- rate s)` over s >= 0. So a later e adds `drop_e rate M(e)`, a higher rate
        takes `drop_e int s W(e + s) exp(- rate s)`. Of a hat, which is no less than zero, both integrals fall with the rate."""
        track, axis, record = weight.track, speeds.axis, weight.track.record
        (whole, force, _), begin, rate = self.pushed(weight, axis), track.stamps[0], middle_of(axis.rate)
        level, by_delay, by_rate = 0, NONE, NONE
        delays = middle_of(axis.delay), axis.delay[0], axis.delay[1]
        for edge, at in enumerate(map(arb, record.switched)):
            middle, least, most = (at + delay for delay in delays)
            if most <= begin:
                level = edge + 1
                continue
            if not least > begin:
                raise Unsupported
            drop = arb(record.levels[edge]) - arb(record.levels[edge + 1])
            drop = drop.lower(), drop.upper()
            for samples, factor in weight.hats:
                hat = Late([track.stamps[n] for n in samples])
                part = corners(drop, (factor,))
                memory = hat.memory(middle, axis.rate[1]), hat.memory(middle, axis.rate[0])
                force = plus(force, corners(part, ends_of(hat.memory(middle, rate))))
                reach, steep = max((most - middle).upper(), (middle - least).upper()), hat.steepest()
                # Over the instants `rate memory` changes by no more than the hat does, the lever by that over the rate's square.
                # What is left changes with the instant by the hat less that, by one at most.
                whole = plus(whole, corners(part, ((memory[0] - reach).lower(), (memory[1] + reach).upper())))
                low, high = axis.rate[0] * memory[0], axis.rate[1] * memory[1]
                heights = (low - steep * reach).lower(), (high + steep * reach).upper()
                low, high = (hat.lever(middle, own) for own in axis.rate[::-1])
                room = steep * reach / axis.rate[0] ** 2
                by_delay = plus(by_delay, corners(part, heights))
                by_rate = plus(by_rate, minus(corners(part, ((low - room).lower(), (high + room).upper()))))
        ahead = plus(speeds.first_force, (arb(-record.levels[level]),) * 2)
        for samples, factor in weight.hats:
            hat = Late([track.stamps[n] for n in samples])
            memory = hat.memory(begin, axis.rate[1]).lower(), hat.memory(begin, axis.rate[0]).upper()
            before = corners(corners(ahead, (factor,)), memory)
            whole, force = plus(whole, before), plus(force, before)
        return whole, force, by_delay, by_rate


class Late:
    """What is left, at a hat, of what was before it, by the rate at which a lag forgets."""

    def __init__(self, instants):
        l, m, r = instants
        left, right = 1 / (m - l), 1 / (r - m)
        self.corners, self.steep = [(l, left), (m, -left - right), (r, right)], (left, right)

    def steepest(self):
        return max(steep.upper() for steep in self.steep)

    def sum(self, instant, f):
        total = ZERO
        for corner, weight in self.corners:
            ahead = corner - instant
            if ahead.upper() > 0:
                total += weight * f(ahead if ahead.lower() >= 0 else ZERO.union(ahead.upper()))
        return total

    def memory(self, instant, rate):
        """`int W(instant + s) exp(- rate s)`: the hat is a sum of `(corner - t)+` by its kinks."""
        return self.sum(instant, lambda x: x / rate - (1 - (-rate * x).exp()) / rate**2)

    def lever(self, instant, rate):
        """The same with s times the hat, the slope of `- memory` by the rate."""
        gone = lambda x: (-rate * x).exp()
        return self.sum(instant, lambda x: x * (1 + gone(x)) / rate**2 - 2 * (1 - gone(x)) / rate**3)


def middle_of(ends):
    """A float near the middle: any will do."""
    return arb(0.5 * (float(ends[0]) + float(ends[1])))


def ends_of(x):
    return x.lower(), x.upper()


def fraction(x):
    mantissa, exponent = x.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def key_of(origin):
    if origin == "least_linear":
        return ("least_linear",)
    ((kind, at),) = origin.items()
    require(kind == "disturbance", f"a row by {kind}")
    return kind, int(at["record"]), bool(at["above"])
