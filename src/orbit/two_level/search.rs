//! All solutions of the switching conditions from the longest period down, by interval Newton and bisection.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use super::switching::{SwitchedLoop, Times};
use crate::numeric::Interval;
use crate::proof::Gradient;
use crate::proof::enclosure::{Roots, around, krawczyk};

/// Boxes looked at before the search ends.
const BOXES: usize = 12_000;
/// Orbits after which the search ends: a relay with dead time and without hysteresis has infinitely many, ever faster.
const ORBITS: usize = 5;
/// Newton steps on a box before it is halved: a second step gains less than it costs.
const STEPS: usize = 1;
/// A step that shrinks every side below this share has come near a solution.
const SHRUNK: f64 = 0.3;
/// A box of this size relative to its period is not halved further.
const SMALLEST: f64 = 1e-9;

/// Half-periods at the upper and at the lower level.
pub(super) type HalfPeriods = [Interval; 2];

/// What a search has left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Found {
    /// Periods from `searched_from` up outside these have no further solution.
    pub(super) not_covered: Vec<Interval>,
    /// The period, s, at which the search ended before the shortest of its range; `None` where it did not.
    pub(super) searched_from: Option<f64>,
}

/// The periods asked for, and the time by which unbounded boxes are cut.
#[derive(Clone, Copy, Debug)]
pub(super) struct PeriodRange {
    pub(super) shortest: f64,
    pub(super) longest: f64,
    pub(super) unit: f64,
}

impl PeriodRange {
    /// A half-period as a share of infinity: linear up to the loop's own time, then slower.
    fn share(&self, time: f64) -> f64 {
        if time.is_finite() { time / (time + self.unit) } else { 1.0 }
    }

    /// Where to cut a half-period: in the middle of that share.
    fn cut(&self, time: Interval) -> f64 {
        let share = 0.5 * (self.share(time.lower()) + self.share(time.upper()));
        (self.unit * share / (1.0 - share)).clamp(time.lower(), time.upper().min(f64::MAX))
    }
}

impl SwitchedLoop {
    /// Hands all solutions in a range of periods to `is_orbit`, from the slowest down, until enough of them are orbits.
    pub(super) fn solutions(&self, range: &PeriodRange, is_orbit: impl FnMut(&HalfPeriods) -> bool) -> Found {
        let from = |lower: f64| Interval::new(lower, f64::INFINITY).unwrap_or(Interval::ENTIRE);
        match self.share {
            Some(_) => self.search([from(range.shortest)], range, is_orbit),
            None => self.search([from(0.0); 2], range, is_orbit),
        }
    }

    /// The only solution in a box of half-periods, enclosed.
    pub(super) fn solution_in(&self, at: &HalfPeriods) -> Option<HalfPeriods> {
        match self.share {
            Some(_) => self.only([at[0] + at[1]]),
            None => self.only(*at),
        }
    }

    fn times<const N: usize>(&self, at: [Interval; N]) -> Times<N> {
        Times::new(at.map(Gradient::constant), self.share)
    }

    fn search<const N: usize>(
        &self,
        domain: [Interval; N],
        range: &PeriodRange,
        mut is_orbit: impl FnMut(&HalfPeriods) -> bool,
    ) -> Found {
        let period = |at: [Interval; N]| self.times(at).period.value();
        let miss = |unknowns: [Gradient<N>; N]| self.misses(unknowns);
        let outside = |period: Interval| period.upper() < range.shortest || period.lower() > range.longest;
        // By their longest periods, whose bits are ordered as they are, and their numbers.
        let mut open = BTreeMap::from([((f64::INFINITY.to_bits(), 0), domain)]);
        let mut roots: Vec<[Interval; N]> = Vec::new();
        let mut found = Found::default();
        let (mut boxes, mut made, mut orbits) = (0, 0, 0);
        while let Some(((longest, _), at)) = open.pop_last() {
            boxes += 1;
            if boxes > BOXES || orbits >= ORBITS {
                found.searched_from = Some(f64::from_bits(longest).min(range.longest));
                break;
            }
            let bounded = at.iter().all(|side| side.is_bounded());
            // Without a middle there is no Newton step.
            let step = if bounded { about(miss, at) } else { Roots::Undecided { remaining: at, steps: 0 } };
            let remaining = match step {
                Roots::None { .. } => continue,
                Roots::Unique { enclosure, .. } => {
                    let enclosure = narrowed(miss, enclosure);
                    // A solution on the border of two boxes is found in both.
                    if !outside(period(enclosure)) && !roots.iter().any(|known| same(miss, known, &enclosure)) {
                        roots.push(enclosure);
                        orbits += usize::from(is_orbit(&self.times(enclosure).half_periods()));
                    }
                    continue;
                }
                Roots::Undecided { remaining, .. } => remaining,
            };
            let excluded = if bounded {
                self.refuses(remaining)
            } else {
                miss(Gradient::variables(at)).iter().any(|miss| !miss.value().contains_zero())
            };
            if excluded {
                continue;
            }
            let widths = remaining.map(|side| range.share(side.upper()) - range.share(side.lower()));
            let side = (0..N).max_by(|&a, &b| widths[a].total_cmp(&widths[b])).unwrap_or(0);
            if widths[side] <= SMALLEST * range.share(period(remaining).upper()) {
                found.not_covered.push(period(remaining));
                continue;
            }
            let cut = range.cut(remaining[side]);
            for (lower, upper) in [(remaining[side].lower(), cut), (cut, remaining[side].upper())] {
                let mut half = remaining;
                half[side] = Interval::new(lower, upper).unwrap_or(remaining[side]);
                let period = period(half);
                if !outside(period) {
                    made += 1;
                    open.insert((period.upper().to_bits(), made), half);
                }
            }
        }
        found
    }

