"""Every format gives the record that was written into it; a damaged file is refused by name."""

import log_files
import numpy as np
import pytest

import selfosc
from selfosc import logs

CASES = {
    "ulog": ("log.ulg", log_files.write_ulog, logs.read_ulog, "vehicle_attitude.yaw", "vehicle_torque_setpoint.xyz[2]", {}),
    "dataflash": ("log.bin", log_files.write_dataflash, logs.read_dataflash, "ATT.Yaw", "RCOU.C4", {"neutral": 1500, "scale": 1e-3}),
    "mcap": ("log.mcap", log_files.write_mcap, logs.read_mcap, "/imu/data.orientation.yaw", "/torque.data", {"frame": "NED"}),
    "rosbag": ("bag", log_files.write_rosbag, logs.read_rosbag, "/imu/data.orientation.yaw", "/torque.data", {"frame": "NED"}),
    "rosbag1": ("log.bag", log_files.write_rosbag1, logs.read_rosbag, "/imu/data.orientation.yaw", "/torque.data", {"frame": "NED"}),
}  # fmt: skip


@pytest.fixture(scope="module", params=CASES)
def case(request, tmp_path_factory):
    name, write, read, output, command, how = CASES[request.param]
    path = tmp_path_factory.mktemp(request.param) / name
    write(path)
    return path, read, output, command, how


def test_the_record_that_was_written(case):
    path, read, output, command, how = case
    time, heading, when, commands = log_files.channels()
    table = read(path, output, command, **how)
    assert list(table) == ["time_s", "heading", "command"]
    np.testing.assert_allclose(table["time_s"], time - time[0], atol=2e-6)
    turns = (table["heading"] - heading) / (2.0 * np.pi)
    np.testing.assert_allclose(turns, np.round(turns), atol=1e-6)
    held = commands[np.searchsorted(when, time + 1e-9, side="right") - 1]
    np.testing.assert_allclose(table["command"], held, atol=1e-8)


def test_what_the_table_says_of_itself(case):
    path, read, output, command, how = case
    said = read(path, output, command, **how).attrs
    assert said["sources"] == {"heading": output, "command": command}
    assert said["units"]["heading"] == "rad"
    assert (said["frame"], said["wrap"]) == ("NED", True)
    assert "held" in said["alignment"]


def test_identified_as_it_is(case):
    path, read, output, command, how = case
    found = selfosc.identify(read(path, output, command, **how), method="fit")
    alpha = found.reported["alpha"]
    assert alpha["value"] == pytest.approx(0.03, rel=0.01)


def largest(path):
    """The file itself, or the data of a bag."""
    return max((one for one in path.rglob("*") if one.is_file()), key=lambda one: one.stat().st_size) if path.is_dir() else path


@pytest.fixture
def damaged(case, tmp_path):
    """A copy of the log, and its largest file."""
    import shutil

    path, *rest = case
    copy = tmp_path / path.name
    shutil.copytree(path, copy) if path.is_dir() else shutil.copy(path, copy)
    return copy, largest(copy), rest


def refused(read, path, output, command, how):
    with pytest.raises(selfosc.UnreadableLog) as refusal:
        read(path, output, command, **how)
    assert str(path) in str(refusal.value) or "no " in str(refusal.value)
    return refusal.value.code


def test_a_file_of_noise(damaged):
    copy, file, (read, output, command, how) = damaged
    file.write_bytes(np.random.default_rng(3).bytes(5000))
    assert refused(read, copy, output, command, how) == "damaged"


def test_an_empty_file(damaged):
    copy, file, (read, output, command, how) = damaged
    file.write_bytes(b"")
    assert refused(read, copy, output, command, how) == "damaged"


def test_a_hole_in_the_middle(damaged):
    copy, file, (read, output, command, how) = damaged
    content = bytearray(file.read_bytes())
    middle = len(content) // 2
    content[middle : middle + 2000] = np.random.default_rng(5).bytes(2000)
    file.write_bytes(content)
    assert refused(read, copy, output, command, how) in ("damaged", "no-channel")


