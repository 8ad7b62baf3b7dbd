//! Several records of one vehicle: what they say together, and whether they agree.
//!
//! Where they agree, estimates are weighted by their precision; where they do not, the interval holds every record's own, as
//! far as a mean of random effects would leave any of them out (DerSimonian and Laird 1986 test for it with the same sum).
//! Records of other levels of the command may differ because thrust is not proportional to it: see [`thrust`](super::thrust).

use super::candidate::RecordAnswer;
use super::pooling::{DISAGREE, known, mean, pooled, probability_of_one, weights};
use super::prediction::Prediction;
use super::thrust::{CommandLevels, Drawn, ThrustLaw, ThrustVerdict};
use crate::experiment::Record;
use crate::identify::answer::{DragCovariance, Estimate, LawEvidence, Reason, Reported, Trust, matrix};

/// Relative standard deviation from which on a drag says nothing about the ratio of drag to inertia.
const VAGUE: f64 = 0.3;

/// What several records say.
#[derive(Clone, Debug, PartialEq)]
pub struct Several {
    /// The one answer to use; its disturbances are in the order of the records.
    pub reported: Reported,
    /// Each record's own.
    pub answers: Vec<RecordAnswer>,
    /// Each record predicted from the rest; `None` if the record is alone, or the prediction diverges.
    pub left_out: Vec<Option<Prediction>>,
}

/// Whether the ratio of drag to inertia differs between records: no law of thrust changes it.
fn vehicles_differ(all: &[Reported]) -> bool {
    let drags: [fn(&Reported) -> Estimate; 2] = [|reported| reported.beta, |reported| reported.beta_quadratic];
    drags.into_iter().any(|drag| {
        let ratio = |reported: &Reported| {
            let both = known(&[reported.alpha, drag(reported)])?;
            let relative = |(value, std): (f64, f64)| Some(std / value.abs()).filter(|part| *part < VAGUE);
            let ratio = both[1].0 / both[0].0;
            Some((ratio, ratio.abs() * libm::hypot(relative(both[0])?, relative(both[1])?)))
        };
        let ratios: Option<Vec<(f64, f64)>> = all.iter().map(ratio).collect();
        ratios.is_some_and(|ratios| probability_of_one(&ratios) < 0.5 * DISAGREE)
    })
}

/// The records in a common unit of force, and their pooled answer.
struct Together {
    parts: Vec<Reported>,
    /// What the intervals hold beside what they would.
    held: Vec<Reported>,
    /// Relative error of the unit, which all parts share.
    shared: f64,
    reason: Option<Reason>,
}

impl Together {
    fn of(answers: &[RecordAnswer], levels: Option<&CommandLevels>) -> Self {
        let parts: Vec<Reported> = answers.iter().map(|answer| answer.reported.clone()).collect();
        let (alpha, apart) = pooled(&parts.iter().map(|part| part.alpha).collect::<Vec<_>>());
        let plain = |reason| Self { parts: parts.clone(), held: Vec::new(), shared: 0.0, reason };
        let Some(relative) = apart.map(|between| between / alpha.value.abs()) else { return plain(None) };
        let verdict =
            levels.filter(|_| !vehicles_differ(&parts)).and_then(|levels| levels.verdict(alpha.value, DISAGREE));
        let in_units = |drawn: &Drawn| answers.iter().map(|answer| drawn.in_its_units(answer)).collect::<Vec<_>>();
        match verdict {
            None => plain(Some(Reason::RecordsDisagree { relative })),
            Some(ThrustVerdict::One(drawn)) => {
                let parts = in_units(&drawn);
                let alphas = known(&parts.iter().map(|part| part.alpha).collect::<Vec<_>>());
                let chance = alphas.map(|alphas| mean(&alphas)).map_or(0.0, |(value, std)| std / value);
                let shared = (drawn.relative * drawn.relative - chance * chance).max(0.0).sqrt();
                let reason = Some(match drawn.law {
                    ThrustLaw::DeadZone { width } => Reason::ThrustDeadZone { width },
                    ThrustLaw::Power { exponent, level } => Reason::ThrustPower { exponent, level },
                });
                Self { parts, held: Vec::new(), shared, reason }
            }
            Some(ThrustVerdict::Open { dead_zone, exponent, level }) => {
                let beyond = dead_zone
                    .iter()
                    .flat_map(|drawn| in_units(drawn).into_iter().map(|part| part.with_error(drawn.relative)));
                let dead_zone = dead_zone.and_then(|drawn| drawn.law.width());
                let reason = Some(Reason::ThrustNotProportional { relative, dead_zone, exponent, level });
                let held = parts.iter().cloned().chain(beyond).collect();
                Self { parts, held, shared: 0.0, reason }
            }
        }
    }

    /// Of a number in units of force.
    fn force(&self, of: impl Fn(&Reported) -> Option<Estimate>) -> Option<Estimate> {
        let all = |records: &[Reported]| records.iter().filter_map(&of).collect::<Vec<Estimate>>();
        joint(&all(&self.parts)).map(|one| one.with_error(self.shared).holding(&all(&self.held)))
    }

