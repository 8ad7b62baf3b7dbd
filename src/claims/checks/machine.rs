//! The on-board state machine as a transition system, and its exhaustive exploration.
//!
//! The machine is explored with every answer of an observer of cycles at every sample: a superset of all runs.

use std::collections::VecDeque;

use foldhash::{HashSet, HashSetExt};

use super::{ClaimPart, Evidence, Verdict, Witness};
use crate::on_board::{Coordinate, Key, Observation, Observer, Phase, Protocol, Supervisor};

/// How many of [`Lattice::all`] a claim is about: readings and times off them are not spoken of.
pub(super) const LATTICES: usize = 3;
pub(super) const WITH_COARSE: usize = 4;

/// A finite world: an experiment, and the samples that may come.
pub(super) struct Lattice {
    pub(super) part: ClaimPart,
    pub(super) protocol: Protocol<f64>,
    pub(super) readings: &'static [f64],
}

/// Times between samples in s: sound times, a gap, a clock that stands, runs backwards or fails.
pub(super) const INTERVALS_S: [f64; 6] = [1.0, 2.0, 3.0, 0.0, -1.0, f64::NAN];
/// How many of them are sound.
pub(super) const SOUND: usize = 2;
/// Readings in addition to the lattice's.
const BROKEN: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
/// Answers of an observer.
const OBSERVATIONS: [Observation; 4] =
    [Observation::Between, Observation::Unsteady, Observation::Steady, Observation::Condition40];

impl Lattice {
    fn of(name: &'static str, coordinate: Coordinate, half_width: f64, readings: &'static [f64]) -> Self {
        let protocol = Protocol {
            neutral_command: 0.5,
            lowest_command: -1.0,
            highest_command: 2.5,
            interval_s: 0.5,
            wrong_way: half_width,
            dwell_s: 1.5,
            largest_rate: 2.0 * half_width,
            unchanged_s: 2.0,
            patience_s: 3.0,
            duration_s: 6.0,
            cycles: 2,
            most_cycles: 2,
            factor: 2.0,
            ..Protocol::new(coordinate, 1.0, half_width, 1.5 * half_width, 0.5)
        };
        Self { part: ClaimPart::named(name), protocol, readings }
    }

    /// A lattice for each kind of coordinate, and a lattice with half-periods. All numbers are whole or halves: sums are exact.
    pub(super) fn all() -> [Self; 4] {
        let coarse = Self::of("coarse", Coordinate::Position, 2.0, &[-2.0, 1.0, 2.0]);
        let protocol = Protocol { dwell_s: 1.0, patience_s: 5.0, duration_s: 10.0, attempts: 2, ..coarse.protocol };
        let protocol = Protocol { resolution: 1.0, largest_rate: 3.0, ..protocol };
        [
            Self::of("positions", Coordinate::Position, 1.0, &[-2.0, -1.0, 0.0, 1.0, 2.0]),
            Self::of("headings", Coordinate::HeadingDegrees, 60.0, &[0.0, 60.0, 120.0, 180.0, 240.0, 300.0]),
            Self::of("speeds", Coordinate::Speed, 1.0, &[-1.0, 0.0, 1.0]),
            Self { protocol, ..coarse },
        ]
    }
}

/// Events of the machine.
#[derive(Clone, Copy, Debug)]
pub(super) enum MachineEvent {
    Abort,
    Sample {
        reading: f64,
        interval_s: f64,
        observation: Observation,
    },
    /// A timer asks, this long after the last sample.
    Tick {
        age_s: f64,
    },
}

/// A fault of the machine by which a claim fails.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Defect {
    None,
    /// Begins anew where its time is over.
    Restarts,
    /// Follows the sign of the coordinate.
    NoHysteresis,
    /// Raises the level without regard to the limits.
    Unclamped,
    /// Obeys in the first attempt only.
    IgnoresAbort,
    /// Goes on after a fault.
    Forgives,
    /// Goes on wherever the coordinate is.
    Boundless,
    /// Raises the level where the relay has not switched for its patience, at any reading.
    Restless,
}

/// The motion as an onlooker sees it, while the machine runs.
#[derive(Clone, Copy, Default)]
pub(super) struct ObservedMotion {
    /// Position from which there is a way to go, and when that was gone last.
    anchor: f64,
    moved_s: f64,
    switched_s: Option<f64>,
    /// How many half-periods have ended; the longest but for the last, and the last.
    ended: u8,
    longest_s: f64,
    last_s: f64,
}

impl ObservedMotion {
    /// Half a half-width, or more than a step of the sensor: whether a position is at such a distance.
    pub(super) fn gone(&self, protocol: &Protocol<f64>, half_width: f64, position: f64) -> bool {
        (position - self.anchor).abs() >= half_width.min(1.5 * protocol.resolution.max(half_width / 3.0))
    }

    /// Whether there has been none at a time for longer than the machine may wait.
    pub(super) fn still(&self, protocol: &Protocol<f64>, time_s: f64) -> bool {
        let patience_s = if self.ended < 3 { f64::INFINITY } else { 4.0 * self.longest_s };
        time_s - self.moved_s > protocol.patience_s.min(patience_s)
    }
}

