/* shaker2_eva.c: drivers of Frama-C Eva for the stand "shaker2": what is proved of shaker2.c. Run by shaker2_eva.sh.
 * mahovik 0.1.0; structure 94a85f4a, physics 2591b2a4. Generated: change the stand file instead.
 *
 * Only Frama-C reads this file: for compilers it is empty. A driver calls one function with all inputs of a set at once:
 *   normal   magnitudes of ordinary use: the numbers in the driver
 *   any      every finite number, every integer: what the checks of the function let through is all it computes with
 *   bits     every bit pattern: NaN and infinities as well
 * normal, any: Eva shows that no operation is undefined (index, uninitialised read, integer overflow, division by
 * zero) and that no real becomes infinite or NaN on the way, but in the sums of the checks; of the results, that they are written and finite where
 * the status is not negative, and untouched where it is. bits, with -warn-special-float none: the same, but nothing of
 * finiteness, for Eva 25 lets NaN pass a comparison that C does not. */
#include "../shaker2.h"

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
static void shaker2_sincos(shaker2_real x, shaker2_real *restrict sine, shaker2_real *restrict cosine);

/*@
    requires -10000000.0 <= x[0] <= 10000000.0;
    requires -10000000.0 <= x[1] <= 10000000.0;
    assigns sine[0 .. 1], cosine[0 .. 1] \from x[0 .. 1];
    ensures \initialized(sine + 0) && \initialized(cosine + 0);
    ensures \is_finite(sine[0]) && \is_finite(cosine[0]);
    ensures -1.0000002 <= sine[0] <= 1.0000002;
    ensures -1.0000002 <= cosine[0] <= 1.0000002;
    ensures \initialized(sine + 1) && \initialized(cosine + 1);
    ensures \is_finite(sine[1]) && \is_finite(cosine[1]);
    ensures -1.0000002 <= sine[1] <= 1.0000002;
    ensures -1.0000002 <= cosine[1] <= 1.0000002;
*/
static void shaker2_sincos_each(const shaker2_real *x, shaker2_real *restrict sine,
    shaker2_real *restrict cosine);

__PUSH_FC_STDLIB
/*@ requires x >= 0.0;
    assigns \result \from x; */
static shaker2_real shaker2_sqrt(shaker2_real x);
__POP_FC_STDLIB

/*@ assigns \result \from y, x;
    ensures \is_finite(\result);
    ensures -3.1415928 <= \result <= 3.1415928; */
static shaker2_real shaker2_atan2(shaker2_real y, shaker2_real x);

/* Checks have a quick way by sums of squares, of which intervals do not see that each number is within its limit. For the
 * sets normal and any they are what is said here; drivers of their own show it of their bodies, of all finite arguments:
 * with one number beyond its limit, or a quaternion without a large component, they refuse. */

#ifndef SHAKER2_EVA_BODIES  /* these drivers must not rest on what they show */
/*@ assigns \result \from *x;
    ensures (\result == 0
        && -SHAKER2_MAX_POSITION <= x->position[0] <= SHAKER2_MAX_POSITION
        && -SHAKER2_MAX_POSITION <= x->position[1] <= SHAKER2_MAX_POSITION
        && -SHAKER2_MAX_POSITION <= x->position[2] <= SHAKER2_MAX_POSITION
        && -2.0 <= x->attitude[0] <= 2.0
        && -2.0 <= x->attitude[1] <= 2.0
        && -2.0 <= x->attitude[2] <= 2.0
        && -2.0 <= x->attitude[3] <= 2.0
        && -SHAKER2_MAX_SPEED <= x->V[0] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_SPEED <= x->V[1] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_SPEED <= x->V[2] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_SPEED <= x->V[3] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_SPEED <= x->V[4] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_SPEED <= x->V[5] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_VELOCITY <= x->V[0] <= SHAKER2_MAX_VELOCITY
        && -SHAKER2_MAX_VELOCITY <= x->V[1] <= SHAKER2_MAX_VELOCITY
        && -SHAKER2_MAX_VELOCITY <= x->V[2] <= SHAKER2_MAX_VELOCITY
        && -SHAKER2_MAX_PHASE <= x->phi[0] <= SHAKER2_MAX_PHASE
        && -SHAKER2_MAX_PHASE <= x->phi[1] <= SHAKER2_MAX_PHASE
        && -SHAKER2_MAX_SPEED <= x->phi_dot[0] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_SPEED <= x->phi_dot[1] <= SHAKER2_MAX_SPEED
        && (x->attitude[0] >= 0.4992 || x->attitude[0] <= -0.4992 || x->attitude[1] >= 0.4992 || x->attitude[1] <= -0.4992 || x->attitude[2] >= 0.4992 || x->attitude[2] <= -0.4992 || x->attitude[3] >= 0.4992 || x->attitude[3] <= -0.4992)
        ) || \result < 0; */
static shaker2_status shaker2_check_state(const shaker2_state *x);

/*@ assigns \result \from *x, values[0 .. 1], limit;
    ensures (\result == 0
        && -SHAKER2_MAX_POSITION <= x->position[0] <= SHAKER2_MAX_POSITION
        && -SHAKER2_MAX_POSITION <= x->position[1] <= SHAKER2_MAX_POSITION
        && -SHAKER2_MAX_POSITION <= x->position[2] <= SHAKER2_MAX_POSITION
        && -2.0 <= x->attitude[0] <= 2.0
        && -2.0 <= x->attitude[1] <= 2.0
        && -2.0 <= x->attitude[2] <= 2.0
        && -2.0 <= x->attitude[3] <= 2.0
        && -SHAKER2_MAX_SPEED <= x->V[0] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_SPEED <= x->V[1] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_SPEED <= x->V[2] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_SPEED <= x->V[3] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_SPEED <= x->V[4] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_SPEED <= x->V[5] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_VELOCITY <= x->V[0] <= SHAKER2_MAX_VELOCITY
        && -SHAKER2_MAX_VELOCITY <= x->V[1] <= SHAKER2_MAX_VELOCITY
        && -SHAKER2_MAX_VELOCITY <= x->V[2] <= SHAKER2_MAX_VELOCITY
        && -SHAKER2_MAX_PHASE <= x->phi[0] <= SHAKER2_MAX_PHASE
        && -SHAKER2_MAX_PHASE <= x->phi[1] <= SHAKER2_MAX_PHASE
        && -SHAKER2_MAX_SPEED <= x->phi_dot[0] <= SHAKER2_MAX_SPEED
        && -SHAKER2_MAX_SPEED <= x->phi_dot[1] <= SHAKER2_MAX_SPEED
        && -limit <= values[0] <= limit
        && -limit <= values[1] <= limit
        && (x->attitude[0] >= 0.4992 || x->attitude[0] <= -0.4992 || x->attitude[1] >= 0.4992 || x->attitude[1] <= -0.4992 || x->attitude[2] >= 0.4992 || x->attitude[2] <= -0.4992 || x->attitude[3] >= 0.4992 || x->attitude[3] <= -0.4992)
        ) || \result < 0; */
static shaker2_status shaker2_check_motion(const shaker2_state *x, const shaker2_real values[SHAKER2_N],
                                           shaker2_real limit);

#endif

#include "../shaker2.c"

/* ---- sets of numbers ---- */

static shaker2_real real_in(shaker2_real low, shaker2_real high)
{
    return Frama_C_double_interval(low, high);
}

static void reals(shaker2_real *x, int count, shaker2_real size)
{
    for (int i = 0; i < count; ++i) { x[i] = real_in(-size, size); }
}

static volatile shaker2_real any_bits;  /* Eva: each read may give every bit pattern */

static void all_bits(shaker2_real *x, int count)
{
    for (int i = 0; i < count; ++i) { x[i] = any_bits; }
}

static void not_finite(shaker2_real *x)
{
    const shaker2_real zero = 0.0;
    switch (Frama_C_interval(0, 2)) {
    case 0: *x = 1.0 / zero; break;
    case 1: *x = -1.0 / zero; break;
    default: *x = zero / zero; break;
    }
}

