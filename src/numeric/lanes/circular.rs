//! Inverse circular functions without branches, so that all lanes go through together.
//!
//! The rational and polynomial approximations of Sun Microsystems' fdlibm (1993), operation by operation as `libm` has them:
//! the bits are those of one float alone.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use wide::f64x4;

/// Approximates `(asin x - x)/x` in `x^2`, for `|x|` below one half: numerator and denominator, lowest power first.
const ARC_SINE: ([f64; 6], [f64; 5]) = (
    [
        1.666_666_666_666_666_574_15e-1,
        -3.255_658_186_224_009_154_05e-1,
        2.012_125_321_348_629_258_81e-1,
        -4.005_553_450_067_941_140_27e-2,
        7.915_349_942_898_145_321_76e-4,
        3.479_331_075_960_211_675_70e-5,
    ],
    [
        1.0,
        -2.403_394_911_734_414_218_78,
        2.020_945_760_233_505_694_71,
        -6.882_839_716_054_532_930_30e-1,
        7.703_815_055_590_193_527_91e-2,
    ],
);

/// Powers of `x^2` in `(x - atan x)/x`, from the first on, for `|x|` below 7/16.
const ARC_TANGENT: [f64; 11] = [
    3.333_333_333_333_293_180_27e-1,
    -1.999_999_999_987_648_324_76e-1,
    1.428_571_427_250_346_637_11e-1,
    -1.111_111_040_546_235_578_80e-1,
    9.090_887_133_436_506_561_96e-2,
    -7.691_876_205_044_829_994_95e-2,
    6.661_073_137_387_531_206_69e-2,
    -5.833_570_133_790_573_486_45e-2,
    4.976_877_994_615_932_360_17e-2,
    -3.653_157_274_421_691_552_70e-2,
    1.628_582_011_536_578_236_23e-2,
];

/// From where on the angle of a slope is that of a smaller one and of a rotation, this one in two parts.
type Rotation = (f64, [f64; 2]);
const BY_HALF: Rotation = (0.4375, [4.636_476_090_008_060_935_15e-1, 2.269_877_745_296_168_709_24e-17]);
const BY_ONE: Rotation = (0.6875, [FRAC_PI_4, 3.061_616_997_868_383_017_93e-17]);
const BY_ONE_AND_A_HALF: Rotation = (1.1875, [9.827_937_232_473_290_540_82e-1, 1.390_331_103_123_099_845_16e-17]);
const BY_A_QUARTER_TURN: Rotation = (2.4375, [FRAC_PI_2, 6.123_233_995_736_766_035_87e-17]);

/// By Horner's rule, lowest power first.
#[inline(always)]
fn polynomial<const N: usize>(x: f64x4, factors: [f64; N]) -> f64x4 {
    let mut sum = f64x4::splat(factors[N - 1]);
    for factor in factors[..N - 1].iter().rev() {
        sum = f64x4::splat(*factor) + x * sum;
    }
    sum
}

/// The inverse sine of what is nearer to zero than one half.
#[inline(always)]
pub(super) fn asin_below_half(x: f64x4) -> f64x4 {
    let square = x * x;
    let (numerator, denominator) = ARC_SINE;
    x + x * (square * polynomial(square, numerator) / polynomial(square, denominator))
}

/// The inverse tangent.
#[inline(always)]
pub(super) fn atan(x: f64x4) -> f64x4 {
    let splat = f64x4::splat;
    let size = x.abs();
    let (mut over, mut under, mut high, mut low) = (size, splat(1.0), splat(0.0), splat(0.0));
    let mut turn = |from: f64, by_over: f64x4, by_under: f64x4, [by_high, by_low]: [f64; 2]| {
        let beyond = size.simd_ge(splat(from));
        over = beyond.select(by_over, over);
        under = beyond.select(by_under, under);
        high = beyond.select(splat(by_high), high);
        low = beyond.select(splat(by_low), low);
    };
    // As `libm` forms them: by one half both are doubled.
    let (from, parts) = BY_HALF;
    turn(from, size + size - 1.0, size + 2.0, parts);
    let (from, parts) = BY_ONE;
    turn(from, size - 1.0, size + 1.0, parts);
    let (from, parts) = BY_ONE_AND_A_HALF;
    turn(from, size - 1.5, size * 1.5 + 1.0, parts);
    let (from, parts) = BY_A_QUARTER_TURN;
    turn(from, splat(-1.0), size, parts);

    let rest = over / under;
    let square = rest * rest;
    let fourth = square * square;
    let [a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10] = ARC_TANGENT;
    let odd = square * polynomial(fourth, [a0, a2, a4, a6, a8, a10]);
    let even = fourth * polynomial(fourth, [a1, a3, a5, a7, a9]);
    let angle = high - (rest * (odd + even) - low - rest);
    // With the sign of the slope, zero's too.
    angle | (x & splat(-0.0))
}
