//! `selfosc df`: one describing function.

use std::io::Write;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde::Serialize;
use serde_json::json;

use super::error::Given;
use super::number::number;
use super::{CommandError, Outcome, files, gain, write_json};
use crate::describing::{CATALOGUE, DescribingFunction, Entry, RoundingBounds, Setting, by_quadrature, certified};
use crate::nonlinearity::{ParameterSpec, Sinusoid};
use crate::numeric::{Interval, Real, significant};
use crate::proof::rigorous_quadrature::CellJet;
use crate::report::characteristics;

/// The describing function F_0, P, Q of a characteristic at one bias and amplitude.
///
/// P + jQ is the gain for the input B + X sin(theta), F_0 the mean output; Q is negative where the output lags.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  selfosc df relay-hysteresis --set level=2 --set half_width=0.3 --amplitude 1 --bias 0.1
  selfosc df saturation --set breakpoint=0.5 --amplitude 2 --method quadrature --json
  selfosc df piecewise-linear --set points=-1:-1,0:0,1:2 --set left_slope=0 --set right_slope=0 --amplitude 2
  selfosc df relay-dead-zone --set dead_zone=0.5 --gain 1
  selfosc df --fit gains.csv
  selfosc df --list --page catalogue.html")]
pub(super) struct Arguments {
    /// Name of the characteristic, as --list shows it
    #[arg(required_unless_present_any = ["list", "fit", "page"])]
    name: Option<String>,
    /// A parameter of the characteristic, as key=value; repeat for each
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    settings: Vec<(String, Setting)>,
    /// Amplitude X of the input
    #[arg(long, value_parser = number, value_name = "X", required_unless_present_any = ["list", "fit", "gain", "page"], conflicts_with = "gain", allow_negative_numbers = true)]
    amplitude: Option<f64>,
    /// In place of the amplitude: amplitudes from 0.001 to 1000 at which P has this value; of solutions nearer to each other than 1.4 % some may be missed
    #[arg(long, value_parser = number, value_name = "P", allow_negative_numbers = true)]
    gain: Option<f64>,
    /// Which characteristics have the gains of this CSV file (columns amplitude and p), the best first
    #[arg(long, value_name = "FILE", conflicts_with_all = ["name", "amplitude", "gain", "list"])]
    fit: Option<PathBuf>,
    /// Bias B of the input
    #[arg(long, value_parser = number, value_name = "B", default_value_t = 0.0, allow_negative_numbers = true)]
    bias: f64,
    /// How it is found
    #[arg(long, value_enum, default_value_t = DescribingMethod::ClosedForm)]
    method: DescribingMethod,
    /// Lists every characteristic with its parameters, and does nothing else
    #[arg(long)]
    list: bool,
    /// With --list: writes every characteristic with its formula and its curves into this HTML file
    #[arg(long, value_name = "FILE", requires = "list")]
    page: Option<PathBuf>,
    /// Prints one JSON document
    #[arg(long)]
    json: bool,
}

/// Digits for a person; the document has all.
const DIGITS: usize = 6;

#[derive(Clone, Copy, Debug, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
enum DescribingMethod {
    /// The formula
    ClosedForm,
    /// Adaptive quadrature of the output: an error estimate, no bound
    Quadrature,
    /// Rigorous quadrature of the output: intervals that contain the exact values
    Certified,
}

