"""Bags of ROS 1 and ROS 2, by rosbags."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import _arguments
from ..errors import SelfoscError
from ._align import align, damaged, missing, of_topics, split, unknown
from .mcap import Stamp, stamp_ns

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["read_rosbag"]


@_arguments.named
def read_rosbag(
    path: str | bytes | os.PathLike[str], output: str, command: str, *, stamp: Stamp = "header", **how: Any
) -> pd.DataFrame:
    """Two channels of a bag on one clock.

    Parameters
    ----------
    path : path-like
        A ``.bag`` file of ROS 1, or the folder of a ROS 2 bag.
    output, command, stamp, **how
        As for :func:`read_mcap`. Definitions that the bag does not hold are those of ROS 2 Humble.

    Returns
    -------
    pandas.DataFrame
        As of :func:`align`, with attitude in ENU (REP 103).

    Raises
    ------
    UnreadableLog
        For a damaged bag, a topic or field that is not there.
    """
    reading = _arguments.required(lambda: __import__("rosbags.highlevel", fromlist=["highlevel"]), "rosbag")
    types = _arguments.required(lambda: __import__("rosbags.typesys", fromlist=["typesys"]), "rosbag")
    _arguments.choice(stamp, "stamp", Stamp)
    path = _arguments.path(path)
    _arguments.check(align, how)
    names = (output, command)
    topics = {split(name)[0] for name in names}
    stamps: dict[str, list[int]] = {topic: [] for topic in topics}
    messages: dict[str, list[Any]] = {topic: [] for topic in topics}
    place = Path(path)
    if not place.exists():
        raise missing(path, FileNotFoundError(2, "no such file or folder"))
    try:
        store = types.get_typestore(types.Stores.ROS2_HUMBLE)
        with reading.AnyReader([place], default_typestore=store) as reader:
            known = sorted(reader.topics)
            for topic in sorted(topics - set(known)):
                raise unknown("topic", topic, known)
            wanted = [one for one in reader.connections if one.topic in topics]
            for connection, logged_ns, raw in reader.messages(connections=wanted):
                message = reader.deserialize(raw, connection.msgtype)
                stamps[connection.topic].append(stamp_ns(message, logged_ns, stamp))
                messages[connection.topic].append(message)
    except SelfoscError:
        raise
    except Exception as error:  # its storages raise what their parsing comes to
        raise damaged(path, "bag", error or type(error).__name__) from error
    return align(*of_topics(stamps, messages, names), **how)
