//! A design, and what holds of it over all that the model may be.

use super::{PHASES_DEG, SENSITIVITIES};
use crate::command::known::Model;
use crate::control::{
    AxisIntervals, AxisModel, ControlError, Controller, CriterionRange, LinearProcess, LoopLimit, OpenLoop,
    ProcessIntervals, RobustCriterion, StepResponse, Structure, Tuning, WorstMargin,
};

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

/// What the gains are for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Target {
    /// A bandwidth, rad/s.
    BandwidthRadS(f64),
    /// The largest bandwidth at which no axis has a larger sensitivity.
    Sensitivity(f64),
    /// The largest bandwidth at which every axis has this phase margin, rad.
    PhaseRad(f64),
}

/// What is asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct DesignWanted {
    pub(super) target: Target,
    pub(super) structure: Structure,
    /// Step of the reference, and the largest command in it.
    pub(super) step: f64,
    pub(super) limit: Option<f64>,
    pub(super) top_speed: Option<f64>,
}

/// What every axis of the intervals has, and what some have.
#[derive(Clone, Copy, Debug)]
pub(super) struct Worst {
    pub(super) at_least: WorstMargin,
    pub(super) met: WorstMargin,
    /// Boxes that the plain axis' intervals were divided into.
    pub(super) boxes: Option<usize>,
    /// Whether all four bounds say something.
    pub(super) proved: bool,
}

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
    pub(super) sensitivity: CriterionRange,
    /// `None` where the parameters are points, drag is linear and there are no further terms.
    pub(super) worst: Option<Worst>,
}

impl Tuned {
    /// Gains are placed for the drag's slope at rest. Where there are none, or these leave some axis of the intervals unstable, beyond the
    /// limit or with a sensitivity above the usual, gains for the least slope that the intervals leave are compared with them.
    ///
    /// # Errors
    /// Where some axis of the intervals is not stabilised, with the nearest bandwidth at which all are.
    pub(super) fn new(model: &Model, wanted: &DesignWanted) -> Result<Self, ControlError> {
        let slopes = model.slopes_at_rest();
        let designed = |slope: f64| {
            let bandwidth_rad_s = match wanted.target {
                Target::BandwidthRadS(asked_rad_s) => asked_rad_s,
                _ => largest_bandwidth(model, wanted, slope)?,
            };
            Self::at(model, wanted, slope, bandwidth_rad_s)
        };
        let [at_rest, least] = slopes;
        let first = designed(at_rest);
        let enough = match &first {
            Ok(tuned) => !matches!(wanted.target, Target::BandwidthRadS(_)) || !tuned.has_little_margin(),
            Err(error) => !["unstable", "out-of-reach", "overdamped", "no-bandwidth"].contains(&error.code()),
        };
        if enough {
            return first;
        }
        match (first, designed(least)) {
            (Ok(tuned), Ok(other)) if tuned.sensitivity.met <= other.sensitivity.met => Ok(tuned),
            (_, Ok(other)) => Ok(other),
            (Ok(tuned), Err(_)) => Ok(tuned),
            (
                Err(ControlError::OutOfReach { within_reach, .. }),
                Err(again @ ControlError::OutOfReach { within_reach: better, .. }),
            ) if is_better(better, within_reach) => Err(again),
            (Err(error), Err(_)) => Err(match (error, wanted.target) {
                (
                    ControlError::NotStabilised { alpha, drag, delay_s, .. }
                    | ControlError::Unstable { alpha, drag, delay_s, .. },
                    Target::BandwidthRadS(asked_rad_s),
                ) => {
                    let stabilised_rad_s = stabilised(model, wanted, slopes, asked_rad_s);
                    ControlError::NotStabilised { alpha, drag, delay_s, stabilised_rad_s }
                }
                (error, _) => error,
            }),
        }
    }

    /// Whether some axis has a larger sensitivity than is usual.
    pub(super) fn has_little_margin(&self) -> bool {
        self.sensitivity.met > MOST_USUAL
    }

