//! The functions of a group of poles: the algebra of polynomials in its nilpotent or rotating part, over intervals.
//!
//! A group of `degree` poles is `A = shift + scale nu` with `nu^degree = sum_j modulus_j nu^j` and
//! `sum_j abs(modulus_j) <= 1`. Thus `abs(sum_i a_i nu^i) = sum_i abs(a_i)` is a norm under which a product is at most
//! the product of the norms, and every function of `A` is an element of at most `MOST` coordinates.

use nalgebra::DMatrix;

use crate::numeric::{Interval, Real};
use crate::proof::interval_matrix::solve;

/// The most poles of a group.
pub(super) const MOST: usize = 4;
/// Terms of an exponential whose remainder is bounded by the norm of the next power of `nu`.
const TERMS: usize = 40;
/// Norm of a power of `nu` that counts as none.
const NEGLIGIBLE: f64 = 1e-22;

/// Coordinates in the powers of `nu`; those from `degree` on are zero.
pub(super) type Element = [Interval; MOST];

pub(super) const ZERO: Element = [Interval::ZERO; MOST];
pub(super) const ONE: Element = {
    let mut one = ZERO;
    one[0] = Interval::ONE;
    one
};

/// How far `exp(A s)` reaches for large `s`.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    /// `nu` turns: a pair of complex poles, `nu^2 = modulus_0 < 0`, at this frequency in rad/s.
    Turning(Interval),
    /// `nu` is nearly nilpotent: a real pole, or several within a few per cent.
    Nilpotent,
}

/// A group of poles.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Algebra {
    pub(super) degree: usize,
    /// Real part of the group's middle, 1/s.
    pub(super) shift: Interval,
    /// 1/s.
    pub(super) scale: f64,
    modulus: Element,
    shape: Shape,
}

impl Algebra {
    /// From a monic polynomial in `s - shift`, ascending, without its leading coefficient. `None` where no scale gives a norm.
    pub(super) fn new(shift: Interval, ascending: &[Interval]) -> Option<Self> {
        let degree = ascending.len();
        if degree == 0 || degree > MOST {
            return None;
        }
        let (middle, mut modulus) = (shift.midpoint().abs(), ZERO);
        let square = if degree == 2 { -ascending[0] } else { Interval::ZERO };
        let turning = degree == 2 && square.is_negative() && (-square).sqrt().lower() > 0.01 * middle;
        // Above the frequency by more than rounding: the norm of nu^2 stays below 1.
        let scale = match (turning, degree) {
            (true, _) => (-square).sqrt().upper() * (1.0 + 1e-12),
            (false, 1) => 1.0,
            // exp((shift + nu scale) s) decays with shift below -scale.
            (false, _) if middle > 0.0 => 0.5 * middle,
            (false, _) => 1.0,
        };
        if degree > 1 {
            for (power, (entry, &coefficient)) in modulus.iter_mut().zip(ascending).enumerate() {
                let unit = (power..degree).fold(Interval::ONE, |unit, _| unit * Interval::point(scale));
                *entry = -coefficient / unit;
            }
        }
        let shape = if turning { Shape::Turning((-square).sqrt()) } else { Shape::Nilpotent };
        let shift = if degree == 1 { shift - ascending[0] } else { shift };
        (norm(&modulus) <= 1.0).then_some(Self { degree, shift, scale, modulus, shape })
    }

    /// `A` itself.
    pub(super) fn generator(&self) -> Element {
        let mut element = ZERO;
        element[0] = self.shift;
        if self.degree > 1 {
            element[1] = Interval::point(self.scale);
        }
        element
    }

    /// A bound of the norm of `A`, 1/s.
    pub(super) fn size(&self) -> f64 {
        norm(&self.generator())
    }

    /// Half a turn of a complex pair, s, about.
    pub(super) fn half_turn_s(&self) -> Option<f64> {
        match self.shape {
            Shape::Turning(omega) => Some(core::f64::consts::PI / omega.midpoint()),
            Shape::Nilpotent => None,
        }
    }

