//! Division of the search box until every part is empty or as small as it needs to be.

use super::field::Term;
use super::search::{Empty, Left, Made, Search};
use crate::numeric::Interval;

/// A box is not divided further where the slopes' ranges take less than this of the readings' error.
const FINE: f64 = 0.003;
/// Divisions of a slice that is to be cut off.
const MOST_OF_A_SLICE: usize = 6;
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

    /// Cuts boxes left at a value of an unknown, and works off what is beyond it.
    pub(super) fn shave(&mut self, division: &mut Division, unknown: usize, upper: bool, value: f64, budget: usize) {
        let mut beyond = Vec::new();
        for index in (0..division.kept.len()).rev() {
            let side = division.kept[index].at[unknown];
            if !(side.lower() < value && value < side.upper()) {
                // All of it is beyond, or nothing.
                let all = if upper { side.lower() >= value } else { side.upper() <= value };
                if all {
                    beyond.push(division.kept.swap_remove(index));
                }
                continue;
            }
            let halves = [Interval::new(side.lower(), value), Interval::new(value, side.upper())];
            let [Some(low), Some(high)] = halves else { continue };
            let mut kept = division.kept.swap_remove(index);
            let next = division.tree.len();
            let parts = [next, next + 1];
            division.tree[kept.branch].then = Then::Divided { unknown, value, parts };
            division.tree.extend([(); 2].map(|()| Branch { made: Vec::new(), then: Then::Left }));
            let mut outer = kept.clone();
            let (near, far) = if upper { (low, high) } else { (high, low) };
            (kept.at[unknown], outer.at[unknown]) = (near, far);
            (kept.branch, outer.branch) = (parts[usize::from(!upper)], parts[usize::from(upper)]);
            division.kept.push(kept);
            beyond.push(outer);
        }
        self.work_off(division, beyond, budget);
    }

    /// Contracts and divides boxes that are near the end of a parameter's range, each a few times.
    fn work_off(&mut self, division: &mut Division, mut open: Vec<Kept>, budget: usize) {
        let mut divided = 0;
        while let Some(mut kept) = open.pop() {
            if self.passes >= budget {
                division.kept.push(kept);
                continue;
            }
            let mut made = Vec::new();
            let left = self.contract_fine(&mut kept.at, &mut made);
            division.tree[kept.branch].made.append(&mut made);
            match left {
                Err(empty) => {
                    division.tree[kept.branch].then = Then::Empty(Box::new(empty));
                    continue;
                }
                Ok(left) => kept.left = left,
            }
            let Left::Followed { slack, widest } = kept.left else {
                division.kept.push(kept);
                continue;
            };
            if slack < FINE || divided >= MOST_OF_A_SLICE {
                division.kept.push(kept);
                continue;
            }
            let Some((value, parts)) = self.divide(&kept.at, widest) else {
                division.kept.push(kept);
                continue;
            };
            divided += 1;
            let next = division.tree.len();
            division.tree[kept.branch].then = Then::Divided { unknown: widest, value, parts: [next, next + 1] };
            for (at, branch) in parts.into_iter().zip(next..) {
                division.tree.push(Branch { made: Vec::new(), then: Then::Left });
                open.push(Kept { at, left: kept.left, branch });
            }
        }
    }

    /// Contracts what is left once more.
    pub(super) fn contract_kept(&mut self, division: &mut Division) {
        let boxes: Vec<Kept> = division.kept.drain(..).collect();
        for mut kept in boxes {
            let mut made = Vec::new();
            let left = self.contract_fine(&mut kept.at, &mut made);
            division.tree[kept.branch].made.append(&mut made);
            match left {
                Err(empty) => division.tree[kept.branch].then = Then::Empty(Box::new(empty)),
                Ok(left) => {
                    kept.left = left;
                    division.kept.push(kept);
                }
            }
        }
    }

    /// Divides one of the boxes left; `false` where that would not help.
    fn divide_kept(&mut self, division: &mut Division, index: usize, budget: usize) -> bool {
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
