//! What C calls, over either precision.

use selfosc::autotune::{FirstOrderProcess, ProcessReadings};
use selfosc::control::{ControlFault as Fault, Controller, FeedForward, Gains, Tuning};
use selfosc::describing::ClosedForm;
use selfosc::identify::{exact, iso};
use selfosc::nonlinearity as catalogue;
use selfosc::nonlinearity::{Catalogued, Polyline, RelayHysteresis, Sinusoid};
use selfosc::numeric::{Scalar, Special};
use selfosc::on_board::{Experiment, Phase as Stage};
use selfosc::orbit;
use selfosc::plant::DragAxis;
use selfosc::vehicle;

use super::status::{Refused, Status, Text};
use super::values::{
    Axis, ControlFault, ControlStep, ControllerSettings, Coordinate, CycleStatistics, Delivered, DescribingFunction,
    DragLaw, ExperimentStep, LimitCycle, Margins, MeanCycle, Oscillation, Outcome, Parameter, Parameters, Phase,
    Process, Protocol, Structure, ThrustSide, Thruster,
};

/// ProcessReadings of a process on board.
pub(crate) const MOST_READINGS: usize = ProcessReadings::<f64>::MOST;
/// Points of a piecewise linear characteristic.
const MOST_POINTS: usize = 32;

/// Calls a macro with every entry of the catalogue that has a fixed number of parameters.
macro_rules! catalogued {
    ($callback:ident) => {
        $callback! {
            Relay, RelayDeadZone, RelayHysteresis, RelayDeadZoneHysteresis, Saturation, SaturationAsymmetric, DeadZone,
            DeadZoneSaturation, GainChanging, Preload, Quantizer, Power, Polynomial, Sine, Sinh, Arctan, Tanh, Absolute,
            Backlash,
        }
    };
}

pub(crate) fn describe<T: Scalar + Special>(
    characteristic: u32,
    parameters: &[T],
    bias: T,
    amplitude: T,
) -> Result<DescribingFunction<T>, Refused> {
    use super::values::Characteristic as Id;
    let sweep = Sinusoid::new(bias, amplitude)?;
    macro_rules! choose {
        ($($name:ident),+ $(,)?) => {
            match characteristic {
                $(chosen if chosen == Id::$name as u32 => {
                    if parameters.len() != <catalogue::$name<T> as Catalogued<T>>::PARAMETERS.len() {
                        return Err(Status::WrongCount.into());
                    }
                    <catalogue::$name<T>>::from_values(parameters)?.describing_function(&sweep)?
                })+
                chosen if chosen == Id::PiecewiseLinear as u32 => polyline(parameters, &sweep)?,
                _ => return Err(Status::UnknownChoice.into()),
            }
        };
    }
    let df = catalogued!(choose);
    Ok(DescribingFunction { f0: df.f0, p: df.p, q: df.q })
}

fn polyline<T: Scalar>(
    parameters: &[T],
    sweep: &Sinusoid<T>,
) -> Result<selfosc::describing::DescribingFunction<T>, Refused> {
    let [left_slope, right_slope, coordinates @ ..] = parameters else { return Err(Status::WrongCount.into()) };
    let (pairs, rest) = coordinates.as_chunks::<2>();
    let mut points = [(T::zero(), T::zero()); MOST_POINTS];
    let Some(used) = points.get_mut(..pairs.len()).filter(|_| rest.is_empty()) else {
        return Err(Status::WrongCount.into());
    };
    for (point, [x, y]) in used.iter_mut().zip(pairs) {
        *point = (*x, *y);
    }
    Ok(Polyline::new(&*used, *left_slope, *right_slope)?.describing_function(sweep)?)
}

pub(crate) fn parameter(characteristic: u32, index: usize) -> Result<Parameter, Refused> {
    use super::values::Characteristic as Id;
    macro_rules! choose {
        ($($name:ident),+ $(,)?) => {
            match characteristic {
                $(chosen if chosen == Id::$name as u32 => <catalogue::$name<f64> as Catalogued<f64>>::PARAMETERS,)+
                _ => return Err(Status::UnknownChoice.into()),
            }
        };
    }
    let parameters = catalogued!(choose);
    let parameter = parameters.get(index).ok_or(Status::WrongCount)?;
    let (name, meaning, domain) = (parameter.name, parameter.meaning, parameter.domain.words());
    Ok(Parameter { name: Text::of(name), meaning: Text::of(meaning), domain: Text::of(domain) })
}

