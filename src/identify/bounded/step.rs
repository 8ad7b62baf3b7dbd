//! One validated step of the motion: Taylor's polynomial in time with its remainder over an enclosure of the whole step.
//!
//! What is carried besides the state are slopes, not derivatives: with c a point, the difference `v(theta) - v(c)` obeys the linear
//! equation `e' = -m e + sum (theta_j - c_j) p_j`, in which m is a slope of the drag between the two velocities, and `p_j` is what
//! the j-th term multiplies in the motion of c alone. So only m has a range: slopes are the point's, and off them by a [`Doubt`].

use super::bend::{BEND_ORDER, BENT, Carried, Curve, Ground, Rest, parts};
use super::field::{FORCE, Field, POSITION, Term, Triple, VELOCITY};
use super::mix::Bundle;
use super::series::{Equations, NO_PATH, Path, line, powers, value};
use crate::numeric::{Balls, Interval};

use closed::Closed;
use doubt::Doubt;
use enclosure::enclose;

mod closed;
mod doubt;
mod enclosure;
#[cfg(test)]
mod tests;

/// How a step is made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Manner {
    /// Its length against the equation's fastest rate, at most.
    pub(super) length: f64,
    /// Of its polynomials: their coefficient of this degree is the remainder. None for a closed form.
    pub(super) degree: Option<usize>,
}

impl Manner {
    /// Whether its polynomials are of this degree at least; a closed form is of any.
    pub(super) const fn reaches(self, least: usize) -> bool {
        match self.degree {
            Some(degree) => degree >= least,
            None => true,
        }
    }
}

/// What a step may be longer against the fastest rate on the way than was looked for.
pub(super) const ROOM: f64 = 1.1;
/// A step that is too long is made no shorter at once than this share.
const LEAST_SHARE: f64 = 0.1;
const HALF: Refused = Refused::TooLong(0.5);

/// Length against the fastest rate, at most, of a step that might bend, and is made without.
const UNBENT: f64 = 0.15;

/// Degree of a straight line's way.
const LINE: usize = 2;

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
    form: Form,
    /// What is known of the point's start about its middle; none where the state is over the box, followed by the rates' ranges.
    at_about: Option<Triple>,
    /// State at every instant of the step.
    pub(super) within: Triple,
    /// Whether forces, and positions, move anything.
    lagged: bool,
    stiff: bool,
    /// What bends leave of the third order, where slopes are the point's and bend.
    rest: Option<Rest>,
    /// What slopes are off, where they are the point's and do not bend.
    doubt: Option<Doubt>,
    /// The end, where that is known by itself.
    end: Option<Box<Arrival>>,
    /// What is known of position and velocity there besides.
    met: Option<[Interval; 2]>,
}

/// By what a step is known.
#[derive(Clone, Debug)]
enum Form {
    Series(Box<Series>),
    Closed(Box<Closed>),
}

/// Polynomials of a step, and their degree.
#[derive(Clone, Debug)]
struct Series {
    /// Of the point from the middle of what is known of its start; over the box where that is followed by the rates' ranges.
    state: Path,
    /// Of the state by each component of its start.
    by_start: Path,
    /// Of the state by what the unknowns of each bundle push, the start held.
    by_push: Vec<Path>,
    degree: usize,
    bends: Curve,
}

/// What a form says of one instant.
struct Values {
    state: [Balls; 3],
    /// Slopes by each component of the start.
    by_start: [Balls; 3],
    /// From rest by the unknowns of each bundle.
    by_push: Vec<[Balls; 3]>,
    /// How slopes that are straight at the start bend, by each bundle of pairs.
    bends: Vec<[Balls; 3]>,
}

/// A step's values at one instant.
#[derive(Clone, Debug)]
pub(super) struct Arrival {
    pub(super) over: Triple,
    pub(super) at: Option<Triple>,
    by_start: [[Balls; 3]; 3],
    lagged: bool,
    stiff: bool,
    by_push: Vec<[Balls; 3]>,
    bends: Vec<[Balls; 3]>,
    rest: Triple,
}

/// Why a step was not made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Refused {
    /// The velocity may change its sign, where quadratic drag has a kink.
    Kink,
    /// Too long for an enclosure; this share of it might do.
    TooLong(f64),
}

fn middle(state: &Triple) -> Triple {
    state.map(|value| Interval::point(value.midpoint()))
}

