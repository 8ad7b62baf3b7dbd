//! Asks the command `selfosc` about loops, one process each.

use std::path::Path;
use std::process::Command;
use std::time::Instant;

use serde_json::Value;

use crate::describing;
use crate::describing::loops::DescribingLoop;
use crate::relay::answer::Line;
use crate::relay::control_loop::RelayLoop;

/// Numbers separated by commas, as they read back exactly.
#[must_use]
pub fn list(values: &[f64]) -> String {
    values.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
}

/// Output of a command: the document on standard output, else what was said on standard error; and its wall time in s.
///
/// # Errors
/// A command that cannot be started.
pub fn answer(program: &Path, arguments: &[String]) -> std::io::Result<(Result<Value, String>, f64)> {
    let begin = Instant::now();
    let output = Command::new(program).args(arguments).output()?;
    let seconds = begin.elapsed().as_secs_f64();
    let document = serde_json::from_slice(&output.stdout);
    let said = || String::from_utf8_lossy(&output.stderr).trim().to_owned();
    Ok((document.map_err(|_| said()), seconds))
}

/// Arguments of `selfosc predict` for a loop.
#[must_use]
pub fn predict_arguments(control_loop: &RelayLoop) -> Vec<String> {
    let RelayLoop { plant, high, low, half_width, reference } = control_loop;
    vec![
        "predict".to_owned(),
        format!("--num={}", list(&plant.num)),
        format!("--den={}", list(&plant.den)),
        format!("--delay={}", plant.delay),
        format!("--relay={high},{low}"),
        format!("--half-width={half_width}"),
        format!("--reference={reference}"),
        "--json".to_owned(),
    ]
}

/// Asks about a loop.
///
/// # Errors
/// A command that cannot be started.
pub fn ask(program: &Path, seed: u64, control_loop: RelayLoop) -> std::io::Result<Line> {
    let (found, seconds) = answer(program, &predict_arguments(&control_loop))?;
    let line = Line { seed, control_loop, seconds: Some(seconds), answer: None, refused: None };
    Ok(match found {
        // A document without orbits is a refusal with its reason.
        Ok(document) if document.get("orbits").is_some() => Line { answer: Some(document), ..line },
        Ok(document) => Line { refused: Some(document.to_string()), ..line },
        Err(said) => Line { refused: Some(said), ..line },
    })
}

/// Arguments of `selfosc balance` for a loop.
#[must_use]
pub fn balance_arguments(control_loop: &DescribingLoop) -> Vec<String> {
    let DescribingLoop { plant, nonlinearity, settings, .. } = control_loop;
    let mut arguments = vec![
        "balance".to_owned(),
        format!("--num={}", list(&plant.num)),
        format!("--den={}", list(&plant.den)),
        format!("--delay={}", plant.delay),
        format!("--nonlinearity={nonlinearity}"),
    ];
    arguments.extend(settings.iter().map(|(key, value)| format!("--set={key}={value}")));
    arguments.push("--json".to_owned());
    arguments
}

/// Asks about a describing-function loop.
///
/// # Errors
/// A command that cannot be started.
pub fn ask_balance(program: &Path, control_loop: DescribingLoop) -> std::io::Result<describing::answer::Line> {
    let (found, seconds) = answer(program, &balance_arguments(&control_loop))?;
    let (answer, refused) = match found {
        Ok(document) if document.get("intersections").is_some() => (Some(document), None),
        Ok(document) => (None, Some(document.to_string())),
        Err(said) => (None, Some(said)),
    };
    Ok(describing::answer::Line { control_loop, seconds: Some(seconds), answer, refused })
}
