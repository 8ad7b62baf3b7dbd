"""What every result has: its document, a table, a page."""

from __future__ import annotations

import html
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ._names import nearest

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["Result"]


class Result:
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

    if not TYPE_CHECKING:  # A type checker knows the fields from each class, and so finds one that is not there.

        def __getattr__(self, name: str) -> Any:
            # Not while being unpickled, when there is no document yet.
            document = self.__dict__.get("_document", {})
            if name in document:
                return document[name]
            # Protocols of Python and of notebooks ask for names that nobody meant.
            remedy = "" if name.startswith("_") else f"; {nearest(name, [one for one in dir(self) if not one.startswith('_')])}"
            raise AttributeError(f"{type(self).__name__} has no {name}{remedy}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.__dict__.get("_document", {})]

    def _rows(self) -> list[dict[str, Any]]:
        """The rows of the table that says most."""
        return [_flat(self._document)]

    def to_frame(self) -> pd.DataFrame:
        """The result as a pandas frame, nested fields joined by dots."""
        import pandas as pd

        return pd.DataFrame(self._rows())

    def __repr__(self) -> str:
        lines = [f"{type(self).__name__}("]
        for row in self._rows()[:12]:
            shown = ", ".join(f"{name}={_short(value)}" for name, value in row.items() if value is not None)
            lines.append(f"  {shown}")
        return "\n".join([*lines, ")"])

    def _repr_html_(self) -> str:
        rows = self._rows()
        names = list(dict.fromkeys(name for row in rows for name in row))
        cell = lambda tag, value: f"<{tag}>{html.escape(str(value))}</{tag}>"  # noqa: E731
        head = "".join(cell("th", name) for name in names)
        body = "".join("<tr>" + "".join(cell("td", _short(row.get(name))) for name in names) + "</tr>" for row in rows)
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


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
    return f"{value:.6g}" if isinstance(value, float) else str(value)
