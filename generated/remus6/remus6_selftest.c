/* remus6_selftest.c: does remus6.c give the right bits on this machine?
 * mahovik 0.1.0; structure 3687deee, physics 5f25aea2. Generated: change the stand file instead.
 *
 * Compile it with remus6.c as firmware is compiled (-std=c99 -ffp-contract=off; -fno-tree-vectorize as well by gcc
 * for x86-64 with FMA and for a Cortex-M55, or bits differ) and run it; on a board, define
 * REMUS6_SELFTEST_NO_MAIN and call remus6_selftest with what prints a text, such as to a serial port.
 * Golden vectors: inputs and answers of the generator's interpreter as hexadecimal constants; each bit must agree.
 * Sweep: states that an integer generator makes here; a hash of all answers a function is printed, to be
 * compared between machines. The log of a board is judged by `mahovik judge-log LOG STAND.toml`. It reads:
 *
 *     mahovik selftest remus6 structure 3687deee physics 5f25aea2 real double
 *     generator mahovik 0.1.0
 *     forward PASS cases 4 worst 0 ulp      a line a function; or FAIL, and how many cases are wrong
 *                                        (a distance above 1000000 ulp: worst more than 1000000 ulp)
 *     sweep 100                          states
 *     forward 0123abcd                   a line a function: FNV-1a of its statuses and outputs
 *     failures 0                         functions that failed; the last line
 *
 * No allocation. It keeps inputs and results in static memory: one caller at a time. */
#include "remus6.h"

#include <stddef.h>
#include <stdint.h>
#ifndef REMUS6_SELFTEST_NO_MAIN
#include <stdio.h>
#endif

#if REMUS6_STRUCTURE != 0x3687deeeu || REMUS6_PHYSICS != 0x5f25aea2u
#error "remus6.h and remus6_selftest.c are of different stands"
#endif
#if REMUS6_LANES != 1
#error "remus6.h and remus6_selftest.c were generated for different numbers of lanes"
#endif

#ifndef REMUS6_SELFTEST_SWEEP
#define REMUS6_SELFTEST_SWEEP 100ul  /* states of the sweep that main runs */
#endif

int remus6_selftest(void (*print)(const char *text), unsigned long sweep);

typedef uint64_t real_bits;

enum { CASES = 3, FUNCTIONS = 24, SWEPT = 1 };

#define FAR ((real_bits)1000000u)  /* ulp: a worse distance is not printed as a number */

/* ---- inputs and results ---- */

/* What the functions take beside the stand's own constants. */
typedef struct inputs {
    remus6_state x;
    remus6_real phi_ddot[REMUS6_N];
    remus6_real V_dot[6];
    remus6_real tau[REMUS6_N];
    int locked[REMUS6_N];
    remus6_real dt;
    int order;
    remus6_real phi;
    int count;
    int per_turn;
    remus6_real zero;
    int moved;
    remus6_encoder encoder;
    int counter;
    int bits;
    remus6_real angles[3];
    remus6_real position[3];
    remus6_real q_dot[6];
    remus6_real q_ddot[6];
    remus6_real mass_factor;  /* of all masses and inertias of the parameters */
} inputs;

static inputs in;
static remus6_parameters parameters;
static remus6_mount_table mounting;

static union {
    struct { remus6_real V_dot[6]; } forward;
    struct { remus6_real F[6]; } wrench;
    struct { remus6_matrices_result out; } matrices;
    struct { remus6_momentum_result out; } momentum;
    struct { remus6_real tau[REMUS6_N]; } torque;
    struct { remus6_real V_dot[6]; remus6_real phi_ddot[REMUS6_N]; } coupled;
    struct { remus6_state next; } step;
    struct { remus6_state next; } step_driven;
    struct { remus6_real wrapped; } wrap;
    struct { remus6_real phi; } phase_of_counts;
    struct { remus6_real phi_dot; } speed_of_counts;
    struct { remus6_encoder encoder; } accumulate;
    struct { remus6_forward_jacobian_result out; } forward_jacobian;
    struct { remus6_coupled_jacobian_result out; } coupled_jacobian;
    struct { remus6_inverse_result out; } inverse;
    struct { remus6_real phi_ddot[REMUS6_N]; } inverse_fast;
    struct { remus6_points_result out[REMUS6_SENSORS]; } points;
    struct { remus6_real attitude[4]; } quaternion;
    struct { remus6_state x; remus6_real V_dot[6]; } state_from_coordinates;
    struct { remus6_generalized_result out; } generalized;
    struct { remus6_table table; } prepare;
    struct { remus6_real mount_wrench[36]; } mounts;
    struct { remus6_mount_table mounting; } prepare_mounts;
    struct { remus6_real center_of_mass_velocity[3]; } center_of_mass_velocity;
    unsigned char bytes[1];
} results;

enum { UNTOUCHED = 0x5a };  /* what every byte of the results holds before a call */

/* ---- taking results: their hash, and how far they are from what is expected ---- */

typedef struct tally {
    uint32_t hash;                /* FNV-1a of all bits taken so far, the lowest byte of a number first */
    const remus6_real *expected;  /* next numbers that are expected, `left` of them */
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

static real_bits bits_of(remus6_real value)
{
    union { remus6_real real; real_bits word; } both;
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

static void take_reals(tally *sum, const remus6_real *values, int count)
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

static void take_matrices_result(tally *sum, const remus6_matrices_result *value)
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
        take_reals(sum, value->I[i], REMUS6_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->J[i], REMUS6_N);
    }
    take_reals(sum, value->F, 6);
}

static void take_momentum_result(tally *sum, const remus6_momentum_result *value)
{
    take_reals(sum, value->Z, 6);
    take_reals(sum, value->Z0, 6);
    take_reals(sum, &value->energy, 1);
    take_reals(sum, value->center_of_mass, 3);
}

static void take_state(tally *sum, const remus6_state *value)
{
    take_reals(sum, value->position, 3);
    take_reals(sum, value->attitude, 4);
    take_reals(sum, value->V, 6);
    take_reals(sum, value->phi, REMUS6_N);
    take_reals(sum, value->phi_dot, REMUS6_N);
}

static void take_encoder(tally *sum, const remus6_encoder *value)
{
    take_ints(sum, &value->counter, 1);
    take_ints(sum, &value->place, 1);
    take_ints(sum, &value->moved, 1);
}

static void take_forward_jacobian_result(tally *sum, const remus6_forward_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], REMUS6_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], REMUS6_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_ddot[i], REMUS6_N);
    }
}

static void take_coupled_jacobian_result(tally *sum, const remus6_coupled_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], REMUS6_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], REMUS6_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_tau[i], REMUS6_N);
    }
    for (int i = 0; i < REMUS6_N; ++i) {
        take_reals(sum, value->phi_ddot_V[i], 6);
    }
    for (int i = 0; i < REMUS6_N; ++i) {
        take_reals(sum, value->phi_ddot_phi[i], REMUS6_N);
    }
    for (int i = 0; i < REMUS6_N; ++i) {
        take_reals(sum, value->phi_ddot_phi_dot[i], REMUS6_N);
    }
    for (int i = 0; i < REMUS6_N; ++i) {
        take_reals(sum, value->phi_ddot_tau[i], REMUS6_N);
    }
}

static void take_inverse_result(tally *sum, const remus6_inverse_result *value)
{
    take_reals(sum, value->phi_ddot, REMUS6_N);
    take_reals(sum, value->residual, 6);
    take_reals(sum, value->sigma, 6);
    take_ints(sum, &value->rank, 1);
    take_reals(sum, &value->damped_by, 1);
    take_ints(sum, value->limited, REMUS6_N);
    take_reals(sum, value->hardest, 6);
}

static void take_points_result(tally *sum, const remus6_points_result *value)
{
    take_reals(sum, value->position, 3);
    for (int i = 0; i < 3; ++i) {
        take_reals(sum, value->C[i], 3);
    }
    take_reals(sum, value->twist, 6);
    take_reals(sum, value->specific_force, 3);
    take_reals(sum, value->angular_acceleration, 3);
}

static void take_generalized_result(tally *sum, const remus6_generalized_result *value)
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

static void take_row(tally *sum, const remus6_row *value)
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

static void take_sensor(tally *sum, const remus6_sensor *value)
{
    take_reals(sum, value->origin, 3);
    take_reals(sum, value->axes, 9);
}

static void take_damper(tally *sum, const remus6_damper *value)
{
    take_ints(sum, &value->first_term, 1);
    take_ints(sum, &value->last_term, 1);
}

static void take_term(tally *sum, const remus6_term *value)
{
    take_ints(sum, &value->wrench, 1);
    take_ints(sum, &value->first, 1);
    take_ints(sum, &value->second, 1);
    take_reals(sum, &value->value, 1);
}

