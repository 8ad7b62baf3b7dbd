//! The inverse of `selfosc df`: amplitudes that have a gain, and characteristics that have measured gains.

use std::io::Write;
use std::path::Path;

use serde_json::json;

use super::error::Given;
use super::{CommandError, Outcome, files, write_json};
use crate::describing::{Boxed, Entry, FittedCharacteristic, Setting, amplitudes, fit};
use crate::files::{LONGEST_WORD, cut};
use crate::numeric::domain::Plain;
use crate::numeric::significant;

/// Amplitudes that are searched.
pub(super) const RANGE: (f64, f64) = (1e-3, 1e3);
/// Best fits that are shown.
const SHOWN: usize = 5;

/// Every amplitude at which P has the value `gain`; no where there is none.
pub(super) fn solve(
    (entry, values): (&Entry, &[f64]),
    characteristic: &Boxed<f64>,
    (bias, gain): (f64, f64),
    json: bool,
    output: &mut impl Write,
) -> Result<Outcome, CommandError> {
    let found = amplitudes(&**characteristic, bias, gain, RANGE.0..=RANGE.1)?;
    if json {
        let solution = |one: &crate::describing::Solution| json!({ "amplitude": one.amplitude, "f0": one.df.f0, "p": one.df.p, "q": one.df.q });
        write_json(
            output,
            &json!({
                "nonlinearity": entry.name, "params": parameters(entry, values), "bias": bias, "gain": gain,
                "amplitudes": found.iter().map(solution).collect::<Vec<_>>(),
            }),
        )?;
    } else if found.is_empty() {
        writeln!(
            output,
            "no amplitude from {} to {} has P = {}; give another gain (--gain)",
            RANGE.0,
            RANGE.1,
            Plain(gain)
        )?;
    } else {
        writeln!(output, "{:>12}  {:>12}  {:>12}  {:>12}", "amplitude", "F_0", "P", "Q")?;
        for one in &found {
            let [amplitude, f0, p, q] =
                [one.amplitude, one.df.f0, one.df.p, one.df.q].map(|value| significant(value, 6));
            writeln!(output, "{amplitude:>12}  {f0:>12}  {p:>12}  {q:>12}")?;
        }
    }
    Ok(if found.is_empty() { Outcome::No } else { Outcome::Done })
}

/// Which characteristics have the gains of a file with columns amplitude and p, the best first.
pub(super) fn recognise(path: &Path, bias: f64, json: bool, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let points = points(path)?;
    let found = fit(&points, bias)?;
    if json {
        let one = |fit: &FittedCharacteristic| json!({ "nonlinearity": fit.entry.name, "params": parameters(fit.entry, &fit.values), "residual": fit.residual });
        write_json(output, &json!({ "fits": found.iter().map(one).collect::<Vec<_>>() }))?;
        return Ok(Outcome::Done);
    }
    writeln!(output, "{:28}  {:>12}  parameters", "characteristic", "residual")?;
    for fit in found.iter().take(SHOWN) {
        let settings = fit.entry.settings(&fit.values).into_iter();
        let settings: Vec<String> = settings.map(|(name, value)| format!("{name}={value}")).collect();
        writeln!(output, "{:28}  {:>12}  {}", fit.entry.name, significant(fit.residual, 3), settings.join(" "))?;
    }
    writeln!(output, "residual: standard deviation in output units per input unit; several may fit equally well")?;
    Ok(Outcome::Done)
}

fn points(path: &Path) -> Result<Vec<(f64, f64)>, CommandError> {
    let unusable = |reason: String| CommandError::Model { flag: "--fit", path: path.to_owned(), reason };
    let malformed =
        |what: &dyn core::fmt::Display| unusable(format!("{what}; give a CSV file with the columns amplitude and p"));
    let text = files::text(path).given("--fit")?;
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let headers = reader.headers().map_err(|error| malformed(&error))?.clone();
    let column = |name: &str| {
        headers.iter().position(|header| header == name).ok_or_else(|| malformed(&format!("no column {name}")))
    };
    let (amplitude, p) = (column("amplitude")?, column("p")?);
    let mut points = Vec::new();
    for (line, row) in (2..).zip(reader.records()) {
        let row = row.map_err(|error| malformed(&error))?;
        let number = |column: usize| {
            let text = row.get(column).unwrap_or_default().trim();
            let shown = cut(text, LONGEST_WORD);
            text.parse::<f64>().map_err(|_| unusable(format!("line {line}: {shown:?} is no number; correct the cell")))
        };
        points.push((number(amplitude)?, number(p)?));
    }
    Ok(points)
}

/// Values by the names of the parameters: a number as a number, points as pairs.
pub(super) fn parameters(entry: &Entry, values: &[f64]) -> serde_json::Map<String, serde_json::Value> {
    let plain = |setting| match setting {
        Setting::Number(number) => json!(number),
        Setting::Points(points) => json!(points),
    };
    entry.settings(values).into_iter().map(|(name, value)| (name.to_owned(), plain(value))).collect()
}
