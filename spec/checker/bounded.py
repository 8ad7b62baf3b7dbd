"""Verifies the proofs that `selfosc identify LOG --method bounded --certificate FILE` writes. See README.md."""

import sys
from fractions import Fraction

from flint import arb

from boxes import Box, down, number, reached, up
from check import Refused, checked, require
from modulating import Modulating, Unsupported
from motion import Equation, Motion, Products, Steps, Unfollowed, ball, exact, span, times
from problem import assumed, posed, statement

# Sides that boxes at hand may have together, so that no file takes more memory, however it divides.
MOST_HELD = 1 << 20
# Boxes whose inertia is known worse than this are followed with exact products.
WIDE = 2e-3
# A walk that is refused is made anew with steps shorter by these.
SHORTER = (1, 2, 4)
# Rounding of the terms of a witness, against their sizes.
ROUNDING = 1e-9
# Seconds by which a sum of a stamp and a delay may be rounded up.
ROUNDED = Fraction(1, 10**9)
# Around a witness, over itself: a motion that crosses zero within a small range is passed at once.
NEAR = 1e-8

def interval(ends):
    low, high = float(ends[0]), float(ends[1])
    require(low <= high and abs(low) + abs(high) < float("inf"), "a range is malformed")
    return low, high


class Record:
    def __init__(self, item):
        self.time, self.reading = [float(t) for t in item["time_s"]], [float(y) for y in item["reading"]]
        self.error, self.levels = float(item["error"]), [float(u) for u in item["levels"]]
        spans = [interval(ends) for ends in item["switched_s"]]
        require(float(item["jitter_s"]) == 0.0, "stamps with errors are not verified here")
        require(all(a == b for a, b in spans), "switchings at unknown instants are not verified here")
        self.switched = [a for a, _ in spans]
        require(len(self.time) == len(self.reading) and len(self.levels) == len(spans) + 1, "a record is malformed")
        for instants in (self.time, self.switched):
            require(all(a < b for a, b in zip(instants, instants[1:])), "instants are not in order")
        numbers = self.time + self.reading + self.levels + self.switched + [self.error]
        require(self.error > 0 and all(abs(n) < float("inf") for n in numbers), "a record has what is no number")

    def largest(self):
        return max(map(abs, self.levels))


