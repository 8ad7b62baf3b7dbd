//! Proofs by enclosure. Each takes a factor that makes the statement false unless it is one, and then must not succeed.
//!
//! Every quantity here is homogeneous in level, amplitude, half-width and angular frequency, so all but ratios are set to one;
//! an identity of one ratio is proved for all its values at once by [`prove_zero`].

use std::array;
use std::sync::LazyLock;

use super::single::Single;
use super::{Evidence, Verdict, power_law, smooth, tolerance};
use crate::describing::{ClosedForm, DescribingFunction, KernelForm, prove_changed_band};
use crate::identify::iso::{Oscillation, Parameters, amplitude_sensitivity, parameters};
use crate::identify::select::pairwise::relative_spread_percent;
use crate::nonlinearity::{Branches, Kernel, Polynomial, RelayHysteresis, Sinusoid};
use crate::numeric::special::Special;
use crate::numeric::{Interval, Real};
use crate::proof::branch_and_bound::prove_positive;
use crate::proof::identity::{Series, prove_zero};
use crate::proof::rigorous_quadrature::{CellJet, Integrand, integrate};
use crate::proof::{Change, Gradient, NotProved, Proved};

/// A proof, true of the factor one.
pub type Proof = fn(f64) -> Verdict;

/// Every proof, with the id of the claim that it backs.
pub const PROOFS: &[(&str, Proof)] = &[
    ("kernel-step", kernel_step),
    ("kernel-ramp", kernel_ramp),
    ("kernel-sign", kernel_sign),
    ("kernel-band", kernel_band),
    ("describing-function", describing_function),
    ("polynomial", polynomial),
    ("power-law", power_law::power_law),
    ("sine", smooth::sine),
    ("sinh", smooth::sinh),
    ("arctan", smooth::arctan),
    ("tanh", smooth::tanh),
    ("sine-abs-sine", sine_abs_sine),
    ("relay-q", relay_q),
    ("relay-p", relay_p),
    ("relay-f0", relay_f0),
    ("second-quadrant", second_quadrant),
    ("first-harmonic-equations", first_harmonic),
    ("linear-drag", linear_drag),
    ("quadratic-drag", quadratic_drag),
    ("table-3", table_3),
    ("delay-rotation", delay_rotation),
    ("quantisation-alpha", quantisation_alpha),
    ("quantisation-beta", quantisation_beta),
    ("quantisation-beta-xx", quantisation_beta_xx),
    ("quantisation-zero", quantisation_zero),
    ("relative-spread", relative_spread),
    ("zig-zag", zig_zag),
];

/// Cells of an identity of one variable.
const CELLS: usize = 5000;

/// That functions of one variable vanish from `from` to `to`, described by `domain`.
fn identity<const M: usize>(domain: &str, [from, to]: [f64; 2], f: impl Fn(Series) -> [Series; M]) -> Verdict {
    match prove_zero(f, from, to, tolerance::PROOF, CELLS) {
        Ok(proved) => {
            let domain = format!("{domain} in [{from}, {to}]");
            Verdict::Holds(Evidence::Proved { domain, bound: proved.bound.value(), boxes: proved.boxes })
        }
        Err(_) => Verdict::undecided("an identity of one variable, 5000 cells"),
    }
}

/// That each number enclosed is zero to the tolerance.
fn zeros(domain: &str, numbers: &[Interval], boxes: usize) -> Verdict {
    let bound = numbers.iter().map(|number| number.magnitude()).fold(0.0, f64::max);
    if bound <= tolerance::PROOF {
        Verdict::Holds(Evidence::Proved { domain: domain.to_owned(), bound, boxes })
    } else {
        Verdict::undecided("one enclosure")
    }
}

/// A value that proves nothing, where a domain was left.
fn unknown<T: Real>() -> T {
    T::from_f64(f64::NAN)
}

/// A closed form times a factor.
struct Times(f64);

impl Change for Times {
    fn apply<T: Special, const N: usize, const M: usize>(&self, _: [T; N], values: [T; M]) -> [T; M] {
        values.map(|value| value * T::from_f64(self.0))
    }
}

