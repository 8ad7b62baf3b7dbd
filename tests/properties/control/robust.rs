//! Criteria over a box of processes: no process inside is worse than what is proved, by complex arithmetic of its own.

use nalgebra::Complex;
use proptest::prelude::*;
use selfosc::control::{AxisModel, Gains, LinearProcess, ProcessIntervals, RobustCriterion, Structure, UncertainDrag};
use selfosc::numeric::Interval;

use crate::sampling::recorded;

/// Loop gain at a frequency, factor by factor.
fn loop_gain(p: &LinearProcess<f64>, gains: &Gains<f64>, omega: f64) -> Complex<f64> {
    let (s, one) = (Complex::new(0.0, omega), Complex::new(1.0, 0.0));
    let lag = |time: f64| one / (s * time + 1.0);
    let force = s * s * p.alpha + s * p.drag + p.stiffness + s * p.memory * lag(p.memory_s);
    let controller = gains.integral() / s + gains.proportional() + s * gains.derivative() * lag(gains.filter_s());
    controller * lag(p.lag_s) * lag(p.filter_s) * (s * p.zero_s + 1.0) * (-s * p.delay_s).exp() / force
}

/// The largest sensitivity on a grid of frequencies.
fn sensitivity(p: &LinearProcess<f64>, gains: &Gains<f64>) -> f64 {
    let grid = (0..3000).map(|k| 1e-4 * 1.006_f64.powi(k));
    grid.map(|omega| 1.0 / (loop_gain(p, gains, omega) + 1.0).norm()).fold(0.0, f64::max)
}

fn between(low: f64, high: f64) -> Interval {
    Interval::new(low, high).unwrap()
}

/// A box about these parameters, of which each may be off by a share.
fn around(parts: [f64; 9], share: f64) -> LinearProcess<Interval> {
    let [alpha, drag, stiffness, memory, memory_s, lag_s, filter_s, zero_s, delay_s] =
        parts.map(|part| between(part * (1.0 - share), part * (1.0 + share)));
    LinearProcess { alpha, drag, stiffness, memory, memory_s, lag_s, filter_s, zero_s, delay_s }
}

fn inside(process: &LinearProcess<Interval>, at: &[f64]) -> LinearProcess<f64> {
    let place = |side: Interval, at: f64| side.lower() + at * side.width();
    LinearProcess {
        alpha: place(process.alpha, at[0]),
        drag: place(process.drag, at[1]),
        stiffness: place(process.stiffness, at[2]),
        memory: place(process.memory, at[3]),
        memory_s: place(process.memory_s, at[4]),
        lag_s: place(process.lag_s, at[5]),
        filter_s: place(process.filter_s, at[6]),
        zero_s: place(process.zero_s, at[7]),
        delay_s: place(process.delay_s, at[8]),
    }
}

fn gains(integral: f64) -> Gains<f64> {
    let structure = if integral > 0.0 { Structure::Pid } else { Structure::Pd };
    Gains::new(structure, 0.5, integral, 0.9, 0.1).unwrap()
}

/// Axes of an ellipsoid of which each parameter is off by up to a share along all of them together.
fn axes(parts: [f64; 9], signs: &[f64], share: f64) -> [[f64; 9]; 5] {
    let axis = |k: usize| core::array::from_fn(|part| share * parts[part] * signs[(5 * part + k) % signs.len()]);
    core::array::from_fn(axis)
}

proptest! {
    #![proptest_config(recorded(16))]

    /// Ellipsoids along any axes: a limit above the processes of the surface is proved, and a limit below one of them is not.
    #[test]
    fn an_ellipsoid_keeps_what_its_surface_keeps(
        parts in (0.5..2.0_f64, 0.2..1.0_f64, 0.0..1.0_f64, 0.0..0.3_f64, 0.05..0.3_f64),
        signs in prop::collection::vec(-1.0..1.0_f64, 45), share in 0.01..0.05_f64, integral in 0.0..0.1_f64,
        places in prop::collection::vec(-1.0..1.0_f64, 300),
    ) {
        let (alpha, drag, stiffness, zero_s, delay_s) = parts;
        let centre = [alpha, drag, stiffness, 0.0, 0.0, 0.05, 0.0, zero_s, delay_s];
        let Ok(set) = ProcessIntervals::ellipsoid(centre, axes(centre, &signs, share)) else { return Ok(()) };
        let gains = gains(integral);
        let mut worst = 0.0_f64;
        for point in places.chunks(5) {
            let size = point.iter().map(|z| z * z).sum::<f64>().sqrt() * (1.0 + 1e-12);
            let coordinates = core::array::from_fn(|k| point.get(k).map_or(0.0, |z| z / size));
            if let Some(process) = set.at(coordinates) {
                worst = worst.max(sensitivity(&process, &gains));
            }
        }
        if set.points_stable(&gains) && worst < 3.0 {
            prop_assert!(set.all_have(&gains, RobustCriterion::Sensitivity(1.3 * worst)), "{worst}");
        }
        prop_assert!(worst == 0.0 || !set.all_have(&gains, RobustCriterion::Sensitivity(0.9999 * worst)));
    }
}

