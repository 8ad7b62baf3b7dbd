//! Moments of a power of a biased sine, in every arithmetic.
//!
//! With `f(x) = sgn(x) abs(x)^p`: the mean `m(u) = <f(u + sin)>` and the sine component `h(u) = <sin f(u + sin)>`. m obeys
//! `(1 - u^2) m'' + (2p - 1) u m' - p^2 m = 0`, a hypergeometric equation, and `(1 + p) h = (1 - u^2) m' + p u m`. Three
//! series cover all u: about 0, about 1 and about infinity (DLMF 15.2, 15.8, 15.10). Nearly all of their terms have the same sign.

mod constants;
mod series;

pub(crate) use series::STEEP;
pub use series::{INNER, OUTER};
#[cfg(feature = "std")]
pub(crate) use series::{analytic_step, paired_step, step};

use series::{Known, Moments};

use super::{Interval, Jet, Real, Scalar};

/// An exponent, with the constants of the series by it alone: constants of two gamma functions, enclosed once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerMoments {
    /// NaN where the exponent is an interval: every moment is then unknown.
    exponent: f64,
    /// `m'(0)`.
    slope_at_zero: Known,
    /// `m(1)`.
    at_one: Known,
    /// Of the series about 1, where it serves.
    pairs: SeriesStarts,
}

/// Where the pairs of the series about 1 start, and the weights of the part that is not analytic there.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SeriesStarts {
    b: Known,
    d: Known,
    /// Weight and excess within the sweep, then beyond it.
    sides: [[Known; 2]; 2],
}

/// Share of a sum below which its terms are enclosed together: the sum's width by rounding.
const ENCLOSED: f64 = 1e-14;

impl PowerMoments {
    /// Of the exponent between these bounds, `>= 0`. Only an exponent that is a single number has moments.
    ///
    /// ```
    /// use selfosc::numeric::{Interval, power::PowerMoments, special::Special};
    /// let square = PowerMoments::new((2.0, 2.0));
    /// let [mean, first] = Interval::power_moments(&square, Interval::ZERO, Interval::ONE);
    /// let quadratic_drag = 4.0 / (3.0 * core::f64::consts::PI);
    /// assert!(mean.contains(0.0) && first.contains(quadratic_drag) && first.width() < 1e-14);
    /// ```
    #[must_use]
    pub fn new((lower, upper): (f64, f64)) -> Self {
        let exponent = if lower < upper { f64::NAN } else { lower };
        constants::of(exponent)
    }

    /// `p + 1/2 = order + delta`, delta at most a half: the exponent of the part that is not analytic at u = 1.
    fn order_and_delta<T: Real>(exponent: f64) -> (f64, T) {
        let whole = libm::floor(exponent);
        (whole + 1.0, T::from_f64(exponent - whole) - T::from_f64(0.5))
    }

    /// The series that serves, and its sum; `bias >= 0`, neither number wider than rounding, nor their difference of
    /// unknown sign; terms below that share of a sum are omitted, or enclosed.
    #[inline]
    fn of_sweep<T: Real>(&self, bias: T, amplitude: T, share: f64) -> ScaledMoments<T> {
        let (u, room) = (bias / amplitude, amplitude - bias);
        let at = u.bounds().0;
        let beyond = at > OUTER || (self.exponent >= STEEP && room.bounds().1 < 0.0);
        let moments = if beyond {
            self.about_infinity(amplitude / bias, share)
        } else if at < INNER || self.exponent >= STEEP {
            self.about_zero(u, share)
        } else {
            self.about_one(u, T::from_f64(0.5) * (room / amplitude), share)
        };
        ScaledMoments { beyond, moments }
    }

