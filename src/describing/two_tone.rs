//! Two sinusoids whose frequencies have no common measure.

use core::f64::consts::{FRAC_PI_2, PI};

use super::quadrature::{CELLS, TOLERANCE, settled};
use super::{ClosedForm, DescribingError, DescribingFunction};
use crate::nonlinearity::Sinusoid;
use crate::numeric::quadrature::integrate;

/// The gains for `bias + first sin(theta_1) + second sin(theta_2)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoTone {
    /// Mean of the output, and the gain `P + jQ` of the first tone.
    pub first: DescribingFunction<f64>,
    /// Gain of the second tone, output units per input unit.
    pub second: f64,
}

/// Two-sinusoid-input describing functions of an incommensurate pair: the gain of each tone in the presence of the other.
///
/// The angles are independent, so that the mean over the second angle of the describing function with bias
/// `bias + second sin(theta_2)` is that of the pair. For a characteristic without memory this holds for any such pair and
/// either order; for one with memory, where the second tone is slow against the first. Numeric, to about 1e-12.
///
/// # Errors
/// As [`ClosedForm::describing_function`], at any bias met; [`DescribingError::Quadrature`].
///
/// ```
/// use selfosc::describing::two_tone;
/// use selfosc::nonlinearity::Polynomial;
/// let cube = Polynomial::new([0.0, 0.0, 0.0, 1.0])?;
/// let gains = two_tone(&cube, 0.0, 2.0, 1.0)?;
/// // 3/4 A^2 + 3/2 B^2 for a cube.
/// assert!((gains.first.p - 4.5).abs() < 1e-12);
/// assert!((gains.second - 6.75).abs() < 1e-12);
/// # Ok::<(), selfosc::describing::DescribingError>(())
/// ```
pub fn two_tone(
    characteristic: &(impl ClosedForm<Number = f64> + ?Sized),
    bias: f64,
    first: f64,
    second: f64,
) -> Result<TwoTone, DescribingError> {
    let slow = Sinusoid::new(bias, second)?;
    let mut cuts = vec![-FRAC_PI_2, FRAC_PI_2];
    characteristic.kinks(&Sinusoid::new(bias, first)?, &mut |kink| {
        let turning = [kink - first, kink, kink + first].map(|level| (level - bias) / second);
        cuts.extend(turning.into_iter().filter(|u| u.abs() < 1.0).map(f64::asin));
    });
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();

    let mut fault = None;
    let mut mean = |part: fn(DescribingFunction<f64>, f64) -> f64| -> Result<f64, DescribingError> {
        let mut sum = 0.0;
        for piece in cuts.windows(2) {
            let (from, width) = (piece[0], piece[1] - piece[0]);
            // The cubic takes the square root at either end of a piece away.
            let integrand = |t: f64| {
                let sine = (from + width * t * t * (3.0 - 2.0 * t)).sin();
                let sweep = Sinusoid::new(slow.bias() + slow.amplitude() * sine, first);
                match sweep.map_err(DescribingError::from).and_then(|sweep| characteristic.describing_function(&sweep))
                {
                    Ok(df) => part(df, sine) * 6.0 * t * (1.0 - t) * width,
                    Err(error) => {
                        fault = Some(error);
                        0.0
                    }
                }
            };
            let integral = integrate(integrand, 0.0, 1.0, TOLERANCE, CELLS);
            match fault {
                Some(error) => return Err(error),
                None => sum += settled(integral)?,
            }
        }
        Ok(sum / PI)
    };
    let first = DescribingFunction { f0: mean(|df, _| df.f0)?, p: mean(|df, _| df.p)?, q: mean(|df, _| df.q)? };
    Ok(TwoTone { first, second: 2.0 * mean(|df, sine| df.f0 * sine)? / second })
}
