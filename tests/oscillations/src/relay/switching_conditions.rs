//! The conditions on the half-periods of an orbit with one switching each way, and Newton's iteration for them.

use super::control_loop::Level;
use super::orbit::Absent;
use super::simulation::Simulator;
use crate::linear::{Matrix, least_squares, solve};
use crate::scalar::Scalar;

/// A solution of the switching conditions. It is an orbit if the simulation agrees.
#[derive(Clone, Debug)]
pub struct HalfPeriods<S> {
    /// Time per period at the upper level, in s.
    pub time_high: S,
    /// Time per period at the lower level, in s.
    pub time_low: S,
    /// State of the plant where the command becomes low.
    pub z: Vec<S>,
}

/// Iterations before the search is given up. From a start 1e-3 off, 71 digits need seven.
const ITERATIONS: usize = 20;
/// Iterations after which the steps must have become shorter than a tenth of the period.
const GRACE: usize = 8;

/// The solution that Newton's iteration reaches from these times.
///
/// Unknowns: the state where the command becomes low, and both times. Conditions: the state comes back, the output is at the
/// upper threshold there and at the lower one after `time_low`.
///
/// # Errors
/// Times that are not positive, or an iteration that ends nowhere.
pub fn half_periods<S: Scalar>(
    simulator: &Simulator<S>,
    time_high: f64,
    time_low: f64,
) -> Result<HalfPeriods<S>, Absent> {
    if !(time_high > 0.0 && time_low > 0.0 && (time_high + time_low).is_finite()) {
        return Err(Absent::Times { time_high, time_low });
    }
    let n = simulator.motion.order();
    let mut times = [S::from_f64(time_high), S::from_f64(time_low)];
    let mut z = best_state(simulator, times).ok_or(Absent::NoSolution)?;
    // Differences lose half the digits, the iteration gains them back.
    let small = S::from_f64(S::ROUNDING.sqrt());
    for iteration in 0..ITERATIONS {
        let residual = conditions(simulator, &z, times);
        let size = z.iter().fold(S::from_f64(1e-9), |most, value| if value.abs() > most { value.abs() } else { most });
        let mut jacobian = vec![Vec::with_capacity(n + 2); n + 2];
        for column in 0..n + 2 {
            let (mut moved, mut at) = (z.clone(), times);
            let difference = small * if column < n { size } else { times[column - n] };
            let unknown = if column < n { &mut moved[column] } else { &mut at[column - n] };
            *unknown = *unknown + difference;
            let after = conditions(simulator, &moved, at);
            for (row, (&after, &before)) in jacobian.iter_mut().zip(after.iter().zip(&residual)) {
                row.push((after - before) / difference);
            }
        }
        let step = solve(jacobian, residual).ok_or(Absent::NoSolution)?;
        z.iter_mut().zip(&step).for_each(|(value, &change)| *value = *value - change);
        let moved = ((step[n].abs() + step[n + 1].abs()) / (times[0] + times[1])).to_f64();
        times = [times[0] - step[n], times[1] - step[n + 1]];
        if !(times[0] > S::ZERO && times[1] > S::ZERO && moved < if iteration < GRACE { 3.0 } else { 0.1 }) {
            break;
        }
        if moved < S::ROUNDING.powf(0.7) {
            return Ok(HalfPeriods { time_high: times[0], time_low: times[1], z });
        }
    }
    Err(Absent::NoSolution)
}

/// The state that satisfies the conditions best for given times: they are affine in it, and least squares because a pole at the
/// origin leaves the periodicity alone singular.
fn best_state<S: Scalar>(simulator: &Simulator<S>, times: [S; 2]) -> Option<Vec<S>> {
    let n = simulator.motion.order();
    let rest = conditions(simulator, &vec![S::ZERO; n], times);
    let columns: Vec<Vec<S>> = (0..n)
        .map(|i| {
            let mut unit = vec![S::ZERO; n];
            unit[i] = S::ONE;
            conditions(simulator, &unit, times).iter().zip(&rest).map(|(&a, &b)| a - b).collect()
        })
        .collect();
    let rows: Matrix<S> = (0..n + 2).map(|row| columns.iter().map(|column| column[row]).collect()).collect();
    least_squares(&rows, &rest.iter().map(|&value| -value).collect::<Vec<_>>())
}

/// The state after a period less the state, and the output at both switchings less its threshold.
fn conditions<S: Scalar>(simulator: &Simulator<S>, z: &[S], [time_high, time_low]: [S; 2]) -> Vec<S> {
    let period = time_high + time_low;
    let within = |time: S| time - S::from_f64((time / period).to_f64().floor()) * period;
    // In a period from the switching to low: the plant receives low at one of these instants and high at the other.
    let (to_low, to_high) = (within(simulator.delay), within(simulator.delay + time_low));
    let mut level = if to_low <= to_high { Level::High } else { Level::Low };
    let mut instants = [to_low, to_high, time_low, period];
    instants.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    let mut state = z.to_vec();
    let (mut now, mut at_lower) = (S::ZERO, S::ZERO);
    for instant in instants {
        simulator.motion.advance(&mut state, simulator.input(level), instant - now);
        now = instant;
        if instant == time_low {
            at_lower = simulator.motion.output(&state);
        }
        if instant == to_low {
            level = Level::Low;
        } else if instant == to_high {
            level = Level::High;
        }
    }
    let mut residual: Vec<S> = state.iter().zip(z).map(|(&after, &before)| after - before).collect();
    residual.push(simulator.motion.output(z) - simulator.upper);
    residual.push(at_lower - simulator.lower);
    residual
}
