//! Student's t distribution with a whole number of degrees of freedom.

use core::f64::consts::{FRAC_PI_2, PI};

use crate::numeric::increasing_root;

/// The t that a value exceeds in magnitude with probability 5 %.
///
/// With `t = sqrt(n) tan(a)` the probability below it in magnitude is a finite sum of powers of `cos a` (Abramowitz and
/// Stegun, eqs. 26.7.3-4); `a` is found by Newton's method.
pub(super) fn quantile_95(degrees_of_freedom: usize) -> f64 {
    let excess = |angle: f64| {
        let (probability, density) = within(angle, degrees_of_freedom);
        (probability - 0.95, density)
    };
    let n = degrees_of_freedom as f64;
    // Two standard deviations, as for many degrees of freedom; the bracket catches the rest.
    let angle = increasing_root(excess, 0.0, FRAC_PI_2, (2.0 / n.sqrt()).atan());
    angle.map_or(f64::NAN, |angle| n.sqrt() * angle.tan())
}

/// Probability that `|t| < sqrt(n) tan(angle)`, and its derivative.
fn within(angle: f64, n: usize) -> (f64, f64) {
    let (sine, cosine) = angle.sin_cos();
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
    // The first term left out, times n over the cosine, is the derivative.
    let density = term * n as f64 / cosine;
    if odd { (2.0 / PI * (angle + sine * sum), 2.0 / PI * density) } else { (sine * sum, density) }
}

#[cfg(test)]
mod tests {
    use super::quantile_95;

    /// Values of the published table (Abramowitz and Stegun, table 26.10), to its three decimals.
    #[test]
    fn published_quantiles() {
        for (n, expected) in
            [(1, 12.706), (2, 4.303), (3, 3.182), (10, 2.228), (35, 2.030), (120, 1.980), (100_000, 1.960)]
        {
            assert!((quantile_95(n) - expected).abs() < 5.01e-4, "{n}: {} for {expected}", quantile_95(n));
        }
    }
}
