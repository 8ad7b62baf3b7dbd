//! Two arithmetics for one formula: `f64` for speed, 71 digits where a verdict depends on them.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use f256::f256;

/// Real numbers of a fixed precision.
pub trait Scalar:
    Copy
    + Debug
    + PartialOrd
    + Send
    + Sync
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
{
    /// Zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// Order p of Taylor series: e/(p + 1)! is below the rounding.
    const ORDER: usize;
    /// Unit roundoff.
    const ROUNDING: f64;

    /// This number, exactly.
    fn from_f64(value: f64) -> Self;

    /// This count, exactly below 2^53.
    fn from_count(count: usize) -> Self {
        Self::from_f64(count as f64)
    }

    /// The number as a float, to its last bit but one.
    fn to_f64(self) -> f64;

    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);

    /// Exponential.
    #[must_use]
    fn exp(self) -> Self;

    /// Hyperbolic tangent, `1 - 2/(1 + e^(2 x))`.
    #[must_use]
    fn tanh(self) -> Self {
        let two = Self::ONE + Self::ONE;
        Self::ONE - two / (Self::ONE + (two * self).exp())
    }

    /// Magnitude.
    #[must_use]
    fn abs(self) -> Self {
        if self < Self::ZERO { -self } else { self }
    }
}

impl Scalar for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const ORDER: usize = 22;
    const ROUNDING: f64 = f64::EPSILON / 2.0;

    fn from_f64(value: f64) -> Self {
        value
    }

    fn to_f64(self) -> f64 {
        self
    }

    fn sin_cos(self) -> (Self, Self) {
        f64::sin_cos(self)
    }

    fn exp(self) -> Self {
        f64::exp(self)
    }

    fn tanh(self) -> Self {
        f64::tanh(self)
    }
}

/// Bits of the fraction of [`f256`] in the upper half of its representation.
const FRACTION_BITS: u32 = 108;
/// Bias of the exponent of [`f256`].
const EXPONENT_BIAS: i32 = 262_143;

impl Scalar for f256 {
    const ZERO: Self = f256::ZERO;
    const ONE: Self = f256::ONE;
    const ORDER: usize = 55;
    const ROUNDING: f64 = 4.6e-72;

    fn from_f64(value: f64) -> Self {
        Self::from(value)
    }

    fn sin_cos(self) -> (Self, Self) {
        f256::sin_cos(&self)
    }

    fn exp(self) -> Self {
        f256::exp(&self)
    }

    fn to_f64(self) -> f64 {
        // The crate has no such conversion. 108 bits of the fraction are more than a float holds.
        let upper = self.to_bits().0;
        let fraction = upper & ((1 << FRACTION_BITS) - 1);
        let exponent = ((upper >> FRACTION_BITS) & 0x7_ffff) as i32 - EXPONENT_BIAS;
        let magnitude = match exponent {
            ..=-1000 => 0.0,
            -999..=1000 => {
                let significand = (fraction | (1 << FRACTION_BITS)) as f64 / (1_u128 << FRACTION_BITS) as f64;
                significand * 2.0_f64.powi(exponent)
            }
            _ => f64::INFINITY,
        };
        if self.is_nan() { f64::NAN } else { magnitude.copysign(if upper >> 127 == 0 { 1.0 } else { -1.0 }) }
    }
}

#[cfg(test)]
mod tests {
    use dashu_float::FBig;
    use dashu_float::round::mode::HalfEven;
    use rand::{RngExt, SeedableRng};

    use super::*;

    type Oracle = FBig<HalfEven, 2>;

    fn oracle(value: f64) -> Oracle {
        Oracle::try_from(value).unwrap().with_precision(400).value()
    }

    /// Sum of a value's leading floats, exact to 71 digits.
    fn exactly(mut value: f256) -> Oracle {
        let mut sum = oracle(0.0);
        for _ in 0..8 {
            let float = value.to_f64();
            sum += oracle(float);
            value -= f256::from(float);
        }
        sum
    }

    #[test]
    fn arithmetic_agrees_with_another_crate_to_71_digits() {
        let mut random = rand_pcg::Pcg64::seed_from_u64(54);
        let mut draw = || {
            let float: f64 = random.random_range(-1.0..1.0);
            let fine: f64 = random.random_range(-1.0..1.0);
            let close = f64::powi(2.0, -random.random_range(0..180));
            (f256::from(float) + f256::from(fine * close), oracle(float) + oracle(fine * close))
        };
        for _ in 0..2000 {
            let ((a, exact_a), (b, exact_b)) = (draw(), draw());
            // Differences of neighbours: digits cancel.
            let (near, exact_near) = (a + b * f256::from(1e-30), exact_a.clone() + exact_b.clone() * oracle(1e-30));
            for (found, exact) in [
                (a + b, exact_a.clone() + exact_b.clone()),
                (near - a, exact_near - exact_a.clone()),
                (a * b, exact_a.clone() * exact_b.clone()),
                (a / b, exact_a / exact_b),
            ] {
                let error = (exactly(found) - exact).to_f64().value().abs();
                assert!(error <= 8.0 * f256::ROUNDING * (1.0 + found.to_f64().abs()), "{found:?}: off by {error:e}");
            }
        }
    }

    #[test]
    fn floats_survive_the_way_there_and_back() {
        for value in [0.0, 1.0, -1.0 / 3.0, 1.23e-280, -4.5e280, f64::MIN_POSITIVE.sqrt()] {
            assert_eq!(f256::from(value).to_f64(), value);
        }
        assert!((f256::ONE / f256::ZERO).to_f64().is_infinite());
    }

    #[test]
    fn the_order_leaves_a_remainder_below_the_rounding() {
        fn remainder<S: Scalar>() -> f64 {
            (1..=S::ORDER + 1).fold(std::f64::consts::E, |rest, k| rest / k as f64)
        }
        assert!(remainder::<f64>() < f64::ROUNDING);
        assert!(remainder::<f256>() < f256::ROUNDING);
    }
}
