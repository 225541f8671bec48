/* sat4_eva.c: drivers of Frama-C Eva for the stand "sat4": what is proved of sat4.c. Run by sat4_eva.sh.
 * mahovik 0.1.0; structure f28a1ef8, physics e77ec5a4. Generated: change the stand file instead.
 *
 * Only Frama-C reads this file: for compilers it is empty. A driver calls one function with all inputs of a set at once:
 *   normal   magnitudes of ordinary use: the numbers in the driver
 *   any      every finite number, every integer: what the checks of the function let through is all it computes with
 *   bits     every bit pattern: NaN and infinities as well
 * normal, any: Eva shows that no operation is undefined (index, uninitialised read, integer overflow, division by
 * zero) and that no real becomes infinite or NaN on the way, but in the sums of the checks; of the results, that they are written and finite where
 * the status is not negative, and untouched where it is. bits, with -warn-special-float none: the same, but nothing of
 * finiteness, for Eva 25 lets NaN pass a comparison that C does not. */
#include "../sat4.h"

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
static void sat4_sincos(sat4_real x, sat4_real *restrict sine, sat4_real *restrict cosine);

/*@
    requires -10000000.0 <= x[0] <= 10000000.0;
    requires -10000000.0 <= x[1] <= 10000000.0;
    requires -10000000.0 <= x[2] <= 10000000.0;
    requires -10000000.0 <= x[3] <= 10000000.0;
    assigns sine[0 .. 3], cosine[0 .. 3] \from x[0 .. 3];
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
*/
static void sat4_sincos_each(const sat4_real *x, sat4_real *restrict sine,
    sat4_real *restrict cosine);

__PUSH_FC_STDLIB
/*@ requires x >= 0.0;
    assigns \result \from x; */
static sat4_real sat4_sqrt(sat4_real x);
__POP_FC_STDLIB

/* Checks have a quick way by sums of squares, of which intervals do not see that each number is within its limit. For the
 * sets normal and any they are what is said here; drivers of their own show it of their bodies, of all finite arguments:
 * with one number beyond its limit, or a quaternion without a large component, they refuse. */

#ifndef SAT4_EVA_BODIES  /* these drivers must not rest on what they show */
/*@ assigns \result \from *x;
    ensures (\result == 0
        && -SAT4_MAX_POSITION <= x->position[0] <= SAT4_MAX_POSITION
        && -SAT4_MAX_POSITION <= x->position[1] <= SAT4_MAX_POSITION
        && -SAT4_MAX_POSITION <= x->position[2] <= SAT4_MAX_POSITION
        && -2.0 <= x->attitude[0] <= 2.0
        && -2.0 <= x->attitude[1] <= 2.0
        && -2.0 <= x->attitude[2] <= 2.0
        && -2.0 <= x->attitude[3] <= 2.0
        && -SAT4_MAX_SPEED <= x->V[0] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->V[1] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->V[2] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->V[3] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->V[4] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->V[5] <= SAT4_MAX_SPEED
        && -SAT4_MAX_VELOCITY <= x->V[0] <= SAT4_MAX_VELOCITY
        && -SAT4_MAX_VELOCITY <= x->V[1] <= SAT4_MAX_VELOCITY
        && -SAT4_MAX_VELOCITY <= x->V[2] <= SAT4_MAX_VELOCITY
        && -SAT4_MAX_PHASE <= x->phi[0] <= SAT4_MAX_PHASE
        && -SAT4_MAX_PHASE <= x->phi[1] <= SAT4_MAX_PHASE
        && -SAT4_MAX_PHASE <= x->phi[2] <= SAT4_MAX_PHASE
        && -SAT4_MAX_PHASE <= x->phi[3] <= SAT4_MAX_PHASE
        && -SAT4_MAX_SPEED <= x->phi_dot[0] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->phi_dot[1] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->phi_dot[2] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->phi_dot[3] <= SAT4_MAX_SPEED
        && (x->attitude[0] >= 0.4992 || x->attitude[0] <= -0.4992 || x->attitude[1] >= 0.4992 || x->attitude[1] <= -0.4992 || x->attitude[2] >= 0.4992 || x->attitude[2] <= -0.4992 || x->attitude[3] >= 0.4992 || x->attitude[3] <= -0.4992)
        ) || \result < 0; */
static sat4_status sat4_check_state(const sat4_state *x);

/*@ assigns \result \from *x, values[0 .. 3], limit;
    ensures (\result == 0
        && -SAT4_MAX_POSITION <= x->position[0] <= SAT4_MAX_POSITION
        && -SAT4_MAX_POSITION <= x->position[1] <= SAT4_MAX_POSITION
        && -SAT4_MAX_POSITION <= x->position[2] <= SAT4_MAX_POSITION
        && -2.0 <= x->attitude[0] <= 2.0
        && -2.0 <= x->attitude[1] <= 2.0
        && -2.0 <= x->attitude[2] <= 2.0
        && -2.0 <= x->attitude[3] <= 2.0
        && -SAT4_MAX_SPEED <= x->V[0] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->V[1] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->V[2] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->V[3] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->V[4] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->V[5] <= SAT4_MAX_SPEED
        && -SAT4_MAX_VELOCITY <= x->V[0] <= SAT4_MAX_VELOCITY
        && -SAT4_MAX_VELOCITY <= x->V[1] <= SAT4_MAX_VELOCITY
        && -SAT4_MAX_VELOCITY <= x->V[2] <= SAT4_MAX_VELOCITY
        && -SAT4_MAX_PHASE <= x->phi[0] <= SAT4_MAX_PHASE
        && -SAT4_MAX_PHASE <= x->phi[1] <= SAT4_MAX_PHASE
        && -SAT4_MAX_PHASE <= x->phi[2] <= SAT4_MAX_PHASE
        && -SAT4_MAX_PHASE <= x->phi[3] <= SAT4_MAX_PHASE
        && -SAT4_MAX_SPEED <= x->phi_dot[0] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->phi_dot[1] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->phi_dot[2] <= SAT4_MAX_SPEED
        && -SAT4_MAX_SPEED <= x->phi_dot[3] <= SAT4_MAX_SPEED
        && -limit <= values[0] <= limit
        && -limit <= values[1] <= limit
        && -limit <= values[2] <= limit
        && -limit <= values[3] <= limit
        && (x->attitude[0] >= 0.4992 || x->attitude[0] <= -0.4992 || x->attitude[1] >= 0.4992 || x->attitude[1] <= -0.4992 || x->attitude[2] >= 0.4992 || x->attitude[2] <= -0.4992 || x->attitude[3] >= 0.4992 || x->attitude[3] <= -0.4992)
        ) || \result < 0; */
static sat4_status sat4_check_motion(const sat4_state *x, const sat4_real values[SAT4_N], sat4_real limit);

#endif

#include "../sat4.c"

/* ---- sets of numbers ---- */

static sat4_real real_in(sat4_real low, sat4_real high)
{
    return Frama_C_double_interval(low, high);
}

static void reals(sat4_real *x, int count, sat4_real size)
{
    for (int i = 0; i < count; ++i) { x[i] = real_in(-size, size); }
}

static volatile sat4_real any_bits;  /* Eva: each read may give every bit pattern */

static void all_bits(sat4_real *x, int count)
{
    for (int i = 0; i < count; ++i) { x[i] = any_bits; }
}

static void not_finite(sat4_real *x)
{
    const sat4_real zero = 0.0;
    switch (Frama_C_interval(0, 2)) {
    case 0: *x = 1.0 / zero; break;
    case 1: *x = -1.0 / zero; break;
    default: *x = zero / zero; break;
    }
}

/* One number of any bits, finite numbers apart from the others. */
static void one_of_all(sat4_real *x)
{
    if (Frama_C_interval(0, 1) == 0) {
        not_finite(x);
    } else {
        *x = real_in(-SAT4_LARGEST, SAT4_LARGEST);
    }
}

static void integers(int *x, int count, int low, int high)
{
    for (int i = 0; i < count; ++i) { x[i] = Frama_C_interval(low, high); }
}

/* A number within one part in a hundred of another. */
static sat4_real near(sat4_real x)
{
    const sat4_real a = x * 0.99;
    const sat4_real b = x * 1.01;
    return a <= b ? real_in(a, b) : real_in(b, a);
}

static void about(sat4_real *x, const sat4_real *middle, int count)
{
    for (int i = 0; i < count; ++i) { x[i] = near(middle[i]); }
}

/* A quaternion. Where the sum of four squares is at least 0.998001, one of them is at least a quarter of that: so one
 * component is at least 0.499 in magnitude. Which, and its sign, are eight cases; all others are refused by
 * the checks, which the case without a large component shows. */
