/* bench8_eva.c: drivers of Frama-C Eva for the stand "bench8": what is proved of bench8.c. Run by bench8_eva.sh.
 * mahovik 0.1.0; structure 309d41a6, physics 139422e0. Generated: change the stand file instead.
 *
 * Only Frama-C reads this file: for compilers it is empty. A driver calls one function with all inputs of a set at once:
 *   normal   magnitudes of ordinary use: the numbers in the driver
 *   any      every finite number, every integer: what the checks of the function let through is all it computes with
 *   bits     every bit pattern: NaN and infinities as well
 * normal, any: Eva shows that no operation is undefined (index, uninitialised read, integer overflow, division by
 * zero) and that no real becomes infinite or NaN on the way, but in the sums of the checks; of the results, that they are written and finite where
 * the status is not negative, and untouched where it is. bits, with -warn-special-float none: the same, but nothing of
 * finiteness, for Eva 25 lets NaN pass a comparison that C does not. */
#include "../bench8.h"

#ifdef __FRAMAC__
#include <limits.h>

#include "__fc_builtin.h"
#include "features.h"

/* Routines that work on the bits of a real are beyond intervals. For the sets normal and any they are what is said here,
 * tested elsewhere (docs/proofs.md of mahovik: sine and cosine to a unit in the last place, square root
 * correctly rounded, so Eva's own stands for it); for the others, and in drivers of their own, Eva reads their bodies. */

/*@ requires -10000000.0 <= x <= 10000000.0;
    assigns *sine, *cosine \from x;
    ensures \initialized(sine) && \initialized(cosine);
    ensures \is_finite(*sine) && \is_finite(*cosine);
    ensures -1.0000002 <= *sine <= 1.0000002;
    ensures -1.0000002 <= *cosine <= 1.0000002; */
static void bench8_sincos(bench8_real x, bench8_real *restrict sine, bench8_real *restrict cosine);

/*@
    requires -10000000.0 <= x[0] <= 10000000.0;
    requires -10000000.0 <= x[1] <= 10000000.0;
    requires -10000000.0 <= x[2] <= 10000000.0;
    requires -10000000.0 <= x[3] <= 10000000.0;
    requires -10000000.0 <= x[4] <= 10000000.0;
    requires -10000000.0 <= x[5] <= 10000000.0;
    requires -10000000.0 <= x[6] <= 10000000.0;
    requires -10000000.0 <= x[7] <= 10000000.0;
    assigns sine[0 .. 7], cosine[0 .. 7] \from x[0 .. 7];
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
    ensures \initialized(sine + 3) && \initialized(cosine + 3);
    ensures \is_finite(sine[3]) && \is_finite(cosine[3]);
    ensures -1.0000002 <= sine[3] <= 1.0000002;
    ensures -1.0000002 <= cosine[3] <= 1.0000002;
    ensures \initialized(sine + 4) && \initialized(cosine + 4);
    ensures \is_finite(sine[4]) && \is_finite(cosine[4]);
    ensures -1.0000002 <= sine[4] <= 1.0000002;
    ensures -1.0000002 <= cosine[4] <= 1.0000002;
    ensures \initialized(sine + 5) && \initialized(cosine + 5);
    ensures \is_finite(sine[5]) && \is_finite(cosine[5]);
    ensures -1.0000002 <= sine[5] <= 1.0000002;
    ensures -1.0000002 <= cosine[5] <= 1.0000002;
    ensures \initialized(sine + 6) && \initialized(cosine + 6);
    ensures \is_finite(sine[6]) && \is_finite(cosine[6]);
    ensures -1.0000002 <= sine[6] <= 1.0000002;
    ensures -1.0000002 <= cosine[6] <= 1.0000002;
    ensures \initialized(sine + 7) && \initialized(cosine + 7);
    ensures \is_finite(sine[7]) && \is_finite(cosine[7]);
    ensures -1.0000002 <= sine[7] <= 1.0000002;
    ensures -1.0000002 <= cosine[7] <= 1.0000002;
*/
static void bench8_sincos_each(const bench8_real *x, bench8_real *restrict sine,
    bench8_real *restrict cosine);

__PUSH_FC_STDLIB
/*@ requires x >= 0.0;
    assigns \result \from x; */
static bench8_real bench8_sqrt(bench8_real x);
__POP_FC_STDLIB

/*@ assigns \result \from y, x;
    ensures \is_finite(\result);
    ensures -3.1415928 <= \result <= 3.1415928; */
static bench8_real bench8_atan2(bench8_real y, bench8_real x);

/* Checks have a quick way by sums of squares, of which intervals do not see that each number is within its limit. For the
 * sets normal and any they are what is said here; drivers of their own show it of their bodies, of all finite arguments:
 * with one number beyond its limit, or a quaternion without a large component, they refuse. */

#ifndef BENCH8_EVA_BODIES  /* these drivers must not rest on what they show */
/*@ assigns \result \from *x;
    ensures (\result == 0
        && -BENCH8_MAX_POSITION <= x->position[0] <= BENCH8_MAX_POSITION
        && -BENCH8_MAX_POSITION <= x->position[1] <= BENCH8_MAX_POSITION
        && -BENCH8_MAX_POSITION <= x->position[2] <= BENCH8_MAX_POSITION
        && -2.0 <= x->attitude[0] <= 2.0
        && -2.0 <= x->attitude[1] <= 2.0
        && -2.0 <= x->attitude[2] <= 2.0
        && -2.0 <= x->attitude[3] <= 2.0
        && -BENCH8_MAX_SPEED <= x->V[0] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->V[1] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->V[2] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->V[3] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->V[4] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->V[5] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_VELOCITY <= x->V[0] <= BENCH8_MAX_VELOCITY
        && -BENCH8_MAX_VELOCITY <= x->V[1] <= BENCH8_MAX_VELOCITY
        && -BENCH8_MAX_VELOCITY <= x->V[2] <= BENCH8_MAX_VELOCITY
        && -BENCH8_MAX_PHASE <= x->phi[0] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[1] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[2] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[3] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[4] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[5] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[6] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[7] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_SPEED <= x->phi_dot[0] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[1] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[2] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[3] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[4] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[5] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[6] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[7] <= BENCH8_MAX_SPEED
        && (x->attitude[0] >= 0.4992 || x->attitude[0] <= -0.4992 || x->attitude[1] >= 0.4992 || x->attitude[1] <= -0.4992 || x->attitude[2] >= 0.4992 || x->attitude[2] <= -0.4992 || x->attitude[3] >= 0.4992 || x->attitude[3] <= -0.4992)
        ) || \result < 0; */
static bench8_status bench8_check_state(const bench8_state *x);

/*@ assigns \result \from *x, values[0 .. 7], limit;
    ensures (\result == 0
        && -BENCH8_MAX_POSITION <= x->position[0] <= BENCH8_MAX_POSITION
        && -BENCH8_MAX_POSITION <= x->position[1] <= BENCH8_MAX_POSITION
        && -BENCH8_MAX_POSITION <= x->position[2] <= BENCH8_MAX_POSITION
        && -2.0 <= x->attitude[0] <= 2.0
        && -2.0 <= x->attitude[1] <= 2.0
        && -2.0 <= x->attitude[2] <= 2.0
        && -2.0 <= x->attitude[3] <= 2.0
        && -BENCH8_MAX_SPEED <= x->V[0] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->V[1] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->V[2] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->V[3] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->V[4] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->V[5] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_VELOCITY <= x->V[0] <= BENCH8_MAX_VELOCITY
        && -BENCH8_MAX_VELOCITY <= x->V[1] <= BENCH8_MAX_VELOCITY
        && -BENCH8_MAX_VELOCITY <= x->V[2] <= BENCH8_MAX_VELOCITY
        && -BENCH8_MAX_PHASE <= x->phi[0] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[1] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[2] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[3] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[4] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[5] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[6] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_PHASE <= x->phi[7] <= BENCH8_MAX_PHASE
        && -BENCH8_MAX_SPEED <= x->phi_dot[0] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[1] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[2] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[3] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[4] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[5] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[6] <= BENCH8_MAX_SPEED
        && -BENCH8_MAX_SPEED <= x->phi_dot[7] <= BENCH8_MAX_SPEED
        && -limit <= values[0] <= limit
        && -limit <= values[1] <= limit
        && -limit <= values[2] <= limit
        && -limit <= values[3] <= limit
        && -limit <= values[4] <= limit
        && -limit <= values[5] <= limit
        && -limit <= values[6] <= limit
        && -limit <= values[7] <= limit
        && (x->attitude[0] >= 0.4992 || x->attitude[0] <= -0.4992 || x->attitude[1] >= 0.4992 || x->attitude[1] <= -0.4992 || x->attitude[2] >= 0.4992 || x->attitude[2] <= -0.4992 || x->attitude[3] >= 0.4992 || x->attitude[3] <= -0.4992)
        ) || \result < 0; */
static bench8_status bench8_check_motion(const bench8_state *x, const bench8_real values[BENCH8_N],
                                         bench8_real limit);

#endif

#include "../bench8.c"

/* ---- sets of numbers ---- */

static bench8_real real_in(bench8_real low, bench8_real high)
{
    return Frama_C_double_interval(low, high);
}

static void reals(bench8_real *x, int count, bench8_real size)
{
    for (int i = 0; i < count; ++i) { x[i] = real_in(-size, size); }
}

static volatile bench8_real any_bits;  /* Eva: each read may give every bit pattern */

static void all_bits(bench8_real *x, int count)
{
    for (int i = 0; i < count; ++i) { x[i] = any_bits; }
}

static void not_finite(bench8_real *x)
{
    const bench8_real zero = 0.0;
    switch (Frama_C_interval(0, 2)) {
    case 0: *x = 1.0 / zero; break;
    case 1: *x = -1.0 / zero; break;
    default: *x = zero / zero; break;
    }
}

/* One number of any bits, finite numbers apart from the others. */
static void one_of_all(bench8_real *x)
{
    if (Frama_C_interval(0, 1) == 0) {
        not_finite(x);
    } else {
        *x = real_in(-BENCH8_LARGEST, BENCH8_LARGEST);
    }
}

static void integers(int *x, int count, int low, int high)
{
    for (int i = 0; i < count; ++i) { x[i] = Frama_C_interval(low, high); }
}

