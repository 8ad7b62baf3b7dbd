"""A vehicle's inertia, drag, disturbance and delay from logs."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np

from . import _arguments, _core, _documents, _tables, types
from ._results import Result, _flat, finished, measured
from .errors import OutOfDomain, UsageError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Bounds", "Identification", "bounded", "identify"]


class Identification(Result):
    """One vehicle identified.

    ``reported`` is the one answer to use: ``reported["alpha"]`` is a dictionary with ``value``, ``std``, ``low`` and ``high``
    (95 %, right if the model is exact) and ``combined``, the practical interval, and ``reported["trust"]`` says whether to use it. Numbers are in SI units, angles in radians.

    An identification pickles whole: what comes back is equal, and plots and reports as before. Its logs are then known by
    their names, so that no report replaces the file that has the name of one.
    """

    record: types.AllRecords
    features: types.Features | None
    reported: types.Reported | None
    estimates: list[types.MethodEstimate]
    bounded: types.GuaranteedBounds | None
    refused_methods: list[types.RefusedMethod]
    choice: types.DragChoice
    warnings: list[types.Note]
    records: list[types.RecordSummary]
    validation: list[types.Validated]
    units: types.Units
    version: str

    def __init__(self, core: _core.Identification) -> None:
        super().__init__(json.loads(core.document()))
        self._core = core

    def __reduce__(self) -> tuple[Callable[[str], Identification], tuple[str]]:
        return _arrived, (self._core.travelling(),)

    @cached_property
    def details(self) -> dict[str, Any]:
        """Everything found, with the records, the fitted outputs and the residuals. Its fields promise nothing."""
        return json.loads(self._core.full())

    @property
    def trust(self) -> types.Trust | None:
        """Whether to use ``reported``: ``"good"``, ``"widened"``, ``"doubtful"``; ``None`` without it."""
        return None if self.reported is None else self.reported["trust"]

    def _rows(self) -> list[dict[str, Any]]:
        answer = self.to_dict().get("reported")
        rows = [{"method": "reported", **_flat(answer)}] if answer else []
        return rows + [_flat(estimate) for estimate in self.to_dict()["estimates"]]

    def _title(self) -> str:
        first, *_ = self.records
        record = f"{first['file']}: " if len(self.records) == 1 else f"{len(self.records)} records: "
        if self.reported is None:
            return f"{record}no model reported"
        reasons = "".join(f", {note['code']}" for note in self.reported["reasons"])
        return f"{record}trust {self.reported['trust']}{reasons}; {self.reported['drag']} drag"

    def _table(self) -> list[list[str]]:
        """The reported parameters with the farther ends of their practical 95 % intervals."""
        if self.reported is None:
            return super()._table()
        units = _units(self.units)
        table = [["parameter", "practical, 95 %", "unit"]]
        for name, part in self.reported.items():
            if isinstance(part, dict) and part.get("value") is not None:
                spread = part.get("combined") or part
                value = part["value"]
                farther = None if spread["low"] is None else max(value - spread["low"], spread["high"] - value)
                table.append([name, measured(value, farther), units.get(name, "")])
        return table

    @_arguments.named
    def report(self, path: str | os.PathLike[str]) -> Path:
        """Writes one HTML file with tables and figures, which needs no network.

        Parameters
        ----------
        path : path-like
            Of the file, which is written whole or not at all. One of the logs, or one that standard output goes to, is refused.

        Returns
        -------
        Path
        """
        place = _arguments.path(path)
        self._core.report(place)
        return Path(place)

    def plot(self) -> Figure:
        """Record, model, residuals and intervals of every record, as one matplotlib figure.

        The model drawn is that of the fit with the likeliest drag law, beside the record that it was fitted to; the intervals
        are those of ``reported``.
        """
        from matplotlib import pyplot

        logs = [source["log"]["record"] for source in self.details["sources"]]
        fitted = _fitted(self.details, len(logs))
        unit = self.units["output"]
        in_unit = "" if unit == "output" else f" ({unit})"
        figure = pyplot.figure(figsize=(9.0, 3.6 * len(logs) + 2.2), layout="constrained")
        *records, values = figure.subfigures(len(logs) + 1, 1, height_ratios=[3.6] * len(logs) + [2.2], squeeze=False).flat
        for place, (part, log, fit) in enumerate(zip(records, logs, fitted, strict=True)):
            above, below = part.subplots(2, 1, sharex=True, height_ratios=[2.2, 1.0])
            time = np.asarray(log["time_s"])
            above.plot(time, log["output"], ".", markersize=3, color="0.45", label="record")
            above.set_title(self.details["sources"][place]["name"], fontsize="medium")
            above.set_ylabel(f"output{in_unit}")
            if fit is not None:
                first, output, residuals = fit
                inside = time[first : first + len(output)]
                above.plot(inside, output, linewidth=1.0, color="C0", label="model")
                below.plot(inside, residuals, linewidth=0.8, color="C3")
            command = above.twinx()
            command.step(time, log["input"], where="post", linewidth=0.8, color="C1", alpha=0.6, label="command")
            command.set_ylabel("command (as logged)")
            above.legend(loc="upper right", fontsize="small")
            below.set_ylabel(f"residual{in_unit}")
            below.set_xlabel("time (s)")
        self._plot_intervals(values)
        return finished(figure)

    def _plot_intervals(self, figure: Any) -> None:
        """Each parameter's statistical interval, thick, in its practical one, on an axis in its unit."""
        answer = self.to_dict().get("reported") or {}
        named = {name: part for name, part in answer.items() if isinstance(part, dict) and part.get("low") is not None}
        units = _units(self.units)
        columns = 4
        for place, (name, part) in enumerate(named.items(), 1):
            panel = figure.add_subplot(math.ceil(len(named) / columns), columns, place)
            for interval, width in ((part.get("combined") or part, 1.0), (part, 4.0)):
                panel.plot([interval["low"], interval["high"]], [0.0, 0.0], color="C0", linewidth=width)
            panel.plot(part["value"], 0.0, "o", color="C0")
            panel.set(xlabel=f"{name}\n({units[name]})" if name in units else name, yticks=[])
            panel.locator_params(axis="x", nbins=4)


