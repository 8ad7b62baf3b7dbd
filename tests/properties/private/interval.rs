//! What the public functions hide: constants, remainders of series, and guesses that are wrong.

#[path = "../oracle.rs"]
mod oracle;

use oracle::{Bracket, Down, Up, at, bracket};

use super::circular::{COSINE, HALF_PI_PARTS, HALF_PI_REST, HALF_TURN, SINE, angle, complement};
use super::exponential::{EXP, LN_2_HIGH, LN_2_LOW, REDUCED_LIMIT, ln_1p_reduced};
use super::series::Series;
use super::*;
use crate::numeric::Real;

#[track_caller]
fn assert_encloses(enclosure: Interval, exact: &Bracket) {
    assert!(exact.lies_within(enclosure.bounds()), "{exact:?} is not in {enclosure}");
}

fn factorial(n: u32) -> f64 {
    (1..=n).map(f64::from).product()
}

#[test]
fn constants_are_enclosed() {
    let one = 1.0;
    assert_encloses(Interval::PI, &bracket!(one: at(4.0) * one.atan()));
    assert_encloses(Interval::INVERSE_PI, &bracket!(one: at(0.25) / one.atan()));
    assert_encloses(HALF_TURN, &bracket!(one: at(2.0) * one.atan()));
    let [a, b, c] = HALF_PI_PARTS;
    assert_encloses(HALF_PI_REST, &bracket!(one, a, b, c: at(2.0) * one.atan() - a - b - c));
    let two = 2.0;
    assert_encloses(LN_2_LOW, &bracket!(two: two.ln() - at(LN_2_HIGH)));
    for (factor, count) in HALF_PI_PARTS.map(|part| (part, 1_048_575.0)).into_iter().chain([(LN_2_HIGH, 1075.0)]) {
        let (product, rounded): (Down, Down) = (at(factor) * at(count), at(factor * count));
        assert_eq!(product, rounded, "{factor} times a count of half turns or halvings is exact");
    }
}

/// Heads: the first two coefficients, from `1/n!` on.
#[test]
fn coefficients_are_enclosed() {
    for (head, divisors) in [(EXP.head, [2.0, 6.0]), (SINE.head, [-6.0, 120.0]), (COSINE.head, [-2.0, 24.0])] {
        for (coefficient, divisor) in head.into_iter().zip(divisors) {
            assert_encloses(coefficient, &bracket!(divisor: at(1.0) / divisor));
        }
    }
}

/// `(value - sum of c_k r^(first + k step)) / r^(first + n step)`.
macro_rules! remainder {
    ($r:ident, $value:expr, $first:expr, $step:expr, $divisors:expr) => {
        bracket!($r: {
            let (mut rest, mut power) = ($value, $r.powi($first.into()));
            for divisor in $divisors {
                rest -= power.clone() / at(divisor);
                power *= $r.powi($step.into());
            }
            rest / power
        })
    };
}

/// On a point, and on an interval that begins there.
#[track_caller]
fn assert_tail<const N: usize>(series: &Series<N>, x: f64, exact: &Bracket) {
    assert_encloses(series.tail_at(Interval::point(x)), exact);
    assert_encloses(series.tail_at(Interval { lo: x, hi: x + 0.01 }), exact);
}

#[test]
fn tails_of_series_are_enclosed() {
    for i in 1..=64_u32 {
        for sign in [1.0, -1.0] {
            let share = sign * f64::from(i) / 64.0;
            let x = share * (REDUCED_LIMIT - 0.01);
            assert_tail(&EXP, x, &remainder!(x, x.exp(), 0, 1, (0..4).map(factorial)));
            // Its square is exact.
            let r = 1.125 * share;
            assert_tail(&SINE, r * r, &remainder!(r, r.sin(), 1, 2, [1.0, -6.0, 120.0]));
            assert_tail(&COSINE, r * r, &remainder!(r, r.cos(), 0, 2, [1.0, -2.0, 24.0]));
        }
    }
}

/// The exact sum of the products of doubles.
fn exact_dot(pairs: &[(f64, f64)]) -> Bracket {
    Bracket {
        below: pairs.iter().fold(at(0.0), |sum, &(a, b)| {
            let (a, b): (Down, Down) = (at(a), at(b));
            sum + a * b
        }),
        above: pairs.iter().fold(at(0.0), |sum, &(a, b)| {
            let (a, b): (Up, Up) = (at(a), at(b));
            sum + a * b
        }),
    }
}

