//! Generalised Gauss-Newton method by multiple shooting: each reading weighs by its own likelihood's curvature.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::condensing::{CondensedChain, Link, OWN, solve_shared, weighted};
use super::input::{Between, Edge, edges, gather};
use super::noise::ReadingNoise;
use super::sensitivity::{
    ActingEdges, COMMON, CommonParameters, OutputSensitivity, SHARED, ShootingInterval, UNKNOWNS, UnknownsGradient,
    integrate, uncertain,
};
use super::sensitivity::{DISTURBANCE, INSTANT, POSITION, VELOCITY};
use crate::experiment::Record;
use crate::identify::answer::{Delay, DragLaw, IdentifyError};
use crate::identify::fit::start::with_one_drag;
use crate::identify::signal::{Clock, Signal, SwitchingInstant};

/// Steps allowed; a dozen are usual.
const MAX_STEPS: usize = 60;
/// The search ends when no common parameter moves by more than this, relative.
const SETTLED: f64 = 1e-6;
/// And when the logarithm of the likelihood changes by no more than this.
const SETTLED_EVIDENCE: f64 = 0.3;
/// Change of the noise, as a logarithm, that weighs as much as a change of a parameter of this size: it is needed roughly.
const NOISE_WEIGHT: f64 = 1e-4;
/// It looks at every sample once no common parameter moves by more than this, relative.
const APPROACHED: f64 = 1e-3;
/// Samples whose motion takes longer than handing it to another thread.
const SAMPLES_PER_TASK: usize = 2000;
/// Least drag coefficient that counts, against inertia over the half-period: below, the vehicle coasts.
const LEAST_DRAG: f64 = 1e-3;
/// Least delay that counts, against the half-period.
const DELAY_SHARE: f64 = 1e-2;
/// Samples per half-period while the search is far from its end.
const COARSE: f64 = 24.0;
/// Readings within this part of the half-period determine the state at a node,
const NODE_REACH: f64 = 0.125;
/// and at least within this number of sampling intervals.
const LEAST_REACH: f64 = 1.6;
/// Noise that the search starts with, in ranges of the output.
const FIRST_NOISE: f64 = 0.02;
/// Residuals by which the noise of a rounding sensor is estimated.
const MOST_RESIDUALS: usize = 4000;
/// How far an instant may move, in standard deviations: a uniform one is within 1.7, and an edge on a sample is estimated on either side of it.
const FARTHEST_INSTANT: f64 = 2.5;
/// Largest step of inertia and of a drag, relative: the linearisation fails beyond.
const LARGEST_INERTIA_STEP: f64 = 0.5;
const LARGEST_DRAG_STEP: f64 = 2.0;
/// The first steps, and the share of them that is made.
const FIRST_STEPS: usize = 2;
const FIRST_SHARE: f64 = 0.7;
/// Delay at which the search starts, in half-periods.
const FIRST_DELAY: f64 = 0.02;
/// Least noise taken for a rounding sensor, in steps: with less, a step of the search sees hardly any reading.
pub(super) const LEAST_NOISE_STEPS: f64 = 0.15;
/// Least noise reported for a rounding sensor, in steps.
const LEAST_REAL_NOISE_STEPS: f64 = 0.01;
/// Least noise for any sensor, against the output's range: below it there is only rounding of the arithmetic.
const LEAST_NOISE: f64 = 1e-10;

/// A record and the model's motion along it.
#[derive(Clone, Debug)]
pub(super) struct ShotTrajectory<'a> {
    pub(super) record: &'a Record,
    pub(super) edges: Vec<Edge>,
    pub(super) deviations: Vec<f64>,
    pub(super) intervals: Vec<ShootingInterval>,
    pub(super) disturbance: f64,
    pub(super) noise: ReadingNoise,
    range: f64,
    half_period_s: f64,
}

/// The model along a record, linearised.
pub(super) struct LinearisedTrajectory {
    /// For each shooting interval: sample, model output with derivatives.
    pub(super) rows: Vec<Vec<(usize, OutputSensitivity)>>,
    ends: Vec<[OutputSensitivity; 2]>,
    /// For each shooting interval the edge whose instant is estimated.
    pub(super) instants: Vec<Option<usize>>,
}

