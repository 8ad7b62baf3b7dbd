//! The second order: how slopes bend over the box.
//!
//! With s the difference of the motions of theta and of the point, and `s' = A(theta) s + sum z_j P_j` its equation, columns follow
//! `J_j' = A J_j + P_j` with the point's own A. What `s` differs by from `sum z_j J_j` is `sum z_i z_j H_ij`, of squares the half, and
//! a rest of the third order. `H_ij' = A H_ij + f_ij`, in which `f_ij` is what A changes by with one unknown times the column by the
//! other. What slopes over a box leave in doubt adds up from switching to switching; H, of either sign, hardly does. What drives the rest
//! are H and the rest times what the damping changes by as a whole, terms and columns of either sign together.

use super::field::{Term, Triple};
use super::mix::{Bundle, Mix};
use crate::numeric::{Balls, Interval, Real};

use column::Number;

pub(super) use column::BEND_ORDER;
pub(super) use curve::Curve;
pub(super) use ground::Ground;
pub(super) use rest::{BENT, Rest, parts};

mod column;
mod curve;
mod ground;
mod rest;
#[cfg(test)]
mod tests;

/// All pairs of unknowns that move anything, each with those before it and itself.
pub(super) fn pairs(mixes: &[Mix]) -> Vec<[usize; 2]> {
    let moving: Vec<usize> = (0..mixes.len()).filter(|place| mixes[*place].moves()).collect();
    moving.iter().enumerate().flat_map(|(rank, i)| moving[..=rank].iter().map(move |j| [*i, *j])).collect()
}

/// What `z_i z_j` can be; of a square the half.
pub(super) fn product_of([i, j]: [usize; 2], z: &[Interval]) -> Interval {
    if i == j { z[i].square() * Interval::point(0.5) } else { z[i] * z[j] }
}

/// Where an unknown stands: in which bundle, and at which place of it.
pub(super) type Seat = (usize, usize);

/// Pairs of unknowns, side by side.
#[derive(Clone, Debug)]
pub(super) struct Pairs {
    /// The first of each pair, and the second.
    pub(super) sides: Vec<[[Seat; Balls::COUNT]; 2]>,
    products: Vec<Balls>,
}

impl Pairs {
    /// Of all unknowns that move anything.
    pub(super) fn of(mixes: &[Mix], deviations: &[Interval]) -> Self {
        let all = pairs(mixes);
        let rows = all.chunks(Balls::COUNT);
        // Places that are left over repeat the first, and count for nothing.
        let seat = |row: &[[usize; 2]], side: usize, lane: usize| {
            let unknown = row.get(lane).unwrap_or(&row[0])[side];
            (unknown / Balls::COUNT, unknown % Balls::COUNT)
        };
        let product = |pair: Option<&[usize; 2]>| pair.map_or(Interval::ZERO, |pair| product_of(*pair, deviations));
        Self {
            sides: rows
                .clone()
                .map(|row| [0, 1].map(|side| core::array::from_fn(|lane| seat(row, side, lane))))
                .collect(),
            products: rows.map(|row| Balls::new(core::array::from_fn(|lane| product(row.get(lane))))).collect(),
        }
    }

    pub(super) fn count(&self) -> usize {
        self.sides.len()
    }

    /// What all of them add.
    pub(super) fn total(&self, bends: &[[Balls; 3]], component: usize) -> Interval {
        Balls::dot(bends.iter().map(|bend| bend[component]).zip(self.products.iter().copied())).total()
    }
}

/// Something of each of four unknowns.
#[inline]
pub(super) fn gathered<T, N: Number>(columns: &[T], [a, b, c, d]: [Seat; Balls::COUNT], of: impl Fn(&T) -> &N) -> N {
    let from = |(bundle, place): Seat| (of(&columns[bundle]), place);
    N::gather([from(a), from(b), from(c), from(d)])
}

/// How much of a term each of four unknowns moves.
pub(super) fn weights(bundles: &[Bundle], seats: [Seat; Balls::COUNT], term: Term) -> Balls {
    Balls::points(seats.map(|(bundle, place)| bundles[bundle].weight(term, place)))
}

/// What a motion over a box carries.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carried<'a> {
    pub(super) bundles: &'a [Bundle],
    /// Slopes by the unknowns of each bundle.
    pub(super) columns: &'a [[Balls; 3]],
    /// Pairs of unknowns, and how slopes bend by each; none where slopes are over the box.
    pub(super) pairs: Option<&'a Pairs>,
    pub(super) bends: &'a [[Balls; 3]],
    /// Of the third order.
    pub(super) rest: Triple,
}

impl Carried<'_> {
    /// One point.
    pub(super) const NOTHING: Self =
        Self { bundles: &[], columns: &[], pairs: None, bends: &[], rest: [Interval::ZERO; 3] };

    /// Whether no unknown is off the point.
    pub(super) fn of_point(&self) -> bool {
        self.bundles.iter().all(|bundle| bundle.deviations.sizes().at_most(0.0))
    }
}

/// The magnitude.
pub(super) fn most(value: Interval) -> Interval {
    Interval::point(value.magnitude())
}
