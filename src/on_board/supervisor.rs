//! The state machine: relay, time-outs, attempts, faults. It receives the verdicts on cycles.

use super::sensor::SensorState;
use super::{Fault, Protocol};
use crate::experiment::RelayState;
use crate::features::LOST;
use crate::nonlinearity::RelayHysteresis;
use crate::numeric::{OutOfDomain, Scalar};

/// Where an experiment stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase {
    /// The relay acts.
    Running,
    /// Steady cycles were found; the command is neutral until a restart.
    Done,
    /// It was stopped by the caller; the command is neutral until a restart.
    Aborted,
    /// Something went wrong; the command is neutral until a restart.
    Failed(Fault),
}

/// One word: `running`, `done`, `aborted`, or `failed:` with the fault's code.
impl core::fmt::Display for Phase {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Running => f.write_str("running"),
            Self::Done => f.write_str("done"),
            Self::Aborted => f.write_str("aborted"),
            Self::Failed(fault) => write!(f, "failed:{}", fault.code()),
        }
    }
}

/// The answer to a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step<T> {
    /// Command to give now, within the limits in every phase.
    pub command: T,
    /// Where the experiment stands after this sample.
    pub phase: Phase,
}

/// The verdict on the cycles after a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Observation {
    /// No cycle ended with it.
    Between,
    /// A cycle ended, and they are not alike yet.
    Unsteady,
    /// They are alike.
    Steady,
    /// They are alike, and condition 40 fails.
    Condition40,
}

/// Whoever looks at the cycles.
pub(crate) trait Observer<T> {
    /// Forgets all cycles: an attempt with new relay parameters begins.
    fn begin(&mut self, protocol: &Protocol<T>);
    /// Takes a sample with the command given upon it.
    fn sample(&mut self, protocol: &Protocol<T>, time_s: T, position: T, command: T) -> Observation;
}

/// Why an attempt failed.
#[derive(Clone, Copy, PartialEq)]
enum AttemptFailure {
    NoSwitching,
    NotConverged,
    Condition40,
    Noise,
}

/// Switchings wanted too early before an attempt is given up for noise. A fast start may want a single early switching.
const MOST_EARLY: u8 = 4;

/// Switchings until a half-period of either sign has ended before the last.
const SEEN: u8 = 4;

/// All that decides on a supervisor's next action, its protocol being given; exact in its numbers.
#[cfg(feature = "std")]
pub(crate) type Key = (&'static str, [u64; 3], [u64; 7], [u64; 4], [u8; 5]);

/// The experiment but for its cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Supervisor<T> {
    protocol: Protocol<T>,
    phase: Phase,
    relay: RelayHysteresis<T>,
    /// Whether the relay gives its upper level.
    high: bool,
    /// Of use once there was a sample.
    sensor: SensorState<T>,
    begun: bool,
    started_s: T,
    /// Last switching, or beginning of the attempt.
    switched_s: T,
    /// Switchings so far, four for more.
    switchings: u8,
    /// Farthest position on the way of the first command, while that lasts.
    farthest: T,
    /// Position of the last motion or switching, and time of the last motion: away from there by the way of `moves`.
    anchor: T,
    moved_s: T,
    /// Half-periods: the longest but for the last, and the last; zero before the first.
    half_periods_s: (T, T),
    attempt: u8,
    cycles: u8,
    /// Switchings of the attempt after which noise wanted the next switching too early, and whether it did after the last.
    early: u8,
    hasty: bool,
}

