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
/// Relative standard deviation from which on a drag says nothing about the ratio of drag to inertia.
const VAGUE: f64 = 0.3;

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

/// How the records' estimates become one.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Pooling {
    /// Their weighted mean, or all of them where they scatter beyond chance.
    Weighted,
    /// All of them, whatever their scatter.
    All,
}

/// Estimates of one number together, and the scatter between them beyond chance.
fn pooled(estimates: &[Estimate], pooling: Pooling) -> (Estimate, Option<f64>) {
    let known: Vec<(f64, f64, ConfidenceInterval)> =
        estimates.iter().filter_map(|e| e.spread.map(|spread| (e.value, spread.deviation(), spread))).collect();
    if known.len() < estimates.len() || known.iter().any(|(_, std, _)| *std <= 0.0) {
        return (
            known.first().map_or(estimates[0], |(value, _, spread)| Estimate { value: *value, spread: Some(*spread) }),
            None,
        );
    }
    let numbers = known.iter().map(|(value, std, _)| (*value, *std));
    let weight: f64 = numbers.clone().map(|(_, std)| std.powi(-2)).sum();
    let mean = numbers.clone().map(|(value, std)| value * std.powi(-2)).sum::<f64>() / weight;
    let std = weight.sqrt().recip();
    if known.len() > 1 && (pooling == Pooling::All || probability_of_one(numbers) < DISAGREE) {
        let values = known.iter().map(|(value, ..)| *value);
        let value = values.clone().sum::<f64>() / known.len() as f64;
        let between = (values.map(|v| (v - value).powi(2)).sum::<f64>() / (known.len() as f64 - 1.0)).sqrt();
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

/// The estimate with a relative error that all records share.
fn with_error(mut estimate: Estimate, relative: f64) -> Estimate {
    if let Some(spread) = &mut estimate.spread {
        let more = estimate.value.abs() * relative;
        let (own, std) = (spread.deviation(), spread.deviation().hypot(more));
        let wider = NORMAL * (std - own);
        *spread = ConfidenceInterval { std, low: spread.low - wider, high: spread.high + wider };
    }
    estimate
}

/// Whether the ratio of drag to inertia differs between records: no law of thrust changes it.
fn vehicles_differ(all: &[Reported]) -> bool {
    let parts: [fn(&Reported) -> Estimate; 2] = [|r| r.beta, |r| r.beta_quadratic];
    parts.into_iter().any(|drag| {
        let ratio = |reported: &Reported| {
            let (alpha, drag) = (reported.alpha, drag(reported));
            let relative = |e: Estimate| Some(e.spread?.deviation() / e.value.abs()).filter(|part| *part < VAGUE);
            let ratio = drag.value / alpha.value;
            Some((ratio, ratio.abs() * relative(drag)?.hypot(relative(alpha)?)))
        };
        let ratios: Option<Vec<(f64, f64)>> = all.iter().map(ratio).collect();
        ratios.is_some_and(|ratios| probability_of_one(ratios.into_iter()) < 0.5 * DISAGREE)
    })
}

/// The records in one unit of force, and how they become one answer.
struct Together {
    parts: Vec<Reported>,
    pooling: Pooling,
    /// Relative error of the unit, which all parts share.
    shared: f64,
    reason: Option<Reason>,
}

impl Together {
    fn of(answers: &[Answer], levels: Option<&Levels>) -> Self {
        let parts: Vec<Reported> = answers.iter().map(|answer| answer.reported.clone()).collect();
        let alpha = |parts: &[Reported], pooling| {
            let (alpha, apart) = pooled(&parts.iter().map(|part| part.alpha).collect::<Vec<_>>(), pooling);
            (alpha, apart.map(|between| between / alpha.value.abs()))
        };
        let Some(relative) = alpha(&parts, Pooling::Weighted).1 else {
            return Self { parts, pooling: Pooling::Weighted, shared: 0.0, reason: None };
        };
        let in_units = |drawn: &Drawn| answers.iter().map(|answer| drawn.in_its_units(answer)).collect::<Vec<_>>();
        match levels.filter(|_| !vehicles_differ(&parts)).and_then(|levels| levels.verdict(DISAGREE)) {
            None => {
                let reason = Some(Reason::RecordsDisagree { relative });
                Self { parts, pooling: Pooling::Weighted, shared: 0.0, reason }
            }
            Some(Verdict::One(drawn)) => {
                let parts = in_units(&drawn);
                let own = alpha(&parts, Pooling::Weighted).0;
                let chance = own.spread.map_or(0.0, |spread| spread.deviation() / own.value.abs());
                let shared = (drawn.relative * drawn.relative - chance * chance).max(0.0).sqrt();
                let reason = Some(match drawn.law {
                    ThrustLaw::DeadZone { width } => Reason::ThrustDeadZone { width },
                    ThrustLaw::Power { exponent, level } => Reason::ThrustPower { exponent, level },
                });
                Self { parts, pooling: Pooling::Weighted, shared, reason }
            }
            Some(Verdict::Open { dead_zone, power }) => {
                let beyond = dead_zone.iter().flat_map(|drawn| {
                    in_units(drawn).into_iter().map(|part| part.with_error(drawn.relative))
                });
                let parts: Vec<Reported> = parts.into_iter().chain(beyond).collect();
                let value = alpha(&parts, Pooling::All).0.value;
                let reason = power.level_of(value).map(|(exponent, level)| Reason::ThrustNotProportional {
                    relative,
                    dead_zone: dead_zone.map(|drawn| drawn.width()),
                    exponent,
                    level,
                });
                Self { parts, pooling: Pooling::All, shared: 0.0, reason }
            }
        }
    }

    fn estimate(&self, part: &dyn Fn(&Reported) -> Estimate) -> Estimate {
        let parts: Vec<Estimate> = self.parts.iter().map(part).collect();
        pooled(&parts, self.pooling).0.with_error(self.shared)
    }
}
@@@        reasons.sort_by_key(|reason| core::cmp::Reverse(reason.trust()));
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
