/* What every call promises: no pointer, no structure and no number that can harm it. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "selfosc.h"

#define CHECK(condition) \
    do { \
        if (!(condition)) { \
            fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
            return 1; \
        } \
    } while (0)

static uint64_t state = 20261122;

static uint64_t bits(void)
{
    uint64_t z = (state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static double any(void)
{
    const uint64_t pattern = bits();
    double number;
    memcpy(&number, &pattern, sizeof number);
    return number;
}

static float any_single(void)
{
    const uint32_t pattern = (uint32_t)bits();
    float number;
    memcpy(&number, &pattern, sizeof number);
    return number;
}

static int text_is(SelfoscText text, const char *expected)
{
    return text.length == strlen(expected) && memcmp(text.bytes, expected, text.length) == 0;
}

static int pointers(void)
{
    SelfoscExperiment_f64 experiment;
    SelfoscController_f64 controller;
    SelfoscExperimentStep_f64 step;
    SelfoscControlStep_f64 moment;
    SelfoscProtocol_f64 protocol;
    SelfoscOutcome_f64 outcome;
    SelfoscRefusal why;
    memset(&experiment, 0, sizeof experiment);
    memset(&controller, 0, sizeof controller);
    CHECK(selfosc_experiment_step_f64(&experiment, 0.0, 0.0, &step) == SELFOSC_STATUS_NOT_BEGUN);
    CHECK(selfosc_controller_step_f64(&controller, 0.0, 0.0, 0.1, &moment) == SELFOSC_STATUS_NOT_BEGUN);
    CHECK(selfosc_experiment_step_f64(NULL, 0.0, 0.0, &step) == SELFOSC_STATUS_BAD_POINTER);
    CHECK(selfosc_experiment_begin_f64(&experiment, NULL, NULL) == SELFOSC_STATUS_BAD_POINTER);
    CHECK(selfosc_experiment_abort_f64(NULL) == SELFOSC_STATUS_BAD_POINTER);
    CHECK(selfosc_limit_cycle_f64(NULL, 1.0, 0.1, NULL, NULL) == SELFOSC_STATUS_BAD_POINTER);
    CHECK(selfosc_describe_f64(0, NULL, 1, 0.0, 1.0, NULL, NULL) == SELFOSC_STATUS_BAD_POINTER);
    CHECK(selfosc_protocol_f64(17, 1.0, 0.1, 1.0, 0.1, &protocol, NULL) == SELFOSC_STATUS_UNKNOWN_CHOICE);
    CHECK(selfosc_protocol_f64(SELFOSC_COORDINATE_POSITION, 1.0, 0.1, 1.0, 0.1, &protocol, NULL) == SELFOSC_STATUS_OK);
    CHECK(selfosc_experiment_begin_f64(&experiment, &protocol, NULL) == SELFOSC_STATUS_OK);
    CHECK(selfosc_experiment_step_f64(&experiment, 0.0, 0.0, NULL) == SELFOSC_STATUS_BAD_POINTER);
    CHECK(selfosc_experiment_outcome_f64(&experiment, &outcome) == SELFOSC_STATUS_NOT_DONE);
    /* A place of the other kind is no experiment. */
    memcpy(&controller, &experiment, sizeof controller);
    CHECK(selfosc_controller_step_f64(&controller, 0.0, 0.0, 0.1, &moment) == SELFOSC_STATUS_NOT_BEGUN);
    protocol.half_width = -1.0;
    CHECK(selfosc_experiment_begin_f64(&experiment, &protocol, &why) == SELFOSC_STATUS_OUT_OF_DOMAIN);
    CHECK(text_is(why.quantity, "half-width") && why.value == -1.0 && text_is(why.code, "out-of-domain"));
    return 0;
}

