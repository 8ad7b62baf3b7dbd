"""From keyword arguments to the command's arguments, and from its JSON documents to Python."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any

from . import _arguments, _core
from .errors import UsageError, of

#: Options of which a sequence is one value, joined by commas; others are repeated.
_JOINED = {"num", "den", "relay", "periods", "alpha_interval", "beta_interval", "beta_quadratic_interval", "delay_interval"}


def number(value: Any, name: str) -> str:
    """A number with every digit that it has, as the command reads it."""
    return repr(_arguments.number(value, name))


def points(value: Any, name: str) -> list[tuple[float, float]]:
    """The points of a characteristic's graph."""
    try:
        pairs = [(x, y) for x, y in value]
    except (TypeError, ValueError) as error:
        raise UsageError(f"{name} is {_arguments.shown(value)}: must be a number, or pairs of numbers; give one of these") from error
    return [(_arguments.number(x, name), _arguments.number(y, name)) for x, y in pairs]


def setting(value: Any, name: str) -> str:
    """The value of a characteristic's parameter: a number, or points."""
    if isinstance(value, Iterable):
        return ",".join(f"{x!r}:{y!r}" for x, y in points(value, name))
    return number(value, name)


#: Options that count, which the command reads as integers.
_COUNTS = {"cases", "proposals", "seed"}
#: Options that are text, those of which several may be given, and those that are switched on.
_TEXTS = {"coordinate", "form", "method", "model", "nonlinearity", "out", "structure", "time_unit"}
_REPEATED = {"claim", "only"}
_SWITCHES = {"degrees", "delay_known", "hold", "hold_command", "pi", "pid", "skip_bad_rows"}


def _text(value: Any, name: str) -> str:
    if name in _TEXTS or name in _REPEATED:
        return _arguments.text(value, name)
    if isinstance(value, bool):
        raise UsageError(f"{name} is {value}: must be a number; give one")
    return str(_arguments.whole(value, name)) if name in _COUNTS else number(value, name)


def json_of(settings: Mapping[str, Any]) -> str:
    """Settings as a JSON document."""
    for name, value in settings.items():
        # `json` writes texts, numbers and lists of numbers; each is named where it is another.
        if isinstance(value, bytes) or not isinstance(value, (str, bool, int, float, list, dict, type(None))):
            raise UsageError(f"{name} is {_arguments.shown(value)}: must be text, a number or None; give one of these")
    try:
        return json.dumps(settings, allow_nan=False)
    except ValueError as error:
        raise UsageError(f"a setting is not a finite number ({error}); give numbers") from error


def flags(**options: Any) -> list[str]:
    """Options as a shell would pass them: those that are ``None`` or ``False`` are left out."""
    arguments: list[str] = []
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        if value is None:
            continue
        if name in _SWITCHES:
            arguments += [flag] if _arguments.switch(value, name) else []
        elif name in _REPEATED:
            arguments += [f"{flag}={_text(one, name)}" for one in value]
        else:
            values = _arguments.several(value, str) if name in _JOINED else [value]
            arguments.append(f"{flag}={','.join(_text(one, name) for one in values)}")
    return arguments


def settings(parameters: Mapping[str, Any]) -> list[str]:
    """Parameters of a characteristic as ``--set`` options."""
    return [f"--set={name}={setting(value, name)}" for name, value in parameters.items()]


def answer(subcommand: str, *arguments: str) -> tuple[bool, dict[str, Any]]:
    """Whether the command's answer is no, and its JSON document."""
    # Before a `--`, after which all arguments are files.
    no, text = _core.run([subcommand, "--json", *arguments])
    document = json.loads(text)
    if no and "refused" in document:
        raise of(document["refused"]["code"], document["refused"]["text"], record=subcommand in ("identify", "autotune"))
    return no, document


def coefficients(plant: Any, delay: float) -> tuple[list[float], list[float], float]:
    """Numerator and denominator in descending powers of s, and the delay in s.

    The plant is a ``control.TransferFunction`` or ``control.StateSpace``, a ``scipy.signal.lti``, or a pair of sequences.
    """
    if not isinstance(plant, (tuple, list)):
        if getattr(plant, "dt", None) not in (None, 0):
            raise UsageError("the plant is in discrete time; give it in continuous time", "discrete-time")
        if hasattr(plant, "ninputs"):  # python-control
            if (plant.ninputs, plant.noutputs) != (1, 1):
                raise UsageError("the plant has several inputs or outputs; give one of each", "several-channels")
            if not hasattr(plant, "num"):
                import control

                plant = control.tf(plant)
            plant = plant.num[0][0], plant.den[0][0]
        elif hasattr(plant, "to_tf"):  # scipy.signal
            plant = plant.to_tf()
            plant = plant.num, plant.den
        else:
            raise UsageError(
                f"a plant of type {type(plant).__name__} is unknown; give a control.TransferFunction, a scipy.signal.lti, "
                "or a pair (numerator, denominator) in descending powers of s",
                "unknown-plant",
            )
    try:
        num, den = ([*part] for part in plant)
    except (TypeError, ValueError) as error:
        raise UsageError("a plant of coefficients is a pair (numerator, denominator); give two sequences", "unknown-plant") from error
    for part, name in ((num, "numerator"), (den, "denominator")):
        if not part:
            raise UsageError(f"{name} is []: must have a coefficient; give them in descending powers of s", "unknown-plant")
    num, den = ([_arguments.number(c, name) for c in part] for part, name in ((num, "numerator"), (den, "denominator")))
    # Other packages keep numerator and denominator of one length; here a degree is what its length says.
    while len(num) > 1 and num[0] == 0.0:
        num = num[1:]
    return num, den, _arguments.number(delay, "delay")