/* A number within one part in a hundred of another. */
static bench8_real near(bench8_real x)
{
    const bench8_real a = x * 0.99;
    const bench8_real b = x * 1.01;
    return a <= b ? real_in(a, b) : real_in(b, a);
}

static void about(bench8_real *x, const bench8_real *middle, int count)
{
    for (int i = 0; i < count; ++i) { x[i] = near(middle[i]); }
}

/* A quaternion. Where the sum of four squares is at least 0.998001, one of them is at least a quarter of that: so one
 * component is at least 0.499 in magnitude. Which, and its sign, are eight cases; all others are refused by
 * the checks, which the case without a large component shows. */
static void quaternion(bench8_real q[4], bench8_real size)
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

/* One number of an array is beyond a limit, whose next number is `above`: 1. None: 0. */
static int one_beyond(bench8_real *x, int count, bench8_real above)
{
    for (int i = 0; i < count; ++i) {
        if (Frama_C_interval(0, 1) == 0) {
            x[i] = (Frama_C_interval(0, 1) == 0) ? real_in(above, BENCH8_LARGEST) : real_in(-BENCH8_LARGEST, -above);
            return 1;
        }
    }
    return 0;
}

/* ---- what is asserted of results ---- */

static void written(const bench8_real *x, int count)
{
    for (int i = 0; i < count; ++i) {
        /*@ check \initialized(&x[i]) && \is_finite(x[i]); */
    }
}

static void initialised(const bench8_real *x, int count)
{
    for (int i = 0; i < count; ++i) {
        /*@ check \initialized(&x[i]); */
    }
}

static void untouched(const bench8_real *x, int count)
{
    for (int i = 0; i < count; ++i) {
        /*@ check !\initialized(&x[i]); */
    }
}

/* ---- whole structs ---- */

static void normal_state(bench8_state *x)
{
    reals(&x->position[0], 3, 100.0);
    quaternion(x->attitude, 2.0);
    reals(&x->V[0], 6, 20.0);
    reals(&x->phi[0], 8, 100.0);
    reals(&x->phi_dot[0], 8, 1.0e3);
}

static void any_state(bench8_state *x)
{
    reals(&x->position[0], 3, BENCH8_LARGEST);
    quaternion(x->attitude, BENCH8_LARGEST);
    reals(&x->V[0], 6, BENCH8_LARGEST);
    reals(&x->phi[0], 8, BENCH8_LARGEST);
    reals(&x->phi_dot[0], 8, BENCH8_LARGEST);
}

static void bits_state(bench8_state *x)
{
    all_bits(&x->position[0], 3);
    all_bits(&x->attitude[0], 4);
    all_bits(&x->V[0], 6);
    all_bits(&x->phi[0], 8);
    all_bits(&x->phi_dot[0], 8);
}

static void normal_encoder(bench8_encoder *x)
{
    integers(&x->counter, 1, -1048576, 1048576);
    integers(&x->place, 1, -1048576, 1048576);
    integers(&x->moved, 1, -1048576, 1048576);
}

static void any_encoder(bench8_encoder *x)
{
    integers(&x->counter, 1, INT_MIN, INT_MAX);
    integers(&x->place, 1, INT_MIN, INT_MAX);
    integers(&x->moved, 1, INT_MIN, INT_MAX);
}

static void bits_encoder(bench8_encoder *x)
{
    integers(&x->counter, 1, INT_MIN, INT_MAX);
    integers(&x->place, 1, INT_MIN, INT_MAX);
    integers(&x->moved, 1, INT_MIN, INT_MAX);
}

static void normal_inverse_options(bench8_inverse_options *x)
{
    about(&x->weight[0], &bench8_default_options.weight[0], 8);
    about(&x->limit[0], &bench8_default_options.limit[0], 8);
    about(&x->most[0], &bench8_default_options.most[0], 8);
    about(&x->motor_torque[0], &bench8_default_options.motor_torque[0], 8);
    about(&x->motor_speed[0], &bench8_default_options.motor_speed[0], 8);
    about(&x->motor_viscous[0], &bench8_default_options.motor_viscous[0], 8);
    about(&x->motor_coulomb[0], &bench8_default_options.motor_coulomb[0], 8);
    about(&x->motor_coulomb_speed[0], &bench8_default_options.motor_coulomb_speed[0], 8);
    about(&x->near_singular, &bench8_default_options.near_singular, 1);
    about(&x->damping, &bench8_default_options.damping, 1);
}

static void any_inverse_options(bench8_inverse_options *x)
{
    reals(&x->weight[0], 8, BENCH8_LARGEST);
    reals(&x->limit[0], 8, BENCH8_LARGEST);
    reals(&x->most[0], 8, BENCH8_LARGEST);
    reals(&x->motor_torque[0], 8, BENCH8_LARGEST);
    reals(&x->motor_speed[0], 8, BENCH8_LARGEST);
    reals(&x->motor_viscous[0], 8, BENCH8_LARGEST);
    reals(&x->motor_coulomb[0], 8, BENCH8_LARGEST);
    reals(&x->motor_coulomb_speed[0], 8, BENCH8_LARGEST);
    reals(&x->near_singular, 1, BENCH8_LARGEST);
    reals(&x->damping, 1, BENCH8_LARGEST);
}

static void bits_inverse_options(bench8_inverse_options *x)
{
    all_bits(&x->weight[0], 8);
    all_bits(&x->limit[0], 8);
    all_bits(&x->most[0], 8);
    all_bits(&x->motor_torque[0], 8);
    all_bits(&x->motor_speed[0], 8);
    all_bits(&x->motor_viscous[0], 8);
    all_bits(&x->motor_coulomb[0], 8);
    all_bits(&x->motor_coulomb_speed[0], 8);
    one_of_all(&x->near_singular);
    one_of_all(&x->damping);
}

static void normal_parameters(bench8_parameters *x)
{
    about(&x->carrier.mass, &bench8_default_parameters.carrier.mass, 1);
    about(&x->carrier.center_of_mass[0], &bench8_default_parameters.carrier.center_of_mass[0], 3);
    about(&x->carrier.inertia[0], &bench8_default_parameters.carrier.inertia[0], 6);
    for (int i = 0; i < BENCH8_N; ++i) {
        about(&x->flywheel[i].body.mass, &bench8_default_parameters.flywheel[i].body.mass, 1);
        about(&x->flywheel[i].body.center_of_mass[0], &bench8_default_parameters.flywheel[i].body.center_of_mass[0], 3);
        about(&x->flywheel[i].body.inertia[0], &bench8_default_parameters.flywheel[i].body.inertia[0], 6);
        about(&x->flywheel[i].position[0], &bench8_default_parameters.flywheel[i].position[0], 3);
        about(&x->flywheel[i].axis[0], &bench8_default_parameters.flywheel[i].axis[0], 3);
        about(&x->flywheel[i].zero[0], &bench8_default_parameters.flywheel[i].zero[0], 3);
    }
}

static void any_parameters(bench8_parameters *x)
{
    reals(&x->carrier.mass, 1, BENCH8_LARGEST);
    reals(&x->carrier.center_of_mass[0], 3, BENCH8_LARGEST);
    reals(&x->carrier.inertia[0], 6, BENCH8_LARGEST);
    for (int i = 0; i < BENCH8_N; ++i) {
        reals(&x->flywheel[i].body.mass, 1, BENCH8_LARGEST);
        reals(&x->flywheel[i].body.center_of_mass[0], 3, BENCH8_LARGEST);
        reals(&x->flywheel[i].body.inertia[0], 6, BENCH8_LARGEST);
        reals(&x->flywheel[i].position[0], 3, BENCH8_LARGEST);
        reals(&x->flywheel[i].axis[0], 3, BENCH8_LARGEST);
        reals(&x->flywheel[i].zero[0], 3, BENCH8_LARGEST);
    }
}

static void bits_parameters(bench8_parameters *x)
{
    one_of_all(&x->carrier.mass);
    all_bits(&x->carrier.center_of_mass[0], 3);
    all_bits(&x->carrier.inertia[0], 6);
    for (int i = 0; i < BENCH8_N; ++i) {
        one_of_all(&x->flywheel[i].body.mass);
        all_bits(&x->flywheel[i].body.center_of_mass[0], 3);
        all_bits(&x->flywheel[i].body.inertia[0], 6);
        all_bits(&x->flywheel[i].position[0], 3);
        all_bits(&x->flywheel[i].axis[0], 3);
        all_bits(&x->flywheel[i].zero[0], 3);
    }
}

static void normal_step_carry(bench8_step_carry *x)
{
    reals(&x->rounding[0], 29, 1.0e-6);
}

static void any_step_carry(bench8_step_carry *x)
{
    reals(&x->rounding[0], 29, BENCH8_LARGEST);
}

static void bits_step_carry(bench8_step_carry *x)
{
    all_bits(&x->rounding[0], 29);
}

static void untouched_matrices_result(const bench8_matrices_result *x)
{
    untouched(&x->K[0][0], 36);
    untouched(&x->K_dot[0][0], 36);
    untouched(&x->M[0][0], 36);
    untouched(&x->I_[0][0], 48);
    untouched(&x->J[0][0], 48);
    untouched(&x->F[0], 6);
}

static void written_matrices_result(const bench8_matrices_result *x)
{
    written(&x->K[0][0], 36);
    written(&x->K_dot[0][0], 36);
    written(&x->M[0][0], 36);
    written(&x->I_[0][0], 48);
    written(&x->J[0][0], 48);
    written(&x->F[0], 6);
}

static void initialised_matrices_result(const bench8_matrices_result *x)
{
    initialised(&x->K[0][0], 36);
    initialised(&x->K_dot[0][0], 36);
    initialised(&x->M[0][0], 36);
    initialised(&x->I_[0][0], 48);
    initialised(&x->J[0][0], 48);
    initialised(&x->F[0], 6);
}

static void untouched_momentum_result(const bench8_momentum_result *x)
{
    untouched(&x->Z[0], 6);
    untouched(&x->Z0[0], 6);
    untouched(&x->energy, 1);
    untouched(&x->center_of_mass[0], 3);
    untouched(&x->center_of_mass_velocity[0], 3);
}

