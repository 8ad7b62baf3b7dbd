"""What users give as numbers, arrays, paths and argument names: as the package needs it, or refused by name."""

from __future__ import annotations

import functools
import inspect
import math
import operator
import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any, ParamSpec, TypeVar, get_args

import numpy as np
from numpy.typing import NDArray

from ._names import near, nearest
from .errors import UsageError

_P = ParamSpec("_P")
_R = TypeVar("_R")


def named(function: Callable[_P, _R]) -> Callable[_P, _R]:
    """The same function, which answers an argument that it has not with the nearest of those that it has."""
    signature = inspect.signature(function)

    @functools.wraps(function)
    def checked(*arguments: _P.args, **options: _P.kwargs) -> _R:
        try:
            return function(*arguments, **options)
        except TypeError:
            try:
                signature.bind(*arguments, **options)
            except TypeError as error:
                raise UsageError(_unbound(function.__qualname__.removesuffix(".__init__"), signature, options, error)) from None
            raise

    return checked


def constructed(kind: type[_R]) -> type[_R]:
    """The same class, whose constructor answers as :func:`named`."""
    kind.__init__ = named(kind.__init__)  # type: ignore[method-assign]
    return kind


def check(function: Callable[..., object], options: Iterable[str]) -> None:
    """Refuses options that a function has not."""
    signature = inspect.signature(function)
    for option in options:
        if option not in signature.parameters:
            raise UsageError(_unbound(function.__name__, signature, [option], TypeError()))


def _unbound(name: str, signature: inspect.Signature, options: Iterable[str], error: TypeError) -> str:
    """Why arguments do not fit a function."""
    named = (one for one in signature.parameters.values() if one.kind not in (one.VAR_POSITIONAL, one.VAR_KEYWORD))
    known = [one.name for one in named if one.name != "self"]
    # Other keywords are parameters of a characteristic.
    open_ended = any(one.kind is one.VAR_KEYWORD for one in signature.parameters.values())
    unknown = [] if open_ended else [one for one in options if one not in known]
    if unknown:
        return f"{name} has no argument {unknown[0]}; {nearest(unknown[0], known)}"
    return f"{name}: {error}; its arguments are {', '.join(known)}"


def shown(value: object) -> str:
    """A value in a message, cut in its middle: an integer may have thousands of digits."""
    try:
        text = repr(value)
    except ValueError:  # sys.set_int_max_str_digits
        return f"an integer of {value.bit_length()} bits" if isinstance(value, int) else f"a {type(value).__name__}"
    if "\n" in text:
        return f"an object of type {type(value).__name__}"
    return text if len(text) <= 40 else f"{text[:20]}...{text[-20:]}"


def number(value: Any, name: str) -> float:
    """A float; complex numbers, texts and integers that no float holds are refused."""
    try:
        if np.ma.is_masked(value):
            raise TypeError
        return _real(value)
    except (TypeError, ValueError, OverflowError) as error:
        limit = "at most 1.8e308 in magnitude" if isinstance(error, OverflowError) else "a real number"
        raise UsageError(f"{name} is {shown(value)}: must be {limit}; give another") from error


def finite(value: Any, name: str) -> float:
    """A float that is neither infinite nor NaN."""
    found = number(value, name)
    if not math.isfinite(found):
        raise UsageError(f"{name} is {found}: must be a finite number; give another")
    return found


def pair(value: Any, name: str) -> tuple[float, float]:
    """Two floats."""
    try:
        lower, upper = value
    except (TypeError, ValueError) as error:
        raise UsageError(f"{name} is {shown(value)}: must be two numbers; give the lower first") from error
    return number(lower, name), number(upper, name)


def whole(value: Any, name: str, least: int = 0) -> int:
    """An integer that the machine counts with."""
    try:
        count = operator.index(value)
    except TypeError as error:
        raise UsageError(f"{name} is {shown(value)}: must be a whole number; give one from {least} on") from error
    if not least <= count < 1 << 64:
        raise UsageError(f"{name} is {shown(count)}: must be from {least} to 18446744073709551615; give another")
    return count


def switch(value: Any, name: str) -> bool:
    """True or False, and no object that is merely taken for one of them."""
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise UsageError(f"{name} is {shown(value)}: must be True or False; give one of these")


