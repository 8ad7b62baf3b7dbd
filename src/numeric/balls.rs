//! Several intervals side by side, each as a middle and a radius: long sums of products by plain floats.
//!
//! Roundings are counted, not directed: a sum of n rounded products is off by at most n half epsilons of the sum of magnitudes (Rump,
//! *Acta Numerica* 19, 2010). For a product of wide ones this is wider than [`Interval`] by the product of the radii.

#[cfg(test)]
mod tests;

use core::ops::{Add, Mul, Neg, Sub};

use wide::f64x4;

use super::Interval;

/// More than what all products of a sum lose by underflow.
const UNDERFLOW: f64 = 1e-300;

/// A share that is more than all roundings of a sum of so many products.
#[inline]
fn roundings(products: usize) -> f64 {
    (products + 4) as f64 * f64::EPSILON
}

/// What makes up for the roundings of a radius: it is the sum of so many products, and of as many again.
#[inline]
fn larger(products: usize) -> f64 {
    1.0 + 4.0 * roundings(products)
}

/// Each is every real number that is off its middle by no more than its radius; an infinite or undefined one stands for all numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Balls {
    middle: f64x4,
    radius: f64x4,
}

impl Balls {
    /// So many.
    pub(crate) const COUNT: usize = 4;
    pub(crate) const ZERO: Self = Self { middle: f64x4::ZERO, radius: f64x4::ZERO };
    pub(crate) const ONE: Self = Self { middle: f64x4::ONE, radius: f64x4::ZERO };

    /// One after the other.
    #[inline]
    pub(crate) fn new(values: [Interval; Self::COUNT]) -> Self {
        Self { middle: f64x4::new(values.map(Interval::midpoint)), radius: f64x4::new(values.map(Interval::radius)) }
    }

    /// The same in every place.
    #[inline]
    pub(crate) fn splat(value: Interval) -> Self {
        Self { middle: f64x4::splat(value.midpoint()), radius: f64x4::splat(value.radius()) }
    }

    /// Finite numbers.
    #[inline]
    pub(crate) fn points(values: [f64; Self::COUNT]) -> Self {
        Self { middle: f64x4::new(values), radius: f64x4::ZERO }
    }

    /// One of them in every place.
    #[inline]
    pub(crate) fn spread(self, place: usize) -> Self {
        Self {
            middle: f64x4::splat(self.middle.to_array()[place]),
            radius: f64x4::splat(self.radius.to_array()[place]),
        }
    }

    /// Those at these places.
    #[inline]
    pub(crate) fn at_places(self, places: [usize; Self::COUNT]) -> Self {
        Self::gather(places.map(|place| (&self, place)))
    }

    /// Each from a place of its own.
    #[inline]
    pub(crate) fn gather(from: [(&Self, usize); Self::COUNT]) -> Self {
        let [a, b, c, d] = from;
        let middle = |(balls, place): (&Self, usize)| balls.middle.as_array()[place];
        let radius = |(balls, place): (&Self, usize)| balls.radius.as_array()[place];
        Self {
            middle: f64x4::new([middle(a), middle(b), middle(c), middle(d)]),
            radius: f64x4::new([radius(a), radius(b), radius(c), radius(d)]),
        }
    }

    #[inline]
    fn interval(middle: f64, radius: f64) -> Interval {
        // What is not finite says nothing.
        if !(middle.is_finite() && radius.is_finite()) {
            return Interval::ENTIRE;
        }
        Interval::point(middle) + Interval::symmetric(radius)
    }

    /// As intervals.
    #[inline]
    pub(crate) fn intervals(self) -> [Interval; Self::COUNT] {
        let (middle, radius) = (self.middle.to_array(), self.radius.to_array());
        core::array::from_fn(|place| Self::interval(middle[place], radius[place]))
    }

    /// One of them.
    #[inline]
    pub(crate) fn interval_at(self, place: usize) -> Interval {
        Self::interval(self.middle.to_array()[place], self.radius.to_array()[place])
    }

