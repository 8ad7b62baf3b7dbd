//! Margins against sweeps, the argument principle and simulation at the edge.

use proptest::prelude::*;
use selfosc::control::{ControlError, Controller, Gains, OpenLoop, StepResponse, Structure, Tuning};
use selfosc::plant::DragAxis;

use super::oracle::{Case, case};
use crate::sampling::recorded;
use crate::tolerance::{MARGIN, PADE, ROUNDING_MARGIN, SINGLE};

/// Gain, reduction (infinite for none), phase, delay.
fn computed(case: &Case) -> Result<[f64; 4], ControlError> {
    let margins = case.open_loop().margins()?;
    let limit = |margin: Option<f64>| margin.unwrap_or(f64::INFINITY);
    Ok([limit(margins.gain), limit(margins.gain_reduction), margins.phase_rad, margins.delay_s])
}

proptest! {
    #![proptest_config(recorded(256))]

    #[test]
    fn response_is_that_of_the_blocks(case in case(), omega in 0.01..50.0_f64) {
        let (re, im) = case.open_loop().response(omega);
        let expected = case.response(omega);
        prop_assert!(((re - expected.re).hypot(im - expected.im)) < ROUNDING_MARGIN * expected.norm());
    }

    #[test]
    fn unstable_poles_are_those_of_the_argument_principle(case in case()) {
        let counted = case.unstable_by_angle();
        // Roots near the axis turn the angle slowly; the count is then no whole number.
        prop_assume!((counted - counted.round()).abs() < 0.02);
        prop_assert_eq!(f64::from(case.open_loop().unstable_poles()), counted.round());
    }
}

proptest! {
    #![proptest_config(recorded(24))]

    #[test]
    fn margins_are_those_of_a_sweep(case in case()) {
        let Ok(found) = computed(&case) else { return Ok(()) };
        for (name, (found, swept)) in ["gain", "reduction", "phase", "delay"].iter().zip(found.iter().zip(case.swept())) {
            // The sweep ends at 1e4 rad/s, and begins at 1e-4.
            let beyond = swept.is_infinite() && !(1e-6..1e6).contains(found);
            prop_assert!(found == &swept || beyond || (found / swept - 1.0).abs() < MARGIN, "{}: {} {}", name, found, swept);
        }
    }
}

/// Ratio of the output's last swings about the reference to earlier ones.
fn growth(axis: &DragAxis<f64>, gains: &Gains<f64>, crossover: f64) -> f64 {
    let response =
        StepResponse::simulate(axis, Controller::new(gains), 1.0, 400.0 * crossover, 300.0 / crossover).unwrap();
    let error: Vec<f64> = response.output().iter().map(|x| x - 1.0).collect();
    let largest = |part: &[f64]| part.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
    let quarter = error.len() / 4;
    largest(&error[3 * quarter..]) / largest(&error[quarter..2 * quarter])
}

/// The delay margin in time: a little less delay decays, a little more grows; the same for the gain.
#[test]
fn simulation_at_the_margins() {
    for (structure, drag) in [(Structure::Pd, 0.0), (Structure::Pd, 0.8), (Structure::Pid, 0.3), (Structure::Ipd, 0.5)]
    {
        let axis = DragAxis::linear(2.0, drag).unwrap().with_delay_s(0.1).unwrap();
        let tuning = Tuning::new(&axis, structure, 0.8).unwrap();
        let (margins, gains) = (tuning.margins(), tuning.gains());
        let delayed = |share: f64| axis.with_delay_s(0.1 + share * margins.delay_s).unwrap();
        // At the margin itself a pair of poles is on the imaginary axis, at the crossover.
        let poles = OpenLoop::new(&delayed(1.0), gains, 0.0).unwrap().closed_loop_poles().unwrap();
        let distance = poles[0].re.hypot(poles[0].im.abs() - margins.crossover_rad_s) / margins.crossover_rad_s;
        assert!(distance < PADE, "{structure:?} drag {drag}: {distance} from the axis");
        for (share, stable) in [(0.96, true), (1.04, false)] {
            let growth = growth(&delayed(share), gains, margins.crossover_rad_s);
            assert_eq!(
                growth < 1.0,
                stable,
                "{structure:?} drag {drag}: {share} of the delay margin grows by {growth}"
            );
        }
        let stronger = |share: f64| {
            let k = 1.0 + share * (margins.gain.unwrap() - 1.0);
            let scaled = [gains.proportional(), gains.integral(), gains.derivative()].map(|gain| k * gain);
            Gains::new(structure, scaled[0], scaled[1], scaled[2], gains.filter_s()).unwrap()
        };
        for (share, stable) in [(0.96, true), (1.04, false)] {
            let growth = growth(&axis, &stronger(share), margins.crossover_rad_s);
            assert_eq!(growth < 1.0, stable, "{structure:?} drag {drag}: {share} of the gain margin grows by {growth}");
        }
    }
}

