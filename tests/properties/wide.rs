//! Numbers of 32 digits: the sum of two floats, for oracles that have to be asked a million times.

use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::LazyLock;

/// The unevaluated sum of a float and a second one below half a unit in its last place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wide(pub(crate) f64, pub(crate) f64);

/// The sum, and what its rounding left.
fn sum(a: f64, b: f64) -> Wide {
    let s = a + b;
    let t = s - a;
    Wide(s, (a - (s - t)) + (b - t))
}

/// The product, and what its rounding left: factors are split into halves whose products are exact.
fn product(a: f64, b: f64) -> Wide {
    let halves = |x: f64| {
        let t = 134_217_729.0 * x;
        let upper = t - (t - x);
        (upper, x - upper)
    };
    let (p, (a1, a2), (b1, b2)) = (a * b, halves(a), halves(b));
    Wide(p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2)
}

impl Add for Wide {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (s, t) = (sum(self.0, other.0), sum(self.1, other.1));
        let s = sum(s.0, s.1 + t.0);
        sum(s.0, s.1 + t.1)
    }
}

impl Neg for Wide {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Sub for Wide {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Wide {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let p = product(self.0, other.0);
        sum(p.0, p.1 + (self.0 * other.1 + self.1 * other.0))
    }
}

impl Div for Wide {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.0 / other.0;
        let rest = self - other * wide(first);
        let second = rest.0 / other.0;
        let rest = rest - other * wide(second);
        wide(first) + wide(second) + wide(rest.0 / other.0)
    }
}

pub(crate) const fn wide(x: f64) -> Wide {
    Wide(x, 0.0)
}

pub(crate) const PI: Wide = Wide(std::f64::consts::PI, 1.224_646_799_147_353_2e-16);

/// `1/(2 k + 1)!`, of either sign.
static SINE: LazyLock<[Wide; 16]> = LazyLock::new(|| {
    let mut factor = wide(1.0);
    std::array::from_fn(|k| {
        if k > 0 {
            factor = -(factor / wide((2 * k * (2 * k + 1)) as f64));
        }
        factor
    })
});

impl Wide {
    pub(crate) fn square(self) -> Self {
        self * self
    }

    pub(crate) fn sqrt(self) -> Self {
        if self.0 <= 0.0 {
            return wide(0.0);
        }
        let near = wide(self.0.sqrt());
        let near = near + (self - near.square()) / (near + near);
        near + (self - near.square()) / (near + near)
    }

    /// Up to three either way: the series at a ninth, tripled twice.
    pub(crate) fn sin(self) -> Self {
        let x = self / wide(9.0);
        let square = x.square();
        let series = SINE.iter().rev().fold(wide(0.0), |sum, factor| sum * square + *factor);
        (0..2).fold(series * x, |sine, _| sine * (wide(3.0) - wide(4.0) * sine.square()))
    }

    /// Up to three either way, likewise.
    pub(crate) fn sinh(self) -> Self {
        let x = self / wide(9.0);
        let square = -x.square();
        let series = SINE.iter().rev().fold(wide(0.0), |sum, factor| sum * square + *factor);
        (0..2).fold(series * x, |sine, _| sine * (wide(3.0) + wide(4.0) * sine.square()))
    }

    /// One step of Newton's method from the float next to it.
    pub(crate) fn asin(self) -> Self {
        let near = self.0.asin();
        wide(near) + (self - wide(near).sin()) / wide(near.cos())
    }

    pub(crate) fn atan(self) -> Self {
        (self / (wide(1.0) + self.square()).sqrt()).asin()
    }
}
