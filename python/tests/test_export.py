"""Models for other programs."""

from xml.etree import ElementTree

import numpy as np
import pytest

import selfosc
from selfosc import export

AXIS = {"alpha": 3.0, "beta": 0.5, "beta_quadratic": 2.0, "delay": 0.3}


def test_state_space_against_a_difference_of_the_motion():
    speed = 0.7
    system = export.state_space(AXIS, speed)
    force = lambda v: -AXIS["beta"] * v - AXIS["beta_quadratic"] * abs(v) * v  # noqa: E731
    slope = (force(speed + 1e-6) - force(speed - 1e-6)) / 2e-6 / AXIS["alpha"]
    assert system.A[1, 1] == pytest.approx(slope, rel=1e-8)
    delayed = export.state_space(AXIS, speed, pade=4)
    frequency = 1j * 0.8
    assert delayed(frequency) == pytest.approx(system(frequency) * np.exp(-0.3 * frequency), rel=1e-6)


def test_gazebo_and_xacro():
    yaw = export.hydrodynamic_coefficients(AXIS, "yaw", rigid_inertia=1.0)
    surge = export.hydrodynamic_coefficients({"alpha": 30.0, "beta": 5.0}, "surge", rigid_inertia=20.0, scale=2.0)
    plugin = ElementTree.fromstring(export.gazebo_hydrodynamics(yaw | surge, "base_link"))
    numbers = {child.tag: child.text for child in plugin}
    assert numbers["link_name"] == "base_link"
    assert {name: float(numbers[name]) for name in ("nDotR", "nR", "nRabsR", "xDotU", "xU", "xUabsU")} == {
        "nDotR": -2.0, "nR": -0.5, "nRabsR": -2.0, "xDotU": -40.0, "xU": -10.0, "xUabsU": 0.0,
    }  # fmt: skip
    macro = ElementTree.fromstring(export.xacro_hydrodynamics(yaw))[0]
    assert macro.find("gazebo/plugin/link_name").text == "${link}"


@pytest.mark.parametrize(
    "call",
    [
        lambda: export.hydrodynamic_coefficients(AXIS, "yaw", rigid_inertia=4.0),
        lambda: export.hydrodynamic_coefficients(AXIS, "up", rigid_inertia=1.0),
        lambda: export.state_space({"alpha": 0.0}),
        lambda: export.ardusub_parameters(selfosc.tune(**AXIS, bandwidth=0.3, structure="pid")),
        lambda: export.ardusub_parameters(selfosc.tune(**AXIS, bandwidth=0.3), "surge"),
    ],
)
def test_refusals(call):
    with pytest.raises(selfosc.SelfoscError):
        call()


def test_ardusub_is_the_same_controller():
    tuned = selfosc.tune(**AXIS, bandwidth=0.3)
    found = export.ardusub_parameters(tuned)
    error, rate = 0.3, -0.2
    command = found["ATC_RAT_YAW_P"] * (found["ATC_ANG_YAW_P"] * error - rate)
    assert command == pytest.approx(tuned.gains["proportional"] * error - tuned.gains["derivative"] * rate)
