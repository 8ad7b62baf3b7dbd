//! Inverse circular functions without branches: all lanes go through together.
//!
//! The rational and polynomial approximations of Sun Microsystems' fdlibm (1993), operation by operation as `libm` has them:
//! the bits are those of a float alone.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use wide::f64x4;

/// Approximates `(asin x - x)/x` in `x^2`, for `|x|` below 1/2: numerator and denominator, lowest power first.
const ARC_SINE: ([f64; 6], [f64; 5]) = (
    [
        0.166_666_666_666_666_66,
        -0.325_565_818_622_400_9,
        0.201_212_532_134_862_93,
        -0.040_055_534_500_679_41,
        0.000_791_534_994_289_814_5,
        3.479_331_075_960_212e-05,
    ],
    [1.0, -2.403_394_911_734_414, 2.020_945_760_233_505_7, -0.688_283_971_605_453_3, 0.077_038_150_555_901_94],
);

/// Powers of `x^2` in `(x - atan x)/x`, from the first on, for `|x|` below 7/16.
const ARC_TANGENT: [f64; 11] = [
    0.333_333_333_333_329_3,
    -0.199_999_999_998_764_83,
    0.142_857_142_725_034_66,
    -0.111_111_104_054_623_56,
    0.090_908_871_334_365_07,
    -0.076_918_762_050_448_3,
    0.066_610_731_373_875_31,
    -0.058_335_701_337_905_735,
    0.049_768_779_946_159_324,
    -0.036_531_572_744_216_916,
    0.016_285_820_115_365_782,
];

/// Least slope s for the identity `atan(s) = rotation + atan(smaller slope)`; the rotation is a sum of two doubles.
type Rotation = (f64, [f64; 2]);
const BY_HALF: Rotation = (0.4375, [0.463_647_609_000_806_1, 2.269_877_745_296_168_7e-17]);
const BY_ONE: Rotation = (0.6875, [FRAC_PI_4, 3.061_616_997_868_383e-17]);
const BY_ONE_AND_A_HALF: Rotation = (1.1875, [0.982_793_723_247_329, 1.390_331_103_123_099_8e-17]);
const BY_A_QUARTER_TURN: Rotation = (2.4375, [FRAC_PI_2, 6.123_233_995_736_766e-17]);

/// By Horner's rule, lowest power first.
#[inline(always)]
fn polynomial<const N: usize>(x: f64x4, factors: [f64; N]) -> f64x4 {
    let mut sum = f64x4::splat(factors[N - 1]);
    for factor in factors[..N - 1].iter().rev() {
        sum = f64x4::splat(*factor) + x * sum;
    }
    sum
}

/// The inverse sine for `|x| < 1/2`.
#[inline(always)]
pub(super) fn asin_below_half(x: f64x4) -> f64x4 {
    let square = x * x;
    let (numerator, denominator) = ARC_SINE;
    x + x * (square * polynomial(square, numerator) / polynomial(square, denominator))
}

/// `(x - atan x)/x`, for `|x|` below 7/16.
#[inline(always)]
fn bend(x: f64x4) -> f64x4 {
    let square = x * x;
    let fourth = square * square;
    let [a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10] = ARC_TANGENT;
    square * polynomial(fourth, [a0, a2, a4, a6, a8, a10]) + fourth * polynomial(fourth, [a1, a3, a5, a7, a9])
}

/// The inverse tangent.
#[inline(always)]
pub(super) fn atan(x: f64x4) -> f64x4 {
    let size = x.abs();
    let small = size.simd_lt(f64x4::splat(BY_HALF.0)).all();
    let angle = if small { size - size * bend(size) } else { rotated(size) };
    // With the sign of the slope, zero's too.
    angle | (x & f64x4::splat(-0.0))
}

/// The inverse tangent of a number that is not below zero.
#[inline(always)]
fn rotated(slope: f64x4) -> f64x4 {
    let splat = f64x4::splat;
    let rotations = [BY_HALF, BY_ONE, BY_ONE_AND_A_HALF, BY_A_QUARTER_TURN];
    let beyond = rotations.map(|(from, _)| slope.simd_ge(splat(from)));
    // Neighbours are mostly rotated alike: then nothing has to be chosen lane by lane.
    let passed = beyond.iter().take_while(|beyond| beyond.all()).count();
    if passed > 0 && beyond[passed..].iter().all(|beyond| beyond.none()) {
        let (over, under) = by(passed, slope);
        let [high, low] = rotations[passed - 1].1;
        return less_bend(over, under, splat(high), splat(low));
    }
    let (mut over, mut under, mut high, mut low) = (slope, splat(1.0), splat(0.0), splat(0.0));
    for (rotation, ((_, [by_high, by_low]), beyond)) in rotations.into_iter().zip(beyond).enumerate() {
        let (by_over, by_under) = by(rotation + 1, slope);
        over = beyond.select(by_over, over);
        under = beyond.select(by_under, under);
        high = beyond.select(splat(by_high), high);
        low = beyond.select(splat(by_low), low);
    }
    less_bend(over, under, high, low)
}

/// The slope after the first rotations, as `libm` forms them: over and under; by 1/2: both doubled.
#[inline(always)]
fn by(rotations: usize, slope: f64x4) -> (f64x4, f64x4) {
    match rotations {
        1 => (slope + slope - 1.0, slope + 2.0),
        2 => (slope - 1.0, slope + 1.0),
        3 => (slope - 1.5, slope * 1.5 + 1.0),
        _ => (f64x4::splat(-1.0), slope),
    }
}

/// `high + low + atan(over / under)`: the rotation is a sum of two doubles.
#[inline(always)]
fn less_bend(over: f64x4, under: f64x4, high: f64x4, low: f64x4) -> f64x4 {
    let rest = over / under;
    high - (rest * bend(rest) - low - rest)
}
