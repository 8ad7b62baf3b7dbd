//! Switchings at instants in doubt: what they may have done so far, and what they have once the doubt is over.

use super::super::bend::{Pairs, gathered, most, weights};
use super::super::field::{FORCE, Field, POSITION, Term, Triple, VELOCITY};
use super::super::mix::Bundle;
use super::super::step::Fields;
use super::Way;
use crate::numeric::{Balls, Interval, Real};

#[cfg(test)]
mod tests;

/// A switching that may have happened.
pub(super) struct Open {
    pub(super) edge: usize,
    /// What a unit of impulse then may have become since.
    pub(super) impulse: Triple,
    /// Whether it has not happened before the beginning.
    pub(super) whole: bool,
    /// Slopes of the acceleration by the velocity since.
    pub(super) damping: Option<Interval>,
}

/// What a switching at an instant in doubt does to a motion by the end of the doubt, when it comes later by z: to position and velocity
/// `first z + twice z^2/2`, and of a change of the gain by g `mixed g z`.
#[derive(Clone, Copy, Debug)]
struct Switching {
    first: [Interval; 2],
    twice: [Interval; 2],
    mixed: [Interval; 2],
    /// Of the third order.
    rest: [Interval; 2],
}

impl Switching {
    /// By `drop` after `since_s` from the point's own instant, and at most `doubt_s` from any; slopes of the acceleration by the velocity
    /// were in `damping` meanwhile.
    fn new(over: &Field, at: &Field, drop: Interval, damping: Interval, since_s: Interval, doubt_s: f64) -> Self {
        let (w, half) = (Interval::point(doubt_s), Interval::point(0.5));
        let stiffness = if over.has(Term::Stiffness) { most(over.term(Term::Stiffness)) } else { Interval::ZERO };
        let (mean, strong) = (Interval::point(damping.midpoint()), most(damping));
        let grown = ((strong + stiffness * w) * w).exp();
        let third = stiffness * w * w * w / Interval::point(6.0);
        // How far what remains of a unit impulse is off 1 + mean t, and its way off t.
        let off_way = (strong * half * w * w + third) * grown;
        let off = Interval::point(damping.radius()) * w
            + ((strong.square() + stiffness) * half * w * w + strong * third) * grown;
        let (push, all) = (at.term(Term::Gain) * drop, most(over.term(Term::Gain) * drop));
        let unit = [since_s, Interval::ONE + mean * since_s];
        let doubt = [off_way, off].map(|off| Interval::symmetric((all * off).upper()));
        let apart = most(over.term(Term::Gain) - at.term(Term::Gain)) * most(drop) * half * w * w;
        Self {
            first: core::array::from_fn(|k| push * unit[k] + doubt[k]),
            twice: [-push, -(push * mean)],
            mixed: unit.map(|unit| drop * unit),
            rest: [apart, apart * most(mean)].map(|rest| Interval::symmetric(rest.upper())),
        }
    }

    /// Adds to how slopes bend.
    fn bend(&self, pairs: &Pairs, bundles: &[Bundle], edge: usize, bends: &mut [[Balls; 3]]) {
        let shifts: Vec<Balls> = bundles.iter().map(|bundle| bundle.shifts(edge).unwrap_or(Balls::ZERO)).collect();
        for (sides, bend) in pairs.sides.iter().zip(bends) {
            let [shift, other] = sides.map(|seats| gathered(&shifts, seats, |shifts| shifts));
            let [gain, other_gain] = sides.map(|seats| weights(bundles, seats, Term::Gain));
            let (both, mixed) = (shift * other, gain * other + other_gain * shift);
            for k in [POSITION, VELOCITY] {
                bend[k] = bend[k] + both * Balls::splat(self.twice[k]) + mixed * Balls::splat(self.mixed[k]);
            }
        }
    }
}

impl Way<'_> {
    /// Columns with what open switchings may have added.
    pub(super) fn with_open(&self, bundle: &Bundle, mut columns: [Balls; 3]) -> [Balls; 3] {
        for Open { edge, impulse, .. } in &self.open {
            if let Some(shifts) = bundle.shifts(*edge) {
                for (values, impulse) in columns.iter_mut().zip(impulse) {
                    *values = *values + shifts * Balls::splat(self.sized(*edge, *impulse).hull(Interval::ZERO));
                }
            }
        }
        columns
    }

    /// An impulse of the size that a later switching has.
    fn sized(&self, edge: usize, impulse: Interval) -> Interval {
        let field = &self.drive.fields.over;
        let factor = field.term(if self.lagged() { Term::LagRate } else { Term::Gain });
        factor * self.drive.command.drop_at(edge) * impulse
    }

    /// A unit impulse just now.
    pub(super) fn fresh(&self) -> Triple {
        let mut impulse = [Interval::ZERO; 3];
        impulse[if self.lagged() { FORCE } else { VELOCITY }] = Interval::ONE;
        impulse
    }

    /// At the end of a window in which a switching has happened, the point's own in a window of its own.
    pub(super) fn close(&mut self, edge: usize, window: (f64, f64), own: (f64, f64)) {
        let Some(place) = self.open.iter().position(|open| open.edge == edge) else { return };
        let Open { impulse, whole, damping, .. } = self.open.swap_remove(place);
        let mut added = impulse.map(|impulse| self.sized(edge, impulse));
        if let (Some(pairs), Some(damping), true, false) = (&self.pairs, damping, whole, self.lagged()) {
            let Fields { over, at } = &self.drive.fields;
            let close = Interval::point(window.1);
            let since_s = (close - Interval::point(own.1)).hull(close - Interval::point(own.0));
            let doubt_s = (close - Interval::point(window.0)).upper();
            let switching = Switching::new(over, at, self.drive.command.drop_at(edge), damping, since_s, doubt_s);
            for k in [POSITION, VELOCITY] {
                added[k] = switching.first[k];
                self.rest[k] += switching.rest[k];
            }
            switching.bend(pairs, self.bundles, edge, &mut self.bends);
        }
        let added = added.map(Balls::splat);
        for (bundle, columns) in self.bundles.iter().zip(&mut self.columns) {
            if let Some(shifts) = bundle.shifts(edge) {
                for (values, added) in columns.iter_mut().zip(added) {
                    *values = *values + shifts * added;
                }
            }
        }
    }
}
