"""What is claimed, typed from the theory: statements, inequalities, domains and formulas. Nothing here is read from the crate, but the
words of `words.json`, which say in the crate's what the formulas do; `test_check.py` holds that no certificate has others."""

import json
from fractions import Fraction
from pathlib import Path

from flint import arb

from arithmetic import call
from range import Range

VALUE = {"kind": "value"}
UP = float("inf")
# Claim: its domain and steps by hand, and what each of its inequalities says, in words.
WORDS = json.loads(Path(__file__).with_name("words.json").read_text())


def number(text):
    """A decimal as a range, exactly enclosed."""
    fraction = Fraction(text)
    return Range.around([arb(fraction.numerator) / fraction.denominator])


def slope(by):
    return {"kind": "slope", "by": by}


def over_power(order, near):
    return {"kind": "over-power", "order": order, "near": near}


def excess(mu, d_1, d_2):
    """(1 - mu + d_1)(1 + mu + d_2) - (1 + mu - d_1)(1 - mu - d_2) - 1.99 (d_1 + d_2)."""
    braked = (1 - mu + d_1) * (1 + mu + d_2)
    left = (1 + mu - d_1) * (1 - mu - d_2)
    return braked - left - number("1.99") * (d_1 + d_2)


def rate_left(mu, s_1, s_2):
    """The drag forces are shares s_1 of 1 + mu and s_2 of 1 - mu."""
    d_1, d_2 = s_1 * (1 + mu), s_2 * (1 - mu)
    return number("1.99") - number("0.48") * ((1 - mu + d_1) * (1 + mu + d_2))


def force_left(speed, linear_share):
    return 1 - linear_share * speed - (1 - linear_share) * speed * speed


def quadratic_next(y, gap):
    """The half-cycle map of y = (V/k)^2 without disturbance."""
    return (y + gap) / (y + 1)


def quadratic_overshoot(r):
    return (1 + r) * call("ln_1p", r) + (1 - r) * call("ln_1p", -r)


def quadratic_overshoot_bound(r):
    return (1 + r) * call("ln_1p", r) - call("sqrt", 1 - r)


def linear_overshoot(t):
    return t * (t - call("ln_1p", t)) - (1 - t) * (call("atanh", t) - t)


def linear_overshoot_bound(t):
    inverse = ((1 - t) * call("ln_1p", t) + call("sqrt", 1 - t)) / 2
    return t * (t - call("ln_1p", t)) - (inverse - (1 - t) * t)


def linear_width(z):
    return z - call("tanh", z)


def logarithm(v):
    return call("exp", v) - 2 * v


MU = ("mu", -1.0, 1.0)
BRAKING = [MU, ("drag", 0.0, 2.0)]
DRAGS = [MU, ("d_1", 0.0, 2.0), ("d_2", 0.0, 2.0)]
SHARE = ("linear_share", 0.0, 1.0)

# Identifier: what is positive, variables with their ends, formula.
INEQUALITIES = {
    "excess-first": (slope(1), DRAGS, excess),
    "excess-second": (slope(2), DRAGS, excess),
    "denominator": (VALUE, [MU, ("s_1", 0.0, 1.0), ("s_2", 0.0, 1.0)], rate_left),
    "force-slow": (VALUE, [("speed", 0.0, 0.5), SHARE], force_left),
    "force-fast": (slope(0), [("speed", 0.5, 1.0), SHARE], lambda speed, share: -force_left(speed, share)),
    "braking": (slope(0), BRAKING, lambda mu, drag: mu - 1 - drag),
    "braking-drag": (slope(1), BRAKING, lambda mu, drag: 1 - mu + drag),
    "quadratic-next": (slope(1), [("y", 0.0, 1.0), ("gap", 0.0, 1.0)], quadratic_next),
    "linear-width-short": (over_power(3, 0.5), [("z", 0.0, 0.5)], linear_width),
    "linear-width-long": (slope(0), [("z", 0.5, UP)], linear_width),
    "quadratic-overshoot-weak": (over_power(2, 0.05), [("r", 0.0, 0.9)], quadratic_overshoot),
    "quadratic-overshoot-strong": (VALUE, [("r", 0.9, 1.0)], quadratic_overshoot_bound),
    "linear-overshoot-weak": (over_power(3, 0.05), [("t", 0.0, 0.9)], linear_overshoot),
    "linear-overshoot-strong": (VALUE, [("t", 0.9, 1.0)], linear_overshoot_bound),
    "logarithm-low": (VALUE, [("v", 0.0, 1.0)], logarithm),
    "logarithm-high": (slope(0), [("v", 1.0, UP)], logarithm),
}

