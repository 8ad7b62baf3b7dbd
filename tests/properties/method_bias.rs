//! The error of the paper's method on exact orbits, against the figures found for it (finding 9 and the biased case).

use selfosc::identify::iso::{Oscillation, Parameters};
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::orbit::limit_cycle;
use selfosc::plant::DragAxis;

use crate::tolerance;

/// What the method makes of the exact orbit of an axis of unit parameters under a unit relay.
fn identified(axis: DragAxis<f64>, half_width: f64) -> Parameters<f64> {
    let cycle = limit_cycle(&axis, &RelayHysteresis::new(1.0, half_width, 0.0).unwrap()).unwrap();
    let (amplitude, bias, period_s) = (cycle.amplitude, cycle.bias, cycle.period_s);
    let read = Oscillation { relay_level: 1.0, switch_level: half_width, amplitude, bias, period_s, delay_s: 0.0 };
    read.identify().unwrap()
}

fn assert_percent(what: &str, value: f64, percent: f64) {
    let found = 100.0 * (value - 1.0);
    assert!((found - percent).abs() <= tolerance::PRINTED_PERCENT, "{what}: {found} %, expected {percent} %");
}

#[test]
fn linear_drag() {
    // g = x_a beta^2/(C alpha) is the half-width itself.
    let at = |g| identified(DragAxis::linear(1.0, 1.0).unwrap(), g);
    for (g, alpha) in [(1e-5, 3.0), (1.0, -3.0), (10.0, 47.0)] {
        assert_percent("alpha", at(g).alpha, alpha);
    }
    assert_percent("beta for small g", at(1e-5).beta, 8.0);
    assert_percent("beta at g = 30", at(30.0).beta, -18.0);
}

#[test]
fn quadratic_drag() {
    // g = x_a beta_xx/alpha is the half-width itself.
    let at = |g| identified(DragAxis::quadratic(1.0, 1.0).unwrap(), g);
    for (g, alpha) in [(1e-5, 3.0), (1.0, -6.5), (10.0, 52.0)] {
        assert_percent("alpha", at(g).alpha, alpha);
    }
    assert_percent("beta_xx for small g", at(1e-5).beta_quadratic, 22.0);
    assert_percent("beta_xx at g = 30", at(30.0).beta_quadratic, -38.0);
}

/// A bias with an otherwise clean record moves alpha by far more.
#[test]
fn a_bias_moves_alpha() {
    let disturbed = DragAxis::linear(1.0, 1.0).unwrap().with_disturbance(0.5).unwrap();
    let (biased, clean) =
        (identified(disturbed, 0.3).alpha, identified(DragAxis::linear(1.0, 1.0).unwrap(), 0.3).alpha);
    assert!(biased / clean > 1.1, "{biased} against {clean}");
}
