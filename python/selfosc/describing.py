"""Characteristics and their describing functions."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from typing import Any, Literal, NamedTuple, TypeGuard

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arguments, _core, _documents, types
from ._names import Suggesting
from ._results import Result
from .errors import OutOfDomain, SelfoscError, UsageError

__all__ = ["Described", "DescribingFunction", "Nonlinearity", "catalogue", "describing_function", "df", "nonlinearity"]


#: Characteristics whose output depends on where the input came from.
_WITH_MEMORY = frozenset({"relay-hysteresis", "relay-dead-zone-hysteresis", "backlash"})


Method = Literal["closed-form", "quadrature", "certified"]
Undefined = Literal["raise", "nan"]


class DescribingFunction(NamedTuple):
    """Mean and complex gain of a characteristic under ``bias + amplitude sin(theta)``.

    The output is ``f0 + amplitude (p sin(theta) + q cos(theta))`` and higher harmonics, of which it says nothing.
    """

    f0: NDArray[np.float64] | float
    """Mean of the output, output units."""
    p: NDArray[np.float64] | float
    """In-phase gain, output units per input unit."""
    q: NDArray[np.float64] | float
    """Quadrature gain, output units per input unit; negative where the output lags."""

    @property
    def gain(self) -> NDArray[np.complex128] | complex:
        """``p + jq``."""
        return complex(self.p, self.q) if isinstance(self.p, float) else np.asarray(self.p) + 1j * np.asarray(self.q)


class Described(Result):
    """A describing function as the command gives it: numbers, and ranges that contain them where they are certified."""

    nonlinearity: str
    params: types.Parameters
    amplitude: float
    bias: float
    f0: float
    p: float
    q: float
    method: str
    enclosure: types.DescribingFunctionEnclosure | None


class Nonlinearity(Suggesting):
    """A characteristic of the catalogue with its parameters; made by :func:`nonlinearity`.

    python-control takes it wherever it takes its own. Called, it gives the output for an input; one with memory (hysteresis,
    backlash) keeps the output of its last call, until :meth:`reset`.
    """

    def __init__(self, name: str, **parameters: Any) -> None:
        named_characteristic(name)
        given = [(key, _parameter(value, key)) for key, value in parameters.items()]
        self._core = _core.Characteristic(name, given)
        self.name = name
        self._has_memory = name in _WITH_MEMORY
        self._last: float | None = None

    @property
    def parameters(self) -> dict[str, Any]:
        """Every parameter with its value, defaults included."""
        return {name: _value(text) for name, text in self._core.settings()}

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={value!r}" for name, value in self.parameters.items())
        return f"nonlinearity({self.name!r}, {shown})"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Nonlinearity):
            return NotImplemented
        return (self.name, self._core.settings()) == (other.name, other._core.settings())

    def __hash__(self) -> int:
        return hash((self.name, tuple(self._core.settings())))

    def __reduce__(self) -> tuple[Callable[..., Nonlinearity], tuple[Any, ...]]:
        return _rebuilt, (self.name, self.parameters)

    def __call__(self, x: Any) -> Any:
        """The output for an input, or for each of an array in turn.

        Parameters
        ----------
        x : float or array_like
            Input units. With memory, the order of an array is the order in time.

        Returns
        -------
        float or ndarray
            Output units, of the shape of ``x``.
        """
        inputs = _arguments.array(x, "the input")
        if not np.isfinite(inputs).all():
            raise UsageError("the input must be finite; remove what is not a number before the call", "not-finite")
        if self._has_memory:
            outputs = np.array([self._follow(float(one)) for one in inputs.ravel()]).reshape(inputs.shape)
        else:
            outputs = self._core.outputs(np.require(inputs, requirements=["C", "A"]).reshape(-1)).reshape(inputs.shape)
        return outputs if inputs.ndim else float(outputs)

    @cached_property
    def _reach(self) -> float:
        return 4.0 * sum(abs(value) for value in self.parameters.values() if isinstance(value, float))

    def _follow(self, x: float) -> float:
        """Between what a rising and a falling input would give, the output stays where it was."""
        # A sweep so wide that neither of its turning points matters.
        rising, falling = self._core.branches(x, 0.0, self._reach + 4.0 * abs(x))
        low, high = min(rising, falling), max(rising, falling)
        self._last = rising if self._last is None else min(max(self._last, low), high)
        return self._last

    def reset(self) -> None:
        """Forgets the last output: the next call starts as on the way up."""
        self._last = None

    def _isstatic(self) -> bool:
        return not self._has_memory

    def describing_function(self, A: ArrayLike, bias: ArrayLike = 0.0) -> Any:
        """The complex gain ``P + jQ``, exact.

        Parameters
        ----------
        A : float or array_like
            Amplitude, input units. At 0 the limit, where there is one: the slope at the bias.
        bias : float or array_like, default 0
            Mean of the input, input units.

        Returns
        -------
        complex or ndarray of complex
            Output units per input unit, of the shape to which both broadcast.

        Raises
        ------
        SelfoscError
            For amplitudes below 0, and at 0 where the gain grows without limit.

        Notes
        -----
        Where the input is too small to switch a hysteresis or to cross a gap, the output rests, and the gain is 0. Its mean is
        then wherever it came to rest, which :func:`describing_function` refuses to say.
        """
        if _single(A) and _single(bias) and A > 0.0:
            return self._at_rest(A, bias)
        amplitude, centre = _broadcast(_arguments.array(A, "amplitude"), _arguments.array(bias, "bias"))
        if (amplitude < 0.0).any():
            value = float(amplitude[amplitude < 0.0].flat[0])
            raise OutOfDomain(
                f"cannot evaluate at amplitude {value}: must be 0 or more; give the amplitude X of x = B + X sin(theta)",
                "out-of-domain", "amplitude", value, "input units", "a finite number, 0 or more", "give the amplitude X",
            )  # fmt: skip
        zero = amplitude == 0.0
        if not (zero.any() or self._has_memory):
            return describing_function(self, amplitude, centre).gain
        gain = np.empty(amplitude.shape, dtype=complex)
        gain[~zero] = describing_function(self, amplitude[~zero], centre[~zero], undefined="nan").gain
        gain[zero] = [0.0 if self._has_memory else self._slope(float(one)) for one in centre[zero]]
        for place in np.flatnonzero(np.isnan(gain)):
            gain.flat[place] = self._at_rest(float(amplitude.flat[place]), float(centre.flat[place]))
        return gain if gain.ndim else complex(gain)

    def _at_rest(self, amplitude: float, bias: float) -> complex:
        """The gain where there is no describing function: none of an output that rests, else why there is none."""
        try:
            _, p, q = self._core.of_sweep(amplitude, bias)
            return complex(p, q)
        except SelfoscError as refusal:
            if refusal.code == "below-switching":
                return 0j
            raise

    def _slope(self, bias: float) -> complex:
        """The limit of the gain: the same at two small amplitudes, or there is none."""
        small = 1e-9 * max(1.0, abs(bias))
        first, second = (complex(describing_function(self, amplitude, bias).gain) for amplitude in (small, 1e-3 * small))
        if abs(first - second) > 1e-6 * abs(first):
            raise UsageError(
                f"{self.name} has no gain at amplitude 0 and bias {bias}: it steps there; give an amplitude above 0",
                "no-gain-at-zero",
            )
        return first


def _rebuilt(name: str, parameters: dict[str, Any]) -> Nonlinearity:
    return Nonlinearity(name, **parameters)


@_arguments.named
def nonlinearity(name: str, **parameters: Any) -> Nonlinearity:
    """A characteristic by name: callable, and a describing function for python-control.

    Parameters
    ----------
    name : str
        As :func:`catalogue` lists it: ``"relay-hysteresis"``, ``"saturation"``, ...
    **parameters : float or sequence of (float, float)
        As listed there, in input and output units.

    Returns
    -------
    Nonlinearity

    Raises
    ------
    SelfoscError
        For an unknown name or parameter, one that is missing, and one outside its domain.

    Examples
    --------
    >>> from selfosc import nonlinearity
    >>> relay = nonlinearity("relay-hysteresis", half_width=0.5)
    >>> relay
    nonlinearity('relay-hysteresis', level=1.0, half_width=0.5, offset=0.0)
    >>> relay([-1.0, 0.3, 0.6, -0.3])
    array([-1., -1.,  1.,  1.])
    >>> complex(relay.describing_function(1.0)).imag
    -0.6366197723675814
    """
    return Nonlinearity(name, **parameters)


@_arguments.named
def describing_function(
    characteristic: str | Nonlinearity | Callable[[float], float],
    amplitude: ArrayLike,
    bias: ArrayLike = 0.0,
    *,
    kinks: Iterable[float] = (),
    undefined: Undefined = "raise",
    **parameters: Any,
) -> DescribingFunction:
    """``F_0``, ``P`` and ``Q`` of a characteristic under ``bias + amplitude sin(theta)``.

    Parameters
    ----------
    characteristic : str, Nonlinearity or callable
        A name of the catalogue with its parameters, an object made of them, or a function of the input (and, if it takes
        two arguments, of whether the input rises). A function is integrated between its kinks by adaptive quadrature.
    amplitude : float or array_like
        Half the input's range, input units, above 0.
    bias : float or array_like, default 0
        Mean of the input, input units; broadcast with ``amplitude``.
    kinks : iterable of float
        Inputs at which a function is not smooth. One left out costs accuracy or makes the quadrature give up.
    undefined : {"raise", "nan"}
        What to do where there is none, as below the amplitude at which a hysteresis switches.
    **parameters : float or sequence of (float, float)
        Of a characteristic given by name.

    Returns
    -------
    DescribingFunction
        Floats, or arrays of the shape to which amplitude and bias broadcast. Exact to rounding for the catalogue's closed
        forms; for a function the estimated error is below 1e-13 of its largest value, which is no bound.

    Raises
    ------
    SelfoscError
        For numbers outside their domain, and where there is no describing function.

    Notes
    -----
    Eqs. 10-15 of Miskovic, Vukic, Barisic, AUTOMATIKA 50 (2009), in closed form from the distances of the breakpoints to the
    turning points of the input.

    Examples
    --------
    >>> from selfosc import describing_function
    >>> describing_function("relay", 2.0).p
    0.6366197723675814
    >>> describing_function("saturation", [0.5, 1.0, 2.0], breakpoint=1.0).p.round(4)
    array([1.   , 1.   , 0.609])
    >>> describing_function("saturation-asymmetric", 2.0, bias=0.3, lower=-1.0, upper=0.5).f0
    -0.11321593152331502
    >>> round(describing_function(lambda x: x**3, 2.0).p, 12)
    3.0
    """
    if isinstance(characteristic, str):
        characteristic = Nonlinearity(characteristic, **parameters)
    elif parameters:
        raise UsageError(f"parameters {', '.join(parameters)} go with a name only; leave them out")
    # Without arrays a single sweep takes a tenth of the time.
    if isinstance(characteristic, Nonlinearity) and undefined == "raise" and _single(amplitude) and _single(bias):
        return DescribingFunction(*characteristic._core.of_sweep(amplitude, bias))
    sizes = _arguments.array(amplitude, "amplitude"), _arguments.array(bias, "bias")
    wide, centre = _broadcast(*sizes)
    shape = wide.shape
    # A single number is not spread out over the other's shape.
    wide, centre = (
        np.require(one if one.size == 1 and shape else full, requirements=["C", "A"]).reshape(-1)
        for one, full in zip(sizes, (wide, centre), strict=True)
    )
    if 0 in shape:
        empty = np.empty(shape)
        return DescribingFunction(empty, empty.copy(), empty.copy())
    _arguments.choice(undefined, "undefined", Undefined)
    parts: Iterable[NDArray[np.float64]]
    if isinstance(characteristic, Nonlinearity):
        parts = characteristic._core.describing_function(wide, centre, undefined == "nan")
    elif callable(characteristic):
        places = [_arguments.finite(kink, "kinks") for kink in _arguments.several(kinks, str)]
        parts = _core.by_quadrature(_of_branch(characteristic), places, wide, centre)
    else:
        raise UsageError(f"{characteristic!r} is no characteristic: give a name, an object of nonlinearity() or a function")
    if shape:
        return DescribingFunction(*(part.reshape(shape) for part in parts))
    return DescribingFunction(*(float(part[0]) for part in parts))


def named_characteristic(name: Any) -> str:
    """A name, which the catalogue may still not have."""
    if not isinstance(name, str):
        raise UsageError(f"{_arguments.shown(name)} is no name of a characteristic; selfosc.catalogue() lists them")
    return name


def _single(value: Any) -> TypeGuard[float]:
    """Whether a value is one number that a float holds."""
    return isinstance(value, (float, int)) and abs(value) < 1e308


def _broadcast(amplitude: NDArray[np.float64], bias: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
    try:
        return tuple(np.broadcast_arrays(amplitude, bias))
    except ValueError as error:
        text = f"amplitude and bias have the shapes {amplitude.shape} and {bias.shape}; give shapes that broadcast"
        raise UsageError(text) from error


def _of_branch(function: Callable[..., Any]) -> Callable[[float, bool], float]:
    import inspect

    try:
        takes_branch = len(inspect.signature(function).parameters) > 1
    except (TypeError, ValueError):
        takes_branch = False
    if takes_branch:
        return lambda x, rising: _output(function(x, rising))
    return lambda x, _: _output(function(x))


def _output(value: Any) -> float:
    """A value of a user's function, which may be an array of one element."""
    return value if isinstance(value, float) else _arguments.number(np.squeeze(value), "the function's value")


