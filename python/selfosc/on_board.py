"""What runs on the vehicle, sample by sample: the relay experiment, and the controller that comes of it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _arguments, _core, _documents, types
from ._names import Suggesting
from ._results import Result
from .control import Structure, Tuned
from .errors import UsageError
from .identification import Identification, identify

__all__ = ["ControlStep", "Controller", "Experiment", "Outcome", "Protocol", "Step"]

Coordinate = Literal["position", "heading-rad", "heading-deg", "speed"]


@_arguments.constructed
@dataclass(frozen=True, kw_only=True)
class Protocol(Suggesting):
    """A relay experiment: its relay, its limits, and when it counts as done. ``None`` stands for the default of ``selfosc run``.

    Parameters
    ----------
    relay : float
        Relay level of the first attempt, command units.
    half_width : float
        Half-width of the relay's hysteresis in the first attempt, units of the coordinate.
    interval : float
        Time between two readings as planned, s. Four of them without a reading are a fault.
    coordinate : {"position", "heading-rad", "heading-deg", "speed"}
        What a reading is. Headings may jump by whole turns; of a speed the relay sees the integral.
    excursion : float, optional
        The coordinate may be this far from the reference; by default a quarter turn of a heading, else five half-widths.
    reference : float
        Value of the coordinate to oscillate about.
    neutral : float
        Command before, after, and upon a fault; the relay's levels lie about it, or about ``offset`` from it.
    offset : float
        Middle of the relay's levels less the neutral command; of a heater, off or full on, the relay level. A disturbance of
        :meth:`Outcome.axis` is counted from the middle.
    lowest, highest : float, optional
        Least and largest command ever given; by default neutral, or two relay levels from the middle.
    wrong_way : float, optional
        Way back under the first command that counts as the wrong sign; by default two half-widths.
    dwell : float, optional
        Least time between two switchings, s; by default four intervals.
    resolution : float
        Step of the sensor, or a few standard deviations of its noise.
    largest_rate : float, optional
        Largest rate of the reading that the vehicle is capable of, per s; by default the excursion in a second.
    unchanged, patience, duration : float, optional
        A reading unchanged, an attempt without a switching, and the experiment may last so long, s; by default 5, 20 and 300.
    cycles, most_cycles, attempts : int, optional
        Cycles in a row that have to be alike, cycles of an attempt, and attempts; by default 3, 12 and 3.
    spread : float, optional
        How alike, as a share of amplitude and half-period; by default 0.1.
    factor : float, optional
        Between the relay parameters of two attempts; by default 1.5.

    Raises
    ------
    OutOfDomain
        For a number outside its domain.

    Examples
    --------
    >>> from selfosc import Protocol
    >>> Protocol(coordinate="heading-rad", relay=0.02, half_width=0.2, interval=0.1).relay
    0.02
    """

    relay: float
    half_width: float
    interval: float
    coordinate: Coordinate = "position"
    excursion: float | None = None
    reference: float = 0.0
    neutral: float = 0.0
    offset: float = 0.0
    lowest: float | None = None
    highest: float | None = None
    wrong_way: float | None = None
    dwell: float | None = None
    resolution: float = 0.0
    largest_rate: float | None = None
    unchanged: float | None = None
    patience: float | None = None
    duration: float | None = None
    cycles: int | None = None
    spread: float | None = None
    most_cycles: int | None = None
    attempts: int | None = None
    factor: float | None = None

    def __post_init__(self) -> None:
        _arguments.choice(self.coordinate, "coordinate", Coordinate)
        self._begun()

    def _begun(self) -> _core.Experiment:
        options = asdict(self)
        counts = {name: options.pop(name) for name in ("cycles", "most_cycles", "attempts")}
        whole = [f"--{name.replace('_', '-')}={_arguments.whole(count, name)}" for name, count in counts.items() if count is not None]
        return _core.Experiment(_documents.flags(**options) + whole)


class Step(NamedTuple):
    """The answer to a reading."""

    #: The command to give now.
    command: float
    #: ``running``, ``done``, ``aborted``, or ``failed:`` with the fault's code.
    phase: str


class Outcome(Result):
    """Means and spreads of the steady cycles of a finished experiment, and the relay that made them."""

    features: types.SteadyCycles
    relay_level: float
    half_width: float
    attempts: int

    def axis(self, drag: Literal["linear", "quadratic"] = "linear", delay: float = 0.0) -> types.ExactAxis:
        """The axis whose exact limit cycle has these features, in the units of reading and command.

        Parameters
        ----------
        drag : {"linear", "quadratic"}
            What the drag is; two features cannot tell.
        delay : float
            Of the whole loop, s. A command that is held for an interval adds half of it.
        """
        law = _arguments.choice(drag, "drag", Literal["linear", "quadratic"])
        found = _core.axis_of_outcome(json.dumps(self.to_dict()), law, _arguments.number(delay, "delay"))
        answer: types.ExactAxis = json.loads(found)
        return answer


@_arguments.constructed
class Experiment(Suggesting):
    """A relay experiment that runs sample by sample: the state machine of ``selfosc run`` and of the C library, bit for bit.

    Any readings and times may come. What a sound sensor and clock cannot have said, ``None`` and texts included, is a fault,
    upon which, as after the end and after :meth:`abort`, the command is neutral until :meth:`restart`.

    Examples
    --------
    >>> from selfosc import Experiment, Protocol
    >>> experiment = Experiment(Protocol(coordinate="heading-rad", relay=0.02, half_width=0.2, interval=0.1))
    >>> experiment.step(0.0, 0.0)
    Step(command=0.02, phase='running')
    >>> experiment.step(None, 0.1)
    Step(command=0.0, phase='failed:not-finite')
    """

    def __init__(self, protocol: Protocol) -> None:
        if not isinstance(protocol, Protocol):
            raise UsageError(f"protocol is {_arguments.shown(protocol)}: must be a Protocol; give one")
        self.protocol = protocol
        self._core = protocol._begun()

    @_arguments.named
    def step(self, reading: float | None, time_s: float) -> Step:
        """Takes a reading and its time in s; the command to give now."""
        return Step(*self._core.step(_reading(reading), _reading(time_s)))

    @_arguments.named
    def tick(self, time_s: float) -> Step:
        """The command at a time without a reading, for a timer beside a driver that may block."""
        return Step(*self._core.tick(_reading(time_s)))

    def abort(self) -> None:
        """Stops a running experiment: the command is neutral from now on."""
        self._core.abort()

    def restart(self) -> None:
        """Begins anew with the next sample; the record begins anew, too."""
        self._core.restart()

    @property
    def command(self) -> float:
        """The command that holds now."""
        return self._core.command()

    @property
    def phase(self) -> str:
        """``running``, ``done``, ``aborted``, or ``failed:`` with the fault's code."""
        return self._core.phase()

    @property
    def fault(self) -> str | None:
        """What went wrong, with the remedy."""
        return self._core.fault()

    @property
    def position(self) -> float | None:
        """The coordinate that the relay sees: a heading without its jumps, the integral of a speed."""
        return self._core.position()

    @property
    def attempt(self) -> int:
        """The attempt under way, or the last one."""
        return self._core.attempt()

    def outcome(self) -> Outcome | None:
        """What was found, once the experiment is done."""
        found = self._core.outcome()
        return None if found is None else Outcome(json.loads(found))

    @property
    def record(self) -> dict[str, NDArray[np.float64]]:
        """The samples while the relay acted: times, coordinate and command, as ``selfosc run --log`` writes them."""
        coordinate, (time_s, position, command) = self._core.record()
        return {"time_s": time_s, coordinate: position, "input": command}

    def identify(self, **options: Any) -> Identification:
        """The vehicle from the record, by :func:`selfosc.identify` with these options."""
        return identify(self.record, neutral=self._core.neutral(), **options)

    def __repr__(self) -> str:
        return f"Experiment(phase={self.phase!r}, attempt={self.attempt}, samples={len(self.record['time_s'])})"


