/* Describing functions, limit cycles, relay experiments on board, identification and controllers.
 *
 * Nothing here allocates, blocks or keeps a global state. Every function returns a status and leaves its results
 * untouched unless that is SELFOSC_STATUS_OK. The names end in the precision, _f32 or _f64. README.md has a guide. */

#ifndef SELFOSC_H
#define SELFOSC_H

/* Made by cbindgen from src/, held by check.sh: do not edit. */

#include <stddef.h>
#include <stdint.h>

// What every function answers. Unless it is `SELFOSC_STATUS_OK`, no result was written.
typedef enum {
  // Results are written.
  SELFOSC_STATUS_OK = 0,
  // A pointer that must not be null is, or is not aligned as its type is.
  SELFOSC_STATUS_BAD_POINTER = 1,
  // A structure was not begun.
  SELFOSC_STATUS_NOT_BEGUN = 2,
  // A number chooses nothing: characteristic, coordinate, structure of the controller, drag law.
  SELFOSC_STATUS_UNKNOWN_CHOICE = 3,
  // More or fewer parameters than the characteristic has.
  SELFOSC_STATUS_WRONG_COUNT = 4,
  // A number is outside its domain: the refusal says which.
  SELFOSC_STATUS_OUT_OF_DOMAIN = 5,
  // There is no answer: the refusal says why.
  SELFOSC_STATUS_REFUSED = 6,
  // The experiment is not done, so it has no outcome.
  SELFOSC_STATUS_NOT_DONE = 7,
} SelfoscStatus;

// Where an experiment stands.
typedef enum {
  // The relay acts.
  SELFOSC_PHASE_RUNNING = 0,
  // Steady cycles were found; the command is neutral.
  SELFOSC_PHASE_DONE = 1,
  // It was told to stop; the command is neutral.
  SELFOSC_PHASE_ABORTED = 2,
  // Something went wrong; the command is neutral.
  SELFOSC_PHASE_FAILED = 3,
} SelfoscPhase;

// Why a controller held its command.
typedef enum {
  // It did not: the step was good.
  SELFOSC_CONTROL_FAULT_NONE = 0,
  // The reference is not a finite number.
  SELFOSC_CONTROL_FAULT_REFERENCE = 1,
  // The measurement is not a finite number.
  SELFOSC_CONTROL_FAULT_MEASUREMENT = 2,
  // The interval is not a finite number above zero.
  SELFOSC_CONTROL_FAULT_INTERVAL = 3,
  // The command would not be a finite number.
  SELFOSC_CONTROL_FAULT_OVERFLOW = 4,
} SelfoscControlFault;

// The catalogue. Parameters of each, in their order, are on its page in `spec/characteristics`.
typedef enum {
  // `level`
  SELFOSC_CHARACTERISTIC_RELAY = 0,
  // `level`, `dead_zone`
  SELFOSC_CHARACTERISTIC_RELAY_DEAD_ZONE = 1,
  // `level`, `half_width`, `offset`
  SELFOSC_CHARACTERISTIC_RELAY_HYSTERESIS = 2,
  // `level`, `on`, `off`
  SELFOSC_CHARACTERISTIC_RELAY_DEAD_ZONE_HYSTERESIS = 3,
  // `slope`, `breakpoint`
  SELFOSC_CHARACTERISTIC_SATURATION = 4,
  // `slope`, `lower`, `upper`
  SELFOSC_CHARACTERISTIC_SATURATION_ASYMMETRIC = 5,
  // `slope`, `half_width`
  SELFOSC_CHARACTERISTIC_DEAD_ZONE = 6,
  // `slope`, `half_width`, `breakpoint`
  SELFOSC_CHARACTERISTIC_DEAD_ZONE_SATURATION = 7,
  // `inner_slope`, `outer_slope`, `breakpoint`
  SELFOSC_CHARACTERISTIC_GAIN_CHANGING = 8,
  // `slope`, `level`
  SELFOSC_CHARACTERISTIC_PRELOAD = 9,
  // `step`
  SELFOSC_CHARACTERISTIC_QUANTIZER = 10,
  // `gain`, `exponent`
  SELFOSC_CHARACTERISTIC_POWER = 11,
  // `c0` to `c9`
  SELFOSC_CHARACTERISTIC_POLYNOMIAL = 12,
  // `gain`, `frequency`
  SELFOSC_CHARACTERISTIC_SINE = 13,
  // `gain`, `scale`
  SELFOSC_CHARACTERISTIC_SINH = 14,
  // `gain`, `scale`
  SELFOSC_CHARACTERISTIC_ARCTAN = 15,
  // `gain`, `scale`
  SELFOSC_CHARACTERISTIC_TANH = 16,
  // `gain`
  SELFOSC_CHARACTERISTIC_ABSOLUTE = 17,
  // `left_slope`, `right_slope`, then the points `x0`, `y0`, `x1`, `y1`, ...: 32 points at most.
  SELFOSC_CHARACTERISTIC_PIECEWISE_LINEAR = 18,
  // `slope`, `half_gap`
  SELFOSC_CHARACTERISTIC_BACKLASH = 19,
} SelfoscCharacteristic;

