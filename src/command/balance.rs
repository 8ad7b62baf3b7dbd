//! `selfosc balance`: harmonic balance of a transfer function with a characteristic.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::error::Given;
use super::number::number;
use super::{CommandError, Outcome, existence, files, write_json};
use crate::balance::{Bias, HarmonicBalance, Intersection};
use crate::describing::{Entry, Setting};
use crate::numeric::significant;
use crate::plant::TransferFunction;
use crate::report::nyquist;

/// The oscillations that harmonic balance predicts for a plant in a loop with a characteristic.
///
/// Every intersection of the plant's Nyquist curve with -1/N, with Loeb's verdict on its stability. An approximation: it leaves
/// out all harmonics but the first. Where the characteristic is odd with a bounded slope, oscillations are proved to exist in boxes of
/// amplitude and frequency: near the intersections and where a scan with more harmonics finds one. Exit status 1 where no oscillation
/// is predicted or proved.
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
    #[arg(long, value_name = "FILE")]
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
    let found = balance.intersections()?;
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
        let intersection = |(place, found): (usize, &Intersection)| {
            json!({
                "amplitude": found.amplitude,
                "omega_rad_s": found.omega_rad_s,
                "stable": found.stable,
                "existence": searched.as_ref().map(|searched| existence::at(searched, place)),
            })
        };
        let document = json!({
            "intersections": found.iter().enumerate().map(intersection).collect::<Vec<_>>(),
            "proved": searched.as_ref().map(existence::all),
        });
        write_json(output, &document)?;
        return Ok(outcome);
    }
    if found.is_empty() {
        let (from, to) = balance.omega_rad_s().into_inner();
        writeln!(output, "no oscillation: -1/N does not meet the plant's curve between {from:.3e} and {to:.3e} rad/s")?;
    } else {
        print(&found, output)?;
    }
    if let Some(searched) = &searched {
        existence::print(searched, &found, output)?;
    }
    Ok(outcome)
}

fn print(found: &[Intersection], output: &mut impl Write) -> Result<(), CommandError> {
    writeln!(output, "{:>14}  {:>14}  {:>12}  stable", "amplitude", "omega / rad/s", "period / s")?;
    for one in found {
        let stable = one.stable.map_or("not decided", |stable| if stable { "yes" } else { "no" });
        let period_s = core::f64::consts::TAU / one.omega_rad_s;
        writeln!(
            output,
            "{:>14}  {:>14}  {:>12}  {stable}",
            significant(one.amplitude, 7),
            significant(one.omega_rad_s, 7),
            significant(period_s, 7)
        )?;
    }
    Ok(())
}
