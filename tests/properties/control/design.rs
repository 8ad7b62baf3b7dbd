//! Pole placement: poles, bandwidth, domain.

use nalgebra::Complex;
use proptest::prelude::*;
use selfosc::control::{ControlError, Structure, Tuning};
use selfosc::plant::{DragAxis, TransferFunction};

use crate::sampling::recorded;
use crate::tolerance::{DOUBLE_POLE, MARGIN, ROUNDING_MARGIN};

const STRUCTURES: [(Structure, f64); 3] = [(Structure::Pd, 0.0), (Structure::Pid, 0.1), (Structure::Ipd, 1.0)];

fn structure() -> impl Strategy<Value = (Structure, f64)> {
    prop::sample::select(STRUCTURES.to_vec())
}

/// Characteristic polynomial of the loop without delay, descending, from the blocks.
fn characteristic(tuning: &Tuning<f64>) -> Vec<f64> {
    let (axis, g) = (tuning.axis(), tuning.gains());
    let (alpha, drag, f) = (axis.alpha(), axis.linear_drag(), g.filter_s());
    let (kp, ki, kd) = (g.proportional(), g.integral(), g.derivative());
    let mut polynomial = vec![alpha * f, alpha + drag * f, drag + kd + kp * f, kp + ki * f, ki];
    if ki == 0.0 {
        polynomial.pop();
    }
    polynomial
}

proptest! {
    #![proptest_config(recorded(256))]

    #[test]
    fn poles_are_the_requested_ones((structure, slow) in structure(), alpha in 1e-3..1e3_f64, share in 0.0..0.9_f64, quadratic in 0.0..10.0_f64, bandwidth in 1e-3..10.0_f64) {
        let w = bandwidth / structure.bandwidth_ratio();
        // Drag up to nine tenths of what the design can bear.
        let axis = DragAxis::mixed(alpha, share * 1.7 * alpha * w, quadratic).unwrap();
        let tuning = Tuning::new(&axis, structure, bandwidth).unwrap();
        let gains = tuning.gains();
        prop_assert!(gains.proportional() > 0.0 && gains.derivative() >= 0.0);
        prop_assert_eq!(gains.integral() > 0.0, structure != Structure::Pd);
        let polynomial = characteristic(&tuning);
        // The polynomial and its slope vanish at the double pole, the polynomial at the slow one.
        let size: f64 = polynomial.iter().rev().enumerate().map(|(k, c)| c.abs() * w.powi(k as i32)).sum();
        let value = |s: f64| polynomial.iter().fold(0.0, |sum, c| sum * s + c);
        let slope = |s: f64| polynomial.iter().rev().enumerate().skip(1).map(|(k, c)| k as f64 * c * s.powi(k as i32 - 1)).sum::<f64>();
        prop_assert!(value(-w).abs() < ROUNDING_MARGIN * size);
        prop_assert!(slope(-w).abs() * w < ROUNDING_MARGIN * size);
        prop_assert!(slow == 0.0 || value(-slow * w).abs() < ROUNDING_MARGIN * size);
        // False variant: a double pole a thousandth further out.
        prop_assert!(value(-1.001 * w).abs() + slope(-1.001 * w).abs() * w > ROUNDING_MARGIN * size);
        // As eigenvalues: all decay, none slower than asked for.
        let poles = TransferFunction::new(&[1.0], &polynomial).unwrap().poles().unwrap();
        let slowest = poles.iter().map(|pole| pole.re).fold(f64::NEG_INFINITY, f64::max);
        let expected = if slow == 0.0 { -w } else { -slow * w };
        prop_assert!((slowest / expected - 1.0).abs() < DOUBLE_POLE, "{} {}", slowest, expected);
    }

    #[test]
    fn bandwidth_is_the_requested_one((structure, _) in structure(), alpha in 0.01..10.0_f64, share in 0.0..0.9_f64, bandwidth in 0.01..10.0_f64) {
        let w = bandwidth / structure.bandwidth_ratio();
        let axis = DragAxis::linear(alpha, share * 1.7 * alpha * w).unwrap();
        let tuning = Tuning::new(&axis, structure, bandwidth).unwrap();
        let answer = |tuning: &Tuning<f64>, omega: f64| {
            let (g, s) = (tuning.gains(), Complex::new(0.0, omega));
            let filtered = s * g.derivative() / (s * g.filter_s() + 1.0);
            let forward = match structure {
                Structure::Ipd => Complex::new(0.0, 0.0),
                Structure::Pd | Structure::Pid => Complex::new(g.proportional(), 0.0),
            } + g.integral() / s;
            let late = (-s * tuning.axis().delay_s()).exp();
            let back = g.proportional() + g.integral() / s + filtered;
            (forward * late / (s * (s * alpha + axis.linear_drag()) + back * late)).norm() * 2f64.sqrt()
        };
        // The filter's share.
        prop_assert!((answer(&tuning, bandwidth) - 1.0).abs() < 5e-3, "{}", answer(&tuning, bandwidth));
        // What is computed of it, with a delay too.
        let delayed = Tuning::new(&axis.with_delay_s(0.05 / w).unwrap(), structure, bandwidth).unwrap();
        for tuning in [tuning, delayed] {
            let achieved = tuning.achieved_bandwidth_rad_s().unwrap();
            prop_assert!((answer(&tuning, achieved) - 1.0).abs() < MARGIN);
            prop_assert!((1..60).all(|k| answer(&tuning, achieved * f64::from(k) / 60.0) > 1.0));
        }
    }

    #[test]
    fn too_little_bandwidth_names_the_least((structure, _) in structure(), alpha in 0.1..10.0_f64, drag in 0.1..10.0_f64) {
        let axis = DragAxis::linear(alpha, drag).unwrap();
        let Err(ControlError::Overdamped { least_rad_s, .. }) = Tuning::new(&axis, structure, 1e-6) else {
            return Err(TestCaseError::fail("not refused"));
        };
        prop_assert!(Tuning::new(&axis, structure, least_rad_s * (1.0 - 1e-9)).is_err());
        let least = Tuning::new(&axis, structure, least_rad_s * (1.0 + 1e-9)).unwrap();
        prop_assert!(least.gains().derivative() < 1e-6 * drag);
    }

    #[test]
    fn too_much_bandwidth_names_the_most((structure, _) in structure(), delay_s in 0.01..2.0_f64) {
        let axis = DragAxis::linear(1.0, 0.01).unwrap().with_delay_s(delay_s).unwrap();
        let Err(ControlError::TooFast { most_rad_s, .. }) = Tuning::new(&axis, structure, 5.0 / delay_s) else {
            return Err(TestCaseError::fail("not refused"));
        };
        let most = Tuning::new(&axis, structure, most_rad_s).unwrap();
        let margins = most.margins();
        prop_assert!(margins.phase_rad >= 30f64.to_radians() && margins.gain.unwrap() >= 2.0);
        prop_assert!(Tuning::new(&axis, structure, 1.03 * most_rad_s).is_err());
    }
}

