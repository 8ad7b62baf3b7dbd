"""Self-oscillations under a relay, from Python.

Describing functions, exact limit cycles and their proofs, identification of vehicles from logs, controllers, and the theory as
claims that are checked. The numbers are those of the command ``selfosc``, bit for bit.
"""

from . import errors
from ._core import VERSION as __version__
from ._results import Result
from .control import Design, Tuned, design, tune
from .describing import DescribingFunction, Nonlinearity, catalogue, describing_function, df, nonlinearity
from .errors import NoLimitCycle, OutOfDomain, RecordRefused, SelfoscError, UnreadableLog, UsageError
from .identification import Bounds, Identification, bounded, identify
from .inverse import Amplitudes, FittedCharacteristics, amplitudes, fit_characteristic
from .loops import Balance, Certificate, Prediction, balance, certify, predict, simulate
from .theory import Reproduction, Verification, reproduce, verify

__all__ = [
    "Amplitudes",
    "Balance",
    "Bounds",
    "Certificate",
    "DescribingFunction",
    "Design",
    "FittedCharacteristics",
    "Identification",
    "NoLimitCycle",
    "Nonlinearity",
    "OutOfDomain",
    "Prediction",
    "RecordRefused",
    "Reproduction",
    "Result",
    "SelfoscError",
    "Tuned",
    "UnreadableLog",
    "UsageError",
    "Verification",
    "__version__",
    "amplitudes",
    "balance",
    "bounded",
    "catalogue",
    "certify",
    "describing_function",
    "design",
    "df",
    "errors",
    "fit_characteristic",
    "identify",
    "nonlinearity",
    "predict",
    "reproduce",
    "simulate",
    "tune",
    "verify",
]