// The measured quantity.
typedef enum {
  // The coordinate itself.
  SELFOSC_COORDINATE_POSITION = 0,
  // A heading in radians, which may jump by whole turns.
  SELFOSC_COORDINATE_HEADING_RAD = 1,
  // A heading in degrees, which may jump by whole turns.
  SELFOSC_COORDINATE_HEADING_DEGREES = 2,
  // A speed; the relay is fed with its integral.
  SELFOSC_COORDINATE_SPEED = 3,
} SelfoscCoordinate;

// How drag depends on speed.
typedef enum {
  // In proportion.
  SELFOSC_DRAG_LAW_LINEAR = 0,
  // As its square.
  SELFOSC_DRAG_LAW_QUADRATIC = 1,
} SelfoscDragLaw;

// On what the actions of a controller act; the derivative always acts on the measurement.
typedef enum {
  // Proportional to the error; no integral.
  SELFOSC_STRUCTURE_PD = 0,
  // Proportional to the error, with its integral.
  SELFOSC_STRUCTURE_PID = 1,
  // Integral of the error; proportional to the measurement.
  SELFOSC_STRUCTURE_IPD = 2,
} SelfoscStructure;

// Characters without a zero at their end: `printf("%.*s", (int)text.length, text.bytes)`. They stay for good.
typedef struct {
  // The first character; null where there is none.
  const char *bytes;
  // How many there are.
  size_t length;
} SelfoscText;

// A parameter of a characteristic.
typedef struct {
  // Its name.
  SelfoscText name;
  // Meaning and unit.
  SelfoscText meaning;
  // The numbers it may be, in words.
  SelfoscText domain;
} SelfoscParameter;

// Mean and complex gain of a characteristic's output: `f0 + amplitude (p sin + q cos)`.
typedef struct {
  // Mean of the output.
  float f0;
  // In-phase gain.
  float p;
  // Quadrature gain.
  float q;
} SelfoscDescribingFunction_f32;

// Why a call was refused.
typedef struct {
  // Short name of the reason: `out-of-domain`, `below-switching`, ...
  SelfoscText code;
  // The quantity outside its domain; none for other reasons.
  SelfoscText quantity;
  // Its value.
  double value;
  // Its unit.
  SelfoscText unit;
  // What to do.
  SelfoscText remedy;
} SelfoscRefusal;

// One degree of freedom: `alpha x'' + linear_drag x' + quadratic_drag x' |x'| = command(t - delay_s) + disturbance`.
typedef struct {
  // Inertia with added mass, above 0.
  float alpha;
  // Force per speed, 0 or more.
  float linear_drag;
  // Force per squared speed, 0 or more.
  float quadratic_drag;
  // Constant force, in command units.
  float disturbance;
  // Delay of the whole loop, s.
  float delay_s;
} SelfoscAxis_f32;

// The limit cycle of an axis under a relay with hysteresis.
typedef struct {
  // Half the range.
  float amplitude;
  // Middle of the range.
  float bias;
  // Period, s.
  float period_s;
  // Time with the positive command, s.
  float time_positive_s;
  // Time with the negative command, s.
  float time_negative_s;
  // The factor of a deviation over a period.
  float multiplier;
} SelfoscLimitCycle_f32;

// The quantities from which the paper's identification starts.
typedef struct {
  // Relay level, in command units.
  float relay_level;
  // Level at which the command really switched, in coordinate units.
  float switch_level;
  // Half the range, in coordinate units.
  float amplitude;
  // Middle of the range against the middle of the switching levels.
  float bias;
  // Period, s.
  float period_s;
  // Delay of the whole loop, s.
  float delay_s;
} SelfoscOscillation_f32;

// Parameters of an axis under each drag law, by the first harmonic.
typedef struct {
  // Inertia with added mass.
  float alpha;
  // Linear drag, if drag is linear.
  float beta;
  // Quadratic drag, if drag is quadratic.
  float beta_quadratic;
  // Constant force, in command units.
  float disturbance;
} SelfoscParameters_f32;

// The quantities from which the identification by exact limit cycles starts.
typedef struct {
  // Relay level, in command units.
  float relay_level;
  // Level at which the command really switched, in coordinate units.
  float switch_level;
  // Half the range, in coordinate units.
  float amplitude;
  // Time with the positive command, s.
  float time_positive_s;
  // Time with the negative command, s.
  float time_negative_s;
  // Delay of the whole loop, s.
  float delay_s;
} SelfoscMeanCycle_f32;

