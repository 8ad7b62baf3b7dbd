//! The motion of one point by itself.

use super::super::bend::Carried;
use super::super::field::{Field, Triple, VELOCITY};
use super::super::step::{Fields, Pair};
use super::{FINE, MOST_SHORTENED, MOST_STEPS, Pace, shorten, stride};
use crate::numeric::Interval;

/// Advances the motion of one point, of which nothing but the end is wanted; what it passes besides.
pub(super) fn advance_point(field: &Field, start: Triple, u: Interval, h: Interval) -> Option<[Triple; 2]> {
    let (mut state, mut passed, mut left) = (start, start, h);
    let fields = Fields { over: *field, at: *field };
    let pace = Pace { manner: FINE, longest_s: f64::INFINITY, unsure: f64::INFINITY };
    for _ in 0..MOST_STEPS {
        if left.upper() <= 0.0 {
            return Some([state, passed]);
        }
        let mut part = left;
        let at = Pair { over: state, at: state };
        // A command that changes on the way is known by its range alone.
        let step = if u.is_point() { stride(&fields, &at, u, &mut part, pace, &Carried::NOTHING)? } else { None };
        let [end, within] = match step {
            Some(step) => [step.at_all(&[part]).pop()?.at?, step.within],
            None => {
                let (done, length) = crude_point(field, &state, u, part)?;
                part = length;
                done
            }
        };
        state = end;
        for (passed, within) in passed.iter_mut().zip(within) {
            *passed = passed.hull(within);
        }
        left = if part == left { Interval::ZERO } else { left - part };
    }
    None
}

/// One step of the point by the rates' ranges, and how long it is.
fn crude_point(field: &Field, state: &Triple, u: Interval, mut part: Interval) -> Option<([Triple; 2], Interval)> {
    shorten(&mut part, FINE.length / field.fastest(state[VELOCITY]));
    for _ in 0..MOST_SHORTENED {
        if let Ok(done) = field.pass_crude(state, u, part) {
            return Some((done, part));
        }
        part = Interval::point(0.5 * part.lower());
    }
    None
}