static void written_momentum_result(const bench8_momentum_result *x)
{
    written(&x->Z[0], 6);
    written(&x->Z0[0], 6);
    written(&x->energy, 1);
    written(&x->center_of_mass[0], 3);
    written(&x->center_of_mass_velocity[0], 3);
}

static void initialised_momentum_result(const bench8_momentum_result *x)
{
    initialised(&x->Z[0], 6);
    initialised(&x->Z0[0], 6);
    initialised(&x->energy, 1);
    initialised(&x->center_of_mass[0], 3);
    initialised(&x->center_of_mass_velocity[0], 3);
}

static void untouched_state(const bench8_state *x)
{
    untouched(&x->position[0], 3);
    untouched(&x->attitude[0], 4);
    untouched(&x->V[0], 6);
    untouched(&x->phi[0], 8);
    untouched(&x->phi_dot[0], 8);
}

static void written_state(const bench8_state *x)
{
    written(&x->position[0], 3);
    written(&x->attitude[0], 4);
    written(&x->V[0], 6);
    written(&x->phi[0], 8);
    written(&x->phi_dot[0], 8);
}

static void initialised_state(const bench8_state *x)
{
    initialised(&x->position[0], 3);
    initialised(&x->attitude[0], 4);
    initialised(&x->V[0], 6);
    initialised(&x->phi[0], 8);
    initialised(&x->phi_dot[0], 8);
}

static void written_encoder(const bench8_encoder *x)
{
    /*@ check \initialized(&x->counter); */
    /*@ check \initialized(&x->place); */
    /*@ check \initialized(&x->moved); */
}

static void initialised_encoder(const bench8_encoder *x)
{
    /*@ check \initialized(&x->counter); */
    /*@ check \initialized(&x->place); */
    /*@ check \initialized(&x->moved); */
}

static void untouched_forward_jacobian_result(const bench8_forward_jacobian_result *x)
{
    untouched(&x->V_dot_V[0][0], 36);
    untouched(&x->V_dot_phi[0][0], 48);
    untouched(&x->V_dot_phi_dot[0][0], 48);
    untouched(&x->V_dot_phi_ddot[0][0], 48);
}

static void written_forward_jacobian_result(const bench8_forward_jacobian_result *x)
{
    written(&x->V_dot_V[0][0], 36);
    written(&x->V_dot_phi[0][0], 48);
    written(&x->V_dot_phi_dot[0][0], 48);
    written(&x->V_dot_phi_ddot[0][0], 48);
}

static void initialised_forward_jacobian_result(const bench8_forward_jacobian_result *x)
{
    initialised(&x->V_dot_V[0][0], 36);
    initialised(&x->V_dot_phi[0][0], 48);
    initialised(&x->V_dot_phi_dot[0][0], 48);
    initialised(&x->V_dot_phi_ddot[0][0], 48);
}

static void untouched_coupled_jacobian_result(const bench8_coupled_jacobian_result *x)
{
    untouched(&x->V_dot_V[0][0], 36);
    untouched(&x->V_dot_phi[0][0], 48);
    untouched(&x->V_dot_phi_dot[0][0], 48);
    untouched(&x->V_dot_tau[0][0], 48);
    untouched(&x->phi_ddot_V[0][0], 48);
    untouched(&x->phi_ddot_phi[0][0], 64);
    untouched(&x->phi_ddot_phi_dot[0][0], 64);
    untouched(&x->phi_ddot_tau[0][0], 64);
}

static void written_coupled_jacobian_result(const bench8_coupled_jacobian_result *x)
{
    written(&x->V_dot_V[0][0], 36);
    written(&x->V_dot_phi[0][0], 48);
    written(&x->V_dot_phi_dot[0][0], 48);
    written(&x->V_dot_tau[0][0], 48);
    written(&x->phi_ddot_V[0][0], 48);
    written(&x->phi_ddot_phi[0][0], 64);
    written(&x->phi_ddot_phi_dot[0][0], 64);
    written(&x->phi_ddot_tau[0][0], 64);
}

static void initialised_coupled_jacobian_result(const bench8_coupled_jacobian_result *x)
{
    initialised(&x->V_dot_V[0][0], 36);
    initialised(&x->V_dot_phi[0][0], 48);
    initialised(&x->V_dot_phi_dot[0][0], 48);
    initialised(&x->V_dot_tau[0][0], 48);
    initialised(&x->phi_ddot_V[0][0], 48);
    initialised(&x->phi_ddot_phi[0][0], 64);
    initialised(&x->phi_ddot_phi_dot[0][0], 64);
    initialised(&x->phi_ddot_tau[0][0], 64);
}

static void untouched_inverse_result(const bench8_inverse_result *x)
{
    untouched(&x->phi_ddot[0], 8);
    untouched(&x->residual[0], 6);
    untouched(&x->sigma[0], 6);
    untouched(&x->damped_by, 1);
    untouched(&x->hardest[0], 6);
}

static void written_inverse_result(const bench8_inverse_result *x)
{
    written(&x->phi_ddot[0], 8);
    written(&x->residual[0], 6);
    written(&x->sigma[0], 6);
    /*@ check \initialized(&x->rank); */
    written(&x->damped_by, 1);
    /*@ check \initialized(&x->limited[0]); */
    written(&x->hardest[0], 6);
}

static void initialised_inverse_result(const bench8_inverse_result *x)
{
    initialised(&x->phi_ddot[0], 8);
    initialised(&x->residual[0], 6);
    initialised(&x->sigma[0], 6);
    /*@ check \initialized(&x->rank); */
    initialised(&x->damped_by, 1);
    /*@ check \initialized(&x->limited[0]); */
    initialised(&x->hardest[0], 6);
}

static void untouched_generalized_result(const bench8_generalized_result *x)
{
    untouched(&x->A[0][0], 36);
    untouched(&x->D[0][0], 36);
    untouched(&x->I0[0][0], 36);
    untouched(&x->J0[0][0], 36);
    untouched(&x->q_dot[0], 6);
    untouched(&x->q_ddot[0], 6);
}

static void written_generalized_result(const bench8_generalized_result *x)
{
    written(&x->A[0][0], 36);
    written(&x->D[0][0], 36);
    written(&x->I0[0][0], 36);
    written(&x->J0[0][0], 36);
    written(&x->q_dot[0], 6);
    written(&x->q_ddot[0], 6);
}

static void initialised_generalized_result(const bench8_generalized_result *x)
{
    initialised(&x->A[0][0], 36);
    initialised(&x->D[0][0], 36);
    initialised(&x->I0[0][0], 36);
    initialised(&x->J0[0][0], 36);
    initialised(&x->q_dot[0], 6);
    initialised(&x->q_ddot[0], 6);
}

static void written_table(const bench8_table *x)
{
    written(&x->mass, 1);
    written(&x->mass_inverse, 1);
    written(&x->first_moment[0], 3);
    written(&x->inertia[0], 6);
    written(&x->flywheel[0].mu_c[0], 3);
    written(&x->flywheel[0].mu_s[0], 3);
    written(&x->flywheel[0].J_c[0], 6);
    written(&x->flywheel[0].J_s[0], 6);
    written(&x->flywheel[0].J_2c[0], 6);
    written(&x->flywheel[0].J_2s[0], 6);
    written(&x->flywheel[0].t_0[0], 3);
    written(&x->flywheel[0].t_c[0], 3);
    written(&x->flywheel[0].t_s[0], 3);
    written(&x->flywheel[0].spin, 1);
    written(&x->flywheel[0].spin_inv, 1);
    written(&x->flywheel[0].spin_root_inv, 1);
    written(&x->flywheel[1].mu_c[0], 3);
    written(&x->flywheel[1].mu_s[0], 3);
    written(&x->flywheel[1].J_c[0], 6);
    written(&x->flywheel[1].J_s[0], 6);
    written(&x->flywheel[1].J_2c[0], 6);
    written(&x->flywheel[1].J_2s[0], 6);
    written(&x->flywheel[1].t_0[0], 3);
    written(&x->flywheel[1].t_c[0], 3);
    written(&x->flywheel[1].t_s[0], 3);
    written(&x->flywheel[1].spin, 1);
    written(&x->flywheel[1].spin_inv, 1);
    written(&x->flywheel[1].spin_root_inv, 1);
    written(&x->flywheel[2].mu_c[0], 3);
    written(&x->flywheel[2].mu_s[0], 3);
    written(&x->flywheel[2].J_c[0], 6);
    written(&x->flywheel[2].J_s[0], 6);
    written(&x->flywheel[2].J_2c[0], 6);
    written(&x->flywheel[2].J_2s[0], 6);
    written(&x->flywheel[2].t_0[0], 3);
    written(&x->flywheel[2].t_c[0], 3);
    written(&x->flywheel[2].t_s[0], 3);
    written(&x->flywheel[2].spin, 1);
    written(&x->flywheel[2].spin_inv, 1);
    written(&x->flywheel[2].spin_root_inv, 1);
    written(&x->flywheel[3].mu_c[0], 3);
    written(&x->flywheel[3].mu_s[0], 3);
    written(&x->flywheel[3].J_c[0], 6);
    written(&x->flywheel[3].J_s[0], 6);
    written(&x->flywheel[3].J_2c[0], 6);
    written(&x->flywheel[3].J_2s[0], 6);
    written(&x->flywheel[3].t_0[0], 3);
    written(&x->flywheel[3].t_c[0], 3);
    written(&x->flywheel[3].t_s[0], 3);
    written(&x->flywheel[3].spin, 1);
    written(&x->flywheel[3].spin_inv, 1);
    written(&x->flywheel[3].spin_root_inv, 1);
    written(&x->flywheel[4].mu_c[0], 3);
    written(&x->flywheel[4].mu_s[0], 3);
    written(&x->flywheel[4].J_c[0], 6);
    written(&x->flywheel[4].J_s[0], 6);
    written(&x->flywheel[4].J_2c[0], 6);
    written(&x->flywheel[4].J_2s[0], 6);
    written(&x->flywheel[4].t_0[0], 3);
    written(&x->flywheel[4].t_c[0], 3);
    written(&x->flywheel[4].t_s[0], 3);
    written(&x->flywheel[4].spin, 1);
    written(&x->flywheel[4].spin_inv, 1);
    written(&x->flywheel[4].spin_root_inv, 1);
    written(&x->flywheel[5].mu_c[0], 3);
    written(&x->flywheel[5].mu_s[0], 3);
    written(&x->flywheel[5].J_c[0], 6);
    written(&x->flywheel[5].J_s[0], 6);
    written(&x->flywheel[5].J_2c[0], 6);
    written(&x->flywheel[5].J_2s[0], 6);
    written(&x->flywheel[5].t_0[0], 3);
    written(&x->flywheel[5].t_c[0], 3);
    written(&x->flywheel[5].t_s[0], 3);
    written(&x->flywheel[5].spin, 1);
    written(&x->flywheel[5].spin_inv, 1);
    written(&x->flywheel[5].spin_root_inv, 1);
    written(&x->flywheel[6].mu_c[0], 3);
    written(&x->flywheel[6].mu_s[0], 3);
    written(&x->flywheel[6].J_c[0], 6);
    written(&x->flywheel[6].J_s[0], 6);
    written(&x->flywheel[6].J_2c[0], 6);
    written(&x->flywheel[6].J_2s[0], 6);
    written(&x->flywheel[6].t_0[0], 3);
    written(&x->flywheel[6].t_c[0], 3);
    written(&x->flywheel[6].t_s[0], 3);
    written(&x->flywheel[6].spin, 1);
    written(&x->flywheel[6].spin_inv, 1);
    written(&x->flywheel[6].spin_root_inv, 1);
    written(&x->flywheel[7].mu_c[0], 3);
    written(&x->flywheel[7].mu_s[0], 3);
    written(&x->flywheel[7].J_c[0], 6);
    written(&x->flywheel[7].J_s[0], 6);
    written(&x->flywheel[7].J_2c[0], 6);
    written(&x->flywheel[7].J_2s[0], 6);
    written(&x->flywheel[7].t_0[0], 3);
    written(&x->flywheel[7].t_c[0], 3);
    written(&x->flywheel[7].t_s[0], 3);
    written(&x->flywheel[7].spin, 1);
    written(&x->flywheel[7].spin_inv, 1);
    written(&x->flywheel[7].spin_root_inv, 1);
    written(&x->gravity[0], 3);
    written(&x->suspension.stiffness[0][0], 36);
    written(&x->suspension.damping[0][0], 36);
    written(&x->suspension.position[0], 3);
    written(&x->suspension.attitude[0], 4);
}

