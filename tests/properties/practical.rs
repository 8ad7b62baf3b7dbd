//! Practical intervals: shares that are exact, and what no source makes of them.

use selfosc::experiment::{Columns, Record, Sensor, SimulatedExperiment};
use selfosc::identify::{Assumptions, Delay, ErrorSource, Method, Reported, Session, Settings};
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::plant::DragAxis;

fn record() -> Record {
    let axis = DragAxis::mixed(1.0, 0.3, 0.4).unwrap().with_disturbance(0.1).unwrap().with_delay_s(0.2).unwrap();
    let sensor = Sensor { noise: 0.004, ..Sensor::default() };
    let relay = RelayHysteresis::new(1.0, 0.3, 0.0).unwrap();
    SimulatedExperiment::new(axis, relay, 10.0).unwrap().held().with_sensor(sensor).unwrap().run(80.0).unwrap()
}

fn settings(assume: Assumptions) -> Settings {
    Settings { method: Method::Fit, delay: Delay::Estimated, assume, ..Settings::default() }
}

/// The answer to the record with its output and its time scaled.
fn scaled(output: f64, time: f64, assume: Assumptions) -> Reported {
    let plain = record();
    let times = |values: &[f64], factor: f64| values.iter().map(|value| factor * value).collect::<Vec<f64>>();
    let record =
        Record::new(times(plain.time_s(), time), times(plain.output(), output), plain.input().to_vec()).unwrap();
    let session = Session::new(settings(assume)).record("log", record);
    session.identify().unwrap().reported().unwrap().clone()
}

/// Half the width that a source of 1 % has alone, over the value; the statistical part is taken out.
fn declared(reported: &Reported, of: fn(&Reported) -> selfosc::identify::Estimate) -> f64 {
    let estimate = of(reported);
    let (statistical, practical) = (estimate.spread.unwrap(), estimate.combined.unwrap());
    let (h, whole) = (statistical.high - estimate.value, practical.high - estimate.value);
    (whole * whole - 4.0 * h * h).sqrt() / estimate.value.abs()
}

#[test]
fn a_scale_of_output_or_time_moves_every_parameter_by_its_declared_share() {
    for (source, [output, time]) in [(ErrorSource::SensorGain, [1.01, 1.0]), (ErrorSource::Clock, [1.0, 1.01])] {
        let assume = Assumptions::NONE.with(source, 1.0);
        let (before, after) = (scaled(1.0, 1.0, assume), scaled(output, time, assume));
        let parameters: [fn(&Reported) -> selfosc::identify::Estimate; 4] =
            [|r| r.alpha, |r| r.beta, |r| r.beta_quadratic, |r| r.delay_s];
        for (index, of) in parameters.into_iter().enumerate() {
            let moved = (of(&after).value / of(&before).value).ln().abs();
            let declared = declared(&before, of);
            // ln(1.01) is half a percent less than a hundredth; the searches end within their own tolerance.
            assert!((moved - declared).abs() < 0.1 * declared + 2e-5, "{source:?} {index}: {moved} {declared}");
        }
        let share = before.budget[0].share_percent;
        assert!((share - 100.0 * declared(&before, |r| r.alpha)).abs() < 1e-6, "{share}");
    }
}

#[test]
fn without_sources_the_practical_interval_is_twice_the_statistical() {
    let reported = scaled(1.0, 1.0, Assumptions::NONE);
    assert!(reported.budget.is_empty());
    for estimate in [reported.alpha, reported.beta, reported.beta_quadratic, reported.deltas[0]] {
        let (statistical, practical) = (estimate.spread.unwrap(), estimate.combined.unwrap());
        let ratio = (practical.high - practical.low) / (statistical.high - statistical.low);
        assert!((ratio - 2.0).abs() < 1e-9, "{ratio}");
    }
}

