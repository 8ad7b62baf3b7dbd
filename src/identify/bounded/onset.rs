//! Where in the records the search begins: where a few swings tell most.
//!
//! What so many readings leave of the parameters is many times larger from one stretch of a record to another, by the luck of their
//! roundings. Whatever the onset, what is found encloses what all readings leave: those before it are heard at the end.

use super::bounds::Quantity;
use super::search::Search;
use super::settings::BoundedModel;
use super::setup::{SEARCHED, Setup};
use super::trajectory::{Node, Unknowns};
use crate::numeric::Interval;

#[cfg(test)]
mod tests;

/// A later onset is taken only for so much less, as a logarithm: at the end there are readings before it.
const LESS: f64 = 0.5;
/// Share of its switchings up to which a record may be left out at first.
const LATEST: f64 = 0.5;

impl Search<'_> {
    /// The records from where their next swings leave least, by linear programmes about what estimates lead to. `None` where that is
    /// their beginning, and without estimates.
    pub(super) fn later(&mut self, settings: &BoundedModel, estimates: Option<&[(Quantity, f64)]>) -> Option<Setup> {
        let near = self.nearest_to(estimates?)?;
        self.later_about(settings, &near.at)
    }

    /// The same about a point. `None` where its motion cannot be enclosed.
    fn later_about(&mut self, settings: &BoundedModel, point: &[f64]) -> Option<Setup> {
        let setup = self.setup;
        self.count_pass();
        let at: Vec<Interval> = point.iter().map(|value| Interval::point(*value)).collect();
        let whole = self.model.whole().into_iter();
        let motions: Option<Vec<Vec<Node>>> =
            whole.map(|span| self.model.follow(span, &at, point, Unknowns::NONE, &self.model.times(span))).collect();
        let motions = motions?;
        let first = left_by(setup, settings, point, &motions)?;
        let edges = setup.records.iter().map(|readings| readings.command.edges()).min()?;
        let latest = (LATEST * edges as f64) as usize;
        let later = (0..latest).filter_map(|edge| {
            let later = setup.after(settings, edge)?;
            let left = left_by(&later, settings, point, &motions)?;
            Some((left, later))
        });
        let (least, best) = later.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (least < first - LESS).then_some(best)
    }
}

/// The logarithm of the product of the parameters' ranges that the beginnings leave, as if they were linear about a point, of which the
/// motions are known.
fn left_by(setup: &Setup, settings: &BoundedModel, point: &[f64], motions: &[Vec<Node>]) -> Option<f64> {
    let beginnings = setup.beginnings(settings, SEARCHED)?;
    let (search, layout) = (Search::new(&beginnings), &beginnings.layout);
    let mut centre: Vec<f64> = beginnings.search.iter().map(|side| side.midpoint()).collect();
    centre[..layout.parameters()].copy_from_slice(&point[..layout.parameters()]);
    let whole = search.model.whole();
    for (span, motion) in whole.iter().zip(motions) {
        let record = layout.windows()[span.from].record;
        // The motion ends with the record.
        let readings = &setup.records[record];
        let sample = setup.layout.windows().iter().find(|window| window.record == record)?.first;
        let node = motion.get((motion.len() + sample).checked_sub(readings.time_s.len())?)?;
        for (component, value) in node.at.iter().enumerate().take(layout.state_size()) {
            centre[layout.start(span.from, component)] = value.midpoint();
        }
    }
    let at: Vec<Interval> = centre.iter().map(|value| Interval::point(*value)).collect();
    let mut linear = search.model.about(&beginnings.search, centre.clone());
    for span in whole {
        let motion = search.model.motion(span, &at, &centre)?;
        search.model.linearise(span, &motion, false, &mut linear);
    }
    search.model.bound(&mut linear);
    let places = layout.of_whole();
    let programme = linear.programme(&places);
    let range = |unknown: usize| linear.range(&programme, &[(unknown, 1.0)]).ok();
    (0..layout.parameters()).map(|unknown| Some(range(unknown)?.width().max(f64::MIN_POSITIVE).ln())).sum()
}