    /// The only solution that Krawczyk's operator shows in a box.
    fn only<const N: usize>(&self, at: [Interval; N]) -> Option<HalfPeriods> {
        let miss = |unknowns: [Gradient<N>; N]| self.misses(unknowns);
        let Roots::Unique { enclosure, .. } = krawczyk(miss, at, 30) else { return None };
        Some(self.times(narrowed(miss, enclosure)).half_periods())
    }
}

/// Newton steps on a box. Where a step has shrunk it, a solution may be on the border of the remainder: then on a
/// larger box, and a solution found may lie outside this box.
fn about<const N: usize>(
    miss: impl Fn([Gradient<N>; N]) -> [Gradient<N>; N],
    at: [Interval; N],
) -> Roots<[Interval; N]> {
    let found = krawczyk(&miss, at, STEPS);
    let Roots::Undecided { remaining, .. } = found else { return found };
    if (0..N).any(|side| remaining[side].width() > SHRUNK * at[side].width()) {
        return found;
    }
    let larger = remaining.map(|side| side + Interval::symmetric(side.width().max(1e-14 * side.magnitude())));
    match krawczyk(&miss, larger, 6) {
        Roots::Undecided { .. } => found,
        decided => decided,
    }
}

/// The enclosure of the only solution in a box, as narrow as a small box about its floating-point approximation gives it.
fn narrowed<const N: usize>(miss: impl Fn([Gradient<N>; N]) -> [Gradient<N>; N], at: [Interval; N]) -> [Interval; N] {
    let mut point = at.map(Interval::midpoint);
    for _ in 0..20 {
        let found = miss(Gradient::variables(point.map(Interval::point)));
        let slopes = DMatrix::from_fn(N, N, |row, column| found[row].slopes()[column].midpoint());
        let values = DVector::from_fn(N, |row, _| found[row].value().midpoint());
        let Some(step) = slopes.lu().solve(&values) else { break };
        point = core::array::from_fn(|side| (point[side] - step[side]).clamp(at[side].lower(), at[side].upper()));
    }
    let size = point.iter().fold(0.0_f64, |size, coordinate| size.max(coordinate.abs()));
    let enclosed = [1e-12, 1e-10, 1e-8, 1e-6].into_iter().find_map(|radius| {
        match krawczyk(&miss, around(point, radius * size), 30) {
            Roots::Unique { enclosure, .. } => Some(enclosure),
            _ => None,
        }
    });
    // That of the small box is the box's own where it lies inside.
    enclosed.filter(|enclosure| (0..N).all(|side| enclosure[side].is_subset_of(at[side]))).unwrap_or(at)
}

/// Whether two enclosures are shown to be of the same solution.
fn same<const N: usize>(
    miss: impl Fn([Gradient<N>; N]) -> [Gradient<N>; N],
    a: &[Interval; N],
    b: &[Interval; N],
) -> bool {
    if (0..N).any(|side| a[side].intersection(b[side]).is_none()) {
        return false;
    }
    let both = core::array::from_fn(|side| {
        let hull = a[side].hull(b[side]);
        hull + Interval::symmetric(hull.width())
    });
    matches!(krawczyk(miss, both, 3), Roots::Unique { .. })
}
