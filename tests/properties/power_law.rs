//! Power laws in the arithmetic of intervals and jets.

use proptest::prelude::*;
use rayon::prelude::*;
use selfosc::describing::{ClosedForm, DescribingFunction, certified};
use selfosc::nonlinearity::{Power, Sinusoid};
use selfosc::numeric::{Interval, Jet, Real};
use selfosc::proof::rigorous_quadrature::CellJet;

use crate::fourier_oracle::{big, definition, describing_function};
use crate::tolerance;

/// With those on either side of every case distinction of the code.
const EXPONENTS: [f64; 22] = [
    0.0, 1e-3, 0.25, 0.479, 0.5, 0.519, 0.521, 1.0, 1.5, 1.501, 1.7, 2.0, 2.499, 2.5, 3.0, 4.3, 5.0, 6.5, 7.9, 8.0,
    8.1, 12.5,
];
const RATIOS: [f64; 18] = [
    0.0,
    1e-9,
    0.2,
    0.5,
    0.699,
    0.701,
    0.9,
    0.99,
    1.0 - 1e-9,
    1.0,
    1.0 + 1e-9,
    1.01,
    1.2,
    1.349,
    1.351,
    2.0,
    3.0,
    40.0,
];

fn enclosed(exponent: f64, bias: Interval, amplitude: Interval) -> DescribingFunction<Interval> {
    let power = Power::new(Interval::ONE, Interval::point(exponent)).unwrap();
    power.describing_function(&Sinusoid::new(bias, amplitude).unwrap()).unwrap()
}

fn at(exponent: f64, bias: f64, amplitude: f64) -> [Interval; 2] {
    let df = enclosed(exponent, Interval::point(bias), Interval::point(amplitude));
    assert_eq!(df.q, Interval::ZERO);
    [df.f0, df.p]
}

/// Of an output of order one.
fn width(exponent: f64, [f0, p]: [Interval; 2], bias: f64, amplitude: f64) -> f64 {
    let largest = (bias.abs() + amplitude).powf(exponent);
    (f0.width() / largest).max(p.width() * amplitude / largest)
}

/// `None` for a root so steep at zero that the quadrature gives up.
fn quadrature(exponent: f64, bias: f64, amplitude: f64) -> Option<[Interval; 2]> {
    let number = CellJet::from_f64;
    let power = Power::new(number(1.0), number(exponent)).unwrap();
    let found = certified(&power, &Sinusoid::new(number(bias), number(amplitude)).unwrap());
    let found = if exponent < 0.4 { found.ok()? } else { found.unwrap() };
    Some([found.enclosure.f0, found.enclosure.p])
}

#[test]
fn enclosures_contain_the_oracle_and_are_narrow() {
    let cases: Vec<(f64, f64)> = EXPONENTS.into_iter().flat_map(|p| RATIOS.map(|u| (p, u))).collect();
    cases.into_par_iter().enumerate().for_each(|(place, (exponent, u))| {
        let amplitude = 1.25;
        let bias = u * amplitude;
        let found = at(exponent, bias, amplitude);
        assert!(width(exponent, found, bias, amplitude) < tolerance::CERTIFIED_WIDTH, "{exponent} {u}: {found:?}");
        // The oracle takes its time: every third case.
        if place % 3 == 0 {
            let (exact_bias, exact_amplitude) = (big(bias), big(amplitude));
            let law = definition("power", &[1.0, exponent], &exact_bias, &exact_amplitude);
            let exact = describing_function(&law, &exact_bias, &exact_amplitude);
            for (part, exact) in found.into_iter().zip(exact) {
                let slack = big(tolerance::POWER_ORACLE * part.magnitude().max(1e-3));
                let inside = big(part.lower()) - &slack <= exact && exact <= big(part.upper()) + slack;
                assert!(inside, "exponent {exponent}, ratio {u}: {exact} not in {part}");
            }
        }
    });
}

