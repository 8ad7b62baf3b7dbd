//! The inverse frequency response `g_k(w) = 1/G(jkw)` of a strictly proper plant with dead time.

use super::closed_loop::LipschitzLoop;
use crate::numeric::{Complex, Interval, Real};

impl LipschitzLoop<'_> {
    /// Degree of the denominator less that of the numerator.
    pub(super) fn relative_degree(&self) -> usize {
        self.plant.denominator().len() - self.plant.numerator().len()
    }

    /// `g_k` and its derivative by `w`: with `s = jkw`, `dg_k/dw = jk exp(s L) ((D' N - D N')/N^2 + L D/N)`.
    pub(super) fn inverse_response<T: Real>(&self, omega: T, k: usize) -> (Complex<T>, Complex<T>) {
        let order = T::from_f64(k as f64);
        let y = order * omega;
        let (denominator, denominator_slope) = polynomial(self.plant.denominator(), y);
        let (numerator, numerator_slope) = polynomial(self.plant.numerator(), y);
        let delay = T::from_f64(self.plant.delay_s());
        let turn = if delay.vanishes() { Complex::new(T::one(), T::zero()) } else { Complex::turn(y * delay) };
        let plain = denominator.over(numerator);
        let slope = (denominator_slope - plain * numerator_slope).over(numerator);
        (plain * turn, ((slope + plain.scaled(delay)) * turn).times_j().scaled(order))
    }

    /// A number `c` with `abs(g(jy)) >= c y^q` for all `y >= from`, q the relative degree: lower orders count less as y grows.
    pub(super) fn growth(&self, from: Interval) -> Interval {
        // The share of the orders below the leading order: sum over i of abs(p_i/p_n) y^(i - n).
        let share = |coefficients: &[f64]| {
            let mut power = Interval::ONE;
            coefficients.iter().skip(1).fold(Interval::ZERO, |sum, &coefficient| {
                power = power / from;
                sum + (Interval::point(coefficient) / Interval::point(coefficients[0])).abs() * power
            })
        };
        let (denominator, numerator) = (self.plant.denominator(), self.plant.numerator());
        let leading = (Interval::point(denominator[0]) / Interval::point(numerator[0])).abs();
        leading * (Interval::ONE - share(denominator)) / (Interval::ONE + share(numerator))
    }
}

/// Value and derivative by `s` of a polynomial in descending powers at `s = jy`.
fn polynomial<T: Real>(descending: &[f64], y: T) -> (Complex<T>, Complex<T>) {
    descending.iter().fold((Complex::zero(), Complex::zero()), |(value, slope), &coefficient| {
        let value_next = value.times_j().scaled(y) + Complex::new(T::from_f64(coefficient), T::zero());
        (value_next, slope.times_j().scaled(y) + value)
    })
}
