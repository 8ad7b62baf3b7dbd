//! The gain for a small slow signal beside the oscillation.

use num_dual::Dual64;

use super::{ClosedForm, DescribingError};
use crate::nonlinearity::Sinusoid;

/// Incremental-input gain `dF_0/dB` at `bias` and `amplitude`: what a small bias, or a signal slow against the oscillation,
/// is multiplied by. Output units per input unit. By automatic differentiation of the closed form.
///
/// # Errors
/// As [`ClosedForm::describing_function`]; [`DescribingError::NotFinite`] where the derivative does not exist (a turning
/// point of the sweep exactly at a jump).
///
/// ```
/// use num_dual::Dual64;
/// use selfosc::describing::incremental_gain;
/// use selfosc::nonlinearity::Relay;
/// // An oscillating relay passes a slow signal with half the gain it has for the oscillation (the factor is exact).
/// let gain = incremental_gain(&Relay::new(Dual64::from(1.0))?, 0.0, 0.5)?;
/// assert!((gain - 4.0 / core::f64::consts::PI).abs() < 1e-15);
/// # Ok::<(), selfosc::describing::DescribingError>(())
/// ```
pub fn incremental_gain(
    characteristic: &(impl ClosedForm<Number = Dual64> + ?Sized),
    bias: f64,
    amplitude: f64,
) -> Result<f64, DescribingError> {
    let sweep = Sinusoid::new(Dual64::new(bias, 1.0), amplitude.into())?;
    let gain = characteristic.describing_function(&sweep)?.f0.eps;
    if gain.is_finite() { Ok(gain) } else { Err(DescribingError::NotFinite { input: bias, output: gain }) }
}
