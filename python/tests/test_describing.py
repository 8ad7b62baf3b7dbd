"""Characteristics: arrays, functions, calls, refusals."""

import pickle

import numpy as np
import pytest

import selfosc
from selfosc import describing_function, nonlinearity


def fourier(function, amplitude, bias, points=200_000):
    """Mean and first harmonic by the midpoint rule, which shares nothing with the package."""
    theta = (np.arange(points) + 0.5) * 2.0 * np.pi / points
    y = function(bias + amplitude * np.sin(theta))
    return y.mean(), 2.0 * (y * np.sin(theta)).mean() / amplitude, 2.0 * (y * np.cos(theta)).mean() / amplitude


def test_a_biased_asymmetric_saturation_against_a_sum():
    amplitude, bias = np.array([0.6, 1.3, 4.0])[:, None], np.array([-0.4, 0.0, 0.7])
    found = describing_function("saturation-asymmetric", amplitude, bias, lower=-1.0, upper=0.5)
    assert found.p.shape == (3, 3)
    for row, column in np.ndindex(3, 3):
        expected = fourier(lambda x: np.clip(x, -1.0, 0.5), amplitude[row, 0], bias[column])
        assert [part[row, column] for part in found] == pytest.approx(expected, abs=1e-9)


def test_an_array_is_its_elements():
    amplitudes = np.linspace(0.4, 5.0, 57)
    array = describing_function("backlash", amplitudes, half_gap=0.3)
    alone = [describing_function("backlash", one, half_gap=0.3) for one in amplitudes]
    assert np.array_equal(array.gain, [one.gain for one in alone])


ENTRIES = {
    "absolute": {}, "backlash": {"half_gap": 0.5}, "dead-zone": {"half_width": 0.5}, "preload": {"slope": 1.0, "level": 0.5},
    "dead-zone-saturation": {"half_width": 0.2, "breakpoint": 0.9}, "gain-changing": {"inner_slope": 1, "outer_slope": 2, "breakpoint": 0.7},
    "relay": {}, "relay-dead-zone": {"dead_zone": 0.4}, "relay-dead-zone-hysteresis": {"on": 0.5, "off": 0.3},
    "relay-hysteresis": {"half_width": 0.5}, "saturation": {"breakpoint": 1.0}, "saturation-asymmetric": {"lower": -1.0, "upper": 0.5},
    "quantizer": {"step": 0.3}, "tanh": {"gain": 1.0, "scale": 2.0},
}  # fmt: skip


@pytest.mark.parametrize("name", ENTRIES)
@pytest.mark.parametrize("bias", [0.0, 0.1, -0.8, 3.0])
def test_a_shuffled_array_is_its_elements_to_the_bit(name, bias):
    """Elements are worked on several at a time; neighbours that decide otherwise must not be seen."""
    relay = nonlinearity(name, **ENTRIES[name])
    amplitudes = np.random.default_rng(5).permutation(np.geomspace(1e-3, 50.0, 1003))
    array = np.array(describing_function(relay, amplitudes, bias, undefined="nan"))
    alone = np.array([describing_function(relay, one, bias, undefined="nan") for one in amplitudes]).T
    np.testing.assert_array_equal(array.view(np.uint64), alone.view(np.uint64))
    assert np.any(np.isfinite(array))


@pytest.mark.parametrize("name", ENTRIES)
@pytest.mark.parametrize("bias", [0.0, 0.1, -0.8])
def test_a_number_is_an_array_of_it_to_the_bit(name, bias):
    relay = nonlinearity(name, **ENTRIES[name])
    for amplitude in (1.3, 2, np.float64(7.5)):
        alone, array = describing_function(relay, amplitude, bias), describing_function(relay, [amplitude], bias)
        assert all(type(part) is float for part in alone)
        assert [part.hex() for part in alone] == [part.item().hex() for part in array]
        assert relay.describing_function(amplitude, bias) == relay.describing_function([amplitude], bias)[0] == alone.gain