def _units(units: types.Units) -> dict[str, str]:
    """The unit of each reported parameter, in the output's own."""
    known = {name: str(unit).replace("output", units["output"]) for name, unit in units.items()}
    times = dict.fromkeys(("delay_s", "lag_s", "ramp_s", "pause_s", "filter_s", "memory_s"), "s")
    return known | times | {"coulomb": known["delta"], "memory": known["beta"]}


def _arrived(text: str) -> Identification:
    return Identification(_core.Identification.arrived(text))


def _fitted(details: dict[str, Any], records: int) -> list[tuple[int, list[float], list[float]] | None]:
    """First sample, model and residuals of every record under the likeliest law; ``None`` without a fit."""
    fits = details.get("fits")
    if not fits:
        return [None] * records
    likeliest, _ = max(zip(fits["fits"], fits["probabilities"], strict=True), key=lambda one: one[1])
    return [(one["first_sample"], one["output"], one["residuals"]) for one in likeliest["records"]]


AnyPath = str | bytes | os.PathLike[str] | os.PathLike[bytes]
Method = Literal["all", "fit", "exact", "iso", "bounded"]
TimeUnit = Literal["h", "min", "s", "ms", "us", "ns"]
BoundedQuantity = Literal["alpha", "beta", "beta_quadratic", "beta_cubic", "stiffness", "lag_s", "delay_s"]
Switching = Literal["at-samples", "anywhere"]


