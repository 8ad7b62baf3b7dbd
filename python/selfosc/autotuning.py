"""Any process with dead time, from one relay record to gains with a proved margin."""

from __future__ import annotations

import csv
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from . import _arguments, _documents, _tables, types
from ._results import Result, finished, measured
from .errors import RecordRefused, UsageError
from .identification import TimeUnit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Autotuned", "autotune"]

Form = Literal["parallel", "ideal", "series", "klipper", "marlin", "reprap", "esphome"]
Actions = Literal["best", "pi", "pid"]


class Autotuned(Result):
    """A process from a record, and gains whose largest sensitivity is proved for every process of the confidence set.

    ``gains`` are in parallel form; ``lines`` are those to type in the form asked for. Both are ``None`` where no gains keep the
    limit for every process that the record leaves: ``reasons`` say so.
    """

    trust: types.Trust
    reasons: list[types.Note]
    models: list[types.ProcessStructure]
    gain: types.StatisticalInterval | None
    dead_time_s: types.StatisticalInterval
    ultimate: types.Ultimate | None
    gains: types.ProcessGains | None
    lines: str | None
    sensitivity: types.SensitivityLimit
    rules: list[types.RuleOfThumb]
    curves: types.LoopCurves | None
    record: types.ProcessRecord
    version: str

    def _title(self) -> str:
        reasons = "".join(f", {note['code']}" for note in self.reasons)
        proved = self.sensitivity["proved_upper"]
        limit = "no gains" if proved is None else f"largest sensitivity at most {proved:.4g}, proved"
        return f"{self.record['name']}: trust {self.trust}{reasons}; {limit}"

    def _table(self) -> list[list[str]]:
        """Gains, and the likeliest process with half its 95 % intervals' widths."""
        gains = self.gains
        rows = [] if gains is None else [
            ["proportional", f"{gains['proportional']:.5g}"],
            ["integral", f"{gains['integral']:.5g}"],
            ["derivative", f"{gains['derivative']:.5g}"],
            ["filter_s", f"{gains['filter_s']:.5g}"],
        ]  # fmt: skip
        rows += [[rule["name"], _sensitivity(rule["sensitivity"])] for rule in self.rules]
        process = self.models[0]
        rows += [[name, measured(part["value"], 1.96 * part["std"])] for name, part in process["parameters"].items()]
        return [["", process["family"]], *rows]

    def plot(self) -> Figure:
        """The open loop with the circle about -1 that it does not enter, and the answer to a load, for every process of the confidence set."""
        from matplotlib import pyplot

        curves, limit = self.curves, self.sensitivity["proved_upper"]
        if curves is None or limit is None:
            raise UsageError("gains is None: a plot needs proved gains; read reasons, or allow a larger ms", "no-gains")
        figure, (plane, answer) = pyplot.subplots(1, 2, figsize=(9.0, 4.0), layout="constrained")
        for points in curves["open_loops"]:
            plane.plot(*zip(*points, strict=True), linewidth=0.8, color="0.75")
        plane.plot(*zip(*curves["open_loop"], strict=True), color="C0", label="likeliest process")
        plane.add_patch(pyplot.Circle((-1.0, 0.0), 1.0 / limit, fill=False, linestyle="--", label=f"sensitivity {limit:.3g}"))
        plane.plot(-1.0, 0.0, "+", color="C3", label="critical point")
        plane.set(xlabel="real part", ylabel="imaginary part", xlim=(-3.0, 1.5), ylim=(-2.5, 2.0), aspect="equal")
        plane.legend(fontsize="small")
        _, output, command = self.record["columns"]
        answer.fill_between(curves["time_s"], *zip(*curves["load_step_range"], strict=True), color="0.85", label="all processes")
        answer.plot(curves["time_s"], curves["load_step"], color="C0", label="likeliest process")
        answer.set(xlabel="time (s)", ylabel=f"{output} after a step of one unit of {command}")
        answer.legend(fontsize="small")
        return finished(figure)


def _sensitivity(value: float | None) -> str:
    return "not stable" if value is None else f"sensitivity {value:.3g}"


