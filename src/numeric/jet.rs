//! Taylor jets over intervals: a function's value and derivatives at a point, or at every point of an interval at once.

use core::array;
use core::ops::{Div, Mul};

use super::real::operators;
use super::{Interval, Real};

/// Enclosures of the first `N` Taylor coefficients `f^(k)(t)/k!`, `k < N`, for every point `t` of the interval the
/// variable was started with. `N` is at least 1.
///
/// Outside a domain the coefficients are [`Interval::ENTIRE`], as for intervals. At a kink or jump (`abs`, `min`, `max` of values
/// that may coincide, `floor`, `select`) the value is enclosed and the derivatives are `ENTIRE`:
/// [`is_bounded`](Self::is_bounded): whether the jet bounds all of them.
///
/// ```
/// use selfosc::numeric::{Interval, Jet, Real};
/// let t: Jet<4> = Jet::variable(Interval::ZERO);
/// let sixth = t.exp().coefficients()[3];
/// assert!(sixth.contains(1.0 / 6.0) && sixth.width() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<const N: usize> {
    coefficients: [Interval; N],
}

impl<const N: usize> Jet<N> {
    /// The function that is `value` everywhere.
    #[must_use]
    pub const fn constant(value: Interval) -> Self {
        let mut coefficients = [Interval::ZERO; N];
        coefficients[0] = value;
        Self { coefficients }
    }

    /// The variable itself, at every point of `at`.
    #[must_use]
    pub fn variable(at: Interval) -> Self {
        Self::from_terms(|k, _| match k {
            0 => at,
            1 => Interval::ONE,
            _ => Interval::ZERO,
        })
    }

    /// The Taylor coefficients, from the value upwards.
    #[must_use]
    pub const fn coefficients(&self) -> &[Interval; N] {
        &self.coefficients
    }

    /// Enclosure of the value.
    #[must_use]
    pub const fn value(&self) -> Interval {
        self.coefficients[0]
    }

    /// Whether every coefficient is bounded.
    #[must_use]
    pub fn is_bounded(&self) -> bool {
        self.coefficients.iter().all(|c| c.is_bounded())
    }

    /// The jet of the derivative; its last coefficient is unknown, hence [`Interval::ENTIRE`].
    #[must_use]
    pub fn derivative(&self) -> Self {
        Self::from_terms(|k, _| match self.coefficients.get(k + 1) {
            Some(&next) => integer(k + 1) * next,
            None => Interval::ENTIRE,
        })
    }

    fn is_constant(&self) -> bool {
        self.coefficients.iter().skip(1).all(|&c| c == Interval::ZERO)
    }

    /// Each coefficient from its index and those before it.
    fn from_terms(term: impl Fn(usize, &[Interval]) -> Interval) -> Self {
        let mut coefficients = [Interval::ZERO; N];
        for k in 0..N {
            let (known, rest) = coefficients.split_at_mut(k);
            rest[0] = term(k, known);
        }
        Self { coefficients }
    }

    /// The value of a function that has a kink there.
    fn kink(value: Interval) -> Self {
        Self::from_terms(|k, _| if k == 0 { value } else { Interval::ENTIRE })
    }

    /// The coefficients of `t u'`, `u` this jet, up to the last that is not zero.
    fn moving(&self) -> Moving<N> {
        let mut terms = self.coefficients;
        for (k, term) in terms.iter_mut().enumerate() {
            *term = integer(k) * *term;
        }
        let zeros = terms.iter().rev().take_while(|&&term| term == Interval::ZERO).count();
        Moving { terms, count: N - zeros }
    }

    /// The function of this jet with the given value and derivative.
    fn with_slope(&self, value: Interval, slope: &Self) -> Self {
        let moving = self.moving();
        Self::from_terms(|k, _| if k == 0 { value } else { moving.integral(k, &slope.coefficients) })
    }

    /// `y` with `y' = (1 + sign y^2) u'`: tangent and hyperbolic tangent.
    fn tangent(&self, value: Interval, sign: Interval) -> Self {
        let (moving, mut slope) = (self.moving(), [Interval::ZERO; N]);
        let mut y = Self::constant(value);
        for k in 1..N {
            let square = sign * convolution(&y.coefficients, &y.coefficients, k - 1);
            slope[k - 1] = if k == 1 { Interval::ONE + square } else { square };
            y.coefficients[k] = moving.integral(k, &slope);
        }
        y
    }

    /// `(s, c)` with `s' = c u'` and `c' = sign s u'`: circular and hyperbolic functions.
    fn sine_and_cosine(&self, sine: Interval, cosine: Interval, sign: Interval) -> (Self, Self) {
        let moving = self.moving();
        let (mut s, mut c) = (Self::constant(sine), Self::constant(cosine));
        for k in 1..N {
            s.coefficients[k] = moving.integral(k, &c.coefficients);
            c.coefficients[k] = sign * moving.integral(k, &s.coefficients);
        }
        (s, c)
    }

