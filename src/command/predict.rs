//! `selfosc predict`: the self-oscillation of a drag axis, or all orbits of a linear plant.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use serde_json::json;

use super::axis::{AxisArguments, MotionArguments, RelayArguments};
use super::error::in_context;
use super::number::number;
use super::{CommandError, Outcome, orbits, write_json};
use crate::balance::AxisOscillation;
use crate::numeric::significant;
use crate::orbit::{Certificate, LimitCycle, Starts, certify, limit_cycle};

/// The exact self-oscillations under a relay: of a drag axis, or of any linear plant with dead time.
///
/// Drag axis: alpha x'' + (beta + beta_quadratic |x'|) x' = u(t - delay) + delta, from the closed-form motion between switchings, with
/// harmonic balance (first harmonic only, the paper's approximation) beside it and a certificate in interval arithmetic.
/// Linear plant (--num, --den): every orbit with one switching each way in a period, from the slowest down. Each is proved to exist;
/// its multipliers decide its stability. No other orbit has a period in the range printed.
/// Output is whatever unit half-width has (rad, m), command whatever relay has (N m, N).
/// Exit status 1 where there is no such oscillation, with the reason.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  selfosc predict --alpha 0.033 --beta-quadratic 0.007 --relay 0.08 --half-width 0.21 --delay 0.2
  selfosc predict --alpha 1 --beta 1 --relay 1 --half-width 0.2 --delta 0.3 --json
  selfosc predict --num 1 --den 1,1 --delay 1 --relay 1 --half-width 0
  selfosc predict --num 2 --den 30,1 --delay 4 --relay 1,0 --half-width 0.1 --reference 1.2")]
#[command(group(clap::ArgGroup::new("plant").required(true).args(["alpha", "num"])))]
pub(super) struct Arguments {
    /// Inertia with added mass of a drag axis, command units per output unit per s^2
    #[arg(long, value_parser = number, value_name = "A", allow_negative_numbers = true)]
    alpha: Option<f64>,
    /// Linear drag, command units per output unit per s
    #[arg(long, value_parser = number, value_name = "B", allow_negative_numbers = true, conflicts_with = "num")]
    beta: Option<f64>,
    /// Quadratic drag, command units per (output unit per s)^2
    #[arg(long, value_parser = number, value_name = "Q", allow_negative_numbers = true, conflicts_with = "num")]
    beta_quadratic: Option<f64>,
    /// Constant disturbance of a drag axis, command units
    #[arg(long, value_parser = number, value_name = "D", allow_negative_numbers = true, conflicts_with = "num")]
    delta: Option<f64>,
    /// Numerator of a linear plant, descending powers of s
    #[arg(long, value_parser = number, value_name = "A,B,...", value_delimiter = ',', requires = "den", allow_hyphen_values = true)]
    num: Vec<f64>,
    /// Denominator of a linear plant, descending powers of s
    #[arg(long, value_parser = number, value_name = "A,B,...", value_delimiter = ',', requires = "num", allow_hyphen_values = true)]
    den: Vec<f64>,
    /// Relay levels HIGH and LOW, command units; LOW is -HIGH if left out, as it is for a drag axis
    #[arg(long, value_parser = number, value_name = "HIGH[,LOW]", value_delimiter = ',', required = true, allow_hyphen_values = true)]
    relay: Vec<f64>,
    /// Half-width x_a of the relay's hysteresis, output units
    #[arg(long, value_parser = number, value_name = "XA", allow_negative_numbers = true)]
    half_width: f64,
    /// Reference about which the relay switches, output units (linear plants)
    #[arg(long, value_parser = number, value_name = "R", allow_negative_numbers = true, conflicts_with = "alpha")]
    reference: Option<f64>,
    /// Delay of the whole loop in s
    #[arg(long, value_parser = number, value_name = "S", default_value_t = 0.0, allow_negative_numbers = true)]
    delay: f64,
    /// Looks only at periods from SHORTEST to LONGEST, in s (linear plants)
    #[arg(long, value_parser = number, value_name = "SHORTEST,LONGEST", value_delimiter = ',', conflicts_with = "alpha")]
    periods: Vec<f64>,
    /// Writes the proof of the orbits to this file, which `selfosc verify --check FILE` checks without a search (linear plants)
    #[arg(long, value_name = "FILE", conflicts_with = "alpha")]
    certificate: Option<PathBuf>,
    /// Prints one JSON document
    #[arg(long)]
    json: bool,
}

impl Arguments {
    fn axis(&self, alpha: f64) -> Result<(AxisArguments, RelayArguments), CommandError> {
        let &[relay] = self.relay.as_slice() else {
            return Err(CommandError::Usage {
                reason: format!(
                    "--relay with {} levels: must be one for a drag axis; shift it by --delta",
                    self.relay.len()
                ),
            });
        };
        let (beta, beta_quadratic) = (self.beta.unwrap_or(0.0), self.beta_quadratic.unwrap_or(0.0));
        let motion = MotionArguments { alpha, beta, beta_quadratic };
        let delta = self.delta.unwrap_or(0.0);
        let relay = RelayArguments { relay, half_width: self.half_width };
        Ok((AxisArguments { motion, delta, delay: self.delay }, relay))
    }

