//! What is left of the third order during a step. Sizes over a whole step, of what falls and rises in it, would make it larger the longer
//! the step: it is bounded part by part, from values at their ends.

use super::super::field::{FORCE, POSITION, Term, Triple, VELOCITY};
use super::super::mix::Bundle;
use super::super::series::powers;
use super::super::step::units;
use super::{BEND_ORDER, Carried, Column, Damping, Ground, Short, most};
use crate::numeric::{Balls, Interval, Sizes};

#[cfg(test)]
mod tests;

/// Parts of a step.
pub(super) const PARTS: usize = 2;
/// Attempts at a size of the rest.
const ATTEMPTS: usize = 4;
/// The rest is looked for within so much more than it seemed to be.
const LARGER: f64 = 1.5;

/// States at the beginning of a step, and at the end of each part.
type Ends = [[Balls; 3]; PARTS + 1];

/// Of the third order, by what happens during a step.
#[derive(Clone, Debug)]
pub(in super::super) struct Rest {
    /// Until the end of each part.
    until: [(f64, Triple); PARTS],
    at_end: Triple,
}

impl Rest {
    /// At these instants of the step.
    pub(in super::super) fn after(&self, time: Interval) -> Triple {
        let part = self.until.iter().find(|(end_s, _)| time.upper() <= *end_s);
        part.unwrap_or(&self.until[PARTS - 1]).1
    }

    /// At its end.
    pub(in super::super) const fn at_end(&self) -> Triple {
        self.at_end
    }
}

/// The parts of a step, and what becomes of states at its beginning.
pub(super) struct Course {
    /// Length of a part.
    part_s: Interval,
    /// At the end of each: powers of time, and what each component of a start has become.
    ends: [(Short, [Balls; 3]); PARTS],
    components: usize,
}

fn value(path: &Short, powers: &Short) -> Balls {
    Balls::dot(path.iter().copied().zip(powers.iter().copied()))
}

impl Course {
    /// `None` where states may grow beyond all bounds.
    pub(super) fn of(ground: &Ground<'_>) -> Option<Self> {
        let h = ground.slopes.h;
        let (path, _) = ground.polynomials(&units(), |_| [Balls::ZERO; 2], |_| [Sizes::ZERO; 2])?;
        let after = |parts: usize| h * Interval::point(parts as f64 / PARTS as f64);
        let ends = core::array::from_fn(|part| {
            let all = powers(after(part + 1), BEND_ORDER);
            let powers: Short = core::array::from_fn(|k| all[k]);
            (powers, path.each_ref().map(|series| value(series, &powers)))
        });
        let components = if ground.at.has(Term::LagRate) { 3 } else { 2 };
        Some(Self { part_s: after(1), ends, components })
    }

    /// What polynomials are at the ends.
    fn along(&self, path: &[Short; 3]) -> Ends {
        let mut ends = [[Balls::ZERO; 3]; PARTS + 1];
        for (k, series) in path.iter().enumerate().take(self.components) {
            ends[0][k] = series[0];
            for (end, (powers, _)) in ends[1..].iter_mut().zip(&self.ends) {
                end[k] = value(series, powers);
            }
        }
        ends
    }

    /// The same of states that start somewhere, to which polynomials are added that start at nothing.
    pub(super) fn carried(&self, start: &[Balls; 3], added: &[Short; 3]) -> Ends {
        let mut ends = self.along(added);
        ends[0] = *start;
        for (end, (_, carried)) in ends[1..].iter_mut().zip(&self.ends) {
            for (k, value) in end.iter_mut().enumerate().take(self.components) {
                *value = *value + Balls::dot((0..self.components).map(|from| (carried[k].spread(from), start[from])));
            }
        }
        ends
    }

    /// Adds how large states are at most in each part, times a factor: as at its ends, and as they bend between, where coefficients of
    /// the second degree are no larger than `bent`.
    pub(super) fn add_largest(&self, sums: &mut [[Sizes; 3]; PARTS], factor: Sizes, ends: &Ends, bent: [Sizes; 3]) {
        // The eighth of the square, times the second derivative: twice the coefficient.
        let bulge = Sizes::splat(Interval::point(0.25) * self.part_s * self.part_s);
        for k in 0..self.components {
            let between = bulge * bent[k];
            let mut before = ends[0][k].sizes();
            for (sum, end) in sums.iter_mut().zip(&ends[1..]) {
                let now = end[k].sizes();
                sum[k] = sum[k] + (before.max(now) + between) * factor;
                before = now;
            }
        }
    }
}

/// What a velocity with the damping m becomes of itself in a time h, at most: `exp(m h)`; the mean of that over the time; and the largest.
/// Upper bounds without the exponential.
struct Growth {
    kept: Interval,
    mean: Interval,
    longest: Interval,
}

impl Growth {
    /// By `m h`, which is less than one.
    fn by(grown: Interval) -> Self {
        let (one, half) = (Interval::ONE, Interval::point(0.5));
        if grown.upper() <= 0.0 {
            let square = grown * grown;
            let mean = one + half * grown + square / Interval::point(6.0);
            return Self { kept: one + grown + half * square, mean, longest: one };
        }
        let more = one / (one - grown);
        Self { kept: more, mean: more, longest: more }
    }
}

