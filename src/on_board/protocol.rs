//! What is to be done, and within which limits.

use crate::nonlinearity::RelayHysteresis;
use crate::numeric::{Limit, OutOfDomain, Scalar, domain};

/// What the sensor measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Coordinate {
    /// The coordinate itself, as a plain number: depth in m (eq. 43), a position.
    Position,
    /// A heading in radians (eq. 36), which may jump by whole turns.
    HeadingRad,
    /// A heading in degrees, which may jump by whole turns.
    HeadingDegrees,
    /// A speed in coordinate units per second; the relay is fed with its integral (eq. 44), from zero at the start.
    Speed,
}

/// One experiment: its relay, its limits, and when it counts as done. All fields are read once, by
/// [`Experiment::new`](super::Experiment::new), which checks them.
///
/// Coordinate units are those of the sensor (of its integral for a speed); command units those of the actuator.
///
/// ```
/// use selfosc::on_board::{Coordinate, Experiment, Protocol};
/// let protocol = Protocol {
///     highest_command: 0.12,
///     lowest_command: -0.12,
///     ..Protocol::new(Coordinate::HeadingDegrees, 0.08, 15.0, 0.1)
/// };
/// assert!(Experiment::new(protocol).is_ok());
/// assert!(Experiment::new(Protocol { highest_command: 0.05, ..protocol }).is_err());
/// # Ok::<(), selfosc::numeric::OutOfDomain>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Protocol<T> {
    /// What the sensor measures.
    pub coordinate: Coordinate,
    /// Value of the coordinate to oscillate about.
    pub reference: T,
    /// Command that the relay's two levels lie about, and that is given before, afterwards and upon a fault.
    pub neutral_command: T,
    /// Least command that is ever given.
    pub lowest_command: T,
    /// Largest command that is ever given.
    pub highest_command: T,
    /// Relay level C of the first attempt, in command units.
    pub relay_level: T,
    /// Half-width x_a of the relay's hysteresis in the first attempt, in coordinate units.
    pub half_width: T,
    /// Time between samples as planned, in s. A gap of more than [`LONGEST_GAP`](Self::LONGEST_GAP) of them is a fault.
    pub interval_s: T,
    /// Step of the sensor, or a few standard deviations of its noise, in units of the reading; zero for none. A reading may
    /// jump by this much besides the motion, and peaks that differ by no more are alike.
    pub resolution: T,
    /// Largest rate of change of the reading that the vehicle is capable of, per s.
    pub largest_rate: T,
    /// A reading unchanged for longer is a fault, in s. A sound sensor shows one value while the vehicle turns round within one
    /// step of it, or runs up from rest: allow for that, and stay below `patience_s`.
    pub unchanged_s: T,
    /// An attempt fails where the relay has not switched for longer, in s.
    pub patience_s: T,
    /// The experiment is broken off after this time, in s.
    pub duration_s: T,
    /// Cycles in a row that have to be alike.
    pub cycles: u8,
    /// How alike: the range of either peak over these cycles against the amplitude, and of either time against half the period.
    /// The sensor's resolution and one sampling interval are allowed besides.
    pub spread: T,
    /// An attempt fails where so many cycles have passed without that.
    pub most_cycles: u8,
    /// Attempts in all, each with other relay parameters than the one before.
    pub attempts: u8,
    /// Factor between the relay parameters of two attempts.
    pub factor: T,
}

impl<T: Scalar> Protocol<T> {
    /// Gap between two samples that is a fault, in planned intervals.
    pub const LONGEST_GAP: f64 = 4.0;

    /// An experiment about zero with these relay parameters and readings every `interval_s`, and what can be said without
    /// knowing the vehicle: limits of twice the relay level, three cycles alike to 10 % out of at most 12, three attempts, each
    /// half as strong again. Set `largest_rate` and `resolution` if they are known, and the times for slow vehicles: 5 s for one
    /// value of the reading, 20 s for one of the command, 5 minutes in all.
    #[must_use]
    pub fn new(coordinate: Coordinate, relay_level: T, half_width: T, interval_s: T) -> Self {
        let number = T::from_f64;
        Self {
            coordinate,
            reference: T::zero(),
            neutral_command: T::zero(),
            lowest_command: -T::two() * relay_level,
            highest_command: T::two() * relay_level,
            relay_level,
            half_width,
            interval_s,
            resolution: T::zero(),
            largest_rate: number(1e9),
            unchanged_s: number(5.0),
            patience_s: number(20.0),
            duration_s: number(300.0),
            cycles: 3,
            spread: number(0.1),
            most_cycles: 12,
            attempts: 3,
            factor: number(1.5),
        }
    }

    /// The largest relay level within the limits.
    pub(super) fn largest_level(&self) -> T {
        (self.highest_command - self.neutral_command).min(self.neutral_command - self.lowest_command)
    }

    /// The relay of an attempt.
    pub(super) fn relay(&self, level: T, half_width: T) -> Result<RelayHysteresis<T>, OutOfDomain> {
        let relay = RelayHysteresis::new(level, half_width, self.neutral_command).ok();
        relay.filter(|relay| relay.half_width() > T::zero()).ok_or(OutOfDomain {
            quantity: "half-width",
            value: half_width.value(),
            unit: COORDINATE,
            limit: Limit::Positive,
            remedy: CHANGE,
        })
    }

    /// The same, where every number is in its domain.
    pub(super) fn checked(self) -> Result<Self, OutOfDomain> {
        let level_fits = self.relay_level <= self.largest_level();
        let unchanged_fits = self.unchanged_s > self.interval_s && self.unchanged_s < self.patience_s;
        let within = Limit::Words("within the limits about the neutral command");
        let stuck = Limit::Words("above the interval and below the patience");
        let shorter = Limit::Words("shorter than the experiment");
        for (quantity, value, unit, inside, limit) in [
            ("reference", self.reference, COORDINATE, true, Limit::Finite),
            ("neutral command", self.neutral_command, COMMAND, true, Limit::Finite),
            ("lowest command", self.lowest_command, COMMAND, true, Limit::Finite),
            ("highest command", self.highest_command, COMMAND, true, Limit::Finite),
            ("relay level", self.relay_level, COMMAND, true, Limit::Positive),
            ("relay level", self.relay_level, COMMAND, level_fits, within),
            ("half-width", self.half_width, COORDINATE, true, Limit::Positive),
            ("sampling interval", self.interval_s, "s", true, Limit::Positive),
            ("resolution of the reading", self.resolution, COORDINATE, true, Limit::NonNegative),
            ("largest rate", self.largest_rate, "coordinate units per s", true, Limit::Positive),
            ("time of one reading", self.unchanged_s, "s", unchanged_fits, stuck),
            ("patience", self.patience_s, "s", self.patience_s < self.duration_s, shorter),
            ("duration", self.duration_s, "s", true, Limit::Positive),
            ("spread of cycles", self.spread, "", true, Limit::Positive),
            ("factor between attempts", self.factor, "", true, Limit::Above(1.0)),
        ] {
            domain::require_that(inside, quantity, value, unit, limit, CHANGE)?;
        }
        for (quantity, value, least) in [
            ("cycles alike", self.cycles, 2),
            ("cycles of an attempt", self.most_cycles, self.cycles),
            ("attempts", self.attempts, 1),
        ] {
            domain::require(quantity, f64::from(value), "", Limit::AtLeast(f64::from(least)), CHANGE)?;
        }
        Ok(self)
    }
}

const COORDINATE: &str = "coordinate units";
const COMMAND: &str = "command units";
const CHANGE: &str = "change the protocol";