class Stage:
    """One stage, as a problem: where each unknown stands in a box."""

    def __init__(self, certificate, records, item):
        self.certificate, self.records, self.item = certificate, records, item
        self.terms = certificate["terms"]
        self.delay = None if item["delay_s"] is None else float(item["delay_s"])
        self.common = len(self.terms) + (self.delay is None)
        self.parameters = self.common + len(records)
        self.size = 3 if "lag_rate" in self.terms else 2
        self.shooting = [tuple(int(n) for n in own) for own in item["shooting"]]
        self.middle, self.least, self.fastest = (float(certificate[k]) for k in ("middle_speed", "least_linear", "fastest"))
        own = [interval(ends) for ends in item["from"]]
        require(len(own) == self.parameters and own[0][0] > 0, "the search box is malformed")
        both = "linear" in self.terms and "quadratic" in self.terms
        require(both or self.middle == 0, "a middle speed without both drags")
        alone = "linear" in self.terms and not both
        require(not alone or own[self.terms.index("linear")][0] >= self.least, "drag below the least")
        self.longest = Fraction(own[len(self.terms)][1] if self.delay is None else self.delay)
        before = None
        for own_interval in self.shooting:
            record, first, last = own_interval
            require(0 <= record < len(records) and 0 <= first < last < len(records[record].time), "a shooting interval is malformed")
            follows = record == 0 if before is None else record == before[0] + 1 if record != before[0] else first == before[2]
            require(follows and first >= self.acted(records[record]), "a shooting interval does not follow, or is too early")
            before = own_interval
        require(before is not None and before[0] == len(records) - 1, "a record has no shooting interval")
        for record, first, _ in self.shooting:
            reading, error = arb(records[record].reading[first]), records[record].error
            own.append((float((reading - error).lower()) - 1e-300, float((reading + error).upper()) + 1e-300))
            own.append((-self.fastest, self.fastest))
            if self.size == 3:
                own.append((-records[record].largest(), records[record].largest()))
        # Ends as floats, outwards.
        self.box = [tuple(own[i]) if i < self.parameters else (down(own[i][0]), up(own[i][1])) for i in range(len(own))]
        self.left = None if item["left"] is None else [interval(ends) for ends in item["left"]]
        require(self.left is None or len(self.left) == self.parameters, "what is left is malformed")

    def acted(self, record, room=0):
        """The first sample at which every command that acts is in the file, for that much longer a delay."""
        since = (Fraction(stamp) - Fraction(record.time[0]) for stamp in record.time)
        return next((n for n, since in enumerate(since) if since >= self.longest + room), len(record.time))

    def start(self, interval, component):
        return self.parameters + interval * self.size + component

    def equation(self, box, record):
        terms = dict(zip(self.terms, box))
        terms["disturbance"] = box[self.common + record]
        return Equation(terms, self.middle)

    def columns(self, interval):
        """The variables of the sensitivities, and the place of each unknown."""
        record = self.shooting[interval][0]
        columns = [(("term", name), place) for place, name in enumerate(self.terms)]
        if self.delay is None:
            columns.append((("delay", None), len(self.terms)))
        columns.append((("term", "disturbance"), self.common + record))
        columns += [(("start", k), self.start(interval, k)) for k in range(self.size)]
        return columns

    def shot(self, horizon, box):
        """Inequalities by name as `(slopes, limit)` about the middle of the box, with the deviations; `None` where links part."""
        rows, ranges = {}, [span(*side) for side in box]
        centre = [arb(side.mid()) for side in ranges]
        Products.by_ends = float(ranges[0].rad()) > WIDE * float(ranges[0].mid())
        spans = [(i, i + 1) for first, after in whole(self.shooting, horizon) for i in range(first, after)]
        ends = {after for _, after in whole(self.shooting, horizon)}
        for first, after in spans:
            nodes, places = self.motion(first, after, ranges, centre)
            record = self.records[self.shooting[first][0]]
            for sample, (_, point, slopes) in nodes:
                strays, slopes = point[0] - record.reading[sample], [(p, s[0]) for p, s in zip(places, slopes)]
                pair(rows, ("reading", first, sample), slopes, strays, arb(record.error))
            if after not in ends:
                over, point, slopes = nodes[-1][1]
                for k in range(self.size):
                    place = self.start(after, k)
                    low, high = max(over[k].lower(), ranges[place].lower()), min(over[k].upper(), ranges[place].upper())
                    if not low <= high:
                        return None
                    ranges[place] = span(low, high)
                    if not low <= centre[place] <= high:
                        centre[place] = arb(ranges[place].mid())
                    own = [(p, s[k]) for p, s in zip(places, slopes)] + [(place, arb(-1))]
                    pair(rows, ("link", first, k), own, point[k] - centre[place], arb(0))
        self.bound(rows, centre)
        return rows, centre, [r - c for r, c in zip(ranges, centre)]

    def bound(self, rows, centre):
        """What the search box says beside its sides."""
        for record, own in enumerate(self.records):
            place = self.common + record
            for above, sign in ((True, 1), (False, -1)):
                slopes = [(0, arb(-own.largest())), (place, arb(sign))]
                rows["disturbance", record, above] = slopes, -sum(s * centre[p] for p, s in slopes)
        if "linear" in self.terms and "quadratic" in self.terms:
            slopes = [(self.terms.index("linear"), arb(-1)), (self.terms.index("quadratic"), 2 * arb(self.middle))]
            rows["least_linear",] = slopes, arb(-self.least) - sum(s * centre[p] for p, s in slopes)

    def motion(self, first, after, ranges, centre):
        """States at every sample of successive shooting intervals, with the places of their sensitivities."""
        record_index, begin, _ = self.shooting[first]
        end = self.shooting[after - 1][2]
        record = self.records[record_index]
        columns = self.columns(first)
        places = [place for _, place in columns]
        state = [ranges[self.start(first, k)] if k < self.size else arb(0) for k in range(3)]
        point = [centre[self.start(first, k)] if k < self.size else arb(0) for k in range(3)]
        motion = Motion(
            self.equation(ranges, record_index),
            self.equation(centre, record_index),
            [column for column, _ in columns],
            [ranges[p] - centre[p] for p in places],
            state,
            point,
        )
        if self.delay is None:
            own = ranges[len(self.terms)]
            delays = [exact(own.lower()), exact(centre[len(self.terms)]), exact(own.upper())]
        else:
            delays = [Fraction(self.delay)] * 3
        return drive(motion, record, delays, begin, end), places


