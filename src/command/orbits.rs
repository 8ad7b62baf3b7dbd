//! All orbits of a linear plant under a two-level relay, as text and as JSON.

use core::ops::RangeInclusive;
use std::io::Write;
use std::path::Path;

use nalgebra::Complex;
use serde_json::{Value, json};

use super::error::Given;
use super::{CommandError, Outcome, files, write_json};
use crate::numeric::{Interval, significant};
use crate::orbit::{ListedOrbit, OrbitCertificate, OrbitListing, TwoLevelRelay};
use crate::plant::TransferFunction;

/// The loop as given.
pub(super) struct Loop<'a> {
    pub(super) num: &'a [f64],
    pub(super) den: &'a [f64],
    pub(super) delay_s: f64,
    pub(super) high: f64,
    pub(super) low: f64,
    pub(super) half_width: f64,
    pub(super) reference: f64,
    pub(super) periods: Option<RangeInclusive<f64>>,
    /// Where the proof goes.
    pub(super) certificate: Option<&'a Path>,
}

/// Ranges that are not decided, as many as the text shows.
const SHOWN: usize = 5;

fn bounds(interval: Interval) -> [f64; 2] {
    [interval.lower(), interval.upper()]
}

/// A multiplier: a number, or real and imaginary part.
fn multiplier(value: &Complex<f64>) -> Value {
    if value.im == 0.0 { json!(value.re) } else { json!([value.re, value.im]) }
}

/// An orbit as every document of the command has it.
pub(super) fn orbit(orbit: &ListedOrbit) -> Value {
    json!({
        "period_s": orbit.period_s.midpoint(),
        "time_high_s": orbit.time_high_s.midpoint(),
        "time_low_s": orbit.time_low_s.midpoint(),
        "amplitude": orbit.amplitude().midpoint(),
        "bias": orbit.bias().midpoint(),
        "maximum": orbit.maximum.midpoint(),
        "minimum": orbit.minimum.midpoint(),
        "multipliers": orbit.multipliers.iter().map(multiplier).collect::<Vec<_>>(),
        "attracting": orbit.attracting,
        "shown": "proved",
        "enclosure": {
            "period_s": bounds(orbit.period_s),
            "time_high_s": bounds(orbit.time_high_s),
            "time_low_s": bounds(orbit.time_low_s),
            "amplitude": bounds(orbit.amplitude()),
            "bias": bounds(orbit.bias()),
        },
    })
}

pub(super) fn run(given: Loop<'_>, as_json: bool, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let plant = TransferFunction::new(given.num, given.den)?.with_delay(given.delay_s)?;
    let relay = TwoLevelRelay::new(given.high, given.low, given.half_width)?;
    let relay = relay.with_reference(given.reference)?;
    let listing = crate::orbit::orbits(&plant, &relay, given.periods.clone())?;
    if let Some(path) = given.certificate {
        let proof = OrbitCertificate::new(&plant, &relay, &listing);
        files::write(path, &proof.to_string()).given("--certificate")?;
    }
    if as_json {
        let document = json!({
            "orbits": listing.orbits.iter().map(orbit).collect::<Vec<_>>(),
            "complete": listing.is_complete(),
            "range_s": listing.range_s,
            "not_covered": listing.not_covered,
        });
        write_json(output, &document)?;
    } else {
        table(&listing, output)?;
        if listing.orbits.is_empty() && listing.is_complete() {
            writeln!(output, "{}", remedy(&given, &plant))?;
        }
    }
    Ok(if listing.orbits.is_empty() { Outcome::No } else { Outcome::Done })
}

