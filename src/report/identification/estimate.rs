//! What one method found, in the same terms for all methods.

use crate::features::RelayLevels;
use crate::identify::fit::RecordFit;
use crate::identify::joint::{Estimate, Parameter};
use crate::identify::{DragLaw, iso};
use crate::plant::DragAxis;

/// Ways from records to parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "command", derive(clap::ValueEnum))]
pub enum Method {
    /// The paper's: the first harmonic of the mean cycle
    Iso,
    /// The exact limit cycle with the mean cycle's features
    Exact,
    /// Maximum likelihood on every sample, with intervals
    Fit,
    /// All of them
    All,
}

impl Method {
    /// Name on the command line and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Iso => "iso",
            Self::Exact => "exact",
            Self::Fit => "fit",
            Self::All => "all",
        }
    }

    /// Whether `one` is asked for.
    pub(super) fn has(self, one: Self) -> bool {
        self == one || self == Self::All
    }

    /// Whether a fit is asked for.
    #[must_use]
    pub fn fits(self) -> bool {
        self.has(Self::Fit)
    }
}

/// What one method found under one drag law.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// The method.
    pub method: Method,
    /// Number of the record it is from; `None` for all at once.
    pub record: Option<usize>,
    /// The drag law.
    pub drag: DragLaw,
    /// Inertia with added mass.
    pub alpha: Estimate,
    /// Linear drag, if the law has it.
    pub beta: Option<Estimate>,
    /// Quadratic drag, if the law has it.
    pub beta_quadratic: Option<Estimate>,
    /// Delay of the whole loop, given or estimated.
    pub delay_s: Estimate,
    /// Constant force during each of the records that it is from.
    pub deltas: Vec<Estimate>,
    /// Share of the output's variation that the model explains, in percent; `None` unless samples were fitted.
    pub fit_percent: Option<f64>,
    /// Root mean square of the residuals, in output units.
    pub residual_rms: Option<f64>,
}

impl Model {
    pub(super) fn of_fit(fit: &RecordFit) -> Self {
        let law = fit.law();
        let (residual_rms, fit_percent) = pooled(fit);
        Self {
            method: Method::Fit,
            record: None,
            drag: law,
            alpha: fit.estimate(Parameter::Alpha),
            beta: law.has_linear().then(|| fit.estimate(Parameter::LinearDrag)),
            beta_quadratic: law.has_quadratic().then(|| fit.estimate(Parameter::QuadraticDrag)),
            delay_s: fit.estimate(Parameter::DelayS),
            deltas: fit.records().iter().map(|record| record.disturbance).collect(),
            fit_percent: Some(fit_percent),
            residual_rms: Some(residual_rms),
        }
    }

    /// The method takes the relay for symmetric: the middle of its levels is part of the command, not a disturbance.
    pub(super) fn of_iso(
        drag: DragLaw,
        found: &iso::Parameters<f64>,
        relay: &RelayLevels,
        delay_s: f64,
        record: Option<usize>,
    ) -> Self {
        let [alpha, beta, beta_quadratic] = [found.alpha, found.beta, found.beta_quadratic];
        let delta = found.disturbance - relay.offset;
        Self::of_cycles(Method::Iso, record, drag, [alpha, beta, beta_quadratic, delta, delay_s])
    }

    pub(super) fn of_exact(drag: DragLaw, axis: &DragAxis<f64>, relay: &RelayLevels, record: Option<usize>) -> Self {
        let (delta, delay_s) = (axis.disturbance() - relay.offset, axis.delay_s());
        let values = [axis.alpha(), axis.linear_drag(), axis.quadratic_drag(), delta, delay_s];
        Self::of_cycles(Method::Exact, record, drag, values)
    }

    /// Numbers from mean cycles come without errors.
    fn of_cycles(method: Method, record: Option<usize>, drag: DragLaw, values: [f64; 5]) -> Self {
        let [alpha, beta, beta_quadratic, delta, delay_s] = values.map(|value| Estimate { value, spread: None });
        Self {
            method,
            record,
            drag,
            alpha,
            beta: drag.has_linear().then_some(beta),
            beta_quadratic: drag.has_quadratic().then_some(beta_quadratic),
            delay_s,
            deltas: vec![delta],
            fit_percent: None,
            residual_rms: None,
        }
    }
}

/// Residual rms and fit percent over all records, each about its own mean.
#[allow(clippy::cast_precision_loss, reason = "a count of samples")]
fn pooled(fit: &RecordFit) -> (f64, f64) {
    let (mut residual, mut variation, mut samples) = (0.0, 0.0, 0.0);
    for record in fit.records() {
        let count = record.residuals.len() as f64;
        let readings = || record.output.iter().zip(&record.residuals).map(|(model, residual)| model + residual);
        let mean = readings().sum::<f64>() / count;
        residual += record.residuals.iter().map(|r| r * r).sum::<f64>();
        variation += readings().map(|reading| (reading - mean).powi(2)).sum::<f64>();
        samples += count;
    }
    let share = (residual / variation.max(f64::MIN_POSITIVE)).sqrt();
    ((residual / samples.max(1.0)).sqrt(), 100.0 * (1.0 - share))
}
