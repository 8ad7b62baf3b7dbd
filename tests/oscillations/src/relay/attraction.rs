//! Whether an orbit attracts: it is started from a disturbed switching and a disturbed state, and followed in 71 digits.

use f256::f256;

use super::orbit::{Orbit, Path, Section};
use super::simulation::{Event, Limit, Simulator};
use crate::random::Random;
use crate::scalar::Scalar;

/// What becomes of a small disturbance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Fate {
    /// Every disturbance dies out.
    Returns,
    /// A disturbance grows until the motion is another one.
    Leaves,
    /// Neither within the periods followed.
    Undecided,
}

/// Size of a disturbance over the orbit's own swing and period.
const DISTURBANCE: f64 = 1e-6;
/// Directions of the disturbance.
const DIRECTIONS: u64 = 3;
/// A disturbance has died out when it is this much smaller than at first.
const DIED_OUT: f64 = 1e-2;
/// A disturbance has left when a half-period differs by this share of the period.
const LEFT: f64 = 0.03;
/// Periods that are followed. A multiplier of 0.993 dies out in them.
const PERIODS: usize = 600;

/// Follows three disturbances of 1e-6.
#[must_use]
pub fn fate(simulator: &Simulator<f256>, orbit: &Orbit, path: &Path) -> Fate {
    let mut all = Fate::Returns;
    for direction in 0..DIRECTIONS {
        match follow(simulator, orbit, path, direction) {
            Fate::Leaves => return Fate::Leaves,
            Fate::Undecided => all = Fate::Undecided,
            Fate::Returns => {}
        }
    }
    all
}

fn follow(simulator: &Simulator<f256>, orbit: &Orbit, path: &Path, direction: u64) -> Fate {
    let section = Section::new(simulator);
    let mut random = Random::new(direction, 0);
    let mut state = orbit.state(simulator.delay);
    let scales = section.scales(orbit, path, state.due.len());
    let mut disturbance = || f256::from(DISTURBANCE * random.uniform(0.3, 1.0) * random.pick(&[-1.0, 1.0]));
    for (index, &scale) in scales.iter().enumerate() {
        section.displace(&mut state, index, disturbance() * scale);
    }
    // The switching itself comes early or late; without dead time, at another output than the threshold.
    match state.due.back_mut() {
        Some(last) => *last += disturbance() * orbit.period(),
        None => section.lift(&mut state, disturbance() * path.amplitude()),
    }

    let period = orbit.period();
    let limit = Limit { duration: 3.0 * period.to_f64(), distance: f64::MAX };
    // So many half-periods in a row tell the commands under way and the plant's state.
    let window = state.due.len() + state.z.len() + 2;
    let mut deviations = Vec::with_capacity(window + 2 * PERIODS);
    for half in 0..window + 2 * PERIODS {
        let Event::Switched(after) = simulator.run(&mut state, limit) else { return Fate::Leaves };
        let expected = if half % 2 == 0 { orbit.time_low } else { orbit.time_high };
        deviations.push(((after - expected) / period).to_f64().abs());
        let largest = |part: &[f64]| part.iter().copied().fold(0.0, f64::max);
        if half >= 2 * window {
            let (first, last) = (largest(&deviations[..window]), largest(&deviations[half + 1 - window..]));
            if last <= DIED_OUT * first {
                return Fate::Returns;
            }
            if last > LEFT {
                return Fate::Leaves;
            }
        }
    }
    Fate::Undecided
}
