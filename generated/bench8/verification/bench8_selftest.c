/* bench8_selftest.c: does bench8.c give the right bits on this machine?
 * With -ffast-math or its parts it gives wrong results with status OK: this test fails.
 * mahovik 0.1.0; structure 309d41a6, physics 139422e0. Generated: change the stand file instead.
 *
 * Compile it with bench8.c as firmware is compiled (-std=c99 -ffp-contract=off; -fno-tree-vectorize as well by gcc
 * for x86-64 with FMA and for a Cortex-M55, or bits differ) and with
 * -DBENCH8_SELFTEST_MAIN, and run it; on a board, without that macro, call bench8_selftest with a function that
 * prints a text, such as to a serial port.
 * Golden vectors: inputs and answers of the generator's interpreter as hexadecimal constants; each bit must agree.
 * Trials: the first of them with a few inputs changed: every status, wrong numbers, null pointers; known as well.
 * Sweep: states drawn by an integer generator; one hash per function of all its answers is printed, to be
 * compared between machines. The log of a board is judged by `mahovik judge-log STAND.toml --log LOG`. It reads:
 *
 *     wrong results: compiled with ...   only if that is so: first, and then functions FAIL
 *     mahovik selftest bench8 structure 309d41a6 physics 139422e0 real double
 *     generator mahovik 0.1.0
 *     forward PASS cases 5 worst 0 ulp      one line per function; FAIL gives the number of wrong cases and
 *                                        what is wrong of them, such as "(status, numbers)"; with numbers worst is
 *                                        their largest distance, or "more than 1000000"
 *     sweep 100                          states
 *     forward 0123abcd                   one line per function: FNV-1a hash of its statuses and outputs
 *     failures 0                         functions that failed; the last line
 *
 * No allocation. It keeps inputs and results in static memory: one caller at a time. */
#include "../bench8.h"

#include <float.h>
#include <stddef.h>
#include <stdint.h>
#ifdef BENCH8_SELFTEST_MAIN
#include <stdio.h>
#endif

#if BENCH8_STRUCTURE != 0x309d41a6u || BENCH8_PHYSICS != 0x139422e0u
#error "bench8.h and bench8_selftest.c are of different stands"
#endif

#ifndef BENCH8_SELFTEST_SWEEP
#define BENCH8_SELFTEST_SWEEP 100ul  /* states of the sweep that main runs */
#endif

int bench8_selftest(void (*print)(const char *text), unsigned long sweep);

typedef uint64_t real_bits;

enum { CASES = 3, FUNCTIONS = 23, SWEPT = 4 };

#define FARTHEST ((real_bits)1000000u)  /* ulp: a worse distance is not printed as a number */

/* ---- inputs and results ---- */

/* Arguments of the functions, apart from the constants of the stand. */
typedef struct inputs {
    bench8_state x;
    bench8_real phi_ddot[BENCH8_N];
    bench8_real V_dot[6];
    bench8_real tau[BENCH8_N];
    int locked[BENCH8_N];
    bench8_real dt;
    int order;
    bench8_real phi;
    int count;
    int per_turn;
    bench8_real zero;
    int moved;
    bench8_encoder encoder;
    int counter;
    int bits;
    bench8_real angles[3];
    bench8_real position[3];
    bench8_real q_dot[6];
    bench8_real q_ddot[6];
    bench8_step_carry carry;
    bench8_real mass_factor;  /* multiplies all masses and inertias of the parameters */
} inputs;

static inputs in;
static bench8_parameters parameters;
static const bench8_table *table = &bench8_default;
static bench8_inverse_options options;
static int omitted;  /* the argument that is null, from 1; 0: none; -1: all that may be null */
static bench8_mount_table mounting;

static union {
    struct { bench8_real V_dot[6]; } forward;
    struct { bench8_matrices_result out; } matrices;
    struct { bench8_momentum_result out; } momentum;
    struct { bench8_real tau[BENCH8_N]; } torque;
    struct { bench8_real V_dot[6]; bench8_real phi_ddot[BENCH8_N]; } coupled;
    struct { bench8_state next; } step;
    struct { bench8_state next; } step_driven;
    struct { bench8_real wrapped; } wrap;
    struct { bench8_real phi; } phase_of_counts;
    struct { bench8_real phi_dot; } speed_of_counts;
    struct { bench8_encoder encoder; } accumulate;
    struct { bench8_forward_jacobian_result out; } forward_jacobian;
    struct { bench8_coupled_jacobian_result out; } coupled_jacobian;
    struct { bench8_inverse_result out; } inverse;
    struct { bench8_real phi_ddot[BENCH8_N]; } inverse_fast;
    struct { bench8_real attitude[4]; } quaternion;
    struct { bench8_state x; bench8_real V_dot[6]; } state_from_coordinates;
    struct { bench8_generalized_result out; } generalized;
    struct { bench8_table table; } prepare;
    struct { bench8_real mount_wrench[48]; } mounts;
    struct { bench8_mount_table mounting; } prepare_mounts;
    struct { bench8_step_carry carry; bench8_state next; } step_carried;
    struct { bench8_step_carry carry; bench8_state next; } step_driven_carried;
    unsigned char bytes[1];
} results;

/* Numbers that no literal of C99 is. */
typedef union special { real_bits word; bench8_real real; } special;
static const special infinite = { 0x7ff0000000000000u };
static const special not_a_number = { 0x7ff8000000000000u };

enum { UNTOUCHED = 0x5a };  /* value of every byte of the results before a call */

/* ---- results: their hash, and their distance from the expected numbers ---- */

typedef struct tally {
    uint32_t hash;                /* FNV-1a of all bits so far, the lowest byte of a number first */
    const bench8_real *expected;  /* next expected numbers, `left` of them */
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

static real_bits bits_of(bench8_real value)
{
    union { bench8_real real; real_bits word; } both;
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

static void take_reals(tally *sum, const bench8_real *values, int count)
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

static void take_matrices_result(tally *sum, const bench8_matrices_result *value)
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
        take_reals(sum, value->I_[i], BENCH8_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->J[i], BENCH8_N);
    }
    take_reals(sum, value->F, 6);
}

static void take_momentum_result(tally *sum, const bench8_momentum_result *value)
{
    take_reals(sum, value->Z, 6);
    take_reals(sum, value->Z0, 6);
    take_reals(sum, &value->energy, 1);
    take_reals(sum, value->center_of_mass, 3);
    take_reals(sum, value->center_of_mass_velocity, 3);
}

static void take_state(tally *sum, const bench8_state *value)
{
    take_reals(sum, value->position, 3);
    take_reals(sum, value->attitude, 4);
    take_reals(sum, value->V, 6);
    take_reals(sum, value->phi, BENCH8_N);
    take_reals(sum, value->phi_dot, BENCH8_N);
}

static void take_encoder(tally *sum, const bench8_encoder *value)
{
    take_ints(sum, &value->counter, 1);
    take_ints(sum, &value->place, 1);
    take_ints(sum, &value->moved, 1);
}

static void take_forward_jacobian_result(tally *sum, const bench8_forward_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], BENCH8_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], BENCH8_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_ddot[i], BENCH8_N);
    }
}

static void take_coupled_jacobian_result(tally *sum, const bench8_coupled_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], BENCH8_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], BENCH8_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_tau[i], BENCH8_N);
    }
    for (int i = 0; i < BENCH8_N; ++i) {
        take_reals(sum, value->phi_ddot_V[i], 6);
    }
    for (int i = 0; i < BENCH8_N; ++i) {
        take_reals(sum, value->phi_ddot_phi[i], BENCH8_N);
    }
    for (int i = 0; i < BENCH8_N; ++i) {
        take_reals(sum, value->phi_ddot_phi_dot[i], BENCH8_N);
    }
    for (int i = 0; i < BENCH8_N; ++i) {
        take_reals(sum, value->phi_ddot_tau[i], BENCH8_N);
    }
}

static void take_inverse_result(tally *sum, const bench8_inverse_result *value)
{
    take_reals(sum, value->phi_ddot, BENCH8_N);
    take_reals(sum, value->residual, 6);
    take_reals(sum, value->sigma, 6);
    take_ints(sum, &value->rank, 1);
    take_reals(sum, &value->damped_by, 1);
    take_ints(sum, value->limited, BENCH8_N);
    take_reals(sum, value->hardest, 6);
}

static void take_generalized_result(tally *sum, const bench8_generalized_result *value)
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

static void take_row(tally *sum, const bench8_row *value)
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

static void take_suspension(tally *sum, const bench8_suspension *value)
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

static void take_table(tally *sum, const bench8_table *value)
{
    take_reals(sum, &value->mass, 1);
    take_reals(sum, &value->mass_inverse, 1);
    take_reals(sum, value->first_moment, 3);
    take_reals(sum, value->inertia, 6);
    for (int i = 0; i < BENCH8_N; ++i) {
        take_row(sum, &value->flywheel[i]);
    }
    take_reals(sum, value->gravity, 3);
    take_suspension(sum, &value->suspension);
}

static void take_mount(tally *sum, const bench8_mount *value)
{
    take_reals(sum, &value->mass, 1);
    take_reals(sum, value->first_moment, 3);
    take_reals(sum, value->inertia, 6);
    take_reals(sum, value->origin, 3);
    take_reals(sum, value->axes, 9);
}

static void take_mount_table(tally *sum, const bench8_mount_table *value)
{
    for (int i = 0; i < BENCH8_N; ++i) {
        take_mount(sum, &value->flywheel[i]);
    }
}

static void take_step_carry(tally *sum, const bench8_step_carry *value)
{
    take_reals(sum, value->rounding, 29);
}

/* ---- every function is called with the inputs, and its results are hashed and compared ---- */

static bench8_status call_forward(void)
{
    return bench8_forward((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.phi_ddot, (omitted == 4) ? NULL : results.forward.V_dot);
}

static void take_forward_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.forward.V_dot, 6);
}

static bench8_status call_matrices(void)
{
    return bench8_matrices((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : &results.matrices.out);
}

static void take_matrices_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_matrices_result(sum, &results.matrices.out);
}

static bench8_status call_momentum(void)
{
    return bench8_momentum((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : &results.momentum.out);
}

static void take_momentum_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_momentum_result(sum, &results.momentum.out);
}

static bench8_status call_torque(void)
{
    return bench8_torque((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL : results.torque.tau);
}

static void take_torque_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.torque.tau, BENCH8_N);
}

static bench8_status call_coupled(void)
{
    return bench8_coupled((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL : results.coupled.V_dot,
        (omitted == 5) ? NULL : results.coupled.phi_ddot);
}

static void take_coupled_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.coupled.V_dot, 6);
    take_reals(sum, results.coupled.phi_ddot, BENCH8_N);
}

static bench8_status call_step(void)
{
    return bench8_step((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.tau, (omitted < 0) ? NULL : in.locked, in.dt, in.order, (omitted == 4) ? NULL
        : &results.step.next);
}

static void take_step_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_state(sum, &results.step.next);
}

static bench8_status call_step_driven(void)
{
    return bench8_step_driven((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.phi_ddot, in.dt, in.order, (omitted == 4) ? NULL : &results.step_driven.next);
}

static void take_step_driven_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_state(sum, &results.step_driven.next);
}

