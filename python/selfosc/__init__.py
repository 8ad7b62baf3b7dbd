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
from .loops import Balance, Certificate, Prediction, balance, certify, predict, simulate
from .theory import Reproduction, Verification, reproduce, verify

__all__ = [
    "Balance",
    "Bounds",
    "Certificate",
    "DescribingFunction",
    "Design",
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
    "balance",
    "bounded",
    "catalogue",
    "certify",
    "describing_function",
    "design",
    "df",
    "errors",
    "identify",
    "nonlinearity",
    "predict",
    "reproduce",
    "simulate",
    "tune",
    "verify",
]
