/* demo3_selftest.c: does demo3.c give the right bits on this machine?
 * With -ffast-math or its parts it gives wrong results with status OK: this test fails.
 * mahovik 0.1.0; structure 055bf547, physics fdeb29e7. Generated: change the stand file instead.
 *
 * Compile it with demo3.c as firmware is compiled (-std=c99 -ffp-contract=off; -fno-tree-vectorize as well by gcc
 * for x86-64 with FMA and for a Cortex-M55, or bits differ) and with
 * -DDEMO3_SELFTEST_MAIN, and run it; on a board, without that macro, call demo3_selftest with a function that
 * prints a text, such as to a serial port.
 * Golden vectors: inputs and answers of the generator's interpreter as hexadecimal constants; each bit must agree.
 * Trials: the first of them with a few inputs changed: every status, wrong numbers, null pointers; known as well.
 * Sweep: states drawn by an integer generator; one hash per function of all its answers is printed, to be
 * compared between machines. The log of a board is judged by `mahovik judge-log STAND.toml --log LOG`. It reads:
 *
 *     wrong results: compiled with ...   only if that is so: first, and then functions FAIL
 *     mahovik selftest demo3 structure 055bf547 physics fdeb29e7 real double
 *     generator mahovik 0.1.0
 *     forward PASS cases 5 worst 0 ulp      one line per function; FAIL gives the number of wrong cases and
 *                                        what is wrong of them, such as "(status, numbers)"; with numbers worst is
 *                                        their largest distance, or "more than 1000000"
 *     sweep 100                          states
 *     forward 0123abcd                   one line per function: FNV-1a hash of its statuses and outputs
 *     failures 0                         functions that failed; the last line
 *
 * No allocation. It keeps inputs and results in static memory: one caller at a time. */
#include "../demo3.h"

#include <float.h>
#include <stddef.h>
#include <stdint.h>
#ifdef DEMO3_SELFTEST_MAIN
#include <stdio.h>
#endif

#if DEMO3_STRUCTURE != 0x055bf547u || DEMO3_PHYSICS != 0xfdeb29e7u
#error "demo3.h and demo3_selftest.c are of different stands"
#endif

#ifndef DEMO3_SELFTEST_SWEEP
#define DEMO3_SELFTEST_SWEEP 100ul  /* states of the sweep that main runs */
#endif

int demo3_selftest(void (*print)(const char *text), unsigned long sweep);

typedef uint64_t real_bits;

enum { CASES = 3, FUNCTIONS = 23, SWEPT = 4 };

#define FARTHEST ((real_bits)1000000u)  /* ulp: a worse distance is not printed as a number */

/* ---- inputs and results ---- */

/* Arguments of the functions, apart from the constants of the stand. */
typedef struct inputs {
    demo3_state x;
    demo3_real phi_ddot[DEMO3_N];
    demo3_real V_dot[6];
    demo3_real tau[DEMO3_N];
    int locked[DEMO3_N];
    demo3_real dt;
    int order;
    demo3_real phi;
    int count;
    int per_turn;
    demo3_real zero;
    int moved;
    demo3_encoder encoder;
    int counter;
    int bits;
    demo3_real angles[3];
    demo3_real position[3];
    demo3_real q_dot[6];
    demo3_real q_ddot[6];
    demo3_step_carry carry;
    demo3_real mass_factor;  /* multiplies all masses and inertias of the parameters */
} inputs;

static inputs in;
static demo3_parameters parameters;
static const demo3_table *table = &demo3_default;
static demo3_inverse_options options;
static int omitted;  /* the argument that is null, from 1; 0: none; -1: all that may be null */
static demo3_mount_table mounting;

static union {
    struct { demo3_real V_dot[6]; } forward;
    struct { demo3_matrices_result out; } matrices;
    struct { demo3_momentum_result out; } momentum;
    struct { demo3_real tau[DEMO3_N]; } torque;
    struct { demo3_real V_dot[6]; demo3_real phi_ddot[DEMO3_N]; } coupled;
    struct { demo3_state next; } step;
    struct { demo3_state next; } step_driven;
    struct { demo3_real wrapped; } wrap;
    struct { demo3_real phi; } phase_of_counts;
    struct { demo3_real phi_dot; } speed_of_counts;
    struct { demo3_encoder encoder; } accumulate;
    struct { demo3_forward_jacobian_result out; } forward_jacobian;
    struct { demo3_coupled_jacobian_result out; } coupled_jacobian;
    struct { demo3_inverse_result out; } inverse;
    struct { demo3_real phi_ddot[DEMO3_N]; } inverse_fast;
    struct { demo3_real attitude[4]; } quaternion;
    struct { demo3_state x; demo3_real V_dot[6]; } state_from_coordinates;
    struct { demo3_generalized_result out; } generalized;
    struct { demo3_table table; } prepare;
    struct { demo3_real mount_wrench[18]; } mounts;
    struct { demo3_mount_table mounting; } prepare_mounts;
    struct { demo3_step_carry carry; demo3_state next; } step_carried;
    struct { demo3_step_carry carry; demo3_state next; } step_driven_carried;
    unsigned char bytes[1];
} results;

/* Numbers that no literal of C99 is. */
typedef union special { real_bits word; demo3_real real; } special;
static const special infinite = { 0x7ff0000000000000u };
static const special not_a_number = { 0x7ff8000000000000u };

enum { UNTOUCHED = 0x5a };  /* value of every byte of the results before a call */

/* ---- results: their hash, and their distance from the expected numbers ---- */

typedef struct tally {
    uint32_t hash;                /* FNV-1a of all bits so far, the lowest byte of a number first */
    const demo3_real *expected;  /* next expected numbers, `left` of them */
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

static real_bits bits_of(demo3_real value)
{
    union { demo3_real real; real_bits word; } both;
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

static void take_reals(tally *sum, const demo3_real *values, int count)
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

static void take_matrices_result(tally *sum, const demo3_matrices_result *value)
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
        take_reals(sum, value->I_[i], DEMO3_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->J[i], DEMO3_N);
    }
    take_reals(sum, value->F, 6);
}

static void take_momentum_result(tally *sum, const demo3_momentum_result *value)
{
    take_reals(sum, value->Z, 6);
    take_reals(sum, value->Z0, 6);
    take_reals(sum, &value->energy, 1);
    take_reals(sum, value->center_of_mass, 3);
    take_reals(sum, value->center_of_mass_velocity, 3);
}

static void take_state(tally *sum, const demo3_state *value)
{
    take_reals(sum, value->position, 3);
    take_reals(sum, value->attitude, 4);
    take_reals(sum, value->V, 6);
    take_reals(sum, value->phi, DEMO3_N);
    take_reals(sum, value->phi_dot, DEMO3_N);
}

static void take_encoder(tally *sum, const demo3_encoder *value)
{
    take_ints(sum, &value->counter, 1);
    take_ints(sum, &value->place, 1);
    take_ints(sum, &value->moved, 1);
}

static void take_forward_jacobian_result(tally *sum, const demo3_forward_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], DEMO3_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], DEMO3_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_ddot[i], DEMO3_N);
    }
}

static void take_coupled_jacobian_result(tally *sum, const demo3_coupled_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], DEMO3_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], DEMO3_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_tau[i], DEMO3_N);
    }
    for (int i = 0; i < DEMO3_N; ++i) {
        take_reals(sum, value->phi_ddot_V[i], 6);
    }
    for (int i = 0; i < DEMO3_N; ++i) {
        take_reals(sum, value->phi_ddot_phi[i], DEMO3_N);
    }
    for (int i = 0; i < DEMO3_N; ++i) {
        take_reals(sum, value->phi_ddot_phi_dot[i], DEMO3_N);
    }
    for (int i = 0; i < DEMO3_N; ++i) {
        take_reals(sum, value->phi_ddot_tau[i], DEMO3_N);
    }
}

static void take_inverse_result(tally *sum, const demo3_inverse_result *value)
{
    take_reals(sum, value->phi_ddot, DEMO3_N);
    take_reals(sum, value->residual, 6);
    take_reals(sum, value->sigma, 3);
    take_ints(sum, &value->rank, 1);
    take_reals(sum, &value->damped_by, 1);
    take_ints(sum, value->limited, DEMO3_N);
    take_reals(sum, value->hardest, 6);
}

static void take_generalized_result(tally *sum, const demo3_generalized_result *value)
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

static void take_row(tally *sum, const demo3_row *value)
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

static void take_table(tally *sum, const demo3_table *value)
{
    take_reals(sum, &value->mass, 1);
    take_reals(sum, &value->mass_inverse, 1);
    take_reals(sum, value->first_moment, 3);
    take_reals(sum, value->inertia, 6);
    for (int i = 0; i < DEMO3_N; ++i) {
        take_row(sum, &value->flywheel[i]);
    }
}

static void take_mount(tally *sum, const demo3_mount *value)
{
    take_reals(sum, &value->mass, 1);
    take_reals(sum, value->first_moment, 3);
    take_reals(sum, value->inertia, 6);
    take_reals(sum, value->origin, 3);
    take_reals(sum, value->axes, 9);
}

static void take_mount_table(tally *sum, const demo3_mount_table *value)
{
    for (int i = 0; i < DEMO3_N; ++i) {
        take_mount(sum, &value->flywheel[i]);
    }
}

static void take_step_carry(tally *sum, const demo3_step_carry *value)
{
    take_reals(sum, value->rounding, 19);
}

/* ---- every function is called with the inputs, and its results are hashed and compared ---- */

