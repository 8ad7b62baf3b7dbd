//! The plant's periodic answer to a single input step a period, over intervals of time and period.
//!
//! A two-level input is a constant plus the difference of two such steps: the periodic output is
//! `gain u + (high - low)(W(t1) - W(t2))`, with `t1`, `t2` the times since its last rise and fall. For a group of poles
//! away from zero `W = output(A^-1 exp(A t) (1 - exp(A T))^-1)`, for an unstable group
//! `-output(A^-1 exp(-A (T - t)) (1 - exp(-A T))^-1)`. Where `abs(A) T <= 1`, and for poles at zero, the mean of the
//! input is split off and `W = -sum_(j >= 2) (B_j(t/T)/j!) output(A^(j-2)) T^(j-1)`, which does not cancel.

use core::f64::consts::TAU;
use std::sync::LazyLock;

use super::algebra::{Element, ONE, ZERO, add, scaled};
use super::modes::Mode;
use crate::numeric::{Interval, Real};

/// Terms of the series in Bernoulli polynomials: the ratio of successive terms is at most `1/(2 pi)`.
const TERMS: usize = 22;
/// `B_2k(1/2)/(2k)! = (2^(1 - 2k) - 1) B_2k/(2k)!`: the Bernoulli numbers `B_2k` as fractions.
const BERNOULLI: [(f64, f64); 12] = [
    (1.0, 1.0),
    (1.0, 6.0),
    (-1.0, 30.0),
    (1.0, 42.0),
    (-1.0, 30.0),
    (5.0, 66.0),
    (-691.0, 2730.0),
    (7.0, 6.0),
    (-3617.0, 510.0),
    (43867.0, 798.0),
    (-174_611.0, 330.0),
    (854_513.0, 138.0),
];

/// A moment in the period: time since the step, time until the next step, and the share of the period gone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    pub(super) time: Interval,
    pub(super) rest: Interval,
    pub(super) share: Interval,
}

/// `W` with its derivatives by time at constant period, and by period at constant time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Answer {
    pub(super) value: Interval,
    pub(super) by_time: Interval,
    pub(super) by_period: Interval,
}

/// A group at a given period.
#[derive(Debug)]
enum Form {
    /// `(1 - exp(+-A T))^-1`, and the difference between the derivatives by the period and by time.
    Closed { factor: Element, turned: Element },
    /// `output(A^i) T^(i+1)`; the powers of `A T`; a bound of the omitted powers' sum, for `W` itself.
    Series { weights: Vec<Interval>, powers: Vec<Element>, rest: f64 },
}

/// All groups at a given period.
#[derive(Debug)]
pub(super) struct Periodic<'a> {
    period: Interval,
    modes: &'a [Mode],
    forms: Vec<Form>,
    /// Degree of the highest Bernoulli polynomial that a form has.
    degree: usize,
}

impl<'a> Periodic<'a> {
    /// `None` where the period is that of a pole on the imaginary axis.
    pub(super) fn new(modes: &'a [Mode], period: Interval) -> Option<Self> {
        let mut forms = Vec::with_capacity(modes.len());
        for mode in modes {
            let series = mode.inverse.is_none() || mode.algebra.size() * period.upper() <= 1.0;
            forms.push(if series { Form::series(mode, period) } else { Form::closed(mode, period)? });
        }
        Some(Self { period, modes, degree: degree(&forms), forms })
    }

    pub(super) fn period(&self) -> Interval {
        self.period
    }

    /// Gains at s = 0 by which the present input counts, and its mean.
    pub(super) fn gains(&self) -> (Interval, Interval) {
        let (mut present, mut mean) = (Interval::ZERO, Interval::ZERO);
        for (mode, form) in self.modes.iter().zip(&self.forms) {
            match (mode.static_gain(), form) {
                (Some(gain), Form::Closed { .. }) => present += gain,
                (Some(gain), Form::Series { .. }) => mean += gain,
                (None, _) => {}
            }
        }
        (present, mean)
    }

    /// `W` over the moments.
    pub(super) fn answer(&self, at: &Moment) -> Answer {
        let polynomials = bernoulli(at.share, self.degree);
        let mut sum = Answer { value: Interval::ZERO, by_time: Interval::ZERO, by_period: Interval::ZERO };
        for (mode, form) in self.modes.iter().zip(&self.forms) {
            let one = match form {
                Form::Closed { factor, turned } => closed(mode, factor, turned, at),
                Form::Series { weights, rest, .. } => series(weights, *rest, &polynomials, at.share, self.period),
            };
            sum.value += one.value;
            sum.by_time += one.by_time;
            sum.by_period += one.by_period;
        }
        sum
    }

