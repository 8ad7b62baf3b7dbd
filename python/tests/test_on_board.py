"""The experiment and the controller in Python are those of the command and of the library, bit for bit."""

import json
import math
import subprocess

import numpy as np
import pytest
from conftest import _command
from test_same_numbers import assert_same, bits

import selfosc

PROTOCOL = {"coordinate": "heading-rad", "relay": 0.02, "half_width": 0.2, "interval": 0.1, "resolution": 0.00175}


class Vehicle:
    """Yaw by semi-implicit Euler steps of a millisecond, rounded to a tenth of a degree; commands act after 0.2 s."""

    def __init__(self, command=0.0):
        self.yaw = self.rate = 0.0
        self.late = [command] * 200

    def reading(self):
        return round(self.yaw / 0.00175) * 0.00175

    def obey(self, command, seconds=0.1):
        for _ in range(round(1000 * seconds)):
            self.late.append(command)
            force = self.late.pop(0) + 0.002 - (0.01 + 0.06 * abs(self.rate)) * self.rate
            self.rate += 0.001 * force / 0.033
            self.yaw += 0.001 * self.rate


def experiment():
    run, vehicle, lines = selfosc.Experiment(selfosc.Protocol(**PROTOCOL)), Vehicle(), []
    for sample in range(3000):
        time_s, reading = 0.1 * sample, vehicle.reading()
        step = run.step(reading, time_s)
        lines.append((f"{time_s!r} {reading!r}", step))
        if step.phase != "running":
            break
        vehicle.obey(step.command)
    return run, lines


@pytest.mark.skipif(_command() is None, reason="the command is not built; cargo build --release first")
def test_the_state_machine_is_the_command_s(tmp_path):
    run, lines = experiment()
    assert run.phase == "done"
    flags = [f"--{name.replace('_', '-')}={value}" for name, value in PROTOCOL.items()]
    done = subprocess.run(
        [_command(), "run", *flags, "--json", "--log", tmp_path / "log.csv"],
        input="".join(line + "\n" for line, _ in lines), capture_output=True, text=True, check=False,
    )  # fmt: skip
    *answers, document = done.stdout.splitlines()
    answers = [line.split() for line in answers]
    assert done.returncode == 0
    assert len(answers) == len(lines)
    assert bits([[float(command), phase] for command, phase in answers]) == bits([list(step) for _, step in lines])
    document = json.loads(document)
    outcome = run.outcome()
    assert bits(outcome.to_dict()) == bits(document["experiment"]["outcome"])
    for axis in document["experiment"]["exact"]:
        assert bits(outcome.axis(axis["drag"])) == bits(axis)
    found = run.identify()
    assert bits(found.reported) == bits(document["reported"])
    assert bits(found.estimates) == bits(document["estimates"])
    logged = np.loadtxt(tmp_path / "log.csv", delimiter=",", skiprows=1)
    assert np.array_equal(logged, np.column_stack(list(run.record.values())))


def test_what_no_sensor_says_is_a_fault_and_neutral():
    for reading, time_s, code in [
        (None, 0.1, "not-finite"), ("north", 0.1, "not-finite"), (np.ma.masked, 0.1, "not-finite"), (1e400, 0.1, "not-finite"),
        (2.0, 0.1, "jump"), (0.0, 0.0, "time-order"), (0.0, 9.0, "gap"), (0.0, None, "not-finite"),
    ]:  # fmt: skip
        run = selfosc.Experiment(selfosc.Protocol(**PROTOCOL))
        assert run.step(np.float32(0.0), np.float64(0.0)) == (0.02, "running")
        assert run.step(reading, time_s) == (0.0, f"failed:{code}")
        assert run.command == 0.0
        assert run.outcome() is None
        assert ";" in run.fault
        run.restart()
        assert run.step(0.0, 0.0).command == 0.02
        assert run.fault is None
        assert run.tick(0.6) == (0.0, "failed:gap")
    run.restart()
    run.step(0.0, 0.0)
    run.abort()
    assert (run.phase, run.command, len(run.record["time_s"])) == ("aborted", 0.0, 1)


