//! The bound of one box by itself: branch and bound would hide a bound that is a little too good.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::*;
use crate::control::{Structure, Tuning};
use crate::plant::DragAxis;

#[test]
fn no_axis_of_a_box_is_below_its_bound() {
    let mut random = Pcg64::seed_from_u64(1);
    let mut near = 0;
    for _ in 0..400 {
        let mut draw = |from: f64, to: f64| random.random_range(from..to);
        let (alpha, drag, delay_s) = (draw(0.7, 1.4), draw(0.0, 1.0), draw(0.0, 0.1));
        let structure = [Structure::Pd, Structure::Pid, Structure::Ipd][draw(0.0, 3.0) as usize];
        let axis = DragAxis::linear(1.0, 0.5).unwrap().with_delay_s(0.05).unwrap();
        let tuning = Tuning::new(&axis, structure, 0.8).unwrap();
        let (gains, mut spread) = (tuning.gains(), |value: f64| Interval::new(value, value + draw(0.0, 0.3)).unwrap());
        let part = AxisIntervals::new(spread(alpha), spread(drag), spread(delay_s)).unwrap();
        let bound = part.bound(gains, 1e3);
        let inside = |interval: Interval, share: f64| interval.lower() + share * interval.width();
        let mut worst = [f64::INFINITY; 4];
        for point in 0..216 {
            let share = |k: i32| f64::from(point / 6_i32.pow(k as u32) % 6) / 5.0;
            let (alpha, drag) = (inside(part.alpha, share(0)), inside(part.drag, share(1)));
            let open_loop = OpenLoop::linear(alpha, drag, inside(part.delay_s, share(2)), gains);
            worst = lesser(worst, scores(&open_loop).unwrap_or([0.0; 4]));
        }
        for (bound, worst) in bound.0.iter().zip(worst) {
            // An unstable axis has no margin, and the bound of its box is none or one.
            assert!(*bound <= worst * (1.0 + 1e-9) || (worst == 0.0 && *bound <= 1.0), "{bound} {worst} {part:?}");
            near += u32::from(*bound > 0.7 * worst && worst > 0.0 && worst.is_finite());
        }
    }
    // Nor is the bound nothing at all.
    assert!(near > 600, "{near}");
}

/// What is true is proved of boxes large and small; what one loop contradicts is not, by 1 %.
#[test]
fn margins_are_proved_and_more_is_not() {
    let axis = DragAxis::linear(1.0, 0.5).unwrap().with_delay_s(0.1).unwrap();
    let between = |low, high| Interval::new(low, high).unwrap();
    for (structure, share) in [(Structure::Pd, 0.0), (Structure::Pd, 0.1), (Structure::Pid, 0.2), (Structure::Ipd, 0.1)]
    {
        let tuning = Tuning::new(&axis, structure, 0.8).unwrap();
        let around = |value: f64| between(value * (1.0 - share), value * (1.0 + share));
        let axes = AxisIntervals::new(around(1.0), around(0.5), around(0.1)).unwrap();
        let worst = axes.worst_margins(tuning.gains()).unwrap();
        assert!(worst.converged, "{worst:?}");
        let limit = |margin: Option<f64>| margin.unwrap_or(f64::INFINITY);
        let list = |m: &WorstMargin| [limit(m.gain), limit(m.gain_reduction), m.phase_rad, m.delay_s];
        assert!(Statement::new(tuning.gains(), list(&worst.at_least)).is_proved(&axes));
        for kind in 0..4 {
            let mut claimed = list(&worst.at_least);
            claimed[kind] = list(&worst.met)[kind] * 1.01;
            if claimed[kind].is_finite() {
                assert!(!Statement::new(tuning.gains(), claimed).is_proved(&axes), "{structure:?} {share} {kind}");
            }
        }
    }
}

/// Gains that leave a pole in the right half plane without delay, or with it, have no margins to prove.
#[test]
fn an_unstable_loop_is_not_proved() {
    let point = |value: f64| Interval::point(value);
    let axes = |delay_s: f64| AxisIntervals::new(point(1.0), point(0.1), point(delay_s)).unwrap();
    let hasty = Gains::new(Structure::Pid, 1.0, 5.0, 0.5, 0.1).unwrap();
    assert!(!Statement::new(&hasty, NONE).is_proved(&axes(0.0)));
    let sound = Gains::new(Structure::Pd, 1.0, 0.0, 1.0, 0.1).unwrap();
    let little = [1.0, 1.0, 0.01, 0.01];
    assert!(Statement::new(&sound, little).is_proved(&axes(0.1)));
    assert!(!Statement::new(&sound, little).is_proved(&axes(3.0)));
}
