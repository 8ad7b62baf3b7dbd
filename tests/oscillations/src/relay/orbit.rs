//! Periodic orbits with one switching each way: found from their two times, refined to 71 digits, simulated.

use std::collections::VecDeque;

use f256::f256;

use super::control_loop::Level;
use super::simulation::{Event, Limit, Simulator, State};
use super::switching_conditions::half_periods;
use crate::crossing::{leading, range};
use crate::linear::spectral_radius;
use crate::scalar::Scalar;

/// A periodic solution of the switching conditions: an orbit if the simulation agrees.
#[derive(Clone, Debug)]
pub struct Orbit {
    /// Time per period at the upper level, in s.
    pub time_high: f256,
    /// Time per period at the lower level, in s.
    pub time_low: f256,
    /// State of the plant where the command becomes low.
    pub z: Vec<f256>,
}

/// Why two times are no orbit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Absent {
    /// The times are not positive and finite.
    #[error("times {time_high} and {time_low} s are no half-periods")]
    Times {
        /// Time at the upper level in s.
        time_high: f64,
        /// Time at the lower level in s.
        time_low: f64,
    },
    /// Newton's iteration ends nowhere.
    #[error("the switching conditions have no solution near")]
    NoSolution,
    /// It ends elsewhere.
    #[error("the nearest solution of the switching conditions has times {time_high} and {time_low} s")]
    Elsewhere {
        /// Time at the upper level in s.
        time_high: f64,
        /// Time at the lower level in s.
        time_low: f64,
    },
    /// The simulation from the orbit's state does something else.
    #[error("simulated from its state the relay switches after {found:?} s instead of {expected} s")]
    OtherSwitching {
        /// Expected time to the switching in s.
        expected: f64,
        /// Simulated one; `None` without a switching.
        found: Option<f64>,
    },
    /// The simulation switches as expected but the plant is elsewhere.
    #[error("after a period the plant is not back: its state is off by {off}")]
    NotPeriodic {
        /// Difference of z after a period.
        off: f64,
    },
}

/// Largest distance of a listed time from the refined one, and of a simulated switching from the expected one, over the period.
pub const EXISTENCE: f64 = 1e-9;

/// Coordinates of the return map up to which it is linearised.
pub const MOST_COORDINATES: usize = 64;

/// Motion over one period.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Largest output.
    pub maximum: f256,
    /// Smallest output.
    pub minimum: f256,
    /// Half the peak-to-peak value of each state of the plant, as far as ends and middles of steps show it.
    pub swing: Vec<f64>,
}

impl Path {
    /// Half the peak-to-peak value.
    #[must_use]
    pub fn amplitude(&self) -> f256 {
        (self.maximum - self.minimum).div2()
    }

    /// Middle of the extremes.
    #[must_use]
    pub fn bias(&self) -> f256 {
        (self.maximum + self.minimum).div2()
    }
}

impl Orbit {
    /// The orbit near these times, refined and simulated over one period.
    ///
    /// # Errors
    /// No orbit has these times within [`EXISTENCE`] of the period: see [`Absent`].
    pub fn at(simulator: &Simulator<f256>, time_high: f64, time_low: f64) -> Result<Self, Absent> {
        let orbit = Self::near(simulator, time_high, time_low)?;
        if !(orbit.distance(time_high, time_low) <= EXISTENCE) {
            let (time_high, time_low) = (orbit.time_high.to_f64(), orbit.time_low.to_f64());
            return Err(Absent::Elsewhere { time_high, time_low });
        }
        orbit.simulate(simulator)?;
        Ok(orbit)
    }

    /// The solution of the switching conditions near these times, to 71 digits.
    ///
    /// # Errors
    /// As [`half_periods`].
    pub fn near(simulator: &Simulator<f256>, time_high: f64, time_low: f64) -> Result<Self, Absent> {
        let found = half_periods(simulator, time_high, time_low)?;
        Ok(Self { time_high: found.time_high, time_low: found.time_low, z: found.z })
    }

    /// Period in s.
    #[must_use]
    pub fn period(&self) -> f256 {
        self.time_high + self.time_low
    }

    /// Largest distance of these times from the orbit's, over its period.
    #[must_use]
    pub fn distance(&self, time_high: f64, time_low: f64) -> f64 {
        let off = |exact: f256, other: f64| ((exact - f256::from(other)) / self.period()).to_f64().abs();
        off(self.time_high, time_high).max(off(self.time_low, time_low))
    }

    /// State of the loop on the orbit, just after the command has become low.
    #[must_use]
    pub fn state(&self, delay: f256) -> State<f256> {
        let mut due = VecDeque::new();
        // Switchings of the past, latest first: now, a time at high ago, a time at low before that ...
        let mut arrival = delay;
        let mut past = [self.time_high, self.time_low].into_iter().cycle();
        while arrival > f256::ZERO {
            due.push_front(arrival);
            arrival -= past.next().unwrap_or(f256::ONE);
        }
        State { z: self.z.clone(), command: Level::Low, due, on_threshold: true }
    }

