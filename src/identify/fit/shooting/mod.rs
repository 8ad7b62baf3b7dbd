//! Maximum likelihood on whole records: linear, quadratic or mixed drag, disturbance, initial state, perhaps the delay.
//!
//! Multiple shooting: the record is cut into shooting intervals whose initial states are unknowns too until they
//! are continuous, so that a poor start does no harm. Between changes of the command the motion is in closed form, and dual
//! numbers carry its derivatives. Steps are those of the generalised Gauss-Newton method, condensed from shooting interval to shooting interval at
//! a cost that grows with the samples only. Where the command changed at an unknown instant between two samples, the instant
//! is estimated with the rest, and integrated out by Laplace's approximation where likelihoods are compared.

mod beginning;
mod condensing;
mod covariance;
mod gauss_newton;
mod input;
mod noise;
mod record_fit;
mod sensitivity;

pub use input::Between;
pub use record_fit::{FittedRecord, RecordFit};

use crate::numeric::{Limit, domain};
use rayon::prelude::*;

use crate::experiment::Record;
use crate::identify::answer::{Delay, DragLaw, IdentifyError};
use crate::identify::signal::is_switched;
use gauss_newton::{GaussNewton, StartingPoint};

/// The fit of a drag law.
///
/// ```
/// use selfosc::experiment::{SimulatedExperiment, Sensor};
/// use selfosc::identify::fit::Fit;
/// use selfosc::identify::answer::AxisParameter;
/// use selfosc::identify::{Delay, DragLaw};
/// use selfosc::{nonlinearity::RelayHysteresis, plant::DragAxis};
/// let axis = DragAxis::quadratic(1.0, 0.5)?.with_delay_s(0.1)?;
/// let sensor = Sensor { quantum: 0.02, ..Sensor::default() };
/// let record = SimulatedExperiment::new(axis, RelayHysteresis::new(1.0, 0.3, 0.0)?, 10.0)?.held().with_sensor(sensor)?.run(60.0)?;
/// let fit = Fit::new(DragLaw::Quadratic, Delay::KnownS(0.1)).records(&[&record])?;
/// let alpha = fit.estimate(AxisParameter::Alpha);
/// assert!((alpha.value - 1.0).abs() < 0.03);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    law: DragLaw,
    delay: Delay,
    between: Option<Between>,
    quantum: Option<f64>,
}

impl Fit {
    /// A drag law, and the delay, given or to be estimated.
    #[must_use]
    pub fn new(law: DragLaw, delay: Delay) -> Self {
        Self { law, delay, between: None, quantum: None }
    }

    /// The command's course between samples. By default a switched command is taken to change at samples or anywhere between them,
    /// a continuous command to be held, linear or curved from sample to sample, whichever is likeliest.
    #[must_use]
    pub fn with_between(self, between: Between) -> Self {
        Self { between: Some(between), ..self }
    }

    /// The sensor's step, zero for none; else it is read off the record.
    #[must_use]
    pub fn with_quantum(self, quantum: f64) -> Self {
        Self { quantum: Some(quantum), ..self }
    }

    /// Fits all records at once: inertia, drag and delay are common, the disturbance and the initial state each record's own.
    ///
    /// The intervals take the model for true and the noise for independent from sample to sample; the residuals'
    /// [autocorrelation](FittedRecord::autocorrelation) says whether it is.
    ///
    /// # Errors
    /// [`IdentifyError::OutOfDomain`] for an output that never moves, and for a delay or step that is none; [`IdentifyError::TooFewEquations`],
    /// [`IdentifyError::Confounded`], [`IdentifyError::NotSettled`].
    pub fn records(&self, records: &[&Record]) -> Result<RecordFit, IdentifyError> {
        self.records_from(records, &[])
    }

