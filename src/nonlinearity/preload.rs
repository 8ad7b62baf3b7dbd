use super::parameter::characteristic;
use super::{Branch, Branches, Kernel, PiecewiseLinear, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Preload: `slope x + level sgn(x)`, as with dry friction beside a spring.
    "preload" Preload {
        /// Slope on either side, output units per input unit.
        slope: Finite,
        /// Half the jump at zero, in output units.
        level: Finite,
    }
}

impl<T: Real> PiecewiseLinear for Preload<T> {
    type Number = T;

    fn value(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        self.slope * x + x.select(|| -self.level, || self.level)
    }
    fn kernels(&self, _: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        report(Kernel::Line { slope: self.slope });
        report(Kernel::Sign { at: T::zero(), level: self.level, branches: Branches::Both });
    }
}
