//! Circular functions of intervals and their inverses, with proved bounds.

use core::f64::consts::FRAC_2_PI;

use super::Interval;
use super::series::Series;
use crate::numeric::Real;

/// `pi/2` as three numbers of 33 significant bits, whose products with a quarter count up to 2^20 are exact, and a rest.
pub(super) const HALF_PI_PARTS: [f64; 3] =
    [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_711_166_5e-21];
pub(super) const HALF_PI_REST: Interval =
    Interval { lo: 8.478_427_660_368_9e-32, hi: 8.478_427_660_368_9e-32_f64.next_up() };
const HALF_PI: Interval = Interval { lo: core::f64::consts::FRAC_PI_2, hi: core::f64::consts::FRAC_PI_2.next_up() };

/// Largest argument whose quarters are counted; beyond it they are counted modulo four.
const REDUCTION_LIMIT: f64 = 1_048_576.0;

/// `(sin(r)/r - 1)/r^2` and `(cos(r) - 1)/r^2` by the square of r, for `|r| <= 1.2`.
pub(super) const SINE: Series<7> = Series::of_factorials(3, 2, -1.0);
pub(super) const COSINE: Series<7> = Series::of_factorials(2, 2, -1.0);

/// `(k, r)` with `x = k pi/2 + r` and `|r| < 0.79`; `None` beyond the limit.
fn reduce(x: f64) -> Option<(i32, Interval)> {
    if x.is_nan() || x.abs() > REDUCTION_LIMIT {
        return None;
    }
    let k = libm::rint(x * FRAC_2_PI);
    let [first, second, third] = HALF_PI_PARTS.map(|part| Interval::point(k * part));
    // The smallest first, but for the second: near a multiple of pi/2 it cancels the difference `x - first`.
    let r = Interval::point(x) - first - second - (third + Interval::point(k) * HALF_PI_REST);
    Some((k as i32, r))
}

/// `2/pi` to 1216 bits, the first 64 behind the point first.
const TWO_OVER_PI: [u64; 19] = [
    0xa2f9_836e_4e44_1529,
    0xfc27_57d1_f534_ddc0,
    0xdb62_9599_3c43_9041,
    0xfe51_63ab_debb_c561,
    0xb724_6e3a_424d_d2e0,
    0x0649_2eea_09d1_921c,
    0xfe1d_eb1c_b129_a73e,
    0xe882_35f5_2ebb_4484,
    0xe99c_7026_b45f_7e41,
    0x3991_d639_8353_39f4,
    0x9c84_5f8b_bdf9_283b,
    0x1ff8_97ff_de05_980f,
    0xef2f_118b_5a0a_6d1f,
    0x6d36_7ecf_27cb_09b7,
    0x4f46_3f66_9e5f_ea2d,
    0x7527_bac7_ebe5_f17b,
    0x3d07_39f7_8a52_92ea,
    0x6bfb_5fb1_1f8d_5d08,
    0x5603_3046_fc7b_6bab,
];

/// [`reduce`] with the count modulo four, for `|x| >= 1` and however large: as many bits of `2/pi` as decide.
fn reduce_large(x: f64) -> (i32, Interval) {
    /// From here on rounding to a double covers the truncation of the product.
    const LONG: u128 = 1 << 60;
    let bits = x.abs().to_bits();
    let (significand, exponent) = (bits & ((1 << 52) - 1) | 1 << 52, (bits >> 52) as usize);
    // x = significand 2^(exponent - 1075); words that give multiples of four are skipped.
    let skipped = exponent.saturating_sub(1077) / 64;
    let mut product = [0_u64; 6];
    for (place, &word) in TWO_OVER_PI[skipped..skipped + 4].iter().rev().enumerate() {
        let sum = u128::from(significand) * u128::from(word) + u128::from(product[place]);
        product[place] = sum as u64;
        product[place + 1] = (sum >> 64) as u64;
    }
    // Place of the units digit: the truncated part is below 2^-128.
    let ones = 256 + 1075 + 64 * skipped - exponent;
    let from = |place: usize| {
        let word = |index: usize| u128::from(product.get(index).copied().unwrap_or(0));
        let (index, shift) = (place / 64, place % 64);
        let low = word(index) | word(index + 1) << 64;
        if shift == 0 { low } else { low >> shift | word(index + 2) << (128 - shift) }
    };
    let fraction = from(ones - 128).cast_signed();
    let count = (from(ones) & 3) as i32 + i32::from(fraction < 0);
    let nearest = fraction as f64;
    let mut scaled = Interval { lo: nearest.next_down(), hi: nearest.next_up() };
    if fraction.unsigned_abs() < LONG {
        scaled += Interval { lo: 0.0, hi: 2.0 };
    }
    let rest = scaled * Interval::point(1.0 / (LONG as f64 * LONG as f64 * 256.0)) * HALF_PI;
    if x < 0.0 { (-count, -rest) } else { (count, rest) }
}