def drive(motion, record, delays, begin, end):
    """The nodes of a motion: `(sample, (over, point, slopes))`."""
    least, middle, most = delays
    uncertain = least != most
    events = []
    for edge, at in enumerate(map(Fraction, record.switched)):
        events.append((at + middle, 1, edge))
        if uncertain:
            events += [(at + least, 0, edge), (at + most, 2, edge)]
    events += [(Fraction(record.time[k]), 3, k) for k in range(begin + 1, end + 1)]
    events.sort()
    since, until = Fraction(record.time[begin]), Fraction(record.time[end])
    now = since
    opened = acted = closed = 0
    nodes = []

    def note(sample):
        slopes = [list(slope) for slope in motion.seen_slopes()]
        over = motion.met(list(motion.over))
        if not all(v.is_finite() for v in over + motion.point):
            raise Unfollowed("no finite states")
        nodes.append((sample, (over, list(motion.point), slopes)))

    # What has happened before the first sample.
    for t, kind, edge in events:
        if kind != 3 and t <= now:
            opened, acted, closed = opened + (kind == 0), acted + (kind == 1), closed + (kind == 2)
    if uncertain and opened > closed:
        require(opened == closed + 1, "two switchings at once")
        motion.opened(arb(record.levels[closed]) - arb(record.levels[closed + 1]), True)
    note(begin)
    for t, kind, n in events:
        if kind != 3 and t <= since:
            continue
        if t > until:
            break
        if t > now:
            low = (closed if uncertain else acted), (opened if uncertain else acted)
            u = arb(record.levels[low[0]])
            for level in record.levels[low[0] : low[1] + 1]:
                u = u.union(arb(level))
            motion.advance(u, arb(record.levels[acted]), ball(t - now))
            now = t
        if kind == 0:
            motion.opened(arb(record.levels[n]) - arb(record.levels[n + 1]), False)
            opened += 1
        elif kind == 1:
            acted += 1
        elif kind == 2:
            motion.closed()
            closed += 1
        else:
            note(n)
    require(len(nodes) == end - begin + 1, "a sample was passed over")
    return nodes


def source(by):
    """The source of inequalities, and its horizon in shooting intervals of each record."""
    ((kind, horizon),) = by.items()
    require(kind in ("modulating_functions", "shooting") and int(horizon) > 0, "an unknown enclosure")
    return kind, int(horizon)


def whole(shooting, horizon=None):
    """The first shooting interval of every record, and the one after the last that is followed."""
    spans = []
    for i, (record, _, _) in enumerate(shooting):
        if horizon is not None and sum(own[0] == record for own in shooting[:i]) >= horizon:
            continue
        if spans and shooting[spans[-1][0]][0] == record:
            spans[-1] = spans[-1][0], i + 1
        else:
            spans.append((i, i + 1))
    return spans


