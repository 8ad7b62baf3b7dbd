//! Records that tell a process badly or not at all: each is refused by name, or answered with a width that is honest.

use std::fmt::Write;

use assert_cmd::Command;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;
use serde_json::Value;

use crate::golden;

/// A heater of first order with dead time under a thermostat, in steps of a hundredth of the time between readings.
#[derive(Clone, Copy)]
struct Heater {
    gain: f64,
    dead_s: f64,
    lag_s: f64,
    interval_s: f64,
}

/// What is wrong with a record.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    /// It ends before the second change of the command.
    HalfPeriod,
    /// The sensor reads no more than a level inside the oscillation.
    Saturated,
    /// The surroundings warm up by as much as the oscillation swings.
    Drifting,
    /// Output and command are exchanged.
    ColumnsExchanged,
    /// The output column is that of another, unheated sensor.
    OtherSensor,
    /// The command steps once.
    StepTest,
    /// A compressor rests for five minutes before it starts again, and the log has the thermostat's wish.
    Lockout,
    /// The log has no more than every fortieth reading.
    Sparse,
}

const FAULTS: [Fault; 8] = [
    Fault::HalfPeriod,
    Fault::Saturated,
    Fault::Drifting,
    Fault::ColumnsExchanged,
    Fault::OtherSensor,
    Fault::StepTest,
    Fault::Lockout,
    Fault::Sparse,
];

impl Heater {
    fn drawn(seed: u64) -> Self {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut between = |low: f64, high: f64| low + (high - low) * random.random::<f64>();
        let (lag_s, share) = (between(60.0, 400.0), between(0.05, 0.4));
        let dead_s = lag_s * share;
        Self { gain: between(40.0, 300.0), dead_s, lag_s, interval_s: dead_s / between(5.0, 25.0) }
    }

    /// The log, the command from 0 to 1.
    fn log(&self, fault: Fault, seed: u64) -> String {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let step_s = self.interval_s / 100.0;
        let late = (self.dead_s / step_s).round() as usize;
        let mut under_way = vec![0.4; late + 1];
        let swing = self.gain * (1.0 - (-self.dead_s / self.lag_s).exp());
        let (mut x, mut wish, mut acts) = (0.4 * self.gain, 1.0_f64, 1.0_f64);
        let (mut rest_s, mut changes, mut rows) = (0.0, 0, vec![]);
        let periods_s = 3.5 * 4.0 * self.dead_s;
        for k in 0.. {
            let time_s = k as f64 * step_s;
            let drift = if fault == Fault::Drifting { swing * time_s / periods_s } else { 0.0 };
            if k % 100 == 0 {
                let noise: f64 = StandardNormal.sample(&mut random);
                let reading = x + drift + 0.02 * swing * noise;
                let reading =
                    if fault == Fault::Saturated { reading.min((0.4 * self.gain) + 0.1 * swing) } else { reading };
                let before = wish;
                let controlled = 0.4 * self.gain + 0.05 * swing;
                wish = match fault {
                    Fault::StepTest => f64::from(u8::from(time_s > 0.3 * periods_s)),
                    _ if reading > controlled => 0.0,
                    _ if reading < controlled - 0.1 * swing => 1.0,
                    _ => wish,
                };
                changes += usize::from(wish != before);
                if time_s > periods_s + 3.0 * self.lag_s * f64::from(u8::from(fault == Fault::Lockout))
                    || fault == Fault::HalfPeriod && changes > 1
                {
                    return Self::text(fault, &rows, 20.0);
                }
                rows.push([time_s, 20.0 + reading, wish]);
            }
            if wish == 0.0 {
                rest_s = if acts == 1.0 && fault == Fault::Lockout { 300.0 } else { rest_s };
                acts = 0.0;
            }
            rest_s -= step_s;
            if wish == 1.0 && rest_s <= 0.0 {
                acts = 1.0;
            }
            under_way[k % (late + 1)] = acts;
            let drive = self.gain * under_way[(k + 1) % (late + 1)];
            x = drive + (x - drive) * (-step_s / self.lag_s).exp();
        }
        unreachable!()
    }