#[test]
fn the_heading_error_counts_for_headings_alone() {
    let record = record();
    for (column, expected) in [("heading", true), ("depth_m", false)] {
        let rows = record.time_s().iter().zip(record.output()).zip(record.input());
        let rows: String = rows.map(|((time, output), input)| format!("{time},{output},{input}\n")).collect();
        let log = Columns::default().read(format!("time_s,{column},input\n{rows}").as_bytes()).unwrap();
        let session = Session::new(settings(Assumptions::default())).record("log", log);
        let found = session.identify().unwrap();
        let reported = found.reported().unwrap();
        assert_eq!(reported.budget.iter().any(|entry| entry.source == "heading-error"), expected, "{column}");
        let shares: Vec<f64> = reported.budget.iter().map(|entry| entry.share_percent).collect();
        assert!(shares.is_sorted_by(|a, b| a >= b), "{shares:?}");
    }
}

/// Speeds of the records, whose top speed is 0.7.
const SPEEDS: [f64; 3] = [0.0, 0.3, 0.6];

/// Derivatives of the drag's slope by its coefficients.
fn derivatives(speed: f64) -> [f64; 3] {
    [1.0, 2.0 * speed, 3.0 * speed * speed]
}

fn deviation(covariance: &[[f64; 3]; 3], speed: f64) -> f64 {
    let by = derivatives(speed);
    let terms = (0..9).map(|k| by[k / 3] * covariance[k / 3][k % 3] * by[k % 3]);
    terms.sum::<f64>().sqrt()
}

/// Slopes of the drag from records of one axis scatter as much as each record's covariance says, at every speed; independent coefficients
/// would scatter twice as much, or more, within the record's speeds.
#[test]
fn the_covariance_is_that_of_the_slopes_of_many_records() {
    const RECORDS: u64 = 24;
    let axis = DragAxis::mixed(1.0, 0.3, 0.4).unwrap().with_delay_s(0.2).unwrap();
    let relay = RelayHysteresis::new(1.0, 0.3, 0.0).unwrap();
    let mut squares = [[0.0; 2]; SPEEDS.len()];
    for seed in 0..RECORDS {
        let sensor = Sensor { noise: 0.004, ..Sensor::default() };
        let record = SimulatedExperiment::new(axis, relay, 10.0).unwrap().held().with_seed(seed);
        let record = record.with_sensor(sensor).unwrap();
        let found = Session::new(settings(Assumptions::NONE)).record("log", record.run(60.0).unwrap());
        let found = found.identify().unwrap();
        let reported = found.reported().unwrap();
        let covariance = reported.drag_covariance.unwrap().statistical;
        let apart = core::array::from_fn(|i| core::array::from_fn(|j| if i == j { covariance[i][i] } else { 0.0 }));
        for (speed, [together, independent]) in SPEEDS.into_iter().zip(&mut squares) {
            let error = (reported.beta.value - 0.3) + 2.0 * speed * (reported.beta_quadratic.value - 0.4);
            *together += (error / deviation(&covariance, speed)).powi(2) / RECORDS as f64;
            *independent += (error / deviation(&apart, speed)).powi(2) / RECORDS as f64;
        }
    }
    for (speed, [together, independent]) in SPEEDS.into_iter().zip(squares) {
        assert!((0.5..1.5).contains(&together.sqrt()), "{speed}: {together}");
        assert!(speed == 0.0 || independent.sqrt() < 0.5 * together.sqrt(), "{speed}: {independent} {together}");
    }
}

