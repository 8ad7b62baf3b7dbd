//! Columns of slopes, and what they bend: coefficients in time, as numbers or as what these are at most.

use core::ops::{Add, Mul};

use super::super::field::{FORCE, POSITION, Term, VELOCITY};
use super::super::mix::Bundle;
use super::super::series::ORDER;
use super::{Seat, gathered, weights};
use crate::numeric::{Balls, Sizes};

/// The highest degree of what bends.
pub(in super::super) const BEND_ORDER: usize = 8;
// A step's powers of time reach as far.
const _: () = assert!(BEND_ORDER <= ORDER);

/// Polynomials of a lower order.
pub(super) type Short<T> = [T; BEND_ORDER + 1];

/// Numbers side by side, or what they are at most.
pub(in super::super) trait Number: Copy + Add<Output = Self> + Mul<Output = Self> {
    const NONE: Short<Self>;

    fn of(weight: Balls) -> Self;
    /// With the other sign, where it has one.
    fn turned(self) -> Self;
    fn dot(pairs: impl Iterator<Item = (Self, Self)>) -> Self;
    /// Each from a place of its own.
    fn gather(from: [(&Self, usize); Balls::COUNT]) -> Self;
}

impl Number for Balls {
    const NONE: Short<Self> = [Self::ZERO; BEND_ORDER + 1];

    #[inline]
    fn of(weight: Balls) -> Self {
        weight
    }
    #[inline]
    fn turned(self) -> Self {
        -self
    }
    #[inline]
    fn dot(pairs: impl Iterator<Item = (Self, Self)>) -> Self {
        Self::dot(pairs)
    }
    #[inline]
    fn gather(from: [(&Self, usize); Self::COUNT]) -> Self {
        Self::gather(from)
    }
}

impl Number for Sizes {
    const NONE: Short<Self> = [Self::ZERO; BEND_ORDER + 1];

    #[inline]
    fn of(weight: Balls) -> Self {
        weight.sizes()
    }
    #[inline]
    fn turned(self) -> Self {
        self
    }
    #[inline]
    fn dot(pairs: impl Iterator<Item = (Self, Self)>) -> Self {
        Self::dot(pairs)
    }
    #[inline]
    fn gather(from: [(&Self, usize); Balls::COUNT]) -> Self {
        Self::gather(from)
    }
}

/// The pairs of a product's coefficient.
#[inline]
pub(super) fn products<'a, T: Copy>(a: &'a [T], b: &'a [T], k: usize) -> impl Iterator<Item = (T, T)> + 'a {
    a[..=k].iter().copied().zip(b[..=k].iter().rev().copied())
}

/// Coefficients of what bends the damping: of velocities, and of what its terms multiply.
pub(super) struct Damping<T> {
    pub(super) kinks: Short<T>,
    pub(super) terms: [Short<T>; 3],
}

impl<T> Damping<T> {
    pub(super) const TERMS: [Term; 3] = [Term::Linear, Term::Quadratic, Term::Cubic];

    pub(super) fn by(&self, term: Term) -> &Short<T> {
        match term {
            Term::Quadratic => &self.terms[1],
            Term::Cubic => &self.terms[2],
            _ => &self.terms[0],
        }
    }
}

/// A column of slopes, and what of it bends the others.
pub(super) struct Column<T> {
    pub(super) path: [Short<T>; 3],
    pub(super) damps: Short<T>,
}

impl<T: Number> Column<T> {
    /// By the unknowns of a bundle, up to a degree.
    pub(super) fn of(path: [Short<T>; 3], bundle: &Bundle, damping: &Damping<T>, order: usize) -> Self {
        let mut damps = T::NONE;
        for (k, damps) in damps.iter_mut().enumerate().take(order + 1) {
            let terms = bundle.damping_terms().map(|(term, weight)| (T::of(weight), damping.by(term)[k]));
            *damps = T::dot(terms) + T::dot(products(&damping.kinks, &path[VELOCITY], k));
        }
        Self { path, damps }
    }
}

/// Coefficients, of degrees below `order`, of what pushes the bends of velocity and force by some pairs of unknowns. Where there is
/// neither a spring nor a lag, the damping alone does.
pub(super) fn pushed<T: Number>(
    columns: &[Column<T>],
    bundles: &[Bundle],
    sides: &[[Seat; Balls::COUNT]; 2],
    [stiff, lagged]: [bool; 2],
    order: usize,
) -> [Short<T>; 2] {
    let (mut moved, mut filled) = (T::NONE, T::NONE);
    let (mut damps, mut v) = ([T::NONE; 2], [T::NONE; 2]);
    for k in 0..order {
        for (side, seats) in sides.iter().enumerate() {
            damps[side][k] = gathered(columns, *seats, |column| &column.damps[k]);
            v[1 - side][k] = gathered(columns, *seats, |column| &column.path[VELOCITY][k]);
        }
        moved[k] = T::dot(products(&damps[0], &v[0], k).chain(products(&damps[1], &v[1], k))).turned();
    }
    for side in [0, 1] {
        let weight = |term: Term| T::of(weights(bundles, sides[side], term));
        let other = |component: usize, k: usize| {
            gathered(columns, sides[1 - side], |column: &Column<T>| &column.path[component][k])
        };
        if stiff {
            let stiffness = weight(Term::Stiffness).turned();
            for (k, moved) in moved.iter_mut().enumerate().take(order) {
                *moved = *moved + stiffness * other(POSITION, k);
            }
        }
        if lagged {
            let (gain, lag) = (weight(Term::Gain), weight(Term::LagRate).turned());
            for (k, (moved, filled)) in moved.iter_mut().zip(&mut filled).enumerate().take(order) {
                let force = other(FORCE, k);
                *moved = *moved + gain * force;
                *filled = *filled + lag * force;
            }
        }
    }
    [moved, filled]
}
