//! The functions of `Real` and `Special`.

use super::{Format, Rounded, farthest, up};
use crate::numeric::power::PowerMoments;
use crate::numeric::{Interval, Real, Special, own_sine_series};

/// Relative error of the series of `x - sin(x)` for x < 1: truncation, and rounding of its constants to double precision.
const SERIES: f64 = 3e-16;
/// The assumed errors of `bessel_j`, of size 1 at most, and of the moments of a power in double precision, in half
/// epsilons: of 1, and of the larger moment. A value from it that is rounded to single precision has this error too.
const BESSEL: f64 = 8.0;
const BESSEL_SCALED: f64 = 8.0;
const MOMENTS: f64 = 64.0;
const DOUBLE_UNIT: f64 = f64::EPSILON / 2.0;

impl<F: Format> Rounded<F> {
    /// A function, its largest slope over an interval of arguments, and its error in units in the last place.
    fn function(
        self,
        function: impl Fn(Interval) -> Interval,
        slope: impl Fn(Interval) -> Interval,
        units: f64,
    ) -> Self {
        let (exact, unrounded) = (function(self.exact), function(self.float));
        // No error came in, and none is passed on, however steep the function is.
        let passed_on = if self.error > 0.0 { up(slope(self.hull()).magnitude() * self.error) } else { 0.0 };
        // A unit in the last place is at most an epsilon of the number.
        Self::of(exact, unrounded, passed_on, 2.0 * F::UNIT * units)
    }
}

fn one() -> Interval {
    Interval::ONE
}

