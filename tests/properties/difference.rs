//! Derivatives by differences, as an oracle of exact ones.

/// The derivative at zero from values around it, or none where the function is not smooth enough on the way to tell:
/// halving the step changes it by more than `tolerance`.
pub(crate) fn five_point(step: f64, tolerance: f64, function: impl Fn(f64) -> f64) -> Option<f64> {
    let odd = |h: f64| function(h) - function(-h);
    let derivative = |h: f64| (8.0 * odd(h) - odd(2.0 * h)) / (12.0 * h);
    let fine = derivative(0.5 * step);
    ((derivative(step) - fine).abs() <= tolerance).then_some(fine)
}
