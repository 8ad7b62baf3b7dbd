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
mod estimate;
mod field;
mod frame;
mod hat;
mod impulse;
mod lp;
mod mix;
mod monotone;
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
use crate::numeric::Interval;
use certificate::{Certificate, Unproved, Witness};
use divide::Division;
use estimate::estimated;
use problem::Readings;
use report::Answer;
use search::Search;
use setup::{SEARCHED, Setup};
use witness::Tried;

/// Divisions after which a witness is looked for again.
const DIVISIONS_PER_TRIAL: usize = 8;

/// Bounds that are this good, the inner against the outer width, are not sharpened further.
const GOOD: f64 = 0.98;

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
    let certificate = Certificate::prove(&setup, settings, &explored.hulls, witness, explored.bounds.passes);
    Ok((explored.bounds, certificate?))
}

/// What a search gave.
struct Explored {
    bounds: Bounds,
    /// The box around what was left, and that around what more readings left of it; none for nothing.
    hulls: Vec<Option<Vec<Interval>>>,
    /// The parameters that are left; `None` where nothing is.
    left: Option<Vec<Interval>>,
}

/// The search; where it finds no witness one is looked for about the `estimates`, and `witness` is told of one that was found.
fn explore(
    setup: &Setup,
    settings: &BoundedModel,
    estimates: impl FnOnce() -> Option<Vec<(Quantity, f64)>>,
    witness: impl FnOnce(&Search<'_>, Option<&Tried>),
) -> Result<Explored, IdentifyError> {
    let mut spent = 0;
    let mut boxes: Vec<Vec<Interval>> = Vec::new();
    if let Some(beginnings) = setup.beginnings(settings, SEARCHED) {
        let mut search = Search::new(&beginnings);
        // Passes over part of the records cost so much less.
        let budget = settings.budget * setup.samples() / beginnings.samples();
        let division = search.search(beginnings.search.clone(), budget);
        spent = search.passes * beginnings.samples() / setup.samples();
        boxes = division.kept.iter().map(|kept| setup.begun(&beginnings, &kept.at)).collect();
    }
    let mut search = Search::new(setup).after(spent);
    let division = if boxes.is_empty() {
        // Where nothing is left of the beginnings, whole records show by how much they contradict the model.
        search.search(setup.search.clone(), settings.budget)
    } else {
        search.follow_further(boxes, &setup.reaches(SEARCHED.swings), settings.budget)
    };
    let passes = search.passes;
    // A delay that is known better leaves more readings.
    if let (Some(hull), true) = (division.hull(), setup.layout.delay().is_some() && division.followed) {
        let narrowed = setup.narrowed(settings, &hull)?;
        let mut search = Search::new(&narrowed).after(passes);
        let division = search.search(narrowed.search.clone(), settings.budget);
        let (bounds, last) = conclude(setup, search, division, settings, estimates, witness);
        let left = last.as_ref().map(|last| {
            let mut left = last[..narrowed.layout.parameters()].to_vec();
            if let (Some(place), None) = (setup.layout.delay(), narrowed.layout.delay()) {
                left.insert(place, narrowed.known_delay_s);
            }
            left
        });
        return Ok(Explored { bounds, hulls: vec![Some(hull), last], left });
    }
    let (bounds, hull) = conclude(setup, search, division, settings, estimates, witness);
    let left = hull.as_ref().map(|hull| hull[..setup.layout.parameters()].to_vec());
    Ok(Explored { bounds, hulls: vec![hull], left })
}

/// The answer, from what division left; `wide` is where the search began.
fn conclude(
    wide: &Setup,
    mut search: Search<'_>,
    mut division: Division,
    settings: &BoundedModel,
    estimates: impl FnOnce() -> Option<Vec<(Quantity, f64)>>,
    witness: impl FnOnce(&Search<'_>, Option<&Tried>),
) -> (Bounds, Option<Vec<Interval>>) {
    let mut answer = Answer::default();
    answer.try_nearest(&mut search, &division);
    if answer.witness().is_none() && !division.kept.is_empty() {
        answer.try_estimates(&mut search, estimates());
    }
    // Without a witness the parts may yet turn out empty.
    let mut divided = 0usize;
    while answer.witness().is_none()
        && search.passes < settings.budget
        && search.divide_coarsest(&mut division, settings.budget)
    {
        divided += 1;
        if divided.is_multiple_of(DIVISIONS_PER_TRIAL) {
            answer.try_nearest(&mut search, &division);
        }
    }
    if answer.witness().is_some() && search.passes < settings.budget {
        answer.sharpen(&mut search, &mut division, settings.budget, GOOD);
    }
    witness(&search, answer.witness());
    (answer.into_bounds(wide, search, &division), division.hull())
}
