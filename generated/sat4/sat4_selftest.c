/* sat4_selftest.c: does sat4.c give the right bits on this machine?
 * mahovik 0.1.0; structure 60e5c883, physics 347c0b3b. Generated: change the stand file instead.
 *
 * Compile it with sat4.c as firmware is compiled (-std=c99 -ffp-contract=off; -fno-tree-vectorize as well by gcc
 * for x86-64 with FMA and for a Cortex-M55, or bits differ) and run it; on a board, define
 * SAT4_SELFTEST_NO_MAIN and call sat4_selftest with what prints a text, such as to a serial port.
 * Golden vectors: inputs and answers of the generator's interpreter as hexadecimal constants; each bit must agree.
 * Sweep: states that an integer generator makes here; a hash of all answers a function is printed, to be
 * compared between machines. The log of a board is judged by `mahovik judge-log LOG STAND.toml`. It reads:
 *
 *     mahovik selftest sat4 structure 60e5c883 physics 347c0b3b real double
 *     generator mahovik 0.1.0
 *     forward PASS cases 4 worst 0 ulp      a line a function; or FAIL, and how many cases are wrong
 *                                        (a distance above 1000000 ulp: worst more than 1000000 ulp)
 *     sweep 100                          states
 *     forward 0123abcd                   a line a function: FNV-1a of its statuses and outputs
 *     failures 0                         functions that failed; the last line
 *
 * No allocation. It keeps inputs and results in static memory: one caller at a time. */
#include "sat4.h"

#include <stddef.h>
#include <stdint.h>
#ifndef SAT4_SELFTEST_NO_MAIN
#include <stdio.h>
#endif

#if SAT4_STRUCTURE != 0x60e5c883u || SAT4_PHYSICS != 0x347c0b3bu
#error "sat4.h and sat4_selftest.c are of different stands"
#endif
#if SAT4_LANES != 1
#error "sat4.h and sat4_selftest.c were generated for different numbers of lanes"
#endif

#ifndef SAT4_SELFTEST_SWEEP
#define SAT4_SELFTEST_SWEEP 100ul  /* states of the sweep that main runs */
#endif

int sat4_selftest(void (*print)(const char *text), unsigned long sweep);

typedef uint64_t real_bits;

enum { CASES = 3, FUNCTIONS = 23, SWEPT = 1 };

#define FAR ((real_bits)1000000u)  /* ulp: a worse distance is not printed as a number */

/* ---- inputs and results ---- */

/* What the functions take beside the stand's own constants. */
typedef struct inputs {
    sat4_state x;
    sat4_real phi_ddot[SAT4_N];
    sat4_real V_dot[6];
    sat4_real tau[SAT4_N];
    int locked[SAT4_N];
    sat4_real dt;
    int order;
    sat4_real phi;
    int count;
    int per_turn;
    sat4_real zero;
    int moved;
    sat4_encoder encoder;
    int counter;
    int bits;
    sat4_real angles[3];
    sat4_real position[3];
    sat4_real q_dot[6];
    sat4_real q_ddot[6];
    sat4_real mass_factor;  /* of all masses and inertias of the parameters */
} inputs;

static inputs in;
static sat4_parameters parameters;
static sat4_mount_table mounting;

static union {
    struct { sat4_real V_dot[6]; } forward;
    struct { sat4_matrices_result out; } matrices;
    struct { sat4_momentum_result out; } momentum;
    struct { sat4_real tau[SAT4_N]; } torque;
    struct { sat4_real V_dot[6]; sat4_real phi_ddot[SAT4_N]; } coupled;
    struct { sat4_state next; } step;
    struct { sat4_state next; } step_driven;
    struct { sat4_real wrapped; } wrap;
    struct { sat4_real phi; } phase_of_counts;
    struct { sat4_real phi_dot; } speed_of_counts;
    struct { sat4_encoder encoder; } accumulate;
    struct { sat4_forward_jacobian_result out; } forward_jacobian;
    struct { sat4_coupled_jacobian_result out; } coupled_jacobian;
    struct { sat4_inverse_result out; } inverse;
    struct { sat4_real phi_ddot[SAT4_N]; } inverse_fast;
    struct { sat4_points_result out[SAT4_SENSORS]; } points;
    struct { sat4_real attitude[4]; } quaternion;
    struct { sat4_state x; sat4_real V_dot[6]; } state_from_coordinates;
    struct { sat4_generalized_result out; } generalized;
    struct { sat4_table table; } prepare;
    struct { sat4_real mount_wrench[24]; } mounts;
    struct { sat4_mount_table mounting; } prepare_mounts;
    struct { sat4_real center_of_mass_velocity[3]; } center_of_mass_velocity;
    unsigned char bytes[1];
} results;

enum { UNTOUCHED = 0x5a };  /* what every byte of the results holds before a call */

/* ---- taking results: their hash, and how far they are from what is expected ---- */

typedef struct tally {
    uint32_t hash;                /* FNV-1a of all bits taken so far, the lowest byte of a number first */
    const sat4_real *expected;  /* next numbers that are expected, `left` of them */
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

static real_bits bits_of(sat4_real value)
{
    union { sat4_real real; real_bits word; } both;
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

static void take_reals(tally *sum, const sat4_real *values, int count)
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

static void take_matrices_result(tally *sum, const sat4_matrices_result *value)
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
        take_reals(sum, value->I[i], SAT4_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->J[i], SAT4_N);
    }
    take_reals(sum, value->F, 6);
}

static void take_momentum_result(tally *sum, const sat4_momentum_result *value)
{
    take_reals(sum, value->Z, 6);
    take_reals(sum, value->Z0, 6);
    take_reals(sum, &value->energy, 1);
    take_reals(sum, value->center_of_mass, 3);
}

static void take_state(tally *sum, const sat4_state *value)
{
    take_reals(sum, value->position, 3);
    take_reals(sum, value->attitude, 4);
    take_reals(sum, value->V, 6);
    take_reals(sum, value->phi, SAT4_N);
    take_reals(sum, value->phi_dot, SAT4_N);
}

static void take_encoder(tally *sum, const sat4_encoder *value)
{
    take_ints(sum, &value->counter, 1);
    take_ints(sum, &value->place, 1);
    take_ints(sum, &value->moved, 1);
}

static void take_forward_jacobian_result(tally *sum, const sat4_forward_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], SAT4_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], SAT4_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_ddot[i], SAT4_N);
    }
}

static void take_coupled_jacobian_result(tally *sum, const sat4_coupled_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], SAT4_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], SAT4_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_tau[i], SAT4_N);
    }
    for (int i = 0; i < SAT4_N; ++i) {
        take_reals(sum, value->phi_ddot_V[i], 6);
    }
    for (int i = 0; i < SAT4_N; ++i) {
        take_reals(sum, value->phi_ddot_phi[i], SAT4_N);
    }
    for (int i = 0; i < SAT4_N; ++i) {
        take_reals(sum, value->phi_ddot_phi_dot[i], SAT4_N);
    }
    for (int i = 0; i < SAT4_N; ++i) {
        take_reals(sum, value->phi_ddot_tau[i], SAT4_N);
    }
}

static void take_inverse_result(tally *sum, const sat4_inverse_result *value)
{
    take_reals(sum, value->phi_ddot, SAT4_N);
    take_reals(sum, value->residual, 6);
    take_reals(sum, value->sigma, 4);
    take_ints(sum, &value->rank, 1);
    take_reals(sum, &value->damped_by, 1);
    take_ints(sum, value->limited, SAT4_N);
    take_reals(sum, value->hardest, 6);
}

static void take_points_result(tally *sum, const sat4_points_result *value)
{
    take_reals(sum, value->position, 3);
    for (int i = 0; i < 3; ++i) {
        take_reals(sum, value->C[i], 3);
    }
    take_reals(sum, value->twist, 6);
    take_reals(sum, value->specific_force, 3);
    take_reals(sum, value->angular_acceleration, 3);
}

static void take_generalized_result(tally *sum, const sat4_generalized_result *value)
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

static void take_row(tally *sum, const sat4_row *value)
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

static void take_sensor(tally *sum, const sat4_sensor *value)
{
    take_reals(sum, value->origin, 3);
    take_reals(sum, value->axes, 9);
}

static void take_table(tally *sum, const sat4_table *value)
{
    take_reals(sum, &value->mass, 1);
    take_reals(sum, &value->mass_inverse, 1);
    take_reals(sum, value->first_moment, 3);
    take_reals(sum, value->inertia, 6);
    for (int i = 0; i < SAT4_N; ++i) {
        take_row(sum, &value->flywheel[i]);
    }
    for (int i = 0; i < SAT4_SENSORS; ++i) {
        take_sensor(sum, &value->sensor[i]);
    }
}

