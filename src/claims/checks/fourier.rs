//! Fourier coefficients, describing functions, parity.

use core::f64::consts::PI;

use super::algebra::{exactly, number};
use super::band::as_coded;
use super::decomposition::{beyond, decomposition, scaling};
use super::family::{closed_is_integral, not_odd, odd_hysteretic, odd_nondecreasing, output_scale, sweep, unbiased};
use super::kernels::{BREAKPOINT, prove_kernel};
use super::tone::prove_sine_abs_sine;
use super::{Case, ClaimPart, Distortion, Draw, Verdict, claim, tolerance};
use crate::describing::{Boxed, ClosedForm, KernelForm, harmonic};
use crate::nonlinearity::{
    Branch, Characteristic, NonlinearityError, Polynomial, Power, RelayDeadZone, RelayHysteresis, Sinusoid,
};
use crate::numeric::Real;
use crate::numeric::quadrature::integrate;
use crate::proof::polynomial::Rational;
use std::array;

claim! {
    FOURIER_COEFFICIENTS = "fourier-coefficients" Definition
    "The mean and first harmonic of eq. 10 leave the least mean square of the output";
    printed Holds least_square(1.0);
    // Halved coefficients, as from 1/(2 pi) in place of 1/pi.
    false least_square(0.5);
    exactly square_completed on "whole" at &[[0.1, 0.2, 0.3, 1.0, 0.4, 0.5, 0.6]];
}

/// Parseval: the mean square of the remainder is that of the output less the share of each harmonic.
fn least_square(draw: &mut Draw, factor: f64) -> Option<Case> {
    let (characteristic, sweep) = (odd_nondecreasing(draw).ok()?, sweep(draw).ok()?);
    let ((mean, _), (sine, cosine)) =
        (harmonic(&*characteristic, &sweep, 0).ok()?, harmonic(&*characteristic, &sweep, 1).ok()?);
    let (sine, cosine) = (factor * sine, factor * cosine);
    let square = |remainder: &dyn Fn(f64, f64) -> f64| mean_over_sweep(&*characteristic, &sweep, remainder);
    let whole = square(&|_, y| y * y);
    let left = square(&|theta, y| (y - mean - sine * libm::sin(theta) - cosine * libm::cos(theta)).powi(2));
    let expected = whole - mean * mean - 0.5 * (sine * sine + cosine * cosine);
    Some(draw.equal(("mean_square_left", left), expected, whole + 1e-9, tolerance::QUADRATURE))
}

/// Mean of `of(theta, output)` over a period of the input.
fn mean_over_sweep(
    characteristic: &(impl Characteristic<Number = f64> + ?Sized),
    sweep: &Sinusoid<f64>,
    of: &dyn Fn(f64, f64) -> f64,
) -> f64 {
    let mut angles = vec![-0.5 * PI, 0.5 * PI];
    characteristic
        .kinks(sweep, &mut |x| angles.push(libm::asin(((x - sweep.bias()) / sweep.amplitude()).clamp(-1.0, 1.0))));
    angles.sort_by(f64::total_cmp);
    let half = |branch: Branch, theta: fn(f64) -> f64| {
        let integrand = |angle: f64| {
            let x = sweep.bias() + sweep.amplitude() * libm::sin(angle);
            of(theta(angle), characteristic.output(x, branch, sweep))
        };
        angles.windows(2).map(|piece| integrate(&mut &integrand, piece[0], piece[1], 1e-13, 1000).value).sum::<f64>()
    };
    (half(Branch::Rising, |angle| angle) + half(Branch::Falling, |angle| PI - angle)) / (2.0 * PI)
}

claim! {
    DESCRIBING_FUNCTION = "describing-function" Definition
    "P and Q are the first-harmonic coefficients over the amplitude, F_0 the mean: closed form and integral agree";
    printed Holds catalogue_is_integral(1.0);
    false catalogue_is_integral(1.000_01);
    proof prove_describing_function;
}

fn catalogue_is_integral(draw: &mut Draw, factor: f64) -> Option<Case> {
    let family = [odd_nondecreasing, odd_hysteretic, not_odd][draw.index("kind", 3)];
    let (characteristic, sweep) = (family(draw).ok()?, sweep(draw).ok()?);
    let scale = output_scale(&*characteristic, &sweep).max(1e-3);
    closed_is_integral(draw, &*characteristic, &sweep, scale, factor)
}

claim! {
    POLYNOMIAL = "polynomial" Identity
    "F_0 and P of a polynomial follow from its coefficients about the bias and the means of even powers of the sine";
    corrected polynomial_is_integral(1.0);
    false polynomial_is_integral(1.000_01);
    exactly monomials on "powers" at &[[0.5]];
}