/* One number of any bits, finite numbers apart from the others. */
static void one_of_all(shaker2_real *x)
{
    if (Frama_C_interval(0, 1) == 0) {
        not_finite(x);
    } else {
        *x = real_in(-SHAKER2_LARGEST, SHAKER2_LARGEST);
    }
}

static void integers(int *x, int count, int low, int high)
{
    for (int i = 0; i < count; ++i) { x[i] = Frama_C_interval(low, high); }
}

/* A number within one part in a hundred of another. */
static shaker2_real near(shaker2_real x)
{
    const shaker2_real a = x * 0.99;
    const shaker2_real b = x * 1.01;
    return a <= b ? real_in(a, b) : real_in(b, a);
}

static void about(shaker2_real *x, const shaker2_real *middle, int count)
{
    for (int i = 0; i < count; ++i) { x[i] = near(middle[i]); }
}

/* A quaternion. Where the sum of four squares is at least 0.998001, one of them is at least a quarter of that: so one
 * component is at least 0.499 in magnitude. Which, and its sign, are eight cases; all others are refused by
 * the checks, which the case without a large component shows. */
static void quaternion(shaker2_real q[4], shaker2_real size)
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
static int one_beyond(shaker2_real *x, int count, shaker2_real above)
{
    for (int i = 0; i < count; ++i) {
        if (Frama_C_interval(0, 1) == 0) {
            x[i] = (Frama_C_interval(0, 1) == 0) ? real_in(above, SHAKER2_LARGEST) : real_in(-SHAKER2_LARGEST, -above);
            return 1;
        }
    }
    return 0;
}

/* ---- what is asserted of results ---- */

static void written(const shaker2_real *x, int count)
{
    for (int i = 0; i < count; ++i) {
        /*@ check \initialized(&x[i]) && \is_finite(x[i]); */
    }
}

static void initialised(const shaker2_real *x, int count)
{
    for (int i = 0; i < count; ++i) {
        /*@ check \initialized(&x[i]); */
    }
}

static void untouched(const shaker2_real *x, int count)
{
    for (int i = 0; i < count; ++i) {
        /*@ check !\initialized(&x[i]); */
    }
}

/* ---- whole structs ---- */

static void normal_state(shaker2_state *x)
{
    reals(&x->position[0], 3, 100.0);
    quaternion(x->attitude, 2.0);
    reals(&x->V[0], 6, 20.0);
    reals(&x->phi[0], 2, 100.0);
    reals(&x->phi_dot[0], 2, 1.0e3);
}

static void any_state(shaker2_state *x)
{
    reals(&x->position[0], 3, SHAKER2_LARGEST);
    quaternion(x->attitude, SHAKER2_LARGEST);
    reals(&x->V[0], 6, SHAKER2_LARGEST);
    reals(&x->phi[0], 2, SHAKER2_LARGEST);
    reals(&x->phi_dot[0], 2, SHAKER2_LARGEST);
}

static void bits_state(shaker2_state *x)
{
    all_bits(&x->position[0], 3);
    all_bits(&x->attitude[0], 4);
    all_bits(&x->V[0], 6);
    all_bits(&x->phi[0], 2);
    all_bits(&x->phi_dot[0], 2);
}

static void normal_encoder(shaker2_encoder *x)
{
    integers(&x->counter, 1, -1048576, 1048576);
    integers(&x->place, 1, -1048576, 1048576);
    integers(&x->moved, 1, -1048576, 1048576);
}

static void any_encoder(shaker2_encoder *x)
{
    integers(&x->counter, 1, INT_MIN, INT_MAX);
    integers(&x->place, 1, INT_MIN, INT_MAX);
    integers(&x->moved, 1, INT_MIN, INT_MAX);
}

static void bits_encoder(shaker2_encoder *x)
{
    integers(&x->counter, 1, INT_MIN, INT_MAX);
    integers(&x->place, 1, INT_MIN, INT_MAX);
    integers(&x->moved, 1, INT_MIN, INT_MAX);
}

static void normal_inverse_options(shaker2_inverse_options *x)
{
    about(&x->weight[0], &shaker2_default_options.weight[0], 2);
    about(&x->limit[0], &shaker2_default_options.limit[0], 2);
    about(&x->most[0], &shaker2_default_options.most[0], 2);
    about(&x->motor_torque[0], &shaker2_default_options.motor_torque[0], 2);
    about(&x->motor_speed[0], &shaker2_default_options.motor_speed[0], 2);
    about(&x->motor_viscous[0], &shaker2_default_options.motor_viscous[0], 2);
    about(&x->motor_coulomb[0], &shaker2_default_options.motor_coulomb[0], 2);
    about(&x->motor_coulomb_speed[0], &shaker2_default_options.motor_coulomb_speed[0], 2);
    about(&x->near_singular, &shaker2_default_options.near_singular, 1);
    about(&x->damping, &shaker2_default_options.damping, 1);
}

static void any_inverse_options(shaker2_inverse_options *x)
{
    reals(&x->weight[0], 2, SHAKER2_LARGEST);
    reals(&x->limit[0], 2, SHAKER2_LARGEST);
    reals(&x->most[0], 2, SHAKER2_LARGEST);
    reals(&x->motor_torque[0], 2, SHAKER2_LARGEST);
    reals(&x->motor_speed[0], 2, SHAKER2_LARGEST);
    reals(&x->motor_viscous[0], 2, SHAKER2_LARGEST);
    reals(&x->motor_coulomb[0], 2, SHAKER2_LARGEST);
    reals(&x->motor_coulomb_speed[0], 2, SHAKER2_LARGEST);
    reals(&x->near_singular, 1, SHAKER2_LARGEST);
    reals(&x->damping, 1, SHAKER2_LARGEST);
}

static void bits_inverse_options(shaker2_inverse_options *x)
{
    all_bits(&x->weight[0], 2);
    all_bits(&x->limit[0], 2);
    all_bits(&x->most[0], 2);
    all_bits(&x->motor_torque[0], 2);
    all_bits(&x->motor_speed[0], 2);
    all_bits(&x->motor_viscous[0], 2);
    all_bits(&x->motor_coulomb[0], 2);
    all_bits(&x->motor_coulomb_speed[0], 2);
    one_of_all(&x->near_singular);
    one_of_all(&x->damping);
}

static void normal_parameters(shaker2_parameters *x)
{
    about(&x->carrier.mass, &shaker2_default_parameters.carrier.mass, 1);
    about(&x->carrier.center_of_mass[0], &shaker2_default_parameters.carrier.center_of_mass[0], 3);
    about(&x->carrier.inertia[0], &shaker2_default_parameters.carrier.inertia[0], 6);
    for (int i = 0; i < SHAKER2_N; ++i) {
        about(&x->flywheel[i].body.mass, &shaker2_default_parameters.flywheel[i].body.mass, 1);
        about(&x->flywheel[i].body.center_of_mass[0], &shaker2_default_parameters.flywheel[i].body.center_of_mass[0], 3);
        about(&x->flywheel[i].body.inertia[0], &shaker2_default_parameters.flywheel[i].body.inertia[0], 6);
        about(&x->flywheel[i].position[0], &shaker2_default_parameters.flywheel[i].position[0], 3);
        about(&x->flywheel[i].axis[0], &shaker2_default_parameters.flywheel[i].axis[0], 3);
        about(&x->flywheel[i].zero[0], &shaker2_default_parameters.flywheel[i].zero[0], 3);
    }
}

static void any_parameters(shaker2_parameters *x)
{
    reals(&x->carrier.mass, 1, SHAKER2_LARGEST);
    reals(&x->carrier.center_of_mass[0], 3, SHAKER2_LARGEST);
    reals(&x->carrier.inertia[0], 6, SHAKER2_LARGEST);
    for (int i = 0; i < SHAKER2_N; ++i) {
        reals(&x->flywheel[i].body.mass, 1, SHAKER2_LARGEST);
        reals(&x->flywheel[i].body.center_of_mass[0], 3, SHAKER2_LARGEST);
        reals(&x->flywheel[i].body.inertia[0], 6, SHAKER2_LARGEST);
        reals(&x->flywheel[i].position[0], 3, SHAKER2_LARGEST);
        reals(&x->flywheel[i].axis[0], 3, SHAKER2_LARGEST);
        reals(&x->flywheel[i].zero[0], 3, SHAKER2_LARGEST);
    }
}

