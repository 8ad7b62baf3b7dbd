//! The cycles that random starts reach.

use f256::f256;

use super::attraction::Fate;
use super::control_loop::RelayLoop;
use super::orbit::Orbit;
use super::settle::{End, Scales, settle};
use super::simulation::Simulator;
use super::starts::start;
use crate::scalar::Scalar;

/// Starts of each loop.
pub const STARTS: u64 = 30;
/// Cycles are one where their times differ by less than this share of the period.
const SAME: f64 = 1e-6;

/// A cycle with one switching each way and the number of starts that end on it.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// The orbit, refined.
    pub orbit: Orbit,
    /// Starts that end on it.
    pub starts: usize,
}

/// A cycle with several switchings each way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LongCycle {
    /// Switchings in a period.
    pub switchings: usize,
    /// Period in s.
    pub period: f64,
    /// Starts that end on it.
    pub starts: usize,
}

/// Ends of all starts of a loop.
#[derive(Clone, Debug, Default)]
pub struct Reached {
    /// Cycles with one switching each way.
    pub cycles: Vec<Cycle>,
    /// Cycles with several.
    pub long_cycles: Vec<LongCycle>,
    /// Starts that escaped.
    pub escaped: usize,
    /// Starts after which the relay stopped switching.
    pub stuck: usize,
    /// Starts without an end in sight.
    pub wandering: usize,
    /// Starts that floats cannot follow past a touching.
    pub unclear: usize,
    /// Cycles of the simulation in floats that 71 digits do not confirm: a fault of the judge.
    pub unconfirmed: Vec<(f64, f64)>,
}

/// Simulates a loop from its random starts.
#[must_use]
pub fn reached(control_loop: &RelayLoop, seed: u64) -> Reached {
    let floats = Simulator::<f64>::new(control_loop);
    let exact = Simulator::<f256>::new(control_loop);
    let scales = Scales::of(&floats);
    let mut found = Reached::default();
    for number in 0..STARTS {
        match settle(&floats, &scales, start(&floats, &scales, seed, number)) {
            End::Cycle { time_high, time_low } => found.count(&exact, time_high, time_low),
            End::LongCycle { switchings, period } => found.count_long(switchings, period),
            End::Escaped => found.escaped += 1,
            End::Stuck => found.stuck += 1,
            End::Wandering => found.wandering += 1,
            End::Unclear => found.unclear += 1,
        }
    }
    found
}

impl Reached {
    fn count(&mut self, exact: &Simulator<f256>, time_high: f64, time_low: f64) {
        let near = |orbit: &Orbit, tolerance: f64| orbit.distance(time_high, time_low) <= tolerance;
        if let Some(cycle) = self.cycles.iter_mut().find(|cycle| near(&cycle.orbit, SAME)) {
            cycle.starts += 1;
            return;
        }
        match Orbit::near(exact, time_high, time_low) {
            // Near a slowly attracting cycle the last half-periods are still off.
            Ok(orbit) if near(&orbit, 1e-3) && orbit.simulate(exact).is_ok() => {
                let same = |cycle: &&mut Cycle| {
                    cycle.orbit.distance(orbit.time_high.to_f64(), orbit.time_low.to_f64()) <= SAME
                };
                match self.cycles.iter_mut().find(same) {
                    Some(cycle) => cycle.starts += 1,
                    None => self.cycles.push(Cycle { orbit, starts: 1 }),
                }
            }
            _ => self.unconfirmed.push((time_high, time_low)),
        }
    }
}

impl Reached {
    fn count_long(&mut self, switchings: usize, period: f64) {
        let same =
            |cycle: &&mut LongCycle| cycle.switchings == switchings && (cycle.period / period - 1.0).abs() < SAME;
        match self.long_cycles.iter_mut().find(same) {
            Some(cycle) => cycle.starts += 1,
            None => self.long_cycles.push(LongCycle { switchings, period, starts: 1 }),
        }
    }
}

/// A verdict on attraction: the disturbed simulation, and the linearised return map beside it.
#[derive(Clone, Copy, Debug)]
pub struct Attraction {
    /// What the disturbed simulation does.
    pub fate: Fate,
    /// Spectral radius of the linearised return map.
    pub radius: Option<f64>,
}

impl Attraction {
    /// The verdict: the simulation's, or where it is undecided that of a spectral radius off 1 by more than 1e-9.
    #[must_use]
    pub fn attracting(&self) -> Option<bool> {
        match (self.fate, self.radius) {
            (Fate::Returns, _) => Some(true),
            (Fate::Leaves, _) => Some(false),
            (Fate::Undecided, Some(radius)) if (radius - 1.0).abs() > 1e-9 => Some(radius < 1.0),
            (Fate::Undecided, _) => None,
        }
    }

    /// Whether simulation and linearisation contradict each other: a fault of the judge, or of a basin below the disturbance.
    #[must_use]
    pub fn contradicts_itself(&self) -> bool {
        match (self.fate, self.radius) {
            (Fate::Returns, Some(radius)) => radius > 1.0 + 1e-9,
            (Fate::Leaves, Some(radius)) => radius < 1.0 - 1e-9,
            _ => false,
        }
    }
}