/// What to change where nothing oscillates: a stable plant comes to rest between the relay's thresholds, or beside one of them.
fn remedy(given: &Loop<'_>, plant: &TransferFunction) -> String {
    let stable = plant.poles().is_ok_and(|poles| poles.iter().all(|pole| pole.re < 0.0));
    if plant.is_integrating() && given.low * given.high >= 0.0 {
        return "the output of an integrating plant drifts: give levels of both signs (--relay HIGH,LOW)".to_owned();
    }
    if plant.static_gain().is_some_and(|gain| gain < 0.0) {
        return "the plant's gain at rest is negative, and the relay drives the output away: change the sign of --num"
            .to_owned();
    }
    let Some(gain) = plant.static_gain().filter(|gain| stable && *gain > 0.0) else {
        return "raise the levels (--relay) or narrow the hysteresis (--half-width)".to_owned();
    };
    let (low, high) = (gain * given.low, gain * given.high);
    let thresholds = [given.reference - given.half_width, given.reference + given.half_width];
    if low < thresholds[0] && thresholds[1] < high {
        return "search other periods (--periods) or narrow the hysteresis (--half-width)".to_owned();
    }
    let [low, high, from, to] = [low, high, thresholds[0], thresholds[1]].map(|value| significant(value, 6));
    format!(
        "the levels hold the output at {low} and at {high}, and it must pass {from} and {to}: move --reference between them, widen the levels \
         (--relay) or narrow the hysteresis (--half-width)"
    )
}

fn table(listing: &OrbitListing, output: &mut impl Write) -> Result<(), CommandError> {
    if listing.orbits.is_empty() && !listing.is_complete() {
        writeln!(output, "no oscillation is proved, and some periods are not decided")?;
    } else if listing.orbits.is_empty() {
        writeln!(output, "no oscillation with one switching each way in the periods searched")?;
    } else {
        let head = ["period / s", "at HIGH / s", "at LOW / s", "amplitude", "bias", "multiplier"];
        writeln!(output, "{}  attracting", head.map(|name| format!("{name:>12}")).join("  "))?;
    }
    for one in &listing.orbits {
        let largest = match (one.multipliers.first(), one.attracting) {
            (Some(value), _) => significant(value.norm(), 6),
            // All are zero.
            (None, Some(_)) => "0".to_owned(),
            (None, None) => "not known".to_owned(),
        };
        let middles = [one.period_s, one.time_high_s, one.time_low_s, one.amplitude(), one.bias()];
        let bias_is_none = one.bias().contains_zero();
        let cell = |(at, value): (usize, &Interval)| {
            let value = if at == 4 && bias_is_none { 0.0 } else { value.midpoint() };
            format!("{:>12}", significant(value, 7))
        };
        let cells: Vec<String> = middles.iter().enumerate().map(cell).collect();
        let attracting = match one.attracting {
            Some(true) => "yes",
            Some(false) => "no",
            None => "not decided",
        };
        writeln!(output, "{}  {largest:>12}  {attracting}", cells.join("  "))?;
    }
    if !listing.orbits.is_empty() {
        let widest =
            listing.orbits.iter().map(|one| one.period_s.width() / one.period_s.midpoint()).fold(0.0, f64::max);
        writeln!(output, "\neach proved to exist, its period within {} of itself", significant(widest, 2))?;
    }
    let periods = |range: &[Option<f64>; 2]| match range {
        [None, None] => "all periods".to_owned(),
        [Some(lower), None] => format!("periods above {} s", significant(*lower, 6)),
        [lower, Some(upper)] => {
            let lower = lower.map_or_else(|| "0".to_owned(), |lower| significant(lower, 6));
            format!("periods from {lower} to {} s", significant(*upper, 6))
        }
    };
    writeln!(output, "searched: {}, one switching each way in a period", periods(&listing.range_s))?;
    if listing.is_complete() && !listing.orbits.is_empty() {
        writeln!(output, "no other orbit there")?;
    }
    for range in listing.not_covered.iter().take(SHOWN) {
        writeln!(output, "not decided: {}", periods(range))?;
    }
    if let Some(more @ 1..) = listing.not_covered.len().checked_sub(SHOWN) {
        writeln!(output, "not decided: {more} ranges more; --json has all")?;
    }
    Ok(())
}
