//! `selfosc balance`: harmonic balance of a transfer function with a characteristic.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::error::Given;
use super::number::number;
use super::{CommandError, Outcome, existence, files, orbits, write_json};
use crate::balance::{Bias, HarmonicBalance, Intersection};
use crate::describing::{Entry, Setting};
use crate::numeric::significant;
use crate::orbit::{ListedOrbit, TwoLevelRelay};
use crate::plant::TransferFunction;
use crate::report::nyquist;

/// The oscillations that harmonic balance predicts for a plant in a loop with a characteristic.
///
/// Every intersection of the plant's Nyquist curve with -1/N. An approximation: it leaves out all harmonics but the first. Stable means
/// that the amplitude returns (Loeb's criterion) and that the loop with the gain N has no other root in the right half plane
/// (generalised Nyquist count). Of a relay the exact orbit stands beside it, and its multipliers decide. Where the characteristic is odd
/// with a bounded slope, oscillations are proved to exist in boxes of amplitude and frequency: near the intersections and where a scan
/// with more harmonics finds one. Exit status 1 where no oscillation is predicted or proved.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  selfosc balance --num 8 --den 1,2,2,1 --nonlinearity saturation --set breakpoint=1 --svg nyquist.svg
  selfosc balance --num 1 --den 1,1,0 --delay 0.1 --nonlinearity relay-hysteresis --set half_width=0.2 --json
  selfosc balance --num 3 --den 1,2,1,0 --nonlinearity saturation --set breakpoint=1 --certificates proofs")]
pub(super) struct Arguments {
    /// Numerator, descending powers of s
    #[arg(long, value_parser = number, value_name = "A,B,...", value_delimiter = ',', required = true, allow_hyphen_values = true)]
    num: Vec<f64>,
    /// Denominator, descending powers of s
    #[arg(long, value_parser = number, value_name = "A,B,...", value_delimiter = ',', required = true, allow_hyphen_values = true)]
    den: Vec<f64>,
    /// Delay of the plant in s
    #[arg(long, value_parser = number, value_name = "S", default_value_t = 0.0, allow_negative_numbers = true)]
    delay: f64,
    /// Name of the characteristic, as `selfosc df --list` shows it
    #[arg(long, value_name = "NAME")]
    nonlinearity: String,
    /// A parameter of the characteristic, as key=value; repeat for each
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = super::df::setting)]
    settings: Vec<(String, Setting)>,
    /// Bias of the characteristic's input
    #[arg(long, value_parser = number, value_name = "B", default_value_t = 0.0, allow_negative_numbers = true)]
    bias: f64,
    /// Draws G(jw) and -1/N into this SVG file
    #[arg(long, visible_alias = "plot", value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Writes the proof of each oscillation to this folder, for `selfosc verify --check FILE`
    #[arg(long, value_name = "DIR")]
    certificates: Option<PathBuf>,
    /// Prints one JSON document
    #[arg(long)]
    json: bool,
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let plant = TransferFunction::new(&arguments.num, &arguments.den)?.with_delay(arguments.delay)?;
    let entry = Entry::find(&arguments.nonlinearity).given("--nonlinearity")?;
    let values = entry.values(&arguments.settings)?;
    let characteristic = entry.build(&values)?;
    let balance = HarmonicBalance::new(&plant, |sweep| characteristic.describing_function(sweep))?
        .with_bias(Bias::Fixed(arguments.bias))?;
    let mut found = balance.intersections()?;
    let exact = exact(arguments, entry, &plant, &found)?;
    let by_loeb: Vec<Option<bool>> = found.iter().map(|one| one.stable).collect();
    for (one, orbit) in found.iter_mut().zip(&exact) {
        one.stable = orbit.as_ref().and_then(|orbit| orbit.attracting).or(one.stable);
    }
    let found = found;
    if let Some(path) = &arguments.svg {
        let describing = |sweep: &_| characteristic.describing_function(sweep);
        let figure = nyquist(&plant, balance.omega_rad_s(), describing, arguments.bias, &found)?;
        files::write(path, &figure.svg()?).given("--svg")?;
    }
    // A proof is about oscillations without bias.
    let searched = (arguments.bias == 0.0)
        .then(|| existence::search(&plant, (entry.name, &values), &balance.omega_rad_s(), &found))
        .flatten();
    if let Some(folder) = &arguments.certificates {
        existence::write(folder, searched.as_ref())?;
    }
    let proved = searched.as_ref().is_some_and(|searched| !searched.proved.is_empty());
    let outcome = if found.is_empty() && !proved { Outcome::No } else { Outcome::Done };
    if arguments.json {
        let intersection = |(place, (found, exact)): (usize, (&Intersection, &Option<ListedOrbit>))| {
            json!({
                "amplitude": found.amplitude,
                "omega_rad_s": found.omega_rad_s,
                "stable": found.stable,
                "stability_by": by(exact.as_ref()),
                "unstable_roots": found.unstable_roots,
                "exact": exact.as_ref().map(orbits::orbit),
                "existence": searched.as_ref().map(|searched| existence::at(searched, place)),
            })
        };
        let document = json!({
            "intersections": found.iter().zip(&exact).enumerate().map(intersection).collect::<Vec<_>>(),
            "proved": searched.as_ref().map(existence::all),
        });
        write_json(output, &document)?;
        return Ok(outcome);
    }
    if found.is_empty() {
        let (from, to) = balance.omega_rad_s().into_inner();
        writeln!(
            output,
            "no oscillation: -1/N of amplitudes from {:e} to {:e} does not meet the plant's curve between {from:.3e} and {to:.3e} rad/s; \
             try another gain (--num), or units in which amplitudes are near 1",
            balance.amplitude.start(),
            balance.amplitude.end()
        )?;
    } else {
        print(&found, &exact, &by_loeb, output)?;
    }
    if let Some(searched) = &searched {
        existence::print(searched, &found, output)?;
    }
    Ok(outcome)
}

