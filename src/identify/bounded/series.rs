//! Taylor's coefficients of the motion, and of its slopes, several side by side.

use super::field::{FORCE, Field, POSITION, TERMS, Term, Triple, VELOCITY};
use super::mix::Bundle;
use crate::numeric::{Balls, Interval, Sizes};

/// The highest degree of a step's polynomials.
pub(super) const ORDER: usize = 10;

pub(super) type Coefficients<T> = [T; ORDER + 1];
type Series = Coefficients<Balls>;

/// Polynomials in the time since the step's beginning, for the components of states or of columns of slopes; the coefficient of their
/// degree is over the whole step, so that the values are enclosed at every instant of it.
pub(super) type Path = [Series; 3];

const NONE: Series = [Balls::ZERO; ORDER + 1];
pub(super) const NO_PATH: Path = [NONE; 3];

/// A share of the step in which slopes must not grow beyond all bounds.
const LEAST_ROOM: f64 = 0.1;

/// Places of a point's motions side by side: from the middle of what is known of its start, from all of that, and from all that it
/// passes in the step.
const MIDDLE: usize = 0;
const AT: usize = 1;
const WITHIN_AT: usize = 2;

#[inline]
fn product(a: &Series, b: &Series, k: usize) -> Balls {
    Balls::dot(a[..=k].iter().copied().zip(b[..=k].iter().rev().copied()))
}

/// Powers of a time, up to a degree.
pub(super) fn powers(time: Interval, degree: usize) -> Series {
    let time = Balls::splat(time);
    let mut powers = [Balls::ONE; ORDER + 1];
    for k in 1..=degree {
        powers[k] = powers[k - 1] * time;
    }
    powers
}

/// The values after the time of these powers.
#[inline]
pub(super) fn value(path: &Path, powers: &[Balls], lagged: bool) -> [Balls; 3] {
    core::array::from_fn(|k| {
        if k == FORCE && !lagged { path[k][0] } else { Balls::dot(path[k].iter().copied().zip(powers.iter().copied())) }
    })
}

/// A straight line in the velocity, and the parabola of the way.
pub(super) fn line(start: &[Balls; 3], rate: &[Balls; 3]) -> Path {
    let mut path = NO_PATH;
    for k in [POSITION, VELOCITY, FORCE] {
        (path[k][0], path[k][1]) = (start[k], rate[k]);
    }
    path[POSITION][1] = start[VELOCITY];
    path[POSITION][2] = rate[VELOCITY].share(2);
    path
}

/// One equation in every place.
pub(super) struct Equations {
    terms: [Balls; TERMS],
    active: [bool; TERMS],
    twice_middle: Balls,
    /// Of their motions' polynomials.
    degree: usize,
}

/// Taylor's coefficients of motions side by side, and of what each term multiplies in them.
pub(super) struct Motions {
    state: Path,
    /// Velocity squared; its product with the speed above twice the middle one; its cube; what the force is behind the command.
    square: Series,
    drag: Series,
    cube: Series,
    ahead: Series,
    degree: usize,
}

impl Equations {
    pub(super) fn of(field: &Field, degree: usize) -> Self {
        Self {
            terms: field.terms.map(Balls::splat),
            active: field.active,
            twice_middle: Balls::splat(field.twice_middle()),
            degree,
        }
    }

    #[inline]
    fn term(&self, term: Term) -> Balls {
        self.terms[term as usize]
    }
    #[inline]
    pub(super) fn has(&self, term: Term) -> bool {
        self.active[term as usize]
    }

    /// Of a point from the middle of what is known of its start, from all of that, and from all that it passes; the velocities are all
    /// `backwards`, or none is.
    pub(super) fn motions(&self, [middle, start, passed]: [&Triple; 3], u: Interval, backwards: bool) -> Motions {
        let degree = self.degree;
        let mut motions = Motions { state: NO_PATH, square: NONE, drag: NONE, cube: NONE, ahead: NONE, degree };
        let Motions { state: [x, v, f], square, drag, cube, ahead, .. } = &mut motions;
        [x[0], v[0], f[0]] = core::array::from_fn(|k| Balls::new([middle[k], start[k], passed[k], passed[k]]));
        let u = Balls::splat(u);
        let mut shifted = NONE;
        let (quadratic, cubic, lagged) = (self.has(Term::Quadratic), self.has(Term::Cubic), self.has(Term::LagRate));
        for k in 0..=degree {
            if quadratic {
                let speed = if backwards { -v[k] } else { v[k] };
                shifted[k] = if k == 0 { speed - self.twice_middle } else { speed };
                drag[k] = product(&shifted, v, k);
            }
            if cubic {
                square[k] = product(v, v, k);
                cube[k] = product(square, v, k);
            }
            if lagged {
                ahead[k] = if k == 0 { u - f[0] } else { -f[k] };
            }
            if k == degree {
                break;
            }
            let mut rate = self.term(Term::Gain) * f[k] - self.term(Term::Linear) * v[k];
            if k == 0 {
                rate = rate + self.term(Term::Disturbance);
            }
            if quadratic {
                rate = rate - self.term(Term::Quadratic) * drag[k];
            }
            if cubic {
                rate = rate - self.term(Term::Cubic) * cube[k];
            }
            if self.has(Term::Stiffness) {
                rate = rate - self.term(Term::Stiffness) * x[k];
            }
            v[k + 1] = rate.share(k + 1);
            x[k + 1] = v[k].share(k + 1);
            if lagged {
                f[k + 1] = (self.term(Term::LagRate) * ahead[k]).share(k + 1);
            }
        }
        motions
    }