    fn text(fault: Fault, rows: &[[f64; 3]], room: f64) -> String {
        let mut text = String::from("time_s,temperature,heater\n");
        for (k, [time, output, command]) in rows.iter().enumerate() {
            let cells = match fault {
                Fault::ColumnsExchanged => [*time, *command, *output],
                Fault::OtherSensor => [*time, room + 0.05 * (k.wrapping_mul(2_654_435_761) % 7) as f64, *command],
                Fault::Sparse if k % 40 != 0 => continue,
                _ => [*time, *output, *command],
            };
            writeln!(text, "{:.3},{:.3},{:.3}", cells[0], cells[1], cells[2]).unwrap();
        }
        text
    }

    /// The largest sensitivity under the gains of an answer, on a grid of frequencies; the command is held for an interval.
    fn sensitivity(&self, gains: &Value) -> f64 {
        let [p, i, d, filter_s] =
            ["proportional", "integral", "derivative", "filter_s"].map(|name| gains[name].as_f64().unwrap());
        let peak = |k: i32| {
            let omega = 1e-3 / self.dead_s * 1.01_f64.powi(k);
            let s = nalgebra::Complex::new(0.0, omega);
            let process = (-s * (self.dead_s + 0.5 * self.interval_s)).exp() * self.gain / (s * self.lag_s + 1.0);
            let controller = nalgebra::Complex::from(p) + i / s + s * d / (s * filter_s + 1.0);
            1.0 / (controller * process + 1.0).norm()
        };
        (0..1200).map(peak).fold(0.0, f64::max)
    }
}

/// One word on a record: its refusal, or trust, dead time beside the true one, and what the gains do.
fn verdict(heater: Heater, fault: Fault, seed: u64) -> (String, bool) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("log.csv"), heater.log(fault, seed)).unwrap();
    let mut command = Command::cargo_bin("selfosc").unwrap();
    let output = command.current_dir(&folder).args(["autotune", "log.csv", "--json"]).output().unwrap();
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    if let Some(refused) = answer.get("refused") {
        return (format!("refused {}", refused["code"].as_str().unwrap()), true);
    }
    let trust = answer["trust"].as_str().unwrap();
    let reasons: Vec<&str> =
        answer["reasons"].as_array().unwrap().iter().map(|one| one["code"].as_str().unwrap()).collect();
    let dead = &answer["dead_time_s"];
    let [low, high] = ["low", "high"].map(|end| dead[end].as_f64().unwrap());
    let inside = low <= heater.dead_s && heater.dead_s <= high;
    let kept = answer["gains"].is_null() || heater.sensitivity(&answer["gains"]) <= 1.45;
    let gains = match (answer["gains"].is_null(), kept) {
        (true, _) => "no gains",
        (_, true) => "gains keep 1.45",
        _ => "gains exceed 1.45",
    };
    let said = if inside { "dead time inside" } else { "dead time outside" };
    // The dead time of a wish includes the compressor's rest.
    let honest = trust == "doubtful" || kept && (inside || fault == Fault::Lockout);
    (format!("{trust} {}: {said}, {gains}", reasons.join(" ")), honest)
}

/// Ten records of each fault. An answer that is not doubtful has the true dead time inside and gains that hold.
#[test]
fn bad_records_are_refused_or_honest() {
    let mut all = String::new();
    let mut wrong = 0;
    for (place, fault) in FAULTS.into_iter().enumerate() {
        for number in 0..10 {
            let seed = 100 * place as u64 + number;
            let (said, honest) = verdict(Heater::drawn(seed), fault, seed);
            wrong += usize::from(!honest);
            writeln!(all, "{fault:?} {number}: {said}").unwrap();
        }
    }
    golden!("bad-processes", all);
    assert_eq!(wrong, 0, "{all}");
}
