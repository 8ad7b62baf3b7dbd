"""What every result has: its document, a table, a page."""

from __future__ import annotations

import html
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ._names import Suggesting

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

__all__ = ["Result"]


class Result(Suggesting):
    """A result with the command's JSON document behind it.

    Fields of the document are attributes: ``result.exact["amplitude"]`` is ``result.to_dict()["exact"]["amplitude"]``. Results
    of one kind are equal where their documents are; they pickle, and come back equal. Like dictionaries they have no hash.
    """

    def __init__(self, document: Mapping[str, Any]) -> None:
        self._document: dict[str, Any] = dict(document)

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return self._document == other._document

    __hash__ = None  # type: ignore[assignment]

    def to_dict(self) -> dict[str, Any]:
        """The document: the same fields and numbers, bit for bit, as the command's JSON."""
        return self._document

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            # Not while being unpickled, when there is no document yet.
            document = self.__dict__.get("_document", {})
            return document[name] if name in document else super().__getattr__(name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.__dict__.get("_document", {})]

    def _rows(self) -> list[dict[str, Any]]:
        """The rows of the table that says most."""
        return [_flat(self._document)]

    def to_frame(self) -> pd.DataFrame:
        """The result as a pandas frame, nested fields joined by dots."""
        import pandas as pd

        return pd.DataFrame(self._rows())

    def _title(self) -> str:
        """What stands above the table."""
        return type(self).__name__

    def _table(self) -> list[list[str]]:
        """A table for a person, names first: of one row its fields, of several their first columns."""
        rows = self._rows()
        if len(rows) == 1:
            return [["field", "value"], *([name, shown] for name, value in rows[0].items() if (shown := _short(value)))]
        names = [name for name in dict.fromkeys(name for row in rows for name in row) if any(_short(row.get(name)) for row in rows)]
        names = names[:_COLUMNS]
        return [names, *([_short(row.get(name)) for name in names] for row in rows)]

    def __repr__(self) -> str:
        head, *rows = self._table()
        shown = [[_cut(cell) for cell in row] for row in (head, *rows[:_ROWS])]
        widths = [max(len(row[column]) for row in shown) for column in range(len(head))]
        lines = ["  ".join(f"{cell:{width}}" for cell, width in zip(row, widths, strict=True)).rstrip() for row in shown]
        more = [f"and {len(rows) - _ROWS} more: to_frame() has all"] if len(rows) > _ROWS else []
        return "\n".join([self._title(), *lines, *more])

    def _repr_html_(self) -> str:
        names, *rows = self._table()
        line = lambda tag, cells: "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"  # noqa: E731
        body = "".join(line("td", row) for row in rows)
        caption = f"<caption>{html.escape(self._title())}</caption>"
        return f"<table>{caption}<thead>{line('th', names)}</thead><tbody>{body}</tbody></table>"


#: Columns of a table for a person, and rows where it is text.
_COLUMNS = 8
_ROWS = 16


def _cut(cell: str) -> str:
    """A cell that a line of a terminal holds."""
    return cell if len(cell) <= 60 else f"{cell[:57]}..."


def finished(figure: Figure) -> Figure:
    """A figure as a method returns it. A notebook shows what a cell returns; left open, it would be shown twice."""
    import matplotlib
    from matplotlib import pyplot

    if "inline" in matplotlib.get_backend():
        pyplot.close(figure)
    return figure


def measured(value: float, half_width: float | None) -> str:
    """A number to the second digit of half its interval's width, with that: ``0.03301 ± 0.00009``."""
    if not half_width or not math.isfinite(half_width):
        return _short(value)
    exponent = math.floor(math.log10(max(abs(value), half_width)))
    # Numbers far from one have their power of ten outside.
    power = exponent if not -4 < exponent < 6 else 0
    digits = max(0, 1 - math.floor(math.log10(half_width)) + power)
    text = f"{value / 10.0**power:.{digits}f} ± {half_width / 10.0**power:.{digits}f}"
    return f"({text})e{power}" if power else text


def _flat(document: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    row: dict[str, Any] = {}
    for name, value in document.items():
        if isinstance(value, dict):
            row.update(_flat(value, f"{prefix}{name}."))
        else:
            row[prefix + name] = value
    return row


def _short(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, (list, dict)):
        return {0: "", 1: "1 entry"}.get(len(value), f"{len(value)} entries")
    return f"{value:.4g}" if isinstance(value, float) else str(value)
