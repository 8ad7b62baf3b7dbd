//! The controller as it runs: one step for each measurement.

use super::reference::{FeedForward, Guided};
use super::{ControlError, Gains, Structure};
use crate::numeric::{Limit, Scalar, domain};

/// A controller with its memory. No allocation; a step costs a few dozen operations.
///
/// The derivative acts on the measurement through a filter that is stable for every interval. An integral that drives
/// the command past a limit is led back (back-calculation with the time constant `sqrt(K_d/K_i)`, `K_p/K_i` without
/// derivative; Astrom and Hagglund). What is not a number changes nothing: the command is held, and the [`ControlFault`]
/// named. The time goes on meanwhile: the next good measurement is met with the whole time since the last one.
/// [`with_longest_hold`](Controller::with_longest_hold) sets how long a command may be held before it is a neutral one.
///
/// ```
/// use selfosc::control::{Controller, Structure, Tuning};
/// use selfosc::plant::DragAxis;
/// let yaw = DragAxis::<f32>::mixed(0.033, 0.01, 0.06)?.with_delay_s(0.2)?;
/// let tuning = Tuning::new(&yaw, Structure::Pd, 0.8)?;
/// let mut heading = Controller::new(tuning.gains()).with_limits(-0.2, 0.2)?.on_circle(core::f32::consts::TAU)?;
/// let step = heading.step(3.1, -3.1, 0.1); // the short way, through pi: 0.083 rad to the left
/// assert!(step.command < 0.0 && step.command > -0.02);
/// assert_eq!(heading.step(f32::NAN, -3.1, 0.1).command, step.command);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Controller<T> {
    gains: Gains<T>,
    limits: Option<(T, T)>,
    turn: Option<T>,
    feed_forward: Option<FeedForward<T>>,
    /// The longest hold in s, and the command after it.
    stale: Option<(T, T)>,
    command: T,
    memory: Option<Memory<T>>,
    /// Time since the last good step, and the time that step took, in s.
    held_s: T,
    dt_s: T,
}

/// What a controller remembers of the past.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Memory<T> {
    measurement: T,
    /// Filtered speed, against that of the guided reference.
    speed: T,
    /// Integral action; that of an I-PD includes its proportional action, which keeps it small.
    integral: T,
    guided: Guided<T>,
}

/// What a step gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlStep<T> {
    /// The command, within the limits, a number in any case.
    pub command: T,
    /// Whether a limit holds the command back.
    pub limited: bool,
    /// Why the command is held, if it is.
    pub fault: Option<ControlFault>,
}

/// Why a step held the command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ControlFault {
    /// The reference is not a finite number.
    Reference,
    /// The measurement is not a finite number.
    Measurement,
    /// The interval is not a finite number above zero.
    Interval,
    /// The command would not be a finite number.
    Overflow,
}

impl<T: Scalar> Controller<T> {
    /// Without limits, on a line, without feed-forward; the command is zero before the first step.
    pub fn new(gains: &Gains<T>) -> Self {
        let zero = T::zero();
        Self {
            gains: *gains,
            limits: None,
            turn: None,
            feed_forward: None,
            stale: None,
            command: zero,
            memory: None,
            held_s: zero,
            dt_s: zero,
        }
    }

    /// The same with limits on the command. Starts anew.
    ///
    /// # Errors
    /// [`ControlError::OutOfDomain`] unless `lower < upper`, both finite.
    pub fn with_limits(self, lower: T, upper: T) -> Result<Self, ControlError> {
        domain::finite("lower limit of the command", lower, "command units")?;
        let limit = Limit::Above(lower.value());
        domain::require("upper limit of the command", upper, "command units", limit, "give the lower limit first")?;
        let limited = Self { limits: Some((lower, upper)), memory: None, ..self };
        Ok(Self { command: limited.clamp(T::zero()), ..limited })
    }

