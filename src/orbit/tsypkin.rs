//! Tsypkin's locus: the exact condition of symmetric relay oscillations in the frequency domain.

use nalgebra::Complex;

use crate::plant::{PlantError, StateSpace};

/// `sum of Re G(jkw) + j Im G(jkw)/k` over the first `terms` odd k, delay included.
///
/// A symmetric oscillation of frequency w under a relay of level C and half-width x_a has
/// `(4 C/pi) Im = -x_a` and `Re < 0` in the limit of many terms (Tsypkin, *Relay Control Systems*, 1984). The
/// remainder of the imaginary part falls as `terms^-r`, with r the excess of poles over zeros, at least 2 of them.
///
/// # Errors
/// [`PlantError::PoleAt`] where a harmonic coincides with a pole on the imaginary axis.
///
/// ```
/// use selfosc::orbit::tsypkin_locus;
/// use selfosc::plant::{StateSpace, TransferFunction};
/// let plant = StateSpace::realise(&TransferFunction::new(&[1.0], &[1.0, 1.0, 0.0])?)?;
/// let omega = core::f64::consts::PI / 1.862_223_721_734_969;
/// let locus = tsypkin_locus(&plant, omega, 2000)?;
/// assert!((4.0 / core::f64::consts::PI * locus.im + 0.2).abs() < 1e-7 && locus.re < 0.0);
/// # Ok::<(), selfosc::plant::PlantError>(())
/// ```
pub fn tsypkin_locus(plant: &StateSpace, omega_rad_s: f64, terms: usize) -> Result<Complex<f64>, PlantError> {
    let mut locus = Complex::new(0.0, 0.0);
    // Smallest first.
    for k in (0..terms).rev().map(|index| (2 * index + 1) as f64) {
        let response = plant.response(k * omega_rad_s)?;
        locus += Complex::new(response.re, response.im / k);
    }
    Ok(locus)
}