fn polynomial_is_integral(draw: &mut Draw, factor: f64) -> Option<Case> {
    const NAMES: [&str; 5] = ["c0", "c1", "c2", "c3", "c4"];
    let polynomial = Polynomial::new(NAMES.map(|name| draw.uniform(name, -1.0, 1.0)));
    let (polynomial, sweep) = (polynomial.ok()?, sweep(draw).ok()?);
    closed_is_integral(draw, &polynomial, &sweep, output_scale(&polynomial, &sweep).max(1e-3), factor)
}

claim! {
    ODD_HARMONICS = "odd-harmonics" Theorem
    "An odd characteristic without memory under an unbiased sinusoid gives odd harmonics only";
    printed Holds even_vanish(odd_nondecreasing, unbiased);
    false even_vanish(not_odd, unbiased);
    needs "odd" even_vanish(not_odd, unbiased);
    needs "unbiased" even_vanish(odd_nondecreasing, sweep);
    proof |distortion| prove_odd_harmonics(distortion, RelayDeadZone::new);
}

claim! {
    ODD_HARMONICS_HYSTERETIC = "odd-harmonics-hysteretic" Theorem
    "Theorem 1 holds with memory when each branch is the other turned about the origin";
    corrected even_vanish(odd_hysteretic, unbiased);
    false even_vanish(not_odd, unbiased);
    needs "branches-odd" even_vanish(not_odd, unbiased);
    needs "unbiased" even_vanish(odd_hysteretic, sweep);
    proof |distortion| prove_odd_harmonics(distortion, |level, half_width| {
        RelayHysteresis::new(level, half_width, number(0.0))
    });
}

/// Draws a characteristic.
type DrawnFamily = fn(&mut Draw) -> Result<Boxed<f64>, NonlinearityError>;
/// Draws an input.
type Sweep = fn(&mut Draw) -> Result<Sinusoid<f64>, NonlinearityError>;

/// Harmonics 0, 2, 4, 6 are zero to the accuracy of quadrature.
fn even_vanish(draw: &mut Draw, family: DrawnFamily, sweep: Sweep) -> Option<Case> {
    let (characteristic, sweep) = (family(draw).ok()?, sweep(draw).ok()?);
    let scale = output_scale(&*characteristic, &sweep).max(1e-3);
    let mut case = Case::truth(true);
    for order in [0, 2, 4, 6] {
        let Ok((sine, cosine)) = harmonic(&*characteristic, &sweep, order) else { return None };
        case = case.and(draw.equal(("even_harmonic", libm::hypot(sine, cosine)), 0.0, scale, tolerance::QUADRATURE));
    }
    Some(case)
}

claim! {
    SINE_ABS_SINE = "sine-abs-sine" Identity
    "The first harmonic of sin abs(sin) is 8/(3 pi) sin; the next is the third, -8/(15 pi)";
    printed Holds sine_abs_sine(8.0 / (3.0 * PI));
    false sine_abs_sine(0.85);
    proof prove_sine_abs_sine;
}

/// By quadrature and by the gamma-function form of the power law, for any amplitude.
fn sine_abs_sine(draw: &mut Draw, first: f64) -> Option<Case> {
    let (square, sweep) = (Power::new(1.0, 2.0).ok()?, unbiased(draw).ok()?);
    let by_gamma = square.describing_function(&sweep).ok()?.p * sweep.amplitude();
    let [(sine, cosine), (third, _)] = [harmonic(&square, &sweep, 1).ok()?, harmonic(&square, &sweep, 3).ok()?];
    let scale = sweep.amplitude() * sweep.amplitude();
    let by_quadrature = [
        ("first", sine, first * scale, scale),
        ("cosine", cosine, 0.0, scale),
        ("third", third, -8.0 / (15.0 * PI) * scale, scale),
    ];
    let closed = draw.equal(("first_by_gamma", by_gamma), first * scale, scale, tolerance::ROUNDING);
    Some(closed.and(draw.equations(by_quadrature, tolerance::QUADRATURE)))
}

/// Every kernel, at every place and scale, and each member of the catalogue as a sum of them.
fn prove_describing_function(distortion: Distortion) -> Verdict {
    let forms = [KernelForm::Step, KernelForm::Ramp, KernelForm::Sign, KernelForm::Band];
    Verdict::all(forms.map(|form| prove_kernel(form, distortion, BREAKPOINT)))
        .and(|| as_coded(distortion))
        .and(|| decomposition(distortion))
        .and(|| scaling(distortion))
        .and(|| beyond(distortion))
}

