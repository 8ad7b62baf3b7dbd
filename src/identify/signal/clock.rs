//! The clock of the samples.

use crate::experiment::Record;

/// Which clock the samples have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Clock {
    /// The stamps of the log.
    Stamps,
    /// A regular grid through these stamps.
    Grid,
}

/// Part of each deviation by which the phase of a grid follows the stamps.
const PHASE_SHARE: f64 = 0.1;
/// Deviations, in steps, below which the stamps are on a grid, and above which they are on none: uniform ones have 0.289.
const ON_GRID: f64 = 1e-3;
const OFF_GRID: f64 = 0.28;

/// Times of a regular grid through the stamps; `None` if they are regular already, or fit no grid.
pub(crate) fn grid(record: &Record) -> Option<Vec<f64>> {
    let (time, interval) = (record.time_s(), record.interval_s());
    let fit = |numbers: &[f64]| {
        let count = time.len() as f64;
        let (mean_n, mean_t) = (numbers.iter().sum::<f64>() / count, time.iter().sum::<f64>() / count);
        let (mut nn, mut nt) = (0.0, 0.0);
        for (n, t) in numbers.iter().zip(time) {
            nn += (n - mean_n).powi(2);
            nt += (n - mean_n) * (t - mean_t);
        }
        let step = nt / nn;
        (mean_t - step * mean_n, step)
    };
    // The grid's phase follows the stamps slowly, so that a single late stamp does not count as two steps.
    let (mut phase, mut number) = (time[0], 0.0);
    let mut numbers = vec![0.0];
    for t in &time[1..] {
        number = ((t - phase) / interval).round().max(number + 1.0);
        phase += PHASE_SHARE * (t - phase - number * interval);
        numbers.push(number);
    }
    let (mut begin, mut step) = fit(&numbers);
    for _ in 0..3 {
        let again: Vec<f64> = time.iter().map(|t| ((t - begin) / step).round()).collect();
        if again.windows(2).any(|pair| pair[1] <= pair[0]) {
            return None;
        }
        numbers = again;
        (begin, step) = fit(&numbers);
    }
    let grid: Vec<f64> = numbers.iter().map(|n| begin + step * n).collect();
    let square: f64 = grid.iter().zip(time).map(|(g, t)| (g - t).powi(2)).sum();
    let rms = (square / time.len() as f64).sqrt();
    (rms > ON_GRID * step && rms < OFF_GRID * step).then_some(grid)
}
