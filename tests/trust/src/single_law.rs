//! The baseline: maximum likelihood under linear, quadratic and mixed drag, the likeliest law taken.
//!
//! It has no terms and no verdict of its own. An answer counts as doubtful where a warning says that the record contradicts the
//! model (a lag, coloured residuals); warnings of a wide interval or of confounded parameters do not.

use std::borrow::Cow;

use selfosc::experiment::Record;
use selfosc::identify::fit::{Fit, RecordFit};
use selfosc::identify::joint::{Delay, Parameter};
use selfosc::identify::select::likelihood::Choice;
use selfosc::identify::{DragLaw, Warning};
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