// An experiment on board: relay, limits, and when it is done. `selfosc_protocol_f64` fills it with sound values to start from.
typedef struct {
  // One of `SelfoscCoordinate`.
  uint32_t coordinate;
  // Value of the coordinate to oscillate about.
  float reference;
  // Command before, afterwards and upon a fault.
  float neutral_command;
  // Middle of the relay's two levels less the neutral command; a disturbance is counted from the middle.
  float relay_offset;
  // Least command that is ever given.
  float lowest_command;
  // Largest command that is ever given.
  float highest_command;
  // Relay level of the first attempt, in command units.
  float relay_level;
  // Half-width of the hysteresis in the first attempt, in coordinate units.
  float half_width;
  // The coordinate may be this far from the reference; a reading further off is a fault.
  float largest_excursion;
  // Before the first switching the coordinate may fall back by this distance.
  float wrong_way;
  // The relay keeps an output for at least this long, s.
  float dwell_s;
  // Time between samples as planned, s; a gap of more than four is a fault.
  float interval_s;
  // Step of the sensor, or a few standard deviations of its noise.
  float resolution;
  // Largest rate of change of the reading that the vehicle is capable of, per s.
  float largest_rate;
  // A reading unchanged for longer is a fault, s.
  float unchanged_s;
  // An attempt fails where the relay has not switched for longer, s, or for four times the longest half-period seen.
  float patience_s;
  // The experiment is broken off after this time, s.
  float duration_s;
  // How alike cycles have to be, relative.
  float spread;
  // Factor between the relay parameters of two attempts, above 1.
  float factor;
  // Cycles in a row that have to be alike, 2 or more.
  uint8_t cycles;
  // An attempt fails after so many cycles.
  uint8_t most_cycles;
  // Attempts in all.
  uint8_t attempts;
} SelfoscProtocol_f32;

// The words of an experiment on board in single precision.
typedef struct {
  // Not for the caller.
  uint64_t words[72];
} SelfoscExperiment_f32;

// The answer to a sample of the experiment.
typedef struct {
  // Command to give now, within the limits whatever the phase.
  float command;
  // Where the experiment stands.
  SelfoscPhase phase;
  // Short name of what went wrong: `excursion`, `wrong-way`, `gap`, ...; none unless failed.
  SelfoscText fault;
} SelfoscExperimentStep_f32;

// Mean and standard deviation over cycles.
typedef struct {
  // Mean.
  float mean;
  // Standard deviation of one cycle's value, not of the mean.
  float std;
} SelfoscCycleStatistics_f32;

// The result of a finished experiment.
typedef struct {
  // Half the range, in coordinate units.
  SelfoscCycleStatistics_f32 amplitude;
  // Middle of the range against the middle of the switching levels.
  SelfoscCycleStatistics_f32 bias;
  // Period, s.
  SelfoscCycleStatistics_f32 period_s;
  // Level at which the command really switched, in coordinate units.
  SelfoscCycleStatistics_f32 switch_level;
  // Time with the positive command, s.
  SelfoscCycleStatistics_f32 time_positive_s;
  // Time with the negative command, s.
  SelfoscCycleStatistics_f32 time_negative_s;
  // Relay level of the last attempt, in command units.
  float relay_level;
  // Half-width of the last attempt, in coordinate units.
  float half_width;
  // Cycles that the means are over.
  uint32_t cycles;
  // Attempts it took.
  uint32_t attempts;
} SelfoscOutcome_f32;

// Gains and limits of a controller. `selfosc_tune_f64` fills in the gains.
typedef struct {
  // One of `SelfoscStructure`.
  uint32_t structure;
  // Command per coordinate, above 0.
  float proportional;
  // Command per coordinate and s; 0 for a PD, above 0 for an I-PD.
  float integral;
  // Command per coordinate per s, 0 or more.
  float derivative;
  // Time constant of the filter on the derivative, s; 0 for none.
  float filter_s;
  // Least command.
  float lowest_command;
  // Largest command.
  float highest_command;
  // Length of a turn for a coordinate on a circle, such as 2 pi or 360; 0 on a line.
  float turn;
  // A command is held without a good step for no longer than this, s.
  float longest_hold_s;
  // The command after that, cut to the limits.
  float neutral_command;
} SelfoscControllerSettings_f32;

// `drag y' + stiffness y = u(t - dead_time_s) + load`: a first-order process of gain `1/stiffness` and time constant `drag/stiffness`;
// an integrator of gain `1/drag` where `stiffness` is 0.
typedef struct {
  // Command s per output, above 0.
  float drag;
  // Command per output, 0 or more.
  float stiffness;
  // Dead time, s, 0 or more.
  float dead_time_s;
  // Whether the output falls with the command: 1 or 0. The numbers are then those of the command with its sign turned, which is also
  // the command to give.
  uint32_t reverse;
} SelfoscProcess_f32;

