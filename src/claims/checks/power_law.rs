//! Power laws: the closed form is the integral, for every exponent and every bias.

use super::family::closed_is_integral;
use super::{Case, ClaimPart, Distortion, Draw, Evidence, Verdict, claim, tolerance};
use crate::describing::{ClosedForm, certified};
use crate::nonlinearity::{Power, Sinusoid};
use crate::numeric::power::{INNER, OUTER, STEEP, analytic_step, paired_step, step};
use crate::numeric::{Interval, Real};
use crate::proof::rigorous_quadrature::CellJet;

claim! {
    POWER_LAW = "power-law" Identity
    "Mean and gain of sgn(x) abs(x)^p are the hypergeometric series about bias/amplitude 0, 1 and infinity";
    corrected power_is_integral(1.0);
    false power_is_integral(1.000_01);
    proof power_law;
    not_proved "constants of the series are compared at listed exponents, not over a range of them";
}

/// Closed form times `factor` against quadrature, any exponent.
fn power_is_integral(draw: &mut Draw, factor: f64) -> Option<Case> {
    let (exponent, bias) = (draw.uniform("exponent", 0.0, 5.0), draw.uniform("bias", -2.0, 2.0));
    let amplitude = draw.uniform("amplitude", 0.5, 2.0);
    let (power, sweep) = (Power::new(1.0, exponent).ok()?, Sinusoid::new(bias, amplitude).ok()?);
    closed_is_integral(draw, &power, &sweep, libm::pow(bias.abs() + amplitude, exponent), factor)
}

const LISTED: ClaimPart = ClaimPart::named("listed-exponents");

/// Exponents whose constants are compared; the identities hold for all.
const EXPONENTS: [f64; 9] = [0.0, 0.5, 1.0, 1.5, 1.7, 2.0, 2.5, 3.0, 8.5];

/// That code and integral obey the same differential equation, by identities on integers; that they agree at a point of
/// each series; and how far they can be apart elsewhere then.
fn power_law(distortion: Distortion) -> Verdict {
    if !identities_hold() {
        return Verdict::undecided("identities of polynomials");
    }
    let (mut bound, mut boxes) = (0.0_f64, 0);
    for exponent in EXPONENTS {
        let Ok(error) = PowerLaw { exponent, factor: distortion.factor() }.error(&mut boxes) else {
            return Verdict::undecided("quadrature");
        };
        bound = bound.max(error);
    }
    if bound > tolerance::PROOF {
        return Verdict::undecided("quadrature at four biases");
    }
    Verdict::Holds(Evidence::identity(LISTED, bound, boxes))
}

fn number(value: f64) -> Interval {
    Interval::point(value)
}

/// The multiple of `u^k` that the operator `(1 - u^2) m'' + (2p - 1) u m' - p^2 m` subtracts; besides it gives `k (k - 1) u^(k-2)`.
fn taken(k: Interval, p: Interval) -> Interval {
    k * (k - Interval::ONE) - (p + p - Interval::ONE) * k + p * p
}

/// Identities between polynomials of degree seven at most in each of three variables, hence proved by 512 points.
/// Arithmetic is exact there: the differences come out as zero itself.
fn identities_hold() -> bool {
    let (one, half) = (Interval::ONE, number(0.5));
    let grid = || (0..8u8).map(|k| number(f64::from(k)));
    let everywhere = |differences: &dyn Fn(Interval, Interval, Interval) -> Vec<Interval>| {
        grid().all(|a| {
            grid().all(|b| {
                grid().all(|c| differences(a, b, c).into_iter().all(|difference| difference == Interval::ZERO))
            })
        })
    };
    // Derivatives by the angle, over `p x^(p-2)` and over `x^(p-1)`.
    let telescoping = everywhere(&|u, x, p| {
        let (s, steep) = (x - u, p - one);
        let mean = (one - u * u) * steep + (p + steep) * u * x - p * x * x;
        let sine = (one + p) * s * x - p * (one - u * u) - p * u * x;
        vec![mean + s * x - steep * (one - s * s), sine - s * x + p * (one - s * s)]
    });
    let steps = everywhere(&|n, p, _| {
        let index = n.midpoint();
        let (odd, even) = (n + n + one, p - n - n);
        let a = half * (one - p);
        let [up, down] = step(a, a, 1.5, index);
        let about_zero = up * (odd + one) * (odd + one + one) - down * taken(odd, p);
        let [up, down] = step(-half * p, a, 1.0, index);
        let about_infinity = up * taken(even - one - one, p) - down * even * (even - one);
        // In `z = (1 - u)/2` the operator takes the same of `z^k` and gives `k (k - p - 1/2) z^(k-1)`.
        let [up, down] = analytic_step(p, n);
        let next = n + one;
        vec![about_zero, about_infinity, up * next * (next - p - half) - down * taken(n, p)]
    });
    let pairs = everywhere(&|order, minus_delta, index| {
        let (order, delta, j) = (order + number(8.0), -minus_delta, index + one);
        let (of_a, of_b) = ((j - delta) * (order + j), (order + j + delta) * j);
        let p = order + delta - half;
        // By linearity two cases are all; these are divisible.
        let cases = [[of_a * of_b, Interval::ZERO], [Interval::ZERO, of_a]];
        let difference = |[b, d]: [Interval; 2]| {
            let [next_b, next_d] = paired_step(order.midpoint(), delta, j.midpoint(), [b, d]);
            let [up, down] = analytic_step(p, order + j - one);
            let analytic = (next_b + delta * next_d) * down - (b + delta * d) * up;
            let [up, down] = analytic_step(p, p + half + j - one);
            [analytic, next_b * down - b * up]
        };
        cases.into_iter().flat_map(difference).collect()
    });
    telescoping && steps && pairs
}

