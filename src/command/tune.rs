//! `selfosc tune`: a controller for an axis, with its verified margins.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};

use super::known::{Known, Model};
use super::number::{non_negative, number, positive};
use super::{CommandError, Outcome, refused, write_json};
use crate::control::{
    Answer, AxisIntervals, ControlError, Controller, Margins, OpenLoop, StepResponse, Structure, Tuning, WorstMargin,
    WorstMargins,
};
use crate::numeric::Interval;
use crate::numeric::significant;
use crate::plant::DragAxis;

/// Gains of a controller for alpha x'' + (beta + beta_quadratic |x'|) x' = u(t - delay), and the margins that it has.
///
/// The axis is given by its parameters or as the model that `selfosc identify --json` found, whose 95 % intervals then count;
/// a model that is not to be trusted is refused.
/// The gains place the closed loop's poles for a bandwidth (-3 dB of the answer to the reference). The margins count
/// the delay and the filter of the derivative; poles, bandwidth and the answer to a step are computed without the
/// design equations. With intervals, or quadratic drag, margins are given for every axis in them too. Exit status 1
/// where some axis in the intervals is not stabilised.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  selfosc tune --alpha 0.033 --beta 0.01 --beta-quadratic 0.06 --delay 0.2 --bandwidth 0.8
  selfosc tune --alpha 7.5 --beta 3 --bandwidth 0.5 --structure ipd --alpha-interval 7,8 --beta-interval 2,4 --json")]
pub(super) struct Arguments {
    /// Model to tune for: what `selfosc identify --json` printed; its intervals count too
    #[arg(long, value_name = "RESULT.json", required_unless_present = "alpha", conflicts_with_all = ["alpha", "beta", "beta_quadratic", "delay"])]
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
    /// Bandwidth of the answer to the reference, rad/s
    #[arg(long, value_parser = number, value_name = "W", allow_negative_numbers = true)]
    bandwidth: f64,
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
    /// Interval of linear drag
    #[arg(long, value_name = "LOW,HIGH", value_parser = interval, allow_hyphen_values = true)]
    beta_interval: Option<Interval>,
    /// Interval of quadratic drag
    #[arg(long, value_name = "LOW,HIGH", value_parser = interval, allow_hyphen_values = true)]
    beta_quadratic_interval: Option<Interval>,
    /// Interval of the delay
    #[arg(long, value_name = "LOW,HIGH", value_parser = interval, allow_hyphen_values = true)]
    delay_interval: Option<Interval>,
    /// Prints one JSON document
    #[arg(long)]
    json: bool,
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

/// Samples in the time constant of the double pole, and time constants in the simulated step: the hold is a
/// four-hundredth of one, and the slow pole of a PID has six of its own.
const SAMPLES: f64 = 200.0;
const TIME_CONSTANTS: f64 = 60.0;

/// A design and what was found on it.
struct Tuned {
    tuning: Tuning<f64>,
    poles: Vec<nalgebra::Complex<f64>>,
    response: StepResponse,
    top_speed: f64,
    /// `None` where the parameters are points and drag is linear.
    worst: Option<WorstMargins>,
}

impl Arguments {
    fn tuned(&self, model: &Model) -> Result<Tuned, ControlError> {
        let Model { alpha, beta, beta_quadratic, delay_s } = model;
        let axis = DragAxis::mixed(alpha.value, beta.value, beta_quadratic.value)?.with_delay_s(delay_s.value)?;
        let tuning = Tuning::new(&axis, self.structure, self.bandwidth)?;
        let w = tuning.double_pole_rad_s();
        let controller = Controller::new(tuning.gains());
        let controller = match self.limit {
            Some(limit) => controller.with_limits(-limit, limit)?,
            None => controller,
        };
        let response = StepResponse::simulate(&axis, controller, self.step, SAMPLES * w, TIME_CONSTANTS / w)?;
        let top_speed = self.top_speed.unwrap_or_else(|| response.top_speed());
        let poles = OpenLoop::new(&axis, tuning.gains(), 0.0)?.closed_loop_poles()?;
        let known = [alpha, beta, beta_quadratic, delay_s];
        let worst = if known.iter().any(|one| one.interval.is_some()) || axis.quadratic_drag() > 0.0 {
            let [alpha, beta, beta_quadratic, delay_s] = known.map(Known::range);
            let intervals = AxisIntervals::at_speeds(alpha, beta, beta_quadratic, top_speed, delay_s)?;
            Some(intervals.worst_margins(tuning.gains())?)
        } else {
            None
        };
        Ok(Tuned { tuning, poles, response, top_speed, worst })
    }
}

impl Arguments {
    /// The axis as given or as identified, each parameter with its interval where one is known.
    fn known(&self) -> Result<Model, CommandError> {
        let intervals = [self.alpha_interval, self.beta_interval, self.beta_quadratic_interval, self.delay_interval];
        match (&self.model, self.alpha) {
            (Some(path), _) => Model::read(path)?.with_intervals(intervals),
            (None, alpha) => {
                let alpha = alpha.unwrap_or(f64::NAN);
                Model::of([alpha, self.beta, self.beta_quadratic, self.delay]).with_intervals(intervals)
            }
        }
    }
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let model = arguments.known()?;
    let tuned = match arguments.tuned(&model) {
        Err(error @ ControlError::Unstable { .. }) => return refused(&error.into(), arguments.json, output),
        other => other?,
    };
    if arguments.json {
        write_json(output, &tuned.json(arguments.step))?;
    } else {
        tuned.print(output)?;
    }
    Ok(Outcome::Done)
}

impl Tuned {
    fn json(&self, step: f64) -> Value {
        let (gains, margins, answer) = (self.tuning.gains(), self.tuning.margins(), self.response.answer());
        json!({
            "gains": gains,
            "double_pole_rad_s": self.tuning.double_pole_rad_s(),
            "margins": margins,
            "verified": {
                "poles": self.poles.iter().map(|pole| [pole.re, pole.im]).collect::<Vec<_>>(),
                "bandwidth_rad_s": self.tuning.achieved_bandwidth_rad_s(),
                "step": {
                    "size": step,
                    "rise_s": answer.rise_s,
                    "overshoot_percent": answer.overshoot_percent,
                    "settling_s": answer.settling_s,
                    "final_error": answer.final_error,
                    "top_speed": self.response.top_speed(),
                },
            },
            "worst_case": self.worst.as_ref().map(|found| json!({
                "top_speed": self.top_speed,
                "at_least": found.at_least,
                "met": found.met,
                "boxes": found.boxes,
            })),
        })
    }