/// Where a search may start.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StartingPoint {
    pub(super) between: Between,
    pub(super) shared: CommonParameters,
    pub(super) disturbances: Vec<f64>,
}

/// The state of the search.
#[derive(Clone, Debug)]
pub(super) struct GaussNewton<'a> {
    pub(super) law: DragLaw,
    pub(super) estimate_delay: bool,
    pub(super) between: Between,
    pub(super) shared: CommonParameters,
    pub(super) motions: Vec<ShotTrajectory<'a>>,
    pub(super) steps: usize,
    evidence: f64,
}

impl<'a> ShotTrajectory<'a> {
    fn new(
        record: &'a Record,
        signal: &Signal,
        between: Between,
        delay_s: f64,
        disturbance: f64,
        quantum: Option<f64>,
    ) -> Self {
        let mut edges = edges(record, between);
        let (time, half_period_s, range) = (record.time_s(), signal.half_period_s, signal.span);
        let last = time[time.len() - 1];
        // Commands before the log are unknown: the model starts once every delayed command lies in the log.
        let begin = (time[0] + delay_s).min(time[time.len() / 2]);
        let mut nodes = vec![begin];
        let acting = |edge: &Edge| edge.time_s + delay_s;
        if between == Between::Evenly || between == Between::Bent || edges.len() > record.samples() / 3 {
            let mut next = begin + half_period_s;
            while next + 0.5 * half_period_s < last {
                nodes.push(next);
                next += half_period_s;
            }
        } else {
            // A single uncertain edge per shooting interval, as far from its ends as possible.
            nodes.extend(edges.windows(2).map(|pair| f64::midpoint(acting(&pair[0]), acting(&pair[1]))));
            nodes.retain(|node| *node >= begin && *node < last);
        }
        nodes.push(last);
        if between == Between::Bent {
            gather(&mut edges, record.input()[0], |time| nodes.partition_point(|node| *node <= time + delay_s));
        }
        let intervals = nodes.windows(2).enumerate().map(|(index, pair)| {
            let from = time.partition_point(|t| *t < pair[0]);
            let to = if index + 2 == nodes.len() { time.len() } else { time.partition_point(|t| *t < pair[1]) };
            let start = signal.state_near(pair[0], (NODE_REACH * half_period_s).max(LEAST_REACH * signal.interval_s));
            ShootingInterval { begin_s: pair[0], end_s: pair[1], samples: from..to, start }
        });
        let intervals = intervals.collect();
        let quantum = quantum.or_else(|| record.quantum()).unwrap_or(0.0);
        let noise = ReadingNoise { std: FIRST_NOISE * range + quantum + f64::MIN_POSITIVE, quantum };
        Self { record, deviations: vec![0.0; edges.len()], edges, intervals, disturbance, noise, range, half_period_s }
    }

    pub(super) fn linearise(
        &self,
        shared: &CommonParameters,
        stride: usize,
    ) -> Result<LinearisedTrajectory, IdentifyError> {
        let delay_s = shared[SHARED - 1];
        let acting = |k: usize| self.edges[k].time_s + self.deviations[k] + delay_s;
        let mut next = 0;
        let mut before = self.record.input()[0];
        let mut drives = Vec::with_capacity(self.intervals.len());
        for interval in &self.intervals {
            while next < self.edges.len() && acting(next) <= interval.begin_s {
                before = self.edges[next].input;
                next += 1;
            }
            let first = next;
            let mut after = first;
            while after < self.edges.len() && acting(after) <= interval.end_s {
                after += 1;
            }
            let (edges, deviations) = (&self.edges[first..after], &self.deviations[first..after]);
            drives.push((first, ActingEdges { before, edges, deviations }));
        }
        let integrated = self.intervals.par_iter().zip(&drives).with_min_len(self.intervals_per_task()).map(
            |(interval, (_, drive))| {
                let mut rows = Vec::with_capacity(interval.samples.len() / stride + 1);
                let time = self.record.time_s();
                let end = integrate(interval, drive, time, (shared, self.disturbance), stride, &mut rows)?;
                Ok((rows, end))
            },
        );
        let (rows, ends) = integrated.collect::<Result<Vec<_>, IdentifyError>>()?.into_iter().unzip();
        let instants = drives.iter().map(|(first, drive)| Some(first + uncertain(drive.edges)?)).collect();
        Ok(LinearisedTrajectory { rows, ends, instants })
    }