def pair(rows, name, slopes, strays, error):
    rows[name + (True,)] = slopes, error - strays
    rows[name + (False,)] = [(p, -s) for p, s in slopes], error + strays


def key(origin):
    """The name of a row as the file has it."""
    if origin == "least_linear":
        return ("least_linear",)
    ((kind, at),) = origin.items()
    fields = {"reading": ("interval", "sample"), "link": ("interval", "component"), "disturbance": ("record",)}
    require(kind in fields, f"a row by {kind}")
    return (kind, *(int(at[f]) for f in fields[kind]), bool(at["above"]))


def dual(found, objective, combination):
    """An upper bound of the objective from multipliers."""
    rows, _, deviations = found
    rest = {objective[0]: arb(objective[1])} if objective else {}
    total = arb(0)
    for origin, y in combination:
        y = float(y)
        require(0 <= y < float("inf"), "a multiplier is negative")
        name = key(origin)
        require(name in rows, "a row does not exist")
        slopes, limit = rows[name]
        total += arb(y) * limit
        for place, slope in slopes:
            rest[place] = rest.get(place, arb(0)) - arb(y) * slope
    for place, slope in rest.items():
        total += times(slope, deviations[place])
    return total.upper()


class Walk:
    """The steps of a stage over its boxes."""

    def __init__(self, stage, name):
        self.stage, self.name = stage, name
        self.verified, self.modulated, self.taken = 0, 0, 0
        self.modulating = Modulating(stage)

    def go(self):
        boxes = [Box(self.stage.box)]
        for at, step in enumerate(self.stage.item["steps"]):
            require(boxes, f"{self.name}: a step without a box")
            require(len(boxes) * len(boxes[-1].sides) <= MOST_HELD, f"{self.name}, step {at}: too many boxes are left to deal with")
            try:
                boxes += self.step(boxes.pop(), step)
            except (Unfollowed, Refused) as fault:
                raise Refused(f"{self.name}, step {at}: {fault}") from fault
        require(not boxes, f"{self.name}: boxes are left over")

    def step(self, box, step):
        """The boxes that are left to deal with, the next one last."""
        if step == "keep":
            left = self.stage.left
            require(left is not None, "nothing is said to be left")
            require(all(a <= f and t <= b for (f, t), (a, b) in zip(box.sides, left)), "the box is not within what is left")
            return []
        ((kind, what),) = step.items()
        if kind == "divide":
            return box.divided(int(what["unknown"]), number(what["at"]))
        require(kind in ("contract", "exclude"), "an unknown step")
        by, horizon = source(what["by"])
        if by == "modulating_functions":
            try:
                cuts = self.modulating.show(box.sides, kind, what)
                self.modulated += 1
            except Unsupported:
                cuts = None if kind == "exclude" else what["cuts"]
                self.taken += 1
            return [] if cuts is None else box.shortened(cuts)
        self.verified += 1
        found = self.stage.shot(horizon, box.sides)
        if found is None:
            return []
        if kind == "exclude":
            require(dual(found, None, what["rows"]) < 0, "the box is not excluded")
            return []
        _, centre, deviations = found
        cuts = []
        for cut in what["cuts"]:
            place, sign = int(cut["unknown"]), 1 if cut["upper"] else -1
            require(0 <= place < len(box.sides), "a cut of no unknown")
            cut = reached(cut, box.sides[place], lambda: dual(found, (place, sign), cut["rows"]) + sign * centre[place])
            if cut is None:
                continue
            cuts.append(cut)
            # The cuts that follow know what is left of the range.
            side = arb(cut["end"]) - centre[place]
            low, high = deviations[place].lower(), deviations[place].upper()
            low, high = (low, min(high, side.upper())) if sign > 0 else (max(low, side.lower()), high)
            if not low <= high:
                return []
            deviations[place] = span(low, high)
        return box.shortened(cuts)