    /// The same for a coordinate that begins again after `turn`: `2 pi` for a heading in radians, 360 in degrees.
    /// Errors take the short way, and readings may jump by whole turns. Starts anew.
    ///
    /// # Errors
    /// [`ControlError::OutOfDomain`] unless the turn is positive and finite.
    pub fn on_circle(self, turn: T) -> Result<Self, ControlError> {
        domain::positive("length of a turn", turn, "output units")?;
        Ok(Self { turn: Some(turn), memory: None, ..self })
    }

    /// The same along a guided reference, with the force that takes. Starts anew, from the first measurement at rest.
    #[must_use]
    pub fn with_feed_forward(self, feed_forward: FeedForward<T>) -> Self {
        Self { feed_forward: Some(feed_forward), memory: None, ..self }
    }

    /// The same that holds a command for no longer than `hold_s` without a good step. After that it gives `neutral_command`, cut to
    /// the limits, and starts anew with the next good step. An interval that is no number counts as the last good one did.
    ///
    /// ```
    /// use selfosc::control::{Controller, Gains, Structure};
    /// let gains = Gains::new(Structure::Pd, 1.0, 0.0, 0.5, 0.1)?;
    /// let mut depth = Controller::new(&gains).with_longest_hold(0.5, 0.0)?;
    /// let held = depth.step(1.0, 0.0, 0.2).command;
    /// assert_eq!(depth.step(1.0, f64::NAN, 0.2).command, held);
    /// assert_eq!(depth.step(1.0, f64::NAN, 0.2).command, held);
    /// assert_eq!(depth.step(1.0, f64::NAN, 0.2).command, 0.0); // 0.6 s since the last measurement
    /// # Ok::<(), selfosc::control::ControlError>(())
    /// ```
    ///
    /// # Errors
    /// [`ControlError::OutOfDomain`] unless the time is zero or more and both are finite.
    pub fn with_longest_hold(self, hold_s: T, neutral_command: T) -> Result<Self, ControlError> {
        domain::non_negative("longest hold", hold_s, "s")?;
        domain::finite("neutral command", neutral_command, "command units")?;
        Ok(Self { stale: Some((hold_s, neutral_command)), ..self })
    }

    /// Forgets everything but its settings.
    pub fn reset(&mut self) {
        (self.memory, self.held_s) = (None, T::zero());
        self.command = self.clamp(T::zero());
    }

    /// The next command, given the reference, the measurement, and the time since the step before (s), good or not. The first
    /// step after a start has no speed to go by.
    ///
    /// Rounding: for all floats with gains `K_p` and `K_d` from 0.5 to 2, `K_i`, where there is one, from 0.125 to 0.5, a filter of
    /// 0.0625 to 0.5 s, steps of 0.0625 to 0.25 s, and reference, measurement, the measurement before, filtered speed and integral
    /// up to one either way, the command of a step that no limit holds back, without feed-forward, is within 5.5e-14 of the exact
    /// one in f64 and within 2.9e-5 in f32; the integral that it leaves within 2.8e-15 and 1.5e-6. On a circle of 8 the same.
    /// `spec/rounding.md` says what that rests on.
    pub fn step(&mut self, reference: T, measurement: T, dt_s: T) -> ControlStep<T> {
        let sound = dt_s > T::zero() && dt_s.is_finite();
        // Time that the last good step does not know of.
        let passed_s = self.held_s + if sound { dt_s } else { self.dt_s };
        let fault = if !measurement.is_finite() {
            ControlFault::Measurement
        } else if !reference.is_finite() {
            ControlFault::Reference
        } else if !sound {
            ControlFault::Interval
        } else {
            // A start knows of no time before.
            let step_s = if self.memory.is_some() { passed_s } else { dt_s };
            let (wanted, memory) = self.wanted(reference, measurement, step_s);
            let (command, limited) = (self.clamp(wanted), self.limited(wanted));
            let excess = if limited { command - wanted } else { T::zero() };
            if let Some(memory) = self.led_back(memory, excess, step_s).filter(|_| wanted.is_finite()) {
                (self.command, self.memory) = (command, Some(memory));
                (self.held_s, self.dt_s) = (T::zero(), dt_s);
                return ControlStep { command, limited, fault: None };
            }
            ControlFault::Overflow
        };
        self.hold(passed_s);
        ControlStep { command: self.command, limited: false, fault: Some(fault) }
    }

