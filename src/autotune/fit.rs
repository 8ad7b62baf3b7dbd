//! Least squares over time constants and dead time, everything linear projected out, for readings whose errors are correlated.

use nalgebra::{DMatrix, DVector};

use super::response::Command;
use super::{Contradiction, Family, LEAST_EXPLAINED, ProcessError, ProcessModel, ProcessRecord, Ranged};
use crate::experiment::Record;

/// Starts: so many time constants, and so many dead times, on grids.
const TIME_CONSTANTS: u32 = 10;
const DEAD_TIMES: u32 = 12;
/// Starts that are followed.
const FOLLOWED: usize = 3;
/// Rounds of the search from one start.
const ROUNDS: u32 = 120;
/// The search ends where a step changes twice the log likelihood by less: a thirtieth of a standard deviation.
const SETTLED: f64 = 1e-3;
/// A record without errors has no such end: then a step this small, relative to the time scale, ends the search.
const FINEST: f64 = 1e-6;
/// Order of the autoregression of what is left: a load that wanders passes the process's lag and is smooth.
const ORDER: usize = 2;
/// Least eigenvalue of an information matrix of unit columns: below it stands rounding, and the readings tell nothing there.
const UNTOLD: f64 = 1e-12;
/// Readings of a run at an extreme, and the correlation of neighbouring residuals, from which on a sensor is at the end of its range.
const LEAST_RUN: usize = 3;
const HANGS_TOGETHER: f64 = 0.5;
/// Two-sided 95 % point of the normal distribution.
const NORMAL_95: f64 = 1.96;

/// Readings and command, with the weights of the errors' autoregression.
struct Problem {
    command: Command,
    output: Vec<f64>,
    /// First reading that counts: the command before the record is not known.
    first: usize,
    /// Coefficients of `e_k = a_1 e_(k-1) + ... + noise`.
    autoregression: Vec<f64>,
}

/// Values of the searched parameters: dead time first, then time constants.
type SearchPoint = Vec<f64>;

/// The projection at a point.
struct Projection {
    /// Sum of squares of the whitened residuals.
    square: f64,
    /// Coefficients of the answers to the command, then of load and initial state.
    linear: DVector<f64>,
    /// Whitened residuals.
    residual: DVector<f64>,
    /// Residuals as they are.
    plain: DVector<f64>,
}

impl Problem {
    /// Columns: answers to the command, then load, trend of an integrator, and modes of the initial state.
    fn columns(&self, family: Family, point: &[f64]) -> Vec<Vec<f64>> {
        let (command, delay_s) = (&self.command, point[0]);
        let time = command.time_s();
        let constant = || vec![1.0; time.len()];
        let mode = |lag_s: f64| time.iter().map(|t| (-t / lag_s).exp()).collect::<Vec<_>>();
        let late_mode = |lag_s: f64| time.iter().map(|t| t / lag_s * (-t / lag_s).exp()).collect::<Vec<_>>();
        match family {
            Family::FirstOrder => vec![command.lagged(delay_s, point[1]), constant(), mode(point[1])],
            Family::SecondOrder => {
                let (slow, fast) = (point[1], point[2]);
                let parts = [command.lagged(delay_s, slow), command.lagged(delay_s, fast)];
                // 1/((a s + 1)(b s + 1)) = (a/(a s + 1) - b/(b s + 1))/(a - b).
                let answer =
                    parts[0].iter().zip(&parts[1]).map(|(x, y)| (slow * x - fast * y) / (slow - fast)).collect();
                vec![answer, constant(), mode(slow), mode(fast)]
            }
            Family::SecondOrderZero => {
                let (slow, fast) = (point[1], point[2]);
                let parts = [command.lagged(delay_s, slow), command.lagged(delay_s, fast)];
                let [slow_part, fast_part] = parts;
                vec![slow_part, fast_part, constant(), mode(slow), mode(fast)]
            }
            Family::EqualLags => {
                vec![command.lagged_twice(delay_s, point[1]), constant(), mode(point[1]), late_mode(point[1])]
            }
            Family::Integrator => vec![command.integrated(delay_s), constant(), time.to_vec()],
            Family::IntegratorLag => {
                let parts = [command.integrated(delay_s), command.lagged(delay_s, point[1])];
                // 1/(s (a s + 1)) = 1/s - a/(a s + 1).
                let answer = parts[0].iter().zip(&parts[1]).map(|(x, y)| x - point[1] * y).collect();
                vec![answer, constant(), time.to_vec(), mode(point[1])]
            }
        }
    }