static void bits_parameters(shaker2_parameters *x)
{
    one_of_all(&x->carrier.mass);
    all_bits(&x->carrier.center_of_mass[0], 3);
    all_bits(&x->carrier.inertia[0], 6);
    for (int i = 0; i < SHAKER2_N; ++i) {
        one_of_all(&x->flywheel[i].body.mass);
        all_bits(&x->flywheel[i].body.center_of_mass[0], 3);
        all_bits(&x->flywheel[i].body.inertia[0], 6);
        all_bits(&x->flywheel[i].position[0], 3);
        all_bits(&x->flywheel[i].axis[0], 3);
        all_bits(&x->flywheel[i].zero[0], 3);
    }
}

static void normal_step_carry(shaker2_step_carry *x)
{
    reals(&x->rounding[0], 17, 1.0e-6);
}

static void any_step_carry(shaker2_step_carry *x)
{
    reals(&x->rounding[0], 17, SHAKER2_LARGEST);
}

static void bits_step_carry(shaker2_step_carry *x)
{
    all_bits(&x->rounding[0], 17);
}

static void untouched_matrices_result(const shaker2_matrices_result *x)
{
    untouched(&x->K[0][0], 36);
    untouched(&x->K_dot[0][0], 36);
    untouched(&x->M[0][0], 36);
    untouched(&x->I_[0][0], 12);
    untouched(&x->J[0][0], 12);
    untouched(&x->F[0], 6);
}

static void written_matrices_result(const shaker2_matrices_result *x)
{
    written(&x->K[0][0], 36);
    written(&x->K_dot[0][0], 36);
    written(&x->M[0][0], 36);
    written(&x->I_[0][0], 12);
    written(&x->J[0][0], 12);
    written(&x->F[0], 6);
}

static void initialised_matrices_result(const shaker2_matrices_result *x)
{
    initialised(&x->K[0][0], 36);
    initialised(&x->K_dot[0][0], 36);
    initialised(&x->M[0][0], 36);
    initialised(&x->I_[0][0], 12);
    initialised(&x->J[0][0], 12);
    initialised(&x->F[0], 6);
}

static void untouched_momentum_result(const shaker2_momentum_result *x)
{
    untouched(&x->Z[0], 6);
    untouched(&x->Z0[0], 6);
    untouched(&x->energy, 1);
    untouched(&x->center_of_mass[0], 3);
    untouched(&x->center_of_mass_velocity[0], 3);
}

static void written_momentum_result(const shaker2_momentum_result *x)
{
    written(&x->Z[0], 6);
    written(&x->Z0[0], 6);
    written(&x->energy, 1);
    written(&x->center_of_mass[0], 3);
    written(&x->center_of_mass_velocity[0], 3);
}

static void initialised_momentum_result(const shaker2_momentum_result *x)
{
    initialised(&x->Z[0], 6);
    initialised(&x->Z0[0], 6);
    initialised(&x->energy, 1);
    initialised(&x->center_of_mass[0], 3);
    initialised(&x->center_of_mass_velocity[0], 3);
}

static void untouched_state(const shaker2_state *x)
{
    untouched(&x->position[0], 3);
    untouched(&x->attitude[0], 4);
    untouched(&x->V[0], 6);
    untouched(&x->phi[0], 2);
    untouched(&x->phi_dot[0], 2);
}

static void written_state(const shaker2_state *x)
{
    written(&x->position[0], 3);
    written(&x->attitude[0], 4);
    written(&x->V[0], 6);
    written(&x->phi[0], 2);
    written(&x->phi_dot[0], 2);
}

static void initialised_state(const shaker2_state *x)
{
    initialised(&x->position[0], 3);
    initialised(&x->attitude[0], 4);
    initialised(&x->V[0], 6);
    initialised(&x->phi[0], 2);
    initialised(&x->phi_dot[0], 2);
}

static void written_encoder(const shaker2_encoder *x)
{
    /*@ check \initialized(&x->counter); */
    /*@ check \initialized(&x->place); */
    /*@ check \initialized(&x->moved); */
}

static void initialised_encoder(const shaker2_encoder *x)
{
    /*@ check \initialized(&x->counter); */
    /*@ check \initialized(&x->place); */
    /*@ check \initialized(&x->moved); */
}

static void untouched_forward_jacobian_result(const shaker2_forward_jacobian_result *x)
{
    untouched(&x->V_dot_V[0][0], 36);
    untouched(&x->V_dot_phi[0][0], 12);
    untouched(&x->V_dot_phi_dot[0][0], 12);
    untouched(&x->V_dot_phi_ddot[0][0], 12);
}

static void written_forward_jacobian_result(const shaker2_forward_jacobian_result *x)
{
    written(&x->V_dot_V[0][0], 36);
    written(&x->V_dot_phi[0][0], 12);
    written(&x->V_dot_phi_dot[0][0], 12);
    written(&x->V_dot_phi_ddot[0][0], 12);
}

static void initialised_forward_jacobian_result(const shaker2_forward_jacobian_result *x)
{
    initialised(&x->V_dot_V[0][0], 36);
    initialised(&x->V_dot_phi[0][0], 12);
    initialised(&x->V_dot_phi_dot[0][0], 12);
    initialised(&x->V_dot_phi_ddot[0][0], 12);
}

static void untouched_coupled_jacobian_result(const shaker2_coupled_jacobian_result *x)
{
    untouched(&x->V_dot_V[0][0], 36);
    untouched(&x->V_dot_phi[0][0], 12);
    untouched(&x->V_dot_phi_dot[0][0], 12);
    untouched(&x->V_dot_tau[0][0], 12);
    untouched(&x->phi_ddot_V[0][0], 12);
    untouched(&x->phi_ddot_phi[0][0], 4);
    untouched(&x->phi_ddot_phi_dot[0][0], 4);
    untouched(&x->phi_ddot_tau[0][0], 4);
}

static void written_coupled_jacobian_result(const shaker2_coupled_jacobian_result *x)
{
    written(&x->V_dot_V[0][0], 36);
    written(&x->V_dot_phi[0][0], 12);
    written(&x->V_dot_phi_dot[0][0], 12);
    written(&x->V_dot_tau[0][0], 12);
    written(&x->phi_ddot_V[0][0], 12);
    written(&x->phi_ddot_phi[0][0], 4);
    written(&x->phi_ddot_phi_dot[0][0], 4);
    written(&x->phi_ddot_tau[0][0], 4);
}

static void initialised_coupled_jacobian_result(const shaker2_coupled_jacobian_result *x)
{
    initialised(&x->V_dot_V[0][0], 36);
    initialised(&x->V_dot_phi[0][0], 12);
    initialised(&x->V_dot_phi_dot[0][0], 12);
    initialised(&x->V_dot_tau[0][0], 12);
    initialised(&x->phi_ddot_V[0][0], 12);
    initialised(&x->phi_ddot_phi[0][0], 4);
    initialised(&x->phi_ddot_phi_dot[0][0], 4);
    initialised(&x->phi_ddot_tau[0][0], 4);
}

static void untouched_inverse_result(const shaker2_inverse_result *x)
{
    untouched(&x->phi_ddot[0], 2);
    untouched(&x->residual[0], 6);
    untouched(&x->sigma[0], 2);
    untouched(&x->damped_by, 1);
    untouched(&x->hardest[0], 6);
}

static void written_inverse_result(const shaker2_inverse_result *x)
{
    written(&x->phi_ddot[0], 2);
    written(&x->residual[0], 6);
    written(&x->sigma[0], 2);
    /*@ check \initialized(&x->rank); */
    written(&x->damped_by, 1);
    /*@ check \initialized(&x->limited[0]); */
    written(&x->hardest[0], 6);
}

