"""Tables of any make as three columns of numbers."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import RecordRefused, UnreadableLog, UsageError

#: What the native half takes for a log: a path, or name, column names and columns.
Source = Path | tuple[str, list[str], list[NDArray[np.float64]]]

#: Files that are tables by themselves and no text.
_ARROW = {".parquet", ".arrow", ".feather"}
#: Files that hold several channels, and who reads them.
_CHANNELS = {".ulg": "read_ulog", ".bin": "read_dataflash", ".mcap": "read_mcap", ".db3": "read_rosbag", ".bag": "read_rosbag"}


def sources(given: Any, columns: Mapping[str, Any]) -> list[Source]:
    """The logs in what a user gives: one, or a sequence of them."""
    several = isinstance(given, Iterable) and not (_is_table(given) or isinstance(given, (str, bytes, os.PathLike)))
    logs = list(given) if several else [given]
    if not logs:
        raise UsageError("there is no log; give one or more")
    return [_source(log, "record" if len(logs) == 1 else f"record {place}", columns) for place, log in enumerate(logs, 1)]


def _is_table(given: Any) -> bool:
    return isinstance(given, Mapping) or hasattr(given, "columns") or hasattr(given, "column_names")


def _source(log: Any, name: str, columns: Mapping[str, Any]) -> Source:
    if isinstance(log, (str, bytes, os.PathLike)):
        path = Path(os.fsdecode(log))
        try:
            os.fsencode(path)
        except UnicodeEncodeError as error:
            raise UsageError(f"{str(log)!r} is no path that the system can name ({error.reason}); give another") from error
        if path.suffix.lower() in _CHANNELS:
            reader = _CHANNELS[path.suffix.lower()]
            raise UsageError(f"{path} holds channels of several rates; read it with selfosc.logs.{reader} first", "channels")
        if path.suffix.lower() not in _ARROW:
            return path
        name, log = str(path).encode("utf-8", "replace").decode(), _arrow(path)
    if not _is_table(log):
        raise UsageError(
            f"a log of type {type(log).__name__} is unknown; give a path, a pandas or polars frame, a pyarrow table, or a "
            "mapping from names to columns"
        )
    labels = log if isinstance(log, Mapping) else getattr(log, "column_names", None) or log.columns
    # A name that is no text to the system is shown as near as may be.
    names = [str(one).encode("utf-8", "replace").decode() for one in labels]
    places = _core.choose_columns(json.dumps(columns), names)
    chosen = [(names[place], list(labels)[place]) for place in places]
    return name, [shown for shown, _ in chosen], [_numbers(log[label], shown, name) for shown, label in chosen]


def _arrow(path: Path) -> Any:
    import pyarrow as pa
    from pyarrow import feather, parquet

    try:
        if path.suffix.lower() == ".parquet":
            return parquet.read_table(path)
        return feather.read_table(path)
    except FileNotFoundError as error:
        raise UnreadableLog(f"cannot read {path}: {error}; give the path of a log that you may read", "unreadable") from error
    except (pa.ArrowException, OSError) as error:
        raise UnreadableLog(f"{path} is damaged or no {path.suffix[1:]} file: {error}; write it again", "damaged") from error


def _numbers(column: Any, label: str, name: str) -> NDArray[np.float64]:
    """A column as floats; what is missing becomes NaN, which the record then refuses with its place."""
    if hasattr(column, "to_numpy"):
        column = column.to_numpy()
    values = np.asarray(column)
    if values.dtype.kind in "mM":
        raise RecordRefused(f"{name}: column {label} holds dates or durations; give seconds as numbers", "not-a-number")
    if values.dtype.kind == "O":
        values = np.array([np.nan if one is None else one for one in values.ravel()], dtype=object)
    try:
        # What comes out of a message may begin at any byte.
        return np.require(values, dtype=np.float64, requirements=["C", "A"]).reshape(-1)
    except (TypeError, ValueError) as error:
        text = f"{name}: column {label} is no column of numbers ({error}); give numbers in it"
        raise RecordRefused(text, "not-a-number") from error
