//! Bessel functions of orders 0 and 1, for arguments that are not negative: by power series and by Hankel's expansions.
//!
//! The sums are cut off; each comes with a bound of the rest, which enclosures add and floats ignore.

use core::array;

use super::real::magnitude;
use super::{Interval, Real};

/// From where on Hankel's expansions serve, whose smallest term is about `exp(-2 x)`: above, rounding prevails for J, and the
/// power series of I costs more.
const J_LARGE: f64 = 14.0;
const I_LARGE: f64 = 24.0;
/// From where on to [`J_LARGE`] the terms of the power series of J cancel too far; Taylor's series about the middle serves.
const J_MIDDLE: f64 = 10.0;
const MIDDLE: f64 = 12.0;
/// A term this small, relative to the sum, is the last.
const CUT: f64 = 1.4e-17;
/// Terms of Hankel's expansions that are summed; the next two bound the rest.
const TERMS: usize = 26;

/// `sum_k z^k/(k! (n + k)!)` for n in {0, 1}, z finite: `[J_0(x), J_1(x) 2/x]` for `z = -x^2/4`, I for `x^2/4`. Every
/// ratio of terms is below 1/2 when the sums end: the remainder is below the last term.
fn power_series<T: Real>(z: T) -> [T; 2] {
    let size = magnitude(z);
    let (mut zeroth, mut first, mut term, mut k) = (T::one(), T::one(), T::one(), 0.0);
    loop {
        k += 1.0;
        term = term * z / T::from_f64(k * k);
        zeroth = zeroth + term;
        first = first + term / T::from_f64(k + 1.0);
        let rest = magnitude(term);
        // Negated: NaN ends it.
        if !(rest > CUT * magnitude(zeroth) || 2.0 * size > (k + 1.0) * (k + 1.0)) {
            return [zeroth, first].map(|sum| sum.inflate(rest));
        }
    }
}

/// The terms `prod (4 order^2 - (2j - 1)^2)/(8 j x)` of Hankel's expansions (DLMF 10.17.1).
fn hankel_terms<T: Real>(order: f64, x: T) -> [T; TERMS + 2] {
    let inverse = T::one() / (T::from_f64(8.0) * x);
    let (mut term, mut k) = (T::one(), 0.0);
    array::from_fn(|_| {
        let this = term;
        k += 1.0;
        let odd = 2.0 * k - 1.0;
        term = term * inverse * T::from_f64(4.0 * order * order - odd * odd) / T::from_f64(k);
        this
    })
}

/// Sum of `(-1)^j terms[first + step j]` below `TERMS`.
fn alternating<T: Real>(terms: &[T], first: usize, step: usize) -> T {
    let last_first = terms[..TERMS].iter().skip(first).step_by(step).enumerate();
    last_first.fold(T::zero(), |sum, (j, &term)| if j % 2 == 0 { sum + term } else { sum - term })
}

/// `exp(-x) [I_0(x), I_1(x)]` for `x >= 20`. For the rest: DLMF 10.34.2, 10.40.11 with `2 chi(26) exp(3 chi(1)/(4 x)) < 15`,
/// and `2 exp(-2 x)` of the second exponential.
fn large_i<T: Real>(x: T) -> [T; 2] {
    let root = (T::two() * T::pi() * x).sqrt();
    [0.0, 1.0].map(|order| {
        let terms = hankel_terms(order, x);
        alternating(&terms, 0, 1).inflate(15.0 * magnitude(terms[TERMS]) + 1e-17) / root
    })
}

/// `exp(-x) [I_0(x), I_1(x)]` for `x >= 0`.
pub(super) fn i_scaled(x: f64) -> [f64; 2] {
    if x < I_LARGE {
        let half = 0.5 * x;
        let [zeroth, first] = power_series(half * half);
        let scale = libm::exp(-x);
        [scale * zeroth, scale * half * first]
    } else {
        large_i(x)
    }
}

fn is_domain(x: Interval) -> bool {
    x.is_bounded() && x.lower() >= 0.0
}

/// `[J_0(x), J_1(x)]` for `x >= 0`.
pub(super) fn enclosed_j(x: Interval) -> [Interval; 2] {
    if !is_domain(x) {
        return [Interval::ENTIRE; 2];
    }
    let functions = if x.upper() < J_MIDDLE {
        let half = x / Interval::two();
        let [zeroth, first] = power_series(-half.square());
        [zeroth, half * first]
    } else if x.lower() < J_MIDDLE {
        [Interval::UNIT; 2]
    } else if x.upper() < J_LARGE {
        middle_j(x)
    } else {
        large_j(x)
    };
    functions.map(|value| value.intersection(Interval::UNIT).unwrap_or(Interval::UNIT))
}

/// For `10 <= x <= 14`: Taylor's series about [`MIDDLE`], by the recurrence that Bessel's equation gives its coefficients; no derivative of J_0 or
/// J_1 exceeds 1: the remainder is below `2^25/25!`, and J_1 is the derivative of -J_0.
fn middle_j(x: Interval) -> [Interval; 2] {
    let at = Interval::point(MIDDLE);
    let h = x - at;
    let mut coefficients = [Interval::ZERO; 26];
    // J_0(12) and -J_1(12) lie above these doubles.
    for (first, below) in coefficients.iter_mut().zip([0.047_689_310_796_833_535, 0.223_447_104_490_627_6_f64]) {
        *first = Interval::point(below).hull(Interval::point(below.next_up()));
    }
    for k in 2..coefficients.len() {
        let n = Interval::point(k as f64);
        let older = if k > 2 { coefficients[k - 3] } else { Interval::ZERO };
        let less = n - Interval::ONE;
        coefficients[k] = -(less.square() * coefficients[k - 1] + at * coefficients[k - 2] + older) / (at * n * less);
    }
    let (mut value, mut slope) = (Interval::ZERO, Interval::ZERO);
    for &coefficient in coefficients.iter().rev() {
        slope = slope * h + value;
        value = value * h + coefficient;
    }
    [value, -slope].map(|sum| sum.inflate(3e-18))
}

/// `J_n = sqrt(2/(pi x)) (P cos(w) - Q sin(w))`, `w = x - n pi/2 - pi/4`; on the positive axis the rest of either sum is
/// below its first omitted term (DLMF 10.17(iii)).
fn large_j(x: Interval) -> [Interval; 2] {
    let phase = x - Interval::PI / Interval::point(4.0);
    let (sine, cosine) = (phase.sin(), phase.cos());
    let scale = (Interval::two() / (Interval::PI * x)).sqrt();
    let sums = |order| {
        let terms = hankel_terms(order, x);
        [0, 1].map(|first| alternating(&terms, first, 2).inflate(terms[TERMS + first].magnitude()))
    };
    let ([p0, q0], [p1, q1]) = (sums(0.0), sums(1.0));
    [scale * (p0 * cosine - q0 * sine), scale * (p1 * sine + q1 * cosine)]
}

/// `exp(-x) [I_0(x), I_1(x)]` for `x >= 0`.
pub(super) fn enclosed_i_scaled(x: Interval) -> [Interval; 2] {
    if !is_domain(x) {
        return [Interval::ENTIRE; 2];
    }
    if x.lower() < I_LARGE && x.upper() < 2.0 * I_LARGE {
        let half = x / Interval::two();
        let [zeroth, first] = power_series(half.square());
        let scale = (-x).exp();
        [scale * zeroth, scale * half * first]
    } else if x.lower() < I_LARGE {
        // Both fall or rise to less than 1/2 and stay positive.
        [Interval::UNIT.max(Interval::ZERO); 2]
    } else {
        large_i(x)
    }
}