@_arguments.named
def autotune(
    source: Any,
    *,
    ms: float = 1.4,
    actions: Actions = "best",
    form: Form = "parallel",
    full_power: float | None = None,
    derivative_filter: float = 10.0,
    interval: float | None = None,
    time: str | None = None,
    output: str | None = None,
    input: str | None = None,
    time_unit: TimeUnit | None = None,
    from_s: float | None = None,
    to_s: float | None = None,
    skip_bad_rows: bool = False,
    hold_command: bool = False,
) -> Autotuned:
    """PI or PID gains for a heater, a tank, an axis: from one record of its relay, thermostat or on-off control.

    Parameters
    ----------
    source : path, pandas.DataFrame, polars.DataFrame, pyarrow.Table or mapping
        As for :func:`selfosc.identify`, with two periods at least.
    ms : float
        Largest sensitivity ``1/abs(1 + L)`` of any process of the confidence set, from 1.1 to 3; 1.4 is well damped.
    actions : {"best", "pi", "pid"}
        ``best`` takes the derivative where it takes a tenth off the integral of the absolute error.
    form : {"parallel", "ideal", "series", "klipper", "marlin", "reprap", "esphome"}
        Of ``lines``.
    full_power : float, optional
        Command at full power, of which a firmware's gains are shares; by default 1, 100 or 255, where it is the largest in the log.
    derivative_filter : float
        Derivative time over the time constant of its filter.
    interval : float, optional
        Time between two commands of the controller, s; by default the record's.
    time, output, input : str, optional
        Names of the columns; by default the first of the usual names of controllers.
    time_unit : {"h", "min", "s", "ms", "us", "ns"}, optional
        Of the times; by default what the column's name ends in, else s.
    from_s, to_s : float, optional
        Only samples from and up to these times, s on the log's clock.
    skip_bad_rows : bool
        Leaves out rows without three numbers, at most a fifth of all.
    hold_command : bool
        For topics logged in turn: a command that is missing holds, from the output before it on; rows without output are passed over.

    Returns
    -------
    Autotuned
        The document of ``selfosc autotune --json``, bit for bit.

    Raises
    ------
    RecordRefused
        For a record that tells no process; ``code`` says why.
    SelfoscError
        For settings out of their domain.

    Examples
    --------
    >>> import math
    >>> from selfosc import autotune
    >>> time, temperature, heater, y = [], [], [], 0.0
    >>> for k in range(600):  # 2/(5 s + 1) after 1 s under a square wave of period 8 s
    ...     time.append(0.1 * k)
    ...     temperature.append(round(200.0 * y) / 200.0)
    ...     heater.append(float(k % 80 < 40))
    ...     late = 2.0 * ((k - 10) % 80 < 40)
    ...     y = late + (y - late) * math.exp(-0.1 / 5.0)
    >>> found = autotune({"time_s": time, "temperature": temperature, "heater": heater})
    >>> found.models[0]["family"], round(found.dead_time_s["value"], 1), found.sensitivity["proved_upper"]
    ('first-order', 1.0, 1.4)
    """
    names = {"time": time, "output": output, "input": input}
    columns = {name: _arguments.optional(_arguments.text, value, name) for name, value in names.items()} | {"process": True}
    sources = _tables.sources(source, columns)
    if len(sources) > 1:
        raise UsageError(f"there are {len(sources)} logs; give one")
    action = _arguments.choice(actions, "actions", Actions)
    flags = _documents.flags(
        ms=ms, pi=action == "pi", pid=action == "pid", form=_arguments.choice(form, "form", Form), derivative_filter=derivative_filter,
        interval=interval, full_power=full_power, to=to_s,
        time_unit=None if time_unit is None else _arguments.choice(time_unit, "time_unit", TimeUnit), skip_bad_rows=skip_bad_rows,
        hold_command=hold_command, **{"from": from_s},
    )  # fmt: skip
    flags += [f"--{name}={value}" for name, value in names.items() if value is not None]
    [log] = sources
    if isinstance(log, Path):
        return Autotuned(_documents.answer("autotune", *flags, "--", str(log))[1])
    name, labels, values = log
    sizes = [len(column) for column in values]
    if len(set(sizes)) > 1:
        text = "{}: {} times, {} outputs and {} inputs must be as many; give one of each for every sample"
        raise RecordRefused(text.format(name, *sizes), "unequal-columns")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "record.csv"
        with path.open("w", encoding="utf-8", newline="") as file:
            rows = csv.writer(file)
            rows.writerow(labels)
            rows.writerows([repr(float(value)) for value in row] for row in zip(*values, strict=True))
        try:
            document = _documents.answer("autotune", *flags, "--", str(path))[1]
        except RecordRefused as refused:
            raise RecordRefused(refused.text.replace(str(path), name), refused.code) from None
    document["record"]["name"] = name
    return Autotuned(document)