    /// What is left of a series after its prediction from the values before it.
    fn whitened(&self, series: &[f64]) -> Vec<f64> {
        (self.first..series.len())
            .map(|k| {
                let before = self.autoregression.iter().enumerate().map(|(lag, a)| a * series[k - lag - 1]);
                series[k] - before.sum::<f64>()
            })
            .collect()
    }

    fn projection(&self, family: Family, point: &[f64]) -> Option<Projection> {
        let columns = self.columns(family, point);
        let whitened: Vec<DVector<f64>> = columns.iter().map(|column| DVector::from(self.whitened(column))).collect();
        let design = DMatrix::from_columns(&whitened);
        let target = DVector::from(self.whitened(&self.output));
        // Columns of one size, so that the rank is judged fairly.
        let sizes: Vec<f64> = design.column_iter().map(|column| column.norm().max(f64::MIN_POSITIVE)).collect();
        let scaled = DMatrix::from_fn(design.nrows(), design.ncols(), |i, j| design[(i, j)] / sizes[j]);
        let found = scaled.clone().svd(true, true).solve(&target, 1e-10).ok()?;
        let residual = &target - scaled * &found;
        let linear = DVector::from_fn(found.len(), |j, _| found[j] / sizes[j]);
        let plain = DVector::from_fn(self.output.len() - self.first, |k, _| {
            let k = k + self.first;
            self.output[k] - columns.iter().zip(linear.iter()).map(|(column, a)| a * column[k]).sum::<f64>()
        });
        let square = residual.norm_squared();
        square.is_finite().then_some(Projection { square, linear, residual, plain })
    }

    /// The square at a point, where it is a process.
    fn square(&self, family: Family, point: &[f64]) -> f64 {
        let apart = family != Family::SecondOrder && family != Family::SecondOrderZero || point[2] < 0.9 * point[1];
        if point[0] < 0.0 || point[1..].iter().any(|time| !(*time > 0.0)) || !apart {
            return f64::INFINITY;
        }
        self.fast_square(family, point)
    }

    /// The same by normal equations, for the search.
    fn fast_square(&self, family: Family, point: &[f64]) -> f64 {
        let columns: Vec<Vec<f64>> = self.columns(family, point).iter().map(|column| self.whitened(column)).collect();
        let target = self.whitened(&self.output);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let count = columns.len();
        let sizes: Vec<f64> = columns.iter().map(|c| dot(c, c).sqrt().max(f64::MIN_POSITIVE)).collect();
        let normal = DMatrix::from_fn(count, count, |i, j| {
            let ridge = if i == j { 1.0 + 1e-12 } else { 0.0 };
            if i == j { ridge } else { dot(&columns[i], &columns[j]) / (sizes[i] * sizes[j]) }
        });
        let right = DVector::from_fn(count, |i, _| dot(&columns[i], &target) / sizes[i]);
        let Some(solved) = normal.cholesky().map(|factor| factor.solve(&right)) else { return f64::INFINITY };
        (dot(&target, &target) - right.dot(&solved)).max(0.0)
    }
}

/// Times within which a structure is searched.
#[derive(Clone, Copy)]
struct SearchScales {
    /// Time scale of the record: twice the mean time between changes.
    scale_s: f64,
    /// Longest dead time.
    longest_s: f64,
    /// The readings' rounding, output units.
    quantum: f64,
}