fn less(a: &Triple, b: &Triple) -> Triple {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Whether velocities may have either sign.
pub(super) fn straddles(v: Interval) -> bool {
    v.lower() < 0.0 && v.upper() > 0.0
}

/// Each component of a state by itself.
pub(super) fn units() -> [Balls; 3] {
    core::array::from_fn(|component| {
        Balls::points(core::array::from_fn(|place| if place == component { 1.0 } else { 0.0 }))
    })
}

impl Field {
    /// The fastest rate of the equation's own.
    pub(super) fn fastest(&self, v: Interval) -> f64 {
        let lag = if self.has(Term::LagRate) { self.term(Term::LagRate).magnitude() } else { 0.0 };
        let swing = if self.has(Term::Stiffness) { libm::sqrt(self.term(Term::Stiffness).magnitude()) } else { 0.0 };
        self.damping(v, v).magnitude().max(lag).max(swing)
    }

    /// Whether the velocity is backwards during a step in which it has one sign; without quadratic drag that makes no difference.
    fn backwards(&self, within: &Triple, h: Interval, longest: f64) -> Result<bool, Refused> {
        let v = within[VELOCITY];
        if self.has(Term::Quadratic) && straddles(v) {
            return Err(Refused::Kink);
        }
        let long = self.fastest(v) * h.upper() / longest;
        if long > 1.0 {
            return Err(Refused::TooLong((0.95 / long).max(LEAST_SHARE)));
        }
        Ok(self.has(Term::Quadratic) && v.upper() <= 0.0)
    }

    /// The motion alone where the velocity may change its sign, by the rates' ranges: its end, and what it passes.
    pub(super) fn pass_crude(&self, start: &Triple, u: Interval, h: Interval) -> Result<[Triple; 2], Refused> {
        let within = self.passed(start, u, h).ok_or(HALF)?;
        let [start, rate] = [*start, self.rate(&within, u)].map(|state| state.map(Balls::splat));
        Ok([value(&line(&start, &rate), &powers(h, LINE)[..=LINE], true).map(|end| end.interval_at(0)), within])
    }
}

impl Fields {
    /// Over a duration `h` with a constant command u, but for a little no longer against the fastest rate than its manner says: beyond,
    /// polynomial and remainder cancel.
    pub(super) fn smooth(
        &self,
        start: &Pair,
        u: Interval,
        h: Interval,
        manner: Manner,
        carried: &Carried<'_>,
    ) -> Result<Box<Step>, Refused> {
        let (field, point) = (&self.over, &self.at);
        let Manner { length, degree } = manner;
        let longest = ROOM * length;
        let within = field.passed(&start.over, u, h).ok_or(HALF)?;
        let backwards = field.backwards(&within, h, longest)?;
        let within_at = point.passed(&start.at, u, h).ok_or(HALF)?;
        if point.backwards(&within_at, h, longest)? != backwards {
            return Err(Refused::Kink);
        }
        let middle = middle(&start.at);
        let about = Some(less(&start.at, &middle));
        let damping = point.damping(within_at[VELOCITY], within_at[VELOCITY]);
        let ground = |degree: usize| {
            let states = [&middle, &start.at, &within_at];
            Ground::of(self, states, (u, backwards), (damping, h), degree)
        };
        let (form, bent) = if let Some(degree) = degree {
            let ground = ground(degree);
            let mut series =
                Series::of(degree, ground.slopes.motions.path(), carried.bundles, |start, bundle, path| {
                    ground.own.columns(&ground.slopes, bundle, start, path)
                })?;
            let bent = carried.pairs.and_then(|pairs| {
                let largest = ground.largest(carried, pairs, BEND_ORDER)?;
                series.bends = ground.curve(carried, pairs, &largest)?;
                Some((pairs, ground, largest))
            });
            (Form::Series(series), bent)
        } else {
            let closed = Closed::of(point, [&middle, &start.at], u, backwards, carried);
            if !closed.suffices(h, within_at[VELOCITY].magnitude()) {
                return Err(HALF);
            }
            let bent = carried.pairs.and_then(|pairs| {
                let ground = ground(BENT);
                let largest = ground.largest(carried, pairs, BENT)?;
                Some((pairs, ground, largest))
            });
            (Form::Closed(Box::new(closed)), bent)
        };
        let mut step = Step::of(field, form, about, within);
        if carried.pairs.is_some() {
            let fastest = field.fastest(within[VELOCITY]);
            let mut ends = step.at_all(&parts(h, fastest));
            step.rest = bent.and_then(|(pairs, ground, largest)| ground.rest(carried, pairs, &largest, &ends));
            if let Some(rest) = &step.rest {
                step.end = ends.pop().map(|end| Box::new(Arrival { rest: rest.at_end(), ..end }));
                return Ok(step);
            }
            if h.upper() * fastest > ROOM * UNBENT {
                return Err(HALF);
            }
            step.straighten();
        }
        let (starts, passed) = ([&start.over, &start.at], [&within, &within_at]);
        step.doubt = Some(Doubt::of(self, starts, passed, u, damping, h, carried.bundles).ok_or(HALF)?);
        Ok(step)
    }

    /// Whether a step can be made in closed form.
    pub(super) fn closed(&self) -> bool {
        Closed::exists(&self.at)
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
        bundles: &[Bundle],
    ) -> Result<Box<Step>, Refused> {
        let field = &self.over;
        let within = field.passed(start, u, h).ok_or(HALF)?;
        let half = Interval::point(0.5);
        // Of two motions under the same force the faster stays ahead: the ends' own rates bound all between them.
        let from = |end: f64| {
            let start = [within[POSITION], Interval::point(end), within[FORCE]];
            let rate = |component: usize, state: &Triple| match component {
                VELOCITY => field.rate_of(VELOCITY, &[within[POSITION], state[VELOCITY], within[FORCE]], u),
                _ => Interval::ZERO,
            };
            let passed = field.passed_damped(&start, u, h).or_else(|| enclose(&start, h, rate))?;
            Some(rate(VELOCITY, &passed))
        };
        let v = start[VELOCITY];
        let mut met = None;
        if let (Some(slow), Some(fast)) = (from(v.lower()), from(v.upper())) {
            let mean = |end: f64, slope: f64| h * (Interval::point(end) + half * h * Interval::point(slope));
            let line = |end: f64, slope: f64| Interval::point(end) + h * Interval::point(slope);
            let reached = line(v.lower(), slow.lower()).hull(line(v.upper(), fast.upper()));
            let way = mean(v.lower(), slow.lower()).hull(mean(v.upper(), fast.upper()));
            met = Some([start[POSITION] + way, reached]);
        }
        let [from, rate] = [*start, field.rate(&within, u)].map(|state| state.map(Balls::splat));
        let own = Equations::of(field, LINE);
        let damping = field.damping(within[VELOCITY], within_at[VELOCITY]);
        let series = Series::of(LINE, line(&from, &rate), bundles, |start, bundle, path| {
            let by = |term: Term| Balls::splat(field.push(term, within_at, u_at));
            let push = bundle.map_or([Balls::ZERO; 2], |bundle| bundle.pushed(by));
            *path = line(start, &own.rates_within(damping, push, start, h)?);
            Some(())
        })?;
        Ok(Box::new(Step { met, ..*Step::of(field, Form::Series(series), None, within) }))
    }
}

impl Series {
    /// With columns of slopes by each component of the start, and by what each bundle pushes from rest.
    fn of(
        degree: usize,
        state: Path,
        bundles: &[Bundle],
        columns: impl Fn(&[Balls; 3], Option<&Bundle>, &mut Path) -> Option<()>,
    ) -> Result<Box<Self>, Refused> {
        let by_push = vec![NO_PATH; bundles.len()];
        let mut series = Box::new(Self { state, by_start: NO_PATH, by_push, degree, bends: Curve::default() });
        columns(&units(), None, &mut series.by_start).ok_or(HALF)?;
        for (bundle, path) in bundles.iter().zip(&mut series.by_push).filter(|(bundle, _)| bundle.pushes()) {
            columns(&[Balls::ZERO; 3], Some(bundle), path).ok_or(HALF)?;
        }
        Ok(series)
    }

    /// After a time.
    fn at(&self, time: Interval, lagged: bool) -> Values {
        let powers = powers(time, self.degree);
        let value = |path: &Path| value(path, &powers[..=self.degree], lagged);
        Values {
            state: value(&self.state),
            by_start: value(&self.by_start),
            by_push: self.by_push.iter().map(value).collect(),
            bends: self.bends.at(time),
        }
    }
}

impl Step {
    fn of(field: &Field, form: Form, at_about: Option<Triple>, within: Triple) -> Box<Self> {
        Box::new(Self {
            form,
            at_about,
            within,
            lagged: field.has(Term::LagRate),
            stiff: field.has(Term::Stiffness),
            rest: None,
            doubt: None,
            end: None,
            met: None,
        })
    }

    /// By how much longer the step, of the duration `h`, may be for its remainder to leave so much of the point's velocity unsure.
    pub(super) fn longer(&self, h: Interval, most: f64) -> f64 {
        let Form::Series(series) = &self.form else { return f64::INFINITY };
        let last = series.state[VELOCITY][series.degree].interval_at(0).magnitude();
        let remainder = last * libm::pow(h.upper(), series.degree as f64);
        libm::pow(most / remainder.max(f64::MIN_POSITIVE), 1.0 / series.degree as f64)
    }

    /// Whether slopes are the point's, and bend.
    #[cfg(test)]
    pub(super) fn bends(&self) -> bool {
        self.rest.is_some()
    }

    /// Without what bends.
    fn straighten(&mut self) {
        match &mut self.form {
            Form::Series(series) => series.bends = Curve::default(),
            Form::Closed(closed) => closed.straighten(),
        }
    }

    /// After each of some times.
    fn values(&self, times: &[Interval]) -> Vec<Values> {
        match &self.form {
            Form::Series(series) => times.iter().map(|time| series.at(*time, self.lagged)).collect(),
            Form::Closed(closed) => closed.values(times),
        }
    }

    /// The values after these times of the step.
    pub(super) fn at_all(&self, times: &[Interval]) -> Vec<Arrival> {
        let values = self.values(times).into_iter();
        values.zip(times).map(|(values, time)| self.arrival(values, *time)).collect()
    }

    /// The values after some times of the step, and at its end, after all of its duration.
    pub(super) fn arrivals(&mut self, times: &[Interval], duration: Interval) -> Option<(Vec<Arrival>, Arrival)> {
        if let Some(end) = self.end.take() {
            return Some((self.at_all(times), *end));
        }
        let all: Vec<Interval> = times.iter().copied().chain([duration]).collect();
        let mut arrivals = self.at_all(&all);
        let mut end = arrivals.pop()?;
        for (state, met) in end.over.iter_mut().zip(self.met.iter().flatten()) {
            // Both enclose the same values, so that they meet.
            *state = state.intersection(*met).unwrap_or(*state);
        }
        Some((arrivals, end))
    }

    fn arrival(&self, values: Values, time: Interval) -> Arrival {
        let Values { state, by_start: mut units, mut by_push, bends } = values;
        // By the mean value theorem: the end from a middle, and what a start about it adds.
        let at = self.at_about.map(|about| {
            core::array::from_fn(|k| {
                let [x, v, f, _] = units[k].intervals();
                state[k].interval_at(0) + Interval::dot([x, v, f].into_iter().zip(about))
            })
        });
        if let Some(doubt) = &self.doubt {
            doubt.add(time, &mut units, &mut by_push);
        }
        Arrival {
            over: if at.is_some() { self.within } else { state.map(|values| values.interval_at(0)) },
            at,
            by_start: core::array::from_fn(|from| units.map(|values| values.spread(from))),
            lagged: self.lagged,
            stiff: self.stiff,
            by_push,
            bends,
            rest: self.rest.as_ref().map_or([Interval::ZERO; 3], |rest| rest.after(time)),
        }
    }
}

impl Arrival {
    /// Slopes at the end from those at the start.
    #[inline]
    pub(super) fn carry(&self, columns: &[Balls; 3]) -> [Balls; 3] {
        if self.lagged || self.stiff {
            return core::array::from_fn(|k| Balls::dot((0..3).map(|from| (self.by_start[from][k], columns[from]))));
        }
        let [position, velocity, force] = columns;
        let [way, left, _] = &self.by_start[VELOCITY];
        [*position + *way * *velocity, *left * *velocity, *force]
    }

    /// The same, by the bundle of this number, with what it pushed besides.
    pub(super) fn carry_bundle(&self, columns: &[Balls; 3], bundle: usize) -> [Balls; 3] {
        let carried = self.carry(columns);
        core::array::from_fn(|k| carried[k] + self.by_push[bundle][k])
    }

    /// How slopes bend at the end.
    pub(super) fn carry_bends(&self, bends: &[[Balls; 3]]) -> Vec<[Balls; 3]> {
        let mut carried: Vec<_> = bends.iter().map(|bend| self.carry(bend)).collect();
        for (carried, own) in carried.iter_mut().zip(&self.bends) {
            *carried = core::array::from_fn(|k| carried[k] + own[k]);
        }
        carried
    }

    /// What is of the third order at the end.
    pub(super) fn carry_rest(&self, rest: &Triple) -> Triple {
        let carried = self.carry(&rest.map(Balls::splat));
        core::array::from_fn(|k| carried[k].interval_at(0) + self.rest[k])
    }
}
