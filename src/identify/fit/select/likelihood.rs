//! Model selection by likelihood, the drag law: every law fitted to the same records.

use rayon::prelude::*;

use crate::experiment::Record;
use crate::identify::answer::{Delay, DragLaw, IdentifyError};
use crate::identify::fit::shooting::{Fit, RecordFit};

/// Odds against every rival law from which a law counts as recognised: 95 %.
pub(crate) const DECIDED: f64 = 19.0;
/// Odds against the mixed law from which a simple law is chosen: the mixed law contains the simple
/// laws, so no record refutes it by more than the charge for its parameter.
pub(crate) const DECIDED_AGAINST_MIXED: f64 = 4.0;

/// The laws fitted, and which of them the records speak for.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(try_from = "UncheckedChoice")]
pub struct Choice {
    fits: Vec<RecordFit>,
    probabilities: Vec<f64>,
}

/// A choice as it is written, not yet checked.
#[derive(serde::Deserialize)]
struct UncheckedChoice {
    fits: Vec<RecordFit>,
    probabilities: Vec<f64>,
}

impl TryFrom<UncheckedChoice> for Choice {
    type Error = &'static str;

    fn try_from(UncheckedChoice { fits, probabilities }: UncheckedChoice) -> Result<Self, Self::Error> {
        if fits.is_empty() || fits.len() != probabilities.len() {
            return Err("a choice needs a fit or more, and a probability for each");
        }
        Ok(Self { fits, probabilities })
    }
}

/// Each of `laws` fitted to all records at once, in their order; simple laws in parallel, then the mixed law, which contains
/// them, from where they ended.
///
/// Each result is that of [`Fit::records`].
pub fn fit_each(laws: &[DragLaw], records: &[&Record], delay: Delay) -> Vec<Result<RecordFit, IdentifyError>> {
    let is_simple = |law: &DragLaw| *law != DragLaw::Mixed;
    let simple = laws.par_iter().map(|law| is_simple(law).then(|| Fit::new(*law, delay).records(records)));
    let simple: Vec<_> = simple.collect();
    let starts: Vec<RecordFit> = simple.iter().flatten().flatten().cloned().collect();
    let starts: Vec<&RecordFit> = starts.iter().collect();
    let mixed = |law: &DragLaw| Fit::new(*law, delay).records_from(records, &starts);
    laws.iter().zip(simple).map(|(law, result)| result.unwrap_or_else(|| mixed(law))).collect()
}

impl Choice {
    /// Fits linear, quadratic and mixed drag to all records at once, in parallel.
    ///
    /// A law's probability is its share of the sum of likelihoods, each charged `sqrt(n)` for every parameter (Schwarz's
    /// criterion; n samples). It compares these laws with each other: a fault common to all laws shows in the residuals.
    ///
    /// # Errors
    /// The first error where no law could be fitted.
    ///
    /// ```
    /// use selfosc::experiment::SimulatedExperiment;
    /// use selfosc::identify::{Delay, DragLaw};
    /// use selfosc::identify::fit::select::likelihood::Choice;
    /// use selfosc::{nonlinearity::RelayHysteresis, plant::DragAxis};
    /// let axis = DragAxis::quadratic(1.0, 0.5)?;
    /// let record = SimulatedExperiment::new(axis, RelayHysteresis::new(1.0, 0.3, 0.0)?, 10.0)?.held().run(60.0)?;
    /// let choice = Choice::among_all(&[&record], Delay::KnownS(0.0))?;
    /// assert_eq!(choice.decision(), Some(DragLaw::Quadratic));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn among_all(records: &[&Record], delay: Delay) -> Result<Self, IdentifyError> {
        Self::of(fit_each(&DragLaw::ALL, records, delay), records.iter().map(|record| record.samples()).sum())
    }

    /// From fits to the same `samples` samples; those that failed take no part.
    ///
    /// # Errors
    /// The first error where none succeeded.
    pub fn of(results: Vec<Result<RecordFit, IdentifyError>>, samples: usize) -> Result<Self, IdentifyError> {
        let mut failure = IdentifyError::TooFewEquations { equations: 0, parameters: 0 };
        let mut fits = Vec::with_capacity(results.len());
        for result in results.into_iter().rev() {
            match result {
                Ok(fit) => fits.insert(0, fit),
                Err(error) => failure = error,
            }
        }
        #[allow(clippy::cast_precision_loss, reason = "counts")]
        let score = |fit: &RecordFit| fit.log_likelihood() - 0.5 * fit.parameters() as f64 * libm::log(samples as f64);
        let best = fits.iter().map(score).fold(f64::NEG_INFINITY, f64::max);
        if !best.is_finite() {
            return Err(failure);
        }
        let weights: Vec<f64> = fits.iter().map(|fit| libm::exp(score(fit) - best)).collect();
        let sum: f64 = weights.iter().sum();
        Ok(Self { probabilities: weights.into_iter().map(|weight| weight / sum).collect(), fits })
    }

    /// The fits, in the order linear, quadratic, mixed; failed fits are missing.
    #[must_use]
    pub fn fits(&self) -> &[RecordFit] {
        &self.fits
    }

    /// Probability of a law; zero if it could not be fitted.
    #[must_use]
    pub fn probability(&self, law: DragLaw) -> f64 {
        self.fits.iter().zip(&self.probabilities).find(|(fit, _)| fit.law() == law).map_or(0.0, |(_, p)| *p)
    }

    /// The likeliest fit.
    #[must_use]
    pub fn likeliest(&self) -> &RecordFit {
        let best =
            self.probabilities.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(index, _)| index);
        &self.fits[best]
    }

    /// The law recognised: the likeliest, where its odds against every rival law that could be fitted are [`DECIDED`], or
    /// [`DECIDED_AGAINST_MIXED`]; else `None`.
    #[must_use]
    pub fn decision(&self) -> Option<DragLaw> {
        let best = self.likeliest().law();
        let beaten = |fit: &RecordFit| {
            let odds = if fit.law() == DragLaw::Mixed { DECIDED_AGAINST_MIXED } else { DECIDED };
            fit.law() == best || self.probability(best) >= odds * self.probability(fit.law())
        };
        self.fits.iter().all(beaten).then_some(best)
    }
}
