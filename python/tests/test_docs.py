"""Examples in docstrings and in the README run as they stand."""

import doctest
import importlib
import inspect
import pkgutil
from pathlib import Path

import pytest

import selfosc

MODULES = [
    "selfosc",
    *(one.name for one in pkgutil.walk_packages(selfosc.__path__, "selfosc.") if not one.name.endswith("_core")),
]
README = Path(__file__).resolve().parents[1] / "README.md"


class Finder(doctest.DocTestFinder):
    """Finds also what a decorator wraps."""

    def _from_module(self, module, object):
        return super()._from_module(module, inspect.unwrap(object) if callable(object) else object)


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name):
    module = importlib.import_module(name)
    tests = Finder().find(module, name)
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    for test in tests:
        runner.run(test)
    assert runner.summarize().failed == 0
    ran = {test.name.rpartition(".")[2] for test in tests if test.examples}
    own = [one for one in vars(module).values() if inspect.isfunction(one) and one.__module__ == name]
    assert {one.__name__ for one in own if "Examples\n" in (one.__doc__ or "")} <= ran


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
            assert "Parameters" in described.__doc__ or not inspect.signature(described).parameters
