//! From what division left to the answer.

use super::bounds::{Bounds, Consistency, Contradicting, Parameters, Quantity, QuantityRange};
use super::contract::Origin;
use super::divide::{Division, End, around};
use super::field::Term;
use super::lp::Outcome;
use super::search::{Empty, Search};
use super::setup::Setup;
use super::slanted::Held;
use super::witness::Tried;
use crate::numeric::Interval;

/// Passes after which the bounds are good enough: they hold in any case.
const SHARPENING: usize = 640;
/// A box is as good as a point where what is in doubt takes less than this share of what the nearest parameter leaves of the readings'
/// errors; and in any case where it takes less than the second of these errors.
const FINE: f64 = 0.1;
const LEAST_FINE: f64 = 3e-6;
/// Boxes are halved until what is in doubt takes less than this of the readings' errors, before ends are drawn in; with so many passes.
const COARSE: f64 = 0.07;
const EVENING: usize = 320;
/// How often all ends are drawn in.
const ROUNDS: usize = 6;

/// Parameters tried so far.
#[derive(Default)]
pub(super) struct Answer {
    nearest: Option<Tried>,
    /// The box around all witnesses.
    inner: Option<Vec<Interval>>,
}

/// The box of an empty leaf.
fn leaf(empty: &Empty) -> Option<Vec<Interval>> {
    let linear = empty.linear.as_ref()?;
    Some(linear.deviations.iter().zip(&linear.centre).map(|(z, c)| *z + Interval::point(*c)).collect())
}

impl Answer {
    pub(super) fn witness(&self) -> Option<&Tried> {
        self.nearest.as_ref().filter(|tried| tried.misfit <= 1.0)
    }

    fn note(&mut self, tried: Tried) {
        if tried.misfit <= 1.0 {
            let at: Vec<Interval> = tried.at.iter().map(|value| Interval::point(*value)).collect();
            self.inner = around(self.inner.take().into_iter().chain([at]));
        }
        if self.nearest.as_ref().is_none_or(|nearest| tried.misfit < nearest.misfit) {
            self.nearest = Some(tried);
        }
    }

    /// Looks for the parameter with the least largest misfit: in what is left, or where the contradiction came last.
    pub(super) fn try_nearest(&mut self, search: &mut Search<'_>, division: &Division) {
        let mut boxes: Vec<Vec<Interval>> = division.kept.iter().map(|kept| kept.at.clone()).take(2).collect();
        boxes.extend(division.hull());
        let excluded = boxes.is_empty();
        if excluded {
            boxes = division.empties.iter().rev().filter_map(leaf).collect();
        }
        for at in boxes {
            if self.witness().is_some() {
                return;
            }
            let within = if excluded { search.loosened(&at) } else { at.clone() };
            if let Some(tried) = search.nearest(&within, &within) {
                self.note(tried);
            }
        }
    }

    /// The same about estimates.
    pub(super) fn try_estimates(&mut self, search: &mut Search<'_>, estimates: Option<&[(Quantity, f64)]>) {
        if let Some(tried) = estimates.and_then(|estimates| search.nearest_to(estimates)) {
            self.note(tried);
        }
    }

    /// Draws the bounds in to what the witnesses reach, until they are hardly wider.
    pub(super) fn sharpen(&mut self, search: &mut Search<'_>, division: &mut Division, budget: usize, good: f64) {
        let budget = budget.min(search.passes + SHARPENING);
        search.contract_kept(division);
        search.even_out(division, COARSE, budget.min(search.passes + EVENING));
        if let Some(tried) = division.hull().and_then(|hull| search.nearest(&hull, &hull)) {
            self.note(tried);
        }
        let ends: Vec<End> = (0..search.setup.layout.common())
            .flat_map(|unknown| [true, false].map(|upper| End { unknown, upper }))
            .collect();
        self.reach(search, division, &ends);
        for round in 1..=ROUNDS {
            let mut left = ends.len();
            for &end in &ends {
                // What one end does not take the others may.
                let share = (budget.saturating_sub(search.passes)) / left / (ROUNDS + 1 - round).min(2);
                left -= 1;
                self.draw_in(search, division, end, search.passes + share, good);
                if division.kept.is_empty() {
                    return;
                }
            }
            if search.passes >= budget || ends.iter().all(|end| self.near(division, *end, good)) {
                return;
            }
        }
    }

    /// How far beyond the witnesses an end may be.
    fn goal(&self, division: &Division, end: End, share: f64) -> Option<f64> {
        let (hull, inner) = (division.hull()?, self.inner.as_ref()?);
        Some(end.of(inner) + share * hull[end.unknown].width())
    }

    fn near(&self, division: &Division, end: End, good: f64) -> bool {
        let reached = division.hull().map(|hull| end.of(&hull));
        reached.zip(self.goal(division, end, 0.5 * (1.0 - good))).is_none_or(|(reached, goal)| reached <= goal)
    }

