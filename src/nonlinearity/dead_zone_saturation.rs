use super::parameter::characteristic;
use super::{Branch, Kernel, PiecewiseLinear, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Dead zone up to `half_width`, then `slope (abs(x) - half_width) sgn(x)`, constant beyond `breakpoint`.
    "dead-zone-saturation" DeadZoneSaturation {
        /// Slope between dead zone and saturation, output units per input unit.
        slope: Finite = 1.0,
        /// Half-width of the dead zone, in input units.
        half_width: NonNegative,
        /// Input magnitude, above `half_width`, beyond which the output is constant, in input units.
        breakpoint: Positive,
    }
    where half_width < breakpoint
}

impl<T: Real> PiecewiseLinear for DeadZoneSaturation<T> {
    type Number = T;

    fn value(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        let held = x.max(-self.breakpoint).min(self.breakpoint);
        self.slope * (held - held.max(-self.half_width).min(self.half_width))
    }
    fn kernels(&self, _: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        let (inner, outer, slope) = (self.half_width, self.breakpoint, self.slope);
        report(Kernel::Band { origin: inner, lower: inner, upper: outer, slope });
        report(Kernel::Band { origin: -inner, lower: -outer, upper: -inner, slope });
    }
}
