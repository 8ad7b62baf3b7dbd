use super::parameter::characteristic;
use super::{Branch, Kernel, PiecewiseLinear, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Three-position relay: `level sgn(x)` outside the dead zone, zero within.
    "relay-dead-zone" RelayDeadZone {
        /// Output level C, in output units.
        level: Positive = 1.0,
        /// Half-width of the dead zone, in input units.
        dead_zone: NonNegative,
    }
}

impl<T: Real> PiecewiseLinear for RelayDeadZone<T> {
    type Number = T;

    fn value(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        (x.abs() - self.dead_zone).select(T::zero, || x.select(|| -self.level, || self.level))
    }
    fn kernels(&self, _: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        report(Kernel::step_above(self.dead_zone, self.level));
        report(Kernel::step_below(-self.dead_zone, -self.level));
    }
}