    fn at(model: &Model, wanted: &DesignWanted, slope: f64, bandwidth_rad_s: f64) -> Result<Self, ControlError> {
        let values = model.values();
        let axis = values.design_axis()?;
        let tuning = Tuning::for_slope(&axis, slope, wanted.structure, bandwidth_rad_s)?;
        let calm = AxisModel { delta: 0.0, ..values };
        let response = response(&calm, &tuning, wanted)?;
        let acts = values.delta != 0.0 && model.axis.delta.interval.is_none_or(|interval| !interval.contains(0.0));
        let with_force = acts.then(|| self::response(&values, &tuning, wanted)).transpose()?;
        let top_speed = wanted.top_speed.unwrap_or_else(|| response.top_speed());
        let poles = OpenLoop::new(&axis, tuning.gains(), 0.0)?.closed_loop_poles()?;
        let processes = ProcessIntervals::new(model.processes(top_speed))?;
        let uncertain = model.axis.parts().iter().any(|part| part.interval.is_some());
        let worst = if uncertain || axis.quadratic_drag() > 0.0 || !values.is_plain() {
            Some(worst(model, &processes, &tuning)?)
        } else {
            None
        };
        let mut sensitivity = processes.enclose(tuning.gains(), RobustCriterion::Sensitivity)?;
        if let Target::Sensitivity(limit) = wanted.target {
            // That limit is proved already.
            sensitivity.proved = sensitivity.proved.map(|proved| proved.min(limit)).or(Some(limit));
        }
        let (step, degrees) = (wanted.step, model.degrees);
        Ok(Self { model: values, degrees, tuning, poles, step, response, with_force, top_speed, sensitivity, worst })
    }

    /// Where a PD controller leaves the axis under the constant force: `delta/(K_p + stiffness)` from where it would be without.
    pub(super) fn offset(&self) -> f64 {
        match self.tuning.gains().integral() {
            0.0 => self.model.delta / (self.tuning.gains().proportional() + self.model.stiffness),
            _ => 0.0,
        }
    }
}

fn response(model: &AxisModel<f64>, tuning: &Tuning<f64>, wanted: &DesignWanted) -> Result<StepResponse, ControlError> {
    let w = tuning.double_pole_rad_s();
    let controller = Controller::new(tuning.gains());
    let controller = match wanted.limit {
        Some(limit) => controller.with_limits(-limit, limit)?,
        None => controller,
    };
    let (rate_hz, duration_s) = (SAMPLES * w, TIME_CONSTANTS / w);
    if model.is_plain() {
        StepResponse::simulate(&model.design_axis()?, controller, wanted.step, rate_hz, duration_s)
    } else {
        StepResponse::of_model(model, controller, wanted.step, rate_hz, duration_s)
    }
}

/// Margins of every axis: of a plain one by its own search, else by exclusion of zero.
fn worst(model: &Model, processes: &ProcessIntervals, tuning: &Tuning<f64>) -> Result<Worst, ControlError> {
    let LinearProcess { alpha, drag, delay_s, .. } = *processes.process();
    if model.values().is_plain() && drag.lower() >= 0.0 {
        let found = AxisIntervals::new(alpha, drag, delay_s)?.worst_margins(tuning.gains())?;
        let proved = found.converged || found.at_least.phase_rad > 0.0;
        return Ok(Worst { at_least: found.at_least, met: found.met, boxes: Some(found.boxes), proved });
    }
    let enclose = |of| processes.enclose(tuning.gains(), of);
    let [gain, reduction, phase, delay] = [
        enclose(RobustCriterion::Gain)?,
        enclose(RobustCriterion::GainReduction)?,
        enclose(RobustCriterion::PhaseRad)?,
        enclose(RobustCriterion::DelayS)?,
    ];
    let limited = |number: f64| Some(number).filter(|number| *number < ProcessIntervals::NO_LIMIT);
    let at_least = WorstMargin {
        gain: limited(gain.proved.unwrap_or(1.0)),
        gain_reduction: limited(reduction.proved.unwrap_or(1.0)),
        phase_rad: phase.proved.unwrap_or(0.0),
        delay_s: delay.proved.unwrap_or(0.0),
    };
    let met = WorstMargin {
        gain: limited(gain.met),
        gain_reduction: limited(reduction.met),
        phase_rad: phase.met,
        delay_s: delay.met,
    };
    let proved = [gain, reduction, phase, delay].iter().all(|one| one.proved.is_some());
    Ok(Worst { at_least, met, boxes: None, proved })
}

