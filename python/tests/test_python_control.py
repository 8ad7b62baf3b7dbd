"""python-control takes our characteristics wherever it takes its own.

The cases are those of its own tests of describing functions (version 0.10.2): amplitudes, plants and what has to hold.
"""

import control as ct
import numpy as np
import pytest

from selfosc import OutOfDomain, balance, certify, describing_function, nonlinearity


def theirs_and_ours():
    return [
        (ct.saturation_nonlinearity(1), nonlinearity("saturation", breakpoint=1), 0.0),
        (ct.friction_backlash_nonlinearity(2), nonlinearity("backlash", half_gap=1), 1.0),
        (ct.relay_hysteresis_nonlinearity(1, 1), nonlinearity("relay-hysteresis", level=1, half_width=1), 3.0),
    ]


@pytest.mark.parametrize(("theirs", "ours", "smallest"), theirs_and_ours())
def test_the_same_gain(theirs, ours, smallest):
    amplitudes = np.linspace(smallest, 10.0, 100)
    assert ct.describing_function(ours, amplitudes, zero_check=False) == pytest.approx(
        ct.describing_function(theirs, amplitudes, zero_check=False), abs=1e-12
    )


@pytest.mark.parametrize(("theirs", "ours"), [(theirs, ours) for theirs, ours, _ in theirs_and_ours()])
def test_the_same_outputs(theirs, ours):
    inputs = 3.0 * np.sin(np.linspace(0.0, 13.0, 101))
    # After a swing both ways, where the memory began no longer matters.
    np.testing.assert_allclose([ours(x) for x in inputs][60:], [theirs(x) for x in inputs][60:], atol=1e-12)


@pytest.mark.parametrize(("ours", "smallest"), [(ours, smallest) for _, ours, smallest in theirs_and_ours()])
def test_called_as_a_function_it_has_the_same_gain(ours, smallest):
    amplitudes = np.linspace(smallest, 10.0, 100)
    called = ct.describing_function(ours, amplitudes, zero_check=False, try_method=False)
    method = ct.describing_function(ours, amplitudes, zero_check=False)
    np.testing.assert_almost_equal(called, method, decimal=1)
    np.testing.assert_almost_equal(method, [ours.describing_function(one) for one in amplitudes])
    with pytest.raises(ValueError, match="cannot evaluate"):
        ct.describing_function(ours, -1)


def test_intersections():
    plant = ct.tf([1], [1, 2, 2, 1])
    omega, amplitudes = np.logspace(-1, 2, 100), np.linspace(1, 4, 10)
    saturation = nonlinearity("saturation", breakpoint=1)
    assert len(ct.describing_function_response(plant, saturation, amplitudes, omega)) == 0
    found = ct.describing_function_response(8 * plant, saturation, amplitudes, omega)
    assert len(found) == 1
    for amplitude, frequency in found:
        gain = ct.describing_function(saturation, amplitude)
        np.testing.assert_almost_equal((8 * plant)(1j * frequency), -1 / gain, decimal=5)
    exact = balance(8 * plant, saturation)
    np.testing.assert_allclose([(one["amplitude"], one["omega_rad_s"]) for one in exact], list(found), rtol=1e-4)


def test_several_intersections_with_backlash():
    plant = ct.tf([1], [1, 2, 2, 1]) * ct.tf(*ct.pade(5, 4)) * 4
    backlash = nonlinearity("backlash", half_gap=0.5)
    found = ct.describing_function_response(plant, backlash, np.linspace(0.6, 5, 50), np.logspace(-1, 3, 50))
    assert len(found) > 1
    for amplitude, frequency in found:
        gain = ct.describing_function(backlash, amplitude)
        np.testing.assert_almost_equal(-1 / gain, plant(1j * frequency), decimal=5)


