//! The readings over a box as linear inequalities, by multiple shooting: of every shooting interval the mean value form of the output at
//! each sample, and the link of its end to the beginning of the next.

use serde::{Deserialize, Serialize};

use super::flow::{DelayedCommand, SampleEnclosure, follow};
use super::linear_program::{Inequalities, Multipliers, Outcome, Programme};
use super::problem::Problem;
use super::record::{Command, Readings};
use super::vector_field::{FieldTerm, Fields, StatePair};
use super::work::Work;
use crate::numeric::Interval;

/// Share of a reading's error that the remainders of the steps of a half-period may take.
const REMAINDER: f64 = 1e-5;
/// A motion that is faster than this times the largest speed searched is given up: its box holds faster motions as well.
const FASTER: f64 = 2.0;

/// Samples at which a modulating function begins, has its peak, and ends.
pub(super) type Support = [usize; 3];

/// The origin of an inequality.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Origin {
    /// The reading of a sample: the output is not above, or not below, its range.
    Reading { interval: usize, sample: usize, above: bool },
    /// A component of the state at the end of a shooting interval: not above, or not below, the beginning of the next.
    Link { interval: usize, component: usize, above: bool },
    /// The disturbance is not above, or not below, the largest command.
    Disturbance { record: usize, above: bool },
    /// Linear drag is not below its least coefficient.
    LeastLinear,
    /// The weak form of the equation with a modulating function: not more, or not less, than the readings allow.
    Modulated { record: usize, samples: Support, above: bool },
}

/// Inequalities about a centre, with their origins.
#[derive(Clone, Debug, Default)]
pub(super) struct Relaxation {
    work: Work,
    pub(super) inequalities: Inequalities,
    pub(super) origins: Vec<Origin>,
    pub(super) centre: Vec<f64>,
    pub(super) deviations: Vec<Interval>,
}

/// Successive shooting intervals of a record, from the first to before the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) from: usize,
    pub(super) to: usize,
}

impl Span {
    pub(super) fn single(interval: usize) -> Self {
        Self { from: interval, to: interval + 1 }
    }
}

/// Two enclosures of the same values have an empty intersection: the box holds no motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Disjoint;

pub(super) fn midpoints(at: &[Interval]) -> Vec<f64> {
    at.iter().map(|side| side.midpoint()).collect()
}

pub(super) fn points(values: &[f64]) -> Vec<Interval> {
    values.iter().map(|value| Interval::point(*value)).collect()
}

impl Problem {
    /// Samples of a span.
    fn samples(&self, span: Span) -> core::ops::RangeInclusive<usize> {
        self.unknowns.shooting[span.from].first..=self.unknowns.shooting[span.to - 1].last
    }

    fn times(&self, span: Span) -> &[f64] {
        &self.records[self.unknowns.shooting[span.from].record].time_s[self.samples(span)]
    }

