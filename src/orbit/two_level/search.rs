//! All solutions of the switching conditions from the longest period down, by interval Newton and bisection.

use std::collections::BinaryHeap;

use super::switching::{Conditions, Times};
use crate::numeric::Interval;
use crate::proof::Gradient;
use crate::proof::enclosure::{Roots, krawczyk};

/// Boxes looked at before the search ends.
const BOXES: usize = 20_000;
/// Solutions after which the search ends: a relay with dead time has infinitely many, ever faster.
const SOLUTIONS: usize = 20;
/// Newton steps on a box before it is halved.
const STEPS: usize = 3;
/// A box of this size relative to its period is not halved further.
const SMALLEST: f64 = 1e-9;
/// Longest half-period that is told from infinity, over the loop's own time.
const FAR: f64 = 1e7;

/// Half-periods at the upper and at the lower level.
pub(super) type HalfPeriods = [Interval; 2];

/// What a search has found.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Found {
    /// Enclosures of solutions, each of one.
    pub(super) solutions: Vec<HalfPeriods>,
    /// Periods outside these hold no other solution.
    pub(super) not_covered: Vec<Interval>,
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

/// What of a box's periods is asked for, and the time by which unbounded boxes are cut.
#[derive(Clone, Copy, Debug)]
pub(super) struct Range {
    pub(super) shortest: f64,
    pub(super) longest: f64,
    pub(super) unit: f64,
}

impl Conditions {
    /// All solutions in a range of periods.
    pub(super) fn solutions(&self, range: &Range) -> Found {
        let from = |lower: f64| Interval::new(lower, f64::INFINITY).unwrap_or(Interval::ENTIRE);
        if let Some(share) = self.share {
            let times = |[period]: [Interval; 1]| [period * share, period * (Interval::ONE - share)];
            let miss = |[period]: [Gradient<1>; 1]| [self.rise_miss(period, share)];
            return search(miss, |[period]| period, times, [from(range.shortest)], range);
        }
        let miss = |unknowns: [Gradient<2>; 2]| self.misses(unknowns);
        search(miss, |[high, low]| high + low, |times| times, [from(0.0); 2], range)
    }

    pub(super) fn times(&self, at: &HalfPeriods) -> Times<2> {
        Times::free(at.map(Gradient::constant))
    }
}

fn search<const N: usize>(
    miss: impl Fn([Gradient<N>; N]) -> [Gradient<N>; N],
    period: impl Fn([Interval; N]) -> Interval,
    times: impl Fn([Interval; N]) -> HalfPeriods,
    domain: [Interval; N],
    range: &Range,
) -> Found {
    let mut open = BinaryHeap::from([Part { at: domain, longest: f64::INFINITY }]);
    let mut found = Found::default();
    let mut roots: Vec<[Interval; N]> = Vec::new();
    let mut boxes = 0;
    let outside = |at: &[Interval; N]| {
        let period = period(*at);
        period.upper() < range.shortest || period.lower() > range.longest
    };
    while let Some(Part { at, longest }) = open.pop() {
        boxes += 1;
        if boxes > BOXES || roots.len() >= SOLUTIONS {
            found.not_covered.extend(Interval::new(range.shortest, longest.min(range.longest)));
            break;
        }
        let mut push = |half: [Interval; N]| {
            if !outside(&half) {
                open.push(Part { at: half, longest: period(half).upper() });
            }
        };
        if let Some(side) = (0..N).filter(|&side| !at[side].is_bounded()).min_by(|&a, &b| at[a].lower().total_cmp(&at[b].lower())) {
            // Without a middle there is no Newton step.
            if miss(Gradient::variables(at)).iter().any(|miss| !miss.value().contains_zero()) {
                continue;
            }
            let cut = (2.0 * at[side].lower()).max(range.unit);
            if cut > FAR * range.unit {
                found.not_covered.push(period(at));
                continue;
            }
            for (lower, upper) in [(at[side].lower(), cut), (cut, f64::INFINITY)] {
                let mut half = at;
                half[side] = Interval::new(lower, upper).unwrap_or(at[side]);
                push(half);
            }
            continue;
        }
        let remaining = match krawczyk(&miss, at, STEPS) {
            Roots::None { .. } => continue,
            Roots::Unique { enclosure, .. } => {
                let enclosure = narrowed(&miss, enclosure);
                // A solution on the border of two boxes is found in both.
                if !outside(&enclosure) && !roots.iter().any(|known| same(&miss, known, &enclosure)) {
                    roots.push(enclosure);
                }
                continue;
            }
            Roots::Undecided { remaining, .. } => remaining,
        };
        let side = (0..N).max_by(|&a, &b| remaining[a].width().total_cmp(&remaining[b].width())).unwrap_or(0);
        if remaining[side].width() <= SMALLEST * period(remaining).upper() {
            found.not_covered.push(period(remaining));
            continue;
        }
        let (lower, upper) = remaining[side].bisect();
        for part in [lower, upper] {
            let mut half = remaining;
            half[side] = part;
            push(half);
        }
    }
    found.solutions = roots.into_iter().map(times).collect();
    found
}

/// The enclosure after as many steps as narrow it.
fn narrowed<const N: usize>(miss: impl Fn([Gradient<N>; N]) -> [Gradient<N>; N], at: [Interval; N]) -> [Interval; N] {
    match krawczyk(miss, at, 30) {
        Roots::Unique { enclosure, .. } => enclosure,
        Roots::Undecided { remaining, .. } => remaining,
        Roots::None { .. } => at,
    }
}

/// Whether two enclosures are shown to be of one solution.
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
