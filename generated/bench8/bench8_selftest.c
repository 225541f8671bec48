/* bench8_selftest.c: does bench8.c give the right bits on this machine?
 * mahovik 0.1.0; structure 309d41a6, physics 139422e0. Generated: change the stand file instead.
 *
 * Compile it with bench8.c as firmware is compiled (-std=c99 -ffp-contract=off; -fno-tree-vectorize as well by gcc
 * for x86-64 with FMA and for a Cortex-M55, or bits differ) and run it; on a board, define
 * BENCH8_SELFTEST_NO_MAIN and call bench8_selftest with what prints a text, such as to a serial port.
 * Golden vectors: inputs and answers of the generator's interpreter as hexadecimal constants; each bit must agree.
 * Sweep: states that an integer generator makes here; a hash of all answers a function is printed, to be
 * compared between machines. The log of a board is judged by `mahovik judge-log LOG STAND.toml`. It reads:
 *
 *     mahovik selftest bench8 structure 309d41a6 physics 139422e0 real double
 *     generator mahovik 0.1.0
 *     forward PASS cases 4 worst 0 ulp      a line a function; or FAIL, and how many cases are wrong
 *                                        (a distance above 1000000 ulp: worst more than 1000000 ulp)
 *     sweep 100                          states
 *     forward 0123abcd                   a line a function: FNV-1a of its statuses and outputs
 *     failures 0                         functions that failed; the last line
 *
 * No allocation. It keeps inputs and results in static memory: one caller at a time. */
#include "bench8.h"

#include <stddef.h>
#include <stdint.h>
#ifndef BENCH8_SELFTEST_NO_MAIN
#include <stdio.h>
#endif

#if BENCH8_STRUCTURE != 0x309d41a6u || BENCH8_PHYSICS != 0x139422e0u
#error "bench8.h and bench8_selftest.c are of different stands"
#endif
#if BENCH8_LANES != 1
#error "bench8.h and bench8_selftest.c were generated for different numbers of lanes"
#endif

#ifndef BENCH8_SELFTEST_SWEEP
#define BENCH8_SELFTEST_SWEEP 100ul  /* states of the sweep that main runs */
#endif

int bench8_selftest(void (*print)(const char *text), unsigned long sweep);

typedef uint64_t real_bits;

enum { CASES = 3, FUNCTIONS = 23, SWEPT = 1 };

#define FAR ((real_bits)1000000u)  /* ulp: a worse distance is not printed as a number */

/* ---- inputs and results ---- */

/* What the functions take beside the stand's own constants. */
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
    bench8_real mass_factor;  /* of all masses and inertias of the parameters */
} inputs;

static inputs in;
static bench8_parameters parameters;
static bench8_mount_table mounting;

static union {
    struct { bench8_real V_dot[6]; } forward;
    struct { bench8_real F[6]; } wrench;
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
    struct { bench8_real center_of_mass_velocity[3]; } center_of_mass_velocity;
    unsigned char bytes[1];
} results;

enum { UNTOUCHED = 0x5a };  /* what every byte of the results holds before a call */

/* ---- taking results: their hash, and how far they are from what is expected ---- */

typedef struct tally {
    uint32_t hash;                /* FNV-1a of all bits taken so far, the lowest byte of a number first */
    const bench8_real *expected;  /* next numbers that are expected, `left` of them */
    int left;
    int touched;                  /* results that were written in spite of a refusal */
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

/* Numbers between two reals, by their bits: signed magnitudes laid on one line. */
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

static void untouched(tally *sum, const void *place, size_t size)
{
    const unsigned char *bytes = place;
    for (size_t i = 0; i < size; ++i) {
        sum->touched += bytes[i] != (unsigned char)UNTOUCHED ? 1 : 0;
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
        take_reals(sum, value->I[i], BENCH8_N);
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

/* ---- every function: called with the inputs; its results taken ---- */

static bench8_status call_forward(void)
{
    return bench8_forward(&bench8_default, &in.x, in.phi_ddot, results.forward.V_dot);
}

static void take_forward_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.forward.V_dot, sizeof results.forward.V_dot);
        return;
    }
    take_reals(sum, results.forward.V_dot, 6);
}

static bench8_status call_wrench(void)
{
    return bench8_wrench(&bench8_default, &in.x, results.wrench.F);
}

static void take_wrench_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.wrench.F, sizeof results.wrench.F);
        return;
    }
    take_reals(sum, results.wrench.F, 6);
}

static bench8_status call_matrices(void)
{
    return bench8_matrices(&bench8_default, &in.x, &results.matrices.out);
}

static void take_matrices_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.matrices.out, sizeof results.matrices.out);
        return;
    }
    take_matrices_result(sum, &results.matrices.out);
}

static bench8_status call_momentum(void)
{
    return bench8_momentum(&bench8_default, &in.x, &results.momentum.out);
}

static void take_momentum_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.momentum.out, sizeof results.momentum.out);
        return;
    }
    take_momentum_result(sum, &results.momentum.out);
}

static bench8_status call_torque(void)
{
    return bench8_torque(&bench8_default, &in.x, in.V_dot, in.phi_ddot, results.torque.tau);
}

static void take_torque_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.torque.tau, sizeof results.torque.tau);
        return;
    }
    take_reals(sum, results.torque.tau, BENCH8_N);
}

static bench8_status call_coupled(void)
{
    return bench8_coupled(&bench8_default, &in.x, in.tau, in.locked, results.coupled.V_dot,
        results.coupled.phi_ddot);
}

static void take_coupled_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.coupled.V_dot, sizeof results.coupled.V_dot);
        untouched(sum, &results.coupled.phi_ddot, sizeof results.coupled.phi_ddot);
        return;
    }
    take_reals(sum, results.coupled.V_dot, 6);
    take_reals(sum, results.coupled.phi_ddot, BENCH8_N);
}

static bench8_status call_step(void)
{
    return bench8_step(&bench8_default, &in.x, in.tau, in.locked, in.dt, in.order, &results.step.next);
}

static void take_step_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.step.next, sizeof results.step.next);
        return;
    }
    take_state(sum, &results.step.next);
}

static bench8_status call_step_driven(void)
{
    return bench8_step_driven(&bench8_default, &in.x, in.phi_ddot, in.dt, in.order,
        &results.step_driven.next);
}

static void take_step_driven_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.step_driven.next, sizeof results.step_driven.next);
        return;
    }
    take_state(sum, &results.step_driven.next);
}

static bench8_status call_wrap(void)
{
    return bench8_wrap(in.phi, &results.wrap.wrapped);
}

static void take_wrap_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.wrap.wrapped, sizeof results.wrap.wrapped);
        return;
    }
    take_reals(sum, &results.wrap.wrapped, 1);
}

static bench8_status call_phase_of_counts(void)
{
    return bench8_phase_of_counts(in.count, in.per_turn, in.zero, &results.phase_of_counts.phi);
}

