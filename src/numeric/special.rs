//! Special functions of the smooth catalogue, in every arithmetic: values to a few units in the last place, or enclosures.

use super::power::{self, PowerMoments};
use super::{Interval, Jet, Real, Scalar, bessel};

/// An arithmetic that has the special functions that the describing functions of smooth characteristics are made of.
///
/// Floats and dual numbers compute them in double precision. Intervals enclose them, the rest of each series included, and
/// jets their Taylor coefficients.
///
/// ```
/// use selfosc::numeric::{Interval, special::Special};
/// let [j0, _] = 2.404_825_557_695_773_f64.bessel_j();
/// assert!(j0.abs() < 1e-15);
/// let [enclosed, _] = Interval::point(2.404_825_557_695_773).bessel_j();
/// assert!(enclosed.contains(j0) && enclosed.width() < 1e-14);
/// ```
pub trait Special: Real {
    /// `[J_0(x), J_1(x)]`, domain `x >= 0`. An enclosure's width grows to 1e-11 about `x = 14`.
    fn bessel_j(self) -> [Self; 2];
    /// `exp(-x) [I_0(x), I_1(x)]`, domain `x >= 0`: they neither overflow nor vanish.
    fn bessel_i_scaled(self) -> [Self; 2];
    /// `[<f(x)>, <sin f(x)>]` over a turn of the sine, for `x = bias + amplitude sin` and `f(x) = sgn(x) abs(x)^p`, p the
    /// exponent of `law`; domain `amplitude > 0`.
    fn power_moments(law: &PowerMoments, bias: Self, amplitude: Self) -> [Self; 2];
}

/// `f(x)/x` for an odd f with `f'(0) = 1/2`.
fn odd_over(first: f64, x: f64) -> f64 {
    if x == 0.0 { 0.5 } else { first / x }
}

impl<T: Scalar> Special for T {
    fn bessel_j(self) -> [Self; 2] {
        let x = self.value();
        let (zeroth, first) = (libm::j0(x), libm::j1(x));
        [self.lift(zeroth, -first), self.lift(first, zeroth - odd_over(first, x))]
    }
    fn bessel_i_scaled(self) -> [Self; 2] {
        let x = self.value();
        let [zeroth, first] = bessel::i_scaled(x);
        [self.lift(zeroth, first - zeroth), self.lift(first, zeroth - odd_over(first, x) - first)]
    }
    fn power_moments(law: &PowerMoments, bias: Self, amplitude: Self) -> [Self; 2] {
        power::of_scalar(law, bias, amplitude)
    }
}

impl Special for Interval {
    fn bessel_j(self) -> [Self; 2] {
        bessel::enclosed_j(self)
    }
    fn bessel_i_scaled(self) -> [Self; 2] {
        bessel::enclosed_i_scaled(self)
    }
    fn power_moments(law: &PowerMoments, bias: Self, amplitude: Self) -> [Self; 2] {
        power::of_interval(law, bias, amplitude)
    }
}

impl<const N: usize> Special for Jet<N> {
    fn bessel_j(self) -> [Self; 2] {
        self.bessel(self.value().bessel_j(), |zeroth, first, quotient| [-first, zeroth - quotient])
    }
    fn bessel_i_scaled(self) -> [Self; 2] {
        let values = self.value().bessel_i_scaled();
        self.bessel(values, |zeroth, first, quotient| [first - zeroth, zeroth - quotient - first])
    }
    fn power_moments(law: &PowerMoments, bias: Self, amplitude: Self) -> [Self; 2] {
        power::of_jet(law, bias, amplitude)
    }
}