proptest! {
    #![proptest_config(recorded(64))]

    /// Coefficients `c + 2 L z` with `|z| = 1` are those of the ellipsoid `2 sqrt(J C J^T)` supports, `C = L L^T`: their slopes are inside, and
    /// the two worst of each speed near the ends.
    #[test]
    fn slopes_are_those_of_the_ellipsoid(
        coefficients in proptest::array::uniform3(-1.0..1.0_f64),
        factor in proptest::array::uniform6(-0.5..0.5_f64),
        top_speed in 0.01..3.0_f64,
    ) {
        let [a, b, c, d, e, f] = factor;
        let rows = [[a, 0.0, 0.0], [b, c, 0.0], [d, e, f]];
        let product = |i: usize, j: usize| (0..3).map(|k| rows[i][k] * rows[j][k]).sum::<f64>();
        let covariance = core::array::from_fn(|i| core::array::from_fn(|j| product(i, j)));
        let slopes = UncertainDrag { coefficients, covariance }.slopes(top_speed);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for k in 0..=200 {
            let speed = top_speed * f64::from(k) / 200.0;
            let by = [1.0, 2.0 * speed, 3.0 * speed * speed];
            let across: [f64; 3] = core::array::from_fn(|k| (0..3).map(|i| rows[i][k] * by[i]).sum());
            let reach = 2.0 * across.iter().map(|part| part * part).sum::<f64>().sqrt();
            let slope: f64 = (0..3).map(|i| by[i] * coefficients[i]).sum();
            (low, high) = (low.min(slope - reach), high.max(slope + reach));
        }
        prop_assert!(slopes.lower() <= low && high <= slopes.upper());
        let size = 1.0 + 2.0 * top_speed + 3.0 * top_speed * top_speed;
        prop_assert!(low - slopes.lower() <= 0.05 * size && slopes.upper() - high <= 0.05 * size, "{slopes:?} {low} {high}");
    }
}

proptest! {
    #![proptest_config(recorded(16))]

    #[test]
    fn no_process_inside_is_more_sensitive_than_is_proved(
        drag in 0.0..0.6_f64, stiffness in 0.0..0.2_f64, lag in 0.0..0.2_f64, delay in 0.0..0.3_f64, integral in prop::option::of(0.01..0.05_f64),
        share in 0.0..0.08_f64,
        samples in prop::collection::vec(prop::collection::vec(0.0..=1.0_f64, 9), 40),
    ) {
        let process = around([1.1, drag, stiffness, 0.0, 0.0, lag, 0.05, 0.0, delay], share);
        let gains = gains(integral.unwrap_or(0.0));
        let Ok(found) = ProcessIntervals::new(process).unwrap().enclose(&gains, RobustCriterion::Sensitivity) else { return Ok(()) };
        let Some(proved) = found.proved else { return Ok(()) };
        prop_assert!(found.met <= proved && proved <= 1.31 * found.met);
        for at in samples {
            let peak = sensitivity(&inside(&process, &at), &gains);
            prop_assert!(peak <= proved * (1.0 + 1e-9), "{peak} above {found:?}");
        }
    }
}

/// The proof has teeth: a limit below what some process has is never proved, nor is one over a box that reaches beyond stability.
#[test]
fn what_is_false_is_not_proved() {
    let narrow = around([1.1, 0.3, 0.05, 0.1, 0.5, 0.1, 0.05, 0.0, 0.2], 0.03);
    let (processes, gains) = (ProcessIntervals::new(narrow).unwrap(), gains(0.0));
    let met = processes.enclose(&gains, RobustCriterion::Sensitivity).unwrap().met;
    assert!(processes.all_have(&gains, RobustCriterion::Sensitivity(1.05 * met)));
    assert!(!processes.all_have(&gains, RobustCriterion::Sensitivity(0.99 * met)));
    let late = LinearProcess { delay_s: between(0.1, 3.0), ..narrow };
    let wide = ProcessIntervals::new(late).unwrap();
    assert!(!wide.all_stable(&gains) && !wide.all_have(&gains, RobustCriterion::Sensitivity(1e6)));
    assert!(wide.enclose(&gains, RobustCriterion::PhaseRad).is_err());
}