static void take_table(tally *sum, const remus6_table *value)
{
    take_reals(sum, &value->mass, 1);
    take_reals(sum, &value->mass_inverse, 1);
    take_reals(sum, value->first_moment, 3);
    take_reals(sum, value->inertia, 6);
    take_reals(sum, value->A, 6);
    take_reals(sum, value->A_inv, 6);
    take_reals(sum, value->G, 9);
    take_reals(sum, &value->weight_mass, 1);
    take_reals(sum, value->displaced_moment, 3);
    for (int i = 0; i < REMUS6_N; ++i) {
        take_row(sum, &value->flywheel[i]);
    }
    for (int i = 0; i < REMUS6_SENSORS; ++i) {
        take_sensor(sum, &value->sensor[i]);
    }
    take_reals(sum, value->gravity, 3);
    take_reals(sum, value->stream, 3);
    take_damper(sum, &value->damper);
    for (int i = 0; i < 10; ++i) {
        take_term(sum, &value->term[i]);
    }
}

static void take_mount(tally *sum, const remus6_mount *value)
{
    take_reals(sum, &value->mass, 1);
    take_reals(sum, value->first_moment, 3);
    take_reals(sum, value->inertia, 6);
    take_reals(sum, value->origin, 3);
    take_reals(sum, value->axes, 9);
}

static void take_mount_table(tally *sum, const remus6_mount_table *value)
{
    for (int i = 0; i < REMUS6_N; ++i) {
        take_mount(sum, &value->flywheel[i]);
    }
}

/* ---- every function: called with the inputs; its results taken ---- */

static remus6_status call_forward(void)
{
    return remus6_forward(&remus6_default, &in.x, in.phi_ddot, results.forward.V_dot);
}

static void take_forward_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.forward.V_dot, sizeof results.forward.V_dot);
        return;
    }
    take_reals(sum, results.forward.V_dot, 6);
}

static remus6_status call_wrench(void)
{
    return remus6_wrench(&remus6_default, &in.x, results.wrench.F);
}

static void take_wrench_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.wrench.F, sizeof results.wrench.F);
        return;
    }
    take_reals(sum, results.wrench.F, 6);
}

static remus6_status call_matrices(void)
{
    return remus6_matrices(&remus6_default, &in.x, &results.matrices.out);
}

static void take_matrices_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.matrices.out, sizeof results.matrices.out);
        return;
    }
    take_matrices_result(sum, &results.matrices.out);
}

static remus6_status call_momentum(void)
{
    return remus6_momentum(&remus6_default, &in.x, &results.momentum.out);
}

static void take_momentum_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.momentum.out, sizeof results.momentum.out);
        return;
    }
    take_momentum_result(sum, &results.momentum.out);
}

static remus6_status call_torque(void)
{
    return remus6_torque(&remus6_default, &in.x, in.V_dot, in.phi_ddot, results.torque.tau);
}

static void take_torque_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.torque.tau, sizeof results.torque.tau);
        return;
    }
    take_reals(sum, results.torque.tau, REMUS6_N);
}

static remus6_status call_coupled(void)
{
    return remus6_coupled(&remus6_default, &in.x, in.tau, in.locked, results.coupled.V_dot,
        results.coupled.phi_ddot);
}

static void take_coupled_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.coupled.V_dot, sizeof results.coupled.V_dot);
        untouched(sum, &results.coupled.phi_ddot, sizeof results.coupled.phi_ddot);
        return;
    }
    take_reals(sum, results.coupled.V_dot, 6);
    take_reals(sum, results.coupled.phi_ddot, REMUS6_N);
}

static remus6_status call_step(void)
{
    return remus6_step(&remus6_default, &in.x, in.tau, in.locked, in.dt, in.order, &results.step.next);
}

static void take_step_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.step.next, sizeof results.step.next);
        return;
    }
    take_state(sum, &results.step.next);
}

static remus6_status call_step_driven(void)
{
    return remus6_step_driven(&remus6_default, &in.x, in.phi_ddot, in.dt, in.order,
        &results.step_driven.next);
}

static void take_step_driven_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.step_driven.next, sizeof results.step_driven.next);
        return;
    }
    take_state(sum, &results.step_driven.next);
}

static remus6_status call_wrap(void)
{
    return remus6_wrap(in.phi, &results.wrap.wrapped);
}

static void take_wrap_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.wrap.wrapped, sizeof results.wrap.wrapped);
        return;
    }
    take_reals(sum, &results.wrap.wrapped, 1);
}

static remus6_status call_phase_of_counts(void)
{
    return remus6_phase_of_counts(in.count, in.per_turn, in.zero, &results.phase_of_counts.phi);
}

static void take_phase_of_counts_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.phase_of_counts.phi, sizeof results.phase_of_counts.phi);
        return;
    }
    take_reals(sum, &results.phase_of_counts.phi, 1);
}

static remus6_status call_speed_of_counts(void)
{
    return remus6_speed_of_counts(in.moved, in.per_turn, in.dt, &results.speed_of_counts.phi_dot);
}

static void take_speed_of_counts_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.speed_of_counts.phi_dot, sizeof results.speed_of_counts.phi_dot);
        return;
    }
    take_reals(sum, &results.speed_of_counts.phi_dot, 1);
}

static remus6_status call_accumulate(void)
{
    results.accumulate.encoder = in.encoder;
    return remus6_accumulate(&results.accumulate.encoder, in.counter, in.bits, in.per_turn);
}

static void take_accumulate_results(tally *sum, remus6_status status)
{
    (void)status;
    take_encoder(sum, &results.accumulate.encoder);
}

static remus6_status call_forward_jacobian(void)
{
    return remus6_forward_jacobian(&remus6_default, &in.x, in.phi_ddot, &results.forward_jacobian.out);
}

static void take_forward_jacobian_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.forward_jacobian.out, sizeof results.forward_jacobian.out);
        return;
    }
    take_forward_jacobian_result(sum, &results.forward_jacobian.out);
}

static remus6_status call_coupled_jacobian(void)
{
    return remus6_coupled_jacobian(&remus6_default, &in.x, in.tau, in.locked, &results.coupled_jacobian.out);
}

static void take_coupled_jacobian_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.coupled_jacobian.out, sizeof results.coupled_jacobian.out);
        return;
    }
    take_coupled_jacobian_result(sum, &results.coupled_jacobian.out);
}

static remus6_status call_inverse(void)
{
    return remus6_inverse(&remus6_default, &in.x, in.V_dot, &remus6_default_options, &results.inverse.out);
}

static void take_inverse_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.inverse.out, sizeof results.inverse.out);
        return;
    }
    take_inverse_result(sum, &results.inverse.out);
}

static remus6_status call_inverse_fast(void)
{
    return remus6_inverse_fast(&remus6_default, &in.x, in.V_dot, &remus6_default_options,
        results.inverse_fast.phi_ddot);
}

static void take_inverse_fast_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.inverse_fast.phi_ddot, sizeof results.inverse_fast.phi_ddot);
        return;
    }
    take_reals(sum, results.inverse_fast.phi_ddot, REMUS6_N);
}

static remus6_status call_points(void)
{
    return remus6_points(&remus6_default, &in.x, in.V_dot, results.points.out);
}

static void take_points_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.points.out, sizeof results.points.out);
        return;
    }
    for (int i = 0; i < REMUS6_SENSORS; ++i) {
        take_points_result(sum, &results.points.out[i]);
    }
}

static remus6_status call_quaternion(void)
{
    return remus6_quaternion(in.angles, results.quaternion.attitude);
}

static void take_quaternion_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.quaternion.attitude, sizeof results.quaternion.attitude);
        return;
    }
    take_reals(sum, results.quaternion.attitude, 4);
}

static remus6_status call_state_from_coordinates(void)
{
    results.state_from_coordinates.x = in.x;
    return remus6_state_from_coordinates(in.position, in.angles, in.q_dot, in.q_ddot,
        &results.state_from_coordinates.x, results.state_from_coordinates.V_dot);
}

static void take_state_from_coordinates_results(tally *sum, remus6_status status)
{
    take_state(sum, &results.state_from_coordinates.x);
    if (status < 0) {
        untouched(sum, &results.state_from_coordinates.V_dot, sizeof results.state_from_coordinates.V_dot);
        return;
    }
    take_reals(sum, results.state_from_coordinates.V_dot, 6);
}

static remus6_status call_generalized(void)
{
    return remus6_generalized(&remus6_default, &in.x, in.angles, in.phi_ddot, &results.generalized.out);
}

static void take_generalized_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.generalized.out, sizeof results.generalized.out);
        return;
    }
    take_generalized_result(sum, &results.generalized.out);
}

static remus6_status call_prepare(void)
{
    results.prepare.table = remus6_default;
    return remus6_prepare(&parameters, &results.prepare.table);
}

static void take_prepare_results(tally *sum, remus6_status status)
{
    (void)status;
    take_table(sum, &results.prepare.table);
}

static remus6_status call_mounts(void)
{
    return remus6_mounts(&remus6_default, &mounting, &in.x, in.V_dot, in.phi_ddot,
        results.mounts.mount_wrench);
}

static void take_mounts_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.mounts.mount_wrench, sizeof results.mounts.mount_wrench);
        return;
    }
    take_reals(sum, results.mounts.mount_wrench, 36);
}

static remus6_status call_prepare_mounts(void)
{
    return remus6_prepare_mounts(&parameters, &results.prepare_mounts.mounting);
}

