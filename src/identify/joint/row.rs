//! An experiment that is known by its features only.

use super::{Delay, Experiment, Joint, Sensitive, fit};
use crate::identify::error::READ_AGAIN;
use crate::identify::exact::MeanCycle;
use crate::identify::iso::Oscillation;
use crate::identify::{DragLaw, IdentifyError};
use crate::nonlinearity::RelayHysteresis;
use crate::numeric::{Limit, Real, domain};
use crate::orbit::limit_cycle;
use crate::plant::DragAxis;

/// The features of one experiment, for a joint estimate: a row of Table 4, for one.
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
    /// [`IdentifyError::OutOfDomain`] or [`IdentifyError::Describing`] where one of them is not a number of the right kind.
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
}

impl Experiment for FeatureRow {
    fn residuals(&self, axis: &DragAxis<Sensitive>, residuals: &mut Vec<Sensitive>) -> Result<(), IdentifyError> {
        let number = Sensitive::from_f64;
        let relay = RelayHysteresis::new(number(self.relay.level()), number(self.relay.half_width()), Real::zero())?;
        let orbit = limit_cycle(axis, &relay)?;
        let log_ratio = |measured: f64, predicted: Sensitive| Real::ln(number(measured) / predicted);
        residuals.extend([log_ratio(self.amplitude, orbit.amplitude), log_ratio(self.period_s, orbit.period_s)]);
        Ok(())
    }
}

/// Fits `law` to all `rows`, from the start that the rows give one by one. See [`fit`].
///
/// ```
/// use selfosc::identify::joint::{Delay, FeatureRow, fit_rows};
/// use selfosc::identify::{DragLaw, iso::Oscillation};
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
/// As [`fit`]; [`IdentifyError::NoOrbit`] where no row has an orbit with the delay given.
pub fn fit_rows(rows: &[FeatureRow], law: DragLaw, delay: Delay) -> Result<Joint, IdentifyError> {
    fit(rows, law, delay, &start(rows, law, delay)?)
}

/// Part of the shortest period at which the search for the delay starts.
const DELAY_SHARE: f64 = 0.05;

/// Geometric means of what the rows that have an answer give by themselves.
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
                    logarithms[0] += axis.alpha().ln();
                    logarithms[1] += (axis.linear_drag() + axis.quadratic_drag()).ln();
                    count += 1.0;
                }
                Err(error) => failure = error,
            }
        }
        if count > 0.0 { Ok(logarithms.map(|sum: f64| (sum / count).exp())) } else { Err(failure) }
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