static demo3_status call_forward(void)
{
    return demo3_forward((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.phi_ddot, (omitted == 4) ? NULL : results.forward.V_dot);
}

static void take_forward_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.forward.V_dot, 6);
}

static demo3_status call_matrices(void)
{
    return demo3_matrices((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : &results.matrices.out);
}

static void take_matrices_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_matrices_result(sum, &results.matrices.out);
}

static demo3_status call_momentum(void)
{
    return demo3_momentum((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : &results.momentum.out);
}

static void take_momentum_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_momentum_result(sum, &results.momentum.out);
}

static demo3_status call_torque(void)
{
    return demo3_torque((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL : results.torque.tau);
}

static void take_torque_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.torque.tau, DEMO3_N);
}

static demo3_status call_coupled(void)
{
    return demo3_coupled((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL : results.coupled.V_dot,
        (omitted == 5) ? NULL : results.coupled.phi_ddot);
}

static void take_coupled_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.coupled.V_dot, 6);
    take_reals(sum, results.coupled.phi_ddot, DEMO3_N);
}

static demo3_status call_step(void)
{
    return demo3_step((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.tau, (omitted < 0) ? NULL : in.locked, in.dt, in.order, (omitted == 4) ? NULL
        : &results.step.next);
}

static void take_step_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_state(sum, &results.step.next);
}

static demo3_status call_step_driven(void)
{
    return demo3_step_driven((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.phi_ddot, in.dt, in.order, (omitted == 4) ? NULL : &results.step_driven.next);
}

static void take_step_driven_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_state(sum, &results.step_driven.next);
}

static demo3_status call_wrap(void)
{
    return demo3_wrap(in.phi, (omitted == 1) ? NULL : &results.wrap.wrapped);
}

static void take_wrap_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.wrap.wrapped, 1);
}

static demo3_status call_phase_of_counts(void)
{
    return demo3_phase_of_counts(in.count, in.per_turn, in.zero, (omitted == 1) ? NULL
        : &results.phase_of_counts.phi);
}

static void take_phase_of_counts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.phase_of_counts.phi, 1);
}

static demo3_status call_speed_of_counts(void)
{
    return demo3_speed_of_counts(in.moved, in.per_turn, in.dt, (omitted == 1) ? NULL
        : &results.speed_of_counts.phi_dot);
}

static void take_speed_of_counts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.speed_of_counts.phi_dot, 1);
}

static demo3_status call_accumulate(void)
{
    results.accumulate.encoder = in.encoder;
    return demo3_accumulate((omitted == 1) ? NULL : &results.accumulate.encoder, in.counter, in.bits,
        in.per_turn);
}

static void take_accumulate_results(tally *sum, int refused)
{
    (void)refused;
    take_encoder(sum, &results.accumulate.encoder);
}

static demo3_status call_forward_jacobian(void)
{
    return demo3_forward_jacobian((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.phi_ddot, (omitted == 4) ? NULL : &results.forward_jacobian.out);
}

static void take_forward_jacobian_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_forward_jacobian_result(sum, &results.forward_jacobian.out);
}

static demo3_status call_coupled_jacobian(void)
{
    return demo3_coupled_jacobian((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL
        : &results.coupled_jacobian.out);
}

static void take_coupled_jacobian_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_coupled_jacobian_result(sum, &results.coupled_jacobian.out);
}

static demo3_status call_inverse(void)
{
    return demo3_inverse((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL : &results.inverse.out);
}

static void take_inverse_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_inverse_result(sum, &results.inverse.out);
}

static demo3_status call_inverse_fast(void)
{
    return demo3_inverse_fast((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.V_dot, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL
        : results.inverse_fast.phi_ddot);
}

static void take_inverse_fast_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.inverse_fast.phi_ddot, DEMO3_N);
}

static demo3_status call_quaternion(void)
{
    return demo3_quaternion((omitted == 1) ? NULL : in.angles, (omitted == 2) ? NULL
        : results.quaternion.attitude);
}

static void take_quaternion_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.quaternion.attitude, 4);
}

static demo3_status call_state_from_coordinates(void)
{
    results.state_from_coordinates.x = in.x;
    return demo3_state_from_coordinates((omitted == 1) ? NULL : in.position, (omitted == 2) ? NULL
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

static demo3_status call_generalized(void)
{
    return demo3_generalized((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.angles, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL
        : &results.generalized.out);
}

static void take_generalized_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_generalized_result(sum, &results.generalized.out);
}

static demo3_status call_prepare(void)
{
    results.prepare.table = demo3_default;
    return demo3_prepare((omitted == 1) ? NULL : &parameters, (omitted == 2) ? NULL : &results.prepare.table);
}

static void take_prepare_results(tally *sum, int refused)
{
    (void)refused;
    take_table(sum, &results.prepare.table);
}

static demo3_status call_mounts(void)
{
    return demo3_mounts((omitted == 1) ? NULL : &mounting, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.V_dot, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL
        : results.mounts.mount_wrench);
}

static void take_mounts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.mounts.mount_wrench, 18);
}

static demo3_status call_prepare_mounts(void)
{
    return demo3_prepare_mounts((omitted == 1) ? NULL : &parameters, (omitted == 2) ? NULL
        : &results.prepare_mounts.mounting);
}

static void take_prepare_mounts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_mount_table(sum, &results.prepare_mounts.mounting);
}