    /// The states' rates per unit of the step: `W`'s derivative by time, before the output is read.
    pub(super) fn rates(&self, at: &Moment) -> Vec<Element> {
        let polynomials = bernoulli(at.share, self.degree);
        let rate = |(mode, form): (&Mode, &Form)| match form {
            Form::Closed { factor, .. } => decay(mode, factor, at),
            Form::Series { powers, .. } => {
                let term =
                    |sum: Element, (power, at): (&Element, usize)| add(&sum, &scaled(power, -polynomials[at + 1]));
                let sum = powers.iter().zip(0..).fold(ZERO, term);
                let left_out = Interval::symmetric(remainder(mode.algebra.size() * self.period.upper()));
                let rest = if mode.inverse.is_none() { Interval::ZERO } else { left_out };
                core::array::from_fn(|at| if at < mode.algebra.degree { sum[at] + rest } else { sum[at] })
            }
        };
        self.modes.iter().zip(&self.forms).map(rate).collect()
    }
}

impl Form {
    fn closed(mode: &Mode, period: Interval) -> Option<Self> {
        let gone = mode.algebra.exponential(period, mode.backwards);
        let left = add(&ONE, &scaled(&gone, -Interval::ONE));
        let factor = mode.algebra.reciprocal(&left)?;
        // Differentiated by the period: exp(A t) exp(A T) (1 - exp(A T))^-2, and exp(-A (T - t)) (1 - exp(-A T))^-2.
        let turned =
            if mode.backwards { scaled(&factor, -Interval::ONE) } else { mode.algebra.product(&gone, &factor) };
        Some(Self::Closed { factor, turned })
    }

    fn series(mode: &Mode, period: Interval) -> Self {
        let algebra = &mode.algebra;
        let size = algebra.size() * period.upper();
        let count = if mode.inverse.is_none() { algebra.degree } else { terms(size) - 1 };
        let step = scaled(&algebra.generator(), period);
        let mut powers = vec![ONE];
        for _ in 1..count {
            let next = algebra.product(&powers[powers.len() - 1], &step);
            powers.push(next);
        }
        let weights = powers.iter().map(|power| mode.output(power) * period).collect();
        let rest = if mode.inverse.is_none() {
            0.0
        } else {
            (period * Interval::point(mode.reach() * remainder(size))).upper()
        };
        Self::Series { weights, powers, rest }
    }
}

/// `exp(A t) (1 - exp(A T))^-1`, or of an unstable group `-exp(-A (T - t)) (1 - exp(-A T))^-1`.
fn decay(mode: &Mode, factor: &Element, at: &Moment) -> Element {
    let algebra = &mode.algebra;
    if mode.backwards {
        scaled(&algebra.product(&algebra.exponential(at.rest, true), factor), -Interval::ONE)
    } else {
        algebra.product(&algebra.exponential(at.time, false), factor)
    }
}

/// Degree of the highest Bernoulli polynomial in use; zero for none.
fn degree(forms: &[Form]) -> usize {
    let degree = |form: &Form| match form {
        Form::Closed { .. } => 0,
        Form::Series { weights, .. } => weights.len() + 1,
    };
    forms.iter().map(degree).max().unwrap_or(0)
}

