"""MCAP files of ROS 2, by mcap and mcap-ros2-support."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Literal

from .. import _arguments
from ..errors import SelfoscError
from ._align import align, damaged, missing, of_topics, split, unknown

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["read_mcap"]

Stamp = Literal["header", "log"]


@_arguments.named
def read_mcap(path: str | bytes | os.PathLike[str], output: str, command: str, *, stamp: Stamp = "header", **how: Any) -> pd.DataFrame:
    """Two channels of an MCAP file on one clock.

    Parameters
    ----------
    path : path-like
        An ``.mcap`` file with ROS 2 messages.
    output, command : str
        Channels as ``/topic.field``: ``"/imu/data.orientation.yaw"`` (from its quaternion), ``"/depth.data"``,
        ``"/thrusters.wrench.torque.z"``.
    stamp : {"header", "log"}
        Time of the message's header where it has one, or of its arrival at the logger.
    **how
        As for :func:`align`.

    Returns
    -------
    pandas.DataFrame
        As of :func:`align`. ROS has SI units and, for attitude, ENU (REP 103); ``frame="NED"`` turns a yaw round.

    Raises
    ------
    UnreadableLog
        For a damaged or unfinished file, a topic or field that is not there.
    """
    reading = _arguments.required(lambda: __import__("mcap.reader", fromlist=["reader"]), "mcap")
    decoding = _arguments.required(lambda: __import__("mcap_ros2.decoder", fromlist=["decoder"]), "mcap")
    _arguments.choice(stamp, "stamp", Stamp)
    path = _arguments.path(path)
    _arguments.check(align, how)
    names = (output, command)
    topics = {split(name)[0] for name in names}
    stamps: dict[str, list[int]] = {topic: [] for topic in topics}
    messages: dict[str, list[Any]] = {topic: [] for topic in topics}
    try:
        with open(path, "rb") as file:
            reader = reading.make_reader(file, validate_crcs=True, decoder_factories=[decoding.DecoderFactory()])
            known = sorted({channel.topic for channel in reader.get_summary().channels.values()})
            for topic in sorted(topics - set(known)):
                raise unknown("topic", topic, known)
            for _, channel, record, message in reader.iter_decoded_messages(topics=sorted(topics)):
                stamps[channel.topic].append(stamp_ns(message, record.log_time, stamp))
                messages[channel.topic].append(message)
    except OSError as error:
        raise missing(path, error) from error
    except SelfoscError:
        raise
    except Exception as error:  # mcap raises what its parsing comes to
        raise damaged(path, "MCAP file", error or type(error).__name__) from error
    return align(*of_topics(stamps, messages, names), **how)


def stamp_ns(message: Any, logged_ns: int, stamp: str) -> int:
    """The time of a message: that of its header, if it has one and that is wanted."""
    header = getattr(message, "header", None) if stamp == "header" else None
    if header is None:
        return logged_ns
    return header.stamp.sec * 1_000_000_000 + header.stamp.nanosec
