//! The prediction-error estimator: terms found, models averaged, a verdict of its own.

use std::borrow::Cow;

use selfosc::experiment::Record;
use selfosc::identify::fit::prediction_error::Estimator;
use selfosc::identify::{self, Delay, Estimate, Reason, Reported};
use selfosc_simulator::answer::{Answer, Trust};
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
    let estimator = Estimator::new(case.known.delay_s.map_or(Delay::Estimated, Delay::KnownS));
    let reported = match &records[..] {
        [record] => estimator.record(record).map(|answer| answer.reported),
        several => estimator.records(&several.iter().collect::<Vec<_>>()).map(|several| several.reported),
    };
    match reported {
        Ok(reported) => answer(&reported, case),
        Err(error) => Answer::refused(error.code()),
    }
}

fn answer(reported: &Reported, case: &Case) -> Answer {
    let whole = |estimate: Estimate| Some(interval(estimate));
    Answer {
        trust: match reported.trust {
            identify::Trust::Good => Trust::Good,
            identify::Trust::Widened => Trust::Widened,
            identify::Trust::Doubtful => Trust::Doubtful,
        },
        reasons: reported.reasons.iter().map(|reason: &Reason| Cow::Borrowed(reason.code())).collect(),
        alpha: reported.alpha.spread.and(whole(reported.alpha)),
        beta: whole(reported.beta),
        beta_quadratic: whole(reported.beta_quadratic),
        beta_cubic: reported.beta_cubic.and_then(whole),
        stiffness: reported.stiffness.and_then(whole),
        lag_s: reported.lag_s.and_then(whole),
        delay_s: case.known.delay_s.is_none().then(|| interval(reported.delay_s)),
        delta: reported.deltas.iter().map(|estimate| whole(*estimate)).collect(),
    }
}