// What a stable loop stands before it is critical.
typedef struct {
  // The gain may grow by less than this factor; 0 where any growth is borne.
  float gain;
  // The gain may be divided by less than this factor; 0 where any cut is borne.
  float gain_reduction;
  // The phase may lag or lead by less than this more, rad.
  float phase_rad;
  // The delay may grow by less than this, s.
  float delay_s;
  // Where `|L| = 1` and the delay margin is met, rad/s.
  float crossover_rad_s;
} SelfoscMargins_f32;

// The words of a controller in single precision.
typedef struct {
  // Not for the caller.
  uint64_t words[24];
} SelfoscController_f32;

// The result of a step of a controller.
typedef struct {
  // The command, within the limits in any case.
  float command;
  // Whether a limit holds the command back: 1 or 0.
  uint32_t limited;
  // Why the command is held, if it is.
  SelfoscControlFault fault;
} SelfoscControlStep_f32;

// Thrust by command on one side, `(quadratic n + linear) n` from the dead zone to the limit. Magnitudes all.
typedef struct {
  // N per squared command.
  float quadratic;
  // N per command.
  float linear;
  // Command at which the propeller starts, 0 or more.
  float dead_zone;
  // Largest command.
  float limit;
} SelfoscThrustSide_f32;

// A thruster in still water.
typedef struct {
  // Under positive commands.
  SelfoscThrustSide_f32 forward;
  // Under negative commands.
  SelfoscThrustSide_f32 backward;
} SelfoscThruster_f32;

// What a thruster is told, and what it then gives.
typedef struct {
  // Command.
  float command;
  // Thrust, N.
  float thrust_n;
} SelfoscDelivered_f32;

// Mean and complex gain of a characteristic's output: `f0 + amplitude (p sin + q cos)`.
typedef struct {
  // Mean of the output.
  double f0;
  // In-phase gain.
  double p;
  // Quadrature gain.
  double q;
} SelfoscDescribingFunction_f64;

// One degree of freedom: `alpha x'' + linear_drag x' + quadratic_drag x' |x'| = command(t - delay_s) + disturbance`.
typedef struct {
  // Inertia with added mass, above 0.
  double alpha;
  // Force per speed, 0 or more.
  double linear_drag;
  // Force per squared speed, 0 or more.
  double quadratic_drag;
  // Constant force, in command units.
  double disturbance;
  // Delay of the whole loop, s.
  double delay_s;
} SelfoscAxis_f64;

// The limit cycle of an axis under a relay with hysteresis.
typedef struct {
  // Half the range.
  double amplitude;
  // Middle of the range.
  double bias;
  // Period, s.
  double period_s;
  // Time with the positive command, s.
  double time_positive_s;
  // Time with the negative command, s.
  double time_negative_s;
  // The factor of a deviation over a period.
  double multiplier;
} SelfoscLimitCycle_f64;

// The quantities from which the paper's identification starts.
typedef struct {
  // Relay level, in command units.
  double relay_level;
  // Level at which the command really switched, in coordinate units.
  double switch_level;
  // Half the range, in coordinate units.
  double amplitude;
  // Middle of the range against the middle of the switching levels.
  double bias;
  // Period, s.
  double period_s;
  // Delay of the whole loop, s.
  double delay_s;
} SelfoscOscillation_f64;

// Parameters of an axis under each drag law, by the first harmonic.
typedef struct {
  // Inertia with added mass.
  double alpha;
  // Linear drag, if drag is linear.
  double beta;
  // Quadratic drag, if drag is quadratic.
  double beta_quadratic;
  // Constant force, in command units.
  double disturbance;
} SelfoscParameters_f64;

// The quantities from which the identification by exact limit cycles starts.
typedef struct {
  // Relay level, in command units.
  double relay_level;
  // Level at which the command really switched, in coordinate units.
  double switch_level;
  // Half the range, in coordinate units.
  double amplitude;
  // Time with the positive command, s.
  double time_positive_s;
  // Time with the negative command, s.
  double time_negative_s;
  // Delay of the whole loop, s.
  double delay_s;
} SelfoscMeanCycle_f64;

