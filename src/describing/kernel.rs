//! The describing function of each kernel: the one place where the piecewise-linear catalogue is integrated.
//!
//! With `u = (at - bias) / amplitude` held to `[-1, 1]` and `phi = acos(u)`, a step above `at` covers the arc of width
//! `2 phi` around the maximum of the input, half of it on each branch. `1 - u` and `phi` are formed from the distances of
//! the breakpoint to the two turning points, so that nothing cancels where the sweep barely passes it; u itself from the
//! distance to the bias.

use super::DescribingFunction;
use crate::nonlinearity::{Branches, Kernel, Side, Sinusoid};
use crate::numeric::Real;

impl<T: Real> DescribingFunction<T> {
    /// Of one kernel under `sweep`.
    #[inline(always)]
    pub(super) fn of(kernel: Kernel<T>, sweep: &Sinusoid<T>) -> Self {
        match kernel {
            Kernel::Constant { value, branches } => constant(sweep.amplitude()).on(branches) * value,
            Kernel::Line { slope } => Self { f0: sweep.bias(), p: T::one(), q: T::zero() } * slope,
            Kernel::Sign { at, level, branches } => Arc::above(at, sweep).sign().on(branches) * level,
            Kernel::Step { at, height, side, branches } => arc(at, sweep, side, Arc::step).on(branches) * height,
            Kernel::Ramp { at, slope, side, branches } => ramp(at, side, branches, sweep) * slope,
            Kernel::Band { origin, lower, upper, slope } => band(origin, lower, upper, sweep) * slope,
        }
    }

    /// Takes what the rising branch alone contributes: the falling branch mirrors it at the maximum.
    #[inline(always)]
    fn on(self, branches: Branches) -> Self {
        match branches {
            Branches::Rising => self,
            Branches::Falling => Self { q: -self.q, ..self },
            Branches::Both => Self { f0: self.f0 + self.f0, p: self.p + self.p, q: T::zero() },
        }
    }
}

fn half<T: Real>() -> T {
    T::from_f64(0.5)
}

/// A constant output.
fn flat<T: Real>(mean: T) -> DescribingFunction<T> {
    DescribingFunction { f0: mean, p: T::zero(), q: T::zero() }
}

/// The constant one on the rising branch.
#[inline(always)]
pub(super) fn constant<T: Real>(amplitude: T) -> DescribingFunction<T> {
    DescribingFunction { f0: half(), p: T::zero(), q: T::two() * T::inverse_pi() / amplitude }
}

