"""Where a loop oscillates: by harmonic balance, exactly, and with proof."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from . import _arguments, _core, _documents, types
from ._results import Result
from .describing import Nonlinearity, named_characteristic
from .errors import NoLimitCycle, SelfoscError, UsageError, _in_python

__all__ = ["Balance", "Certificate", "Drawing", "Prediction", "balance", "certify", "predict", "simulate"]


class Drawing:
    """A figure as SVG, which a notebook shows."""

    def __init__(self, svg: str) -> None:
        self.svg = svg

    def _repr_svg_(self) -> str:
        return self.svg

    def save(self, path: str | Path) -> None:
        """Writes the SVG file."""
        place = _arguments.path(path)
        try:
            Path(place).write_text(self.svg, encoding="utf-8")
        except OSError as error:
            text = f"cannot write {_arguments.in_text(place)}: {error.strerror}; choose a place that you may write to"
            raise SelfoscError(text, "unwritable") from error


class Balance(Result):
    """The intersections of a Nyquist curve with ``-1/N``, and all oscillations that are proved to exist."""

    intersections: list[types.Intersection]
    proved: list[types.ProvedOscillation] | None

    def __init__(self, document: Mapping[str, Any], arguments: Sequence[str]) -> None:
        super().__init__(document)
        self._arguments = list(arguments)

    def plot(self) -> Drawing:
        """The Nyquist curve with ``-1/N``, each intersection with its period and verdict: the command's own figure."""
        with tempfile.TemporaryDirectory() as folder:
            place = Path(folder) / "nyquist.svg"
            _core.run(["balance", *self._arguments, f"--svg={place}"])
            return Drawing(place.read_text(encoding="utf-8"))

    def _rows(self) -> list[dict[str, Any]]:
        return self.to_dict()["intersections"]

    def __len__(self) -> int:
        return len(self.intersections)

    def __iter__(self) -> Iterator[types.Intersection]:
        return iter(self.intersections)

    def __getitem__(self, index: int) -> types.Intersection:
        return self.intersections[index]


class Prediction(Result):
    """The self-oscillation of a drag axis: ``harmonic_balance``, ``exact``, ``certificate``."""

    harmonic_balance: types.FirstHarmonic | None
    exact: types.Cycle
    certificate: types.CycleProof | None
    certificate_refused: types.Note | None


class Certificate(Result):
    """Orbits of a relay loop, each proved, and the periods searched."""

    orbits: list[types.Orbit]
    complete: bool
    range_s: types.OpenRange
    not_covered: list[types.OpenRange]

    def _rows(self) -> list[dict[str, Any]]:
        return self.to_dict()["orbits"]

    def __len__(self) -> int:
        return len(self.orbits)

    def __iter__(self) -> Iterator[types.Orbit]:
        return iter(self.orbits)

    def __getitem__(self, index: int) -> types.Orbit:
        return self.orbits[index]


@_arguments.named
def balance(plant: Any, characteristic: str | Nonlinearity, *, delay: float = 0.0, bias: float = 0.0, **parameters: Any) -> Balance:
    """The oscillations that harmonic balance predicts for a plant in negative feedback with a characteristic.

    Parameters
    ----------
    plant : control.TransferFunction, control.StateSpace, scipy.signal.lti or (num, den)
        Continuous time, one input and output, descending powers of s.
    characteristic : str or Nonlinearity
        A name of the catalogue with ``parameters``, or an object of :func:`selfosc.nonlinearity`.
    delay : float, default 0
        Of the plant, s.
    bias : float, default 0
        Of the characteristic's input, input units.

    Returns
    -------
    Balance
        ``intersections``, each with ``amplitude`` (input units), ``omega_rad_s`` and ``stable`` (Loeb's verdict: true, false
        or ``None``), and ``existence``, a proved box or the reason for none; ``proved``, every box. None is an answer too.
        ``plot()`` draws the curves.

    Raises
    ------
    SelfoscError
        For a plant or characteristic that is none.

    Notes
    -----
    An approximation: all harmonics but the first are left out. :func:`certify` and :func:`predict` leave out none.

    Examples
    --------
    >>> from selfosc import balance
    >>> found = balance(([8], [1, 2, 2, 1]), "saturation", breakpoint=1)
    >>> round(found[0]["amplitude"], 4), round(found[0]["omega_rad_s"], 4), found[0]["stable"]
    (3.344, 1.4142, True)
    """
    if isinstance(characteristic, Nonlinearity):
        name, parameters = characteristic.name, {**characteristic.parameters, **parameters}
    else:
        name = named_characteristic(characteristic)
    num, den, delay = _documents.coefficients(plant, delay)
    arguments = _documents.flags(num=num, den=den, delay=delay, nonlinearity=name, bias=bias) + _documents.settings(parameters)
    return Balance(_documents.answer("balance", *arguments)[1], arguments)


