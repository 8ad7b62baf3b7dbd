//! Smooth characteristics: closed form equals integral, over boxes of bias and amplitude.
//!
//! The integral is replaced by a mean over equally spaced angles, whose error is bounded because the output is analytic about
//! the real axis; the closed form less that finite sum vanishes, as an identity of two variables.

use super::family::closed_is_integral;
use super::{Case, ClaimPart, ClaimVariable, Distortion, Draw, Evidence, Verdict, claim, tolerance};
use crate::describing::ClosedForm;
use crate::nonlinearity::{Arctan, Branch, NonlinearityError, Sine, Sinh, Sinusoid, Tanh};
use crate::numeric::{Interval, Real};
use crate::proof::identity::{IdentityJet, prove_zero_of_two};

/// Bound asked of the finite mean less the integral.
const RULE: f64 = 1e-13;
const CELLS: usize = 3000;

/// A characteristic of unit gain and scale in two arithmetics, with bounds of its output off the real axis.
struct Smooth<V, S> {
    values: Result<V, NonlinearityError>,
    series: Result<S, NonlinearityError>,
    /// Half-width of the strip of complex angles that is used.
    strip_rad: f64,
    /// Bound of the output's magnitude where the input's real part is within `real` of zero and its imaginary part within
    /// `imaginary`.
    magnitude: fn(real: Interval, imaginary: Interval) -> Interval,
}

/// Closed form, made false unless the factor is 1, less the mean over the angles with these cosines: mean and component.
fn error<T: Real>(
    characteristic: &impl ClosedForm<Number = T>,
    cosines: &[Interval],
    number: fn(Interval) -> T,
    [bias, amplitude]: [T; 2],
    factor: T,
) -> [T; 2] {
    let closed = Sinusoid::new(bias, amplitude).map(|sweep| (sweep, characteristic.describing_function(&sweep)));
    let Ok((sweep, Ok(closed))) = closed else { return [T::from_f64(f64::NAN); 2] };
    let (mut mean, mut component) = (T::zero(), T::zero());
    for cosine in cosines.iter().map(|&cosine| number(cosine)) {
        let output = characteristic.output(bias + amplitude * cosine, Branch::Rising, &sweep);
        (mean, component) = (mean + output, component + output * cosine);
    }
    let count = T::from_f64(cosines.len() as f64);
    [factor * closed.f0 - mean / count, factor * amplitude * closed.p - T::two() * component / count]
}

impl<V: ClosedForm<Number = Interval>, S: ClosedForm<Number = IdentityJet>> Smooth<V, S> {
    /// Bound of the error of a mean over `2 nodes` equally spaced angles: `2 M/(exp(2 nodes a) - 1)` for a function below M
    /// where the angle's imaginary part is within a (Trefethen, Weideman 2014, theorem 3.2).
    fn rule_error(&self, nodes: usize, [bias, amplitude]: [[f64; 2]; 2]) -> Interval {
        let (strip, largest) = (Interval::point(self.strip_rad), Interval::point(amplitude[1]));
        let reach = Interval::point(bias[0].abs().max(bias[1].abs()));
        let output = (self.magnitude)(reach + largest * strip.cosh(), largest * strip.sinh());
        let angles = Interval::point((2 * nodes) as f64);
        Interval::two() * output * strip.cosh() / (angles * strip).exp_m1()
    }

    /// Over a box of bias and amplitude, both times the scale.
    fn prove(&self, distortion: Distortion, domain: [[f64; 2]; 2]) -> Verdict {
        let nodes = (1..200).find(|&nodes| self.rule_error(nodes, domain).upper() < RULE);
        let (Some(nodes), Ok(values), Ok(series), true) = (nodes, &self.values, &self.series, roots_agree()) else {
            return Verdict::undecided("means over 400 angles");
        };
        let angle = |k: usize| Interval::PI * Interval::point(k as f64 + 0.5) / Interval::point(nodes as f64);
        let cosines: Vec<Interval> = (0..nodes).map(|k| angle(k).cos()).collect();
        let values = |bias, amplitude| {
            error(values, &cosines, |number| number, [bias, amplitude], distortion.at(bias, domain[0]))
        };
        let series = |bias, amplitude| {
            error(series, &cosines, IdentityJet::constant, [bias, amplitude], distortion.at(bias, domain[0]))
        };
        match prove_zero_of_two(values, series, domain, tolerance::PROOF, CELLS) {
            Ok(proved) => {
                let [bias, amplitude] = domain;
                let sides = vec![
                    ClaimVariable::number("abs(k B)", bias[0], bias[1]),
                    ClaimVariable::number("k X", amplitude[0], amplitude[1]),
                ];
                let part = ClaimPart { variables: sides.into(), ..ClaimPart::named("every-sweep") };
                Verdict::Holds(Evidence::identity(part, proved.bound.value() + 2.0 * RULE, proved.boxes))
            }
            Err(_) => Verdict::undecided("an identity of two variables, 3000 cells"),
        }
    }
}

