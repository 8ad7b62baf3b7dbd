#!/usr/bin/env python3
"""Two printer heaters whose processes are published, tuned by Klipper's procedure and by `selfosc autotune` from the same record.

    python tests/autotune/heaters.py target/release/selfosc > heaters.md

RepRapFirmware's `Configuration.h` has gain, time constant and dead time of an E3D V6 hotend with 30 W and of a PCB bed. Klipper's
`PID_CALIBRATE` switches at the target and 5 degrees below it, takes the whole power for half the step, and Ziegler and Nichols' rule.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import rules
import simulator
from loops import Loop

#: Name, process for full power (degrees, s), target above the room, degrees.
HEATERS = (
    ("hotend", simulator.Plant("first-order", 340.0, 5.5, (140.0,)), 175.0),
    ("bed", simulator.Plant("first-order", 90.0, 10.0, (700.0,)), 35.0),
)
INTERVAL_S, NOISE, HALF_STEP, PERIODS, LIMIT = 0.3, 0.05, 2.5, 3, 1.4
#: Klipper's configuration has gains in 255ths of full power.
BASE = 255.0


def tuned(command: str, rows: np.ndarray) -> np.ndarray:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "record.csv"
        np.savetxt(path, rows, delimiter=",", header="time_s,temperature,heater", comments="", fmt="%.12g")
        said = subprocess.run([command, "autotune", path, "--json", "--ms", str(LIMIT)], capture_output=True, text=True, check=True)
    gains = json.loads(said.stdout)["gains"]
    return np.array([gains["proportional"], gains["integral"], gains["derivative"]])


def main() -> None:
    print("| heater | rule | pid_kp | pid_ki | pid_kd | largest sensitivity | error over optimum |\n| --- | --- | --- | --- | --- | --- | --- |")
    for number, (name, plant, target) in enumerate(HEATERS):
        random = np.random.default_rng([58, number])
        run = lambda samples: simulator.relay(  # noqa: E731
            plant, target / plant.gain, INTERVAL_S, HALF_STEP, NOISE, 0.0, samples, False, 0.0, random
        )
        ups = np.flatnonzero(np.diff(run(8000)[:, 2]) > 0)
        period = int(np.median(np.diff(ups)))
        rows = run((PERIODS + 3) * period)[2 * period :]
        rows[:, 0] -= rows[0, 0]
        loop = Loop(plant, INTERVAL_S)
        optimum = min(loop.optimum(LIMIT, derivative) for derivative in (False, True))
        others = rules.of_record(rows, target / plant.gain, 0.0, HALF_STEP)
        answers = {rule: others[rule] for rule in ("Klipper", "Ziegler-Nichols PID, Marlin")} | {"selfosc autotune": tuned(sys.argv[1], rows)}
        for rule, gains in answers.items():
            peak, error = loop.peak(gains), loop.absolute_error(gains) / optimum
            shown = " | ".join(f"{BASE * gain:.4g}" for gain in gains)
            print(f"| {name} | {rule} | {shown} | {f'{peak:.2f} | {error:.2f}' if np.isfinite(peak) else 'unstable | -'} |")


if __name__ == "__main__":
    main()
