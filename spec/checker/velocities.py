"""Velocities at and between samples, from readings, the command and a box: for any parameters of the box whose motion meets the readings.

Mean velocities between samples are known to within the errors; what accelerates beside drag bounds how far the velocity is off a mean, drag
only brakes, and where nothing but the velocity decides its rate it goes one way between two switchings. Only readings from the first
window's beginning on are used.
"""

from fractions import Fraction

from flint import arb

from motion import ZERO

SPANS = (1, 2, 3, 5, 8, 13, 21, 34, 55)
ROUNDS = 4
# Parts of a time between samples: of each, and of those after the first sample, of which so many are looked at for so many ends.
PARTS = 3
FINE, AHEAD, TRIES = 8, 6, 12
# Rounds go on while they take this share of the sum of what velocities between samples are in doubt.
HELPED = 0.02
HALF = arb(1) / 2
NONE = (ZERO, ZERO)


class Nothing(Exception):
    """No motion from the box meets the readings."""


def corners(a, b):
    """The product of two ranges, each by its ends."""
    products = [x * y for x in a for y in b]
    return min(p.lower() for p in products), max(p.upper() for p in products)


def plus(*ranges):
    return sum((r[0] for r in ranges), ZERO).lower(), sum((r[1] for r in ranges), ZERO).upper()


def minus(a):
    return -a[1], -a[0]


class Track:
    """A record from the first window's beginning on, and what follows from readings alone."""

    def __init__(self, record, first):
        self.record, self.first = record, first
        self.instant = [Fraction(t) for t in record.time[first:]]
        stamps = [arb(t) for t in record.time[first:]]
        self.reading = [arb(y) for y in record.reading[first:]]
        self.error, self.count = arb(record.error), len(stamps)
        self.lasted = [b - a for a, b in zip(stamps, stamps[1:])]
        self.spans = []
        for span in SPANS:
            for i in range(self.count - span):
                way, lasted = self.reading[i + span] - self.reading[i], stamps[i + span] - stamps[i]
                self.spans.append((i, i + span, lasted, way - 2 * self.error, way + 2 * self.error))
        self.stamps, self.of_even = stamps, {}

    def even(self, first, last, sign):
        """Where the velocity, turned by `sign`, rises from one sample to another: at least and at most what it is at each."""
        if (first, last, sign) not in self.of_even:
            least, most = [None] * (last - first + 1), [None] * (last - first + 1)
            for i in range(first, last):
                for j in range(i + 1, last + 1):
                    # A rising velocity is not below a mean before it, nor above one after it.
                    way, lasted = sign * (self.reading[j] - self.reading[i]), self.stamps[j] - self.stamps[i]
                    low, high = ((way - 2 * self.error) / lasted).lower(), ((way + 2 * self.error) / lasted).upper()
                    a, b = j - first, i - first
                    least[a] = low if least[a] is None else max(least[a], low)
                    most[b] = high if most[b] is None else min(most[b], high)
            for k in range(1, len(least)):
                if least[k - 1] is not None:
                    least[k] = max(least[k], least[k - 1])
            for k in range(len(most) - 2, -1, -1):
                if most[k + 1] is not None:
                    most[k] = min(most[k], most[k + 1])
            self.of_even[first, last, sign] = least, most
        return self.of_even[first, last, sign]


