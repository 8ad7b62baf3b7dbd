"""The package and the command give the same document, bit for bit: JSON has every digit, so text is compared through floats."""

import json
import pickle
import struct

import pytest
from conftest import CORPUS, YAW

import selfosc


def bits(document):
    """The document with every float as its bits, so that -0.0 is not 0.0."""
    if isinstance(document, dict):
        return {name: bits(value) for name, value in document.items()}
    if isinstance(document, list):
        return [bits(value) for value in document]
    return struct.pack("<d", document).hex() if isinstance(document, float) else document


def assert_same(result, printed):
    status, text = printed
    assert status == 0
    assert bits(result.to_dict() if hasattr(result, "to_dict") else result) == bits(json.loads(text))


def flags(options):
    return [f"--{name.replace('_', '-')}={value!r}" for name, value in options.items()]


@pytest.mark.parametrize("method", ["closed-form", "quadrature", "certified"])
def test_df(command, method):
    result = selfosc.df("relay-hysteresis", 1.1, 0.1, method=method, level=2.0, half_width=0.3)
    options = ["--set=level=2", "--set=half_width=0.3", "--amplitude=1.1", "--bias=0.1", f"--method={method}", "--json"]
    assert_same(result, command("df", "relay-hysteresis", *options))


def test_df_of_an_array_is_the_command_s(command):
    third = 1.0 / 3.0
    found = selfosc.describing_function("saturation-asymmetric", [0.7, 2.0], third, lower=-1.0, upper=0.5)
    for place, amplitude in enumerate([0.7, 2.0]):
        options = ["--set=lower=-1", "--set=upper=0.5", f"--amplitude={amplitude}", f"--bias={third!r}", "--json"]
        document = json.loads(command("df", "saturation-asymmetric", *options)[1])
        assert bits([float(part[place]) for part in found]) == bits([document["f0"], document["p"], document["q"]])


def test_points_of_a_graph(command):
    points = [(-1.0, -1.0), (0.0, 0.0), (1.0, 2.0)]
    result = selfosc.df("piecewise-linear", 2.0, points=points, left_slope=0.0, right_slope=0.1)
    options = ["--set=points=-1:-1,0:0,1:2", "--set=left_slope=0", "--set=right_slope=0.1", "--amplitude=2", "--json"]
    assert_same(result, command("df", "piecewise-linear", *options))


def test_the_catalogue(command):
    listed = json.loads(command("df", "--list", "--json")[1])
    assert selfosc.catalogue() == {entry["name"]: entry["parameters"] for entry in listed}


@pytest.mark.parametrize("bias", [0.0, 0.1])
def test_amplitudes_that_have_a_gain(command, bias):
    result = selfosc.amplitudes("relay-dead-zone", 1.0 / 3.0, bias, level=2.0, dead_zone=0.5)
    options = ["--set=level=2", "--set=dead_zone=0.5", f"--gain={1.0 / 3.0!r}", f"--bias={bias}", "--json"]
    assert_same(result, command("df", "relay-dead-zone", *options))
    assert bits(list(selfosc.amplitudes(selfosc.nonlinearity("relay-dead-zone", level=2, dead_zone=0.5), 1 / 3, bias))) == bits(
        result.to_dict()["amplitudes"]
    )


def test_no_amplitude_has_the_gain(command):
    status, text = command("df", "relay-dead-zone", "--set=dead_zone=0.5", "--gain=2", "--json")
    result = selfosc.amplitudes("relay-dead-zone", 2.0, dead_zone=0.5)
    assert (status, len(result)) == (1, 0)
    assert bits(result.to_dict()) == bits(json.loads(text))


def test_a_characteristic_that_has_the_gains(command, tmp_path):
    wide = [0.2, 0.5, 0.8, 1.1, 1.6, 2.5, 4.0]
    gains = selfosc.describing_function("saturation", wide, 0.1, slope=2.0, breakpoint=0.7).p
    rows = "".join(f"{x!r},{float(y)!r}\n" for x, y in zip(wide, gains, strict=True))
    (tmp_path / "gains.csv").write_text("amplitude,p\n" + rows)
    result = selfosc.fit_characteristic(wide, gains, 0.1)
    assert_same(result, command("df", f"--fit={tmp_path / 'gains.csv'}", "--bias=0.1", "--json"))
    assert result[0]["residual"] == min(one["residual"] for one in result)


def test_balance(command, tmp_path):
    result = selfosc.balance(([8], [1, 2, 2, 1]), "saturation", breakpoint=1, delay=0.1)
    options = ["--num=8", "--den=1,2,2,1", "--delay=0.1", "--nonlinearity=saturation", "--set=breakpoint=1", "--json"]
    assert_same(result, command("balance", *options))
    figure = tmp_path / "nyquist.svg"
    command("balance", *options, f"--svg={figure}")
    assert result.plot().svg == figure.read_text()
    result.plot().save(tmp_path / "saved.svg")
    assert (tmp_path / "saved.svg").read_text() == pickle.loads(pickle.dumps(result)).plot()._repr_svg_() == figure.read_text()


