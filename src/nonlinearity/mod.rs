//! Nonlinear characteristics: static maps, with or without memory.
//!
//! A characteristic is a small struct with named, checked parameters. It gives two independent descriptions, each
//! a check of the other: its [output](Characteristic::output) on a sinusoidal sweep, and,
//! if it is [`PiecewiseLinear`], the [kernels](Kernel) it is a sum of. Inputs and outputs carry whatever units the loop
//! has; a slope has output units per input unit.
//!
//! Each file holds a characteristic (a relay, a dead zone, ...). To add one, write its file and its line in
//! `every_characteristic` below, and its page `spec/characteristics/<name>.md`: without the page it does not
//! compile, without an independent definition in `tests/properties/catalogue.rs` the tests fail.

mod error;
mod kernel;
mod parameter;
mod sinusoid;

mod absolute;
mod affine;
mod arctan;
mod backlash;
mod custom;
mod dead_zone;
mod dead_zone_saturation;
mod gain_changing;
mod polyline;
mod polynomial;
mod power;
mod preload;
mod quantizer;
mod relay;
mod relay_dead_zone;
mod relay_dead_zone_hysteresis;
mod relay_hysteresis;
mod saturation;
mod saturation_asymmetric;
mod sine;
mod sinh;
mod tanh;

/// The registry: one line a characteristic, in the order in which they are listed.
macro_rules! every_characteristic {
    ($callback:ident) => {
        $callback![
            relay::Relay,
            relay_dead_zone::RelayDeadZone,
            relay_hysteresis::RelayHysteresis,
            relay_dead_zone_hysteresis::RelayDeadZoneHysteresis,
            saturation::Saturation,
            saturation_asymmetric::SaturationAsymmetric,
            dead_zone::DeadZone,
            dead_zone_saturation::DeadZoneSaturation,
            gain_changing::GainChanging,
            preload::Preload,
            quantizer::Quantizer,
            power::Power,
            polynomial::Polynomial,
            sine::Sine,
            sinh::Sinh,
            arctan::Arctan,
            tanh::Tanh,
            absolute::Absolute,
            polyline::Polyline,
            backlash::Backlash,
        ];
    };
}
#[cfg(feature = "std")]
pub(crate) use every_characteristic;

macro_rules! publish {
    ($($module:ident::$type:ident),+ $(,)?) => { $(pub use $module::$type;)+ };
}
every_characteristic!(publish);

pub use affine::Affine;
pub use custom::{Custom, Sum};
pub use error::NonlinearityError;
pub use kernel::{Branches, Kernel, Side};
pub use parameter::{Catalogued, ParameterDomain, ParameterSpec};
pub use sinusoid::Sinusoid;
#[cfg(feature = "std")]
pub(crate) use sinusoid::checked_amplitude;

use crate::numeric::Real;

/// Which way the input moves. A characteristic with memory answers differently on its way up and on its way down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branch {
    /// The input grows.
    Rising,
    /// The input falls.
    Falling,
}

/// A characteristic under a sinusoidal input, after the transients of its memory.
pub trait Characteristic {
    /// The arithmetic of its parameters, inputs and outputs.
    type Number: Real;

    /// Output at input `x`, somewhere on the sweep `sweep` and on its way as `branch` says. A characteristic without
    /// memory uses `x` alone.
    fn output(&self, x: Self::Number, branch: Branch, sweep: &Sinusoid<Self::Number>) -> Self::Number;

    /// Reports every input value at which the output is not smooth on this sweep.
    fn kinks(&self, sweep: &Sinusoid<Self::Number>, report: &mut dyn FnMut(Self::Number));

    /// Whether the output may depend on the branch. Where it does not, `false` saves work; `true` is never wrong.
    fn has_memory(&self) -> bool {
        true
    }

    /// Whether a periodic output exists on this sweep.
    ///
    /// # Errors
    /// [`NonlinearityError::BelowSwitching`] where a relay with memory would not switch both ways.
    fn admits(&self, sweep: &Sinusoid<Self::Number>) -> Result<(), NonlinearityError> {
        let _ = sweep;
        Ok(())
    }
}

/// A characteristic that is a sum of steps and ramps, perhaps different ones on the two branches.
pub trait PiecewiseLinear {
    /// As [`Characteristic::Number`].
    type Number: Real;

    /// As [`Characteristic::output`], written without use of the kernels.
    fn value(&self, x: Self::Number, branch: Branch, sweep: &Sinusoid<Self::Number>) -> Self::Number;

    /// Reports the kernels whose sum is [`value`](Self::value) on this sweep.
    fn kernels(&self, sweep: &Sinusoid<Self::Number>, report: impl FnMut(Kernel<Self::Number>));

    /// As [`Characteristic::admits`].
    ///
    /// # Errors
    /// [`NonlinearityError::BelowSwitching`].
    fn periodic(&self, sweep: &Sinusoid<Self::Number>) -> Result<(), NonlinearityError> {
        let _ = sweep;
        Ok(())
    }
}

impl<C: PiecewiseLinear> Characteristic for C {
    type Number = C::Number;

    fn output(&self, x: C::Number, branch: Branch, sweep: &Sinusoid<C::Number>) -> C::Number {
        self.value(x, branch, sweep)
    }
    fn kinks(&self, sweep: &Sinusoid<C::Number>, report: &mut dyn FnMut(C::Number)) {
        self.kernels(sweep, |kernel| kernel.kinks(report));
    }
    fn admits(&self, sweep: &Sinusoid<C::Number>) -> Result<(), NonlinearityError> {
        self.periodic(sweep)
    }
}
