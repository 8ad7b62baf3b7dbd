//! Rational functions as an arithmetic: generic code evaluated over them gives the formula that it computes, exactly.

use core::cmp::Ordering;
use core::ops::{Add, Div, Mul, Neg, Sub};
use std::cell::RefCell;

use super::ring::{Polynomial, Symbol};
use crate::numeric::{Component, Real, Scalar};

/// A rational function of the statement's variables, with its value at a point of their range.
///
/// The code's decisions (`abs`, `max`, comparisons) are made at that point and recorded: the proof holds wherever
/// they are the same. A function that is not rational is an indeterminate of its own, the same for equal arguments; but
/// the root of a square is found.
///
/// Its nodes are never freed (an arithmetic is `Copy`): meant for formulas of a page.
#[derive(Clone, Copy, Debug)]
pub struct Rational {
    /// Numerator and denominator; `None` where a coefficient left its range.
    fraction: Option<&'static (Polynomial, Polynomial)>,
    value: f64,
}

/// A decision of the code: a rational function, and whether it was positive.
pub type Decision = (Rational, bool);

/// A function's value at its arguments.
struct Call {
    name: &'static str,
    arguments: Vec<Rational>,
    value: f64,
}

thread_local! {
    static DECISIONS: RefCell<Vec<Decision>> = const { RefCell::new(Vec::new()) };
    static CALLS: RefCell<Vec<Call>> = const { RefCell::new(Vec::new()) };
    static POINT: RefCell<Vec<f64>> = const { RefCell::new(Vec::new()) };
}

/// The result of `code` for variables at a point, and its decisions, each once.
pub(super) fn recorded<R, const N: usize>(
    point: [f64; N],
    code: impl FnOnce([Rational; N]) -> R,
) -> (R, Vec<Decision>) {
    DECISIONS.with_borrow_mut(Vec::clear);
    CALLS.with_borrow_mut(Vec::clear);
    POINT.set(point.to_vec());
    let variable =
        |place| Rational::of(Polynomial::symbol(Symbol::Variable(place)), Polynomial::number(1), point[place]);
    let result = code(core::array::from_fn(variable));
    (result, DECISIONS.with_borrow_mut(core::mem::take))
}

/// The value of an indeterminate at the point.
fn at_point(symbol: Symbol) -> f64 {
    match symbol {
        Symbol::Variable(place) => POINT.with_borrow(|point| point.get(place).copied().unwrap_or(f64::NAN)),
        Symbol::Pi => core::f64::consts::PI,
        Symbol::Constant(bits) => f64::from_bits(bits),
        Symbol::Call(place) => CALLS.with_borrow(|calls| calls.get(place).map_or(f64::NAN, |call| call.value)),
    }
}

/// Whether a polynomial is zero once squares of square roots are what the roots are of; it is asked of the even and of the odd
/// powers of each root, the last root first: the argument of a root knows earlier ones only. `None` where coefficients leave their
/// range.
fn vanishes(polynomial: &Polynomial, calls: usize) -> Option<bool> {
    if polynomial.is_zero() {
        return Some(true);
    }
    let Some(place) = calls.checked_sub(1) else { return Some(false) };
    let powers = polynomial.in_powers_of(Symbol::Call(place));
    let radicand = CALLS.with_borrow(|calls| {
        calls
            .get(place)
            .filter(|call| call.name == SQRT)
            .and_then(|call| call.arguments.first().and_then(|x| x.fraction))
    });
    let Some((numerator, denominator)) = radicand else {
        return Some(
            powers.iter().map(|power| vanishes(power, place)).collect::<Option<Vec<_>>>()?.into_iter().all(|zero| zero),
        );
    };
    let mut all = true;
    for odd in [0, 1] {
        // Sum of c_k (n/d)^k, times d to the highest power.
        let mut sum = Polynomial::number(0);
        let mut scale = Polynomial::number(1);
        for power in powers.iter().skip(odd).step_by(2).rev() {
            sum = sum.times(numerator)?.plus(1, &power.times(&scale)?)?;
            scale = scale.times(denominator)?;
        }
        all &= vanishes(&sum, place)?;
    }
    Some(all)
}

fn calls() -> usize {
    CALLS.with_borrow(Vec::len)
}

/// The function with an algebraic identity: `sqrt(x)^2 = x`.
const SQRT: &str = "sqrt";

/// Fractions of a power of two up to this are numbers; other constants are indeterminates.
const SHORT: f64 = 1024.0;