class ControlStep(NamedTuple):
    """What a step of a controller gives."""

    #: The command, within the limits, a number in any case.
    command: float
    #: Whether a limit holds the command back.
    limited: bool
    #: The input that is no number and holds the command: ``reference``, ``measurement``, ``interval``; or ``overflow``.
    fault: str | None


@_arguments.constructed
class Controller(Suggesting):
    """A controller with its memory: the one that the library and its C form run, bit for bit.

    Parameters
    ----------
    gains : Tuned or Gains
        What :func:`selfosc.tune` found, or its ``gains``.
    limits : (float, float), optional
        Least and largest command. An integral that drives the command past them is led back.
    turn : float, optional
        After how much the coordinate begins again: ``2 pi`` for a heading in radians. Errors take the short way.
    hold : float, optional
        Without a good step for longer, s, the command is ``neutral``.
    neutral : float
        That command.
    axis : mapping, optional
        ``alpha``, ``beta``, ``beta_quadratic``, ``delta``, ``delay_s`` of the axis, as :meth:`Outcome.axis` gives them: the
        reference is then guided at ``pace`` (rad/s) and ``top_speed``, and the force that takes is fed forward.

    Raises
    ------
    OutOfDomain
        For a number outside its domain.

    Examples
    --------
    >>> import math, selfosc
    >>> tuned = selfosc.tune(alpha=0.033, beta=0.01, beta_quadratic=0.06, delay=0.2, bandwidth=0.8)
    >>> heading = selfosc.Controller(tuned, limits=(-0.2, 0.2), turn=math.tau)
    >>> heading.step(reference=3.1, measurement=-3.1, dt_s=0.1).command < 0.0  # the short way
    True
    >>> heading.step(3.1, float("nan"), 0.1).fault
    'measurement'
    """

    def __init__(
        self,
        gains: Tuned | types.Gains,
        *,
        limits: tuple[float, float] | None = None,
        turn: float | None = None,
        hold: float | None = None,
        neutral: float = 0.0,
        axis: Mapping[str, Any] | None = None,
        pace: float | None = None,
        top_speed: float | None = None,
    ) -> None:
        number = _arguments.number
        if isinstance(gains, Tuned):
            gains = gains.gains
        parts = ("proportional", "integral", "derivative", "filter_s")
        if not isinstance(gains, Mapping):
            raise UsageError(f"gains is {_arguments.shown(gains)}: must be a result of selfosc.tune() or its gains; give one")
        given = _arguments.mapping(gains, "gains", ("structure", *parts))
        wanted = {name: _arguments.finite(given.get(name), name) for name in parts}
        wanted |= {"structure": _arguments.choice(given.get("structure"), "structure", Structure)}
        if (axis is None) != (pace is None):
            raise UsageError("axis and pace guide the reference together; give both or neither")
        guide = None
        if axis is not None:
            names = ("alpha", "beta", "beta_quadratic", "delta", "delay_s")
            axis = _arguments.mapping(axis, "axis", (*names, "drag"))
            guide = [number(axis.get(name, 0.0), name) for name in names], number(pace, "pace"), _arguments.optional(number, top_speed, "top_speed")
        self._core = _core.Controller(
            json.dumps(wanted),
            _arguments.optional(_arguments.pair, limits, "limits"),
            _arguments.optional(number, turn, "turn"),
            None if hold is None else (number(hold, "hold"), number(neutral, "neutral")),
            guide,
        )

    @_arguments.named
    def step(self, reference: float, measurement: float | None, dt_s: float) -> ControlStep:
        """The next command, given the time since the step before, s. What is no number holds the command."""
        return ControlStep(*self._core.step(_reading(reference), _reading(measurement), _reading(dt_s)))

    def reset(self) -> None:
        """Forgets everything but the settings."""
        self._core.reset()


def _reading(value: Any) -> float:
    """A number, or NaN for what is none: a driver that says nothing must not end a control loop by an exception."""
    try:
        return _arguments.number(value, "reading")
    except UsageError:
        return float("nan")