static void initialised_inverse_result(const shaker2_inverse_result *x)
{
    initialised(&x->phi_ddot[0], 2);
    initialised(&x->residual[0], 6);
    initialised(&x->sigma[0], 2);
    /*@ check \initialized(&x->rank); */
    initialised(&x->damped_by, 1);
    /*@ check \initialized(&x->limited[0]); */
    initialised(&x->hardest[0], 6);
}

static void untouched_generalized_result(const shaker2_generalized_result *x)
{
    untouched(&x->A[0][0], 36);
    untouched(&x->D[0][0], 36);
    untouched(&x->I0[0][0], 36);
    untouched(&x->J0[0][0], 36);
    untouched(&x->q_dot[0], 6);
    untouched(&x->q_ddot[0], 6);
}

static void written_generalized_result(const shaker2_generalized_result *x)
{
    written(&x->A[0][0], 36);
    written(&x->D[0][0], 36);
    written(&x->I0[0][0], 36);
    written(&x->J0[0][0], 36);
    written(&x->q_dot[0], 6);
    written(&x->q_ddot[0], 6);
}

static void initialised_generalized_result(const shaker2_generalized_result *x)
{
    initialised(&x->A[0][0], 36);
    initialised(&x->D[0][0], 36);
    initialised(&x->I0[0][0], 36);
    initialised(&x->J0[0][0], 36);
    initialised(&x->q_dot[0], 6);
    initialised(&x->q_ddot[0], 6);
}

static void written_table(const shaker2_table *x)
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
    written(&x->gravity[0], 3);
    written(&x->suspension.stiffness[0][0], 36);
    written(&x->suspension.damping[0][0], 36);
    written(&x->suspension.position[0], 3);
    written(&x->suspension.attitude[0], 4);
}

static void initialised_table(const shaker2_table *x)
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
    initialised(&x->gravity[0], 3);
    initialised(&x->suspension.stiffness[0][0], 36);
    initialised(&x->suspension.damping[0][0], 36);
    initialised(&x->suspension.position[0], 3);
    initialised(&x->suspension.attitude[0], 4);
}

static void untouched_mount_table(const shaker2_mount_table *x)
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
}

static void written_mount_table(const shaker2_mount_table *x)
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
}

static void initialised_mount_table(const shaker2_mount_table *x)
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
}

static void written_step_carry(const shaker2_step_carry *x)
{
    written(&x->rounding[0], 17);
}

static void initialised_step_carry(const shaker2_step_carry *x)
{
    initialised(&x->rounding[0], 17);
}

/* ---- drivers: a function and a set each ---- */

void shaker2_eva_normal_forward(void);
void shaker2_eva_normal_forward(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, 1.0e4);
    shaker2_real V_dot[6];
    const shaker2_status status = shaker2_forward(&shaker2_default, &x, phi_ddot, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
    }
}

void shaker2_eva_any_forward(void);
void shaker2_eva_any_forward(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, SHAKER2_LARGEST);
    shaker2_real V_dot[6];
    const shaker2_status status = shaker2_forward(&shaker2_default, &x, phi_ddot, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
    }
}

void shaker2_eva_bits_forward(void);
void shaker2_eva_bits_forward(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_real phi_ddot[SHAKER2_N];
    all_bits(&phi_ddot[0], 2);
    shaker2_real V_dot[6];
    const shaker2_status status = shaker2_forward(&shaker2_default, &x, phi_ddot, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&V_dot[0], 6);
    }
}

void shaker2_eva_normal_matrices(void);
void shaker2_eva_normal_matrices(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_matrices_result out;
    const shaker2_status status = shaker2_matrices(&shaker2_default, &x, &out);
    if (status < 0) {
        untouched_matrices_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_matrices_result(&out);
    }
}

void shaker2_eva_any_matrices(void);
void shaker2_eva_any_matrices(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_matrices_result out;
    const shaker2_status status = shaker2_matrices(&shaker2_default, &x, &out);
    if (status < 0) {
        untouched_matrices_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_matrices_result(&out);
    }
}

void shaker2_eva_bits_matrices(void);
void shaker2_eva_bits_matrices(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_matrices_result out;
    const shaker2_status status = shaker2_matrices(&shaker2_default, &x, &out);
    if (status < 0) {
        untouched_matrices_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_matrices_result(&out);
    }
}

void shaker2_eva_normal_momentum(void);
void shaker2_eva_normal_momentum(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_momentum_result out;
    const shaker2_status status = shaker2_momentum(&shaker2_default, &x, &out);
    if (status < 0) {
        untouched_momentum_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_momentum_result(&out);
    }
}

void shaker2_eva_any_momentum(void);
void shaker2_eva_any_momentum(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_momentum_result out;
    const shaker2_status status = shaker2_momentum(&shaker2_default, &x, &out);
    if (status < 0) {
        untouched_momentum_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_momentum_result(&out);
    }
}

void shaker2_eva_bits_momentum(void);
void shaker2_eva_bits_momentum(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_momentum_result out;
    const shaker2_status status = shaker2_momentum(&shaker2_default, &x, &out);
    if (status < 0) {
        untouched_momentum_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_momentum_result(&out);
    }
}

void shaker2_eva_normal_torque(void);
void shaker2_eva_normal_torque(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, 1.0e4);
    shaker2_real tau[SHAKER2_N];
    const shaker2_status status = shaker2_torque(&shaker2_default, &x, V_dot, phi_ddot, tau);
    if (status < 0) {
        untouched(&tau[0], 2);
    } else {
        Frama_C_show_each_returned(status);
        written(&tau[0], 2);
    }
}

void shaker2_eva_any_torque(void);
void shaker2_eva_any_torque(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_real V_dot[6];
    reals(&V_dot[0], 6, SHAKER2_LARGEST);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, SHAKER2_LARGEST);
    shaker2_real tau[SHAKER2_N];
    const shaker2_status status = shaker2_torque(&shaker2_default, &x, V_dot, phi_ddot, tau);
    if (status < 0) {
        untouched(&tau[0], 2);
    } else {
        Frama_C_show_each_returned(status);
        written(&tau[0], 2);
    }
}

void shaker2_eva_bits_torque(void);
void shaker2_eva_bits_torque(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_real V_dot[6];
    all_bits(&V_dot[0], 6);
    shaker2_real phi_ddot[SHAKER2_N];
    all_bits(&phi_ddot[0], 2);
    shaker2_real tau[SHAKER2_N];
    const shaker2_status status = shaker2_torque(&shaker2_default, &x, V_dot, phi_ddot, tau);
    if (status < 0) {
        untouched(&tau[0], 2);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&tau[0], 2);
    }
}

void shaker2_eva_normal_coupled(void);
void shaker2_eva_normal_coupled(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_real tau[SHAKER2_N];
    reals(&tau[0], 2, 100.0);
    int locked[SHAKER2_N];
    integers(&locked[0], 2, 0, 1);
    shaker2_real V_dot[6];
    shaker2_real phi_ddot[SHAKER2_N];
    const shaker2_status status = shaker2_coupled(&shaker2_default, &x, tau, locked, V_dot, phi_ddot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
        untouched(&phi_ddot[0], 2);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
        written(&phi_ddot[0], 2);
    }
}

void shaker2_eva_any_coupled(void);
void shaker2_eva_any_coupled(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_real tau[SHAKER2_N];
    reals(&tau[0], 2, SHAKER2_LARGEST);
    int locked[SHAKER2_N];
    integers(&locked[0], 2, INT_MIN, INT_MAX);
    shaker2_real V_dot[6];
    shaker2_real phi_ddot[SHAKER2_N];
    const shaker2_status status = shaker2_coupled(&shaker2_default, &x, tau, locked, V_dot, phi_ddot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
        untouched(&phi_ddot[0], 2);
    } else {
        Frama_C_show_each_returned(status);
        written(&V_dot[0], 6);
        written(&phi_ddot[0], 2);
    }
}

