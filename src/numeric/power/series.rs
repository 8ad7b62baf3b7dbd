//! The three series, each with the same code for floats and enclosures.

#[cfg(test)]
#[path = "../../../tests/properties/private/power_series.rs"]
mod tests;

use super::PowerMoments;
use crate::numeric::real::magnitude;
use crate::numeric::{Interval, Real};

/// The series about zero serves below, the series about infinity above; the series about 1, with radius 2, between.
pub const INNER: f64 = 0.7;
pub const OUTER: f64 = 1.35;
/// Exponent from which on the two outer series converge fast enough up to `u = 1`, where their n-th term is about
/// `n^(-p - 3/2)`; the series about 1 would cancel.
pub(crate) const STEEP: f64 = 8.0;

/// m and h with their derivatives.
pub(super) struct Moments<T> {
    pub(super) m: T,
    pub(super) m_slope: T,
    pub(super) h: T,
    pub(super) h_slope: T,
}

/// A constant and how far off it may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Known {
    value: f64,
    error: f64,
}

impl Known {
    pub(super) const NOT: Self = Self { value: f64::NAN, error: f64::INFINITY };

    #[inline]
    pub(super) fn get<T: Real>(self) -> T {
        T::from_f64(self.value).inflate(self.error)
    }
}

impl From<Interval> for Known {
    fn from(enclosure: Interval) -> Self {
        Self { value: enclosure.midpoint(), error: enclosure.radius() }
    }
}

/// Numerator and denominator of the ratio of coefficient `n + 1` to coefficient n of `2F1(a, b; c; x)`.
#[inline]
pub(crate) fn step<T: Real>(a: T, b: T, c: f64, n: f64) -> [T; 2] {
    [(a + T::from_f64(n)) * (b + T::from_f64(n)), T::from_f64((c + n) * (n + 1.0))]
}

/// `2F1(a, b; c; x)` and its derivative by x, for `0 <= x <= 1`, `a <= b < c` and `c - a - b > 1`; terms below a share of
/// the derivative are omitted.
#[inline]
fn hypergeometric<T: Real>(a: T, b: T, c: f64, x: T, share: f64) -> [T; 2] {
    let ratio = |n: f64| {
        let [numerator, denominator] = step(a, b, c, n);
        numerator / denominator
    };
    // Up to the parameters' size the terms may still grow; the slope at zero is the first.
    let (least, x_most) = (2_f64.max(-a.bounds().0), magnitude(x).min(1.0));
    let (mut sum, mut slope) = (T::zero(), T::zero());
    // Term n over x.
    let (mut term, mut n) = (ratio(0.0), 1.0);
    while n * magnitude(term) > share * magnitude(sum) || (n < least && magnitude(term) > 0.0) {
        sum = sum + term;
        slope = slope + T::from_f64(n) * term;
        term = term * (ratio(n) * x);
        n += 1.0;
    }
    // With `step = 1 - s/(k + 1)`, where s grows with k, and `r = (n + 1)(1 - x) + x s(n)`, term k over term k + 1 satisfies
    // `term(k) (r - 1) <= k term(k) - (k + 1) term(k + 1)` and `k term(k) (r - 2) <= (k - 1) k term(k) - k (k + 1) term(k + 1)`:
    // sums from n on telescope. Doubled for the rounding of this bound.
    let (low, high) = (a.bounds().0, b.bounds().0);
    let s = (n * (1.0 + c - low - high) + c - low * high) / (n + c);
    let rest = 2.0 * n * magnitude(term);
    let r = (n + 1.0) * (1.0 - x_most) + x_most * s;
    let (rest, slope_rest) =
        if rest > 0.0 { (rest / (r - 1.0).max(0.0), rest * n / (r - 2.0).max(0.0)) } else { (0.0, 0.0) };
    [T::one() + x * sum.inflate(rest), slope.inflate(slope_rest)]
}

impl PowerMoments {
    /// `m = m'(0) u 2F1((1-p)/2, (1-p)/2; 3/2; u^2)`, every term positive; `m'(0) = (p + 1) <abs(sin)^(p+1)>`.
    #[inline]
    pub(super) fn about_zero<T: Real>(&self, u: T, share: f64) -> Moments<T> {
        let a = T::from_f64(0.5) * (T::one() - T::from_f64(self.exponent));
        let square = u.square();
        // The derivative counts no more than the square times it.
        let [sum, slope] = hypergeometric(a, a, 1.5, square, share / magnitude(square));
        let start = self.slope_at_zero.get::<T>();
        let m_slope = start * (sum + T::two() * square * slope);
        self.moments(u, start * u * sum, m_slope, (T::one() - square) * m_slope)
    }

    /// In `v = 1/u`, with `X^p` replaced by `abs(B)^p`: `m = 2F1(-p/2, (1-p)/2; 1; v^2)`, the binomial series, and
    /// `(1 + p) h = p v m + (1 - v^2) m'`.
    #[inline]
    pub(super) fn about_infinity<T: Real>(&self, v: T, share: f64) -> Moments<T> {
        let (p, half, square) = (T::from_f64(self.exponent), T::from_f64(0.5), v.square());
        let [m, slope] = hypergeometric(-half * p, half * (T::one() - p), 1.0, square, share);
        let twice = T::two() * slope;
        let h_over_v = (p * m + (T::one() - square) * twice) / (T::one() + p);
        Moments { m, m_slope: twice * v, h: v * h_over_v, h_slope: p * h_over_v - twice }
    }

