//! Finding the steps: box by box, each contracted while that helps, and divided.

use super::super::contract::Linear;
use super::super::divide::around;
use super::super::rows::Starts;
use super::super::search::Search;
use super::super::setup::Setup;
use super::super::slanted::Slanted;
use super::prove::Goal;
use super::seek::{Caution, Found, Seek};
use super::{By, Cut, Stage, Step, Unproved, ends, roughly, shorten};
use crate::numeric::{Interval, Real};

#[cfg(test)]
mod tests;

/// Steps that leave more than this of every range did not help.
pub(super) const HELPED: f64 = 0.8;
/// Speeds from readings and hats differ little, slopes over wide boxes by shares of their ranges.
const OF_HATS: Caution = Caution { of_left: 0.03, of_slopes: 0.0 };
const OF_CHAINS: Caution = Caution { of_left: 0.03, of_slopes: 0.25 };
/// Steps of a stage, at most.
const MOST_STEPS: usize = 4000;
/// A box this much wider than what is left is cut where it sticks out.
const NEAR: f64 = 4.0;

/// A box at hand, and how far it has been worked on.
#[derive(Clone)]
pub(super) struct Open {
    pub(super) at: Vec<Interval>,
    pub(super) slanted: Option<Slanted>,
    /// The hats help no more.
    pub(super) weighed: bool,
    /// Which of the reaches it is followed over.
    pub(super) level: usize,
    /// Steps there were when the box and its frame were met.
    met: usize,
}

/// Of what most is in doubt.
#[derive(Clone, Copy)]
pub(super) enum Widest {
    Unknown(usize),
    /// Of the box's frame.
    Coordinate(usize),
}

/// What became of the box at hand.
pub(super) enum Next {
    /// It is empty.
    Excluded,
    /// It is smaller.
    Smaller,
    /// It is as it was, but for little; to be divided there.
    Stuck(Widest),
    /// It is as small as the records' beginnings make it.
    Settled,
}

pub(super) struct Prover<'a> {
    pub(super) search: Search<'a>,
    /// The same of records that end with their beginnings.
    pub(super) early: Search<'a>,
    /// Windows of a record that are followed, from its beginning to all.
    pub(super) reaches: Vec<usize>,
    pub(super) narrow: bool,
    pub(super) left: Option<Vec<Interval>>,
    pub(super) steps: Vec<Step>,
    /// What the check of the steps costs, in motions over whole records to the second order, and may.
    spent: f64,
    most: f64,
}

fn middles(at: &[Interval]) -> Vec<f64> {
    at.iter().map(|side| side.midpoint()).collect()
}

impl<'a> Prover<'a> {
    pub(super) fn of(
        setup: &'a Setup,
        early: &'a Setup,
        reaches: &[usize],
        goal: &Goal<'_>,
        room: f64,
        most: f64,
    ) -> Self {
        let left = match goal {
            Goal::Within(hull) => {
                let wider = |(side, from): (&Interval, &Interval)| {
                    let room = room * side.width() + f64::EPSILON * side.magnitude();
                    side.inflate(room).intersection(*from).unwrap_or(*side)
                };
                Some(hull.iter().zip(&setup.search).take(setup.layout.parameters()).map(wider).collect())
            }
            Goal::Narrow | Goal::Nothing => None,
        };
        let (mut search, mut early) = (Search::new(setup), Search::new(early));
        for search in [&mut search, &mut early] {
            search.model.per_s = roughly(setup.swing_s);
        }
        early.model.reach = reaches[0];
        let narrow = matches!(goal, Goal::Narrow);
        Self { search, early, reaches: reaches.to_vec(), narrow, left, steps: Vec::new(), spent: 0.0, most }
    }

    /// The stage, and how often whole records are followed in it.
    pub(super) fn stage(mut self) -> Result<(Stage, f64), Unproved> {
        let kept = self.go()?;
        let setup = self.search.setup;
        let (layout, parameters) = (&setup.layout, setup.layout.parameters());
        let left = if self.narrow { around(kept).map(|hull| hull[..parameters].to_vec()) } else { self.left };
        let stage = Stage {
            windows: layout.windows().iter().map(|window| [window.record, window.first, window.last]).collect(),
            left: left.as_deref().map(ends),
            steps: self.steps,
        };
        Ok((stage, self.spent))
    }

