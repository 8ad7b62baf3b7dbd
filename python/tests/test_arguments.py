"""Arguments that are none: the package's own error, in Python's words, with the nearest name."""

import inspect
import io
import re

import log_files
import numpy as np
import pytest
from conftest import YAW

import selfosc

HUGE = 10**400
AXIS = {"alpha": 1.0, "beta": 0.5}
PROTOCOL = selfosc.Protocol(relay=0.1, half_width=0.2, interval=0.1)

CALLS = {
    "predict": lambda bad: selfosc.predict(**{**YAW, "alpha": bad}),
    "simulate": lambda bad: selfosc.simulate(**{**YAW, "delay": bad}),
    "seed": lambda bad: selfosc.simulate(**YAW, seed=bad),
    "tune": lambda bad: selfosc.tune(**AXIS, bandwidth=bad),
    "interval": lambda bad: selfosc.tune(**AXIS, bandwidth=0.5, alpha_interval=(0.9, bad)),
    "model": lambda bad: selfosc.tune(bad, bandwidth=0.5),
    "design": lambda bad: selfosc.design(**AXIS, level=bad, time=60.0),
    "balance": lambda bad: selfosc.balance(([8], [1, 2, 2, bad]), "saturation", breakpoint=1),
    "plant": lambda bad: selfosc.balance(bad, "saturation", breakpoint=1),
    "certify": lambda bad: selfosc.certify(([1], [1, 1, 0]), selfosc.nonlinearity("relay"), period_s=(0.1, bad)),
    "relay of certify": lambda bad: selfosc.certify(([1], [1, 1, 0]), bad),
    "df": lambda bad: selfosc.df("relay", bad),
    "name": lambda bad: selfosc.df(bad, 1.0),
    "describing_function": lambda bad: selfosc.describing_function("relay", bad),
    "bias": lambda bad: selfosc.describing_function("relay", [1.0, 2.0], [0.0, bad]),
    "parameter": lambda bad: selfosc.nonlinearity("relay", level=bad),
    "points": lambda bad: selfosc.nonlinearity("piecewise-linear", points=[(0.0, bad)]),
    "input": lambda bad: selfosc.nonlinearity("relay")(bad),
    "gain": lambda bad: selfosc.amplitudes("relay", bad),
    "fit": lambda bad: selfosc.fit_characteristic([1.0, 2.0, 3.0], [1.0, 0.5, bad]),
    "cases": lambda bad: selfosc.verify("lemma-1", cases=bad),
    "out": lambda bad: selfosc.reproduce(["table4"], out=bad),
    "pade": lambda bad: selfosc.export.state_space({"alpha": bad}),
    "inertia": lambda bad: selfosc.export.hydrodynamic_coefficients(AXIS, "yaw", rigid_inertia=bad),
    "exported": lambda bad: selfosc.export.ardusub_parameters(bad),
}  # fmt: skip
IDENTIFY = ["relay", "half_width", "delay", "error", "quantum", "jitter_s", "outliers", "budget", "neutral", "from_s", "part"]
CALLS |= {
    f"identify {name}": lambda bad, name=name: selfosc.identify({"t": [0.0]}, **{name: bad})
    for name in [*IDENTIFY, "time", "drag", "method", "time_unit"]
}
CALLS |= {f"bounded {name}": lambda bad, name=name: selfosc.bounded({"t": [0.0]}, **{name: bad}) for name in ("delay", "reach", "law")}


BAD = {"huge": HUGE, "-huge": -HUGE, "complex": 1 + 2j, "complex64": np.complex64(1j), "bytes": b"\xff", "object": object()}


@pytest.mark.parametrize("bad", BAD.values(), ids=BAD.keys())
@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS.keys())
def test_no_number(call, bad):
    if call is CALLS["out"] and isinstance(bad, bytes):
        pytest.skip("a path may have any bytes")
    with pytest.raises(selfosc.SelfoscError) as refusal:
        call(bad)
    assert len(str(refusal.value)) < 1000


