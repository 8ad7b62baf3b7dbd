//! What is left of the third order during a step. Sizes over a whole step, of what falls and rises in it, would make it larger the longer
//! the step: it is bounded part by part, from values at their ends.

use core::iter::once;

use super::super::field::{FORCE, POSITION, Term, Triple, VELOCITY};
use super::super::mix::Bundle;
use super::super::series::Motions;
use super::super::step::Arrival;
use super::column::products;
use super::ground::{Ground, Largest};
use super::{Carried, Pairs, most};
use crate::numeric::{Balls, Interval, Sizes};

#[cfg(test)]
mod tests;

/// Degree of the coefficients by which what is between the ends of a part is known.
pub(in super::super) const BENT: usize = 2;
/// Length of a part against the equation's fastest rate, at most.
const PART: f64 = 0.28;
const MOST_PARTS: usize = 16;
/// Attempts at a size of the rest.
const ATTEMPTS: usize = 4;
/// The rest is looked for within so much more than it seemed to be.
const LARGER: f64 = 1.5;

/// Of the third order, by what happens during a step.
#[derive(Clone, Debug)]
pub(in super::super) struct Rest {
    /// Until the end of each part.
    until: Vec<(f64, Triple)>,
    at_end: Triple,
}

impl Rest {
    /// At these instants of the step.
    pub(in super::super) fn after(&self, time: Interval) -> Triple {
        let part = self.until.iter().find(|(end_s, _)| time.upper() <= *end_s);
        part.or(self.until.last()).map_or([Interval::ENTIRE; 3], |(_, rest)| *rest)
    }

    /// At its end.
    pub(in super::super) const fn at_end(&self) -> Triple {
        self.at_end
    }
}

/// The ends of the parts of a step of the duration `h`, in which no rate is faster.
pub(in super::super) fn parts(h: Interval, fastest: f64) -> Vec<Interval> {
    let count = (libm::ceil(h.upper() * fastest / PART) as usize).clamp(1, MOST_PARTS);
    (1..=count).map(|part| h * Interval::point(part as f64) / Interval::point(count as f64)).collect()
}

