//! Prediction-error estimation: a Kalman filter predicts each reading from those before it, and the estimates are the
//! parameters of motion and disturbances that maximise the likelihood of its innovations.
//!
//! The vehicle is
//! `alpha x'' + (1 + skew sgn x') (beta + beta_quadratic |x'| + beta_cubic x'^2) x' + memory s + k x = a(t - T_d) + delta + w(t)`,
//! `tau a' = u - a`, `memory_s s' = x' - s`, `y = x + e`, a continuous-discrete stochastic state-space model (Jazwinski 1970;
//! Kristensen, Madsen and Jorgensen 2004; Ljung 1999, chapter 7). Inertia, drag, disturbance and white noise are always there. Terms of the
//! motion are a lag, a limited rate, a pause of the thrust at a reversal, a restoring force, cubic and one-sided drag, and fluid memory.
//! Others are a filter of the sensor, a delay that differs from the given delay, a process force and coloured noise. Each is tried, and joins
//! where the record is enough likelier for it. Intervals are those of all models tried, averaged: they allow for the choice among them.
//! Where readings are rounded, their errors belong together as far as the motion says, and the interval follows.
//!
//! Not guaranteed: a term near its threshold of detection may be omitted, and a structure outside the family may
//! pass for one of its terms. The scale of the thrust cannot be seen in records of one level: all parameters are in its units.

mod actuator;
mod average;
mod candidate;
mod confounded_lags;
mod filter;
pub(crate) mod information;
mod instants;
mod model;
mod motion;
mod observations;
mod pooling;
mod prediction;
mod residuals;
mod rounding;
mod scoring;
mod several;
mod structure_search;
mod term;
#[cfg(test)]
mod tests;
mod thrust;

pub use candidate::{Candidate, RecordAnswer};
pub use model::Parameter;
use model::VehicleModel;
pub use prediction::{PredictedMotion, Prediction};
pub use several::Several;

use rayon::prelude::*;

use super::start;
use crate::experiment::Record;
use crate::identify::answer::distribution::{NORMAL_95, student_quantile_95_expanded};
use crate::identify::answer::{
    Delay, DragCovariance, DragLaw, Estimate, IdentifyError, LawEvidence, Reason, Reported, Term, Trust,
};
pub use crate::identify::signal::{Clock, SwitchingInstant};
use crate::numeric::{Limit, domain};
use average::{Average, CHOSEN};
use observations::Observations;
use scoring::Fitted;
use structure_search::{KnownBefore, LeftOut, SearchOutcome, StructureSearch};

/// Parameters to estimate, and given values.
///
/// ```
/// use selfosc::experiment::{Sensor, SimulatedExperiment};
/// use selfosc::identify::Delay;
/// use selfosc::identify::{Trust, fit::prediction_error::Estimator};
/// use selfosc::{nonlinearity::RelayHysteresis, plant::DragAxis};
/// let axis = DragAxis::quadratic(1.0, 0.5)?.with_delay_s(0.1)?;
/// let sensor = Sensor { quantum: 0.02, ..Sensor::default() };
/// let record = SimulatedExperiment::new(axis, RelayHysteresis::new(1.0, 0.3, 0.0)?, 10.0)?.held().with_sensor(sensor)?.run(60.0)?;
/// let reported = Estimator::new(Delay::KnownS(0.1)).record(&record)?.reported;
/// assert_ne!(reported.trust, Trust::Doubtful);
/// let spread = reported.alpha.spread.expect("an estimate with its error");
/// assert!(spread.low < 1.0 && 1.0 < spread.high);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimator {
    delay: Delay,
    law: Option<DragLaw>,
}

impl Estimator {
    /// Samples of a record in which terms are looked for: its first.
    pub const SEARCHED: usize = structure_search::LONGEST_SEARCHED;

    /// The drag law is found; the delay is estimated, or given and checked.
    #[must_use]
    pub fn new(delay: Delay) -> Self {
        Self { delay, law: None }
    }

    /// The drag law is given.
    #[must_use]
    pub fn with_law(self, law: DragLaw) -> Self {
        Self { law: Some(law), ..self }
    }

