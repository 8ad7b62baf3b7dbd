//! One validated step: Taylor's polynomial with its remainder for the motion of a point, the same for its sensitivities, and the error
//! bound of these over the box (Lohner 1987; Nedialkov, Jackson and Corliss 1999). Where the velocity may change its sign, or the command
//! is uncertain, a step by the range of the rates.

use super::a_priori_enclosure::enclose;
use super::sensitivities::{Block, Equation, units};
use super::sensitivity_error::SensitivityError;
use super::taylor_series::{DEGREE, LINE, NO_PATH, PointSeries, TaylorPath, line, values};
use super::vector_field::{
    FORCE, FieldTerm, Fields, POSITION, StateBox, StatePair, VELOCITY, VectorField, changes_sign,
};
use crate::numeric::{Balls, Interval};

#[cfg(test)]
mod tests;

/// Length of a step against the fastest rate of the equation: the series then gains a digit with every second degree.
pub(super) const MOST_LENGTH: f64 = 0.4;
/// What may be said of a step without an enclosure.
const HALF: TooLong = TooLong::Share(0.5);

/// A step, evaluated at any instant of it.
#[derive(Clone, Debug)]
pub(super) struct FlowStep {
    /// The point's motion from the middle of its start; of a step by rates the motion over the box.
    state: TaylorPath,
    /// Sensitivities by each component of the state at the start.
    by_start: TaylorPath,
    /// Sensitivities by the variables of each block, from zero.
    by_forcing: Vec<TaylorPath>,
    degree: usize,
    /// The point's start about its middle; `None` for a step by rates.
    about_middle: Option<StateBox>,
    /// States at every instant of the step.
    pub(super) within: StateBox,
    error: Option<SensitivityError>,
    /// Position and velocity at the end of a step by rates, by comparison of the slowest and the fastest motion.
    compared: Option<[Interval; 2]>,
    lagged: bool,
    stiff: bool,
}

/// A step at one instant.
#[derive(Clone, Debug)]
pub(super) struct Arrival {
    pub(super) over: StateBox,
    pub(super) at: Option<StateBox>,
    by_start: [[Balls; 3]; 3],
    by_forcing: Vec<[Balls; 3]>,
    lagged: bool,
    stiff: bool,
}

/// Why a step was not made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TooLong {
    /// The velocity may change its sign, where quadratic drag has a kink.
    Kink,
    /// This share of it might do.
    Share(f64),
}

impl VectorField {
    /// Whether the velocity is negative throughout a step in which it has one sign; without quadratic drag the sign does not matter.
    fn backwards(&self, within: &StateBox, h: Interval) -> Result<bool, TooLong> {
        let v = within[VELOCITY];
        if self.has(FieldTerm::Quadratic) && changes_sign(v) {
            return Err(TooLong::Kink);
        }
        let length = self.fastest_rate(v) * h.upper() / MOST_LENGTH;
        if length > 1.0 {
            return Err(TooLong::Share(0.9 / length));
        }
        Ok(self.has(FieldTerm::Quadratic) && v.upper() <= 0.0)
    }

    /// The motion by the range of its rates: its end, and the states that it passes.
    pub(super) fn by_rates(&self, start: &StateBox, u: Interval, h: Interval) -> Option<[StateBox; 2]> {
        let within = self.passed(start, u, h)?;
        let [from, rate] = [*start, self.rate(&within, u)].map(|state| state.map(Balls::splat));
        Some([values(&line(&from, &rate), h, LINE, true).map(|end| end.interval_at(0)), within])
    }
}

impl Fields {
    /// A step of the length `h` under a constant command.
    pub(super) fn taylor(
        &self,
        start: &StatePair,
        u: Interval,
        h: Interval,
        blocks: &[Block],
    ) -> Result<Box<FlowStep>, TooLong> {
        let Self { over, at } = self;
        let within = over.passed(&start.over, u, h).ok_or(HALF)?;
        let backwards = over.backwards(&within, h)?;
        let within_at = at.passed(&start.at, u, h).ok_or(HALF)?;
        if at.backwards(&within_at, h)? != backwards {
            return Err(TooLong::Kink);
        }
        let middle = start.at.map(|value| Interval::point(value.midpoint()));
        let series = PointSeries::of(at, [&middle, &start.at, &within_at], u, backwards, h);
        let forced = |block: &Block| {
            if block.is_forced() { series.columns(Some(block), &[Balls::ZERO; 3]) } else { Some(NO_PATH) }
        };
        let by_forcing: Option<Vec<TaylorPath>> = blocks.iter().map(forced).collect();
        let (starts, passed) = ([&start.over, &start.at], [&within, &within_at]);
        Ok(Box::new(FlowStep {
            state: series.path(),
            by_start: series.columns(None, &units()).ok_or(HALF)?,
            by_forcing: by_forcing.ok_or(HALF)?,
            degree: DEGREE,
            about_middle: Some(core::array::from_fn(|k| start.at[k] - middle[k])),
            within,
            error: Some(SensitivityError::of(self, starts, passed, u, h, blocks).ok_or(HALF)?),
            compared: None,
            lagged: over.has(FieldTerm::LagRate),
            stiff: over.has(FieldTerm::Stiffness),
        }))
    }

