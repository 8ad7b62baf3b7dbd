//! Division of the search box until every part is empty or as small as it needs to be.

use std::collections::{BTreeMap, VecDeque};

use super::field::Term;
use super::search::{Empty, Left, Method, Search, UNBROKEN};
use super::slanted::{Slant, Slanted};
use crate::numeric::Interval;

mod further;
#[cfg(test)]
mod tests;

/// A box is not divided further where what is in doubt takes less than this of the readings' error.
const FINE: f64 = 1e-5;
/// Divisions of the halves of one box that is left, at once.
const MOST_OF_A_BOX: usize = 6;
/// A slice that is drawn in by less than this of its width is divided.
const DRAWN: f64 = 0.2;
/// Boxes excluded last that are remembered: there the contradiction is shown, and the nearest parameter looked for.
const REMEMBERED: usize = 4;
/// A box stands for what is left once less than this of a reading's error is in doubt.
const FOLLOWED: f64 = 0.7;
/// Else whole records are tried where less than this is in doubt of their windows, and less than the second in a straight frame, where
/// most may be due to the records' beginnings, which the readings tell.
const NEARLY: f64 = 5.0;
const STRAIGHT: f64 = 10.0;

/// A box that is left.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    pub(super) at: Vec<Interval>,
    pub(super) left: Left,
    /// The slanted box that it is in, once that is known.
    pub(super) slanted: Option<Slanted>,
}

impl Kept {
    /// A box of which nothing is known yet.
    pub(super) fn new(at: Vec<Interval>) -> Self {
        Self { at, left: Left::Wide(0), slanted: None }
    }
}

/// A box that is not looked at yet.
struct Part {
    at: Vec<Interval>,
    /// Whether the motion was not followed over what it is a part of. Where it was, the readings' speeds tell little besides.
    wide: bool,
}

/// Boxes of which the widest comes first: what is left when the budget is spent is no wider than need be.
#[derive(Default)]
struct Queue {
    /// By width and number: nonnegative floats have the order of their bits.
    parts: BTreeMap<(u64, usize), Part>,
    pushed: usize,
}

impl Queue {
    fn push(&mut self, width: f64, part: Part) {
        self.parts.insert((width.to_bits(), self.pushed), part);
        self.pushed += 1;
    }

    fn pop(&mut self) -> Option<Part> {
        self.parts.pop_last().map(|(_, part)| part)
    }
}

/// One end of an unknown's range.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    pub(super) unknown: usize,
    pub(super) upper: bool,
}

impl End {
    /// Which way it is.
    pub(super) fn sign(self) -> f64 {
        if self.upper { 1.0 } else { -1.0 }
    }

    /// Where it is; of a lower end the negative, so that further is more.
    pub(super) fn of(self, at: &[Interval]) -> f64 {
        if self.upper { at[self.unknown].upper() } else { -at[self.unknown].lower() }
    }
}

impl Kept {
    /// Keeps what is beyond a value, towards the end; the rest, if there is any on either side of it.
    fn cut(&mut self, end: End, value: f64) -> Option<Self> {
        let side = self.at[end.unknown];
        let value = if end.upper { value } else { -value };
        if !(side.lower() < value && value < side.upper()) {
            return None;
        }
        let [low, high] = [Interval::new(side.lower(), value)?, Interval::new(value, side.upper())?];
        let mut rest = self.clone();
        (self.at[end.unknown], rest.at[end.unknown]) = if end.upper { (high, low) } else { (low, high) };
        Some(rest)
    }
}

/// The smallest box around all of these; `None` of none.
pub(super) fn around(boxes: impl IntoIterator<Item = Vec<Interval>>) -> Option<Vec<Interval>> {
    boxes.into_iter().reduce(|hull, at| hull.iter().zip(&at).map(|(a, b)| a.hull(*b)).collect())
}

/// What is left, and what was excluded last.
pub(super) struct Division {
    /// The last boxes that the motion excluded.
    pub(super) empties: VecDeque<Empty>,
    pub(super) kept: Vec<Kept>,
    /// Whether the budget sufficed to follow the motion over all that is left.
    pub(super) followed: bool,
}

impl Division {
    fn new() -> Self {
        Self { empties: VecDeque::new(), kept: Vec::new(), followed: true }
    }

    /// Notes a box in which nothing is; one that only its readings' speeds exclude shows no motion.
    fn exclude(&mut self, empty: Empty) {
        if empty.method == Method::Weigh || empty.linear.is_none() {
            return;
        }
        if self.empties.len() == REMEMBERED {
            self.empties.pop_front();
        }
        self.empties.push_back(empty);
    }

