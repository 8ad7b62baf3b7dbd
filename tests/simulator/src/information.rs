//! How well the best unbiased fit of the true structure could do: the Cramér-Rao bound of alpha.
//!
//! The motion is replayed with its commands as they were given, under parameters changed a little; errors of the readings are
//! taken as Gaussian with the covariance that they have (a rounding as white noise of a twelfth of its square), a random force
//! through the motion linearised along the way. The drag law, the terms, and which samples are outliers are known to this fit:
//! a tool that is not told can hardly reach it. It knows the instants of the switchings, too, even those between samples.
//! It is a yardstick of widths, not a bound for rounded records.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use crate::command::History;
use crate::experiment::Run;
use crate::integrate::{Motion, STEP_S};
use crate::kinds::{Case, Group};
use crate::scenario::{Logged, Scenario};
use crate::vehicle::{FILTER, Lag, POSITION, SPEED, State};

/// Changes a scenario or a state at the beginning of the record by an amount.
type Change = Box<dyn Fn(&mut Scenario, &mut State, f64)>;

/// A parameter of the true structure.
struct Unknown {
    /// The record whose own it is; `None` for all.
    record: Option<usize>,
    change: Change,
    step: f64,
}

/// Adds a parameter of all records, if its number is not zero.
fn add(unknowns: &mut Vec<Unknown>, value: f64, scale: f64, place: fn(&mut Scenario) -> &mut f64) {
    if value != 0.0 {
        let change = move |scenario: &mut Scenario, _: &mut State, by: f64| *place(scenario) += by;
        unknowns.push(Unknown { record: None, change: Box::new(change), step: 1e-4 * scale });
    }
}

impl Case {
    /// Standard deviation of alpha in a fit of the true structure, see the [module](crate::information); `None` for what no
    /// record shows, for vehicles that differ, and where the structure has too many unknowns for the record.
    #[must_use]
    pub fn reference_std_alpha(&self) -> Option<f64> {
        let alpha = self.truths[0].alpha;
        if self.kind.group == Group::Unshowable || self.truths.iter().any(|truth| truth.alpha != alpha) {
            return None;
        }
        let unknowns = self.unknowns();
        let count = unknowns.len();
        let mut information = DMatrix::<f64>::zeros(count, count);
        for (index, run) in self.runs.iter().enumerate() {
            let samples = run.instant_s.len();
            let mut sensitivity = DMatrix::<f64>::zeros(samples, count);
            for (column, unknown) in unknowns.iter().enumerate() {
                if unknown.record.is_some_and(|record| record != index) {
                    continue;
                }
                let above = run.replay(|scenario, state| (unknown.change)(scenario, state, unknown.step));
                let below = run.replay(|scenario, state| (unknown.change)(scenario, state, -unknown.step));
                let slope = (DVector::from_vec(above) - DVector::from_vec(below)) / (2.0 * unknown.step);
                sensitivity.set_column(column, &slope);
            }
            information += match run.error_covariance() {
                Errors::White(variance) => {
                    let weighted = DMatrix::from_fn(samples, count, |i, j| sensitivity[(i, j)] / variance[i]);
                    sensitivity.transpose() * weighted
                }
                Errors::Coloured(covariance) => sensitivity.transpose() * covariance.cholesky()?.solve(&sensitivity),
            };
        }
        // Equal units, else the inverse is all rounding.
        let scale = DVector::from_fn(count, |i, _| information[(i, i)].sqrt().recip());
        if !scale.iter().all(|scale| scale.is_finite()) {
            return None;
        }
        let scaled = DMatrix::from_fn(count, count, |i, j| information[(i, j)] * scale[i] * scale[j]);
        let inverse = scaled.cholesky()?.inverse();
        Some(scale[0] * inverse[(0, 0)].sqrt()).filter(|std| std.is_finite())
    }

