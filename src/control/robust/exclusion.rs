//! The proof: no loop of the set is critical at any frequency, by branch and bound over frequency and variables.

use super::ProcessIntervals;
use super::high_frequency::loop_gain_beyond;
use super::shape::Shape;
use crate::control::process::{DEGREE, Fraction, LinearProcess, PARAMETERS, constants};
use crate::control::roots::routh;
use crate::control::{Gains, RobustCriterion};
use crate::numeric::{Gradient, Interval, Real};

/// A criterion, or stability on the way from no delay to the process' own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Question {
    pub(super) criterion: RobustCriterion,
    pub(super) on_the_way: bool,
}

impl RobustCriterion {
    /// The variable that the criterion adds.
    fn variable(self) -> Interval {
        let between = |a: f64, b: f64| Interval::new(a, b).unwrap_or(Interval::ENTIRE);
        match self {
            Self::Sensitivity(_) => Interval::ONE,
            Self::Gain(factor) => between(1.0, factor.max(1.0)),
            Self::GainReduction(factor) => between((1.0 / factor).min(1.0), 1.0),
            Self::PhaseRad(angle) => between(-angle.abs(), angle.abs()),
            Self::DelayS(time_s) => between(0.0, time_s.max(0.0)),
        }
    }

    /// `|D + N exp(-j phi)|^2 - |D|^2/M^2`.
    fn excess<T: Real>(self, process: &LinearProcess<T>, gains: &Gains<f64>, omega: T, extra: T) -> T {
        let (angle, factor) = match self {
            Self::Sensitivity(_) => (omega * process.delay_s, T::one()),
            Self::Gain(_) | Self::GainReduction(_) => (omega * process.delay_s, extra),
            Self::PhaseRad(_) => (omega * process.delay_s + extra, T::one()),
            Self::DelayS(_) => (omega * (process.delay_s + extra), T::one()),
        };
        let [[re, im], [below_re, below_im]] = process.open_loop(constants(gains)).parts(omega, angle);
        let sum = (below_re + factor * re).square() + (below_im + factor * im).square();
        match self {
            Self::Sensitivity(most) => sum - T::from_f64(1.0 / (most * most)) * (below_re.square() + below_im.square()),
            _ => sum,
        }
    }
}

/// Parameters, frequency, and the criterion's own variable.
pub(super) const VARIABLES: usize = PARAMETERS + 2;
pub(super) const OMEGA: usize = PARAMETERS;
pub(super) const EXTRA: usize = PARAMETERS + 1;
/// Boxes that one proof may take: about a second.
const BOXES: usize = 40_000;
/// Boxes of the mean value form that take as long as one of Taylor's.
const TAYLOR: usize = 10;
/// Octaves below and above 1 rad/s in which the end of the frequencies is looked for.
const OCTAVES: i32 = 100;
/// Sides smaller than this, relative to the whole, are not halved any more.
const SMALLEST: f64 = 1e-12;

/// Of the excess on a box of variables.
pub(super) enum Verdict {
    Positive,
    /// Not positive at some point.
    Negative,
    /// Undecided on a face of the box, which is to be halved along a side.
    Open([Interval; VARIABLES], usize),
}

impl ProcessIntervals {
    /// Whether the excess is above zero at every frequency, for every process.
    pub(super) fn excluded(&self, gains: &Gains<f64>, question: Question) -> bool {
        let Some(highest) = self.highest_frequency(gains, question.criterion) else { return false };
        let Some(omega) = Interval::new(0.0, highest) else { return false };
        let mut domain = [Interval::ZERO; VARIABLES];
        domain[..PARAMETERS].copy_from_slice(&self.shape.sides(&self.process));
        (domain[OMEGA], domain[EXTRA]) = (omega, question.criterion.variable());
        if question.on_the_way {
            domain[EXTRA] = Interval::ZERO.hull(Interval::ONE);
        }
        let ellipsoid = matches!(self.shape, Shape::Ellipsoid { .. }) && !self.wide().is_empty();
        let (mut open, mut boxes) = (vec![domain], 0);
        while let Some(at) = open.pop() {
            boxes += if ellipsoid { TAYLOR } else { 1 };
            let verdict =
                if ellipsoid { self.on_ellipsoid(question, gains, at) } else { self.on_box(question, gains, at) };
            let (face, side) = match verdict {
                Verdict::Positive => continue,
                Verdict::Negative => return false,
                Verdict::Open(face, side) => (face, side),
            };
            let large_enough = face[side].width() > SMALLEST * domain[side].width();
            if boxes >= BOXES || !large_enough {
                return false;
            }
            let (lower, upper) = halves(face[side], side == OMEGA);
            for half in [upper, lower] {
                let mut part = face;
                part[side] = half;
                open.push(part);
            }
        }
        true
    }

