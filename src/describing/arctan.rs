//! Describing function of the arc tangent.

use super::closed_form::{ClosedForm, finite};
use super::pole::{Pole, Scaled};
use super::{DescribingError, DescribingFunction};
use crate::nonlinearity::{Arctan, Sinusoid};
use crate::numeric::Real;

impl<T: Real> ClosedForm for Arctan<T> {
    /// With `w = 1 - i kB` and `S = sqrt(w^2 + (kX)^2)`: `F_0 = -gain arg(w + S)`, `P = 2 gain k Re 1/(w + S)`, `Q = 0`,
    /// from the mean of `log(a + b sin)`. Unbiased, `P = 2 gain (sqrt(1 + (kX)^2) - 1)/(k X^2)`.
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        let pole = Pole::new(T::one(), &Scaled::new(self.scale(), sweep));
        let p = T::two() * self.gain() * self.scale() * pole.component_beyond();
        finite(DescribingFunction { f0: self.gain() * pole.mean_beyond(), p, q: T::zero() }, sweep)
    }
}
