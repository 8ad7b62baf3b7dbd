//! One validated step of the motion: Taylor's polynomial in time with its remainder over an enclosure of the whole step.
//!
//! What is carried besides the state are slopes, not derivatives: with c a point, the difference `v(theta) - v(c)` obeys the linear
//! equation `e' = -m e + sum (theta_j - c_j) p_j`, in which m is a slope of the drag between the two velocities, and `p_j` is what
//! the j-th term multiplies in the motion of c alone. So only m has a range.

use super::field::{FORCE, Field, POSITION, TERMS, Term, Triple, VELOCITY};
use super::mix::{Mix, Weights};
use crate::numeric::{Interval, Real};

/// Degree whose coefficient over the whole step is the remainder.
const ORDER: usize = 10;
/// Attempts at an enclosure before the step is called too long.
const ATTEMPTS: usize = 6;

type Series = [Interval; ORDER + 1];

/// Polynomials in the time since the step's beginning, for the components of the state or of a column; the last coefficient is
/// over the whole step, so that the values are enclosed at every instant of it.
type Path = [Series; 3];

/// The equation over a box, and at a point of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fields {
    pub(super) over: Field,
    pub(super) at: Field,
}

/// The state over a box, and of the point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    pub(super) over: Triple,
    pub(super) at: Triple,
}

/// What a step does, at whatever instant of it.
#[derive(Clone, Debug)]
pub(super) struct Step {
    over: Path,
    /// Of the point, from the middle of what is known of its start; none where it is followed by itself.
    at: Option<Path>,
    /// What is known of the point's start, about that middle.
    at_about: Triple,
    /// State at every instant of the step.
    pub(super) within: Triple,
    /// Of the state by its start: a path for each component of the start that moves others.
    gain: [Option<Path>; 3],
    /// Of the state by what each mix of terms pushes, the start held; none for a mix without terms.
    by_mix: Vec<Option<Path>>,
    /// What is known of position and velocity at the end besides.
    end: Option<[Interval; 2]>,
}

/// A step's values at one instant.
#[derive(Clone, Debug)]
pub(super) struct Arrival {
    pub(super) over: Triple,
    pub(super) at: Option<Triple>,
    gain: [Triple; 3],
    by_mix: Vec<Option<Triple>>,
}

/// Why a step was not made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refused {
    /// The velocity may change its sign, where quadratic drag has a kink.
    Kink,
    /// Too long for an enclosure.
    TooLong,
}

const UNIT: [Triple; 3] = [
    [Interval::ONE, Interval::ZERO, Interval::ZERO],
    [Interval::ZERO, Interval::ONE, Interval::ZERO],
    [Interval::ZERO, Interval::ZERO, Interval::ONE],
];