    /// Coefficients of the acceleration's slope by the velocity.
    pub(super) fn dampings(&self, motions: &Motions, backwards: bool) -> Series {
        let Motions { state: [_, v, _], square, .. } = motions;
        let mut dampings = NONE;
        for (k, slope) in dampings.iter_mut().enumerate().take(self.degree + 1) {
            if k == 0 {
                *slope = -self.term(Term::Linear);
            }
            if self.has(Term::Quadratic) {
                let sum = if backwards { -(v[k] + v[k]) } else { v[k] + v[k] };
                let inner = if k == 0 { sum - self.twice_middle } else { sum };
                *slope = *slope - self.term(Term::Quadratic) * inner;
            }
            if self.has(Term::Cubic) {
                *slope = *slope - self.term(Term::Cubic) * (square[k] + square[k] + square[k]);
            }
        }
        dampings
    }

    /// Rates of columns of slopes, given what damping makes of their velocities and what pushes velocity and force besides.
    #[inline]
    pub(super) fn rates(&self, damped: Balls, [x, v, f]: [Balls; 3], push: [Balls; 2]) -> [Balls; 3] {
        let (mut acceleration, mut force) = (damped + push[0], push[1]);
        if self.has(Term::Stiffness) {
            acceleration = acceleration - self.term(Term::Stiffness) * x;
        }
        if self.has(Term::LagRate) {
            acceleration = acceleration + self.term(Term::Gain) * f;
            force = force - self.term(Term::LagRate) * f;
        }
        [v, acceleration, force]
    }

    /// Columns of slopes from their start, and what a bundle's unknowns push. `None` for a step in which they may grow beyond all
    /// bounds.
    pub(super) fn columns(
        &self,
        step: &Slopes,
        bundle: Option<&Bundle>,
        start: &[Balls; 3],
        path: &mut Path,
    ) -> Option<()> {
        let components = if self.has(Term::LagRate) { 3 } else { 2 };
        for (series, start) in path.iter_mut().zip(start) {
            series[0] = *start;
        }
        for k in 0..self.degree {
            let own = [path[POSITION][k], path[VELOCITY][k], path[FORCE][k]];
            let push = bundle.map_or([Balls::ZERO; 2], |bundle| step.motions.pushed(bundle, k));
            let rates = self.rates(product(&step.head, &path[VELOCITY], k), own, push);
            for (series, rate) in path.iter_mut().zip(rates).take(components) {
                series[k + 1] = rate.share(k + 1);
            }
        }
        let pushed = |k: usize| bundle.map_or([Sizes::ZERO; 2], |bundle| step.motions.pushed_within(bundle, k));
        let from = self.sizes(step.damping, pushed(0), start, step.h)?;
        for (series, remainder) in path.iter_mut().zip(self.remainder(&step.rest, pushed, from)) {
            series[self.degree] = Balls::within(remainder);
        }
        Some(())
    }

    /// How large the last coefficients of columns are at most over the whole step, during which they have these sizes.
    fn remainder(
        &self,
        damping: &Coefficients<Sizes>,
        pushed: impl Fn(usize) -> [Sizes; 2],
        from: [Sizes; 3],
    ) -> [Sizes; 3] {
        self.growth(damping, pushed, from, self.degree).map(|series| series[self.degree])
    }

    /// How large coefficients of columns are at most over the whole step, up to an order.
    pub(super) fn growth(
        &self,
        damping: &Coefficients<Sizes>,
        pushed: impl Fn(usize) -> [Sizes; 2],
        from: [Sizes; 3],
        order: usize,
    ) -> [Coefficients<Sizes>; 3] {
        let mut series = from.map(|from| {
            let mut series = [Sizes::ZERO; ORDER + 1];
            series[0] = from;
            series
        });
        let [position, velocity, force] = &mut series;
        let [mut x, _, mut f] = from;
        let [stiffness, gain, lag] = [Term::Stiffness, Term::Gain, Term::LagRate].map(|term| {
            let moves = self.has(Term::LagRate) || term == Term::Stiffness && self.has(term);
            if moves { self.term(term).sizes() } else { Sizes::ZERO }
        });
        for k in 0..order {
            let damped = Sizes::dot(damping[..=k].iter().copied().zip(velocity[..=k].iter().rev().copied()));
            let [moved, filled] = pushed(k);
            let rate = damped + moved + stiffness * x + gain * f;
            x = velocity[k].share(k + 1);
            velocity[k + 1] = rate.share(k + 1);
            f = (filled + lag * f).share(k + 1);
            (position[k + 1], force[k + 1]) = (x, f);
        }
        series
    }

