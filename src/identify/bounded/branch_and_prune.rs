//! Branch and prune (Van Hentenryck, McAllester and Kapur, *SIAM Journal on Numerical Analysis* 34, 1997): boxes are contracted and divided
//! until each is empty or small.

#[cfg(test)]
mod tests;

use super::contraction::{ConstraintKind, Contracted, Contractor, Empty};
use super::vector_field::FieldTerm;
use crate::numeric::Interval;

/// A box is kept, or followed further, once its inequalities are uncertain by less than this share of a reading's largest error.
pub(super) const KEPT: f64 = 0.7;
/// A box is not divided below this uncertainty: the bounds then depend on the readings alone.
pub(super) const FINEST: f64 = 1e-5;

/// A remaining box.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    pub(super) at: Vec<Interval>,
    pub(super) contracted: Contracted,
}

impl Kept {
    fn uncertainty(&self) -> f64 {
        match self.contracted {
            Contracted::Followed { uncertainty, .. } => uncertainty,
            Contracted::Wide(_) => 0.0,
        }
    }
}

/// An open box.
struct OpenBox {
    at: Vec<Interval>,
    /// How wide it is, by [`Contractor::widest`].
    width: f64,
    /// Whether it is contracted by modulating functions: not where the motion was followed over the box that it is a part of.
    modulating: bool,
}

/// Takes the widest box, the latest of several: when the budget is spent no box is wider than necessary.
fn take_widest(open: &mut Vec<OpenBox>) -> Option<OpenBox> {
    let widest = (0..open.len()).max_by(|a, b| open[*a].width.total_cmp(&open[*b].width))?;
    Some(open.remove(widest))
}

/// An end of the range of an unknown.
#[derive(Clone, Copy, Debug)]
pub(super) struct RangeEnd {
    pub(super) unknown: usize,
    pub(super) upper: bool,
}

impl RangeEnd {
    pub(super) fn sign(self) -> f64 {
        if self.upper { 1.0 } else { -1.0 }
    }

    /// The value of the end; of a lower end the negative value.
    pub(super) fn of(self, at: &[Interval]) -> f64 {
        if self.upper { at[self.unknown].upper() } else { -at[self.unknown].lower() }
    }
}

impl Kept {
    /// Keeps the part beyond a value, towards the end; the second part, if there is any.
    fn cut(&mut self, end: RangeEnd, value: f64) -> Option<Self> {
        let side = self.at[end.unknown];
        let value = if end.upper { value } else { -value };
        let [low, high] = halves(side, value)?;
        let mut rest = self.clone();
        (self.at[end.unknown], rest.at[end.unknown]) = if end.upper { (high, low) } else { (low, high) };
        Some(rest)
    }
}

/// A range in two at a value inside it.
pub(super) fn halves(side: Interval, value: f64) -> Option<[Interval; 2]> {
    let inside = side.lower() < value && value < side.upper();
    inside.then_some([Interval::new(side.lower(), value)?, Interval::new(value, side.upper())?])
}

/// The smallest box that contains all of these; `None` of none.
pub(super) fn hull(boxes: impl IntoIterator<Item = Vec<Interval>>) -> Option<Vec<Interval>> {
    boxes.into_iter().reduce(|hull, at| hull.iter().zip(&at).map(|(a, b)| a.hull(*b)).collect())
}

/// The remaining boxes, and the last empty box with a contradiction of its readings.
pub(super) struct Division {
    pub(super) last_empty: Option<Empty>,
    pub(super) kept: Vec<Kept>,
    /// Whether the motion was followed over every remaining box.
    pub(super) complete: bool,
}

impl Division {
    /// Notes an empty box, where its motion shows a contradiction.
    fn exclude(&mut self, empty: Empty) {
        if empty.method == ConstraintKind::Shooting && empty.relaxation.is_some() {
            self.last_empty = Some(empty);
        }
    }

