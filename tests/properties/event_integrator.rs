//! An oracle for loops without closed form: integration that stops at events, and a relay loop as a system for it.
//!
//! The step is Dormand and Prince's of order 5(4). An event is sought in every step on its cubic interpolant, at eight points and at the
//! turning points between them. Steps of the method itself then locate it, as exactly as a step.

use std::collections::VecDeque;

use selfosc::nonlinearity::RelayHysteresis;
use selfosc::numeric::scan;

/// A system that is smooth between events. Its history is its own state.
pub(crate) trait EventSystem {
    /// Rate of the state.
    fn rate(&self, time_s: f64, state: &[f64], rate: &mut [f64]);
    /// Number of guards.
    fn guards(&self) -> usize;
    /// A guard's value; its event is the passage from negative or zero to positive, or a positive value at time zero.
    fn guard(&self, index: usize, time_s: f64, state: &[f64]) -> f64;
    /// The changes by the event.
    fn event(&mut self, index: usize, time_s: f64, state: &mut [f64]);
}

/// An event that happened.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Occurrence {
    /// When, seconds.
    pub(crate) time_s: f64,
    /// The guard.
    pub(crate) index: usize,
    /// The state after it.
    pub(crate) state: Vec<f64>,
}

/// Tolerances and limits of an integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Integrator {
    /// Error a step, relative to the state.
    pub(crate) relative: f64,
    /// The same, absolute.
    pub(crate) absolute: f64,
    /// The most steps.
    pub(crate) steps: usize,
}

impl Integrator {
    /// Integrates from time zero to `until_s`, calls `observe` after every step, and returns the events in order.
    pub(crate) fn run(
        &self,
        system: &mut impl EventSystem,
        mut state: Vec<f64>,
        until_s: f64,
        mut observe: impl FnMut(f64, &[f64]),
    ) -> Vec<Occurrence> {
        let mut occurrences = Vec::new();
        let (mut time, mut step) = (0.0, 1e-3 * until_s);
        for index in 0..system.guards() {
            if system.guard(index, time, &state) > 0.0 {
                system.event(index, time, &mut state);
                occurrences.push(Occurrence { time_s: time, index, state: state.clone() });
            }
        }
        for _ in 0..self.steps {
            if time >= until_s {
                return occurrences;
            }
            let length = step.min(until_s - time);
            let trial = Step::new(system, time, &state, length);
            let error = trial.error(&state, self);
            let factor = if error > 0.0 { (0.9 * error.powf(-0.2)).clamp(0.2, 5.0) } else { 5.0 };
            if error.is_nan() || error > 1.0 {
                step = length * if error.is_finite() { factor } else { 0.2 };
                assert!(step > 1e-15 * until_s, "the step at {time} s fell to {step} s");
                continue;
            }
            match first_event(system, time, &state, &trial) {
                Some((index, part)) => {
                    state = Step::new(system, time, &state, part).state;
                    time += part;
                    system.event(index, time, &mut state);
                    occurrences.push(Occurrence { time_s: time, index, state: state.clone() });
                }
                None => {
                    time += length;
                    (state, step) = (trial.state, length * factor);
                }
            }
            observe(time, &state);
        }
        panic!("stopped at {time} s after {} steps", self.steps)
    }
}

/// A step of Dormand and Prince (*J. Comput. Appl. Math.* 6, 1980).
struct Step {
    length: f64,
    state: Vec<f64>,
    /// Rates at both ends, for the cubic.
    rates: (Vec<f64>, Vec<f64>),
    /// Difference to the embedded solution of order four.
    difference: Vec<f64>,
}

const NODES: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
const STAGES: [[f64; 6]; 6] = [
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
const EMBEDDED: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];

impl Step {
    fn new(system: &impl EventSystem, time: f64, from: &[f64], length: f64) -> Self {
        let size = from.len();
        let mut rates = [(); 7].map(|()| vec![0.0; size]);
        system.rate(time, from, &mut rates[0]);
        let mut state = from.to_vec();
        for (stage, weights) in STAGES.iter().enumerate() {
            for (row, value) in state.iter_mut().enumerate() {
                let sum: f64 =
                    weights.iter().zip(&rates).take(stage + 1).map(|(weight, rate)| weight * rate[row]).sum();
                *value = from[row] + length * sum;
            }
            system.rate(time + NODES[stage + 1] * length, &state, &mut rates[stage + 1]);
        }
        let difference = (0..size)
            .map(|row| length * EMBEDDED.iter().zip(&rates).map(|(weight, rate)| weight * rate[row]).sum::<f64>())
            .collect();
        let [first, .., last] = rates;
        Self { length, state, rates: (first, last), difference }
    }