SLOPE = ["excess-first", "excess-second", "denominator"]
FORCE = ["force-slow", "force-fast"]
WIDTH = ["linear-width-short", "linear-width-long"]
LOGARITHM = ["logarithm-low", "logarithm-high"]

# Claim: its statement, its inequalities.
CLAIMS = {
    "orbit-quadratic": (
        "Quadratic drag: one limit cycle for every alpha, beta, C, x_a > 0, reached from every start",
        SLOPE + FORCE + ["quadratic-next"],
    ),
    "orbit-linear": (
        "Linear drag: one limit cycle for every alpha, beta, C, x_a > 0, reached from every start",
        SLOPE + FORCE + WIDTH,
    ),
    "orbit-quadratic-disturbed": (
        "Quadratic drag with a disturbance: one limit cycle, reached from every start",
        SLOPE + FORCE + ["braking", "braking-drag"],
    ),
    "orbit-linear-disturbed": (
        "Linear drag with a disturbance: one limit cycle, reached from every start",
        SLOPE + FORCE + ["braking", "braking-drag"],
    ),
    "orbit-no-early-switching": (
        "Between two switchings the velocity changes sign once, beyond the relay's level: the command switches when the formulas say",
        FORCE + ["braking", "braking-drag"],
    ),
    "orbit-multiplier": (
        "Without delay 1 - m > 0.48 (d_1 + d_2): the multiplier m by the drag forces d_1, d_2 at the switchings over C",
        SLOPE,
    ),
    "orbit-amplitude-monotone-quadratic": (
        "Quadratic drag: (X_m - x_a)/x_a falls as g grows, so that the amplitude identifies g",
        ["quadratic-overshoot-weak", "quadratic-overshoot-strong"] + LOGARITHM,
    ),
    "orbit-amplitude-monotone-linear": (
        "Linear drag: (X_m - x_a)/x_a falls as g grows, so that the amplitude identifies g",
        ["linear-overshoot-weak", "linear-overshoot-strong"] + LOGARITHM + WIDTH,
    ),
}


# The method's relative error on symmetric orbits: claim, statement, law, parameter, and for each range of the coordinate
# (identifier, from, to) the centre and radius within which the error lies.
CURVES = {
    "method-bias-alpha-linear": (
        "Linear drag: the method's error of alpha is +3.2 % as g goes to 0, -3 % at 1, +47 % at 10, below 5 % for g <= 1",
        "linear", "alpha", 1.97, 11.0, "0.05", "0.48", "0.032", (1.95, "-0.03"), (10.99, "0.47"),
    ),
    "method-bias-beta-linear": (
        "Linear drag: the method's error of beta is +8 % as g goes to 0, -4 % at 1, -16 % at 10, below 17 % up to there",
        "linear", "drag", 1.97, 11.0, "0.09", "0.17", "0.0808", (1.95, "-0.041"), (10.99, "-0.16"),
    ),
    "method-bias-alpha-quadratic": (
        "Quadratic drag: the method's error of alpha is +3.2 % as g goes to 0, -6.5 % at 1, +52 % at 10",
        "quadratic", "alpha", 2.7, 20.7, "0.08", "0.53", "0.032", (2.68, "-0.065"), (20.68, "0.52"),
    ),
    "method-bias-beta-quadratic": (
        "Quadratic drag: the method's error of beta_xx is +22 % as g goes to 0, -9 % at 1, -35 % at 10, below 36 % up to there",
        "quadratic", "drag", 2.7, 20.7, "0.22", "0.36", "0.2158", (2.68, "-0.088"), (20.68, "-0.346"),
    ),
}


