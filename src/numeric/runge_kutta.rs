//! Step-by-step integration of `x' = rate(x)`.

/// A step `h` of the classical method of Runge and Kutta, whose error is of order `h^5`.
pub(crate) fn runge_kutta<const N: usize>(state: [f64; N], h: f64, rate: impl Fn([f64; N]) -> [f64; N]) -> [f64; N] {
    let along = |h: f64, rate: [f64; N]| core::array::from_fn(|k| state[k] + h * rate[k]);
    let first = rate(state);
    let second = rate(along(0.5 * h, first));
    let third = rate(along(0.5 * h, second));
    let fourth = rate(along(h, third));
    core::array::from_fn(|k| state[k] + h / 6.0 * (first[k] + 2.0 * second[k] + 2.0 * third[k] + fourth[k]))
}