    fn times_nu(&self, element: &Element) -> Element {
        let last = element[self.degree - 1];
        let mut shifted = ZERO;
        for (power, entry) in shifted.iter_mut().enumerate().take(self.degree) {
            let below = if power == 0 { Interval::ZERO } else { element[power - 1] };
            *entry = below + last * self.modulus[power];
        }
        shifted
    }

    pub(super) fn product(&self, a: &Element, b: &Element) -> Element {
        if self.degree == 1 {
            let mut product = ZERO;
            product[0] = a[0] * b[0];
            return product;
        }
        if self.degree == 2 {
            // nu^2 = modulus_0.
            let mut product = ZERO;
            product[0] = a[0] * b[0] + a[1] * b[1] * self.modulus[0];
            product[1] = a[0] * b[1] + a[1] * b[0];
            return product;
        }
        // Horner's rule in nu.
        (0..self.degree).rev().fold(ZERO, |sum, power| add(&self.times_nu(&sum), &scaled(a, b[power])))
    }

    /// `None` where the element may be singular.
    pub(super) fn reciprocal(&self, element: &Element) -> Option<Element> {
        let [a, b] = [element[0], element[1]];
        let mut reciprocal = ZERO;
        match self.degree {
            1 => {
                reciprocal[0] = (!a.contains_zero()).then(|| Interval::ONE / a)?;
            }
            2 => {
                // (a + b nu) (a - b nu) = a^2 - b^2 nu^2, as modulus_1 = 0.
                let square = a.square() - b.square() * self.modulus[0];
                let over = (!square.contains_zero()).then(|| Interval::ONE / square)?;
                (reciprocal[0], reciprocal[1]) = (a * over, -b * over);
            }
            degree => {
                let mut column = *element;
                let mut matrix = DMatrix::zeros(degree, degree);
                for power in 0..degree {
                    (0..degree).for_each(|row| matrix[(row, power)] = column[row]);
                    column = self.times_nu(&column);
                }
                let mut one = DMatrix::zeros(degree, 1);
                one[(0, 0)] = Interval::ONE;
                let found = solve(matrix, one)?;
                (0..degree).for_each(|row| reciprocal[row] = found[(row, 0)]);
            }
        }
        Some(reciprocal)
    }

    /// `exp(A time)`, or `exp(-A time)` backwards, over all `time >= 0` of an interval that may be unbounded.
    pub(super) fn exponential(&self, time: Interval, backwards: bool) -> Element {
        let rate = if backwards { -self.shift } else { self.shift };
        let sign = |power: usize| if backwards && power % 2 == 1 { -Interval::ONE } else { Interval::ONE };
        let mut sum = ZERO;
        if let Shape::Turning(omega) = self.shape {
            let decay = decaying_power(rate, time, 0);
            let (sine, cosine) = if time.is_bounded() {
                let angle = omega * time;
                (angle.sin(), angle.cos())
            } else {
                (Interval::UNIT, Interval::UNIT)
            };
            (sum[0], sum[1]) = (decay * cosine, sign(1) * decay * sine * Interval::point(self.scale) / omega);
            return sum;
        }
        sum[0] = decaying_power(rate, time, 0);
        if self.degree == 1 {
            return sum;
        }
        let (mut power_of_nu, mut power_of_scale) = (ONE, Interval::ONE);
        for power in 1..TERMS {
            power_of_nu = self.times_nu(&power_of_nu);
            power_of_scale *= Interval::point(self.scale);
            let size = norm(&power_of_nu);
            if size == 0.0 {
                break;
            }
            if size < NEGLIGIBLE {
                // The series' remainder is at most size exp((rate + scale) time).
                let largest = decaying_power(rate + Interval::point(self.scale), time, 0).magnitude();
                (0..self.degree).for_each(|at| sum[at] += Interval::symmetric(size * largest));
                break;
            }
            let weight = decaying_power(rate, time, power as i32) * power_of_scale * sign(power);
            sum = add(&sum, &scaled(&power_of_nu, weight));
        }
        sum
    }
}