    /// Whole records, a span each: single shooting.
    pub(super) fn single_shooting(&self) -> impl Iterator<Item = Span> + '_ {
        (0..self.unknowns.records()).map(|record| {
            let from = self.unknowns.first(record);
            Span { from, to: from + self.unknowns.intervals(record) }
        })
    }

    /// The motion over a span at its samples over a box, with sensitivities about `centre`. `None` where it cannot be enclosed.
    pub(super) fn motion(&self, span: Span, at: &[Interval], centre: &[f64]) -> Option<Vec<SampleEnclosure>> {
        self.follow(span, at, centre, true, self.times(span))
    }

    /// Upper bound of the largest misfit of a point over whole records, in largest errors. `None` where its motion cannot be enclosed.
    pub(super) fn misfit(&self, point: &[f64]) -> Option<f64> {
        self.single_shooting()
            .try_fold(0.0, |largest, span| Some(self.misfits(span, point)?.into_iter().fold(largest, f64::max)))
    }

    /// Upper bounds of the misfits of a point at the samples of a span.
    ///
    /// A reading y was taken within the jitter J of its stamp t. The output is continuous: it is within E of y at some
    /// instant between two of `[t - J, t + J]`, not above y + E at either end and not below y - E at the opposite end.
    pub(super) fn misfits(&self, span: Span, point: &[f64]) -> Option<Vec<f64>> {
        let Readings { time_s, value, error, jitter_s, .. } = &self.records[self.unknowns.shooting[span.from].record];
        let mut times = self.times(span).to_vec();
        let near = |stamp: f64| {
            let [from, to] = [-*jitter_s, *jitter_s].map(|stray| Interval::point(stamp) + Interval::point(stray));
            [from.upper(), to.lower()]
        };
        if *jitter_s > 0.0 {
            let (begin, end) = (*times.first()?, *times.last()?);
            let ends = self.times(span).iter().flat_map(|stamp| near(*stamp));
            times.extend(ends.filter(|time| begin < *time && *time < end));
            times.sort_by(f64::total_cmp);
        }
        let motion = self.follow(span, &points(point), point, false, &times)?;
        let misfit = |sample: usize| {
            let [from, to] = near(time_s[sample]);
            let within = times.partition_point(|time| *time < from)..times.partition_point(|time| *time <= to);
            let off = motion[within].iter().map(|node| node.at[0] - Interval::point(value[sample]));
            let (above, below) = off.fold((f64::INFINITY, f64::NEG_INFINITY), |(above, below), off| {
                (above.min(off.upper()), below.max(off.lower()))
            });
            (Interval::point(above.max(-below)) / Interval::point(*error)).upper()
        };
        Some(self.samples(span).map(misfit).collect())
    }

    fn follow(
        &self,
        span: Span,
        at: &[Interval],
        centre: &[f64],
        with_sensitivities: bool,
        times: &[f64],
    ) -> Option<Vec<SampleEnclosure>> {
        let (record, unknowns) = (self.unknowns.shooting[span.from].record, &self.unknowns);
        let (readings, point) = (&self.records[record], points(centre));
        let instants = unknowns.instants(record);
        let command = |at: &[Interval]| {
            let spans = (0..instants).map(|edge| at[unknowns.instant(record, edge)]).collect();
            (instants > 0).then(|| Command { spans, ..readings.command.clone() })
        };
        let (over, middle) = (command(at), command(&point));
        let input = DelayedCommand {
            fields: Fields {
                over: unknowns.field(record, at, self.middle_speed),
                at: unknowns.field(record, &point, self.middle_speed),
            },
            command: over.as_ref().unwrap_or(&readings.command),
            delay_s: self.delay_s(at),
            command_at: middle.as_ref().unwrap_or(&readings.command),
            delay_at_s: self.delay_s(&point).midpoint(),
            fastest: FASTER * self.fastest,
            allowed: REMAINDER * readings.error / self.half_period_s,
            work: &self.work,
        };
        let start = StatePair { over: unknowns.state(span.from, at), at: unknowns.state(span.from, &point) };
        let (variables, places) =
            if with_sensitivities { unknowns.variables(span.from) } else { (Vec::new(), Vec::new()) };
        let deviations: Vec<Interval> = places.iter().map(|place| at[*place] - point[*place]).collect();
        follow(&input, start, times, &variables, &deviations)
    }

    /// The largest distance of the output at a sample from its reading: `E + J min(V, |v| + A J)` for a stamp that is off by at most J, with
    /// V and A the largest speed and acceleration near the stamp; beyond the ends of the motion `E + J` times the largest speed searched.
    fn allowed(&self, record: usize, motion: &[SampleEnclosure], times: &[f64], offset: usize) -> Interval {
        let Readings { error, jitter_s, .. } = &self.records[record];
        let (error, jitter) = (Interval::point(*error), Interval::point(*jitter_s));
        if *jitter_s <= 0.0 {
            return error;
        }
        let [from, to] = [-jitter, jitter].map(|stray| Interval::point(times[offset]) + stray);
        let (from, to, last) = (from.lower(), to.upper(), times.len() - 1);
        if from < times[0] || to > times[last] {
            return error + jitter * Interval::point(self.fastest);
        }
        let near = (1..=last).filter(|next| times[*next] > from && times[next - 1] < to);
        let [speed, rate] =
            near.fold([0.0f64; 2], |most, next| core::array::from_fn(|k| most[k].max(motion[next].fastest[k])));
        let here = Interval::point(motion[offset].over[1].magnitude()) + Interval::point(rate) * jitter;
        error + jitter * Interval::point(here.upper().min(speed))
    }

    /// No inequalities yet, about a centre of a box.
    pub(super) fn about(&self, at: &[Interval], centre: Vec<f64>) -> Relaxation {
        let deviations = at.iter().zip(&centre).map(|(side, middle)| *side - Interval::point(*middle)).collect();
        Relaxation { centre, deviations, work: self.work.clone(), ..Relaxation::default() }
    }

    /// Adds the inequalities of the search box: `|disturbance| <= gain max |u|`, and the least linear drag.
    pub(super) fn add_prior(&self, relaxation: &mut Relaxation) {
        let Some(gain) = self.unknowns.place_of(FieldTerm::Gain) else { return };
        for (record, readings) in self.records.iter().enumerate() {
            let disturbance = self.unknowns.disturbance(record);
            let force = Interval::point(readings.command.largest());
            for (above, sign) in [(true, Interval::ONE), (false, -Interval::ONE)] {
                let coefficients = vec![(gain, -force), (disturbance, sign)];
                relaxation.add(coefficients, Interval::ZERO, Origin::Disturbance { record, above });
            }
        }
        let linear = self.unknowns.place_of(FieldTerm::Linear);
        if let (Some(linear), Some(quadratic)) = (linear, self.unknowns.place_of(FieldTerm::Quadratic)) {
            let share = Interval::point(2.0 * self.middle_speed);
            let least = Interval::point(-self.least_linear);
            relaxation.add(vec![(linear, -Interval::ONE), (quadratic, share)], least, Origin::LeastLinear);
        }
    }

    /// Adds the inequalities of the readings of a span, whose motion is enclosed about the same centre; with `linked` those of its end.
    pub(super) fn add_motion(&self, span: Span, motion: &[SampleEnclosure], linked: bool, relaxation: &mut Relaxation) {
        let (_, places) = self.unknowns.variables(span.from);
        let record = self.unknowns.shooting[span.from].record;
        let readings = &self.records[record];
        let by = |node: &SampleEnclosure, component: usize| {
            let own = node.sensitivities.iter().map(move |own| own[component]);
            places.iter().copied().zip(own.collect::<Vec<_>>())
        };
        for (offset, (node, sample)) in motion.iter().zip(self.samples(span)).enumerate() {
            let error = self.allowed(record, motion, self.times(span), offset);
            let residual = node.at[0] - Interval::point(readings.value[sample]);
            let origin = |above| Origin::Reading { interval: span.from, sample, above };
            relaxation.add_pair(by(node, 0), residual, error, origin);
        }
        if let (true, Some(node)) = (linked, motion.last()) {
            for component in 0..self.unknowns.state_size() {
                let next = self.unknowns.start(span.to, component);
                let residual = node.at[component] - Interval::point(relaxation.centre[next]);
                let origin = |above| Origin::Link { interval: span.from, component, above };
                let coefficients = by(node, component).chain([(next, -Interval::ONE)]);
                relaxation.add_pair(coefficients, residual, Interval::ZERO, origin);
            }
        }
    }

    /// The inequalities of all shooting intervals that are followed, about `centre`. The state at the end of an
    /// interval is intersected with the box at the beginning of the next; a centre outside moves to the middle of the
    /// intersection: the mean value form is wide about a far centre. `None` where there is no enclosure.
    pub(super) fn shoot(&self, at: &mut [Interval], centre: Vec<f64>) -> Result<Option<Relaxation>, Disjoint> {
        let mut relaxation = self.about(at, centre);
        for (index, _) in self.followed() {
            let span = Span::single(index);
            let Some(motion) = self.motion(span, at, &relaxation.centre) else { return Ok(None) };
            let record = |interval: usize| self.unknowns.shooting.get(interval).map(|own| own.record);
            let linked = record(span.to) == record(span.from) && self.followed().any(|(own, _)| own == span.to);
            if let (true, Some(end)) = (linked, motion.last()) {
                for component in 0..self.unknowns.state_size() {
                    let place = self.unknowns.start(span.to, component);
                    at[place] = at[place].intersection(end.over[component]).ok_or(Disjoint)?;
                    if !at[place].contains(relaxation.centre[place]) {
                        relaxation.centre[place] = at[place].midpoint();
                    }
                    relaxation.deviations[place] = at[place] - Interval::point(relaxation.centre[place]);
                }
            }
            self.add_motion(span, &motion, linked, &mut relaxation);
        }
        self.add_prior(&mut relaxation);
        Ok(Some(relaxation))
    }
}

