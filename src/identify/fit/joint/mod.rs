//! An axis from the features of several experiments with the same vehicle: common inertia, drag and delay.
//!
//! Nonlinear least squares over the logarithms of period and amplitude against the exact limit cycle (Levenberg-Marquardt).

mod least_squares;

use crate::identify::answer::distribution::student_quantile_95;
use crate::identify::answer::{AxisParameter, ConfidenceInterval, Delay, DragLaw, Estimate, IdentifyError, READ_AGAIN};
use crate::identify::exact::MeanCycle;
use crate::identify::iso::Oscillation;
use crate::nonlinearity::RelayHysteresis;
use crate::numeric::{Gradient, Limit, Real, domain};
use crate::orbit::limit_cycle;
use crate::plant::DragAxis;
use least_squares::{Linearised, Minimum, minimise};

/// A number with its derivatives with respect to the common parameters, in the order of [`AxisParameter`].
type AxisSensitivity = Gradient<f64, { AxisParameter::COUNT }>;

/// The features of an experiment, for a joint estimate: for example a row of Table 4.
///
/// Its residuals are `ln(X_m/predicted)` and `ln(T/predicted)`, the prediction being the exact limit cycle without a
/// disturbance under the relay that switches at the measured level x_a*: the level at which the command was *given*,
/// the common delay coming after it. A disturbance enters amplitude and period by its square, and a bias read off a record
/// can as well be an offset of sensor or reference, so the bias is not used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureRow {
    relay: RelayHysteresis<f64>,
    amplitude: f64,
    period_s: f64,
}

impl FeatureRow {
    /// Relay level C, switching level x_a*, amplitude X_m and period T of `oscillation`; its bias and delay are not used.
    ///
    /// # Errors
    /// [`IdentifyError::OutOfDomain`] or [`IdentifyError::Describing`] where a feature is outside its domain.
    pub fn new(oscillation: &Oscillation<f64>) -> Result<Self, IdentifyError> {
        let Oscillation { relay_level, switch_level, amplitude, period_s, .. } = *oscillation;
        for (feature, value, unit) in [("amplitude", amplitude, "output units"), ("period", period_s, "s")] {
            domain::require(feature, value, unit, Limit::Positive, READ_AGAIN)?;
        }
        Ok(Self { relay: RelayHysteresis::new(relay_level, switch_level, 0.0)?, amplitude, period_s })
    }

    fn cycle(&self, delay_s: f64) -> MeanCycle<f64> {
        MeanCycle {
            relay_level: self.relay.level(),
            switch_level: self.relay.half_width(),
            amplitude: self.amplitude,
            time_positive_s: self.period_s / 2.0,
            time_negative_s: self.period_s / 2.0,
            delay_s,
        }
    }

    /// Appends `ln(X_m/predicted)` and `ln(T/predicted)` under `axis`, whose disturbance is zero.
    fn residuals(
        &self,
        axis: &DragAxis<AxisSensitivity>,
        residuals: &mut Vec<AxisSensitivity>,
    ) -> Result<(), IdentifyError> {
        let number = AxisSensitivity::from_f64;
        let relay = RelayHysteresis::new(number(self.relay.level()), number(self.relay.half_width()), Real::zero())?;
        let orbit = limit_cycle(axis, &relay)?;
        let log_ratio = |measured: f64, predicted: AxisSensitivity| Real::ln(number(measured) / predicted);
        residuals.extend([log_ratio(self.amplitude, orbit.amplitude), log_ratio(self.period_s, orbit.period_s)]);
        Ok(())
    }
}

/// The joint estimate.
///
/// Its intervals hold for residuals that are independent and of equal variance, and for a model that is true up to them: a
/// wrong drag law shows as a larger residual, not as a wider interval.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Joint {
    law: DragLaw,
    axis: DragAxis<f64>,
    minimum: Minimum,
}

