//! What C calls in double precision. `f32.rs` is made from this file by `check.sh`.

use super::placed::{self, ControllerF64, ExperimentF64};
use super::routines;
use super::status::{Refusal, Refused, Status, answer, given, usable};
use super::values::{
    Axis, ControlStep, ControllerSettings, Delivered, DescribingFunction, ExperimentStep, LimitCycle, Margins,
    MeanCycle, Oscillation, Outcome, Parameters, Process, Protocol, Thruster,
};

/// Describing function of one of `SelfoscCharacteristic` under the input `bias + amplitude sin`, amplitude above 0. `count`
/// parameters, in the order of the catalogue.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_describe_f64(
    characteristic: u32,
    parameters: *const f64,
    count: usize,
    bias: f64,
    amplitude: f64,
    result: *mut DescribingFunction<f64>,
    refusal: *mut Refusal,
) -> Status {
    let call = || {
        if !usable(parameters) {
            return Err(Refused::from(Status::BadPointer));
        }
        // No characteristic has nearly as many; what is beyond is no count.
        if count > 256 {
            return Err(Status::WrongCount.into());
        }
        // SAFETY: good for as many numbers, as the caller says.
        let parameters = unsafe { core::slice::from_raw_parts(parameters, count) };
        routines::describe(characteristic, parameters, bias, amplitude)
    };
    // SAFETY: pointers are null or valid for their targets.
    unsafe { answer(result, refusal, call) }
}

/// Limit cycle of an axis under a relay with hysteresis, by its exact motion.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_limit_cycle_f64(
    axis: *const Axis<f64>,
    relay_level: f64,
    half_width: f64,
    result: *mut LimitCycle<f64>,
    refusal: *mut Refusal,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    unsafe { answer(result, refusal, || routines::limit_cycle(given(axis)?, relay_level, half_width)) }
}

/// Parameters of an axis from an oscillation, by its first harmonic: the paper's method.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_identify_f64(
    oscillation: *const Oscillation<f64>,
    result: *mut Parameters<f64>,
    refusal: *mut Refusal,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    unsafe { answer(result, refusal, || routines::identify(given(oscillation)?)) }
}

/// The axis whose exact limit cycle this is, under one of `SelfoscDragLaw`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_identify_exact_f64(
    cycle: *const MeanCycle<f64>,
    drag_law: u32,
    result: *mut Axis<f64>,
    refusal: *mut Refusal,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    unsafe { answer(result, refusal, || routines::identify_exact(given(cycle)?, drag_law)) }
}

/// An experiment on one of `SelfoscCoordinate` with this relay, that may go `largest_excursion` from its reference, and sound
/// values for the rest. All are finite; no more is checked before the experiment begins.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_protocol_f64(
    coordinate: u32,
    relay_level: f64,
    half_width: f64,
    largest_excursion: f64,
    interval_s: f64,
    result: *mut Protocol<f64>,
    refusal: *mut Refusal,
) -> Status {
    let call = || routines::protocol(coordinate, relay_level, half_width, largest_excursion, interval_s);
    // SAFETY: pointers are null or valid for their targets.
    unsafe { answer(result, refusal, call) }
}

/// Begins an experiment; it starts with its first sample.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_experiment_begin_f64(
    experiment: *mut ExperimentF64,
    protocol: *const Protocol<f64>,
    refusal: *mut Refusal,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    let call = || unsafe { placed::begin(experiment, routines::experiment(given(protocol)?)?) };
    // SAFETY: as above.
    unsafe { answer(&mut (), refusal, call) }
}

/// Takes a reading and its time in s since the start of the experiment: the command to give now. Any numbers at all may come.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_experiment_step_f64(
    experiment: *mut ExperimentF64,
    reading: f64,
    time_s: f64,
    result: *mut ExperimentStep<f64>,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    let call = || Ok(routines::experiment_step(unsafe { placed::held(experiment) }?.step(reading, time_s)));
    // SAFETY: as above.
    unsafe { answer(result, core::ptr::null_mut(), call) }
}

/// The command at a time without a reading, for a timer beside a driver that may block.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_experiment_tick_f64(
    experiment: *mut ExperimentF64,
    time_s: f64,
    result: *mut ExperimentStep<f64>,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    let call = || Ok(routines::experiment_step(unsafe { placed::held(experiment) }?.tick(time_s)));
    // SAFETY: as above.
    unsafe { answer(result, core::ptr::null_mut(), call) }
}

/// Stops an experiment: the command is neutral from now on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_experiment_abort_f64(experiment: *mut ExperimentF64) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    let call = || unsafe { placed::held(experiment) }.map(|experiment| experiment.abort());
    // SAFETY: as above.
    unsafe { answer(&mut (), core::ptr::null_mut(), call) }
}

/// What an experiment found that is done.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_experiment_outcome_f64(
    experiment: *mut ExperimentF64,
    result: *mut Outcome<f64>,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    let call = || routines::outcome(unsafe { placed::held(experiment) }?);
    // SAFETY: as above.
    unsafe { answer(result, core::ptr::null_mut(), call) }
}

