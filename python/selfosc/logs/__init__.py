"""Vehicles' logs as one table that :func:`selfosc.identify` takes.

Each format is read by its own community's library, an extra of this package: ``pip install "selfosc[logs]"``. Channels are named
``topic.field``, fields of fields and elements as ``topic.field.part[2]``; where a message has a quaternion, ``.roll``,
``.pitch`` and ``.yaw`` of it are channels too.
"""

from ._align import Channel, align
from .dataflash import read_dataflash
from .mcap import read_mcap
from .rosbag import read_rosbag
from .ulog import read_ulog

__all__ = ["Channel", "align", "read_dataflash", "read_mcap", "read_rosbag", "read_ulog"]
