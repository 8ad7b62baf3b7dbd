//! From the remaining boxes to the answer.

use super::answer::{Bounds, Consistency, Contradicting, ParameterValues, Quantity, QuantityRange};
use super::branch_and_prune::{Division, Kept};
use super::contraction::{Contractor, Empty};
use super::feasible_point::ParameterPoint;
use super::linear_program::Outcome;
use super::linear_relaxation::{Origin, Relaxation, midpoints};
use super::problem::Problem;
use super::refinement::Points;
use super::vector_field::FieldTerm;
use crate::numeric::Interval;

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
    let ranges = kept.iter().map(|(at, relaxation)| box_ranges(&contractor.problem, at, relaxation.as_ref()));
    let union = |mut all: Vec<QuantityRange>, own: Vec<QuantityRange>| {
        for (all, own) in all.iter_mut().zip(own) {
            (all.low, all.high) = (all.low.min(own.low), all.high.max(own.high));
        }
        all
    };
    let point = |point: &ParameterPoint| ParameterValues {
        values: values(&contractor.problem, &point.at),
        misfit: point.misfit,
    };
    Bounds {
        verdict,
        search_box: wide.ranges(&wide.search),
        bounds: ranges.reduce(union).unwrap_or_default(),
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
    let sum: f64 = found.iter().map(|part| part.share).sum();
    found.iter_mut().for_each(|part| part.share /= sum);
    found.sort_by_key(|part| (part.record, part.sample));
    found
}

/// The quantities of a point.
fn values(problem: &Problem, at: &[f64]) -> Vec<(Quantity, f64)> {
    let unknowns = &problem.unknowns;
    let of = |term| unknowns.place_of(term).map(|place| at[place]);
    let gain = at[0];
    let mut values = vec![(Quantity::Alpha, 1.0 / gain)];
    if let Some(linear) = of(FieldTerm::Linear) {
        let share = 2.0 * problem.middle_speed * of(FieldTerm::Quadratic).unwrap_or(0.0);
        values.push((Quantity::Beta, (linear - share) / gain));
    }
    values.extend(OVER_ALPHA.into_iter().filter_map(|(term, quantity)| Some((quantity, of(term)? / gain))));
    values.extend(of(FieldTerm::LagRate).map(|rate| (Quantity::LagS, 1.0 / rate)));
    values.push((Quantity::DelayS, unknowns.delay().map_or(problem.known_delay_s.midpoint(), |place| at[place])));
    for record in 0..unknowns.records() {
        let first = unknowns.first(record);
        values.push((Quantity::Delta(record), at[unknowns.disturbance(record)] / gain));
        values.push((Quantity::Position(record), at[unknowns.start(first, 0)]));
        values.push((Quantity::Velocity(record), at[unknowns.start(first, 1)]));
    }
    values
}

/// The quantities over a remaining box.
fn box_ranges(problem: &Problem, at: &[Interval], relaxation: Option<&Relaxation>) -> Vec<QuantityRange> {
    let (unknowns, gain) = (&problem.unknowns, at[0]);
    let ratio = |parts: &[(usize, f64)]| over_gain(at, relaxation, parts);
    let mut ranges = vec![(Quantity::Alpha, Interval::ONE / gain)];
    if let Some(place) = unknowns.place_of(FieldTerm::Linear) {
        let quadratic =
            unknowns.place_of(FieldTerm::Quadratic).map(|quadratic| (quadratic, -2.0 * problem.middle_speed));
        let parts: Vec<(usize, f64)> = [(place, 1.0)].into_iter().chain(quadratic).collect();
        let mut side = ratio(&parts);
        if problem.least_linear >= 0.0 {
            // Negative linear drag is not searched.
            side = Interval::new(side.lower().max(0.0), side.upper().max(0.0)).unwrap_or(side);
        }
        ranges.push((Quantity::Beta, side));
    }
    let over_alpha = |(term, quantity)| Some((quantity, ratio(&[(unknowns.place_of(term)?, 1.0)])));
    ranges.extend(OVER_ALPHA.into_iter().filter_map(over_alpha));
    ranges.extend(unknowns.place_of(FieldTerm::LagRate).map(|place| (Quantity::LagS, Interval::ONE / at[place])));
    ranges.push((Quantity::DelayS, problem.delay_s(at)));
    let records = 0..unknowns.records();
    ranges
        .extend(records.clone().map(|record| (Quantity::Delta(record), ratio(&[(unknowns.disturbance(record), 1.0)]))));
    for record in records {
        let first = unknowns.first(record);
        ranges.push((Quantity::Position(record), at[unknowns.start(first, 0)]));
        ranges.push((Quantity::Velocity(record), at[unknowns.start(first, 1)]));
    }
    ranges.into_iter().map(QuantityRange::of).collect()
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
