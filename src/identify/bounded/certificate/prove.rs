//! A stage's steps that are cheap to check, once it is known what is left.

use super::super::setup::{PROVED, Setup};
use super::prover::Prover;
use super::{Certificate, Stage, Unproved};
use crate::numeric::Interval;

/// What is left is given wider than it was found by one of these shares, on either side, by the last with which the check is cheap: room
/// for other enclosures than those of the search, and fewer boxes.
const ROOMS: [f64; 6] = [8.0, 2.0, 1.0, 0.5, 0.25, 0.1];
/// A check is cheap that costs no more than so many motions over whole records to the second order, or than this share of the search's
/// passes; or than this many times as much as with the most room.
const FEW: f64 = 2.5;
const CHEAP: f64 = 0.05;
const DEARER: f64 = 1.5;

/// What a stage is to leave.
pub(super) enum Goal<'a> {
    /// What the beginnings leave.
    Narrow,
    /// This, with some room around.
    Within(&'a [Interval]),
    Nothing,
}

impl Certificate {
    /// The steps from the box of `setup`, a part of the `wide` one, to the goal, which took a search so many `passes`; this certificate accepts them.
    ///
    /// # Errors
    /// [`Unproved::NotFound`] where they are too many.
    pub(super) fn stage(
        &self,
        wide: &Setup,
        setup: &Setup,
        beginnings: Option<&Setup>,
        goal: &Goal<'_>,
        passes: usize,
    ) -> Result<Stage, Unproved> {
        let opened = beginnings.map_or_else(|| setup.clone(), |beginnings| setup.opened(beginnings));
        let (beginning, all) = (beginnings.unwrap_or(&opened).most_windows(), opened.most_windows());
        let longer = |reach: &usize| Some(2 * reach - beginning + PROVED.swings).filter(|longer| *longer < all);
        let mut reaches: Vec<usize> =
            core::iter::successors(Some(beginning), longer).filter(|reach| *reach < all).collect();
        reaches.push(all);
        let early = Setup {
            records: beginnings.map_or_else(|| setup.records.clone(), |beginnings| beginnings.records.clone()),
            ..opened.clone()
        };
        let rooms = match goal {
            Goal::Within(_) => &ROOMS[..],
            // There is nothing to widen.
            Goal::Narrow | Goal::Nothing => &ROOMS[..1],
        };
        let mut enough = f64::INFINITY;
        let mut last = Err(Unproved::NotFound { steps: 0 });
        for room in rooms {
            let found = Prover::of(&opened, &early, &reaches, goal, *room, enough).stage();
            let found = found.and_then(|(stage, spent)| self.accepts(wide, &stage).map(|()| (stage, spent)));
            match found {
                Ok((stage, spent)) if last.is_err() => {
                    enough = (CHEAP * passes as f64).max(FEW).max(DEARER * spent);
                    last = Ok(stage);
                }
                Ok((stage, _)) => last = Ok(stage),
                Err(error) => {
                    // With less room it takes more steps.
                    last = last.or(Err(error));
                    break;
                }
            }
        }
        last
    }
}