def test_a_huge_reading(record):
    with pytest.raises(selfosc.RecordRefused) as refusal:
        selfosc.identify({**record, "heading_deg": [HUGE, *record["heading_deg"][1:]]})
    assert refusal.value.code == "not-a-number"


def test_numpys_own_numbers_are_numbers(record):
    found = selfosc.identify(record, method="fit", delay=np.float32(0.25), part=np.int64(1), outliers=np.int8(0))
    assert found == selfosc.identify(record, method="fit", delay=0.25, part=1)


def test_a_frame_without_rows_yet(record):
    import polars as pl

    with pytest.raises(selfosc.UsageError, match="collect it first"):
        selfosc.identify(pl.DataFrame(record).lazy())


@pytest.mark.parametrize("path", [b"no\xff.csv", "no\udcff.csv", "a\0b.csv", "no\udcff.parquet"])
def test_paths_of_any_bytes(path, record, tmp_path):
    for call in (
        lambda: selfosc.identify(path),
        lambda: selfosc.bounded(path),
        lambda: selfosc.identify(record, method="fit", validate=[path]),
        lambda: selfosc.identify(record, method="fit", validate=path),
        lambda: selfosc.logs.read_ulog(path, "a.b", "c.d"),
        lambda: selfosc.logs.read_dataflash(path, "a.b", "c.d"),
        lambda: selfosc.logs.read_mcap(path, "a.b", "c.d"),
        lambda: selfosc.logs.read_rosbag(path, "a.b", "c.d"),
    ):
        with pytest.raises(selfosc.SelfoscError) as refusal:
            call()
        assert str(refusal.value).encode()
    with pytest.raises(selfosc.SelfoscError):
        selfosc.identify(record, method="fit").report("no-folder\udcff/a.html" if "\0" not in str(path) else path)


def test_a_log_and_a_report_named_in_bytes(record_path, tmp_path):
    log, page = bytes(tmp_path) + b"/log\xff.csv", bytes(tmp_path) + b"/page\xfe.html"
    with open(log, "wb") as file:
        file.write(record_path.read_bytes())
    found = selfosc.identify(log, method="fit", validate=log)
    assert found.report(page).read_text().startswith("<!")


@pytest.mark.parametrize(
    "channel",
    ["", ".", "a", "a.", None, b"vehicle_attitude.yaw", 3, "[0].yaw", "vehicle_attitude.q[9]", "vehicle_atitude.yaw", "ATT[0].Yaw",
     "ATT[x].Yaw", "ATTI[9].Yaw",
     *(f"vehicle_attitude[{number}.yaw" for number in ("", "0", "]", "x]", "-1]", "9]", "²]", "9" * 20 + "]"))],
)  # fmt: skip
@pytest.mark.parametrize("kind", ["ulog", "dataflash"])
def test_names_of_channels(channel, kind, tmp_path):
    write, read, good = {
        "ulog": (log_files.write_ulog, selfosc.logs.read_ulog, "vehicle_torque_setpoint.xyz[2]"),
        "dataflash": (log_files.write_dataflash, selfosc.logs.read_dataflash, "RCOU.C4"),
    }[kind]
    write(tmp_path / "log")
    for names in ((channel, good), (good, channel)):
        with pytest.raises(selfosc.SelfoscError):
            read(tmp_path / "log", *names)


def test_a_channel_nearly_named(tmp_path):
    log_files.write_ulog(tmp_path / "log.ulg")
    with pytest.raises(selfosc.UnreadableLog, match=r"did you mean vehicle_attitude\?"):
        selfosc.logs.read_ulog(tmp_path / "log.ulg", "vehicle_atitude.yaw", "vehicle_torque_setpoint.xyz[2]")


