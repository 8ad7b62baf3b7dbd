//! How large the gain of a loop can be at high frequencies.

use crate::control::Gains;
use crate::control::process::{LinearProcess, constants};
use crate::numeric::{Interval, Real};

/// A bound of `|L(s)|` for every `s` with `|s| >= omega` and `Re s >= 0`, where no pole of the closed loop comes from infinity
/// either, whatever degree is lost where a time constant reaches zero. With `u = 1/|s|`:
///
/// - `|1 + T s|^2 = 1 + 2 T Re s + T^2 |s|^2 >= (u^2 + T^2)/u^2`, hence at least 1 for a `T` that may be zero;
/// - `Re (alpha s + drag + memory/(memory_s s + 1)) >= drag + min(0, memory)`, hence
///   `|body| >= (drag + min(0, memory) - |stiffness| u)/u`; without inertia and of positive real parts, `|body| >= stiffness`;
/// - `|body| >= (alpha - (|drag| + |memory|) u - |stiffness| u^2)/u^2`.
pub fn loop_gain_beyond(process: &LinearProcess<Interval>, gains: &Gains<f64>, omega: f64) -> Option<Interval> {
    let LinearProcess { alpha, drag, stiffness, memory, lag_s, filter_s, zero_s, .. } = *process;
    let u = Interval::new(0.0, 1.0 / omega)?;
    let size = |part: Interval| Interval::point(part.magnitude());
    let least = |part: Interval| Interval::point(part.lower());
    let negative = Interval::point(memory.lower().min(0.0));
    let passive = alpha == Interval::ZERO && drag.lower() >= 0.0 && memory.lower() >= 0.0;
    let bodies = [
        (2, least(alpha) - (size(drag) + size(memory)) * u - size(stiffness) * u.square()),
        (1, least(drag) + negative - size(stiffness) * u),
        (0, if passive { least(stiffness) } else { Interval::ZERO }),
    ];
    let [proportional, integral, derivative, gain_filter_s] = constants::<Interval>(gains);
    let controller = proportional + integral * u;
    // The derivative without a filter, and a zero, grow with 1/u.
    let unfiltered = derivative.is_positive() && !gain_filter_s.is_positive();
    let controller = if unfiltered {
        controller * u + derivative
    } else if derivative.is_positive() {
        controller + derivative / (u.square() + gain_filter_s.square()).sqrt()
    } else {
        controller
    };
    let zero = if zero_s == Interval::ZERO { Interval::ONE } else { u + size(zero_s) };
    let lags = [lag_s, filter_s].map(least);
    let slow = lags.into_iter().filter(|time| time.is_positive());
    let numerator = slow.clone().fold(controller * zero, |sum, time| sum / (u.square() + time.square()).sqrt());
    let falls = slow.count();
    let rises = usize::from(unfiltered) + usize::from(zero_s != Interval::ZERO);
    let bounds = bodies.into_iter().filter_map(|(degree, body)| {
        let power = (0..(degree + falls).checked_sub(rises)?).fold(Interval::ONE, |product, _| product * u);
        body.is_positive().then(|| Interval::point((numerator * power / body).upper()))
    });
    bounds.min_by(|a, b| a.upper().total_cmp(&b.upper()))
}
