/* MuJoCo as a peer: mj_forward and mj_inverse, contacts and constraints disabled in the model.
 * The carrier is aligned with E0, so its linear velocity needs no turning; the derivative of the components of v is
 * MuJoCo's linear acceleration minus omega x v. */
#include "peer.h"

#include <mujoco/mujoco.h>
#include <string.h>

static mjModel *model;
static mjData  *data;

#define POSITIONS (7 + FLYWHEELS)
#define RATES (6 + FLYWHEELS)

typedef struct record {
    double qpos[POSITIONS];
    double qvel[RATES];
    double forces[RATES];
    double qacc[RATES];
} record;

int peer_setup(const char *path)
{
    model = mj_loadModel(path, NULL);
    if (model == NULL) {
        return 1;
    }
    data = mj_makeData(model);
    return data == NULL || model->nq != POSITIONS || model->nv != RATES;
}

int peer_size(void) { return (int)(sizeof(record) / sizeof(double)); }
int peer_V(void) { return POSITIONS; }
int peer_phi(void) { return 7; }

static void turning(const double *V, double out[3])
{
    out[0] = V[4] * V[2] - V[5] * V[1];
    out[1] = V[5] * V[0] - V[3] * V[2];
    out[2] = V[3] * V[1] - V[4] * V[0];
}

void peer_pack(const double *flat, double *to)
{
    record *r = (record *)to;
    double  turn[3];
    int     i;

    memset(r, 0, sizeof *r);
    r->qpos[3] = 1.0;
    memcpy(r->qpos + 7, flat + 6, FLYWHEELS * sizeof(double));
    memcpy(r->qvel, flat, 6 * sizeof(double));
    memcpy(r->qvel + 6, flat + 6 + FLYWHEELS, FLYWHEELS * sizeof(double));
    memcpy(r->forces + 6, flat + 6 + 3 * FLYWHEELS, FLYWHEELS * sizeof(double));
    memcpy(r->qacc, flat + 6 + 4 * FLYWHEELS, 6 * sizeof(double));
    memcpy(r->qacc + 6, flat + 6 + 2 * FLYWHEELS, FLYWHEELS * sizeof(double));
    turning(flat, turn);
    for (i = 0; i < 3; ++i) { r->qacc[i] += turn[i]; }
}

void peer_coupled(const double *from, double *out)
{
    const record *r = (const record *)from;
    double        turn[3];
    int           i;

    memcpy(data->qpos, r->qpos, sizeof r->qpos);
    memcpy(data->qvel, r->qvel, sizeof r->qvel);
    memcpy(data->qfrc_applied, r->forces, sizeof r->forces);
    mj_forward(model, data);
    memcpy(out, data->qacc, RATES * sizeof(double));
    turning(r->qvel, turn);
    for (i = 0; i < 3; ++i) { out[i] -= turn[i]; }
}

void peer_torque(const double *from, double *out)
{
    const record *r = (const record *)from;

    memcpy(data->qpos, r->qpos, sizeof r->qpos);
    memcpy(data->qvel, r->qvel, sizeof r->qvel);
    memcpy(data->qacc, r->qacc, sizeof r->qacc);
    mj_inverse(model, data);
    memcpy(out, data->qfrc_inverse + 6, FLYWHEELS * sizeof(double));
}
