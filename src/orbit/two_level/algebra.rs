//! The functions of a group of poles: the algebra of polynomials in its nilpotent or rotating part, over intervals.
//!
//! A group of `degree` poles is `A = shift + scale nu` with `nu^degree = sum_j modulus_j nu^j` and
//! `sum_j abs(modulus_j) <= 1`. Thus `abs(sum_i a_i nu^i) = sum_i abs(a_i)` is a norm under which a product is at most
//! the product of the norms, and every function of `A` is an element of at most `MOST` coordinates.

use core::iter::successors;

use nalgebra::DMatrix;

use crate::numeric::{Interval, Real};
use crate::proof::interval_matrix::solve;

/// The most poles of a group.
pub(super) const MOST: usize = 4;
/// The most terms of an exponential: four poles in a row take up to 140.
const TERMS: u32 = 160;
/// Share of its largest term below which the remainder ends an exponential.
const NEGLIGIBLE: f64 = 1e-22;

/// Coordinates in the powers of `nu`; those from `degree` on are zero.
pub(super) type Element = [Interval; MOST];

pub(super) const ZERO: Element = [Interval::ZERO; MOST];
pub(super) const ONE: Element = {
    let mut one = ZERO;
    one[0] = Interval::ONE;
    one
};

/// A group of poles.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Algebra {
    pub(super) degree: usize,
    /// Real part of the group's middle, 1/s.
    pub(super) shift: Interval,
    /// 1/s.
    pub(super) scale: f64,
    modulus: Element,
    /// That of a pair of complex poles, `nu^2 = modulus_0 < 0`, rad/s. Otherwise `nu` is nearly nilpotent: a real pole, or several
    /// near each other.
    pub(super) frequency: Option<Interval>,
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
            // exp((shift + nu scale) s) decays with shift below -scale.
            (false, 2..) if middle > 0.0 => 0.5 * middle,
            _ => 1.0,
        };
        for (power, (entry, &coefficient)) in modulus.iter_mut().zip(ascending).enumerate() {
            let unit = (power..degree).fold(Interval::ONE, |unit, _| unit * Interval::point(scale));
            *entry = -coefficient / unit;
        }
        let frequency = turning.then(|| (-square).sqrt());
        (norm(&modulus) <= 1.0).then_some(Self { degree, shift, scale, modulus, frequency })
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
        // Horner's rule in nu.
        (0..self.degree).rev().fold(ZERO, |sum, power| add(&self.times_nu(&sum), &scaled(a, b[power])))
    }

    /// Multiplication by an element as a matrix on the coordinates.
    pub(super) fn matrix(&self, element: &Element) -> DMatrix<Interval> {
        let columns = successors(Some(*element), |column| Some(self.times_nu(column))).take(self.degree);
        DMatrix::from_iterator(
            self.degree,
            self.degree,
            columns.flat_map(|column| column.into_iter().take(self.degree)),
        )
    }

    /// `None` where the element may be singular.
    pub(super) fn reciprocal(&self, element: &Element) -> Option<Element> {
        let mut reciprocal = ZERO;
        if self.degree == 2 {
            // (a + b nu) (a - b nu) = a^2 - b^2 nu^2, as modulus_1 = 0: narrower than elimination.
            let [a, b] = [element[0], element[1]];
            let square = a.square() - b.square() * self.modulus[0];
            let over = (!square.contains_zero()).then(|| Interval::ONE / square)?;
            (reciprocal[0], reciprocal[1]) = (a * over, -b * over);
        } else {
            let found = solve(self.matrix(element), DMatrix::identity(self.degree, 1))?;
            reciprocal.iter_mut().zip(&found).for_each(|(coordinate, &found)| *coordinate = found);
        }
        Some(reciprocal)
    }

    /// `exp(A time)` over all times of an interval of one sign, unbounded only where the group decays.
    pub(super) fn exponential(&self, time: Interval) -> Element {
        let (shift, scale) = (self.shift, Interval::point(self.scale));
        let decay = (shift * time).exp();
        if let Some(omega) = self.frequency {
            let angle = omega * time;
            let [sine, cosine] = if time.is_bounded() { [angle.sin(), angle.cos()] } else { [Interval::UNIT; 2] };
            return [decay * cosine, decay * sine * scale / omega, Interval::ZERO, Interval::ZERO];
        }
        // Terms exp(shift t) (scale t)^power/power! nu^power: each is extreme at the ends of the time, or at t = -power/shift.
        let term =
            |last: Interval, time: Interval, power: u32| last * (scale * time / Interval::point(f64::from(power)));
        let mut ends = [time.lower(), time.upper()].map(|end| match Interval::point(end) {
            end if end.is_bounded() => (end, (shift * end).exp()),
            end if (shift * end).is_negative() => (Interval::ONE, Interval::ZERO),
            _ => (Interval::ONE, Interval::ENTIRE),
        });
        let (mut sum, mut nu) = (scaled(&ONE, decay), self.times_nu(&ONE));
        // For x = scale abs(time) the sum of x^j/j! over j >= n is at most exp(x) x^n/n!, and at most exp(x). No later power of
        // nu has a larger norm: the remainder from the power n on is at most exp(shift time + x) size.
        let (mut tail, mut power) = (Interval::ONE, 0);
        let size = loop {
            power += 1;
            tail = term(tail, time.abs(), power);
            let size = norm(&nu) * tail.upper().min(1.0);
            if size < NEGLIGIBLE || power == TERMS {
                break Interval::point(size.next_up());
            }
            ends = ends.map(|(end, last)| (end, term(last, end, power)));
            let peak = (Interval::point(-f64::from(power)) / shift).intersection(time);
            let at_peak =
                |time: Interval| (1..=power).fold((shift * time).exp(), |last, power| term(last, time, power));
            let between = ends[0].1.hull(ends[1].1);
            sum = add(&sum, &scaled(&nu, peak.map_or(between, |time| between.hull(at_peak(time)))));
            nu = self.times_nu(&nu);
        };
        if norm(&nu) > 0.0 {
            let largest = ((shift + scale) * time).exp().hull(((shift - scale) * time).exp());
            let rest = Interval::symmetric((size * largest).upper());
            sum.iter_mut().take(self.degree).for_each(|coordinate| *coordinate += rest);
        }
        sum
    }
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