@pytest.mark.parametrize(
    ("call", "meant"),
    [
        (lambda: selfosc.identify({}, dely=0.1), "delay"),
        (lambda: selfosc.identify({}, halfwidth=0.1), "half_width"),
        (lambda: selfosc.bounded({}, outlier=1), "outliers"),
        (lambda: selfosc.predict(alpa=1.0), "alpha"),
        (lambda: selfosc.tune(bandwith=1.0), "bandwidth"),
        (lambda: selfosc.export.state_space({"alpha": 1.0}, sped=1.0), "speed"),
        (lambda: selfosc.logs.read_mcap("a", "b.c", "d.e", wrp=True), "wrap"),
        (lambda: selfosc.nonlinearity("relay", leve=1.0), "level"),
        (lambda: selfosc.nonlinearity("relay-hysteresi"), "relay-hysteresis"),
        (lambda: selfosc.fleet.identify_record({}, dely=0.1), "delay"),
        (lambda: selfosc.Controller(selfosc.tune(**AXIS, bandwidth=0.3), limts=(-1, 1)), "limits"),
        (lambda: selfosc.Controller(selfosc.tune(**AXIS, bandwidth=0.3)).step(refrence=1, measurement=0, dt_s=0.1), "reference"),
        (lambda: selfosc.Protocol(relay=0.1, half_width=0.2, intervall=0.1), "interval"),
        (lambda: selfosc.Experiment(protokol=PROTOCOL), "protocol"),
        (lambda: selfosc.Experiment(PROTOCOL).step(redaing=0.0, time_s=0.0), "reading"),
    ],
)  # fmt: skip
def test_an_argument_nearly_named(call, meant):
    with pytest.raises(selfosc.UsageError) as refusal:
        call()
    assert meant in str(refusal.value)
    assert "did you mean" in str(refusal.value)


@pytest.mark.parametrize(
    ("of", "name", "meant"),
    [
        (lambda: selfosc.predict(**YAW), "exct", "exact"),
        (lambda: selfosc.tune(**AXIS, bandwidth=0.3), "gain", "gains"),
        (lambda: selfosc.predict(**YAW), "to_fram", "to_frame"),
        (lambda: selfosc.Controller(selfosc.tune(**AXIS, bandwidth=0.3)), "rset", "reset"),
        (lambda: selfosc.Experiment(PROTOCOL), "phse", "phase"),
        (lambda: PROTOCOL, "intervall", "interval"),
        (lambda: selfosc.nonlinearity("relay"), "paramters", "parameters"),
        (lambda: selfosc, "identfy", "identify"),
        (lambda: selfosc, "fleat", "fleet"),
    ],
)
def test_an_attribute_nearly_named(of, name, meant):
    with pytest.raises(AttributeError, match=rf"did you mean {meant}\?"):
        getattr(of(), name)


def test_a_type_error_of_the_user_s_own_is_left_alone():
    def wrong(x):
        raise TypeError("mine")

    with pytest.raises(TypeError, match="mine"):
        selfosc.describing_function(wrong, 1.0)


def test_parts_of_the_package_need_no_import():
    import subprocess
    import sys

    code = "import sys, selfosc; assert 'pyarrow' not in sys.modules and 'pandas' not in sys.modules; "
    code += "selfosc.logs.read_ulog; selfosc.export.state_space; selfosc.types.Reported; selfosc.fleet.SCHEMA; "
    code += "assert {'fleet', 'logs', 'export'} <= set(dir(selfosc))"
    subprocess.run([sys.executable, "-c", code], check=True)