/// The gain of a small amplitude is a slope: a small part of the output, and yet as accurate as the output.
#[test]
fn small_amplitudes_have_accurate_gains() {
    for exponent in [0.25, 0.5, 1.0, 1.7, 2.0, 3.0, 5.333997326758241, 6.0, 8.1] {
        for (bias, amplitude) in [(-9.630215489445458, 4.5552460014735084e-2), (3.0, 1e-4), (1.0, 0.2), (0.5, 1e-12)] {
            let [f0, p] = at(exponent, bias, amplitude);
            let power = Power::new(1.0, exponent).unwrap();
            let df = power.describing_function(&Sinusoid::new(bias, amplitude).unwrap()).unwrap();
            for (enclosed, floating) in [(f0, df.f0), (p, df.p)] {
                let size = enclosed.magnitude();
                assert!(enclosed.width() < tolerance::SUM * size, "{exponent} {bias} {amplitude}: {enclosed}");
                let away = (enclosed.lower() - floating).max(floating - enclosed.upper());
                assert!(
                    away <= 4.0 * tolerance::ROUNDING * size,
                    "{exponent} {bias} {amplitude}: {floating} {enclosed}"
                );
            }
        }
    }
}

#[test]
fn enclosures_meet_the_quadrature() {
    EXPONENTS.into_par_iter().for_each(|exponent| {
        for bias in [0.0, 0.2, -0.2, 0.6, 0.7, 0.95, 1.0, 1.05, -1.05, 1.3, 1.4, 2.5] {
            let Some(integral) = quadrature(exponent, bias, 1.0) else { continue };
            for (closed, integral) in at(exponent, bias, 1.0).into_iter().zip(integral) {
                assert!(closed.intersection(integral).is_some(), "{exponent} {bias}: {closed} not near {integral}");
            }
        }
    });
}

proptest! {
    #![proptest_config(crate::sampling::config(256))]

    #[test]
    fn any_exponent_meets_the_quadrature(exponent in 0.0..9.0, bias in -3.0..3.0, amplitude in 0.3..2.0) {
        let closed = at(exponent, bias, amplitude);
        prop_assert!(width(exponent, closed, bias, amplitude) < tolerance::CERTIFIED_WIDTH, "{closed:?}");
        for (closed, integral) in closed.into_iter().zip(quadrature(exponent, bias, amplitude).unwrap_or(closed)) {
            prop_assert!(closed.intersection(integral).is_some(), "{closed} {integral}");
        }
    }

    /// Over a box lies what lies at its points.
    #[test]
    fn boxes_contain_their_points(
        exponent in 0.0..9.0, bias in -2.0..2.0, amplitude in 0.5..2.0,
        widths in (-16.0..0.0, -16.0..0.0), place in (0.0..1.0, 0.0..1.0),
    ) {
        let side = |from: f64, exponent: f64| Interval::new(from, from + 10f64.powf(exponent)).unwrap();
        let (biases, amplitudes) = (side(bias, widths.0), side(amplitude, widths.1));
        let over = enclosed(exponent, biases, amplitudes);
        let inside = |side: Interval, share: f64| (side.lower() + share * (side.upper() - side.lower())).min(side.upper());
        let [f0, p] = at(exponent, inside(biases, place.0), inside(amplitudes, place.1));
        prop_assert!(over.f0.intersection(f0).is_some() && over.p.intersection(p).is_some(), "{over:?} {f0} {p}");
    }

    /// The derivatives over a cell contain those at its points, and their Taylor polynomial leads from one end to the other.
    #[test]
    fn jets_lead_from_value_to_value(exponent in 0.0..9.0, from in -2.5..2.5f64, length in 1e-4..0.01f64) {
        let to: f64 = from + length;
        prop_assume!((from.abs() - 1.0).abs() > 0.1 && (to.abs() - 1.0).abs() > 0.1 && (from.abs() < 1.0) == (to.abs() < 1.0));
        let cell = Interval::new(from, to).unwrap();
        let (start, whole) = (moments(exponent, Interval::point(from)), moments(exponent, cell));
        for ((start, whole), end) in start.into_iter().zip(whole).zip(at(exponent, to, 1.0)) {
            let step = Interval::point(to) - Interval::point(from);
            let taylor = start.coefficients()[..ORDER - 1].iter().rev();
            let reached = taylor.fold(whole.coefficients()[ORDER - 1], |sum, &c| sum * step + c);
            prop_assert!(reached.intersection(end).is_some(), "{reached} {end}");
            let narrow = tolerance::TAYLOR_STEP * end.magnitude().max(1.0);
            prop_assert!(length > 0.005 || reached.width() < narrow, "{reached}");
            for (over, at) in whole.coefficients().iter().zip(start.coefficients()) {
                prop_assert!(over.intersection(*at).is_some(), "{over} {at}");
            }
        }
    }
}

