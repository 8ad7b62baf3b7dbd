"""Intervals whose ends are computed with Arb, infinite ones included."""

from flint import arb, ctx

ctx.prec = 160
INFINITY = arb.pos_inf()


class Range:
    """All reals between two ends, which are exact numbers."""

    __slots__ = ("lower", "upper")

    def __init__(self, lower, upper=None):
        upper = lower if upper is None else upper
        self.lower, self.upper = arb(lower), arb(upper)
        if not (self.lower.is_exact() and self.upper.is_exact()):
            raise ValueError("ends are exact")

    @classmethod
    def around(cls, balls):
        """From the least lower bound of some balls to the greatest upper bound."""
        balls = list(balls)
        if any(ball.is_nan() for ball in balls):
            return cls(-INFINITY, INFINITY)
        return cls(min(below(ball) for ball in balls), max(above(ball) for ball in balls))

    @staticmethod
    def of(value):
        return value if isinstance(value, Range) else Range(value)

    def __add__(self, other):
        if not isinstance(other, (Range, int, float, arb)):
            return NotImplemented
        other = Range.of(other)
        return Range(below(self.lower + other.lower, -INFINITY), above(self.upper + other.upper, INFINITY))

    def __neg__(self):
        return Range(-self.upper, -self.lower)

    def __sub__(self, other):
        return self + -other

    def __rsub__(self, other):
        return Range.of(other) - self

    def __mul__(self, other):
        if not isinstance(other, (Range, int, float, arb)):
            return NotImplemented
        other = Range.of(other)
        ends = [(a, b) for a in (self.lower, self.upper) for b in (other.lower, other.upper)]
        return Range.around(arb(0) if a == 0 or b == 0 else a * b for a, b in ends)

    __radd__ = __add__
    __rmul__ = __mul__

    def __truediv__(self, other):
        other = Range.of(other)
        if other.lower <= 0 <= other.upper:
            return Range(-INFINITY, INFINITY)
        return self * Range.around([1 / other.lower, 1 / other.upper])

    def __rtruediv__(self, other):
        return Range.of(other) / self

    def square(self):
        size = self.size()
        return Range.around([size.lower**2, size.upper**2])

    def size(self):
        """The absolute values."""
        if self.lower >= 0:
            return self
        if self.upper <= 0:
            return -self
        return Range(arb(0), max(-self.lower, self.upper))

    def increasing(self, function):
        return Range.around([function(self.lower), function(self.upper)])

    def meet(self, other):
        return Range(max(self.lower, other.lower), min(self.upper, other.upper))

    def join(self, other):
        return Range(min(self.lower, other.lower), max(self.upper, other.upper))

    def middle(self):
        if not (self.lower.is_finite() and self.upper.is_finite()):
            return None
        return Range(arb(((self.lower + self.upper) / 2).mid()))

    def vanishes(self):
        return self.lower == 0 and self.upper == 0

    def __repr__(self):
        return f"[{self.lower.str(8, radius=False)}, {self.upper.str(8, radius=False)}]"


def below(ball, otherwise=None):
    """An exact number not above any of the ball."""
    if ball.is_nan():
        return -INFINITY if otherwise is None else otherwise
    return ball if ball.is_exact() else ball.lower()


def above(ball, otherwise=None):
    if ball.is_nan():
        return INFINITY if otherwise is None else otherwise
    return ball if ball.is_exact() else ball.upper()