static void quaternion(sat4_real q[4], sat4_real size)
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
static int one_beyond(sat4_real *x, int count, sat4_real above)
{
    for (int i = 0; i < count; ++i) {
        if (Frama_C_interval(0, 1) == 0) {
            x[i] = (Frama_C_interval(0, 1) == 0) ? real_in(above, SAT4_LARGEST) : real_in(-SAT4_LARGEST, -above);
            return 1;
        }
    }
    return 0;
}

/* ---- what is asserted of results ---- */

static void written(const sat4_real *x, int count)
{
    for (int i = 0; i < count; ++i) {
        /*@ check \initialized(&x[i]) && \is_finite(x[i]); */
    }
}

static void initialised(const sat4_real *x, int count)
{
    for (int i = 0; i < count; ++i) {
        /*@ check \initialized(&x[i]); */
    }
}

static void untouched(const sat4_real *x, int count)
{
    for (int i = 0; i < count; ++i) {
        /*@ check !\initialized(&x[i]); */
    }
}

/* ---- whole structs ---- */

static void normal_state(sat4_state *x)
{
    reals(&x->position[0], 3, 100.0);
    quaternion(x->attitude, 2.0);
    reals(&x->V[0], 6, 20.0);
    reals(&x->phi[0], 4, 100.0);
    reals(&x->phi_dot[0], 4, 1.0e3);
}

static void any_state(sat4_state *x)
{
    reals(&x->position[0], 3, SAT4_LARGEST);
    quaternion(x->attitude, SAT4_LARGEST);
    reals(&x->V[0], 6, SAT4_LARGEST);
    reals(&x->phi[0], 4, SAT4_LARGEST);
    reals(&x->phi_dot[0], 4, SAT4_LARGEST);
}

static void bits_state(sat4_state *x)
{
    all_bits(&x->position[0], 3);
    all_bits(&x->attitude[0], 4);
    all_bits(&x->V[0], 6);
    all_bits(&x->phi[0], 4);
    all_bits(&x->phi_dot[0], 4);
}

static void normal_encoder(sat4_encoder *x)
{
    integers(&x->counter, 1, -1048576, 1048576);
    integers(&x->place, 1, -1048576, 1048576);
    integers(&x->moved, 1, -1048576, 1048576);
}

static void any_encoder(sat4_encoder *x)
{
    integers(&x->counter, 1, INT_MIN, INT_MAX);
    integers(&x->place, 1, INT_MIN, INT_MAX);
    integers(&x->moved, 1, INT_MIN, INT_MAX);
}

static void bits_encoder(sat4_encoder *x)
{
    integers(&x->counter, 1, INT_MIN, INT_MAX);
    integers(&x->place, 1, INT_MIN, INT_MAX);
    integers(&x->moved, 1, INT_MIN, INT_MAX);
}

static void normal_inverse_options(sat4_inverse_options *x)
{
    about(&x->weight[0], &sat4_default_options.weight[0], 4);
    about(&x->limit[0], &sat4_default_options.limit[0], 4);
    about(&x->most[0], &sat4_default_options.most[0], 4);
    about(&x->motor_torque[0], &sat4_default_options.motor_torque[0], 4);
    about(&x->motor_speed[0], &sat4_default_options.motor_speed[0], 4);
    about(&x->motor_viscous[0], &sat4_default_options.motor_viscous[0], 4);
    about(&x->motor_coulomb[0], &sat4_default_options.motor_coulomb[0], 4);
    about(&x->motor_coulomb_speed[0], &sat4_default_options.motor_coulomb_speed[0], 4);
    about(&x->near_singular, &sat4_default_options.near_singular, 1);
    about(&x->damping, &sat4_default_options.damping, 1);
    integers(&x->use_pointing[0], 3, -1048576, 1048576);
    about(&x->motor_power[0], &sat4_default_options.motor_power[0], 4);
    about(&x->target_speed[0], &sat4_default_options.target_speed[0], 4);
    about(&x->target_rate, &sat4_default_options.target_rate, 1);
    about(&x->avoid_speed, &sat4_default_options.avoid_speed, 1);
    integers(&x->keep_direction, 1, -1048576, 1048576);
}

static void any_inverse_options(sat4_inverse_options *x)
{
    reals(&x->weight[0], 4, SAT4_LARGEST);
    reals(&x->limit[0], 4, SAT4_LARGEST);
    reals(&x->most[0], 4, SAT4_LARGEST);
    reals(&x->motor_torque[0], 4, SAT4_LARGEST);
    reals(&x->motor_speed[0], 4, SAT4_LARGEST);
    reals(&x->motor_viscous[0], 4, SAT4_LARGEST);
    reals(&x->motor_coulomb[0], 4, SAT4_LARGEST);
    reals(&x->motor_coulomb_speed[0], 4, SAT4_LARGEST);
    reals(&x->near_singular, 1, SAT4_LARGEST);
    reals(&x->damping, 1, SAT4_LARGEST);
    integers(&x->use_pointing[0], 3, INT_MIN, INT_MAX);
    reals(&x->motor_power[0], 4, SAT4_LARGEST);
    reals(&x->target_speed[0], 4, SAT4_LARGEST);
    reals(&x->target_rate, 1, SAT4_LARGEST);
    reals(&x->avoid_speed, 1, SAT4_LARGEST);
    integers(&x->keep_direction, 1, INT_MIN, INT_MAX);
}

static void bits_inverse_options(sat4_inverse_options *x)
{
    all_bits(&x->weight[0], 4);
    all_bits(&x->limit[0], 4);
    all_bits(&x->most[0], 4);
    all_bits(&x->motor_torque[0], 4);
    all_bits(&x->motor_speed[0], 4);
    all_bits(&x->motor_viscous[0], 4);
    all_bits(&x->motor_coulomb[0], 4);
    all_bits(&x->motor_coulomb_speed[0], 4);
    one_of_all(&x->near_singular);
    one_of_all(&x->damping);
    integers(&x->use_pointing[0], 3, INT_MIN, INT_MAX);
    all_bits(&x->motor_power[0], 4);
    all_bits(&x->target_speed[0], 4);
    one_of_all(&x->target_rate);
    one_of_all(&x->avoid_speed);
    integers(&x->keep_direction, 1, INT_MIN, INT_MAX);
}

static void normal_parameters(sat4_parameters *x)
{
    about(&x->carrier.mass, &sat4_default_parameters.carrier.mass, 1);
    about(&x->carrier.center_of_mass[0], &sat4_default_parameters.carrier.center_of_mass[0], 3);
    about(&x->carrier.inertia[0], &sat4_default_parameters.carrier.inertia[0], 6);
    for (int i = 0; i < SAT4_N; ++i) {
        about(&x->flywheel[i].body.mass, &sat4_default_parameters.flywheel[i].body.mass, 1);
        about(&x->flywheel[i].body.center_of_mass[0], &sat4_default_parameters.flywheel[i].body.center_of_mass[0], 3);
        about(&x->flywheel[i].body.inertia[0], &sat4_default_parameters.flywheel[i].body.inertia[0], 6);
        about(&x->flywheel[i].position[0], &sat4_default_parameters.flywheel[i].position[0], 3);
        about(&x->flywheel[i].axis[0], &sat4_default_parameters.flywheel[i].axis[0], 3);
        about(&x->flywheel[i].zero[0], &sat4_default_parameters.flywheel[i].zero[0], 3);
    }
    for (int i = 0; i < 1; ++i) {
        about(&x->point[i].position[0], &sat4_default_parameters.point[i].position[0], 3);
        about(&x->point[i].axis[0], &sat4_default_parameters.point[i].axis[0], 3);
        about(&x->point[i].zero[0], &sat4_default_parameters.point[i].zero[0], 3);
    }
}

static void any_parameters(sat4_parameters *x)
{
    reals(&x->carrier.mass, 1, SAT4_LARGEST);
    reals(&x->carrier.center_of_mass[0], 3, SAT4_LARGEST);
    reals(&x->carrier.inertia[0], 6, SAT4_LARGEST);
    for (int i = 0; i < SAT4_N; ++i) {
        reals(&x->flywheel[i].body.mass, 1, SAT4_LARGEST);
        reals(&x->flywheel[i].body.center_of_mass[0], 3, SAT4_LARGEST);
        reals(&x->flywheel[i].body.inertia[0], 6, SAT4_LARGEST);
        reals(&x->flywheel[i].position[0], 3, SAT4_LARGEST);
        reals(&x->flywheel[i].axis[0], 3, SAT4_LARGEST);
        reals(&x->flywheel[i].zero[0], 3, SAT4_LARGEST);
    }
    for (int i = 0; i < 1; ++i) {
        reals(&x->point[i].position[0], 3, SAT4_LARGEST);
        reals(&x->point[i].axis[0], 3, SAT4_LARGEST);
        reals(&x->point[i].zero[0], 3, SAT4_LARGEST);
    }
}

