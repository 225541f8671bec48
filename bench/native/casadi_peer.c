/* C that CasADi wrote, as a peer: the record is the flat input itself. WORK_SIZE: doubles of its work array.
 * What follows at the end are the works of the file, a line each. */
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
static void call(written f, const double *record, double *out)
{
    const double *speeds = record + 6 + FLYWHEELS;
    const double *arg[ARGUMENTS] = { record,
                                     record + 6,
                                     speeds,
                                     speeds + FLYWHEELS,
                                     speeds + 2 * FLYWHEELS,
                                     speeds + 3 * FLYWHEELS };
    double       *res[ARGUMENTS] = { out };

    (void)f(arg, res, indices, work, 0);
}

#define WORK(name)                                                                  \
    int  name(const double **arg, double **res, long long *iw, double *w, int mem); \
    void peer_##name(const double *record, double *out) { call(name, record, out); }

