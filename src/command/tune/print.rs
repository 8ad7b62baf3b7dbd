//! A design for a person, and as a document.

use std::io::Write;

use serde_json::{Value, json};

use super::design::Tuned;
use crate::command::CommandError;
use crate::control::{Answer, Margins, StepResponse, WorstMargin};
use crate::numeric::significant;

/// A share of the step that sums of some thousand simulated intervals lose.
const ROUNDING: f64 = 1e-12;

fn step_json(size: f64, response: &StepResponse) -> Value {
    let answer = response.answer();
    json!({
        "size": size,
        "rise_s": answer.rise_s,
        "overshoot_percent": answer.overshoot_percent,
        "settling_s": answer.settling_s,
        "final_error": answer.final_error,
        "top_speed": response.top_speed(),
    })
}

impl Tuned {
    pub(super) fn json(&self) -> Value {
        json!({
            "gains": self.tuning.gains(),
            "double_pole_rad_s": self.tuning.double_pole_rad_s(),
            "placed_for_slope": self.tuning.slope(),
            "margins": self.tuning.margins(),
            "verified": {
                "poles": self.poles.iter().map(|pole| [pole.re, pole.im]).collect::<Vec<_>>(),
                "bandwidth_rad_s": self.tuning.achieved_bandwidth_rad_s(),
                "step": step_json(self.step, &self.response),
            },
            "sensitivity": { "met": self.worst.sensitivity.met, "proved_upper": self.worst.sensitivity.proved },
            "worst_case": self.varies.then_some(&self.worst).map(|found| json!({
                "top_speed": self.top_speed,
                "at_least": found.at_least,
                "met": found.met,
                "proved": found.proved,
            })),
            "offset": self.offset(),
            "with_force": self.with_force.as_ref().map(|response| json!({
                "delta": self.model.delta,
                "feed_forward": -self.model.delta,
                "step": step_json(self.step, response),
            })),
        })
    }

    pub(super) fn print(&self, output: &mut impl Write) -> Result<(), CommandError> {
        let (gains, margins) = (self.tuning.gains(), self.tuning.margins());
        let x = if self.degrees { "rad" } else { "x" };
        let mut row = |name: &str, unit: &str, value: f64| {
            write!(output, "{:34}{:>14}", format!("{name} / {unit}"), significant(value, 6))?;
            // An angle in degrees in the log: the same gain for an error in degrees.
            if self.degrees && unit.contains("rad") {
                write!(output, "   {} / {}", significant(value.to_radians(), 6), unit.replace("rad", "deg"))?;
            }
            writeln!(output)
        };
        row("proportional gain", &format!("(F/{x})"), gains.proportional())?;
        row("integral gain", &format!("(F/({x} s))"), gains.integral())?;
        row("derivative gain", &format!("(F s/{x})"), gains.derivative())?;
        row("filter of the derivative", "s", gains.filter_s())?;
        if self.tuning.slope() != self.tuning.axis().linear_drag() {
            writeln!(
                output,
                "poles placed for a drag of slope {} F s/{x} at rest, the least that the intervals leave; other slopes damp more",
                significant(self.tuning.slope(), 4)
            )?;
        }
        let Margins { gain, gain_reduction, phase_rad, delay_s, .. } = *margins;
        let nominal = WorstMargin { gain, gain_reduction, phase_rad, delay_s };
        let worst = self.varies.then_some(&self.worst);
        let mut line = |name: &str, nominal: &str, all: Option<String>| {
            let all = all.map_or_else(String::new, |all| format!("{all:>20}"));
            writeln!(output, "{name:34}{nominal:>14}{all}")
        };
        line("\nmargins", "at rest", worst.map(|_| "at least for all".to_owned()))?;
        type MarginOf = fn(&WorstMargin) -> Option<f64>;
        let parts: [(&str, MarginOf, f64); 4] = [
            ("gain, may grow by a factor", |margin| margin.gain, 1.0),
            ("gain, may be divided by", |margin| margin.gain_reduction, 1.0),
            ("phase / deg", |margin| Some(margin.phase_rad.to_degrees()), 0.0),
            ("delay, may grow by / s", |margin| Some(margin.delay_s), 0.0),
        ];
        for (name, part, none) in parts {
            let text =
                |margin: &WorstMargin| part(margin).map_or_else(|| "any".to_owned(), |value| significant(value, 4));
            let all = |margin: &WorstMargin| {
                if part(margin) == Some(none) { "not proved".to_owned() } else { text(margin) }
            };
            line(name, &text(&nominal), worst.map(|found| all(&found.at_least)))?;
        }
        let peak = self
            .worst
            .sensitivity
            .proved
            .map_or_else(|| "not proved".to_owned(), |most| format!("at most {}", significant(most, 4)));
        writeln!(output, "{:34}{:>14}{peak:>20}", "largest sensitivity", significant(self.worst.sensitivity.met, 4))?;
        if self.has_little_margin() {
            writeln!(output, "a sensitivity above 2 leaves little margin: ask for another bandwidth, or for --ms 2")?;
        }
        if worst.is_some() {
            writeln!(
                output,
                "all: the intervals given, speeds up to {} {x}/s, proved in interval arithmetic",
                significant(self.top_speed, 4)
            )?;
        }
        self.print_verified(x, output)?;
        self.print_force(x, output)?;
        if self.model.coulomb != 0.0 {
            writeln!(
                output,
                "\nCoulomb friction of {} F: an integral makes the axis stick and slip about the reference; a PD stops up to {} {x} away",
                significant(self.model.coulomb, 4),
                significant(self.model.coulomb / gains.proportional(), 3)
            )?;
        }
        writeln!(
            output,
            "\nF: unit of the command, {x}: {}",
            if self.degrees { "an angle in radians, also of a log in degrees" } else { "unit of the output" }
        )?;
        Ok(())
    }