static void bits_parameters(sat4_parameters *x)
{
    one_of_all(&x->carrier.mass);
    all_bits(&x->carrier.center_of_mass[0], 3);
    all_bits(&x->carrier.inertia[0], 6);
    for (int i = 0; i < SAT4_N; ++i) {
        one_of_all(&x->flywheel[i].body.mass);
        all_bits(&x->flywheel[i].body.center_of_mass[0], 3);
        all_bits(&x->flywheel[i].body.inertia[0], 6);
        all_bits(&x->flywheel[i].position[0], 3);
        all_bits(&x->flywheel[i].axis[0], 3);
        all_bits(&x->flywheel[i].zero[0], 3);
    }
    for (int i = 0; i < 1; ++i) {
        all_bits(&x->point[i].position[0], 3);
        all_bits(&x->point[i].axis[0], 3);
        all_bits(&x->point[i].zero[0], 3);
    }
}

static void normal_step_carry(sat4_step_carry *x)
{
    reals(&x->rounding[0], 21, 1.0e-6);
}

static void any_step_carry(sat4_step_carry *x)
{
    reals(&x->rounding[0], 21, SAT4_LARGEST);
}

static void bits_step_carry(sat4_step_carry *x)
{
    all_bits(&x->rounding[0], 21);
}

static void untouched_matrices_result(const sat4_matrices_result *x)
{
    untouched(&x->K[0][0], 36);
    untouched(&x->K_dot[0][0], 36);
    untouched(&x->M[0][0], 36);
    untouched(&x->I_[0][0], 24);
    untouched(&x->J[0][0], 24);
    untouched(&x->F[0], 6);
}

static void written_matrices_result(const sat4_matrices_result *x)
{
    written(&x->K[0][0], 36);
    written(&x->K_dot[0][0], 36);
    written(&x->M[0][0], 36);
    written(&x->I_[0][0], 24);
    written(&x->J[0][0], 24);
    written(&x->F[0], 6);
}

static void initialised_matrices_result(const sat4_matrices_result *x)
{
    initialised(&x->K[0][0], 36);
    initialised(&x->K_dot[0][0], 36);
    initialised(&x->M[0][0], 36);
    initialised(&x->I_[0][0], 24);
    initialised(&x->J[0][0], 24);
    initialised(&x->F[0], 6);
}

static void untouched_momentum_result(const sat4_momentum_result *x)
{
    untouched(&x->Z[0], 6);
    untouched(&x->Z0[0], 6);
    untouched(&x->energy, 1);
    untouched(&x->center_of_mass[0], 3);
    untouched(&x->center_of_mass_velocity[0], 3);
}

static void written_momentum_result(const sat4_momentum_result *x)
{
    written(&x->Z[0], 6);
    written(&x->Z0[0], 6);
    written(&x->energy, 1);
    written(&x->center_of_mass[0], 3);
    written(&x->center_of_mass_velocity[0], 3);
}

static void initialised_momentum_result(const sat4_momentum_result *x)
{
    initialised(&x->Z[0], 6);
    initialised(&x->Z0[0], 6);
    initialised(&x->energy, 1);
    initialised(&x->center_of_mass[0], 3);
    initialised(&x->center_of_mass_velocity[0], 3);
}

static void untouched_state(const sat4_state *x)
{
    untouched(&x->position[0], 3);
    untouched(&x->attitude[0], 4);
    untouched(&x->V[0], 6);
    untouched(&x->phi[0], 4);
    untouched(&x->phi_dot[0], 4);
}

static void written_state(const sat4_state *x)
{
    written(&x->position[0], 3);
    written(&x->attitude[0], 4);
    written(&x->V[0], 6);
    written(&x->phi[0], 4);
    written(&x->phi_dot[0], 4);
}

static void initialised_state(const sat4_state *x)
{
    initialised(&x->position[0], 3);
    initialised(&x->attitude[0], 4);
    initialised(&x->V[0], 6);
    initialised(&x->phi[0], 4);
    initialised(&x->phi_dot[0], 4);
}

static void written_encoder(const sat4_encoder *x)
{
    /*@ check \initialized(&x->counter); */
    /*@ check \initialized(&x->place); */
    /*@ check \initialized(&x->moved); */
}

static void initialised_encoder(const sat4_encoder *x)
{
    /*@ check \initialized(&x->counter); */
    /*@ check \initialized(&x->place); */
    /*@ check \initialized(&x->moved); */
}

static void untouched_forward_jacobian_result(const sat4_forward_jacobian_result *x)
{
    untouched(&x->V_dot_V[0][0], 36);
    untouched(&x->V_dot_phi[0][0], 24);
    untouched(&x->V_dot_phi_dot[0][0], 24);
    untouched(&x->V_dot_phi_ddot[0][0], 24);
}

static void written_forward_jacobian_result(const sat4_forward_jacobian_result *x)
{
    written(&x->V_dot_V[0][0], 36);
    written(&x->V_dot_phi[0][0], 24);
    written(&x->V_dot_phi_dot[0][0], 24);
    written(&x->V_dot_phi_ddot[0][0], 24);
}

static void initialised_forward_jacobian_result(const sat4_forward_jacobian_result *x)
{
    initialised(&x->V_dot_V[0][0], 36);
    initialised(&x->V_dot_phi[0][0], 24);
    initialised(&x->V_dot_phi_dot[0][0], 24);
    initialised(&x->V_dot_phi_ddot[0][0], 24);
}

static void untouched_coupled_jacobian_result(const sat4_coupled_jacobian_result *x)
{
    untouched(&x->V_dot_V[0][0], 36);
    untouched(&x->V_dot_phi[0][0], 24);
    untouched(&x->V_dot_phi_dot[0][0], 24);
    untouched(&x->V_dot_tau[0][0], 24);
    untouched(&x->phi_ddot_V[0][0], 24);
    untouched(&x->phi_ddot_phi[0][0], 16);
    untouched(&x->phi_ddot_phi_dot[0][0], 16);
    untouched(&x->phi_ddot_tau[0][0], 16);
}

static void written_coupled_jacobian_result(const sat4_coupled_jacobian_result *x)
{
    written(&x->V_dot_V[0][0], 36);
    written(&x->V_dot_phi[0][0], 24);
    written(&x->V_dot_phi_dot[0][0], 24);
    written(&x->V_dot_tau[0][0], 24);
    written(&x->phi_ddot_V[0][0], 24);
    written(&x->phi_ddot_phi[0][0], 16);
    written(&x->phi_ddot_phi_dot[0][0], 16);
    written(&x->phi_ddot_tau[0][0], 16);
}

static void initialised_coupled_jacobian_result(const sat4_coupled_jacobian_result *x)
{
    initialised(&x->V_dot_V[0][0], 36);
    initialised(&x->V_dot_phi[0][0], 24);
    initialised(&x->V_dot_phi_dot[0][0], 24);
    initialised(&x->V_dot_tau[0][0], 24);
    initialised(&x->phi_ddot_V[0][0], 24);
    initialised(&x->phi_ddot_phi[0][0], 16);
    initialised(&x->phi_ddot_phi_dot[0][0], 16);
    initialised(&x->phi_ddot_tau[0][0], 16);
}

static void untouched_inverse_result(const sat4_inverse_result *x)
{
    untouched(&x->phi_ddot[0], 4);
    untouched(&x->residual[0], 6);
    untouched(&x->sigma[0], 4);
    untouched(&x->damped_by, 1);
    untouched(&x->hardest[0], 6);
}

static void written_inverse_result(const sat4_inverse_result *x)
{
    written(&x->phi_ddot[0], 4);
    written(&x->residual[0], 6);
    written(&x->sigma[0], 4);
    /*@ check \initialized(&x->rank); */
    written(&x->damped_by, 1);
    /*@ check \initialized(&x->limited[0]); */
    written(&x->hardest[0], 6);
}

static void initialised_inverse_result(const sat4_inverse_result *x)
{
    initialised(&x->phi_ddot[0], 4);
    initialised(&x->residual[0], 6);
    initialised(&x->sigma[0], 4);
    /*@ check \initialized(&x->rank); */
    initialised(&x->damped_by, 1);
    /*@ check \initialized(&x->limited[0]); */
    initialised(&x->hardest[0], 6);
}

static void untouched_inverse_pointing_result(const sat4_inverse_pointing_result *x)
{
    untouched(&x->phi_ddot[0], 4);
    untouched(&x->V_dot[0], 6);
    untouched(&x->residual[0], 3);
    untouched(&x->sigma[0], 3);
    untouched(&x->damped_by, 1);
    untouched(&x->hardest[0], 3);
}

static void written_inverse_pointing_result(const sat4_inverse_pointing_result *x)
{
    written(&x->phi_ddot[0], 4);
    written(&x->V_dot[0], 6);
    written(&x->residual[0], 3);
    written(&x->sigma[0], 3);
    /*@ check \initialized(&x->rank); */
    written(&x->damped_by, 1);
    /*@ check \initialized(&x->limited[0]); */
    written(&x->hardest[0], 3);
}

