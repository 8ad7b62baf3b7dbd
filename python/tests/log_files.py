"""Logs in the field's formats, written by the field's libraries: one heading record with its channels at rates of their own."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

import selfosc

OFFSET_S = 12.5


def channels() -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Stamps and headings (rad) at 10 Hz; stamps and commands where the command changes, and once before."""
    record = selfosc.simulate(alpha=0.03, beta_quadratic=0.02, relay=0.08, half_width=0.3, delay=0.2, hold=True, cycles=8)
    time, heading, command = (np.asarray(column) for column in record.values())
    changes = np.flatnonzero(np.diff(command, prepend=np.nan))
    return time + OFFSET_S, heading, time[changes] + OFFSET_S, command[changes]


def write_ulog(path: Path) -> None:
    from pyulog.core import ULog

    time, heading, when, command = channels()
    log = ULog(None)
    log._file_version = 1
    half = 0.5 * heading
    topics = {
        "vehicle_attitude": ("float[4] q", time, [np.cos(half), 0 * half, 0 * half, np.sin(half)]),
        "vehicle_local_position": ("float heading", time, [heading]),
        "vehicle_torque_setpoint": ("float[3] xyz", when, [0 * command, 0 * command, command]),
    }
    for number, (name, (field, stamps, columns)) in enumerate(topics.items()):
        definition = f"{name}:uint64_t timestamp;{field};"
        log._message_formats[name] = ULog.MessageFormat(definition.encode(), None)
        data = object.__new__(ULog.Data)
        data.multi_id, data.msg_id, data.name, data.timestamp_idx = 0, number, name, 0
        label = field.split(" ")[1]
        labels = [f"{label}[{part}]" for part in range(len(columns))] if "[" in field else [label]
        data.field_data = [ULog._FieldData(*one) for one in [("timestamp", "uint64_t"), *((one, "float") for one in labels)]]
        data.data = {"timestamp": np.round(stamps * 1e6).astype(np.uint64)}
        data.data |= {one: np.asarray(column, dtype=np.float32) for one, column in zip(labels, columns, strict=True)}
        log._data_list.append(data)
    log.write_ulog(str(path))


def write_dataflash(path: Path) -> None:
    import struct

    from pymavlink.DFReader import DFFormat, DFMessage

    time, heading, when, command = channels()
    head = DFFormat(0x80, "FMT", 89, "BBnNZ", "Type,Length,Name,Format,Columns")
    forms = [
        DFFormat(0x81, "ATT", 0, "Qf", "TimeUS,Yaw"),
        DFFormat(0x82, "RCOU", 0, "QH", "TimeUS,C4"),
        DFFormat(0x83, "ATTI", 0, "QBc", "TimeUS,I,Yaw"),
    ]

    def message(form: Any, *values: Any) -> bytes:
        return DFMessage(form, list(values), False, None).get_msgbuf() or b""

    def pack(form: Any, *values: Any) -> bytes:
        return struct.pack("BBB", 0xA3, 0x95, form.type) + struct.pack(form.msg_struct, *values)

    parts = []
    for form in [head, *forms]:
        length = struct.calcsize(form.msg_struct) + 3
        values = [form.type, length, form.name.encode(), form.format.encode(), ",".join(form.columns).encode()]
        parts.append(pack(head, *values))
    attitude, outputs, instance = forms
    stamped = [(t, message(attitude, round(t * 1e6), np.degrees(y) % 360.0)) for t, y in zip(time, heading, strict=True)]
    stamped += [(t, message(outputs, round(t * 1e6), round(1500 + 1000 * u))) for t, u in zip(when, command, strict=True)]
    stamped += [(t, pack(instance, round(t * 1e6), 1, 4500)) for t in time[:40]]
    parts += [part for _, part in sorted(stamped, key=lambda one: one[0])]
    path.write_bytes(b"".join(parts))


#: ROS 2 definitions, as a bag carries them.
IMU = """std_msgs/Header header
geometry_msgs/Quaternion orientation
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""


def write_mcap(path: Path) -> None:
    from mcap_ros2.writer import Writer

    time, heading, when, command = channels()
    with path.open("wb") as file:
        writer = Writer(file)
        imu, number = writer.register_msgdef("demo_msgs/Imu", IMU), writer.register_msgdef("std_msgs/Float64", "float64 data\n")
        for stamp, angle in zip(time, heading, strict=True):
            ns = 1_760_000_000_000_000_000 + round(stamp * 1e9)
            yaw = 0.5 * (0.5 * np.pi - angle)  # ENU
            stamped = {"stamp": {"sec": ns // 10**9, "nanosec": ns % 10**9}, "frame_id": "base"}
            orientation = {"x": 0.0, "y": 0.0, "z": np.sin(yaw), "w": np.cos(yaw)}
            writer.write_message("/imu/data", imu, {"header": stamped, "orientation": orientation}, log_time=ns + 4_000_000)
        for stamp, value in zip(when, command, strict=True):
            ns = 1_760_000_000_000_000_000 + round(stamp * 1e9)
            writer.write_message("/torque", number, {"data": float(value)}, log_time=ns)
        writer.finish()


def write_rosbag(path: Path) -> None:
    """A bag of ROS 2: a folder with a database."""
    from rosbags.rosbag2 import Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    with Writer(path, version=9) as writer:
        _write_messages(writer, store, store.serialize_cdr)


def write_rosbag1(path: Path) -> None:
    """A bag of ROS 1: one file, which holds its definitions."""
    from rosbags.rosbag1 import Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC)
    with Writer(path) as writer:
        _write_messages(writer, store, store.serialize_ros1)


def _write_messages(writer: Any, store: Any, serialized: Any) -> None:
    time, heading, when, command = channels()
    kinds = store.types
    imu = writer.add_connection("/imu/data", "sensor_msgs/msg/Imu", typestore=store)
    torque = writer.add_connection("/torque", "std_msgs/msg/Float64", typestore=store)
    vector, none = kinds["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.0), np.zeros(9)
    counted = "seq" in kinds["std_msgs/msg/Header"].__dataclass_fields__
    for number, (stamp, angle) in enumerate(zip(time, heading, strict=True)):
        ns = 1_760_000_000_000_000_000 + round(stamp * 1e9)
        yaw = 0.5 * (0.5 * np.pi - angle)
        sequence = {"seq": number} if counted else {}
        when_measured = kinds["builtin_interfaces/msg/Time"](ns // 10**9, ns % 10**9)
        stamped = kinds["std_msgs/msg/Header"](stamp=when_measured, frame_id="base", **sequence)
        turned = kinds["geometry_msgs/msg/Quaternion"](0.0, 0.0, float(np.sin(yaw)), float(np.cos(yaw)))
        message = kinds["sensor_msgs/msg/Imu"](stamped, turned, none, vector, none, vector, none)
        writer.write(imu, ns + 4_000_000, serialized(message, "sensor_msgs/msg/Imu"))
    for stamp, value in zip(when, command, strict=True):
        ns = 1_760_000_000_000_000_000 + round(stamp * 1e9)
        writer.write(torque, ns, serialized(kinds["std_msgs/msg/Float64"](float(value)), "std_msgs/msg/Float64"))