static void take_mount(tally *sum, const sat4_mount *value)
{
    take_reals(sum, &value->mass, 1);
    take_reals(sum, value->first_moment, 3);
    take_reals(sum, value->inertia, 6);
    take_reals(sum, value->origin, 3);
    take_reals(sum, value->axes, 9);
}

static void take_mount_table(tally *sum, const sat4_mount_table *value)
{
    for (int i = 0; i < SAT4_N; ++i) {
        take_mount(sum, &value->flywheel[i]);
    }
}

/* ---- every function: called with the inputs; its results taken ---- */

static sat4_status call_forward(void)
{
    return sat4_forward(&sat4_default, &in.x, in.phi_ddot, results.forward.V_dot);
}

static void take_forward_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.forward.V_dot, sizeof results.forward.V_dot);
        return;
    }
    take_reals(sum, results.forward.V_dot, 6);
}

static sat4_status call_matrices(void)
{
    return sat4_matrices(&sat4_default, &in.x, &results.matrices.out);
}

static void take_matrices_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.matrices.out, sizeof results.matrices.out);
        return;
    }
    take_matrices_result(sum, &results.matrices.out);
}

static sat4_status call_momentum(void)
{
    return sat4_momentum(&sat4_default, &in.x, &results.momentum.out);
}

static void take_momentum_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.momentum.out, sizeof results.momentum.out);
        return;
    }
    take_momentum_result(sum, &results.momentum.out);
}

static sat4_status call_torque(void)
{
    return sat4_torque(&sat4_default, &in.x, in.V_dot, in.phi_ddot, results.torque.tau);
}

static void take_torque_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.torque.tau, sizeof results.torque.tau);
        return;
    }
    take_reals(sum, results.torque.tau, SAT4_N);
}

static sat4_status call_coupled(void)
{
    return sat4_coupled(&sat4_default, &in.x, in.tau, in.locked, results.coupled.V_dot,
        results.coupled.phi_ddot);
}

static void take_coupled_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.coupled.V_dot, sizeof results.coupled.V_dot);
        untouched(sum, &results.coupled.phi_ddot, sizeof results.coupled.phi_ddot);
        return;
    }
    take_reals(sum, results.coupled.V_dot, 6);
    take_reals(sum, results.coupled.phi_ddot, SAT4_N);
}

static sat4_status call_step(void)
{
    return sat4_step(&sat4_default, &in.x, in.tau, in.locked, in.dt, in.order, &results.step.next);
}

static void take_step_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.step.next, sizeof results.step.next);
        return;
    }
    take_state(sum, &results.step.next);
}

static sat4_status call_step_driven(void)
{
    return sat4_step_driven(&sat4_default, &in.x, in.phi_ddot, in.dt, in.order, &results.step_driven.next);
}

static void take_step_driven_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.step_driven.next, sizeof results.step_driven.next);
        return;
    }
    take_state(sum, &results.step_driven.next);
}

static sat4_status call_wrap(void)
{
    return sat4_wrap(in.phi, &results.wrap.wrapped);
}

static void take_wrap_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.wrap.wrapped, sizeof results.wrap.wrapped);
        return;
    }
    take_reals(sum, &results.wrap.wrapped, 1);
}

static sat4_status call_phase_of_counts(void)
{
    return sat4_phase_of_counts(in.count, in.per_turn, in.zero, &results.phase_of_counts.phi);
}

static void take_phase_of_counts_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.phase_of_counts.phi, sizeof results.phase_of_counts.phi);
        return;
    }
    take_reals(sum, &results.phase_of_counts.phi, 1);
}

static sat4_status call_speed_of_counts(void)
{
    return sat4_speed_of_counts(in.moved, in.per_turn, in.dt, &results.speed_of_counts.phi_dot);
}

static void take_speed_of_counts_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.speed_of_counts.phi_dot, sizeof results.speed_of_counts.phi_dot);
        return;
    }
    take_reals(sum, &results.speed_of_counts.phi_dot, 1);
}

static sat4_status call_accumulate(void)
{
    results.accumulate.encoder = in.encoder;
    return sat4_accumulate(&results.accumulate.encoder, in.counter, in.bits, in.per_turn);
}

static void take_accumulate_results(tally *sum, sat4_status status)
{
    (void)status;
    take_encoder(sum, &results.accumulate.encoder);
}

static sat4_status call_forward_jacobian(void)
{
    return sat4_forward_jacobian(&sat4_default, &in.x, in.phi_ddot, &results.forward_jacobian.out);
}

static void take_forward_jacobian_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.forward_jacobian.out, sizeof results.forward_jacobian.out);
        return;
    }
    take_forward_jacobian_result(sum, &results.forward_jacobian.out);
}

static sat4_status call_coupled_jacobian(void)
{
    return sat4_coupled_jacobian(&sat4_default, &in.x, in.tau, in.locked, &results.coupled_jacobian.out);
}

static void take_coupled_jacobian_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.coupled_jacobian.out, sizeof results.coupled_jacobian.out);
        return;
    }
    take_coupled_jacobian_result(sum, &results.coupled_jacobian.out);
}

static sat4_status call_inverse(void)
{
    return sat4_inverse(&sat4_default, &in.x, in.V_dot, &sat4_default_options, &results.inverse.out);
}

static void take_inverse_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.inverse.out, sizeof results.inverse.out);
        return;
    }
    take_inverse_result(sum, &results.inverse.out);
}

static sat4_status call_inverse_fast(void)
{
    return sat4_inverse_fast(&sat4_default, &in.x, in.V_dot, &sat4_default_options,
        results.inverse_fast.phi_ddot);
}

static void take_inverse_fast_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.inverse_fast.phi_ddot, sizeof results.inverse_fast.phi_ddot);
        return;
    }
    take_reals(sum, results.inverse_fast.phi_ddot, SAT4_N);
}

static sat4_status call_points(void)
{
    return sat4_points(&sat4_default, &in.x, in.V_dot, results.points.out);
}

static void take_points_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.points.out, sizeof results.points.out);
        return;
    }
    for (int i = 0; i < SAT4_SENSORS; ++i) {
        take_points_result(sum, &results.points.out[i]);
    }
}

static sat4_status call_quaternion(void)
{
    return sat4_quaternion(in.angles, results.quaternion.attitude);
}

static void take_quaternion_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.quaternion.attitude, sizeof results.quaternion.attitude);
        return;
    }
    take_reals(sum, results.quaternion.attitude, 4);
}

static sat4_status call_state_from_coordinates(void)
{
    results.state_from_coordinates.x = in.x;
    return sat4_state_from_coordinates(in.position, in.angles, in.q_dot, in.q_ddot,
        &results.state_from_coordinates.x, results.state_from_coordinates.V_dot);
}

static void take_state_from_coordinates_results(tally *sum, sat4_status status)
{
    take_state(sum, &results.state_from_coordinates.x);
    if (status < 0) {
        untouched(sum, &results.state_from_coordinates.V_dot, sizeof results.state_from_coordinates.V_dot);
        return;
    }
    take_reals(sum, results.state_from_coordinates.V_dot, 6);
}

static sat4_status call_generalized(void)
{
    return sat4_generalized(&sat4_default, &in.x, in.angles, in.phi_ddot, &results.generalized.out);
}

static void take_generalized_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.generalized.out, sizeof results.generalized.out);
        return;
    }
    take_generalized_result(sum, &results.generalized.out);
}

static sat4_status call_prepare(void)
{
    results.prepare.table = sat4_default;
    return sat4_prepare(&parameters, &results.prepare.table);
}

static void take_prepare_results(tally *sum, sat4_status status)
{
    (void)status;
    take_table(sum, &results.prepare.table);
}

static sat4_status call_mounts(void)
{
    return sat4_mounts(&mounting, &in.x, in.V_dot, in.phi_ddot, results.mounts.mount_wrench);
}

static void take_mounts_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.mounts.mount_wrench, sizeof results.mounts.mount_wrench);
        return;
    }
    take_reals(sum, results.mounts.mount_wrench, 24);
}

static sat4_status call_prepare_mounts(void)
{
    return sat4_prepare_mounts(&parameters, &results.prepare_mounts.mounting);
}

static void take_prepare_mounts_results(tally *sum, sat4_status status)
{
    if (status < 0) {
        untouched(sum, &results.prepare_mounts.mounting, sizeof results.prepare_mounts.mounting);
        return;
    }
    take_mount_table(sum, &results.prepare_mounts.mounting);
}