static void initialised_inverse_pointing_result(const sat4_inverse_pointing_result *x)
{
    initialised(&x->phi_ddot[0], 4);
    initialised(&x->V_dot[0], 6);
    initialised(&x->residual[0], 3);
    initialised(&x->sigma[0], 3);
    /*@ check \initialized(&x->rank); */
    initialised(&x->damped_by, 1);
    /*@ check \initialized(&x->limited[0]); */
    initialised(&x->hardest[0], 3);
}

static void untouched_torque_for_pointing_result(const sat4_torque_for_pointing_result *x)
{
    untouched(&x->tau[0], 4);
    untouched(&x->phi_ddot[0], 4);
    untouched(&x->V_dot[0], 6);
    untouched(&x->residual[0], 3);
    untouched(&x->share, 1);
}

static void written_torque_for_pointing_result(const sat4_torque_for_pointing_result *x)
{
    written(&x->tau[0], 4);
    written(&x->phi_ddot[0], 4);
    written(&x->V_dot[0], 6);
    written(&x->residual[0], 3);
    written(&x->share, 1);
    /*@ check \initialized(&x->limited[0]); */
}

static void initialised_torque_for_pointing_result(const sat4_torque_for_pointing_result *x)
{
    initialised(&x->tau[0], 4);
    initialised(&x->phi_ddot[0], 4);
    initialised(&x->V_dot[0], 6);
    initialised(&x->residual[0], 3);
    initialised(&x->share, 1);
    /*@ check \initialized(&x->limited[0]); */
}

static void untouched_generalized_result(const sat4_generalized_result *x)
{
    untouched(&x->A[0][0], 36);
    untouched(&x->D[0][0], 36);
    untouched(&x->I0[0][0], 36);
    untouched(&x->J0[0][0], 36);
    untouched(&x->q_dot[0], 6);
    untouched(&x->q_ddot[0], 6);
}

static void written_generalized_result(const sat4_generalized_result *x)
{
    written(&x->A[0][0], 36);
    written(&x->D[0][0], 36);
    written(&x->I0[0][0], 36);
    written(&x->J0[0][0], 36);
    written(&x->q_dot[0], 6);
    written(&x->q_ddot[0], 6);
}

static void initialised_generalized_result(const sat4_generalized_result *x)
{
    initialised(&x->A[0][0], 36);
    initialised(&x->D[0][0], 36);
    initialised(&x->I0[0][0], 36);
    initialised(&x->J0[0][0], 36);
    initialised(&x->q_dot[0], 6);
    initialised(&x->q_ddot[0], 6);
}

static void written_table(const sat4_table *x)
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
    written(&x->sensor[0].origin[0], 3);
    written(&x->sensor[0].axes[0], 9);
}

static void initialised_table(const sat4_table *x)
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
    initialised(&x->sensor[0].origin[0], 3);
    initialised(&x->sensor[0].axes[0], 9);
}

static void untouched_mount_table(const sat4_mount_table *x)
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
}

static void written_mount_table(const sat4_mount_table *x)
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
}

static void initialised_mount_table(const sat4_mount_table *x)
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
}

static void written_step_carry(const sat4_step_carry *x)
{
    written(&x->rounding[0], 21);
}

static void initialised_step_carry(const sat4_step_carry *x)
{
    initialised(&x->rounding[0], 21);
}

/* ---- drivers: a function and a set each ---- */

void sat4_eva_normal_forward(void);
void sat4_eva_normal_forward(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, 1.0e4);
    sat4_real V_dot[6];
    const sat4_status status = sat4_forward(&sat4_default, &x, phi_ddot, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
    }
}

void sat4_eva_any_forward(void);
void sat4_eva_any_forward(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, SAT4_LARGEST);
    sat4_real V_dot[6];
    const sat4_status status = sat4_forward(&sat4_default, &x, phi_ddot, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
    }
}

void sat4_eva_bits_forward(void);
void sat4_eva_bits_forward(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real phi_ddot[SAT4_N];
    all_bits(&phi_ddot[0], 4);
    sat4_real V_dot[6];
    const sat4_status status = sat4_forward(&sat4_default, &x, phi_ddot, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&V_dot[0], 6);
    }
}

void sat4_eva_normal_matrices(void);
void sat4_eva_normal_matrices(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_matrices_result out;
    const sat4_status status = sat4_matrices(&sat4_default, &x, &out);
    if (status < 0) {
        untouched_matrices_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_matrices_result(&out);
    }
}

void sat4_eva_any_matrices(void);
void sat4_eva_any_matrices(void)
{
    sat4_state x;
    any_state(&x);
    sat4_matrices_result out;
    const sat4_status status = sat4_matrices(&sat4_default, &x, &out);
    if (status < 0) {
        untouched_matrices_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_matrices_result(&out);
    }
}

void sat4_eva_bits_matrices(void);
void sat4_eva_bits_matrices(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_matrices_result out;
    const sat4_status status = sat4_matrices(&sat4_default, &x, &out);
    if (status < 0) {
        untouched_matrices_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_matrices_result(&out);
    }
}

void sat4_eva_normal_momentum(void);
void sat4_eva_normal_momentum(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_momentum_result out;
    const sat4_status status = sat4_momentum(&sat4_default, &x, &out);
    if (status < 0) {
        untouched_momentum_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_momentum_result(&out);
    }
}

void sat4_eva_any_momentum(void);
void sat4_eva_any_momentum(void)
{
    sat4_state x;
    any_state(&x);
    sat4_momentum_result out;
    const sat4_status status = sat4_momentum(&sat4_default, &x, &out);
    if (status < 0) {
        untouched_momentum_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_momentum_result(&out);
    }
}

void sat4_eva_bits_momentum(void);
void sat4_eva_bits_momentum(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_momentum_result out;
    const sat4_status status = sat4_momentum(&sat4_default, &x, &out);
    if (status < 0) {
        untouched_momentum_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_momentum_result(&out);
    }
}

void sat4_eva_normal_torque(void);
void sat4_eva_normal_torque(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, 1.0e4);
    sat4_real tau[SAT4_N];
    const sat4_status status = sat4_torque(&sat4_default, &x, V_dot, phi_ddot, tau);
    if (status < 0) {
        untouched(&tau[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&tau[0], 4);
    }
}

void sat4_eva_any_torque(void);
void sat4_eva_any_torque(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real V_dot[6];
    reals(&V_dot[0], 6, SAT4_LARGEST);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, SAT4_LARGEST);
    sat4_real tau[SAT4_N];
    const sat4_status status = sat4_torque(&sat4_default, &x, V_dot, phi_ddot, tau);
    if (status < 0) {
        untouched(&tau[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&tau[0], 4);
    }
}