/// A peak of the sensitivity may lie where the gain is below one: `K exp(-T s)/s` with `K = 0.99`, whose phase is critical at
/// `pi/(2 T) = 1.287`, has 4.3 there, and at most 2.8 where the gain is one.
#[test]
fn a_peak_above_the_crossover_is_seen() {
    let point = Interval::point;
    let [alpha, stiffness, memory, memory_s, lag_s, filter_s, zero_s] = [Interval::ZERO; 7];
    let (drag, delay_s) = (Interval::ONE, point(core::f64::consts::FRAC_PI_2 / 1.287));
    let process = LinearProcess { alpha, drag, stiffness, memory, memory_s, lag_s, filter_s, zero_s, delay_s };
    let processes = ProcessIntervals::new(process).unwrap();
    let gains = Gains::new(Structure::Pd, 0.99, 0.0, 0.0, 0.0).unwrap();
    let critical = 1.0 / (1.0 - 0.99 / 1.287);
    assert!(!processes.all_have(&gains, RobustCriterion::Sensitivity(0.99 * critical)));
    let peak = sensitivity(&processes.middle(), &gains);
    assert!(peak >= critical && processes.all_have(&gains, RobustCriterion::Sensitivity(1.02 * peak)), "{peak}");
}

/// A first-order process with dead time under a proportional controller: margins in closed form.
#[test]
fn margins_of_a_known_loop() {
    let none = Interval::ZERO;
    let process = LinearProcess {
        alpha: none,
        drag: Interval::ONE,
        stiffness: none,
        memory: none,
        memory_s: none,
        lag_s: none,
        filter_s: none,
        zero_s: none,
        delay_s: Interval::point(0.5),
    };
    // L = exp(-s/2)/s: phase margin pi/2 - 1/2 at 1 rad/s, gain margin pi.
    let gains = Gains::new(Structure::Pd, 1.0, 0.0, 0.0, 0.0).unwrap();
    let processes = ProcessIntervals::new(process).unwrap();
    let (half_pi, pi) = (core::f64::consts::FRAC_PI_2, core::f64::consts::PI);
    for (of, exact) in [
        (RobustCriterion::Gain as fn(f64) -> RobustCriterion, pi),
        (RobustCriterion::PhaseRad, half_pi - 0.5),
        (RobustCriterion::DelayS, half_pi - 0.5),
    ] {
        let found = processes.enclose(&gains, of).unwrap();
        let Some(proved) = found.proved else { panic!("{found:?}") };
        assert!(
            (found.met - exact).abs() < 1e-9 * exact && proved <= exact && proved > 0.98 * exact,
            "{found:?} {exact}"
        );
    }
}

/// Time constants, and the inertia of a slow process, may reach zero: the proof loses no degree. A limit below that of some
/// process is never proved, nor the stability of a set in which drag drives.
#[test]
fn parts_may_reach_zero() {
    let none = Interval::ZERO;
    let (lag_s, filter_s, memory_s) = (between(0.0, 0.1), between(0.0, 0.05), between(0.0, 0.3));
    let vehicle = LinearProcess {
        alpha: between(1.0, 1.1),
        drag: between(0.2, 0.3),
        stiffness: none,
        memory: none,
        memory_s: none,
        lag_s,
        filter_s,
        zero_s: none,
        delay_s: between(0.15, 0.2),
    };
    let watery = LinearProcess { memory: between(0.0, 0.05), memory_s, filter_s: none, ..vehicle };
    let heater = LinearProcess { alpha: between(0.0, 0.1), stiffness: between(0.1, 0.12), filter_s: none, ..vehicle };
    let damped = Gains::new(Structure::Pd, 0.5, 0.0, 0.9, 0.1).unwrap();
    let slow = Gains::new(Structure::Pid, 0.3, 0.05, 0.0, 0.0).unwrap();
    for (process, gains) in [(vehicle, damped), (watery, damped), (heater, slow)] {
        let processes = ProcessIntervals::new(process).unwrap();
        let found = processes.enclose(&gains, RobustCriterion::Sensitivity).unwrap();
        let Some(proved) = found.proved else { panic!("{found:?} of {process:?}") };
        let worst = processes.corners().iter().map(|corner| sensitivity(corner, &gains)).fold(0.0, f64::max);
        // What is given up for a proof is at most three tenths.
        assert!(worst <= proved && proved < 1.31 * worst, "{worst} {found:?}");
        assert!(!processes.all_have(&gains, RobustCriterion::Sensitivity(0.99 * worst)));
        for state in 1..200_u32 {
            let at: Vec<f64> = (1..10).map(|k| f64::from(state * 2 * k + k).sqrt().fract()).collect();
            assert!(sensitivity(&inside(&process, &at), &gains) <= proved);
        }
        let driven = LinearProcess { drag: between(-2.0, 0.3), ..process };
        assert!(ProcessIntervals::new(driven).is_ok_and(|processes| !processes.all_stable(&gains)));
    }
}

