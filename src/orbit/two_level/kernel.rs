//! The plant's periodic answer to a single input step a period, over intervals of time and period.
//!
//! A two-level input is a constant plus the difference of two such steps: the periodic output is
//! `gain u + (high - low)(W(t1) - W(t2))`, with `t1`, `t2` the times since its last rise and fall. For a group of poles
//! away from zero `W = output(A^-1 exp(A t) (1 - exp(A T))^-1)`, for an unstable group
//! `-output(A^-1 exp(-A (T - t)) (1 - exp(-A T))^-1)`. Where `abs(A) T <= 1`, and for poles at zero, the mean of the
//! input is split off and `W = -sum_(j >= 2) (B_j(t/T)/j!) output(A^(j-2)) T^(j-1)`, which does not cancel.

use core::f64::consts::TAU;
use core::iter::successors;
use std::sync::LazyLock;

use super::algebra::{Element, ONE, add, scaled};
use super::modes::Mode;
use crate::numeric::{Interval, Real};
use crate::proof::Gradient;

/// Terms of the series in Bernoulli polynomials: the ratio of successive terms is at most `1/(2 pi)`.
const TERMS: usize = 22;
/// `B_j(x)/j!` by degree.
type Polynomials = [Interval; TERMS + 1];

/// A moment in the period: time since the step, time until the next step, and the share of the period gone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    pub(super) time: Interval,
    pub(super) rest: Interval,
    pub(super) share: Interval,
}

/// A group at a given period.
#[derive(Debug)]
enum GroupForm {
    /// `A^-1`; `(1 - exp(+-A T))^-1`; and the difference between the derivatives by the period and by time.
    Closed { inverse: Element, factor: Element, turned: Element },
    /// `output(A^i) T^(i+1)`, and a bound of the sum of those that are left out.
    Series { weights: Vec<Interval>, rest: f64 },
}

/// All groups at a given period.
#[derive(Debug)]
pub(super) struct Periodic<'a> {
    period: Interval,
    modes: &'a [Mode],
    forms: Vec<GroupForm>,
    /// Degree of the highest Bernoulli polynomial that a form has.
    degree: usize,
}

impl<'a> Periodic<'a> {
    /// `None` where the period is that of a pole on the imaginary axis.
    pub(super) fn new(modes: &'a [Mode], period: Interval) -> Option<Self> {
        let form = |mode: &Mode| match mode.inverse {
            Some(inverse) if mode.algebra.size() * period.upper() > 1.0 => GroupForm::closed(mode, inverse, period),
            _ => Some(GroupForm::series(mode, period)),
        };
        let forms: Vec<GroupForm> = modes.iter().map(form).collect::<Option<_>>()?;
        let degree = |form: &GroupForm| match form {
            GroupForm::Closed { .. } => 0,
            GroupForm::Series { weights, .. } => weights.len() + 1,
        };
        Some(Self { period, modes, degree: forms.iter().map(degree).max().unwrap_or(0), forms })
    }

    /// Gains at s = 0 by which the present input counts, and its mean.
    pub(super) fn gains(&self) -> (Interval, Interval) {
        let (mut present, mut mean) = (Interval::ZERO, Interval::ZERO);
        for (mode, form) in self.modes.iter().zip(&self.forms) {
            match (mode.static_gain(), form) {
                (Some(gain), GroupForm::Closed { .. }) => present += gain,
                (Some(gain), GroupForm::Series { .. }) => mean += gain,
                (None, _) => {}
            }
        }
        (present, mean)
    }

    /// `W` over the moments, with its derivatives by time at constant period, and by period at constant time.
    pub(super) fn answer(&self, at: &Moment) -> Gradient<2> {
        let polynomials = bernoulli(at.share, self.degree);
        let answers = self.modes.iter().zip(&self.forms).map(|(mode, form)| match form {
            GroupForm::Closed { inverse, factor, turned } => closed(mode, [inverse, factor, turned], at),
            GroupForm::Series { weights, rest } => series(weights, *rest, &polynomials, at.share, self.period),
        });
        answers.fold(Gradient::constant(Interval::ZERO), |sum, answer| sum + answer)
    }
}

