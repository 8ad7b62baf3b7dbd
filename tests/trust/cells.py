"""How often each statistical interval holds, inside the model, by share of linear drag and length of the record: the table of `spec/trust.md`.

    python3 tests/trust/cells.py target/release/selfosc [records] [first seed]

Vehicles are those of `budget.py` with another drag: the linear part has a drawn share of the drag force at the record's top speed. The
sensor has noise of 0.3 degree and steps of 1 degree; the delay is estimated. Trusted answers count.
Defaults: 100 records of each cell, seeds from 5570000 on.
"""

import math
import random
import sys
import tempfile
from pathlib import Path

from budget import DEGREE, simulate, vehicle
from practical import identified

#: Shares of linear drag, in percent of the drag force at top speed.
SHARES = {"0": (0.0, 0.0), "2 to 10 %": (2.0, 10.0), "10 to 25 %": (10.0, 25.0), "25 to 60 %": (25.0, 60.0)}
#: Durations in s; the last is of forty cycles.
LENGTHS_S = {"40 s": 40.0, "80 s": 80.0, "160 s": 160.0, "240 s": 240.0, "40 cycles": None}
CYCLES = 40
PARAMETERS = ("alpha", "beta", "beta_quadratic", "delta", "delay_s")


def drawn(seed, share):
    """A vehicle whose linear drag has this share, in percent, of the force at the top speed of its own oscillation; its half-period in s."""
    axis = vehicle(seed) | {"noise": 0.3 * DEGREE}
    draw = random.Random(seed + 2)
    linear, strength = 0.01 * draw.uniform(*share), draw.uniform(0.2, 0.7)
    top = math.sqrt(2.0 * axis["half_width"] / axis["alpha"])
    # Top speed depends on drag, drag on top speed.
    for _ in range(4):
        axis |= {"beta": strength * linear / top, "beta_quadratic": strength * (1.0 - linear) / top**2}
        _, _, commands, top = simulate(axis, seed, duration_s=40.0)
    return axis, 40.0 / max(1, sum(a != b for a, b in zip(commands, commands[1:])))


def main():
    command = str(Path(sys.argv[1]).resolve())
    records, first = (int(sys.argv[k]) if len(sys.argv) > k else usual for k, usual in ((2, 100), (3, 5570000)))
    print(f"| linear share | length | trusted | {' | '.join(PARAMETERS)} | half-width of alpha, median % |")
    print("|---|---|---|" + "---|" * (len(PARAMETERS) + 1))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "log.csv"
        for share, range_percent in SHARES.items():
            for length, duration_s in LENGTHS_S.items():
                held, widths, trusted = dict.fromkeys(PARAMETERS, 0), [], 0
                for seed in range(first, first + records):
                    axis, half_period_s = drawn(seed, range_percent)
                    times, headings, commands, _ = simulate(axis, seed, duration_s=duration_s or 2.0 * CYCLES * half_period_s)
                    stepped = (round(heading / DEGREE) * DEGREE for heading in headings)
                    rows = [f"{t:.6f},{x:.9f},{u:g}" for t, x, u in zip(times, stepped, commands)]
                    path.write_text("time_s,output,input\n" + "\n".join(rows) + "\n")
                    reported = identified(command, path, None)
                    if reported is None or reported["trust"] == "doubtful":
                        continue
                    trusted += 1
                    for name in PARAMETERS:
                        found = reported[name] or {"value": 0.0, "low": None}
                        low, high = (found["low"], found["high"]) if found["low"] is not None else (found["value"], found["value"])
                        held[name] += low <= axis[name] <= high
                    alpha = reported["alpha"]
                    widths.append(50.0 * (alpha["high"] - alpha["low"]) / axis["alpha"])
                percents = " | ".join(f"{100.0 * held[name] / max(1, trusted):.0f}" for name in PARAMETERS)
                print(f"| {share} | {length} | {trusted} | {percents} | {sorted(widths)[len(widths) // 2]:.2f} |", flush=True)


if __name__ == "__main__":
    main()
