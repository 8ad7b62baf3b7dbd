//! Contraction of slanted boxes, by what the readings are over them to the second order.

use std::rc::Rc;

use super::contract::{Linear, Model, Span};
use super::divide::Kept;
use super::frame::{Affine, Frame, dot};
use super::lp::{Multipliers, Outcome, Programme};
use super::mix::Mix;
use super::problem::Layout;
use super::rows::Starts;
use super::search::{Empty, Left, Method, Search};
use super::surface::{Doubt, Surface};
use super::trajectory::{Node, Unknowns};
use crate::numeric::Interval;

/// A motion is followed anew where what is of the third order takes more than this of what is in doubt.
pub(super) const STALE: f64 = 0.25;

impl Model<'_> {
    /// The motion over a whole record, and how it differs from that of the frame's centre by each coordinate.
    pub(super) fn slanted(&self, span: Span, at: &[Interval], frame: &Frame, mixes: &[Mix]) -> Option<Vec<Node>> {
        self.follow(span, at, &frame.centre, Unknowns { mixes, deviations: &frame.z, bending: true }, &self.times(span))
    }
}

impl Linear {
    /// An upper bound of what an objective's multipliers show, as `most` makes one of them.
    fn shown(
        &self,
        programme: &Programme,
        objective: &[(usize, f64)],
        most: impl Fn(&Multipliers) -> f64,
    ) -> Result<f64, Multipliers> {
        match programme.maximise(objective) {
            Outcome::Empty { multipliers } if self.rows.upper_bound(&[], &multipliers, &self.deviations) < 0.0 => {
                Err(multipliers)
            }
            Outcome::Empty { .. } => Ok(f64::INFINITY),
            Outcome::Bounded { multipliers, .. } => Ok(most(&multipliers)),
        }
    }

    /// What the rows leave of a combination of the unknowns; with the multipliers that contradict it, of nothing.
    pub(super) fn range(&self, programme: &Programme, parts: &[(usize, f64)]) -> Result<Interval, Multipliers> {
        let end = |sign: f64| {
            let objective: Vec<(usize, f64)> = parts.iter().map(|(index, weight)| (*index, sign * weight)).collect();
            self.shown(programme, &objective, |rows| self.rows.upper_bound(&objective, rows, &self.deviations))
        };
        let range =
            Interval::new(-end(-1.0)?, end(1.0)?).and_then(|range| range.intersection(dot(parts, &self.deviations)));
        range.ok_or_else(Multipliers::new)
    }

    /// The same of a combination of a frame's coordinates.
    fn range_of(&self, programme: &Programme, affine: &Affine, own: &Frame) -> Result<Interval, Multipliers> {
        let end = |sign: f64| self.shown(programme, &affine.objective(sign), |rows| affine.most(sign, own, self, rows));
        let range = Interval::new(-end(-1.0)?, end(1.0)?).and_then(|range| range.intersection(affine.over(&own.z)));
        range.ok_or_else(Multipliers::new)
    }

    /// What they leave of the coordinates of another frame.
    fn turned(&self, programme: &Programme, own: &Frame, next: &Frame) -> Result<Vec<Interval>, Multipliers> {
        own.turned(next).iter().map(|affine| self.range_of(programme, affine, own)).collect()
    }
}

/// A box in a frame, with what the readings are over it once that is known.
#[derive(Clone, Debug)]
pub(super) struct Slanted {
    pub(super) frame: Frame,
    pub(super) surface: Option<Rc<Surface>>,
    /// Whether the frame is along what the readings tell.
    pub(super) informed: bool,
}

impl Slanted {
    /// A box along the axes, of which nothing is known yet.
    pub(super) fn straight(layout: &Layout, at: &[Interval]) -> Self {
        Self { frame: Frame::straight(layout.of_whole(), at), surface: None, informed: false }
    }

    /// About the middle of what is left, to be followed anew.
    pub(super) fn anew(self) -> Self {
        let z = self.frame.z.clone();
        Self { frame: self.frame.moved(z), surface: None, ..self }
    }

    /// Halves along a coordinate.
    pub(super) fn halves(&self, unknown: usize) -> Option<[Self; 2]> {
        Some(self.frame.halves(unknown)?.map(|frame| Self { frame, ..self.clone() }))
    }

    #[cfg(test)]
    pub(super) fn holds(&self, point: &[f64], share: f64) -> bool {
        self.frame.holds(point, share)
    }
}

/// What came of a contraction in a frame.
pub(super) enum Slant {
    /// What is in the box and in its frame, which were handed over.
    Contracted(Left),
    /// Nothing: more is in doubt than was allowed, most of it by this coordinate of the frame.
    Doubtful { slanted: Slanted, widest: usize },
    /// Nothing either.
    NoEnclosure,
}