    /// Two functions with these values and derivatives `slopes(f, g, g/u)` by this jet u: Bessel functions of orders 0 and 1.
    pub(super) fn bessel(
        &self,
        values: [Interval; 2],
        slopes: impl Fn(Interval, Interval, Interval) -> [Interval; 2],
    ) -> [Self; 2] {
        let [mut f, mut g] = values.map(Self::constant);
        let mut by_u = [[Interval::ZERO; N]; 2];
        let mut quotient = [Interval::ZERO; N];
        let (u, moving) = (&self.coefficients, self.moving());
        for k in 0..N {
            if k > 0 {
                f.coefficients[k] = moving.integral(k, &by_u[0]);
                g.coefficients[k] = moving.integral(k, &by_u[1]);
            }
            quotient[k] = (g.coefficients[k] - dot(&quotient[..k], &u[1..=k])) / u[0];
            [by_u[0][k], by_u[1][k]] = slopes(f.coefficients[k], g.coefficients[k], quotient[k]);
        }
        [f, g]
    }

    /// m and h with these values and m's slope, of which `m' = g`, `(1 - u^2) g' = p^2 m - (2p - 1) u g` and `h' = p m - u g` by
    /// this jet u: moments of a power of a biased sine.
    pub(super) fn power_moments(&self, [m, g, h]: [Interval; 3], p: Interval) -> [Self; 2] {
        let [mut m, mut g, mut h] = [m, g, h].map(Self::constant);
        let weight = (Self::one() - *self) * (Self::one() + *self);
        let (mut weighted, mut by_u, mut rates) = ([Interval::ZERO; N], [Interval::ZERO; N], [Interval::ZERO; N]);
        let (square, odd) = (p.square(), Interval::two() * p - Interval::ONE);
        let moving = self.moving();
        for k in 0..N {
            if k > 0 {
                m.coefficients[k] = moving.integral(k, &g.coefficients);
                h.coefficients[k] = moving.integral(k, &by_u);
                let known = dot(&weight.coefficients[1..k], &rates[1..k]);
                let rate = integer(k) * moving.integral(k, &weighted) - known;
                g.coefficients[k] = rate / (integer(k) * weight.coefficients[0]);
                rates[k] = rate / weight.coefficients[0];
            }
            let product = convolution(&self.coefficients, &g.coefficients, k);
            weighted[k] = square * m.coefficients[k] - odd * product;
            by_u[k] = p * m.coefficients[k] - product;
        }
        [m, h]
    }

    /// Sine and cosine, for the price of either.
    pub(crate) fn sin_cos(self) -> (Self, Self) {
        self.sine_and_cosine(self.value().sin(), self.value().cos(), -Interval::ONE)
    }

    /// `sqrt(1 - u^2)`.
    fn complement(self) -> Self {
        ((Self::one() - self) * (Self::one() + self)).sqrt()
    }
}

fn integer(k: usize) -> Interval {
    Interval::point(k as f64)
}

/// What moves a jet: see [`Jet::moving`].
struct Moving<const N: usize> {
    terms: [Interval; N],
    /// The terms from here on are zero.
    count: usize,
}

impl<const N: usize> Moving<N> {
    /// Coefficient `k` of the integral of `slope u'`; reads the slope's coefficients below `k`, or none if u is constant.
    fn integral(&self, k: usize, slope: &[Interval]) -> Interval {
        let last = k.min(self.count.max(1) - 1);
        if last == 0 {
            return Interval::ZERO;
        }
        dot(&self.terms[1..=last], &slope[k - last..k]) / integer(k)
    }
}

/// Convolution term: `sum_k forward[k] backward[n - 1 - k]`.
fn dot(forward: &[Interval], backward: &[Interval]) -> Interval {
    Interval::dot(forward.iter().copied().zip(backward.iter().rev().copied()))
}

/// Coefficient `k` of the product of two series.
fn convolution(a: &[Interval], b: &[Interval], k: usize) -> Interval {
    dot(&a[..=k], &b[..=k])
}

operators! {
    [Jet<N>, const N: usize]
    Neg::neg = |a| Self { coefficients: a.coefficients.map(|c| -c) };
    Add::add = |a, b| Self { coefficients: array::from_fn(|k| a.coefficients[k] + b.coefficients[k]) };
    Sub::sub = |a, b| Self { coefficients: array::from_fn(|k| a.coefficients[k] - b.coefficients[k]) };
}

impl<const N: usize> Mul for Jet<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if other.is_constant() {
            return Self { coefficients: self.coefficients.map(|c| c * other.value()) };
        }
        if self.is_constant() {
            return other * self;
        }
        Self { coefficients: array::from_fn(|k| convolution(&self.coefficients, &other.coefficients, k)) }
    }
}

impl<const N: usize> Div for Jet<N> {
    type Output = Self;
    fn div(self, divisor: Self) -> Self {
        if divisor.is_constant() {
            return Self { coefficients: self.coefficients.map(|c| c / divisor.value()) };
        }
        let b = &divisor.coefficients;
        Self::from_terms(|k, q| (self.coefficients[k] - dot(q, &b[1..=k])) / b[0])
    }
}

