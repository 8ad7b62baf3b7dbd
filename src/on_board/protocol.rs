//! The settings of an experiment, and its limits.

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

impl Coordinate {
    /// Name of its column in a log, which has the unit.
    #[must_use]
    pub fn column(self) -> &'static str {
        match self {
            Self::HeadingDegrees => "heading_deg",
            Self::HeadingRad => "heading",
            Self::Position | Self::Speed => "position",
        }
    }

    /// Unit of a heading.
    pub(crate) fn angle_unit(self) -> Option<&'static str> {
        match self {
            Self::HeadingRad => Some("rad"),
            Self::HeadingDegrees => Some("deg"),
            Self::Position | Self::Speed => None,
        }
    }
}

/// One experiment: its relay, its limits, and when it counts as done. All fields are read once, by
/// [`Experiment::new`](super::Experiment::new), which checks them.
///
/// Coordinate units are those of the sensor (of its integral for a speed); command units those of the actuator.
///
/// ```
/// use selfosc::on_board::{Coordinate, Experiment, Protocol};
/// // A depth in m, read ten times a second, that may leave the reference by 1.5 m.
/// let protocol = Protocol {
///     highest_command: 12.0,
///     lowest_command: -12.0,
///     ..Protocol::new(Coordinate::Position, 8.0, 0.2, 1.5, 0.1)
/// };
/// assert!(Experiment::new(protocol).is_ok());
/// assert!(Experiment::new(Protocol { highest_command: 5.0, ..protocol }).is_err());
/// # Ok::<(), selfosc::numeric::OutOfDomain>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Protocol<T> {
    /// What the sensor measures.
    pub coordinate: Coordinate,
    /// Value of the coordinate to oscillate about.
    pub reference: T,
    /// Command before, afterwards and upon a fault.
    pub neutral_command: T,
    /// Middle of the relay's two levels less the neutral command: one relay level for a heater that is off or full on. A disturbance is
    /// counted from the middle.
    pub relay_offset: T,
    /// Least command that is ever given.
    pub lowest_command: T,
    /// Largest command that is ever given.
    pub highest_command: T,
    /// Relay level C of the first attempt, in command units.
    pub relay_level: T,
    /// Half-width x_a of the relay's hysteresis in the first attempt, in coordinate units.
    pub half_width: T,
    /// The coordinate may be this far from the reference; a reading further off ends the experiment.
    pub largest_excursion: T,
    /// Before the relay has switched for the first time, the coordinate may fall back from its farthest place by at
    /// most this way. A vehicle that goes further obeys a reversed actuator, or a disturbance beyond the relay level.
    pub wrong_way: T,
    /// The relay keeps an output for at least this long, in s. Noise that would switch it earlier counts against the half-width.
    pub dwell_s: T,
    /// Time between samples as planned, in s. A gap of more than [`LONGEST_GAP`](Self::LONGEST_GAP) of them is a fault.
    pub interval_s: T,
    /// Step of the sensor, or a few standard deviations of its noise, in units of the reading; zero for none. A reading may
    /// jump by this in addition to the motion, and peaks that differ by no more are equal.
    pub resolution: T,
    /// Largest rate of change of the reading that the vehicle is capable of, per s.
    pub largest_rate: T,
    /// A reading unchanged for longer is a fault, in s. A sound sensor shows a constant value while the vehicle turns round within a
    /// step of it, or runs up from rest: allow for that, and stay below `patience_s`.
    pub unchanged_s: T,
    /// An attempt fails where the relay has not switched for longer, in s, or for four times the longest half-period seen.
    pub patience_s: T,
    /// The experiment is broken off after this time, in s.
    pub duration_s: T,
    /// Cycles in a row that have to be alike.
    pub cycles: u8,
    /// How alike: the range of either peak over these cycles against the amplitude, and of either time against half the period.
    /// The sensor's resolution and a sampling interval are allowed in addition.
    pub spread: T,
    /// An attempt fails after this number of cycles without that.
    pub most_cycles: u8,
    /// Attempts in all, each with new relay parameters.
    pub attempts: u8,
    /// Factor between the relay parameters of two attempts.
    pub factor: T,
}

impl<T: Scalar> Protocol<T> {
    /// Gap between two samples that is a fault, in planned intervals.
    pub const LONGEST_GAP: f64 = 4.0;
    /// Turns either way that a heading may read: sensors that count turns stay below, a reading beyond is no heading.
    pub const MOST_TURNS: f64 = 100.0;

