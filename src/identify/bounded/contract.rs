//! One pass of contraction: the readings as linear inequalities over a box, and what they leave of each unknown.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::effort::Effort;
use super::field::Term;
use super::lp::{Multipliers, Outcome, Programme, Rows};
use super::mix::{By, Mix};
use super::problem::{Layout, Readings};
use super::step::{Fields, Pair};
use super::trajectory::{Drive, Node, Unknowns, follow};
use crate::numeric::Interval;

/// Share of a reading's error that a step's remainder may be.
const REMAINDER: f64 = 1e-6;

/// Samples at which a hat begins, has its peak, and ends.
pub(super) type Hat = [usize; 3];

/// What stands behind a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Origin {
    /// The reading of a sample: the output must not be above, or not below, what it allows.
    Reading { window: usize, sample: usize, above: bool },
    /// The end of a window, one component: not above, or not below, the beginning of the next.
    Link { window: usize, component: usize, above: bool },
    /// The search box's own: a disturbance is not above, or not below, what the command can meet.
    Disturbance { record: usize, above: bool },
    /// Linear drag has its least coefficient.
    LeastLinear,
    /// The equation weighed with the hat at these samples: not more, or not less, than the readings allow.
    Hat { record: usize, samples: Hat, above: bool },
}

/// The readings over a box, linearised.
#[derive(Clone, Debug, Default)]
pub(super) struct Linear {
    pub(super) effort: Effort,
    pub(super) rows: Rows,
    pub(super) origins: Vec<Origin>,
    pub(super) centre: Vec<f64>,
    pub(super) deviations: Vec<Interval>,
}

/// Successive windows of one record, from the first to before the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) from: usize,
    pub(super) to: usize,
}

/// Each unknown by itself.
fn singly(by: &[By]) -> Vec<Mix> {
    by.iter().map(|by| Mix::of([(*by, 1.0)])).collect()
}

/// Problem data that contraction needs.
pub(super) struct Model<'a> {
    pub(super) records: &'a [Readings],
    pub(super) layout: &'a Layout,
    pub(super) middle_speed: f64,
    /// The delay where it is known.
    pub(super) known_delay_s: Interval,
    /// Least coefficient of linear drag over alpha.
    pub(super) least_linear: f64,
    /// No speed beyond this is looked for.
    pub(super) fastest: f64,
    /// Reciprocal of the time over which a step's remainder of the velocity matters; none for steps by the fastest rate alone.
    pub(super) per_s: Option<f64>,
    pub(super) effort: Effort,
    /// So many windows of each record, from its first on, are followed.
    pub(super) reach: usize,
    /// Readings of each record that are heard; all without.
    pub(super) heard: Option<Vec<BTreeSet<usize>>>,
}

