//! Statistics of sensor, logger and forces.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use selfosc_simulator::command::Commander;
use selfosc_simulator::experiment::Run;
use selfosc_simulator::force::ForcePath;
use selfosc_simulator::kinds::{FIRST_REPORT_SEED, Group, Kind, locked_period};
use selfosc_simulator::random::Random;
use selfosc_simulator::scenario::{Logged, Scenario};
use selfosc_simulator::sensor::Sensor;
use selfosc_simulator::vehicle::{Drag, Force, Vehicle};

/// A vehicle adrift at a constant speed.
fn drifting(sensor: Sensor) -> Run {
    let scenario = Scenario {
        vehicle: Vehicle::default(),
        commander: Commander::Sequence { changes: vec![(0.0, 0.0)] },
        sensor,
        logged: Logged::Order,
        duration_s: 2000.0,
        lead_s: 0.0,
        first_stamp_s: 0.0,
        position: 0.0,
        speed: 0.017_3,
        starts_high: true,
    };
    scenario.run(11)
}

fn errors(run: &Run) -> Vec<f64> {
    run.record.output.iter().zip(&run.position).map(|(reading, position)| reading - position).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn covariance(values: &[f64], lag: usize) -> f64 {
    mean(&values.iter().zip(&values[lag..]).map(|(a, b)| a * b).collect::<Vec<_>>())
}

#[test]
fn rounding_is_to_the_grid_and_even() {
    let run = drifting(Sensor { quantum: 0.1, grid_offset: 0.03, ..Sensor::default() });
    for reading in &run.record.output {
        let steps = (reading - 0.03) / 0.1;
        assert!((steps - steps.round()).abs() < 1e-9);
    }
    let errors = errors(&run);
    assert!(errors.iter().all(|error| error.abs() <= 0.05 + 1e-12));
    assert!((covariance(&errors, 0) / (0.01 / 12.0) - 1.0).abs() < 0.01, "{}", covariance(&errors, 0));
}

#[test]
fn noise_has_its_spread_and_colour() {
    for (noise_correlation, readings_per_sample) in [(0.0, 1), (0.9, 1), (0.9, 3)] {
        let run = drifting(Sensor { noise: 0.2, noise_correlation, readings_per_sample, ..Sensor::default() });
        let errors = errors(&run);
        // 20 000 samples, of which with a correlation of 0.9 a tenth counts: four standard deviations.
        let variance = covariance(&errors, 0);
        assert!((variance / 0.04 - 1.0).abs() < 0.13, "{variance}");
        for lag in 1..4 {
            let correlation = covariance(&errors, lag) / variance;
            let expected = noise_correlation.powi(lag as i32);
            assert!((correlation - expected).abs() < 0.03, "lag {lag}: {correlation} for {expected}");
        }
    }
}

/// Student's t of three degrees of freedom: half of it lies within 0.7649, and its variance is three.
#[test]
fn heavy_tails_have_the_quartiles_of_student() {
    let run = drifting(Sensor { noise: 0.2, noise_freedom: 3, ..Sensor::default() });
    let mut sizes: Vec<f64> = errors(&run).iter().map(|error| error.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let expected = 0.2 * 0.764_9 / 3.0_f64.sqrt();
    assert!((sizes[sizes.len() / 2] / expected - 1.0).abs() < 0.03);
    assert!(sizes[sizes.len() * 99 / 100] > 0.6, "tails no heavier than Gaussian ones");
}

#[test]
fn a_walk_spreads_with_the_root_of_time() {
    let run = drifting(Sensor { walk: 0.1, ..Sensor::default() });
    let errors = errors(&run);
    let steps: Vec<f64> = errors.windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert!((covariance(&steps, 0) / (0.01 * 0.1) - 1.0).abs() < 0.04);
    assert!((covariance(&steps, 1) / covariance(&steps, 0)).abs() < 0.03);
}

#[test]
fn outliers_have_their_share_and_size() {
    let run = drifting(Sensor { outlier_share: 0.03, outlier: 2.0, ..Sensor::default() });
    let errors = errors(&run);
    let share = errors.iter().filter(|error| (error.abs() - 2.0).abs() < 1e-9).count() as f64 / errors.len() as f64;
    assert!((share - 0.03).abs() < 0.005, "{share}");
    assert!(errors.iter().all(|error| error.abs() < 1e-9 || (error.abs() - 2.0).abs() < 1e-9));
}

#[test]
fn missing_samples_gaps_and_stamps() {
    let run = drifting(Sensor { missing_share: 0.3, ..Sensor::default() });
    assert!((run.record.time_s.len() as f64 / 20_001.0 - 0.7).abs() < 0.01);
    let run = drifting(Sensor { gap_every_s: 8.0, gap_s: 0.7, ..Sensor::default() });
    let gaps = run.record.time_s.windows(2).filter(|pair| pair[1] - pair[0] > 0.15).count() as f64;
    assert!((gaps / (2000.0 / 9.7) - 1.0).abs() < 0.2, "{gaps}");
    let longest = run.record.time_s.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    assert!((0.75..0.95).contains(&longest), "{longest}");
    let run = drifting(Sensor { late_s: 0.03, ..Sensor::default() });
    let late: Vec<f64> = run.record.time_s.iter().zip(&run.instant_s).map(|(stamp, instant)| stamp - instant).collect();
    assert!(late.iter().all(|late| (-1e-9..0.03).contains(late)));
    assert!((mean(&late) - 0.015).abs() < 0.001);
    let run = drifting(Sensor { irregular_s: 0.03, ..Sensor::default() });
    for (stamp, instant) in run.record.time_s.iter().zip(&run.instant_s) {
        assert!((stamp - instant).abs() < 1e-9);
    }
    assert!(run.record.time_s.windows(2).any(|pair| (pair[1] - pair[0] - 0.1).abs() > 0.03));
}

#[test]
fn readings_wrap_and_repeat() {
    let run = drifting(Sensor { turn: 1.5, ..Sensor::default() });
    assert!(run.record.output.iter().all(|reading| reading.abs() <= 0.75 + 1e-12));
    for error in errors(&run) {
        assert!((error / 1.5 - (error / 1.5).round()).abs() < 1e-9);
    }
    let run = drifting(Sensor { refresh_every: 3, ..Sensor::default() });
    assert!(run.record.output.chunks(3).all(|chunk| chunk.iter().all(|reading| *reading == chunk[0])));
}

/// The relay sees what is logged: with a rounding it switches at readings, not at positions.
#[test]
fn the_relay_switches_on_the_reading() {
    let scenario = Scenario {
        vehicle: Vehicle { drag: Drag { quadratic: 0.5, ..Drag::default() }, ..Vehicle::default() },
        commander: Commander::Relay { levels: vec![(0.0, 1.0)], half_width: 0.3, centre: 0.0, ideal: false },
        sensor: Sensor { quantum: 0.1, noise: 0.02, ..Sensor::default() },
        logged: Logged::Order,
        duration_s: 60.0,
        lead_s: 0.0,
        first_stamp_s: 0.0,
        position: 0.0,
        speed: 0.0,
        starts_high: true,
    };
    let run = scenario.run(3);
    let mut expected = 1.0;
    let mut switchings = 0;
    for (reading, input) in run.record.output.iter().zip(&run.record.input) {
        let before = expected;
        if *reading >= 0.3 {
            expected = -1.0;
        } else if *reading <= -0.3 {
            expected = 1.0;
        }
        switchings += usize::from(before != expected);
        assert_eq!(*input, expected);
    }
    assert!(switchings > 10);
}

/// Two thousand seconds of a random force, as the vehicle feels it at its knots.
#[test]
fn random_forces() {
    let force = Force { walk: 0.05, ..Force::default() };
    let values = ForcePath::new(force, Random::new(1, "force")).values(1_000_000);
    let steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert!((covariance(&steps, 0) / (0.0025 * 0.002) - 1.0).abs() < 0.01);
    assert!((covariance(&steps, 1) / covariance(&steps, 0)).abs() < 0.01);
    let force = Force { ornstein_uhlenbeck: 0.2, ornstein_uhlenbeck_time_s: 0.5, ..Force::default() };
    let values = ForcePath::new(force, Random::new(1, "force")).values(1_000_000);
    assert!((covariance(&values, 0) / 0.04 - 1.0).abs() < 0.1);
    let correlation = covariance(&values, 250) / covariance(&values, 0);
    assert!((correlation - (-1.0_f64).exp()).abs() < 0.05, "{correlation}");
}

#[test]
fn other_units_change_numbers_only() {
    for kind in Kind::all() {
        let run = kind.case(2).runs.remove(0);
        let other = run.scenario.in_units(8.0, 0.25).run(run.seed);
        for (a, b) in run.record.output.iter().zip(&other.record.output) {
            assert!((0.25 * a - b).abs() <= 1e-7 * a.abs().max(1e-3), "{}: {a} and {b}", kind.name);
        }
        for (a, b) in run.record.input.iter().zip(&other.record.input) {
            assert!((8.0 * a - b).abs() <= 1e-7 * a.abs(), "{}: {a} and {b}", kind.name);
        }
    }
}

#[test]
fn the_catalogue_is_whole() {
    let kinds = Kind::all();
    assert!(kinds.len() >= 55, "{}", kinds.len());
    let outside = kinds.iter().filter(|kind| kind.group == Group::Outside).count();
    assert!(outside >= 12, "{outside}");
    for (index, kind) in kinds.iter().enumerate() {
        assert!(kinds[..index].iter().all(|other| other.name != kind.name), "{} twice", kind.name);
        for seed in [1, 2, FIRST_REPORT_SEED - 1] {
            let (case, again) = (kind.case(seed), kind.case(seed));
            for (run, again) in case.runs.iter().zip(&again.runs) {
                assert_eq!(run.record, again.record, "{}", kind.name);
                assert!(run.record.time_s.windows(2).all(|pair| pair[0] < pair[1]), "{}", kind.name);
                assert!(run.record.output.iter().all(|reading| reading.is_finite()), "{}", kind.name);
                let switchings = run.record.input.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
                assert!(switchings >= 4, "{} {seed}: {switchings} switchings", kind.name);
            }
            if kind.name.starts_with("locked") {
                assert!(locked_period(&case.runs[0].record.output).is_some());
            }
        }
    }
}
