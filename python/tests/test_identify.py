"""Identification: tables, results, refusals, interruption."""

import json
import os
import pickle
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from conftest import CORPUS, YAW

import selfosc
from selfosc._results import measured


@pytest.fixture(scope="module")
def found(record):
    return selfosc.identify(record)


def test_the_truth_is_in_the_interval(found):
    alpha = found.reported["alpha"]
    assert alpha["low"] <= 0.03 <= alpha["high"]
    assert found.trust in ("good", "widened")


def test_a_frame_of_estimates(found):
    frame = found.to_frame()
    assert frame.loc[0, "method"] == "reported"
    assert frame.loc[0, "alpha.value"] == found.reported["alpha"]["value"]
    assert len(frame) == 1 + len(found.estimates)


def test_shown_in_a_notebook(found):
    for shown in (found, selfosc.tune(found, bandwidth=0.5), selfosc.verify("lemma-1"), selfosc.predict(**YAW)):
        page, text = shown._repr_html_(), repr(shown)
        assert page.startswith("<table><caption>")
        assert page.count("<th>") <= 8
        assert max(map(len, text.splitlines())) <= 100
        assert len(text.splitlines()) <= 19


def test_gains_have_the_unit_of_their_model(found):
    tuned = selfosc.tune(found, bandwidth=0.5)
    unit = found.units["output"]
    for shown in (tuned, pickle.loads(pickle.dumps(tuned))):
        assert [f"F/{unit}", f"F s/{unit}"] == [row[2] for row in shown._table() if row[0] in ("proportional", "derivative")]
    assert "F/x" in repr(selfosc.tune(alpha=1.0, beta=1.0, bandwidth=0.5))


def test_trust_and_units_come_first(found):
    title, names, alpha, *_ = repr(found).splitlines()
    assert f"trust {found.trust}" in title
    assert names.split() == ["parameter", "practical,", "95", "%", "unit"]
    reported = found.reported["alpha"]
    practical = reported["combined"]
    farther = max(practical["high"] - reported["value"], reported["value"] - practical["low"])
    name, value, sign, error, *unit = alpha.split()
    assert (name, sign, unit) == ("alpha", "±", ["command", f"s^2/{found.units['output']}"])
    # The digits of the value are those of its error.
    assert len(value.split(".")[1]) == len(error.split(".")[1])
    assert abs(float(error) / farther - 1) < 0.06


@pytest.mark.parametrize(
    ("value", "half", "text"),
    [
        (0.033008, 0.0000897, "0.033008 ± 0.000090"), (-12345.0, 12.0, "-12345 ± 12"), (4.0e-9, 3.1e-11, "(4.000 ± 0.031)e-9"),
        (0.0, 0.5, "0.00 ± 0.50"), (1.5e12, 2.0e10, "(1.500 ± 0.020)e12"), (0.1, None, "0.1"), (2.0, 0.0, "2"),
        (0.001, 3.0, "0.0 ± 3.0"),
    ],
)  # fmt: skip
def test_digits_follow_the_uncertainty(value, half, text):
    assert measured(value, half) == text


def test_plot_and_report(found, tmp_path):
    figure = found.plot()
    figure.savefig(tmp_path / "figure.png", dpi=50)
    # Output, command and residual; an axis in its unit for each parameter.
    assert len(figure.axes) == 3 + len(found._table()[1:])
    assert all(axes.get_xscale() == "linear" for axes in figure.axes)
    assert (tmp_path / "figure.png").stat().st_size > 5_000
    assert "<svg" in found.report(tmp_path / "report.html").read_text()


def test_the_model_drawn_is_the_likeliest(found):
    drawn = next(line for line in found.plot().axes[1].lines)
    likeliest = next(one for one in found.estimates if (one["method"], one["drag"]) == ("fit", "quadratic"))
    assert np.sqrt(np.mean(np.square(drawn.get_ydata()))) == pytest.approx(likeliest["residual_rms"], rel=1e-6)


def test_a_report_over_the_log_is_refused(record_path):
    found = selfosc.identify(record_path, method="fit")
    before = record_path.read_bytes()
    with pytest.raises(selfosc.UsageError):
        found.report(record_path)
    assert record_path.read_bytes() == before


@pytest.mark.parametrize("way", ["itself", "symbolic", "hard"])
@pytest.mark.parametrize("role", ["source", "validation"])
def test_no_report_replaces_a_log_by_any_name(record_path, tmp_path, role, way):
    other, name = tmp_path / "other.csv", tmp_path / "name.csv"
    other.write_bytes(record_path.read_bytes())
    found = selfosc.identify(record_path, method="fit", validate=[other])
    log = record_path if role == "source" else other
    before = log.read_bytes()
    if way == "symbolic":
        name.symlink_to(log)
    elif way == "hard":
        name.hardlink_to(log)
    with pytest.raises(selfosc.UsageError) as refusal:
        found.report(log if way == "itself" else name)
    assert refusal.value.code == "output-is-input"
    assert log.read_bytes() == before


def test_threads_write_one_report(found, tmp_path):
    from concurrent.futures import ThreadPoolExecutor

    path = tmp_path / "report.html"
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(found.report, [path] * 64)) == [path] * 64
    assert path.read_text().rstrip().endswith("</html>")
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="the system has no named pipes")
def test_a_pipe_is_read_once(record_path, tmp_path):
    import threading

    pipe = tmp_path / "pipe.csv"
    os.mkfifo(pipe)
    threading.Thread(target=lambda: pipe.write_bytes(record_path.read_bytes()), daemon=True).start()
    found = selfosc.identify(pipe, method="fit")
    pages = [one.report(tmp_path / "report.html").read_text() for one in (found, selfosc.identify(record_path, method="fit"))]
    assert re.findall("SHA-256 [0-9a-f]+", pages[0]) == re.findall("SHA-256 [0-9a-f]+", pages[1])


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="the system has no full device")
def test_a_full_disk_is_named(found):
    with pytest.raises(selfosc.SelfoscError, match="/dev/full"):
        found.report("/dev/full")


