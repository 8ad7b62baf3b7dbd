"""A type checker finds wrong arguments and fields, and what it is told of the documents is so."""

import importlib.util
import json
import shutil
import subprocess
import sys
import typing

import pytest
from conftest import CORPUS, ROOT, YAW
from typeguard import CollectionCheckStrategy, ForwardRefPolicy, TypeCheckError, check_type

import selfosc

#: Lines that end with `# wrong` must be found, no other may be.
USED = """
from typing import assert_type

import selfosc
from selfosc import types

found = selfosc.identify("log.csv", delay=0.1, drag="quadratic", validate=["other.csv"])
selfosc.identify("log.csv", dely=0.1)  # wrong
selfosc.identify("log.csv", drag="cubic")  # wrong
selfosc.identify("log.csv", delay=[0.1])  # wrong
selfosc.identify("log.csv", method="guess")  # wrong
selfosc.bounded("log.csv", outlier=1)  # wrong
selfosc.predict(alpa=1.0, relay=1.0, half_width=0.1)  # wrong
selfosc.predict(alpha="1", relay=1.0, half_width=0.1)  # wrong
selfosc.tune(found, bandwith=0.5)  # wrong

assert_type(found.reported, types.Reported | None)
found.reported["alpha"]  # wrong
assert found.reported is not None
assert_type(found.reported["alpha"]["value"], float)
assert_type(found.trust, types.Trust | None)
found.reported["alpa"]  # wrong
found.reported["alpha"]["median"]  # wrong
found.reportd  # wrong
found.estimates[0]["alpha"]["low"] + 1.0  # wrong

gains = selfosc.autotune("heater.csv", ms=1.6).gains
assert gains is not None
assert_type(gains["proportional"], float)
selfosc.autotune("heater.csv", form="arduino")  # wrong

tuned = selfosc.tune(found, bandwidth=0.5)
assert_type(tuned.gains["proportional"], float)
tuned.gain  # wrong
selfosc.tune(found, ms=1.4, phase_margin="45")  # wrong
protocol = selfosc.Protocol(relay=0.1, half_width=0.2, interval=0.1, coordinate="depth")  # wrong
experiment = selfosc.Experiment(selfosc.Protocol(relay=0.1, half_width=0.2, interval=0.1))
assert_type(experiment.step(0.0, 0.0).command, float)
experiment.stop()  # wrong
outcome = experiment.outcome()
outcome.features  # wrong
assert outcome is not None
assert_type(outcome.features["period_s"]["mean"], float)
assert_type(outcome.axis("quadratic")["alpha"], float)
selfosc.Controller(tuned, turn="360")  # wrong
cycle = selfosc.predict(alpha=1.0, beta=1.0, relay=1.0, half_width=0.2)
assert_type(cycle.exact["period_s"], float)
cycle.certificate["unique"]  # wrong
for orbit in selfosc.certify(([1], [1, 1, 0]), selfosc.nonlinearity("relay")):
    assert_type(orbit["attracting"], bool | None)
selfosc.fleet.SCHEMA
selfosc.logs.read_ulog("log.ulg", "a.b", "c.d")
selfosc.export.state_space(found)
selfosc.identfy  # wrong
"""


def by_mypy(cache, *arguments):
    call = [sys.executable, "-m", "mypy", "--ignore-missing-imports", "--cache-dir", cache, *arguments]
    return subprocess.run(call, capture_output=True, text=True, check=False)


def mypy(path):
    said = by_mypy(path.parent / "cache", "--strict", "--output=json", path)
    assert not said.stderr, said.stderr
    return {one["line"]: one["message"] for one in map(json.loads, said.stdout.splitlines()) if one["severity"] == "error"}


def pyright(path):
    call = [sys.executable, "-m", "pyright", "--outputjson", "--pythonpath", sys.executable, path]
    said = subprocess.run(call, capture_output=True, text=True, check=False).stdout
    found = json.loads(said[said.index("{") :])["generalDiagnostics"]
    return {one["range"]["start"]["line"] + 1: one["message"] for one in found if one["severity"] == "error"}


@pytest.mark.parametrize("checker", [mypy, pyright])
def test_a_type_checker_finds_it(checker, tmp_path):
    if importlib.util.find_spec(checker.__name__) is None:
        pytest.skip(f"{checker.__name__} is not installed")
    path = tmp_path / "used.py"
    path.write_text(USED)
    wrong = {number for number, line in enumerate(USED.splitlines(), 1) if line.endswith("# wrong")}
    found = checker(path)
    assert len(wrong) > 10
    assert set(found) == wrong, found