/// The best of these points.
fn few(problem: &Problem, family: Family, points: impl IntoIterator<Item = SearchPoint>) -> Vec<SearchPoint> {
    let mut few: Vec<(f64, SearchPoint)> =
        points.into_iter().map(|point| (problem.square(family, &point), point)).collect();
    few.sort_by(|a, b| a.0.total_cmp(&b.0));
    few.truncate(FOLLOWED);
    few.into_iter().map(|(_, point)| point).collect()
}

/// Points on a grid of dead times and, where the structure has one time constant, of that.
fn grid(family: Family, scales: SearchScales) -> Vec<SearchPoint> {
    let lags: Vec<f64> = (0..TIME_CONSTANTS)
        .map(|k| 0.02 * scales.scale_s * (500.0_f64).powf(f64::from(k) / f64::from(TIME_CONSTANTS - 1)))
        .collect();
    let delays = (0..DEAD_TIMES).map(|k| scales.longest_s * (f64::from(k) / f64::from(DEAD_TIMES - 1)).powi(2));
    delays
        .flat_map(|delay| match family {
            Family::Integrator => vec![vec![delay]],
            _ => lags.iter().map(|lag| vec![delay, *lag]).collect(),
        })
        .collect()
}

/// Points with a second time constant about a point without it; the second lag stands for part of the dead time, or not.
fn with_second(point: &[f64]) -> impl Iterator<Item = SearchPoint> {
    let (delay, lag) = (point[0], point[1]);
    [0.05, 0.2, 0.6].into_iter().flat_map(move |share| {
        let less = (delay - share * lag).max(0.0);
        [vec![delay, lag, share * lag], vec![less, lag, share * lag], vec![delay, lag / share, lag]]
    })
}

/// A pattern search from one start, which steps over the kinks where a delayed switching meets a reading.
fn descent(problem: &Problem, family: Family, start: SearchPoint, scales: SearchScales) -> (f64, SearchPoint) {
    let interval_s = scales.scale_s / 400.0;
    let count = (problem.output.len() - problem.first) as f64;
    let (mut square, mut point) = (problem.square(family, &start), start);
    // Steps of the dead time in s, of the time constants relative.
    let mut step: Vec<f64> = (0..point.len()).map(|k| if k == 0 { scales.longest_s / 10.0 } else { 0.5 }).collect();
    let finest = |k: usize| FINEST * if k == 0 { interval_s } else { 1.0 };
    for _ in 0..ROUNDS {
        let mut settled = true;
        for k in 0..point.len() {
            let moved = |sign: f64| {
                let mut other = point.clone();
                if k == 0 {
                    other[0] = (other[0] + sign * step[0]).max(0.0)
                } else {
                    other[k] *= (sign * step[k]).exp()
                }
                // Dead time and time constants stand for each other: what one gains the other loses.
                let turned = (k > 0).then(|| {
                    let mut turned = other.clone();
                    turned[0] = (turned[0] - (other[k] - point[k])).max(0.0);
                    turned
                });
                core::iter::once(other).chain(turned)
            };
            let around: Vec<(f64, SearchPoint)> =
                [1.0, -1.0].into_iter().flat_map(moved).map(|other| (problem.square(family, &other), other)).collect();
            let worst = around.iter().map(|(other, _)| *other).fold(square, f64::max);
            let better = around.into_iter().filter(|(other, _)| *other < square).min_by(|a, b| a.0.total_cmp(&b.0));
            // Twice the log likelihood falls by (square - least)/variance; rounding bounds the variance from below.
            let variance = (square / count).max(scales.quantum * scales.quantum / 12.0);
            match better {
                Some(found) => {
                    // A narrow valley is followed in many small gains.
                    settled = false;
                    (square, point) = found;
                    step[k] *= 1.5;
                }
                None => {
                    settled &= worst - square < SETTLED * variance || step[k] <= finest(k);
                    step[k] *= 0.4;
                }
            }
        }
        if settled {
            break;
        }
    }
    (square, point)
}

/// Ends of the searches, structure by structure, the best first.
#[derive(Default)]
struct Searches(Vec<(Family, Vec<SearchPoint>)>);

