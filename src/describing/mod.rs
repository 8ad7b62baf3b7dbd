//! Describing functions of a biased sinusoid: `F_0`, `P`, `Q` of eqs. 7-15.
//!
//! Three ways that share nothing but the characteristic: the [closed form](ClosedForm), which sums the harmonics of the
//! kernels a characteristic is made of (or a formula of its own, for a power law), [quadrature](by_quadrature) of its
//! output, and [rigorous quadrature](certified()), which gives enclosures. [`KernelForm`] proves the closed forms.

mod arctan;
#[cfg(feature = "std")]
mod catalogue;
#[cfg(feature = "std")]
mod certified;
mod closed_form;
mod error;
#[cfg(feature = "std")]
mod example;
#[cfg(feature = "std")]
mod fit;
#[cfg(feature = "std")]
mod inverse;
mod kernel;
#[cfg(feature = "std")]
mod kernel_proof;
mod pole;
mod polynomial;
mod power;
#[cfg(feature = "std")]
mod quadrature;
mod relay;
#[cfg(feature = "std")]
mod rounding;
#[cfg(feature = "std")]
mod setting;
mod sine;
#[cfg(feature = "std")]
mod sweeps;
mod tanh;

#[cfg(feature = "std")]
pub use catalogue::{Boxed, CATALOGUE, CatalogueError, Entry};
#[cfg(feature = "std")]
pub use certified::{Certified, certified};
pub use closed_form::ClosedForm;
pub use error::DescribingError;
#[cfg(feature = "std")]
pub use fit::{FittedCharacteristic, fit};
#[cfg(feature = "std")]
pub use inverse::{Solution, amplitudes};
#[cfg(feature = "std")]
pub use quadrature::by_quadrature;
#[cfg(feature = "std")]
pub use rounding::RoundingBounds;
#[cfg(feature = "std")]
pub use setting::Setting;

#[cfg(feature = "std")]
pub(crate) use kernel::ramp_by_angle;

internal! {
    use closed_form::{over_amplitudes};
    #[cfg(feature = "std")]
    use example::{Curve, Example};
    #[cfg(feature = "std")]
    use kernel::{band_from_the_middle, band_near_the_maximum};
    #[cfg(feature = "std")]
    use kernel_proof::{KernelForm};
    #[cfg(feature = "std")]
    use quadrature::{harmonic};
    use relay::{bias_of_output};
}

use core::ops::{Add, Mul, Sub};

use crate::numeric::Real;

/// Static term and complex gain of a characteristic at one bias and amplitude: its output is
/// `f0 + amplitude (p sin(theta) + q cos(theta)) +` higher harmonics (eqs. 11-15), where the input is
/// `bias + amplitude sin(theta)`.
///
/// Higher harmonics are neglected, without a bound.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct DescribingFunction<T> {
    /// Mean of the output, `F_0 = Y_0`, in output units.
    pub f0: T,
    /// In-phase gain `P = Y_P1 / X`, output units per input unit.
    pub p: T,
    /// Quadrature gain `Q = Y_Q1 / X`, output units per input unit; negative where the output lags.
    pub q: T,
}

/// Of the sum of two characteristics.
impl<T: Real> Add for DescribingFunction<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { f0: self.f0 + other.f0, p: self.p + other.p, q: self.q + other.q }
    }
}

/// Of the difference of two characteristics.
impl<T: Real> Sub for DescribingFunction<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { f0: self.f0 - other.f0, p: self.p - other.p, q: self.q - other.q }
    }
}

/// Of a characteristic whose output is multiplied.
impl<T: Real> Mul<T> for DescribingFunction<T> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: T) -> Self {
        Self { f0: self.f0 * factor, p: self.p * factor, q: self.q * factor }
    }
}

impl<T: Real> DescribingFunction<T> {
    /// Of a characteristic that gives nothing.
    #[must_use]
    pub fn zero() -> Self {
        Self { f0: T::zero(), p: T::zero(), q: T::zero() }
    }

    /// The gain seen through a dead time of `phase_rad = w T_d` (eq. 34): rotated by `+phase_rad`, so that the
    /// identification equations of the undelayed plant hold.
    ///
    /// ```
    /// use selfosc::describing::DescribingFunction;
    /// let turned = DescribingFunction { f0: 0.0, p: 1.0, q: 0.0 }.delayed(core::f64::consts::FRAC_PI_2);
    /// assert!((turned.q + 1.0).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn delayed(self, phase_rad: T) -> Self {
        let (cos, sin) = (phase_rad.cos(), phase_rad.sin());
        Self { f0: self.f0, p: self.p * cos + self.q * sin, q: self.q * cos - self.p * sin }
    }
}