/// Gains for one of `SelfoscStructure` on an axis, with this bandwidth in rad/s; the other settings stay as they are.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_tune_f64(
    axis: *const Axis<f64>,
    structure: u32,
    bandwidth_rad_s: f64,
    settings: *mut ControllerSettings<f64>,
    refusal: *mut Refusal,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    let call = || unsafe { routines::tune(given(axis)?, structure, bandwidth_rad_s, given(settings)?) };
    // SAFETY: as above.
    unsafe { answer(settings, refusal, call) }
}

/// A first-order process with dead time, or an integrator, from a record of a relay's or thermostat's oscillation: `count` readings, 24 to
/// 256, at times that rise, each command from its reading's time on. Two periods tell it well; at least three changes of the command.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_process_f64(
    time_s: *const f64,
    output: *const f64,
    command: *const f64,
    count: usize,
    result: *mut Process<f64>,
    refusal: *mut Refusal,
) -> Status {
    let call = || {
        if ![time_s, output, command].into_iter().all(usable) {
            return Err(Refused::from(Status::BadPointer));
        }
        if count > routines::MOST_READINGS {
            return Err(Status::WrongCount.into());
        }
        // SAFETY: good for as many numbers, as the caller says.
        let [time_s, output, command] =
            [time_s, output, command].map(|column| unsafe { core::slice::from_raw_parts(column, count) });
        routines::process(time_s, output, command)
    };
    // SAFETY: pointers are null or good for what they point at.
    unsafe { answer(result, refusal, call) }
}

/// PID gains for a process, by a rule whose largest sensitivity is at most 1.5 for every process of this structure, under a controller that
/// holds its command for `interval_s`; the other settings stay as they are.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_process_gains_f64(
    process: *const Process<f64>,
    interval_s: f64,
    settings: *mut ControllerSettings<f64>,
    refusal: *mut Refusal,
) -> Status {
    // SAFETY: pointers are null or good for what they point at.
    let call = || unsafe { routines::process_gains(given(process)?, interval_s, given(settings)?) };
    // SAFETY: as above.
    unsafe { answer(settings, refusal, call) }
}

/// Margins of the loop that `selfosc_tune_f64` makes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_margins_f64(
    axis: *const Axis<f64>,
    structure: u32,
    bandwidth_rad_s: f64,
    result: *mut Margins<f64>,
    refusal: *mut Refusal,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    unsafe { answer(result, refusal, || routines::tuned_margins(given(axis)?, structure, bandwidth_rad_s)) }
}

/// Begins a controller.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_controller_begin_f64(
    controller: *mut ControllerF64,
    settings: *const ControllerSettings<f64>,
    refusal: *mut Refusal,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    let call = || unsafe { placed::begin(controller, routines::controller(given(settings)?)?) };
    // SAFETY: as above.
    unsafe { answer(&mut (), refusal, call) }
}

/// Leads a controller along a reference that the axis can follow, with the force that takes. `pace_rad_s` is how fast the
/// reference answers, `top_speed` its largest speed, 0 for none. Starts anew.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_controller_feed_forward_f64(
    controller: *mut ControllerF64,
    axis: *const Axis<f64>,
    pace_rad_s: f64,
    top_speed: f64,
    refusal: *mut Refusal,
) -> Status {
    let call = || {
        // SAFETY: pointers are null or valid for their targets.
        let (controller, axis) = unsafe { (placed::held(controller)?, given(axis)?) };
        *controller = routines::feed_forward(controller, axis, pace_rad_s, top_speed)?;
        Ok(())
    };
    // SAFETY: as above.
    unsafe { answer(&mut (), refusal, call) }
}

/// The next command, given the time since the step before, good or not. Any numbers at all may come.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_controller_step_f64(
    controller: *mut ControllerF64,
    reference: f64,
    measurement: f64,
    dt_s: f64,
    result: *mut ControlStep<f64>,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    let held = || unsafe { placed::held(controller) };
    let call = || Ok(routines::controller_step(held()?.step(reference, measurement, dt_s)));
    // SAFETY: as above.
    unsafe { answer(result, core::ptr::null_mut(), call) }
}

/// Lets a controller forget everything but its settings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_controller_reset_f64(controller: *mut ControllerF64) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    let call = || unsafe { placed::held(controller) }.map(|controller| controller.reset());
    // SAFETY: as above.
    unsafe { answer(&mut (), core::ptr::null_mut(), call) }
}

/// Thrust in N at a command.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_thruster_thrust_f64(
    thruster: *const Thruster<f64>,
    command: f64,
    result: *mut f64,
    refusal: *mut Refusal,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    unsafe { answer(result, refusal, || routines::thrust(given(thruster)?, command)) }
}

/// The command that gives a thrust in N; refused within the dead zone and beyond the limit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_thruster_command_f64(
    thruster: *const Thruster<f64>,
    thrust_n: f64,
    result: *mut f64,
    refusal: *mut Refusal,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    unsafe { answer(result, refusal, || routines::thruster_command(given(thruster)?, thrust_n)) }
}

/// The command whose thrust is nearest, and that thrust.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selfosc_thruster_command_clamped_f64(
    thruster: *const Thruster<f64>,
    thrust_n: f64,
    result: *mut Delivered<f64>,
    refusal: *mut Refusal,
) -> Status {
    // SAFETY: pointers are null or valid for their targets.
    unsafe { answer(result, refusal, || routines::thruster_command_clamped(given(thruster)?, thrust_n)) }
}
