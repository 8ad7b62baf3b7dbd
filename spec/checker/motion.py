"""The motion of a drag axis over a box of parameters, in balls: a point's motion, and how all others differ from it.

With c a point of the box, `e = v(theta) - v(c)` obeys `e' = m e + sum (theta_j - c_j) p_j`: m is a slope of the acceleration between the
two velocities, p_j what the j-th term multiplies in the motion of c alone. So `state(theta)` is in `c + sum slope_j (theta_j - c_j)`.
"""

from fractions import Fraction

from flint import arb, ctx, fmpq

ctx.prec = 80
ORDER = 9
LONGEST = 0.2
CRUDE = 0.15
ATTEMPTS = 8
SHORTENED = 60
X, V, F = 0, 1, 2
ZERO, ONE, HALF = arb(0), arb(1), arb(1) / 2
PUSHED = ("gain", "disturbance", "linear", "quadratic", "cubic", "stiffness", "lag_rate")


class Unfollowed(Exception):
    """No enclosure of a motion was found."""


def exact(x):
    """A ball without a radius as a fraction: instants are added and compared without rounding."""
    mantissa, exponent = x.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def ball(x):
    return arb(fmpq(x.numerator, x.denominator))


def span(a, b):
    return arb(a).union(arb(b))


def positive(x):
    return x.lower() >= 0


def negative(x):
    return x.upper() <= 0


def within(a, b):
    return b.lower() <= a.lower() and a.upper() <= b.upper()


def meet(a, b):
    """What is in both; both enclose the same values."""
    low, high = max(a.lower(), b.lower()), min(a.upper(), b.upper())
    return span(low, high) if low <= high else a


def size(x):
    return float(abs(x).upper())


def signed_square(v):
    ends = [end * abs(end) for end in (v.lower(), v.upper())]
    return span(*ends)


def cube(v):
    return span(v.lower() ** 3, v.upper() ** 3)


def of_one_sign(*vs):
    return all(positive(v) for v in vs) or all(negative(v) for v in vs)


class Steps:
    """What is in doubt over a box widens with the length of a step: shorter ones, by this, show more, and take longer."""

    shorter = 1


class Products:
    """Of balls: the plain one is quick, and wide where both factors are; that of their ends is not."""

    by_ends = False


def times(a, b):
    if not Products.by_ends or a.is_exact() or b.is_exact():
        return a * b
    low, high, l, h = a.lower(), a.upper(), b.lower(), b.upper()
    return (low * l).union(low * h).union(high * l).union(high * h)


class Equation:
    """`v' = gain f + disturbance - linear v - quadratic (|v| - 2 middle) v - cubic v^3 - stiffness x`, f the command or late by a lag."""

    def __init__(self, terms, middle_speed):
        self.at = {name: terms.get(name, ZERO) for name in PUSHED}
        self.has = set(terms)
        self.shift = 2 * arb(middle_speed)

    def rate(self, state, u):
        x, v, f = state
        at = self.at
        total = times(at["gain"], f) + at["disturbance"] - times(at["linear"], v)
        if "quadratic" in self.has:
            total -= times(at["quadratic"], signed_square(v) - self.shift * v)
        if "cubic" in self.has:
            total -= times(at["cubic"], cube(v))
        if "stiffness" in self.has:
            total -= times(at["stiffness"], x)
        return [v, total, times(at["lag_rate"], u - f) if "lag_rate" in self.has else ZERO]

    def damping(self, v, w):
        """A slope of the acceleration between two velocities."""
        slope = -self.at["linear"]
        if "quadratic" in self.has:
            speeds = abs(v) + abs(w)
            # Half the sum of the speeds to all of it where the signs differ.
            slope -= times(self.at["quadratic"], (speeds if of_one_sign(v, w) else speeds.union(HALF * speeds)) - self.shift)
        if "cubic" in self.has:
            square = span(max((v * v + v * w + w * w).lower(), ZERO), (v * v + v * w + w * w).upper())
            slope -= times(self.at["cubic"], square)
        return slope

    def fastest(self, v):
        swing = abs(self.at["stiffness"]).sqrt() if "stiffness" in self.has else ZERO
        return max(size(self.damping(v, v)), size(self.at["lag_rate"]), size(swing), 1e-6)

    def push(self, name, state, u):
        x, v, f = state
        return {
            "gain": lambda: f,
            "disturbance": lambda: ONE,
            "linear": lambda: -v,
            "quadratic": lambda: self.shift * v - signed_square(v),
            "cubic": lambda: -cube(v),
            "stiffness": lambda: -x,
            "lag_rate": lambda: u - f,
        }[name]()

    def column_rate(self, damping, column, name=None, push=ZERO):
        total = times(damping, column[V])
        force = ZERO
        if "stiffness" in self.has:
            total -= times(self.at["stiffness"], column[X])
        if "lag_rate" in self.has:
            total += times(self.at["gain"], column[F])
            force = -times(self.at["lag_rate"], column[F])
        if name == "lag_rate":
            force += push
        elif name:
            total += push
        return [column[V], total, force]


