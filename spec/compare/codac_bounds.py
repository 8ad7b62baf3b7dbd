"""Codac's contractors on records that `selfosc identify --method bounded` encloses: widths and times, as a table.

    python3 -m venv venv && venv/bin/pip install codac
    venv/bin/python spec/compare/codac_bounds.py target/release/selfosc

Linear drag, switchings at samples and no delay, so that the motion between two switchings has a closed form, which is what Codac's
forward-backward contractor is given, from each switching to every sample up to the next; swept to and fro until nothing changes by one percent. Codac
starts within 20 % of the truth and does not divide; `selfosc` starts from four decades.
"""

import csv
import io
import json
import subprocess
import sys
import tempfile
import time

from codac import AnalyticFunction, CtcInverse, Interval, IntervalVector, VectorVar, exp, vec

VEHICLES = [(1.0, 0.5, 0.01), (1.3, 0.6, 0.02), (0.7, 0.4, 0.005)]
SWEEPS = 200


def run(*arguments):
    return subprocess.run(arguments, check=True, capture_output=True, text=True).stdout


def reached(t):
    """g = 1/alpha, l = beta/alpha, d = delta/alpha; the state at a switching, and after the time t with the command u since."""
    p = VectorVar(8)
    decay = exp(-p[1] * t)
    end = (p[0] * p[7] + p[2]) / p[1]
    after_x = p[5] - (p[3] + end * t + (p[4] - end) * (1 - decay) / p[1])
    after_v = p[6] - (end + (p[4] - end) * decay)
    return CtcInverse(AnalyticFunction([p], vec(after_x, after_v)), IntervalVector([[0, 0], [0, 0]]))


def codac(rows, quantum, alpha, beta):
    times, readings, commands = zip(*rows)
    turns = [0] + [k for k in range(1, len(rows)) if commands[k] != commands[k - 1]] + [len(rows) - 1]
    # From each switching to every sample up to the next one.
    ways = [(a, k, reached(Interval(times[k]) - Interval(times[a]))) for a, b in zip(turns, turns[1:]) for k in range(a + 1, b + 1)]
    x = [Interval(y - 0.5 * quantum * (1 + 1e-9), y + 0.5 * quantum * (1 + 1e-9)) for y in readings]
    v = [Interval(-3, 3) for _ in readings]
    common = [Interval(0.8 / alpha, 1.2 / alpha), Interval(0.8 * beta / alpha, 1.2 * beta / alpha), Interval(-0.1, 0.1)]
    size = lambda: [side.diam() for side in common] + [v[k].diam() for k in turns]
    for _ in range(SWEEPS):
        before = size()
        for order in (ways, reversed(ways)):
            for a, k, way in order:
                box = IntervalVector([*common, x[a], v[a], x[k], v[k], Interval(commands[a])])
                way.contract(box)
                if box.is_empty():
                    return None
                common = [box[0], box[1], box[2]]
                x[a], v[a], x[k], v[k] = box[3], box[4], box[5], box[6]
        if all(after > 0.99 * side for side, after in zip(before, size())):
            break
    return Interval(1) / common[0]


def main(selfosc):
    print("| alpha, beta, rounding | samples | selfosc: alpha, half-width, % | s | Codac: alpha, half-width, % | s |\n|---|---|---|---|---|---|")
    for alpha, beta, quantum in VEHICLES:
        vehicle = ["--alpha", str(alpha), "--beta", str(beta), "--relay", "1", "--half-width", "0.3"]
        log = run(selfosc, "simulate", *vehicle, "--cycles", "6", "--hold", "--rate", "10", "--quantum", str(quantum))
        flags = ["--method", "bounded", "--drag", "linear", "--delay", "0", "--quantum", str(quantum), "--json"]
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            file.write(log)
            file.flush()
            clock = time.perf_counter()
            own = json.loads(run(selfosc, "identify", file.name, *flags))["bounded"]["alpha"]
            own_s = time.perf_counter() - clock
        rows = [(float(r["time_s"]), float(r["output"]), float(r["input"])) for r in csv.DictReader(io.StringIO(log))]
        clock = time.perf_counter()
        other = codac(rows, quantum, alpha, beta)
        other_s = time.perf_counter() - clock
        half = lambda low, high: f"{50 * (high - low) / alpha:.3f}"
        found = "empty" if other is None else half(other.lb(), other.ub())
        print(f"| {alpha}, {beta}, {quantum} | {len(rows)} | {half(*own)} | {own_s:.2f} | {found} | {other_s:.2f} |")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
