"""Which experiment to make, and a controller for the axis that it gives, with its verified margins."""

from __future__ import annotations

import json
import math
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

from . import _arguments, _documents, types
from ._results import Result, _flat
from .errors import UsageError
from .identification import Identification

__all__ = ["Design", "Tuned", "design", "tune"]


Structure = Literal["pd", "pid", "ipd"]


class Tuned(Result):
    """Gains, and what was verified of them without the design equations."""

    gains: types.Gains
    double_pole_rad_s: float
    placed_for_slope: float
    margins: types.Margins
    verified: types.Verified
    sensitivity: types.SensitivityRange
    worst_case: types.WorstCase | None
    offset: float
    with_force: types.UnderForce | None

    def __init__(self, document: Mapping[str, Any], output_unit: str = "x") -> None:
        super().__init__(document)
        self._output_unit = output_unit

    def _title(self) -> str:
        peak = self.sensitivity["proved_upper"]
        limit = "not proved" if peak is None else f"at most {peak:.4g}"
        return f"{self.gains['structure']} controller; largest sensitivity {limit}"

    def _table(self) -> list[list[str]]:
        """Gains, margins and the step; F is the command's unit, x the output's where no model names it."""
        x = self._output_unit
        gains, step, worst = self.gains, self.verified["step"], self.worst_case
        margins = self.margins if worst is None else worst["at_least"]
        over = "" if worst is None else ", all axes"
        rows: list[tuple[str, float | None, str]] = [
            ("proportional", gains["proportional"], f"F/{x}"),
            ("integral", gains["integral"] or None, f"F/({x} s)"),
            ("derivative", gains["derivative"], f"F s/{x}"),
            ("filter", gains["filter_s"], "s"),
            ("bandwidth", self.verified["bandwidth_rad_s"], "rad/s"),
            (f"gain margin{over}", margins["gain"], ""),
            (f"phase margin{over}", math.degrees(margins["phase_rad"]), "deg"),
            (f"delay margin{over}", margins["delay_s"], "s"),
            ("overshoot", step["overshoot_percent"], "%"),
            ("settling", step["settling_s"], "s"),
            ("offset by the force", self.offset or None, x),
        ]
        return [["", "value", "unit"], *([name, f"{value:.4g}", unit] for name, value, unit in rows if value is not None)]