static void initialised_table(const bench8_table *x)
{
    initialised(&x->mass, 1);
    initialised(&x->mass_inverse, 1);
    initialised(&x->first_moment[0], 3);
    initialised(&x->inertia[0], 6);
    initialised(&x->flywheel[0].mu_c[0], 3);
    initialised(&x->flywheel[0].mu_s[0], 3);
    initialised(&x->flywheel[0].J_c[0], 6);
    initialised(&x->flywheel[0].J_s[0], 6);
    initialised(&x->flywheel[0].J_2c[0], 6);
    initialised(&x->flywheel[0].J_2s[0], 6);
    initialised(&x->flywheel[0].t_0[0], 3);
    initialised(&x->flywheel[0].t_c[0], 3);
    initialised(&x->flywheel[0].t_s[0], 3);
    initialised(&x->flywheel[0].spin, 1);
    initialised(&x->flywheel[0].spin_inv, 1);
    initialised(&x->flywheel[0].spin_root_inv, 1);
    initialised(&x->flywheel[1].mu_c[0], 3);
    initialised(&x->flywheel[1].mu_s[0], 3);
    initialised(&x->flywheel[1].J_c[0], 6);
    initialised(&x->flywheel[1].J_s[0], 6);
    initialised(&x->flywheel[1].J_2c[0], 6);
    initialised(&x->flywheel[1].J_2s[0], 6);
    initialised(&x->flywheel[1].t_0[0], 3);
    initialised(&x->flywheel[1].t_c[0], 3);
    initialised(&x->flywheel[1].t_s[0], 3);
    initialised(&x->flywheel[1].spin, 1);
    initialised(&x->flywheel[1].spin_inv, 1);
    initialised(&x->flywheel[1].spin_root_inv, 1);
    initialised(&x->flywheel[2].mu_c[0], 3);
    initialised(&x->flywheel[2].mu_s[0], 3);
    initialised(&x->flywheel[2].J_c[0], 6);
    initialised(&x->flywheel[2].J_s[0], 6);
    initialised(&x->flywheel[2].J_2c[0], 6);
    initialised(&x->flywheel[2].J_2s[0], 6);
    initialised(&x->flywheel[2].t_0[0], 3);
    initialised(&x->flywheel[2].t_c[0], 3);
    initialised(&x->flywheel[2].t_s[0], 3);
    initialised(&x->flywheel[2].spin, 1);
    initialised(&x->flywheel[2].spin_inv, 1);
    initialised(&x->flywheel[2].spin_root_inv, 1);
    initialised(&x->flywheel[3].mu_c[0], 3);
    initialised(&x->flywheel[3].mu_s[0], 3);
    initialised(&x->flywheel[3].J_c[0], 6);
    initialised(&x->flywheel[3].J_s[0], 6);
    initialised(&x->flywheel[3].J_2c[0], 6);
    initialised(&x->flywheel[3].J_2s[0], 6);
    initialised(&x->flywheel[3].t_0[0], 3);
    initialised(&x->flywheel[3].t_c[0], 3);
    initialised(&x->flywheel[3].t_s[0], 3);
    initialised(&x->flywheel[3].spin, 1);
    initialised(&x->flywheel[3].spin_inv, 1);
    initialised(&x->flywheel[3].spin_root_inv, 1);
    initialised(&x->flywheel[4].mu_c[0], 3);
    initialised(&x->flywheel[4].mu_s[0], 3);
    initialised(&x->flywheel[4].J_c[0], 6);
    initialised(&x->flywheel[4].J_s[0], 6);
    initialised(&x->flywheel[4].J_2c[0], 6);
    initialised(&x->flywheel[4].J_2s[0], 6);
    initialised(&x->flywheel[4].t_0[0], 3);
    initialised(&x->flywheel[4].t_c[0], 3);
    initialised(&x->flywheel[4].t_s[0], 3);
    initialised(&x->flywheel[4].spin, 1);
    initialised(&x->flywheel[4].spin_inv, 1);
    initialised(&x->flywheel[4].spin_root_inv, 1);
    initialised(&x->flywheel[5].mu_c[0], 3);
    initialised(&x->flywheel[5].mu_s[0], 3);
    initialised(&x->flywheel[5].J_c[0], 6);
    initialised(&x->flywheel[5].J_s[0], 6);
    initialised(&x->flywheel[5].J_2c[0], 6);
    initialised(&x->flywheel[5].J_2s[0], 6);
    initialised(&x->flywheel[5].t_0[0], 3);
    initialised(&x->flywheel[5].t_c[0], 3);
    initialised(&x->flywheel[5].t_s[0], 3);
    initialised(&x->flywheel[5].spin, 1);
    initialised(&x->flywheel[5].spin_inv, 1);
    initialised(&x->flywheel[5].spin_root_inv, 1);
    initialised(&x->flywheel[6].mu_c[0], 3);
    initialised(&x->flywheel[6].mu_s[0], 3);
    initialised(&x->flywheel[6].J_c[0], 6);
    initialised(&x->flywheel[6].J_s[0], 6);
    initialised(&x->flywheel[6].J_2c[0], 6);
    initialised(&x->flywheel[6].J_2s[0], 6);
    initialised(&x->flywheel[6].t_0[0], 3);
    initialised(&x->flywheel[6].t_c[0], 3);
    initialised(&x->flywheel[6].t_s[0], 3);
    initialised(&x->flywheel[6].spin, 1);
    initialised(&x->flywheel[6].spin_inv, 1);
    initialised(&x->flywheel[6].spin_root_inv, 1);
    initialised(&x->flywheel[7].mu_c[0], 3);
    initialised(&x->flywheel[7].mu_s[0], 3);
    initialised(&x->flywheel[7].J_c[0], 6);
    initialised(&x->flywheel[7].J_s[0], 6);
    initialised(&x->flywheel[7].J_2c[0], 6);
    initialised(&x->flywheel[7].J_2s[0], 6);
    initialised(&x->flywheel[7].t_0[0], 3);
    initialised(&x->flywheel[7].t_c[0], 3);
    initialised(&x->flywheel[7].t_s[0], 3);
    initialised(&x->flywheel[7].spin, 1);
    initialised(&x->flywheel[7].spin_inv, 1);
    initialised(&x->flywheel[7].spin_root_inv, 1);
    initialised(&x->gravity[0], 3);
    initialised(&x->suspension.stiffness[0][0], 36);
    initialised(&x->suspension.damping[0][0], 36);
    initialised(&x->suspension.position[0], 3);
    initialised(&x->suspension.attitude[0], 4);
}

static void untouched_mount_table(const bench8_mount_table *x)
{
    untouched(&x->flywheel[0].mass, 1);
    untouched(&x->flywheel[0].first_moment[0], 3);
    untouched(&x->flywheel[0].inertia[0], 6);
    untouched(&x->flywheel[0].origin[0], 3);
    untouched(&x->flywheel[0].axes[0], 9);
    untouched(&x->flywheel[1].mass, 1);
    untouched(&x->flywheel[1].first_moment[0], 3);
    untouched(&x->flywheel[1].inertia[0], 6);
    untouched(&x->flywheel[1].origin[0], 3);
    untouched(&x->flywheel[1].axes[0], 9);
    untouched(&x->flywheel[2].mass, 1);
    untouched(&x->flywheel[2].first_moment[0], 3);
    untouched(&x->flywheel[2].inertia[0], 6);
    untouched(&x->flywheel[2].origin[0], 3);
    untouched(&x->flywheel[2].axes[0], 9);
    untouched(&x->flywheel[3].mass, 1);
    untouched(&x->flywheel[3].first_moment[0], 3);
    untouched(&x->flywheel[3].inertia[0], 6);
    untouched(&x->flywheel[3].origin[0], 3);
    untouched(&x->flywheel[3].axes[0], 9);
    untouched(&x->flywheel[4].mass, 1);
    untouched(&x->flywheel[4].first_moment[0], 3);
    untouched(&x->flywheel[4].inertia[0], 6);
    untouched(&x->flywheel[4].origin[0], 3);
    untouched(&x->flywheel[4].axes[0], 9);
    untouched(&x->flywheel[5].mass, 1);
    untouched(&x->flywheel[5].first_moment[0], 3);
    untouched(&x->flywheel[5].inertia[0], 6);
    untouched(&x->flywheel[5].origin[0], 3);
    untouched(&x->flywheel[5].axes[0], 9);
    untouched(&x->flywheel[6].mass, 1);
    untouched(&x->flywheel[6].first_moment[0], 3);
    untouched(&x->flywheel[6].inertia[0], 6);
    untouched(&x->flywheel[6].origin[0], 3);
    untouched(&x->flywheel[6].axes[0], 9);
    untouched(&x->flywheel[7].mass, 1);
    untouched(&x->flywheel[7].first_moment[0], 3);
    untouched(&x->flywheel[7].inertia[0], 6);
    untouched(&x->flywheel[7].origin[0], 3);
    untouched(&x->flywheel[7].axes[0], 9);
}

