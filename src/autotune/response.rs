//! What a linear process with dead time answers to a logged command, in closed form between changes of the command.

use crate::experiment::Record;

/// A command that is constant between its changes, and the instants at which the output was read.
#[derive(Clone, Debug)]
pub(super) struct HeldCommand {
    /// Instants and values of the changes, the first at the record's beginning.
    changes: Vec<(f64, f64)>,
    time_s: Vec<f64>,
}

impl HeldCommand {
    /// The command of a record, each value from its row's time on; times count from the first row.
    pub(super) fn of(record: &Record) -> Self {
        let begin_s = record.time_s()[0];
        let time_s: Vec<f64> = record.time_s().iter().map(|time| time - begin_s).collect();
        let mut changes: Vec<(f64, f64)> = Vec::new();
        for (time, value) in time_s.iter().zip(record.input()) {
            if changes.last().is_none_or(|(_, last)| last != value) {
                changes.push((*time, *value));
            }
        }
        Self { changes, time_s }
    }

    pub(super) fn time_s(&self) -> &[f64] {
        &self.time_s
    }

    /// Instants of the changes after the first.
    pub(super) fn changes_s(&self) -> impl Iterator<Item = f64> + '_ {
        self.changes.iter().skip(1).map(|change| change.0)
    }

    /// `state' = rate(state, u(t - delay))` from zero, at every reading; `advance` moves the state over a time of constant command.
    fn answer<S: Copy>(
        &self,
        delay_s: f64,
        zero: S,
        advance: impl Fn(S, f64, f64) -> S,
        read: impl Fn(S) -> f64,
    ) -> Vec<f64> {
        let (mut state, mut now, mut next) = (zero, 0.0, 1);
        let mut value = self.changes[0].1;
        self.time_s
            .iter()
            .map(|&time| {
                while let Some(&(at, then)) = self.changes.get(next).filter(|change| change.0 + delay_s <= time) {
                    state = advance(state, value, (at + delay_s - now).max(0.0));
                    (now, value, next) = (now.max(at + delay_s), then, next + 1);
                }
                state = advance(state, value, time - now);
                now = time;
                read(state)
            })
            .collect()
    }

    /// `1/(lag_s s + 1)`.
    pub(super) fn lagged(&self, delay_s: f64, lag_s: f64) -> Vec<f64> {
        self.answer(delay_s, 0.0, |x, u, time_s| u + (x - u) * libm::exp(-time_s / lag_s), |x| x)
    }

    /// `1/(lag_s s + 1)^2`.
    pub(super) fn lagged_twice(&self, delay_s: f64, lag_s: f64) -> Vec<f64> {
        let advance = |[x, y]: [f64; 2], u: f64, time_s: f64| {
            let (share, decay) = (time_s / lag_s, libm::exp(-time_s / lag_s));
            [u + (x - u) * decay, u + (y - u + (x - u) * share) * decay]
        };
        self.answer(delay_s, [0.0; 2], advance, |[_, y]| y)
    }

    /// `1/s`.
    pub(super) fn integrated(&self, delay_s: f64) -> Vec<f64> {
        self.answer(delay_s, 0.0, |x, u, time_s| x + u * time_s, |x| x)
    }
}