static void take_prepare_mounts_results(tally *sum, remus6_status status)
{
    if (status < 0) {
        untouched(sum, &results.prepare_mounts.mounting, sizeof results.prepare_mounts.mounting);
        return;
    }
    take_mount_table(sum, &results.prepare_mounts.mounting);
}

static remus6_status call_center_of_mass_velocity(void)
{
    return remus6_center_of_mass_velocity(&remus6_default, &in.x,
        results.center_of_mass_velocity.center_of_mass_velocity);
}

static void take_center_of_mass_velocity_results(tally *sum, remus6_status status)
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
                -0x1.e0f5dp+2 },
            .phi_dot = { -0x1.c61c58p+7, -0x1.3c48p+4, -0x1.c4d59p+7, 0x1.d79d24p+7, 0x1.3513p+3,
                0x1.29b748p+6 },
        },
        .phi_ddot = { -0x1.94148p+4, -0x1.f4583p+8, 0x1.9e47c8p+7, -0x1.39c4f8p+8, 0x1.44d50cp+8,
            -0x1.7d815p+7 },
        .V_dot = { 0x1.e558ecp+3, 0x1.edaa68p+3, 0x1.656c1p+2, 0x1.e86b8p-2, 0x1.eac5dp+2, 0x1.a2918cp+3 },
        .tau = { 0x1.f50954p+0, -0x1.bac6b8p-1, -0x1.8dc0ep+0, -0x1.538698p-1, 0x1.a1b0cp-1, 0x1.35f84p-2 },
        .locked = { 1, 0, 1, 0, 0, 0 },
        .dt = 0x1p-14,
        .order = 4,
        .phi = 0x1.f9388cp+3,
        .count = -710181,
        .per_turn = 4091,
        .zero = 0x1.e7f3ap-3,
        .moved = -3,
        .encoder = {
            .counter = 6269,
            .place = 2468,
            .moved = 271,
        },
        .counter = 10088,
        .bits = 16,
        .angles = { -0x1.51bd7p-3, -0x1.ace304p-1, 0x1.76eb1p-3 },
        .position = { -0x1.5944dp-2, 0x1.f3e8ep-2, 0x1.35894p-2 },
        .q_dot = { 0x1.d3fc6p-1, -0x1.23b5c4p+0, 0x1.cf1ac8p-1, 0x1.30188p-3, 0x1.942a08p-1, -0x1.92f53p-1 },
        .q_ddot = { 0x1.c0d28p+2, 0x1.9f33ep+2, 0x1.c06e04p+3, 0x1.6815p-1, -0x1.7e8e7p+1, 0x1.bc58ep+3 },
        .mass_factor = 0x1.d4ebaap-1,
    },
    {   /* fast flywheels, large phases */
        .x = {
            .position = { 0x1.554cc8p-1, 0x1.55fcep-1, -0x1.9f3ap-6 },
            .attitude = { -0x1.78138b6971accp-1, -0x1.ffb66ba035ee3p-4, 0x1.6a768c3c26336p-4,
                -0x1.5279ff30a3ac4p-1 },
            .V = { 0x1.0a9aap-1, -0x1.9c2068p+1, -0x1.9ed4ep-1, -0x1.085ab8p+1, 0x1.968a6p+1, 0x1.cdc694p+2 },
            .phi = { -0x1.0249c8p+22, -0x1.371e7p+21, -0x1.214c38p+22, 0x1.4171bp+20, 0x1.82ebap+20,
                0x1.0b38ap+21 },
            .phi_dot = { -0x1.055d68p+13, -0x1.8f2aap+11, -0x1.763e6p+10, -0x1.df9aep+13, -0x1.f8caa4p+13,
                0x1.3b88ccp+13 },
        },
        .phi_ddot = { 0x1.8fd1ep+6, -0x1.0659ap+7, -0x1.b2c408p+8, -0x1.0c99cp+7, -0x1.5e586p+8,
            0x1.d5b01p+7 },
        .V_dot = { -0x1.6b39ap+5, 0x1.499108p+5, -0x1.859fdp+5, 0x1.fdeeap+5, 0x1.1fb6fp+5, -0x1.2794p-2 },
        .tau = { 0x1.33ded8p+0, -0x1.4256p-7, -0x1.923cb8p+0, -0x1.67826p+0, 0x1.512658p-1, -0x1.3b3c18p-1 },
        .locked = { 0, 1, 0, 0, 0, 1 },
        .dt = 0x1p-14,
        .order = 2,
        .phi = 0x1.037d6p+21,
        .count = 15181,
        .per_turn = 4095,
        .zero = 0x1.56ea88p-1,
        .moved = 193,
        .encoder = {
            .counter = -1819,
            .place = 1720,
            .moved = 153,
        },
        .counter = -26408,
        .bits = 16,
        .angles = { 0x1.598328p-2, -0x1.466428p-2, -0x1.3db6a8p-1 },
        .position = { -0x1.3d4554p+0, -0x1.07562p-1, 0x1.a063e4p+0 },
        .q_dot = { -0x1.bdbb3p+0, 0x1.d98bf4p+0, 0x1.3c586p-2, -0x1.ed3ccp-1, 0x1.297088p-1, 0x1.c53fp-4 },
        .q_ddot = { -0x1.d0ae24p+3, -0x1.70a96cp+3, -0x1.49e8p-1, 0x1.70ed48p+2, -0x1.52138p-2,
            0x1.26f56p+3 },
        .mass_factor = 0x1.dae932p-1,
    },
    {   /* out of range */
        .x = {
            .position = { -0x1.7a5978p+39, 0x1.8ab58p+38, 0x1.b0decp+36 },
            .attitude = { -0x1.a64a207452298p-1, 0x1.368f6b1ecd55fp-2, -0x1.d84f72e982f2bp-1,
                -0x1.8aab9821cf9d3p+0 },
            .V = { 0x1.a35e68p-1, -0x1.16ceep-3, 0x1.63ddcp-3, 0x1.e05b2p-3, -0x1.68bbep-1, -0x1.cbd33cp+0 },
            .phi = { -0x1.c483b8p+43, -0x1.ed35p+38, -0x1.bdd86p+43, 0x1.f8f3ep+41, -0x1.ca174p+40,
                0x1.bc5528p+42 },
            .phi_dot = { 0x1.67f6p+3, 0x1.7f7ed8p+6, 0x1.1db6ap+7, -0x1.046708p+7, 0x1.7c0718p+7,
                -0x1.8e30bp+7 },
        },
        .phi_ddot = { 0x1.c57048p+7, -0x1.b7cac8p+7, -0x1.74596p+8, 0x1.a5f084p+8, 0x1.107154p+8,
            0x1.9703bp+6 },
        .V_dot = { -0x1.0a47f8p+2, -0x1.3b6cap+1, -0x1.997158p+3, 0x1.caa508p+3, 0x1.64ac8p-1,
            0x1.49a318p+2 },
        .tau = { 0x1.c85dp-3, 0x1.c55c48p-1, 0x1.ebfa1p+0, -0x1.afa2dp-2, -0x1.3dbc3cp+0, 0x1.e6041p+0 },
        .locked = { 0, 0, 1, 0, 1, 0 },
        .dt = 0x0p+0,
        .order = 2,
        .phi = -0x1.8ed23cp+43,
        .count = -963156,
        .per_turn = 0,
        .zero = 0x1.f09e08p+38,
        .moved = -395,
        .encoder = {
            .counter = 28157,
            .place = 3128,
            .moved = -210,
        },
        .counter = 28810,
        .bits = 16,
        .angles = { -0x1.e1ea1p+38, 0x1.43f77p+37, -0x1.7eaadp+39 },
        .position = { 0x1.9d9098p+39, 0x1.2190ap+40, 0x1.881898p+40 },
        .q_dot = { 0x1.f82364p+0, -0x1.f67078p-1, 0x1.ef22p-2, 0x1.9d4d4p-4, -0x1.125cp+0, -0x1.02414p-3 },
        .q_ddot = { 0x1.bf9368p+3, 0x1.82c238p+3, 0x1.7c810cp+3, -0x1.0c3e8p+3, -0x1.482048p+3,
            0x1.504548p+3 },
        .mass_factor = -0x1.db704e8p-1,
    },
};

typedef struct answer {
    int status;
    uint32_t hash;  /* of the status and all outputs */
    int listed;     /* outputs whose numbers are given, at most 32 */
} answer;

static const remus6_real numbers_forward[] =
{
    0x1.c909c8b922322p+0, -0x1.2683c46877af1p+6, -0x1.2bb77d5c0069dp+2, -0x1.81500d0b80d0ep+7,
        -0x1.5b73d4b5b0f7fp-1, -0x1.40699ec6bf47ap+5,
    0x1.9a9282126b2c1p+6, 0x1.ce2a3551057b6p+6, -0x1.13c66a74f821bp+8, 0x1.59cfcb978fb39p+8,
        -0x1.7c32045ac9de7p+10, -0x1.0135d7412f933p+5,
};