def test_the_plot_of_a_response():
    plant, saturation = ct.tf([8], [1, 2, 2, 1]), nonlinearity("saturation", breakpoint=1)
    response = ct.describing_function_response(plant, saturation, np.linspace(1, 4, 10), np.logspace(-1, 2, 100))
    drawn = response.plot()
    assert len(drawn.lines[0]) == 5
    assert len(drawn.lines[1]) == 1


def test_a_saturation_as_a_function_an_object_and_at_zero():
    amplitudes = np.linspace(0, 10, 100)
    ours = nonlinearity("saturation", breakpoint=1)
    by_sum = ct.describing_function(lambda x: np.clip(x, -1, 1), amplitudes)
    np.testing.assert_almost_equal(ct.describing_function(ours, amplitudes), by_sum, decimal=3)
    assert ct.describing_function(ours, 0, zero_check=False) == 1.0
    assert ours(-3) == -1.0


def test_an_output_that_rests_has_no_gain():
    for name, parameters in {"backlash": {"half_gap": 0.5}, "relay-hysteresis": {"half_width": 0.5}}.items():
        entry = nonlinearity(name, **parameters)
        gains = entry.describing_function([0.0, 0.4, 0.5, 1.0])
        assert gains[:2].tolist() == [0.0, 0.0]
        assert gains[3] == describing_function(entry, 1.0).gain
        with pytest.raises(ValueError, match="switch"):
            describing_function(entry, 0.4)


def test_where_python_control_has_no_answer():
    """Its saturation is refused a bias and warns of asymmetry; a relay at amplitude zero has no gain to give."""
    with pytest.warns(UserWarning, match="asymmetric"):
        theirs = ct.saturation_nonlinearity(lb=-1, ub=2)
    ours = nonlinearity("saturation-asymmetric", lower=-1, upper=2)
    assert [ours(-3), ours(3)] == [theirs(-3), theirs(3)]
    assert describing_function(ours, 3.0, 0.5).f0 != 0.0
    with pytest.raises(ValueError, match="amplitude 0"):
        nonlinearity("relay").describing_function(0.0)
    with pytest.raises(OutOfDomain):
        describing_function("relay", 0.0)


def test_plants_of_every_make():
    from scipy import signal

    coefficients = ([8.0], [1.0, 2.0, 2.0, 1.0])
    plants = [
        ct.tf(*coefficients),
        ct.ss(ct.tf(*coefficients)),
        signal.TransferFunction(*coefficients),
        signal.lti(*coefficients),
    ]
    numbers = lambda found: {name: found[0][name] for name in ("amplitude", "omega_rad_s")}
    expected = numbers(balance(coefficients, "saturation", breakpoint=1))
    for plant in plants:
        assert numbers(balance(plant, "saturation", breakpoint=1)) == pytest.approx(expected, rel=1e-9)
    with pytest.raises(ValueError, match="continuous"):
        balance(ct.tf([1], [1, 0.5], 0.1), "relay")


def test_a_certificate_holds_the_exact_orbit():
    found = certify(ct.tf([1], [1, 1, 0]), nonlinearity("relay-hysteresis", half_width=0.2))
    low, high = found[0]["enclosure"]["time_high_s"]
    assert low < 1.862223721734969 < high
    assert found[0]["attracting"] and found.complete
    # A heater between 0 and 1 about 1.2: rise and fall are exponentials.
    heater = certify(ct.tf([2], [30, 1]), nonlinearity("relay-hysteresis", level=0.5, offset=0.5, half_width=0.1), delay=4, reference=1.2)
    late = np.exp(-4 / 30)
    peak, trough = 2 - 0.7 * late, 1.1 * late
    assert heater[0]["time_high_s"] == pytest.approx(4 + 30 * np.log((2 - trough) / 0.7), rel=1e-12)
    assert heater[0]["time_low_s"] == pytest.approx(4 + 30 * np.log(peak / 1.1), rel=1e-12)
    with pytest.raises(ValueError, match="is no relay"):
        certify(ct.tf([1], [1, 1, 0]), nonlinearity("saturation", breakpoint=1))
