//! The biased one-tone input of eq. 7.

use super::NonlinearityError;
use crate::numeric::{Limit, OutOfDomain, Real, domain};

const AMPLITUDE: Limit = Limit::Positive;
const BIAS: Limit = Limit::Finite;

/// The input `x = bias + amplitude sin(theta)` (eq. 7), in the characteristic's input units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sinusoid<T> {
    bias: T,
    amplitude: T,
}

impl<T: Real> Sinusoid<T> {
    /// # Errors
    /// [`NonlinearityError::OutOfDomain`] unless the amplitude is positive and finite, and the bias finite.
    ///
    /// ```
    /// use selfosc::nonlinearity::Sinusoid;
    /// assert!(Sinusoid::new(0.1, 1.0).is_ok());
    /// assert!(Sinusoid::new(0.1, -1.0).is_err());
    /// ```
    #[inline]
    pub fn new(bias: T, amplitude: T) -> Result<Self, NonlinearityError> {
        checked_amplitude(amplitude)?;
        let remedy = "give the bias B of x = B + X sin(theta)";
        domain::require("bias", bias, "input units", BIAS, remedy)?;
        Ok(Self { bias, amplitude })
    }

    /// As [`new`](Self::new), `None` without the reason: a caller with several sweeps asks [`new`](Self::new) for it.
    #[inline(always)]
    pub(crate) fn if_defined(bias: T, amplitude: T) -> Option<Self> {
        (AMPLITUDE.holds(amplitude) && BIAS.holds(bias)).then_some(Self { bias, amplitude })
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

/// The amplitude, where a sinusoid can have it.
#[inline]
pub(crate) fn checked_amplitude<T: Real>(amplitude: T) -> Result<T, OutOfDomain> {
    let remedy = "give the amplitude X of x = B + X sin(theta)";
    domain::require("amplitude", amplitude, "input units", AMPLITUDE, remedy)
}
