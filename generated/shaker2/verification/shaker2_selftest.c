/* shaker2_selftest.c: does shaker2.c give the right bits on this machine?
 * With -ffast-math or its parts it gives wrong results with status OK: this test fails.
 * mahovik 0.1.0; structure 94a85f4a, physics 2591b2a4. Generated: change the stand file instead.
 *
 * Compile it with shaker2.c as firmware is compiled (-std=c99 -ffp-contract=off; -fno-tree-vectorize as well by gcc
 * for x86-64 with FMA and for a Cortex-M55, or bits differ) and with
 * -DSHAKER2_SELFTEST_MAIN, and run it; on a board, without that macro, call shaker2_selftest with a function that
 * prints a text, such as to a serial port.
 * Golden vectors: inputs and answers of the generator's interpreter as hexadecimal constants; each bit must agree.
 * Trials: the first of them with a few inputs changed: every status, wrong numbers, null pointers; known as well.
 * Sweep: states drawn by an integer generator; one hash per function of all its answers is printed, to be
 * compared between machines. The log of a board is judged by `mahovik judge-log STAND.toml --log LOG`. It reads:
 *
 *     wrong results: compiled with ...   only if that is so: first, and then functions FAIL
 *     mahovik selftest shaker2 structure 94a85f4a physics 2591b2a4 real double
 *     generator mahovik 0.1.0
 *     forward PASS cases 5 worst 0 ulp      one line per function; FAIL gives the number of wrong cases and
 *                                        what is wrong of them, such as "(status, numbers)"; with numbers worst is
 *                                        their largest distance, or "more than 1000000"
 *     sweep 100                          states
 *     forward 0123abcd                   one line per function: FNV-1a hash of its statuses and outputs
 *     failures 0                         functions that failed; the last line
 *
 * No allocation. It keeps inputs and results in static memory: one caller at a time. */
#include "../shaker2.h"

#include <float.h>
#include <stddef.h>
#include <stdint.h>
#ifdef SHAKER2_SELFTEST_MAIN
#include <stdio.h>
#endif

#if SHAKER2_STRUCTURE != 0x94a85f4au || SHAKER2_PHYSICS != 0x2591b2a4u
#error "shaker2.h and shaker2_selftest.c are of different stands"
#endif

#ifndef SHAKER2_SELFTEST_SWEEP
#define SHAKER2_SELFTEST_SWEEP 100ul  /* states of the sweep that main runs */
#endif

int shaker2_selftest(void (*print)(const char *text), unsigned long sweep);

typedef uint64_t real_bits;

enum { CASES = 3, FUNCTIONS = 23, SWEPT = 4 };

#define FARTHEST ((real_bits)1000000u)  /* ulp: a worse distance is not printed as a number */

/* ---- inputs and results ---- */

/* Arguments of the functions, apart from the constants of the stand. */
typedef struct inputs {
    shaker2_state x;
    shaker2_real phi_ddot[SHAKER2_N];
    shaker2_real V_dot[6];
    shaker2_real tau[SHAKER2_N];
    int locked[SHAKER2_N];
    shaker2_real dt;
    int order;
    shaker2_real phi;
    int count;
    int per_turn;
    shaker2_real zero;
    int moved;
    shaker2_encoder encoder;
    int counter;
    int bits;
    shaker2_real angles[3];
    shaker2_real position[3];
    shaker2_real q_dot[6];
    shaker2_real q_ddot[6];
    shaker2_step_carry carry;
    shaker2_real mass_factor;  /* multiplies all masses and inertias of the parameters */
} inputs;

static inputs in;
static shaker2_parameters parameters;
static const shaker2_table *table = &shaker2_default;
static shaker2_inverse_options options;
static int omitted;  /* the argument that is null, from 1; 0: none; -1: all that may be null */
static shaker2_mount_table mounting;

static union {
    struct { shaker2_real V_dot[6]; } forward;
    struct { shaker2_matrices_result out; } matrices;
    struct { shaker2_momentum_result out; } momentum;
    struct { shaker2_real tau[SHAKER2_N]; } torque;
    struct { shaker2_real V_dot[6]; shaker2_real phi_ddot[SHAKER2_N]; } coupled;
    struct { shaker2_state next; } step;
    struct { shaker2_state next; } step_driven;
    struct { shaker2_real wrapped; } wrap;
    struct { shaker2_real phi; } phase_of_counts;
    struct { shaker2_real phi_dot; } speed_of_counts;
    struct { shaker2_encoder encoder; } accumulate;
    struct { shaker2_forward_jacobian_result out; } forward_jacobian;
    struct { shaker2_coupled_jacobian_result out; } coupled_jacobian;
    struct { shaker2_inverse_result out; } inverse;
    struct { shaker2_real phi_ddot[SHAKER2_N]; } inverse_fast;
    struct { shaker2_real attitude[4]; } quaternion;
    struct { shaker2_state x; shaker2_real V_dot[6]; } state_from_coordinates;
    struct { shaker2_generalized_result out; } generalized;
    struct { shaker2_table table; } prepare;
    struct { shaker2_real mount_wrench[12]; } mounts;
    struct { shaker2_mount_table mounting; } prepare_mounts;
    struct { shaker2_step_carry carry; shaker2_state next; } step_carried;
    struct { shaker2_step_carry carry; shaker2_state next; } step_driven_carried;
    unsigned char bytes[1];
} results;

/* Numbers that no literal of C99 is. */
typedef union special { real_bits word; shaker2_real real; } special;
static const special infinite = { 0x7ff0000000000000u };
static const special not_a_number = { 0x7ff8000000000000u };

enum { UNTOUCHED = 0x5a };  /* value of every byte of the results before a call */

/* ---- results: their hash, and their distance from the expected numbers ---- */

typedef struct tally {
    uint32_t hash;                /* FNV-1a of all bits so far, the lowest byte of a number first */
    const shaker2_real *expected;  /* next expected numbers, `left` of them */
    int left;
    int touched;                  /* results that were written although the call was refused */
    real_bits worst;              /* ulp */
} tally;

static void begin(tally *sum)
{
    sum->hash = 2166136261u;
    sum->expected = NULL;
    sum->left = 0;
    sum->touched = 0;
    sum->worst = 0u;
}

static void take_word(tally *sum, real_bits word, int bytes)
{
    for (int i = 0; i < bytes; ++i) {
        sum->hash = (sum->hash ^ (uint32_t)(word & 0xffu)) * 16777619u;
        word = word >> 8;
    }
}

static real_bits bits_of(shaker2_real value)
{
    union { shaker2_real real; real_bits word; } both;
    both.real = value;
    return both.word;
}

/* Count of representable numbers between two reals, from their bits. */
static real_bits ulp_between(real_bits a, real_bits b)
{
    const real_bits sign = (real_bits)1u << 63;
    const real_bits x = (a & sign) != 0u ? sign - (a & ~sign) : sign + a;
    const real_bits y = (b & sign) != 0u ? sign - (b & ~sign) : sign + b;
    return x > y ? x - y : y - x;
}

static void take_reals(tally *sum, const shaker2_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        const real_bits word = bits_of(values[i]);
        take_word(sum, word, 8);
        if (sum->left > 0) {
            const real_bits off = ulp_between(word, bits_of(*sum->expected));
            sum->worst = off > sum->worst ? off : sum->worst;
            sum->expected++;
            sum->left--;
        }
    }
}

static void take_ints(tally *sum, const int *values, int count)
{
    for (int i = 0; i < count; ++i) {
        take_word(sum, (real_bits)(uint32_t)values[i], 4);
    }
}

static void take_matrices_result(tally *sum, const shaker2_matrices_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->K[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->K_dot[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->M[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->I_[i], SHAKER2_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->J[i], SHAKER2_N);
    }
    take_reals(sum, value->F, 6);
}

static void take_momentum_result(tally *sum, const shaker2_momentum_result *value)
{
    take_reals(sum, value->Z, 6);
    take_reals(sum, value->Z0, 6);
    take_reals(sum, &value->energy, 1);
    take_reals(sum, value->center_of_mass, 3);
    take_reals(sum, value->center_of_mass_velocity, 3);
}

static void take_state(tally *sum, const shaker2_state *value)
{
    take_reals(sum, value->position, 3);
    take_reals(sum, value->attitude, 4);
    take_reals(sum, value->V, 6);
    take_reals(sum, value->phi, SHAKER2_N);
    take_reals(sum, value->phi_dot, SHAKER2_N);
}

static void take_encoder(tally *sum, const shaker2_encoder *value)
{
    take_ints(sum, &value->counter, 1);
    take_ints(sum, &value->place, 1);
    take_ints(sum, &value->moved, 1);
}

static void take_forward_jacobian_result(tally *sum, const shaker2_forward_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], SHAKER2_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], SHAKER2_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_ddot[i], SHAKER2_N);
    }
}

static void take_coupled_jacobian_result(tally *sum, const shaker2_coupled_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], SHAKER2_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], SHAKER2_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_tau[i], SHAKER2_N);
    }
    for (int i = 0; i < SHAKER2_N; ++i) {
        take_reals(sum, value->phi_ddot_V[i], 6);
    }
    for (int i = 0; i < SHAKER2_N; ++i) {
        take_reals(sum, value->phi_ddot_phi[i], SHAKER2_N);
    }
    for (int i = 0; i < SHAKER2_N; ++i) {
        take_reals(sum, value->phi_ddot_phi_dot[i], SHAKER2_N);
    }
    for (int i = 0; i < SHAKER2_N; ++i) {
        take_reals(sum, value->phi_ddot_tau[i], SHAKER2_N);
    }
}

static void take_inverse_result(tally *sum, const shaker2_inverse_result *value)
{
    take_reals(sum, value->phi_ddot, SHAKER2_N);
    take_reals(sum, value->residual, 6);
    take_reals(sum, value->sigma, 2);
    take_ints(sum, &value->rank, 1);
    take_reals(sum, &value->damped_by, 1);
    take_ints(sum, value->limited, SHAKER2_N);
    take_reals(sum, value->hardest, 6);
}

static void take_generalized_result(tally *sum, const shaker2_generalized_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->A[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->D[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->I0[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->J0[i], 6);
    }
    take_reals(sum, value->q_dot, 6);
    take_reals(sum, value->q_ddot, 6);
}

static void take_row(tally *sum, const shaker2_row *value)
{
    take_reals(sum, value->mu_c, 3);
    take_reals(sum, value->mu_s, 3);
    take_reals(sum, value->J_c, 6);
    take_reals(sum, value->J_s, 6);
    take_reals(sum, value->J_2c, 6);
    take_reals(sum, value->J_2s, 6);
    take_reals(sum, value->t_0, 3);
    take_reals(sum, value->t_c, 3);
    take_reals(sum, value->t_s, 3);
    take_reals(sum, &value->spin, 1);
    take_reals(sum, &value->spin_inv, 1);
    take_reals(sum, &value->spin_root_inv, 1);
}

static void take_suspension(tally *sum, const shaker2_suspension *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->stiffness[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->damping[i], 6);
    }
    take_reals(sum, value->position, 3);
    take_reals(sum, value->attitude, 4);
}

static void take_table(tally *sum, const shaker2_table *value)
{
    take_reals(sum, &value->mass, 1);
    take_reals(sum, &value->mass_inverse, 1);
    take_reals(sum, value->first_moment, 3);
    take_reals(sum, value->inertia, 6);
    for (int i = 0; i < SHAKER2_N; ++i) {
        take_row(sum, &value->flywheel[i]);
    }
    take_reals(sum, value->gravity, 3);
    take_suspension(sum, &value->suspension);
}

static void take_mount(tally *sum, const shaker2_mount *value)
{
    take_reals(sum, &value->mass, 1);
    take_reals(sum, value->first_moment, 3);
    take_reals(sum, value->inertia, 6);
    take_reals(sum, value->origin, 3);
    take_reals(sum, value->axes, 9);
}

static void take_mount_table(tally *sum, const shaker2_mount_table *value)
{
    for (int i = 0; i < SHAKER2_N; ++i) {
        take_mount(sum, &value->flywheel[i]);
    }
}

static void take_step_carry(tally *sum, const shaker2_step_carry *value)
{
    take_reals(sum, value->rounding, 17);
}

/* ---- every function is called with the inputs, and its results are hashed and compared ---- */

static shaker2_status call_forward(void)
{
    return shaker2_forward((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.phi_ddot, (omitted == 4) ? NULL : results.forward.V_dot);
}

static void take_forward_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.forward.V_dot, 6);
}

static shaker2_status call_matrices(void)
{
    return shaker2_matrices((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : &results.matrices.out);
}

static void take_matrices_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_matrices_result(sum, &results.matrices.out);
}

static shaker2_status call_momentum(void)
{
    return shaker2_momentum((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : &results.momentum.out);
}

static void take_momentum_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_momentum_result(sum, &results.momentum.out);
}

static shaker2_status call_torque(void)
{
    return shaker2_torque((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL : results.torque.tau);
}

static void take_torque_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.torque.tau, SHAKER2_N);
}

static shaker2_status call_coupled(void)
{
    return shaker2_coupled((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL : results.coupled.V_dot,
        (omitted == 5) ? NULL : results.coupled.phi_ddot);
}

static void take_coupled_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.coupled.V_dot, 6);
    take_reals(sum, results.coupled.phi_ddot, SHAKER2_N);
}

static shaker2_status call_step(void)
{
    return shaker2_step((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.tau, (omitted < 0) ? NULL : in.locked, in.dt, in.order, (omitted == 4) ? NULL
        : &results.step.next);
}

static void take_step_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_state(sum, &results.step.next);
}

static shaker2_status call_step_driven(void)
{
    return shaker2_step_driven((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.phi_ddot, in.dt, in.order, (omitted == 4) ? NULL : &results.step_driven.next);
}

static void take_step_driven_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_state(sum, &results.step_driven.next);
}

static shaker2_status call_wrap(void)
{
    return shaker2_wrap(in.phi, (omitted == 1) ? NULL : &results.wrap.wrapped);
}

static void take_wrap_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.wrap.wrapped, 1);
}

static shaker2_status call_phase_of_counts(void)
{
    return shaker2_phase_of_counts(in.count, in.per_turn, in.zero, (omitted == 1) ? NULL
        : &results.phase_of_counts.phi);
}

static void take_phase_of_counts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.phase_of_counts.phi, 1);
}

static shaker2_status call_speed_of_counts(void)
{
    return shaker2_speed_of_counts(in.moved, in.per_turn, in.dt, (omitted == 1) ? NULL
        : &results.speed_of_counts.phi_dot);
}

static void take_speed_of_counts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.speed_of_counts.phi_dot, 1);
}

static shaker2_status call_accumulate(void)
{
    results.accumulate.encoder = in.encoder;
    return shaker2_accumulate((omitted == 1) ? NULL : &results.accumulate.encoder, in.counter, in.bits,
        in.per_turn);
}

static void take_accumulate_results(tally *sum, int refused)
{
    (void)refused;
    take_encoder(sum, &results.accumulate.encoder);
}

