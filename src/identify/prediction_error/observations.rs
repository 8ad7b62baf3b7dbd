//! The record as the filter reads it: clock, command in pieces, instants of switching, weights of repeated half cycles.

use super::actuator::Piece;
use super::model::{Clock, Switching};
use super::repeats;
use crate::experiment::Record;

/// A change of the command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Kick {
    /// Mean of the instants that the log leaves possible.
    pub(super) at_s: f64,
    pub(super) jump: f64,
    /// Their variance.
    pub(super) variance_s2: f64,
    /// The last sample before the gap that the command changed in, or the sample before.
    pub(super) begin_s: f64,
    /// Number of instants of a gap's missing samples at which it may have changed; one where none is missing.
    pub(super) choices: usize,
    /// Time between them.
    pub(super) step_s: f64,
    switching: Switching,
}

impl Kick {
    /// In a gap the command may have changed at any instant of the grid.
    fn new(begin_s: f64, end_s: f64, jump: f64, interval_s: f64, switching: Switching) -> Self {
        let window = end_s - begin_s;
        let instants = (window / interval_s).round().max(1.0);
        let step = window / instants;
        let (at_s, variance_s2) = match switching {
            Switching::AtSamples => {
                (end_s - 0.5 * (instants - 1.0) * step, step * step * (instants * instants - 1.0) / 12.0)
            }
            Switching::Between => (end_s - 0.5 * window, window * window / 12.0),
        };
        let missing = window > MISSING * interval_s && instants <= MOST_CHOICES as f64;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
        let choices = if missing { instants as usize } else { 1 };
        Self { at_s, jump, variance_s2, begin_s, choices, step_s: step, switching }
    }

    /// Mean and variance of one of the instants.
    fn choice(&self, choice: usize) -> (f64, f64) {
        let end = self.begin_s + (choice + 1) as f64 * self.step_s;
        match self.switching {
            Switching::AtSamples => (end, 0.0),
            Switching::Between => (end - 0.5 * self.step_s, self.step_s * self.step_s / 12.0),
        }
    }
}

/// A record under one reading of its clock and its switchings.
#[derive(Clone, Debug)]
pub(super) struct Observations {
    pub(super) time_s: Vec<f64>,
    pub(super) output: Vec<f64>,
    /// Step to which readings are rounded.
    pub(super) step: Option<f64>,
    /// What each reading counts.
    pub(super) weight: Vec<f64>,
    pub(super) pieces: Vec<Piece>,
    pub(super) kicks: Vec<Kick>,
    /// Whether the command takes few values.
    pub(super) switched: bool,
    /// First sample that the filter sees: before it acts a command that is not in the record.
    pub(super) first: usize,
    /// Readings left out, of weight zero.
    pub(super) outliers: usize,
    /// Largest less least command.
    pub(super) range: f64,
    /// Largest less least output.
    pub(super) span: f64,
    /// Highest speed.
    pub(super) fastest: f64,
    pub(super) interval_s: f64,
    /// Time between crossings of the mean.
    pub(super) swing_s: f64,
}

/// Twice the log-likelihood that each parameter has to be worth where readings are many.
pub(super) const PRICE: f64 = 4.0;
/// Sampling intervals between two samples from which on one is missing.
const MISSING: f64 = 1.75;
/// The most instants that a switching in a gap is looked for at.
const MOST_CHOICES: usize = 24;
/// The most distinct values that a switched command has.
const MOST_LEVELS: usize = 4;

impl Observations {
    pub(super) fn new(record: &Record, clock: Clock, switching: Switching) -> Self {
        let time_s = match clock {
            Clock::Grid => grid(record).unwrap_or_else(|| record.time_s().to_vec()),
            Clock::Stamps => record.time_s().to_vec(),
        };
        let (output, input) = (record.output().to_vec(), record.input());
        let switched = switched(input);
        let interval_s = record.interval_s();
        let (pieces, kicks) = if switched {
            switchings(&time_s, input, interval_s, switching)
        } else {
            (moved(&time_s, input, switching), Vec::new())
        };
        let swing_s = swing_s(record);
        let extent = |values: &[f64]| {
            let (low, high) = ends(values);
            high - low
        };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
        let reach = (swing_s / (6.0 * interval_s)).max(1.0) as usize;
        let speed = |k: usize| ((output[k + reach] - output[k]) / (time_s[k + reach] - time_s[k])).abs();
        let fastest = (0..output.len().saturating_sub(reach)).map(speed).fold(0.0, f64::max);
        let (range, span) = (extent(input), extent(&output));
        let step = record.quantum();
        let mut weight = match step {
            Some(step) if switched => repeats::weights(&output, input, step),
            _ => vec![1.0; output.len()],
        };
        let outliers = outliers(record);
        outliers.iter().for_each(|sample| weight[*sample] = 0.0);
        Self {
            time_s,
            output,
            step,
            weight,
            pieces,
            kicks,
            switched,
            first: 0,
            outliers: outliers.len(),
            range,
            span,
            fastest,
            interval_s,
            swing_s,
        }
    }

