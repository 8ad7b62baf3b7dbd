//! Figs. 12-13: the responses in an experiment, with a relay with and without hysteresis.

use super::PaperError;
use super::joint::JointRow;
use super::relay_figures::Curve;
use crate::experiment::{Record, Sensor, SimulatedExperiment};
use crate::nonlinearity::RelayHysteresis;
use crate::plant::DragAxis;

/// Level of the relay, 1e-2 N m: that of experiments 7 to 13.
const LEVEL: f64 = 8.23;
/// Half-width of Fig. 12, degrees.
const HALF_WIDTH_DEG: f64 = 10.0;
/// Force of a tether, assumed, 1e-2 N m.
const DISTURBANCE: f64 = 0.5;
/// The command's way to the thrusters, and the reading's back (eq. 36), s.
const ONE_WAY_S: f64 = 0.1;
const RATE_HZ: f64 = 10.0;
const DURATION_S: f64 = 20.0;

/// A simulated experiment over time in s: the compass in whole degrees, the command in 1e-2 N m.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// Readings, deg.
    pub heading: Curve,
    /// The command, held between samples.
    pub command: Curve,
    /// The largest reading of each half cycle that rises above zero.
    pub maxima: Curve,
    /// The smallest reading of each half cycle that falls below zero.
    pub minima: Curve,
    /// Readings at which the relay switched.
    pub switchings: Curve,
    /// Preset half-width of the relay, deg.
    pub half_width_deg: f64,
}

/// Regenerates Fig. 12 in kind: the paper prints no record, so it is simulated, for an axis with the quadratic drag that
/// all experiments together give for the paper's delay.
///
/// # Errors
/// [`PaperError::NoQuadraticFit`] without such a fit among `joint`.
pub fn figure12(joint: &[JointRow]) -> Result<Response, PaperError> {
    response(joint, HALF_WIDTH_DEG)
}

/// Regenerates Fig. 13 in kind: as [`figure12`], with a half-width of zero.
///
/// # Errors
/// As [`figure12`].
pub fn figure13(joint: &[JointRow]) -> Result<Response, PaperError> {
    response(joint, 0.0)
}

fn response(joint: &[JointRow], half_width_deg: f64) -> Result<Response, PaperError> {
    let fit = joint.iter().find(|row| !row.delay_estimated && row.drag == "quadratic");
    let (alpha, beta) = fit
        .and_then(|row| Some((row.alpha, row.beta_quadratic?)))
        .ok_or(PaperError::NoQuadraticFit { rows: joint.len() })?;
    // The units of Table 4 against a level in 1e-2 N m.
    let axis = DragAxis::quadratic(alpha / 100.0, beta / 1000.0)?;
    let axis = axis.with_disturbance(DISTURBANCE)?.with_delay_s(ONE_WAY_S)?;
    let sensor = Sensor { delay_s: ONE_WAY_S, quantum: 1.0, noise: 0.0 };
    let relay = RelayHysteresis::new(LEVEL, half_width_deg, 0.0)?;
    let record = SimulatedExperiment::new(axis, relay, RATE_HZ)?.with_sensor(sensor)?.held().run(DURATION_S)?;
    Ok(marked(&record, half_width_deg))
}

fn marked(record: &Record, half_width_deg: f64) -> Response {
    let samples = || record.time_s().iter().copied().zip(record.output().iter().copied());
    let commands: Curve = record.time_s().iter().copied().zip(record.input().iter().copied()).collect();
    let held = commands.windows(2).flat_map(|pair| [pair[0], (pair[1].0, pair[0].1)]);
    let switched: Vec<usize> = (1..commands.len()).filter(|&i| commands[i].1 != commands[i - 1].1).collect();
    let heading: Curve = samples().collect();
    // Between two switchings lies a single extremum: the command at the first of them turns the motion.
    let extrema = |sign: f64| -> Curve {
        let between = switched.windows(2).filter(|pair| commands[pair[0]].1 * sign < 0.0);
        between
            .filter_map(|pair| {
                heading[pair[0]..pair[1]].iter().copied().max_by(|a, b| (sign * a.1).total_cmp(&(sign * b.1)))
            })
            .collect()
    };
    Response {
        command: held.collect(),
        maxima: extrema(1.0),
        minima: extrema(-1.0),
        switchings: switched.iter().map(|&i| heading[i]).collect(),
        heading,
        half_width_deg,
    }
}