    /// All boxes; those that are left.
    fn go(&mut self) -> Result<Vec<Vec<Interval>>, Unproved> {
        let at = self.search.setup.search.clone();
        let mut open = vec![Open { at, slanted: None, weighed: false, level: 0, met: 0 }];
        let mut left = Vec::new();
        while let Some(mut here) = open.pop() {
            loop {
                if !self.meet(&mut here) {
                    self.push(Step::Keep);
                    break;
                }
                if self.kept(&here) {
                    self.push(Step::Keep);
                    left.push(here.at);
                    break;
                }
                if self.steps.len() > MOST_STEPS || self.spent > self.most {
                    return Err(Unproved::NotFound { steps: self.steps.len() });
                }
                match self.step(&mut here) {
                    Next::Excluded => break,
                    Next::Smaller => {}
                    Next::Settled => {
                        self.push(Step::Keep);
                        left.push(here.at);
                        break;
                    }
                    Next::Stuck(widest) => {
                        let Some([low, high]) = self.part(&mut here, widest)? else { break };
                        open.push(high);
                        here = low;
                    }
                }
            }
        }
        Ok(left)
    }

    pub(super) fn push(&mut self, step: Step) {
        if let Some((reach, cost)) = step.follows() {
            let layout = &self.search.setup.layout;
            self.spent += cost * layout.followed(reach) / layout.followed(usize::MAX);
        }
        self.steps.push(step);
    }

    /// Before every step a box and its frame are met; `false` where they have nothing in common.
    pub(super) fn meet(&self, here: &mut Open) -> bool {
        let before = core::mem::replace(&mut here.met, self.steps.len());
        let at = &mut here.at;
        before == here.met || here.slanted.as_mut().is_none_or(|slanted| slanted.frame.meet(at))
    }

    fn kept(&self, here: &Open) -> bool {
        let left = self.left.as_ref();
        left.is_some_and(|left| here.at.iter().zip(left).all(|(side, left)| side.is_subset_of(*left)))
    }

    /// Windows of each record that a box is followed over.
    pub(super) fn reach(&self, here: &Open) -> usize {
        self.reaches[here.level]
    }

    fn parameters(&self) -> Vec<usize> {
        (0..self.search.setup.layout.parameters()).collect()
    }

    fn step(&mut self, here: &mut Open) -> Next {
        if !here.weighed
            && let Some(next) = self.weigh(here)
        {
            return next;
        }
        let (wide, widest) = self.search.too_wide(&here.at);
        if wide {
            // Parts of it may be weighed again.
            here.weighed = false;
            return Next::Stuck(Widest::Unknown(widest));
        }
        self.search.model.reach = self.reach(here);
        let next = self.slant(here).unwrap_or_else(|widest| match (self.chain(here), widest) {
            (Next::Stuck(_), Some(widest)) if here.slanted.is_some() => Next::Stuck(Widest::Coordinate(widest)),
            (next, _) => next,
        });
        match next {
            Next::Stuck(_) if here.level + 1 < self.reaches.len() && here.slanted.is_some() => self.raise(here),
            next => next,
        }
    }

    /// By hats, and once the box is narrow enough by the speeds that the readings tell at the windows' beginnings; `None` where that
    /// is done with.
    fn weigh(&mut self, here: &mut Open) -> Option<Next> {
        let by = By::Hats(self.reaches[0]);
        let mut own = here.at.clone();
        let Some(mut linear) = self.early.weighed(&mut own) else {
            self.push(Step::Exclude { by, rows: Vec::new() });
            return Some(Next::Excluded);
        };
        self.early.model.bound(&mut linear);
        let mut found = self.found(&linear, OF_HATS, &here.at, &self.parameters(), &self.parameters());
        if let Found::Cuts(cuts) = &mut found {
            let mut at = here.at.clone();
            if cuts.iter().all(|cut| shorten(&mut at, cut)) {
                let wide = self.search.too_wide(&at).0;
                here.weighed = !wide || self.search.rest(&here.at, &at) > HELPED;
                if !wide {
                    cuts.extend(self.speeds(&at, &own));
                }
            }
        }
        if self.take(by, found, here) {
            return Some(Next::Excluded);
        }
        (!here.weighed).then_some(Next::Smaller)
    }

