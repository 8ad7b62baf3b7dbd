/* Every function of the header upon every kind of number: a refusal, or numbers that are finite and in their domain. check.sh makes
 * the same for single precision, and sees to it that no function is left out. */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "selfosc.h"

#define CHECK(condition) \
    do { \
        if (!(condition)) { \
            fprintf(stderr, "%s:%d: %s, round %ld\n", __FILE__, __LINE__, #condition, rounds); \
            return 1; \
        } \
    } while (0)

/* Numbers of a structure that has no others. */
#define FINITE(structure) finite((const double *)(const void *)&(structure), sizeof(structure) / sizeof(double))

enum { DESCRIBE, LIMIT_CYCLE, IDENTIFY, EXACT, PROTOCOL, BEGIN, OUTCOME, TUNE, PROCESS, GAINS, MARGINS, AHEAD, THRUST, COMMAND, CLAMPED, KINDS };

static long rounds, answered[KINDS];
static uint64_t state = 20261127;

/* Splitmix64 (Steele, Lea and Flood, 2014). */
static uint64_t bits(void)
{
    uint64_t z = (state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static double between(double low, double high)
{
    return low + (high - low) * (double)(bits() >> 40) / 16777216;
}

/* A magnitude: half of them from a thousandth to a thousand, others anywhere, at the ends, zero. */
static double size(void)
{
    switch (bits() % 12) {
    case 0: return 0;
    case 1: return DBL_MAX;
    case 2: return DBL_MIN * DBL_EPSILON;
    case 3: return DBL_MIN * between(0, 1);
    case 4:
    case 5: return (double)pow(10, between(DBL_MIN_10_EXP, DBL_MAX_10_EXP));
    default: return (double)pow(10, between(-3, 3));
    }
}

/* Any number, and what is none. */
static double any(void)
{
    const double sign = bits() % 2 ? 1 : -1;
    switch (bits() % 16) {
    case 0: return (double)NAN;
    case 1: return sign * (double)HUGE_VAL;
    default: return sign * size();
    }
}

/* Mostly a magnitude. */
static double given(void)
{
    return bits() % 8 ? size() : any();
}

static double perhaps(void)
{
    return bits() % 2 ? 0 : given();
}

static int finite(const double *numbers, size_t count)
{
    size_t i;
    for (i = 0; i < count; ++i)
        if (!isfinite(numbers[i]))
            return 0;
    return 1;
}

/* A status with an answer is counted. */
static int answers(int kind, SelfoscStatus status)
{
    answered[kind] += status == SELFOSC_STATUS_OK;
    return status == SELFOSC_STATUS_OK;
}

static SelfoscAxis_f64 any_axis(void)
{
    SelfoscAxis_f64 axis;
    axis.alpha = given();
    axis.linear_drag = perhaps();
    axis.quadratic_drag = perhaps();
    axis.disturbance = bits() % 2 ? 0 : any();
    axis.delay_s = perhaps();
    return axis;
}

static int describing(void)
{
    double parameters[10];
    SelfoscDescribingFunction_f64 df;
    SelfoscParameter parameter;
    const uint32_t characteristic = (uint32_t)(bits() % 21);
    size_t count = 0, i;
    for (i = 0; i < 10; ++i)
        parameters[i] = given();
    while (count < 10 && selfosc_parameter(characteristic, count, &parameter) == SELFOSC_STATUS_OK)
        ++count;
    count = count == 0 ? 2 + 2 * (size_t)(bits() % 5) : count;
    if (answers(DESCRIBE, selfosc_describe_f64(characteristic, parameters, count, bits() % 2 ? 0 : any(), given(), &df, NULL)))
        CHECK(FINITE(df));
    return 0;
}

static int orbits(void)
{
    const SelfoscAxis_f64 axis = any_axis();
    SelfoscLimitCycle_f64 cycle;
    SelfoscOscillation_f64 oscillation;
    SelfoscParameters_f64 parameters;
    SelfoscMeanCycle_f64 mean;
    SelfoscAxis_f64 found;
    if (answers(LIMIT_CYCLE, selfosc_limit_cycle_f64(&axis, given(), given(), &cycle, NULL))) {
        CHECK(FINITE(cycle) && cycle.amplitude > 0 && cycle.period_s > 0);
        CHECK(cycle.time_positive_s > 0 && cycle.time_negative_s > 0 && cycle.multiplier >= 0 && cycle.multiplier <= 1);
    }
    oscillation.relay_level = given();
    oscillation.amplitude = given();
    oscillation.switch_level = bits() % 2 ? perhaps() : oscillation.amplitude * between(0, 1);
    oscillation.bias = bits() % 2 ? 0 : oscillation.amplitude * between(-1, 1);
    oscillation.period_s = given();
    oscillation.delay_s = perhaps();
    if (answers(IDENTIFY, selfosc_identify_f64(&oscillation, &parameters, NULL)))
        CHECK(FINITE(parameters) && parameters.alpha > 0 && parameters.beta > 0 && parameters.beta_quadratic >= 0);
    mean.relay_level = oscillation.relay_level;
    mean.switch_level = oscillation.switch_level;
    mean.amplitude = oscillation.amplitude;
    mean.time_positive_s = oscillation.period_s / 2;
    mean.time_negative_s = bits() % 2 ? mean.time_positive_s : given();
    mean.delay_s = oscillation.delay_s;
    if (answers(EXACT, selfosc_identify_exact_f64(&mean, (uint32_t)(bits() % 3), &found, NULL)))
        CHECK(FINITE(found) && found.alpha > 0 && found.linear_drag >= 0 && found.quadratic_drag >= 0 && found.delay_s >= 0);
    return 0;
}

static int statistics(SelfoscCycleStatistics_f64 of)
{
    return FINITE(of) && of.std >= 0;
}

/* A double integrator with drag in units of any size. */
static int experiments(void)
{
    const double unit = bits() % 2 ? 1 : given(), half_width = unit * between(0.1, 1), interval_s = 0.1f;
    const double thrust = between(0.5, 2), excursion = half_width * between(2, 30);
    double position = 0, speed = 0;
    SelfoscProtocol_f64 protocol;
    SelfoscExperiment_f64 experiment;
    SelfoscExperimentStep_f64 step;
    SelfoscOutcome_f64 outcome;
    int sample;
    if (!answers(PROTOCOL, selfosc_protocol_f64((uint32_t)(bits() % 5), bits() % 2 ? 1 : given(), half_width, excursion,
                                                bits() % 4 ? interval_s : given(), &protocol, NULL)))
        return 0;
    /* Its numbers stand together. */
    CHECK(finite(&protocol.reference, (size_t)(&protocol.factor - &protocol.reference) + 1));
    protocol.largest_rate = bits() % 4 ? 10 * excursion : any();
    protocol.spread = bits() % 4 ? protocol.spread : any();
    protocol.reference = bits() % 8 ? 0 : any();
    protocol.relay_offset = bits() % 8 ? 0 : any();
    if (!answers(BEGIN, selfosc_experiment_begin_f64(&experiment, &protocol, NULL)))
        return 0;
    for (sample = 0; sample < 1000; ++sample) {
        const double time_s = bits() % 2000 ? interval_s * (double)sample : any();
        CHECK(selfosc_experiment_step_f64(&experiment, bits() % 2000 ? position : any(), time_s, &step) == SELFOSC_STATUS_OK);
        CHECK(step.command >= protocol.lowest_command && step.command <= protocol.highest_command);
        if (bits() % 16 == 0)
            CHECK(selfosc_experiment_tick_f64(&experiment, time_s, &step) == SELFOSC_STATUS_OK);
        CHECK(step.command >= protocol.lowest_command && step.command <= protocol.highest_command);
        if (step.phase != SELFOSC_PHASE_RUNNING) {
            CHECK(step.command == protocol.neutral_command);
            break;
        }
        speed += interval_s * (unit * thrust * step.command / protocol.relay_level - speed / 2);
        position += interval_s * speed;
    }
    if (answers(OUTCOME, selfosc_experiment_outcome_f64(&experiment, &outcome))) {
        CHECK(statistics(outcome.amplitude) && statistics(outcome.bias) && statistics(outcome.period_s));
        CHECK(statistics(outcome.switch_level) && statistics(outcome.time_positive_s) && statistics(outcome.time_negative_s));
        CHECK(isfinite(outcome.relay_level) && isfinite(outcome.half_width) && outcome.relay_level > 0 && outcome.half_width > 0);
        CHECK(outcome.amplitude.mean > 0 && outcome.period_s.mean > 0);
    }
    CHECK(selfosc_experiment_abort_f64(&experiment) == SELFOSC_STATUS_OK);
    CHECK(selfosc_experiment_tick_f64(&experiment, any(), &step) == SELFOSC_STATUS_OK && step.command == protocol.neutral_command);
    return 0;
}

static int controllers(void)
{
    const SelfoscAxis_f64 axis = any_axis();
    const uint32_t structure = (uint32_t)(bits() % 4);
    const double bandwidth_rad_s = bits() % 2 ? given() : 2 * axis.linear_drag / axis.alpha + between(0, 1);
    SelfoscControllerSettings_f64 settings;
    SelfoscController_f64 controller;
    SelfoscControlStep_f64 step;
    SelfoscMargins_f64 margins;
    int sample;
    memset(&settings, 0, sizeof settings);
    settings.lowest_command = any();
    settings.highest_command = any();
    settings.neutral_command = any();
    settings.longest_hold_s = given();
    settings.turn = perhaps();
    if (answers(MARGINS, selfosc_margins_f64(&axis, structure, bandwidth_rad_s, &margins, NULL))) {
        CHECK(FINITE(margins) && margins.gain >= 0 && margins.gain_reduction >= 0 && margins.delay_s >= 0);
        CHECK(margins.phase_rad >= 0 && margins.phase_rad <= 3.1416 && margins.crossover_rad_s >= 0);
    }
    if (answers(TUNE, selfosc_tune_f64(&axis, structure, bandwidth_rad_s, &settings, NULL))) {
        CHECK(isfinite(settings.proportional) && isfinite(settings.integral) && isfinite(settings.derivative));
        CHECK(settings.proportional > 0 && settings.integral >= 0 && settings.derivative >= 0 && settings.filter_s >= 0);
    } else {
        settings.structure = structure;
        settings.proportional = given();
        settings.integral = perhaps();
        settings.derivative = perhaps();
        settings.filter_s = perhaps();
    }
    if (selfosc_controller_begin_f64(&controller, &settings, NULL) != SELFOSC_STATUS_OK)
        return 0;
    (void)answers(AHEAD, selfosc_controller_feed_forward_f64(&controller, &axis, given(), perhaps(), NULL));
    for (sample = 0; sample < 20; ++sample) {
        CHECK(selfosc_controller_step_f64(&controller, any(), any(), given(), &step) == SELFOSC_STATUS_OK);
        CHECK(step.command >= settings.lowest_command && step.command <= settings.highest_command);
        if (bits() % 16 == 0)
            CHECK(selfosc_controller_reset_f64(&controller) == SELFOSC_STATUS_OK);
    }
    return 0;
}

static SelfoscThrustSide_f64 any_side(void)
{
    SelfoscThrustSide_f64 side;
    side.quadratic = perhaps();
    side.linear = perhaps();
    side.dead_zone = perhaps();
    side.limit = side.dead_zone + given();
    return side;
}

/* Readings of a relay's oscillation at any scale, some of them no numbers at all. */
static int processes(void)
{
    double time_s[64], output[64], command[64], now = 0;
    const double pace = given(), swing = given(), level = given(), interval_s = perhaps();
    const size_t count = bits() % 8 ? 64 : (size_t)(bits() % 70);
    const int broken = bits() % 4 == 0;
    SelfoscProcess_f64 process;
    SelfoscControllerSettings_f64 settings = {0};
    size_t k;
    for (k = 0; k < 64; ++k) {
        now += pace * between(0.9, 1.1);
        time_s[k] = broken && bits() % 32 == 0 ? any() : now;
        command[k] = (k / 8) % 2 ? 0 : level;
        output[k] = broken && bits() % 32 == 0 ? any() : swing * ((k + 4) / 8 % 2 ? -1 : 1) * ((double)((k + 4) % 8) - 3.5 + between(0, 0.1));
    }
    if (answers(PROCESS, selfosc_process_f64(time_s, output, command, count > 64 ? 64 : count, &process, NULL))) {
        CHECK(isfinite(process.drag) && process.drag > 0 && isfinite(process.stiffness) && process.stiffness >= 0);
        CHECK(isfinite(process.dead_time_s) && process.dead_time_s >= 0 && process.reverse <= 1);
    } else {
        process.drag = any();
        process.stiffness = any();
        process.dead_time_s = any();
        process.reverse = 0;
    }
    if (answers(GAINS, selfosc_process_gains_f64(&process, interval_s, &settings, NULL))) {
        CHECK(isfinite(settings.proportional) && isfinite(settings.integral) && isfinite(settings.derivative));
        CHECK(settings.proportional > 0 && settings.integral >= 0 && settings.derivative >= 0 && settings.filter_s >= 0);
    }
    return 0;
}

static int thrusters(void)
{
    SelfoscThruster_f64 thruster;
    SelfoscDelivered_f64 delivered;
    double most_n, least_n, thrust_n, command;
    thruster.forward = any_side();
    thruster.backward = any_side();
    if (selfosc_thruster_thrust_f64(&thruster, thruster.forward.limit, &most_n, NULL) != SELFOSC_STATUS_OK
        || selfosc_thruster_thrust_f64(&thruster, -thruster.backward.limit, &least_n, NULL) != SELFOSC_STATUS_OK)
        return 0;
    if (answers(THRUST, selfosc_thruster_thrust_f64(&thruster, any(), &thrust_n, NULL)))
        CHECK(isfinite(thrust_n) && thrust_n >= least_n && thrust_n <= most_n);
    thrust_n = bits() % 2 ? any() : between(-1, 1) * (bits() % 2 ? most_n : least_n);
    if (answers(COMMAND, selfosc_thruster_command_f64(&thruster, thrust_n, &command, NULL)))
        CHECK(command >= -thruster.backward.limit && command <= thruster.forward.limit);
    if (answers(CLAMPED, selfosc_thruster_command_clamped_f64(&thruster, thrust_n, &delivered, NULL))) {
        CHECK(delivered.command >= -thruster.backward.limit && delivered.command <= thruster.forward.limit);
        CHECK(delivered.thrust_n >= least_n && delivered.thrust_n <= most_n);
    }
    return 0;
}

int main(void)
{
    int kind;
    for (rounds = 0; rounds < 40000; ++rounds)
        if (describing() || orbits() || controllers() || thrusters()
            || (rounds % 40 == 0 && (experiments() || processes())))
            return 1;
    /* What never answers is not tested. */
    for (kind = 0; kind < KINDS; ++kind)
        CHECK(answered[kind] > 20);
    return 0;
}