static void take_phase_of_counts_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.phase_of_counts.phi, sizeof results.phase_of_counts.phi);
        return;
    }
    take_reals(sum, &results.phase_of_counts.phi, 1);
}

static bench8_status call_speed_of_counts(void)
{
    return bench8_speed_of_counts(in.moved, in.per_turn, in.dt, &results.speed_of_counts.phi_dot);
}

static void take_speed_of_counts_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.speed_of_counts.phi_dot, sizeof results.speed_of_counts.phi_dot);
        return;
    }
    take_reals(sum, &results.speed_of_counts.phi_dot, 1);
}

static bench8_status call_accumulate(void)
{
    results.accumulate.encoder = in.encoder;
    return bench8_accumulate(&results.accumulate.encoder, in.counter, in.bits, in.per_turn);
}

static void take_accumulate_results(tally *sum, bench8_status status)
{
    (void)status;
    take_encoder(sum, &results.accumulate.encoder);
}

static bench8_status call_forward_jacobian(void)
{
    return bench8_forward_jacobian(&bench8_default, &in.x, in.phi_ddot, &results.forward_jacobian.out);
}

static void take_forward_jacobian_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.forward_jacobian.out, sizeof results.forward_jacobian.out);
        return;
    }
    take_forward_jacobian_result(sum, &results.forward_jacobian.out);
}

static bench8_status call_coupled_jacobian(void)
{
    return bench8_coupled_jacobian(&bench8_default, &in.x, in.tau, in.locked, &results.coupled_jacobian.out);
}

static void take_coupled_jacobian_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.coupled_jacobian.out, sizeof results.coupled_jacobian.out);
        return;
    }
    take_coupled_jacobian_result(sum, &results.coupled_jacobian.out);
}

static bench8_status call_inverse(void)
{
    return bench8_inverse(&bench8_default, &in.x, in.V_dot, &bench8_default_options, &results.inverse.out);
}

static void take_inverse_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.inverse.out, sizeof results.inverse.out);
        return;
    }
    take_inverse_result(sum, &results.inverse.out);
}

static bench8_status call_inverse_fast(void)
{
    return bench8_inverse_fast(&bench8_default, &in.x, in.V_dot, &bench8_default_options,
        results.inverse_fast.phi_ddot);
}

static void take_inverse_fast_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.inverse_fast.phi_ddot, sizeof results.inverse_fast.phi_ddot);
        return;
    }
    take_reals(sum, results.inverse_fast.phi_ddot, BENCH8_N);
}

static bench8_status call_quaternion(void)
{
    return bench8_quaternion(in.angles, results.quaternion.attitude);
}

static void take_quaternion_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.quaternion.attitude, sizeof results.quaternion.attitude);
        return;
    }
    take_reals(sum, results.quaternion.attitude, 4);
}

static bench8_status call_state_from_coordinates(void)
{
    results.state_from_coordinates.x = in.x;
    return bench8_state_from_coordinates(in.position, in.angles, in.q_dot, in.q_ddot,
        &results.state_from_coordinates.x, results.state_from_coordinates.V_dot);
}

static void take_state_from_coordinates_results(tally *sum, bench8_status status)
{
    take_state(sum, &results.state_from_coordinates.x);
    if (status < 0) {
        untouched(sum, &results.state_from_coordinates.V_dot, sizeof results.state_from_coordinates.V_dot);
        return;
    }
    take_reals(sum, results.state_from_coordinates.V_dot, 6);
}

static bench8_status call_generalized(void)
{
    return bench8_generalized(&bench8_default, &in.x, in.angles, in.phi_ddot, &results.generalized.out);
}

static void take_generalized_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.generalized.out, sizeof results.generalized.out);
        return;
    }
    take_generalized_result(sum, &results.generalized.out);
}

static bench8_status call_prepare(void)
{
    results.prepare.table = bench8_default;
    return bench8_prepare(&parameters, &results.prepare.table);
}

static void take_prepare_results(tally *sum, bench8_status status)
{
    (void)status;
    take_table(sum, &results.prepare.table);
}

static bench8_status call_mounts(void)
{
    return bench8_mounts(&bench8_default, &mounting, &in.x, in.V_dot, in.phi_ddot,
        results.mounts.mount_wrench);
}

static void take_mounts_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.mounts.mount_wrench, sizeof results.mounts.mount_wrench);
        return;
    }
    take_reals(sum, results.mounts.mount_wrench, 48);
}

static bench8_status call_prepare_mounts(void)
{
    return bench8_prepare_mounts(&parameters, &results.prepare_mounts.mounting);
}

static void take_prepare_mounts_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.prepare_mounts.mounting, sizeof results.prepare_mounts.mounting);
        return;
    }
    take_mount_table(sum, &results.prepare_mounts.mounting);
}

static bench8_status call_center_of_mass_velocity(void)
{
    return bench8_center_of_mass_velocity(&bench8_default, &in.x,
        results.center_of_mass_velocity.center_of_mass_velocity);
}

