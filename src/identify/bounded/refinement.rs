//! Refinement of the bounds once a feasible point is found: boxes of low uncertainty, and ends that move in to feasible points.

use super::answer::Quantity;
use super::branch_and_prune::{Division, FINEST, RangeEnd, hull};
use super::contraction::Contractor;
use super::feasible_point::ParameterPoint;
use super::linear_relaxation::points;
use crate::numeric::Interval;

/// Passes of a refinement; half of them for bisection alone.
const MOST_PASSES: usize = 640;
/// Bounds are good where feasible points reach over this share of their width.
const GOOD: f64 = 0.98;
/// Boxes are bisected until their uncertainty is below this share of a reading's error; beyond an end, of the slack of the nearest point: a
/// feasible point is then found in the box, if any.
const FINE: f64 = 0.1;
/// Rounds over all ends.
const ROUNDS: usize = 6;

/// Points that were tried.
#[derive(Default)]
pub(super) struct Points {
    pub(super) nearest: Option<ParameterPoint>,
    /// The smallest box that contains all feasible points.
    inner: Option<Vec<Interval>>,
}

impl Points {
    pub(super) fn feasible(&self) -> Option<&ParameterPoint> {
        self.nearest.as_ref().filter(|point| point.is_feasible())
    }

    fn note(&mut self, point: ParameterPoint) {
        if point.is_feasible() {
            self.inner = hull(self.inner.take().into_iter().chain([points(&point.at)]));
        }
        if self.nearest.as_ref().is_none_or(|nearest| point.misfit < nearest.misfit) {
            self.nearest = Some(point);
        }
    }

    /// Seeks the point with the least misfit in the remaining boxes, or where the last boxes were empty.
    pub(super) fn seek(&mut self, contractor: &Contractor, division: &Division) {
        let mut boxes: Vec<Vec<Interval>> = division.kept.iter().map(|kept| kept.at.clone()).take(2).collect();
        boxes.extend(division.hull());
        if boxes.is_empty() {
            let refuted = division.last_empty.iter().filter_map(|empty| empty.relaxation.as_ref());
            boxes = refuted.map(|relaxation| contractor.loosened(&relaxation.sides())).collect();
        }
        for at in boxes {
            if self.feasible().is_some() {
                return;
            }
            contractor.nearest(&at, &at).into_iter().for_each(|point| self.note(point));
        }
    }

    /// The same about estimates.
    pub(super) fn seek_near(&mut self, contractor: &mut Contractor, estimates: Option<&[(Quantity, f64)]>) {
        let found = estimates.and_then(|estimates| contractor.nearest_to(estimates));
        found.into_iter().for_each(|point| self.note(point));
    }

    /// Moves the ends of the bounds in to the feasible points.
    pub(super) fn refine(&mut self, contractor: &mut Contractor, division: &mut Division, budget: usize) {
        let begun = contractor.passes();
        let budget = budget.min(begun + MOST_PASSES);
        while contractor.passes() < budget.min(begun + MOST_PASSES / 2) && contractor.bisect_coarsest(division, FINE) {}
        let Some(hull) = division.hull() else { return };
        contractor.nearest(&hull, &hull).into_iter().for_each(|point| self.note(point));
        let ends: Vec<RangeEnd> = (0..contractor.problem.unknowns.common())
            .flat_map(|unknown| [true, false].map(|upper| RangeEnd { unknown, upper }))
            .collect();
        for end in &ends {
            let from = self.feasible().cloned();
            let far = from.map(|from| contractor.furthest(&from, &hull, end.unknown, end.sign()));
            far.into_iter().for_each(|point| self.note(point));
        }
        for round in 1..=ROUNDS {
            for (done, &end) in ends.iter().enumerate() {
                // A share of the budget; ends that need less yield it to the rest.
                let left = budget.saturating_sub(contractor.passes());
                let share = left / (ends.len() - done) / (ROUNDS + 1 - round).min(2);
                self.move_in(contractor, division, end, contractor.passes() + share);
                if division.kept.is_empty() {
                    return;
                }
            }
            if contractor.passes() >= budget || ends.iter().all(|end| self.is_good(division, *end)) {
                return;
            }
        }
    }

    /// Where an end should be: beyond the feasible points by a share of the width.
    fn goal(&self, division: &Division, end: RangeEnd, share: f64) -> Option<f64> {
        let (hull, inner) = (division.hull()?, self.inner.as_ref()?);
        Some(end.of(inner) + share * hull[end.unknown].width())
    }

    fn is_good(&self, division: &Division, end: RangeEnd) -> bool {
        let reached = division.hull().map(|hull| end.of(&hull));
        reached.zip(self.goal(division, end, 0.5 * (1.0 - GOOD))).is_none_or(|(reached, goal)| reached <= goal)
    }

    /// One end: slices beyond the goal are proved empty; where a box stays, a feasible point is sought in it.
    fn move_in(&mut self, contractor: &mut Contractor, division: &mut Division, end: RangeEnd, budget: usize) {
        while contractor.passes() < budget && !self.is_good(division, end) {
            let Some(goal) = self.goal(division, end, 0.25 * (1.0 - GOOD)) else { return };
            let slack = self.nearest.as_ref().map_or(0.0, |nearest| 1.0 - nearest.misfit);
            let fine = (FINE * slack).max(FINEST);
            let Some(stays) = contractor.shave(division, end, goal, fine, budget) else { return };
            let before = self.inner.as_ref().map(|inner| end.of(inner));
            if let Some(point) = contractor.nearest(&stays, &stays) {
                let hull = division.hull().filter(|_| point.is_feasible());
                let far = hull.map(|hull| contractor.furthest(&point, &hull, end.unknown, end.sign()));
                far.into_iter().chain([point]).for_each(|point| self.note(point));
            }
            if self.inner.as_ref().map(|inner| end.of(inner)) == before {
                return;
            }
        }
    }
}
