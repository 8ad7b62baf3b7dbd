use super::parameter::characteristic;
use super::{Branch, Branches, Kernel, PiecewiseLinear, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Ideal relay: `level sgn(x)`. At `x = 0`, a single point of the sweep, it gives `-level`.
    "relay" Relay {
        /// Output level C, in output units.
        level: Positive = 1.0,
    }
}

impl<T: Real> PiecewiseLinear for Relay<T> {
    type Number = T;

    fn value(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        x.select(|| -self.level, || self.level)
    }
    fn kernels(&self, _: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        report(Kernel::Sign { at: T::zero(), level: self.level, branches: Branches::Both });
    }
}