void shaker2_eva_bits_coupled(void);
void shaker2_eva_bits_coupled(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_real tau[SHAKER2_N];
    all_bits(&tau[0], 2);
    int locked[SHAKER2_N];
    integers(&locked[0], 2, INT_MIN, INT_MAX);
    shaker2_real V_dot[6];
    shaker2_real phi_ddot[SHAKER2_N];
    const shaker2_status status = shaker2_coupled(&shaker2_default, &x, tau, locked, V_dot, phi_ddot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
        untouched(&phi_ddot[0], 2);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&V_dot[0], 6);
        initialised(&phi_ddot[0], 2);
    }
}

void shaker2_eva_normal_step(void);
void shaker2_eva_normal_step(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_real tau[SHAKER2_N];
    reals(&tau[0], 2, 100.0);
    int locked[SHAKER2_N];
    integers(&locked[0], 2, 0, 1);
    shaker2_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    shaker2_state next;
    const shaker2_status status = shaker2_step(&shaker2_default, &x, tau, locked, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&next);
    }
}

void shaker2_eva_any_step(void);
void shaker2_eva_any_step(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_real tau[SHAKER2_N];
    reals(&tau[0], 2, SHAKER2_LARGEST);
    int locked[SHAKER2_N];
    integers(&locked[0], 2, INT_MIN, INT_MAX);
    shaker2_real dt;
    reals(&dt, 1, SHAKER2_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    shaker2_state next;
    const shaker2_status status = shaker2_step(&shaker2_default, &x, tau, locked, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&next);
    }
}

void shaker2_eva_bits_step(void);
void shaker2_eva_bits_step(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_real tau[SHAKER2_N];
    all_bits(&tau[0], 2);
    int locked[SHAKER2_N];
    integers(&locked[0], 2, INT_MIN, INT_MAX);
    shaker2_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    shaker2_state next;
    const shaker2_status status = shaker2_step(&shaker2_default, &x, tau, locked, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        initialised_state(&next);
    }
}

void shaker2_eva_normal_step_driven(void);
void shaker2_eva_normal_step_driven(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, 1.0e4);
    shaker2_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    shaker2_state next;
    const shaker2_status status = shaker2_step_driven(&shaker2_default, &x, phi_ddot, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&next);
    }
}

void shaker2_eva_any_step_driven(void);
void shaker2_eva_any_step_driven(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, SHAKER2_LARGEST);
    shaker2_real dt;
    reals(&dt, 1, SHAKER2_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    shaker2_state next;
    const shaker2_status status = shaker2_step_driven(&shaker2_default, &x, phi_ddot, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&next);
    }
}

void shaker2_eva_bits_step_driven(void);
void shaker2_eva_bits_step_driven(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_real phi_ddot[SHAKER2_N];
    all_bits(&phi_ddot[0], 2);
    shaker2_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    shaker2_state next;
    const shaker2_status status = shaker2_step_driven(&shaker2_default, &x, phi_ddot, dt, order, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        initialised_state(&next);
    }
}

void shaker2_eva_normal_wrap(void);
void shaker2_eva_normal_wrap(void)
{
    shaker2_real phi;
    reals(&phi, 1, 100.0);
    shaker2_real wrapped;
    const shaker2_status status = shaker2_wrap(phi, &wrapped);
    if (status < 0) {
        untouched(&wrapped, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&wrapped, 1);
    }
}

void shaker2_eva_any_wrap(void);
void shaker2_eva_any_wrap(void)
{
    shaker2_real phi;
    reals(&phi, 1, SHAKER2_LARGEST);
    shaker2_real wrapped;
    const shaker2_status status = shaker2_wrap(phi, &wrapped);
    if (status < 0) {
        untouched(&wrapped, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&wrapped, 1);
    }
}

void shaker2_eva_bits_wrap(void);
void shaker2_eva_bits_wrap(void)
{
    shaker2_real phi;
    one_of_all(&phi);
    shaker2_real wrapped;
    const shaker2_status status = shaker2_wrap(phi, &wrapped);
    if (status < 0) {
        untouched(&wrapped, 1);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&wrapped, 1);
    }
}

void shaker2_eva_normal_phase_of_counts(void);
void shaker2_eva_normal_phase_of_counts(void)
{
    int count;
    integers(&count, 1, -1048576, 1048576);
    int per_turn;
    integers(&per_turn, 1, -100000, 100000);
    shaker2_real zero;
    reals(&zero, 1, 1.0e3);
    shaker2_real phi;
    const shaker2_status status = shaker2_phase_of_counts(count, per_turn, zero, &phi);
    if (status < 0) {
        untouched(&phi, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi, 1);
    }
}

void shaker2_eva_any_phase_of_counts(void);
void shaker2_eva_any_phase_of_counts(void)
{
    int count;
    integers(&count, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    shaker2_real zero;
    reals(&zero, 1, SHAKER2_LARGEST);
    shaker2_real phi;
    const shaker2_status status = shaker2_phase_of_counts(count, per_turn, zero, &phi);
    if (status < 0) {
        untouched(&phi, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi, 1);
    }
}

void shaker2_eva_bits_phase_of_counts(void);
void shaker2_eva_bits_phase_of_counts(void)
{
    int count;
    integers(&count, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    shaker2_real zero;
    one_of_all(&zero);
    shaker2_real phi;
    const shaker2_status status = shaker2_phase_of_counts(count, per_turn, zero, &phi);
    if (status < 0) {
        untouched(&phi, 1);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&phi, 1);
    }
}

void shaker2_eva_normal_speed_of_counts(void);
void shaker2_eva_normal_speed_of_counts(void)
{
    int moved;
    integers(&moved, 1, -1048576, 1048576);
    int per_turn;
    integers(&per_turn, 1, -100000, 100000);
    shaker2_real dt;
    dt = real_in(1.0e-6, 0.001);
    shaker2_real phi_dot;
    const shaker2_status status = shaker2_speed_of_counts(moved, per_turn, dt, &phi_dot);
    if (status < 0) {
        untouched(&phi_dot, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_dot, 1);
    }
}

void shaker2_eva_any_speed_of_counts(void);
void shaker2_eva_any_speed_of_counts(void)
{
    int moved;
    integers(&moved, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    shaker2_real dt;
    reals(&dt, 1, SHAKER2_LARGEST);
    shaker2_real phi_dot;
    const shaker2_status status = shaker2_speed_of_counts(moved, per_turn, dt, &phi_dot);
    if (status < 0) {
        untouched(&phi_dot, 1);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_dot, 1);
    }
}

void shaker2_eva_bits_speed_of_counts(void);
void shaker2_eva_bits_speed_of_counts(void)
{
    int moved;
    integers(&moved, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    shaker2_real dt;
    one_of_all(&dt);
    shaker2_real phi_dot;
    const shaker2_status status = shaker2_speed_of_counts(moved, per_turn, dt, &phi_dot);
    if (status < 0) {
        untouched(&phi_dot, 1);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&phi_dot, 1);
    }
}

void shaker2_eva_normal_accumulate(void);
void shaker2_eva_normal_accumulate(void)
{
    shaker2_encoder encoder;
    normal_encoder(&encoder);
    int counter;
    integers(&counter, 1, -1048576, 1048576);
    int bits;
    integers(&bits, 1, 0, 32);
    int per_turn;
    integers(&per_turn, 1, -100000, 100000);
    const shaker2_status status = shaker2_accumulate(&encoder, counter, bits, per_turn);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written_encoder(&encoder);
    }
}

void shaker2_eva_any_accumulate(void);
void shaker2_eva_any_accumulate(void)
{
    shaker2_encoder encoder;
    any_encoder(&encoder);
    int counter;
    integers(&counter, 1, INT_MIN, INT_MAX);
    int bits;
    integers(&bits, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    const shaker2_status status = shaker2_accumulate(&encoder, counter, bits, per_turn);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written_encoder(&encoder);
    }
}

