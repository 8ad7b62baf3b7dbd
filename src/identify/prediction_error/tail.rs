//! Tails of distributions.

/// Probability that a chi-square variable exceeds a value (Wilson and Hilferty's cube root).
pub(super) fn chi_square_tail(value: f64, freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * freedom);
    let z = ((value / freedom).cbrt() - 1.0 + spread) / spread.sqrt();
    0.5 * libm::erfc(z / core::f64::consts::SQRT_2)
}