/// Every process that the step of these gains shows.
fn processes(model: &Model, wanted: &DesignWanted, tuning: &Tuning<f64>) -> Result<ProcessIntervals, ControlError> {
    let top_speed = match wanted.top_speed {
        Some(top_speed) => top_speed,
        None => response(&AxisModel { delta: 0.0, ..model.values() }, tuning, wanted)?.top_speed(),
    };
    ProcessIntervals::new(model.processes(top_speed))
}

/// Bandwidths from the largest to the least for which there are gains, evenly on a logarithmic scale.
fn grid((least, most): (f64, f64)) -> impl Fn(u32) -> f64 {
    move |k| most * (least / most).powf(f64::from(k) / f64::from(GRID))
}

/// The bandwidth nearest to the one asked for, to two digits, whose gains are proved to stabilise every axis of the intervals, with a
/// sensitivity not above the usual where there is one, else with the least.
fn stabilised(model: &Model, wanted: &DesignWanted, slopes: [f64; 2], asked_rad_s: f64) -> Option<f64> {
    let axis = model.values().design_axis().ok()?;
    let mut candidates: Vec<(f64, f64, f64)> = Vec::new();
    for slope in slopes {
        let Ok(range) = bandwidths(model, slope, wanted.structure) else { continue };
        let at = grid(range);
        candidates.extend((0..=GRID).filter_map(|k| {
            let bandwidth: f64 = format!("{:.1e}", at(k)).parse().ok()?;
            let sensitivity = number_at(model, wanted, slope, bandwidth, RobustCriterion::Sensitivity(1.0))?;
            Some((sensitivity.max(MOST_USUAL), slope, bandwidth))
        }));
    }
    let far = |bandwidth: f64| (bandwidth / asked_rad_s).ln().abs();
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0).then(far(a.2).total_cmp(&far(b.2))));
    let proved = |slope: f64, bandwidth: f64| {
        let tuning = Tuning::for_slope(&axis, slope, wanted.structure, bandwidth).ok()?;
        let stable = processes(model, wanted, &tuning).ok()?.all_stable(tuning.gains());
        stable.then(|| Tuned::at(model, wanted, slope, bandwidth).ok())?
    };
    candidates.into_iter().find(|(_, slope, bandwidth)| proved(*slope, *bandwidth).is_some()).map(|found| found.2)
}

/// The largest bandwidth at which the limit is proved for every axis of the intervals.
fn largest_bandwidth(model: &Model, wanted: &DesignWanted, slope: f64) -> Result<f64, ControlError> {
    let axis = model.values().design_axis()?;
    let (least, most) = bandwidths(model, slope, wanted.structure)?;
    let criterion = match wanted.target {
        Target::Sensitivity(most) => RobustCriterion::Sensitivity(most),
        Target::PhaseRad(least) => RobustCriterion::PhaseRad(least),
        Target::BandwidthRadS(bandwidth) => return Ok(bandwidth),
    };
    let at = grid((least, most));
    // A step or a speed that makes no sense is said, not taken for a limit out of reach.
    let tuning_at = |k| Tuning::for_slope(&axis, slope, wanted.structure, at(k)).ok();
    if let Some(tuning) = (0..=GRID).find_map(tuning_at) {
        processes(model, wanted, &tuning)?;
    }
    let keeps = |bandwidth: f64| {
        let Ok(tuning) = Tuning::for_slope(&axis, slope, wanted.structure, bandwidth) else { return false };
        processes(model, wanted, &tuning).is_ok_and(|processes| {
            processes.meets(tuning.gains(), criterion) && processes.points_stable(tuning.gains())
        })
    };
    // Slow gains can be worse than fast ones, where drag is uncertain: no bisection from the ends.
    let out_of_reach = |within_reach| ControlError::OutOfReach { least_rad_s: least, most_rad_s: most, within_reach };
    let Some(first) = (0..=GRID).find(|k| keeps(at(*k))) else {
        let numbers = (0..=GRID).filter_map(|k| number_at(model, wanted, slope, at(k), criterion));
        return Err(out_of_reach(within_reach(numbers, criterion)));
    };
    let (mut low, mut high) = (at(first), at(first.saturating_sub(1)));
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if keeps(middle) { low = middle } else { high = middle }
    }
    (0..STEPS_BACK)
        .map(|back| low * 0.98_f64.powi(back))
        .find(|bandwidth| {
            let Ok(tuning) = Tuning::for_slope(&axis, slope, wanted.structure, *bandwidth) else { return false };
            processes(model, wanted, &tuning).is_ok_and(|processes| processes.all_have(tuning.gains(), criterion))
        })
        .ok_or(out_of_reach(None))
}

