"""Boxes along the axes and in slanted frames: what both hold, by substitution in Arb's balls.

A frame is `theta = centre + M z`, M unit lower triangular: each theta has its z, whatever numbers stand below the diagonal. Ends are
exact numbers, outwards of what they were computed from.
"""

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


def reach(weights, sides, start=0.0):
    """The ends of `start + sum weight * side`."""
    low = high = arb(start)
    for weight, side in zip(weights, sides):
        a, b = weight * arb(side[0]), weight * arb(side[1])
        low, high = (low + a, high + b) if weight >= 0 else (low + b, high + a)
    return low.lower(), high.upper()


def common(a, b):
    """What is in both; `None` where that is nothing."""
    low, high = max(a[0], b[0]), min(a[1], b[1])
    return (low, high) if low <= high else None


class Frame:
    """Row r stands for the unknown at `places[r]` of a box."""

    def __init__(self, places, centre, lower):
        require(len(centre) == len(places) == len(lower), "a frame is malformed")
        require(all(len(row) == r for r, row in enumerate(lower)), "a frame is not lower triangular")
        self.places, self.centre = places, [arb(number(c)) for c in centre]
        self.lower = [[arb(number(m)) for m in row] for row in lower]

    @staticmethod
    def straight(places, sides):
        """Along the axes, about a point near the middle."""
        middles = [float(((arb(sides[p][0]) + arb(sides[p][1])) / 2).mid()) for p in places]
        return Frame(places, middles, [[0.0] * r for r in range(len(places))])

    def coordinates(self, sides, narrower=None):
        """By substitution, met with what is known of them already."""
        z = []
        for row, place in enumerate(self.places):
            deviation = (arb(sides[place][0]) - self.centre[row], arb(sides[place][1]) - self.centre[row])
            low, high = reach([-m for m in self.lower[row]], z)
            own = ((deviation[0] + low).lower(), (deviation[1] + high).upper())
            own = own if narrower is None else common(own, narrower[row])
            if own is None or not own[0] <= own[1]:
                return None
            z.append(own)
        return z

    def side(self, row, z):
        return reach(self.lower[row] + [arb(1)], z, self.centre[row])


class Box:
    """Ranges along the axes, and perhaps in a frame; `known` is the last motion to the second order over a box that holds this one."""

    def __init__(self, sides, frame=None, z=None, known=None):
        self.sides, self.frame, self.z, self.known = list(sides), frame, z, known

    def replaced(self, **parts):
        own = {"sides": self.sides, "frame": self.frame, "z": self.z, "known": self.known}
        return Box(**(own | parts))

    def met(self):
        """The same narrowed to what axes and frame have in common; `None` where that is nothing."""
        if self.frame is None:
            return self
        z = self.frame.coordinates(self.sides, self.z)
        if z is None:
            return None
        sides = list(self.sides)
        for row, place in enumerate(self.frame.places):
            sides[place] = common(sides[place], self.frame.side(row, z))
            if sides[place] is None:
                return None
        return self.replaced(sides=sides, z=z)

    def shortened(self, cuts):
        sides = shortened(self.sides, cuts)
        return [] if sides is None else [self.replaced(sides=sides)]

    def divided(self, place, at):
        """Both parts, the lower one last."""
        low, high = self.sides[place]
        require(low <= at <= high, "the division is not within the box")
        return [self.replaced(sides=with_side(self.sides, place, half)) for half in ((at, high), (low, at))]

    def parted(self, row, at):
        require(self.frame is not None, "a part by a coordinate of no frame")
        require(0 <= row < len(self.z), "no such coordinate")
        low, high = self.z[row]
        require(low <= at <= high, "the part is not within the box")
        return [self.replaced(z=with_side(self.z, row, half)) for half in ((at, high), (low, at))]

    def along(self, frame):
        """The coordinates of a frame, by substitution."""
        return frame.coordinates(self.sides, self.z if frame is self.frame else None)

    def turned(self, frame, cuts):
        """In a frame, with what its coordinates are shown to be."""
        turned = frame is not self.frame
        z = self.along(frame)
        z = None if z is None else shortened(z, cuts)
        return [] if z is None else [self.replaced(frame=frame, z=z, known=None if turned else self.known)]


def reached(cut, side, most):
    """A cut as far as an upper bound shows it; `None` where that is nowhere. One that is to leave nothing must leave nothing. `most`
    gives the bound, of an upper end or of the negative of a lower one, where it is needed."""
    sign, end = 1 if cut["upper"] else -1, number(cut["end"])
    low, high = side if sign > 0 else (-side[1], -side[0])
    bound = None if high <= sign * end else most()
    if bound is None or bound <= sign * end:
        return cut | {"end": end}
    require(low <= sign * end, "a range is said to be empty, and is not")
    bound = arb(bound).upper()
    return cut | {"end": sign * up(bound)} if bound.is_finite() else None


def with_side(sides, place, side):
    return sides[:place] + [side] + sides[place + 1 :]


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