    /// Every parameter of the true structure, alpha first.
    fn unknowns(&self) -> Vec<Unknown> {
        let scenario = &self.runs[0].scenario;
        let (vehicle, actuator) = (&scenario.vehicle, &scenario.vehicle.actuator);
        let speed = self.runs[0].speed.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let position = self.runs[0].position.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let level = self.runs[0].record.input.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
        let mut all = Vec::new();
        add(&mut all, vehicle.alpha, vehicle.alpha, |s| &mut s.vehicle.alpha);
        let drag = &vehicle.drag;
        add(&mut all, drag.linear, level / speed, |s| &mut s.vehicle.drag.linear);
        add(&mut all, drag.quadratic, level / speed.powi(2), |s| &mut s.vehicle.drag.quadratic);
        add(&mut all, drag.cubic, level / speed.powi(3), |s| &mut s.vehicle.drag.cubic);
        add(&mut all, drag.power, drag.power, |s| &mut s.vehicle.drag.power);
        add(&mut all, drag.power, 1.0, |s| &mut s.vehicle.drag.exponent);
        add(&mut all, drag.coulomb, level, |s| &mut s.vehicle.drag.coulomb);
        add(&mut all, drag.asymmetry, 1.0, |s| &mut s.vehicle.drag.asymmetry);
        add(&mut all, vehicle.stiffness, level / position, |s| &mut s.vehicle.stiffness);
        add(&mut all, vehicle.force.tether, level / position, |s| &mut s.vehicle.force.tether);
        add(&mut all, vehicle.alpha_drift, 1.0, |s| &mut s.vehicle.alpha_drift);
        add(&mut all, vehicle.memory.gain, vehicle.memory.gain, |s| &mut s.vehicle.memory.gain);
        add(&mut all, vehicle.memory.time_s, vehicle.memory.time_s, |s| &mut s.vehicle.memory.time_s);
        add(&mut all, actuator.sag, 1.0, |s| &mut s.vehicle.actuator.sag);
        add(&mut all, actuator.dead_zone, level, |s| &mut s.vehicle.actuator.dead_zone);
        add(&mut all, actuator.exponent - 1.0, 1.0, |s| &mut s.vehicle.actuator.exponent);
        add(&mut all, scenario.sensor.filter_s, 1.0, |s| &mut s.sensor.filter_s);
        let lags: [fn(&mut Scenario) -> &mut Lag; 2] =
            [|s| &mut s.vehicle.actuator.motor, |s| &mut s.vehicle.actuator.thrust];
        // Two equal lags in a row are told apart by their order alone: one time constant for both.
        let both = actuator.motor == actuator.thrust;
        let distinct = if both { 1 } else { 2 };
        for (lag, place) in [actuator.motor, actuator.thrust].into_iter().zip(lags).take(distinct) {
            let parts: usize = match lag {
                Lag::None => 0,
                Lag::First { .. } => 1,
                Lag::Second { .. } => 2,
            };
            for part in 0..parts {
                let change = move |scenario: &mut Scenario, _: &mut State, by: f64| {
                    let places = if both { &lags[..] } else { core::slice::from_ref(&place) };
                    for place in places {
                        match (place(scenario), part) {
                            (Lag::First { tau_s }, _) => *tau_s += by,
                            (Lag::Second { omega_rad_s, .. }, 0) => *omega_rad_s += by,
                            (Lag::Second { zeta, .. }, _) => *zeta += by,
                            (Lag::None, _) => {}
                        }
                    }
                };
                all.push(Unknown { record: None, change: Box::new(change), step: 1e-5 });
            }
        }
        if scenario.logged == Logged::Order
            && let Some(limit) = actuator.rate_limit
        {
            let change = |scenario: &mut Scenario, _: &mut State, by: f64| {
                if let Some(limit) = &mut scenario.vehicle.actuator.rate_limit {
                    *limit += by;
                }
            };
            all.push(Unknown { record: None, change: Box::new(change), step: 1e-4 * limit });
        }
        if self.known.delay_s != Some(self.truths[0].delay_s) {
            add(&mut all, 1.0, 1.0, |s| &mut s.vehicle.actuator.delay_s);
        }
        for (index, run) in self.runs.iter().enumerate() {
            let mut own = |step: f64, change: Change| all.push(Unknown { record: Some(index), change, step });
            own(1e-4 * level, Box::new(|scenario, _, by| scenario.vehicle.delta += by));
            own(1e-4 * position, Box::new(|_, state, by| state[POSITION] += by));
            own(1e-4 * speed, Box::new(|_, state, by| state[SPEED] += by));
            if run.scenario.sensor.filter_s > 0.0 {
                own(1e-4 * position, Box::new(|_, state, by| state[FILTER] += by));
            }
            if run.scenario.vehicle.force.sine != 0.0 {
                own(1e-4 * level, Box::new(|scenario, _, by| scenario.vehicle.force.sine += by));
                own(1e-4, Box::new(|scenario, _, by| scenario.vehicle.force.sine_phase_rad += by));
                own(1e-4, Box::new(|scenario, _, by| scenario.vehicle.force.sine_period_s += by));
            }
        }
        all
    }
}

