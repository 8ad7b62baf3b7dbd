use super::parameter::characteristic;
use super::{Branch, Kernel, NonlinearityError, PiecewiseLinear, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Quantizer, mid-tread: `step` times the whole number nearest to `x / step`. Without bound.
    "quantizer" Quantizer {
        /// Size of a step, the same in input and output units.
        step: Positive,
    }
}

/// Treads that are summed at most: a few milliseconds, and more than a 16-bit converter has.
const TREADS: f64 = 1e5;

impl<T: Real> PiecewiseLinear for Quantizer<T> {
    type Number = T;

    fn value(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        self.step * (x / self.step + T::from_f64(0.5)).floor()
    }
    /// One step for each tread inside the sweep: the cost grows with amplitude over step.
    fn kernels(&self, sweep: &Sinusoid<T>, mut report: impl FnMut(Kernel<T>)) {
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

    fn periodic(&self, sweep: &Sinusoid<T>) -> Result<(), NonlinearityError> {
        // In the same arithmetic as the loop over them, which is to end.
        let treads = ((sweep.amplitude() + sweep.bias().abs()) / self.step).bounds().1;
        if treads <= TREADS {
            return Ok(());
        }
        let (amplitude, bias) = (sweep.amplitude().bounds().1, sweep.bias().bounds().1);
        Err(NonlinearityError::Treads { amplitude, bias, treads, limit: TREADS })
    }
}
