//! One model from several experiments of one vehicle: common inertia, drag and delay.
//!
//! Every experiment contributes residuals that are functions of the common parameters; least squares over all of them.
//! [`FeatureRow`] contributes the logarithms of period and amplitude against the exact limit cycle; a sampled record can
//! contribute by the same trait.

mod least_squares;
mod row;
mod student;

use super::{DragLaw, IdentifyError};
use crate::numeric::Gradient;
use crate::plant::DragAxis;
use least_squares::{Linearised, Minimum, minimise};
pub use row::{FeatureRow, fit_rows};

/// A number with its derivatives with respect to the common parameters, in the order of [`Parameter`].
pub(crate) type Sensitive = Gradient<f64, COUNT>;

/// Number of common parameters.
const COUNT: usize = 4;

/// A parameter that all experiments share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Parameter {
    /// Inertia with added mass alpha.
    Alpha,
    /// Linear drag beta_1.
    LinearDrag,
    /// Quadratic drag beta_2.
    QuadraticDrag,
    /// Delay of the whole loop, in seconds.
    DelayS,
}

/// What is done about the delay.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Delay {
    /// It is known, in seconds.
    KnownS(f64),
    /// It is estimated with the other parameters, zero or more.
    #[default]
    Estimated,
}

/// An experiment as the joint estimate sees it.
///
/// Parameters that belong to this experiment alone (a disturbance, an initial state) are its own affair: it gives
/// residuals in which they are already at their best values, with derivatives from which their directions are projected
/// out.
pub(crate) trait Experiment {
    /// Appends the residuals of this experiment under `axis`, whose disturbance is zero, divided by their standard
    /// deviations up to a factor common to all experiments.
    ///
    /// # Errors
    /// Why the model has no answer at these parameters; the search then tries others.
    fn residuals(&self, axis: &DragAxis<Sensitive>, residuals: &mut Vec<Sensitive>) -> Result<(), IdentifyError>;
}

/// A value with what is known of its error.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(into = "Interval", try_from = "Interval")]
pub struct Estimate {
    /// The value, in the units of the experiments.
    pub value: f64,
    /// Its error; `None` for a value that was given, or that ended on its bound zero.
    pub spread: Option<ConfidenceInterval>,
}

/// An estimate as it is written: `{"value", "std", "low", "high"}`, the last three null together.
#[derive(serde::Serialize, serde::Deserialize)]
struct Interval {
    value: f64,
    std: Option<f64>,
    low: Option<f64>,
    high: Option<f64>,
}

impl From<Estimate> for Interval {
    fn from(Estimate { value, spread }: Estimate) -> Self {
        let field = |of: fn(ConfidenceInterval) -> f64| spread.map(of);
        Self { value, std: field(|s| s.std), low: field(|s| s.low), high: field(|s| s.high) }
    }
}

impl TryFrom<Interval> for Estimate {
    type Error = &'static str;

    fn try_from(Interval { value, std, low, high }: Interval) -> Result<Self, Self::Error> {
        match (std, low, high) {
            (Some(std), Some(low), Some(high)) => {
                Ok(Self { value, spread: Some(ConfidenceInterval { std, low, high }) })
            }
            (None, None, None) => Ok(Self { value, spread: None }),
            _ => Err("std, low and high of an estimate must be numbers or null together"),
        }
    }
}

/// Error of an estimate.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct ConfidenceInterval {
    /// Standard deviation.
    pub std: f64,
    /// Lower end of the 95 % interval (Student's t), not below zero.
    pub low: f64,
    /// Upper end of the 95 % interval.
    pub high: f64,
}

/// The joint estimate.
///
/// Its intervals hold for residuals that are independent and of equal variance, and for a model that is true up to them: a
/// wrong drag law shows as a larger residual, not as a wider interval.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Joint {
    law: DragLaw,
    axis: DragAxis<f64>,
    minimum: Minimum<COUNT>,
}