    pub(super) fn duration_s(&self) -> f64 {
        self.time_s[self.time_s.len() - 1] - self.time_s[0]
    }

    /// Leaves out the readings of the first `unseen_s`.
    pub(super) fn skip(&mut self, unseen_s: f64) {
        let from = self.time_s[0] + unseen_s;
        self.first = self.time_s.partition_point(|time_s| *time_s < from).min(self.time_s.len() / 2);
    }

    /// Puts a switching at the mean of its instants.
    fn place(&mut self, kick: usize, at_s: f64, variance_s2: f64) {
        // The first piece begins with the record, each other one with a switching.
        self.pieces[kick + 1].begin_s = at_s;
        let kick = &mut self.kicks[kick];
        (kick.at_s, kick.variance_s2) = (at_s, variance_s2);
    }

    /// Places a switching of a gap at one of its instants.
    pub(super) fn choose(&mut self, kick: usize, choice: usize) {
        let (at_s, variance_s2) = self.kicks[kick].choice(choice);
        self.place(kick, at_s, variance_s2);
    }

    /// Places it at the mean of its instants by their shares.
    pub(super) fn weigh(&mut self, kick: usize, shares: &[f64]) {
        let instants: Vec<(f64, f64)> = (0..shares.len()).map(|choice| self.kicks[kick].choice(choice)).collect();
        let mean: f64 = shares.iter().zip(&instants).map(|(share, (at_s, _))| share * at_s).sum();
        let variance = shares.iter().zip(&instants).map(|(share, (at_s, own))| share * (own + (at_s - mean).powi(2)));
        self.place(kick, mean, variance.sum());
    }

    /// Leaves its instant open.
    pub(super) fn open(&mut self, kick: usize) {
        let choices = self.kicks[kick].choices;
        self.weigh(kick, &vec![1.0 / choices as f64; choices]);
    }

    /// What all readings that the filter sees count together.
    pub(super) fn count(&self) -> f64 {
        self.weight[self.first..].iter().sum()
    }

    /// Twice the log-likelihood that so many parameters have to be worth: few readings count more against them (Hurvich and Tsai,
    /// *Biometrika* 76, 1989).
    pub(super) fn price(&self, parameters: usize) -> f64 {
        let (count, parameters) = (self.count(), parameters as f64);
        PRICE * parameters * count / (count - parameters - 1.0).max(1.0)
    }
}

/// The least and the largest.
pub(super) fn ends(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)))
}

/// Whether a command is switched between few values rather than moved.
pub(super) fn switched(input: &[f64]) -> bool {
    let mut levels: Vec<f64> = Vec::new();
    for &value in input {
        if !levels.contains(&value) {
            levels.push(value);
        }
        if levels.len() > MOST_LEVELS {
            return false;
        }
    }
    true
}

