//! How far slopes over a box are off the point's own, within a step.
//!
//! With c a column of the point's and d what one over the box differs by, `d' = m d + (m - n) c` for the slope m of the drag between the
//! two velocities and n, that at the point's: so d is known by sizes alone, from how far velocities are apart.

use super::super::bend::most;
use super::super::field::{FORCE, POSITION, Term, Triple, VELOCITY};
use super::super::mix::Bundle;
use super::super::series::{Equations, Slopes};
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

/// How much less a fading leaves in a time of x over it, at most: of what comes in at once; evenly; and ever more.
fn left(x: Interval) -> [Interval; 3] {
    let (one, square) = (Interval::ONE, x * x);
    let term = |x: Interval, over: f64| x / Interval::point(over);
    [
        one - x + term(square, 2.0),
        one - term(x, 1.5) + term(square, 4.0),
        one - term(x, 2.0) + term(Interval::point(3.0) * square, 20.0),
    ]
    .map(|left| most(left.min(one)))
}

impl Doubt {
    /// Of a step in which states over the box and of the point begin at `start` and stay `within`; the point's slopes are `slopes`. `None`
    /// where it may grow beyond all bounds.
    pub(super) fn of(
        fields: &Fields,
        own: &Equations,
        start: [&Triple; 2],
        within: [&Triple; 2],
        slopes: &Slopes<'_>,
        bundles: &[Bundle],
    ) -> Option<Self> {
        const REST: [Balls; 3] = [Balls::ZERO; 3];
        let (over, h) = (&fields.over, slopes.h);
        let damping = over.damping(within[0][VELOCITY], within[1][VELOCITY]);
        let equations = Equations::of(over, 1);
        let off = off(fields, &equations, start, damping, slopes)?;
        let apart = fields.apart(within[1][VELOCITY], off);
        let ends = |push: [Sizes; 2], start: &[Balls; 3]| {
            let column = own.sizes(slopes.damping, push, start, h)?;
            let [_, v, f] = equations.sizes(damping, apart.push(column), &REST, h)?;
            Some([v, f])
        };
        let by_start = ends([Sizes::ZERO; 2], &units())?;
        let by_push: Option<Vec<_>> =
            bundles.iter().map(|bundle| ends(slopes.motions.pushed_within(bundle, 0), &REST)).collect();
        let alone = !over.has(Term::Stiffness) && !over.has(Term::LagRate);
        let slowest = -damping.upper().max(slopes.damping.upper());
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

/// How far velocities are off the point's during a step, at most.
fn off(
    fields: &Fields,
    equations: &Equations,
    [over, at]: [&Triple; 2],
    damping: Interval,
    slopes: &Slopes<'_>,
) -> Option<Interval> {
    let first: Triple = core::array::from_fn(|k| over[k] - at[k]);
    let push = slopes.motions.pushed_apart(&fields.over, &fields.at);
    let sizes = equations.sizes(damping, push, &first.map(Balls::splat), slopes.h)?.map(Sizes::interval);
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
