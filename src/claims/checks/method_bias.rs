//! What the first-harmonic method makes of the exact symmetric orbits, enclosed over ranges of the one number `g`.

use crate::identify::iso::{Oscillation, Parameters};
use crate::numeric::{Interval, Real};
use crate::orbit::quadratic_period;

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
pub struct MethodError {
    /// Of the inertia alpha.
    pub alpha: Interval,
    /// Of the drag coefficient, linear or quadratic as the law is.
    pub drag: Interval,
}

/// Below this coordinate the orbit is bracketed by its first terms.
const SMALL: f64 = 0.02;
/// Pieces of a range are halved until their enclosures are narrower.
const RESOLUTION: f64 = 5e-3;
/// At most as often.
const HALVINGS: u32 = 24;

/// An orbit in units that keep it of order one as `g` goes to zero: lengths in `X_m`, times in the coordinate (linear drag)
/// or its square root (quadratic drag).
struct Shape {
    /// `X_m` over the square of the unit of time: the true alpha in these units.
    alpha: Interval,
    period: Interval,
    /// `x_a/X_m`.
    share: Interval,
    /// The same over the coordinate.
    share_rate: Interval,
}

impl SymmetricOrbit {
    /// The number `g` of a coordinate.
    #[must_use]
    pub fn group(self, coordinate: Interval) -> Interval {
        match self {
            Self::Linear => increasing(coordinate, |z| z - z.tanh()),
            Self::Quadratic => increasing(coordinate, |t| t.cosh().ln() / Interval::two()),
        }
    }

    /// The errors over a range of the coordinate; `None` where they are not enclosed.
    #[must_use]
    pub fn error(self, coordinate: Interval) -> Option<MethodError> {
        let shape = match self {
            Self::Linear => linear_shape(coordinate),
            Self::Quadratic => quadratic_shape(coordinate),
        };
        let alpha = shape.identify(shape.share)?.alpha / shape.alpha;
        // The drag found is proportional to the half-width, and the true one to the coordinate.
        let found = shape.identify(shape.share_rate)?;
        let drag = match self {
            Self::Linear => found.beta / shape.alpha,
            Self::Quadratic => found.beta_quadratic / shape.alpha.square(),
        };
        Some(MethodError { alpha: alpha - Interval::ONE, drag: drag - Interval::ONE })
    }

    /// The errors over a range of `g`, at most 700: all that occur, and at most 0.5 % more; `None` where it is empty, negative
    /// or too large.
    ///
    /// ```
    /// use selfosc::claims::method_bias::SymmetricOrbit;
    /// let error = SymmetricOrbit::Linear.error_over(0.99, 1.01).ok_or("a range")?;
    /// assert!(error.alpha.lower() > -0.04 && error.alpha.upper() < -0.02);
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn error_over(self, from: f64, to: f64) -> Option<MethodError> {
        if !(0.0 <= from && from <= to && to <= 700.0) {
            return None;
        }
        self.hull(Interval::new(self.coordinate(from).lower(), self.coordinate(to).upper())?, HALVINGS)
    }

    /// The errors over a range of the coordinate, halved until that gains little.
    fn hull(self, coordinate: Interval, halvings: u32) -> Option<MethodError> {
        let whole = self.error(coordinate);
        let narrow = |error: &MethodError| error.alpha.width() < RESOLUTION && error.drag.width() < RESOLUTION;
        if halvings == 0 || whole.as_ref().is_some_and(narrow) {
            return whole;
        }
        let (lower, upper) = coordinate.bisect();
        let (lower, upper) = (self.hull(lower, halvings - 1)?, self.hull(upper, halvings - 1)?);
        Some(MethodError { alpha: lower.alpha.hull(upper.alpha), drag: lower.drag.hull(upper.drag) })
    }

    /// An enclosure of the coordinate of `g` in [0, 700], by bisection with a sign that is certain.
    fn coordinate(self, g: f64) -> Interval {
        let (mut lower, mut upper) = (0.0, 2.0 * g + 3.0);
        for _ in 0..100 {
            let middle = 0.5 * (lower + upper);
            match self.group(Interval::point(middle)) {
                found if found.upper() <= g => lower = middle,
                found if found.lower() >= g => upper = middle,
                _ => break,
            }
        }
        Interval::new(lower, upper).unwrap_or(Interval::ENTIRE)
    }
}

impl Shape {
    fn identify(&self, half_width: Interval) -> Option<Parameters<Interval>> {
        let read = Oscillation {
            relay_level: Interval::ONE,
            switch_level: half_width,
            amplitude: Interval::ONE,
            bias: Interval::ZERO,
            period_s: self.period,
            delay_s: Interval::ZERO,
        };
        read.identify().ok()
    }
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

/// `X_m = z - ln(1 + tanh z)`, the integral of tanh, `T = 4 z`, `x_a = z - tanh z`, the integral of its square. Their ratio
/// grows with z (`orbit-amplitude-monotone-linear`).
fn linear_shape(z: Interval) -> Shape {
    let period = Interval::point(4.0);
    if z.upper() <= SMALL {
        let alpha = tanh_ratio(z) / Interval::two();
        let share_rate = tanh_ratio(z).square() / (Interval::point(3.0) * alpha);
        return Shape { alpha, period, share: z * share_rate, share_rate };
    }
    let amplitude = |z: Interval| z - z.tanh().ln_1p();
    let share = increasing(z, |z| SymmetricOrbit::Linear.group(z) / amplitude(z));
    Shape { alpha: increasing(z, amplitude) / z.square(), period, share, share_rate: share / z }
}

/// `X_m = t/2`, `x_a = ln(cosh t)/2`, the period by its formula. The ratio of the first two grows with t
/// (`orbit-amplitude-monotone-quadratic`).
fn quadratic_shape(t: Interval) -> Shape {
    let (two, alpha) = (Interval::two(), Interval::point(0.5));
    if t.upper() <= SMALL {
        // atan s + atanh s = 2 s (1 + s^4/5 + s^8/9 + ...) with s^2 = tanh t.
        let (ratio, fourth) = (tanh_ratio(t), Interval::point(t.upper()).square());
        let tail = (fourth / (Interval::point(5.0) * (Interval::ONE - fourth))).hull(Interval::ZERO);
        let period = two * two * ratio.sqrt() * (Interval::ONE + tail);
        let share_rate = ratio / two;
        return Shape { alpha, period, share: t * share_rate, share_rate };
    }
    let share = increasing(t, |t| two * SymmetricOrbit::Quadratic.group(t) / t);
    let period = two * increasing(t, |t| quadratic_period(SymmetricOrbit::Quadratic.group(t))) / t.sqrt();
    Shape { alpha, period, share, share_rate: share / t }
}