static shaker2_status call_forward_jacobian(void)
{
    return shaker2_forward_jacobian((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
        (omitted == 3) ? NULL : in.phi_ddot, (omitted == 4) ? NULL : &results.forward_jacobian.out);
}

static void take_forward_jacobian_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_forward_jacobian_result(sum, &results.forward_jacobian.out);
}

static shaker2_status call_coupled_jacobian(void)
{
    return shaker2_coupled_jacobian((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
        (omitted == 3) ? NULL : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL
        : &results.coupled_jacobian.out);
}

static void take_coupled_jacobian_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_coupled_jacobian_result(sum, &results.coupled_jacobian.out);
}

static shaker2_status call_inverse(void)
{
    return shaker2_inverse((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL : &results.inverse.out);
}

static void take_inverse_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_inverse_result(sum, &results.inverse.out);
}

static shaker2_status call_inverse_fast(void)
{
    return shaker2_inverse_fast((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.V_dot, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL
        : results.inverse_fast.phi_ddot);
}

static void take_inverse_fast_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.inverse_fast.phi_ddot, SHAKER2_N);
}

static shaker2_status call_quaternion(void)
{
    return shaker2_quaternion((omitted == 1) ? NULL : in.angles, (omitted == 2) ? NULL
        : results.quaternion.attitude);
}

static void take_quaternion_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.quaternion.attitude, 4);
}

static shaker2_status call_state_from_coordinates(void)
{
    results.state_from_coordinates.x = in.x;
    return shaker2_state_from_coordinates((omitted == 1) ? NULL : in.position, (omitted == 2) ? NULL
        : in.angles, (omitted == 3) ? NULL : in.q_dot, (omitted == 4) ? NULL : in.q_ddot, (omitted == 5)
        ? NULL : &results.state_from_coordinates.x, (omitted == 6) ? NULL
        : results.state_from_coordinates.V_dot);
}

static void take_state_from_coordinates_results(tally *sum, int refused)
{
    take_state(sum, &results.state_from_coordinates.x);
    if (refused != 0) { return; }
    take_reals(sum, results.state_from_coordinates.V_dot, 6);
}

static shaker2_status call_generalized(void)
{
    return shaker2_generalized((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.angles, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL
        : &results.generalized.out);
}

static void take_generalized_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_generalized_result(sum, &results.generalized.out);
}

static shaker2_status call_prepare(void)
{
    results.prepare.table = shaker2_default;
    return shaker2_prepare((omitted == 1) ? NULL : &parameters, (omitted == 2) ? NULL
        : &results.prepare.table);
}

static void take_prepare_results(tally *sum, int refused)
{
    (void)refused;
    take_table(sum, &results.prepare.table);
}

static shaker2_status call_mounts(void)
{
    return shaker2_mounts((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &mounting, (omitted == 3)
        ? NULL : &in.x, (omitted == 4) ? NULL : in.V_dot, (omitted == 5) ? NULL : in.phi_ddot, (omitted == 6)
        ? NULL : results.mounts.mount_wrench);
}

static void take_mounts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.mounts.mount_wrench, 12);
}

static shaker2_status call_prepare_mounts(void)
{
    return shaker2_prepare_mounts((omitted == 1) ? NULL : &parameters, (omitted == 2) ? NULL
        : &results.prepare_mounts.mounting);
}

static void take_prepare_mounts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_mount_table(sum, &results.prepare_mounts.mounting);
}

