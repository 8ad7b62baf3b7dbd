//! From the remaining boxes to the answer.

use super::answer::{Bounds, Consistency, Contradicting, ParameterValues, Quantity, QuantityRange};
use super::branch_and_prune::{Division, Kept};
use super::contraction::{Contractor, Empty};
use super::feasible_point::ParameterPoint;
use super::linear_program::Outcome;
use super::linear_relaxation::{Origin, Relaxation, midpoints, points};
use super::problem::Problem;
use super::refinement::Points;
use super::vector_field::FieldTerm;
use crate::numeric::{Interval, Real};

/// Drag and spring coefficients over alpha, as the answer has them.
const OVER_ALPHA: [(FieldTerm, Quantity); 3] = [
    (FieldTerm::Quadratic, Quantity::BetaQuadratic),
    (FieldTerm::Cubic, Quantity::BetaCubic),
    (FieldTerm::Stiffness, Quantity::Stiffness),
];

/// The answer; `wide` is the problem as it was posed.
pub(super) fn answer(wide: &Problem, contractor: &Contractor, division: &Division, tried: Points) -> Bounds {
    let verdict = if tried.feasible().is_some() {
        Consistency::Consistent
    } else if division.kept.is_empty() {
        Consistency::Refuted
    } else {
        Consistency::Undecided
    };
    let kept = |kept: &Kept| (kept.at.clone(), relaxed(contractor, &kept.at));
    let kept: Vec<(Vec<Interval>, Option<Relaxation>)> = division.kept.iter().map(kept).collect();
    let (mut least, mut contradicting) = (1.0f64, Vec::new());
    if verdict == Consistency::Refuted {
        let shown = division.last_empty.as_ref().map(|empty| contradiction(&contractor.problem, empty));
        let shown = shown.filter(|readings| !readings.is_empty());
        contradicting = shown.unwrap_or_else(|| contractor.contradicting.clone());
    } else {
        least =
            kept.iter().fold(least, |least, (_, relaxation)| least.min(least_misfit(contractor, relaxation.as_ref())));
    }
    let ranges = kept.iter().flat_map(|(at, relaxation)| quantities(&contractor.problem, at, relaxation.as_ref()));
    let point = |point: &ParameterPoint| {
        let values = quantities(&contractor.problem, &points(&point.at), None).into_iter();
        ParameterValues { values: values.map(|(own, side)| (own, side.midpoint())).collect(), misfit: point.misfit }
    };
    Bounds {
        verdict,
        search_box: wide.ranges(&wide.search),
        bounds: QuantityRange::union(ranges.map(QuantityRange::of)),
        witness: tried.feasible().map(point),
        nearest: tried.nearest.as_ref().map(point),
        error: contractor.problem.records.iter().map(|readings| readings.error).collect(),
        error_factor: [least, tried.nearest.as_ref().map_or(f64::MAX, |nearest| nearest.misfit)],
        contradicting,
        outliers: Vec::new(),
        passes: contractor.passes(),
    }
}

fn relaxed(contractor: &Contractor, at: &[Interval]) -> Option<Relaxation> {
    contractor.problem.shoot(&mut at.to_vec(), midpoints(at)).ok().flatten()
}

/// The readings behind a contradiction, with their shares of the multipliers.
fn contradiction(problem: &Problem, empty: &Empty) -> Vec<Contradicting> {
    let Some(relaxation) = &empty.relaxation else { return Vec::new() };
    let mut found: Vec<Contradicting> = Vec::new();
    for (row, weight) in &empty.multipliers {
        if let Some(Origin::Reading { interval, sample, above }) = relaxation.origins.get(*row) {
            let record = problem.unknowns.shooting[*interval].record;
            let share = weight * problem.records[record].error;
            found.push(Contradicting { record, sample: *sample, model_above: *above, share });
        }
    }
    Contradicting::normalised(found)
}

/// The quantities of the answer over a box.
fn quantities(problem: &Problem, at: &[Interval], relaxation: Option<&Relaxation>) -> Vec<(Quantity, Interval)> {
    let unknowns = &problem.unknowns;
    let place = |term| unknowns.place_of(term);
    let over_gain = |parts: &[(usize, f64)]| over_gain(at, relaxation, parts);
    let mut all = vec![(Quantity::Alpha, Interval::ONE / at[0])];
    if let Some(linear) = place(FieldTerm::Linear) {
        let quadratic = place(FieldTerm::Quadratic).map(|quadratic| (quadratic, -2.0 * problem.middle_speed));
        let parts: Vec<(usize, f64)> = [(linear, 1.0)].into_iter().chain(quadratic).collect();
        let beta = over_gain(&parts);
        // Negative linear drag is searched only where it is admitted.
        all.push((Quantity::Beta, if problem.least_linear >= 0.0 { beta.max(Interval::ZERO) } else { beta }));
    }
    let over_alpha = |(term, quantity)| Some((quantity, over_gain(&[(place(term)?, 1.0)])));
    all.extend(OVER_ALPHA.into_iter().filter_map(over_alpha));
    all.extend(place(FieldTerm::LagRate).map(|rate| (Quantity::LagS, Interval::ONE / at[rate])));
    all.push((Quantity::DelayS, problem.delay_s(at)));
    let records = 0..unknowns.records();
    let delta = |record| (Quantity::Delta(record), over_gain(&[(unknowns.disturbance(record), 1.0)]));
    all.extend(records.clone().map(delta));
    for record in records {
        let first = unknowns.first(record);
        all.push((Quantity::Position(record), at[unknowns.start(first, 0)]));
        all.push((Quantity::Velocity(record), at[unknowns.start(first, 1)]));
    }
    all
}

/// A combination c of parameters over the gain g: by both ranges; and as `m + (c - m g)/g` with the middle ratio m, where the inequalities
/// bound `c - m g`.
fn over_gain(at: &[Interval], relaxation: Option<&Relaxation>, parts: &[(usize, f64)]) -> Interval {
    let gain = at[0];
    let sum = parts.iter().fold(Interval::ZERO, |sum, (place, factor)| sum + Interval::point(*factor) * at[*place]);
    let direct = sum / gain;
    let middle = sum.midpoint() / gain.midpoint();
    let beside: Vec<(usize, f64)> = parts.iter().copied().chain([(0, -middle)]).collect();
    let Some(rest) = relaxation.and_then(|relaxation| relaxation.combination(&beside)) else { return direct };
    direct.intersection(Interval::point(middle) + rest / gain).unwrap_or(direct)
}

/// A lower bound of the largest misfit over a box, in largest errors.
fn least_misfit(contractor: &Contractor, relaxation: Option<&Relaxation>) -> f64 {
    let Some(mut relaxation) = relaxation.cloned() else { return 0.0 };
    let excess = contractor.add_excess(&mut relaxation);
    relaxation.deviations[excess] = Interval::new(-1.0, 1.0).unwrap_or(Interval::ENTIRE);
    let objective = [(excess, -1.0)];
    match relaxation.programme().maximise(&objective) {
        Outcome::Bounded { multipliers, .. } => {
            (Interval::ONE - Interval::point(relaxation.upper_bound(&objective, &multipliers))).lower().max(0.0)
        }
        Outcome::Empty { .. } => 1.0,
    }
}
