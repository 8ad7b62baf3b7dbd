//! Plain structures that go in and out. Numbers are of the precision that the structure's name ends in.

use super::status::Text;

/// The catalogue. Parameters of each, in their order, are on its page in `spec/characteristics`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Characteristic {
    /// `level`
    Relay = 0,
    /// `level`, `dead_zone`
    RelayDeadZone = 1,
    /// `level`, `half_width`, `offset`
    RelayHysteresis = 2,
    /// `level`, `on`, `off`
    RelayDeadZoneHysteresis = 3,
    /// `slope`, `breakpoint`
    Saturation = 4,
    /// `slope`, `lower`, `upper`
    SaturationAsymmetric = 5,
    /// `slope`, `half_width`
    DeadZone = 6,
    /// `slope`, `half_width`, `breakpoint`
    DeadZoneSaturation = 7,
    /// `inner_slope`, `outer_slope`, `breakpoint`
    GainChanging = 8,
    /// `slope`, `level`
    Preload = 9,
    /// `step`
    Quantizer = 10,
    /// `gain`, `exponent`
    Power = 11,
    /// `c0` to `c9`
    Polynomial = 12,
    /// `gain`, `frequency`
    Sine = 13,
    /// `gain`, `scale`
    Sinh = 14,
    /// `gain`, `scale`
    Arctan = 15,
    /// `gain`, `scale`
    Tanh = 16,
    /// `gain`
    Absolute = 17,
    /// `left_slope`, `right_slope`, then the points `x0`, `y0`, `x1`, `y1`, ...: 32 points at most.
    PiecewiseLinear = 18,
    /// `slope`, `half_gap`
    Backlash = 19,
}

/// A parameter of a characteristic.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: Text,
    /// Meaning and unit.
    pub meaning: Text,
    /// The numbers it may be, in words.
    pub domain: Text,
}

/// Mean and complex gain of a characteristic's output: `f0 + amplitude (p sin + q cos)`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DescribingFunction<T> {
    /// Mean of the output.
    pub f0: T,
    /// In-phase gain.
    pub p: T,
    /// Quadrature gain.
    pub q: T,
}

/// One degree of freedom: `alpha x'' + linear_drag x' + quadratic_drag x' |x'| = command(t - delay_s) + disturbance`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Axis<T> {
    /// Inertia with added mass, above 0.
    pub alpha: T,
    /// Force per speed, 0 or more.
    pub linear_drag: T,
    /// Force per squared speed, 0 or more.
    pub quadratic_drag: T,
    /// Constant force, in command units.
    pub disturbance: T,
    /// Delay of the whole loop, s.
    pub delay_s: T,
}

/// The limit cycle of an axis under a relay with hysteresis.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct LimitCycle<T> {
    /// Half the range.
    pub amplitude: T,
    /// Middle of the range.
    pub bias: T,
    /// Period, s.
    pub period_s: T,
    /// Time with the positive command, s.
    pub time_positive_s: T,
    /// Time with the negative command, s.
    pub time_negative_s: T,
    /// The factor of a deviation over a period.
    pub multiplier: T,
}

/// The quantities from which the paper's identification starts.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Oscillation<T> {
    /// Relay level, in command units.
    pub relay_level: T,
    /// Level at which the command really switched, in coordinate units.
    pub switch_level: T,
    /// Half the range, in coordinate units.
    pub amplitude: T,
    /// Middle of the range against the middle of the switching levels.
    pub bias: T,
    /// Period, s.
    pub period_s: T,
    /// Delay of the whole loop, s.
    pub delay_s: T,
}

/// Parameters of an axis under each drag law, by the first harmonic.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Parameters<T> {
    /// Inertia with added mass.
    pub alpha: T,
    /// Linear drag, if drag is linear.
    pub beta: T,
    /// Quadratic drag, if drag is quadratic.
    pub beta_quadratic: T,
    /// Constant force, in command units.
    pub disturbance: T,
}

