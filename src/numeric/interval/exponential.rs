//! Exponential, logarithm and hyperbolic functions of intervals, with proved bounds.

use core::f64::consts::LOG2_E;

use super::Interval;
use super::series::Series;
use crate::numeric::Real;

/// `ln 2 = LN_2_HIGH + LN_2_LOW`; the first has 32 significant bits: its product with an exponent is exact.
pub(super) const LN_2_HIGH: f64 = 0.693_147_180_369_123_8;
pub(super) const LN_2_LOW: Interval =
    Interval { lo: 1.908_214_929_270_587_7e-10, hi: 1.908_214_929_270_587_7e-10_f64.next_up() };

const TWO: Interval = Interval { lo: 2.0, hi: 2.0 };

/// Largest argument that [`exp_m1_reduced`] is proved for.
pub(super) const REDUCED_LIMIT: f64 = 0.36;
/// `(exp(r) - 1 - r)/r^2` for `|r| <= REDUCED_LIMIT`.
pub(super) const EXP: Series<11> = Series::of_factorials(2, 1, 1.0);

/// `exp(r) - 1` for `|r| <= REDUCED_LIMIT`.
fn exp_m1_reduced(r: Interval) -> Interval {
    r + r.square() * EXP.at(r)
}

/// `(k, r)` with `x = k ln 2 + r` and `|r| <= 0.35`, for `|x| <= 746`.
fn reduce(x: f64) -> (i32, Interval) {
    let k = libm::rint(x * LOG2_E);
    let r = Interval::point(x) - Interval::point(k * LN_2_HIGH) - Interval::point(k) * LN_2_LOW;
    (k as i32, r)
}

/// `2^k` for `-1022 <= k <= 1023`.
fn power_of_two(k: i32) -> f64 {
    f64::from_bits(u64::from((k + 1023).unsigned_abs()) << 52)
}

/// `exp(x)` times 1 or 1/2.
fn scaled_exp(x: f64, halved: bool) -> Interval {
    if x > 711.0 {
        return Interval { lo: f64::MAX, hi: f64::INFINITY }; // exp(711)/2 > f64::MAX
    }
    if x < -746.0 {
        return Interval { lo: 0.0, hi: 0_f64.next_up() };
    }
    let (k, r) = reduce(x);
    let k = k - i32::from(halved);
    let mantissa = Interval::ONE + exp_m1_reduced(r);
    // In two steps, as 2^k alone may lie outside the doubles.
    mantissa * Interval::point(power_of_two(k / 2)) * Interval::point(power_of_two(k - k / 2))
}

pub(super) fn exp_at(x: f64) -> Interval {
    scaled_exp(x, false)
}

pub(super) fn exp_m1_at(x: f64) -> Interval {
    /// Up to this exponent `2^k - 1` is a double.
    const EXACT: i32 = 53;
    if x.abs() > 37.0 {
        return exp_at(x) - Interval::ONE;
    }
    let (k, r) = reduce(x);
    let reduced = exp_m1_reduced(r);
    if k == 0 {
        return reduced;
    }
    debug_assert!(k.abs() <= EXACT, "37 log2(e) is above {EXACT}");
    let scale = power_of_two(k);
    reduced * Interval::point(scale) + Interval::point(scale - 1.0)
}

/// `ln(1 + t)` for `t` within `[-0.3, 0.42]` by correcting any guess `y`: with `d = exp(-y) (t - (exp(y) - 1))`,
/// `ln(1 + t) = y + ln(1 + d)` and `d/(1 + d) <= ln(1 + d) <= d`.
pub(super) fn ln_1p_reduced(t: Interval, guess: f64) -> Interval {
    /// `-0.4 < ln 0.7`, `ln 1.42 < 0.4`: the bounds used when the guess fails.
    const RANGE: Interval = Interval { lo: -0.4, hi: 0.4 };
    if guess.is_nan() || guess.abs() > REDUCED_LIMIT {
        return RANGE;
    }
    let reduced = exp_m1_reduced(Interval::point(guess));
    let d = (t - reduced) / (Interval::ONE + reduced);
    if d.lo <= -0.5 {
        return RANGE;
    }
    let at_lower = Interval::point(d.lo);
    Interval::point(guess) + Interval { lo: (at_lower / (Interval::ONE + at_lower)).lo, hi: d.hi }
}

pub(super) fn ln_at(x: f64) -> Interval {
    if x == f64::INFINITY {
        return Interval { lo: 0.0, hi: x };
    }
    let (normal, shift) = if x < f64::MIN_POSITIVE { (x * power_of_two(54), -54) } else { (x, 0) };
    let exponent = (normal.to_bits() >> 52) as i32 - 1023;
    let mantissa = f64::from_bits(normal.to_bits() & (u64::MAX >> 12) | 1_f64.to_bits());
    // 1 + t lies between 0.707 and 1.415: t is exact.
    let (t, halvings) =
        if mantissa > core::f64::consts::SQRT_2 { (0.5 * mantissa - 1.0, 1) } else { (mantissa - 1.0, 0) };
    let k = f64::from(exponent + shift + halvings);
    let rest = Interval::point(k) * LN_2_LOW + ln_1p_reduced(Interval::point(t), libm::log1p(t));
    Interval::point(k * LN_2_HIGH) + rest
}

pub(super) fn ln_1p_at(t: f64) -> Interval {
    if (-0.29..=0.41).contains(&t) {
        ln_1p_reduced(Interval::point(t), libm::log1p(t))
    } else {
        (Interval::ONE + Interval::point(t)).increasing(ln_at)
    }
}

/// An odd increasing function from its enclosure at positive numbers.
fn odd(x: f64, at_positive: impl Fn(f64) -> Interval) -> Interval {
    if x < 0.0 { -at_positive(-x) } else { at_positive(x) }
}

pub(super) fn sinh_at(x: f64) -> Interval {
    odd(x, |x| {
        if x < 1.0 {
            let e = exp_m1_at(x);
            (e + e / (Interval::ONE + e)) / TWO
        } else {
            let half = scaled_exp(x, true);
            half - Interval::point(0.25) / half
        }
    })
}

pub(super) fn cosh_at(x: f64) -> Interval {
    let half = scaled_exp(x, true);
    let value = half + Interval::point(0.25) / half;
    Interval { lo: value.lo.max(1.0), hi: value.hi }
}

pub(super) fn tanh_at(x: f64) -> Interval {
    odd(x, |x| {
        if x > 22.0 {
            return Interval { lo: 1_f64.next_down(), hi: 1.0 }; // 1 - tanh 22 < 2 exp(-44) < 2^-53
        }
        // e/(e + 2) increases with e = exp(2 x) - 1.
        let value = exp_m1_at(2.0 * x).increasing(|e| Interval::point(e) / (Interval::point(e) + TWO));
        Interval { lo: value.lo, hi: value.hi.min(1.0) }
    })
}

pub(super) fn atanh_at(x: f64) -> Interval {
    odd(x, |x| {
        let x = Interval::point(x);
        (x * TWO / (Interval::ONE - x)).increasing(ln_1p_at) / TWO
    })
}
