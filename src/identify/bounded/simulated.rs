//! Vehicles that move by a method independent of the judged code.

use super::problem::Problem;
use super::settings::{BoundedModel, DelayBound};
use super::vector_field::FieldTerm;
use crate::experiment::Record;
use crate::identify::DragLaw;
use crate::numeric::{Interval, Real, runge_kutta};

pub(super) const SAMPLE_S: f64 = 0.1;
/// Samples between two switchings.
pub(super) const HALF_PERIOD: usize = 20;
/// Step of the sensor.
pub(super) const QUANTUM: f64 = 0.02;
/// Steps of a sample's interval.
const STEPS: usize = 20;

/// Position, velocity and force; and the command.
pub(super) type Sample = ([f64; 3], f64);

/// Terms over inertia, and the constants.
#[derive(Clone, Copy, Default)]
pub(super) struct VehicleTerms {
    pub(super) gain: f64,
    pub(super) linear: f64,
    pub(super) quadratic: f64,
    pub(super) cubic: f64,
    pub(super) stiffness: f64,
    pub(super) lag_rate: f64,
    pub(super) disturbance: f64,
    /// Delay in steps.
    pub(super) delayed: usize,
}

/// Linear drag alone.
pub(super) const LINEAR: VehicleTerms = VehicleTerms {
    gain: 0.8,
    linear: 0.5,
    quadratic: 0.0,
    cubic: 0.0,
    stiffness: 0.0,
    lag_rate: 0.0,
    disturbance: 0.08,
    delayed: 0,
};

/// A motion, the problem that its record poses, and the true values of all unknowns.
pub(super) struct Known {
    pub(super) motion: Vec<Sample>,
    pub(super) problem: Problem,
    pub(super) truth: Vec<f64>,
}

impl Known {
    pub(super) fn of(vehicle: &VehicleTerms, samples: usize, delay_known: bool) -> Self {
        let motion = vehicle.motion(samples);
        let problem = Problem::new(&[&record(&motion)], &vehicle.model(delay_known)).expect("a problem");
        Self { truth: vehicle.truth(&problem, &motion), motion, problem }
    }

    /// Parameters in a box of this relative half-width, whose middle is `off` the truth by a share; states as the readings tell them.
    pub(super) fn about(&self, off: f64, width: f64) -> Vec<Interval> {
        let mut at = self.problem.search.clone();
        for (side, value) in at.iter_mut().zip(&self.truth).take(self.problem.unknowns.parameters()) {
            *side = Interval::point((1.0 + off) * value).inflate(width * value.abs());
        }
        at
    }
}

/// Positions rounded to steps of the sensor.
pub(super) fn record(motion: &[Sample]) -> Record {
    let time_s = (0..motion.len()).map(|sample| SAMPLE_S * sample as f64).collect();
    let output = motion.iter().map(|([x, ..], _)| (x / QUANTUM).round() * QUANTUM).collect();
    Record::new(time_s, output, motion.iter().map(|(_, u)| *u).collect()).expect("a record")
}

impl VehicleTerms {
    /// At every sample under a square wave.
    pub(super) fn motion(&self, samples: usize) -> Vec<Sample> {
        let command = |sample: usize| if (sample / HALF_PERIOD).is_multiple_of(2) { 1.0 } else { -1.0 };
        let h = SAMPLE_S / STEPS as f64;
        let lagged = self.lag_rate > 0.0;
        let (mut state, mut all) = ([0.0, -0.4, -0.7], Vec::new());
        for sample in 0..samples {
            all.push((state, command(sample)));
            for step in 0..STEPS {
                let u = command((sample * STEPS + step).saturating_sub(self.delayed) / STEPS);
                let rate = |[x, v, f]: [f64; 3]| {
                    let force = self.gain * if lagged { f } else { u } + self.disturbance;
                    let drag = self.linear * v + self.quadratic * v * v.abs() + self.cubic * v * v * v;
                    [v, force - drag - self.stiffness * x, self.lag_rate * (u - f)]
                };
                state = runge_kutta(state, h, rate);
            }
        }
        all
    }

    /// The terms that it has.
    pub(super) fn model(&self, delay_known: bool) -> BoundedModel {
        let law = match (self.linear != 0.0, self.quadratic != 0.0) {
            (true, true) => DragLaw::Mixed,
            (false, true) => DragLaw::Quadratic,
            _ => DragLaw::Linear,
        };
        let delay = if delay_known { DelayBound::KnownS(self.delay_s()) } else { DelayBound::Unknown };
        BoundedModel {
            cubic: self.cubic != 0.0,
            stiffness: self.stiffness != 0.0,
            lag: self.lag_rate > 0.0,
            quantum: Some(QUANTUM),
            ..BoundedModel::new(law, delay)
        }
    }

    fn delay_s(&self) -> f64 {
        self.delayed as f64 * SAMPLE_S / STEPS as f64
    }

    /// All unknowns of the search.
    fn truth(&self, problem: &Problem, motion: &[Sample]) -> Vec<f64> {
        let unknowns = &problem.unknowns;
        let mut truth = vec![0.0; problem.search.len()];
        for (place, term) in unknowns.terms.iter().enumerate() {
            truth[place] = match term {
                FieldTerm::Gain => self.gain,
                FieldTerm::Linear => self.linear + 2.0 * problem.middle_speed * self.quadratic,
                FieldTerm::Quadratic => self.quadratic,
                FieldTerm::Cubic => self.cubic,
                FieldTerm::Stiffness => self.stiffness,
                FieldTerm::LagRate => self.lag_rate,
                FieldTerm::Disturbance => self.disturbance,
            };
        }
        if let Some(place) = unknowns.delay() {
            truth[place] = self.delay_s();
        }
        truth[unknowns.disturbance(0)] = self.disturbance;
        for (index, interval) in unknowns.shooting.iter().enumerate() {
            for component in 0..unknowns.state_size() {
                truth[unknowns.start(index, component)] = motion[interval.first].0[component];
            }
        }
        truth
    }
}
