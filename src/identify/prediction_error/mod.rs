//! Prediction-error estimation: an extended Kalman filter predicts each reading from those before it, and the parameters
//! are those that make its innovations likeliest, of the motion and of what disturbs it together.

mod actuator;
mod average;
mod filter;
mod model;
mod motion;
mod observations;
mod scoring;
mod search;
mod start;
mod term;

pub use model::{Clock, Parameter, Switching};
pub use term::Term;

use super::joint::{Delay, Estimate};
use super::{DragLaw, IdentifyError};
use crate::experiment::Record;
use average::{Average, CHOSEN};
use search::{Known, Search};

/// What to estimate, and what is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimator {
    delay: Delay,
    law: Option<DragLaw>,
}

/// Answer
#[derive(Clone, Debug)]
pub struct Answer {
    /// Estimates
    pub estimates: Vec<(Parameter, Option<Estimate>)>,
    /// Terms
    pub terms: Vec<Term>,
    /// Dump
    pub dump: String,
    /// weights sum
    pub count: f64,
}

impl Estimator {
    /// a
    #[must_use]
    pub fn new(delay: Delay) -> Self {
        Self { delay, law: None }
    }

    /// a
    /// # Errors
    /// a
    pub fn record(&self, record: &Record) -> Result<Answer, IdentifyError> {
        let delay_s = match self.delay {
            Delay::KnownS(delay_s) => Some(delay_s),
            Delay::Estimated => None,
        };
        let (search, found) =
            Search::new(record, Known { delay_s, law: self.law }).run().ok_or(IdentifyError::NotSettled { steps: 0, rms: f64::NAN })?;
        let best = &found.tried[found.best];
        let average = Average::new(&found, |fitted| {
            scoring::movable(&fitted.model, &fitted.score, search.observations(&fitted.model))
        });
        let terms: Vec<Term> = Term::ALL.into_iter().filter(|term| term.is_in(&best.model)).collect();
        let factor = if terms.is_empty() { 1.0 } else { CHOSEN };
        let count = search.observations(&best.model).count();
        let freedom = best.model.freedom() as f64;
        let factor = factor * (count / (count - freedom).max(1.0)).sqrt();
        let estimates = Parameter::ALL.into_iter().map(|p| (p, average.estimate(p, factor))).collect();
        let mut dump = String::new();
        for f in &found.tried {
            let t: Vec<_> = Term::ALL.into_iter().filter(|term| term.is_in(&f.model)).map(Term::name).collect();
            dump += &format!(
                "{:9.3} {:?} {:?} L{} Q{} it {} settled {} alpha {:.5} delay {:.4} noise {:?} {}\n",
                f.log_likelihood, f.model.switching, f.model.clock, f.model.is_free(Parameter::LinearDrag), f.model.is_free(Parameter::QuadraticDrag),
                f.iterations, f.settled, f.model.values[0], f.model.values[6], f.model.noise.iter().map(|x|(x*10.0).round()/10.0).collect::<Vec<_>>(), t.join(",")
            );
        }
        Ok(Answer { estimates, terms, dump, count })
    }
}
