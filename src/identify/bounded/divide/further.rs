//! What the records' beginnings leave, followed further and further: boxes in frames, to the second order.
//!
//! Over its beginning a record is linear enough for boxes that hold too much for all of it, and each reach leaves so little that the next
//! is, too: windows with states of their own are needed only where this fails.

use super::super::search::{Empty, Left, Search};
use super::super::slanted::{Slant, Slanted};
use super::{Division, Kept, around};
use crate::numeric::Interval;

#[cfg(test)]
mod tests;

/// A contraction that leaves more than this of every parameter's and of every coordinate's width did not help.
const HELPED: f64 = 0.6;
/// A box is contracted in its frame while no more than this of a reading's error is in doubt, and followed further once no more than
/// the second is.
const DOUBTED: f64 = 3.0;
const SURE: f64 = 0.7;
/// The same of a box whose frame was found with other readings, at first: states at the records' beginnings are as wide as few readings
/// leave them.
const LED: f64 = 30.0;
/// Halvings of a box, one after the other, that may come to nothing.
const MOST_HALVINGS: usize = 3;

/// A box at hand.
#[derive(Clone)]
struct Open {
    kept: Kept,
    /// Which of the reaches it is followed over.
    level: usize,
    /// Halvings since a contraction last helped.
    halvings: usize,
}

/// What became of it.
enum Next {
    /// It is to be contracted again.
    Again(Open),
    /// Halves along a coordinate of its frame.
    Halves([Open; 2]),
    /// It is as small as this reach makes it.
    Settled(Open),
    /// Frames are of no use.
    Broken(Vec<Interval>),
}

impl Open {
    fn new(kept: Kept) -> Self {
        Self { kept, level: 0, halvings: 0 }
    }

    fn informed(&self) -> bool {
        self.kept.slanted.as_ref().is_some_and(|slanted| slanted.informed)
    }

    /// The box's coordinates, of a frame that stays.
    fn coordinates(&self) -> Vec<Interval> {
        let own = self.kept.slanted.as_ref().filter(|slanted| slanted.informed);
        own.map(|slanted| slanted.frame.z.clone()).unwrap_or_default()
    }

    fn halve(self, coordinate: usize) -> Next {
        let halves = self.kept.slanted.as_ref().and_then(|slanted| slanted.halves(coordinate));
        let Some(halves) = halves.filter(|_| self.halvings < MOST_HALVINGS) else { return Next::Broken(self.kept.at) };
        let part = |slanted| Self {
            kept: Kept { slanted: Some(slanted), ..self.kept.clone() },
            halvings: self.halvings + 1,
            ..self
        };
        Next::Halves(halves.map(part))
    }

    /// To be followed over the next reach.
    fn raised(mut self) -> Self {
        self.kept.slanted = self.kept.slanted.map(Slanted::anew);
        Self { level: self.level + 1, halvings: 0, ..self }
    }
}

impl Search<'_> {
    /// What is in any of the boxes, over one reach after the other of every record; the last is to be all of it.
    pub(in super::super) fn follow_further(&mut self, boxes: Vec<Kept>, reaches: &[usize], budget: usize) -> Division {
        let mut division = Division::new();
        let mut open: Vec<Open> = boxes.into_iter().map(Open::new).collect();
        let mut level = 0;
        // By windows one box around them takes about as long as one after the other.
        while let Some(hull) = around(self.in_frames(&mut division, open, reaches, budget)) {
            level += 1;
            let whole = level + 1 >= reaches.len() || self.passes >= budget;
            self.model.reach = if whole { usize::MAX } else { reaches[level] };
            let mut by_windows = Division::new();
            self.refine(&mut by_windows, vec![hull], budget);
            open = if whole { Vec::new() } else { core::mem::take(&mut by_windows.kept) }
                .into_iter()
                .map(|kept| Open { kept, level, halvings: 0 })
                .collect();
            division.join(by_windows);
        }
        self.model.reach = usize::MAX;
        division
    }

    /// The same as far as frames are of use; the boxes over which they are of none.
    fn in_frames(
        &mut self,
        division: &mut Division,
        mut open: Vec<Open>,
        reaches: &[usize],
        budget: usize,
    ) -> Vec<Vec<Interval>> {
        let mut broken: Vec<Vec<Interval>> = Vec::new();
        while let Some(here) = open.pop() {
            if self.passes >= budget {
                broken.push(here.kept.at);
                continue;
            }
            self.model.reach = reaches[here.level];
            match self.narrow(here) {
                Err(empty) => division.exclude(empty),
                Ok(Next::Again(here)) => open.push(here),
                Ok(Next::Halves(halves)) => open.extend(halves),
                Ok(Next::Settled(here)) if here.level + 1 == reaches.len() => division.kept.push(here.kept),
                Ok(Next::Settled(here)) => open.push(here.raised()),
                Ok(Next::Broken(at)) => broken.push(at),
            }
        }
        broken
    }

    /// One contraction in the box's frame.
    fn narrow(&mut self, mut here: Open) -> Result<Next, Empty> {
        let (informed, before, coordinates) = (here.informed(), here.kept.at.clone(), here.coordinates());
        let led = informed && matches!(here.kept.left, Left::Wide(_));
        let left = match self.slant(&mut here.kept.at, &mut here.kept.slanted, if led { LED } else { DOUBTED })? {
            Slant::Contracted(left) => left,
            Slant::Doubtful { slanted, widest } if informed => {
                here.kept.slanted = Some(slanted);
                return Ok(here.halve(widest));
            }
            Slant::Doubtful { .. } | Slant::NoEnclosure => return Ok(Next::Broken(here.kept.at)),
        };
        here.kept.left = left;
        let narrowed = coordinates.iter().zip(here.coordinates()).map(|(before, after)| after.width() / before.width());
        let rest = narrowed.fold(self.rest(&before, &here.kept.at), f64::min);
        Ok(match left {
            _ if rest < HELPED => Next::Again(Open { halvings: 0, ..here }),
            _ if !informed => Next::Again(here),
            Left::Followed { slack, widest } if slack > SURE => here.halve(widest),
            _ => Next::Settled(here),
        })
    }
}
