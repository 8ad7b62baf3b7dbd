use super::parameter::characteristic;
use super::{Branch, Characteristic, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Hyperbolic sine: `gain sinh(scale x)`.
    "sinh" Sinh {
        /// Factor of the output, in output units.
        gain: Finite = 1.0,
        /// Argument per input unit.
        scale: Positive = 1.0,
    }
}

impl<T: Real> Characteristic for Sinh<T> {
    type Number = T;

    fn has_memory(&self) -> bool {
        false
    }

    fn output(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        self.gain * (self.scale * x).sinh()
    }
    fn kinks(&self, _: &Sinusoid<T>, _: &mut dyn FnMut(T)) {}
}
