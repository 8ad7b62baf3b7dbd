//! Forward-mode automatic differentiation of first order: a value with its partial derivatives, over floats and intervals.

use core::array;
use core::cmp::Ordering;

use super::real::operators;
use super::{Interval, Real, Scalar};

/// A number that a gradient can be made of: with its derivatives at comparisons. By default a comparison is decided where the
/// bounds decide it.
pub trait Component: Real + PartialEq {
    /// The derivative where a function may jump: any number.
    const UNKNOWN: Self;
    /// Contains both.
    #[must_use]
    fn either(self, other: Self) -> Self;
    /// Whether the number is positive; `None` where it may be and may not.
    #[inline]
    fn sign(self) -> Option<bool> {
        match self.bounds() {
            (lower, _) if lower > 0.0 => Some(true),
            (_, upper) if upper <= 0.0 => Some(false),
            _ => None,
        }
    }
    /// Whether the number is less than another, or equal; `None` where either may be less, and where a kink may be: bounds touch.
    #[inline]
    fn precedes_or_equals(self, other: Self) -> Option<bool> {
        match (self.bounds(), other.bounds()) {
            (a, b) if a.1 < b.0 => Some(true),
            (a, b) if b.1 < a.0 => Some(false),
            _ => None,
        }
    }
    /// The derivative of [`abs`](Real::abs) here.
    #[must_use]
    fn slope_of_abs(self) -> Self {
        match self.precedes_or_equals(Self::zero()) {
            Some(true) => -Self::one(),
            Some(false) => Self::one(),
            // A jump, of which the derivative is unknown.
            None => Self::one().either(-Self::one()).select(|| -Self::one(), Self::one),
        }
    }
    /// `exp(self)`, given `exp(self) - 1`: their sum cancels for large negative numbers.
    #[must_use]
    fn exp_from_exp_m1(self, _exp_m1: Self) -> Self {
        self.exp()
    }
    /// Whether [`floor`](Real::floor) is constant here.
    fn floor_is_constant(self) -> bool {
        let (lower, upper) = self.floor().bounds();
        lower >= upper
    }
}

/// Always decided: at a kink for a single side.
impl Component for f64 {
    const UNKNOWN: Self = Self::NAN;
    #[inline]
    fn either(self, _: Self) -> Self {
        self
    }
    #[inline]
    fn sign(self) -> Option<bool> {
        Some(self > 0.0)
    }
    #[inline]
    fn precedes_or_equals(self, other: Self) -> Option<bool> {
        Some(!(other < self))
    }
    #[inline]
    fn slope_of_abs(self) -> Self {
        if self < 0.0 { -1.0 } else { 1.0 }
    }
    #[inline]
    fn exp_from_exp_m1(self, exp_m1: Self) -> Self {
        exp_m1 + 1.0
    }
    #[inline]
    fn floor_is_constant(self) -> bool {
        true
    }
}

impl Component for Interval {
    const UNKNOWN: Self = Self::ENTIRE;
    fn either(self, other: Self) -> Self {
        self.hull(other)
    }
}

/// Derivatives of derivatives.
impl<const N: usize> Component for Gradient<Interval, N> {
    const UNKNOWN: Self = Self { value: Interval::ENTIRE, slopes: [Interval::ENTIRE; N] };
    fn either(self, other: Self) -> Self {
        self.combine(other, self.value.hull(other.value), Interval::hull)
    }
}

/// A value with its `N` partial derivatives, all of them always there: of floats for inner loops and sensitivities, of
/// [intervals](Interval) for enclosures over a box, as interval Newton and the mean value form ask for.
///
/// At a kink (`abs`, `min`, `max` of values that may coincide) the derivatives of floats are those of a single side;
/// those of intervals enclose both sides, for the mean value theorem to hold across it. At a jump that an interval
/// straddles (`floor`, `select`), and outside a domain, its derivatives are [`Interval::ENTIRE`].
///
/// Two are equal, and floats in order, by their values.
///
/// ```
/// use selfosc::numeric::{Gradient, Interval, Real};
/// let [x, y] = Gradient::variables([3.0, 2.0]);
/// assert_eq!((x * y).slopes(), [2.0, 3.0]);
/// assert_eq!(y.square().ln().slopes(), [0.0, 1.0]);
/// let [x] = Gradient::variables([Interval::from_f64(3.0)]);
/// assert_eq!(x.square().slopes(), [Interval::from_f64(6.0)]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Gradient<T, const N: usize> {
    value: T,
    slopes: [T; N],
}

impl<T: Component, const N: usize> Gradient<T, N> {
    /// A value with these derivatives.
    #[must_use]
    pub const fn new(value: T, slopes: [T; N]) -> Self {
        Self { value, slopes }
    }

    /// The function that is `value` everywhere.
    #[must_use]
    #[inline]
    pub fn constant(value: T) -> Self {
        Self { value, slopes: [T::zero(); N] }
    }

    /// The variables themselves, at a point or over a box.
    #[must_use]
    pub fn variables(at: [T; N]) -> [Self; N] {
        array::from_fn(|i| {
            let mut variable = Self::constant(at[i]);
            variable.slopes[i] = T::one();
            variable
        })
    }

    /// The value.
    #[must_use]
    pub const fn value(&self) -> T {
        self.value
    }

    /// The partial derivatives.
    #[must_use]
    pub const fn slopes(&self) -> [T; N] {
        self.slopes
    }

    /// The chain rule: `f` of this gradient, given f's `value` and derivative `slope` at (or over)
    /// [`value`](Self::value), for functions given by an integral.
    #[must_use]
    #[inline]
    pub fn chain(mut self, value: T, slope: T) -> Self {
        self.value = value;
        for inner in &mut self.slopes {
            *inner = *inner * slope;
        }
        self
    }

