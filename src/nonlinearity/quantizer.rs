use super::parameter::characteristic;
use super::{Branch, Kernel, PiecewiseLinear, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Quantizer, mid-tread: `step` times the whole number nearest to `x / step`. Without bound.
    "quantizer" Quantizer {
        /// Size of a step, the same in input and output units.
        step: Positive,
    }
}

impl<T: Real> PiecewiseLinear for Quantizer<T> {
    type Number = T;

    fn value(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        self.step * (x / self.step + T::from_f64(0.5)).floor()
    }
    /// One step for each tread inside the sweep: the cost grows with amplitude over step.
    fn kernels(&self, sweep: &Sinusoid<T>, report: &mut dyn FnMut(Kernel<T>)) {
        let half = T::from_f64(0.5);
        let treads = |excursion: T| (excursion / self.step + half).bounds().1;
        let at = |tread: f64| self.step * (T::from_f64(tread) - half);
        let (above, below) = (treads(sweep.maximum()), treads(-sweep.minimum()));
        let mut tread = 1.0;
        while tread <= above.max(below) {
            if tread <= above {
                report(Kernel::step_above(at(tread), self.step));
            }
            if tread <= below {
                report(Kernel::step_below(-at(tread), -self.step));
            }
            tread += 1.0;
        }
    }
}
