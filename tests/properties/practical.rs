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
