use super::parameter::characteristic;
use super::{Branch, Characteristic, Sinusoid};
use crate::numeric::Real;
use crate::numeric::power::PowerMoments;

characteristic! {
    /// Power law: `gain sgn(x) abs(x)^exponent`. Exponent 2 is quadratic drag, 1 a linear gain, 0 the ideal relay.
    "power" Power {
        /// Output at `x = 1`, in output units over input units to the exponent.
        gain: Finite = 1.0,
        /// Exponent, dimensionless.
        exponent: Exponent,
    }
    computed {
        /// What the exponent alone decides of the moments of its output.
        moments: PowerMoments = PowerMoments::new(exponent.bounds()),
    }
}

impl<T: Real> Characteristic for Power<T> {
    type Number = T;

    fn has_memory(&self) -> bool {
        false
    }

    fn output(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        let magnitude = x.abs().pow(self.exponent);
        self.gain * x.select(|| -magnitude, || magnitude)
    }
    fn kinks(&self, _: &Sinusoid<T>, report: &mut dyn FnMut(T)) {
        report(T::zero());
    }
}