static sat4_status call_center_of_mass_velocity(void)
{
    return sat4_center_of_mass_velocity(&sat4_default, &in.x,
        results.center_of_mass_velocity.center_of_mass_velocity);
}

static void take_center_of_mass_velocity_results(tally *sum, sat4_status status)
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
            .phi = { -0x1.95dd5cp+3, 0x1.e462ap+3, -0x1.23a78p+1, -0x1.c68578p+2 },
            .phi_dot = { -0x1.cf9e4p+7, -0x1.e0f5dp+6, -0x1.c61c58p+7, -0x1.3c48p+4 },
        },
        .phi_ddot = { -0x1.c4d59p+8, 0x1.d79d24p+8, 0x1.3513p+4, 0x1.29b748p+7 },
        .V_dot = { -0x1.94148p-1, -0x1.f4583p+3, 0x1.9e47c8p+2, -0x1.39c4f8p+3, 0x1.44d50cp+3,
            -0x1.7d815p+2 },
        .tau = { 0x1.e558ecp+0, 0x1.edaa68p+0, 0x1.656c1p-1, 0x1.e86b8p-5 },
        .locked = { 0, 0, 0, 0 },
        .dt = 0x1p-14,
        .order = 4,
        .phi = -0x1.538698p+2,
        .count = 399534,
        .per_turn = 4087,
        .zero = -0x1.92c438p-1,
        .moved = 115,
        .encoder = {
            .counter = -27863,
            .place = 2548,
            .moved = 118,
        },
        .counter = 613,
        .bits = 16,
        .angles = { 0x1.f9388cp-1, -0x1.4d6b8p-6, 0x1.4e6a6cp-1 },
        .position = { 0x1.e7f3ap-2, -0x1.100f98p-1, -0x1.ae09ap+0 },
        .q_dot = { -0x1.b60768p-1, 0x1.06bc6cp+0, -0x1.3b164p-4, 0x1.c0aac8p+0, -0x1.51bd7p-2,
            -0x1.ace304p+0 },
        .q_ddot = { 0x1.76eb1p+1, -0x1.5944dp+1, 0x1.f3e8ep+1, 0x1.35894p+1, 0x1.d3fc6p+2, -0x1.23b5c4p+3 },
        .mass_factor = 0x1.0e78d64p+0,
    },
    {   /* fast flywheels, large phases */
        .x = {
            .position = { 0x1.30188p-3, 0x1.942a08p-1, -0x1.92f53p-1 },
            .attitude = { -0x1.45277acf51a23p-1, -0x1.4e5b0949a3d04p-1, -0x1.3ab008bdc75aap-2,
                0x1.19e85d2a02968p-2 },
            .V = { 0x1.9f33ep+1, 0x1.c06e04p+2, 0x1.6815p-2, -0x1.7e8e7p+0, 0x1.bc58ep+2, -0x1.58a2bp+2 },
            .phi = { 0x1.554cc8p+21, 0x1.55fcep+21, -0x1.9f3ap+16, 0x1.9b4488p+21 },
            .phi_dot = { 0x1.0a9aap+10, -0x1.9c2068p+12, -0x1.9ed4ep+10, -0x1.085ab8p+12 },
        },
        .phi_ddot = { 0x1.968a6p+7, 0x1.cdc694p+8, -0x1.0249c8p+8, -0x1.371e7p+7 },
        .V_dot = { -0x1.214c38p+5, 0x1.4171bp+3, 0x1.82ebap+3, 0x1.0b38ap+4, -0x1.055d68p+5, -0x1.8f2aap+3 },
        .tau = { -0x1.763e6p-3, -0x1.df9aep+0, -0x1.f8caa4p+0, 0x1.3b88ccp+0 },
        .locked = { 0, 0, 1, 0 },
        .dt = 0x1p-14,
        .order = 2,
        .phi = 0x1.d5b01p+21,
        .count = 104605,
        .per_turn = 4003,
        .zero = -0x1.859fdp-1,
        .moved = -321,
        .encoder = {
            .counter = 15529,
            .place = 2197,
            .moved = 224,
        },
        .counter = 21845,
        .bits = 16,
        .angles = { -0x1.67826p-1, 0x1.512658p-2, -0x1.3b3c18p-2 },
        .position = { 0x1.8eec5p-1, -0x1.bb3d38p+0, 0x1.a3f8a8p+0 },
        .q_dot = { 0x1.882d1p-2, 0x1.4d94ap-2, -0x1.c47ac4p+0, 0x1.1746e8p+0, 0x1.037d6p-1, 0x1.a1c0ecp+0 },
        .q_ddot = { -0x1.cf6e3p+3, 0x1.56ea88p+3, 0x1.f688fp+2, -0x1.0f622p+3, 0x1.a26cfp+2, 0x1.df44a8p+3 },
        .mass_factor = 0x1.00b386p+0,
    },
    {   /* out of range */
        .x = {
            .position = { -0x1.23708p+36, 0x1.598328p+39, -0x1.466428p+39 },
            .attitude = { -0x1.7034374fb4193p-2, -0x1.7ebd03999627ap-2, 0x1.be872eddd9d8ep-1,
                0x1.b93655ed7edf7p+0 },
            .V = { -0x1.3d4554p+0, -0x1.07562p-1, 0x1.a063e4p+0, -0x1.bdbb3p+0, 0x1.d98bf4p+0, 0x1.3c586p-2 },
            .phi = { -0x1.ed3ccp+42, 0x1.297088p+42, 0x1.c53fp+39, -0x1.d0ae24p+43 },
            .phi_dot = { -0x1.70a96cp+7, -0x1.49e8p+3, 0x1.70ed48p+6, -0x1.52138p+2 },
        },
        .phi_ddot = { 0x1.26f56p+8, -0x1.28b67p+8, -0x1.7a5978p+7, 0x1.8ab58p+6 },
        .V_dot = { 0x1.b0decp-1, 0x1.7660dcp+3, 0x1.a35e68p+2, -0x1.16ceep+0, 0x1.63ddcp+0, 0x1.e05b2p+0 },
        .tau = { -0x1.68bbep-1, -0x1.cbd33cp+0, -0x1.c483b8p+0, -0x1.ed35p-5 },
        .locked = { 1, 0, 0, 0 },
        .dt = 0x0p+0,
        .order = 2,
        .phi = 0x1.7f7ed8p+42,
        .count = -153524,
        .per_turn = 0,
        .zero = 0x1.7c0718p+39,
        .moved = -504,
        .encoder = {
            .counter = -30383,
            .place = 979,
            .moved = -273,
        },
        .counter = -24139,
        .bits = 16,
        .angles = { 0x1.9703bp+37, -0x1.0a47f8p+38, -0x1.3b6cap+37 },
        .position = { -0x1.997158p+40, 0x1.caa508p+40, 0x1.64ac8p+36 },
        .q_dot = { 0x1.49a318p-1, 0x1.c85dp-3, 0x1.c55c48p-1, 0x1.ebfa1p+0, -0x1.afa2dp-2, -0x1.3dbc3cp+0 },
        .q_ddot = { 0x1.e6041p+3, 0x1.efbb3cp+3, -0x1.fcd4p+1, -0x1.05219cp+3, -0x1.1937p-2, -0x1.0b842cp+3 },
        .mass_factor = -0x1.05fbb88p+0,
    },
};

typedef struct answer {
    int status;
    uint32_t hash;  /* of the status and all outputs */
    int listed;     /* outputs whose numbers are given, at most 32 */
} answer;

static const sat4_real numbers_forward[] =
{
    0x1.000a1557788acp+0, 0x1.a90eb3b17bc6ep-2, -0x1.5b34d2cc3cad7p+1, 0x1.2c90f83739035p+2,
        -0x1.52a2e2033093cp+2, 0x1.0af45ae014c6bp-1,
    -0x1.496984d894471p+5, 0x1.d3e3078eb40a3p+3, 0x1.1094dc9ba95fap+5, 0x1.36f5bbd808ec6p+8,
        0x1.76ef8b4f83315p+7, 0x1.77b015d9d1ae1p+7,
};

