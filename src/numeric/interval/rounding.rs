//! Directed rounding of `+ - * / sqrt` from round-to-nearest arithmetic.
//!
//! IEEE 754 rounds these five correctly, so the exact result lies within one step of the rounded one. The sign of the
//! rounding error, where it can be had without rounding (Knuth's two-sum; products of the significands as integers), says
//! on which side; where it cannot (near overflow and underflow) the step is taken in any case. An exact result is
//! therefore kept, and `1 - u^2` does not fall below zero at `|u| = 1`.

/// A rounded result with a number that has the sign of `exact - rounded`; NaN where the sign is not known.
#[derive(Clone, Copy)]
pub(super) struct Rounded {
    nearest: f64,
    error: f64,
}

impl Rounded {
    /// The largest number known not to lie above the exact result.
    #[inline]
    pub(super) fn down(self) -> f64 {
        // As f64::next_down, but free of branches, as the error's sign is not to be foreseen. A zero is taken as negative,
        // and the lower infinity stays.
        let bits = match self.nearest.to_bits() {
            0 => 1 << 63,
            bits => bits,
        };
        let outward = if bits >> 63 == 0 { u64::MAX } else { 1 };
        let stay = (self.error >= 0.0) | (self.nearest == f64::NEG_INFINITY);
        f64::from_bits(bits.wrapping_add(if stay { 0 } else { outward }))
    }

    /// The smallest number known not to lie below the exact result.
    #[inline]
    pub(super) fn up(self) -> f64 {
        -Self { nearest: -self.nearest, error: -self.error }.down()
    }

    /// A result that underflowed to zero or is zero: its sign bit is the sign of the exact result.
    #[inline]
    fn of_zero(nearest: f64, exact: bool) -> Self {
        Self { nearest, error: if exact { 0.0 } else { 1_f64.copysign(nearest) } }
    }
}

#[inline]
pub(super) fn sum(a: f64, b: f64) -> Rounded {
    let nearest = a + b;
    let b_part = nearest - a;
    // An overflow makes an infinite difference here, hence NaN: the step is taken.
    let error = (a - (nearest - b_part)) + (b - b_part);
    Rounded { nearest, error }
}

/// With `0 * inf = 0`, as bounds of a set of real numbers need it.
#[inline]
pub(super) fn product(a: f64, b: f64) -> Rounded {
    if a == 0.0 || b == 0.0 {
        return Rounded { nearest: 0.0, error: 0.0 };
    }
    let nearest = a * b;
    if nearest == 0.0 {
        return Rounded::of_zero(nearest, false);
    }
    let excess = product_less(a, b, nearest);
    Rounded { nearest, error: if nearest < 0.0 { -excess } else { excess } }
}

#[inline]
pub(super) fn quotient(a: f64, b: f64) -> Rounded {
    let nearest = a / b;
    if nearest == 0.0 {
        return Rounded::of_zero(nearest, a == 0.0);
    }
    let excess = product_less(nearest, b, a);
    Rounded { nearest, error: if nearest < 0.0 { excess } else { -excess } }
}

#[inline]
pub(super) fn square_root(a: f64) -> Rounded {
    let nearest = libm::sqrt(a);
    if nearest == 0.0 {
        return Rounded { nearest: 0.0, error: 0.0 };
    }
    Rounded { nearest, error: -product_less(nearest, nearest, a) }
}

/// A number with the sign of `abs(a b) - abs(c)`, for a c so near `a b` that one is the other's rounding or that of a factor;
/// NaN where one of the three is no normal number.
///
/// With significands of 53 bits as integers the difference is less than `2^62` in magnitude, so that its 64 last bits tell it.
#[inline]
fn product_less(a: f64, b: f64, c: f64) -> f64 {
    let [a, b, c] = [a, b, c].map(f64::to_bits);
    let exponent = |bits: u64| bits >> 52 & 0x7ff;
    let significand = |bits: u64| bits & ((1 << 52) - 1) | 1 << 52;
    // The exponents' biases cancel but for one.
    let shift = exponent(c).wrapping_add(1075).wrapping_sub(exponent(a) + exponent(b));
    let normal = |bits: u64| exponent(bits).wrapping_sub(1) < 2046;
    // Another shift cannot be for such a c.
    if !(normal(a) & normal(b) & normal(c) & (50..=54).contains(&shift)) {
        return f64::NAN;
    }
    significand(a).wrapping_mul(significand(b)).wrapping_sub(significand(c) << shift).cast_signed() as f64
}
