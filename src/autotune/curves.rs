//! Curves of a loop: its open loop and its answer to a load, for the likeliest process and the ends of the confidence set.

use super::ProvedGains;
use super::gains::ultimate;
use super::load_step::{STEPS, STEPS_PER_PERIOD, load_step};
use crate::control::LinearProcess;

/// Points of an open loop, and frequencies over the ultimate one between which they lie.
const POINTS: u32 = 60;
const FREQUENCIES: [f64; 2] = [0.1, 10.0];
/// Ultimate periods of the answer to a load, and its points.
const PERIODS: f64 = 8.0;
const SHOWN: usize = 400;

/// Curves of the loop with proved gains.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct LoopCurves {
    /// Frequencies, rad/s.
    pub omega_rad_s: Vec<f64>,
    /// Real and imaginary part of the likeliest process's open loop, for an output that rises with the command.
    pub open_loop: Vec<[f64; 2]>,
    /// The same for both ends of each axis of every structure's set, or the corners of its hull: all lie outside the circle of the
    /// sensitivity about -1.
    pub open_loops: Vec<Vec<[f64; 2]>>,
    /// Times after a step of the load, s.
    pub time_s: Vec<f64>,
    /// The likeliest process's output for a load of one command unit.
    pub load_step: Vec<f64>,
    /// Least and largest output over the same processes.
    pub load_step_range: Vec<[f64; 2]>,
}

impl ProvedGains {
    /// The curves of the gains, the controller's hold among the delays; `None` where the process has no ultimate point.
    #[must_use]
    pub fn curves(&self) -> Option<LoopCurves> {
        let sets = &self.sets;
        let nominal = sets.first()?.middle();
        let [_, ultimate_rad_s] = ultimate(&nominal)?;
        let period_s = core::f64::consts::TAU / ultimate_rad_s;
        let ends: Vec<LinearProcess<f64>> = sets.iter().flat_map(|set| set.corners()).collect();
        let gains = &self.gains;
        let [low, high] = FREQUENCIES;
        let share = |k: u32| f64::from(k) / f64::from(POINTS - 1);
        let omega_rad_s: Vec<f64> =
            (0..POINTS).map(|k| ultimate_rad_s * low * libm::pow(high / low, share(k))).collect();
        let curve = |process: &LinearProcess<f64>| process.open_loop_at(gains, &omega_rad_s);
        let every = ((PERIODS * STEPS_PER_PERIOD) as usize).min(STEPS) / SHOWN;
        let answer = |process: &LinearProcess<f64>| {
            let (mut all, mut step) = (Vec::with_capacity(SHOWN), 0);
            load_step(process, gains, period_s, |time_s, y| {
                if step % every == 0 {
                    all.push((time_s, y));
                }
                step += 1;
                all.len() < SHOWN
            });
            all
        };
        let nominal_step = answer(&nominal);
        let mut load_step_range: Vec<[f64; 2]> = nominal_step.iter().map(|(_, y)| [*y, *y]).collect();
        for end in &ends {
            for (range, (_, y)) in load_step_range.iter_mut().zip(answer(end)) {
                *range = [range[0].min(y), range[1].max(y)];
            }
        }
        Some(LoopCurves {
            open_loop: curve(&nominal),
            open_loops: ends.iter().map(curve).collect(),
            time_s: nominal_step.iter().map(|(time_s, _)| *time_s).collect(),
            load_step: nominal_step.iter().map(|(_, y)| *y).collect(),
            load_step_range,
            omega_rad_s,
        })
    }
}