def curve(law, part, centre, radius):
    """What the radius leaves of the error's distance from the centre."""
    return lambda coordinate: number(radius) - (error(law, part, coordinate) - number(centre)).size()


def curves(claim):
    """The inequalities of a curve, as in INEQUALITIES."""
    _, law, part, one, ten, up_to_one, up_to_ten, at_zero, at_one, at_ten = CURVES[claim]
    ranges = {
        "up-to-one": (0.0, one, "0", up_to_one),
        "up-to-ten": (0.0, ten, "0", up_to_ten),
        "at-zero": (0.0, 0.01, at_zero, "0.002"),
        "at-one": (at_one[0], one, at_one[1], "0.006"),
        "at-ten": (at_ten[0], ten, at_ten[1], "0.006"),
    }
    return {
        name: ({"kind": "enclosed"}, [("coordinate", start, end)], curve(law, part, centre, radius))
        for name, (start, end, centre, radius) in ranges.items()
    }


PI = Range.around([arb.pi()])
NEAR_ZERO = arb("0.0625")


def error(law, part, at):
    """Of the first-harmonic method on the exact orbit, in units of X_m and of the coordinate's time: level 1, no bias."""
    alpha, period, share, share_rate = (linear_orbit if law == "linear" else quadratic_orbit)(at)
    omega = 2 * PI / period
    if part == "alpha":
        return 4 * call("sqrt", 1 - share.square()) / PI / omega.square() / alpha - 1
    lag = 4 * share_rate / PI
    if law == "linear":
        return lag / omega / alpha - 1
    return lag / (8 / (3 * PI) * omega.square()) / alpha.square() - 1


def from_ends(at, function):
    """Of a function that increases."""
    ends = [function(Range(end)) for end in (at.lower, at.upper)]
    return ends[0].join(ends[1])


def tanh_ratio(at):
    """tanh(x)/x falls from one; its square root's tangent line bounds it: 1 - tanh(x)^2 <= tanh(x)/x <= 1."""
    return Range((1 - call("tanh", Range(at.upper)).square()).lower, arb(1))


def linear_orbit(z):
    """X_m = z - ln(1 + tanh z) is the integral of tanh, x_a = z - tanh z that of its square; T = 4 z."""
    if z.upper <= NEAR_ZERO:
        alpha = tanh_ratio(z) / 2
        rate = tanh_ratio(z).square() / (3 * alpha)
        return alpha, Range(4), z * rate, rate
    amplitude = lambda z: z - call("ln_1p", call("tanh", z))
    alpha = from_ends(z, amplitude) / z.square()
    share = from_ends(z, lambda z: linear_width(z) / amplitude(z))
    return alpha, Range(4), share, share / z


def quadratic_orbit(t):
    """X_m = t/2, x_a = ln(cosh t)/2, T = 2 (atan s + atanh s)/sqrt t with s^2 = tanh t."""
    alpha = Range(1) / 2
    if t.upper <= NEAR_ZERO:
        # atan s + atanh s = 2 s (1 + s^4/5 + s^8/9 + ...) and ln cosh t is the integral of tanh.
        ratio, fourth = tanh_ratio(t), Range(t.upper).square()
        tail = Range(arb(0), (fourth / (5 * (1 - fourth))).upper)
        return alpha, 4 * call("sqrt", ratio) * (1 + tail), t * ratio / 2, ratio / 2
    share = from_ends(t, lambda t: t.increasing(lambda end: end.cosh().log()) / t)

    def time(t):
        root = call("sqrt", call("tanh", t))
        # atanh s = ln(1 + s) - ln(1 - s^2)/2 and 1 - tanh t = 2/(exp(2 t) + 1).
        rest = Range(2) / (call("exp", 2 * t) + 1)
        return root.increasing(lambda end: end.atan()) + call("ln_1p", root) - call("ln", rest) / 2

    return alpha, 2 * from_ends(t, time) / call("sqrt", t), share, share / t


def statement(claim):
    """The words of a claim."""
    return (CLAIMS.get(claim) or CURVES[claim])[0]


def inequalities(claim):
    """Identifier to form, variables, formula."""
    return curves(claim) if claim in CURVES else {name: INEQUALITIES[name] for name in CLAIMS[claim][1]}
