//! Directed rounding of `+ - * / sqrt` from round-to-nearest arithmetic.
//!
//! IEEE 754 rounds these five correctly: the exact result lies within a step of the rounded result. The sign of the
//! rounding error, where it can be had without rounding (Knuth's two-sum; products of the significands as integers),
//! shows on which side; where it cannot (near overflow and underflow) the step is taken in any case. An exact result is
//! therefore kept, and `1 - u^2` does not fall below zero at `|u| = 1`.

/// A rounded result, and whether the exact result may lie above or below it.
#[derive(Clone, Copy)]
pub(super) struct RoundedResult {
    nearest: f64,
    above: bool,
    below: bool,
}

impl RoundedResult {
    #[inline]
    fn exact(nearest: f64) -> Self {
        Self { nearest, above: false, below: false }
    }

    /// Zero, for a result that is not: it has that sign.
    #[inline]
    fn underflow(nearest: f64) -> Self {
        Self { nearest, above: nearest.is_sign_positive(), below: nearest.is_sign_negative() }
    }

    /// From an integer with the sign of `abs(exact) - abs(nearest)`.
    #[inline]
    fn by_excess(nearest: f64, excess: Option<i64>) -> Self {
        match excess {
            Some(excess) => {
                let error = if nearest < 0.0 { -excess } else { excess };
                Self { nearest, above: error > 0, below: error < 0 }
            }
            None => Self { nearest, above: true, below: true },
        }
    }

    /// The largest number that is shown not to exceed the exact result.
    #[inline]
    pub(super) fn down(self) -> f64 {
        // As f64::next_down, but free of branches, as roundings are not to be foreseen. A zero with anything below it is
        // negative, and the lower infinity stays.
        let bits = self.nearest.to_bits();
        let outward = if self.nearest.is_sign_negative() { 1 } else { u64::MAX };
        let step = self.below & (self.nearest > f64::NEG_INFINITY);
        f64::from_bits(bits.wrapping_add(if step { outward } else { 0 }))
    }

    /// The smallest number that is shown not to be below the exact result.
    #[inline]
    pub(super) fn up(self) -> f64 {
        -Self { nearest: -self.nearest, above: self.below, below: self.above }.down()
    }
}

#[inline]
pub(super) fn sum(a: f64, b: f64) -> RoundedResult {
    let nearest = a + b;
    let b_part = nearest - a;
    // An overflow makes an infinite difference here, hence NaN: the step is taken.
    let error = (a - (nearest - b_part)) + (b - b_part);
    RoundedResult { nearest, above: !(error <= 0.0), below: !(error >= 0.0) }
}

/// With `0 * inf = 0`, as bounds of a set of real numbers need it.
#[inline]
pub(super) fn product(a: f64, b: f64) -> RoundedResult {
    if a == 0.0 || b == 0.0 {
        return RoundedResult::exact(0.0);
    }
    let nearest = a * b;
    if nearest == 0.0 {
        RoundedResult::underflow(nearest)
    } else {
        RoundedResult::by_excess(nearest, product_less(a, b, nearest))
    }
}

#[inline]
pub(super) fn quotient(a: f64, b: f64) -> RoundedResult {
    let nearest = a / b;
    if nearest == 0.0 {
        return if a == 0.0 { RoundedResult::exact(nearest) } else { RoundedResult::underflow(nearest) };
    }
    RoundedResult::by_excess(nearest, product_less(nearest, b, a).map(i64::wrapping_neg))
}

#[inline]
pub(super) fn square_root(a: f64) -> RoundedResult {
    let nearest = libm::sqrt(a);
    if nearest == 0.0 {
        return RoundedResult::exact(0.0);
    }
    RoundedResult::by_excess(nearest, product_less(nearest, nearest, a).map(i64::wrapping_neg))
}

/// `abs(a b) - abs(c)` in units of its own, for a c that is `a b` rounded, or of which `a` is the rounded quotient or root;
/// `None` where any of the three is no normal number.
///
/// With significands of 53 bits as integers, the difference is below `2^62` in magnitude: its last 64 bits determine it.
#[inline]
fn product_less(a: f64, b: f64, c: f64) -> Option<i64> {
    let [a, b, c] = [a, b, c].map(f64::to_bits);
    let exponent = |bits: u64| bits >> 52 & 0x7ff;
    let significand = |bits: u64| bits & ((1 << 52) - 1) | 1 << 52;
    let normal = |bits: u64| exponent(bits).wrapping_sub(1) < 2046;
    if !(normal(a) & normal(b) & normal(c)) {
        return None;
    }
    // 52 or 53: the exponents' biases cancel but for a single bias.
    let shift = (exponent(c) + 1075).wrapping_sub(exponent(a) + exponent(b));
    let product = significand(a).wrapping_mul(significand(b));
    Some(product.wrapping_sub(significand(c) << (shift & 63)).cast_signed())
}