@_arguments.named
def predict(
    *,
    alpha: float,
    beta: float = 0.0,
    beta_quadratic: float = 0.0,
    delta: float = 0.0,
    relay: float,
    half_width: float,
    delay: float = 0.0,
) -> Prediction:
    """The self-oscillation of ``alpha x'' + (beta + beta_quadratic |x'|) x' = u(t - delay) + delta`` under a relay.

    Parameters
    ----------
    alpha : float
        Inertia with added mass, command units s^2 per output unit, above 0.
    beta, beta_quadratic : float
        Linear drag, command units s per output unit, and quadratic drag, command units s^2 per output unit squared.
    delta : float
        Constant disturbance, command units.
    relay, half_width : float
        Level C, command units, and half-width x_a of the hysteresis, output units.
    delay : float
        Of the whole loop, s.

    Returns
    -------
    Prediction
        ``harmonic_balance`` (the approximation), ``exact`` (closed-form motion between switchings) and ``certificate``
        (intervals that contain the exact values, with uniqueness and attraction), each a dictionary or ``None``.

    Raises
    ------
    NoLimitCycle
        Where there is none.
    SelfoscError
        For numbers outside their domain.

    Examples
    --------
    >>> from selfosc import predict
    >>> found = predict(alpha=1, beta=1, relay=1, half_width=0.2, delta=0.3)
    >>> low, high = found.certificate["enclosure"]["period_s"]
    >>> low <= found.exact["period_s"] <= high
    True
    """
    arguments = _documents.flags(
        alpha=alpha, beta=beta, beta_quadratic=beta_quadratic, delta=delta, relay=relay, half_width=half_width, delay=delay
    )
    no, document = _documents.answer("predict", *arguments)
    if no:
        raise NoLimitCycle(_in_python(document["no_limit_cycle"]["text"]), "no-limit-cycle")
    return Prediction(document)


@_arguments.named
def certify(
    plant: Any, relay: Nonlinearity, *, delay: float = 0.0, reference: float = 0.0, period_s: tuple[float, float] | None = None
) -> Certificate:
    """All orbits of a linear plant with dead time under a relay, one switching each way in a period, each proved.

    Parameters
    ----------
    plant : control.TransferFunction, control.StateSpace, scipy.signal.lti or (num, den)
        Strictly proper; the relay's input is the reference minus its output.
    relay : Nonlinearity
        A ``relay`` or a ``relay-hysteresis``; its ``offset`` makes levels unequal: a heater has ``level=0.5, offset=0.5``.
    delay : float, default 0
        Of the plant, s.
    reference : float, default 0
        About which the relay switches, output units.
    period_s : (float, float), optional
        The periods to look at, s; all from the slowest down where left out.

    Returns
    -------
    Certificate
        ``orbits``, the slowest first, each with ``period_s``, ``amplitude``, ``bias``, ``multipliers``, ``attracting`` and
        ``enclosure``; ``range_s``, the periods searched, of which ``not_covered`` may hold other orbits; ``complete``.

    Raises
    ------
    SelfoscError
        For a plant or relay that is refused.

    Notes
    -----
    Proved is each orbit, that the relay switches nowhere else on it, and that ``range_s`` outside ``not_covered`` holds no other, for
    exactly the coefficients given. Orbits with more than two switchings a period are not looked for. ``attracting`` is ``None``
    where it is not decided.

    Examples
    --------
    >>> from selfosc import certify, nonlinearity
    >>> orbit = certify(([1], [1, 1, 0]), nonlinearity("relay-hysteresis", half_width=0.2))[0]
    >>> low, high = orbit["enclosure"]["time_high_s"]
    >>> low < 1.862223721734969 < high and high - low < 1e-12, orbit["attracting"]
    (True, True)
    """
    if not isinstance(relay, Nonlinearity):
        raise UsageError(f"relay is {_arguments.shown(relay)}: must be an object of selfosc.nonlinearity(); make one")
    parameters = relay.parameters
    if relay.name not in ("relay", "relay-hysteresis"):
        raise NoLimitCycle(f"{relay!r} is no relay; give a relay or a relay-hysteresis", "not-a-relay")
    num, den, delay = _documents.coefficients(plant, delay)
    level, offset = parameters["level"], parameters.get("offset", 0.0)
    arguments = _documents.flags(
        num=num,
        den=den,
        delay=delay,
        relay=[offset + level, offset - level],
        half_width=parameters.get("half_width", 0.0),
        reference=reference,
        periods=_arguments.optional(_arguments.pair, period_s, "period_s"),
    )
    return Certificate(_documents.answer("predict", *arguments)[1])


@_arguments.named
def simulate(
    *,
    alpha: float,
    beta: float = 0.0,
    beta_quadratic: float = 0.0,
    delta: float = 0.0,
    relay: float,
    half_width: float,
    delay: float = 0.0,
    cycles: float = 10.0,
    rate: float = 10.0,
    quantum: float = 0.0,
    noise: float = 0.0,
    hold: bool = False,
    seed: int = 0,
    degrees: bool = False,
) -> dict[str, list[float]]:
    """A record of a relay experiment on a drag axis that starts at rest.

    Parameters
    ----------
    alpha, beta, beta_quadratic, delta, relay, half_width, delay : float
        As for :func:`predict`.
    cycles : float
        Length in cycles of the limit cycle.
    rate : float
        Samples per second.
    quantum, noise : float
        Step to which readings are rounded, and standard deviation of their noise before that, output units.
    hold : bool
        Sample the relay at the rate too.
    seed : int
        Of the noise.
    degrees : bool
        Take the output for radians and write it in degrees, as ``heading_deg``.

    Returns
    -------
    dict
        ``time_s``, ``output`` (or ``heading_deg``) and ``input``, lists of one length; :func:`selfosc.identify` takes it.

    Examples
    --------
    >>> from selfosc import simulate
    >>> record = simulate(alpha=1, beta=1, relay=1, half_width=0.3, cycles=2)
    >>> list(record), record["time_s"][1]
    (['time_s', 'output', 'input'], 0.1)
    """
    arguments = _documents.flags(
        alpha=alpha, beta=beta, beta_quadratic=beta_quadratic, delta=delta, relay=relay, half_width=half_width, delay=delay,
        cycles=cycles, rate=rate, quantum=quantum, noise=noise, hold=hold, seed=seed, degrees=degrees,
    )  # fmt: skip
    return _documents.answer("simulate", *arguments)[1]
