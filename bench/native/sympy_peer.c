/* C that SymPy wrote of K and the right side of (8), as a peer; solved by LDL^T here. The record is the flat input. */
#include "peer.h"

#include <string.h>

#define INPUTS (12 + 4 * FLYWHEELS)

void literal(const double *V, const double *phi, const double *phi_dot, const double *phi_ddot, double *K, double *b);

int peer_setup(const char *path) { (void)path; return 0; }
int peer_size(void) { return INPUTS; }
int peer_V(void) { return 0; }
int peer_phi(void) { return 6; }
void peer_pack(const double *flat, double *record) { memcpy(record, flat, INPUTS * sizeof *record); }

static void solve(double K[6][6], double b[6])
{
    int i, j, k;

    for (j = 0; j < 6; ++j) { /* K becomes D and L below it */
        for (i = j + 1; i < 6; ++i) {
            const double l = K[i][j] / K[j][j];
            for (k = j + 1; k <= i; ++k) { K[i][k] -= l * K[k][j]; }
            b[i] -= l * b[j];
        }
        for (i = j + 1; i < 6; ++i) { K[i][j] /= K[j][j]; }
    }
    for (i = 5; i >= 0; --i) {
        b[i] /= K[i][i];
        for (k = i + 1; k < 6; ++k) { b[i] -= K[k][i] * b[k]; }
    }
}

void peer_forward(const double *record, double *out)
{
    double K[6][6];

    literal(record, record + 6, record + 6 + FLYWHEELS, record + 6 + 2 * FLYWHEELS, &K[0][0], out);
    solve(K, out);
}
