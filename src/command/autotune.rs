//! `selfosc autotune`: from a relay's or thermostat's record to gains with a proved limit of the sensitivity.

mod form;
mod print;

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};

use super::error::Given;
use super::log::LogArguments;
use super::number::{number, positive};
use super::{CommandError, Outcome, files, refused, write_json};
use crate::autotune::{Actions, Contradiction, GainsWanted, LoopCurves, ProcessRecord, ProvedGains, Ruled, rules};
use crate::error::Error;
use crate::experiment::{Columns, Log};
use crate::files::Files;
use crate::identify::NORMAL_95;
use crate::numeric::Interval;
use crate::numeric::domain::About;
use form::GainForm;

/// PI or PID gains for a heater, a tank, an axis: from one record of its relay, thermostat or on-off control.
///
/// The record needs two periods. Structures with dead time are fitted to every sample; the gains hold a limit of the sensitivity
/// for every process of the record's confidence set, proved in interval arithmetic, and are the fastest against a load that do. Beside them
/// stand rules of thumb, each with the sensitivity that it would have on this process: 1.4 is well damped, above 2 it rings.
/// Exit status 1 where the record gives no gains, with the reason.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  selfosc autotune heater.csv
  selfosc autotune heater.csv --pi --form klipper
  selfosc autotune heater.csv --report report.html
  selfosc autotune log.csv --output pv --input valve --ms 1.6 --json")]
pub(super) struct Arguments {
    /// Delimiter-separated text with a header; - is standard input
    #[arg(value_name = "LOG")]
    log: PathBuf,
    /// Column of times in s
    #[arg(long, value_name = "COL")]
    time: Option<String>,
    /// Column of the measured value [default: the first named temperature, temp, pv, process_value, measured, y, output, level or position]
    #[arg(long, value_name = "COL")]
    output: Option<String>,
    /// Column of the command [default: the first named duty, power, heater, heating, relay, valve, pwm, command, input, u or output]
    #[arg(long, value_name = "COL")]
    input: Option<String>,
    #[command(flatten)]
    reading: LogArguments,
    /// Largest sensitivity 1/|1 + L| of any process of the confidence set
    #[arg(long, value_name = "M", default_value_t = 1.4, value_parser = sensitivity, allow_negative_numbers = true)]
    ms: f64,
    /// Proportional and integral only
    #[arg(long, conflicts_with = "pid")]
    pi: bool,
    /// With derivative, whether it pays or not
    #[arg(long)]
    pid: bool,
    /// Derivative time over the time constant of its filter
    #[arg(long, value_name = "N", default_value_t = 10.0, value_parser = positive, allow_negative_numbers = true)]
    derivative_filter: f64,
    /// Time between two commands of the controller, s [default: the record's]
    #[arg(long, value_name = "S", value_parser = positive, allow_negative_numbers = true)]
    interval: Option<f64>,
    /// In which form the gains are printed
    #[arg(long, value_enum, value_name = "FORM", default_value_t = GainForm::Parallel)]
    form: GainForm,
    /// Command at full power, of which a firmware's gains are shares [default: 1, 100 or 255, where it is the largest in the log]
    #[arg(long, value_name = "U", value_parser = positive, allow_negative_numbers = true)]
    full_power: Option<f64>,
    /// Writes one HTML file with figures, which needs no network
    #[arg(long, value_name = "OUT.html")]
    report: Option<PathBuf>,
    /// Prints one JSON document
    #[arg(long)]
    json: bool,
}

fn sensitivity(text: &str) -> Result<f64, String> {
    let within = |value: &f64| (1.1..=3.0).contains(value);
    number(text).ok().filter(within).ok_or_else(|| "must be from 1.1 to 3; 1.4 is well damped".to_owned())
}

/// Relative half-width of a gain or a dead time above which the answer is less than good.
const WIDE: f64 = 0.25;
/// A command that is held delays by half its interval; from this part of the dead time on, it is named.
const SLOW: f64 = 0.5;
/// Its code: the gains account for it, and the trust stays.
const SLOW_CODE: &str = "slow-controller";
/// Correlation of neighbouring residuals from which on the load counts as drifting.
const WANDERS: f64 = 0.8;

/// Full power as it is usually counted: a duty, percent, a byte.
const USUAL_FULL_POWER: [f64; 3] = [1.0, 100.0, 255.0];

/// The command at full power: as given, or the log's largest where that is a usual count.
fn full_power(arguments: &Arguments, input: &[f64]) -> Result<f64, CommandError> {
    let largest = input.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let reason = match (arguments.form.is_of_firmware(), arguments.full_power) {
        (false, Some(_)) => {
            "--full-power: this form has gains in units of the command; leave it out, or choose a firmware's (--form)"
                .to_owned()
        }
        (true, None) if !USUAL_FULL_POWER.contains(&largest) => format!(
            "--form: a firmware's gains are shares of full power, and the log's largest command, {largest}, is neither 1, 100 nor \
             255; give the command at full power (--full-power)"
        ),
        (_, given) => return Ok(given.unwrap_or(largest)),
    };
    Err(CommandError::Usage { reason })
}

/// The whole answer to a record.
struct Autotuned {
    log: Log,
    found: ProcessRecord,
    proved: Option<ProvedGains>,
    rules: Vec<Ruled>,
    ultimate: Option<[Interval; 2]>,
    curves: Option<LoopCurves>,
    interval_s: f64,
    /// Command at full power, of which a firmware's gains are shares.
    full_power: f64,
    limit: f64,
}