impl Model<'_> {
    /// How far the output of a motion at these samples may be from one of its readings, by its number in the motion: as far as the
    /// vehicle goes while the stamp is off by the jitter J, `J min(V, |v| + A J)` with V and A the largest speed and acceleration near
    /// the stamp. Beyond the motion's ends it goes as fast as is looked for.
    pub(super) fn allowed(&self, record: usize, motion: &[Node], samples: &[usize], offset: usize) -> Interval {
        let Readings { time_s, error, jitter_s, .. } = &self.records[record];
        let (error, jitter) = (Interval::point(*error), Interval::point(*jitter_s));
        if *jitter_s <= 0.0 {
            return error;
        }
        let stamp = |offset: usize| time_s[samples[offset]];
        let [from, to] = [-jitter, jitter].map(|stray| Interval::point(stamp(offset)) + stray);
        let (from, to, last) = (from.lower(), to.upper(), samples.len() - 1);
        if from < stamp(0) || to > stamp(last) {
            return error + jitter * Interval::point(self.fastest);
        }
        let near = (1..=last).filter(|next| stamp(*next) > from && stamp(next - 1) < to);
        let [speed, rate] =
            near.fold([0.0f64; 2], |most, next| core::array::from_fn(|k| most[k].max(motion[next].fastest[k])));
        let here = Interval::point(motion[offset].over[1].magnitude()) + Interval::point(rate) * jitter;
        error + jitter * Interval::point(here.upper().min(speed))
    }

    pub(super) fn delay_s(&self, at: &[Interval]) -> Interval {
        self.layout.delay().map_or(self.known_delay_s, |place| at[place])
    }

    /// Samples of a span of windows, and whether they are heard: its ends always are.
    fn all_samples(&self, span: Span) -> impl Iterator<Item = (usize, bool)> + '_ {
        let windows = self.layout.windows();
        let (stretch, last) = (windows[span.from], windows[span.to - 1].last);
        let heard = self.heard.as_ref().map(|heard| &heard[stretch.record]);
        (stretch.first..=last).map(move |sample| {
            let end = sample == stretch.first || sample == last;
            (sample, end || heard.is_none_or(|heard| heard.contains(&sample)))
        })
    }

    /// Those that are heard.
    pub(super) fn samples(&self, span: Span) -> Vec<usize> {
        self.all_samples(span).filter(|(_, heard)| *heard).map(|(sample, _)| sample).collect()
    }

    /// The motion over a span of windows, at its samples: over a box, and how it differs from that of `centre`. `None` where it cannot
    /// be enclosed.
    pub(super) fn motion(&self, span: Span, at: &[Interval], centre: &[f64]) -> Option<Vec<Node>> {
        let (by, places) = self.layout.columns(span.from);
        let deviations: Vec<Interval> =
            places.iter().map(|place| at[*place] - Interval::point(centre[*place])).collect();
        let unknowns = Unknowns { mixes: &singly(&by), deviations: &deviations, bending: false };
        self.follow(span, at, centre, unknowns, &self.times(span))
    }

    /// The outputs of one point over a span of windows.
    pub(super) fn outputs(&self, span: Span, centre: &[f64]) -> Option<Vec<Interval>> {
        Some(self.point(span, centre, &self.times(span))?.iter().map(|node| node.at[0]).collect())
    }

    fn point(&self, span: Span, centre: &[f64], times: &[(f64, bool)]) -> Option<Vec<Node>> {
        let at: Vec<Interval> = centre.iter().map(|value| Interval::point(*value)).collect();
        self.follow(span, &at, centre, Unknowns::NONE, times)
    }

    /// Upper bound of the largest misfit of one point over a span of windows, in largest errors. `None` where its motion cannot
    /// be enclosed. A reading y was taken within the jitter J of its stamp t, and the output is continuous: it is within E of y at an
    /// instant between two of [t - J, t + J] where it is not above y + E, and not below y - E.
    pub(super) fn misfit(&self, span: Span, centre: &[f64]) -> Option<f64> {
        let Readings { time_s, value, error, jitter_s, .. } = &self.records[self.layout.windows()[span.from].record];
        let (samples, mut times) = (self.samples(span), self.times(span));
        let near = |stamp: f64| {
            let [from, to] = [-*jitter_s, *jitter_s].map(|stray| Interval::point(stamp) + Interval::point(stray));
            [from.upper(), to.lower()]
        };
        if *jitter_s > 0.0 {
            let (begin, end) = (times.first()?.0, times.last()?.0);
            let ends = samples.iter().flat_map(|sample| near(time_s[*sample])).filter(|end| *end > begin);
            times.extend(ends.filter(|time| *time < end).map(|time| (time, true)).collect::<Vec<_>>());
            times.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        let motion = self.point(span, centre, &times)?;
        let heard: Vec<f64> = times.iter().filter(|(_, heard)| *heard).map(|(time, _)| *time).collect();
        Some(samples.iter().fold(0.0, |largest, sample| {
            let [from, to] = near(time_s[*sample]);
            let within = heard.partition_point(|time| *time < from)..heard.partition_point(|time| *time <= to);
            let off = motion[within].iter().map(|node| node.at[0] - Interval::point(value[*sample]));
            let ends = off.fold((f64::INFINITY, f64::NEG_INFINITY), |(above, below), off| {
                (above.min(off.upper()), below.max(off.lower()))
            });
            let misfit = Interval::point(ends.0.max(-ends.1)) / Interval::point(*error);
            largest.max(misfit.upper())
        }))
    }

    /// Instants of the samples of a span, and whether they are heard.
    pub(super) fn times(&self, span: Span) -> Vec<(f64, bool)> {
        let time_s = &self.records[self.layout.windows()[span.from].record].time_s;
        self.all_samples(span).map(|(sample, heard)| (time_s[sample], heard)).collect()
    }

    /// The motion at those of these `times`, from the span's first sample on, that are heard.
    pub(super) fn follow(
        &self,
        span: Span,
        at: &[Interval],
        centre: &[f64],
        unknowns: Unknowns<'_>,
        times: &[(f64, bool)],
    ) -> Option<Vec<Node>> {
        let stretch = self.layout.windows()[span.from];
        let readings = &self.records[stretch.record];
        let point: Vec<Interval> = centre.iter().map(|value| Interval::point(*value)).collect();
        let fields = Fields {
            over: self.layout.field(stretch.record, at, self.middle_speed),
            at: self.layout.field(stretch.record, &point, self.middle_speed),
        };
        let own = self.layout.instants(stretch.record);
        let moved = |at: &[Interval]| {
            let spans = (0..own).map(|edge| at[self.layout.instant(stretch.record, edge)]);
            (own > 0).then(|| readings.command.with_spans(spans))
        };
        let (over, middle) = (moved(at), moved(&point));
        let drive = Drive {
            fields,
            command: over.as_ref().unwrap_or(&readings.command),
            delay_s: self.delay_s(at),
            command_at: middle.as_ref().unwrap_or(&readings.command),
            delay_at_s: self.delay_s(&point).midpoint(),
            fastest: 2.0 * self.fastest,
            remainder: self.per_s.map(|per_s| REMAINDER * readings.error * per_s),
            effort: &self.effort,
        };
        let start = Pair { over: self.layout.state_of(span.from, at), at: self.layout.state_of(span.from, &point) };
        follow(&drive, start, times, unknowns)
    }

    /// Deviations from a point of a box.
    pub(super) fn about(&self, at: &[Interval], centre: Vec<f64>) -> Linear {
        let deviations = at.iter().zip(&centre).map(|(side, middle)| *side - Interval::point(*middle)).collect();
        Linear { centre, deviations, effort: self.effort.clone(), ..Linear::default() }
    }

    /// What the search box says beyond the sides of a box: a disturbance is no stronger than the largest command, and linear drag
    /// itself, without the quadratic one's share, is not below its least.
    pub(super) fn bound(&self, linear: &mut Linear) {
        let Some(gain) = self.layout.place_of(Term::Gain) else { return };
        for (record, readings) in self.records.iter().enumerate() {
            let disturbance = self.layout.disturbance(record);
            let force = Interval::point(readings.command.largest());
            for (above, sign) in [(true, Interval::ONE), (false, -Interval::ONE)] {
                linear.row(
                    vec![(gain, -force), (disturbance, sign)],
                    Interval::ZERO,
                    Origin::Disturbance { record, above },
                );
            }
        }
        let linear_place = self.layout.place_of(Term::Linear);
        if let (Some(whole), Some(quadratic)) = (linear_place, self.layout.place_of(Term::Quadratic)) {
            let share = Interval::point(2.0 * self.middle_speed);
            let least = Interval::point(-self.least_linear);
            linear.row(vec![(whole, -Interval::ONE), (quadratic, share)], least, Origin::LeastLinear);
        }
    }

    /// Adds the inequalities of one span, whose motion over the box and about the same centre is known; those of its end with `linked`.
    pub(super) fn linearise(&self, span: Span, over: &[Node], linked: bool, linear: &mut Linear) {
        let (_, places) = self.layout.columns(span.from);
        self.linearise_by(&places, span, over, linked, linear);
    }

    /// The same by the unknowns at these places.
    pub(super) fn linearise_by(&self, places: &[usize], span: Span, over: &[Node], linked: bool, linear: &mut Linear) {
        let record = self.layout.windows()[span.from].record;
        let (readings, samples) = (&self.records[record], self.samples(span));
        for (offset, (node, &sample)) in over.iter().zip(&samples).enumerate() {
            let error = self.allowed(record, over, &samples, offset);
            let residual = node.at[0] - Interval::point(readings.value[sample]);
            let slopes = places.iter().copied().zip(node.slopes.iter().map(|slope| slope[0]));
            linear.pair(slopes, residual, error, |above| Origin::Reading { window: span.from, sample, above });
        }
        if linked {
            let Some(node) = over.last() else { return };
            for component in 0..self.layout.state_size() {
                let next = self.layout.start(span.to, component);
                let slopes = places.iter().copied().zip(node.slopes.iter().map(|slope| slope[component]));
                let slopes = slopes.chain([(next, -Interval::ONE)]);
                let residual = node.at[component] - Interval::point(linear.centre[next]);
                linear.pair(slopes, residual, Interval::ZERO, |above| Origin::Link {
                    window: span.from,
                    component,
                    above,
                });
            }
        }
    }
}