@_arguments.named
def tune(
    model: Identification | None = None,
    *,
    bandwidth: float | None = None,
    ms: float | None = None,
    phase_margin: float | None = None,
    alpha: float | None = None,
    beta: float | None = None,
    beta_quadratic: float | None = None,
    delta: float | None = None,
    delay: float | None = None,
    structure: Structure = "pd",
    step: float = 1.0,
    limit: float | None = None,
    top_speed: float | None = None,
    alpha_interval: tuple[float, float] | None = None,
    beta_interval: tuple[float, float] | None = None,
    beta_quadratic_interval: tuple[float, float] | None = None,
    delay_interval: tuple[float, float] | None = None,
) -> Tuned:
    """Gains for ``alpha x'' + (beta + beta_quadratic |x'|) x' = u(t - delay) + delta`` by pole placement, and their margins.

    What the gains are for is one of ``bandwidth``, ``ms`` and ``phase_margin``.

    Parameters
    ----------
    model : Identification, optional
        Instead of ``alpha``, drag, ``delta`` and ``delay``: ``reported`` with all its terms, and its intervals where no others are
        given.
    bandwidth : float, optional
        Of the answer to the reference, -3 dB, rad/s.
    ms : float, optional
        Largest sensitivity of any axis in the intervals: the largest bandwidth is taken at which it is proved. 1.2 is cautious,
        1.4 usual, 2 lively.
    phase_margin : float, optional
        Least phase margin of any axis in the intervals, degrees; taken likewise.
    alpha, beta, beta_quadratic, delta, delay : float
        Inertia, drag, constant force and delay, as for :func:`selfosc.predict`.
    structure : {"pd", "pid", "ipd"}
    step, limit : float
        Step of the reference to simulate, output units, and the largest command in it, command units.
    top_speed : float, optional
        Up to which quadratic drag counts in the margins, output units per s; by default that of the step.
    alpha_interval, beta_interval, beta_quadratic_interval, delay_interval : (float, float), optional
        Margins are given for every axis in them.

    Returns
    -------
    Tuned
        ``gains``, ``margins`` and what was verified; ``offset`` is where a PD leaves the axis under the constant force.

    Raises
    ------
    SelfoscError
        Where some axis in the intervals is not stabilised (code ``unstable``), for a model that is not to be trusted or has no
        inertia, for a bandwidth that the delay forbids, with the largest that it allows, for a limit that no bandwidth keeps
        (``out-of-reach``), and for numbers outside their domain.

    Examples
    --------
    >>> from selfosc import tune
    >>> found = tune(alpha=0.033, beta=0.01, beta_quadratic=0.06, delay=0.2, bandwidth=0.8)
    >>> found.gains["structure"], round(found.gains["proportional"], 5)
    ('pd', 0.04203)
    >>> cautious = tune(alpha=0.033, beta=0.01, delta=0.004, delay=0.2, alpha_interval=(0.032, 0.034), ms=1.4)
    >>> cautious.sensitivity["proved_upper"] <= 1.4, cautious.offset > 0
    (True, True)
    """
    options = {
        "alpha": alpha, "beta": beta, "beta_quadratic": beta_quadratic, "delta": delta, "delay": delay,
        "bandwidth": bandwidth, "ms": ms, "phase_margin": phase_margin,
        "structure": _arguments.choice(structure, "structure", Structure),
        "step": step, "limit": limit, "top_speed": top_speed, "alpha_interval": alpha_interval,
        "beta_interval": beta_interval, "beta_quadratic_interval": beta_quadratic_interval, "delay_interval": delay_interval,
    }  # fmt: skip
    if model is None:
        if alpha is None:
            raise UsageError("there is no inertia; give a model, or alpha")
        return Tuned(_documents.answer("tune", *_documents.flags(**options))[1])
    if not isinstance(model, Identification):
        raise UsageError(f"model is {_arguments.shown(model)}: must be an Identification; give one, or alpha, drag and delay")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.json"
        path.write_text(json.dumps(model.to_dict()), encoding="utf-8")
        return Tuned(_documents.answer("tune", *_documents.flags(model=str(path), **options))[1], model.units["output"])


class Design(Result):
    """Relay experiments, the best for the inertia first."""

    proposals: list[types.Proposal]

    def _rows(self) -> list[dict[str, Any]]:
        return [_flat(proposal) for proposal in self.to_dict()["proposals"]]


@_arguments.named
def design(
    *,
    alpha: float,
    beta: float = 0.0,
    beta_quadratic: float = 0.0,
    delta: float = 0.0,
    delay: float = 0.0,
    delay_known: bool = False,
    level: float,
    time: float,
    rate: float = 10.0,
    quantum: float = 0.0,
    noise: float = 0.0,
    largest_amplitude: float | None = None,
    proposals: int = 5,
) -> Design:
    """Which relay level and half-width determine the inertia best, and which second level tells the drag laws apart.

    Parameters
    ----------
    alpha, beta, beta_quadratic, delta, delay : float
        A rough model, as for :func:`selfosc.predict`.
    delay_known : bool
        The delay will be known.
    level : float
        The largest relay level, command units.
    time : float
        Length of one record, s.
    rate, quantum, noise : float
        Samples per second; step of the sensor and standard deviation of its noise, output units.
    largest_amplitude : float, optional
        That is allowed, output units.
    proposals : int
        How many.

    Returns
    -------
    Design
        ``proposals`` with expected standard deviations, and whether a cycle would lock to the sampling.

    Raises
    ------
    SelfoscError
        Where no relay makes the rough model oscillate within the limits, and for numbers outside their domain.

    Examples
    --------
    >>> from selfosc import design
    >>> best = design(alpha=1, beta_quadratic=0.5, delay=0.1, level=1, time=60, quantum=0.0175, proposals=1).proposals[0]
    >>> best["first"]["std"]["alpha"] < 0.1
    True
    """
    arguments = _documents.flags(
        alpha=alpha, beta=beta, beta_quadratic=beta_quadratic, delta=delta, delay=delay, delay_known=delay_known, level=level,
        time=time, rate=rate, quantum=quantum, noise=noise, largest_amplitude=largest_amplitude, proposals=proposals,
    )  # fmt: skip
    return Design(_documents.answer("design", *arguments)[1])
