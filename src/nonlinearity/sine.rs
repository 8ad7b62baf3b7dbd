use super::parameter::characteristic;
use super::{Branch, Characteristic, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Sine: `gain sin(frequency x)`.
    "sine" Sine {
        /// Factor of the output, in output units.
        gain: Finite = 1.0,
        /// Radians per input unit.
        frequency: Positive = 1.0,
    }
}

impl<T: Real> Characteristic for Sine<T> {
    type Number = T;

    fn has_memory(&self) -> bool {
        false
    }

    fn output(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        self.gain * (self.frequency * x).sin()
    }
    fn kinks(&self, _: &Sinusoid<T>, _: &mut dyn FnMut(T)) {}
}
