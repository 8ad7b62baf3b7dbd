//! Describing function of a power law, biased, to full precision for any exponent.

use super::closed_form::{ClosedForm, finite};
use super::{DescribingError, DescribingFunction};
use crate::nonlinearity::{Power, Sinusoid};
use crate::numeric::special::Special;

impl<T: Special> ClosedForm for Power<T> {
    /// `F_0 = gain X^p m(B/X)` and `P = 2 gain X^(p-1) h(B/X)` by the [moments](crate::numeric::power) m and h of a power of a
    /// biased sine: hypergeometric series. Unbiased `P = gain X^(p-1) (2/sqrt(pi)) Gamma(p/2 + 1)/Gamma(p/2 + 3/2)`;
    /// quadratic drag has `P = 8 gain X/(3 pi)`, the factor of eqs. 28-29. `Q = 0`.
    ///
    /// Derivatives by dual numbers hold with respect to bias, amplitude and gain; the exponent counts as a constant. In
    /// intervals an exponent that is not a single number gives the widest enclosure.
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        let [mean, first] = T::power_moments(self.moments(), sweep.bias(), sweep.amplitude());
        let p = T::two() * self.gain() * first / sweep.amplitude();
        finite(DescribingFunction { f0: self.gain() * mean, p, q: T::zero() }, sweep)
    }
}