static const sat4_real numbers_matrices[] =
{
    0x1.dffffffffffffp+5, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.4e3c2632b8461p-3, 0x1.35a812d8cc4f6p-3, 0x0p+0,
        0x1.dffffffffffffp+5, 0x0p+0, 0x1.4e3c2632b8461p-3, 0x0p+0, 0x1.9ce06834dabddp-3, 0x0p+0, 0x0p+0,
        0x1.dffffffffffffp+5, -0x1.35a812d8cc4f6p-3, -0x1.9ce06834dabddp-3, 0x0p+0, 0x0p+0,
        0x1.4e3c2632b8461p-3, -0x1.35a812d8cc4f6p-3, 0x1.530cc62fceed2p+1, 0x1.f5b29b4b3c14bp-6,
        -0x1.70108fe605c12p-6, -0x1.4e3c2632b8461p-3, 0x0p+0, -0x1.9ce06834dabddp-3, 0x1.f5b29b4b3c14bp-6,
        0x1.3fea5d4acd852p+1, 0x1.838281503a94ap-7, 0x1.35a812d8cc4f6p-3, 0x1.9ce06834dabddp-3,
    0x1.dffffffffffffp+5, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.4e3c406cd9fbap-3, 0x1.35a818eac56dcp-3, 0x0p+0,
        0x1.dffffffffffffp+5, 0x0p+0, 0x1.4e3c406cd9fbap-3, 0x0p+0, 0x1.9cde390480b5ap-3, 0x0p+0, 0x0p+0,
        0x1.dffffffffffffp+5, -0x1.35a818eac56dcp-3, -0x1.9cde390480b5ap-3, 0x0p+0, 0x0p+0,
        0x1.4e3c406cd9fbap-3, -0x1.35a818eac56dcp-3, 0x1.53113109c461ep+1, 0x1.f6aad8bfa3aeep-6,
        -0x1.70c0a415ba6efp-6, -0x1.4e3c406cd9fbap-3, 0x0p+0, -0x1.9cde390480b5ap-3, 0x1.f6aad8bfa3aeep-6,
        0x1.3fe92943b8c75p+1, 0x1.83f5be5a702f3p-7, 0x1.35a818eac56dcp-3, 0x1.9cde390480b5ap-3,
};

static const sat4_real numbers_momentum[] =
{
    0x1.7f57bde24bd04p+6, 0x1.c9b72cbd1f663p+6, 0x1.b0b2288198203p+5, 0x1.99b3ec96c94e2p+2,
        0x1.d9b4b02335b74p-5, -0x1.0de87e69624e5p+2, 0x1.c7e61fb52d548p+4, -0x1.db58b2ec935c8p+3,
        0x1.36f1445f4af54p+7, 0x1.d14b3b3973be2p+7, 0x1.a2d22569abc45p+6, -0x1.e1cc0cac54edp+4,
        0x1.53dad0bea6e47p+10, 0x1.b866d58db61fep-9, -0x1.4a4ce0e74054cp-9, -0x1.64846d02e6b13p-9,
    0x1.815a673772f44p+7, 0x1.a315fcc0e9bcp+8, 0x1.3ec8e84c166b6p+4, 0x1.acbfcc0c12fd2p+5,
        0x1.4a0d3ca0478fp+4, -0x1.0ef91a7fba089p+7, 0x1.ba70fc84c4407p+8, -0x1.7a3f7694af255p+3,
        0x1.06c175e97c26dp+7, 0x1.1a27044373f24p+7, -0x1.cb7a295e78588p+7, -0x1.73eadc4b1ef34p+8,
        0x1.3185ba8e99374p+19, 0x1.b8648115de9fbp-9, -0x1.4a4ce760d2974p-9, -0x1.648488fca43fbp-9,
};

static const sat4_real numbers_torque[] =
{
    -0x1.16bcb3650d251p+3, 0x1.252c5d36d9768p+3, 0x1.32a9575cbd926p-2, 0x1.47595a3de2ab2p+1,
    0x1.c87247bf52fbbp+1, 0x1.044a18a20af49p+3, -0x1.395f2617646aap+2, -0x1.4834ae29c685ap+1,
};

static const sat4_real numbers_coupled[] =
{
    0x1.fe834f9c6d892p-1, 0x1.b2cdb491344e2p-2, -0x1.5cd23b79b9f62p+1, 0x1.8f900a97df163p+0,
        -0x1.ac0d2b17c189fp+2, 0x1.d2a772aac3b7cp-3, 0x1.985ef98a9248dp+6, 0x1.a6658dfc91379p+6,
        0x1.0ba35f194727p+5, -0x1.c80d825cb60bep+0,
    -0x1.495c86b544b83p+5, 0x1.d34db6c27fdeap+3, 0x1.10c790bc1af74p+5, 0x1.37e269039237dp+8,
        0x1.8444f0f802d17p+7, 0x1.8109cf63fcffbp+7, -0x1.9cbc6bb8e39f9p+8, -0x1.1a2b3e0fe03dcp+7, 0x0p+0,
        -0x1.ca6242917895ep+6,
};

static const sat4_real numbers_step[] =
{
    -0x1.779a179f2cf87p-1, 0x1.80b85a987ee0ap+0, -0x1.10f68360ae66ap-4, 0x1.23d5bc0501d52p-1,
        -0x1.2f86cd1081375p-5, -0x1.fa5f05996d5efp-2, -0x1.4f6e3081349dep-1, 0x1.98d1b14cc46e9p+0,
        0x1.e628faa527c54p+0, 0x1.d11379f6c6258p-1, 0x1.f3f5f157b0759p+0, 0x1.45f9ee84797a5p-1,
        0x1.aad469cb68c32p-1, -0x1.0c6379695484p-3, 0x1.481b31ad5a002p+1, -0x1.256d9bd22e8edp+1,
        -0x1.a3cc39fa681a4p-1, -0x1.cf9b0f40a4ac6p+7, -0x1.e0ef366b774d9p+6, -0x1.c61b4c5d5bb96p+7,
        -0x1.3c4871f634daap+4,
    0x1.3105b2f231a03p-3, 0x1.94284faaa5d5fp-1, -0x1.92e3c196a2ff5p-1, -0x1.451ce3d6a3b11p-1,
        -0x1.4e584d155b905p-1, -0x1.3af2b503a647ep-2, 0x1.19dbbc80b342dp-2, 0x1.9ee18f7507773p+1,
        0x1.c07cc7e5fbb0fp+2, 0x1.6a33aba8b18a3p-2, -0x1.79ab53ab1c4c1p+0, 0x1.bd1a87524de3ap+2,
        -0x1.57e1f677ab4a2p+2, -0x1.ba617d30943f2p-2, -0x1.eab2ab876f2e1p+0, 0x1.a7ceccbe1124bp-1,
        -0x1.069ecfc22b6c2p+1, 0x1.0a9902eb14861p+10, -0x1.9c208b1dc7b8p+12, -0x1.9ed4ep+10,
        -0x1.085ad4dfc3b68p+12,
};

static const sat4_real numbers_step_driven[] =
{
    -0x1.779a179f6a7dp-1, 0x1.80b85a98898e5p+0, -0x1.10f683605be25p-4, 0x1.23d5bc0d006c1p-1,
        -0x1.2f86cbc92c42ep-5, -0x1.fa5f05ad61bccp-2, -0x1.4f6e3073e04cep-1, 0x1.98d1b4689baaep+0,
        0x1.e628f0f8e275bp+0, 0x1.d113939118d3bp-1, 0x1.f4027c3f20d1p+0, 0x1.46051b5eed609p-1,
        0x1.aad6c32e41045p-1, -0x1.0c640424af9eep-3, 0x1.481b37656949fp+1, -0x1.256d9c0abb4p+1,
        -0x1.a3cc30902f33ep-1, -0x1.cfac66ac8p+7, -0x1.e0d8562dcp+6, -0x1.c61bbd768p+7, -0x1.3c22c917p+4,
    0x1.3105b2f2c0da5p-3, 0x1.94284fab096cap-1, -0x1.92e3c19659f94p-1, -0x1.451ce3e192715p-1,
        -0x1.4e584cf67b63fp-1, -0x1.3af2b4f4d5a74p-2, 0x1.19dbbcf1505bcp-2, 0x1.9ee18bc2ab3b3p+1,
        0x1.c07cccb38b6b9p+2, 0x1.6a3344541fa33p-2, -0x1.79af1a72586ffp+0, 0x1.bd13df29645b9p+2,
        -0x1.57e6a5642e669p+2, -0x1.ba61303060c8p-2, -0x1.eab298b08d95dp+0, 0x1.a7cebc9974a4bp-1,
        -0x1.069ed06606099p+1, 0x1.0a9b6b453p+10, -0x1.9c1ff48e5bp+12, -0x1.9ed5e249c8p+10,
        -0x1.085adee3cep+12,
};

static const sat4_real numbers_wrap[] =
{
    0x1.f4c8ea22168c2p-1,
    -0x1.39dc7288ed032p+1,
};