/// What a pass left of a box.
#[derive(Clone, Debug)]
pub(super) enum Pass {
    /// What is in the box that was handed over.
    Contracted,
    /// Nothing: these rows contradict each other over the box.
    Empty(Multipliers),
}

impl Linear {
    /// The same about another value of one unknown.
    pub(super) fn recentre(&mut self, unknown: usize, centre: f64) {
        let moved = Interval::point(centre) - Interval::point(self.centre[unknown]);
        for (slopes, limit) in self.rows.slopes.iter().zip(&mut self.rows.limits) {
            for (_, slope) in slopes.iter().filter(|(place, _)| *place == unknown) {
                *limit = (Interval::point(*limit) - *slope * moved).upper();
            }
        }
        self.deviations[unknown] -= moved;
        self.centre[unknown] = centre;
    }

    /// `slopes . theta <= limit` as a row about the centre.
    fn row(&mut self, slopes: Vec<(usize, Interval)>, limit: Interval, origin: Origin) {
        let at_centre = slopes.iter().map(|(place, slope)| *slope * Interval::point(self.centre[*place]));
        let limit = at_centre.fold(limit, |limit, part| limit - part);
        self.rows.limits.push(limit.upper());
        self.rows.slopes.push(slopes);
        self.origins.push(origin);
    }