def test_the_package_itself(tmp_path):
    """In a folder of its own: where it is installed, mypy takes its neighbours for the user's modules."""
    package = tmp_path / "selfosc"
    shutil.copytree(importlib.util.find_spec("selfosc").submodule_search_locations[0], package)
    said = by_mypy(tmp_path / "cache", "--disallow-incomplete-defs", package)
    assert said.returncode == 0, said.stdout
    with (package / "loops.py").open("a") as file:
        file.write("\nwrong: int = predict(alpha=1.0, relay=1.0, half_width=0.1).exact\n")
    assert by_mypy(tmp_path / "cache", "--disallow-incomplete-defs", package).returncode == 1


def checked(result):
    """Every field of a document is declared and of its type, and every declared field is there."""
    hints = {name: hint for name, hint in typing.get_type_hints(type(result)).items() if not name.startswith("_")}
    assert set(result.to_dict()) == set(hints)
    for name, hint in hints.items():
        check_type(
            result.to_dict()[name],
            hint,
            collection_check_strategy=CollectionCheckStrategy.ALL_ITEMS,
            forward_ref_policy=ForwardRefPolicy.ERROR,
        )


RECORD = {"alpha": 1.0, "beta": 0.5, "relay": 1.0, "half_width": 0.3, "cycles": 4, "hold": True, "quantum": 0.02}
HEATER = ROOT / "fixtures" / "heater.csv"
RESULTS = {
    "autotune": lambda record: selfosc.autotune(HEATER),
    "identify": lambda record: selfosc.identify(record),
    "with a delay": lambda record: selfosc.identify(record, delay=0.2, method="fit", drag="quadratic"),
    "several": lambda record: selfosc.identify([record, record], method="fit"),
    "iso": lambda record: selfosc.identify(record, method="iso"),
    "guaranteed": lambda record: selfosc.identify(record, method="bounded", delay=0.2, to_s=20.0),
    "guaranteed, refuted": lambda record: selfosc.identify(record, method="bounded", delay=1.0, drag="linear", to_s=20.0),
    "bounded": lambda record: selfosc.bounded(selfosc.simulate(**RECORD), delay=0.0, budget=200),
    "bounded, refuted": lambda record: selfosc.bounded(selfosc.simulate(**RECORD), delay=0.9),
    "tune": lambda record: selfosc.tune(alpha=1.0, beta=0.5, bandwidth=0.3),
    "tune with intervals": lambda record: selfosc.tune(
        alpha=1.0, beta=0.5, delay=0.1, bandwidth=0.3, structure="ipd", alpha_interval=(0.9, 1.1)
    ),
    "design": lambda record: selfosc.design(alpha=1, beta_quadratic=0.5, delay=0.1, level=1, time=60, quantum=0.0175),
    "predict": lambda record: selfosc.predict(**YAW),
    "predict without proof": lambda record: selfosc.predict(**YAW, delta=0.0799),
    "balance": lambda record: selfosc.balance(([8], [1, 2, 2, 1]), "saturation", breakpoint=1),
    "certify": lambda record: selfosc.certify(([1], [1, 1, 0]), selfosc.nonlinearity("relay-hysteresis", half_width=0.2)),
    "df": lambda record: selfosc.df("relay", 2.0),
    "df certified": lambda record: selfosc.df(
        "piecewise-linear", 2.0, method="certified", points=[(-1, -1), (1, 2)], left_slope=0, right_slope=0
    ),
    "amplitudes": lambda record: selfosc.amplitudes("relay-dead-zone", 1.0, dead_zone=0.5),
    "fits": lambda record: selfosc.fit_characteristic([0.2, 0.5, 0.8, 1.1, 1.6], [2.0, 2.0, 1.9, 1.5, 1.1]),
    "verify": lambda record: selfosc.verify(cases=20),
    "reproduce": lambda record: selfosc.reproduce(),
    "reproduce a part": lambda record: selfosc.reproduce(["table4"]),
}


@pytest.mark.parametrize("make", RESULTS.values(), ids=RESULTS.keys())
def test_documents_are_as_declared(make, record):
    result = make(record)
    checked(result)
    assert len(result._table()[0]) <= 8 and isinstance(result._repr_html_(), str)


def test_the_corpus_is_as_declared():
    found = 0
    for path in sorted(CORPUS.glob("*.*")):
        try:
            result = selfosc.identify(path)
        except selfosc.SelfoscError:
            continue
        checked(result)
        found += 1
    assert found > 0


def test_the_catalogue_is_as_declared():
    check_type(
        selfosc.catalogue(), dict[str, list[selfosc.types.Parameter]], collection_check_strategy=CollectionCheckStrategy.ALL_ITEMS
    )


def test_a_field_that_is_not_declared_is_found():
    document = selfosc.predict(**YAW).to_dict()
    for wrong in ({**document, "more": 1}, {**document, "exact": {**document["exact"], "more": 1.0}}, {**document, "exact": None}):
        with pytest.raises((AssertionError, TypeCheckError)):
            checked(selfosc.Prediction(wrong))
