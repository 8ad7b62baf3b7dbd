//! The steps of a stage over its boxes: enclosures over those that are listed, and sums.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::super::contract::{Hat, Linear, Model, Origin};
use super::super::frame::{Affine, Frame};
use super::super::lp::Multipliers;
use super::super::problem::{Layout, Readings};
use super::super::rows::Starts;
use super::super::setup::Setup;
use super::super::surface::Surface;
use super::check::{malformed, model, sides, within};
use super::{Axes, By, Combination, Cut, Stage, Step, Unproved, shorten};
use crate::numeric::Interval;

/// Numbers that boxes at hand may hold together, so that no file takes more memory than this, however it divides.
const MOST_HELD: usize = 1 << 20;

/// What was done.
#[derive(Default)]
pub(super) struct Work {
    pub(super) excluded: usize,
    pub(super) enclosures: usize,
}

/// A stage with what its steps need.
pub(super) struct Walk<'a> {
    stage: &'a Stage,
    index: usize,
    setup: &'a Setup,
    layout: Layout,
    left: Option<Vec<Interval>>,
    from: Vec<Interval>,
    /// Readings that some step by whole motions names.
    heard: Option<Vec<BTreeSet<usize>>>,
}

/// A box at hand.
#[derive(Clone)]
struct Here {
    at: Vec<Interval>,
    frame: Option<Frame>,
    /// The readings to the second order over a box that holds this one, in the same frame.
    surface: Option<Rc<Surface>>,
}

impl Here {
    /// Numbers that it holds, but for what it shares with others.
    fn held(&self) -> usize {
        2 * self.at.len() + self.frame.as_ref().map_or(0, |frame| frame.places.len() * (frame.places.len() + 3))
    }
}

/// The inequalities over a box.
struct Enclosed {
    linear: Linear,
    places: BTreeMap<Origin, usize>,
    /// What the enclosure itself leaves of the box.
    direct: Vec<Interval>,
    /// Whose coordinates the inequalities are about; none for the unknowns.
    frame: Option<Frame>,
}

impl Enclosed {
    fn new(linear: Linear, direct: Vec<Interval>, frame: Option<Frame>) -> Self {
        let places = linear.origins.iter().enumerate().map(|(place, origin)| (*origin, place)).collect();
        Self { linear, places, direct, frame }
    }

    /// `None` where one is no multiplier or names no inequality.
    fn multipliers(&self, rows: &Combination) -> Option<Multipliers> {
        rows.iter()
            .map(|(origin, y)| {
                (*y >= 0.0 && y.is_finite()).then_some(())?;
                Some((*self.places.get(origin)?, *y))
            })
            .collect()
    }

    /// Whether the multipliers contradict each other.
    fn excludes(&self, rows: &Combination) -> bool {
        self.multipliers(rows)
            .is_some_and(|multipliers| self.linear.rows.upper_bound(&[], &multipliers, &self.linear.deviations) < 0.0)
    }

    /// Whether the end of a range follows.
    fn shows(&self, side: Interval, cut: &Cut) -> bool {
        let reached = |side: Interval| if cut.upper { side.upper() <= cut.end } else { side.lower() >= cut.end };
        if cut.rows.is_empty() {
            return reached(self.direct[cut.unknown]);
        }
        if let Some(frame) = &self.frame {
            let row = frame.places.iter().position(|place| *place == cut.unknown);
            return row.is_some_and(|row| self.shows_of(&frame.unknown(row), cut));
        }
        let sign = if cut.upper { 1.0 } else { -1.0 };
        let Some(multipliers) = self.multipliers(&cut.rows) else { return false };
        let bound = self.linear.rows.upper_bound(&[(cut.unknown, sign)], &multipliers, &self.linear.deviations);
        // Nothing left of the side is less than any end.
        !bound.is_nan() && self.linear.cut(side, cut.unknown, sign, bound).is_none_or(reached)
    }

    /// The same of a combination of the frame's coordinates.
    fn shows_of(&self, affine: &Affine, cut: &Cut) -> bool {
        let (Some(frame), Some(multipliers)) = (&self.frame, self.multipliers(&cut.rows)) else { return false };
        let sign = if cut.upper { 1.0 } else { -1.0 };
        affine.most(sign, frame, &self.linear, &multipliers) <= sign * cut.end
    }