    /// A step while the command is anywhere in `u` and velocities may change their sign. The point's motion, under `u_at`, passes
    /// `within_at`.
    pub(super) fn by_rates(
        &self,
        start: &StateBox,
        u: Interval,
        within_at: &StateBox,
        u_at: Interval,
        h: Interval,
        blocks: &[Block],
    ) -> Option<Box<FlowStep>> {
        let field = &self.over;
        let within = field.passed(start, u, h)?;
        let [from, rate] = [*start, field.rate(&within, u)].map(|state| state.map(Balls::splat));
        let equation = Equation::of(field);
        let damping = field.damping(within[VELOCITY], within_at[VELOCITY]);
        let columns = |block: Option<&Block>, start: &[Balls; 3]| {
            let by_term = |term: FieldTerm| Balls::splat(field.by_term(term, within_at, u_at));
            let forcing = block.map_or([Balls::ZERO; 2], |block| block.forcing(by_term));
            Some(line(start, &equation.rates_within(damping, forcing, start, h)?))
        };
        let forced = |block: &Block| {
            if block.is_forced() { columns(Some(block), &[Balls::ZERO; 3]) } else { Some(NO_PATH) }
        };
        let by_forcing: Option<Vec<TaylorPath>> = blocks.iter().map(forced).collect();
        Some(Box::new(FlowStep {
            state: line(&from, &rate),
            by_start: columns(None, &units())?,
            by_forcing: by_forcing?,
            degree: LINE,
            about_middle: None,
            compared: self.compared(start, &within, u, h),
            within,
            error: None,
            lagged: field.has(FieldTerm::LagRate),
            stiff: field.has(FieldTerm::Stiffness),
        }))
    }

    /// Position and velocity at the end by comparison: of two motions under the same force the faster stays ahead (Müller 1927), so that
    /// the slowest and the fastest start bound all between them.
    fn compared(&self, start: &StateBox, within: &StateBox, u: Interval, h: Interval) -> Option<[Interval; 2]> {
        let field = &self.over;
        let rate_from = |end: f64| {
            let start = [within[POSITION], Interval::point(end), within[FORCE]];
            let rate = |component: usize, state: &StateBox| match component {
                VELOCITY => field.rate_of(VELOCITY, &[within[POSITION], state[VELOCITY], within[FORCE]], u),
                _ => Interval::ZERO,
            };
            Some(rate(VELOCITY, &enclose(&start, h, rate)?))
        };
        let v = start[VELOCITY];
        let (slow, fast) = (rate_from(v.lower())?.lower(), rate_from(v.upper())?.upper());
        let (half, point) = (Interval::point(0.5), Interval::point);
        let reached = |end: f64, rate: f64| point(end) + h * point(rate);
        let way = |end: f64, rate: f64| h * (point(end) + half * h * point(rate));
        Some([
            start[POSITION] + way(v.lower(), slow).hull(way(v.upper(), fast)),
            reached(v.lower(), slow).hull(reached(v.upper(), fast)),
        ])
    }
}

impl FlowStep {
    /// By which factor the step could be longer for its remainder to leave `allowed` of the point's velocity uncertain.
    pub(super) fn could_be_longer(&self, h: Interval, allowed: f64) -> f64 {
        let last = self.state[VELOCITY][self.degree].interval_at(0).magnitude();
        let remainder = last * libm::pow(h.upper(), self.degree as f64);
        libm::pow(allowed / remainder.max(f64::MIN_POSITIVE), 1.0 / self.degree as f64)
    }

    /// The step after a time.
    pub(super) fn at(&self, time: Interval) -> Arrival {
        let values = |path: &TaylorPath| values(path, time, self.degree, self.lagged);
        let (state, mut by_start) = (values(&self.state), values(&self.by_start));
        let mut by_forcing: Vec<_> = self.by_forcing.iter().map(values).collect();
        // Mean value form: the end from the middle of the start, and the slope by the start times its radius.
        let at = self.about_middle.map(|about| {
            core::array::from_fn(|k| {
                let [x, v, f, _] = by_start[k].intervals();
                state[k].interval_at(0) + Interval::dot([x, v, f].into_iter().zip(about))
            })
        });
        if let Some(error) = &self.error {
            error.add(time, &mut by_start, &mut by_forcing);
        }
        Arrival {
            over: if at.is_some() { self.within } else { state.map(|value| value.interval_at(0)) },
            at,
            by_start: core::array::from_fn(|from| by_start.map(|column| column.spread(from))),
            by_forcing,
            lagged: self.lagged,
            stiff: self.stiff,
        }
    }

    /// The step at its end, after all of its length.
    pub(super) fn end(&self, h: Interval) -> Arrival {
        let mut end = self.at(h);
        for (state, compared) in end.over.iter_mut().zip(self.compared.iter().flatten()) {
            // Two enclosures of the same values intersect.
            *state = state.intersection(*compared).unwrap_or(*state);
        }
        end
    }
}

impl Arrival {
    /// Columns at this instant from those at the start, by the chain rule.
    #[inline]
    pub(super) fn carry(&self, columns: &[Balls; 3]) -> [Balls; 3] {
        if self.lagged || self.stiff {
            return core::array::from_fn(|k| Balls::dot((0..3).map(|from| (self.by_start[from][k], columns[from]))));
        }
        let [position, velocity, force] = columns;
        let [way, left, _] = &self.by_start[VELOCITY];
        [*position + *way * *velocity, *left * *velocity, *force]
    }

    /// The same of the block of this number, with the forcing of the step added.
    pub(super) fn carry_block(&self, columns: &[Balls; 3], block: usize) -> [Balls; 3] {
        let carried = self.carry(columns);
        core::array::from_fn(|k| carried[k] + self.by_forcing[block][k])
    }
}
