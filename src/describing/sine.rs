//! Describing functions of the sine and the hyperbolic sine, by Bessel functions.

use super::closed_form::{ClosedForm, finite};
use super::{DescribingError, DescribingFunction};
use crate::nonlinearity::{Sine, Sinh, Sinusoid};
use crate::numeric::special::Special;

impl<T: Special> ClosedForm for Sine<T> {
    /// `F_0 = gain sin(kB) J_0(kX)`, `P = 2 gain cos(kB) J_1(kX)/X`, `Q = 0`, k the frequency (Jacobi-Anger expansion).
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        let (bias, amplitude) = (self.frequency() * sweep.bias(), self.frequency() * sweep.amplitude());
        let [j0, j1] = amplitude.bessel_j();
        let f0 = self.gain() * bias.sin() * j0;
        let p = self.gain() * T::two() * bias.cos() * (j1 / sweep.amplitude());
        finite(DescribingFunction { f0, p, q: T::zero() }, sweep)
    }
}

impl<T: Special> ClosedForm for Sinh<T> {
    /// `F_0 = gain sinh(kB) I_0(kX)`, `P = 2 gain cosh(kB) I_1(kX)/X`, `Q = 0`, k the scale.
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        let (bias, amplitude) = (self.scale() * sweep.bias(), self.scale() * sweep.amplitude());
        let growth = self.gain() * amplitude.exp();
        let [i0, i1] = amplitude.bessel_i_scaled();
        let f0 = growth * bias.sinh() * i0;
        let p = growth * T::two() * bias.cosh() * (i1 / sweep.amplitude());
        finite(DescribingFunction { f0, p, q: T::zero() }, sweep)
    }
}
