//! A protocol as flags.

use clap::Args;

use crate::command::CommandError;
use crate::command::number::{finite, positive, small_count};
use crate::numeric::OutOfDomain;
use crate::on_board::{Coordinate, Experiment, Fault, Protocol};

/// The numbers of [`Protocol`]; those that are not given are its own.
#[derive(Debug, Args)]
pub(super) struct ProtocolArguments {
    /// Unit and kind of the reading: position, heading-rad, heading-deg, or speed, of which the relay sees the integral
    #[arg(long, value_name = "KIND", default_value = "position", value_parser = coordinate)]
    coordinate: Coordinate,
    /// Relay level C of the first attempt, command units
    #[arg(long, value_name = "C", value_parser = positive, allow_negative_numbers = true)]
    relay: f64,
    /// Half-width x_a of the relay's hysteresis in the first attempt, units of the coordinate
    #[arg(long, value_name = "XA", value_parser = positive, allow_negative_numbers = true)]
    half_width: f64,
    /// Time between two readings as planned, s
    #[arg(long, value_name = "S", value_parser = positive, allow_negative_numbers = true)]
    interval: f64,
    /// The coordinate may be this far from the reference [default: of a heading a quarter turn, else 5 half-widths]
    #[arg(long, value_name = "X", value_parser = positive, allow_negative_numbers = true)]
    excursion: Option<f64>,
    /// Value of the coordinate to oscillate about
    #[arg(long, value_name = "R", default_value_t = 0.0, value_parser = finite, allow_negative_numbers = true)]
    reference: f64,
    /// Command before, after, and upon a fault; the relay's levels lie about it, or about --offset from it
    #[arg(long, value_name = "U", default_value_t = 0.0, value_parser = finite, allow_negative_numbers = true)]
    neutral: f64,
    /// Middle of the relay's levels less the neutral command; of a heater, off or full on, the relay level
    #[arg(long, value_name = "U", default_value_t = 0.0, value_parser = finite, allow_negative_numbers = true)]
    offset: f64,
    /// Least command ever given [default: neutral, or 2 relay levels below the middle]
    #[arg(long, value_name = "U", value_parser = finite, allow_negative_numbers = true)]
    lowest: Option<f64>,
    /// Largest command ever given [default: neutral, or 2 relay levels above the middle]
    #[arg(long, value_name = "U", value_parser = finite, allow_negative_numbers = true)]
    highest: Option<f64>,
    /// Way back under the first command that counts as the wrong sign [default: 2 half-widths]
    #[arg(long, value_name = "X", value_parser = finite, allow_negative_numbers = true)]
    wrong_way: Option<f64>,
    /// Least time between two switchings, s [default: 4 intervals]
    #[arg(long, value_name = "S", value_parser = finite, allow_negative_numbers = true)]
    dwell: Option<f64>,
    /// Step of the sensor, or a few standard deviations of its noise, units of the reading
    #[arg(long, value_name = "X", default_value_t = 0.0, value_parser = finite, allow_negative_numbers = true)]
    resolution: f64,
    /// Largest rate of the reading that the vehicle is capable of, per s [default: the excursion per s]
    #[arg(long, value_name = "V", value_parser = finite, allow_negative_numbers = true)]
    largest_rate: Option<f64>,
    /// A reading that stays unchanged for longer is a fault, s [default: 5]
    #[arg(long, value_name = "S", value_parser = finite, allow_negative_numbers = true)]
    unchanged: Option<f64>,
    /// An attempt fails without a switching for longer, s [default: 20]
    #[arg(long, value_name = "S", value_parser = finite, allow_negative_numbers = true)]
    patience: Option<f64>,
    /// The experiment fails after this time, s [default: 300]
    #[arg(long, value_name = "S", value_parser = finite, allow_negative_numbers = true)]
    duration: Option<f64>,
    /// Cycles in a row that have to be alike [default: 3]
    #[arg(long, value_name = "N", value_parser = small_count, allow_negative_numbers = true)]
    cycles: Option<u8>,
    /// How alike, as a share of amplitude and half-period [default: 0.1]
    #[arg(long, value_name = "SHARE", value_parser = finite, allow_negative_numbers = true)]
    spread: Option<f64>,
    /// An attempt fails after so many cycles [default: 12]
    #[arg(long, value_name = "N", value_parser = small_count, allow_negative_numbers = true)]
    most_cycles: Option<u8>,
    /// Attempts in all, each with other relay parameters [default: 3]
    #[arg(long, value_name = "N", value_parser = small_count, allow_negative_numbers = true)]
    attempts: Option<u8>,
    /// Factor between the relay parameters of two attempts [default: 1.5]
    #[arg(long, value_name = "F", value_parser = finite, allow_negative_numbers = true)]
    factor: Option<f64>,
}

