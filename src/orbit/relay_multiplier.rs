//! The Jacobian of the return map of a relay loop with delay.

use std::collections::VecDeque;

use nalgebra::{Complex, DMatrix, DVector, RowDVector};

use super::OrbitError;
use super::relay_cycle::Cycle;
use crate::plant::{StateSpace, eigenvalues};

#[derive(Clone, Copy)]
enum Event {
    /// The relay switches: an output deviation becomes a deviation of the instant.
    Command,
    /// The switching arrives at the plant; the input jumps by this much.
    Input(f64),
}

/// Eigenvalues of the return map, largest first: the deviation when the output passes the lower level, one period later.
///
/// The state of the loop is the plant's state and the instants of the switchings still under way in the delay. Each
/// event acts linearly on deviations from the cycle, to first order; the direction along the cycle is projected out, so
/// that at least one eigenvalue is zero. `None` where the output grazes a level instead of passing it.
pub(super) fn multipliers(plant: &StateSpace, cycle: &Cycle) -> Result<Option<Vec<Complex<f64>>>, OrbitError> {
    let (period, delay, order) = (cycle.period(), plant.delay_s(), plant.order());
    let origin = cycle.command_on(plant);
    let jump = cycle.levels().high - cycle.levels().low;
    let full = |time: f64| (time / period).floor() as usize;
    let pending = full(delay) + full(delay + cycle.positive);
    let size = order + pending;

    // Times from the origin; a command comes before an input at the same time.
    let mut events = [
        (0.0, Event::Command),
        (cycle.positive, Event::Command),
        (delay.rem_euclid(period), Event::Input(jump)),
        ((delay + cycle.positive).rem_euclid(period), Event::Input(-jump)),
    ];
    events.sort_by(|a, b| a.0.total_cmp(&b.0));

    let identity = DMatrix::<f64>::identity(size, size);
    let mut state = identity.rows(0, order).into_owned();
    let mut queue: VecDeque<RowDVector<f64>> = (order..size).map(|row| identity.row(row).into_owned()).collect();
    let rate_before = |time: f64| {
        let inside = (origin + time).rem_euclid(period);
        // Just before the event the input is still the old one.
        let (at, input) = if inside == 0.0 {
            (period, cycle.levels().low)
        } else if inside <= cycle.positive {
            (inside, cycle.levels().high)
        } else {
            (inside, cycle.levels().low)
        };
        plant.rate(&cycle.state(plant, at), input)
    };

    let mut now = 0.0;
    for (time, event) in events {
        state = plant.flow(time - now).state * state;
        now = time;
        match event {
            Event::Command => {
                let slope = plant.output(&rate_before(time));
                if slope == 0.0 {
                    return Ok(None);
                }
                queue.push_back(plant.c() * &state * (-1.0 / slope));
            }
            Event::Input(jump) => {
                if let Some(late) = queue.pop_front() {
                    state -= plant.b() * (late * jump);
                }
            }
        }
    }
    state = plant.flow(period - now).state * state;

    let mut map = DMatrix::zeros(size, size);
    map.rows_mut(0, order).copy_from(&state);
    for (row, late) in queue.iter().take(pending).enumerate() {
        map.row_mut(order + row).copy_from(late);
    }
    let rate = rate_before(0.0);
    let slope = plant.output(&rate);
    let along = DVector::from_fn(size, |row, _| if row < order { rate[row] } else { -1.0 });
    let output = RowDVector::from_fn(size, |_, column| if column < order { plant.c()[column] / slope } else { 0.0 });
    let projected = (&identity - along * output) * map;
    let mut values = eigenvalues(&projected)?;
    values.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
    Ok(Some(values))
}