def test_a_file_cut_to_a_third(damaged):
    """A dataflash log may end anywhere, as power does; the others say that they are not whole."""
    copy, file, (read, output, command, how) = damaged
    content = file.read_bytes()
    file.write_bytes(content[: len(content) // 3 + 5])
    if read in (logs.read_dataflash, logs.read_ulog):
        try:
            assert len(read(copy, output, command, **how)) < 0.4 * len(log_files.channels()[0])
        except selfosc.UnreadableLog as refusal:
            assert refusal.code == "damaged"
    else:
        assert refused(read, copy, output, command, how) == "damaged"


def test_no_file_and_no_channel(case):
    path, read, output, command, how = case
    assert refused(read, path.with_name("none" + path.suffix), output, command, how) == "unreadable"
    topic = output.rpartition(".")[0]
    assert refused(read, path, "nothing.at", command, how) == "no-channel"
    assert refused(read, path, topic + ".nothing", command, how) == "no-channel"
    with pytest.raises(selfosc.UsageError):
        read(path, "nothing", command, **how)


def test_one_instance_in_its_own_unit(case):
    path, read, *_ = case
    if read is logs.read_dataflash:
        table = read(path, "ATTI[1].Yaw", "RCOU.C4")
        np.testing.assert_allclose(table["heading"], 45.0)


def test_a_stamp_of_the_logger(case):
    path, read, output, command, how = case
    if read in (logs.read_mcap, logs.read_rosbag):
        by_header, by_log = (read(path, output, command, stamp=stamp, **how) for stamp in ("header", "log"))
        assert by_header.attrs["start_s"] + 0.004 == pytest.approx(by_log.attrs["start_s"], abs=1e-6)
        with pytest.raises(selfosc.UsageError):
            read(path, output, command, stamp="moon", **how)


def channel(time, values, name="a.yaw", **more):
    return logs.Channel(name, np.asarray(time, dtype=float), np.asarray(values, dtype=float), **more)


def test_alignment_holds_and_drops():
    table = logs.align(channel([0, 1, 2, 3], [0, 0, 0, 0]), channel([0.5, 2.0], [7, 8], "b.u"))
    assert table["command"].tolist() == [7.0, 8.0, 8.0]
    assert table.attrs["start_s"] == 1.0
    assert "1 outputs before" in table.attrs["alignment"]


def test_a_clock_set_back_and_no_overlap():
    with pytest.raises(selfosc.UnreadableLog) as refusal:
        logs.align(channel([0, 2, 1], [0, 0, 0]), channel([0], [1], "b.u"))
    assert refusal.value.code == "clock"
    with pytest.raises(selfosc.UnreadableLog) as refusal:
        logs.align(channel([0, 1], [0, 0]), channel([5], [1], "b.u"))
    assert refusal.value.code == "no-overlap"


def test_frames_turn_into_each_other():
    east = channel([0], [0.0], unit="rad", frame="ENU")
    assert east.in_frame("NED").values[0] == pytest.approx(np.pi / 2)
    assert east.in_frame("NED").in_frame("ENU").values[0] == 0.0
    with pytest.raises(selfosc.UsageError):
        channel([0], [0.0]).in_frame("NED")
    with pytest.raises(selfosc.UsageError):
        channel([0], [0.0], "a.depth", frame="ENU").in_frame("NED")


def write_csv(path, record):
    path.write_text("time_s,heading,command\n" + "".join(f"{t!r},{y!r},{u!r}\n" for t, y, u in zip(*record.values(), strict=True)))


def write_parquet(path, record):
    import pyarrow as pa
    from pyarrow import parquet

    parquet.write_table(pa.table(record), path)


def write_arrow(path, record):
    import pyarrow as pa
    from pyarrow import feather

    feather.write_feather(pa.table(record), str(path))


TABLES = {
    "csv": (write_csv, {"noise": "not-text", "empty": "empty", "cut": "ragged-row"}),
    "parquet": (write_parquet, dict.fromkeys(("noise", "empty", "cut"), "damaged")),
    "arrow": (write_arrow, dict.fromkeys(("noise", "empty", "cut"), "damaged")),
}


@pytest.mark.parametrize("damage", ["noise", "empty", "cut"])
@pytest.mark.parametrize("kind", TABLES)
def test_a_damaged_table(kind, damage, record, tmp_path):
    """A CSV file is cut within a line: one that ends with a line is a shorter log."""
    path = tmp_path / f"log.{kind}"
    write, codes = TABLES[kind]
    write(path, record)
    content = path.read_bytes()
    cut = content[: len(content) // 3]
    cut = cut[: cut.rindex(b",")] if kind == "csv" else cut
    path.write_bytes({"noise": np.random.default_rng(3).bytes(5000), "empty": b"", "cut": cut}[damage])
    with pytest.raises((selfosc.UnreadableLog, selfosc.RecordRefused)) as refusal:
        selfosc.identify(path)
    assert refusal.value.code == codes[damage]
    assert path.name in str(refusal.value)