static void written_mount_table(const bench8_mount_table *x)
{
    written(&x->flywheel[0].mass, 1);
    written(&x->flywheel[0].first_moment[0], 3);
    written(&x->flywheel[0].inertia[0], 6);
    written(&x->flywheel[0].origin[0], 3);
    written(&x->flywheel[0].axes[0], 9);
    written(&x->flywheel[1].mass, 1);
    written(&x->flywheel[1].first_moment[0], 3);
    written(&x->flywheel[1].inertia[0], 6);
    written(&x->flywheel[1].origin[0], 3);
    written(&x->flywheel[1].axes[0], 9);
    written(&x->flywheel[2].mass, 1);
    written(&x->flywheel[2].first_moment[0], 3);
    written(&x->flywheel[2].inertia[0], 6);
    written(&x->flywheel[2].origin[0], 3);
    written(&x->flywheel[2].axes[0], 9);
    written(&x->flywheel[3].mass, 1);
    written(&x->flywheel[3].first_moment[0], 3);
    written(&x->flywheel[3].inertia[0], 6);
    written(&x->flywheel[3].origin[0], 3);
    written(&x->flywheel[3].axes[0], 9);
    written(&x->flywheel[4].mass, 1);
    written(&x->flywheel[4].first_moment[0], 3);
    written(&x->flywheel[4].inertia[0], 6);
    written(&x->flywheel[4].origin[0], 3);
    written(&x->flywheel[4].axes[0], 9);
    written(&x->flywheel[5].mass, 1);
    written(&x->flywheel[5].first_moment[0], 3);
    written(&x->flywheel[5].inertia[0], 6);
    written(&x->flywheel[5].origin[0], 3);
    written(&x->flywheel[5].axes[0], 9);
    written(&x->flywheel[6].mass, 1);
    written(&x->flywheel[6].first_moment[0], 3);
    written(&x->flywheel[6].inertia[0], 6);
    written(&x->flywheel[6].origin[0], 3);
    written(&x->flywheel[6].axes[0], 9);
    written(&x->flywheel[7].mass, 1);
    written(&x->flywheel[7].first_moment[0], 3);
    written(&x->flywheel[7].inertia[0], 6);
    written(&x->flywheel[7].origin[0], 3);
    written(&x->flywheel[7].axes[0], 9);
}

static void initialised_mount_table(const bench8_mount_table *x)
{
    initialised(&x->flywheel[0].mass, 1);
    initialised(&x->flywheel[0].first_moment[0], 3);
    initialised(&x->flywheel[0].inertia[0], 6);
    initialised(&x->flywheel[0].origin[0], 3);
    initialised(&x->flywheel[0].axes[0], 9);
    initialised(&x->flywheel[1].mass, 1);
    initialised(&x->flywheel[1].first_moment[0], 3);
    initialised(&x->flywheel[1].inertia[0], 6);
    initialised(&x->flywheel[1].origin[0], 3);
    initialised(&x->flywheel[1].axes[0], 9);
    initialised(&x->flywheel[2].mass, 1);
    initialised(&x->flywheel[2].first_moment[0], 3);
    initialised(&x->flywheel[2].inertia[0], 6);
    initialised(&x->flywheel[2].origin[0], 3);
    initialised(&x->flywheel[2].axes[0], 9);
    initialised(&x->flywheel[3].mass, 1);
    initialised(&x->flywheel[3].first_moment[0], 3);
    initialised(&x->flywheel[3].inertia[0], 6);
    initialised(&x->flywheel[3].origin[0], 3);
    initialised(&x->flywheel[3].axes[0], 9);
    initialised(&x->flywheel[4].mass, 1);
    initialised(&x->flywheel[4].first_moment[0], 3);
    initialised(&x->flywheel[4].inertia[0], 6);
    initialised(&x->flywheel[4].origin[0], 3);
    initialised(&x->flywheel[4].axes[0], 9);
    initialised(&x->flywheel[5].mass, 1);
    initialised(&x->flywheel[5].first_moment[0], 3);
    initialised(&x->flywheel[5].inertia[0], 6);
    initialised(&x->flywheel[5].origin[0], 3);
    initialised(&x->flywheel[5].axes[0], 9);
    initialised(&x->flywheel[6].mass, 1);
    initialised(&x->flywheel[6].first_moment[0], 3);
    initialised(&x->flywheel[6].inertia[0], 6);
    initialised(&x->flywheel[6].origin[0], 3);
    initialised(&x->flywheel[6].axes[0], 9);
    initialised(&x->flywheel[7].mass, 1);
    initialised(&x->flywheel[7].first_moment[0], 3);
    initialised(&x->flywheel[7].inertia[0], 6);
    initialised(&x->flywheel[7].origin[0], 3);
    initialised(&x->flywheel[7].axes[0], 9);
}

static void written_step_carry(const bench8_step_carry *x)
{
    written(&x->rounding[0], 29);
}

static void initialised_step_carry(const bench8_step_carry *x)
{
    initialised(&x->rounding[0], 29);
}

/* ---- drivers: a function and a set each ---- */

void bench8_eva_normal_forward(void);
void bench8_eva_normal_forward(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, 1.0e4);
    bench8_real V_dot[6];
    const bench8_status status = bench8_forward(&bench8_default, &x, phi_ddot, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
    }
}

void bench8_eva_any_forward(void);
void bench8_eva_any_forward(void)
{
    bench8_state x;
    any_state(&x);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, BENCH8_LARGEST);
    bench8_real V_dot[6];
    const bench8_status status = bench8_forward(&bench8_default, &x, phi_ddot, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
    }
}

void bench8_eva_bits_forward(void);
void bench8_eva_bits_forward(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_real phi_ddot[BENCH8_N];
    all_bits(&phi_ddot[0], 8);
    bench8_real V_dot[6];
    const bench8_status status = bench8_forward(&bench8_default, &x, phi_ddot, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&V_dot[0], 6);
    }
}

void bench8_eva_normal_matrices(void);
void bench8_eva_normal_matrices(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_matrices_result out;
    const bench8_status status = bench8_matrices(&bench8_default, &x, &out);
    if (status < 0) {
        untouched_matrices_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_matrices_result(&out);
    }
}

void bench8_eva_any_matrices(void);
void bench8_eva_any_matrices(void)
{
    bench8_state x;
    any_state(&x);
    bench8_matrices_result out;
    const bench8_status status = bench8_matrices(&bench8_default, &x, &out);
    if (status < 0) {
        untouched_matrices_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_matrices_result(&out);
    }
}

void bench8_eva_bits_matrices(void);
void bench8_eva_bits_matrices(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_matrices_result out;
    const bench8_status status = bench8_matrices(&bench8_default, &x, &out);
    if (status < 0) {
        untouched_matrices_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_matrices_result(&out);
    }
}

void bench8_eva_normal_momentum(void);
void bench8_eva_normal_momentum(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_momentum_result out;
    const bench8_status status = bench8_momentum(&bench8_default, &x, &out);
    if (status < 0) {
        untouched_momentum_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_momentum_result(&out);
    }
}

void bench8_eva_any_momentum(void);
void bench8_eva_any_momentum(void)
{
    bench8_state x;
    any_state(&x);
    bench8_momentum_result out;
    const bench8_status status = bench8_momentum(&bench8_default, &x, &out);
    if (status < 0) {
        untouched_momentum_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_momentum_result(&out);
    }
}

void bench8_eva_bits_momentum(void);
void bench8_eva_bits_momentum(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_momentum_result out;
    const bench8_status status = bench8_momentum(&bench8_default, &x, &out);
    if (status < 0) {
        untouched_momentum_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_momentum_result(&out);
    }
}

void bench8_eva_normal_torque(void);
void bench8_eva_normal_torque(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, 1.0e4);
    bench8_real tau[BENCH8_N];
    const bench8_status status = bench8_torque(&bench8_default, &x, V_dot, phi_ddot, tau);
    if (status < 0) {
        untouched(&tau[0], 8);
    } else {
        Frama_C_show_each_returned(status);
        written(&tau[0], 8);
    }
}

void bench8_eva_any_torque(void);
void bench8_eva_any_torque(void)
{
    bench8_state x;
    any_state(&x);
    bench8_real V_dot[6];
    reals(&V_dot[0], 6, BENCH8_LARGEST);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, BENCH8_LARGEST);
    bench8_real tau[BENCH8_N];
    const bench8_status status = bench8_torque(&bench8_default, &x, V_dot, phi_ddot, tau);
    if (status < 0) {
        untouched(&tau[0], 8);
    } else {
        Frama_C_show_each_returned(status);
        written(&tau[0], 8);
    }
}

void bench8_eva_bits_torque(void);
void bench8_eva_bits_torque(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_real V_dot[6];
    all_bits(&V_dot[0], 6);
    bench8_real phi_ddot[BENCH8_N];
    all_bits(&phi_ddot[0], 8);
    bench8_real tau[BENCH8_N];
    const bench8_status status = bench8_torque(&bench8_default, &x, V_dot, phi_ddot, tau);
    if (status < 0) {
        untouched(&tau[0], 8);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&tau[0], 8);
    }
}

void bench8_eva_normal_coupled(void);
void bench8_eva_normal_coupled(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_real tau[BENCH8_N];
    reals(&tau[0], 8, 100.0);
    int locked[BENCH8_N];
    integers(&locked[0], 8, 0, 1);
    bench8_real V_dot[6];
    bench8_real phi_ddot[BENCH8_N];
    const bench8_status status = bench8_coupled(&bench8_default, &x, tau, locked, V_dot, phi_ddot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
        untouched(&phi_ddot[0], 8);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
        written(&phi_ddot[0], 8);
    }
}

