"""Boxes of floats, outwards of the numbers from which they were computed."""

from flint import arb

from check import require


def number(value):
    require(type(value) in (int, float), "what should be a number is none")
    value = float(value)
    require(abs(value) < float("inf"), "what should be a number is none")
    return value


def down(x):
    return float(x) - 1e-15 * abs(float(x))


def up(x):
    return float(x) + 1e-15 * abs(float(x))


class Box:
    """The range of each unknown."""

    def __init__(self, sides):
        self.sides = list(sides)

    def shortened(self, cuts):
        sides = shortened(self.sides, cuts)
        return [] if sides is None else [Box(sides)]

    def divided(self, place, at):
        """Both parts, the lower one last."""
        require(0 <= place < len(self.sides), "a division of no unknown")
        low, high = self.sides[place]
        require(low <= at <= high, "the division is not within the box")
        return [Box(self.sides[:place] + [half] + self.sides[place + 1 :]) for half in ((at, high), (low, at))]


def reached(cut, side, most):
    """A cut as far as an upper bound shows it; `None` where that is nowhere. One that is to leave nothing must leave nothing. `most`
    gives the bound, of an upper end or of the negative of a lower one, where it is needed."""
    sign, end = 1 if cut["upper"] else -1, number(cut["end"])
    low, high = side if sign > 0 else (-side[1], -side[0])
    bound = None if high <= sign * end else most()
    if bound is None or bound <= sign * end:
        return cut | {"end": end}
    bound = arb(bound).upper()
    shown = up(bound) if bound.is_finite() else None
    require(low <= sign * end or (shown is not None and shown < low), "a range is said to be empty, and is not")
    return None if shown is None else cut | {"end": sign * shown}


def shortened(sides, cuts):
    sides = list(sides)
    for cut in cuts:
        place, end = int(cut["unknown"]), number(cut["end"])
        require(0 <= place < len(sides), "a cut of no unknown")
        low, high = sides[place]
        sides[place] = (low, min(high, end)) if cut["upper"] else (max(low, end), high)
        if not sides[place][0] <= sides[place][1]:
            return None
    return sides