// An experiment on board: relay, limits, and when it is done. `selfosc_protocol_f64` fills it with sound values to start from.
typedef struct {
  // One of `SelfoscCoordinate`.
  uint32_t coordinate;
  // Value of the coordinate to oscillate about.
  double reference;
  // Command before, afterwards and upon a fault.
  double neutral_command;
  // Middle of the relay's two levels less the neutral command; a disturbance is counted from the middle.
  double relay_offset;
  // Least command that is ever given.
  double lowest_command;
  // Largest command that is ever given.
  double highest_command;
  // Relay level of the first attempt, in command units.
  double relay_level;
  // Half-width of the hysteresis in the first attempt, in coordinate units.
  double half_width;
  // The coordinate may be this far from the reference; a reading further off is a fault.
  double largest_excursion;
  // Before the first switching the coordinate may fall back by this distance.
  double wrong_way;
  // The relay keeps an output for at least this long, s.
  double dwell_s;
  // Time between samples as planned, s; a gap of more than four is a fault.
  double interval_s;
  // Step of the sensor, or a few standard deviations of its noise.
  double resolution;
  // Largest rate of change of the reading that the vehicle is capable of, per s.
  double largest_rate;
  // A reading unchanged for longer is a fault, s.
  double unchanged_s;
  // An attempt fails where the relay has not switched for longer, s, or for four times the longest half-period seen.
  double patience_s;
  // The experiment is broken off after this time, s.
  double duration_s;
  // How alike cycles have to be, relative.
  double spread;
  // Factor between the relay parameters of two attempts, above 1.
  double factor;
  // Cycles in a row that have to be alike, 2 or more.
  uint8_t cycles;
  // An attempt fails after so many cycles.
  uint8_t most_cycles;
  // Attempts in all.
  uint8_t attempts;
} SelfoscProtocol_f64;

// The words of an experiment on board. Begin it before any other call; it may be copied and moved, but not shared between
// threads without a lock.
typedef struct {
  // Not for the caller.
  uint64_t words[128];
} SelfoscExperiment_f64;

// The answer to a sample of the experiment.
typedef struct {
  // Command to give now, within the limits whatever the phase.
  double command;
  // Where the experiment stands.
  SelfoscPhase phase;
  // Short name of what went wrong: `excursion`, `wrong-way`, `gap`, ...; none unless failed.
  SelfoscText fault;
} SelfoscExperimentStep_f64;

// Mean and standard deviation over cycles.
typedef struct {
  // Mean.
  double mean;
  // Standard deviation of one cycle's value, not of the mean.
  double std;
} SelfoscCycleStatistics_f64;

// The result of a finished experiment.
typedef struct {
  // Half the range, in coordinate units.
  SelfoscCycleStatistics_f64 amplitude;
  // Middle of the range against the middle of the switching levels.
  SelfoscCycleStatistics_f64 bias;
  // Period, s.
  SelfoscCycleStatistics_f64 period_s;
  // Level at which the command really switched, in coordinate units.
  SelfoscCycleStatistics_f64 switch_level;
  // Time with the positive command, s.
  SelfoscCycleStatistics_f64 time_positive_s;
  // Time with the negative command, s.
  SelfoscCycleStatistics_f64 time_negative_s;
  // Relay level of the last attempt, in command units.
  double relay_level;
  // Half-width of the last attempt, in coordinate units.
  double half_width;
  // Cycles that the means are over.
  uint32_t cycles;
  // Attempts it took.
  uint32_t attempts;
} SelfoscOutcome_f64;

// Gains and limits of a controller. `selfosc_tune_f64` fills in the gains.
typedef struct {
  // One of `SelfoscStructure`.
  uint32_t structure;
  // Command per coordinate, above 0.
  double proportional;
  // Command per coordinate and s; 0 for a PD, above 0 for an I-PD.
  double integral;
  // Command per coordinate per s, 0 or more.
  double derivative;
  // Time constant of the filter on the derivative, s; 0 for none.
  double filter_s;
  // Least command.
  double lowest_command;
  // Largest command.
  double highest_command;
  // Length of a turn for a coordinate on a circle, such as 2 pi or 360; 0 on a line.
  double turn;
  // A command is held without a good step for no longer than this, s.
  double longest_hold_s;
  // The command after that, cut to the limits.
  double neutral_command;
} SelfoscControllerSettings_f64;

// `drag y' + stiffness y = u(t - dead_time_s) + load`: a first-order process of gain `1/stiffness` and time constant `drag/stiffness`;
// an integrator of gain `1/drag` where `stiffness` is 0.
typedef struct {
  // Command s per output, above 0.
  double drag;
  // Command per output, 0 or more.
  double stiffness;
  // Dead time, s, 0 or more.
  double dead_time_s;
  // Whether the output falls with the command: 1 or 0. The numbers are then those of the command with its sign turned, which is also
  // the command to give.
  uint32_t reverse;
} SelfoscProcess_f64;

// What a stable loop stands before it is critical.
typedef struct {
  // The gain may grow by less than this factor; 0 where any growth is borne.
  double gain;
  // The gain may be divided by less than this factor; 0 where any cut is borne.
  double gain_reduction;
  // The phase may lag or lead by less than this more, rad.
  double phase_rad;
  // The delay may grow by less than this, s.
  double delay_s;
  // Where `|L| = 1` and the delay margin is met, rad/s.
  double crossover_rad_s;
} SelfoscMargins_f64;

