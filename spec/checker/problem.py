"""The problem that a file's model and rows pose: what is granted to a reading, when the command changed, where parameters are looked for,
and what may be said of it. All of it is found anew, by the formulas of `spec/bounded.md`, and compared with what the file says."""

from math import sqrt

from boxes import number
from check import require

FORMAT = 5
REACH = 100.0
TERMS = {"gain": None, "linear": None, "quadratic": None, "cubic": "cubic", "stiffness": "stiffness", "lag_rate": "lag"}
FIELDS = {"format", "version", "statement", "model", "read_as", "records", "searched", "stages", "witness"}
# Of numbers found by the same formula, rounded otherwise.
ROUNDED = 1e-9
EVERY = "every parameter in the search box that meets every reading lies within the bounds"
REFUTED = "refuted: no parameter in the search box meets every reading"


def same(a, b):
    return abs(a - b) <= ROUNDED * (abs(a) + abs(b))


def shown_step(readings):
    """The least difference of two readings, if all differences are multiples of it and most readings stand twice."""
    equal = 1e-9 * max(max(readings) - min(readings), abs(min(readings)), abs(max(readings)))
    kept = []
    for reading in sorted(readings):
        if not kept or reading - kept[-1] > equal:
            kept.append(reading)
    steps = [b - a for a, b in zip(kept, kept[1:])]
    if len(steps) < 2 or 2 * len(kept) >= len(readings):
        return None
    least = min(steps)
    return least if all(abs(step - round(step / least) * least) <= 1e-3 * least + equal for step in steps) else None


class Scales:
    """A record's orders of magnitude: half the range, the mean time between switchings, speeds over a tenth of that time."""

    def __init__(self, record):
        time, reading, self.command = record["time_s"], record["reading"], max(map(abs, record["levels"]))
        self.swing = (time[-1] - time[0]) / len(record["levels"])
        squares = self.fastest = first = 0
        for last in range(1, len(time)):
            while time[last] - time[first + 1] > 0.1 * self.swing and first + 1 < last:
                first += 1
            lasted = time[last] - time[first]
            speed, blur = abs(reading[last] - reading[first]) / lasted, 2 * record["error"] / lasted
            squares, self.fastest = squares + speed * max(speed - blur, 0), max(self.fastest, speed + blur)
        self.reach = max((max(reading) - min(reading)) / 2, record["error"])
        self.speed = max(sqrt(squares / (len(time) - 1)), self.reach / (time[-1] - time[0]))


def record_of(rows, model):
    """Readings with their error, levels of the command and the instants at which it changed, by a file's rows."""
    time, reading, command = ([number(value) for value in rows[name]] for name in ("time_s", "reading", "command"))
    require(len(time) == len(reading) == len(command) > 1, "a record is malformed")
    step = model["quantum"] if model["quantum"] is not None else shown_step(reading) or 0.0
    require(same(number(rows["quantum"]), step), "the step of a sensor is not the one that the readings show, or the model says")
    edges = [k for k in range(1, len(command)) if command[k] != command[k - 1]]
    return {
        "time_s": time,
        "reading": reading,
        "error": step / 2 * (1 + 1e-9) + model["error"],
        "jitter_s": model["jitter_s"],
        "levels": [command[0]] + [command[k] for k in edges],
        "switched_s": [[time[k - (model["switching"] != "at-samples")], time[k]] for k in edges],
    }


