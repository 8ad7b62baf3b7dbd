//! The record as the filter reads it: the signal, instants of switching in gaps, weights of repeated half cycles.

use crate::experiment::Record;
use crate::identify::signal::{Clock, Signal, SwitchingInstant, outliers, weights_of_repeats};
use crate::plant::State;

/// Readings within this part of the half-period tell the state where the filter begins.
const START_REACH: f64 = 0.08;

/// A record under an assumption on its clock and its switchings.
#[derive(Clone, Debug)]
pub(super) struct Observations {
    pub(super) signal: Signal,
    /// Step to which readings are rounded.
    pub(super) step: Option<f64>,
    /// Weight of each reading.
    pub(super) weight: Vec<f64>,
    /// First sample that the filter sees: before it acts a command that is not in the record.
    pub(super) first: usize,
    /// Number of outliers, of weight zero.
    pub(super) outliers: usize,
}

impl core::ops::Deref for Observations {
    type Target = Signal;

    fn deref(&self) -> &Signal {
        &self.signal
    }
}

/// Twice the log-likelihood that each parameter has to be worth where readings are many.
pub(super) const PRICE: f64 = 4.0;
impl Observations {
    pub(super) fn new(record: &Record, clock: Clock, switching: SwitchingInstant) -> Self {
        let signal = Signal::new(record, clock, switching);
        let step = record.quantum();
        let mut weight = match step {
            Some(step) if signal.switched => weights_of_repeats(&signal.output, record.input(), step),
            _ => vec![1.0; signal.output.len()],
        };
        let outliers = outliers(record);
        outliers.iter().for_each(|sample| weight[*sample] = 0.0);
        Self { signal, step, weight, first: 0, outliers: outliers.len() }
    }

    /// Omits the readings of the first `unseen_s`.
    pub(super) fn skip(&mut self, unseen_s: f64) {
        let from = self.time_s[0] + unseen_s;
        self.first = self.time_s.partition_point(|time_s| *time_s < from).min(self.time_s.len() / 2);
    }

    /// The state at the first sample that the filter sees.
    pub(super) fn start_state(&self) -> State<f64> {
        self.state_near(self.time_s[self.first], START_REACH * self.half_period_s)
    }

    /// Puts a switching at the mean of its instants.
    fn place(&mut self, kick: usize, at_s: f64, variance_s2: f64) {
        // The first piece begins with the record, each later piece with a switching.
        self.signal.pieces[kick + 1].begin_s = at_s;
        let kick = &mut self.signal.kicks[kick];
        (kick.at_s, kick.variance_s2) = (at_s, variance_s2);
    }

    /// Places a switching of a gap at a given instant.
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

    /// Places it at the mean of equally likely instants.
    pub(super) fn open(&mut self, kick: usize) {
        let choices = self.kicks[kick].choices;
        self.weigh(kick, &vec![1.0 / choices as f64; choices]);
    }

    /// Whether a switched command changes its sign.
    pub(super) fn reverses(&self) -> bool {
        self.switched && self.pieces.windows(2).any(|pair| pair[0].value * pair[1].value < 0.0)
    }

    /// Total weight of the readings that the filter uses.
    pub(super) fn count(&self) -> f64 {
        self.weight[self.first..].iter().sum()
    }

    /// Twice the log-likelihood that `parameters` must gain: more if readings are few (Hurvich and Tsai,
    /// *Biometrika* 76, 1989).
    pub(super) fn price(&self, parameters: usize) -> f64 {
        let (count, parameters) = (self.count(), parameters as f64);
        PRICE * parameters * count / (count - parameters - 1.0).max(1.0)
    }
}
