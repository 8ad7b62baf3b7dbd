//! Describing function of a power law.

use super::{ClosedForm, DescribingError, DescribingFunction};
use crate::nonlinearity::{Power, Sinusoid};
use crate::numeric::Scalar;

impl<T: Scalar> ClosedForm for Power<T> {
    /// Unbiased: `P = gain X^(p-1) (2/sqrt(pi)) Gamma(p/2 + 1)/Gamma(p/2 + 3/2)`, `F_0 = Q = 0`. Quadratic drag has
    /// `P = 8 gain X/(3 pi)`, the factor of eqs. 28-29.
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        let (bias, exponent) = (sweep.bias().bounds(), self.exponent().bounds());
        if bias != (0.0, 0.0) || exponent.0 != exponent.1 {
            return Err(DescribingError::NoClosedForm { characteristic: "power", bias: bias.0, exponent: exponent.0 });
        }
        let p = self.gain() * sweep.amplitude().pow(self.exponent() - T::one()) * gamma_ratio(exponent.0);
        Ok(DescribingFunction { f0: T::zero(), p, q: T::zero() })
    }
}

/// `(2/sqrt(pi)) Gamma(p/2 + 1)/Gamma(p/2 + 3/2)`, the mean of `2 abs(sin)^(p+1)`.
fn gamma_ratio<T: Scalar>(exponent: f64) -> T {
    let half = 0.5 * exponent;
    let gamma = if half < 150.0 {
        libm::tgamma(half + 1.0) / libm::tgamma(half + 1.5)
    } else {
        libm::exp(libm::lgamma(half + 1.0) - libm::lgamma(half + 1.5))
    };
    T::from_f64(2.0 * gamma) / T::pi().sqrt()
}
