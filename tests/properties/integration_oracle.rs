//! An integrator that shares nothing with the closed forms: Taylor series of the equation of motion, step by step, with
//! events located on the polynomial of a step.

use selfosc::nonlinearity::RelayHysteresis;
use selfosc::plant::{DragAxis, State};

const ORDER: usize = 20;
/// Local error of a step, relative.
const TOLERANCE: f64 = 1e-15;

/// Taylor coefficients of velocity and position, on one side of rest.
struct Step {
    velocity: [f64; ORDER + 1],
    position: [f64; ORDER + 1],
    /// Ten time constants of the drag: at the terminal speed the series would allow any duration.
    limit: f64,
}

impl Step {
    fn new(axis: &DragAxis<f64>, state: State<f64>, input: f64) -> Self {
        let force = input + axis.disturbance();
        let sign = if state.velocity == 0.0 { force.signum() } else { state.velocity.signum() };
        let (mut velocity, mut position) = ([0.0; ORDER + 1], [0.0; ORDER + 1]);
        (velocity[0], position[0]) = (state.velocity, state.position);
        for k in 0..ORDER {
            let square: f64 = (0..=k).map(|i| velocity[i] * velocity[k - i]).sum();
            let push = if k == 0 { force } else { 0.0 };
            let rate = push - axis.linear_drag() * velocity[k] - axis.quadratic_drag() * sign * square;
            velocity[k + 1] = rate / axis.alpha() / (k + 1) as f64;
            position[k + 1] = velocity[k] / (k + 1) as f64;
        }
        let drag = axis.linear_drag() + 2.0 * axis.quadratic_drag() * state.velocity.abs();
        Self { velocity, position, limit: 10.0 * axis.alpha() / drag }
    }

    /// The duration for which the last terms are negligible; two of them, because every other one can vanish.
    fn reach(&self) -> f64 {
        let last = [ORDER - 1, ORDER];
        let radius = last.map(|k| (self.velocity[1] / self.velocity[k]).abs().powf(1.0 / (k - 1) as f64));
        let scale = self.velocity[0].abs().max(self.velocity[1].abs() * radius[0].min(radius[1]));
        let reach = last.map(|k| (TOLERANCE * scale / self.velocity[k].abs()).powf(1.0 / k as f64));
        let reach = reach[0].min(reach[1]).min(self.limit);
        assert!(reach > 0.0, "no step from {:?}", self.velocity);
        reach
    }

    fn at(&self, time: f64) -> State<f64> {
        let horner = |c: &[f64]| c.iter().rev().fold(0.0, |sum, c| sum * time + c);
        State { position: horner(&self.position), velocity: horner(&self.velocity) }
    }

    /// Where a function of the state that is negative at zero and positive at `end` changes sign.
    fn event(&self, end: f64, function: impl Fn(State<f64>) -> f64) -> f64 {
        let (mut before, mut after) = (0.0, end);
        for _ in 0..200 {
            let middle = 0.5 * (before + after);
            if middle <= before || middle >= after {
                break;
            }
            if function(self.at(middle)) < 0.0 { before = middle } else { after = middle }
        }
        after
    }

    /// The largest duration up to `end` that stays on this side of rest, and the state after it.
    fn one_way(&self, end: f64) -> (f64, State<f64>) {
        let sign = if self.velocity[0] == 0.0 { self.velocity[1].signum() } else { self.velocity[0].signum() };
        let state = self.at(end);
        if sign * state.velocity >= 0.0 {
            return (end, state);
        }
        let rest = self.event(end, |s| -sign * s.velocity);
        (rest, State { velocity: 0.0, ..self.at(rest) })
    }
}

/// The state after `duration` under a constant input.
pub(crate) fn integrate(axis: &DragAxis<f64>, mut state: State<f64>, input: f64, duration: f64) -> State<f64> {
    let mut left = duration;
    while left > 0.0 {
        if input + axis.disturbance() == 0.0 && state.velocity == 0.0 {
            return state;
        }
        let step = Step::new(axis, state, input);
        let time;
        (time, state) = step.one_way(step.reach().min(left));
        left -= time;
    }
    state
}

/// One period as it was integrated.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cycle {
    pub(crate) maximum: f64,
    pub(crate) minimum: f64,
    pub(crate) time_positive_s: f64,
    pub(crate) time_negative_s: f64,
    pub(crate) upper_position: f64,
    pub(crate) upper_velocity: f64,
    pub(crate) lower_position: f64,
    pub(crate) lower_velocity: f64,
}

impl Cycle {
    pub(crate) fn period_s(&self) -> f64 {
        self.time_positive_s + self.time_negative_s
    }
    fn change(&self, other: &Self) -> f64 {
        let range = self.maximum - self.minimum;
        ((self.maximum - other.maximum) / range)
            .abs()
            .max(((self.minimum - other.minimum) / range).abs())
            .max((self.period_s() / other.period_s() - 1.0).abs())
    }
}

/// Simulates the loop from rest until its cycles repeat.
pub(crate) fn limit_cycle(axis: &DragAxis<f64>, relay: &RelayHysteresis<f64>) -> Cycle {
    let mut simulation = Simulation {
        axis,
        relay,
        state: State { position: 0.0, velocity: 0.0 },
        command: 1.0,
        acting: 1.0,
        pending: None,
    };
    simulation.cycle();
    let mut before = simulation.cycle();
    for _ in 0..500 {
        let cycle = simulation.cycle();
        if cycle.change(&before) < 1e-12 {
            return cycle;
        }
        before = cycle;
    }
    panic!("no limit cycle in sight: {axis:?} {relay:?} {before:?}");
}

struct Simulation<'a> {
    axis: &'a DragAxis<f64>,
    relay: &'a RelayHysteresis<f64>,
    state: State<f64>,
    /// Sign of the relay's output, and of what acts after the delay.
    command: f64,
    acting: f64,
    /// Time left until the command acts.
    pending: Option<f64>,
}

impl Simulation<'_> {
    /// From one switching to the positive command to the next.
    fn cycle(&mut self) -> Cycle {
        let mut cycle = Cycle { maximum: f64::NEG_INFINITY, minimum: f64::INFINITY, ..Cycle::default() };
        loop {
            let input = self.relay.level() * self.acting + self.relay.offset();
            let step = Step::new(self.axis, self.state, input);
            let (mut time, mut end) = step.one_way(step.reach().min(self.pending.unwrap_or(f64::INFINITY)));
            let beyond = |s: State<f64>| self.command * s.position - self.relay.half_width();
            let crossing = self.pending.is_none() && beyond(end) >= 0.0;
            if crossing {
                time = if beyond(self.state) < 0.0 { step.event(time, beyond) } else { 0.0 };
                end = step.at(time);
            }
            if self.acting > 0.0 {
                cycle.time_positive_s += time
            } else {
                cycle.time_negative_s += time
            }
            self.state = end;
            if end.velocity == 0.0 {
                cycle.maximum = cycle.maximum.max(end.position);
                cycle.minimum = cycle.minimum.min(end.position);
            }
            self.pending = self.pending.map(|left| left - time);
            if crossing {
                self.command = -self.command;
                self.pending = Some(self.axis.delay_s());
            }
            if self.pending.is_some_and(|left| left <= 0.0) {
                self.pending = None;
                self.acting = self.command;
                if self.acting > 0.0 {
                    (cycle.lower_position, cycle.lower_velocity) = (end.position, end.velocity);
                    return cycle;
                }
                (cycle.upper_position, cycle.upper_velocity) = (end.position, end.velocity);
            }
        }
    }
}
