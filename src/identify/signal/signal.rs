//! A record as a signal.

use nalgebra::{DMatrix, DVector};

use super::clock::{Clock, grid};
use super::command::{CommandPiece, Kick, SwitchingInstant, is_switched, pieces_between, switchings};
use super::numbers::{extent, least_squares};
use crate::experiment::Record;
use crate::plant::State;

/// The highest speed is a difference quotient over the half-period divided by this.
const SPEED_SPANS: f64 = 6.0;

/// A record as a signal, under an assumption on its clock and its switchings.
#[derive(Clone, Debug)]
pub(crate) struct Signal {
    pub(crate) time_s: Vec<f64>,
    pub(crate) output: Vec<f64>,
    pub(crate) pieces: Vec<CommandPiece>,
    pub(crate) kicks: Vec<Kick>,
    /// Whether the command takes few values.
    pub(crate) switched: bool,
    /// Largest less least command.
    pub(crate) range: f64,
    /// Largest less least output.
    pub(crate) span: f64,
    /// Highest speed.
    pub(crate) fastest: f64,
    pub(crate) interval_s: f64,
    pub(crate) half_period_s: f64,
}

impl Signal {
    pub(crate) fn new(record: &Record, clock: Clock, switching: SwitchingInstant) -> Self {
        let time_s = match clock {
            Clock::Grid => grid(record).unwrap_or_else(|| record.time_s().to_vec()),
            Clock::Stamps => record.time_s().to_vec(),
        };
        let (output, input) = (record.output().to_vec(), record.input());
        let (interval_s, half_period_s) = (record.interval_s(), half_period_s(record));
        let switched = is_switched(input);
        let (pieces, kicks) = if switched {
            switchings(&time_s, input, interval_s, switching)
        } else {
            (pieces_between(&time_s, input, switching), Vec::new())
        };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
        let reach = (half_period_s / (SPEED_SPANS * interval_s)).max(1.0) as usize;
        let speed = |k: usize| ((output[k + reach] - output[k]) / (time_s[k + reach] - time_s[k])).abs();
        let fastest = (0..output.len().saturating_sub(reach)).map(speed).fold(0.0, f64::max);
        let (range, span) = (extent(input), extent(&output));
        Self { time_s, output, pieces, kicks, switched, range, span, fastest, interval_s, half_period_s }
    }

    pub(crate) fn duration_s(&self) -> f64 {
        self.time_s[self.time_s.len() - 1] - self.time_s[0]
    }

    /// The state at a time, from the parabola of least squares through the readings within `reach_s`, four at least.
    pub(crate) fn state_near(&self, at_s: f64, reach_s: f64) -> State<f64> {
        let Self { time_s, output, .. } = self;
        let from = time_s.partition_point(|t| *t < at_s - reach_s).min(time_s.len() - 4);
        let to = time_s.partition_point(|t| *t <= at_s + reach_s).max(from + 4).min(time_s.len());
        let matrix =
            DMatrix::from_fn(to - from, 3, |row, power| ((time_s[from + row] - at_s) / reach_s).powi(power as i32));
        let solution = least_squares(matrix, DVector::from_fn(to - from, |row, _| output[from + row] - output[from]));
        let (offset, velocity) = (solution[0], solution[1] / reach_s);
        if offset.is_finite() && velocity.is_finite() {
            State { position: output[from] + offset, velocity }
        } else {
            State { position: output[from], velocity: 0.0 }
        }
    }
}

/// A crossing of the mean counts beyond this part of the standard deviation.
const CROSSING_MARGIN: f64 = 0.3;
/// The fewest half-periods in a record, and the fewest samples in a half-period.
const FEWEST_HALF_PERIODS: f64 = 5.0;
const FEWEST_SAMPLES: f64 = 6.0;

/// Half-period of a record in s, its characteristic time: the mean time between crossings of the mean, of which a dozen weights
/// as long must overlap.
pub(crate) fn half_period_s(record: &Record) -> f64 {
    let output = record.output();
    let count = output.len() as f64;
    let mean = output.iter().sum::<f64>() / count;
    let margin = CROSSING_MARGIN * (output.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt();
    let (mut side, mut crossings) = (0.0, 0.0);
    for value in output {
        let now = if (value - mean).abs() > margin { (value - mean).signum() } else { side };
        if side != 0.0 && now != side {
            crossings += 1.0;
        }
        side = now;
    }
    (record.duration_s() / (crossings + 1.0))
        .min(record.duration_s() / FEWEST_HALF_PERIODS)
        .max(FEWEST_SAMPLES * record.interval_s())
}