def picard(start, h, rate):
    """Values that no solution leaves during the time h."""
    duration = span(0, h.upper())
    guess = [s + duration * r for s, r in zip(start, rate(start))]
    for _ in range(ATTEMPTS):
        after = [s + duration * r for s, r in zip(start, rate(guess))]
        if all(within(a, g) for a, g in zip(after, guess)):
            return after
        if not all(a.is_finite() for a in after):
            break
        wider = []
        for g, a, room in zip(guess, after, (0.4, 0.15, 0.05)):
            hull = g.union(a)
            wider.append(hull + arb(0, room * float(hull.rad()) * 2 + 1e-300))
        guess = wider
    raise Unfollowed("a step is too long")


def conv(a, b, k):
    return sum((times(a[i], b[k - i]) for i in range(k + 1)), ZERO)


class Series:
    """Taylor's coefficients of the motion from a state (of one sign of the velocity), and of what each term multiplies."""

    def __init__(self, equation, state, u, sign):
        at, has = equation.at, equation.has
        x, v, f = [state[X]], [state[V]], [state[F]]
        shifted, drag, square, cubed, ahead = [], [], [], [], []
        for k in range(ORDER + 1):
            ahead.append((u if k == 0 else ZERO) - f[k])
            if "quadratic" in has:
                shifted.append(sign * v[k] - (equation.shift if k == 0 else ZERO))
                drag.append(conv(shifted, v, k))
            if "cubic" in has:
                square.append(conv(v, v, k))
                cubed.append(conv(square, v, k))
            total = times(at["gain"], f[k]) - times(at["linear"], v[k])
            if k == 0:
                total += at["disturbance"]
            if drag:
                total -= times(at["quadratic"], drag[k])
            if cubed:
                total -= times(at["cubic"], cubed[k])
            if "stiffness" in has:
                total -= times(at["stiffness"], x[k])
            x.append(v[k] / (k + 1))
            v.append(total / (k + 1))
            f.append(times(at["lag_rate"], ahead[k]) / (k + 1) if "lag_rate" in has else ZERO)
        self.x, self.v, self.f, self.square = x, v, f, square
        self.pushes = {"gain": f, "disturbance": [ONE] + [ZERO] * ORDER, "lag_rate": ahead}
        self.pushes["linear"] = [-c for c in v]
        self.pushes["quadratic"] = [-c for c in drag]
        self.pushes["cubic"] = [-c for c in cubed]
        self.pushes["stiffness"] = [-c for c in x]

    def paths(self):
        return self.x, self.v, self.f


def dampings(equation, over, point, sign):
    slopes = []
    for k in range(ORDER + 1):
        slope = -equation.at["linear"] if k == 0 else ZERO
        if "quadratic" in equation.has:
            slope -= times(equation.at["quadratic"], sign * (over.v[k] + point.v[k]) - (equation.shift if k == 0 else ZERO))
        if "cubic" in equation.has:
            slope -= times(equation.at["cubic"], over.square[k] + conv(over.v, point.v, k) + point.square[k])
        slopes.append(slope)
    return slopes


def column_series(equation, damping, start, push=None, name=None):
    x, v, f = [start[X]], [start[V]], [start[F]]
    for k in range(ORDER):
        total, force = conv(damping, v, k), ZERO
        if "stiffness" in equation.has:
            total -= times(equation.at["stiffness"], x[k])
        if "lag_rate" in equation.has:
            total += times(equation.at["gain"], f[k])
            force = -times(equation.at["lag_rate"], f[k])
        if name == "lag_rate":
            force += push[k]
        elif name:
            total += push[k]
        x.append(v[k] / (k + 1))
        v.append(total / (k + 1))
        f.append(force / (k + 1))
    return x, v, f


def value(head, rest, h):
    """The polynomial with the remainder of the whole step, by Horner's rule."""
    ends = []
    for own, over in zip(head, rest):
        total = over[ORDER]
        for k in range(ORDER - 1, -1, -1):
            total = total * h + own[k]
        ends.append(total)
    return ends


UNITS = {X: [ONE, ZERO, ZERO], V: [ZERO, ONE, ZERO], F: [ZERO, ZERO, ONE]}


def carried(gain, column):
    return [sum((times(gain[k][i], column[k]) for k in range(3)), ZERO) for i in range(3)]


class Kink(Exception):
    """The velocity may change its sign."""


def moving(equation):
    """Components of the start that move others."""
    return [k for k, name in ((X, "stiffness"), (V, None), (F, "lag_rate")) if name is None or name in equation.has]


