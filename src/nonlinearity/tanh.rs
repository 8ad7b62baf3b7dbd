use super::parameter::characteristic;
use super::{Branch, Characteristic, Sinusoid};
use crate::numeric::Real;

characteristic! {
    /// Hyperbolic tangent: `gain tanh(scale x)`, a smooth saturation at `gain`.
    "tanh" Tanh {
        /// Factor of the output, in output units.
        gain: Finite = 1.0,
        /// Argument per input unit.
        scale: Positive = 1.0,
    }
}

impl<T: Real> Characteristic for Tanh<T> {
    type Number = T;

    fn has_memory(&self) -> bool {
        false
    }

    fn output(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        self.gain * (self.scale * x).tanh()
    }
    /// None; what is reported brackets the bend, which a quadrature of a long sweep would miss: beyond, the output is at
    /// its limit to within 1e-17.
    fn kinks(&self, _: &Sinusoid<T>, report: &mut dyn FnMut(T)) {
        let bend = T::from_f64(20.0) / self.scale;
        [-bend, T::zero(), bend].into_iter().for_each(report);
    }
}
