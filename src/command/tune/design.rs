//! A design, and what holds of it over all that the model may be.

use super::{Arguments, PHASES_DEG, SENSITIVITIES};
use crate::command::known::Model;
use crate::control::{
    AxisModel, ControlError, Controller, Gains, OpenLoop, ProcessIntervals, RobustCriterion, StepResponse, Tuning,
    WorstMargins,
};
use crate::numeric::{Limit, domain};
use crate::plant::DragAxis;

/// Samples in the time constant of the double pole, and time constants in the simulated step: the hold is a
/// four-hundredth of one, and the slow pole of a PID has six of its own.
const SAMPLES: f64 = 200.0;
const TIME_CONSTANTS: f64 = 60.0;
/// Bandwidths that are tried, halvings between the first that keeps the limit and its neighbour, and steps back from there until
/// the limit is proved.
const GRID: u32 = 40;
const HALVINGS: u32 = 8;
const STEPS_BACK: i32 = 12;
/// Part of a number met at points that the proof over the box may need: the second step of what a bound gives up.
const FOR_THE_PROOF: f64 = 0.02;
/// Largest sensitivities are usually between 1.2 and 2 (Astrom and Hagglund, *Advanced PID Control*, ch. 4).
const MOST_USUAL: f64 = 2.0;

/// A design and what was found on it.
pub(super) struct Tuned {
    pub(super) model: AxisModel<f64>,
    pub(super) degrees: bool,
    pub(super) tuning: Tuning<f64>,
    pub(super) poles: Vec<nalgebra::Complex<f64>>,
    pub(super) step: f64,
    /// Without the constant force, and with it.
    pub(super) response: StepResponse,
    pub(super) with_force: Option<StepResponse>,
    pub(super) top_speed: f64,
    pub(super) worst: WorstMargins,
    /// Whether there is more than one process: parameters have intervals, drag is not linear, or there are further terms.
    pub(super) varies: bool,
}

impl Tuned {
    /// Gains are placed for the drag's slope at rest. Where there are none, or these leave some axis of the intervals unstable, beyond the
    /// limit or with a sensitivity above the usual, gains for the least slope that the intervals leave are compared with them.
    ///
    /// # Errors
    /// Where some axis of the intervals is not stabilised, with the nearest bandwidth at which all are.
    pub(super) fn new(model: &Model, wanted: &Arguments) -> Result<Self, ControlError> {
        let (axis, limit) = (model.values().design_axis()?, wanted.limit_of_all());
        let families = model.slopes_at_rest().map(|slope| PlacedGains { model, wanted, axis, slope });
        let asked_rad_s = wanted.bandwidth.unwrap_or(f64::NAN);
        let designed = |family: &PlacedGains| {
            family.design(limit.map_or(Ok(asked_rad_s), |limit| family.largest_bandwidth(limit))?)
        };
        let [at_rest, least] = &families;
        let first = designed(at_rest);
        let enough = match &first {
            Ok(tuned) => limit.is_some() || !tuned.has_little_margin(),
            Err(error) => !["unstable", "out-of-reach", "overdamped", "no-bandwidth"].contains(&error.code()),
        };
        if enough {
            return first;
        }
        match (first, designed(least)) {
            (Ok(tuned), Ok(other)) if tuned.worst.sensitivity.met <= other.worst.sensitivity.met => Ok(tuned),
            (_, Ok(other)) => Ok(other),
            (Ok(tuned), Err(_)) => Ok(tuned),
            (
                Err(ControlError::OutOfReach { within_reach, .. }),
                Err(again @ ControlError::OutOfReach { within_reach: Some(better), .. }),
            ) if within_reach.is_none_or(|limit| limit.is_met_by(better.number())) => Err(again),
            (
                Err(
                    ControlError::NotStabilised { alpha, drag, delay_s, .. }
                    | ControlError::Unstable { alpha, drag, delay_s, .. },
                ),
                Err(_),
            ) if limit.is_none() => {
                let stabilised_rad_s = stabilised(&families, asked_rad_s);
                Err(ControlError::NotStabilised { alpha, drag, delay_s, stabilised_rad_s })
            }
            (Err(error), Err(_)) => Err(error),
        }
    }

    /// Whether some axis has a larger sensitivity than is usual.
    pub(super) fn has_little_margin(&self) -> bool {
        self.worst.sensitivity.met > MOST_USUAL
    }

    /// Where a PD controller leaves the axis under the constant force: `delta/(K_p + stiffness)` from where it would be without.
    pub(super) fn offset(&self) -> f64 {
        match self.tuning.gains().integral() {
            0.0 => self.model.delta / (self.tuning.gains().proportional() + self.model.stiffness),
            _ => 0.0,
        }
    }
}

