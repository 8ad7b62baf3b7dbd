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
    /// A line and the departure from it: with slopes of equal sign, the line of the smaller slope avoids cancellation.
    fn kernels(&self, _: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
        let (inner, outer, at) = (self.inner_slope, self.outer_slope, self.breakpoint);
        let band = |slope| Kernel::Band { origin: T::zero(), lower: -at, upper: at, slope };
        let is_part = |(least, most): (f64, f64)| least >= 0.0 && most <= 1.0;
        if is_part((outer / inner).bounds()) {
            report(Kernel::Line { slope: outer });
            report(band(inner - outer));
            return;
        }
        let beyond = if is_part((inner / outer).bounds()) {
            report(Kernel::Line { slope: inner });
            outer - inner
        } else {
            report(band(inner));
            outer
        };
        report(Kernel::ramp_above(at, beyond));
        report(Kernel::ramp_below(-at, -beyond));
    }
}
