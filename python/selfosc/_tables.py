"""Tables of any make as three columns of numbers."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arguments, _core, _documents
from .errors import RecordRefused, UnreadableLog, UsageError

#: What the native half takes for a log: a path, or name, column names and columns.
Source = Path | tuple[str, list[str], list[NDArray[np.float64]]]

#: Files that are tables by themselves and no text.
_ARROW = {".parquet", ".arrow", ".feather"}
#: Files that hold several channels, and who reads them.
_CHANNELS = {".ulg": "read_ulog", ".bin": "read_dataflash", ".mcap": "read_mcap", ".db3": "read_rosbag", ".bag": "read_rosbag"}


def sources(given: Any, columns: Mapping[str, Any]) -> list[Source]:
    """The logs in what a user gives: one, or a sequence of them."""
    # An open file would give its lines.
    single = _is_table(given) or isinstance(given, (str, bytes, os.PathLike)) or hasattr(given, "read")
    logs = [given] if single or not isinstance(given, Iterable) else list(given)
    if not logs:
        raise UsageError("there is no log; give one or more")
    return [_source(log, "record" if len(logs) == 1 else f"record {place}", columns) for place, log in enumerate(logs, 1)]


def _is_table(given: Any) -> bool:
    return isinstance(given, Mapping) or hasattr(given, "columns") or hasattr(given, "column_names")


def _source(log: Any, name: str, columns: Mapping[str, Any]) -> Source:
    if isinstance(log, (str, bytes, os.PathLike)):
        path = Path(_arguments.path(log, "the log's path"))
        if path.suffix.lower() in _CHANNELS:
            reader = _CHANNELS[path.suffix.lower()]
            shown = _arguments.in_text(str(path))
            raise UsageError(f"{shown} holds channels of several rates; read it with selfosc.logs.{reader} first", "channels")
        if path.suffix.lower() not in _ARROW:
            return path
        name, log = _arguments.in_text(str(path)), _arrow(path)
    if any(hasattr(log, collect) for collect in ("collect", "compute")):  # polars.LazyFrame, Dask, Spark
        raise UsageError(f"{name}: a {type(log).__name__} holds no rows yet; collect it first, as a frame in memory")
    if not _is_table(log):
        raise UsageError(
            f"a log of type {type(log).__name__} is unknown; give a path, a pandas or polars frame, a pyarrow table, or a "
            "mapping from names to columns"
        )
    labels = log if isinstance(log, Mapping) else getattr(log, "column_names", None) or log.columns
    # A name that is no text to the system is shown as near as may be.
    labels = list(labels)
    if not labels:
        raise RecordRefused(f"{name} has no columns: must have time, output and command; give three", "unknown-column")
    names = [_arguments.in_text(str(one)) for one in labels]
    places = _core.choose_columns(_documents.json_of(columns), names)
    chosen = [_numbers(_column(log, labels[place], place), names[place], name) for place in places]
    return name, [names[place] for place in places], chosen


def _arrow(path: Path) -> Any:
    try:
        import pyarrow as pa
        from pyarrow import feather, parquet
    except ImportError as error:
        raise UsageError(f'{error.name} is not installed; pip install "selfosc[frames]"', "not-installed") from error
    shown, kind = _arguments.in_text(str(path)), path.suffix[1:]
    try:
        # Arrow takes no name that is not UTF-8.
        file = open(path, "rb")  # noqa: SIM115 -- closed below: what Arrow refuses is not what the system refuses
    except OSError as error:
        raise UnreadableLog(f"cannot read {shown}: {error.strerror}; give the path of a log that you may read", "unreadable") from error
    with file:
        try:
            return parquet.read_table(file) if kind.lower() == "parquet" else feather.read_table(file)
        except (pa.ArrowException, OSError) as error:
            raise UnreadableLog(f"{shown} is damaged or no {kind} file: {error}; write it again", "damaged") from error


def _column(table: Any, label: Any, place: int) -> Any:
    """A column by its place where the table has places: two may have one name."""
    if hasattr(table, "iloc"):
        return table.iloc[:, place]
    return table.column(place) if hasattr(table, "column_names") else table[label]


def _numbers(column: Any, label: str, name: str) -> NDArray[np.float64]:
    """A column as floats; what is missing or masked becomes NaN, which the record then refuses with its place."""
    try:
        values = column if isinstance(column, np.ma.MaskedArray) else np.asarray(column)
        if values.dtype.kind in "mM":
            raise TypeError("dates or durations, where seconds are wanted")
        # What comes out of a message may begin at any byte.
        return np.require(_arguments.floats(values), requirements=["C", "A"]).reshape(-1)
    except (TypeError, ValueError, OverflowError) as error:
        text = f"{name}: column {label} is no column of numbers ({_arguments.cut(error)}); give numbers in it"
        raise RecordRefused(text, "not-a-number") from error
