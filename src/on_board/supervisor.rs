//! The state machine: relay, time-outs, attempts, faults. What the cycles say, it is told.

use super::sensor::Sensor;
use super::{Fault, Protocol};
use crate::experiment::RelayState;
use crate::numeric::OutOfDomain;
use crate::numeric::Scalar;

/// Where an experiment stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase {
    /// The relay acts.
    Running,
    /// Steady cycles were found; the command is neutral until a restart.
    Done,
    /// It was told to stop; the command is neutral until a restart.
    Aborted,
    /// Something went wrong; the command is neutral until a restart.
    Failed(Fault),
}

/// The answer to a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step<T> {
    /// Command to give now, within the limits whatever the phase.
    pub command: T,
    /// Where the experiment stands after this sample.
    pub phase: Phase,
}

/// What the cycles say after a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Observation {
    /// No cycle ended with it.
    Between,
    /// A cycle ended, and they are not alike yet.
    Unsteady,
    /// They are alike.
    Steady,
    /// They are alike, and condition 40 is not met.
    Condition40,
}

/// Whoever looks at the cycles.
pub(crate) trait Observer<T> {
    /// Forgets all cycles: an attempt with other relay parameters begins.
    fn begin(&mut self);
    /// Takes a sample with the command given upon it.
    fn sample(&mut self, time_s: T, position: T, command: T) -> Observation;
}

/// Why an attempt failed.
#[derive(Clone, Copy, PartialEq)]
enum Failure {
    NoSwitching,
    NotConverged,
    Condition40,
}

/// All that decides on what a supervisor does next, its protocol being given; exact in its numbers.
#[cfg(feature = "std")]
pub(crate) type Key = (&'static str, [u64; 5], Option<[u64; 4]>, [u8; 2]);

/// The experiment but for its cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Supervisor<T> {
    protocol: Protocol<T>,
    phase: Phase,
    relay: RelayState<T>,
    /// `None` before the first sample.
    sensor: Option<Sensor<T>>,
    started_s: T,
    /// Last switching, or beginning of the attempt.
    switched_s: T,
    attempt: u8,
    cycles: u8,
}

impl<T: Scalar> Supervisor<T> {
    pub(crate) fn new(protocol: Protocol<T>) -> Result<Self, OutOfDomain> {
        let protocol = protocol.checked()?;
        let relay = protocol.relay(protocol.relay_level, protocol.half_width)?;
        Ok(Self {
            protocol,
            phase: Phase::Running,
            relay: RelayState::new(relay, false),
            sensor: None,
            started_s: T::zero(),
            switched_s: T::zero(),
            attempt: 1,
            cycles: 0,
        })
    }

    /// The command upon a sample.
    pub(crate) fn step(&mut self, reading: T, time_s: T, observer: &mut impl Observer<T>) -> Step<T> {
        if self.phase == Phase::Running
            && let Err(fault) = self.run(reading, time_s, observer)
        {
            self.phase = Phase::Failed(fault);
        }
        Step { command: self.command(), phase: self.phase }
    }

    /// Stops a running experiment.
    pub(crate) fn abort(&mut self) {
        if self.phase == Phase::Running {
            self.phase = Phase::Aborted;
        }
    }

    /// The command that holds now.
    pub(crate) fn command(&self) -> T {
        let protocol = &self.protocol;
        let driving = self.phase == Phase::Running && self.sensor.is_some();
        let command = if driving { self.relay.output() } else { protocol.neutral_command };
        // The levels lie within the limits up to rounding.
        command.max(protocol.lowest_command).min(protocol.highest_command)
    }

    pub(crate) fn phase(&self) -> Phase {
        self.phase
    }
    pub(crate) fn protocol(&self) -> &Protocol<T> {
        &self.protocol
    }
    pub(crate) fn attempt(&self) -> u8 {
        self.attempt
    }
    pub(crate) fn relay_level(&self) -> T {
        self.relay.characteristic().level()
    }
    pub(crate) fn half_width(&self) -> T {
        self.relay.characteristic().half_width()
    }
    /// The coordinate that the relay sees, once there was a sample.
    pub(crate) fn position(&self) -> Option<T> {
        self.sensor.map(|sensor| sensor.position())
    }