impl Searches {
    fn ends(&self, family: Family) -> impl Iterator<Item = &SearchPoint> {
        self.0.iter().filter(move |found| found.0 == family).flat_map(|found| &found.1)
    }

    /// The searches of these structures on this problem, from a grid and from the ends of the pass before.
    fn pass(&self, problem: &Problem, families: &[Family], scales: SearchScales) -> Self {
        let mut found = Self::default();
        for &family in families {
            let before = self.ends(family).cloned();
            // Structures nest: those with two different time constants begin about the ends of those with one.
            let starts = if matches!(family, Family::SecondOrder | Family::SecondOrderZero) {
                let one = [Family::FirstOrder, Family::EqualLags].into_iter().flat_map(|one| found.ends(one));
                few(problem, family, one.flat_map(|end| with_second(end)).chain(before))
            } else {
                few(problem, family, grid(family, scales).into_iter().chain(before))
            };
            let mut ends: Vec<(f64, SearchPoint)> =
                starts.into_iter().map(|start| descent(problem, family, start, scales)).collect();
            ends.sort_by(|a, b| a.0.total_cmp(&b.0));
            found.0.push((family, ends.into_iter().map(|(_, point)| point).collect()));
        }
        found
    }

    /// Each structure with its best point.
    fn best(&self) -> impl Iterator<Item = (Family, &SearchPoint)> {
        self.0.iter().filter_map(|(family, ends)| Some((*family, ends.first()?)))
    }
}

/// Structures with one time constant at most, and then those that begin at their ends.
const ONE: [Family; 4] = [Family::FirstOrder, Family::EqualLags, Family::Integrator, Family::IntegratorLag];
const TWO: [Family; 2] = [Family::SecondOrder, Family::SecondOrderZero];

/// Gain, dead time and time constants of a structure, and the coefficients of its equation of motion.
fn meaning(family: Family, point: &[f64], linear: &[f64]) -> (Vec<f64>, [f64; 5]) {
    let (delay_s, lag) = (point[0], |k: usize| point.get(k).copied().unwrap_or(0.0));
    match family {
        Family::SecondOrderZero => {
            let gain = linear[0] + linear[1];
            // gain (zero s + 1) = c_1 (T_2 s + 1) + c_2 (T_1 s + 1).
            let zero_s = (linear[0] * lag(2) + linear[1] * lag(1)) / gain;
            let body = [lag(1) * lag(2), lag(1) + lag(2), 1.0].map(|part| part / gain.abs());
            (vec![gain, delay_s, lag(1), lag(2), zero_s], [body[0], body[1], body[2], zero_s, delay_s])
        }
        _ => {
            let gain = linear[0];
            let body = match family {
                Family::FirstOrder => [0.0, lag(1), 1.0],
                Family::EqualLags => [lag(1) * lag(1), 2.0 * lag(1), 1.0],
                Family::Integrator => [0.0, 1.0, 0.0],
                Family::IntegratorLag => [lag(1), 1.0, 0.0],
                Family::SecondOrder | Family::SecondOrderZero => [lag(1) * lag(2), lag(1) + lag(2), 1.0],
            };
            let body = body.map(|part| part / gain.abs());
            let parameters = [gain, delay_s].into_iter().chain(point[1..].iter().copied()).collect();
            (parameters, [body[0], body[1], body[2], 0.0, delay_s])
        }
    }
}

/// What a record says of one structure: model without weight, and what is left.
struct StructureFit {
    family: Family,
    criterion: f64,
    /// Minus twice the largest log likelihood, up to a constant of the record.
    misfit: f64,
    model: ProcessModel,
    plain: DVector<f64>,
}

