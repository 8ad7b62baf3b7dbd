//! A design, and what holds of it over all that the model may be.

use crate::command::known::Model;
use crate::control::{
    AxisIntervals, AxisModel, ControlError, Controller, CriterionRange, LinearProcess, OpenLoop, ProcessIntervals,
    RobustCriterion, StepResponse, Structure, Tuning, WorstMargin,
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
    /// Gains are placed for the drag's slope at rest; where there are none, or these leave some axis of the intervals unstable or beyond
    /// the limit, for the least slope that the intervals leave.
    ///
    /// # Errors
    /// Where some axis of the intervals is not stabilised, with the nearest bandwidth at which all are.
    pub(super) fn new(model: &Model, wanted: &DesignWanted) -> Result<Self, ControlError> {
        let [at_rest, least] = model.slopes_at_rest();
        let designed = |slope: f64| {
            let bandwidth_rad_s = match wanted.target {
                Target::BandwidthRadS(asked_rad_s) => asked_rad_s,
                _ => largest_bandwidth(model, wanted, slope)?,
            };
            Self::at(model, wanted, slope, bandwidth_rad_s)
        };
        let error = match designed(at_rest) {
            Err(error) if ["unstable", "out-of-reach", "overdamped", "no-bandwidth"].contains(&error.code()) => error,
            other => return other,
        };
        if let Ok(tuned) = designed(least) {
            return Ok(tuned);
        }
        Err(match (error, wanted.target) {
            (
                ControlError::NotStabilised { alpha, drag, delay_s, .. }
                | ControlError::Unstable { alpha, drag, delay_s, .. },
                Target::BandwidthRadS(asked_rad_s),
            ) => {
                let stabilised_rad_s =
                    [at_rest, least].into_iter().find_map(|slope| stabilised(model, wanted, slope, asked_rad_s));
                ControlError::NotStabilised { alpha, drag, delay_s, stabilised_rad_s }
            }
            (other, _) => other,
        })
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

/// The bandwidth nearest to the one asked for whose gains are proved to stabilise every axis of the intervals, to two digits.
fn stabilised(model: &Model, wanted: &DesignWanted, slope: f64, asked_rad_s: f64) -> Option<f64> {
    let axis = model.values().design_axis().ok()?;
    let at = grid(bandwidths(&axis, slope, wanted.structure).ok()?);
    let mut candidates: Vec<f64> = (0..=GRID).filter_map(|k| format!("{:.1e}", at(k)).parse().ok()).collect();
    let far = |bandwidth: &f64| (bandwidth / asked_rad_s).ln().abs();
    candidates.sort_by(|a, b| far(a).total_cmp(&far(b)));
    candidates.into_iter().find(|bandwidth| {
        let Ok(tuning) = Tuning::for_slope(&axis, slope, wanted.structure, *bandwidth) else { return false };
        let Ok(processes) = processes(model, wanted, &tuning) else { return false };
        processes.points_stable(tuning.gains())
            && processes.all_stable(tuning.gains())
            && Tuned::at(model, wanted, slope, *bandwidth).is_ok()
    })
}

/// The largest bandwidth at which the limit is proved for every axis of the intervals.
fn largest_bandwidth(model: &Model, wanted: &DesignWanted, slope: f64) -> Result<f64, ControlError> {
    let axis = model.values().design_axis()?;
    let (least, most) = bandwidths(&axis, slope, wanted.structure)?;
    let criterion = match wanted.target {
        Target::Sensitivity(most) => RobustCriterion::Sensitivity(most),
        Target::PhaseRad(least) => RobustCriterion::PhaseRad(least),
        Target::BandwidthRadS(bandwidth) => return Ok(bandwidth),
    };
    let keeps = |bandwidth: f64| {
        let Ok(tuning) = Tuning::for_slope(&axis, slope, wanted.structure, bandwidth) else { return false };
        processes(model, wanted, &tuning).is_ok_and(|processes| {
            processes.meets(tuning.gains(), criterion) && processes.points_stable(tuning.gains())
        })
    };
    // Slow gains can be worse than fast ones, where drag is uncertain: no bisection from the ends.
    let at = grid((least, most));
    let out_of_reach = ControlError::OutOfReach { least_rad_s: least, most_rad_s: most };
    let Some(first) = (0..=GRID).find(|k| keeps(at(*k))) else { return Err(out_of_reach) };
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
        .ok_or(out_of_reach)
}

/// The range of bandwidths for which there are gains.
fn bandwidths(
    axis: &crate::plant::DragAxis<f64>,
    slope: f64,
    structure: Structure,
) -> Result<(f64, f64), ControlError> {
    // Without delay nothing but the drag's pace limits the range; ten thousand times that is as good as no limit.
    let pace = slope.abs() / axis.alpha();
    let beyond = if axis.delay_s() > 0.0 { 100.0 / axis.delay_s() } else { 1e4 * pace.max(1e-4) };
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
