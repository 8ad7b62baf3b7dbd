//! Maximum likelihood by Fisher scoring with Levenberg's damping: each step is the gradient over the information.

use nalgebra::{DMatrix, DVector};

use super::filter::{self, FilterPass, Score};
use super::model::{NoiseParameter, Parameter, VehicleModel};
use super::observations::Observations;

/// A model at its maximum.
#[derive(Clone, Debug)]
pub(super) struct Fitted {
    pub(super) model: VehicleModel,
    pub(super) log_likelihood: f64,
    pub(super) score: Score,
    pub(super) pass: FilterPass,
    /// Whether the search came to rest.
    pub(super) settled: bool,
    /// Steps of all integrations with derivatives.
    pub(super) integrated: usize,
}

/// Steps of one search.
pub(super) const MOST_STEPS: usize = 40;
/// A step that promises to gain less, or gains less, ends the search.
const NEGLIGIBLE_GAIN: f64 = 2e-3;
/// A search that ran out of steps counts as at rest where the structure promises less than this.
const NEARLY_SETTLED: f64 = 0.1;
/// Steps before a search may be given up, and how many times as much as it promises is thought possible.
const PATIENCE: usize = 3;
const OPTIMISM: f64 = 2.0;
/// Damping of the first step, in parts of the information's diagonal, and the least of the noise's.
const LEAST_DAMPING: f64 = 1e-6;
const NOISE_DAMPING: f64 = 1e-4;
/// Damping up to which a negligible promise ends the search, and beyond which no step gains.
const SETTLED_DAMPING: f64 = 1e-2;
const MOST_DAMPING: f64 = 1e5;
/// The largest change of a logarithm in one step.
const LARGEST_LOG_STEP: f64 = 1.5;

/// No reading counts as finer than this part of the output's range: that is how well the motion is integrated.
const FINEST: f64 = 3e-5;

/// Least and largest value of a structural parameter.
fn bounds(parameter: Parameter, observations: &Observations) -> (f64, f64) {
    let (interval, half_period) = (observations.interval_s, observations.half_period_s);
    match parameter {
        Parameter::Alpha => (1e-9 * observations.range * half_period * half_period / observations.span, f64::INFINITY),
        Parameter::DelayS => (0.0, half_period),
        Parameter::LagS | Parameter::FilterS => (0.02 * interval, 2.0 * half_period),
        Parameter::MemoryS => (0.1 * half_period, 5.0 * half_period),
        Parameter::Skew => (-0.9, 0.9),
        Parameter::RampS | Parameter::PauseS => (0.05 * interval, 2.0 * half_period),
        _ => (f64::NEG_INFINITY, f64::INFINITY),
    }
}

/// Range of the logarithm of a noise's size.
fn noise_bounds(noise: NoiseParameter, observations: &Observations) -> (f64, f64) {
    let (interval, half_period, span) = (observations.interval_s, observations.half_period_s, observations.span);
    let force = observations.range;
    let (low, high) = match noise {
        NoiseParameter::White => ((FINEST * span).powi(2), span * span),
        NoiseParameter::Force => (1e-10 * force * force / half_period, 10.0 * force * force / half_period),
        NoiseParameter::Colour => (1e-12 * span * span / half_period, span * span / interval),
        NoiseParameter::ColourRate => (0.02 / observations.duration_s(), 3.0 / interval),
        NoiseParameter::Tracking => {
            (1e-10 * (span / half_period).powi(2) / half_period, 100.0 * (span / half_period).powi(2) / half_period)
        }
    };
    (libm::log(low), libm::log(high))
}

/// Solves for the part of a step that the free parameters make; damped where the information leaves them open.
pub(super) fn solve<const N: usize>(
    information: &[[f64; N]; N],
    gradient: &[f64; N],
    free: &[usize],
    damping: f64,
) -> Option<(Vec<f64>, f64)> {
    let n = free.len();
    if n == 0 {
        return Some((Vec::new(), 0.0));
    }
    let scale: Vec<f64> = free.iter().map(|i| information[*i][*i].sqrt().max(f64::MIN_POSITIVE.sqrt())).collect();
    let matrix = DMatrix::from_fn(n, n, |row, column| {
        let entry = information[free[row]][free[column]] / (scale[row] * scale[column]);
        if row == column { entry + damping } else { entry }
    });
    let right = DVector::from_fn(n, |row, _| gradient[free[row]] / scale[row]);
    let step = matrix.cholesky()?.solve(&right);
    let gain = step.dot(&right);
    Some((step.iter().zip(&scale).map(|(step, scale)| step / scale).collect(), gain))
}

/// Climbs from where the model stands. `None` where not even the start can be evaluated.
pub(super) fn climb(observations: &Observations, start: VehicleModel) -> Option<Fitted> {
    climb_within(observations, start, MOST_STEPS)
}

/// As [`climb`], with a limit of the steps.
pub(super) fn climb_within(observations: &Observations, start: VehicleModel, most_steps: usize) -> Option<Fitted> {
    climb_beyond(observations, start, most_steps, f64::NEG_INFINITY)
}

