//! Which terms a record has: from inertia and drag alone, the term that makes it likeliest joins, until none is worth it;
//! then those that are no longer needed leave. Every model tried is kept for the average.
//!
//! Of a long record terms join by its first [`LONGEST_SEARCHED`] samples; the whole record fits the likeliest of these models.

mod gaps;

use std::sync::OnceLock;

use rayon::prelude::*;

use super::confounded_lags;
use super::filter;
use super::model::{NoiseParameter, Parameter, VehicleModel};
use super::observations::{Observations, PRICE};
use super::scoring::{Fitted, MOST_STEPS, climb, climb_beyond, climb_within};
use crate::experiment::Record;
use crate::identify::answer::{DragLaw, Term};
use crate::identify::fit::start::{self, ModulatedStart};
use crate::identify::signal::{Clock, SwitchingInstant, grid};
use crate::plant::State;

/// Twice the gain in log-likelihood from which on a term joins.
pub(super) const JOINS: f64 = 7.0;
/// The same for a term that takes the place of another.
const EXCHANGES: f64 = 0.5;
/// Terms that a record confuses: the first's place may be taken by the second.
const RIVALS: [(Term, Term); 13] = [
    (Term::Lag, Term::SensorFilter),
    (Term::SensorFilter, Term::Lag),
    (Term::RateLimit, Term::SensorFilter),
    (Term::SensorFilter, Term::RateLimit),
    (Term::Delay, Term::SensorFilter),
    (Term::RateLimit, Term::Lag),
    (Term::Lag, Term::RateLimit),
    (Term::Delay, Term::Lag),
    (Term::Delay, Term::RateLimit),
    (Term::Lag, Term::Delay),
    (Term::RateLimit, Term::Delay),
    (Term::ProcessForce, Term::ColouredNoise),
    (Term::ColouredNoise, Term::ProcessForce),
];
/// Log-likelihood below the best from which on a model hardly counts in an average.
const COUNTING: f64 = 4.0;
/// The most terms that a model gets.
const MOST_TERMS: usize = 8;

/// A model that does not promise to gain as much in log-likelihood is not followed to its end.
const WORTH_FOLLOWING: f64 = 0.1;
/// Samples of a longer record in which terms are looked for, and how many of the models found there are fitted to all of it.
pub(super) const LONGEST_SEARCHED: usize = 4000;
const CONTINUED: usize = 3;
/// Steps of integrations with derivatives, after which no further round of the search begins: about a second of processor time.
const MOST_INTEGRATED: usize = 2_000_000;
/// How often instants of switching in gaps are looked for at most.
const MOST_READINGS: usize = 3;
/// Steps while a white force carries a poor start along, and those that follow without it.
const FOLLOWING: usize = 12;
const APPROACHING: usize = 12;

/// Readings left out at the beginning, in delays and in half-periods beyond, and at most: the filter sees no command before the record.
const UNSEEN_DELAYS: f64 = 1.3;
const UNSEEN_SHORT: f64 = 0.05;
const UNSEEN_LONG: f64 = 0.25;
/// Velocity, in typical speeds, that the white force which carries a start along gives in a half-period.
const TRACKING_SPEED: f64 = 0.2;
/// Factor of the white variance once that force is gone.
const RELEASED_NOISE: f64 = 2.0;
/// Least white variance of a start, in squares of the output's range.
const FIRST_VARIANCE: f64 = 1e-4;

/// The delay and the drag law, where they are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct KnownBefore {
    pub(super) delay_s: Option<f64>,
    pub(super) law: Option<DragLaw>,
}

/// All readings of one record.
pub(super) struct StructureSearch<'a> {
    record: &'a Record,
    /// The first part of a long record.
    head: Option<Record>,
    known: KnownBefore,
    clocks: Vec<Clock>,
    readings: [OnceLock<Observations>; 4],
    unseen_s: f64,
    /// Steps of searches before this one, with other instants in gaps.
    integrated: usize,
    left_out: LeftOut,
}

/// What the search found.
pub(super) struct SearchOutcome {
    /// Each model once, in the order in which they were tried.
    pub(super) tried: Vec<Fitted>,
    /// Number of the best of them.
    pub(super) best: usize,
    /// What was left out for the work that it takes.
    pub(super) left_out: LeftOut,
}