/// The rest of a series over its first term.
#[inline]
fn series(series: &Series<7>, r: Interval) -> Interval {
    let square = r.square();
    square * series.at(square)
}

/// `sin(k pi/2 + r)` for `|r| < 0.8`.
fn quarter_sine(k: i32, r: Interval) -> Interval {
    let size = if k % 2 == 0 { r + r * series(&SINE, r) } else { Interval::ONE + series(&COSINE, r) };
    if k.rem_euclid(4) < 2 { size } else { -size }
}

fn quarter_tangent(k: i32, r: Interval) -> Interval {
    quarter_sine(k, r) / quarter_sine(k + 1, r)
}

/// Whether an odd number congruent to `residue` modulo `modulus` lies in `first..=last`.
fn contains_residue(first: i32, last: i32, residue: i32, modulus: i32) -> bool {
    first + (residue - first).rem_euclid(modulus) <= last
}

/// The endpoints in quarter turns and rests, with the range of quarter counts whose points may lie in the interval.
struct Quarters {
    lower: (i32, Interval),
    upper: (i32, Interval),
    first: i32,
    last: i32,
}

impl Quarters {
    /// `None` for an interval that is wide and reaches far.
    fn of(x: Interval) -> Option<Self> {
        /// Below three quarter turns: the ends' counts differ by three at most.
        const SHORT: f64 = 4.0;
        let lower = reduce(x.lo);
        let (lower, upper) = match (lower, if x.is_point() { lower } else { reduce(x.hi) }) {
            (Some(lower), Some(upper)) => (lower, upper),
            (lower, upper) if x.is_bounded() && x.width() <= SHORT => {
                let lower = lower.unwrap_or_else(|| reduce_large(x.lo));
                let (count, rest) = upper.unwrap_or_else(|| reduce_large(x.hi));
                (lower, (lower.0 + (count - lower.0).rem_euclid(4), rest))
            }
            _ => return None,
        };
        let first = lower.0 + i32::from(lower.1.is_positive());
        let last = upper.0 - i32::from(upper.1.is_negative());
        Some(Self { lower, upper, first, last })
    }
}

/// `sin(x + shift pi/2)`.
fn shifted_sine(x: Interval, shift: i32) -> Interval {
    if x.is_entire() {
        return x;
    }
    let Some(Quarters { lower, upper, first, last }) = Quarters::of(x) else {
        return Interval::UNIT;
    };
    let at_lower = quarter_sine(lower.0 + shift, lower.1);
    let ends = if x.is_point() { at_lower } else { at_lower.hull(quarter_sine(upper.0 + shift, upper.1)) };
    let reaches = |residue| contains_residue(first + shift, last + shift, residue, 4);
    Interval {
        lo: if reaches(3) { -1.0 } else { ends.lo.max(-1.0) },
        hi: if reaches(1) { 1.0 } else { ends.hi.min(1.0) },
    }
}