impl Rational {
    /// Whether this is zero for all variables; `false` if undecided.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.fraction.is_some_and(|(numerator, _)| vanishes(numerator, calls()).unwrap_or(false))
    }

    /// The numerator of the difference over the product of the denominators, without a node of its own: comparisons are many.
    fn difference(&self, other: &Self) -> Option<Polynomial> {
        let ((a, b), (c, d)) = self.fraction.zip(other.fraction)?;
        if b == d { a.plus(-1, c) } else { a.times(d)?.plus(-1, &c.times(b)?) }
    }

    fn of(numerator: Polynomial, denominator: Polynomial, value: f64) -> Self {
        let fraction = (!denominator.is_zero()).then(|| &*Box::leak(Box::new(numerator.reduced(denominator))));
        Self { fraction, value }
    }

    /// From two fractions, where the arithmetic of their parts stays in its range.
    fn combine(
        self,
        other: Self,
        value: f64,
        parts: impl Fn(&(Polynomial, Polynomial), &(Polynomial, Polynomial)) -> Option<(Polynomial, Polynomial)>,
    ) -> Self {
        match self.fraction.zip(other.fraction).and_then(|(mine, theirs)| parts(mine, theirs)) {
            Some((numerator, denominator)) => Self::of(numerator, denominator, value),
            None => Self { fraction: None, value },
        }
    }

    /// Whether this is positive at the point, which is written down; `None` where it is too small there to say.
    fn positive(self) -> Option<bool> {
        const CLEAR: f64 = 1e-9;
        if self.is_zero() {
            return Some(false);
        }
        if self.fraction.is_none() || !(self.value.abs() > CLEAR) {
            return None;
        }
        let positive = self.value > 0.0;
        DECISIONS.with_borrow_mut(|decisions| {
            if !decisions.iter().any(|(known, was)| *was == positive && *known == self) {
                decisions.push((self, positive));
            }
        });
        Some(positive)
    }

    /// A rational function whose square this is.
    fn root_of_square(self) -> Option<Self> {
        let (numerator, denominator) = self.fraction?;
        let root = numerator.times(denominator)?.root()?;
        let value = root.value(&at_point) / denominator.value(&at_point);
        Some(Self::of(root, denominator.clone(), value))
    }

    /// The place of a function's earlier call with these arguments.
    fn known(name: &'static str, arguments: &[Self]) -> Option<usize> {
        let same = |call: &Call| {
            let known = call.arguments.iter().zip(arguments);
            call.name == name && call.arguments.len() == arguments.len() && known.into_iter().all(|(a, b)| a == b)
        };
        CALLS.with_borrow(|calls| calls.iter().position(same))
    }

    /// An indeterminate for a function's value.
    fn call(name: &'static str, arguments: &[Self], value: f64) -> Self {
        let place = Self::known(name, arguments).unwrap_or_else(|| {
            CALLS.with_borrow_mut(|calls| {
                calls.push(Call { name, arguments: arguments.to_vec(), value });
                calls.len() - 1
            })
        });
        Self::of(Polynomial::symbol(Symbol::Call(place)), Polynomial::number(1), value)
    }

    /// A function of one argument, with its value at zero where that is a whole number; an odd or even one of an argument whose
    /// negative it has been asked of is what it was there.
    fn function(self, name: &'static str, at_zero: Option<f64>, parity: Parity, value: f64) -> Self {
        if let Some(known) = at_zero.filter(|_| self.is_zero()) {
            return Self::from_f64(known);
        }
        let mirrored = || Self::known(name, &[-self]).is_some();
        match parity {
            Parity::Odd if mirrored() => -Self::call(name, &[-self], -value),
            Parity::Even if mirrored() => Self::call(name, &[-self], value),
            _ => Self::call(name, &[self], value),
        }
    }
}

/// Effect on a function's value of a change of its argument's sign.
enum Parity {
    Odd,
    Even,
    Neither,
}

impl Add for Rational {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, self.value + other.value, |(a, b), (c, d)| {
            if b == d {
                return Some((a.plus(1, c)?, b.clone()));
            }
            Some((a.times(d)?.plus(1, &c.times(b)?)?, b.times(d)?))
        })
    }
}

impl Sub for Rational {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Rational {
    type Output = Self;
    fn neg(self) -> Self {
        self * Self::from_f64(-1.0)
    }
}

impl Mul for Rational {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combine(other, self.value * other.value, |(a, b), (c, d)| {
            let ((a, d), (c, b)) = (a.clone().reduced(d.clone()), c.clone().reduced(b.clone()));
            Some((a.times(&c)?, b.times(&d)?))
        })
    }
}

impl Div for Rational {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.combine(other, self.value / other.value, |(a, b), (c, d)| {
            if c.is_zero() {
                return None;
            }
            if b == d {
                return Some((a.clone(), c.clone()));
            }
            Some((a.times(d)?, b.times(c)?))
        })
    }
}

impl PartialEq for Rational {
    fn eq(&self, other: &Self) -> bool {
        self.difference(other).is_some_and(|difference| vanishes(&difference, calls()).unwrap_or(false))
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let difference = *self - *other;
        if difference.is_zero() {
            return Some(Ordering::Equal);
        }
        Some(if difference.positive()? { Ordering::Greater } else { Ordering::Less })
    }
}

/// Functions of one argument: their values at zero where these are whole numbers, and their parity.
macro_rules! functions {
    ($($function:ident: $at_zero:expr, $parity:ident;)+) => {
        $(fn $function(self) -> Self {
            self.function(stringify!($function), $at_zero, Parity::$parity, Real::$function(self.value))
        })+
    };
}