    /// Covariance of the pooled drags: `sum_k w_ki w_kj C_k,ij` over records k with the weights of the means.
    fn drag_covariance(&self, pooled: [Option<Estimate>; 3]) -> Option<DragCovariance> {
        let values = pooled.map(|drag| drag.map_or(0.0, |drag| drag.value));
        let drags: Vec<[Option<Estimate>; 3]> = self.parts.iter().map(Reported::drags).collect();
        let own: Option<Vec<_>> = self.parts.iter().map(|part| part.drag_covariance).collect();
        let own = own.filter(|_| self.held.is_empty())?;
        let of = |i: usize| {
            let drags: Vec<Option<Estimate>> = drags.iter().map(|drags| drags[i]).collect();
            // A drag that no record reports is zero in each: a plain mean.
            let none = drags.iter().all(Option::is_none);
            if none { Some(vec![1.0 / drags.len() as f64; drags.len()]) } else { weights(&drags) }
        };
        let weights = [of(0)?, of(1)?, of(2)?];
        let entry = |i: usize, j: usize| {
            own.iter().enumerate().map(|(k, own)| weights[i][k] * weights[j][k] * own.statistical[i][j]).sum()
        };
        DragCovariance::of(
            DragCovariance::statistical(matrix(entry)).with_error(self.shared, values).statistical,
            pooled,
        )
    }
}

/// One from those that are there.
fn joint(estimates: &[Estimate]) -> Option<Estimate> {
    (!estimates.is_empty()).then(|| pooled(estimates).0)
}

impl Several {
    /// The joint answer; there is at least one.
    pub(super) fn of(answers: Vec<RecordAnswer>) -> Self {
        if let [alone] = &answers[..] {
            return Self { reported: alone.reported.clone(), answers, left_out: vec![None] };
        }
        let pooled: Vec<RecordAnswer> =
            answers.iter().map(|answer| RecordAnswer { reported: answer.means.clone(), ..answer.clone() }).collect();
        let reported = Self::pooled(&pooled);
        let left_out = vec![None; answers.len()];
        Self { reported, answers, left_out }
    }

    fn pooled(answers: &[RecordAnswer]) -> Reported {
        let levels = CommandLevels::of(answers);
        let together = Together::of(answers, levels.as_ref());
        let own = |of: &dyn Fn(&Reported) -> Option<Estimate>| {
            joint(&answers.iter().filter_map(|answer| of(&answer.reported)).collect::<Vec<_>>())
        };
        let first = &answers[0].reported;
        let alpha = together.force(|r| Some(r.alpha)).unwrap_or(first.alpha);
        let own_deltas: Vec<Estimate> = answers.iter().flat_map(|answer| answer.reported.deltas.to_vec()).collect();
        let mut reasons: Vec<Reason> = Vec::new();
        for reason in answers.iter().flat_map(|answer| &answer.reported.reasons) {
            let of_one = matches!(reason, Reason::TooWide { .. });
            let known = |other: &Reason| (other.code(), other.trust()) == (reason.code(), reason.trust());
            if !of_one && !reasons.iter().any(known) {
                reasons.push(*reason);
            }
        }
        reasons.extend(together.reason);
        let share = levels.and_then(|levels| levels.asymmetry(&own_deltas, DISAGREE));
        reasons.extend(share.map(|share| Reason::ForceFollowsLevel { share }));
        reasons.extend(Reason::too_wide(alpha));
        reasons.sort_by_key(|reason| core::cmp::Reverse(reason.trust()));
        let mut terms: Vec<_> = answers.iter().flat_map(|answer| answer.reported.terms.iter().copied()).collect();
        terms.sort_unstable();
        terms.dedup();
        let beta = together.force(|r| Some(r.beta)).unwrap_or(first.beta);
        let beta_quadratic = together.force(|r| Some(r.beta_quadratic)).unwrap_or(first.beta_quadratic);
        let beta_cubic = together.force(|r| r.beta_cubic);
        Reported {
            drag: first.drag,
            laws: LawEvidence::sum(answers.iter().map(|answer| answer.reported.laws)),
            terms,
            alpha,
            beta,
            beta_quadratic,
            beta_cubic,
            drag_covariance: together.drag_covariance([Some(beta), Some(beta_quadratic), beta_cubic]),
            skew: own(&|r| r.skew),
            memory: together.force(|r| r.memory),
            memory_s: own(&|r| r.memory_s),
            coulomb: None,
            stiffness: together.force(|r| r.stiffness),
            lag_s: own(&|r| r.lag_s),
            ramp_s: own(&|r| r.ramp_s),
            pause_s: own(&|r| r.pause_s),
            filter_s: own(&|r| r.filter_s),
            deltas: together
                .parts
                .iter()
                .flat_map(|part| part.clone().with_error(together.shared).deltas.to_vec())
                .collect(),
            delay_s: own(&|r| Some(r.delay_s)).unwrap_or(first.delay_s),
            budget: Vec::new(),
            trust: reasons.iter().map(|reason| reason.trust()).max().unwrap_or(Trust::Good),
            reasons,
        }
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