/// The machine under its clock.
#[derive(Clone, Copy)]
pub(super) struct Machine {
    pub(super) supervisor: Supervisor<f64>,
    defect: Defect,
    /// Command upon the last event.
    pub(super) command: f64,
    /// Time of the last sample; the first has time zero.
    pub(super) time_s: f64,
    /// Last reading and since when it has been the same, once there was a reading.
    pub(super) seen: Option<(f64, f64)>,
    pub(super) motion: ObservedMotion,
}

/// An observer with a given answer.
struct Says(Observation);

impl Observer<f64> for Says {
    fn begin(&mut self, _: &Protocol<f64>) {}
    fn sample(&mut self, _: &Protocol<f64>, _: f64, _: f64, _: f64) -> Observation {
        self.0
    }
}

impl Machine {
    fn new(lattice: &Lattice, defect: Defect) -> Option<Self> {
        let protocol = match defect {
            Defect::Boundless => Protocol { largest_excursion: f64::MAX, ..lattice.protocol },
            _ => lattice.protocol,
        };
        let supervisor = Supervisor::new(protocol).ok()?;
        let (command, motion) = (supervisor.command(), ObservedMotion::default());
        Some(Self { supervisor, defect, command, time_s: 0.0, seen: None, motion })
    }

    fn key(&self) -> (Key, [u64; 4]) {
        let ObservedMotion { anchor, moved_s, longest_s, last_s, .. } = self.motion;
        (self.supervisor.key(), [anchor, moved_s, longest_s, last_s].map(f64::to_bits))
    }
    pub(super) fn running(&self) -> bool {
        self.supervisor.phase() == Phase::Running
    }

    /// The machine after an event.
    pub(super) fn after(mut self, event: MachineEvent) -> Self {
        match event {
            MachineEvent::Abort => {
                if self.defect != Defect::IgnoresAbort || self.supervisor.attempt() == 1 {
                    self.supervisor.abort();
                }
            }
            MachineEvent::Tick { age_s } => {
                let _ = self.supervisor.tick(self.time_s + age_s);
            }
            MachineEvent::Sample { reading, interval_s, observation } => {
                // A first sample has none before it.
                self.time_s = if self.seen.is_some() { self.time_s + interval_s } else { 0.0 };
                let before = self.supervisor;
                let _ = self.supervisor.step(reading, self.time_s, &mut Says(observation));
                let over = matches!(self.supervisor.phase(), Phase::Failed(fault) if fault.code() == "overtime");
                let forgiven = self.defect == Defect::Forgives && matches!(self.supervisor.phase(), Phase::Failed(_));
                if (over && self.defect == Defect::Restarts || forgiven)
                    && let Ok(fresh) = Supervisor::new(*self.supervisor.protocol())
                {
                    self.supervisor = fresh;
                    let _ = self.supervisor.step(reading, self.time_s, &mut Says(observation));
                }
                let since = self.seen.filter(|(before, _)| *before == reading).map_or(self.time_s, |(_, since)| since);
                self.follow(&before);
                self.seen = Some((reading, since));
            }
        }
        self.command = self.answer();
        self
    }

    /// Follows the motion over a step.
    fn follow(&mut self, before: &Supervisor<f64>) {
        let Some(position) = self.supervisor.position().filter(|_| self.running()) else { return };
        let (protocol, time_s, motion) = (self.supervisor.protocol(), self.time_s, &mut self.motion);
        let high = |supervisor: &Supervisor<f64>| supervisor.command() > protocol.neutral_command;
        if self.seen.is_none() || motion.gone(protocol, before.half_width(), position) {
            (motion.anchor, motion.moved_s) = (position, time_s);
        }
        if self.seen.is_some() && high(before) != high(&self.supervisor) {
            if let Some(since_s) = motion.switched_s {
                (motion.longest_s, motion.last_s) = (motion.longest_s.max(motion.last_s), time_s - since_s);
                motion.ended = (motion.ended + 1).min(3);
            }
            (motion.switched_s, motion.anchor) = (Some(time_s), position);
        }
        // A wider relay is waited for in proportion.
        let wider = (self.supervisor.half_width() / before.half_width()).max(1.0);
        (motion.longest_s, motion.last_s) = (wider * motion.longest_s, wider * motion.last_s);
    }

    /// The machine's command now, spoilt by its defect.
    fn answer(&self) -> f64 {
        let (command, protocol) = (self.supervisor.command(), self.supervisor.protocol());
        let Some(position) = self.supervisor.position().filter(|_| self.running()) else { return command };
        let raised = protocol.relay_level * protocol.factor.powi(i32::from(self.supervisor.attempt()) - 1);
        let with = |level: f64, positive: bool| protocol.neutral_command + if positive { level } else { -level };
        match self.defect {
            Defect::NoHysteresis => with(self.supervisor.relay_level(), position < 0.0),
            Defect::Restless if self.time_s > self.motion.switched_s.unwrap_or(f64::MAX) + protocol.patience_s => {
                with(2.0 * self.supervisor.relay_level(), command > protocol.neutral_command)
            }
            Defect::Unclamped => with(raised, command > protocol.neutral_command),
            _ => command,
        }
    }
}