impl Real for Rational {
    fn from_f64(value: f64) -> Self {
        let scaled = value * SHORT;
        if !value.is_finite() {
            return Self { fraction: None, value };
        }
        if scaled.fract() == 0.0 && scaled.abs() < 1e15 {
            #[expect(clippy::cast_possible_truncation, reason = "whole and below 1e15")]
            return Self::of(Polynomial::number(scaled as i128), Polynomial::number(SHORT as i128), value);
        }
        Self::of(Polynomial::symbol(Symbol::Constant(value.to_bits())), Polynomial::number(1), value)
    }
    fn pi() -> Self {
        Self::of(Polynomial::symbol(Symbol::Pi), Polynomial::number(1), core::f64::consts::PI)
    }
    /// The value at the point: decisions by it are not recorded.
    fn bounds(self) -> (f64, f64) {
        (self.value, self.value)
    }
    fn abs(self) -> Self {
        if self.is_zero() {
            return self;
        }
        match self.positive() {
            Some(true) => self,
            Some(false) => -self,
            None => Self::UNKNOWN,
        }
    }
    fn min(self, other: Self) -> Self {
        match self.partial_cmp(&other) {
            Some(Ordering::Greater) => other,
            Some(_) => self,
            None => Self::UNKNOWN,
        }
    }
    fn max(self, other: Self) -> Self {
        match self.partial_cmp(&other) {
            Some(Ordering::Less) => other,
            Some(_) => self,
            None => Self::UNKNOWN,
        }
    }
    /// Of a square, the side that is positive at the point, which is written down; of a square times what a root has been taken
    /// of, that root times such a side.
    fn sqrt(self) -> Self {
        let earlier: Vec<_> = CALLS.with_borrow(|calls| {
            let roots = calls.iter().enumerate().filter(|(_, call)| call.name == SQRT);
            roots.filter_map(|(place, call)| Some((place, call.value, *call.arguments.first()?))).collect()
        });
        let by_earlier = |(place, value, argument): (usize, f64, Self)| {
            let root = Self::of(Polynomial::symbol(Symbol::Call(place)), Polynomial::number(1), value);
            Some((self / argument).root_of_square()?.abs() * root)
        };
        let root = self.root_of_square().map(Self::abs).or_else(|| earlier.into_iter().find_map(by_earlier));
        root.unwrap_or_else(|| Self::call(SQRT, &[self], self.value.sqrt()))
    }
    functions! {
        sin: Some(0.0), Odd; cos: Some(1.0), Even; tan: Some(0.0), Odd; asin: Some(0.0), Odd; atan: Some(0.0), Odd;
        exp: Some(1.0), Neither; exp_m1: Some(0.0), Neither; ln: None, Neither; ln_1p: Some(0.0), Neither;
        sinh: Some(0.0), Odd; cosh: Some(1.0), Even; tanh: Some(0.0), Odd; atanh: Some(0.0), Odd;
    }
    /// The whole number below at the point, which is written down as two decisions.
    fn floor(self) -> Self {
        let whole = Self::from_f64(Real::floor(self.value));
        match ((self - whole).is_zero(), (self - whole).positive(), (whole + Self::one() - self).positive()) {
            (true, ..) | (_, Some(true), Some(true)) => whole,
            _ => Self::UNKNOWN,
        }
    }
    fn pow(self, exponent: Self) -> Self {
        Self::call("pow", &[self, exponent], Real::pow(self.value, exponent.value))
    }
    fn select_all<const N: usize>(
        self,
        below: impl FnOnce() -> [Self; N],
        above: impl FnOnce() -> [Self; N],
    ) -> [Self; N] {
        match self.positive() {
            Some(true) => above(),
            Some(false) => below(),
            None => [Self::UNKNOWN; N],
        }
    }
    fn inflate(self, error: f64) -> Self {
        if error == 0.0 { self } else { Self::UNKNOWN }
    }
    fn minus_own_sine(self, sine: Self) -> Self {
        self - sine
    }
}

impl Scalar for Rational {
    fn epsilon() -> Self {
        Self::from_f64(f64::EPSILON)
    }
    /// A value and a slope at a point are no formula.
    fn lift(self, _: f64, _: f64) -> Self {
        <Self as Component>::UNKNOWN
    }
}

/// Derivatives of formulas are formulas.
impl Component for Rational {
    const UNKNOWN: Self = Self { fraction: None, value: f64::NAN };

    fn sign(self) -> Option<bool> {
        self.positive()
    }
    fn precedes_or_equals(self, other: Self) -> Option<bool> {
        self.partial_cmp(&other).map(|order| order != Ordering::Greater)
    }
    fn either(self, other: Self) -> Self {
        if self == other { self } else { Self::UNKNOWN }
    }
    fn slope_of_abs(self) -> Self {
        match self.positive() {
            Some(positive) if !self.is_zero() => Self::from_f64(if positive { 1.0 } else { -1.0 }),
            _ => Self::UNKNOWN,
        }
    }
    fn floor_is_constant(self) -> bool {
        false
    }
}
