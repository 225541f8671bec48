/* mahovik's C as a peer: STAND is its prefix, HEADER its header. Every call checks its inputs, as in firmware. */
#include HEADER
#include "peer.h"

#include <string.h>

#define GLUE(a, b) a##_##b
#define PASTE(a, b) GLUE(a, b)
#define OWN(name) PASTE(STAND, name)

typedef struct record {
    OWN(state) x;
    double     phi_ddot[FLYWHEELS];
    double     tau[FLYWHEELS];
    double     V_dot[6];
} record;

static const int    free_all[FLYWHEELS] = { 0 };
static const double time_step = 1e-4;

int peer_setup(const char *path) { (void)path; return 0; }
int peer_size(void) { return (int)(sizeof(record) / sizeof(double)); }
int peer_V(void) { return 7; }
int peer_phi(void) { return 13; }

void peer_pack(const double *flat, double *to)
{
    record *r = (record *)to;

    memset(r, 0, sizeof *r);
    r->x.attitude[0] = 1.0;
    memcpy(r->x.V, flat, sizeof r->x.V);
    memcpy(r->x.phi, flat + 6, sizeof r->x.phi);
    memcpy(r->x.phi_dot, flat + 6 + FLYWHEELS, sizeof r->x.phi_dot);
    memcpy(r->phi_ddot, flat + 6 + 2 * FLYWHEELS, sizeof r->phi_ddot);
    memcpy(r->tau, flat + 6 + 3 * FLYWHEELS, sizeof r->tau);
    memcpy(r->V_dot, flat + 6 + 4 * FLYWHEELS, sizeof r->V_dot);
}

void peer_forward(const double *from, double *out)
{
    const record *r = (const record *)from;
    (void)OWN(forward)(&OWN(default), &r->x, r->phi_ddot, out);
}

void peer_coupled(const double *from, double *out)
{
    const record *r = (const record *)from;
    (void)OWN(coupled)(&OWN(default), &r->x, r->tau, free_all, out, out + 6);
}

void peer_torque(const double *from, double *out)
{
    const record *r = (const record *)from;
    (void)OWN(torque)(&OWN(default), &r->x, r->V_dot, r->phi_ddot, out);
}

void peer_step(const double *from, double *out)
{
    const record *r = (const record *)from;
    (void)OWN(step)(&OWN(default), &r->x, r->tau, free_all, time_step, 4, NULL, (OWN(state) *)out);
}

void peer_inverse(const double *from, double *out)
{
    const record              *r = (const record *)from;
    static OWN(inverse_result) result;

    (void)OWN(inverse)(&OWN(default), &r->x, r->V_dot, &OWN(default_options), &result);
    memcpy(out, result.phi_ddot, sizeof result.phi_ddot);
}

void peer_inverse_fast(const double *from, double *out)
{
    const record *r = (const record *)from;
    (void)OWN(inverse_fast)(&OWN(default), &r->x, r->V_dot, &OWN(default_options), out);
}

void peer_forward_jacobian(const double *from, double *out)
{
    const record *r = (const record *)from;
    (void)OWN(forward_jacobian)(&OWN(default), &r->x, r->phi_ddot, (OWN(forward_jacobian_result) *)out);
}

void peer_coupled_jacobian(const double *from, double *out)
{
    const record *r = (const record *)from;
    (void)OWN(coupled_jacobian)(&OWN(default), &r->x, r->tau, free_all, (OWN(coupled_jacobian_result) *)out);
}