    /// Everything within these sizes.
    #[inline]
    pub(crate) fn within(sizes: Sizes) -> Self {
        Self { middle: f64x4::ZERO, radius: sizes.0 }
    }

    /// What no element exceeds in magnitude.
    #[inline]
    pub(crate) fn sizes(self) -> Sizes {
        Sizes((self.middle.abs() + self.radius) * larger(1))
    }

    /// Divided by a whole number.
    #[inline]
    pub(crate) fn share(self, parts: usize) -> Self {
        let part = 1.0 / parts as f64;
        let middle = self.middle * part;
        let rounded = middle.abs() * roundings(1);
        Self { middle, radius: (self.radius * part + rounded) * larger(1) + UNDERFLOW }
    }

    /// The sum of all of them.
    #[inline]
    pub(crate) fn total(self) -> Interval {
        let [a, b, c, d] = self.intervals();
        (a + b) + (c + d)
    }

    /// The sum of products.
    #[inline]
    pub(crate) fn dot(pairs: impl Iterator<Item = (Self, Self)>) -> Self {
        let (mut middle, mut size, mut radius, mut count) = (f64x4::ZERO, f64x4::ZERO, f64x4::ZERO, 0);
        for (a, b) in pairs {
            let (product, far) = (a.middle * b.middle, b.middle.abs() + b.radius);
            middle += product;
            size += product.abs();
            radius += a.middle.abs() * b.radius + a.radius * far;
            count += 1;
        }
        Self { middle, radius: (radius + size * roundings(count)) * larger(count) + UNDERFLOW }
    }
}

impl Add for Balls {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let middle = self.middle + other.middle;
        let rounded = middle.abs() * f64::EPSILON;
        Self { middle, radius: (self.radius + other.radius + rounded) * larger(1) }
    }
}

impl Neg for Balls {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { middle: -self.middle, radius: self.radius }
    }
}

impl Sub for Balls {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Balls {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self::dot(core::iter::once((self, other)))
    }
}

/// Upper bounds of magnitudes, side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sizes(f64x4);

impl Sizes {
    pub(crate) const ZERO: Self = Self(f64x4::ZERO);

    /// The same in every place: the magnitude of an interval.
    #[inline]
    pub(crate) fn splat(value: Interval) -> Self {
        Self(f64x4::splat(value.magnitude()))
    }

    /// One of them in every place.
    #[inline]
    pub(crate) fn spread(self, place: usize) -> Self {
        Self(f64x4::splat(self.0.to_array()[place]))
    }

    /// Each from a place of its own.
    #[inline]
    pub(crate) fn gather(from: [(&Self, usize); Balls::COUNT]) -> Self {
        let [a, b, c, d] = from;
        let size = |(sizes, place): (&Self, usize)| sizes.0.as_array()[place];
        Self(f64x4::new([size(a), size(b), size(c), size(d)]))
    }

    /// The first of them.
    pub(crate) fn interval(self) -> Interval {
        Interval::point(self.0.to_array()[0])
    }

    /// The sum of all of them, at most.
    pub(crate) fn total(self) -> Interval {
        let [a, b, c, d] = self.0.to_array().map(Interval::point);
        (a + b) + (c + d)
    }

    /// Of sums of products.
    #[inline]
    pub(crate) fn dot(pairs: impl Iterator<Item = (Self, Self)>) -> Self {
        let (mut sum, mut count) = (f64x4::ZERO, 0);
        for (Self(a), Self(b)) in pairs {
            sum += a * b;
            count += 1;
        }
        Self(sum * larger(count) + UNDERFLOW)
    }

    /// Divided by a whole number.
    #[inline]
    pub(crate) fn share(self, parts: usize) -> Self {
        Self(self.0 * (larger(1) / parts as f64) + UNDERFLOW)
    }
}

impl Add for Sizes {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self((self.0 + other.0) * larger(1))
    }
}

impl Mul for Sizes {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0 * larger(1) + UNDERFLOW)
    }
}
