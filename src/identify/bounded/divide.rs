//! Division of the search box until every part is empty or as small as it needs to be.

use super::field::Term;
use super::search::{Empty, Left, Made, Search};
use crate::numeric::Interval;

/// A box is not divided further where the slopes' ranges take less than this of the readings' error.
const FINE: f64 = 0.003;
/// A box stands for what is left once they take less than this.
const FOLLOWED: f64 = 4.0;

/// A node of the tree of divisions, for the certificate.
#[derive(Clone, Debug)]
pub(super) struct Branch {
    pub(super) made: Vec<Made>,
    pub(super) then: Then,
}

/// What became of a box.
#[derive(Clone, Debug)]
pub(super) enum Then {
    /// Nothing is in it.
    Empty(Box<Empty>),
    /// It was divided at a value of an unknown: below, above.
    Divided { unknown: usize, value: f64, parts: [usize; 2] },
    /// It is among those left.
    Left,
}

/// A box that is left.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    pub(super) at: Vec<Interval>,
    pub(super) left: Left,
    branch: usize,
}

/// The tree so far, and what is left.
pub(super) struct Division {
    pub(super) tree: Vec<Branch>,
    pub(super) kept: Vec<Kept>,
    /// Whether the budget sufficed to follow the motion over all that is left.
    pub(super) followed: bool,
}

impl Division {
    /// The smallest box around all that is left; `None` where nothing is.
    pub(super) fn hull(&self) -> Option<Vec<Interval>> {
        let boxes = self.kept.iter().map(|kept| kept.at.clone());
        boxes.reduce(|hull, at| hull.iter().zip(&at).map(|(a, b)| a.hull(*b)).collect())
    }
}

impl Search<'_> {
    /// Divides a box at a parameter: the gain, whose orders of magnitude count, at the geometric mean.
    fn divide(&self, at: &[Interval], unknown: usize) -> Option<(f64, [Vec<Interval>; 2])> {
        let side = at[unknown];
        let positive = side.lower() > 0.0;
        let orders = matches!(self.setup.layout.terms().get(unknown), Some(Term::Gain | Term::LagRate));
        let value = if orders && positive { libm::sqrt(side.lower() * side.upper()) } else { side.midpoint() };
        let [low, high] = [Interval::new(side.lower(), value)?, Interval::new(value, side.upper())?];
        let value = low.upper();
        let parts = [low, high].map(|half| {
            let mut part = at.to_vec();
            part[unknown] = half;
            part
        });
        (side.lower() < value && value < side.upper()).then_some((value, parts))
    }

    /// Everything in `at`, divided until the motion can be followed over each part that is left.
    pub(super) fn search(&mut self, at: Vec<Interval>, budget: usize) -> Division {
        let mut division = Division { tree: Vec::new(), kept: Vec::new(), followed: true };
        self.refine(&mut division, vec![at], budget);
        division
    }

    /// Divides one of the boxes left; `false` where that would not help.
    pub(super) fn divide_kept(&mut self, division: &mut Division, index: usize, budget: usize) -> bool {
        let Left::Followed { slack, widest } = division.kept[index].left else { return false };
        if slack < FINE {
            return false;
        }
        let Some((value, parts)) = self.divide(&division.kept[index].at, widest) else { return false };
        let kept = division.kept.swap_remove(index);
        let next = division.tree.len();
        division.tree[kept.branch].then = Then::Divided { unknown: widest, value, parts: [next, next + 1] };
        self.refine(division, parts.into(), budget);
        true
    }

    /// Divides the box left whose slopes' ranges take most; `false` where there is none that this would help.
    pub(super) fn divide_coarsest(&mut self, division: &mut Division, budget: usize) -> bool {
        let slack = |kept: &Kept| match kept.left {
            Left::Followed { slack, .. } => slack,
            Left::Wide(_) => 0.0,
        };
        let coarsest =
            (0..division.kept.len()).max_by(|a, b| slack(&division.kept[*a]).total_cmp(&slack(&division.kept[*b])));
        coarsest.is_some_and(|index| self.divide_kept(division, index, budget))
    }

    /// Works off a list of boxes, which take the next places in the tree.
    fn refine(&mut self, division: &mut Division, boxes: Vec<Vec<Interval>>, budget: usize) {
        let mut open: Vec<(Vec<Interval>, usize)> = Vec::new();
        let place = |division: &mut Division| {
            division.tree.push(Branch { made: Vec::new(), then: Then::Left });
            division.tree.len() - 1
        };
        for at in boxes {
            open.push((at, place(division)));
        }
        while let Some((mut at, branch)) = open.pop() {
            if self.passes >= budget {
                division.followed = false;
                division.kept.push(Kept { at, left: Left::Wide(0), branch });
                continue;
            }
            let mut made = Vec::new();
            let left = self.contract(&mut at, &mut made);
            division.tree[branch].made = made;
            let unknown = match left {
                Err(empty) => {
                    division.tree[branch].then = Then::Empty(Box::new(empty));
                    continue;
                }
                Ok(left) => match left {
                    Left::Followed { slack, .. } if slack <= FOLLOWED => {
                        division.kept.push(Kept { at, left, branch });
                        continue;
                    }
                    Left::Followed { widest, .. } | Left::Wide(widest) => widest,
                },
            };
            let Some((value, parts)) = self.divide(&at, unknown) else {
                division.followed = false;
                division.kept.push(Kept { at, left: Left::Wide(unknown), branch });
                continue;
            };
            let next = division.tree.len();
            division.tree[branch].then = Then::Divided { unknown, value, parts: [next, next + 1] };
            for part in parts {
                open.push((part, place(division)));
            }
        }
    }
}