/// A kernel on either side of `at`: below is above, of the input turned upside down.
#[inline(always)]
fn arc<T: Real>(
    at: T,
    sweep: &Sinusoid<T>,
    side: Side,
    kernel: impl FnOnce(Arc<T>) -> DescribingFunction<T>,
) -> DescribingFunction<T> {
    match side {
        Side::Above => kernel(Arc::above(at, sweep)),
        Side::Below => {
            let mirrored = kernel(Arc::below(at, sweep));
            DescribingFunction { p: -mirrored.p, ..mirrored }
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
    #[inline(always)]
    fn above(at: T, sweep: &Sinusoid<T>) -> Self {
        Self::new(at - sweep.bias(), sweep.maximum() - at, at - sweep.minimum(), sweep.amplitude())
    }

    #[inline(always)]
    fn below(at: T, sweep: &Sinusoid<T>) -> Self {
        Self::new(sweep.bias() - at, at - sweep.minimum(), sweep.maximum() - at, sweep.amplitude())
    }

    /// From the breakpoint's distances: from the bias, to the turning point on the kernel's side, to the opposite turning point.
    #[inline(always)]
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

    /// `acos(u)`: from the nearer end, or from the middle.
    #[inline(always)]
    fn phi(self) -> T {
        let near_an_end = |end: T| T::two() * (half::<T>() * end).sqrt().asin();
        let [near, far] = [self.one_minus_u, self.one_plus_u];
        (self.u.abs() - half()).prefer(
            #[inline(always)]
            || half::<T>() * T::pi() - self.u.asin(),
            #[inline(always)]
            || {
                self.u.prefer(
                    #[inline(always)]
                    || T::pi() - near_an_end(far),
                    #[inline(always)]
                    || near_an_end(near),
                )
            },
        )
    }

    /// `asin(u)`, towards the ends by way of phi: its derivative then agrees with that of `sin(phi)`.
    #[inline(always)]
    pub(super) fn asin(self) -> T {
        (self.u.abs() - half()).prefer(|| self.u.asin(), || half::<T>() * T::pi() - self.phi())
    }

    #[inline(always)]
    pub(super) fn sign(self) -> DescribingFunction<T> {
        let scale = T::two() * T::inverse_pi() / self.amplitude;
        DescribingFunction { f0: -self.asin() * T::inverse_pi(), p: scale * self.sine, q: -scale * self.u }
    }

    #[inline(always)]
    pub(super) fn step(self) -> DescribingFunction<T> {
        let scale = T::inverse_pi() / self.amplitude;
        DescribingFunction {
            f0: half::<T>() * T::inverse_pi() * self.phi(),
            p: scale * self.sine,
            q: scale * self.one_minus_u,
        }
    }

    /// `sin(phi) - phi cos(phi)` and `phi - sin(phi) cos(phi)` by way of `x - sin(x)`, which small arcs need. The cosine
    /// component only where the other branch does not take it away.
    #[inline(always)]
    pub(super) fn ramp(self, branches: Branches) -> DescribingFunction<T> {
        self.ramp_by(self.phi(), branches)
    }

    /// [`ramp`](Self::ramp) where phi is known.
    #[inline(always)]
    fn ramp_by(self, phi: T, branches: Branches) -> DescribingFunction<T> {
        let scale = half::<T>() * T::inverse_pi();
        let mean = phi * self.one_minus_u - phi.minus_own_sine(self.sine);
        DescribingFunction {
            f0: scale * self.amplitude * mean + half::<T>() * self.beyond,
            p: scale * half() * (phi + phi).minus_own_sine(T::two() * self.sine * self.u),
            q: match branches {
                Branches::Both => T::zero(),
                Branches::Rising | Branches::Falling => {
                    scale * self.one_minus_u.square() + constant(self.amplitude).q * self.beyond
                }
            },
        }
    }
}

/// A unit ramp above `at` on both branches, by the angle `acos(u)` of its breakpoint.
#[cfg(feature = "std")]
pub(crate) fn ramp_by_angle<T: Real>(at: T, phi: T, sweep: &Sinusoid<T>) -> DescribingFunction<T> {
    Arc::above(at, sweep).ramp_by(phi, Branches::Both).on(Branches::Both)
}

/// The input held between two breakpoints, less `origin`.
///
/// Four forms of the same value, each accurate where the rest cancel: a difference of ramps, for a band near either turning
/// point; between them, for a band wider than the amplitude, the whole input less its part outside the band; and from the middle.
#[inline(always)]
fn band<T: Real>(origin: T, lower: T, upper: T, sweep: &Sinusoid<T>) -> DescribingFunction<T> {
    let (bias, amplitude) = (sweep.bias(), sweep.amplitude());
    let near = half::<T>() * amplitude;
    let components = |df: DescribingFunction<T>| [df.f0, df.p];
    // The form from the middle is what most bands take, and worth inlining.
    let [f0, p] = (lower - bias - near).prefer_all(
        #[inline(always)]
        || {
            (bias - upper - near).prefer_all(
                #[inline(always)]
                || {
                    (upper - lower - amplitude).prefer_all(
                        #[inline(always)]
                        || components(band_from_the_middle(origin, lower, upper, sweep)),
                        || components(wide_band(origin, lower, upper, sweep)),
                    )
                },
                || components(band_near_the_minimum(origin, lower, upper, sweep)),
            )
        },
        || components(band_near_the_maximum(origin, lower, upper, sweep)),
    );
    DescribingFunction { f0, p, q: T::zero() }
}

/// A unit ramp.
#[inline(always)]
fn ramp<T: Real>(at: T, side: Side, branches: Branches, sweep: &Sinusoid<T>) -> DescribingFunction<T> {
    let ramp = arc(
        at,
        sweep,
        side,
        #[inline(always)]
        |arc| arc.ramp(branches),
    );
    ramp.on(branches)
}

/// A band as its lower limit and a ramp from there, less a ramp from its upper limit.
#[inline(never)]
pub fn band_near_the_maximum<T: Real>(origin: T, lower: T, upper: T, sweep: &Sinusoid<T>) -> DescribingFunction<T> {
    let ramp = |at| ramp(at, Side::Above, Branches::Both, sweep);
    flat(lower - origin) + ramp(lower) - ramp(upper)
}

/// A band as its upper limit and a ramp down from its lower limit, less one from its upper limit.
#[inline(never)]
fn band_near_the_minimum<T: Real>(origin: T, lower: T, upper: T, sweep: &Sinusoid<T>) -> DescribingFunction<T> {
    let ramp = |at| ramp(at, Side::Below, Branches::Both, sweep);
    flat(upper - origin) + ramp(lower) - ramp(upper)
}

/// A band as the whole input, less what lies outside.
#[inline(never)]
fn wide_band<T: Real>(origin: T, lower: T, upper: T, sweep: &Sinusoid<T>) -> DescribingFunction<T> {
    let ramp = |at, side| ramp(at, side, Branches::Both, sweep);
    let line = DescribingFunction { p: T::one(), ..flat(sweep.bias() - origin) };
    line + ramp(lower, Side::Below) - ramp(upper, Side::Above)
}

/// A band as the middle of its limits, and the rest from there.
#[inline(always)]
pub fn band_from_the_middle<T: Real>(origin: T, lower: T, upper: T, sweep: &Sinusoid<T>) -> DescribingFunction<T> {
    flat(half::<T>() * ((lower - origin) + (upper - origin))) + from_the_middle(lower, upper, sweep)
}

/// A band, less the middle of its breakpoints, from the angles `a`, `b` at which the input passes its ends, by the tangents
/// of `(b - a)/2` and `(b + a)/2`. What is odd in the bias comes from the latter, formed from the sum of the breakpoints.
#[inline(always)]
fn from_the_middle<T: Real>(lower: T, upper: T, sweep: &Sinusoid<T>) -> DescribingFunction<T> {
    let (minimum, maximum) = (sweep.minimum(), sweep.maximum());
    let hold = |at: T| at.max(minimum).min(maximum);
    // Products of two distances would leave the range of floats; a power of two rounds nothing and falls out below.
    let scale = sweep.amplitude().near_reciprocal();
    let distance = |distance: T| (distance * scale).max(T::zero());
    let cosine = |at: T| (distance(at - minimum) * distance(maximum - at)).sqrt();
    let overshoot = |at: T| (at - maximum).max(minimum - at).max(T::zero());
    let (low, high) = (hold(lower), hold(upper));
    let (sum, difference) = ((low + high) - (sweep.bias() + sweep.bias()), high - low);
    let over_cosines = T::one() / (cosine(low) + cosine(high));
    let (of_difference, of_sum) = (difference * scale * over_cosines, sum * scale * over_cosines);
    let (difference_squared, sum_squared) = (of_difference.square(), of_sum.square());
    let sine = of_difference * (T::one() - sum_squared) / ((T::one() + difference_squared) * (T::one() + sum_squared));
    let half_angle = of_difference.atan();
    let share = T::inverse_pi() * (half_angle + sine);
    DescribingFunction {
        f0: T::inverse_pi() * (sum * (of_difference - half_angle) - difference * of_sum.atan())
            + half::<T>() * (overshoot(lower) - overshoot(upper)),
        p: share + share,
        q: T::zero(),
    }
}