/// Of an ellipsoid no process exceeds its proved sensitivity, one of its surface nearly has it, and its hull has a process that exceeds it: what
/// varies together counts.
#[test]
fn an_ellipsoid_is_proved_and_is_less_than_its_hull() {
    let centre = [1.0, 0.3, 0.1, 0.0, 0.0, 0.05, 0.0, 0.0, 0.2];
    // A heavier process has the shorter delay.
    let heavy = [0.2, 0.05, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.15];
    let stiff = [0.02, 0.0, 0.05, 0.0, 0.0, 0.02, 0.0, 0.0, 0.01];
    let late = [0.0, 0.0, 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.03];
    let gains = gains(0.0);
    let set = ProcessIntervals::ellipsoid(centre, [heavy, stiff, late, [0.0; 9], [0.0; 9]]).unwrap();
    let at = |[x, y, z]: [f64; 3]| {
        let mut coordinates = [0.0; 9];
        coordinates[..3].copy_from_slice(&[x, y, z]);
        set.at(coordinates)
    };
    let mut largest = 0.0_f64;
    for k in 0..2000_u32 {
        let place = |step: u32| 2.0 * f64::from(step * k + 1).sqrt().fract() - 1.0;
        let point = [place(7), place(13), place(29)];
        let size = point.iter().map(|z| z * z).sum::<f64>().sqrt() * (1.0 + 1e-12);
        largest = largest.max(sensitivity(&at(point.map(|z| z / size)).unwrap(), &gains));
    }
    assert!(set.all_have(&gains, RobustCriterion::Sensitivity(1.004 * largest)), "{largest}");
    assert!(!set.all_have(&gains, RobustCriterion::Sensitivity(0.999 * largest)), "{largest}");
    let hull = set.hull();
    let worst = hull.corners().iter().map(|corner| sensitivity(corner, &gains)).fold(0.0, f64::max);
    assert!(worst > 1.03 * largest, "{worst} {largest}");
    assert!(!hull.all_have(&gains, RobustCriterion::Sensitivity(1.004 * largest)));
    // A corner of its cube is none of the ellipsoid, nor is what would be negative and cannot.
    assert!(at([0.7, 0.7, 0.7]).is_none() && at([0.57, 0.57, 0.57]).is_some());
    let mut lag = [[0.0; 9]; 5];
    lag[0][5] = 0.1;
    let reaching = ProcessIntervals::ellipsoid(centre, lag).unwrap();
    assert_eq!(reaching.process().lag_s.lower(), 0.0);
    assert!(reaching.at([-1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]).is_none());
    assert!(reaching.corners().iter().all(|corner| corner.lag_s >= 0.0));
}

/// A sinusoid that stays zero for a pause after each change of its sign, by the midpoint rule: its first harmonic lags by less than the pause, and
/// is smaller. The processes of an axis have delays up to that pause.
#[test]
fn a_pause_at_a_reversal_is_a_delay_of_up_to_the_pause() {
    use std::f64::consts::PI;
    const STEPS: u32 = 20_000;
    for pause in (1..31).map(|k| f64::from(k) * 0.1) {
        let angles = (0..STEPS).map(|k| (f64::from(k) + 0.5) * PI / f64::from(STEPS)).filter(|angle| *angle > pause);
        let harmonic: Complex<f64> = angles.map(|angle| Complex::new(0.0, -angle).exp() * angle.sin()).sum();
        // A sinusoid has -j: a lag turns its harmonic back.
        let found = harmonic * Complex::new(0.0, 2.0 / f64::from(STEPS));
        assert!(-found.arg() > 0.0 && -found.arg() < pause, "{pause}: {found}");
        assert!(found.norm() < 1.0 && (pause > 0.5 || found.norm() > 0.95), "{pause}: {found}");
    }
    let axis = AxisModel { alpha: 1.0, beta: 0.5, pause_s: 0.3, delay_s: 0.2, ..AxisModel::default() };
    let delay = axis.map(Interval::point).processes(Interval::point(0.5)).delay_s;
    assert!((delay.lower() - 0.2).abs() < 1e-12 && (delay.upper() - 0.5).abs() < 1e-12, "{delay}");
}
