//! `selfosc tune`: a controller for an axis, with its verified margins.

mod design;
mod format;
mod print;

use std::io::Write;
use std::path::PathBuf;

use super::known::{FIRST_ORDER, Model};
use super::number::{non_negative, number, positive};
use super::{CommandError, Outcome, refused, write_json};
use crate::control::{RobustCriterion, Structure};
use crate::numeric::{Interval, Limit};
use crate::plant::DragAxis;
use clap::{ArgGroup, Args};
use design::Tuned;
use format::GainFormat;

/// Gains of a controller for alpha x'' + (beta + beta_quadratic |x'|) x' = u(t - delay), and the margins that it has.
///
/// The axis is given by its parameters or as the model that `selfosc identify --json` found, with all its terms and its constant
/// force; its practical intervals and the covariance of its drag count. A model that is not to be trusted is refused.
/// The gains place the closed loop's poles for a bandwidth (-3 dB of the answer to the reference), or for the largest bandwidth
/// at which every axis of the intervals keeps a limit of the sensitivity or of the phase margin. Drag counts with its slope at rest;
/// where that leaves some axis of the intervals unstable or with a sensitivity above 2, with the least slope, if that is better.
/// The margins count
/// the delay and the filter of the derivative; poles, bandwidth and the answer to a step are computed without the
/// design equations. With intervals, further terms or quadratic drag, margins are proved for every axis too. Exit status 1
/// where some axis in the intervals is not stabilised.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("axis").required(true).args(["model", "alpha"]))]
#[command(group = ArgGroup::new("target").required(true).args(["bandwidth", "ms", "phase_margin"]))]
#[command(after_help = "\
Examples:
  selfosc tune --alpha 0.033 --beta 0.01 --beta-quadratic 0.06 --delay 0.2 --bandwidth 0.8
  selfosc tune --model model.json --ms 1.4 --structure pid --format ardusub
  selfosc tune --alpha 7.5 --beta 3 --bandwidth 0.5 --structure ipd --alpha-interval 7,8 --beta-interval 2,4 --json")]
pub(super) struct Arguments {
    /// Model to tune for: what `selfosc identify --json` printed; its intervals count too
    #[arg(long, value_name = "RESULT.json", conflicts_with_all = ["beta", "beta_quadratic", "delta", "delay"])]
    model: Option<PathBuf>,
    /// Inertia with added mass, command units per output unit per s^2
    #[arg(long, value_parser = number, value_name = "A", allow_negative_numbers = true)]
    alpha: Option<f64>,
    /// Linear drag, command units per output unit per s
    #[arg(long, value_parser = number, value_name = "B", default_value_t = 0.0, allow_negative_numbers = true)]
    beta: f64,
    /// Quadratic drag, command units per (output unit per s)^2
    #[arg(long, value_parser = number, value_name = "Q", default_value_t = 0.0, allow_negative_numbers = true)]
    beta_quadratic: f64,
    /// Constant force, command units
    #[arg(long, value_parser = number, value_name = "D", default_value_t = 0.0, allow_negative_numbers = true)]
    delta: f64,
    /// Bandwidth of the answer to the reference, rad/s
    #[arg(long, value_parser = number, value_name = "W", allow_negative_numbers = true)]
    bandwidth: Option<f64>,
    /// Largest sensitivity 1/|1 + L| of any axis in the intervals: 1.2 is cautious, 1.4 usual, 2 lively
    #[arg(long, value_name = "M", value_parser = sensitivity, allow_negative_numbers = true)]
    ms: Option<f64>,
    /// Least phase margin of any axis in the intervals, degrees
    #[arg(long, value_name = "DEG", value_parser = phase, allow_negative_numbers = true)]
    phase_margin: Option<f64>,
    /// On what the actions act: pd and pid act on the error, ipd with its integral only; the derivative acts on the
    /// measurement
    #[arg(long, value_name = "NAME", default_value = "pd", value_parser = structure)]
    structure: Structure,
    /// Delay of the whole loop in s
    #[arg(long, value_parser = number, value_name = "S", default_value_t = 0.0, allow_negative_numbers = true)]
    delay: f64,
    /// Step of the reference to simulate, output units
    #[arg(long, value_parser = number, value_name = "X", default_value_t = 1.0, allow_negative_numbers = true)]
    step: f64,
    /// Largest command either way in that step, command units [default: no limit]
    #[arg(long, value_parser = positive, value_name = "U", allow_negative_numbers = true)]
    limit: Option<f64>,
    /// Speed up to which quadratic drag is counted in the margins, output units per s [default: the step's]
    #[arg(long, value_parser = non_negative, value_name = "V", allow_negative_numbers = true)]
    top_speed: Option<f64>,
    /// Interval of the inertia
    #[arg(long, value_name = "LOW,HIGH", value_parser = interval, allow_hyphen_values = true)]
    alpha_interval: Option<Interval>,
    /// Interval of linear drag; the covariance of a model's drag then does not count
    #[arg(long, value_name = "LOW,HIGH", value_parser = interval, allow_hyphen_values = true)]
    beta_interval: Option<Interval>,
    /// Interval of quadratic drag; the covariance of a model's drag then does not count
    #[arg(long, value_name = "LOW,HIGH", value_parser = interval, allow_hyphen_values = true)]
    beta_quadratic_interval: Option<Interval>,
    /// Interval of the delay
    #[arg(long, value_name = "LOW,HIGH", value_parser = interval, allow_hyphen_values = true)]
    delay_interval: Option<Interval>,
    /// In which form the gains are printed
    #[arg(long, value_enum, value_name = "FORM", default_value_t = GainFormat::Text)]
    format: GainFormat,
    /// Command at full output of the actuator, command units: a format for autopilots is for commands from -1 to 1
    #[arg(long, value_name = "U", default_value_t = 1.0, value_parser = positive, allow_negative_numbers = true)]
    full_command: f64,
    /// Prints one JSON document
    #[arg(long, conflicts_with = "format")]
    json: bool,
}