    /// Shooting intervals that are worth another thread.
    fn intervals_per_task(&self) -> usize {
        1 + SAMPLES_PER_TASK * self.intervals.len() / self.record.samples()
    }

    pub(super) fn residuals(&self, linearised: &LinearisedTrajectory) -> Vec<f64> {
        let output = self.record.output();
        linearised.rows.iter().flatten().map(|(sample, model)| output[*sample] - model.value).collect()
    }

    fn least_noise(&self) -> f64 {
        (LEAST_NOISE_STEPS * self.noise.quantum).max(LEAST_NOISE * self.range).max(f64::MIN_POSITIVE)
    }

    fn update_noise(&mut self, linearised: &LinearisedTrajectory, parameters: f64) {
        let residuals = self.residuals(linearised);
        #[allow(clippy::cast_precision_loss, reason = "a count of samples")]
        let freedom = (residuals.len() as f64 - parameters).max(1.0);
        let rms = (residuals.iter().map(|residual| residual * residual).sum::<f64>() / freedom).sqrt();
        let least = self.least_noise();
        self.noise.std = if self.noise.quantum == 0.0 {
            rms.max(least)
        } else {
            let thinned: Vec<f64> = residuals.iter().step_by(residuals.len() / MOST_RESIDUALS + 1).copied().collect();
            ReadingNoise::likeliest_std(&thinned, self.noise.quantum, least, rms.max(2.0 * least))
        };
    }

    /// Rows for the chain; the right-hand sides are this one's scores, then `more` of each reading's and instant's.
    pub(super) fn links(
        &self,
        linearised: &LinearisedTrajectory,
        sides: usize,
        mut side: impl FnMut(&OutputSensitivity, f64) -> Vec<f64>,
        mut prior: impl FnMut() -> Vec<f64>,
    ) -> Vec<Link> {
        let output = self.record.output();
        let mut links = Vec::with_capacity(self.intervals.len());
        for (index, rows) in linearised.rows.iter().enumerate() {
            let mut block = DMatrix::zeros(rows.len() + 1, UNKNOWNS + 1 + sides);
            for (row, (sample, model)) in rows.iter().enumerate() {
                let likelihood = self.noise.likelihood(output[*sample] - model.value);
                let weight = likelihood.information.sqrt();
                let mut put = |column: usize, value: f64| block[(row, column)] = value;
                if weight > 0.0 {
                    weighted(model, weight).into_iter().enumerate().for_each(|(k, value)| put(k, value));
                    put(UNKNOWNS, likelihood.score / weight);
                    for (k, value) in side(model, weight).into_iter().enumerate() {
                        put(UNKNOWNS + 1 + k, value);
                    }
                }
            }
            let last = rows.len();
            match linearised.instants[index] {
                Some(edge) => {
                    let std = self.edges[edge].std_s;
                    block[(last, INSTANT)] = 1.0 / std;
                    block[(last, UNKNOWNS)] = -self.deviations[edge] / std;
                    for (k, value) in prior().into_iter().enumerate() {
                        block[(last, UNKNOWNS + 1 + k)] = value;
                    }
                }
                None => block[(last, INSTANT)] = 1.0,
            }
            let end = linearised.ends[index];
            let defect = match self.intervals.get(index + 1) {
                Some(next) => [end[0].value - next.start.position, end[1].value - next.start.velocity],
                None => [0.0; 2],
            };
            links.push(Link { rows: block, end: end.map(|sensitive| sensitive.gradient), defect });
        }
        links
    }