/// Half of a range at a side of a value.
pub(super) fn half_line(end: f64, upper: bool) -> Interval {
    let half = if upper { Interval::new(f64::NEG_INFINITY, end) } else { Interval::new(end, f64::INFINITY) };
    half.unwrap_or(Interval::ENTIRE)
}

impl Relaxation {
    /// `coefficients . theta <= limit` as a row about the centre.
    fn add(&mut self, coefficients: Vec<(usize, Interval)>, limit: Interval, origin: Origin) {
        let at_centre = coefficients.iter().map(|(place, own)| *own * Interval::point(self.centre[*place]));
        let limit = at_centre.fold(limit, |limit, part| limit - part);
        self.push(coefficients, limit.upper(), origin);
    }

    fn push(&mut self, coefficients: Vec<(usize, Interval)>, limit: f64, origin: Origin) {
        self.inequalities.coefficients.push(coefficients);
        self.inequalities.limits.push(limit);
        self.origins.push(origin);
    }

    /// `|coefficients . z + residual| <= error` as two rows.
    pub(super) fn add_pair(
        &mut self,
        coefficients: impl Iterator<Item = (usize, Interval)>,
        residual: Interval,
        error: Interval,
        origin: impl Fn(bool) -> Origin,
    ) {
        let coefficients: Vec<(usize, Interval)> = coefficients.collect();
        let negative = coefficients.iter().map(|(place, own)| (*place, -*own)).collect();
        self.push(coefficients, (error - residual).upper(), origin(true));
        self.push(negative, (error + residual).upper(), origin(false));
    }