static void take_center_of_mass_velocity_results(tally *sum, bench8_status status)
{
    if (status < 0) {
        untouched(sum, &results.center_of_mass_velocity.center_of_mass_velocity,
            sizeof results.center_of_mass_velocity.center_of_mass_velocity);
        return;
    }
    take_reals(sum, results.center_of_mass_velocity.center_of_mass_velocity, 3);
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
        .mass_factor = 0x1.1cdc694p+0,
    },
    {   /* fast flywheels, large phases */
        .x = {
            .position = { -0x1.0249c8p+0, -0x1.371e7p-1, -0x1.214c38p+0 },
            .attitude = { -0x1.eb8928b54129cp-1, -0x1.9948d1d6e8bd7p-3, -0x1.89b152610201dp-3,
                -0x1.37d5f53606a8bp-5 },
            .V = { 0x1.82ebap+0, 0x1.0b38ap+1, -0x1.055d68p+2, -0x1.8f2aap+0, -0x1.763e6p-1, -0x1.df9aep+2 },
            .phi = { -0x1.f8caa4p+22, 0x1.3b88ccp+22, 0x1.8fd1ep+20, -0x1.0659ap+21, -0x1.b2c408p+22,
                -0x1.0c99cp+21, -0x1.5e586p+22, 0x1.d5b01p+21 },
            .phi_dot = { -0x1.6b39ap+13, 0x1.499108p+13, -0x1.859fdp+13, 0x1.fdeeap+13, 0x1.1fb6fp+13,
                -0x1.2794p+6, 0x1.33ded8p+13, -0x1.4256p+6 },
        },
        .phi_ddot = { -0x1.923cb8p+8, -0x1.67826p+8, 0x1.512658p+7, -0x1.3b3c18p+7, 0x1.8eec5p+7,
            -0x1.bb3d38p+8, 0x1.a3f8a8p+8, 0x1.882d1p+6 },
        .V_dot = { 0x1.4d94ap+3, -0x1.c47ac4p+5, 0x1.1746e8p+5, 0x1.037d6p+4, 0x1.a1c0ecp+5, -0x1.cf6e3p+5 },
        .tau = { 0x1.56ea88p+0, 0x1.f688fp-1, -0x1.0f622p+0, 0x1.a26cfp-1, 0x1.df44a8p+0, 0x1.670cp-5,
            -0x1.23708p-4, 0x1.598328p-1 },
        .locked = { 0, 1, 1, 0, 0, 1, 0, 0 },
        .dt = 0x1p-14,
        .order = 2,
        .phi = 0x1.297088p+21,
        .count = 326772,
        .per_turn = 4051,
        .zero = -0x1.70a96cp-1,
        .moved = -268,
        .encoder = {
            .counter = 10615,
            .place = 3374,
            .moved = -463,
        },
        .counter = -6932,
        .bits = 16,
        .angles = { 0x1.8ab58p-3, 0x1.b0decp-5, 0x1.7660dcp-1 },
        .position = { 0x1.a35e68p-1, -0x1.16ceep-3, 0x1.63ddcp-3 },
        .q_dot = { 0x1.e05b2p-3, -0x1.68bbep-1, -0x1.cbd33cp+0, -0x1.c483b8p+0, -0x1.ed35p-5, -0x1.bdd86p+0 },
        .q_ddot = { 0x1.f8f3ep+1, -0x1.ca174p+0, 0x1.bc5528p+2, 0x1.67f6p-1, 0x1.7f7ed8p+2, 0x1.1db6ap+3 },
        .mass_factor = 0x1.df731fp-1,
    },
    {   /* out of range */
        .x = {
            .position = { 0x1.7c0718p+40, -0x1.8e30bp+40, 0x1.c57048p+39 },
            .attitude = { -0x1.a12442024601dp+0, 0x1.a4d382b967ad8p-1, -0x1.0d0d85f03e16dp-2,
                -0x1.8cae31c7f2842p-1 },
            .V = { -0x1.74596p+0, 0x1.a5f084p+0, 0x1.107154p+0, 0x1.9703bp-2, -0x1.0a47f8p-1, -0x1.3b6cap-2 },
            .phi = { -0x1.997158p+43, 0x1.caa508p+43, 0x1.64ac8p+39, 0x1.49a318p+42, 0x1.c85dp+40,
                0x1.c55c48p+42, 0x1.ebfa1p+43, -0x1.afa2dp+41 },
            .phi_dot = { -0x1.3dbc3cp+7, 0x1.e6041p+7, 0x1.efbb3cp+7, -0x1.fcd4p+5, -0x1.05219cp+7,
                -0x1.1937p+2, -0x1.0b842cp+7, 0x1.7eee2p+5 },
        },
        .phi_ddot = { -0x1.093c78p+8, -0x1.8ed23cp+8, -0x1.027accp+8, 0x1.313078p+8, 0x1.f09e08p+7,
            -0x1.f2802p+8, -0x1.31426p+5, 0x1.947958p+7 },
        .V_dot = { 0x1.5360e8p+2, -0x1.bc3c4p+3, 0x1.4b5d2p+3, -0x1.e1ea1p+2, 0x1.43f77p+1, -0x1.7eaadp+3 },
        .tau = { 0x1.9d9098p-1, 0x1.2190ap+0, 0x1.881898p+0, 0x1.f82364p+0, -0x1.f67078p-1, 0x1.ef22p-2,
            0x1.9d4d4p-4, -0x1.125cp+0 },
        .locked = { 0, 0, 0, 0, 1, 1, 0, 1 },
        .dt = 0x0p+0,
        .order = 2,
        .phi = 0x1.a2090cp+43,
        .count = 326071,
        .per_turn = 0,
        .zero = -0x1.db3bp+36,
        .moved = 160,
        .encoder = {
            .counter = 30053,
            .place = 2210,
            .moved = 216,
        },
        .counter = 9909,
        .bits = 16,
        .angles = { 0x1.ad1878p+39, -0x1.1e24f4p+39, 0x1.81a498p+39 },
        .position = { -0x1.7e5fe8p+39, 0x1.60fa6p+40, -0x1.3e177p+38 },
        .q_dot = { -0x1.9c3facp+0, -0x1.6771dp-1, -0x1.b1380cp+0, 0x1.77166p-1, -0x1.92b278p+0,
            0x1.74d58p-2 },
        .q_ddot = { 0x1.ae2418p+2, 0x1.29377p+1, -0x1.8574p+0, -0x1.e60618p+3, 0x1.bd62p+3, -0x1.a79a1cp+3 },
        .mass_factor = -0x1.cee9848p-1,
    },
};

typedef struct answer {
    int status;
    uint32_t hash;  /* of the status and all outputs */
    int listed;     /* outputs whose numbers are given, at most 32 */
} answer;

static const bench8_real numbers_forward[] =
{
    0x1.0c813b25a39bep+6, 0x1.43979fe78abc2p+5, -0x1.0c1667ea3f8d8p+7, -0x1.3cc4d0ae85436p+7,
        0x1.4669f62b51ac3p+6, 0x1.636b664fb1687p+7,
    -0x1.78f4e8ea7c898p+16, 0x1.38d54a0b17e29p+14, -0x1.98f53dd13fc14p+15, 0x1.35fc0d6846932p+19,
        -0x1.87138cb705dd3p+16, 0x1.888286cd88331p+17,
};

static const bench8_real numbers_wrench[] =
{
    0x1.52736dbc4aeacp+10, 0x1.3483697ffbc7p+9, -0x1.1cdcb04af68cbp+11, 0x1.152a6f2877f5fp+2,
        0x1.13752e8788f1dp+6, 0x1.6c75fa658b4a7p+6,
    0x1.e9a4e80ed751ep+9, 0x1.8ff0f81e2f85ap+10, 0x1.e2ce118fa72bap+10, -0x1.680db0115aa44p+4,
        -0x1.62bd15a6a32c6p+4, 0x1.4dbf318062eb9p+0,
};

