/* C that CasADi wrote, as a peer: the record is the flat input itself. WORK_SIZE: doubles of its work array. */
#include "peer.h"

#include <string.h>

#define INPUTS (12 + 4 * FLYWHEELS)

typedef int (*written)(const double **arg, double **res, long long *iw, double *w, int mem);

static double    work[WORK_SIZE];
static long long indices[1];

int peer_setup(const char *path) { (void)path; return 0; }
int peer_size(void) { return INPUTS; }
int peer_V(void) { return 0; }
int peer_phi(void) { return 6; }
void peer_pack(const double *flat, double *record) { memcpy(record, flat, INPUTS * sizeof *record); }

/* Inputs of every function: V, phi, phi_dot, phi_ddot, tau, V_dot; those it does not use cost nothing. */
#define WORK(name)                                                                                                    \
    int  name(const double **arg, double **res, long long *iw, double *w, int mem);                                   \
    void peer_##name(const double *record, double *out)                                                               \
    {                                                                                                                 \
        const double *arg[ARGUMENTS] = { record,             record + 6,         record + 6 + FLYWHEELS,                      \
                                         record + 6 + 2 * FLYWHEELS, record + 6 + 3 * FLYWHEELS, record + 6 + 4 * FLYWHEELS };                \
        double       *res[ARGUMENTS] = { out };                                                                       \
        (void)name(arg, res, indices, work, 0);                                                                       \
    }

WORK(forward)
#ifdef ALL_WORKS
WORK(coupled)
WORK(torque)
#endif
