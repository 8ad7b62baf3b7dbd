use super::parameter::characteristic;
use super::{Branch, Kernel, PiecewiseLinear, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Absolute value: `gain abs(x)`, an even characteristic.
    "absolute" Absolute {
        /// Output units per input unit.
        gain: Finite = 1.0,
    }
}

impl<T: Real> PiecewiseLinear for Absolute<T> {
    type Number = T;

    fn value(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        self.gain * x.abs()
    }
    fn kernels(&self, _: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        report(Kernel::ramp_above(T::zero(), self.gain));
        report(Kernel::ramp_below(T::zero(), self.gain));
    }
}