fn closed(mode: &Mode, factor: &Element, turned: &Element, at: &Moment) -> Answer {
    let algebra = &mode.algebra;
    let motion = decay(mode, factor, at);
    let value =
        mode.inverse.as_ref().map_or(Interval::ENTIRE, |inverse| mode.output(&algebra.product(inverse, &motion)));
    Answer { value, by_time: mode.output(&motion), by_period: mode.output(&algebra.product(&motion, turned)) }
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

fn series(
    weights: &[Interval],
    rest: f64,
    polynomials: &[Interval; TERMS + 1],
    share: Interval,
    period: Interval,
) -> Answer {
    let (mut value, mut by_time, mut by_period) = (Interval::ZERO, Interval::ZERO, Interval::ZERO);
    for (at, &weight) in weights.iter().enumerate() {
        let (this, last) = (polynomials[at + 2], polynomials[at + 1]);
        value += weight * this;
        by_time += weight * last;
        by_period += weight * (Interval::point((at + 1) as f64) * this - share * last);
    }
    let (left_out, over) = (Interval::symmetric(rest), Interval::ONE / period);
    Answer {
        value: -value + left_out,
        by_time: -(by_time + left_out) * over,
        by_period: -(by_period + left_out) * over,
    }
}

/// `B_j(x)/j!` over `x` in [0, 1] for `j` up to a degree, by Taylor's formula about 1/2.
fn bernoulli(share: Interval, degree: usize) -> [Interval; TERMS + 1] {
    let mut polynomials = [Interval::ZERO; TERMS + 1];
    if degree == 0 {
        return polynomials;
    }
    let TermTable { middles, over_factorials, bounds } = &*TABLE;
    let from_middle = share - Interval::point(0.5);
    let mut powers = [Interval::ONE; TERMS + 1];
    for at in 1..=degree {
        // An even power of an interval about zero is not negative.
        let power = if at % 2 == 0 { powers[at / 2].square() } else { powers[at - 1] * from_middle };
        powers[at] = power;
    }
    for at in 1..=degree {
        powers[at] *= over_factorials[at];
    }
    for (j, polynomial) in polynomials.iter_mut().enumerate().take(degree + 1) {
        let sum = Interval::dot((0..=j / 2).map(|k| (middles[k], powers[j - 2 * k])));
        *polynomial = if j > 1 { sum.intersection(bounds[j]).unwrap_or(sum) } else { sum };
    }
    polynomials
}

/// The coefficients of the Bernoulli polynomials.
struct TermTable {
    /// `B_2k(1/2)/(2k)!`.
    middles: [Interval; TERMS / 2 + 1],
    over_factorials: [Interval; TERMS + 1],
    /// `4/(2 pi)^j`, from degree two on, where `2 zeta(2) < 3.3` for 4 would do: more than rounding takes.
    bounds: [Interval; TERMS + 1],
}

static TABLE: LazyLock<TermTable> = LazyLock::new(|| {
    // Exact up to 22!, which has 51 significant bits once its factors of two are taken out.
    let factorial = |of: usize| (2..=of).fold(1.0, |product, factor| product * factor as f64);
    let over_factorials = core::array::from_fn(|of| Interval::ONE / Interval::point(factorial(of)));
    let middles = core::array::from_fn(|k| {
        let (numerator, denominator) = BERNOULLI[k];
        let factor = Interval::point(0.5_f64.powi(2 * k as i32 - 1) - 1.0);
        factor * Interval::point(numerator) / Interval::point(denominator) / Interval::point(factorial(2 * k))
    });
    let bounds = core::array::from_fn(|j| Interval::symmetric((0..j).fold(4.0, |bound, _| bound / TAU)));
    TermTable { middles, over_factorials, bounds }
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

/// A bound of `abs(W)` over all moments and all periods up to this period; infinite where the series does not converge.
pub(super) fn bound(modes: &[Mode], period: f64) -> f64 {
    let period = Interval::point(period);
    let four_over = Interval::point(4.0) / (Interval::two() * Interval::PI).square();
    let one = |mode: &Mode| {
        let ratio = Interval::point(mode.algebra.size()) * period / (Interval::two() * Interval::PI);
        let rest = Interval::ONE - ratio;
        if !rest.is_positive() {
            return Interval::point(f64::INFINITY);
        }
        Interval::point(mode.reach()) * period * four_over / rest
    };
    modes.iter().map(one).fold(Interval::ZERO, |sum, one| sum + one).upper()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::orbit::two_level::modes::modes;
    use crate::plant::TransferFunction;

    fn moment(time: f64, period: f64) -> Moment {
        let [time, period] = [time, period].map(Interval::point);
        Moment { time, rest: period - time, share: time / period }
    }

    #[test]
    fn series_and_closed_form_agree() {
        // The same plant on both sides of the switch between the two forms, in differences: the orbit uses no more.
        for den in [vec![1.0, 1.0], vec![1.0, -0.7], vec![1.0, 0.4, 1.3], vec![1.0, 2.0, 1.0]] {
            let modes = modes(&TransferFunction::new(&[1.0], &den).unwrap()).unwrap();
            let period = 0.9 / modes.iter().map(|mode| mode.algebra.size()).fold(0.0, f64::max);
            let period = Interval::point(period);
            let build = |form: fn(&Mode, Interval) -> Form| Periodic {
                period,
                modes: &modes,
                forms: modes.iter().map(|mode| form(mode, period)).collect(),
                degree: TERMS,
            };
            let (by_series, by_closed) =
                (build(Form::series), build(|mode, period| Form::closed(mode, period).unwrap()));
            let [early, late] = [0.2, 0.7].map(|share| moment(share * period.midpoint(), period.midpoint()));
            let slopes = |periodic: &Periodic| [early, late].map(|at| periodic.answer(&at));
            let ([a, b], [c, d]) = (slopes(&by_series), slopes(&by_closed));
            // W differs by gain (t/T) and a function of the period.
            let gain = modes.iter().fold(Interval::ZERO, |sum, mode| sum + mode.static_gain().unwrap());
            let share = late.share - early.share;
            let (left, right) = (b.value - a.value, d.value - c.value - gain * share);
            assert!(left.intersection(right).is_some() && right.width() < 1e-13, "{den:?}: {left} {right}");
            let slope = gain / period;
            assert!(a.by_time.intersection(c.by_time - slope).is_some() && a.by_time.width() < 1e-14, "{den:?}");
            let bend = gain * share / period;
            let (left, right) = (b.by_period - a.by_period, d.by_period - c.by_period + bend);
            assert!(left.intersection(right).is_some() && left.width() < 1e-13, "{den:?}: {left} {right}");
        }
    }

    #[test]
    fn bernoulli_polynomials_are_those_of_the_tables() {
        let x = 0.3;
        let found = bernoulli(Interval::point(x), TERMS);
        let exact = [1.0, x - 0.5, (x * x - x + 1.0 / 6.0) / 2.0, (x * x * x - 1.5 * x * x + 0.5 * x) / 6.0];
        for (found, exact) in found.iter().zip(exact) {
            assert!((found.midpoint() - exact).abs() < 1e-16 && found.width() < 1e-15, "{found} {exact}");
        }
    }
}