/// Diagonals are the squares of the intervals' deviations; a scale of 1 % adds a quarter of the product of its two changes.
#[test]
fn the_practical_covariance_is_that_of_the_practical_intervals() {
    let reported = scaled(1.0, 1.0, Assumptions::NONE.with(ErrorSource::Clock, 1.0));
    let found = reported.drag_covariance.unwrap();
    let (statistical, combined) = (found.statistical, found.combined.unwrap());
    let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-9 * b.abs(), "{a} {b}");
    for (i, drag) in [reported.beta, reported.beta_quadratic].into_iter().enumerate() {
        near(statistical[i][i], drag.spread.unwrap().std.powi(2));
        near(combined[i][i], drag.combined.unwrap().std.powi(2));
    }
    // 1 % of linear drag, 2 % of quadratic drag, each half a practical interval's half-width of two deviations; cubic drag is not reported, but
    // a model of the average may have it. The intervals' sides differ, so that correlations are compared.
    assert!(reported.beta_cubic.is_none());
    let moved = [0.005 * reported.beta.value, 0.01 * reported.beta_quadratic.value, 0.0];
    let before = |i: usize, j: usize| 1.959_963_984_540_054_f64.powi(2) * statistical[i][j] + moved[i] * moved[j];
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        let before = before(i, j) / (before(i, i) * before(j, j)).sqrt();
        near(combined[i][j] / (combined[i][i] * combined[j][j]).sqrt(), before);
    }
    assert!(statistical[0][1] < -0.5 * (statistical[0][0] * statistical[1][1]).sqrt());
}

/// Two equal records halve the covariance; records that do not agree have none.
#[test]
fn records_that_agree_pool_their_covariances() {
    let session = |records: &[Record]| {
        let session = Session::new(settings(Assumptions::NONE));
        let session = records.iter().fold(session, |session, record| session.record("log", record.clone()));
        session.identify().unwrap().reported().unwrap().drag_covariance
    };
    let (one, two) = (session(&[record()]).unwrap(), session(&[record(), record()]).unwrap());
    for (one, two) in one.combined.unwrap().into_iter().zip(two.combined.unwrap()) {
        one.into_iter().zip(two).for_each(|(one, two)| assert!((two - 0.5 * one).abs() <= 1e-9 * one.abs()));
    }
    // Its diagonal is that of the pooled intervals.
    let pooled = [record(), record()]
        .into_iter()
        .fold(Session::new(settings(Assumptions::NONE)), |session, record| session.record("log", record));
    let pooled = pooled.identify().unwrap().reported().cloned().unwrap();
    for (i, drag) in [pooled.beta, pooled.beta_quadratic].into_iter().enumerate() {
        let (variance, deviation) = (two.combined.unwrap()[i][i], drag.combined.unwrap().std);
        assert!((variance - deviation.powi(2)).abs() <= 1e-9 * variance, "{i}: {variance} {deviation}");
    }
    let axis = DragAxis::mixed(1.0, 0.6, 0.4).unwrap().with_delay_s(0.2).unwrap();
    let sensor = Sensor { noise: 0.004, ..Sensor::default() };
    let other = SimulatedExperiment::new(axis, RelayHysteresis::new(1.0, 0.3, 0.0).unwrap(), 10.0).unwrap();
    let other = other.held().with_sensor(sensor).unwrap().run(80.0).unwrap();
    assert_eq!(session(&[record(), other]), None);
}

/// The reported values are those of one model: with them the motion leaves the error of rounding and no more. Means over the models, each
/// parameter by itself, leave twice as much of the first record.
#[test]
fn the_reported_values_belong_together() {
    const DEGREE: f64 = core::f64::consts::PI / 180.0;
    for half_width in [0.3, 0.28, 0.34] {
        let axis = DragAxis::mixed(0.033, 0.004, 0.02).unwrap().with_delay_s(0.2).unwrap();
        let axis = axis.with_disturbance(0.004).unwrap();
        let relay = RelayHysteresis::new(0.08, half_width, 0.0).unwrap();
        let sensor = Sensor { quantum: DEGREE, ..Sensor::default() };
        let record = SimulatedExperiment::new(axis, relay, 10.0).unwrap().held().with_sensor(sensor).unwrap();
        let record = record.run(50.0).unwrap();
        let found = Session::new(settings(Assumptions::NONE)).record("log", record.clone()).identify().unwrap();
        let left = found.reported().unwrap().predict(&record).unwrap().rms;
        assert!(left < 1.1 * DEGREE / 12_f64.sqrt(), "{half_width}: {left}");
    }
}
