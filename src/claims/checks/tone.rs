//! A tone through inertia and drag: eqs. 21-29.

use core::f64::consts::PI;

use super::algebra::zeros;
use super::{Case, ClaimPart, Distortion, Draw, Verdict, claim, tolerance};
use crate::describing::DescribingFunction;
use crate::identify::iso::{Parameters, parameters};
use crate::numeric::quadrature::integrate as by_quadrature;
use crate::numeric::{Interval, Real};
use crate::proof::rigorous_quadrature::{CellJet, Integrand, integrate};

const TONE: ClaimPart = ClaimPart::named("every-tone");

/// An axis on a tone: parameters, amplitude, angular frequency.
struct Tone {
    alpha: f64,
    linear: f64,
    quadratic: f64,
    amplitude: f64,
    omega: f64,
}

impl Tone {
    fn draw(draw: &mut Draw) -> Self {
        Self {
            alpha: draw.log_uniform("alpha", 0.1, 10.0),
            linear: draw.uniform("linear_drag", 0.0, 3.0),
            quadratic: draw.uniform("quadratic_drag", 0.0, 3.0),
            amplitude: draw.uniform("amplitude", 0.1, 2.0),
            omega: draw.log_uniform("omega_rad_s", 0.2, 5.0),
        }
    }

    /// First harmonic `(f_R, f_I)` of the left side over the amplitude, by quadrature along the sinusoid.
    fn first_harmonic(&self) -> (f64, f64) {
        let force = |angle: f64| {
            let speed = self.amplitude * self.omega * libm::cos(angle);
            let acceleration = -self.amplitude * self.omega * self.omega * libm::sin(angle);
            self.alpha * acceleration + self.linear * speed + self.quadratic * speed * speed.abs()
        };
        let coefficient = |weight: fn(f64) -> f64| {
            let piece =
                |from, to| by_quadrature(&mut |angle| force(angle) * weight(angle), from, to, 1e-14, 1000).value;
            (piece(-0.5 * PI, 0.5 * PI) + piece(0.5 * PI, 1.5 * PI)) / (PI * self.amplitude)
        };
        (coefficient(libm::sin), coefficient(libm::cos))
    }

    /// Size of the left side over the amplitude.
    fn scale(&self) -> f64 {
        (self.alpha * self.omega + self.linear + self.quadratic * self.amplitude * self.omega) * self.omega
    }
}

claim! {
    FIRST_HARMONIC = "first-harmonic-equations" Identity
    "On one tone the drag axis has f_R = -alpha w^2 and f_I = beta_1 w + (8/(3 pi)) beta_2 X w^2";
    printed Holds left_side(8.0 / (3.0 * PI));
    false left_side(0.85);
    proof prove_first_harmonic;
}

fn left_side(draw: &mut Draw, sine_abs_sine: f64) -> Option<Case> {
    let tone = Tone::draw(draw);
    let (real, imaginary) = tone.first_harmonic();
    let (inertia, scale) = (-tone.alpha * tone.omega * tone.omega, tone.scale());
    let drag = (tone.linear + sine_abs_sine * tone.quadratic * tone.amplitude * tone.omega) * tone.omega;
    Some(draw.equations([("f_r", real, inertia, scale), ("f_i", imaginary, drag, scale)], tolerance::QUADRATURE))
}

claim! {
    LINEAR_DRAG = "linear-drag" Theorem
    "On one tone with linear drag, alpha = P/w^2 and beta = -Q/w give the parameters back";
    printed Holds gives_back(|tone| tone.quadratic = 0.0, |p| p.beta, |t| t.linear);
    false gives_back(|_| {}, |p| p.beta, |t| t.linear);
    proof |distortion| prove_gives_back(distortion, false, |found| found.beta);
}

claim! {
    QUADRATIC_DRAG = "quadratic-drag" Theorem
    "On one tone with quadratic drag, alpha = P/w^2 and beta_xx = -(3 pi/8) Q/(X w^2) give the parameters back";
    printed Holds gives_back(|tone| tone.linear = 0.0, |p| p.beta_quadratic, |t| t.quadratic);
    false gives_back(|_| {}, |p| p.beta_quadratic, |t| t.quadratic);
    proof |distortion| prove_gives_back(distortion, true, |found| found.beta_quadratic);
}

