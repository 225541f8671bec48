/* demo3_eva.c: drivers of Frama-C Eva for the stand "demo3": what is proved of demo3.c. Run by demo3_eva.sh.
 * mahovik 0.1.0; structure 055bf547, physics fdeb29e7. Generated: change the stand file instead.
 *
 * Not for firmware: only Frama-C reads this file. A driver calls one function with all inputs of a set at once:
 *   normal   magnitudes of ordinary use: the numbers in the driver
 *   any      every finite number, every integer: what the checks of the function let through is all it computes with
 *   bits     every bit pattern: NaN and infinities as well
 * normal, any: Eva shows that no operation is undefined (index, uninitialised read, integer overflow, division by
 * zero) and that no real becomes infinite or NaN on the way; of the results, that they are written and finite where
 * the status is not negative, and untouched where it is. bits, with -warn-special-float none: the same, but nothing of
 * finiteness, for Eva 25 lets NaN pass a comparison that C does not. */
#include <limits.h>

#include "__fc_builtin.h"
#include "features.h"
#include "demo3.h"

/* Routines that work on the bits of a real are beyond intervals. For the sets normal and any they are what is said here,
 * proved elsewhere (docs/mathematics.md of mahovik: sine and cosine to a unit in the last place, square root correctly
 * rounded, so Eva's own stands for it); for the others, and in drivers of their own, Eva reads their bodies. */

/*@ requires -10000000.0 <= x <= 10000000.0;
    assigns *sine, *cosine \from x;
    ensures \initialized(sine) && \initialized(cosine);
    ensures \is_finite(*sine) && \is_finite(*cosine);
    ensures -1.0000002 <= *sine <= 1.0000002;
    ensures -1.0000002 <= *cosine <= 1.0000002; */
static void demo3_sincos(demo3_real x, demo3_real *restrict sine, demo3_real *restrict cosine);

/*@
    requires -10000000.0 <= x[0] <= 10000000.0;
    requires -10000000.0 <= x[1] <= 10000000.0;
    requires -10000000.0 <= x[2] <= 10000000.0;
    assigns sine[0 .. 2], cosine[0 .. 2] \from x[0 .. 2];
    ensures \initialized(sine + 0) && \initialized(cosine + 0);
    ensures \is_finite(sine[0]) && \is_finite(cosine[0]);
    ensures -1.0000002 <= sine[0] <= 1.0000002;
    ensures -1.0000002 <= cosine[0] <= 1.0000002;
    ensures \initialized(sine + 1) && \initialized(cosine + 1);
    ensures \is_finite(sine[1]) && \is_finite(cosine[1]);
    ensures -1.0000002 <= sine[1] <= 1.0000002;
    ensures -1.0000002 <= cosine[1] <= 1.0000002;
    ensures \initialized(sine + 2) && \initialized(cosine + 2);
    ensures \is_finite(sine[2]) && \is_finite(cosine[2]);
    ensures -1.0000002 <= sine[2] <= 1.0000002;
    ensures -1.0000002 <= cosine[2] <= 1.0000002;
*/
static void demo3_sincos_each(const demo3_real *x, demo3_real *restrict sine,
    demo3_real *restrict cosine);

__PUSH_FC_STDLIB
/*@ requires x >= 0.0;
    assigns \result \from x; */
static demo3_real demo3_sqrt(demo3_real x);
__POP_FC_STDLIB

#include "demo3.c"

/* ---- sets of numbers ---- */

static demo3_real real_in(demo3_real low, demo3_real high)
{
    return Frama_C_double_interval(low, high);
}

static void reals(demo3_real *x, int count, demo3_real size)
{
    for (int i = 0; i < count; ++i) { x[i] = real_in(-size, size); }
}

static volatile demo3_real any_bits;  /* Eva: each read may give every bit pattern */

static void all_bits(demo3_real *x, int count)
{
    for (int i = 0; i < count; ++i) { x[i] = any_bits; }
}

static void not_finite(demo3_real *x)
{
    const demo3_real zero = 0.0;
    switch (Frama_C_interval(0, 2)) {
    case 0: *x = 1.0 / zero; break;
    case 1: *x = -1.0 / zero; break;
    default: *x = zero / zero; break;
    }
}

/* One number of any bits, finite numbers apart from the others. */
static void one_of_all(demo3_real *x)
{
    if (Frama_C_interval(0, 1) == 0) {
        not_finite(x);
    } else {
        *x = real_in(-DEMO3_LARGEST, DEMO3_LARGEST);
    }
}

static void integers(int *x, int count, int low, int high)
{
    for (int i = 0; i < count; ++i) { x[i] = Frama_C_interval(low, high); }
}

/* A number within one part in a hundred of another. */
static demo3_real near(demo3_real x)
{
    const demo3_real a = x * 0.99;
    const demo3_real b = x * 1.01;
    return a <= b ? real_in(a, b) : real_in(b, a);
}

static void about(demo3_real *x, const demo3_real *middle, int count)
{
    for (int i = 0; i < count; ++i) { x[i] = near(middle[i]); }
}

/* A quaternion. Where the sum of four squares is at least 0.998001, one of them is at least a quarter of that: so one
 * component is at least 0.499 in magnitude. Which, and its sign, are eight cases; all others are refused by
 * the checks, which the case without a large component shows. */
static void quaternion(demo3_real q[4], demo3_real size)
{
    const int large = Frama_C_interval(0, 8);
    reals(q, 4, size);
    switch (large) {
    case 0: q[0] = real_in(0.499, size); break;
    case 1: q[0] = real_in(-size, -0.499); break;
    case 2: q[1] = real_in(0.499, size); break;
    case 3: q[1] = real_in(-size, -0.499); break;
    case 4: q[2] = real_in(0.499, size); break;
    case 5: q[2] = real_in(-size, -0.499); break;
    case 6: q[3] = real_in(0.499, size); break;
    case 7: q[3] = real_in(-size, -0.499); break;
    default: reals(q, 4, 0.499); break;
    }
}

/* ---- what is asserted of results ---- */

static void written(const demo3_real *x, int count)
{
    for (int i = 0; i < count; ++i) {
        /*@ check \initialized(&x[i]) && \is_finite(x[i]); */
    }
}

static void initialised(const demo3_real *x, int count)
{
    for (int i = 0; i < count; ++i) {
        /*@ check \initialized(&x[i]); */
    }
}

static void untouched(const demo3_real *x, int count)
{
    for (int i = 0; i < count; ++i) {
        /*@ check !\initialized(&x[i]); */
    }
}

/* ---- drivers: a function and a set each ---- */

void demo3_eva_normal_forward(void);
void demo3_eva_normal_forward(void)
{
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_real phi_ddot[DEMO3_N];
    reals(&phi_ddot[0], 3, 1.0e4);
    demo3_real V_dot[6];
    const demo3_status status = demo3_forward(&demo3_default, &x, phi_ddot, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
    }
}

void demo3_eva_any_forward(void);
void demo3_eva_any_forward(void)
{
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_real phi_ddot[DEMO3_N];
    reals(&phi_ddot[0], 3, DEMO3_LARGEST);
    demo3_real V_dot[6];
    const demo3_status status = demo3_forward(&demo3_default, &x, phi_ddot, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
    }
}

void demo3_eva_bits_forward(void);
void demo3_eva_bits_forward(void)
{
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_real phi_ddot[DEMO3_N];
    all_bits(&phi_ddot[0], 3);
    demo3_real V_dot[6];
    const demo3_status status = demo3_forward(&demo3_default, &x, phi_ddot, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&V_dot[0], 6);
    }
}

