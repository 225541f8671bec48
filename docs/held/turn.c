#include <stdio.h>
#include "air_table.h"

enum { N = AIR_TABLE_N };
static const double omega = 1.0, zeta = 0.8;  /* of the errors: s^2 + 2 zeta omega s + omega^2 */

/* Vector part of conj(goal) q: half the turn from the goal, in the axes of the table; the short way round. */
static void turn_from(const double goal[4], const double q[4], double e[3])
{
    const double w = goal[0] * q[0] + goal[1] * q[1] + goal[2] * q[2] + goal[3] * q[3];
    const double sign = (w < 0) ? -1 : 1;
    e[0] = sign * (goal[0] * q[1] - goal[1] * q[0] - goal[2] * q[3] + goal[3] * q[2]);
    e[1] = sign * (goal[0] * q[2] + goal[1] * q[3] - goal[2] * q[0] - goal[3] * q[1]);
    e[2] = sign * (goal[0] * q[3] - goal[1] * q[2] + goal[2] * q[1] - goal[3] * q[0]);
}

/* One sample: torques of the wheels for a state that the sensors and encoders measure. */
static air_table_status control(const air_table_state *x, const double goal[4], double tau[N])
{
    double e[3], phi_ddot[N], V_dot[6] = { 0 };  /* S u_dot: O1 is the pivot */
    turn_from(goal, x->attitude, e);
    for (int i = 0; i < 3; ++i) { V_dot[3 + i] = -2 * zeta * omega * x->V[3 + i] - 2 * omega * omega * e[i]; }
    const air_table_status status =
        air_table_inverse_fast(&air_table_default, x, V_dot, &air_table_default_options, phi_ddot);
    return (status < 0) ? status : air_table_torque(&air_table_default, x, V_dot, phi_ddot, tau);
}

int main(void)
{
    static const double goal[4] = { 0.96572, 0.01745, 0, 0.25900 };  /* 30 degrees about z, and 2 of tilt */
    static const int released[N] = { 0 };
    air_table_state x = { .attitude = { 1, 0, 0, 0 } };
    for (int k = 0; k < 3000; ++k) {  /* 30 s at 100 Hz; the table is its own C */
        double tau[N], e[3];
        if (control(&x, goal, tau) < 0) { return 1; }
        if (k % 500 == 0) {
            turn_from(goal, x.attitude, e);
            printf("%2d s: %7.2f and %7.2f mrad to go, wheels at %6.1f %6.1f %6.1f rad/s\n", k / 100, 2e3 * e[0],
                   2e3 * e[2], x.phi_dot[0], x.phi_dot[1], x.phi_dot[2]);
        }
        if (air_table_step(&air_table_default, &x, tau, released, 0.01, 4, NULL, &x) < 0) { return 1; }
    }
    return 0;
}