/// Fits `law` to all `rows`. The search starts from the geometric mean of the rows' own answers, and ends in a local
/// minimum; drag and delay never leave zero or more.
///
/// ```
/// use selfosc::identify::fit::joint::{FeatureRow, fit_rows};
/// use selfosc::identify::{Delay, DragLaw, iso::Oscillation};
/// // Rows 1, 7 and 19 of Table 4, in its own units: degrees and 1e-2 N m.
/// let rows = [(2.10, 10.29, 20.6, 4.26), (8.23, 6.58, 26.36, 2.69), (16.98, 34.0, 60.33, 3.51)].map(
///     |(relay_level, switch_level, amplitude, period_s)| {
///         FeatureRow::new(&Oscillation { relay_level, switch_level, amplitude, bias: 0.0, period_s, delay_s: 0.0 })
///     },
/// );
/// let rows = rows.into_iter().collect::<Result<Vec<_>, _>>()?;
/// let rms = |law| Ok::<_, selfosc::identify::IdentifyError>(fit_rows(&rows, law, Delay::KnownS(0.2))?.residual_rms());
/// assert!(rms(DragLaw::Quadratic)? < rms(DragLaw::Linear)?);
/// # Ok::<(), selfosc::identify::IdentifyError>(())
/// ```
///
/// # Errors
/// [`IdentifyError::TooFewEquations`], [`IdentifyError::Confounded`] where the rows cannot tell the parameters apart,
/// [`IdentifyError::NotSettled`]; [`IdentifyError::NoOrbit`] where no row has an orbit with the delay given.
pub fn fit_rows(rows: &[FeatureRow], law: DragLaw, delay: Delay) -> Result<Joint, IdentifyError> {
    let start = start(rows, law, delay)?;
    let values = [start.alpha(), start.linear_drag(), start.quadratic_drag(), start.delay_s()];
    let estimated = [true, law.has_linear(), law.has_quadratic(), delay == Delay::Estimated];
    let minimum = minimise(values, estimated, |values| linearise(rows, values))?;
    let [alpha, linear, quadratic, delay_s] = minimum.values;
    let axis = DragAxis::mixed(alpha, linear, quadratic)?.with_delay_s(delay_s)?;
    Ok(Joint { law, axis, minimum })
}

fn linearise(rows: &[FeatureRow], values: &[f64; AxisParameter::COUNT]) -> Result<Linearised, IdentifyError> {
    let [alpha, linear, quadratic, delay_s] = Gradient::variables(*values);
    let axis = DragAxis::mixed(alpha, linear, quadratic)?.with_delay_s(delay_s)?;
    let mut residuals = Vec::new();
    for row in rows {
        row.residuals(&axis, &mut residuals)?;
    }
    Ok(Linearised {
        residuals: residuals.iter().map(|residual| residual.value()).collect(),
        jacobian: residuals.iter().map(|residual| residual.slopes()).collect(),
    })
}

/// Part of the shortest period at which the search for the delay starts.
const DELAY_SHARE: f64 = 0.05;

/// Geometric means of the single-row answers, over the rows that have an answer.
fn start(rows: &[FeatureRow], law: DragLaw, delay: Delay) -> Result<DragAxis<f64>, IdentifyError> {
    let delay_s = match delay {
        Delay::KnownS(delay_s) => delay_s,
        Delay::Estimated => DELAY_SHARE * rows.iter().map(|row| row.period_s).fold(f64::INFINITY, f64::min),
    };
    let mean = |quadratic: bool| {
        let mut failure = IdentifyError::TooFewEquations { equations: 0, parameters: 2 };
        let (mut logarithms, mut count) = ([0.0; 2], 0.0);
        for row in rows {
            let cycle = row.cycle(delay_s);
            let axis = if quadratic { cycle.quadratic_drag() } else { cycle.linear_drag() };
            match axis {
                Ok(axis) => {
                    logarithms[0] += libm::log(axis.alpha());
                    logarithms[1] += libm::log(axis.linear_drag() + axis.quadratic_drag());
                    count += 1.0;
                }
                Err(error) => failure = error,
            }
        }
        if count > 0.0 { Ok(logarithms.map(|sum: f64| libm::exp(sum / count))) } else { Err(failure) }
    };
    let axis = match law {
        DragLaw::Linear => mean(false).map(|[alpha, drag]| DragAxis::linear(alpha, drag))?,
        DragLaw::Quadratic => mean(true).map(|[alpha, drag]| DragAxis::quadratic(alpha, drag))?,
        DragLaw::Mixed => {
            let ([alpha, linear], [_, quadratic]) = (mean(false)?, mean(true)?);
            DragAxis::mixed(alpha, linear / 2.0, quadratic / 2.0)
        }
    };
    Ok(axis?.with_delay_s(delay_s)?)
}

impl Joint {
    /// The model, without a disturbance: that belongs to an experiment.
    #[must_use]
    pub fn axis(&self) -> &DragAxis<f64> {
        &self.axis
    }

    /// A parameter with its error. Zero without error where the law has no such drag.
    #[must_use]
    pub fn estimate(&self, parameter: AxisParameter) -> Estimate {
        let index = parameter as usize;
        let value = self.minimum.values[index];
        let spread = self.minimum.free[index].then(|| {
            let std = self.minimum.covariance[index][index].sqrt();
            let reach = std * student_quantile_95(self.degrees_of_freedom());
            ConfidenceInterval { std, low: (value - reach).max(0.0), high: value + reach }
        });
        Estimate::new(value, spread)
    }

    /// Correlation of the errors of two parameters; `None` unless both were estimated.
    #[must_use]
    pub fn correlation(&self, first: AxisParameter, second: AxisParameter) -> Option<f64> {
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

    /// Root of the sum of squares of the residuals over the degrees of freedom: the residual of a single measured number, the
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