impl<const N: usize> Real for Jet<N> {
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
        self.value().bounds()
    }
    fn abs(self) -> Self {
        match self.value() {
            value if value.is_positive() => self,
            value if value.is_negative() => -self,
            value => Self::kink(value.abs()),
        }
    }
    fn min(self, other: Self) -> Self {
        match (self.value(), other.value()) {
            (a, b) if a.precedes(b) => self,
            (a, b) if b.precedes(a) => other,
            (a, b) => Self::kink(a.min(b)),
        }
    }
    fn max(self, other: Self) -> Self {
        -(-self).min(-other)
    }
    fn square(self) -> Self {
        let mut square = self * self;
        square.coefficients[0] = self.value().square();
        square
    }
    fn pow(self, exponent: Self) -> Self {
        if self.is_constant() && exponent.is_constant() {
            Self::constant(self.value().pow(exponent.value()))
        } else if let (Some(count), true) = (exponent.value().small_natural(), exponent.is_constant()) {
            (0..count).fold(Self::one(), |power, _| power * self)
        } else if self.value().is_positive() && exponent.is_constant() {
            // From x y' = exponent x' y: k x_0 y_k is the sum of ((exponent + 1) j - k) x_j y_(k - j).
            let (x, power) = (&self.coefficients, exponent.value());
            let rates: [Interval; N] = array::from_fn(|j| (power + Interval::ONE) * integer(j));
            Self::from_terms(|k, y| match k {
                0 => x[0].pow(power),
                _ => {
                    let weighted = (1..=k).map(|j| ((rates[j] - integer(k)) * x[j], y[k - j]));
                    Interval::dot(weighted) / (integer(k) * x[0])
                }
            })
        } else if self.value().is_positive() {
            (exponent * self.ln()).exp()
        } else {
            Self::kink(self.value().pow(exponent.value()))
        }
    }
    fn floor(self) -> Self {
        let floor = self.value().floor();
        if floor.is_point() { Self::constant(floor) } else { Self::kink(floor) }
    }
    fn select_all<const M: usize>(
        self,
        below: impl FnOnce() -> [Self; M],
        above: impl FnOnce() -> [Self; M],
    ) -> [Self; M] {
        match self.value() {
            value if value.is_positive() => above(),
            value if value.upper() <= 0.0 => below(),
            value => {
                let values = |branch: [Self; M]| branch.map(|number| number.value());
                value.select_all(|| values(below()), || values(above())).map(Self::kink)
            }
        }
    }
    fn prefer_all<const M: usize>(
        self,
        below: impl FnOnce() -> [Self; M],
        above: impl FnOnce() -> [Self; M],
    ) -> [Self; M] {
        match self.value() {
            value if value.is_positive() => above(),
            value if value.upper() <= 0.0 => below(),
            _ => {
                let (below, above) = (below(), above());
                let hull = |i: usize, k: usize| below[i].coefficients[k].hull(above[i].coefficients[k]);
                array::from_fn(|i| Self { coefficients: array::from_fn(|k| hull(i, k)) })
            }
        }
    }
    fn inflate(mut self, error: f64) -> Self {
        self.coefficients[0] = self.coefficients[0].inflate(error);
        self
    }
    fn minus_own_sine(self, sine: Self) -> Self {
        let mut difference = self - sine;
        difference.coefficients[0] = self.value().minus_own_sine(sine.value());
        difference
    }
    fn sqrt(self) -> Self {
        Self::from_terms(|k, s| match k {
            0 => self.value().sqrt(),
            _ => (self.coefficients[k] - dot(&s[1..], &s[1..])) / (Interval::two() * s[0]),
        })
    }
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    fn tan(self) -> Self {
        self.tangent(self.value().tan(), Interval::ONE)
    }
    fn asin(self) -> Self {
        self.with_slope(self.value().asin(), &(Self::one() / self.complement()))
    }
    fn acos(self) -> Self {
        self.with_slope(self.value().acos(), &(-Self::one() / self.complement()))
    }
    fn atan(self) -> Self {
        self.with_slope(self.value().atan(), &(Self::one() / (Self::one() + self.square())))
    }
    fn exp(self) -> Self {
        let moving = self.moving();
        Self::from_terms(|k, y| if k == 0 { self.value().exp() } else { moving.integral(k, y) })
    }
    fn exp_m1(self) -> Self {
        self.with_slope(self.value().exp_m1(), &self.exp())
    }
    fn ln(self) -> Self {
        self.with_slope(self.value().ln(), &(Self::one() / self))
    }
    fn ln_1p(self) -> Self {
        self.with_slope(self.value().ln_1p(), &(Self::one() / (Self::one() + self)))
    }
    fn sinh(self) -> Self {
        self.sine_and_cosine(self.value().sinh(), self.value().cosh(), Interval::ONE).0
    }
    fn cosh(self) -> Self {
        self.sine_and_cosine(self.value().sinh(), self.value().cosh(), Interval::ONE).1
    }
    fn tanh(self) -> Self {
        self.tangent(self.value().tanh(), -Interval::ONE)
    }
    fn atanh(self) -> Self {
        self.with_slope(self.value().atanh(), &(Self::one() / ((Self::one() - self) * (Self::one() + self))))
    }
}
