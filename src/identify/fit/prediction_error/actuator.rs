//! The force of the actuator: the command, delayed, limited in its rate, then behind a first-order lag; or with pauses.
//!
//! The command is a chain of pieces that are linear in time, so that the force is in closed form too, and its derivatives
//! with respect to delay, lag and ramp with it.

use super::model::{Parameter, VehicleModel};
use crate::identify::signal::CommandPiece;

/// The force with its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Force {
    pub(super) value: f64,
    pub(super) by_delay: f64,
    pub(super) by_lag: f64,
    pub(super) by_ramp: f64,
}

/// The force from an instant on. `input` and `input_by_ramp` are the lag's input.
#[derive(Clone, Copy, Debug)]
struct ForceSegment {
    begin_s: f64,
    input: [f64; 2],
    input_by_ramp: [f64; 2],
    at_begin: Force,
    /// Jump of the force at the beginning, zero behind a lag or a ramp.
    jump: f64,
    /// Whether a pause ends at the beginning.
    paused: bool,
}

/// Where the integration has to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum IntegrationStop {
    /// The force enters its next segment with this jump, at the end of a pause or not.
    Segment { jump: f64, paused: bool },
    /// The force bends here; only the step's length matters.
    Refine,
    /// A change of the command by `jump` whose instant has the variance `variance_s2` takes effect.
    Kick { jump: f64, variance_s2: f64 },
}

/// The force for given parameters.
#[derive(Clone, Debug)]
pub(super) struct Actuator {
    lag_s: f64,
    segments: Vec<ForceSegment>,
}

/// Where steps end behind a switching, in time constants of the lag: short while the force changes fast.
const LAG_STEPS: [f64; 5] = [0.5, 1.0, 2.0, 4.0, 8.0];

impl Actuator {
    /// `range` is the command's largest less its least value, over which a ramp takes its time.
    pub(super) fn new(pieces: &[CommandPiece], model: &VehicleModel, range: f64) -> Self {
        let [delay_s, lag_s, ramp_s, pause_s] =
            [Parameter::DelayS, Parameter::LagS, Parameter::RampS, Parameter::PauseS].map(|p| model.value(p));
        let mut segments: Vec<ForceSegment> = Vec::with_capacity(pieces.len());
        let segment = |begin_s, input, input_by_ramp| ForceSegment {
            begin_s,
            input,
            input_by_ramp,
            at_begin: Force::default(),
            jump: 0.0,
            paused: false,
        };
        if ramp_s > 0.0 {
            limited(pieces, ramp_s, range, |begin_s, input, by_ramp| {
                segments.push(segment(begin_s + delay_s, input, by_ramp));
            });
        } else if pause_s > 0.0 {
            paused(pieces, pause_s, |begin_s, input, paused| {
                segments.push(ForceSegment { paused, ..segment(begin_s + delay_s, input, [0.0; 2]) });
            });
        } else {
            segments.extend(pieces.iter().map(|p| segment(p.begin_s + delay_s, [p.value, p.slope], [0.0; 2])));
        }
        let mut actuator = Self { lag_s, segments };
        for index in 0..actuator.segments.len() {
            let input = actuator.segments[index].input[0];
            let (at_begin, jump) = match index.checked_sub(1) {
                // Settled before the record.
                None => (Force { value: input, ..Force::default() }, 0.0),
                Some(before) => {
                    let end = actuator.at(before, actuator.segments[index].begin_s);
                    (end, if lag_s > 0.0 { 0.0 } else { input - end.value })
                }
            };
            actuator.segments[index].at_begin = at_begin;
            actuator.segments[index].jump = jump;
        }
        actuator
    }