    /// `|slopes . z + residual| <= error` as two rows.
    pub(super) fn pair(
        &mut self,
        slopes: impl Iterator<Item = (usize, Interval)> + Clone,
        residual: Interval,
        error: Interval,
        origin: impl Fn(bool) -> Origin,
    ) {
        self.rows.slopes.push(slopes.clone().collect());
        self.rows.limits.push((error - residual).upper());
        self.origins.push(origin(true));
        self.rows.slopes.push(slopes.map(|(place, slope)| (place, -slope)).collect());
        self.rows.limits.push((error + residual).upper());
        self.origins.push(origin(false));
    }

    /// What the ranges of a row's slopes add to it, by each unknown.
    pub(super) fn in_doubt(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let slopes = self.rows.slopes[row].iter();
        slopes.map(|(unknown, slope)| (*unknown, slope.radius() * self.deviations[*unknown].magnitude()))
    }

    /// The inequalities of a window and of those beside it, and the search box's own.
    pub(super) fn beside(&self, window: usize) -> Self {
        let near = |own: usize| own.abs_diff(window) <= 1;
        let kept = |origin: &Origin| match *origin {
            Origin::Reading { window: own, .. } => near(own),
            Origin::Link { window: own, .. } => near(own) && own <= window,
            Origin::Disturbance { .. } | Origin::LeastLinear => true,
            Origin::Hat { .. } => false,
        };
        let mut linear = Self {
            effort: self.effort.clone(),
            centre: self.centre.clone(),
            deviations: self.deviations.clone(),
            ..Self::default()
        };
        for (row, origin) in self.origins.iter().enumerate().filter(|(_, origin)| kept(origin)) {
            linear.rows.slopes.push(self.rows.slopes[row].clone());
            linear.rows.limits.push(self.rows.limits[row]);
            linear.origins.push(*origin);
        }
        linear
    }

    /// The unknowns that the inequalities have.
    pub(super) fn places(&self) -> Vec<usize> {
        let places: BTreeSet<usize> = self.rows.slopes.iter().flatten().map(|(place, _)| *place).collect();
        places.into_iter().collect()
    }

    /// With these unknowns.
    pub(super) fn programme(&self, places: &[usize]) -> Programme {
        Programme::of(&self.rows, &self.deviations, places, &self.effort)
    }

    /// Bounds the `unknowns`, of which the rows are linear inequalities together with the other `places`.
    pub(super) fn contract(&self, at: &mut [Interval], places: &[usize], unknowns: &[usize]) -> Pass {
        let programme = self.programme(places);
        for &unknown in unknowns {
            for sign in [1.0, -1.0] {
                let objective = [(unknown, sign)];
                match programme.maximise(&objective) {
                    Outcome::Empty { multipliers } => {
                        if self.rows.upper_bound(&[], &multipliers, &self.deviations) < 0.0 {
                            return Pass::Empty(multipliers);
                        }
                    }
                    Outcome::Bounded { multipliers, .. } => {
                        let bound = self.rows.upper_bound(&objective, &multipliers, &self.deviations);
                        let Some(next) = self.cut(at[unknown], unknown, sign, bound) else {
                            return Pass::Empty(multipliers);
                        };
                        at[unknown] = next;
                    }
                }
            }
        }
        Pass::Contracted
    }

    /// What is left of a side whose deviation, times `sign`, is at most `bound`; `None` for nothing.
    pub(super) fn cut(&self, side: Interval, unknown: usize, sign: f64, bound: f64) -> Option<Interval> {
        let end = Interval::point(self.centre[unknown]) + Interval::point(sign * bound);
        let half = if sign > 0.0 {
            Interval::new(f64::NEG_INFINITY, end.upper())
        } else {
            Interval::new(end.lower(), f64::INFINITY)
        };
        // An unbounded end says nothing.
        half.map_or(Some(side), |half| side.intersection(half))
    }
}
