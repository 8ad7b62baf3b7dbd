//! Describing function of a power law, biased, to full precision for any exponent.
//!
//! With `u = abs(B)/X` and `f(x) = sgn(x) abs(x)^p` the moments `m(u) = <f(u + sin)>` and `h(u) = <sin f(u + sin)>` give
//! `F_0 = gain X^p m` and `P = 2 gain X^(p-1) h`. m obeys `(1 - u^2) m'' + (2p - 1) u m' - p^2 m = 0`, a hypergeometric
//! equation, and integration by parts gives `(1 + p) h = (1 - u^2) m' + p u m`. Three series cover all u: about 0, about 1
//! and about infinity (DLMF 15.2, 15.8, 15.10). Their terms have one sign, or nearly so.

use core::f64::consts::{LN_2, PI};

use libm::{cos, exp, expm1, floor, lgamma, log, log1p, pow, sin, sqrt, tgamma};

use super::closed_form::{ClosedForm, finite};
use super::{DescribingError, DescribingFunction};
use crate::nonlinearity::{Power, Sinusoid};
use crate::numeric::Scalar;
use crate::numeric::special::lift;

/// The series about zero serves below, the one about infinity above; the one about one, with radius 2, between.
const INNER: f64 = 0.6;
const OUTER: f64 = 1.5;
/// Exponent from which on the two outer series converge fast enough up to `u = 1`, where their n-th term is about
/// `n^(-p - 3/2)`; the series about one would cancel.
const STEEP: f64 = 8.0;

impl<T: Scalar> ClosedForm for Power<T> {
    /// Unbiased: `P = gain X^(p-1) (2/sqrt(pi)) Gamma(p/2 + 1)/Gamma(p/2 + 3/2)`, `F_0 = Q = 0`; quadratic drag has
    /// `P = 8 gain X/(3 pi)`, the factor of eqs. 28-29. Biased: hypergeometric series.
    ///
    /// Derivatives by dual numbers hold with respect to bias, amplitude and gain; the exponent counts as a constant.
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        let negative = sweep.bias() < T::zero();
        let bias = if negative { -sweep.bias() } else { sweep.bias() };
        let (amplitude, p) = (sweep.amplitude(), self.exponent().value());
        let u = (bias / amplitude).value();
        let outside = u > OUTER || (p >= STEEP && u > 1.0);
        let (reference, ratio) = if outside { (bias, amplitude / bias) } else { (amplitude, bias / amplitude) };
        let moments = if outside {
            about_infinity(ratio.value(), p)
        } else if u < INNER || p >= STEEP {
            about_zero(u, p, self.mean_power())
        } else {
            about_one(u, 0.5 * ((amplitude - bias) / amplitude).value(), p)
        };
        let scale = self.gain() * reference.pow(T::from_f64(p));
        let m = lift(ratio, moments.m, moments.m_slope);
        let h = lift(ratio, moments.h, moments.h_slope);
        let f0 = if negative { -(scale * m) } else { scale * m };
        finite(DescribingFunction { f0, p: T::two() * scale * h / amplitude, q: T::zero() }, sweep)
    }
}

/// m and h with their derivatives.
struct Moments {
    m: f64,
    m_slope: f64,
    h: f64,
    h_slope: f64,
}

impl Moments {
    /// From m, its derivative, and `(1 - u^2) m'`.
    fn new(u: f64, p: f64, m: f64, m_slope: f64, weighted_slope: f64) -> Self {
        Self { m, m_slope, h: (weighted_slope + p * u * m) / (1.0 + p), h_slope: p * m - u * m_slope }
    }
}

/// `2F1(a, b; c; x)` and `x d/dx` of it, for `0 <= x <= 1`.
fn hypergeometric(a: f64, b: f64, c: f64, x: f64) -> (f64, f64) {
    let (mut term, mut sum, mut slope, mut n) = (1.0, 1.0, 0.0, 0.0);
    loop {
        term *= (a + n) * (b + n) / ((c + n) * (n + 1.0)) * x;
        n += 1.0;
        sum += term;
        slope += n * term;
        // Up to the parameters' size the terms may still grow.
        if !((n * term).abs() > 0.1 * f64::EPSILON * sum.abs() || (term != 0.0 && n < -a)) {
            return (sum, slope);
        }
    }
}

/// `m = m'(0) u 2F1((1-p)/2, (1-p)/2; 3/2; u^2)`, every term positive; `m'(0) = (p + 1) <abs(sin)^(p+1)>`.
fn about_zero(u: f64, p: f64, mean_power: f64) -> Moments {
    let slope_at_zero = (p + 1.0) * mean_power;
    let a = 0.5 * (1.0 - p);
    let (sum, slope) = hypergeometric(a, a, 1.5, u * u);
    let m_slope = slope_at_zero * (sum + 2.0 * slope);
    Moments::new(u, p, slope_at_zero * u * sum, m_slope, (1.0 - u * u) * m_slope)
}