@_arguments.named
def identify(
    source: Any,
    *,
    time: str | None = None,
    output: str | None = None,
    input: str | None = None,
    degrees: bool = False,
    wrap: bool = False,
    relay: float | None = None,
    half_width: float | None = None,
    delay: float | Literal["estimate"] | None = None,
    drag: Literal["auto"] | types.Drag = "auto",
    method: Method = "all",
    any_input: bool = False,
    assume: Mapping[str, float] | Literal["none"] | None = None,
    error: float = 0.0,
    quantum: float | None = None,
    jitter_s: float = 0.0,
    outliers: int = 0,
    budget: int | None = None,
    stiffness: bool = False,
    lag: bool = False,
    cubic: bool = False,
    either_sign: bool = False,
    radians: bool = False,
    time_unit: TimeUnit | None = None,
    neutral: float | None = None,
    invert: bool = False,
    from_s: float | None = None,
    to_s: float | None = None,
    part: int | None = None,
    even_stamps: bool = False,
    skip_bad_rows: bool = False,
    hold_command: bool = False,
    validate: AnyPath | Iterable[AnyPath] = (),
    progress: bool | Callable[[str], object] = False,
) -> Identification:
    """A vehicle's inertia, drag, disturbance and delay from records of relay experiments, with 95 % intervals.

    The model is ``alpha x'' + (beta + beta_quadratic |x'|) x' = u(t - delay) + delta``, with further terms where the record
    has them. Several records of one vehicle are fitted jointly.

    Parameters
    ----------
    source : path, pandas.DataFrame, polars.DataFrame, pyarrow.Table, mapping, or a sequence of these
        Delimiter-separated text with a header, a Parquet or Arrow file, or a table with three columns of numbers.
    time, output, input : str, optional
        Names of the columns: time in s, the measured output, the command. By default the first of the usual names.
    degrees, wrap : bool
        The output is in degrees (a name ending in ``_deg`` always is); it is an angle that jumps by a turn (heading and yaw
        always are).
    relay, half_width : float, optional
        Level of the relay, command units, and level at which it switches, output units (radians where the output is in
        degrees), if not to be read off the record.
    delay : float or "estimate", optional
        Of the whole loop, s; by default as the command's.
    drag : {"auto", "linear", "quadratic", "mixed"}
    method : {"all", "fit", "exact", "iso", "bounded"}
        ``bounded`` takes every reading for a constraint; its answer is in ``bounded``. ``all`` leaves it out.
    any_input : bool
        Take a record of any manoeuvre: the answer is ``doubtful``, or ``widened`` where the command moves the vehicle through two
        cycles.
    assume : mapping, or "none"
        Sizes of sources of error that no residual shows, for the practical intervals: ``sensor-gain`` and ``clock`` in percent,
        ``heading-error`` in degrees, ``thrust-dynamics`` in percent. A source left out has its usual size; ``"none"`` is no source.
    error, quantum : float, optional
        For the bounds: largest error of a reading beside half a step, and step of the sensor, output units.
    jitter_s : float
        For the bounds: largest error of a stamp, s.
    outliers : int
        For the bounds: readings, of all records together, that may be in error by any amount.
    budget : int, optional
        For the bounds: work that may be spent, in passes over the records. The less, the wider the bounds; they hold.
    stiffness, lag, cubic, either_sign : bool
        For the bounds: the model has a restoring force, a lag of the force, cubic drag, linear drag that may drive.
    radians : bool
        The output is in radians, whatever it looks like.
    time_unit : {"h", "min", "s", "ms", "us", "ns"}, optional
        Of the times; by default what the column's name ends in, else s.
    neutral : float, optional
        The command that does nothing, as logged; it is taken off.
    invert : bool
        The command is logged with the opposite sign.
    from_s, to_s : float, optional
        Only samples from and up to these times, s on the log's clock.
    part : int, optional
        The part to use of a log whose clock starts again, counted from 1.
    even_stamps : bool
        The samples were taken at even intervals, whatever their stamps: those are of arrival.
    skip_bad_rows : bool
        Leaves out rows without three numbers, or with a time that does not come after the one before: at most a fifth of all.
    hold_command : bool
        For topics logged in turn: a command that is missing holds, from the output before it on; rows without output are passed over.
    validate : path, or sequence of paths
        Text logs that are predicted and take no part in the estimate.
    progress : bool or callable
        Called with what comes next; ``True`` shows it with tqdm where that is installed.
    Returns
    -------
    Identification
        The document of ``selfosc identify --json``, bit for bit, with :meth:`~Identification.plot`,
        :meth:`~Identification.to_frame` and :meth:`~Identification.report`.

    Raises
    ------
    RecordRefused
        For a record that cannot be used; ``code`` says why.
    SelfoscError
        For settings that contradict each other or are out of their domain, and for an argument that there is not.

    Notes
    -----
    The call can be interrupted. What was begun then runs on to its next stage and is dropped. A process that forks may call
    it before and after, and so may its children: each has threads of its own.

    A reading that is masked (``numpy.ma``), null or NA is none: the record is refused, or read without it on ``skip_bad_rows`` or ``hold_command``.

    Examples
    --------
    >>> from selfosc import identify, simulate
    >>> record = simulate(alpha=1, beta_quadratic=0.5, relay=1, half_width=0.3, cycles=8, noise=0.003, hold=True)
    >>> found = identify(record, method="fit")
    >>> abs(found.reported["alpha"]["value"] - 1.0) < 0.02
    True
    """
    if degrees is True and radians is True:
        raise UsageError("degrees and radians are both True: the output must be in one of them; leave one out")
    whole, optional, switch, texts = _arguments.whole, _arguments.optional, _arguments.switch, _arguments.text
    columns = {
        "time": optional(texts, time, "time"), "output": optional(texts, output, "output"), "input": optional(texts, input, "input"),
        "degrees": switch(degrees, "degrees"), "wrap": switch(wrap, "wrap"), "radians": switch(radians, "radians"),
        "time_unit": None if time_unit is None else _arguments.choice(time_unit, "time_unit", TimeUnit), "invert": switch(invert, "invert"),
        "neutral": _number(neutral, "neutral"), "from_s": _number(from_s, "from_s"), "to_s": _number(to_s, "to_s"),
        "part": None if part is None else whole(part, "part", 1), "even_stamps": switch(even_stamps, "even_stamps"),
        "skip_bad_rows": switch(skip_bad_rows, "skip_bad_rows"), "hold_command": switch(hold_command, "hold_command"),
    }  # fmt: skip
    wanted: dict[str, Any] = {
        "method": _arguments.choice(method, "method", Method), "relay_level": _number(relay, "relay"),
        "half_width": _number(half_width, "half_width"), "error": _arguments.finite(error, "error"),
        "quantum": _number(quantum, "quantum"), "jitter_s": _arguments.finite(jitter_s, "jitter_s"),
        "outliers": whole(outliers, "outliers"), "budget": None if budget is None else whole(budget, "budget", 1),
        "stiffness": switch(stiffness, "stiffness"), "lag": switch(lag, "lag"), "cubic": switch(cubic, "cubic"),
        "either_sign": switch(either_sign, "either_sign"), "any_input": switch(any_input, "any_input"),
    }  # fmt: skip
    if assume is not None:
        wanted["assume"] = _assumptions(assume)
    if not (isinstance(drag, str) and drag == "auto"):
        wanted["drag"] = _arguments.choice(drag, "drag", types.Drag)
    if delay is not None:
        wanted["delay"] = "estimated" if isinstance(delay, str) and delay == "estimate" else {"known_s": _delay(delay)}
    logs = _tables.sources(source, columns)
    validation = [_arguments.path(one, "validate") for one in _arguments.several(validate, (str, bytes, os.PathLike, Mapping))]
    settings = _documents.json_of(wanted), _documents.json_of(columns)
    with _Shown(progress) as shown:
        core = _core.identify(logs, validation, *settings, shown)
    return Identification(core)