    /// With what another left and excluded.
    fn join(&mut self, other: Self) {
        other.empties.into_iter().for_each(|empty| self.exclude(empty));
        self.kept.extend(other.kept);
        self.followed &= other.followed;
    }

    /// The box that reaches furthest to an end, and how far.
    fn furthest(&self, end: End) -> Option<(usize, f64)> {
        let reached = self.kept.iter().enumerate().map(|(index, kept)| (index, end.of(&kept.at)));
        reached.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The box in which most is in doubt, and how much.
    fn coarsest(&self) -> Option<(usize, f64)> {
        let slack = |kept: &Kept| match kept.left {
            Left::Followed { slack, .. } => slack,
            Left::Wide(_) => 0.0,
        };
        let slacks = self.kept.iter().enumerate().map(|(index, kept)| (index, slack(kept)));
        slacks.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The smallest box around all that is left; `None` where nothing is.
    pub(super) fn hull(&self) -> Option<Vec<Interval>> {
        around(self.kept.iter().map(|kept| kept.at.clone()))
    }
}

impl Search<'_> {
    /// Divides a box at a parameter: the gain, whose orders of magnitude count, at the geometric mean.
    pub(super) fn divide(&self, at: &[Interval], unknown: usize) -> Option<[Vec<Interval>; 2]> {
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
        (side.lower() < value && value < side.upper()).then_some(parts)
    }

    /// Halves of a box that is left: along a coordinate of its frame, if it has one.
    fn divide_frame(&self, kept: &Kept, unknown: usize) -> Option<[Kept; 2]> {
        if let Some(slanted) = &kept.slanted {
            let halves = slanted.halves(unknown)?;
            return Some(halves.map(|half| Kept { slanted: Some(half), ..kept.clone() }));
        }
        let parts = self.divide(&kept.at, unknown)?;
        Some(parts.map(|at| Kept { at, left: kept.left, slanted: None }))
    }

    /// Everything in `at`, divided until the motion can be followed over each part that is left.
    pub(super) fn search(&mut self, at: Vec<Interval>, budget: usize) -> Division {
        let mut division = Division::new();
        self.refine(&mut division, vec![at], budget);
        division
    }

    /// Goes on where a budget was spent.
    pub(super) fn go_on(&mut self, division: &mut Division, budget: usize) {
        let kept = core::mem::take(&mut division.kept).into_iter();
        let (open, done) = kept.partition(|kept| matches!(kept.left, Left::Wide(_)));
        (division.kept, division.followed) = (done, true);
        self.refine(division, open.into_iter().map(|kept: Kept| kept.at).collect(), budget);
    }

    /// Works off what reaches beyond a value of an unknown, from the furthest: a slice of the box that reaches furthest is contracted,
    /// and divided where it stays. The box that stays furthest though what is in doubt takes no more than `fine` of the readings' errors
    /// is returned.
    pub(super) fn draw_in(
        &mut self,
        division: &mut Division,
        end: End,
        value: f64,
        fine: f64,
        budget: usize,
    ) -> Option<Kept> {
        while self.passes < budget {
            let (index, furthest) = division.furthest(end)?;
            if furthest <= value {
                return None;
            }
            let mut kept = division.kept.swap_remove(index);
            if let Some(rest) = kept.cut(end, value) {
                division.kept.push(rest);
            }
            let width = kept.at[end.unknown].width();
            match self.contract_fine(&mut kept.at, &mut kept.slanted) {
                Err(empty) => {
                    division.exclude(empty);
                    continue;
                }
                Ok(left) => kept.left = left,
            }
            if furthest - end.of(&kept.at) > DRAWN * width {
                division.kept.push(kept);
                continue;
            }
            let parts = match kept.left {
                Left::Followed { slack, widest } if slack > fine => self.divide_frame(&kept, widest),
                _ => None,
            };
            match parts {
                Some(parts) => division.kept.extend(parts),
                None => {
                    division.kept.push(kept.clone());
                    return Some(kept);
                }
            }
        }
        None
    }

    /// Contracts boxes, and divides them a few times.
    fn work_off(&mut self, division: &mut Division, mut open: Vec<Kept>, budget: usize) {
        let mut divided = 0;
        while let Some(mut kept) = open.pop() {
            if self.passes >= budget {
                division.kept.push(kept);
                continue;
            }
            match self.contract_fine(&mut kept.at, &mut kept.slanted) {
                Err(empty) => {
                    division.exclude(empty);
                    continue;
                }
                Ok(left) => kept.left = left,
            }
            let Left::Followed { slack, widest } = kept.left else {
                division.kept.push(kept);
                continue;
            };
            if slack < FINE || divided >= MOST_OF_A_BOX {
                division.kept.push(kept);
                continue;
            }
            let Some(parts) = self.divide_frame(&kept, widest) else {
                division.kept.push(kept);
                continue;
            };
            divided += 1;
            open.extend(parts);
        }
    }

    /// Contracts what is left once more.
    pub(super) fn contract_kept(&mut self, division: &mut Division) {
        let boxes = core::mem::take(&mut division.kept);
        self.contract_all(division, boxes);
    }

    fn contract_all(&mut self, division: &mut Division, boxes: Vec<Kept>) {
        for mut kept in boxes {
            match self.contract_fine(&mut kept.at, &mut kept.slanted) {
                Err(empty) => division.exclude(empty),
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
        let Some(parts) = self.divide_frame(&division.kept[index], widest) else { return false };
        division.kept.swap_remove(index);
        if parts[0].slanted.is_some() {
            self.work_off(division, parts.into(), budget);
        } else {
            self.refine(division, parts.into_iter().map(|part| part.at).collect(), budget);
        }
        true
    }

    /// Divides the box left in which most is in doubt; `false` where there is none that this would help.
    pub(super) fn divide_coarsest(&mut self, division: &mut Division, budget: usize) -> bool {
        division.coarsest().is_some_and(|(index, _)| self.divide_kept(division, index, budget))
    }

    /// Halves the boxes in which most is in doubt until none leaves more than `coarse` of the readings' errors.
    pub(super) fn even_out(&mut self, division: &mut Division, coarse: f64, budget: usize) {
        while self.passes < budget {
            let coarsest = division.coarsest().filter(|(_, slack)| *slack > coarse);
            let Some((index, _)) = coarsest else { return };
            let Left::Followed { widest, .. } = division.kept[index].left else { return };
            let Some(halves) = self.divide_frame(&division.kept[index], widest) else { return };
            division.kept.swap_remove(index);
            self.contract_all(division, halves.into());
        }
    }

    /// What whole records leave of a box in a frame along what they tell, where little is in doubt of them so; `slack` is of their windows.
    fn unbroken(&mut self, at: &[Interval], slack: f64) -> Result<Option<Kept>, Empty> {
        let (mut at, mut slanted) = (at.to_vec(), None);
        if slack > NEARLY {
            return Ok(None);
        }
        let Slant::Contracted(_) = self.slant(&mut at, &mut slanted, STRAIGHT)? else { return Ok(None) };
        let Slant::Contracted(left) = self.slant(&mut at, &mut slanted, UNBROKEN)? else { return Ok(None) };
        Ok(Some(Kept { at, left, slanted }))
    }

    /// Works off a list of boxes.
    fn refine(&mut self, division: &mut Division, boxes: Vec<Vec<Interval>>, budget: usize) {
        let mut open = Queue::default();
        for at in boxes {
            open.push(self.widest(&at).0, Part { at, wide: true });
        }
        while let Some(Part { mut at, wide }) = open.pop() {
            if self.passes >= budget {
                division.followed = false;
                division.kept.push(Kept { at, left: Left::Wide(0), slanted: None });
                continue;
            }
            let left = match self.contract(&mut at, wide) {
                Ok(left) => left,
                Err(empty) => {
                    division.exclude(empty);
                    continue;
                }
            };
            let (unknown, slack) = match left {
                Left::Followed { slack, .. } if slack <= FOLLOWED => {
                    division.kept.push(Kept { at, left, slanted: None });
                    continue;
                }
                Left::Followed { slack, widest } => (widest, slack),
                Left::Wide(widest) => (widest, f64::INFINITY),
            };
            match self.unbroken(&at, slack) {
                Err(empty) => {
                    division.exclude(empty);
                    continue;
                }
                Ok(Some(kept)) => {
                    division.kept.push(kept);
                    continue;
                }
                Ok(None) => {}
            }
            match self.divide(&at, unknown) {
                Some(parts) => {
                    for at in parts {
                        open.push(self.widest(&at).0, Part { at, wide: slack.is_infinite() });
                    }
                }
                None => {
                    division.followed = false;
                    division.kept.push(Kept { at, left: Left::Wide(unknown), slanted: None });
                }
            }
        }
    }
}