/// The quantities from which the identification by exact limit cycles starts.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MeanCycle<T> {
    /// Relay level, in command units.
    pub relay_level: T,
    /// Level at which the command really switched, in coordinate units.
    pub switch_level: T,
    /// Half the range, in coordinate units.
    pub amplitude: T,
    /// Time with the positive command, s.
    pub time_positive_s: T,
    /// Time with the negative command, s.
    pub time_negative_s: T,
    /// Delay of the whole loop, s.
    pub delay_s: T,
}

/// How drag depends on speed.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DragLaw {
    /// In proportion.
    Linear = 0,
    /// As its square.
    Quadratic = 1,
}

/// The measured quantity.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// The coordinate itself.
    Position = 0,
    /// A heading in radians, which may jump by whole turns.
    HeadingRad = 1,
    /// A heading in degrees, which may jump by whole turns.
    HeadingDegrees = 2,
    /// A speed; the relay is fed with its integral.
    Speed = 3,
}

/// An experiment on board: relay, limits, and when it is done. `selfosc_protocol_f64` fills it with sound values to start from.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Protocol<T> {
    /// One of `SelfoscCoordinate`.
    pub coordinate: u32,
    /// Value of the coordinate to oscillate about.
    pub reference: T,
    /// Command before, afterwards and upon a fault.
    pub neutral_command: T,
    /// Middle of the relay's two levels less the neutral command; a disturbance is counted from the middle.
    pub relay_offset: T,
    /// Least command that is ever given.
    pub lowest_command: T,
    /// Largest command that is ever given.
    pub highest_command: T,
    /// Relay level of the first attempt, in command units.
    pub relay_level: T,
    /// Half-width of the hysteresis in the first attempt, in coordinate units.
    pub half_width: T,
    /// The coordinate may be this far from the reference; a reading further off is a fault.
    pub largest_excursion: T,
    /// Before the first switching the coordinate may fall back by this distance.
    pub wrong_way: T,
    /// The relay keeps an output for at least this long, s.
    pub dwell_s: T,
    /// Time between samples as planned, s; a gap of more than four is a fault.
    pub interval_s: T,
    /// Step of the sensor, or a few standard deviations of its noise.
    pub resolution: T,
    /// Largest rate of change of the reading that the vehicle is capable of, per s.
    pub largest_rate: T,
    /// A reading unchanged for longer is a fault, s.
    pub unchanged_s: T,
    /// An attempt fails where the relay has not switched for longer, s, or for four times the longest half-period seen.
    pub patience_s: T,
    /// The experiment is broken off after this time, s.
    pub duration_s: T,
    /// How alike cycles have to be, relative.
    pub spread: T,
    /// Factor between the relay parameters of two attempts, above 1.
    pub factor: T,
    /// Cycles in a row that have to be alike, 2 or more.
    pub cycles: u8,
    /// An attempt fails after so many cycles.
    pub most_cycles: u8,
    /// Attempts in all.
    pub attempts: u8,
}

/// Where an experiment stands.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The relay acts.
    Running = 0,
    /// Steady cycles were found; the command is neutral.
    Done = 1,
    /// It was told to stop; the command is neutral.
    Aborted = 2,
    /// Something went wrong; the command is neutral.
    Failed = 3,
}

/// The answer to a sample of the experiment.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ExperimentStep<T> {
    /// Command to give now, within the limits whatever the phase.
    pub command: T,
    /// Where the experiment stands.
    pub phase: Phase,
    /// Short name of what went wrong: `excursion`, `wrong-way`, `gap`, ...; none unless failed.
    pub fault: Text,
}

/// Mean and standard deviation over cycles.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct CycleStatistics<T> {
    /// Mean.
    pub mean: T,
    /// Standard deviation of one cycle's value, not of the mean.
    pub std: T,
}

/// The result of a finished experiment.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Outcome<T> {
    /// Half the range, in coordinate units.
    pub amplitude: CycleStatistics<T>,
    /// Middle of the range against the middle of the switching levels.
    pub bias: CycleStatistics<T>,
    /// Period, s.
    pub period_s: CycleStatistics<T>,
    /// Level at which the command really switched, in coordinate units.
    pub switch_level: CycleStatistics<T>,
    /// Time with the positive command, s.
    pub time_positive_s: CycleStatistics<T>,
    /// Time with the negative command, s.
    pub time_negative_s: CycleStatistics<T>,
    /// Relay level of the last attempt, in command units.
    pub relay_level: T,
    /// Half-width of the last attempt, in coordinate units.
    pub half_width: T,
    /// Cycles that the means are over.
    pub cycles: u32,
    /// Attempts it took.
    pub attempts: u32,
}

