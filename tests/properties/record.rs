//! Records, logs, simulated experiments.

use approx::assert_relative_eq;
use proptest::prelude::*;
use selfosc::experiment::{Columns, Record, Sensor, SimulatedExperiment};
use selfosc::features::RecordFeatures;
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::orbit::limit_cycle;
use selfosc::plant::DragAxis;

use crate::tolerance;

fn log(rows: usize) -> String {
    let row = |i: usize| format!("{:.1},{},{}\n", 0.1 * i as f64, 0.5 * i as f64, if i % 8 < 4 { 1 } else { -1 });
    format!("time_s,output,command\n{}", (0..rows).map(row).collect::<String>())
}

fn refusal(text: &[u8]) -> (&'static str, String) {
    let error = Columns::default().read(text).unwrap_err();
    (error.code(), error.to_string())
}

#[test]
fn refusals_have_names_and_places() {
    let good = log(20);
    let changed = |from: &str, to: &str| good.replacen(from, to, 1);
    for (text, code, place) in [
        (String::new(), "empty", "empty"),
        ("\n  \n".to_owned(), "empty", "empty"),
        ("PNG\u{0}\u{1}".to_owned(), "not-text", "line 1"),
        (changed("command", "thrust"), "unknown-column", "thrust"),
        ("1,2,3\n".repeat(30), "no-header", "1, 2, 3"),
        (changed("0.5,2.5,", "0.5,,"), "blank-cell", "line 7"),
        (changed("0.5,2.5,", "0.5,n/a,"), "not-a-number", "line 7"),
        (changed("0.5,2.5,", "0.5,NaN,"), "not-finite", "line 7"),
        (changed("0.5,2.5,", "0.5,inf,"), "not-finite", "line 7"),
        (changed("0.5,2.5,", "0.5,-1e60,"), "too-large", "line 7"),
        (changed("0.5,2.5,", "0.4,2.5,"), "time-order", "line 7"),
        (changed("0.5,2.5,", "0.3,2.5,"), "time-order", "line 7"),
        (changed("1.9,9.5,", "19,9.5,"), "gap", "line 21"),
        (changed("0.5,2.5,", "0.5,2.5,7,"), "ragged-row", "line 7"),
        (log(5), "too-short", "5 samples"),
    ] {
        let (found, message) = refusal(text.as_bytes());
        assert_eq!(found, code, "{text}");
        assert!(message.contains(place), "{message:?} should name {place:?}");
    }
}

#[test]
fn delimiters_are_seen_and_a_decimal_comma_understood() {
    let comma = Columns::default().read(log(20).as_bytes()).unwrap();
    let semicolon = log(20).replace(',', ";").replace('.', ",");
    let blanks = log(20).replace(',', "   ");
    let tabulated = format!("\u{feff}# made by hand\n{}", log(20).replace(',', "\t").replace('\n', "\r\n"));
    for other in [semicolon, blanks, tabulated] {
        assert_eq!(Columns::default().read(other.as_bytes()).unwrap(), comma, "{other}");
    }
}