/// `exp(rate time) time^power/power!` over `time >= 0`: by its ends, and by its maximum at `-power/rate` if that is between them.
fn decaying_power(rate: Interval, time: Interval, power: i32) -> Interval {
    let factorial = (1..=power).fold(Interval::ONE, |product, factor| product * Interval::point(f64::from(factor)));
    let at = |time: Interval| {
        let powers = (0..power).fold(Interval::ONE, |product, _| product * time);
        (rate * time).exp() * powers / factorial
    };
    let start = Interval::point(time.lower().max(0.0));
    let end = time.upper();
    if power == 0 && !time.is_point() && end < f64::INFINITY {
        return (rate * Interval::point(start.lower()).hull(Interval::point(end))).exp();
    }
    if end == f64::INFINITY {
        if !rate.is_negative() {
            return Interval::ENTIRE;
        }
        let peak = Interval::point(f64::from(power)) / -rate;
        let high = if power > 0 && peak.upper() >= start.lower() { at(peak.max(start)) } else { at(start) };
        return Interval::ZERO.hull(high);
    }
    let ends = at(start).hull(at(Interval::point(end)));
    if power == 0 || !rate.is_negative() {
        return ends;
    }
    let peak = Interval::point(f64::from(power)) / -rate;
    if peak.upper() < start.lower() || peak.lower() > end { ends } else { ends.hull(at(peak)) }
}

pub(super) fn add(a: &Element, b: &Element) -> Element {
    core::array::from_fn(|at| a[at] + b[at])
}

pub(super) fn scaled(a: &Element, factor: Interval) -> Element {
    a.map(|coordinate| if coordinate == Interval::ZERO { coordinate } else { coordinate * factor })
}

/// The sum of the coordinates' magnitudes, rounded up.
pub(super) fn norm(element: &Element) -> f64 {
    element.iter().fold(Interval::ZERO, |sum, coordinate| sum + coordinate.abs()).upper()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn holds(element: &Element, exact: &[f64]) -> bool {
        element.iter().zip(exact).all(|(bounds, &value)| bounds.inflate(1e-15 * value.abs()).contains(value))
    }

    #[test]
    fn a_pair_turns_and_a_double_pole_grows_linearly() {
        // s^2 + 2 s + 5: poles -1 +- 2j.
        let pair = Algebra::new(Interval::point(-1.0), &[4.0, 0.0].map(Interval::point)).unwrap();
        let turned = pair.exponential(Interval::point(0.3), false);
        let exact = [(-0.3_f64).exp() * 0.6_f64.cos(), (-0.3_f64).exp() * 0.6_f64.sin() * pair.scale / 2.0];
        assert!(holds(&turned, &exact) && turned[1].width() < 1e-15);
        let double = Algebra::new(Interval::point(-3.0), &[0.0, 0.0].map(Interval::point)).unwrap();
        let grown = double.exponential(Interval::point(0.7), false);
        assert!(holds(&grown, &[(-2.1_f64).exp(), (-2.1_f64).exp() * 0.7 * double.scale]));
        // Over all times: t exp(-3 t) <= exp(-1)/3.
        let all = double.exponential(Interval::new(0.0, f64::INFINITY).unwrap(), false);
        assert!((all[1].upper() - double.scale * (-1.0_f64).exp() / 3.0).abs() < 1e-15 && all[1].lower() <= 0.0);
    }

    #[test]
    fn powers_and_reciprocals_agree() {
        for ascending in [vec![0.002, 0.0], vec![1e-9, -1e-9, 1e-9], vec![2.0, 0.0]] {
            let group =
                Algebra::new(Interval::point(-0.8), &ascending.iter().map(|&c| Interval::point(c)).collect::<Vec<_>>());
            let group = group.unwrap();
            let there = group.exponential(Interval::point(0.9), false);
            let back = group.exponential(Interval::point(0.9), true);
            assert!(holds(&group.product(&there, &back), &[1.0, 0.0, 0.0, 0.0]));
            let inverse = group.reciprocal(&there).unwrap();
            assert!(inverse.iter().zip(&back).all(|(a, b)| a.intersection(*b).is_some()), "{inverse:?} {back:?}");
        }
    }
}
