//! The basis of the bounds, as numbers that a claim compares with independent numbers.

use super::linear_program::Inequalities;
use super::linear_relaxation::Span;
use super::problem::Problem;
use super::settings::{BoundedModel, DelayBound};
use crate::experiment::Record;
use crate::identify::DragLaw;
use crate::numeric::{Interval, Real};

/// The bound that nonnegative multipliers of rows `slopes . z <= limits` give for `objective . z` over a box.
pub(crate) fn dual_bound(
    slopes: &[Vec<f64>],
    limits: &[f64],
    multipliers: &[f64],
    objective: &[f64],
    sides: &[(f64, f64)],
) -> f64 {
    let numbered = |values: &[f64]| -> Vec<(usize, f64)> { values.iter().copied().enumerate().collect() };
    let row = |row: &Vec<f64>| row.iter().enumerate().map(|(j, slope)| (j, Interval::point(*slope))).collect();
    let rows = Inequalities { coefficients: slopes.iter().map(row).collect(), limits: limits.to_vec() };
    let sides: Vec<Interval> =
        sides.iter().map(|(low, high)| Interval::point(*low).hull(Interval::point(*high))).collect();
    rows.upper_bound(&numbered(objective), &numbered(multipliers), &sides)
}

/// How far the truth is from the middle of its box, in half-widths.
const BESIDE: f64 = 0.4;

/// An axis with linear drag and its record, in a box with the truth.
#[derive(Debug)]
pub(crate) struct Surrounded {
    problem: Problem,
    at: Vec<Interval>,
    centre: Vec<f64>,
}

impl Surrounded {
    /// The truth: force to acceleration, drag and disturbance over inertia; the state at every sample. The box has the half-width
    /// `width` of the truth, and states `state` on either side. `None` for a record that is none.
    pub(crate) fn new(
        record: &Record,
        truth: [f64; 3],
        states: &[[f64; 2]],
        width: f64,
        state: [f64; 2],
    ) -> Option<Self> {
        let quantum = Some(2.0 * state[0]);
        let model = BoundedModel { quantum, ..BoundedModel::new(DragLaw::Linear, DelayBound::KnownS(0.0)) };
        let problem = Problem::new(&[record], &model).ok()?;
        let about = |value: f64, room: f64| Interval::point(value).inflate(room);
        // Not about the truth: the middles of the enclosures belong to the middle of the box.
        let beside = |value: f64| about(value * (1.0 + BESIDE * width), width * value.abs());
        let mut at: Vec<Interval> = truth.iter().map(|value| beside(*value)).collect();
        for interval in &problem.unknowns.shooting {
            let own = states.get(interval.first)?;
            at.extend([about(own[0], state[0]), about(own[1], state[1])]);
        }
        // Not the truth: of its own motion a slope says nothing.
        let centre = at.iter().map(|side| side.midpoint() + 0.7 * side.radius()).collect();
        Some(Self { problem, at, centre })
    }

    /// The largest distance of the true positions outside of the mean-value form's enclosure of each window; with the
    /// slopes' middles in place of their ranges if wanted. `None` where there is no enclosure.
    pub(crate) fn outside(&self, states: &[[f64; 2]], truth: [f64; 3], middles: bool) -> Option<f64> {
        let mut furthest = 0.0f64;
        for (index, interval) in self.problem.unknowns.shooting.iter().enumerate() {
            let motion = self.problem.motion(Span::single(index), &self.at, &self.centre)?;
            let (_, places) = self.problem.unknowns.variables(index);
            let own: Vec<f64> = truth.into_iter().chain(states[interval.first]).collect();
            for (node, state) in motion.iter().zip(&states[interval.first..]) {
                let mut form = node.at[0];
                for ((slope, place), value) in node.sensitivities.iter().zip(&places).zip(&own) {
                    let slope = if middles { Interval::point(slope[0].midpoint()) } else { slope[0] };
                    form += slope * (Interval::point(*value) - Interval::point(self.centre[*place]));
                }
                furthest = furthest.max(state[0] - form.upper()).max(form.lower() - state[0]);
            }
        }
        Some(furthest)
    }

    /// By how much the true motion, its velocity at the third window's beginning changed by `shift`, misses the inequalities of the
    /// chain of windows, at most. `None` where there is no enclosure.
    pub(crate) fn missed(&self, states: &[[f64; 2]], truth: [f64; 3], shift: f64) -> Option<f64> {
        let mut at = self.at.clone();
        let relaxation = self.problem.shoot(&mut at, self.centre.clone()).ok()??;
        let mut own = truth.to_vec();
        for (index, interval) in self.problem.unknowns.shooting.iter().enumerate() {
            let [position, velocity] = states[interval.first];
            own.extend([position, if index == 2 { velocity + shift } else { velocity }]);
        }
        let rows = relaxation.inequalities.coefficients.iter().zip(&relaxation.inequalities.limits);
        Some(rows.fold(0.0, |most, (slopes, limit)| {
            let sum = slopes.iter().fold(Interval::ZERO, |sum, (place, slope)| {
                sum + *slope * (Interval::point(own[*place]) - Interval::point(relaxation.centre[*place]))
            });
            most.max(sum.lower() - limit)
        }))
    }
}