pub(super) fn setting(text: &str) -> Result<(String, Setting), String> {
    let (key, value) = text.split_once('=').ok_or_else(|| "must be KEY=VALUE; write it as level=2".to_owned())?;
    let setting = value.parse().map_err(|error| format!("{key}: {error}"))?;
    Ok((key.to_owned(), setting))
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    if let Some(path) = &arguments.fit {
        return gain::recognise(path, arguments.bias, arguments.json, output);
    }
    let Some(name) = arguments.name.as_ref().filter(|_| !arguments.list) else {
        if let Some(path) = &arguments.page {
            files::write(path, &characteristics()?.html()?).given("--page")?;
        }
        return list(arguments.json, output);
    };
    let entry = Entry::find(name)?;
    let values = entry.values(&arguments.settings)?;
    let characteristic = entry.build(&values)?;
    if let Some(wanted) = arguments.gain {
        return gain::solve((entry, &values), &characteristic, (arguments.bias, wanted), arguments.json, output);
    }
    // The parser wants it without --gain.
    let amplitude = arguments.amplitude.unwrap_or(f64::NAN);
    let sweep = Sinusoid::new(arguments.bias, amplitude)?;
    let enclosed = match arguments.method {
        DescribingMethod::Certified => Some(enclose(entry, &values, arguments.bias, amplitude)?),
        DescribingMethod::ClosedForm | DescribingMethod::Quadrature => None,
    };
    let DescribingFunction { f0, p, q } = match (arguments.method, &enclosed) {
        (DescribingMethod::ClosedForm, _) => characteristic.describing_function(&sweep)?,
        (_, None) => by_quadrature(&*characteristic, &sweep)?,
        (_, Some(DescribingFunction { f0, p, q })) => {
            DescribingFunction { f0: f0.midpoint(), p: p.midpoint(), q: q.midpoint() }
        }
    };
    if arguments.json {
        let answer = json!({
            "nonlinearity": entry.name,
            "params": gain::parameters(entry, &values),
            "amplitude": amplitude,
            "bias": arguments.bias,
            "f0": f0,
            "p": p,
            "q": q,
            "method": arguments.method,
            "enclosure": enclosed,
        });
        write_json(output, &answer)?;
    } else if let Some(DescribingFunction { f0, p, q }) = enclosed {
        writeln!(output, "F_0 in {f0}\nP   in {p}\nQ   in {q}")?;
    } else {
        let [f0, p, q] = [f0, p, q].map(|part| significant(part, DIGITS));
        writeln!(output, "F_0 = {f0}\nP   = {p}\nQ   = {q}")?;
    }
    Ok(Outcome::Done)
}

fn enclose(
    entry: &Entry,
    values: &[f64],
    bias: f64,
    amplitude: f64,
) -> Result<DescribingFunction<Interval>, CommandError> {
    let values: Vec<_> = values.iter().map(|&value| CellJet::from_f64(value)).collect();
    let sweep = Sinusoid::new(CellJet::from_f64(bias), CellJet::from_f64(amplitude))?;
    Ok(certified(&*entry.build(&values)?, &sweep)?.enclosure)
}

/// Over which values of the parameters, in their order, of bias and of amplitude the closed form is how near to the exact value.
fn rounding(bounds: &RoundingBounds) -> serde_json::Value {
    json!({
        "parameters": bounds.parameters,
        "bias": bounds.bias,
        "amplitude": bounds.amplitude,
        "f64": bounds.double,
        "f32": bounds.single,
    })
}

fn list(as_json: bool, output: &mut impl Write) -> Result<Outcome, CommandError> {
    if as_json {
        let parameter = |p: &ParameterSpec| json!({ "name": p.name, "meaning": p.meaning, "domain": p.domain.words(), "default": p.default });
        let entry = |e: &Entry| {
            let parameters = e.parameters.iter().map(parameter).collect::<Vec<_>>();
            json!({ "name": e.name, "parameters": parameters, "rounding": e.rounding_bounds().as_ref().map(rounding) })
        };
        write_json(output, &CATALOGUE.iter().map(entry).collect::<Vec<_>>())?;
        return Ok(Outcome::Done);
    }
    for entry in CATALOGUE {
        writeln!(output, "{}", entry.name)?;
        for parameter in entry.parameters {
            let default = parameter.default.map_or_else(String::new, |value| format!(" [{value}]"));
            writeln!(output, "    {:18}  {}", format!("{}{default}", parameter.name), parameter.meaning)?;
        }
    }
    Ok(Outcome::Done)
}
