"""Outputs over a slanted box as polynomials of degree 2 in its coordinates, with a rest: Taylor models in Arb's balls.

With w the deviations of the coordinates from their middles, a state is `P(w) + B r`: P a polynomial whose coefficients are exact, r balls
about zero in a basis B that turns with the flow. A step expands the motion from P in time, its coefficients being polynomials in w whose
products' higher degrees are bounded over the box, and carries r by the flow's derivative, which damping makes smaller. A delay that
depends on w is a step of a duration that depends on w. Where the velocity changes its sign, drag has a small unknown part for the
short time in which not all have the same: it differs from a square of one sign only where the velocity has the other.
"""

import math
from fractions import Fraction

from flint import arb, arb_mat

from boxes import common
from check import require
from motion import (
    HALF, LONGEST, ONE, ORDER, SHORTENED, UNITS, ZERO, F, V, X, Kink, Products, Series, Unfollowed, column_series, dampings, line,
    moving, negative, of_one_sign, picard, span, value,
)  # fmt: skip
from polynomials import Poly, Space, ball, exact, squares

INVERSE = [ONE / (k + 1) for k in range(ORDER + 1)]
MOST_STEPS = 20000
# In which a change of sign is passed.
PIECES = 4
# Steps are so short that their series leave out this share of the first order in a unit of time, or of what is of the third.
SMALL, SHARE, TINY = 1e-9, 0.1, 1e-22


class Field:
    """The equation over the box, and its terms by the coordinates."""

    def __init__(self, equation, terms):
        self.equation, self.has, self.terms = equation, equation.has, terms
        self.lagged = "lag_rate" in self.has
        self.damp = terms.get("linear")
        if "quadratic" in self.has:
            shifted = terms["quadratic"].scaled(-equation.shift)
            self.damp = shifted if self.damp is None else self.damp + shifted

    def series(self, state, u, sign):
        """Taylor's coefficients of the motion from a polynomial, `v |v|` being `sign v^2`."""
        terms, has = self.terms, self.has
        x, v, f = [state[X]], [state[V]], [state[F]]
        square = []
        curved = "cubic" in has or "quadratic" in has
        for k in range(ORDER - 1):
            if curved:
                square.append(squares(v, k))
            total = terms["disturbance"] if k == 0 else None
            pushes = []
            if self.lagged:
                pushes.append(terms["gain"] * f[k])
            elif k == 0:
                pushes.append(terms["gain"].scaled(u))
            if self.damp is not None:
                pushes.append((self.damp * v[k]).scaled(-ONE))
            if "quadratic" in has:
                pushes.append((terms["quadratic"] * square[k]).scaled(-sign))
            if "cubic" in has:
                for i in range(k + 1):
                    part = v[i] * square[k - i]
                    cubed = part if i == 0 else cubed + part
                pushes.append((terms["cubic"] * cubed).scaled(-ONE))
            if "stiffness" in has:
                pushes.append((terms["stiffness"] * x[k]).scaled(-ONE))
            for push in pushes:
                total = push if total is None else total + push
            x.append(v[k].scaled(INVERSE[k]))
            v.append(state[V].scaled(ZERO) if total is None else total.scaled(INVERSE[k]))
            if self.lagged:
                ahead = f[k].scaled(-ONE)
                if k == 0:
                    ahead += state[F].space.constant(u)
                f.append((terms["lag_rate"] * ahead).scaled(INVERSE[k]))
        return x, v, f


class Strays:
    """What the states are off their polynomials: `B r`."""

    def __init__(self, basis, balls):
        self.basis, self.balls = basis, balls

    @staticmethod
    def none():
        return Strays(arb_mat([[ONE if i == j else ZERO for j in range(3)] for i in range(3)]), arb_mat([[ZERO]] * 3))

    def ranges(self):
        total = self.basis * self.balls
        return [total[i, 0] for i in range(3)]

    def moved(self, gain, added):
        """By a flow's derivative, and with what the step adds."""
        carried = gain * self.basis
        radii = [float(self.balls[j, 0].rad()) for j in range(3)]
        columns = [[float(carried[i, j].mid()) * radii[j] for i in range(3)] for j in range(3)]
        basis = arb_mat([[arb(column[i]) for column in orthogonal(columns)] for i in range(3)])
        inverse = basis.inv()
        return Strays(basis, (inverse * carried) * self.balls + inverse * arb_mat([[a] for a in added]))


