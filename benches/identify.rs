//! Benchmarks of the identification.

use divan::{Bencher, black_box};
use selfosc::experiment::{Columns, Record, Sensor, SimulatedExperiment};
use selfosc::features::RecordFeatures;
use selfosc::identify::exact::MeanCycle;
use selfosc::identify::fit::joint::{FeatureRow, fit_rows};
use selfosc::identify::fit::prediction_error::Estimator;
use selfosc::identify::fit::select::likelihood::Choice;
use selfosc::identify::iso::Oscillation;
use selfosc::identify::{Delay, DragLaw};
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::plant::DragAxis;

fn main() {
    divan::main();
}

/// Row 7 of Table 4, with a disturbance.
const CYCLE: MeanCycle<f64> = MeanCycle {
    relay_level: 8.23,
    switch_level: 6.58,
    amplitude: 26.36,
    time_positive_s: 1.3,
    time_negative_s: 1.39,
    delay_s: 0.2,
};

#[divan::bench]
fn exact_linear() -> bool {
    black_box(CYCLE).linear_drag().is_ok()
}

#[divan::bench]
fn exact_quadratic() -> bool {
    black_box(CYCLE).quadratic_drag().is_ok()
}

/// The 19 rows of Table 4 under one law.
#[divan::bench(args = [DragLaw::Linear, DragLaw::Quadratic, DragLaw::Mixed], consts = [false, true])]
fn joint<const ESTIMATED: bool>(bencher: Bencher<'_, '_>, law: DragLaw) {
    let rows: Vec<FeatureRow> = include_str!("../fixtures/table4.csv")
        .lines()
        .skip(1)
        .filter_map(|line| {
            let cells: Vec<f64> = line.split(',').filter_map(|cell| cell.parse().ok()).collect();
            let [_, relay_level, switch_level, amplitude, bias, period_s, ..] = *cells else { return None };
            FeatureRow::new(&Oscillation { relay_level, switch_level, amplitude, bias, period_s, delay_s: 0.0 }).ok()
        })
        .collect();
    assert_eq!(rows.len(), 19);
    let delay = if ESTIMATED { Delay::Estimated } else { Delay::KnownS(0.2) };
    bencher.bench(|| fit_rows(black_box(&rows), law, delay).is_ok());
}

/// A record of so many seconds at 100 Hz, of a noisy sensor or of one that rounds.
fn record(duration_s: f64, rounded: bool) -> Option<Record> {
    let axis = DragAxis::quadratic(1.0, 0.5).ok()?.with_delay_s(0.1).ok()?.with_disturbance(0.1).ok()?;
    let relay = RelayHysteresis::new(1.0, 0.3, 0.0).ok()?;
    let sensor = if rounded {
        Sensor { quantum: 0.0175, ..Sensor::default() }
    } else {
        Sensor { noise: 0.01, ..Sensor::default() }
    };
    SimulatedExperiment::new(axis, relay, 100.0).ok()?.held().with_sensor(sensor).ok()?.run(duration_s).ok()
}

/// From the record to the paper's parameters.
#[divan::bench(args = [60.0, 600.0])]
fn iso_of_record(bencher: Bencher<'_, '_>, duration_s: f64) {
    let record = record(duration_s, false);
    bencher.bench(|| {
        let found = RecordFeatures::of(black_box(record.as_ref()?)).ok()?;
        Oscillation::of(&found.features, found.relay.level, 0.1).identify().ok()
    });
}

/// All drag laws fitted to the record.
#[divan::bench(args = [60.0, 600.0], consts = [false, true], sample_count = 5)]
fn fit_of_record<const ROUNDED: bool>(bencher: Bencher<'_, '_>, duration_s: f64) {
    let record = record(duration_s, ROUNDED);
    bencher.bench(|| Choice::among_all(&[black_box(record.as_ref()?)], Delay::KnownS(0.1)).ok());
}

/// The reported answer: terms looked for, models averaged.
#[divan::bench(args = [6.0, 60.0, 600.0], consts = [false, true], sample_count = 5)]
fn answer_of_record<const ROUNDED: bool>(bencher: Bencher<'_, '_>, duration_s: f64) {
    let record = record(duration_s, ROUNDED);
    bencher.bench(|| Estimator::new(Delay::Estimated).record(black_box(record.as_ref()?)).ok());
}

/// The costliest kind of record: a heater, of which many terms explain a part.
#[divan::bench(sample_count = 1)]
fn answer_of_heater(bencher: Bencher<'_, '_>) {
    let columns = Columns { process: true, ..Columns::default() };
    let log = columns.read(include_bytes!("../fixtures/heater.csv").as_slice()).ok();
    bencher.bench(|| Estimator::new(Delay::Estimated).record(&black_box(log.as_ref()?).record).ok());
}
