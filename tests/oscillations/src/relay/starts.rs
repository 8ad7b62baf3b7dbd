//! Random starts: a state of the plant and a history of the command over the dead time.

use std::collections::VecDeque;

use super::control_loop::Level;
use super::settle::Scales;
use super::simulation::{Simulator, State};
use crate::random::Random;

/// Most switchings in the history.
const HISTORY: usize = 7;

/// The start of a number.
///
/// States are uniform in plus or minus their natural scale ([`Scales`]) times a factor with uniform logarithm in 0.01 to 10; the
/// first of them then puts the output within that factor (at most 1) of its scale around the thresholds. The history has 0 to 6
/// switchings at uniform times.
#[must_use]
pub fn start(simulator: &Simulator<f64>, scales: &Scales, loop_seed: u64, number: u64) -> State<f64> {
    let mut random = Random::new(loop_seed, 1000 + number);
    let motion = &simulator.motion;
    let size = random.log_uniform(0.01, 10.0);
    let mut z: Vec<f64> = scales.states.iter().map(|scale| size * random.uniform(-1.0, 1.0) * scale).collect();
    let command = random.pick(&[Level::High, Level::Low]);
    // The numerator's first coefficient places the output.
    let first = motion.numerator.iter().position(|&b| b != 0.0).unwrap_or(0);
    let reference = 0.5 * (simulator.upper + simulator.lower);
    let half_width = 0.5 * (simulator.upper - simulator.lower);
    let output = reference + random.uniform(-1.0, 1.0) * (half_width + size.min(1.0) * scales.output);
    z[first] += (output - motion.output(&z)) / motion.numerator[first];
    // A relay with this output cannot hold the other command.
    let command = if output > simulator.upper {
        Level::Low
    } else if output < simulator.lower {
        Level::High
    } else {
        command
    };
    let mut due: Vec<f64> = Vec::new();
    if simulator.delay > 0.0 {
        due.extend((0..random.below(HISTORY)).map(|_| random.uniform(0.0, 1.0) * simulator.delay));
        due.sort_by(f64::total_cmp);
    }
    State { z, command, due: VecDeque::from(due), on_threshold: false }
}