void bench8_eva_any_coupled(void);
void bench8_eva_any_coupled(void)
{
    bench8_state x;
    any_state(&x);
    bench8_real tau[BENCH8_N];
    reals(&tau[0], 8, BENCH8_LARGEST);
    int locked[BENCH8_N];
    integers(&locked[0], 8, INT_MIN, INT_MAX);
    bench8_real V_dot[6];
    bench8_real phi_ddot[BENCH8_N];
    const bench8_status status = bench8_coupled(&bench8_default, &x, tau, locked, V_dot, phi_ddot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
        untouched(&phi_ddot[0], 8);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
        written(&phi_ddot[0], 8);
    }
}

void bench8_eva_bits_coupled(void);
void bench8_eva_bits_coupled(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_real tau[BENCH8_N];
    all_bits(&tau[0], 8);
    int locked[BENCH8_N];
    integers(&locked[0], 8, INT_MIN, INT_MAX);
    bench8_real V_dot[6];
    bench8_real phi_ddot[BENCH8_N];
    const bench8_status status = bench8_coupled(&bench8_default, &x, tau, locked, V_dot, phi_ddot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
        untouched(&phi_ddot[0], 8);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&V_dot[0], 6);
        initialised(&phi_ddot[0], 8);
    }
}

void bench8_eva_normal_step(void);
void bench8_eva_normal_step(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_real tau[BENCH8_N];
    reals(&tau[0], 8, 100.0);
    int locked[BENCH8_N];
    integers(&locked[0], 8, 0, 1);
    bench8_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    bench8_state next;
    const bench8_status status = bench8_step(&bench8_default, &x, tau, locked, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&next);
    }
}

void bench8_eva_any_step(void);
void bench8_eva_any_step(void)
{
    bench8_state x;
    any_state(&x);
    bench8_real tau[BENCH8_N];
    reals(&tau[0], 8, BENCH8_LARGEST);
    int locked[BENCH8_N];
    integers(&locked[0], 8, INT_MIN, INT_MAX);
    bench8_real dt;
    reals(&dt, 1, BENCH8_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    bench8_state next;
    const bench8_status status = bench8_step(&bench8_default, &x, tau, locked, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&next);
    }
}

void bench8_eva_bits_step(void);
void bench8_eva_bits_step(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_real tau[BENCH8_N];
    all_bits(&tau[0], 8);
    int locked[BENCH8_N];
    integers(&locked[0], 8, INT_MIN, INT_MAX);
    bench8_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    bench8_state next;
    const bench8_status status = bench8_step(&bench8_default, &x, tau, locked, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        initialised_state(&next);
    }
}

void bench8_eva_normal_step_driven(void);
void bench8_eva_normal_step_driven(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, 1.0e4);
    bench8_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    bench8_state next;
    const bench8_status status = bench8_step_driven(&bench8_default, &x, phi_ddot, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&next);
    }
}

void bench8_eva_any_step_driven(void);
void bench8_eva_any_step_driven(void)
{
    bench8_state x;
    any_state(&x);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, BENCH8_LARGEST);
    bench8_real dt;
    reals(&dt, 1, BENCH8_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    bench8_state next;
    const bench8_status status = bench8_step_driven(&bench8_default, &x, phi_ddot, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&next);
    }
}

void bench8_eva_bits_step_driven(void);
void bench8_eva_bits_step_driven(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_real phi_ddot[BENCH8_N];
    all_bits(&phi_ddot[0], 8);
    bench8_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    bench8_state next;
    const bench8_status status = bench8_step_driven(&bench8_default, &x, phi_ddot, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        initialised_state(&next);
    }
}

void bench8_eva_normal_wrap(void);
void bench8_eva_normal_wrap(void)
{
    bench8_real phi;
    reals(&phi, 1, 100.0);
    bench8_real wrapped;
    const bench8_status status = bench8_wrap(phi, &wrapped);
    if (status < 0) {
        untouched(&wrapped, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&wrapped, 1);
    }
}

void bench8_eva_any_wrap(void);
void bench8_eva_any_wrap(void)
{
    bench8_real phi;
    reals(&phi, 1, BENCH8_LARGEST);
    bench8_real wrapped;
    const bench8_status status = bench8_wrap(phi, &wrapped);
    if (status < 0) {
        untouched(&wrapped, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&wrapped, 1);
    }
}

void bench8_eva_bits_wrap(void);
void bench8_eva_bits_wrap(void)
{
    bench8_real phi;
    one_of_all(&phi);
    bench8_real wrapped;
    const bench8_status status = bench8_wrap(phi, &wrapped);
    if (status < 0) {
        untouched(&wrapped, 1);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&wrapped, 1);
    }
}

void bench8_eva_normal_phase_of_counts(void);
void bench8_eva_normal_phase_of_counts(void)
{
    int count;
    integers(&count, 1, -1048576, 1048576);
    int per_turn;
    integers(&per_turn, 1, -100000, 100000);
    bench8_real zero;
    reals(&zero, 1, 1.0e3);
    bench8_real phi;
    const bench8_status status = bench8_phase_of_counts(count, per_turn, zero, &phi);
    if (status < 0) {
        untouched(&phi, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi, 1);
    }
}

void bench8_eva_any_phase_of_counts(void);
void bench8_eva_any_phase_of_counts(void)
{
    int count;
    integers(&count, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    bench8_real zero;
    reals(&zero, 1, BENCH8_LARGEST);
    bench8_real phi;
    const bench8_status status = bench8_phase_of_counts(count, per_turn, zero, &phi);
    if (status < 0) {
        untouched(&phi, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi, 1);
    }
}

void bench8_eva_bits_phase_of_counts(void);
void bench8_eva_bits_phase_of_counts(void)
{
    int count;
    integers(&count, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    bench8_real zero;
    one_of_all(&zero);
    bench8_real phi;
    const bench8_status status = bench8_phase_of_counts(count, per_turn, zero, &phi);
    if (status < 0) {
        untouched(&phi, 1);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&phi, 1);
    }
}

void bench8_eva_normal_speed_of_counts(void);
void bench8_eva_normal_speed_of_counts(void)
{
    int moved;
    integers(&moved, 1, -1048576, 1048576);
    int per_turn;
    integers(&per_turn, 1, -100000, 100000);
    bench8_real dt;
    dt = real_in(1.0e-6, 0.001);
    bench8_real phi_dot;
    const bench8_status status = bench8_speed_of_counts(moved, per_turn, dt, &phi_dot);
    if (status < 0) {
        untouched(&phi_dot, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_dot, 1);
    }
}

void bench8_eva_any_speed_of_counts(void);
void bench8_eva_any_speed_of_counts(void)
{
    int moved;
    integers(&moved, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    bench8_real dt;
    reals(&dt, 1, BENCH8_LARGEST);
    bench8_real phi_dot;
    const bench8_status status = bench8_speed_of_counts(moved, per_turn, dt, &phi_dot);
    if (status < 0) {
        untouched(&phi_dot, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_dot, 1);
    }
}

void bench8_eva_bits_speed_of_counts(void);
void bench8_eva_bits_speed_of_counts(void)
{
    int moved;
    integers(&moved, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    bench8_real dt;
    one_of_all(&dt);
    bench8_real phi_dot;
    const bench8_status status = bench8_speed_of_counts(moved, per_turn, dt, &phi_dot);
    if (status < 0) {
        untouched(&phi_dot, 1);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&phi_dot, 1);
    }
}

void bench8_eva_normal_accumulate(void);
void bench8_eva_normal_accumulate(void)
{
    bench8_encoder encoder;
    normal_encoder(&encoder);
    int counter;
    integers(&counter, 1, -1048576, 1048576);
    int bits;
    integers(&bits, 1, 0, 32);
    int per_turn;
    integers(&per_turn, 1, -100000, 100000);
    const bench8_status status = bench8_accumulate(&encoder, counter, bits, per_turn);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written_encoder(&encoder);
    }
}

void bench8_eva_any_accumulate(void);
void bench8_eva_any_accumulate(void)
{
    bench8_encoder encoder;
    any_encoder(&encoder);
    int counter;
    integers(&counter, 1, INT_MIN, INT_MAX);
    int bits;
    integers(&bits, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    const bench8_status status = bench8_accumulate(&encoder, counter, bits, per_turn);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written_encoder(&encoder);
    }
}

void bench8_eva_bits_accumulate(void);
void bench8_eva_bits_accumulate(void)
{
    bench8_encoder encoder;
    bits_encoder(&encoder);
    int counter;
    integers(&counter, 1, INT_MIN, INT_MAX);
    int bits;
    integers(&bits, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    const bench8_status status = bench8_accumulate(&encoder, counter, bits, per_turn);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        initialised_encoder(&encoder);
    }
}

void bench8_eva_normal_forward_jacobian(void);
void bench8_eva_normal_forward_jacobian(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, 1.0e4);
    bench8_forward_jacobian_result out;
    const bench8_status status = bench8_forward_jacobian(&bench8_default, &x, phi_ddot, &out);
    if (status < 0) {
        untouched_forward_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_forward_jacobian_result(&out);
    }
}

void bench8_eva_any_forward_jacobian(void);
void bench8_eva_any_forward_jacobian(void)
{
    bench8_state x;
    any_state(&x);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, BENCH8_LARGEST);
    bench8_forward_jacobian_result out;
    const bench8_status status = bench8_forward_jacobian(&bench8_default, &x, phi_ddot, &out);
    if (status < 0) {
        untouched_forward_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_forward_jacobian_result(&out);
    }
}

void bench8_eva_bits_forward_jacobian(void);
void bench8_eva_bits_forward_jacobian(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_real phi_ddot[BENCH8_N];
    all_bits(&phi_ddot[0], 8);
    bench8_forward_jacobian_result out;
    const bench8_status status = bench8_forward_jacobian(&bench8_default, &x, phi_ddot, &out);
    if (status < 0) {
        untouched_forward_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_forward_jacobian_result(&out);
    }
}

