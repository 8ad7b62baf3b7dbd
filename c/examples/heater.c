/* From a heater that nobody knows to PID gains, on the controller itself in single precision: a thermostat's record of 256 readings, the
 * process that it tells, gains of bounded sensitivity, and a step of the set point. The heater is simulated. */
#include <math.h>
#include <stdio.h>

#include "selfosc.h"

enum { READINGS = 256, LATE = 14 };

/* 180 K at full power, time constant 110 s, dead time 7 s, exact over half a second of constant power. */
typedef struct {
    double above_room, power[LATE + 1];
    int now;
} Heater;

static float heated(Heater *heater, double power)
{
    double acts;
    heater->power[heater->now] = power;
    heater->now = (heater->now + 1) % (LATE + 1);
    acts = 180 * heater->power[heater->now];
    heater->above_room = acts + (heater->above_room - acts) * exp(-0.5 / 110);
    return (float)(22 + round(4 * heater->above_room) / 4);
}

static int refused(const char *what, SelfoscStatus status, const SelfoscRefusal *why)
{
    fprintf(stderr, "%s: status %d %.*s\n", what, (int)status, (int)why->code.length, why->code.bytes);
    return 1;
}

int main(void)
{
    static float time_s[READINGS], temperature[READINGS], power[READINGS];
    const float interval_s = 0.5f, level = 82;
    Heater heater = {60, {0}, 0};
    SelfoscRefusal why = {0};
    SelfoscProcess_f32 process;
    SelfoscControllerSettings_f32 settings = {0};
    SelfoscController_f32 controller;
    SelfoscControlStep_f32 step = {0};
    SelfoscStatus status;
    float reading = level, command = 1, largest = 0;
    int k;

    for (k = -200; k < READINGS; ++k) {
        command = reading > level + 0.5f ? 0 : reading < level - 0.5f ? 1 : command;
        if (k >= 0) {
            time_s[k] = interval_s * (float)k;
            temperature[k] = reading;
            power[k] = command;
        }
        reading = heated(&heater, command);
    }
    status = selfosc_process_f32(time_s, temperature, power, READINGS, &process, &why);
    if (status != SELFOSC_STATUS_OK)
        return refused("process", status, &why);
    printf("T/K %.4f s (true %.4f), dead time %.2f s (true 7)\n", process.drag, 110.0 / 180, process.dead_time_s);
    if (fabs(process.drag * 180 / 110 - 1) > 0.05 || fabs(process.dead_time_s - 7) > 0.3 || process.reverse)
        return 2;

    settings.lowest_command = 0;
    settings.highest_command = 1;
    settings.longest_hold_s = 5;
    status = selfosc_process_gains_f32(&process, interval_s, &settings, &why);
    if (status == SELFOSC_STATUS_OK)
        status = selfosc_controller_begin_f32(&controller, &settings, &why);
    if (status != SELFOSC_STATUS_OK)
        return refused("gains", status, &why);
    printf("Kp %.4f, Ki %.5f / s, Kd %.3f s\n", settings.proportional, settings.integral, settings.derivative);
    for (k = 0; k < 1200; ++k) {
        status = selfosc_controller_step_f32(&controller, level + 5, reading, interval_s, &step);
        if (status != SELFOSC_STATUS_OK)
            return refused("control", status, &why);
        reading = heated(&heater, step.command);
        if (reading > largest)
            largest = reading;
    }
    printf("after ten minutes at %.2f of %.0f, largest %.2f\n", reading, level + 5, largest);
    return fabs(reading - level - 5) < 0.5 && largest < level + 8 ? 0 : 3;
}