/// Adds how large values are at most in each part, times a factor: as at its ends, and as they bend between, where coefficients of the
/// second degree are no larger than `bent`.
fn add_largest<const N: usize>(
    sums: &mut [[Sizes; N]],
    factor: Sizes,
    ends: impl Iterator<Item = [Balls; N]>,
    part_s: Interval,
    bent: [Sizes; N],
) {
    // The eighth of the square, times the second derivative: twice the coefficient.
    let bulge = Sizes::splat(Interval::point(0.25) * part_s * part_s);
    let mut sizes = ends.map(|end| end.map(Balls::sizes));
    let Some(mut before) = sizes.next() else { return };
    for (sum, now) in sums.iter_mut().zip(sizes) {
        for (k, sum) in sum.iter_mut().enumerate() {
            *sum = *sum + (before[k].max(now[k]) + bulge * bent[k]) * factor;
        }
        before = now;
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

/// What makes a rest grow in a part of a step, at most.
struct Part {
    /// What damps.
    damping: Interval,
    /// What that changes by to the first order; what is of the first order, and of the second.
    damps: Interval,
    first: Triple,
    second: Triple,
}

/// The same in all of a step.
struct Push {
    /// By half of how much the damping changes with the velocity; and by how much that changes.
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
    fn on(&self, part: &Part, rest: &Triple) -> [Interval; 2] {
        let first = part.first[VELOCITY];
        let [x, v, f] = core::array::from_fn(|k| part.second[k] + rest[k]);
        let faster = first + v;
        let drag = (part.damps + self.kink * v) * v
            + self.kink_apart * first * (faster + v)
            + self.cubic * faster * faster * faster;
        [drag + self.stiff * x + self.gain * f, self.lag * f]
    }
}

impl Ground<'_> {
    /// What is of the third order during a step, on account of what happens in it, given how large all is, and what is carried to the end
    /// of each part. `None` where it may grow beyond all bounds.
    pub(in super::super) fn rest(
        &self,
        carried: &Carried<'_>,
        pairs: &Pairs,
        largest: &Largest,
        ends: &[Arrival],
    ) -> Option<Rest> {
        let h = self.slopes.h / Interval::point(ends.len() as f64);
        let push = self.push();
        let grown = |damping: Interval, push: [Interval; 2], start: Triple| {
            let sizes = self.own.sizes(damping, push.map(Sizes::splat), &start.map(Balls::splat), h)?;
            Some(sizes.map(|size| most(size.interval())))
        };
        let (mut added, mut all) = ([Interval::ZERO; 3], carried.rest.map(most));
        let (mut until, mut most_so_far) = (Vec::with_capacity(ends.len()), [0.0f64; 3]);
        for part in self.driven(carried, pairs, largest, ends, h)? {
            let mut guess = all;
            let mut found = None;
            for _ in 0..ATTEMPTS {
                let next = grown(part.damping, push.on(&part, &guess), all)?;
                let room = next.map(|next| Interval::point((LARGER * next.upper()).max(f64::MIN_POSITIVE)));
                let pushed = push.on(&part, &room);
                let within = grown(part.damping, pushed, all)?;
                if within.iter().zip(&room).all(|(within, room)| within.upper() < room.upper()) {
                    found = Some((pushed, within));
                    break;
                }
                guess = room;
            }
            let (pushed, within) = found?;
            let within_added = grown(part.damping, pushed, added)?;
            for (most, within) in most_so_far.iter_mut().zip(&within_added) {
                *most = most.max(within.upper());
            }
            let end = h * Interval::point((until.len() + 1) as f64);
            until.push((end.lower(), most_so_far.map(Interval::symmetric)));
            added = self.arrived(part.damping, added, within_added, pushed, h);
            all = self.arrived(part.damping, all, within, pushed, h);
        }
        Some(Rest { until, at_end: added.map(|size| Interval::symmetric(size.upper())) })
    }

    /// What moves in each part of the duration `part_s`, from what is carried to their ends.
    fn driven(
        &self,
        carried: &Carried<'_>,
        pairs: &Pairs,
        largest: &Largest,
        ends: &[Arrival],
        part_s: Interval,
    ) -> Option<Vec<Part>> {
        let (start, _) = Motions::of_point(self.slopes.motions.velocities(0)[0]);
        let velocities = once(Some(start.interval_at(0))).chain(ends.iter().map(|end| Some(end.at?[VELOCITY])));
        let velocities: Vec<Interval> = velocities.collect::<Option<_>>()?;
        let (mut first, mut second) = (vec![[Sizes::ZERO; 3]; ends.len()], vec![[Sizes::ZERO; 3]; ends.len()]);
        let mut damps = vec![[Sizes::ZERO]; ends.len()];
        for (index, (bundle, start)) in carried.bundles.iter().zip(carried.columns).enumerate() {
            let (factor, column) = (bundle.deviations.sizes(), &largest.columns[index]);
            let ends: Vec<_> = once(*start).chain(ends.iter().map(|end| end.carry_bundle(start, index))).collect();
            let damped = velocities.iter().zip(&ends).map(|(velocity, end)| [self.damps(bundle, *velocity, end)]);
            let kinks = Sizes::dot(products(&largest.damping.kinks, &column.path[VELOCITY], BENT));
            add_largest(&mut damps, factor, damped, part_s, [column.damps[BENT] + kinks]);
            add_largest(&mut first, factor, ends.into_iter(), part_s, column.path.map(|series| series[BENT]));
        }
        let ends: Vec<_> = ends.iter().map(|end| end.carry_bends(carried.bends)).collect();
        let bends = carried.bends.iter().zip(&pairs.products).zip(&largest.pushed);
        for (index, ((start, product), [moved, filled])) in bends.enumerate() {
            let bent = self.grown(|k| [moved[k], filled[k]], start, BENT)?.map(|series| series[BENT]);
            let ends = once(*start).chain(ends.iter().map(|end| end[index]));
            add_largest(&mut second, product.sizes(), ends, part_s, bent);
        }
        let part = |index: usize| Part {
            damping: self.damping_between(velocities[index].hull(velocities[index + 1])),
            damps: damps[index][0].total(),
            first: first[index].map(Sizes::total),
            second: second[index].map(Sizes::total),
        };
        Some((0..damps.len()).map(part).collect())
    }

    /// What damps while a velocity goes from one end of a range to the other: where nothing else moves it, it does so without a turn.
    fn damping_between(&self, v: Interval) -> Interval {
        if self.terms() == [false; 2] { self.at.damping(v, v) } else { self.slopes.damping }
    }

    /// What the rest is driven by besides.
    fn push(&self) -> Push {
        let with = |term: Term, value: Interval| if self.at.has(term) { most(value) } else { Interval::ZERO };
        let own = |term: Term| with(term, self.over.term(term));
        let apart = |term: Term| with(term, self.over.term(term) - self.at.term(term));
        let (_, speed) = Motions::of_point(self.slopes.motions.velocities(0)[0]);
        let (speed, three) = (speed.interval(), Interval::point(3.0));
        Push {
            kink: own(Term::Quadratic) + three * own(Term::Cubic) * speed,
            kink_apart: apart(Term::Quadratic) + three * apart(Term::Cubic) * speed,
            cubic: own(Term::Cubic),
            stiff: apart(Term::Stiffness),
            gain: if self.at.has(Term::LagRate) { apart(Term::Gain) } else { Interval::ZERO },
            lag: apart(Term::LagRate),
        }
    }

    /// By how much the unknowns of a bundle change the damping, to the first order, where the point has this velocity: by its terms, and by
    /// their column.
    fn damps(&self, bundle: &Bundle, velocity: Interval, column: &[Balls; 3]) -> Balls {
        let velocity = Balls::splat(velocity);
        let kink = self.kink(0, velocity);
        let by = |term: Term| self.damped_by(term, 0, [velocity, velocity * velocity]);
        let terms = bundle.damping_terms().map(|(term, weight)| (weight, by(term)));
        Balls::dot(terms.chain([(kink + kink, column[VELOCITY])]))
    }

    /// What sizes have become after a duration of `h`, in which they are at most `within`, under a push.
    fn arrived(&self, damping: Interval, start: Triple, within: Triple, push: [Interval; 2], h: Interval) -> Triple {
        let own = |term: Term| if self.at.has(term) { most(self.at.term(term)) } else { Interval::ZERO };
        let gain = if self.at.has(Term::LagRate) { own(Term::Gain) } else { Interval::ZERO };
        let half = Interval::point(0.5);
        let Growth { kept, mean, longest } = Growth::by(Interval::point(damping.upper()) * h);
        let [x, v, _] = start;
        let pushed = push[0] + own(Term::Stiffness) * within[POSITION] + gain * within[FORCE];
        let way = mean * v + half * longest * h * pushed;
        [x + h * way, kept * v + h * mean * pushed, within[FORCE]].map(most)
    }
}
