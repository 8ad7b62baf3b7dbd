use super::parameter::characteristic;
use super::{Branch, Kernel, PiecewiseLinear, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Saturation: `slope x` up to the breakpoint, constant beyond.
    "saturation" Saturation {
        /// Slope of the linear part, output units per input unit.
        slope: Finite = 1.0,
        /// Input magnitude at which the output stops to grow, in input units.
        breakpoint: Positive,
    }
}

impl<T: Real> PiecewiseLinear for Saturation<T> {
    type Number = T;

    fn value(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        self.slope * x.max(-self.breakpoint).min(self.breakpoint)
    }
    fn kernels(&self, _: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        report(Kernel::Band { origin: T::zero(), lower: -self.breakpoint, upper: self.breakpoint, slope: self.slope });
    }
}
