use super::*;

/// The truncation error of a series cut too early lies within its remainder bound.
#[test]
fn rests_of_the_series_are_enclosed() {
    for x in [0.0, 0.25, 0.5, 1.7, 2.0, 7.3] {
        let fine = gamma_ratio(number(x), FAR);
        assert!(fine.width() < 1e-14 * fine.magnitude(), "{fine}");
        for far in [0.0, 1.0, 1.5, 2.5, 4.0] {
            let coarse = gamma_ratio(number(x), far);
            assert!(coarse.contains(fine.midpoint()), "{x}, from {far}: {fine} not in {coarse}");
        }
    }
    // Whole and half-whole arguments in closed form (DLMF 5.4.6).
    assert!(gamma_ratio(Interval::ZERO, FAR).intersection(Interval::PI.sqrt()).is_some());
    assert!(gamma_ratio(number(0.5), FAR).intersection(Interval::two() / Interval::PI.sqrt()).is_some());
}

/// By the sum of the first thousand terms and the Euler-Maclaurin formula.
#[test]
fn the_zeta_function_is_right() {
    for (zeta, s) in ZETA.into_iter().zip(2..) {
        let size = 1000_f64;
        let first: f64 = (1..1000).rev().map(|k| f64::from(k).powi(-s)).sum();
        let rest = size.powi(1 - s) * (1.0 / f64::from(s - 1) + 0.5 / size + f64::from(s) / (12.0 * size * size));
        assert!((first + rest - zeta).abs() < 2e-15, "{s}: {zeta}");
    }
}

/// The logarithm's series, far beyond where it serves, against the ratio itself.
#[test]
fn the_logarithm_of_the_ratio_is_enclosed() {
    for exponent in [0.3, 0.7, 0.75, 1.3, 1.7, 4.62, 6.31] {
        let law = of(exponent);
        let (order, delta) = PowerMoments::order_and_delta::<Interval>(exponent);
        let ratio = first_of_a(law.at_one.get(), number(exponent), order) / law.pairs.b.get::<Interval>();
        let (series, logarithm) = (log_ratio(delta, order), ratio.ln() / delta);
        assert!(series.intersection(logarithm).is_some(), "{exponent}: {series} is not {logarithm}");
        assert!(series.width() < 0.05, "{exponent}: {series}");
    }
}