    /// One end, with a budget; where a box stays that is as good as a point, a witness is looked for in it.
    fn draw_in(&mut self, search: &mut Search<'_>, division: &mut Division, end: End, budget: usize, good: f64) {
        while search.passes < budget && !self.near(division, end, good) {
            let Some(goal) = self.goal(division, end, 0.25 * (1.0 - good)) else { return };
            let room = self.nearest.as_ref().map_or(0.0, |nearest| 1.0 - nearest.misfit);
            let fine = (FINE * room).max(LEAST_FINE);
            let Some(stays) = search.draw_in(division, end, goal, fine, budget) else { return };
            let before = self.inner.as_ref().map(|inner| end.of(inner));
            if let Some(tried) = search.nearest(&stays.at, &stays.at) {
                let hull = division.hull().filter(|_| tried.misfit <= 1.0);
                if let Some(far) = hull.and_then(|hull| search.furthest(&tried, &hull, end.unknown, end.sign())) {
                    self.note(far);
                }
                self.note(tried);
            }
            if self.inner.as_ref().map(|inner| end.of(inner)) == before {
                return;
            }
        }
    }

    /// Witnesses as far to every side as they are found.
    fn reach(&mut self, search: &mut Search<'_>, division: &Division, ends: &[End]) {
        let Some(hull) = division.hull() else { return };
        for end in ends {
            let Some(witness) = self.witness().cloned() else { return };
            if let Some(tried) = search.furthest(&witness, &hull, end.unknown, end.sign()) {
                self.note(tried);
            }
        }
    }

    pub(super) fn into_bounds(self, wide: &Setup, mut search: Search<'_>, division: &Division) -> Bounds {
        let verdict = if self.witness().is_some() {
            Consistency::Consistent
        } else if division.kept.is_empty() {
            Consistency::Refuted
        } else {
            Consistency::Undecided
        };
        let held: Vec<Option<Held>> = division.kept.iter().map(|kept| search.held(kept)).collect();
        let bounds = ranges(&search, division, &held);
        let least = if verdict == Consistency::Refuted { 1.0 } else { least_misfit(&search, &held) };
        let point = |tried: &Tried| Parameters { values: values(search.setup, &tried.at), misfit: tried.misfit };
        let contradicting = if verdict == Consistency::Refuted {
            let shown = division.empties.iter().rev().map(|empty| contradiction(&search, empty));
            // Else those that no parameter of any box meets.
            shown.into_iter().find(|readings| !readings.is_empty()).unwrap_or_else(|| search.clash.clone())
        } else {
            Vec::new()
        };
        Bounds {
            verdict,
            search_box: wide.ranges(&wide.search),
            bounds,
            witness: self.witness().map(point),
            nearest: self.nearest.as_ref().map(point),
            error: search.setup.records.iter().map(|readings| readings.error).collect(),
            error_factor: [least, self.nearest.as_ref().map_or(f64::MAX, |nearest| nearest.misfit)],
            contradicting,
            outliers: Vec::new(),
            passes: search.passes,
        }
    }
}

/// The readings behind a contradiction.
fn contradiction(search: &Search<'_>, empty: &Empty) -> Vec<Contradicting> {
    let Some(linear) = &empty.linear else { return Vec::new() };
    let mut found: Vec<Contradicting> = Vec::new();
    for (row, weight) in &empty.multipliers {
        if let Some(Origin::Reading { window, sample, above }) = linear.origins.get(*row) {
            let record = search.setup.layout.windows()[*window].record;
            let share = weight * search.setup.records[record].error;
            found.push(Contradicting { record, sample: *sample, model_above: *above, share });
        }
    }
    let sum: f64 = found.iter().map(|part| part.share).sum();
    found.iter_mut().for_each(|part| part.share /= sum);
    found.sort_by_key(|part| (part.record, part.sample));
    found
}

/// A point's quantities.
fn values(setup: &Setup, at: &[f64]) -> Vec<(Quantity, f64)> {
    let layout = &setup.layout;
    let side = |term| layout.place_of(term).map(|place| at[place]);
    let gain = at[0];
    let mut values = vec![(Quantity::Alpha, 1.0 / gain)];
    if let Some(linear) = side(Term::Linear) {
        let share = 2.0 * setup.middle_speed * side(Term::Quadratic).unwrap_or(0.0);
        values.push((Quantity::Beta, (linear - share) / gain));
    }
    for (term, quantity) in [
        (Term::Quadratic, Quantity::BetaQuadratic),
        (Term::Cubic, Quantity::BetaCubic),
        (Term::Stiffness, Quantity::Stiffness),
    ] {
        values.extend(side(term).map(|value| (quantity, value / gain)));
    }
    values.extend(side(Term::LagRate).map(|rate| (Quantity::LagS, 1.0 / rate)));
    values.push((Quantity::DelayS, layout.delay().map_or(setup.known_delay_s.midpoint(), |place| at[place])));
    let windows = layout.windows();
    for record in 0..layout.records() {
        values.push((Quantity::Delta(record), at[layout.disturbance(record)] / gain));
        if let Some(first) = windows.iter().position(|window| window.record == record) {
            values.push((Quantity::Position(record), at[layout.start(first, 0)]));
            values.push((Quantity::Velocity(record), at[layout.start(first, 1)]));
        }
    }
    values
}

