//! The experiment as the vehicle calls it.

use super::steadiness::{Judge, Steadiness};
use super::supervisor::Supervisor;
use super::{Outcome, Phase, Protocol, Step};
use crate::numeric::{OutOfDomain, Scalar};

/// A relay experiment that runs sample by sample.
///
/// Less than 1 KiB in f64, without allocation. Each call takes a bounded time: a fixed number of operations, some two hundred
/// more where a cycle ends. Count time from the start of the experiment: a clock that is too far on for the arithmetic to tell an
/// eighth of the interval, as in f32 at 100 Hz after four hours, is a fault with the first sample.
///
/// ```
/// use selfosc::on_board::{Experiment, Phase, Protocol};
/// use selfosc::plant::{DragAxis, State};
/// // A vehicle in simulation: heading in rad, torque in N m.
/// let axis = DragAxis::linear(0.04, 0.03)?;
/// let mut state = State { position: 0.0, velocity: 0.0 };
/// let mut experiment = Experiment::new(Protocol::heading_rad(0.02, 0.2, 0.05))?;
/// for sample in 0..4000 {
///     let step = experiment.step(state.position, 0.05 * f64::from(sample));
///     if step.phase != Phase::Running {
///         break;
///     }
///     state = axis.advance(state, step.command, 0.05);
/// }
/// let outcome = experiment.outcome().ok_or("not done")?;
/// // The command is held, for half an interval on average.
/// let found = outcome.exact(selfosc::identify::DragLaw::Linear, 0.0)?;
/// assert!((found.alpha() / 0.04 - 1.0).abs() < 0.05);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Experiment<T> {
    supervisor: Supervisor<T>,
    steadiness: Steadiness<T>,
}

impl<T: Scalar> Experiment<T> {
    /// An experiment that starts with its first sample.
    ///
    /// # Errors
    /// [`OutOfDomain`] that names the number of the protocol that is outside its domain.
    pub fn new(protocol: Protocol<T>) -> Result<Self, OutOfDomain> {
        Ok(Self { supervisor: Supervisor::new(protocol)?, steadiness: Steadiness::new(&protocol) })
    }

    /// Takes a reading and its time in s; the command to give now.
    ///
    /// Any values are accepted: a value that no sound sensor or clock gives is a fault. Then, as after the end and
    /// after an abort, the command is neutral until [`restart`](Self::restart).
    pub fn step(&mut self, reading: T, time_s: T) -> Step<T> {
        let relay_level = self.supervisor.relay_level();
        self.supervisor.step(reading, time_s, &mut Judge { steadiness: &mut self.steadiness, relay_level })
    }

    /// The command at a time at which there is no reading: for a timer next to a driver that may block, which would
    /// otherwise leave the last command standing. Readings that stay out for more than [`Protocol::LONGEST_GAP`] are a
    /// fault; before the first reading nothing is.
    ///
    /// ```
    /// use selfosc::on_board::{Experiment, Protocol};
    /// let mut experiment = Experiment::new(Protocol::heading_rad(0.02, 0.2, 0.05))?;
    /// assert_eq!(experiment.step(0.0, 0.0).command, 0.02);
    /// assert_eq!(experiment.tick(0.1).command, 0.02);
    /// assert_eq!(experiment.tick(0.3).command, 0.0); // four intervals are over
    /// # Ok::<(), selfosc::numeric::OutOfDomain>(())
    /// ```
    pub fn tick(&mut self, time_s: T) -> Step<T> {
        self.supervisor.tick(time_s)
    }

    /// Stops a running experiment: the command is neutral from now on. An end or a fault stays.
    pub fn abort(&mut self) {
        self.supervisor.abort();
    }

    /// Begins anew, with the relay parameters of the first attempt and the next sample.
    ///
    /// # Errors
    /// None in practice: the protocol was accepted before.
    pub fn restart(&mut self) -> Result<(), OutOfDomain> {
        *self = Self::new(*self.supervisor.protocol())?;
        Ok(())
    }

    /// The command that holds now: neutral unless running.
    pub fn command(&self) -> T {
        self.supervisor.command()
    }

    /// Where it stands.
    pub fn phase(&self) -> Phase {
        self.supervisor.phase()
    }

    /// The coordinate that the relay sees: a heading without its jumps, the integral of a speed. `None` before the first
    /// sample.
    pub fn position(&self) -> Option<T> {
        self.supervisor.position()
    }

    /// Its settings.
    pub fn protocol(&self) -> &Protocol<T> {
        self.supervisor.protocol()
    }

    /// Attempt under way, or the last attempt: 1, 2, ...
    pub fn attempt(&self) -> u8 {
        self.supervisor.attempt()
    }

    /// The result, once the experiment is [`Done`](Phase::Done).
    pub fn outcome(&self) -> Option<Outcome<T>> {
        let supervisor = &self.supervisor;
        let features = self.steadiness.features().filter(|_| supervisor.phase() == Phase::Done)?;
        Some(Outcome::new(features, supervisor.relay_level(), supervisor.half_width(), supervisor.attempt()))
    }
}

/// The memory for a microcontroller, limits and settings included.
const _: () = assert!(core::mem::size_of::<Experiment<f64>>() < 1024);
