//! The basis of guaranteed bounds of parameters: the dual, the mean-value form, the chain of stretches.

use super::{Case, Draw, claim, tolerance};
use crate::experiment::Record;
use crate::identify::bounded::soundness::{Surrounded, dual_bound};

/// Whole numbers below this have products of three without loss in 128 bits, while floats round a product of two.
const LARGEST: f64 = 68_719_476_736.0;
/// Cases of a motion, which take some milliseconds each.
const MOTIONS: usize = 200;

claim! {
    BOUNDED_DUAL = "bounded-dual" Theorem
    "Whatever nonnegative multipliers are given, the dual evaluated in intervals is not below the maximum over the rows and the box";
    corrected dual(dual_bound);
    // In floats, rounded to nearest.
    false dual(rounded);
    not_proved
        "the code is compared with whole numbers at drawn rows: its intervals are not evaluated over a range of them";
}

type Dual = fn(&[Vec<f64>], &[f64], &[f64], &[f64], &[(f64, f64)]) -> f64;

fn rounded(slopes: &[Vec<f64>], limits: &[f64], y: &[f64], objective: &[f64], sides: &[(f64, f64)]) -> f64 {
    let mut sum: f64 = limits.iter().zip(y).map(|(limit, y)| limit * y).sum();
    for (j, (low, high)) in sides.iter().enumerate() {
        let rest = objective[j] - slopes.iter().zip(y).map(|(row, y)| row[j] * y).sum::<f64>();
        sum += (rest * low).max(rest * high);
    }
    sum
}

/// The same of whole numbers, exactly.
fn exact(slopes: &[Vec<f64>], limits: &[f64], y: &[f64], objective: &[f64], sides: &[(f64, f64)]) -> i128 {
    let whole = |value: f64| value as i128;
    let mut sum: i128 = limits.iter().zip(y).map(|(limit, y)| whole(*limit) * whole(*y)).sum();
    for (j, (low, high)) in sides.iter().enumerate() {
        let rest = whole(objective[j]) - slopes.iter().zip(y).map(|(row, y)| whole(row[j]) * whole(*y)).sum::<i128>();
        sum += (rest * whole(*low)).max(rest * whole(*high));
    }
    sum
}

fn dual(draw: &mut Draw, dual: Dual) -> Option<Case> {
    let mut any = || draw.unrecorded(-LARGEST, LARGEST).trunc();
    let slopes: Vec<Vec<f64>> = (0..4).map(|_| (0..3).map(|_| any()).collect()).collect();
    let limits: Vec<f64> = (0..4).map(|_| any()).collect();
    let y: Vec<f64> = (0..4).map(|_| any().abs()).collect();
    let objective: Vec<f64> = (0..3).map(|_| any()).collect();
    let sides: Vec<(f64, f64)> = (0..3).map(|_| (any(), any())).map(|(a, b)| (a.min(b), a.max(b))).collect();
    let (bound, exact) =
        (dual(&slopes, &limits, &y, &objective, &sides), exact(&slopes, &limits, &y, &objective, &sides));
    draw.note("bound", bound);
    // A float of this size is a whole number.
    Some(Case::truth(bound as i128 >= exact))
}

const INTERVAL_S: f64 = 0.1;
const SAMPLES: usize = 40;
/// Samples between two switchings.
const SWING: usize = 10;

/// An axis with linear drag under a square wave, by its solution in closed form.
struct SquareWaveAxis {
    truth: [f64; 3],
    states: Vec<[f64; 2]>,
    record: Record,
}

impl SquareWaveAxis {
    fn draw(draw: &mut Draw) -> Option<Self> {
        let (alpha, beta) = (draw.log_uniform("alpha", 0.5, 2.0), draw.log_uniform("beta", 0.2, 2.0));
        let delta = draw.uniform("delta", 0.05, 0.3);
        let (mut x, mut v) = (0.0, draw.uniform("velocity", -0.3, 0.3));
        let rate = beta / alpha;
        let decay = libm::exp(-rate * INTERVAL_S);
        let (mut time, mut input, mut states) = (Vec::new(), Vec::new(), Vec::new());
        for sample in 0..SAMPLES {
            let u = if (sample / SWING).is_multiple_of(2) { 1.0 } else { -1.0 };
            time.push(sample as f64 * INTERVAL_S);
            input.push(u);
            states.push([x, v]);
            let terminal = (u + delta) / beta;
            x += terminal * INTERVAL_S + (v - terminal) * (1.0 - decay) / rate;
            v = terminal + (v - terminal) * decay;
        }
        let record = Record::new(time, states.iter().map(|state: &[f64; 2]| state[0]).collect(), input).ok()?;
        Some(Self { truth: [1.0 / alpha, rate, delta / alpha], states, record })
    }

    /// In a box of this half-width about the truth.
    fn surrounded(&self, width: f64) -> Option<Surrounded> {
        Surrounded::new(&self.record, self.truth, &self.states, width, [0.01, 0.02])
    }
}

claim! {
    BOUNDED_MEAN_VALUE = "bounded-mean-value" Theorem
    "Over a box, every output lies in the point's own plus the slopes' ranges times what the unknowns differ";
    cases |all| all.min(MOTIONS);
    corrected mean_value(false);
    // The middles of the slopes in place of their ranges.
    false mean_value(true);
    not_proved "compared with the closed form at drawn axes of linear drag: other laws have none to be compared with";
}

fn mean_value(draw: &mut Draw, middles: bool) -> Option<Case> {
    let axis = SquareWaveAxis::draw(draw)?;
    let width = draw.uniform("half_width", 0.02, 0.1);
    let outside = axis.surrounded(width)?.outside(&axis.states, axis.truth, middles)?;
    Some(draw.at_most(("outside", outside), ("rounding_of_the_closed_form", tolerance::ROUNDING), 1.0))
}

claim! {
    BOUNDED_CHAIN = "bounded-chain" Theorem
    "A motion meets every inequality of the chain of stretches, each of which begins where the one before ended";
    cases |all| all.min(MOTIONS);
    corrected chain(0.0);
    // A stretch whose first velocity is not the last of the stretch before.
    false chain(0.3);
    not_proved "compared with the closed form at drawn axes of linear drag: other laws have none to be compared with";
}

fn chain(draw: &mut Draw, shift: f64) -> Option<Case> {
    let axis = SquareWaveAxis::draw(draw)?;
    let missed = axis.surrounded(0.02)?.missed(&axis.states, axis.truth, shift)?;
    Some(draw.at_most(("missed", missed), ("rounding_of_the_closed_form", tolerance::ROUNDING), 1.0))
}