    /// Moves all unknowns by `share` of the steps.
    fn advance(&mut self, steps: &[UnknownsGradient], instants: &[Option<usize>], share: f64) {
        for ((interval, step), instant) in self.intervals.iter_mut().zip(steps).zip(instants) {
            interval.start.position += share * step[POSITION];
            interval.start.velocity += share * step[VELOCITY];
            if let Some(edge) = *instant {
                let limit = FARTHEST_INSTANT * self.edges[edge].std_s;
                self.deviations[edge] = (self.deviations[edge] + share * step[INSTANT]).clamp(-limit, limit);
            }
        }
        if let Some(step) = steps.first() {
            self.disturbance += share * step[DISTURBANCE];
        }
    }

    /// The noise before rounding, without the search's lower limit.
    pub(super) fn real_noise(&self, linearised: &LinearisedTrajectory) -> f64 {
        let residuals = self.residuals(linearised);
        let thinned: Vec<f64> = residuals.iter().step_by(residuals.len() / MOST_RESIDUALS + 1).copied().collect();
        ReadingNoise::likeliest_std(
            &thinned,
            self.noise.quantum,
            LEAST_REAL_NOISE_STEPS * self.noise.quantum,
            self.noise.std,
        )
    }

    fn log_likelihood(&self, linearised: &LinearisedTrajectory) -> f64 {
        self.residuals(linearised).iter().map(|residual| self.noise.likelihood(*residual).log).sum()
    }
}

