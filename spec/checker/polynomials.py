"""Polynomials of degree 2 in a few coordinates with a rest, over balls about zero: products' higher degrees go into the rest."""

from fractions import Fraction

from flint import arb, arb_mat, fmpq

from motion import ONE, ZERO


def exact(x):
    """A ball without a radius as a fraction: instants are added and compared without rounding."""
    mantissa, exponent = x.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def ball(x):
    return arb(fmpq(x.numerator, x.denominator))


class Space:
    """Balls about zero, one for each coordinate."""

    def __init__(self, radii):
        self.count = len(radii)
        self.column = arb_mat([[arb(0, radius)] for radius in radii])
        self.row = self.column.transpose()
        self.none = arb_mat([[ZERO] * self.count])

    def constant(self, c, rest=ZERO):
        return Poly(self, c, self.none, None, rest)


class Poly:
    """`c + l w + w' q w + rest`."""

    __slots__ = ("space", "c", "l", "q", "rest", "bounds")

    def __init__(self, space, c, l, q, rest):
        self.space, self.c, self.l, self.q, self.rest = space, c, l, q, rest
        self.bounds = None

    def parts(self):
        """Ranges of what is of the first and of the second degree."""
        if self.bounds is None:
            space = self.space
            second = ZERO if self.q is None else (space.row * (self.q * space.column))[0, 0]
            self.bounds = (self.l * space.column)[0, 0], second
        return self.bounds

    def range(self):
        first, second = self.parts()
        return self.c + first + second + self.rest

    def __add__(self, other):
        q = other.q if self.q is None else self.q if other.q is None else self.q + other.q
        return Poly(self.space, self.c + other.c, self.l + other.l, q, self.rest + other.rest)

    def scaled(self, s):
        return Poly(self.space, self.c * s, self.l * s, None if self.q is None else self.q * s, self.rest * s)

    def __sub__(self, other):
        return self + other.scaled(-ONE)

    def with_rest(self, rest):
        return Poly(self.space, self.c, self.l, self.q, self.rest + rest)

    def __mul__(self, other):
        a, b = self, other
        (a1, a2), (b1, b2) = a.parts(), b.parts()
        q = a.l.transpose() * b.l
        if a.q is not None:
            q += a.q * b.c
        if b.q is not None:
            q += b.q * a.c
        higher = a1 * b2 + a2 * b1 + a2 * b2 + a.rest * b.range() + b.rest * (a.c + a1 + a2)
        return Poly(a.space, a.c * b.c, a.l * b.c + b.l * a.c, q, higher)

    def settled(self):
        """The nearest one of exact coefficients without a rest, and what it is off, about zero."""
        total = self.c + self.rest
        off = arb(0, total.rad()) + ((self.l - self.l.mid()) * self.space.column)[0, 0]
        q = self.q
        if q is not None:
            off += (self.space.row * ((q - q.mid()) * self.space.column))[0, 0]
            q = q.mid()
        return Poly(self.space, arb(total.mid()), self.l.mid(), q, ZERO), off

    def most(self, middle, radii):
        """An upper bound over `w = middle + d`, d within radii: about the middle, squares as squares."""
        q = self.q
        constant, linear = self.c + (self.l * middle)[0, 0], self.l
        total = ZERO
        if q is not None:
            both = q + q.transpose()
            constant += (middle.transpose() * (q * middle))[0, 0]
            linear = linear + middle.transpose() * both
            for i in range(len(radii)):
                square = q[i, i].upper()
                total += max(square, ZERO) * radii[i] * radii[i]
                for j in range(i):
                    total += abs(both[i, j]) * radii[i] * radii[j]
        for i, radius in enumerate(radii):
            total += abs(linear[0, i]) * radius
        return (constant + total + self.rest).upper()


def squares(v, k):
    """The coefficient of degree k of a square."""
    total = None
    for i in range((k + 1) // 2):
        part = v[i] * v[k - i]
        total = part if total is None else total + part
    total = None if total is None else total.scaled(arb(2))
    if k % 2 == 0:
        middle = v[k // 2] * v[k // 2]
        total = middle if total is None else total + middle
    return total
