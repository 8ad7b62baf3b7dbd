//! Which logs are relay experiments: manoeuvres by a simulator of this file, experiments of every kind by the independent simulator.

use selfosc::experiment::Record;
use selfosc::features::NotAnExperiment;
use selfosc::identify::{Delay, Method, Refusal, Session, Settings, Trust};
use selfosc_simulator::kinds::Kind;

const INTERVAL_S: f64 = 0.1;
const STEPS: usize = 5;

/// Uniform numbers from -1 to 1: the upper bits of a linear congruential generator (Knuth).
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A vehicle of inertia and quadratic drag 1 for so many seconds; `command` sees time, reading and rate.
fn driven(seconds: f64, draw: &mut Draw, mut command: impl FnMut(f64, f64, f64) -> f64) -> Record {
    let (mut x, mut v) = (0.0_f64, 0.0_f64);
    let (mut time_s, mut output, mut input) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..(seconds / INTERVAL_S) as usize {
        let (t, reading) = (INTERVAL_S * k as f64, x + 0.003 * draw.next());
        let u = command(t, reading, v);
        time_s.push(t);
        output.push(reading);
        input.push(u);
        for _ in 0..STEPS {
            v += INTERVAL_S / STEPS as f64 * (u + 0.05 - v.abs() * v);
            x += INTERVAL_S / STEPS as f64 * v;
        }
    }
    Record::new(time_s, output, input).unwrap()
}

/// The command of a relay of half-width 0.3.
fn relay() -> impl FnMut(f64, f64, f64) -> f64 {
    let mut side = 1.0;
    move |_, reading, _| {
        if reading.abs() > 0.3 {
            side = -reading.signum();
        }
        side
    }
}

const MANOEUVRES: [&str; 10] = [
    "a step under a controller",
    "station keeping under a controller",
    "a joystick",
    "one change of the command",
    "a doublet",
    "a relay for one cycle",
    "a sweep",
    "a random command",
    "a relay beside another output",
    "a switched command of a vehicle that is held",
];

/// A log that is no relay experiment; `variant` changes its numbers.
fn manoeuvre(name: &str, variant: u64) -> Record {
    let mut draw = Draw(1 + variant);
    let size = 1.0 + 0.3 * variant as f64;
    let mut other = Draw(77 + variant);
    match name {
        "a step under a controller" => {
            driven(60.0, &mut draw, |_, reading, rate| (size * (1.0 - reading) - 1.5 * rate).clamp(-1.0, 1.0))
        }
        "station keeping under a controller" => driven(60.0, &mut draw, |t, reading, rate| {
            (0.5 * size * ((0.2 * size * t).sin() - reading) - rate).clamp(-1.0, 1.0)
        }),
        "a joystick" => {
            let (mut from, mut to, mut begin_s, mut end_s) = (0.0, 0.0, 0.0, 0.0);
            driven(60.0, &mut draw, move |t, _, _| {
                if t >= end_s {
                    (from, to, begin_s, end_s) = (to, other.next(), t, t + 2.0 + 1.5 * other.next());
                }
                from + (to - from) * (t - begin_s) / (end_s - begin_s)
            })
        }
        "one change of the command" => driven(60.0, &mut draw, |t, _, _| if t < 10.0 * size { 0.0 } else { 1.0 }),
        "a doublet" => driven(60.0, &mut draw, |t, _, _| match t {
            t if t < 10.0 => 0.0,
            t if t < 10.0 + 5.0 * size => 1.0,
            t if t < 10.0 + 10.0 * size => -1.0,
            _ => 0.0,
        }),
        "a relay for one cycle" => driven(2.0 + 0.5 * size, &mut draw, relay()),
        "a sweep" => driven(60.0, &mut draw, |t, _, _| (0.2 * size * t + 0.01 * t * t).sin()),
        "a random command" => driven(60.0, &mut draw, move |_, _, _| other.next()),
        "a relay beside another output" => {
            let log = driven(60.0, &mut draw, relay());
            let output = log.time_s().iter().map(|t| 0.1 * (0.37 * size * t).sin() + 0.02 * other.next()).collect();
            Record::new(log.time_s().to_vec(), output, log.input().to_vec()).unwrap()
        }
        "a switched command of a vehicle that is held" => {
            let log = driven(
                60.0,
                &mut draw,
                |t, _, _| if ((t / (2.0 + size)) as u64).is_multiple_of(2) { 1.0 } else { -1.0 },
            );
            let output = log.time_s().iter().map(|_| 0.01 * other.next()).collect();
            Record::new(log.time_s().to_vec(), output, log.input().to_vec()).unwrap()
        }
        _ => unreachable!("{name}"),
    }
}

fn session(record: Record, any_input: bool) -> Session {
    let settings = Settings { method: Method::Fit, delay: Delay::Estimated, any_input, ..Settings::default() };
    Session::new(settings).record("log", record)
}

#[test]
fn fifty_logs_of_other_manoeuvres_are_refused_and_none_is_good() {
    let mut passed = Vec::new();
    for name in MANOEUVRES {
        for variant in 0..5 {
            match session(manoeuvre(name, variant), false).identify() {
                Err(refusal) => assert_eq!(refusal.code(), "no-experiment", "{name} {variant}: {refusal}"),
                Ok(found) => {
                    assert_ne!(found.reported().map(|reported| reported.trust), Some(Trust::Good), "{name} {variant}");
                    passed.push((name, variant));
                }
            }
        }
    }
    assert!(passed.len() <= 2, "{passed:?}");
}

/// Every kind of the catalogue whose command a relay, a rudder or a switch gives.
#[test]
fn five_hundred_experiments_are_not_refused() {
    let mut count = 0;
    for seed in 0..4 {
        for kind in Kind::all() {
            let case = kind.case(55_800 + seed);
            for run in &case.runs {
                let mut output = run.record.output.clone();
                if let Some(turn) = case.known.turn {
                    for index in 1..output.len() {
                        let jump = output[index] - output[index - 1];
                        output[index] -= turn * (jump / turn).round();
                    }
                }
                let record = Record::new(run.record.time_s.clone(), output, run.record.input.clone()).unwrap();
                assert_eq!(NotAnExperiment::find(&record), None, "{} {}", kind.name, case.seed);
                count += 1;
            }
        }
    }
    assert!(count >= 500, "{count}");
}

/// What is missing decides what an answer to any input is worth.
#[test]
fn any_input_is_doubtful_or_widened() {
    let one_cycle = manoeuvre("a relay for one cycle", 4);
    let refused = session(one_cycle.clone(), false).identify();
    assert!(matches!(refused, Err(Refusal::NoExperiment { .. })), "{refused:?}");
    let trusts = [(one_cycle, Trust::Doubtful), (manoeuvre("a joystick", 0), Trust::Widened)];
    for (record, trust) in trusts {
        let found = session(record, true).identify().unwrap();
        let reported = found.reported().unwrap();
        assert!(reported.reasons.iter().any(|reason| reason.code() == "no-experiment"), "{reported:?}");
        assert!(reported.trust >= trust, "{reported:?}");
    }
}