/// Gains of one structure, placed for one slope of the drag, over bandwidths.
struct PlacedGains<'a> {
    model: &'a Model,
    wanted: &'a Arguments,
    axis: DragAxis<f64>,
    slope: f64,
}

impl PlacedGains<'_> {
    fn tuning(&self, bandwidth_rad_s: f64) -> Result<Tuning<f64>, ControlError> {
        Tuning::for_slope(&self.axis, self.slope, self.wanted.structure, bandwidth_rad_s)
    }

    /// The answer to the step under a constant force.
    fn response(&self, tuning: &Tuning<f64>, delta: f64) -> Result<StepResponse, ControlError> {
        let (model, w) = (AxisModel { delta, ..self.model.values() }, tuning.double_pole_rad_s());
        let mut controller = Controller::new(tuning.gains());
        if let Some(limit) = self.wanted.limit {
            let remedy =
                "a larger constant force drives the axis away: raise the limit (--limit), or trim the force (--delta)";
            domain::require("limit", limit, "command units", Limit::Above(delta.abs()), remedy)?;
            controller = controller.with_limits(-limit, limit)?;
        }
        StepResponse::simulate(model, controller, self.wanted.step, SAMPLES * w, TIME_CONSTANTS / w)
    }

    /// Gains, and every process that their step shows.
    fn loops(&self, bandwidth_rad_s: f64) -> Result<(Gains<f64>, ProcessIntervals), ControlError> {
        let tuning = self.tuning(bandwidth_rad_s)?;
        let top_speed = match self.wanted.top_speed {
            Some(top_speed) => top_speed,
            None => self.response(&tuning, 0.0)?.top_speed(),
        };
        Ok((*tuning.gains(), ProcessIntervals::new(self.model.processes(top_speed))?))
    }

    fn design(&self, bandwidth_rad_s: f64) -> Result<Tuned, ControlError> {
        let (model, wanted, axis) = (self.model, self.wanted, &self.axis);
        let (values, tuning) = (model.values(), self.tuning(bandwidth_rad_s)?);
        let response = self.response(&tuning, 0.0)?;
        let acts = values.delta != 0.0 && model.axis.delta.interval.is_none_or(|interval| !interval.contains(0.0));
        let with_force = acts.then(|| self.response(&tuning, values.delta)).transpose()?;
        let top_speed = wanted.top_speed.unwrap_or_else(|| response.top_speed());
        let poles = OpenLoop::new(axis, tuning.gains(), 0.0)?.closed_loop_poles()?;
        let processes = ProcessIntervals::new(model.processes(top_speed))?;
        let uncertain = model.axis.parts().iter().any(|part| part.interval.is_some());
        let varies = uncertain || axis.quadratic_drag() > 0.0 || !values.is_plain();
        let mut worst = processes.worst_margins(tuning.gains())?;
        if let Some(limit) = wanted.ms {
            // That limit is proved already.
            worst.sensitivity.proved = worst.sensitivity.proved.map(|proved| proved.min(limit)).or(Some(limit));
        }
        let (step, degrees) = (wanted.step, model.degrees);
        Ok(Tuned { model: values, degrees, tuning, poles, step, response, with_force, top_speed, worst, varies })
    }

    /// The criterion's worst number, where every axis is stable: no proof.
    fn number(&self, bandwidth_rad_s: f64, criterion: RobustCriterion) -> Option<f64> {
        let (gains, processes) = self.loops(bandwidth_rad_s).ok()?;
        processes.points_stable(&gains).then(|| processes.worst_number(&gains, criterion))
    }

    /// Whether the criterion is proved for every axis.
    fn has(&self, bandwidth_rad_s: f64, criterion: RobustCriterion) -> bool {
        self.loops(bandwidth_rad_s).is_ok_and(|(gains, processes)| processes.all_have(&gains, criterion))
    }

    /// The range of bandwidths for which there are gains.
    fn range(&self) -> Result<[f64; 2], ControlError> {
        // No gains are fast beside the longest delay.
        let longest_s = self.longest_delay_s();
        // Without delay nothing but the drag's pace limits the range; ten thousand times that is as good as no limit.
        let pace = self.slope.abs() / self.axis.alpha();
        let beyond = if longest_s > 0.0 { 100.0 / longest_s } else { 1e4 * pace.max(1e-4) };
        let most = match self.tuning(beyond) {
            Ok(_) => beyond,
            Err(ControlError::TooFast { most_rad_s, .. }) => most_rad_s,
            Err(error) => return Err(error),
        };
        let least = match self.tuning(1e-3 * most) {
            Err(ControlError::Overdamped { least_rad_s, .. }) => least_rad_s,
            _ => 1e-3 * most,
        };
        Ok([least * (1.0 + 1e-9), most])
    }

    /// The longest delay of the intervals and of the axis.
    fn longest_delay_s(&self) -> f64 {
        self.model.ranges().delay_s.upper().max(self.axis.delay_s())
    }

    /// The largest bandwidth at which the limit is proved for every axis of the intervals.
    fn largest_bandwidth(&self, limit: RobustCriterion) -> Result<f64, ControlError> {
        let [least_rad_s, most_rad_s] = self.range()?;
        let at = grid([least_rad_s, most_rad_s]);
        // A step or a speed that makes no sense is said, not taken for a limit out of reach.
        if let Some(bandwidth) = at.iter().find(|bandwidth| self.tuning(**bandwidth).is_ok()) {
            self.loops(*bandwidth)?;
        }
        let keeps = |bandwidth: f64| {
            self.loops(bandwidth)
                .is_ok_and(|(gains, processes)| processes.meets(&gains, limit) && processes.points_stable(&gains))
        };
        // Slow gains can be worse than fast ones, where drag is uncertain: no bisection from the ends.
        let Some(first) = at.iter().position(|bandwidth| keeps(*bandwidth)) else {
            let within_reach = self.within_reach(&at, limit);
            return Err(ControlError::OutOfReach { least_rad_s, most_rad_s, within_reach });
        };
        if first == 0 && self.longest_delay_s() == 0.0 {
            return Err(ControlError::NothingBounds { kept_rad_s: at[0] });
        }
        let (mut low, mut high) = (at[first], at[first.saturating_sub(1)]);
        for _ in 0..HALVINGS {
            let middle = (low * high).sqrt();
            if keeps(middle) { low = middle } else { high = middle }
        }
        let mut back = (0..STEPS_BACK).map(|back| low * 0.98_f64.powi(back));
        let out_of_reach = ControlError::OutOfReach { least_rad_s, most_rad_s, within_reach: None };
        back.find(|bandwidth| self.has(*bandwidth, limit)).ok_or(out_of_reach)
    }

    /// The best limit of this kind that is proved at one of the bandwidths.
    fn within_reach(&self, bandwidths: &[f64], limit: RobustCriterion) -> Option<RobustCriterion> {
        let (of, sign): (fn(f64) -> RobustCriterion, f64) = match limit {
            RobustCriterion::Sensitivity(_) => (RobustCriterion::Sensitivity, 1.0),
            _ => (RobustCriterion::PhaseRad, -1.0),
        };
        let with_room = |bandwidth: f64| Some(of(self.number(bandwidth, limit)? * (1.0 + sign * FOR_THE_PROOF)));
        let may_be_asked = |limit: &RobustCriterion| match *limit {
            RobustCriterion::Sensitivity(most) => SENSITIVITIES.contains(&most),
            least => PHASES_DEG.contains(&least.number().to_degrees()),
        };
        let candidate = |bandwidth: &f64| Some((*bandwidth, with_room(*bandwidth).filter(may_be_asked)?));
        let mut found: Vec<(f64, RobustCriterion)> = bandwidths.iter().filter_map(candidate).collect();
        found.sort_by(|(_, a), (_, b)| (sign * a.number()).total_cmp(&(sign * b.number())));
        found.into_iter().find(|(bandwidth, limit)| self.has(*bandwidth, *limit)).map(|(_, limit)| limit)
    }
}