/// Covariance of the errors of a record's readings.
enum Errors {
    White(Vec<f64>),
    Coloured(DMatrix<f64>),
}

impl Run {
    /// Positions as read, without errors, under the same orders, from the beginning of the record on, something changed.
    fn replay(&self, change: impl FnOnce(&mut Scenario, &mut State)) -> Vec<f64> {
        let place = if self.scenario.sensor.filter_s > 0.0 { FILTER } else { POSITION };
        self.states(&self.instant_s, change).into_iter().map(|state| state[place]).collect()
    }

    /// States at increasing times under the same orders.
    fn states(&self, time_s: &[f64], change: impl FnOnce(&mut Scenario, &mut State)) -> Vec<State> {
        let (mut scenario, (begin_s, mut state)) = (self.scenario.clone(), self.begin);
        change(&mut scenario, &mut state);
        let history = History::of(self.history.orders(), scenario.vehicle.actuator.rate_limit);
        let mut motion = Motion::new(
            &scenario.vehicle,
            scenario.sensor.filter_s,
            state,
            self.path.with_sine_of(scenario.vehicle.force),
            STEP_S,
            Self::span_s(&scenario),
        );
        motion.time_s = begin_s;
        time_s
            .iter()
            .map(|time_s| {
                motion.advance(*time_s, &history, None);
                *motion.state()
            })
            .collect()
    }

    fn error_covariance(&self) -> Errors {
        let (sensor, force) = (&self.scenario.sensor, &self.scenario.vehicle.force);
        let rounding = sensor.quantum.powi(2) / 12.0;
        // No record is free of errors to the last bit.
        let least = (1e-9 * self.position.iter().fold(0.0, |most: f64, x| most.max(x.abs()))).powi(2);
        let stamps = sensor.late_s.powi(2) / 12.0 + sensor.stamp_step_s.powi(2) / 12.0;
        let coloured_noise = sensor.noise_correlation != 0.0;
        let white = |speed: &f64| {
            let noise = if coloured_noise { 0.0 } else { sensor.noise.powi(2) };
            rounding + noise + stamps * speed * speed + least
        };
        let white: Vec<f64> = self.speed.iter().map(white).collect();
        let walks = force.walk > 0.0 || force.ornstein_uhlenbeck > 0.0 || force.anchor > 0.0;
        if !coloured_noise && sensor.walk == 0.0 && !walks {
            return Errors::White(white);
        }
        let samples = white.len();
        let mut covariance = DMatrix::from_diagonal(&DVector::from_vec(white));
        for i in 0..samples {
            for j in 0..samples {
                let (early, late) = (self.instant_s[i.min(j)], self.instant_s[i.max(j)]);
                if coloured_noise {
                    let kept = sensor.noise_correlation.powf((late - early) * sensor.rate_hz);
                    covariance[(i, j)] += sensor.noise.powi(2) * kept;
                }
                covariance[(i, j)] += sensor.walk.powi(2) * (early - self.begin.0);
            }
        }
        for (std, time_s, stationary) in [
            (force.walk, f64::INFINITY, false),
            (force.ornstein_uhlenbeck, force.ornstein_uhlenbeck_time_s, true),
            (force.tether * force.anchor, force.anchor_time_s, true),
        ] {
            if std > 0.0 {
                covariance += self.force_covariance(std, time_s, stationary);
            }
        }
        Errors::Coloured(covariance)
    }

