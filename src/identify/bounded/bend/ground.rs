//! What a step is made on: the equation, and the point's motion in it; and how large columns and what they bend are there at most.

use super::super::field::{Field, Term, Triple};
use super::super::mix::Bundle;
use super::super::series::{Equations, Motions, Slopes};
use super::super::step::Fields;
use super::column::{Column, Damping, Number, Short, pushed};
use super::{Carried, Pairs};
use crate::numeric::{Balls, Interval, Sizes};

/// The equation over the box and at the point, and the point's motion in a step.
pub(in super::super) struct Ground<'a> {
    pub(in super::super) own: Equations,
    pub(in super::super) slopes: Slopes,
    pub(super) over: &'a Field,
    pub(super) at: &'a Field,
    backwards: bool,
}

/// How large coefficients are over a step at most.
pub(in super::super) struct Largest {
    pub(super) damping: Damping<Sizes>,
    /// By each bundle of unknowns.
    pub(super) columns: Vec<Column<Sizes>>,
    /// What pushes the bends of velocity and force by each bundle of pairs.
    pub(super) pushed: Vec<[Short<Sizes>; 2]>,
}

impl<'a> Ground<'a> {
    /// Of a point that starts from the middle of what is known of it, from all of that, and passes a range in a duration of `h`, in which
    /// what damps slopes is known; to a degree. The velocities are all `backwards`, or none is.
    pub(in super::super) fn of(
        fields: &'a Fields,
        states: [&Triple; 3],
        (u, backwards): (Interval, bool),
        (damping, h): (Interval, Interval),
        degree: usize,
    ) -> Self {
        let own = Equations::of(&fields.at, degree);
        let motions = own.motions(states, u, backwards);
        let dampings = own.dampings(&motions, backwards);
        let slopes = Slopes::at(motions, &dampings, damping, h);
        Self { own, slopes, over: &fields.over, at: &fields.at, backwards }
    }

    /// Whether there is a spring, and a lag.
    pub(super) fn terms(&self) -> [bool; 2] {
        [Term::Stiffness, Term::LagRate].map(|term| self.at.has(term))
    }

    /// What a term multiplies in the damping, with its sign turned: the coefficient of a degree, of velocities and their squares.
    pub(super) fn damped_by(&self, term: Term, k: usize, [velocity, square]: [Balls; 2]) -> Balls {
        match term {
            Term::Linear if k == 0 => Balls::ONE,
            Term::Quadratic => {
                let twice = velocity + velocity;
                let twice = if self.backwards { -twice } else { twice };
                if k == 0 { twice - Balls::splat(self.at.twice_middle()) } else { twice }
            }
            Term::Cubic => square + square + square,
            _ => Balls::ZERO,
        }
    }

    /// By half of how much the damping changes with the velocity; the same.
    pub(super) fn kink(&self, k: usize, velocity: Balls) -> Balls {
        let mut kink = Balls::ZERO;
        if self.at.has(Term::Quadratic) && k == 0 {
            let quadratic = self.at.term(Term::Quadratic);
            kink = Balls::splat(if self.backwards { -quadratic } else { quadratic });
        }
        if self.at.has(Term::Cubic) {
            kink = kink + Balls::splat(self.at.term(Term::Cubic) * Interval::point(3.0)) * velocity;
        }
        kink
    }

    /// Up to a degree.
    pub(super) fn damping<T: Number>(&self, order: usize, which: impl Fn((Balls, Sizes)) -> T) -> Damping<T> {
        let all = |of: &dyn Fn(usize, [Balls; 2]) -> Balls| {
            let mut all = T::NONE;
            for (k, own) in all.iter_mut().enumerate().take(order + 1) {
                *own = which(Motions::of_point(of(k, self.slopes.motions.velocities(k))));
            }
            all
        };
        let term = |term: Term| if self.at.has(term) { all(&|k, own| self.damped_by(term, k, own)) } else { T::NONE };
        Damping { kinks: all(&|k, [velocity, _]| self.kink(k, velocity)), terms: Damping::<T>::TERMS.map(term) }
    }

    /// What is carried, up to a degree. `None` where it may grow beyond all bounds.
    pub(in super::super) fn largest(&self, carried: &Carried<'_>, pairs: &Pairs, order: usize) -> Option<Largest> {
        let damping = self.damping(order, |(_, within)| within);
        let column = |(bundle, start): (&Bundle, &[Balls; 3])| {
            let pushed = |k: usize| self.slopes.motions.pushed_within(bundle, k);
            let path = self.grown(pushed, start, order)?;
            Some(Column::of(path, bundle, &damping, order))
        };
        let columns: Option<Vec<_>> = carried.bundles.iter().zip(carried.columns).map(column).collect();
        let columns = columns?;
        let of = |sides| pushed(&columns, carried.bundles, sides, self.terms(), order);
        let pushed = pairs.sides.iter().map(of).collect();
        Some(Largest { damping, columns, pushed })
    }

    /// How large coefficients of columns from a start are over the step at most, up to a degree, under what pushes velocity and force.
    /// `None` where they may grow beyond all bounds.
    pub(super) fn grown(
        &self,
        pushed: impl Fn(usize) -> [Sizes; 2],
        start: &[Balls; 3],
        order: usize,
    ) -> Option<[Short<Sizes>; 3]> {
        let from = self.own.sizes(self.slopes.damping, pushed(0), start, self.slopes.h)?;
        let mut path = [Sizes::NONE; 3];
        for (path, series) in path.iter_mut().zip(self.own.growth(&self.slopes.rest, pushed, from, order)) {
            path[..=order].copy_from_slice(&series[..=order]);
        }
        Some(path)
    }
}
