//! What is proved of oscillations: beside the intersections of `selfosc balance`, in files, and of a file in `selfosc verify --check`.

use std::io::Write;
use std::ops::RangeInclusive;
use std::path::Path;

use serde_json::{Value, json};

#[cfg(feature = "theory")]
use super::Outcome;
use super::error::Given;
use super::{CommandError, files};
use crate::balance::{
    CannotTell, HarmonicOrders, Intersection, LipschitzLoop, OddCharacteristic, Oscillations, ProvedOscillation,
};
use crate::numeric::Interval;
use crate::plant::TransferFunction;

/// What is shown of the loop; `None` where the plant is not strictly proper, or the characteristic not odd with a bounded slope.
pub(super) fn search(
    plant: &TransferFunction,
    (name, values): (&str, &[f64]),
    omega_rad_s: &RangeInclusive<f64>,
    intersections: &[Intersection],
) -> Option<Oscillations> {
    let characteristic = OddCharacteristic::from_catalogue(name, values).ok()?;
    Some(LipschitzLoop::new(plant, characteristic).ok()?.oscillations(omega_rad_s, intersections))
}

fn proved(one: &ProvedOscillation) -> Value {
    let ends = |bounds: Interval| json!([bounds.lower(), bounds.upper()]);
    json!({
        "shown": true,
        "amplitude": ends(one.amplitude()),
        "omega_rad_s": ends(one.omega_rad_s()),
        "highest_harmonic": one.highest_harmonic(),
        "remainder": one.remainder(),
    })
}

fn open(reason: CannotTell) -> Value {
    json!({ "shown": false, "reason": reason.code(), "detail": reason.to_string() })
}

/// Of an intersection by its place.
pub(super) fn at(found: &Oscillations, place: usize) -> Value {
    match found.at.get(place) {
        Some(Ok(one)) => found.proved.get(*one).map_or(Value::Null, proved),
        Some(Err(reason)) => open(*reason),
        None => Value::Null,
    }
}

/// All that is proved.
pub(super) fn all(found: &Oscillations) -> Value {
    found.proved.iter().map(proved).collect()
}

/// A table of all that is proved, and the places where nothing is.
pub(super) fn print(
    found: &Oscillations,
    intersections: &[Intersection],
    output: &mut impl Write,
) -> Result<(), CommandError> {
    if !found.proved.is_empty() {
        writeln!(output, "\nproved to exist: amplitude of the first harmonic, omega / rad/s")?;
    }
    for one in &found.proved {
        let [amplitude, omega] = [one.amplitude(), one.omega_rad_s()].map(|bounds| {
            let text = format!("{:?} to {:?}", bounds.lower(), bounds.upper());
            format!("{text:>42}")
        });
        writeln!(output, "{amplitude}  {omega}")?;
    }
    let at_intersections = found
        .at
        .iter()
        .zip(intersections)
        .filter_map(|(at, one)| at.as_ref().err().map(|reason| (one.amplitude, one.omega_rad_s, *reason)));
    let elsewhere = found.unproved.iter().map(|one| (one.amplitude, one.omega_rad_s, one.reason));
    for (amplitude, omega_rad_s, reason) in at_intersections.chain(elsewhere) {
        writeln!(output, "not shown near {amplitude:.6}, {omega_rad_s:.6} rad/s; {reason}")?;
    }
    Ok(())
}

/// One file `oscillation-N.json` for each that is proved.
pub(super) fn write(folder: &Path, found: Option<&Oscillations>) -> Result<(), CommandError> {
    crate::files::folder(folder).given("--certificates")?;
    for (place, one) in found.iter().flat_map(|found| &found.proved).enumerate() {
        files::write(&folder.join(format!("oscillation-{}.json", place + 1)), &one.to_string())
            .given("--certificates")?;
    }
    Ok(())
}

/// Whether a document shows its oscillation.
#[cfg(feature = "theory")]
pub(super) fn check(path: &Path, text: &str, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let document: ProvedOscillation = match text.parse() {
        Ok(document) => document,
        Err(error) => return Err(CommandError::NoCertificate { path: path.to_owned(), reason: error.to_string() }),
    };
    match document.check() {
        Ok(()) => {
            let plant = document.plant();
            let symmetry = match document.orders() {
                HarmonicOrders::Odd => "half-wave symmetric".to_owned(),
                HarmonicOrders::All => {
                    format!("with a mean from {:?} to {:?}", document.mean().lower(), document.mean().upper())
                }
            };
            writeln!(output, "accepted  an oscillation of x = -G n(x), {symmetry}")?;
            writeln!(
                output,
                "          G = {:?}/{:?} exp(-{} s), descending powers of s",
                plant.numerator(),
                plant.denominator(),
                plant.delay_s()
            )?;
            writeln!(output, "          n = {:?}", document.characteristic())?;
            for (quantity, bounds) in
                [("amplitude of the first harmonic", document.amplitude()), ("rad/s", document.omega_rad_s())]
            {
                writeln!(output, "          {:?} <= {quantity} <= {:?}", bounds.lower(), bounds.upper())?;
            }
            writeln!(
                output,
                "          harmonics above {}: root mean square at most {:.3e}",
                document.highest_harmonic(),
                document.remainder()
            )?;
            Ok(Outcome::Done)
        }
        Err(refusal) => {
            writeln!(output, "refused   {}: {refusal}", refusal.code())?;
            Ok(Outcome::No)
        }
    }
}
