/* mahovik's batches as a peer: STAND is its prefix, HEADER their header. A record holds STATES states, by component. */
#include HEADER
#include "peer.h"

#include <string.h>

#define GLUE(a, b) a##_##b
#define PASTE(a, b) GLUE(a, b)
#define OWN(name) PASTE(STAND, name)
#define REALS (13 + 2 * FLYWHEELS)

typedef struct record {
    double x[REALS][STATES];
    double phi_ddot[FLYWHEELS][STATES];
    double tau[FLYWHEELS][STATES];
    double V_dot[6][STATES];
} record;

static const int    free_all[FLYWHEELS] = { 0 };
static const double time_step = 1e-4;
static OWN(status)  status[STATES];

int peer_setup(const char *path) { (void)path; return 0; }
int peer_size(void) { return (int)(sizeof(record) / sizeof(double)); }
int peer_V(void) { return 7 * STATES; }
int peer_phi(void) { return 13 * STATES; }

static void put(const double *flat, int from, int rows, int state, double to[][STATES])
{
    for (int i = 0; i < rows; ++i) { to[i][state] = flat[from + i]; }
}

void peer_pack(const double *flat, double *to)
{
    record *r = (record *)to;

    memset(r, 0, sizeof *r);
    for (int state = 0; state < STATES; ++state) {
        const double *one = flat + state * (12 + 4 * FLYWHEELS);
        r->x[3][state] = 1.0;
        put(one, 0, 6, state, r->x + 7);
        put(one, 6, 2 * FLYWHEELS, state, r->x + 13);
        put(one, 6 + 2 * FLYWHEELS, FLYWHEELS, state, r->phi_ddot);
        put(one, 6 + 3 * FLYWHEELS, FLYWHEELS, state, r->tau);
        put(one, 6 + 4 * FLYWHEELS, 6, state, r->V_dot);
    }
}

void peer_forward(const double *from, double *out)
{
    const record *r = (const record *)from;
    (void)OWN(forward_batch)(&OWN(default), STATES, r->x[0], r->phi_ddot[0], out, status);
}

void peer_coupled(const double *from, double *out)
{
    const record *r = (const record *)from;
    (void)OWN(coupled_batch)(&OWN(default), STATES, r->x[0], r->tau[0], free_all, out, out + 6 * STATES, status);
}

void peer_torque(const double *from, double *out)
{
    const record *r = (const record *)from;
    (void)OWN(torque_batch)(&OWN(default), STATES, r->x[0], r->V_dot[0], r->phi_ddot[0], out, status);
}

void peer_step(const double *from, double *out)
{
    const record *r = (const record *)from;
    (void)OWN(step_batch)(&OWN(default), STATES, r->x[0], r->tau[0], free_all, time_step, 4, out, status);
}