    /// Cuts of speeds that are known.
    fn speeds(&self, at: &[Interval], known: &[Interval]) -> Vec<Cut> {
        let mut cuts = Vec::new();
        for (unknown, known) in known.iter().enumerate().skip(self.search.setup.layout.parameters()) {
            let known = known.inflate(OF_HATS.of_left * known.width());
            if !at[unknown].is_subset_of(known) {
                let cut = |upper, end| Cut { unknown, upper, end, rows: Vec::new() };
                cuts.extend([cut(true, known.upper()), cut(false, known.lower())]);
            }
        }
        cuts
    }

    /// By all windows, each linked to the next: velocities at their beginnings first.
    fn chain(&mut self, here: &mut Open) -> Next {
        let chained = self.search.chained(&mut here.at.clone(), middles(&here.at), Starts::Given);
        let mut linear = match chained {
            Err(_) => {
                self.push(Step::Exclude { by: By::Chain(self.reach(here)), rows: Vec::new() });
                return Next::Excluded;
            }
            Ok(None) => return Next::Stuck(Widest::Unknown(self.search.widest(&here.at).1)),
            Ok(Some(linear)) => linear,
        };
        let (before, (_, widest)) = (here.at.clone(), self.search.slack(&linear));
        let layout = &self.search.setup.layout;
        let mut at = here.at.clone();
        let mut all: Vec<Cut> = Vec::new();
        // Windows one by one, then the parameters.
        for window in (0..layout.windows().len()).map(Some).chain([None]) {
            let (rows, own) = match window {
                Some(window) => {
                    (linear.beside(window), (1..layout.state_size()).map(|k| layout.start(window, k)).collect())
                }
                None => (linear.clone(), self.parameters()),
            };
            let known: Vec<Interval> =
                rows.deviations.iter().zip(&rows.centre).map(|(z, centre)| *z + Interval::point(*centre)).collect();
            match self.found(&rows, OF_CHAINS, &known, &rows.places(), &own) {
                Found::Excluded(rows, by) if all.is_empty() => {
                    self.take(By::Chain(self.reach(here)), Found::Excluded(rows, by), here);
                    return Next::Excluded;
                }
                found => {
                    for cut in found.into_cuts(&known) {
                        let empty = !shorten(&mut at, &cut);
                        let side = at[cut.unknown] - Interval::point(linear.centre[cut.unknown]);
                        let known = &mut linear.deviations[cut.unknown];
                        *known = known.intersection(side).unwrap_or(side);
                        all.push(cut);
                        if empty {
                            self.take(By::Chain(self.reach(here)), Found::Cuts(all), here);
                            return Next::Excluded;
                        }
                    }
                }
            }
        }
        if self.take(By::Chain(self.reach(here)), Found::Cuts(all), here) {
            return Next::Excluded;
        }
        if self.search.rest(&before, &here.at) < HELPED { Next::Smaller } else { Next::Stuck(Widest::Unknown(widest)) }
    }

    /// Cuts of unknowns by themselves.
    fn found(&self, linear: &Linear, caution: Caution, at: &[Interval], places: &[usize], unknowns: &[usize]) -> Found {
        let seek = Seek::new(self.search.setup, linear, places, caution);
        let sought = unknowns.iter().map(|unknown| (*unknown, at[*unknown], seek.unknown(*unknown)));
        seek.collect(sought, |place| self.face(place))
    }

    /// What is to be left of an unknown.
    pub(super) fn face(&self, unknown: usize) -> Option<Interval> {
        self.left.as_ref().and_then(|left| left.get(unknown).copied())
    }