def _of_record(quantity: types.Quantity) -> str:
    """A quantity's name with the number of its record, from 1."""
    return quantity if isinstance(quantity, str) else " ".join(f"{name}, record {index + 1}" for name, index in quantity.items())


class Bounds(Result):
    """What records leave of a model's parameters: ``verdict``, ``bounds``, ``witness`` and what was assumed."""

    verdict: types.Consistency
    search_box: list[types.QuantityRange]
    bounds: list[types.QuantityRange]
    witness: types.Point | None
    nearest: types.Point | None
    error: list[float]
    error_factor: list[float]
    contradicting: list[types.Contradicting]
    outliers: list[types.Outlier]
    passes: int

    def _rows(self) -> list[dict[str, Any]]:
        rows = [{**one, "quantity": _of_record(one["quantity"])} for one in self.to_dict()["bounds"]]
        return rows or [{"verdict": self.to_dict()["verdict"]}]

    def of(self, quantity: types.Quantity) -> tuple[float, float] | None:
        """The interval of ``"alpha"``, ``"beta"``, ``"delay_s"``, ..., or of the first record's ``{"delta": 0}``; ``None`` where
        there is none."""
        if not isinstance(quantity, dict):
            _arguments.choice(quantity, "quantity", BoundedQuantity)
        found = next((one for one in self.bounds if one["quantity"] == quantity), None)
        return found and (found["low"], found["high"])


