"""Records of a relay's oscillation, exact between events: linear plants in state space, advanced by the matrix exponential.

Shares nothing with the library: no closed form of a structure, no code. An event is a reading, or a command that arrives after its
dead time.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

#: Structures of the library, and two that it has not.
INSIDE = ("first-order", "second-order", "equal-lags", "second-order-zero", "integrator", "integrator-lag")
OUTSIDE = ("four-lags", "diffusion")
CONDITIONS = ("warm", "short", "cold", "wandering")


@dataclass(frozen=True)
class Plant:
    """``gain (zero_s s + 1) exp(-dead_s s)/prod(lag_s s + 1)``, over ``s`` where it integrates."""

    kind: str
    gain: float
    dead_s: float
    lags_s: tuple[float, ...]
    zero_s: float = 0.0

    @property
    def integrates(self) -> bool:
        return self.kind.startswith("integrator")

    def response(self, omega: np.ndarray) -> np.ndarray:
        s = 1j * omega
        body = np.ones_like(s) if not self.integrates else s.copy()
        for lag in self.lags_s:
            body = body * (lag * s + 1.0)
        return self.gain * (self.zero_s * s + 1.0) * np.exp(-s * self.dead_s) / body

    def ultimate(self) -> tuple[float, float]:
        """Ultimate gain and frequency: the least frequency at which the phase is -pi."""
        lag = lambda w: (  # noqa: E731
            w * self.dead_s + sum(np.arctan(w * t) for t in self.lags_s) - np.arctan(w * self.zero_s) + self.integrates * np.pi / 2
        )
        low, high = 0.0, 1e-3 / (self.dead_s + sum(self.lags_s))
        while lag(high) < np.pi:
            low, high = high, 1.05 * high
        for _ in range(80):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if lag(middle) > np.pi else (middle, high)
        return 1.0 / abs(self.response(np.array([high]))[0]), high

    def state_space(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """A cascade of lags, the integrator last; the zero adds the derivative of its input."""
        order = len(self.lags_s) + self.integrates
        a, b, c = np.zeros((order, order)), np.zeros(order), np.zeros(order)
        for k, lag in enumerate(self.lags_s):
            a[k, k] = -1.0 / lag
            if k == 0:
                b[0] = 1.0 / lag
            else:
                a[k, k - 1] = 1.0 / lag
        if self.integrates:
            if self.lags_s:
                a[-1, -2] = 1.0
            else:
                b[-1] = 1.0
        c[-1] = self.gain
        # y = x + zero x': x' of the last state is its row of the equation of motion.
        return a, b, c + self.zero_s * c[-1] * a[-1]


def drawn(seed: int) -> tuple[Plant, str, dict[str, float], np.random.Generator]:
    """A plant, the condition of its record, and sensor and relay in units of the swing: all by the seed alone."""
    random = np.random.default_rng([57, seed])
    kind = (INSIDE + OUTSIDE)[seed % 8]
    condition = CONDITIONS[(seed // 8) % 4]
    # Dead time and slow lag together; all is free of the scale of time.
    total_s = float(np.exp(random.uniform(np.log(2.0), np.log(30.0))))
    share = random.uniform(0.05, 0.95 if kind == "first-order" else 0.6)
    slow = total_s * (1.0 - share)
    gain = float(np.exp(random.uniform(np.log(0.2), np.log(200.0))))
    second = slow * random.uniform(0.1, 0.7)
    lags = {
        "first-order": (slow,), "second-order": (slow, second), "equal-lags": (slow, slow), "second-order-zero": (slow, second),
        "integrator": (), "integrator-lag": (0.3 * slow,), "four-lags": (slow / 2,) * 4,
        "diffusion": tuple(slow / k**2 for k in range(1, 9)),
    }[kind]  # fmt: skip
    zero = second * random.uniform(0.2, 2.0) if kind == "second-order-zero" else 0.0
    plant = Plant(kind, gain / slow if kind.startswith("integrator") else gain, total_s * share, lags, zero)
    settings = {
        "per_period": float(np.exp(random.uniform(np.log(20.0), np.log(200.0)))),
        "noise": random.uniform(0.02, 0.15), "quantum": random.choice([0.0, random.uniform(0.02, 0.25)]),
        "load": random.uniform(0.25, 0.75), "phase": random.uniform(0.0, 1.0),
    }  # fmt: skip
    return plant, condition, settings, random


def relay(plant, load, dt, hysteresis, noise, quantum, samples, cold, wander, random):
    """Rows (time, reading, command) under a relay from 0 to 1 about the level that the load holds."""
    a, b, c = plant.state_space()
    order = len(b)
    joint = np.zeros((order + 1, order + 1))
    joint[:order, :order], joint[:order, order] = a, b
    step_of: dict[float, np.ndarray] = {}

    def advance(state, u, time):
        if time <= 0.0:
            return state
        key = round(time, 12)
        if key not in step_of:
            step_of[key] = expm(joint * time)[:order]
        return step_of[key] @ np.append(state, u)

    # The command less the load acts on deviations from the level.
    state = np.zeros(order)
    if cold and not plant.integrates:
        state[:] = -load
    walk, now, acting, command = 0.0, 0.0, 1.0 if cold else 0.0, 1.0
    pending: list[tuple[float, float]] = []
    rows = []
    late_s = max(plant.dead_s, 1e-9)
    for k in range(samples):
        time = k * dt
        while pending and pending[0][0] <= time:
            at, value = pending.pop(0)
            state, now, acting = advance(state, acting - load + walk, at - now), at, value
        state, now = advance(state, acting - load + walk, time - now), time
        if wander:
            walk += -walk * dt / (20.0 * late_s) + wander * np.sqrt(2.0 * dt / (20.0 * late_s)) * random.standard_normal()
        reading = float(c @ state) + noise * random.standard_normal()
        reading = np.round(reading / quantum) * quantum if quantum > 0.0 else reading
        before = command
        command = 0.0 if reading > hysteresis else 1.0 if reading < -hysteresis else command
        if command != before or k == 0:
            pending.append((time + plant.dead_s, command))
        rows.append((time, reading, command))
    return np.array(rows)


def swing_and_period(rows: np.ndarray) -> tuple[float, float]:
    """Swing and period of the later half of a run."""
    changes = np.flatnonzero(np.diff(rows[:, 2]))
    settled = rows[changes[len(changes) // 2] :]
    ups = settled[np.flatnonzero(np.diff(settled[:, 2]) > 0), 0]
    return float(np.ptp(settled[:, 1])), float(np.mean(np.diff(ups)))


def record(seed: int) -> tuple[Plant, str, np.ndarray, float, float]:
    """Plant, condition, rows, the time between readings, and the load that holds the level."""
    plant, condition, settings, random = drawn(seed)
    load, share = settings["load"], settings["per_period"]
    dt = (plant.dead_s + 0.3 * sum(plant.lags_s)) / 40.0
    # Runs without noise tell swing and period, in which the sensor and the relay are drawn; noise must not switch the relay.
    swing, _ = swing_and_period(relay(plant, load, dt, 0.0, 0.0, 0.0, 1600, False, 0.0, random))
    noise, quantum = 0.5 * settings["noise"] * swing, 0.5 * settings["quantum"] * swing
    hysteresis = 2.0 * noise + 0.5 * quantum
    _, period_s = swing_and_period(relay(plant, load, dt, hysteresis, 0.0, 0.0, 1600, False, 0.0, random))
    dt = period_s / share
    cold = condition == "cold" and not plant.integrates
    wander = 0.05 if condition == "wandering" else 0.0
    before = 0 if cold else int(share * (2.0 + settings["phase"]))
    periods = {"warm": 3.5, "short": 1.75, "cold": 3.5, "wandering": 3.5}[condition]
    samples = before + int(share * (periods + 8.0 * cold)) + 1
    rows = relay(plant, load, dt, hysteresis, noise, quantum, samples, cold, wander, random)[before:]
    if cold:
        first = int(np.flatnonzero(np.diff(rows[:, 2]))[0]) if np.any(np.diff(rows[:, 2])) else 0
        rows = rows[: first + int(share * periods)]
    rows[:, 0] -= rows[0, 0]
    return plant, condition, rows, dt, load