impl<T: Scalar> Axis<T> {
    fn checked(&self) -> Result<DragAxis<T>, Refused> {
        let axis = DragAxis::mixed(self.alpha, self.linear_drag, self.quadratic_drag)?;
        Ok(axis.with_disturbance(self.disturbance)?.with_delay_s(self.delay_s)?)
    }
}

pub(crate) fn limit_cycle<T: Scalar>(axis: &Axis<T>, relay_level: T, half_width: T) -> Result<LimitCycle<T>, Refused> {
    let relay = RelayHysteresis::new(relay_level, half_width, T::zero())?;
    let cycle = orbit::limit_cycle(&axis.checked()?, &relay)?;
    Ok(LimitCycle {
        amplitude: cycle.amplitude,
        bias: cycle.bias,
        period_s: cycle.period_s,
        time_positive_s: cycle.time_positive_s,
        time_negative_s: cycle.time_negative_s,
        multiplier: cycle.multiplier,
    })
}

pub(crate) fn identify<T: Scalar>(oscillation: &Oscillation<T>) -> Result<Parameters<T>, Refused> {
    let Oscillation { relay_level, switch_level, amplitude, bias, period_s, delay_s } = *oscillation;
    let found = iso::Oscillation { relay_level, switch_level, amplitude, bias, period_s, delay_s }.identify()?;
    Ok(Parameters {
        alpha: found.alpha,
        beta: found.beta,
        beta_quadratic: found.beta_quadratic,
        disturbance: found.disturbance,
    })
}

pub(crate) fn identify_exact<T: Scalar>(cycle: &MeanCycle<T>, law: u32) -> Result<Axis<T>, Refused> {
    let MeanCycle { relay_level, switch_level, amplitude, time_positive_s, time_negative_s, delay_s } = *cycle;
    let cycle = exact::MeanCycle { relay_level, switch_level, amplitude, time_positive_s, time_negative_s, delay_s };
    let axis = if law == DragLaw::Linear as u32 {
        cycle.linear_drag()?
    } else if law == DragLaw::Quadratic as u32 {
        cycle.quadratic_drag()?
    } else {
        return Err(Status::UnknownChoice.into());
    };
    Ok(Axis {
        alpha: axis.alpha(),
        linear_drag: axis.linear_drag(),
        quadratic_drag: axis.quadratic_drag(),
        disturbance: axis.disturbance(),
        delay_s: axis.delay_s(),
    })
}

const COORDINATES: [(Coordinate, selfosc::on_board::Coordinate); 4] = [
    (Coordinate::Position, selfosc::on_board::Coordinate::Position),
    (Coordinate::HeadingRad, selfosc::on_board::Coordinate::HeadingRad),
    (Coordinate::HeadingDegrees, selfosc::on_board::Coordinate::HeadingDegrees),
    (Coordinate::Speed, selfosc::on_board::Coordinate::Speed),
];

fn coordinate(chosen: u32) -> Result<selfosc::on_board::Coordinate, Refused> {
    let found = COORDINATES.iter().find(|(coordinate, _)| *coordinate as u32 == chosen);
    found.map(|(_, coordinate)| *coordinate).ok_or(Status::UnknownChoice.into())
}

pub(crate) fn protocol<T: Scalar>(
    coordinate_chosen: u32,
    relay_level: T,
    half_width: T,
    largest_excursion: T,
    interval_s: T,
) -> Result<Protocol<T>, Refused> {
    let all = selfosc::on_board::Protocol::new(
        coordinate(coordinate_chosen)?,
        relay_level,
        half_width,
        largest_excursion,
        interval_s,
    );
    Ok(Protocol {
        coordinate: coordinate_chosen,
        reference: all.reference,
        neutral_command: all.neutral_command,
        relay_offset: all.relay_offset,
        lowest_command: all.lowest_command,
        highest_command: all.highest_command,
        relay_level: all.relay_level,
        half_width: all.half_width,
        largest_excursion: all.largest_excursion,
        wrong_way: all.wrong_way,
        dwell_s: all.dwell_s,
        interval_s: all.interval_s,
        resolution: all.resolution,
        largest_rate: all.largest_rate,
        unchanged_s: all.unchanged_s,
        patience_s: all.patience_s,
        duration_s: all.duration_s,
        spread: all.spread,
        factor: all.factor,
        cycles: all.cycles,
        most_cycles: all.most_cycles,
        attempts: all.attempts,
    })
}

