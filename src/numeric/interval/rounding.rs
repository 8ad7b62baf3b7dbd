//! Directed rounding of `+ - * / sqrt` from round-to-nearest arithmetic.
//!
//! IEEE 754 rounds these five correctly, so the exact result lies within one step of the rounded one. The sign of the
//! rounding error, where it can be had without rounding (Knuth's two-sum; Dekker's product with Veltkamp's splitting),
//! says on which side; where it cannot (near overflow and underflow) the step is taken in any case. An exact result is
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
    Rounded { nearest, error: product_error(a, b, nearest) }
}

#[inline]
pub(super) fn quotient(a: f64, b: f64) -> Rounded {
    let nearest = a / b;
    if nearest == 0.0 {
        return Rounded::of_zero(nearest, a == 0.0);
    }
    // The remainder of a correctly rounded quotient is a double, and so is each step towards it.
    let product = nearest * b;
    let remainder = (a - product) - product_error(nearest, b, product);
    Rounded { nearest, error: if b > 0.0 { remainder } else { -remainder } }
}

#[inline]
pub(super) fn square_root(a: f64) -> Rounded {
    let nearest = libm::sqrt(a);
    if nearest == 0.0 {
        return Rounded { nearest: 0.0, error: 0.0 };
    }
    let square = nearest * nearest;
    Rounded { nearest, error: (a - square) - product_error(nearest, nearest, square) }
}

/// `a b - fl(a b)`, exact; NaN where a partial product could overflow or underflow.
#[inline]
fn product_error(a: f64, b: f64, product: f64) -> f64 {
    /// Factors below it can be split without overflow.
    const FACTOR_LIMIT: f64 = f64::from_bits((1023 + 990) << 52);
    /// Products above it have an error whose last bit is a normal number.
    const PRODUCT_LIMIT: f64 = f64::from_bits((1023 - 900) << 52);
    let size = product.abs();
    if !(size > PRODUCT_LIMIT && size < FACTOR_LIMIT && a.abs() < FACTOR_LIMIT && b.abs() < FACTOR_LIMIT) {
        return f64::NAN;
    }
    let (a_high, a_low) = split(a);
    let (b_high, b_low) = split(b);
    ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
}

/// A number as the sum of two of at most 26 significant bits, whose products are exact.
#[inline]
fn split(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0; // 2^27 + 1
    let scaled = SPLITTER * a;
    let high = scaled - (scaled - a);
    (high, a - high)
}