void demo3_eva_normal_matrices(void);
void demo3_eva_normal_matrices(void)
{
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_equations out;
    const demo3_status status = demo3_matrices(&demo3_default, &x, &out);
    if (status < 0) {
        untouched(&out.K[0][0], 36);
        untouched(&out.K_dot[0][0], 36);
        untouched(&out.M[0][0], 36);
        untouched(&out.I[0][0], 18);
        untouched(&out.J[0][0], 18);
        untouched(&out.F[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&out.K[0][0], 36);
        written(&out.K_dot[0][0], 36);
        written(&out.M[0][0], 36);
        written(&out.I[0][0], 18);
        written(&out.J[0][0], 18);
        written(&out.F[0], 6);
    }
}

void demo3_eva_any_matrices(void);
void demo3_eva_any_matrices(void)
{
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_equations out;
    const demo3_status status = demo3_matrices(&demo3_default, &x, &out);
    if (status < 0) {
        untouched(&out.K[0][0], 36);
        untouched(&out.K_dot[0][0], 36);
        untouched(&out.M[0][0], 36);
        untouched(&out.I[0][0], 18);
        untouched(&out.J[0][0], 18);
        untouched(&out.F[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&out.K[0][0], 36);
        written(&out.K_dot[0][0], 36);
        written(&out.M[0][0], 36);
        written(&out.I[0][0], 18);
        written(&out.J[0][0], 18);
        written(&out.F[0], 6);
    }
}

void demo3_eva_bits_matrices(void);
void demo3_eva_bits_matrices(void)
{
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_equations out;
    const demo3_status status = demo3_matrices(&demo3_default, &x, &out);
    if (status < 0) {
        untouched(&out.K[0][0], 36);
        untouched(&out.K_dot[0][0], 36);
        untouched(&out.M[0][0], 36);
        untouched(&out.I[0][0], 18);
        untouched(&out.J[0][0], 18);
        untouched(&out.F[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&out.K[0][0], 36);
        initialised(&out.K_dot[0][0], 36);
        initialised(&out.M[0][0], 36);
        initialised(&out.I[0][0], 18);
        initialised(&out.J[0][0], 18);
        initialised(&out.F[0], 6);
    }
}

void demo3_eva_normal_momentum(void);
void demo3_eva_normal_momentum(void)
{
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_momenta out;
    const demo3_status status = demo3_momentum(&demo3_default, &x, &out);
    if (status < 0) {
        untouched(&out.Z[0], 6);
        untouched(&out.Z0[0], 6);
        untouched(&out.energy, 1);
        untouched(&out.center_of_mass[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&out.Z[0], 6);
        written(&out.Z0[0], 6);
        written(&out.energy, 1);
        written(&out.center_of_mass[0], 3);
    }
}

void demo3_eva_any_momentum(void);
void demo3_eva_any_momentum(void)
{
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_momenta out;
    const demo3_status status = demo3_momentum(&demo3_default, &x, &out);
    if (status < 0) {
        untouched(&out.Z[0], 6);
        untouched(&out.Z0[0], 6);
        untouched(&out.energy, 1);
        untouched(&out.center_of_mass[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&out.Z[0], 6);
        written(&out.Z0[0], 6);
        written(&out.energy, 1);
        written(&out.center_of_mass[0], 3);
    }
}

void demo3_eva_bits_momentum(void);
void demo3_eva_bits_momentum(void)
{
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_momenta out;
    const demo3_status status = demo3_momentum(&demo3_default, &x, &out);
    if (status < 0) {
        untouched(&out.Z[0], 6);
        untouched(&out.Z0[0], 6);
        untouched(&out.energy, 1);
        untouched(&out.center_of_mass[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&out.Z[0], 6);
        initialised(&out.Z0[0], 6);
        initialised(&out.energy, 1);
        initialised(&out.center_of_mass[0], 3);
    }
}

void demo3_eva_normal_torque(void);
void demo3_eva_normal_torque(void)
{
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    demo3_real phi_ddot[DEMO3_N];
    reals(&phi_ddot[0], 3, 1.0e4);
    demo3_real tau[DEMO3_N];
    const demo3_status status = demo3_torque(&demo3_default, &x, V_dot, phi_ddot, tau);
    if (status < 0) {
        untouched(&tau[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&tau[0], 3);
    }
}

void demo3_eva_any_torque(void);
void demo3_eva_any_torque(void)
{
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_real V_dot[6];
    reals(&V_dot[0], 6, DEMO3_LARGEST);
    demo3_real phi_ddot[DEMO3_N];
    reals(&phi_ddot[0], 3, DEMO3_LARGEST);
    demo3_real tau[DEMO3_N];
    const demo3_status status = demo3_torque(&demo3_default, &x, V_dot, phi_ddot, tau);
    if (status < 0) {
        untouched(&tau[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&tau[0], 3);
    }
}

void demo3_eva_bits_torque(void);
void demo3_eva_bits_torque(void)
{
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_real V_dot[6];
    all_bits(&V_dot[0], 6);
    demo3_real phi_ddot[DEMO3_N];
    all_bits(&phi_ddot[0], 3);
    demo3_real tau[DEMO3_N];
    const demo3_status status = demo3_torque(&demo3_default, &x, V_dot, phi_ddot, tau);
    if (status < 0) {
        untouched(&tau[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&tau[0], 3);
    }
}

void demo3_eva_normal_coupled(void);
void demo3_eva_normal_coupled(void)
{
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_real tau[DEMO3_N];
    reals(&tau[0], 3, 100.0);
    int locked[DEMO3_N];
    integers(&locked[0], 3, 0, 1);
    demo3_real V_dot[6];
    demo3_real phi_ddot[DEMO3_N];
    const demo3_status status = demo3_coupled(&demo3_default, &x, tau, locked, V_dot, phi_ddot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
        untouched(&phi_ddot[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
        written(&phi_ddot[0], 3);
    }
}

void demo3_eva_any_coupled(void);
void demo3_eva_any_coupled(void)
{
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_real tau[DEMO3_N];
    reals(&tau[0], 3, DEMO3_LARGEST);
    int locked[DEMO3_N];
    integers(&locked[0], 3, INT_MIN, INT_MAX);
    demo3_real V_dot[6];
    demo3_real phi_ddot[DEMO3_N];
    const demo3_status status = demo3_coupled(&demo3_default, &x, tau, locked, V_dot, phi_ddot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
        untouched(&phi_ddot[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
        written(&phi_ddot[0], 3);
    }
}

void demo3_eva_bits_coupled(void);
void demo3_eva_bits_coupled(void)
{
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_real tau[DEMO3_N];
    all_bits(&tau[0], 3);
    int locked[DEMO3_N];
    integers(&locked[0], 3, INT_MIN, INT_MAX);
    demo3_real V_dot[6];
    demo3_real phi_ddot[DEMO3_N];
    const demo3_status status = demo3_coupled(&demo3_default, &x, tau, locked, V_dot, phi_ddot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
        untouched(&phi_ddot[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&V_dot[0], 6);
        initialised(&phi_ddot[0], 3);
    }
}

void demo3_eva_normal_step(void);
void demo3_eva_normal_step(void)
{
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_real tau[DEMO3_N];
    reals(&tau[0], 3, 100.0);
    int locked[DEMO3_N];
    integers(&locked[0], 3, 0, 1);
    demo3_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    demo3_state next;
    const demo3_status status = demo3_step(&demo3_default, &x, tau, locked, dt, order, &next);
    if (status < 0) {
        untouched(&next.position[0], 3);
        untouched(&next.attitude[0], 4);
        untouched(&next.V[0], 6);
        untouched(&next.phi[0], 3);
        untouched(&next.phi_dot[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&next.position[0], 3);
        written(&next.attitude[0], 4);
        written(&next.V[0], 6);
        written(&next.phi[0], 3);
        written(&next.phi_dot[0], 3);
    }
}

void demo3_eva_any_step(void);
void demo3_eva_any_step(void)
{
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_real tau[DEMO3_N];
    reals(&tau[0], 3, DEMO3_LARGEST);
    int locked[DEMO3_N];
    integers(&locked[0], 3, INT_MIN, INT_MAX);
    demo3_real dt;
    reals(&dt, 1, DEMO3_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    demo3_state next;
    const demo3_status status = demo3_step(&demo3_default, &x, tau, locked, dt, order, &next);
    if (status < 0) {
        untouched(&next.position[0], 3);
        untouched(&next.attitude[0], 4);
        untouched(&next.V[0], 6);
        untouched(&next.phi[0], 3);
        untouched(&next.phi_dot[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&next.position[0], 3);
        written(&next.attitude[0], 4);
        written(&next.V[0], 6);
        written(&next.phi[0], 3);
        written(&next.phi_dot[0], 3);
    }
}

void demo3_eva_bits_step(void);
void demo3_eva_bits_step(void)
{
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_real tau[DEMO3_N];
    all_bits(&tau[0], 3);
    int locked[DEMO3_N];
    integers(&locked[0], 3, INT_MIN, INT_MAX);
    demo3_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    demo3_state next;
    const demo3_status status = demo3_step(&demo3_default, &x, tau, locked, dt, order, &next);
    if (status < 0) {
        untouched(&next.position[0], 3);
        untouched(&next.attitude[0], 4);
        untouched(&next.V[0], 6);
        untouched(&next.phi[0], 3);
        untouched(&next.phi_dot[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&next.position[0], 3);
        initialised(&next.attitude[0], 4);
        initialised(&next.V[0], 6);
        initialised(&next.phi[0], 3);
        initialised(&next.phi_dot[0], 3);
    }
}

void demo3_eva_normal_step_driven(void);
void demo3_eva_normal_step_driven(void)
{
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_real phi_ddot[DEMO3_N];
    reals(&phi_ddot[0], 3, 1.0e4);
    demo3_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    demo3_state next;
    const demo3_status status = demo3_step_driven(&demo3_default, &x, phi_ddot, dt, order, &next);
    if (status < 0) {
        untouched(&next.position[0], 3);
        untouched(&next.attitude[0], 4);
        untouched(&next.V[0], 6);
        untouched(&next.phi[0], 3);
        untouched(&next.phi_dot[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&next.position[0], 3);
        written(&next.attitude[0], 4);
        written(&next.V[0], 6);
        written(&next.phi[0], 3);
        written(&next.phi_dot[0], 3);
    }
}

void demo3_eva_any_step_driven(void);
void demo3_eva_any_step_driven(void)
{
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_real phi_ddot[DEMO3_N];
    reals(&phi_ddot[0], 3, DEMO3_LARGEST);
    demo3_real dt;
    reals(&dt, 1, DEMO3_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    demo3_state next;
    const demo3_status status = demo3_step_driven(&demo3_default, &x, phi_ddot, dt, order, &next);
    if (status < 0) {
        untouched(&next.position[0], 3);
        untouched(&next.attitude[0], 4);
        untouched(&next.V[0], 6);
        untouched(&next.phi[0], 3);
        untouched(&next.phi_dot[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&next.position[0], 3);
        written(&next.attitude[0], 4);
        written(&next.V[0], 6);
        written(&next.phi[0], 3);
        written(&next.phi_dot[0], 3);
    }
}

void demo3_eva_bits_step_driven(void);
void demo3_eva_bits_step_driven(void)
{
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_real phi_ddot[DEMO3_N];
    all_bits(&phi_ddot[0], 3);
    demo3_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    demo3_state next;
    const demo3_status status = demo3_step_driven(&demo3_default, &x, phi_ddot, dt, order, &next);
    if (status < 0) {
        untouched(&next.position[0], 3);
        untouched(&next.attitude[0], 4);
        untouched(&next.V[0], 6);
        untouched(&next.phi[0], 3);
        untouched(&next.phi_dot[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&next.position[0], 3);
        initialised(&next.attitude[0], 4);
        initialised(&next.V[0], 6);
        initialised(&next.phi[0], 3);
        initialised(&next.phi_dot[0], 3);
    }
}

void demo3_eva_normal_wrap(void);
void demo3_eva_normal_wrap(void)
{
    demo3_real phi;
    reals(&phi, 1, 100.0);
    demo3_real wrapped;
    const demo3_status status = demo3_wrap(phi, &wrapped);
    if (status < 0) {
        untouched(&wrapped, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&wrapped, 1);
    }
}

void demo3_eva_any_wrap(void);
void demo3_eva_any_wrap(void)
{
    demo3_real phi;
    reals(&phi, 1, DEMO3_LARGEST);
    demo3_real wrapped;
    const demo3_status status = demo3_wrap(phi, &wrapped);
    if (status < 0) {
        untouched(&wrapped, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&wrapped, 1);
    }
}

void demo3_eva_bits_wrap(void);
void demo3_eva_bits_wrap(void)
{
    demo3_real phi;
    one_of_all(&phi);
    demo3_real wrapped;
    const demo3_status status = demo3_wrap(phi, &wrapped);
    if (status < 0) {
        untouched(&wrapped, 1);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&wrapped, 1);
    }
}

void demo3_eva_normal_phase_of_counts(void);
void demo3_eva_normal_phase_of_counts(void)
{
    int count;
    integers(&count, 1, -1048576, 1048576);
    int per_turn;
    integers(&per_turn, 1, -100000, 100000);
    demo3_real zero;
    reals(&zero, 1, 1.0e3);
    demo3_real phi;
    const demo3_status status = demo3_phase_of_counts(count, per_turn, zero, &phi);
    if (status < 0) {
        untouched(&phi, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi, 1);
    }
}

void demo3_eva_any_phase_of_counts(void);
void demo3_eva_any_phase_of_counts(void)
{
    int count;
    integers(&count, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    demo3_real zero;
    reals(&zero, 1, DEMO3_LARGEST);
    demo3_real phi;
    const demo3_status status = demo3_phase_of_counts(count, per_turn, zero, &phi);
    if (status < 0) {
        untouched(&phi, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi, 1);
    }
}

void demo3_eva_bits_phase_of_counts(void);
void demo3_eva_bits_phase_of_counts(void)
{
    int count;
    integers(&count, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    demo3_real zero;
    one_of_all(&zero);
    demo3_real phi;
    const demo3_status status = demo3_phase_of_counts(count, per_turn, zero, &phi);
    if (status < 0) {
        untouched(&phi, 1);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&phi, 1);
    }
}

void demo3_eva_normal_speed_of_counts(void);
void demo3_eva_normal_speed_of_counts(void)
{
    int moved;
    integers(&moved, 1, -1048576, 1048576);
    int per_turn;
    integers(&per_turn, 1, -100000, 100000);
    demo3_real dt;
    dt = real_in(1.0e-6, 0.001);
    demo3_real phi_dot;
    const demo3_status status = demo3_speed_of_counts(moved, per_turn, dt, &phi_dot);
    if (status < 0) {
        untouched(&phi_dot, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_dot, 1);
    }
}

void demo3_eva_any_speed_of_counts(void);
void demo3_eva_any_speed_of_counts(void)
{
    int moved;
    integers(&moved, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    demo3_real dt;
    reals(&dt, 1, DEMO3_LARGEST);
    demo3_real phi_dot;
    const demo3_status status = demo3_speed_of_counts(moved, per_turn, dt, &phi_dot);
    if (status < 0) {
        untouched(&phi_dot, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_dot, 1);
    }
}

void demo3_eva_bits_speed_of_counts(void);
void demo3_eva_bits_speed_of_counts(void)
{
    int moved;
    integers(&moved, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    demo3_real dt;
    one_of_all(&dt);
    demo3_real phi_dot;
    const demo3_status status = demo3_speed_of_counts(moved, per_turn, dt, &phi_dot);
    if (status < 0) {
        untouched(&phi_dot, 1);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&phi_dot, 1);
    }
}

void demo3_eva_normal_accumulate(void);
void demo3_eva_normal_accumulate(void)
{
    demo3_encoder encoder;
    integers(&encoder.counter, 1, -1048576, 1048576);
    integers(&encoder.place, 1, -1048576, 1048576);
    integers(&encoder.moved, 1, -1048576, 1048576);
    int counter;
    integers(&counter, 1, -1048576, 1048576);
    int bits;
    integers(&bits, 1, 0, 32);
    int per_turn;
    integers(&per_turn, 1, -100000, 100000);
    const demo3_status status = demo3_accumulate(&encoder, counter, bits, per_turn);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        /*@ check \initialized(&encoder.counter); */
        /*@ check \initialized(&encoder.place); */
        /*@ check \initialized(&encoder.moved); */
    }
}

void demo3_eva_any_accumulate(void);
void demo3_eva_any_accumulate(void)
{
    demo3_encoder encoder;
    integers(&encoder.counter, 1, INT_MIN, INT_MAX);
    integers(&encoder.place, 1, INT_MIN, INT_MAX);
    integers(&encoder.moved, 1, INT_MIN, INT_MAX);
    int counter;
    integers(&counter, 1, INT_MIN, INT_MAX);
    int bits;
    integers(&bits, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    const demo3_status status = demo3_accumulate(&encoder, counter, bits, per_turn);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        /*@ check \initialized(&encoder.counter); */
        /*@ check \initialized(&encoder.place); */
        /*@ check \initialized(&encoder.moved); */
    }
}

void demo3_eva_bits_accumulate(void);
void demo3_eva_bits_accumulate(void)
{
    demo3_encoder encoder;
    integers(&encoder.counter, 1, INT_MIN, INT_MAX);
    integers(&encoder.place, 1, INT_MIN, INT_MAX);
    integers(&encoder.moved, 1, INT_MIN, INT_MAX);
    int counter;
    integers(&counter, 1, INT_MIN, INT_MAX);
    int bits;
    integers(&bits, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    const demo3_status status = demo3_accumulate(&encoder, counter, bits, per_turn);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        /*@ check \initialized(&encoder.counter); */
        /*@ check \initialized(&encoder.place); */
        /*@ check \initialized(&encoder.moved); */
    }
}

void demo3_eva_normal_forward_jacobian(void);
void demo3_eva_normal_forward_jacobian(void)
{
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_real phi_ddot[DEMO3_N];
    reals(&phi_ddot[0], 3, 1.0e4);
    demo3_forward_slopes out;
    const demo3_status status = demo3_forward_jacobian(&demo3_default, &x, phi_ddot, &out);
    if (status < 0) {
        untouched(&out.V_dot_V[0][0], 36);
        untouched(&out.V_dot_phi[0][0], 18);
        untouched(&out.V_dot_phi_dot[0][0], 18);
        untouched(&out.V_dot_phi_ddot[0][0], 18);
    } else {
        Frama_C_show_each_returned(status);
        written(&out.V_dot_V[0][0], 36);
        written(&out.V_dot_phi[0][0], 18);
        written(&out.V_dot_phi_dot[0][0], 18);
        written(&out.V_dot_phi_ddot[0][0], 18);
    }
}

void demo3_eva_any_forward_jacobian(void);
void demo3_eva_any_forward_jacobian(void)
{
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_real phi_ddot[DEMO3_N];
    reals(&phi_ddot[0], 3, DEMO3_LARGEST);
    demo3_forward_slopes out;
    const demo3_status status = demo3_forward_jacobian(&demo3_default, &x, phi_ddot, &out);
    if (status < 0) {
        untouched(&out.V_dot_V[0][0], 36);
        untouched(&out.V_dot_phi[0][0], 18);
        untouched(&out.V_dot_phi_dot[0][0], 18);
        untouched(&out.V_dot_phi_ddot[0][0], 18);
    } else {
        Frama_C_show_each_returned(status);
        written(&out.V_dot_V[0][0], 36);
        written(&out.V_dot_phi[0][0], 18);
        written(&out.V_dot_phi_dot[0][0], 18);
        written(&out.V_dot_phi_ddot[0][0], 18);
    }
}

void demo3_eva_bits_forward_jacobian(void);
void demo3_eva_bits_forward_jacobian(void)
{
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_real phi_ddot[DEMO3_N];
    all_bits(&phi_ddot[0], 3);
    demo3_forward_slopes out;
    const demo3_status status = demo3_forward_jacobian(&demo3_default, &x, phi_ddot, &out);
    if (status < 0) {
        untouched(&out.V_dot_V[0][0], 36);
        untouched(&out.V_dot_phi[0][0], 18);
        untouched(&out.V_dot_phi_dot[0][0], 18);
        untouched(&out.V_dot_phi_ddot[0][0], 18);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&out.V_dot_V[0][0], 36);
        initialised(&out.V_dot_phi[0][0], 18);
        initialised(&out.V_dot_phi_dot[0][0], 18);
        initialised(&out.V_dot_phi_ddot[0][0], 18);
    }
}

void demo3_eva_normal_coupled_jacobian(void);
void demo3_eva_normal_coupled_jacobian(void)
{
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_real tau[DEMO3_N];
    reals(&tau[0], 3, 100.0);
    int locked[DEMO3_N];
    integers(&locked[0], 3, 0, 1);
    demo3_coupled_slopes out;
    const demo3_status status = demo3_coupled_jacobian(&demo3_default, &x, tau, locked, &out);
    if (status < 0) {
        untouched(&out.V_dot_V[0][0], 36);
        untouched(&out.V_dot_phi[0][0], 18);
        untouched(&out.V_dot_phi_dot[0][0], 18);
        untouched(&out.V_dot_tau[0][0], 18);
        untouched(&out.phi_ddot_V[0][0], 18);
        untouched(&out.phi_ddot_phi[0][0], 9);
        untouched(&out.phi_ddot_phi_dot[0][0], 9);
        untouched(&out.phi_ddot_tau[0][0], 9);
    } else {
        Frama_C_show_each_returned(status);
        written(&out.V_dot_V[0][0], 36);
        written(&out.V_dot_phi[0][0], 18);
        written(&out.V_dot_phi_dot[0][0], 18);
        written(&out.V_dot_tau[0][0], 18);
        written(&out.phi_ddot_V[0][0], 18);
        written(&out.phi_ddot_phi[0][0], 9);
        written(&out.phi_ddot_phi_dot[0][0], 9);
        written(&out.phi_ddot_tau[0][0], 9);
    }
}

void demo3_eva_any_coupled_jacobian(void);
void demo3_eva_any_coupled_jacobian(void)
{
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_real tau[DEMO3_N];
    reals(&tau[0], 3, DEMO3_LARGEST);
    int locked[DEMO3_N];
    integers(&locked[0], 3, INT_MIN, INT_MAX);
    demo3_coupled_slopes out;
    const demo3_status status = demo3_coupled_jacobian(&demo3_default, &x, tau, locked, &out);
    if (status < 0) {
        untouched(&out.V_dot_V[0][0], 36);
        untouched(&out.V_dot_phi[0][0], 18);
        untouched(&out.V_dot_phi_dot[0][0], 18);
        untouched(&out.V_dot_tau[0][0], 18);
        untouched(&out.phi_ddot_V[0][0], 18);
        untouched(&out.phi_ddot_phi[0][0], 9);
        untouched(&out.phi_ddot_phi_dot[0][0], 9);
        untouched(&out.phi_ddot_tau[0][0], 9);
    } else {
        Frama_C_show_each_returned(status);
        written(&out.V_dot_V[0][0], 36);
        written(&out.V_dot_phi[0][0], 18);
        written(&out.V_dot_phi_dot[0][0], 18);
        written(&out.V_dot_tau[0][0], 18);
        written(&out.phi_ddot_V[0][0], 18);
        written(&out.phi_ddot_phi[0][0], 9);
        written(&out.phi_ddot_phi_dot[0][0], 9);
        written(&out.phi_ddot_tau[0][0], 9);
    }
}

void demo3_eva_bits_coupled_jacobian(void);
void demo3_eva_bits_coupled_jacobian(void)
{
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_real tau[DEMO3_N];
    all_bits(&tau[0], 3);
    int locked[DEMO3_N];
    integers(&locked[0], 3, INT_MIN, INT_MAX);
    demo3_coupled_slopes out;
    const demo3_status status = demo3_coupled_jacobian(&demo3_default, &x, tau, locked, &out);
    if (status < 0) {
        untouched(&out.V_dot_V[0][0], 36);
        untouched(&out.V_dot_phi[0][0], 18);
        untouched(&out.V_dot_phi_dot[0][0], 18);
        untouched(&out.V_dot_tau[0][0], 18);
        untouched(&out.phi_ddot_V[0][0], 18);
        untouched(&out.phi_ddot_phi[0][0], 9);
        untouched(&out.phi_ddot_phi_dot[0][0], 9);
        untouched(&out.phi_ddot_tau[0][0], 9);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&out.V_dot_V[0][0], 36);
        initialised(&out.V_dot_phi[0][0], 18);
        initialised(&out.V_dot_phi_dot[0][0], 18);
        initialised(&out.V_dot_tau[0][0], 18);
        initialised(&out.phi_ddot_V[0][0], 18);
        initialised(&out.phi_ddot_phi[0][0], 9);
        initialised(&out.phi_ddot_phi_dot[0][0], 9);
        initialised(&out.phi_ddot_tau[0][0], 9);
    }
}

void demo3_eva_normal_inverse(void);
void demo3_eva_normal_inverse(void)
{
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    demo3_inverse_options options;
    about(&options.weight[0], &demo3_default_options.weight[0], 3);
    about(&options.limit[0], &demo3_default_options.limit[0], 3);
    about(&options.near, &demo3_default_options.near, 1);
    about(&options.damping, &demo3_default_options.damping, 1);
    demo3_inverse_result out;
    const demo3_status status = demo3_inverse(&demo3_default, &x, V_dot, &options, &out);
    if (status < 0) {
        untouched(&out.phi_ddot[0], 3);
        untouched(&out.residual[0], 6);
        untouched(&out.sigma[0], 3);
        untouched(&out.damped_by, 1);
        untouched(&out.hardest[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&out.phi_ddot[0], 3);
        written(&out.residual[0], 6);
        written(&out.sigma[0], 3);
        /*@ check \initialized(&out.rank); */
        written(&out.damped_by, 1);
        /*@ check \initialized(&out.limited[0]); */
        written(&out.hardest[0], 6);
    }
}

void demo3_eva_any_inverse(void);
void demo3_eva_any_inverse(void)
{
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_real V_dot[6];
    reals(&V_dot[0], 6, DEMO3_LARGEST);
    demo3_inverse_options options;
    reals(&options.weight[0], 3, DEMO3_LARGEST);
    reals(&options.limit[0], 3, DEMO3_LARGEST);
    reals(&options.near, 1, DEMO3_LARGEST);
    reals(&options.damping, 1, DEMO3_LARGEST);
    demo3_inverse_result out;
    const demo3_status status = demo3_inverse(&demo3_default, &x, V_dot, &options, &out);
    if (status < 0) {
        untouched(&out.phi_ddot[0], 3);
        untouched(&out.residual[0], 6);
        untouched(&out.sigma[0], 3);
        untouched(&out.damped_by, 1);
        untouched(&out.hardest[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&out.phi_ddot[0], 3);
        written(&out.residual[0], 6);
        written(&out.sigma[0], 3);
        /*@ check \initialized(&out.rank); */
        written(&out.damped_by, 1);
        /*@ check \initialized(&out.limited[0]); */
        written(&out.hardest[0], 6);
    }
}

void demo3_eva_bits_inverse(void);
void demo3_eva_bits_inverse(void)
{
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_real V_dot[6];
    all_bits(&V_dot[0], 6);
    demo3_inverse_options options;
    all_bits(&options.weight[0], 3);
    all_bits(&options.limit[0], 3);
    one_of_all(&options.near);
    one_of_all(&options.damping);
    demo3_inverse_result out;
    const demo3_status status = demo3_inverse(&demo3_default, &x, V_dot, &options, &out);
    if (status < 0) {
        untouched(&out.phi_ddot[0], 3);
        untouched(&out.residual[0], 6);
        untouched(&out.sigma[0], 3);
        untouched(&out.damped_by, 1);
        untouched(&out.hardest[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&out.phi_ddot[0], 3);
        initialised(&out.residual[0], 6);
        initialised(&out.sigma[0], 3);
        /*@ check \initialized(&out.rank); */
        initialised(&out.damped_by, 1);
        /*@ check \initialized(&out.limited[0]); */
        initialised(&out.hardest[0], 6);
    }
}

void demo3_eva_normal_inverse_fast(void);
void demo3_eva_normal_inverse_fast(void)
{
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    demo3_inverse_options options;
    about(&options.weight[0], &demo3_default_options.weight[0], 3);
    about(&options.limit[0], &demo3_default_options.limit[0], 3);
    about(&options.near, &demo3_default_options.near, 1);
    about(&options.damping, &demo3_default_options.damping, 1);
    demo3_real phi_ddot[DEMO3_N];
    const demo3_status status = demo3_inverse_fast(&demo3_default, &x, V_dot, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_ddot[0], 3);
    }
}

void demo3_eva_any_inverse_fast(void);
void demo3_eva_any_inverse_fast(void)
{
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_real V_dot[6];
    reals(&V_dot[0], 6, DEMO3_LARGEST);
    demo3_inverse_options options;
    reals(&options.weight[0], 3, DEMO3_LARGEST);
    reals(&options.limit[0], 3, DEMO3_LARGEST);
    reals(&options.near, 1, DEMO3_LARGEST);
    reals(&options.damping, 1, DEMO3_LARGEST);
    demo3_real phi_ddot[DEMO3_N];
    const demo3_status status = demo3_inverse_fast(&demo3_default, &x, V_dot, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_ddot[0], 3);
    }
}

void demo3_eva_bits_inverse_fast(void);
void demo3_eva_bits_inverse_fast(void)
{
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_real V_dot[6];
    all_bits(&V_dot[0], 6);
    demo3_inverse_options options;
    all_bits(&options.weight[0], 3);
    all_bits(&options.limit[0], 3);
    one_of_all(&options.near);
    one_of_all(&options.damping);
    demo3_real phi_ddot[DEMO3_N];
    const demo3_status status = demo3_inverse_fast(&demo3_default, &x, V_dot, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&phi_ddot[0], 3);
    }
}

void demo3_eva_normal_quaternion(void);
void demo3_eva_normal_quaternion(void)
{
    demo3_real angles[3];
    reals(&angles[0], 3, 7.0);
    demo3_real attitude[4];
    const demo3_status status = demo3_quaternion(angles, attitude);
    if (status < 0) {
        untouched(&attitude[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&attitude[0], 4);
    }
}

void demo3_eva_any_quaternion(void);
void demo3_eva_any_quaternion(void)
{
    demo3_real angles[3];
    reals(&angles[0], 3, DEMO3_LARGEST);
    demo3_real attitude[4];
    const demo3_status status = demo3_quaternion(angles, attitude);
    if (status < 0) {
        untouched(&attitude[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&attitude[0], 4);
    }
}

void demo3_eva_bits_quaternion(void);
void demo3_eva_bits_quaternion(void)
{
    demo3_real angles[3];
    all_bits(&angles[0], 3);
    demo3_real attitude[4];
    const demo3_status status = demo3_quaternion(angles, attitude);
    if (status < 0) {
        untouched(&attitude[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&attitude[0], 4);
    }
}

void demo3_eva_normal_target(void);
void demo3_eva_normal_target(void)
{
    demo3_real position[3];
    reals(&position[0], 3, 100.0);
    demo3_real angles[3];
    reals(&angles[0], 3, 7.0);
    demo3_real q_dot[6];
    reals(&q_dot[0], 6, 20.0);
    demo3_real q_ddot[6];
    reals(&q_ddot[0], 6, 1.0e3);
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_real V_dot[6];
    const demo3_status status = demo3_target(position, angles, q_dot, q_ddot, &x, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&x.position[0], 3);
        written(&x.attitude[0], 4);
        written(&x.V[0], 6);
        written(&x.phi[0], 3);
        written(&x.phi_dot[0], 3);
        written(&V_dot[0], 6);
    }
}

void demo3_eva_any_target(void);
void demo3_eva_any_target(void)
{
    demo3_real position[3];
    reals(&position[0], 3, DEMO3_LARGEST);
    demo3_real angles[3];
    reals(&angles[0], 3, DEMO3_LARGEST);
    demo3_real q_dot[6];
    reals(&q_dot[0], 6, DEMO3_LARGEST);
    demo3_real q_ddot[6];
    reals(&q_ddot[0], 6, DEMO3_LARGEST);
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_real V_dot[6];
    const demo3_status status = demo3_target(position, angles, q_dot, q_ddot, &x, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&x.position[0], 3);
        written(&x.attitude[0], 4);
        written(&x.V[0], 6);
        written(&x.phi[0], 3);
        written(&x.phi_dot[0], 3);
        written(&V_dot[0], 6);
    }
}

void demo3_eva_bits_target(void);
void demo3_eva_bits_target(void)
{
    demo3_real position[3];
    all_bits(&position[0], 3);
    demo3_real angles[3];
    all_bits(&angles[0], 3);
    demo3_real q_dot[6];
    all_bits(&q_dot[0], 6);
    demo3_real q_ddot[6];
    all_bits(&q_ddot[0], 6);
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_real V_dot[6];
    const demo3_status status = demo3_target(position, angles, q_dot, q_ddot, &x, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&x.position[0], 3);
        initialised(&x.attitude[0], 4);
        initialised(&x.V[0], 6);
        initialised(&x.phi[0], 3);
        initialised(&x.phi_dot[0], 3);
        initialised(&V_dot[0], 6);
    }
}

void demo3_eva_normal_attitude(void);
void demo3_eva_normal_attitude(void)
{
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_real angles[3];
    reals(&angles[0], 3, 7.0);
    demo3_real phi_ddot[DEMO3_N];
    reals(&phi_ddot[0], 3, 1.0e4);
    demo3_generalized out;
    const demo3_status status = demo3_attitude(&demo3_default, &x, angles, phi_ddot, &out);
    if (status < 0) {
        untouched(&out.A[0][0], 36);
        untouched(&out.D[0][0], 36);
        untouched(&out.I0[0][0], 36);
        untouched(&out.J0[0][0], 36);
        untouched(&out.q_dot[0], 6);
        untouched(&out.q_ddot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&out.A[0][0], 36);
        written(&out.D[0][0], 36);
        written(&out.I0[0][0], 36);
        written(&out.J0[0][0], 36);
        written(&out.q_dot[0], 6);
        written(&out.q_ddot[0], 6);
    }
}

void demo3_eva_any_attitude(void);
void demo3_eva_any_attitude(void)
{
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_real angles[3];
    reals(&angles[0], 3, DEMO3_LARGEST);
    demo3_real phi_ddot[DEMO3_N];
    reals(&phi_ddot[0], 3, DEMO3_LARGEST);
    demo3_generalized out;
    const demo3_status status = demo3_attitude(&demo3_default, &x, angles, phi_ddot, &out);
    if (status < 0) {
        untouched(&out.A[0][0], 36);
        untouched(&out.D[0][0], 36);
        untouched(&out.I0[0][0], 36);
        untouched(&out.J0[0][0], 36);
        untouched(&out.q_dot[0], 6);
        untouched(&out.q_ddot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&out.A[0][0], 36);
        written(&out.D[0][0], 36);
        written(&out.I0[0][0], 36);
        written(&out.J0[0][0], 36);
        written(&out.q_dot[0], 6);
        written(&out.q_ddot[0], 6);
    }
}

void demo3_eva_bits_attitude(void);
void demo3_eva_bits_attitude(void)
{
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_real angles[3];
    all_bits(&angles[0], 3);
    demo3_real phi_ddot[DEMO3_N];
    all_bits(&phi_ddot[0], 3);
    demo3_generalized out;
    const demo3_status status = demo3_attitude(&demo3_default, &x, angles, phi_ddot, &out);
    if (status < 0) {
        untouched(&out.A[0][0], 36);
        untouched(&out.D[0][0], 36);
        untouched(&out.I0[0][0], 36);
        untouched(&out.J0[0][0], 36);
        untouched(&out.q_dot[0], 6);
        untouched(&out.q_ddot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&out.A[0][0], 36);
        initialised(&out.D[0][0], 36);
        initialised(&out.I0[0][0], 36);
        initialised(&out.J0[0][0], 36);
        initialised(&out.q_dot[0], 6);
        initialised(&out.q_ddot[0], 6);
    }
}

void demo3_eva_normal_prepare(void);
void demo3_eva_normal_prepare(void)
{
    demo3_parameters parameters;
    about(&parameters.carrier.mass, &demo3_default_parameters.carrier.mass, 1);
    about(&parameters.carrier.center_of_mass[0], &demo3_default_parameters.carrier.center_of_mass[0], 3);
    about(&parameters.carrier.inertia[0], &demo3_default_parameters.carrier.inertia[0], 6);
    for (int i = 0; i < DEMO3_N; ++i) {
        about(&parameters.flywheel[i].body.mass, &demo3_default_parameters.flywheel[i].body.mass, 1);
        about(&parameters.flywheel[i].body.center_of_mass[0], &demo3_default_parameters.flywheel[i].body.center_of_mass[0], 3);
        about(&parameters.flywheel[i].body.inertia[0], &demo3_default_parameters.flywheel[i].body.inertia[0], 6);
        about(&parameters.flywheel[i].position[0], &demo3_default_parameters.flywheel[i].position[0], 3);
        about(&parameters.flywheel[i].axis[0], &demo3_default_parameters.flywheel[i].axis[0], 3);
        about(&parameters.flywheel[i].zero[0], &demo3_default_parameters.flywheel[i].zero[0], 3);
    }
    demo3_table stand = demo3_default;
    const demo3_status status = demo3_prepare(&parameters, &stand);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written(&stand.mass, 1);
        written(&stand.mass_inverse, 1);
        written(&stand.first_moment[0], 3);
        written(&stand.inertia[0], 6);
        written(&stand.flywheel[0].mu_c[0], 3);
        written(&stand.flywheel[0].mu_s[0], 3);
        written(&stand.flywheel[0].J_c[0], 6);
        written(&stand.flywheel[0].J_s[0], 6);
        written(&stand.flywheel[0].J_2c[0], 6);
        written(&stand.flywheel[0].J_2s[0], 6);
        written(&stand.flywheel[0].t_0[0], 3);
        written(&stand.flywheel[0].t_c[0], 3);
        written(&stand.flywheel[0].t_s[0], 3);
        written(&stand.flywheel[0].spin, 1);
        written(&stand.flywheel[0].spin_inv, 1);
        written(&stand.flywheel[1].mu_c[0], 3);
        written(&stand.flywheel[1].mu_s[0], 3);
        written(&stand.flywheel[1].J_c[0], 6);
        written(&stand.flywheel[1].J_s[0], 6);
        written(&stand.flywheel[1].J_2c[0], 6);
        written(&stand.flywheel[1].J_2s[0], 6);
        written(&stand.flywheel[1].t_0[0], 3);
        written(&stand.flywheel[1].t_c[0], 3);
        written(&stand.flywheel[1].t_s[0], 3);
        written(&stand.flywheel[1].spin, 1);
        written(&stand.flywheel[1].spin_inv, 1);
        written(&stand.flywheel[2].mu_c[0], 3);
        written(&stand.flywheel[2].mu_s[0], 3);
        written(&stand.flywheel[2].J_c[0], 6);
        written(&stand.flywheel[2].J_s[0], 6);
        written(&stand.flywheel[2].J_2c[0], 6);
        written(&stand.flywheel[2].J_2s[0], 6);
        written(&stand.flywheel[2].t_0[0], 3);
        written(&stand.flywheel[2].t_c[0], 3);
        written(&stand.flywheel[2].t_s[0], 3);
        written(&stand.flywheel[2].spin, 1);
        written(&stand.flywheel[2].spin_inv, 1);
    }
}

void demo3_eva_any_prepare(void);
void demo3_eva_any_prepare(void)
{
    demo3_parameters parameters;
    reals(&parameters.carrier.mass, 1, DEMO3_LARGEST);
    reals(&parameters.carrier.center_of_mass[0], 3, DEMO3_LARGEST);
    reals(&parameters.carrier.inertia[0], 6, DEMO3_LARGEST);
    for (int i = 0; i < DEMO3_N; ++i) {
        reals(&parameters.flywheel[i].body.mass, 1, DEMO3_LARGEST);
        reals(&parameters.flywheel[i].body.center_of_mass[0], 3, DEMO3_LARGEST);
        reals(&parameters.flywheel[i].body.inertia[0], 6, DEMO3_LARGEST);
        reals(&parameters.flywheel[i].position[0], 3, DEMO3_LARGEST);
        reals(&parameters.flywheel[i].axis[0], 3, DEMO3_LARGEST);
        reals(&parameters.flywheel[i].zero[0], 3, DEMO3_LARGEST);
    }
    demo3_table stand = demo3_default;
    const demo3_status status = demo3_prepare(&parameters, &stand);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written(&stand.mass, 1);
        written(&stand.mass_inverse, 1);
        written(&stand.first_moment[0], 3);
        written(&stand.inertia[0], 6);
        written(&stand.flywheel[0].mu_c[0], 3);
        written(&stand.flywheel[0].mu_s[0], 3);
        written(&stand.flywheel[0].J_c[0], 6);
        written(&stand.flywheel[0].J_s[0], 6);
        written(&stand.flywheel[0].J_2c[0], 6);
        written(&stand.flywheel[0].J_2s[0], 6);
        written(&stand.flywheel[0].t_0[0], 3);
        written(&stand.flywheel[0].t_c[0], 3);
        written(&stand.flywheel[0].t_s[0], 3);
        written(&stand.flywheel[0].spin, 1);
        written(&stand.flywheel[0].spin_inv, 1);
        written(&stand.flywheel[1].mu_c[0], 3);
        written(&stand.flywheel[1].mu_s[0], 3);
        written(&stand.flywheel[1].J_c[0], 6);
        written(&stand.flywheel[1].J_s[0], 6);
        written(&stand.flywheel[1].J_2c[0], 6);
        written(&stand.flywheel[1].J_2s[0], 6);
        written(&stand.flywheel[1].t_0[0], 3);
        written(&stand.flywheel[1].t_c[0], 3);
        written(&stand.flywheel[1].t_s[0], 3);
        written(&stand.flywheel[1].spin, 1);
        written(&stand.flywheel[1].spin_inv, 1);
        written(&stand.flywheel[2].mu_c[0], 3);
        written(&stand.flywheel[2].mu_s[0], 3);
        written(&stand.flywheel[2].J_c[0], 6);
        written(&stand.flywheel[2].J_s[0], 6);
        written(&stand.flywheel[2].J_2c[0], 6);
        written(&stand.flywheel[2].J_2s[0], 6);
        written(&stand.flywheel[2].t_0[0], 3);
        written(&stand.flywheel[2].t_c[0], 3);
        written(&stand.flywheel[2].t_s[0], 3);
        written(&stand.flywheel[2].spin, 1);
        written(&stand.flywheel[2].spin_inv, 1);
    }
}

void demo3_eva_bits_prepare(void);
void demo3_eva_bits_prepare(void)
{
    demo3_parameters parameters;
    one_of_all(&parameters.carrier.mass);
    all_bits(&parameters.carrier.center_of_mass[0], 3);
    all_bits(&parameters.carrier.inertia[0], 6);
    for (int i = 0; i < DEMO3_N; ++i) {
        one_of_all(&parameters.flywheel[i].body.mass);
        all_bits(&parameters.flywheel[i].body.center_of_mass[0], 3);
        all_bits(&parameters.flywheel[i].body.inertia[0], 6);
        all_bits(&parameters.flywheel[i].position[0], 3);
        all_bits(&parameters.flywheel[i].axis[0], 3);
        all_bits(&parameters.flywheel[i].zero[0], 3);
    }
    demo3_table stand = demo3_default;
    const demo3_status status = demo3_prepare(&parameters, &stand);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        initialised(&stand.mass, 1);
        initialised(&stand.mass_inverse, 1);
        initialised(&stand.first_moment[0], 3);
        initialised(&stand.inertia[0], 6);
        initialised(&stand.flywheel[0].mu_c[0], 3);
        initialised(&stand.flywheel[0].mu_s[0], 3);
        initialised(&stand.flywheel[0].J_c[0], 6);
        initialised(&stand.flywheel[0].J_s[0], 6);
        initialised(&stand.flywheel[0].J_2c[0], 6);
        initialised(&stand.flywheel[0].J_2s[0], 6);
        initialised(&stand.flywheel[0].t_0[0], 3);
        initialised(&stand.flywheel[0].t_c[0], 3);
        initialised(&stand.flywheel[0].t_s[0], 3);
        initialised(&stand.flywheel[0].spin, 1);
        initialised(&stand.flywheel[0].spin_inv, 1);
        initialised(&stand.flywheel[1].mu_c[0], 3);
        initialised(&stand.flywheel[1].mu_s[0], 3);
        initialised(&stand.flywheel[1].J_c[0], 6);
        initialised(&stand.flywheel[1].J_s[0], 6);
        initialised(&stand.flywheel[1].J_2c[0], 6);
        initialised(&stand.flywheel[1].J_2s[0], 6);
        initialised(&stand.flywheel[1].t_0[0], 3);
        initialised(&stand.flywheel[1].t_c[0], 3);
        initialised(&stand.flywheel[1].t_s[0], 3);
        initialised(&stand.flywheel[1].spin, 1);
        initialised(&stand.flywheel[1].spin_inv, 1);
        initialised(&stand.flywheel[2].mu_c[0], 3);
        initialised(&stand.flywheel[2].mu_s[0], 3);
        initialised(&stand.flywheel[2].J_c[0], 6);
        initialised(&stand.flywheel[2].J_s[0], 6);
        initialised(&stand.flywheel[2].J_2c[0], 6);
        initialised(&stand.flywheel[2].J_2s[0], 6);
        initialised(&stand.flywheel[2].t_0[0], 3);
        initialised(&stand.flywheel[2].t_c[0], 3);
        initialised(&stand.flywheel[2].t_s[0], 3);
        initialised(&stand.flywheel[2].spin, 1);
        initialised(&stand.flywheel[2].spin_inv, 1);
    }
}

void demo3_eva_normal_mounts(void);
void demo3_eva_normal_mounts(void)
{
    demo3_mount_table mounting;
    (void)demo3_prepare_mounts(&demo3_default_parameters, &mounting);
    demo3_state x;
    reals(&x.position[0], 3, 100.0);
    quaternion(x.attitude, 2.0);
    reals(&x.V[0], 6, 20.0);
    reals(&x.phi[0], 3, 100.0);
    reals(&x.phi_dot[0], 3, 1.0e3);
    demo3_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    demo3_real phi_ddot[DEMO3_N];
    reals(&phi_ddot[0], 3, 1.0e4);
    demo3_real loads[18];
    const demo3_status status = demo3_mounts(&mounting, &x, V_dot, phi_ddot, loads);
    if (status < 0) {
        untouched(&loads[0], 18);
    } else {
        Frama_C_show_each_returned(status);
        written(&loads[0], 18);
    }
}

void demo3_eva_any_mounts(void);
void demo3_eva_any_mounts(void)
{
    demo3_mount_table mounting;
    (void)demo3_prepare_mounts(&demo3_default_parameters, &mounting);
    demo3_state x;
    reals(&x.position[0], 3, DEMO3_LARGEST);
    quaternion(x.attitude, DEMO3_LARGEST);
    reals(&x.V[0], 6, DEMO3_LARGEST);
    reals(&x.phi[0], 3, DEMO3_LARGEST);
    reals(&x.phi_dot[0], 3, DEMO3_LARGEST);
    demo3_real V_dot[6];
    reals(&V_dot[0], 6, DEMO3_LARGEST);
    demo3_real phi_ddot[DEMO3_N];
    reals(&phi_ddot[0], 3, DEMO3_LARGEST);
    demo3_real loads[18];
    const demo3_status status = demo3_mounts(&mounting, &x, V_dot, phi_ddot, loads);
    if (status < 0) {
        untouched(&loads[0], 18);
    } else {
        Frama_C_show_each_returned(status);
        written(&loads[0], 18);
    }
}

void demo3_eva_bits_mounts(void);
void demo3_eva_bits_mounts(void)
{
    demo3_mount_table mounting;
    (void)demo3_prepare_mounts(&demo3_default_parameters, &mounting);
    demo3_state x;
    all_bits(&x.position[0], 3);
    all_bits(&x.attitude[0], 4);
    all_bits(&x.V[0], 6);
    all_bits(&x.phi[0], 3);
    all_bits(&x.phi_dot[0], 3);
    demo3_real V_dot[6];
    all_bits(&V_dot[0], 6);
    demo3_real phi_ddot[DEMO3_N];
    all_bits(&phi_ddot[0], 3);
    demo3_real loads[18];
    const demo3_status status = demo3_mounts(&mounting, &x, V_dot, phi_ddot, loads);
    if (status < 0) {
        untouched(&loads[0], 18);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&loads[0], 18);
    }
}

void demo3_eva_normal_prepare_mounts(void);
void demo3_eva_normal_prepare_mounts(void)
{
    demo3_parameters parameters;
    about(&parameters.carrier.mass, &demo3_default_parameters.carrier.mass, 1);
    about(&parameters.carrier.center_of_mass[0], &demo3_default_parameters.carrier.center_of_mass[0], 3);
    about(&parameters.carrier.inertia[0], &demo3_default_parameters.carrier.inertia[0], 6);
    for (int i = 0; i < DEMO3_N; ++i) {
        about(&parameters.flywheel[i].body.mass, &demo3_default_parameters.flywheel[i].body.mass, 1);
        about(&parameters.flywheel[i].body.center_of_mass[0], &demo3_default_parameters.flywheel[i].body.center_of_mass[0], 3);
        about(&parameters.flywheel[i].body.inertia[0], &demo3_default_parameters.flywheel[i].body.inertia[0], 6);
        about(&parameters.flywheel[i].position[0], &demo3_default_parameters.flywheel[i].position[0], 3);
        about(&parameters.flywheel[i].axis[0], &demo3_default_parameters.flywheel[i].axis[0], 3);
        about(&parameters.flywheel[i].zero[0], &demo3_default_parameters.flywheel[i].zero[0], 3);
    }
    demo3_mount_table mounting;
    const demo3_status status = demo3_prepare_mounts(&parameters, &mounting);
    if (status < 0) {
        untouched(&mounting.flywheel[0].mass, 1);
        untouched(&mounting.flywheel[0].first_moment[0], 3);
        untouched(&mounting.flywheel[0].inertia[0], 6);
        untouched(&mounting.flywheel[0].origin[0], 3);
        untouched(&mounting.flywheel[0].axes[0], 9);
        untouched(&mounting.flywheel[1].mass, 1);
        untouched(&mounting.flywheel[1].first_moment[0], 3);
        untouched(&mounting.flywheel[1].inertia[0], 6);
        untouched(&mounting.flywheel[1].origin[0], 3);
        untouched(&mounting.flywheel[1].axes[0], 9);
        untouched(&mounting.flywheel[2].mass, 1);
        untouched(&mounting.flywheel[2].first_moment[0], 3);
        untouched(&mounting.flywheel[2].inertia[0], 6);
        untouched(&mounting.flywheel[2].origin[0], 3);
        untouched(&mounting.flywheel[2].axes[0], 9);
    } else {
        Frama_C_show_each_returned(status);
        written(&mounting.flywheel[0].mass, 1);
        written(&mounting.flywheel[0].first_moment[0], 3);
        written(&mounting.flywheel[0].inertia[0], 6);
        written(&mounting.flywheel[0].origin[0], 3);
        written(&mounting.flywheel[0].axes[0], 9);
        written(&mounting.flywheel[1].mass, 1);
        written(&mounting.flywheel[1].first_moment[0], 3);
        written(&mounting.flywheel[1].inertia[0], 6);
        written(&mounting.flywheel[1].origin[0], 3);
        written(&mounting.flywheel[1].axes[0], 9);
        written(&mounting.flywheel[2].mass, 1);
        written(&mounting.flywheel[2].first_moment[0], 3);
        written(&mounting.flywheel[2].inertia[0], 6);
        written(&mounting.flywheel[2].origin[0], 3);
        written(&mounting.flywheel[2].axes[0], 9);
    }
}

void demo3_eva_any_prepare_mounts(void);
void demo3_eva_any_prepare_mounts(void)
{
    demo3_parameters parameters;
    reals(&parameters.carrier.mass, 1, DEMO3_LARGEST);
    reals(&parameters.carrier.center_of_mass[0], 3, DEMO3_LARGEST);
    reals(&parameters.carrier.inertia[0], 6, DEMO3_LARGEST);
    for (int i = 0; i < DEMO3_N; ++i) {
        reals(&parameters.flywheel[i].body.mass, 1, DEMO3_LARGEST);
        reals(&parameters.flywheel[i].body.center_of_mass[0], 3, DEMO3_LARGEST);
        reals(&parameters.flywheel[i].body.inertia[0], 6, DEMO3_LARGEST);
        reals(&parameters.flywheel[i].position[0], 3, DEMO3_LARGEST);
        reals(&parameters.flywheel[i].axis[0], 3, DEMO3_LARGEST);
        reals(&parameters.flywheel[i].zero[0], 3, DEMO3_LARGEST);
    }
    demo3_mount_table mounting;
    const demo3_status status = demo3_prepare_mounts(&parameters, &mounting);
    if (status < 0) {
        untouched(&mounting.flywheel[0].mass, 1);
        untouched(&mounting.flywheel[0].first_moment[0], 3);
        untouched(&mounting.flywheel[0].inertia[0], 6);
        untouched(&mounting.flywheel[0].origin[0], 3);
        untouched(&mounting.flywheel[0].axes[0], 9);
        untouched(&mounting.flywheel[1].mass, 1);
        untouched(&mounting.flywheel[1].first_moment[0], 3);
        untouched(&mounting.flywheel[1].inertia[0], 6);
        untouched(&mounting.flywheel[1].origin[0], 3);
        untouched(&mounting.flywheel[1].axes[0], 9);
        untouched(&mounting.flywheel[2].mass, 1);
        untouched(&mounting.flywheel[2].first_moment[0], 3);
        untouched(&mounting.flywheel[2].inertia[0], 6);
        untouched(&mounting.flywheel[2].origin[0], 3);
        untouched(&mounting.flywheel[2].axes[0], 9);
    } else {
        Frama_C_show_each_returned(status);
        written(&mounting.flywheel[0].mass, 1);
        written(&mounting.flywheel[0].first_moment[0], 3);
        written(&mounting.flywheel[0].inertia[0], 6);
        written(&mounting.flywheel[0].origin[0], 3);
        written(&mounting.flywheel[0].axes[0], 9);
        written(&mounting.flywheel[1].mass, 1);
        written(&mounting.flywheel[1].first_moment[0], 3);
        written(&mounting.flywheel[1].inertia[0], 6);
        written(&mounting.flywheel[1].origin[0], 3);
        written(&mounting.flywheel[1].axes[0], 9);
        written(&mounting.flywheel[2].mass, 1);
        written(&mounting.flywheel[2].first_moment[0], 3);
        written(&mounting.flywheel[2].inertia[0], 6);
        written(&mounting.flywheel[2].origin[0], 3);
        written(&mounting.flywheel[2].axes[0], 9);
    }
}

void demo3_eva_bits_prepare_mounts(void);
void demo3_eva_bits_prepare_mounts(void)
{
    demo3_parameters parameters;
    one_of_all(&parameters.carrier.mass);
    all_bits(&parameters.carrier.center_of_mass[0], 3);
    all_bits(&parameters.carrier.inertia[0], 6);
    for (int i = 0; i < DEMO3_N; ++i) {
        one_of_all(&parameters.flywheel[i].body.mass);
        all_bits(&parameters.flywheel[i].body.center_of_mass[0], 3);
        all_bits(&parameters.flywheel[i].body.inertia[0], 6);
        all_bits(&parameters.flywheel[i].position[0], 3);
        all_bits(&parameters.flywheel[i].axis[0], 3);
        all_bits(&parameters.flywheel[i].zero[0], 3);
    }
    demo3_mount_table mounting;
    const demo3_status status = demo3_prepare_mounts(&parameters, &mounting);
    if (status < 0) {
        untouched(&mounting.flywheel[0].mass, 1);
        untouched(&mounting.flywheel[0].first_moment[0], 3);
        untouched(&mounting.flywheel[0].inertia[0], 6);
        untouched(&mounting.flywheel[0].origin[0], 3);
        untouched(&mounting.flywheel[0].axes[0], 9);
        untouched(&mounting.flywheel[1].mass, 1);
        untouched(&mounting.flywheel[1].first_moment[0], 3);
        untouched(&mounting.flywheel[1].inertia[0], 6);
        untouched(&mounting.flywheel[1].origin[0], 3);
        untouched(&mounting.flywheel[1].axes[0], 9);
        untouched(&mounting.flywheel[2].mass, 1);
        untouched(&mounting.flywheel[2].first_moment[0], 3);
        untouched(&mounting.flywheel[2].inertia[0], 6);
        untouched(&mounting.flywheel[2].origin[0], 3);
        untouched(&mounting.flywheel[2].axes[0], 9);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&mounting.flywheel[0].mass, 1);
        initialised(&mounting.flywheel[0].first_moment[0], 3);
        initialised(&mounting.flywheel[0].inertia[0], 6);
        initialised(&mounting.flywheel[0].origin[0], 3);
        initialised(&mounting.flywheel[0].axes[0], 9);
        initialised(&mounting.flywheel[1].mass, 1);
        initialised(&mounting.flywheel[1].first_moment[0], 3);
        initialised(&mounting.flywheel[1].inertia[0], 6);
        initialised(&mounting.flywheel[1].origin[0], 3);
        initialised(&mounting.flywheel[1].axes[0], 9);
        initialised(&mounting.flywheel[2].mass, 1);
        initialised(&mounting.flywheel[2].first_moment[0], 3);
        initialised(&mounting.flywheel[2].inertia[0], 6);
        initialised(&mounting.flywheel[2].origin[0], 3);
        initialised(&mounting.flywheel[2].axes[0], 9);
    }
}

void demo3_eva_routine_sincos(void);
void demo3_eva_routine_sincos(void)
{
    demo3_real x;
    one_of_all(&x);
    demo3_real sine;
    demo3_real cosine;
    demo3_sincos(x, &sine, &cosine);
    Frama_C_show_each_returned(0);
}

void demo3_eva_routine_sqrt(void);
void demo3_eva_routine_sqrt(void)
{
    demo3_real x;
    one_of_all(&x);
    (void)demo3_sqrt(x);
    Frama_C_show_each_returned(0);
}