static const remus6_real numbers_wrench[] =
{
    -0x1.0d3be3db8aedap+3, -0x1.2781a9e277dabp+12, -0x1.bfc1ff764b094p+6, -0x1.032e290981da7p+2,
        -0x1.185c0b14043e3p+6, -0x1.33289b8bd508dp+6,
    -0x1.407f0f2b113c4p+1, 0x1.a966b4d95a768p+13, 0x1.23d0352a83f8fp+6, 0x1.4a102032153c8p-3,
        -0x1.da34ec4bd3e57p+10, -0x1.2fca68802789fp+12,
};

static const remus6_real numbers_matrices[] =
{
    0x1.f68f5c28f5c29p+4, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.31f6456b1a65cp-1, 0x1.5c999b52447ecp-11, 0x0p+0,
        0x1.07eb851eb851fp+6, 0x0p+0, -0x1.31f6456b1a65cp-1, 0x0p+0, -0x1.ee143310c6fe4p+0, 0x0p+0, 0x0p+0,
        0x1.07eb851eb851fp+6, -0x1.5c999b52447ecp-11, 0x1.ee143310c6fe4p+0, 0x0p+0, 0x0p+0,
        -0x1.31f6456b1a65cp-1, -0x1.5c999b52447ecp-11, 0x1.fab033c920266p-3, 0x1.8a8c07a072ccbp-14,
        0x1.1b1d319638fa9p-13, 0x1.31f6456b1a65cp-1, 0x0p+0, 0x1.ee143310c6fe4p+0, 0x1.8a8c07a072ccbp-14,
        0x1.0a9144f0c3be1p+3, 0x1.2cb567136080bp-15, 0x1.5c999b52447ecp-11, -0x1.ee143310c6fe4p+0,
    0x1.f68f5c28f5c29p+4, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.31e5adfea05aap-1, 0x1.7f407ec40fe18p-12, 0x0p+0,
        0x1.07eb851eb851fp+6, 0x0p+0, -0x1.31e5adfea05aap-1, 0x0p+0, -0x1.ee0cdbe117a25p+0, 0x0p+0, 0x0p+0,
        0x1.07eb851eb851fp+6, -0x1.7f407ec40fe18p-12, 0x1.ee0cdbe117a25p+0, 0x0p+0, 0x0p+0,
        -0x1.31e5adfea05aap-1, -0x1.7f407ec40fe18p-12, 0x1.faaa3b5dd09e9p-3, 0x1.a81d00cbcca4dp-14,
        -0x1.31b4dfce53d2dp-14, 0x1.31e5adfea05aap-1, 0x0p+0, 0x1.ee0cdbe117a25p+0, 0x1.a81d00cbcca4dp-14,
        0x1.0a8f885c42b34p+3, 0x1.c18b2a4894a34p-17, 0x1.7f407ec40fe18p-12, -0x1.ee0cdbe117a25p+0,
};

static const remus6_real numbers_momentum[] =
{
    0x1.93febe69a1267p+5, 0x1.e9ed4c5d7bf18p+6, 0x1.e95a24d783e1cp+5, -0x1.482a7c86091b4p-1,
        0x1.fd2b5b101fac2p+2, 0x1.a5a9063063bb5p+1, 0x1.774b13663af54p+5, 0x1.758fd5cff6309p+4,
        0x1.10616ed7b2b78p+7, 0x1.a5fac55614549p+7, 0x1.927252d7020a4p+6, -0x1.461cdf76ba24ep+6,
        0x1.8fe4b2a58d2b4p+7, 0x1.2d9542b730807p-23, -0x1.6dfbf9be84622p-16, 0x1.41384e4168fbfp-6,
    0x1.e577fe8d2eb34p+3, -0x1.cacdec248ce44p+7, -0x1.89d1e8e294471p+5, 0x1.77e124a6033d8p-2,
        0x1.7f76a0c4677b6p+4, 0x1.fd66adc00130ep+5, 0x1.c79a589c6e783p+7, 0x1.ddc2df1a45deap+2,
        -0x1.cd9fc57adf041p+5, -0x1.df06480f6eca4p+5, 0x1.02c7631478cd9p+4, -0x1.5328921abadccp+6,
        0x1.940be5474b624p+15, 0x1.00096e73c52dp-18, -0x1.925d3e894dd13p-17, 0x1.4126e3049ae99p-6,
};

static const remus6_real numbers_torque[] =
{
    -0x1.1665f6604fc6ep-10, -0x1.2620a30d45a4bp-4, 0x1.24d34aba9a5dap-5, -0x1.7051763f7f778p-5,
        0x1.a009b9e8a601ap-5, -0x1.9912b305fbc79p-6,
    0x1.220abb6c0d7cdp-6, -0x1.aa34c672e84dap-7, -0x1.a393f47c83ffp-5, -0x1.9dd86eed31d41p-6,
        -0x1.74aa354b458b3p-5, 0x1.1e72ffc81792p-5,
};

static const remus6_real numbers_coupled[] =
{
    0x1.d678bba07e73bp+0, -0x1.26c8ef13b211fp+6, -0x1.2b2b5e5914186p+2, -0x1.8a1b2256a489bp+7,
        -0x1.2e83a7841005ap-1, -0x1.406fc0ee1aa1ap+5, 0x0p+0, -0x1.67d24fc4abbd6p+12, 0x0p+0,
        -0x1.14b308c8647b6p+12, 0x1.65f654262a4e6p+12, 0x1.1f9bb187cc471p+11,
    0x1.9a8e691844c8fp+6, 0x1.ce2e6341a35edp+6, -0x1.13c6a283f0edap+8, 0x1.5739c97b90cbdp+8,
        -0x1.7c3da8ee135c7p+10, -0x1.fcee29fb11c88p+4, 0x1.284d887a3f605p+13, 0x0p+0, -0x1.3cac148930bbdp+13,
        -0x1.34a58bb6dc86ap+13, 0x1.0ad80dec0e3a4p+12, 0x0p+0,
};

static const remus6_real numbers_step[] =
{
    -0x1.779a1b3383d18p-1, 0x1.80b85a36d2656p+0, -0x1.10f69a073ee03p-4, 0x1.23d5bb0f7d42p-1,
        -0x1.2f86f9a44722bp-5, -0x1.fa5efd5adde9fp-2, -0x1.4f6e344b0297p-1, 0x1.98d5045966f6bp+0,
        0x1.e5012cbe6e1ebp+0, 0x1.d1040358c7d17p-1, 0x1.f0dd3efe2f2efp+0, 0x1.462aa743777c7p-1,
        0x1.a992d4e6a0382p-1, -0x1.0bcb746f4b9eep-3, 0x1.48e3c7fa6e9aap+1, -0x1.256c559p+1,
        -0x1.9bd0b5fa53528p-1, -0x1.ebcd00861a031p+0, -0x1.3a2e6bc3c542bp+0, -0x1.c61c58p+7,
        -0x1.41e747f3aeba3p+4, -0x1.c4d59p+7, 0x1.d712cf729eaa2p+7, 0x1.4042622fa3082p+3,
        0x1.2a470aa359213p+6,
    0x1.556691dfd96a9p-1, 0x1.5600635225579p-1, -0x1.a010d9bb5469dp-6, -0x1.7802996439528p-1,
        -0x1.ff2f7b77d8fe6p-4, 0x1.6a754abf1d0a5p-4, -0x1.529006ec2da7ap-1, 0x1.f2e32df28e148p-2,
        -0x1.9dbee9c83b8fbp+1, -0x1.ae00001f519f5p-1, -0x1.df58235c53e97p+0, 0x1.8b2e13c165492p+1,
        0x1.cc3dea38007ecp+2, -0x1.74e2f7f71fae8p-4, -0x1.44c02e94555b4p-5, -0x1.4edab2f4270fcp+0,
        -0x1.227a750ea5b38p+0, -0x1.aa5e22d0c9ed4p+0, 0x1.24fa37ff8d005p+1, -0x1.05586bd43ca68p+13,
        -0x1.8f2aap+11, -0x1.7664007dd6fdep+10, -0x1.df9f3ce6753ebp+13, -0x1.f8c9adf43f318p+13,
        0x1.3b88ccp+13,
};