    /// Goes on without a good step, until that has been for too long.
    fn hold(&mut self, passed_s: T) {
        self.held_s = passed_s;
        let stale = self.stale.filter(|(hold_s, _)| !(passed_s <= *hold_s));
        if stale.is_some() || !passed_s.is_finite() {
            self.memory = None;
        }
        if let Some((_, neutral_command)) = stale {
            self.command = self.clamp(neutral_command);
        }
    }

    /// The command without limits, and the memory that it leaves.
    fn wanted(&self, reference: T, measurement: T, dt_s: T) -> (T, Memory<T>) {
        let (zero, gains) = (T::zero(), &self.gains);
        let mut memory = self.memory.unwrap_or(Memory {
            measurement,
            speed: zero,
            integral: zero,
            guided: Guided::at_rest(measurement),
        });
        let moved = self.short_way(measurement - memory.measurement);
        memory.measurement = measurement;
        let (mut goal, mut goal_speed, mut force) = (reference, zero, zero);
        if let Some(feed_forward) = &self.feed_forward {
            let ahead = self.short_way(reference - memory.guided.position);
            memory.guided = feed_forward.advance(&memory.guided, ahead, dt_s);
            force = feed_forward.force(&memory.guided);
            goal = memory.guided.position - memory.guided.behind;
            goal_speed = feed_forward.expected_speed(&memory.guided);
            memory.guided.position = self.short_way(memory.guided.position);
        }
        let error = self.short_way(goal - measurement);
        let speed = moved / dt_s - goal_speed;
        memory.speed = memory.speed + (speed - memory.speed) * dt_s / (gains.filter_s() + dt_s);
        let proportional = match gains.structure() {
            Structure::Pd | Structure::Pid => gains.proportional() * error,
            Structure::Ipd => {
                memory.integral = memory.integral - gains.proportional() * (moved - goal_speed * dt_s);
                zero
            }
        };
        memory.integral = memory.integral + gains.integral() * error * dt_s;
        (proportional + memory.integral - gains.derivative() * memory.speed + force, memory)
    }

    /// The memory after the limits have held the command back by `excess`; `None` where it is no number.
    fn led_back(&self, memory: Memory<T>, excess: T, dt_s: T) -> Option<Memory<T>> {
        let gains = &self.gains;
        let mut integral = memory.integral;
        if gains.integral() > T::zero() {
            let tracking_s = if gains.derivative() > T::zero() {
                (gains.derivative() / gains.integral()).sqrt()
            } else {
                gains.proportional() / gains.integral()
            };
            integral = integral + excess * dt_s / (tracking_s + dt_s);
        }
        let finite = [integral, memory.speed, memory.guided.position, memory.guided.speed, memory.guided.behind];
        finite.iter().all(|value| value.is_finite()).then_some(Memory { integral, ..memory })
    }

    fn clamp(&self, command: T) -> T {
        self.limits.map_or(command, |(lower, upper)| command.max(lower).min(upper))
    }

    /// Whether a limit holds a command back.
    fn limited(&self, wanted: T) -> bool {
        self.limits.is_some_and(|(lower, upper)| wanted < lower || wanted > upper)
    }

    /// The representative nearest to zero on a circle; the number itself on a line.
    fn short_way(&self, way: T) -> T {
        self.turn.map_or(way, |turn| way - turn * (way / turn + T::from_f64(0.5)).floor())
    }
}

#[cfg(all(test, feature = "std"))]
mod tests;
