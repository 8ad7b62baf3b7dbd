//! Errors of the first-harmonic method on the exact symmetric orbits, enclosed over ranges of their single number `g`.

use crate::identify::iso::{Oscillation, Parameters};
use crate::numeric::{Interval, Real};
use crate::proof::Expression;

/// A drag law, with the coordinate that unrolls its orbits: `z` of `g = z - tanh z` for linear drag, `t` of
/// `g = ln(cosh t)/2` for quadratic drag (`tanh t = y*`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymmetricOrbit {
    /// Force proportional to speed, `g = x_a beta^2/(C alpha)`.
    Linear,
    /// Force proportional to speed squared, `g = x_a beta/alpha`.
    Quadratic,
}

/// Relative errors of the method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MethodError<T = Interval> {
    /// Of the inertia alpha.
    pub alpha: T,
    /// Of the drag coefficient, linear or quadratic as the law is.
    pub drag: T,
}

/// Below this coordinate the orbit is bracketed by its first terms.
const SMALL: f64 = 0.02;

/// An orbit in units that keep it of order 1 as `g` goes to zero: lengths in `X_m`, times in the coordinate (linear
/// drag) or its square root (quadratic drag).
struct ScaledOrbit<T> {
    /// `X_m` over the square of the unit of time: the true alpha in these units.
    alpha: T,
    period: T,
    /// `x_a/X_m`.
    share: T,
    /// The same over the coordinate.
    share_rate: T,
}

impl SymmetricOrbit {
    /// The number `g` of a coordinate.
    #[must_use]
    pub fn group(self, coordinate: Interval) -> Interval {
        match self {
            Self::Linear => increasing(coordinate, |z| z - z.tanh()),
            Self::Quadratic => increasing(coordinate, |t| log_cosh(t) / Interval::two()),
        }
    }

    /// The errors over a range of the coordinate; `None` where they are not enclosed.
    #[must_use]
    pub fn error(self, coordinate: Interval) -> Option<MethodError> {
        let shape = match self {
            Self::Linear => linear_shape(coordinate),
            Self::Quadratic => quadratic_shape(coordinate),
        };
        shape.error(self, read)
    }

    /// The errors as formulas of the coordinate, to print. At zero they are 0/0; [`error`](Self::error) takes the limit there.
    pub(crate) fn formula(self, coordinate: Expression) -> Option<MethodError<Expression>> {
        let shape = match self {
            Self::Linear => linear_orbit(coordinate),
            Self::Quadratic => quadratic_orbit(coordinate),
        };
        // The method asks whether the half-width is below the amplitude: of symbols in that order, then of their values.
        let symbol = |name, upper| Some(Expression::symbol(name, name, Interval::new(f64::MIN_POSITIVE, upper)?));
        let found = read(symbol("half_width", 0.5)?, symbol("period", 10.0)?)?;
        shape.error(self, |half_width, period| {
            let stands = |name: &str| match name {
                "half_width" => Some(half_width),
                "period" => Some(period),
                _ => None,
            };
            let [alpha, beta, beta_quadratic, disturbance] =
                [found.alpha, found.beta, found.beta_quadratic, found.disturbance].map(|part| part.value(&stands));
            Some(Parameters { alpha: alpha?, beta: beta?, beta_quadratic: beta_quadratic?, disturbance: disturbance? })
        })
    }
}

impl<T: Real> ScaledOrbit<T> {
    /// The errors of the method's parameters from the half-width and the period.
    fn error(&self, law: SymmetricOrbit, read: impl Fn(T, T) -> Option<Parameters<T>>) -> Option<MethodError<T>> {
        let alpha = read(self.share, self.period)?.alpha / self.alpha;
        // The drag found is proportional to the half-width, and the true drag to the coordinate.
        let found = read(self.share_rate, self.period)?;
        let drag = match law {
            SymmetricOrbit::Linear => found.beta / self.alpha,
            SymmetricOrbit::Quadratic => found.beta_quadratic / self.alpha.square(),
        };
        Some(MethodError { alpha: alpha - T::one(), drag: drag - T::one() })
    }
}