static const bench8_real numbers_matrices[] =
{
    0x1.263d70a3d70a4p+4, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.608252b6c8bbbp-4, 0x1.04bc709af2b53p-5, 0x0p+0,
        0x1.263d70a3d70a4p+4, 0x0p+0, -0x1.608252b6c8bbbp-4, 0x0p+0, 0x1.9ccde91f6efc7p-5, 0x0p+0, 0x0p+0,
        0x1.263d70a3d70a4p+4, -0x1.04bc709af2b53p-5, -0x1.9ccde91f6efc7p-5, 0x0p+0, 0x0p+0,
        -0x1.608252b6c8bbbp-4, -0x1.04bc709af2b53p-5, 0x1.aa0627e45917bp-2, 0x1.ff53ed70237c4p-9,
        -0x1.61a1c613ab6e5p-10, 0x1.608252b6c8bbbp-4, 0x0p+0, -0x1.9ccde91f6efc7p-5, 0x1.ff53ed70237c4p-9,
        0x1.ebf9a21acd932p-2, 0x1.9bcc479447a03p-9, 0x1.04bc709af2b53p-5, 0x1.9ccde91f6efc7p-5,
    0x1.263d70a3d70a4p+4, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.7fda90271e0f2p-4, 0x1.7587b5902781cp-6, 0x0p+0,
        0x1.263d70a3d70a4p+4, 0x0p+0, -0x1.7fda90271e0f2p-4, 0x0p+0, 0x1.27110d0648825p-5, 0x0p+0, 0x0p+0,
        0x1.263d70a3d70a4p+4, -0x1.7587b5902781cp-6, -0x1.27110d0648825p-5, 0x0p+0, 0x0p+0,
        -0x1.7fda90271e0f2p-4, -0x1.7587b5902781cp-6, 0x1.a7dd51b3fa8d5p-2, 0x1.c419e0b651622p-8,
        -0x1.875e37a7fd14ep-9, 0x1.7fda90271e0f2p-4, 0x0p+0, -0x1.27110d0648825p-5, 0x1.c419e0b651622p-8,
        0x1.e51b081b8b188p-2, 0x1.7d331465973abp-11, 0x1.7587b5902781cp-6, 0x1.27110d0648825p-5,
};

static const bench8_real numbers_momentum[] =
{
    0x1.f18b7b33dccaap+4, 0x1.1afcbfed397b3p+5, 0x1.cf1e5eaf71db5p+3, 0x1.aefba8ee727cep-3,
        0x1.3f5a154554b4p-2, 0x1.278da543307dbp+0, 0x1.2e8cb355ee534p+3, -0x1.cc0503fe5e9aep+2,
        0x1.7e8d9b5b5fb92p+5, 0x1.1bd76c32d2c4fp+6, 0x1.191fad92dcc3ap+5, -0x1.00febbeb7970dp+3,
        0x1.7d1aeb718deebp+7, 0x1.6727ce070637ap-9, -0x1.c5b35de756fb8p-10, 0x1.32b2418f93c75p-8,
    0x1.bca6ecc66c59cp+4, 0x1.8e3403d8590e9p+5, -0x1.cb89b2904bd17p+7, -0x1.d627da6ae64p+3,
        -0x1.756e3f5287a38p+4, 0x1.5ad8977d0764bp+2, -0x1.f3af410e9dae6p+5, 0x1.0d40168f6a8dep+7,
        -0x1.70e1b54469053p+7, 0x1.f94971c3a7cbap+7, -0x1.1a3aee113ebe2p+7, -0x1.5a96ec2a7ddfp+7,
        0x1.e9c0813b1dbb8p+18, 0x1.00b81c095d4b1p-9, -0x1.44fc44516e3d6p-10, 0x1.4df7a67bf5f57p-8,
};

static const bench8_real numbers_torque[] =
{
    0x1.62a6e959df85p-2, -0x1.8f011aed08e3cp-3, 0x1.053cbfdd674eep-1, 0x1.47a4b834effb2p-1,
        0x1.e8cd52baa4de5p-3, -0x1.622ce13dbda1bp-4, 0x1.e299e8e5ab86cp-3, 0x1.c61848e127e4cp-2,
    -0x1.8b6b686418b38p-6, -0x1.059833981f8e5p-2, 0x1.c563d5b63b7dap-2, -0x1.3e40c0846a6c2p-2,
        0x1.03886bddf7045p-1, -0x1.f4c9ada8dcff8p-3, 0x1.c04a097638fb3p-3, -0x1.7242ad9c45593p-4,
};

static const bench8_real numbers_coupled[] =
{
    0x1.0e89bed37a9b2p+6, 0x1.44013c5403338p+5, -0x1.0c92cd8453ed2p+7, -0x1.3636ca9743bfcp+7,
        0x1.4f3046cbbff83p+6, 0x1.697df006a080bp+7, -0x1.2e5dbfeacf9c7p+9, -0x1.d8d91ba90b7edp+9,
        -0x1.708b8c7b5efe6p+10, 0x1.215df018df594p+6, 0x0p+0, 0x1.dad6009919638p+10, 0x1.5474832e4e58cp+10,
        0x1.c79e7b9631c28p+10,
    -0x1.794e0689482c8p+16, 0x1.383245cc117bp+14, -0x1.990556c9150acp+15, 0x1.38ae53539c8c8p+19,
        -0x1.82853cd95a4cfp+16, 0x1.89ad734aad36p+17, -0x1.709c7e6a2b8f4p+19, 0x0p+0, 0x0p+0,
        -0x1.7f69af2f0df31p+16, -0x1.6ed9eaa408431p+17, 0x0p+0, -0x1.a25cb523ff2e7p+19, 0x1.7ae35dbb7fc3dp+17,
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
    -0x1.0257c6b73c06fp+0, -0x1.36fb96eae57bep-1, -0x1.21591ed0e8bcap+0, -0x1.eb7dda97631fap-1,
        -0x1.9a5b2fb239b49p-3, -0x1.8986e8299427fp-3, -0x1.36763b0156e63p-5, -0x1.7a4daf8f8cc4cp+1,
        0x1.d1e6ad41ab162p+1, -0x1.3648e52e1169p+3, 0x1.202e2dff69ce1p+5, -0x1.6048139bdf734p+3,
        0x1.4a1869ccf7574p+1, 0x1.afe2e2a64f108p-1, -0x1.433121abc8201p+0, -0x1.7ddbf63042fa1p-1,
        -0x1.2fcc972342c8fp+0, 0x1.c31562b3d03cp+0, 0x1.c5f3acc71f656p+0, -0x1.328ac61017f5cp+0,
        -0x1.3a71c66dff272p+1, -0x1.6c96de3a0b1ebp+13, 0x1.499108p+13, -0x1.859fdp+13, 0x1.fdb38ca7db7c5p+13,
        0x1.1fbb53e7f9c4ep+13, -0x1.2794p+6, 0x1.32ab854af8d25p+13, -0x1.1d625e4166d67p+6,
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
    -0x1.0257c40b07eefp+0, -0x1.36fb93eed6eap-1, -0x1.21591f14ed7aap+0, -0x1.eb7e04e0f89bfp-1,
        -0x1.9a58903fd35eap-3, -0x1.8986510094e8bp-3, -0x1.3676ba5f380fp-5, -0x1.79df301d5301p+1,
        0x1.d1bad3df1d896p+1, -0x1.3701e25336444p+3, 0x1.1db2f6d1df983p+5, -0x1.60166c4a40432p+3,
        0x1.4bddeae8395cp+1, 0x1.b09b17c1b8a64p-1, -0x1.43312ce7db201p+0, -0x1.7ddbeba7103a1p-1,
        -0x1.2fc0a0c2b9b08p+0, 0x1.c32c568e2bbc8p+0, 0x1.c5f39eed35a56p+0, -0x1.322221c309b5fp+0,
        -0x1.3a7d9c00bff32p+1, -0x1.6b39d24797p+13, 0x1.4990db0fb4p+13, -0x1.859fbaed9a8p+13,
        0x1.fdee8c4c3e8p+13, 0x1.1fb708eec5p+13, -0x1.27afb3d38p+6, 0x1.33df0c7f15p+13, -0x1.424fdf4bcp+6,
};

