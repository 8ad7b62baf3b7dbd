//! Steps by whole motions to the second order, in frames along what the readings tell.

use std::rc::Rc;

use super::super::contract::Linear;
use super::super::frame::Frame;
use super::super::search::UNBROKEN;
use super::super::slanted::{STALE, Slanted};
use super::super::surface::Surface;
use super::prover::{HELPED, Next, Open, Prover, Widest};
use super::seek::{Caution, Found, Seek, Sought};
use super::{Axes, By, Step, shorten};
use crate::numeric::Interval;

const CAUTION: Caution = Caution { of_left: 0.1, of_slopes: 0.0 };

/// A box is followed as far as no more than this share of an error is in doubt.
const FAR: f64 = 0.5;

/// A box, its frame, and the readings over it.
struct Over {
    own: Frame,
    linear: Linear,
    surface: Rc<Surface>,
    at: Vec<Interval>,
}

impl Prover<'_> {
    /// By whole records to the second order in the box's frame, which is slanted at first. Else the coordinate of
    /// which too much is in doubt for that, or none without an enclosure.
    pub(super) fn slant(&mut self, here: &mut Open) -> Result<Next, Option<usize>> {
        let layout = &self.search.setup.layout;
        let Slanted { frame: mut own, surface, informed } =
            here.slanted.clone().unwrap_or_else(|| Slanted::straight(layout, &here.at));
        let mut at = here.at.clone();
        let (mut by, surface) = match surface {
            Some(surface) => (By::Same, surface),
            None => (By::Slanted(self.reach(here)), Rc::new(self.search.model.surface(&at, &own).ok_or(None)?)),
        };
        let before = (at.clone(), own.z.clone());
        let (mut linear, doubt) = surface.over(&own.z, &own.centre, informed);
        if doubt.slack > UNBROKEN {
            return Err(Some(doubt.widest));
        }
        match self.sides(&linear, &own, &at) {
            Found::Excluded(rows, _) => {
                self.push(Step::Exclude { by, rows });
                return Ok(Next::Excluded);
            }
            Found::Cuts(cuts) if cuts.is_empty() => {}
            Found::Cuts(cuts) => {
                here.at.clone_from(&at);
                here.slanted = Some(Slanted { frame: own.clone(), surface: Some(surface.clone()), informed });
                if self.take(by, Found::Cuts(cuts), here) {
                    return Ok(Next::Excluded);
                }
                at.clone_from(&here.at);
                by = By::Same;
                if !own.meet(&mut at) {
                    self.push(Step::Keep);
                    return Ok(Next::Excluded);
                }
                (linear, _) = surface.over(&own.z, &own.centre, informed);
            }
        }
        let next = if informed {
            (surface.rest > STALE * doubt.slack).then(|| own.clone().moved(self.coordinates(&linear, &own)))
        } else {
            let errors = self.search.setup.records.iter().map(|readings| readings.error);
            Some(own.informed(&linear, errors.fold(f64::INFINITY, f64::min)))
        };
        if self.turn(by, Over { own, linear, surface, at }, next, here) {
            return Ok(Next::Excluded);
        }
        let z = here.slanted.as_ref().map_or(&before.1, |slanted| &slanted.frame.z);
        let narrowed = before.1.iter().zip(z).map(|(before, after)| after.width() / before.width());
        let helped =
            !informed || self.search.rest(&before.0, &here.at) < HELPED || narrowed.fold(1.0, f64::min) < HELPED;
        Ok(if helped { Next::Smaller } else { Next::Stuck(Widest::Coordinate(doubt.widest)) })
    }

    /// Contracts the box in the coordinates of the next frame, or of its own; whether nothing is left.
    fn turn(&mut self, by: By, over: Over, next: Option<Frame>, here: &mut Open) -> bool {
        let Over { own, linear, surface, at } = over;
        let frame = next.as_ref().map_or_else(|| own.clone(), |next| next.around(&at));
        let axes = next.is_some().then(|| axes(&frame));
        let mut slanted = Slanted { frame, surface: next.is_none().then_some(surface), informed: true };
        match self.turns(&linear, &own, &slanted.frame) {
            Found::Excluded(rows, _) => {
                self.push(Step::Exclude { by, rows });
                true
            }
            Found::Cuts(cuts) => {
                let empty = cuts.iter().any(|cut| !shorten(&mut slanted.frame.z, cut));
                if axes.is_some() || !cuts.is_empty() {
                    self.push(Step::Turn { by, frame: axes, cuts });
                    (here.at, here.slanted) = (at, Some(slanted));
                }
                empty
            }
        }
    }

    /// The records are followed further, about the middle of what is left.
    pub(super) fn raise(&mut self, here: &mut Open) -> Next {
        if self.narrow {
            return Next::Settled;
        }
        if !self.meet(here) {
            self.push(Step::Keep);
            return Next::Excluded;
        }
        let Some(Slanted { frame: own, surface, .. }) = here.slanted.clone() else { return Next::Smaller };
        let next = own.clone().moved(own.z.clone());
        here.level = self.further(here, &next);
        if let Some(surface) = surface {
            let at = here.at.clone();
            let (linear, _) = surface.over(&own.z, &own.centre, true);
            if self.turn(By::Same, Over { own, linear, surface, at }, Some(next), here) {
                return Next::Excluded;
            }
        }
        Next::Smaller
    }

    /// The furthest level at which little is in doubt in a frame, or the next.
    fn further(&mut self, here: &Open, frame: &Frame) -> usize {
        let (next, frame) = (here.level + 1, frame.around(&here.at));
        let far = (next + 1..self.reaches.len()).rev().find(|level| {
            self.search.model.reach = self.reaches[*level];
            let surface = self.search.model.surface(&here.at, &frame);
            surface.is_some_and(|surface| surface.over(&frame.z, &frame.centre, true).1.slack <= FAR)
        });
        far.unwrap_or(next)
    }

    fn seek<'s>(&'s self, linear: &'s Linear) -> Seek<'s> {
        let all: Vec<usize> = (0..linear.deviations.len()).collect();
        Seek::new(self.search.setup, linear, &all, CAUTION)
    }

    /// Cuts of the unknowns that a frame has.
    fn sides(&self, linear: &Linear, own: &Frame, at: &[Interval]) -> Found {
        let seek = self.seek(linear);
        let sought = own.places.iter().enumerate();
        let sought = sought.map(|(row, place)| (*place, at[*place], seek.combination(&own.unknown(row), own)));
        seek.collect(sought, |place| self.face(place))
    }

    /// Cuts of the coordinates of another frame about the same box.
    fn turns(&self, linear: &Linear, own: &Frame, next: &Frame) -> Found {
        let seek = self.seek(linear);
        let turned = own.turned(next);
        let sought = turned.iter().enumerate();
        let sought = sought.map(|(row, affine)| (row, next.z[row], seek.combination(affine, own)));
        seek.collect(sought, |_| None)
    }

    /// What the inequalities leave of a frame's own coordinates.
    fn coordinates(&self, linear: &Linear, own: &Frame) -> Vec<Interval> {
        let seek = self.seek(linear);
        let left = own.turned(own).into_iter().zip(&own.z).map(|(affine, z)| match seek.combination(&affine, own) {
            Some(Sought::Range([(low, _), (high, _)])) => {
                Interval::new(low, high).and_then(|range| range.intersection(*z)).unwrap_or(*z)
            }
            _ => *z,
        });
        left.collect()
    }
}

/// A frame's as the file has them.
fn axes(frame: &Frame) -> Axes {
    Axes { centre: frame.places.iter().map(|place| frame.centre[*place]).collect(), lower: frame.lower.clone() }
}