@_arguments.named
def df(
    name: str,
    amplitude: float,
    bias: float = 0.0,
    *,
    method: Method = "closed-form",
    **parameters: Any,
) -> Described:
    """One describing function as the command ``selfosc df`` gives it, with proof on request.

    Parameters
    ----------
    name : str
        A name of the catalogue.
    amplitude, bias : float
        Of the input, input units.
    method : {"closed-form", "quadrature", "certified"}
        ``certified`` gives intervals that contain the exact values, by rigorous quadrature that knows no closed form.
    **parameters
        Of the characteristic.

    Returns
    -------
    Described
        ``nonlinearity, params, amplitude, bias, f0, p, q, method, enclosure``.

    Examples
    --------
    >>> from selfosc import df
    >>> low, high = df("relay", 2.0, method="certified").enclosure["p"]
    >>> low <= 2 / 3.141592653589793 <= high and high - low < 1e-12
    True
    """
    arguments = _documents.flags(amplitude=amplitude, bias=bias, method=_arguments.choice(method, "method", Method))
    return Described(_documents.answer("df", named_characteristic(name), *_documents.settings(parameters), *arguments)[1])


@_arguments.named
def catalogue() -> dict[str, list[types.Parameter]]:
    """Every characteristic with its parameters: name, meaning, domain and default of each.

    Examples
    --------
    >>> from selfosc import catalogue
    >>> [parameter["name"] for parameter in catalogue()["saturation"]]
    ['slope', 'breakpoint']
    """
    _, text = _core.run(["df", "--list", "--json"])
    return {entry["name"]: entry["parameters"] for entry in json.loads(text)}


def _parameter(value: Any, name: str) -> float | Sequence[tuple[float, float]]:
    if isinstance(value, Iterable) and not isinstance(value, (str, bytes)) and getattr(value, "ndim", 1) > 0:
        return _documents.points(value, name)
    return _arguments.number(value, name)


def _value(text: str) -> Any:
    if ":" not in text:
        return float(text)
    return [tuple(float(part) for part in pair.split(":")) for pair in text.split(",")]