/// Enclosures over all that is left.
fn ranges(search: &Search<'_>, division: &Division, held: &[Option<Held>]) -> Vec<QuantityRange> {
    let mut all: Vec<QuantityRange> = Vec::new();
    for (kept, held) in division.kept.iter().zip(held) {
        let own = box_ranges(search, &kept.at, held.as_ref());
        if all.is_empty() {
            all = own;
        } else {
            for (all, own) in all.iter_mut().zip(own) {
                all.low = all.low.min(own.low);
                all.high = all.high.max(own.high);
            }
        }
    }
    all
}

fn box_ranges(search: &Search<'_>, at: &[Interval], held: Option<&Held>) -> Vec<QuantityRange> {
    let (setup, layout) = (search.setup, &search.setup.layout);
    let range = |quantity, side: Interval| QuantityRange { quantity, low: side.lower(), high: side.upper() };
    let gain = at[0];
    let mut ranges = vec![range(Quantity::Alpha, Interval::ONE / gain)];
    let ratio = |parts: &[(usize, f64)]| over_gain(at, held, parts);
    if let Some(place) = layout.place_of(Term::Linear) {
        let mut parts = vec![(place, 1.0)];
        parts.extend(layout.place_of(Term::Quadratic).map(|quadratic| (quadratic, -2.0 * setup.middle_speed)));
        let mut side = ratio(&parts);
        if setup.least_linear >= 0.0 {
            // No negative drag is looked for.
            side = side.intersection(Interval::ZERO.hull(side)).unwrap_or(side);
            side = Interval::new(side.lower().max(0.0), side.upper().max(0.0)).unwrap_or(side);
        }
        ranges.push(range(Quantity::Beta, side));
    }
    for (term, quantity) in [
        (Term::Quadratic, Quantity::BetaQuadratic),
        (Term::Cubic, Quantity::BetaCubic),
        (Term::Stiffness, Quantity::Stiffness),
    ] {
        if let Some(place) = layout.place_of(term) {
            ranges.push(range(quantity, ratio(&[(place, 1.0)])));
        }
    }
    if let Some(place) = layout.place_of(Term::LagRate) {
        ranges.push(range(Quantity::LagS, Interval::ONE / at[place]));
    }
    ranges.push(range(Quantity::DelayS, layout.delay().map_or(setup.known_delay_s, |place| at[place])));
    for record in 0..layout.records() {
        ranges.push(range(Quantity::Delta(record), ratio(&[(layout.disturbance(record), 1.0)])));
    }
    let windows = layout.windows();
    for record in 0..layout.records() {
        if let Some(first) = windows.iter().position(|window| window.record == record) {
            ranges.push(range(Quantity::Position(record), at[layout.start(first, 0)]));
            ranges.push(range(Quantity::Velocity(record), at[layout.start(first, 1)]));
        }
    }
    ranges
}

/// A combination of parameters over the gain: by both ranges; and, better, by bounding how far the combination is from its middle
/// ratio times the gain.
fn over_gain(at: &[Interval], held: Option<&Held>, parts: &[(usize, f64)]) -> Interval {
    let gain = at[0];
    let sum = parts.iter().fold(Interval::ZERO, |sum, (place, factor)| sum + Interval::point(*factor) * at[*place]);
    let direct = sum / gain;
    let middle = sum.midpoint() / gain.midpoint();
    let beside: Vec<(usize, f64)> = parts.iter().copied().chain([(0, -middle)]).collect();
    let Some(rest) = held.and_then(|held| held.combination(&beside)) else { return direct };
    direct.intersection(Interval::point(middle) + rest / gain).unwrap_or(direct)
}

/// A lower bound of the largest misfit over all that is left, in largest errors.
fn least_misfit(search: &Search<'_>, held: &[Option<Held>]) -> f64 {
    let mut least = 1.0f64;
    for held in held {
        let Some(held) = held else { return 0.0 };
        let (mut linear, misfit) = search.with_misfit(&held.linear);
        linear.deviations[misfit] = Interval::new(-1.0, 1.0).unwrap_or(Interval::ENTIRE);
        let places: Vec<usize> = (0..=misfit).collect();
        let programme = linear.programme(&places);
        let objective = [(misfit, -1.0)];
        let Outcome::Bounded { multipliers, .. } = programme.maximise(&objective) else { continue };
        let bound = linear.rows.upper_bound(&objective, &multipliers, &linear.deviations);
        least = least.min((Interval::ONE - Interval::point(bound)).lower());
    }
    least.max(0.0)
}