def smooth(over_eq, point_eq, over, point, u, h, names):
    """A step while the velocity keeps its sign: the flow of a start, what each term adds, the ends of both."""
    if "quadratic" in over_eq.has and not of_one_sign(over[V], point[V]):
        raise Kink
    passed = picard(over, h, lambda state: over_eq.rate(state, u))
    passed_at = picard(point, h, lambda state: point_eq.rate(state, u))
    if "quadratic" in over_eq.has and not of_one_sign(passed[V], passed_at[V]):
        raise Kink
    sign = -ONE if negative(passed[V]) and negative(passed_at[V]) else ONE
    middle = [arb(s.mid()) for s in point]
    heads = [Series(over_eq, over, u, sign), Series(point_eq, point, u, sign), Series(point_eq, middle, u, sign)]
    rests = [Series(over_eq, passed, u, sign), Series(point_eq, passed_at, u, sign)]
    near, far = dampings(over_eq, heads[0], heads[1], sign), dampings(over_eq, rests[0], rests[1], sign)
    slope = over_eq.damping(passed[V], passed_at[V])

    def column(start, name=None):
        push = over_eq.push(name, passed_at, u) if name else ZERO
        inside = picard(start, h, lambda value: over_eq.column_rate(slope, value, name, push))
        head = column_series(over_eq, near, start, heads[1].pushes.get(name), name)
        rest = column_series(over_eq, far, inside, rests[1].pushes.get(name), name)
        return value(head, rest, h)

    gain = [column(UNITS[k]) if k in moving(over_eq) else UNITS[k] for k in range(3)]
    added = {name: column([ZERO] * 3, name) for name in names}
    strayed = carried(gain, [s - m for s, m in zip(point, middle)])
    end_at = [a + b for a, b in zip(value(heads[2].paths(), rests[1].paths(), h), strayed)]
    end = value(heads[0].paths(), rests[0].paths(), h)
    return gain, added, end, end_at, passed


def crude(over_eq, over, u, point_passed, u_at, h, names):
    """A step by the rates' ranges."""
    passed = picard(over, h, lambda state: over_eq.rate(state, u))
    slope = over_eq.damping(passed[V], point_passed[V])

    def column(start, name=None):
        push = over_eq.push(name, point_passed, u_at) if name else ZERO
        rate = lambda value: over_eq.column_rate(slope, value, name, push)
        return line(start, rate(picard(start, h, rate)), h)

    gain = [column(UNITS[k]) if k in moving(over_eq) else UNITS[k] for k in range(3)]
    added = {name: column([ZERO] * 3, name) for name in names}
    return gain, added, between_ends(over_eq, over, passed, u, h, line(over, over_eq.rate(passed, u), h)), passed


def between_ends(equation, over, passed, u, h, end):
    """Of two motions under one force the faster stays ahead: the ends' own rates bound all velocities between them."""

    def from_end(v):
        rate = lambda state: [ZERO, equation.rate([passed[X], state[V], passed[F]], u)[V], ZERO]
        return rate(picard([passed[X], v, passed[F]], h, rate))[V]

    try:
        slow, fast = from_end(over[V].lower()), from_end(over[V].upper())
    except Unfollowed:
        return end
    low, high = (over[V].lower(), slow.lower()), (over[V].upper(), fast.upper())
    reached = [v + h * rate for v, rate in (low, high)]
    way = [h * (v + HALF * h * rate) for v, rate in (low, high)]
    return [meet(end[X], over[X] + way[0].union(way[1])), meet(end[V], reached[0].union(reached[1])), end[F]]


def line(start, rate, h):
    ends = [s + h * r for s, r in zip(start, rate)]
    ends[X] = start[X] + h * start[V] + HALF * h * h * rate[V]
    return ends


def to_rest(equation, state, u, left):
    """How long the velocity keeps its sign; or how long until it has certainly changed it, and True. Estimates."""
    v, rate = state[V], equation.rate(state, u)[V]
    acceleration = max(abs(float(rate.mid())), 1e-300)
    low, high = float(v.lower()), float(v.upper())
    if low > 0:
        near, far = low / acceleration, high / acceleration
    elif high < 0:
        near, far = -high / acceleration, -low / acceleration
    else:
        near, far = 0.0, (high if float(rate.mid()) < 0 else -low) / acceleration
    if near > 1e-7 * left and near > 0.1 * (far - near):
        return 0.98 * near, False
    # A ball's radius is rounded up: an end at zero is crossed by more than that.
    return 1.05 * far + 1e-3 * left, True