/// On what the actions of a controller act; the derivative always acts on the measurement.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// Proportional to the error; no integral.
    Pd = 0,
    /// Proportional to the error, with its integral.
    Pid = 1,
    /// Integral of the error; proportional to the measurement.
    Ipd = 2,
}

/// Gains and limits of a controller. `selfosc_tune_f64` fills in the gains.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ControllerSettings<T> {
    /// One of `SelfoscStructure`.
    pub structure: u32,
    /// Command per coordinate, above 0.
    pub proportional: T,
    /// Command per coordinate and s; 0 for a PD, above 0 for an I-PD.
    pub integral: T,
    /// Command per coordinate per s, 0 or more.
    pub derivative: T,
    /// Time constant of the filter on the derivative, s; 0 for none.
    pub filter_s: T,
    /// Least command.
    pub lowest_command: T,
    /// Largest command.
    pub highest_command: T,
    /// Length of a turn for a coordinate on a circle, such as 2 pi or 360; 0 on a line.
    pub turn: T,
    /// A command is held without a good step for no longer than this, s.
    pub longest_hold_s: T,
    /// The command after that, cut to the limits.
    pub neutral_command: T,
}

/// `drag y' + stiffness y = u(t - dead_time_s) + load`: a first-order process of gain `1/stiffness` and time constant `drag/stiffness`;
/// an integrator of gain `1/drag` where `stiffness` is 0.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Process<T> {
    /// Command s per output, above 0.
    pub drag: T,
    /// Command per output, 0 or more.
    pub stiffness: T,
    /// Dead time, s, 0 or more.
    pub dead_time_s: T,
    /// Whether the output falls with the command: 1 or 0. The numbers are then those of the command with its sign turned, which is also
    /// the command to give.
    pub reverse: u32,
}

/// What a stable loop stands before it is critical.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Margins<T> {
    /// The gain may grow by less than this factor; 0 where any growth is borne.
    pub gain: T,
    /// The gain may be divided by less than this factor; 0 where any cut is borne.
    pub gain_reduction: T,
    /// The phase may lag or lead by less than this more, rad.
    pub phase_rad: T,
    /// The delay may grow by less than this, s.
    pub delay_s: T,
    /// Where `|L| = 1` and the delay margin is met, rad/s.
    pub crossover_rad_s: T,
}

/// Why a controller held its command.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControlFault {
    /// It did not: the step was good.
    None = 0,
    /// The reference is not a finite number.
    Reference = 1,
    /// The measurement is not a finite number.
    Measurement = 2,
    /// The interval is not a finite number above zero.
    Interval = 3,
    /// The command would not be a finite number.
    Overflow = 4,
}

/// The result of a step of a controller.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ControlStep<T> {
    /// The command, within the limits in any case.
    pub command: T,
    /// Whether a limit holds the command back: 1 or 0.
    pub limited: u32,
    /// Why the command is held, if it is.
    pub fault: ControlFault,
}

/// Thrust by command on one side, `(quadratic n + linear) n` from the dead zone to the limit. Magnitudes all.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ThrustSide<T> {
    /// N per squared command.
    pub quadratic: T,
    /// N per command.
    pub linear: T,
    /// Command at which the propeller starts, 0 or more.
    pub dead_zone: T,
    /// Largest command.
    pub limit: T,
}

/// A thruster in still water.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Thruster<T> {
    /// Under positive commands.
    pub forward: ThrustSide<T>,
    /// Under negative commands.
    pub backward: ThrustSide<T>,
}

/// What a thruster is told, and what it then gives.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Delivered<T> {
    /// Command.
    pub command: T,
    /// Thrust, N.
    pub thrust_n: T,
}
