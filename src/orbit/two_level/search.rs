//! All solutions of the switching conditions from the longest period down, by interval Newton and bisection.

use std::collections::BinaryHeap;

use nalgebra::{DMatrix, DVector};

use super::switching::{Conditions, Times};
use crate::numeric::Interval;
use crate::proof::Gradient;
use crate::proof::enclosure::{Roots, krawczyk};

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

/// The result of a search.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Found {
    /// Enclosures of solutions, each of a single solution.
    pub(super) solutions: Vec<HalfPeriods>,
    /// Periods from `searched_from` up outside these have no further solution.
    pub(super) not_covered: Vec<Interval>,
    /// The period, s, at which the search ended before the shortest of its range; `None` where it did not.
    pub(super) searched_from: Option<f64>,
}

/// A part of the search.
#[derive(Clone, Copy, Debug)]
struct Part<const N: usize> {
    at: [Interval; N],
    longest: f64,
}

impl<const N: usize> PartialEq for Part<N> {
    fn eq(&self, other: &Self) -> bool {
        self.longest.total_cmp(&other.longest).is_eq()
    }
}
impl<const N: usize> Eq for Part<N> {}
impl<const N: usize> PartialOrd for Part<N> {
    fn partial_cmp(&self, other: &Self) -> Option<core::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl<const N: usize> Ord for Part<N> {
    fn cmp(&self, other: &Self) -> core::cmp::Ordering {
        self.longest.total_cmp(&other.longest)
    }
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

    fn width(&self, time: Interval) -> f64 {
        self.share(time.upper()) - self.share(time.lower())
    }
}

/// The equations of a search over `N` unknowns.
trait BoxEquations<const N: usize> {
    fn miss(&self, unknowns: [Gradient<N>; N]) -> [Gradient<N>; N];
    fn times(&self, unknowns: [Gradient<N>; N]) -> Times<N>;
}

struct Free<'a>(&'a Conditions);
struct SharedConditions<'a>(&'a Conditions, Interval);

impl BoxEquations<2> for Free<'_> {
    fn miss(&self, unknowns: [Gradient<2>; 2]) -> [Gradient<2>; 2] {
        self.0.misses(unknowns)
    }
    fn times(&self, unknowns: [Gradient<2>; 2]) -> Times<2> {
        Times::free(unknowns)
    }
}

impl BoxEquations<1> for SharedConditions<'_> {
    fn miss(&self, [period]: [Gradient<1>; 1]) -> [Gradient<1>; 1] {
        [self.0.rise_miss(period, self.1)]
    }
    fn times(&self, [period]: [Gradient<1>; 1]) -> Times<1> {
        Times::shared(period, self.1)
    }
}

impl Conditions {
    /// All solutions in a range of periods, until enough of them are orbits.
    pub(super) fn solutions(&self, range: &PeriodRange, is_orbit: impl FnMut(&HalfPeriods) -> bool) -> Found {
        let from = |lower: f64| Interval::new(lower, f64::INFINITY).unwrap_or(Interval::ENTIRE);
        match self.share {
            Some(share) => self.search(&SharedConditions(self, share), [from(range.shortest)], range, is_orbit),
            None => self.search(&Free(self), [from(0.0); 2], range, is_orbit),
        }
    }

    /// The only solution in a box of half-periods, enclosed.
    pub(super) fn solution_in(&self, at: &HalfPeriods) -> Option<HalfPeriods> {
        match self.share {
            Some(share) => only(&SharedConditions(self, share), [at[0] + at[1]]),
            None => only(&Free(self), *at),
        }
    }

    pub(super) fn times(&self, at: &HalfPeriods) -> Times<2> {
        Times::free(at.map(Gradient::constant))
    }

    fn search<const N: usize>(
        &self,
        equations: &impl BoxEquations<N>,
        domain: [Interval; N],
        range: &PeriodRange,
        mut is_orbit: impl FnMut(&HalfPeriods) -> bool,
    ) -> Found {
        let times = |at: [Interval; N]| equations.times(at.map(Gradient::constant));
        let period = |at: [Interval; N]| times(at).period.value();
        let miss = |unknowns: [Gradient<N>; N]| equations.miss(unknowns);
        let outside = |period: Interval| period.upper() < range.shortest || period.lower() > range.longest;
        let mut open = BinaryHeap::from([Part { at: domain, longest: f64::INFINITY }]);
        let mut roots: Vec<[Interval; N]> = Vec::new();
        let mut found = Found::default();
        let (mut boxes, mut orbits) = (0, 0);
        while let Some(Part { at, longest }) = open.pop() {
            boxes += 1;
            if boxes > BOXES || orbits >= ORBITS {
                found.searched_from = Some(longest.min(range.longest));
                break;
            }
            let bounded = at.iter().all(|side| side.is_bounded());
            let remaining = if bounded {
                match about(miss, at) {
                    Roots::None { .. } => continue,
                    Roots::Unique { enclosure, .. } => {
                        let enclosure = narrowed(miss, enclosure);
                        // A solution on the border of two boxes is found in both.
                        if !outside(period(enclosure)) && !roots.iter().any(|known| same(miss, known, &enclosure)) {
                            roots.push(enclosure);
                            let half_periods = times(enclosure);
                            let half_periods = [half_periods.high.value(), half_periods.low.value()];
                            orbits += usize::from(is_orbit(&half_periods));
                            found.solutions.push(half_periods);
                        }
                        continue;
                    }
                    Roots::Undecided { remaining, .. } => {
                        let middle = remaining.map(|side| Interval::point(side.midpoint()));
                        if self.refuses(&equations.times(Gradient::variables(remaining)), &times(middle), &remaining) {
                            continue;
                        }
                        remaining
                    }
                }
            } else {
                // Without a middle there is no Newton step.
                if miss(Gradient::variables(at)).iter().any(|miss| !miss.value().contains_zero()) {
                    continue;
                }
                at
            };
            let widths = remaining.map(|side| range.width(side));
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
                    open.push(Part { at: half, longest: period.upper() });
                }
            }
        }
        found
    }
}

/// The only solution that Krawczyk's operator shows in a box.
fn only<const N: usize>(equations: &impl BoxEquations<N>, at: [Interval; N]) -> Option<HalfPeriods> {
    let miss = |unknowns: [Gradient<N>; N]| equations.miss(unknowns);
    let Roots::Unique { enclosure, .. } = krawczyk(miss, at, 30) else { return None };
    let times = equations.times(narrowed(miss, enclosure).map(Gradient::constant));
    Some([times.high.value(), times.low.value()])
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
        for (side, (coordinate, step)) in point.iter_mut().zip(step.iter()).enumerate() {
            *coordinate = (*coordinate - step).clamp(at[side].lower(), at[side].upper());
        }
    }
    let size = point.iter().fold(0.0_f64, |size, coordinate| size.max(coordinate.abs()));
    let about = |radius: f64| point.map(|coordinate| Interval::point(coordinate) + Interval::symmetric(radius * size));
    let enclosed = [1e-12, 1e-10, 1e-8, 1e-6].into_iter().find_map(|radius| match krawczyk(&miss, about(radius), 30) {
        Roots::Unique { enclosure, .. } => Some(enclosure),
        _ => None,
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
