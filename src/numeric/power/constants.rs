//! The constants of the series by the exponent alone: ratios of gamma functions, enclosed.

#[cfg(test)]
#[path = "../../../tests/properties/private/power_constants.rs"]
mod tests;

use super::series::{Known, STEEP, analytic_step};
use super::{PowerMoments, SeriesStarts};
use crate::numeric::{Interval, Real};

/// Argument from which on the remainder of Stirling's series is below rounding.
const FAR: f64 = 10.0;
/// Largest delta up to which `A_0 - B_0` is found by the logarithm of their ratio.
const NEAR: f64 = 0.02;

/// `zeta(2), zeta(3), ...`, to half a unit in the last place (DLMF table 25.2(i)).
const ZETA: [f64; 9] = [
    1.644_934_066_848_226_4,
    1.202_056_903_159_594_2,
    1.082_323_233_711_138_2,
    1.036_927_755_143_37,
    1.017_343_061_984_449,
    1.008_349_277_381_922_8,
    1.004_077_356_197_944_3,
    1.002_008_392_826_082_2,
    1.000_994_575_127_818_1,
];

fn number(value: f64) -> Interval {
    Interval::point(value)
}

/// The constants of an exponent.
pub(super) fn of(exponent: f64) -> PowerMoments {
    let pairs = SeriesStarts { b: Known::NOT, d: Known::NOT, sides: [[Known::NOT; 2]; 2] };
    let unknown = PowerMoments { exponent, slope_at_zero: Known::NOT, at_one: Known::NOT, pairs };
    if exponent.is_nan() {
        return unknown;
    }
    let p = number(exponent);
    let root = Interval::PI.sqrt();
    let slope_at_zero = (p + Interval::ONE) * gamma_ratio((p + Interval::ONE) / Interval::two(), FAR) / root;
    let slope_at_zero = slope_at_zero.into();
    if exponent >= STEEP {
        return PowerMoments { slope_at_zero, ..unknown };
    }
    let ratio = gamma_ratio(p, FAR);
    let growth = Interval::two().pow(p) / root;
    let at_one = growth * ratio;
    let (order, delta) = PowerMoments::order_and_delta::<Interval>(exponent);
    let angle = Interval::PI * delta;
    let (sine, half_sine) = (angle.sin(), (angle / Interval::two()).sin());
    // `sin(pi delta)/delta` and `(cos(pi delta) - 1)/delta`.
    let (rate, bend) = if delta == Interval::ZERO {
        (Interval::PI, Interval::ZERO)
    } else {
        (sine / delta, -Interval::two() * half_sine.square() / delta)
    };
    let parity = if order % 2.0 == 0.0 { Interval::ONE } else { -Interval::ONE };
    // `Gamma(p + 1)/Gamma(p + 3/2)` is one over `(p + 1/2) Gamma(p + 1/2)/Gamma(p + 1)`.
    let b = growth / ((p + number(0.5)) * ratio * rate);
    let d = if delta.magnitude() <= NEAR {
        let logarithm = log_ratio(delta, order);
        b * if delta == Interval::ZERO { logarithm } else { (delta * logarithm).exp_m1() / delta }
    } else {
        (first_of_a(at_one, p, order) - b) / delta
    };
    // The continuation through u = 1 and, within the sweep, the part of the input below zero.
    let sides = [[Interval::ONE + parity * sine, parity * rate], [angle.cos(), bend]];
    let pairs = SeriesStarts { b: b.into(), d: d.into(), sides: sides.map(|side| side.map(Known::from)) };
    PowerMoments { exponent, slope_at_zero, at_one: at_one.into(), pairs }
}

/// `A_0 = (-1)^(N + 1) a_(N-1) (N - 1 - p)^2/N`, from `alpha = m(1)` on.
fn first_of_a(at_one: Interval, p: Interval, order: f64) -> Interval {
    let (mut a, mut n) = (at_one, 0.0);
    while n < order - 1.0 {
        let [numerator, denominator] = analytic_step(p, number(n));
        a *= -(numerator / denominator);
        n += 1.0;
    }
    a * (number(n) - p).square() / number(order)
}

/// `Gamma(x + 1/2)/Gamma(x + 1)` for `x >= 0`, by Stirling's series (DLMF 5.11.1), whose rest is below its first omitted term
/// (5.11(ii)); from `far` on, which the argument is raised to by the functional equation. The mean of `abs(sin)^(2x)` is this over `sqrt(pi)` (5.12.2).
fn gamma_ratio(x: Interval, far: f64) -> Interval {
    /// `B_2k/(2k (2k - 1))` as fractions; the next fraction is below 0.03.
    const SERIES: [(f64, f64); 7] =
        [(1.0, 12.0), (-1.0, 360.0), (1.0, 1260.0), (-1.0, 1680.0), (1.0, 1188.0), (-691.0, 360_360.0), (1.0, 156.0)];
    let half = number(0.5);
    let (mut at, mut factor) = (x, Interval::ONE);
    while at.lower() < far {
        factor = factor * (at + Interval::ONE) / (at + half);
        at += Interval::ONE;
    }
    let stirling = |z: Interval| {
        let square = (Interval::ONE / z).square();
        let start = Interval::symmetric(0.03);
        SERIES.iter().rev().fold(start, |sum, &(over, under)| number(over) / number(under) + sum * square) / z
    };
    let (low, high) = (at + half, at + Interval::ONE);
    // `ln low - ln high`, then `(low - 1/2) ln low - (high - 1/2) ln high + high - low`.
    let step = (-half / high).ln_1p();
    let exponent = at * step + half + (stirling(low) - stirling(high));
    factor * exponent.exp() / high.sqrt()
}

/// `ln(A_0/B_0)/delta` for `abs(delta) <= NEAR`, the ratio being
/// `16^delta Gamma(1+delta)^3/(Gamma(1-delta) Gamma(1+2 delta)^2) prod (1 + delta/k)`, k up to the order, by the series of
/// `ln Gamma(1 + x)` (DLMF 5.7.3), of which Euler's constant cancels.
fn log_ratio(delta: Interval, order: f64) -> Interval {
    // Term k is below `7 (2 delta)^(k-1)/k`: the truncated terms sum to less than the ninth power after the last.
    let twice = 2.0 * delta.magnitude();
    let rest = ZETA.iter().fold(1.1 * twice, |power, _| power * twice);
    let mut sum = Interval::two().ln() * number(4.0) + Interval::symmetric(rest);
    let (mut power, mut sign, mut double) = (delta, 1.0, 8.0);
    for (zeta, k) in ZETA.into_iter().zip(2u32..) {
        let zeta = number(zeta.next_down()).hull(number(zeta.next_up()));
        sum += zeta * power * number(sign * (3.0 - sign - double)) / number(f64::from(k));
        power *= delta;
        sign = -sign;
        double *= 2.0;
    }
    let mut k = 1.0;
    while k <= order {
        sum += if delta == Interval::ZERO { Interval::reciprocal(k) } else { (delta / number(k)).ln_1p() / delta };
        k += 1.0;
    }
    sum
}