/// Bandwidths from the largest to the least, evenly on a logarithmic scale.
fn grid([least, most]: [f64; 2]) -> Vec<f64> {
    (0..=GRID).map(|k| most * libm::pow(least / most, f64::from(k) / f64::from(GRID))).collect()
}

/// The bandwidth nearest to the one asked for, to two digits, at which every axis of the intervals is proved to be stable. Those with a
/// usual sensitivity come first, then that of the least.
fn stabilised(families: &[PlacedGains; 2], asked_rad_s: f64) -> Option<f64> {
    let mut candidates: Vec<(f64, &PlacedGains, f64)> = Vec::new();
    for family in families {
        let Ok(range) = family.range() else { continue };
        candidates.extend(grid(range).into_iter().filter_map(|bandwidth| {
            let bandwidth: f64 = format!("{bandwidth:.1e}").parse().ok()?;
            let sensitivity = family.number(bandwidth, RobustCriterion::Sensitivity(1.0))?;
            Some((sensitivity.max(MOST_USUAL), family, bandwidth))
        }));
    }
    let far = |bandwidth: f64| libm::log(bandwidth / asked_rad_s).abs();
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0).then(far(a.2).total_cmp(&far(b.2))));
    let proved = |family: &PlacedGains, bandwidth: f64| {
        let stable = family.loops(bandwidth).is_ok_and(|(gains, processes)| processes.all_stable(&gains));
        stable && family.design(bandwidth).is_ok()
    };
    candidates.into_iter().find(|(_, family, bandwidth)| proved(family, *bandwidth)).map(|found| found.2)
}