impl<'a> GaussNewton<'a> {
    pub(super) fn new(
        records: &[&'a Record],
        law: DragLaw,
        delay: Delay,
        between: Between,
        quantum: Option<f64>,
    ) -> Result<Self, IdentifyError> {
        let too_few = IdentifyError::TooFewEquations { equations: 0, parameters: UNKNOWNS };
        let signal = |record: &&Record| Signal::new(record, Clock::Stamps, SwitchingInstant::AtSamples);
        let signals: Vec<Signal> = records.iter().map(signal).collect();
        let first = signals.first().ok_or(too_few)?;
        let (estimate_delay, delay_s) = match delay {
            Delay::KnownS(delay_s) => (false, delay_s),
            Delay::Estimated => (true, (FIRST_DELAY * first.half_period_s).max(0.5 * first.interval_s)),
        };
        let of = |law| with_one_drag(first, law, delay_s).ok_or(too_few);
        let (alpha, linear, quadratic) = match law {
            DragLaw::Linear => of(law).map(|[alpha, drag, _]| (alpha, drag, 0.0))?,
            DragLaw::Quadratic => of(law).map(|[alpha, drag, _]| (alpha, 0.0, drag))?,
            DragLaw::Mixed => {
                let (linear, quadratic) = (of(DragLaw::Linear)?, of(DragLaw::Quadratic)?);
                (0.5 * (linear[0] + quadratic[0]), 0.5 * linear[1], 0.5 * quadratic[1])
            }
        };
        let motions = records.iter().zip(&signals).map(|(record, signal)| {
            let single = if law == DragLaw::Quadratic { law } else { DragLaw::Linear };
            let disturbance = with_one_drag(signal, single, delay_s).map_or(0.0, |[.., disturbance]| disturbance);
            ShotTrajectory::new(record, signal, between, delay_s, disturbance, quantum)
        });
        let motions = motions.collect();
        let shared = [alpha, linear, quadratic, delay_s];
        Ok(Self { law, estimate_delay, between, shared, motions, steps: 0, evidence: f64::NEG_INFINITY })
    }

    /// The same search from another place.
    pub(super) fn starting_at(mut self, start: &StartingPoint) -> Self {
        let delay_s = if self.estimate_delay { start.shared[SHARED - 1] } else { self.shared[SHARED - 1] };
        self.shared = start.shared;
        self.shared[SHARED - 1] = delay_s;
        for (motion, disturbance) in self.motions.iter_mut().zip(&start.disturbances) {
            motion.disturbance = *disturbance;
        }
        self
    }

    /// Where it is, as the start of another search.
    pub(super) fn place(&self) -> StartingPoint {
        let disturbances = self.motions.iter().map(|motion| motion.disturbance).collect();
        StartingPoint { between: self.between, shared: self.shared, disturbances }
    }

    /// Logarithm of the likelihood with the uncertain instants integrated out (Laplace's approximation): comparable between treatments of the input and
    /// between drag laws.
    pub(super) fn evidence(&self) -> f64 {
        self.evidence
    }

    /// Common unknowns that the drag law or a given delay fixes.
    pub(super) fn fixed(&self) -> [Option<f64>; SHARED] {
        let fix = |fixed: bool| fixed.then_some(0.0);
        [None, fix(!self.law.has_linear()), fix(!self.law.has_quadratic()), fix(!self.estimate_delay)]
    }

    pub(super) fn parameters(&self) -> usize {
        self.fixed().iter().filter(|fixed| fixed.is_none()).count() + OWN * self.motions.len()
    }

    /// Every how many samples the search looks while it is far from its end: a matter of the records alone, so that likelihoods
    /// on the way are comparable.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most the number of samples")]
    fn coarse_stride(&self) -> usize {
        let samples = |motion: &ShotTrajectory<'_>| motion.half_period_s / (COARSE * motion.record.interval_s());
        self.motions.iter().map(samples).fold(f64::INFINITY, f64::min).max(1.0) as usize
    }

    /// Steps with part of the samples, until little moves.
    pub(super) fn approach(self) -> Result<Self, IdentifyError> {
        let samples: usize = self.motions.iter().map(|motion| motion.record.samples()).sum();
        if samples <= self.parameters() {
            return Err(IdentifyError::TooFewEquations { equations: samples, parameters: self.parameters() });
        }
        let stride = self.coarse_stride();
        self.iterate(stride, if stride > 1 { APPROACHED } else { SETTLED })
    }

    /// Steps with every sample, until nothing moves.
    pub(super) fn settle(self) -> Result<Self, IdentifyError> {
        if self.coarse_stride() == 1 { Ok(self) } else { self.refine() }
    }

    /// Steps with every sample from wherever it is.
    pub(super) fn refine(self) -> Result<Self, IdentifyError> {
        self.iterate(1, SETTLED)
    }

    fn iterate(mut self, stride: usize, limit: f64) -> Result<Self, IdentifyError> {
        self.check()?;
        let mut moved = f64::INFINITY;
        for _ in 0..MAX_STEPS {
            let before = self.evidence;
            moved = self.step(stride)?;
            self.steps += 1;
            // The common parameters may stand while the states have yet to follow; without noise they follow for ever.
            let clean = self.motions.iter().all(|motion| motion.noise.std <= motion.least_noise());
            if moved < limit && (clean || (self.evidence - before).abs() < SETTLED_EVIDENCE) {
                return Ok(self);
            }
        }
        // The likelihood of the noise can be flat at rounding's edge: the rest is then far below any error.
        if moved < APPROACHED {
            return Ok(self);
        }
        Err(IdentifyError::NotSettled {
            steps: self.steps,
            rms: self.motions.first().map_or(f64::NAN, |m| m.noise.std),
        })
    }

    /// One step; the largest relative motion of a common parameter.
    fn step(&mut self, stride: usize) -> Result<f64, IdentifyError> {
        #[allow(clippy::cast_precision_loss, reason = "a small count")]
        let parameters = self.parameters() as f64 / self.motions.len() as f64;
        let mut chains = Vec::with_capacity(self.motions.len());
        let (mut evidence, mut moved) = (0.0, 0.0f64);
        for motion in &mut self.motions {
            let linearised = motion.linearise(&self.shared, stride)?;
            if self.steps > 0 {
                let before = motion.noise.std;
                motion.update_noise(&linearised, parameters);
                moved = moved.max(NOISE_WEIGHT * libm::log(motion.noise.std / before).abs());
            }
            let links = motion.links(&linearised, 0, |_, _| Vec::new(), Vec::new);
            let chain = CondensedChain::new(&links);
            evidence += motion.log_likelihood(&linearised);
            for (information, instant) in chain.log_information().zip(&linearised.instants) {
                if let Some(edge) = *instant {
                    let std = motion.edges[edge].std_s;
                    evidence -= 0.5 * (motion.deviations[edge] / std).powi(2) + information + libm::log(std);
                }
            }
            chains.push((chain, linearised.instants));
        }
        self.evidence = evidence;
        let shared = self.bounded(&chains)?;
        let mut steps = Vec::with_capacity(chains.len());
        for (chain, _) in &chains {
            steps.push(chain.unfold(chain.own(&shared, 0)?, &shared));
        }
        let scales = self.scales();
        let relative = |k: usize| shared[k] / scales[k];
        let share = (LARGEST_INERTIA_STEP / relative(0).abs()).min(1.0);
        let share = (1..SHARED - 1).fold(share, |share, k| {
            if relative(k) > LARGEST_DRAG_STEP { share.min(LARGEST_DRAG_STEP / relative(k)) } else { share }
        });
        let share = if self.steps < FIRST_STEPS { share.min(FIRST_SHARE) } else { share };
        for ((motion, steps), (_, instants)) in self.motions.iter_mut().zip(&steps).zip(&chains) {
            motion.advance(steps, instants, share);
        }
        for ((value, step), scale) in self.shared.iter_mut().zip(shared).zip(scales) {
            let before = *value;
            *value = (before + share * step).max(0.0);
            moved = moved.max((*value - before).abs() / scale);
        }
        self.check()?;
        Ok(if share < 1.0 { moved.max(1.0) } else { moved })
    }

    /// Fails unless inertia is above zero and all unknowns are finite.
    fn check(&self) -> Result<(), IdentifyError> {
        let [alpha, ..] = self.shared;
        let sound =
            alpha > 0.0 && self.shared.iter().chain(self.motions.iter().map(|m| &m.disturbance)).all(|v| v.is_finite());
        if sound { Ok(()) } else { Err(IdentifyError::Confounded { ratio: 0.0 }) }
    }

    /// Scales of the common unknowns: inertia by itself, either drag by both at the record's typical speed, the
    /// delay by itself or a part of the half-period, so that an unknown near zero still moves.
    fn scales(&self) -> CommonParameters {
        let [alpha, linear, quadratic, delay_s] = self.shared;
        let typical =
            |of: fn(&ShotTrajectory<'_>) -> f64| self.motions.iter().map(of).fold(f64::MIN_POSITIVE, f64::max);
        let speed = typical(|motion| core::f64::consts::FRAC_PI_2 * motion.range / motion.half_period_s);
        let drag = (linear + quadratic * speed).max(LEAST_DRAG * alpha / typical(|motion| motion.half_period_s));
        [alpha, drag, drag / speed, delay_s.max(DELAY_SHARE * typical(|motion| motion.half_period_s))]
    }

    /// The step of the common unknowns, with drag and delay kept at zero or more by an active set.
    fn bounded(&self, chains: &[(CondensedChain, Vec<Option<usize>>)]) -> Result<CommonParameters, IdentifyError> {
        let stacked = stack(chains.iter().map(|(chain, _)| chain));
        let mut fixed = self.fixed();
        loop {
            let (solutions, _) = solve_shared(&stacked, &fixed)?;
            let step = solutions[0];
            let below = (1..SHARED).find(|k| fixed[*k].is_none() && self.shared[*k] + step[*k] < 0.0);
            let Some(below) = below else { return Ok(step) };
            fixed[below] = Some(-self.shared[below]);
        }
    }
}

/// The common unknowns' rows of all records.
pub(super) fn stack<'a>(chains: impl Iterator<Item = &'a CondensedChain> + Clone) -> DMatrix<f64> {
    let blocks: Vec<_> = chains.map(CondensedChain::shared).collect();
    let columns = blocks.first().map_or(SHARED + 1, |block| block.ncols());
    DMatrix::from_fn(SHARED * blocks.len(), columns, |row, column| blocks[row / SHARED][(row % SHARED, column)])
}

const _: () = assert!(COMMON + SHARED == UNKNOWNS && DISTURBANCE + 1 == COMMON);