    /// What is known of an unknown after a cut.
    fn learn(&mut self, unknown: usize, side: Interval) {
        if self.frame.is_none()
            && let Some(known) = self.linear.deviations.get_mut(unknown)
        {
            let cut = side - Interval::point(self.linear.centre[unknown]);
            *known = known.intersection(cut).unwrap_or(cut);
        }
    }
}

impl<'a> Walk<'a> {
    /// From a box of parameters.
    pub(super) fn of(setup: &'a Setup, from: &[[f64; 2]], stage: &'a Stage, index: usize) -> Result<Self, Unproved> {
        let malformed = |what: &str| malformed(&format!("{what} of stage {index}"));
        let from = sides(from).filter(|from| from.len() == setup.layout.parameters() && within(from, &setup.search));
        let mut from = from.ok_or_else(|| malformed("the box"))?;
        let delay_s = setup.layout.delay().map_or(setup.known_delay_s, |place| from[place]);
        let layout = stage.layout(setup, delay_s).ok_or_else(|| malformed("a window"))?;
        from.extend(layout.states(&setup.records, setup.fastest));
        let left = stage.left.as_ref().map(|left| sides(left).filter(|left| left.len() == layout.parameters()));
        let left = left.map(|left| left.ok_or_else(|| malformed("what is left"))).transpose()?;
        let mut walk = Self { stage, index, setup, layout, left, from, heard: None };
        walk.heard = walk.named(stage.steps.iter().flat_map(|step| match step {
            Step::Contract { by: By::Slanted(_) | By::Same, cuts } | Step::Turn { cuts, .. } => {
                cuts.iter().map(|cut| cut.rows.as_slice()).collect()
            }
            Step::Exclude { by: By::Slanted(_) | By::Same, rows } => vec![rows.as_slice()],
            _ => Vec::new(),
        }));
        Ok(walk)
    }

