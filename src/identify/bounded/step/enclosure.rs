//! What a motion passes in a step, before it is known how.

use super::super::field::{FORCE, Field, POSITION, Term, Triple, VELOCITY};
use crate::numeric::{Interval, Real};

/// Attempts at an enclosure before the step is called too long.
const ATTEMPTS: usize = 6;

/// Values that no solution leaves within a duration of `h`: beyond an end of its start a component goes no faster than it does
/// between the two, whatever the others are.
pub(super) fn enclose(start: &Triple, h: Interval, rate: impl Fn(usize, &Triple) -> Interval) -> Option<Triple> {
    let long = Interval::point(h.upper());
    let reached = |guess: &Triple| -> Option<Triple> {
        let mut next = *guess;
        for component in [FORCE, VELOCITY, POSITION] {
            let (own, side) = (start[component], guess[component]);
            let mut fastest = |from: f64, to: f64| {
                next[component] = Interval::new(from, to)?;
                Some(rate(component, &next))
            };
            let up = fastest(own.upper(), side.upper())?.upper().max(0.0);
            let down = fastest(side.lower(), own.lower())?.lower().min(0.0);
            next[component] = (own + long * Interval::point(up)).hull(own + long * Interval::point(down));
        }
        Some(next)
    };
    let mut guess = reached(start)?;
    for _ in 0..ATTEMPTS {
        let next = reached(&guess)?;
        if next.iter().zip(&guess).all(|(next, guess)| next.is_subset_of(*guess)) {
            return Some(next);
        }
        if !next.iter().all(|value| value.is_bounded()) {
            return None;
        }
        // Force moves velocity, velocity position: each that was left needs more room than what moves it.
        for ((guess, next), room) in guess.iter_mut().zip(next).zip([0.4, 0.15, 0.05]) {
            if !next.is_subset_of(*guess) {
                let hull = guess.hull(next);
                *guess = hull.inflate(room * hull.width() + f64::MIN_POSITIVE);
            }
        }
    }
    None
}

impl Field {
    /// Values that no motion leaves within a duration of `h`.
    pub(super) fn passed(&self, start: &Triple, u: Interval, h: Interval) -> Option<Triple> {
        let damped = self.passed_damped(start, u, h);
        damped.or_else(|| enclose(start, h, |component, state| self.rate_of(component, state, u)))
    }

    /// The same at once where damping alone changes a velocity's rate: beyond an end of its start it goes no faster than there.
    pub(super) fn passed_damped(&self, start: &Triple, u: Interval, h: Interval) -> Option<Triple> {
        if self.has(Term::Stiffness) || self.has(Term::LagRate) {
            return None;
        }
        let [x, v, f] = *start;
        let long = Interval::point(h.upper());
        let rate = |end: f64| self.rate_of(VELOCITY, &[x, Interval::point(end), f], u);
        let reached = |from: Interval, up: f64, down: f64| {
            (from + long * Interval::point(up.max(0.0))).hull(from + long * Interval::point(down.min(0.0)))
        };
        let within = reached(v, rate(v.upper()).upper(), rate(v.lower()).lower());
        let damped = within.is_bounded() && self.damping(within, within).upper() <= 0.0;
        damped.then(|| [reached(x, within.upper(), within.lower()), within, f])
    }
}
