"""What users give as numbers, arrays, paths and argument names: as the package needs it, or refused by name."""

from __future__ import annotations

import functools
import inspect
import operator
import os
from collections.abc import Callable, Iterable
from typing import Any, ParamSpec, TypeVar, get_args

import numpy as np
from numpy.typing import NDArray

from ._names import nearest
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
                raise UsageError(_unbound(function.__name__, signature, options, error)) from None
            raise

    return checked


def check(function: Callable[..., object], options: Iterable[str]) -> None:
    """Refuses options that a function has not."""
    signature = inspect.signature(function)
    for option in options:
        if option not in signature.parameters:
            raise UsageError(_unbound(function.__name__, signature, [option], TypeError()))


def _unbound(name: str, signature: inspect.Signature, options: Iterable[str], error: TypeError) -> str:
    """Why arguments do not fit a function."""
    known = [one.name for one in signature.parameters.values() if one.kind not in (one.VAR_POSITIONAL, one.VAR_KEYWORD)]
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
    return text if len(text) <= 40 else f"{text[:20]}...{text[-20:]}"


def number(value: Any, name: str) -> float:
    """A float; complex numbers, texts and integers that no float holds are refused."""
    try:
        if isinstance(value, (str, bytes)) or np.ma.is_masked(value):
            raise TypeError
        return _real(value)
    except (TypeError, ValueError, OverflowError) as error:
        limit = "at most 1.8e308 in magnitude" if isinstance(error, OverflowError) else "a real number"
        raise UsageError(f"{name} is {shown(value)}: must be {limit}; give another") from error


def whole(value: Any, name: str) -> int:
    """An integer from 0 on that the machine counts with."""
    try:
        count = operator.index(value)
    except TypeError as error:
        raise UsageError(f"{name} is {shown(value)}: must be a whole number; give one from 0 on") from error
    if not 0 <= count < 1 << 64:
        raise UsageError(f"{name} is {shown(count)}: must be from 0 to 18446744073709551615; give another")
    return count


def choice(value: Any, name: str, names: Any) -> Any:
    """One of the names of a ``Literal``."""
    known = get_args(names)
    if isinstance(value, str) and value in known:
        return value
    remedy = nearest(value, known) if isinstance(value, str) else "give one of these"
    raise UsageError(f"{name} is {shown(value)}: must be {', '.join(known[:-1])} or {known[-1]}; {remedy}")


def optional(convert: Callable[[Any, str], _R], value: Any, name: str) -> _R | None:
    """``None``, or what it is converted to."""
    return None if value is None else convert(value, name)


def array(values: Any, name: str) -> NDArray[np.float64]:
    """An array of floats, as :func:`floats`; refused where it is none."""
    try:
        return floats(values)
    except (TypeError, ValueError, OverflowError) as error:
        raise UsageError(f"{name} is no array of real numbers ({cut(error)}); give numbers in it") from error


def floats(values: Any) -> NDArray[np.float64]:
    """Floats, where NaN stands for what is masked or missing (``None``, pandas' NA): it holds no reading.

    Raises ``TypeError``, ``ValueError`` or ``OverflowError`` for complex numbers, texts and integers that no float holds.
    """
    masked = isinstance(values, np.ma.MaskedArray)
    found = np.asarray(values.data if masked else values)
    if found.dtype.kind == "O":
        found = np.array([np.nan if _missing(one) else _real(one) for one in found.ravel()]).reshape(found.shape)
    if found.dtype.kind == "c":
        raise TypeError("complex numbers")
    found = np.asarray(found, dtype=np.float64)
    return np.where(np.ma.getmaskarray(values), np.nan, found) if masked else found


def _real(one: Any) -> float:
    # numpy would leave the imaginary part out.
    if np.iscomplexobj(one):
        raise TypeError("a complex number")
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
    if b"\0" in named:
        raise UsageError(f"{name} is {shown(text)}: must have no character of code 0; give another")
    return text


def in_text(text: str) -> str:
    """A path as a message shows it: bytes that are no text as question marks."""
    return text.encode("utf-8", "replace").decode()