static const sat4_real numbers_phase_of_counts[] =
{
    -0x1.861b1193a76cp+0,
    0x1.a821e97eaa077p-1,
};

static const sat4_real numbers_speed_of_counts[] =
{
    0x1.6a142831f01f5p+11,
    -0x1.01f85490d5becp+13,
};

static const sat4_real numbers_accumulate[] =
{
    0.0
};

static const sat4_real numbers_forward_jacobian[] =
{
    -0x1.87ffec6d9dddcp-62, 0x1.aad298p-1, -0x1.462f7p-1, -0x1.58a85c46874cbp-8, -0x1.cd53505a4d7ccp-1,
        0x1.e865ad24fad5dp+0, -0x1.aad298p-1, 0x1.40712192a960ap-58, 0x1.f3efb40000001p+0,
        0x1.ca0316c983db7p-1, -0x1.bcfe93827edfp-7, -0x1.993475b0360acp+0, 0x1.462f7p-1,
        -0x1.f3efb40000001p+0, 0x1.5c66ad1b482d8p-59, -0x1.ec02b10d7516ap+0, 0x1.9a1d2aba915eap+0,
        -0x1.14e5ec5c5f56ep-7, 0x1.191ff4bf1e50ep-57, -0x1.234d57de13998p-50, -0x1.33162a2d5bbffp-50,
        0x1.9511cdba6a732p-5, 0x1.4e2b2aa2431b9p+1, -0x1.3fddceb2f220dp-2, -0x1.65312b053cccap-51,
        0x1.d887fe574502ep-56, 0x1.b0d5e052b26cap-50, -0x1.6d0c86f64d4cep+1, -0x1.fe66fb7b9bp-6,
        -0x1.9c79b56ce5c86p-1, -0x1.3596a59923e5p-51, -0x1.1170fd0e611a4p-51,
    -0x1.5f4ecde3f825p-63, -0x1.58a2bp+2, -0x1.bc58ep+2, -0x1.07638f67bee2p-3, -0x1.81ad98e90dfa1p-2,
        0x1.b9f7e1d96af6dp+2, 0x1.58a2bp+2, 0x1.7da4b9eab0e72p-58, -0x1.7e8e7p+0, 0x1.5a72165566a5cp-2,
        -0x1.d0129051461cep-3, -0x1.9a2da0e8e826cp+1, 0x1.bc58ep+2, 0x1.7e8e7p+0, -0x1.5b4f7006c10c8p-58,
        -0x1.c951b89014db3p+2, 0x1.a79cff0c153c1p+1, -0x1.7e156f822a0d8p-5, -0x1.7b703842533ap-54,
        0x1.7126f1a4fb433p-52, -0x1.fe0eb4129991dp-48, 0x1.8a7f369a8dc28p-2, 0x1.77b5c245213f9p+5,
        0x1.469ac00610e23p+1, -0x1.3166af6a0bb1cp-51, -0x1.6c36f9c04cf7ep-55, 0x1.199ab4f9536b2p-48,
        -0x1.8a798ea7294aap+5, -0x1.7436f724c116cp-2, -0x1.67f380b61d438p+4, -0x1.279b596c7b337p-51,
        -0x1.03346f6208736p-49,
};

static const sat4_real numbers_coupled_jacobian[] =
{
    -0x1.3037fc907ae1p-62, 0x1.aad298p-1, -0x1.462f7p-1, -0x1.5f03800038bf7p-8, -0x1.cd5641dee33b1p-1,
        0x1.e8643ab20e9dbp+0, -0x1.aad298p-1, 0x1.40c2abb34de4bp-58, 0x1.f3efb3fffffffp+0,
        0x1.c9ffc99623191p-1, -0x1.c0285929bfac1p-7, -0x1.9933e18dd3bacp+0, 0x1.462f7p-1,
        -0x1.f3efb40000001p+0, 0x1.6a8618383a02p-59, -0x1.ec09048d6c39bp+0, 0x1.9a213491d8ff8p+0,
        -0x1.160f6e359f42p-7, 0x1.3ad1540ac5498p-59, -0x1.20051331a4b9dp-50, -0x1.31bd7cc2440f4p-50,
        0x1.9cb0c09ed17fep-5, 0x1.516afe3abd81ap+1, -0x1.42e4428e1922bp-2, -0x1.624af6e1fad6ep-51,
        0x1.0cbe4f127a27cp-56, 0x1.b808d93c91d8ap-50, -0x1.70d0b30d31abfp+1, -0x1.04ed7a4e86bd2p-5,
        -0x1.a0beb223cfb3fp-1, -0x1.4376803213a98p-51, -0x1.177e5f27b7e99p-51,
    -0x1.6275d47414518p-61, -0x1.58a2b00000001p+2, -0x1.bc58e00000001p+2, -0x1.08bf24be2457p-3,
        -0x1.82d66f4e29066p-2, 0x1.b9f23a6d04b7dp+2, 0x1.58a2affffffffp+2, 0x1.7a1cface95986p-58,
        -0x1.7e8e7p+0, 0x1.5aa09cbef3a38p-2, -0x1.d4fe2a8cf8732p-3, -0x1.9a2dec2728d48p+1, 0x1.bc58ep+2,
        0x1.7e8e700000001p+0, -0x1.748bd645034d5p-58, -0x1.c961dd6a7bd3dp+2, 0x1.a7b81c21c3149p+1,
        -0x1.8183d96a7c7f4p-5, 0x1.970e17785a95fp-54, 0x1.947a285e084d3p-52, -0x1.0225297b420acp-47,
        0x1.045dd5284565ap-1, 0x1.7b00a099e6bcfp+5, 0x1.502e35ebc97c3p+1, -0x1.6992d94c906b7p-51,
        -0x1.042e63e4e5d3ap-53, 0x1.16f0adcc37728p-48, -0x1.8d8e92154e9b3p+5, -0x1.b4112c0966edcp-2,
        -0x1.6ad71086b907bp+4, -0x1.f9d184352436ap-52, -0x1.04b9d17234ab2p-49,
};

static const sat4_real numbers_inverse[] =
{
    -0x1.1b7961b1a500cp+26, 0x1.1b793d1bb69e7p+26, -0x1.1b7b0e20f12fap+26, 0x1.1b7caf9bbb8acp+26,
        0x1.264720cb39e87p+6, 0x1.03db7e0ec8176p+10, -0x1.bb4d14a3d503p+7, 0x1.b1978000cp+1, 0x1.17b8f032p-1,
        0x1.d6c2a6fdp+1, 0x1.bd4cf6f0cd543p-4, 0x1.9df56e3d4a129p-4, 0x1.912d1c4dc66p-4,
        0x1.1da02f9a7bf4bp-19, 0x0p+0, 0x1.11e039d23e1bep-1, 0x1.e3aefb870a5acp+2, -0x1.9c9148a75536cp+0,
        0x1.93880699f7c74p-6, 0x1.04545e61f4b1cp-8, 0x1.b61f80c09342ep-6,
    0x1.be9ee6ada8b0fp+27, -0x1.be877363ed8dfp+27, 0x1.be8106833970cp+27, -0x1.be8464a6d0b7fp+27,
        -0x1.9a0c126be8e6ap+5, 0x1.308e8d724a98ep+7, 0x1.3c695020e9191p+10, -0x1.63417f69p+1,
        -0x1.07930f54p+2, 0x1.87ba321p-2, 0x1.bd4fedf1932bdp-4, 0x1.9df6e44cddadbp-4, 0x1.9129bf5ec18d4p-4,
        0x1.64863e67e0bb8p-21, 0x0p+0, -0x1.3eaa79f9016ecp-2, 0x1.d95e91243d7d1p-1, 0x1.ebcb76563ca8ep+2,
        -0x1.1415cce18f3f3p-6, -0x1.99abc0f519c97p-6, 0x1.306dc398a97dap-9,
};

static const sat4_real numbers_inverse_fast[] =
{
    -0x1.1b795dccbf33fp+26, 0x1.1b793936cd8dcp+26, -0x1.1b7b0a3c03d5ep+26, 0x1.1b7cabb6d10e9p+26,
    0x1.be9ecf9c5ca5cp+27, -0x1.be875c52b1ba6p+27, 0x1.be80ef71ec6a7p+27, -0x1.be844d9580e86p+27,
};