def test_a_protocol_is_refused_with_value_limit_and_remedy():
    for wrong, name in [
        ({"relay": -1.0}, "relay"), ({"excursion": 0.1}, "excursion"), ({"cycles": 2.5}, "cycles"),
        ({"coordinate": "depth"}, "coordinate"), ({"spread": math.nan}, "spread"), ({"attempts": -1}, "attempts"),
    ]:  # fmt: skip
        with pytest.raises(selfosc.SelfoscError, match=name) as refused:
            selfosc.Protocol(**PROTOCOL | wrong)
        assert "--" not in str(refused.value)
    with pytest.raises(selfosc.UsageError, match="Protocol"):
        selfosc.Experiment({"relay": 1.0})


def test_the_controller_holds_a_heading_and_stays_off_by_the_force():
    run, _ = experiment()
    tuned = selfosc.tune(run.identify(), ms=1.4)
    assert tuned.sensitivity["proved_upper"] <= 1.4
    controller, vehicle = selfosc.Controller(tuned, limits=(-0.02, 0.02), turn=math.tau), Vehicle()
    for _ in range(1200):
        vehicle.obey(controller.step(1.0, vehicle.reading(), 0.1).command)
    # The force that the experiment found is that of the vehicle, and the offset the one that was said.
    assert vehicle.yaw - 1.0 == pytest.approx(tuned.offset, abs=0.004)
    assert tuned.offset == pytest.approx(0.002 / tuned.gains["proportional"], rel=0.1)


def test_the_controller_s_first_steps_by_hand():
    gains = {"structure": "pd", "proportional": 2.0, "integral": 0.0, "derivative": 0.5, "filter_s": 0.1}
    controller = selfosc.Controller(gains, limits=(-5.0, 5.0), hold=0.25, neutral=1.0)
    assert controller.step(1.0, 0.0, 0.1) == (2.0, False, None)
    # The speed is that of the measurement, through a filter by a backward difference.
    speed = (0.5 - 0.0) / 0.1 * 0.1 / (0.1 + 0.1)
    assert controller.step(1.0, 0.5, 0.1).command == pytest.approx(2.0 * 0.5 - 0.5 * speed, rel=1e-15)
    held = controller.step(1.0, None, 0.1)
    assert held.fault == "measurement"
    assert held.command == pytest.approx(-0.25)
    assert controller.step(1.0, math.nan, 0.2).command == 1.0
    controller.reset()
    assert controller.step(10.0, 0.0, 0.1) == (5.0, True, None)
    with pytest.raises(selfosc.OutOfDomain, match="limit"):
        selfosc.Controller(gains, limits=(1.0, -1.0))
    with pytest.raises(selfosc.UsageError, match="limits"):
        selfosc.Controller(gains, limits=(1.0,))
    with pytest.raises(selfosc.UsageError, match="pace"):
        selfosc.Controller(gains, axis={"alpha": 1.0})


def test_a_guided_reference_needs_no_error():
    tuned = selfosc.tune(alpha=0.033, beta=0.01, beta_quadratic=0.06, delay=0.2, bandwidth=0.8)
    axis = {"alpha": 0.033, "beta": 0.01, "beta_quadratic": 0.06, "delta": 0.002, "delay_s": 0.2}
    controller, vehicle = selfosc.Controller(tuned, axis=axis, pace=0.3, top_speed=0.2), Vehicle()
    for _ in range(600):
        vehicle.obey(controller.step(1.0, vehicle.reading(), 0.1).command)
    # The feed-forward takes the force up: no offset is left but that of the sensor's step.
    assert abs(vehicle.yaw - 1.0) < 0.004


@pytest.mark.parametrize("target", [{"bandwidth": 0.5}, {"ms": 1.5}, {"phase_margin": 50.0}])
def test_tune_for_each_target(command, target):
    options = {"alpha": 0.033, "beta": 0.01, "beta_quadratic": 0.06, "delta": 0.004, "delay": 0.2, **target}
    result = selfosc.tune(alpha_interval=(0.031, 0.035), **options)
    arguments = [f"--{name.replace('_', '-')}={value!r}" for name, value in options.items()]
    assert_same(result, command("tune", "--alpha-interval=0.031,0.035", *arguments, "--json"))


def test_tune_without_a_target_or_without_inertia():
    with pytest.raises(selfosc.UsageError, match="bandwidth"):
        selfosc.tune(alpha=1.0)
    with pytest.raises(selfosc.UsageError, match="autotune"):
        selfosc.tune(alpha=0.0, beta=1.0, bandwidth=0.5)
