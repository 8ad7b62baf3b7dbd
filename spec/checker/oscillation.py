"""Verifies proofs that an oscillation exists, as `selfosc balance --certificates DIR` writes them. See README.md.

The loop is x = -G n(x), n odd with slopes in an interval, x of odd harmonics or of all. In balls: the equations up to the highest harmonic, linearised
about the centre, map the box of the radii into itself (Brouwer), and those above are a contraction.
"""

import sys

from flint import acb, acb_poly, arb, arb_mat, ctx

from check import Refused, checked, require

ctx.prec = 106
FORMAT = 2
HIGHEST_HARMONIC = 299
# First order and step of the harmonics.
ORDERS = {"odd": (1, 2), "all": (0, 1)}
MOST_KINKS = 64
CELLS = 64
HALVINGS = 30
SAMPLES = (256, 512, 1024, 2048, 4096)
# The range of a polynomial reaches beyond the centre's own by this share.
BEYOND = arb("1.01")

J = acb(0, 1)
PI = arb.pi()


def ball(middle, radius):
    return arb(middle, radius)


def top(value):
    """The upper end, as a ball without radius."""
    return arb(value).upper()


def bottom(value):
    """The lower end, as a ball without radius."""
    return arb(value).lower()


def around(bound):
    """The complex numbers of magnitude at most a bound, in a square."""
    side = arb(0, top(bound))
    return acb(side, side)


def length(values):
    return sum((abs(value) ** 2 for value in values), arb(0)).sqrt()


def turn(angle):
    """exp(j angle)."""
    return acb(0, angle).exp()


class Plant:
    def __init__(self, document):
        num, den = document["numerator"], document["denominator"]
        require(num and den and num[0] != 0.0 and den[0] != 0.0, "a leading coefficient is zero")
        require(len(num) < len(den), "the plant is not strictly proper")
        self.num, self.den, self.delay = [[arb(c) for c in p] for p in (num, den)] + [arb(document["delay_s"])]
        require(self.delay >= 0, "the dead time is below zero")
        self.degree = len(den) - len(num)

    def inverse(self, k, omega):
        """1/G(jkw) and its derivative by w."""
        s = J * k * omega
        polynomial = lambda p: sum((c * s ** (len(p) - 1 - i) for i, c in enumerate(p)), acb(0))
        slope = lambda p: sum(((len(p) - 1 - i) * c * s ** max(len(p) - 2 - i, 0) for i, c in enumerate(p[:-1])), acb(0))
        over = polynomial(self.den) / polynomial(self.num)
        rate = (slope(self.den) - over * slope(self.num)) / polynomial(self.num) + self.delay * over
        late = (s * self.delay).exp()
        return over * late, J * k * rate * late

    def growth(self, start):
        """c with abs(1/G(jy)) >= c y^degree beyond `start`."""
        share = lambda p: sum((abs(c / p[0]) / start ** (i + 1) for i, c in enumerate(p[1:])), arb(0))
        return abs(self.den[0] / self.num[0]) * (1 - share(self.den)) / (1 + share(self.num))


class Wave:
    """u(theta) = Re sum X_k exp(jk theta), of odd orders or of all."""

    def __init__(self, orders, harmonics):
        self.first, self.step = ORDERS[orders]
        self.terms = [(self.first + self.step * i, acb(*x)) for i, x in enumerate(harmonics)]
        self.highest = self.terms[-1][0]
        # After which the wave repeats itself, with the opposite sign if odd.
        self.span = 2 * PI / self.step
        self.reals = sum(1 for k, _ in self.terms if k < 2)

    def orders(self, last):
        return range(self.first, last + 1, self.step)

    def magnitudes(self, power):
        return sum((k**power * abs(x) for k, x in self.terms), arb(0))

    def mean_square(self, power):
        return sum((k ** (2 * power) * abs(x) ** 2 / 2 for k, x in self.terms if k), arb(0))

    def at(self, theta):
        """Value and derivative."""
        turns = [(k, x * turn(k * theta)) for k, x in self.terms]
        return sum((z.real for _, z in turns), arb(0)), sum((-k * z.imag for k, z in turns), arb(0))

    def peak(self, samples=1024):
        step = self.span / samples
        most = arb(0)
        for i in range(samples):
            most = most.max(abs(self.at(step * i)[0]))
        # At a peak the slope vanishes; the nearest sample is within half a step of it.
        return most + self.magnitudes(2) * (step / 2) ** 2 / 2


