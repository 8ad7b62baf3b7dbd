//! Cycles and features.

use proptest::prelude::*;
use selfosc::experiment::{Record, Sensor, SimulatedExperiment};
use selfosc::features::{Cycles, RecordFeatures, Summary};
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::orbit::limit_cycle;
use selfosc::plant::DragAxis;

use crate::tolerance;

/// `x = middle(t) + size(t) sin(t)` under a command that leads it, at 20 Hz.
fn oscillation(duration_s: f64, middle: impl Fn(f64) -> f64, size: impl Fn(f64) -> f64) -> Record {
    let time: Vec<f64> = (0..(20.0 * duration_s) as usize).map(|i| 0.05 * i as f64).collect();
    let output = time.iter().map(|t| middle(*t) + size(*t) * t.sin()).collect();
    let input = time.iter().map(|t| if (t + 2.0).sin() > 0.0 { 3.0 } else { -1.0 }).collect();
    Record::new(time, output, input).unwrap()
}

fn code(record: &Record) -> &'static str {
    RecordFeatures::of(record).map_or_else(|error| error.code(), |_| "features")
}

#[test]
fn every_unusable_record_has_a_name() {
    let constant = |input: f64| Record::new((0..99).map(f64::from).collect(), vec![0.0; 99], vec![input; 99]).unwrap();
    let ramp: Vec<f64> = (0..99).map(f64::from).collect();
    let moved = Record::new(ramp.clone(), ramp.iter().map(|t| t.sin()).collect(), ramp).unwrap();
    let axis = DragAxis::quadratic(1.0, 0.5).unwrap().with_disturbance(0.9).unwrap();
    let weak =
        SimulatedExperiment::new(axis, RelayHysteresis::new(0.5, 0.3, 0.0).unwrap(), 10.0).unwrap().run(60.0).unwrap();
    for (record, name) in [
        (constant(1.0), "constant-input"),
        (moved, "not-a-relay"),
        (weak, "saturated"),
        (oscillation(5.0, |_| 0.0, |_| 1.0), "no-cycle"),
        (oscillation(11.0, |_| 0.0, |_| 1.0), "too-few-cycles"),
        (oscillation(80.0, |_| 0.0, |t| (0.008 * t).exp()), "growing"),
        (oscillation(80.0, |_| 0.0, |t| (-0.008 * t).exp()), "decaying"),
        (oscillation(80.0, |t| 0.01 * t, |_| 1.0), "drift"),
        (oscillation(80.0, |_| 7.0, |_| 1.0), "features"),
    ] {
        assert_eq!(code(&record), name);
    }
}

proptest! {
    /// Two in a hundred each cycle, or half as much again: never just too few cycles. Eight steps or more between the cycles
    /// counted (two fewer than the record has, steps one fewer still) of 2 % each pass the limit of 15 %; seven do not.
    #[test]
    fn growth_and_decay_are_named_at_any_rate(percent in 2.0..80.0f64, growing: bool, cycles in 10..15u32) {
        let rate = (1.0 + percent / 100.0).ln() / core::f64::consts::TAU;
        let rate = if growing { rate } else { -rate };
        let record = oscillation(core::f64::consts::TAU * (f64::from(cycles) + 1.5), |_| 0.0, |t| (rate * t).exp());
        prop_assert_eq!(code(&record), if growing { "growing" } else { "decaying" });
    }

    /// A start-up that dies away is no decay, however far it begins from the end, in either direction.
    #[test]
    fn a_start_up_that_settles_is_not_a_trend(excess in -0.7..3.0f64, kept in 0.05..0.5f64) {
        let rate = -kept.ln() / core::f64::consts::TAU;
        let record = oscillation(150.0, |_| 0.0, |t| 1.0 + excess * (-rate * t).exp());
        prop_assert_eq!(code(&record), "features");
    }
}

#[test]
fn the_reference_is_taken_out() {
    let found = RecordFeatures::of(&oscillation(80.0, |_| 7.0, |_| 1.0)).unwrap();
    assert!((found.relay.level - 2.0).abs() < 1e-12 && (found.relay.offset - 1.0).abs() < 1e-12);
    // The levels are read at samples: half a sample's motion each.
    assert!((found.features.reference.mean - 7.0).abs() < 0.05 && found.features.bias.mean.abs() < 0.05);
}