/// The ratios, from the closed loop with an ideal derivative at w = 1.
#[test]
fn bandwidth_ratios() {
    for (structure, c) in STRUCTURES {
        let s = Complex::new(0.0, structure.bandwidth_ratio());
        let above = match structure {
            Structure::Pd => Complex::new(1.0, 0.0),
            Structure::Pid => s * (1.0 + 2.0 * c) + c,
            Structure::Ipd => Complex::new(c, 0.0),
        };
        let slow = if c == 0.0 { Complex::new(1.0, 0.0) } else { s + c };
        let answer = above / ((s + 1.0) * (s + 1.0) * slow);
        assert!((answer.norm() * 2f64.sqrt() - 1.0).abs() < 1e-15, "{structure:?}");
    }
}

#[test]
fn a_delay_and_drag_that_leave_no_bandwidth_are_said_so() {
    let axis = DragAxis::linear(0.1, 2.0).unwrap().with_delay_s(1.0).unwrap();
    let refusal = Tuning::new(&axis, Structure::Ipd, 8.0).unwrap_err();
    assert!(
        matches!(refusal, ControlError::NoBandwidth { least_rad_s, most_rad_s, .. } if least_rad_s > most_rad_s),
        "{refusal:?}"
    );
}

/// Poles for another slope than the axis' own; the bandwidths that a refusal names can be typed in as printed.
#[test]
fn gains_for_an_uncertain_slope() {
    let axis = DragAxis::linear(0.033, 0.02).unwrap().with_delay_s(0.2).unwrap();
    let (slope, w) = (-0.015, 0.4 / Structure::Pd.bandwidth_ratio());
    let tuning = Tuning::for_slope(&axis, slope, Structure::Pd, 0.4).unwrap();
    let residue = |drag: f64| {
        let (alpha, g) = (axis.alpha(), tuning.gains());
        let f = g.filter_s();
        let [cubic, square, linear, constant] =
            [alpha * f, alpha + drag * f, drag + g.derivative() + g.proportional() * f, g.proportional()];
        let value = -cubic * w.powi(3) + square * w * w - linear * w + constant;
        let derivative = 3.0 * cubic * w * w - 2.0 * square * w + linear;
        value.abs() / constant + derivative.abs() / linear
    };
    assert!(residue(slope) < ROUNDING_MARGIN, "{}", residue(slope));
    assert!(residue(axis.linear_drag()) > 0.1);

    // Drag that drives so strongly that the delay leaves no gains.
    let none = Tuning::for_slope(&axis, -0.2, Structure::Pd, 1.0).unwrap_err();
    assert!(matches!(none, ControlError::NoBandwidth { most_rad_s: 0.0, .. }), "{none:?}");
    assert!(Tuning::for_slope(&axis, f64::NAN, Structure::Pd, 1.0).is_err());

    let named = |error: ControlError| -> f64 {
        let text = error.to_string();
        let (_, rest) = text.split_once("ask for at ").unwrap();
        rest.split(' ').nth(1).unwrap().parse().unwrap()
    };
    for (alpha, drag, delay_s, asked) in [(0.033, 0.02, 0.2, 9.0), (3.7, 5.3, 0.05, 0.1), (1234.5, 1.1, 0.9, 9.0)] {
        let axis = DragAxis::linear(alpha, drag).unwrap().with_delay_s(delay_s).unwrap();
        let bandwidth = named(Tuning::new(&axis, Structure::Pd, asked).unwrap_err());
        assert!(Tuning::new(&axis, Structure::Pd, bandwidth).is_ok(), "{bandwidth}");
    }
}
