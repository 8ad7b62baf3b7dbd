use super::parameter::characteristic;
use super::{Branch, Kernel, PiecewiseLinear, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Dead zone: zero up to `half_width`, then `slope (abs(x) - half_width) sgn(x)`.
    "dead-zone" DeadZone {
        /// Slope outside the dead zone, output units per input unit.
        slope: Finite = 1.0,
        /// Half-width of the dead zone, in input units.
        half_width: NonNegative,
    }
}

impl<T: Real> PiecewiseLinear for DeadZone<T> {
    type Number = T;

    fn value(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        self.slope * (x - x.max(-self.half_width).min(self.half_width))
    }
    fn kernels(&self, _: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        report(Kernel::ramp_above(self.half_width, self.slope));
        report(Kernel::ramp_below(-self.half_width, -self.slope));
    }
}