fn coordinate(text: &str) -> Result<Coordinate, String> {
    match text {
        "position" => Ok(Coordinate::Position),
        "heading-rad" => Ok(Coordinate::HeadingRad),
        "heading-deg" => Ok(Coordinate::HeadingDegrees),
        "speed" => Ok(Coordinate::Speed),
        _ => Err("must be position, heading-rad, heading-deg or speed; choose one".to_owned()),
    }
}

/// The flags of a number that the protocol refuses.
fn flag(fault: &OutOfDomain) -> &'static str {
    match fault.quantity {
        "reference" => "--reference",
        "neutral command" => "--neutral, --lowest, --highest",
        "offset of the relay" => "--offset",
        "lowest command" => "--lowest",
        "highest command" => "--highest",
        "relay level" => "--relay, --offset, --lowest, --highest",
        "half-width" => "--half-width",
        "largest excursion" => "--excursion, --half-width",
        "way in the wrong direction" => "--wrong-way",
        "least time between switchings" => "--dwell, --patience",
        "sampling interval" => "--interval",
        "resolution of the reading" => "--resolution",
        "largest rate" => "--largest-rate",
        "time of one reading" => "--unchanged, --interval, --patience",
        "patience" => "--patience, --duration",
        "duration" => "--duration",
        "spread of cycles" => "--spread",
        "factor between attempts" => "--factor",
        "cycles alike" => "--cycles",
        "cycles of an attempt" => "--most-cycles, --cycles",
        "attempts" => "--attempts",
        _ => "the protocol",
    }
}

/// A fault in words, with the flags of its limits.
pub(super) fn in_words(fault: Fault) -> String {
    let flags = match fault.code() {
        "gap" => "--interval",
        "jump" => "--largest-rate",
        "range" => "--coordinate",
        "excursion" => "--excursion, --relay",
        "wrong-way" => "--wrong-way",
        "no-motion" | "stuck" => "--unchanged",
        "noise" => "--half-width, --dwell",
        "no-oscillation" => "--relay, --lowest, --highest, --patience",
        "not-converged" => "--most-cycles, --spread",
        "condition-40" => "--relay, --half-width",
        "overtime" => "--duration, --attempts",
        _ => return fault.to_string(),
    };
    format!("{fault} ({flags})")
}

impl ProtocolArguments {
    /// The experiment, which starts with its first sample.
    pub(super) fn experiment(&self) -> Result<Experiment<f64>, CommandError> {
        let (coordinate, relay, half_width, interval_s) = (self.coordinate, self.relay, self.half_width, self.interval);
        let usual = match self.excursion {
            Some(excursion) => Protocol::new(coordinate, relay, half_width, excursion, interval_s),
            None => Protocol::usual(coordinate, relay, half_width, interval_s),
        };
        let middle = self.neutral + self.offset;
        let protocol = Protocol {
            reference: self.reference,
            neutral_command: self.neutral,
            relay_offset: self.offset,
            lowest_command: self.lowest.unwrap_or(self.neutral.min(middle + usual.lowest_command)),
            highest_command: self.highest.unwrap_or(self.neutral.max(middle + usual.highest_command)),
            wrong_way: self.wrong_way.unwrap_or(usual.wrong_way),
            dwell_s: self.dwell.unwrap_or(usual.dwell_s),
            resolution: self.resolution,
            largest_rate: self.largest_rate.unwrap_or(usual.largest_rate),
            unchanged_s: self.unchanged.unwrap_or(usual.unchanged_s),
            patience_s: self.patience.unwrap_or(usual.patience_s),
            duration_s: self.duration.unwrap_or(usual.duration_s),
            cycles: self.cycles.unwrap_or(usual.cycles),
            spread: self.spread.unwrap_or(usual.spread),
            most_cycles: self.most_cycles.unwrap_or(usual.most_cycles),
            attempts: self.attempts.unwrap_or(usual.attempts),
            factor: self.factor.unwrap_or(usual.factor),
            ..usual
        };
        Experiment::new(protocol).map_err(|fault| CommandError::Given { flag: flag(&fault), error: fault.into() })
    }
}