void shaker2_eva_bits_accumulate(void);
void shaker2_eva_bits_accumulate(void)
{
    shaker2_encoder encoder;
    bits_encoder(&encoder);
    int counter;
    integers(&counter, 1, INT_MIN, INT_MAX);
    int bits;
    integers(&bits, 1, INT_MIN, INT_MAX);
    int per_turn;
    integers(&per_turn, 1, INT_MIN, INT_MAX);
    const shaker2_status status = shaker2_accumulate(&encoder, counter, bits, per_turn);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        initialised_encoder(&encoder);
    }
}

void shaker2_eva_normal_forward_jacobian(void);
void shaker2_eva_normal_forward_jacobian(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, 1.0e4);
    shaker2_forward_jacobian_result out;
    const shaker2_status status = shaker2_forward_jacobian(&shaker2_default, &x, phi_ddot, &out);
    if (status < 0) {
        untouched_forward_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_forward_jacobian_result(&out);
    }
}

void shaker2_eva_any_forward_jacobian(void);
void shaker2_eva_any_forward_jacobian(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, SHAKER2_LARGEST);
    shaker2_forward_jacobian_result out;
    const shaker2_status status = shaker2_forward_jacobian(&shaker2_default, &x, phi_ddot, &out);
    if (status < 0) {
        untouched_forward_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_forward_jacobian_result(&out);
    }
}

void shaker2_eva_bits_forward_jacobian(void);
void shaker2_eva_bits_forward_jacobian(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_real phi_ddot[SHAKER2_N];
    all_bits(&phi_ddot[0], 2);
    shaker2_forward_jacobian_result out;
    const shaker2_status status = shaker2_forward_jacobian(&shaker2_default, &x, phi_ddot, &out);
    if (status < 0) {
        untouched_forward_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_forward_jacobian_result(&out);
    }
}

void shaker2_eva_normal_coupled_jacobian(void);
void shaker2_eva_normal_coupled_jacobian(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_real tau[SHAKER2_N];
    reals(&tau[0], 2, 100.0);
    int locked[SHAKER2_N];
    integers(&locked[0], 2, 0, 1);
    shaker2_coupled_jacobian_result out;
    const shaker2_status status = shaker2_coupled_jacobian(&shaker2_default, &x, tau, locked, &out);
    if (status < 0) {
        untouched_coupled_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_coupled_jacobian_result(&out);
    }
}

void shaker2_eva_any_coupled_jacobian(void);
void shaker2_eva_any_coupled_jacobian(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_real tau[SHAKER2_N];
    reals(&tau[0], 2, SHAKER2_LARGEST);
    int locked[SHAKER2_N];
    integers(&locked[0], 2, INT_MIN, INT_MAX);
    shaker2_coupled_jacobian_result out;
    const shaker2_status status = shaker2_coupled_jacobian(&shaker2_default, &x, tau, locked, &out);
    if (status < 0) {
        untouched_coupled_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_coupled_jacobian_result(&out);
    }
}

void shaker2_eva_bits_coupled_jacobian(void);
void shaker2_eva_bits_coupled_jacobian(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_real tau[SHAKER2_N];
    all_bits(&tau[0], 2);
    int locked[SHAKER2_N];
    integers(&locked[0], 2, INT_MIN, INT_MAX);
    shaker2_coupled_jacobian_result out;
    const shaker2_status status = shaker2_coupled_jacobian(&shaker2_default, &x, tau, locked, &out);
    if (status < 0) {
        untouched_coupled_jacobian_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_coupled_jacobian_result(&out);
    }
}

void shaker2_eva_normal_inverse(void);
void shaker2_eva_normal_inverse(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    shaker2_inverse_options options;
    normal_inverse_options(&options);
    shaker2_inverse_result out;
    const shaker2_status status = shaker2_inverse(&shaker2_default, &x, V_dot, &options, &out);
    if (status < 0) {
        untouched_inverse_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_inverse_result(&out);
    }
}

void shaker2_eva_any_inverse(void);
void shaker2_eva_any_inverse(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_real V_dot[6];
    reals(&V_dot[0], 6, SHAKER2_LARGEST);
    shaker2_inverse_options options;
    any_inverse_options(&options);
    shaker2_inverse_result out;
    const shaker2_status status = shaker2_inverse(&shaker2_default, &x, V_dot, &options, &out);
    if (status < 0) {
        untouched_inverse_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_inverse_result(&out);
    }
}

void shaker2_eva_bits_inverse(void);
void shaker2_eva_bits_inverse(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_real V_dot[6];
    all_bits(&V_dot[0], 6);
    shaker2_inverse_options options;
    bits_inverse_options(&options);
    shaker2_inverse_result out;
    const shaker2_status status = shaker2_inverse(&shaker2_default, &x, V_dot, &options, &out);
    if (status < 0) {
        untouched_inverse_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_inverse_result(&out);
    }
}

void shaker2_eva_normal_inverse_fast(void);
void shaker2_eva_normal_inverse_fast(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    shaker2_inverse_options options;
    normal_inverse_options(&options);
    shaker2_real phi_ddot[SHAKER2_N];
    const shaker2_status status = shaker2_inverse_fast(&shaker2_default, &x, V_dot, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 2);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_ddot[0], 2);
    }
}

void shaker2_eva_any_inverse_fast(void);
void shaker2_eva_any_inverse_fast(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_real V_dot[6];
    reals(&V_dot[0], 6, SHAKER2_LARGEST);
    shaker2_inverse_options options;
    any_inverse_options(&options);
    shaker2_real phi_ddot[SHAKER2_N];
    const shaker2_status status = shaker2_inverse_fast(&shaker2_default, &x, V_dot, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 2);
    } else {
        Frama_C_show_each_returned(status);
        written(&phi_ddot[0], 2);
    }
}

void shaker2_eva_bits_inverse_fast(void);
void shaker2_eva_bits_inverse_fast(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_real V_dot[6];
    all_bits(&V_dot[0], 6);
    shaker2_inverse_options options;
    bits_inverse_options(&options);
    shaker2_real phi_ddot[SHAKER2_N];
    const shaker2_status status = shaker2_inverse_fast(&shaker2_default, &x, V_dot, &options, phi_ddot);
    if (status < 0) {
        untouched(&phi_ddot[0], 2);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&phi_ddot[0], 2);
    }
}