/// An integral action without drag: two integrators too many, stable between two gains only.
#[test]
fn conditionally_stable_loop() {
    let axis = DragAxis::linear(1.0, 0.0).unwrap();
    let at = |k: f64| {
        let gains = Gains::new(Structure::Pid, k * 3.0, k, k * 3.0, 0.0).unwrap();
        OpenLoop::new(&axis, &gains, 0.0).unwrap()
    };
    // s^3 + k (3 s^2 + 3 s + 1): Routh has 9 k > 1.
    let margins = at(1.0).margins().unwrap();
    assert_eq!(margins.gain, None);
    assert!((margins.gain_reduction.unwrap() - 9.0).abs() < 1e-12);
    assert!(matches!(at(0.11).margins(), Err(ControlError::Unstable { poles: 2, .. })));
    assert_eq!(at(0.112).unstable_poles(), 0);
}

/// Delays from none to absurd: a margin or a refusal, and no number that is none.
#[test]
fn extreme_delays_and_frequencies() {
    let powers = [-300, -200, -100, -30, -9, 0, 9, 30, 100, 200, 300].map(|power| 10f64.powi(power));
    for (delay_s, pace) in powers.iter().flat_map(|delay| powers.map(|pace| (*delay, pace))) {
        let gains = Gains::new(Structure::Pd, pace, 0.0, pace.sqrt(), 0.0).unwrap();
        let axis = DragAxis::linear(1.0, 0.0).unwrap().with_delay_s(delay_s).unwrap();
        if let Ok(margins) = OpenLoop::new(&axis, &gains, 0.0).and_then(|open_loop| open_loop.margins()) {
            let limits = [margins.gain.unwrap_or(1.0), margins.phase_rad, margins.delay_s, margins.crossover_rad_s];
            assert!(limits.iter().all(|limit| *limit > 0.0), "{delay_s} {pace} {margins:?}");
        }
    }
}

/// In single precision to a few of its digits.
#[test]
fn single_precision() {
    let wide =
        Tuning::new(&DragAxis::mixed(0.033, 0.01, 0.06).unwrap().with_delay_s(0.2).unwrap(), Structure::Pid, 0.7)
            .unwrap();
    let narrow = Tuning::new(
        &DragAxis::<f32>::mixed(0.033, 0.01, 0.06).unwrap().with_delay_s(0.2).unwrap(),
        Structure::Pid,
        0.7,
    )
    .unwrap();
    let near = |narrow: f32, wide: f64| assert!((f64::from(narrow) / wide - 1.0).abs() < SINGLE, "{narrow} {wide}");
    near(narrow.gains().integral(), wide.gains().integral());
    near(narrow.margins().phase_rad, wide.margins().phase_rad);
    near(narrow.margins().gain.unwrap(), wide.margins().gain.unwrap());
    near(narrow.margins().delay_s, wide.margins().delay_s);
}

/// Delay stabilises what is unstable without: three crossovers, the middle one of which takes poles to the left.
#[test]
fn delay_takes_poles_to_the_left() {
    let poles = |delay_s: f64| {
        let gains = Gains::new(Structure::Pid, 0.4, 1.5, 3.0, 0.0).unwrap();
        let case = Case { alpha: 1.0, drag: 0.0, delay_s, gains };
        assert!((case.unstable_by_angle() - f64::from(case.open_loop().unstable_poles())).abs() < 0.02, "{delay_s}");
        case.open_loop().unstable_poles()
    };
    let counts: Vec<u32> = (0..60).map(|k| poles(0.05 * f64::from(k) + 0.013)).collect();
    assert!(counts.windows(2).any(|pair| pair[1] < pair[0]), "{counts:?}");
    assert!(counts.windows(2).any(|pair| pair[1] > pair[0]), "{counts:?}");
}

/// Quadratic drag acts by its slope at a speed.
#[test]
fn speed_adds_the_slope_of_quadratic_drag() {
    let gains = Gains::new(Structure::Pd, 1.0, 0.0, 1.0, 0.05).unwrap();
    let moving = OpenLoop::new(&DragAxis::mixed(1.0, 0.2, 0.5).unwrap(), &gains, -0.7).unwrap();
    let linear = OpenLoop::new(&DragAxis::linear(1.0, 0.2 + 2.0 * 0.5 * 0.7).unwrap(), &gains, 0.0).unwrap();
    assert_eq!(moving, linear);
}
