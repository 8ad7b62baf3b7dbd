//! What runs on a vehicle: the experiment, and the controller.

use std::ffi::OsString;

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use selfosc::Error;
use selfosc::control::{ControlFault, FeedForward, Gains};
use selfosc::identify::DragLaw;
use selfosc::on_board::{Outcome, Phase};
use selfosc::plant::DragAxis;
use serde_json::json;

use crate::failure;
use crate::identification::{parsed, written};

/// A relay experiment, and its samples so far.
#[pyclass]
pub(crate) struct Experiment {
    experiment: selfosc::on_board::Experiment<f64>,
    samples: [Vec<f64>; 3],
}

/// A column of a record.
type Column<'py> = Bound<'py, PyArray1<f64>>;

#[pymethods]
impl Experiment {
    /// The experiment of these flags of `selfosc run`.
    #[new]
    fn new(py: Python<'_>, flags: Vec<OsString>) -> PyResult<Self> {
        let made = selfosc::command::experiment(flags);
        made.map(|experiment| Self { experiment, samples: Default::default() })
            .map_err(|why| failure::raised(py, why.code, &why.text, why.out_of_domain.as_ref()))
    }

    /// The command to give now, and where the experiment stands. A sample of the relay's joins the record, as in `selfosc run --log`.
    fn step(&mut self, reading: f64, time_s: f64) -> (f64, String) {
        let step = self.experiment.step(reading, time_s);
        if let Some(position) = self.experiment.position().filter(|_| step.phase == Phase::Running) {
            for (column, value) in self.samples.iter_mut().zip([time_s, position, step.command]) {
                column.push(value);
            }
        }
        (step.command, step.phase.to_string())
    }

    fn tick(&mut self, time_s: f64) -> (f64, String) {
        let step = self.experiment.tick(time_s);
        (step.command, step.phase.to_string())
    }

    fn abort(&mut self) {
        self.experiment.abort();
    }

    fn restart(&mut self, py: Python<'_>) -> PyResult<()> {
        self.samples = Default::default();
        self.experiment.restart().map_err(|fault| failure::library(py, Error::from(fault)))
    }

    fn command(&self) -> f64 {
        self.experiment.command()
    }

    fn phase(&self) -> String {
        self.experiment.phase().to_string()
    }

    /// What the fault was, in words with its remedy.
    fn fault(&self) -> Option<String> {
        match self.experiment.phase() {
            Phase::Failed(fault) => Some(fault.to_string()),
            _ => None,
        }
    }

    fn position(&self) -> Option<f64> {
        self.experiment.position()
    }

    fn attempt(&self) -> u8 {
        self.experiment.attempt()
    }

    fn outcome(&self) -> PyResult<Option<String>> {
        self.experiment.outcome().as_ref().map(written).transpose()
    }

    /// The name of the coordinate's column; times in s, coordinate and command.
    fn record<'py>(&self, py: Python<'py>) -> (&'static str, [Column<'py>; 3]) {
        let name = self.experiment.protocol().coordinate.column();
        (name, self.samples.each_ref().map(|column| column.clone().into_pyarray(py)))
    }

    fn neutral(&self) -> f64 {
        self.experiment.protocol().neutral_command
    }
}

/// The axis whose exact limit cycle has the features of an outcome, as a JSON document.
#[pyfunction]
pub(crate) fn axis_of_outcome(py: Python<'_>, outcome: &str, law: &str, delay_s: f64) -> PyResult<String> {
    let outcome: Outcome<f64> = parsed(py, outcome)?;
    let law: DragLaw = parsed(py, &json!(law).to_string())?;
    let axis = outcome.exact(law, delay_s).map_err(|error| failure::library(py, error))?;
    written(&json!({
        "drag": law.name(),
        "alpha": axis.alpha(),
        "beta": axis.linear_drag(),
        "beta_quadratic": axis.quadratic_drag(),
        "delta": axis.disturbance(),
    }))
}

/// A controller with its memory.
#[pyclass]
pub(crate) struct Controller {
    controller: selfosc::control::Controller<f64>,
}

/// `alpha, beta, beta_quadratic, delta, delay_s` of the axis, the pace in rad/s, the top speed.
type Guide = ([f64; 5], f64, Option<f64>);

#[pymethods]
impl Controller {
    /// Gains as their JSON document, limits of the command, the length of a turn, the longest hold with the command after it.
    #[new]
    fn new(
        py: Python<'_>,
        gains: &str,
        limits: Option<(f64, f64)>,
        turn: Option<f64>,
        hold: Option<(f64, f64)>,
        guide: Option<Guide>,
    ) -> PyResult<Self> {
        let gains: Gains<f64> = parsed(py, gains)?;
        let made = || -> Result<_, Error> {
            let mut controller = selfosc::control::Controller::new(&gains);
            if let Some((lower, upper)) = limits {
                controller = controller.with_limits(lower, upper)?;
            }
            if let Some(turn) = turn {
                controller = controller.on_circle(turn)?;
            }
            if let Some((hold_s, neutral)) = hold {
                controller = controller.with_longest_hold(hold_s, neutral)?;
            }
            if let Some(([alpha, beta, quadratic, delta, delay_s], pace_rad_s, top_speed)) = guide {
                let axis = DragAxis::mixed(alpha, beta, quadratic)?.with_disturbance(delta)?.with_delay_s(delay_s)?;
                controller = controller.with_feed_forward(FeedForward::new(&axis, pace_rad_s, top_speed)?);
            }
            Ok(Self { controller })
        };
        made().map_err(|error| failure::library(py, error))
    }

    /// The command, whether a limit holds it back, and the fault.
    fn step(&mut self, reference: f64, measurement: f64, dt_s: f64) -> (f64, bool, Option<&'static str>) {
        let step = self.controller.step(reference, measurement, dt_s);
        let fault = step.fault.map(|fault| match fault {
            ControlFault::Reference => "reference",
            ControlFault::Measurement => "measurement",
            ControlFault::Interval => "interval",
            _ => "overflow",
        });
        (step.command, step.limited, fault)
    }

    fn reset(&mut self) {
        self.controller.reset();
    }
}
