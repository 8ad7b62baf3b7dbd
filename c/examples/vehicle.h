/* A vehicle to try things on: one axis with drag, a command that is held and delayed. It shares nothing with the library. */
#ifndef VEHICLE_H
#define VEHICLE_H

#include <math.h>
#include <string.h>

enum { VEHICLE_DELAY = 4, VEHICLE_SUBSTEPS = 50 };

typedef struct {
    double alpha, linear_drag, quadratic_drag;
    double position, speed;
    double on_the_way[VEHICLE_DELAY];
} Vehicle;

static Vehicle vehicle_at_rest(double alpha, double linear_drag, double quadratic_drag)
{
    Vehicle vehicle;
    memset(&vehicle, 0, sizeof vehicle);
    vehicle.alpha = alpha;
    vehicle.linear_drag = linear_drag;
    vehicle.quadratic_drag = quadratic_drag;
    return vehicle;
}

/* One sampling interval: the command takes VEHICLE_DELAY of them to arrive. */
static void vehicle_advance(Vehicle *vehicle, double command, double interval_s)
{
    const double force = vehicle->on_the_way[0];
    const double dt = interval_s / VEHICLE_SUBSTEPS;
    int i;
    for (i = 1; i < VEHICLE_DELAY; ++i)
        vehicle->on_the_way[i - 1] = vehicle->on_the_way[i];
    vehicle->on_the_way[VEHICLE_DELAY - 1] = command;
    for (i = 0; i < VEHICLE_SUBSTEPS; ++i) {
        const double drag = vehicle->linear_drag + vehicle->quadratic_drag * fabs(vehicle->speed);
        vehicle->speed += dt * (force - drag * vehicle->speed) / vehicle->alpha;
        vehicle->position += dt * vehicle->speed;
    }
}

#endif
