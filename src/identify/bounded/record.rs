//! A record as constraints: stamps, readings with their largest errors, and the command.

use crate::experiment::Record;
use crate::numeric::Interval;

/// A held command: levels, and the range of each instant at which it switches.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Command {
    /// The first before any switching.
    pub(super) levels: Vec<f64>,
    /// The range of the instant of each switching; a point where it is certain.
    pub(super) spans: Vec<Interval>,
}

impl Command {
    /// The command of a record: it switches at the sample with the new value, or `anywhere` since the sample before. The stamps of both
    /// are off by at most J: the switching is within `[first - J, last + J]`.
    pub(super) fn of(record: &Record, anywhere: bool, jitter_s: f64) -> Self {
        let (time, input) = (record.time_s(), record.input());
        let (mut levels, mut spans) = (vec![input[0]], Vec::new());
        for after in 1..record.samples() {
            if input[after] != input[after - 1] {
                levels.push(input[after]);
                let first = if anywhere { time[after - 1] } else { time[after] };
                let span = Interval::point(first).hull(Interval::point(time[after]));
                spans.push(if jitter_s > 0.0 { span + Interval::symmetric(jitter_s) } else { span });
            }
        }
        Self { levels, spans }
    }

    /// Number of switchings.
    pub(super) fn edges(&self) -> usize {
        self.spans.len()
    }

    /// Number of switchings at unknown instants: all, or none.
    pub(super) fn unknown_instants(&self) -> usize {
        if self.spans.iter().all(|span| span.is_point()) { 0 } else { self.edges() }
    }

    /// The instants at which each switching acts on the vehicle.
    pub(super) fn windows(&self, delay_s: Interval) -> impl Iterator<Item = Interval> {
        self.spans.iter().map(move |span| *span + delay_s)
    }

    /// The range of the levels after `done` switchings to after `begun` ones.
    pub(super) fn between(&self, done: usize, begun: usize) -> Interval {
        let levels = self.levels[done..=begun].iter().map(|level| Interval::point(*level));
        levels.reduce(Interval::hull).unwrap_or(Interval::ZERO)
    }

    /// Level before a switching less that after it.
    pub(super) fn drop_at(&self, edge: usize) -> Interval {
        Interval::point(self.levels[edge]) - Interval::point(self.levels[edge + 1])
    }

    /// The largest magnitude.
    pub(super) fn largest(&self) -> f64 {
        self.levels.iter().fold(0.0, |largest, level| largest.max(level.abs()))
    }
}

/// One record.
#[derive(Clone, Debug)]
pub(super) struct Readings {
    pub(super) time_s: Vec<f64>,
    pub(super) value: Vec<f64>,
    /// Largest error of a reading, in units of the output.
    pub(super) error: f64,
    /// Largest error of a stamp.
    pub(super) jitter_s: f64,
    pub(super) command: Command,
}

impl Readings {
    /// The stamp after which every command that acts is in the log: `t - delay >= t_0 + J`.
    pub(super) fn acted_s(&self, delay_s: Interval) -> f64 {
        (Interval::point(self.time_s[0]) + delay_s + Interval::point(self.jitter_s)).upper()
    }

    /// Time between two samples, each stamp off by at most J.
    pub(super) fn lasted(&self, first: usize, last: usize) -> Interval {
        let lasted = Interval::point(self.time_s[last]) - Interval::point(self.time_s[first]);
        if self.jitter_s > 0.0 { lasted + Interval::symmetric(2.0 * self.jitter_s) } else { lasted }
    }

    /// Mean velocity between two samples.
    pub(super) fn mean_velocity(&self, first: usize, last: usize) -> Interval {
        let twice = Interval::symmetric(2.0 * self.error);
        let way = Interval::point(self.value[last]) - Interval::point(self.value[first]) + twice;
        way / self.lasted(first, last)
    }

    /// Orders of magnitude.
    pub(super) fn scales(&self) -> Scales {
        let (time, value) = (&self.time_s, &self.value);
        let (low, high) = value.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
        let lasted = time[time.len() - 1] - time[0];
        let half_period_s = lasted / (self.command.edges() + 1) as f64;
        let (mut squares, mut count, mut fastest) = (0.0, 0.0, 0.0f64);
        let mut first = 0;
        for last in 1..time.len() {
            while time[last] - time[first + 1] > 0.1 * half_period_s && first + 1 < last {
                first += 1;
            }
            let speed = (value[last] - value[first]).abs() / (time[last] - time[first]);
            let uncertain = 2.0 * self.error / (time[last] - time[first]);
            squares += speed * (speed - uncertain).max(0.0);
            count += 1.0;
            fastest = fastest.max(speed + uncertain);
        }
        let amplitude = (0.5 * (high - low)).max(self.error);
        let speed = libm::sqrt(squares / count).max(amplitude / lasted);
        Scales { amplitude, half_period_s, force: self.command.largest(), speed, fastest }
    }
}

/// Orders of magnitude of a record.
#[derive(Clone, Debug)]
pub(super) struct Scales {
    /// Half the range of the output.
    pub(super) amplitude: f64,
    /// Mean time between two switchings.
    pub(super) half_period_s: f64,
    pub(super) force: f64,
    /// Root mean square of the speed.
    pub(super) speed: f64,
    /// The largest mean speed over a tenth of a half-period.
    pub(super) fastest: f64,
}