static bench8_status call_wrap(void)
{
    return bench8_wrap(in.phi, (omitted == 1) ? NULL : &results.wrap.wrapped);
}

static void take_wrap_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.wrap.wrapped, 1);
}

static bench8_status call_phase_of_counts(void)
{
    return bench8_phase_of_counts(in.count, in.per_turn, in.zero, (omitted == 1) ? NULL
        : &results.phase_of_counts.phi);
}

static void take_phase_of_counts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.phase_of_counts.phi, 1);
}

static bench8_status call_speed_of_counts(void)
{
    return bench8_speed_of_counts(in.moved, in.per_turn, in.dt, (omitted == 1) ? NULL
        : &results.speed_of_counts.phi_dot);
}

static void take_speed_of_counts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.speed_of_counts.phi_dot, 1);
}

static bench8_status call_accumulate(void)
{
    results.accumulate.encoder = in.encoder;
    return bench8_accumulate((omitted == 1) ? NULL : &results.accumulate.encoder, in.counter, in.bits,
        in.per_turn);
}

static void take_accumulate_results(tally *sum, int refused)
{
    (void)refused;
    take_encoder(sum, &results.accumulate.encoder);
}

static bench8_status call_forward_jacobian(void)
{
    return bench8_forward_jacobian((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
        (omitted == 3) ? NULL : in.phi_ddot, (omitted == 4) ? NULL : &results.forward_jacobian.out);
}

static void take_forward_jacobian_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_forward_jacobian_result(sum, &results.forward_jacobian.out);
}

static bench8_status call_coupled_jacobian(void)
{
    return bench8_coupled_jacobian((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
        (omitted == 3) ? NULL : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL
        : &results.coupled_jacobian.out);
}

static void take_coupled_jacobian_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_coupled_jacobian_result(sum, &results.coupled_jacobian.out);
}

static bench8_status call_inverse(void)
{
    return bench8_inverse((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL : &results.inverse.out);
}

static void take_inverse_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_inverse_result(sum, &results.inverse.out);
}

static bench8_status call_inverse_fast(void)
{
    return bench8_inverse_fast((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.V_dot, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL
        : results.inverse_fast.phi_ddot);
}

static void take_inverse_fast_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.inverse_fast.phi_ddot, BENCH8_N);
}

static bench8_status call_quaternion(void)
{
    return bench8_quaternion((omitted == 1) ? NULL : in.angles, (omitted == 2) ? NULL
        : results.quaternion.attitude);
}

static void take_quaternion_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.quaternion.attitude, 4);
}

static bench8_status call_state_from_coordinates(void)
{
    results.state_from_coordinates.x = in.x;
    return bench8_state_from_coordinates((omitted == 1) ? NULL : in.position, (omitted == 2) ? NULL
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

static bench8_status call_generalized(void)
{
    return bench8_generalized((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.angles, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL
        : &results.generalized.out);
}

static void take_generalized_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_generalized_result(sum, &results.generalized.out);
}

static bench8_status call_prepare(void)
{
    results.prepare.table = bench8_default;
    return bench8_prepare((omitted == 1) ? NULL : &parameters, (omitted == 2) ? NULL
        : &results.prepare.table);
}

static void take_prepare_results(tally *sum, int refused)
{
    (void)refused;
    take_table(sum, &results.prepare.table);
}

static bench8_status call_mounts(void)
{
    return bench8_mounts((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &mounting, (omitted == 3)
        ? NULL : &in.x, (omitted == 4) ? NULL : in.V_dot, (omitted == 5) ? NULL : in.phi_ddot, (omitted == 6)
        ? NULL : results.mounts.mount_wrench);
}

static void take_mounts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.mounts.mount_wrench, 48);
}

static bench8_status call_prepare_mounts(void)
{
    return bench8_prepare_mounts((omitted == 1) ? NULL : &parameters, (omitted == 2) ? NULL
        : &results.prepare_mounts.mounting);
}

static void take_prepare_mounts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_mount_table(sum, &results.prepare_mounts.mounting);
}

