//! Describing function of the hyperbolic tangent.

use super::closed_form::{ClosedForm, finite};
use super::pole::{Pole, Scaled};
use super::{DescribingError, DescribingFunction};
use crate::nonlinearity::{Sinusoid, Tanh};
use crate::numeric::special::Special;

/// Poles summed individually; the remainder follows from the Abel-Plana formula.
const POLES: u32 = 10;
/// Nodes and weights of Gauss's rule for `integral f(pi y)/(exp(2 pi y) + 1) dy` over positive y, f odd: exact to degree 11.
const RULE: [(f64, f64); 3] = [
    (0.961_420_926_979_851_7, 0.060_860_248_839_207_03),
    (2.880_869_064_618_294, 0.002_390_432_201_893_670_5),
    (5.948_616_840_527_803, 8.574_751_818_290_404e-6),
];
/// Bound of the rule's truncation error, for every sweep. By Cauchy's estimate, with `abs(1/S) <= 1/Re(c)`, the first odd
/// Taylor coefficient that it does not integrate exactly is below `37/(pi n^14)` for the mean and `362/(pi^2 n^15)` for the
/// component at `c = n pi`, and the 13th moment is 1/24; twice for the integral and its rule, twice for two poles.
const REST: f64 = 2.5e-14;
/// Distance `k (abs(B) - X)` from which the exponential series gives `P`: the sum over poles cancels there.
const ONE_SIDED: f64 = 2.0;

impl<T: Special> ClosedForm for Tanh<T> {
    /// No elementary form is known. The partial fractions `tanh y = sum 2y/(y^2 + c^2)`, `c = pi/2, 3pi/2, ...`, give
    /// `F_0 = 2 gain sum Im 1/S` and `P = 4 gain k sum Re 1/(S (w + S))` with `w = c - i kB`, `S = sqrt(w^2 + (kX)^2)`; the
    /// tail of the sum is an elementary integral and the formula of Abel and Plana, by Gauss's rule. Where the whole sweep is on
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
    let scaled = Scaled::new(scale, sweep);
    let place = |n: f64| T::pi() * T::from_f64(n);
    let c = place(f64::from(POLES));
    let start = Pole::new(c, &scaled);
    let (mut mean, mut component) = (T::inverse_pi() * start.mean_beyond(), T::inverse_pi() * start.component_beyond());
    for n in 0..POLES {
        let pole = Pole::new(place(f64::from(n) + 0.5), &scaled);
        (mean, component) = (mean + pole.mean(), component + pole.component().re);
    }
    let four_bias = T::from_f64(4.0) * scaled.bias();
    for (node, weight) in RULE.map(|(node, weight)| (T::from_f64(node), T::from_f64(weight))) {
        let (above, below) = (Pole::new(c, &scaled.moved(node)), Pole::new(c, &scaled.moved(-node)));
        // The difference of the real parts of 1/S, in which a small bias would cancel:
        // 4 i beta (c - i y)/(S_1 S_2 (S_1 + S_2)) with S_2 conjugate.
        let (a, b) = (above.root, below.root.conjugate());
        let product = a * b * (a + b);
        let size = product.re.square() + product.im.square();
        mean = mean + weight * (four_bias * (node * product.re + c * product.im) / size);
        component = component + weight * (below.component().im - above.component().im);
    }
    (T::two() * mean.inflate(REST), T::from_f64(4.0) * scale * component.inflate(REST))
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
        // Terms alternate in sign, each less than 1/20 of its predecessor.
        if !(size > 0.5 * f64::EPSILON * largest) {
            return T::from_f64(4.0) * sum.inflate(size) / sweep.amplitude();
        }
        (twice, sign) = (twice + T::two(), -sign);
    }
}

#[cfg(test)]
mod tests {
    use super::RULE;

    /// `integral (pi y)^(2k-1)/(exp(2 pi y) + 1) dy = (1 - 2^(1-2k)) pi^(2k-1) abs(B_2k)/(4k)` by Bernoulli's numbers.
    #[test]
    fn the_rule_has_the_moments_of_its_weight() {
        let bernoulli = [1.0 / 6.0, 1.0 / 30.0, 1.0 / 42.0, 1.0 / 30.0, 5.0 / 66.0, 691.0 / 2730.0];
        for (k, bernoulli) in (1..).zip(bernoulli) {
            let power = 2 * k - 1;
            let moment =
                (1.0 - 0.5_f64.powi(power)) * core::f64::consts::PI.powi(power) * bernoulli / (4.0 * f64::from(k));
            let sum: f64 = RULE.iter().map(|(node, weight)| weight * node.powi(power)).sum();
            assert!((sum - moment).abs() < 1e-14 * moment, "degree {power}: {sum}, {moment}");
        }
    }
}
