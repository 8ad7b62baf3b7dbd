"""Two channels of a log on one clock."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .. import _arguments
from .._names import Suggesting, near
from ..errors import UnreadableLog, UsageError

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["Channel", "align"]

#: What a unit is in SI.
_SI = {
    "": (1.0, ""), "rad": (1.0, "rad"), "deg": (math.pi / 180.0, "rad"), "cdeg": (math.pi / 18000.0, "rad"),
    "degheading": (math.pi / 180.0, "rad"), "m": (1.0, "m"), "cm": (1e-2, "m"), "mm": (1e-3, "m"),
    "rad/s": (1.0, "rad/s"), "deg/s": (math.pi / 180.0, "rad/s"), "m/s": (1.0, "m/s"), "N": (1.0, "N"), "N m": (1.0, "N m"),
}  # fmt: skip


@_arguments.constructed
@dataclass(frozen=True)
class Channel(Suggesting):
    """One quantity of a log.

    Attributes
    ----------
    name : str
        ``topic.field`` as asked for.
    time_s, values : ndarray
        Stamps in s on the log's own clock, and what was logged, of one length.
    unit : str
        Of the values; empty where the log does not say.
    frame : str
        ``"NED"`` or ``"ENU"`` where an angle is measured in it; empty where the log does not say.
    """

    name: str
    time_s: NDArray[np.float64]
    values: NDArray[np.float64]
    unit: str = ""
    frame: str = ""

    def __post_init__(self) -> None:
        for name in ("time_s", "values"):
            object.__setattr__(self, name, _arguments.array(getattr(self, name), f"{name} of {_arguments.text(self.name, 'name')}"))
        sizes = self.time_s.shape, self.values.shape
        if len(sizes[0]) != 1 or sizes[0] != sizes[1]:
            raise UsageError(f"{self.name}: time_s and values have the shapes {sizes[0]} and {sizes[1]}; give one value for each stamp")
        if not np.isfinite(self.time_s).all():
            raise UsageError(f"{self.name}: a stamp is no finite number; leave the sample out", "not-finite")

    def in_si(self) -> Channel:
        """The same in SI units; a unit that is not known stays."""
        factor, unit = _SI.get(self.unit, (1.0, self.unit))
        return replace(self, values=self.values * factor, unit=unit)

    def in_frame(self, frame: str) -> Channel:
        """A heading or yaw of the other frame: north clockwise (NED) from east counter-clockwise (ENU), and back."""
        if self.frame == frame:
            return self
        if {self.frame, frame} != {"NED", "ENU"}:
            raise UsageError(f"{self.name} is in no frame that is known; leave the frame out, or give it by units and sign")
        if not self.name.endswith(("yaw", "heading")):
            raise UsageError(f"{self.name} is no heading; only a yaw or a heading changes its frame here")
        return replace(self, values=0.5 * math.pi - self.values, frame=frame)


@_arguments.named
def align(
    output: Channel,
    command: Channel,
    *,
    wrap: bool | None = None,
    frame: str | None = None,
    neutral: float = 0.0,
    scale: float = 1.0,
) -> pd.DataFrame:
    """One table of both channels at the output's stamps.

    Parameters
    ----------
    output, command : Channel
        The command at a stamp is the last one logged at or before it (hold). Outputs before the first command are left out.
    wrap : bool, optional
        Whether the output is an angle that jumps by a turn; by default, whether it is named after heading or yaw.
    frame : {"NED", "ENU"}, optional
        Turns a heading into this frame.
    neutral, scale : float
        The command becomes ``(logged - neutral) * scale``: a servo's neutral in microseconds, a torque per unit.

    Returns
    -------
    pandas.DataFrame
        ``time_s`` from 0, the output as ``heading`` (wrapped), or ``output``, and ``command``. ``attrs`` states sources, units,
        frame, wrap and alignment with the longest time a command was held.

    Raises
    ------
    UnreadableLog
        Where the two do not overlap, or stamps go backwards.
    """
    import pandas as pd

    neutral, scale = _arguments.finite(neutral, "neutral"), _arguments.finite(scale, "scale")
    for name, channel in (("output", output), ("command", command)):
        if not isinstance(channel, Channel):
            raise UsageError(f"{name} is {_arguments.shown(channel)}: must be a selfosc.logs.Channel; give one")
        if len(channel.time_s) == 0:
            raise UnreadableLog(f"{channel.name} has no sample; name a channel that was logged", "no-channel")
        backwards = np.flatnonzero(np.diff(channel.time_s) < 0.0)
        if len(backwards):
            at = int(backwards[0]) + 1
            raise UnreadableLog(
                f"{channel.name}: stamp {at} is {channel.time_s[at]} s after {channel.time_s[at - 1]} s; the log's clock was "
                "set back there: cut it and use one part",
                "clock",
            )
    output = output.in_si() if frame is None else output.in_si().in_frame(frame)
    held = np.searchsorted(command.time_s, output.time_s, side="right") - 1
    inside = held >= 0
    if not inside.any():
        raise UnreadableLog(f"{command.name} begins after {output.name} ends; they share no time", "no-overlap")
    time_s, held = output.time_s[inside], held[inside]
    ages = time_s - command.time_s[held]
    if wrap is None:
        wrap = "heading" in output.name.lower() or "yaw" in output.name.lower()
    role = "heading" if wrap else "output"
    table = pd.DataFrame(
        {
            "time_s": time_s - time_s[0],
            role: output.values[inside],
            "command": (command.values[held] - neutral) * scale,
        }
    )
    table.attrs = {
        "sources": {role: output.name, "command": command.name},
        "units": {"time_s": "s", role: output.unit, "command": command.unit if (neutral, scale) == (0.0, 1.0) else "scaled"},
        "frame": output.frame,
        "wrap": bool(wrap),
        "alignment": (
            f"{command.name} held at the stamps of {output.name}, at most {ages.max():.6g} s old; "
            f"{int((~inside).sum())} outputs before the first command left out"
        ),
        "start_s": float(time_s[0]),
    }
    return table


def angles(quaternion: tuple[Any, Any, Any, Any], name: str) -> NDArray[np.float64]:
    """``roll``, ``pitch`` or ``yaw`` (rad, Z-Y-X) of a quaternion ``w, x, y, z``."""
    w, x, y, z = (np.asarray(part, dtype=float) for part in quaternion)
    if name == "roll":
        return np.arctan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    if name == "pitch":
        return np.arcsin(np.clip(2.0 * (w * y - z * x), -1.0, 1.0))
    return np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def split(name: str) -> tuple[str, str]:
    """Topic and field of a channel."""
    topic, dot, field = name.partition(".") if isinstance(name, str) else ("", "", "")
    if not (topic and dot and field):
        raise UsageError(f"{_arguments.shown(name)} is no channel; write it as topic.field")
    return topic, field


def instance(topic: str) -> tuple[str, int | None]:
    """A topic without its instance, and the instance: ``topic[1]``."""
    base, bracket, number = topic.partition("[")
    if not bracket:
        return topic, None
    digits = number.removesuffix("]")
    if not (base and number.endswith("]") and digits.isascii() and digits.isdecimal() and len(digits) < 10):
        raise UsageError(f"{_arguments.shown(topic)} is no topic; write an instance as topic[1]")
    return base, int(digits)


def numbers(values: Any, name: str) -> NDArray[np.float64]:
    """What was logged, as floats."""
    try:
        return _arguments.floats(values)
    except (TypeError, ValueError, OverflowError) as error:
        raise UnreadableLog(f"{name} holds no numbers ({_arguments.cut(error)}); name a channel that does", "no-channel") from error


def unknown(kind: str, name: str, known: list[str]) -> UnreadableLog:
    """The refusal of a topic or field that is not there."""
    shown = ", ".join(known[:40]) + (", ..." if len(known) > 40 else "")
    nearest = near(name, known)
    meant = f"did you mean {nearest}? " if nearest else ""
    return UnreadableLog(f"no {kind} {name}; {meant}there are: {shown or 'none'}", "no-channel")


def damaged(path: Any, kind: str, reason: object) -> UnreadableLog:
    """The refusal of a file that is not what its name says, or not all of it."""
    text = f"{path} is damaged or no {kind}: {reason}; copy it from the vehicle again"
    return UnreadableLog(_arguments.in_text(text), "damaged")


def missing(path: Any, error: OSError) -> UnreadableLog:
    """The refusal of a path."""
    text = f"cannot read {path}: {error.strerror or error}; give the path of a log that you may read"
    return UnreadableLog(_arguments.in_text(text), "unreadable")


def of_topics(stamps_ns: dict[str, list[int]], messages: dict[str, list[Any]], names: tuple[str, ...]) -> list[Channel]:
    """Channels of ROS messages by topic, on a clock that begins with the first of them: ns since 1970 are too many for floats."""
    origin = min((stamp for stamps in stamps_ns.values() for stamp in stamps), default=0)
    channels = []
    for name in names:
        topic, path = split(name)
        stamps = np.asarray([stamp - origin for stamp in stamps_ns[topic]], dtype=float) * 1e-9
        channels.append(_of_messages(stamps, messages[topic], name, path))
    return channels


def _of_messages(time_s: NDArray[np.float64], messages: list[Any], name: str, path: str) -> Channel:
    """A field of ROS messages: names, elements, and the angles of a quaternion, in ENU."""
    parts = path.replace("[", ".[").split(".")
    angle = parts[-1] if parts[-1] in ("roll", "pitch", "yaw") else None

    def value(message: Any) -> Any:
        for part in parts[:-1] if angle else parts:
            try:
                message = message[int(part[1:-1])] if part.startswith("[") else getattr(message, part)
            except (AttributeError, IndexError, ValueError) as error:
                fields = [one for one in getattr(message, "__slots__", None) or vars(message)] if part[0] != "[" else []
                raise unknown("field", f"{part} of {name}", [str(one) for one in fields]) from error
        return message

    found = [value(message) for message in messages]
    if angle:
        try:
            w, x, y, z = ([getattr(q, part) for q in found] for part in "wxyz")
        except AttributeError as error:
            raise unknown("field", f"{angle} of {name}, which is no quaternion", []) from error
        values = angles((w, x, y, z), angle)
        return Channel(name, time_s, values, "rad", "ENU")
    return Channel(name, time_s, numbers(found, name))