static const sat4_real numbers_points[] =
{
    -0x1.ac22be1e126eep-1, 0x1.b015d9a907a4bp+0, 0x1.6edf94c8925acp-4, 0x1.73e03e191f0fcp-4,
        0x1.b4642fa1014ebp-1, -0x1.07b720737a69dp-1, -0x1.17622e6d4d739p-1, 0x1.e6a29d8df443cp-2,
        0x1.61642a45c6eap-1, 0x1.aa87bd625342bp-1, 0x1.bf4502ef4b5acp-3, 0x1.04378628d168fp-1,
        0x1.18b98843cacp+1, 0x1.5c777b181f4c4p-2, 0x1.f927fa3d70a42p-1, 0x1.01407fafc5cdp+1,
        -0x1.b2e735bb92084p-2, 0x1.aad2980000003p-1, -0x1.5bfba51d70076p+2, -0x1.910624fa78bd6p+3,
        0x1.ec9042d707512p+2, -0x1.b543c29e9d4dap+1, 0x1.b632997706ab4p+3, -0x1.7d81500000003p+2,
    0x1.7e0093494cddp-3, 0x1.0f21a74f15333p-1, -0x1.8b001b181d765p-1, 0x1.e4b581ba8c9b3p-1,
        0x1.48590bd7288e7p-2, 0x1.f809980cf9d66p-6, 0x1.5c645885be37dp-5, -0x1.e765f15983efdp-6,
        -0x1.ff4f59f8849aep-1, -0x1.46f7da039caaap-2, 0x1.e4b9c2cf3508ap-1, -0x1.566c03b26b683p-5,
        0x1.08369c2223092p+3, 0x1.e2db068be3787p+1, 0x1.2adf7d70a3d73p-2, 0x1.16b20505265cp+1,
        0x1.b0a2af2724751p+2, -0x1.58a2b00000003p+2, -0x1.a350ad1004fb8p+3, -0x1.2145978f03919p+4,
        -0x1.16bbc6c95f232p+5, -0x1.df1cc95e21c18p+0, -0x1.252766dd52e52p+5, -0x1.8f2aa00000003p+3,
};

static const sat4_real numbers_quaternion[] =
{
    0x1.aa4a340f19d19p-1, 0x1.25fbc92e62904p-2, 0x1.25c321255aaafp-3, 0x1.ce42528bd4593p-2,
    0x1.d915e09ab5108p-1, -0x1.6193d7dd721a4p-4, 0x1.a1f4cfb3e2f8cp-3, -0x1.3f242baf00b94p-2,
};

static const sat4_real numbers_state_from_coordinates[] =
{
    0x1.e7f3ap-2, -0x1.100f98p-1, -0x1.ae09ap+0, 0x1.aa4a340f19d19p-1, 0x1.25fbc92e62904p-2,
        0x1.25c321255aaafp-3, 0x1.ce42528bd4593p-2, 0x1.88010a02f35bp-2, 0x1.edf30e4d09bfdp-1,
        -0x1.b0985ff9914c8p-1, -0x1.a3c1c31587097p+0, 0x1.9b14e61f53cd6p-1, 0x1.978e137457a19p+0,
        -0x1.95dd5cp+3, 0x1.e462ap+3, -0x1.23a78p+1, -0x1.c68578p+2, -0x1.cf9e4p+7, -0x1.e0f5dp+6,
        -0x1.c61c58p+7, -0x1.3c48p+4, 0x1.a89c20d45efb1p+0, 0x1.1dd29e0c17c3p-5, 0x1.d8ea47b774632p+2,
        -0x1.0fa43a0213ec1p+3, 0x1.26897d38d5a11p+2, -0x1.3010d51448adcp+0,
    0x1.8eec5p-1, -0x1.bb3d38p+0, 0x1.a3f8a8p+0, 0x1.d915e09ab5108p-1, -0x1.6193d7dd721a4p-4,
        0x1.a1f4cfb3e2f8cp-3, -0x1.3f242baf00b94p-2, 0x1.4c52e8692f514p-1, 0x1.f169147716c9ap-1,
        -0x1.6b1966648440bp+0, 0x1.47746083d339ap+0, 0x1.5c8b1803b4afcp-3, 0x1.232a5782827c8p+0,
        0x1.554cc8p+21, 0x1.55fcep+21, -0x1.9f3ap+16, 0x1.9b4488p+21, 0x1.0a9aap+10, -0x1.9c2068p+12,
        -0x1.9ed4ep+10, -0x1.085ab8p+12, -0x1.234575a82184dp+4, -0x1.0a3d6540fc794p+2, 0x1.bb0aaf36db36p-5,
        0x1.1322e1e32249p+4, 0x1.52512b35b424ap+3, -0x1.875baeb45907bp+2,
    -0x1.23708p+36, 0x1.598328p+39, -0x1.466428p+39, -0x1.7034374fb4193p-2, -0x1.7ebd03999627ap-2,
        0x1.be872eddd9d8ep-1, 0x1.b93655ed7edf7p+0, -0x1.3d4554p+0, -0x1.07562p-1, 0x1.a063e4p+0,
        -0x1.bdbb3p+0, 0x1.d98bf4p+0, 0x1.3c586p-2, -0x1.ed3ccp+42, 0x1.297088p+42, 0x1.c53fp+39,
        -0x1.d0ae24p+43, -0x1.70a96cp+7, -0x1.49e8p+3, 0x1.70ed48p+6, -0x1.52138p+2,
};

static const sat4_real numbers_generalized[] =
{
    0x1.1a419f4e7869dp-1, 0x1.ab0b55883a79bp-1, 0x1.4d659bd0cbp-6, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.56b505010e943p-1, 0x1.b5d91d5c2b14cp-2, 0x1.371361c707286p-1, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.fe023509c127cp-2, -0x1.64eda32199115p-2, 0x1.9687e78c3c88cp-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.4d659bd0cb012p-6, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.371361c707285p-1,
        0x1.969d754af8bedp-1, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.71e33e1518d3cp-1, -0x1.38ecacea7c5dap-1, -0x1.4b175fe1fe8aap-2, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.14d86dc3f5084p-1, 0x1.94e7d14699957p-1, -0x1.259cdf70069b9p-2, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.b949aba93434p-2, 0x1.08ba893f66ae8p-5, 0x1.cdb8a458eca64p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, -0x1.4b175fe1fe8a9p-2, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.259cdf70069b9p-2,
        0x1.e7ee160420058p-1, 0x0p+0, 0x0p+0, 0x0p+0,
};

static const sat4_real numbers_prepare[] =
{
    0x1.fb2291b800001p+5, 0x1.0274b06a65065p-6, 0x1.b4379f2ca57a8p-3, -0x1.4729b7617c1bcp-3,
        -0x1.6120d63055329p-3, 0x1.663af7d71e938p+1, 0x1.51fe1e93b44e5p+1, 0x1.23bb073905965p+1,
        0x1.08e3434d55f42p-5, -0x1.8414bf377c6e2p-6, 0x1.9904fc1ae8b98p-7, -0x1.2cd077c7d7a98p-20,
        0x1.2cd077c7d7a98p-20, 0x0p+0, -0x1.5b59b826663d3p-21, -0x1.5b59b826663d3p-21, 0x1.5b59b826663d3p-20,
        0x1.7e5e51b65789p-22, -0x1.26212b29cd2e4p-23, -0x1.d69b7842e1e3bp-23, 0x1.d69b7842e1e3cp-24,
        -0x1.362c4971e6561p-23, 0x1.2b7a3541d590bp-25, -0x1.21756ecaaa886p-21, -0x1.56b818ae6bb3cp-23,
        -0x1.31ab1cee97691p-22, 0x1.31ab1cee97691p-23, -0x1.364cbc6691f27p-22, -0x1.aa154f1e095c2p-24,
        -0x1.3632ee58a3354p-16, -0x1.3632ee58a3354p-16, 0x1.3632ee58a3356p-15,
    0x1.e1509b4000001p+5, 0x1.1052191e87924p-6, 0x1.9e01ff06f6946p-3, -0x1.36817f4538ef4p-3,
        -0x1.4f262ff972473p-3, 0x1.53fdd19976a14p+1, 0x1.40c8bf2848beap+1, 0x1.14e0a1d47e49cp+1,
        0x1.f6cd780a6838cp-6, -0x1.705286900749ap-6, 0x1.8431da7be1f8cp-7, -0x1.1d7facc4dc6bp-20,
        0x1.1d7facc4dc6bp-20, 0x0p+0, -0x1.49aa60a5e7a83p-21, -0x1.49aa60a5e7a83p-21, 0x1.49aa60a5e7a83p-20,
        0x1.6ae68e3d5c714p-22, -0x1.1727811b822fcp-23, -0x1.bea59b5f36b2fp-23, 0x1.bea59b5f36b2dp-24,
        -0x1.2661837ec1246p-23, 0x1.1c3ad73c972bep-25, -0x1.12b8a5df96618p-21, -0x1.45451e818f3c3p-23,
        -0x1.221b0d5ecbdbcp-22, 0x1.221b0d5ecbdbap-23, -0x1.26804f832447cp-22, -0x1.9463c50fc6d52p-24,
        -0x1.2667d1cc10154p-16, -0x1.2667d1cc10154p-16, 0x1.2667d1cc10155p-15,
    0x1.dffffffffffffp+5, 0x1.1111111111112p-6, 0x1.9ce075f6fd22p-3, -0x1.35a858793dd98p-3,
        -0x1.4e3bcd35a8588p-3, 0x1.53100be6be0fap+1, 0x1.3fe86833c6002p+1, 0x1.141eff9f87f02p+1,
        0x1.f56dd5c670923p-6, -0x1.6f50f0b35be28p-6, 0x1.83225ecf993p-7, -0x1.1cb8031264f2cp-20,
        0x1.1cb8031264f2cp-20, 0x0p+0, -0x1.48c3d3a26c4f6p-21, -0x1.48c3d3a26c4f6p-21, 0x1.48c3d3a26c4f6p-20,
        0x1.69e8c30d24282p-22, -0x1.166447452f814p-23, -0x1.bd6d3ed518ceep-23, 0x1.bd6d3ed518cefp-24,
        -0x1.2593a398162b4p-23, 0x1.1b7410b6270f2p-25, -0x1.11f885b204ecdp-21, -0x1.4461a4707884fp-23,
        -0x1.21502ae0da316p-22, 0x1.21502ae0da316p-23, -0x1.25b25a12cdfbep-22, -0x1.9348f5f39cc0fp-24,
        -0x1.2599ed7c6fbfep-16, -0x1.2599ed7c6fbfep-16, 0x1.2599ed7c6fcp-15,
};