impl<T: Scalar> Supervisor<T> {
    pub(crate) fn new(protocol: Protocol<T>) -> Result<Self, OutOfDomain> {
        let protocol = protocol.checked()?;
        let (relay, zero) = (protocol.relay(protocol.relay_level, protocol.half_width)?, T::zero());
        Ok(Self {
            protocol,
            phase: Phase::Running,
            relay,
            high: false,
            sensor: SensorState { time_s: zero, reading: zero, position: zero, changed_s: zero },
            begun: false,
            started_s: zero,
            switched_s: zero,
            switchings: 0,
            farthest: zero,
            anchor: zero,
            moved_s: zero,
            half_periods_s: (zero, zero),
            attempt: 1,
            cycles: 0,
            early: 0,
            hasty: false,
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

    /// The command at a time without a sample.
    pub(crate) fn tick(&mut self, time_s: T) -> Step<T> {
        if (self.phase, self.begun) == (Phase::Running, true)
            && let Err(fault) = self.sensor.age_s(&self.protocol, time_s).and_then(|_| self.in_time(time_s))
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
        let driving = self.phase == Phase::Running && self.begun;
        let command = if driving { self.state().output() } else { protocol.neutral_command };
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
        self.relay.level()
    }
    pub(crate) fn half_width(&self) -> T {
        self.relay.half_width()
    }
    fn state(&self) -> RelayState<T> {
        RelayState::new(self.relay, self.high)
    }
    /// The coordinate that the relay sees, once there was a sample.
    pub(crate) fn position(&self) -> Option<T> {
        self.begun.then_some(self.sensor.position())
    }

    /// Last switching, or beginning of the attempt, once there was a switching.
    #[cfg(feature = "std")]
    pub(crate) fn switched_s(&self) -> Option<T> {
        (self.switchings > 0).then_some(self.switched_s)
    }
    /// Farthest position on the way of the first command, while that lasts.
    #[cfg(feature = "std")]
    pub(crate) fn farthest(&self) -> Option<T> {
        (self.switchings == 0 && self.begun).then_some(self.farthest)
    }

    /// The state, for a table of visited states. Of a fault its name: the numbers in it decide nothing.
    #[cfg(feature = "std")]
    pub(crate) fn key(&self) -> Key {
        let Self { phase, started_s, switched_s, farthest, anchor, moved_s, half_periods_s, .. } = self;
        let phase = match phase {
            Phase::Running => "running",
            Phase::Done => "done",
            Phase::Aborted => "aborted",
            Phase::Failed(fault) => fault.code(),
        };
        let (bits, (longest_s, last_s)) = (|value: T| value.value().to_bits(), *half_periods_s);
        let relay = [self.state().output(), self.relay_level(), self.half_width()].map(bits);
        let numbers = [*started_s, *switched_s, *farthest, *anchor, *moved_s, longest_s, last_s].map(bits);
        let flags = u8::from(self.begun) + 2 * u8::from(self.hasty);
        (phase, relay, numbers, self.sensor.key(), [self.attempt, self.cycles, self.early, self.switchings, flags])
    }

    fn in_time(&self, time_s: T) -> Result<(), Fault> {
        if time_s - self.started_s < self.protocol.duration_s {
            Ok(())
        } else {
            Err(overtime(self.protocol.duration_s))
        }
    }

    /// Whether the vehicle is where it may be.
    fn in_place(&mut self, position: T) -> Result<(), Fault> {
        let protocol = &self.protocol;
        let distance = (position - protocol.reference).abs();
        if !(distance <= protocol.largest_excursion) {
            return Err(excursion(distance, protocol.largest_excursion));
        }
        if self.switchings > 0 {
            return Ok(());
        }
        let moved = if self.high { self.farthest - position } else { position - self.farthest };
        self.farthest = if moved < T::zero() { position } else { self.farthest };
        let limit = protocol.wrong_way + protocol.resolution;
        if moved <= limit { Ok(()) } else { Err(wrong_way(moved, limit)) }
    }

    /// For how long the relay may not switch and the coordinate not move. A sensor that freezes may end a half-period:
    /// the last does not count yet. A half-period of either sign has to count, since a disturbance makes them differ.
    fn patience_s(&self) -> T {
        let patience_s = self.protocol.patience_s;
        if self.switchings < SEEN { patience_s } else { patience_s.min(T::from_f64(LOST) * self.half_periods_s.0) }
    }

    /// Whether this sample shows motion; a fault where none has for too long.
    fn moves(&mut self, position: T, time_s: T) -> Result<bool, Fault> {
        let gone = (position - self.anchor).abs();
        // Sooner decided, for most samples: neither far nor late. The longest half-period is no longer than the patience.
        if T::two() * gone < self.half_width() && time_s - self.moved_s <= self.half_periods_s.0 {
            return Ok(false);
        }
        // A step of the sensor is no motion. Between switchings the coordinate goes two half-widths, hence a half-width from any anchor.
        let (step, half_width) = (T::from_f64(1.5) * self.protocol.resolution, self.half_width());
        let way = step.max(half_width / T::two()).min(half_width);
        let moves = gone >= way;
        if moves {
            (self.anchor, self.moved_s) = (position, time_s);
        } else if time_s - self.moved_s > self.patience_s() {
            return Err(no_motion(way, time_s - self.moved_s));
        }
        Ok(moves)
    }

    /// The relay's command at a position; held where the last switching is too near.
    fn switch(&mut self, position: T, time_s: T) -> T {
        let (mut relay, input) = (self.state(), self.protocol.reference - position);
        let before = relay.output();
        if !relay.changes(input) {
            return before;
        }
        if relay.step(input) == before {
            return before;
        }
        let half_period_s = time_s - self.switched_s;
        if self.switchings > 0 && half_period_s < self.protocol.dwell_s {
            self.early = self.early.saturating_add(u8::from(!self.hasty));
            self.hasty = true;
            return before;
        }
        if self.switchings > 0 {
            let longest_s = self.half_periods_s.0.max(self.half_periods_s.1);
            self.half_periods_s = (longest_s.min(self.protocol.patience_s), half_period_s);
        }
        (self.high, self.switchings, self.hasty) = (!self.high, (self.switchings + 1).min(SEEN), false);
        (self.switched_s, self.anchor) = (time_s, position);
        relay.output()
    }

    /// Takes the first sample; the coordinate.
    #[cold]
    fn begin(&mut self, reading: T, time_s: T) -> Result<T, Fault> {
        let sensor = SensorState::first(&self.protocol, reading, time_s)?;
        let position = sensor.position();
        (self.started_s, self.switched_s) = (time_s, time_s);
        (self.farthest, self.anchor, self.moved_s) = (position, position, time_s);
        self.high = position <= self.protocol.reference;
        (self.sensor, self.begun) = (sensor, true);
        Ok(position)
    }

    fn run(&mut self, reading: T, time_s: T, observer: &mut impl Observer<T>) -> Result<(), Fault> {
        let position =
            if self.begun { self.sensor.step(&self.protocol, reading, time_s)? } else { self.begin(reading, time_s)? };
        self.in_place(position)?;
        self.in_time(time_s)?;
        let moves = self.moves(position, time_s)?;
        let command = self.switch(position, time_s);
        match observer.sample(&self.protocol, time_s, position, command) {
            _ if self.early >= MOST_EARLY => self.retry(AttemptFailure::Noise, time_s, observer),
            Observation::Steady => {
                self.phase = Phase::Done;
                Ok(())
            }
            Observation::Condition40 => self.retry(AttemptFailure::Condition40, time_s, observer),
            Observation::Unsteady => {
                self.cycles = self.cycles.saturating_add(1);
                if self.cycles < self.protocol.most_cycles {
                    return Ok(());
                }
                self.retry(AttemptFailure::NotConverged, time_s, observer)
            }
            Observation::Between if moves && time_s - self.switched_s > self.patience_s() => {
                self.retry(AttemptFailure::NoSwitching, time_s, observer)
            }
            Observation::Between => Ok(()),
        }
    }

    /// The next attempt with new relay parameters, at the output that the relay has; a fault after the last attempt.
    ///
    /// A relay that does not switch, or hardly overcomes the disturbance, gets a higher level; at the limit, a narrower
    /// hysteresis makes the oscillation larger against it. Cycles that differ, and noise, call for a wider hysteresis:
    /// against noise no level is raised, and for want of a switching only at a sample that shows motion since the last.
    #[cold]
    fn retry(&mut self, failure: AttemptFailure, time_s: T, observer: &mut impl Observer<T>) -> Result<(), Fault> {
        let failure = match failure {
            AttemptFailure::NoSwitching | AttemptFailure::Condition40 if self.early > 0 => AttemptFailure::Noise,
            other => other,
        };
        let (factor, largest) = (self.protocol.factor, self.protocol.largest_level());
        let (relay_level, half_width) = (self.relay_level(), self.half_width());
        let next = match failure {
            AttemptFailure::NoSwitching | AttemptFailure::Condition40 if relay_level < largest => {
                Some(((relay_level * factor).min(largest), half_width))
            }
            AttemptFailure::NoSwitching => None,
            AttemptFailure::Condition40 => Some((relay_level, half_width / factor)),
            AttemptFailure::NotConverged | AttemptFailure::Noise => {
                Some((relay_level, half_width * factor)).filter(|(_, width)| *width < self.protocol.largest_excursion)
            }
        };
        let Some((level, width)) = next.filter(|_| self.attempt < self.protocol.attempts) else {
            let (relay_level, half_width) = (relay_level.value(), half_width.value());
            return Err(match failure {
                AttemptFailure::NoSwitching => Fault::NoOscillation { relay_level },
                AttemptFailure::NotConverged => Fault::NotConverged { half_width },
                AttemptFailure::Condition40 => Fault::Condition40 { relay_level, half_width },
                AttemptFailure::Noise => Fault::Noise { half_width, dwell_s: self.protocol.dwell_s.value() },
            });
        };
        self.relay =
            self.protocol.relay(level, width).map_err(|_| Fault::NotConverged { half_width: width.value() })?;
        (self.switched_s, self.cycles, self.early, self.hasty) = (time_s, 0, 0, false);
        self.farthest = self.sensor.position();
        // Half-periods grow by no more than the half-width does.
        let (wider, (longest_s, last_s)) = ((width / half_width).max(T::one()), self.half_periods_s);
        self.half_periods_s = ((wider * longest_s).min(self.protocol.patience_s), wider * last_s);
        self.attempt += 1;
        observer.begin(&self.protocol);
        Ok(())
    }
}

#[cold]
fn excursion<T: Scalar>(distance: T, limit: T) -> Fault {
    Fault::Excursion { distance: distance.value(), limit: limit.value() }
}
#[cold]
fn wrong_way<T: Scalar>(moved: T, limit: T) -> Fault {
    Fault::WrongWay { moved: moved.value(), limit: limit.value() }
}
#[cold]
fn no_motion<T: Scalar>(range: T, unchanged_s: T) -> Fault {
    Fault::NoMotion { range: range.value(), unchanged_s: unchanged_s.value() }
}
#[cold]
fn overtime<T: Scalar>(duration_s: T) -> Fault {
    Fault::Overtime { duration_s: duration_s.value() }
}

#[cfg(all(test, feature = "std"))]
mod tests;