pub(crate) fn experiment<T: Scalar>(all: &Protocol<T>) -> Result<Experiment<T>, Refused> {
    Ok(Experiment::new(selfosc::on_board::Protocol {
        coordinate: coordinate(all.coordinate)?,
        reference: all.reference,
        neutral_command: all.neutral_command,
        relay_offset: all.relay_offset,
        lowest_command: all.lowest_command,
        highest_command: all.highest_command,
        relay_level: all.relay_level,
        half_width: all.half_width,
        largest_excursion: all.largest_excursion,
        wrong_way: all.wrong_way,
        dwell_s: all.dwell_s,
        interval_s: all.interval_s,
        resolution: all.resolution,
        largest_rate: all.largest_rate,
        unchanged_s: all.unchanged_s,
        patience_s: all.patience_s,
        duration_s: all.duration_s,
        cycles: all.cycles,
        spread: all.spread,
        most_cycles: all.most_cycles,
        attempts: all.attempts,
        factor: all.factor,
    })?)
}

pub(crate) fn experiment_step<T: Scalar>(step: selfosc::on_board::Step<T>) -> ExperimentStep<T> {
    let (phase, fault) = match step.phase {
        Stage::Running => (Phase::Running, Text::NONE),
        Stage::Done => (Phase::Done, Text::NONE),
        Stage::Aborted => (Phase::Aborted, Text::NONE),
        Stage::Failed(fault) => (Phase::Failed, Text::of(fault.code())),
    };
    ExperimentStep { command: step.command, phase, fault }
}

pub(crate) fn outcome<T: Scalar>(experiment: &Experiment<T>) -> Result<Outcome<T>, Refused> {
    let found = experiment.outcome().ok_or(Status::NotDone)?;
    let statistics = |of: selfosc::features::CycleStatistics<T>| CycleStatistics { mean: of.mean, std: of.std };
    Ok(Outcome {
        amplitude: statistics(found.features.amplitude),
        bias: statistics(found.features.bias),
        period_s: statistics(found.features.period_s),
        switch_level: statistics(found.features.switch_level),
        time_positive_s: statistics(found.features.time_positive_s),
        time_negative_s: statistics(found.features.time_negative_s),
        relay_level: found.relay_level,
        half_width: found.half_width,
        cycles: found.features.cycles,
        attempts: found.attempts.into(),
    })
}

const STRUCTURES: [(Structure, selfosc::control::Structure); 3] = [
    (Structure::Pd, selfosc::control::Structure::Pd),
    (Structure::Pid, selfosc::control::Structure::Pid),
    (Structure::Ipd, selfosc::control::Structure::Ipd),
];

fn structure(chosen: u32) -> Result<selfosc::control::Structure, Refused> {
    let found = STRUCTURES.iter().find(|(structure, _)| *structure as u32 == chosen);
    found.map(|(_, structure)| *structure).ok_or(Status::UnknownChoice.into())
}

fn tuned<T: Scalar>(axis: &Axis<T>, chosen: u32, bandwidth_rad_s: T) -> Result<Tuning<T>, Refused> {
    Ok(Tuning::new(&axis.checked()?, structure(chosen)?, bandwidth_rad_s)?)
}

pub(crate) fn tune<T: Scalar>(
    axis: &Axis<T>,
    chosen: u32,
    bandwidth_rad_s: T,
    settings: &ControllerSettings<T>,
) -> Result<ControllerSettings<T>, Refused> {
    let gains = *tuned(axis, chosen, bandwidth_rad_s)?.gains();
    Ok(ControllerSettings {
        structure: chosen,
        proportional: gains.proportional(),
        integral: gains.integral(),
        derivative: gains.derivative(),
        filter_s: gains.filter_s(),
        ..*settings
    })
}

