//! Bessel functions against their power series in as many digits as the cancellation of their terms takes.

use proptest::prelude::*;
use selfosc::numeric::special::Special;
use selfosc::numeric::{Gradient, Interval, Jet};

use crate::fourier_oracle::Big;
use crate::tolerance;

/// `[f_0(x), f_1(x)]` with `f_n = sum (sign x^2/4)^k (x/2)^n/(k! (n + k)!)`: J for a negative sign, I for a positive one.
fn series(x: f64, sign: f64) -> [Big; 2] {
    // The largest term is about exp(x), which is below 2^(1.5 x).
    let bits = 200 + (4.5 * x) as usize;
    let number = |value: f64| Big::try_from(value).unwrap().with_precision(bits).value();
    let square = number(sign) * number(x) * number(x) / number(4.0);
    let smallest = number(2.0).powi((-(bits as i64)).into());
    let (mut term, mut sums, mut k) = (number(1.0), [number(1.0), number(1.0)], 0.0);
    while k < x || term.clone() * term.clone() > smallest.clone() * smallest.clone() {
        k += 1.0;
        term = term * &square / number(k * k);
        sums[0] += &term;
        sums[1] += &term / number(k + 1.0);
    }
    let [zeroth, first] = sums;
    [zeroth, first * number(x) / number(2.0)]
}

fn scaled(x: f64) -> [Big; 2] {
    let bits = 200 + (4.5 * x) as usize;
    let factor = Big::try_from(-x).unwrap().with_precision(bits).value().exp();
    series(x, 1.0).map(|value| value * &factor)
}

fn contained(enclosure: Interval, exact: &Big, x: f64) {
    let bound = |value: f64| Big::try_from(value).unwrap();
    assert!(
        bound(enclosure.lower()) <= *exact && *exact <= bound(enclosure.upper()),
        "{exact} not in {enclosure} at {x}"
    );
}

fn check(x: f64) {
    let at = Interval::point(x);
    for (enclosed, exact) in at.bessel_j().iter().zip(series(x, -1.0)) {
        contained(*enclosed, &exact, x);
        assert!(enclosed.width() < tolerance::BESSEL_WIDTH, "{enclosed} at {x} is {:e} wide", enclosed.width());
    }
    let floats = x.bessel_i_scaled();
    for ((enclosed, exact), float) in at.bessel_i_scaled().iter().zip(scaled(x)).zip(floats) {
        contained(*enclosed, &exact, x);
        let width = enclosed.width();
        assert!(width <= tolerance::BESSEL_WIDTH * enclosed.upper(), "{enclosed} at {x} is {width:e} wide");
        assert!((float - enclosed.midpoint()).abs() <= tolerance::BESSEL_FLOAT * float, "{float:e} at {x}: {enclosed}");
    }
}

/// Where one way of computing takes over from another, and where it works hardest.
#[test]
fn bessel_functions_at_the_seams() {
    for x in [0.0, 1e-300, 1e-8, 0.5, 2.0, 4.0, 13.99, 14.0, 14.01, 20.0, 23.99, 24.0, 24.01, 47.9, 100.0, 250.0] {
        check(x);
    }
}

/// The parts of a wide argument's enclosure are those of its points.
#[test]
fn wide_arguments_contain_their_points() {
    for (lower, upper) in [(0.0, 1.0), (3.0, 5.0), (13.0, 15.0), (14.5, 16.0), (0.0, 60.0), (20.0, 30.0), (23.0, 80.0)]
    {
        let at = Interval::new(lower, upper).unwrap();
        let [j, i] = [at.bessel_j(), at.bessel_i_scaled()];
        for k in 0..=20 {
            let x = lower + (upper - lower) * f64::from(k) / 20.0;
            for (enclosed, exact) in j.into_iter().chain(i).zip(series(x, -1.0).into_iter().chain(scaled(x))) {
                contained(enclosed, &exact, x);
            }
        }
        assert!(j.iter().all(|part| part.is_subset_of(Interval::UNIT)));
    }
    for outside in [Interval::new(-1.0, 1.0).unwrap(), Interval::ENTIRE, Interval::new(1.0, f64::INFINITY).unwrap()] {
        assert!(outside.bessel_j().iter().chain(&outside.bessel_i_scaled()).all(|part| part.is_entire()));
    }
}

/// Coefficient k of a jet against the k-th derivative by recurrences that the code does not use:
/// `2 J_0' = J_(-1) - J_1`, so `J_0'' = (J_2 - J_0)/2`, and `J_2 = 2 J_1/x - J_0`; `I_0'' = (I_2 + I_0)/2`, `I_2 = I_0 - 2 I_1/x`.
#[test]
fn jets_hold_the_derivatives() {
    let two = Interval::point(2.0);
    for x in [0.3, 2.0, 7.5, 15.0, 30.0] {
        let at = Interval::point(x);
        let [j0, j1] = at.bessel_j();
        let [jet, _] = Jet::<4>::variable(at).bessel_j();
        let second = (two * j1 / at - j0 - j0) / two;
        assert!(jet.coefficients()[1].intersection(-j1).is_some());
        assert!((jet.coefficients()[2] * two).intersection(second).is_some(), "J at {x}");
        assert!((jet.coefficients()[2] * two - second).width() < 1e-10);

        // Of exp(-x) I_0: I_0'' - 2 I_0' + I_0, times exp(-x).
        let [i0, i1] = at.bessel_i_scaled();
        let [jet, _] = Jet::<4>::variable(at).bessel_i_scaled();
        let second = (i0 - two * i1 / at + i0) / two - two * i1 + i0;
        assert!((jet.coefficients()[2] * two).intersection(second).is_some(), "I at {x}");
        assert!((jet.coefficients()[2] * two - second).width() < 1e-10);
    }
}

proptest! {
    #![proptest_config(crate::sampling::config(60))]

    #[test]
    fn bessel_functions_are_enclosed(x in prop_oneof![0.0..20.0, 20.0..250.0]) {
        check(x);
    }

    /// Derivatives carried by dual numbers lie in the jet's coefficient.
    #[test]
    fn slopes_are_the_jets(x in 0.1..60.0) {
        let [at] = Gradient::variables([x]);
        let jet = Jet::<2>::variable(Interval::point(x));
        let floats = at.bessel_j().into_iter().chain(at.bessel_i_scaled());
        for (float, jet) in floats.zip(jet.bessel_j().into_iter().chain(jet.bessel_i_scaled())) {
            let [slope] = float.slopes();
            let exact = jet.coefficients()[1];
            prop_assert!((Interval::point(slope) - exact).magnitude() < 1e-11, "{slope} {exact} at {x}");
        }
    }
}
