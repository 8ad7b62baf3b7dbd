//! Describing functions by quadrature of the output: for any characteristic, and to check closed forms against.

use core::f64::consts::{FRAC_PI_2, PI};

use super::{DescribingError, DescribingFunction};
use crate::nonlinearity::{Branch, Characteristic, Sinusoid};
use crate::numeric::quadrature::{Quadrature, integrate};

/// Relative to the largest integrand seen, the error estimate at which a cell is taken as done.
pub(super) const TOLERANCE: f64 = 1e-13;
/// Cells of one integral; a smooth piece takes a handful.
pub(super) const CELLS: usize = 4000;

/// `F_0`, `P`, `Q` by adaptive Gauss-Kronrod quadrature of eq. 10 between the kinks of the output (eqs. 13-15).
///
/// An error estimate, not a bound, decides when to stop: a kink that the characteristic does not report can go unseen.
///
/// # Errors
/// [`DescribingError::Nonlinearity`] below the switching amplitude, [`DescribingError::NotFinite`] where the output is not
/// a number, [`DescribingError::Quadrature`] where the estimate stays above 1e-13 of the integrand.
///
/// ```
/// use selfosc::describing::{ClosedForm, by_quadrature};
/// use selfosc::nonlinearity::{Saturation, Sinusoid};
/// let saturation = Saturation::new(2.0, 0.7)?;
/// let sweep = Sinusoid::new(0.3, 1.5)?;
/// let (numeric, closed) = (by_quadrature(&saturation, &sweep)?, saturation.describing_function(&sweep)?);
/// assert!((numeric.p - closed.p).abs() < 1e-12);
/// # Ok::<(), selfosc::describing::DescribingError>(())
/// ```
pub fn by_quadrature(
    characteristic: &(impl Characteristic<Number = f64> + ?Sized),
    sweep: &Sinusoid<f64>,
) -> Result<DescribingFunction<f64>, DescribingError> {
    let (f0, _) = harmonic(characteristic, sweep, 0)?;
    let (sine, cosine) = harmonic(characteristic, sweep, 1)?;
    let amplitude = sweep.amplitude();
    super::closed_form::finite(DescribingFunction { f0, p: sine / amplitude, q: cosine / amplitude }, sweep)
}

/// Coefficients `(Y_Pk, Y_Qk)` of `sin(k theta)` and `cos(k theta)` in the output, `k = order` (eq. 10); for order zero
/// the mean `Y_0` and zero. Output units.
///
/// # Errors
/// As [`by_quadrature`].
pub fn harmonic(
    characteristic: &(impl Characteristic<Number = f64> + ?Sized),
    sweep: &Sinusoid<f64>,
    order: u32,
) -> Result<(f64, f64), DescribingError> {
    characteristic.admits(sweep)?;
    let mut angles = vec![-FRAC_PI_2, FRAC_PI_2];
    characteristic.kinks(sweep, &mut |x| {
        // By its tangent, which is accurate where the sweep barely passes x.
        let (above, below) = (sweep.maximum() - x, x - sweep.minimum());
        if above > 0.0 && below > 0.0 {
            angles.push(libm::atan2(x - sweep.bias(), (above * below).sqrt()));
        }
    });
    angles.sort_by(f64::total_cmp);
    angles.dedup();

    let k = f64::from(order);
    let (mut sine, mut cosine) = (0.0, 0.0);
    for branch in [Branch::Rising, Branch::Falling] {
        for piece in angles.windows(2) {
            let mut fault = None;
            let mut weighted = |angle: f64, weight: fn(f64) -> f64| {
                let x = sweep.bias() + sweep.amplitude() * libm::sin(angle);
                let output = characteristic.output(x, branch, sweep);
                if !output.is_finite() {
                    fault = Some(DescribingError::NotFinite { input: x, output });
                    return 0.0;
                }
                // The falling branch runs from the maximum back: its angle is pi less that of the rising one.
                let theta = if branch == Branch::Rising { angle } else { PI - angle };
                output * weight(k * theta)
            };
            let y = integrate(&mut |angle| weighted(angle, libm::cos), piece[0], piece[1], TOLERANCE, CELLS);
            cosine += settled(y)?;
            if order > 0 {
                let y = integrate(&mut |angle| weighted(angle, libm::sin), piece[0], piece[1], TOLERANCE, CELLS);
                sine += settled(y)?;
            }
            if let Some(fault) = fault {
                return Err(fault);
            }
        }
    }
    let (sine, cosine) = if order == 0 { (cosine / (2.0 * PI), 0.0) } else { (sine / PI, cosine / PI) };
    super::closed_form::finite(DescribingFunction { f0: 0.0, p: sine, q: cosine }, sweep)?;
    Ok((sine, cosine))
}

pub(super) fn settled(quadrature: Quadrature) -> Result<f64, DescribingError> {
    let Quadrature { value, estimate, tolerance, cells } = quadrature;
    if estimate <= tolerance && value.is_finite() {
        Ok(value)
    } else {
        Err(DescribingError::Quadrature { estimate, tolerance, cells })
    }
}
