"""An identified axis for other people's programs: state space, Gazebo, ArduSub."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal
from xml.etree import ElementTree

from . import _arguments, types
from .control import Tuned
from .errors import UsageError
from .identification import Identification

if TYPE_CHECKING:
    import control

__all__ = [
    "AXES",
    "ardusub_parameters",
    "gazebo_hydrodynamics",
    "hydrodynamic_coefficients",
    "state_space",
    "xacro_hydrodynamics",
]

Axis = Literal["surge", "sway", "heave", "roll", "pitch", "yaw"]
#: Axes of a body by the letters of force and velocity (SNAME).
AXES = {"surge": "xU", "sway": "yV", "heave": "zW", "roll": "kP", "pitch": "mQ", "yaw": "nR"}


def _values(model: Identification | Mapping[str, float]) -> dict[str, float]:
    """Inertia, drags and delay, of an identification or given."""
    if isinstance(model, Mapping):
        names = ("alpha", "beta", "beta_quadratic", "delay")
        _arguments.mapping(model, "model", (*names, "delta", "drag"))
        values = {name: _arguments.finite(model.get(name, 0.0), name) for name in names}
    elif not isinstance(model, Identification):
        raise UsageError(f"model is {_arguments.shown(model)}: must be an Identification or a mapping; give one of these")
    else:
        answer = model.reported
        if not answer:
            raise UsageError("the model reports no answer; identify with the method fit or all")
        if model.trust == "doubtful":
            raise UsageError("the model is doubtful; give alpha and drag yourself, or log another record", "doubtful")
        drag = {name: 0.0 if part is None else part["value"] for name, part in _drag_of(answer).items()}
        values = {"alpha": answer["alpha"]["value"], **drag, "delay": answer["delay_s"]["value"]}
    _least("alpha", values["alpha"], "above 0", values["alpha"] > 0.0)
    _least("delay", values["delay"], "0 or more", values["delay"] >= 0.0)
    return values


def _least(name: str, value: float, limit: str, kept: bool) -> float:
    if not kept:
        raise UsageError(f"{name} is {value}: must be {limit}; check where it comes from", "out-of-domain", name, value)
    return value


def _drag_of(answer: types.Reported) -> dict[str, types.Interval | None]:
    return {"beta": answer["beta"], "beta_quadratic": answer["beta_quadratic"]}


@_arguments.named
def state_space(model: Identification | Mapping[str, float], speed: float = 0.0, *, pade: int = 0) -> control.StateSpace:
    """The axis about a constant speed, from force to output.

    Parameters
    ----------
    model : Identification or mapping
        With ``alpha``, ``beta``, ``beta_quadratic`` and ``delay`` in a mapping.
    speed : float
        About which quadratic drag is taken by its slope, ``beta + 2 beta_quadratic |speed|``; output units per s.
    pade : int
        Order of the rational approximation of the delay; 0 leaves the delay out.

    Returns
    -------
    control.StateSpace
        Without a delay, states are output and speed, as deviations.

    Examples
    --------
    >>> from selfosc.export import state_space
    >>> state_space({"alpha": 2.0, "beta": 1.0, "beta_quadratic": 0.5}, speed=1.0).A
    array([[ 0.,  1.],
           [ 0., -1.]])
    """
    import control

    values = _values(model)
    slope = values["beta"] + 2.0 * values["beta_quadratic"] * abs(_arguments.finite(speed, "speed"))
    alpha = values["alpha"]
    axis = control.ss([[0.0, 1.0], [0.0, -slope / alpha]], [[0.0], [1.0 / alpha]], [[1.0, 0.0]], [[0.0]])
    if _arguments.whole(pade, "pade"):
        return control.ss(axis * control.tf(*control.pade(values["delay"], pade)))
    return axis


@_arguments.named
def hydrodynamic_coefficients(
    model: Identification | Mapping[str, float], axis: str, rigid_inertia: float, scale: float = 1.0
) -> dict[str, float]:
    """Added mass and damping under the names and signs of Gazebo's Hydrodynamics plugin.

    Parameters
    ----------
    model : Identification or mapping
        As for :func:`state_space`.
    axis : {"surge", "sway", "heave", "roll", "pitch", "yaw"}
    rigid_inertia : float
        Mass (kg) or moment of inertia (kg m^2) that the simulator has for the link about this axis: what was identified is
        the sum of it and the added mass.
    scale : float
        Newtons or newton metres for one unit of the command, where it is another.

    Returns
    -------
    dict
        ``nDotR``, ``nR`` and ``nRabsR`` for yaw and so on; zero or negative, as Fossen's derivatives are.

    Raises
    ------
    UsageError
        Where the added mass would be negative: the simulator's inertia is larger than all that was identified.

    Notes
    -----
    Names are those of gz-sim's ``Hydrodynamics.hh``. One axis says nothing of the cross terms.

    Examples
    --------
    >>> from selfosc.export import hydrodynamic_coefficients
    >>> hydrodynamic_coefficients({"alpha": 3.0, "beta": 0.5, "beta_quadratic": 2.0}, "yaw", rigid_inertia=1.0)
    {'nDotR': -2.0, 'nR': -0.5, 'nRabsR': -2.0}
    """
    _arguments.choice(axis, "axis", Axis)
    values, scale = _values(model), _arguments.finite(scale, "scale")
    _least("scale", scale, "above 0", scale > 0.0)
    rigid_inertia = _arguments.finite(rigid_inertia, "rigid_inertia")
    _least("rigid_inertia", rigid_inertia, "0 or more", rigid_inertia >= 0.0)
    force, velocity = AXES[axis][0], AXES[axis][1]
    added = values["alpha"] * scale - rigid_inertia
    if added < 0.0:
        raise UsageError(
            f"rigid_inertia is {rigid_inertia}: must be at most what was identified, {values['alpha'] * scale:.6g}; check the "
            "link's inertia and the scale of the command",
            "out-of-domain", "rigid_inertia", rigid_inertia,
        )  # fmt: skip
    return {
        f"{force}Dot{velocity}": -added,
        f"{force}{velocity}": -values["beta"] * scale,
        f"{force}{velocity}abs{velocity}": -values["beta_quadratic"] * scale,
    }


@_arguments.named
def gazebo_hydrodynamics(coefficients: Mapping[str, float], link: str, *, water_density: float = 998.0) -> str:
    """The plugin's element for an SDF model, with coefficients of :func:`hydrodynamic_coefficients`, of several axes merged.

    Examples
    --------
    >>> from selfosc.export import gazebo_hydrodynamics
    >>> print(gazebo_hydrodynamics({"nR": -0.5}, "base_link"))
    <plugin filename="gz-sim-hydrodynamics-system" name="gz::sim::systems::Hydrodynamics">
      <link_name>base_link</link_name>
      <water_density>998.0</water_density>
      <nR>-0.5</nR>
    </plugin>
    """
    plugin = ElementTree.Element("plugin", filename="gz-sim-hydrodynamics-system", name="gz::sim::systems::Hydrodynamics")
    density = _arguments.finite(water_density, "water_density")
    settings = {"link_name": _arguments.text(link, "link"), "water_density": _least("water_density", density, "above 0", density > 0.0)}
    for name, value in _arguments.mapping(coefficients, "coefficients").items():
        if not _arguments.text(name, "a coefficient's name").isidentifier():
            raise UsageError(f"coefficients has {name!r}: must be a derivative, as nDotR; take them from hydrodynamic_coefficients")
        settings[name] = _arguments.finite(value, name)
    for name, value in settings.items():
        ElementTree.SubElement(plugin, name).text = str(value)
    ElementTree.indent(plugin)
    return ElementTree.tostring(plugin, encoding="unicode")


@_arguments.named
def xacro_hydrodynamics(coefficients: Mapping[str, float], name: str = "hydrodynamics") -> str:
    """A xacro macro ``<xacro:NAME link="..."/>`` that puts the plugin into a robot's description.

    Examples
    --------
    >>> from selfosc.export import xacro_hydrodynamics
    >>> print(xacro_hydrodynamics({"nR": -0.5}).splitlines()[1].strip())
    <xacro:macro name="hydrodynamics" params="link">
    """
    robot = ElementTree.Element("robot", {"xmlns:xacro": "http://www.ros.org/wiki/xacro"})
    macro = ElementTree.SubElement(robot, "xacro:macro", name=_arguments.text(name, "name"), params="link")
    gazebo = ElementTree.SubElement(macro, "gazebo")
    gazebo.append(ElementTree.fromstring(gazebo_hydrodynamics(coefficients, "${link}")))
    ElementTree.indent(robot)
    return ElementTree.tostring(robot, encoding="unicode")


@_arguments.named
def ardusub_parameters(tuned: Tuned, axis: str = "yaw") -> dict[str, float]:
    """A PD design as the gains of ArduSub's attitude loops.

    Parameters
    ----------
    tuned : Tuned
        With structure ``"pd"``, for a command normalised to -1..1, as ArduSub's mixer takes it, and an output in rad.
    axis : {"roll", "pitch", "yaw"}

    Returns
    -------
    dict
        ``ATC_ANG_*_P`` in 1/s, from angle error to rate, and ``ATC_RAT_*_P``, from rate error to command; the rate loop's
        integral and derivative set to zero.

    Notes
    -----
    ArduSub's documentation has the two loops in cascade: ``command = RAT_P (ANG_P error - rate)``, which is a PD controller on the
    measurement with ``derivative = RAT_P`` and ``proportional = RAT_P ANG_P``. Its limits of rate and acceleration, its
    square-root shaping of large errors and the filter of the derivative are not in this.
    """
    _arguments.choice(axis, "axis", Literal["roll", "pitch", "yaw"])
    if not isinstance(tuned, Tuned):
        raise UsageError(f"tuned is {_arguments.shown(tuned)}: must be a result of selfosc.tune(); give one")
    gains = tuned.gains
    if gains["structure"] != "pd":
        raise UsageError(f"the structure {gains['structure']} has no such form; tune with structure pd")
    name = {"roll": "RLL", "pitch": "PIT", "yaw": "YAW"}[axis]
    return {
        f"ATC_ANG_{name}_P": gains["proportional"] / gains["derivative"],
        f"ATC_RAT_{name}_P": gains["derivative"],
        f"ATC_RAT_{name}_I": 0.0,
        f"ATC_RAT_{name}_D": 0.0,
    }
