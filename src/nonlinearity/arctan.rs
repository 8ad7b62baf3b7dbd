use super::parameter::characteristic;
use super::{Branch, Characteristic, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Arc tangent: `gain atan(scale x)`, a smooth saturation at `gain pi/2`.
    "arctan" Arctan {
        /// Factor of the output, in output units.
        gain: Finite = 1.0,
        /// Argument per input unit.
        scale: Positive = 1.0,
    }
}

impl<T: Real> Characteristic for Arctan<T> {
    type Number = T;

    fn output(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        self.gain * (self.scale * x).atan()
    }
    fn kinks(&self, _: &Sinusoid<T>, _: &mut dyn FnMut(T)) {}
}