static shaker2_status call_step_carried(void)
{
    results.step_carried.carry = in.carry;
    return shaker2_step_carried((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.tau, (omitted < 0) ? NULL : in.locked, in.dt, in.order, (omitted == 4) ? NULL
        : &results.step_carried.carry, (omitted == 5) ? NULL : &results.step_carried.next);
}

static void take_step_carried_results(tally *sum, int refused)
{
    take_step_carry(sum, &results.step_carried.carry);
    if (refused != 0) { return; }
    take_state(sum, &results.step_carried.next);
}

static shaker2_status call_step_driven_carried(void)
{
    results.step_driven_carried.carry = in.carry;
    return shaker2_step_driven_carried((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
        (omitted == 3) ? NULL : in.phi_ddot, in.dt, in.order, (omitted == 4) ? NULL
        : &results.step_driven_carried.carry, (omitted == 5) ? NULL : &results.step_driven_carried.next);
}

static void take_step_driven_carried_results(tally *sum, int refused)
{
    take_step_carry(sum, &results.step_driven_carried.carry);
    if (refused != 0) { return; }
    take_state(sum, &results.step_driven_carried.next);
}

/* ---- golden vectors ---- */

static const inputs golden[CASES] =
{
    {   /* ordinary */
        .x = {
            .position = { -0x1.779ddp-1, 0x1.80b954p+0, -0x1.119c4p-4 },
            .attitude = { 0x1.23d2001fe5499p-1, -0x1.2fce5cc580fd9p-5, -0x1.fa57eff3d6fbfp-2,
                -0x1.4f73dbc4be6d5p-1 },
            .V = { 0x1.98cdb4p+0, 0x1.e62748p+0, 0x1.d12948p-1, 0x1.f3efb4p+0, 0x1.462f7p-1, 0x1.aad298p-1 },
            .phi = { -0x1.95dd5cp+3, 0x1.e462ap+3 },
            .phi_dot = { -0x1.23a78p+5, -0x1.c68578p+6 },
        },
        .phi_ddot = { -0x1.cf9e4p+8, -0x1.e0f5dp+7 },
        .V_dot = { -0x1.c61c58p+3, -0x1.3c48p+0, -0x1.c4d59p+3, 0x1.d79d24p+3, 0x1.3513p-1, 0x1.29b748p+2 },
        .tau = { -0x1.94148p-4, -0x1.f4583p+0 },
        .locked = { 0, 1 },
        .dt = 0x1p-14,
        .order = 4,
        .phi = -0x1.7d815p+2,
        .count = 408545,
        .per_turn = 4068,
        .zero = 0x1.656c1p-2,
        .moved = 410,
        .encoder = {
            .counter = 14955,
            .place = 3425,
            .moved = -57,
        },
        .counter = -22150,
        .bits = 16,
        .angles = { -0x1.538698p-2, 0x1.a1b0cp-2, 0x1.35f84p-3 },
        .position = { -0x1.92c438p+0, -0x1.944cep-2, -0x1.8683b4p+0 },
        .q_dot = { -0x1.23054p-4, 0x1.1aa1f8p+0, 0x1.96f608p+0, 0x1.af406cp+0, 0x1.f9388cp+0, -0x1.4d6b8p-5 },
        .q_ddot = { 0x1.4e6a6cp+3, 0x1.e7f3ap+1, -0x1.100f98p+2, -0x1.ae09ap+3, -0x1.b60768p+2,
            0x1.06bc6cp+3 },
        .carry = {
            .rounding = { -0x1.3b164p-29, 0x1.c0aac8p-25, -0x1.51bd7p-27, -0x1.ace304p-25, 0x1.76eb1p-27,
                -0x1.5944dp-27, 0x1.f3e8ep-27, 0x1.35894p-27, 0x1.d3fc6p-26, -0x1.23b5c4p-25, 0x1.cf1ac8p-26,
                0x1.30188p-28, 0x1.942a08p-26, -0x1.92f53p-26, 0x1.c0d28p-26, 0x1.9f33ep-26, 0x1.c06e04p-25 },
        },
        .mass_factor = 0x1.016815p+0,
    },
    {   /* fast flywheels, large phases */
        .x = {
            .position = { -0x1.7e8e7p-2, 0x1.bc58ep+0, -0x1.58a2bp+0 },
            .attitude = { -0x1.ed003e5b1916ap-4, 0x1.ad6d5dc700bb1p-1, 0x1.05d88a5a1faa4p-1,
                0x1.254471fe89dd7p-3 },
            .V = { 0x1.55fcep+1, -0x1.9f3ap-4, 0x1.9b4488p+1, 0x1.0a9aap-1, -0x1.9c2068p+1, -0x1.9ed4ep-1 },
            .phi = { -0x1.085ab8p+21, 0x1.968a6p+21 },
            .phi_dot = { 0x1.cdc694p+13, -0x1.0249c8p+13 },
        },
        .phi_ddot = { -0x1.371e7p+7, -0x1.214c38p+8 },
        .V_dot = { 0x1.4171bp+3, 0x1.82ebap+3, 0x1.0b38ap+4, -0x1.055d68p+5, -0x1.8f2aap+3, -0x1.763e6p+2 },
        .tau = { -0x1.df9aep+0, -0x1.f8caa4p+0 },
        .locked = { 0, 0 },
        .dt = 0x1p-14,
        .order = 2,
        .phi = -0x1.b2c408p+22,
        .count = -210783,
        .per_turn = 4083,
        .zero = 0x1.d5b01p-2,
        .moved = -355,
        .encoder = {
            .counter = -15860,
            .place = 1246,
            .moved = -321,
        },
        .counter = 15529,
        .bits = 16,
        .angles = { 0x1.33ded8p-1, -0x1.4256p-8, -0x1.923cb8p-1 },
        .position = { -0x1.67826p+0, 0x1.512658p-1, -0x1.3b3c18p-1 },
        .q_dot = { 0x1.8eec5p-1, -0x1.bb3d38p+0, 0x1.a3f8a8p+0, 0x1.882d1p-2, 0x1.4d94ap-2, -0x1.c47ac4p+0 },
        .q_ddot = { 0x1.1746e8p+3, 0x1.037d6p+2, 0x1.a1c0ecp+3, -0x1.cf6e3p+3, 0x1.56ea88p+3, 0x1.f688fp+2 },
        .carry = {
            .rounding = { -0x1.0f622p-25, 0x1.a26cfp-26, 0x1.df44a8p-25, 0x1.670cp-30, -0x1.23708p-29,
                0x1.598328p-26, -0x1.466428p-26, -0x1.3db6a8p-25, -0x1.3d4554p-25, -0x1.07562p-26,
                0x1.a063e4p-25, -0x1.bdbb3p-25, 0x1.d98bf4p-25, 0x1.3c586p-27, -0x1.ed3ccp-26, 0x1.297088p-26,
                0x1.c53fp-29 },
        },
        .mass_factor = 0x1.c5ea3b8p-1,
    },
    {   /* out of range */
        .x = {
            .position = { -0x1.70a96cp+40, -0x1.49e8p+36, 0x1.70ed48p+39 },
            .attitude = { -0x1.ff6cc1732dadap+0, 0x1.c600dcddd33b8p-6, -0x1.1103fa70a3596p-4,
                0x1.f715b6794403ap-5 },
            .V = { 0x1.26f56p+0, -0x1.28b67p+0, -0x1.7a5978p-1, 0x1.8ab58p-2, 0x1.b0decp-4, 0x1.7660dcp+0 },
            .phi = { 0x1.a35e68p+42, -0x1.16ceep+40 },
            .phi_dot = { 0x1.63ddcp+4, 0x1.e05b2p+4 },
        },
        .phi_ddot = { -0x1.68bbep+7, -0x1.cbd33cp+8 },
        .V_dot = { -0x1.c483b8p+3, -0x1.ed35p-2, -0x1.bdd86p+3, 0x1.f8f3ep+1, -0x1.ca174p+0, 0x1.bc5528p+2 },
        .tau = { 0x1.67f6p-4, 0x1.7f7ed8p-1 },
        .locked = { 0, 1 },
        .dt = 0x0p+0,
        .order = 2,
        .phi = -0x1.8e30bp+43,
        .count = -128687,
        .per_turn = 0,
        .zero = -0x1.74596p+39,
        .moved = -75,
        .encoder = {
            .counter = -10992,
            .place = 1359,
            .moved = -243,
        },
        .counter = -18810,
        .bits = 16,
        .angles = { 0x1.caa508p+39, 0x1.64ac8p+35, 0x1.49a318p+38 },
        .position = { 0x1.c85dp+37, 0x1.c55c48p+39, 0x1.ebfa1p+40 },
        .q_dot = { -0x1.afa2dp-2, -0x1.3dbc3cp+0, 0x1.e6041p+0, 0x1.efbb3cp+0, -0x1.fcd4p-2, -0x1.05219cp+0 },
        .q_ddot = { -0x1.1937p-2, -0x1.0b842cp+3, 0x1.7eee2p+1, -0x1.093c78p+3, -0x1.8ed23cp+3,
            -0x1.027accp+3 },
        .carry = {
            .rounding = { 0x1.313078p-25, 0x1.f09e08p-26, -0x1.f2802p-25, -0x1.31426p-28, 0x1.947958p-26,
                0x1.5360e8p-26, -0x1.bc3c4p-25, 0x1.4b5d2p-25, -0x1.e1ea1p-26, 0x1.43f77p-27, -0x1.7eaadp-25,
                0x1.9d9098p-26, 0x1.2190ap-25, 0x1.881898p-25, 0x1.f82364p-25, -0x1.f67078p-26,
                0x1.ef22p-27 },
        },
        .mass_factor = -0x1.019d4d4p+0,
    },
};

typedef struct answer {
    int status;
    uint32_t hash;  /* hash of the status and all outputs */
    int listed;     /* outputs whose numbers are given, at most 32 */
} answer;

static const shaker2_real numbers_forward[] =
{
    0x1.0ad6f58bae60bp+7, 0x1.da53041ea1a8p+5, -0x1.b8481994d58b3p+7, 0x1.e4a7e97718fa7p+4,
        0x1.1a993b3ee231ep+9, 0x1.24a090ff83ea8p+9,
    -0x1.0475ff80ff3cbp+7, -0x1.391b6c7fb3ee3p+16, 0x1.70516aab6a6a5p+13, -0x1.5e2ce9e94b12p+14,
        0x1.9e58108de1af4p+9, 0x1.9c41b479ab45ap+7,
};

static const shaker2_real numbers_matrices[] =
{
    0x1.cp+2, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.bc5c42309d4f5p-11, -0x1.3e4a78923e378p-12, 0x0p+0, 0x1.cp+2, 0x0p+0,
        -0x1.bc5c42309d4f5p-11, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.cp+2, 0x1.3e4a78923e378p-12, -0x0p+0,
        0x0p+0, 0x0p+0, -0x1.bc5c42309d4f5p-11, 0x1.3e4a78923e378p-12, 0x1.e1b6f6e9a0eedp-5, 0x0p+0, 0x0p+0,
        0x1.bc5c42309d4f5p-11, 0x0p+0, -0x0p+0, 0x0p+0, 0x1.f55ed48e4602dp-5, 0x1.cc144ba6005aep-14,
        -0x1.3e4a78923e378p-12, 0x0p+0,
    0x1.cp+2, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.d738bcf6803a5p-11, 0x1.f8b512f49ca72p-9, 0x0p+0, 0x1.cp+2, 0x0p+0,
        -0x1.d738bcf6803a5p-11, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.cp+2, -0x1.f8b512f49ca72p-9, -0x0p+0,
        0x0p+0, 0x0p+0, -0x1.d738bcf6803a5p-11, -0x1.f8b512f49ca72p-9, 0x1.dcb9b92001bebp-5, 0x0p+0, 0x0p+0,
        0x1.d738bcf6803a5p-11, 0x0p+0, -0x0p+0, 0x0p+0, 0x1.f55c1f542ad2fp-5, 0x1.a72ba0b9354e2p-15,
        0x1.f8b512f49ca72p-9, 0x0p+0,
};

static const shaker2_real numbers_momentum[] =
{
    0x1.65b65731e48e6p+3, 0x1.acfd3c945dacfp+3, 0x1.9ea84791407b4p+2, -0x1.675ec51a7519ep-5,
        0x1.4b3ffaa702a1p-5, 0x1.0952b9675ec4p-4, 0x1.a41451943e6dep+1, -0x1.9b694bd8d2d64p+0,
        0x1.241adc1b6b4a7p+4, 0x1.b57b9a5b2bc28p+4, 0x1.a82ef070e8493p+3, -0x1.dc7c340e985f7p+1,
        0x1.f11aae6f469b2p+4, 0x0p+0, 0x1.6bc2d2f0471adp-15, 0x1.fbd72712fcecep-14, 0x1.e01738a96beb6p-2,
        -0x1.d62f321c5eabp-3, 0x1.4dd58dd631799p+1,
    0x1.2b24a232148bap+4, 0x1.922422995bf97p+1, 0x1.0bd96138e459ap+3, 0x1.2c4177902d1p+1,
        -0x1.8eba4a7a28aa4p-3, -0x1.b00f16e77e7f8p-5, 0x1.7ddd86b271fa1p+3, 0x1.0e747d4fefd6bp+4,
        -0x1.2a7af61d75ad8p+0, 0x1.59325693d02bfp+4, -0x1.d001de48dcab7p+3, -0x1.a1da8b8b712d3p+4,
        0x1.fc74623157991p+16, 0x0p+0, -0x1.2067788bc73afp-11, 0x1.0d44fe43b6fccp-13, 0x1.b46ae315148b9p+0,
        0x1.35176aa47fd0cp+1, -0x1.551ed021ab0f8p-3,
};

static const shaker2_real numbers_torque[] =
{
    -0x1.ab1ce3fd926p-2, -0x1.937f86752456bp-3,
    -0x1.9870c806c4704p-3, -0x1.547b3783815eep-2,
};

static const shaker2_real numbers_coupled[] =
{
    0x1.0ad6f58bae60cp+7, 0x1.da648d8fed408p+5, -0x1.b89cd2fc1d186p+7, 0x1.7662cf6f7928cp+3,
        0x1.1a993b3ee231ep+9, 0x1.24a090ff83ea8p+9, 0x1.461a7b0ad15b1p+8, 0x0p+0,
    -0x1.0475ff80ff3cbp+7, -0x1.391ca0abfe139p+16, 0x1.706e226e3bed4p+13, -0x1.5f0ef74840df9p+14,
        0x1.9e58108de1af4p+9, 0x1.9c41b479ab45ap+7, 0x1.bf8a2a0874c12p+14, -0x1.12782169f659ep+14,
};

static const shaker2_real numbers_step[] =
{
    -0x1.779a109c6a305p-1, 0x1.80b8533828837p+0, -0x1.10f6804d6af67p-4, 0x1.23d5d0d8073e1p-1,
        -0x1.2f869f7cf0589p-5, -0x1.fa5ef048af892p-2, -0x1.4f6e2697af73cp-1, 0x1.9ae37336396a5p+0,
        0x1.e7143601a75c8p+0, 0x1.ca4726fa185f4p-1, 0x1.f41e0c0963f9ep+0, 0x1.57d8b8dac31aep-1,
        0x1.bd1bade88ccc7p-1, -0x1.e7eff6dafdec6p-4, 0x1.48286832f4b9fp+1, -0x1.237ec04f2f134p+5,
        -0x1.c68578p+6,
    -0x1.7e9983cdb623p-2, 0x1.bc6b343d233a3p+0, -0x1.58ab89c24225fp+0, -0x1.ecc3da86e2679p-4,
        0x1.ad6da159972bbp-1, 0x1.05dcae475e682p-1, 0x1.251c798b16b88p-3, 0x1.54f6f400f8684p+1,
        -0x1.26481ca157377p+2, 0x1.413da5a5478d1p+1, -0x1.42d6a2cbb888ap+4, -0x1.959e8bdd1cfc3p+1,
        -0x1.98d08bd75fbcp-1, -0x1.289e2de4b186cp+1, 0x1.20ca23c1cefdp+1, 0x1.ce6157811b652p+13,
        -0x1.01c69cb65023dp+13,
};

static const shaker2_real numbers_step_driven[] =
{
    -0x1.779a109de2cfcp-1, 0x1.80b85339103a6p+0, -0x1.10f680434c7a6p-4, 0x1.23d5d0dd89a1bp-1,
        -0x1.2f869a30f7d5dp-5, -0x1.fa5ef10b80544p-2, -0x1.4f6e264e292cfp-1, 0x1.9ae373372c0b9p+0,
        0x1.e7142dec9dc11p+0, 0x1.ca487823ee7afp-1, 0x1.f468606a4bde3p+0, 0x1.57d8b9fe48fb9p-1,
        0x1.bd1bad43980bp-1, -0x1.e7f181adb73ddp-4, 0x1.482864710919fp+1, -0x1.23e173c8p+5, -0x1.c6947fae8p+6,
    -0x1.7e9983b8c7d8cp-2, 0x1.bc6b342ed2666p+0, -0x1.58ab89a81552p+0, -0x1.ecc3e6606b743p-4,
        0x1.ad6da12330462p-1, 0x1.05dcae88178abp-1, 0x1.251c75ee34269p-3, 0x1.54f6f4534a343p+1,
        -0x1.264b09afbfa63p+2, 0x1.402462bb3f9ep+1, -0x1.3a15f7419d9p+4, -0x1.959e8e73b4175p+1,
        -0x1.98d091a3fa95dp-1, -0x1.289fefdd186f3p+1, 0x1.20cb31b4bf86fp+1, 0x1.cdc6808e19p+13,
        -0x1.0249ec2987p+13,
};

static const shaker2_real numbers_wrap[] =
{
    0x1.49e654442d184p-2,
    0x1.3350d8527a7c8p+0,
};

static const shaker2_real numbers_phase_of_counts[] =
{
    0x1.58eb54a73bc22p+1,
    0x1.2ddf332395482p+1,
};

static const shaker2_real numbers_speed_of_counts[] =
{
    0x1.443acb0afcbc1p+13,
    -0x1.17b43ea1b7b99p+13,
};

static const shaker2_real numbers_accumulate[] =
{
    0.0
};

static const shaker2_real numbers_forward_jacobian[] =
{
    -0x1.6db707b0beeccp+0, 0x1.aad298p-1, -0x1.462f7p-1, -0x1.52ebc94f8be55p-13, -0x1.e254d421d55bcp-1,
        0x1.ee53848d936e8p+0, -0x1.aad298p-1, -0x1.6db7054165baep+0, 0x1.f3efc2fae7376p+0,
        0x1.e2553756940ddp-1, -0x1.1178a255c762fp-13, -0x1.98cf74f0dd44bp+0, 0x1.462f7p-1,
        -0x1.f3efa50518c8ap+0, -0x1.6db6e0cb2a6b1p+0, -0x1.ee5734f354109p+0, 0x1.98d622d768a22p+0,
        -0x1.4bc59671cac7cp-16, 0x1.10185ee6203dep-59, -0x1.515b1736d82bep-6, 0x1.e34a098a82286p-8,
        -0x1.2f9ab185c2b46p+2, -0x1.f2660bd1c3e7cp-3, -0x1.72cabc6da5b1ap-3, 0x1.444b32228f59p-6,
        0x1.0763c74a3dc3cp-56, -0x1.efbb3b69e6217p-47, 0x1.0fc3e91c34167p-2, -0x1.3a2022662bfa3p+2,
        0x1.6b9e5b91398b5p+1, -0x1.6d3abf9969d1ep-8, -0x1.f6aa3c85888bfp-48,
    -0x1.6db996aadfe9bp+0, -0x1.9ed4ep-1, 0x1.9c2068p+1, -0x1.be6479974d231p-10, 0x1.a9330f6d5a276p-1,
        0x1.00f0dd95a00f2p+0, 0x1.9ed4ep-1, -0x1.6db70af587c0cp+0, 0x1.0a9908bc2c037p-1,
        -0x1.a3709f3c4c706p-1, 0x1.191a22fbab5acp-13, -0x1.55ce4f6780c83p+1, -0x1.9c2068p+1,
        -0x1.0a9c3743d3fc9p-1, -0x1.6dba43d713c0fp+0, -0x1.fa72a468963b3p-1, 0x1.55d763f986936p+1,
        -0x1.4db9bc9121462p-10, -0x1.12f3ee26738d9p-55, -0x1.698185e886c64p-6, -0x1.8331f0eaae6f3p-4,
        0x1.1e9fd09cc6e7p+4, 0x1.deab725621d83p-3, 0x1.cf96f019fcdf2p-1, 0x1.56c86c2a839b8p-6,
        -0x1.534e03eaa21b4p-58, -0x1.fc91da75fb07cp-46, -0x1.09c6704bff3aep-2, -0x1.59450a0e61f9ep+2,
        -0x1.7d6084b2609fap+6, 0x1.2255b4ff11395p-4, 0x1.95f9f5dfbded5p-48,
};

static const shaker2_real numbers_coupled_jacobian[] =
{
    -0x1.6db707b0beecep+0, 0x1.aad2980000001p-1, -0x1.462f700000001p-1, -0x1.52ebc94f8be57p-13,
        -0x1.e254d421d55bdp-1, 0x1.ee53848d936e9p+0, -0x1.aad2980000001p-1, -0x1.6db7f39e687b7p+0,
        0x1.f3e8580eb4a7ap+0, 0x1.e23a02179893fp-1, -0x1.1b79ec0dec55cp-13, -0x1.98cfc53f8477p+0,
        0x1.462f7p-1, -0x1.f3f70ff14b587p+0, -0x1.6df1f89218f5cp+0, -0x1.eec39548e3f2dp+0,
        0x1.98d3a5334c552p+0, -0x1.e5c51a1a439bep-15, -0x1.160689f856df6p-58, -0x1.c83fefd9fd56cp-6,
        -0x1.9d2c644b67c0ap-5, -0x1.3663cd110223p+2, -0x1.f7639930523bep-3, -0x1.77cc8cbf63139p-3,
        0x1.444b32228f592p-6, 0x1.8bf939734fa0bp-57, -0x1.efaae027a083cp-47, 0x1.0fc3e91c34167p-2,
        -0x1.3a2022662bfa3p+2, 0x1.6b9e5b91398b5p+1, -0x1.6d3abf9969d2p-8, -0x1.f69091c3afe64p-48,
    -0x1.6db996aadfe9bp+0, -0x1.9ed4ep-1, 0x1.9c2068p+1, -0x1.be6479974d231p-10, 0x1.a9330f6d5a276p-1,
        0x1.00f0dd95a00f2p+0, 0x1.9ed4ep-1, -0x1.6dbf5d842435bp+0, 0x1.0a68c6be58f1dp-1,
        -0x1.a514942c46326p-1, 0x1.df474a0535ef5p-14, -0x1.55d166b895a1bp+1, -0x1.9c2067fffffffp+1,
        -0x1.0acc7941a70e3p-1, -0x1.6e24550bb6dd4p+0, -0x1.0050ca76afe2p+0, 0x1.55d353deb22cdp+1,
        -0x1.d75edd9f4305bp-10, -0x1.3f71fe525abf8p-55, 0x1.398cdba88fab2p-9, -0x1.35d2c1037fb08p-10,
        0x1.2a504c21eb60cp+4, 0x1.ec0759c848ab8p-3, 0x1.de232ace0afd3p-1, 0x1.56c86c2a839b8p-6,
        -0x1.534e03eaa21b4p-58, -0x1.fc91da75fb07cp-46, -0x1.09c6704bff3aep-2, -0x1.59450a0e61f9ep+2,
        -0x1.7d6084b2609fap+6, 0x1.2255b4ff11395p-4, 0x1.95f9f5dfbded5p-48,
};

static const shaker2_real numbers_inverse[] =
{
    -0x1.2dc3e63ad586fp+18, 0x1.31f90add1917ep+18, 0x1.0264fc3fd70e6p+10, 0x1.a1453d6513f9p+9,
        -0x1.2d649665c6f8p+8, 0x1.88931870ef1p+1, 0x1.15f244a34b6cfp+5, 0x1.6b5d67f38219fp+5,
        0x1.a2678dcf66d6fp-3, 0x1.1b28248143a7p-5, 0x0p+0, 0x1.da502c8604e1p+0, 0x1.7ef96b4fc6353p+0,
        -0x1.149ef49714c8cp-1, 0x1.684ee717cad96p-8, 0x1.fe33f434c4a9ep-5, 0x1.4d7fd14096556p-4,
    -0x1.aae3ff130f709p+28, 0x1.320587b2d33dfp+28, -0x1.ea2dae944e4fcp+9, -0x1.7eda5aa6e56f2p+18,
        -0x1.a291c9d806748p+17, -0x1.48de5d6ed7dcp+12, 0x1.9aeae6f8c9dacp+5, 0x1.fe6742165e3fcp+3,
        0x1.73303bb942eabp-3, 0x1.01223009e481dp-7, 0x0p+0, -0x1.791efb6b31012p-8, -0x1.268cb696aff93p+1,
        -0x1.42074194e1de4p+0, -0x1.fa087ba8d562p-6, 0x1.3c242d99a287ep-12, 0x1.88ae5fbd8be2fp-14,
};

static const shaker2_real numbers_inverse_fast[] =
{
    -0x1.2dc3e63ad5869p+18, 0x1.31f90add19179p+18,
    -0x1.aae3ff130f673p+28, 0x1.320587b2d3376p+28,
};

static const shaker2_real numbers_quaternion[] =
{
    0x1.ebce0603140ccp-1, 0x1.b39c8ecb8202p-4, 0x1.7eeb8d7f5a874p-3, -0x1.68f38183b953ep-3,
    0x1.c3eda73da001fp-1, -0x1.75b31b2fa7e32p-2, -0x1.d935f8f64c7fdp-4, 0x1.173c285aff6d9p-2,
};

static const shaker2_real numbers_state_from_coordinates[] =
{
    -0x1.92c438p+0, -0x1.944cep-2, -0x1.8683b4p+0, 0x1.ebce0603140ccp-1, 0x1.b39c8ecb8202p-4,
        0x1.7eeb8d7f5a874p-3, -0x1.68f38183b953ep-3, -0x1.05ad775e6ef9ap+0, 0x1.341fd1387e32p+0,
        0x1.1f13e6e7a4cb9p+0, -0x1.6afab684373dfp-1, 0x1.1790f902111ecp+1, 0x1.3b2b64a1005c6p+0,
        -0x1.95dd5cp+3, 0x1.e462ap+3, -0x1.23a78p+5, -0x1.c68578p+6, 0x1.14cf0a04d8d89p+3,
        0x1.d45c9a1ac3fcbp+2, -0x1.73d4bddfc12e4p+1, 0x1.4faaeaac072a2p+3, -0x1.1bff1434ec54ep+3,
        -0x1.8c18497de742fp+3,
    -0x1.67826p+0, 0x1.512658p-1, -0x1.3b3c18p-1, 0x1.c3eda73da001fp-1, -0x1.75b31b2fa7e32p-2,
        -0x1.d935f8f64c7fdp-4, 0x1.173c285aff6d9p-2, -0x1.50d5c17afae4fp-2, -0x1.3dbe00f2c3e3ep+1,
        -0x1.48e590a77945p-3, -0x1.c3ff51054db7p+0, -0x1.4c590a09de3p-5, 0x1.0096622b866bbp-1,
        -0x1.085ab8p+21, 0x1.968a6p+21, 0x1.cdc694p+13, -0x1.0249c8p+13, 0x1.09b94a06447dep+3,
        -0x1.3c1cb09ec173ep+3, 0x1.d97bf92a707f8p+1, 0x1.e9fdd5c609804p+2, 0x1.0eea24cfa573ep+4,
        -0x1.5d77db0970c86p+1,
    -0x1.70a96cp+40, -0x1.49e8p+36, 0x1.70ed48p+39, -0x1.ff6cc1732dadap+0, 0x1.c600dcddd33b8p-6,
        -0x1.1103fa70a3596p-4, 0x1.f715b6794403ap-5, 0x1.26f56p+0, -0x1.28b67p+0, -0x1.7a5978p-1,
        0x1.8ab58p-2, 0x1.b0decp-4, 0x1.7660dcp+0, 0x1.a35e68p+42, -0x1.16ceep+40, 0x1.63ddcp+4, 0x1.e05b2p+4,
};

static const shaker2_real numbers_generalized[] =
{
    0x1.bc64e69193cfbp-1, -0x1.31fd7c00e94b3p-2, -0x1.963421a35bbd9p-2, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.837009d2ff50ap-2, 0x1.d49c2e0dce84cp-1, 0x1.1b740d7808e53p-3, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.496dd149e37p-2, -0x1.14b3e54f0cc1fp-2, 0x1.d09ecd1b95aefp-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, -0x1.963421a35bbd8p-2, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.1b740d7808e53p-3,
        0x1.fa25982d2662p-1, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.a630128430d39p-1, 0x1.21a585865cd99p-1, 0x1.4255aad4163c1p-8, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.96995d5d8b278p-2, 0x1.2b7a19d7b3ddcp-1, -0x1.6a1d4a44aca21p-1, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.9ca75a2f71915p-2, 0x1.299829923f3dfp-1, 0x1.69f443688993ep-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.4255aad4163cbp-8, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.6a1d4a44aca2p-1,
        0x1.69f56254d806dp-1, 0x0p+0, 0x0p+0, 0x0p+0,
};

static const shaker2_real numbers_prepare[] =
{
    0x1.c27624cp+2, 0x1.22f90319c8c5bp-3, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.df869a1aa3f04p-5, 0x1.f82bc1a682b63p-5,
        0x1.3fa102991793ap-4, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.079596872b021p-9, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.079596872b021p-9, 0x1.516350092ccf7p-12, 0x0p+0, 0x1.516350092ccf7p-12, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.516350092ccf7p-13, 0x0p+0, -0x1.0de90cd423d8p-18,
        0x1.0de90cd423d8p-18,
    0x1.8d2cf41p+2, 0x1.4a029ca657a8bp-3, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.a6cd444013ec6p-5, 0x1.bc8819914b168p-5,
        0x1.19d1c867924afp-4, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.d0cf160418937p-10, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.d0cf160418937p-10, 0x1.297a4b87bdcfp-12, 0x0p+0, 0x1.297a4b87bdcfp-12, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.297a4b87bdcfp-13, 0x0p+0, -0x1.dbf6df3f9618p-19,
        0x1.dbf6df3f9618p-19,
    0x1.cp+2, 0x1.2492492492492p-3, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.dce7cd035371ap-5, 0x1.f56a7ac81d3aap-5,
        0x1.3de1e2de87098p-4, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.0624dd2f1a9fcp-9, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.0624dd2f1a9fcp-9, 0x1.4f8b588e368f1p-12, 0x0p+0, 0x1.4f8b588e368f1p-12, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.4f8b588e368f1p-13, 0x0p+0, -0x1.0c6f7a0b5ed8p-18,
        0x1.0c6f7a0b5ed8p-18,
};

static const shaker2_real numbers_mounts[] =
{
    -0x1.343c5e69e8fe2p+2, -0x1.0a2157b80258cp-1, -0x1.9e987d72b6d93p+1, -0x1.ab1ce3fd92602p-2,
        -0x1.8d6511e8b848dp-6, 0x1.5bc96065e4b42p-5, -0x1.1a508f4d848dcp+2, 0x1.78b9abc40e81p+4,
        -0x1.0f2f57c208a52p+4, -0x1.937f867524569p-3, -0x1.80c5d48fac76bp-4, 0x1.afea799f89921p-5,
    0x1.77887092e1211p+7, 0x1.a938863bee4bp+18, -0x1.08c50d4732fc7p+15, -0x1.9870c806c47p-3,
        -0x1.572f3f061a9c5p+3, 0x1.5c86412d14af2p+5, -0x1.5dcef22a1c427p+6, 0x1.ef66cafbe80c6p+16,
        -0x1.8cb5849c38f56p+15, -0x1.547b3783815bfp-2, 0x1.78ea65738ea39p+2, -0x1.8474622ce9e33p+4,
};

static const shaker2_real numbers_prepare_mounts[] =
{
    0x1.016815p-1, 0x0p+0, 0x1.079596872b021p-9, 0x0p+0, 0x1.deab4cc037931p-11, 0x1.3c4d1b089a027p-11,
        0x1.4084bf3bea91dp-11, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.47ae147ae147bp-4, 0x0p+0, 0x1p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1p+0, -0x0p+0, -0x0p+0, 0x0p+0, 0x1p+0, 0x1.016815p-1, 0x0p+0, 0x1.079596872b021p-9,
        0x0p+0, 0x1.deab4cc037931p-11, 0x1.3c4d1b089a027p-11, 0x1.4084bf3bea91dp-11, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.c5ea3b8p-2, 0x0p+0, 0x1.d0cf160418937p-10, 0x0p+0, 0x1.a60be7f562174p-11, 0x1.16e2a6cf41f21p-11,
        0x1.1a9a948dc11e4p-11, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.47ae147ae147bp-4, 0x0p+0, 0x1p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1p+0, -0x0p+0, -0x0p+0, 0x0p+0, 0x1p+0, 0x1.c5ea3b8p-2, 0x0p+0,
        0x1.d0cf160418937p-10, 0x0p+0, 0x1.a60be7f562174p-11, 0x1.16e2a6cf41f21p-11, 0x1.1a9a948dc11e4p-11,
        0x0p+0, 0x0p+0, 0x0p+0,
};

static const shaker2_real numbers_step_carried[] =
{
    0x1.ca4p-58, 0x1.962p-54, 0x1.84p-59, -0x1.fa5a7p-58, 0x1.587988p-60, 0x1.020eap-59, 0x1.7e3dcap-55,
        0x1.1p-54, -0x1.b6p-54, 0x1.8p-57, -0x1.8p-61, 0x0p+0, 0x1.8p-55, -0x1p-59, 0x0p+0, -0x1.e88p-49,
        0x1p-47, -0x1.779a10b01b945p-1, 0x1.80b854187de77p+0, -0x1.10f682f0e5d67p-4, 0x1.23d5cfcecd304p-1,
        -0x1.2f869a4b7b672p-5, -0x1.fa5ef2114a745p-2, -0x1.4f6e26d6d0de7p-1, 0x1.9ae3735cea925p+0,
        0x1.e7143676a6748p+0, 0x1.ca4725d6629b4p-1, 0x1.f41e0c7d2aabep+0, 0x1.57d8b900c62aep-1,
        0x1.bd1baeb2a1d07p-1, -0x1.e7effd26d2ac6p-4, 0x1.4828686b0f09fp+1,
    -0x1.08p-57, -0x1.184p-54, 0x1.38p-56, 0x1.26bb9a8p-58, -0x1.cb04da8p-55, -0x1.16aca48p-55,
        -0x1.b456678p-58, -0x1.18p-53, 0x0p+0, -0x1p-53, 0x0p+0, -0x1.dp-53, 0x0p+0, 0x1.659d9cceba3f9p-52,
        -0x1p-52, 0x1.d4p-42, 0x1.88p-43, -0x1.7e9985ec7a63p-2, 0x1.bc6b34a5be763p+0, -0x1.58ab88d29fd1fp+0,
        -0x1.ecc3d9fe915bcp-4, 0x1.ad6da11ecdf61p-1, 0x1.05dcaedb6292cp-1, 0x1.251c76e29d33ep-3,
        0x1.54f6f3b18abe4p+1, -0x1.26481cc8ffe1fp+2, 0x1.413da5845cc91p+1, -0x1.42d6a2beb5698p+4,
        -0x1.959e8c4c8bc83p+1, -0x1.98d089fdd3c8p-1, -0x1.289e2dd0ec00cp+1, 0x1.20ca23842765p+1,
    0x1.313078p-25, 0x1.f09e08p-26, -0x1.f2802p-25, -0x1.31426p-28, 0x1.947958p-26, 0x1.5360e8p-26,
        -0x1.bc3c4p-25, 0x1.4b5d2p-25, -0x1.e1ea1p-26, 0x1.43f77p-27, -0x1.7eaadp-25, 0x1.9d9098p-26,
        0x1.2190ap-25, 0x1.881898p-25, 0x1.f82364p-25, -0x1.f67078p-26, 0x1.ef22p-27,
};

static const shaker2_real numbers_step_driven_carried[] =
{
    0x1.baap-57, -0x1.36c8p-55, -0x1.d4p-59, -0x1.6ffb4cp-56, -0x1.9e7cc2p-59, -0x1.14684p-57, 0x1.300c5p-55,
        -0x1.7p-54, -0x1.bp-54, -0x1.8p-55, 0x1.7cp-55, 0x1.4p-55, 0x1p-54, 0x0p+0, 0x0p+0, 0x0p+0, 0x1p-47,
        -0x1.779a10b19433cp-1, 0x1.80b85419659e6p+0, -0x1.10f682e6c75a6p-4, 0x1.23d5cfd44f93cp-1,
        -0x1.2f8694ff82e13p-5, -0x1.fa5ef2d41b3f9p-2, -0x1.4f6e268d4a975p-1, 0x1.9ae3735ddd339p+0,
        0x1.e7142e619cd91p+0, 0x1.ca48770038b6fp-1, 0x1.f46860de12903p+0, 0x1.57d8ba244c0b9p-1,
        0x1.bd1bae0dad0fp-1, -0x1.e7f187f98bfddp-4, 0x1.482864a92369fp+1,
    0x1.4bp-59, 0x1.12p-57, 0x1.804p-55, 0x1.3b9b1e8p-58, -0x1.228666p-56, 0x1.9cd455cp-55, 0x1.765c4dp-57,
        0x1.3p-54, 0x0p+0, 0x1p-52, 0x0p+0, -0x1.6p-54, 0x1.5p-55, 0x1.cb3b399d747f2p-53, 0x0p+0, 0x1.1p-43,
        -0x1p-45, -0x1.7e9985d78c18cp-2, 0x1.bc6b34976da26p+0, -0x1.58ab88b872fep+0, -0x1.ecc3e5d81a66fp-4,
        0x1.ad6da0e867104p-1, 0x1.05dcaf1c1bb51p-1, 0x1.251c7345baa21p-3, 0x1.54f6f403dc8a3p+1,
        -0x1.264b09d76850bp+2, 0x1.4024629a54dap+1, -0x1.3a15f7349a70ep+4, -0x1.959e8ee322e35p+1,
        -0x1.98d08fca6ea1dp-1, -0x1.289fefc952e93p+1, 0x1.20cb317717eefp+1,
    0x1.313078p-25, 0x1.f09e08p-26, -0x1.f2802p-25, -0x1.31426p-28, 0x1.947958p-26, 0x1.5360e8p-26,
        -0x1.bc3c4p-25, 0x1.4b5d2p-25, -0x1.e1ea1p-26, 0x1.43f77p-27, -0x1.7eaadp-25, 0x1.9d9098p-26,
        0x1.2190ap-25, 0x1.881898p-25, 0x1.f82364p-25, -0x1.f67078p-26, 0x1.ef22p-27,
};

typedef struct function {
    const char *name;
    int pointers;  /* arguments that must not be null */
    size_t size;  /* bytes of its results */
    size_t kept;  /* bytes of those that are also inputs: the first ones, the only ones that a refused call may have */
    shaker2_status (*call)(void);
    void (*take)(tally *sum, int refused);
    const shaker2_real *numbers;
    answer answers[CASES];
    uint32_t swept;  /* hash of the first SWEPT states of a sweep */
} function;

static const function functions[FUNCTIONS] =
{
    { "forward", 4, sizeof results.forward, 0u,
      call_forward, take_forward_results, numbers_forward,
      { { 0, 0x61f91833u, 6 }, { 0, 0xe9acde2au, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0xe6faf538u },
    { "matrices", 3, sizeof results.matrices, 0u,
      call_matrices, take_matrices_results, numbers_matrices,
      { { 0, 0x14d1d876u, 32 }, { 0, 0x267a3fc6u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x8acede06u },
    { "momentum", 3, sizeof results.momentum, 0u,
      call_momentum, take_momentum_results, numbers_momentum,
      { { 0, 0x1f76a12cu, 19 }, { 0, 0xd537947fu, 19 }, { -2, 0x8e5b0aa0u, 0 } },
      0xda14c9cbu },
    { "torque", 5, sizeof results.torque, 0u,
      call_torque, take_torque_results, numbers_torque,
      { { 0, 0xa889bcefu, 2 }, { 0, 0x41d85922u, 2 }, { -2, 0x8e5b0aa0u, 0 } },
      0xe85c3212u },
    { "coupled", 5, sizeof results.coupled, 0u,
      call_coupled, take_coupled_results, numbers_coupled,
      { { 0, 0xbf7c5802u, 8 }, { 0, 0x90f9ea85u, 8 }, { -2, 0x8e5b0aa0u, 0 } },
      0xbc6bdfa0u },
    { "step", 4, sizeof results.step, 0u,
      call_step, take_step_results, numbers_step,
      { { 0, 0x8cf6cb7eu, 17 }, { 32, 0x6b3b9eb4u, 17 }, { -2, 0x8e5b0aa0u, 0 } },
      0x4d13f7a0u },
    { "step_driven", 4, sizeof results.step_driven, 0u,
      call_step_driven, take_step_driven_results, numbers_step_driven,
      { { 0, 0xe3b5521du, 17 }, { 32, 0xe680220eu, 17 }, { -2, 0x8e5b0aa0u, 0 } },
      0x473796c7u },
    { "wrap", 1, sizeof results.wrap, 0u,
      call_wrap, take_wrap_results, numbers_wrap,
      { { 0, 0xc0260436u, 1 }, { 0, 0x92488ab0u, 1 }, { -2, 0x8e5b0aa0u, 0 } },
      0x23cf074bu },
    { "phase_of_counts", 1, sizeof results.phase_of_counts, 0u,
      call_phase_of_counts, take_phase_of_counts_results, numbers_phase_of_counts,
      { { 0, 0x4d2bc480u, 1 }, { 0, 0x2f5b248au, 1 }, { -5, 0x2107376du, 0 } },
      0x6d1c0dd3u },
    { "speed_of_counts", 1, sizeof results.speed_of_counts, 0u,
      call_speed_of_counts, take_speed_of_counts_results, numbers_speed_of_counts,
      { { 0, 0x842918afu, 1 }, { 0, 0x8b7c0867u, 1 }, { -5, 0x2107376du, 0 } },
      0x6f14bb3du },
    { "accumulate", 1, sizeof results.accumulate, sizeof results.accumulate.encoder,
      call_accumulate, take_accumulate_results, numbers_accumulate,
      { { 0, 0x5caa922bu, 0 }, { 0, 0xca82b94cu, 0 }, { -5, 0x203bc392u, 0 } },
      0x6e4a741bu },
    { "forward_jacobian", 4, sizeof results.forward_jacobian, 0u,
      call_forward_jacobian, take_forward_jacobian_results, numbers_forward_jacobian,
      { { 0, 0x2fd77a18u, 32 }, { 0, 0xbfdecd0fu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xd3aa7aaau },
    { "coupled_jacobian", 4, sizeof results.coupled_jacobian, 0u,
      call_coupled_jacobian, take_coupled_jacobian_results, numbers_coupled_jacobian,
      { { 0, 0x44717e9au, 32 }, { 0, 0xd8d69305u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x7499be56u },
    { "inverse", 5, sizeof results.inverse, 0u,
      call_inverse, take_inverse_results, numbers_inverse,
      { { 72, 0x30bccf48u, 17 }, { 72, 0x0a0e6b96u, 17 }, { -2, 0x8e5b0aa0u, 0 } },
      0x57c8feb1u },
    { "inverse_fast", 5, sizeof results.inverse_fast, 0u,
      call_inverse_fast, take_inverse_fast_results, numbers_inverse_fast,
      { { 64, 0x1ec9b0c6u, 2 }, { 64, 0x4bd3dc10u, 2 }, { -2, 0x8e5b0aa0u, 0 } },
      0xadf2aba9u },
    { "quaternion", 2, sizeof results.quaternion, 0u,
      call_quaternion, take_quaternion_results, numbers_quaternion,
      { { 0, 0xd3caa542u, 4 }, { 0, 0x88bdd879u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0x61029375u },
    { "state_from_coordinates", 6, sizeof results.state_from_coordinates, sizeof results.state_from_coordinates.x,
      call_state_from_coordinates, take_state_from_coordinates_results, numbers_state_from_coordinates,
      { { 0, 0x32f3d7e8u, 23 }, { 0, 0x83701f67u, 23 }, { -2, 0xc8cc4137u, 17 } },
      0x73f0eb7fu },
    { "generalized", 5, sizeof results.generalized, 0u,
      call_generalized, take_generalized_results, numbers_generalized,
      { { 0, 0xd6d5f926u, 32 }, { 0, 0xca8e6587u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x1083c977u },
    { "prepare", 2, sizeof results.prepare, sizeof results.prepare.table,
      call_prepare, take_prepare_results, numbers_prepare,
      { { 0, 0x9307ab21u, 32 }, { 0, 0x923114a4u, 32 }, { -2, 0xf1af824eu, 32 } },
      0x204be1acu },
    { "mounts", 6, sizeof results.mounts, 0u,
      call_mounts, take_mounts_results, numbers_mounts,
      { { 0, 0xe276c32du, 12 }, { 0, 0x40c8c148u, 12 }, { -2, 0x8e5b0aa0u, 0 } },
      0x27e68ca8u },
    { "prepare_mounts", 2, sizeof results.prepare_mounts, 0u,
      call_prepare_mounts, take_prepare_mounts_results, numbers_prepare_mounts,
      { { 0, 0x236a4d15u, 32 }, { 0, 0x762c1141u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xa46dabe9u },
    { "step_carried", 5, sizeof results.step_carried, sizeof results.step_carried.carry,
      call_step_carried, take_step_carried_results, numbers_step_carried,
      { { 0, 0x20957ac5u, 32 }, { 32, 0xa17693c5u, 32 }, { -2, 0xc0d5eeebu, 17 } },
      0xef98859fu },
    { "step_driven_carried", 5, sizeof results.step_driven_carried, sizeof results.step_driven_carried.carry,
      call_step_driven_carried, take_step_driven_carried_results, numbers_step_driven_carried,
      { { 0, 0x60e5bc1bu, 32 }, { 32, 0xa73bee77u, 32 }, { -2, 0xc0d5eeebu, 17 } },
      0x051341d9u },
};

/* ---- a sweep's inputs: an integer generator, exact scaling ---- */

static uint32_t draw_word(uint32_t *seed)  /* xorshift32 */
{
    uint32_t x = *seed;
    x = x ^ (x << 13);
    x = x ^ (x >> 17);
    x = x ^ (x << 5);
    *seed = x;
    return x;
}

/* A random real in [-largest, largest) from 24 bits. */
static shaker2_real draw_real(uint32_t *seed, shaker2_real largest)
{
    const int32_t part = (int32_t)(draw_word(seed) >> 8) - 8388608;
    return largest * ((shaker2_real)part / 8388608.0);
}

static void draw_reals(uint32_t *seed, shaker2_real *values, int count, shaker2_real largest)
{
    for (int i = 0; i < count; ++i) {
        values[i] = draw_real(seed, largest);
    }
}

static void draw_flags(uint32_t *seed, int *flags, int count)
{
    for (int i = 0; i < count; ++i) {
        flags[i] = (draw_word(seed) >> 30) == 0u ? 1 : 0;
    }
}

/* The square of a quaternion of integers, divided by its length: a unit quaternion; to be refused: of length 2. */
static void draw_attitude(uint32_t *seed, shaker2_real attitude[4], int refused)
{
    const uint32_t word = draw_word(seed);
    const int32_t a = 2 * (int32_t)(word >> 25) - 127;  /* odd, so that not all are 0 */
    const int32_t b = (int32_t)((word >> 16) & 0xffu) - 128;
    const int32_t c = (int32_t)((word >> 8) & 0xffu) - 128;
    const int32_t d = (int32_t)(word & 0xffu) - 128;
    const shaker2_real norm = (shaker2_real)(a * a + b * b + c * c + d * d);
    const shaker2_real factor = refused != 0 ? 2.0 : 1.0;
    attitude[0] = factor * ((shaker2_real)(a * a - b * b - c * c - d * d) / norm);
    attitude[1] = factor * ((shaker2_real)(2 * a * b) / norm);
    attitude[2] = factor * ((shaker2_real)(2 * a * c) / norm);
    attitude[3] = factor * ((shaker2_real)(2 * a * d) / norm);
}

static int draw_int(uint32_t *seed, int lowest, uint32_t span)
{
    return lowest + (int)(draw_word(seed) % span);
}

static int draw_order(uint32_t *seed)
{
    return (draw_word(seed) & 0x100u) != 0u ? 4 : 2;
}

/* A step short enough for light flywheels with strong damping. */
static shaker2_real draw_step(const uint32_t *seed)
{
    (void)seed;
    return 0x1p-14;
}

static shaker2_real draw_factor(uint32_t *seed, shaker2_real largest)
{
    return 1.0 + draw_real(seed, largest);
}

static void draw_powers(uint32_t *seed, shaker2_real *values, int count, shaker2_real least)
{
    for (int i = 0; i < count; ++i) {
        values[i] = least;
        for (uint32_t k = draw_word(seed) >> 27; k > 0u; --k) {
            values[i] = values[i] * 2.0;
        }
    }
}

static shaker2_real draw_share(uint32_t *seed)
{
    const shaker2_real share = draw_real(seed, 1.0);
    return share < 0.0 ? -share : share;
}

static void draw_inputs(uint32_t *seed, unsigned long state)
{
    const shaker2_real fast = state % 4ul == 3ul ? 32.0 : 1.0;
    const int refused = state % 16ul == 15ul ? 1 : 0;
    draw_reals(seed, in.x.position, 3, 2.0);
    draw_attitude(seed, in.x.attitude, refused);
    draw_reals(seed, in.x.V, 6, 2.0);
    draw_reals(seed, in.x.phi, SHAKER2_N, 16.0 * fast);
    draw_reals(seed, in.x.phi_dot, SHAKER2_N, 256.0 * fast);
    draw_reals(seed, in.phi_ddot, SHAKER2_N, 512.0);
    draw_reals(seed, in.V_dot, 6, 16.0);
    draw_reals(seed, in.tau, SHAKER2_N, 2.0);
    draw_flags(seed, in.locked, SHAKER2_N);
    in.dt = draw_step(seed);
    in.order = draw_order(seed);
    draw_reals(seed, &in.phi, 1, 16.0 * fast);
    in.count = draw_int(seed, -1048576, 2097152u);
    in.per_turn = draw_int(seed, 4000, 97u);
    draw_reals(seed, &in.zero, 1, 1.0);
    in.moved = draw_int(seed, -512, 1024u);
    in.encoder.counter = draw_int(seed, -32768, 65536u);
    in.encoder.place = draw_int(seed, 0, 4000u);
    in.encoder.moved = draw_int(seed, -512, 1024u);
    in.counter = draw_int(seed, -32768, 65536u);
    in.bits = draw_int(seed, 16, 1u);
    draw_reals(seed, in.angles, 3, 1.0);
    draw_reals(seed, in.position, 3, 2.0);
    draw_reals(seed, in.q_dot, 6, 2.0);
    draw_reals(seed, in.q_ddot, 6, 16.0);
    draw_reals(seed, in.carry.rounding, 17, 5.960464477539063e-8);
    in.mass_factor = draw_factor(seed, 0.125);
}

static void draw_options(uint32_t *seed)
{
    draw_powers(seed, options.weight, SHAKER2_N, 0.0009765625);
    draw_powers(seed, options.limit, SHAKER2_N, 1.0);
    draw_powers(seed, options.most, SHAKER2_N, 1.0);
    draw_powers(seed, options.motor_torque, SHAKER2_N, 1.52587890625e-5);
    draw_powers(seed, options.motor_speed, SHAKER2_N, 0.00390625);
    draw_powers(seed, options.motor_viscous, SHAKER2_N, 9.313225746154785e-10);
    draw_powers(seed, options.motor_coulomb, SHAKER2_N, 9.5367431640625e-7);
    draw_powers(seed, options.motor_coulomb_speed, SHAKER2_N, 0.00390625);
    options.near_singular = draw_share(seed);
    options.damping = draw_share(seed);
}

/* The parameters of the stand file with all masses and inertias multiplied. */
static void scale_parameters(void)
{
    parameters = shaker2_default_parameters;
    parameters.carrier.mass = parameters.carrier.mass * in.mass_factor;
    for (int i = 0; i < 6; ++i) {
        parameters.carrier.inertia[i] = parameters.carrier.inertia[i] * in.mass_factor;
    }
    for (int i = 0; i < SHAKER2_N; ++i) {
        parameters.flywheel[i].body.mass = parameters.flywheel[i].body.mass * in.mass_factor;
        for (int j = 0; j < 6; ++j) {
            parameters.flywheel[i].body.inertia[j] = parameters.flywheel[i].body.inertia[j] * in.mass_factor;
        }
    }
}

/* ---- the test ---- */

/* Calls one function, then hashes and compares its results. */
static void call(const function *f, tally *sum, int *status)
{
    unsigned char *bytes = results.bytes;
    shaker2_status found;
    for (size_t i = 0; i < f->size; ++i) {
        bytes[i] = (unsigned char)UNTOUCHED;
    }
    found = f->call();
    *status = (int)found;
    take_word(sum, (real_bits)(uint32_t)*status, 4);
    f->take(sum, *status < 0 ? 1 : 0);
    for (size_t i = f->kept; *status < 0 && i < f->size; ++i) {
        sum->touched += bytes[i] != (unsigned char)UNTOUCHED ? 1 : 0;
    }
}

/* The inputs of a golden case. */
static void reset(int number)
{
    in = golden[number];
    table = &shaker2_default;
    options = shaker2_default_options;
    omitted = 0;
    scale_parameters();
}

/* ---- trials: the first golden case with a few inputs changed, into refusals and rare branches ---- */

static void change(int number)
{
    switch (number) {
    case 0:
        in.x.position[0] = not_a_number.real;
        break;
    case 1:
        in.x.position[2] = infinite.real;
        break;
    case 2:
        in.x.position[0] = 0x1p+60;
        break;
    case 3:
        in.x.position[2] = -0x1p+60;
        break;
    case 4:
        in.x.attitude[0] = not_a_number.real;
        break;
    case 5:
        in.x.attitude[3] = infinite.real;
        break;
    case 6:
        in.x.attitude[0] = 0x1p+60;
        break;
    case 7:
        in.x.attitude[3] = -0x1p+60;
        break;
    case 8:
        in.x.V[0] = not_a_number.real;
        break;
    case 9:
        in.x.V[5] = infinite.real;
        break;
    case 10:
        in.x.V[0] = 0x1p+60;
        break;
    case 11:
        in.x.V[5] = -0x1p+60;
        break;
    case 12:
        in.x.phi[0] = not_a_number.real;
        break;
    case 13:
        in.x.phi[1] = infinite.real;
        break;
    case 14:
        in.x.phi[0] = 0x1p+60;
        break;
    case 15:
        in.x.phi[1] = -0x1p+60;
        break;
    case 16:
        in.x.phi_dot[0] = not_a_number.real;
        break;
    case 17:
        in.x.phi_dot[1] = infinite.real;
        break;
    case 18:
        in.x.phi_dot[0] = 0x1p+60;
        break;
    case 19:
        in.x.phi_dot[1] = -0x1p+60;
        break;
    case 20:
        in.phi_ddot[0] = not_a_number.real;
        break;
    case 21:
        in.phi_ddot[1] = infinite.real;
        break;
    case 22:
        in.phi_ddot[0] = 0x1p+60;
        break;
    case 23:
        in.phi_ddot[1] = -0x1p+60;
        break;
    case 24:
        in.V_dot[0] = not_a_number.real;
        break;
    case 25:
        in.V_dot[5] = infinite.real;
        break;
    case 26:
        in.V_dot[0] = 0x1p+60;
        break;
    case 27:
        in.V_dot[5] = -0x1p+60;
        break;
    case 28:
        in.tau[0] = not_a_number.real;
        break;
    case 29:
        in.tau[1] = infinite.real;
        break;
    case 30:
        in.tau[0] = 0x1p+60;
        break;
    case 31:
        in.tau[1] = -0x1p+60;
        break;
    case 32:
        in.dt = not_a_number.real;
        break;
    case 33:
        in.dt = infinite.real;
        break;
    case 34:
        in.dt = 0x1p+60;
        break;
    case 35:
        in.dt = -0x1p+60;
        break;
    case 36:
        in.dt = 0x0p+0;
        break;
    case 37:
        in.dt = -0x1.0624dd2f1a9fcp-10;
        break;
    case 38:
        in.order = -2;
        break;
    case 39:
        in.order = 0;
        break;
    case 40:
        in.order = 1;
        break;
    case 41:
        in.order = 3;
        break;
    case 42:
        in.order = 5;
        break;
    case 43:
        in.phi = not_a_number.real;
        break;
    case 44:
        in.phi = infinite.real;
        break;
    case 45:
        in.phi = 0x1p+60;
        break;
    case 46:
        in.phi = -0x1p+60;
        break;
    case 47:
        in.per_turn = 0;
        break;
    case 48:
        in.per_turn = 2147483647;
        break;
    case 49:
        in.per_turn = -2147483647;
        break;
    case 50:
        in.zero = not_a_number.real;
        break;
    case 51:
        in.zero = infinite.real;
        break;
    case 52:
        in.zero = 0x1p+60;
        break;
    case 53:
        in.zero = -0x1p+60;
        break;
    case 54:
        in.encoder.place = -1;
        break;
    case 55:
        in.encoder.place = 4097;
        break;
    case 56:
        in.bits = -1;
        break;
    case 57:
        in.bits = 1;
        break;
    case 58:
        in.bits = 33;
        break;
    case 59:
        in.angles[0] = not_a_number.real;
        break;
    case 60:
        in.angles[2] = infinite.real;
        break;
    case 61:
        in.angles[0] = 0x1p+60;
        break;
    case 62:
        in.angles[2] = -0x1p+60;
        break;
    case 63:
        in.position[0] = not_a_number.real;
        break;
    case 64:
        in.position[2] = infinite.real;
        break;
    case 65:
        in.position[0] = 0x1p+60;
        break;
    case 66:
        in.position[2] = -0x1p+60;
        break;
    case 67:
        in.q_dot[0] = not_a_number.real;
        break;
    case 68:
        in.q_dot[5] = infinite.real;
        break;
    case 69:
        in.q_dot[0] = 0x1p+60;
        break;
    case 70:
        in.q_dot[5] = -0x1p+60;
        break;
    case 71:
        in.q_ddot[0] = not_a_number.real;
        break;
    case 72:
        in.q_ddot[5] = infinite.real;
        break;
    case 73:
        in.q_ddot[0] = 0x1p+60;
        break;
    case 74:
        in.q_ddot[5] = -0x1p+60;
        break;
    case 75:
        in.carry.rounding[0] = not_a_number.real;
        break;
    case 76:
        in.carry.rounding[16] = infinite.real;
        break;
    case 77:
        in.carry.rounding[0] = 0x1p+60;
        break;
    case 78:
        in.carry.rounding[16] = -0x1p+60;
        break;
    case 79:
        options.weight[0] = not_a_number.real;
        break;
    case 80:
        options.weight[1] = infinite.real;
        break;
    case 81:
        options.weight[0] = 0x1p+60;
        break;
    case 82:
        options.weight[1] = -0x1p+60;
        break;
    case 83:
        options.weight[0] = 0x0p+0;
        break;
    case 84:
        options.weight[0] = -0x1p+0;
        break;
    case 85:
        options.weight[0] = 0x1.ad7f29abcaf48p-24;
        break;
    case 86:
        options.limit[0] = not_a_number.real;
        break;
    case 87:
        options.limit[1] = -0x1p+60;
        break;
    case 88:
        options.limit[0] = 0x0p+0;
        break;
    case 89:
        options.limit[0] = -0x1p+0;
        break;
    case 90:
        options.most[0] = not_a_number.real;
        break;
    case 91:
        options.most[1] = -0x1p+60;
        break;
    case 92:
        options.most[0] = 0x0p+0;
        break;
    case 93:
        options.most[0] = -0x1p+0;
        break;
    case 94:
        options.motor_torque[0] = not_a_number.real;
        break;
    case 95:
        options.motor_torque[1] = -0x1p+60;
        break;
    case 96:
        options.motor_torque[0] = -0x1p+0;
        break;
    case 97:
        options.motor_speed[0] = not_a_number.real;
        break;
    case 98:
        options.motor_speed[1] = -0x1p+60;
        break;
    case 99:
        options.motor_speed[0] = 0x0p+0;
        break;
    case 100:
        options.motor_speed[0] = -0x1p+0;
        break;
    case 101:
        options.motor_viscous[0] = not_a_number.real;
        break;
    case 102:
        options.motor_viscous[1] = -0x1p+60;
        break;
    case 103:
        options.motor_viscous[0] = -0x1p+0;
        break;
    case 104:
        options.motor_coulomb[0] = not_a_number.real;
        break;
    case 105:
        options.motor_coulomb[1] = -0x1p+60;
        break;
    case 106:
        options.motor_coulomb[0] = -0x1p+0;
        break;
    case 107:
        options.motor_coulomb_speed[0] = not_a_number.real;
        break;
    case 108:
        options.motor_coulomb_speed[1] = -0x1p+60;
        break;
    case 109:
        options.motor_coulomb_speed[0] = 0x0p+0;
        break;
    case 110:
        options.motor_coulomb_speed[0] = -0x1p+0;
        break;
    case 111:
        options.near_singular = not_a_number.real;
        break;
    case 112:
        options.near_singular = infinite.real;
        break;
    case 113:
        options.near_singular = 0x1p+60;
        break;
    case 114:
        options.near_singular = -0x1p+60;
        break;
    case 115:
        options.near_singular = -0x1.999999999999ap-4;
        break;
    case 116:
        options.near_singular = 0x1.8p+0;
        break;
    case 117:
        options.damping = not_a_number.real;
        break;
    case 118:
        options.damping = infinite.real;
        break;
    case 119:
        options.damping = 0x1p+60;
        break;
    case 120:
        options.damping = -0x1p+60;
        break;
    case 121:
        options.damping = -0x1.999999999999ap-4;
        break;
    case 122:
        options.damping = 0x1.8p+0;
        break;
    case 123:
        parameters.carrier.mass = not_a_number.real;
        break;
    case 124:
        parameters.carrier.mass = infinite.real;
        break;
    case 125:
        parameters.carrier.mass = 0x1p+60;
        break;
    case 126:
        parameters.carrier.mass = -0x1p+60;
        break;
    case 127:
        parameters.carrier.mass = -0x1p+0;
        break;
    case 128:
        parameters.carrier.center_of_mass[0] = not_a_number.real;
        break;
    case 129:
        parameters.carrier.center_of_mass[2] = infinite.real;
        break;
    case 130:
        parameters.carrier.center_of_mass[0] = 0x1p+60;
        break;
    case 131:
        parameters.carrier.center_of_mass[2] = -0x1p+60;
        break;
    case 132:
        parameters.carrier.inertia[0] = not_a_number.real;
        break;
    case 133:
        parameters.carrier.inertia[5] = infinite.real;
        break;
    case 134:
        parameters.carrier.inertia[0] = 0x1p+60;
        break;
    case 135:
        parameters.carrier.inertia[5] = -0x1p+60;
        break;
    case 136:
        parameters.carrier.inertia[0] = 0x1p+30;
        break;
    case 137:
        parameters.carrier.inertia[3] = 0x1p+30;
        break;
    case 138:
        parameters.carrier.inertia[0] = -0x1p+0;
        break;
    case 139:
        parameters.carrier.inertia[1] = -0x1p+0;
        break;
    case 140:
        parameters.carrier.inertia[2] = -0x1p+0;
        break;
    case 141:
        parameters.flywheel[0].body.mass = not_a_number.real;
        break;
    case 142:
        parameters.flywheel[0].body.mass = infinite.real;
        break;
    case 143:
        parameters.flywheel[0].body.mass = 0x1p+60;
        break;
    case 144:
        parameters.flywheel[0].body.mass = -0x1p+60;
        break;
    case 145:
        parameters.flywheel[0].body.mass = -0x1p+0;
        break;
    case 146:
        parameters.flywheel[0].body.center_of_mass[0] = not_a_number.real;
        break;
    case 147:
        parameters.flywheel[0].body.center_of_mass[2] = infinite.real;
        break;
    case 148:
        parameters.flywheel[0].body.center_of_mass[0] = 0x1p+60;
        break;
    case 149:
        parameters.flywheel[0].body.center_of_mass[2] = -0x1p+60;
        break;
    case 150:
        parameters.flywheel[0].body.inertia[0] = not_a_number.real;
        break;
    case 151:
        parameters.flywheel[0].body.inertia[5] = infinite.real;
        break;
    case 152:
        parameters.flywheel[0].body.inertia[0] = 0x1p+60;
        break;
    case 153:
        parameters.flywheel[0].body.inertia[5] = -0x1p+60;
        break;
    case 154:
        parameters.flywheel[0].body.inertia[0] = 0x1p+30;
        break;
    case 155:
        parameters.flywheel[0].body.inertia[3] = 0x1p+30;
        break;
    case 156:
        parameters.flywheel[0].body.inertia[0] = -0x1p+0;
        break;
    case 157:
        parameters.flywheel[0].body.inertia[1] = -0x1p+0;
        break;
    case 158:
        parameters.flywheel[0].body.inertia[2] = -0x1p+0;
        break;
    case 159:
        parameters.flywheel[0].position[0] = not_a_number.real;
        break;
    case 160:
        parameters.flywheel[0].position[2] = infinite.real;
        break;
    case 161:
        parameters.flywheel[0].position[0] = 0x1p+60;
        break;
    case 162:
        parameters.flywheel[0].position[2] = -0x1p+60;
        break;
    case 163:
        parameters.flywheel[0].axis[0] = not_a_number.real;
        break;
    case 164:
        parameters.flywheel[0].axis[2] = infinite.real;
        break;
    case 165:
        parameters.flywheel[0].axis[0] = 0x1p+60;
        break;
    case 166:
        parameters.flywheel[0].axis[2] = -0x1p+60;
        break;
    case 167:
        parameters.flywheel[0].axis[0] = 0x0p+0;
        parameters.flywheel[0].axis[1] = 0x0p+0;
        parameters.flywheel[0].axis[2] = 0x0p+0;
        break;
    case 168:
        parameters.flywheel[0].axis[0] = 0x1p+0;
        parameters.flywheel[0].axis[1] = 0x0p+0;
        parameters.flywheel[0].axis[2] = 0x0p+0;
        parameters.flywheel[0].zero[0] = 0x1p+0;
        parameters.flywheel[0].zero[1] = 0x0p+0;
        parameters.flywheel[0].zero[2] = 0x0p+0;
        break;
    case 169:
        parameters.flywheel[0].zero[0] = not_a_number.real;
        break;
    case 170:
        parameters.flywheel[0].zero[2] = infinite.real;
        break;
    case 171:
        parameters.flywheel[0].zero[0] = 0x1p+60;
        break;
    case 172:
        parameters.flywheel[0].zero[2] = -0x1p+60;
        break;
    case 173:
        parameters.flywheel[0].zero[0] = 0x0p+0;
        parameters.flywheel[0].zero[1] = 0x0p+0;
        parameters.flywheel[0].zero[2] = 0x0p+0;
        break;
    case 174:
        parameters.flywheel[0].zero[0] = 0x1p+0;
        parameters.flywheel[0].zero[1] = 0x0p+0;
        parameters.flywheel[0].zero[2] = 0x0p+0;
        parameters.flywheel[0].axis[0] = 0x1p+0;
        parameters.flywheel[0].axis[1] = 0x0p+0;
        parameters.flywheel[0].axis[2] = 0x0p+0;
        break;
    case 175:
        in.dt = 0x1p-3;
        in.order = 2;
        break;
    case 176:
        in.dt = 0x1p-3;
        in.order = 4;
        break;
    case 177:
        in.dt = 0x1p+3;
        in.order = 2;
        break;
    case 178:
        in.dt = 0x1p+3;
        in.order = 4;
        break;
    case 179:
        in.phi = 0x1.8p+1;
        break;
    case 180:
        in.phi = -0x1.8p+1;
        break;
    case 181:
        in.phi = 0x1.921fb54442d18p+1;
        break;
    case 182:
        in.phi = -0x1.921fb54442d18p+1;
        break;
    case 183:
        in.phi = 0x1.cp+1;
        break;
    case 184:
        in.phi = -0x1.cp+1;
        break;
    case 185:
        in.phi = 0x1.2d97c7f3321d2p+3;
        break;
    case 186:
        in.phi = -0x1.2d97c7f3321d2p+3;
        break;
    case 187:
        in.phi = 0x1.f4p+9;
        break;
    case 188:
        in.phi = -0x1.f4p+9;
        break;
    case 189:
        in.bits = 0;
        in.encoder.counter = 0;
        in.counter = 4090;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 190:
        in.bits = 0;
        in.encoder.counter = 0;
        in.counter = 4090;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 191:
        in.bits = 0;
        in.encoder.counter = 4090;
        in.counter = 0;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 192:
        in.bits = 0;
        in.encoder.counter = 4090;
        in.counter = 0;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 193:
        in.bits = 0;
        in.encoder.counter = 100;
        in.counter = 200;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 194:
        in.bits = 0;
        in.encoder.counter = 100;
        in.counter = 200;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 195:
        in.bits = 0;
        in.encoder.counter = -1;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 196:
        in.bits = 0;
        in.encoder.counter = -1;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 197:
        in.bits = 0;
        in.encoder.counter = 4096;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 198:
        in.bits = 0;
        in.encoder.counter = 4096;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 199:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = -1;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 200:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = -1;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 201:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = 4096;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 202:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = 4096;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 203:
        in.bits = 16;
        in.encoder.counter = 32767;
        in.counter = -32768;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 204:
        in.bits = 16;
        in.encoder.counter = 32767;
        in.counter = -32768;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 205:
        in.bits = 16;
        in.encoder.counter = -32768;
        in.counter = 32767;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 206:
        in.bits = 16;
        in.encoder.counter = -32768;
        in.counter = 32767;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 207:
        in.bits = 16;
        in.encoder.counter = 0;
        in.counter = 30000;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 208:
        in.bits = 16;
        in.encoder.counter = 0;
        in.counter = 30000;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 209:
        in.bits = 32;
        in.encoder.counter = 2147483647;
        in.counter = -2147483647;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 210:
        in.bits = 32;
        in.encoder.counter = 2147483647;
        in.counter = -2147483647;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 211:
        in.bits = 32;
        in.encoder.counter = -2147483647;
        in.counter = 2147483647;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 212:
        in.bits = 32;
        in.encoder.counter = -2147483647;
        in.counter = 2147483647;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 213:
        options.near_singular = 0x1p+0;
        break;
    case 214:
        options.near_singular = 0x1p+0;
        options.damping = 0x1p-1;
        break;
    case 215:
        for (int s = 0; s < SHAKER2_N; ++s) { options.limit[s] = 0x1.caf5904ba5a3dp+17; }
        break;
    case 216:
        for (int s = 0; s < SHAKER2_N; ++s) { options.limit[s] = 0x1.31f90add1917ep+16; }
        break;
    case 217:
        for (int s = 0; s < SHAKER2_N; ++s) { options.limit[s] = 0x1.31f90add1917ep+8; }
        break;
    case 218:
        for (int s = 0; s < SHAKER2_N; ++s) { options.weight[s] = 0x1p+2; }
        break;
    case 219:
        for (int s = 0; s < SHAKER2_N; ++s) { options.most[s] = 0x1p-10; }
        break;
    case 220:
        for (int s = 0; s < SHAKER2_N; ++s) { options.motor_torque[s] = 0x1p-10; }
        break;
    case 221:
        for (int s = 0; s < SHAKER2_N; ++s) { options.motor_speed[s] = 0x1p-10; }
        break;
    case 222:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < SHAKER2_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.V_dot[0] = 0x1p-12;
        in.V_dot[1] = -0x1p-12;
        in.V_dot[2] = 0x1p-12;
        in.V_dot[3] = -0x1p-12;
        in.V_dot[4] = 0x1p-12;
        in.V_dot[5] = -0x1p-12;
        break;
    case 223:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < SHAKER2_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.V_dot[0] = 0x1p-6;
        in.V_dot[1] = -0x1p-6;
        in.V_dot[2] = 0x1p-6;
        in.V_dot[3] = -0x1p-6;
        in.V_dot[4] = 0x1p-6;
        in.V_dot[5] = -0x1p-6;
        break;
    case 224:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < SHAKER2_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.V_dot[0] = 0x1p+0;
        in.V_dot[1] = -0x1p+0;
        in.V_dot[2] = 0x1p+0;
        in.V_dot[3] = -0x1p+0;
        in.V_dot[4] = 0x1p+0;
        in.V_dot[5] = -0x1p+0;
        break;
    case 225:
        for (int s = 0; s < SHAKER2_N; ++s) { options.motor_viscous[s] = 0x1p-1; }
        for (int s = 0; s < SHAKER2_N; ++s) { options.motor_coulomb[s] = 0x1p-1; }
        for (int s = 0; s < SHAKER2_N; ++s) { options.motor_coulomb_speed[s] = 0x1p-1; }
        break;
    case 226:
        for (int s = 0; s < SHAKER2_N; ++s) { parameters.flywheel[s].axis[0] = 0x1p+0; }
        for (int s = 0; s < SHAKER2_N; ++s) { parameters.flywheel[s].axis[1] = 0x0p+0; }
        for (int s = 0; s < SHAKER2_N; ++s) { parameters.flywheel[s].axis[2] = 0x0p+0; }
        for (int s = 0; s < SHAKER2_N; ++s) { parameters.flywheel[s].zero[0] = 0x0p+0; }
        for (int s = 0; s < SHAKER2_N; ++s) { parameters.flywheel[s].zero[1] = 0x1p+0; }
        for (int s = 0; s < SHAKER2_N; ++s) { parameters.flywheel[s].body.center_of_mass[1] = 0x0p+0; }
        for (int s = 0; s < SHAKER2_N; ++s) { parameters.flywheel[s].body.center_of_mass[2] = 0x0p+0; }
        for (int s = 0; s < SHAKER2_N; ++s) { parameters.flywheel[s].body.inertia[3] = 0x0p+0; }
        for (int s = 0; s < SHAKER2_N; ++s) { parameters.flywheel[s].body.inertia[4] = 0x0p+0; }
        break;
    case 227:
        for (int s = 0; s < SHAKER2_N; ++s) { options.limit[s] = 0x1.caf5904ba5a36p+17; }
        break;
    case 228:
        for (int s = 0; s < SHAKER2_N; ++s) { options.limit[s] = 0x1.31f90add19179p+16; }
        break;
    case 229:
        for (int s = 0; s < SHAKER2_N; ++s) { options.limit[s] = 0x1.31f90add19179p+8; }
        break;
    case 230:
        in.angles[1] = 0x0p+0;
        break;
    case 231:
        in.angles[1] = 0x1.921fb54442d18p+0;
        break;
    default:
        break;
    }
}

typedef struct trial {
    int change;
    int status;
    int prepared;                    /* 1: with the table that prepare makes of changed parameters */
    uint32_t hash;                   /* as of a golden case; 0 where the call is refused */
    uint32_t functions[1];           /* one bit each */
} trial;

static const trial trials[] =
{
    { 0, -1, 0, 0x00000000u, { 0x6a787fu } },
    { 1, -1, 0, 0x00000000u, { 0x6a787fu } },
    { 2, -2, 0, 0x00000000u, { 0x6a787fu } },
    { 3, -2, 0, 0x00000000u, { 0x6a787fu } },
    { 4, -1, 0, 0x00000000u, { 0x68787fu } },
    { 5, -1, 0, 0x00000000u, { 0x68787fu } },
    { 6, -2, 0, 0x00000000u, { 0x68787fu } },
    { 7, -2, 0, 0x00000000u, { 0x68787fu } },
    { 8, -1, 0, 0x00000000u, { 0x6a787fu } },
    { 9, -1, 0, 0x00000000u, { 0x6a787fu } },
    { 10, -2, 0, 0x00000000u, { 0x6a787fu } },
    { 11, -2, 0, 0x00000000u, { 0x6a787fu } },
    { 12, -1, 0, 0x00000000u, { 0x6a787fu } },
    { 13, -1, 0, 0x00000000u, { 0x6a787fu } },
    { 14, -2, 0, 0x00000000u, { 0x6a787fu } },
    { 15, -2, 0, 0x00000000u, { 0x6a787fu } },
    { 16, -1, 0, 0x00000000u, { 0x6a787fu } },
    { 17, -1, 0, 0x00000000u, { 0x6a787fu } },
    { 18, -2, 0, 0x00000000u, { 0x6a787fu } },
    { 19, -2, 0, 0x00000000u, { 0x6a787fu } },
    { 20, -1, 0, 0x00000000u, { 0x4a0849u } },
    { 21, -1, 0, 0x00000000u, { 0x4a0849u } },
    { 22, -2, 0, 0x00000000u, { 0x4a0849u } },
    { 23, -2, 0, 0x00000000u, { 0x4a0849u } },
    { 24, -1, 0, 0x00000000u, { 0x86008u } },
    { 25, -1, 0, 0x00000000u, { 0x86008u } },
    { 26, -2, 0, 0x00000000u, { 0x86008u } },
    { 27, -2, 0, 0x00000000u, { 0x86008u } },
    { 28, -1, 0, 0x00000000u, { 0x201030u } },
    { 29, -1, 0, 0x00000000u, { 0x201030u } },
    { 30, -2, 0, 0x00000000u, { 0x201030u } },
    { 31, -2, 0, 0x00000000u, { 0x201030u } },
    { 32, -1, 0, 0x00000000u, { 0x600260u } },
    { 33, -1, 0, 0x00000000u, { 0x600260u } },
    { 34, -2, 0, 0x00000000u, { 0x600260u } },
    { 35, -2, 0, 0x00000000u, { 0x600260u } },
    { 36, -5, 0, 0x00000000u, { 0x600260u } },
    { 37, -5, 0, 0x00000000u, { 0x600260u } },
    { 38, -5, 0, 0x00000000u, { 0x600060u } },
    { 39, -5, 0, 0x00000000u, { 0x600060u } },
    { 40, -5, 0, 0x00000000u, { 0x600060u } },
    { 41, -5, 0, 0x00000000u, { 0x600060u } },
    { 42, -5, 0, 0x00000000u, { 0x600060u } },
    { 43, -1, 0, 0x00000000u, { 0x80u } },
    { 44, -1, 0, 0x00000000u, { 0x80u } },
    { 45, -2, 0, 0x00000000u, { 0x80u } },
    { 46, -2, 0, 0x00000000u, { 0x80u } },
    { 47, -5, 0, 0x00000000u, { 0x700u } },
    { 48, -5, 0, 0x00000000u, { 0x700u } },
    { 49, -5, 0, 0x00000000u, { 0x700u } },
    { 50, -1, 0, 0x00000000u, { 0x100u } },
    { 51, -1, 0, 0x00000000u, { 0x100u } },
    { 52, -2, 0, 0x00000000u, { 0x100u } },
    { 53, -2, 0, 0x00000000u, { 0x100u } },
    { 54, -5, 0, 0x00000000u, { 0x400u } },
    { 55, -5, 0, 0x00000000u, { 0x400u } },
    { 56, -5, 0, 0x00000000u, { 0x400u } },
    { 57, -5, 0, 0x00000000u, { 0x400u } },
    { 58, -5, 0, 0x00000000u, { 0x400u } },
    { 59, -1, 0, 0x00000000u, { 0x38000u } },
    { 60, -1, 0, 0x00000000u, { 0x38000u } },
    { 61, -2, 0, 0x00000000u, { 0x38000u } },
    { 62, -2, 0, 0x00000000u, { 0x38000u } },
    { 63, -1, 0, 0x00000000u, { 0x10000u } },
    { 64, -1, 0, 0x00000000u, { 0x10000u } },
    { 65, -2, 0, 0x00000000u, { 0x10000u } },
    { 66, -2, 0, 0x00000000u, { 0x10000u } },
    { 67, -1, 0, 0x00000000u, { 0x10000u } },
    { 68, -1, 0, 0x00000000u, { 0x10000u } },
    { 69, -2, 0, 0x00000000u, { 0x10000u } },
    { 70, -2, 0, 0x00000000u, { 0x10000u } },
    { 71, -1, 0, 0x00000000u, { 0x10000u } },
    { 72, -1, 0, 0x00000000u, { 0x10000u } },
    { 73, -2, 0, 0x00000000u, { 0x10000u } },
    { 74, -2, 0, 0x00000000u, { 0x10000u } },
    { 75, -1, 0, 0x00000000u, { 0x600000u } },
    { 76, -1, 0, 0x00000000u, { 0x600000u } },
    { 77, -2, 0, 0x00000000u, { 0x600000u } },
    { 78, -2, 0, 0x00000000u, { 0x600000u } },
    { 79, -1, 0, 0x00000000u, { 0x6000u } },
    { 80, -1, 0, 0x00000000u, { 0x6000u } },
    { 81, -2, 0, 0x00000000u, { 0x6000u } },
    { 82, -2, 0, 0x00000000u, { 0x6000u } },
    { 83, -2, 0, 0x00000000u, { 0x6000u } },
    { 84, -2, 0, 0x00000000u, { 0x6000u } },
    { 85, -2, 0, 0x00000000u, { 0x6000u } },
    { 86, -1, 0, 0x00000000u, { 0x2000u } },
    { 87, -5, 0, 0x00000000u, { 0x2000u } },
    { 88, -5, 0, 0x00000000u, { 0x2000u } },
    { 89, -5, 0, 0x00000000u, { 0x2000u } },
    { 90, -1, 0, 0x00000000u, { 0x2000u } },
    { 91, -5, 0, 0x00000000u, { 0x2000u } },
    { 92, -5, 0, 0x00000000u, { 0x2000u } },
    { 93, -5, 0, 0x00000000u, { 0x2000u } },
    { 94, -1, 0, 0x00000000u, { 0x2000u } },
    { 95, -5, 0, 0x00000000u, { 0x2000u } },
    { 96, -5, 0, 0x00000000u, { 0x2000u } },
    { 97, -1, 0, 0x00000000u, { 0x2000u } },
    { 98, -5, 0, 0x00000000u, { 0x2000u } },
    { 99, -5, 0, 0x00000000u, { 0x2000u } },
    { 100, -5, 0, 0x00000000u, { 0x2000u } },
    { 101, -1, 0, 0x00000000u, { 0x2000u } },
    { 102, -5, 0, 0x00000000u, { 0x2000u } },
    { 103, -5, 0, 0x00000000u, { 0x2000u } },
    { 104, -1, 0, 0x00000000u, { 0x2000u } },
    { 105, -5, 0, 0x00000000u, { 0x2000u } },
    { 106, -5, 0, 0x00000000u, { 0x2000u } },
    { 107, -1, 0, 0x00000000u, { 0x2000u } },
    { 108, -5, 0, 0x00000000u, { 0x2000u } },
    { 109, -5, 0, 0x00000000u, { 0x2000u } },
    { 110, -5, 0, 0x00000000u, { 0x2000u } },
    { 111, -1, 0, 0x00000000u, { 0x2000u } },
    { 112, -1, 0, 0x00000000u, { 0x2000u } },
    { 113, -5, 0, 0x00000000u, { 0x2000u } },
    { 114, -5, 0, 0x00000000u, { 0x2000u } },
    { 115, -5, 0, 0x00000000u, { 0x2000u } },
    { 116, -5, 0, 0x00000000u, { 0x2000u } },
    { 117, -1, 0, 0x00000000u, { 0x6000u } },
    { 118, -1, 0, 0x00000000u, { 0x6000u } },
    { 119, -5, 0, 0x00000000u, { 0x6000u } },
    { 120, -5, 0, 0x00000000u, { 0x6000u } },
    { 121, -5, 0, 0x00000000u, { 0x6000u } },
    { 122, -5, 0, 0x00000000u, { 0x6000u } },
    { 123, -1, 0, 0x00000000u, { 0x140000u } },
    { 124, -1, 0, 0x00000000u, { 0x140000u } },
    { 125, -2, 0, 0x00000000u, { 0x140000u } },
    { 126, -2, 0, 0x00000000u, { 0x140000u } },
    { 127, -2, 0, 0x00000000u, { 0x140000u } },
    { 128, -1, 0, 0x00000000u, { 0x140000u } },
    { 129, -1, 0, 0x00000000u, { 0x140000u } },
    { 130, -2, 0, 0x00000000u, { 0x140000u } },
    { 131, -2, 0, 0x00000000u, { 0x140000u } },
    { 132, -1, 0, 0x00000000u, { 0x140000u } },
    { 133, -1, 0, 0x00000000u, { 0x140000u } },
    { 134, -2, 0, 0x00000000u, { 0x140000u } },
    { 135, -2, 0, 0x00000000u, { 0x140000u } },
    { 136, -3, 0, 0x00000000u, { 0x140000u } },
    { 137, -3, 0, 0x00000000u, { 0x140000u } },
    { 138, -3, 0, 0x00000000u, { 0x140000u } },
    { 139, -3, 0, 0x00000000u, { 0x140000u } },
    { 140, -3, 0, 0x00000000u, { 0x140000u } },
    { 141, -1, 0, 0x00000000u, { 0x140000u } },
    { 142, -1, 0, 0x00000000u, { 0x140000u } },
    { 143, -2, 0, 0x00000000u, { 0x140000u } },
    { 144, -2, 0, 0x00000000u, { 0x140000u } },
    { 145, -2, 0, 0x00000000u, { 0x140000u } },
    { 146, -1, 0, 0x00000000u, { 0x140000u } },
    { 147, -1, 0, 0x00000000u, { 0x140000u } },
    { 148, -2, 0, 0x00000000u, { 0x140000u } },
    { 149, -2, 0, 0x00000000u, { 0x140000u } },
    { 150, -1, 0, 0x00000000u, { 0x140000u } },
    { 151, -1, 0, 0x00000000u, { 0x140000u } },
    { 152, -2, 0, 0x00000000u, { 0x140000u } },
    { 153, -2, 0, 0x00000000u, { 0x140000u } },
    { 154, -3, 0, 0x00000000u, { 0x140000u } },
    { 155, -3, 0, 0x00000000u, { 0x140000u } },
    { 156, -3, 0, 0x00000000u, { 0x140000u } },
    { 157, -3, 0, 0x00000000u, { 0x140000u } },
    { 158, -3, 0, 0x00000000u, { 0x140000u } },
    { 159, -1, 0, 0x00000000u, { 0x140000u } },
    { 160, -1, 0, 0x00000000u, { 0x140000u } },
    { 161, -2, 0, 0x00000000u, { 0x140000u } },
    { 162, -2, 0, 0x00000000u, { 0x140000u } },
    { 163, -1, 0, 0x00000000u, { 0x140000u } },
    { 164, -1, 0, 0x00000000u, { 0x140000u } },
    { 165, -2, 0, 0x00000000u, { 0x140000u } },
    { 166, -2, 0, 0x00000000u, { 0x140000u } },
    { 167, -2, 0, 0x00000000u, { 0x140000u } },
    { 168, -2, 0, 0x00000000u, { 0x140000u } },
    { 169, -1, 0, 0x00000000u, { 0x140000u } },
    { 170, -1, 0, 0x00000000u, { 0x140000u } },
    { 171, -2, 0, 0x00000000u, { 0x140000u } },
    { 172, -2, 0, 0x00000000u, { 0x140000u } },
    { 173, -2, 0, 0x00000000u, { 0x140000u } },
    { 174, -2, 0, 0x00000000u, { 0x140000u } },
    { 175, -2, 0, 0x00000000u, { 0x20u } },
    { 176, -2, 0, 0x00000000u, { 0x20u } },
    { 177, -2, 0, 0x00000000u, { 0x20u } },
    { 178, -2, 0, 0x00000000u, { 0x20u } },
    { 175, -2, 0, 0x00000000u, { 0x40u } },
    { 176, -2, 0, 0x00000000u, { 0x40u } },
    { 177, -2, 0, 0x00000000u, { 0x40u } },
    { 178, -2, 0, 0x00000000u, { 0x40u } },
    { 179, 0, 0, 0x72282aadu, { 0x80u } },
    { 180, 0, 0, 0xf227612du, { 0x80u } },
    { 181, 0, 0, 0x6dbc9d0bu, { 0x80u } },
    { 182, 0, 0, 0xedbbd38bu, { 0x80u } },
    { 183, 0, 0, 0x4b2a4c63u, { 0x80u } },
    { 184, 0, 0, 0xcb2982e3u, { 0x80u } },
    { 185, 0, 0, 0xaf14ed94u, { 0x80u } },
    { 186, 0, 0, 0x2f142414u, { 0x80u } },
    { 187, 0, 0, 0xe25220bbu, { 0x80u } },
    { 188, 0, 0, 0x6252ea3bu, { 0x80u } },
    { 189, 0, 0, 0x45f6a788u, { 0x400u } },
    { 190, 0, 0, 0x66f2bedfu, { 0x400u } },
    { 191, 0, 0, 0x4efed8e5u, { 0x400u } },
    { 192, 0, 0, 0x778bb7c6u, { 0x400u } },
    { 193, 0, 0, 0x20f0410du, { 0x400u } },
    { 194, 0, 0, 0x7d84e86au, { 0x400u } },
    { 195, -5, 0, 0x00000000u, { 0x400u } },
    { 196, -5, 0, 0x00000000u, { 0x400u } },
    { 197, -5, 0, 0x00000000u, { 0x400u } },
    { 198, -5, 0, 0x00000000u, { 0x400u } },
    { 199, -5, 0, 0x00000000u, { 0x400u } },
    { 200, -5, 0, 0x00000000u, { 0x400u } },
    { 201, -5, 0, 0x00000000u, { 0x400u } },
    { 202, -5, 0, 0x00000000u, { 0x400u } },
    { 203, 0, 0, 0x8010280bu, { 0x400u } },
    { 204, 0, 0, 0x3d19090au, { 0x400u } },
    { 205, 0, 0, 0x8c9f1d9du, { 0x400u } },
    { 206, 0, 0, 0x2c5df8dcu, { 0x400u } },
    { 207, 0, 0, 0x20aa110eu, { 0x400u } },
    { 208, 0, 0, 0x5194e811u, { 0x400u } },
    { 209, 0, 0, 0x0be66f74u, { 0x400u } },
    { 210, 0, 0, 0xef360c97u, { 0x400u } },
    { 211, 0, 0, 0x37e41a43u, { 0x400u } },
    { 212, 0, 0, 0x651f6e64u, { 0x400u } },
    { 213, 73, 0, 0xf6b135c9u, { 0x2000u } },
    { 214, 75, 0, 0x4a8c9ed4u, { 0x2000u } },
    { 215, 76, 0, 0x18e8a774u, { 0x2000u } },
    { 216, 76, 0, 0x77aadef3u, { 0x2000u } },
    { 217, 12, 0, 0xca0965d8u, { 0x2000u } },
    { 218, 72, 0, 0x30bccf48u, { 0x2000u } },
    { 219, 72, 0, 0x30bccf48u, { 0x2000u } },
    { 220, 72, 0, 0x30bccf48u, { 0x2000u } },
    { 221, 72, 0, 0x30bccf48u, { 0x2000u } },
    { 222, 72, 0, 0xe9ca7918u, { 0x2000u } },
    { 223, 72, 0, 0x76e54ba6u, { 0x2000u } },
    { 224, 72, 0, 0xd0e625b6u, { 0x2000u } },
    { 225, 72, 0, 0x30bccf48u, { 0x2000u } },
    { 226, 24, 1, 0x75fd07e6u, { 0x2000u } },
    { 213, 64, 0, 0x1ec9b0c6u, { 0x4000u } },
    { 214, 64, 0, 0x14111e0bu, { 0x4000u } },
    { 227, 64, 0, 0x1ec9b0c6u, { 0x4000u } },
    { 228, 64, 0, 0x1ec9b0c6u, { 0x4000u } },
    { 229, 64, 0, 0x1ec9b0c6u, { 0x4000u } },
    { 218, 64, 0, 0x1ec9b0c6u, { 0x4000u } },
    { 219, 64, 0, 0x1ec9b0c6u, { 0x4000u } },
    { 220, 64, 0, 0x1ec9b0c6u, { 0x4000u } },
    { 221, 64, 0, 0x1ec9b0c6u, { 0x4000u } },
    { 222, 64, 0, 0xbebae237u, { 0x4000u } },
    { 223, 64, 0, 0x00a62683u, { 0x4000u } },
    { 224, 64, 0, 0x9791e694u, { 0x4000u } },
    { 225, 64, 0, 0x1ec9b0c6u, { 0x4000u } },
    { 226, -3, 1, 0x00000000u, { 0x4000u } },
    { 230, 0, 0, 0xc4a42b3au, { 0x8000u } },
    { 231, 0, 0, 0x82f82594u, { 0x8000u } },
    { 230, 0, 0, 0xbd82184du, { 0x10000u } },
    { 231, -4, 0, 0x00000000u, { 0x10000u } },
    { 230, 0, 0, 0x1b28ddabu, { 0x20000u } },
    { 231, -4, 0, 0x00000000u, { 0x20000u } },
    { 175, -2, 0, 0x00000000u, { 0x200000u } },
    { 176, -2, 0, 0x00000000u, { 0x200000u } },
    { 177, -2, 0, 0x00000000u, { 0x200000u } },
    { 178, -2, 0, 0x00000000u, { 0x200000u } },
    { 175, -2, 0, 0x00000000u, { 0x400000u } },
    { 176, -2, 0, 0x00000000u, { 0x400000u } },
    { 177, -2, 0, 0x00000000u, { 0x400000u } },
    { 178, -2, 0, 0x00000000u, { 0x400000u } },
};

/* Makes all trials of one function, and leaves out each pointer in turn; returns how many are wrong. */
static uint32_t run_trials(int number)
{
    static shaker2_table prepared;
    const function *f = &functions[number];
    uint32_t wrong = 0u;
    tally sum;
    int status;
    for (size_t i = 0u; i < sizeof trials / sizeof trials[0]; ++i) {
        const trial *t = &trials[i];
        if (((t->functions[number / 32] >> (number % 32)) & 1u) != 0u) {
            reset(0);
            change(t->change);
            if (t->prepared != 0) {
                prepared = shaker2_default;  /* prepare keeps what is not of the bodies */
                (void)shaker2_prepare(&parameters, &prepared);
                table = &prepared;
            }
            begin(&sum);
            call(f, &sum, &status);
            if (status != t->status || sum.touched != 0 || (status >= 0 && sum.hash != t->hash)) {
                wrong = wrong + 1u;
            }
        }
    }
    for (int i = 1; i <= f->pointers; ++i) {
        reset(0);
        omitted = i;
        begin(&sum);
        call(f, &sum, &status);
        if (status != (int)SHAKER2_BAD_ARGUMENT || sum.touched != 0) {
            wrong = wrong + 1u;
        }
    }
    return wrong;
}

static char line[160];
static size_t length;

static void add_text(const char *text)
{
    for (size_t i = 0; text[i] != '\0' && length + 1u < sizeof line; ++i) {
        line[length] = text[i];
        length = length + 1u;
    }
    line[length] = '\0';
}

static void add_decimal(uint64_t value)
{
    char digits[21];
    size_t i = sizeof digits - 1u;
    digits[i] = '\0';
    do {
        i = i - 1u;
        digits[i] = (char)('0' + (int)(value % 10u));
        value = value / 10u;
    } while (value != 0u);
    add_text(&digits[i]);
}

static void add_hash(uint32_t value)
{
    char digits[9];
    for (int i = 7; i >= 0; --i) {
        digits[i] = "0123456789abcdef"[value & 0xfu];
        value = value >> 4;
    }
    digits[8] = '\0';
    add_text(digits);
}

static void end_line(void (*print)(const char *text))
{
    add_text("\n");
    print(line);
    length = 0u;
}

/* Does the compiler keep more digits than a real has, as x87 does? */
enum { EXCESS = (FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1 && FLT_EVAL_METHOD != 16) ? 1 : 0 };

/* Whether a sum is rounded as the code relies on: 0.7 + 6755399441055744.0 is a whole number, so the result is 1.
 * With fast math the constant is cancelled and 0.7 is left. */
static int rounds_to_integer(void)
{
    volatile shaker2_real x = 0.7;
    const shaker2_real whole = (x + 6755399441055744.0) - 6755399441055744.0;
    return bits_of(whole) == bits_of(1.0);
}

/* Adds a word to the list of what is wrong. */
static void add_fault(int found, const char *word, int *first)
{
    if (found != 0) {
        add_text(*first != 0 ? " (" : ", ");
        add_text(word);
        *first = 0;
    }
}

/* Tests the golden vectors of one function; returns 0 if all are right. */
static int judge(const function *f, uint32_t swept, uint32_t amiss, void (*print)(const char *text))
{
    const shaker2_real *numbers = f->numbers;
    real_bits worst = 0u;
    uint32_t wrong = 0u;
    int statuses = 0;
    int others = 0;
    int written = 0;
    int first = 1;
    for (int i = 0; i < CASES; ++i) {
        const answer *expected = &f->answers[i];
        tally sum;
        int status;
        reset(i);
        begin(&sum);
        sum.expected = numbers;
        sum.left = expected->listed;
        call(f, &sum, &status);
        numbers += expected->listed;
        worst = sum.worst > worst ? sum.worst : worst;
        statuses = status != expected->status ? 1 : statuses;
        written = sum.touched != 0 ? 1 : written;
        others = status == expected->status && sum.worst == 0u && sum.hash != expected->hash ? 1 : others;
        if (status != expected->status || sum.hash != expected->hash || sum.worst != 0u || sum.touched != 0) {
            wrong = wrong + 1u;
        }
    }
    if (swept != f->swept) {
        wrong = wrong + 1u;
    }
    if (amiss != 0u) {
        wrong = wrong + 1u;
    }
    add_text(f->name);
    add_text(wrong == 0u ? " PASS cases " : " FAIL cases ");
    add_decimal((uint64_t)CASES + 2u);
    if (wrong != 0u) {
        add_text(" wrong ");
        add_decimal(wrong);
        add_fault(statuses, "status", &first);
        add_fault(worst != 0u, "numbers", &first);
        add_fault(others, "other members", &first);
        add_fault(swept != f->swept, "sweep", &first);
        add_fault(amiss != 0u, "trials", &first);
        add_fault(written, "written though refused", &first);
        add_text(first != 0 ? "" : ")");
    }
    if (wrong == 0u || worst != 0u) {
        add_text(worst > FARTHEST ? " worst more than " : " worst ");
        add_decimal(worst > FARTHEST ? FARTHEST : worst);
        add_text(" ulp");
    }
    end_line(print);
    return wrong != 0u ? 1 : 0;
}

static tally sums[FUNCTIONS];

/* Prints a hash of every function over a number of states. */
static void run_sweep(unsigned long states)
{
    uint32_t seed = 0x6d61686fu;
    for (int i = 0; i < FUNCTIONS; ++i) {
        begin(&sums[i]);
    }
    for (unsigned long state = 0u; state < states; ++state) {
        reset(0);
        draw_inputs(&seed, state);
        scale_parameters();
        if (state % 2ul == 1ul) {
            draw_options(&seed);
        }
        omitted = state % 3ul == 2ul ? -1 : 0;
        for (int i = 0; i < FUNCTIONS; ++i) {
            int status;
            call(&functions[i], &sums[i], &status);
        }
    }
}

/* Runs all tests and prints one line per call of `print`; returns the number of functions that failed. */
int shaker2_selftest(void (*print)(const char *text), unsigned long sweep)
{
    int failures = 0;
    length = 0u;
    (void)shaker2_prepare_mounts(&shaker2_default_parameters, &mounting);
    if (EXCESS != 0 || rounds_to_integer() == 0) {
        add_text("wrong results: compiled with ");
        add_text(EXCESS != 0 ? "x87 arithmetic, without -msse2 -mfpmath=sse"
                             : "-ffast-math, -Ofast, -funsafe-math-optimizations or a part of them");
        end_line(print);
    }
    add_text("mahovik selftest shaker2 structure 94a85f4a physics 2591b2a4 real double");
    end_line(print);
    add_text("generator mahovik 0.1.0");
    end_line(print);
    run_sweep((unsigned long)SWEPT);
    for (int i = 0; i < FUNCTIONS; ++i) {
        failures += judge(&functions[i], sums[i].hash, run_trials(i), print);
    }
    run_sweep(sweep);
    add_text("sweep ");
    add_decimal(sweep);
    end_line(print);
    for (int i = 0; i < FUNCTIONS; ++i) {
        add_text(functions[i].name);
        add_text(" ");
        add_hash(sums[i].hash);
        end_line(print);
    }
    add_text("failures ");
    add_decimal((uint64_t)failures);
    end_line(print);
    return failures;
}

#ifdef SHAKER2_SELFTEST_MAIN
static void print_text(const char *text)
{
    (void)fputs(text, stdout);
}

int main(void)
{
    return shaker2_selftest(print_text, SHAKER2_SELFTEST_SWEEP) != 0;
}
#endif
