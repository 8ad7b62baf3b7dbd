"""ArduPilot's dataflash log, by pymavlink."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _arguments
from ._align import Channel, align, damaged, instance, missing, numbers, split, unknown

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["read_dataflash"]

#: Bytes that may follow the last message: what pymavlink allows for a log written in pages, or that power cut off.
_TAIL = 528
#: Degrees in every version, also in logs without units.
_DEGREES = {("ATT", "Roll"), ("ATT", "Pitch"), ("ATT", "Yaw"), ("ATT", "DesRoll"), ("ATT", "DesPitch"), ("ATT", "DesYaw")}


@_arguments.named
def read_dataflash(path: str | bytes | os.PathLike[str], output: str, command: str, **how: Any) -> pd.DataFrame:
    """Two channels of an ArduPilot log on one clock.

    Parameters
    ----------
    path : path-like
        A ``.bin`` file.
    output, command : str
        Channels as ``MESSAGE.Field``, of one instance as ``MESSAGE[1].Field``: ``"ATT.Yaw"``, ``"CTUN.Alt"``, ``"RCOU.C4"``.
    **how
        As for :func:`align`: ``neutral=1500`` for a servo's microseconds.

    Returns
    -------
    pandas.DataFrame
        As of :func:`align`. Units are the log's own (messages FMTU and UNIT), else degrees for attitude; angles come out in
        rad, attitude in NED. Time is that of ``TimeUS``.

    Raises
    ------
    UnreadableLog
        For a log with bytes between its messages that are none, or another file; for a channel that is not there. What power
        cut off at the end is left out.
    """
    reader = _arguments.required(lambda: __import__("pymavlink.DFReader", fromlist=["DFReader"]), "dataflash")
    path = _arguments.path(path)
    _arguments.check(align, how)
    try:
        with open(path, "rb") as file:
            head = file.read(2)
    except OSError as error:
        raise missing(path, error) from error
    if head != b"\xa3\x95":
        raise damaged(path, "dataflash log", "it does not begin with a message")
    try:
        log = reader.DFReader_binary(path, zero_time_base=True)
    except Exception as error:  # pymavlink raises what its parsing comes to
        raise damaged(path, "dataflash log", error) from error
    try:
        _refuse_gaps(path, log)
        return align(_channel(log, output), _channel(log, command), **how)
    finally:
        log.close()


def _refuse_gaps(path: Any, log: Any) -> None:
    """pymavlink skips what is no message without a word."""
    spans = [(offset, log.formats[kind].len) for kind in range(256) for offset in log.offsets[kind]]
    spans.sort()
    end = 0
    for offset, length in spans:
        if offset != end:
            raise damaged(path, "dataflash log", f"{offset - end} bytes at {end} are no message")
        end = offset + length
    if log.data_len - end > _TAIL:
        raise damaged(path, "dataflash log", f"the {log.data_len - end} bytes from {end} are no message")


def _channel(log: Any, name: str) -> Channel:
    topic, field = split(name)
    base, number = instance(topic)
    kind = log.name_to_id.get(base)
    if kind is None:
        raise unknown("message", base, sorted(log.name_to_id))
    form = log.formats[kind]
    if field not in form.columns or "TimeUS" not in form.columns:
        raise unknown("field", f"{field} with a time", [one for one in form.columns if one != "TimeUS"])
    by = form.instance_field or "I"
    if number is not None and by not in form.columns:
        raise unknown("instance", topic, [base])
    log.rewind()
    stamps, values = [], []
    while (message := log.recv_match(type=base)) is not None:
        if number is not None and int(getattr(message, by)) != number:
            continue
        stamps.append(message.TimeUS * 1e-6)
        values.append(getattr(message, field))
    unit = form.get_unit(field) or ("deg" if (base, field) in _DEGREES else "")
    frame = "NED" if (base, field) in _DEGREES else ""
    return Channel(name, np.asarray(stamps, dtype=float), numbers(values, name), unit, frame)
