//! Quotients with a removable singularity at zero, free of cancellation there.

use super::Real;

/// Below this magnitude the series is used; the terms kept leave less than 1e-17 of the sum.
const SMALL: f64 = 0.1;

/// `sum z^k c_k` by Horner's rule, where `c_k / c_(k-1)` is `ratio(k)`.
fn series<T: Real>(z: T, terms: u32, ratio: impl Fn(f64) -> f64) -> T {
    (1..=terms).rev().fold(T::one(), |sum, k| T::one() + z * T::from_f64(ratio(f64::from(k))) * sum)
}

/// `ln(1 + x)/x`, one at zero; domain `x > -1`.
#[must_use]
pub fn ln_1p_ratio<T: Real>(x: T) -> T {
    (x.abs() - T::from_f64(SMALL)).select(
        || {
            // ln(1 + x) = 2 atanh(x/(2 + x))
            let half = T::one() / (T::two() + x);
            T::two() * half * atanh_series((x * half).square(), 6)
        },
        || x.ln_1p() / x,
    )
}

/// `(exp(x) - 1)/x`, one at zero.
#[must_use]
pub fn exp_m1_ratio<T: Real>(x: T) -> T {
    (x.abs() - T::from_f64(SMALL)).select(|| series(x, 11, |k| 1.0 / (k + 1.0)), || x.exp_m1() / x)
}

/// `sinh(sqrt z)/sqrt z`, which is `sin(sqrt -z)/sqrt -z` for negative z; one at zero.
#[must_use]
pub fn sinh_root_ratio<T: Real>(z: T) -> T {
    around_zero(
        z,
        0.25,
        || series(z, 7, |k| 1.0 / (2.0 * k * (2.0 * k + 1.0))),
        |root| root.sin() / root,
        |root| root.sinh() / root,
    )
}

/// `cosh(sqrt z)`, which is `cos(sqrt -z)` for negative z.
#[must_use]
pub fn cosh_root<T: Real>(z: T) -> T {
    around_zero(z, 0.25, || series(z, 7, |k| 1.0 / (2.0 * k * (2.0 * k - 1.0))), T::cos, T::cosh)
}

/// [`cosh_root`] at z, and its divided difference between z and w; both within 1.75 of zero.
#[must_use]
pub fn cosh_root_difference<T: Real>(z: T, w: T) -> (T, T) {
    series_difference(z, w, |k| 1.0 / (2.0 * k * (2.0 * k - 1.0)))
}

/// [`sinh_root_ratio`] at z, and its divided difference between z and w; both within 1.75 of zero.
#[must_use]
pub fn sinh_root_difference<T: Real>(z: T, w: T) -> (T, T) {
    series_difference(z, w, |k| 1.0 / (2.0 * k * (2.0 * k + 1.0)))
}

/// Horner's rule as in [`series`], for the value at z and the divided difference between z and w.
fn series_difference<T: Real>(z: T, w: T, ratio: impl Fn(f64) -> f64) -> (T, T) {
    let start = (T::one(), T::zero());
    (1_u32..=10).rev().fold(start, |(value, difference), k| {
        let ratio = T::from_f64(ratio(f64::from(k)));
        (T::one() + ratio * z * value, ratio * (value + w * difference))
    })
}

/// `atanh(sqrt z)/sqrt z`, which is `atan(sqrt -z)/sqrt -z` for negative z; one at zero; domain `z < 1`.
#[must_use]
pub fn atanh_root_ratio<T: Real>(z: T) -> T {
    around_zero(z, 0.04, || atanh_series(z, 11), |root| root.atan() / root, |root| root.atanh() / root)
}

/// `x - ln(1 + x)` without cancellation near zero; domain `x > -1`.
#[must_use]
pub fn minus_ln_1p<T: Real>(x: T) -> T {
    (x.abs() - T::from_f64(SMALL)).select(
        || {
            // ln(1 + x) = 2 (s + s^3/3 + s^5/5 + ...) with s = x/(2 + x), and x - 2 s = x s.
            let s = x / (T::two() + x);
            let third = T::one() / T::from_f64(3.0);
            let tail = third * series(s.square(), 6, |k| (2.0 * k + 1.0) / (2.0 * k + 3.0));
            s * (x - T::two() * s.square() * tail)
        },
        || x - x.ln_1p(),
    )
}

/// `z - tanh z` without cancellation near zero, for `z >= 0`.
#[must_use]
pub fn minus_tanh<T: Real>(z: T) -> T {
    // tanh z = z/(1 + z^2/(3 + z^2/(5 + ...))): the first quotient is subtracted by hand.
    (z - T::one()).select(
        || {
            let square = z.square();
            let tail =
                (1..=11).rev().fold(T::from_f64(25.0), |tail, k| T::from_f64(2.0 * f64::from(k) + 1.0) + square / tail);
            z * square / (tail + square)
        },
        || z - z.tanh(),
    )
}

fn atanh_series<T: Real>(z: T, terms: u32) -> T {
    series(z, terms, |k| (2.0 * k - 1.0) / (2.0 * k + 1.0))
}

/// Choice of three expressions: up to `small`, in `sqrt -z` below, in `sqrt z` above.
fn around_zero<T: Real>(
    z: T,
    small: f64,
    near: impl FnOnce() -> T,
    below: impl FnOnce(T) -> T,
    above: impl FnOnce(T) -> T,
) -> T {
    (z.abs() - T::from_f64(small)).select(near, || z.select(|| below((-z).sqrt()), || above(z.sqrt())))
}