fn kernel(form: KernelForm, factor: f64, domain: &str) -> Verdict {
    type Found = LazyLock<Result<Proved<1>, NotProved<1>>>;
    static STEP: Found = LazyLock::new(|| KernelForm::Step.prove());
    static RAMP: Found = LazyLock::new(|| KernelForm::Ramp.prove());
    static SIGN: Found = LazyLock::new(|| KernelForm::Sign.prove());
    static BAND: Found = LazyLock::new(|| KernelForm::Band.prove());
    let verdict = |proved: &Result<Proved<1>, _>| match proved {
        Ok(Proved { bound, boxes, .. }) => {
            Verdict::Holds(Evidence::Proved { domain: domain.to_owned(), bound: bound.value(), boxes: *boxes })
        }
        Err(_) => Verdict::undecided("60000 cells at most"),
    };
    if (factor - 1.0).abs() > 0.0 {
        return verdict(&form.prove_changed(&Times(factor)));
    }
    verdict(match form {
        KernelForm::Step => &STEP,
        KernelForm::Ramp => &RAMP,
        KernelForm::Sign => &SIGN,
        KernelForm::Band => &BAND,
    })
}

const BREAKPOINT: &str = "every breakpoint u in [-1, 1], mean, sine and cosine component, both sides and branches";

/// The step, every ratio.
#[must_use]
pub fn kernel_step(factor: f64) -> Verdict {
    kernel(KernelForm::Step, factor, BREAKPOINT)
}

/// The ramp, every ratio.
#[must_use]
pub fn kernel_ramp(factor: f64) -> Verdict {
    kernel(KernelForm::Ramp, factor, BREAKPOINT)
}

/// The sign, every ratio.
#[must_use]
pub fn kernel_sign(factor: f64) -> Verdict {
    kernel(KernelForm::Sign, factor, "every breakpoint u in [-1, 1], mean, sine and cosine component, both branches")
}

/// Each end of a band, every ratio; and the code's rearranged sum over both ends, over the plane of both.
#[must_use]
pub fn kernel_band(factor: f64) -> Verdict {
    let rearranged = || match prove_changed_band(&Times(factor)) {
        Ok(parts) => Verdict::Holds(Evidence::Proved {
            domain: "rearranged as coded, both ends u in [-0.95, 0.95] but 1e-9 beyond 1/2".to_owned(),
            bound: parts.iter().map(|part| part.bound.value()).fold(0.0, f64::max),
            boxes: parts.iter().map(|part| part.boxes).sum(),
        }),
        Err(_) => Verdict::undecided("60000 cells for two ratios"),
    };
    kernel(KernelForm::Band, factor, "each end u in [-1, 1], mean and sine component").and(rearranged)
}

/// Closed form of one kernel under a unit sinusoid.
fn on_unit(kernel: Kernel<Series>) -> DescribingFunction<Series> {
    let sweep = Sinusoid::new(Series::zero(), Series::one()).ok();
    sweep.and_then(|sweep| Single(kernel).describing_function(&sweep).ok()).unwrap_or_else(no_function)
}

fn no_function() -> DescribingFunction<Series> {
    DescribingFunction { f0: unknown(), p: unknown(), q: unknown() }
}

/// Every kernel, hence every sum of them.
#[must_use]
pub fn describing_function(factor: f64) -> Verdict {
    let domain =
        "piecewise-linear catalogue, every parameter; per unit height, or slope times amplitude, of each kernel";
    let forms = [KernelForm::Step, KernelForm::Ramp, KernelForm::Sign, KernelForm::Band];
    forms
        .map(|form| kernel(form, factor, domain))
        .into_iter()
        .reduce(|all, next| all.and(|| next))
        .unwrap_or_else(|| Verdict::undecided("nothing"))
}

/// Powers up to the ninth. The mean over twelve equally spaced angles is the mean over the circle for every trigonometric
/// polynomial of degree below twelve, so the integral needs no antiderivative.
#[must_use]
pub fn polynomial(factor: f64) -> Verdict {
    identity("x^0 to x^9, every amplitude by homogeneity, bias/amplitude", [-2.0, 2.0], |bias| {
        let sweep = Sinusoid::new(bias, Series::one()).ok();
        let nodes = (0..12).map(|k| Interval::point(f64::from(k)) * Interval::PI / Interval::point(6.0));
        let sines: Vec<Series> = nodes.map(|angle| Series::constant(angle.sin())).collect();
        let mut powers = vec![Series::one(); sines.len()];
        let mut errors = [Series::zero(); 20];
        for (degree, error) in errors.chunks_mut(2).enumerate() {
            let monomial =
                Polynomial::<_, 10>::new(array::from_fn(|k| Series::from_f64(f64::from(u8::from(k == degree)))));
            let closed =
                sweep.zip(monomial.ok()).and_then(|(sweep, monomial)| monomial.describing_function(&sweep).ok());
            let closed = closed.unwrap_or_else(no_function) * Series::from_f64(factor);
            let (mut mean, mut sine) = (Series::zero(), Series::zero());
            for (power, &node) in powers.iter_mut().zip(&sines) {
                (mean, sine) = (mean + *power, sine + *power * node);
                *power = *power * (bias + node);
            }
            error[0] = closed.f0 - mean / Series::from_f64(12.0);
            error[1] = closed.p - sine / Series::from_f64(6.0);
        }
        errors
    })
}