    /// The readings that combinations name, by record. Where stamps are unsure all are heard: the speed since the one before matters.
    fn named<'r>(&self, combinations: impl IntoIterator<Item = &'r [(Origin, f64)]>) -> Option<Vec<BTreeSet<usize>>> {
        if self.setup.records.iter().any(|readings| readings.jitter_s > 0.0) {
            return None;
        }
        let mut named = vec![BTreeSet::new(); self.setup.records.len()];
        for (origin, _) in combinations.into_iter().flatten() {
            if let Origin::Reading { window, sample, .. } = origin {
                let record = self.layout.windows().get(*window).map(|window| window.record);
                if let Some(named) = record.and_then(|record| named.get_mut(record)) {
                    named.insert(*sample);
                }
            }
        }
        Some(named)
    }

    pub(super) fn go(&self, work: &mut Work) -> Result<(), Unproved> {
        let mut open = vec![Here { at: self.from.clone(), frame: None, surface: None }];
        let mut held = open[0].held();
        for (step, what) in self.stage.steps.iter().enumerate() {
            let here = open.pop().ok_or(Unproved::Incomplete { stage: self.index })?;
            held -= here.held();
            let refused = |what| Unproved::Step { stage: self.index, step, what };
            let parts = self.step(here, what, work).map_err(refused)?;
            held += parts.iter().map(Here::held).sum::<usize>();
            if held > MOST_HELD {
                return Err(refused("too many boxes are left to deal with"));
            }
            open.extend(parts);
        }
        if open.is_empty() { Ok(()) } else { Err(Unproved::Incomplete { stage: self.index }) }
    }

    /// What a step leaves to deal with, the next box last; or what does not follow.
    fn step(&self, mut here: Here, what: &Step, work: &mut Work) -> Result<Vec<Here>, &'static str> {
        let at = &mut here.at;
        if !here.frame.as_mut().is_none_or(|frame| frame.meet(at)) {
            // Nothing is in it.
            return if matches!(what, Step::Keep) { Ok(Vec::new()) } else { Err("the box is empty") };
        }
        match what {
            Step::Keep => {
                if !self.left.as_ref().is_some_and(|left| within(&here.at[..left.len()], left)) {
                    return Err("the box is not within what is left");
                }
                Ok(Vec::new())
            }
            Step::Divide { unknown, at } => {
                let side = here.at.get(*unknown).copied();
                let [low, high] =
                    side.and_then(|side| halves(side, *at)).ok_or("the division is not within the box")?;
                let mut upper = here.clone();
                (here.at[*unknown], upper.at[*unknown]) = (low, high);
                Ok(vec![upper, here])
            }
            Step::Part { coordinate, at } => {
                let side = here.frame.as_ref().and_then(|frame| frame.z.get(*coordinate).copied());
                let [low, high] =
                    side.and_then(|side| halves(side, *at)).ok_or("the division is not within the box")?;
                let mut upper = here.clone();
                for (part, half) in [(&mut here, low), (&mut upper, high)] {
                    if let Some(frame) = &mut part.frame {
                        frame.z[*coordinate] = half;
                    }
                }
                Ok(vec![upper, here])
            }
            Step::Exclude { by, rows } => {
                let enclosed = self.enclosed(*by, &mut here, [rows.as_slice()], work)?;
                if enclosed.is_some_and(|enclosed| !enclosed.excludes(rows)) {
                    return Err("the box is not excluded");
                }
                work.excluded += 1;
                Ok(Vec::new())
            }
            Step::Contract { by, cuts } => {
                let enclosed = self.enclosed(*by, &mut here, cuts.iter().map(|cut| cut.rows.as_slice()), work)?;
                let Some(mut enclosed) = enclosed else { return Ok(Vec::new()) };
                for cut in cuts {
                    let side = here.at.get(cut.unknown).copied();
                    if !side.is_some_and(|side| enclosed.shows(side, cut)) {
                        return Err("the range is not that short");
                    }
                    if !shorten(&mut here.at, cut) {
                        work.excluded += 1;
                        return Ok(Vec::new());
                    }
                    enclosed.learn(cut.unknown, here.at[cut.unknown]);
                }
                Ok(vec![here])
            }
            Step::Turn { by, frame, cuts } => self.turn(here, *by, frame.as_ref(), cuts, work),
        }
    }

    /// The box in the coordinates of another frame, or of its own, and what cuts leave of these.
    fn turn(
        &self,
        mut here: Here,
        by: By,
        frame: Option<&Axes>,
        cuts: &[Cut],
        work: &mut Work,
    ) -> Result<Vec<Here>, &'static str> {
        if !matches!(by, By::Slanted(_) | By::Same) || frame.is_none() && here.frame.is_none() {
            return Err("there is no frame");
        }
        let enclosed = self.enclosed(by, &mut here, [], work)?;
        let Some((enclosed, own)) = enclosed.as_ref().and_then(|enclosed| Some((enclosed, enclosed.frame.as_ref()?)))
        else {
            return Err("there is no frame");
        };
        let mut next = own.clone();
        if let Some(axes) = frame {
            here.surface = None;
            next = self.frame(axes, &here.at, own).ok_or("there is no such frame")?;
        }
        let turned = own.turned(&next);
        for cut in cuts {
            if !turned.get(cut.unknown).is_some_and(|affine| enclosed.shows_of(affine, cut)) {
                return Err("the range is not that short");
            }
            if !shorten(&mut next.z, cut) {
                work.excluded += 1;
                return Ok(Vec::new());
            }
        }
        here.frame = Some(next);
        Ok(vec![here])
    }

    /// The frame that a file names, over a box.
    fn frame(&self, axes: &Axes, at: &[Interval], own: &Frame) -> Option<Frame> {
        let rows = own.places.len();
        let triangular = axes.lower.len() == rows && axes.lower.iter().enumerate().all(|(row, own)| own.len() == row);
        let finite = axes.centre.iter().chain(axes.lower.iter().flatten()).all(|value| value.is_finite());
        let mut centre = own.centre.clone();
        for (place, value) in own.places.iter().zip(&axes.centre) {
            centre[*place] = *value;
        }
        (triangular && finite && axes.centre.len() == rows)
            .then(|| Frame::about(own.places.clone(), centre, axes.lower.clone(), at))
    }

    /// The inequalities over a box: `Some(None)` where there is nothing in it. Of the hats only those in the `combinations`.
    fn enclosed<'r>(
        &self,
        by: By,
        here: &mut Here,
        combinations: impl IntoIterator<Item = &'r [(Origin, f64)]>,
        work: &mut Work,
    ) -> Result<Option<Enclosed>, &'static str> {
        let mut model = model(self.setup, &self.layout);
        let none = "there is no enclosure";
        let mut own = here.at.clone();
        let linear = match by {
            By::Same if here.surface.is_none() => return Err("nothing is known of the box"),
            By::Same => return self.slanted(&model, here, work).map(Some),
            By::Hats(0) | By::Chain(0) | By::Slanted(0) => return Err(none),
            By::Slanted(reach) => {
                model.reach = reach;
                model.heard.clone_from(&self.heard);
                here.surface = None;
                return self.slanted(&model, here, work).map(Some);
            }
            By::Hats(reach) => {
                let hats = self.hats(combinations).ok_or(none)?;
                let early = self.early(reach);
                let model = Model { records: &early, reach, ..model };
                if hats.iter().zip(&early).any(|(hats, own)| hats.iter().any(|hat| hat[2] >= own.time_s.len())) {
                    return Err(none);
                }
                model.weighed(&hats, &mut own).map(|mut linear| {
                    model.bound(&mut linear);
                    linear
                })
            }
            By::Chain(reach) => {
                model.reach = reach;
                model.heard = self.named(combinations);
                let centre = own.iter().map(|side| side.midpoint()).collect();
                match model.chained(&mut own, centre, Starts::Given) {
                    Ok(linear) => Some(linear.ok_or(none)?),
                    Err(_) => None,
                }
            }
        };
        work.enclosures += 1;
        Ok(linear.map(|linear| Enclosed::new(linear, own, None)))
    }

    /// In the box's frame; where nothing is known of the readings over it yet, the motion is followed.
    fn slanted(&self, model: &Model<'_>, here: &mut Here, work: &mut Work) -> Result<Enclosed, &'static str> {
        let known = here.surface.take();
        let frame = here.frame.take().unwrap_or_else(|| Frame::straight(model.layout.of_whole(), &here.at));
        let surface = match known {
            Some(known) => known,
            None => {
                work.enclosures += 1;
                Rc::new(model.surface(&here.at, &frame).ok_or("there is no enclosure")?)
            }
        };
        let (linear, _) = surface.over(&frame.z, &frame.centre, false);
        here.surface = Some(surface);
        here.frame = Some(frame.clone());
        Ok(Enclosed::new(linear, here.at.clone(), Some(frame)))
    }

    /// The records as far as so many windows reach.
    fn early(&self, reach: usize) -> Vec<Readings> {
        let last = |record: usize| {
            let own = self.layout.windows().iter().filter(|window| window.record == record);
            own.take(reach).last().map_or(0, |window| window.last)
        };
        self.setup.records.iter().enumerate().map(|(record, readings)| readings.until(last(record) + 1)).collect()
    }

    /// Those in the combinations, by record; `None` where one is none.
    fn hats<'r>(&self, combinations: impl IntoIterator<Item = &'r [(Origin, f64)]>) -> Option<Vec<Vec<Hat>>> {
        let mut hats: Vec<Vec<Hat>> = vec![Vec::new(); self.setup.records.len()];
        for (origin, _) in combinations.into_iter().flatten() {
            if let Origin::Hat { record, samples, .. } = origin {
                let samples_of = self.setup.records.get(*record)?.time_s.len();
                let [l, m, r] = *samples;
                if !(l < m && m < r && r < samples_of) {
                    return None;
                }
                hats[*record].push(*samples);
            }
        }
        hats.iter_mut().for_each(|hats| {
            hats.sort_unstable();
            hats.dedup();
        });
        Some(hats)
    }
}

/// A range in two at a value within it.
fn halves(side: Interval, at: f64) -> Option<[Interval; 2]> {
    Some([Interval::new(side.lower(), at)?, Interval::new(at, side.upper())?])
}