/// In `v = 1/u`, with `X^p` replaced by `abs(B)^p`: `m = 2F1(-p/2, (1-p)/2; 1; v^2)` and
/// `h = (p v/2) 2F1((1-p)/2, 1 - p/2; 2; v^2)`, the binomial series.
fn about_infinity(v: f64, p: f64) -> Moments {
    let (m, m_slope) = hypergeometric(-0.5 * p, 0.5 * (1.0 - p), 1.0, v * v);
    let (h, h_slope) = hypergeometric(0.5 * (1.0 - p), 0.5 * (2.0 - p), 2.0, v * v);
    let half = 0.5 * p;
    Moments {
        m,
        m_slope: 2.0 * m_slope / v.max(f64::MIN_POSITIVE),
        h: half * v * h,
        h_slope: half * (h + 2.0 * h_slope),
    }
}

/// In `z = (1 - u)/2`: `m = alpha sum a_n z^n + c sum b_j z^(p + 1/2 + j)`, the exponents of the equation at `u = 1`.
///
/// With `p + 1/2 = N + delta` the coefficients a_n from `n = N` on and c grow like `1/delta` and cancel; at `delta = 0` they
/// leave a logarithm. So terms of equal whole order are paired, `(A_j - B_j w abs(z)^delta)/delta`, and the recurrence runs
/// on `B_j` and on `D_j = (A_j - B_j)/delta`, which stays finite.
fn about_one(u: f64, z: f64, p: f64) -> Moments {
    let order = floor(p) + 1.0;
    let delta = p + 0.5 - order;
    let growth = pow(2.0, p) / sqrt(PI);

    let (mut m, mut slope) = (0.0, 0.0);
    let (mut term, mut n) = (growth * tgamma(p + 0.5) / tgamma(p + 1.0), 0.0);
    let mut shift = 1.0;
    while n < order {
        m += term;
        slope += n * term;
        term *= (n - p) * (n - p) / ((0.5 - p + n) * (n + 1.0)) * z;
        n += 1.0;
        shift *= -z;
    }
    if z == 0.0 {
        return Moments::new(u, p, m, f64::INFINITY, 0.0);
    }

    let log_z = log(z.abs());
    let (half_sine, sine) = (sin(0.5 * PI * delta), sin(PI * delta));
    let sinc = if delta == 0.0 { 1.0 } else { sine / (PI * delta) };
    let mut b = growth * tgamma(p + 1.0) / (PI * tgamma(p + 1.5)) / sinc;
    let mut d = b * expm1_over(delta, log_ratio(delta, order));
    // The continuation through u = 1 and, inside, the part of the input below zero.
    let parity = if order % 2.0 == 0.0 { 1.0 } else { -1.0 };
    let (weight, excess) = if z > 0.0 {
        (1.0 + parity * sine, parity * PI * sinc)
    } else {
        (cos(PI * delta), if delta == 0.0 { 0.0 } else { -2.0 * half_sine * half_sine / delta })
    };
    let power = exp(delta * log_z);
    let level = excess * power + expm1_over(delta, log_z);
    let mut j = 0.0;
    loop {
        let pair = d - b * level;
        let (part, part_slope) = (shift * pair, shift * ((order + j) * pair - b * weight * power));
        m += part;
        slope += part_slope;
        if part_slope.abs() <= 0.1 * f64::EPSILON * m.abs() || m.is_nan() {
            break;
        }
        j += 1.0;
        let (half, whole) = (j - 0.5, order + j);
        let spread = half * half * (j + whole) - j * (2.0 * half - delta) * (whole + delta);
        d = d * (half - delta) * (half - delta) / ((j - delta) * whole)
            + b * spread / ((j - delta) * whole * (whole + delta) * j);
        b *= half * half / ((whole + delta) * j);
        shift *= z;
    }
    Moments::new(u, p, m, -0.5 * slope / z, -2.0 * (1.0 - z) * slope)
}

/// `(exp(delta rate) - 1)/delta`.
fn expm1_over(delta: f64, rate: f64) -> f64 {
    if delta == 0.0 { rate } else { expm1(delta * rate) / delta }
}

/// `ln(A_0/B_0)/delta`, the ratio being `16^delta Gamma(1+delta)^3/(Gamma(1-delta) Gamma(1+2 delta)^2) prod (1 + delta/k)`.
fn log_ratio(delta: f64, order: f64) -> f64 {
    let mut sum = 4.0 * LN_2 + 3.0 * log_gamma_over(delta) + log_gamma_over(-delta) - 4.0 * log_gamma_over(2.0 * delta);
    let mut k = 1.0;
    while k <= order {
        sum += if delta == 0.0 { 1.0 / k } else { log1p(delta / k) / delta };
        k += 1.0;
    }
    sum
}

/// `ln(Gamma(1 + x))/x`; near zero by its series in zeta(2), zeta(3), ... (DLMF 5.7.3).
fn log_gamma_over(x: f64) -> f64 {
    const EULER: f64 = 0.577_215_664_901_532_9;
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
    if x.abs() > 0.02 {
        return lgamma(1.0 + x) / x;
    }
    let (mut sum, mut power) = (-EULER, x);
    for (zeta, k) in ZETA.into_iter().zip(2u32..) {
        sum += zeta * power / f64::from(k);
        power *= -x;
    }
    sum
}
