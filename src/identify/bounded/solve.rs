//! The search: branch and prune over longer and longer horizons, a feasible point, and the refinement of the bounds.

use super::answer::{Bounds, Quantity};
use super::branch_and_prune::Division;
use super::contraction::Contractor;
use super::feasible_point::ParameterPoint;
use super::problem::Problem;
use super::refinement::Points;
use super::report;
use super::settings::BoundedModel;
use crate::identify::IdentifyError;
use crate::numeric::Interval;

/// A solved problem.
pub(super) struct Solved {
    pub(super) bounds: Bounds,
    /// The hull of the remainder; before it, of the remainder before the delay was narrowed. `None` for nothing.
    pub(super) hulls: Vec<Option<Vec<Interval>>>,
    /// The remaining parameters, as the problem was posed; `None` for nothing.
    pub(super) left: Option<Vec<Interval>>,
    /// A feasible point, and the problem whose unknowns it has.
    pub(super) feasible: Option<(ParameterPoint, Problem)>,
}

/// Branch and prune over longer and longer horizons, a feasible point, and the refinement of the bounds.
pub(super) fn solve(
    problem: &Problem,
    settings: &BoundedModel,
    estimates: impl FnOnce() -> Option<Vec<(Quantity, f64)>>,
) -> Result<Solved, IdentifyError> {
    let (mut contractor, mut division) = prune(problem, settings.budget);
    let mut hulls = Vec::new();
    if let (Some(hull), true) = (division.hull(), problem.unknowns.delay().is_some() && division.complete) {
        // A shorter longest delay admits more readings.
        (contractor, division) = prune(&problem.narrowed(settings, &hull)?, settings.budget);
        hulls.push(Some(hull));
    }
    let mut tried = Points::default();
    tried.seek(&contractor, &division);
    if tried.feasible().is_none() && !division.kept.is_empty() {
        tried.seek_near(&mut contractor, estimates().as_deref());
    }
    let mut bisections = 0usize;
    while tried.feasible().is_none()
        && contractor.passes() < settings.budget
        && contractor.bisect_coarsest(&mut division, 0.0)
    {
        bisections += 1;
        if bisections.is_power_of_two() {
            tried.seek(&contractor, &division);
        }
    }
    if tried.feasible().is_some() && contractor.passes() < settings.budget {
        tried.refine(&mut contractor, &mut division, settings.budget);
    }
    let own = &contractor.problem;
    let left = division.hull().map(|hull| {
        let mut left = hull[..own.unknowns.parameters()].to_vec();
        if let (Some(place), None) = (problem.unknowns.delay(), own.unknowns.delay()) {
            left.insert(place, own.known_delay_s);
        }
        left
    });
    hulls.push(division.hull());
    let feasible = tried.feasible().map(|point| (point.clone(), own.clone()));
    let bounds = report::answer(problem, &contractor, &division, tried);
    Ok(Solved { bounds, hulls, left, feasible })
}

/// Branch and prune over each horizon, from the hull of the remainder before.
fn prune(problem: &Problem, budget: usize) -> (Contractor, Division) {
    let mut whole = problem.search.clone();
    let mut contradicting = Vec::new();
    let mut horizons = problem.horizons().into_iter().peekable();
    loop {
        let horizon = horizons.next().unwrap_or(usize::MAX);
        let mut contractor = Contractor::new(problem.until(horizon));
        let division = contractor.prune(whole, budget);
        contradicting.extend(contractor.contradicting);
        match division.hull() {
            Some(hull) if horizons.peek().is_some() => whole = hull,
            _ => {
                let mut contractor = Contractor::new(problem.clone());
                contractor.contradicting = contradicting;
                return (contractor, division);
            }
        }
    }
}
