//! Maximum likelihood on whole records: linear, quadratic or mixed drag, disturbance, initial state, perhaps the delay.
//!
//! Between changes of the command the motion is in closed form, and dual numbers carry its derivatives. The record is cut
//! into stretches whose beginnings are unknowns too until they fit together, so that a poor start does no harm; the
//! equations are solved along this chain at a cost that grows with the samples only. Where the command changed at an
//! unknown instant between two samples, the instant is estimated with the rest.

mod chain;
mod input;
mod motion;
mod noise;
mod result;
mod search;
mod spread;
mod start;

pub use input::Between;
pub use result::{FittedRecord, RecordFit};

use super::joint::Delay;
use super::{DragLaw, IdentifyError};
use crate::experiment::Record;
use search::Search;

/// What to fit, and what is known.
///
/// ```
/// use selfosc::experiment::{Experiment, Sensor};
/// use selfosc::identify::fit::Fit;
/// use selfosc::identify::joint::{Delay, Parameter};
/// use selfosc::identify::DragLaw;
/// use selfosc::{nonlinearity::RelayHysteresis, plant::DragAxis};
/// let axis = DragAxis::quadratic(1.0, 0.5)?.with_delay_s(0.1)?;
/// let sensor = Sensor { quantum: 0.02, ..Sensor::default() };
/// let record = Experiment::new(axis, RelayHysteresis::new(1.0, 0.3, 0.0)?, 10.0)?.held().with_sensor(sensor)?.run(60.0)?;
/// let fit = Fit::new(DragLaw::Quadratic, Delay::KnownS(0.1)).records(&[&record])?;
/// let alpha = fit.estimate(Parameter::Alpha);
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
    /// A drag law, and what is known of the delay.
    #[must_use]
    pub fn new(law: DragLaw, delay: Delay) -> Self {
        Self { law, delay, between: None, quantum: None }
    }

    /// What the command does between samples; else a switched command is tried both ways and the likelier one taken, and any
    /// other command passes evenly from sample to sample.
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
    /// [`IdentifyError::Feature`] for an output that never moves, and for a delay or step that is none; [`IdentifyError::TooFewEquations`],
    /// [`IdentifyError::Confounded`], [`IdentifyError::NotSettled`].
    pub fn records(&self, records: &[&Record]) -> Result<RecordFit, IdentifyError> {
        let feature = |feature, value: f64| {
            if value >= 0.0 && value.is_finite() {
                return Ok(());
            }
            Err(IdentifyError::Feature { feature, value, required: "a finite number, 0 or more" })
        };
        for record in records {
            let output = record.output();
            if output.iter().all(|value| *value == output[0]) {
                return Err(IdentifyError::Feature { feature: "range of the output", value: 0.0, required: "above 0" });
            }
        }
        if let Delay::KnownS(delay_s) = self.delay {
            feature("delay in seconds", delay_s)?;
        }
        if let Some(quantum) = self.quantum {
            feature("step of the sensor", quantum)?;
        }
        let betweens: &[Between] = match self.between {
            Some(Between::AtSamples) => &[Between::AtSamples],
            Some(Between::Anywhere) => &[Between::Anywhere],
            Some(Between::Evenly) => &[Between::Evenly],
            None if records.iter().all(|record| input::switched(record)) => &[Between::AtSamples, Between::Anywhere],
            None => &[Between::Evenly],
        };
        let mut best: Option<Search<'_>> = None;
        let mut failure = IdentifyError::TooFewEquations { equations: 0, parameters: motion::UNKNOWNS };
        for &between in betweens {
            match Search::new(records, self.law, self.delay, between, self.quantum).and_then(Search::approach) {
                Ok(search) if best.as_ref().is_none_or(|best| search.evidence() > best.evidence()) => {
                    best = Some(search);
                }
                Ok(_) => {}
                Err(error) => failure = error,
            }
        }
        best.ok_or(failure)?.settle()?.finish()
    }
}