const UNIT: Interval = Interval::ONE;
const ONE: IdentityJet = IdentityJet::constant(UNIT);

/// That both of the expressions that `describing::pole` chooses from give the same root: `(c^2 + u^2)(c^2 + l^2)` is
/// `(c^2 - u l)^2 + c^2 (u + l)^2`, as polynomials of degree 4, 2, 2 are that agree on 5 by 3 by 3 points.
fn roots_agree() -> bool {
    (0_i64..45).all(|k| {
        let (c, u, l) = (k / 9, k / 3 % 3, k % 3);
        (c * c + u * u) * (c * c + l * l) == (c * c - u * l).pow(2) + (c * (u + l)).pow(2)
    })
}

/// Makes a characteristic from gain and scale.
type Make<C> = fn(f64, f64) -> Result<C, NonlinearityError>;

/// Closed form times `factor` against quadrature, gains and biases of either sign.
fn smooth_is_integral<C: ClosedForm<Number = f64>>(draw: &mut Draw, make: Make<C>, factor: f64) -> Option<Case> {
    let characteristic = make(draw.uniform("gain", -2.0, 2.0), draw.uniform("scale", 0.2, 2.0));
    let sweep = Sinusoid::new(draw.uniform("bias", -2.0, 2.0), draw.uniform("amplitude", 0.1, 2.0));
    let (characteristic, sweep) = (characteristic.ok()?, sweep.ok()?);
    let [low, high] =
        [sweep.minimum(), sweep.maximum()].map(|x| characteristic.output(x, Branch::Rising, &sweep).abs());
    closed_is_integral(draw, &characteristic, &sweep, low.max(high).max(1e-3), factor)
}

/// Rows: constant, id, statement; constructor, strip, bound of the magnitude, and boxes of bias and amplitude.
macro_rules! smooth {
    ($($constant:ident = $id:literal $statement:literal,
       $type:ident, strip $strip_rad:literal, below $magnitude:expr, on $($domain:expr),+;)+) => {
        $(
            claim! {
                $constant = $id Identity $statement;
                corrected smooth_is_integral($type::new, 1.0);
                false smooth_is_integral($type::new, 1.000_01);
                proof |distortion| {
                    let (values, series) = ($type::new(UNIT, UNIT), $type::new(ONE, ONE));
                    let smooth = Smooth { values, series, strip_rad: $strip_rad, magnitude: $magnitude };
                    Verdict::all([$($domain),+].into_iter().map(|domain| smooth.prove(distortion, domain)))
                };
                not_proved "the error of the finite mean grows with the sweep, and boxes near amplitude zero cancel";
            }
        )+
    };
}

smooth! {
    SINE = "sine" "F_0 and P of a sine are Bessel functions J of the amplitude, times sine and cosine of the bias",
        // `abs(sin(x + iy)) <= cosh y`.
        Sine, strip 0.9, below |_, y| y.cosh(), on [[0.0, 3.0], [0.25, 3.0]];
    SINH = "sinh" "F_0 and P of a hyperbolic sine are Bessel functions I of the amplitude, times sinh and cosh of the bias",
        // `abs(sinh(x + iy)) <= cosh x`.
        Sinh, strip 0.9, below |x, _| x.cosh(), on [[0.0, 2.0], [0.25, 3.0]];
    ARCTAN = "arctan" "F_0 and P of an arc tangent follow from one complex square root",
        // `abs(atan(x + iy)) <= pi/2 + atanh(abs(y))` for `abs(y) < 1`.
        Arctan, strip 0.3, below |_, y| Interval::PI / Interval::two() + y.atanh(), on [[0.0, 3.0], [0.25, 3.0]];
    TANH = "tanh" "F_0 and P of a hyperbolic tangent are sums over its poles, or over exponentials on one side",
        // `abs(tanh(x + iy)) <= max(1, tan(abs(y)))` for `abs(y) < pi/2`. Both formulas that the code chooses from.
        Tanh, strip 0.45, below |_, y| y.tan().max(UNIT), on [[0.0, 2.25], [0.25, 3.0]], [[4.5, 5.5], [0.5, 2.0]];
}