void sat4_eva_bits_torque(void);
void sat4_eva_bits_torque(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real V_dot[6];
    all_bits(&V_dot[0], 6);
    sat4_real phi_ddot[SAT4_N];
    all_bits(&phi_ddot[0], 4);
    sat4_real tau[SAT4_N];
    const sat4_status status = sat4_torque(&sat4_default, &x, V_dot, phi_ddot, tau);
    if (status < 0) {
        untouched(&tau[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&tau[0], 4);
    }
}

void sat4_eva_normal_coupled(void);
void sat4_eva_normal_coupled(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real tau[SAT4_N];
    reals(&tau[0], 4, 100.0);
    int locked[SAT4_N];
    integers(&locked[0], 4, 0, 1);
    sat4_real V_dot[6];
    sat4_real phi_ddot[SAT4_N];
    const sat4_status status = sat4_coupled(&sat4_default, &x, tau, locked, V_dot, phi_ddot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
        untouched(&phi_ddot[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
        written(&phi_ddot[0], 4);
    }
}

void sat4_eva_any_coupled(void);
void sat4_eva_any_coupled(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real tau[SAT4_N];
    reals(&tau[0], 4, SAT4_LARGEST);
    int locked[SAT4_N];
    integers(&locked[0], 4, INT_MIN, INT_MAX);
    sat4_real V_dot[6];
    sat4_real phi_ddot[SAT4_N];
    const sat4_status status = sat4_coupled(&sat4_default, &x, tau, locked, V_dot, phi_ddot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
        untouched(&phi_ddot[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
        written(&phi_ddot[0], 4);
    }
}

void sat4_eva_bits_coupled(void);
void sat4_eva_bits_coupled(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real tau[SAT4_N];
    all_bits(&tau[0], 4);
    int locked[SAT4_N];
    integers(&locked[0], 4, INT_MIN, INT_MAX);
    sat4_real V_dot[6];
    sat4_real phi_ddot[SAT4_N];
    const sat4_status status = sat4_coupled(&sat4_default, &x, tau, locked, V_dot, phi_ddot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
        untouched(&phi_ddot[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&V_dot[0], 6);
        initialised(&phi_ddot[0], 4);
    }
}

void sat4_eva_normal_step(void);
void sat4_eva_normal_step(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real tau[SAT4_N];
    reals(&tau[0], 4, 100.0);
    int locked[SAT4_N];
    integers(&locked[0], 4, 0, 1);
    sat4_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    sat4_state next;
    const sat4_status status = sat4_step(&sat4_default, &x, tau, locked, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&next);
    }
}

void sat4_eva_any_step(void);
void sat4_eva_any_step(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real tau[SAT4_N];
    reals(&tau[0], 4, SAT4_LARGEST);
    int locked[SAT4_N];
    integers(&locked[0], 4, INT_MIN, INT_MAX);
    sat4_real dt;
    reals(&dt, 1, SAT4_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    sat4_state next;
    const sat4_status status = sat4_step(&sat4_default, &x, tau, locked, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&next);
    }
}

void sat4_eva_bits_step(void);
void sat4_eva_bits_step(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real tau[SAT4_N];
    all_bits(&tau[0], 4);
    int locked[SAT4_N];
    integers(&locked[0], 4, INT_MIN, INT_MAX);
    sat4_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    sat4_state next;
    const sat4_status status = sat4_step(&sat4_default, &x, tau, locked, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        initialised_state(&next);
    }
}

void sat4_eva_normal_step_driven(void);
void sat4_eva_normal_step_driven(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, 1.0e4);
    sat4_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    sat4_state next;
    const sat4_status status = sat4_step_driven(&sat4_default, &x, phi_ddot, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&next);
    }
}

void sat4_eva_any_step_driven(void);
void sat4_eva_any_step_driven(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, SAT4_LARGEST);
    sat4_real dt;
    reals(&dt, 1, SAT4_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    sat4_state next;
    const sat4_status status = sat4_step_driven(&sat4_default, &x, phi_ddot, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&next);
    }
}

void sat4_eva_bits_step_driven(void);
void sat4_eva_bits_step_driven(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real phi_ddot[SAT4_N];
    all_bits(&phi_ddot[0], 4);
    sat4_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    sat4_state next;
    const sat4_status status = sat4_step_driven(&sat4_default, &x, phi_ddot, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        initialised_state(&next);
    }
}

void sat4_eva_normal_wrap(void);
void sat4_eva_normal_wrap(void)
{
    sat4_real phi;
    reals(&phi, 1, 100.0);
    sat4_real wrapped;
    const sat4_status status = sat4_wrap(phi, &wrapped);
    if (status < 0) {
        untouched(&wrapped, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&wrapped, 1);
    }
}

void sat4_eva_any_wrap(void);
void sat4_eva_any_wrap(void)
{
    sat4_real phi;
    reals(&phi, 1, SAT4_LARGEST);
    sat4_real wrapped;
    const sat4_status status = sat4_wrap(phi, &wrapped);
    if (status < 0) {
        untouched(&wrapped, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&wrapped, 1);
    }
}

void sat4_eva_bits_wrap(void);
void sat4_eva_bits_wrap(void)
{
    sat4_real phi;
    one_of_all(&phi);
    sat4_real wrapped;
    const sat4_status status = sat4_wrap(phi, &wrapped);
    if (status < 0) {
        untouched(&wrapped, 1);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&wrapped, 1);
    }
}

void sat4_eva_normal_phase_of_counts(void);
void sat4_eva_normal_phase_of_counts(void)
{
    int count;
    integers(&count, 1, -1048576, 1048576);
    int per_turn;
    integers(&per_turn, 1, -100000, 100000);
    sat4_real zero;
    reals(&zero, 1, 1.0e3);
    sat4_real phi;
    const sat4_status status = sat4_phase_of_counts(count, per_turn, zero, &phi);
    if (status < 0) {
        untouched(&phi, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi, 1);
    }
}

void sat4_eva_any_phase_of_counts(void);
void sat4_eva_any_phase_of_counts(void)
{
    int count;
    integers(&count, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    sat4_real zero;
    reals(&zero, 1, SAT4_LARGEST);
    sat4_real phi;
    const sat4_status status = sat4_phase_of_counts(count, per_turn, zero, &phi);
    if (status < 0) {
        untouched(&phi, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi, 1);
    }
}

void sat4_eva_bits_phase_of_counts(void);
void sat4_eva_bits_phase_of_counts(void)
{
    int count;
    integers(&count, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    sat4_real zero;
    one_of_all(&zero);
    sat4_real phi;
    const sat4_status status = sat4_phase_of_counts(count, per_turn, zero, &phi);
    if (status < 0) {
        untouched(&phi, 1);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&phi, 1);
    }
}

void sat4_eva_normal_speed_of_counts(void);
void sat4_eva_normal_speed_of_counts(void)
{
    int moved;
    integers(&moved, 1, -1048576, 1048576);
    int per_turn;
    integers(&per_turn, 1, -100000, 100000);
    sat4_real dt;
    dt = real_in(1.0e-6, 0.001);
    sat4_real phi_dot;
    const sat4_status status = sat4_speed_of_counts(moved, per_turn, dt, &phi_dot);
    if (status < 0) {
        untouched(&phi_dot, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_dot, 1);
    }
}

void sat4_eva_any_speed_of_counts(void);
void sat4_eva_any_speed_of_counts(void)
{
    int moved;
    integers(&moved, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    sat4_real dt;
    reals(&dt, 1, SAT4_LARGEST);
    sat4_real phi_dot;
    const sat4_status status = sat4_speed_of_counts(moved, per_turn, dt, &phi_dot);
    if (status < 0) {
        untouched(&phi_dot, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_dot, 1);
    }
}

void sat4_eva_bits_speed_of_counts(void);
void sat4_eva_bits_speed_of_counts(void)
{
    int moved;
    integers(&moved, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    sat4_real dt;
    one_of_all(&dt);
    sat4_real phi_dot;
    const sat4_status status = sat4_speed_of_counts(moved, per_turn, dt, &phi_dot);
    if (status < 0) {
        untouched(&phi_dot, 1);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&phi_dot, 1);
    }
}

void sat4_eva_normal_accumulate(void);
void sat4_eva_normal_accumulate(void)
{
    sat4_encoder encoder;
    normal_encoder(&encoder);
    int counter;
    integers(&counter, 1, -1048576, 1048576);
    int bits;
    integers(&bits, 1, 0, 32);
    int per_turn;
    integers(&per_turn, 1, -100000, 100000);
    const sat4_status status = sat4_accumulate(&encoder, counter, bits, per_turn);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written_encoder(&encoder);
    }
}

void sat4_eva_any_accumulate(void);
void sat4_eva_any_accumulate(void)
{
    sat4_encoder encoder;
    any_encoder(&encoder);
    int counter;
    integers(&counter, 1, INT_MIN, INT_MAX);
    int bits;
    integers(&bits, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    const sat4_status status = sat4_accumulate(&encoder, counter, bits, per_turn);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written_encoder(&encoder);
    }
}

void sat4_eva_bits_accumulate(void);
void sat4_eva_bits_accumulate(void)
{
    sat4_encoder encoder;
    bits_encoder(&encoder);
    int counter;
    integers(&counter, 1, INT_MIN, INT_MAX);
    int bits;
    integers(&bits, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    const sat4_status status = sat4_accumulate(&encoder, counter, bits, per_turn);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        initialised_encoder(&encoder);
    }
}

void sat4_eva_normal_forward_jacobian(void);
void sat4_eva_normal_forward_jacobian(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, 1.0e4);
    sat4_forward_jacobian_result out;
    const sat4_status status = sat4_forward_jacobian(&sat4_default, &x, phi_ddot, &out);
    if (status < 0) {
        untouched_forward_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_forward_jacobian_result(&out);
    }
}

void sat4_eva_any_forward_jacobian(void);
void sat4_eva_any_forward_jacobian(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, SAT4_LARGEST);
    sat4_forward_jacobian_result out;
    const sat4_status status = sat4_forward_jacobian(&sat4_default, &x, phi_ddot, &out);
    if (status < 0) {
        untouched_forward_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_forward_jacobian_result(&out);
    }
}

void sat4_eva_bits_forward_jacobian(void);
void sat4_eva_bits_forward_jacobian(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real phi_ddot[SAT4_N];
    all_bits(&phi_ddot[0], 4);
    sat4_forward_jacobian_result out;
    const sat4_status status = sat4_forward_jacobian(&sat4_default, &x, phi_ddot, &out);
    if (status < 0) {
        untouched_forward_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_forward_jacobian_result(&out);
    }
}

void sat4_eva_normal_coupled_jacobian(void);
void sat4_eva_normal_coupled_jacobian(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real tau[SAT4_N];
    reals(&tau[0], 4, 100.0);
    int locked[SAT4_N];
    integers(&locked[0], 4, 0, 1);
    sat4_coupled_jacobian_result out;
    const sat4_status status = sat4_coupled_jacobian(&sat4_default, &x, tau, locked, &out);
    if (status < 0) {
        untouched_coupled_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_coupled_jacobian_result(&out);
    }
}