#[test]
fn start_up_is_left_out() {
    let found = RecordFeatures::of(&oscillation(120.0, |_| 0.0, |t| 1.0 + 2.0 * (-t / 10.0).exp())).unwrap();
    assert!(found.features.start_up_cycles >= 2, "{found:?}");
    assert!((found.features.amplitude.mean - 1.0).abs() < 0.03, "{found:?}");
}

fn experiment(
    half_width: f64,
    quadratic: f64,
    sensor: Sensor,
    seed: u64,
) -> (SimulatedExperiment, DragAxis<f64>, RelayHysteresis<f64>) {
    let axis = DragAxis::quadratic(1.0, quadratic).unwrap().with_disturbance(0.1).unwrap().with_delay_s(0.1).unwrap();
    let relay = RelayHysteresis::new(1.0, half_width, 0.0).unwrap();
    let experiment = SimulatedExperiment::new(axis, relay, 10.0).unwrap().with_sensor(sensor).unwrap().with_seed(seed);
    (experiment, axis, relay)
}

proptest! {
    #![proptest_config(crate::sampling::config(64))]

    /// The same samples one by one: the same numbers.
    #[test]
    fn the_stream_agrees_with_the_batch(half_width in 0.1..0.6f64, quadratic in 0.1..2.0f64, noise in 0.0..0.02f64, seed: u64) {
        let sensor = Sensor { noise, quantum: 0.01, ..Sensor::default() };
        let record = experiment(half_width, quadratic, sensor, seed).0.held().run(60.0).unwrap();
        let batch = RecordFeatures::of(&record).unwrap();
        let (mut cycles, mut summary) = (Cycles::new(0.0), Summary::new());
        for k in 0..record.samples() {
            if let Some(cycle) = cycles.step(record.time_s()[k], record.output()[k], record.input()[k]) {
                summary.push(cycle);
            }
        }
        prop_assert_eq!(summary.features().unwrap(), batch.features);
        // And by the definitions, over the cycles found.
        let steady = &batch.cycles[batch.features.start_up_cycles as usize..];
        let mean = steady.iter().map(|cycle| cycle.amplitude()).sum::<f64>() / steady.len() as f64;
        prop_assert!((mean - batch.features.amplitude.mean).abs() < tolerance::SUM * mean);
    }

    /// At 10 Hz peaks lie between samples, and a step of the sensor is larger than the difference.
    #[test]
    fn peaks_are_interpolated(half_width in 0.15..0.6f64, quadratic in 0.1..1.5f64, quantum in prop_oneof![Just(0.0), Just(0.0175)]) {
        let (experiment, axis, relay) = experiment(half_width, quadratic, Sensor { quantum, ..Sensor::default() }, 0);
        let exact = limit_cycle(&axis, &relay).unwrap();
        let found = RecordFeatures::of(&experiment.run(120.0).unwrap()).unwrap().features;
        let allowed = tolerance::SLOW_FEATURE * exact.amplitude + 0.3 * quantum;
        prop_assert!((found.amplitude.mean - exact.amplitude).abs() <= allowed, "{found:?} {exact:?}");
        // A sampling interval over all cycles together, and what is left of the start-up.
        let allowed = 0.1 / f64::from(found.cycles) + tolerance::START_UP_LEFT * exact.period_s;
        prop_assert!((found.period_s.mean - exact.period_s).abs() <= allowed, "{found:?} {exact:?}");
    }
}

/// The record with its command going to each order's level at this rate.
fn at_rate(record: &Record, rate: f64, way: impl Fn(f64) -> f64) -> Record {
    let (time, orders) = (record.time_s(), record.input());
    let (low, high) =
        orders.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), u| (u.min(low), u.max(high)));
    let mut command = orders[0];
    let moved = (0..time.len()).map(|k| {
        if k > 0 {
            let step = rate * (time[k] - time[k - 1]);
            command += (orders[k - 1] - command).clamp(-step, step);
        }
        low + (high - low) * way((command - low) / (high - low))
    });
    let moved = moved.collect();
    Record::new(time.to_vec(), record.output().to_vec(), moved).unwrap()
}

