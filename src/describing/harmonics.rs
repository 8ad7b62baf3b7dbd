//! Mean and first harmonic of each kernel: the one place where the piecewise-linear catalogue is integrated.
//!
//! With `u = (at - bias) / amplitude` held to `[-1, 1]` and `phi = acos(u)`, a step above `at` covers the arc of width
//! `2 phi` around the maximum of the input, half of it on each branch. `1 - u` and `phi` are formed from the distances of
//! the breakpoint to the two turning points, so that nothing cancels where the sweep barely passes it; u itself from the
//! distance to the bias.

use core::cell::OnceCell;
use core::ops::{Add, Mul, Sub};

use crate::nonlinearity::{Branches, Kernel, Side, Sinusoid};
use crate::numeric::Real;

/// `mean + sine sin(theta) + cosine cos(theta)`: output units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Harmonics<T> {
    pub(super) mean: T,
    pub(super) sine: T,
    pub(super) cosine: T,
}

impl<T: Real> Add for Harmonics<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { mean: self.mean + other.mean, sine: self.sine + other.sine, cosine: self.cosine + other.cosine }
    }
}

impl<T: Real> Sub for Harmonics<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + other * -T::one()
    }
}

impl<T: Real> Mul<T> for Harmonics<T> {
    type Output = Self;
    fn mul(self, factor: T) -> Self {
        Self { mean: self.mean * factor, sine: self.sine * factor, cosine: self.cosine * factor }
    }
}

impl<T: Real> Harmonics<T> {
    pub(super) fn zero() -> Self {
        Self { mean: T::zero(), sine: T::zero(), cosine: T::zero() }
    }

    /// Of one kernel under `sweep`.
    pub(super) fn of(kernel: Kernel<T>, sweep: &Sinusoid<T>) -> Self {
        match kernel {
            Kernel::Constant { value, branches } => constant().on(branches) * value,
            Kernel::Line { slope } => Self { mean: sweep.bias(), sine: sweep.amplitude(), cosine: T::zero() } * slope,
            Kernel::Sign { at, level, branches } => Arc::above(at, sweep).sign().on(branches) * level,
            Kernel::Step { at, height, side, branches } => arc(at, sweep, side, Arc::step).on(branches) * height,
            Kernel::Ramp { at, slope, side, branches } => arc(at, sweep, side, Arc::ramp).on(branches) * slope,
            Kernel::Band { origin, lower, upper, slope } => band(origin, lower, upper, sweep) * slope,
        }
    }

    /// Takes what the rising branch alone contributes: the falling branch mirrors it at the maximum.
    fn on(self, branches: Branches) -> Self {
        match branches {
            Branches::Rising => self,
            Branches::Falling => Self { cosine: -self.cosine, ..self },
            Branches::Both => Self { mean: self.mean + self.mean, sine: self.sine + self.sine, cosine: T::zero() },
        }
    }
}

/// The constant one on the rising branch.
pub(super) fn constant<T: Real>() -> Harmonics<T> {
    Harmonics { mean: T::from_f64(0.5), sine: T::zero(), cosine: T::two() / T::pi() }
}

/// A kernel on either side of `at`: below is above, of the input turned upside down.
fn arc<T: Real>(at: T, sweep: &Sinusoid<T>, side: Side, kernel: fn(Arc<T>) -> Harmonics<T>) -> Harmonics<T> {
    match side {
        Side::Above => kernel(Arc::above(at, sweep)),
        Side::Below => {
            let mirrored = kernel(Arc::below(at, sweep));
            Harmonics { sine: -mirrored.sine, ..mirrored }
        }
    }
}

/// The part of the rising branch on which the input is beyond a breakpoint.
#[derive(Clone, Copy)]
pub(super) struct Arc<T> {
    amplitude: T,
    /// In `[-1, 1]`.
    pub(super) u: T,
    /// `1 - u` and `1 + u`, both in `[0, 2]`.
    one_minus_u: T,
    one_plus_u: T,
    /// `sin(phi)`.
    pub(super) sine: T,
    /// How far the breakpoint lies outside the sweep on the far side, in input units: the kernel then never rests.
    beyond: T,
}

impl<T: Real> Arc<T> {
    fn above(at: T, sweep: &Sinusoid<T>) -> Self {
        Self::new(at - sweep.bias(), sweep.maximum() - at, at - sweep.minimum(), sweep.amplitude())
    }

    fn below(at: T, sweep: &Sinusoid<T>) -> Self {
        Self::new(sweep.bias() - at, at - sweep.minimum(), sweep.maximum() - at, sweep.amplitude())
    }

    /// From the breakpoint's distances: from the bias, to the turning point on the kernel's side, to the one on the other.
    pub(super) fn new(middle: T, near: T, far: T, amplitude: T) -> Self {
        let hold = |distance: T| (distance / amplitude).max(T::zero()).min(T::two());
        let (one_minus_u, one_plus_u) = (hold(near), hold(far));
        let sine = (one_minus_u * one_plus_u).sqrt();
        Self {
            amplitude,
            u: (middle / amplitude).clamp_unit(),
            one_minus_u,
            one_plus_u,
            sine,
            beyond: (-far).max(T::zero()),
        }
    }

