//! Records as constraints on the unknowns of a model.

use super::command::Command;
use super::field::{Field, TERMS, Term, Triple};
use super::mix::By;
use super::trajectory::active;
use crate::numeric::Interval;

/// One record: instants, readings, and how far the output may be from each.
#[derive(Clone, Debug)]
pub(super) struct Readings {
    pub(super) time_s: Vec<f64>,
    pub(super) value: Vec<f64>,
    /// Largest error of a reading.
    pub(super) error: f64,
    /// Largest error of a stamp.
    pub(super) jitter_s: f64,
    pub(super) command: Command,
}

impl Readings {
    /// The first ones, as if the record ended there.
    pub(super) fn until(&self, samples: usize) -> Self {
        let (time_s, value) = (self.time_s[..samples].to_vec(), self.value[..samples].to_vec());
        let last = time_s.last().copied().unwrap_or(f64::NEG_INFINITY);
        let edges = self.command.spans().iter().take_while(|(first, _)| *first <= last).count();
        Self { time_s, value, command: self.command.until(edges), ..self.clone() }
    }

    /// The same without the first ones.
    pub(super) fn from(&self, sample: usize) -> Self {
        let (time_s, value) = (self.time_s[sample..].to_vec(), self.value[sample..].to_vec());
        Self { time_s, value, ..self.clone() }
    }

    /// Switchings that are left out where it is followed from a sample on: but for the last of those before, which acts there; none where it is
    /// followed from the first.
    pub(super) fn skipped(&self, onset: usize) -> usize {
        let before = self.command.spans().iter().take_while(|(first, _)| *first <= self.time_s[onset]).count();
        if onset > 0 { before.saturating_sub(1) } else { 0 }
    }

    /// The stamp from which on every command that acts is in the log: `t - delay >= t_0 + jitter`, as the first row may be so late.
    pub(super) fn acted_s(&self, delay_s: Interval) -> f64 {
        (Interval::point(self.time_s[0]) + delay_s + Interval::point(self.jitter_s)).upper()
    }

    /// Mean time between two switchings.
    pub(super) fn swing_s(&self) -> f64 {
        (self.time_s[self.time_s.len() - 1] - self.time_s[0]) / (self.command.edges() + 1) as f64
    }
}

/// A stretch of one record: samples from `first` to `last`, the state unknown at the first. The next stretch of the record
/// begins with the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Window {
    pub(super) record: usize,
    pub(super) first: usize,
    pub(super) last: usize,
}

/// Which unknowns there are, and where each stands in a box: terms and the delay, common to all; each record's disturbance and
/// instants; each window's state.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    terms: Vec<Term>,
    delay: bool,
    /// For each record, the number of switchings at unknown instants.
    instants: Vec<usize>,
    windows: Vec<Window>,
}

impl Layout {
    pub(super) fn new(terms: Vec<Term>, delay: bool, instants: Vec<usize>, windows: Vec<Window>) -> Self {
        Self { terms, delay, instants, windows }
    }

    /// The same with other windows.
    pub(super) fn with_windows(self, windows: Vec<Window>) -> Self {
        Self { windows, ..self }
    }

    pub(super) fn terms(&self) -> &[Term] {
        &self.terms
    }
    pub(super) fn records(&self) -> usize {
        self.instants.len()
    }
    pub(super) fn windows(&self) -> &[Window] {
        &self.windows
    }
    pub(super) fn common(&self) -> usize {
        self.terms.len() + usize::from(self.delay)
    }
    pub(super) fn place_of(&self, term: Term) -> Option<usize> {
        self.terms.iter().position(|own| *own == term)
    }
    pub(super) fn delay(&self) -> Option<usize> {
        self.delay.then_some(self.terms.len())
    }
    pub(super) fn lagged(&self) -> bool {
        self.terms.contains(&Term::LagRate)
    }
    pub(super) fn state_size(&self) -> usize {
        if self.lagged() { 3 } else { 2 }
    }
    pub(super) fn disturbance(&self, record: usize) -> usize {
        self.common() + record + self.instants[..record].iter().sum::<usize>()
    }
    pub(super) fn instant(&self, record: usize, edge: usize) -> usize {
        self.disturbance(record) + 1 + edge
    }
    pub(super) fn instants(&self, record: usize) -> usize {
        self.instants[record]
    }
    /// Unknowns that are no window's own.
    pub(super) fn parameters(&self) -> usize {
        self.common() + self.records() + self.instants.iter().sum::<usize>()
    }
    /// Component of the state at the beginning of a window.
    pub(super) fn start(&self, window: usize, component: usize) -> usize {
        self.parameters() + window * self.state_size() + component
    }

    /// Parameters, and the state at every record's beginning.
    pub(super) fn of_whole(&self) -> Vec<usize> {
        let first = |record| self.windows.iter().position(|window| window.record == record);
        let states = |window| (0..self.state_size()).map(move |component| self.start(window, component));
        (0..self.parameters()).chain((0..self.records()).filter_map(first).flat_map(states)).collect()
    }

    /// Samples of so many windows of each record, from its first on.
    pub(super) fn followed(&self, reach: usize) -> f64 {
        let of = |record| self.windows.iter().filter(move |window| window.record == record).take(reach);
        (0..self.records()).flat_map(of).map(|window| (window.last - window.first) as f64).sum()
    }

    /// The state at every window's beginning as far as the reading there tells, while no speed exceeds `fastest`.
    pub(super) fn states(&self, records: &[Readings], fastest: f64) -> Vec<Interval> {
        let mut states = Vec::with_capacity(self.windows.len() * self.state_size());
        for window in &self.windows {
            let readings = &records[window.record];
            let stray = (Interval::point(readings.jitter_s) * Interval::point(fastest)).upper();
            let error = (Interval::point(readings.error) + Interval::point(stray)).upper();
            states.push(Interval::point(readings.value[window.first]) + Interval::symmetric(error));
            states.push(Interval::symmetric(fastest));
            if self.lagged() {
                // A lag keeps the force among the commands.
                states.push(Interval::symmetric(readings.command.largest()));
            }
        }
        states
    }

    /// For one window: what its derivatives are by, and where each stands in a box.
    pub(super) fn columns(&self, window: usize) -> (Vec<By>, Vec<usize>) {
        let record = self.windows[window].record;
        let mut columns: Vec<(By, usize)> =
            self.terms.iter().enumerate().map(|(place, term)| (By::Term(*term), place)).collect();
        columns.extend(self.delay().map(|place| (By::Delay, place)));
        columns.push((By::Term(Term::Disturbance), self.disturbance(record)));
        columns.extend((0..self.instants[record]).map(|edge| (By::Instant(edge), self.instant(record, edge))));
        columns.extend((0..self.state_size()).map(|k| (By::Start(k), self.start(window, k))));
        columns.into_iter().unzip()
    }

    /// The equation for one record over a box.
    pub(super) fn field(&self, record: usize, at: &[Interval], middle_speed: f64) -> Field {
        let mut terms = [Interval::ZERO; TERMS];
        for (place, term) in self.terms.iter().enumerate() {
            terms[*term as usize] = at[place];
        }
        terms[Term::Disturbance as usize] = at[self.disturbance(record)];
        let mut active = active(&self.terms);
        active[Term::Disturbance as usize] = true;
        Field { terms, active, middle_speed }
    }

    /// State at a window's beginning over a box.
    pub(super) fn state_of(&self, window: usize, at: &[Interval]) -> Triple {
        let mut state = [Interval::ZERO; 3];
        for (component, value) in state.iter_mut().enumerate().take(self.state_size()) {
            *value = at[self.start(window, component)];
        }
        state
    }
}
