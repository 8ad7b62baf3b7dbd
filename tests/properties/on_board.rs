//! The experiment on board: the same numbers as the record's, named faults, limits.

use std::collections::BTreeSet;

use proptest::prelude::*;
use selfosc::experiment::Record;
use selfosc::features::RecordFeatures;
use selfosc::identify::DragLaw;
use selfosc::identify::exact::Cycle;
use selfosc::identify::iso::Oscillation;
use selfosc::numeric::Scalar;
use selfosc::on_board::{Coordinate, Experiment, Fault, Outcome, Phase, Protocol};
use selfosc::orbit::limit_cycle;
use selfosc::plant::{DragAxis, State};

use crate::tolerance;

const INTERVAL_S: f64 = 0.1;

/// An axis in simulation, one delay of whole samples, seen through a sensor.
struct Pool {
    axis: DragAxis<f64>,
    state: State<f64>,
    pending: std::collections::VecDeque<f64>,
}

impl Pool {
    fn new(axis: DragAxis<f64>, late: usize) -> Self {
        Self { axis, state: State { position: 0.0, velocity: 0.0 }, pending: std::iter::repeat_n(0.0, late).collect() }
    }

    fn advance(&mut self, command: f64) {
        self.pending.push_back(command);
        let acting = self.pending.pop_front().unwrap();
        self.state = self.axis.advance(self.state, acting, INTERVAL_S);
    }
}

/// What an experiment left behind.
struct Run<T> {
    experiment: Experiment<T>,
    time_s: Vec<f64>,
    position: Vec<f64>,
    command: Vec<f64>,
    /// Sample at which the last attempt began.
    attempt_began: usize,
}

/// Runs until the experiment ends; `sensor` turns the state into a reading.
fn run<T: Scalar>(protocol: Protocol<T>, mut pool: Pool, sensor: impl Fn(f64, &State<f64>) -> f64) -> Run<T> {
    let experiment = Experiment::new(protocol).unwrap();
    let mut run = Run { experiment, time_s: Vec::new(), position: Vec::new(), command: Vec::new(), attempt_began: 0 };
    for sample in 0..20_000 {
        let time_s = INTERVAL_S * f64::from(sample);
        let attempt = run.experiment.attempt();
        let before = run.experiment.command();
        let step = run.experiment.step(T::from_f64(sensor(time_s, &pool.state)), T::from_f64(time_s));
        assert!(step.command >= protocol.lowest_command && step.command <= protocol.highest_command);
        // The last command of an experiment that has ended is neutral, and was not the relay's.
        let command = if step.phase == Phase::Running { step.command } else { before };
        run.time_s.push(time_s);
        run.position.push(run.experiment.position().map_or(0.0, Scalar::value));
        run.command.push(command.value());
        if run.experiment.attempt() != attempt {
            run.attempt_began = run.time_s.len();
        }
        if step.phase != Phase::Running {
            assert_eq!(step.command.value(), protocol.neutral_command.value());
            break;
        }
        pool.advance(step.command.value());
    }
    run
}

fn plain(_: f64, state: &State<f64>) -> f64 {
    state.position
}

fn axis(drag: (f64, f64), disturbance: f64) -> DragAxis<f64> {
    DragAxis::mixed(1.0, drag.0, drag.1).unwrap().with_disturbance(disturbance).unwrap()
}

fn protocol() -> Protocol<f64> {
    Protocol { largest_rate: 20.0, ..Protocol::new(Coordinate::Position, 1.0, 0.5, INTERVAL_S) }
}

fn done<T: Scalar>(run: &Run<T>) -> Outcome<T> {
    run.experiment.outcome().unwrap_or_else(|| panic!("{:?}", run.experiment.phase()))
}

fn fault<T: Scalar>(run: &Run<T>) -> Fault {
    match run.experiment.phase() {
        Phase::Failed(fault) => fault,
        other => panic!("{other:?}"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// The last attempt's samples as a record: the same features, and parameters, to the last bit.
    #[test]
    fn the_stream_agrees_with_the_batch(
        linear in 0.1..1.0f64, quadratic in 0.0..1.0f64, disturbance in -0.4..0.4f64, late in 0usize..3,
        quantum in prop_oneof![Just(0.0), 0.01..0.1f64],
    ) {
        let protocol = Protocol { resolution: quantum, ..protocol() };
        let rounded = |_, state: &State<f64>| {
            if quantum > 0.0 { (state.position / quantum).round() * quantum } else { state.position }
        };
        let run = run(protocol, Pool::new(axis((linear, quadratic), disturbance), late), rounded);
        let outcome = done(&run);
        // The relay's own last command: the sample that completes a cycle turns it positive.
        let from = run.attempt_began;
        let mut command = run.command[from..].to_vec();
        *command.last_mut().unwrap() = outcome.relay_level;
        let record = Record::new(run.time_s[from..].to_vec(), run.position[from..].to_vec(), command).unwrap();
        let batch = RecordFeatures::of(&record).unwrap();
        prop_assert_eq!(outcome.features, batch.features);
        prop_assert_eq!(outcome.relay_level, batch.relay.level);
        let delay_s = INTERVAL_S * late as f64;
        let parameters = Oscillation::of(&batch.features, batch.relay.level, delay_s).identify();
        prop_assert_eq!(outcome.iso(delay_s), parameters);
        let cycle = Cycle::of(&batch.features, batch.relay.level, delay_s);
        prop_assert_eq!(outcome.exact(DragLaw::Linear, delay_s), cycle.linear_drag());
        prop_assert_eq!(outcome.exact(DragLaw::Quadratic, delay_s), cycle.quadratic_drag());
    }
}