static const bench8_real numbers_wrap[] =
{
    -0x1.51bd7p+1,
    -0x1.1732d03de58b2p-1,
};

static const bench8_real numbers_phase_of_counts[] =
{
    -0x1.318f2c2cffb82p+0,
    -0x1.0da9044967e85p+1,
};

static const bench8_real numbers_speed_of_counts[] =
{
    0x1.e1668abf39bffp+11,
    -0x1.a9a65594269ffp+12,
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
    -0x1.5c6150b8e63bap+0, -0x1.df9c9b1921dffp+2, 0x1.7682d0e7a85e1p-1, -0x1.4bae0a9584b4dp-4,
        0x1.4a3d360fa5b39p+4, 0x1.89ce8cc230527p+1, 0x1.df9924e6de1ffp+2, -0x1.5c7350a6ae9b7p+0,
        -0x1.8f4311b64306cp+0, -0x1.548e15dae911fp+4, -0x1.9c28aec0949a5p-5, -0x1.f882f1e352d6fp+0,
        -0x1.75f9ef1857a1fp-1, 0x1.8f122e49bcf92p+0, -0x1.5c16ff3deed41p+0, -0x1.b1888cc099f9p+1,
        0x1.99b80256048a7p+0, -0x1.086d503fc1348p-6, -0x1.1161cfa36b60ap-8, -0x1.3b28453fcb4c8p-2,
        -0x1.2c1d3716986edp-4, -0x1.0a76bea9ee817p+6, -0x1.6bd87b19e1ebp+4, -0x1.3cfee7b32edddp+6,
        0x1.13b371d60086bp-2, 0x1.1e7661f7d30a8p-8, -0x1.a381268a77cdbp-4, 0x1.2581277500f07p+4,
        0x1.babfb8a02c17fp+5, 0x1.4698a9180213fp+5, 0x1.60f220a0fb09cp-5, 0x1.13721d45dcf97p-4,
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
    -0x1.5ced411cac84p+0, -0x1.dfa1c58bb4cc6p+2, 0x1.76727ce24b0b6p-1, -0x1.b153a8965fe8ap-4,
        0x1.4a328ec0f97a7p+4, 0x1.856f1c816f1bcp+1, 0x1.df93fa744b33ap+2, -0x1.5d5480cafdd5ap+0,
        -0x1.8f37d5677a834p+0, -0x1.552e6fa67bf8ep+4, -0x1.4179c69dcd51bp-5, -0x1.f69dacebc3bdfp+0,
        -0x1.760a431db4f4bp-1, 0x1.8f1d6a98857cdp+0, -0x1.5c87f25b68992p+0, -0x1.b2fc3424dff6dp+1,
        0x1.9cbb50b38c216p+0, -0x1.c9c0e11cb5c1fp-6, -0x1.565c1f79cd65cp-7, -0x1.3836621d513c9p-2,
        -0x1.5fd8627a09907p-4, -0x1.0d3209ec521fep+6, -0x1.6df04287c6649p+4, -0x1.40e3652b7d7ap+6,
        0x1.2f78732d6414bp-2, -0x1.2294dbc2f6ea5p-10, -0x1.d304aa3e83fp-4, 0x1.2717a5936d85p+4,
        0x1.bc1e51a881486p+5, 0x1.49988513c968cp+5, 0x1.b2911ef41bbe9p-5, 0x1.2820eade9f9dfp-4,
};

static const bench8_real numbers_inverse[] =
{
    -0x1.1d9284f5e6a3fp+16, 0x1.8e491b9449391p+17, 0x1.45bcf7565b7c8p+16, -0x1.d26821cdc112ep+16,
        -0x1.763be790758a3p+15, -0x1.cf538da850732p+17, 0x1.20fce9d56dcb5p+16, -0x1.21b26dfad944p+18,
        -0x1.4p-41, -0x1p-42, 0x1p-41, -0x1.8p-43, 0x1p-43, 0x1.2p-41, 0x1.fdfd9fcd67ef9p-4,
        0x1.c7a48e8d86227p-4, 0x1.bcf10151d00b1p-4, 0x1.b1823735dc04ap-5, 0x1.a86f67673cf6dp-6,
        0x1.d0ad958e619f2p-7, 0x0p+0, 0x1.6d56759799267p+1, 0x1.fcfb5a1154c88p-1, 0x1.1256644337123p+1,
        -0x1.ee0618ef93aacp-4, 0x1.39a4e52b5f619p-2, -0x1.356215b876f8ap-3,
    0x1.9799b5a69422fp+26, -0x1.8a86cb72a4a04p+23, -0x1.ed2a860589ad2p+26, 0x1.c827846e2ea41p+25,
        0x1.ada85f9716eb5p+24, -0x1.1f9cbc7438397p+28, 0x1.c9541aaf81eep+26, 0x1.4cebf50f3c97p+24, 0x1.bp-31,
        -0x1.cp-34, -0x1.ap-32, -0x1.18p-33, -0x1.4p-35, -0x1p-37, 0x1.c6bad391d6018p-4, 0x1.a7b6fb7e71da9p-4,
        0x1.fb4b3782f2812p-5, 0x1.c4f96562246e8p-5, 0x1.1836f08b1a22p-5, 0x1.afe3b674f7babp-6, 0x0p+0,
        0x1.668989339a9b6p+1, 0x1.213798d8ba7a1p-1, 0x1.ba0a605291c0fp-1, -0x1.68b9239b1cc56p-8,
        0x1.c9e7ca7ec1c9bp-5, 0x1.3810b9983261p-1,
};

static const bench8_real numbers_inverse_fast[] =
{
    -0x1.1d9284f5e6a49p+16, 0x1.8e491b944938fp+17, 0x1.45bcf7565b7cbp+16, -0x1.d26821cdc111fp+16,
        -0x1.763be7907587fp+15, -0x1.cf538da85072ep+17, 0x1.20fce9d56dcaep+16, -0x1.21b26dfad943bp+18,
    0x1.9799b5a69422cp+26, -0x1.8a86cb72a49fap+23, -0x1.ed2a860589ad6p+26, 0x1.c827846e2ea39p+25,
        0x1.ada85f9716eadp+24, -0x1.1f9cbc7438397p+28, 0x1.c9541aaf81ee2p+26, 0x1.4cebf50f3c978p+24,
};

