//! Branch and bound over boxes: the driver of every proof by subdivision, and inequalities proved by it.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::outcome::{Bound, NotProved, Proved};
use crate::numeric::Interval;

/// Verdict on a visited box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Visit {
    /// The box is finished.
    Settled,
    /// It is halved, boxes of the least rank first; along that side, or the longest compared with the domain's.
    Divide {
        /// Of equal ranks, the box made last comes first, and a lower half before the upper half.
        rank: f64,
        /// Side to be halved.
        along: Option<usize>,
    },
    /// The search ends here: no division helps.
    Stop,
}

impl Visit {
    /// Settled, or else halved along the longest side, from left to right.
    #[must_use]
    pub const fn settled(settled: bool) -> Self {
        if settled { Self::Settled } else { Self::Divide { rank: 0.0, along: None } }
    }
}

/// How a subdivision ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Subdivision<const N: usize> {
    /// An unsettled box: a visit stopped there, the budget was spent, or the box cannot be halved; `None`
    /// where all are settled.
    pub unsettled: Option<[Interval; N]>,
    /// Boxes visited.
    pub boxes: usize,
    /// The boxes that make up the domain: a lower half, with its parts, before the upper half.
    pub parts: Vec<[Interval; N]>,
}

impl<const N: usize> Subdivision<N> {
    /// The subdivision, if all boxes are settled.
    ///
    /// # Errors
    /// [`NotProved::Undecided`] with the box that is not.
    pub fn complete(self) -> Result<Self, NotProved<N>> {
        self.unsettled.map_or(Ok(()), |at| Err(NotProved::Undecided { at, boxes: self.boxes }))?;
        Ok(self)
    }

    /// A proof, if all boxes are settled.
    pub(super) fn proved(self, domain: [Interval; N], bound: Bound) -> Result<Proved<N>, NotProved<N>> {
        let Self { parts, boxes, .. } = self.complete()?;
        Ok(Proved { bound, domain, parts, boxes })
    }
}

/// Divides `domain` until `visit` has settled every box; visits at most `budget` boxes.
///
/// Rank zero throughout goes through the domain from its lower end; the lower bound of what shall be positive, as a rank,
/// is best-first search.
pub fn subdivide<const N: usize>(
    domain: [Interval; N],
    budget: usize,
    mut visit: impl FnMut(&[Interval; N]) -> Visit,
) -> Subdivision<N> {
    let sizes = domain.map(Interval::width);
    let mut nodes = vec![HalvedBox { at: domain, halves: None }];
    let mut open = BinaryHeap::new();
    let mut fresh = 0..1;
    let unsettled = 'search: loop {
        for index in fresh {
            match visit(&nodes[index].at) {
                Visit::Settled => {}
                Visit::Divide { rank, along } => open.push(Open { rank, index, along }),
                Visit::Stop => break 'search Some(nodes[index].at),
            }
        }
        let Some(Open { index, along, .. }) = open.pop() else { break None };
        let (at, boxes) = (nodes[index].at, nodes.len());
        let side = along.or_else(|| longest(&at, &sizes));
        let Some(halves) = side.and_then(|side| halves(&at, side)).filter(|_| boxes + 2 <= budget) else {
            break Some(at);
        };
        nodes[index].halves = Some([boxes, boxes + 1]);
        nodes.extend(halves.map(|at| HalvedBox { at, halves: None }));
        fresh = boxes..boxes + 2;
    };
    Subdivision { unsettled, boxes: nodes.len(), parts: undivided(&nodes) }
}

/// Proves `margin > 0` everywhere on the bounded box `domain`, best-first: the box with the lowest bound is halved first,
/// along the side that is longest compared with the domain's. Evaluates `margin` on at most `budget` boxes, and once at
/// the midpoint of each on which it is not positive.
///
/// `margin` must enclose the values over the box that it is given.
///
/// ```
/// use selfosc::proof::{Bound, branch_and_bound::prove_positive};
/// use selfosc::numeric::{Interval, Real};
/// // x^2 - x + 0.3 has its minimum 0.05 at x = 1/2.
/// let margin = |[x]: &[Interval; 1]| x.square() - *x + Interval::from_f64(0.3);
/// let proved = prove_positive(margin, [Interval::UNIT], 1000)?;
/// assert!(matches!(proved.bound, Bound::Margin(margin) if margin < 0.05));
/// # Ok::<(), selfosc::proof::NotProved<1>>(())
/// ```
///
/// # Errors
/// [`NotProved`]. An inequality with equality somewhere is undecided.
pub fn prove_positive<const N: usize>(
    margin: impl Fn(&[Interval; N]) -> Interval,
    domain: [Interval; N],
    budget: usize,
) -> Result<Proved<N>, NotProved<N>> {
    let (mut smallest, mut refuted) = (f64::INFINITY, None);
    let found = subdivide(domain, budget, |at| {
        let value = margin(at);
        if value.is_positive() {
            smallest = smallest.min(value.lower());
            return Visit::Settled;
        }
        let witness = at.map(Interval::midpoint);
        let at_witness = margin(&witness.map(Interval::point));
        if at_witness.upper() <= 0.0 {
            refuted = Some((witness, at_witness));
            return Visit::Stop;
        }
        Visit::Divide { rank: value.lower(), along: None }
    });
    match refuted {
        Some((witness, value)) => Err(NotProved::Refuted { witness, value, boxes: found.boxes }),
        None => found.proved(domain, Bound::Margin(smallest)),
    }
}

/// A box, and where its halves are.
struct HalvedBox<const N: usize> {
    at: [Interval; N],
    halves: Option<[usize; 2]>,
}

/// The boxes without halves, in order, from the first node on.
fn undivided<const N: usize>(nodes: &[HalvedBox<N>]) -> Vec<[Interval; N]> {
    let (mut boxes, mut open) = (Vec::new(), vec![0]);
    while let Some(node) = open.pop().and_then(|index: usize| nodes.get(index)) {
        match node.halves {
            Some([lower, upper]) => open.extend([upper, lower]),
            None => boxes.push(node.at),
        }
    }
    boxes
}

/// A box that waits to be halved; the heap yields the lowest rank first.
struct Open {
    rank: f64,
    index: usize,
    along: Option<usize>,
}

impl Open {
    /// Place among boxes of equal rank. Lower halves have odd indices, their upper ones the next.
    const fn turn(&self) -> usize {
        if self.index % 2 == 1 { self.index + 1 } else { self.index.saturating_sub(1) }
    }
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        other.rank.total_cmp(&self.rank).then(self.turn().cmp(&other.turn()))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Open {}

/// The longest side, measured in `sizes`.
fn longest<const N: usize>(at: &[Interval; N], sizes: &[f64; N]) -> Option<usize> {
    let share = |i: usize| if sizes[i] > 0.0 { at[i].width() / sizes[i] } else { 0.0 };
    (0..N).max_by(|&i, &j| share(i).total_cmp(&share(j)))
}

/// The box halved along a side; `None` if that cannot be.
fn halves<const N: usize>(at: &[Interval; N], side: usize) -> Option<[[Interval; N]; 2]> {
    let (lower, upper) = at[side].bisect();
    if !at[side].is_bounded() || lower.is_point() || upper.is_point() {
        return None;
    }
    Some([lower, upper].map(|half| {
        let mut part = *at;
        part[side] = half;
        part
    }))
}