/// Fits `law` to all `experiments`, from `start`, whose inertia, and whose drag as far as the law has it, must be above zero.
/// With [`Delay::Estimated`] the search starts from the delay of `start`, above zero too.
///
/// A local minimum from that start; drag and delay never leave zero or more.
///
/// # Errors
/// [`IdentifyError::TooFewEquations`], [`IdentifyError::Confounded`] where the experiments cannot tell the parameters
/// apart, [`IdentifyError::NotSettled`], or the first experiment's error where the start itself has no answer.
pub(crate) fn fit<E: Experiment>(
    experiments: &[E],
    law: DragLaw,
    delay: Delay,
    start: &DragAxis<f64>,
) -> Result<Joint, IdentifyError> {
    let (linear, quadratic) = (law != DragLaw::Quadratic, law != DragLaw::Linear);
    let (estimated, delay_s) = match delay {
        Delay::KnownS(delay_s) => (false, delay_s),
        Delay::Estimated => (true, start.delay_s()),
    };
    let values = [
        start.alpha(),
        if linear { start.linear_drag() } else { 0.0 },
        if quadratic { start.quadratic_drag() } else { 0.0 },
        delay_s,
    ];
    let evaluate = |values: &[f64; COUNT]| linearise(experiments, values);
    let minimum = minimise(values, [true, linear, quadratic, estimated], evaluate)?;
    let [alpha, linear, quadratic, delay_s] = minimum.values;
    let axis = DragAxis::mixed(alpha, linear, quadratic)?.with_delay_s(delay_s)?;
    Ok(Joint { law, axis, minimum })
}

fn linearise<E: Experiment>(experiments: &[E], values: &[f64; COUNT]) -> Result<Linearised<COUNT>, IdentifyError> {
    let [alpha, linear, quadratic, delay_s] = Gradient::variables(*values);
    let axis = DragAxis::mixed(alpha, linear, quadratic)?.with_delay_s(delay_s)?;
    let mut residuals = Vec::new();
    for experiment in experiments {
        experiment.residuals(&axis, &mut residuals)?;
    }
    Ok(Linearised {
        residuals: residuals.iter().map(|residual| residual.value()).collect(),
        jacobian: residuals.iter().map(|residual| residual.slopes()).collect(),
    })
}

impl Joint {
    /// The drag law fitted.
    #[must_use]
    pub fn law(&self) -> DragLaw {
        self.law
    }

    /// The model, without a disturbance: that belongs to an experiment.
    #[must_use]
    pub fn axis(&self) -> &DragAxis<f64> {
        &self.axis
    }

    /// A parameter with its error. Zero without error where the law has no such drag.
    #[must_use]
    pub fn estimate(&self, parameter: Parameter) -> Estimate {
        let index = parameter as usize;
        let value = self.minimum.values[index];
        let spread = self.minimum.free[index].then(|| {
            let std = self.minimum.covariance[index][index].sqrt();
            let reach = std * student::quantile_95(self.degrees_of_freedom());
            ConfidenceInterval { std, low: (value - reach).max(0.0), high: value + reach }
        });
        Estimate { value, spread }
    }

    /// Correlation of the errors of two parameters; `None` unless both were estimated.
    #[must_use]
    pub fn correlation(&self, first: Parameter, second: Parameter) -> Option<f64> {
        let (i, j) = (first as usize, second as usize);
        let covariance = &self.minimum.covariance;
        let scale = (covariance[i][i] * covariance[j][j]).sqrt();
        (self.minimum.free[i] && self.minimum.free[j] && scale > 0.0).then(|| covariance[i][j] / scale)
    }

    /// The residuals, experiment by experiment.
    #[must_use]
    pub fn residuals(&self) -> &[f64] {
        &self.minimum.residuals
    }

    /// Root of the sum of squares of the residuals over the degrees of freedom: what is left for one measured number, the
    /// parameters having taken up their share.
    #[must_use]
    pub fn residual_rms(&self) -> f64 {
        self.minimum.variance().sqrt()
    }

    /// Residuals less parameters estimated.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> usize {
        self.minimum.degrees_of_freedom()
    }
}