    /// How large columns are at most within a duration of `h`: by Gronwall's inequality, and what follows from it. What damps a velocity
    /// lets it not grow, nor does a lag a force.
    pub(super) fn sizes(
        &self,
        damping: Interval,
        push: [Sizes; 2],
        start: &[Balls; 3],
        h: Interval,
    ) -> Option<[Sizes; 3]> {
        let most = |value: Interval| Interval::point(value.magnitude());
        let own = |term: Term| if self.has(term) { self.term(term).interval_at(0) } else { Interval::ZERO };
        let (h_s, stiffness) = (most(h), most(own(Term::Stiffness)));
        let growing = |rate: Interval| Interval::point(rate.upper().max(0.0));
        let rooms =
            [growing(damping) + h_s * stiffness, growing(-own(Term::LagRate))].map(|rate| Interval::ONE - h_s * rate);
        if rooms.iter().any(|room| room.lower() < LEAST_ROOM) {
            return None;
        }
        let [more, more_force] = rooms.map(|room| Sizes::splat(Interval::ONE / room));
        let gain = if self.has(Term::LagRate) { self.term(Term::Gain).sizes() } else { Sizes::ZERO };
        let (long, [x, v, f], [moved, filled]) = (Sizes::splat(h_s), start.map(Balls::sizes), push);
        let f = (f + long * filled) * more_force;
        let v = (v + long * (Sizes::splat(stiffness) * x + gain * f + moved)) * more;
        Some([x + long * v, v, f])
    }

    /// Rates of columns within a duration of `h`, in which velocities may change their sign.
    pub(super) fn rates_within(
        &self,
        damping: Interval,
        push: [Balls; 2],
        start: &[Balls; 3],
        h: Interval,
    ) -> Option<[Balls; 3]> {
        let mut within = self.sizes(damping, push.map(Balls::sizes), start, h)?.map(Balls::within);
        let (damping, span) = (Balls::splat(damping), Balls::splat(Interval::ZERO.hull(h)));
        let rates = |within: [Balls; 3]| self.rates(damping * within[VELOCITY], within, push);
        for _ in 0..2 {
            let rates = rates(within);
            within = core::array::from_fn(|k| start[k] + span * rates[k]);
        }
        Some(rates(within))
    }
}

impl Motions {
    /// Of the motion from the middle of the point's start; the coefficient of their degree over the whole step.
    pub(super) fn path(&self) -> Path {
        let mut path = NO_PATH;
        for (into, own) in path.iter_mut().zip(&self.state) {
            for (k, into) in into.iter_mut().enumerate().take(self.degree + 1) {
                *into = own[k].spread(if k == self.degree { WITHIN_AT } else { MIDDLE });
            }
        }
        path
    }

    /// What a term multiplies.
    #[inline]
    fn push(&self, term: Term, k: usize) -> Balls {
        let [x, v, f] = &self.state;
        match term {
            Term::Gain => f[k],
            Term::Disturbance if k == 0 => Balls::ONE,
            Term::Disturbance => Balls::ZERO,
            Term::Linear => -v[k],
            Term::Quadratic => -self.drag[k],
            Term::Cubic => -self.cube[k],
            Term::Stiffness => -x[k],
            Term::LagRate => self.ahead[k],
        }
    }

    /// Velocity and its square.
    pub(super) fn velocities(&self, k: usize) -> [Balls; 2] {
        [self.state[VELOCITY][k], self.square[k]]
    }

    /// Of something that follows from these: in the point's motion, and over the whole step at most.
    pub(super) fn of_point(own: Balls) -> (Balls, Sizes) {
        (own.spread(AT), own.sizes().spread(WITHIN_AT))
    }

    /// What the unknowns of a bundle push in the point's motion: velocity, and force.
    #[inline]
    pub(super) fn pushed(&self, bundle: &Bundle, k: usize) -> [Balls; 2] {
        bundle.pushed(|term| self.push(term, k).spread(AT))
    }

    /// The same over the whole step, at most.
    #[inline]
    pub(super) fn pushed_within(&self, bundle: &Bundle, k: usize) -> [Sizes; 2] {
        bundle.pushed_at_most(|term| self.push(term, k).sizes().spread(WITHIN_AT))
    }
}

/// What columns of slopes need of a step of the duration `h`.
pub(super) struct Slopes {
    pub(super) motions: Motions,
    pub(super) head: Series,
    pub(super) rest: Coefficients<Sizes>,
    /// At every instant of it.
    pub(super) damping: Interval,
    pub(super) h: Interval,
}

impl Slopes {
    /// Of the point's motion.
    pub(super) fn at(motions: Motions, dampings: &Series, damping: Interval, h: Interval) -> Self {
        let (mut head, mut rest) = (NONE, [Sizes::ZERO; ORDER + 1]);
        for (k, coefficient) in dampings.iter().enumerate().take(motions.degree + 1) {
            head[k] = coefficient.spread(AT);
            rest[k] = coefficient.sizes().spread(WITHIN_AT);
        }
        Self { motions, head, rest, damping, h }
    }
}