void sat4_eva_any_coupled_jacobian(void);
void sat4_eva_any_coupled_jacobian(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real tau[SAT4_N];
    reals(&tau[0], 4, SAT4_LARGEST);
    int locked[SAT4_N];
    integers(&locked[0], 4, INT_MIN, INT_MAX);
    sat4_coupled_jacobian_result out;
    const sat4_status status = sat4_coupled_jacobian(&sat4_default, &x, tau, locked, &out);
    if (status < 0) {
        untouched_coupled_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_coupled_jacobian_result(&out);
    }
}

void sat4_eva_bits_coupled_jacobian(void);
void sat4_eva_bits_coupled_jacobian(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real tau[SAT4_N];
    all_bits(&tau[0], 4);
    int locked[SAT4_N];
    integers(&locked[0], 4, INT_MIN, INT_MAX);
    sat4_coupled_jacobian_result out;
    const sat4_status status = sat4_coupled_jacobian(&sat4_default, &x, tau, locked, &out);
    if (status < 0) {
        untouched_coupled_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_coupled_jacobian_result(&out);
    }
}

void sat4_eva_normal_inverse(void);
void sat4_eva_normal_inverse(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    sat4_inverse_options options;
    normal_inverse_options(&options);
    sat4_inverse_result out;
    const sat4_status status = sat4_inverse(&sat4_default, &x, V_dot, &options, &out);
    if (status < 0) {
        untouched_inverse_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_inverse_result(&out);
    }
}

void sat4_eva_any_inverse(void);
void sat4_eva_any_inverse(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real V_dot[6];
    reals(&V_dot[0], 6, SAT4_LARGEST);
    sat4_inverse_options options;
    any_inverse_options(&options);
    sat4_inverse_result out;
    const sat4_status status = sat4_inverse(&sat4_default, &x, V_dot, &options, &out);
    if (status < 0) {
        untouched_inverse_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_inverse_result(&out);
    }
}

void sat4_eva_bits_inverse(void);
void sat4_eva_bits_inverse(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real V_dot[6];
    all_bits(&V_dot[0], 6);
    sat4_inverse_options options;
    bits_inverse_options(&options);
    sat4_inverse_result out;
    const sat4_status status = sat4_inverse(&sat4_default, &x, V_dot, &options, &out);
    if (status < 0) {
        untouched_inverse_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_inverse_result(&out);
    }
}

void sat4_eva_normal_inverse_fast(void);
void sat4_eva_normal_inverse_fast(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    sat4_inverse_options options;
    normal_inverse_options(&options);
    sat4_real phi_ddot[SAT4_N];
    const sat4_status status = sat4_inverse_fast(&sat4_default, &x, V_dot, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_ddot[0], 4);
    }
}

void sat4_eva_any_inverse_fast(void);
void sat4_eva_any_inverse_fast(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real V_dot[6];
    reals(&V_dot[0], 6, SAT4_LARGEST);
    sat4_inverse_options options;
    any_inverse_options(&options);
    sat4_real phi_ddot[SAT4_N];
    const sat4_status status = sat4_inverse_fast(&sat4_default, &x, V_dot, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_ddot[0], 4);
    }
}

void sat4_eva_bits_inverse_fast(void);
void sat4_eva_bits_inverse_fast(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real V_dot[6];
    all_bits(&V_dot[0], 6);
    sat4_inverse_options options;
    bits_inverse_options(&options);
    sat4_real phi_ddot[SAT4_N];
    const sat4_status status = sat4_inverse_fast(&sat4_default, &x, V_dot, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&phi_ddot[0], 4);
    }
}

void sat4_eva_normal_inverse_pointing(void);
void sat4_eva_normal_inverse_pointing(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real demand[3];
    reals(&demand[0], 3, 1.0e3);
    sat4_inverse_options options;
    normal_inverse_options(&options);
    sat4_inverse_pointing_result out;
    const sat4_status status = sat4_inverse_pointing(&sat4_default, &x, demand, &options, &out);
    if (status < 0) {
        untouched_inverse_pointing_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_inverse_pointing_result(&out);
    }
}

void sat4_eva_any_inverse_pointing(void);
void sat4_eva_any_inverse_pointing(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real demand[3];
    reals(&demand[0], 3, SAT4_LARGEST);
    sat4_inverse_options options;
    any_inverse_options(&options);
    sat4_inverse_pointing_result out;
    const sat4_status status = sat4_inverse_pointing(&sat4_default, &x, demand, &options, &out);
    if (status < 0) {
        untouched_inverse_pointing_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_inverse_pointing_result(&out);
    }
}

void sat4_eva_bits_inverse_pointing(void);
void sat4_eva_bits_inverse_pointing(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real demand[3];
    all_bits(&demand[0], 3);
    sat4_inverse_options options;
    bits_inverse_options(&options);
    sat4_inverse_pointing_result out;
    const sat4_status status = sat4_inverse_pointing(&sat4_default, &x, demand, &options, &out);
    if (status < 0) {
        untouched_inverse_pointing_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_inverse_pointing_result(&out);
    }
}

void sat4_eva_normal_inverse_fast_pointing(void);
void sat4_eva_normal_inverse_fast_pointing(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real demand[3];
    reals(&demand[0], 3, 1.0e3);
    sat4_inverse_options options;
    normal_inverse_options(&options);
    sat4_real phi_ddot[SAT4_N];
    const sat4_status status = sat4_inverse_fast_pointing(&sat4_default, &x, demand, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_ddot[0], 4);
    }
}

void sat4_eva_any_inverse_fast_pointing(void);
void sat4_eva_any_inverse_fast_pointing(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real demand[3];
    reals(&demand[0], 3, SAT4_LARGEST);
    sat4_inverse_options options;
    any_inverse_options(&options);
    sat4_real phi_ddot[SAT4_N];
    const sat4_status status = sat4_inverse_fast_pointing(&sat4_default, &x, demand, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_ddot[0], 4);
    }
}

void sat4_eva_bits_inverse_fast_pointing(void);
void sat4_eva_bits_inverse_fast_pointing(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real demand[3];
    all_bits(&demand[0], 3);
    sat4_inverse_options options;
    bits_inverse_options(&options);
    sat4_real phi_ddot[SAT4_N];
    const sat4_status status = sat4_inverse_fast_pointing(&sat4_default, &x, demand, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&phi_ddot[0], 4);
    }
}

void sat4_eva_normal_torque_for_pointing(void);
void sat4_eva_normal_torque_for_pointing(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real demand[3];
    reals(&demand[0], 3, 1.0e3);
    sat4_inverse_options options;
    normal_inverse_options(&options);
    int locked[SAT4_N];
    integers(&locked[0], 4, 0, 1);
    sat4_torque_for_pointing_result out;
    const sat4_status status = sat4_torque_for_pointing(&sat4_default, &x, demand, &options, locked, &out);
    if (status < 0) {
        untouched_torque_for_pointing_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_torque_for_pointing_result(&out);
    }
}

void sat4_eva_any_torque_for_pointing(void);
void sat4_eva_any_torque_for_pointing(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real demand[3];
    reals(&demand[0], 3, SAT4_LARGEST);
    sat4_inverse_options options;
    any_inverse_options(&options);
    int locked[SAT4_N];
    integers(&locked[0], 4, INT_MIN, INT_MAX);
    sat4_torque_for_pointing_result out;
    const sat4_status status = sat4_torque_for_pointing(&sat4_default, &x, demand, &options, locked, &out);
    if (status < 0) {
        untouched_torque_for_pointing_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_torque_for_pointing_result(&out);
    }
}

void sat4_eva_bits_torque_for_pointing(void);
void sat4_eva_bits_torque_for_pointing(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real demand[3];
    all_bits(&demand[0], 3);
    sat4_inverse_options options;
    bits_inverse_options(&options);
    int locked[SAT4_N];
    integers(&locked[0], 4, INT_MIN, INT_MAX);
    sat4_torque_for_pointing_result out;
    const sat4_status status = sat4_torque_for_pointing(&sat4_default, &x, demand, &options, locked, &out);
    if (status < 0) {
        untouched_torque_for_pointing_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_torque_for_pointing_result(&out);
    }
}

