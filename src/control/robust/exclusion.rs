//! The proof: no loop of the set is critical at any frequency, by branch and bound over frequency and variables.

use super::ProcessIntervals;
use crate::control::process::{Fraction, LinearProcess, PARAMETERS, constants};
use crate::control::{Gains, RobustCriterion};
use crate::numeric::{Gradient, Interval, Real};

/// A criterion, or stability on the way from no delay to the process' own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Question {
    pub(super) criterion: RobustCriterion,
    pub(super) on_the_way: bool,
}

impl RobustCriterion {
    /// The variable that the criterion adds, and `1/M^2`.
    fn variable(self) -> (Interval, f64) {
        let between = |a: f64, b: f64| Interval::new(a, b).unwrap_or(Interval::ENTIRE);
        match self {
            Self::Sensitivity(most) => (Interval::ONE, 1.0 / (most * most)),
            Self::Gain(factor) => (between(1.0, factor.max(1.0)), 0.0),
            Self::GainReduction(factor) => (between((1.0 / factor).min(1.0), 1.0), 0.0),
            Self::PhaseRad(angle) => (between(-angle.abs(), angle.abs()), 0.0),
            Self::DelayS(time_s) => (between(0.0, time_s.max(0.0)), 0.0),
        }
    }

    /// `|D + N exp(-j phi)|^2 - |D|^2/M^2`.
    fn excess<T: Real>(self, process: &LinearProcess<T>, gains: &Gains<f64>, omega: T, extra: T) -> T {
        let (open_loop, delay_s) = (process.open_loop(constants(gains)), process.delay_s);
        let share = T::from_f64(self.variable().1);
        let angle = match self {
            Self::PhaseRad(_) => omega * delay_s + extra,
            Self::DelayS(_) => omega * (delay_s + extra),
            _ => omega * delay_s,
        };
        let [[re, im], [below_re, below_im]] = open_loop.parts(omega, angle);
        let factor = match self {
            Self::Gain(_) | Self::GainReduction(_) => extra,
            _ => T::one(),
        };
        let sum = (below_re + factor * re).square() + (below_im + factor * im).square();
        match self {
            Self::Sensitivity(_) => sum - share * (below_re.square() + below_im.square()),
            _ => sum,
        }
    }
}

/// Parameters, frequency, and the criterion's own variable.
const VARIABLES: usize = PARAMETERS + 2;
const OMEGA: usize = PARAMETERS;
const EXTRA: usize = PARAMETERS + 1;
/// Boxes that one proof may take: some two seconds.
const BOXES: usize = 100_000;
/// Octaves below and above 1 rad/s in which the end of the frequencies is looked for.
const OCTAVES: i32 = 100;
/// Sides smaller than this, relative to the whole, are not halved any more.
const SMALLEST: f64 = 1e-12;

