//! Interval values with their partial derivatives: rigorous Jacobians from the formulas themselves.

use core::array;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::numeric::{Interval, Real};

/// Enclosures of a function's value and of its `N` partial derivatives over a box.
///
/// At a kink (`abs`, `min`, `max` of values that may coincide) the derivatives enclose both sides, so the mean value
/// theorem holds across it; at a jump (`floor`, `select`), and outside a domain, everything is [`Interval::ENTIRE`].
///
/// ```
/// use selfosc::numeric::{Interval, Real};
/// use selfosc::proof::Gradient;
/// let [x, y] = Gradient::variables([Interval::from_f64(3.0), Interval::from_f64(2.0)]);
/// let product = x * y;
/// assert_eq!(product.value(), Interval::from_f64(6.0));
/// assert_eq!(product.slopes()[0], Interval::from_f64(2.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient<const N: usize> {
    value: Interval,
    slopes: [Interval; N],
}

impl<const N: usize> Gradient<N> {
    /// The function that is `value` everywhere.
    #[must_use]
    pub const fn constant(value: Interval) -> Self {
        Self { value, slopes: [Interval::ZERO; N] }
    }

    /// The variables themselves, over a box.
    #[must_use]
    pub fn variables(at: [Interval; N]) -> [Self; N] {
        array::from_fn(|i| {
            let mut variable = Self::constant(at[i]);
            variable.slopes[i] = Interval::ONE;
            variable
        })
    }

    /// Enclosure of the value.
    #[must_use]
    pub const fn value(&self) -> Interval {
        self.value
    }

    /// Enclosures of the partial derivatives.
    #[must_use]
    pub const fn slopes(&self) -> &[Interval; N] {
        &self.slopes
    }

    /// A function of this one, given that function's `value` and derivative `slope` over [`value`](Self::value): for functions
    /// that are known by an integral.
    #[must_use]
    pub fn chain(self, value: Interval, slope: Interval) -> Self {
        Self { value, slopes: self.slopes.map(|inner| inner * slope) }
    }

    /// The value of a function that may be discontinuous there, so that no derivative says anything.
    const fn jump(value: Interval) -> Self {
        Self { value, slopes: [Interval::ENTIRE; N] }
    }

    fn combine(self, other: Self, value: Interval, slope: impl Fn(Interval, Interval) -> Interval) -> Self {
        Self { value, slopes: array::from_fn(|i| slope(self.slopes[i], other.slopes[i])) }
    }
}

impl<const N: usize> Neg for Gradient<N> {
    type Output = Self;
    fn neg(self) -> Self {
        self.chain(-self.value, -Interval::ONE)
    }
}

impl<const N: usize> Add for Gradient<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, self.value + other.value, Add::add)
    }
}

impl<const N: usize> Sub for Gradient<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.combine(other, self.value - other.value, Sub::sub)
    }
}

impl<const N: usize> Mul for Gradient<N> {
    type Output = Self;
    #[expect(clippy::suspicious_arithmetic_impl, reason = "the product rule")]
    fn mul(self, other: Self) -> Self {
        self.combine(other, self.value * other.value, |a, b| a * other.value + b * self.value)
    }
}

impl<const N: usize> Div for Gradient<N> {
    type Output = Self;
    #[expect(clippy::suspicious_arithmetic_impl, reason = "the quotient rule")]
    fn div(self, divisor: Self) -> Self {
        let quotient = self.value / divisor.value;
        self.combine(divisor, quotient, |a, b| (a - b * quotient) / divisor.value)
    }
}

impl<const N: usize> Real for Gradient<N> {
    fn from_f64(value: f64) -> Self {
        Self::constant(Interval::point(value))
    }
    fn pi() -> Self {
        Self::constant(Interval::PI)
    }
    fn inverse_pi() -> Self {
        Self::constant(Interval::INVERSE_PI)
    }
    fn bounds(self) -> (f64, f64) {
        self.value.bounds()
    }
    fn abs(self) -> Self {
        let slope = match self.value {
            value if value.is_positive() => Interval::ONE,
            value if value.is_negative() => -Interval::ONE,
            _ => Interval::UNIT,
        };
        self.chain(self.value.abs(), slope)
    }
    fn min(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        if a.precedes(b) {
            self
        } else if b.precedes(a) {
            other
        } else {
            self.combine(other, a.min(b), Interval::hull)
        }
    }
    fn max(self, other: Self) -> Self {
        -(-self).min(-other)
    }
    fn square(self) -> Self {
        self.chain(self.value.square(), Interval::two() * self.value)
    }
    fn pow(self, exponent: Self) -> Self {
        let (base, power) = (self.value, self.value.pow(exponent.value));
        let by_base = self.chain(power, exponent.value * base.pow(exponent.value - Interval::ONE));
        if exponent.slopes == [Interval::ZERO; N] {
            return by_base;
        }
        let by_exponent = exponent.chain(power, power * base.ln());
        by_base.combine(by_exponent, power, Add::add)
    }
    fn floor(self) -> Self {
        let floor = self.value.floor();
        if floor.is_point() { Self::constant(floor) } else { Self::jump(floor) }
    }
    fn select_all<const M: usize>(
        self,
        below: impl FnOnce() -> [Self; M],
        above: impl FnOnce() -> [Self; M],
    ) -> [Self; M] {
        match self.value {
            value if value.is_positive() => above(),
            value if value.upper() <= 0.0 => below(),
            value => {
                let values = |branch: [Self; M]| branch.map(|number| number.value);
                value.select_all(|| values(below()), || values(above())).map(Self::jump)
            }
        }
    }
    fn give_or_take(self, error: f64) -> Self {
        Self { value: self.value.give_or_take(error), ..self }
    }
    fn minus_sine(self, sine: Self) -> Self {
        self.combine(sine, self.value.minus_sine(sine.value), Sub::sub)
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, Interval::ONE / (Interval::two() * root))
    }
    fn sin(self) -> Self {
        self.chain(self.value.sin(), self.value.cos())
    }
    fn cos(self) -> Self {
        self.chain(self.value.cos(), -self.value.sin())
    }
    fn tan(self) -> Self {
        let tangent = self.value.tan();
        self.chain(tangent, Interval::ONE + tangent.square())
    }
    fn asin(self) -> Self {
        self.chain(self.value.asin(), Interval::ONE / (Interval::ONE - self.value.square()).sqrt())
    }
    fn acos(self) -> Self {
        self.chain(self.value.acos(), -Interval::ONE / (Interval::ONE - self.value.square()).sqrt())
    }
    fn atan(self) -> Self {
        self.chain(self.value.atan(), Interval::ONE / (Interval::ONE + self.value.square()))
    }
    fn exp(self) -> Self {
        let exponential = self.value.exp();
        self.chain(exponential, exponential)
    }
    fn exp_m1(self) -> Self {
        self.chain(self.value.exp_m1(), self.value.exp())
    }
    fn ln(self) -> Self {
        self.chain(self.value.ln(), Interval::ONE / self.value)
    }
    fn ln_1p(self) -> Self {
        self.chain(self.value.ln_1p(), Interval::ONE / (Interval::ONE + self.value))
    }
    fn sinh(self) -> Self {
        self.chain(self.value.sinh(), self.value.cosh())
    }
    fn cosh(self) -> Self {
        self.chain(self.value.cosh(), self.value.sinh())
    }
    fn tanh(self) -> Self {
        let tangent = self.value.tanh();
        self.chain(tangent, Interval::ONE - tangent.square())
    }
    fn atanh(self) -> Self {
        self.chain(self.value.atanh(), Interval::ONE / (Interval::ONE - self.value.square()))
    }
}
