"""Verifies the orbits that `selfosc predict --num ... --certificate FILE` writes. See README.md."""

import sys

from flint import arb, arb_mat, ctx

from check import Refused, checked, require

CERTIFICATE, FORMAT = "two-level-orbits", 1
STATEMENT = (
    "Each box of half-periods holds those of an orbit with one switching each way; its extremes are within their bounds; "
    "small deviations from it die out (true), grow (false) or are not decided (null)"
)
PRECISIONS = (192, 384, 1152)
MOST_ORBITS, MOST_ORDER, MOST_UNDER_WAY = 100, 8, 60
HALVINGS, SQUARINGS = 90, 16


class Undecided(Exception):
    """The precision does not suffice."""


def known(condition, reason):
    if not condition:
        raise Undecided(reason)


def hull(lower, upper):
    return arb(lower).union(arb(upper))


class Plant:
    """`x' = A x + B u`, `y = C x` in controllable canonical form, bordered by the input as a last state."""

    def __init__(self, num, den):
        order = len(den) - 1
        require(0 < order <= MOST_ORDER and 0 < len(num) <= order and den[0] != 0, "the plant is not strictly proper, or of too high an order")
        lead = arb(den[0])
        self.order, size = order, order + 1
        self.rate = arb_mat(size, size, [0] * size * size)
        for i in range(order - 1):
            self.rate[i, i + 1] = 1
        for j in range(order):
            self.rate[order - 1, j] = -arb(den[order - j]) / lead
        self.rate[order - 1, order] = 1
        self.read = arb_mat(1, size, [arb(c) / lead for c in reversed(num)] + [0] * (size - len(num)))

    def flow(self, time):
        """exp(M t); over a ball of times that of its middle times that of the rest."""
        middle = (self.rate * time.mid()).exp()
        return middle if time.is_exact() else middle * (self.rate * (time - time.mid())).exp()

    def with_input(self, state, level):
        return arb_mat(self.order + 1, 1, [state[i, 0] for i in range(self.order)] + [level])


class Loop:
    def __init__(self, item):
        numbers = {name: arb(float(item[name])) for name in ("delay_s", "high", "low", "half_width", "reference")}
        self.delay, self.high, self.low = (numbers[name] for name in ("delay_s", "high", "low"))
        self.upper, self.lower = (numbers["reference"] + sign * numbers["half_width"] for sign in (1, -1))
        self.plant = Plant([float(c) for c in item["num"]], [float(c) for c in item["den"]])
        self.undelayed = item["delay_s"] == 0
        self.ideal = item["half_width"] == 0
        require(item["low"] < item["high"] and item["delay_s"] >= 0 and item["half_width"] >= 0, "the loop is malformed")
        require(not (self.undelayed and self.ideal), "neither dead time nor hysteresis")


def whole(value):
    """The largest integer not above a number."""
    floor = value.floor().unique_fmpz()
    known(floor is not None, "the order of the changes")
    return int(floor)


