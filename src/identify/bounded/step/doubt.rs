//! How far slopes over a box are off the point's own, within a step.
//!
//! With c a column of the point's and d what one over the box differs by, `d' = m d + (m - n) c` for the slope m of the drag between the
//! two velocities and n, that at the point's: so d is known by sizes alone, from how far velocities are apart.

use super::super::bend::most;
use super::super::field::{FORCE, POSITION, Term, Triple, VELOCITY};
use super::super::mix::Bundle;
use super::super::series::Equations;
use super::{Fields, units};
use crate::numeric::{Balls, Interval, Real, Sizes};

#[cfg(test)]
mod tests;

/// What slopes of a step may be off.
#[derive(Clone, Debug)]
pub(super) struct Doubt {
    h: Interval,
    /// Velocities fade at least as fast; zero where something else moves them, too.
    fading: Interval,
    /// Velocity and force at the end, if both went there straight: by each component of a start of one; and by what each bundle
    /// pushes from rest, where it is their rates that go straight.
    by_start: [Sizes; 2],
    by_push: Vec<[Sizes; 2]>,
}

/// How far the accelerations of box and point are apart.
struct Apart {
    /// The damping.
    damping: Interval,
    stiffness: Interval,
    gain: Interval,
    lag: Interval,
}

impl Apart {
    /// What pushes the difference of two columns, where the point's is no larger than `column`.
    fn push(&self, [x, v, f]: [Sizes; 3]) -> [Sizes; 2] {
        let [damping, stiffness, gain, lag] = [self.damping, self.stiffness, self.gain, self.lag].map(Sizes::splat);
        [damping * v + stiffness * x + gain * f, lag * f]
    }
}

/// Parts of a time by which what a fading leaves is bounded.
const PARTS: i32 = 4;

/// How much less a fading leaves in a time of x over it, at most: of what comes in at once; evenly; and ever more.
fn left(x: Interval) -> [Interval; 3] {
    // No less than the exponential of a part: its series in the denominator, cut.
    let part = x / Interval::point(f64::from(PARTS));
    let term = |product: Interval, over: f64| product / Interval::point(over);
    let once =
        (Interval::ONE / (Interval::ONE + part + term(part * part, 2.0) + term(part * part * part, 6.0))).upper();
    // Convex: no more than straight between the ends of the parts, of which these are the shares in what is left on the mean.
    let by = |shares: [f64; 5]| {
        let powers = core::iter::successors(Some(Interval::ONE), |power| Some(*power * Interval::point(once)));
        let all = Interval::point(shares.iter().sum());
        most((Interval::dot(powers.zip(shares.map(Interval::point))) / all).min(Interval::ONE))
    };
    [by([0.0, 0.0, 0.0, 0.0, 1.0]), by([1.0, 6.0, 12.0, 18.0, 11.0]), by([7.0, 34.0, 46.0, 34.0, 7.0])]
}

impl Doubt {
    /// Of a step of the duration `h` in which states over the box and of the point begin at `start` and stay `within`; what damps the
    /// point's slopes is `damping`. `None` where it may grow beyond all bounds.
    pub(super) fn of(
        fields: &Fields,
        start: [&Triple; 2],
        within: [&Triple; 2],
        u: Interval,
        damping: Interval,
        h: Interval,
        bundles: &[Bundle],
    ) -> Option<Self> {
        const REST: [Balls; 3] = [Balls::ZERO; 3];
        let Fields { over, at } = fields;
        let apart = over.damping(within[0][VELOCITY], within[1][VELOCITY]);
        let (equations, own) = (Equations::of(over, 1), Equations::of(at, 1));
        let push = |term: Term| Sizes::splat(at.push(term, within[1], u));
        let off = off(fields, &equations, start, apart, push, h)?;
        let differ = fields.apart(within[1][VELOCITY], off);
        let ends = |push: [Sizes; 2], start: &[Balls; 3]| {
            let column = own.sizes(damping, push, start, h)?;
            let [_, v, f] = equations.sizes(apart, differ.push(column), &REST, h)?;
            Some([v, f])
        };
        let by_start = ends([Sizes::ZERO; 2], &units())?;
        let by_push: Option<Vec<_>> = bundles.iter().map(|bundle| ends(bundle.pushed_at_most(push), &REST)).collect();
        let alone = !over.has(Term::Stiffness) && !over.has(Term::LagRate);
        let slowest = -apart.upper().max(damping.upper());
        let fading = if alone { Interval::point(slowest.max(0.0)) } else { Interval::ZERO };
        Some(Self { h, fading, by_start, by_push: by_push? })
    }

