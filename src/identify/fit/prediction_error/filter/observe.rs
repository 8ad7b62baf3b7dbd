//! What a reading does: to the state and its covariance, to their derivatives, and to the score.

use super::Filter;
use super::pass::{Innovation, NOISES, STRUCTURE, Score};
use super::transition::Vector;
use crate::identify::fit::prediction_error::model::NoiseParameter;

impl<const N: usize> Filter<'_, N> {
    /// Derivatives of the prediction's error.
    pub(super) fn slopes(&self) -> [f64; STRUCTURE] {
        let mut slopes = [0.0; STRUCTURE];
        for (parameter, column) in &self.sensitivities.structure {
            slopes[*parameter as usize] = -(column[self.read] + column[3]);
        }
        slopes
    }

    /// Takes in a reading; adds its share of the score where there are sensitivities.
    pub(super) fn observe(&mut self, reading: f64, weight: f64, score: &mut Score) -> Innovation {
        let read = self.read;
        let error = reading - self.state[read] - self.state[3];
        let p = &self.covariance;
        let seen: Vector<N> = core::array::from_fn(|row| p[row][read] + p[row][3]);
        let variance = seen[read] + seen[3] + self.sizes.white;
        let gain = seen.map(|value| value / variance);
        let structure = &mut self.sensitivities.structure;
        let mut by_structure = [(0, 0.0); STRUCTURE];
        let slopes = &mut by_structure[..structure.len()];
        for (slope, (parameter, column)) in slopes.iter_mut().zip(structure.iter()) {
            *slope = (*parameter as usize, -(column[read] + column[3]));
        }
        let precision = weight / variance;
        for (index, (i, slope)) in slopes.iter().enumerate() {
            let scaled = precision * slope;
            score.structure[*i] -= scaled * error;
            let row = &mut score.structure_information[*i];
            for (j, other) in &slopes[..=index] {
                row[*j] += scaled * other;
            }
        }
        if self.stochastic {
            for ((_, column), (_, slope)) in structure.iter_mut().zip(slopes) {
                for (value, gain) in column.iter_mut().zip(gain) {
                    *value += gain * *slope;
                }
            }
        }
        let mut slopes = [(0, 0.0, 0.0); NOISES];
        let count = self.sensitivities.noise.len();
        for ((noise, column, derivative), slope) in self.sensitivities.noise.iter_mut().zip(&mut slopes) {
            let d = &*derivative;
            let seen_by: Vector<N> = core::array::from_fn(|row| d[row][read] + d[row][3]);
            let direct = if *noise == NoiseParameter::White { self.sizes.white } else { 0.0 };
            let variance_by = seen_by[read] + seen_by[3] + direct;
            let error_by = -(column[read] + column[3]);
            *slope = (*noise as usize, error_by, variance_by);
            for row in 0..N {
                column[row] += (seen_by[row] - gain[row] * variance_by) / variance * error + gain[row] * error_by;
            }
            for row in 0..N {
                for other in 0..N {
                    derivative[row][other] +=
                        gain[row] * gain[other] * variance_by - seen_by[row] * gain[other] - gain[row] * seen_by[other];
                }
            }
        }
        let relative = error * error / variance;
        for &(i, error_by, variance_by) in &slopes[..count] {
            score.noise[i] += weight * (0.5 * variance_by * (relative - 1.0) - error * error_by) / variance;
            for &(j, other_error, other_variance) in &slopes[..count] {
                score.noise_information[i][j] += weight
                    * (0.5 * variance_by * other_variance / (variance * variance) + error_by * other_error / variance);
            }
        }
        if self.stochastic {
            for (state, gain) in self.state.iter_mut().zip(gain) {
                *state += gain * error;
            }
            for (row, seen) in self.covariance.iter_mut().zip(seen) {
                for (value, gain) in row.iter_mut().zip(gain) {
                    *value -= seen * gain;
                }
            }
        }
        Innovation { error, variance }
    }
}