// The words of a controller. Begin it before any other call; as for an experiment.
typedef struct {
  // Not for the caller.
  uint64_t words[40];
} SelfoscController_f64;

// The result of a step of a controller.
typedef struct {
  // The command, within the limits in any case.
  double command;
  // Whether a limit holds the command back: 1 or 0.
  uint32_t limited;
  // Why the command is held, if it is.
  SelfoscControlFault fault;
} SelfoscControlStep_f64;

// Thrust by command on one side, `(quadratic n + linear) n` from the dead zone to the limit. Magnitudes all.
typedef struct {
  // N per squared command.
  double quadratic;
  // N per command.
  double linear;
  // Command at which the propeller starts, 0 or more.
  double dead_zone;
  // Largest command.
  double limit;
} SelfoscThrustSide_f64;

// A thruster in still water.
typedef struct {
  // Under positive commands.
  SelfoscThrustSide_f64 forward;
  // Under negative commands.
  SelfoscThrustSide_f64 backward;
} SelfoscThruster_f64;

// What a thruster is told, and what it then gives.
typedef struct {
  // Command.
  double command;
  // Thrust, N.
  double thrust_n;
} SelfoscDelivered_f64;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The parameter with this index, from 0, of one of `SelfoscCharacteristic`; `SELFOSC_STATUS_WRONG_COUNT` after the last one.
SelfoscStatus selfosc_parameter(uint32_t characteristic, size_t index, SelfoscParameter *result);

// Describing function of one of `SelfoscCharacteristic` under the input `bias + amplitude sin`, amplitude above 0. `count`
// parameters, in the order of the catalogue.
SelfoscStatus selfosc_describe_f32(uint32_t characteristic,
                                   const float *parameters,
                                   size_t count,
                                   float bias,
                                   float amplitude,
                                   SelfoscDescribingFunction_f32 *result,
                                   SelfoscRefusal *refusal);

// Limit cycle of an axis under a relay with hysteresis, by its exact motion.
SelfoscStatus selfosc_limit_cycle_f32(const SelfoscAxis_f32 *axis,
                                      float relay_level,
                                      float half_width,
                                      SelfoscLimitCycle_f32 *result,
                                      SelfoscRefusal *refusal);

// Parameters of an axis from an oscillation, by its first harmonic: the paper's method.
SelfoscStatus selfosc_identify_f32(const SelfoscOscillation_f32 *oscillation,
                                   SelfoscParameters_f32 *result,
                                   SelfoscRefusal *refusal);

// The axis whose exact limit cycle this is, under one of `SelfoscDragLaw`.
SelfoscStatus selfosc_identify_exact_f32(const SelfoscMeanCycle_f32 *cycle,
                                         uint32_t drag_law,
                                         SelfoscAxis_f32 *result,
                                         SelfoscRefusal *refusal);

// An experiment on one of `SelfoscCoordinate` with this relay, that may go `largest_excursion` from its reference, and sound
// values for the rest. All are finite; no more is checked before the experiment begins.
SelfoscStatus selfosc_protocol_f32(uint32_t coordinate,
                                   float relay_level,
                                   float half_width,
                                   float largest_excursion,
                                   float interval_s,
                                   SelfoscProtocol_f32 *result,
                                   SelfoscRefusal *refusal);

// Begins an experiment; it starts with its first sample.
SelfoscStatus selfosc_experiment_begin_f32(SelfoscExperiment_f32 *experiment,
                                           const SelfoscProtocol_f32 *protocol,
                                           SelfoscRefusal *refusal);

// Takes a reading and its time in s since the start of the experiment: the command to give now. Any numbers at all may come.
SelfoscStatus selfosc_experiment_step_f32(SelfoscExperiment_f32 *experiment,
                                          float reading,
                                          float time_s,
                                          SelfoscExperimentStep_f32 *result);

// The command at a time without a reading, for a timer beside a driver that may block.
SelfoscStatus selfosc_experiment_tick_f32(SelfoscExperiment_f32 *experiment, float time_s, SelfoscExperimentStep_f32 *result);

// Stops an experiment: the command is neutral from now on.
SelfoscStatus selfosc_experiment_abort_f32(SelfoscExperiment_f32 *experiment);

// What an experiment found that is done.
SelfoscStatus selfosc_experiment_outcome_f32(SelfoscExperiment_f32 *experiment, SelfoscOutcome_f32 *result);

// Gains for one of `SelfoscStructure` on an axis, with this bandwidth in rad/s; the other settings stay as they are.
SelfoscStatus selfosc_tune_f32(const SelfoscAxis_f32 *axis,
                               uint32_t structure,
                               float bandwidth_rad_s,
                               SelfoscControllerSettings_f32 *settings,
                               SelfoscRefusal *refusal);