static const bench8_real numbers_quaternion[] =
{
    0x1.dc551e125052cp-1, 0x1.f8cb0c6616f6ep-3, -0x1.2996f623fce36p-3, 0x1.d5bacd21650a7p-3,
    0x1.dc3ddd947a8b2p-1, 0x1.69d6566611acep-2, 0x1.e2dc9bc3c05d3p-5, 0x1.496b0014e5738p-4,
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
    0x1.a35e68p-1, -0x1.16ceep-3, 0x1.63ddcp-3, 0x1.dc3ddd947a8b2p-1, 0x1.69d6566611acep-2,
        0x1.e2dc9bc3c05d3p-5, 0x1.496b0014e5738p-4, 0x1.851a14de93482p-3, -0x1.be1a585359916p+0,
        -0x1.ade626ccf1993p-1, -0x1.a5f1f8ffca2p+0, -0x1.3939e8ea060a3p+0, -0x1.461344a6c31e6p+0,
        -0x1.f8caa4p+22, 0x1.3b88ccp+22, 0x1.8fd1ep+20, -0x1.0659ap+21, -0x1.b2c408p+22, -0x1.0c99cp+21,
        -0x1.5e586p+22, 0x1.d5b01p+21, -0x1.6b39ap+13, 0x1.499108p+13, -0x1.859fdp+13, 0x1.fdeeap+13,
        0x1.1fb6fp+13, -0x1.2794p+6, 0x1.33ded8p+13, -0x1.4256p+6, 0x1.16631ed76177ep+2, 0x1.20a83509557edp+2,
        0x1.efa3c6756ba75p+1,
    0x1.7c0718p+40, -0x1.8e30bp+40, 0x1.c57048p+39, -0x1.a12442024601dp+0, 0x1.a4d382b967ad8p-1,
        -0x1.0d0d85f03e16dp-2, -0x1.8cae31c7f2842p-1, -0x1.74596p+0, 0x1.a5f084p+0, 0x1.107154p+0,
        0x1.9703bp-2, -0x1.0a47f8p-1, -0x1.3b6cap-2, -0x1.997158p+43, 0x1.caa508p+43, 0x1.64ac8p+39,
        0x1.49a318p+42, 0x1.c85dp+40, 0x1.c55c48p+42, 0x1.ebfa1p+43, -0x1.afa2dp+41, -0x1.3dbc3cp+7,
        0x1.e6041p+7, 0x1.efbb3cp+7, -0x1.fcd4p+5, -0x1.05219cp+7, -0x1.1937p+2, -0x1.0b842cp+7, 0x1.7eee2p+5,
};

static const bench8_real numbers_generalized[] =
{
    0x1.b482a63f00b45p-1, 0x1.6ba81a182028ep-2, 0x1.88a35c971f121p-2, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.fe5b6985925bap-2, 0x1.8beb9e23645f4p-1, 0x1.915f59fffd2c2p-2, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.42288e50ffd92p-3, -0x1.0cf103e26dc5p-1, 0x1.ac2b03dfc7b74p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.88a35c971f121p-2, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.915f59fffd2c4p-2,
        0x1.cf9a2e507672bp-1, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.f5d1abbb9bab8p-1, 0x1.87b8f3c4234cap-3, -0x1.b0ab3064c6087p-5, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.ba33380455dddp-4, 0x1.7984e26c29792p-1, 0x1.556baba138a06p-1, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.54f8a4f79ab9cp-3, -0x1.4bb64e470c442p-1, 0x1.7c95afbf3b5e7p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, -0x1.b0ab3064c6088p-5, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.556baba138a06p-1,
        0x1.7d1ddcee4d06fp-1, 0x0p+0, 0x0p+0, 0x0p+0,
};

static const bench8_real numbers_prepare[] =
{
    0x1.47697ebb51eb8p+4, 0x1.9053ca55fe4d5p-5, 0x1.833f23c59d8ccp-5, -0x1.3a8cd8ad1456cp-5,
        0x1.d10298f8ee2c2p-4, 0x1.d7e29c903ea1p-2, 0x1.0f5893efe049p-1, 0x1.993728e59c6fcp-1,
        0x1.5ee6b919311acp-8, -0x1.d7aa887fd968ep-10, 0x1.a53b0bfa5be88p-9, 0x0p+0, 0x1.5e098432ca57bp-8,
        -0x1.755f7bf1e8e61p-11, 0x0p+0, 0x1.755f7bf1e8e61p-11, 0x1.5e098432ca57bp-8, 0x1.0cd41bcce5209p-9,
        -0x1.667025113180bp-14, 0x1.18079cf56eac9p-9, -0x1.2e6e9f4681c49p-15, 0x1.7e557cdf23bc7p-22,
        -0x1.755f7bf1e8e6p-13, 0x1.e5628787485e4p-11, 0x1.500922c01e68ap-11, 0x1.2ab2c98e53eb4p-12,
        -0x1.7e557cdf23bc7p-22, -0x1.2e6e9f4681c49p-15, -0x1.233b1e1df8389p-10, 0x0p+0, 0x1.b54b606c0414p-18,
        -0x1.b54b606c0414p-18,
    0x1.1388a37ecccccp+4, 0x1.dbb3c158a1c43p-5, 0x1.45e3350d81272p-5, -0x1.08b5b58c13294p-5,
        0x1.8754559f74f76p-4, 0x1.8d1d798d13d69p-2, 0x1.c8b3dfa5bc936p-2, 0x1.58601a5ecbcdep-1,
        0x1.274d12906ce54p-8, -0x1.8cee483373cecp-10, 0x1.627c9ddf2c647p-9, 0x0p+0, 0x1.2692ea7ef9db2p-8,
        -0x1.3a364f765fd8bp-11, 0x0p+0, 0x1.3a364f765fd8bp-11, 0x1.2692ea7ef9db2p-8, 0x1.c4772abef06b4p-10,
        -0x1.2da4c729f59cdp-14, 0x1.d75177318fc5p-10, -0x1.fd061016ce78ap-16, 0x1.41c0d47105fcap-22,
        -0x1.3a364f765fd8ap-13, 0x1.9879cdb37c99bp-11, 0x1.1aca7ab75643p-11, 0x1.f6bd4bf0995acp-13,
        -0x1.41c0d47105fcap-22, -0x1.fd061016ce78ap-16, -0x1.ea2bc3a42f1edp-11, 0x0p+0, 0x1.70015961454p-18,
        -0x1.70015961454p-18,
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
    0x1.b7e1546058d65p+9, -0x1.7bb15424f9c98p+16, -0x1.3bf7eaabeae9dp+19, -0x1.8b6b68641ba3p-6,
        0x1.17f2120f4b1bfp+12, -0x1.fdd401df522d2p+6, 0x1.2d65122b5549fp+9, 0x1.3870d1e606988p+17,
        0x1.c025cbc227496p+18, -0x1.059833981f895p-2, -0x1.ea3b9a63dc1a3p+10, 0x1.3f5578595ff05p+9,
        -0x1.060df0bd57534p+7, -0x1.8c23f7cf83eddp+19, -0x1.c33f776367593p+16, 0x1.c563d5b63b6bep-2,
        0x1.8ca2b2928d9b8p+7, -0x1.e44b0fe7c270ap+10, 0x1.0840da4c8e353p+10, 0x1.9e98397251e63p+19,
        0x1.be2657174bcbap+19, -0x1.3e40c0846a668p-2, 0x1.420e83279d2e6p+8, -0x1.929b5bd7ec13p+8,
        0x1.053f7845c11ccp+7, -0x1.157aa1262e19ep+17, -0x1.652f70af78bc8p+18, 0x1.03886bddf70cbp-1,
        -0x1.26f958054a56p+9, 0x1.e9e77810705c2p+7, -0x1.327d7e3ca845ap+5, -0x1.6187ccb82c9fcp+3,
};