/// The method on an unbiased oscillation without delay, by half-width and period; the amplitude and the level are 1.
fn read<T: Real>(half_width: T, period_s: T) -> Option<Parameters<T>> {
    let (one, zero) = (T::one(), T::zero());
    let (relay_level, switch_level) = (one, half_width);
    Oscillation { relay_level, switch_level, amplitude: one, bias: zero, period_s, delay_s: zero }.identify().ok()
}

/// Values of an increasing function, from its endpoints.
fn increasing(at: Interval, function: impl Fn(Interval) -> Interval) -> Interval {
    function(Interval::point(at.lower())).hull(function(Interval::point(at.upper())))
}

/// `tanh(x)/x` between zero and the end of `at`.
fn tanh_ratio(at: Interval) -> Interval {
    let tangent = Interval::point(at.upper()).tanh();
    (Interval::ONE - tangent.square()).hull(Interval::ONE)
}

/// `ln(cosh t)`, the integral of tanh.
fn log_cosh<T: Real>(t: T) -> T {
    t - t.tanh().ln_1p()
}

/// `X_m = ln(cosh z)`, `T = 4 z`, `x_a = z - tanh z`, the integral of tanh squared.
fn linear_orbit<T: Real>(z: T) -> ScaledOrbit<T> {
    let share = (z - z.tanh()) / log_cosh(z);
    ScaledOrbit { alpha: log_cosh(z) / z.square(), period: T::from_f64(4.0), share, share_rate: share / z }
}

/// `X_m = t/2`, `x_a = ln(cosh t)/2`, `T = 2 (atan s + atanh s)` with `s^2 = tanh t`.
fn quadratic_orbit<T: Real>(t: T) -> ScaledOrbit<T> {
    let share = log_cosh(t) / t;
    ScaledOrbit { alpha: T::from_f64(0.5), period: T::two() * turn(t) / t.sqrt(), share, share_rate: share / t }
}

/// `atan s + atanh s`; `atanh s = ln(1 + s) + (t + ln(cosh t))/2`, since `1 - tanh t = exp(-t)/cosh t`.
fn turn<T: Real>(t: T) -> T {
    let s = t.tanh().sqrt();
    s.atan() + s.ln_1p() + (t + log_cosh(t)) / T::two()
}

/// [`linear_orbit`] over a range; `x_a/X_m` grows with z (`orbit-amplitude-monotone-linear`).
fn linear_shape(z: Interval) -> ScaledOrbit<Interval> {
    let period = Interval::point(4.0);
    if z.upper() <= SMALL {
        let alpha = tanh_ratio(z) / Interval::two();
        let share_rate = tanh_ratio(z).square() / (Interval::point(3.0) * alpha);
        return ScaledOrbit { alpha, period, share: z * share_rate, share_rate };
    }
    let share = increasing(z, |z| linear_orbit(z).share);
    ScaledOrbit { alpha: increasing(z, log_cosh) / z.square(), period, share, share_rate: share / z }
}

/// [`quadratic_orbit`] over a range; `x_a/X_m` grows with t (`orbit-amplitude-monotone-quadratic`).
fn quadratic_shape(t: Interval) -> ScaledOrbit<Interval> {
    let (two, alpha) = (Interval::two(), Interval::point(0.5));
    if t.upper() <= SMALL {
        // atan s + atanh s = 2 s (1 + s^4/5 + s^8/9 + ...) with s^2 = tanh t.
        let (ratio, fourth) = (tanh_ratio(t), Interval::point(t.upper()).square());
        let tail = (fourth / (Interval::point(5.0) * (Interval::ONE - fourth))).hull(Interval::ZERO);
        let period = two * two * ratio.sqrt() * (Interval::ONE + tail);
        let share_rate = ratio / two;
        return ScaledOrbit { alpha, period, share: t * share_rate, share_rate };
    }
    let share = increasing(t, |t| quadratic_orbit(t).share);
    ScaledOrbit { alpha, period: two * increasing(t, turn) / t.sqrt(), share, share_rate: share / t }
}
