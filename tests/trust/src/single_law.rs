//! The baseline: maximum likelihood under linear, quadratic and mixed drag, the likeliest law taken.
//!
//! It has no terms and no verdict of its own. An answer counts as doubtful where the record contradicts the model: it fits a longer
//! delay than the one given, or leaves coloured residuals.

use std::borrow::Cow;

use selfosc::experiment::Record;
use selfosc::identify::answer::AxisParameter;
use selfosc::identify::fit::select::likelihood::Choice;
use selfosc::identify::fit::{Fit, RecordFit};
use selfosc::identify::{Delay, DragLaw};
use selfosc_simulator::answer::{Answer, Interval, Trust};
use selfosc_simulator::kinds::Case;

use crate::reading::{interval, record};

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
    let contradictions = contradictions(fit, free.as_ref());
    let drag =
        |present: bool, parameter| if present { interval(fit.estimate(parameter)) } else { Interval::exact(0.0) };
    let alpha = fit.estimate(AxisParameter::Alpha);
    let law: DragLaw = fit.law();
    Answer {
        trust: if contradictions.is_empty() { Trust::Good } else { Trust::Doubtful },
        reasons: contradictions.into_iter().map(Cow::Borrowed).collect(),
        alpha: alpha.spread.map(|_| interval(alpha)),
        beta: Some(drag(law.has_linear(), AxisParameter::LinearDrag)),
        beta_quadratic: Some(drag(law.has_quadratic(), AxisParameter::QuadraticDrag)),
        beta_cubic: None,
        stiffness: None,
        lag_s: None,
        delay_s: (delay == Delay::Estimated).then(|| interval(fit.estimate(AxisParameter::DelayS))),
        delta: fit.records().iter().map(|record| Some(interval(record.disturbance))).collect(),
    }
}

/// Standard deviations that count as a difference.
const SIGNIFICANT: f64 = 3.0;
/// Correlation of residuals from which a pattern matters: with it at one lag, errors are half as large again as claimed.
const COLOURED: f64 = 0.3;

/// What a record says against its fit; `free` is the same fit with the delay estimated.
fn contradictions(fit: &RecordFit, free: Option<&RecordFit>) -> Vec<&'static str> {
    let later = free.is_some_and(|free| {
        let (given_s, found) = (fit.axis().delay_s(), free.estimate(AxisParameter::DelayS));
        let std = found.spread.map_or(0.0, |spread| spread.std);
        found.value - given_s > (SIGNIFICANT * std).max(0.05 * given_s)
    });
    // Rounding alone leaves a third of a step and may well have a pattern of its own.
    let coloured = fit.records().iter().any(|record| {
        record.residual_rms > 0.5 * record.quantum
            && record.ljung_box_deviate > SIGNIFICANT
            && record.strongest_correlation.abs() > COLOURED
    });
    later.then_some("actuator-lag").into_iter().chain(coloured.then_some("coloured-residuals")).collect()
}