/// A property of the machine: of each state with its successors, and of each step.
#[derive(Clone, Copy)]
pub(super) struct Property {
    pub(super) state: fn(&Lattice, &Machine, &[(MachineEvent, Machine)]) -> bool,
    pub(super) step: fn(&Lattice, &Machine, MachineEvent, &Machine) -> bool,
}

impl Property {
    /// Of steps alone.
    pub(super) const fn step(step: fn(&Lattice, &Machine, MachineEvent, &Machine) -> bool) -> Self {
        Self { state: |_, _, _| true, step }
    }
}

/// States beyond this are not waited for.
const MOST_STATES: usize = 3_000_000;

/// Every reachable state of the first lattices, breadth first, for the shortest witness.
pub(super) fn explore(lattices: usize, defect: Defect, property: Property) -> Verdict {
    Verdict::all(Lattice::all().iter().take(lattices).map(|lattice| explore_one(lattice, defect, property)))
}

fn explore_one(lattice: &Lattice, defect: Defect, property: Property) -> Verdict {
    let Some(start) = Machine::new(lattice, defect) else {
        return Verdict::Undecided { spent: format!("{}: protocol refused", lattice.part.name) };
    };
    // State, its predecessor, and the event between.
    let mut states: Vec<(Machine, usize, MachineEvent)> = vec![(start, 0, MachineEvent::Abort)];
    let mut visited = HashSet::new();
    visited.insert(start.key());
    let mut waiting = VecDeque::from([0]);
    let mut successors = Vec::new();
    while let Some(index) = waiting.pop_front() {
        let machine = states[index].0;
        successors.clear();
        successors.extend(events(lattice, &machine).map(|event| (event, machine.after(event))));
        let offender = successors.iter().find(|(event, after)| !(property.step)(lattice, &machine, *event, after));
        if offender.is_some() || !(property.state)(lattice, &machine, &successors) {
            let mut path = Vec::from_iter(offender.copied());
            let mut at = index;
            while at != 0 {
                path.push((states[at].2, states[at].0));
                at = states[at].1;
            }
            path.reverse();
            return Verdict::Refuted(witness(&path));
        }
        for &(event, next) in &successors {
            if visited.insert(next.key()) {
                waiting.push_back(states.len());
                states.push((next, index, event));
            }
        }
        if states.len() > MOST_STATES {
            return Verdict::Undecided {
                spent: format!("{}: {} states and more to come", lattice.part.name, states.len()),
            };
        }
    }
    Verdict::Holds(Evidence::exhausted(lattice.part.clone(), states.len()))
}

fn events<'a>(lattice: &'a Lattice, machine: &Machine) -> impl Iterator<Item = MachineEvent> + use<'a> {
    // The first sample's interval means nothing.
    let (sound, unsound) =
        if machine.seen.is_some() { INTERVALS_S.split_at(SOUND) } else { (&INTERVALS_S[..1], &INTERVALS_S[..0]) };
    let sample = |reading, interval_s, observation| MachineEvent::Sample { reading, interval_s, observation };
    let good = lattice.readings.iter().flat_map(move |&reading| {
        sound.iter().flat_map(move |&interval_s| OBSERVATIONS.map(|says| sample(reading, interval_s, says)))
    });
    // A sample that is refused is not observed.
    let late = unsound.iter().map(move |&interval_s| sample(lattice.readings[0], interval_s, OBSERVATIONS[0]));
    let broken = BROKEN.into_iter().map(move |reading| sample(reading, INTERVALS_S[0], OBSERVATIONS[0]));
    let ticks = INTERVALS_S.into_iter().map(|age_s| MachineEvent::Tick { age_s });
    good.chain(late).chain(broken).chain(ticks).chain([MachineEvent::Abort])
}

/// The samples of a path, and the command at its end. `cycles_say` is 1 where a cycle ended, 2 where they are steady, 3
/// where condition 40 fails.
fn witness(path: &[(MachineEvent, Machine)]) -> Witness {
    let mut numbers = Vec::new();
    for (step, (event, _)) in (1..).zip(path) {
        let mut number = |name: &str, value: f64| numbers.push((format!("{name}_{step}"), value));
        match *event {
            MachineEvent::Abort => number("abort", 1.0),
            MachineEvent::Tick { age_s } => number("tick_after_s", age_s),
            MachineEvent::Sample { reading, interval_s, observation } => {
                number("reading", reading);
                number("after_s", interval_s);
                if observation != Observation::Between {
                    number("cycles_say", f64::from(observation as u8));
                }
            }
        }
    }
    numbers.extend(path.last().map(|(_, machine)| ("command".to_owned(), machine.command)));
    Witness::new(numbers)
}