    /// The force in a segment, at a time within it.
    pub(super) fn at(&self, segment: usize, time_s: f64) -> Force {
        let ForceSegment { begin_s, input: [value, slope], input_by_ramp: [ramp, ramp_slope], at_begin, .. } =
            self.segments[segment];
        let since = time_s - begin_s;
        let (input, by_ramp) = (value + slope * since, ramp + ramp_slope * since);
        if self.lag_s == 0.0 {
            return Force { value: input, by_delay: -slope, by_lag: 0.0, by_ramp };
        }
        let lag = self.lag_s;
        let left = libm::exp(-since / lag);
        let transient = at_begin.value - value + slope * lag;
        let force = input - slope * lag + transient * left;
        Force {
            value: force,
            by_delay: (force - input) / lag,
            by_lag: -slope * (1.0 - left) + (at_begin.by_lag + transient * since / (lag * lag)) * left,
            by_ramp: by_ramp - ramp_slope * lag + (at_begin.by_ramp - ramp + ramp_slope * lag) * left,
        }
    }

    /// The segment that a time lies in.
    pub(super) fn segment_at(&self, time_s: f64) -> usize {
        self.segments.partition_point(|segment| segment.begin_s <= time_s).saturating_sub(1)
    }

    /// Stops after `from_s`, in order of time, those of `kicks` among them.
    pub(super) fn stops(
        &self,
        from_s: f64,
        kicks: impl Iterator<Item = (f64, IntegrationStop)>,
        refine: bool,
    ) -> Vec<(f64, IntegrationStop)> {
        let mut stops: Vec<(f64, IntegrationStop)> = Vec::with_capacity(2 * self.segments.len());
        for segment in &self.segments[1..] {
            stops.push((segment.begin_s, IntegrationStop::Segment { jump: segment.jump, paused: segment.paused }));
            if refine && self.lag_s > 0.0 {
                stops.extend(LAG_STEPS.map(|part| (segment.begin_s + part * self.lag_s, IntegrationStop::Refine)));
            }
        }
        stops.extend(kicks);
        stops.retain(|(time_s, _)| *time_s > from_s);
        stops.sort_by(|a, b| a.0.total_cmp(&b.0));
        stops
    }
}

/// The command behind a limit of its rate: calls `push` with the beginning, value and slope of each linear segment, and with
/// the derivatives of value and slope with respect to the time of the ramp.
fn limited(pieces: &[CommandPiece], ramp_s: f64, range: f64, mut push: impl FnMut(f64, [f64; 2], [f64; 2])) {
    let rate = range / ramp_s;
    let (mut level, mut level_by_ramp) = (pieces[0].value, 0.0);
    push(pieces[0].begin_s, [level, 0.0], [0.0; 2]);
    for (index, piece) in pieces.iter().enumerate().skip(1) {
        let available = pieces.get(index + 1).map_or(f64::INFINITY, |next| next.begin_s - piece.begin_s);
        let slope = rate.copysign(piece.value - level);
        let needed = (piece.value - level) / slope;
        push(piece.begin_s, [level, slope], [level_by_ramp, -slope / ramp_s]);
        if needed < available {
            push(piece.begin_s + needed, [piece.value, 0.0], [0.0; 2]);
            (level, level_by_ramp) = (piece.value, 0.0);
        } else {
            level += slope * available;
            level_by_ramp -= slope / ramp_s * available;
        }
    }
}

/// The command with zero for `pause_s` after each change of its sign: calls `push` with the beginning, value and slope of each segment, and
/// with whether a pause ends there. A change of the command within a pause ends it only if the sign stays.
fn paused(pieces: &[CommandPiece], pause_s: f64, mut push: impl FnMut(f64, [f64; 2], bool)) {
    let mut before = pieces[0].value;
    for (index, piece) in pieces.iter().enumerate() {
        if before * piece.value < 0.0 {
            push(piece.begin_s, [0.0; 2], false);
            if pieces.get(index + 1).is_none_or(|next| piece.begin_s + pause_s < next.begin_s) {
                push(piece.begin_s + pause_s, [piece.value, 0.0], true);
            }
        } else {
            push(piece.begin_s, [piece.value, piece.slope], false);
        }
        before = piece.value;
    }
}
