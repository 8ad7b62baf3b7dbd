//! `selfosc predict`: the self-oscillation of a drag axis.

use std::io::Write;

use clap::Args;
use serde::Serialize;
use serde_json::json;

use super::axis::{AxisArguments, RelayArguments};
use super::error::in_context;
use super::{CommandError, Outcome, write_json};
use crate::balance::AxisOscillation;
use crate::numeric::significant;
use crate::orbit::{Certificate, LimitCycle, Starts, certify, limit_cycle};

/// The self-oscillation of alpha x'' + (beta + beta_quadratic |x'|) x' = u(t - delay) + delta under a relay with hysteresis.
///
/// The exact limit cycle comes from the closed-form motion between switchings; harmonic balance, which keeps the first harmonic
/// only, is the paper's approximation. A certificate in interval arithmetic follows. Output is whatever unit half-width has
/// (rad, m), command whatever relay has (N m, N).
/// Exit status 1 where there is no limit cycle, with the reason.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  selfosc predict --alpha 0.033 --beta-quadratic 0.007 --relay 0.08 --half-width 0.21 --delay 0.2
  selfosc predict --alpha 1 --beta 1 --relay 1 --half-width 0.2 --delta 0.3 --json")]
pub(super) struct Arguments {
    #[command(flatten)]
    axis: AxisArguments,
    #[command(flatten)]
    relay: RelayArguments,
    /// Prints one JSON document
    #[arg(long)]
    json: bool,
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
    let (axis, relay) = (arguments.axis.axis()?, arguments.relay.relay()?);
    let exact = match limit_cycle(&axis, &relay) {
        Ok(cycle) => cycle,
        Err(reason) if arguments.json => {
            let no_cycle = json!({ "code": reason.code(), "text": reason.to_string() });
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