static demo3_status call_step_carried(void)
{
    results.step_carried.carry = in.carry;
    return demo3_step_carried((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.tau, (omitted < 0) ? NULL : in.locked, in.dt, in.order, (omitted == 4) ? NULL
        : &results.step_carried.carry, (omitted == 5) ? NULL : &results.step_carried.next);
}

static void take_step_carried_results(tally *sum, int refused)
{
    take_step_carry(sum, &results.step_carried.carry);
    if (refused != 0) { return; }
    take_state(sum, &results.step_carried.next);
}

static demo3_status call_step_driven_carried(void)
{
    results.step_driven_carried.carry = in.carry;
    return demo3_step_driven_carried((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
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
            .phi = { -0x1.95dd5cp+3, 0x1.e462ap+3, -0x1.23a78p+1 },
            .phi_dot = { -0x1.c68578p+6, -0x1.cf9e4p+7, -0x1.e0f5dp+6 },
        },
        .phi_ddot = { -0x1.c61c58p+8, -0x1.3c48p+5, -0x1.c4d59p+8 },
        .V_dot = { 0x1.d79d24p+3, 0x1.3513p-1, 0x1.29b748p+2, -0x1.94148p-1, -0x1.f4583p+3, 0x1.9e47c8p+2 },
        .tau = { -0x1.39c4f8p+0, 0x1.44d50cp+0, -0x1.7d815p-1 },
        .locked = { 0, 0, 0 },
        .dt = 0x1p-14,
        .order = 4,
        .phi = 0x1.eac5dp+2,
        .count = -761023,
        .per_turn = 4027,
        .zero = -0x1.bac6b8p-2,
        .moved = -386,
        .encoder = {
            .counter = -21122,
            .place = 142,
            .moved = -289,
        },
        .counter = 29341,
        .bits = 16,
        .angles = { -0x1.8683b4p-1, -0x1.23054p-5, 0x1.1aa1f8p-1 },
        .position = { 0x1.96f608p+0, 0x1.af406cp+0, 0x1.f9388cp+0 },
        .q_dot = { -0x1.4d6b8p-5, 0x1.4e6a6cp+0, 0x1.e7f3ap-2, -0x1.100f98p-1, -0x1.ae09ap+0,
            -0x1.b60768p-1 },
        .q_ddot = { 0x1.06bc6cp+3, -0x1.3b164p-1, 0x1.c0aac8p+3, -0x1.51bd7p+1, -0x1.ace304p+3,
            0x1.76eb1p+1 },
        .carry = {
            .rounding = { -0x1.5944dp-27, 0x1.f3e8ep-27, 0x1.35894p-27, 0x1.d3fc6p-26, -0x1.23b5c4p-25,
                0x1.cf1ac8p-26, 0x1.30188p-28, 0x1.942a08p-26, -0x1.92f53p-26, 0x1.c0d28p-26, 0x1.9f33ep-26,
                0x1.c06e04p-25, 0x1.6815p-29, -0x1.7e8e7p-27, 0x1.bc58ep-25, -0x1.58a2bp-25, 0x1.554cc8p-26,
                0x1.55fcep-26, -0x1.9f3ap-31 },
        },
        .mass_factor = 0x1.0cda244p+0,
    },
    {   /* fast flywheels, large phases */
        .x = {
            .position = { 0x1.0a9aap-3, -0x1.9c2068p-1, -0x1.9ed4ep-3 },
            .attitude = { -0x1.d42b6345cf94cp-1, -0x1.34244dd725da8p-2, -0x1.b3a615c63e584p-4,
                -0x1.fe071fbc61f6fp-3 },
            .V = { 0x1.968a6p+1, 0x1.cdc694p+2, -0x1.0249c8p+2, -0x1.371e7p+1, -0x1.214c38p+2, 0x1.4171bp+0 },
            .phi = { 0x1.82ebap+20, 0x1.0b38ap+21, -0x1.055d68p+22 },
            .phi_dot = { -0x1.8f2aap+11, -0x1.763e6p+10, -0x1.df9aep+13 },
        },
        .phi_ddot = { -0x1.f8caa4p+8, 0x1.3b88ccp+8, 0x1.8fd1ep+6 },
        .V_dot = { -0x1.0659ap+4, -0x1.b2c408p+5, -0x1.0c99cp+4, -0x1.5e586p+5, 0x1.d5b01p+4, -0x1.6b39ap+5 },
        .tau = { 0x1.499108p+0, -0x1.859fdp+0, 0x1.fdeeap+0 },
        .locked = { 0, 0, 0 },
        .dt = 0x1p-14,
        .order = 2,
        .phi = -0x1.923cb8p+22,
        .count = 1009843,
        .per_turn = 4083,
        .zero = -0x1.3b3c18p-2,
        .moved = 131,
        .encoder = {
            .counter = 12901,
            .place = 3195,
            .moved = -113,
        },
        .counter = -13802,
        .bits = 16,
        .angles = { 0x1.1746e8p-1, 0x1.037d6p-2, 0x1.a1c0ecp-1 },
        .position = { -0x1.cf6e3p+0, 0x1.56ea88p+0, 0x1.f688fp-1 },
        .q_dot = { -0x1.0f622p+0, 0x1.a26cfp-1, 0x1.df44a8p+0, 0x1.670cp-5, -0x1.23708p-4, 0x1.598328p-1 },
        .q_ddot = { -0x1.466428p+2, -0x1.3db6a8p+3, -0x1.3d4554p+3, -0x1.07562p+2, 0x1.a063e4p+3,
            -0x1.bdbb3p+3 },
        .carry = {
            .rounding = { 0x1.d98bf4p-25, 0x1.3c586p-27, -0x1.ed3ccp-26, 0x1.297088p-26, 0x1.c53fp-29,
                -0x1.d0ae24p-25, -0x1.70a96cp-25, -0x1.49e8p-29, 0x1.70ed48p-26, -0x1.52138p-30,
                0x1.26f56p-25, -0x1.28b67p-25, -0x1.7a5978p-26, 0x1.8ab58p-27, 0x1.b0decp-29, 0x1.7660dcp-25,
                0x1.a35e68p-26, -0x1.16ceep-28, 0x1.63ddcp-28 },
        },
        .mass_factor = 0x1.03c0b64p+0,
    },
    {   /* out of range */
        .x = {
            .position = { -0x1.68bbep+39, -0x1.cbd33cp+40, -0x1.c483b8p+40 },
            .attitude = { -0x1.ff2ce097be92fp+0, 0x1.9040e0515ec58p-4, -0x1.830ee9cd47f47p-6,
                -0x1.af0aca303ead5p-5 },
            .V = { -0x1.bdd86p+0, 0x1.f8f3ep-2, -0x1.ca174p-3, 0x1.bc5528p-1, 0x1.67f6p-4, 0x1.7f7ed8p-1 },
            .phi = { 0x1.1db6ap+43, -0x1.046708p+43, 0x1.7c0718p+43 },
            .phi_dot = { -0x1.8e30bp+7, 0x1.c57048p+6, -0x1.b7cac8p+6 },
        },
        .phi_ddot = { -0x1.74596p+8, 0x1.a5f084p+8, 0x1.107154p+8 },
        .V_dot = { 0x1.9703bp+1, -0x1.0a47f8p+2, -0x1.3b6cap+1, -0x1.997158p+3, 0x1.caa508p+3, 0x1.64ac8p-1 },
        .tau = { 0x1.49a318p-1, 0x1.c85dp-3, 0x1.c55c48p-1 },
        .locked = { 0, 0, 1 },
        .dt = 0x0p+0,
        .order = 2,
        .phi = 0x1.efbb3cp+43,
        .count = 180278,
        .per_turn = 0,
        .zero = -0x1.1937p+34,
        .moved = -25,
        .encoder = {
            .counter = 25334,
            .place = 2606,
            .moved = -232,
        },
        .counter = -12884,
        .bits = 16,
        .angles = { 0x1.f09e08p+38, -0x1.f2802p+39, -0x1.31426p+36 },
        .position = { 0x1.947958p+39, 0x1.5360e8p+39, -0x1.bc3c4p+40 },
        .q_dot = { 0x1.4b5d2p+0, -0x1.e1ea1p-1, 0x1.43f77p-2, -0x1.7eaadp+0, 0x1.9d9098p-1, 0x1.2190ap+0 },
        .q_ddot = { 0x1.881898p+3, 0x1.f82364p+3, -0x1.f67078p+2, 0x1.ef22p+1, 0x1.9d4d4p-1, -0x1.125cp+3 },
        .carry = {
            .rounding = { -0x1.02414p-28, 0x1.bf9368p-25, 0x1.82c238p-25, 0x1.7c810cp-25, -0x1.0c3e8p-25,
                -0x1.482048p-25, 0x1.504548p-25, -0x1.247d8cp-25, 0x1.c8244p-28, 0x1.a2090cp-25,
                0x1.e1a7c8p-26, -0x1.e5e79p-26, -0x1.db3bp-28, -0x1.378368p-25, -0x1.c1742cp-25,
                -0x1.e7c7ep-28, -0x1.4df71p-26, 0x1.1b7a98p-25, -0x1.67b038p-26 },
        },
        .mass_factor = -0x1.1ad1878p+0,
    },
};

typedef struct answer {
    int status;
    uint32_t hash;  /* hash of the status and all outputs */
    int listed;     /* outputs whose numbers are given, at most 32 */
} answer;

static const demo3_real numbers_forward[] =
{
    0x1.011a74669f8p+0, 0x1.c5a0d5e6e78p-2, -0x1.587a75f668ap+1, 0x1.2694024eab1eep+3, 0x1.18a31934877f2p+1,
        0x1.a088c80af7eacp+3,
    -0x1.25dad9851aap+3, 0x1.7490a8c1adfffp+2, 0x1.971f92d5cfp+1, -0x1.923aba15a4138p+10,
        0x1.cc6f56183dd6bp+9, 0x1.d9d5953c35487p+8,
};

static const demo3_real numbers_matrices[] =
{
    0x1p+4, 0x0p+0, 0x0p+0, 0x0p+0, 0x1p-57, -0x0p+0, 0x0p+0, 0x1p+4, 0x0p+0, -0x1p-57, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1p+4, 0x0p+0, -0x0p+0, 0x0p+0, 0x0p+0, -0x1p-57, 0x0p+0, 0x1.69ebe5a048b99p-3,
        0x1.4e0f42a4383p-14, 0x1.f1f525bcd1602p-8, 0x1p-57, 0x0p+0, -0x0p+0, 0x1.4e0f42a4383p-14,
        0x1.994c94a8d02dap-3, -0x1.01cb54fba1d4dp-6, -0x0p+0, 0x0p+0,
    0x1p+4, 0x0p+0, 0x0p+0, 0x0p+0, 0x1p-57, -0x0p+0, 0x0p+0, 0x1p+4, 0x0p+0, -0x1p-57, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1p+4, 0x0p+0, -0x0p+0, 0x0p+0, 0x0p+0, -0x1p-57, 0x0p+0, 0x1.69ebe5a048b99p-3,
        0x1.4e0f42a4383p-14, 0x1.f1f525bcd1602p-8, 0x1p-57, 0x0p+0, -0x0p+0, 0x1.4e0f42a4383p-14,
        0x1.994c94a8d02dap-3, -0x1.01cb54fba1d4dp-6, -0x0p+0, 0x0p+0,
};

static const demo3_real numbers_momentum[] =
{
    0x1.98cdb4p+4, 0x1.e62748p+4, 0x1.d12948p+3, -0x1.e8fafcd55b1f6p-3, -0x1.ce85db3271571p-1,
        -0x1.e678f83193db7p-3, 0x1.dc305e13cf2f7p+2, -0x1.f2ceacd330cp+1, 0x1.4b7947089d36p+5,
        0x1.ec0ba9972123ep+5, 0x1.dc7ce19007856p+4, -0x1.246147489b09ap+3, 0x1.b0b5ecd22d624p+7, 0x0p+0,
        0x0p+0, 0x1p-61, 0x1.dc305e13cf2f7p-2, -0x1.f2ceacd330cp-3, 0x1.4b7947089d36p+1,
    0x1.968a6p+5, 0x1.cdc694p+6, -0x1.0249c8p+6, -0x1.e84cee95d6bebp+4, -0x1.276181a577391p+4,
        -0x1.cb0cb9673a9d4p+5, -0x1.80f9dd8d558f5p+4, 0x1.1574ee131be05p+7, 0x1.fec730e85048p+3,
        -0x1.75383a7792f0bp+4, 0x1.539917feba172p+1, -0x1.c6328f9a66199p+5, 0x1.e5076d8d9bf3dp+18, 0x0p+0,
        0x0p+0, 0x1p-61, -0x1.80f9dd8d558f5p+0, 0x1.1574ee131be05p+3, 0x1.fec730e85048p-1,
};

static const demo3_real numbers_torque[] =
{
    -0x1.d1d149fbe76c9p+0, -0x1.c3f5ced916867p-3, -0x1.ccb507de0d7eep+0,
    -0x1.18e0189374bc7p+1, 0x1.612acdd2f1af2p+0, 0x1.9cef9009c7053p-3,
};

static const demo3_real numbers_coupled[] =
{
    0x1.011a74669f8p+0, 0x1.c5a0d5e6e78p-2, -0x1.587a75f668ap+1, 0x1.2016be806f54ep+2, -0x1.985c28da0cd5p+2,
        0x1.18913aa874026p+3, -0x1.36eab52a01bd5p+8, 0x1.43997e5b6833dp+8, -0x1.8533084b44c34p+7,
    -0x1.25dad9851aap+3, 0x1.7490a8c1adfffp+2, 0x1.971f92d5cfp+1, -0x1.a0bbb221fb974p+10,
        0x1.dc7ed71a8640cp+9, 0x1.d9f4c6b78f7d2p+8, 0x1.f1319a95fb974p+10, -0x1.4d5eefd5434fcp+10,
        0x1.574187f0dabfap+8,
};

static const demo3_real numbers_step[] =
{
    -0x1.779a179f43d86p-1, 0x1.80b85a98a9966p+0, -0x1.10f6835c7bb16p-4, 0x1.23d5bc33dc8b9p-1,
        -0x1.2f86ce3cc05bfp-5, -0x1.fa5f05b05ddfcp-2, -0x1.4f6e304eb8d92p-1, 0x1.98d1b92e11017p+0,
        0x1.e6290d20c4a7fp+0, 0x1.d113bf2949261p-1, 0x1.f401b37449712p+0, 0x1.45fc661bed65cp-1,
        0x1.ab18bdf5354ffp-1, -0x1.fb3c50d3c7dafp-4, 0x1.473c11bd5a286p+1, -0x1.2497fdf266508p+1,
        -0x1.c698e6a37425cp+6, -0x1.cf942335ae2d6p+7, -0x1.e101f999c1c01p+6,
    0x1.0a6a80c445499p-3, -0x1.9bdb0ac47a5cap-1, -0x1.9eb4f38cfce46p-3, -0x1.d42f04c6c6d37p-1,
        -0x1.341c2dd770ef6p-2, -0x1.b302a9ada06d3p-4, -0x1.fe084da31d0edp-3, 0x1.967874301ab04p+1,
        0x1.cdcc8f162c995p+2, -0x1.024623b53c112p+2, -0x1.441350046be28p+1, -0x1.1d828ec8f7c1cp+2,
        0x1.48c0771ed967dp+0, -0x1.bfbcd82d3b212p-1, 0x1.94cbfa533c06p+0, 0x1.7a79701562bd8p+0,
        -0x1.8f26c1dc2dfdp+11, -0x1.7643a62748284p+10, -0x1.df9ab50c654cbp+13,
};

static const demo3_real numbers_step_driven[] =
{
    -0x1.779a179f43d86p-1, 0x1.80b85a98a9966p+0, -0x1.10f6835c7bb16p-4, 0x1.23d5bc6d70b94p-1,
        -0x1.2f86cb238f19ep-5, -0x1.fa5f0590f88e4p-2, -0x1.4f6e302b478p-1, 0x1.98d1b930514a4p+0,
        0x1.e6290d0cab8cp+0, 0x1.d113bf7568417p-1, 0x1.f414843ed0d1dp+0, 0x1.4640fbcc82ffap-1,
        0x1.ab3abc65947ebp-1, -0x1.fb3c986cc33ddp-4, 0x1.473c0c10d0b9fp+1, -0x1.249801fb564p+1,
        -0x1.c6a1d9c58p+6, -0x1.cf9f7c48p+7, -0x1.e1121d59p+6,
    0x1.0a6a80c445499p-3, -0x1.9bdb0ac47a5cap-1, -0x1.9eb4f38cfce46p-3, -0x1.d42f0456acab7p-1,
        -0x1.341c31a803fdfp-2, -0x1.b302a5f4d934ep-4, -0x1.fe084ba4f20dcp-3, 0x1.9678722611778p+1,
        0x1.cdcc8d42b0995p+2, -0x1.024627c676be2p+2, -0x1.43a050ea3899cp+1, -0x1.1da380b1093fap+2,
        0x1.48c0d97093bb8p+0, -0x1.bfbd74064c06ap-1, 0x1.94cc2ddb6060ap+0, 0x1.7a79687afa3ep+0,
        -0x1.8f2b9c6552p+11, -0x1.763d247734p+10, -0x1.df9ad38171p+13,
};

static const demo3_real numbers_wrap[] =
{
    0x1.62986aeef4b9fp+0,
    0x1.91db880b11b36p+1,
};

static const demo3_real numbers_phase_of_counts[] =
{
    0x1.0103f3c83bb09p-3,
    0x1.086693bacbf22p+1,
};

static const demo3_real numbers_speed_of_counts[] =
{
    -0x1.345bb31ce2f2bp+13,
    0x1.9cdbe62ee27a6p+11,
};

static const demo3_real numbers_accumulate[] =
{
    0.0
};

static const demo3_real numbers_forward_jacobian[] =
{
    0x0p+0, 0x1.aad298p-1, -0x1.462f7p-1, 0x1.6a3fc82f4b376p-62, -0x1.d12948p-1, 0x1.e62748p+0,
        -0x1.aad298p-1, 0x0p+0, 0x1.f3efb4p+0, 0x1.d12948p-1, 0x1.9f2190d1e6d8cp-61, -0x1.98cdb4p+0,
        0x1.462f7p-1, -0x1.f3efb4p+0, 0x0p+0, -0x1.e62748p+0, 0x1.98cdb4p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.61c35cdc39fbfp-54, -0x1.90dca2c9ad6dp-3, 0x1.3a456e68f36c6p+1, -0x1.87b0c6ada399bp+2, 0x0p+0,
        0x0p+0, 0x1.961ad12b2837fp-56, -0x1.8a893017a59bbp+0, -0x1.6fc3f1fc32392p-2, 0x1.d5fdd6a9b548p+1,
        0x0p+0, 0x0p+0,
    0x0p+0, 0x1.4171bp+0, 0x1.214c38p+2, 0x1.1af01d77a9561p-53, 0x1.0249c8p+2, 0x1.cdc694p+2, -0x1.4171bp+0,
        0x0p+0, -0x1.371e7p+1, -0x1.0249c8p+2, 0x1.4a0c97964fad5p-53, -0x1.968a6p+1, -0x1.214c38p+2,
        0x1.371e7p+1, 0x0p+0, -0x1.cdc694p+2, 0x1.968a6p+1, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.b66c453b3ec6ep-54,
        -0x1.ee0d8ac5c1c54p+0, 0x1.4b4e09464fad5p+8, -0x1.8ae0e6388258cp+6, 0x0p+0, 0x0p+0,
        -0x1.6b109a7644611p-53, -0x1.1c318f27a9561p+8, -0x1.451b23d37dacap+3, 0x1.2d2b2cbe7934ep+7, 0x0p+0,
        0x0p+0,
};

static const demo3_real numbers_coupled_jacobian[] =
{
    0x0p+0, 0x1.aad298p-1, -0x1.462f7p-1, 0x1.719f3f0f3118cp-62, -0x1.d12948p-1, 0x1.e62748p+0,
        -0x1.aad298p-1, 0x0p+0, 0x1.f3efb4p+0, 0x1.d12948p-1, 0x1.aaf5f4c9b9896p-61, -0x1.98cdb4p+0,
        0x1.462f7p-1, -0x1.f3efb4p+0, 0x0p+0, -0x1.e62748p+0, 0x1.98cdb4p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.6aa957f1f3e9fp-54, -0x1.70f47ad445d29p-3, 0x1.402fa064dcc4bp+1, -0x1.90fe148fb62a6p+2, 0x0p+0,
        0x0p+0, 0x1.a0c2cd32ccacfp-56, -0x1.8e38eb87988c6p+0, -0x1.80f3a60a503cap-2, 0x1.df5743b0aeacfp+1,
        0x0p+0, 0x0p+0,
    0x0p+0, 0x1.4171bp+0, 0x1.214c38p+2, 0x1.20cd9449c9fe2p-53, 0x1.0249c8p+2, 0x1.cdc694p+2, -0x1.4171bp+0,
        0x0p+0, -0x1.371e7p+1, -0x1.0249c8p+2, 0x1.518fdb24695c7p-53, -0x1.968a6p+1, -0x1.214c38p+2,
        0x1.371e7p+1, 0x0p+0, -0x1.cdc694p+2, 0x1.968a6p+1, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.c2506e57a7807p-54,
        -0x1.fe249241dcd59p+0, 0x1.52d14cd4695c7p+8, -0x1.93c9c8f7b5886p+6, 0x0p+0, 0x0p+0,
        -0x1.7343e5d04406ap-53, -0x1.220f05f9c9fe2p+8, -0x1.512e9669cd555p+3, 0x1.337cb83841529p+7, 0x0p+0,
        0x0p+0,
};

static const demo3_real numbers_inverse[] =
{
    -0x1.b06798bab9a23p+6, 0x1.78b9e088c477ep+9, -0x1.13b9a1adc0cap+6, -0x1.b779d5732c1p+7,
        -0x1.490a543231p+1, -0x1.d5f482fb345p+6, 0x1.9p-52, -0x1.28p-51, -0x1p-52, 0x1.5207a43ec7adcp-3,
        0x1.29cbbcfb6ef98p-3, 0x1.afd8938ef6d5ap-4, 0x0p+0, -0x1.c37d12b96db75p+1, -0x1.5208cb2fe97d7p-5,
        -0x1.e2cd079cb1972p+0, 0x1.5208cb2fe97d7p-66, -0x1.c37d12b96db75p-60, 0x0p+0,
    -0x1.2ae662f556df5p+16, 0x1.25437b0828abbp+15, 0x1.b553146ee542bp+14, 0x1.cdb0ccf5cacp+6,
        0x1.e1561d1835cp+9, 0x1.3f7db25ab9ep+8, 0x1p-48, -0x1.cp-46, 0x1p-46, 0x1.5207a43ec7adcp-3,
        0x1.29cbbcfb6ef98p-3, 0x1.afd8938ef6d5ap-4, 0x0p+0, 0x1.cf1d723166ba8p-2, 0x1.e2d24680ac4c3p+1,
        0x1.407a083e5de5dp+0, -0x1.e2d24680ac4c3p-60, 0x1.cf1d723166ba8p-63, 0x0p+0,
};

static const demo3_real numbers_inverse_fast[] =
{
    -0x1.b06798bab9a1dp+6, 0x1.78b9e088c477bp+9, -0x1.13b9a1adc0ca1p+6,
    -0x1.2ae662f556df4p+16, 0x1.25437b0828abap+15, 0x1.b553146ee542dp+14,
};

static const demo3_real numbers_quaternion[] =
{
    0x1.ca14b66e1cc41p-1, 0x1.f8e97e60df587p-3, -0x1.e05904351ce6dp-4, -0x1.6a08b2b4d6bbp-2,
    0x1.c7e546b548923p-1, 0x1.641d6815783dp-2, 0x1.bde2ba6ca57fap-3, 0x1.93714893f7d25p-3,
};

static const demo3_real numbers_state_from_coordinates[] =
{
    0x1.96f608p+0, 0x1.af406cp+0, 0x1.f9388cp+0, 0x1.ca14b66e1cc41p-1, 0x1.f8e97e60df587p-3,
        -0x1.e05904351ce6dp-4, -0x1.6a08b2b4d6bbp-2, -0x1.d430a495ec6b3p-1, 0x1.0c1a5eb25570cp+0,
        -0x1.7fb78e5ac975p-5, -0x1.bfb11d3892236p-1, -0x1.b574209a4574cp+0, 0x1.b70bdd18d09f6p-2,
        -0x1.95dd5cp+3, 0x1.e462ap+3, -0x1.23a78p+1, -0x1.c68578p+6, -0x1.cf9e4p+7, -0x1.e0f5dp+6,
        0x1.ce559a892235ap+2, 0x1.83a38ed8ee318p+3, 0x1.6f35c6140d266p+3, 0x1.f17b0957b1598p+0,
        -0x1.a4a3cb39e095fp+3, 0x1.ac93fe424a1a8p+1,
    -0x1.cf6e3p+0, 0x1.56ea88p+0, 0x1.f688fp-1, 0x1.c7e546b548923p-1, 0x1.641d6815783dp-2,
        0x1.bde2ba6ca57fap-3, 0x1.93714893f7d25p-3, -0x1.df57cefa9f986p-1, 0x1.0b3483e264ce9p+1,
        0x1.ff016dd0a59f8p-3, 0x1.53e2ebe25c305p-1, -0x1.2471ca46e359cp-6, 0x1.4b5a558173e12p-4,
        0x1.82ebap+20, 0x1.0b38ap+21, -0x1.055d68p+22, -0x1.8f2aap+11, -0x1.763e6p+10, -0x1.df9aep+13,
        -0x1.a314bc1cdb4afp+2, -0x1.8fa6303d8fa4ap+3, -0x1.54c339daa298dp+2, -0x1.9c9ff179a6985p+3,
        0x1.847815c1e03bbp+2, -0x1.8637663fbc91p+3,
    -0x1.68bbep+39, -0x1.cbd33cp+40, -0x1.c483b8p+40, -0x1.ff2ce097be92fp+0, 0x1.9040e0515ec58p-4,
        -0x1.830ee9cd47f47p-6, -0x1.af0aca303ead5p-5, -0x1.bdd86p+0, 0x1.f8f3ep-2, -0x1.ca174p-3,
        0x1.bc5528p-1, 0x1.67f6p-4, 0x1.7f7ed8p-1, 0x1.1db6ap+43, -0x1.046708p+43, 0x1.7c0718p+43,
        -0x1.8e30bp+7, 0x1.c57048p+6, -0x1.b7cac8p+6,
};

static const demo3_real numbers_generalized[] =
{
    0x1.71eba1d84dc4fp-1, -0x1.618398252aaf8p-1, 0x1.22f594a295503p-5, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.264d423e3b134p-1, 0x1.41c35629ee882p-1, 0x1.0c5388aa5e33p-1, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.89645cd04cdfp-2, -0x1.6ed384d19fa8fp-2, 0x1.b3ad44dbc7f82p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.22f594a295502p-5, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.0c5388aa5e33p-1,
        0x1.b3f3af4e2618ep-1, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.a7b941e719397p-1, 0x1.01263b57dbef7p-1, -0x1.00b8aff517d7fp-2, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.98566a27ba879p-3, 0x1.5c6aaefeb242ap-1, 0x1.6902ae03ab0abp-1, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.0caa502d4216p-1, -0x1.112c86a4d1129p-1, 0x1.539dac7a2c2aap-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, -0x1.00b8aff517d8p-2, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.6902ae03ab0aap-1,
        0x1.5ed1df70149e2p-1, 0x0p+0, 0x0p+0, 0x0p+0,
};

static const demo3_real numbers_prepare[] =
{
    0x1.0cda244p+4, 0x1.e7864747335ep-5, 0x0p+0, 0x0p+0, 0x1p-56, 0x1.7c175a84fde43p-3, 0x1.add8f0cc69bdep-3,
        0x1.0f084da7872a7p-2, 0x1.5ed4a21053d8p-14, 0x1.057a7a6362497p-7, -0x1.0ebc889ed67b4p-6, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.03c0b64p+4, 0x1.f89a56019a42ep-5, 0x0p+0, 0x0p+0, 0x1p-56, 0x1.6f3a1be59203cp-3, 0x1.9f4c97390e0f7p-3,
        0x1.05dbfb8b42997p-2, 0x1.52f4e9b07d3p-14, 0x1.f941df8b1b8eep-8, -0x1.0592c70152b3dp-6, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1p+4, 0x1p-4, 0x0p+0, 0x0p+0, 0x1p-57, 0x1.69ebe5a048b99p-3, 0x1.994c94a8d02dap-3, 0x1.02137ac48385ep-2,
        0x1.4e0f42a4383p-14, 0x1.f1f525bcd1602p-8, -0x1.01cb54fba1d4dp-6, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
};

static const demo3_real numbers_mounts[] =
{
    0x1.bc36b69bfb631p+4, 0x1.0f71d16589eccp+1, 0x1.2ff88eecc09f8p+4, -0x1.d1d149fbe76c8p+0,
        -0x1.a986e797a584fp-2, 0x1.372d353ae157ap-2, -0x1.5fdbd8979c7f5p+0, -0x1.9271bcb37c3dcp+4,
        0x1.8481f159f3408p+3, -0x1.c3f5ced916868p-3, -0x1.8a58ed2d5d0a6p-1, -0x1.caf046f7c39acp+0,
        0x1.48404af36a72ep+4, -0x1.02caa5ffd7ff9p+4, -0x1.2cf93ca1b41a2p+4, -0x1.ccb507de0d7eep+0,
        0x1.72cab22236cc6p-1, -0x1.e63b7bc176e88p-3,
    -0x1.4c3239186b1bp+4, -0x1.043cbf35aa35p+7, -0x1.7548c69ac5f15p+5, -0x1.18e0189374bcap+1,
        -0x1.ff09732cedfcap+3, -0x1.cef3a694101e7p+5, -0x1.c78eaf82d8a48p+6, -0x1.0f93ef24dff7cp+1,
        -0x1.849a55c40bf52p+5, 0x1.612acdd2f1af4p+0, -0x1.dabb4b7c95efap+2, 0x1.cea1d8ef38abbp+3,
        -0x1.a0a9f433a7da2p+5, -0x1.4eb3ea4b28749p+6, 0x1.2003b9fe86847p+6, 0x1.9cef9009c6ffap-3,
        -0x1.1f9f78af85fe2p+8, -0x1.283ad8c6fa73ap+7,
};

static const demo3_real numbers_prepare_mounts[] =
{
    0x1.0cda244p+1, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.134df810624ddp-8, 0x1.582176147ae15p-9, 0x1.582176147ae15p-9,
        0x0p+0, 0x0p+0, 0x0p+0, 0x1.eb851eb851eb8p-4, 0x0p+0, -0x1.47ae147ae147bp-6, 0x1p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x1p+0, -0x0p+0, -0x0p+0, 0x0p+0, 0x1p+0, 0x1.0cda244p+1, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.134df810624ddp-8, 0x1.582176147ae15p-9, 0x1.582176147ae15p-9, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.03c0b64p+1, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.09fca20c49ba6p-8, 0x1.4c7bca8f5c28fp-9, 0x1.4c7bca8f5c28fp-9,
        0x0p+0, 0x0p+0, 0x0p+0, 0x1.eb851eb851eb8p-4, 0x0p+0, -0x1.47ae147ae147bp-6, 0x1p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x1p+0, -0x0p+0, -0x0p+0, 0x0p+0, 0x1p+0, 0x1.03c0b64p+1, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.09fca20c49ba6p-8, 0x1.4c7bca8f5c28fp-9, 0x1.4c7bca8f5c28fp-9, 0x0p+0, 0x0p+0, 0x0p+0,
};

static const demo3_real numbers_step_carried[] =
{
    -0x1.a0ep-57, 0x1.e80ep-54, -0x1.44p-58, 0x1.c12bf4ap-56, 0x1.9018955p-60, -0x1.db8e372p-56,
        -0x1.0635dcep-56, 0x1.eaep-54, 0x1.165p-56, 0x1.aep-56, 0x1.f48p-55, -0x1.6bp-55, 0x1.2p-56, 0x1p-59,
        -0x1.88p-54, 0x1.fp-55, 0x1.b88p-49, -0x1.6dap-47, 0x1.f04p-48, -0x1.779a17f5950c6p-1,
        0x1.80b85ad726b26p+0, -0x1.10f680f169316p-4, 0x1.23d5bd1b21e4ep-1, -0x1.2f86e07547da5p-5,
        -0x1.fa5f03dc89fdp-2, -0x1.4f6e302594d9cp-1, 0x1.98d1b9931b837p+0, 0x1.e6290cbc075bfp+0,
        0x1.d113c009b2661p-1, 0x1.f401b3dc16692p+0, 0x1.45fc67dc5b69cp-1, 0x1.ab18be0bb69ffp-1,
    -0x1.f8p-61, 0x1.e8p-55, 0x1p-59, -0x1.d71e342p-57, -0x1.cda8e1c8p-57, -0x1.7864c12p-59,
        -0x1.78ff47c8p-57, -0x1.83cp-53, 0x1.7a8p-53, -0x1.43ep-52, 0x1.4p-53, -0x1.b8p-52, -0x1.8p-56,
        0x0p+0, -0x1p-53, 0x1p-53, -0x1.085p-43, 0x1.629p-44, -0x1.6e5d8p-41, 0x1.0a6a882a75199p-3,
        -0x1.9bdb0a756444ap-1, -0x1.9eb4f76776646p-3, -0x1.d42f04351fb52p-1, -0x1.341c2da0cdc34p-2,
        -0x1.b302b835eb113p-4, -0x1.fe0853691a12dp-3, 0x1.9678742af3104p+1, 0x1.cdcc8f2d3b6ddp+2,
        -0x1.024623b68e24ap+2, -0x1.44134fbaae8a8p+1, -0x1.1d828eee0e8fcp+2, 0x1.48c076c04309dp+0,
    -0x1.02414p-28, 0x1.bf9368p-25, 0x1.82c238p-25, 0x1.7c810cp-25, -0x1.0c3e8p-25, -0x1.482048p-25,
        0x1.504548p-25, -0x1.247d8cp-25, 0x1.c8244p-28, 0x1.a2090cp-25, 0x1.e1a7c8p-26, -0x1.e5e79p-26,
        -0x1.db3bp-28, -0x1.378368p-25, -0x1.c1742cp-25, -0x1.e7c7ep-28, -0x1.4df71p-26, 0x1.1b7a98p-25,
        -0x1.67b038p-26,
};

static const demo3_real numbers_step_driven_carried[] =
{
    -0x1.a1p-57, 0x1.e808p-54, -0x1.4p-58, 0x1.c856e4p-55, -0x1.7f71e0c8p-59, 0x1.9263f1p-56, 0x1.aa798b3p-56,
        -0x1.127p-54, 0x1.a094p-54, -0x1.2c8p-55, -0x1.08p-55, -0x1.a44p-55, -0x1.0fp-55, 0x0p+0, 0x0p+0,
        0x0p+0, 0x1p-47, 0x0p+0, 0x0p+0, -0x1.779a17f5950c6p-1, 0x1.80b85ad726b26p+0, -0x1.10f680f169316p-4,
        0x1.23d5bd54b6129p-1, -0x1.2f86dd5c16984p-5, -0x1.fa5f03bd24ab9p-2, -0x1.4f6e30022380ap-1,
        0x1.98d1b9955bcc4p+0, 0x1.e6290ca7ee4p+0, 0x1.d113c055d1817p-1, 0x1.f41484a69dc9dp+0,
        0x1.4640fd8cf103ap-1, 0x1.ab3abc7c15cebp-1,
    -0x1.f8p-61, 0x1.e8p-55, 0x1p-59, -0x1.a3d98a38p-55, 0x1.e174e0ep-59, -0x1.61bd132p-60, -0x1.9c731488p-57,
        0x1.004p-53, -0x1.fbp-54, 0x1.a22p-52, -0x1.4p-54, -0x1.b8p-52, 0x1.4p-56, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.ap-44, 0x1.2p-44, -0x1.2p-43, 0x1.0a6a882a75199p-3, -0x1.9bdb0a756444ap-1, -0x1.9eb4f76776646p-3,
        -0x1.d42f03c5058ddp-1, -0x1.341c317160d25p-2, -0x1.b302b47d23d99p-4, -0x1.fe08516aef127p-3,
        0x1.96787220e9d78p+1, 0x1.cdcc8d59bf6ddp+2, -0x1.024627c7c8d1ap+2, -0x1.43a050a07b41cp+1,
        -0x1.1da380d6200dap+2, 0x1.48c0d911fd5d8p+0,
    -0x1.02414p-28, 0x1.bf9368p-25, 0x1.82c238p-25, 0x1.7c810cp-25, -0x1.0c3e8p-25, -0x1.482048p-25,
        0x1.504548p-25, -0x1.247d8cp-25, 0x1.c8244p-28, 0x1.a2090cp-25, 0x1.e1a7c8p-26, -0x1.e5e79p-26,
        -0x1.db3bp-28, -0x1.378368p-25, -0x1.c1742cp-25, -0x1.e7c7ep-28, -0x1.4df71p-26, 0x1.1b7a98p-25,
        -0x1.67b038p-26,
};

typedef struct function {
    const char *name;
    int pointers;  /* arguments that must not be null */
    size_t size;  /* bytes of its results */
    size_t kept;  /* bytes of those that are also inputs: the first ones, the only ones that a refused call may have */
    demo3_status (*call)(void);
    void (*take)(tally *sum, int refused);
    const demo3_real *numbers;
    answer answers[CASES];
    uint32_t swept;  /* hash of the first SWEPT states of a sweep */
} function;

static const function functions[FUNCTIONS] =
{
    { "forward", 4, sizeof results.forward, 0u,
      call_forward, take_forward_results, numbers_forward,
      { { 0, 0x52a83f12u, 6 }, { 0, 0x7e50b688u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x87927c06u },
    { "matrices", 3, sizeof results.matrices, 0u,
      call_matrices, take_matrices_results, numbers_matrices,
      { { 0, 0xd70ab7e9u, 32 }, { 0, 0xd2e6d96du, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xc2e7d3e8u },
    { "momentum", 3, sizeof results.momentum, 0u,
      call_momentum, take_momentum_results, numbers_momentum,
      { { 0, 0x3e34c615u, 19 }, { 0, 0xd2b3d478u, 19 }, { -2, 0x8e5b0aa0u, 0 } },
      0x7ce90a3eu },
    { "torque", 5, sizeof results.torque, 0u,
      call_torque, take_torque_results, numbers_torque,
      { { 0, 0x9d74225bu, 3 }, { 0, 0x6bb91420u, 3 }, { -2, 0x8e5b0aa0u, 0 } },
      0x0f6f95f9u },
    { "coupled", 5, sizeof results.coupled, 0u,
      call_coupled, take_coupled_results, numbers_coupled,
      { { 0, 0xb0192a6cu, 9 }, { 0, 0x676239f6u, 9 }, { -2, 0x8e5b0aa0u, 0 } },
      0x4975dcb8u },
    { "step", 4, sizeof results.step, 0u,
      call_step, take_step_results, numbers_step,
      { { 0, 0xfcf1dfd7u, 19 }, { 32, 0xc47d430fu, 19 }, { -2, 0x8e5b0aa0u, 0 } },
      0x8854be7au },
    { "step_driven", 4, sizeof results.step_driven, 0u,
      call_step_driven, take_step_driven_results, numbers_step_driven,
      { { 0, 0xe55a5e71u, 19 }, { 32, 0x55ef7691u, 19 }, { -2, 0x8e5b0aa0u, 0 } },
      0x1ae0b707u },
    { "wrap", 1, sizeof results.wrap, 0u,
      call_wrap, take_wrap_results, numbers_wrap,
      { { 0, 0x321dae64u, 1 }, { 0, 0xee645f59u, 1 }, { -2, 0x8e5b0aa0u, 0 } },
      0xf2311a7du },
    { "phase_of_counts", 1, sizeof results.phase_of_counts, 0u,
      call_phase_of_counts, take_phase_of_counts_results, numbers_phase_of_counts,
      { { 0, 0x9e9ca820u, 1 }, { 0, 0x4c2b89d4u, 1 }, { -5, 0x2107376du, 0 } },
      0x1e9cfbdau },
    { "speed_of_counts", 1, sizeof results.speed_of_counts, 0u,
      call_speed_of_counts, take_speed_of_counts_results, numbers_speed_of_counts,
      { { 0, 0x34e0a70du, 1 }, { 0, 0x72d5ca5au, 1 }, { -5, 0x2107376du, 0 } },
      0x0d117773u },
    { "accumulate", 1, sizeof results.accumulate, sizeof results.accumulate.encoder,
      call_accumulate, take_accumulate_results, numbers_accumulate,
      { { 0, 0xee840239u, 0 }, { 0, 0x1c60153au, 0 }, { -5, 0xc3a395f6u, 0 } },
      0x5343da04u },
    { "forward_jacobian", 4, sizeof results.forward_jacobian, 0u,
      call_forward_jacobian, take_forward_jacobian_results, numbers_forward_jacobian,
      { { 0, 0xc9caa4d3u, 32 }, { 0, 0xbb19891bu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xbd66c272u },
    { "coupled_jacobian", 4, sizeof results.coupled_jacobian, 0u,
      call_coupled_jacobian, take_coupled_jacobian_results, numbers_coupled_jacobian,
      { { 0, 0x079f0038u, 32 }, { 0, 0x02a58233u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xf0a2dedfu },
    { "inverse", 5, sizeof results.inverse, 0u,
      call_inverse, take_inverse_results, numbers_inverse,
      { { 8, 0xfaa99a2eu, 19 }, { 72, 0xcc38d0efu, 19 }, { -2, 0x8e5b0aa0u, 0 } },
      0xeee86b7fu },
    { "inverse_fast", 5, sizeof results.inverse_fast, 0u,
      call_inverse_fast, take_inverse_fast_results, numbers_inverse_fast,
      { { 0, 0x3e8ce9e3u, 3 }, { 64, 0x1690008fu, 3 }, { -2, 0x8e5b0aa0u, 0 } },
      0x7567ff7fu },
    { "quaternion", 2, sizeof results.quaternion, 0u,
      call_quaternion, take_quaternion_results, numbers_quaternion,
      { { 0, 0x256d3568u, 4 }, { 0, 0xbc7f543fu, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0xa08ea6f2u },
    { "state_from_coordinates", 6, sizeof results.state_from_coordinates, sizeof results.state_from_coordinates.x,
      call_state_from_coordinates, take_state_from_coordinates_results, numbers_state_from_coordinates,
      { { 0, 0x73abebd2u, 25 }, { 0, 0x153ef209u, 25 }, { -2, 0xfb1fa4aeu, 19 } },
      0x3bf0f778u },
    { "generalized", 5, sizeof results.generalized, 0u,
      call_generalized, take_generalized_results, numbers_generalized,
      { { 0, 0x9350c7c0u, 32 }, { 0, 0xa9060b97u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x815e432du },
    { "prepare", 2, sizeof results.prepare, sizeof results.prepare.table,
      call_prepare, take_prepare_results, numbers_prepare,
      { { 0, 0x3ed32297u, 32 }, { 0, 0x507507b7u, 32 }, { -2, 0x1a04e23au, 32 } },
      0xa577eed4u },
    { "mounts", 5, sizeof results.mounts, 0u,
      call_mounts, take_mounts_results, numbers_mounts,
      { { 0, 0x1933a6d7u, 18 }, { 0, 0x645fabf4u, 18 }, { -2, 0x8e5b0aa0u, 0 } },
      0xe6fe51efu },
    { "prepare_mounts", 2, sizeof results.prepare_mounts, 0u,
      call_prepare_mounts, take_prepare_mounts_results, numbers_prepare_mounts,
      { { 0, 0x71dcad8cu, 32 }, { 0, 0x9133c168u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x8ece1b66u },
    { "step_carried", 5, sizeof results.step_carried, sizeof results.step_carried.carry,
      call_step_carried, take_step_carried_results, numbers_step_carried,
      { { 0, 0x29580c6fu, 32 }, { 32, 0x1e9a2ffeu, 32 }, { -2, 0x2993729bu, 19 } },
      0x6cd5c4cfu },
    { "step_driven_carried", 5, sizeof results.step_driven_carried, sizeof results.step_driven_carried.carry,
      call_step_driven_carried, take_step_driven_carried_results, numbers_step_driven_carried,
      { { 0, 0x73dd37e4u, 32 }, { 32, 0x5923ab52u, 32 }, { -2, 0x2993729bu, 19 } },
      0x5ed02766u },
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
static demo3_real draw_real(uint32_t *seed, demo3_real largest)
{
    const int32_t part = (int32_t)(draw_word(seed) >> 8) - 8388608;
    return largest * ((demo3_real)part / 8388608.0);
}

static void draw_reals(uint32_t *seed, demo3_real *values, int count, demo3_real largest)
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
static void draw_attitude(uint32_t *seed, demo3_real attitude[4], int refused)
{
    const uint32_t word = draw_word(seed);
    const int32_t a = 2 * (int32_t)(word >> 25) - 127;  /* odd, so that not all are 0 */
    const int32_t b = (int32_t)((word >> 16) & 0xffu) - 128;
    const int32_t c = (int32_t)((word >> 8) & 0xffu) - 128;
    const int32_t d = (int32_t)(word & 0xffu) - 128;
    const demo3_real norm = (demo3_real)(a * a + b * b + c * c + d * d);
    const demo3_real factor = refused != 0 ? 2.0 : 1.0;
    attitude[0] = factor * ((demo3_real)(a * a - b * b - c * c - d * d) / norm);
    attitude[1] = factor * ((demo3_real)(2 * a * b) / norm);
    attitude[2] = factor * ((demo3_real)(2 * a * c) / norm);
    attitude[3] = factor * ((demo3_real)(2 * a * d) / norm);
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
static demo3_real draw_step(const uint32_t *seed)
{
    (void)seed;
    return 0x1p-14;
}

static demo3_real draw_factor(uint32_t *seed, demo3_real largest)
{
    return 1.0 + draw_real(seed, largest);
}

static void draw_powers(uint32_t *seed, demo3_real *values, int count, demo3_real least)
{
    for (int i = 0; i < count; ++i) {
        values[i] = least;
        for (uint32_t k = draw_word(seed) >> 27; k > 0u; --k) {
            values[i] = values[i] * 2.0;
        }
    }
}

static demo3_real draw_share(uint32_t *seed)
{
    const demo3_real share = draw_real(seed, 1.0);
    return share < 0.0 ? -share : share;
}

static void draw_inputs(uint32_t *seed, unsigned long state)
{
    const demo3_real fast = state % 4ul == 3ul ? 32.0 : 1.0;
    const int refused = state % 16ul == 15ul ? 1 : 0;
    draw_reals(seed, in.x.position, 3, 2.0);
    draw_attitude(seed, in.x.attitude, refused);
    draw_reals(seed, in.x.V, 6, 2.0);
    draw_reals(seed, in.x.phi, DEMO3_N, 16.0 * fast);
    draw_reals(seed, in.x.phi_dot, DEMO3_N, 256.0 * fast);
    draw_reals(seed, in.phi_ddot, DEMO3_N, 512.0);
    draw_reals(seed, in.V_dot, 6, 16.0);
    draw_reals(seed, in.tau, DEMO3_N, 2.0);
    draw_flags(seed, in.locked, DEMO3_N);
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
    draw_reals(seed, in.carry.rounding, 19, 5.960464477539063e-8);
    in.mass_factor = draw_factor(seed, 0.125);
}

static void draw_options(uint32_t *seed)
{
    draw_powers(seed, options.weight, DEMO3_N, 0.0009765625);
    draw_powers(seed, options.limit, DEMO3_N, 1.0);
    draw_powers(seed, options.most, DEMO3_N, 1.0);
    draw_powers(seed, options.motor_torque, DEMO3_N, 1.52587890625e-5);
    draw_powers(seed, options.motor_speed, DEMO3_N, 0.00390625);
    draw_powers(seed, options.motor_viscous, DEMO3_N, 9.313225746154785e-10);
    draw_powers(seed, options.motor_coulomb, DEMO3_N, 9.5367431640625e-7);
    draw_powers(seed, options.motor_coulomb_speed, DEMO3_N, 0.00390625);
    options.near_singular = draw_share(seed);
    options.damping = draw_share(seed);
}

/* The parameters of the stand file with all masses and inertias multiplied. */
static void scale_parameters(void)
{
    parameters = demo3_default_parameters;
    parameters.carrier.mass = parameters.carrier.mass * in.mass_factor;
    for (int i = 0; i < 6; ++i) {
        parameters.carrier.inertia[i] = parameters.carrier.inertia[i] * in.mass_factor;
    }
    for (int i = 0; i < DEMO3_N; ++i) {
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
    demo3_status found;
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
    table = &demo3_default;
    options = demo3_default_options;
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
        in.x.phi[2] = infinite.real;
        break;
    case 14:
        in.x.phi[0] = 0x1p+60;
        break;
    case 15:
        in.x.phi[2] = -0x1p+60;
        break;
    case 16:
        in.x.phi_dot[0] = not_a_number.real;
        break;
    case 17:
        in.x.phi_dot[2] = infinite.real;
        break;
    case 18:
        in.x.phi_dot[0] = 0x1p+60;
        break;
    case 19:
        in.x.phi_dot[2] = -0x1p+60;
        break;
    case 20:
        in.phi_ddot[0] = not_a_number.real;
        break;
    case 21:
        in.phi_ddot[2] = infinite.real;
        break;
    case 22:
        in.phi_ddot[0] = 0x1p+60;
        break;
    case 23:
        in.phi_ddot[2] = -0x1p+60;
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
        in.tau[2] = infinite.real;
        break;
    case 30:
        in.tau[0] = 0x1p+60;
        break;
    case 31:
        in.tau[2] = -0x1p+60;
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
        in.carry.rounding[18] = infinite.real;
        break;
    case 77:
        in.carry.rounding[0] = 0x1p+60;
        break;
    case 78:
        in.carry.rounding[18] = -0x1p+60;
        break;
    case 79:
        options.weight[0] = not_a_number.real;
        break;
    case 80:
        options.weight[2] = infinite.real;
        break;
    case 81:
        options.weight[0] = 0x1p+60;
        break;
    case 82:
        options.weight[2] = -0x1p+60;
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
        options.limit[2] = -0x1p+60;
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
        options.most[2] = -0x1p+60;
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
        options.motor_torque[2] = -0x1p+60;
        break;
    case 96:
        options.motor_torque[0] = -0x1p+0;
        break;
    case 97:
        options.motor_speed[0] = not_a_number.real;
        break;
    case 98:
        options.motor_speed[2] = -0x1p+60;
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
        options.motor_viscous[2] = -0x1p+60;
        break;
    case 103:
        options.motor_viscous[0] = -0x1p+0;
        break;
    case 104:
        options.motor_coulomb[0] = not_a_number.real;
        break;
    case 105:
        options.motor_coulomb[2] = -0x1p+60;
        break;
    case 106:
        options.motor_coulomb[0] = -0x1p+0;
        break;
    case 107:
        options.motor_coulomb_speed[0] = not_a_number.real;
        break;
    case 108:
        options.motor_coulomb_speed[2] = -0x1p+60;
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
        for (int s = 0; s < DEMO3_N; ++s) { options.limit[s] = 0x1.1a8b68669359ep+9; }
        break;
    case 216:
        for (int s = 0; s < DEMO3_N; ++s) { options.limit[s] = 0x1.78b9e088c477ep+7; }
        break;
    case 217:
        for (int s = 0; s < DEMO3_N; ++s) { options.limit[s] = 0x1.78b9e088c477ep-1; }
        break;
    case 218:
        for (int s = 0; s < DEMO3_N; ++s) { options.weight[s] = 0x1p+2; }
        break;
    case 219:
        for (int s = 0; s < DEMO3_N; ++s) { options.most[s] = 0x1p-10; }
        break;
    case 220:
        for (int s = 0; s < DEMO3_N; ++s) { options.motor_torque[s] = 0x1p-10; }
        break;
    case 221:
        for (int s = 0; s < DEMO3_N; ++s) { options.motor_speed[s] = 0x1p-10; }
        break;
    case 222:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < DEMO3_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
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
        for (int s = 0; s < DEMO3_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
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
        for (int s = 0; s < DEMO3_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.V_dot[0] = 0x1p+0;
        in.V_dot[1] = -0x1p+0;
        in.V_dot[2] = 0x1p+0;
        in.V_dot[3] = -0x1p+0;
        in.V_dot[4] = 0x1p+0;
        in.V_dot[5] = -0x1p+0;
        break;
    case 225:
        for (int s = 0; s < DEMO3_N; ++s) { options.motor_viscous[s] = 0x1p-1; }
        for (int s = 0; s < DEMO3_N; ++s) { options.motor_coulomb[s] = 0x1p-1; }
        for (int s = 0; s < DEMO3_N; ++s) { options.motor_coulomb_speed[s] = 0x1p-1; }
        break;
    case 226:
        for (int s = 0; s < DEMO3_N; ++s) { parameters.flywheel[s].axis[0] = 0x1p+0; }
        for (int s = 0; s < DEMO3_N; ++s) { parameters.flywheel[s].axis[1] = 0x0p+0; }
        for (int s = 0; s < DEMO3_N; ++s) { parameters.flywheel[s].axis[2] = 0x0p+0; }
        for (int s = 0; s < DEMO3_N; ++s) { parameters.flywheel[s].zero[0] = 0x0p+0; }
        for (int s = 0; s < DEMO3_N; ++s) { parameters.flywheel[s].zero[1] = 0x1p+0; }
        for (int s = 0; s < DEMO3_N; ++s) { parameters.flywheel[s].body.center_of_mass[1] = 0x0p+0; }
        for (int s = 0; s < DEMO3_N; ++s) { parameters.flywheel[s].body.center_of_mass[2] = 0x0p+0; }
        for (int s = 0; s < DEMO3_N; ++s) { parameters.flywheel[s].body.inertia[3] = 0x0p+0; }
        for (int s = 0; s < DEMO3_N; ++s) { parameters.flywheel[s].body.inertia[4] = 0x0p+0; }
        break;
    case 227:
        for (int s = 0; s < DEMO3_N; ++s) { options.limit[s] = 0x1.1a8b68669359cp+9; }
        break;
    case 228:
        for (int s = 0; s < DEMO3_N; ++s) { options.limit[s] = 0x1.78b9e088c477bp+7; }
        break;
    case 229:
        for (int s = 0; s < DEMO3_N; ++s) { options.limit[s] = 0x1.78b9e088c477bp-1; }
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
    { 175, 32, 0, 0x2892887eu, { 0x20u } },
    { 176, 32, 0, 0xee877f0au, { 0x20u } },
    { 177, -2, 0, 0x00000000u, { 0x20u } },
    { 178, -2, 0, 0x00000000u, { 0x20u } },
    { 175, 32, 0, 0x5017cba4u, { 0x40u } },
    { 176, 32, 0, 0xe1e74a46u, { 0x40u } },
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
    { 213, 9, 0, 0xcd7f2357u, { 0x2000u } },
    { 214, 11, 0, 0x261d7e2au, { 0x2000u } },
    { 215, 12, 0, 0x788525d9u, { 0x2000u } },
    { 216, 12, 0, 0xf626b438u, { 0x2000u } },
    { 217, 12, 0, 0x62f7b28eu, { 0x2000u } },
    { 218, 8, 0, 0xfaa99a2eu, { 0x2000u } },
    { 219, 72, 0, 0x74b75ceeu, { 0x2000u } },
    { 220, 72, 0, 0x74b75ceeu, { 0x2000u } },
    { 221, 72, 0, 0x74b75ceeu, { 0x2000u } },
    { 222, 8, 0, 0xaa468b20u, { 0x2000u } },
    { 223, 8, 0, 0x5e893908u, { 0x2000u } },
    { 224, 8, 0, 0xb264aa10u, { 0x2000u } },
    { 225, 8, 0, 0xfaa99a2eu, { 0x2000u } },
    { 226, 24, 1, 0xb5ff74b0u, { 0x2000u } },
    { 213, 0, 0, 0x3e8ce9e3u, { 0x4000u } },
    { 214, 0, 0, 0x78b318b6u, { 0x4000u } },
    { 227, 0, 0, 0x3e8ce9e3u, { 0x4000u } },
    { 228, 0, 0, 0x3e8ce9e3u, { 0x4000u } },
    { 229, 0, 0, 0x3e8ce9e3u, { 0x4000u } },
    { 218, 0, 0, 0x3e8ce9e3u, { 0x4000u } },
    { 219, 64, 0, 0x3a122e23u, { 0x4000u } },
    { 220, 64, 0, 0x3a122e23u, { 0x4000u } },
    { 221, 64, 0, 0x3a122e23u, { 0x4000u } },
    { 222, 0, 0, 0x5214ad30u, { 0x4000u } },
    { 223, 0, 0, 0xf7ffa110u, { 0x4000u } },
    { 224, 0, 0, 0x85d36371u, { 0x4000u } },
    { 225, 0, 0, 0x3e8ce9e3u, { 0x4000u } },
    { 226, -3, 1, 0x00000000u, { 0x4000u } },
    { 230, 0, 0, 0xd0dc494cu, { 0x8000u } },
    { 231, 0, 0, 0x51457d73u, { 0x8000u } },
    { 230, 0, 0, 0x2dc8f8f7u, { 0x10000u } },
    { 231, -4, 0, 0x00000000u, { 0x10000u } },
    { 230, 0, 0, 0xb8fb550eu, { 0x20000u } },
    { 231, -4, 0, 0x00000000u, { 0x20000u } },
    { 175, 32, 0, 0x6778517du, { 0x200000u } },
    { 176, 32, 0, 0x66694e96u, { 0x200000u } },
    { 177, -2, 0, 0x00000000u, { 0x200000u } },
    { 178, -2, 0, 0x00000000u, { 0x200000u } },
    { 175, 32, 0, 0x87a59a35u, { 0x400000u } },
    { 176, 32, 0, 0xbad62417u, { 0x400000u } },
    { 177, -2, 0, 0x00000000u, { 0x400000u } },
    { 178, -2, 0, 0x00000000u, { 0x400000u } },
};

/* Makes all trials of one function, and leaves out each pointer in turn; returns how many are wrong. */
static uint32_t run_trials(int number)
{
    static demo3_table prepared;
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
                prepared = demo3_default;  /* prepare keeps what is not of the bodies */
                (void)demo3_prepare(&parameters, &prepared);
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
        if (status != (int)DEMO3_BAD_ARGUMENT || sum.touched != 0) {
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
    volatile demo3_real x = 0.7;
    const demo3_real whole = (x + 6755399441055744.0) - 6755399441055744.0;
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
    const demo3_real *numbers = f->numbers;
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
int demo3_selftest(void (*print)(const char *text), unsigned long sweep)
{
    int failures = 0;
    length = 0u;
    (void)demo3_prepare_mounts(&demo3_default_parameters, &mounting);
    if (EXCESS != 0 || rounds_to_integer() == 0) {
        add_text("wrong results: compiled with ");
        add_text(EXCESS != 0 ? "x87 arithmetic, without -msse2 -mfpmath=sse"
                             : "-ffast-math, -Ofast, -funsafe-math-optimizations or a part of them");
        end_line(print);
    }
    add_text("mahovik selftest demo3 structure 055bf547 physics fdeb29e7 real double");
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

#ifdef DEMO3_SELFTEST_MAIN
static void print_text(const char *text)
{
    (void)fputs(text, stdout);
}

int main(void)
{
    return demo3_selftest(print_text, DEMO3_SELFTEST_SWEEP) != 0;
}
#endif