/// Products of sine, cosine and their magnitudes over one turn.
struct Products<const M: usize>(fn(CellJet, CellJet) -> [CellJet; M]);

impl<const M: usize> Integrand<M> for Products<M> {
    fn range(&self, t: Interval) -> [Interval; M] {
        (self.0)(CellJet::constant(t.sin()), CellJet::constant(t.cos())).map(|jet| jet.value())
    }
    fn jet(&self, t: CellJet) -> Option<[CellJet; M]> {
        Some((self.0)(t.sin(), t.cos()))
    }
}

/// Fourier coefficients: integrals over one turn, over pi.
fn coefficients<const M: usize>(of: fn(CellJet, CellJet) -> [CellJet; M]) -> ([Interval; M], usize) {
    let found = integrate(&Products(of), Interval::ZERO, Interval::two() * Interval::PI, 1e-12, 20_000);
    (found.integrals.map(|integral| integral / Interval::PI), found.cells)
}

fn ratio(numerator: f64, denominator: f64) -> Interval {
    Interval::point(numerator) / (Interval::point(denominator) * Interval::PI)
}

/// First and third harmonic.
#[must_use]
pub fn sine_abs_sine(factor: f64) -> Verdict {
    let ([first, cosine, third], cells) = coefficients(|s, c| {
        let square = s * s.abs();
        let thrice = s * (CellJet::from_f64(3.0) - CellJet::from_f64(4.0) * s * s);
        [square * s, square * c, square * thrice]
    });
    let factor = Interval::point(factor);
    let numbers = [first - factor * ratio(8.0, 3.0), cosine, third + factor * ratio(8.0, 15.0)];
    zeros("every amplitude, by homogeneity of degree two", &numbers, cells)
}

/// First harmonic of inertia, linear and quadratic drag on a unit sinusoid: sine parts, then cosine parts.
fn tone() -> ([Interval; 6], usize) {
    coefficients(|s, c| [-(s * s), s * c, c * c.abs() * s, -(s * c), c * c, c * c.abs() * c])
}

const TONE: &str =
    "every alpha, beta_1, beta_2, X, w > 0: the left side is linear in the three and homogeneous in X and w";

/// The three forces of an axis.
#[must_use]
pub fn first_harmonic(factor: f64) -> Verdict {
    let ([inertia, linear, quadratic, inertia_q, linear_q, quadratic_q], cells) = tone();
    let factor = Interval::point(factor);
    let numbers =
        [inertia + factor, linear, quadratic, inertia_q, linear_q - factor, quadratic_q - factor * ratio(8.0, 3.0)];
    zeros(TONE, &numbers, cells)
}

/// Inertia and one drag coefficient, given back.
fn gives_back(factor: f64, quadratic: bool, read: fn(Parameters<Interval>) -> Interval) -> Verdict {
    let ([inertia, linear_p, quadratic_p, inertia_q, linear_q, quadratic_q], cells) = tone();
    let (in_phase, in_quadrature) = if quadratic { (quadratic_p, quadratic_q) } else { (linear_p, linear_q) };
    let gain = DescribingFunction { f0: Interval::ZERO, p: -(inertia + in_phase), q: -(inertia_q + in_quadrature) };
    let found = parameters(gain, Interval::ONE, Interval::ONE);
    let factor = Interval::point(factor);
    zeros(TONE, &[found.alpha - factor, read(found) - factor], cells)
}

/// Linear drag.
#[must_use]
pub fn linear_drag(factor: f64) -> Verdict {
    gives_back(factor, false, |found| found.beta)
}

/// Quadratic drag.
#[must_use]
pub fn quadratic_drag(factor: f64) -> Verdict {
    gives_back(factor, true, |found| found.beta_quadratic)
}

/// Describing function of the unit relay under a unit sinusoid, in closed form.
fn relay(level: Series, half_width: Series, bias: Series) -> DescribingFunction<Series> {
    let relay = RelayHysteresis::new(level, half_width, Series::zero());
    let df = relay.and_then(|relay| Ok((relay, Sinusoid::new(bias, Series::one())?)));
    df.ok().and_then(|(relay, sweep)| relay.describing_function(&sweep).ok()).unwrap_or_else(no_function)
}