def met(searched, records, first, witness):
    """Whether a parameter of the first stage's box meets every reading from some sample of each record on."""
    values, begins = [number(v) for v in witness["values"]], [int(n) for n in witness["first"]]
    late = any(n > first.acted(own, ROUNDED) for n, own in zip(begins, records))
    require(not late, "the witness begins after the first row at which every command that acts is in the file")
    require(len(values) == first.parameters + first.size * len(records) and len(begins) == len(records), "the witness is malformed")
    shooting = [[n, begin, len(records[n].time) - 1] for n, begin in enumerate(begins)]
    sides = [(v, v) for v in values[: first.parameters]]
    stage = Stage(searched, records, {"delay_s": first.delay, "shooting": shooting, "from": sides, "left": None, "steps": []})
    # The states are those at its own first readings.
    box = first.box[: first.parameters] + stage.box[first.parameters :]
    require(all(a <= v <= b for v, (a, b) in zip(values, box)), "the witness is not in the search box")
    rows, centre = {}, [arb(v) for v in values]
    stage.bound(rows, centre)
    sized = lambda slopes: sum(abs(s * centre[p]) for p, s in slopes)
    require(all(limit.upper() >= -ROUNDING * sized(slopes) for slopes, limit in rows.values()), "the witness is not in the search box")
    near = [span(v - NEAR * abs(v), v + NEAR * abs(v)) for v in values]
    try:
        motions = [stage.motion(n, n + 1, near, centre)[0] for n in range(len(records))]
    except Unfollowed as fault:
        raise Refused(f"the witness: {fault}") from fault
    strays = ((abs(point[0] - own.reading[n]), own.error) for own, nodes in zip(records, motions) for n, (_, point, _) in nodes)
    return all(stray.upper() <= error for stray, error in strays)


def walked(stage, name):
    """The steps of a stage, in steps of a motion as long as will do."""
    for shorter in SHORTER:
        Steps.shorter = shorter
        walk = Walk(stage, name)
        try:
            walk.go()
        except Refused:
            # Shorter steps of a motion are of use where there is one.
            if shorter == SHORTER[-1] or not walk.verified:
                raise
        else:
            return walk
        finally:
            Steps.shorter = 1


def check(certificate):
    """What it shows, the numbers of steps verified here by the motion and by modulating functions, and of those taken from the file; or Refused."""
    rows, searched, delay, words = posed(certificate)
    records, stages, begin = [Record(item) for item in rows], [], searched["from"]
    for item in certificate["stages"]:
        require(begin is not None, "a stage begins where nothing is left")
        stages.append(Stage(searched, records, item | {"from": begin, "delay_s": delay}))
        require(all(b <= a and c <= d for (a, c), (b, d) in zip(begin, searched["from"])), "a stage begins outside of the search box")
        begin = item["left"]
    require(stages, "there is no stage")
    witness = certificate["witness"]
    expected = statement(begin is None, witness is not None, words)
    require(certificate["statement"] == expected, f"the statement is not: {expected}")
    if witness is not None:
        require(met(searched, records, stages[0], witness), "the witness misses a reading")
    walks = [walked(stage, f"stage {at}") for at, stage in enumerate(stages)]
    return expected, *(sum(counts) for counts in zip(*((walk.verified, walk.modulated, walk.taken) for walk in walks)))


def check_file(path):
    return checked(lambda certificate: (*check(certificate), list(assumed(certificate))), path)


def main(paths):
    accepted = True
    for path in paths:
        try:
            shown, verified, modulated, taken, ranges = check_file(path)
            rest = f"; taken from the file: {taken}" if taken else ""
            print(f"{path}  accepted  {shown}\n  verified here: {verified} steps by the motion, {modulated} by modulating functions{rest}")
            print(*(f"  assumed: {line}" for line in ranges), sep="\n")
        except Refused as reason:
            accepted = False
            print(f"{path}  refused   {reason}")
    return 0 if accepted else 1


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