/// Part of a search that its limit of work leaves out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum LeftOut {
    /// None.
    Nothing,
    /// Other models in place of a model to which no term is worth adding.
    Alternatives,
    /// Terms after others that joined.
    Terms,
}

impl<'a> StructureSearch<'a> {
    pub(super) fn new(record: &'a Record, known: KnownBefore) -> Self {
        let clocks = if grid(record).is_some() { vec![Clock::Stamps, Clock::Grid] } else { vec![Clock::Stamps] };
        let head = record.beginning(LONGEST_SEARCHED);
        let readings = [const { OnceLock::new() }; 4];
        Self { record, head, known, clocks, readings, unseen_s: 0.0, integrated: 0, left_out: LeftOut::Nothing }
    }

    pub(super) fn observations(&self, model: &VehicleModel) -> &Observations {
        self.readings[reading_index(model)].get_or_init(|| {
            let mut observations = Observations::new(self.record, model.clock, model.switching);
            observations.skip(self.unseen_s);
            observations
        })
    }

    /// Twice the log-likelihood less what its parameters cost.
    pub(super) fn value(&self, fitted: &Fitted) -> f64 {
        2.0 * fitted.log_likelihood - self.observations(&fitted.model).price(fitted.model.freedom())
    }

    fn climb(&self, model: VehicleModel) -> Option<Fitted> {
        climb(self.observations(&model), model)
    }

    /// Whether a further round of the search may begin; if not, it is noted as left out.
    fn goes_on(&mut self, tried: &[Fitted], round: LeftOut) -> bool {
        let goes_on = self.integrated + integrated(tried) < MOST_INTEGRATED;
        if !goes_on {
            self.left_out = self.left_out.max(round);
        }
        goes_on
    }

    /// The likeliest of several starts, climbed from.
    fn climb_from(&self, starts: Vec<VehicleModel>, worth: f64) -> Option<Fitted> {
        let value = |model: &VehicleModel| {
            filter::run(self.observations(model), model, filter::Evaluation::Likelihood).map(|pass| pass.log_likelihood)
        };
        let valued = starts.into_iter().filter_map(|model| Some((value(&model)?, model)));
        let (_, best) = valued.max_by(|a, b| a.0.total_cmp(&b.0))?;
        climb_beyond(self.observations(&best), best, MOST_STEPS, worth)
    }

    /// From each start a model that follows the record by a white force of free intensity, then one without it; the likeliest.
    fn approach(&mut self) -> Option<Fitted> {
        let mut first = Observations::new(self.record, Clock::Stamps, SwitchingInstant::AtSamples);
        let mut starts = start::starts(&first, self.known.delay_s);
        starts.push(start::rough(&first, self.known.delay_s));
        let likely = starts.iter().min_by(|a, b| a.misfit.total_cmp(&b.misfit)).map_or(0.0, |start| start.delay_s);
        let (short, long) = (UNSEEN_SHORT * first.half_period_s, UNSEEN_LONG * first.half_period_s);
        self.unseen_s =
            (UNSEEN_DELAYS * likely + short).min(long).max(self.known.delay_s.map_or(0.0, |known| known + short));
        first.skip(self.unseen_s);
        let speed = first.span / first.half_period_s;
        let follow = |start: &ModulatedStart| {
            let mut model = self.model(&first, start);
            model.set_noise(NoiseParameter::Tracking, (TRACKING_SPEED * speed).powi(2) / first.half_period_s, true);
            let mut model = climb_within(&first, model, FOLLOWING)?.model;
            model.set_noise(NoiseParameter::Tracking, 0.0, false);
            model.set_noise(NoiseParameter::White, RELEASED_NOISE * model.size(NoiseParameter::White), true);
            climb_within(&first, model, APPROACHING)
        };
        let ends: Vec<Fitted> = starts.par_iter().filter_map(follow).collect();
        let best = ends.into_iter().max_by(|a, b| a.log_likelihood.total_cmp(&b.log_likelihood))?;
        if best.settled { Some(best) } else { climb(&first, best.model) }
    }

    fn is_long(&self) -> bool {
        self.head.is_some()
    }

    /// The model without terms under every reading of clock and switchings.
    fn plain(&mut self) -> Option<Vec<Fitted>> {
        let mut tried = vec![self.approach()?];
        let mut others = Vec::new();
        for clock in &self.clocks {
            for switching in [SwitchingInstant::AtSamples, SwitchingInstant::Between] {
                if (*clock, switching) != (tried[0].model.clock, tried[0].model.switching) {
                    others.push(VehicleModel { clock: *clock, switching, ..tried[0].model.clone() });
                }
            }
        }
        tried.extend(others.into_par_iter().filter_map(|model| self.climb(model)).collect::<Vec<_>>());
        Some(tried)
    }

