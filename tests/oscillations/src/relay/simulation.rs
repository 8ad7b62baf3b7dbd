//! The loop from switching to switching, exact between them.

use std::collections::VecDeque;

use super::control_loop::{Level, RelayLoop};
use super::motion::{Derivatives, Motion};
use crate::crossing::{Crossing, first_crossing};
use crate::scalar::Scalar;

/// Constants of a loop in one arithmetic.
#[derive(Clone, Debug)]
pub struct Simulator<S> {
    /// The loop.
    pub control_loop: RelayLoop,
    /// Equations of the plant.
    pub motion: Motion<S>,
    /// Dead time in s.
    pub delay: S,
    /// `reference + half_width`.
    pub upper: S,
    /// `reference - half_width`.
    pub lower: S,
    high: S,
    low: S,
    /// Whether both thresholds are one.
    ideal: bool,
}

/// State of the loop at an instant.
#[derive(Clone, Debug)]
pub struct State<S> {
    /// State of the plant.
    pub z: Vec<S>,
    /// What the relay commands now.
    pub command: Level,
    /// Times in s from now at which the commands under way reach the plant; each is the other level of the one before.
    pub due: VecDeque<S>,
    /// Whether the output stands on the threshold that has just been passed.
    pub on_threshold: bool,
}

impl<S: Scalar> State<S> {
    /// What the plant receives now.
    #[must_use]
    pub fn applied(&self) -> Level {
        if self.due.len().is_multiple_of(2) { self.command } else { self.command.other() }
    }
}

/// A step of the motion on which the plant's input is constant.
#[derive(Clone, Debug)]
pub struct Step<S> {
    /// Derivatives of z at its beginning.
    pub derivatives: Derivatives<S>,
    /// Its duration in s, to the switching or to its end.
    pub duration: S,
}

/// What ended a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Event<S> {
    /// The relay switched, this many seconds after the run began.
    Switched(S),
    /// No switching within the time given.
    Quiet,
    /// The output left the range given, in units of the output, and no switching came before.
    Escaped,
    /// The output came so near a threshold without passing it that the arithmetic cannot tell.
    Unclear,
}

/// Where a run ends without a switching.
#[derive(Clone, Copy, Debug)]
pub struct Limit {
    /// Time in s.
    pub duration: f64,
    /// Largest distance of the output from the reference, in its units.
    pub distance: f64,
}

impl<S: Scalar> Simulator<S> {
    /// The simulator of a checked loop.
    #[must_use]
    pub fn new(control_loop: &RelayLoop) -> Self {
        let (reference, half_width) = (S::from_f64(control_loop.reference), S::from_f64(control_loop.half_width));
        Self {
            control_loop: control_loop.clone(),
            motion: Motion::new(&control_loop.plant),
            delay: S::from_f64(control_loop.plant.delay),
            upper: reference + half_width,
            lower: reference - half_width,
            high: S::from_f64(control_loop.high),
            low: S::from_f64(control_loop.low),
            ideal: control_loop.half_width == 0.0,
        }
    }

    /// Value of a level.
    #[must_use]
    pub fn input(&self, level: Level) -> S {
        match level {
            Level::High => self.high,
            Level::Low => self.low,
        }
    }

    /// Moves the state to just after the next switching, or to the limit.
    pub fn run(&self, state: &mut State<S>, limit: Limit) -> Event<S> {
        self.run_observed(state, limit, |_| ())
    }

    /// The same; every step is shown.
    pub fn run_observed(&self, state: &mut State<S>, limit: Limit, mut observe: impl FnMut(&Step<S>)) -> Event<S> {
        let reference = S::from_f64(0.5) * (self.upper + self.lower);
        let (duration, distance) = (S::from_f64(limit.duration), S::from_f64(limit.distance));
        let mut elapsed = S::ZERO;
        while elapsed < duration {
            let due = state.due.front().copied().filter(|&due| due <= self.motion.step());
            let h = due.unwrap_or(self.motion.step());
            if h > S::ZERO {
                let derivatives = self.motion.derivatives(&state.z, self.input(state.applied()));
                let passed = self.passing(state, &derivatives, h);
                if matches!(passed, Crossing::Unclear) {
                    return Event::Unclear;
                }
                let step = Step { derivatives, duration: if let Crossing::At(place) = passed { place * h } else { h } };
                observe(&step);
                state.z = self.motion.state(&step.derivatives, step.duration);
                state.due.iter_mut().for_each(|due| *due = *due - step.duration);
                // A command that arrives with the switching ends a step before the output has left the threshold.
                state.on_threshold &= step.duration.to_f64() <= 1e6 * S::ROUNDING * self.motion.step().to_f64();
                elapsed = elapsed + step.duration;
                if matches!(passed, Crossing::At(_)) {
                    self.switch(state);
                    return Event::Switched(elapsed);
                }
            }
            if due.is_some() {
                state.due.pop_front();
            }
            let output = self.motion.output(&state.z);
            if !((output - reference).abs() < distance) {
                return Event::Escaped;
            }
        }
        Event::Quiet
    }

    fn switch(&self, state: &mut State<S>) {
        state.command = state.command.other();
        state.on_threshold = true;
        if self.delay > S::ZERO {
            state.due.push_back(self.delay);
        }
    }

    /// Where on a step of h, in units of h, the output passes the threshold that the relay waits for.
    fn passing(&self, state: &State<S>, derivatives: &Derivatives<S>, h: S) -> Crossing<S> {
        let mut series = self.motion.output_series(derivatives, h);
        match state.command {
            Level::High => {
                series.iter_mut().for_each(|c| *c = -*c);
                series[0] = series[0] + self.upper;
            }
            Level::Low => series[0] = series[0] - self.lower,
        }
        // On a threshold that is both: the distance is t times a polynomial, which tells when the output is back.
        let from = usize::from(self.ideal && state.on_threshold);
        first_crossing(&series[from..])
    }
}