static const remus6_real numbers_step_driven[] =
{
    -0x1.779a1b324ec4cp-1, 0x1.80b85a37260dep+0, -0x1.10f69a06b75a7p-4, 0x1.23d5bb1075f7ep-1,
        -0x1.2f86f86b13c19p-5, -0x1.fa5efd89c06f4p-2, -0x1.4f6e343993d16p-1, 0x1.98d4ce46d54a8p+0,
        0x1.e50171a515253p+0, 0x1.d103f13d0af4dp-1, 0x1.f0eed4f5dd53p+0, 0x1.4629f361efa37p-1,
        0x1.a992db09b751p-1, -0x1.0bcb7abf9d9eep-3, 0x1.48e41a1d93f9fp+1, -0x1.256c5253707p+1,
        -0x1.9bcfb4ea38f3ep-1, -0x1.ebcda9574113ep+0, -0x1.3a2eb99cf9f9fp+0, -0x1.c61d220a4p+7,
        -0x1.3cc5160cp+4, -0x1.c4cf16e0ep+7, 0x1.d79355d84p+7, 0x1.35b56a86p+3, 0x1.29ab5bf58p+6,
    0x1.556691dfebf2ep-1, 0x1.560063523243fp-1, -0x1.a010d9ba724b5p-6, -0x1.7802996395cedp-1,
        -0x1.ff2f7beba6053p-4, 0x1.6a754a46653d9p-4, -0x1.529006ec2cd4bp-1, 0x1.f2e3fea1e2f4ep-2,
        -0x1.9dbede736ab08p+1, -0x1.adffe518af67p-1, -0x1.df5350254f7f9p+0, 0x1.8b2e679bdeb51p+1,
        0x1.cc3d8e37323a6p+2, -0x1.74f54ad56b528p-4, -0x1.44c0b1c1255b4p-5, -0x1.4ed983de32c69p+0,
        -0x1.2279449b80fcap+0, -0x1.aa5eb32f93e35p+0, 0x1.24fa3baaed205p+1, -0x1.055d5b8171p+13,
        -0x1.8f2ae19668p+11, -0x1.764012c408p+10, -0x1.df9af0c99cp+13, -0x1.f8cacfcb0cp+13,
        0x1.3b88e95b01p+13,
};

static const remus6_real numbers_wrap[] =
{
    -0x1.87dc0f9990e92p+1,
    0x1.71ac48d807bcap-3,
};

static const remus6_real numbers_phase_of_counts[] =
{
    0x1.44ea670a66a78p+1,
    -0x1.d73968ed94cd6p+0,
};

static const remus6_real numbers_speed_of_counts[] =
{
    -0x1.2df624deb7b68p+6,
    0x1.2f3cdb762dc2dp+12,
};

static const remus6_real numbers_accumulate[] =
{
    0.0
};

static const remus6_real numbers_forward_jacobian[] =
{
    -0x1.e89fe01f83772p-3, 0x1.c0bea0df037a3p+0, -0x1.7ee45e3e788cap+0, -0x1.fe43a26fb0d18p-6,
        -0x1.70aeb47a4feabp+0, 0x1.e82f478d28784p+1, -0x1.3e18d938c5fe7p-1, -0x1.378159129b829p+6,
        0x1.f3e786296aec7p+0, 0x1.c7a74c29062ap-1, -0x1.978bf03694f28p-8, -0x1.4ad55ad524346p+0,
        0x1.8408306fd24b6p-3, -0x1.f3f1cdfc36ceep+0, -0x1.ecc1c6e34d08ap+1, -0x1.dc91f021ca4dep+0,
        0x1.992537ba9a9f6p+0, 0x1.7cca22222b108p-8, 0x1.076dc94d33bddp-1, -0x1.782c9aaed79bfp+7,
        -0x1.c3fabc7eadc17p-7, -0x1.0d8021fa8104cp+1, -0x1.468aa75befde2p-5, 0x1.05616574b3be4p-1,
        0x1.f2111f9ed1f6cp+1, -0x1.04ebea78e1e91p-4, 0x1.08c5c63f6055cp+3, 0x1.9c075f8f16fabp-1,
        -0x1.cb68e82af209fp+4, 0x1.c12fb5d7a927bp+0, -0x1.f53abe52232dep+2, -0x1.a1de3fccf5b59p+4,
    0x1.9b64f62ece242p-9, 0x1.e55d3713c3507p+3, -0x1.af9fe44939e4dp+2, -0x1.0c7902e191969p-2,
        0x1.0b951f0b4ce81p+2, -0x1.f67a48edf0d7dp+2, -0x1.75e24e47f2fd7p+1, -0x1.07863ae36e8e4p+7,
        -0x1.085c8c3dfd465p+1, -0x1.c05fe19c32e57p-1, -0x1.991236b2ed25p-8, -0x1.3ea4fa444bbecp+2,
        0x1.9987c7fb2d04ap+0, 0x1.0a432e4c87ccp+1, -0x1.aa10cace2c7e3p+1, 0x1.aa5350a7af067p+1,
        0x1.1828407d00ae6p+2, -0x1.e452eb4a93c74p-7, 0x1.4bf5b40609c1cp+3, -0x1.3e36c0905982dp+8,
        -0x1.b11526e85849ep-8, -0x1.a3ba4b1d45a5ap+0, 0x1.ccb396eff4e4ap+2, -0x1.f1c3f8c2470f1p+3,
        -0x1.7fb19e2904032p+1, -0x1.23ca817019554p-1, 0x1.e740c227a174p+1, 0x1.a49d31a93ab2dp+2,
        -0x1.20fbf2fe9b74bp+7, -0x1.8ff261e22fc12p+0, 0x1.cb6d2558eedb4p+3, -0x1.1930cf0ddd134p+5,
};

static const remus6_real numbers_coupled_jacobian[] =
{
    -0x1.e8a9d02919878p-3, 0x1.c0dc8fe9a54e6p+0, -0x1.7ee31a0cf12e9p+0, -0x1.fe3c0347d5ad9p-6,
        -0x1.70b87a3546471p+0, 0x1.e82de132c66f1p+1, -0x1.3e20b5e218162p-1, -0x1.3785b92a5516dp+6,
        0x1.f3e81fe71dd9ap+0, 0x1.c7a34548f60dbp-1, -0x1.97f5c015a0a18p-8, -0x1.4ae006747714ap+0,
        0x1.8409a9f97b484p-3, -0x1.f3e8db51d4be1p+0, -0x1.ecc19bc16f89ap+1, -0x1.dc91cd1b47678p+0,
        0x1.99229c607ffedp+0, 0x1.7cd02997dc16bp-8, 0x1.0522b8f90ba54p-1, -0x1.78be7ce25ca97p+7,
        -0x1.b4d0e2d5772ccp-7, -0x1.0dc5a7fd59495p+1, -0x1.447113bd2de06p-5, 0x1.fedd2bb757658p-2,
        0x1.f215642693ed8p+1, -0x1.04dbe2e295fa6p-4, 0x1.08c6e62cd512bp+3, 0x1.9c0a02186cba7p-1,
        -0x1.cb6bfc913f6c5p+4, 0x1.c13b6cdf01abdp+0, -0x1.f5409a8901924p+2, -0x1.a1fa531b0523ep+4,
    0x1.9d73f19b7b296p-9, 0x1.e562ee2e96c6p+3, -0x1.afa0700f77dbdp+2, -0x1.0c75c4df8f15fp-2,
        0x1.0b8c6c12e1ac1p+2, -0x1.f683b9fdc03d4p+2, -0x1.75dc67132bb6ap+1, -0x1.078820a5cc884p+7,
        -0x1.085cf294c571ap+1, -0x1.c062b87f79a8ap-1, -0x1.9914adb9031fp-8, -0x1.3eb5db029dc59p+2,
        0x1.998963ab15991p+0, 0x1.0a27719a973b1p+1, -0x1.aa11447f8854dp+1, 0x1.aa52c374cc6b8p+1,
        0x1.182e8b0528689p+2, -0x1.e34bac00d18dp-7, 0x1.4c3bac2c00e38p+3, -0x1.3e76096969023p+8,
        -0x1.0f372e01126d7p-7, -0x1.a40a61bbba0acp+0, 0x1.cd550067753dep+2, -0x1.f2a73f4baca7fp+3,
        -0x1.7fb29a7e2af7bp+1, -0x1.23f35002fa245p-1, 0x1.e743bdeebfdc8p+1, 0x1.a49fc3f9a7057p+2,
        -0x1.20fdf33391858p+7, -0x1.900b607e5608p+0, 0x1.cb730aa315e31p+3, -0x1.193e0c597223p+5,
};

static const remus6_real numbers_inverse[] =
{
    0x1.138725b4df949p+27, -0x1.988d4e59d3523p+26, -0x1.5a44480b73958p+25, -0x1.b1c1a27dec95p+21,
        -0x1.acb001413046ap+25, 0x1.e82cfd61d56f9p+25, 0x1.8p-39, 0x1p-38, -0x1p-38, -0x1.cp-38, -0x1.68p-38,
        0x1p-37, 0x1.f5089e134331bp-6, 0x1.0f4d9066313fep-7, 0x1.c109ee5e1e8cp-8, 0x1.5491a0ecf1e2cp-9,
        0x1.8c928f6b316b7p-10, 0x1.655947a50128p-13, 0x0p+0, 0x1.01c10c2f66506p+1, 0x1.10ff889ddf18cp+2,
        0x1.64bb644cc5c3ap+2, -0x1.7c4550f90fc1ep-5, -0x1.7c68d88805aafp-1, -0x1.f485ea701dac5p-2,
    0x1.fc915acfe275ep+22, -0x1.439585d220bd3p+27, 0x1.aa5912b050e88p+26, -0x1.0a30291c88dc6p+27,
        -0x1.0ebf7535f46b2p+25, 0x1.5b4442ac2789dp+25, -0x1.cp-39, 0x1.cp-37, -0x1.4cp-38, 0x0p+0, 0x1.8p-42,
        0x1.36p-36, 0x1.f929a3e50bbcp-6, 0x1.c682dc4c253c6p-8, 0x1.af26db6ab6a41p-8, 0x1.428332ec936a9p-8,
        0x1.15344359cc6dcp-9, 0x1.c470773f9e533p-11, 0x0p+0, 0x1.8f3bb233e3902p-2, -0x1.50b6d0bbb0c1dp+1,
        0x1.e4665694c439dp+2, 0x1.998e42582ba7p-9, 0x1.ef3225d7568b9p-2, 0x1.98ac5ecf3acafp-2,
};

