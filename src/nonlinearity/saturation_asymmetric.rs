use super::parameter::characteristic;
use super::{Branch, Kernel, PiecewiseLinear, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Saturation between two unrelated limits: `slope x` from `lower` to `upper`, constant outside.
    "saturation-asymmetric" SaturationAsymmetric {
        /// Slope of the linear part, output units per input unit.
        slope: Finite = 1.0,
        /// Input at the lower limit, in input units.
        lower: Finite,
        /// Input at the upper limit, above `lower`, in input units.
        upper: Finite,
    }
    where lower < upper
}

impl<T: Real> PiecewiseLinear for SaturationAsymmetric<T> {
    type Number = T;

    fn value(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        self.slope * x.max(self.lower).min(self.upper)
    }
    fn kernels(&self, _: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        report(Kernel::Band { origin: T::zero(), lower: self.lower, upper: self.upper, slope: self.slope });
    }
}