#: Refusals with remedies, by the calls that meet them.
REMEDIES = [
    lambda log: selfosc.identify(log, method="iso", drag="mixed"),
    lambda log: selfosc.identify(log, method="fit", stiffness=True),
    lambda log: selfosc.identify(log, relay=-1.0),
    lambda log: selfosc.identify(log, half_width=-1.0),
    lambda log: selfosc.identify(log, delay=-1.0),
    lambda log: selfosc.identify(log, time_unit="d"),
    lambda log: selfosc.identify(log, part=7),
    lambda log: selfosc.identify(log, from_s=1e9),
    lambda log: selfosc.identify(log, input="none"),
    lambda log: selfosc.identify(log, input="time_s"),
    lambda log: selfosc.identify(log, quantum=-1.0, method="bounded"),
    lambda log: selfosc.identify({**log, "time_s": [0.0, *log["time_s"][:-1]]}),
    lambda log: selfosc.identify({**log, "input": [float("nan"), *log["input"][1:]]}),
    lambda log: selfosc.identify({**log, "input": [0.0] * len(log["input"])}),
    lambda log: selfosc.identify({name: values[:9] for name, values in log.items()}),
    lambda log: selfosc.predict(alpha=1.0, relay=-1.0, half_width=0.1),
    lambda log: selfosc.predict(alpha=1.0, relay=1.0, half_width=0.1),
    lambda log: selfosc.tune(alpha=1.0, beta=0.5, delay=2.0, bandwidth=9.0),
    lambda log: selfosc.tune(alpha=1.0, beta=0.5, bandwidth=1.0, structure="p"),
    lambda log: selfosc.tune(alpha=1.0, bandwidth=1.0, alpha_interval=(2.0, 3.0)),
    lambda log: selfosc.design(alpha=1.0, level=1.0, time=0.1),
    lambda log: selfosc.simulate(**YAW, cycles=-1.0),
    lambda log: selfosc.simulate(**YAW, rate=0.0),
    lambda log: selfosc.simulate(**YAW, cycles=1e12),
    lambda log: selfosc.balance(([1], [1, 1]), "nothing"),
    lambda log: selfosc.balance(([1, 1, 1], [1, 1]), "relay"),
    lambda log: selfosc.df("relay", -1.0),
    lambda log: selfosc.df("relay", 1.0, method="guess"),
    lambda log: selfosc.df("saturation", 1.0),
    lambda log: selfosc.amplitudes("relay", float("nan")),
    lambda log: selfosc.verify("lemma-0"),
    lambda log: selfosc.reproduce(["table5"]),
]


@pytest.mark.parametrize("call", REMEDIES)
def test_messages_name_python_s_arguments(record, call):
    try:
        call(record)
    except selfosc.SelfoscError as refusal:
        text = str(refusal)
    else:
        pytest.fail("there is no refusal")
    print(text)
    assert "--" not in text
    assert "Usage:" not in text
    assert "<" not in text
    assert "at line 1 column" not in text
    functions = (selfosc.identify, selfosc.predict, selfosc.tune, selfosc.design, selfosc.simulate, selfosc.df, selfosc.balance)
    known = {name for function in functions for name in inspect.signature(function).parameters}
    # What stands in the parentheses of a remedy as name=value is an argument.
    assert {name for name in re.findall(r"[(,] ?(\w+)=", text)} <= known


