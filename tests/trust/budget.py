"""What one unit of each source of error that no residual shows moves in the answer: the shares of `spec/conventions.md`.

    python3 tests/trust/budget.py target/release/selfosc [vehicles] [first seed]

Every vehicle is simulated twice with the same noise, without the source and with it, by a Runge-Kutta integrator that shares
nothing with the project, and both logs are identified by the command. A share is the median magnitude over vehicles of the
difference between the two answers: of alpha relative to alpha, of a drag relative to the drag force at top speed, of delta
relative to the relay level, of the delay relative to half the period. Defaults: 24 vehicles, seeds from
5530000 on. Standard error has every difference.
"""

import json
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

DEGREE = math.pi / 180.0
RATE_HZ, DURATION_S, STEPS = 10.0, 60.0, 5
WASH_S = 0.3
#: Name, size of the trial, and its unit.
TRIALS = {
    "heading-error": (1.0, "degree, one cycle per turn"),
    "thrust-dynamics": (10.0, "% of the thrust after each reversal, gone with 0.3 s"),
}


def vehicle(seed):
    """A drawn axis: relay level 1, heading in rad."""
    draw = random.Random(seed)
    alpha = math.exp(draw.uniform(math.log(0.2), math.log(2.0)))
    half_width = draw.uniform(8.0, 20.0) * DEGREE
    speed = math.sqrt(2.0 * half_width / alpha) * draw.uniform(0.8, 1.5)
    drag, share = draw.uniform(0.2, 0.7), draw.choice([0.0, 1.0, draw.uniform(0.1, 0.9)])
    return {
        "alpha": alpha, "beta": drag * share / speed, "beta_quadratic": drag * (1.0 - share) / speed**2,
        "delta": draw.uniform(-0.2, 0.2), "delay_s": 0.02 * draw.randrange(3, 16), "half_width": half_width,
        "phase": draw.uniform(0.0, 2.0 * math.pi), "noise": 0.1 * DEGREE,
    }  # fmt: skip


def simulate(axis, seed, source=None, duration_s=DURATION_S):
    """Times, headings, commands, and the top speed."""
    draw = random.Random(seed + 1)
    size = TRIALS[source][0] if source else 0.0
    iron = size * DEGREE * (source == "heading-error")
    wash = 0.01 * size * (source == "thrust-dynamics")
    step_s = 1.0 / (RATE_HZ * STEPS)
    late = round(axis["delay_s"] / step_s)
    sent = []
    x = v = 0.0
    command, acted, since_s, top = 1.0, 1.0, 100.0, 0.0
    times, headings, commands = [], [], []

    def pull(v, force):
        return (force + axis["delta"] - axis["beta"] * v - axis["beta_quadratic"] * abs(v) * v) / axis["alpha"]

    for k in range(int(duration_s * RATE_HZ) * STEPS):
        if k % STEPS == 0:
            seen = x + iron * math.sin(x + axis["phase"]) + draw.gauss(0.0, axis["noise"])
            if seen > axis["half_width"]:
                command = -1.0
            elif seen < -axis["half_width"]:
                command = 1.0
            times.append(k * step_s)
            headings.append(seen)
            commands.append(command)
        sent.append(command)
        now = sent[k - late] if k >= late else sent[0]
        since_s = 0.0 if now != acted else since_s + step_s
        acted = now
        force = now * (1.0 + wash * math.exp(-since_s / WASH_S))
        # The force is constant within a step.
        a1 = pull(v, force)
        a2 = pull(v + 0.5 * step_s * a1, force)
        a3 = pull(v + 0.5 * step_s * a2, force)
        a4 = pull(v + step_s * a3, force)
        x += step_s * (v + step_s * (a1 + a2 + a3) / 6.0)
        v += step_s * (a1 + 2.0 * a2 + 2.0 * a3 + a4) / 6.0
        top = max(top, abs(v))
    return times, headings, commands, top


def identify(command, folder, times, headings, commands):
    """`reported` of the command's document, or None."""
    path = Path(folder) / "log.csv"
    rows = [f"{t:.6f},{x:.9f},{u:g}" for t, x, u in zip(times, headings, commands)]
    path.write_text("time_s,heading,input\n" + "\n".join(rows) + "\n")
    found = subprocess.run([command, "identify", str(path), "--method", "fit", "--json"], capture_output=True, text=True)
    return json.loads(found.stdout).get("reported") if found.stdout else None


def numbers(reported, axis, top, half_period_s):
    """The answer in the units of the shares; alpha's logarithm."""
    value = {name: (reported.get(name) or {"value": 0.0})["value"] for name in ("alpha", "beta", "beta_quadratic", "delta", "delay_s")}
    for late in ("lag_s", "filter_s"):
        value["delay_s"] += (reported.get(late) or {"value": 0.0})["value"]
    drag = axis["beta"] * top + axis["beta_quadratic"] * top**2
    return {
        "alpha": math.log(value["alpha"]), "beta": value["beta"] * top / drag, "beta_quadratic": value["beta_quadratic"] * top**2 / drag,
        "drag": (value["beta"] * top + value["beta_quadratic"] * top**2) / drag,
        "delta": value["delta"], "delay_s": value["delay_s"] / half_period_s,
    }  # fmt: skip


def main():
    command = str(Path(sys.argv[1]).resolve())
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 24
    first = int(sys.argv[3]) if len(sys.argv) > 3 else 5530000
    names = ("alpha", "beta", "beta_quadratic", "drag", "delta", "delay_s")
    apart = {source: [] for source in TRIALS}
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + count):
            axis = vehicle(seed)
            log = simulate(axis, seed)
            answer, top = identify(command, folder, *log[:3]), log[3]
            half_period_s = DURATION_S / max(1, sum(a != b for a, b in zip(log[2], log[2][1:])))
            for source in TRIALS:
                moved = identify(command, folder, *simulate(axis, seed, source)[:3])
                if answer is None or moved is None or "doubtful" in (answer["trust"], moved["trust"]):
                    continue
                one, other = (numbers(each, axis, top, half_period_s) for each in (answer, moved))
                apart[source].append({name: 100.0 * (other[name] - one[name]) for name in names} | {"trust": moved["trust"]})
                print(source, seed, {name: round(value, 3) for name, value in apart[source][-1].items() if name != "trust"}, file=sys.stderr)
    print(f"| source | size | vehicles | {' | '.join(f'{name}, rms (median) %' for name in names)} | good |")
    print("|---|---|---|" + "---|" * (len(names) + 1))
    for source, rows in apart.items():
        cells = []
        for name in names:
            sizes = sorted(abs(row[name]) for row in rows) or [math.nan]
            cells.append(f"{math.sqrt(sum(x * x for x in sizes) / len(sizes)):.2f} ({sizes[len(sizes) // 2]:.2f})")
        good = sum(row["trust"] == "good" for row in rows)
        size, unit = TRIALS[source]
        print(f"| {source} | {size:g} {unit} | {len(rows)} | {' | '.join(cells)} | {good} |")


if __name__ == "__main__":
    main()
