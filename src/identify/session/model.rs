//! The result of a method, in a form common to all methods.

use serde::{Deserialize, Serialize};

use super::settings::Method;
use crate::features::RelayLevels;
use crate::identify::answer::{AxisParameter, Disturbances, DragLaw, Estimate, Term};
use crate::identify::fit::shooting::RecordFit;
use crate::identify::iso;
use crate::plant::DragAxis;

/// The model of a method under a drag law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Model {
    /// The method.
    pub method: Method,
    /// The drag law.
    pub drag: DragLaw,
    /// Number of the record it is from; `None` for all at once.
    pub record: Option<usize>,
    /// Terms of the model in addition to inertia, drag, constant force and delay.
    pub terms: Vec<Term>,
    /// Inertia with added mass.
    pub alpha: Estimate,
    /// Linear drag, if the law has it.
    pub beta: Option<Estimate>,
    /// Quadratic drag, if the law has it.
    pub beta_quadratic: Option<Estimate>,
    /// Constant force during each of the records that it is from.
    #[serde(flatten)]
    pub deltas: Disturbances,
    /// Delay of the whole loop, given or estimated.
    pub delay_s: Estimate,
    /// Share of the output's variation that the model explains, in percent; `None` unless samples were fitted.
    pub fit_percent: Option<f64>,
    /// Root mean square of the residuals, in output units.
    pub residual_rms: Option<f64>,
    /// Log-likelihood of all samples; comparable only between models of the same method.
    pub log_likelihood: Option<f64>,
}

impl Model {
    /// The constant force, where the model is from a single record.
    #[must_use]
    pub fn delta(&self) -> Option<Estimate> {
        self.deltas.single()
    }

    pub(super) fn of_fit(fit: &RecordFit) -> Self {
        let law = fit.law();
        let (residual_rms, fit_percent) = pooled(fit);
        Self {
            method: Method::Fit,
            record: None,
            drag: law,
            terms: Vec::new(),
            alpha: fit.estimate(AxisParameter::Alpha),
            beta: law.has_linear().then(|| fit.estimate(AxisParameter::LinearDrag)),
            beta_quadratic: law.has_quadratic().then(|| fit.estimate(AxisParameter::QuadraticDrag)),
            delay_s: fit.estimate(AxisParameter::DelayS),
            deltas: fit.records().iter().map(|record| record.disturbance).collect(),
            fit_percent: Some(fit_percent),
            residual_rms: Some(residual_rms),
            log_likelihood: Some(fit.log_likelihood()),
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
        let [alpha, beta, beta_quadratic, delta, delay_s] = values.map(|value| Estimate::new(value, None));
        Self {
            method,
            record,
            drag,
            terms: Vec::new(),
            alpha,
            beta: drag.has_linear().then_some(beta),
            beta_quadratic: drag.has_quadratic().then_some(beta_quadratic),
            delay_s,
            deltas: [delta].into_iter().collect(),
            fit_percent: None,
            residual_rms: None,
            log_likelihood: None,
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