void bench8_eva_normal_coupled_jacobian(void);
void bench8_eva_normal_coupled_jacobian(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_real tau[BENCH8_N];
    reals(&tau[0], 8, 100.0);
    int locked[BENCH8_N];
    integers(&locked[0], 8, 0, 1);
    bench8_coupled_jacobian_result out;
    const bench8_status status = bench8_coupled_jacobian(&bench8_default, &x, tau, locked, &out);
    if (status < 0) {
        untouched_coupled_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_coupled_jacobian_result(&out);
    }
}

void bench8_eva_any_coupled_jacobian(void);
void bench8_eva_any_coupled_jacobian(void)
{
    bench8_state x;
    any_state(&x);
    bench8_real tau[BENCH8_N];
    reals(&tau[0], 8, BENCH8_LARGEST);
    int locked[BENCH8_N];
    integers(&locked[0], 8, INT_MIN, INT_MAX);
    bench8_coupled_jacobian_result out;
    const bench8_status status = bench8_coupled_jacobian(&bench8_default, &x, tau, locked, &out);
    if (status < 0) {
        untouched_coupled_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_coupled_jacobian_result(&out);
    }
}

void bench8_eva_bits_coupled_jacobian(void);
void bench8_eva_bits_coupled_jacobian(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_real tau[BENCH8_N];
    all_bits(&tau[0], 8);
    int locked[BENCH8_N];
    integers(&locked[0], 8, INT_MIN, INT_MAX);
    bench8_coupled_jacobian_result out;
    const bench8_status status = bench8_coupled_jacobian(&bench8_default, &x, tau, locked, &out);
    if (status < 0) {
        untouched_coupled_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_coupled_jacobian_result(&out);
    }
}

void bench8_eva_normal_inverse(void);
void bench8_eva_normal_inverse(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    bench8_inverse_options options;
    normal_inverse_options(&options);
    bench8_inverse_result out;
    const bench8_status status = bench8_inverse(&bench8_default, &x, V_dot, &options, &out);
    if (status < 0) {
        untouched_inverse_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_inverse_result(&out);
    }
}

void bench8_eva_any_inverse(void);
void bench8_eva_any_inverse(void)
{
    bench8_state x;
    any_state(&x);
    bench8_real V_dot[6];
    reals(&V_dot[0], 6, BENCH8_LARGEST);
    bench8_inverse_options options;
    any_inverse_options(&options);
    bench8_inverse_result out;
    const bench8_status status = bench8_inverse(&bench8_default, &x, V_dot, &options, &out);
    if (status < 0) {
        untouched_inverse_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_inverse_result(&out);
    }
}

void bench8_eva_bits_inverse(void);
void bench8_eva_bits_inverse(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_real V_dot[6];
    all_bits(&V_dot[0], 6);
    bench8_inverse_options options;
    bits_inverse_options(&options);
    bench8_inverse_result out;
    const bench8_status status = bench8_inverse(&bench8_default, &x, V_dot, &options, &out);
    if (status < 0) {
        untouched_inverse_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_inverse_result(&out);
    }
}

void bench8_eva_normal_inverse_fast(void);
void bench8_eva_normal_inverse_fast(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    bench8_inverse_options options;
    normal_inverse_options(&options);
    bench8_real phi_ddot[BENCH8_N];
    const bench8_status status = bench8_inverse_fast(&bench8_default, &x, V_dot, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 8);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_ddot[0], 8);
    }
}

void bench8_eva_any_inverse_fast(void);
void bench8_eva_any_inverse_fast(void)
{
    bench8_state x;
    any_state(&x);
    bench8_real V_dot[6];
    reals(&V_dot[0], 6, BENCH8_LARGEST);
    bench8_inverse_options options;
    any_inverse_options(&options);
    bench8_real phi_ddot[BENCH8_N];
    const bench8_status status = bench8_inverse_fast(&bench8_default, &x, V_dot, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 8);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_ddot[0], 8);
    }
}

void bench8_eva_bits_inverse_fast(void);
void bench8_eva_bits_inverse_fast(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_real V_dot[6];
    all_bits(&V_dot[0], 6);
    bench8_inverse_options options;
    bits_inverse_options(&options);
    bench8_real phi_ddot[BENCH8_N];
    const bench8_status status = bench8_inverse_fast(&bench8_default, &x, V_dot, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 8);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&phi_ddot[0], 8);
    }
}

void bench8_eva_normal_quaternion(void);
void bench8_eva_normal_quaternion(void)
{
    bench8_real angles[3];
    reals(&angles[0], 3, 7.0);
    bench8_real attitude[4];
    const bench8_status status = bench8_quaternion(angles, attitude);
    if (status < 0) {
        untouched(&attitude[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&attitude[0], 4);
    }
}

void bench8_eva_any_quaternion(void);
void bench8_eva_any_quaternion(void)
{
    bench8_real angles[3];
    reals(&angles[0], 3, BENCH8_LARGEST);
    bench8_real attitude[4];
    const bench8_status status = bench8_quaternion(angles, attitude);
    if (status < 0) {
        untouched(&attitude[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&attitude[0], 4);
    }
}

void bench8_eva_bits_quaternion(void);
void bench8_eva_bits_quaternion(void)
{
    bench8_real angles[3];
    all_bits(&angles[0], 3);
    bench8_real attitude[4];
    const bench8_status status = bench8_quaternion(angles, attitude);
    if (status < 0) {
        untouched(&attitude[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&attitude[0], 4);
    }
}

void bench8_eva_normal_state_from_coordinates(void);
void bench8_eva_normal_state_from_coordinates(void)
{
    bench8_real position[3];
    reals(&position[0], 3, 100.0);
    bench8_real angles[3];
    reals(&angles[0], 3, 7.0);
    bench8_real q_dot[6];
    reals(&q_dot[0], 6, 20.0);
    bench8_real q_ddot[6];
    reals(&q_ddot[0], 6, 1.0e3);
    bench8_state x;
    normal_state(&x);
    bench8_real V_dot[6];
    const bench8_status status = bench8_state_from_coordinates(position, angles, q_dot, q_ddot, &x, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&x);
        written(&V_dot[0], 6);
    }
}

void bench8_eva_any_state_from_coordinates(void);
void bench8_eva_any_state_from_coordinates(void)
{
    bench8_real position[3];
    reals(&position[0], 3, BENCH8_LARGEST);
    bench8_real angles[3];
    reals(&angles[0], 3, BENCH8_LARGEST);
    bench8_real q_dot[6];
    reals(&q_dot[0], 6, BENCH8_LARGEST);
    bench8_real q_ddot[6];
    reals(&q_ddot[0], 6, BENCH8_LARGEST);
    bench8_state x;
    any_state(&x);
    bench8_real V_dot[6];
    const bench8_status status = bench8_state_from_coordinates(position, angles, q_dot, q_ddot, &x, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&x);
        written(&V_dot[0], 6);
    }
}

void bench8_eva_bits_state_from_coordinates(void);
void bench8_eva_bits_state_from_coordinates(void)
{
    bench8_real position[3];
    all_bits(&position[0], 3);
    bench8_real angles[3];
    all_bits(&angles[0], 3);
    bench8_real q_dot[6];
    all_bits(&q_dot[0], 6);
    bench8_real q_ddot[6];
    all_bits(&q_ddot[0], 6);
    bench8_state x;
    bits_state(&x);
    bench8_real V_dot[6];
    const bench8_status status = bench8_state_from_coordinates(position, angles, q_dot, q_ddot, &x, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        initialised_state(&x);
        initialised(&V_dot[0], 6);
    }
}

void bench8_eva_normal_generalized(void);
void bench8_eva_normal_generalized(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_real angles[3];
    reals(&angles[0], 3, 7.0);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, 1.0e4);
    bench8_generalized_result out;
    const bench8_status status = bench8_generalized(&bench8_default, &x, angles, phi_ddot, &out);
    if (status < 0) {
        untouched_generalized_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_generalized_result(&out);
    }
}

void bench8_eva_any_generalized(void);
void bench8_eva_any_generalized(void)
{
    bench8_state x;
    any_state(&x);
    bench8_real angles[3];
    reals(&angles[0], 3, BENCH8_LARGEST);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, BENCH8_LARGEST);
    bench8_generalized_result out;
    const bench8_status status = bench8_generalized(&bench8_default, &x, angles, phi_ddot, &out);
    if (status < 0) {
        untouched_generalized_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_generalized_result(&out);
    }
}

void bench8_eva_bits_generalized(void);
void bench8_eva_bits_generalized(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_real angles[3];
    all_bits(&angles[0], 3);
    bench8_real phi_ddot[BENCH8_N];
    all_bits(&phi_ddot[0], 8);
    bench8_generalized_result out;
    const bench8_status status = bench8_generalized(&bench8_default, &x, angles, phi_ddot, &out);
    if (status < 0) {
        untouched_generalized_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_generalized_result(&out);
    }
}

void bench8_eva_normal_prepare(void);
void bench8_eva_normal_prepare(void)
{
    bench8_parameters parameters;
    normal_parameters(&parameters);
    bench8_table table = bench8_default;
    const bench8_status status = bench8_prepare(&parameters, &table);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written_table(&table);
    }
}

void bench8_eva_any_prepare(void);
void bench8_eva_any_prepare(void)
{
    bench8_parameters parameters;
    any_parameters(&parameters);
    bench8_table table = bench8_default;
    const bench8_status status = bench8_prepare(&parameters, &table);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written_table(&table);
    }
}

void bench8_eva_bits_prepare(void);
void bench8_eva_bits_prepare(void)
{
    bench8_parameters parameters;
    bits_parameters(&parameters);
    bench8_table table = bench8_default;
    const bench8_status status = bench8_prepare(&parameters, &table);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        initialised_table(&table);
    }
}

void bench8_eva_normal_mounts(void);
void bench8_eva_normal_mounts(void)
{
    bench8_mount_table mounting;
    (void)bench8_prepare_mounts(&bench8_default_parameters, &mounting);
    bench8_state x;
    normal_state(&x);
    bench8_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, 1.0e4);
    bench8_real mount_wrench[48];
    const bench8_status status = bench8_mounts(&bench8_default, &mounting, &x, V_dot, phi_ddot, mount_wrench);
    if (status < 0) {
        untouched(&mount_wrench[0], 48);
    } else {
        Frama_C_show_each_returned(status);
        written(&mount_wrench[0], 48);
    }
}