    /// The likeliest models of the beginning of a long record, fitted to all of it.
    fn continued(&mut self) -> Option<Vec<Fitted>> {
        let (search, mut found) = StructureSearch::new(self.head.as_ref()?, self.known).run()?;
        found.tried.sort_by(|a, b| search.value(b).total_cmp(&search.value(a)));
        self.unseen_s = search.unseen_s;
        self.left_out = found.left_out;
        let mut models: Vec<VehicleModel> = Vec::new();
        for Fitted { model, .. } in found.tried {
            let same = |other: &VehicleModel| {
                (other.free, other.noise_free, other.switching) == (model.free, model.noise_free, model.switching)
            };
            if !models.iter().any(same) {
                models.push(model);
            }
            if models.len() == CONTINUED {
                break;
            }
        }
        let tried: Vec<Fitted> = models.into_par_iter().filter_map(|model| self.climb(model)).collect();
        (!tried.is_empty()).then_some(tried)
    }

    fn model(&self, observations: &Observations, start: &ModulatedStart) -> VehicleModel {
        let mut model = VehicleModel::plain(SwitchingInstant::AtSamples);
        model.set(Parameter::Alpha, start.alpha, true);
        model.set(Parameter::LinearDrag, start.linear, true);
        model.set(Parameter::QuadraticDrag, start.quadratic, true);
        let mut model = model.with_drag(self.known.law.unwrap_or(DragLaw::Mixed), observations.fastest);
        model.set(Parameter::Disturbance, start.disturbance, true);
        model.set(Parameter::DelayS, start.delay_s, self.known.delay_s.is_none());
        let State { position, velocity } = observations.start_state();
        model.set(Parameter::Position, position, true);
        model.set(Parameter::Velocity, velocity, true);
        let step = self.record.quantum().unwrap_or(0.0);
        let span = observations.span;
        model.set_noise(NoiseParameter::White, (step * step / 12.0).max(FIRST_VARIANCE * span * span), true);
        model
    }

    /// The whole search.
    pub(super) fn run(mut self) -> Option<(Self, SearchOutcome)> {
        let begin = if self.is_long() { self.continued()? } else { self.plain()? };
        if self.is_long() {
            let begin = if self.read_gaps(&begin) { self.again(&begin)? } else { begin };
            let found = self.search(begin);
            return Some((self, found));
        }
        let mut found = self.search(begin.clone());
        for _ in 0..MOST_READINGS {
            if !self.goes_on(&found.tried, LeftOut::Alternatives) || !self.read_gaps(&found.tried) {
                break;
            }
            self.integrated += integrated(&found.tried);
            found = self.search(self.again(&begin)?);
        }
        Some((self, found))
    }

    /// From models that are fitted: terms join unless the record is long, and unneeded terms leave.
    fn search(&mut self, mut tried: Vec<Fitted>) -> SearchOutcome {
        let mut best = if self.is_long() { self.best(&tried) } else { self.joined(&mut tried) };
        // Leave out what is no longer needed, drag terms too.
        loop {
            let current = tried[best].clone();
            let ends: Vec<Fitted> =
                self.smaller(&current.model).into_par_iter().filter_map(|model| self.climb(model)).collect();
            tried.extend(ends);
            let next = self.best_among(&tried, |model| model.freedom() < current.model.freedom());
            let worth = next.filter(|index| self.value(&tried[*index]) > self.value(&current));
            match worth {
                Some(index) => best = index,
                None => break,
            }
        }
        let others = self.other_laws(&tried, &tried[best].model);
        tried.extend(others.into_par_iter().filter_map(|model| self.climb(model)).collect::<Vec<_>>());
        best = self.best(&tried);
        SearchOutcome { tried, best, left_out: self.left_out }
    }