fn fitted(problem: &Problem, family: Family, point: &[f64], interval_s: f64, quantum: f64) -> Option<StructureFit> {
    let found = problem.projection(family, point)?;
    let (count, searched) = (found.residual.len() as f64, point.len());
    let free = searched + found.linear.len();
    // Rounding leaves an error even where the residual shows none.
    let least = quantum * quantum / 12.0;
    let variance = (found.square / (count - free as f64).max(1.0)).max(least);
    let misfit = count * (found.square / count).max(least).max(f64::MIN_POSITIVE).ln();
    let criterion = count * (variance).ln() + free as f64 * count.ln();
    // Sensitivities of the readings to all parameters: differences over half an interval bridge the kinks.
    let columns = problem.columns(family, point);
    let answer = |point: &[f64], linear: &[f64]| -> DVector<f64> {
        let columns = problem.columns(family, point);
        let sum: Vec<f64> = (0..problem.output.len())
            .map(|k| columns.iter().zip(linear).map(|(column, a)| a * column[k]).sum())
            .collect();
        DVector::from(problem.whitened(&sum))
    };
    let linear: Vec<f64> = found.linear.iter().copied().collect();
    let mut sensitivities: Vec<DVector<f64>> = Vec::new();
    let steps: Vec<f64> = (0..searched)
        .map(|k| if k == 0 { 0.5 * interval_s.min(point[0].max(interval_s)) } else { 1e-3 * point[k] })
        .collect();
    for k in 0..searched {
        let shifted = |sign: f64| {
            let mut other = point.to_vec();
            other[k] = (other[k] + sign * steps[k]).max(0.0);
            other
        };
        let (up, down) = (shifted(1.0), shifted(-1.0));
        let width = up[k] - down[k];
        sensitivities.push((answer(&up, &linear) - answer(&down, &linear)) / width);
    }
    sensitivities.extend(columns.iter().map(|column| DVector::from(problem.whitened(column))));
    let design = DMatrix::from_columns(&sensitivities);
    let sizes: Vec<f64> = design.column_iter().map(|column| column.norm().max(f64::MIN_POSITIVE)).collect();
    let scaled = DMatrix::from_fn(design.nrows(), design.ncols(), |i, j| design[(i, j)] / sizes[j]);
    let information = scaled.transpose() * &scaled;
    // A direction that the readings do not tell has a wide error, as no pseudo-inverse gives it.
    let eigen = information.symmetric_eigen();
    let inverse = DMatrix::from_diagonal(&eigen.eigenvalues.map(|value| value.max(UNTOLD).recip()));
    let inverse = &eigen.eigenvectors * inverse * eigen.eigenvectors.transpose();
    let covariance = DMatrix::from_fn(free, free, |i, j| variance * inverse[(i, j)] / (sizes[i] * sizes[j]));
    // Both meanings are functions of all parameters: errors by their derivatives.
    let all: Vec<f64> = point.iter().chain(&linear).copied().collect();
    let meaning_of = |all: &[f64]| {
        let (parameters, coefficients) = meaning(family, &all[..searched], &all[searched..]);
        parameters.into_iter().chain(coefficients).collect::<Vec<f64>>()
    };
    let values = meaning_of(&all);
    let mut slopes = DMatrix::zeros(values.len(), free);
    for k in 0..free {
        let step = 1e-6 * all[k].abs().max(1e-9);
        let mut other = all.clone();
        other[k] += step;
        for (row, (moved, value)) in meaning_of(&other).iter().zip(&values).enumerate() {
            slopes[(row, k)] = (moved - value) / step;
        }
    }
    let spread = &slopes * covariance * slopes.transpose();
    let ranged = |k: usize| {
        let (value, std) = (values[k], spread[(k, k)].max(0.0).sqrt());
        Ranged { value, std, low: value - NORMAL_95 * std, high: value + NORMAL_95 * std }
    };
    let named = family.parameters().len();
    let model = ProcessModel {
        family,
        weight: 0.0,
        parameters: (0..named).map(ranged).collect(),
        coefficients: core::array::from_fn(|k| ranged(named + k)),
    };
    let finite = values.iter().chain(spread.iter()).all(|value| value.is_finite());
    finite.then_some(StructureFit { family, criterion, misfit, model, plain: found.plain })
}