/// As [`climb_within`]; the search is given up once it does not promise to pass a log-likelihood.
pub(super) fn climb_beyond(
    observations: &Observations,
    mut model: VehicleModel,
    most_steps: usize,
    worth: f64,
) -> Option<Fitted> {
    for parameter in Parameter::ALL.into_iter().filter(|p| model.free[*p as usize]) {
        let (low, high) = bounds(parameter, observations);
        let value = &mut model.values[parameter as usize];
        *value = value.clamp(low, high);
    }
    for noise in NoiseParameter::ALL.into_iter().filter(|noise| model.noise_free[*noise as usize]) {
        let (low, high) = noise_bounds(noise, observations);
        let value = &mut model.noise[noise as usize];
        *value = value.clamp(low, high);
    }
    let mut pass = filter::run(observations, &model, filter::Evaluation::Score)?;
    let mut damping = LEAST_DAMPING;
    let mut settled = false;
    let (mut steps, mut rejected, mut integrated) = (0, 0, pass.steps);
    while steps < most_steps {
        steps += 1;
        let (score, log_likelihood) = (pass.score(), pass.log_likelihood);
        let structure = movable(&model, &score, observations);
        let noise: Vec<usize> = (0..NoiseParameter::COUNT).filter(|i| model.noise_free[*i]).collect();
        let moved = solve(&score.structure_information, &score.structure, &structure, damping).zip(solve(
            &score.noise_information,
            &score.noise,
            &noise,
            damping.max(NOISE_DAMPING),
        ));
        let Some(((by_structure, gain), (by_noise, noise_gain))) = moved else {
            damping = (10.0 * damping).max(LEAST_DAMPING);
            continue;
        };
        if gain + noise_gain < 2.0 * NEGLIGIBLE_GAIN && damping <= SETTLED_DAMPING {
            settled = true;
            break;
        }
        if steps > PATIENCE && log_likelihood + OPTIMISM * 0.5 * (gain + noise_gain) < worth {
            break;
        }
        let next = |with_structure: bool, with_noise: bool| {
            let mut next = model.clone();
            for (index, step) in structure.iter().zip(&by_structure).filter(|_| with_structure) {
                let (low, high) = bounds(Parameter::ALL[*index], observations);
                let value = model.values[*index];
                // Inertia changes by its half at most.
                let step = if *index == Parameter::Alpha as usize { step.clamp(-0.5 * value, value) } else { *step };
                next.values[*index] = (value + step).clamp(low, high);
            }
            for (index, step) in noise.iter().zip(&by_noise).filter(|_| with_noise) {
                let (low, high) = noise_bounds(NoiseParameter::ALL[*index], observations);
                next.noise[*index] =
                    (model.noise[*index] + step.clamp(-LARGEST_LOG_STEP, LARGEST_LOG_STEP)).clamp(low, high);
            }
            next
        };
        let mut run = |next: &VehicleModel, wanted: filter::Evaluation| {
            let pass = filter::run(observations, next, wanted)?;
            integrated += if wanted == filter::Evaluation::Score { pass.steps } else { 0 };
            (pass.log_likelihood > log_likelihood).then_some(pass)
        };
        let whole = next(true, true);
        // Far from the maximum the two blocks of the information are not independent: each alone may still gain.
        let blocks = [(true, false), (false, true)].into_iter().filter(|_| noise.len() > 1);
        let better = run(&whole, filter::Evaluation::Score).map(|pass| (whole, pass)).or_else(|| {
            blocks.map(|(with_structure, with_noise)| next(with_structure, with_noise)).find_map(|next| {
                // Most blocks gain nothing: their likelihood alone is half the work or less.
                run(&next, filter::Evaluation::Likelihood)?;
                run(&next, filter::Evaluation::Score).map(|pass| (next, pass))
            })
        });
        match better {
            Some((next, better)) => {
                let gained = better.log_likelihood - log_likelihood;
                pass = better;
                model = next;
                rejected = 0;
                damping = (damping * if damping > 1e-3 { 0.1 } else { 0.3 }).max(1e-9);
                if gained < NEGLIGIBLE_GAIN {
                    settled = true;
                    break;
                }
            }
            None => {
                // Damping grows the faster the more steps in a row are rejected (Nielsen 1999).
                rejected += 1;
                damping = (damping * 10f64.powi(rejected)).max(1e-3);
                if damping > MOST_DAMPING {
                    // The predictor's gradient is not quite that of the likelihood: no step improves it any more.
                    settled = gain + noise_gain < 0.5;
                    break;
                }
            }
        }
    }
    if !settled {
        let score = pass.score();
        let structure = movable(&model, &score, observations);
        let promised = solve(&score.structure_information, &score.structure, &structure, LEAST_DAMPING);
        settled = promised.is_some_and(|(_, gain)| gain < NEARLY_SETTLED);
    }
    Some(Fitted { log_likelihood: pass.log_likelihood, score: pass.score(), pass, model, settled, integrated })
}

/// Numbers of the structural parameters that may move: not those on a bound that the gradient points beyond.
pub(super) fn movable(model: &VehicleModel, score: &Score, observations: &Observations) -> Vec<usize> {
    let stays = |parameter: Parameter| {
        let (low, high) = bounds(parameter, observations);
        let (value, slope) = (model.values[parameter as usize], score.structure[parameter as usize]);
        (value <= low && slope <= 0.0) || (value >= high && slope >= 0.0)
    };
    model.structure().filter(|parameter| !stays(*parameter)).map(|parameter| parameter as usize).collect()
}