pub(crate) fn process<T: Scalar>(time_s: &[T], output: &[T], command: &[T]) -> Result<Process<T>, Refused> {
    let FirstOrderProcess { drag, stiffness, dead_time_s, reverse } =
        ProcessReadings::new(time_s, output, command)?.first_order()?;
    Ok(Process { drag, stiffness, dead_time_s, reverse: reverse.into() })
}

pub(crate) fn process_gains<T: Scalar>(
    process: &Process<T>,
    interval_s: T,
    settings: &ControllerSettings<T>,
) -> Result<ControllerSettings<T>, Refused> {
    let Process { drag, stiffness, dead_time_s, reverse } = *process;
    let process = FirstOrderProcess { drag, stiffness, dead_time_s, reverse: reverse != 0 };
    let gains = process.gains(interval_s)?;
    Ok(ControllerSettings {
        structure: Structure::Pid as u32,
        proportional: gains.proportional(),
        integral: gains.integral(),
        derivative: gains.derivative(),
        filter_s: gains.filter_s(),
        ..*settings
    })
}

pub(crate) fn tuned_margins<T: Scalar>(axis: &Axis<T>, chosen: u32, bandwidth_rad_s: T) -> Result<Margins<T>, Refused> {
    let margins = *tuned(axis, chosen, bandwidth_rad_s)?.margins();
    Ok(Margins {
        gain: margins.gain.unwrap_or(T::zero()),
        gain_reduction: margins.gain_reduction.unwrap_or(T::zero()),
        phase_rad: margins.phase_rad,
        delay_s: margins.delay_s,
        crossover_rad_s: margins.crossover_rad_s,
    })
}

pub(crate) fn controller<T: Scalar>(settings: &ControllerSettings<T>) -> Result<Controller<T>, Refused> {
    let gains = Gains::new(
        structure(settings.structure)?,
        settings.proportional,
        settings.integral,
        settings.derivative,
        settings.filter_s,
    )?;
    let controller = Controller::new(&gains)
        .with_limits(settings.lowest_command, settings.highest_command)?
        .with_longest_hold(settings.longest_hold_s, settings.neutral_command)?;
    if settings.turn == T::zero() { Ok(controller) } else { Ok(controller.on_circle(settings.turn)?) }
}

pub(crate) fn feed_forward<T: Scalar>(
    controller: &Controller<T>,
    axis: &Axis<T>,
    pace_rad_s: T,
    top_speed: T,
) -> Result<Controller<T>, Refused> {
    let top_speed = if top_speed == T::zero() { None } else { Some(top_speed) };
    Ok(controller.with_feed_forward(FeedForward::new(&axis.checked()?, pace_rad_s, top_speed)?))
}

pub(crate) fn controller_step<T: Scalar>(step: selfosc::control::ControlStep<T>) -> ControlStep<T> {
    let fault = match step.fault {
        None => ControlFault::None,
        Some(Fault::Reference) => ControlFault::Reference,
        Some(Fault::Measurement) => ControlFault::Measurement,
        Some(Fault::Interval) => ControlFault::Interval,
        Some(_) => ControlFault::Overflow,
    };
    ControlStep { command: step.command, limited: step.limited.into(), fault }
}

impl<T: Scalar> Thruster<T> {
    fn checked(&self) -> Result<vehicle::Thruster<T>, Refused> {
        let side =
            |side: &ThrustSide<T>| vehicle::ThrustSide::new(side.quadratic, side.linear, side.dead_zone, side.limit);
        Ok(vehicle::Thruster::asymmetric(side(&self.forward)?, side(&self.backward)?))
    }
}

pub(crate) fn thrust<T: Scalar>(thruster: &Thruster<T>, command: T) -> Result<T, Refused> {
    if !command.is_finite() {
        return Err(Status::OutOfDomain.into());
    }
    Ok(thruster.checked()?.thrust(command))
}

pub(crate) fn thruster_command<T: Scalar>(thruster: &Thruster<T>, thrust_n: T) -> Result<T, Refused> {
    Ok(thruster.checked()?.command(thrust_n)?)
}

pub(crate) fn thruster_command_clamped<T: Scalar>(
    thruster: &Thruster<T>,
    thrust_n: T,
) -> Result<Delivered<T>, Refused> {
    let delivered = thruster.checked()?.command_clamped(thrust_n)?;
    Ok(Delivered { command: delivered.command, thrust_n: delivered.thrust_n })
}