/// Without structures that fit no better than a limit of theirs: their lag is at its bound, and they are that limit.
fn distinct(mut fits: Vec<StructureFit>) -> Vec<StructureFit> {
    let misfits: Vec<(Family, f64)> = fits.iter().map(|fit| (fit.family, fit.misfit)).collect();
    fits.retain(|fit| {
        let limits = misfits.iter().filter(|(family, _)| fit.family.limits().contains(family));
        limits.fold(f64::INFINITY, |least, limit| least.min(limit.1)) - fit.misfit > SETTLED
    });
    fits
}

/// Coefficients of an autoregression by least squares (the covariance method); none where the errors are as good as white.
fn autoregression(errors: &DVector<f64>) -> Vec<f64> {
    let count = errors.len() - ORDER;
    let design = DMatrix::from_fn(count, ORDER, |i, j| errors[i + ORDER - 1 - j]);
    let target = DVector::from_fn(count, |i, _| errors[i + ORDER]);
    let normal = design.transpose() * &design;
    let Some(found) = normal.cholesky().map(|factor| factor.solve(&(design.transpose() * &target))) else {
        return vec![];
    };
    let left = (&target - design * &found).norm_squared() / target.norm_squared().max(f64::MIN_POSITIVE);
    // The Bayesian criterion for two coefficients.
    if count as f64 * left.ln() + ORDER as f64 * (count as f64).ln() < 0.0 {
        found.iter().copied().collect()
    } else {
        vec![]
    }
}

/// Whether the output moves before the changes of the command as it does for a process of the other sign. Under a relay the command rises
/// while the output of a process of positive gain falls; a dead time that is longer by half a period looks like the other sign.
fn against_relay(record: &Record, reverse: bool, residual: f64, half_s: f64) -> bool {
    // Over an eighth of the time between changes.
    let before = ((half_s / 8.0 / record.interval_s()).round() as usize).max(1);
    let (output, input) = (record.output(), record.input());
    let moves = (before..output.len())
        .filter(|&k| input[k] != input[k - 1])
        .map(|k| (input[k] - input[k - 1]).signum() * (output[k] - output[k - before]));
    let (sum, count) = moves.fold((0.0, 0.0), |(sum, count), moved| (sum + moved, count + 1.0_f64));
    let falling = if reverse { -sum } else { sum };
    // Two errors in each difference.
    falling > NORMAL_95 * residual * (2.0 * count).sqrt()
}

/// Whether the output stands at an extreme, in two runs of readings or more, for longer than twice the time that a sinusoid read in steps of
/// `quantum` does, while residuals hang together. A sinusoid of swing `A` is within a step `q` of its end for `acos(1 - 2 q/A)/pi` of
/// the time; an output that settles there has a model, and residuals that do not hang together.
fn saturated(output: &[f64], quantum: f64, correlation: f64) -> bool {
    let ends = output.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(*y), high.max(*y)]);
    let expected = (1.0 - 2.0 * quantum / (ends[1] - ends[0])).clamp(-1.0, 1.0).acos() / core::f64::consts::PI;
    let stands = |end: f64| {
        let runs = output.chunk_by(|a, b| (*a == end) == (*b == end));
        let runs = runs.filter(|run| run[0] == end && run.len() >= LEAST_RUN).map(<[f64]>::len);
        let (count, length) = runs.fold((0, 0), |(count, length), run| (count + 1, length + run));
        count >= 2 && length as f64 > 2.0 * expected * output.len() as f64
    };
    correlation > HANGS_TOGETHER && ends.into_iter().any(stands)
}

