//! What a user should know before trusting a result.

use core::fmt;

use super::fit::RecordFit;
use super::iso;
use super::joint::Parameter;
use super::prediction_error::Reported;
use crate::features::RecordFeatures;

/// Something that would mislead. Ratios are plain numbers; one to an estimate of zero is infinite, and written as text in JSON.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(tag = "code", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Warning {
    /// The command goes from level to level at a limited rate, and the orders behind it were derived.
    OrdersDerived {
        /// Time that it takes, in s.
        ramp_s: f64,
    },
    /// The oscillation barely passes the switching level: inertia follows from a small difference.
    IllConditioned {
        /// Switching level with magnitude of the bias, over amplitude.
        #[serde(with = "super::any_float")]
        ratio: f64,
    },
    /// The interval of a parameter is wider than its value.
    WideInterval {
        /// The parameter.
        parameter: Parameter,
        /// Width of the interval over the value.
        #[serde(with = "super::any_float")]
        ratio: f64,
    },
    /// Delay and inertia cannot be told apart.
    DelayConfounded {
        /// Correlation of their errors.
        correlation: f64,
    },
    /// The command acts later than the delay given says.
    ActuatorLag {
        /// Delay given, in s.
        given_s: f64,
        /// Delay that fits the record best, in s.
        fitted_s: f64,
    },
    /// The model leaves a pattern in the residuals.
    ColouredResiduals {
        /// The strongest correlation of residuals a few samples apart.
        correlation: f64,
    },
    /// The paper's method and the answer disagree by more than their errors.
    MethodsDisagree {
        /// The parameter.
        parameter: Parameter,
        /// Value by the paper's method over the reported one.
        #[serde(with = "super::any_float")]
        ratio: f64,
    },
}

/// Switching level over amplitude from which inertia is ill-conditioned.
const NEAR_AMPLITUDE: f64 = 0.9;
/// Correlation from which two parameters are one.
const CONFOUNDED: f64 = 0.95;
/// Correlation of residuals from which a pattern matters: with it at one lag, errors are half as large again as claimed.
const COLOURED: f64 = 0.3;
/// Difference between the methods that is the sinusoid's own error.
const METHOD_ERROR: f64 = 0.1;
/// Standard deviations that count as a difference.
const SIGNIFICANT: f64 = 3.0;