/// The relay's gain balances the left side; the identification gives back the coefficients of that side.
fn gives_back(
    draw: &mut Draw,
    law: fn(&mut Tone),
    identified: fn(&Parameters<f64>) -> f64,
    given: fn(&Tone) -> f64,
) -> Option<Case> {
    let mut tone = Tone::draw(draw);
    law(&mut tone);
    let (real, imaginary) = tone.first_harmonic();
    let gain = DescribingFunction { f0: 0.0, p: -real, q: -imaginary };
    let found = parameters(gain, tone.amplitude, tone.omega);
    let drag_scale = tone.scale() / tone.omega * (1.0 + 1.0 / (tone.amplitude * tone.omega));
    let alpha_scale = tone.scale() / (tone.omega * tone.omega);
    let equations = [
        ("alpha_found", found.alpha, tone.alpha, alpha_scale),
        ("drag_found", identified(&found), given(&tone), drag_scale),
    ];
    Some(draw.equations(equations, tolerance::QUADRATURE))
}

/// Products of sine, cosine and their magnitudes over a turn.
struct Products<const M: usize>(fn(CellJet, CellJet) -> [CellJet; M]);

impl<const M: usize> Integrand<M> for Products<M> {
    fn range(&self, t: Interval) -> [Interval; M] {
        (self.0)(CellJet::constant(t.sin()), CellJet::constant(t.cos())).map(|jet| jet.value())
    }
    fn jet(&self, t: CellJet) -> Option<[CellJet; M]> {
        Some((self.0)(t.sin(), t.cos()))
    }
}

/// Fourier coefficients: integrals over a turn, over pi.
fn coefficients<const M: usize>(of: fn(CellJet, CellJet) -> [CellJet; M]) -> ([Interval; M], usize) {
    let found = integrate(&Products(of), Interval::ZERO, Interval::two() * Interval::PI, 1e-12, 20_000);
    (found.integrals.map(|integral| integral / Interval::PI), found.cells)
}

fn ratio(numerator: f64, denominator: f64) -> Interval {
    Interval::point(numerator) / (Interval::point(denominator) * Interval::PI)
}

/// For what eq. 24 is stated.
pub(super) const EVERY_AMPLITUDE: ClaimPart = ClaimPart::named("every-amplitude");

/// First and third harmonic.
pub(super) fn prove_sine_abs_sine(distortion: Distortion) -> Verdict {
    let ([first, cosine, third], cells) = coefficients(|s, c| {
        let square = s * s.abs();
        let thrice = s * (CellJet::from_f64(3.0) - CellJet::from_f64(4.0) * s * s);
        [square * s, square * c, square * thrice]
    });
    let factor = Interval::point(distortion.factor());
    let numbers = [first - factor * ratio(8.0, 3.0), cosine, third + factor * ratio(8.0, 15.0)];
    zeros(EVERY_AMPLITUDE, &numbers, cells)
}

/// First harmonic of inertia, linear and quadratic drag on a unit sinusoid: sine parts, then cosine parts.
fn tone() -> ([Interval; 6], usize) {
    coefficients(|s, c| [-(s * s), s * c, c * c.abs() * s, -(s * c), c * c, c * c.abs() * c])
}

/// The three forces of an axis.
fn prove_first_harmonic(distortion: Distortion) -> Verdict {
    let ([inertia, linear, quadratic, inertia_q, linear_q, quadratic_q], cells) = tone();
    let factor = Interval::point(distortion.factor());
    let numbers =
        [inertia + factor, linear, quadratic, inertia_q, linear_q - factor, quadratic_q - factor * ratio(8.0, 3.0)];
    zeros(TONE, &numbers, cells)
}

/// Inertia and a drag coefficient, given back.
fn prove_gives_back(distortion: Distortion, quadratic: bool, read: fn(Parameters<Interval>) -> Interval) -> Verdict {
    let ([inertia, linear_p, quadratic_p, inertia_q, linear_q, quadratic_q], cells) = tone();
    let (in_phase, in_quadrature) = if quadratic { (quadratic_p, quadratic_q) } else { (linear_p, linear_q) };
    let gain = DescribingFunction { f0: Interval::ZERO, p: -(inertia + in_phase), q: -(inertia_q + in_quadrature) };
    let found = parameters(gain, Interval::ONE, Interval::ONE);
    let factor = Interval::point(distortion.factor());
    zeros(TONE, &[found.alpha - factor, read(found) - factor], cells)
}
