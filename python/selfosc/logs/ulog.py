"""PX4's ULog, by pyulog."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _arguments
from ._align import Channel, align, angles, damaged, instance, missing, numbers, split, unknown

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["read_ulog"]

#: Bytes of the file's header, and the types of messages, of the ULog file format.
_HEADER, _TYPES = 16, frozenset(b"BFIMPQARDLCSO")
#: A message that is cut off at the end may have this many bytes in any log.
_SHORT = 528


@_arguments.named
def read_ulog(path: str | bytes | os.PathLike[str], output: str, command: str, **how: Any) -> pd.DataFrame:
    """Two channels of a PX4 log on one clock.

    Parameters
    ----------
    path : path-like
        A ``.ulg`` file.
    output, command : str
        Channels as ``topic.field``, another instance as ``topic[1].field``: ``"vehicle_attitude.yaw"`` (from its quaternion),
        ``"vehicle_local_position.z"``, ``"actuator_motors.control[0]"``, ``"vehicle_torque_setpoint.xyz[2]"``.
    **how
        As for :func:`align`.

    Returns
    -------
    pandas.DataFrame
        As of :func:`align`. PX4 logs SI units, angles in rad, in NED; time is that of ``timestamp``.

    Raises
    ------
    UnreadableLog
        For a log with bytes between its messages that are none (pyulog passes over them), another file, a channel that is not
        there. What power cut off at the end is left out. ULog has no checksums: a number changed in place goes unseen.
    """
    core = _arguments.required(lambda: __import__("pyulog.core", fromlist=["core"]), "ulog")
    path = _arguments.path(path)
    _arguments.check(align, how)
    try:
        log = core.ULog(path)
    except OSError as error:
        raise missing(path, error) from error
    except Exception as error:  # pyulog raises what its parsing comes to
        raise damaged(path, "ULog file", error) from error
    if log.file_corruption:
        raise damaged(path, "ULog file", "messages in it are corrupt")
    _refuse_gaps(path)
    if not log.data_list:
        raise damaged(path, "ULog file", "it holds no data")
    return align(_channel(log, output), _channel(log, command), **how)


def _refuse_gaps(path: Any) -> None:
    """pyulog passes over much of what is no message; each message says how long it is, and the next begins there."""
    with open(path, "rb") as file:
        content = file.read()
    at, longest = _HEADER, 0
    while at + 3 <= len(content):
        length = 3 + int.from_bytes(content[at : at + 2], "little")
        if content[at + 2] not in _TYPES:
            raise damaged(path, "ULog file", f"what begins at byte {at} is no message")
        if at + length > len(content):
            # What power cut off; longer than any message before it, it is none.
            if length > max(longest, _SHORT):
                raise damaged(path, "ULog file", f"what begins at byte {at} is no message")
            break
        at, longest = at + length, max(longest, length)


def _channel(log: Any, name: str) -> Channel:
    topic, field = split(name)
    base, number = instance(topic)
    found = next((one for one in log.data_list if (one.name, one.multi_id) == (base, number or 0)), None)
    if found is None:
        raise unknown("topic", topic, sorted({one.name for one in log.data_list}))
    time_s = found.data["timestamp"].astype(float) * 1e-6
    if field in found.data:
        heading = field in ("heading", "yaw")
        return Channel(name, time_s, numbers(found.data[field], name), "rad" if heading else "", "NED")
    if field in ("roll", "pitch", "yaw") and "q[0]" in found.data:
        quaternion = tuple(found.data[f"q[{part}]"] for part in range(4))
        return Channel(name, time_s, np.asarray(angles(quaternion, field)), "rad", "NED")
    raise unknown("field", field, [one for one in found.data if one != "timestamp"])