/// The biases, over the amplitude, at which a whole formula is compared with the code in the half-width.
const BIASES: [f64; 2] = [0.0, 0.3];

/// Proof of a printed formula in three parts: the closed form of a sign is its integral; the formula's term of one switching
/// level, at the ratio u, is that closed form; the terms are put together as the code does.
fn printed(
    factor: f64,
    term: impl Fn(Series) -> Series,
    formula: impl Fn(Series, Series) -> Series,
    part: fn(DescribingFunction<Series>) -> Series,
) -> Verdict {
    let false_unless_one = Series::from_f64(factor);
    let of_bias = |bias: f64| {
        identity(&format!("formula = closed form, x_0/X = {bias}, x_a/X"), [0.0, 0.69], |half_width| {
            let bias = Series::from_f64(bias);
            let formula = formula(half_width, bias) * false_unless_one;
            [formula - part(relay(Series::one(), half_width, bias))]
        })
    };
    let of_level = || {
        identity("each term of the formula = closed form, u", [-0.9999, 0.9999], |at| {
            let level = Kernel::Sign { at, level: Series::one(), branches: Branches::Rising };
            [term(at) * false_unless_one - part(on_unit(level))]
        })
    };
    kernel(KernelForm::Sign, factor, "closed form = integral, every X >= x_a + abs(x_0), in units of C/X (mean: C)")
        .and(of_level)
        .and(|| of_bias(BIASES[0]))
        .and(|| of_bias(BIASES[1]))
}

fn root(distance: Series) -> Series {
    (Series::one() - distance.square()).sqrt()
}

/// Eq. 30.
#[must_use]
pub fn relay_q(factor: f64) -> Verdict {
    let term = |u| -(Series::two() * u / Series::pi());
    printed(factor, term, |width, _| -(Series::from_f64(4.0) * width / Series::pi()), |df| df.q)
}

/// Eq. 31.
#[must_use]
pub fn relay_p(factor: f64) -> Verdict {
    let term = |u| Series::two() / Series::pi() * root(u);
    printed(factor, term, |width, bias| term(width - bias) + term(width + bias), |df| df.p)
}

/// Eq. 32.
#[must_use]
pub fn relay_f0(factor: f64) -> Verdict {
    let term = |u: Series| -(u.asin() / Series::pi());
    printed(factor, term, |width, bias| term(width - bias) - term(width + bias), |df| df.f0)
}

/// Each direction of the quadrant is that of some relay.
#[must_use]
pub fn second_quadrant(factor: f64) -> Verdict {
    identity("every magnitude; angle_rad", [1.58, 3.13], |angle| {
        let df = relay(Series::pi() / Series::from_f64(4.0), (Series::pi() - angle).sin(), Series::zero());
        let factor = Series::from_f64(factor);
        [df.p + factor * angle.cos(), df.q + factor * angle.sin()]
    })
}

/// Table 3.
#[must_use]
pub fn table_3(factor: f64) -> Verdict {
    let of_bias = |bias: f64| {
        identity(&format!("every C, X, w > 0; x_0/X = {bias}, x_a/X"), [0.0, 0.69], |width| {
            let bias = Series::from_f64(bias);
            let found = parameters(relay(Series::one(), width, bias), Series::one(), Series::one());
            let (factor, pi) = (Series::from_f64(factor), Series::pi());
            let alpha = Series::two() / pi * (root(width - bias) + root(width + bias));
            [
                factor * alpha - found.alpha,
                factor * Series::from_f64(4.0) * width / pi - found.beta,
                factor * Series::from_f64(1.5) * width - found.beta_quadratic,
            ]
        })
    };
    of_bias(BIASES[0]).and(|| of_bias(BIASES[1]))
}

/// Turning is multiplication by `exp(-j phase)`, and turning back undoes it.
#[must_use]
pub fn delay_rotation(factor: f64) -> Verdict {
    identity("every P and Q, by linearity; phase_rad", [0.0, 6.5], |phase| {
        let (one, none, factor) = (Series::one(), Series::zero(), Series::from_f64(factor));
        let (cosine, sine) = (factor * phase.cos(), factor * phase.sin());
        let real = DescribingFunction { f0: none, p: one, q: none };
        let imaginary = DescribingFunction { f0: none, p: none, q: one };
        let (turned, other) = (real.delayed(phase), imaginary.delayed(phase));
        let back = turned.delayed(-phase);
        [
            turned.p - cosine,
            turned.q + sine,
            other.p - sine,
            other.q - cosine,
            turned.p.square() + turned.q.square() - one,
            back.p - one,
            back.q,
        ]
    })
}