static bench8_status call_step_carried(void)
{
    results.step_carried.carry = in.carry;
    return bench8_step_carried((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.tau, (omitted < 0) ? NULL : in.locked, in.dt, in.order, (omitted == 4) ? NULL
        : &results.step_carried.carry, (omitted == 5) ? NULL : &results.step_carried.next);
}

static void take_step_carried_results(tally *sum, int refused)
{
    take_step_carry(sum, &results.step_carried.carry);
    if (refused != 0) { return; }
    take_state(sum, &results.step_carried.next);
}

static bench8_status call_step_driven_carried(void)
{
    results.step_driven_carried.carry = in.carry;
    return bench8_step_driven_carried((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
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
            .phi = { -0x1.95dd5cp+3, 0x1.e462ap+3, -0x1.23a78p+1, -0x1.c68578p+2, -0x1.cf9e4p+3,
                -0x1.e0f5dp+2, -0x1.c61c58p+3, -0x1.3c48p+0 },
            .phi_dot = { -0x1.c4d59p+7, 0x1.d79d24p+7, 0x1.3513p+3, 0x1.29b748p+6, -0x1.94148p+3,
                -0x1.f4583p+7, 0x1.9e47c8p+6, -0x1.39c4f8p+7 },
        },
        .phi_ddot = { 0x1.44d50cp+8, -0x1.7d815p+7, 0x1.e558ecp+8, 0x1.edaa68p+8, 0x1.656c1p+7, 0x1.e86b8p+3,
            0x1.eac5dp+7, 0x1.a2918cp+8 },
        .V_dot = { 0x1.f50954p+3, -0x1.bac6b8p+2, -0x1.8dc0ep+3, -0x1.538698p+2, 0x1.a1b0cp+2, 0x1.35f84p+1 },
        .tau = { -0x1.92c438p+0, -0x1.944cep-2, -0x1.8683b4p+0, -0x1.23054p-4, 0x1.1aa1f8p+0, 0x1.96f608p+0,
            0x1.af406cp+0, 0x1.f9388cp+0 },
        .locked = { 0, 0, 0, 0, 1, 0, 0, 0 },
        .dt = 0x1p-14,
        .order = 4,
        .phi = -0x1.51bd7p+1,
        .count = -573655,
        .per_turn = 4063,
        .zero = -0x1.5944dp-3,
        .moved = 152,
        .encoder = {
            .counter = 5166,
            .place = 1280,
            .moved = 339,
        },
        .counter = -9777,
        .bits = 16,
        .angles = { 0x1.942a08p-2, -0x1.92f53p-2, 0x1.c0d28p-2 },
        .position = { 0x1.9f33ep-1, 0x1.c06e04p+0, 0x1.6815p-4 },
        .q_dot = { -0x1.7e8e7p-2, 0x1.bc58ep+0, -0x1.58a2bp+0, 0x1.554cc8p-1, 0x1.55fcep-1, -0x1.9f3ap-6 },
        .q_ddot = { 0x1.9b4488p+2, 0x1.0a9aap+0, -0x1.9c2068p+2, -0x1.9ed4ep+0, -0x1.085ab8p+2,
            0x1.968a6p+2 },
        .carry = {
            .rounding = { 0x1.cdc694p-25, -0x1.0249c8p-25, -0x1.371e7p-26, -0x1.214c38p-25, 0x1.4171bp-27,
                0x1.82ebap-27, 0x1.0b38ap-26, -0x1.055d68p-25, -0x1.8f2aap-27, -0x1.763e6p-28, -0x1.df9aep-25,
                -0x1.f8caa4p-25, 0x1.3b88ccp-25, 0x1.8fd1ep-27, -0x1.0659ap-26, -0x1.b2c408p-25,
                -0x1.0c99cp-26, -0x1.5e586p-25, 0x1.d5b01p-26, -0x1.6b39ap-25, 0x1.499108p-25, -0x1.859fdp-25,
                0x1.fdeeap-25, 0x1.1fb6fp-25, -0x1.2794p-32, 0x1.33ded8p-25, -0x1.4256p-32, -0x1.923cb8p-25,
                -0x1.67826p-25 },
        },
        .mass_factor = 0x1.0a8932cp+0,
    },
    {   /* fast flywheels, large phases */
        .x = {
            .position = { -0x1.3b3c18p-1, 0x1.8eec5p-1, -0x1.bb3d38p+0 },
            .attitude = { -0x1.aa519d86606a4p-2, 0x1.669bd4af5fc04p-1, -0x1.e98783db14fe5p-2,
                0x1.4fd704223519ap-2 },
            .V = { 0x1.882d1p+0, 0x1.4d94ap+0, -0x1.c47ac4p+2, 0x1.1746e8p+2, 0x1.037d6p+1, 0x1.a1c0ecp+2 },
            .phi = { -0x1.cf6e3p+22, 0x1.56ea88p+22, 0x1.f688fp+21, -0x1.0f622p+22, 0x1.a26cfp+21,
                0x1.df44a8p+22, 0x1.670cp+17, -0x1.23708p+18 },
            .phi_dot = { 0x1.598328p+12, -0x1.466428p+12, -0x1.3db6a8p+13, -0x1.3d4554p+13, -0x1.07562p+12,
                0x1.a063e4p+13, -0x1.bdbb3p+13, 0x1.d98bf4p+13 },
        },
        .phi_ddot = { 0x1.3c586p+6, -0x1.ed3ccp+7, 0x1.297088p+7, 0x1.c53fp+4, -0x1.d0ae24p+8, -0x1.70a96cp+8,
            -0x1.49e8p+4, 0x1.70ed48p+7 },
        .V_dot = { -0x1.52138p+0, 0x1.26f56p+5, -0x1.28b67p+5, -0x1.7a5978p+4, 0x1.8ab58p+3, 0x1.b0decp+1 },
        .tau = { 0x1.7660dcp+0, 0x1.a35e68p-1, -0x1.16ceep-3, 0x1.63ddcp-3, 0x1.e05b2p-3, -0x1.68bbep-1,
            -0x1.cbd33cp+0, -0x1.c483b8p+0 },
        .locked = { 0, 1, 0, 0, 0, 0, 0, 0 },
        .dt = 0x1p-14,
        .order = 2,
        .phi = 0x1.7c0718p+22,
        .count = 250888,
        .per_turn = 4011,
        .zero = -0x1.b7cac8p-2,
        .moved = -273,
        .encoder = {
            .counter = -24139,
            .place = 3120,
            .moved = 431,
        },
        .counter = -32499,
        .bits = 16,
        .angles = { -0x1.997158p-1, 0x1.caa508p-1, 0x1.64ac8p-5 },
        .position = { 0x1.49a318p-1, 0x1.c85dp-3, 0x1.c55c48p-1 },
        .q_dot = { 0x1.ebfa1p+0, -0x1.afa2dp-2, -0x1.3dbc3cp+0, 0x1.e6041p+0, 0x1.efbb3cp+0, -0x1.fcd4p-2 },
        .q_ddot = { -0x1.05219cp+3, -0x1.1937p-2, -0x1.0b842cp+3, 0x1.7eee2p+1, -0x1.093c78p+3,
            -0x1.8ed23cp+3 },
        .carry = {
            .rounding = { -0x1.027accp-25, 0x1.313078p-25, 0x1.f09e08p-26, -0x1.f2802p-25, -0x1.31426p-28,
                0x1.947958p-26, 0x1.5360e8p-26, -0x1.bc3c4p-25, 0x1.4b5d2p-25, -0x1.e1ea1p-26, 0x1.43f77p-27,
                -0x1.7eaadp-25, 0x1.9d9098p-26, 0x1.2190ap-25, 0x1.881898p-25, 0x1.f82364p-25,
                -0x1.f67078p-26, 0x1.ef22p-27, 0x1.9d4d4p-29, -0x1.125cp-25, -0x1.02414p-28, 0x1.bf9368p-25,
                0x1.82c238p-25, 0x1.7c810cp-25, -0x1.0c3e8p-25, -0x1.482048p-25, 0x1.504548p-25,
                -0x1.247d8cp-25, 0x1.c8244p-28 },
        },
        .mass_factor = 0x1.1a2090cp+0,
    },
    {   /* out of range */
        .x = {
            .position = { 0x1.e1a7c8p+39, -0x1.e5e79p+39, -0x1.db3bp+37 },
            .attitude = { -0x1.07ce9aad02c8ap+0, 0x1.38a89d9070db6p+0, 0x1.22187d148861fp+0,
                -0x1.9c949b22e4199p-2 },
            .V = { -0x1.c1742cp+0, -0x1.e7c7ep-3, -0x1.4df71p-1, 0x1.1b7a98p+0, -0x1.67b038p-1,
                0x1.ad1878p+0 },
            .phi = { -0x1.1e24f4p+43, 0x1.81a498p+43, -0x1.7e5fe8p+42, 0x1.60fa6p+43, -0x1.3e177p+41,
                -0x1.9c3facp+43, -0x1.6771dp+42, -0x1.b1380cp+43 },
            .phi_dot = { 0x1.77166p+6, -0x1.92b278p+7, 0x1.74d58p+5, 0x1.ae2418p+6, 0x1.29377p+5,
                -0x1.8574p+4, -0x1.e60618p+7, 0x1.bd62p+7 },
        },
        .phi_ddot = { -0x1.a79a1cp+8, -0x1.88b3dcp+8, 0x1.866584p+8, -0x1.ec054p+4, -0x1.74a658p+8,
            -0x1.8b2564p+8, 0x1.c553b4p+8, 0x1.ce86e8p+8 },
        .V_dot = { -0x1.2c24fp+2, 0x1.c63afp+3, 0x1.9ff9b8p+3, -0x1.12f4p+1, 0x1.69a1c8p+2, -0x1.62c19p+1 },
        .tau = { 0x1.852fp-1, 0x1.8344dp-2, -0x1.7420b4p+0, 0x1.2adb4p+0, -0x1.e9f6ccp+0, 0x1.2b6874p+0,
            0x1.2b38a8p-1, 0x1.f96c5p-1 },
        .locked = { 0, 1, 1, 0, 0, 0, 0, 0 },
        .dt = 0x0p+0,
        .order = 2,
        .phi = 0x1.cc741p+43,
        .count = 432793,
        .per_turn = 0,
        .zero = -0x1.1eb5b4p+39,
        .moved = -8,
        .encoder = {
            .counter = -30972,
            .place = 2759,
            .moved = 302,
        },
        .counter = 15963,
        .bits = 16,
        .angles = { 0x1.bb9c28p+39, 0x1.ea3264p+39, -0x1.1e9248p+38 },
        .position = { 0x1.8d7fc8p+39, 0x1.f0fd5p+38, 0x1.44e058p+40 },
        .q_dot = { 0x1.7e36cp-1, 0x1.b7f784p+0, -0x1.6f8d2p-2, -0x1.a6c8a8p+0, -0x1.0a7258p+0,
            -0x1.57f7bp-1 },
        .q_ddot = { 0x1.fdbeb4p+3, -0x1.7bc24p+2, -0x1.50aadp+2, -0x1.68b21cp+3, -0x1.a4617cp+3,
            0x1.c0056p+2 },
        .carry = {
            .rounding = { -0x1.87f104p-25, -0x1.4e46b8p-26, 0x1.44ed1cp-25, 0x1.9ea8p-32, -0x1.7ccc04p-25,
                -0x1.28cd8p-26, 0x1.c6a0ep-28, 0x1.d821bcp-25, 0x1.45548p-29, 0x1.11f67p-25, 0x1.1e17ap-28,
                -0x1.0d66p-28, -0x1.05ec18p-26, -0x1.c6a14cp-25, 0x1.a57c8p-29, -0x1.7f554p-25,
                0x1.992858p-26, -0x1.24d6bp-26, -0x1.1fe3f8p-25, 0x1.477504p-25, -0x1.c610b8p-26,
                0x1.d1da4p-26, 0x1.b61a38p-26, -0x1.9ffd9cp-25, -0x1.07d55p-27, -0x1.83c6dp-27, 0x1.07ae5p-26,
                -0x1.4604a8p-25, -0x1.e04eep-27 },
        },
        .mass_factor = -0x1.fa83f3p-1,
    },
};

typedef struct answer {
    int status;
    uint32_t hash;  /* hash of the status and all outputs */
    int listed;     /* outputs whose numbers are given, at most 32 */
} answer;

static const bench8_real numbers_forward[] =
{
    0x1.0c813b25a39bep+6, 0x1.43979fe78abc2p+5, -0x1.0c1667ea3f8d8p+7, -0x1.3cc4d0ae85436p+7,
        0x1.4669f62b51ac3p+6, 0x1.636b664fb1687p+7,
    -0x1.0a1884198720cp+15, 0x1.f330bdc6ada68p+15, -0x1.64241a4561852p+16, -0x1.cf081920bb637p+16,
        0x1.3156bca376b12p+18, -0x1.13da6eb785c2bp+17,
};

static const bench8_real numbers_matrices[] =
{
    0x1.263d70a3d70a4p+4, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.608252b6c8bbbp-4, 0x1.04bc709af2b53p-5, 0x0p+0,
        0x1.263d70a3d70a4p+4, 0x0p+0, -0x1.608252b6c8bbbp-4, 0x0p+0, 0x1.9ccde91f6efc7p-5, 0x0p+0, 0x0p+0,
        0x1.263d70a3d70a4p+4, -0x1.04bc709af2b53p-5, -0x1.9ccde91f6efc7p-5, 0x0p+0, 0x0p+0,
        -0x1.608252b6c8bbbp-4, -0x1.04bc709af2b53p-5, 0x1.aa0627e45917bp-2, 0x1.ff53ed70237c4p-9,
        -0x1.61a1c613ab6e5p-10, 0x1.608252b6c8bbbp-4, 0x0p+0, -0x1.9ccde91f6efc7p-5, 0x1.ff53ed70237c4p-9,
        0x1.ebf9a21acd932p-2, 0x1.9bcc479447a03p-9, 0x1.04bc709af2b53p-5, 0x1.9ccde91f6efc7p-5,
    0x1.263d70a3d70a4p+4, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.9f2dddb7eba66p-4, 0x1.ad75c39111187p-6, 0x0p+0,
        0x1.263d70a3d70a4p+4, 0x0p+0, -0x1.9f2dddb7eba66p-4, 0x0p+0, 0x1.2f03aecff0deep-5, 0x0p+0, 0x0p+0,
        0x1.263d70a3d70a4p+4, -0x1.ad75c39111187p-6, -0x1.2f03aecff0deep-5, 0x0p+0, 0x0p+0,
        -0x1.9f2dddb7eba66p-4, -0x1.ad75c39111187p-6, 0x1.a7874db94d61dp-2, 0x1.4003e377840f2p-8,
        -0x1.4fd2cc71ce3fp-15, 0x1.9f2dddb7eba66p-4, 0x0p+0, -0x1.2f03aecff0deep-5, 0x1.4003e377840f2p-8,
        0x1.eb8c370f09eccp-2, 0x1.8b9bfe11f90a8p-9, 0x1.ad75c39111187p-6, 0x1.2f03aecff0deep-5,
};

static const bench8_real numbers_momentum[] =
{
    0x1.f18b7b33dccaap+4, 0x1.1afcbfed397b3p+5, 0x1.cf1e5eaf71db5p+3, 0x1.aefba8ee727cep-3,
        0x1.3f5a154554b4p-2, 0x1.278da543307dbp+0, 0x1.2e8cb355ee534p+3, -0x1.cc0503fe5e9aep+2,
        0x1.7e8d9b5b5fb92p+5, 0x1.1bd76c32d2c4fp+6, 0x1.191fad92dcc3ap+5, -0x1.00febbeb7970dp+3,
        0x1.7d1aeb718deebp+7, 0x1.6727ce070637ap-9, -0x1.c5b35de756fb8p-10, 0x1.32b2418f93c75p-8,
        0x1.073acc31b4c36p-1, -0x1.903c0bd3b4ba8p-2, 0x1.4cd5f73a3343ep+1,
    0x1.62e383313a78dp+7, -0x1.0d41fd01c3e66p+6, -0x1.49556de2bc3d3p+6, -0x1.0d48f8eb116c1p+3,
        -0x1.bf2640558541cp-3, -0x1.ae8d7264bb06ap-1, 0x1.c866ea84ac6ap+3, -0x1.608bf455fc3eap+7,
        0x1.ad5718d1d884ep+6, -0x1.c1ed41407e452p+7, 0x1.89202fdb27de4p+5, 0x1.85dca9d5a4579p+6,
        0x1.01160bd009304p+19, 0x1.07a2511925171p-9, -0x1.75a584fb7fc51p-10, 0x1.6938bfca32816p-8,
        0x1.8d164deb49958p-1, -0x1.32baa2bee88c4p+3, 0x1.758ad688a2c4p+2,
};

static const bench8_real numbers_torque[] =
{
    0x1.62a6e959df85p-2, -0x1.8f011aed08e3cp-3, 0x1.053cbfdd674eep-1, 0x1.47a4b834effb2p-1,
        0x1.e8cd52baa4de5p-3, -0x1.622ce13dbda1bp-4, 0x1.e299e8e5ab86cp-3, 0x1.c61848e127e4cp-2,
    -0x1.8f4fbd9e4d371p-4, 0x1.97646951323fp-4, 0x1.bd73550a97d2dp-2, 0x1.595e5b5d731ep-3,
        -0x1.20560061ad8a9p-1, -0x1.2e612e19a14d8p-2, 0x1.4724938c72fe5p-2, 0x1.5788e41282d1cp-4,
};

static const bench8_real numbers_coupled[] =
{
    0x1.0e89bed37a9b2p+6, 0x1.44013c5403338p+5, -0x1.0c92cd8453ed2p+7, -0x1.3636ca9743bfcp+7,
        0x1.4f3046cbbff83p+6, 0x1.697df006a080bp+7, -0x1.2e5dbfeacf9c7p+9, -0x1.d8d91ba90b7edp+9,
        -0x1.708b8c7b5efe6p+10, 0x1.215df018df594p+6, 0x0p+0, 0x1.dad6009919638p+10, 0x1.5474832e4e58cp+10,
        0x1.c79e7b9631c28p+10,
    -0x1.0b9376762fb31p+15, 0x1.f457e3c5322d4p+15, -0x1.645b018af6146p+16, -0x1.ceb6f8c48718p+16,
        0x1.358ed3dd82659p+18, -0x1.149fa7c55765ap+17, 0x1.39c178abbb63p+17, 0x0p+0, -0x1.94e2c441e7d66p+19,
        0x1.d1d376fbbaaa8p+16, 0x1.61c31ff63766fp+17, -0x1.646c819fa402fp+17, -0x1.467508ab303a3p+18,
        -0x1.8688e6c44e8d6p+13,
};

static const bench8_real numbers_step[] =
{
    -0x1.779a12deac4e9p-1, 0x1.80b85672b5ca5p+0, -0x1.10f68446302e5p-4, 0x1.23d5c0f0acb3fp-1,
        -0x1.2f8708d3a2001p-5, -0x1.fa5efb89bdde7p-2, -0x1.4f6e2fcf4059fp-1, 0x1.99dce4af92db5p+0,
        0x1.e6c925d1cad89p+0, 0x1.ccf5a59e21958p-1, 0x1.f182bd4bb55c8p+0, 0x1.48cdc6309bc0ep-1,
        0x1.b07d45c73a267p-1, -0x1.0bb79f66ea3c3p-3, 0x1.4ae3394b00b0fp+1, -0x1.239445d7dcb0fp+1,
        -0x1.a0daa2bc43be4p-1, -0x1.ec26d86de973ep+0, -0x1.3f40dfe0f46e2p+0, -0x1.9e46a37ced496p+0,
        -0x1.3ebb51080f39cp+0, -0x1.c4e8838e67c08p+7, 0x1.d77f92f4f1d12p+7, 0x1.32321224b5495p+3,
        0x1.29bbdfbe9e43ep+6, -0x1.94148p+3, -0x1.f41cb869466e9p+7, 0x1.9e9d0466b789ap+6,
        -0x1.398c1601680abp+7,
    -0x1.3b88c11a8989fp-1, 0x1.8ece47b529ef7p-1, -0x1.bb37847dfbf45p+0, -0x1.aa2ed5f1f81f2p-2,
        0x1.668702e981aa5p-1, -0x1.e9b8e064a656p-2, 0x1.501415f74ef2dp-2, 0x1.377e4e94d35a6p+0,
        0x1.b0bbfe984de2bp+1, -0x1.6d0968aa080e3p+3, -0x1.bdfde46f2dc68p-1, 0x1.373ae5d891774p+4,
        0x1.23dd02f84d75cp+3, 0x1.40e9d86fd6dabp+1, 0x1.581bb6a3e9358p+0, -0x1.6250938571226p+1,
        0x1.ba89814180acep+0, 0x1.0eaad3cddb54p-2, 0x1.a81c68e31581p+0, -0x1.2748ca49c5c19p+1,
        -0x1.3ec46a887707ap-1, 0x1.59806b76dbf85p+12, -0x1.466428p+12, -0x1.3f25d703b8a7cp+13,
        -0x1.3ce471346a83ap+13, -0x1.077042e9c1f23p+12, 0x1.a0597069f1d85p+13, -0x1.be814d4617948p+13,
        0x1.d951f64818992p+13,
};

static const bench8_real numbers_step_driven[] =
{
    -0x1.779a12de8ec3ep-1, 0x1.80b85676e561p+0, -0x1.10f684635ca13p-4, 0x1.23d5c0d7039c6p-1,
        -0x1.2f8709c062e86p-5, -0x1.fa5efb7d31414p-2, -0x1.4f6e2fe979e27p-1, 0x1.99dad3e459a9bp+0,
        0x1.e6c8e477c5c85p+0, 0x1.ccf79326e7cep-1, 0x1.f175725ce832p+0, 0x1.48bbcbefdeb42p-1,
        0x1.b0651aa15e93ep-1, -0x1.0bb6b6ba089eep-3, 0x1.4ae34517f219fp+1, -0x1.2394273a9c5p+1,
        -0x1.a0da887342f3ep-1, -0x1.ec26d2d83933ep+0, -0x1.3f411ad4d9d9fp+0, -0x1.9e46c66ad233ep+0,
        -0x1.3ebb7cdb73ap+0, -0x1.c4cb6957ap+7, 0x1.d7972dfacp+7, 0x1.3605ac76p+3, 0x1.29d622a68p+6,
        -0x1.93bb24fcp+3, -0x1.f457b5e52p+7, 0x1.9e571e2e8p+6, -0x1.39b7e373ap+7,
    -0x1.3b88b69f9491ap-1, 0x1.8ece3f46b13ap-1, -0x1.bb3780becf073p+0, -0x1.aa2f5b9e75a7bp-2,
        0x1.66872a62e1755p-1, -0x1.e9b882ed97633p-2, 0x1.50134c33debd4p-2, 0x1.3844b3a940ecfp+0,
        0x1.b0c44f710a86p+1, -0x1.6c6d9e21fc32p+3, -0x1.e64a285260cdp-1, 0x1.31a1e2a9b5f63p+4,
        0x1.22486f19236bep+3, 0x1.40e00ba069dcdp+1, 0x1.581baeeef6358p+0, -0x1.621df4da07d56p+1,
        0x1.ba7af388684fp+0, 0x1.0e5228f019462p-2, 0x1.a832a425e41b4p+0, -0x1.2734634bb50e8p+1,
        -0x1.3ec151ef3f3fp-1, 0x1.59833bc586p+12, -0x1.466465a798p+12, -0x1.3db69568f78p+13,
        -0x1.3d45507582p+13, -0x1.0756942b89p+12, 0x1.a063b5ead28p+13, -0x1.bdbb3293dp+13,
        0x1.d98c0b0ed48p+13,
};

static const bench8_real numbers_wrap[] =
{
    -0x1.51bd7p+1,
    0x1.411e41ba460dep+0,
};

static const bench8_real numbers_phase_of_counts[] =
{
    -0x1.318f2c2cffb82p+0,
    -0x1.69d5dbaa08823p+1,
};

static const bench8_real numbers_speed_of_counts[] =
{
    0x1.e1668abf39bffp+11,
    -0x1.b5ea3cb033521p+12,
};

static const bench8_real numbers_accumulate[] =
{
    0.0
};

static const bench8_real numbers_forward_jacobian[] =
{
    -0x1.5c553c2a8dfb1p+0, 0x1.aabc2eb4c2d27p-1, -0x1.45d879e725e19p-1, -0x1.2f7f5a068c0aep-7,
        -0x1.569dea910491ep-1, 0x1.f27195f358327p+0, -0x1.aae9014b3d2d9p-1, -0x1.5c6b1ba7fe529p+0,
        0x1.f3d0181a72151p+0, 0x1.532237d4acd57p-1, -0x1.cf87053cb538cp-7, -0x1.c9074943ae18cp+0,
        0x1.46866618da1e6p-1, -0x1.f40f4fe58deafp+0, -0x1.5c290bee74897p+0, -0x1.f1963c5b8fe1fp+0,
        0x1.c82f267fb7ee3p+0, 0x1.dfbc85b6b99c8p-12, -0x1.102a7c3894ae4p-9, -0x1.2009140b2aa15p-2,
        -0x1.a51d899e3e4cp-4, -0x1.00b1a4fb5dcdbp+0, -0x1.7870baa90041p+0, -0x1.5467cf55de409p-1,
        0x1.f29003d649727p-3, 0x1.afc76d13f4326p-10, -0x1.22ac1c695a433p-3, 0x1.5da6c7b381b4cp+0,
        0x1.623e752c88b85p-2, 0x1.1195dada49f6bp+1, 0x1.e22116e89623bp-5, 0x1.826a4c59969fap-4,
    -0x1.5c70263273a0bp+0, 0x1.a1bf0615bec03p+2, -0x1.036a9aea5b229p+1, 0x1.4b2f0f82a2411p-2,
        0x1.09e32aab5bc36p+1, -0x1.12fefc91f94b3p+3, -0x1.a1c2d1ea413fbp+2, -0x1.5c85a6d67abb8p+0,
        0x1.173f35d8db507p+2, -0x1.964d06c481b84p+0, -0x1.1b7ba3e8c799p-2, -0x1.1de330742fe7dp+4,
        0x1.03902515a4dd7p+1, -0x1.174e9a2724af9p+2, -0x1.5c198eb140171p+0, 0x1.12a4b8f689044p+3,
        0x1.19fb9d8de5c5fp+4, -0x1.324bf6d3decbcp-5, -0x1.babf96ca49862p-9, -0x1.55b5e440bfbep-2,
        -0x1.5c6a50019ffd8p-4, 0x1.931d404430872p+5, -0x1.a990e586e5792p+5, -0x1.9b480c6595595p+4,
        0x1.26129a8f85538p-2, 0x1.81c9e7b23bb9p-9, -0x1.aa2267209e75dp-4, -0x1.f5c81e8afdf03p+5,
        -0x1.c4d380a828cb2p+4, 0x1.46df9d3cf2265p+1, 0x1.8c03c4df12ab9p-5, 0x1.1e4cb0b7a527bp-4,
};

static const bench8_real numbers_coupled_jacobian[] =
{
    -0x1.5d9d580093a48p+0, 0x1.aaf61f22ea34cp-1, -0x1.466c28af14adbp-1, -0x1.6edc018cc84cdp-7,
        -0x1.566d4b4dd8c2cp-1, 0x1.f1fac26e49289p+0, -0x1.aaaf10dd15cb3p-1, -0x1.5d109394d39a4p+0,
        0x1.f3ec70a53d364p+0, 0x1.52f31eedb4ceep-1, -0x1.c645da8476c82p-7, -0x1.c919e90d0541dp+0,
        0x1.45f2b750eb522p-1, -0x1.f3f2f75ac2c9dp+0, -0x1.5d0aaa9d944b2p+0, -0x1.f20c31891ce9fp+0,
        0x1.c814e2b1395abp+0, -0x1.d462e1fe8ad47p-11, -0x1.e6ae080b72872p-10, -0x1.33f1d2cea56f7p-2,
        -0x1.12e8b2ecfbe53p-3, -0x1.0700164348251p+0, -0x1.79fa5ae11a5f5p+0, -0x1.58cc5625da681p-1,
        0x1.2a49d34cff6a7p-2, 0x1.90a210faa4f85p-9, -0x1.faea4693540ebp-4, 0x1.63a27665cbec7p+0,
        0x1.5ee5f68dcde38p-2, 0x1.15405955bf778p+1, 0x1.a87bbec280d44p-5, 0x1.bd80762e98967p-4,
    -0x1.5e05079413cc1p+0, 0x1.a1a30440a4a96p+2, -0x1.039742d0ed0f4p+1, 0x1.7e2154cf16a0ep-2,
        0x1.0db26b7377531p+1, -0x1.14cce551022eep+3, -0x1.a1ded3bf5b56cp+2, -0x1.5d6dfe183dda8p+0,
        0x1.173488dd5a86cp+2, -0x1.90a949b0d793ap+0, -0x1.0c61e9f3a9affp-2, -0x1.1ea62de70f5ffp+4,
        0x1.03637d2f12f0cp+1, -0x1.17594722a5791p+2, -0x1.5c6217b6c166cp+0, 0x1.12c04ae283897p+3,
        0x1.1a369dc92dd4bp+4, -0x1.b67d9678e344dp-5, -0x1.d74714c023efcp-9, -0x1.58cf0f863595dp-2,
        -0x1.414db268e8419p-4, 0x1.94fe3af17760ap+5, -0x1.ab7be94ae6515p+5, -0x1.9c64b8a7302aep+4,
        0x1.3dfeb34eba1b6p-2, 0x1.0e1ddf83cc626p-9, -0x1.ade5c5ae6fc3ep-4, -0x1.fc8b0b523317ep+5,
        -0x1.c9e66739b8045p+4, 0x1.623af7c383787p+1, 0x1.371ca427a99bbp-4, 0x1.61d5056cbcfedp-4,
};

static const bench8_real numbers_inverse[] =
{
    -0x1.1d9284f5e6a3fp+16, 0x1.8e491b9449391p+17, 0x1.45bcf7565b7c8p+16, -0x1.d26821cdc112ep+16,
        -0x1.763be790758a3p+15, -0x1.cf538da850732p+17, 0x1.20fce9d56dcb5p+16, -0x1.21b26dfad944p+18,
        -0x1.4p-41, -0x1p-42, 0x1p-41, -0x1.8p-43, 0x1p-43, 0x1.2p-41, 0x1.fdfd9fcd67ef9p-4,
        0x1.c7a48e8d86227p-4, 0x1.bcf10151d00b1p-4, 0x1.b1823735dc04ap-5, 0x1.a86f67673cf6dp-6,
        0x1.d0ad958e619f2p-7, 0x0p+0, 0x1.6d56759799267p+1, 0x1.fcfb5a1154c88p-1, 0x1.1256644337123p+1,
        -0x1.ee0618ef93aacp-4, 0x1.39a4e52b5f619p-2, -0x1.356215b876f8ap-3,
    0x1.4823612a4bf1dp+28, 0x1.75cb8facfd04ap+28, 0x1.f096751392256p+26, 0x1.674559d93a285p+27,
        0x1.a6ddd91828668p+24, 0x1.6d1bda5ace1efp+27, 0x1.e782f5779837p+26, -0x1.5397f792466bcp+25, 0x1.8p-32,
        0x1.ap-32, 0x1.4cp-32, 0x1.58p-33, 0x1.5p-33, -0x1.2p-33, 0x1.ee91097673247p-4, 0x1.85db8cb47b847p-4,
        0x1.702560aef2255p-4, 0x1.791b869610c2cp-5, 0x1.25b2abae20762p-5, 0x1.9a59401c34dccp-7, 0x0p+0,
        -0x1.1568870c76917p+1, -0x1.800974d38270ep-1, 0x1.9c7873acbc3e6p+1, -0x1.643bb7af41c89p-5,
        -0x1.584f79ce822b4p-5, -0x1.4e4eaee4c8ab9p-2,
};

static const bench8_real numbers_inverse_fast[] =
{
    -0x1.1d9284f5e6a41p+16, 0x1.8e491b944938cp+17, 0x1.45bcf7565b7c8p+16, -0x1.d26821cdc111ap+16,
        -0x1.763be79075879p+15, -0x1.cf538da85072cp+17, 0x1.20fce9d56dcaep+16, -0x1.21b26dfad943ap+18,
    0x1.4823612a4bf2p+28, 0x1.75cb8facfd04bp+28, 0x1.f096751392252p+26, 0x1.674559d93a285p+27,
        0x1.a6ddd91828642p+24, 0x1.6d1bda5ace1eap+27, 0x1.e782f57798376p+26, -0x1.5397f792466b2p+25,
};

static const bench8_real numbers_quaternion[] =
{
    0x1.dc551e125052cp-1, 0x1.f8cb0c6616f6ep-3, -0x1.2996f623fce36p-3, 0x1.d5bacd21650a7p-3,
    0x1.a71d51cc1d6d8p-1, 0x1.7e310db99562cp-3, 0x1.90909f71267d2p-2, -0x1.701b4d834d673p-2,
};

static const bench8_real numbers_state_from_coordinates[] =
{
    0x1.9f33ep-1, 0x1.c06e04p+0, 0x1.6815p-4, 0x1.dc551e125052cp-1, 0x1.f8cb0c6616f6ep-3,
        -0x1.2996f623fce36p-3, 0x1.d5bacd21650a7p-3, -0x1.bf0c4c7f8700cp-3, 0x1.002fc5e1f2355p+0,
        -0x1.fa9145bb68b94p+0, 0x1.d7901d9469966p-3, 0x1.bb7041bfa363ap-1, 0x1.188d9f1cf3efdp-2,
        -0x1.95dd5cp+3, 0x1.e462ap+3, -0x1.23a78p+1, -0x1.c68578p+2, -0x1.cf9e4p+3, -0x1.e0f5dp+2,
        -0x1.c61c58p+3, -0x1.3c48p+0, -0x1.c4d59p+7, 0x1.d79d24p+7, 0x1.3513p+3, 0x1.29b748p+6, -0x1.94148p+3,
        -0x1.f4583p+7, 0x1.9e47c8p+6, -0x1.39c4f8p+7, 0x1.5781bbe688883p+2, -0x1.544e44ce9ab9cp+2,
        -0x1.d732b8262d167p+2,
    0x1.49a318p-1, 0x1.c85dp-3, 0x1.c55c48p-1, 0x1.a71d51cc1d6d8p-1, 0x1.7e310db99562cp-3,
        0x1.90909f71267d2p-2, -0x1.701b4d834d673p-2, 0x1.fead516072f0cp+0, 0x1.1afce8f81e633p+0,
        0x1.d559731d5ffcap-2, -0x1.faa4245e60c48p+0, 0x1.fc7b1761eb5ddp+0, 0x1.19d8f510b1d79p+0,
        -0x1.cf6e3p+22, 0x1.56ea88p+22, 0x1.f688fp+21, -0x1.0f622p+22, 0x1.a26cfp+21, 0x1.df44a8p+22,
        0x1.670cp+17, -0x1.23708p+18, 0x1.598328p+12, -0x1.466428p+12, -0x1.3db6a8p+13, -0x1.3d4554p+13,
        -0x1.07562p+12, 0x1.a063e4p+13, -0x1.bdbb3p+13, 0x1.d98bf4p+13, 0x1.b380e16f35b02p+1,
        -0x1.31c347b0c0c56p+3, -0x1.8b4eb5753cbf2p+1,
    0x1.e1a7c8p+39, -0x1.e5e79p+39, -0x1.db3bp+37, -0x1.07ce9aad02c8ap+0, 0x1.38a89d9070db6p+0,
        0x1.22187d148861fp+0, -0x1.9c949b22e4199p-2, -0x1.c1742cp+0, -0x1.e7c7ep-3, -0x1.4df71p-1,
        0x1.1b7a98p+0, -0x1.67b038p-1, 0x1.ad1878p+0, -0x1.1e24f4p+43, 0x1.81a498p+43, -0x1.7e5fe8p+42,
        0x1.60fa6p+43, -0x1.3e177p+41, -0x1.9c3facp+43, -0x1.6771dp+42, -0x1.b1380cp+43, 0x1.77166p+6,
        -0x1.92b278p+7, 0x1.74d58p+5, 0x1.ae2418p+6, 0x1.29377p+5, -0x1.8574p+4, -0x1.e60618p+7, 0x1.bd62p+7,
};

static const bench8_real numbers_generalized[] =
{
    0x1.b482a63f00b45p-1, 0x1.6ba81a182028ep-2, 0x1.88a35c971f121p-2, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.fe5b6985925bap-2, 0x1.8beb9e23645f4p-1, 0x1.915f59fffd2c2p-2, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.42288e50ffd92p-3, -0x1.0cf103e26dc5p-1, 0x1.ac2b03dfc7b74p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.88a35c971f121p-2, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.915f59fffd2c4p-2,
        0x1.cf9a2e507672bp-1, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.bdf69d23dab62p-2, -0x1.cae622051ac1dp-2, -0x1.8fb854bd95374p-1, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.7af434c752fd5p-1, 0x1.5802f8a982598p-1, 0x1.bda1acf0471a2p-6, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.0654831594f09p-1, -0x1.2dea5c45b7e42p-1, 0x1.3fa5881ce78e4p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, -0x1.8fb854bd95373p-1, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.bda1acf0471a8p-6,
        0x1.ff83c8f80bc65p-1, 0x0p+0, 0x0p+0, 0x0p+0,
};

static const bench8_real numbers_prepare[] =
{
    0x1.3259884033334p+4, 0x1.abd9d27422f73p-5, 0x1.6a55cbbe89f38p-5, -0x1.2650b2f242a9p-5,
        0x1.b3189c62b9224p-4, 0x1.b987674f72c12p-2, 0x1.fbc7dee96e699p-2, 0x1.7ee4061809929p-1,
        0x1.4853ee32b76p-8, -0x1.b952eec4e079p-10, 0x1.8a220a25ab52ap-9, 0x0p+0, 0x1.4784f43958106p-8,
        -0x1.5d5a9e1b089ap-11, 0x0p+0, 0x1.5d5a9e1b089ap-11, 0x1.4784f43958106p-8, 0x1.f711d96e9bbfp-10,
        -0x1.4f613b9f127f6p-14, 0x1.0603f69446738p-9, -0x1.1afa0a4e379b8p-15, 0x1.65bd0c6569106p-22,
        -0x1.5d5a9e1b0899fp-13, 0x1.c62900bcbe61dp-11, 0x1.3a6b27e521576p-11, 0x1.177bb1af3a14dp-12,
        -0x1.65bd0c6569106p-22, -0x1.1afa0a4e379b8p-15, -0x1.107f00713f078p-10, 0x0p+0, 0x1.9929d2fa636p-18,
        -0x1.9929d2fa636p-18,
    0x1.44451c21cccccp+4, 0x1.9434d7f89b049p-5, 0x1.7f87c0d2c89ep-5, -0x1.37880f72678f8p-5,
        0x1.cc8c296f2961dp-4, 0x1.d35b49070a1dap-2, 0x1.0cbdef8bd2cp-1, 0x1.9549ccdef1df7p-1,
        0x1.5b88a1375371cp-8, -0x1.d323bebc958fap-10, 0x1.a1302b1eed4cfp-9, 0x0p+0, 0x1.5aad8bc6a7efap-8,
        -0x1.71ca2eb1c432dp-11, 0x0p+0, 0x1.71ca2eb1c432dp-11, 0x1.5aad8bc6a7efap-8, 0x1.0a3fa6bd6e8bp-9,
        -0x1.62ff88fc9363fp-14, 0x1.1557a30553262p-9, -0x1.2b879b951c5c6p-15, 0x1.7aaa2bb814aeep-22,
        -0x1.71ca2eb1c432bp-13, 0x1.e0ba0980b242p-11, 0x1.4ccf906cca2dbp-11, 0x1.27d4f227d028bp-12,
        -0x1.7aaa2bb814aeep-22, -0x1.2b879b951c5c6p-15, -0x1.206f9f4d37c14p-10, 0x0p+0, 0x1.b119086757a8p-18,
        -0x1.b119086757a8p-18,
    0x1.263d70a3d70a4p+4, 0x1.bd75a10fbaf42p-5, 0x1.5c0329714ec54p-5, -0x1.1aae63aff78fp-5,
        0x1.a1e5ace02b73p-4, 0x1.a8135f281ep-2, 0x1.e7b56814b5d7bp-2, 0x1.6fc160ea6ddcdp-1,
        0x1.3b596e818a00cp-8, -0x1.a7e0f99789864p-10, 0x1.7a8da104bcbe8p-9, 0x0p+0, 0x1.3a92a30553262p-8,
        -0x1.4f8b588e368f1p-11, 0x0p+0, 0x1.4f8b588e368f1p-11, 0x1.3a92a30553262p-8, 0x1.e32f0ee144532p-10,
        -0x1.421f5f40d8377p-14, 0x1.f75104d551d6ap-10, -0x1.0fca785eb66ecp-15, 0x1.5798ee2308c3ap-22,
        -0x1.4f8b588e368fp-13, 0x1.b43526527a206p-11, 0x1.2dfd694ccab3fp-11, 0x1.0c6f7a0b5ed8ep-12,
        -0x1.5798ee2308c3ap-22, -0x1.0fca785eb66ecp-15, -0x1.05b97d64afad1p-10, 0x0p+0, 0x1.88fd505e786cp-18,
        -0x1.88fd505e786cp-18,
};

static const bench8_real numbers_mounts[] =
{
    0x1.f9fe577a7d3fap+3, -0x1.db4294bfdd0dbp+7, 0x1.c7b873d812a26p+5, 0x1.62a6e959df845p-2,
        -0x1.d35203b2d30cep-2, -0x1.8d3f22add1d6fp+0, -0x1.c031243d996e3p+3, 0x1.8e8f80ad86ccp+7,
        -0x1.076734301aeddp+7, -0x1.8f011aed08e33p-3, 0x1.651c503e9c65dp-1, 0x1.f9aefc184e749p-1,
        -0x1.adaedf03ffbdp-1, -0x1.c268bc38faed1p+3, -0x1.5f0f8b6e05877p+2, 0x1.053cbfdd674eep-1,
        0x1.95ff1c0ba9e44p-6, 0x1.4aa8d728e1ea1p-6, 0x1.fae8b4604a6bap+1, 0x1.8b8a1b4531f84p+1,
        0x1.375f3a22f89b1p+4, 0x1.47a4b834effb1p-1, 0x1.4030a4a36dde4p-4, -0x1.8785dc6421a6cp-3,
        -0x1.3f87b95f5b3dap+2, -0x1.42bfa6cd4f3ep-3, -0x1.e36891f2d61c5p+3, 0x1.e8cd52baa4dddp-3,
        0x1.127886f0c2677p-4, 0x1.1a4961c218d34p-8, 0x1.99e8c1ef54e6ap+2, -0x1.47fd5b9a627fap+7,
    0x1.ef1f6e1f4b1edp+7, 0x1.04609a5cf8107p+16, -0x1.02b06106d312p+17, -0x1.8f4fbd9e4d22ap-4,
        0x1.b216243c13284p+9, 0x1.0c821173893a6p+9, -0x1.1902e25d612cap+8, 0x1.550f2dd2f08ddp+13,
        -0x1.d02f1eef0290fp+16, 0x1.976469513222ap-4, 0x1.be675ed1c7051p+8, 0x1.cc8fdab37c79ap+4,
        0x1.e48b0258a4decp+8, 0x1.cdae268b0b771p+17, 0x1.df2150ca24a79p+18, 0x1.bd73550a97e84p-2,
        -0x1.29db4ffe2741fp+10, 0x1.37429a3fcfe8cp+9, -0x1.243f35c4df43fp+8, 0x1.19be4ff8ae0c2p+18,
        -0x1.7a425cddaf9cep+18, 0x1.595e5b5d73995p-3, -0x1.1634039882776p+8, -0x1.50e7a751e2de2p+6,
        -0x1.962cecb01e8b6p+3, -0x1.15c2fa49e315cp+16, -0x1.3ef811ad7263fp+15, -0x1.20560061ad87bp-1,
        -0x1.60f5061b7de8p+5, 0x1.03e463e812ab3p+7, -0x1.d2fd7d4e0d9bp-3, -0x1.007a4e1df43a3p+19,
};

static const bench8_real numbers_prepare_mounts[] =
{
    0x1.aa751ep-1, 0x1.b4b145a1cac08p-12, 0x1.4784f43958106p-8, -0x1.5d5a9e1b089ap-11, 0x1.41df778cdb1a4p-10,
        0x1.aa29efab9849cp-11, 0x1.a3c5485faebc4p-11, -0x1.1afa0a4e379b8p-15, 0x1.65bd0c6569106p-22,
        0x1.9da29655417afp-17, 0x0p+0, 0x1.999999999999ap-3, 0x1.eb851eb851eb8p-5, 0x1p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x1p+0, -0x0p+0, -0x0p+0, 0x0p+0, 0x1p+0, 0x1.9fcbca0cccccdp-1, -0x1.a9c670b0f27bcp-12,
        0x1.2a0ae87bdcf03p-8, 0x0p+0, 0x1.408c8281c022ep-10, 0x1.b4cc85883c7a1p-11, 0x1.9bf0cd28345a2p-11,
        -0x1.37345b7bd1b29p-16, 0x0p+0, 0x1.177bb1af3a14dp-17,
    0x1.c3674ep-1, 0x1.ce3cba5e353f8p-12, 0x1.5aad8bc6a7efap-8, -0x1.71ca2eb1c432dp-11, 0x1.54b380facdbc1p-10,
        0x1.c317b9d66983bp-11, 0x1.bc5355b4cc251p-11, -0x1.2b879b951c5c6p-15, 0x1.7aaa2bb814aeep-22,
        0x1.b5d4c28cd7ea4p-17, 0x0p+0, 0x1.999999999999ap-3, 0x1.eb851eb851eb8p-5, 0x1p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x1p+0, -0x0p+0, -0x0p+0, 0x0p+0, 0x1p+0, 0x1.b81e527333333p-1, -0x1.c2ae68e8a71dep-12,
        0x1.3b7a163c74fb5p-8, 0x0p+0, 0x1.534cb810198eep-10, 0x1.ce59925489c52p-11, 0x1.b4099971dee1fp-11,
        -0x1.4968a2a1d5fe2p-16, 0x0p+0, 0x1.27d4f227d028ap-17,
};

static const bench8_real numbers_step_carried[] =
{
    -0x1.95p-57, 0x1.20b4p-54, 0x1.a8p-59, -0x1.ef5aaep-55, 0x1.191c9cp-59, -0x1.53e37p-58, 0x1.cf30c6p-55,
        -0x1.d8p-54, 0x1.fp-56, -0x1.3p-55, -0x1.5p-54, 0x1.5p-55, -0x1.cp-56, -0x1p-59, 0x1.bp-54,
        0x1.7dp-54, -0x1p-56, 0x0p+0, -0x1.2p-56, -0x1.2p-55, -0x1.98p-54, 0x1.058p-47, 0x1.498p-48, 0x1p-54,
        0x1.3ap-52, 0x0p+0, 0x1.79p-48, -0x1.b8p-50, 0x1.bp-50, -0x1.779a1110e5ba9p-1, 0x1.80b855f190e65p+0,
        -0x1.10f68922a9ee5p-4,
    -0x1.7ap-55, 0x1.ce8p-55, -0x1.85ep-54, -0x1.00fd9p-57, -0x1.83c714p-55, -0x1.1559dp-57, -0x1.8e9198p-56,
        -0x1p-54, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1p-53, 0x0p+0, 0x1p-53, -0x1p-53, 0x0p+0,
        0x1p-53, 0x1p-53, 0x0p+0, 0x1.49p-46, 0x1.cp-44, -0x1.28p-41, 0x1.94p-42, 0x1.0fp-42, 0x1.75cp-42,
        -0x1.ap-43, 0x1.25p-41, -0x1.3b88c21d0455fp-1, 0x1.8ece48e65a677p-1, -0x1.bb378401d4725p+0,
    -0x1.87f104p-25, -0x1.4e46b8p-26, 0x1.44ed1cp-25, 0x1.9ea8p-32, -0x1.7ccc04p-25, -0x1.28cd8p-26,
        0x1.c6a0ep-28, 0x1.d821bcp-25, 0x1.45548p-29, 0x1.11f67p-25, 0x1.1e17ap-28, -0x1.0d66p-28,
        -0x1.05ec18p-26, -0x1.c6a14cp-25, 0x1.a57c8p-29, -0x1.7f554p-25, 0x1.992858p-26, -0x1.24d6bp-26,
        -0x1.1fe3f8p-25, 0x1.477504p-25, -0x1.c610b8p-26, 0x1.d1da4p-26, 0x1.b61a38p-26, -0x1.9ffd9cp-25,
        -0x1.07d55p-27, -0x1.83c6dp-27, 0x1.07ae5p-26, -0x1.4604a8p-25, -0x1.e04eep-27,
};

static const bench8_real numbers_step_driven_carried[] =
{
    -0x1.6698p-55, -0x1.0208p-54, 0x1.9p-58, 0x1.eef30ap-55, -0x1.761f98p-60, -0x1.4d0a5p-56, -0x1.40c92p-59,
        0x1.0cp-54, 0x1.8p-58, 0x1p-54, 0x1p-53, 0x1p-54, -0x1p-54, -0x1p-56, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1p-47, 0x0p+0, 0x0p+0,
        -0x1.779a1110c82fep-1, 0x1.80b855f5c07dp+0, -0x1.10f6893fd6613p-4,
    -0x1.c3p-55, -0x1.88p-59, 0x1.706p-54, 0x1.7d981p-57, 0x1.367178p-55, -0x1.9d03bp-57, 0x1.493f48p-57,
        -0x1p-54, 0x0p+0, -0x1p-50, 0x0p+0, 0x0p+0, -0x1p-50, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1p-53,
        -0x1p-52, 0x0p+0, -0x1.3p-42, 0x1.cp-44, 0x1.0cp-41, 0x1.8p-41, -0x1.2p-43, 0x1.48p-41, -0x1.8cp-41,
        0x1.1p-42, -0x1.3b88b7a20f5dap-1, 0x1.8ece4077e1b2p-1, -0x1.bb378042a7853p+0,
    -0x1.87f104p-25, -0x1.4e46b8p-26, 0x1.44ed1cp-25, 0x1.9ea8p-32, -0x1.7ccc04p-25, -0x1.28cd8p-26,
        0x1.c6a0ep-28, 0x1.d821bcp-25, 0x1.45548p-29, 0x1.11f67p-25, 0x1.1e17ap-28, -0x1.0d66p-28,
        -0x1.05ec18p-26, -0x1.c6a14cp-25, 0x1.a57c8p-29, -0x1.7f554p-25, 0x1.992858p-26, -0x1.24d6bp-26,
        -0x1.1fe3f8p-25, 0x1.477504p-25, -0x1.c610b8p-26, 0x1.d1da4p-26, 0x1.b61a38p-26, -0x1.9ffd9cp-25,
        -0x1.07d55p-27, -0x1.83c6dp-27, 0x1.07ae5p-26, -0x1.4604a8p-25, -0x1.e04eep-27,
};

typedef struct function {
    const char *name;
    int pointers;  /* arguments that must not be null */
    size_t size;  /* bytes of its results */
    size_t kept;  /* bytes of those that are also inputs: the first ones, the only ones that a refused call may have */
    bench8_status (*call)(void);
    void (*take)(tally *sum, int refused);
    const bench8_real *numbers;
    answer answers[CASES];
    uint32_t swept;  /* hash of the first SWEPT states of a sweep */
} function;

static const function functions[FUNCTIONS] =
{
    { "forward", 4, sizeof results.forward, 0u,
      call_forward, take_forward_results, numbers_forward,
      { { 0, 0x21926755u, 6 }, { 0, 0x620e9925u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0xab92a020u },
    { "matrices", 3, sizeof results.matrices, 0u,
      call_matrices, take_matrices_results, numbers_matrices,
      { { 0, 0x682bd07bu, 32 }, { 0, 0x490ca2c3u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xc0e4ec16u },
    { "momentum", 3, sizeof results.momentum, 0u,
      call_momentum, take_momentum_results, numbers_momentum,
      { { 0, 0x73baeb95u, 19 }, { 0, 0x3bfb8ae4u, 19 }, { -2, 0x8e5b0aa0u, 0 } },
      0x160d5554u },
    { "torque", 5, sizeof results.torque, 0u,
      call_torque, take_torque_results, numbers_torque,
      { { 0, 0x808ccee9u, 8 }, { 0, 0x9e210195u, 8 }, { -2, 0x8e5b0aa0u, 0 } },
      0x675eeb8cu },
    { "coupled", 5, sizeof results.coupled, 0u,
      call_coupled, take_coupled_results, numbers_coupled,
      { { 0, 0xa7208c38u, 14 }, { 0, 0x2e1acc1du, 14 }, { -2, 0x8e5b0aa0u, 0 } },
      0x10619afeu },
    { "step", 4, sizeof results.step, 0u,
      call_step, take_step_results, numbers_step,
      { { 0, 0x8c3f6baau, 29 }, { 32, 0x00dc15e3u, 29 }, { -2, 0x8e5b0aa0u, 0 } },
      0x5fbabd60u },
    { "step_driven", 4, sizeof results.step_driven, 0u,
      call_step_driven, take_step_driven_results, numbers_step_driven,
      { { 0, 0x4c620d50u, 29 }, { 32, 0x7423ab98u, 29 }, { -2, 0x8e5b0aa0u, 0 } },
      0x8280bd6fu },
    { "wrap", 1, sizeof results.wrap, 0u,
      call_wrap, take_wrap_results, numbers_wrap,
      { { 0, 0xcb624462u, 1 }, { 0, 0xbfcd6ae0u, 1 }, { -2, 0x8e5b0aa0u, 0 } },
      0xeb7a2312u },
    { "phase_of_counts", 1, sizeof results.phase_of_counts, 0u,
      call_phase_of_counts, take_phase_of_counts_results, numbers_phase_of_counts,
      { { 0, 0xb09c9837u, 1 }, { 0, 0x1e541208u, 1 }, { -5, 0x2107376du, 0 } },
      0xbac31a75u },
    { "speed_of_counts", 1, sizeof results.speed_of_counts, 0u,
      call_speed_of_counts, take_speed_of_counts_results, numbers_speed_of_counts,
      { { 0, 0x3bf2b1bdu, 1 }, { 0, 0x249f2093u, 1 }, { -5, 0x2107376du, 0 } },
      0xfcac3321u },
    { "accumulate", 1, sizeof results.accumulate, sizeof results.accumulate.encoder,
      call_accumulate, take_accumulate_results, numbers_accumulate,
      { { 0, 0x6a812c88u, 0 }, { 0, 0xfe7d46feu, 0 }, { -5, 0x25f64486u, 0 } },
      0xbcdb84d9u },
    { "forward_jacobian", 4, sizeof results.forward_jacobian, 0u,
      call_forward_jacobian, take_forward_jacobian_results, numbers_forward_jacobian,
      { { 0, 0xdfe39b4bu, 32 }, { 0, 0xd0627c42u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xd596c2a2u },
    { "coupled_jacobian", 4, sizeof results.coupled_jacobian, 0u,
      call_coupled_jacobian, take_coupled_jacobian_results, numbers_coupled_jacobian,
      { { 0, 0xe5dc403au, 32 }, { 0, 0x6408889bu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xdf7516cfu },
    { "inverse", 5, sizeof results.inverse, 0u,
      call_inverse, take_inverse_results, numbers_inverse,
      { { 64, 0x2c2a7146u, 27 }, { 64, 0xd05366fau, 27 }, { -2, 0x8e5b0aa0u, 0 } },
      0x76e14cbeu },
    { "inverse_fast", 5, sizeof results.inverse_fast, 0u,
      call_inverse_fast, take_inverse_fast_results, numbers_inverse_fast,
      { { 64, 0x670ee46bu, 8 }, { 64, 0xbc503ac9u, 8 }, { -2, 0x8e5b0aa0u, 0 } },
      0xc203232eu },
    { "quaternion", 2, sizeof results.quaternion, 0u,
      call_quaternion, take_quaternion_results, numbers_quaternion,
      { { 0, 0xd092c698u, 4 }, { 0, 0x2aba8d44u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0xa5a8ac6eu },
    { "state_from_coordinates", 6, sizeof results.state_from_coordinates, sizeof results.state_from_coordinates.x,
      call_state_from_coordinates, take_state_from_coordinates_results, numbers_state_from_coordinates,
      { { 0, 0x3ce9e1b0u, 32 }, { 0, 0xac5c6490u, 32 }, { -2, 0x2c28f268u, 29 } },
      0x3baf36c8u },
    { "generalized", 5, sizeof results.generalized, 0u,
      call_generalized, take_generalized_results, numbers_generalized,
      { { 0, 0x2a2529cau, 32 }, { 0, 0x33c224c6u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x6f48f09du },
    { "prepare", 2, sizeof results.prepare, sizeof results.prepare.table,
      call_prepare, take_prepare_results, numbers_prepare,
      { { 0, 0x2dfa22a2u, 32 }, { 0, 0xdd97e8f6u, 32 }, { -2, 0x4bd88445u, 32 } },
      0x8e80d0d0u },
    { "mounts", 6, sizeof results.mounts, 0u,
      call_mounts, take_mounts_results, numbers_mounts,
      { { 0, 0xfd9cf69du, 32 }, { 0, 0x52594e39u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x9f030d4fu },
    { "prepare_mounts", 2, sizeof results.prepare_mounts, 0u,
      call_prepare_mounts, take_prepare_mounts_results, numbers_prepare_mounts,
      { { 0, 0xf88576f8u, 32 }, { 0, 0x2befc6f6u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x34aaa128u },
    { "step_carried", 5, sizeof results.step_carried, sizeof results.step_carried.carry,
      call_step_carried, take_step_carried_results, numbers_step_carried,
      { { 0, 0xe54b46d9u, 32 }, { 32, 0xbd5634d8u, 32 }, { -2, 0xee42b36bu, 29 } },
      0x3edd1fe8u },
    { "step_driven_carried", 5, sizeof results.step_driven_carried, sizeof results.step_driven_carried.carry,
      call_step_driven_carried, take_step_driven_carried_results, numbers_step_driven_carried,
      { { 0, 0xc5f35fb3u, 32 }, { 32, 0x5418a6dbu, 32 }, { -2, 0xee42b36bu, 29 } },
      0xc67d2bdcu },
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
static bench8_real draw_real(uint32_t *seed, bench8_real largest)
{
    const int32_t part = (int32_t)(draw_word(seed) >> 8) - 8388608;
    return largest * ((bench8_real)part / 8388608.0);
}

static void draw_reals(uint32_t *seed, bench8_real *values, int count, bench8_real largest)
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
static void draw_attitude(uint32_t *seed, bench8_real attitude[4], int refused)
{
    const uint32_t word = draw_word(seed);
    const int32_t a = 2 * (int32_t)(word >> 25) - 127;  /* odd, so that not all are 0 */
    const int32_t b = (int32_t)((word >> 16) & 0xffu) - 128;
    const int32_t c = (int32_t)((word >> 8) & 0xffu) - 128;
    const int32_t d = (int32_t)(word & 0xffu) - 128;
    const bench8_real norm = (bench8_real)(a * a + b * b + c * c + d * d);
    const bench8_real factor = refused != 0 ? 2.0 : 1.0;
    attitude[0] = factor * ((bench8_real)(a * a - b * b - c * c - d * d) / norm);
    attitude[1] = factor * ((bench8_real)(2 * a * b) / norm);
    attitude[2] = factor * ((bench8_real)(2 * a * c) / norm);
    attitude[3] = factor * ((bench8_real)(2 * a * d) / norm);
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
static bench8_real draw_step(const uint32_t *seed)
{
    (void)seed;
    return 0x1p-14;
}

static bench8_real draw_factor(uint32_t *seed, bench8_real largest)
{
    return 1.0 + draw_real(seed, largest);
}

static void draw_powers(uint32_t *seed, bench8_real *values, int count, bench8_real least)
{
    for (int i = 0; i < count; ++i) {
        values[i] = least;
        for (uint32_t k = draw_word(seed) >> 27; k > 0u; --k) {
            values[i] = values[i] * 2.0;
        }
    }
}

static bench8_real draw_share(uint32_t *seed)
{
    const bench8_real share = draw_real(seed, 1.0);
    return share < 0.0 ? -share : share;
}

static void draw_inputs(uint32_t *seed, unsigned long state)
{
    const bench8_real fast = state % 4ul == 3ul ? 32.0 : 1.0;
    const int refused = state % 16ul == 15ul ? 1 : 0;
    draw_reals(seed, in.x.position, 3, 2.0);
    draw_attitude(seed, in.x.attitude, refused);
    draw_reals(seed, in.x.V, 6, 2.0);
    draw_reals(seed, in.x.phi, BENCH8_N, 16.0 * fast);
    draw_reals(seed, in.x.phi_dot, BENCH8_N, 256.0 * fast);
    draw_reals(seed, in.phi_ddot, BENCH8_N, 512.0);
    draw_reals(seed, in.V_dot, 6, 16.0);
    draw_reals(seed, in.tau, BENCH8_N, 2.0);
    draw_flags(seed, in.locked, BENCH8_N);
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
    draw_reals(seed, in.carry.rounding, 29, 5.960464477539063e-8);
    in.mass_factor = draw_factor(seed, 0.125);
}

static void draw_options(uint32_t *seed)
{
    draw_powers(seed, options.weight, BENCH8_N, 0.0009765625);
    draw_powers(seed, options.limit, BENCH8_N, 1.0);
    draw_powers(seed, options.most, BENCH8_N, 1.0);
    draw_powers(seed, options.motor_torque, BENCH8_N, 1.52587890625e-5);
    draw_powers(seed, options.motor_speed, BENCH8_N, 0.00390625);
    draw_powers(seed, options.motor_viscous, BENCH8_N, 9.313225746154785e-10);
    draw_powers(seed, options.motor_coulomb, BENCH8_N, 9.5367431640625e-7);
    draw_powers(seed, options.motor_coulomb_speed, BENCH8_N, 0.00390625);
    options.near_singular = draw_share(seed);
    options.damping = draw_share(seed);
}

/* The parameters of the stand file with all masses and inertias multiplied. */
static void scale_parameters(void)
{
    parameters = bench8_default_parameters;
    parameters.carrier.mass = parameters.carrier.mass * in.mass_factor;
    for (int i = 0; i < 6; ++i) {
        parameters.carrier.inertia[i] = parameters.carrier.inertia[i] * in.mass_factor;
    }
    for (int i = 0; i < BENCH8_N; ++i) {
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
    bench8_status found;
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
    table = &bench8_default;
    options = bench8_default_options;
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
        in.x.phi[7] = infinite.real;
        break;
    case 14:
        in.x.phi[0] = 0x1p+60;
        break;
    case 15:
        in.x.phi[7] = -0x1p+60;
        break;
    case 16:
        in.x.phi_dot[0] = not_a_number.real;
        break;
    case 17:
        in.x.phi_dot[7] = infinite.real;
        break;
    case 18:
        in.x.phi_dot[0] = 0x1p+60;
        break;
    case 19:
        in.x.phi_dot[7] = -0x1p+60;
        break;
    case 20:
        in.phi_ddot[0] = not_a_number.real;
        break;
    case 21:
        in.phi_ddot[7] = infinite.real;
        break;
    case 22:
        in.phi_ddot[0] = 0x1p+60;
        break;
    case 23:
        in.phi_ddot[7] = -0x1p+60;
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
        in.tau[7] = infinite.real;
        break;
    case 30:
        in.tau[0] = 0x1p+60;
        break;
    case 31:
        in.tau[7] = -0x1p+60;
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
        in.carry.rounding[28] = infinite.real;
        break;
    case 77:
        in.carry.rounding[0] = 0x1p+60;
        break;
    case 78:
        in.carry.rounding[28] = -0x1p+60;
        break;
    case 79:
        options.weight[0] = not_a_number.real;
        break;
    case 80:
        options.weight[7] = infinite.real;
        break;
    case 81:
        options.weight[0] = 0x1p+60;
        break;
    case 82:
        options.weight[7] = -0x1p+60;
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
        options.limit[7] = -0x1p+60;
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
        options.most[7] = -0x1p+60;
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
        options.motor_torque[7] = -0x1p+60;
        break;
    case 96:
        options.motor_torque[0] = -0x1p+0;
        break;
    case 97:
        options.motor_speed[0] = not_a_number.real;
        break;
    case 98:
        options.motor_speed[7] = -0x1p+60;
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
        options.motor_viscous[7] = -0x1p+60;
        break;
    case 103:
        options.motor_viscous[0] = -0x1p+0;
        break;
    case 104:
        options.motor_coulomb[0] = not_a_number.real;
        break;
    case 105:
        options.motor_coulomb[7] = -0x1p+60;
        break;
    case 106:
        options.motor_coulomb[0] = -0x1p+0;
        break;
    case 107:
        options.motor_coulomb_speed[0] = not_a_number.real;
        break;
    case 108:
        options.motor_coulomb_speed[7] = -0x1p+60;
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
        for (int s = 0; s < BENCH8_N; ++s) { options.limit[s] = 0x1.b28ba4f845e6p+17; }
        break;
    case 216:
        for (int s = 0; s < BENCH8_N; ++s) { options.limit[s] = 0x1.21b26dfad944p+16; }
        break;
    case 217:
        for (int s = 0; s < BENCH8_N; ++s) { options.limit[s] = 0x1.21b26dfad944p+8; }
        break;
    case 218:
        for (int s = 0; s < BENCH8_N; ++s) { options.weight[s] = 0x1p+2; }
        break;
    case 219:
        for (int s = 0; s < BENCH8_N; ++s) { options.most[s] = 0x1p-10; }
        break;
    case 220:
        for (int s = 0; s < BENCH8_N; ++s) { options.motor_torque[s] = 0x1p-10; }
        break;
    case 221:
        for (int s = 0; s < BENCH8_N; ++s) { options.motor_speed[s] = 0x1p-10; }
        break;
    case 222:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < BENCH8_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
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
        for (int s = 0; s < BENCH8_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
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
        for (int s = 0; s < BENCH8_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.V_dot[0] = 0x1p+0;
        in.V_dot[1] = -0x1p+0;
        in.V_dot[2] = 0x1p+0;
        in.V_dot[3] = -0x1p+0;
        in.V_dot[4] = 0x1p+0;
        in.V_dot[5] = -0x1p+0;
        break;
    case 225:
        for (int s = 0; s < BENCH8_N; ++s) { options.motor_viscous[s] = 0x1p-1; }
        for (int s = 0; s < BENCH8_N; ++s) { options.motor_coulomb[s] = 0x1p-1; }
        for (int s = 0; s < BENCH8_N; ++s) { options.motor_coulomb_speed[s] = 0x1p-1; }
        break;
    case 226:
        for (int s = 0; s < BENCH8_N; ++s) { parameters.flywheel[s].axis[0] = 0x1p+0; }
        for (int s = 0; s < BENCH8_N; ++s) { parameters.flywheel[s].axis[1] = 0x0p+0; }
        for (int s = 0; s < BENCH8_N; ++s) { parameters.flywheel[s].axis[2] = 0x0p+0; }
        for (int s = 0; s < BENCH8_N; ++s) { parameters.flywheel[s].zero[0] = 0x0p+0; }
        for (int s = 0; s < BENCH8_N; ++s) { parameters.flywheel[s].zero[1] = 0x1p+0; }
        for (int s = 0; s < BENCH8_N; ++s) { parameters.flywheel[s].body.center_of_mass[1] = 0x0p+0; }
        for (int s = 0; s < BENCH8_N; ++s) { parameters.flywheel[s].body.center_of_mass[2] = 0x0p+0; }
        for (int s = 0; s < BENCH8_N; ++s) { parameters.flywheel[s].body.inertia[3] = 0x0p+0; }
        for (int s = 0; s < BENCH8_N; ++s) { parameters.flywheel[s].body.inertia[4] = 0x0p+0; }
        break;
    case 227:
        for (int s = 0; s < BENCH8_N; ++s) { options.limit[s] = 0x1.b28ba4f845e57p+17; }
        break;
    case 228:
        for (int s = 0; s < BENCH8_N; ++s) { options.limit[s] = 0x1.21b26dfad943ap+16; }
        break;
    case 229:
        for (int s = 0; s < BENCH8_N; ++s) { options.limit[s] = 0x1.21b26dfad943ap+8; }
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
    { 175, 32, 0, 0x43ccccc4u, { 0x20u } },
    { 176, 32, 0, 0xa8050ff4u, { 0x20u } },
    { 177, -2, 0, 0x00000000u, { 0x20u } },
    { 178, -2, 0, 0x00000000u, { 0x20u } },
    { 175, 32, 0, 0x08b5ba5bu, { 0x40u } },
    { 176, 32, 0, 0xde23c8b5u, { 0x40u } },
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
    { 213, 65, 0, 0xc6810f13u, { 0x2000u } },
    { 214, 75, 0, 0xa123701bu, { 0x2000u } },
    { 215, 76, 0, 0x66d8be52u, { 0x2000u } },
    { 216, 76, 0, 0x8d8a8161u, { 0x2000u } },
    { 217, 12, 0, 0x328969a1u, { 0x2000u } },
    { 218, 64, 0, 0x2c2a7146u, { 0x2000u } },
    { 219, 64, 0, 0x2c2a7146u, { 0x2000u } },
    { 220, 64, 0, 0x2c2a7146u, { 0x2000u } },
    { 221, 64, 0, 0x2c2a7146u, { 0x2000u } },
    { 222, 64, 0, 0x6cad0b1au, { 0x2000u } },
    { 223, 64, 0, 0x13575a0fu, { 0x2000u } },
    { 224, 64, 0, 0x5087864bu, { 0x2000u } },
    { 225, 64, 0, 0x2c2a7146u, { 0x2000u } },
    { 226, 24, 1, 0x575ec6a4u, { 0x2000u } },
    { 213, 64, 0, 0x670ee46bu, { 0x4000u } },
    { 214, 64, 0, 0xd0cb185bu, { 0x4000u } },
    { 227, 64, 0, 0x670ee46bu, { 0x4000u } },
    { 228, 64, 0, 0x670ee46bu, { 0x4000u } },
    { 229, 64, 0, 0x670ee46bu, { 0x4000u } },
    { 218, 64, 0, 0x670ee46bu, { 0x4000u } },
    { 219, 64, 0, 0x670ee46bu, { 0x4000u } },
    { 220, 64, 0, 0x670ee46bu, { 0x4000u } },
    { 221, 64, 0, 0x670ee46bu, { 0x4000u } },
    { 222, 64, 0, 0xfc7c2e1du, { 0x4000u } },
    { 223, 64, 0, 0xa2c7bf2au, { 0x4000u } },
    { 224, 64, 0, 0x6a45c186u, { 0x4000u } },
    { 225, 64, 0, 0x670ee46bu, { 0x4000u } },
    { 226, -3, 1, 0x00000000u, { 0x4000u } },
    { 230, 0, 0, 0x5ca51a90u, { 0x8000u } },
    { 231, 0, 0, 0x4202a394u, { 0x8000u } },
    { 230, 0, 0, 0x9d74d3a8u, { 0x10000u } },
    { 231, -4, 0, 0x00000000u, { 0x10000u } },
    { 230, 0, 0, 0x256bd956u, { 0x20000u } },
    { 231, -4, 0, 0x00000000u, { 0x20000u } },
    { 175, 32, 0, 0x926e1840u, { 0x200000u } },
    { 176, 32, 0, 0x765d7d15u, { 0x200000u } },
    { 177, -2, 0, 0x00000000u, { 0x200000u } },
    { 178, -2, 0, 0x00000000u, { 0x200000u } },
    { 175, 32, 0, 0x95cf58c8u, { 0x400000u } },
    { 176, 32, 0, 0x2cc2bb63u, { 0x400000u } },
    { 177, -2, 0, 0x00000000u, { 0x400000u } },
    { 178, -2, 0, 0x00000000u, { 0x400000u } },
};

/* Makes all trials of one function, and leaves out each pointer in turn; returns how many are wrong. */
static uint32_t run_trials(int number)
{
    static bench8_table prepared;
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
                prepared = bench8_default;  /* prepare keeps what is not of the bodies */
                (void)bench8_prepare(&parameters, &prepared);
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
        if (status != (int)BENCH8_BAD_ARGUMENT || sum.touched != 0) {
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
    volatile bench8_real x = 0.7;
    const bench8_real whole = (x + 6755399441055744.0) - 6755399441055744.0;
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
    const bench8_real *numbers = f->numbers;
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
int bench8_selftest(void (*print)(const char *text), unsigned long sweep)
{
    int failures = 0;
    length = 0u;
    (void)bench8_prepare_mounts(&bench8_default_parameters, &mounting);
    if (EXCESS != 0 || rounds_to_integer() == 0) {
        add_text("wrong results: compiled with ");
        add_text(EXCESS != 0 ? "x87 arithmetic, without -msse2 -mfpmath=sse"
                             : "-ffast-math, -Ofast, -funsafe-math-optimizations or a part of them");
        end_line(print);
    }
    add_text("mahovik selftest bench8 structure 309d41a6 physics 139422e0 real double");
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

#ifdef BENCH8_SELFTEST_MAIN
static void print_text(const char *text)
{
    (void)fputs(text, stdout);
}

int main(void)
{
    return bench8_selftest(print_text, BENCH8_SELFTEST_SWEEP) != 0;
}
#endif