const ORDER: usize = 12;

/// Jets by the bias, at unit amplitude.
fn moments(exponent: f64, bias: Interval) -> [Jet<ORDER>; 2] {
    let power = Power::new(Jet::one(), Jet::from_f64(exponent)).unwrap();
    let df = power.describing_function(&Sinusoid::new(Jet::variable(bias), Jet::one()).unwrap()).unwrap();
    [df.f0, df.p]
}

/// By the amplitude as well as by the bias: Euler's relation of a function of degree p, `X dF/dX + B dF/dB = p F`.
#[test]
fn jets_by_the_amplitude_are_homogeneous() {
    for exponent in [0.0, 0.5, 1.5, 2.0, 3.3, 8.5] {
        for bias in [-1.7, -0.4, 0.0, 0.3, 0.8, 1.5, 4.0] {
            let number = Jet::<3>::from_f64;
            let power = Power::new(number(1.0), number(exponent)).unwrap();
            let amplitude = Jet::variable(Interval::point(1.25));
            let by_amplitude = power.describing_function(&Sinusoid::new(number(bias), amplitude).unwrap()).unwrap();
            let by_bias =
                power.describing_function(&Sinusoid::new(Jet::variable(Interval::point(bias)), number(1.25)).unwrap());
            let sides = |x: Jet<3>, b: Jet<3>, degree: f64| {
                let grown = Interval::point(1.25) * x.coefficients()[1] + Interval::point(bias) * b.coefficients()[1];
                (grown, Interval::point(degree) * x.value())
            };
            let by_bias = by_bias.unwrap();
            for (left, right) in
                [sides(by_amplitude.f0, by_bias.f0, exponent), sides(by_amplitude.p, by_bias.p, exponent - 1.0)]
            {
                assert!(left.intersection(right).is_some(), "{exponent} {bias}: {left} {right}");
                assert!(
                    left.width() < tolerance::CERTIFIED_WIDTH * left.magnitude().max(1.0),
                    "{exponent} {bias}: {left}"
                );
            }
        }
    }
}

/// Where the sweep ends at zero no derivative is claimed, nor any value for an exponent that is not one number.
#[test]
fn what_is_not_known_is_not_claimed() {
    for bias in [Interval::ONE, Interval::new(0.9, 1.1).unwrap(), -Interval::ONE] {
        let [f0, p] = moments(0.3, bias);
        assert!(f0.value().is_bounded() && p.value().is_bounded() && !f0.is_bounded() && !p.is_bounded());
    }
    let vague = Power::new(Interval::ONE, Interval::new(1.7, 1.8).unwrap()).unwrap();
    let df = vague.describing_function(&Sinusoid::new(Interval::ONE, Interval::ONE).unwrap()).unwrap();
    assert!(df.f0.is_entire() && df.p.is_entire());
}

/// The derivative by the bias at the end of the sweep, where the series' own is of the form zero times infinity.
#[test]
fn quadratic_drag_is_smooth_where_the_sweep_ends_at_zero() {
    use selfosc::numeric::Gradient;
    let drag = Power::new(Gradient::<f64, 1>::constant(1.0), Gradient::<f64, 1>::constant(2.0)).unwrap();
    let df = drag
        .describing_function(&Sinusoid::new(Gradient::new(1.0, [1.0]), Gradient::<f64, 1>::constant(1.0)).unwrap())
        .unwrap();
    // F_0 = B^2 + X^2/2 and P = 2 B from there on.
    assert!(
        (df.f0.slopes()[0] - 2.0).abs() < tolerance::ROUNDING * 8.0
            && (df.p.slopes()[0] - 2.0).abs() < tolerance::ROUNDING * 8.0
    );
}
