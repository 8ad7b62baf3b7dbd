//! Guaranteed bounds: every reading a constraint on the motion, and the set of parameters that meet them all enclosed.
//!
//! A compass that shows whole degrees does not add noise: it says that the heading was within half a degree of the reading. This
//! is bounded-error identification by set inversion (Jaulin, Kieffer, Didrit, Walter, *Applied Interval Analysis*, 2001; Milanese et
//! al., *Bounding Approaches to System Identification*, 1996): no distribution of errors is assumed, and an empty set is a proof that the record contradicts
//! the model. Everything that a statement rests on is computed in intervals:
//!
//! * over a wide box, the equation of motion weighed with hats gives inequalities that are linear in the parameters;
//! * over a narrower one, validated Taylor steps enclose the motion and its slopes about a point, and each reading is two
//!   linear inequalities with interval coefficients, window after window with the windows' states as unknowns;
//! * a linear programme proposes multipliers, and the bound is what these give in intervals (Neumaier and Shcherbina,
//!   *Mathematical Programming* 99, 2004; Jansson, *SIAM Journal on Optimization* 14, 2004); a box that does not shrink is divided;
//! * the witness's motion is enclosed and meets every reading.

mod bend;
mod bounds;
mod command;
mod contract;
mod divide;
mod effort;
mod estimate;
mod explore;
mod field;
mod frame;
mod hat;
mod impulse;
mod lp;
mod mix;
mod monotone;
mod onset;
mod outliers;
mod problem;
mod report;
mod rows;
mod search;
mod series;
mod settings;
mod setup;
#[cfg(test)]
mod simulated;
mod slanted;
pub(crate) mod soundness;
mod speeds;
mod step;
mod surface;
mod trajectory;
mod weak;
mod witness;

internal! { mod certificate; }

#[cfg(test)]
mod tests;

pub use bounds::{Bounds, Consistency, Contradicting, Outlier, Parameters, Quantity, QuantityRange};
pub use settings::{BoundedModel, DelayBound, SwitchedWhen};

use super::IdentifyError;
use crate::experiment::Record;
use certificate::{Certificate, Unproved, Witness};
use estimate::estimated;
use explore::explore;
use problem::Readings;
use setup::Setup;

/// Encloses the parameters with which the model meets every reading of all records, or proves that there are none in the search box.
///
/// Inertia, drags, delay, lag and stiffness are common to all records, the disturbance and the initial state each record's own. A
/// record is taken from where every command that acts is in it.
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
/// [`IdentifyError::OutOfDomain`] for settings that are none, a record without a switching, and a sensor without an error.
pub fn enclose(records: &[&Record], settings: &BoundedModel) -> Result<Bounds, IdentifyError> {
    if settings.outliers > 0 {
        return outliers::enclose(&Readings::of(records, settings)?, settings);
    }
    let setup = Setup::new(records, settings)?;
    Ok(explore(&setup, settings, || estimated(records, settings), |_, _| ())?.bounds)
}

/// The same with the proof in a form that is checked without a search.
///
/// # Errors
/// Those of [`enclose`]; and, within, [`certificate::Unproved::NotFound`] where a proof takes too many steps.
#[doc(hidden)]
pub fn enclose_with_certificate(
    records: &[&Record],
    settings: &BoundedModel,
) -> Result<(Bounds, Result<Certificate, Unproved>), IdentifyError> {
    if settings.outliers > 0 {
        return Ok((enclose(records, settings)?, Err(Unproved::Outliers { allowed: settings.outliers })));
    }
    let setup = Setup::new(records, settings)?;
    let mut witness = None;
    let estimates = || estimated(records, settings);
    let explored = explore(&setup, settings, estimates, |search, found| {
        witness = found.map(|tried| Witness::of(search, &tried.at));
    })?;
    let certificate = Certificate::prove(records, &setup, settings, &explored, witness);
    Ok((explored.bounds, certificate?))
}
