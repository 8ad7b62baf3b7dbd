use super::parameter::characteristic;
use super::{Branch, Kernel, PiecewiseLinear, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Gain that changes at a breakpoint: slope `inner_slope` up to it, `outer_slope` beyond, continuous.
    "gain-changing" GainChanging {
        /// Slope up to the breakpoint, output units per input unit.
        inner_slope: Finite,
        /// Slope beyond the breakpoint, output units per input unit.
        outer_slope: Finite,
        /// Input magnitude at which the slope changes, in input units.
        breakpoint: Positive,
    }
}

impl<T: Real> PiecewiseLinear for GainChanging<T> {
    type Number = T;

    fn value(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        let inner = x.max(-self.breakpoint).min(self.breakpoint);
        self.inner_slope * inner + self.outer_slope * (x - inner)
    }
    fn kernels(&self, _: &Sinusoid<T>, report: &mut dyn FnMut(Kernel<T>)) {
        report(Kernel::Band {
            origin: T::zero(),
            lower: -self.breakpoint,
            upper: self.breakpoint,
            slope: self.inner_slope,
        });
        report(Kernel::ramp_above(self.breakpoint, self.outer_slope));
        report(Kernel::ramp_below(-self.breakpoint, -self.outer_slope));
    }
}