/// What a box that is left says of the readings, as inequalities; and how its unknowns make up parameters.
pub(super) struct Held {
    pub(super) linear: Linear,
    programme: Programme,
    /// Along which the unknowns are, about their middle; none for unknowns of the model.
    frame: Option<Frame>,
}

impl Held {
    fn new(linear: Linear, frame: Option<Frame>) -> Self {
        let places: Vec<usize> = (0..linear.deviations.len()).collect();
        let programme = linear.programme(&places);
        Self { linear, programme, frame }
    }

    /// What a combination of parameters can be; `None` where the inequalities leave nothing.
    pub(super) fn combination(&self, parts: &[(usize, f64)]) -> Option<Interval> {
        let centre = |place: usize| Interval::point(self.linear.centre[place]);
        let at_centre = Interval::dot(parts.iter().map(|(place, factor)| (Interval::point(*factor), centre(*place))));
        let Some(frame) = &self.frame else {
            return Some(at_centre + self.linear.range(&self.programme, parts).ok()?);
        };
        self.linear.range_of(&self.programme, &frame.combination(parts)?, frame).ok()
    }
}

impl Search<'_> {
    /// The readings over a box that is left. `None` where there is no enclosure.
    pub(super) fn held(&mut self, kept: &Kept) -> Option<Held> {
        if let Some(Slanted { frame, surface, .. }) = &kept.slanted {
            let surface = surface.clone().or_else(|| {
                self.count_pass();
                self.model.surface(&kept.at, frame).map(Rc::new)
            });
            if let Some(surface) = surface {
                let (linear, _) = surface.over(&frame.z, &frame.centre, false);
                return Some(Held::new(linear, Some(frame.clone())));
            }
        }
        let mut at = kept.at.clone();
        let centre: Vec<f64> = at.iter().map(|side| side.midpoint()).collect();
        Some(Held::new(self.chained(&mut at, centre, Starts::Given).ok().flatten()?, None))
    }

    /// One contraction over records, as far as they are followed, in a frame, which is slanted at first. No frame is left where what is
    /// in doubt is more than `most` of the readings' error, or there is no enclosure.
    pub(super) fn slant(
        &mut self,
        at: &mut [Interval],
        slanted: &mut Option<Slanted>,
        most: f64,
    ) -> Result<Slant, Empty> {
        let Slanted { frame: mut own, surface, informed } =
            slanted.take().unwrap_or_else(|| Slanted::straight(&self.setup.layout, at));
        let parted = || Empty { method: Method::Whole, multipliers: Vec::new(), linear: None };
        if !own.meet(at) {
            return Err(parted());
        }
        let surface = match surface {
            Some(surface) => {
                self.count_part();
                surface
            }
            None => {
                self.count_pass();
                let Some(mut surface) = self.model.surface(at, &own) else { return Ok(Slant::NoEnclosure) };
                if informed {
                    surface.prune(&own.z);
                }
                Rc::new(surface)
            }
        };
        let (linear, Doubt { slack, widest }) = surface.over(&own.z, &own.centre, informed);
        let stale = surface.rest > STALE * slack;
        if slack > most {
            let slanted = Slanted { frame: own, surface: (!stale).then_some(surface), informed };
            return Ok(Slant::Doubtful { slanted, widest });
        }
        let empty = |multipliers, linear: &Linear, at: &[Interval]| {
            let mut linear = linear.clone();
            linear.deviations = at.iter().zip(&linear.centre).map(|(side, c)| *side - Interval::point(*c)).collect();
            Empty { method: Method::Whole, multipliers, linear: Some(linear) }
        };
        let unknowns: Vec<usize> = (0..linear.deviations.len()).collect();
        let programme = linear.programme(&unknowns);
        for (row, place) in own.places.iter().enumerate() {
            let side = linear.range_of(&programme, &own.unknown(row), &own).map_err(|rows| empty(rows, &linear, at))?;
            at[*place] = at[*place].intersection(side).ok_or_else(parted)?;
        }
        let next = if informed {
            own.z = linear.turned(&programme, &own, &own).map_err(|rows| empty(rows, &linear, at))?;
            let slanted = Slanted { frame: own, surface: Some(surface), informed };
            if stale { slanted.anew() } else { slanted }
        } else {
            let error = self.setup.records.iter().fold(f64::INFINITY, |least, readings| least.min(readings.error));
            let next = own.informed(&linear, error);
            let z = linear.turned(&programme, &own, &next).map_err(|rows| empty(rows, &linear, at))?;
            Slanted { frame: next.moved(z), surface: None, informed: true }
        };
        *slanted = Some(next);
        Ok(Slant::Contracted(Left::Followed { slack, widest }))
    }
}
