//! Safeguarded Newton method: the root of an increasing function inside a bracket.

use super::Scalar;

/// Steps allowed: bisection alone needs a step for each bit and each power of two of the bracket.
const MAX_STEPS: usize = 200;

/// The root of an increasing function between `lower`, where it is not positive, and `upper`, where it is not negative.
///
/// `function` gives value and slope. Newton's method, with bisection after a step out of the bracket or too small a
/// gain. The last step is always Newton's: a dual number carries the derivative of the root by the
/// implicit function theorem. `None` after 200 steps, which a NaN among the values causes.
///
/// ```
/// use selfosc::numeric::increasing_root;
/// let root = increasing_root(|x: f64| (x * x - 2.0, 2.0 * x), 0.0, 2.0, 1.0);
/// assert!((root.unwrap() - 2f64.sqrt()).abs() < 1e-15);
/// ```
pub fn increasing_root<S: Scalar>(
    mut function: impl FnMut(S) -> (S, S),
    mut lower: S,
    mut upper: S,
    guess: S,
) -> Option<S> {
    let tolerance = S::from_f64(4.0) * S::epsilon();
    let half = S::from_f64(0.5);
    let mut x = guess.max(lower).min(upper);
    let mut previous = upper - lower;
    for _ in 0..MAX_STEPS {
        let (value, slope) = function(x);
        let step = value / slope;
        let newton = x - step;
        if step.is_finite() && step.abs() <= tolerance * x.abs() {
            return Some(newton);
        }
        if value > S::zero() {
            upper = x;
        } else {
            lower = x;
        }
        if newton > lower && newton < upper && step.abs() <= half * previous {
            previous = step.abs();
            x = newton;
        } else {
            if upper - lower <= tolerance * upper.abs().max(lower.abs()) {
                return step.is_finite().then_some(newton.max(lower).min(upper));
            }
            previous = upper - lower;
            x = lower + half * previous;
        }
    }
    None
}