static const bench8_real numbers_prepare_mounts[] =
{
    0x1.c7c70eccccccdp-1, 0x1.d2b75aee631f9p-12, 0x1.5e098432ca57bp-8, -0x1.755f7bf1e8e61p-11,
        0x1.5800a5f96e51bp-10, 0x1.c776b53bf51b2p-11, 0x1.c0a187ba450adp-11, -0x1.2e6e9f4681c49p-15,
        0x1.7e557cdf23bc7p-22, 0x1.ba12d8620151ep-17, 0x0p+0, 0x1.999999999999ap-3, 0x1.eb851eb851eb8p-5,
        0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1p+0, -0x0p+0, -0x0p+0, 0x0p+0, 0x1p+0, 0x1.bc6214d47ae15p-1,
        -0x1.c70c5f0ed3d86p-12, 0x1.3e88a8f0c77dep-8, 0x0p+0, 0x1.5696630dfebcp-10, 0x1.d2d47a71661edp-11,
        0x1.b8433c483fa03p-11, -0x1.4c99c48750634p-16, 0x0p+0, 0x1.2ab2c98e53eb3p-17,
    0x1.7f8f4cp-1, 0x1.88c3e353f7ceep-12, 0x1.2692ea7ef9db2p-8, -0x1.3a364f765fd8bp-11, 0x1.217ed4f1612bcp-10,
        0x1.7f4badacf43f6p-11, 0x1.798ba8476f2a6p-11, -0x1.fd061016ce78ap-16, 0x1.41c0d47105fcap-22,
        0x1.7406f5a2aeec1p-17, 0x0p+0, 0x1.999999999999ap-3, 0x1.eb851eb851eb8p-5, 0x1p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x1p+0, -0x0p+0, -0x0p+0, 0x0p+0, 0x1p+0, 0x1.75f883b333333p-1, -0x1.7ef230d844d01p-12,
        0x1.0c0feefdc9c4dp-8, 0x0p+0, 0x1.204df87a02e1ap-10, 0x1.88dc6584266adp-11, 0x1.7280cefe8578fp-11,
        -0x1.17e67268524eep-16, 0x0p+0, 0x1.f6bd4bf0995abp-18,
};

static const bench8_real numbers_center_of_mass_velocity[] =
{
    0x1.073acc31b4c36p-1, -0x1.903c0bd3b4ba8p-2, 0x1.4cd5f73a3343ep+1,
    -0x1.b2be9ec787ef9p+1, 0x1.d4841ee775574p+2, -0x1.40f0ebaa3037cp+3,
};

typedef struct function {
    const char *name;
    size_t size;  /* of its results, bytes */
    bench8_status (*call)(void);
    void (*take)(tally *sum, bench8_status status);
    const bench8_real *numbers;
    answer answers[CASES];
    uint32_t swept;  /* hash of the first SWEPT states of a sweep */
} function;

