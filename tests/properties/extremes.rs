//! Numbers at the ends of the arithmetic, and calls whose work had no end: an error by name, never a number that is none.

use selfosc::control::{Gains, OpenLoop, RelayTest, Structure, Tuning};
use selfosc::describing::{by_quadrature, harmonic};
use selfosc::identify::iso::Oscillation;
use selfosc::nonlinearity::{Power, Sinusoid};
use selfosc::numeric::Interval;
use selfosc::orbit::{TwoLevelRelay, orbits};
use selfosc::plant::{DragAxis, TransferFunction};
use selfosc::vehicle::Allocation;

use crate::control::worst_case::axes;

/// Sizes from the least to the largest that a float has.
const SIZES: [f64; 9] = [5e-324, 1e-307, 1e-160, 1e-100, 1.0, 1e100, 1e154, 1e200, 1.7e308];

#[test]
fn an_allocation_is_finite_or_refused() {
    for a in SIZES {
        for b in SIZES {
            if let Ok(allocation) = Allocation::from_matrix([[a, a], [b, -b]]) {
                assert!(allocation.inverse().iter().flatten().all(|entry| entry.is_finite()), "{a} {b}");
            }
        }
        if let Ok(pair) = Allocation::pair(a) {
            assert!(pair.inverse().iter().flatten().all(|entry| entry.is_finite()), "{a}");
        }
    }
    // A matrix that is large throughout is no worse than one that is not.
    let large = Allocation::from_matrix([[1e154, 1e154], [1e154, -1e154]]).unwrap();
    assert!((large.inverse()[0][0] * 1e154 - 0.5).abs() < 1e-14);
}

#[test]
fn an_identification_is_finite_or_refused() {
    for period_s in [2e-308, 1e-200, 1e-3, 2.69, 1e200, 1e308] {
        for size in SIZES {
            let test = Oscillation {
                relay_level: 8.23,
                switch_level: 0.25 * size,
                amplitude: size,
                bias: 0.0,
                period_s,
                delay_s: 0.0,
            };
            if let Ok(found) = test.identify() {
                let numbers = [found.alpha, found.beta, found.beta_quadratic, found.disturbance];
                assert!(numbers.iter().all(|number| number.is_finite()), "{test:?} {found:?}");
            }
        }
    }
}

#[test]
fn a_loop_and_a_relay_test_are_finite_or_refused() {
    for a in SIZES {
        for b in SIZES {
            let gains = Gains::new(Structure::Pid, a, b, a, b).unwrap();
            let loops = [(a, b), (b, a), (1.0, 1.0)]
                .map(|(alpha, drag)| DragAxis::linear(alpha, drag).map(|axis| OpenLoop::new(&axis, &gains, 0.0)));
            for open_loop in loops.into_iter().flatten().flatten() {
                let (magnitude, angle) = (open_loop.magnitude(1.0), open_loop.angle_above_critical(1.0));
                assert!(!magnitude.is_nan() && !angle.is_nan(), "{open_loop:?}");
            }
            let test = RelayTest { level: a, half_width: 0.25 * b, amplitude: b, bias: 0.0, period_s: 1.0 / a };
            if let Ok(point) = test.point() {
                let numbers = [point.omega_rad_s, point.magnitude, point.angle_above_critical];
                assert!(numbers.iter().all(|number| number.is_finite()), "{test:?} {point:?}");
            }
        }
    }
}

#[test]
fn harmonics_are_finite_or_refused() {
    for size in SIZES {
        for amplitude in SIZES {
            let Ok(sweep) = Sinusoid::new(0.0, amplitude) else { continue };
            let gain = Power::new(size, 1.0).unwrap();
            if let Ok(found) = by_quadrature(&gain, &sweep) {
                assert!([found.f0, found.p, found.q].iter().all(|part| part.is_finite()), "{size} {amplitude}");
            }
            if let Ok((sine, cosine)) = harmonic(&gain, &sweep, 1) {
                assert!(sine.is_finite() && cosine.is_finite(), "{size} {amplitude}");
            }
        }
    }
}

#[test]
fn work_without_end_is_refused_or_cut_short() {
    let steep = TransferFunction::new(&[1.0], &[1.0, 1e155]).unwrap();
    assert!(steep.poles().is_err());
    let gains = Gains::new(Structure::Pd, 1.0, 0.0, 1.0, 1e-281).unwrap();
    let axis = DragAxis::linear(1.0, 0.5).unwrap().with_delay_s(0.1).unwrap();
    assert!(OpenLoop::new(&axis, &gains, 0.0).unwrap().closed_loop_poles().is_err());
    let refusal = Power::new(1.0, 1e15).unwrap_err().to_string();
    assert!(refusal.contains("exponent") && refusal.contains("10000"), "{refusal}");
    // Some 260 periods of the shortest in the delay.
    let plant = TransferFunction::new(&[1.0], &[1.0, 1.0, 0.0]).unwrap().with_delay(1.0).unwrap();
    let found = orbits(&plant, &TwoLevelRelay::new(1.0, -1.0, 0.0).unwrap(), Some(0.0038..=0.34)).unwrap();
    assert!(!found.is_complete() && found.orbits.len() < 10, "{found:?}");
}

#[test]
fn worst_margins_of_extreme_delays_are_refused_or_bounded() {
    let tuning = Tuning::new(&DragAxis::linear(1.0, 0.3).unwrap(), Structure::Pd, 0.7).unwrap();
    let between = |low, high| Interval::new(low, high).unwrap();
    let of_delays = |delay_s| axes([between(0.9, 1.1), between(0.2, 0.4), delay_s]);
    assert!(of_delays(between(0.05, 0.1)).worst_margins(tuning.gains()).unwrap().proved);
    if let Ok(worst) = of_delays(between(4e-300, 4e-142)).worst_margins(tuning.gains()) {
        assert!(worst.at_least.phase_rad <= worst.met.phase_rad, "{worst:?}");
    }
    assert!(of_delays(between(1.0, 1e300)).worst_margins(tuning.gains()).is_err());
}