    /// In `z = (1 - u)/2`: `m = alpha sum a_n z^n + c sum b_j z^(p + 1/2 + j)`, the exponents of the equation at `u = 1`.
    ///
    /// With `p + 1/2 = N + delta` the coefficients a_n from `n = N` on and c grow like `1/delta` and cancel; at `delta = 0`
    /// they leave a logarithm. Hence terms of equal whole order are paired, `(A_j - B_j w abs(z)^delta)/delta`, and the
    /// recurrence runs on `B_j` and on `D_j = (A_j - B_j)/delta`, which stays finite.
    #[inline]
    pub(super) fn about_one<T: Real>(&self, u: T, z: T, share: f64) -> Moments<T> {
        let (p, half) = (T::from_f64(self.exponent), T::from_f64(0.5));
        let (order, delta) = Self::order_and_delta::<T>(self.exponent);
        // Derivatives by z; `over` is `(-z)^N/z`.
        let (mut m, mut slope) = (T::zero(), T::zero());
        let (mut term, mut over, mut n) = (self.at_one.get::<T>(), -T::one(), 0.0);
        loop {
            m = m + term;
            n += 1.0;
            if n >= order {
                break;
            }
            let [numerator, denominator] = analytic_step(p, T::from_f64(n - 1.0));
            let next = term * (numerator / denominator);
            slope = slope + T::from_f64(n) * next;
            term = next * z;
            over = over * -z;
        }
        if magnitude(z) <= 0.0 {
            // By the equation itself, at the end of its range.
            let smooth = self.exponent > 0.5;
            let m_slope = if smooth { p * p * m / (T::two() * p - T::one()) } else { T::from_f64(f64::INFINITY) };
            return self.moments(u, m, m_slope, T::zero());
        }

        let [weight, excess] = self.pairs.sides[usize::from(z.bounds().0 < 0.0)].map(Known::get::<T>);
        let log = z.abs().ln();
        let (power, level) = if delta.bounds() == (0.0, 0.0) {
            (T::one(), log)
        } else {
            let growth = (delta * log).exp_m1();
            (T::one() + growth, growth / delta)
        };
        let level = excess * power + level;
        let weight = weight * power;
        let (reach, enough) = (magnitude(over * z), share * magnitude(m));
        // Of `z^j (D_j - B_j level)`, of j times that, and of `z^j B_j`.
        let (mut pairs, mut moving, mut tail) = (T::zero(), T::zero(), T::zero());
        let (mut b, mut d, mut j) = (self.pairs.b.get::<T>(), self.pairs.d.get::<T>(), 0.0);
        loop {
            let pair = d - b * level;
            (pairs, moving, tail) = (pairs + pair, moving + T::from_f64(j) * pair, tail + b);
            // For `abs(z) <= 1/4`: B falls, D grows by at most `4 B/(j + 1/2)` a step, hence the slope's terms from the
            // next on add up to less than this. Doubled for the rounding of this bound.
            let rest =
                2.0 * (order + j + 1.0) * (magnitude(d) + magnitude(b) * (magnitude(level) + magnitude(weight) + 4.0));
            if !(rest * reach > enough) {
                m = m + over * z * pairs.inflate(rest);
                slope = slope + over * (T::from_f64(order) * pairs + moving - weight * tail).inflate(rest);
                return self.moments(u, m, -half * slope, -T::two() * z * (T::one() - z) * slope);
            }
            j += 1.0;
            [b, d] = paired_step(order, delta, j, [z * b, z * d]);
        }
    }

    /// From m, its derivative, and `(1 - u^2) m'`.
    #[inline]
    fn moments<T: Real>(&self, u: T, m: T, m_slope: T, weighted_slope: T) -> Moments<T> {
        let p = T::from_f64(self.exponent);
        Moments { m, m_slope, h: (weighted_slope + p * u * m) / (T::one() + p), h_slope: p * m - u * m_slope }
    }
}

/// Numerator and denominator of the ratio of coefficient `k + 1` to coefficient k of a series in `(1 - u)/2` that obeys the
/// equation; k need not be whole.
#[inline]
pub(crate) fn analytic_step<T: Real>(p: T, k: T) -> [T; 2] {
    let away = k - p;
    [away * away, (away + T::from_f64(0.5)) * (k + T::one())]
}

/// `B_j` and `D_j = (A_j - B_j)/delta` from those before, where `A_j = A_(j-1) (j - 1/2 - delta)^2/((j - delta)(N + j))` and
/// `B_j = B_(j-1) (j - 1/2)^2/((N + j + delta) j)`.
#[inline]
pub(crate) fn paired_step<T: Real>(order: f64, delta: T, j: f64, [b, d]: [T; 2]) -> [T; 2] {
    let half_square = (j - 0.5) * (j - 0.5);
    let (index, away) = (T::from_f64(j), T::from_f64(j - 0.5) - delta);
    let of_b = (T::from_f64(order + j) + delta) * index;
    let spread = T::from_f64(half_square * (2.0 * j + order)) - (T::from_f64(2.0 * j - 1.0) - delta) * of_b;
    let b = b / of_b;
    [b * T::from_f64(half_square), (d * away.square() + b * spread) / ((index - delta) * T::from_f64(order + j))]
}
