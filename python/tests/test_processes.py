"""Forked and spawned processes, and results on their way between them."""

import copy
import multiprocessing
import os
import pickle
import threading

import numpy as np
import pytest
from conftest import YAW

import selfosc

#: A child that waits for threads which it has not would wait for ever; an answer takes a second.
PATIENCE_S = 60.0

needs_fork = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system does not fork")


def identified(record):
    return selfosc.identify(record, method="fit")


def gains(amplitudes):
    return selfosc.describing_function("relay", amplitudes).p


def pool(way):
    return multiprocessing.get_context(way).Pool(2)


@needs_fork
@pytest.mark.parametrize("way", ["fork", "spawn"])
def test_children_identify_after_their_parent(record, way):
    here = identified(record)
    with pool(way) as children:
        assert children.map_async(identified, [record] * 4).get(PATIENCE_S) == [here] * 4
    assert identified(record) == here


@needs_fork
def test_every_call_that_shares_out_work(record):
    wide = np.linspace(1.0, 2.0, 200_000)
    calls = [
        (gains, (wide,)),
        (selfosc.design, (), {"alpha": 1.0, "beta_quadratic": 0.5, "level": 1.0, "time": 60.0}),
        (selfosc.certify, (([1], [1, 1, 0]), selfosc.nonlinearity("relay-hysteresis", half_width=0.2))),
        (selfosc.predict, (), YAW),
    ]
    here = [call[0](*call[1], **(call[2] if len(call) > 2 else {})) for call in calls]
    with pool("fork") as children:
        begun = [children.apply_async(call[0], call[1], call[2] if len(call) > 2 else {}) for call in calls]
        there = [one.get(PATIENCE_S) for one in begun]
    assert np.array_equal(here[0], there[0])
    assert here[1:] == there[1:]


@needs_fork
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_fork_while_another_thread_identifies(record):
    begun = threading.Event()
    other = threading.Thread(target=lambda: selfosc.identify(record, progress=lambda _: begun.set()))
    other.start()
    assert begun.wait(PATIENCE_S)
    with pool("fork") as children:
        assert children.apply_async(identified, (record,)).get(PATIENCE_S).reported is not None
    other.join()


@pytest.mark.parametrize("travel", [lambda one: pickle.loads(pickle.dumps(one)), copy.deepcopy, copy.copy])
def test_an_identification_comes_back_equal(record, travel):
    found = selfosc.identify(record)
    back = travel(found)
    assert back == found
    assert back is not found
    assert back.details == found.details
    assert repr(back) == repr(found)


def test_what_comes_back_reports_and_plots(record_path, tmp_path):
    found = selfosc.identify(record_path, method="fit")
    back = pickle.loads(pickle.dumps(found))
    pages = [one.report(tmp_path / f"{place}.html").read_text() for place, one in enumerate((found, back))]
    assert pages[0] == pages[1]
    assert "SHA-256" in pages[1]
    assert len(back.plot().axes) == len(found.plot().axes)
    assert selfosc.tune(back, bandwidth=0.5) == selfosc.tune(found, bandwidth=0.5)
    before = record_path.read_bytes()
    with pytest.raises(selfosc.UsageError):
        back.report(record_path)
    assert record_path.read_bytes() == before


def test_equality_is_that_of_the_documents(record):
    found = identified(record)
    assert found == identified(record)
    assert found != selfosc.identify(record, method="fit", drag="linear")
    assert found != found.to_dict()
    with pytest.raises(TypeError):
        hash(found)


def test_other_results_come_back_equal():
    for result in (selfosc.predict(**YAW), selfosc.tune(alpha=1.0, beta=0.5, bandwidth=0.3), selfosc.df("relay", 2.0)):
        back = pickle.loads(pickle.dumps(result))
        assert back == result
        assert type(back) is type(result)


def test_bytes_that_are_no_identification(record):
    rebuild, (text,) = identified(record).__reduce__()
    with pytest.raises(selfosc.SelfoscError):
        rebuild(text.replace('"samples"', '"example"').replace('"time_s"', '"time"'))