    fn print(&self, output: &mut impl Write) -> Result<(), CommandError> {
        let (gains, margins) = (self.tuning.gains(), self.tuning.margins());
        let mut row = |name: &str, value: f64| writeln!(output, "{name:34}{:>14}", significant(value, 6));
        row("proportional gain / (F/x)", gains.proportional())?;
        row("integral gain / (F/(x s))", gains.integral())?;
        row("derivative gain / (F s/x)", gains.derivative())?;
        row("filter of the derivative / s", gains.filter_s())?;
        let Margins { gain, gain_reduction, phase_rad, delay_s, .. } = *margins;
        let nominal = WorstMargin { gain, gain_reduction, phase_rad, delay_s };
        let worst = self.worst.as_ref();
        let mut line = |name: &str, nominal: &str, all: Option<String>| {
            let all = all.map_or_else(String::new, |all| format!("{all:>20}"));
            writeln!(output, "{name:34}{nominal:>14}{all}")
        };
        line("\nmargins", "at rest", worst.map(|_| "at least for all".to_owned()))?;
        type Part = fn(&WorstMargin) -> Option<f64>;
        let parts: [(&str, Part); 4] = [
            ("gain, may grow by a factor", |margin| margin.gain),
            ("gain, may be divided by", |margin| margin.gain_reduction),
            ("phase / deg", |margin| Some(margin.phase_rad.to_degrees())),
            ("delay, may grow by / s", |margin| Some(margin.delay_s)),
        ];
        for (name, part) in parts {
            let text =
                |margin: &WorstMargin| part(margin).map_or_else(|| "any".to_owned(), |value| significant(value, 4));
            line(name, &text(&nominal), worst.map(|found| text(&found.at_least)))?;
        }
        if let Some(found) = worst {
            writeln!(
                output,
                "all: the intervals given, speeds up to {} x/s, {} boxes",
                significant(self.top_speed, 4),
                found.boxes
            )?;
        }
        self.print_verified(output)?;
        writeln!(
            output,
            "\nF: unit of the command, x: unit of the output; a model from `identify` has rad where the log has degrees"
        )?;
        Ok(())
    }

    fn print_verified(&self, output: &mut impl Write) -> Result<(), CommandError> {
        let Answer { rise_s, overshoot_percent, settling_s, final_error } = self.response.answer();
        let slowest = self.poles.first().map_or(f64::NAN, |pole| pole.re);
        let number = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| significant(value, 4));
        writeln!(output, "\nverified without the design equations")?;
        let mut row = |name: &str, value: Option<f64>| writeln!(output, "{name:34}{:>14}", number(value));
        row("slowest pole / (rad/s)", Some(slowest))?;
        row("bandwidth with the delay / (rad/s)", self.tuning.achieved_bandwidth_rad_s())?;
        row("step: rise 10-90 % / s", rise_s)?;
        row("step: overshoot / %", Some(overshoot_percent))?;
        row("step: settling to 2 % / s", settling_s)?;
        row("step: error at the end", Some(final_error))?;
        Ok(())
    }
}