impl<F: Format> Real for Rounded<F> {
    fn from_f64(value: f64) -> Self {
        let (exact, float) = (Interval::point(value), Interval::point(F::nearest(value)));
        Self { error: farthest(exact, float), float, ..Self::input(exact) }
    }
    fn pi() -> Self {
        let float = Interval::point(F::nearest(core::f64::consts::PI));
        Self { error: farthest(Interval::PI, float), float, ..Self::input(Interval::PI) }
    }
    fn inverse_pi() -> Self {
        let float = Interval::point(F::nearest(core::f64::consts::FRAC_1_PI));
        Self { error: farthest(Interval::INVERSE_PI, float), float, ..Self::input(Interval::INVERSE_PI) }
    }
    /// Bounds that hold for the float and for the exact value.
    fn bounds(self) -> (f64, f64) {
        self.hull().bounds()
    }
    fn vanishes(self) -> bool {
        self.exact == Interval::ZERO && self.float == Interval::ZERO
    }
    fn abs(self) -> Self {
        Self { exact: self.exact.abs(), float: self.float.abs(), ..self }
    }
    fn min(self, other: Self) -> Self {
        -(-self).max(-other)
    }
    fn max(self, other: Self) -> Self {
        if self.float.lower() >= other.float.upper() && self.exact.lower() >= other.exact.upper() {
            return self;
        }
        if other.float.lower() >= self.float.upper() && other.exact.lower() >= self.exact.upper() {
            return other;
        }
        let (exact, float) = (self.exact.max(other.exact), self.float.max(other.float));
        Self { exact, float, error: self.error.max(other.error), ..self }
    }
    fn square(self) -> Self {
        let slope = up(self.exact.magnitude() + self.float.magnitude());
        Self::of(self.exact.square(), self.float.square(), up(slope * self.error), F::UNIT)
    }
    fn sqrt(self) -> Self {
        let (exact, unrounded) = (self.exact.sqrt(), self.float.sqrt());
        // sqrt(a') - sqrt(a) = (a' - a)/(sqrt(a') + sqrt(a)), and at most the root of the difference.
        let below = exact.lower() + unrounded.lower();
        let passed_on = if self.error > 0.0 { up(self.error / below).min(up(libm::sqrt(self.error))) } else { 0.0 };
        Self::of(exact, unrounded, passed_on, F::UNIT)
    }
    fn sin(self) -> Self {
        self.function(Interval::sin, |_| one(), F::FUNCTIONS.sin_cos)
    }
    fn cos(self) -> Self {
        self.function(Interval::cos, |_| one(), F::FUNCTIONS.sin_cos)
    }
    fn tan(self) -> Self {
        self.function(Interval::tan, |x| one() + x.tan().square(), F::FUNCTIONS.tan)
    }
    fn asin(self) -> Self {
        let units = F::FUNCTIONS.asin;
        let slope = |x: Interval| one() / ((one() - x) * (one() + x)).sqrt();
        let (exact, unrounded) = (self.exact.asin(), self.float.asin());
        // Two numbers of [-1, 1] that are e apart have inverse sines at most pi sqrt(e/2) apart.
        let most = up(core::f64::consts::PI * libm::sqrt(self.error / 2.0));
        let by_slope = up(slope(self.hull()).magnitude() * self.error);
        let passed_on = if self.error > 0.0 { most.min(by_slope) } else { 0.0 };
        Self::of(exact, unrounded, passed_on, 2.0 * F::UNIT * units)
    }
    fn atan(self) -> Self {
        self.function(Interval::atan, |x| one() / (one() + x.square()), F::FUNCTIONS.atan)
    }
    fn exp(self) -> Self {
        self.function(Interval::exp, Interval::exp, F::FUNCTIONS.exp)
    }
    fn exp_m1(self) -> Self {
        self.function(Interval::exp_m1, Interval::exp, F::FUNCTIONS.exp)
    }
    fn ln(self) -> Self {
        self.function(Interval::ln, |x| one() / x, F::FUNCTIONS.ln)
    }
    fn ln_1p(self) -> Self {
        self.function(Interval::ln_1p, |x| one() / (one() + x), F::FUNCTIONS.ln)
    }
    fn sinh(self) -> Self {
        self.function(Interval::sinh, Interval::cosh, F::FUNCTIONS.hyperbolic)
    }
    fn cosh(self) -> Self {
        self.function(Interval::cosh, Interval::sinh, F::FUNCTIONS.hyperbolic)
    }
    fn tanh(self) -> Self {
        self.function(Interval::tanh, |x| one() - x.tanh().square(), F::FUNCTIONS.hyperbolic)
    }
    fn atanh(self) -> Self {
        self.function(Interval::atanh, |x| one() / (one() - x.square()), F::FUNCTIONS.hyperbolic)
    }
    fn pow(self, exponent: Self) -> Self {
        let (exact, unrounded) = (self.exact.pow(exponent.exact), self.float.pow(exponent.float));
        let by_base = exponent.hull() * self.hull().pow(exponent.hull() - one());
        let by_exponent = self.hull().ln() * self.hull().pow(exponent.hull());
        let of = |slope: Interval, error: f64| if error > 0.0 { up(slope.magnitude() * error) } else { 0.0 };
        let passed_on = up(of(by_base, self.error) + of(by_exponent, exponent.error));
        Self::of(exact, unrounded, passed_on, 2.0 * F::UNIT * F::FUNCTIONS.pow)
    }
    fn floor(self) -> Self {
        let (exact, float) = (self.exact.floor(), self.float.floor());
        let error = if exact.is_point() && exact == float { 0.0 } else { farthest(exact, float) };
        Self { exact, float, error, ..self }
    }
    fn select_all<const N: usize>(
        self,
        below: impl FnOnce() -> [Self; N],
        above: impl FnOnce() -> [Self; N],
    ) -> [Self; N] {
        match self.side() {
            Some(true) => above(),
            Some(false) => below(),
            None => {
                let (below, above) = (below(), above());
                core::array::from_fn(|k| {
                    let (a, b) = (below[k], above[k]);
                    let apart = farthest(a.exact, b.float).max(farthest(b.exact, a.float));
                    // Where no error came in, float and exact value take the same side.
                    a.either(b, if self.error > 0.0 { apart } else { 0.0 })
                })
            }
        }
    }
    /// The exact values of both expressions are equal: either float is as near to it as it is to its own.
    fn prefer_all<const N: usize>(
        self,
        below: impl FnOnce() -> [Self; N],
        above: impl FnOnce() -> [Self; N],
    ) -> [Self; N] {
        match self.side() {
            Some(true) => above(),
            Some(false) => below(),
            None => {
                let (below, above) = (below(), above());
                core::array::from_fn(|k| {
                    let either = below[k].either(above[k], 0.0);
                    let exact = below[k].exact.intersection(above[k].exact);
                    Self { exact: exact.unwrap_or(either.exact), ..either }
                })
            }
        }
    }
    fn inflate(self, error: f64) -> Self {
        Self { exact: self.exact.inflate(error), error: up(self.error + error.abs()), ..self }
    }
    fn minus_own_sine(self, sine: Self) -> Self {
        let near = || {
            let series = own_sine_series(self);
            let exact = self.exact.minus_own_sine(sine.exact);
            let left_out = up(SERIES * series.exact.magnitude());
            // The input's error is passed on by the slope 1 - cos(x), below x^2/2, and is in the series' error already.
            [Self { exact, error: up(series.error + left_out), ..series }]
        };
        let [difference] = (Self::one() - self)
            .prefer_all(|| [Self { exact: self.exact.minus_own_sine(sine.exact), ..self - sine }], near);
        difference
    }
}

