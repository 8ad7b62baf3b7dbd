//! What a linear process with dead time answers to a logged command: states of a structure, exact while the command is constant.

use nalgebra::{Matrix3, Vector3};

use super::Family;
use crate::experiment::Record;

/// Intervals that differ by less, relative to each other, have the same transition.
const SAME: f64 = 1e-9;

/// A structure of unit gain without its dead time: two states at most, and its input as the third.
#[derive(Clone, Copy, Debug)]
pub(super) struct StateSpace {
    family: Family,
    lags_s: [f64; 2],
}

impl StateSpace {
    /// Of a structure with these time constants.
    pub(super) fn new(family: Family, lags_s: &[f64]) -> Self {
        Self { family, lags_s: core::array::from_fn(|k| lags_s.get(k).copied().unwrap_or(0.0)) }
    }

    /// The states after a time of constant input, per state and input before.
    pub(super) fn transition(&self, time_s: f64) -> Matrix3<f64> {
        let [slow, fast] = self.lags_s.map(|lag_s| libm::exp(-time_s / lag_s));
        let late = time_s / self.lags_s[0];
        let [first, second] = match self.family {
            Family::FirstOrder => [[slow, 0.0, 1.0 - slow], [0.0; 3]],
            Family::SecondOrder | Family::SecondOrderZero => [[slow, 0.0, 1.0 - slow], [0.0, fast, 1.0 - fast]],
            // The second lag has the first as its input.
            Family::EqualLags => [[slow, 0.0, 1.0 - slow], [late * slow, slow, 1.0 - slow - late * slow]],
            Family::Integrator => [[1.0, 0.0, time_s], [0.0; 3]],
            Family::IntegratorLag => [[1.0, 0.0, time_s], [0.0, slow, 1.0 - slow]],
        };
        Matrix3::from_row_slice(&[first, second, [0.0, 0.0, 1.0]].concat())
    }

    /// The output per state. A zero is left out.
    pub(super) fn output(&self) -> Vector3<f64> {
        let [slow, fast] = self.lags_s;
        match self.family {
            Family::FirstOrder | Family::Integrator => Vector3::new(1.0, 0.0, 0.0),
            // 1/((a s + 1)(b s + 1)) = (a/(a s + 1) - b/(b s + 1))/(a - b).
            Family::SecondOrder | Family::SecondOrderZero => Vector3::new(slow, -fast, 0.0) / (slow - fast),
            Family::EqualLags => Vector3::new(0.0, 1.0, 0.0),
            // 1/(s (a s + 1)) = 1/s - a/(a s + 1).
            Family::IntegratorLag => Vector3::new(1.0, -slow, 0.0),
        }
    }

    /// Transitions over times, the last of which is kept.
    pub(super) fn transitions(&self) -> impl FnMut(f64) -> Matrix3<f64> + use<> {
        let (space, mut last) = (*self, (f64::NAN, Matrix3::zeros()));
        move |time_s| {
            if !((time_s - last.0).abs() <= SAME * time_s) {
                last = (time_s, space.transition(time_s));
            }
            last.1
        }
    }
}

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

    /// The states at every reading, from zero, under the command after a dead time.
    pub(super) fn states(&self, space: &StateSpace, dead_s: f64) -> Vec<Vector3<f64>> {
        let mut state = Vector3::new(0.0, 0.0, self.changes[0].1);
        let (mut now, mut next) = (0.0, 1);
        let (mut whole, mut part) = (space.transitions(), space.transitions());
        let mut since = 0.0;
        self.time_s
            .iter()
            .map(|&time| {
                while let Some(&(at, then)) = self.changes.get(next).filter(|change| change.0 + dead_s <= time) {
                    state = part((at + dead_s - now).max(0.0)) * state;
                    (now, next) = (now.max(at + dead_s), next + 1);
                    state[2] = then;
                }
                state = if now == since { whole(time - now) } else { part(time - now) } * state;
                (now, since) = (time, time);
                state
            })
            .collect()
    }

    /// The output at every reading after these states, under the input that they begin with.
    pub(super) fn free(&self, space: &StateSpace, begin: Vector3<f64>) -> Vec<f64> {
        let (mut transition, output) = (space.transitions(), space.output());
        let (mut state, mut now) = (begin, 0.0);
        self.time_s
            .iter()
            .map(|&time| {
                state = transition(time - now) * state;
                now = time;
                output.dot(&state)
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square wave after a dead time, by superposition of the answers to its steps; equal lags as the limit of two.
    #[test]
    fn states_are_sums_of_answers_to_steps() {
        let time_s: Vec<f64> = (0..40).map(|k| 0.25 * f64::from(k) + 0.05 * f64::from(k % 2)).collect();
        let input = (0..40).map(|k| f64::from(u8::from(k % 16 < 7))).collect();
        let record = Record::new(time_s.clone(), vec![0.0; 40], input).unwrap();
        let (command, dead_s, [slow, fast]) = (HeldCommand::of(&record), 0.6, [1.5, 0.4]);
        let lag = |lag_s: f64, t: f64| 1.0 - (-t / lag_s).exp();
        let two = |a: f64, b: f64, t: f64| (a * lag(a, t) - b * lag(b, t)) / (a - b);
        for (family, step) in [
            (Family::FirstOrder, &(|t| lag(slow, t)) as &dyn Fn(f64) -> f64),
            (Family::SecondOrder, &|t| two(slow, fast, t)),
            (Family::EqualLags, &|t| two(slow + 1e-4, slow - 1e-4, t)),
            (Family::Integrator, &|t| t),
            (Family::IntegratorLag, &|t| t - slow * lag(slow, t)),
        ] {
            let space = StateSpace::new(family, &[slow, fast]);
            let mut before = 0.0;
            let steps: Vec<(f64, f64)> =
                command.changes.iter().map(|(at, u)| (*at, u - core::mem::replace(&mut before, *u))).collect();
            for (time, state) in time_s.iter().zip(command.states(&space, dead_s)) {
                // The first level has been there before the record and acts from its beginning.
                let since = |at: f64| if at > 0.0 { (time - at - dead_s).max(0.0) } else { *time };
                let expected: f64 = steps.iter().map(|(at, height)| height * step(since(*at))).sum();
                let found = space.output().dot(&state);
                assert!((found - expected).abs() < 1e-6, "{family:?} at {time}: {found} for {expected}");
            }
        }
    }
}
