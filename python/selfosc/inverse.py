"""Describing functions the other way round: amplitudes that have a gain, and characteristics that have measured gains."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _arguments, _documents, types
from ._results import Result, _flat
from .describing import Nonlinearity, named_characteristic
from .errors import UsageError

__all__ = ["Amplitudes", "FittedCharacteristics", "amplitudes", "fit_characteristic"]


class Amplitudes(Result):
    """The amplitudes at which a characteristic has a gain, growing."""

    nonlinearity: str
    params: types.Parameters
    bias: float
    gain: float
    amplitudes: list[types.AmplitudeOfGain]

    def _rows(self) -> list[dict[str, Any]]:
        return self.to_dict()["amplitudes"]

    def __len__(self) -> int:
        return len(self._rows())

    def __iter__(self) -> Iterator[types.AmplitudeOfGain]:
        return iter(self.amplitudes)

    def __getitem__(self, index: int) -> types.AmplitudeOfGain:
        return self.amplitudes[index]


class FittedCharacteristics(Result):
    """Characteristics fitted to measured gains, the best first."""

    fits: list[types.FittedCharacteristic]

    def _rows(self) -> list[dict[str, Any]]:
        return [_flat(fit) for fit in self.to_dict()["fits"]]

    def __len__(self) -> int:
        return len(self.fits)

    def __iter__(self) -> Iterator[types.FittedCharacteristic]:
        return iter(self.fits)

    def __getitem__(self, index: int) -> types.FittedCharacteristic:
        return self.fits[index]


@_arguments.named
def amplitudes(characteristic: str | Nonlinearity, gain: float, bias: float = 0.0, **parameters: Any) -> Amplitudes:
    """Every amplitude from 0.001 to 1000 found at which ``P`` has a value.

    Parameters
    ----------
    characteristic : str or Nonlinearity
        A name of the catalogue with ``parameters``, or an object of :func:`selfosc.nonlinearity`.
    gain : float
        The in-phase gain ``P``, output units per input unit.
    bias : float, default 0
        Mean of the input, input units.
    **parameters : float or sequence of (float, float)
        Of a characteristic given by name.

    Returns
    -------
    Amplitudes
        Each with ``amplitude`` (input units) and ``f0``, ``p``, ``q`` there. None is an answer too. A gain often has two
        amplitudes; two that are closer together than 1.4 percent can be missed.

    Raises
    ------
    SelfoscError
        For an unknown characteristic and numbers outside their domain.

    Notes
    -----
    ``selfosc df NAME --gain P``: the range is sampled at 1000 amplitudes, even in their logarithm, and crossings are bisected.

    Examples
    --------
    >>> from selfosc import amplitudes
    >>> found = amplitudes("relay-dead-zone", 1.0, dead_zone=0.5)
    >>> [round(one["amplitude"], 6) for one in found]
    [0.555729, 1.145559]
    >>> len(amplitudes("relay-dead-zone", 2.0, dead_zone=0.5))
    0
    """
    if isinstance(characteristic, Nonlinearity):
        if parameters:
            raise UsageError(f"parameters {', '.join(parameters)} go with a name only; leave them out")
        name, parameters = characteristic.name, characteristic.parameters
    else:
        name = named_characteristic(characteristic)
    arguments = _documents.flags(gain=gain, bias=bias)
    return Amplitudes(_documents.answer("df", name, *_documents.settings(parameters), *arguments)[1])


@_arguments.named
def fit_characteristic(amplitude: ArrayLike, p: ArrayLike, bias: float = 0.0) -> FittedCharacteristics:
    """Which characteristics of the catalogue have measured gains, the best first.

    Parameters
    ----------
    amplitude : array_like
        Amplitudes of the input, input units, above 0; of one dimension.
    p : array_like
        The in-phase gain ``P`` at each, output units per input unit.
    bias : float, default 0
        Mean of the input, the same for all of them, input units.

    Returns
    -------
    FittedCharacteristics
        Each with ``nonlinearity``, ``params`` and ``residual``, the standard deviation of the residuals in the units of ``p``,
        which counts parameters against it. Several can fit equally well, and the search can miss the best parameters. Left out:
        those with as many parameters as there are points, and ``piecewise-linear``, which fits anything.

    Raises
    ------
    SelfoscError
        For points that are not pairs of finite numbers with a positive amplitude.

    Notes
    -----
    ``selfosc df --fit FILE``: least squares by Levenberg-Marquardt from the ten best of 600 parameter sets.

    Examples
    --------
    >>> from selfosc import describing_function, fit_characteristic
    >>> measured = [0.2, 0.5, 0.8, 1.1, 1.6, 2.5, 4.0]
    >>> found = fit_characteristic(measured, describing_function("saturation", measured, slope=2.0, breakpoint=0.7).p)
    >>> "saturation" in [one["nonlinearity"] for one in found][:3] and found[0]["residual"] < 1e-9
    True
    """
    wide, gains = (_arguments.array(column, name) for column, name in ((amplitude, "amplitude"), (p, "p")))
    if wide.ndim != 1 or wide.shape != gains.shape:
        raise UsageError(f"amplitude and p have the shapes {wide.shape} and {gains.shape}; give one gain for each amplitude")
    if wide.size == 0:
        raise UsageError("amplitude is []: must have a point for each parameter, and one more; give measured gains")
    for name, column in (("amplitude", wide), ("p", gains)):
        if not np.isfinite(column).all():
            place = int(np.flatnonzero(~np.isfinite(column))[0])
            raise UsageError(f"{name}[{place}] is {column[place]}: must be finite; leave the point out", "not-finite")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "gains.csv"
        rows = (f"{float(x)!r},{float(y)!r}\n" for x, y in zip(wide, gains, strict=True))
        path.write_text("amplitude,p\n" + "".join(rows), encoding="utf-8")
        return FittedCharacteristics(_documents.answer("df", f"--fit={path}", *_documents.flags(bias=_arguments.number(bias, "bias")))[1])