def posed(certificate):
    """The records, the search, the delay where it is known, and the words that go before and after what is shown."""
    require(certificate["format"] == FORMAT, f"format {certificate['format']}, and not {FORMAT}: write the proof anew")
    require(set(certificate) == FIELDS, "other fields than those of a proof of bounds")
    model, found = certificate["model"], certificate["searched"]
    for name in ("error", "jitter_s", "reach", "outliers", *(["quantum"] if model["quantum"] is not None else [])):
        require(number(model[name]) >= 0, f"the model's {name} is below zero")
    require(model["outliers"] == 0, "no proof where readings may be outliers")
    require(1 < model["reach"] <= 1e6, "no such reach of the search")
    records = [record_of(rows, model) for rows in certificate["records"]]
    require(records and all(len(own["levels"]) > 1 and own["error"] > 0 for own in records), "a record without switchings or error")
    scales = [Scales(record) for record in records]
    law = {"linear": (True, False), "quadratic": (False, True), "mixed": (True, True)}[model["law"]]
    has = dict(zip(("linear", "quadratic"), law))
    terms = [term for term, named in TERMS.items() if (model[named] is True if named else has.get(term, True))]
    first, reach = scales[0], model["reach"]
    rate, gain = 1 / first.swing, 4 * first.reach / (first.command * first.swing**2)
    middle = sum(own.speed for own in scales) / len(scales) if all(law) else 0.0
    least = -2.5 * rate if model["either_sign"] else 0.0
    delay = model["delay"]
    known = number(delay["known-s"]) if isinstance(delay, dict) and "known-s" in delay else None
    delays = [0.0, min(own.swing for own in scales)] if delay == "unknown" else [known] * 2 if known is not None else delay["within-s"]
    require(len(delays) == 2 and 0 <= number(delays[0]) <= number(delays[1]), "no such delay")
    box = {
        "gain": [gain / reach, gain * reach],
        "linear": [least, reach * rate * (1 + 2 * middle / first.speed)],
        "quadratic": [0.0, reach * rate / first.speed],
        "cubic": [0.0, reach * rate / first.speed**2],
        "stiffness": [0.0, reach * rate**2],
        "lag_rate": [4 * rate, 1000 * rate],
    }
    sides = [box[term] for term in terms] + ([delays] if delays[0] < delays[1] else [])
    sides += [[-gain * reach * own.command, gain * reach * own.command] for own in scales]
    require(found["terms"] == terms, "another equation than the model's")
    fastest = 4 * max(own.fastest for own in scales)
    for name, value in (("middle_speed", middle), ("least_linear", least), ("fastest", fastest)):
        require(same(number(found[name]), value), f"the {name} is not the one that the model and the rows lead to")
    within = len(found["from"]) == len(sides) and all(same(number(a), b) for own in zip(found["from"], sides) for a, b in zip(*own))
    require(within and all(len(side) == 2 for side in found["from"]), "the search box is not the one that the model and the rows lead to")
    conditions = listed(
        (reach != REACH, "inertia and drag are within the stated reach, which is not the usual one"),
        (isinstance(delay, dict) and "within-s" in delay, "the delay is within the stated range"),
    )
    shown = [shown_step(own["reading"]) for own in records]
    given = listed(
        (known is not None, "the delay"),
        (model["quantum"] is not None and not all(step and same(step, model["quantum"]) for step in shown), "a step of the sensor that the readings do not show"),
        (model["error"] > 0, "the error of a reading"),
        (model["jitter_s"] > 0, "the error of a stamp"),
        (model["switching"] != "at-samples", "switchings between rows"),
    )
    words = f"on condition that {conditions}: " if conditions else "", f", given {given}" if given else ""
    return records, found, delays[0] if delays[0] == delays[1] else None, words


def listed(*items):
    held = [words for holds, words in items if holds]
    return " and ".join([", ".join(held[:-1]), held[-1]] if len(held) > 1 else held)


def statement(refuted, witness, words):
    shown = REFUTED if refuted else f"consistent: {EVERY}, and the witness meets every reading" if witness else EVERY
    return words[0] + shown + words[1]


def assumed(certificate):
    """What the verdict depends on, a line each."""
    _, found, delay, _ = posed(certificate)
    model, longest = certificate["model"], found["from"][len(found["terms"])][1] if delay is None else delay
    yield f"{model['law']} drag, delay {model['delay']}, reach {model['reach']}, no outliers, stamps within {model['jitter_s']} s"
    yield f"command changes {model['switching']}, speeds up to {found['fastest']}, linear drag over alpha from {found['least_linear']}"
    for side, term in zip(found["from"], found["terms"] + ["delay or disturbance"] * len(found["from"])):
        yield f"{term} from {side[0]} to {side[1]}"
    for rows in certificate["records"]:
        yield f"{len(rows['time_s'])} rows, followed from {longest} s after the first, a step of {rows['quantum']} and an error of {model['error']} in the output's unit"
