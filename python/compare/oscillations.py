"""python-control's describing functions beside what is true, on thirty loops: the judge's table of oscillations, and who finds them.

python compare/oscillations.py [--truth FILE] [--selfosc COMMAND]

The truth is what `cargo run -p selfosc-oscillations -- describing truth --json` prints: harmonic balance with 397 harmonics and an
integration of each loop. python-control has no dead time: Pade approximations of order 8 stand for it.
"""

import argparse
import json
import os
import subprocess
import time
import warnings
from pathlib import Path

import control as ct
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
AMPLITUDES = np.geomspace(0.15, 15, 300)
OMEGA = np.geomspace(0.05, 50, 1000)
# A first harmonic stands for the oscillation within a quarter of its amplitude and frequency.
NEAR = 0.25


def characteristic(one):
    """The function that python-control is given."""
    if one["kind"] == "piecewise-linear":
        kinks, slopes = np.array(one["kinks"]), np.array(one["slopes"])
        jumps = np.diff(slopes)

        def line(x):
            return slopes[0] * x + np.sum(jumps * np.maximum(x - kinks, 0.0))

        return lambda x: line(x) - line(0.0)
    if one["kind"] == "polynomial":
        return lambda x: np.polynomial.polynomial.polyval(x, one["coefficients"])
    return lambda x: one["gain"] * np.tanh(one["scale"] * x)


def by_python_control(loop):
    """Amplitude and frequency of each intersection, and the time taken."""
    plant = ct.tf(loop["num"], loop["den"])
    if loop["delay"] > 0:
        plant *= ct.tf(*ct.pade(loop["delay"], 8))
    f = ct.saturation_nonlinearity(1) if loop["nonlinearity"] == "saturation" else characteristic(loop["characteristic"])
    begin = time.perf_counter()
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        found = ct.describing_function_response(plant, f, AMPLITUDES, OMEGA).intersections
    spent = time.perf_counter() - begin
    # Neighbouring segments of the curves may both report the same point, and the refinement may leave the range of the truth.
    each = []
    for a, omega in found:
        if a <= AMPLITUDES[-1] and all(abs(a / b - 1) > 1e-3 or abs(omega / w - 1) > 1e-3 for b, w in each):
            each.append((float(a), float(omega)))
    return each, spent


def by_selfosc(command, loop):
    """The document of `selfosc balance --json` and the time taken; nothing where the command is not there."""
    if not command:
        return None, None
    arguments = [command, "balance", f"--delay={loop['delay']!r}", f"--nonlinearity={loop['nonlinearity']}", "--json"]
    arguments += [f"--{key}=" + ",".join(map(repr, loop[key])) for key in ("num", "den")]
    arguments += [f"--set={key}={value!r}" for key, value in loop["settings"]]
    begin = time.perf_counter()
    said = subprocess.run(arguments, capture_output=True, text=True, check=False).stdout
    return json.loads(said) if said.strip() else None, time.perf_counter() - begin


def nearest(found, amplitude, omega):
    """The intersection that stands for an oscillation."""
    near = [(max(abs(a / amplitude - 1), abs(w / omega - 1)), (a, w)) for a, w in found]
    return min((one for one in near if one[0] < NEAR), default=(None, None))[1]


def boxes(document):
    """Proved bounds of amplitude and frequency."""
    proved = list(document.get("proved") or [])
    proved += [one["existence"] for one in document["intersections"] if (one.get("existence") or {}).get("shown")]
    return [(box["amplitude"], box["omega_rad_s"]) for box in proved]


def within(low, value, high):
    """Whether bounds hold a value that is known to 13 digits."""
    return low <= value * (1 + 1e-13) and value * (1 - 1e-13) <= high


def selfosc_says(document, amplitude, omega):
    """A cell: first harmonic, stability, and the proved box that holds the oscillation."""
    if document is None:
        return "-"
    verdicts = {(one["amplitude"], one["omega_rad_s"]): one.get("stable") for one in document["intersections"]}
    found = nearest(verdicts, amplitude, omega)
    words = []
    if found:
        verdict = {True: "stable", False: "unstable", None: "stability open"}[verdicts[found]]
        words.append(f"{percent(found[0], amplitude)}, {verdict}")
    for (low, high), (slow, fast) in boxes(document):
        if within(low, amplitude, high) and within(slow, omega, fast):
            words.append(f"proved to {(high - low) / (high + low):.0e}")
            break
    return ", ".join(words) or "nothing"


def percent(found, true):
    return f"{100 * (found / true - 1):+.2f} %"


def truths(path):
    if path:
        return json.loads(Path(path).read_text())
    judge = ["cargo", "run", "--quiet", "--package", "selfosc-oscillations", "--", "describing", "truth", "--json"]
    return json.loads(subprocess.run(judge, cwd=ROOT, capture_output=True, text=True, check=True).stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--truth", help="JSON of the judge; made by cargo without it")
    parser.add_argument("--selfosc", default=os.environ.get("SELFOSC_COMMAND"), help="the command, for its column")
    given = parser.parse_args()

    print(f"python-control {ct.__version__}\n")
    print("| loop | amplitude | omega, rad/s | attracting | python-control | selfosc |")
    print("|---|---:|---:|---|---|---|")
    counts = {"oscillations": 0, "python-control finds": 0, "python-control also says": 0}
    spent = {"python-control": 0.0, "selfosc": 0.0}
    for truth in truths(given.truth):
        loop = truth["loop"]
        found, theirs_s = by_python_control(loop)
        document, ours_s = by_selfosc(given.selfosc, loop)
        spent["python-control"] += theirs_s
        spent["selfosc"] += ours_s or 0.0
        met = set()
        for one in truth["oscillations"]:
            best = one["integrated"] or one
            amplitude, omega = best["amplitude"], best["omega_rad_s"]
            theirs = nearest(found, amplitude, omega)
            met.add(theirs)
            counts["oscillations"] += 1
            counts["python-control finds"] += theirs is not None
            yes = {True: "yes", False: "no", None: "?"}[one["attracting"]]
            cell = percent(theirs[0], amplitude) if theirs else "nothing"
            print(f"| {loop['name']} | {amplitude:.9f} | {omega:.9f} | {yes} | {cell} | {selfosc_says(document, amplitude, omega)} |")
        for a, omega in found:
            if (a, omega) not in met:
                counts["python-control also says"] += 1
                print(f"| {loop['name']} | no such oscillation | | | {a:.4f} at {omega:.4f} | |")
    print("\n" + "; ".join(f"{name}: {count}" for name, count in counts.items()))
    print("; ".join(f"{name} {seconds:.1f} s" for name, seconds in spent.items() if seconds))


if __name__ == "__main__":
    main()