    /// As [`of_sweep`](Self::of_sweep) for intervals of any width and sign.
    fn of_any(&self, bias: Interval, amplitude: Interval) -> ScaledMoments<Interval> {
        /// Relative width of a ratio that is exact but for rounding.
        const THIN: f64 = 1e-14;
        if self.exponent.is_nan() {
            let [m, m_slope, h, h_slope] = [Interval::ENTIRE; 4];
            return ScaledMoments { beyond: false, moments: Moments { m, m_slope, h, h_slope } };
        }
        if bias.is_negative() {
            let ScaledMoments { beyond, moments } = self.of_any(-bias, amplitude);
            let moments = Moments { m: -moments.m, h_slope: -moments.h_slope, ..moments };
            return ScaledMoments { beyond, moments };
        }
        let (u, room) = (bias / amplitude, amplitude - bias);
        let decided = !room.contains_zero() || room == Interval::ZERO;
        if decided && bias.lower() >= 0.0 && u.width() <= THIN * (1.0 + u.lower()) {
            return self.of_sweep(bias, amplitude, ENCLOSED);
        }
        let ([m, h], p) = (self.over(u), Interval::point(self.exponent));
        let m_slope = ((Interval::ONE + p) * h - p * u * m) / ((Interval::ONE - u) * (Interval::ONE + u));
        ScaledMoments { beyond: false, moments: Moments { m, m_slope, h, h_slope: p * m - u * m_slope } }
    }

    /// m and h over an interval of any width, in units of the amplitude to the exponent. m grows with u, as f does; h grows with
    /// `abs(u)` where `f'` grows with `abs(x)`, from exponent 1 on, and else falls: `h' = <sin (f'(u + sin) - f'(u - sin))>/2`.
    fn over(&self, u: Interval) -> [Interval; 2] {
        if !u.is_bounded() {
            return [Interval::ENTIRE; 2];
        }
        let at = |u: f64| {
            let ScaledMoments { beyond, moments } = self.of_sweep(Interval::point(u.abs()), Interval::ONE, ENCLOSED);
            let scale = Interval::point(if beyond { u.abs() } else { 1.0 }).pow(Interval::point(self.exponent));
            [if u < 0.0 { -moments.m } else { moments.m } * scale, moments.h * scale]
        };
        let ([low, first], [high, last]) = (at(u.lower()), at(u.upper()));
        let h = first.hull(last);
        [low.hull(high), if u.contains_zero() { h.hull(at(0.0)[1]) } else { h }]
    }
}

/// Moments in units of the amplitude to the exponent or, beyond, of the bias to the exponent; their derivatives are by
/// `bias/amplitude` or `amplitude/bias`.
struct ScaledMoments<T> {
    beyond: bool,
    moments: Moments<T>,
}

/// Floats and dual numbers: the exponent counts as a constant.
pub(super) fn of_scalar<T: Scalar>(law: &PowerMoments, bias: T, amplitude: T) -> [T; 2] {
    let negative = bias < T::zero();
    let bias = if negative { -bias } else { bias };
    let ScaledMoments { beyond, moments } = law.of_sweep(bias.value(), amplitude.value(), f64::EPSILON);
    let (reference, ratio) = if beyond { (bias, amplitude / bias) } else { (amplitude, bias / amplitude) };
    let scale = reference.pow(T::from_f64(law.exponent));
    let mean = scale * ratio.lift(moments.m, moments.m_slope);
    [if negative { -mean } else { mean }, scale * ratio.lift(moments.h, moments.h_slope)]
}

/// Intervals.
pub(super) fn of_interval(law: &PowerMoments, bias: Interval, amplitude: Interval) -> [Interval; 2] {
    let ScaledMoments { beyond, moments } = law.of_any(bias, amplitude);
    let scale = if beyond { bias.abs() } else { amplitude }.pow(Interval::point(law.exponent));
    [scale * moments.m, scale * moments.h]
}

/// Jets. Not smooth where the sweep may end at zero.
pub(super) fn of_jet<const N: usize>(law: &PowerMoments, bias: Jet<N>, amplitude: Jet<N>) -> [Jet<N>; 2] {
    let p = Interval::point(law.exponent);
    let u = bias / amplitude;
    let ScaledMoments { beyond, moments: Moments { m, m_slope, h, .. } } = law.of_any(bias.value(), amplitude.value());
    let start = if beyond {
        let ratio = u.value();
        let (size, v) = (ratio.abs(), Interval::ONE / ratio);
        let scale = size.pow(p);
        [m * scale, (p * m - v * m_slope) * v * scale, h * scale]
    } else {
        [m, m_slope, h]
    };
    let scale = amplitude.pow(Jet::constant(p));
    u.power_moments(start, p).map(|moment| scale * moment)
}