@_arguments.named
def bounded(
    source: Any,
    *,
    drag: types.Drag = "linear",
    delay: float | tuple[float, float] | None = None,
    time: str | None = None,
    output: str | None = None,
    input: str | None = None,
    degrees: bool = False,
    wrap: bool = False,
    error: float | None = None,
    quantum: float | None = None,
    switching: Switching | None = None,
    outliers: int | None = None,
    jitter_s: float | None = None,
    stiffness: bool | None = None,
    lag: bool | None = None,
    cubic: bool | None = None,
    either_sign: bool | None = None,
    reach: float | None = None,
    budget: int | None = None,
) -> Bounds:
    """Encloses the parameters with which a model meets every reading, or proves that there are none in the search box.

    Parameters
    ----------
    source, time, output, input, degrees, wrap
        As for :func:`identify`.
    drag : {"linear", "quadratic", "mixed"}
    delay : float or (float, float), optional
        Known, or between two numbers, s; by default nothing is known but that it is shorter than the mean time between
        switchings.
    error, quantum : float, optional
        Largest error of a reading beside half a step, by default 0, and step of the sensor, by default read off the record;
        output units.
    switching : {"at-samples", "anywhere"}, optional
        When the command changed; by default at samples.
    outliers : int, optional
        So many readings may be in error by any amount, by default none; the result's own ``outliers`` are those that must be.
    jitter_s : float, optional
        Largest error of a stamp, s; by default 0.
    stiffness, lag, cubic, either_sign : bool, optional
        The model has a restoring force, a lag of the force, cubic drag, linear drag that may drive; by default none.
    reach : float, optional
        Factor by which inertia is looked for on either side of its order of magnitude, by default 100.
    budget : int, optional
        Work that may be spent, in passes over the records, by default 3000. The less, the wider the bounds; they hold.

    Returns
    -------
    Bounds
        Guaranteed under what is assumed, and within the search box only.

    Raises
    ------
    SelfoscError
        For a record without switchings, a sensor without an error, and settings out of their domain.

    Examples
    --------
    >>> from selfosc import bounded, simulate
    >>> record = simulate(alpha=1, beta=0.5, relay=1, half_width=0.3, cycles=4, hold=True, quantum=0.02)
    >>> low, high = bounded(record, delay=0.0, budget=200).of("alpha")
    >>> low <= 1.0 <= high
    True
    """
    names = {"time": time, "output": output, "input": input}
    columns: dict[str, Any] = {name: _arguments.optional(_arguments.text, value, name) for name, value in names.items()}
    columns |= {"degrees": _arguments.switch(degrees, "degrees"), "wrap": _arguments.switch(wrap, "wrap")}
    numbers = {"error": error, "quantum": quantum, "jitter_s": jitter_s, "reach": reach}
    least = {"outliers": (outliers, 0), "budget": (budget, 1)}
    terms = {"stiffness": stiffness, "lag": lag, "cubic": cubic, "either_sign": either_sign}
    wanted: dict[str, Any] = {"law": _arguments.choice(drag, "drag", types.Drag)}
    wanted["switching"] = None if switching is None else _arguments.choice(switching, "switching", Switching)
    wanted |= {name: _number(value, name) for name, value in numbers.items()}
    wanted |= {name: None if value is None else _arguments.whole(value, name, start) for name, (value, start) in least.items()}
    wanted |= {name: _arguments.optional(_arguments.switch, value, name) for name, value in terms.items()}
    if isinstance(delay, (tuple, list)):
        shortest, longest = (_delay(end) for end in _arguments.pair(delay, "delay"))
        if shortest > longest:
            raise UsageError(f"delay is {_arguments.shown(delay)}: must be two numbers, the shorter first; swap them")
        wanted["delay"] = {"within-s": [shortest, longest]}
    elif delay is not None:
        wanted["delay"] = {"known-s": _delay(delay)}
    given = {name: value for name, value in wanted.items() if value is not None}
    logs = _tables.sources(source, columns)
    return Bounds(json.loads(_core.bounds(logs, _documents.json_of(columns), _documents.json_of(given))))


def _delay(value: Any) -> float:
    delay = _arguments.number(value, "delay")
    if math.isfinite(delay) and delay >= 0.0:
        return delay
    limit, remedy = "a finite number, 0 or more", 'give the loop\'s delay, or "estimate"'
    raise OutOfDomain(f"delay is {delay} (s): must be {limit}; {remedy}", "out-of-domain", "delay", delay, "s", limit, remedy)


def _assumptions(value: Mapping[str, float] | Literal["none"]) -> dict[str, float]:
    """Sizes of the sources of error; a source left out has its usual size."""
    sources = get_args(types.ErrorSource)
    if isinstance(value, str) and value == "none":
        return dict.fromkeys(sources, 0.0)
    if not isinstance(value, Mapping):
        raise UsageError(f'assume is {_arguments.shown(value)}: must be a mapping or "none"; give sizes of {", ".join(sources)}')
    return {_arguments.choice(name, "assume", types.ErrorSource): _arguments.finite(size, f"assume[{name}]") for name, size in value.items()}


def _number(value: Any, name: str) -> float | None:
    return _arguments.optional(_arguments.finite, value, name)


class _Shown:
    """What hears of the stages: nobody, a function of the user's, or tqdm."""

    def __init__(self, progress: bool | Callable[[str], object]) -> None:
        self._progress = progress
        self._bar: Any = None

    def __enter__(self) -> Callable[[str], object] | None:
        if callable(self._progress):
            return self._progress
        if not _arguments.switch(self._progress, "progress"):
            return None
        try:
            from tqdm.auto import tqdm
        except ImportError:
            return None
        bar = self._bar = tqdm(bar_format="{desc} {elapsed}")
        return bar.set_description_str

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()