void sat4_eva_normal_points(void);
void sat4_eva_normal_points(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    sat4_points_result out[SAT4_SENSORS];
    const sat4_status status = sat4_points(&sat4_default, &x, V_dot, out);
    if (status < 0) {
        untouched(&out[0].position[0], 3);
        untouched(&out[0].C[0][0], 9);
        untouched(&out[0].twist[0], 6);
        untouched(&out[0].specific_force[0], 3);
        untouched(&out[0].angular_acceleration[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&out[0].position[0], 3);
        written(&out[0].C[0][0], 9);
        written(&out[0].twist[0], 6);
        written(&out[0].specific_force[0], 3);
        written(&out[0].angular_acceleration[0], 3);
    }
}

void sat4_eva_any_points(void);
void sat4_eva_any_points(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real V_dot[6];
    reals(&V_dot[0], 6, SAT4_LARGEST);
    sat4_points_result out[SAT4_SENSORS];
    const sat4_status status = sat4_points(&sat4_default, &x, V_dot, out);
    if (status < 0) {
        untouched(&out[0].position[0], 3);
        untouched(&out[0].C[0][0], 9);
        untouched(&out[0].twist[0], 6);
        untouched(&out[0].specific_force[0], 3);
        untouched(&out[0].angular_acceleration[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        written(&out[0].position[0], 3);
        written(&out[0].C[0][0], 9);
        written(&out[0].twist[0], 6);
        written(&out[0].specific_force[0], 3);
        written(&out[0].angular_acceleration[0], 3);
    }
}

void sat4_eva_bits_points(void);
void sat4_eva_bits_points(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real V_dot[6];
    all_bits(&V_dot[0], 6);
    sat4_points_result out[SAT4_SENSORS];
    const sat4_status status = sat4_points(&sat4_default, &x, V_dot, out);
    if (status < 0) {
        untouched(&out[0].position[0], 3);
        untouched(&out[0].C[0][0], 9);
        untouched(&out[0].twist[0], 6);
        untouched(&out[0].specific_force[0], 3);
        untouched(&out[0].angular_acceleration[0], 3);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&out[0].position[0], 3);
        initialised(&out[0].C[0][0], 9);
        initialised(&out[0].twist[0], 6);
        initialised(&out[0].specific_force[0], 3);
        initialised(&out[0].angular_acceleration[0], 3);
    }
}

void sat4_eva_normal_quaternion(void);
void sat4_eva_normal_quaternion(void)
{
    sat4_real angles[3];
    reals(&angles[0], 3, 7.0);
    sat4_real attitude[4];
    const sat4_status status = sat4_quaternion(angles, attitude);
    if (status < 0) {
        untouched(&attitude[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&attitude[0], 4);
    }
}

void sat4_eva_any_quaternion(void);
void sat4_eva_any_quaternion(void)
{
    sat4_real angles[3];
    reals(&angles[0], 3, SAT4_LARGEST);
    sat4_real attitude[4];
    const sat4_status status = sat4_quaternion(angles, attitude);
    if (status < 0) {
        untouched(&attitude[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&attitude[0], 4);
    }
}

void sat4_eva_bits_quaternion(void);
void sat4_eva_bits_quaternion(void)
{
    sat4_real angles[3];
    all_bits(&angles[0], 3);
    sat4_real attitude[4];
    const sat4_status status = sat4_quaternion(angles, attitude);
    if (status < 0) {
        untouched(&attitude[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&attitude[0], 4);
    }
}

void sat4_eva_normal_state_from_coordinates(void);
void sat4_eva_normal_state_from_coordinates(void)
{
    sat4_real position[3];
    reals(&position[0], 3, 100.0);
    sat4_real angles[3];
    reals(&angles[0], 3, 7.0);
    sat4_real q_dot[6];
    reals(&q_dot[0], 6, 20.0);
    sat4_real q_ddot[6];
    reals(&q_ddot[0], 6, 1.0e3);
    sat4_state x;
    normal_state(&x);
    sat4_real V_dot[6];
    const sat4_status status = sat4_state_from_coordinates(position, angles, q_dot, q_ddot, &x, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&x);
        written(&V_dot[0], 6);
    }
}

void sat4_eva_any_state_from_coordinates(void);
void sat4_eva_any_state_from_coordinates(void)
{
    sat4_real position[3];
    reals(&position[0], 3, SAT4_LARGEST);
    sat4_real angles[3];
    reals(&angles[0], 3, SAT4_LARGEST);
    sat4_real q_dot[6];
    reals(&q_dot[0], 6, SAT4_LARGEST);
    sat4_real q_ddot[6];
    reals(&q_ddot[0], 6, SAT4_LARGEST);
    sat4_state x;
    any_state(&x);
    sat4_real V_dot[6];
    const sat4_status status = sat4_state_from_coordinates(position, angles, q_dot, q_ddot, &x, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&x);
        written(&V_dot[0], 6);
    }
}

void sat4_eva_bits_state_from_coordinates(void);
void sat4_eva_bits_state_from_coordinates(void)
{
    sat4_real position[3];
    all_bits(&position[0], 3);
    sat4_real angles[3];
    all_bits(&angles[0], 3);
    sat4_real q_dot[6];
    all_bits(&q_dot[0], 6);
    sat4_real q_ddot[6];
    all_bits(&q_ddot[0], 6);
    sat4_state x;
    bits_state(&x);
    sat4_real V_dot[6];
    const sat4_status status = sat4_state_from_coordinates(position, angles, q_dot, q_ddot, &x, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        initialised_state(&x);
        initialised(&V_dot[0], 6);
    }
}

void sat4_eva_normal_generalized(void);
void sat4_eva_normal_generalized(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real angles[3];
    reals(&angles[0], 3, 7.0);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, 1.0e4);
    sat4_generalized_result out;
    const sat4_status status = sat4_generalized(&sat4_default, &x, angles, phi_ddot, &out);
    if (status < 0) {
        untouched_generalized_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_generalized_result(&out);
    }
}

void sat4_eva_any_generalized(void);
void sat4_eva_any_generalized(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real angles[3];
    reals(&angles[0], 3, SAT4_LARGEST);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, SAT4_LARGEST);
    sat4_generalized_result out;
    const sat4_status status = sat4_generalized(&sat4_default, &x, angles, phi_ddot, &out);
    if (status < 0) {
        untouched_generalized_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_generalized_result(&out);
    }
}

void sat4_eva_bits_generalized(void);
void sat4_eva_bits_generalized(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real angles[3];
    all_bits(&angles[0], 3);
    sat4_real phi_ddot[SAT4_N];
    all_bits(&phi_ddot[0], 4);
    sat4_generalized_result out;
    const sat4_status status = sat4_generalized(&sat4_default, &x, angles, phi_ddot, &out);
    if (status < 0) {
        untouched_generalized_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_generalized_result(&out);
    }
}

void sat4_eva_normal_prepare(void);
void sat4_eva_normal_prepare(void)
{
    sat4_parameters parameters;
    normal_parameters(&parameters);
    sat4_table table = sat4_default;
    const sat4_status status = sat4_prepare(&parameters, &table);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written_table(&table);
    }
}

void sat4_eva_any_prepare(void);
void sat4_eva_any_prepare(void)
{
    sat4_parameters parameters;
    any_parameters(&parameters);
    sat4_table table = sat4_default;
    const sat4_status status = sat4_prepare(&parameters, &table);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written_table(&table);
    }
}

void sat4_eva_bits_prepare(void);
void sat4_eva_bits_prepare(void)
{
    sat4_parameters parameters;
    bits_parameters(&parameters);
    sat4_table table = sat4_default;
    const sat4_status status = sat4_prepare(&parameters, &table);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        initialised_table(&table);
    }
}

void sat4_eva_normal_mounts(void);
void sat4_eva_normal_mounts(void)
{
    sat4_mount_table mounting;
    (void)sat4_prepare_mounts(&sat4_default_parameters, &mounting);
    sat4_state x;
    normal_state(&x);
    sat4_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, 1.0e4);
    sat4_real mount_wrench[24];
    const sat4_status status = sat4_mounts(&mounting, &x, V_dot, phi_ddot, mount_wrench);
    if (status < 0) {
        untouched(&mount_wrench[0], 24);
    } else {
        Frama_C_show_each_returned(status);
        written(&mount_wrench[0], 24);
    }
}

void sat4_eva_any_mounts(void);
void sat4_eva_any_mounts(void)
{
    sat4_mount_table mounting;
    (void)sat4_prepare_mounts(&sat4_default_parameters, &mounting);
    sat4_state x;
    any_state(&x);
    sat4_real V_dot[6];
    reals(&V_dot[0], 6, SAT4_LARGEST);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, SAT4_LARGEST);
    sat4_real mount_wrench[24];
    const sat4_status status = sat4_mounts(&mounting, &x, V_dot, phi_ddot, mount_wrench);
    if (status < 0) {
        untouched(&mount_wrench[0], 24);
    } else {
        Frama_C_show_each_returned(status);
        written(&mount_wrench[0], 24);
    }
}

