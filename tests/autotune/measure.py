#!/usr/bin/env python3
"""`selfosc autotune` and rules of other tools on fresh records: needs numpy and scipy.

    python tests/autotune/measure.py run target/release/selfosc --from 1000000 --records 2000 --list results.jsonl
    python tests/autotune/heaters.py target/release/selfosc > heaters.md
    python tests/autotune/measure.py page results.jsonl heaters.md > spec/autotune.md

`run` adds one line a record and may be stopped and called again. Seeds below 1 000 000 are for development.
"""

from __future__ import annotations

import argparse
import json
import resource
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import page
import rules
import simulator
from loops import Loop

LIMIT = 1.4


def judged(loop: Loop, gains: np.ndarray | None, optimum: float) -> dict[str, float] | None:
    """Largest sensitivity (none for an unstable loop), and the integral of the absolute error over the optimum."""
    if gains is None:
        return None
    peak = loop.peak(gains)
    stable = bool(np.isfinite(peak))
    return {"peak": peak if stable else None, "error": loop.absolute_error(gains) / optimum if stable else None}


def held(range_: dict | None, truth: float) -> bool | None:
    """Whether an interval has the truth."""
    return None if range_ is None else bool(range_["low"] <= truth <= range_["high"])


def intervals(plant: simulator.Plant, found: dict) -> dict[str, bool | None]:
    """Which intervals have the truth: those of quantities that the plant has."""
    ultimate, omega = plant.ultimate()
    point = found["ultimate"] or {}
    answer = {"ultimate gain": held(point.get("gain"), ultimate), "ultimate frequency": held(point.get("omega_rad_s"), omega)}
    if not plant.integrates:
        answer["gain"] = held(found["gain"], plant.gain)
    if plant.kind in simulator.INSIDE:
        answer["dead time"] = held(found["dead_time_s"], plant.dead_s)
    best = found["models"][0]
    if best["family"] == plant.kind and plant.lags_s:
        answer["time constant"] = held(best["parameters"]["time_constant_s"], max(plant.lags_s))
    return answer


def one(command: str, seed: int, folder: Path) -> dict:
    plant, condition, rows, interval_s, load = simulator.record(seed)
    path = folder / "record.csv"
    np.savetxt(path, rows, delimiter=",", header="time_s,temperature,heater", comments="", fmt="%.12g")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    said = subprocess.run([command, "autotune", path, "--json", "--ms", str(LIMIT)], capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    found = json.loads(said.stdout)
    loop = Loop(plant, interval_s)
    optimum = min(loop.optimum(LIMIT, derivative) for derivative in (False, True))
    at = lambda of: None if of is None else np.array([of["proportional"], of["integral"], of["derivative"]])  # noqa: E731
    hysteresis = max(0.0, float(np.max(rows[rows[:, 2] > 0.5, 1], initial=0.0)))
    every = {name: judged(loop, gains, optimum) for name, gains in rules.of_record(rows, load, 0.0, hysteresis).items()}
    gains = at(found.get("gains"))
    every["selfosc autotune"] = judged(loop, gains, optimum)
    for name in ("AMIGO PID", "SIMC PI"):
        rule = next((rule for rule in found.get("rules", []) if rule["name"] == name), None)
        every[f"{name} on the fitted process"] = judged(loop, at(rule), optimum) if rule and rule["proportional"] > 0.0 else None
    return {
        "seed": seed, "kind": plant.kind, "condition": condition, "samples": len(rows),
        "refused": found["refused"]["code"] if "refused" in found else None,
        "trust": found.get("trust"), "family": found["models"][0]["family"] if "models" in found else None,
        "intervals": intervals(plant, found) if "models" in found else {}, "rules": every,
        "seconds": after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime,
    }  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    jobs = parser.add_subparsers(dest="job", required=True)
    run = jobs.add_parser("run")
    run.add_argument("command")
    run.add_argument("--from", type=int, default=1_000_000, dest="first")
    run.add_argument("--records", type=int, default=2000)
    run.add_argument("--list", type=Path, required=True)
    printed = jobs.add_parser("page")
    printed.add_argument("list", type=Path)
    printed.add_argument("heaters", type=Path)
    arguments = parser.parse_args()
    if arguments.job == "page":
        print(page.of([json.loads(line) for line in arguments.list.read_text().splitlines()], arguments.heaters.read_text()))
        return
    done = len(arguments.list.read_text().splitlines()) if arguments.list.exists() else 0
    with tempfile.TemporaryDirectory() as folder, arguments.list.open("a") as results:
        for seed in range(arguments.first + done, arguments.first + arguments.records):
            results.write(json.dumps(one(arguments.command, seed, Path(folder))) + "\n")
            results.flush()


if __name__ == "__main__":
    main()
