//! What a loop answers to a step of the load, in time.

use crate::control::{Gains, LinearProcess};

/// Steps of an answer to a load, and how many an ultimate period has.
pub(super) const STEPS: usize = 4000;
pub(super) const STEPS_PER_PERIOD: f64 = 200.0;

/// The output after a unit step of the load, in semi-implicit Euler steps; `each` takes the time and the output until it returns false.
pub(super) fn load_step(
    process: &LinearProcess<f64>,
    gains: &Gains<f64>,
    period_s: f64,
    mut each: impl FnMut(f64, f64) -> bool,
) {
    let step_s = period_s / STEPS_PER_PERIOD;
    let late = (process.delay_s / step_s).round().min(1e5) as usize;
    let mut under_way = vec![0.0; late + 1];
    let (mut x, mut v, mut filtered, mut integral) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0);
    for k in 0..STEPS {
        let y = x + process.zero_s * v;
        let rate = if gains.filter_s() > 0.0 { (y - filtered) / gains.filter_s().max(step_s) } else { 0.0 };
        filtered += step_s * rate;
        integral -= step_s * y;
        let command = -gains.proportional() * y + gains.integral() * integral - gains.derivative() * rate;
        let place = k % (late + 1);
        under_way[place] = command;
        let acts = 1.0 + under_way[(k + 1) % (late + 1)];
        if process.alpha > 0.0 {
            v += step_s * (acts - process.drag * v - process.stiffness * x) / process.alpha.max(step_s * process.drag);
        } else {
            v = (acts - process.stiffness * x) / process.drag;
        }
        x += step_s * v;
        if !each(k as f64 * step_s, y) {
            return;
        }
    }
}

/// The integral of the absolute error after a unit step of the load.
pub(super) fn absolute_error(process: &LinearProcess<f64>, gains: &Gains<f64>, period_s: f64) -> f64 {
    let mut sum = 0.0_f64;
    load_step(process, gains, period_s, |_, y| {
        sum += period_s / STEPS_PER_PERIOD * y.abs();
        sum.is_finite()
    });
    if !sum.is_finite() {
        return f64::INFINITY;
    }
    // A slow tail goes on beyond the steps: the integral of the error itself is 1/Ki, since integral action ends at the load.
    sum.max(gains.integral().recip())
}