    /// An experiment about zero with these relay parameters and readings every `interval_s`, that may go `largest_excursion`
    /// either way. The limits need no model of the vehicle:
    ///
    /// - commands up to twice the relay level, a rate of at most the largest excursion in a second, two half-widths the wrong way;
    /// - at least four intervals between switchings;
    /// - three cycles alike to 10 % out of at most 12, three attempts, each 1.5 times as strong as the last.
    ///
    /// Set `largest_rate` and `resolution` if they are given, and the
    /// times for slow vehicles: 5 s for a constant reading, 20 s for a constant command, 5 minutes in all.
    ///
    /// The excursion is that of the reading. A vehicle whose sensor is true to `resolution`, and which goes no faster
    /// than `largest_rate`, is driven no further than `largest_excursion` and the way of a gap, with any fault of its
    /// actuators; its coasting after that, at the neutral command, is not bounded.
    #[must_use]
    pub fn new(coordinate: Coordinate, relay_level: T, half_width: T, largest_excursion: T, interval_s: T) -> Self {
        let number = T::from_f64;
        Self {
            coordinate,
            reference: T::zero(),
            neutral_command: T::zero(),
            relay_offset: T::zero(),
            lowest_command: -T::two() * relay_level,
            highest_command: T::two() * relay_level,
            relay_level,
            half_width,
            largest_excursion,
            wrong_way: T::two() * half_width,
            dwell_s: number(4.0) * interval_s,
            interval_s,
            resolution: T::zero(),
            largest_rate: largest_excursion,
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

    /// The same with the usual room: a quarter turn of a heading, else five half-widths.
    ///
    /// ```
    /// use selfosc::on_board::{Coordinate, Protocol};
    /// let depth = Protocol::usual(Coordinate::Position, 8.0, 0.2, 0.1);
    /// assert_eq!((depth.largest_excursion, depth.largest_rate), (1.0, 1.0));
    /// ```
    #[must_use]
    pub fn usual(coordinate: Coordinate, relay_level: T, half_width: T, interval_s: T) -> Self {
        let excursion = match coordinate {
            Coordinate::HeadingRad => T::pi() / T::two(),
            Coordinate::HeadingDegrees => T::from_f64(90.0),
            Coordinate::Position | Coordinate::Speed => T::from_f64(5.0) * half_width,
        };
        Self::new(coordinate, relay_level, half_width, excursion, interval_s)
    }

    /// The same for a heading in radians, of a quarter turn either way and no more than a quarter turn per second.
    ///
    /// ```
    /// use selfosc::on_board::{Experiment, Phase, Protocol};
    /// let mut experiment = Experiment::new(Protocol::heading_rad(0.08, 0.2, 0.1))?;
    /// assert_eq!(experiment.step(-0.1, 0.0).command, 0.08);
    /// let astray = experiment.step(2.9, 0.1); // 170 degrees in a tenth of a second
    /// assert!(matches!(astray.phase, Phase::Failed(fault) if fault.code() == "jump") && astray.command == 0.0);
    /// # Ok::<(), selfosc::numeric::OutOfDomain>(())
    /// ```
    #[must_use]
    pub fn heading_rad(relay_level: T, half_width: T, interval_s: T) -> Self {
        Self::usual(Coordinate::HeadingRad, relay_level, half_width, interval_s)
    }

    /// The same for a heading in degrees.
    #[must_use]
    pub fn heading_degrees(relay_level: T, half_width: T, interval_s: T) -> Self {
        Self::usual(Coordinate::HeadingDegrees, relay_level, half_width, interval_s)
    }

    /// Middle of the relay's two levels.
    pub(crate) fn middle_command(&self) -> T {
        self.neutral_command + self.relay_offset
    }

    /// The largest relay level within the limits.
    pub(super) fn largest_level(&self) -> T {
        (self.highest_command - self.middle_command()).min(self.middle_command() - self.lowest_command)
    }

    /// The relay of an attempt.
    pub(super) fn relay(&self, level: T, half_width: T) -> Result<RelayHysteresis<T>, OutOfDomain> {
        let relay = RelayHysteresis::new(level, half_width, self.middle_command()).ok();
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
        let neutral_fits = self.lowest_command <= self.neutral_command && self.neutral_command <= self.highest_command;
        let unchanged_fits = self.unchanged_s > self.interval_s && self.unchanged_s < self.patience_s;
        let within = Limit::Words("within the limits about the middle of the levels");
        let patient = Limit::Words("below the patience");
        let stuck = Limit::Words("above the interval and below the patience");
        let wider = Limit::Words("above the half-width");
        let shorter = Limit::Words("shorter than the experiment");
        for (quantity, value, unit, inside, limit) in [
            ("reference", self.reference, COORDINATE, true, Limit::Finite),
            ("neutral command", self.neutral_command, COMMAND, true, Limit::Finite),
            ("offset of the relay", self.relay_offset, COMMAND, true, Limit::Finite),
            ("lowest command", self.lowest_command, COMMAND, true, Limit::Finite),
            ("highest command", self.highest_command, COMMAND, true, Limit::Finite),
            ("neutral command", self.neutral_command, COMMAND, neutral_fits, Limit::Words("within the limits")),
            ("relay level", self.relay_level, COMMAND, true, Limit::Positive),
            ("relay level", self.relay_level, COMMAND, level_fits, within),
            ("half-width", self.half_width, COORDINATE, true, Limit::Positive),
            ("largest excursion", self.largest_excursion, COORDINATE, self.largest_excursion > self.half_width, wider),
            ("way in the wrong direction", self.wrong_way, COORDINATE, true, Limit::Positive),
            ("least time between switchings", self.dwell_s, "s", true, Limit::NonNegative),
            ("least time between switchings", self.dwell_s, "s", self.dwell_s < self.patience_s, patient),
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
