//! Several records of one vehicle: what they say together, and whether they agree.
//!
//! Where they agree, estimates are weighted by their precision; where they do not, the interval holds every record's own, as
//! far as a mean of random effects would leave any of them out (DerSimonian and Laird 1986 test for it with the same sum).

use super::answer::{Answer, Reason, Reported, Trust};
use super::laws::LawEvidence;
use super::prediction::Prediction;
use super::residuals::NORMAL;
use super::tail::chi_square_tail;
use crate::experiment::Record;
use crate::identify::DragLaw;
use crate::identify::joint::{ConfidenceInterval, Estimate};

/// Below this probability records disagree.
const DISAGREE: f64 = 0.01;
/// Ratio of the commands' ranges from which on their levels are different.
const OTHER_LEVEL: f64 = 1.05;

/// What several records say.
#[derive(Clone, Debug, PartialEq)]
pub struct Several {
    /// The one answer to use; its disturbances are in the order of the records.
    pub reported: Reported,
    /// Each record's own.
    pub answers: Vec<Answer>,
    /// Each record predicted from all others; `None` where there are no others, or the prediction leaves all bounds.
    pub left_out: Vec<Option<Prediction>>,
}

/// Half the width of an interval in normal standard deviations: also right where it is no normal one.
fn deviation(spread: ConfidenceInterval) -> f64 {
    0.5 * (spread.high - spread.low) / NORMAL
}

/// Estimates of one number together, and the scatter between them beyond chance.
fn pooled(estimates: &[Estimate]) -> (Estimate, Option<f64>) {
    let known: Vec<(f64, f64, ConfidenceInterval)> =
        estimates.iter().filter_map(|e| e.spread.map(|spread| (e.value, deviation(spread), spread))).collect();
    if known.len() < estimates.len() || known.iter().any(|(_, std, _)| *std <= 0.0) {
        return (
            known.first().map_or(estimates[0], |(value, _, spread)| Estimate { value: *value, spread: Some(*spread) }),
            None,
        );
    }
    let weight: f64 = known.iter().map(|(_, std, _)| std.powi(-2)).sum();
    let mean = known.iter().map(|(value, std, _)| value * std.powi(-2)).sum::<f64>() / weight;
    let scatter: f64 = known.iter().map(|(value, std, _)| ((value - mean) / std).powi(2)).sum();
    let std = weight.sqrt().recip();
    let freedom = known.len() as f64 - 1.0;
    if freedom > 0.0 && chi_square_tail(scatter, freedom) < DISAGREE {
        let values = known.iter().map(|(value, ..)| *value);
        let value = values.clone().sum::<f64>() / known.len() as f64;
        let between = (values.map(|v| (v - value).powi(2)).sum::<f64>() / freedom).sqrt();
        let low = known.iter().map(|(.., spread)| spread.low).fold(f64::INFINITY, f64::min);
        let high = known.iter().map(|(.., spread)| spread.high).fold(f64::NEG_INFINITY, f64::max);
        return (
            Estimate { value, spread: Some(ConfidenceInterval { std: between.hypot(std), low, high }) },
            Some(between),
        );
    }
    (
        Estimate {
            value: mean,
            spread: Some(ConfidenceInterval { std, low: mean - NORMAL * std, high: mean + NORMAL * std }),
        },
        None,
    )
}

impl Several {
    /// The joint answer; there is at least one.
    pub(super) fn of(answers: Vec<Answer>) -> Self {
        let all = |part: &dyn Fn(&Reported) -> Estimate| {
            let parts: Vec<Estimate> = answers.iter().map(|answer| part(&answer.reported)).collect();
            pooled(&parts)
        };
        let some = |part: &dyn Fn(&Reported) -> Option<Estimate>| {
            let parts: Vec<Estimate> = answers.iter().filter_map(|answer| part(&answer.reported)).collect();
            (!parts.is_empty()).then(|| pooled(&parts).0)
        };
        let (alpha, apart) = all(&|r| r.alpha);
        let mut reasons: Vec<Reason> = Vec::new();
        for reason in answers.iter().flat_map(|answer| &answer.reported.reasons) {
            if !reasons.iter().any(|other| other.code() == reason.code()) {
                reasons.push(*reason);
            }
        }
        let ranges = answers.iter().map(|answer| answer.command_range);
        let (least, largest) =
            ranges.fold((f64::INFINITY, 0.0), |(low, high), range| (range.min(low), range.max(high)));
        reasons.extend(apart.map(|between| {
            let relative = between / alpha.value.abs();
            if largest > OTHER_LEVEL * least {
                Reason::ThrustNotProportional { relative }
            } else {
                Reason::RecordsDisagree { relative }
            }
        }));
        reasons.sort_by_key(|reason| core::cmp::Reverse(reason.trust()));
        let drags: Vec<DragLaw> = answers.iter().map(|answer| answer.reported.drag).collect();
        let mut terms: Vec<_> = answers.iter().flat_map(|answer| answer.reported.terms.iter().copied()).collect();
        terms.sort_unstable();
        terms.dedup();
        let reported = Reported {
            drag: if drags.iter().all(|drag| *drag == drags[0]) { drags[0] } else { DragLaw::Mixed },
            laws: LawEvidence::sum(answers.iter().map(|answer| answer.reported.laws)),
            terms,
            alpha,
            beta: all(&|r| r.beta).0,
            beta_quadratic: all(&|r| r.beta_quadratic).0,
            beta_cubic: some(&|r| r.beta_cubic),
            skew: some(&|r| r.skew),
            memory: some(&|r| r.memory),
            memory_s: some(&|r| r.memory_s),
            coulomb: some(&|r| r.coulomb),
            stiffness: some(&|r| r.stiffness),
            lag_s: some(&|r| r.lag_s),
            ramp_s: some(&|r| r.ramp_s),
            filter_s: some(&|r| r.filter_s),
            deltas: answers.iter().flat_map(|answer| answer.reported.deltas.iter().copied()).collect(),
            delay_s: all(&|r| r.delay_s).0,
            trust: reasons.iter().map(|reason| reason.trust()).max().unwrap_or(Trust::Good),
            reasons,
        };
        let left_out = vec![None; answers.len()];
        Self { reported, answers, left_out }
    }

    /// With each record predicted from all others.
    pub(super) fn predicted(mut self, records: &[&Record]) -> Self {
        if records.len() > 1 {
            let without = |index: usize| {
                let others = self.answers.iter().enumerate().filter(|(other, _)| *other != index);
                Self::of(others.map(|(_, answer)| answer.clone()).collect()).reported
            };
            self.left_out = (0..records.len()).map(|index| without(index).predict(records[index])).collect();
        }
        self
    }
}