impl ProcessIntervals {
    /// Whether the excess is above zero at every frequency, for every process.
    pub(super) fn excluded(&self, gains: &Gains<f64>, question: Question) -> bool {
        let Some(highest) = self.highest_frequency(gains, question.criterion) else { return false };
        let Some(omega) = Interval::new(0.0, highest) else { return false };
        let mut domain = [Interval::ZERO; VARIABLES];
        domain[..PARAMETERS].copy_from_slice(&self.shape.sides(&self.process));
        (domain[OMEGA], domain[EXTRA]) = (omega, question.criterion.variable().0);
        if question.on_the_way {
            domain[EXTRA] = Interval::ZERO.hull(Interval::ONE);
        }
        let (mut open, mut boxes) = (vec![domain], 0);
        while let Some(at) = open.pop() {
            boxes += 1;
            let Some((face, side)) = self.undecided(question, gains, at) else { continue };
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
    fn excess<T: Real>(&self, question: Question, gains: &Gains<f64>, variables: [T; VARIABLES]) -> T {
        let process = self.shape.process(core::array::from_fn(|k| variables[k]));
        let (omega, extra) = (variables[OMEGA], variables[EXTRA]);
        if question.on_the_way {
            let sooner = LinearProcess { delay_s: process.delay_s * extra, ..process };
            question.criterion.excess(&sooner, gains, omega, T::one())
        } else {
            question.criterion.excess(&process, gains, omega, extra)
        }
    }

    /// `None` where the excess is positive on the box; else a face of the box on which it is least, and the side of that face along
    /// which it changes most.
    fn undecided(
        &self,
        question: Question,
        gains: &Gains<f64>,
        mut at: [Interval; VARIABLES],
    ) -> Option<([Interval; VARIABLES], usize)> {
        loop {
            if self.excess(question, gains, at).is_positive() {
                return None;
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
            // Mean value form: F(x) >= F(m) - sum |F'_i| r_i.
            let middle = at.map(|side| Interval::point(side.midpoint()));
            let form = (0..VARIABLES)
                .filter(|k| !at[*k].is_point())
                .fold(self.excess(question, gains, middle), |sum, k| sum + slopes[k] * (at[k] - middle[k]));
            if form.is_positive() {
                return None;
            }
            let size = |k: &usize| if at[*k].is_point() { -1.0 } else { slopes[*k].magnitude() * at[*k].width() };
            return (0..VARIABLES).max_by(|a, b| size(a).total_cmp(&size(b))).map(|side| (at, side));
        }
    }

    /// A frequency above which `|L|` is too small for the criterion to fail, for every process.
    pub(super) fn highest_frequency(&self, gains: &Gains<f64>, criterion: RobustCriterion) -> Option<f64> {
        let factor = match criterion {
            RobustCriterion::Gain(factor) => factor.max(1.0),
            _ => 1.0,
        };
        let most = match criterion {
            RobustCriterion::Sensitivity(most) => 1.0 - 1.0 / most,
            _ => 1.0,
        };
        (-OCTAVES..OCTAVES).map(|k| 2f64.powi(k)).find(|omega| {
            let bound = self.loop_gain_beyond(gains, *omega);
            bound.is_some_and(|bound| (Interval::point(factor) * bound).upper() < most)
        })
    }

    /// A bound of `|L(s)|` for every `s` with `|s| >= omega` and `Re s >= 0`, where no pole of the closed loop comes from infinity
    /// either, whatever degree is lost where a time constant reaches zero. With `u = 1/|s|`:
    ///
    /// - `|1 + T s|^2 = 1 + 2 T Re s + T^2 |s|^2 >= (u^2 + T^2)/u^2`, hence at least 1 for a `T` that may be zero;
    /// - `Re (alpha s + drag + memory/(memory_s s + 1)) >= drag + min(0, memory)`, hence
    ///   `|body| >= (drag + min(0, memory) - |stiffness| u)/u`; without inertia and of positive real parts, `|body| >= stiffness`;
    /// - `|body| >= (alpha - (|drag| + |memory|) u - |stiffness| u^2)/u^2`.
    pub(super) fn loop_gain_beyond(&self, gains: &Gains<f64>, omega: f64) -> Option<Interval> {
        let LinearProcess { alpha, drag, stiffness, memory, lag_s, filter_s, zero_s, .. } = self.process;
        let u = Interval::new(0.0, 1.0 / omega)?;
        let size = |part: Interval| Interval::point(part.magnitude());
        let least = |part: Interval| Interval::point(part.lower());
        let negative = Interval::point(memory.lower().min(0.0));
        let passive = alpha == Interval::ZERO && drag.lower() >= 0.0 && memory.lower() >= 0.0;
        let bodies = [
            (2, least(alpha) - (size(drag) + size(memory)) * u - size(stiffness) * u.square()),
            (1, least(drag) + negative - size(stiffness) * u),
            (0, if passive { least(stiffness) } else { Interval::ZERO }),
        ];
        let [proportional, integral, derivative, gain_filter_s] = constants::<Interval>(gains);
        let controller = proportional + integral * u;
        // The derivative without a filter, and a zero, grow with 1/u.
        let unfiltered = derivative.is_positive() && !gain_filter_s.is_positive();
        let controller = if unfiltered {
            controller * u + derivative
        } else if derivative.is_positive() {
            controller + derivative / (u.square() + gain_filter_s.square()).sqrt()
        } else {
            controller
        };
        let zero = if zero_s == Interval::ZERO { Interval::ONE } else { u + size(zero_s) };
        let lags = [lag_s, filter_s].map(least);
        let slow = lags.into_iter().filter(|time| time.is_positive());
        let numerator = slow.clone().fold(controller * zero, |sum, time| sum / (u.square() + time.square()).sqrt());
        let falls = slow.count();
        let rises = usize::from(unfiltered) + usize::from(zero_s != Interval::ZERO);
        let bounds = bodies.into_iter().filter_map(|(degree, body)| {
            let power = (degree + falls).checked_sub(rises)?;
            body.is_positive().then(|| Interval::point((numerator * self::power(u, power) / body).upper()))
        });
        bounds.min_by(|a, b| a.upper().total_cmp(&b.upper()))
    }
}

fn power(base: Interval, exponent: usize) -> Interval {
    (0..exponent).fold(Interval::ONE, |product, _| product * base)
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
    let sum: Vec<Interval> = open_loop.numerator.iter().zip(open_loop.denominator).map(|(n, d)| *n + d).collect();
    let Some(degree) = sum.iter().rposition(|c| *c != Interval::ZERO) else { return false };
    let entry = |index: usize| degree.checked_sub(index).map_or(Interval::ZERO, |power| sum[power]);
    let row = |first: usize| (0..=degree / 2).map(|k| entry(first + 2 * k)).collect::<Vec<_>>();
    let (mut upper, mut lower) = (row(0), row(1));
    let sign = if upper[0].is_negative() { -Interval::ONE } else { Interval::ONE };
    (0..degree).all(|_| {
        let decays = (sign * upper[0]).is_positive() && (sign * lower[0]).is_positive();
        let ratio = upper[0] / lower[0];
        let entry = |row: &[Interval], k: usize| row.get(k).copied().unwrap_or(Interval::ZERO);
        let next = (1..=upper.len()).map(|k| entry(&upper, k) - ratio * entry(&lower, k)).collect();
        upper = core::mem::replace(&mut lower, next);
        decays
    })
}
