//! The two curves of the Nyquist plot, as points.

use core::ops::RangeInclusive;

use nalgebra::Complex;

use super::BalanceError;
use super::grid::Axis;
use crate::describing::{DescribingError, DescribingFunction};
use crate::nonlinearity::Sinusoid;
use crate::plant::TransferFunction;

/// A step along a curve that counts as none, relative to its distance from the origin.
const STEP: f64 = 0.1;

pub(super) fn near(a: Complex<f64>, b: Complex<f64>) -> bool {
    (a - b).norm() <= STEP * a.norm().max(b.norm())
}

/// `G(jw)` over a range of frequencies in rad/s, as pairs of frequency and response, at most a tenth of its magnitude
/// apart. A pole on the imaginary axis makes a gap.
///
/// # Errors
/// [`BalanceError::OutOfDomain`]; [`BalanceError::TooManyPoints`] where a delay turns the curve too often.
///
/// ```
/// use selfosc::balance::nyquist_locus;
/// use selfosc::plant::TransferFunction;
/// let plant = TransferFunction::new(&[1.0], &[1.0, 1.0])?;
/// let locus = nyquist_locus(&plant, 0.01..=100.0)?;
/// // A semicircle through 1/2 - j/2:
/// assert!(locus.iter().all(|(_, response)| ((response - 0.5).norm() - 0.5).abs() < 1e-12));
/// # Ok::<(), selfosc::balance::BalanceError>(())
/// ```
pub fn nyquist_locus(
    plant: &TransferFunction,
    omega_rad_s: RangeInclusive<f64>,
) -> Result<Vec<(f64, Complex<f64>)>, BalanceError> {
    let points = Axis::frequency(&omega_rad_s)?.sample(|w| plant.response(w).ok(), |a, b| near(*a, *b))?;
    Ok(points.into_iter().filter_map(|(omega, response)| Some((omega, response?))).collect())
}

/// `-1/N(X)` over a range of amplitudes at a bias of the characteristic's input, as pairs of amplitude and value, at
/// most a tenth of its magnitude apart. Amplitudes without describing function, or where it vanishes, are omitted.
///
/// # Errors
/// [`BalanceError::OutOfDomain`], [`BalanceError::TooManyPoints`].
pub fn negative_inverse_locus(
    describing: impl Fn(&Sinusoid<f64>) -> Result<DescribingFunction<f64>, DescribingError>,
    bias: f64,
    amplitude: RangeInclusive<f64>,
) -> Result<Vec<(f64, Complex<f64>)>, BalanceError> {
    let value = |amplitude: f64| {
        let df = describing(&Sinusoid::new(bias, amplitude).ok()?).ok()?;
        Some(-Complex::new(df.p, df.q).inv()).filter(|value| value.is_finite())
    };
    let points = Axis::amplitude(&amplitude)?.sample(value, |a, b| near(*a, *b))?;
    Ok(points.into_iter().filter_map(|(amplitude, value)| Some((amplitude, value?))).collect())
}
