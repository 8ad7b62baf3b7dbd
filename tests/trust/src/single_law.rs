//! The baseline: maximum likelihood under linear, quadratic and mixed drag, the likeliest law taken.
//!
//! It has no terms and no verdict of its own. An answer counts as doubtful where a warning says that the record contradicts the
//! model (a lag, coloured residuals); warnings of a wide interval or of confounded parameters do not.

use std::borrow::Cow;

use selfosc::experiment::Record;
use selfosc::identify::fit::{Fit, RecordFit};
use selfosc::identify::joint::{Delay, Estimate, Parameter};
use selfosc::identify::select::likelihood::Choice;
use selfosc::identify::{DragLaw, Warning};
use selfosc_simulator::answer::{Answer, Interval, Trust};
use selfosc_simulator::kinds::Case;

/// The record as a user reads it: wrapped headings made continuous.
fn record(log: &selfosc_simulator::experiment::Record, turn: Option<f64>) -> Result<Record, String> {
    let mut output = log.output.clone();
    if let Some(turn) = turn {
        for index in 1..output.len() {
            let jump = output[index] - output[index - 1];
            output[index] -= turn * (jump / turn).round();
        }
    }
    Record::new(log.time_s.clone(), output, log.input.clone()).map_err(|error| error.code().to_owned())
}

/// An estimate that ended on its bound has no interval: it is taken at its word.
fn interval(estimate: Estimate) -> Interval {
    let Estimate { value, spread } = estimate;
    spread.map_or(Interval::exact(value), |spread| Interval { value, low: spread.low, high: spread.high })
}

/// The answer to a case.
pub(crate) fn identify(case: &Case) -> Answer {
    let records: Result<Vec<Record>, String> =
        case.runs.iter().map(|run| record(&run.record, case.known.turn)).collect();
    let records = match records {
        Ok(records) => records,
        Err(code) => return Answer::refused(code),
    };
    let records: Vec<&Record> = records.iter().collect();
    let delay = case.known.delay_s.map_or(Delay::Estimated, Delay::KnownS);
    match Choice::among_all(&records, delay) {
        Ok(choice) => answer(choice.likeliest(), &records, delay),
        Err(error) => Answer::refused(error.code()),
    }
}

fn answer(fit: &RecordFit, records: &[&Record], delay: Delay) -> Answer {
    let free = match delay {
        Delay::KnownS(_) => Fit::new(fit.law(), Delay::Estimated).records_from(records, &[fit]).ok(),
        Delay::Estimated => None,
    };
    let warnings = Warning::of_fit(fit, free.as_ref());
    let contradicts =
        |warning: &Warning| matches!(warning, Warning::ActuatorLag { .. } | Warning::ColouredResiduals { .. });
    let drag =
        |present: bool, parameter| if present { interval(fit.estimate(parameter)) } else { Interval::exact(0.0) };
    let alpha = fit.estimate(Parameter::Alpha);
    let law: DragLaw = fit.law();
    Answer {
        trust: if warnings.iter().any(contradicts) { Trust::Doubtful } else { Trust::Good },
        reasons: warnings.iter().map(|warning| Cow::Borrowed(warning.code())).collect(),
        alpha: alpha.spread.map(|_| interval(alpha)),
        beta: Some(drag(law.has_linear(), Parameter::LinearDrag)),
        beta_quadratic: Some(drag(law.has_quadratic(), Parameter::QuadraticDrag)),
        beta_cubic: None,
        stiffness: None,
        lag_s: None,
        delay_s: (delay == Delay::Estimated).then(|| interval(fit.estimate(Parameter::DelayS))),
        delta: fit.records().iter().map(|record| Some(interval(record.disturbance))).collect(),
    }
}