    /// Root mean square of the error over the tolerance: the step is good up to 1.
    fn error(&self, from: &[f64], tolerances: &Integrator) -> f64 {
        let square = |((difference, a), b): ((&f64, &f64), &f64)| {
            (difference / (tolerances.absolute + tolerances.relative * a.abs().max(b.abs()))).powi(2)
        };
        let sum: f64 = self.difference.iter().zip(from).zip(&self.state).map(square).sum();
        (sum / from.len() as f64).sqrt()
    }

    /// The cubic with the state and rate of both ends, after a share of the step.
    fn between(&self, from: &[f64], share: f64) -> Vec<f64> {
        let (rest, h) = (1.0 - share, self.length);
        (0..from.len())
            .map(|row| {
                let (a, b) = (from[row], self.state[row]);
                let (da, db) = (self.rates.0[row], self.rates.1[row]);
                rest * rest * (1.0 + 2.0 * share) * a
                    + share * share * (1.0 + 2.0 * rest) * b
                    + h * share * rest * (rest * da - share * db)
            })
            .collect()
    }
}

/// The guard that first becomes positive within the step, and after which part of it.
fn first_event(system: &impl EventSystem, time: f64, from: &[f64], step: &Step) -> Option<(usize, f64)> {
    let nodes: Vec<f64> = (0..=8).map(|index| f64::from(index) / 8.0).collect();
    let mut first: Option<(usize, f64)> = None;
    for index in 0..system.guards() {
        let start = system.guard(index, time, from);
        let mut cubic = |share: f64| Some(system.guard(index, time + share * step.length, &step.between(from, share)));
        let ends_above = start <= 0.0 && system.guard(index, time + step.length, &step.state) > 0.0;
        if !ends_above && scan::roots(&nodes, &mut cubic).is_empty() {
            continue;
        }
        let exact = |share: f64| {
            let part = share * step.length;
            Some(system.guard(index, time + part, &Step::new(system, time, from, part).state))
        };
        // Rising passages only; a passage at the very start is the event that began this step.
        let rising = |share: &f64| *share > 0.0 && exact(share + 1e-6).is_some_and(|after| after > 0.0);
        if let Some(share) = scan::roots(&nodes, &mut |share| exact(share)).into_iter().find(rising) {
            let part = share * step.length;
            if first.is_none_or(|(_, other)| part < other) {
                first = Some((index, part));
            }
        }
    }
    first
}

/// A plant `x' = rate(x, u)`, `y = output(x)` under a relay with hysteresis, the command delayed on its way to the plant:
/// guard 0 is the relay's next switching, guard 1 the next arrival at the plant.
#[derive(Clone, Debug)]
pub(crate) struct RelayFeedback<F, G> {
    rate: F,
    output: G,
    relay: RelayHysteresis<f64>,
    reference: f64,
    delay_s: f64,
    command: f64,
    input: f64,
    arrivals: VecDeque<(f64, f64)>,
}

impl<F: Fn(&[f64], f64, &mut [f64]), G: Fn(&[f64]) -> f64> RelayFeedback<F, G> {
    /// Begins with the command positive, at the plant too.
    pub(crate) fn new(rate: F, output: G, relay: RelayHysteresis<f64>, reference: f64, delay_s: f64) -> Self {
        let high = relay.offset() + relay.level();
        Self { rate, output, relay, reference, delay_s, command: 1.0, input: high, arrivals: VecDeque::new() }
    }
}

impl<F: Fn(&[f64], f64, &mut [f64]), G: Fn(&[f64]) -> f64> EventSystem for RelayFeedback<F, G> {
    fn rate(&self, _: f64, state: &[f64], rate: &mut [f64]) {
        (self.rate)(state, self.input, rate);
    }
    fn guards(&self) -> usize {
        2
    }
    fn guard(&self, index: usize, time_s: f64, state: &[f64]) -> f64 {
        match (index, self.arrivals.front()) {
            (0, _) => self.command * ((self.output)(state) - self.reference) - self.relay.half_width(),
            (_, Some((arrival, _))) => time_s - arrival,
            (_, None) => -1.0,
        }
    }
    fn event(&mut self, index: usize, time_s: f64, _: &mut [f64]) {
        if index == 0 {
            self.command = -self.command;
            let input = self.relay.offset() + self.command * self.relay.level();
            if self.delay_s == 0.0 {
                self.input = input
            } else {
                self.arrivals.push_back((time_s + self.delay_s, input))
            }
        } else if let Some((_, input)) = self.arrivals.pop_front() {
            self.input = input;
        }
    }
}