/* Gains of the catalogue that everybody knows, at an amplitude of 2. */
static int catalogue(void)
{
    static const struct {
        unsigned characteristic;
        size_t count;
        double parameters[10];
        double p;
    } known[] = {
        {SELFOSC_CHARACTERISTIC_RELAY, 1, {1.0}, 2.0 / 3.14159265358979323846},
        {SELFOSC_CHARACTERISTIC_RELAY_DEAD_ZONE, 2, {1.0, 0.0}, 2.0 / 3.14159265358979323846},
        {SELFOSC_CHARACTERISTIC_SATURATION, 2, {1.5, 3.0}, 1.5},
        {SELFOSC_CHARACTERISTIC_DEAD_ZONE, 2, {1.0, 2.5}, 0.0},
        {SELFOSC_CHARACTERISTIC_GAIN_CHANGING, 3, {2.0, 2.0, 1.0}, 2.0},
        {SELFOSC_CHARACTERISTIC_POWER, 2, {1.0, 3.0}, 3.0},
        {SELFOSC_CHARACTERISTIC_POLYNOMIAL, 10, {0.0, 1.0, 0.0, 1.0}, 4.0},
        {SELFOSC_CHARACTERISTIC_ABSOLUTE, 1, {1.0}, 0.0},
        {SELFOSC_CHARACTERISTIC_PIECEWISE_LINEAR, 4, {1.0, 1.0, 0.0, 0.0}, 1.0},
        {SELFOSC_CHARACTERISTIC_BACKLASH, 2, {1.0, 0.0}, 1.0},
        {SELFOSC_CHARACTERISTIC_TANH, 2, {1.0, 1e-4}, 1e-4},
        {SELFOSC_CHARACTERISTIC_SINE, 2, {1.0, 1e-4}, 1e-4},
        {SELFOSC_CHARACTERISTIC_SINH, 2, {1.0, 1e-4}, 1e-4},
        {SELFOSC_CHARACTERISTIC_ARCTAN, 2, {1.0, 1e-4}, 1e-4},
    };
    size_t i, j;
    unsigned characteristic;
    for (i = 0; i < sizeof known / sizeof known[0]; ++i) {
        SelfoscDescribingFunction_f64 df;
        SelfoscDescribingFunction_f32 single;
        float parameters[10];
        double missed;
        CHECK(selfosc_describe_f64(known[i].characteristic, known[i].parameters, known[i].count, 0.0, 2.0, &df, NULL)
              == SELFOSC_STATUS_OK);
        missed = fabs(df.p - known[i].p) / (1e-30 + fabs(known[i].p));
        CHECK(missed < 1e-7);
        for (j = 0; j < 10; ++j)
            parameters[j] = (float)known[i].parameters[j];
        CHECK(selfosc_describe_f32(known[i].characteristic, parameters, known[i].count, 0.0f, 2.0f, &single, NULL)
              == SELFOSC_STATUS_OK);
        CHECK(fabs((double)single.p - known[i].p) <= 1e-5 * fabs(known[i].p));
        CHECK(selfosc_describe_f64(known[i].characteristic, known[i].parameters, known[i].count + 1, 0.0, 2.0, &df, NULL)
              == SELFOSC_STATUS_WRONG_COUNT);
    }
    /* Each has the parameters that it names, and no more. */
    for (characteristic = 0; characteristic < 20; ++characteristic) {
        SelfoscParameter parameter;
        size_t count = 0;
        const double ones[10] = {1.0, 2.0, 3.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
        SelfoscDescribingFunction_f64 df;
        if (characteristic == SELFOSC_CHARACTERISTIC_PIECEWISE_LINEAR)
            continue;
        while (selfosc_parameter(characteristic, count, &parameter) == SELFOSC_STATUS_OK) {
            CHECK(parameter.name.length > 0 && parameter.meaning.length > 0 && parameter.domain.length > 0);
            ++count;
        }
        CHECK(count > 0 && count <= 10);
        CHECK(selfosc_describe_f64(characteristic, ones, count, 0.1, 9.0, &df, NULL) != SELFOSC_STATUS_WRONG_COUNT);
        CHECK(selfosc_describe_f64(characteristic, ones, count - 1, 0.1, 9.0, &df, NULL) == SELFOSC_STATUS_WRONG_COUNT);
    }
    CHECK(selfosc_parameter(20, 0, NULL) == SELFOSC_STATUS_BAD_POINTER);
    return 0;
}

static int thrusters(void)
{
    const SelfoscThruster_f64 thruster = {{2.0, 0.5, 0.1, 1.0}, {1.0, 0.5, 0.1, 1.0}};
    SelfoscDelivered_f64 delivered;
    double thrust_n, command;
    CHECK(selfosc_thruster_thrust_f64(&thruster, 0.5, &thrust_n, NULL) == SELFOSC_STATUS_OK && thrust_n == 0.75);
    CHECK(selfosc_thruster_command_f64(&thruster, 0.75, &command, NULL) == SELFOSC_STATUS_OK);
    CHECK(fabs(command - 0.5) < 1e-15);
    CHECK(selfosc_thruster_command_f64(&thruster, 1e3, &command, NULL) == SELFOSC_STATUS_REFUSED);
    CHECK(selfosc_thruster_command_clamped_f64(&thruster, -1e3, &delivered, NULL) == SELFOSC_STATUS_OK);
    CHECK(delivered.command == -1.0 && delivered.thrust_n == -1.5);
    CHECK(selfosc_thruster_thrust_f64(&thruster, NAN, &thrust_n, NULL) == SELFOSC_STATUS_OUT_OF_DOMAIN);
    return 0;
}

/* Numbers of all bit patterns wherever a number can go. */
static int fuzz(void)
{
    long round;
    for (round = 0; round < 20000; ++round) {
        double parameters[12];
        SelfoscDescribingFunction_f64 df;
        SelfoscAxis_f64 axis;
        SelfoscLimitCycle_f64 cycle;
        SelfoscProtocol_f32 protocol;
        SelfoscExperiment_f32 experiment;
        SelfoscControllerSettings_f64 settings = {SELFOSC_STRUCTURE_PID, 1.0, 0.3, 0.5, 0.1, -1.0, 2.0, 0.0, 1.0, 0.0};
        SelfoscController_f64 controller;
        SelfoscOscillation_f64 oscillation;
        SelfoscParameters_f64 found;
        int i;
        for (i = 0; i < 12; ++i)
            parameters[i] = any();
        if (selfosc_describe_f64((uint32_t)(bits() % 21), parameters, (size_t)(bits() % 11), any(), fabs(any()), &df, NULL)
            == SELFOSC_STATUS_OK)
            CHECK(isfinite(df.f0) && isfinite(df.p) && isfinite(df.q));
        axis.alpha = fabs(any());
        axis.linear_drag = fabs(any());
        axis.quadratic_drag = bits() % 2 ? fabs(any()) : 0.0;
        axis.disturbance = bits() % 2 ? any() : 0.0;
        axis.delay_s = bits() % 2 ? fabs(any()) : 0.0;
        if (selfosc_limit_cycle_f64(&axis, fabs(any()), fabs(any()), &cycle, NULL) == SELFOSC_STATUS_OK)
            CHECK(!isnan(cycle.amplitude) && !isnan(cycle.period_s));
        memcpy(&oscillation, parameters, sizeof oscillation);
        (void)selfosc_identify_f64(&oscillation, &found, NULL);
        CHECK(selfosc_protocol_f32(SELFOSC_COORDINATE_HEADING_RAD, 1.0f, 0.3f, 1.5f, 0.1f, &protocol, NULL)
              == SELFOSC_STATUS_OK);
        if (bits() % 4 == 0)
            protocol.spread = any_single();
        if (selfosc_experiment_begin_f32(&experiment, &protocol, NULL) == SELFOSC_STATUS_OK)
            for (i = 0; i < 40; ++i) {
                SelfoscExperimentStep_f32 step;
                const float reading = bits() % 30 ? 0.05f * (float)i : any_single();
                const float time_s = bits() % 30 ? 0.1f * (float)i : any_single();
                CHECK((bits() % 9 ? selfosc_experiment_step_f32(&experiment, reading, time_s, &step)
                                  : selfosc_experiment_tick_f32(&experiment, time_s, &step))
                      == SELFOSC_STATUS_OK);
                CHECK(step.command >= protocol.lowest_command && step.command <= protocol.highest_command);
                CHECK(step.phase == SELFOSC_PHASE_RUNNING || step.command == protocol.neutral_command);
            }
        CHECK(selfosc_controller_begin_f64(&controller, &settings, NULL) == SELFOSC_STATUS_OK);
        for (i = 0; i < 40; ++i) {
            SelfoscControlStep_f64 step;
            CHECK(selfosc_controller_step_f64(&controller, bits() % 5 ? 1.0 : any(), bits() % 5 ? 0.5 : any(),
                                              bits() % 5 ? 0.1 : any(), &step)
                  == SELFOSC_STATUS_OK);
            CHECK(step.command >= -1.0 && step.command <= 2.0);
        }
    }
    return 0;
}

int main(void)
{
    return pointers() || catalogue() || thrusters() || fuzz();
}