    /// Simulates one period.
    ///
    /// # Errors
    /// Another switching than the orbit's, or another state at the end.
    pub fn simulate(&self, simulator: &Simulator<f256>) -> Result<Path, Absent> {
        let mut state = self.state(simulator.delay);
        let period = self.period().to_f64();
        let limit = Limit { duration: 2.0 * period, distance: f64::MAX };
        let mut output: Option<(f256, f256)> = None;
        let mut states = vec![(f64::INFINITY, f64::NEG_INFINITY); self.z.len()];
        for expected in [self.time_low, self.time_high] {
            let event = simulator.run_observed(&mut state, limit, |step| {
                // The output's motion from the step's start: a small one about a large constant keeps its digits.
                let mut series = simulator.motion.output_series(&step.derivatives, step.duration);
                let start = core::mem::replace(&mut series[0], f256::ZERO);
                let (low, high) = range(&leading(&series));
                let (low, high) = (start + f256::from(low), start + f256::from(high));
                let (least, most) = output.unwrap_or((low, high));
                output = Some((if low < least { low } else { least }, if high > most { high } else { most }));
                let middle = simulator.motion.state(&step.derivatives, step.duration.div2());
                for state in [step.derivatives.state(), &middle] {
                    states.iter_mut().zip(state).for_each(|(range, z)| widen(range, z.to_f64()));
                }
            });
            let found = if let Event::Switched(after) = event { Some(after) } else { None };
            let off = found.map_or(f64::INFINITY, |after| ((after - expected).to_f64() / period).abs());
            if !(off <= EXISTENCE) {
                return Err(Absent::OtherSwitching { expected: expected.to_f64(), found: found.map(f256::to_f64) });
            }
            states.iter_mut().zip(&state.z).for_each(|(range, z)| widen(range, z.to_f64()));
        }
        let swing: Vec<f64> = states.iter().map(|(low, high)| 0.5 * (high - low)).collect();
        let mut differences = state.z.iter().zip(&self.z).map(|(&a, &b)| (a - b).to_f64().abs());
        if differences.clone().zip(&swing).all(|(difference, &swing)| difference <= EXISTENCE * swing) {
            let (minimum, maximum) = output.unwrap_or((f256::NAN, f256::NAN));
            Ok(Path { maximum, minimum, swing })
        } else {
            Err(Absent::NotPeriodic { off: differences.next().unwrap_or(f64::NAN) })
        }
    }

    /// Spectral radius of the linearised return map, by differences of 1e-25 in 71 digits; `None` where a neighbour does not
    /// return, or with more than [`MOST_COORDINATES`].
    ///
    /// The section is the switching to low: states of the plant on the threshold, and the times of the commands under way
    /// (that of the switching itself is the dead time and no coordinate).
    #[must_use]
    pub fn spectral_radius(&self, simulator: &Simulator<f256>, path: &Path) -> Option<f64> {
        let section = Section::new(simulator);
        let difference = f256::from(1e-25);
        let start = self.state(simulator.delay);
        let scales = section.scales(self, path, start.due.len());
        if scales.len() > MOST_COORDINATES {
            return None;
        }
        let returned =
            |state: State<f256>| section.coordinates(&section.period(simulator, state, self)?, start.due.len());
        let reference = returned(start.clone())?;
        let mut columns = Vec::new();
        for (index, &scale) in scales.iter().enumerate() {
            let mut moved = start.clone();
            section.displace(&mut moved, index, difference * scale);
            let moved = returned(moved)?;
            let column = moved.iter().zip(&reference).zip(&scales);
            columns.push(column.map(|((&a, &b), &unit)| (a - b) / (difference * unit)).collect::<Vec<_>>());
        }
        let rows = (0..columns.len()).map(|row| columns.iter().map(|column| column[row]).collect()).collect();
        Some(spectral_radius(&rows))
    }
}

/// Coordinates of the section on which the command becomes low.
#[derive(Clone, Debug)]
pub struct Section {
    /// Index of the state that the threshold determines.
    dependent: usize,
    /// Numerator's coefficient there.
    leading: f256,
    /// Numerator over that coefficient.
    slopes: Vec<f256>,
}

impl Section {
    /// The section of a loop.
    #[must_use]
    pub fn new(simulator: &Simulator<f256>) -> Self {
        let numerator = &simulator.motion.numerator;
        let dependent = numerator.iter().position(|&b| b != f256::ZERO).unwrap_or(0);
        let leading = numerator[dependent];
        Self { dependent, leading, slopes: numerator.iter().map(|&b| b / leading).collect() }
    }

    /// A scale for each coordinate: swing of the state on the orbit, period.
    #[must_use]
    pub fn scales(&self, orbit: &Orbit, path: &Path, under_way: usize) -> Vec<f256> {
        let states =
            path.swing.iter().enumerate().filter(|&(i, _)| i != self.dependent).map(|(_, &swing)| f256::from(swing));
        states.chain((1..under_way).map(|_| orbit.period())).collect()
    }

    /// Moves one coordinate and stays on the threshold.
    pub fn displace(&self, state: &mut State<f256>, index: usize, by: f256) {
        let free = state.z.len() - 1;
        if index < free {
            let i = if index < self.dependent { index } else { index + 1 };
            state.z[i] += by;
            state.z[self.dependent] -= self.slopes[i] * by;
        } else {
            state.due[index - free] += by;
        }
    }

    /// Moves the output off the threshold.
    pub fn lift(&self, state: &mut State<f256>, by: f256) {
        state.z[self.dependent] += by / self.leading;
    }

    fn coordinates(&self, state: &State<f256>, under_way: usize) -> Option<Vec<f256>> {
        let states = state.z.iter().enumerate().filter(|&(i, _)| i != self.dependent).map(|(_, &value)| value);
        let due = state.due.iter().take(under_way.saturating_sub(1)).copied();
        (state.due.len() == under_way).then(|| states.chain(due).collect())
    }

    fn period(&self, simulator: &Simulator<f256>, mut state: State<f256>, orbit: &Orbit) -> Option<State<f256>> {
        let limit = Limit { duration: 2.0 * orbit.period().to_f64(), distance: f64::MAX };
        for _ in 0..2 {
            let Event::Switched(_) = simulator.run(&mut state, limit) else { return None };
        }
        Some(state)
    }
}

fn widen(range: &mut (f64, f64), value: f64) {
    *range = (range.0.min(value), range.1.max(value));
}
