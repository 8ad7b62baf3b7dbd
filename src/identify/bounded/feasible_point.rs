//! Feasible points: single parameters whose motion, enclosed in intervals, satisfies every reading. They are sought by successive linear
//! programming (Fletcher and Sainz de la Maza, *Mathematical Programming* 43, 1989) with the largest misfit as a further unknown.

pub(super) mod estimate;
#[cfg(test)]
mod tests;

use super::contraction::Contractor;
use super::linear_program::Outcome;
use super::linear_relaxation::{Origin, Relaxation, midpoints, points};
use crate::numeric::Interval;

/// Linear programmes of a descent.
const MOST_STEPS: usize = 16;
/// A descent ends where a step takes less than this share off the misfit; a descent along an unknown, off the width of its range.
const LEAST_GAIN: f64 = 1e-3;
/// Factor of the trust region after a step that does not improve the misfit.
const SHRINK: f64 = 0.25;
/// A feasible point is sought this share of the slack inside the readings' ranges: room for the curvature of the motion.
const INSIDE: f64 = 0.01;
/// Largest misfit of a linear programme, in errors beyond the first.
const MOST_EXCESS: f64 = 1000.0;
/// Room about the states of an empty box, in largest errors of a reading.
const ROOM: f64 = 30.0;

/// A parameter with its misfit.
#[derive(Clone, Debug)]
pub(super) struct ParameterPoint {
    /// All unknowns; of the states those at the beginning of each record count.
    pub(super) at: Vec<f64>,
    /// Upper bound of the largest misfit of a reading over its largest error.
    pub(super) misfit: f64,
}

impl ParameterPoint {
    pub(super) fn is_feasible(&self) -> bool {
        self.misfit <= 1.0
    }
}

/// Confines the deviations to a box, and to the trust region: a share of the widths of the box from which the steps began.
fn confine(relaxation: &mut Relaxation, within: &[Interval], from: &[Interval], trust: f64) {
    for (place, (side, from)) in within.iter().zip(from).enumerate() {
        let middle = Interval::point(relaxation.centre[place]);
        let room = middle + Interval::symmetric(trust * from.width());
        relaxation.deviations[place] = room.intersection(*side).unwrap_or(middle) - middle;
    }
}

impl Contractor {
    /// Adds the excess of the misfit over 1 to the unknowns: `a z - E excess <= b` for the rows of readings. Its place.
    pub(super) fn add_excess(&self, relaxation: &mut Relaxation) -> usize {
        let excess = relaxation.deviations.len();
        for (row, origin) in relaxation.inequalities.coefficients.iter_mut().zip(&relaxation.origins) {
            if let Origin::Reading { interval, .. } = origin {
                let record = self.problem.unknowns.shooting[*interval].record;
                row.push((excess, Interval::point(-self.problem.records[record].error)));
            }
        }
        relaxation.deviations.push(Interval::ZERO);
        relaxation.centre.push(0.0);
        excess
    }

    /// The inequalities about a point by single shooting, of both ends of the enclosure of each output: feasible where its misfit is.
    fn about(&self, centre: &[f64]) -> Option<Relaxation> {
        let (problem, point) = (&self.problem, points(centre));
        let mut relaxation = problem.about(&point, centre.to_vec());
        for span in problem.single_shooting() {
            let motion = problem.motion(span, &point, centre)?;
            let before = relaxation.inequalities.limits.len();
            problem.add_motion(span, &motion, false, &mut relaxation);
            // Two rows of each reading: `a z <= E - inf(x - y)` become `a z <= E - sup(x - y)`.
            let pairs = relaxation.inequalities.limits[before..].chunks_exact_mut(2);
            pairs.zip(&motion).for_each(|(pair, node)| pair.iter_mut().for_each(|limit| *limit -= node.at[0].width()));
        }
        problem.add_prior(&mut relaxation);
        Some(relaxation)
    }

    /// The best of successive points, each by a linear programme about the best so far: of the excess where there is no `objective`, and
    /// within the trust region. `gain` compares the best with the next; `None` refuses the next.
    fn climb(
        &self,
        mut best: ParameterPoint,
        [from, within]: [&[Interval]; 2],
        allowed: Interval,
        objective: Option<(usize, f64)>,
        gain: impl Fn(&ParameterPoint, &ParameterPoint) -> Option<f64>,
    ) -> ParameterPoint {
        // A share of the widths of the box `from`.
        let mut trust = 1.0;
        for _ in 0..MOST_STEPS {
            let Some(mut relaxation) = self.about(&best.at) else { break };
            let excess = self.add_excess(&mut relaxation);
            confine(&mut relaxation, within, from, trust);
            relaxation.deviations[excess] = allowed;
            let objective = objective.unwrap_or((excess, -1.0));
            let Outcome::Bounded { at: step, .. } = relaxation.programme().maximise(&[objective]) else { break };
            // The excess, the last of the step, is no unknown of the point.
            let at: Vec<f64> = best.at.iter().zip(&step).map(|(value, step)| value + step).collect();
            let next = self.problem.misfit(&at).map(|misfit| ParameterPoint { at, misfit });
            let Some((gain, next)) = next.and_then(|next| Some((gain(&best, &next)?, next))) else {
                trust *= SHRINK;
                continue;
            };
            if gain > 0.0 {
                best = next;
            }
            if gain < LEAST_GAIN {
                break;
            }
        }
        best
    }

    /// A parameter with a small misfit, from the middle of a box and within another box.
    pub(super) fn nearest(&self, from: &[Interval], within: &[Interval]) -> Option<ParameterPoint> {
        let start = ParameterPoint { at: midpoints(from), misfit: f64::INFINITY };
        let allowed = Interval::new(-1.0, MOST_EXCESS)?;
        let found = self.climb(start, [from, within], allowed, None, |best, next| {
            (next.misfit < best.misfit).then(|| (best.misfit - next.misfit) / next.misfit)
        });
        Some(found).filter(|found| found.misfit.is_finite())
    }

    /// The feasible point with an unknown furthest up (or, `sign` negative, down) that is found in a box from a feasible point.
    pub(super) fn furthest(
        &self,
        from: &ParameterPoint,
        within: &[Interval],
        unknown: usize,
        sign: f64,
    ) -> ParameterPoint {
        let inside = Interval::point(-INSIDE * (1.0 - from.misfit));
        self.climb(from.clone(), [within, within], inside, Some((unknown, sign)), |best, next| {
            let gain = sign * (next.at[unknown] - best.at[unknown]) / within[unknown].width();
            next.is_feasible().then_some(gain)
        })
    }

    /// A box with room for a parameter that satisfies the readings nearly.
    pub(super) fn loosened(&self, at: &[Interval]) -> Vec<Interval> {
        let (problem, unknowns) = (&self.problem, &self.problem.unknowns);
        let mut loose: Vec<Interval> = at.iter().map(|side| *side + Interval::symmetric(side.width())).collect();
        for (index, interval) in unknowns.shooting.iter().enumerate() {
            let room = ROOM * problem.records[interval.record].error;
            let (position, velocity) = (unknowns.start(index, 0), unknowns.start(index, 1));
            loose[position] = at[position] + Interval::symmetric(room);
            loose[velocity] = at[velocity] + Interval::symmetric(room / problem.half_period_s + at[velocity].width());
        }
        for (loose, widest) in loose.iter_mut().zip(&problem.search).take(unknowns.parameters()) {
            *loose = loose.intersection(*widest).unwrap_or(*widest);
        }
        loose
    }
}
