"""Functions of ranges, and Taylor series over them: powers of one variable, or value, gradient and second derivatives."""

from range import Range


def derivatives(name, x, order):
    """The Taylor coefficients of a function at every point of a range, up to the order, at most three."""
    one = Range(1)
    if name in ("exp", "exp_m1"):
        e = x.increasing(lambda end: end.exp())
        value = x.increasing(lambda end: end.expm1()) if name == "exp_m1" else e
        return [value, e, e / 2, e / 6][: order + 1]
    if name in ("ln", "ln_1p"):
        base = x if name == "ln" else x + 1
        if not base.lower > 0:
            raise ValueError("a logarithm of what may not be positive")
        value = x.increasing(lambda end: end.log() if name == "ln" else end.log1p())
        inverse = one / base
        return [value, inverse, inverse.square() / -2, inverse * inverse.square() / 3][: order + 1]
    if name == "sqrt":
        if x.lower < 0:
            raise ValueError("a root of what may be negative")
        root = x.increasing(lambda end: end.sqrt())
        if order == 0:
            return [root]
        return [root, one / (2 * root), -one / (8 * root * x), one / (16 * root * x * x)][: order + 1]
    if name == "tanh":
        t = x.increasing(lambda end: end.tanh())
        slope = 1 - t.square()
        return [t, slope, -t * slope, slope * (3 * t.square() - 1) / 3][: order + 1]
    if name == "atanh":
        if not (x.lower > -1 and x.upper < 1):
            raise ValueError("an inverse hyperbolic tangent of what may reach one")
        value = x.increasing(lambda end: end.atanh())
        inverse = one / (1 - x.square())
        return [value, inverse, x * inverse.square(), (1 + 3 * x.square()) * inverse * inverse.square() / 3][: order + 1]
    if name == "abs" and order == 0:
        return [x.size()]
    if name == "atan" and order == 0:
        return [x.increasing(lambda end: end.atan())]
    raise ValueError(f"`{name}` is not a known function")


def call(name, x):
    """A function in the arithmetic of its argument."""
    return derivatives(name, x, 0)[0] if isinstance(x, Range) else x.apply(name)


class Jet:
    """Powers of one variable up to the third: the coefficients."""

    ORDER = 3

    def __init__(self, terms):
        self.terms = terms

    @classmethod
    def lift(cls, value):
        return value if isinstance(value, Jet) else cls([Range.of(value)] + [Range(0)] * cls.ORDER)

    @classmethod
    def variable(cls, at):
        return cls([at, Range(1)] + [Range(0)] * (cls.ORDER - 1))

    def apply(self, name):
        outer, rest = derivatives(name, self.terms[0], self.ORDER), Jet([Range(0)] + self.terms[1:])
        result = Jet.lift(outer[-1])
        for coefficient in reversed(outer[:-1]):
            result = result * rest + coefficient
        return result

    def __add__(self, other):
        return Jet([a + b for a, b in zip(self.terms, Jet.lift(other).terms)])

    def __neg__(self):
        return Jet([-a for a in self.terms])

    def __sub__(self, other):
        return self + -Jet.lift(other)

    def __mul__(self, other):
        a, b = self.terms, Jet.lift(other).terms
        return Jet([sum((a[i] * b[k - i] for i in range(k + 1)), Range(0)) for k in range(self.ORDER + 1)])

    def __truediv__(self, other):
        a, b, quotient = self.terms, Jet.lift(other).terms, []
        for k in range(self.ORDER + 1):
            quotient.append((a[k] - sum((quotient[i] * b[k - i] for i in range(k)), Range(0))) / b[0])
        return Jet(quotient)

    __radd__ = __add__
    __rmul__ = __mul__

    def __rsub__(self, other):
        return Jet.lift(other) - self

    def __rtruediv__(self, other):
        return Jet.lift(other) / self


class Bend:
    """Value, gradient and matrix of second derivatives."""

    def __init__(self, value, slopes, bends):
        self.value, self.slopes, self.bends = value, slopes, bends

    @classmethod
    def variables(cls, box):
        count = len(box)
        flat = [[Range(0)] * count for _ in box]
        return [cls(at, [Range(int(i == place)) for i in range(count)], flat) for place, at in enumerate(box)]

    def like(self, value):
        if isinstance(value, Bend):
            return value
        count = len(self.slopes)
        return Bend(Range.of(value), [Range(0)] * count, [[Range(0)] * count] * count)

    def apply(self, name):
        value, first, second = derivatives(name, self.value, 2)
        return self.chain(value, first, 2 * second)

    def chain(self, value, first, second):
        bends = [
            [first * bend + second * u * v for bend, v in zip(row, self.slopes)] for row, u in zip(self.bends, self.slopes)
        ]
        return Bend(value, [first * slope for slope in self.slopes], bends)

    def __add__(self, other):
        other = self.like(other)
        bends = [[a + b for a, b in zip(*rows)] for rows in zip(self.bends, other.bends)]
        return Bend(self.value + other.value, [a + b for a, b in zip(self.slopes, other.slopes)], bends)

    def __neg__(self):
        return self * -1

    def __sub__(self, other):
        return self + -self.like(other)

    def __mul__(self, other):
        other = self.like(other)
        a, b, places = self.value, other.value, range(len(self.slopes))
        (u, m), (v, n) = (self.slopes, self.bends), (other.slopes, other.bends)
        bends = [[a * n[i][j] + b * m[i][j] + u[i] * v[j] + u[j] * v[i] for j in places] for i in places]
        return Bend(a * b, [a * v[i] + b * u[i] for i in places], bends)

    def __truediv__(self, other):
        other = self.like(other)
        inverse = 1 / other.value
        return self * other.chain(inverse, -inverse.square(), 2 * inverse * inverse.square())

    __radd__ = __add__
    __rmul__ = __mul__

    def __rsub__(self, other):
        return self.like(other) - self

    def __rtruediv__(self, other):
        return self.like(other) / self