void shaker2_eva_normal_quaternion(void);
void shaker2_eva_normal_quaternion(void)
{
    shaker2_real angles[3];
    reals(&angles[0], 3, 7.0);
    shaker2_real attitude[4];
    const shaker2_status status = shaker2_quaternion(angles, attitude);
    if (status < 0) {
        untouched(&attitude[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&attitude[0], 4);
    }
}

void shaker2_eva_any_quaternion(void);
void shaker2_eva_any_quaternion(void)
{
    shaker2_real angles[3];
    reals(&angles[0], 3, SHAKER2_LARGEST);
    shaker2_real attitude[4];
    const shaker2_status status = shaker2_quaternion(angles, attitude);
    if (status < 0) {
        untouched(&attitude[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        written(&attitude[0], 4);
    }
}

void shaker2_eva_bits_quaternion(void);
void shaker2_eva_bits_quaternion(void)
{
    shaker2_real angles[3];
    all_bits(&angles[0], 3);
    shaker2_real attitude[4];
    const shaker2_status status = shaker2_quaternion(angles, attitude);
    if (status < 0) {
        untouched(&attitude[0], 4);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&attitude[0], 4);
    }
}

void shaker2_eva_normal_state_from_coordinates(void);
void shaker2_eva_normal_state_from_coordinates(void)
{
    shaker2_real position[3];
    reals(&position[0], 3, 100.0);
    shaker2_real angles[3];
    reals(&angles[0], 3, 7.0);
    shaker2_real q_dot[6];
    reals(&q_dot[0], 6, 20.0);
    shaker2_real q_ddot[6];
    reals(&q_ddot[0], 6, 1.0e3);
    shaker2_state x;
    normal_state(&x);
    shaker2_real V_dot[6];
    const shaker2_status status = shaker2_state_from_coordinates(position, angles, q_dot, q_ddot, &x, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&x);
        written(&V_dot[0], 6);
    }
}

void shaker2_eva_any_state_from_coordinates(void);
void shaker2_eva_any_state_from_coordinates(void)
{
    shaker2_real position[3];
    reals(&position[0], 3, SHAKER2_LARGEST);
    shaker2_real angles[3];
    reals(&angles[0], 3, SHAKER2_LARGEST);
    shaker2_real q_dot[6];
    reals(&q_dot[0], 6, SHAKER2_LARGEST);
    shaker2_real q_ddot[6];
    reals(&q_ddot[0], 6, SHAKER2_LARGEST);
    shaker2_state x;
    any_state(&x);
    shaker2_real V_dot[6];
    const shaker2_status status = shaker2_state_from_coordinates(position, angles, q_dot, q_ddot, &x, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        written_state(&x);
        written(&V_dot[0], 6);
    }
}

void shaker2_eva_bits_state_from_coordinates(void);
void shaker2_eva_bits_state_from_coordinates(void)
{
    shaker2_real position[3];
    all_bits(&position[0], 3);
    shaker2_real angles[3];
    all_bits(&angles[0], 3);
    shaker2_real q_dot[6];
    all_bits(&q_dot[0], 6);
    shaker2_real q_ddot[6];
    all_bits(&q_ddot[0], 6);
    shaker2_state x;
    bits_state(&x);
    shaker2_real V_dot[6];
    const shaker2_status status = shaker2_state_from_coordinates(position, angles, q_dot, q_ddot, &x, V_dot);
    if (status < 0) {
        untouched(&V_dot[0], 6);
    } else {
        Frama_C_show_each_returned(status);
        initialised_state(&x);
        initialised(&V_dot[0], 6);
    }
}

void shaker2_eva_normal_generalized(void);
void shaker2_eva_normal_generalized(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_real angles[3];
    reals(&angles[0], 3, 7.0);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, 1.0e4);
    shaker2_generalized_result out;
    const shaker2_status status = shaker2_generalized(&shaker2_default, &x, angles, phi_ddot, &out);
    if (status < 0) {
        untouched_generalized_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_generalized_result(&out);
    }
}

void shaker2_eva_any_generalized(void);
void shaker2_eva_any_generalized(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_real angles[3];
    reals(&angles[0], 3, SHAKER2_LARGEST);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, SHAKER2_LARGEST);
    shaker2_generalized_result out;
    const shaker2_status status = shaker2_generalized(&shaker2_default, &x, angles, phi_ddot, &out);
    if (status < 0) {
        untouched_generalized_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        written_generalized_result(&out);
    }
}

void shaker2_eva_bits_generalized(void);
void shaker2_eva_bits_generalized(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_real angles[3];
    all_bits(&angles[0], 3);
    shaker2_real phi_ddot[SHAKER2_N];
    all_bits(&phi_ddot[0], 2);
    shaker2_generalized_result out;
    const shaker2_status status = shaker2_generalized(&shaker2_default, &x, angles, phi_ddot, &out);
    if (status < 0) {
        untouched_generalized_result(&out);
    } else {
        Frama_C_show_each_returned(status);
        initialised_generalized_result(&out);
    }
}

void shaker2_eva_normal_prepare(void);
void shaker2_eva_normal_prepare(void)
{
    shaker2_parameters parameters;
    normal_parameters(&parameters);
    shaker2_table table = shaker2_default;
    const shaker2_status status = shaker2_prepare(&parameters, &table);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written_table(&table);
    }
}

void shaker2_eva_any_prepare(void);
void shaker2_eva_any_prepare(void)
{
    shaker2_parameters parameters;
    any_parameters(&parameters);
    shaker2_table table = shaker2_default;
    const shaker2_status status = shaker2_prepare(&parameters, &table);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        written_table(&table);
    }
}

void shaker2_eva_bits_prepare(void);
void shaker2_eva_bits_prepare(void)
{
    shaker2_parameters parameters;
    bits_parameters(&parameters);
    shaker2_table table = shaker2_default;
    const shaker2_status status = shaker2_prepare(&parameters, &table);
    if (status < 0) {
    } else {
        Frama_C_show_each_returned(status);
        initialised_table(&table);
    }
}

void shaker2_eva_normal_mounts(void);
void shaker2_eva_normal_mounts(void)
{
    shaker2_mount_table mounting;
    (void)shaker2_prepare_mounts(&shaker2_default_parameters, &mounting);
    shaker2_state x;
    normal_state(&x);
    shaker2_real V_dot[6];
    reals(&V_dot[0], 6, 1.0e3);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, 1.0e4);
    shaker2_real mount_wrench[12];
    const shaker2_status status = shaker2_mounts(&shaker2_default, &mounting, &x, V_dot, phi_ddot, mount_wrench);
    if (status < 0) {
        untouched(&mount_wrench[0], 12);
    } else {
        Frama_C_show_each_returned(status);
        written(&mount_wrench[0], 12);
    }
}

void shaker2_eva_any_mounts(void);
void shaker2_eva_any_mounts(void)
{
    shaker2_mount_table mounting;
    (void)shaker2_prepare_mounts(&shaker2_default_parameters, &mounting);
    shaker2_state x;
    any_state(&x);
    shaker2_real V_dot[6];
    reals(&V_dot[0], 6, SHAKER2_LARGEST);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, SHAKER2_LARGEST);
    shaker2_real mount_wrench[12];
    const shaker2_status status = shaker2_mounts(&shaker2_default, &mounting, &x, V_dot, phi_ddot, mount_wrench);
    if (status < 0) {
        untouched(&mount_wrench[0], 12);
    } else {
        Frama_C_show_each_returned(status);
        written(&mount_wrench[0], 12);
    }
}

void shaker2_eva_bits_mounts(void);
void shaker2_eva_bits_mounts(void)
{
    shaker2_mount_table mounting;
    (void)shaker2_prepare_mounts(&shaker2_default_parameters, &mounting);
    shaker2_state x;
    bits_state(&x);
    shaker2_real V_dot[6];
    all_bits(&V_dot[0], 6);
    shaker2_real phi_ddot[SHAKER2_N];
    all_bits(&phi_ddot[0], 2);
    shaker2_real mount_wrench[12];
    const shaker2_status status = shaker2_mounts(&shaker2_default, &mounting, &x, V_dot, phi_ddot, mount_wrench);
    if (status < 0) {
        untouched(&mount_wrench[0], 12);
    } else {
        Frama_C_show_each_returned(status);
        initialised(&mount_wrench[0], 12);
    }
}

void shaker2_eva_normal_prepare_mounts(void);
void shaker2_eva_normal_prepare_mounts(void)
{
    shaker2_parameters parameters;
    normal_parameters(&parameters);
    shaker2_mount_table mounting;
    const shaker2_status status = shaker2_prepare_mounts(&parameters, &mounting);
    if (status < 0) {
        untouched_mount_table(&mounting);
    } else {
        Frama_C_show_each_returned(status);
        written_mount_table(&mounting);
    }
}

void shaker2_eva_any_prepare_mounts(void);
void shaker2_eva_any_prepare_mounts(void)
{
    shaker2_parameters parameters;
    any_parameters(&parameters);
    shaker2_mount_table mounting;
    const shaker2_status status = shaker2_prepare_mounts(&parameters, &mounting);
    if (status < 0) {
        untouched_mount_table(&mounting);
    } else {
        Frama_C_show_each_returned(status);
        written_mount_table(&mounting);
    }
}

void shaker2_eva_bits_prepare_mounts(void);
void shaker2_eva_bits_prepare_mounts(void)
{
    shaker2_parameters parameters;
    bits_parameters(&parameters);
    shaker2_mount_table mounting;
    const shaker2_status status = shaker2_prepare_mounts(&parameters, &mounting);
    if (status < 0) {
        untouched_mount_table(&mounting);
    } else {
        Frama_C_show_each_returned(status);
        initialised_mount_table(&mounting);
    }
}