/// The criterion's worst number at a bandwidth, where every axis is stable.
fn number_at(
    model: &Model,
    wanted: &DesignWanted,
    slope: f64,
    bandwidth_rad_s: f64,
    criterion: RobustCriterion,
) -> Option<f64> {
    let axis = model.values().design_axis().ok()?;
    let tuning = Tuning::for_slope(&axis, slope, wanted.structure, bandwidth_rad_s).ok()?;
    let processes = processes(model, wanted, &tuning).ok()?;
    processes.points_stable(tuning.gains()).then(|| processes.nearly(tuning.gains(), criterion))
}

/// Whether a limit asks for more margin than another one, or there is no other.
fn is_better(limit: Option<LoopLimit>, other: Option<LoopLimit>) -> bool {
    match (limit, other) {
        (Some(LoopLimit::Sensitivity(limit)), Some(LoopLimit::Sensitivity(other))) => limit < other,
        (Some(LoopLimit::PhaseDeg(limit)), Some(LoopLimit::PhaseDeg(other))) => limit > other,
        (limit, other) => limit.is_some() && other.is_none(),
    }
}

/// The best of the numbers less a part that a proof may need.
fn within_reach(numbers: impl Iterator<Item = f64>, criterion: RobustCriterion) -> Option<LoopLimit> {
    if matches!(criterion, RobustCriterion::Sensitivity(_)) {
        let least = numbers.min_by(f64::total_cmp).map(|best| best * (1.0 + FOR_THE_PROOF));
        least.filter(|limit| SENSITIVITIES.contains(limit)).map(LoopLimit::Sensitivity)
    } else {
        let most = numbers.max_by(f64::total_cmp).map(|best| (best * (1.0 - FOR_THE_PROOF)).to_degrees());
        most.filter(|limit| PHASES_DEG.contains(limit)).map(LoopLimit::PhaseDeg)
    }
}

/// The range of bandwidths for which there are gains.
fn bandwidths(model: &Model, slope: f64, structure: Structure) -> Result<(f64, f64), ControlError> {
    let axis = &model.values().design_axis()?;
    // No gains are fast beside the longest delay.
    let longest_s = model.ranges().delay_s.upper().max(axis.delay_s());
    // Without delay nothing but the drag's pace limits the range; ten thousand times that is as good as no limit.
    let pace = slope.abs() / axis.alpha();
    let beyond = if longest_s > 0.0 { 100.0 / longest_s } else { 1e4 * pace.max(1e-4) };
    let most = match Tuning::for_slope(axis, slope, structure, beyond) {
        Ok(_) => beyond,
        Err(ControlError::TooFast { most_rad_s, .. }) => most_rad_s,
        Err(error) => return Err(error),
    };
    let least = match Tuning::for_slope(axis, slope, structure, 1e-3 * most) {
        Err(ControlError::Overdamped { least_rad_s, .. }) => least_rad_s,
        _ => 1e-3 * most,
    };
    Ok((least * (1.0 + 1e-9), most))
}
