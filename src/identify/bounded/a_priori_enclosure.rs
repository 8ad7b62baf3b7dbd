//! The states that a motion passes during a step, before its Taylor polynomial is computed.
//!
//! Picard-Lindelöf: a box B with `start + [0, h] f(B)` inside B holds every solution up to h (Lohner 1987; Nedialkov, Jackson and Corliss,
//! *Applied Mathematics and Computation* 105, 1999). Here each component is bounded by a scalar differential inequality, which is
//! sharper: beyond an end of its start a component moves no faster than between the two.

use super::vector_field::{FORCE, POSITION, StateBox, VELOCITY, VectorField};
use crate::numeric::{Interval, Real};

/// Attempts before the step is called too long.
const ATTEMPTS: usize = 6;
/// Room that is added to position, velocity and force after a failed attempt: the force moves the velocity, and that the position.
const INFLATION: [f64; 3] = [0.4, 0.15, 0.05];

/// States that contain every solution for `h`, given the rate of each component.
pub(super) fn enclose(start: &StateBox, h: Interval, rate: impl Fn(usize, &StateBox) -> Interval) -> Option<StateBox> {
    let h = Interval::point(h.upper());
    let picard = |guess: &StateBox| -> Option<StateBox> {
        let mut next = *guess;
        for component in [FORCE, VELOCITY, POSITION] {
            let (own, side) = (start[component], guess[component]);
            let mut rate_between = |from: f64, to: f64| {
                next[component] = Interval::new(from, to)?;
                Some(rate(component, &next))
            };
            // y(t) <= max y_0 + t max rate, the rate over y >= max y_0 alone.
            let up = rate_between(own.upper(), side.upper())?.upper().max(0.0);
            let down = rate_between(side.lower(), own.lower())?.lower().min(0.0);
            next[component] = (own + h * Interval::point(up)).hull(own + h * Interval::point(down));
        }
        Some(next)
    };
    let mut guess = picard(start)?;
    for _ in 0..ATTEMPTS {
        let next = picard(&guess)?;
        if next.iter().zip(&guess).all(|(next, guess)| next.is_subset_of(*guess)) {
            return Some(next);
        }
        if !next.iter().all(|value| value.is_bounded()) {
            return None;
        }
        for ((guess, next), room) in guess.iter_mut().zip(next).zip(INFLATION) {
            if !next.is_subset_of(*guess) {
                let hull = guess.hull(next);
                *guess = hull.inflate(room * hull.width() + f64::MIN_POSITIVE);
            }
        }
    }
    None
}

impl VectorField {
    /// States that contain every motion for `h`.
    pub(super) fn passed(&self, start: &StateBox, u: Interval, h: Interval) -> Option<StateBox> {
        enclose(start, h, |component, state| self.rate_of(component, state, u))
    }
}
