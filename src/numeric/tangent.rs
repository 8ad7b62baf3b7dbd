//! A value with several derivatives, for inner loops.

use core::array;
use core::cmp::Ordering;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::{Real, Scalar};

/// A value and its derivatives with respect to `N` variables, all of them always there.
///
/// The vectors of `num-dual` ask at every operation whether a derivative is there, which costs several times the arithmetic
/// where millions of them are needed. At a kink (`abs`, `min`, `max` of equal values) the derivative is that of one side.
///
/// ```
/// use selfosc::numeric::{Real, Tangent};
/// let [x, y] = Tangent::variables([3.0, 2.0]);
/// assert_eq!((x * y).slopes(), [2.0, 3.0]);
/// assert_eq!(y.square().ln().slopes(), [0.0, 1.0]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Tangent<const N: usize> {
    value: f64,
    slopes: [f64; N],
}

impl<const N: usize> Tangent<N> {
    /// The variables themselves.
    #[must_use]
    pub fn variables(at: [f64; N]) -> [Self; N] {
        array::from_fn(|k| {
            let mut variable = Self::from_f64(at[k]);
            variable.slopes[k] = 1.0;
            variable
        })
    }

    /// Its derivatives.
    #[must_use]
    pub fn slopes(&self) -> [f64; N] {
        self.slopes
    }

    /// A function of this one with that value and derivative.
    #[inline]
    fn chain(mut self, value: f64, slope: f64) -> Self {
        self.value = value;
        for inner in &mut self.slopes {
            *inner *= slope;
        }
        self
    }

    /// A function of two with that value and derivatives.
    #[inline]
    fn combine(mut self, other: Self, value: f64, [by_self, by_other]: [f64; 2]) -> Self {
        self.value = value;
        for (inner, other) in self.slopes.iter_mut().zip(other.slopes) {
            *inner = *inner * by_self + other * by_other;
        }
        self
    }
}

impl<const N: usize> PartialEq for Tangent<N> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<const N: usize> PartialOrd for Tangent<N> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<const N: usize> Neg for Tangent<N> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.chain(-self.value, -1.0)
    }
}

impl<const N: usize> Add for Tangent<N> {
    type Output = Self;
    #[inline]
    fn add(mut self, other: Self) -> Self {
        self.value += other.value;
        for (inner, other) in self.slopes.iter_mut().zip(other.slopes) {
            *inner += other;
        }
        self
    }
}

impl<const N: usize> Sub for Tangent<N> {
    type Output = Self;
    #[inline]
    fn sub(mut self, other: Self) -> Self {
        self.value -= other.value;
        for (inner, other) in self.slopes.iter_mut().zip(other.slopes) {
            *inner -= other;
        }
        self
    }
}

impl<const N: usize> Mul for Tangent<N> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        self.combine(other, self.value * other.value, [other.value, self.value])
    }
}

impl<const N: usize> Div for Tangent<N> {
    type Output = Self;
    #[inline]
    fn div(self, divisor: Self) -> Self {
        let quotient = self.value / divisor.value;
        self.combine(divisor, quotient, [1.0 / divisor.value, -quotient / divisor.value])
    }
}

/// Functions of one variable: value, and derivative in terms of the argument `x` and the value `y`.
macro_rules! functions {
    ($($name:ident: |$x:ident, $y:ident| $slope:expr;)+) => {
        $(
            #[inline]
            fn $name(self) -> Self {
                let $x = self.value;
                let $y = Real::$name($x);
                self.chain($y, $slope)
            }
        )+
    };
}

impl<const N: usize> Real for Tangent<N> {
    #[inline]
    fn from_f64(value: f64) -> Self {
        Self { value, slopes: [0.0; N] }
    }
    fn pi() -> Self {
        Self::from_f64(core::f64::consts::PI)
    }
    #[inline]
    fn bounds(self) -> (f64, f64) {
        (self.value, self.value)
    }
    #[inline]
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }
    #[inline]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
    #[inline]
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
    fn pow(self, exponent: Self) -> Self {
        let power = Real::pow(self.value, exponent.value);
        let by_base = exponent.value * Real::pow(self.value, exponent.value - 1.0);
        // A constant exponent needs no logarithm of a base that may be zero.
        if exponent.slopes == [0.0; N] {
            return self.chain(power, by_base);
        }
        self.combine(exponent, power, [by_base, power * Real::ln(self.value)])
    }
    fn floor(self) -> Self {
        Self::from_f64(Real::floor(self.value))
    }
    #[inline]
    fn select_all<const M: usize>(
        self,
        below: impl FnOnce() -> [Self; M],
        above: impl FnOnce() -> [Self; M],
    ) -> [Self; M] {
        if self.value > 0.0 { above() } else { below() }
    }
    #[inline]
    fn give_or_take(self, _: f64) -> Self {
        self
    }
    fn minus_sine(self, sine: Self) -> Self {
        super::real::minus_sine(self, sine)
    }
    fn sqrt(self) -> Self {
        // A constant zero has derivative zero; the chain rule would make it infinity times zero.
        if self.value == 0.0 && self.slopes == [0.0; N] {
            return self;
        }
        let root = Real::sqrt(self.value);
        self.chain(root, 0.5 / root)
    }
    functions! {
        sin: |x, y| Real::cos(x);
        cos: |x, y| -Real::sin(x);
        tan: |x, y| 1.0 + y * y;
        asin: |x, y| 1.0 / Real::sqrt(1.0 - x * x);
        acos: |x, y| -1.0 / Real::sqrt(1.0 - x * x);
        atan: |x, y| 1.0 / (1.0 + x * x);
        exp: |x, y| y;
        exp_m1: |x, y| y + 1.0;
        ln: |x, y| 1.0 / x;
        ln_1p: |x, y| 1.0 / (1.0 + x);
        sinh: |x, y| Real::cosh(x);
        cosh: |x, y| Real::sinh(x);
        tanh: |x, y| 1.0 - y * y;
        atanh: |x, y| 1.0 / (1.0 - x * x);
    }
}

impl<const N: usize> Scalar for Tangent<N> {
    fn epsilon() -> Self {
        Self::from_f64(f64::EPSILON)
    }
}
