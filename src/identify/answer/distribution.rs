//! Tails and quantiles of the normal, Student's and chi-square distributions.

use core::f64::consts::{FRAC_2_SQRT_PI, FRAC_PI_2, PI};

use crate::numeric::increasing_root;

/// Half the width of a 95 % interval of a normal distribution, in standard deviations.
pub(crate) const NORMAL_95: f64 = 1.959_963_984_540_054;

/// The same of Student's t distribution for any number of degrees of freedom (Cornish and Fisher's expansion, Abramowitz and Stegun 26.7.5).
pub(crate) fn student_quantile_95_expanded(freedom: f64) -> f64 {
    let (x, n) = (NORMAL_95, freedom.max(2.0));
    let x2 = x * x;
    x * (1.0 + (x2 + 1.0) / (4.0 * n) + ((5.0 * x2 + 16.0) * x2 + 3.0) / (96.0 * n * n))
}

/// Half the width of a 95 % interval of Student's t distribution with a whole number of degrees of freedom.
///
/// With `t = sqrt(n) tan(a)` the probability below it in magnitude is a finite sum of powers of `cos a` (Abramowitz and
/// Stegun, eqs. 26.7.3-4); `a` is found by Newton's method.
pub(crate) fn student_quantile_95(degrees_of_freedom: usize) -> f64 {
    let excess = |angle: f64| {
        let (probability, density) = within(angle, degrees_of_freedom);
        (probability - 0.95, density)
    };
    let n = degrees_of_freedom as f64;
    // Two standard deviations, as for many degrees of freedom; the bracket catches the rest.
    let angle = increasing_root(excess, 0.0, FRAC_PI_2, libm::atan(2.0 / n.sqrt()));
    angle.map_or(f64::NAN, |angle| n.sqrt() * libm::tan(angle))
}

/// Probability that `|t| < sqrt(n) tan(angle)`, and its derivative.
fn within(angle: f64, n: usize) -> (f64, f64) {
    let (sine, cosine) = libm::sincos(angle);
    let square = cosine * cosine;
    let odd = n % 2 == 1;
    // The terms of the sum run over the powers of the cosine below n, from the first or the zeroth in steps of two.
    let (mut power, mut term, mut sum) = if odd { (1, cosine, 0.0) } else { (0, 1.0, 0.0) };
    while power + 1 < n {
        sum += term;
        power += 2;
        let k = power as f64;
        term *= square * (k - 1.0) / k;
    }
    // The first omitted term, times n over the cosine, is the derivative.
    let density = term * n as f64 / cosine;
    if odd { (2.0 / PI * (angle + sine * sum), 2.0 / PI * density) } else { (sine * sum, density) }
}

/// Probability that a chi-square variable exceeds a value, zero or more; with 1 degree of freedom or more.
#[allow(clippy::cast_precision_loss, reason = "a count of parameters or records")]
pub(crate) fn chi_square_tail(value: f64, freedom: usize) -> f64 {
    // The upper incomplete gamma function at half the freedom, from that at 1/2 or 1 upwards (Abramowitz and Stegun 26.4.4, 26.4.5).
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
    use super::{chi_square_tail, student_quantile_95};

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

    /// Values of the published table (Abramowitz and Stegun, table 26.10), to its three decimals.
    #[test]
    fn quantiles_are_those_of_tables() {
        for (n, expected) in
            [(1, 12.706), (2, 4.303), (3, 3.182), (10, 2.228), (35, 2.030), (120, 1.980), (100_000, 1.960)]
        {
            assert!(
                (student_quantile_95(n) - expected).abs() < 5.01e-4,
                "{n}: {} for {expected}",
                student_quantile_95(n)
            );
        }
    }
}
