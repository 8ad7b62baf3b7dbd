//! Confounded lags: a delay, a lag, a limited rate, a pause of the thrust and a filter of the sensor shift the phase alike. The first of
//! them that joins need not be the one at work: models with each single lag and each pair share the total lag found.

use super::model::{Parameter, VehicleModel};
use super::observations::Observations;
use crate::identify::answer::Term;

/// The confounded lags apart from the delay; each has one parameter.
const LATE: [Term; 4] = [Term::Lag, Term::SensorFilter, Term::RateLimit, Term::ReversalPause];

/// Those that a record can show.
pub(super) fn terms(observations: &Observations) -> Vec<Term> {
    LATE.into_iter().filter(|term| term.is_shown(observations)).collect()
}

/// Whether the model has a confounded lag.
pub(super) fn is_in(model: &VehicleModel) -> bool {
    LATE.iter().any(|term| term.is_in(model))
}

/// Number of lags that a model has beyond the delay given, and the number that it could have.
pub(super) fn ways(model: &VehicleModel, known_delay_s: Option<f64>) -> (usize, usize) {
    let given = known_delay_s.is_some();
    let had = LATE.iter().filter(|term| term.is_in(model)).count();
    (had + usize::from(given && Term::Delay.is_in(model)), LATE.len() + usize::from(given))
}

/// The models that share the total lag among each single lag and each pair of confounded lags; none for a model without a lag, or with
/// the delay given.
pub(super) fn chains(
    model: &VehicleModel,
    known_delay_s: Option<f64>,
    observations: &Observations,
) -> Vec<VehicleModel> {
    if !is_in(model) && (known_delay_s.is_none() || !Term::Delay.is_in(model)) {
        return Vec::new();
    }
    let mut without = model.clone();
    let mut beyond_s = 0.0;
    for term in LATE {
        beyond_s += model.mean_lag_s(term.parameters());
        term.parameters().iter().for_each(|parameter| without.set(*parameter, 0.0, false));
    }
    let mut terms = terms(observations);
    if let Some(known) = known_delay_s {
        beyond_s += model.value(Parameter::DelayS) - known;
        without.set(Parameter::DelayS, known, false);
        terms.push(Term::Delay);
    }
    let with = |parts: &[Term]| {
        let share_s = beyond_s.max(0.0) / parts.len() as f64;
        let mut model = without.clone();
        for parameter in parts.iter().flat_map(|part| part.parameters()) {
            model.set(*parameter, without.value(*parameter) + share_s / parameter.mean_lag(), true);
        }
        model
    };
    let pairs = terms.iter().enumerate().flat_map(|(index, a)| terms[..index].iter().map(move |b| vec![*b, *a]));
    let pairs = pairs.filter(|pair| !pair[0].excludes(pair[1]));
    terms.iter().map(|term| vec![*term]).chain(pairs).map(|parts| with(&parts)).collect()
}