static const function functions[FUNCTIONS] =
{
    { "forward", sizeof results.forward,
      call_forward, take_forward_results, numbers_forward,
      { { 0, 0x21926755u, 6 }, { 0, 0xb9912146u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x132e0291u },
    { "wrench", sizeof results.wrench,
      call_wrench, take_wrench_results, numbers_wrench,
      { { 0, 0x010012dbu, 6 }, { 0, 0x08f9e8cau, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0xf2f3dff5u },
    { "matrices", sizeof results.matrices,
      call_matrices, take_matrices_results, numbers_matrices,
      { { 0, 0x682bd07bu, 32 }, { 0, 0xadc40a37u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x7bef5155u },
    { "momentum", sizeof results.momentum,
      call_momentum, take_momentum_results, numbers_momentum,
      { { 0, 0x98524fa5u, 16 }, { 0, 0xa01fc823u, 16 }, { -2, 0x8e5b0aa0u, 0 } },
      0x9e92b592u },
    { "torque", sizeof results.torque,
      call_torque, take_torque_results, numbers_torque,
      { { 0, 0x808ccee9u, 8 }, { 0, 0xb22a5b39u, 8 }, { -2, 0x8e5b0aa0u, 0 } },
      0x872a6fb7u },
    { "coupled", sizeof results.coupled,
      call_coupled, take_coupled_results, numbers_coupled,
      { { 0, 0xa7208c38u, 14 }, { 0, 0xdd7000b2u, 14 }, { -2, 0x8e5b0aa0u, 0 } },
      0x6b1336f1u },
    { "step", sizeof results.step,
      call_step, take_step_results, numbers_step,
      { { 0, 0x8c3f6baau, 29 }, { 0, 0xd7627958u, 29 }, { -2, 0x8e5b0aa0u, 0 } },
      0x4826dd03u },
    { "step_driven", sizeof results.step_driven,
      call_step_driven, take_step_driven_results, numbers_step_driven,
      { { 0, 0x4c620d50u, 29 }, { 0, 0xd1f2a2a6u, 29 }, { -2, 0x8e5b0aa0u, 0 } },
      0xdf1c5c91u },
    { "wrap", sizeof results.wrap,
      call_wrap, take_wrap_results, numbers_wrap,
      { { 0, 0xcb624462u, 1 }, { 0, 0x033ce720u, 1 }, { -2, 0x8e5b0aa0u, 0 } },
      0xf093937eu },
    { "phase_of_counts", sizeof results.phase_of_counts,
      call_phase_of_counts, take_phase_of_counts_results, numbers_phase_of_counts,
      { { 0, 0xb09c9837u, 1 }, { 0, 0x90607fbeu, 1 }, { -5, 0x2107376du, 0 } },
      0xf4f2688eu },
    { "speed_of_counts", sizeof results.speed_of_counts,
      call_speed_of_counts, take_speed_of_counts_results, numbers_speed_of_counts,
      { { 0, 0x3bf2b1bdu, 1 }, { 0, 0x8ae85599u, 1 }, { -5, 0x2107376du, 0 } },
      0x2c3d9242u },
    { "accumulate", sizeof results.accumulate,
      call_accumulate, take_accumulate_results, numbers_accumulate,
      { { 0, 0x6a812c88u, 0 }, { 0, 0x7e47f32bu, 0 }, { -5, 0x0d6fd6fdu, 0 } },
      0x410f3977u },
    { "forward_jacobian", sizeof results.forward_jacobian,
      call_forward_jacobian, take_forward_jacobian_results, numbers_forward_jacobian,
      { { 0, 0xdfe39b4bu, 32 }, { 0, 0xd55b560cu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x1215a894u },
    { "coupled_jacobian", sizeof results.coupled_jacobian,
      call_coupled_jacobian, take_coupled_jacobian_results, numbers_coupled_jacobian,
      { { 0, 0xe5dc403au, 32 }, { 0, 0x9540b84du, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xc57da0fau },
    { "inverse", sizeof results.inverse,
      call_inverse, take_inverse_results, numbers_inverse,
      { { 0, 0x2cb9b686u, 27 }, { 0, 0xb8a1c67au, 27 }, { -2, 0x8e5b0aa0u, 0 } },
      0x1059f024u },
    { "inverse_fast", sizeof results.inverse_fast,
      call_inverse_fast, take_inverse_fast_results, numbers_inverse_fast,
      { { 0, 0x1c02a2ebu, 8 }, { 0, 0x74daa176u, 8 }, { -2, 0x8e5b0aa0u, 0 } },
      0x5366616eu },
    { "quaternion", sizeof results.quaternion,
      call_quaternion, take_quaternion_results, numbers_quaternion,
      { { 0, 0xd092c698u, 4 }, { 0, 0xf04ee43fu, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0x6a4d98b1u },
    { "state_from_coordinates", sizeof results.state_from_coordinates,
      call_state_from_coordinates, take_state_from_coordinates_results, numbers_state_from_coordinates,
      { { 0, 0x3ce9e1b0u, 32 }, { 0, 0x928d5fd1u, 32 }, { -2, 0xe320b71fu, 29 } },
      0x5c782a24u },
    { "generalized", sizeof results.generalized,
      call_generalized, take_generalized_results, numbers_generalized,
      { { 0, 0x2a2529cau, 32 }, { 0, 0x6d5cb4c6u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x396a9493u },
    { "prepare", sizeof results.prepare,
      call_prepare, take_prepare_results, numbers_prepare,
      { { 0, 0xc9e9b1ebu, 32 }, { 0, 0x8627064eu, 32 }, { -2, 0x665c825cu, 32 } },
      0x9f868488u },
    { "mounts", sizeof results.mounts,
      call_mounts, take_mounts_results, numbers_mounts,
      { { 0, 0xfd9cf69du, 32 }, { 0, 0x57feaa5cu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xfd0382bbu },
    { "prepare_mounts", sizeof results.prepare_mounts,
      call_prepare_mounts, take_prepare_mounts_results, numbers_prepare_mounts,
      { { 0, 0x404ca99eu, 32 }, { 0, 0x1c9b6ff9u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xb1bcd456u },
    { "center_of_mass_velocity", sizeof results.center_of_mass_velocity,
      call_center_of_mass_velocity, take_center_of_mass_velocity_results, numbers_center_of_mass_velocity,
      { { 0, 0x57ad3805u, 3 }, { 0, 0xfb894f38u, 3 }, { -2, 0x8e5b0aa0u, 0 } },
      0xa35aa92bu },
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

/* 24 bits as a real in [-largest, largest). */
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

/* The square of a quaternion of integers, by its length: a unit quaternion, of twice the length if refused. */
static void draw_attitude(uint32_t *seed, bench8_real attitude[4], int refused)
{
    const uint32_t word = draw_word(seed);
    const int32_t a = 2 * (int32_t)(word >> 25) - 127;  /* odd: not all are 0 */
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

/* A constant that even light flywheels in strong laws of damping can take. */
static bench8_real draw_step(const uint32_t *seed)
{
    (void)seed;
    return 0x1p-14;
}

static bench8_real draw_factor(uint32_t *seed, bench8_real largest)
{
    return 1.0 + draw_real(seed, largest);
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
    in.mass_factor = draw_factor(seed, 0.125);
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

/* Calls one function and takes its results. */
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
    f->take(sum, found);
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

/* The golden vectors of one function; not 0 if it failed. */
static int judge(const function *f, uint32_t swept, void (*print)(const char *text))
{
    const bench8_real *numbers = f->numbers;
    real_bits worst = 0u;
    uint32_t wrong = 0u;
    for (int i = 0; i < CASES; ++i) {
        const answer *expected = &f->answers[i];
        tally sum;
        int status;
        in = golden[i];
        scale_parameters();
        begin(&sum);
        sum.expected = numbers;
        sum.left = expected->listed;
        call(f, &sum, &status);
        numbers += expected->listed;
        worst = sum.worst > worst ? sum.worst : worst;
        if (status != expected->status || sum.hash != expected->hash || sum.worst != 0u || sum.touched != 0) {
            wrong = wrong + 1u;
        }
    }
    if (swept != f->swept) {
        wrong = wrong + 1u;
    }
    add_text(f->name);
    add_text(wrong == 0u ? " PASS cases " : " FAIL cases ");
    add_decimal((uint64_t)CASES + 1u);
    if (wrong != 0u) {
        add_text(" wrong ");
        add_decimal(wrong);
    }
    add_text(worst > FAR ? " worst more than " : " worst ");
    add_decimal(worst > FAR ? FAR : worst);
    add_text(" ulp");
    end_line(print);
    return wrong != 0u ? 1 : 0;
}

static tally sums[FUNCTIONS];

/* Hashes of every function over so many states. */
static void run_sweep(unsigned long states)
{
    uint32_t seed = 0x6d61686fu;
    for (int i = 0; i < FUNCTIONS; ++i) {
        begin(&sums[i]);
    }
    for (unsigned long state = 0u; state < states; ++state) {
        draw_inputs(&seed, state);
        scale_parameters();
        for (int i = 0; i < FUNCTIONS; ++i) {
            int status;
            call(&functions[i], &sums[i], &status);
        }
    }
}

/* Runs everything and prints it, a line a call of `print`; returns the number of functions that failed. */
int bench8_selftest(void (*print)(const char *text), unsigned long sweep)
{
    int failures = 0;
    length = 0u;
    (void)bench8_prepare_mounts(&bench8_default_parameters, &mounting);
    add_text("mahovik selftest bench8 structure 309d41a6 physics 139422e0 real double");
    end_line(print);
    add_text("generator mahovik 0.1.0");
    end_line(print);
    run_sweep((unsigned long)SWEPT);
    for (int i = 0; i < FUNCTIONS; ++i) {
        failures += judge(&functions[i], sums[i].hash, print);
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

#ifndef BENCH8_SELFTEST_NO_MAIN
static void print_text(const char *text)
{
    (void)fputs(text, stdout);
}

int main(void)
{
    return bench8_selftest(print_text, BENCH8_SELFTEST_SWEEP) != 0;
}
#endif
