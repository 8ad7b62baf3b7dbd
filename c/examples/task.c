/* The same loop in the shape of a task of a real-time operating system, in single precision: a message queue with a timeout
 * between driver and task, a mode that goes from experiment to control or to neutral, one way out for the command, and a
 * driver that falls silent. The queue and the clock stand for those of the system. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include "selfosc.h"
#include "vehicle.h"

#define INTERVAL_S 0.05f

/* What the system would give: the newest reading, or nothing before the timeout. */
typedef struct {
    float heading_rad;
    float time_s;
    bool fresh;
} Message;

typedef enum { MODE_EXPERIMENT, MODE_CONTROL, MODE_NEUTRAL } Mode;

typedef struct {
    Mode mode;
    const char *reason;
    SelfoscExperiment_f32 experiment;
    SelfoscController_f32 controller;
} Task;

static void task_neutral(Task *task, const char *reason)
{
    task->mode = MODE_NEUTRAL;
    task->reason = reason;
}

static void task_begin(Task *task)
{
    SelfoscProtocol_f32 protocol;
    task->mode = MODE_EXPERIMENT;
    task->reason = "running";
    if (selfosc_protocol_f32(SELFOSC_COORDINATE_HEADING_RAD, 0.02f, 0.2f, 1.5f, INTERVAL_S, &protocol, NULL)
            != SELFOSC_STATUS_OK
        || selfosc_experiment_begin_f32(&task->experiment, &protocol, NULL) != SELFOSC_STATUS_OK)
        task_neutral(task, "protocol refused");
}

/* Long, and once only: not in the loop of a task with a tight deadline. */
static void task_tune(Task *task)
{
    SelfoscOutcome_f32 outcome;
    SelfoscMeanCycle_f32 cycle;
    SelfoscAxis_f32 axis;
    SelfoscControllerSettings_f32 settings = {0};
    if (selfosc_experiment_outcome_f32(&task->experiment, &outcome) != SELFOSC_STATUS_OK) {
        task_neutral(task, "no outcome");
        return;
    }
    cycle.relay_level = outcome.relay_level;
    cycle.switch_level = outcome.switch_level.mean;
    cycle.amplitude = outcome.amplitude.mean;
    cycle.time_positive_s = outcome.time_positive_s.mean;
    cycle.time_negative_s = outcome.time_negative_s.mean;
    cycle.delay_s = VEHICLE_DELAY * INTERVAL_S;
    settings.lowest_command = -0.1f;
    settings.highest_command = 0.1f;
    settings.turn = 6.2831853f;
    settings.longest_hold_s = 0.5f;
    if (selfosc_identify_exact_f32(&cycle, SELFOSC_DRAG_LAW_LINEAR, &axis, NULL) != SELFOSC_STATUS_OK
        || selfosc_tune_f32(&axis, SELFOSC_STRUCTURE_PD, 0.7f, &settings, NULL) != SELFOSC_STATUS_OK
        || selfosc_controller_begin_f32(&task->controller, &settings, NULL) != SELFOSC_STATUS_OK) {
        task_neutral(task, "not tuned");
        return;
    }
    task->mode = MODE_CONTROL;
    task->reason = "tuned";
}

/* Once every interval, whether or not a message came. */
static float task_run(Task *task, const Message *message, float now_s)
{
    SelfoscExperimentStep_f32 step;
    SelfoscControlStep_f32 moment;
    SelfoscStatus status;
    switch (task->mode) {
    case MODE_EXPERIMENT:
        status = message->fresh
                     ? selfosc_experiment_step_f32(&task->experiment, message->heading_rad, message->time_s, &step)
                     : selfosc_experiment_tick_f32(&task->experiment, now_s, &step);
        if (status != SELFOSC_STATUS_OK) {
            task_neutral(task, "status");
            return 0.0f;
        }
        if (step.phase == SELFOSC_PHASE_DONE)
            task_tune(task);
        else if (step.phase == SELFOSC_PHASE_FAILED)
            task_neutral(task, "fault");
        return step.command;
    case MODE_CONTROL:
        /* What is not a number is a lost reading: the controller holds, and goes neutral after half a second. */
        status = selfosc_controller_step_f32(&task->controller, 1.0f, message->fresh ? message->heading_rad : NAN,
                                             INTERVAL_S, &moment);
        if (status != SELFOSC_STATUS_OK) {
            task_neutral(task, "status");
            return 0.0f;
        }
        return moment.command;
    case MODE_NEUTRAL:
        break;
    }
    return 0.0f;
}

/* The system: the driver is silent in one sample of twenty, and for good after `silent_s`. */
static Mode run(float silent_s, float *heading_rad, float *command)
{
    Vehicle vehicle = vehicle_at_rest(0.04, 0.03, 0.0);
    Task task;
    int sample;
    task_begin(&task);
    for (sample = 0; sample < 4000; ++sample) {
        const float now_s = (float)sample * INTERVAL_S;
        Message message;
        message.fresh = sample % 20 != 19 && now_s < silent_s;
        message.time_s = now_s;
        message.heading_rad = (float)vehicle.position;
        *command = task_run(&task, &message, now_s);
        vehicle_advance(&vehicle, (double)*command, (double)INTERVAL_S);
    }
    *heading_rad = (float)vehicle.position;
    printf("driver silent after %g s: %s, heading %.3f rad, command %.4f\n", (double)silent_s, task.reason,
           (double)*heading_rad, (double)*command);
    return task.mode;
}

int main(void)
{
    float heading_rad, command;
    if (run(1e9f, &heading_rad, &command) != MODE_CONTROL || fabsf(heading_rad - 1.0f) > 0.01f)
        return 1;
    /* In the middle of the experiment: a fault, and neutral. */
    if (run(3.0f, &heading_rad, &command) != MODE_NEUTRAL || command != 0.0f)
        return 2;
    /* Under control: held, then neutral. */
    if (run(150.0f, &heading_rad, &command) != MODE_CONTROL || command != 0.0f)
        return 3;
    return 0;
}