    /// Notes what was found, and takes it off the box; whether nothing is left.
    pub(super) fn take(&mut self, by: By, found: Found, here: &mut Open) -> bool {
        match found {
            Found::Excluded(rows, _) => {
                self.push(Step::Exclude { by, rows });
                true
            }
            Found::Cuts(cuts) if cuts.is_empty() => false,
            Found::Cuts(cuts) => {
                let empty = cuts.iter().any(|cut| !shorten(&mut here.at, cut));
                self.push(Step::Contract { by, cuts });
                empty
            }
        }
    }

    /// Divides a box that the last step may have made smaller than its frame; `None` where they have nothing in common.
    fn part(&mut self, here: &mut Open, widest: Widest) -> Result<Option<[Open; 2]>, Unproved> {
        if !self.meet(here) {
            self.push(Step::Keep);
            return Ok(None);
        }
        let (step, parts) = self.divide(here, widest)?;
        self.push(step);
        Ok(Some(parts))
    }

    /// The step, what it leaves, and its lower part: where the box sticks out of what is left, there; else at the unknown or the
    /// coordinate whose range costs most.
    fn divide(&self, here: &Open, widest: Widest) -> Result<(Step, [Open; 2]), Unproved> {
        if let Some((unknown, value)) = self.furthest_out(&here.at) {
            let side = here.at[unknown];
            if let (Some(low), Some(high)) = (Interval::new(side.lower(), value), Interval::new(value, side.upper())) {
                return Ok(divided(here, unknown, [low, high]));
            }
        }
        let unknown = match widest {
            Widest::Unknown(unknown) => unknown,
            Widest::Coordinate(coordinate) => {
                if let Some([low, high]) = here.slanted.as_ref().and_then(|slanted| slanted.halves(coordinate)) {
                    let at = low.frame.z[coordinate].upper();
                    let part = |slanted| Open { slanted: Some(slanted), ..here.clone() };
                    return Ok((Step::Part { coordinate, at }, [part(low), part(high)]));
                }
                self.search.widest(&here.at).1
            }
        };
        // A range that cannot be divided leaves the widest of the others.
        let search = &self.search;
        let relative = |place: &usize| here.at[*place].width() / search.setup.search[*place].width();
        let mut others = self.parameters();
        others.sort_by(|a, b| relative(b).total_cmp(&relative(a)));
        let parts = |place: usize| Some((place, search.divide(&here.at, place)?));
        let (unknown, [low, high]) = core::iter::once(unknown)
            .chain(others)
            .find_map(parts)
            .ok_or(Unproved::NotFound { steps: self.steps.len() })?;
        Ok(divided(here, unknown, [low[unknown], high[unknown]]))
    }

    /// Of a box near what is left, the unknown by which it sticks out furthest, and where that begins.
    fn furthest_out(&self, at: &[Interval]) -> Option<(usize, f64)> {
        let left = self.left.as_ref()?;
        let near = |(side, left): (&Interval, &Interval)| {
            side.width() <= NEAR * left.width() && side.intersection(*left).is_some()
        };
        if !at.iter().zip(left).all(near) {
            return None;
        }
        let mut furthest = (0.0, None);
        for (unknown, (side, left)) in at.iter().zip(left).enumerate() {
            let unit = left.width().max(f64::MIN_POSITIVE);
            for (out, value) in
                [(side.upper() - left.upper(), left.upper()), (left.lower() - side.lower(), left.lower())]
            {
                if out / unit > furthest.0 && side.lower() < value && value < side.upper() {
                    furthest = (out / unit, Some((unknown, value)));
                }
            }
        }
        furthest.1
    }
}

fn divided(here: &Open, unknown: usize, halves: [Interval; 2]) -> (Step, [Open; 2]) {
    let at = halves[0].upper();
    let part = |half| {
        let mut part = here.clone();
        part.at[unknown] = half;
        part
    };
    (Step::Divide { unknown, at }, halves.map(part))
}
