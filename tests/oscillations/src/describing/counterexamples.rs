//! Loops against Theorems 2 and 3 as printed: they oscillate, and otherwise than the theorems say.
//!
//! Theorem 2: with an odd characteristic the oscillation is symmetric if and only if the plant has an integrator. Theorem 3: with
//! an integrator it is asymmetric if and only if the characteristic is.

use serde::Serialize;

use super::characteristic::Characteristic;
use super::cycle::{Cycle, attracts, cycle, settle};
use crate::plant::Plant;
use crate::scalar::Scalar;

/// A loop and the start from which it is simulated.
#[derive(Clone, Debug)]
pub struct Counterexample {
    /// What it shows.
    pub name: &'static str,
    /// Plant, loop gain included.
    pub plant: Plant,
    /// Characteristic.
    pub characteristic: Characteristic,
    /// Output and its slope at the start; the second derivative is zero.
    pub start: [f64; 2],
}

/// Figures of its oscillation, from the return map in 71 digits.
#[derive(Clone, Debug, Serialize)]
pub struct Figures {
    /// What the loop shows.
    pub name: &'static str,
    /// Loop gain.
    pub gain: f64,
    /// Period in s.
    pub period_s: f64,
    /// Largest output.
    pub maximum: f64,
    /// Smallest output.
    pub minimum: f64,
    /// Mean output.
    pub mean: f64,
    /// Amplitude of the first harmonic.
    pub first: f64,
    /// Amplitude of the second harmonic.
    pub second: f64,
    /// Moduli of the two multipliers, the larger one first.
    pub multipliers: [f64; 2],
    /// Whether a disturbance dies out.
    pub attracting: Option<bool>,
    /// Starts of [`STARTS`] from which the simulation escapes.
    pub escaped: usize,
}

/// Outputs from which escapes are counted, at rest.
pub const STARTS: [f64; 6] = [0.1, 0.4, 0.8, 1.5, 2.5, 4.0];

fn equal_lags(gain: f64) -> Plant {
    Plant::new(&[gain], &[1.0, 2.0, 1.0, 0.0], 0.0)
}

fn parabola(gain: f64) -> Counterexample {
    Counterexample {
        name: "mean zero and not symmetric: x + x^2 - 0.1",
        plant: equal_lags(gain),
        characteristic: Characteristic::Polynomial { coefficients: vec![-0.1, 1.0, 1.0] },
        start: [0.1, 0.1],
    }
}

/// The loops. The gain of the last is that at which the mean of its oscillation vanishes.
#[must_use]
pub fn counterexamples() -> Vec<Counterexample> {
    let cubic = || Characteristic::Polynomial { coefficients: vec![0.0, -2.0, 0.0, 1.0] };
    vec![
        Counterexample {
            name: "odd, integrator, biased: slopes -1, 2, 0 with kinks 0.5 and 2",
            plant: equal_lags(1.2),
            characteristic: Characteristic::odd(&[0.5, 2.0], &[-1.0, 2.0, 0.0]),
            start: [0.6, 0.1],
        },
        Counterexample {
            name: "odd, integrator, biased: x^3 - 2 x",
            plant: equal_lags(0.6),
            characteristic: cubic(),
            start: [1.4, 0.2],
        },
        Counterexample {
            name: "odd, integrator, symmetric and far from a sinusoid: x^3 - 2 x",
            plant: equal_lags(1.0),
            characteristic: cubic(),
            start: [1.4, 0.3],
        },
        Counterexample {
            name: "not odd and symmetric: gain 1, then 0.2, limits -7 and 4",
            plant: Plant::new(&[10.0], &[1.0, 3.0, 2.0, 0.0], 0.0),
            characteristic: Characteristic::PiecewiseLinear {
                kinks: vec![-7.0, -1.0, 1.0, 4.0],
                slopes: vec![0.0, 0.2, 1.0, 0.2, 0.0],
            },
            start: [1.0, 1.0],
        },
        parabola(vanishing_mean().unwrap_or(f64::NAN)),
    ]
}

impl Counterexample {
    fn state(&self, [output, slope]: [f64; 2]) -> Vec<f64> {
        // All these plants have a constant numerator and a monic denominator.
        vec![output / self.plant.num[0], slope / self.plant.num[0], 0.0]
    }

    /// The cycle on which the simulation from the start settles.
    #[must_use]
    pub fn cycle(&self) -> Option<Cycle> {
        let found = settle(&self.plant, &self.characteristic, &self.state(self.start), 400.0)?;
        cycle(&self.plant, &self.characteristic, found.level, found.rises, &found.z, found.period)
    }

    /// Its figures.
    #[must_use]
    pub fn figures(&self) -> Option<Figures> {
        let found = self.cycle()?;
        let j = &found.jacobian;
        let determinant = (j[0][0] * j[1][1] - j[0][1] * j[1][0]).to_f64();
        let larger = found.radius();
        let escapes = |output: &&f64| {
            let control_loop = super::closed_loop::ClosedLoop::<f64>::new(&self.plant, &self.characteristic);
            control_loop.run(control_loop.place(self.state([**output, 0.0]), false), 200.0).is_none()
        };
        Some(Figures {
            name: self.name,
            gain: self.plant.num[0],
            period_s: found.period.to_f64(),
            maximum: found.maximum,
            minimum: found.minimum,
            mean: found.first.mean.to_f64(),
            first: found.first.amplitude(),
            second: found.second.amplitude(),
            multipliers: [larger, determinant.abs() / larger],
            attracting: attracts(&self.plant, &self.characteristic, &found),
            escaped: STARTS.iter().filter(escapes).count(),
        })
    }
}

/// Gain at which the mean of the parabola's oscillation vanishes: secants from both sides of 1.904899.
fn vanishing_mean() -> Option<f64> {
    let mean = |gain: f64| Some(parabola(gain).cycle()?.first.mean.to_f64());
    let (mut before, mut gain) = (1.9, 1.91);
    let mut at_before = mean(before)?;
    for _ in 0..12 {
        let at = mean(gain)?;
        let next = gain - at * (gain - before) / (at - at_before);
        (before, at_before) = (gain, at);
        // The float nearest the zero moves the mean by less than this.
        if at.abs() < 1e-15 || next == gain || !next.is_finite() {
            break;
        }
        gain = next;
    }
    Some(gain)
}
