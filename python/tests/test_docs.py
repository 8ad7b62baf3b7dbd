"""Examples in docstrings and in the README run as they stand."""

import doctest
import importlib
import pkgutil
from pathlib import Path

import pytest

import selfosc

MODULES = [
    "selfosc",
    *(one.name for one in pkgutil.walk_packages(selfosc.__path__, "selfosc.") if not one.name.endswith("_core")),
]
README = Path(__file__).resolve().parents[1] / "README.md"


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name):
    failed, _ = doctest.testmod(importlib.import_module(name), optionflags=doctest.NORMALIZE_WHITESPACE)
    assert failed == 0


def test_readme():
    failed, tried = doctest.testfile(str(README), module_relative=False, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert (failed, tried > 10) == (0, True)


@pytest.mark.parametrize("name", selfosc.__all__)
def test_everything_public_is_described(name):
    described = getattr(selfosc, name)
    if callable(described):
        assert described.__doc__
        if not isinstance(described, type):
            assert "Examples" in described.__doc__
            assert "Parameters" in described.__doc__ or not described.__code__.co_argcount
