"""Rules of other tools on the same record, written anew from their papers and documentation: for the benchmark only.

Gains are ``proportional, integral, derivative``. ``None`` where a rule has no answer.
"""

from __future__ import annotations

import numpy as np


def cycle(rows: np.ndarray) -> tuple[float, float] | None:
    """Amplitude, half of peak to peak, and period of the last whole period."""
    time, output, command = rows.T
    for sign in (1.0, -1.0):
        ups = np.flatnonzero(sign * np.diff(command) > 0) + 1
        if len(ups) >= 2:
            inside = output[ups[-2] : ups[-1] + 1]
            return 0.5 * float(np.ptp(inside)), float(time[ups[-1]] - time[ups[-2]])
    return None


def pid(gain: float, integral_s: float, derivative_s: float) -> np.ndarray:
    return np.array([gain, gain / integral_s, gain * derivative_s])


def from_ultimate(ultimate: float, period_s: float) -> dict[str, np.ndarray]:
    return {
        # Trans. ASME 64, 1942; Marlin's M303 takes them for a hotend.
        "Ziegler-Nichols PID, Marlin": pid(0.6 * ultimate, period_s / 2, period_s / 8),
        # Marlin's for a bed, "no overshoot".
        "Marlin, bed": pid(0.2 * ultimate, period_s / 2, period_s / 3),
        # Ind. Eng. Chem. Res. 31, 1992.
        "Tyreus-Luyben PID": pid(ultimate / 2.2, 2.2 * period_s, period_s / 6.3),
    }


def amigo(gain: float, lag_s: float, dead_s: float) -> np.ndarray:
    """J. Process Control 14, 2004."""
    k = (0.2 + 0.45 * lag_s / dead_s) / gain
    integral_s = (0.4 * dead_s + 0.8 * lag_s) / (dead_s + 0.1 * lag_s) * dead_s
    return pid(k, integral_s, 0.5 * dead_s * lag_s / (0.3 * dead_s + lag_s))


def berner(rows: np.ndarray, load: float, level: float, hysteresis: float) -> np.ndarray | None:
    """AMIGO on the first-order process of Berner, Hagglund and Astrom (Control Eng. Practice 47, 2016), from the half periods and the
    integrals over the last period. The rule asks for the equilibrium: it is told."""
    time, output, command = rows.T
    ups = np.flatnonzero(np.diff(command) > 0) + 1
    if len(ups) < 2:
        return None
    begin, end = ups[-2], ups[-1]
    interval = np.diff(time[begin : end + 1])
    on_s = float(np.sum(interval * (command[begin:end] > 0.5)))
    off_s = float(time[end] - time[begin] - on_s)
    up, down = 1.0 - load, load
    area = float(np.sum(interval * (command[begin:end] - load)))
    gain = float(np.sum(interval * (output[begin:end] - level))) / area if area else 0.0
    half = max(on_s, off_s) / min(on_s, off_s)
    asymmetry = max(up, down) / min(up, down)
    if asymmetry < 1.0 + 1e-9:
        return None
    dead = (asymmetry - half) / ((asymmetry - 1.0) * (0.35 * half + 0.65))
    if not (0.0 < dead < 1.0 and gain > 0.0):
        return None
    ratio = dead / (1.0 - dead)
    inner = (hysteresis / gain - down + np.exp(ratio) * (up + down)) / (up - hysteresis / gain)
    if not (inner > 1.0 and up > hysteresis / gain):
        return None
    lag_s = on_s / np.log(inner)
    return amigo(gain, lag_s, lag_s * ratio)


def of_record(rows: np.ndarray, load: float, level: float, hysteresis: float) -> dict[str, np.ndarray | None]:
    """Every rule; the relay's levels are 0 and 1."""
    found: dict[str, np.ndarray | None] = {}
    seen = cycle(rows)
    if seen is not None and seen[0] > 0.0:
        amplitude, period_s = seen
        # The describing function of a relay: half its step is 1/2.
        found |= from_ultimate(4.0 * 0.5 / (np.pi * amplitude), period_s)
        # Klipper takes the whole power for half the step, and Ziegler and Nichols' rule.
        found["Klipper"] = pid(0.6 * 4.0 / (np.pi * amplitude), period_s / 2, period_s / 8)
    found["AMIGO after Berner"] = berner(rows, load, level, hysteresis)
    return found
