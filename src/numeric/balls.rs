//! Several intervals side by side, each as a middle and a radius: long sums of products by plain floats.
//!
//! Roundings are counted, not directed: a sum of n rounded products is off by at most n half epsilons of the sum of magnitudes (Rump,
//! *Acta Numerica* 19, 2010). For a product of wide factors this is wider than [`Interval`] by the product of the radii.

#[cfg(test)]
#[path = "../../tests/properties/private/balls.rs"]
mod tests;

use wide::f64x4;

use super::Interval;
use super::real::operators;

/// More than all products of a sum lose by underflow.
const UNDERFLOW: f64 = 1e-300;

/// A share that is more than all roundings of a sum of `products` products.
#[inline]
fn roundings(products: usize) -> f64 {
    (products + 4) as f64 * f64::EPSILON
}

/// A factor that covers the roundings of a radius, a sum of twice `products` products.
#[inline]
fn larger(products: usize) -> f64 {
    1.0 + 4.0 * roundings(products)
}

/// Each is every real number that is off its middle by no more than its radius; an infinite or undefined radius stands for all numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Balls {
    // Arrays: the allocator is slow where more than its own alignment is asked for.
    middle: [f64; Balls::COUNT],
    radius: [f64; Balls::COUNT],
}

impl Balls {
    /// So many.
    pub(crate) const COUNT: usize = 4;
    pub(crate) const ZERO: Self = Self { middle: [0.0; Self::COUNT], radius: [0.0; Self::COUNT] };
    pub(crate) const ONE: Self = Self { middle: [1.0; Self::COUNT], radius: [0.0; Self::COUNT] };

    #[inline]
    fn of(middle: f64x4, radius: f64x4) -> Self {
        Self { middle: middle.to_array(), radius: radius.to_array() }
    }

    #[inline]
    fn middle(self) -> f64x4 {
        f64x4::new(self.middle)
    }

    #[inline]
    fn radius(self) -> f64x4 {
        f64x4::new(self.radius)
    }

    /// Lanes in sequence.
    #[inline]
    pub(crate) fn new(values: [Interval; Self::COUNT]) -> Self {
        Self { middle: values.map(Interval::midpoint), radius: values.map(Interval::radius) }
    }

    /// The same in every place.
    #[inline]
    pub(crate) fn splat(value: Interval) -> Self {
        Self { middle: [value.midpoint(); Self::COUNT], radius: [value.radius(); Self::COUNT] }
    }

    /// Finite numbers.
    #[inline]
    pub(crate) fn points(values: [f64; Self::COUNT]) -> Self {
        Self { middle: values, radius: [0.0; Self::COUNT] }
    }

    /// One of them in every place.
    #[inline]
    pub(crate) fn spread(self, place: usize) -> Self {
        Self { middle: [self.middle[place]; Self::COUNT], radius: [self.radius[place]; Self::COUNT] }
    }

    /// As intervals.
    #[inline]
    pub(crate) fn intervals(self) -> [Interval; Self::COUNT] {
        core::array::from_fn(|place| self.interval_at(place))
    }

    /// One of them.
    #[inline]
    pub(crate) fn interval_at(self, place: usize) -> Interval {
        let (middle, radius) = (self.middle[place], self.radius[place]);
        // A ball that is not finite encloses nothing useful: the entire line.
        if middle.is_finite() && radius.is_finite() {
            Interval::point(middle) + Interval::symmetric(radius)
        } else {
            Interval::ENTIRE
        }
    }

    /// Everything within these sizes.
    #[inline]
    pub(crate) fn within(sizes: Sizes) -> Self {
        Self { middle: [0.0; Self::COUNT], radius: sizes.0 }
    }

    /// Upper bounds of all elements' magnitudes.
    #[inline]
    pub(crate) fn sizes(self) -> Sizes {
        Sizes::of((self.middle().abs() + self.radius()) * larger(1))
    }

    /// Divided by a whole number.
    #[inline]
    pub(crate) fn share(self, parts: usize) -> Self {
        let part = 1.0 / parts as f64;
        let middle = self.middle() * part;
        let rounded = middle.abs() * roundings(1);
        Self::of(middle, (self.radius() * part + rounded) * larger(1) + UNDERFLOW)
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
            let (product, far) = (a.middle() * b.middle(), b.middle().abs() + b.radius());
            middle += product;
            size += product.abs();
            radius += a.middle().abs() * b.radius() + a.radius() * far;
            count += 1;
        }
        Self::of(middle, (radius + size * roundings(count)) * larger(count) + UNDERFLOW)
    }
}

operators! {
    [#[inline] Balls]
    Neg::neg = |a| Self { middle: a.middle.map(|middle| -middle), ..a };
    Add::add = |a, b| {
        let middle = a.middle() + b.middle();
        let rounded = middle.abs() * f64::EPSILON;
        Self::of(middle, (a.radius() + b.radius() + rounded) * larger(1))
    };
    Sub::sub = |a, b| a + -b;
    Mul::mul = |a, b| Self::dot(core::iter::once((a, b)));
}

/// Upper bounds of magnitudes, side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sizes([f64; Balls::COUNT]);

impl Sizes {
    pub(crate) const ZERO: Self = Self([0.0; Balls::COUNT]);

    #[inline]
    fn of(sizes: f64x4) -> Self {
        Self(sizes.to_array())
    }

    #[inline]
    fn wide(self) -> f64x4 {
        f64x4::new(self.0)
    }

    /// The same in every place: the magnitude of an interval.
    #[inline]
    pub(crate) fn splat(value: Interval) -> Self {
        Self([value.magnitude(); Balls::COUNT])
    }

    /// One of them in every place.
    #[inline]
    pub(crate) fn spread(self, place: usize) -> Self {
        Self([self.0[place]; Balls::COUNT])
    }

    /// The first of them.
    pub(crate) fn interval(self) -> Interval {
        Interval::point(self.0[0])
    }

    /// Of sums of products.
    #[inline]
    pub(crate) fn dot(pairs: impl Iterator<Item = (Self, Self)>) -> Self {
        let (mut sum, mut count) = (f64x4::ZERO, 0);
        for (a, b) in pairs {
            sum += a.wide() * b.wide();
            count += 1;
        }
        Self::of(sum * larger(count) + UNDERFLOW)
    }

    /// Divided by a whole number.
    #[inline]
    pub(crate) fn share(self, parts: usize) -> Self {
        Self::of(self.wide() * (larger(1) / parts as f64) + UNDERFLOW)
    }
}

operators! {
    [#[inline] Sizes]
    Add::add = |a, b| Self::of((a.wide() + b.wide()) * larger(1));
    Mul::mul = |a, b| Self::of(a.wide() * b.wide() * larger(1) + UNDERFLOW);
}