    /// `rad(a_j) max |z_j|` of a row, by unknown: the uncertainty of the row due to the ranges of its coefficients.
    pub(super) fn uncertainty(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let coefficients = self.inequalities.coefficients[row].iter();
        coefficients.map(|(unknown, own)| (*unknown, own.radius() * self.deviations[*unknown].magnitude()))
    }

    /// The inequalities of a shooting interval and of its neighbours, and those of the search box.
    pub(super) fn beside(&self, interval: usize) -> Self {
        let near = |own: usize| own.abs_diff(interval) <= 1;
        let kept = |origin: &Origin| match *origin {
            Origin::Reading { interval: own, .. } => near(own),
            Origin::Link { interval: own, .. } => near(own) && own <= interval,
            Origin::Disturbance { .. } | Origin::LeastLinear => true,
            Origin::Modulated { .. } => false,
        };
        let mut near = Self {
            work: self.work.clone(),
            centre: self.centre.clone(),
            deviations: self.deviations.clone(),
            ..Self::default()
        };
        for (row, origin) in self.origins.iter().enumerate().filter(|(_, origin)| kept(origin)) {
            near.push(self.inequalities.coefficients[row].clone(), self.inequalities.limits[row], *origin);
        }
        near
    }

    /// The box of the deviations about the centre.
    pub(super) fn sides(&self) -> Vec<Interval> {
        self.deviations.iter().zip(&self.centre).map(|(z, centre)| *z + Interval::point(*centre)).collect()
    }

    pub(super) fn programme(&self) -> Programme {
        Programme::of(&self.inequalities, &self.deviations, &self.work)
    }

    /// The safe bound of an objective; with objective zero, of a contradiction.
    pub(super) fn upper_bound(&self, objective: &[(usize, f64)], multipliers: &Multipliers) -> f64 {
        self.inequalities.upper_bound(objective, multipliers, &self.deviations)
    }

    /// Bounds the `unknowns` of a box, by a linear programme for each end of each. `Err` with multipliers that prove it empty.
    pub(super) fn contract(&self, at: &mut [Interval], unknowns: &[usize]) -> Result<(), Multipliers> {
        let programme = self.programme();
        for &unknown in unknowns {
            for sign in [1.0, -1.0] {
                let objective = [(unknown, sign)];
                match programme.maximise(&objective) {
                    Outcome::Empty { multipliers } if self.upper_bound(&[], &multipliers) < 0.0 => {
                        return Err(multipliers);
                    }
                    Outcome::Empty { .. } => {}
                    Outcome::Bounded { multipliers, .. } => {
                        let bound = self.upper_bound(&objective, &multipliers);
                        let Some(next) = self.cut(at[unknown], unknown, sign, bound) else { return Err(multipliers) };
                        at[unknown] = next;
                    }
                }
            }
        }
        Ok(())
    }

    /// A side whose deviation, times `sign`, is at most `bound`; `None` where it is empty.
    pub(super) fn cut(&self, side: Interval, unknown: usize, sign: f64, bound: f64) -> Option<Interval> {
        let end = Interval::point(self.centre[unknown]) + Interval::point(sign * bound);
        side.intersection(half_line(if sign > 0.0 { end.upper() } else { end.lower() }, sign > 0.0))
    }

    /// The range of a combination of unknowns, `sum_j c_j theta_j`. `None` where the inequalities have no solution.
    pub(super) fn combination(&self, parts: &[(usize, f64)]) -> Option<Interval> {
        let programme = self.programme();
        let end = |sign: f64| {
            let objective: Vec<(usize, f64)> = parts.iter().map(|(place, weight)| (*place, sign * weight)).collect();
            match programme.maximise(&objective) {
                Outcome::Bounded { multipliers, .. } => Some(self.upper_bound(&objective, &multipliers)),
                Outcome::Empty { .. } => None,
            }
        };
        let at_centre = parts.iter().map(|(place, weight)| (*weight, self.centre[*place]));
        let at_centre =
            Interval::dot(at_centre.map(|(weight, centre)| (Interval::point(weight), Interval::point(centre))));
        Some(at_centre + Interval::new(-end(-1.0)?, end(1.0)?)?)
    }
}