/// Minutes and hours by the column's name, switches by their words, and the pulses of a servo, whose neutral is not zero.
#[test]
fn logs_of_households_are_read() {
    let plain = log(20);
    let record =
        |text: &str| Columns::default().read(text.as_bytes()).map(|log| log.record).map_err(|error| error.code());
    let expected = record(&plain).unwrap();
    for (name, seconds) in [("time_min", 60.0), ("time_h", 3600.0)] {
        let slow = |line: &str| {
            let (time, rest) = line.split_once(',').unwrap();
            time.parse::<f64>().map_or(format!("{name},{rest}\n"), |time| format!("{},{rest}\n", time / seconds))
        };
        let columns = Columns { time: Some(name.to_owned()), ..Columns::default() };
        let read = columns.read(plain.lines().map(slow).collect::<String>().as_bytes()).unwrap().record;
        assert!(read.time_s().iter().zip(expected.time_s()).all(|(a, b)| (a - b).abs() < 1e-9), "{name}");
    }
    let switched = plain.replace(",1\n", ",On\n").replace(",-1\n", ",off\n");
    assert_eq!(record(&switched).unwrap().input()[..8], [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(record(&plain.replacen(",2.5,", ",on,", 1)), Err("not-a-number"));
    for [high, low] in [["2000", "1000"], ["1900", "1100"], ["2100", "900"]] {
        let pulses = plain.replace(",1\n", &format!(",{high}\n")).replace(",-1\n", &format!(",{low}\n"));
        assert_eq!(record(&pulses), Err("neutral"));
    }
}

/// Rows of the output alone, each behind a row of the command alone, are the log that has both; a row before the first command is none.
#[test]
fn commands_hold_where_topics_are_merged() {
    let plain = log(20);
    let rows: Vec<Vec<&str>> = plain.lines().map(|row| row.split(',').collect()).collect();
    let in_turn = |row: &Vec<&str>| format!("{},,{}\n{},{},\n", row[0], row[2], row[0], row[1]);
    let merged: String = rows[1..].iter().map(in_turn).collect();
    let merged = format!("{}\n-0.1,7,\n{merged}", rows[0].join(","));
    let holding = Columns { hold_command: true, ..Columns::default() };
    let read = |columns: &Columns, text: &str| columns.read(text.as_bytes()).map_err(|error| error.code());
    assert_eq!(read(&Columns::default(), &merged), Err("blank-cell"));
    assert_eq!(read(&holding, &merged), read(&Columns::default(), &plain));
    // Commands that follow their outputs, by however much of an interval.
    for after_s in [0.001, 0.033, 0.099] {
        let followed = |row: &Vec<&str>| {
            let late = row[0].parse::<f64>().unwrap() + after_s;
            format!("{},{},\n{late:.3},,{}\n", row[0], row[1], row[2])
        };
        let late: String = rows[1..].iter().map(followed).collect();
        assert_eq!(read(&holding, &format!("{}\n{late}", rows[0].join(","))), read(&Columns::default(), &plain));
    }
    assert_eq!(read(&holding, &merged.replacen(",,-1", ",,none", 1)), Err("not-a-number"));
    assert_eq!(read(&holding, &plain.replacen(",-1", ",none", 1)), Err("not-a-number"));
    assert_eq!(read(&holding, &merged.replacen(",2.5,", ",n/a,", 1)), Err("not-a-number"));
}

/// Twenty rows a tenth of a second apart across midnight.
#[test]
fn dates_are_seconds() {
    let plain = log(20);
    for (day, zone) in [('T', "Z"), (' ', "")] {
        let dated = |(n, row): (usize, &str)| {
            let (past, values) = (n % 10, row.split_once(',').unwrap().1);
            let date = if n < 10 { format!("28{day}23:59:59") } else { format!("29{day}00:00:00") };
            format!("2026-11-{date}.{past}{zone},{values}\n")
        };
        let rows: String = plain.lines().skip(1).enumerate().map(dated).collect();
        let named =
            |time: &str| Columns::default().read(format!("{time},output,command\n{rows}").as_bytes()).unwrap().record;
        let record = named("time");
        // The microsecond is the last digit of a number of this size.
        let late = (0..20).map(|n| record.time_s()[n] - (1_795_910_399.0 + 0.1 * n as f64));
        assert!(late.map(f64::abs).fold(0.0, f64::max) < 1e-6, "{:?}", record.time_s());
        assert!((named("time_ms").time_s()[19] - record.time_s()[19]).abs() < 1e-6);
    }
    let wrong = plain.replacen("\n0.0,", "\n2026-13-01T00:00:00Z,", 1);
    assert_eq!(refusal(wrong.as_bytes()).0, "not-a-number");
}

#[test]
fn columns_can_be_named() {
    let columns = Columns { output: Some("OUTPUT".into()), degrees: true, ..Columns::default() };
    let log = columns.read(log(20).as_bytes()).unwrap();
    assert_relative_eq!(log.record.output()[4], 2f64.to_radians());
}

proptest! {
    /// Whatever the bytes, an answer or a refusal.
    #[test]
    fn no_bytes_make_the_reader_panic(bytes in prop::collection::vec(any::<u8>(), 0..400), headed in any::<bool>()) {
        let text = if headed { [b"t,y,u\n".to_vec(), bytes].concat() } else { bytes };
        let _ = Columns::default().read(text.as_slice());
    }

    /// Cells that look like numbers, in rows of any length.
    #[test]
    fn no_table_makes_the_features_panic(
        cells in prop::collection::vec(prop_oneof!["-?[0-9]{1,3}(\\.[0-9]{1,3})?", "", "1e999", "nan"], 0..200),
        width in 2..5usize,
    ) {
        let rows: Vec<String> = cells.chunks(width).enumerate().map(|(i, row)| format!("{i},{}", row.join(","))).collect();
        let text = format!("t,y,u\n{}", rows.join("\n"));
        if let Ok(log) = Columns::default().read(text.as_bytes()) {
            let _ = RecordFeatures::of(&log.record);
        }
    }

    /// Turns taken out are the turns that wrapping put in.
    #[test]
    fn headings_are_unwrapped(start in -720.0..720.0f64, steps in prop::collection::vec(-170.0..170.0f64, 20..60)) {
        let mut heading = start;
        let angles: Vec<f64> = steps.iter().map(|step| { heading += step; heading }).collect();
        let row = |(i, angle): (usize, &f64)| format!("{i},{:.9},1\n", angle.rem_euclid(360.0));
        let text: String = angles.iter().enumerate().map(row).collect();
        let log = Columns::default().read(format!("t,heading_deg,u\n{text}").as_bytes()).unwrap();
        let turns = (angles[0] - angles[0].rem_euclid(360.0)).to_radians();
        for (read, angle) in log.record.output().iter().zip(&angles) {
            prop_assert!((read + turns - angle.to_radians()).abs() < tolerance::PRINTED_ANGLE);
        }
    }

    /// The step of a rounding sensor is found, and none in readings that were not rounded.
    #[test]
    fn the_sensors_step_is_seen(quantum in 1e-3..0.1f64, amplitude in 0.3..3.0f64, omega in 0.3..3.0f64) {
        let time: Vec<f64> = (0..600).map(|i| 0.1 * f64::from(i)).collect();
        let smooth: Vec<f64> = time.iter().map(|t| amplitude * (omega * t).sin() + 1e-3 * t).collect();
        let rounded = smooth.iter().map(|x| (x / quantum).round() * quantum).collect();
        let record = |output| Record::new(time.clone(), output, vec![0.0; 600]).unwrap();
        if amplitude / quantum < 60.0 {
            assert_relative_eq!(record(rounded).quantum().unwrap(), quantum, max_relative = tolerance::ROUNDED_STEP);
        }
        prop_assert_eq!(record(smooth).quantum(), None);
    }
}

/// The loop of a held relay by a step integrator: another method.
fn by_small_steps(axis: &DragAxis<f64>, level: f64, half_width: f64, sensor: &Sensor, samples: usize) -> Vec<f64> {
    let (step, per_sample) = (1e-4, 1000);
    let acceleration = |v: f64, u: f64| {
        (u + axis.disturbance() - axis.linear_drag() * v - axis.quadratic_drag() * v * v.abs()) / axis.alpha()
    };
    let steps = |delay: f64| (delay / step).round() as usize;
    let (mut x, mut v, mut positions, mut commands, mut readings) = (0.0, 0.0, Vec::new(), Vec::new(), Vec::new());
    let mut command = level;
    for k in 0..samples * per_sample {
        positions.push(x);
        if k % per_sample == 0 {
            let reading: f64 = positions[k.saturating_sub(steps(sensor.delay_s))];
            let reading = (reading / sensor.quantum).round() * sensor.quantum;
            readings.push(reading);
            if reading >= half_width {
                command = -level;
            } else if reading <= -half_width {
                command = level;
            }
        }
        commands.push(command);
        let u = commands[k.saturating_sub(steps(axis.delay_s()))];
        // Heun's method: the velocity is smooth between commands.
        let (a, b) = (acceleration(v, u), acceleration(v + step * acceleration(v, u), u));
        x += step * v + 0.5 * step * step * a;
        v += 0.5 * step * (a + b);
    }
    readings
}

#[test]
fn a_held_loop_agrees_with_small_steps() {
    for (linear, quadratic, disturbance) in [(0.6, 0.0, 0.0), (0.0, 0.8, 0.15), (0.3, 0.4, -0.2)] {
        let axis = DragAxis::mixed(1.0, linear, quadratic).unwrap().with_disturbance(disturbance).unwrap();
        let axis = axis.with_delay_s(0.13).unwrap();
        let sensor = Sensor { delay_s: 0.07, quantum: 0.01, noise: 0.0 };
        let experiment =
            SimulatedExperiment::new(axis, RelayHysteresis::new(1.0, 0.25, 0.0).unwrap(), 10.0).unwrap().held();
        let record = experiment.with_sensor(sensor).unwrap().run(30.0).unwrap();
        let other = by_small_steps(&axis, 1.0, 0.25, &sensor, record.samples());
        // Readings at the edge of a step may fall on either side of it; the loop must not part ways.
        let apart = record.output().iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let differing = record.output().iter().zip(&other).filter(|(a, b)| (*a - *b).abs() > 1e-9).count();
        assert!(apart < 1.01 * sensor.quantum && differing <= 3, "{differing} readings differ, by {apart} at most");
    }
}

proptest! {
    #![proptest_config(crate::sampling::config(32))]

    /// A relay that watches all the time settles on the exact limit cycle; its delay may be on either way.
    #[test]
    fn a_continuous_loop_settles_on_the_limit_cycle(
        linear in 0.05..1.5f64, quadratic in 0.05..1.5f64, half_width in 0.1..0.8f64,
        disturbance in -0.4..0.4f64, delay_s in 0.0..0.3f64, sensed in 0.0..1.0f64,
    ) {
        let axis = DragAxis::mixed(1.0, linear, quadratic).unwrap().with_disturbance(disturbance).unwrap();
        let relay = RelayHysteresis::new(1.0, half_width, 0.0).unwrap();
        let exact = limit_cycle(&axis.with_delay_s(delay_s).unwrap(), &relay).unwrap();
        let sensor = Sensor { delay_s: sensed * delay_s, ..Sensor::default() };
        let axis = axis.with_delay_s((1.0 - sensed) * delay_s).unwrap();
        let experiment = SimulatedExperiment::new(axis, relay, 200.0).unwrap().with_sensor(sensor).unwrap();
        let found = RecordFeatures::of(&experiment.run(40.0 * exact.period_s).unwrap()).unwrap();
        let last = found.cycles.last().unwrap();
        assert_relative_eq!(last.amplitude(), exact.amplitude, max_relative = tolerance::DENSE_FEATURE);
        prop_assert!((last.period_s - exact.period_s).abs() <= 1.01 / 200.0);
        prop_assert!((last.time_positive_s - exact.time_positive_s).abs() <= 1.01 / 200.0);
    }
}
