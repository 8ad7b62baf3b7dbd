/* From a vehicle that nobody knows to a tuned heading controller: the relay experiment, what it identifies, gains, and a turn
 * of one radian. The vehicle is simulated in vehicle.h. */
#include <math.h>
#include <stdio.h>

#include "selfosc.h"
#include "vehicle.h"

static int refused(const char *what, SelfoscStatus status, const SelfoscRefusal *why)
{
    fprintf(stderr, "%s: status %d %.*s %.*s = %g %.*s\n", what, (int)status, (int)why->code.length, why->code.bytes,
            (int)why->quantity.length, why->quantity.bytes, why->value, (int)why->remedy.length, why->remedy.bytes);
    return 1;
}

int main(void)
{
    const double interval_s = 0.05, delay_s = VEHICLE_DELAY * interval_s;
    Vehicle vehicle = vehicle_at_rest(0.04, 0.03, 0.0);
    SelfoscRefusal why = {0};
    SelfoscStatus status;
    SelfoscProtocol_f64 protocol;
    SelfoscExperiment_f64 experiment;
    SelfoscExperimentStep_f64 step;
    SelfoscOutcome_f64 outcome;
    SelfoscMeanCycle_f64 cycle;
    SelfoscAxis_f64 axis;
    SelfoscLimitCycle_f64 again;
    SelfoscControllerSettings_f64 settings = {0};
    SelfoscController_f64 controller;
    SelfoscControlStep_f64 moment = {0};
    double largest = 0.0;
    int sample;

    /* A torque of 0.02 N m about a heading of zero, hysteresis of 0.2 rad, at most 1.5 rad away. */
    status = selfosc_protocol_f64(SELFOSC_COORDINATE_HEADING_RAD, 0.02, 0.2, 1.5, interval_s, &protocol, &why);
    if (status == SELFOSC_STATUS_OK)
        status = selfosc_experiment_begin_f64(&experiment, &protocol, &why);
    if (status != SELFOSC_STATUS_OK)
        return refused("experiment", status, &why);
    sample = 0;
    do {
        status = selfosc_experiment_step_f64(&experiment, vehicle.position, sample * interval_s, &step);
        if (status != SELFOSC_STATUS_OK)
            return refused("step", status, &why);
        vehicle_advance(&vehicle, step.command, interval_s);
        ++sample;
    } while (step.phase == SELFOSC_PHASE_RUNNING);
    status = selfosc_experiment_outcome_f64(&experiment, &outcome);
    if (status != SELFOSC_STATUS_OK) {
        fprintf(stderr, "no outcome: %.*s\n", (int)step.fault.length, step.fault.bytes);
        return 1;
    }
    printf("%u cycles: amplitude %.4f rad, period %.3f s\n", outcome.cycles, outcome.amplitude.mean, outcome.period_s.mean);

    /* The command is held: half an interval on average, on top of the delay on its way. */
    cycle.relay_level = outcome.relay_level;
    cycle.switch_level = outcome.switch_level.mean;
    cycle.amplitude = outcome.amplitude.mean;
    cycle.time_positive_s = outcome.time_positive_s.mean;
    cycle.time_negative_s = outcome.time_negative_s.mean;
    cycle.delay_s = delay_s;
    status = selfosc_identify_exact_f64(&cycle, SELFOSC_DRAG_LAW_LINEAR, &axis, &why);
    if (status != SELFOSC_STATUS_OK)
        return refused("identification", status, &why);
    printf("inertia %.4f (true %.4f), drag %.4f (true %.4f)\n", axis.alpha, vehicle.alpha, axis.linear_drag,
           vehicle.linear_drag);
    if (fabs(axis.alpha / vehicle.alpha - 1.0) > 0.05 || fabs(axis.linear_drag / vehicle.linear_drag - 1.0) > 0.2)
        return 2;

    status = selfosc_limit_cycle_f64(&axis, cycle.relay_level, cycle.switch_level, &again, &why);
    if (status != SELFOSC_STATUS_OK)
        return refused("limit cycle", status, &why);
    printf("its limit cycle at that level: amplitude %.4f rad, period %.3f s\n", again.amplitude, again.period_s);

    settings.lowest_command = -0.1;
    settings.highest_command = 0.1;
    settings.turn = 2.0 * 3.14159265358979323846;
    settings.longest_hold_s = 1.0;
    status = selfosc_tune_f64(&axis, SELFOSC_STRUCTURE_PD, 0.7, &settings, &why);
    if (status == SELFOSC_STATUS_OK)
        status = selfosc_controller_begin_f64(&controller, &settings, &why);
    if (status != SELFOSC_STATUS_OK)
        return refused("controller", status, &why);
    vehicle = vehicle_at_rest(vehicle.alpha, vehicle.linear_drag, 0.0);
    for (sample = 0; sample < 600; ++sample) {
        status = selfosc_controller_step_f64(&controller, 1.0, vehicle.position, interval_s, &moment);
        if (status != SELFOSC_STATUS_OK)
            return refused("control", status, &why);
        vehicle_advance(&vehicle, moment.command, interval_s);
        if (vehicle.position > largest)
            largest = vehicle.position;
    }
    printf("after 30 s at %.4f rad of 1, largest %.4f\n", vehicle.position, largest);
    return fabs(vehicle.position - 1.0) < 0.01 && largest < 1.1 ? 0 : 3;
}