fn plus(a: &Triple, b: &Triple) -> Triple {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn times(a: Interval, b: &Triple) -> Triple {
    [a * b[0], a * b[1], a * b[2]]
}

/// Values `y` with `start + span y'` inside themselves, so that no solution leaves them during the span.
fn enclose(start: &Triple, span: Interval, rate: impl Fn(&Triple) -> Triple) -> Option<Triple> {
    let mut guess = plus(start, &times(span, &rate(start)));
    for _ in 0..ATTEMPTS {
        let next = plus(start, &times(span, &rate(&guess)));
        if next.iter().zip(&guess).all(|(next, guess)| next.is_subset_of(*guess)) {
            return Some(next);
        }
        if !next.iter().all(|value| value.is_bounded()) {
            return None;
        }
        // Force moves velocity, velocity position: each needs more room than what moves it.
        for ((guess, next), room) in guess.iter_mut().zip(next).zip([0.4, 0.15, 0.05]) {
            let hull = guess.hull(next);
            *guess = hull.inflate(room * hull.width() + f64::MIN_POSITIVE);
        }
    }
    None
}

#[inline]
fn product(a: &Series, b: &Series, k: usize) -> Interval {
    Interval::dot(a[..=k].iter().copied().zip(b[..=k].iter().rev().copied()))
}

fn sum(series: &Series, powers: &Series) -> Interval {
    Interval::dot(series.iter().copied().zip(powers.iter().copied()))
}

fn powers(time: Interval) -> Series {
    let mut powers = [Interval::ONE; ORDER + 1];
    for k in 1..=ORDER {
        powers[k] = powers[k - 1] * time;
    }
    powers
}

fn value(path: &Path, powers: &Series) -> Triple {
    core::array::from_fn(|k| sum(&path[k], powers))
}

/// `1/(k + 1)`.
fn next(k: usize) -> Interval {
    Interval::point(1.0 / (k + 1) as f64).inflate(f64::EPSILON)
}

fn middle(state: &Triple) -> Triple {
    state.map(|value| Interval::point(value.midpoint()))
}

fn less(a: &Triple, b: &Triple) -> Triple {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// By the mean value theorem: the end from a middle, and what a start about it adds.
fn about(end: Triple, gain: &[Triple; 3], start: &Triple) -> Triple {
    core::array::from_fn(|k| end[k] + Interval::dot((0..3).map(|from| (gain[from][k], start[from]))))
}

fn straddles(v: Interval) -> bool {
    v.lower() < 0.0 && v.upper() > 0.0
}

/// Coefficients at the beginning, with the remainder of those over the whole step.
fn joined(head: &Path, rest: &Path) -> Path {
    core::array::from_fn(|k| {
        let mut series = head[k];
        series[ORDER] = rest[k][ORDER];
        series
    })
}

/// A straight line in the velocity, and the parabola of the way.
fn line(start: &Triple, rate: &Triple) -> Path {
    let mut path = [[Interval::ZERO; ORDER + 1]; 3];
    for k in 0..3 {
        path[k][0] = start[k];
        path[k][1] = rate[k];
    }
    path[POSITION][1] = start[VELOCITY];
    path[POSITION][2] = Interval::point(0.5) * rate[VELOCITY];
    path
}

impl Field {
    /// The fastest rate of the equation's own.
    pub(super) fn fastest(&self, v: Interval) -> f64 {
        let lag = if self.has(Term::LagRate) { self.term(Term::LagRate).magnitude() } else { 0.0 };
        let swing = if self.has(Term::Stiffness) { libm::sqrt(self.term(Term::Stiffness).magnitude()) } else { 0.0 };
        self.damping(v, v).magnitude().max(lag).max(swing)
    }

    /// Components of the start that move others than themselves.
    fn moving(&self) -> impl Iterator<Item = usize> {
        let moving = [(POSITION, self.has(Term::Stiffness)), (VELOCITY, true), (FORCE, self.has(Term::LagRate))];
        moving.into_iter().filter(|(_, moves)| *moves).map(|(component, _)| component)
    }

    /// The sign of the velocity and the state during a step, if it has one.
    fn sign(&self, within: &Triple, h: Interval, longest: f64) -> Result<Interval, Refused> {
        let v = within[VELOCITY];
        if self.has(Term::Quadratic) && straddles(v) {
            return Err(Refused::Kink);
        }
        if self.fastest(v) * h.upper() > longest {
            return Err(Refused::TooLong);
        }
        Ok(if v.upper() <= 0.0 { -Interval::ONE } else { Interval::ONE })
    }

    /// The motion alone, over a duration `h` with a constant command u: its end and what it passes.
    pub(super) fn pass(&self, start: &Triple, u: Interval, h: Interval, longest: f64) -> Result<[Triple; 2], Refused> {
        let within = enclose(start, Interval::ZERO.hull(h), |state| self.rate(state, u)).ok_or(Refused::TooLong)?;
        let sign = self.sign(&within, h, longest)?;
        let middle = middle(start);
        let [from, head, rest] = [&middle, start, &within].map(|state| Base::of(self, state, u, sign));
        let [between, between_rest] = [&head, &rest].map(|base| self.dampings(base, base, sign));
        let damping = self.damping(within[VELOCITY], within[VELOCITY]);
        let powers = powers(h);
        let mut gain = UNIT;
        for component in self.moving() {
            let unit = &UNIT[component];
            let rate = |value: &Triple| self.column_rate(damping, value, [Interval::ZERO; 2]);
            let enclosure = enclose(unit, Interval::ZERO.hull(h), rate).ok_or(Refused::TooLong)?;
            let head = head.column(self, &between, None, unit);
            let rest = rest.column(self, &between_rest, None, &enclosure);
            gain[component] = value(&joined(&head, &rest), &powers);
        }
        Ok([about(value(&joined(&from.state, &rest.state), &powers), &gain, &less(start, &middle)), within])
    }

    /// The same where the velocity may change its sign.
    pub(super) fn pass_crude(&self, start: &Triple, u: Interval, h: Interval) -> Result<[Triple; 2], Refused> {
        let within = enclose(start, Interval::ZERO.hull(h), |state| self.rate(state, u)).ok_or(Refused::TooLong)?;
        Ok([value(&line(start, &self.rate(&within, u)), &powers(h)), within])
    }
}

impl Fields {
    /// Over a duration `h` with a constant command u, no longer than `longest` against the fastest rate: beyond, polynomial and
    /// remainder cancel.
    pub(super) fn smooth(
        &self,
        start: &Pair,
        u: Interval,
        h: Interval,
        longest: f64,
        mixes: &[Mix],
    ) -> Result<Step, Refused> {
        let span = Interval::ZERO.hull(h);
        let (field, point) = (&self.over, &self.at);
        let within = enclose(&start.over, span, |state| field.rate(state, u)).ok_or(Refused::TooLong)?;
        let sign = field.sign(&within, h, longest)?;
        let within_at = enclose(&start.at, span, |state| point.rate(state, u)).ok_or(Refused::TooLong)?;
        if point.sign(&within_at, h, longest)? != sign {
            return Err(Refused::Kink);
        }
        let [head, rest] = [&start.over, &within].map(|state| Base::of(field, state, u, sign));
        let [head_at, rest_at] = [&start.at, &within_at].map(|state| Base::of(point, state, u, sign));
        let middle = middle(&start.at);
        let from = Base::of(point, &middle, u, sign);
        let mut step = Step {
            over: joined(&head.state, &rest.state),
            at: Some(joined(&from.state, &rest_at.state)),
            at_about: less(&start.at, &middle),
            within,
            gain: [None; 3],
            by_mix: Vec::new(),
            end: None,
        };
        let [between, between_rest] =
            [(&head, &head_at), (&rest, &rest_at)].map(|(over, at)| field.dampings(over, at, sign));
        let damping = field.damping(within[VELOCITY], within_at[VELOCITY]);
        let column = |start: &Triple, weights: Option<&Weights>| {
            let push = weights.map_or([Interval::ZERO; 2], |weights| field.pushed(weights, &within_at, u));
            let enclosure = enclose(start, span, |value| field.column_rate(damping, value, push));
            let enclosure = enclosure.ok_or(Refused::TooLong)?;
            let head = head_at.column(field, &between, weights, start);
            let rest = rest_at.column(field, &between_rest, weights, &enclosure);
            Ok(joined(&head, &rest))
        };
        step.carry(field, mixes, column)?;
        Ok(step)
    }

    /// Over a duration `h` while the command is anywhere in `u`, and velocities may change their sign: by the rates' ranges. The
    /// point's motion, under `u_at`, passes `within_at`.
    pub(super) fn crude(
        &self,
        start: &Triple,
        u: Interval,
        within_at: &Triple,
        u_at: Interval,
        h: Interval,
        mixes: &[Mix],
    ) -> Result<Step, Refused> {
        let span = Interval::ZERO.hull(h);
        let field = &self.over;
        let within = enclose(start, span, |state| field.rate(state, u)).ok_or(Refused::TooLong)?;
        let half = Interval::point(0.5);
        // Of two motions under the same force the faster stays ahead: the ends' own rates bound all between them.
        let from = |end: f64| {
            let start = [within[POSITION], Interval::point(end), within[FORCE]];
            let rate = |state: &Triple| {
                let acceleration = field.rate(&[within[POSITION], state[VELOCITY], within[FORCE]], u)[VELOCITY];
                [Interval::ZERO, acceleration, Interval::ZERO]
            };
            Some(rate(&enclose(&start, span, rate)?)[VELOCITY])
        };
        let v = start[VELOCITY];
        let mut end = None;
        if let (Some(slow), Some(fast)) = (from(v.lower()), from(v.upper())) {
            let mean = |end: f64, slope: f64| h * (Interval::point(end) + half * h * Interval::point(slope));
            let line = |end: f64, slope: f64| Interval::point(end) + h * Interval::point(slope);
            let reached = line(v.lower(), slow.lower()).hull(line(v.upper(), fast.upper()));
            let way = mean(v.lower(), slow.lower()).hull(mean(v.upper(), fast.upper()));
            end = Some([start[POSITION] + way, reached]);
        }
        let over = line(start, &field.rate(&within, u));
        let mut step =
            Step { over, at: None, at_about: [Interval::ZERO; 3], within, gain: [None; 3], by_mix: Vec::new(), end };
        let damping = field.damping(within[VELOCITY], within_at[VELOCITY]);
        let column = |start: &Triple, weights: Option<&Weights>| {
            let push = weights.map_or([Interval::ZERO; 2], |weights| field.pushed(weights, within_at, u_at));
            let rate = |value: &Triple| field.column_rate(damping, value, push);
            let enclosure = enclose(start, span, rate).ok_or(Refused::TooLong)?;
            Ok(line(start, &rate(&enclosure)))
        };
        step.carry(field, mixes, column)?;
        Ok(step)
    }
}

impl Step {
    /// Columns of slopes: by each component of the start that moves others, and by what each mix pushes.
    fn carry(
        &mut self,
        field: &Field,
        mixes: &[Mix],
        column: impl Fn(&Triple, Option<&Weights>) -> Result<Path, Refused>,
    ) -> Result<(), Refused> {
        for component in field.moving() {
            self.gain[component] = Some(column(&UNIT[component], None)?);
        }
        let still = [Interval::ZERO; 3];
        let pushed = mixes.iter().map(|mix| mix.pushes().map(|weights| column(&still, Some(weights))).transpose());
        self.by_mix = pushed.collect::<Result<_, _>>()?;
        Ok(())
    }

    /// The values at the step's end, `h` after its beginning.
    pub(super) fn at_end(&self, h: Interval) -> Arrival {
        let mut arrival = self.at(h);
        for (state, end) in arrival.over.iter_mut().zip(self.end.iter().flatten()) {
            // Both enclose the same values, so that they meet.
            *state = state.intersection(*end).unwrap_or(*state);
        }
        arrival
    }

    /// The values after `time` of the step.
    pub(super) fn at(&self, time: Interval) -> Arrival {
        let powers = powers(time);
        let mut gain = UNIT;
        for (gain, path) in gain.iter_mut().zip(&self.gain) {
            if let Some(path) = path {
                *gain = value(path, &powers);
            }
        }
        let by_mix = self.by_mix.iter().map(|path| path.as_ref().map(|path| value(path, &powers))).collect();
        let at = self.at.map(|path| about(value(&path, &powers), &gain, &self.at_about));
        Arrival { over: value(&self.over, &powers), at, gain, by_mix }
    }
}

impl Arrival {
    /// Slopes at the end from those at the start.
    pub(super) fn carry(&self, column: &Triple) -> Triple {
        core::array::from_fn(|k| Interval::dot((0..3).map(|from| (self.gain[from][k], column[from]))))
    }

    /// The same, by the mix of this number, with what it pushed besides.
    pub(super) fn carry_mix(&self, column: &Triple, mix: usize) -> Triple {
        let carried = self.carry(column);
        self.by_mix[mix].as_ref().map_or(carried, |pushed| plus(&carried, pushed))
    }
}

/// Taylor's coefficients of the motion and of what each term multiplies.
struct Base {
    state: Path,
    square: Series,
    pushes: [Series; TERMS],
}

const NONE: Series = [Interval::ZERO; ORDER + 1];

impl Base {
    /// From the state at an instant, or at all of them at once; the velocity has the sign `sign`.
    fn of(field: &Field, start: &Triple, u: Interval, sign: Interval) -> Self {
        let (mut x, mut v, mut f) = (NONE, NONE, NONE);
        (x[0], v[0], f[0]) = (start[POSITION], start[VELOCITY], start[FORCE]);
        // |v| - 2 middle, its product with v, and v squared and cubed.
        let (mut shifted, mut drag, mut square, mut cube) = (NONE, NONE, NONE, NONE);
        let (quadratic, cubic) = (field.has(Term::Quadratic), field.has(Term::Cubic));
        for k in 0..=ORDER {
            if quadratic {
                shifted[k] = sign * v[k] - if k == 0 { field.twice_middle() } else { Interval::ZERO };
                drag[k] = product(&shifted, &v, k);
            }
            if cubic {
                square[k] = product(&v, &v, k);
                cube[k] = product(&square, &v, k);
            }
            if k == ORDER {
                break;
            }
            let mut rate = field.term(Term::Gain) * f[k] - field.term(Term::Linear) * v[k];
            if k == 0 {
                rate += field.term(Term::Disturbance);
            }
            if quadratic {
                rate -= field.term(Term::Quadratic) * drag[k];
            }
            if cubic {
                rate -= field.term(Term::Cubic) * cube[k];
            }
            if field.has(Term::Stiffness) {
                rate -= field.term(Term::Stiffness) * x[k];
            }
            v[k + 1] = rate * next(k);
            x[k + 1] = v[k] * next(k);
            if field.has(Term::LagRate) {
                let ahead = if k == 0 { u - f[0] } else { -f[k] };
                f[k + 1] = field.term(Term::LagRate) * ahead * next(k);
            }
        }
        let one = core::array::from_fn(|k| if k == 0 { Interval::ONE } else { Interval::ZERO });
        let ahead = core::array::from_fn(|k| if k == 0 { u - f[0] } else { -f[k] });
        let pushes = [f, one, v.map(|c| -c), drag.map(|c| -c), cube.map(|c| -c), x.map(|c| -c), ahead];
        Self { state: [x, v, f], square, pushes }
    }

    /// What a mix of terms pushes: velocity, and force.
    fn mixed(&self, weights: &Weights) -> [Series; 2] {
        let mut mixed = [NONE; 2];
        for term in Term::ALL {
            let weight = weights[term as usize];
            if weight != 0.0 {
                let into = &mut mixed[usize::from(term == Term::LagRate)];
                for (into, push) in into.iter_mut().zip(&self.pushes[term as usize]) {
                    *into += Interval::point(weight) * *push;
                }
            }
        }
        mixed
    }

    /// Coefficients of a column of slopes, from its value at the same instant; this is the point's motion.
    fn column(&self, field: &Field, damping: &Series, weights: Option<&Weights>, start: &Triple) -> Path {
        let (mut x, mut v, mut f) = (NONE, NONE, NONE);
        [x[0], v[0], f[0]] = *start;
        let push = weights.map(|weights| self.mixed(weights));
        for k in 0..ORDER {
            let mut acceleration = product(damping, &v, k);
            let mut force = Interval::ZERO;
            if field.has(Term::Stiffness) {
                acceleration -= field.term(Term::Stiffness) * x[k];
            }
            if field.has(Term::LagRate) {
                acceleration += field.term(Term::Gain) * f[k];
                force -= field.term(Term::LagRate) * f[k];
            }
            if let Some([moved, filled]) = &push {
                acceleration += moved[k];
                force += filled[k];
            }
            v[k + 1] = acceleration * next(k);
            x[k + 1] = v[k] * next(k);
            f[k + 1] = force * next(k);
        }
        [x, v, f]
    }
}

impl Field {
    /// Coefficients of the slope of the acceleration between the velocities of two motions of the sign `sign`.
    fn dampings(&self, over: &Base, at: &Base, sign: Interval) -> Series {
        let (v, w) = (&over.state[VELOCITY], &at.state[VELOCITY]);
        core::array::from_fn(|k| {
            let mut slope = if k == 0 { -self.term(Term::Linear) } else { Interval::ZERO };
            if self.has(Term::Quadratic) {
                let inner = sign * (v[k] + w[k]) - if k == 0 { self.twice_middle() } else { Interval::ZERO };
                slope -= self.term(Term::Quadratic) * inner;
            }
            if self.has(Term::Cubic) {
                slope -= self.term(Term::Cubic) * (over.square[k] + product(v, w, k) + at.square[k]);
            }
            slope
        })
    }
}