    /// The excess as a function of the variables.
    pub(super) fn excess<T: Real>(&self, question: Question, gains: &Gains<f64>, variables: [T; VARIABLES]) -> T {
        let process = self.shape.process(core::array::from_fn(|k| variables[k]));
        let (omega, extra) = (variables[OMEGA], variables[EXTRA]);
        if question.on_the_way {
            let sooner = LinearProcess { delay_s: process.delay_s * extra, ..process };
            question.criterion.excess(&sooner, gains, omega, T::one())
        } else {
            question.criterion.excess(&process, gains, omega, extra)
        }
    }

    /// What is known of the excess on a box of variables, by the mean value form.
    fn on_box(&self, question: Question, gains: &Gains<f64>, mut at: [Interval; VARIABLES]) -> Verdict {
        loop {
            if self.excess(question, gains, at).is_positive() {
                return Verdict::Positive;
            }
            let slopes = self.excess(question, gains, Gradient::variables(at)).slopes();
            // A function that rises along a side is least at its lower end.
            let mut fell = false;
            for (side, slope) in at.iter_mut().zip(slopes) {
                let end = if slope.lower() >= 0.0 {
                    side.lower()
                } else if slope.upper() <= 0.0 {
                    side.upper()
                } else {
                    continue;
                };
                fell |= !side.is_point();
                *side = Interval::point(end);
            }
            if fell {
                continue;
            }
            // Mean value form about any c: F(x) >= F(c) + sum F'_i (x_i - c_i). The bound is largest where both ends of F'_i = [l, u]
            // leave the same, u (c - low) = -l (high - c) (Baumann, *BIT* 28, 1988).
            let centre = core::array::from_fn(|k| {
                let (side, slope) = (at[k], slopes[k]);
                let share = slope.upper() / slope.width();
                let best = share * side.lower() + (1.0 - share) * side.upper();
                Interval::point(if side.contains(best) { best } else { side.midpoint() })
            });
            let least = self.excess(question, gains, centre);
            if least.is_negative() {
                return Verdict::Negative;
            }
            let form = (0..VARIABLES)
                .filter(|k| !at[*k].is_point())
                .fold(least, |sum, k| sum + slopes[k] * (at[k] - centre[k]));
            if form.is_positive() {
                return Verdict::Positive;
            }
            let size = |k: &usize| if at[*k].is_point() { -1.0 } else { slopes[*k].magnitude() * at[*k].width() };
            let widest = (0..VARIABLES).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(OMEGA);
            return Verdict::Open(at, widest);
        }
    }

    /// A frequency above which `|L|` is too small for the criterion to fail, for every process.
    pub(super) fn highest_frequency(&self, gains: &Gains<f64>, criterion: RobustCriterion) -> Option<f64> {
        let (factor, most) = match criterion {
            RobustCriterion::Gain(factor) => (factor.max(1.0), 1.0),
            RobustCriterion::Sensitivity(most) => (1.0, 1.0 - 1.0 / most),
            _ => (1.0, 1.0),
        };
        (-OCTAVES..OCTAVES).map(|k| 2f64.powi(k)).find(|omega| {
            let bound = loop_gain_beyond(&self.process, gains, *omega);
            bound.is_some_and(|bound| (Interval::point(factor) * bound).upper() < most)
        })
    }
}

/// Halves in the middle; of a wide range of frequencies in its geometric middle.
fn halves(whole: Interval, of_frequency: bool) -> (Interval, Interval) {
    let (low, high) = (whole.lower(), whole.upper());
    let middle = match (of_frequency, low > 0.0) {
        (true, true) if high > 2.0 * low => (low * high).sqrt(),
        (true, false) => high / 4.0,
        _ => return whole.bisect(),
    };
    match (Interval::new(low, middle), Interval::new(middle, high)) {
        (Some(lower), Some(upper)) => (lower, upper),
        _ => whole.bisect(),
    }
}

/// Whether all roots of numerator plus denominator decay: the first column of Routh's table is positive, in intervals.
pub(super) fn is_hurwitz(open_loop: &Fraction<Interval>) -> bool {
    let sum: [Interval; DEGREE + 1] = core::array::from_fn(|k| open_loop.numerator[k] + open_loop.denominator[k]);
    let Some(degree) = sum.iter().rposition(|c| *c != Interval::ZERO) else { return false };
    let column = routh(&sum, degree);
    let sign = if column[0].is_negative() { -Interval::ONE } else { Interval::ONE };
    (0..degree).all(|k| (sign * column[k]).is_positive() && (sign * column[k + 1]).is_positive())
}
