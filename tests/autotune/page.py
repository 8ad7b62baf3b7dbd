"""The page `spec/autotune.md` from the lines of `measure.py`."""

from __future__ import annotations

import numpy as np
import simulator

HEAD = """# Gains from a relay record, measured

`tests/autotune/measure.py` makes this page. Its simulator is exact between events and shares no code with the library; seeds from {first} to
{last} were not looked at before the run. Relay from 0 to 1, 20 to 200 readings a period, noise 2 to 15 % and steps up to 25 % of the
half-swing, load 25 to 75 % of the command, normalised dead time 0.05 to 0.95. Inside the structures of `autotune`: first order, second order,
equal lags, second order with a zero, integrator, integrator with lag. Outside: four equal lags, and eight lags `T/k^2` of a diffusion.
Conditions: warm 3.5 periods; short 1.75 periods; cold, from the first command on; wandering, a load of standard deviation 5 % of the command.
"""
HEATERS = """
## Two heaters of printers

Published processes: gain, time constant and dead time of an E3D V6 hotend (340 degrees at full power, 140 s, 5.5 s) and of a PCB bed (90 degrees,
700 s, 10 s), from RepRapFirmware's `Configuration.h`. Targets are 200 and 60 degrees in a room of 25. The relay's thresholds are 5 degrees
apart, as in Klipper's `PID_CALIBRATE`, 2.5 on either side of the target; readings every 0.3 s with 0.05 degrees of noise, three periods.
Gains are in Klipper's 255ths of full power; every rule's derivative is filtered by a tenth of its time, Klipper's own filter is not modelled. `tests/autotune/heaters.py` makes the table.

"""

LIMITS = """
## What the figures do not show

- The processes are linear. A heater with radiation or a fan that switches is none of them.
- The loop is judged with half the record's interval as the hold of its command; a slower controller needs `--interval`.
- The optimum is found by a search of Nelder and Mead from two starts: a ratio below 1 is its shortfall.
- `AMIGO after Berner` is told the equilibrium of load and output, which no record shows.
- Gains are those for every process of the confidence set: where that is wide, the error is larger than the optimum of the known process.
- The load of the fit walks at random; that of the records returns to its mean within twenty dead times.
- Outside the structures of `autotune` the intervals of the gain are those of the nearest structure: half of them miss. Ultimate gain and
  frequency, on which stability rests, have wider ones, over the corners of all intervals.
"""


def percent(share: list[bool]) -> str:
    return f"{100.0 * np.mean(share):.1f}" if share else "-"


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def _sides(lines: list[dict], of) -> str:
    """Inside / outside."""
    inside = [line for line in lines if line["kind"] in simulator.INSIDE]
    outside = [line for line in lines if line["kind"] not in simulator.INSIDE]
    return f"{of(inside)} / {of(outside)}"


def _rule(lines: list[dict], name: str) -> list[str]:
    answers = lambda some: [line["rules"][name] for line in some if line["rules"].get(name)]  # noqa: E731
    share = lambda test: _sides(lines, lambda some: percent([test(one) for one in answers(some)]))  # noqa: E731
    above = lambda limit: share(lambda one: one["peak"] is None or one["peak"] > limit)  # noqa: E731
    errors = lambda some: [one["error"] for one in answers(some) if one["error"] is not None]  # noqa: E731
    median = _sides(lines, lambda some: f"{np.median(errors(some)):.2f}" if errors(some) else "-")
    return [name, str(len(answers(lines))), share(lambda one: one["peak"] is None), above(1.45), above(2.0), median]


def _missed(lines: list[dict], quantity: str) -> list[str]:
    seen = lambda some: [not line["intervals"][quantity] for line in some if line["intervals"].get(quantity) is not None]  # noqa: E731
    return [quantity, str(len(seen(lines))), _sides(lines, lambda some: percent(seen(some)))]


def _condition(lines: list[dict], condition: str) -> list[str]:
    some = [line for line in lines if line["condition"] == condition]
    own = [line["rules"]["selfosc autotune"] for line in some]
    tuned = [one for one in own if one]
    trusted = lambda line: line["trust"] in ("good", "widened")  # noqa: E731
    right = [bool(one and one["peak"] and one["peak"] <= 1.45 and trusted(line)) for line, one in zip(some, own, strict=True)]
    missed = [not held for line in some for held in line["intervals"].values() if held is not None]
    errors = [one["error"] for one in tuned if one["error"] is not None]
    return [
        condition, str(len(some)), percent([one is None for one in own]), percent(right),
        percent([one["peak"] is None or one["peak"] > 1.45 for one in tuned]), percent(missed),
        f"{np.median(errors):.2f}" if errors else "-",
    ]  # fmt: skip


def of(lines: list[dict], heaters: str) -> str:
    names = dict.fromkeys(name for line in lines for name in line["rules"])
    quantities = dict.fromkeys(name for line in lines for name in line["intervals"])
    seconds = [line["seconds"] for line in lines]
    pooled = lambda some: percent([not held for line in some for held in line["intervals"].values() if held is not None])  # noqa: E731
    peaks = [one["peak"] for line in lines if (one := line["rules"]["selfosc autotune"])]
    largest = max((peak for peak in peaks if peak is not None), default=float("nan"))
    parts = [
        HEAD.format(first=lines[0]["seed"], last=lines[-1]["seed"]),
        f"{len(lines)} records. The limit asked for is 1.4; the largest sensitivity of any true process under the gains is {largest:.3f}.\n"
        f"One record takes {np.median(seconds):.2f} s of processor in the median, {np.quantile(seconds, 0.9):.2f} s in nine of ten.\n",
        "## Rules on the same record\n\nPercent of the answers, inside / outside; the integral of the absolute error after a step of the load\n"
        "is over the optimum of the known process at 1.4, in the median of the stable loops.\n",
        table(["rule", "answers", "unstable", "Ms > 1.45", "Ms > 2", "error over optimum"], [_rule(lines, name) for name in names]),
        "\n## By condition\n\nRight: trusted, and the true process keeps 1.45.\n",
        table(
            ["condition", "records", "no gains %", "right and trusted %", "Ms > 1.45 %", "intervals miss %", "error over optimum"],
            [_condition(lines, condition) for condition in simulator.CONDITIONS],
        ),
        f"\n## 95 % intervals\n\nAll together miss {_sides(lines, pooled)} % (inside / outside).\n",
        table(["quantity", "intervals", "missed %"], [_missed(lines, quantity) for quantity in quantities]),
        HEATERS + heaters.rstrip(),
        LIMITS,
    ]
    return "\n".join(parts)