proptest! {
    #![proptest_config(crate::sampling::config(64))]

    /// A rudder's orders are those that it obeys, every cycle as if they were logged, also where its first samples under way
    /// look as if it were at rest.
    #[test]
    fn a_rudders_orders_are_found(half_width in 0.2..0.6f64, ramp_s in 0.6..1.2f64, rate_hz in prop_oneof![Just(10.0), Just(100.0)]) {
        let axis = DragAxis::quadratic(1.0, 0.5).unwrap().with_disturbance(0.1).unwrap().with_delay_s(0.1).unwrap();
        let relay = RelayHysteresis::new(1.0, half_width, 0.0).unwrap();
        let orders = SimulatedExperiment::new(axis, relay, rate_hz).unwrap().held().run(80.0).unwrap();
        let found = RecordFeatures::of(&at_rate(&orders, 2.0 / ramp_s, |way| way)).unwrap();
        let expected = RecordFeatures::of(&orders).unwrap();
        prop_assert!((found.ramp_s - ramp_s).abs() < 1e-9 * ramp_s, "{}", found.ramp_s);
        // An order at the very end has not moved anything yet.
        let all = found.cycles.len();
        prop_assert!(expected.cycles.len() <= all + 1, "{} of {}", all, expected.cycles.len());
        prop_assert_eq!(&found.cycles[..], &expected.cycles[..all]);
        prop_assert_eq!(expected.ramp_s, 0.0);
    }
}

#[test]
fn what_goes_otherwise_from_level_to_level_is_no_rudder() {
    let orders = experiment(0.4, 0.5, Sensor::default(), 1).0.held().run(80.0).unwrap();
    assert_eq!(code(&at_rate(&orders, 2.0, |way| way)), "features");
    // Bent on its way; turned before it is there; at two rates; never at rest.
    let bent = at_rate(&orders, 2.0, |way| way * way * (3.0 - 2.0 * way));
    let mut turned = at_rate(&orders, 2.0, |way| way).input().to_vec();
    let middle = turned.iter().position(|u| u.abs() < 0.2).unwrap();
    turned[middle + 1] = turned[middle - 2];
    let turned = Record::new(orders.time_s().to_vec(), orders.output().to_vec(), turned).unwrap();
    let (slow, fast) = (at_rate(&orders, 1.0, |way| way), at_rate(&orders, 3.0, |way| way));
    let half = orders.samples() / 2;
    let two: Vec<f64> = slow.input()[..half].iter().chain(&fast.input()[half..]).copied().collect();
    let two = Record::new(orders.time_s().to_vec(), orders.output().to_vec(), two).unwrap();
    let sine: Vec<f64> = orders.time_s().iter().map(|t| t.sin()).collect();
    let sine = Record::new(orders.time_s().to_vec(), orders.output().to_vec(), sine).unwrap();
    for (name, record) in [("bent", bent), ("turned", turned), ("two rates", two), ("a sine", sine)] {
        assert_eq!(code(&record), "not-a-relay", "{name}");
    }
}

/// The streaming part holds for f32 as it does for f64: the paper's method on a microcontroller.
#[test]
fn single_precision_identifies_too() {
    let (experiment, axis, _) = experiment(0.3, 0.5, Sensor::default(), 0);
    let record = experiment.run(60.0).unwrap();
    let (mut cycles, mut summary) = (Cycles::new(0f32), Summary::new());
    for k in 0..record.samples() {
        let narrow = |value: f64| value as f32;
        let sample = [record.time_s()[k], record.output()[k], record.input()[k]].map(narrow);
        if let Some(cycle) = cycles.step(sample[0], sample[1], sample[2]) {
            summary.push(cycle);
        }
    }
    let oscillation = selfosc::identify::iso::Oscillation::of(&summary.features().unwrap(), 1f32, 0.1);
    let parameters = oscillation.identify().unwrap();
    assert!((f64::from(parameters.alpha) / axis.alpha() - 1.0).abs() < 0.2, "{parameters:?}");
    assert!(core::mem::size_of::<(Cycles<f64>, Summary<f64>)>() < 2048);
}
