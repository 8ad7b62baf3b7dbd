"""A controller for an identified axis, with its verified margins."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

from . import _documents
from ._results import Result
from .errors import UsageError
from .identification import Identification

__all__ = ["Tuned", "tune"]


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
        Instead of ``alpha``, drag and ``delay``: the values of ``reported``, with its intervals where no others are given.
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
    SelfoscError
        Where some axis in the intervals is not stabilised (code ``unstable``), for a model that is not to be trusted or has terms
        that no design knows of, for a bandwidth that the delay forbids, with the largest that it allows, and for numbers outside
        their domain.

    Examples
    --------
    >>> from selfosc import tune
    >>> found = tune(alpha=0.033, beta=0.01, beta_quadratic=0.06, delay=0.2, bandwidth=0.8)
    >>> found.gains["structure"], round(found.gains["proportional"], 5)
    ('pd', 0.04203)
    """
    options = {
        "alpha": alpha, "beta": beta, "beta_quadratic": beta_quadratic, "delay": delay, "bandwidth": bandwidth,
        "structure": structure, "step": step, "limit": limit, "top_speed": top_speed, "alpha_interval": alpha_interval,
        "beta_interval": beta_interval, "beta_quadratic_interval": beta_quadratic_interval, "delay_interval": delay_interval,
    }  # fmt: skip
    if model is None:
        if alpha is None:
            raise UsageError("there is no inertia; give a model, or alpha")
        return Tuned(_documents.answer("tune", *_documents.flags(**options))[1])
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.json"
        path.write_text(json.dumps(model.to_dict()), encoding="utf-8")
        return Tuned(_documents.answer("tune", *_documents.flags(model=str(path), **options))[1])
