//! Describing function of the hyperbolic tangent.

use super::closed_form::{ClosedForm, finite};
use super::pole::{Complex, Pole};
use super::{DescribingError, DescribingFunction};
use crate::nonlinearity::{Sinusoid, Tanh};
use crate::numeric::special::Special;

/// Poles summed one by one; the rest is left to the Euler-Maclaurin formula.
const POLES: u32 = 10;
/// `-B_2k(1/2) pi^(2k-1) / (2k)`: the midpoint form of the Euler-Maclaurin formula with step pi, by Taylor coefficients.
///
/// The singularities of the summand stay `POLES pi` away, so that the first term left out, k = 9, is below
/// `(2/pi) 17!/(2 pi POLES)^18 = 1e-18` of a sum of order one, and the terms fall steeply up to there.
const CORRECTION: [f64; 8] = {
    let (half_bernoulli, mut power) = (
        [
            -1.0 / 12.0,
            7.0 / 240.0,
            -31.0 / 1344.0,
            127.0 / 3840.0,
            -2555.0 / 33_792.0,
            1_414_477.0 / 5_591_040.0,
            -57_337.0 / 49_152.0,
            118_518_239.0 / 16_711_680.0,
        ],
        core::f64::consts::PI,
    );
    let mut correction = [0.0; 8];
    let mut k = 0;
    while k < correction.len() {
        correction[k] = -half_bernoulli[k] * power / (2 * k + 2) as f64;
        power *= core::f64::consts::PI * core::f64::consts::PI;
        k += 1;
    }
    correction
};
/// Bound of what the formula leaves out, for every sweep: with `abs(1/S) <= 1/Re(c)` and Cauchy's estimate the 16th
/// derivatives of the summands are below `45 16!/c^17` and `533 16!/c^18`, and the remainder is below
/// `2 pi^15/(2 pi)^16` of their integral from `POLES pi`.
const REST: f64 = 1e-15;
/// Distance `k (abs(B) - X)` from which the exponential series gives `P`: the sum over poles cancels there.
const ONE_SIDED: f64 = 2.0;

impl<T: Special> ClosedForm for Tanh<T> {
    /// No elementary form is known. The partial fractions `tanh y = sum 2y/(y^2 + c^2)`, `c = pi/2, 3pi/2, ...`, give
    /// `F_0 = 2 gain sum Im 1/S` and `P = 4 gain k sum Re 1/(S (w + S))` with `w = c - i kB`, `S = sqrt(w^2 + (kX)^2)`; the
    /// tail of the sum is an elementary integral and eight terms of the Euler-Maclaurin formula. Where the whole sweep is on
    /// one side, `P = (4 gain/X) sum (-1)^(n+1) exp(-2nk abs(B)) I_1(2nkX)`. `Q = 0`. Both are exact but for rounding.
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        let (f0, p) = by_poles(self.scale(), sweep);
        let distance = self.scale() * (sweep.bias().abs() - sweep.amplitude());
        let p = (distance - T::from_f64(ONE_SIDED)).select(|| p, || by_exponentials(self.scale(), distance, sweep));
        finite(DescribingFunction { f0: self.gain() * f0, p: self.gain() * p, q: T::zero() }, sweep)
    }
}

/// `F_0` and `P` of `tanh(scale x)` by partial fractions.
fn by_poles<T: Special>(scale: T, sweep: &Sinusoid<T>) -> (T, T) {
    let place = |n: f64| Pole::new(T::pi() * T::from_f64(n), scale, sweep);
    let (mut mean, mut sine) = (T::zero(), T::zero());
    for n in 0..POLES {
        let pole = place(f64::from(n) + 0.5);
        mean = mean + pole.root.inverse().im;
        sine = sine + (pole.root * pole.sum()).inverse().re;
    }

    let start = place(f64::from(POLES));
    mean = mean + start.angle() / T::pi();
    sine = sine + start.sum().inverse().re / T::pi();
    // Taylor coefficients in c: y of 1/S, z of the derivative -1/S^3 of 1/(S (w + S)); with S^2 = w^2 + kappa^2,
    // (n+1) S^2 y' = -(2n+1) w y - n y_before and (n+1) S^2 z' = -(2n+3) w z - (n+2) z_before.
    let zero = Complex { re: T::zero(), im: T::zero() };
    let inverse = start.root.inverse();
    let square = inverse * inverse;
    let step = start.position * square;
    let next = |value: Complex<T>, before: Complex<T>, n: f64, excess: f64| {
        let here = step * value * T::from_f64(-(2.0 * n + excess) / (n + 1.0));
        here + square * before * T::from_f64(-(n + excess - 1.0) / (n + 1.0))
    };
    let (mut y, mut y_before) = (inverse, zero);
    let (mut z, mut z_before) = (inverse * square * -T::one(), zero);
    for n in 0..2 * CORRECTION.len() - 1 {
        let order = n as f64;
        if n % 2 == 0 {
            sine = sine + z.re * T::from_f64(CORRECTION[n / 2] / (order + 1.0));
        }
        (y, y_before) = (next(y, y_before, order, 1.0), y);
        (z, z_before) = (next(z, z_before, order, 3.0), z);
        if n % 2 == 0 {
            mean = mean + y.im * T::from_f64(CORRECTION[n / 2]);
        }
    }
    (T::two() * mean.give_or_take(REST), T::from_f64(4.0) * scale * sine.give_or_take(REST))
}

/// `P` of `tanh(scale x)` on one side of zero, `distance = scale (abs(B) - X) > 2` away from it.
fn by_exponentials<T: Special>(scale: T, distance: T, sweep: &Sinusoid<T>) -> T {
    let (amplitude, distance) = (scale * sweep.amplitude(), distance.max(T::from_f64(ONE_SIDED)));
    let (mut sum, mut twice, mut sign) = (T::zero(), T::two(), T::one());
    loop {
        let [_, bessel] = (twice * amplitude).bessel_i_scaled();
        let term = (-(twice * distance)).exp() * bessel;
        sum = sum + sign * term;
        let (size, largest) = (term.bounds().1, sum.bounds().1);
        // Each term is less than a twentieth of the one before, with the other sign.
        if !(size > 0.5 * f64::EPSILON * largest) {
            return T::from_f64(4.0) * sum.give_or_take(size) / sweep.amplitude();
        }
        (twice, sign) = (twice + T::two(), -sign);
    }
}
