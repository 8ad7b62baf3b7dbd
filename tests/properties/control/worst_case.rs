//! Margins over intervals: nothing inside falls below the bound, and the bound is near.

use proptest::prelude::*;
use selfosc::control::{
    ControlError, Gains, LinearProcess, OpenLoop, ProcessIntervals, RobustCriterion, Structure, Tuning, WorstMargin,
};
use selfosc::numeric::Interval;
use selfosc::plant::DragAxis;

use crate::sampling::recorded;

fn around(value: f64, share: f64) -> Interval {
    Interval::new(value * (1.0 - share), value * (1.0 + share)).unwrap()
}

/// Axes with a drag of these slopes.
pub(crate) fn axes([alpha, drag, delay_s]: [Interval; 3]) -> ProcessIntervals {
    let mut parts = [Interval::ZERO; 9];
    (parts[0], parts[1], parts[8]) = (alpha, drag, delay_s);
    ProcessIntervals::new(LinearProcess::from_parts(parts)).unwrap()
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
        let Ok(worst) = axes(intervals).worst_margins(tuning.gains()) else { return Ok(()) };
        let (least, met) = (list(&worst.at_least), list(&worst.met));
        for (least, met) in least.iter().zip(met) {
            prop_assert!(*least <= met && (*least >= 0.98 * met || !worst.proved), "{:?}", worst);
        }
        for at in inside {
            let place = |k: usize| intervals[k].lower() + at[k] * intervals[k].width();
            let axis = DragAxis::linear(place(0), place(1)).unwrap().with_delay_s(place(2)).unwrap();
            let margins = OpenLoop::new(&axis, tuning.gains(), 0.0).unwrap().margins().unwrap();
            // A factor beyond counts as no limit.
            let below = |factor: &f64| *factor < ProcessIntervals::NO_LIMIT;
            let limit = |margin: Option<f64>| margin.filter(below).unwrap_or(f64::INFINITY);
            let found = [limit(margins.gain), limit(margins.gain_reduction), margins.phase_rad, margins.delay_s];
            for (found, least) in found.iter().zip(least) {
                prop_assert!(*found >= least, "{:?} below {:?}", margins, worst);
            }
        }
    }
}

/// Margins that are met are not proved by 1 % more: the proof has teeth.
#[test]
fn more_than_is_met_is_not_proved() {
    let axis = DragAxis::linear(1.0, 0.5).unwrap().with_delay_s(0.1).unwrap();
    for (structure, share) in [(Structure::Pd, 0.0), (Structure::Pd, 0.1), (Structure::Pid, 0.2), (Structure::Ipd, 0.1)]
    {
        let tuning = Tuning::new(&axis, structure, 0.8).unwrap();
        let processes = axes([around(1.0, share), around(0.5, share), around(0.1, share)]);
        let worst = processes.worst_margins(tuning.gains()).unwrap();
        assert!(worst.proved, "{worst:?}");
        let kinds = [
            RobustCriterion::Gain as fn(f64) -> RobustCriterion,
            RobustCriterion::GainReduction,
            RobustCriterion::PhaseRad,
            RobustCriterion::DelayS,
        ];
        for (of, (least, met)) in kinds.into_iter().zip(list(&worst.at_least).into_iter().zip(list(&worst.met))) {
            let unlimited = !met.is_finite();
            assert!(unlimited || processes.all_have(tuning.gains(), of(least)), "{structure:?} {share} {least}");
            assert!(unlimited || !processes.all_have(tuning.gains(), of(1.01 * met)), "{structure:?} {share} {met}");
        }
    }
}

/// A delay within the interval, below its end, at which the axis is unstable.
#[test]
fn an_unstable_axis_is_found() {
    let axis = DragAxis::linear(1.0, 0.5).unwrap().with_delay_s(0.1).unwrap();
    let tuning = Tuning::new(&axis, Structure::Pd, 1.0).unwrap();
    let between = |low, high| Interval::new(low, high).unwrap();
    let wide = axes([between(0.9, 1.1), between(0.4, 0.6), between(0.0, 3.0)]);
    let refusal = wide.worst_margins(tuning.gains());
    assert!(matches!(refusal, Err(ControlError::NotStabilised { delay_s, .. }) if delay_s > 0.1), "{refusal:?}");
}

/// At one delay beyond the critical one an axis is unstable, though it is stable without delay and not critical with its own.
#[test]
fn an_axis_beyond_its_critical_delay_is_not_proved() {
    let gains = Gains::new(Structure::Pd, 1.0, 0.0, 1.0, 0.1).unwrap();
    let late = |delay_s| axes([Interval::ONE, Interval::point(0.1), Interval::point(delay_s)]);
    assert!(late(0.1).all_stable(&gains) && !late(3.0).all_stable(&gains));
    assert!(!late(3.0).all_have(&gains, RobustCriterion::PhaseRad(0.0)));
}