/// What makes a rest grow, at most, in each part of a step.
pub(super) struct Push {
    /// What is of the first order, and of the second.
    first: [[Interval; 3]; PARTS],
    second: [[Interval; 3]; PARTS],
    /// What the damping is off by at the point's velocity; by a velocity; and by how much that changes.
    damped: Interval,
    kink: Interval,
    kink_apart: Interval,
    cubic: Interval,
    /// How far terms are from the point's.
    stiff: Interval,
    gain: Interval,
    lag: Interval,
}

impl Push {
    /// On velocity and force, where the rest is no larger than this.
    fn on(&self, part: usize, rest: &[Interval; 3]) -> [Interval; 2] {
        let first = self.first[part][VELOCITY];
        let [x, v, f] = core::array::from_fn(|k| self.second[part][k] + rest[k]);
        let faster = first + v;
        let cubic = self.cubic * faster * faster;
        let damping = self.damped + self.kink * faster + cubic;
        let bent = (self.kink * v + self.kink_apart * first + cubic) * first;
        [damping * v + self.stiff * x + self.gain * f + bent, self.lag * f]
    }
}

impl Ground<'_> {
    /// What is of the third order during a step, on account of what happens in it, from what there is at its beginning.
    pub(super) fn rest(&self, start: Triple, push: &Push, course: &Course) -> Option<Rest> {
        let h = course.part_s;
        let grown = |push: [Interval; 2], start: [Interval; 3]| {
            let sizes = self.own.sizes(self.slopes.damping, push.map(Sizes::splat), &start.map(Balls::splat), h)?;
            Some(sizes.map(|size| most(size.interval())))
        };
        let (mut added, mut all) = ([Interval::ZERO; 3], start.map(most));
        let (mut until, mut largest) = ([(0.0, [Interval::ZERO; 3]); PARTS], [0.0f64; 3]);
        for (part, until) in until.iter_mut().enumerate() {
            let mut guess = all;
            let mut found = None;
            for _ in 0..ATTEMPTS {
                let next = grown(push.on(part, &guess), all)?;
                let room = next.map(|next| Interval::point((LARGER * next.upper()).max(f64::MIN_POSITIVE)));
                let pushed = push.on(part, &room);
                let within = grown(pushed, all)?;
                if within.iter().zip(&room).all(|(within, room)| within.upper() < room.upper()) {
                    found = Some((pushed, within));
                    break;
                }
                guess = room;
            }
            let (pushed, within) = found?;
            let within_added = grown(pushed, added)?;
            for (largest, within) in largest.iter_mut().zip(&within_added) {
                *largest = largest.max(within.upper());
            }
            *until = ((h * Interval::point((part + 1) as f64)).lower(), largest.map(Interval::symmetric));
            added = self.arrived(added, within_added, pushed, h);
            all = self.arrived(all, within, pushed, h);
        }
        Some(Rest { until, at_end: added.map(|size| Interval::symmetric(size.upper())) })
    }

    /// What it is driven by: all that moves in the step.
    pub(super) fn push(
        &self,
        carried: &Carried<'_>,
        columns: &[Column],
        damping: &Damping,
        course: &Course,
        second: [[Interval; 3]; PARTS],
    ) -> Push {
        let mut first = [[Sizes::ZERO; 3]; PARTS];
        for (column, bundle) in columns.iter().zip(carried.bundles) {
            let bent = column.within.map(|series| series[2]);
            course.add_largest(&mut first, bundle.deviations.sizes(), &course.along(&column.head), bent);
        }
        let with = |term: Term, value: Interval| if self.at.has(term) { most(value) } else { Interval::ZERO };
        let own = |term: Term| with(term, self.over.term(term));
        let apart = |term: Term| with(term, self.over.term(term) - self.at.term(term));
        let (_, speed) = self.motions.point(0)[0];
        let (speed, three) = (speed.interval(), Interval::point(3.0));
        // By what the damping differs at the point's velocity.
        let by_terms = |bundle: &Bundle| {
            let terms = bundle.damping_terms().map(|(term, weight)| (weight.sizes(), damping.by(term).1[0]));
            Sizes::dot(terms) * bundle.deviations.sizes()
        };
        let lagged = |value: Interval| if self.at.has(Term::LagRate) { value } else { Interval::ZERO };
        Push {
            first: first.map(|part| part.map(Sizes::total)),
            second,
            damped: carried.bundles.iter().fold(Interval::ZERO, |sum, bundle| sum + by_terms(bundle).total()),
            kink: own(Term::Quadratic) + three * own(Term::Cubic) * speed,
            kink_apart: apart(Term::Quadratic) + three * apart(Term::Cubic) * speed,
            cubic: own(Term::Cubic),
            stiff: apart(Term::Stiffness),
            gain: lagged(apart(Term::Gain)),
            lag: apart(Term::LagRate),
        }
    }

    /// What sizes have become after a duration of `h`, in which they are at most `within`, under a push.
    fn arrived(&self, start: Triple, within: Triple, push: [Interval; 2], h: Interval) -> Triple {
        let own = |term: Term| if self.at.has(term) { most(self.at.term(term)) } else { Interval::ZERO };
        let gain = if self.at.has(Term::LagRate) { own(Term::Gain) } else { Interval::ZERO };
        let half = Interval::point(0.5);
        let Growth { kept, mean, longest } = Growth::by(Interval::point(self.slopes.damping.upper()) * h);
        let [x, v, _] = start;
        let pushed = push[0] + own(Term::Stiffness) * within[POSITION] + gain * within[FORCE];
        let way = mean * v + half * longest * h * pushed;
        [x + h * way, kept * v + h * mean * pushed, within[FORCE]].map(most)
    }
}