    fn linear(&self) -> Result<orbits::Loop<'_>, CommandError> {
        let given = |values: &[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let usage = |flag: &str, values: &[f64], remedy: &str| CommandError::Usage {
            reason: format!("{flag} {}: must be {remedy}; give that many numbers", given(values)),
        };
        let (high, low) = match *self.relay.as_slice() {
            [high] => (high, -high),
            [high, low] => (high, low),
            _ => return Err(usage("--relay", &self.relay, "HIGH or HIGH,LOW")),
        };
        let periods = match *self.periods.as_slice() {
            [] => None,
            [shortest, longest] => Some(shortest..=longest),
            _ => return Err(usage("--periods", &self.periods, "SHORTEST,LONGEST")),
        };
        let (half_width, reference) = (self.half_width, self.reference.unwrap_or(0.0));
        Ok(orbits::Loop {
            num: &self.num,
            den: &self.den,
            delay_s: self.delay,
            high,
            low,
            half_width,
            reference,
            periods,
            certificate: self.certificate.as_deref(),
        })
    }
}

/// A cycle in numbers, or in their bounds.
fn cycle<T: Serialize>(cycle: &LimitCycle<T>) -> serde_json::Value {
    json!({
        "amplitude": cycle.amplitude,
        "bias": cycle.bias,
        "maximum": cycle.maximum,
        "minimum": cycle.minimum,
        "period_s": cycle.period_s,
        "time_positive_s": cycle.time_positive_s,
        "time_negative_s": cycle.time_negative_s,
        "switch_level": cycle.upper_switch.position,
        "multiplier": cycle.multiplier,
    })
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let Some(alpha) = arguments.alpha else { return orbits::run(arguments.linear()?, arguments.json, output) };
    let (axis, relay) = arguments.axis(alpha)?;
    let (axis, relay) = (axis.axis()?, relay.relay()?);
    let exact = match limit_cycle(&axis, &relay) {
        Ok(cycle) => cycle,
        Err(reason) if arguments.json => {
            let no_cycle = json!({ "code": reason.code(), "text": in_context(&reason.into()) });
            write_json(output, &json!({ "no_limit_cycle": no_cycle }))?;
            return Ok(Outcome::No);
        }
        Err(reason) => {
            writeln!(output, "{}", in_context(&reason.into()))?;
            return Ok(Outcome::No);
        }
    };
    // The approximation may miss an oscillation that exists.
    let balance = AxisOscillation::predict(&axis, &relay).ok();
    if arguments.json {
        let balance = balance
            .map(|found| json!({ "amplitude": found.amplitude, "bias": found.bias, "period_s": found.period_s() }));
        // Without a proof the exact cycle stands as computed.
        let proof = certify(&axis, &relay);
        let refused = proof.as_ref().err().map(|why| json!({ "code": why.code(), "text": why.to_string() }));
        let certificate = proof.as_ref().ok().map(|proof| {
            json!({
                "unique": proof.unique,
                "attracting": proof.attracting,
                "starts": proof.starts,
                "enclosure": cycle(&proof.enclosure),
            })
        });
        let document = json!({
            "harmonic_balance": balance,
            "exact": cycle(&exact),
            "certificate": certificate,
            "certificate_refused": refused,
        });
        write_json(output, &document)?;
        return Ok(Outcome::Done);
    }
    table(&exact, balance.as_ref(), output)?;
    match certify(&axis, &relay) {
        Ok(proof) => proved(&proof, output)?,
        Err(reason) => writeln!(output, "\nnot proved: {reason}")?,
    }
    Ok(Outcome::Done)
}

/// The cycle, compared with the first harmonic's approximation.
fn table(
    exact: &LimitCycle<f64>,
    balance: Option<&AxisOscillation>,
    output: &mut impl Write,
) -> Result<(), CommandError> {
    let first = |part: fn(&AxisOscillation) -> f64| {
        balance.map_or_else(|| "none".to_owned(), |found| significant(part(found), 6))
    };
    writeln!(output, "{:22}{:12}{:>14}{:>18}", "", "unit", "exact", "first harmonic")?;
    let rows = [
        ("amplitude", "output", exact.amplitude, Some(first(|found| found.amplitude))),
        ("bias", "output", exact.bias, Some(first(|found| found.bias))),
        ("period", "s", exact.period_s, Some(first(AxisOscillation::period_s))),
        ("maximum", "output", exact.maximum, None),
        ("minimum", "output", exact.minimum, None),
        ("time at +C", "s", exact.time_positive_s, None),
        ("time at -C", "s", exact.time_negative_s, None),
        ("output at switching", "output", exact.upper_switch.position, None),
        ("multiplier per cycle", "1", exact.multiplier, None),
    ];
    for (name, unit, value, first) in rows {
        let line = format!("{name:22}{unit:12}{:>14}{:>18}", significant(value, 6), first.unwrap_or_default());
        writeln!(output, "{}", line.trim_end())?;
    }
    Ok(())
}

/// The certificate in words.
fn proved(proof: &Certificate, output: &mut impl Write) -> Result<(), CommandError> {
    let cycle = &proof.enclosure;
    writeln!(output, "\nproved in interval arithmetic, for exactly these parameters:")?;
    writeln!(output, "  amplitude in {}, period in {} s", cycle.amplitude, cycle.period_s)?;
    let yes = |flag: bool| if flag { "yes" } else { "not shown" };
    writeln!(output, "  the only oscillation: {}; attracting: {}", yes(proof.unique), yes(proof.attracting))?;
    if proof.starts == Starts::OneCommandOnItsWay {
        writeln!(output, "  (among motions with at most one command on its way in the delay)")?;
    }
    Ok(())
}