@pytest.mark.parametrize("delta", [0.0, 0.011])
def test_predict(command, delta):
    assert_same(selfosc.predict(**YAW, delta=delta), command("predict", *flags(YAW), f"--delta={delta}", "--json"))


def test_simulate(command):
    options = [*flags(YAW), "--hold", "--noise=0.01", "--quantum=0.0175", "--seed=7", "--degrees", "--cycles=4", "--json"]
    result = selfosc.simulate(**YAW, hold=True, noise=0.01, quantum=0.0175, seed=7, degrees=True, cycles=4)
    assert_same(result, command("simulate", *options))


@pytest.mark.parametrize("options", [{}, {"method": "fit", "delay": 0.2}, {"drag": "quadratic", "relay": 0.16}])
def test_identify(command, record_path, options):
    result = selfosc.identify(record_path, **options)
    assert_same(result, command("identify", record_path, *[f"--{name}={value}" for name, value in options.items()], "--json"))


def test_identify_from_every_kind_of_table(command, record, record_path):
    """A table in memory differs from its file in the record's name alone."""
    import pandas as pd
    import polars as pl
    import pyarrow as pa

    expected = bits(json.loads(command("identify", record_path, "--method=fit", "--json")[1]))
    expected["records"][0]["file"] = "record"
    for make in (dict, pd.DataFrame, pl.DataFrame, pa.table):
        assert bits(selfosc.identify(make(record), method="fit").to_dict()) == expected


def test_identify_from_parquet(command, record, record_path, tmp_path):
    import pyarrow as pa
    from pyarrow import feather, parquet

    expected = bits(json.loads(command("identify", record_path, "--method=fit", "--json")[1]))
    parquet.write_table(pa.table(record), tmp_path / "log.parquet")
    feather.write_feather(pa.table(record), str(tmp_path / "log.arrow"))
    for name in ("log.parquet", "log.arrow"):
        expected["records"][0]["file"] = str(tmp_path / name)
        assert bits(selfosc.identify(tmp_path / name, method="fit").to_dict()) == expected


def test_identify_several(command):
    logs = [CORPUS / "noisy.csv", CORPUS / "heading.csv"]
    status, text = command("identify", *logs, "--method=fit", "--json")
    try:
        found = selfosc.identify(logs, method="fit").to_dict()
    except selfosc.SelfoscError as refusal:
        assert status == 1
        assert json.loads(text)["refused"] == {"code": refusal.code, "text": str(refusal)}
    else:
        assert status == 0
        assert bits(found) == bits(json.loads(text))


@pytest.mark.parametrize("name", ["broken.csv", "standstill.csv"])
def test_a_refusal_is_the_command_s(command, name):
    status, text = command("identify", CORPUS / name, "--json")
    with pytest.raises(selfosc.RecordRefused) as refusal:
        selfosc.identify(CORPUS / name)
    assert status in (1, 2)
    said = json.loads(text)["refused"]
    assert said["code"] == refusal.value.code
    # The remedy is each one's own.
    remedies = {"--skip-bad-rows": "skip_bad_rows=True", "--wrap": "wrap=True", "--output COL": "output=COL", "--any-input": "any_input=True"}
    for flag, argument in remedies.items():
        said["text"] = said["text"].replace(flag, argument)
    assert said["text"] == str(refusal.value)


def test_tune(command):
    options = {"alpha": 0.033, "beta": 0.01, "beta_quadratic": 0.06, "delay": 0.2, "bandwidth": 0.8}
    assert_same(selfosc.tune(**options), command("tune", *flags(options), "--json"))
    result = selfosc.tune(**options, structure="pid", alpha_interval=(0.031, 0.035))
    assert_same(result, command("tune", *flags(options), "--structure=pid", "--alpha-interval=0.031,0.035", "--json"))


def test_design(command):
    options = {"alpha": 1.0, "beta_quadratic": 0.5, "delay": 0.1, "level": 1.0, "time": 60.0, "quantum": 0.0175}
    assert_same(selfosc.design(**options), command("design", *flags(options), "--json"))


def test_identify_with_bounds_and_a_part_of_the_log(command, record_path):
    result = selfosc.identify(record_path, method="bounded", delay=0.2, to_s=20.0)
    assert_same(result, command("identify", record_path, "--method=bounded", "--delay=0.2", "--to=20", "--json"))


def test_identify_and_validate(command, record_path):
    result = selfosc.identify(record_path, method="fit", from_s=10.0, validate=[record_path], invert=False)
    assert_same(result, command("identify", record_path, "--method=fit", "--from=10", "--validate", record_path, "--json"))


def test_verify(command):
    claims = ["lemma-1", "theorem-2"]
    result = selfosc.verify(*claims, cases=200, seed=7)
    assert_same(result, command("verify", "--claim", *claims, "--cases=200", "--seed=7", "--json"))
    assert result.as_stated


def test_reproduce(command, tmp_path):
    assert_same(selfosc.reproduce(["table4", "audit"], out=tmp_path), command("reproduce", "--only", "table4", "audit", "--json"))
    assert (tmp_path / "report.html").read_text().startswith("<!")
