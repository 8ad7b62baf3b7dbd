"""What gains do on a known process: stability, largest sensitivity, integral of the absolute error after a step of the load."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import minimize
from simulator import Plant

#: Derivative time over the time constant of its filter.
FILTER = 10.0
#: Points of a Fourier transform: 65 ultimate periods in steps of a twentieth of a radian.
LINES = 8192


@dataclass(frozen=True)
class Loop:
    """A process with a controller that holds its command for an interval: half of that is delay."""

    plant: Plant
    held_s: float

    def process(self, omega: np.ndarray) -> np.ndarray:
        return self.plant.response(omega) * np.exp(-0.5j * omega * self.held_s)

    @cached_property
    def ultimate(self) -> tuple[float, float]:
        """Ultimate gain and frequency of the process without the hold."""
        return self.plant.ultimate()

    @cached_property
    def fine(self) -> tuple[np.ndarray, np.ndarray]:
        omega = self.ultimate[1] * np.logspace(-4, 2, 3000)
        return omega, self.process(omega)

    @cached_property
    def coarse(self) -> tuple[np.ndarray, np.ndarray]:
        omega = self.ultimate[1] * np.logspace(-2.5, 1.5, 400)
        return omega, self.process(omega)

    def peak(self, gains: np.ndarray, grid: tuple[np.ndarray, np.ndarray] | None = None) -> float:
        """The largest sensitivity; infinite for an unstable loop, by the argument of 1 + L (Nyquist)."""
        omega, process = grid or self.fine
        back = 1.0 + controller(gains, omega) * process
        turned = np.unwrap(np.angle(back))[-1] - np.angle(back[0])
        poles_at_zero = 1 + self.plant.integrates
        first = np.angle(back[0])
        # An open loop with a double pole at zero begins at -180 degrees, on whichever side rounding puts it.
        if poles_at_zero == 2 and first > 0.0:
            turned += 2.0 * np.pi
        stable = abs(turned - 0.5 * np.pi * poles_at_zero) < 0.25 * np.pi
        return float(np.max(1.0 / np.abs(back))) if stable else np.inf

    @cached_property
    def lines(self) -> tuple[np.ndarray, np.ndarray]:
        omega = 2.0 * np.pi * np.fft.rfftfreq(LINES, 0.05 / self.ultimate[1])[1:]
        return omega, self.process(omega)

    def absolute_error(self, gains: np.ndarray) -> float:
        """By the inverse Fourier transform of P/(1 + L)/s, over 65 ultimate periods."""
        step = 0.05 / self.ultimate[1]
        omega, process = self.lines
        control = controller(gains, omega)
        answer = np.empty(len(omega) + 1, complex)
        answer[1:] = process / (1.0 + control * process) / (1j * omega)
        answer[0] = 1.0 / gains[1]
        return float(np.sum(np.abs(np.fft.irfft(answer / step, LINES))) * step)

    def largest_gain(self, times: tuple[float, float], limit: float) -> np.ndarray | None:
        """The largest gain at these integral and derivative times that keeps the limit."""
        ultimate = self.ultimate[0]
        of = lambda gain: np.array([gain, gain / times[0], gain * times[1]])  # noqa: E731
        meets = lambda gain: self.peak(of(gain), self.coarse) <= limit  # noqa: E731
        found = next((ultimate * 0.85**k for k in range(1, 30) if meets(ultimate * 0.85**k)), None)
        if found is None:
            return None
        low, high = found, found / 0.85
        for _ in range(7):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if meets(middle) else (low, middle)
        return of(low)

    def optimum(self, limit: float, derivative: bool) -> float:
        """The least integral of the absolute error of any PI, or PID, that keeps the limit: Nelder and Mead over the times."""
        period_s = 2.0 * np.pi / self.ultimate[1]

        def left(logs: np.ndarray) -> float:
            gains = self.largest_gain((period_s * np.exp(logs[0]), period_s * np.exp(logs[1]) if derivative else 0.0), limit)
            return np.inf if gains is None else self.absolute_error(gains)

        starts = [(0.5, 0.12), (1.5, 0.12)] if derivative else [(0.5,), (2.5,)]
        settings = {"xatol": 0.01, "fatol": 0.0, "maxfev": 50}
        with np.errstate(invalid="ignore"):
            return min(minimize(left, np.log(start), method="Nelder-Mead", options=settings).fun for start in starts)


def controller(gains: np.ndarray, omega: np.ndarray) -> np.ndarray:
    """Proportional, integral, derivative, with the filter at a tenth of the derivative time."""
    proportional, integral, derivative = gains
    s = 1j * omega
    filter_s = derivative / proportional / FILTER
    return proportional + integral / s + derivative * s / (filter_s * s + 1.0)
