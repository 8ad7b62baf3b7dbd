//! The answer to a step of the reference: simulated on an axis, and its figures.

use crate::numeric::{Limit, domain};
use std::collections::VecDeque;

use super::{AxisModel, ControlError, Controller};

/// What is read off an answer to a step.
///
/// ```
/// use selfosc::control::Answer;
/// let time_s: Vec<f64> = (0..=1000).map(|k| f64::from(k) * 0.01).collect();
/// let output: Vec<f64> = time_s.iter().map(|t| 1.0 - (-t).exp()).collect();
/// let answer = Answer::of(&time_s, &output, 0.0, 1.0);
/// assert!((answer.rise_s.unwrap() - 9f64.ln()).abs() < 0.01);
/// assert!((answer.settling_s.unwrap() - 50f64.ln()).abs() < 0.01);
/// assert_eq!(answer.overshoot_percent, 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// Time from 10 % to 90 % of the step, s; `None` where it does not get there.
    pub rise_s: Option<f64>,
    /// Furthest beyond the step, in percent of it.
    pub overshoot_percent: f64,
    /// Time after which it stays within 2 % of the step, s; `None` where it has not yet.
    pub settling_s: Option<f64>,
    /// Where it ends less where it should, as a share of the step.
    pub final_error: f64,
}

impl Answer {
    /// The figures of an output that should go from `from` to `to` at the first sample. Times are those of samples;
    /// what happens after the last sample is not known.
    #[must_use]
    pub fn of(time_s: &[f64], output: &[f64], from: f64, to: f64) -> Self {
        let way = |value: &f64| (value - from) / (to - from);
        let samples = || time_s.iter().zip(output.iter().map(way));
        let begin = time_s.first().copied().unwrap_or(0.0);
        let reaches = |level: f64| samples().find(|(_, way)| *way >= level).map(|(time, _)| *time);
        let outside = samples().rposition(|(_, way)| !((way - 1.0).abs() <= 0.02));
        let settled = outside.map_or(Some(0), |last| Some(last + 1)).and_then(|index| time_s.get(index));
        let furthest = samples().map(|(_, way)| way).fold(1.0, f64::max);
        Self {
            rise_s: reaches(0.1).zip(reaches(0.9)).map(|(low, high)| high - low),
            overshoot_percent: 100.0 * (furthest - 1.0),
            settling_s: settled.map(|time| time - begin),
            final_error: output.last().map_or(f64::INFINITY, |last| way(last) - 1.0),
        }
    }
}

/// An axis under a controller that steps its reference at time zero.
///
/// The motion of a drag axis is in closed form between the commands, quadratic drag and the delay included; the controller reads the
/// true coordinate at the given rate and holds its command between.
///
/// ```
/// use selfosc::control::{Controller, StepResponse, Structure, Tuning};
/// use selfosc::plant::DragAxis;
/// let axis = DragAxis::mixed(0.033, 0.01, 0.06)?.with_delay_s(0.1)?;
/// let controller = Controller::new(Tuning::new(&axis, Structure::Ipd, 0.6)?.gains());
/// let response = StepResponse::simulate(&axis, controller, 1.0, 50.0, 20.0)?;
/// assert!(response.answer().overshoot_percent < 2.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct StepResponse {
    size: f64,
    time_s: Vec<f64>,
    output: Vec<f64>,
    speed: Vec<f64>,
    command: Vec<f64>,
}

impl StepResponse {
    /// The most samples of a simulation.
    pub const MOST_SAMPLES: f64 = 1e7;

    /// From rest at zero, the reference at `size` (m, or rad) from the first sample on. An axis with further terms moves by Runge-Kutta
    /// steps of an eighth of an interval, a limited rate as half its ramp more delay.
    ///
    /// # Errors
    /// [`ControlError::OutOfDomain`] unless the size is finite and not zero, rate and duration positive and finite with
    /// at most [`MOST_SAMPLES`](Self::MOST_SAMPLES) samples, in the delay too.
    pub fn simulate(
        axis: impl Into<AxisModel<f64>>,
        mut controller: Controller<f64>,
        size: f64,
        rate_hz: f64,
        duration_s: f64,
    ) -> Result<Self, ControlError> {
        domain::require("size of the step", size, "output units", Limit::NonZero, "give the step of the reference")?;
        domain::positive("rate", rate_hz, "Hz")?;
        let steps = duration_s * rate_hz;
        let limit = Limit::Within(0.0, Self::MOST_SAMPLES);
        domain::require("duration", steps, "samples", limit, "shorten the response or lower its rate")?;
        let model = axis.into();
        let delay_s = model.delay_s + 0.5 * (model.ramp_s + model.pause_s);
        let (late, limit) = (delay_s * rate_hz, Limit::AtMost(Self::MOST_SAMPLES));
        domain::require("delay", late, "samples", limit, "shorten the delay or lower the rate")?;
        let interval_s = 1.0 / rate_hz;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked above")]
        let (whole, last) = (late.floor() as usize, steps.floor() as usize);
        // The command acts a whole number of intervals and a part of one later.
        let part_s = delay_s - whole as f64 * interval_s;
        let mut under_way: VecDeque<f64> = std::iter::repeat_n(0.0, whole + 1).collect();
        let (motion, mut state) = (model.motion(size.abs() * rate_hz)?, [0.0; 5]);
        let mut response =
            Self { size, time_s: Vec::new(), output: Vec::new(), speed: Vec::new(), command: Vec::new() };
        for sample in 0..=last {
            let command = controller.step(size, model.reading(&state), interval_s).command;
            response.time_s.push(sample as f64 * interval_s);
            response.output.push(state[0]);
            response.speed.push(state[1]);
            response.command.push(command);
            under_way.push_back(command);
            let before = under_way.pop_front().unwrap_or(command);
            let after = under_way.front().copied().unwrap_or(command);
            state = motion(motion(state, before, part_s), after, interval_s - part_s);
        }
        Ok(response)
    }

    /// Times of the samples, s.
    #[must_use]
    pub fn time_s(&self) -> &[f64] {
        &self.time_s
    }
    /// The coordinate, m or rad.
    #[must_use]
    pub fn output(&self) -> &[f64] {
        &self.output
    }
    /// The commands.
    #[must_use]
    pub fn command(&self) -> &[f64] {
        &self.command
    }
    /// The greatest speed, per s.
    #[must_use]
    pub fn top_speed(&self) -> f64 {
        self.speed.iter().fold(0.0, |top, speed| speed.abs().max(top))
    }
    /// Rise, overshoot and settling.
    #[must_use]
    pub fn answer(&self) -> Answer {
        Answer::of(&self.time_s, &self.output, 0.0, self.size)
    }
}
