"""Gains of a process from one record: the command's document, from files and from tables; refusals by name."""

import json

import numpy as np
import pytest
from conftest import ROOT

import selfosc

HEATER = ROOT / "fixtures" / "heater.csv"


def columns():
    time, temperature, heater = np.loadtxt(HEATER, delimiter=",", skiprows=1).T
    return {"time": time, "temperature": temperature, "heater": heater}


def test_it_is_the_command_s_document(command):
    status, printed = command("autotune", HEATER, "--ms=1.6", "--pi", "--form=klipper", "--json")
    assert status == 0
    assert selfosc.autotune(HEATER, ms=1.6, actions="pi", form="klipper").to_dict() == json.loads(printed)


def test_gains_of_a_firmware_are_shares_of_full_power():
    table = columns() | {"heater": 0.5 * columns()["heater"]}
    whole = selfosc.autotune(HEATER, form="klipper").lines
    half = selfosc.autotune(table, form="klipper", full_power=0.5).lines
    numbers = [[float(line.split(":")[1]) for line in lines.splitlines()[1:]] for lines in (whole, half)]
    assert numbers[1] == pytest.approx(numbers[0], rel=1e-3)
    with pytest.raises(selfosc.SelfoscError, match="full power"):
        selfosc.autotune(table, form="klipper")


def test_a_table_gives_the_numbers_of_its_file():
    of_file, of_table = selfosc.autotune(HEATER).to_dict(), selfosc.autotune(columns()).to_dict()
    assert of_file["record"].pop("name") != of_table["record"].pop("name")
    assert of_file == of_table


def test_the_table_shown_has_gains_process_and_rules():
    found = selfosc.autotune(HEATER)
    shown = repr(found)
    assert "trust good" in shown and "at most 1.4, proved" in shown
    assert "proportional" in shown and "time_constant_s" in shown and "AMIGO PID" in shown
    assert found.gains["derivative"] > 0.0 and selfosc.autotune(HEATER, actions="pi").gains["derivative"] == 0.0


def test_a_record_that_tells_no_process_is_refused_by_name():
    with pytest.raises(selfosc.RecordRefused, match="changes") as refused:
        selfosc.autotune(columns(), to_s=20.0)
    assert refused.value.code == "few-changes"
    assert "record.csv" not in str(refused.value)
    with pytest.raises(selfosc.UsageError):
        selfosc.autotune([columns(), columns()])
    with pytest.raises(selfosc.SelfoscError, match="from 1.1 to 3"):
        selfosc.autotune(HEATER, ms=4.0)