void shaker2_eva_normal_step_carried(void);
void shaker2_eva_normal_step_carried(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_real tau[SHAKER2_N];
    reals(&tau[0], 2, 100.0);
    int locked[SHAKER2_N];
    integers(&locked[0], 2, 0, 1);
    shaker2_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    shaker2_step_carry carry;
    normal_step_carry(&carry);
    shaker2_state next;
    const shaker2_status status = shaker2_step_carried(&shaker2_default, &x, tau, locked, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_step_carry(&carry);
        written_state(&next);
    }
}

void shaker2_eva_any_step_carried(void);
void shaker2_eva_any_step_carried(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_real tau[SHAKER2_N];
    reals(&tau[0], 2, SHAKER2_LARGEST);
    int locked[SHAKER2_N];
    integers(&locked[0], 2, INT_MIN, INT_MAX);
    shaker2_real dt;
    reals(&dt, 1, SHAKER2_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    shaker2_step_carry carry;
    any_step_carry(&carry);
    shaker2_state next;
    const shaker2_status status = shaker2_step_carried(&shaker2_default, &x, tau, locked, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_step_carry(&carry);
        written_state(&next);
    }
}

void shaker2_eva_bits_step_carried(void);
void shaker2_eva_bits_step_carried(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_real tau[SHAKER2_N];
    all_bits(&tau[0], 2);
    int locked[SHAKER2_N];
    integers(&locked[0], 2, INT_MIN, INT_MAX);
    shaker2_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    shaker2_step_carry carry;
    bits_step_carry(&carry);
    shaker2_state next;
    const shaker2_status status = shaker2_step_carried(&shaker2_default, &x, tau, locked, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        initialised_step_carry(&carry);
        initialised_state(&next);
    }
}

void shaker2_eva_normal_step_driven_carried(void);
void shaker2_eva_normal_step_driven_carried(void)
{
    shaker2_state x;
    normal_state(&x);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, 1.0e4);
    shaker2_real dt;
    dt = real_in(1.0e-6, 0.001);
    int order;
    integers(&order, 1, 2, 4);
    shaker2_step_carry carry;
    normal_step_carry(&carry);
    shaker2_state next;
    const shaker2_status status = shaker2_step_driven_carried(&shaker2_default, &x, phi_ddot, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_step_carry(&carry);
        written_state(&next);
    }
}

void shaker2_eva_any_step_driven_carried(void);
void shaker2_eva_any_step_driven_carried(void)
{
    shaker2_state x;
    any_state(&x);
    shaker2_real phi_ddot[SHAKER2_N];
    reals(&phi_ddot[0], 2, SHAKER2_LARGEST);
    shaker2_real dt;
    reals(&dt, 1, SHAKER2_LARGEST);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    shaker2_step_carry carry;
    any_step_carry(&carry);
    shaker2_state next;
    const shaker2_status status = shaker2_step_driven_carried(&shaker2_default, &x, phi_ddot, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        written_step_carry(&carry);
        written_state(&next);
    }
}

void shaker2_eva_bits_step_driven_carried(void);
void shaker2_eva_bits_step_driven_carried(void)
{
    shaker2_state x;
    bits_state(&x);
    shaker2_real phi_ddot[SHAKER2_N];
    all_bits(&phi_ddot[0], 2);
    shaker2_real dt;
    one_of_all(&dt);
    int order;
    integers(&order, 1, INT_MIN, INT_MAX);
    shaker2_step_carry carry;
    bits_step_carry(&carry);
    shaker2_state next;
    const shaker2_status status = shaker2_step_driven_carried(&shaker2_default, &x, phi_ddot, dt, order, &carry, &next);
    if (status < 0) {
        untouched_state(&next);
    } else {
        Frama_C_show_each_returned(status);
        initialised_step_carry(&carry);
        initialised_state(&next);
    }
}

void shaker2_eva_routine_sincos(void);
void shaker2_eva_routine_sincos(void)
{
    shaker2_real x;
    one_of_all(&x);
    shaker2_real sine;
    shaker2_real cosine;
    shaker2_sincos(x, &sine, &cosine);
    Frama_C_show_each_returned(0);
}

void shaker2_eva_routine_sqrt(void);
void shaker2_eva_routine_sqrt(void)
{
    shaker2_real x;
    one_of_all(&x);
    (void)shaker2_sqrt(x);
    Frama_C_show_each_returned(0);
}

void shaker2_eva_routine_atan2(void);
void shaker2_eva_routine_atan2(void)
{
    shaker2_real y;
    one_of_all(&y);
    shaker2_real x;
    one_of_all(&x);
    (void)shaker2_atan2(y, x);
    Frama_C_show_each_returned(0);
}

void shaker2_eva_routine_check_state(void);
void shaker2_eva_routine_check_state(void)
{
    shaker2_state x;
    reals(x.position, 3, SHAKER2_LARGEST);
    reals(x.attitude, 4, SHAKER2_LARGEST);
    reals(x.V, 6, SHAKER2_LARGEST);
    reals(x.phi, 2, SHAKER2_LARGEST);
    reals(x.phi_dot, 2, SHAKER2_LARGEST);
    int beyond = 0;
    if (beyond == 0) { beyond = one_beyond(x.position, 3, 0x1.e848000000001p+19); }
    if (beyond == 0) { beyond = one_beyond(x.attitude, 4, 0x1.0000000000001p+1); }
    if (beyond == 0) { beyond = one_beyond(x.V, 6, 0x1.86a0000000001p+16); }
    if (beyond == 0) { beyond = one_beyond(x.V, 3, 0x1.3880000000001p+13); }
    if (beyond == 0) { beyond = one_beyond(x.phi, 2, 0x1.312d000000001p+23); }
    if (beyond == 0) { beyond = one_beyond(x.phi_dot, 2, 0x1.86a0000000001p+16); }
    if (beyond == 0) { reals(x.attitude, 4, 0.4993); }
    const shaker2_status status = shaker2_check_state(&x);
    Frama_C_show_each_returned(status);
    /*@ check status < 0; */
}

void shaker2_eva_routine_check_motion(void);
void shaker2_eva_routine_check_motion(void)
{
    shaker2_state x;
    reals(x.position, 3, SHAKER2_LARGEST);
    reals(x.attitude, 4, SHAKER2_LARGEST);
    reals(x.V, 6, SHAKER2_LARGEST);
    reals(x.phi, 2, SHAKER2_LARGEST);
    reals(x.phi_dot, 2, SHAKER2_LARGEST);
    shaker2_real values[SHAKER2_N];
    shaker2_real limit, above;
    reals(values, 2, SHAKER2_LARGEST);
    switch (Frama_C_interval(0, 2)) {
    case 0: limit = SHAKER2_MAX_ACCELERATION; above = 0x1.dcd6500000001p+29; break;
    case 1: limit = SHAKER2_MAX_WRENCH; above = 0x1.dcd6500000001p+29; break;
    default: limit = SHAKER2_MAX_SPEED; above = 0x1.86a0000000001p+16; break;
    }
    int beyond = 0;
    if (beyond == 0) { beyond = one_beyond(x.position, 3, 0x1.e848000000001p+19); }
    if (beyond == 0) { beyond = one_beyond(x.attitude, 4, 0x1.0000000000001p+1); }
    if (beyond == 0) { beyond = one_beyond(x.V, 6, 0x1.86a0000000001p+16); }
    if (beyond == 0) { beyond = one_beyond(x.V, 3, 0x1.3880000000001p+13); }
    if (beyond == 0) { beyond = one_beyond(x.phi, 2, 0x1.312d000000001p+23); }
    if (beyond == 0) { beyond = one_beyond(x.phi_dot, 2, 0x1.86a0000000001p+16); }
    if (beyond == 0) { beyond = one_beyond(values, 2, above); }
    if (beyond == 0) { reals(x.attitude, 4, 0.4993); }
    const shaker2_status status = shaker2_check_motion(&x, values, limit);
    Frama_C_show_each_returned(status);
    /*@ check status < 0; */
}
#endif