/// The angle within `range` (narrower than 3 pi/2) of the vector `(cosine, sine)` of any length, by correcting any guess
/// `y` in `range`: with `d = tan(angle - y)`, the angle is `y + atan(d)` and `atan(d)` lies between `d/(1 + d^2)` and `d`.
pub(super) fn angle(sine: Interval, cosine: Interval, guess: f64, range: Interval) -> Interval {
    let Some((k, r)) = reduce(guess).filter(|_| range.contains(guess)) else {
        return range;
    };
    let (s, c) = (quarter_sine(k, r), quarter_sine(k + 1, r));
    let along = cosine * c + sine * s;
    // A positive cosine of the difference, which is below 3 pi/2, puts the difference within a quarter turn.
    if !along.is_positive() {
        return range;
    }
    let d = (sine * c - cosine * s) / along;
    let shrink = Interval { lo: (Interval::ONE / (Interval::ONE + d.square())).lo, hi: 1.0 };
    (Interval::point(guess) + d * shrink).intersection(range).unwrap_or(range)
}

/// `sqrt(1 - x^2)` for `|x| <= 1`.
pub(super) fn complement(x: Interval) -> Interval {
    ((Interval::ONE - x) * (Interval::ONE + x)).sqrt()
}

/// The range of the inverse sine and tangent.
pub(super) const HALF_TURN: Interval = Interval { lo: -HALF_PI.hi, hi: HALF_PI.hi };

fn asin_over(sine: Interval) -> Interval {
    angle(sine, complement(sine), libm::asin(sine.midpoint()), HALF_TURN)
}

fn acos_over(cosine: Interval) -> Interval {
    angle(complement(cosine), cosine, libm::acos(cosine.midpoint()), Interval { lo: 0.0, hi: Interval::PI.hi })
}

fn atan_over(x: Interval) -> Interval {
    let middle = x.midpoint();
    let (sine, cosine) = if middle.abs() <= 1.0 {
        (x, Interval::ONE)
    } else {
        (Interval::point(1_f64.copysign(middle)), Interval::ONE / x.abs())
    };
    angle(sine, cosine, libm::atan(middle), HALF_TURN)
}

pub(super) fn sin(x: Interval) -> Interval {
    shifted_sine(x, 0)
}

pub(super) fn cos(x: Interval) -> Interval {
    shifted_sine(x, 1)
}

pub(super) fn tan(x: Interval) -> Interval {
    match Quarters::of(x) {
        Some(Quarters { lower, upper, first, last }) if !contains_residue(first, last, 1, 2) => {
            let at_lower = quarter_tangent(lower.0, lower.1);
            if x.is_point() { at_lower } else { Interval { lo: at_lower.lo, hi: quarter_tangent(upper.0, upper.1).hi } }
        }
        _ => Interval::ENTIRE,
    }
}

/// `x - sin x`, which increases; `difference` encloses it too.
pub(super) fn minus_own_sine(x: Interval, difference: Interval) -> Interval {
    /// From here on nothing cancels, and below the series holds.
    const LIMIT: f64 = 1.2;
    if x.lo >= LIMIT && difference.width() <= 64.0 * f64::EPSILON {
        return difference;
    }
    let increasing = x.increasing_over(|x| if x.magnitude() < LIMIT { -(x * series(&SINE, x)) } else { x - sin(x) });
    // Both enclose it: they intersect.
    increasing.intersection(difference).unwrap_or(difference)
}

/// Up to here the inverse functions are their argument but for its cube, far below its rounding.
const SMALL: f64 = 1.0 / 134_217_728.0; // 2^-27

/// All numbers between zero and the argument's cube: `x <= asin x <= x + x^3` and `x - x^3 <= atan x <= x` for `0 <= x <= 1/2`.
fn up_to_cube(x: Interval) -> Interval {
    (x * x.square()).hull(Interval::ZERO)
}

pub(super) fn asin(x: Interval) -> Interval {
    if x.magnitude() <= SMALL {
        return x.increasing(|end| Interval::point(end) + up_to_cube(Interval::point(end)));
    }
    if x.is_subset_of(Interval::UNIT) { x.increasing_over(asin_over) } else { Interval::ENTIRE }
}

pub(super) fn acos(x: Interval) -> Interval {
    if !x.is_subset_of(Interval::UNIT) {
        return Interval::ENTIRE;
    }
    // Negated to make it increasing.
    (-x).increasing_over(|x| acos_over(-x))
}

pub(super) fn atan(x: Interval) -> Interval {
    if x.magnitude() <= SMALL {
        return x.increasing(|end| Interval::point(end) - up_to_cube(Interval::point(end)));
    }
    x.increasing_over(atan_over)
}