    /// The box with most by a measure, and the measure.
    fn most(&self, measure: impl Fn(&Kept) -> f64) -> Option<(usize, f64)> {
        let all = self.kept.iter().enumerate().map(|(index, kept)| (index, measure(kept)));
        all.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The smallest box that contains all remaining boxes; `None` where nothing is.
    pub(super) fn hull(&self) -> Option<Vec<Interval>> {
        hull(self.kept.iter().map(|kept| kept.at.clone()))
    }
}

impl Contractor {
    /// The halves of a box; gain and lag rate, which are searched over decades, are divided at the geometric mean.
    pub(super) fn bisect(&self, at: &[Interval], unknown: usize) -> Option<[Vec<Interval>; 2]> {
        let side = at[unknown];
        let geometric = matches!(self.problem.unknowns.terms.get(unknown), Some(FieldTerm::Gain | FieldTerm::LagRate));
        let positive = side.lower() > 0.0;
        let value = if geometric && positive { libm::sqrt(side.lower() * side.upper()) } else { side.midpoint() };
        let parts = halves(side, value)?.map(|half| {
            let mut part = at.to_vec();
            part[unknown] = half;
            part
        });
        Some(parts)
    }

    /// A box contracted and divided until the motion is followed over each remaining box, or the budget is spent.
    pub(super) fn prune(&mut self, whole: Vec<Interval>, budget: usize) -> Division {
        let mut division = Division { last_empty: None, kept: Vec::new(), complete: true };
        let mut open = vec![OpenBox { at: whole, width: f64::INFINITY, modulating: true }];
        while let Some(OpenBox { mut at, modulating, .. }) = take_widest(&mut open) {
            if self.passes() >= budget {
                division.complete = false;
                division.kept.push(Kept { at, contracted: Contracted::Wide(0) });
                continue;
            }
            let contracted = match self.contract(&mut at, modulating) {
                Ok(contracted) => contracted,
                Err(empty) => {
                    division.exclude(empty);
                    continue;
                }
            };
            let (unknown, modulating) = match contracted {
                Contracted::Followed { uncertainty, .. } if uncertainty <= KEPT => {
                    division.kept.push(Kept { at, contracted });
                    continue;
                }
                Contracted::Followed { widest, .. } => (widest, false),
                Contracted::Wide(widest) => (widest, true),
            };
            let Some(parts) = self.bisect(&at, unknown) else {
                division.complete = false;
                division.kept.push(Kept { at, contracted: Contracted::Wide(unknown) });
                continue;
            };
            open.extend(parts.map(|at| OpenBox { width: self.widest(&at).0, at, modulating }));
        }
        division
    }

    /// Contracts boxes by shooting, and keeps those that are not empty.
    fn keep(&mut self, division: &mut Division, boxes: impl IntoIterator<Item = Vec<Interval>>) {
        for mut at in boxes {
            match self.contract(&mut at, false) {
                Err(empty) => division.exclude(empty),
                Ok(contracted) => division.kept.push(Kept { at, contracted }),
            }
        }
    }

    /// Bisects the box with the largest uncertainty, if that is above `coarse`; `false` where there is none to bisect.
    pub(super) fn bisect_coarsest(&mut self, division: &mut Division, coarse: f64) -> bool {
        let coarsest = division.most(Kept::uncertainty).filter(|(_, uncertainty)| *uncertainty > coarse.max(FINEST));
        let Some((index, _)) = coarsest else { return false };
        let Contracted::Followed { widest, .. } = division.kept[index].contracted else { return false };
        let Some(halves) = self.bisect(&division.kept[index].at, widest) else { return false };
        division.kept.swap_remove(index);
        self.keep(division, halves);
        true
    }

    /// Contracts the slice of the furthest box beyond a value of an end, and divides it where it stays, until no box extends beyond the
    /// value. A box that stays furthest, its uncertainty no more than `fine`, is returned.
    pub(super) fn shave(
        &mut self,
        division: &mut Division,
        end: RangeEnd,
        value: f64,
        fine: f64,
        budget: usize,
    ) -> Option<Vec<Interval>> {
        while self.passes() < budget {
            let (index, furthest) = division.most(|kept| end.of(&kept.at))?;
            if furthest <= value {
                return None;
            }
            let mut kept = division.kept.swap_remove(index);
            division.kept.extend(kept.cut(end, value));
            match self.contract(&mut kept.at, false) {
                Err(empty) => {
                    division.exclude(empty);
                    continue;
                }
                Ok(contracted) => kept.contracted = contracted,
            }
            if end.of(&kept.at) <= value {
                division.kept.push(kept);
                continue;
            }
            let parts = match kept.contracted {
                Contracted::Followed { uncertainty, widest } if uncertainty > fine => self.bisect(&kept.at, widest),
                _ => None,
            };
            let Some(parts) = parts else {
                division.kept.push(kept.clone());
                return Some(kept.at);
            };
            division.kept.extend(parts.map(|at| Kept { at, contracted: kept.contracted }));
        }
        None
    }
}