def orthogonal(columns):
    """Directions of the columns, the longest first, as far as each has one of its own. They need not be exact."""
    found = []
    units = [[float(i == j) for i in range(3)] for j in range(3)]
    for column in sorted(columns, key=lambda c: -math.hypot(*c)) + units:
        length = math.hypot(*column)
        if length == 0 or not math.isfinite(length):
            continue
        rest = [c / length for c in column]
        for other in found:
            along = sum(a * b for a, b in zip(rest, other))
            rest = [a - along * b for a, b in zip(rest, other)]
        left = math.hypot(*rest)
        if left > 1e-2 and len(found) < 3:
            found.append([a / left for a in rest])
    return found


def beyond(v, sign):
    """What `v |v|` is more than `sign v^2`."""
    other = max((-sign * v).upper(), ZERO)
    return (-2 * sign * other * other).union(ZERO)


class TooLong(Exception):
    """What is left of a step's series is this many times what it should be."""


class Step:
    """The motion during a time h. `doubt` is what the command may be off; `crossing` if the velocity may change its sign; what the
    series leave out should be `small`."""

    def __init__(self, field, state, strays, u, h, doubt=ZERO, crossing=False, small=math.inf):
        eq = self.equation = field.equation
        self.field, self.strays = field, strays
        kinked = "quadratic" in eq.has
        hull = [p.range() + s.union(ZERO) for p, s in zip(state, strays.ranges())]
        commands = u + doubt
        if not field.lagged:
            hull[F] = commands
        if kinked and not crossing and not of_one_sign(hull[V]):
            raise Kink
        # Of a crossing either sign will do; this one leaves less out.
        sign = -ONE if hull[V].mid() + HALF * h * eq.rate(hull, commands)[V].mid() < 0 else ONE
        bent = crossing and kinked

        def rate(at):
            x, v, f = eq.rate(at, commands)
            # Both with the kink and without it.
            return [x, v + (eq.at["quadratic"] * beyond(at[V], sign)).union(ZERO) if bent else v, f]

        passed = picard(hull, h, rate)
        if kinked and not crossing and not of_one_sign(passed[V]):
            raise Kink
        if not bent:
            sign = -ONE if negative(passed[V]) else ONE
        own = [passed[X], passed[V], passed[F] if field.lagged else u]
        rests = Series(eq, own, u, sign)
        self.rests = [path[ORDER] for path in rests.paths()]
        left_out = max(float((abs(rest) * h**ORDER).upper()) for rest in self.rests)
        if left_out > small:
            raise TooLong(left_out / small)
        self.heads = field.series(state, u, sign)
        far = dampings(eq, rests, rests, sign)
        self.rough = crossing or not doubt.is_zero()
        if not self.rough:
            begun = Series(eq, hull, u, sign)
            near = dampings(eq, begun, begun, sign)
        self.columns = {}
        for k in moving(eq):
            inside = picard(UNITS[k], h, lambda at: eq.column_rate(far[0], at))
            if self.rough:
                self.columns[k] = UNITS[k], eq.column_rate(far[0], inside)
            else:
                self.columns[k] = column_series(eq, near, UNITS[k]), column_series(eq, far, inside)
        self.pushed = None
        if self.rough:
            name, push = ("lag_rate", eq.at["lag_rate"] * doubt) if field.lagged else ("gain", eq.at["gain"] * doubt)
            kink = -eq.at["quadratic"] * beyond(passed[V], sign) if bent else ZERO

            def driven(at):
                x, v, f = eq.column_rate(far[0], at, name, push)
                return [x, v + kink, f]

            self.pushed = driven(picard([ZERO] * 3, h, driven))

    def gain(self, t):
        """By which the strays are multiplied."""
        columns = [UNITS[k] for k in range(3)]
        for k, (head, rest) in self.columns.items():
            columns[k] = line(head, rest, t) if self.rough else value(head, rest, t)
        return arb_mat([[columns[j][i] for j in range(3)] for i in range(3)])

    def added(self, t):
        return [ZERO] * 3 if self.pushed is None else line([ZERO] * 3, self.pushed, t)

    def path(self, component, t):
        heads = self.heads[component]
        if component == F and not self.field.lagged:
            return heads[0]
        total = heads[0].space.constant(ZERO, self.rests[component])
        for head in reversed(heads):
            total = (total * t if isinstance(t, Poly) else total.scaled(t)) + head
        return total

    def output(self, t):
        strayed = (self.gain(t) * (self.strays.basis * self.strays.balls))[0, 0]
        return self.path(X, t).with_rest(strayed + self.added(t)[X])

    def end(self, t, longest):
        """The state after t, a number or a polynomial, and what it strays by; t is never longer than `longest`."""
        at = span(0, longest) if isinstance(t, Poly) else t
        ends = [self.path(k, t).with_rest(a).settled() for k, a in enumerate(self.added(at))]
        return [p for p, _ in ends], self.strays.moved(self.gain(at), [off for _, off in ends])