def test_from_a_record_to_a_controller(found):
    tuned = selfosc.tune(found, bandwidth=0.5)
    assert tuned.gains["proportional"] > 0.0


def test_stages_are_heard(record):
    heard = []
    selfosc.identify(record, method="fit", progress=heard.append)
    assert heard[0] == "looking for cycles"


def test_what_progress_raises_ends_the_call(record):
    def stop(stage):
        raise RuntimeError(stage)

    with pytest.raises(RuntimeError, match="cycles"):
        selfosc.identify(record, method="fit", progress=stop)


@pytest.mark.parametrize(
    ("change", "code"),
    [
        (lambda table: {**table, "input": [None, *table["input"][1:]]}, "not-finite"),
        (lambda table: {**table, "time_s": table["time_s"][::-1]}, "time-order"),
        (lambda table: {**table, "input": table["input"][1:]}, "unequal-columns"),
        (lambda table: {name: values[:4] for name, values in table.items()}, "too-short"),
        (lambda table: {"a": [1.0]}, "unknown-column"),
        (lambda table: {**table, "input": ["on"] * len(table["input"])}, "not-a-number"),
        (lambda table: {**table, "time_s": np.array(table["time_s"]).astype("timedelta64[s]")}, "not-a-number"),
        (lambda table: [], "usage"),
        (lambda table: 7, "usage"),
        (lambda table: "no-such-file.csv", "unreadable"),
        (lambda table: "no-such-file.parquet", "unreadable"),
        (lambda table: "flight.ulg", "channels"),
    ],
)
def test_refusals(record, change, code):
    with pytest.raises(selfosc.SelfoscError) as refusal:
        selfosc.identify(change(record))
    assert refusal.value.code == code


def test_a_damaged_parquet_file(tmp_path):
    path = tmp_path / "log.parquet"
    path.write_bytes(b"PAR1" + bytes(64))
    with pytest.raises(selfosc.UnreadableLog) as refusal:
        selfosc.identify(path)
    assert refusal.value.code == "damaged"


@pytest.mark.parametrize(
    "settings",
    [{"method": "guess"}, {"drag": "cubic"}, {"delay": -1.0}, {"relay": float("nan")}, {"relay": -1.0}, {"colour": "red"}],
)
def test_wrong_settings(record, settings):
    with pytest.raises(selfosc.SelfoscError):
        selfosc.identify(record, **settings)


def test_bounds_hold_the_truth():
    record = selfosc.simulate(alpha=1, beta=0.5, relay=1, half_width=0.3, cycles=4, hold=True, quantum=0.02)
    low, high = selfosc.bounded(record, delay=0.0, budget=200).of("alpha")
    assert low <= 1.0 <= high
    with pytest.raises(selfosc.UsageError, match="no argument colour"):
        selfosc.bounded(record, colour=3)


def test_a_reading_in_error_is_found():
    record = selfosc.simulate(alpha=1, beta=0.5, relay=1, half_width=0.3, cycles=4, hold=True, quantum=0.02)
    record["output"][60] += 0.2
    assert selfosc.bounded(record, delay=0.0).verdict == "refuted"
    found = selfosc.bounded(record, delay=0.0, outliers=1)
    low, high = found.of("alpha")
    assert found.verdict == "consistent"
    assert low <= 1.0 <= high
    assert [(one["record"], one["sample"]) for one in found.outliers] == [(0, 60)]


INTERRUPTED = """
import signal, time, selfosc
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs begin with interrupts ignored
record = selfosc.simulate(alpha=1, beta_quadratic=0.5, relay=1, half_width=0.3, cycles=400, rate=200, noise=0.01)
print("ready", flush=True)
try:
    selfosc.identify(record, progress=lambda stage: print("at", time.monotonic(), flush=True))
except KeyboardInterrupt:
    print("interrupted", time.monotonic(), flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to another process")
def test_an_interrupt_ends_a_long_call():
    """Half a minute of work; how soon it ends is measured, and printed, not asserted to the millisecond."""
    child = subprocess.Popen([sys.executable, "-c", INTERRUPTED], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline().startswith("ready")
    assert child.stdout.readline().startswith("at")
    time.sleep(0.5)
    sent = time.monotonic()
    os.kill(child.pid, signal.SIGINT)
    words = child.stdout.readline().split()
    while words and words[0] == "at":
        words = child.stdout.readline().split()
    child.kill()
    child.wait()
    assert words[0] == "interrupted"
    print(f"ended {float(words[1]) - sent:.3f} s after the interrupt")


def test_other_threads_run_meanwhile(record):
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(2) as pool:
        documents = list(pool.map(lambda _: json.dumps(selfosc.identify(record, method="fit").to_dict()), range(2)))
    assert documents[0] == documents[1]


def test_the_corpus_gives_a_model_or_a_named_refusal():
    for path in sorted(CORPUS.glob("*.*")):
        try:
            assert selfosc.identify(path).to_dict()["record"]["samples"] > 0
        except selfosc.SelfoscError as refusal:
            assert refusal.code