/// A reason for less than full trust: code and text.
type CodedReason = (&'static str, String);

impl Autotuned {
    /// A quantity of every structure: its range over all, and the likeliest's value.
    fn ranged(&self, of: impl Fn(&crate::autotune::ProcessModel) -> Option<crate::autotune::Ranged>) -> Value {
        let Some(best) = self.found.models.first().and_then(&of) else { return Value::Null };
        let all: Vec<_> = self.found.models.iter().filter_map(&of).collect();
        let low = all.iter().map(|one| one.low).fold(best.low, f64::min);
        let high = all.iter().map(|one| one.high).fold(best.high, f64::max);
        json!({ "value": best.value, "std": best.std, "low": low, "high": high })
    }

    fn reasons(&self) -> Vec<CodedReason> {
        let mut reasons = Vec::new();
        if self.proved.is_none() && self.found.contradiction.is_none() {
            reasons.push((
                "too-wide",
                format!(
                    "the record leaves processes for which no gains keep a sensitivity of {}; record another period, or allow more (--ms)",
                    self.limit
                ),
            ));
        }
        reasons.extend(self.found.contradiction.map(|contradiction| {
            let (code, text) = match contradiction {
                Contradiction::AgainstRelay => (
                    "against-relay",
                    "the command rises while the output moves as if it fell; log the command that acts (a lockout or a switch may hold \
                     it back), and check the columns",
                ),
                Contradiction::Saturated => (
                    "saturated",
                    "the output stands at its extreme, as of a sensor at the end of its range; keep the oscillation inside the range",
                ),
            };
            (code, text.to_owned())
        }));
        let best = &self.found.models[0];
        for (index, name) in [(0, "gain"), (1, "dead time")] {
            let part = best.parameters[index];
            if NORMAL_95 * part.std > (WIDE * part.value.abs()).max(0.5 * self.interval_s) {
                reasons.push((
                    "wide",
                    format!(
                        "the {name} is known to {:.0} % only; record another period",
                        100.0 * NORMAL_95 * part.std / part.value.abs()
                    ),
                ));
            }
        }
        if self.found.correlation > WANDERS {
            reasons.push((
                "wandering-load",
                "what is left of the readings changes slowly, as under a load that wanders; intervals allow for it"
                    .to_owned(),
            ));
        }
        let (held_s, dead_s) = (0.5 * self.interval_s, best.parameters[1].value);
        if self.proved.is_some() && held_s > SLOW * dead_s {
            reasons.push((
                SLOW_CODE,
                format!(
                    "a command that stays for {} s delays by {} s more, above half of the dead time of {} s; the gains account for it, \
                     and a shorter interval allows faster gains (--interval)",
                    About(self.interval_s), About(held_s), About(dead_s)
                ),
            ));
        }
        reasons
    }

    fn trust(&self) -> &'static str {
        let reasons = self.reasons();
        if reasons.iter().any(|(code, _)| ["too-wide", "against-relay", "saturated"].contains(code)) {
            "doubtful"
        } else if reasons.iter().all(|(code, _)| *code == SLOW_CODE) {
            "good"
        } else {
            "widened"
        }
    }

    /// The sign of all gains.
    fn sign(&self) -> f64 {
        if self.found.reverse { -1.0 } else { 1.0 }
    }
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let mut known = Files::default();
    let input = files::input(&mut known, &arguments.log, Columns::LONGEST)?;
    let columns = arguments.reading.of(Columns {
        time: arguments.time.clone(),
        output: arguments.output.clone(),
        input: arguments.input.clone(),
        process: true,
        // The level of no command is part of the load.
        neutral: Some(0.0),
        ..Columns::default()
    });
    let report = arguments.report.as_ref().map(|path| known.output(path)).transpose().given("--report")?;
    let log = match columns.read(input.bytes()) {
        Ok(log) => log,
        Err(error) => {
            let refusal = crate::identify::Refusal::Record { name: input.name().to_owned(), source: error };
            if refusal.is_usage() {
                return Err(refusal.into());
            }
            return refused(&refusal.into(), arguments.json, output);
        }
    };
    let full_power = full_power(arguments, log.record.input())?;
    let found = match ProcessRecord::of(&log.record) {
        Ok(found) => found,
        Err(error) => return refused(&Error::from(error), arguments.json, output),
    };
    let interval_s = arguments.interval.unwrap_or_else(|| log.record.interval_s());
    let actions = match (arguments.pi, arguments.pid) {
        (true, _) => Actions::Pi,
        (_, true) => Actions::Pid,
        _ => Actions::Best,
    };
    let wanted = GainsWanted { sensitivity: arguments.ms, actions, derivative_filter: arguments.derivative_filter };
    let nominal = found.models[0].process();
    // Gains of the wrong sign drive the output away.
    let proved = if found.contradiction.is_some() { None } else { found.gains(interval_s, &wanted) };
    let tuned = Autotuned {
        curves: proved.as_ref().and_then(ProvedGains::curves),
        proved,
        rules: rules(&nominal),
        ultimate: found.ultimate(),
        log,
        found,
        interval_s,
        full_power,
        limit: arguments.ms,
    };
    if let Some(report) = report {
        let document = tuned.page(input.name(), arguments.form).from_where(files::provenance(&known));
        report.write(document.html()?.as_bytes()).given("--report")?;
    }
    let outcome = if tuned.proved.is_some() { Outcome::Done } else { Outcome::No };
    if arguments.json {
        write_json(output, &tuned.json(input.name(), arguments.form))?;
    } else {
        tuned.print(arguments.form, output)?;
        if let Some(path) = &arguments.report {
            writeln!(output, "\nreport in {}", path.display())?;
        }
    }
    Ok(outcome)
}