impl GroupForm {
    fn closed(mode: &Mode, inverse: Element, period: Interval) -> Option<Self> {
        let algebra = &mode.algebra;
        let gone = algebra.exponential(if mode.backwards { -period } else { period });
        let factor = algebra.reciprocal(&add(&ONE, &negated(&gone)))?;
        // Differentiated by the period: exp(A t) exp(A T) (1 - exp(A T))^-2, and exp(-A (T - t)) (1 - exp(-A T))^-2.
        let turned = if mode.backwards { negated(&factor) } else { algebra.product(&gone, &factor) };
        Some(Self::Closed { inverse, factor, turned })
    }

    fn series(mode: &Mode, period: Interval) -> Self {
        let algebra = &mode.algebra;
        let size = algebra.size() * period.upper();
        let (count, rest) = match mode.inverse {
            None => (algebra.degree, 0.0),
            Some(_) => (terms(size) - 1, (period * Interval::point(mode.reach() * remainder(size))).upper()),
        };
        let step = scaled(&algebra.generator(), period);
        let powers = successors(Some(ONE), |power| Some(algebra.product(power, &step))).take(count);
        Self::Series { weights: powers.map(|power| mode.output(&power) * period).collect(), rest }
    }
}

fn negated(element: &Element) -> Element {
    scaled(element, -Interval::ONE)
}

fn closed(mode: &Mode, [inverse, factor, turned]: [&Element; 3], at: &Moment) -> Gradient<2> {
    let algebra = &mode.algebra;
    let motion = if mode.backwards {
        negated(&algebra.product(&algebra.exponential(-at.rest), factor))
    } else {
        algebra.product(&algebra.exponential(at.time), factor)
    };
    let [value, by_time, by_period] =
        [algebra.product(inverse, &motion), motion, algebra.product(&motion, turned)].map(|state| mode.output(&state));
    Gradient::new(value, [by_time, by_period])
}

/// Terms after which, by the ratio of at most `size/(2 pi)`, the remainder is below the rounding.
fn terms(size: f64) -> usize {
    (8..TERMS).find(|&terms| (size / TAU).powi(terms as i32) < 1e-18).unwrap_or(TERMS)
}

/// Bounds the sum of `(j + 7) abs(B_j(x))/j! size^(j-2)` over `j > terms`, as `abs(B_j(x))/j! <= 2 zeta(2)/(2 pi)^j <= 4/(2 pi)^j` and
/// `size <= 1`: less than `4 (terms + 9)/(2 pi)^2 q^(terms-1)/(1 - q)^2`, `q = size/(2 pi)`; `4/(2 pi)^2 < 0.102` has
/// room for rounding.
fn remainder(size: f64) -> f64 {
    let (terms, ratio) = (terms(size), size / TAU);
    0.11 * (terms as f64 + 9.0) * ratio.powi(terms as i32 - 1) / (1.0 - ratio).powi(2)
}

fn series(weights: &[Interval], rest: f64, of: &Polynomials, share: Interval, period: Interval) -> Gradient<2> {
    let (mut value, mut by_time, mut by_period) = (Interval::ZERO, Interval::ZERO, Interval::ZERO);
    for (at, &weight) in weights.iter().enumerate() {
        let (this, last) = (of[at + 2], of[at + 1]);
        value += weight * this;
        by_time += weight * last;
        by_period += weight * (Interval::point((at + 1) as f64) * this - share * last);
    }
    let (left_out, over) = (Interval::symmetric(rest), Interval::ONE / period);
    Gradient::new(-value + left_out, [by_time, by_period].map(|slope| -(slope + left_out) * over))
}

