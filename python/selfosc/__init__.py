"""Self-oscillations under a relay, from Python.

Describing functions, exact limit cycles and their proofs, identification of vehicles from logs, controllers, and the theory as
claims that are checked. The numbers are those of the command ``selfosc``, bit for bit.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import errors, export, logs, types
from ._core import VERSION as __version__
from ._names import nearest
from ._results import Result
from .autotuning import Autotuned, autotune
from .control import Design, Tuned, design, tune
from .describing import Described, DescribingFunction, Nonlinearity, catalogue, describing_function, df, nonlinearity
from .errors import NoLimitCycle, OutOfDomain, RecordRefused, SelfoscError, UnreadableLog, UsageError
from .identification import Bounds, Identification, bounded, identify
from .inverse import Amplitudes, FittedCharacteristics, amplitudes, fit_characteristic
from .loops import Balance, Certificate, Drawing, Prediction, balance, certify, predict, simulate
from .on_board import Controller, ControlStep, Experiment, Outcome, Protocol, Step
from .theory import Reproduction, Verification, reproduce, verify

if TYPE_CHECKING:
    from . import fleet as fleet

__all__ = [
    "Amplitudes",
    "Autotuned",
    "Balance",
    "Bounds",
    "Certificate",
    "ControlStep",
    "Controller",
    "Described",
    "DescribingFunction",
    "Design",
    "Drawing",
    "Experiment",
    "FittedCharacteristics",
    "Identification",
    "NoLimitCycle",
    "Nonlinearity",
    "OutOfDomain",
    "Outcome",
    "Prediction",
    "Protocol",
    "RecordRefused",
    "Reproduction",
    "Result",
    "SelfoscError",
    "Step",
    "Tuned",
    "UnreadableLog",
    "UsageError",
    "Verification",
    "__version__",
    "amplitudes",
    "autotune",
    "balance",
    "bounded",
    "catalogue",
    "certify",
    "describing_function",
    "design",
    "df",
    "errors",
    "export",
    "fit_characteristic",
    "identify",
    "logs",
    "nonlinearity",
    "predict",
    "reproduce",
    "simulate",
    "tune",
    "types",
    "verify",
]


if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        """``selfosc.fleet`` on its first use: it needs pyarrow. Every other name that is not there has its remedy."""
        if name == "fleet":
            import importlib

            return importlib.import_module(".fleet", __name__)
        remedy = "" if name.startswith("_") else f"; {nearest(name, [*__all__, 'fleet'])}"
        raise AttributeError(f"selfosc has no {name}{remedy}")


def __dir__() -> list[str]:
    return [*__all__, "fleet"]