/// A line an intersection, and below it the exact orbit; `by_loeb` is the first harmonic's own verdict.
fn print(
    found: &[Intersection],
    exact: &[Option<ListedOrbit>],
    by_loeb: &[Option<bool>],
    output: &mut impl Write,
) -> Result<(), CommandError> {
    writeln!(output, "{:>14}  {:>14}  {:>12}  stable", "amplitude", "omega / rad/s", "period / s")?;
    for ((one, orbit), loeb) in found.iter().zip(exact).zip(by_loeb) {
        let stable = one.stable.map_or("not decided", |stable| if stable { "yes" } else { "no" });
        let period_s = core::f64::consts::TAU / one.omega_rad_s;
        writeln!(
            output,
            "{:>14}  {:>14}  {:>12}  {stable}, by {}",
            significant(one.amplitude, 7),
            significant(one.omega_rad_s, 7),
            significant(period_s, 7),
            by(orbit.as_ref())
        )?;
        let Some(orbit) = orbit else { continue };
        writeln!(
            output,
            "{:>14}  {:>14}  {:>12}  (the exact orbit{})",
            significant(orbit.amplitude().midpoint(), 7),
            "",
            significant(orbit.period_s.midpoint(), 7),
            if loeb.is_some() && orbit.attracting.is_some() && *loeb != orbit.attracting {
                "; the first harmonic's own verdict contradicts it"
            } else {
                ""
            }
        )?;
    }
    Ok(())
}

/// What decides the stability of an intersection.
fn by(exact: Option<&ListedOrbit>) -> &'static str {
    if exact.is_some_and(|orbit| orbit.attracting.is_some()) { "multipliers" } else { "loeb" }
}

/// How far the period of an exact orbit may be from that of its first harmonic, as a logarithm: half an octave.
const NEAR: f64 = 0.35;

/// The exact orbit near each intersection, where the characteristic is a relay: each orbit once, beside the nearest period.
fn exact(
    arguments: &Arguments,
    entry: &Entry,
    plant: &TransferFunction,
    found: &[Intersection],
) -> Result<Vec<Option<ListedOrbit>>, CommandError> {
    let mut beside = vec![None; found.len()];
    let (level, half_width, offset) = match (entry.name, entry.values(&arguments.settings)?.as_slice()) {
        ("relay", &[level]) => (level, 0.0, 0.0),
        ("relay-hysteresis", &[level, half_width, offset]) => (level, half_width, offset),
        _ => return Ok(beside),
    };
    if arguments.bias != 0.0 || found.is_empty() {
        return Ok(beside);
    }
    let relay = TwoLevelRelay::new(offset + level, offset - level, half_width)?;
    let Ok(listing) = crate::orbit::orbits(plant, &relay, None) else { return Ok(beside) };
    for orbit in listing.orbits {
        let away =
            |one: &Intersection| libm::log(one.omega_rad_s * orbit.period_s.midpoint() / core::f64::consts::TAU).abs();
        let nearest = (0..found.len()).min_by(|&a, &b| away(&found[a]).total_cmp(&away(&found[b])));
        if let Some(place) = nearest.filter(|&place| away(&found[place]) < NEAR && beside[place].is_none()) {
            beside[place] = Some(orbit);
        }
    }
    Ok(beside)
}