void bench8_eva_any_mounts(void);
void bench8_eva_any_mounts(void)
{
    bench8_mount_table mounting;
    (void)bench8_prepare_mounts(&bench8_default_parameters, &mounting);
    bench8_state x;
    any_state(&x);
    bench8_real V_dot[6];
    reals(&V_dot[0], 6, BENCH8_LARGEST);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, BENCH8_LARGEST);
    bench8_real mount_wrench[48];
    const bench8_status status = bench8_mounts(&bench8_default, &mounting, &x, V_dot, phi_ddot, mount_wrench);
    if (status < 0) {
        untouched(&mount_wrench[0], 48);
    } else {
        Frama_C_show_each_returned(status);
        written(&mount_wrench[0], 48);
    }
}

void bench8_eva_bits_mounts(void);
void bench8_eva_bits_mounts(void)
{
    bench8_mount_table mounting;
    (void)bench8_prepare_mounts(&bench8_default_parameters, &mounting);
    bench8_state x;
    bits_state(&x);
    bench8_real V_dot[6];
    all_bits(&V_dot[0], 6);
    bench8_real phi_ddot[BENCH8_N];
    all_bits(&phi_ddot[0], 8);
    bench8_real mount_wrench[48];
    const bench8_status status = bench8_mounts(&bench8_default, &mounting, &x, V_dot, phi_ddot, mount_wrench);
    if (status < 0) {
        untouched(&mount_wrench[0], 48);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&mount_wrench[0], 48);
    }
}

void bench8_eva_normal_prepare_mounts(void);
void bench8_eva_normal_prepare_mounts(void)
{
    bench8_parameters parameters;
    normal_parameters(&parameters);
    bench8_mount_table mounting;
    const bench8_status status = bench8_prepare_mounts(&parameters, &mounting);
    if (status < 0) {
        untouched_mount_table(&mounting);
    } else {
        Frama_C_show_each_returned(status);
        written_mount_table(&mounting);
    }
}

void bench8_eva_any_prepare_mounts(void);
void bench8_eva_any_prepare_mounts(void)
{
    bench8_parameters parameters;
    any_parameters(&parameters);
    bench8_mount_table mounting;
    const bench8_status status = bench8_prepare_mounts(&parameters, &mounting);
    if (status < 0) {
        untouched_mount_table(&mounting);
    } else {
        Frama_C_show_each_returned(status);
        written_mount_table(&mounting);
    }
}

void bench8_eva_bits_prepare_mounts(void);
void bench8_eva_bits_prepare_mounts(void)
{
    bench8_parameters parameters;
    bits_parameters(&parameters);
    bench8_mount_table mounting;
    const bench8_status status = bench8_prepare_mounts(&parameters, &mounting);
    if (status < 0) {
        untouched_mount_table(&mounting);
    } else {
        Frama_C_show_each_returned(status);
        initialised_mount_table(&mounting);
    }
}

void bench8_eva_normal_step_carried(void);
void bench8_eva_normal_step_carried(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_real tau[BENCH8_N];
    reals(&tau[0], 8, 100.0);
    int locked[BENCH8_N];
    integers(&locked[0], 8, 0, 1);
    bench8_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    bench8_step_carry carry;
    normal_step_carry(&carry);
    bench8_state next;
    const bench8_status status = bench8_step_carried(&bench8_default, &x, tau, locked, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_step_carry(&carry);
        written_state(&next);
    }
}

void bench8_eva_any_step_carried(void);
void bench8_eva_any_step_carried(void)
{
    bench8_state x;
    any_state(&x);
    bench8_real tau[BENCH8_N];
    reals(&tau[0], 8, BENCH8_LARGEST);
    int locked[BENCH8_N];
    integers(&locked[0], 8, INT_MIN, INT_MAX);
    bench8_real dt;
    reals(&dt, 1, BENCH8_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    bench8_step_carry carry;
    any_step_carry(&carry);
    bench8_state next;
    const bench8_status status = bench8_step_carried(&bench8_default, &x, tau, locked, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_step_carry(&carry);
        written_state(&next);
    }
}

void bench8_eva_bits_step_carried(void);
void bench8_eva_bits_step_carried(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_real tau[BENCH8_N];
    all_bits(&tau[0], 8);
    int locked[BENCH8_N];
    integers(&locked[0], 8, INT_MIN, INT_MAX);
    bench8_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    bench8_step_carry carry;
    bits_step_carry(&carry);
    bench8_state next;
    const bench8_status status = bench8_step_carried(&bench8_default, &x, tau, locked, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        initialised_step_carry(&carry);
        initialised_state(&next);
    }
}

void bench8_eva_normal_step_driven_carried(void);
void bench8_eva_normal_step_driven_carried(void)
{
    bench8_state x;
    normal_state(&x);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, 1.0e4);
    bench8_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    bench8_step_carry carry;
    normal_step_carry(&carry);
    bench8_state next;
    const bench8_status status = bench8_step_driven_carried(&bench8_default, &x, phi_ddot, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_step_carry(&carry);
        written_state(&next);
    }
}

void bench8_eva_any_step_driven_carried(void);
void bench8_eva_any_step_driven_carried(void)
{
    bench8_state x;
    any_state(&x);
    bench8_real phi_ddot[BENCH8_N];
    reals(&phi_ddot[0], 8, BENCH8_LARGEST);
    bench8_real dt;
    reals(&dt, 1, BENCH8_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    bench8_step_carry carry;
    any_step_carry(&carry);
    bench8_state next;
    const bench8_status status = bench8_step_driven_carried(&bench8_default, &x, phi_ddot, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_step_carry(&carry);
        written_state(&next);
    }
}

void bench8_eva_bits_step_driven_carried(void);
void bench8_eva_bits_step_driven_carried(void)
{
    bench8_state x;
    bits_state(&x);
    bench8_real phi_ddot[BENCH8_N];
    all_bits(&phi_ddot[0], 8);
    bench8_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    bench8_step_carry carry;
    bits_step_carry(&carry);
    bench8_state next;
    const bench8_status status = bench8_step_driven_carried(&bench8_default, &x, phi_ddot, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        initialised_step_carry(&carry);
        initialised_state(&next);
    }
}

void bench8_eva_routine_sincos(void);
void bench8_eva_routine_sincos(void)
{
    bench8_real x;
    one_of_all(&x);
    bench8_real sine;
    bench8_real cosine;
    bench8_sincos(x, &sine, &cosine);
    Frama_C_show_each_returned(0);
}

void bench8_eva_routine_sqrt(void);
void bench8_eva_routine_sqrt(void)
{
    bench8_real x;
    one_of_all(&x);
    (void)bench8_sqrt(x);
    Frama_C_show_each_returned(0);
}

void bench8_eva_routine_atan2(void);
void bench8_eva_routine_atan2(void)
{
    bench8_real y;
    one_of_all(&y);
    bench8_real x;
    one_of_all(&x);
    (void)bench8_atan2(y, x);
    Frama_C_show_each_returned(0);
}

void bench8_eva_routine_check_state(void);
void bench8_eva_routine_check_state(void)
{
    bench8_state x;
    reals(x.position, 3, BENCH8_LARGEST);
    reals(x.attitude, 4, BENCH8_LARGEST);
    reals(x.V, 6, BENCH8_LARGEST);
    reals(x.phi, 8, BENCH8_LARGEST);
    reals(x.phi_dot, 8, BENCH8_LARGEST);
    int beyond = 0;
    if (beyond == 0) { beyond = one_beyond(x.position, 3, 0x1.e848000000001p+19); }
    if (beyond == 0) { beyond = one_beyond(x.attitude, 4, 0x1.0000000000001p+1); }
    if (beyond == 0) { beyond = one_beyond(x.V, 6, 0x1.86a0000000001p+16); }
    if (beyond == 0) { beyond = one_beyond(x.V, 3, 0x1.3880000000001p+13); }
    if (beyond == 0) { beyond = one_beyond(x.phi, 8, 0x1.312d000000001p+23); }
    if (beyond == 0) { beyond = one_beyond(x.phi_dot, 8, 0x1.86a0000000001p+16); }
    if (beyond == 0) { reals(x.attitude, 4, 0.4993); }
    const bench8_status status = bench8_check_state(&x);
    Frama_C_show_each_returned(status);
    /*@ check status < 0; */
}

void bench8_eva_routine_check_motion(void);
void bench8_eva_routine_check_motion(void)
{
    bench8_state x;
    reals(x.position, 3, BENCH8_LARGEST);
    reals(x.attitude, 4, BENCH8_LARGEST);
    reals(x.V, 6, BENCH8_LARGEST);
    reals(x.phi, 8, BENCH8_LARGEST);
    reals(x.phi_dot, 8, BENCH8_LARGEST);
    bench8_real values[BENCH8_N];
    bench8_real limit, above;
    reals(values, 8, BENCH8_LARGEST);
    switch (Frama_C_interval(0, 2)) {
    case 0: limit = BENCH8_MAX_ACCELERATION; above = 0x1.dcd6500000001p+29; break;
    case 1: limit = BENCH8_MAX_WRENCH; above = 0x1.dcd6500000001p+29; break;
    default: limit = BENCH8_MAX_SPEED; above = 0x1.86a0000000001p+16; break;
    }
    int beyond = 0;
    if (beyond == 0) { beyond = one_beyond(x.position, 3, 0x1.e848000000001p+19); }
    if (beyond == 0) { beyond = one_beyond(x.attitude, 4, 0x1.0000000000001p+1); }
    if (beyond == 0) { beyond = one_beyond(x.V, 6, 0x1.86a0000000001p+16); }
    if (beyond == 0) { beyond = one_beyond(x.V, 3, 0x1.3880000000001p+13); }
    if (beyond == 0) { beyond = one_beyond(x.phi, 8, 0x1.312d000000001p+23); }
    if (beyond == 0) { beyond = one_beyond(x.phi_dot, 8, 0x1.86a0000000001p+16); }
    if (beyond == 0) { beyond = one_beyond(values, 8, above); }
    if (beyond == 0) { reals(x.attitude, 4, 0.4993); }
    const bench8_status status = bench8_check_motion(&x, values, limit);
    Frama_C_show_each_returned(status);
    /*@ check status < 0; */
}
#endif