    /// The answer to a single record.
    ///
    /// # Errors
    /// [`IdentifyError::OutOfDomain`] for an output or a command that never changes, [`IdentifyError::CommandSign`] for an output that
    /// answers the command's opposite, [`IdentifyError::NotSettled`] where no model follows the record.
    pub fn record(&self, record: &Record) -> Result<RecordAnswer, IdentifyError> {
        for (feature, values) in [("range of the output", record.output()), ("range of the command", record.input())] {
            if values.iter().all(|value| *value == values[0]) {
                let remedy = "choose a column that changes";
                domain::require(feature, 0.0, "units of the column", Limit::Positive, remedy)?;
            }
        }
        let delay_s = match self.delay {
            Delay::KnownS(delay_s) => Some(delay_s),
            Delay::Estimated => None,
        };
        if start::answers_against(&Observations::new(record, Clock::Stamps, SwitchingInstant::AtSamples), delay_s) {
            return Err(IdentifyError::CommandSign);
        }
        let known = KnownBefore { delay_s, law: self.law };
        let (search, found) = StructureSearch::new(record, known)
            .run()
            .ok_or(IdentifyError::NotSettled { steps: 0, rms: deviation(record.output()) })?;
        Ok(conclude(&search, &found, known))
    }
}

impl Estimator {
    /// The answer to several records of the same vehicle: each on its own, then together, with a test whether they agree.
    ///
    /// # Errors
    /// As [`record`](Self::record), of the first record that has no answer; [`IdentifyError::TooFewEquations`] without records.
    pub fn records(&self, records: &[&Record]) -> Result<Several, IdentifyError> {
        if records.is_empty() {
            return Err(IdentifyError::TooFewEquations { equations: 0, parameters: Parameter::COUNT });
        }
        let answers: Result<Vec<RecordAnswer>, IdentifyError> =
            records.par_iter().map(|record| self.record(record)).collect();
        answers.map(|answers| Several::of(answers).predicted(records))
    }
}

fn terms_of(fitted: &Fitted, known: KnownBefore) -> Vec<Term> {
    let has = |term: &Term| term.is_in(&fitted.model) && (*term != Term::Delay || known.delay_s.is_some());
    Term::ALL.into_iter().filter(has).collect()
}

/// The answer from all models tried.
fn conclude(search: &StructureSearch<'_>, found: &SearchOutcome, known: KnownBefore) -> RecordAnswer {
    let best = &found.tried[found.best];
    let observations = search.observations(&best.model);
    let average = Average::new(
        found,
        |fitted| search.observations(&fitted.model),
        |fitted| {
            let priced = fitted.model.freedom() - average::drags(&fitted.model);
            let price = search.observations(&fitted.model).price(priced);
            fitted.log_likelihood - 0.5 * price - average::log_odds_against(&fitted.model, known.delay_s)
        },
    );
    let terms = terms_of(best, known);
    let mut reasons: Vec<Reason> = Vec::new();
    for term in &terms {
        reasons.push(match (term, known.delay_s) {
            (Term::Delay, Some(given_s)) => {
                Reason::DelayContradicted { given_s, found_s: best.model.value(Parameter::DelayS) }
            }
            _ => Reason::Term(*term),
        });
    }
    let count = observations.count();
    let spare = (count - best.model.freedom() as f64).max(1.0);
    let mut factor = (count / spare).sqrt() * student_quantile_95_expanded(spare) / NORMAL_95;
    if !terms.is_empty() {
        factor *= CHOSEN;
    }
    if observations.outliers > 0 {
        reasons.push(Reason::Outliers { count: observations.outliers });
    }
    let (probability, apart) = residuals::halves(best, observations);
    if probability < residuals::DISAGREE {
        reasons.push(Reason::HalvesDisagree { probability });
    }
    let exact = |parameter: Parameter| Estimate::new(best.model.value(parameter), None);
    let estimate = |parameter: Parameter| average.estimate(parameter, factor).unwrap_or_else(|| exact(parameter));
    let present = |parameter: Parameter| best.model.is_free(parameter).then(|| estimate(parameter));
    let mut alpha = estimate(Parameter::Alpha);
    if let Some(spread) = &mut alpha.spread
        && probability < residuals::DISAGREE
    {
        (spread.low, spread.high) = (spread.low - apart, spread.high + apart);
        spread.std = libm::hypot(spread.std, apart);
    }
    reasons.extend(Reason::too_wide(alpha));
    if !best.settled {
        reasons.push(Reason::NotSettled);
    }
    if found.left_out > LeftOut::Nothing {
        reasons.push(Reason::SearchEnded { joining: found.left_out == LeftOut::Terms });
    }
    reasons.sort_by_key(|reason| core::cmp::Reverse(reason.trust()));
    let trust = reasons.iter().map(|reason| reason.trust()).max().unwrap_or(Trust::Good);
    let not_negative = |mut estimate: Estimate| {
        if let Some(spread) = &mut estimate.spread {
            (spread.low, spread.high) = (spread.low.max(0.0), spread.high.max(0.0));
        }
        estimate
    };
    let drags = [Parameter::LinearDrag, Parameter::QuadraticDrag, Parameter::CubicDrag];
    let [beta, beta_quadratic] = [estimate(drags[0]), estimate(drags[1])];
    let beta_cubic = present(drags[2]);
    let means = Reported {
        drag: known.law.unwrap_or(DragLaw::Mixed),
        laws: laws_of(found, best),
        terms,
        alpha,
        beta,
        beta_quadratic,
        beta_cubic,
        drag_covariance: DragCovariance::of(
            average.covariance(drags, factor),
            [Some(beta), Some(beta_quadratic), beta_cubic],
        ),
        skew: present(Parameter::Skew),
        coulomb: None,
        stiffness: present(Parameter::Stiffness),
        memory: present(Parameter::Memory),
        memory_s: present(Parameter::MemoryS).map(not_negative),
        lag_s: present(Parameter::LagS).map(not_negative),
        ramp_s: present(Parameter::RampS).map(not_negative),
        pause_s: present(Parameter::PauseS).map(not_negative),
        filter_s: present(Parameter::FilterS).map(not_negative),
        deltas: [estimate(Parameter::Disturbance)].into_iter().collect(),
        delay_s: not_negative(estimate(Parameter::DelayS)),
        budget: Vec::new(),
        trust,
        reasons,
    };
    let mut tried: Vec<&Fitted> = found.tried.iter().collect();
    let value = |fitted: &Fitted| 2.0 * fitted.log_likelihood - observations.price(fitted.model.freedom());
    tried.sort_by(|a, b| value(b).total_cmp(&value(a)));
    let candidate = |fitted: &Fitted| Candidate {
        terms: terms_of(fitted, known),
        clock: fitted.model.clock,
        values: fitted.model.values,
    };
    let candidates = tried.into_iter().map(candidate).collect();
    RecordAnswer {
        reported: belonging(&means, &best.model),
        means,
        candidates,
        command_level: 0.5 * observations.range,
    }
}