    /// The state, for a table of visited ones. Of a fault its name: the numbers in it decide nothing.
    #[cfg(feature = "std")]
    pub(crate) fn key(&self) -> Key {
        let Self { protocol: _, phase, relay, sensor, started_s, switched_s, attempt, cycles } = self;
        let phase = match phase {
            Phase::Running => "running",
            Phase::Done => "done",
            Phase::Aborted => "aborted",
            Phase::Failed(fault) => fault.code(),
        };
        let numbers = [
            relay.output(),
            relay.characteristic().level(),
            relay.characteristic().half_width(),
            *started_s,
            *switched_s,
        ];
        let numbers = numbers.map(|value| value.value().to_bits());
        (phase, numbers, sensor.map(|sensor| sensor.key()), [*attempt, *cycles])
    }

    fn run(&mut self, reading: T, time_s: T, observer: &mut impl Observer<T>) -> Result<(), Fault> {
        let sensor = match &self.sensor {
            Some(sensor) => sensor.next(&self.protocol, reading, time_s)?,
            None => {
                let first = Sensor::first(&self.protocol, reading, time_s)?;
                (self.started_s, self.switched_s) = (time_s, time_s);
                self.relay = RelayState::new(*self.relay.characteristic(), first.position() <= self.protocol.reference);
                first
            }
        };
        self.sensor = Some(sensor);
        if time_s - self.started_s >= self.protocol.duration_s {
            return Err(Fault::Overtime { duration_s: self.protocol.duration_s.value() });
        }
        let before = self.relay.output();
        let command = self.relay.step(self.protocol.reference - sensor.position());
        if command != before {
            self.switched_s = time_s;
        }
        match observer.sample(time_s, sensor.position(), command) {
            Observation::Steady => {
                self.phase = Phase::Done;
                Ok(())
            }
            Observation::Condition40 => self.retry(Failure::Condition40, time_s, observer),
            Observation::Unsteady => {
                self.cycles = self.cycles.saturating_add(1);
                if self.cycles < self.protocol.most_cycles {
                    return Ok(());
                }
                self.retry(Failure::NotConverged, time_s, observer)
            }
            Observation::Between if time_s - self.switched_s > self.protocol.patience_s => {
                self.retry(Failure::NoSwitching, time_s, observer)
            }
            Observation::Between => Ok(()),
        }
    }

    /// The next attempt with other relay parameters, at the output that the relay has; a fault where there is none left.
    ///
    /// A relay that does not switch, or hardly overcomes the disturbance, gets a higher level; at the limit, a narrower
    /// hysteresis makes the oscillation larger against it. Cycles that differ get a wider one.
    fn retry(&mut self, failure: Failure, time_s: T, observer: &mut impl Observer<T>) -> Result<(), Fault> {
        let (factor, largest) = (self.protocol.factor, self.protocol.largest_level());
        let (relay_level, half_width) = (self.relay_level(), self.half_width());
        let next = match failure {
            Failure::NoSwitching | Failure::Condition40 if relay_level < largest => {
                Some(((relay_level * factor).min(largest), half_width))
            }
            Failure::NoSwitching => None,
            Failure::Condition40 => Some((relay_level, half_width / factor)),
            Failure::NotConverged => Some((relay_level, half_width * factor)),
        };
        let Some((level, width)) = next.filter(|_| self.attempt < self.protocol.attempts) else {
            let (relay_level, half_width) = (relay_level.value(), half_width.value());
            return Err(match failure {
                Failure::NoSwitching => Fault::NoOscillation { relay_level },
                Failure::NotConverged => Fault::NotConverged { half_width },
                Failure::Condition40 => Fault::Condition40 { relay_level, half_width },
            });
        };
        let high = self.relay.output() > self.protocol.neutral_command;
        let relay = self.protocol.relay(level, width).map_err(|_| Fault::NotConverged { half_width: width.value() })?;
        self.relay = RelayState::new(relay, high);
        (self.switched_s, self.cycles) = (time_s, 0);
        self.attempt += 1;
        observer.begin();
        Ok(())
    }
}
