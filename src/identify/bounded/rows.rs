//! The inequalities of a pass over a box: by hats, and of windows each linked to the next.

use super::contract::{Hat, Linear, Model, Span};
use super::field::Term;
use super::problem::Window;
use super::trajectory::Node;
use crate::numeric::Interval;

/// An enclosure of the motion and what is known of it otherwise have nothing in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Parted;

impl Model<'_> {
    /// Windows that are followed.
    fn followed(&self) -> impl Iterator<Item = (usize, Window)> + '_ {
        let windows = self.layout.windows().iter().copied().enumerate();
        let first = |record| self.layout.windows().iter().position(|window| window.record == record).unwrap_or(0);
        windows.filter(move |(index, window)| index - first(window.record) < self.reach)
    }

    /// Records as far as they are followed, one span each.
    pub(super) fn whole(&self) -> Vec<Span> {
        let mut spans: Vec<Span> = Vec::new();
        for (index, window) in self.followed() {
            match spans.last_mut() {
                Some(span) if self.layout.windows()[span.from].record == window.record => span.to = index + 1,
                _ => spans.push(Span { from: index, to: index + 1 }),
            }
        }
        spans
    }

    /// Parameters, and the state at every record's beginning.
    pub(super) fn of_whole(&self) -> Vec<usize> {
        let starts = self.whole().into_iter();
        let starts =
            starts.flat_map(|span| (0..self.layout.state_size()).map(move |k| self.layout.start(span.from, k)));
        (0..self.layout.parameters()).chain(starts).collect()
    }

    /// Speeds from the readings, those at the windows' beginnings put into the box; then the hats. `None` where there is no motion.
    pub(super) fn weighed(&self, hats: &[Vec<Hat>], at: &mut [Interval]) -> Option<Linear> {
        let mut centre = vec![0.0; at.len()];
        // What the command's slopes are about.
        for place in self.layout.delay().into_iter().chain(self.layout.place_of(Term::LagRate)) {
            centre[place] = at[place].midpoint();
        }
        let mut linear = self.about(at, centre);
        for (record, hats) in hats.iter().enumerate() {
            let speeds = self.speeds(record, at)?;
            if !self.travelled(record, &speeds) {
                return None;
            }
            for (index, window) in self.followed().filter(|(_, window)| window.record == record) {
                let place = self.layout.start(index, 1);
                at[place] = at[place].intersection(speeds.at_samples[window.first])?;
            }
            self.weigh(record, hats, at, &speeds, &mut linear);
        }
        Some(linear)
    }

    /// All windows that are followed about `centre`, each linked to the next. What a window's end says of the next one's beginning goes into the
    /// box. `None` where there is no enclosure.
    pub(super) fn chained(&self, at: &mut [Interval], centre: Vec<f64>) -> Result<Option<Linear>, Parted> {
        let followed: Vec<(usize, Window)> = self.followed().collect();
        let mut linear = self.about(at, centre);
        for (place, &(index, window)) in followed.iter().enumerate() {
            let span = Span { from: index, to: index + 1 };
            let Some(motion) = self.motion(span, at, &linear.centre) else { return Ok(None) };
            let linked = followed.get(place + 1).is_some_and(|(_, next)| next.record == window.record);
            self.linearise(span, &motion, linked, &mut linear);
            if linked {
                self.carry(at, index + 1, &motion)?;
                for component in 0..self.layout.state_size() {
                    let place = self.layout.start(index + 1, component);
                    linear.deviations[place] = at[place] - Interval::point(linear.centre[place]);
                }
            }
        }
        self.bound(&mut linear);
        Ok(Some(linear))
    }

    /// The state at the end of a motion is that at the beginning of the next window.
    fn carry(&self, at: &mut [Interval], next: usize, motion: &[Node]) -> Result<(), Parted> {
        let end = motion.last().map(|node| node.over);
        for (component, value) in end.iter().flatten().enumerate().take(self.layout.state_size()) {
            let place = self.layout.start(next, component);
            at[place] = at[place].intersection(*value).ok_or(Parted)?;
        }
        Ok(())
    }
}
