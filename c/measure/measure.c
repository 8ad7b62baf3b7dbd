/* Worst case of every routine in instructions and bytes of stack: a parent follows its child instruction by instruction. For
 * Linux on x86-64. The runs are those of the examples, with disturbances; the worst case seen, not a bound. */
#define _GNU_SOURCE
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../examples/vehicle.h"
#include "selfosc.h"

typedef struct {
    char name[40];
    unsigned long long calls, instructions, stack;
} Routine;

static Routine *routines;
static volatile int *current;

static int index_of(const char *name)
{
    int i = 0;
    while (routines[i].name[0] && strcmp(routines[i].name, name))
        ++i;
    snprintf(routines[i].name, sizeof routines[i].name, "%s", name);
    return i;
}

/* Two breakpoints around the call: the parent counts between them. */
#define MEASURED(call) \
    do { \
        const char *stringified = #call; \
        char name[40]; \
        size_t length = strcspn(stringified, "("); \
        snprintf(name, sizeof name, "%.*s", (int)length, stringified); \
        *current = index_of(name); \
        __asm__ volatile("int3" ::: "memory"); \
        (void)call; \
        __asm__ volatile("int3" ::: "memory"); \
    } while (0)

#define SUBJECT(P, NUMBER) \
    static void subject_##P(void) \
    { \
        const NUMBER interval_s = (NUMBER)0.05; \
        int trial, sample; \
        unsigned characteristic; \
        for (characteristic = 0; characteristic < 20; ++characteristic) { \
            static const size_t counts[20] = {1, 2, 3, 3, 2, 3, 2, 3, 3, 2, 1, 2, 10, 2, 2, 2, 2, 1, 8, 2}; \
            const NUMBER numbers[10] = {1, (NUMBER)0.5, (NUMBER)0.25, 1, 2, 1, 3, 2, 1, 1}; \
            SelfoscDescribingFunction_##P df; \
            MEASURED(selfosc_describe_##P(characteristic, numbers, counts[characteristic], (NUMBER)0.3, 2, &df, NULL)); \
        } \
        for (trial = 0; trial < 3; ++trial) { \
            Vehicle vehicle = vehicle_at_rest(0.04, 0.03, 0.01 * trial); \
            SelfoscProtocol_##P protocol; \
            SelfoscExperiment_##P experiment; \
            SelfoscExperimentStep_##P step; \
            SelfoscOutcome_##P outcome; \
            SelfoscMeanCycle_##P cycle; \
            SelfoscAxis_##P axis; \
            SelfoscLimitCycle_##P orbit; \
            SelfoscControllerSettings_##P settings; \
            SelfoscController_##P controller; \
            SelfoscControlStep_##P moment; \
            SelfoscThruster_##P thruster = {{2, 0, (NUMBER)0.1, 1}, {1, (NUMBER)0.5, (NUMBER)0.1, 1}}; \
            SelfoscDelivered_##P delivered; \
            NUMBER command; \
            memset(&settings, 0, sizeof settings); \
            MEASURED(selfosc_protocol_##P(SELFOSC_COORDINATE_HEADING_RAD, (NUMBER)0.02, (NUMBER)0.2, (NUMBER)1.5, interval_s, \
                                          &protocol, NULL)); \
            protocol.resolution = (NUMBER)0.002; \
            MEASURED(selfosc_experiment_begin_##P(&experiment, &protocol, NULL)); \
            for (sample = 0; sample < 2000; ++sample) { \
                const double noise = 0.001 * sin(sample * 12.9898); \
                MEASURED(selfosc_experiment_step_##P(&experiment, (NUMBER)(vehicle.position + noise), \
                                                     (NUMBER)sample * interval_s, &step)); \
                MEASURED(selfosc_experiment_tick_##P(&experiment, (NUMBER)sample * interval_s, &step)); \
                vehicle_advance(&vehicle, (double)step.command, 0.05); \
                if (step.phase != SELFOSC_PHASE_RUNNING) \
                    break; \
            } \
            if (selfosc_experiment_outcome_##P(&experiment, &outcome) != SELFOSC_STATUS_OK) \
                exit(1); \
            MEASURED(selfosc_experiment_outcome_##P(&experiment, &outcome)); \
            cycle.relay_level = outcome.relay_level; \
            cycle.switch_level = outcome.switch_level.mean; \
            cycle.amplitude = outcome.amplitude.mean; \
            cycle.time_positive_s = outcome.time_positive_s.mean; \
            cycle.time_negative_s = outcome.time_negative_s.mean; \
            cycle.delay_s = (NUMBER)0.2; \
            { \
                const SelfoscOscillation_##P oscillation = {cycle.relay_level, cycle.switch_level, cycle.amplitude, 0, \
                                                            outcome.period_s.mean, cycle.delay_s}; \
                SelfoscParameters_##P found; \
                MEASURED(selfosc_identify_##P(&oscillation, &found, NULL)); \
            } \
            MEASURED(selfosc_identify_exact_##P(&cycle, SELFOSC_DRAG_LAW_QUADRATIC, &axis, NULL)); \
            MEASURED(selfosc_identify_exact_##P(&cycle, SELFOSC_DRAG_LAW_LINEAR, &axis, NULL)); \
            MEASURED(selfosc_limit_cycle_##P(&axis, cycle.relay_level, cycle.switch_level, &orbit, NULL)); \
            settings.lowest_command = (NUMBER)-0.1; \
            settings.highest_command = (NUMBER)0.1; \
            settings.turn = (NUMBER)6.283185307; \
            settings.longest_hold_s = 1; \
            MEASURED(selfosc_tune_##P(&axis, SELFOSC_STRUCTURE_PID, (NUMBER)0.6, &settings, NULL)); \
            { \
                SelfoscMargins_##P margins; \
                MEASURED(selfosc_margins_##P(&axis, SELFOSC_STRUCTURE_PID, (NUMBER)0.6, &margins, NULL)); \
            } \
            MEASURED(selfosc_controller_begin_##P(&controller, &settings, NULL)); \
            if (trial > 0) \
                MEASURED(selfosc_controller_feed_forward_##P(&controller, &axis, (NUMBER)0.5, (NUMBER)0.3, NULL)); \
            for (sample = 0; sample < 200; ++sample) { \
                const double reading = sample % 17 ? vehicle.position : NAN; \
                MEASURED(selfosc_controller_step_##P(&controller, 1, (NUMBER)reading, interval_s, &moment)); \
                vehicle_advance(&vehicle, (double)moment.command, 0.05); \
            } \
            MEASURED(selfosc_thruster_thrust_##P(&thruster, (NUMBER)0.7, &command, NULL)); \
            MEASURED(selfosc_thruster_command_##P(&thruster, (NUMBER)-0.7, &command, NULL)); \
            MEASURED(selfosc_thruster_command_clamped_##P(&thruster, (NUMBER)0.7, &delivered, NULL)); \
        } \
    }

SUBJECT(f64, double)
SUBJECT(f32, float)

static void follow(pid_t child)
{
    struct user_regs_struct at;
    unsigned long long begun = 0, count = 0, lowest = 0;
    siginfo_t cause;
    int status, counting = 0;
    for (;;) {
        waitpid(child, &status, 0);
        if (WIFEXITED(status) || !WIFSTOPPED(status) || WSTOPSIG(status) != SIGTRAP)
            break;
        ptrace(PTRACE_GETREGS, child, 0, &at);
        ptrace(PTRACE_GETSIGINFO, child, 0, &cause);
        if (cause.si_code == SI_KERNEL) { /* a breakpoint, not a step */
            if (counting) {
                Routine *routine = &routines[*current];
                routine->calls += 1;
                if (count > routine->instructions)
                    routine->instructions = count;
                if (begun - lowest > routine->stack)
                    routine->stack = begun - lowest;
            }
            counting = !counting;
            begun = lowest = at.rsp;
            count = 0;
        } else if (counting) {
            ++count;
            if (at.rsp < lowest)
                lowest = at.rsp;
        }
        ptrace(counting ? PTRACE_SINGLESTEP : PTRACE_CONT, child, 0, 0);
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        exit(1);
}

int main(void)
{
    int i;
    pid_t child;
    routines = mmap(NULL, 64 * sizeof *routines, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    current = mmap(NULL, sizeof *current, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    child = fork();
    if (child == 0) {
        ptrace(PTRACE_TRACEME, 0, 0, 0);
        subject_f64();
        subject_f32();
        _exit(0);
    }
    follow(child);
    printf("| place | bytes, f64 | bytes, f32 |\n|---|---|---|\n");
    printf("| experiment | %zu | %zu |\n", sizeof(SelfoscExperiment_f64), sizeof(SelfoscExperiment_f32));
    printf("| controller | %zu | %zu |\n\n", sizeof(SelfoscController_f64), sizeof(SelfoscController_f32));
    printf("| routine | calls | most instructions | most stack, bytes |\n|---|---|---|---|\n");
    for (i = 0; routines[i].name[0]; ++i)
        printf("| `%s` | %llu | %llu | %llu |\n", routines[i].name, routines[i].calls, routines[i].instructions,
               routines[i].stack);
    return 0;
}