static const remus6_real numbers_inverse_fast[] =
{
    0x1.138725b4df9ep+27, -0x1.988d4e59d3601p+26, -0x1.5a44480b73a01p+25, -0x1.b1c1a27decfe4p+21,
        -0x1.acb0014130569p+25, 0x1.e82cfd61d5848p+25,
    0x1.fc915acfe2738p+22, -0x1.439585d220bd4p+27, 0x1.aa5912b050e88p+26, -0x1.0a30291c88dc8p+27,
        -0x1.0ebf7535f46b7p+25, 0x1.5b4442ac27891p+25,
};

static const remus6_real numbers_points[] =
{
    -0x1.cfaa0f078d1d2p-1, 0x1.2b3958857aa3ep+0, 0x1.db7ade5efc7f4p-3, -0x1.ba0f02fb58002p-2,
        0x1.912b11fecedaep-1, -0x1.c99ecabcf13ap-2, -0x1.28b8e1e4663a1p-1, 0x1.1c1c20f7c4e6cp-3,
        0x1.9b29bc45f8683p-1, 0x1.61e6ad7d081d2p-1, 0x1.361a10e978325p-1, 0x1.93a85e8437712p-2,
        0x1.aefe05fc78cbap+0, 0x1.23cbb69eb851ep+1, 0x1.42b931e84162cp-2, 0x1.08b3286394ebap+1, 0x1.462f7p-1,
        0x1.ed6ca14bfa655p-2, 0x1.ea84411d30c8p+2, 0x1.fd6617561f653p+3, -0x1.feb0ccebb204fp-1,
        0x1.5edc1055a43e5p+1, 0x1.eac5dp+2, 0x1.998f234cc752ap+3, -0x1.8a6555577e9a7p-1, 0x1.6026f4648e787p+0,
        0x1.40e20ea31e0e8p-7, -0x1.63e0ba9aa6dfcp-2, 0x1.912b11fecedaep-1, -0x1.07b720737a69bp-1,
        -0x1.6b9cae0a9fcf9p-1, 0x1.1c1c20f7c4e6cp-3,
    0x1.70943f0c67a95p-1, 0x1.1ed8450be13b1p+0, 0x1.01c9d2421326ap-3, 0x1.d5cfb11576b3bp-4,
        -0x1.fc8f19db617edp-1, 0x1.fbd6c4148d19cp-7, 0x1.c3d0ed862c0d3p-1, 0x1.83f1c78dd1f9p-4,
        -0x1.d7d318fb3c15bp-2, 0x1.d326876cfdacp-2, 0x1.107dbec7770f5p-4, 0x1.c6577cb5a5ebfp-1,
        0x1.1bf6dcfd2da4ep-3, 0x1.0e92afffffffdp-2, -0x1.32964271bf48ap+1, -0x1.8fdc61df241eap-1,
        0x1.968a6p+1, 0x1.ddb66dc90def4p+2, -0x1.1779f4317d9d2p+6, 0x1.3773dc310ceecp+5,
        -0x1.09f9df6cba481p+6, 0x1.f5c8bc6a0a257p+5, 0x1.1fb6fp+5, -0x1.6b4aa8235991bp+3,
        0x1.5d3a5ef2d2d83p-1, 0x1.a37dd9191dbdcp-1, -0x1.3c8d9089a18e6p-7, 0x1.c3a69092b57ap-4,
        -0x1.fc8f19db617edp-1, 0x1.2031d683d46dcp-5, 0x1.e5eaf286b04e3p-1, 0x1.83f1c78dd1f9p-4,
};

static const remus6_real numbers_quaternion[] =
{
    0x1.d1c580c9de08fp-1, 0x1.987cd3fe2cc46p-5, -0x1.a458e2ae68224p-2, -0x1.3651b35238a8ap-5,
    0x1.deb4a2fc0adb9p-1, -0x1.16501d07af652p-2, -0x1.98c207bb7a262p-3, 0x1.c2f86acd35134p-4,
};

static const remus6_real numbers_state_from_coordinates[] =
{
    -0x1.5944dp-2, 0x1.f3e8ep-2, 0x1.35894p-2, 0x1.d1c580c9de08fp-1, 0x1.987cd3fe2cc46p-5,
        -0x1.a458e2ae68224p-2, -0x1.3651b35238a8ap-5, 0x1.6692abcae7424p+0, -0x1.fd54e89ea9addp-1,
        -0x1.78c4c37406e4p-6, -0x1.5a7729c8c91fap-1, 0x1.96ac16612c797p-1, -0x1.78d16e603f87ap-5,
        -0x1.95dd5cp+3, 0x1.e462ap+3, -0x1.23a78p+1, -0x1.c68578p+2, -0x1.cf9e4p+3, -0x1.e0f5dp+2,
        -0x1.c61c58p+7, -0x1.3c48p+4, -0x1.c4d59p+7, 0x1.d79d24p+7, 0x1.3513p+3, 0x1.29b748p+6,
        0x1.cc99e9fb28c4bp+3, 0x1.0d711e9dd585ep+3, 0x1.009af4639ee5cp+2, 0x1.ca8f77507078ap+3,
        -0x1.6688b27a5f158p+1, 0x1.b7b5b24f19a08p+0,
    -0x1.3d4554p+0, -0x1.07562p-1, 0x1.a063e4p+0, 0x1.deb4a2fc0adb9p-1, -0x1.16501d07af652p-2,
        -0x1.98c207bb7a262p-3, 0x1.c2f86acd35134p-4, -0x1.c38482257bfe6p-1, 0x1.87d7f36d6c1e1p+0,
        0x1.d9fe1c5f935cdp+0, -0x1.87a4aeb7a8674p-3, 0x1.012c02e975ce9p+0, -0x1.a03c331a53dd4p-2,
        -0x1.0249c8p+22, -0x1.371e7p+21, -0x1.214c38p+22, 0x1.4171bp+20, 0x1.82ebap+20, 0x1.0b38ap+21,
        -0x1.055d68p+13, -0x1.8f2aap+11, -0x1.763e6p+10, -0x1.df9aep+13, -0x1.f8caa4p+13, 0x1.3b88ccp+13,
        -0x1.35173faa47cc7p+4, -0x1.0f6b43bbbc303p+3, -0x1.3599e7b299206p-3, 0x1.71c551fb7d96ep+3,
        -0x1.b283b803c5073p+1, 0x1.007f1b83b045ep+2,
    -0x1.7a5978p+39, 0x1.8ab58p+38, 0x1.b0decp+36, -0x1.a64a207452298p-1, 0x1.368f6b1ecd55fp-2,
        -0x1.d84f72e982f2bp-1, -0x1.8aab9821cf9d3p+0, 0x1.a35e68p-1, -0x1.16ceep-3, 0x1.63ddcp-3,
        0x1.e05b2p-3, -0x1.68bbep-1, -0x1.cbd33cp+0, -0x1.c483b8p+43, -0x1.ed35p+38, -0x1.bdd86p+43,
        0x1.f8f3ep+41, -0x1.ca174p+40, 0x1.bc5528p+42, 0x1.67f6p+3, 0x1.7f7ed8p+6, 0x1.1db6ap+7,
        -0x1.046708p+7, 0x1.7c0718p+7, -0x1.8e30bp+7,
};

static const remus6_real numbers_generalized[] =
{
    0x1.51fae45d6853p-1, -0x1.c1fb8ff509d0ap-4, 0x1.7c75b6483a306p-1, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.ca78feff694fap-6, 0x1.fbfc07e709aabp-1, 0x1.f2fd639430ecfp-4, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.80540954e8e0ep-1, -0x1.e870fe184e90ap-5, 0x1.50e740352e2f7p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.7c75b6483a306p-1, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.f2fd639430ecfp-4,
        0x1.f771d1d15770ap-1, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.cacb962289016p-1, 0x1.41eb2b256d86dp-2, 0x1.40e47ef55edbap-2, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.8ee76dd1332acp-4, 0x1.a7f1c0d6279bp-1, -0x1.1ab7899d7445p-1, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.bb76382558441p-2, 0x1.db6cdc380755p-2, 0x1.8b90c93cf4e25p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.40e47ef55edbap-2, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.1ab7899d74451p-1,
        0x1.a08bfade08706p-1, 0x0p+0, 0x0p+0, 0x0p+0,
};

