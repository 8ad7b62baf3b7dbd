//! The search as a whole: beginnings, then further and further, then all readings; and what is made of it.

use std::borrow::Cow;
use std::cell::LazyCell;
use std::ops::Deref;

use super::bounds::{Bounds, Quantity};
use super::divide::{Division, Kept};
use super::frame::Frame;
use super::report::Answer;
use super::search::Search;
use super::settings::BoundedModel;
use super::setup::{SEARCHED, Setup};
use super::slanted::Slanted;
use super::witness::Tried;
use crate::identify::IdentifyError;
use crate::numeric::Interval;

#[cfg(test)]
mod tests;

/// Divisions after which a witness is looked for again.
const DIVISIONS_PER_TRIAL: usize = 8;
/// Passes over the beginnings after which it is looked where in the records another search of them is shorter.
const PATIENCE: usize = 1000;
/// Bounds that are this good, the inner against the outer width, are not sharpened further.
const GOOD: f64 = 0.98;

/// Estimates that are made once they are asked for.
type Estimates = Option<Vec<(Quantity, f64)>>;

/// What a search gave.
pub(super) struct Explored {
    pub(super) bounds: Bounds,
    /// The box around what was left, and that around what more readings left of it; none for nothing.
    pub(super) hulls: Vec<Option<Vec<Interval>>>,
    /// The parameters that are left; `None` where nothing is.
    pub(super) left: Option<Vec<Interval>>,
    /// The records from where the search began, if that is not their beginning.
    pub(super) later: Option<Setup>,
}

/// The search; where it takes long, or finds no witness, `estimates` say where to look. `witness` is told of one that was found.
pub(super) fn explore(
    setup: &Setup,
    settings: &BoundedModel,
    estimates: impl FnOnce() -> Estimates,
    witness: impl FnOnce(&Search<'_>, Option<&Tried>),
) -> Result<Explored, IdentifyError> {
    let estimates = LazyCell::new(estimates);
    let begun = begin(setup, settings, &estimates, PATIENCE);
    go_further(setup, begun, settings, &estimates, witness)
}

/// From what the beginnings leave to what all readings do.
fn go_further(
    setup: &Setup,
    begun: Begun<'_>,
    settings: &BoundedModel,
    estimates: &impl Deref<Target = Estimates>,
    witness: impl FnOnce(&Search<'_>, Option<&Tried>),
) -> Result<Explored, IdentifyError> {
    let Begun { setup: begun, boxes, spent } = begun;
    let mut search = Search::new(&begun).after(spent);
    let division = if boxes.is_empty() {
        // Where nothing is left of the beginnings, whole records show by how much they contradict the model.
        search.search(begun.search.clone(), settings.budget)
    } else {
        search.follow_further(boxes, &begun.reaches(SEARCHED.swings), settings.budget)
    };
    // A delay that is known better leaves more readings; and those before the onset are not heard yet, by a witness either.
    let partial = setup.layout.delay().is_some() && division.followed || matches!(begun, Cow::Owned(_));
    if let (Some(hull), true) = (division.hull(), partial) {
        let all = setup.narrowed(settings, &hull)?;
        let mut search = Search::new(&all).after(search.passes);
        let division = match led(&all, &begun, settings, &division) {
            Some(led) => search.follow_further(vec![led], &all.reaches(SEARCHED.swings), settings.budget),
            None => search.search(all.search.clone(), settings.budget),
        };
        let (bounds, last) = conclude(setup, search, division, settings, estimates, witness);
        let left = last.as_ref().map(|last| {
            let mut left = last[..all.layout.parameters()].to_vec();
            if let (Some(place), None) = (setup.layout.delay(), all.layout.delay()) {
                left.insert(place, all.known_delay_s);
            }
            left
        });
        return Ok(Explored { bounds, hulls: vec![Some(hull), last], left, later: later(begun) });
    }
    let (bounds, hull) = conclude(setup, search, division, settings, estimates, witness);
    let left = hull.as_ref().map(|hull| hull[..setup.layout.parameters()].to_vec());
    Ok(Explored { bounds, hulls: vec![hull], left, later: later(begun) })
}

/// The records from another onset.
fn later(begun: Cow<'_, Setup>) -> Option<Setup> {
    match begun {
        Cow::Owned(later) => Some(later),
        Cow::Borrowed(_) => None,
    }
}

/// What the beginnings leave.
struct Begun<'a> {
    /// From where in the records on.
    setup: Cow<'a, Setup>,
    boxes: Vec<Kept>,
    /// Passes over whole records that cost as much.
    spent: usize,
}

/// The search of the beginnings: where it takes more than so many passes, from where estimates say that it is shorter.
fn begin<'a>(
    setup: &'a Setup,
    settings: &BoundedModel,
    estimates: &impl Deref<Target = Estimates>,
    patience: usize,
) -> Begun<'a> {
    let Some(beginnings) = setup.beginnings(settings, SEARCHED) else {
        return Begun { setup: Cow::Borrowed(setup), boxes: Vec::new(), spent: 0 };
    };
    // Passes over part of the records cost so much less.
    let passes = |of: &Setup, whole: usize| whole * setup.samples() / of.samples();
    let spent = |search: &Search<'_>| search.passes * search.setup.samples() / setup.samples();
    let budget = passes(&beginnings, settings.budget);
    // Where the delay is known nothing else asks for all readings once more at the end.
    let patience = if setup.layout.delay().is_some() { patience } else { budget };
    let mut search = Search::new(&beginnings).part_of(setup);
    let mut division = search.search(beginnings.search.clone(), budget.min(patience));
    if !division.followed && patience < budget {
        let mut near = Search::new(setup);
        let later = near.later(settings, estimates.as_deref());
        let before = spent(&search) + near.passes;
        if let Some(later) = later
            && let Some(beginnings) = later.beginnings(settings, SEARCHED)
        {
            let mut search = Search::new(&beginnings).part_of(setup);
            let left = settings.budget.saturating_sub(before);
            let division = search.search(beginnings.search.clone(), passes(&beginnings, left));
            let boxes = later.boxes(&beginnings, &division);
            return Begun { spent: before + spent(&search), setup: Cow::Owned(later), boxes };
        }
        search.go_on(&mut division, budget);
    }
    Begun { spent: spent(&search), boxes: setup.boxes(&beginnings, &division), setup: Cow::Borrowed(setup) }
}

