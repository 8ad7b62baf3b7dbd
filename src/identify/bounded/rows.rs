//! The inequalities of a pass over a box: by hats, and of windows each linked to the next.

use super::contract::{Hat, Linear, Model, Span};
use super::field::Term;
use super::problem::Window;
use super::trajectory::Node;
use crate::numeric::Interval;

#[cfg(test)]
mod tests;

/// A window is followed anew where its readings leave less than this of the range of its beginning.
const DRAWN: f64 = 0.5;

/// What is taken of the windows' beginnings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Starts {
    /// What the box says, and the window before.
    Given,
    /// Besides, what each window's own readings leave of them, one by one.
    Drawn,
}

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
    pub(super) fn chained(
        &self,
        at: &mut [Interval],
        centre: Vec<f64>,
        starts: Starts,
    ) -> Result<Option<Linear>, Parted> {
        let followed: Vec<(usize, Window)> = self.followed().collect();
        let mut linear = self.about(at, centre);
        for (place, &(index, window)) in followed.iter().enumerate() {
            let span = Span { from: index, to: index + 1 };
            let Some(mut motion) = self.motion(span, at, &linear.centre) else { return Ok(None) };
            if starts == Starts::Drawn && self.draw(span, &motion, at, &mut linear)? {
                let Some(narrower) = self.motion(span, at, &linear.centre) else { return Ok(None) };
                motion = narrower;
            }
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

    /// What a window's readings leave of its beginning, but for the position: each by the slope of the output there, however wide the
    /// slope's range, of which a linear programme takes the middle. Whether that is so little that it is followed about another middle.
    fn draw(&self, span: Span, motion: &[Node], at: &mut [Interval], linear: &mut Linear) -> Result<bool, Parted> {
        let (_, places) = self.layout.columns(span.from);
        let record = self.layout.windows()[span.from].record;
        let (readings, samples) = (&self.records[record], self.samples(span));
        let mut little = Vec::new();
        for component in 1..self.layout.state_size() {
            let own = self.layout.start(span.from, component);
            let Some(column) = places.iter().position(|place| *place == own) else { continue };
            let before = at[own].width();
            for (offset, (node, &sample)) in motion.iter().zip(&samples).enumerate() {
                let slope = node.slopes[column][0];
                if slope.contains_zero() {
                    continue;
                }
                let error = Interval::symmetric(self.allowed(record, motion, &samples, offset).upper());
                let others = places.iter().zip(&node.slopes).filter(|(place, _)| **place != own);
                let by_others = Interval::dot(others.map(|(place, slope)| (slope[0], linear.deviations[*place])));
                let way = Interval::point(readings.value[sample]) + error - node.at[0] - by_others;
                let left = Interval::point(linear.centre[own]) + way / slope;
                at[own] = at[own].intersection(left).ok_or(Parted)?;
            }
            linear.deviations[own] = at[own] - Interval::point(linear.centre[own]);
            if at[own].width() < DRAWN * before {
                little.push(own);
            }
        }
        // Not before: what is known of the motion is about the first middles.
        for &own in &little {
            linear.recentre(own, at[own].midpoint());
        }
        Ok(!little.is_empty())
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