/// What is identified from an unbiased oscillation of that amplitude, half-width, level and angular frequency one.
fn identified<T: Real>(amplitude: T) -> Parameters<T> {
    let (one, zero) = (T::one(), T::zero());
    let period_s = T::two() * T::pi();
    Oscillation { relay_level: one, switch_level: one, amplitude, bias: zero, period_s, delay_s: zero }
        .identify()
        .unwrap_or(Parameters { alpha: unknown(), beta: unknown(), beta_quadratic: unknown(), disturbance: unknown() })
}

/// `X dp/dX = sensitivity p` for one of the parameters.
fn sensitivity(
    factor: f64,
    domain: &str,
    read: fn(Parameters<Series>) -> Series,
    printed: fn(Series) -> Series,
) -> Verdict {
    identity(domain, [1.001, 100.0], |amplitude| {
        let parameter = read(identified(amplitude));
        [amplitude * parameter.derivative() - Series::from_f64(factor) * printed(amplitude) * parameter]
    })
}

/// Eq. 37.
#[must_use]
pub fn quantisation_alpha(factor: f64) -> Verdict {
    sensitivity(factor, "unbiased, no delay, X/x_a", |found| found.alpha, |r| amplitude_sensitivity(r).alpha)
}

/// Eq. 38.
#[must_use]
pub fn quantisation_beta(factor: f64) -> Verdict {
    let domain = "no delay, any bias by relay-q, X/x_a";
    sensitivity(factor, domain, |found| found.beta, |r| amplitude_sensitivity(r).beta)
}

/// Eq. 39.
#[must_use]
pub fn quantisation_beta_xx(factor: f64) -> Verdict {
    let domain = "no delay, any bias by relay-q, X/x_a";
    sensitivity(factor, domain, |found| found.beta_quadratic, |r| amplitude_sensitivity(r).beta_quadratic)
}

/// The slope of alpha: zero at the root of two, positive below, negative above.
#[must_use]
pub fn quantisation_zero(factor: f64) -> Verdict {
    let slope = |ratio: Interval| {
        let [amplitude] = Gradient::variables([ratio]);
        identified(amplitude).alpha.slopes()[0]
    };
    let zero = Interval::two().sqrt() * Interval::point(factor);
    let signs = |[from, to]: [f64; 2], sign: f64| {
        let domain = Interval::new(from, to).map(|domain| [domain]);
        let verdict =
            domain.map(|domain| prove_positive(|[ratio]| slope(*ratio) * Interval::point(sign), domain, 20_000));
        match verdict {
            Some(Ok(Proved { boxes, .. })) => Verdict::Holds(Evidence::Proved {
                domain: format!("sign of the slope, X/x_a in [{from}, {to}]"),
                bound: 0.0,
                boxes,
            }),
            _ => Verdict::undecided("20000 boxes"),
        }
    };
    zeros("unbiased, no delay, X/x_a = sqrt(2)", &[slope(zero)], 1)
        .and(|| signs([1.001, 1.4], 1.0))
        .and(|| signs([1.43, 100.0], -1.0))
}

/// Eq. 41 squared.
#[must_use]
pub fn relative_spread(factor: f64) -> Verdict {
    identity("ratio of the two values", [0.01, 100.0], |second| {
        let first = Series::one();
        let mean = (first + second) / Series::two();
        let square = (first - mean).square() + (second - mean).square();
        let spread = relative_spread_percent(first, second) / Series::from_f64(100.0);
        [Series::from_f64(factor) * square / mean.square() - spread.square()]
    })
}

/// Nomoto's response to a step of the rudder; all but the time's ratio to T scales out.
#[must_use]
pub fn zig_zag(factor: f64) -> Verdict {
    identity("T = 2 s, K = 1/2 per s, unit rudder, others by scaling; time_s", [0.0, 60.0], |t| {
        let (time_constant, gain) = (Series::two(), Series::from_f64(0.5));
        let rate = gain * (Series::one() - (-t / time_constant).exp());
        let (alpha, beta) = (time_constant / gain, Series::from_f64(factor) / gain);
        [alpha * rate.derivative() + beta * rate - Series::one()]
    })
}
