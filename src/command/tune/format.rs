//! Gains in the form in which they are typed in.

use core::f64::consts::TAU;

use clap::ValueEnum;

use super::design::Tuned;
use crate::command::CommandError;
use crate::command::known::Model;
use crate::control::{Gains, Structure};
use crate::numeric::domain::{AtLeast, AtMost};
use crate::numeric::significant;

/// A form of the gains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum GainFormat {
    /// For a person
    Text,
    /// One JSON document
    Json,
    /// Parameters of ArduSub's yaw loops
    Ardusub,
    /// Parameters of PX4's controller of underwater vehicles, yaw
    Px4,
    /// The C call that makes the same controller
    C,
}

/// Steps per second of the autopilots' loops: `SCHED_LOOP_RATE` of ArduSub.
const LOOP_HZ: f64 = 400.0;
/// Least rate of a loop over its bandwidth: 10 to 30 by Astrom and Wittenmark, *Computer-Controlled Systems* (1997), section 2.9.
const STEPS: f64 = 10.0;

impl GainFormat {
    /// Whether this form is for such a model: an autopilot's yaw loops take a heading.
    pub(super) fn takes(self, model: &Model) -> Result<(), CommandError> {
        if model.length && matches!(self, Self::Ardusub | Self::Px4) {
            let reason = "the model's output is in m, and must be an angle for the autopilot's yaw loops; choose text, json or c, or give \
                          the model of a heading (--model)";
            return Err(no_form(reason));
        }
        Ok(())
    }

    pub(super) fn text(self, tuned: &Tuned, full_command: f64) -> Result<String, CommandError> {
        let gains = tuned.tuning.gains();
        let parameters = match self {
            Self::Ardusub => ardusub(gains, full_command)?,
            Self::Px4 => px4(gains, full_command)?,
            _ => return Ok(c(gains)),
        };
        let (pole_rad_s, most_rad_s) = (tuned.tuning.double_pole_rad_s(), TAU * LOOP_HZ / STEPS);
        if pole_rad_s > most_rad_s {
            return Err(no_form(&format!(
                "poles at {} rad/s, at most {} rad/s for the autopilot's loop of {LOOP_HZ} Hz; check the unit of the log's times \
                 (`selfosc identify --time-unit`), or ask for less (--bandwidth)",
                AtLeast(pole_rad_s),
                AtMost(most_rad_s)
            )));
        }
        let offset = match tuned.offset() {
            0.0 => String::new(),
            offset => {
                let remedy = match self {
                    Self::Px4 => "PX4's controller has no integral against it",
                    _ => "choose --structure pid against it",
                };
                format!("# the constant force leaves the vehicle {} rad off; {remedy}\n", significant(offset, 3))
            }
        };
        Ok(format!(
            "# command from -1 to 1: {full_command} of the log's unit is 1 (--full-command); angles in rad\n\
             # largest sensitivity of any axis {}\n{offset}{parameters}",
            significant(tuned.worst.sensitivity.met, 3)
        ))
    }
}

fn no_form(reason: &str) -> CommandError {
    CommandError::Usage { reason: format!("--format: {reason}") }
}

/// `command = R (A error - rate) + I int(A error - rate)`: the cascade of ArduPilot's attitude and rate loops. Equal to
/// `K_p error + K_i int error - K_d rate` with `R = K_d`, `A R + I = K_p`, `A I = K_i`.
fn ardusub(gains: &Gains<f64>, full_command: f64) -> Result<String, CommandError> {
    if gains.structure() == Structure::Ipd {
        return Err(no_form("ArduSub's loops act on the error; choose --structure pd or pid"));
    }
    let [proportional, integral, derivative] =
        [gains.proportional(), gains.integral(), gains.derivative()].map(|gain| gain / full_command);
    let root = proportional.powi(2) - 4.0 * derivative * integral;
    if !(derivative > 0.0 && root >= 0.0) {
        let reason = "no cascade has these gains; choose --structure pd, or a bandwidth further above that of the drag";
        return Err(no_form(reason));
    }
    let angle = (proportional + root.sqrt()) / (2.0 * derivative);
    let rate_integral = integral / angle;
    Ok(format!(
        "# set the rate loop's own filter apart\n\
         ATC_ANG_YAW_P {angle:.4}\nATC_RAT_YAW_P {derivative:.6}\nATC_RAT_YAW_I {rate_integral:.6}\nATC_RAT_YAW_D 0\n"
    ))
}

/// `torque = P error - D rate`, of PX4's module `uuv_att_control`.
fn px4(gains: &Gains<f64>, full_command: f64) -> Result<String, CommandError> {
    if gains.structure() != Structure::Pd {
        return Err(no_form("PX4's controller of underwater vehicles has no integral; choose --structure pd"));
    }
    let (proportional, derivative) = (gains.proportional() / full_command, gains.derivative() / full_command);
    Ok(format!("UUV_YAW_P {proportional:.6}\nUUV_YAW_D {derivative:.6}\n"))
}

fn c(gains: &Gains<f64>) -> String {
    let structure = match gains.structure() {
        Structure::Pd => "SELFOSC_STRUCTURE_PD",
        Structure::Pid => "SELFOSC_STRUCTURE_PID",
        Structure::Ipd => "SELFOSC_STRUCTURE_IPD",
    };
    format!(
        "SelfoscController_f64 controller;\n\
         SelfoscGains_f64 gains = {{\n    .structure = {structure},\n    .proportional = {:e},\n    .integral = {:e},\n    \
         .derivative = {:e},\n    .filter_s = {:e},\n}};\n\
         selfosc_controller_begin_f64(&controller, &gains);\n",
        gains.proportional(),
        gains.integral(),
        gains.derivative(),
        gains.filter_s(),
    )
}