    fn print_verified(&self, x: &str, output: &mut impl Write) -> Result<(), CommandError> {
        let slowest = self.poles.first().map_or(f64::NAN, |pole| pole.re);
        writeln!(output, "\nverified without the design equations")?;
        let mut row = |name: &str, value: Option<f64>| writeln!(output, "{name:34}{:>14}", number(value));
        row("slowest pole / (rad/s)", Some(slowest))?;
        row("bandwidth with the delay / (rad/s)", self.tuning.achieved_bandwidth_rad_s())?;
        let Answer { rise_s, overshoot_percent, settling_s, final_error } = self.response.answer();
        row("step: rise 10-90 % / s", rise_s)?;
        row("step: overshoot / %", Some(overshoot_percent))?;
        row("step: settling to 2 % / s", settling_s)?;
        row(&format!("step: error at the end / {x}"), Some(self.step_error(final_error)))?;
        Ok(())
    }

    /// An error relative to the step, in units of the output: none below the rounding of the simulation's sums.
    fn step_error(&self, relative: f64) -> f64 {
        if relative.abs() < ROUNDING { 0.0 } else { relative * self.step }
    }

    /// What the constant force does.
    fn print_force(&self, x: &str, output: &mut impl Write) -> Result<(), CommandError> {
        let Some(response) = &self.with_force else { return Ok(()) };
        let answer = response.answer();
        writeln!(output, "\nunder the constant force of {} F", significant(self.model.delta, 4))?;
        let mut row = |name: &str, value: Option<f64>| writeln!(output, "{name:34}{:>14}", number(value));
        row("step: settling to 2 % / s", answer.settling_s)?;
        row(&format!("step: error at the end / {x}"), Some(self.step_error(answer.final_error)))?;
        if self.tuning.gains().integral() == 0.0 {
            let offset = self.offset();
            let degrees =
                if self.degrees { format!(", {} deg", significant(offset.to_degrees(), 3)) } else { String::new() };
            writeln!(
                output,
                "a PD stays {} {x}{degrees} off; add the command {} F to it, or choose --structure pid",
                significant(offset, 4),
                significant(-self.model.delta, 4)
            )?;
        }
        Ok(())
    }
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| significant(value, 4))
}
