//! Tails of distributions.

use core::f64::consts::FRAC_2_SQRT_PI;

/// Probability that a chi-square variable exceeds a value, zero or more; with one degree of freedom or more.
#[allow(clippy::cast_precision_loss, reason = "a count of parameters or records")]
pub(super) fn chi_square_tail(value: f64, freedom: usize) -> f64 {
    // The upper incomplete gamma function at half the freedom, from that at a half or one upwards (Abramowitz and Stegun 26.4.4, 26.4.5).
    let (half, density) = (0.5 * value, libm::exp(-0.5 * value));
    let (mut order, mut tail, mut term) = if freedom.is_multiple_of(2) {
        (1.0, density, half * density)
    } else {
        (0.5, libm::erfc(half.sqrt()), FRAC_2_SQRT_PI * half.sqrt() * density)
    };
    while 2.0 * order < freedom as f64 {
        tail += term;
        order += 1.0;
        term *= half / order;
    }
    tail
}

#[cfg(test)]
mod tests {
    use super::chi_square_tail;

    /// Percentage points as tables have them (Abramowitz and Stegun, table 26.8).
    #[test]
    fn tails_are_those_of_tables() {
        for (freedom, probability, point) in [
            (1, 0.01, 6.634_90),
            (1, 0.0001, 15.1367),
            (2, 0.01, 9.210_34),
            (3, 0.5, 2.365_97),
            (4, 0.0001, 23.5127),
            (5, 0.05, 11.0705),
            (9, 0.001, 27.877),
            (20, 0.99, 8.260_40),
            (30, 0.01, 50.8922),
        ] {
            approx::assert_relative_eq!(chi_square_tail(point, freedom), probability, max_relative = 1e-4);
        }
        assert_eq!([1, 2, 7].map(|freedom| chi_square_tail(0.0, freedom)), [1.0; 3]);
    }
}