void sat4_eva_bits_mounts(void);
void sat4_eva_bits_mounts(void)
{
    sat4_mount_table mounting;
    (void)sat4_prepare_mounts(&sat4_default_parameters, &mounting);
    sat4_state x;
    bits_state(&x);
    sat4_real V_dot[6];
    all_bits(&V_dot[0], 6);
    sat4_real phi_ddot[SAT4_N];
    all_bits(&phi_ddot[0], 4);
    sat4_real mount_wrench[24];
    const sat4_status status = sat4_mounts(&mounting, &x, V_dot, phi_ddot, mount_wrench);
    if (status < 0) {
        untouched(&mount_wrench[0], 24);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&mount_wrench[0], 24);
    }
}

void sat4_eva_normal_prepare_mounts(void);
void sat4_eva_normal_prepare_mounts(void)
{
    sat4_parameters parameters;
    normal_parameters(&parameters);
    sat4_mount_table mounting;
    const sat4_status status = sat4_prepare_mounts(&parameters, &mounting);
    if (status < 0) {
        untouched_mount_table(&mounting);
    } else {
        Frama_C_show_each_returned(status);
        written_mount_table(&mounting);
    }
}

void sat4_eva_any_prepare_mounts(void);
void sat4_eva_any_prepare_mounts(void)
{
    sat4_parameters parameters;
    any_parameters(&parameters);
    sat4_mount_table mounting;
    const sat4_status status = sat4_prepare_mounts(&parameters, &mounting);
    if (status < 0) {
        untouched_mount_table(&mounting);
    } else {
        Frama_C_show_each_returned(status);
        written_mount_table(&mounting);
    }
}

void sat4_eva_bits_prepare_mounts(void);
void sat4_eva_bits_prepare_mounts(void)
{
    sat4_parameters parameters;
    bits_parameters(&parameters);
    sat4_mount_table mounting;
    const sat4_status status = sat4_prepare_mounts(&parameters, &mounting);
    if (status < 0) {
        untouched_mount_table(&mounting);
    } else {
        Frama_C_show_each_returned(status);
        initialised_mount_table(&mounting);
    }
}

void sat4_eva_normal_step_carried(void);
void sat4_eva_normal_step_carried(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real tau[SAT4_N];
    reals(&tau[0], 4, 100.0);
    int locked[SAT4_N];
    integers(&locked[0], 4, 0, 1);
    sat4_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    sat4_step_carry carry;
    normal_step_carry(&carry);
    sat4_state next;
    const sat4_status status = sat4_step_carried(&sat4_default, &x, tau, locked, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_step_carry(&carry);
        written_state(&next);
    }
}

void sat4_eva_any_step_carried(void);
void sat4_eva_any_step_carried(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real tau[SAT4_N];
    reals(&tau[0], 4, SAT4_LARGEST);
    int locked[SAT4_N];
    integers(&locked[0], 4, INT_MIN, INT_MAX);
    sat4_real dt;
    reals(&dt, 1, SAT4_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    sat4_step_carry carry;
    any_step_carry(&carry);
    sat4_state next;
    const sat4_status status = sat4_step_carried(&sat4_default, &x, tau, locked, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_step_carry(&carry);
        written_state(&next);
    }
}

void sat4_eva_bits_step_carried(void);
void sat4_eva_bits_step_carried(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real tau[SAT4_N];
    all_bits(&tau[0], 4);
    int locked[SAT4_N];
    integers(&locked[0], 4, INT_MIN, INT_MAX);
    sat4_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    sat4_step_carry carry;
    bits_step_carry(&carry);
    sat4_state next;
    const sat4_status status = sat4_step_carried(&sat4_default, &x, tau, locked, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        initialised_step_carry(&carry);
        initialised_state(&next);
    }
}

void sat4_eva_normal_step_driven_carried(void);
void sat4_eva_normal_step_driven_carried(void)
{
    sat4_state x;
    normal_state(&x);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, 1.0e4);
    sat4_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    sat4_step_carry carry;
    normal_step_carry(&carry);
    sat4_state next;
    const sat4_status status = sat4_step_driven_carried(&sat4_default, &x, phi_ddot, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_step_carry(&carry);
        written_state(&next);
    }
}

void sat4_eva_any_step_driven_carried(void);
void sat4_eva_any_step_driven_carried(void)
{
    sat4_state x;
    any_state(&x);
    sat4_real phi_ddot[SAT4_N];
    reals(&phi_ddot[0], 4, SAT4_LARGEST);
    sat4_real dt;
    reals(&dt, 1, SAT4_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    sat4_step_carry carry;
    any_step_carry(&carry);
    sat4_state next;
    const sat4_status status = sat4_step_driven_carried(&sat4_default, &x, phi_ddot, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_step_carry(&carry);
        written_state(&next);
    }
}

void sat4_eva_bits_step_driven_carried(void);
void sat4_eva_bits_step_driven_carried(void)
{
    sat4_state x;
    bits_state(&x);
    sat4_real phi_ddot[SAT4_N];
    all_bits(&phi_ddot[0], 4);
    sat4_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    sat4_step_carry carry;
    bits_step_carry(&carry);
    sat4_state next;
    const sat4_status status = sat4_step_driven_carried(&sat4_default, &x, phi_ddot, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        initialised_step_carry(&carry);
        initialised_state(&next);
    }
}

void sat4_eva_routine_sincos(void);
void sat4_eva_routine_sincos(void)
{
    sat4_real x;
    one_of_all(&x);
    sat4_real sine;
    sat4_real cosine;
    sat4_sincos(x, &sine, &cosine);
    Frama_C_show_each_returned(0);
}

void sat4_eva_routine_sqrt(void);
void sat4_eva_routine_sqrt(void)
{
    sat4_real x;
    one_of_all(&x);
    (void)sat4_sqrt(x);
    Frama_C_show_each_returned(0);
}

void sat4_eva_routine_check_state(void);
void sat4_eva_routine_check_state(void)
{
    sat4_state x;
    reals(x.position, 3, SAT4_LARGEST);
    reals(x.attitude, 4, SAT4_LARGEST);
    reals(x.V, 6, SAT4_LARGEST);
    reals(x.phi, 4, SAT4_LARGEST);
    reals(x.phi_dot, 4, SAT4_LARGEST);
    int beyond = 0;
    if (beyond == 0) { beyond = one_beyond(x.position, 3, 0x1.e848000000001p+19); }
    if (beyond == 0) { beyond = one_beyond(x.attitude, 4, 0x1.0000000000001p+1); }
    if (beyond == 0) { beyond = one_beyond(x.V, 6, 0x1.86a0000000001p+16); }
    if (beyond == 0) { beyond = one_beyond(x.V, 3, 0x1.3880000000001p+13); }
    if (beyond == 0) { beyond = one_beyond(x.phi, 4, 0x1.312d000000001p+23); }
    if (beyond == 0) { beyond = one_beyond(x.phi_dot, 4, 0x1.86a0000000001p+16); }
    if (beyond == 0) { reals(x.attitude, 4, 0.4993); }
    const sat4_status status = sat4_check_state(&x);
    Frama_C_show_each_returned(status);
    /*@ check status < 0; */
}

void sat4_eva_routine_check_motion(void);
void sat4_eva_routine_check_motion(void)
{
    sat4_state x;
    reals(x.position, 3, SAT4_LARGEST);
    reals(x.attitude, 4, SAT4_LARGEST);
    reals(x.V, 6, SAT4_LARGEST);
    reals(x.phi, 4, SAT4_LARGEST);
    reals(x.phi_dot, 4, SAT4_LARGEST);
    sat4_real values[SAT4_N];
    sat4_real limit, above;
    reals(values, 4, SAT4_LARGEST);
    switch (Frama_C_interval(0, 2)) {
    case 0: limit = SAT4_MAX_ACCELERATION; above = 0x1.dcd6500000001p+29; break;
    case 1: limit = SAT4_MAX_WRENCH; above = 0x1.dcd6500000001p+29; break;
    default: limit = SAT4_MAX_SPEED; above = 0x1.86a0000000001p+16; break;
    }
    int beyond = 0;
    if (beyond == 0) { beyond = one_beyond(x.position, 3, 0x1.e848000000001p+19); }
    if (beyond == 0) { beyond = one_beyond(x.attitude, 4, 0x1.0000000000001p+1); }
    if (beyond == 0) { beyond = one_beyond(x.V, 6, 0x1.86a0000000001p+16); }
    if (beyond == 0) { beyond = one_beyond(x.V, 3, 0x1.3880000000001p+13); }
    if (beyond == 0) { beyond = one_beyond(x.phi, 4, 0x1.312d000000001p+23); }
    if (beyond == 0) { beyond = one_beyond(x.phi_dot, 4, 0x1.86a0000000001p+16); }
    if (beyond == 0) { beyond = one_beyond(values, 4, above); }
    if (beyond == 0) { reals(x.attitude, 4, 0.4993); }
    const sat4_status status = sat4_check_motion(&x, values, limit);
    Frama_C_show_each_returned(status);
    /*@ check status < 0; */
}
#endif
