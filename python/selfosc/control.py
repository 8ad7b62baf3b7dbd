"""A controller for an identified axis, with its verified margins."""

from __future__ import annotations

from typing import Any

from . import _documents
from ._results import Result
from .errors import UsageError
from .identification import Identification

__all__ = ["Tuned", "tune"]

_INTERVALS = {"alpha": "alpha_interval", "beta": "beta_interval", "beta_quadratic": "beta_quadratic_interval"}


class Tuned(Result):
    """Gains, and what was verified of them without the design equations."""


def tune(
    model: Identification | None = None,
    *,
    bandwidth: float,
    alpha: float | None = None,
    beta: float | None = None,
    beta_quadratic: float | None = None,
    delay: float | None = None,
    structure: str = "pd",
    step: float = 1.0,
    limit: float | None = None,
    top_speed: float | None = None,
    alpha_interval: tuple[float, float] | None = None,
    beta_interval: tuple[float, float] | None = None,
    beta_quadratic_interval: tuple[float, float] | None = None,
    delay_interval: tuple[float, float] | None = None,
) -> Tuned:
    """Gains for ``alpha x'' + (beta + beta_quadratic |x'|) x' = u(t - delay)`` by pole placement, and their margins.

    Parameters
    ----------
    model : Identification, optional
        Gives what is not given: the values of ``reported`` and its intervals. One whose trust is ``"doubtful"`` is refused.
    bandwidth : float
        Of the answer to the reference, -3 dB, rad/s.
    alpha, beta, beta_quadratic, delay : float
        Inertia, drag and delay, as for :func:`selfosc.predict`.
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
        ``gains``, ``margins`` and what was verified.

    Raises
    ------
    RecordRefused
        Where some axis in the intervals is not stabilised (code ``unstable``), or the model is not to be trusted.
    SelfoscError
        For a bandwidth that the delay forbids, with the largest that it allows, and for numbers outside their domain.

    Examples
    --------
    >>> from selfosc import tune
    >>> found = tune(alpha=0.033, beta=0.01, beta_quadratic=0.06, delay=0.2, bandwidth=0.8)
    >>> found.gains["structure"], round(found.gains["proportional"], 5)
    ('pd', 0.02112)
    """
    given = {"alpha": alpha, "beta": beta, "beta_quadratic": beta_quadratic, "delay": delay}
    intervals = {
        "alpha_interval": alpha_interval, "beta_interval": beta_interval,
        "beta_quadratic_interval": beta_quadratic_interval, "delay_interval": delay_interval,
    }  # fmt: skip
    if model is not None:
        _fill(given, intervals, model)
    if given["alpha"] is None:
        raise UsageError("there is no inertia; give a model, or alpha")
    arguments = _documents.flags(
        **given, **intervals, bandwidth=bandwidth, structure=structure, step=step, limit=limit, top_speed=top_speed
    )
    return Tuned(_documents.answer("tune", *arguments)[1])


def _fill(given: dict[str, Any], intervals: dict[str, Any], model: Identification) -> None:
    answer = model.reported
    if not answer:
        raise UsageError("the model reports no answer to tune for; identify with the method fit or all")
    if model.trust == "doubtful":
        reasons = "; ".join(reason["text"] for reason in answer["reasons"])
        raise UsageError(f"the model is doubtful: {reasons}; give alpha and drag yourself, or log another record", "doubtful")
    for name in given:
        part = answer.get("delay_s" if name == "delay" else name)
        if part is None or given[name] is not None:
            continue
        given[name] = max(part["value"], 0.0)
        if part["low"] is not None and intervals[f"{name}_interval"] is None:
            lowest = 0.0 if name != "alpha" else part["low"]
            intervals[f"{name}_interval"] = (max(part["low"], lowest), max(part["high"], given[name]))