@pytest.mark.parametrize("amplitude", [-1.0, 0.0, 0, float("nan"), float("inf"), 10**400, True, 1e308, 0.3, "1", None, 1j])
@pytest.mark.parametrize("bias", [0.0, float("nan"), 1e200])
def test_a_number_is_refused_as_an_array_of_it(amplitude, bias):
    for relay in (nonlinearity("relay-hysteresis", half_width=0.5), nonlinearity("saturation", breakpoint=1.0)):
        for call in (relay.describing_function, lambda *sweep: describing_function(relay, *sweep)):
            answers = []
            for sweep in ((amplitude, bias), ([amplitude], [bias])):
                try:
                    answers.append(repr([np.asarray(part).item() for part in np.atleast_1d(call(*sweep))]))
                except selfosc.SelfoscError as refusal:
                    answers.append((refusal.code, refusal.quantity))
            assert answers[0] == answers[1]


def test_shapes():
    assert describing_function("relay", np.ones((2, 1, 3)), np.zeros((4, 1))).f0.shape == (2, 4, 3)
    assert describing_function("relay", []).p.shape == (0,)
    assert isinstance(describing_function("relay", 1.0).p, float)
    assert describing_function("relay", np.asfortranarray(np.ones((2, 3))) * [1, 2, 4]).p[0, 2] == pytest.approx(1 / np.pi)


def test_a_function_with_kinks():
    exact = describing_function("saturation", 2.0, 0.3, breakpoint=1.0)
    integrated = describing_function(lambda x: min(max(x, -1.0), 1.0), 2.0, 0.3, kinks=[-1.0, 1.0])
    assert integrated == pytest.approx(exact, abs=1e-12)


def test_a_function_of_the_branch():
    exact = describing_function("relay-hysteresis", 1.0, half_width=0.5)
    relay = lambda x, rising: 1.0 if x > (0.5 if rising else -0.5) else -1.0  # noqa: E731
    assert describing_function(relay, 1.0, kinks=[-0.5, 0.5]) == pytest.approx(exact, abs=1e-12)


def test_what_a_function_raises_comes_out():
    with pytest.raises(ZeroDivisionError):
        describing_function(lambda x: 1 / 0, 1.0)


def test_below_switching_is_refused_or_nan_on_request():
    with pytest.raises(selfosc.SelfoscError) as refusal:
        describing_function("relay-hysteresis", [1.0, 0.1], half_width=0.5)
    assert "0.1" in str(refusal.value)
    found = describing_function("relay-hysteresis", [1.0, 0.1], half_width=0.5, undefined="nan")
    assert np.isnan(found.p).tolist() == [False, True]


@pytest.mark.parametrize(
    "call",
    [
        lambda: describing_function("relay", -1.0),
        lambda: describing_function("relay", np.nan),
        lambda: describing_function("relay", 1.0, np.inf),
        lambda: nonlinearity("saturation", breakpoint=-1.0),
        lambda: nonlinearity("saturation"),
        lambda: nonlinearity("saturation", breakpoint=1.0, slop=2.0),
        lambda: nonlinearity("saturatoin"),
        lambda: nonlinearity("relay", level="much"),
        lambda: nonlinearity("relay")(np.nan),
        lambda: describing_function(3.0, 1.0),
        lambda: nonlinearity("relay").describing_function(0.0),
    ],
)
def test_refusals(call):
    with pytest.raises((selfosc.SelfoscError, TypeError, ValueError)) as refusal:
        call()
    assert str(refusal.value)


def test_a_refusal_has_its_parts():
    with pytest.raises(selfosc.OutOfDomain) as refusal:
        describing_function("relay", -1.0)
    error = refusal.value
    assert (error.code, error.quantity, error.value, error.unit) == ("out-of-domain", "amplitude", -1.0, "input units")
    assert "above 0" in error.limit
    assert error.remedy
    assert pickle.loads(pickle.dumps(error)).value == -1.0