def to_rest(v, rate, length):
    """How long the velocity keeps its sign; or how long until it has changed it, and True. Estimates."""
    pace = max(abs(float(rate.mid())), 1e-300)
    low, high = float(v.lower()), float(v.upper())
    first, last = (low / pace, high / pace) if rate.mid() < 0 else (-high / pace, -low / pace)
    if first > 1e-7 * length and first > 0.05 * (last - first):
        return 0.98 * first, False
    if last <= 0:
        # It leaves zero: crossing is doubted only if its range ends there.
        return (1e-2 * (last - first) + 1e-6 * length, True) if -last <= 1e-3 * (last - first) else (length / 2, False)
    return min(1.02 * last, (last - first) / PIECES) + 1e-6 * length, True


class Flow:
    """A motion from one instant to another, with the outputs at samples on the way."""

    def __init__(self, field, state, now, samples):
        self.field, self.state, self.strays, self.now = field, state, Strays.none(), now
        self.samples, self.notes, self.next, self.steps = samples, {}, 0, 0
        # What the last step left of the third order by its length, and how long the next one may be.
        self.third, self.suited = 0.0, math.inf
        self.note_here()

    def branch(self):
        other = Flow.__new__(Flow)
        other.__dict__.update(self.__dict__)
        return other

    def note_here(self):
        while self.next < len(self.samples) and self.samples[self.next][1] <= self.now:
            self.notes[self.samples[self.next][0]] = self.state[X].with_rest(self.strays.ranges()[X])
            self.next += 1

    def hull(self, u):
        ranges = [p.range() + s for p, s in zip(self.state, self.strays.ranges())]
        return ranges if self.field.lagged else ranges[:F] + [u]

    def longest(self, u):
        eq, hull = self.field.equation, self.hull(u)
        if not all(own.is_finite() for own in hull):
            raise Unfollowed("no finite states")
        quickest = eq.fastest(hull[V])
        if "quadratic" in eq.has:
            # Near rest drag grows with the speed that is picked up.
            quickest = max(quickest, float((abs(eq.at["quadratic"] * eq.rate(hull, u)[V])).upper()) ** 0.5)
        return LONGEST / quickest

    def begin(self, u):
        """Without a lag the force is the command."""
        if not self.field.lagged:
            self.state = self.state[:F] + [self.state[X].space.constant(u)]

    def until(self, end, u, doubt=ZERO):
        u = arb(u)
        self.begin(u)
        while self.now < end:
            self.tried(end - self.now, u, doubt)

    def tried(self, length, u, doubt):
        length, crossing = min(length, Fraction(self.longest(u))), False
        suited = self.suited < length
        if suited:
            length = Fraction(self.suited)
        first = SMALL * float(self.state[V].parts()[0].rad())
        for _ in range(SHORTENED):
            small = max(first, SHARE * self.third) * float(length) + TINY
            try:
                step = Step(self.field, self.state, self.strays, u, ball(length), doubt, crossing, small)
                break
            except TooLong as fault:
                suited = True
                length *= Fraction(max(0.3, 0.9 * fault.args[0] ** (-1 / (ORDER + 2))))
            except Kink:
                hull = self.hull(u)
                suited = False
                near, crossing = to_rest(hull[V], self.field.equation.rate(hull, u)[V], float(length))
                length = min(length, Fraction(near)) if crossing else min(Fraction(near), length * 9 / 10)
            except Unfollowed:
                length /= 2
        else:
            raise Unfollowed("a step")
        if not crossing:
            self.third = float(step.heads[V][1].rest.rad())
            if suited:
                self.suited = 1.25 * float(length)
        self.taken(step)
        until = self.now + length
        while self.next < len(self.samples) and self.samples[self.next][1] <= until:
            sample, at = self.samples[self.next]
            self.notes[sample] = step.output(ball(at - self.now))
            self.next += 1
        self.state, self.strays = step.end(ball(length), ball(length))
        self.now = until

    def taken(self, step):
        self.steps += 1
        if self.steps > MOST_STEPS:
            raise Unfollowed("too many steps")

    def during(self, duration, longest, u):
        """For a time that depends on the coordinates; samples are passed over."""
        u = arb(u)
        self.begin(u)
        parts = max(1, math.ceil(4 * float(longest.upper()) / self.longest(u)))
        for _ in range(8):
            other, part = self.branch(), longest / parts
            try:
                for _ in range(parts):
                    other.piece(duration.scaled(ONE / parts), part, u)
                self.state, self.strays, self.steps = other.state, other.strays, other.steps
                return
            except Unfollowed:
                parts *= 2
        raise Unfollowed("a switching")

    def piece(self, duration, longest, u):
        try:
            step = Step(self.field, self.state, self.strays, u, longest)
        except Kink:
            step = Step(self.field, self.state, self.strays, u, longest, ZERO, True)
        self.taken(step)
        self.state, self.strays = step.end(duration, longest)