impl<F: Format> Rounded<F> {
    /// Whether float and exact value are above zero, both or neither; `None` where they may differ, or the numbers do.
    fn side(self) -> Option<bool> {
        let both = self.hull();
        if both.is_positive() {
            Some(true)
        } else if both.upper() <= 0.0 {
            Some(false)
        } else {
            None
        }
    }

    /// A double-precision result with an error of `units` half epsilons of `size`, rounded to the format.
    fn special(self, exact: Interval, unrounded: Interval, slope: f64, size: f64, units: f64) -> Self {
        let own = up(units * DOUBLE_UNIT * size);
        let rounded = Self::of(exact, unrounded, up(slope * self.error), F::UNIT);
        Self { error: up(rounded.error + own), float: rounded.float + Interval::symmetric(own), ..rounded }
    }
}

impl<F: Format> Special for Rounded<F> {
    fn bessel_j(self) -> [Self; 2] {
        let (exact, float) = (self.exact.bessel_j(), self.float.bessel_j());
        // Slopes: -J_1, within 0.6, and J_0 - J_1/x, within a half.
        core::array::from_fn(|k| self.special(exact[k], float[k], 0.6, 1.0, BESSEL))
    }
    fn bessel_i_scaled(self) -> [Self; 2] {
        let (exact, float) = (self.exact.bessel_i_scaled(), self.float.bessel_i_scaled());
        core::array::from_fn(|k| self.special(exact[k], float[k], 1.0, exact[k].magnitude(), BESSEL_SCALED))
    }
    /// Bias and amplitude have to be floats without error. The moments are rounded, the scale is a power, and their product is
    /// rounded.
    fn power_moments(law: &PowerMoments, bias: Self, amplitude: Self) -> [Self; 2] {
        if bias.error > 0.0 || amplitude.error > 0.0 {
            return [Self::UNKNOWN; 2];
        }
        let exact = Interval::power_moments(law, bias.exact, amplitude.exact);
        let largest = exact[0].magnitude().max(exact[1].magnitude());
        let own = up(MOMENTS * DOUBLE_UNIT * largest);
        let units = 2.0 * F::FUNCTIONS.pow + 3.0;
        exact.map(|moment| {
            let rounded = Self::of(moment, moment, 0.0, up(units * F::UNIT));
            Self { error: up(rounded.error + own), float: rounded.float + Interval::symmetric(own), ..rounded }
        })
    }
}
