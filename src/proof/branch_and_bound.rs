//! Inequalities proved over a whole box by subdivision.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::numeric::Interval;

/// Whether an inequality holds on a box, with the work spent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict<const N: usize> {
    /// It holds everywhere.
    Proved {
        /// A positive lower bound of the margin on the whole box.
        margin: f64,
        /// Boxes evaluated.
        boxes: usize,
    },
    /// It fails at `witness`.
    Refuted {
        /// A point of the box.
        witness: [f64; N],
        /// The margin there, nowhere positive.
        margin: Interval,
        /// Boxes evaluated.
        boxes: usize,
    },
    /// The budget did not suffice, or the margin on some box cannot be told from zero by subdivision.
    Undecided {
        /// A box that was not decided.
        at: [Interval; N],
        /// The margin on it.
        margin: Interval,
        /// Boxes evaluated.
        boxes: usize,
    },
}

/// Decides whether `margin > 0` everywhere on the bounded box `domain`: the box with the lowest bound is halved first,
/// along the side that is longest compared with the domain's. Evaluates `margin` on at most `budget` boxes, and once at
/// the midpoint of each that is halved.
///
/// `margin` must enclose the values over the box that it is given. An inequality with equality somewhere is undecided.
///
/// ```
/// use selfosc::proof::branch_and_bound::{Verdict, prove_positive};
/// use selfosc::numeric::{Interval, Real};
/// // x^2 - x + 0.3 has its minimum 0.05 at x = 1/2.
/// let margin = |[x]: &[Interval; 1]| x.square() - *x + Interval::from_f64(0.3);
/// let verdict = prove_positive(margin, [Interval::UNIT], 1000);
/// assert!(matches!(verdict, Verdict::Proved { margin, .. } if margin < 0.05));
/// ```
#[must_use]
pub fn prove_positive<const N: usize>(
    margin: impl Fn(&[Interval; N]) -> Interval,
    domain: [Interval; N],
    budget: usize,
) -> Verdict<N> {
    divide(margin, domain, budget).0
}

/// [`prove_positive`], with the boxes that the domain was divided into: the lower half of a box, and all that became of it,
/// before the upper one.
pub(super) fn divide<const N: usize>(
    margin: impl Fn(&[Interval; N]) -> Interval,
    domain: [Interval; N],
    budget: usize,
) -> (Verdict<N>, Vec<[Interval; N]>) {
    let sizes = domain.map(Interval::width);
    let mut smallest = f64::INFINITY;
    let mut nodes = vec![Node { at: domain, halves: None }];
    let mut open = BinaryHeap::new();
    let mut fresh = 0..1;
    let verdict = loop {
        for index in fresh {
            let value = margin(&nodes[index].at);
            if value.is_positive() {
                smallest = smallest.min(value.lower());
            } else {
                open.push(Open { index, margin: value });
            }
        }
        let boxes = nodes.len();
        let Some(Open { index, margin: value }) = open.pop() else {
            break Verdict::Proved { margin: smallest, boxes };
        };
        let at = nodes[index].at;
        let witness = at.map(Interval::midpoint);
        let at_witness = margin(&witness.map(Interval::point));
        if at_witness.upper() <= 0.0 {
            break Verdict::Refuted { witness, margin: at_witness, boxes };
        }
        let Some(halves) = halves(&at, &sizes).filter(|_| boxes + 2 <= budget) else {
            break Verdict::Undecided { at, margin: value, boxes };
        };
        nodes[index].halves = Some([boxes, boxes + 1]);
        nodes.extend(halves.map(|at| Node { at, halves: None }));
        fresh = boxes..boxes + 2;
    };
    (verdict, undivided(&nodes))
}

/// A box, and where its halves are.
struct Node<const N: usize> {
    at: [Interval; N],
    halves: Option<[usize; 2]>,
}

/// The boxes without halves, in order, from the first node on.
fn undivided<const N: usize>(nodes: &[Node<N>]) -> Vec<[Interval; N]> {
    let (mut boxes, mut open) = (Vec::new(), vec![0]);
    while let Some(node) = open.pop().and_then(|index: usize| nodes.get(index)) {
        match node.halves {
            Some([lower, upper]) => open.extend([upper, lower]),
            None => boxes.push(node.at),
        }
    }
    boxes
}

/// A box on which the margin may not be positive; the heap yields the lowest bound first.
struct Open {
    index: usize,
    margin: Interval,
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        other.margin.lower().total_cmp(&self.margin.lower())
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

/// The box halved along its longest side, measured in `sizes`; `None` if that cannot be.
fn halves<const N: usize>(at: &[Interval; N], sizes: &[f64; N]) -> Option<[[Interval; N]; 2]> {
    let share = |i: usize| if sizes[i] > 0.0 { at[i].width() / sizes[i] } else { 0.0 };
    let longest = (0..N).max_by(|&i, &j| share(i).total_cmp(&share(j)))?;
    let (lower, upper) = at[longest].bisect();
    if !at[longest].is_bounded() || lower.is_point() || upper.is_point() {
        return None;
    }
    Some([lower, upper].map(|side| {
        let mut half = *at;
        half[longest] = side;
        half
    }))
}
