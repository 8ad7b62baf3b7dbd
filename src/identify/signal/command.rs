//! The command between the samples of a log: in pieces that are linear in time, and its changes.

/// The command from an instant on, on the log's clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CommandPiece {
    pub(crate) begin_s: f64,
    pub(crate) value: f64,
    pub(crate) slope: f64,
}

/// When the command changed that a sample logs first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SwitchingInstant {
    /// At that sample.
    AtSamples,
    /// At an unknown instant since the sample before.
    Between,
}

impl SwitchingInstant {
    pub(crate) fn other(self) -> Self {
        match self {
            Self::AtSamples => Self::Between,
            Self::Between => Self::AtSamples,
        }
    }
}

/// A corner within this part of an interval from a sample is at the sample.
const CORNER_INSIDE: f64 = 1e-3;
/// Distance of two samples, in sampling intervals, beyond which a sample is missing.
const MISSING: f64 = 1.75;
/// The most instants that a switching in a gap is looked for at.
const MOST_CHOICES: usize = 24;
/// The most distinct values that a switched command has.
const MOST_LEVELS: usize = 4;

/// A change of the command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Kick {
    /// Mean of the instants compatible with the log.
    pub(crate) at_s: f64,
    pub(crate) jump: f64,
    /// Their variance.
    pub(crate) variance_s2: f64,
    /// The last sample before the gap that the command changed in, or the sample before.
    pub(crate) begin_s: f64,
    /// Number of instants of a gap's missing samples at which it may have changed; 1 if none is missing.
    pub(crate) choices: usize,
    /// Time between them.
    pub(crate) step_s: f64,
    switching: SwitchingInstant,
}

impl Kick {
    /// In a gap the command may have changed at any instant of the grid.
    fn new(begin_s: f64, end_s: f64, jump: f64, interval_s: f64, switching: SwitchingInstant) -> Self {
        let window = end_s - begin_s;
        let instants = (window / interval_s).round().max(1.0);
        let step = window / instants;
        let (at_s, variance_s2) = match switching {
            SwitchingInstant::AtSamples => {
                (end_s - 0.5 * (instants - 1.0) * step, step * step * (instants * instants - 1.0) / 12.0)
            }
            SwitchingInstant::Between => (end_s - 0.5 * window, window * window / 12.0),
        };
        let missing = window > MISSING * interval_s && instants <= MOST_CHOICES as f64;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
        let choices = if missing { instants as usize } else { 1 };
        Self { at_s, jump, variance_s2, begin_s, choices, step_s: step, switching }
    }

    /// Mean and variance of an instant.
    pub(crate) fn choice(&self, choice: usize) -> (f64, f64) {
        let end = self.begin_s + (choice + 1) as f64 * self.step_s;
        match self.switching {
            SwitchingInstant::AtSamples => (end, 0.0),
            SwitchingInstant::Between => (end - 0.5 * self.step_s, self.step_s * self.step_s / 12.0),
        }
    }
}

/// Whether a command is switched between few values rather than moved.
pub(crate) fn is_switched(input: &[f64]) -> bool {
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

/// Constant pieces of a switched command, and its changes.
pub(crate) fn switchings(
    time_s: &[f64],
    input: &[f64],
    interval_s: f64,
    switching: SwitchingInstant,
) -> (Vec<CommandPiece>, Vec<Kick>) {
    let mut pieces = vec![CommandPiece { begin_s: time_s[0], value: input[0], slope: 0.0 }];
    let mut kicks = Vec::new();
    for after in 1..input.len() {
        let jump = input[after] - input[after - 1];
        if jump == 0.0 {
            continue;
        }
        let kick = Kick::new(time_s[after - 1], time_s[after], jump, interval_s, switching);
        pieces.push(CommandPiece { begin_s: kick.at_s, value: input[after], slope: 0.0 });
        kicks.push(kick);
    }
    (pieces, kicks)
}

/// Pieces of a command that moves: held from sample to sample, or on straight lines between them with a corner where the lines
/// before and after an interval meet within it.
pub(crate) fn pieces_between(time_s: &[f64], input: &[f64], switching: SwitchingInstant) -> Vec<CommandPiece> {
    let last = input.len() - 1;
    let slope = |k: usize| (input[k + 1] - input[k]) / (time_s[k + 1] - time_s[k]);
    let mut pieces = Vec::with_capacity(2 * input.len());
    for k in 0..=last {
        let (begin_s, value) = (time_s[k], input[k]);
        if switching == SwitchingInstant::AtSamples || k == last {
            pieces.push(CommandPiece { begin_s, value, slope: 0.0 });
            continue;
        }
        let interval = time_s[k + 1] - begin_s;
        let corner = (k > 0 && k + 1 < last).then(|| {
            let (before, after) = (slope(k - 1), slope(k + 1));
            (before, after, (input[k + 1] - value - after * interval) / (before - after))
        });
        match corner {
            Some((before, after, at)) if at > CORNER_INSIDE * interval && at < (1.0 - CORNER_INSIDE) * interval => {
                pieces.push(CommandPiece { begin_s, value, slope: before });
                pieces.push(CommandPiece { begin_s: begin_s + at, value: value + before * at, slope: after });
            }
            _ => pieces.push(CommandPiece { begin_s, value, slope: slope(k) }),
        }
    }
    pieces
}