    /// Terms join, confounded lags replace each other; returns the number of the best model.
    fn joined(&mut self, tried: &mut Vec<Fitted>) -> usize {
        let start = self.best(tried);
        // Noise and process force can hide a structure: where they come first, the structure alone is tried too.
        let mut best = self.grow(tried, start, |_| true, LeftOut::Terms);
        let first = tried[start].model.freedom();
        let structural = |fitted: &Fitted| {
            let has = |term: &Term| term.is_in(&fitted.model) && (*term != Term::Delay || self.known.delay_s.is_some());
            Term::ALL.into_iter().filter(has).all(Term::is_structural)
        };
        let noisy = Term::ALL.into_iter().any(|term| term.is_in(&tried[best].model) && !term.is_structural());
        let worth = tried[start].log_likelihood + 0.5 * JOINS;
        let alone = tried.iter().enumerate().filter(|(_, fitted)| structural(fitted) && fitted.log_likelihood > worth);
        let alone = alone.filter(|(_, fitted)| fitted.model.freedom() > first);
        let alone = alone.max_by(|a, b| a.1.log_likelihood.total_cmp(&b.1.log_likelihood)).map(|(index, _)| index);
        if let Some(alone) = alone.filter(|_| noisy) {
            let grown = self.grow(tried, alone, Term::is_structural, LeftOut::Alternatives);
            self.grow(tried, grown, |_| true, LeftOut::Alternatives);
            best = self.best(tried);
        }
        self.confounded_otherwise(tried, best)
    }

    /// Replaces the confounded lags by each other; returns the number of the best model.
    fn confounded_otherwise(&mut self, tried: &mut Vec<Fitted>, from: usize) -> usize {
        let current = tried[from].clone();
        let observations = self.observations(&current.model);
        let mut others = confounded_lags::chains(&current.model, self.known.delay_s, observations);
        if !others.is_empty() && self.goes_on(tried, LeftOut::Alternatives) {
            others.retain(|model| !tried.iter().any(|fitted| fitted.model.is_alike(model)));
            let worth = current.log_likelihood - COUNTING;
            let ends: Vec<Fitted> = others
                .into_par_iter()
                .filter_map(|model| climb_beyond(self.observations(&model), model, MOST_STEPS, worth))
                .collect();
            tried.extend(ends);
            if self.known.delay_s.is_none() && confounded_lags::is_in(&current.model) {
                tried.extend(self.restarted_lags(&current.model));
            }
        }
        let best = self.best(tried);
        if best == from { from } else { self.grow(tried, best, |_| true, LeftOut::Alternatives) }
    }

    /// Restarts each lag-like term from least squares over a grid of delays: inertia and total lag are nearly confounded, and a poor
    /// start traps the search.
    fn restarted_lags(&self, model: &VehicleModel) -> Vec<Fitted> {
        let observations = self.observations(model);
        let delays = start::at_every_delay(observations);
        let from = |term: &Term| {
            let starts = delays.iter().flat_map(|start| {
                let mut plain = self.model(observations, start);
                plain.set_noise(NoiseParameter::White, model.size(NoiseParameter::White), true);
                term.starts(&plain, observations)
            });
            self.climb_from(starts.collect(), f64::NEG_INFINITY)
        };
        confounded_lags::terms(observations).par_iter().filter_map(from).collect()
    }

    /// A model with each untried drag law, so that the laws can be compared.
    fn other_laws(&self, tried: &[Fitted], model: &VehicleModel) -> Vec<VehicleModel> {
        if self.known.law.is_some() {
            return Vec::new();
        }
        let speed = self.observations(model).fastest;
        let others = DragLaw::ALL.map(|law| model.with_drag(law, speed));
        others.into_iter().filter(|model| !tried.iter().any(|fitted| fitted.model.is_alike(model))).collect()
    }

    /// The best term joins, time and again, unless the limit of work leaves the `rounds` out; returns the number of the last model.
    fn grow(
        &mut self,
        tried: &mut Vec<Fitted>,
        from: usize,
        admitted: impl Fn(Term) -> bool,
        rounds: LeftOut,
    ) -> usize {
        let mut best = from;
        for _ in 0..MOST_TERMS {
            if !self.goes_on(tried, rounds) {
                break;
            }
            let current = tried[best].clone();
            let ends: Vec<(Fitted, f64)> = self
                .moves(&current.model, &admitted)
                .into_par_iter()
                .filter_map(|(starts, freedom)| {
                    Some((self.climb_from(starts, current.log_likelihood + WORTH_FOLLOWING)?, freedom))
                })
                .collect();
            let gain = |(end, freedom): &(Fitted, f64)| {
                let threshold = if *freedom > 0.0 { JOINS - PRICE } else { EXCHANGES };
                self.value(end) - self.value(&current) - threshold
            };
            let joined = ends.iter().enumerate().map(|(index, end)| (index, gain(end)));
            let joined = joined.max_by(|a, b| a.1.total_cmp(&b.1));
            let worth = joined.filter(|(_, gain)| *gain > 0.0).map(|(index, _)| tried.len() + index);
            tried.extend(ends.into_iter().map(|(end, _)| end));
            match worth {
                Some(index) => best = index,
                None => break,
            }
        }
        best
    }

