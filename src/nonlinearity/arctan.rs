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

    fn has_memory(&self) -> bool {
        false
    }

    fn output(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        self.gain * (self.scale * x).atan()
    }
    /// None; what is reported brackets the bend, which a quadrature of a long sweep would miss.
    fn kinks(&self, _: &Sinusoid<T>, report: &mut dyn FnMut(T)) {
        let bend = T::from_f64(10.0) / self.scale;
        [-bend, T::zero(), bend].into_iter().for_each(report);
    }
}
