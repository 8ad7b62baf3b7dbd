//! Cycles of a relay experiment, found sample by sample.

use super::peak::{Peak, Recent};
use crate::numeric::Scalar;

/// One cycle: from one change of the command to positive to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct Cycle<S> {
    /// When it began, in s.
    pub begin_s: S,
    /// Its period T, in s.
    pub period_s: S,
    /// Time with the positive command, t_plus, in s.
    pub time_positive_s: S,
    /// Largest output, interpolated between samples.
    pub maximum: S,
    /// Smallest output, interpolated between samples.
    pub minimum: S,
    /// Output at the sample with the first negative command.
    pub upper_level: S,
    /// Output at the sample with the first positive command, at the cycle's end.
    pub lower_level: S,
}

impl<S: Scalar> Cycle<S> {
    /// Half the peak-to-peak range, X_m.
    pub fn amplitude(&self) -> S {
        (self.maximum - self.minimum) / S::two()
    }
    /// Time with the negative command, t_minus, in s.
    pub fn time_negative_s(&self) -> S {
        self.period_s - self.time_positive_s
    }
    /// Half the distance of the levels at which the command really switched, x_a* (section 4.3).
    pub fn switch_level(&self) -> S {
        (self.upper_level - self.lower_level) / S::two()
    }
    /// Middle of the range against the middle of the switching levels, x_0.
    pub fn bias(&self) -> S {
        (self.maximum + self.minimum) / S::two() - self.reference()
    }
    /// Middle of the switching levels: the reference, as the relay saw it.
    pub fn reference(&self) -> S {
        (self.upper_level + self.lower_level) / S::two()
    }
}

/// Finds cycles in samples as they come. Constant memory, no allocation.
///
/// ```
/// use selfosc::features::Cycles;
/// let mut cycles = Cycles::new(0.0);
/// let mut found = 0;
/// for i in 0..400 {
///     let angle = 0.1 * f64::from(i);
///     // The command is a quarter of a cycle ahead of the output.
///     found += usize::from(cycles.step(angle, -angle.cos(), angle.cos()).is_some());
/// }
/// assert_eq!(found, 5);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Cycles<S> {
    threshold: S,
    positive: Option<bool>,
    /// Whether there was a change to positive, and one to negative since.
    begun: bool,
    turned: bool,
    /// Time of the change to positive.
    begin_s: S,
    /// Change to negative: time and level.
    change: (S, S),
    recent: Recent<S>,
    maximum: Peak<S>,
    minimum: Peak<S>,
    switchings: u32,
}

impl<S: Scalar> Cycles<S> {
    /// Commands above `threshold` are positive, others negative: give the middle of the relay's two levels.
    pub fn new(threshold: S) -> Self {
        Self {
            threshold,
            positive: None,
            begun: false,
            turned: false,
            begin_s: S::zero(),
            change: (S::zero(), S::zero()),
            recent: Recent::new(),
            maximum: Peak::new(),
            minimum: Peak::new(),
            switchings: 0,
        }
    }

    /// Changes of the command so far.
    pub fn switchings(&self) -> u32 {
        self.switchings
    }

    /// Time of the last change of the command, in s.
    pub fn last_change_s(&self) -> Option<S> {
        let last_s = if self.positive == Some(true) { self.begin_s } else { self.change.0 };
        (self.switchings > 0).then_some(last_s)
    }

    /// Takes the next sample; the cycle that it completes, if it does.
    ///
    /// Times are taken where the command is first seen changed; a change between samples is late by up to an interval,
    /// nearly the same each time: durations are right on average.
    ///
    /// Rounding: durations and levels are a single operation on the arguments, right to half a unit in the last place. An extreme between
    /// samples answers to its neighbours' noise, and more or less to rounding: for nine samples within 1/256 of `1 - s^2/2`, `s` from
    /// -1 to 1, at times within 1/4096 s of equal distances from 4 to 5 s, it is within 1.8e-14 of the parabola's in f64 and within 9.5e-6 in f32.
    /// Assumptions: `spec/rounding.md`.
    pub fn step(&mut self, time_s: S, output: S, input: S) -> Option<Cycle<S>> {
        let positive = input > self.threshold;
        let changed = self.positive.is_some_and(|before| before != positive);
        self.positive = Some(positive);
        let mut complete = None;
        if changed {
            self.switchings = self.switchings.saturating_add(1);
            if positive {
                complete = self.complete(time_s, output);
                (self.begun, self.turned, self.begin_s) = (true, false, time_s);
                // The positive command lasts from the upswing's beginning: the minimum lies after its start.
                self.minimum = Peak::new();
            } else {
                (self.turned, self.change) = (true, (time_s, output));
                self.maximum = Peak::new();
            }
        }
        self.maximum.push(time_s, output, &self.recent, S::one());
        self.minimum.push(time_s, output, &self.recent, -S::one());
        self.recent.push(time_s, output);
        complete
    }

    #[cold]
    fn complete(&mut self, time_s: S, output: S) -> Option<Cycle<S>> {
        if !(self.begun && self.turned) {
            return None;
        }
        let (begin_s, (change_s, upper_level)) = (self.begin_s, self.change);
        let period_s = time_s - begin_s;
        // A parabola is true to a sinusoid's peak for about a twelfth of the period on either side.
        let reach = period_s / S::from_f64(12.0);
        Some(Cycle {
            begin_s,
            period_s,
            time_positive_s: change_s - begin_s,
            maximum: self.maximum.value(&self.recent, S::one(), reach)?,
            minimum: -self.minimum.value(&self.recent, -S::one(), reach)?,
            upper_level,
            lower_level: output,
        })
    }
}