pub(super) fn fit(record: &Record) -> Result<ProcessRecord, ProcessError> {
    let command = Command::of(record);
    let samples = record.samples();
    if samples < ProcessError::LEAST_SAMPLES {
        return Err(ProcessError::FewSamples { samples });
    }
    let changes: Vec<f64> = command.changes_s().collect();
    if changes.len() < ProcessError::LEAST_CHANGES {
        return Err(ProcessError::FewChanges { changes: changes.len() });
    }
    let duration_s = command.time_s()[samples - 1];
    let (interval_s, quantum) = (record.interval_s(), record.quantum().unwrap_or(0.0));
    // Mean time between changes: dead times beyond it are those of another change.
    let half_s = (changes[changes.len() - 1] - changes[0]) / (changes.len() - 1) as f64;
    let scale_s = 2.0 * half_s;
    let mut problem = Problem { command, output: record.output().to_vec(), first: ORDER, autoregression: vec![] };
    let longest_s = half_s.min(duration_s / 3.0);
    // The command before the record acts up to the dead time, of whichever structure: readings so early do not count. Those that
    // do count may show a longer dead time.
    let scales = SearchScales { scale_s, longest_s, quantum };
    let mut searches = Searches::default();
    loop {
        searches = searches.pass(&problem, &ONE, scales);
        let dead_s = searches.best().map(|(_, point)| point[0]).fold(0.0, f64::max);
        let skip_s = (1.2 * dead_s + interval_s).min(duration_s / 3.0);
        let first = problem.command.time_s().iter().position(|time| *time > skip_s).unwrap_or(0);
        if first <= problem.first {
            break;
        }
        problem.first = first;
    }
    let mut fits = |problem: &Problem| {
        searches = searches.pass(problem, &[ONE.as_slice(), &TWO].concat(), scales);
        let mut fits: Vec<StructureFit> =
            searches.best().filter_map(|(family, point)| fitted(problem, family, point, interval_s, quantum)).collect();
        fits.sort_by(|a, b| a.criterion.total_cmp(&b.criterion));
        distinct(fits)
    };
    let mut found = fits(&problem);
    let mean = problem.output[problem.first..].iter().sum::<f64>() / (samples - problem.first) as f64;
    let variation: f64 = problem.output[problem.first..].iter().map(|y| (y - mean).powi(2)).sum();
    let no_answer = |left: f64| ProcessError::NoAnswer { left: left.min(1.0) };
    // Errors that are correlated leave slow parts free: also then the output itself is explained.
    let explaining = |mut found: Vec<StructureFit>| {
        let left = |fit: &StructureFit| fit.plain.norm_squared() / variation.max(f64::MIN_POSITIVE);
        let least = found.iter().map(left).fold(f64::INFINITY, f64::min);
        found.retain(|fit| left(fit) < 1.0 - LEAST_EXPLAINED);
        if found.is_empty() { Err(no_answer(least)) } else { Ok(found) }
    };
    found = explaining(found)?;
    let best = found.first().ok_or(no_answer(1.0))?;
    let neighbours = |errors: &DVector<f64>| {
        let products: f64 = (1..errors.len()).map(|k| errors[k] * errors[k - 1]).sum();
        products / errors.norm_squared().max(f64::MIN_POSITIVE)
    };
    let correlation = neighbours(&best.plain);
    problem.autoregression = autoregression(&best.plain);
    if !problem.autoregression.is_empty() {
        found = explaining(fits(&problem))?;
    }
    let residuals: Vec<f64> = found.first().map_or_else(Vec::new, |best| best.plain.iter().copied().collect());
    let residual = (residuals.iter().map(|part| part * part).sum::<f64>() / residuals.len().max(1) as f64).sqrt();
    let least = found.first().map_or(0.0, |best| best.criterion);
    let total: f64 = found.iter().map(|fit| (-0.5 * (fit.criterion - least)).exp()).sum();
    let reverse = found.first().is_some_and(|best| best.model.parameters[0].value < 0.0);
    let models = found
        .into_iter()
        .map(|fit| ProcessModel {
            weight: (-0.5 * (fit.criterion - least)).exp() / total,
            family: fit.family,
            ..fit.model
        })
        .filter(|model| model.weight >= ProcessRecord::LEAST_WEIGHT && (model.parameters[0].value < 0.0) == reverse)
        .collect();
    let changes = changes.len();
    let contradiction = if against_relay(record, reverse, residual, half_s) {
        Some(Contradiction::AgainstRelay)
    } else {
        saturated(record.output(), quantum, correlation).then_some(Contradiction::Saturated)
    };
    Ok(ProcessRecord {
        models,
        reverse,
        contradiction,
        residual,
        residuals,
        correlation,
        samples: samples - problem.first,
        changes,
    })
}