class Output:
    """N_k and D_m of n(u) and n'(u), the root mean square of what is not listed, and the remainder of the linearisation."""

    def __init__(self, output, slope, rest, remainder):
        self.output, self.slope, self.rest, self.remainder = output, slope, rest, remainder

    def d(self, m):
        found = self.slope.get(abs(m), acb(0))
        return found.conjugate() if m < 0 else found


def hull(values):
    found = values[0]
    for value in values[1:]:
        found = found.union(value)
    return found


class PiecewiseLinear:
    ranged = False

    def __init__(self, document):
        self.kinks, self.slopes = [arb(k) for k in document["kinks"]], [arb(s) for s in document["slopes"]]
        ordered = all(a < b for a, b in zip([arb(0), *self.kinks], self.kinks))
        require(self.kinks and ordered and len(self.kinks) <= MOST_KINKS, "the kinks are not above zero and in order")
        require(len(self.slopes) == len(self.kinks) + 1, "not one slope more than kinks")

    def slope_range(self, _):
        return hull(self.slopes)

    def passages(self, wave, margin):
        """Phase, slope jump and least speed of every passage of a kink in a span, with slope and offset at its beginning."""
        levels = [(i, sign * kink) for i, kink in enumerate(self.kinks) for sign in (1, -1)]
        bend = wave.magnitudes(2)
        distance = lambda theta: min(float(abs(wave.at(arb(theta))[0] - level)) for _, level in levels)
        start = arb(max((float(wave.span) * i / CELLS for i in range(CELLS)), key=distance))
        part = wave.span / CELLS
        stack = [(start + part * i, start + part * (i + 1), HALVINGS) for i in reversed(range(CELLS))]
        cells = []
        while stack:
            low, high, left = stack.pop()
            middle, half = (low + high) / 2, (high - low) / 2
            value, slope = wave.at(middle)
            slope = slope + arb(0, top(bend * half))
            value = value + slope * arb(0, top(half))
            if all(abs(value - level) > margin for _, level in levels):
                cells.append((low, high, None))
            elif not slope.contains(0):
                cells.append((low, high, slope))
            else:
                require(left > 0, "grazing: a kink is touched, or passed too slowly")
                stack += [(middle, high, left - 1), (low, middle, left - 1)]
        require(cells[0][2] is None and cells[-1][2] is None, "grazing: the span begins at a kink")
        runs, before = [], None
        for low, high, slope in cells:
            if slope is not None and before is not None:
                runs[-1] = (runs[-1][0], high, runs[-1][2].union(slope))
            elif slope is not None:
                runs.append((low, high, slope))
            before = slope
        found = []
        for low, high, slope in runs:
            require(not slope.contains(0), "grazing: the speed has no sign")
            first, last = wave.at(low)[0], wave.at(high)[0]
            for i, level in levels:
                require(all(end > level or end < level for end in (first, last)), "grazing: an end lies on a kink")
                if (first > level) == (last > level):
                    continue
                outwards = (level > 0) == (slope > 0)
                jump = self.slopes[i + 1] - self.slopes[i]
                found.append((self.passage(wave, low, high, level, slope > 0), jump if outwards else -jump, bottom(abs(slope)), level))
        value = wave.at(start)[0]
        inside = sum(1 for kink in self.kinks if abs(value) > kink)
        offset = sum(((self.slopes[i] - self.slopes[i + 1]) * self.kinks[i] for i in range(inside)), arb(0))
        return sorted(found, key=lambda one: float(one[0])), self.slopes[inside], offset if value > 0 else -offset

    @staticmethod
    def passage(wave, low, high, level, rising):
        """A ball that holds the passage of a level between two phases: halved, then by Newton's interval step."""
        bend = wave.magnitudes(2)
        low, high = low.mid(), high.mid()
        for _ in range(60):
            middle, half = (low + high) / 2, (high - low) / 2
            value, slope = wave.at(middle.mid())
            slope = slope + arb(0, top(bend * half))
            if not slope.contains(0):
                break
            above = value > level
            require(above or value < level, "grazing: a passage is not found")
            low, high = (low, middle.mid()) if above == rising else (middle.mid(), high)
        cell = low.union(high)
        for _ in range(8):
            middle = cell.mid()
            slope = wave.at(middle)[1] + arb(0, top(bend * cell.rad()))
            cell = cell.intersection(middle - (wave.at(middle)[0] - level) / slope)
        return cell

    def along(self, wave, margin, _):
        gaps = [2 * self.kinks[0], *(b - a for a, b in zip(self.kinks, self.kinks[1:]))]
        require(all(gap > 2 * margin for gap in gaps), "grazing: the box is wider than the kinks' distance")
        passages, at_start, offset = self.passages(wave, margin)
        last = 4 * wave.highest + 101
        slope = {0: acb(at_start - sum((jump * theta for theta, jump, *_ in passages), arb(0)) / wave.span)}
        for m in range(wave.step, last + wave.highest + 1, wave.step):
            slope[m] = sum((jump * turn(-m * theta) for theta, jump, *_ in passages), acb(0)) / (J * m * wave.span)
        found = Output({}, slope, None, None)
        # The derivative of n(u) is n'(u) u'.
        for k in wave.orders(last):
            if k == 0:
                # Of the lines between the kinks: at a passage the offset jumps by -jump level.
                swing = lambda theta: sum(((x * turn(l * theta)).imag / l for l, x in wave.terms[1:]), arb(0))
                lines = sum((jump * (level * theta - swing(theta)) for theta, jump, _, level in passages), arb(0))
                found.output[0] = acb(slope[0].real * wave.terms[0][1].real + offset + lines / wave.span)
                continue
            parts = (l * (found.d(k - l) * x - found.d(k + l) * x.conjugate()) for l, x in wave.terms)
            found.output[k] = sum(parts, acb(0)) / k
        steepest = max((abs(s) for s in self.slopes), key=float)
        variation = 2 * PI * steepest * wave.mean_square(2).sqrt()
        variation += sum((wave.step * abs(jump * wave.at(theta)[1]) for theta, jump, *_ in passages), arb(0))
        # abs(N_k) <= V/(pi k^2), and the sum of k^-4 over k beyond K in steps of s is below 1/(3 s K^3).
        found.rest = variation / PI / (6 * wave.step * arb(last) ** 3).sqrt()
        kinked = sum((wave.step * jump**2 / (3 * PI * speed) for _, jump, speed, _ in passages), arb(0))
        found.remainder = lambda delta: (kinked * delta**3).sqrt()
        return found