def drive(field, record, delay, start, begin, end):
    """Outputs at the samples from `begin` to `end`; the delay is a fraction, or a polynomial with its least and its most."""
    instants = [Fraction(t) for t in record.time]
    since, until = instants[begin], instants[end]
    flow = Flow(field, start, since, [(k, instants[k]) for k in range(begin, end + 1)])
    polynomial, least, most = delay if isinstance(delay, tuple) else (None, delay, delay)
    before = None
    for edge, switched in enumerate(map(Fraction, record.switched)):
        low, high = switched + least, switched + most
        if high <= since:
            continue
        if low > until:
            break
        if before is not None and low < before:
            raise Unfollowed("two switchings at once")
        before = high
        level, jump = record.levels[edge], arb(record.levels[edge + 1]) - arb(record.levels[edge])
        flow.until(low, level)
        if low == high:
            continue
        # The command is either level at any instant between.
        either = flow if low < since or high > until else flow.branch()
        within = [t for _, t in flow.samples[flow.next :] if t < min(high, until)]
        if either is flow:
            flow.until(min(high, until), level, jump.union(ZERO))
            continue
        if within:
            either.until(within[-1], level, jump.union(ZERO))
        flow.next = either.next
        first = polynomial + polynomial.space.constant(ball(switched - flow.now))
        flow.during(first, ball(high - low), level)
        flow.during(polynomial.space.constant(ball(high - low)) - first, ball(high - low), record.levels[edge + 1])
        flow.now = high
        flow.note_here()
    acted = sum(1 for t in record.switched if Fraction(t) + most <= until)
    flow.until(until, record.levels[acted])
    if len(flow.notes) != end - begin + 1:
        raise Unfollowed("a sample was passed over")
    return flow.notes