impl Warning {
    /// Short name for scripts.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::OrdersDerived { .. } => "orders-derived",
            Self::IllConditioned { .. } => "ill-conditioned",
            Self::WideInterval { .. } => "wide-interval",
            Self::DelayConfounded { .. } => "delay-confounded",
            Self::ActuatorLag { .. } => "actuator-lag",
            Self::ColouredResiduals { .. } => "coloured-residuals",
            Self::MethodsDisagree { .. } => "methods-disagree",
        }
    }

    /// Warnings that features give.
    #[must_use]
    pub fn of_features(RecordFeatures { features, ramp_s, .. }: &RecordFeatures) -> Vec<Self> {
        let ratio = (features.switch_level.mean + features.bias.mean.abs()) / features.amplitude.mean;
        let derived = (*ramp_s > 0.0).then_some(Self::OrdersDerived { ramp_s: *ramp_s });
        derived.into_iter().chain((ratio > NEAR_AMPLITUDE).then_some(Self::IllConditioned { ratio })).collect()
    }

    /// Warnings that a fit gives; `free_delay` is the same fit with the delay estimated, if there is one.
    #[must_use]
    pub fn of_fit(fit: &RecordFit, free_delay: Option<&RecordFit>) -> Vec<Self> {
        let mut warnings = Vec::new();
        for parameter in [Parameter::Alpha, Parameter::LinearDrag, Parameter::QuadraticDrag] {
            let estimate = fit.estimate(parameter);
            if let Some(spread) = estimate.spread
                && spread.high - spread.low > estimate.value
            {
                let ratio = (spread.high - spread.low) / estimate.value;
                warnings.push(Self::WideInterval { parameter, ratio });
            }
        }
        if let Some(correlation) = fit.correlation(Parameter::Alpha, Parameter::DelayS)
            && correlation.abs() > CONFOUNDED
        {
            warnings.push(Self::DelayConfounded { correlation });
        }
        if let Some(free) = free_delay {
            let (given_s, fitted) = (fit.axis().delay_s(), free.estimate(Parameter::DelayS));
            let std = fitted.spread.map_or(0.0, |spread| spread.std);
            if fitted.value - given_s > (SIGNIFICANT * std).max(0.05 * given_s) {
                warnings.push(Self::ActuatorLag { given_s, fitted_s: fitted.value });
            }
        }
        // Rounding alone leaves a third of a step and may well have a pattern of its own.
        let real = fit.records().iter().filter(|record| record.residual_rms > 0.5 * record.quantum);
        let coloured =
            real.filter(|record| record.ljung_box_deviate > SIGNIFICANT).map(|record| record.strongest_correlation);
        let worst = coloured.fold(0.0, |worst: f64, next| if next.abs() > worst.abs() { next } else { worst });
        if worst.abs() > COLOURED {
            warnings.push(Self::ColouredResiduals { correlation: worst });
        }
        warnings
    }

    /// Warnings that the paper's method beside the answer gives.
    #[must_use]
    pub fn of_methods(iso: &iso::Parameters<f64>, reported: &Reported) -> Vec<Self> {
        let mut warnings = Vec::new();
        let drag = match (reported.drag.has_linear(), reported.drag.has_quadratic()) {
            (true, false) => Some((Parameter::LinearDrag, iso.beta, reported.beta)),
            (false, true) => Some((Parameter::QuadraticDrag, iso.beta_quadratic, reported.beta_quadratic)),
            _ => None,
        };
        for (parameter, value, estimate) in
            [Some((Parameter::Alpha, iso.alpha, reported.alpha)), drag].into_iter().flatten()
        {
            let std = estimate.spread.map_or(0.0, |spread| spread.std);
            if (value - estimate.value).abs() > (SIGNIFICANT * std).max(METHOD_ERROR * estimate.value.abs()) {
                warnings.push(Self::MethodsDisagree { parameter, ratio: value / estimate.value });
            }
        }
        warnings
    }
}

/// A parameter's name in a sentence.
fn name(parameter: Parameter) -> &'static str {
    match parameter {
        Parameter::Alpha => "inertia",
        Parameter::LinearDrag => "linear drag",
        Parameter::QuadraticDrag => "quadratic drag",
        Parameter::DelayS => "delay",
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::OrdersDerived { ramp_s } => write!(
                f,
                "the command takes {ramp_s:.2} s from level to level: orders are taken to be given where it begins to move, and \
                 the methods for mean cycles take it for a relay that is late by half of that"
            ),
            Self::IllConditioned { ratio } => write!(
                f,
                "switching level with bias is {ratio:.2} of the amplitude (above {NEAR_AMPLITUDE}): inertia follows from a \
                 small difference; `selfosc design` computes which relay determines it better"
            ),
            Self::WideInterval { parameter, ratio } => write!(
                f,
                "the interval of {} is {ratio:.1} times its value: this record hardly determines it; `selfosc design` \
                 computes which experiment does",
                name(parameter)
            ),
            Self::DelayConfounded { correlation } => write!(
                f,
                "errors of delay and inertia have correlation {correlation:.2}: the record hardly tells them apart"
            ),
            Self::ActuatorLag { given_s, fitted_s } => write!(
                f,
                "the record fits a delay of {fitted_s:.3} s better than the {given_s:.3} s given: an actuator lags, the \
                 command is held, or the delay is another"
            ),
            Self::ColouredResiduals { correlation } => write!(
                f,
                "residuals a few samples apart have correlation {correlation:.2}: something moves that the model has not, and the \
                 intervals are too narrow"
            ),
            Self::MethodsDisagree { parameter, ratio } => write!(
                f,
                "the paper's method gives {ratio:.2} times the {} reported: it takes the oscillation for a sinusoid, and knows no \
                 other term than drag and constant force",
                name(parameter)
            ),
        }
    }
}