class Orbit:
    """The orbit near half-periods. Time 0 is where the plant's input rises."""

    def __init__(self, loop, high, low):
        self.loop, self.plant = loop, loop.plant
        times = (high.mid(), low.mid())
        # tau_on = on T - delay and tau_off = t1 + off T - delay lie in [0, T).
        self.on = 1 if loop.undelayed else whole(loop.delay / sum(times)) + 1
        self.off = 0 if loop.undelayed else -whole((times[0] - loop.delay) / sum(times))
        state = self.periodic(times)
        for _ in range(3 + ctx.prec.bit_length()):
            miss, slopes = self.equations(state, times)
            state, times = self.moved(state, times, slopes.mid().solve(miss.mid()))
        self.krawczyk(state, times)

    def moved(self, state, times, step):
        n = self.plant.order
        moved = [(state[i, 0] - step[i, 0]).mid() for i in range(n)], [(times[i] - step[n + i, 0]).mid() for i in range(2)]
        return arb_mat(n, 1, moved[0]), tuple(moved[1])

    def periodic(self, times):
        """A state near the one from which the motion is periodic and passes the lower level: least squares."""
        n = self.plant.order
        zero, columns = arb_mat(n, 1, [0] * n), []
        base = self.equations(zero, times)[0]
        for i in range(n):
            unit = arb_mat(n, 1, [int(i == j) for j in range(n)])
            columns.append(self.equations(unit, times)[0] - base)
        matrix = arb_mat(n + 2, n, [columns[j][i, 0] for i in range(n + 2) for j in range(n)])
        return (matrix.transpose() * matrix).mid().solve((matrix.transpose() * -base).mid()).mid()

    def changes(self, times):
        period = times[0] + times[1]
        return self.on * period - self.loop.delay, times[0] + self.off * period - self.loop.delay

    def equations(self, state, times):
        """Periodicity, and the output's distance from its levels where the command changes; with derivatives."""
        plant, loop, n = self.plant, self.loop, self.plant.order
        flows = [plant.flow(time) for time in times]
        begin = plant.with_input(state, loop.high)
        peak = flows[0] * begin
        fall = plant.with_input(peak, loop.low)
        end = flows[1] * fall
        whole = flows[1] * self.still(flows[0])
        rates = [plant.rate * peak, plant.rate * end]
        carried = flows[1] * rates[0]
        miss, slopes = arb_mat(n + 2, 1, [0] * (n + 2)), arb_mat(n + 2, n + 2, [0] * (n + 2) ** 2)
        for i in range(n):
            miss[i, 0] = end[i, 0] - state[i, 0]
            for j in range(n):
                slopes[i, j] = whole[i, j] - int(i == j)
            slopes[i, n], slopes[i, n + 1] = carried[i, 0], rates[1][i, 0]
        on, off = self.changes(times)
        moves = ((self.on, self.on), (1 + self.off, self.off))
        for row, at, by, level, is_off in ((n, on, moves[0], loop.lower, False), (n + 1, off, moves[1], loop.upper, True)):
            if self.early(at, times, is_off):
                flow = plant.flow(at)
                there, early = flow * begin, [0, 0]
                by_state = plant.read * flow
                rate = plant.rate * there
            else:
                flow = plant.flow(at - times[0])
                there = flow * fall
                rate = plant.rate * there
                early = [(plant.read * (flow * rates[0] - rate))[0, 0], 0]
                by_state = plant.read * flow * self.still(flows[0])
            miss[row, 0] = (plant.read * there)[0, 0] - level
            for j in range(n):
                slopes[row, j] = by_state[0, j]
            slope = (plant.read * rate)[0, 0]
            for k in range(2):
                slopes[row, n + k] = slope * by[k] + early[k]
        return miss, slopes

    def still(self, flow):
        """A flow of deviations: the input does not deviate."""
        n, flow = self.plant.order, arb_mat(flow)
        for i in range(n + 1):
            flow[i, n] = 0
            flow[n, i] = 0
        return flow

    def early(self, at, times, is_off):
        """Whether a moment is while the input is high."""
        if self.loop.undelayed:
            return is_off
        known(at < times[0] or at > times[0], "the order of the changes")
        return bool(at < times[0])

    def krawczyk(self, state, times):
        """A ball about the approximation that holds a solution: its image is inside."""
        n = self.plant.order
        point = [state[i, 0] for i in range(n)] + list(times)
        split = lambda all: (arb_mat(n, 1, all[:n]), tuple(all[n:]))
        miss, slopes = self.equations(*split(point))
        inverse = slopes.mid().inv().mid()
        step = inverse * miss
        size = max(float(abs(value).upper()) for value in point)
        radii = [4 * abs(step[i, 0]).upper() + size * arb(2) ** (-ctx.prec // 2) for i in range(n + 2)]
        ball = [value + arb(0, radius) for value, radius in zip(point, radii)]
        slopes = self.equations(*split(ball))[1]
        left = arb_mat(n + 2, n + 2, [int(i == j) for i in range(n + 2) for j in range(n + 2)]) - inverse * slopes
        spread = arb_mat(n + 2, 1, [arb(0, radius) for radius in radii])
        image = left * spread - step
        known(all(abs(image[i, 0]).upper() < radii[i] for i in range(n + 2)), "that the orbit exists")
        found = [point[i] + image[i, 0] for i in range(n + 2)]
        self.state, self.times = split(found)

    def arcs(self):
        """Stretches on which input and command are constant: beginning, length, state, command, whether it changes there."""
        loop, plant = self.loop, self.plant
        high, period = self.times[0], self.times[0] + self.times[1]
        on, off = self.changes(self.times)
        marks = [(arb(0), loop.undelayed, False), (high, loop.undelayed, False), (period, loop.undelayed, False)]
        if not loop.undelayed:
            marks += [(on, True, True), (off, True, True)]
        marks.sort(key=lambda mark: float(mark[0]))
        known(all(a[0] < b[0] for a, b in zip(marks, marks[1:])), "the order of the changes")
        state = plant.with_input(self.state, loop.high)
        for (start, begins, _), (end, ends, _) in zip(marks, marks[1:]):
            middle = (start + end) / 2
            if start.overlaps(high) and start.mid() == high.mid():
                state = plant.with_input(state, loop.low)
            command = loop.undelayed and middle < high
            if not loop.undelayed:
                command = (on < middle < off) if on < off else not (off < middle < on)
            yield end - start, state, bool(command), begins, ends
            state = plant.flow(end - start) * state

    def output(self, state, cell):
        """Output and slope over a ball of times after a state."""
        plant = self.plant
        middle = plant.flow(arb(cell.mid())) * state
        if cell.is_exact():
            return (plant.read * middle)[0, 0], (plant.read * plant.rate * middle)[0, 0]
        rest = cell - cell.mid()
        slope = (plant.read * plant.rate * plant.flow(rest) * middle)[0, 0]
        return (plant.read * middle)[0, 0] + slope * rest, slope

    def genuine(self):
        """The command changes where the output passes a level, and nowhere else."""
        for length, state, command, begins, ends in self.arcs():
            level, sign = (self.loop.upper, 1) if command else (self.loop.lower, -1)
            first, last = arb(0), arb(length.upper())
            if begins and self.loop.ideal:
                first = self.stretch(state, arb(0), last, sign, False)
            if ends:
                last = self.stretch(state, last, arb(0), sign, True)
            open_cells = [(first, last, 0)] if first < last else []
            while open_cells:
                start, end, depth = open_cells.pop()
                left = sign * (level - self.output(state, hull(start, end))[0])
                if left > 0:
                    continue
                require(not left < 0, "the relay switches earlier")
                known(depth < HALVINGS, "that the relay does not switch earlier")
                middle = ((start + end) / 2).mid()
                open_cells += [(start, middle, depth + 1), (middle, end, depth + 1)]

    def stretch(self, state, fixed, other, sign, towards):
        """The other end of a stretch from an end of an arc on which the output keeps moving to the level, or away from it."""
        for k in range(1, HALVINGS):
            end = (fixed + (other - fixed) / 2**k).mid()
            slope = sign * self.output(state, hull(fixed, end))[1]
            if (slope > 0) if towards else (slope < 0):
                return end
        raise Undecided("the direction in which the output passes a level")

    def extreme(self, sign, bounds):
        """Whether the largest output times the sign is within bounds."""
        lower, upper = bounds
        arcs = [(length, state) for length, state, *_ in self.arcs()]
        reached = any(sign * self.output(state, time)[0] >= lower for length, state in arcs for time in (arb(0), length))
        for length, state in arcs:
            cells = [(arb(0), arb(length.upper()), 0)]
            while cells:
                start, end, depth = cells.pop()
                value, slope = self.output(state, hull(start, end))
                value = sign * value
                if not (slope > 0 or slope < 0):
                    inside = sign * self.output(state, ((start + end) / 2).mid())[0]
                    reached = reached or bool(inside >= lower)
                    require(not inside > upper, "an extreme beyond its bounds")
                if value < lower or (value <= upper and reached):
                    continue
                if slope > 0 or slope < 0:
                    rising = bool(sign * slope > 0)
                    at = sign * self.output(state, end if rising else start)[0]
                    # The last cell ends where the arc does, to its enclosure.
                    require(not at > upper, "an extreme beyond its bounds")
                    known(at <= upper, "the extremes")
                    continue
                known(depth < HALVINGS, "the extremes")
                middle = ((start + end) / 2).mid()
                cells += [(start, middle, depth + 1), (middle, end, depth + 1)]
        require(reached, "an extreme that is not reached")

    def attracting(self):
        """Whether deviations die out: by powers of the return map, with the commands under way; None where they do not tell."""
        loop, plant, n = self.loop, self.plant, self.plant.order
        high, period = self.times[0], self.times[0] + self.times[1]
        on, off = self.changes(self.times)
        slopes = []
        begin = plant.with_input(self.state, loop.high)
        fall = plant.with_input(plant.flow(high) * begin, loop.low)
        for at, is_off in ((on, False), (off, True)):
            there = plant.flow(at) * begin if self.early(at, self.times, is_off) else plant.flow(at - high) * fall
            slopes.append((plant.read * plant.rate * there)[0, 0])
        require(not (slopes[0] > 0 or slopes[1] < 0), "the output passes a level the wrong way")
        known(slopes[0] < 0 and slopes[1] > 0, "the direction in which the output passes a level")
        # Just before the input's rise: commands given in [-delay, 0) are under way.
        under_way = self.on + self.off if not loop.undelayed else 0
        require(under_way <= MOST_UNDER_WAY, "more commands under way than are followed")
        size = n + under_way
        row = lambda k: arb_mat(1, size, [int(k == j) for j in range(size)])
        state = arb_mat(n, size, [int(i == j) for i in range(n) for j in range(size)])
        queue = [row(n + k) for k in range(under_way)]
        still = lambda time: arb_mat(n, n, [plant.flow(time)[i, j] for i in range(n) for j in range(n)])
        read = arb_mat(1, n, [plant.read[0, j] for j in range(n)])
        into = arb_mat(n, 1, [plant.rate[i, n] for i in range(n)])
        # (when, the input's jump or None, the slope of the output at a command); a command comes before its own input.
        jump = loop.high - loop.low
        if loop.undelayed:
            ends, commands = [(high, -jump, None), (period, jump, None)], [(period, None, slopes[0]), (high, None, slopes[1])]
        else:
            ends, commands = [(arb(0), jump, None), (high, -jump, None)], [(on, None, slopes[0]), (off, None, slopes[1])]
        order = lambda event: (float(event[0]), event[1] is not None)
        now = arb(0)
        for at, jump, slope in sorted(ends + commands, key=order):
            if at.mid() != now.mid():
                state = still(at - now) * state
            now = at
            if jump is None:
                queue.append((read * state) * (-1 / slope))
            else:
                state = state - into * (queue.pop(0) * jump)
        if not loop.undelayed:
            state = still(period - now) * state
        power = arb_mat(size, size, [state[i, j] for i in range(n) for j in range(size)] + [late[0, j] for late in queue for j in range(size)])
        # A shift of all in time is no deviation.
        rate = plant.rate * plant.with_input(self.state, loop.high if loop.undelayed else loop.low)
        along = [rate[i, 0] for i in range(n)] + [arb(-1)] * under_way
        moved = power * arb_mat(size, 1, along)
        require(all(moved[i, 0].overlaps(along[i]) for i in range(size)), "the return map moves a shift in time")
        return self.grows(self.deflated(power, along))

    def deflated(self, map, along):
        """The map of deviations, each up to a shift in time."""
        size = map.nrows()
        lead = max(range(size), key=lambda i: abs(float(along[i])))
        # Coordinates v_i - along_i v_lead/along_lead, which a shift leaves.
        rest = [i for i in range(size) if i != lead]
        entry = lambda i, j: map[i, j] - along[i] / along[lead] * map[lead, j]
        return arb_mat(size - 1, size - 1, [entry(i, j) for i in rest for j in rest])

    def grows(self, power):
        size = power.nrows()
        for _ in range(SQUARINGS + 1):
            norm = max((float(sum((abs(power[i, j]) for j in range(size)), arb(0)).upper()) for i in range(size)), default=0.0)
            if norm < 1:
                return True
            if abs(sum((power[i, i] for i in range(size)), arb(0))) > size:
                return False
            power = power * power
        return None


def interval(item):
    lower, upper = (float(end) for end in item)
    require(lower <= upper, "bounds in the wrong order")
    return arb(lower), arb(upper)


def check_orbit(item, loop_item):
    loop = Loop(loop_item)
    box = [interval(item[name]) for name in ("time_high_s", "time_low_s")]
    require(all(lower > 0 for lower, _ in box), "a half-period that is not positive")
    orbit = Orbit(loop, *(hull(*side) for side in box))
    for time, (lower, upper) in zip(orbit.times, box):
        require(not (time < lower or time > upper), "the orbit is not in its box")
        known(lower <= time <= upper, "that the orbit is in its box")
    orbit.genuine()
    least, most = interval(item["minimum"]), interval(item["maximum"])
    orbit.extreme(1, most)
    orbit.extreme(-1, (-least[1], -least[0]))
    if item["attracting"] is not None:
        known(orbit.attracting() is not None, "whether the orbit attracts")
        require(orbit.attracting() is item["attracting"], "another verdict on attraction")


def check(certificate):
    """The number of orbits, or Refused."""
    require(certificate["certificate"] == CERTIFICATE and certificate["format"] == FORMAT, "another certificate or format")
    require(certificate["statement"] == STATEMENT, "another statement")
    orbits = certificate["orbits"]
    require(len(orbits) <= MOST_ORBITS, "too many orbits")
    for number, item in enumerate(orbits):
        for precision in PRECISIONS:
            ctx.prec = precision
            try:
                check_orbit(item, certificate["loop"])
                break
            except Undecided as why:
                reason = f"orbit {number + 1}: not shown: {why}"
            except Refused as why:
                raise Refused(f"orbit {number + 1}: {why}") from why
        else:
            raise Refused(reason)
    return len(orbits)


def check_file(path):
    return checked(check, path)


def main(paths):
    accepted = True
    for path in paths:
        try:
            print(f"{path}  accepted  {check_file(path)} orbits\n  {STATEMENT}")
        except Refused as reason:
            accepted = False
            print(f"{path}  refused   {reason}")
    return 0 if accepted else 1


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
