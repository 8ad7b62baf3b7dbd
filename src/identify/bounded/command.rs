//! The command as the vehicle's input: levels, and when it passes from one to the next.

use crate::experiment::Record;
use crate::numeric::Interval;

/// A held command: constant but for switchings, each within a known span of the log's clock.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Command {
    levels: Vec<f64>,
    /// First and last instant of each switching; equal where it is known.
    spans: Vec<(f64, f64)>,
}

impl Command {
    /// Levels, and the first and last instant of each switching between two of them.
    pub(super) fn new(levels: Vec<f64>, spans: Vec<(f64, f64)>) -> Self {
        Self { levels, spans }
    }

    /// The command of a record: switching with the sample that has the new value, or `anywhere` since the one before. The stamp of
    /// either is off by at most `jitter_s`, so that a switching is within `[first - jitter, last + jitter]`.
    pub(super) fn of(record: &Record, anywhere: bool, jitter_s: f64) -> Self {
        let (time, input) = (record.time_s(), record.input());
        let (mut levels, mut spans) = (vec![input[0]], Vec::new());
        for after in 1..record.samples() {
            if input[after] != input[after - 1] {
                levels.push(input[after]);
                let first = if anywhere { time[after - 1] } else { time[after] };
                let span = Interval::point(first).hull(Interval::point(time[after]));
                let span = if jitter_s > 0.0 { span + Interval::symmetric(jitter_s) } else { span };
                spans.push((span.lower(), span.upper()));
            }
        }
        Self::new(levels, spans)
    }

    /// First and last instant of each switching.
    pub(super) fn spans(&self) -> &[(f64, f64)] {
        &self.spans
    }

    /// Number of switchings.
    pub(super) fn edges(&self) -> usize {
        self.spans.len()
    }

    /// Unknown instants: all switchings, or none.
    pub(super) fn instants(&self) -> usize {
        if self.spans.iter().all(|(first, last)| first == last) { 0 } else { self.edges() }
    }

    pub(super) fn span(&self, edge: usize) -> Interval {
        let (first, last) = self.spans[edge];
        Interval::point(first).hull(Interval::point(last))
    }

    /// Up to a switching, which is no part of it.
    pub(super) fn until(&self, edge: usize) -> Self {
        Self { levels: self.levels[..=edge].to_vec(), spans: self.spans[..edge].to_vec() }
    }

    /// The same with each switching's span replaced.
    pub(super) fn with_spans(&self, spans: impl Iterator<Item = Interval>) -> Self {
        Self { levels: self.levels.clone(), spans: spans.map(|span| (span.lower(), span.upper())).collect() }
    }

    /// When the switching acts at the earliest and the latest.
    pub(super) fn window(&self, edge: usize, delay_s: Interval) -> (f64, f64) {
        let window = self.span(edge) + delay_s;
        (window.lower(), window.upper())
    }

    /// All levels from after switching number `done` (counted from one; zero for before the first) to after number `begun`.
    pub(super) fn between(&self, done: usize, begun: usize) -> Interval {
        let levels = self.levels[done..=begun].iter().map(|level| Interval::point(*level));
        levels.reduce(Interval::hull).unwrap_or(Interval::ZERO)
    }

    /// By how much less the command is after a switching than before: what a later instant of it adds.
    pub(super) fn drop_at(&self, edge: usize) -> Interval {
        Interval::point(self.levels[edge]) - Interval::point(self.levels[edge + 1])
    }

    /// The largest magnitude.
    pub(super) fn largest(&self) -> f64 {
        self.levels.iter().fold(0.0, |largest, level| largest.max(level.abs()))
    }

    /// The levels, the first before any switching.
    pub(super) fn levels(&self) -> &[f64] {
        &self.levels
    }
}