/// The answer with the values of one model, within the intervals of all.
///
/// Means over the models, each parameter by itself, are the parameters of no model: of one with cubic drag and one without, they have
/// the lesser quadratic drag that the cubic drag makes up for, and no cubic drag.
fn belonging(means: &Reported, model: &VehicleModel) -> Reported {
    let of = |parameter: Parameter, estimate: Estimate| {
        let value = model.value(parameter);
        Estimate { value: estimate.spread.map_or(value, |ends| value.max(ends.low).min(ends.high)), ..estimate }
    };
    let term = |parameter: Parameter, estimate: Option<Estimate>| estimate.map(|estimate| of(parameter, estimate));
    Reported {
        alpha: of(Parameter::Alpha, means.alpha),
        beta: of(Parameter::LinearDrag, means.beta),
        beta_quadratic: of(Parameter::QuadraticDrag, means.beta_quadratic),
        beta_cubic: term(Parameter::CubicDrag, means.beta_cubic),
        skew: term(Parameter::Skew, means.skew),
        stiffness: term(Parameter::Stiffness, means.stiffness),
        memory: term(Parameter::Memory, means.memory),
        memory_s: term(Parameter::MemoryS, means.memory_s),
        lag_s: term(Parameter::LagS, means.lag_s),
        ramp_s: term(Parameter::RampS, means.ramp_s),
        pause_s: term(Parameter::PauseS, means.pause_s),
        filter_s: term(Parameter::FilterS, means.filter_s),
        delay_s: of(Parameter::DelayS, means.delay_s),
        deltas: means.deltas.iter().map(|delta| of(Parameter::Disturbance, *delta)).collect(),
        ..means.clone()
    }
}

/// Comparison of the drag laws, with the terms of the best model.
fn laws_of(found: &SearchOutcome, best: &Fitted) -> LawEvidence {
    LawEvidence::from_log_likelihoods(DragLaw::ALL.map(|law| {
        let model = best.model.with_drag(law, 1.0);
        let alike = found.tried.iter().filter(|fitted| fitted.model.is_alike(&model));
        alike.map(|fitted| fitted.log_likelihood).reduce(f64::max)
    }))
}

/// Root mean square about the mean: the residual of no model at all.
#[allow(clippy::cast_precision_loss, reason = "a count of samples")]
fn deviation(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt()
}
