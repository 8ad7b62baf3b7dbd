//! The formats, and error bounds of their elementary functions.

use core::fmt::Debug;

/// A binary floating-point format, rounded to nearest.
pub(crate) trait Format: Copy + Debug + PartialEq + Send + Sync + 'static {
    /// Half the distance from 1 to the next larger number.
    const UNIT: f64;
    /// Half the least number above zero.
    const TINY: f64;
    /// Results up to this do not overflow.
    const LARGEST: f64;
    /// Error of `libm`'s functions of a real number, in units in the last place of the exact value.
    ///
    /// In single precision it is measured, at all arguments; in double precision it is assumed, and looked for by sampling.
    const FUNCTIONS: Units;
    /// The number nearest to `value`.
    fn nearest(value: f64) -> f64;
}

/// Errors of functions in units in the last place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Units {
    /// Sine and cosine.
    pub(crate) sin_cos: f64,
    /// Tangent.
    pub(crate) tan: f64,
    /// Inverse sine, at arguments up to 1.
    pub(crate) asin: f64,
    /// Inverse tangent.
    pub(crate) atan: f64,
    /// Exponential function, and less 1.
    pub(crate) exp: f64,
    /// Natural logarithm, and of 1 more.
    pub(crate) ln: f64,
    /// Hyperbolic sine, cosine, tangent, and inverse tangent.
    pub(crate) hyperbolic: f64,
    /// A power.
    pub(crate) pow: f64,
}

/// f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Double;

/// f32.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Single;

impl Format for Double {
    const UNIT: f64 = f64::EPSILON / 2.0;
    const TINY: f64 = 5e-324;
    const LARGEST: f64 = 1e308;
    const FUNCTIONS: Units =
        Units { sin_cos: 1.0, tan: 1.0, asin: 1.0, atan: 1.0, exp: 1.0, ln: 1.0, hyperbolic: 2.5, pow: 1.0 };
    fn nearest(value: f64) -> f64 {
        value
    }
}

impl Format for Single {
    const UNIT: f64 = f32::EPSILON as f64 / 2.0;
    const TINY: f64 = 1e-45;
    const LARGEST: f64 = 3.4e38;
    const FUNCTIONS: Units =
        Units { sin_cos: 1.0, tan: 1.0, asin: 1.0, atan: 1.0, exp: 1.0, ln: 1.0, hyperbolic: 2.5, pow: 1.0 };
    #[allow(clippy::cast_possible_truncation, reason = "this is the rounding")]
    fn nearest(value: f64) -> f64 {
        f64::from(value as f32)
    }
}