// A first-order process with dead time, or an integrator, from a record of a relay's or thermostat's oscillation: `count` readings, 24 to
// 256, at times that rise, each command from its reading's time on. Two periods tell it well; at least three changes of the command.
SelfoscStatus selfosc_process_f32(const float *time_s,
                                  const float *output,
                                  const float *command,
                                  size_t count,
                                  SelfoscProcess_f32 *result,
                                  SelfoscRefusal *refusal);

// PID gains for a process, by a rule whose largest sensitivity is at most 1.5 for every process of this structure, under a controller that
// holds its command for `interval_s`; the other settings stay as they are.
SelfoscStatus selfosc_process_gains_f32(const SelfoscProcess_f32 *process,
                                        float interval_s,
                                        SelfoscControllerSettings_f32 *settings,
                                        SelfoscRefusal *refusal);

// Margins of the loop that `selfosc_tune_f32` makes.
SelfoscStatus selfosc_margins_f32(const SelfoscAxis_f32 *axis,
                                  uint32_t structure,
                                  float bandwidth_rad_s,
                                  SelfoscMargins_f32 *result,
                                  SelfoscRefusal *refusal);

// Begins a controller.
SelfoscStatus selfosc_controller_begin_f32(SelfoscController_f32 *controller,
                                           const SelfoscControllerSettings_f32 *settings,
                                           SelfoscRefusal *refusal);

// Leads a controller along a reference that the axis can follow, with the force that takes. `pace_rad_s` is how fast the
// reference answers, `top_speed` its largest speed, 0 for none. Starts anew.
SelfoscStatus selfosc_controller_feed_forward_f32(SelfoscController_f32 *controller,
                                                  const SelfoscAxis_f32 *axis,
                                                  float pace_rad_s,
                                                  float top_speed,
                                                  SelfoscRefusal *refusal);

// The next command, given the time since the step before, good or not. Any numbers at all may come.
SelfoscStatus selfosc_controller_step_f32(SelfoscController_f32 *controller,
                                          float reference,
                                          float measurement,
                                          float dt_s,
                                          SelfoscControlStep_f32 *result);

// Lets a controller forget everything but its settings.
SelfoscStatus selfosc_controller_reset_f32(SelfoscController_f32 *controller);

// Thrust in N at a command.
SelfoscStatus selfosc_thruster_thrust_f32(const SelfoscThruster_f32 *thruster,
                                          float command,
                                          float *result,
                                          SelfoscRefusal *refusal);

// The command that gives a thrust in N; refused within the dead zone and beyond the limit.
SelfoscStatus selfosc_thruster_command_f32(const SelfoscThruster_f32 *thruster,
                                           float thrust_n,
                                           float *result,
                                           SelfoscRefusal *refusal);

// The command whose thrust is nearest, and that thrust.
SelfoscStatus selfosc_thruster_command_clamped_f32(const SelfoscThruster_f32 *thruster,
                                                   float thrust_n,
                                                   SelfoscDelivered_f32 *result,
                                                   SelfoscRefusal *refusal);

// Describing function of one of `SelfoscCharacteristic` under the input `bias + amplitude sin`, amplitude above 0. `count`
// parameters, in the order of the catalogue.
SelfoscStatus selfosc_describe_f64(uint32_t characteristic,
                                   const double *parameters,
                                   size_t count,
                                   double bias,
                                   double amplitude,
                                   SelfoscDescribingFunction_f64 *result,
                                   SelfoscRefusal *refusal);

// Limit cycle of an axis under a relay with hysteresis, by its exact motion.
SelfoscStatus selfosc_limit_cycle_f64(const SelfoscAxis_f64 *axis,
                                      double relay_level,
                                      double half_width,
                                      SelfoscLimitCycle_f64 *result,
                                      SelfoscRefusal *refusal);

// Parameters of an axis from an oscillation, by its first harmonic: the paper's method.
SelfoscStatus selfosc_identify_f64(const SelfoscOscillation_f64 *oscillation,
                                   SelfoscParameters_f64 *result,
                                   SelfoscRefusal *refusal);

// The axis whose exact limit cycle this is, under one of `SelfoscDragLaw`.
SelfoscStatus selfosc_identify_exact_f64(const SelfoscMeanCycle_f64 *cycle,
                                         uint32_t drag_law,
                                         SelfoscAxis_f64 *result,
                                         SelfoscRefusal *refusal);

