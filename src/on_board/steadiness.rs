//! Cycles as they come, and whether they repeat.

use super::Protocol;
use super::supervisor::{Observation, Observer};
use crate::features::{Cycle, Cycles, Features, Summary};
use crate::nonlinearity::{PiecewiseLinear, RelayHysteresis, Sinusoid};
use crate::numeric::Scalar;

/// Finds cycles and compares them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Steadiness<T> {
    cycles: Cycles<T>,
    summary: Summary<T>,
    /// Least and largest of both peaks and both times over cycles that are alike so far.
    ranges: [(T, T); 4],
    alike: u8,
}

impl<T: Scalar> Steadiness<T> {
    pub(super) fn new(protocol: &Protocol<T>) -> Self {
        Self {
            cycles: Cycles::new(protocol.middle_command()),
            summary: Summary::new(),
            ranges: [(T::zero(), T::zero()); 4],
            alike: 0,
        }
    }

    /// Means over the steady cycles of the attempt; `None` where there are too few or they show a trend.
    pub(super) fn features(&self) -> Option<Features<T>> {
        self.summary.features().ok()
    }

    /// Widens the ranges by a cycle, or begins anew with it where they become too wide.
    fn compare(&mut self, cycle: &Cycle<T>, protocol: &Protocol<T>) {
        let values = [cycle.maximum, cycle.minimum, cycle.time_positive_s, cycle.time_negative_s()];
        let peak = protocol.spread * cycle.amplitude() + protocol.resolution;
        let time = protocol.spread * cycle.period_s / T::two() + protocol.interval_s;
        let mut wider = self.ranges;
        let mut fits = self.alike > 0;
        for ((range, value), allowed) in wider.iter_mut().zip(values).zip([peak, peak, time, time]) {
            *range = (range.0.min(value), range.1.max(value));
            fits &= range.1 - range.0 <= allowed;
        }
        (self.ranges, self.alike) =
            if fits { (wider, self.alike.saturating_add(1)) } else { (values.map(|value| (value, value)), 1) };
    }
}

/// The observer of one sample: the cycles with the relay level that they came by.
pub(super) struct Judge<'a, T> {
    pub(super) steadiness: &'a mut Steadiness<T>,
    pub(super) relay_level: T,
}

impl<T: Scalar> Observer<T> for Judge<'_, T> {
    fn begin(&mut self, protocol: &Protocol<T>) {
        *self.steadiness = Steadiness::new(protocol);
    }

    fn sample(&mut self, protocol: &Protocol<T>, time_s: T, position: T, command: T) -> Observation {
        match self.steadiness.cycles.step(time_s, position, command) {
            Some(cycle) => self.judge(protocol, cycle),
            None => Observation::Between,
        }
    }
}

impl<T: Scalar> Judge<'_, T> {
    /// Verdict of a completed cycle.
    #[cold]
    fn judge(&mut self, protocol: &Protocol<T>, cycle: Cycle<T>) -> Observation {
        self.steadiness.summary.push(cycle);
        self.steadiness.compare(&cycle, protocol);
        if self.steadiness.alike < protocol.cycles {
            return Observation::Unsteady;
        }
        let Some(features) = self.steadiness.features() else { return Observation::Unsteady };
        let relay = RelayHysteresis::new(self.relay_level, features.switch_level.mean, T::zero());
        let sweep = Sinusoid::new(features.bias.mean, features.amplitude.mean);
        match (relay, sweep) {
            (Ok(relay), Ok(sweep)) if relay.periodic(&sweep).is_ok() => Observation::Steady,
            (Ok(_), Ok(_)) => Observation::Condition40,
            _ => Observation::Unsteady,
        }
    }
}