#: Wrong kinds of arguments, of which no foreign error may come.
WRONG = [
    lambda log: selfosc.identify(log, degrees="no"),
    lambda log: selfosc.identify(log, degrees=True, radians=True),
    lambda log: selfosc.identify(log, validate=3),
    lambda log: selfosc.identify(log, progress=3),
    lambda log: selfosc.identify(log, output=1),
    lambda log: selfosc.identify(log, output="heding_deg"),
    lambda log: selfosc.identify(log, part=0),
    lambda log: selfosc.identify(log, relay=float("nan")),
    lambda log: selfosc.identify(log, assume={"clock": float("nan")}),
    lambda log: selfosc.identify(log, skip_bad_rows=np.array([1, 2])),
    lambda log: selfosc.identify({}),
    lambda log: selfosc.identify(""),
    lambda log: selfosc.identify(io.StringIO("t,y,u")),
    lambda log: selfosc.identify({**log, "input": ["0.1"] * len(log["input"])}),
    lambda log: selfosc.bounded(log, delay=(0.3, 0.1)),
    lambda log: selfosc.bounded(log, delay=(0.1, 0.2, 0.3)),
    lambda log: selfosc.tune(**AXIS, ms="1.4"),
    lambda log: selfosc.tune(**AXIS),
    lambda log: selfosc.tune(**AXIS, ms=1.4, bandwidth=1.0),
    lambda log: selfosc.design(**AXIS, level=1.0, time=60, delay_known="yes"),
    lambda log: selfosc.predict(alpha="1", relay=1, half_width=0.1),
    lambda log: selfosc.predict(alpha=None, relay=1, half_width=0.1),
    lambda log: selfosc.predict(alpha=True, relay=1, half_width=0.1),
    lambda log: selfosc.predict(alpha=[1.0], relay=1, half_width=0.1),
    lambda log: selfosc.simulate(**YAW, hold="yes"),
    lambda log: selfosc.balance(([], []), "relay"),
    lambda log: selfosc.balance(([1], [1, 1]), None),
    lambda log: selfosc.df("relay", [1, 2]),
    lambda log: selfosc.df("saturation", 1, breakpoint="wide"),
    lambda log: selfosc.describing_function("relay", "1"),
    lambda log: selfosc.describing_function(abs, 1.0, kinks=[float("nan")]),
    lambda log: selfosc.describing_function(lambda x: "a", 1.0),
    lambda log: selfosc.nonlinearity("relay")("1"),
    lambda log: selfosc.amplitudes("relay", "1"),
    lambda log: selfosc.fit_characteristic([], []),
    lambda log: selfosc.fit_characteristic([1, 2, 3], [1, float("nan"), 2]),
    lambda log: selfosc.fit_characteristic([1, 2, 3], [1, 2, 3], bias=None),
    lambda log: selfosc.verify(3),
    lambda log: selfosc.verify("lemma-1", cases=10)[0],
    lambda log: selfosc.reproduce(4),
    lambda log: selfosc.reproduce(["tabel4"]),
    lambda log: selfosc.autotune({"time": [1, 2, 3], "temperature": [1, 2], "heater": [0, 1, 0]}),
    lambda log: selfosc.Protocol(relay="0.1", half_width=0.2, interval=0.1),
    lambda log: selfosc.Controller(None),
    lambda log: selfosc.Controller({}),
    lambda log: selfosc.Controller(selfosc.tune(**AXIS, bandwidth=0.3), limits=(-1, 0, 1)),
    lambda log: selfosc.Controller(selfosc.tune(**AXIS, bandwidth=0.3), axis=[1.0], pace=1.0),
    lambda log: selfosc.Controller(selfosc.tune(**AXIS, bandwidth=0.3), axis={"alpa": 1.0}, pace=1.0),
    lambda log: selfosc.export.state_space({"alpha": 1.0, "beeta": 2.0}),
    lambda log: selfosc.export.state_space({"alpha": 1.0}, speed=float("nan")),
    lambda log: selfosc.export.state_space({"alpha": 1.0, "delay": 0.1}, pade=-1),
    lambda log: selfosc.export.hydrodynamic_coefficients(AXIS, ["yaw"], 0.01),
    lambda log: selfosc.export.hydrodynamic_coefficients(AXIS, "yaw", -5),
    lambda log: selfosc.export.gazebo_hydrodynamics(3, "base"),
    lambda log: selfosc.export.gazebo_hydrodynamics({"nR": "a"}, "base"),
    lambda log: selfosc.export.gazebo_hydrodynamics({"nR": -1.0}, None),
    lambda log: selfosc.export.xacro_hydrodynamics({"nR": -1.0}, name=3),
    lambda log: selfosc.fleet.identify_record(None),
    lambda log: selfosc.fleet.identify_tables(3),
    lambda log: selfosc.fleet.identify_dask([], None),
    lambda log: selfosc.logs.align(None, None),
    lambda log: selfosc.logs.Channel("a.yaw", np.arange(3.0), np.arange(2.0)),
    lambda log: selfosc.balance(([8], [1, 2, 2, 1]), "saturation", breakpoint=1).plot().save("/no-folder/a.svg"),
]


@pytest.mark.parametrize("call", WRONG)
def test_wrong_kinds_are_refused_with_a_remedy(record, call):
    with pytest.raises(selfosc.SelfoscError, match=r"; |did you mean") as refusal:
        call(record)
    assert "at line 1 column" not in str(refusal.value)
