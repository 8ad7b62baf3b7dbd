//! The biased one-tone input of eq. 7.

use super::NonlinearityError;
use crate::numeric::Real;

/// The input `x = bias + amplitude sin(theta)` (eq. 7), in the characteristic's input units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sinusoid<T> {
    bias: T,
    amplitude: T,
}

impl<T: Real> Sinusoid<T> {
    /// # Errors
    /// [`NonlinearityError::Amplitude`] unless the amplitude is positive and finite; [`NonlinearityError::Bias`] unless
    /// the bias is finite.
    ///
    /// ```
    /// use selfosc::nonlinearity::Sinusoid;
    /// assert!(Sinusoid::new(0.1, 1.0).is_ok());
    /// assert!(Sinusoid::new(0.1, -1.0).is_err());
    /// ```
    pub fn new(bias: T, amplitude: T) -> Result<Self, NonlinearityError> {
        let (least, most) = amplitude.bounds();
        if !(least > 0.0 && most < f64::INFINITY) {
            return Err(NonlinearityError::Amplitude { amplitude: least });
        }
        let (lower, upper) = bias.bounds();
        if !(lower > f64::NEG_INFINITY && upper < f64::INFINITY) {
            return Err(NonlinearityError::Bias { bias: lower });
        }
        Ok(Self { bias, amplitude })
    }

    /// The mean of the input, x_0.
    #[inline]
    pub fn bias(&self) -> T {
        self.bias
    }
    /// Half the input's peak-to-peak range, X_m.
    #[inline]
    pub fn amplitude(&self) -> T {
        self.amplitude
    }
    /// The largest input, `bias + amplitude`.
    #[inline]
    pub fn maximum(&self) -> T {
        self.bias + self.amplitude
    }
    /// The smallest input, `bias - amplitude`.
    #[inline]
    pub fn minimum(&self) -> T {
        self.bias - self.amplitude
    }
}
