//! From a record to the processes that it leaves: search, weights, contradictions.

use nalgebra::DVector;

use super::projection::{ProjectionProblem, autoregression};
use super::response::HeldCommand;
use super::search::{CONSTANT, FOLLOWED, ONE, SearchScales, Searches, TWO, WANDERING};
use super::structure_fit::{StructureFit, distinct, fitted};
use super::{Contradiction, LEAST_EXPLAINED, ProcessError, ProcessModel, ProcessRecord};
use crate::experiment::Record;
use crate::identify::NORMAL_95;

/// Readings of a run at an extreme, and the correlation of neighbouring residuals, from which on a sensor is at the end of its range.
const LEAST_RUN: usize = 3;
const HANGS_TOGETHER: f64 = 0.5;

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

/// Whether a sensor is at the end of its range: the output stands at an extreme in two runs of readings or more, and residuals hang
/// together. The runs are longer than twice the time that a sinusoid, read in steps of `quantum`, stands there. A sinusoid of swing `A` is within a step `q` of its end for `acos(1 - 2 q/A)/pi` of
/// the time; an output that settles there has a model, and residuals that do not hang together.
fn saturated(output: &[f64], quantum: f64, correlation: f64) -> bool {
    let ends = output.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(*y), high.max(*y)]);
    let expected = libm::acos((1.0 - 2.0 * quantum / (ends[1] - ends[0])).clamp(-1.0, 1.0)) / core::f64::consts::PI;
    let stands = |end: f64| {
        let runs = output.chunk_by(|a, b| (*a == end) == (*b == end));
        let runs = runs.filter(|run| run[0] == end && run.len() >= LEAST_RUN).map(<[f64]>::len);
        let (count, length) = runs.fold((0, 0), |(count, length), run| (count + 1, length + run));
        count >= 2 && length as f64 > 2.0 * expected * output.len() as f64
    };
    correlation > HANGS_TOGETHER && ends.into_iter().any(stands)
}

pub(super) fn fit(record: &Record) -> Result<ProcessRecord, ProcessError> {
    let command = HeldCommand::of(record);
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
    let longest_s = half_s.min(duration_s / 3.0);
    // The command before the record acts up to the dead time, of whichever structure: readings so early do not count. Those that
    // do count may show a longer dead time.
    let begun = |scales: SearchScales| {
        let (command, output, rounding) = (command.clone(), record.output().to_vec(), quantum * quantum / 12.0);
        let mut problem = ProjectionProblem { command, output, first: 0, autoregression: vec![], rounding };
        let mut searches = Searches::default();
        loop {
            searches = searches.pass(&problem, &ONE, scales);
            let dead_s = searches.best().map(|(_, point)| point.times_s[0]).fold(0.0, f64::max);
            let skip_s = (1.2 * dead_s + interval_s).min(duration_s / 3.0);
            let first = problem.command.time_s().iter().position(|time| *time > skip_s).unwrap_or(0);
            if first <= problem.first {
                return (problem, searches);
            }
            problem.first = first;
        }
    };
    let explaining = |problem: &ProjectionProblem, before: &Searches, scales: SearchScales| {
        let scales = SearchScales { followed: FOLLOWED, ..scales };
        let searches = before.pass(problem, &[ONE.as_slice(), &TWO].concat(), scales);
        let fits = searches.best().filter_map(|(family, point)| fitted(problem, family, point, interval_s));
        let mut found = distinct(fits.collect());
        found.sort_by(|a, b| a.criterion.total_cmp(&b.criterion));
        let mean = problem.output[problem.first..].iter().sum::<f64>() / (samples - problem.first) as f64;
        let variation: f64 = problem.output[problem.first..].iter().map(|y| (y - mean).powi(2)).sum();
        // The command explains the output under a constant load, or the innovations where the load wanders.
        let left = |fit: &StructureFit| fit.left.min(fit.plain.norm_squared() / variation.max(f64::MIN_POSITIVE));
        let least = found.iter().map(left).fold(f64::INFINITY, f64::min);
        found.retain(|fit| left(fit) < 1.0 - LEAST_EXPLAINED);
        if found.is_empty() { Err(ProcessError::NoAnswer { left: least.min(1.0) }) } else { Ok((found, problem.first)) }
    };
    let wandering = SearchScales { scale_s, longest_s, followed: 1, walks: WANDERING };
    let (problem, searches) = begun(wandering);
    let (found, first) = explaining(&problem, &searches, wandering).or_else(|_| {
        // Errors that no load makes, such as coarse steps of a slow output, leave all to a load that wanders: about a constant load they
        // are an autoregression.
        let constant = SearchScales { walks: CONSTANT, ..wandering };
        let (mut problem, searches) = begun(constant);
        let (white, _) = explaining(&problem, &searches, constant)?;
        problem.autoregression = autoregression(&white[0].plain);
        explaining(&problem, &searches, constant)
    })?;
    let neighbours = |errors: &DVector<f64>| {
        let products: f64 = (1..errors.len()).map(|k| errors[k] * errors[k - 1]).sum();
        products / errors.norm_squared().max(f64::MIN_POSITIVE)
    };
    let best = &found[0];
    let correlation = neighbours(&best.plain);
    let root_mean_square =
        |parts: &[f64]| (parts.iter().map(|part| part * part).sum::<f64>() / parts.len() as f64).sqrt();
    let (spread, residuals) = (root_mean_square(best.plain.as_slice()), best.innovations.clone());
    let residual = root_mean_square(&residuals);
    let least = best.criterion;
    let total: f64 = found.iter().map(|fit| libm::exp(-0.5 * (fit.criterion - least))).sum();
    let reverse = best.model.parameters[0].value < 0.0;
    let models = found
        .into_iter()
        .map(|fit| ProcessModel {
            weight: libm::exp(-0.5 * (fit.criterion - least)) / total,
            family: fit.family,
            ..fit.model
        })
        .filter(|model| model.weight >= ProcessRecord::LEAST_WEIGHT && (model.parameters[0].value < 0.0) == reverse)
        .collect();
    let changes = changes.len();
    let contradiction = if against_relay(record, reverse, spread, half_s) {
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
        samples: samples - first,
        changes,
    })
}