def advance_point(equation, state, u, h):
    """The motion of one point, and what it passes."""
    passed, left = list(state), h
    for _ in range(2000):
        if float(left.upper()) <= 0:
            return state, passed
        length = min(LONGEST / equation.fastest(state[V]), float(left.lower()))
        part = left if length >= float(left.lower()) else arb(length)
        for _ in range(SHORTENED):
            try:
                _, _, _, state_after, inside = smooth(equation, equation, state, state, u, part, [])
                break
            except Kink:
                length, across = to_rest(equation, state, u, float(part.upper()))
                if across:
                    part = min_part(part, length)
                    inside = picard(state, part, lambda s: equation.rate(s, u))
                    state_after = line(state, equation.rate(inside, u), part)
                    break
                part = arb(min(length, 0.9 * float(part.lower())))
            except Unfollowed:
                part = arb(0.5 * float(part.lower()))
        else:
            raise Unfollowed("a point's motion")
        state = state_after
        passed = [a.union(b) for a, b in zip(passed, inside)]
        left = ZERO if part is left else left - part
    raise Unfollowed("too many steps")


def min_part(part, length):
    return arb(length) if length < float(part.lower()) else part


class Motion:
    """States of all motions from a box, at one time after another, as a point's state and slopes about it."""

    def __init__(self, over_eq, point_eq, columns, deviations, over, point):
        self.over_eq, self.point_eq = over_eq, point_eq
        self.columns, self.deviations = columns, deviations
        self.over, self.point = over, point
        self.slopes = [list(UNITS[place]) if kind == "start" else [ZERO] * 3 for kind, place in columns]
        self.names = [place for kind, place in columns if kind == "term"]
        # A switching at an uncertain instant: its size, and what a unit of impulse then has become.
        self.open = None

    def lagged(self):
        return "lag_rate" in self.over_eq.has

    def fresh(self):
        return list(UNITS[F if self.lagged() else V])

    def opened(self, size_, begun):
        if self.open is not None:
            raise Unfollowed("two switchings at once")
        impulse = self.fresh()
        self.open = size_, [i.union(ZERO) for i in impulse] if begun else impulse

    def added_by_switching(self):
        size_, impulse = self.open
        factor = self.over_eq.at["lag_rate" if self.lagged() else "gain"] * size_
        return [factor * i for i in impulse]

    def closed(self):
        added = self.added_by_switching()
        for (kind, _), slope in zip(self.columns, self.slopes):
            if kind == "delay":
                slope[:] = [s + a for s, a in zip(slope, added)]
        self.open = None

    def seen_slopes(self):
        if self.open is None:
            return self.slopes
        added = [a.union(ZERO) for a in self.added_by_switching()]
        return [[s + a for s, a in zip(slope, added)] if kind == "delay" else slope for (kind, _), slope in zip(self.columns, self.slopes)]

    def met(self, over):
        for k in range(3 if self.lagged() else 2):
            mean = self.point[k] + sum((times(slope[k], d) for slope, d in zip(self.seen_slopes(), self.deviations)), ZERO)
            over[k] = meet(over[k], mean)
        return over

    def advance(self, u, u_at, h):
        """For a duration; the command is known of the box by a range where a switching is open."""
        left = h
        if not self.lagged():
            self.over[F], self.point[F] = u, u_at
        for _ in range(2000):
            if float(left.upper()) <= 0:
                return
            left = self.step(u, u_at, left)
        raise Unfollowed("too many steps")

    def step(self, u, u_at, left):
        longest = LONGEST / (Steps.shorter * self.over_eq.fastest(self.over[V]))
        part = min_part(left, longest)
        rough = self.open is not None
        for _ in range(SHORTENED):
            try:
                if rough:
                    part = min_part(part, CRUDE / (Steps.shorter * self.over_eq.fastest(self.over[V])))
                    point, passed = advance_point(self.point_eq, self.point, u_at, part)
                    gain, added, over, _ = crude(self.over_eq, self.over, u, passed, u_at, part, self.names)
                else:
                    gain, added, over, point, _ = smooth(self.over_eq, self.point_eq, self.over, self.point, u, part, self.names)
                break
            except Kink:
                both = [a.union(b) for a, b in zip(self.over, self.point)]
                length, rough = to_rest(self.over_eq, both, u, float(part.upper()))
                part = min_part(part, length) if rough else arb(min(length, 0.9 * float(part.lower())))
            except Unfollowed:
                part = arb(0.5 * float(part.lower()))
        else:
            raise Unfollowed("a step")
        self.slopes = [carried(gain, slope) for slope in self.slopes]
        for (kind, name), slope in zip(self.columns, self.slopes):
            if kind == "term":
                slope[:] = [s + a for s, a in zip(slope, added[name])]
        if self.open is not None:
            size_, impulse = self.open
            self.open = size_, [i.union(new) for i, new in zip(carried(gain, impulse), self.fresh())]
        self.point = point
        self.over = self.met(over)
        return ZERO if part is left else left - part