/// Products a little above one, or below minus one, that are rounded by nearly half a step, all down or all up; they
/// cancel in pairs, so that the sums do not show how large they were.
#[test]
fn roundings_of_products_count() {
    let products = (0..20_000_u32).map(|i| (1.0 + f64::from(i) * 1.23e-7, 1.0 + f64::from(i % 977) * 4.7e-5));
    for side in [1.0, -1.0] {
        let rounded = |(a, b): &(f64, f64)| side * a.mul_add(*b, -(a * b)) > 0.45 * f64::EPSILON;
        let against = |(a, b): &(f64, f64)| side * a.mul_add(*b, -(a * b)) < -0.45 * f64::EPSILON;
        let positive = products.clone().filter(rounded);
        let negative = products.clone().filter(against).map(|(a, b)| (-a, b));
        let pairs: Vec<_> = positive.zip(negative).take(10).flat_map(|(plus, minus)| [plus, minus]).collect();
        assert_eq!(pairs.len(), 20);
        let points = pairs.iter().map(|&(a, b)| (Interval::point(a), Interval::point(b)));
        assert_encloses(Interval::dot(points), &exact_dot(&pairs));
    }
}

/// Sums of exact doubles, with terms that cancel, vanish, or leave the range of the quick way.
#[test]
fn sums_of_products_are_enclosed() {
    let numbers = |seed: u32| (0..15).map(move |i| f64::from((seed * 7919 + i * 104_729) % 2003) / 1000.3 - 1.0);
    for seed in 1..200 {
        for scale in [1.0, 1e-140, 1e-200, 1e140, 1e160, 0.0] {
            let pairs: Vec<_> = numbers(seed).zip(numbers(seed + 1000)).map(|(a, b)| (a * scale, b * scale)).collect();
            let exact = exact_dot(&pairs);
            let points = pairs.iter().map(|&(a, b)| (Interval::point(a), Interval::point(b)));
            let found = Interval::dot(points.clone());
            assert_encloses(found, &exact);
            let size: f64 = pairs.iter().map(|(a, b)| (a * b).abs()).sum();
            assert!(found.width() <= 40.0 * f64::EPSILON * size + 1e-320, "{found}");
            // Over intervals, every choice of elements.
            let wide = points.map(|(a, b)| (a.hull(Interval::point(a.lo + 0.1 * scale)), b.hull(Interval::ZERO)));
            assert_encloses(Interval::dot(wide), &exact);
        }
    }
    // A product that underflows beside a large one that may be zero.
    let lost = [(Interval { lo: 0.0, hi: 1.0 }, Interval { lo: 0.0, hi: 1e-200 }), (1e-162.into(), (-1e-163).into())];
    assert_encloses(Interval::dot(lost.into_iter()), &exact_dot(&[(0.0, 0.0), (1e-162, -1e-163)]));
    assert_encloses(
        -Interval::dot(lost.into_iter().map(|(a, b)| (-a, b))),
        &exact_dot(&[(0.0, 0.0), (1e-162, -1e-163)]),
    );
    let unknown = [(Interval::ENTIRE, Interval::ZERO), (Interval::ONE, Interval::ONE)];
    assert!(Interval::dot(unknown.into_iter()).is_entire());
    assert_eq!(Interval::dot(core::iter::empty()), Interval::ZERO);
}

/// What a bad library could return for `y`.
fn guesses(y: f64) -> impl Iterator<Item = f64> {
    let relative =
        [0.0, 1e-15, -1e-15, 1e-9, -1e-9, 1e-4, -1e-4, 0.03, -0.03, 0.5, -0.5].map(|error| y * (1.0 + error));
    // The last two miss by more than a turn, and what they give still meets the range of the function.
    let absolute = [1e-9, -1e-9, 1e-3, -1e-3, 0.3, -0.3, 2.0, -2.0, 7.65, -7.65].map(|error| y + error);
    let absurd = [0.0, -y, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, f64::MIN];
    relative.into_iter().chain(absolute).chain(absurd)
}

#[test]
fn a_wrong_guess_does_not_break_the_enclosure() {
    for i in -100..=100 {
        let x = f64::from(i) / 100.0;
        let thin = Interval::point(x);
        let upper_half_plane = Interval { lo: 0.0, hi: Interval::PI.hi };
        let (asin, acos, atan) = (bracket!(x: x.asin()), bracket!(x: x.acos()), bracket!(x: x.atan()));
        // A narrow interval holds the value at each of its elements.
        let narrow = thin.hull(Interval::point((x + 5e-13).min(1.0)));
        for guess in guesses(x.asin()) {
            assert_encloses(angle(narrow, complement(narrow), guess, HALF_TURN), &asin);
            assert_encloses(angle(thin, complement(thin), guess, HALF_TURN), &asin);
        }
        for guess in guesses(x.acos()) {
            assert_encloses(angle(complement(thin), thin, guess, upper_half_plane), &acos);
        }
        for guess in guesses(x.atan()) {
            assert_encloses(angle(thin, Interval::ONE, guess, HALF_TURN), &atan);
        }
        if (-0.3..=0.42).contains(&x) {
            let ln_1p = bracket!(x: x.ln_1p());
            for guess in guesses(x.ln_1p()) {
                assert_encloses(ln_1p_reduced(thin, guess), &ln_1p);
            }
        }
    }
}
