//! Margins over intervals: nothing inside falls below the bound, and the bound is near.

use proptest::prelude::*;
use selfosc::control::{AxisIntervals, ControlError, OpenLoop, Structure, Tuning, WorstMargin};
use selfosc::numeric::Interval;
use selfosc::plant::DragAxis;

use crate::sampling::recorded;

fn around(value: f64, share: f64) -> Interval {
    Interval::new(value * (1.0 - share), value * (1.0 + share)).unwrap()
}

fn list(margin: &WorstMargin) -> [f64; 4] {
    let limit = |margin: Option<f64>| margin.unwrap_or(f64::INFINITY);
    [limit(margin.gain), limit(margin.gain_reduction), margin.phase_rad, margin.delay_s]
}

proptest! {
    #![proptest_config(recorded(24))]

    #[test]
    fn nothing_inside_is_worse(
        which in 0..3_usize, drag in 0.0..1.0_f64, delay_s in 0.0..0.3_f64,
        shares in [0.0..0.2_f64, 0.0..0.8_f64, 0.0..0.5_f64],
        inside in prop::collection::vec([0.0..=1.0_f64, 0.0..=1.0_f64, 0.0..=1.0_f64], 200),
    ) {
        let axis = DragAxis::linear(1.3, drag).unwrap().with_delay_s(delay_s).unwrap();
        let structure = [Structure::Pd, Structure::Pid, Structure::Ipd][which];
        let Ok(tuning) = Tuning::new(&axis, structure, 0.8) else { return Ok(()) };
        let intervals = [around(1.3, shares[0]), around(drag, shares[1]), around(delay_s, shares[2])];
        let Ok(worst) = AxisIntervals::new(intervals[0], intervals[1], intervals[2]).unwrap().worst_margins(tuning.gains()) else {
            return Ok(());
        };
        let (least, met) = (list(&worst.at_least), list(&worst.met));
        for (least, met) in least.iter().zip(met) {
            prop_assert!(*least <= met && (*least >= 0.985 * met || worst.boxes >= 19_000), "{:?}", worst);
        }
        for at in inside {
            let place = |k: usize| intervals[k].lower() + at[k] * intervals[k].width();
            let axis = DragAxis::linear(place(0), place(1)).unwrap().with_delay_s(place(2)).unwrap();
            let margins = OpenLoop::new(&axis, tuning.gains(), 0.0).unwrap().margins().unwrap();
            let limit = |margin: Option<f64>| margin.unwrap_or(f64::INFINITY);
            let found = [limit(margins.gain), limit(margins.gain_reduction), margins.phase_rad, margins.delay_s];
            for (found, least) in found.iter().zip(least) {
                prop_assert!(*found >= least, "{:?} below {:?}", margins, worst);
            }
        }
    }
}

/// The worst of the delay margin inside, not at a corner, is what corners alone would miss: the bound does not.
#[test]
fn an_unstable_axis_inside_is_found() {
    let axis = DragAxis::linear(1.0, 0.5).unwrap().with_delay_s(0.1).unwrap();
    let tuning = Tuning::new(&axis, Structure::Pd, 1.0).unwrap();
    let between = |low, high| Interval::new(low, high).unwrap();
    let wide = AxisIntervals::new(between(0.9, 1.1), between(0.4, 0.6), between(0.0, 3.0)).unwrap();
    assert!(matches!(wide.worst_margins(tuning.gains()), Err(ControlError::Unstable { delay_s, .. }) if delay_s > 0.1));
}

/// A slope of quadratic drag over a range of speeds.
#[test]
fn a_range_of_speeds_is_a_range_of_slopes() {
    let between = |low, high| Interval::new(low, high).unwrap();
    let made =
        AxisIntervals::at_speeds(between(0.9, 1.1), between(0.1, 0.2), between(0.3, 0.4), 2.0, between(0.1, 0.1))
            .unwrap();
    let slopes = between(0.1, 0.2 + 2.0 * 0.4 * 2.0);
    let direct = AxisIntervals::new(between(0.9, 1.1), slopes, between(0.1, 0.1)).unwrap();
    let gains = Tuning::new(&DragAxis::linear(1.0, 0.1).unwrap(), Structure::Pd, 0.8).unwrap();
    let (a, b) = (made.worst_margins(gains.gains()).unwrap(), direct.worst_margins(gains.gains()).unwrap());
    for (a, b) in list(&a.at_least).iter().zip(list(&b.at_least)) {
        assert!(*a == b || (a / b - 1.0).abs() < 1e-9, "{a} {b}");
    }
}