/// Over `x` in [0, 1], up to a degree, by Taylor's formula about 1/2.
fn bernoulli(share: Interval, degree: usize) -> Polynomials {
    let mut polynomials = [Interval::ZERO; TERMS + 1];
    if degree == 0 {
        return polynomials;
    }
    let TermTable { middles, over_factorials } = &*TABLE;
    let from_middle = share - Interval::point(0.5);
    let mut powers = [Interval::ONE; TERMS + 1];
    for at in 1..=degree {
        // An even power of an interval about zero is not negative.
        powers[at] = if at % 2 == 0 { powers[at / 2].square() } else { powers[at - 1] * from_middle };
    }
    for at in 1..=degree {
        powers[at] *= over_factorials[at];
    }
    for (j, polynomial) in polynomials.iter_mut().enumerate().take(degree + 1) {
        *polynomial = Interval::dot((0..=j / 2).map(|k| (middles[k], powers[j - 2 * k])));
    }
    polynomials
}

/// The coefficients of the Bernoulli polynomials.
struct TermTable {
    /// `B_2k(1/2)/(2k)!`.
    middles: [Interval; TERMS / 2 + 1],
    over_factorials: [Interval; TERMS + 1],
}

static TABLE: LazyLock<TermTable> = LazyLock::new(|| {
    // Exact up to 22!, which has 51 significant bits once its factors of two are taken out.
    let factorial = |of: usize| (2..=of).fold(1.0, |product, factor| product * factor as f64);
    let over_factorials: [Interval; TERMS + 1] =
        core::array::from_fn(|of| Interval::ONE / Interval::point(factorial(of)));
    // x/2 over sinh(x/2) is the sum of middles_k x^(2 k).
    let mut middles = [Interval::ONE; TERMS / 2 + 1];
    for n in 1..middles.len() {
        let term = |k: usize| {
            let divisor = 4.0_f64.powi((n - k) as i32) * (2 * (n - k) + 1) as f64;
            middles[k] * over_factorials[2 * (n - k)] / Interval::point(divisor)
        };
        middles[n] = -(0..n).map(term).fold(Interval::ZERO, |sum, term| sum + term);
    }
    TermTable { middles, over_factorials }
});

/// The poles at zero over a long period: the output's rise from the lower to the upper change, per unit of the step, as a polynomial
/// in the period, ascending. `share` of it is spent at the upper level, and no half-period is below `delay`.
///
/// With `W = -sum_j output(A^(j-1)) T^j b_(j+1)(t/T)`, `b_n = B_n/n!`, and Taylor's formula in `delay/T` the rise is
/// `-sum_j output(A^(j-1)) sum_m T^(j-m) (-delay)^m/m! d_(j+1-m)`, `d_n = b_n(share) + b_n(1 - share) - 2 b_n(1)`, which
/// vanishes for odd `n > 1` and is -1 for `n = 1`, 0 for `n = 0`.
pub(super) fn rise_at_zero(modes: &[Mode], share: Interval, delay: Interval) -> Vec<Interval> {
    let Some(mode) = modes.first().filter(|mode| mode.inverse.is_none()) else { return Vec::new() };
    let degree = mode.algebra.degree;
    let (at_share, at_one) = (bernoulli(share, degree + 1), bernoulli(Interval::ONE, degree + 1));
    let difference = |n: usize| match n {
        0 => Interval::ZERO,
        1 => -Interval::ONE,
        n if n % 2 == 1 => Interval::ZERO,
        n => (at_share[n] - at_one[n]) * Interval::two(),
    };
    let mut ascending = vec![Interval::ZERO; degree + 1];
    for j in 1..=degree {
        let mut weight = -mode.output_row()[j - 1];
        for m in 0..=j {
            ascending[j - m] += weight * difference(j + 1 - m);
            weight = weight * -delay / Interval::point((m + 1) as f64);
        }
    }
    ascending
}