impl Setup {
    /// What is left of the beginnings, as boxes of whole records.
    fn boxes(&self, beginnings: &Self, division: &Division) -> Vec<Kept> {
        division.kept.iter().map(|kept| Kept::new(self.begun(beginnings, &kept.at))).collect()
    }
}

/// One box around all that was found, the parameters in a frame of those that were found and the states as the beginnings tell them. `None`
/// where there is no such frame, or other parameters.
fn led(all: &Setup, begun: &Setup, settings: &BoundedModel, found: &Division) -> Option<Kept> {
    if all.layout.delay() != begun.layout.delay() {
        return None;
    }
    let beginnings = all.beginnings(settings, SEARCHED)?;
    let mut at = beginnings.search.clone();
    Search::new(&beginnings).contract(&mut at, true).ok()?;
    let at = all.begun(&beginnings, &at);
    let boxes = found.kept.iter().map(|kept| (&kept.at[..], kept.slanted.as_ref().map(|slanted| &slanted.frame)));
    let frame = Frame::led_by(all.layout.parameters(), boxes, all.layout.of_whole(), &at)?;
    Some(Kept { slanted: Some(Slanted { frame, surface: None, informed: true }), ..Kept::new(at) })
}

/// The answer, from what division left; `wide` is where the search began.
fn conclude(
    wide: &Setup,
    mut search: Search<'_>,
    mut division: Division,
    settings: &BoundedModel,
    estimates: &impl Deref<Target = Estimates>,
    witness: impl FnOnce(&Search<'_>, Option<&Tried>),
) -> (Bounds, Option<Vec<Interval>>) {
    let mut answer = Answer::default();
    answer.try_nearest(&mut search, &division);
    if answer.witness().is_none() && !division.kept.is_empty() {
        answer.try_estimates(&mut search, estimates.as_deref());
    }
    // Without a witness the parts may yet turn out empty.
    let mut divided = 0usize;
    while answer.witness().is_none()
        && search.passes < settings.budget
        && search.divide_coarsest(&mut division, settings.budget)
    {
        divided += 1;
        if divided.is_multiple_of(DIVISIONS_PER_TRIAL) {
            answer.try_nearest(&mut search, &division);
        }
    }
    if answer.witness().is_some() && search.passes < settings.budget {
        answer.sharpen(&mut search, &mut division, settings.budget, GOOD);
    }
    witness(&search, answer.witness());
    (answer.into_bounds(wide, search, &division), division.hull())
}