static const sat4_real numbers_mounts[] =
{
    -0x1.13cd3a974e5a7p+4, -0x1.afccbfb1478f8p+4, 0x1.12fc7956dd5dp+5, -0x1.16bcb3650d251p+3,
        0x1.ce958cf7394d5p+0, -0x1.0b5c941f63a02p+2, -0x1.f44a9aa0ceef7p+2, 0x1.fc2da6bc6daa4p+4,
        0x1.09d0bc1f016fbp+5, 0x1.252c5d36d976ap+3, -0x1.684cdac8940b9p+1, -0x1.17a5fc6d25558p+2,
        0x1.54f1f367ee892p+5, 0x1.51e07c8806bdbp+4, 0x1.c139bc147bca4p+1, 0x1.32a9575cbd933p-2,
        -0x1.ef634fbc11734p+2, 0x1.02225cb56d4c2p+2, 0x1.fae4eafdc4067p+4, -0x1.175f7515c1fa6p+5,
        0x1.715895f9e9e36p+2, 0x1.47595a3de2aaep+1, -0x1.7a473d86065cp-5, 0x1.69840793414e1p-1,
    -0x1.1a094c4ce1b64p+5, -0x1.82afb34c0344bp+3, -0x1.1560337adaec9p+4, 0x1.c87247bf52fc3p+1,
        -0x1.0e52ccea62e98p+7, -0x1.eaa4cb9a4f918p+6, -0x1.cf4b12e6d6448p+5, -0x1.45c4c8a846c8ep+6,
        -0x1.34fbe577a5d3ap+3, 0x1.044a18a20af49p+3, 0x1.ebbbb1793608bp+9, -0x1.df069a4897b4bp+8,
        -0x1.96f362b1cc511p+5, 0x1.5ea08babebe52p+4, -0x1.1d2a63a8c80abp+4, -0x1.395f2617646a8p+2,
        0x1.1c2e30ce1425cp+6, -0x1.7b6bbcdcbfff2p+7, -0x1.ef6f1d83534f4p+3, 0x1.baf7288704c8p+3,
        -0x1.19e41d848bb95p+5, -0x1.4834ae29c685bp+1, 0x1.3a7ecfd622c6ap+6, 0x1.321b3acd2fee3p+8,
};

static const sat4_real numbers_prepare_mounts[] =
{
    0x1.4491011999999p+1, 0x0p+0, 0x1.a96a6b723ee1cp-20, 0x0p+0, 0x1.4a9b915036439p-6, 0x1.6ba722d8d36b4p-7,
        0x1.6f49bba3dd54ep-7, -0x1.134cb15905a9ep-76, -0x1.f327884f6f54p-23, 0x0p+0, 0x1.c28f5c28f5c29p-4,
        0x1.c28f5c28f5c29p-4, -0x1.47ae147ae147bp-4, 0x1.279a74590331dp-1, -0x1.6a09e667f3bccp-1,
        -0x1.a20bd700c2c3ep-2, 0x1.279a74590331dp-1, 0x1.6a09e667f3bccp-1, -0x1.a20bd700c2c3ep-2,
        0x1.279a74590331dp-1, 0x0p+0, 0x1.a20bd700c2c3ep-1, 0x1.4491011999999p+1, 0x0p+0,
        0x1.230060e92cc98p-21, 0x1.8fc28f17f9994p-20, 0x1.4a9b915036439p-6, 0x1.6ba722d8d36b4p-7,
        0x1.6f49bba3dd54ep-7, -0x1.d50d3e154dd2ap-23, 0x1.5571158c78d1p-24, 0x0p+0,
    0x1.340aa0ccccccdp+1, 0x0p+0, 0x1.93c194c016053p-20, 0x0p+0, 0x1.39c67336e71cep-6, 0x1.59234f5232d2bp-7,
        0x1.5c9686c79702fp-7, -0x1.05487509e0dc7p-76, -0x1.d9bd96a3f0e08p-23, 0x0p+0, 0x1.c28f5c28f5c29p-4,
        0x1.c28f5c28f5c29p-4, -0x1.47ae147ae147bp-4, 0x1.279a74590331dp-1, -0x1.6a09e667f3bccp-1,
        -0x1.a20bd700c2c3ep-2, 0x1.279a74590331dp-1, 0x1.6a09e667f3bccp-1, -0x1.a20bd700c2c3ep-2,
        0x1.279a74590331dp-1, 0x0p+0, 0x1.a20bd700c2c3ep-1, 0x1.340aa0ccccccdp+1, 0x0p+0,
        0x1.142f7c4bf9851p-21, 0x1.7b681d700e513p-20, 0x1.39c67336e71cep-6, 0x1.59234f5232d2bp-7,
        0x1.5c9686c79702fp-7, -0x1.bd2ba7a9068f1p-23, 0x1.440ec1a0d2d97p-24, 0x0p+0,
};

static const sat4_real numbers_center_of_mass_velocity[] =
{
    0x1.e64acc7cfd271p-2, -0x1.fb094762bf524p-3, 0x1.4bac04a9e98e4p+1,
    0x1.d7effc4959de6p+2, -0x1.9376e4e2dcf4bp-3, 0x1.1845d31b2f188p+1,
};

typedef struct function {
    const char *name;
    size_t size;  /* of its results, bytes */
    sat4_status (*call)(void);
    void (*take)(tally *sum, sat4_status status);
    const sat4_real *numbers;
    answer answers[CASES];
    uint32_t swept;  /* hash of the first SWEPT states of a sweep */
} function;