/// Times of a regular grid through the stamps; `None` where they are on one already, or on none.
pub(super) fn grid(record: &Record) -> Option<Vec<f64>> {
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
    // The grid's phase follows the stamps slowly, so that one late stamp does not count as two steps.
    let (mut phase, mut number) = (time[0], 0.0);
    let mut numbers = vec![0.0];
    for t in &time[1..] {
        number = ((t - phase) / interval).round().max(number + 1.0);
        phase += 0.1 * (t - phase - number * interval);
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
    (rms > 1e-3 * step && rms < 0.28 * step).then_some(grid)
}

/// Constant pieces of a switched command, and its changes.
fn switchings(time_s: &[f64], input: &[f64], interval_s: f64, switching: Switching) -> (Vec<Piece>, Vec<Kick>) {
    let mut pieces = vec![Piece { begin_s: time_s[0], value: input[0], slope: 0.0 }];
    let mut kicks = Vec::new();
    for after in 1..input.len() {
        let jump = input[after] - input[after - 1];
        if jump == 0.0 {
            continue;
        }
        let kick = Kick::new(time_s[after - 1], time_s[after], jump, interval_s, switching);
        pieces.push(Piece { begin_s: kick.at_s, value: input[after], slope: 0.0 });
        kicks.push(kick);
    }
    (pieces, kicks)
}

/// Pieces of a command that moves: held from sample to sample, or on straight lines between them with a corner where the lines
/// before and after an interval meet within it.
fn moved(time_s: &[f64], input: &[f64], switching: Switching) -> Vec<Piece> {
    let last = input.len() - 1;
    let slope = |k: usize| (input[k + 1] - input[k]) / (time_s[k + 1] - time_s[k]);
    let mut pieces = Vec::with_capacity(2 * input.len());
    for k in 0..=last {
        let (begin_s, value) = (time_s[k], input[k]);
        if switching == Switching::AtSamples || k == last {
            pieces.push(Piece { begin_s, value, slope: 0.0 });
            continue;
        }
        let interval = time_s[k + 1] - begin_s;
        let corner = (k > 0 && k + 1 < last).then(|| {
            let (before, after) = (slope(k - 1), slope(k + 1));
            (before, after, (input[k + 1] - value - after * interval) / (before - after))
        });
        match corner {
            Some((before, after, at)) if at > 1e-3 * interval && at < 0.999 * interval => {
                pieces.push(Piece { begin_s, value, slope: before });
                pieces.push(Piece { begin_s: begin_s + at, value: value + before * at, slope: after });
            }
            _ => pieces.push(Piece { begin_s, value, slope: slope(k) }),
        }
    }
    pieces
}

/// Readings further from the line through their neighbours than this many robust standard deviations are left out.
const FAR: f64 = 6.0;
/// A record with a larger share of them has no outliers but another noise.
const MOST_OUTLIERS: f64 = 0.1;

/// Readings far from the line through their neighbours, the farthest first, each with those before it left out.
fn outliers(record: &Record) -> Vec<usize> {
    let (time, output) = (record.time_s(), record.output());
    let off = |a: usize, b: usize, c: usize| {
        let part = (time[b] - time[a]) / (time[c] - time[a]);
        output[b] - output[a] - part * (output[c] - output[a])
    };
    let mut sizes: Vec<f64> = (1..output.len() - 1).map(|k| off(k - 1, k, k + 1).abs()).collect();
    let middle = sizes.len() / 2;
    let typical = 1.483 * *sizes.select_nth_unstable_by(middle, f64::total_cmp).1;
    let limit = (FAR * typical).max(3.0 * record.quantum().unwrap_or(0.0));
    let mut kept: Vec<usize> = (0..output.len()).collect();
    loop {
        let size = |place: usize| {
            if place == 0 || place + 1 >= kept.len() {
                return 0.0;
            }
            let (a, b, c) = (kept[place - 1], kept[place], kept[place + 1]);
            if time[c] - time[a] > 4.5 * record.interval_s() { 0.0 } else { off(a, b, c).abs() }
        };
        let far = |place: usize| {
            let here = size(place);
            here > limit && here >= size(place - 1) && here > size(place + 1)
        };
        let out: Vec<usize> = (1..kept.len() - 1).filter(|place| far(*place)).map(|place| kept[place]).collect();
        if out.is_empty() {
            break;
        }
        kept.retain(|sample| out.binary_search(sample).is_err());
        if ((output.len() - kept.len()) as f64) > MOST_OUTLIERS * output.len() as f64 {
            return Vec::new();
        }
    }
    (0..output.len()).filter(|sample| kept.binary_search(sample).is_err()).collect()
}

/// A record's characteristic time: that between crossings of its mean.
fn swing_s(record: &Record) -> f64 {
    let output = record.output();
    let count = output.len() as f64;
    let mean = output.iter().sum::<f64>() / count;
    let margin = 0.3 * (output.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt();
    let (mut side, mut crossings) = (0.0, 0.0);
    for value in output {
        let now = if (value - mean).abs() > margin { (value - mean).signum() } else { side };
        if side != 0.0 && now != side {
            crossings += 1.0;
        }
        side = now;
    }
    (record.duration_s() / (crossings + 1.0)).min(record.duration_s() / 5.0).max(6.0 * record.interval_s())
}