    /// What columns by each component of a start, `of_start`, and from rest, `of_push`, may be off after a time, added.
    pub(super) fn add(&self, time: Interval, of_start: &mut [Balls; 3], of_push: &mut [[Balls; 3]]) {
        let (share, half) = (time / self.h, Interval::point(0.5));
        let [at_once, evenly, ever_more] = left(self.fading * time);
        let square = half * share * share;
        let from_start = [half * share * time * evenly, share * at_once, share].map(Sizes::splat);
        let from_rest = [square * time / Interval::point(3.0) * ever_more, square * evenly, square].map(Sizes::splat);
        let add = |to: &mut [Balls; 3], [v, f]: [Sizes; 2], shares: [Sizes; 3]| {
            for ((to, end), share) in to.iter_mut().zip([v, v, f]).zip(shares) {
                *to = *to + Balls::within(end * share);
            }
        };
        add(of_start, self.by_start, from_start);
        for (of_push, ends) in of_push.iter_mut().zip(&self.by_push) {
            add(of_push, *ends, from_rest);
        }
    }
}

/// How far velocities are off the point's during a step, at most, given what each term multiplies there.
fn off(
    fields: &Fields,
    equations: &Equations,
    [over, at]: [&Triple; 2],
    damping: Interval,
    push: impl Fn(Term) -> Sizes,
    h: Interval,
) -> Option<Interval> {
    let first: Triple = core::array::from_fn(|k| over[k] - at[k]);
    let push = fields.pushed_apart(push);
    let sizes = equations.sizes(damping, push, &first.map(Balls::splat), h)?.map(Sizes::interval);
    let fading = -damping.upper();
    if fading <= 0.0 {
        return Some(sizes[VELOCITY]);
    }
    let [stiffness, gain] = [Term::Stiffness, Term::Gain].map(|term| most(fields.over.term(term)));
    let gain = if fields.over.has(Term::LagRate) { gain } else { Interval::ZERO };
    let moved = push[0].interval() + stiffness * sizes[POSITION] + gain * sizes[FORCE];
    // What fades goes no further than where it is driven as fast as it fades.
    let still = most(first[VELOCITY]).max(moved / Interval::point(fading));
    Some(still.min(sizes[VELOCITY]))
}

impl Fields {
    /// What the box pushes that is not at the point, at most: velocity, and force.
    fn pushed_apart(&self, push: impl Fn(Term) -> Sizes) -> [Sizes; 2] {
        [false, true].map(|force| {
            let terms = Term::ALL.into_iter().filter(|term| self.over.has(*term) && (*term == Term::LagRate) == force);
            Sizes::dot(terms.map(|term| (Sizes::splat(self.over.term(term) - self.at.term(term)), push(term))))
        })
    }

    /// By velocities of the point and what others are `off` these.
    fn apart(&self, v: Interval, off: Interval) -> Apart {
        let Self { over, at } = self;
        let apart = |term: Term| over.term(term) - at.term(term);
        let (three, off) = (Interval::point(3.0), Interval::symmetric(off.upper()));
        let quadratic = apart(Term::Quadratic) * (v.abs() + v.abs() - over.twice_middle());
        let cubic = apart(Term::Cubic) * three * v.square();
        let faster = over.term(Term::Quadratic) * off + over.term(Term::Cubic) * (three * v * off + off.square());
        Apart {
            damping: apart(Term::Linear) + quadratic + cubic + faster,
            stiffness: apart(Term::Stiffness),
            gain: if over.has(Term::LagRate) { apart(Term::Gain) } else { Interval::ZERO },
            lag: apart(Term::LagRate),
        }
    }
}