static const function functions[FUNCTIONS] =
{
    { "forward", sizeof results.forward,
      call_forward, take_forward_results, numbers_forward,
      { { 0, 0x0c4c5adbu, 6 }, { 0, 0xdfda1f05u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x011f6d54u },
    { "matrices", sizeof results.matrices,
      call_matrices, take_matrices_results, numbers_matrices,
      { { 0, 0x3d3535c3u, 32 }, { 0, 0x0bb27280u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xc4e7e296u },
    { "momentum", sizeof results.momentum,
      call_momentum, take_momentum_results, numbers_momentum,
      { { 0, 0x69737d59u, 16 }, { 0, 0xeb9b72ecu, 16 }, { -2, 0x8e5b0aa0u, 0 } },
      0x8062f212u },
    { "torque", sizeof results.torque,
      call_torque, take_torque_results, numbers_torque,
      { { 0, 0x4a5512f2u, 4 }, { 0, 0x4fb735a1u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0xda4dcef4u },
    { "coupled", sizeof results.coupled,
      call_coupled, take_coupled_results, numbers_coupled,
      { { 0, 0xf32c8989u, 10 }, { 0, 0xed761a84u, 10 }, { -2, 0x8e5b0aa0u, 0 } },
      0xd93520cbu },
    { "step", sizeof results.step,
      call_step, take_step_results, numbers_step,
      { { 0, 0x4623e42bu, 21 }, { 0, 0x5863eaecu, 21 }, { -2, 0x8e5b0aa0u, 0 } },
      0x226a3b26u },
    { "step_driven", sizeof results.step_driven,
      call_step_driven, take_step_driven_results, numbers_step_driven,
      { { 0, 0xe89b274bu, 21 }, { 0, 0x64c3adc7u, 21 }, { -2, 0x8e5b0aa0u, 0 } },
      0x37bf39b9u },
    { "wrap", sizeof results.wrap,
      call_wrap, take_wrap_results, numbers_wrap,
      { { 0, 0x34ef7e98u, 1 }, { 0, 0x1e63efeeu, 1 }, { -2, 0x8e5b0aa0u, 0 } },
      0x13690883u },
    { "phase_of_counts", sizeof results.phase_of_counts,
      call_phase_of_counts, take_phase_of_counts_results, numbers_phase_of_counts,
      { { 0, 0x53ece381u, 1 }, { 0, 0x9985027au, 1 }, { -5, 0x2107376du, 0 } },
      0x69e412fdu },
    { "speed_of_counts", sizeof results.speed_of_counts,
      call_speed_of_counts, take_speed_of_counts_results, numbers_speed_of_counts,
      { { 0, 0xd327e29au, 1 }, { 0, 0xcec42066u, 1 }, { -5, 0x2107376du, 0 } },
      0xaf1b666eu },
    { "accumulate", sizeof results.accumulate,
      call_accumulate, take_accumulate_results, numbers_accumulate,
      { { 0, 0xe445cbdbu, 0 }, { 0, 0x6528e023u, 0 }, { -5, 0x3766982cu, 0 } },
      0x77ab77cdu },
    { "forward_jacobian", sizeof results.forward_jacobian,
      call_forward_jacobian, take_forward_jacobian_results, numbers_forward_jacobian,
      { { 0, 0x95573716u, 32 }, { 0, 0xdfdde713u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xf842bf7fu },
    { "coupled_jacobian", sizeof results.coupled_jacobian,
      call_coupled_jacobian, take_coupled_jacobian_results, numbers_coupled_jacobian,
      { { 0, 0x648e393fu, 32 }, { 0, 0xfcb21a61u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x3a5f669fu },
    { "inverse", sizeof results.inverse,
      call_inverse, take_inverse_results, numbers_inverse,
      { { 8, 0xa03a969fu, 21 }, { 8, 0x44c7449bu, 21 }, { -2, 0x8e5b0aa0u, 0 } },
      0xba078ed8u },
    { "inverse_fast", sizeof results.inverse_fast,
      call_inverse_fast, take_inverse_fast_results, numbers_inverse_fast,
      { { 0, 0xe74cfe48u, 4 }, { 0, 0x76db4c37u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0xa1c15d0du },
    { "points", sizeof results.points,
      call_points, take_points_results, numbers_points,
      { { 0, 0xb822e313u, 24 }, { 0, 0x784a950fu, 24 }, { -2, 0x8e5b0aa0u, 0 } },
      0xa21f165fu },
    { "quaternion", sizeof results.quaternion,
      call_quaternion, take_quaternion_results, numbers_quaternion,
      { { 0, 0x2b4cc305u, 4 }, { 0, 0x7015cbd0u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0x2d84727du },
    { "state_from_coordinates", sizeof results.state_from_coordinates,
      call_state_from_coordinates, take_state_from_coordinates_results, numbers_state_from_coordinates,
      { { 0, 0xa7ba7446u, 27 }, { 0, 0xbd899780u, 27 }, { -2, 0x10c8be56u, 21 } },
      0x5440b662u },
    { "generalized", sizeof results.generalized,
      call_generalized, take_generalized_results, numbers_generalized,
      { { 0, 0x3b894d02u, 32 }, { 0, 0xdff42c2eu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xa091c159u },
    { "prepare", sizeof results.prepare,
      call_prepare, take_prepare_results, numbers_prepare,
      { { 0, 0xefa4b08eu, 32 }, { 0, 0xfb0f32beu, 32 }, { -2, 0x01eae4eau, 32 } },
      0xdaa86bc4u },
    { "mounts", sizeof results.mounts,
      call_mounts, take_mounts_results, numbers_mounts,
      { { 0, 0x9f3a3916u, 24 }, { 0, 0xcd15415du, 24 }, { -2, 0x8e5b0aa0u, 0 } },
      0x49091d40u },
    { "prepare_mounts", sizeof results.prepare_mounts,
      call_prepare_mounts, take_prepare_mounts_results, numbers_prepare_mounts,
      { { 0, 0xff6f2446u, 32 }, { 0, 0x96411fe2u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xb71ae01fu },
    { "center_of_mass_velocity", sizeof results.center_of_mass_velocity,
      call_center_of_mass_velocity, take_center_of_mass_velocity_results, numbers_center_of_mass_velocity,
      { { 0, 0x2684d1adu, 3 }, { 0, 0xf3c246b9u, 3 }, { -2, 0x8e5b0aa0u, 0 } },
      0x3a73855au },
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
static sat4_real draw_real(uint32_t *seed, sat4_real largest)
{
    const int32_t part = (int32_t)(draw_word(seed) >> 8) - 8388608;
    return largest * ((sat4_real)part / 8388608.0);
}

static void draw_reals(uint32_t *seed, sat4_real *values, int count, sat4_real largest)
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
static void draw_attitude(uint32_t *seed, sat4_real attitude[4], int refused)
{
    const uint32_t word = draw_word(seed);
    const int32_t a = 2 * (int32_t)(word >> 25) - 127;  /* odd: not all are 0 */
    const int32_t b = (int32_t)((word >> 16) & 0xffu) - 128;
    const int32_t c = (int32_t)((word >> 8) & 0xffu) - 128;
    const int32_t d = (int32_t)(word & 0xffu) - 128;
    const sat4_real norm = (sat4_real)(a * a + b * b + c * c + d * d);
    const sat4_real factor = refused != 0 ? 2.0 : 1.0;
    attitude[0] = factor * ((sat4_real)(a * a - b * b - c * c - d * d) / norm);
    attitude[1] = factor * ((sat4_real)(2 * a * b) / norm);
    attitude[2] = factor * ((sat4_real)(2 * a * c) / norm);
    attitude[3] = factor * ((sat4_real)(2 * a * d) / norm);
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
static sat4_real draw_step(const uint32_t *seed)
{
    (void)seed;
    return 0x1p-14;
}

static sat4_real draw_factor(uint32_t *seed, sat4_real largest)
{
    return 1.0 + draw_real(seed, largest);
}

static void draw_inputs(uint32_t *seed, unsigned long state)
{
    const sat4_real fast = state % 4ul == 3ul ? 32.0 : 1.0;
    const int refused = state % 16ul == 15ul ? 1 : 0;
    draw_reals(seed, in.x.position, 3, 2.0);
    draw_attitude(seed, in.x.attitude, refused);
    draw_reals(seed, in.x.V, 6, 2.0);
    draw_reals(seed, in.x.phi, SAT4_N, 16.0 * fast);
    draw_reals(seed, in.x.phi_dot, SAT4_N, 256.0 * fast);
    draw_reals(seed, in.phi_ddot, SAT4_N, 512.0);
    draw_reals(seed, in.V_dot, 6, 16.0);
    draw_reals(seed, in.tau, SAT4_N, 2.0);
    draw_flags(seed, in.locked, SAT4_N);
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
    parameters = sat4_default_parameters;
    parameters.carrier.mass = parameters.carrier.mass * in.mass_factor;
    for (int i = 0; i < 6; ++i) {
        parameters.carrier.inertia[i] = parameters.carrier.inertia[i] * in.mass_factor;
    }
    for (int i = 0; i < SAT4_N; ++i) {
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
    sat4_status found;
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
    const sat4_real *numbers = f->numbers;
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
int sat4_selftest(void (*print)(const char *text), unsigned long sweep)
{
    int failures = 0;
    length = 0u;
    (void)sat4_prepare_mounts(&sat4_default_parameters, &mounting);
    add_text("mahovik selftest sat4 structure 60e5c883 physics 347c0b3b real double");
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

#ifndef SAT4_SELFTEST_NO_MAIN
static void print_text(const char *text)
{
    (void)fputs(text, stdout);
}

int main(void)
{
    return sat4_selftest(print_text, SAT4_SELFTEST_SWEEP) != 0;
}
#endif