class Enclosure:
    """The readings over a box, by the coordinates of its frame."""

    def __init__(self, stage, box, frame, spans):
        Products.by_ends = False
        self.frame, self.z = frame, box.along(frame)
        if self.z is None:
            raise Unfollowed("an empty frame")
        self.middle = [arb(((arb(a) + arb(b)) / 2).mid()) for a, b in self.z]
        radii = [max((arb(b) - m).upper(), (m - arb(a)).upper()) for (a, b), m in zip(self.z, self.middle)]
        self.space = Space(radii)
        self.thetas = self.by_coordinates()
        ranges = [span(*side) for side in box.sides]
        self.rows = {}
        for first, after in spans:
            index, begin, _ = stage.windows[first]
            record = stage.records[index]
            terms = {name: self.thetas[place] for place, name in enumerate(stage.terms)}
            terms["disturbance"] = self.thetas[stage.common + index]
            start = [self.theta(stage.start(first, k)) if k < stage.size else self.space.constant(ZERO) for k in range(3)]
            delay = Fraction(stage.delay) if stage.delay is not None else None
            if delay is None:
                place = len(stage.terms)
                delay = self.thetas[place], *(exact(arb(end)) for end in box.sides[place])
            field = Field(stage.equation(ranges, index), terms)
            notes = drive(field, record, delay, start, begin, stage.windows[after - 1][2])
            error = self.space.constant(arb(record.error))
            for sample, output in notes.items():
                off = output - self.space.constant(arb(record.reading[sample]))
                self.rows["reading", first, sample, True] = off - error
                self.rows["reading", first, sample, False] = off.scaled(-ONE) - error
        own = {}
        stage.bound(own, [ZERO] * len(box.sides))
        for name, (slopes, limit) in own.items():
            total = self.space.constant(-limit)
            for place, slope in slopes:
                total += self.theta(place).scaled(slope)
            self.rows[name] = total

    def by_coordinates(self):
        count, thetas = len(self.z), []
        for row, centre in enumerate(self.frame.centre):
            weights = self.frame.lower[row] + [ONE] + [ZERO] * (count - row - 1)
            constant = centre + sum((m * w for m, w in zip(self.middle, weights)), ZERO)
            thetas.append(Poly(self.space, constant, arb_mat([weights]), None, ZERO))
        return thetas

    def theta(self, place):
        require(place in self.frame.places, "an unknown of no frame")
        return self.thetas[self.frame.places.index(place)]

    def coordinate(self, row, frame):
        """Of another frame, by substitution."""
        require(0 <= row < len(self.thetas), "no such coordinate")
        own = []
        for r in range(row + 1):
            total = self.thetas[r] - self.space.constant(frame.centre[r])
            for weight, z in zip(frame.lower[r], own):
                total -= z.scaled(weight)
            own.append(total)
        return own[row]

    def most(self, objective, combination, box):
        """An upper bound of the objective over what meets the rows in a box that this one holds; `None` where there is no such."""
        z = self.frame.coordinates(box.sides, self.z)
        if z is not None and box.frame is self.frame:
            z = [common(own, other) for own, other in zip(z, box.z)]
        if z is None or None in z:
            return None
        total = objective if objective is not None else self.space.constant(ZERO)
        for row, multiplier in combination:
            total -= row.scaled(multiplier)
        middle = [arb(((arb(a) + arb(b)) / 2).mid()) for a, b in z]
        radii = [max((arb(b) - m).upper(), (m - arb(a)).upper()) for (a, b), m in zip(z, middle)]
        return total.most(arb_mat([[m - own] for m, own in zip(middle, self.middle)]), radii)
