//! The path of the forces from outside, drawn once on a grid and linear between its knots.

use core::f64::consts::TAU;

use crate::integrate::STEP_S;
use crate::random::Random;
use crate::vehicle::Force;

/// A force along one record.
#[derive(Clone, Debug)]
pub struct ForcePath {
    force: Force,
    random: Random,
    /// Random walk, Ornstein-Uhlenbeck force, and anchor at the last knot.
    parts: [f64; 3],
    knots: Vec<f64>,
}

impl ForcePath {
    /// Draws a path with knots [`STEP_S`] apart, from time zero on.
    #[must_use]
    pub fn new(force: Force, mut random: Random) -> Self {
        let parts = [0.0, force.ornstein_uhlenbeck * random.normal(), force.anchor * random.normal()];
        Self { force, random, parts, knots: vec![parts[1] + force.tether * parts[2]] }
    }

    /// The same random part, beside a sine of other numbers.
    pub(crate) fn with_sine_of(&self, force: Force) -> Self {
        let Force { sine, sine_period_s, sine_phase_rad, .. } = force;
        Self { force: Force { sine, sine_period_s, sine_phase_rad, ..self.force }, ..self.clone() }
    }

    fn is_random(&self) -> bool {
        self.force.walk > 0.0 || self.force.ornstein_uhlenbeck > 0.0 || self.force.tether > 0.0
    }

    /// The random part at a knot.
    fn knot(&mut self, index: usize) -> f64 {
        while self.knots.len() <= index {
            let [walk, coloured, anchor] = &mut self.parts;
            *walk += self.force.walk * STEP_S.sqrt() * self.random.normal();
            for (value, std, time_s) in [
                (coloured, self.force.ornstein_uhlenbeck, self.force.ornstein_uhlenbeck_time_s),
                (anchor, self.force.anchor, self.force.anchor_time_s),
            ] {
                if std > 0.0 {
                    let kept = (-STEP_S / time_s).exp();
                    *value = kept * *value + std * (1.0 - kept * kept).sqrt() * self.random.normal();
                }
            }
            self.knots.push(self.parts[0] + self.parts[1] + self.force.tether * self.parts[2]);
        }
        self.knots[index]
    }

    /// The random part at the first knots, [`STEP_S`] apart.
    #[must_use]
    pub fn values(mut self, count: usize) -> Vec<f64> {
        (0..count).map(|index| self.knot(index)).collect()
    }

    /// The force within the cell behind knot `cell`, as a line: value at its left knot, and slope.
    pub(crate) fn cell(&mut self, cell: usize) -> (f64, f64) {
        if !self.is_random() {
            return (0.0, 0.0);
        }
        let (left, right) = (self.knot(cell), self.knot(cell + 1));
        (left, (right - left) / STEP_S)
    }

    /// The sine.
    pub(crate) fn sine(&self, time_s: f64) -> f64 {
        if self.force.sine == 0.0 {
            return 0.0;
        }
        self.force.sine * (TAU * time_s / self.force.sine_period_s + self.force.sine_phase_rad).sin()
    }
}