    /// The value of a function that may be discontinuous there, without a derivative.
    const fn jump(value: T) -> Self {
        Self { value, slopes: [T::UNKNOWN; N] }
    }

    #[inline]
    fn combine(mut self, other: Self, value: T, slope: impl Fn(T, T) -> T) -> Self {
        self.value = value;
        for (inner, other) in self.slopes.iter_mut().zip(other.slopes) {
            *inner = slope(*inner, other);
        }
        self
    }

    fn is_constant(&self) -> bool {
        self.slopes == [T::zero(); N]
    }
}

impl<T: PartialEq, const N: usize> PartialEq for Gradient<T, N> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<T: PartialOrd, const N: usize> PartialOrd for Gradient<T, N> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<const N: usize> Scalar for Gradient<f64, N> {
    fn epsilon() -> Self {
        Self::from_f64(f64::EPSILON)
    }
}

operators! {
    [
        #[inline]
        #[allow(clippy::suspicious_arithmetic_impl, reason = "the rules of products and quotients")]
        Gradient<T, N>, T: Component, const N: usize
    ]
    Neg::neg = |x| x.chain(-x.value, -T::one());
    Add::add = |x, y| x.combine(y, x.value + y.value, |dx, dy| dx + dy);
    Sub::sub = |x, y| x.combine(y, x.value - y.value, |dx, dy| dx - dy);
    Mul::mul = |x, y| x.combine(y, x.value * y.value, |dx, dy| dx * y.value + dy * x.value);
    Div::div = |x, y| {
        let quotient = x.value / y.value;
        x.combine(y, quotient, |dx, dy| (dx - dy * quotient) / y.value)
    };
}

/// Functions of a single variable: value, and derivative in terms of the argument `x` and the value `y`.
macro_rules! functions {
    ($($name:ident: |$x:ident, $y:ident| $slope:expr;)+) => {
        $(
            #[inline]
            fn $name(self) -> Self {
                let $x = self.value;
                let $y = $x.$name();
                self.chain($y, $slope)
            }
        )+
    };
}

impl<T: Component, const N: usize> Real for Gradient<T, N> {
    #[inline]
    fn from_f64(value: f64) -> Self {
        Self::constant(T::from_f64(value))
    }
    fn pi() -> Self {
        Self::constant(T::pi())
    }
    fn inverse_pi() -> Self {
        Self::constant(T::inverse_pi())
    }
    #[inline]
    fn bounds(self) -> (f64, f64) {
        self.value.bounds()
    }
    #[inline]
    fn abs(self) -> Self {
        self.chain(self.value.abs(), self.value.slope_of_abs())
    }
    #[inline]
    fn min(self, other: Self) -> Self {
        match self.value.precedes_or_equals(other.value) {
            Some(true) => self,
            Some(false) => other,
            None => self.combine(other, self.value.min(other.value), T::either),
        }
    }
    #[inline]
    fn max(self, other: Self) -> Self {
        match (-self.value).precedes_or_equals(-other.value) {
            Some(true) => self,
            Some(false) => other,
            None => self.combine(other, self.value.max(other.value), T::either),
        }
    }
    #[inline]
    fn square(self) -> Self {
        self.chain(self.value.square(), T::two() * self.value)
    }
    fn pow(self, exponent: Self) -> Self {
        let (base, power) = (self.value, self.value.pow(exponent.value));
        let by_base = self.chain(power, exponent.value * base.pow(exponent.value - T::one()));
        // A constant exponent needs no logarithm of a base that may be zero.
        if exponent.is_constant() {
            return by_base;
        }
        let by_exponent = exponent.chain(power, power * base.ln());
        by_base.combine(by_exponent, power, |a, b| a + b)
    }
    fn floor(self) -> Self {
        let floor = self.value.floor();
        if self.value.floor_is_constant() { Self::constant(floor) } else { Self::jump(floor) }
    }
    #[inline]
    fn select_all<const M: usize>(
        self,
        below: impl FnOnce() -> [Self; M],
        above: impl FnOnce() -> [Self; M],
    ) -> [Self; M] {
        match self.value.sign() {
            Some(true) => above(),
            Some(false) => below(),
            None => {
                let values = |branch: [Self; M]| branch.map(|number| number.value);
                self.value.select_all(|| values(below()), || values(above())).map(Self::jump)
            }
        }
    }
    #[inline]
    fn inflate(self, error: f64) -> Self {
        Self { value: self.value.inflate(error), ..self }
    }
    fn minus_own_sine(self, sine: Self) -> Self {
        // 1 - cos x without cancellation.
        let slope = T::two() * (self.value / T::two()).sin().square();
        self.chain(self.value.minus_own_sine(sine.value), slope)
    }
    #[inline]
    fn sqrt(self) -> Self {
        // A constant zero has derivative zero; the chain rule would make it infinity times zero.
        if self.value == T::zero() && self.is_constant() {
            return self;
        }
        let root = self.value.sqrt();
        self.chain(root, T::one() / (T::two() * root))
    }
    functions! {
        sin: |x, y| x.cos();
        cos: |x, y| -x.sin();
        tan: |x, y| T::one() + y.square();
        asin: |x, y| T::one() / (T::one() - x.square()).sqrt();
        acos: |x, y| -T::one() / (T::one() - x.square()).sqrt();
        atan: |x, y| T::one() / (T::one() + x.square());
        exp: |x, y| y;
        exp_m1: |x, y| x.exp_from_exp_m1(y);
        ln: |x, y| T::one() / x;
        ln_1p: |x, y| T::one() / (T::one() + x);
        sinh: |x, y| x.cosh();
        cosh: |x, y| x.sinh();
        tanh: |x, y| T::one() - y.square();
        atanh: |x, y| T::one() / (T::one() - x.square());
    }
}