// An experiment on one of `SelfoscCoordinate` with this relay, that may go `largest_excursion` from its reference, and sound
// values for the rest. All are finite; no more is checked before the experiment begins.
SelfoscStatus selfosc_protocol_f64(uint32_t coordinate,
                                   double relay_level,
                                   double half_width,
                                   double largest_excursion,
                                   double interval_s,
                                   SelfoscProtocol_f64 *result,
                                   SelfoscRefusal *refusal);

// Begins an experiment; it starts with its first sample.
SelfoscStatus selfosc_experiment_begin_f64(SelfoscExperiment_f64 *experiment,
                                           const SelfoscProtocol_f64 *protocol,
                                           SelfoscRefusal *refusal);

// Takes a reading and its time in s since the start of the experiment: the command to give now. Any numbers at all may come.
SelfoscStatus selfosc_experiment_step_f64(SelfoscExperiment_f64 *experiment,
                                          double reading,
                                          double time_s,
                                          SelfoscExperimentStep_f64 *result);

// The command at a time without a reading, for a timer beside a driver that may block.
SelfoscStatus selfosc_experiment_tick_f64(SelfoscExperiment_f64 *experiment, double time_s, SelfoscExperimentStep_f64 *result);

// Stops an experiment: the command is neutral from now on.
SelfoscStatus selfosc_experiment_abort_f64(SelfoscExperiment_f64 *experiment);

// What an experiment found that is done.
SelfoscStatus selfosc_experiment_outcome_f64(SelfoscExperiment_f64 *experiment, SelfoscOutcome_f64 *result);

// Gains for one of `SelfoscStructure` on an axis, with this bandwidth in rad/s; the other settings stay as they are.
SelfoscStatus selfosc_tune_f64(const SelfoscAxis_f64 *axis,
                               uint32_t structure,
                               double bandwidth_rad_s,
                               SelfoscControllerSettings_f64 *settings,
                               SelfoscRefusal *refusal);

// A first-order process with dead time, or an integrator, from a record of a relay's or thermostat's oscillation: `count` readings, 24 to
// 256, at times that rise, each command from its reading's time on. Two periods tell it well; at least three changes of the command.
SelfoscStatus selfosc_process_f64(const double *time_s,
                                  const double *output,
                                  const double *command,
                                  size_t count,
                                  SelfoscProcess_f64 *result,
                                  SelfoscRefusal *refusal);

// PID gains for a process, by a rule whose largest sensitivity is at most 1.5 for every process of this structure, under a controller that
// holds its command for `interval_s`; the other settings stay as they are.
SelfoscStatus selfosc_process_gains_f64(const SelfoscProcess_f64 *process,
                                        double interval_s,
                                        SelfoscControllerSettings_f64 *settings,
                                        SelfoscRefusal *refusal);

// Margins of the loop that `selfosc_tune_f64` makes.
SelfoscStatus selfosc_margins_f64(const SelfoscAxis_f64 *axis,
                                  uint32_t structure,
                                  double bandwidth_rad_s,
                                  SelfoscMargins_f64 *result,
                                  SelfoscRefusal *refusal);

// Begins a controller.
SelfoscStatus selfosc_controller_begin_f64(SelfoscController_f64 *controller,
                                           const SelfoscControllerSettings_f64 *settings,
                                           SelfoscRefusal *refusal);

// Leads a controller along a reference that the axis can follow, with the force that takes. `pace_rad_s` is how fast the
// reference answers, `top_speed` its largest speed, 0 for none. Starts anew.
SelfoscStatus selfosc_controller_feed_forward_f64(SelfoscController_f64 *controller,
                                                  const SelfoscAxis_f64 *axis,
                                                  double pace_rad_s,
                                                  double top_speed,
                                                  SelfoscRefusal *refusal);

// The next command, given the time since the step before, good or not. Any numbers at all may come.
SelfoscStatus selfosc_controller_step_f64(SelfoscController_f64 *controller,
                                          double reference,
                                          double measurement,
                                          double dt_s,
                                          SelfoscControlStep_f64 *result);

// Lets a controller forget everything but its settings.
SelfoscStatus selfosc_controller_reset_f64(SelfoscController_f64 *controller);

// Thrust in N at a command.
SelfoscStatus selfosc_thruster_thrust_f64(const SelfoscThruster_f64 *thruster,
                                          double command,
                                          double *result,
                                          SelfoscRefusal *refusal);

// The command that gives a thrust in N; refused within the dead zone and beyond the limit.
SelfoscStatus selfosc_thruster_command_f64(const SelfoscThruster_f64 *thruster,
                                           double thrust_n,
                                           double *result,
                                           SelfoscRefusal *refusal);

// The command whose thrust is nearest, and that thrust.
SelfoscStatus selfosc_thruster_command_clamped_f64(const SelfoscThruster_f64 *thruster,
                                                   double thrust_n,
                                                   SelfoscDelivered_f64 *result,
                                                   SelfoscRefusal *refusal);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* SELFOSC_H */