class Axis:
    """The terms over a box, each by its ends."""

    def __init__(self, stage, box, record):
        ends = {name: (arb(low), arb(high)) for name, (low, high) in zip(stage.terms, box)}
        self.has = set(stage.terms)
        self.gain, self.linear, self.quadratic, self.cubic = (ends.get(n, NONE) for n in ("gain", "linear", "quadratic", "cubic"))
        self.stiffness, self.rate = ends.get("stiffness", NONE), ends.get("lag_rate")
        self.disturbance = tuple(map(arb, box[stage.common + record]))
        self.delay = tuple(map(arb, box[len(stage.terms)])) if stage.delay is None else (arb(stage.delay), arb(stage.delay))
        self.middle = arb(stage.middle)
        # Linear drag itself, without what is the quadratic one's: `linear v + quadratic (|v| - 2 middle) v = own v + quadratic |v| v`.
        self.own = plus(self.linear, minus(corners(self.quadratic, (2 * self.middle, 2 * self.middle))))
        if {"linear", "quadratic"} <= self.has:
            least = arb(stage.least)
            self.own = max(self.own[0], least), max(self.own[1], least)
        self.driving = max(-self.own[0], ZERO)

    def most(self, a, b):
        """At least the largest drag at velocities from a to b."""
        linear, quadratic, cubic = corners(self.own, (a, b))[1], ZERO, ZERO
        if "quadratic" in self.has:
            quadratic = corners(self.quadratic, (b * abs(b),))[1]
        if "cubic" in self.has:
            cubic = corners(self.cubic, (b**3,))[1]
        found = (linear + quadratic + cubic).upper()
        if "quadratic" in self.has and "linear" in self.has:
            # The same by drag at the middle speed; `(|v| - 2 middle) v` is largest at an end or at minus the middle.
            shifted = [v * (abs(v) - 2 * self.middle) for v in (a, b)]
            if a <= -self.middle <= b:
                shifted.append(self.middle**2)
            found = min(found, (corners(self.linear, (a, b))[1] + corners(self.quadratic, shifted)[1] + cubic).upper())
        return found

    def implicit(self, v, push, lasted):
        """About where `m = v + lasted (push - D(m))` for the largest drag D; m is v or more."""
        own, quadratic, cubic = ([float(end) for end in ends] for ends in (self.own, self.quadratic, self.cubic))
        drag = lambda m: max(o * m for o in own) + max(q * m * abs(m) for q in quadratic) + max(k * m**3 for k in cubic)
        low, high = v, v + 1.5 * lasted * (push - drag(v))
        for _ in range(14):
            m = 0.5 * (low + high)
            low, high = (m, high) if m <= v + lasted * (push - drag(m)) else (low, m)
        return low

    def rates(self, push, a, b):
        """Accelerations at velocities from a to b. Drag is odd."""
        return (push[0] - self.most(a, b)).lower(), (push[1] + self.most(-b, -a)).upper()


