//! Where a witness is looked for when division has not led to one: about what the likeliest fit says. It is not trusted.

use super::bounds::Quantity;
use super::field::Term as Drag;
use super::search::Search;
use super::settings::{BoundedModel, DelayBound};
use super::witness::Tried;
use crate::experiment::Record;
use crate::identify::fit::prediction_error::{Candidate, Clock, Estimator, Parameter};
use crate::identify::{Delay, Estimate, Term};
use crate::numeric::Interval;

/// Room about the estimate, in shares of the command.
const ROOMS: [f64; 2] = [0.03, 0.2];

/// Whether a fit has the terms of the model beside its drag, and no others.
fn alike(candidate: &Candidate, settings: &BoundedModel) -> bool {
    let terms = [(Term::Lag, settings.lag), (Term::Stiffness, settings.stiffness), (Term::CubicDrag, settings.cubic)];
    candidate.clock == Clock::Stamps
        && terms.iter().all(|(term, used)| candidate.terms.contains(term) == *used)
        && candidate.terms.iter().all(|term| *term == Term::Delay || terms.iter().any(|(own, _)| own == term))
}

/// The fit of the records' first one; each record's disturbance is its own fit's.
pub(super) fn estimated(records: &[&Record], settings: &BoundedModel) -> Option<Vec<(Quantity, f64)>> {
    let delay = match settings.delay {
        DelayBound::KnownS(delay_s) => Delay::KnownS(delay_s),
        DelayBound::WithinS(_) | DelayBound::Unknown => Delay::Estimated,
    };
    let estimator = Estimator::new(delay).with_law(settings.law);
    let mut quantities = Vec::new();
    for (number, record) in records.iter().enumerate() {
        let answer = estimator.record(record).ok()?;
        let fit = answer.candidates.iter().find(|candidate| alike(candidate, settings));
        let value = |parameter: Parameter| fit.map(|fit| fit.values[parameter as usize]);
        let reported = &answer.reported;
        let or = |parameter, other: f64| value(parameter).unwrap_or(other);
        let late = |estimate: Option<Estimate>| estimate.map_or(0.0, |estimate| estimate.value);
        if number == 0 {
            quantities.extend([
                (Quantity::Alpha, or(Parameter::Alpha, reported.alpha.value)),
                (Quantity::Beta, or(Parameter::LinearDrag, reported.beta.value)),
                (Quantity::BetaQuadratic, or(Parameter::QuadraticDrag, reported.beta_quadratic.value)),
                (Quantity::BetaCubic, or(Parameter::CubicDrag, late(reported.beta_cubic))),
                (Quantity::Stiffness, or(Parameter::Stiffness, late(reported.stiffness))),
                (Quantity::LagS, or(Parameter::LagS, late(reported.lag_s))),
                (Quantity::DelayS, or(Parameter::DelayS, reported.delay_s.value)),
            ]);
        }
        let delta = reported.deltas.first().map_or(0.0, |delta| delta.value);
        quantities.push((Quantity::Delta(number), or(Parameter::Disturbance, delta)));
    }
    Some(quantities)
}

impl Search<'_> {
    /// A box about estimates, with room for what a share of the command is worth; what is outside of the search box is moved to its side.
    fn about_estimates(&self, estimates: &[(Quantity, f64)], share: f64) -> Option<Vec<Interval>> {
        let (setup, layout) = (self.setup, &self.setup.layout);
        let of = |quantity| estimates.iter().find(|(own, _)| *own == quantity).map_or(0.0, |(_, value)| *value);
        let force = setup.records.iter().map(|readings| readings.command.largest()).fold(0.0, f64::max);
        let gain = 1.0 / of(Quantity::Alpha);
        let (acceleration, speed) = (force * gain, setup.typical_speed);
        let mut places: Vec<(usize, f64, f64)> = Vec::new();
        for (place, term) in layout.terms().iter().enumerate() {
            let (value, unit) = match term {
                Drag::Gain => (gain, gain),
                Drag::Linear => {
                    let linear = of(Quantity::Beta) + 2.0 * setup.middle_speed * of(Quantity::BetaQuadratic);
                    (linear * gain, acceleration / speed)
                }
                Drag::Quadratic => (of(Quantity::BetaQuadratic) * gain, acceleration / (speed * speed)),
                Drag::Cubic => (of(Quantity::BetaCubic) * gain, acceleration / (speed * speed * speed)),
                Drag::Stiffness => (of(Quantity::Stiffness) * gain, acceleration / setup.reach),
                Drag::LagRate => {
                    let rate = 1.0 / of(Quantity::LagS).max(1e-3 * setup.swing_s);
                    (rate, rate)
                }
                Drag::Disturbance => continue,
            };
            places.push((place, value, unit));
        }
        places.extend(layout.delay().map(|place| (place, of(Quantity::DelayS), 0.2 * setup.swing_s)));
        let deltas = (0..layout.records())
            .map(|record| (layout.disturbance(record), of(Quantity::Delta(record)) * gain, acceleration));
        places.extend(deltas);
        let mut at = setup.search.clone();
        for (place, value, unit) in places {
            let side = setup.search[place];
            let near = Interval::point(value.clamp(side.lower(), side.upper()));
            at[place] = (near + Interval::symmetric((share * unit).abs())).intersection(side)?;
        }
        Some(at)
    }

    /// A parameter with a small largest misfit about estimates.
    pub(super) fn nearest_to(&mut self, estimates: &[(Quantity, f64)]) -> Option<Tried> {
        let mut best: Option<Tried> = None;
        for share in ROOMS {
            let Some(mut at) = self.about_estimates(estimates, share) else { continue };
            if self.weigh(&mut at).is_err() {
                continue;
            }
            if let Some(tried) = self.nearest(&at, &self.setup.search)
                && best.as_ref().is_none_or(|best| tried.misfit < best.misfit)
            {
                best = Some(tried);
            }
            if best.as_ref().is_some_and(|best| best.misfit <= 1.0) {
                break;
            }
        }
        best
    }
}
