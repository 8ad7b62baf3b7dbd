//! Describing functions of the sine and the hyperbolic sine, by Bessel functions.

use super::closed_form::{ClosedForm, finite};
use super::{DescribingError, DescribingFunction};
use crate::nonlinearity::{Sine, Sinh, Sinusoid};
use crate::numeric::Scalar;
use crate::numeric::special::{bessel_i0_scaled, bessel_i1_scaled, bessel_j0, bessel_j1};

impl<T: Scalar> ClosedForm for Sine<T> {
    /// `F_0 = gain sin(kB) J_0(kX)`, `P = 2 gain cos(kB) J_1(kX)/X`, `Q = 0`, k the frequency (Jacobi-Anger expansion).
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        let (bias, amplitude) = (self.frequency() * sweep.bias(), self.frequency() * sweep.amplitude());
        let f0 = self.gain() * bias.sin() * bessel_j0(amplitude);
        let p = self.gain() * T::two() * bias.cos() * (bessel_j1(amplitude) / sweep.amplitude());
        finite(DescribingFunction { f0, p, q: T::zero() }, sweep)
    }
}

impl<T: Scalar> ClosedForm for Sinh<T> {
    /// `F_0 = gain sinh(kB) I_0(kX)`, `P = 2 gain cosh(kB) I_1(kX)/X`, `Q = 0`, k the scale.
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        let (bias, amplitude) = (self.scale() * sweep.bias(), self.scale() * sweep.amplitude());
        let growth = self.gain() * amplitude.exp();
        let f0 = growth * bias.sinh() * bessel_i0_scaled(amplitude);
        let p = growth * T::two() * bias.cosh() * (bessel_i1_scaled(amplitude) / sweep.amplitude());
        finite(DescribingFunction { f0, p, q: T::zero() }, sweep)
    }
}