/// Bound of a solution of `d_phi^2 d = p^2 d - 2 p tan(phi) d_phi` over an angle `room`, from a value and a slope.
pub fn most_within(p: Interval, value: Interval, slope: Interval, room: Interval) -> Interval {
    (value + slope * room) * (p * room).exp()
}

/// Bound of the slope of a solution of `d_psi^2 d = 2 p coth(psi) d_psi - p^2 d` down to zero, from a value and a slope.
pub fn steepest_beyond(p: Interval, value: Interval, slope: Interval) -> Interval {
    (slope.square() + (p * value).square()).sqrt()
}

/// A power law and its closed form, made false unless the factor is 1.
struct PowerLaw {
    exponent: f64,
    factor: f64,
}

impl PowerLaw {
    /// Bound of the error of m and h at every bias, relative to the largest output.
    fn error(&self, boxes: &mut usize) -> Result<f64, Box<dyn std::error::Error>> {
        let p = number(self.exponent);
        // Multiples of the odd solution, and of the solution that is regular at infinity.
        let [mean, _] = self.closed(0.5)?;
        let [inner, _] = self.difference(0.5, boxes)?;
        let [outer_mean, _] = self.closed(2.0)?;
        let [outer, _] = self.difference(2.0, boxes)?;
        let mut error = (inner / mean).magnitude().max((outer / outer_mean).magnitude());
        if self.exponent < STEEP {
            error = error.max(self.within(p, boxes)?).max(self.beyond(p, boxes)?);
        }
        Ok(error)
    }

    /// From the inner series to `u = 1`, `u = sin(phi)`: with `E = d_phi^2 - p^2 d^2`, `dE/dphi = -4 p tan(phi) d_phi^2` is not
    /// positive, so `abs(d)` grows no faster than with `abs(d_phi) <= start + p abs(d)`.
    fn within(&self, p: Interval, boxes: &mut usize) -> Result<f64, Box<dyn std::error::Error>> {
        let (u, [mean, sine]) = (number(INNER), self.difference(INNER, boxes)?.map(Interval::abs));
        let (room, cosine) = (u.acos(), ((Interval::ONE - u) * (Interval::ONE + u)).sqrt());
        let start = ((Interval::ONE + p) * sine + p * u * mean) / cosine;
        let most = most_within(p, mean, start, room);
        let sine = (start + p * most + p * most) / (Interval::ONE + p);
        Ok((most.hull(sine) / (Interval::ONE + u).pow(p)).magnitude())
    }

    /// From the outer series to `u = 1`, `u = cosh(psi)`: with `E = d_psi^2 + p^2 d^2`, `dE/dpsi = 4 p coth(psi) d_psi^2` is not
    /// negative, so `abs(d_psi)` is nowhere above the root of E at the start.
    fn beyond(&self, p: Interval, boxes: &mut usize) -> Result<f64, Box<dyn std::error::Error>> {
        let (u, [mean, sine]) = (number(OUTER), self.difference(OUTER, boxes)?.map(Interval::abs));
        let sinh = ((u - Interval::ONE) * (u + Interval::ONE)).sqrt();
        let start = ((Interval::ONE + p) * sine + p * u * mean) / sinh;
        let slope = steepest_beyond(p, mean, start);
        let most = mean + slope * (u + sinh).ln();
        let sine = (sinh * slope + p * u * most) / (Interval::ONE + p);
        Ok((most.hull(sine) / Interval::two().pow(p)).magnitude())
    }

    /// m and h of the code, at unit amplitude.
    fn closed(&self, u: f64) -> Result<[Interval; 2], Box<dyn std::error::Error>> {
        let power = Power::new(number(self.factor), number(self.exponent))?;
        let df = power.describing_function(&Sinusoid::new(number(u), Interval::ONE)?)?;
        Ok([df.f0, df.p / Interval::two()])
    }

    /// Code less integral.
    fn difference(&self, u: f64, boxes: &mut usize) -> Result<[Interval; 2], Box<dyn std::error::Error>> {
        let jet = CellJet::from_f64;
        let power = Power::new(jet(1.0), jet(self.exponent))?;
        let integral = certified(&power, &Sinusoid::new(jet(u), jet(1.0))?)?;
        *boxes += integral.cells;
        let [mean, sine] = self.closed(u)?;
        Ok([mean - integral.enclosure.f0, sine - integral.enclosure.p / Interval::two()])
    }
}