def test_memory_follows_the_input():
    relay = nonlinearity("relay-hysteresis", level=2.0, half_width=0.5)
    assert relay([0.0, 0.6, 0.0, -0.4, -0.6, 0.0]).tolist() == [-2.0, 2.0, 2.0, 2.0, -2.0, -2.0]
    relay.reset()
    assert relay(0.0) == -2.0
    play = nonlinearity("backlash", half_gap=0.5)
    assert play([0.0, 1.0, 0.5, 0.0, -1.0, 0.0, 0.25]).tolist() == [-0.5, 0.5, 0.5, 0.5, -0.5, -0.5, -0.25]


def test_objects_travel_and_compare():
    one = nonlinearity("piecewise-linear", points=[(0, 0), (1, 2)], left_slope=0, right_slope=1)
    assert pickle.loads(pickle.dumps(one)) == one
    assert len({one, nonlinearity("relay"), nonlinearity("relay", level=1.0)}) == 2


def test_memory_is_where_the_branches_differ():
    given = {"sinh": {}, "sine": {}, "arctan": {}, "tanh": {}, "polynomial": {}, "piecewise-linear": {}}
    for name, parameters in selfosc.catalogue().items():
        values = dict(given.get(name, {}))
        for parameter in parameters:
            if parameter["default"] is None:
                points = [(-1.0, -1.0), (0.0, 0.0), (1.0, 2.0)]
                chosen = {"lower": -0.5, "upper": 0.8, "on": 0.6, "off": 0.3, "points": points, "breakpoint": 0.9}
                values[parameter["name"]] = chosen.get(parameter["name"], 0.4)
        entry = nonlinearity(name, **values)
        branches = [entry._core.branches(x, 0.0, 3.0) for x in np.linspace(-1.9, 1.9, 191)]
        assert entry._isstatic() == all(rising == falling for rising, falling in branches), name


def test_every_entry_of_the_catalogue_agrees_with_its_own_calls():
    """Closed form against the sum over what the object answers as a function; those with memory are tested by python-control."""
    given = {
        "relay-dead-zone": {"dead_zone": 0.4}, "saturation": {"breakpoint": 0.7}, "dead-zone": {"half_width": 0.3},
        "saturation-asymmetric": {"lower": -0.5, "upper": 0.8}, "dead-zone-saturation": {"half_width": 0.2, "breakpoint": 0.9},
        "gain-changing": {"inner_slope": 2.0, "outer_slope": 0.5, "breakpoint": 0.6}, "preload": {"slope": 1.0, "level": 0.3},
        "quantizer": {"step": 0.25}, "power": {"exponent": 2.0}, "absolute": {}, "relay": {},
    }  # fmt: skip
    for name, parameters in given.items():
        entry = nonlinearity(name, **parameters)
        assert entry._isstatic()
        found = describing_function(entry, 1.1, 0.17)
        assert list(found) == pytest.approx(fourier(entry, 1.1, 0.17), abs=2e-4), name


def test_the_first_amplitude_outside_its_domain_is_named():
    amplitudes = np.ones(50)
    amplitudes[17] = -2.0
    with pytest.raises(selfosc.OutOfDomain) as refusal:
        describing_function("relay", amplitudes, undefined="nan")
    assert (refusal.value.quantity, refusal.value.value) == ("amplitude", -2.0)


def test_gains_that_fit_nothing_are_refused():
    with pytest.raises(selfosc.UsageError):
        selfosc.fit_characteristic([1.0, 2.0], [1.0])
    with pytest.raises(selfosc.SelfoscError) as refusal:
        selfosc.fit_characteristic([1.0, -2.0, 3.0], [1.0, 2.0, 3.0])
    assert refusal.value.code == "out-of-domain"
    with pytest.raises(selfosc.UsageError):
        selfosc.amplitudes(nonlinearity("relay"), 1.0, level=2.0)