/// Limits that may be asked for.
const SENSITIVITIES: core::ops::RangeInclusive<f64> = 1.05..=4.0;
const PHASES_DEG: core::ops::RangeInclusive<f64> = 5.0..=80.0;

fn sensitivity(text: &str) -> Result<f64, String> {
    let within = |value: &f64| SENSITIVITIES.contains(value);
    number(text).ok().filter(within).ok_or_else(|| "must be from 1.05 to 4; 1.4 is usual".to_owned())
}

fn phase(text: &str) -> Result<f64, String> {
    let within = |value: &f64| PHASES_DEG.contains(value);
    number(text).ok().filter(within).ok_or_else(|| "must be from 5 to 80 degrees; 45 is usual".to_owned())
}

fn structure(text: &str) -> Result<Structure, String> {
    let all = [Structure::Pd, Structure::Pid, Structure::Ipd];
    all.into_iter().find(|one| one.name() == text).ok_or_else(|| "must be pd, pid or ipd; choose one".to_owned())
}

fn interval(text: &str) -> Result<Interval, String> {
    let ends = text.split_once(',').and_then(|(low, high)| Some((low.trim().parse().ok()?, high.trim().parse().ok()?)));
    ends.and_then(|(low, high)| Interval::new(low, high))
        .ok_or_else(|| "must be two numbers, the lower first; write them as 0.5,2".to_owned())
}

impl Arguments {
    /// The axis as given or as identified, each parameter with its interval where one is known.
    fn known(&self) -> Result<Model, CommandError> {
        if self.alpha == Some(0.0) {
            return Err(CommandError::Usage { reason: format!("--alpha is 0: {FIRST_ORDER}") });
        }
        let model = match (&self.model, self.alpha) {
            (Some(path), _) => Model::read(path)?,
            (None, alpha) => {
                // What a record found may drive the axis a little; what is given may not.
                let axis = DragAxis::mixed(alpha.unwrap_or(f64::NAN), self.beta, self.beta_quadratic)?;
                Model::given(&axis.with_disturbance(self.delta)?.with_delay_s(self.delay)?)
            }
        };
        model.with_intervals([
            ("--alpha-interval", self.alpha_interval, Limit::Positive),
            ("--beta-interval", self.beta_interval, Limit::Finite),
            ("--beta-quadratic-interval", self.beta_quadratic_interval, Limit::Finite),
            ("--delay-interval", self.delay_interval, Limit::NonNegative),
        ])
    }

    /// What every axis is to have, where no bandwidth is asked for.
    fn limit_of_all(&self) -> Option<RobustCriterion> {
        let phase = self.phase_margin.map(|degrees| RobustCriterion::PhaseRad(degrees.to_radians()));
        self.ms.map(RobustCriterion::Sensitivity).or(phase)
    }
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let model = arguments.known()?;
    arguments.format.takes(&model)?;
    let tuned = match Tuned::new(&model, arguments) {
        Err(error) if ["unstable", "out-of-reach"].contains(&error.code()) => {
            return refused(&error.into(), arguments.json, output);
        }
        other => other?,
    };
    match arguments.format {
        _ if arguments.json => write_json(output, &tuned.json())?,
        GainFormat::Json => write_json(output, &tuned.json())?,
        GainFormat::Text => tuned.print(output)?,
        form => output.write_all(form.text(&tuned, arguments.full_command)?.as_bytes())?,
    }
    Ok(Outcome::Done)
}