def text(value: Any, name: str) -> str:
    """A text."""
    if isinstance(value, str):
        return value
    raise UsageError(f"{name} is {shown(value)}: must be text; give a str")


def mapping(value: Any, name: str, known: Iterable[str] | None = None) -> Mapping[str, Any]:
    """A mapping, with no other keys than the known ones."""
    if not isinstance(value, Mapping):
        raise UsageError(f"{name} is {shown(value)}: must be a mapping from names to values; give one")
    names = list(known or value)
    for key in value:
        if key not in names:
            raise UsageError(f"{name} has {shown(key)}: must have no other keys than {', '.join(names)}; {nearest(str(key), names)}")
    return value


def several(value: Any, single: type | tuple[type, ...]) -> list[Any]:
    """The elements of an iterable; what is single, or cannot be iterated over, alone."""
    return [value] if isinstance(value, single) or not isinstance(value, Iterable) else list(value)


def required(module: Callable[[], Any], extra: str) -> Any:
    """A library, or how to get it."""
    try:
        return module()
    except ImportError as error:
        raise UsageError(f'{error.name} is not installed; pip install "selfosc[{extra}]"', "not-installed") from error


def choice(value: Any, name: str, names: Any) -> Any:
    """One of the names of a ``Literal``."""
    known = get_args(names)
    if isinstance(value, str) and value in known:
        return value
    meant = near(value.lower(), known) if isinstance(value, str) else None
    remedy = f"did you mean {meant}?" if meant else "give one of these"
    raise UsageError(f"{name} is {shown(value)}: must be {', '.join(known[:-1])} or {known[-1]}; {remedy}")


def optional(convert: Callable[[Any, str], _R], value: Any, name: str) -> _R | None:
    """``None``, or what it is converted to."""
    return None if value is None else convert(value, name)


def array(values: Any, name: str) -> NDArray[np.float64]:
    """An array of floats, as :func:`floats`; refused where it is none."""
    try:
        return floats(values)
    except (TypeError, ValueError, OverflowError) as error:
        raise UsageError(f"{name} is {shown(values)}: must be an array of real numbers ({cut(error)}); give numbers in it") from error


def floats(values: Any) -> NDArray[np.float64]:
    """Floats, where NaN stands for what is masked or missing (``None``, pandas' NA): it holds no reading.

    Raises ``TypeError``, ``ValueError`` or ``OverflowError`` for complex numbers, texts and integers that no float holds.
    """
    masked = isinstance(values, np.ma.MaskedArray)
    found = np.asarray(values.data if masked else values)
    if found.dtype.kind == "O":
        found = np.array([np.nan if _missing(one) else _real(one) for one in found.ravel()]).reshape(found.shape)
    if found.dtype.kind in "cSU":
        raise TypeError("complex numbers" if found.dtype.kind == "c" else "texts")
    found = np.asarray(found, dtype=np.float64)
    return np.where(np.ma.getmaskarray(values), np.nan, found) if masked else found


def _real(one: Any) -> float:
    # numpy would leave the imaginary part out.
    if np.iscomplexobj(one):
        raise TypeError("a complex number")
    if isinstance(one, (str, bytes)):
        raise TypeError("a text")
    return float(one)


def _missing(one: Any) -> bool:
    # pandas.NA is known by its type's name, so that pandas need not be there.
    return one is None or one is np.ma.masked or type(one).__name__ == "NAType"


def cut(error: BaseException) -> str:
    """The first 120 characters of an error."""
    return str(error)[:120] or type(error).__name__


def path(given: Any, name: str = "path") -> str:
    """A path as text, which any bytes may stand in; refused where the system cannot name it."""
    try:
        text = os.fsdecode(given)
        named = os.fsencode(text)
    except (TypeError, UnicodeError) as error:
        raise UsageError(f"{name} is {shown(given)}: must be a path that the system can name; give another") from error
    if not text:
        raise UsageError(f"{name} is '': must be a path; give one")
    if b"\0" in named:
        raise UsageError(f"{name} is {shown(text)}: must have no character of code 0; give another")
    return text


def in_text(text: str) -> str:
    """A path as a message shows it: bytes that are no text as question marks."""
    return text.encode("utf-8", "replace").decode()