/// Powers up to the ninth. The mean over twelve equally spaced angles is the mean over the circle for every
/// trigonometric polynomial of degree below twelve: no antiderivative is needed.
fn monomials([bias]: [Rational; 1], factor: Rational) -> Option<[Rational; 20]> {
    let sweep = Sinusoid::new(bias, number(1.0)).ok()?;
    let (half, root) = (number(0.5), number(3.0).sqrt() / number(2.0));
    let quarter = [number(0.0), half, root, number(1.0), root, half];
    let sines: Vec<Rational> = quarter.into_iter().chain(quarter.map(|sine| -sine)).collect();
    let mut powers = vec![number(1.0); sines.len()];
    let mut errors = [number(0.0); 20];
    for (degree, error) in errors.chunks_mut(2).enumerate() {
        let monomial = Polynomial::<_, 10>::new(array::from_fn(|k| number(f64::from(u8::from(k == degree))))).ok()?;
        let closed = monomial.describing_function(&sweep).ok()? * factor;
        let (mut mean, mut sine) = (number(0.0), number(0.0));
        for (power, &node) in powers.iter_mut().zip(&sines) {
            (mean, sine) = (mean + *power, sine + *power * node);
            *power = *power * (bias + node);
        }
        error[0] = closed.f0 - mean / number(12.0);
        error[1] = closed.p - sine / number(6.0);
    }
    Some(errors)
}

/// Completing the square: with another mean, sine and cosine the mean square grows, by the mean square of the differences.
fn square_completed(
    [mean, by_sine, by_cosine, square, a, b, c]: [Rational; 7],
    factor: Rational,
) -> Option<[Rational; 1]> {
    let left = |[mean_taken, sine, cosine]: [Rational; 3]| {
        let products = mean_taken * mean + sine * by_sine + cosine * by_cosine;
        let own = mean_taken.square() + (sine.square() + cosine.square()) / number(2.0);
        square - number(2.0) * products + own
    };
    let [best_sine, best_cosine] = [by_sine, by_cosine].map(|product| number(2.0) * factor * product);
    let more = a.square() + (b.square() + c.square()) / number(2.0);
    Some([left([mean + a, best_sine + b, best_cosine + c]) - left([mean, best_sine, best_cosine]) - more])
}

/// Even orders cancel, and half a turn on the output is its negative: of a relay, which stands for the parity as a property of
/// the code's outputs.
fn prove_odd_harmonics<C: Characteristic<Number = Rational>>(
    distortion: Distortion,
    made: fn(Rational, Rational) -> Result<C, NonlinearityError>,
) -> Verdict {
    let half_turn = |[level, half_width, x]: [Rational; 3], factor: Rational| {
        let relay = made(level, half_width).ok()?;
        let sweep = Sinusoid::new(number(0.0), number(9.0)).ok()?;
        let sum = |branch, other| relay.output(x, branch, &sweep) + factor * relay.output(-x, other, &sweep);
        Some([sum(Branch::Rising, Branch::Falling), sum(Branch::Falling, Branch::Rising)])
    };
    let points = [[1.0, 0.5, 2.0], [1.0, 0.5, -2.0], [1.0, 0.5, 0.2], [1.0, 0.5, -0.2]];
    even_contributions_cancel(ClaimPart::WHOLE, distortion).and(|| exactly(HALF_TURN, distortion, &points, half_turn))
}

/// Of characteristics of the catalogue, not of the class.
const HALF_TURN: ClaimPart = ClaimPart::whole("half-turn", "output half a turn on is minus the output");

/// Cosine or sine of the next multiple of an angle from the last two.
fn next_multiple<T: Real>(cosine: T, [last, before]: [T; 2]) -> T {
    T::two() * cosine * last - before
}

/// Half a turn on, cosine and sine of an even multiple are unchanged, of an odd multiple their negatives: if for two orders,
/// then for the next, whichever of the two is even. Where the output changes sign, an even order's contributions cancel.
fn even_contributions_cancel(part: ClaimPart, distortion: Distortion) -> Verdict {
    let functions = |[cosine, last, before, output]: [Rational; 4], factor: Rational| {
        let step = |sign: Rational| {
            let half_a_turn_on = next_multiple(-cosine, [sign * last, -sign * before]);
            half_a_turn_on + factor * sign * next_multiple(cosine, [last, before])
        };
        Some([step(number(1.0)), step(number(-1.0)), output * last + factor * -output * last])
    };
    exactly(part, distortion, &[[0.6, 0.3, 0.2, 1.5]], functions)
}