    /// As [`records`](Self::records), where fits to the same records are there already: under another law, or with another
    /// delay. The search starts from them too, and the likeliest end is taken, so that a law is never less likely than a law
    /// that it contains.
    ///
    /// # Errors
    /// As [`records`](Self::records).
    pub fn records_from(&self, records: &[&Record], fits: &[&RecordFit]) -> Result<RecordFit, IdentifyError> {
        self.check(records)?;
        let ways: &[Between] = match self.between {
            Some(ref given) => core::slice::from_ref(given),
            None if records.iter().all(|record| is_switched(record.input())) => {
                &[Between::AtSamples, Between::Anywhere]
            }
            None => &[Between::AtSamples, Between::Evenly, Between::Bent],
        };
        let search = |law, between| GaussNewton::new(records, law, self.delay, between, self.quantum);
        let given = fits.iter().map(|fit| fit.place()).filter(|start| ways.contains(&start.between));
        let ends = self.ends(records, ways, given.collect());
        let best = likeliest(ends, GaussNewton::evidence).and_then(|best| best.settle()?.finish());
        // With every sample, another start may prove better.
        let reached = best.as_ref().map_or(f64::INFINITY, RecordFit::log_likelihood);
        let missed = fits.iter().filter(|fit| fit.log_likelihood() > reached);
        let again = missed.map(|fit| search(self.law, fit.between())?.starting_at(&fit.place()).refine()?.finish());
        let best = likeliest(core::iter::once(best).chain(again), RecordFit::log_likelihood)?;
        let other = match best.between() {
            Between::Evenly => Between::Bent,
            Between::Bent => Between::Evenly,
            Between::AtSamples | Between::Anywhere => return Ok(best),
        };
        if !ways.contains(&other) {
            return Ok(best);
        }
        let other = search(self.law, other)?.starting_at(&best.place()).refine()?.finish()?;
        Ok(if other.log_likelihood() > best.log_likelihood() { other.widened(&best) } else { best.widened(&other) })
    }

    /// Ends of the searches from new starts with each treatment of the input, and from the given starts.
    fn ends<'a>(&self, records: &[&'a Record], ways: &[Between], given: Vec<StartingPoint>) -> Vec<Ended<'a>> {
        let short = beginning::of(records);
        let Some(short) = short.as_ref().map(|short| short.iter().collect::<Vec<_>>()) else {
            return self.approach(records, ways, &self.simpler(records, ways, given));
        };
        let given = self.simpler(&short, ways, given);
        let places = beginning::places(&self.approach(&short, ways, &given));
        let ends = self.approach(records, &[], &places);
        if ends.iter().any(Result::is_ok) { ends } else { self.approach(records, ways, &given) }
    }

    /// What is given; for mixed drag without it, where simpler drag ends.
    fn simpler(&self, records: &[&Record], ways: &[Between], given: Vec<StartingPoint>) -> Vec<StartingPoint> {
        if self.law != DragLaw::Mixed || !given.is_empty() {
            return given;
        }
        let simple = [DragLaw::Linear, DragLaw::Quadratic].into_par_iter();
        let ends = simple.flat_map(|law| Self { law, ..*self }.approach(records, ways, &[]));
        ends.flatten().map(|search| search.place()).collect()
    }

    /// A search for each treatment and from each start, in parallel.
    fn approach<'a>(&self, records: &[&'a Record], ways: &[Between], starts: &[StartingPoint]) -> Vec<Ended<'a>> {
        let search = |between| GaussNewton::new(records, self.law, self.delay, between, self.quantum);
        let own = ways.par_iter().map(|way| search(*way)?.approach());
        let given = starts.par_iter().map(|start| search(start.between)?.starting_at(start).approach());
        own.chain(given).collect()
    }

    fn check(&self, records: &[&Record]) -> Result<(), IdentifyError> {
        for record in records {
            let output = record.output();
            if output.iter().all(|value| *value == output[0]) {
                let remedy = "choose the column that holds the measurement";
                domain::require("range of the output", 0.0, "output units", Limit::Positive, remedy)?;
            }
        }
        if let Delay::KnownS(delay_s) = self.delay {
            domain::non_negative("delay", delay_s, "s")?;
        }
        if let Some(quantum) = self.quantum {
            domain::non_negative("step of the sensor", quantum, "output units")?;
        }
        Ok(())
    }
}

/// A search at its end, or why it came to none.
type Ended<'a> = Result<GaussNewton<'a>, IdentifyError>;

/// The likeliest of those that succeeded; the first failure where none did.
fn likeliest<T>(
    ends: impl IntoIterator<Item = Result<T, IdentifyError>>,
    log_likelihood: impl Fn(&T) -> f64,
) -> Result<T, IdentifyError> {
    let none = Err(IdentifyError::TooFewEquations { equations: 0, parameters: sensitivity::UNKNOWNS });
    ends.into_iter()
        .reduce(|best, next| match (best, next) {
            (Ok(best), Ok(next)) => Ok(if log_likelihood(&next) > log_likelihood(&best) { next } else { best }),
            (Err(_), Ok(next)) => Ok(next),
            (best, Err(_)) => best,
        })
        .unwrap_or(none)
}
