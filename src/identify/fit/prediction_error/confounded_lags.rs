//! Confounded lags: a delay, a lag, a limited rate, a pause of the thrust and a filter of the sensor shift the phase alike, and the first of them that joins
//! need not be the one at work. Hence models with each single lag and each pair share the total lag found.

use super::model::{Parameter, VehicleModel};
use super::observations::Observations;
use crate::identify::answer::Term;

/// The lag parameters apart from the delay, with the mean lag per unit of each.
const LATE: [(Term, Parameter, f64); 4] = [
    (Term::Lag, Parameter::LagS, 1.0),
    (Term::RateLimit, Parameter::RampS, 0.5),
    (Term::ReversalPause, Parameter::PauseS, 0.5),
    (Term::SensorFilter, Parameter::FilterS, 1.0),
];

/// Total lag in addition to the delay, in s.
fn total_lag_s(model: &VehicleModel) -> f64 {
    LATE.iter().map(|(_, parameter, mean)| mean * model.value(*parameter)).sum()
}

/// The terms that lag: a rate is limited only where the command is switched, a pause is only where it changes its sign.
pub(super) fn terms(observations: &Observations) -> Vec<Term> {
    let mut terms = vec![Term::Lag, Term::SensorFilter];
    terms.extend(observations.switched.then_some(Term::RateLimit));
    terms.extend(observations.reverses().then_some(Term::ReversalPause));
    terms
}

/// Whether the model has a confounded lag.
pub(super) fn is_in(model: &VehicleModel) -> bool {
    LATE.iter().any(|(term, ..)| term.is_in(model))
}

/// Number of lags that a model has beyond the delay given, and the number that it could have.
pub(super) fn ways(model: &VehicleModel, known_delay_s: Option<f64>) -> (usize, usize) {
    let given = known_delay_s.is_some();
    let had = LATE.iter().filter(|(term, ..)| term.is_in(model)).count();
    (had + usize::from(given && Term::Delay.is_in(model)), LATE.len() + usize::from(given))
}

/// The models that share the total lag among each single lag and each pair of confounded lags; none for a model without a lag, or with
/// the delay given.
pub(super) fn chains(
    model: &VehicleModel,
    known_delay_s: Option<f64>,
    observations: &Observations,
) -> Vec<VehicleModel> {
    let delay_s = model.value(Parameter::DelayS);
    let beyond_s = total_lag_s(model) + known_delay_s.map_or(0.0, |known| delay_s - known);
    if !is_in(model) && (known_delay_s.is_none() || !Term::Delay.is_in(model)) {
        return Vec::new();
    }
    let mut without = model.clone();
    for (_, parameter, _) in LATE {
        without.set(parameter, 0.0, false);
    }
    if let Some(known) = known_delay_s {
        without.set(Parameter::DelayS, known, false);
    }
    let mut terms = terms(observations);
    terms.extend(known_delay_s.map(|_| Term::Delay));
    let with = |parts: &[Term]| {
        let share_s = beyond_s.max(0.0) / parts.len() as f64;
        let mut model = without.clone();
        for part in parts {
            match LATE.iter().find(|(term, ..)| term == part) {
                Some((_, parameter, mean)) => model.set(*parameter, share_s / mean, true),
                None => model.set(Parameter::DelayS, known_delay_s.unwrap_or(0.0) + share_s, true),
            }
        }
        model
    };
    // A pause is not modelled behind a lag or a limited rate.
    let apart = |pair: &Vec<Term>| {
        let behind = pair.contains(&Term::Lag) || pair.contains(&Term::RateLimit);
        !(behind && pair.contains(&Term::ReversalPause))
    };
    let pairs = terms.iter().enumerate().flat_map(|(index, a)| terms[..index].iter().map(move |b| vec![*b, *a]));
    terms.iter().map(|term| vec![*term]).chain(pairs.filter(apart)).map(|parts| with(&parts)).collect()
}
