//! Where a feasible point is sought when division has found none: about the maximum likelihood fit, which is not trusted.

use super::super::answer::Quantity;
use super::super::contraction::Contractor;
use super::super::settings::{BoundedModel, DelayBound};
use super::super::vector_field::FieldTerm;
use super::ParameterPoint;
use crate::experiment::Record;
use crate::identify::fit::prediction_error::{Candidate, Clock, Estimator, Parameter};
use crate::identify::{Delay, Estimate, Term};
use crate::numeric::Interval;

/// Half-widths of the boxes about the estimate, in shares of the command.
const SHARES: [f64; 2] = [0.03, 0.2];

/// Whether a fit has the terms of the model in addition to its drag, and no more.
fn has_terms_of(candidate: &Candidate, settings: &BoundedModel) -> bool {
    let terms = [(Term::Lag, settings.lag), (Term::Stiffness, settings.stiffness), (Term::CubicDrag, settings.cubic)];
    candidate.clock == Clock::Stamps
        && terms.iter().all(|(term, used)| candidate.terms.contains(term) == *used)
        && candidate.terms.iter().all(|term| *term == Term::Delay || terms.iter().any(|(own, _)| own == term))
}

/// The fit of the first record, with each record's own disturbance.
pub(in super::super) fn estimated(records: &[&Record], settings: &BoundedModel) -> Option<Vec<(Quantity, f64)>> {
    let delay = match settings.delay {
        DelayBound::KnownS(delay_s) => Delay::KnownS(delay_s),
        DelayBound::WithinS(_) | DelayBound::Unknown => Delay::Estimated,
    };
    let estimator = Estimator::new(delay).with_law(settings.law);
    let mut quantities = Vec::new();
    for (number, record) in records.iter().enumerate() {
        let answer = estimator.record(record).ok()?;
        let fit = answer.candidates.iter().find(|candidate| has_terms_of(candidate, settings));
        let reported = &answer.reported;
        let or = |parameter: Parameter, other: f64| fit.map_or(other, |fit| fit.values[parameter as usize]);
        let value = |estimate: Option<Estimate>| estimate.map_or(0.0, |estimate| estimate.value);
        if number == 0 {
            quantities.extend([
                (Quantity::Alpha, or(Parameter::Alpha, reported.alpha.value)),
                (Quantity::Beta, or(Parameter::LinearDrag, reported.beta.value)),
                (Quantity::BetaQuadratic, or(Parameter::QuadraticDrag, reported.beta_quadratic.value)),
                (Quantity::BetaCubic, or(Parameter::CubicDrag, value(reported.beta_cubic))),
                (Quantity::Stiffness, or(Parameter::Stiffness, value(reported.stiffness))),
                (Quantity::LagS, or(Parameter::LagS, value(reported.lag_s))),
                (Quantity::DelayS, or(Parameter::DelayS, reported.delay_s.value)),
            ]);
        }
        let delta = reported.deltas.first().map_or(0.0, |delta| delta.value);
        quantities.push((Quantity::Delta(number), or(Parameter::Disturbance, delta)));
    }
    Some(quantities)
}

impl Contractor {
    /// A box about estimates with room for a share of the command, moved into the search box.
    fn about_estimates(&self, estimates: &[(Quantity, f64)], share: f64) -> Option<Vec<Interval>> {
        let (problem, unknowns) = (&self.problem, &self.problem.unknowns);
        let of = |quantity| estimates.iter().find(|(own, _)| *own == quantity).map_or(0.0, |(_, value)| *value);
        let gain = 1.0 / of(Quantity::Alpha);
        let (acceleration, speed) = (problem.largest_command() * gain, problem.typical_speed);
        // Value, and the change of it that changes the force by the command.
        let of_term = |term: &FieldTerm| match term {
            FieldTerm::Gain => (gain, gain),
            FieldTerm::Linear => {
                let linear = of(Quantity::Beta) + 2.0 * problem.middle_speed * of(Quantity::BetaQuadratic);
                (linear * gain, acceleration / speed)
            }
            FieldTerm::Quadratic => (of(Quantity::BetaQuadratic) * gain, acceleration / (speed * speed)),
            FieldTerm::Cubic => (of(Quantity::BetaCubic) * gain, acceleration / (speed * speed * speed)),
            FieldTerm::Stiffness => (of(Quantity::Stiffness) * gain, acceleration / problem.amplitude),
            FieldTerm::LagRate => [1.0 / of(Quantity::LagS).max(1e-3 * problem.half_period_s); 2].into(),
            FieldTerm::Disturbance => (0.0, acceleration),
        };
        let terms = unknowns.terms.iter().map(of_term).enumerate();
        let delay = unknowns.delay().map(|place| (place, (of(Quantity::DelayS), 0.2 * problem.half_period_s)));
        let deltas = (0..unknowns.records())
            .map(|record| (unknowns.disturbance(record), (of(Quantity::Delta(record)) * gain, acceleration)));
        let mut at = problem.search.clone();
        for (place, (value, unit)) in terms.chain(delay).chain(deltas) {
            let side = problem.search[place];
            let near = Interval::point(value.clamp(side.lower(), side.upper()));
            at[place] = (near + Interval::symmetric((share * unit).abs())).intersection(side)?;
        }
        Some(at)
    }

    /// A parameter with a small misfit about estimates.
    pub(in super::super) fn nearest_to(&mut self, estimates: &[(Quantity, f64)]) -> Option<ParameterPoint> {
        let mut best: Option<ParameterPoint> = None;
        for share in SHARES {
            let Some(mut at) = self.about_estimates(estimates, share) else { continue };
            if self.modulate(&mut at).is_err() {
                continue;
            }
            let found = self.nearest(&at, &self.problem.search);
            best = best.into_iter().chain(found).min_by(|a, b| a.misfit.total_cmp(&b.misfit));
            if best.as_ref().is_some_and(ParameterPoint::is_feasible) {
                break;
            }
        }
        best
    }
}