    /// Starts of the models one step from a model, with the number of parameters that the step adds.
    fn moves(&self, model: &VehicleModel, admitted: &impl Fn(Term) -> bool) -> Vec<(Vec<VehicleModel>, f64)> {
        let mut moves: Vec<(Vec<VehicleModel>, f64)> = Vec::new();
        let observations = self.observations(model);
        let known = self.known.delay_s;
        let estimated = |term: Term| term == Term::Delay && known.is_none();
        for term in Term::ALL.into_iter().filter(|term| admitted(*term) && !estimated(*term)) {
            if term.applies(model, observations) {
                let starts = term.starts(model, observations);
                if term.starts_without_effect() {
                    moves.extend(starts.into_iter().map(|start| (vec![start], term.freedom() as f64)));
                    continue;
                }
                moves.push((starts, term.freedom() as f64));
                // Instants left to chance may hide a structure, and a structure may look like such instants.
                if observations.switched && term.is_structural() {
                    let mut starts = term.starts(model, observations);
                    starts.iter_mut().for_each(|start| start.switching = start.switching.other());
                    moves.push((starts, term.freedom() as f64));
                }
            }
        }
        moves.extend(self.swaps(model).into_iter().map(|model| (vec![model], 0.0)));
        for (out, term) in RIVALS {
            if out.is_in(model) && !estimated(out) && !estimated(term) && admitted(term) {
                let less = out.without(model, known);
                if term.applies(&less, observations) {
                    moves.push((term.starts(&less, observations), 0.0));
                }
            }
        }
        moves
    }

    fn swaps(&self, model: &VehicleModel) -> Vec<VehicleModel> {
        let mut swaps = Vec::new();
        swaps.push(VehicleModel { switching: model.switching.other(), ..model.clone() });
        if self.clocks.len() > 1 {
            let clock = if model.clock == Clock::Grid { Clock::Stamps } else { Clock::Grid };
            swaps.push(VehicleModel { clock, ..model.clone() });
        }
        swaps
    }

    /// Models with one term less.
    fn smaller(&self, model: &VehicleModel) -> Vec<VehicleModel> {
        let mut smaller: Vec<VehicleModel> = Term::ALL
            .into_iter()
            .filter(|term| term.is_in(model) && (*term != Term::Delay || self.known.delay_s.is_some()))
            .map(|term| term.without(model, self.known.delay_s))
            .collect();
        if self.known.law.is_none() {
            let drags = [Parameter::LinearDrag, Parameter::QuadraticDrag];
            let kept = drags.iter().filter(|drag| model.is_free(**drag)).count()
                + usize::from(model.is_free(Parameter::CubicDrag));
            for drag in drags.into_iter().filter(|drag| kept > 1 && model.is_free(*drag)) {
                let mut less = model.clone();
                less.set(drag, 0.0, false);
                smaller.push(less);
            }
        }
        smaller
    }

    fn best(&self, tried: &[Fitted]) -> usize {
        self.best_among(tried, |_| true).unwrap_or(0)
    }

    fn best_among(&self, tried: &[Fitted], admitted: impl Fn(&VehicleModel) -> bool) -> Option<usize> {
        let admitted = tried.iter().enumerate().filter(|(_, fitted)| admitted(&fitted.model));
        admitted.max_by(|a, b| self.value(a.1).total_cmp(&self.value(b.1))).map(|(index, _)| index)
    }
}

/// Steps of the integrations that led to these models.
fn integrated(tried: &[Fitted]) -> usize {
    tried.iter().map(|fitted| fitted.integrated).sum()
}

/// Number of the reading of clock and switchings that a model has.
fn reading_index(model: &VehicleModel) -> usize {
    2 * usize::from(model.clock == Clock::Grid) + usize::from(model.switching == SwitchingInstant::Between)
}