    /// Covariance of the positions under a random force: a random walk of `std` per square root of a second, or a stationary
    /// process of this standard deviation and correlation time.
    fn force_covariance(&self, std: f64, time_s: f64, stationary: bool) -> DMatrix<f64> {
        const FINE: usize = 10;
        let samples = self.instant_s.len();
        let vehicle = &self.scenario.vehicle;
        let mut grid = Vec::with_capacity(samples * FINE);
        let mut before_s = self.begin.0;
        for instant_s in &self.instant_s {
            grid.extend((1..=FINE).map(|k| before_s + (instant_s - before_s) * k as f64 / FINE as f64));
            before_s = *instant_s;
        }
        let states = self.states(&grid, |_, _| ());
        let decay = if stationary { 1.0 / time_s } else { 0.0 };
        let density = if stationary { 2.0 * std * std / time_s } else { std * std };
        let mut spread = Matrix3::zeros();
        spread[(2, 2)] = if stationary { std * std } else { 0.0 };
        let (mut transitions, mut spreads) = (Vec::new(), Vec::new());
        let mut before_s = self.begin.0;
        for (times, states) in grid.chunks(FINE).zip(states.chunks(FINE)) {
            let mut whole = Matrix3::identity();
            for (time_s, state) in times.iter().zip(states) {
                let length_s = time_s - before_s;
                before_s = *time_s;
                let damping = vehicle.drag.slope(state[SPEED]) / vehicle.alpha;
                let spring = (vehicle.stiffness + vehicle.force.tether) / vehicle.alpha;
                let rate = Matrix3::new(0.0, 1.0, 0.0, -spring, -damping, 1.0 / vehicle.alpha, 0.0, 0.0, -decay);
                let step = (rate * length_s).exp();
                spread = step * spread * step.transpose();
                spread[(2, 2)] += density * length_s;
                whole = step * whole;
            }
            transitions.push(whole);
            spreads.push(spread);
        }
        let mut covariance = DMatrix::zeros(samples, samples);
        for i in 0..samples {
            let mut row: Vector3<f64> = spreads[i].column(0).into();
            covariance[(i, i)] = row[0];
            for j in i + 1..samples {
                row = transitions[j] * row;
                covariance[(i, j)] = row[0];
                covariance[(j, i)] = row[0];
            }
        }
        covariance
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::Commander;
    use crate::sensor::Sensor;
    use crate::vehicle::{Drag, Force, Vehicle};

    /// The spread of positions over many paths of the force is the covariance computed from one.
    #[test]
    fn covariance_of_a_random_force_is_that_of_many_runs() {
        let forces = [
            Force { walk: 0.02, ..Force::default() },
            Force { ornstein_uhlenbeck: 0.02, ornstein_uhlenbeck_time_s: 2.0, ..Force::default() },
        ];
        for force in forces {
            let drag = Drag { linear: 0.3, quadratic: 0.2, ..Drag::default() };
            let scenario = Scenario {
                vehicle: Vehicle { drag, stiffness: 0.2, force, ..Vehicle::default() },
                commander: Commander::Sequence { changes: vec![(0.0, 1.0), (3.0, -1.0)] },
                sensor: Sensor { rate_hz: 1.0, ..Sensor::default() },
                logged: Logged::Order,
                duration_s: 8.0,
                lead_s: 0.0,
                first_stamp_s: 0.0,
                position: 0.0,
                speed: 0.0,
                starts_high: true,
            };
            let still =
                Scenario { vehicle: Vehicle { force: Force::default(), ..scenario.vehicle }, ..scenario.clone() };
            let nominal = still.run(0).position;
            let Errors::Coloured(expected) = scenario.run(0).error_covariance() else { panic!("a random force") };
            let runs: Vec<Vec<f64>> = (0..2000).map(|seed| scenario.run(seed).position).collect();
            for (i, j) in [(8, 8), (5, 5), (4, 8)] {
                let product = |run: &Vec<f64>| (run[i] - nominal[i]) * (run[j] - nominal[j]);
                let found = runs.iter().map(product).sum::<f64>() / runs.len() as f64;
                // Four standard deviations of a variance from 2000 runs are 13 %.
                let ratio = found / expected[(i, j)];
                assert!((ratio - 1.0).abs() < 0.13, "{force:?} {i} {j}: {ratio}");
            }
        }
    }
}