class Speeds:
    """Velocities at samples, between each and the next, and accelerations there, over a box."""

    def __init__(self, stage, track, axis, box, record):
        self.track, self.axis = track, axis
        fastest = arb(stage.fastest)
        self.low, self.high = [-fastest] * track.count, [fastest] * track.count
        self.between = [(-fastest, fastest)] * (track.count - 1)
        self.levels = self.acting()
        forces = [span_of(track.record.levels[a : b + 1]) for a, b in self.levels]
        if axis.rate is not None:
            window = next(n for n, (own, _, _) in enumerate(stage.shooting) if own == record)
            self.first_force = tuple(map(arb, box[stage.start(window, 2)]))
            forces = self.late(forces)
        self.pushed = [plus(corners(axis.gain, force), axis.disturbance) for force in forces]
        self.evens = self.even_times() if axis.rate is None and "stiffness" not in axis.has else []
        for window, (own, first, _) in enumerate(stage.shooting):
            if own == record:
                ends = box[stage.start(window, 1)]
                self.narrow(first - track.first, arb(ends[0]), arb(ends[1]))
        doubt = None
        for _ in range(ROUNDS):
            self.once()
            now = sum(float(b - a) for a, b in self.between)
            if doubt is not None and now > (1 - HELPED) * doubt:
                break
            doubt = now
        self.check_ways()

    def narrow(self, sample, low=None, high=None):
        if low is not None and low > self.low[sample]:
            self.low[sample] = low
        if high is not None and high < self.high[sample]:
            self.high[sample] = high
        if self.low[sample] > self.high[sample]:
            raise Nothing

    def narrow_between(self, interval, low, high):
        a, b = self.between[interval]
        low, high = max(a, low), min(b, high)
        if low > high:
            raise Nothing
        self.between[interval] = low, high

    def acting(self):
        """For every time between two samples, the numbers of the first and the last level that may act."""
        record, stamps, (least, most) = self.track.record, self.track.stamps, self.axis.delay
        opens = [(arb(t) + least).lower() for t in record.switched]
        closes = [(arb(t) + most).upper() for t in record.switched]
        done = begun = 0
        levels = []
        for a, b in zip(stamps, stamps[1:]):
            while done < len(closes) and closes[done] <= a:
                done += 1
            begun = max(begun, done)
            while begun < len(opens) and opens[begun] < b:
                begun += 1
            levels.append((done, begun))
        return levels

    def late(self, forces):
        """Through a lag: the force goes from what it was towards the command, at a rate of the box."""
        force, late = self.first_force, []
        for command, lasted in zip(forces, self.track.lasted):
            left = [(-rate * lasted).exp() for rate in self.axis.rate]
            low = min((command[0] + (force[0] - command[0]) * part).lower() for part in left)
            high = max((command[1] + (force[1] - command[1]) * part).upper() for part in left)
            late.append((min(force[0], low), max(force[1], high)))
            force = low, high
        return late

    def even_times(self):
        """First and last samples of times in which no switching can act."""
        evens = []
        for interval, (done, begun) in enumerate(self.levels):
            if done != begun:
                continue
            if evens and evens[-1][1] == interval and evens[-1][2] == done:
                evens[-1][1] = interval + 1
            else:
                evens.append([interval, interval + 1, done])
        return evens

    def pushes(self):
        """What accelerates besides drag, in every interval."""
        if "stiffness" not in self.axis.has:
            return self.pushed
        pushes = []
        for k, (low, high) in enumerate(self.between):
            place = self.track.reading[k] - self.track.error, self.track.reading[k] + self.track.error
            moved = min(low * self.track.lasted[k], ZERO), max(high * self.track.lasted[k], ZERO)
            pushes.append(plus(self.pushed[k], minus(corners(self.axis.stiffness, plus(place, moved)))))
        return pushes

    def once(self):
        pushes = self.pushes()
        most = []
        for (low, high), (a, b) in zip(pushes, self.between):
            driven = self.axis.driving * max(abs(a), abs(b))
            most.append(((driven - low).upper(), (high + driven).upper()))
        # Upwards and downwards, each zero or more.
        up, down = [max(b, ZERO) for _, b in most], [max(a, ZERO) for a, _ in most]
        self.brakes_only(up, down)
        self.one_way()
        self.begin(pushes)
        self.ahead(pushes, up, down)
        self.back(up, down)
        self.passed(pushes, up, down)
        self.one_way()
        for first, last, _ in self.evens:
            for k in range(first, last):
                self.narrow_between(k, min(self.low[k], self.low[k + 1]), max(self.high[k], self.high[k + 1]))
        self.rates = [self.axis.rates(push, *ends) for push, ends in zip(pushes, self.between)]
        self.accelerated()
        self.rates = [self.axis.rates(push, *ends) for push, ends in zip(pushes, self.between)]

    def sums(self, rates):
        """Integrals at samples of what is constant between them, and the integrals of these."""
        first, second = [ZERO], [ZERO]
        for rate, lasted in zip(rates, self.track.lasted):
            first.append(first[-1] + rate * lasted)
            second.append(second[-1] + HALF * lasted * (first[-2] + first[-1]))
        return first, second

    def brakes_only(self, up, down):
        """Drag only brakes: a velocity beyond what pushes add in a time was there all that time, and one at the beginning of a time adds to
        what they add; with A the integral of the push, v(t) >= v_j - (A_j - A(t)) in the one case, v(t) <= max(v_i, 0) + A(t) - A_i in the
        other, and the way tells how large v_j can be, and v_i must be."""
        (u, uu), (d, dd) = self.sums(up), self.sums(down)
        for i, j, lasted, least, most in self.track.spans:
            self.narrow(j, -max((d[j] - d[i]).upper(), ((d[j] * lasted - dd[j] + dd[i] - least) / lasted).upper()),
                        max((u[j] - u[i]).upper(), ((most + u[j] * lasted - uu[j] + uu[i]) / lasted).upper()))
            low = ((least - uu[j] + uu[i] + u[i] * lasted) / lasted).lower()
            high = ((most + dd[j] - dd[i] - d[i] * lasted) / lasted).upper()
            self.narrow(i, low if low > 0 else None, high if high < 0 else None)

    def one_way(self):
        """While the command does not change the velocity goes one way: two motions under one autonomous law never pass each other."""
        for first, last, _ in self.evens:
            ways = []
            for sign in (1, -1):
                own = list(zip(self.low[first : last + 1], self.high[first : last + 1]))
                own = own if sign > 0 else [minus(ends) for ends in own]
                low, high = [a for a, _ in own], [b for _, b in own]
                for k, (least, most) in enumerate(zip(*self.track.even(first, last, sign))):
                    low[k] = low[k] if least is None else max(low[k], least)
                    high[k] = high[k] if most is None else min(high[k], most)
                for k in range(1, len(low)):
                    low[k] = max(low[k], low[k - 1])
                for k in range(len(high) - 2, -1, -1):
                    high[k] = min(high[k], high[k + 1])
                if all(a <= b for a, b in zip(low, high)):
                    ways.append(list(zip(low, high)) if sign > 0 else [minus(ends) for ends in zip(low, high)])
            if not ways:
                raise Nothing
            for k, ends in enumerate(zip(*ways)):
                self.narrow(first + k, min(a for a, _ in ends), max(b for _, b in ends))

    def least(self, v, push, lasted, parts=PARTS):
        """No velocity that begins at v or above is below this after a time, nor below the second during it, nor goes less than the third.

        It stays above the solution w of `w' = phi(w)`, phi the least acceleration of the box, which goes one way. Falling, w is above an
        end that it does not reach at the fastest rate before it, or where it would rise; rising, it is beyond m or has gained what it gains
        up to m at the slowest."""
        push, part, during, way = (push, push), lasted / parts, v, ZERO
        slowest = lambda a, b: (push[0] - self.axis.most(a, b)).lower()
        for _ in range(parts):
            before, rate = v, slowest(v, v)
            if rate < 0:
                end = (v + part * rate).lower()
                for _ in range(6):
                    if (v + part * slowest(end, v)).lower() >= end or slowest(end, end) >= 0:
                        v = max(end, min((v + part * slowest(end, v)).lower(), v))
                        break
                    end = (v + 2 * (end - v)).lower()
                else:
                    return None, None, None
                during = min(during, v)
            else:
                # The implicit step's end, in floats, whatever it misses.
                m = max(arb(self.axis.implicit(float(v), float(push[0]), float(part))), v)
                v = max(v, min(m, (v + part * slowest(v, m)).lower()))
            way += part * min(before, v)
        return v, during, way

    def goes_too_far(self, v, pushes, sign):
        """Whether a velocity at the first sample, turned by `sign`, of v or more goes further than the readings allow."""
        ahead = ZERO
        for k in range(min(AHEAD, self.track.count - 1)):
            v, _, way = self.least(v, pushes[k][0] if sign > 0 else -pushes[k][1], self.track.lasted[k], FINE)
            if v is None:
                return False
            ahead += way - sign * (self.track.reading[k + 1] - self.track.reading[k])
            if ahead > 2 * self.track.error:
                return True
        return False

    def begin(self, pushes):
        """The first velocity has no readings before it: ends are tried."""
        for sign in (1, -1):
            low, high = (self.low[0], self.high[0]) if sign > 0 else (-self.high[0], -self.low[0])
            within, beyond = float(low), None
            for _ in range(TRIES):
                middle = 0.5 * (within + float(high if beyond is None else beyond))
                if self.goes_too_far(arb(middle), pushes, sign):
                    beyond = middle
                else:
                    within = middle
            if beyond is not None and beyond < high:
                self.narrow(0, *((None, arb(beyond)) if sign > 0 else (arb(-beyond), None)))

    def ahead(self, pushes, up, down):
        self.during = []
        for k, lasted in enumerate(self.track.lasted):
            low, high, push = self.low[k], self.high[k], pushes[k]
            self.narrow(k + 1, (min(low, ZERO) - down[k] * lasted).lower(), (max(high, ZERO) + up[k] * lasted).upper())
            least, lowest, _ = self.least(low, push[0], lasted)
            most, highest, _ = self.least(-high, -push[1], lasted)
            self.narrow(k + 1, least, None if most is None else -most)
            self.during.append((lowest, None if highest is None else -highest))

    def back(self, up, down):
        """What it is later it was before, less what pushes added."""
        for k in range(self.track.count - 2, -1, -1):
            lasted = self.track.lasted[k]
            low, high = (self.low[k + 1] - up[k] * lasted).lower(), (self.high[k + 1] + down[k] * lasted).upper()
            self.narrow(k, low if low > 0 else None, high if high < 0 else None)

    def passed(self, pushes, up, down):
        for k, lasted in enumerate(self.track.lasted):
            low, high = (self.low[k + 1] - up[k] * lasted).lower(), (self.high[k + 1] + down[k] * lasted).upper()
            if not low > 0:
                low = (min(self.low[k], ZERO) - down[k] * lasted).lower()
            if not high < 0:
                high = (max(self.high[k], ZERO) + up[k] * lasted).upper()
            lowest, highest = self.during[k]
            low, high = (low if lowest is None else max(low, lowest)), (high if highest is None else min(high, highest))
            self.narrow_between(k, low, high)

    def accelerated(self):
        """By accelerations' ranges r between samples, R their integral: `v_i + R(t) - R_i` and `v_j - R_j + R(t)` bound v, and the way tells
        v_i and v_j."""
        (a, aa), (b, bb) = self.sums([r[0] for r in self.rates]), self.sums([r[1] for r in self.rates])
        for i, j, lasted, least, most in self.track.spans:
            self.narrow(i, ((least - bb[j] + bb[i]) / lasted + b[i]).lower(), ((most - aa[j] + aa[i]) / lasted + a[i]).upper())
            self.narrow(j, ((least - aa[j] + aa[i]) / lasted + a[j]).lower(), ((most - bb[j] + bb[i]) / lasted + b[j]).upper())
        for k, lasted in enumerate(self.track.lasted):
            self.narrow(k + 1, (self.low[k] + self.rates[k][0] * lasted).lower(), (self.high[k] + self.rates[k][1] * lasted).upper())
        for k in range(self.track.count - 2, -1, -1):
            lasted = self.track.lasted[k]
            self.narrow(k, (self.low[k + 1] - self.rates[k][1] * lasted).lower(), (self.high[k + 1] - self.rates[k][0] * lasted).upper())
        for k, lasted in enumerate(self.track.lasted):
            low = lowest_between(self.low[k], self.low[k + 1], self.rates[k], lasted)
            high = -lowest_between(-self.high[k], -self.high[k + 1], minus(self.rates[k]), lasted)
            self.narrow_between(k, low, high)

    def check_ways(self):
        """Ways that velocities allow are ones that readings allow, over every span."""
        least = most = lowest = highest = ZERO
        for k, lasted in enumerate(self.track.lasted):
            way = self.track.reading[k + 1] - self.track.reading[k]
            least, most = least + self.between[k][0] * lasted - way, most + self.between[k][1] * lasted - way
            if least - lowest > 2 * self.track.error or highest - most > 2 * self.track.error:
                raise Nothing
            lowest = least if least < lowest else lowest
            highest = most if most > highest else highest


def lowest_between(a, b, rates, lasted):
    """The least velocity between an end not below a and one not below b, with accelerations within a range."""
    r, s = rates
    if r >= 0:
        return a
    if s <= 0:
        return b
    # Where the line that falls from a meets the one that rises to b, or an end of either.
    return max(((a * s - b * r + r * s * lasted) / (s - r)).lower(), (a + r * lasted).lower(), (b - s * lasted).lower())


def span_of(numbers):
    return arb(min(numbers)), arb(max(numbers))