    /// `acos(u)` from the nearer end.
    fn phi(self) -> T {
        let from = |end: T| T::two() * (end / T::two()).sqrt().asin();
        (self.one_plus_u - self.one_minus_u).select(|| T::pi() - from(self.one_plus_u), || from(self.one_minus_u))
    }

    /// `asin(u)`, towards the ends by way of phi: its derivative then agrees with that of `sin(phi)`.
    pub(super) fn asin(self) -> T {
        let quarter = T::pi() / T::two();
        (self.u.abs() - T::from_f64(0.5)).select(|| self.u.asin(), || quarter - self.phi())
    }

    pub(super) fn sign(self) -> Harmonics<T> {
        let pi = T::pi();
        Harmonics { mean: -self.asin() / pi, sine: T::two() * self.sine / pi, cosine: -T::two() * self.u / pi }
    }

    pub(super) fn step(self) -> Harmonics<T> {
        let pi = T::pi();
        Harmonics { mean: self.phi() / (pi + pi), sine: self.sine / pi, cosine: self.one_minus_u / pi }
    }

    /// `sin(phi) - phi cos(phi)` and `phi - sin(phi) cos(phi)` by way of `x - sin(x)`, which small arcs need.
    pub(super) fn ramp(self) -> Harmonics<T> {
        let phi = self.phi();
        let twice = phi + phi;
        let scale = self.amplitude / (T::two() * T::pi());
        let half = T::from_f64(0.5);
        Harmonics {
            mean: scale * (phi * self.one_minus_u - phi.minus_sine(self.sine)) + half * self.beyond,
            sine: scale * half * twice.minus_sine(T::two() * self.sine * self.u),
            cosine: scale * self.one_minus_u.square() + constant::<T>().cosine * self.beyond,
        }
    }
}

/// The input held between two breakpoints, less `origin`.
///
/// Four forms of one value, each accurate where the others cancel: a difference of ramps, for a band near either turning
/// point; between them, for a band wider than the amplitude, the whole input less what lies outside; and from the middle.
fn band<T: Real>(origin: T, lower: T, upper: T, sweep: &Sinusoid<T>) -> Harmonics<T> {
    let (low, high) = (Arc::above(lower, sweep), Arc::above(upper, sweep));
    let ramp = |at, side| arc(at, sweep, side, Arc::ramp).on(Branches::Both);
    let flat = |mean: T| Harmonics { mean, sine: T::zero(), cosine: T::zero() };
    // Each at most once: selecting the mean and selecting the harmonic ask for the same.
    let cells = [const { OnceCell::new() }; 4];
    let [wide, near_maximum, near_minimum, middle] = &cells;
    let line = Harmonics { sine: sweep.amplitude(), ..flat(sweep.bias() - origin) };
    let wide = || *wide.get_or_init(|| line + ramp(lower, Side::Below) - ramp(upper, Side::Above));
    let near_maximum =
        || *near_maximum.get_or_init(|| flat(lower - origin) + ramp(lower, Side::Above) - ramp(upper, Side::Above));
    let near_minimum =
        || *near_minimum.get_or_init(|| flat(upper - origin) + ramp(lower, Side::Below) - ramp(upper, Side::Below));
    let centre = ((lower - origin) + (upper - origin)) / T::two();
    let middle = || *middle.get_or_init(|| from_the_middle(low, high, lower, upper, sweep) + flat(centre));

    let (half, width) = (T::from_f64(0.5), (upper - lower) / sweep.amplitude());
    let component = |pick: fn(Harmonics<T>) -> T| {
        let inner = || (width - T::one()).select(|| pick(middle()), || pick(wide()));
        (low.u - half).select(|| (-half - high.u).select(inner, || pick(near_minimum())), || pick(near_maximum()))
    };
    Harmonics {
        mean: component(|harmonics| harmonics.mean),
        sine: component(|harmonics| harmonics.sine),
        cosine: T::zero(),
    }
}

/// A band, less the middle of its breakpoints, by sums and differences of the two angles `asin(u)`; what is odd in the bias
/// comes from their sum, which is formed from the sum of the breakpoints.
fn from_the_middle<T: Real>(low: Arc<T>, high: Arc<T>, lower: T, upper: T, sweep: &Sinusoid<T>) -> Harmonics<T> {
    let (pi, two, half) = (T::pi(), T::two(), T::from_f64(0.5));
    let overshoot = |at: T| (at - sweep.maximum()).max(sweep.minimum() - at).max(T::zero()) / two;
    let (low_angle, high_angle) = (low.asin(), high.asin());
    let difference = low.u - high.u;
    // With a breakpoint outside the sweep the bias is not small, and nothing cancels.
    let inside = (low.sine * high.sine).select(T::zero, T::one);
    let sum = inside.select(|| low.u + high.u, || ((lower + upper) - two * sweep.bias()) / sweep.amplitude());
    let sines = low.sine + high.sine;
    let angle_sum = (sum.abs() - half)
        .select(|| (half * sum * (sines + difference.square() / sines)).clamp_unit().asin(), || low_angle + high_angle);
    let mean = sum * ((low_angle - high_angle) / two - difference / sines) + difference * angle_sum / two;
    Harmonics {
        mean: sweep.amplitude() * mean / pi + overshoot(lower) - overshoot(upper),
        sine: sweep.amplitude() * (high_angle + high.u * high.sine - low_angle - low.u * low.sine) / pi,
        cosine: T::zero(),
    }
}