static const remus6_real numbers_prepare[] =
{
    0x1.bea5970b851ebp+4, 0x1.257532b15bedp-5, -0x1.1b29d9db2fp-15, -0x1.67eee396ba05p-12,
        0x1.1832d87b6a4ccp-1, 0x1.dc329ee016db4p-3, 0x1.0145afc8526e2p+3, 0x1.0145ad36e9d06p+3,
        0x1.e82056bec29fap-14, 0x1.52eb9498b38ap-14, 0x1.90ad2aa47c144p-16, 0x1.cd86deb999999p+4,
        0x1.fb52cb85c28f6p+5, 0x1.fb52cb85c28f6p+5, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.1bff19c294dbep-5,
        0x1.025c1ed928c81p-6, 0x1.025c1ed928c81p-6, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x1.ee147ae147ae1p+0, 0x0p+0, -0x1.ee147ae147ae1p+0, 0x0p+0,
    0x1.c45a474e147aep+4, 0x1.21c1987c37ff9p-5, -0x1.1ec7e48f2b8p-15, -0x1.6c87fe796b8dp-12,
        0x1.1bc730fa1d29p-1, 0x1.e0706f6ae3ed6p-3, 0x1.02905bb9fc2bep+3, 0x1.029059202d9a6p+3,
        0x1.ee5cadf5bc9f3p-14, 0x1.573ff74bc3a8p-14, 0x1.95cb841df443ap-16, 0x1.d33b8efc28f5cp+4,
        0x1.fe2d23a70a3d7p+5, 0x1.fe2d23a70a3d7p+5, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.1887414fd10c8p-5,
        0x1.00ea43c8fea58p-6, 0x1.00ea43c8fea58p-6, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x1.ee147ae147ae1p+0, 0x0p+0, -0x1.ee147ae147ae1p+0, 0x0p+0,
    0x1.e7ae147ae147bp+4, 0x1.0cc43310cc433p-5, -0x1.352d72b245p-15, -0x1.88ffff9054b2p-12,
        0x1.31f0b69c17004p-1, 0x1.fab337d996f7p-3, 0x1.0a8fb3411c04p+3, 0x1.0a8fb0734e185p+3,
        0x1.0a7c2eecf964fp-13, 0x1.720e7efc48dcp-14, 0x1.b57c7fb7472bp-16, 0x1.f68f5c28f5c29p+4,
        0x1.07eb851eb851fp+6, 0x1.07eb851eb851fp+6, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.04cf0451d426dp-5,
        0x1.f0a2a5e8412fp-7, 0x1.f0a2a5e8412fp-7, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x1.ee147ae147ae1p+0, 0x0p+0, -0x1.ee147ae147ae1p+0, 0x0p+0,
};

static const remus6_real numbers_mounts[] =
{
    0x1.7a2b33c46dd5dp+1, -0x1.36996fd596d17p+3, 0x1.8e9e5c4d9105ap+1, -0x1.1665f6604fbdcp-10,
        -0x1.0bb8fc9f35378p-5, 0x1.765b6c5cef042p-6, 0x1.83896a39923ecp+0, -0x1.00df0fd4374bdp+0,
        -0x1.1a2f56c0d487dp+1, -0x1.2620a30d45a4ap-4, 0x1.3fe77df48ea28p-8, -0x1.53c61a2707c7p-10,
        0x1.4063df7a6c945p+0, 0x1.178841d3e4b09p+3, 0x1.4b2c5be99832p+2, 0x1.24d34aba9a5d9p-5,
        0x1.9c00fd3976b13p-5, 0x1.944f40601764ap-6, 0x1.01b5b88ab34d4p-2, -0x1.7123f73d51dfep+3,
        0x1.fc26f6f6186e4p+2, -0x1.7051763f7f77bp-5, 0x1.1b50e4d428e8bp-4, 0x1.06970375e3a8ap-5,
        0x1.1ec80ad0b00b8p+1, 0x1.2a845a33d2001p+1, 0x1.66da543dee276p-2, 0x1.a009b9e8a6017p-5,
        -0x1.01cc3bc07764p-12, 0x1.a078b30ebdacep-11, 0x1.fabbd4fba9014p+0, 0x1.ac58ca0cb28d7p+1,
    -0x1.35091b659da82p+3, -0x1.8f7a3eda8acdcp+13, -0x1.6473a96e7d2a1p+12, 0x1.220abb6c0d7dfp-6,
        0x1.44ebcfc3cb774p+5, 0x1.a43ed2c13a314p+4, 0x1.4768f686cf4ebp+4, -0x1.0685da9e85bd9p+11,
        -0x1.47300e4c8348ap+8, -0x1.aa34c672e84d8p-7, 0x1.e662955dbe432p+1, -0x1.57237765c9d5cp+2,
        -0x1.590738c2c8ef7p+3, -0x1.079c00491d432p+7, 0x1.93bf4a684168p+8, -0x1.a393f47c83ff1p-5,
        -0x1.49f71fe8902a4p+0, -0x1.b02405b28fdfp-4, 0x1.23ecef54ae529p+4, -0x1.6f0c22f38dcebp+15,
        -0x1.78243f2860224p+11, -0x1.9dd86eed3200bp-6, 0x1.1cf7668f90bbcp+2, -0x1.81e02f848e35ap+3,
        0x1.4d863dc29623ap+2, -0x1.3d11bfa64c55dp+15, 0x1.0027fe6843ff6p+15, -0x1.74aa354b458f2p-5,
        -0x1.6b2ce1a8290c8p+6, -0x1.4f895fdf4c7e2p+4, 0x1.0a21c799b16c2p+1, 0x1.d58775a708139p+10,
};

static const remus6_real numbers_prepare_mounts[] =
{
    0x1.d4ebaap-3, 0x0p+0, 0x1.8023c504816fp-13, 0x0p+0, 0x1.201ad3c361134p-13, 0x1.4684cddd6e04cp-14,
        0x1.59b9caea747d8p-14, -0x1.456cd424fb242p-75, -0x1.2704f16be8866p-21, 0x0p+0, 0x1.c28f5c28f5c29p-3,
        0x1.1eb851eb851ecp-5, 0x1.47ae147ae147bp-6, 0x0p+0, 0x0p+0, 0x1p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1p+0, 0x0p+0, 0x1.d4ebaap-3, 0x0p+0, 0x1.9358c21187e7cp-13, 0x0p+0, 0x1.201ad3c361134p-13,
        0x1.4684cddd6e04cp-14, 0x1.520aff4ba51ap-14, -0x1.ebb2e7b3d8dfep-23, -0x1.a9d2dd91bf12p-22, 0x0p+0,
    0x1.dae932p-3, 0x0p+0, 0x1.850c09d495183p-13, 0x0p+0, 0x1.23c9075f6fd22p-13, 0x1.4ab0a1f4b1ee3p-14,
        0x1.5e246f3f52fc3p-14, -0x1.4995149e91f6ep-75, -0x1.2ac9c1eaf17bp-21, 0x0p+0, 0x1.c28f5c28f5c29p-3,
        0x1.1eb851eb851ecp-5, 0x1.47ae147ae147bp-6, 0x0p+0, 0x0p+0, 0x1p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1p+0, 0x0p+0, 0x1.dae932p-3, 0x0p+0, 0x1.987fd71f36263p-13, 0x0p+0, 0x1.23c9075f6fd22p-13,
        0x1.4ab0a1f4b1ee3p-14, 0x1.565c8387df5cfp-14, -0x1.f1faeddce7ccep-23, -0x1.af437487a02d3p-22, 0x0p+0,
};

static const remus6_real numbers_center_of_mass_velocity[] =
{
    0x1.b87df8aaeaf0cp-2, -0x1.0746fda4efbc8p-2, 0x1.4944de9517948p+1,
    0x1.a8e70840c0fa7p+1, 0x1.9ed98a26982d5p-2, -0x1.d208f797c604p-1,
};

typedef struct function {
    const char *name;
    size_t size;  /* of its results, bytes */
    remus6_status (*call)(void);
    void (*take)(tally *sum, remus6_status status);
    const remus6_real *numbers;
    answer answers[CASES];
    uint32_t swept;  /* hash of the first SWEPT states of a sweep */
} function;

