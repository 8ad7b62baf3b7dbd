//! Orbits that no start reaches: Newton's iteration from a grid of periods and duties.

use f256::f256;

use super::control_loop::RelayLoop;
use super::orbit::Orbit;
use super::simulation::Simulator;
use super::switching_conditions::half_periods;
use crate::scalar::Scalar;

/// Periods of the grid, with a constant ratio.
const PERIODS: usize = 32;
/// Longest period of the grid in steps of the simulation.
const STEPS: f64 = 400.0;
/// Duties of the grid.
const DUTIES: [f64; 5] = [0.5, 0.3, 0.7, 0.12, 0.88];

/// Orbits found from the grid, attracting or not, in order of decreasing period. There may be more.
///
/// Periods begin at a quarter of the dead time, or of the plant's shortest time without dead time, and end at 30 times the
/// longest time of plant and dead time, or at 400 steps of the simulation.
#[must_use]
pub fn search(control_loop: &RelayLoop) -> Vec<Orbit> {
    let floats = Simulator::<f64>::new(control_loop);
    let exact = Simulator::<f256>::new(control_loop);
    let shortest = if floats.delay > 0.0 { floats.delay } else { floats.motion.step() };
    let slowest = floats.motion.slowest_rate().map_or(0.0, |rate| 1.0 / rate);
    let first = 0.25 * shortest;
    let longest = 30.0 * floats.delay.max(floats.motion.step()).max(slowest);
    let last = longest.min(STEPS * floats.motion.step()).max(4.0 * shortest);
    let ratio = (last / first).powf(1.0 / (PERIODS - 1) as f64);
    let mut found: Vec<Orbit> = Vec::new();
    for index in 0..PERIODS {
        let period = first * ratio.powi(index as i32);
        for duty in DUTIES {
            let Ok(near) = half_periods(&floats, duty * period, (1.0 - duty) * period) else { continue };
            if !(first..=2.0 * last).contains(&(near.time_high + near.time_low)) {
                continue;
            }
            let known = |orbit: &Orbit| orbit.distance(near.time_high, near.time_low) < 1e-6;
            if found.iter().any(known) {
                continue;
            }
            if let Ok(orbit) = Orbit::near(&exact, near.time_high, near.time_low) {
                let known =
                    found.iter().any(|other| other.distance(orbit.time_high.to_f64(), orbit.time_low.to_f64()) < 1e-9);
                if !known && orbit.simulate(&exact).is_ok() {
                    found.push(orbit);
                }
            }
        }
    }
    found.sort_by(|a, b| b.period().total_cmp(&a.period()));
    found
}