class Polynomial:
    """Along a wave the output is a trigonometric polynomial, too: its harmonics are exact."""

    ranged = True

    def __init__(self, document):
        self.odd = [arb(c) for c in document["odd_coefficients"]]
        require(1 <= len(self.odd) <= 5, "one to five coefficients are wanted")

    def slope_range(self, limit):
        parts = [limit * arb((i + 0.5) / 256, 0.5 / 256) for i in range(256)]
        return hull([sum(((2 * j + 1) * c * x ** (2 * j) for j, c in enumerate(self.odd)), arb(0)) for x in parts])

    def along(self, wave, _, limit):
        # In powers of z = exp(j theta), times z^highest.
        shift = wave.highest
        coefficients = [acb(0)] * (2 * shift + 1)
        for k, x in wave.terms:
            coefficients[shift + k] += x / 2
            coefficients[shift - k] += x.conjugate() / 2
        u, power = acb_poly(coefficients), acb_poly([acb(1)])
        output, slope = {}, {}
        for n in range(1, 2 * len(self.odd)):
            if n % 2 == 1:
                c = self.odd[n // 2]
                for m in range(0, (n - 1) * shift + 1, wave.step):
                    slope[m] = slope.get(m, acb(0)) + n * c * power[(n - 1) * shift + m]
            power = power * u
            if n % 2 == 1:
                for k in wave.orders(n * shift):
                    output[k] = output.get(k, acb(0)) + (2 if k else 1) * self.odd[n // 2] * power[n * shift + k]
        for k in wave.orders(wave.highest + 2 * shift + 3):
            output.setdefault(k, acb(0))
        bend = sum(((2 * j + 1) * 2 * j * abs(c) * limit ** (2 * j - 1) for j, c in enumerate(self.odd) if j), arb(0))
        return Output(output, slope, arb(0), lambda delta: bend / 2 * delta**2)


class Tanh:
    ranged = False

    def __init__(self, document):
        self.gain, self.scale = arb(document["gain"]), arb(document["scale"])
        require(self.scale > 0, "the scale is not above zero")

    def slope_range(self, _):
        return arb(0).union(self.gain * self.scale)

    def along(self, wave, *_):
        # Where abs(Im scale u) < pi/4, abs(tanh) <= 1 and abs(tanh') <= 2.
        imaginary = lambda width: sum((abs(x) * (k * width).sinh() for k, x in wave.terms), arb(0))
        width = next(w for w in (arb(4) * arb("0.8") ** i for i in range(200)) if self.scale * imaginary(w) < PI / 4)
        least = 2 * wave.highest + 2
        samples = next((m for m in SAMPLES if m / 4 > least and float(width) * m > 160), SAMPLES[-1])
        last = samples // 4 - 1
        turns = [turn(2 * PI * i / samples) for i in range(samples)]
        values = []
        for i in range(samples // wave.step):
            u = sum(((x * turns[k * i % samples]).real for k, x in wave.terms), arb(0))
            t = (self.scale * u).tanh()
            values.append((self.gain * t, self.gain * self.scale * (1 - t**2)))
        missed = lambda bound, order: around(
            2 * abs(bound) * (-width * (samples - order)).exp() / (1 - (-width * samples).exp())
        )
        total = lambda place, order: sum((v[place] * turns[-order * i % samples] for i, v in enumerate(values)), acb(0))
        share = arb(1) / len(values)
        output = {k: (2 if k else 1) * share * total(0, k) + missed(2 * self.gain, k) for k in wave.orders(last)}
        orders = range(0, 2 * wave.highest + 1, wave.step)
        slope = {m: share * total(1, m) + missed(2 * self.gain * self.scale, m) for m in orders}
        rest = abs(self.gain) * (-width * (last + wave.step)).exp() * (2 / (1 - (-2 * wave.step * width).exp())).sqrt()
        bend = abs(self.gain) * self.scale**2 * arb("0.7699")
        return Output(output, slope, rest, lambda delta: bend / 2 * delta**2)


KINDS = {"piecewise-linear": PiecewiseLinear, "polynomial": Polynomial, "tanh": Tanh}


def check(document):
    """Bounds of amplitude and frequency, or Refused."""
    require(document["claim"] == "oscillation" and document["format"] == FORMAT, "another claim or format")
    plant, kind = Plant(document["plant"]), document["characteristic"]["kind"]
    require(kind in KINDS, "another kind of characteristic")
    characteristic = KINDS[kind](document["characteristic"])
    harmonics, sides = document["harmonics"], document["radii"]
    require(document["orders"] in ORDERS, "other orders than odd or all")
    wave = Wave(document["orders"], harmonics)
    require(2 <= len(harmonics) == len(sides) and 1 < wave.highest <= HIGHEST_HARMONIC, "not as many radii as harmonics")
    require(
        all(pair[1] == 0.0 for pair in harmonics[: wave.reals] + sides[: wave.reals]),
        "the mean or the first harmonic has an imaginary part",
    )
    radii = [document["omega_radius_rad_s"]]
    radii += [r for i, pair in enumerate(sides) for r in (pair if i >= wave.reals else pair[:1])]
    require(all(r > 0.0 for r in radii), "a radius is not above zero")
    omega = ball(document["omega_rad_s"], radii[0])
    amplitude = ball(harmonics[wave.reals - 1][0], radii[wave.reals])
    require(omega > 0 and amplitude > 0, "amplitude or frequency may be zero")
    size = len(radii)

    # What the box leaves open: sup abs(h) and norm(h).
    parts = [length([arb(r) for r in pair]) for pair in sides]
    # Half the square of an amplitude counts, but all of a mean's.
    means = parts[:1] if wave.first == 0 else []
    delta, norm = sum(parts, arb(0)), length(parts + means) / arb(2).sqrt()
    peak = wave.peak() if characteristic.ranged else None
    limit = top(BEYOND * peak) if characteristic.ranged else None
    along = characteristic.along(wave, top(delta), limit)

    # Equations and their derivatives: real and imaginary parts of each order, by the frequency and those of the harmonics. The mean's
    # balance is real, as the mean and X_1.
    errors, rows = [], []
    for k, x in wave.terms:
        response, rate = plant.inverse(k, omega)
        columns = [x * rate]
        share = arb(1) / (1 if k else 2)
        for l, _ in wave.terms:
            below, above = share * along.d(k - l) + (response if k == l else 0), share * along.d(k + l)
            columns += [below + above] if l < 2 else [below + above, J * (below - above)]
        balance = x * plant.inverse(k, arb(document["omega_rad_s"]))[0] + along.output[k]
        for part in ("real", "imag")[: 2 if k else 1]:
            errors.append([getattr(balance, part)])
            rows.append([getattr(column, part) for column in columns])
    error, jacobian = arb_mat(errors), arb_mat(rows)
    middle = lambda matrix: arb_mat([[entry.mid() for entry in row] for row in matrix.tolist()])
    preconditioner = middle(middle(jacobian).inv())
    excess = preconditioner * jacobian
    offset = preconditioner * error

    # Harmonics above: a contraction, and how large they are.
    slopes = characteristic.slope_range(limit)
    low, high = bottom(slopes), top(slopes)
    centre, half = (low + high) / 2, (high - low) / 2
    last = max(along.output)
    first, outputs, gain, rho = arb(0), arb(0), arb(0), None
    for k in range(wave.highest + wave.step, last + 1, wave.step):
        distance = abs(plant.inverse(k, omega)[0] + centre)
        require(distance > half, "rho: a high harmonic is not damped")
        rho = bottom(distance) if rho is None or bottom(distance) < rho else rho
        first += (abs(along.output[k]) / distance) ** 2 / 2
        outputs += abs(along.output[k]) ** 2 / 2
        gain += 1 / distance**2
    start = bottom(omega) * (last + wave.step)
    tail = plant.growth(start) - abs(centre) / start**plant.degree
    far = tail * start**plant.degree
    require(tail > 0 and far > half, "rho: the highest harmonics are not damped")
    rho = bottom(far) if rho is None or bottom(far) < rho else rho
    first, outputs = (first + (along.rest / far) ** 2).sqrt(), (outputs + along.rest**2).sqrt()
    q = plant.degree
    gain = (gain + arb(last) ** (1 - 2 * q) / (wave.step * (2 * q - 1)) / (tail * bottom(omega) ** q) ** 2).sqrt()
    eta = (first + half / rho * norm) / (1 - half / rho)
    require(eta <= document["remainder"], "the remainder is larger than stated")

    rest = half * eta + along.remainder(delta)
    for i in range(size):
        image = abs(offset[i, 0])
        for j in range(size):
            image += abs((1 if i == j else 0) - excess[i, j]) * radii[j]
        image += length([preconditioner[i, j] for j in range(size)]) * arb(2).sqrt() * rest
        require(image < radii[i], f"no contraction: side {i} of the box is not mapped into itself")
    if characteristic.ranged:
        reach = peak + delta + gain * (outputs + half * (norm + eta)) * arb(2).sqrt()
        require(reach <= limit, "range: the input may leave the range of the slopes")
    return amplitude, omega


def main(paths):
    accepted = True
    for path in paths:
        try:
            amplitude, omega = checked(check, path)
            print(f"{path}: accepted, amplitude {amplitude.str(15)}, rad/s {omega.str(15)}")
        except Refused as reason:
            accepted = False
            print(f"{path}: refused, {reason}")
    return 0 if accepted else 1


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
