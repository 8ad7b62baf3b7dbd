//! Guaranteed bounds: every reading is a constraint on the motion, and the set of parameters that satisfy all constraints is enclosed.
//!
//! Bounded-error identification by set inversion (Jaulin, Kieffer, Didrit and Walter, *Applied Interval Analysis*, 2001; Milanese et al.,
//! *Bounding Approaches to System Identification*, 1996): no distribution of errors is assumed, and an empty set proves that the record
//! contradicts the model.
//!
//! * Over a wide box the weak form of the equation, with modulating functions, gives inequalities linear in the parameters.
//! * Over a narrower box validated Taylor steps enclose the motion and its sensitivities; multiple shooting makes each reading two linear
//!   inequalities with interval coefficients.
//! * A linear programme proposes multipliers; the bound is their value in intervals. Boxes are contracted and divided.
//! * A feasible point is accepted only by its enclosed motion.

mod a_priori_enclosure;
mod answer;
mod branch_and_prune;
mod contraction;
mod feasible_point;
mod flow;
mod linear_relaxation;
mod modulating_functions;
mod problem;
mod q_relaxed;
mod record;
mod refinement;
mod report;
mod sensitivities;
mod sensitivity_error;
mod settings;
#[cfg(test)]
mod simulated;
mod solve;
pub(crate) mod soundness;
mod taylor_series;
mod taylor_step;
mod unknowns;
mod vector_field;
mod velocity_bounds;

internal! {
    mod certificate;
    mod linear_program;
    mod work;
}

#[cfg(test)]
mod tests;

pub use answer::{Bounds, Consistency, Contradicting, Outlier, ParameterValues, Quantity, QuantityRange};
pub use settings::{BoundedModel, DelayBound, SwitchedWhen};

use super::IdentifyError;
use crate::experiment::Record;
use certificate::{Certificate, Unproved};
use feasible_point::estimate::estimated;
use problem::Problem;
use record::Readings;
use solve::solve;

/// Encloses the parameters with which the model satisfies every reading of all records, or proves that the search box has none.
///
/// Inertia, drags, delay, lag and stiffness are common to all records, the disturbance and the initial state each record's own. A
/// record is used from the sample after which every command that acts is in it.
///
/// ```
/// use selfosc::experiment::{Sensor, SimulatedExperiment};
/// use selfosc::identify::DragLaw;
/// use selfosc::identify::bounded::{DelayBound, Quantity, BoundedModel, Consistency, enclose};
/// use selfosc::{nonlinearity::RelayHysteresis, plant::DragAxis};
/// let axis = DragAxis::linear(1.0, 0.5)?;
/// let sensor = Sensor { quantum: 0.02, ..Sensor::default() };
/// let record = SimulatedExperiment::new(axis, RelayHysteresis::new(1.0, 0.3, 0.0)?, 10.0)?.held().with_sensor(sensor)?.run(20.0)?;
/// let found = enclose(&[&record], &BoundedModel::new(DragLaw::Linear, DelayBound::KnownS(0.0)))?;
/// assert_eq!(found.verdict, Consistency::Consistent);
/// assert!(found.of(Quantity::Alpha).is_some_and(|[low, high]| low <= 1.0 && 1.0 <= high));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Errors
/// [`IdentifyError::OutOfDomain`] for settings out of their domain, a record without a switching, and a sensor without an error.
pub fn enclose(records: &[&Record], settings: &BoundedModel) -> Result<Bounds, IdentifyError> {
    if settings.outliers > 0 {
        return q_relaxed::enclose(&Readings::of(records, settings)?, settings);
    }
    let problem = Problem::new(records, settings)?;
    Ok(solve(&problem, settings, || estimated(records, settings))?.bounds)
}

/// [`enclose`] with a certificate, which is checked without a search.
///
/// # Errors
/// As [`enclose`]; and, within, [`certificate::Unproved::NotFound`] where a proof takes too many steps.
#[doc(hidden)]
pub fn enclose_with_certificate(
    records: &[&Record],
    settings: &BoundedModel,
) -> Result<(Bounds, Result<Certificate, Unproved>), IdentifyError> {
    if settings.outliers > 0 {
        return Ok((enclose(records, settings)?, Err(Unproved::Outliers { allowed: settings.outliers })));
    }
    let problem = Problem::new(records, settings)?;
    let solved = solve(&problem, settings, || estimated(records, settings))?;
    let certificate = Certificate::prove(records, &problem, settings, &solved);
    Ok((solved.bounds, certificate?))
}