static const function functions[FUNCTIONS] =
{
    { "forward", sizeof results.forward,
      call_forward, take_forward_results, numbers_forward,
      { { 0, 0x1c432034u, 6 }, { 0, 0xfab68c2du, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x47e0f5b1u },
    { "wrench", sizeof results.wrench,
      call_wrench, take_wrench_results, numbers_wrench,
      { { 0, 0x813cdd82u, 6 }, { 0, 0xe969b9f2u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x52ceaa10u },
    { "matrices", sizeof results.matrices,
      call_matrices, take_matrices_results, numbers_matrices,
      { { 0, 0xe2460fbfu, 32 }, { 0, 0x10b38163u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xeb3a9428u },
    { "momentum", sizeof results.momentum,
      call_momentum, take_momentum_results, numbers_momentum,
      { { 0, 0x4f6bd2c0u, 16 }, { 0, 0x343cfa2du, 16 }, { -2, 0x8e5b0aa0u, 0 } },
      0x4914391du },
    { "torque", sizeof results.torque,
      call_torque, take_torque_results, numbers_torque,
      { { 0, 0xa33fdd42u, 6 }, { 0, 0x8c7e10c5u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x4da12f02u },
    { "coupled", sizeof results.coupled,
      call_coupled, take_coupled_results, numbers_coupled,
      { { 0, 0xd7c991bbu, 12 }, { 0, 0xb69eda78u, 12 }, { -2, 0x8e5b0aa0u, 0 } },
      0xa3863f39u },
    { "step", sizeof results.step,
      call_step, take_step_results, numbers_step,
      { { 0, 0xb0c15179u, 25 }, { 0, 0xeac1b2acu, 25 }, { -2, 0x8e5b0aa0u, 0 } },
      0x085f936eu },
    { "step_driven", sizeof results.step_driven,
      call_step_driven, take_step_driven_results, numbers_step_driven,
      { { 0, 0x4f70ddb5u, 25 }, { 0, 0x2151e463u, 25 }, { -2, 0x8e5b0aa0u, 0 } },
      0x602b2015u },
    { "wrap", sizeof results.wrap,
      call_wrap, take_wrap_results, numbers_wrap,
      { { 0, 0x3f5b19b4u, 1 }, { 0, 0xf431d285u, 1 }, { -2, 0x8e5b0aa0u, 0 } },
      0xfb61958bu },
    { "phase_of_counts", sizeof results.phase_of_counts,
      call_phase_of_counts, take_phase_of_counts_results, numbers_phase_of_counts,
      { { 0, 0x9a384185u, 1 }, { 0, 0x8a27cf3bu, 1 }, { -5, 0x2107376du, 0 } },
      0x6a80af01u },
    { "speed_of_counts", sizeof results.speed_of_counts,
      call_speed_of_counts, take_speed_of_counts_results, numbers_speed_of_counts,
      { { 0, 0x208714f1u, 1 }, { 0, 0xa988041du, 1 }, { -5, 0x2107376du, 0 } },
      0xfdc52a3du },
    { "accumulate", sizeof results.accumulate,
      call_accumulate, take_accumulate_results, numbers_accumulate,
      { { 0, 0xe9416429u, 0 }, { 0, 0x9a415034u, 0 }, { -5, 0x3918c3aeu, 0 } },
      0x400cb891u },
    { "forward_jacobian", sizeof results.forward_jacobian,
      call_forward_jacobian, take_forward_jacobian_results, numbers_forward_jacobian,
      { { 0, 0x272d9789u, 32 }, { 0, 0x1c20383eu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x1c424b74u },
    { "coupled_jacobian", sizeof results.coupled_jacobian,
      call_coupled_jacobian, take_coupled_jacobian_results, numbers_coupled_jacobian,
      { { 0, 0xde793f08u, 32 }, { 0, 0xd9b05f41u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xa2a735b4u },
    { "inverse", sizeof results.inverse,
      call_inverse, take_inverse_results, numbers_inverse,
      { { 0, 0xca65e1e7u, 25 }, { 0, 0x21c65c55u, 25 }, { -2, 0x8e5b0aa0u, 0 } },
      0x35248d2eu },
    { "inverse_fast", sizeof results.inverse_fast,
      call_inverse_fast, take_inverse_fast_results, numbers_inverse_fast,
      { { 0, 0x63eed221u, 6 }, { 0, 0x4ea66c00u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0xffce03eeu },
    { "points", sizeof results.points,
      call_points, take_points_results, numbers_points,
      { { 0, 0x529ea787u, 32 }, { 0, 0xde8f82b2u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x46d707d2u },
    { "quaternion", sizeof results.quaternion,
      call_quaternion, take_quaternion_results, numbers_quaternion,
      { { 0, 0x13a20f40u, 4 }, { 0, 0x6d6e6ffdu, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0xea132f50u },
    { "state_from_coordinates", sizeof results.state_from_coordinates,
      call_state_from_coordinates, take_state_from_coordinates_results, numbers_state_from_coordinates,
      { { 0, 0x4ff18024u, 31 }, { 0, 0x6f1d1552u, 31 }, { -2, 0x054a767bu, 25 } },
      0xe24ae2abu },
    { "generalized", sizeof results.generalized,
      call_generalized, take_generalized_results, numbers_generalized,
      { { 0, 0x2e9f5fdcu, 32 }, { 0, 0x54ab7219u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xc01e18bfu },
    { "prepare", sizeof results.prepare,
      call_prepare, take_prepare_results, numbers_prepare,
      { { 0, 0x3de85d7eu, 32 }, { 0, 0x9c70b239u, 32 }, { -2, 0x3fcf95c4u, 32 } },
      0xd8e44938u },
    { "mounts", sizeof results.mounts,
      call_mounts, take_mounts_results, numbers_mounts,
      { { 0, 0xfcdfa476u, 32 }, { 0, 0x338ed681u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x6800c1d0u },
    { "prepare_mounts", sizeof results.prepare_mounts,
      call_prepare_mounts, take_prepare_mounts_results, numbers_prepare_mounts,
      { { 0, 0x6e899a9au, 32 }, { 0, 0x0f37b00bu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x5b6a3873u },
    { "center_of_mass_velocity", sizeof results.center_of_mass_velocity,
      call_center_of_mass_velocity, take_center_of_mass_velocity_results, numbers_center_of_mass_velocity,
      { { 0, 0x6c6b9003u, 3 }, { 0, 0x9e2a894cu, 3 }, { -2, 0x8e5b0aa0u, 0 } },
      0x45bcba45u },
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
static remus6_real draw_real(uint32_t *seed, remus6_real largest)
{
    const int32_t part = (int32_t)(draw_word(seed) >> 8) - 8388608;
    return largest * ((remus6_real)part / 8388608.0);
}

static void draw_reals(uint32_t *seed, remus6_real *values, int count, remus6_real largest)
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
static void draw_attitude(uint32_t *seed, remus6_real attitude[4], int refused)
{
    const uint32_t word = draw_word(seed);
    const int32_t a = 2 * (int32_t)(word >> 25) - 127;  /* odd: not all are 0 */
    const int32_t b = (int32_t)((word >> 16) & 0xffu) - 128;
    const int32_t c = (int32_t)((word >> 8) & 0xffu) - 128;
    const int32_t d = (int32_t)(word & 0xffu) - 128;
    const remus6_real norm = (remus6_real)(a * a + b * b + c * c + d * d);
    const remus6_real factor = refused != 0 ? 2.0 : 1.0;
    attitude[0] = factor * ((remus6_real)(a * a - b * b - c * c - d * d) / norm);
    attitude[1] = factor * ((remus6_real)(2 * a * b) / norm);
    attitude[2] = factor * ((remus6_real)(2 * a * c) / norm);
    attitude[3] = factor * ((remus6_real)(2 * a * d) / norm);
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
static remus6_real draw_step(const uint32_t *seed)
{
    (void)seed;
    return 0x1p-14;
}

static remus6_real draw_factor(uint32_t *seed, remus6_real largest)
{
    return 1.0 + draw_real(seed, largest);
}

static void draw_inputs(uint32_t *seed, unsigned long state)
{
    const remus6_real fast = state % 4ul == 3ul ? 32.0 : 1.0;
    const int refused = state % 16ul == 15ul ? 1 : 0;
    draw_reals(seed, in.x.position, 3, 2.0);
    draw_attitude(seed, in.x.attitude, refused);
    draw_reals(seed, in.x.V, 6, 2.0);
    draw_reals(seed, in.x.phi, REMUS6_N, 16.0 * fast);
    draw_reals(seed, in.x.phi_dot, REMUS6_N, 256.0 * fast);
    draw_reals(seed, in.phi_ddot, REMUS6_N, 512.0);
    draw_reals(seed, in.V_dot, 6, 16.0);
    draw_reals(seed, in.tau, REMUS6_N, 2.0);
    draw_flags(seed, in.locked, REMUS6_N);
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
    parameters = remus6_default_parameters;
    parameters.carrier.mass = parameters.carrier.mass * in.mass_factor;
    for (int i = 0; i < 6; ++i) {
        parameters.carrier.inertia[i] = parameters.carrier.inertia[i] * in.mass_factor;
    }
    for (int i = 0; i < 1; ++i) {
        parameters.instrument[i].body.mass = parameters.instrument[i].body.mass * in.mass_factor;
        for (int j = 0; j < 6; ++j) {
            parameters.instrument[i].body.inertia[j] = parameters.instrument[i].body.inertia[j] * in.mass_factor;
        }
    }
    for (int i = 0; i < REMUS6_N; ++i) {
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
    remus6_status found;
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
    const remus6_real *numbers = f->numbers;
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
int remus6_selftest(void (*print)(const char *text), unsigned long sweep)
{
    int failures = 0;
    length = 0u;
    (void)remus6_prepare_mounts(&remus6_default_parameters, &mounting);
    add_text("mahovik selftest remus6 structure 3687deee physics 5f25aea2 real double");
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

#ifndef REMUS6_SELFTEST_NO_MAIN
static void print_text(const char *text)
{
    (void)fputs(text, stdout);
}

int main(void)
{
    return remus6_selftest(print_text, REMUS6_SELFTEST_SWEEP) != 0;
}
#endif
