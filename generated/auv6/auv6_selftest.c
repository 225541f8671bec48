/* auv6_selftest.c: does auv6.c give the right bits on this machine?
 * mahovik 0.1.0; structure 192ea446, physics 002b2abc. Generated: change the stand file instead.
 *
 * Compile it with auv6.c as firmware is compiled (-std=c99 -ffp-contract=off; -fno-tree-vectorize as well by gcc
 * for x86-64 with FMA and for a Cortex-M55, or bits differ) and run it; on a board, define
 * AUV6_SELFTEST_NO_MAIN and call auv6_selftest with what prints a text, such as to a serial port.
 * Golden vectors: inputs and answers of the generator's interpreter as hexadecimal constants; each bit must agree.
 * Sweep: states that an integer generator makes here; a hash of all answers a function is printed, to be
 * compared between machines. The log of a board is judged by `mahovik judge-log LOG STAND.toml`. It reads:
 *
 *     mahovik selftest auv6 structure 192ea446 physics 002b2abc real double
 *     generator mahovik 0.1.0
 *     forward PASS cases 4 worst 0 ulp      a line a function; or FAIL, and how many cases are wrong
 *                                        (a distance above 1000000 ulp: worst more than 1000000 ulp)
 *     sweep 100                          states
 *     forward 0123abcd                   a line a function: FNV-1a of its statuses and outputs
 *     failures 0                         functions that failed; the last line
 *
 * No allocation. It keeps inputs and results in static memory: one caller at a time. */
#include "auv6.h"

#include <stddef.h>
#include <stdint.h>
#ifndef AUV6_SELFTEST_NO_MAIN
#include <stdio.h>
#endif

#if AUV6_STRUCTURE != 0x192ea446u || AUV6_PHYSICS != 0x002b2abcu
#error "auv6.h and auv6_selftest.c are of different stands"
#endif
#if AUV6_LANES != 1
#error "auv6.h and auv6_selftest.c were generated for different numbers of lanes"
#endif

#ifndef AUV6_SELFTEST_SWEEP
#define AUV6_SELFTEST_SWEEP 100ul  /* states of the sweep that main runs */
#endif

int auv6_selftest(void (*print)(const char *text), unsigned long sweep);

typedef uint64_t real_bits;

enum { CASES = 3, FUNCTIONS = 24, SWEPT = 1 };

#define FAR ((real_bits)1000000u)  /* ulp: a worse distance is not printed as a number */

/* ---- inputs and results ---- */

/* What the functions take beside the stand's own constants. */
typedef struct inputs {
    auv6_state x;
    auv6_real phi_ddot[AUV6_N];
    auv6_real V_dot[6];
    auv6_real tau[AUV6_N];
    int locked[AUV6_N];
    auv6_real dt;
    int order;
    auv6_real phi;
    int count;
    int per_turn;
    auv6_real zero;
    int moved;
    auv6_encoder encoder;
    int counter;
    int bits;
    auv6_real angles[3];
    auv6_real position[3];
    auv6_real q_dot[6];
    auv6_real q_ddot[6];
    auv6_real mass_factor;  /* of all masses and inertias of the parameters */
} inputs;

static inputs in;
static auv6_parameters parameters;
static auv6_mount_table mounting;

static union {
    struct { auv6_real V_dot[6]; } forward;
    struct { auv6_real F[6]; } wrench;
    struct { auv6_matrices_result out; } matrices;
    struct { auv6_momentum_result out; } momentum;
    struct { auv6_real tau[AUV6_N]; } torque;
    struct { auv6_real V_dot[6]; auv6_real phi_ddot[AUV6_N]; } coupled;
    struct { auv6_state next; } step;
    struct { auv6_state next; } step_driven;
    struct { auv6_real wrapped; } wrap;
    struct { auv6_real phi; } phase_of_counts;
    struct { auv6_real phi_dot; } speed_of_counts;
    struct { auv6_encoder encoder; } accumulate;
    struct { auv6_forward_jacobian_result out; } forward_jacobian;
    struct { auv6_coupled_jacobian_result out; } coupled_jacobian;
    struct { auv6_inverse_result out; } inverse;
    struct { auv6_real phi_ddot[AUV6_N]; } inverse_fast;
    struct { auv6_points_result out[AUV6_SENSORS]; } points;
    struct { auv6_real attitude[4]; } quaternion;
    struct { auv6_state x; auv6_real V_dot[6]; } state_from_coordinates;
    struct { auv6_generalized_result out; } generalized;
    struct { auv6_table table; } prepare;
    struct { auv6_real mount_wrench[36]; } mounts;
    struct { auv6_mount_table mounting; } prepare_mounts;
    struct { auv6_real center_of_mass_velocity[3]; } center_of_mass_velocity;
    unsigned char bytes[1];
} results;

enum { UNTOUCHED = 0x5a };  /* what every byte of the results holds before a call */

/* ---- taking results: their hash, and how far they are from what is expected ---- */

typedef struct tally {
    uint32_t hash;                /* FNV-1a of all bits taken so far, the lowest byte of a number first */
    const auv6_real *expected;  /* next numbers that are expected, `left` of them */
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

static real_bits bits_of(auv6_real value)
{
    union { auv6_real real; real_bits word; } both;
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

static void take_reals(tally *sum, const auv6_real *values, int count)
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

static void take_matrices_result(tally *sum, const auv6_matrices_result *value)
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
        take_reals(sum, value->I[i], AUV6_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->J[i], AUV6_N);
    }
    take_reals(sum, value->F, 6);
}

static void take_momentum_result(tally *sum, const auv6_momentum_result *value)
{
    take_reals(sum, value->Z, 6);
    take_reals(sum, value->Z0, 6);
    take_reals(sum, &value->energy, 1);
    take_reals(sum, value->center_of_mass, 3);
}

static void take_state(tally *sum, const auv6_state *value)
{
    take_reals(sum, value->position, 3);
    take_reals(sum, value->attitude, 4);
    take_reals(sum, value->V, 6);
    take_reals(sum, value->phi, AUV6_N);
    take_reals(sum, value->phi_dot, AUV6_N);
}

static void take_encoder(tally *sum, const auv6_encoder *value)
{
    take_ints(sum, &value->counter, 1);
    take_ints(sum, &value->place, 1);
    take_ints(sum, &value->moved, 1);
}

static void take_forward_jacobian_result(tally *sum, const auv6_forward_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], AUV6_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], AUV6_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_ddot[i], AUV6_N);
    }
}

static void take_coupled_jacobian_result(tally *sum, const auv6_coupled_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], AUV6_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], AUV6_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_tau[i], AUV6_N);
    }
    for (int i = 0; i < AUV6_N; ++i) {
        take_reals(sum, value->phi_ddot_V[i], 6);
    }
    for (int i = 0; i < AUV6_N; ++i) {
        take_reals(sum, value->phi_ddot_phi[i], AUV6_N);
    }
    for (int i = 0; i < AUV6_N; ++i) {
        take_reals(sum, value->phi_ddot_phi_dot[i], AUV6_N);
    }
    for (int i = 0; i < AUV6_N; ++i) {
        take_reals(sum, value->phi_ddot_tau[i], AUV6_N);
    }
}

static void take_inverse_result(tally *sum, const auv6_inverse_result *value)
{
    take_reals(sum, value->phi_ddot, AUV6_N);
    take_reals(sum, value->residual, 6);
    take_reals(sum, value->sigma, 6);
    take_ints(sum, &value->rank, 1);
    take_reals(sum, &value->damped_by, 1);
    take_ints(sum, value->limited, AUV6_N);
    take_reals(sum, value->hardest, 6);
}

static void take_points_result(tally *sum, const auv6_points_result *value)
{
    take_reals(sum, value->position, 3);
    for (int i = 0; i < 3; ++i) {
        take_reals(sum, value->C[i], 3);
    }
    take_reals(sum, value->twist, 6);
    take_reals(sum, value->specific_force, 3);
    take_reals(sum, value->angular_acceleration, 3);
}

static void take_generalized_result(tally *sum, const auv6_generalized_result *value)
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

static void take_row(tally *sum, const auv6_row *value)
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

static void take_sensor(tally *sum, const auv6_sensor *value)
{
    take_reals(sum, value->origin, 3);
    take_reals(sum, value->axes, 9);
}

static void take_damper(tally *sum, const auv6_damper *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->linear[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->quadratic[i], 6);
    }
}

static void take_table(tally *sum, const auv6_table *value)
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
    for (int i = 0; i < AUV6_N; ++i) {
        take_row(sum, &value->flywheel[i]);
    }
    for (int i = 0; i < AUV6_SENSORS; ++i) {
        take_sensor(sum, &value->sensor[i]);
    }
    take_reals(sum, value->gravity, 3);
    take_reals(sum, value->stream, 3);
    take_damper(sum, &value->damper);
}

static void take_mount(tally *sum, const auv6_mount *value)
{
    take_reals(sum, &value->mass, 1);
    take_reals(sum, value->first_moment, 3);
    take_reals(sum, value->inertia, 6);
    take_reals(sum, value->origin, 3);
    take_reals(sum, value->axes, 9);
}

static void take_mount_table(tally *sum, const auv6_mount_table *value)
{
    for (int i = 0; i < AUV6_N; ++i) {
        take_mount(sum, &value->flywheel[i]);
    }
}

/* ---- every function: called with the inputs; its results taken ---- */

static auv6_status call_forward(void)
{
    return auv6_forward(&auv6_default, &in.x, in.phi_ddot, results.forward.V_dot);
}

static void take_forward_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.forward.V_dot, sizeof results.forward.V_dot);
        return;
    }
    take_reals(sum, results.forward.V_dot, 6);
}

static auv6_status call_wrench(void)
{
    return auv6_wrench(&auv6_default, &in.x, results.wrench.F);
}

static void take_wrench_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.wrench.F, sizeof results.wrench.F);
        return;
    }
    take_reals(sum, results.wrench.F, 6);
}

static auv6_status call_matrices(void)
{
    return auv6_matrices(&auv6_default, &in.x, &results.matrices.out);
}

static void take_matrices_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.matrices.out, sizeof results.matrices.out);
        return;
    }
    take_matrices_result(sum, &results.matrices.out);
}

static auv6_status call_momentum(void)
{
    return auv6_momentum(&auv6_default, &in.x, &results.momentum.out);
}

static void take_momentum_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.momentum.out, sizeof results.momentum.out);
        return;
    }
    take_momentum_result(sum, &results.momentum.out);
}

static auv6_status call_torque(void)
{
    return auv6_torque(&auv6_default, &in.x, in.V_dot, in.phi_ddot, results.torque.tau);
}

static void take_torque_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.torque.tau, sizeof results.torque.tau);
        return;
    }
    take_reals(sum, results.torque.tau, AUV6_N);
}

static auv6_status call_coupled(void)
{
    return auv6_coupled(&auv6_default, &in.x, in.tau, in.locked, results.coupled.V_dot,
        results.coupled.phi_ddot);
}

static void take_coupled_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.coupled.V_dot, sizeof results.coupled.V_dot);
        untouched(sum, &results.coupled.phi_ddot, sizeof results.coupled.phi_ddot);
        return;
    }
    take_reals(sum, results.coupled.V_dot, 6);
    take_reals(sum, results.coupled.phi_ddot, AUV6_N);
}

static auv6_status call_step(void)
{
    return auv6_step(&auv6_default, &in.x, in.tau, in.locked, in.dt, in.order, &results.step.next);
}

static void take_step_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.step.next, sizeof results.step.next);
        return;
    }
    take_state(sum, &results.step.next);
}

static auv6_status call_step_driven(void)
{
    return auv6_step_driven(&auv6_default, &in.x, in.phi_ddot, in.dt, in.order, &results.step_driven.next);
}

static void take_step_driven_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.step_driven.next, sizeof results.step_driven.next);
        return;
    }
    take_state(sum, &results.step_driven.next);
}

static auv6_status call_wrap(void)
{
    return auv6_wrap(in.phi, &results.wrap.wrapped);
}

static void take_wrap_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.wrap.wrapped, sizeof results.wrap.wrapped);
        return;
    }
    take_reals(sum, &results.wrap.wrapped, 1);
}

static auv6_status call_phase_of_counts(void)
{
    return auv6_phase_of_counts(in.count, in.per_turn, in.zero, &results.phase_of_counts.phi);
}

static void take_phase_of_counts_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.phase_of_counts.phi, sizeof results.phase_of_counts.phi);
        return;
    }
    take_reals(sum, &results.phase_of_counts.phi, 1);
}

static auv6_status call_speed_of_counts(void)
{
    return auv6_speed_of_counts(in.moved, in.per_turn, in.dt, &results.speed_of_counts.phi_dot);
}

static void take_speed_of_counts_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.speed_of_counts.phi_dot, sizeof results.speed_of_counts.phi_dot);
        return;
    }
    take_reals(sum, &results.speed_of_counts.phi_dot, 1);
}

static auv6_status call_accumulate(void)
{
    results.accumulate.encoder = in.encoder;
    return auv6_accumulate(&results.accumulate.encoder, in.counter, in.bits, in.per_turn);
}

static void take_accumulate_results(tally *sum, auv6_status status)
{
    (void)status;
    take_encoder(sum, &results.accumulate.encoder);
}

static auv6_status call_forward_jacobian(void)
{
    return auv6_forward_jacobian(&auv6_default, &in.x, in.phi_ddot, &results.forward_jacobian.out);
}

static void take_forward_jacobian_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.forward_jacobian.out, sizeof results.forward_jacobian.out);
        return;
    }
    take_forward_jacobian_result(sum, &results.forward_jacobian.out);
}

static auv6_status call_coupled_jacobian(void)
{
    return auv6_coupled_jacobian(&auv6_default, &in.x, in.tau, in.locked, &results.coupled_jacobian.out);
}

static void take_coupled_jacobian_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.coupled_jacobian.out, sizeof results.coupled_jacobian.out);
        return;
    }
    take_coupled_jacobian_result(sum, &results.coupled_jacobian.out);
}

static auv6_status call_inverse(void)
{
    return auv6_inverse(&auv6_default, &in.x, in.V_dot, &auv6_default_options, &results.inverse.out);
}

static void take_inverse_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.inverse.out, sizeof results.inverse.out);
        return;
    }
    take_inverse_result(sum, &results.inverse.out);
}

static auv6_status call_inverse_fast(void)
{
    return auv6_inverse_fast(&auv6_default, &in.x, in.V_dot, &auv6_default_options,
        results.inverse_fast.phi_ddot);
}

static void take_inverse_fast_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.inverse_fast.phi_ddot, sizeof results.inverse_fast.phi_ddot);
        return;
    }
    take_reals(sum, results.inverse_fast.phi_ddot, AUV6_N);
}

static auv6_status call_points(void)
{
    return auv6_points(&auv6_default, &in.x, in.V_dot, results.points.out);
}

static void take_points_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.points.out, sizeof results.points.out);
        return;
    }
    for (int i = 0; i < AUV6_SENSORS; ++i) {
        take_points_result(sum, &results.points.out[i]);
    }
}

static auv6_status call_quaternion(void)
{
    return auv6_quaternion(in.angles, results.quaternion.attitude);
}

static void take_quaternion_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.quaternion.attitude, sizeof results.quaternion.attitude);
        return;
    }
    take_reals(sum, results.quaternion.attitude, 4);
}

static auv6_status call_state_from_coordinates(void)
{
    results.state_from_coordinates.x = in.x;
    return auv6_state_from_coordinates(in.position, in.angles, in.q_dot, in.q_ddot,
        &results.state_from_coordinates.x, results.state_from_coordinates.V_dot);
}

static void take_state_from_coordinates_results(tally *sum, auv6_status status)
{
    take_state(sum, &results.state_from_coordinates.x);
    if (status < 0) {
        untouched(sum, &results.state_from_coordinates.V_dot, sizeof results.state_from_coordinates.V_dot);
        return;
    }
    take_reals(sum, results.state_from_coordinates.V_dot, 6);
}

static auv6_status call_generalized(void)
{
    return auv6_generalized(&auv6_default, &in.x, in.angles, in.phi_ddot, &results.generalized.out);
}

static void take_generalized_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.generalized.out, sizeof results.generalized.out);
        return;
    }
    take_generalized_result(sum, &results.generalized.out);
}

static auv6_status call_prepare(void)
{
    results.prepare.table = auv6_default;
    return auv6_prepare(&parameters, &results.prepare.table);
}

static void take_prepare_results(tally *sum, auv6_status status)
{
    (void)status;
    take_table(sum, &results.prepare.table);
}

static auv6_status call_mounts(void)
{
    return auv6_mounts(&auv6_default, &mounting, &in.x, in.V_dot, in.phi_ddot, results.mounts.mount_wrench);
}

static void take_mounts_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.mounts.mount_wrench, sizeof results.mounts.mount_wrench);
        return;
    }
    take_reals(sum, results.mounts.mount_wrench, 36);
}

static auv6_status call_prepare_mounts(void)
{
    return auv6_prepare_mounts(&parameters, &results.prepare_mounts.mounting);
}

static void take_prepare_mounts_results(tally *sum, auv6_status status)
{
    if (status < 0) {
        untouched(sum, &results.prepare_mounts.mounting, sizeof results.prepare_mounts.mounting);
        return;
    }
    take_mount_table(sum, &results.prepare_mounts.mounting);
}

static auv6_status call_center_of_mass_velocity(void)
{
    return auv6_center_of_mass_velocity(&auv6_default, &in.x,
        results.center_of_mass_velocity.center_of_mass_velocity);
}

static void take_center_of_mass_velocity_results(tally *sum, auv6_status status)
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

static const auv6_real numbers_forward[] =
{
    0x1.5f9edd0a1ca3cp+0, 0x1.58170c8bb7f58p+2, -0x1.b3d23d2b0fea6p+2, -0x1.d3d0b775e4a0cp+0,
        0x1.85c390f37fcc3p+4, -0x1.bc2b3437591e6p+5,
    -0x1.6fcebc7362896p+16, 0x1.ccd02b98bb6acp+14, -0x1.9974f942dd716p+12, -0x1.59ac9a7754e65p+17,
        0x1.15ec1f95cbd44p+16, 0x1.459002bcfc84bp+15,
};

static const auv6_real numbers_wrench[] =
{
    -0x1.18a7abb30e0dp+6, -0x1.07db3c3424ffp+8, -0x1.4cde114359e98p+6, -0x1.0f7a38e06e7bap+4,
        0x1.1e6a314c43168p+3, -0x1.017f767a399dep+1,
    -0x1.757b872f0e8p+3, 0x1.5f3f90fe43cep+9, 0x1.128d1da20798p+6, 0x1.2e28d571454ap-2, -0x1.8ecab7cee01b7p+4,
        -0x1.f38f7e960d4bcp+6,
};

static const auv6_real numbers_matrices[] =
{
    0x1p+6, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.b458bc544e0ap-1, -0x1.4985c403dcb73p-2, 0x0p+0, 0x1.4p+6, 0x0p+0,
        0x1.b458bc544e0ap-1, 0x0p+0, 0x1.947975fb0e5a2p+1, 0x0p+0, 0x0p+0, 0x1.5p+6, 0x1.4985c403dcb73p-2,
        -0x1.a14642c7db26fp+1, 0x0p+0, 0x0p+0, 0x1.b458bc544e0ap-1, 0x1.4985c403dcb73p-2,
        0x1.eaf7e104f87abp-1, -0x1.a0723ddfe02e8p-5, 0x1.af4746ea13278p-4, -0x1.b458bc544e0ap-1, 0x0p+0,
        -0x1.a14642c7db26fp+1, -0x1.a0723ddfe02e8p-5, 0x1.3d096d40298a8p+2, 0x1.60f6a3485dcc5p-6,
        -0x1.4985c403dcb73p-2, 0x1.947975fb0e5a2p+1,
    0x1p+6, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.a6273dc73eedfp-1, -0x1.4e95fce836e1ep-2, 0x0p+0, 0x1.4p+6, 0x0p+0,
        0x1.a6273dc73eedfp-1, 0x0p+0, 0x1.8d6f7097c0012p+1, 0x0p+0, 0x0p+0, 0x1.5p+6, 0x1.4e95fce836e1ep-2,
        -0x1.9a3c3d648ccdfp+1, 0x0p+0, 0x0p+0, 0x1.a6273dc73eedfp-1, 0x1.4e95fce836e1ep-2,
        0x1.eb42c8ba767ffp-1, -0x1.9e015a8ea6fafp-5, 0x1.9dfc392551e22p-4, -0x1.a6273dc73eedfp-1, 0x0p+0,
        -0x1.9a3c3d648ccdfp+1, -0x1.9e015a8ea6fafp-5, 0x1.3bd7057251feap+2, 0x1.5d19c7a1d0cdcp-6,
        -0x1.4e95fce836e1ep-2, 0x1.8d6f7097c0012p+1,
};

static const auv6_real numbers_momentum[] =
{
    0x1.8cad2267cf2b4p+6, 0x1.3b1c2e115e59cp+7, 0x1.2c9cfbd22d614p+6, 0x1.91ca08a1193bfp+1,
        -0x1.d5eab371089ep+0, 0x1.298252530fdb5p+3, 0x1.9233d76202a95p+5, 0x1.a68c09cf986ap+1,
        0x1.84ad8521601d6p+7, 0x1.1cf5e95cea38bp+8, 0x1.1e4b322189747p+7, -0x1.21c44c785779dp+6,
        0x1.1402db0dd4301p+9, 0x1.82a7c205f5b2ep-5, 0x1.a5c9f0a8c8989p-8, -0x1.174307e408fc3p-6,
    0x1.0284697f664bp+4, -0x1.c7e8ba553b8a2p+7, -0x1.db9367362d50dp+8, -0x1.7978a8177acf6p+4,
        -0x1.48af1a61ca472p+5, -0x1.662e63a625692p+3, 0x1.a6f25dbce1936p+7, 0x1.1156585084d43p+7,
        -0x1.cfad96e5c1a62p+8, -0x1.0c6efded50f22p+8, 0x1.18cfb9285333ap+8, -0x1.1a0ef3e357302p+6,
        0x1.2cefaad4e03a9p+20, 0x1.79a52bc449bbep-5, 0x1.ac451ac2d59cp-8, -0x1.0e2d982d98ea3p-6,
};

static const auv6_real numbers_torque[] =
{
    0x1.073fdd37c5716p-6, -0x1.b82885c1eb1ddp+0, 0x1.0db3af3564accp+0, -0x1.d5df58e951dc8p-1,
        0x1.caae57bf5aafp-1, -0x1.25cc2a170a7f2p-2,
    0x1.508e37f3ffbbap-3, -0x1.7eb7f726f899p-1, -0x1.fcc6377772682p-1, -0x1.569cad172653bp-1,
        -0x1.c9ec9edbd7e19p+0, 0x1.72c967cce088p-1,
};

static const auv6_real numbers_coupled[] =
{
    0x1.5de80a6945e9p+0, 0x1.56ce9a64e5327p+2, -0x1.b38f7687cb0f2p+2, -0x1.6fbd8baef6f5ep+1,
        0x1.86d344bb01354p+4, -0x1.bffebf29f2d8ep+5, 0x0p+0, -0x1.0e4c2386cdaefp+8, 0x0p+0,
        -0x1.b20ae8929640ap+7, 0x1.fe8f53b1b2ec8p+7, 0x1.604f6dbba85acp+7,
    -0x1.6ff106284ace5p+16, 0x1.cd8bdf37bd096p+14, -0x1.9ad370e8d0428p+12, -0x1.5bdacb318a64cp+17,
        0x1.155f0c8dd7673p+16, 0x1.464802b8c647bp+15, 0x1.e2faf734ea133p+17, 0x0p+0, -0x1.e0c5453f9fcb7p+17,
        0x1.60c07d6e64991p+16, -0x1.5127e5b7d973p+16, 0x0p+0,
};

static const auv6_real numbers_step[] =
{
    -0x1.779a17415b159p-1, 0x1.80b85a858d778p+0, -0x1.10f682d127acap-4, 0x1.23d5bb5738c99p-1,
        -0x1.2f86b67f44a1dp-5, -0x1.fa5f046be009ap-2, -0x1.4f6e319ea1cb2p-1, 0x1.98d2eb85ad7a6p+0,
        0x1.e63ccb4fc1f34p+0, 0x1.d0f2cabb75efep-1, 0x1.f3e063677a445p+0, 0x1.46f032cd353bap-1,
        0x1.a9131309b4f82p-1, -0x1.0bcb746f4b9eep-3, 0x1.48e41db6f6bdbp+1, -0x1.256c559p+1,
        -0x1.9bcfaed9d2f47p-1, -0x1.ebcdab8596999p+0, -0x1.3a2eae24e210ep+0, -0x1.c61c58p+7,
        -0x1.3c8b76481284ep+4, -0x1.c4d59p+7, 0x1.d7965f27014e9p+7, 0x1.359275d46b75cp+3,
        0x1.29c24cf69fff2p+6,
    0x1.555cd8da2042cp-1, 0x1.55ebadd7f42fdp-1, -0x1.a109e0752eba6p-6, -0x1.7802b9f534a6p-1,
        -0x1.fe7d0c5c99babp-4, 0x1.6ab9952b9d6p-4, -0x1.5292f31aedabcp-1, -0x1.1b1f9a5e46c94p+2,
        -0x1.4285dcaa451b8p+0, -0x1.5192441cd75f2p+1, -0x1.04d3ccc35a1b8p+3, 0x1.626a9e54322e5p+3,
        0x1.230496725173ep+3, -0x1.731281d872688p-4, -0x1.44c02e94555b4p-5, -0x1.4ef7829c66809p+0,
        -0x1.226e3a652e897p+0, -0x1.aa69317bfea22p+0, 0x1.24fa37ff8d005p+1, -0x1.05157626b77fcp+13,
        -0x1.8f2aap+11, -0x1.79b8c84821b2ap+10, -0x1.dfa9e35f0cb12p+13, -0x1.f92ab2f743bb3p+13,
        0x1.3b88ccp+13,
};

static const auv6_real numbers_step_driven[] =
{
    -0x1.779a17411af43p-1, 0x1.80b85a8584cf1p+0, -0x1.10f682cf59088p-4, 0x1.23d5bb59c6e35p-1,
        -0x1.2f86b656c683fp-5, -0x1.fa5f04772dbd5p-2, -0x1.4f6e319849407p-1, 0x1.98d2f1a875bd7p+0,
        0x1.e63ce0214901ap+0, 0x1.d0f2c31341529p-1, 0x1.f3e494a70429ap+0, 0x1.46efa942d2542p-1,
        0x1.a916e7f849ed8p-1, -0x1.0bcb7abf9d9eep-3, 0x1.48e41a1d93f9fp+1, -0x1.256c5253707p+1,
        -0x1.9bcfb4ea38f3ep-1, -0x1.ebcda9574113ep+0, -0x1.3a2eb99cf9f9fp+0, -0x1.c61d220a4p+7,
        -0x1.3cc5160cp+4, -0x1.c4cf16e0ep+7, 0x1.d79355d84p+7, 0x1.35b56a86p+3, 0x1.29ab5bf58p+6,
    0x1.555cdc0c96b5ap-1, 0x1.55ebaf306182p-1, -0x1.a109a8b24fedbp-6, -0x1.7802b7e5ccebfp-1,
        -0x1.fe7dc411bf0e5p-4, 0x1.6ab8bfdeca2bbp-4, -0x1.5292f4a2c1278p-1, -0x1.1af704dc78ce6p+2,
        -0x1.42a0ba2dbe0d3p+0, -0x1.517c3d2cc2fd4p+1, -0x1.03178e3eeceb4p+3, 0x1.627799fac9724p+3,
        0x1.2283c88dc909fp+3, -0x1.74f54ad56b528p-4, -0x1.44c0b1c1255b4p-5, -0x1.4ed983de32c69p+0,
        -0x1.2279449b80fcap+0, -0x1.aa5eb32f93e35p+0, 0x1.24fa3baaed205p+1, -0x1.055d5b8171p+13,
        -0x1.8f2ae19668p+11, -0x1.764012c408p+10, -0x1.df9af0c99cp+13, -0x1.f8cacfcb0cp+13,
        0x1.3b88e95b01p+13,
};

static const auv6_real numbers_wrap[] =
{
    -0x1.87dc0f9990e92p+1,
    0x1.71ac48d807bcap-3,
};

static const auv6_real numbers_phase_of_counts[] =
{
    0x1.44ea670a66a78p+1,
    -0x1.d73968ed94cd6p+0,
};

static const auv6_real numbers_speed_of_counts[] =
{
    -0x1.2df624deb7b68p+6,
    0x1.2f3cdb762dc2dp+12,
};

static const auv6_real numbers_accumulate[] =
{
    0.0
};

static const auv6_real numbers_forward_jacobian[] =
{
    -0x1.2c6e09dda80cp+0, 0x1.06a5b74d24027p+0, -0x1.87ece26f2f09ep-1, 0x1.08fd41cb3133bp-6,
        -0x1.2ccbb465a368ep+0, 0x1.44f3ad1e59b11p+1, -0x1.9bc4ee457372fp-2, -0x1.829c9b473e36cp+1,
        0x1.10334c8813672p+1, 0x1.f8b7478751d9fp-1, -0x1.3f4b59bd1fcc8p-7, -0x1.2762515da1afap+0,
        0x1.3cc30cbeb594cp-1, -0x1.daca9a018f9f7p+0, -0x1.9d3ba12b54139p+0, -0x1.dfe5efa068e18p+0,
        0x1.163a13a105002p+0, -0x1.8f6a750dfaef8p-7, 0x1.1ee4a9c9024a3p-1, -0x1.656bef34db3edp-1,
        -0x1.d635c62feef1cp+2, -0x1.61aefa1175811p+1, 0x1.32320c318f8d1p+0, 0x1.266084ba78982p-2,
        0x1.beaacffee0738p+1, 0x1.0d8c24e5aa7acp-4, 0x1.52624de1c57e7p+2, 0x1.5911d436e5639p-1,
        -0x1.733d80aa39a3ep+0, 0x1.ab8f4ae19a0d6p+0, -0x1.b6b52ea18366dp+2, -0x1.afb0146c2eac1p+1,
    -0x1.062e67d4e53b4p-1, 0x1.2106be6cce32p+3, -0x1.0a10aa9cc4bfbp+2, -0x1.4db48d024bbd8p-8,
        0x1.b8a36a381a10cp+3, -0x1.91967b1c1e019p+1, -0x1.89c7db8397aecp+2, -0x1.52a0f88f571e2p+2,
        -0x1.26277de8223bp+1, -0x1.5d6d58220621dp+3, 0x1.68b24275a672cp-3, 0x1.c2a3a4da25866p+0,
        0x1.2310aa64a79e2p+1, 0x1.f2ce33acfabd3p+0, -0x1.b2e6094cacee5p+0, 0x1.309ca1130a43ap+1,
        -0x1.d470344f3f7f2p-6, 0x1.19a00ae65dae7p-1, -0x1.e75a8f4a42627p+0, 0x1.0460401c3b736p+3,
        0x1.b0e3cfd3d9149p+3, -0x1.3a356d2dbc6ep+4, 0x1.9aa88562168ffp+2, -0x1.d5c278bb12c32p+6,
        -0x1.0137ade68357fp+2, 0x1.61ea3cc48e63ep-2, 0x1.f72526e2cb797p-1, -0x1.100f3abdbf1f2p+3,
        -0x1.07e07c1904b15p-1, 0x1.886f77cc4205ep-1, 0x1.49ffb73c7a7dcp+3, 0x1.ad6d4f4abdd31p+0,
};

static const auv6_real numbers_coupled_jacobian[] =
{
    -0x1.2caec549ff6a9p+0, 0x1.06938e6ec76bcp+0, -0x1.88bb35ed477afp-1, 0x1.04482daafb5e2p-6,
        -0x1.2cb5535743377p+0, 0x1.44f554c17902bp+1, -0x1.9cde1b9d7c834p-2, -0x1.82e134adf000ep+1,
        0x1.100282419f941p+1, 0x1.f8a342cb3dc2fp-1, -0x1.3e52cc1eb0448p-7, -0x1.2760498f829d6p+0,
        0x1.3ccd4ac13ba95p-1, -0x1.dafc42fd459b1p+0, -0x1.9d925fee604b3p+0, -0x1.dfeb15a533dap+0,
        0x1.1634adf3d96bdp+0, -0x1.93dcd8242769ep-7, 0x1.12cbdea66a38ap-1, -0x1.79d29e931ba3ep-1,
        -0x1.d878697062171p+2, -0x1.62406c6b2c985p+1, 0x1.332dc6f6c6077p+0, 0x1.29f8caa8628a6p-2,
        0x1.bfec284f064e2p+1, 0x1.24ddf17a2a503p-4, 0x1.532d212dda676p+2, 0x1.5a1232515027cp-1,
        -0x1.7372d36f087e1p+0, 0x1.ac1a47181ff97p+0, -0x1.b85c4fc9f6799p+2, -0x1.b37509c95f8b4p+1,
    -0x1.06cc292f0fb16p-1, 0x1.210fd0349b73ap+3, -0x1.0a0a866a0e3e5p+2, -0x1.66718ddc46264p-8,
        0x1.b8bb8e0df6ad6p+3, -0x1.9208f6afb527p+1, -0x1.89aa902937e8fp+2, -0x1.530127fbb572ap+2,
        -0x1.2656112edf1e1p+1, -0x1.5d92bc2f6c63bp+3, 0x1.659be88c1d108p-3, 0x1.c6b0d48d4c082p+0,
        0x1.22e936027afbap+1, 0x1.f36d41d187abap+0, -0x1.b2c778307af47p+0, 0x1.3091637b4b71ep+1,
        -0x1.d8e355c5854ep-6, 0x1.127e96853333p-1, -0x1.e80c8fa743b6bp+0, 0x1.070ec2d0102eep+3,
        0x1.b32216b98bf4fp+3, -0x1.3be3caabddd2p+4, 0x1.9cf43d6f08372p+2, -0x1.d8ebee52f1ad7p+6,
        -0x1.0164aacc58b1ap+2, 0x1.6ff14ec8dda25p-2, 0x1.fac949810c6dfp-1, -0x1.1040275a2548cp+3,
        -0x1.069c9326febf7p-1, 0x1.58b53b0c2e761p-1, 0x1.4a592185073eap+3, 0x1.ae0bbdff28a51p+0,
};

static const auv6_real numbers_inverse[] =
{
    -0x1.11b401f18de42p+15, 0x1.1616efbe39a7ep+17, -0x1.c54d0c9bca623p+17, 0x1.64cf295bc7443p+15,
        -0x1.7d6696a6eb298p+13, 0x1.3d7e94c4a1a0cp+15, -0x1.1p-43, 0x1.4p-41, -0x1.3p-41, -0x1.cp-44, 0x1p-46,
        0x1p-41, 0x1.9603d60f2a47dp-4, 0x1.1328aa6250c37p-4, 0x1.86ab3fa840608p-5, 0x1.c1ed78bcc5ae4p-6,
        0x1.3e37c0a1f0911p-6, 0x1.095aa165a35bcp-7, 0x0p+0, 0x1.81fad808c4be9p+2, -0x1.54f84f5454175p-1,
        0x1.082ed3dfff25bp+2, -0x1.eeda581ae9fb4p-3, 0x1.322e20e512c1bp-1, 0x1.7f285556d02e4p-3,
    -0x1.5fca0bd1d02edp+29, 0x1.9ba15df7a0427p+28, 0x1.96d39f9ce3ae8p+29, 0x1.38fd1ec3e5e87p+28,
        -0x1.18482202f8b3ap+28, 0x1.121d5d032f3a3p+30, 0x1p-29, 0x1p-27, 0x1.8p-31, -0x1p-31, -0x1p-34,
        0x1p-32, 0x1.711c6535ade66p-4, 0x1.c07c459ff22cdp-5, 0x1.4eb4e70762bf3p-5, 0x1.ba0553f280016p-6,
        0x1.30e89d9ccf6f3p-6, 0x1.a21d9047d836fp-8, 0x0p+0, 0x1.65bbc4d5042fbp+2, -0x1.1a1f21d1b5734p+1,
        0x1.5970952c484e5p+1, -0x1.07cf811202611p-4, -0x1.24fc367b010a3p+0, 0x1.7d804a124758p-1,
};

static const auv6_real numbers_inverse_fast[] =
{
    -0x1.11b401f18de41p+15, 0x1.1616efbe39a7ap+17, -0x1.c54d0c9bca619p+17, 0x1.64cf295bc7433p+15,
        -0x1.7d6696a6eb26fp+13, 0x1.3d7e94c4a19fdp+15,
    -0x1.5fca0bd1d02f1p+29, 0x1.9ba15df7a0428p+28, 0x1.96d39f9ce3ae9p+29, 0x1.38fd1ec3e5e81p+28,
        -0x1.18482202f8b36p+28, 0x1.121d5d032f3a3p+30,
};

static const auv6_real numbers_points[] =
{
    -0x1.b27ad6b934e39p-1, 0x1.26c966bf0b66ep+0, 0x1.9038013e3165cp-3, -0x1.75528ec2c5e43p-2,
        0x1.94d99c7ca2f6p-1, -0x1.f7944b4c299e6p-2, -0x1.156d140a36993p-1, 0x1.feafcd95c6c4ap-3,
        0x1.9af2d3ed806dap-1, 0x1.83bb78cad8f6bp-1, 0x1.1e4097315bbe5p-1, 0x1.59a49bb6ffe39p-2,
        0x1.df8f657b68c6ap+0, 0x1.1bd2623d2b9adp+1, 0x1.78d84603c7bfep-3, 0x1.10f0800304694p+1,
        0x1.d6519a25f13f2p-2, 0x1.95632b55aa5c4p-2, 0x1.74f8d040535b3p+4, 0x1.987b8f765f6bap+4,
        0x1.3fed0172c8cd2p+2, 0x1.e8338488dc2f1p+1, 0x1.06712dd3aaba4p+3, 0x1.85b6190c19053p+3,
    0x1.63a22c398864fp-1, 0x1.1ca837fa264ddp+0, 0x1.f507ec8435de8p-5, 0x1.1bf6b4cbe0157p-6,
        -0x1.fe2fbc38fe992p-1, 0x1.510c5f499e884p-4, 0x1.c0071f140d512p-1, -0x1.94a88e90dc9f9p-6,
        -0x1.eefee05da8aaep-2, 0x1.ef52cd4dc64f2p-2, 0x1.49409009b4277p-4, 0x1.be38c1c72517cp-1,
        -0x1.fca99408d0524p-3, -0x1.b072e63c27e7ap-3, -0x1.22718fc08cc17p+1, -0x1.1441524f9373cp-2,
        0x1.ddcf34800a69dp+1, 0x1.cf4e71369ced2p+2, -0x1.c4397d2f7332cp+5, 0x1.62f0e1709c761p+5,
        -0x1.75d1bbb18786p+5, 0x1.067b3fdab9f1ep+6, 0x1.cb46e9eb81fdep+4, -0x1.e1989a02f8e7p+3,
};

static const auv6_real numbers_quaternion[] =
{
    0x1.cea2e1e8cac71p-1, 0x1.dd7fc12bd7767p-4, -0x1.caa7a5f2114cbp-4, -0x1.96430663f2734p-2,
    0x1.d65ff582f77e9p-1, -0x1.4a477d2fd7e1cp-2, 0x1.a520c03eb2918p-3, -0x1.92e108c74ed2p-4,
};

static const auv6_real numbers_state_from_coordinates[] =
{
    -0x1.5944dp-2, 0x1.f3e8ep-2, 0x1.35894p-2, 0x1.cea2e1e8cac71p-1, 0x1.dd7fc12bd7767p-4,
        -0x1.caa7a5f2114cbp-4, -0x1.96430663f2734p-2, 0x1.8caa98d309bcdp+0, 0x1.388589f47f7cap-3,
        0x1.73fca9d212acap-1, -0x1.cb73363736e06p-1, 0x1.ee6735f8dbd12p-3, 0x1.842631252c6b3p-1,
        -0x1.95dd5cp+3, 0x1.e462ap+3, -0x1.23a78p+1, -0x1.c68578p+2, -0x1.cf9e4p+3, -0x1.e0f5dp+2,
        -0x1.c61c58p+7, -0x1.3c48p+4, -0x1.c4d59p+7, 0x1.d79d24p+7, 0x1.3513p+3, 0x1.29b748p+6,
        0x1.49ce0175f184ap+0, 0x1.6f81ed0fd4992p+3, 0x1.5de2f2afc9697p+3, 0x1.ae2248af8f876p+3,
        -0x1.2f43ec57d1cc4p-1, -0x1.6cd741b186e5cp+1,
    -0x1.3d4554p+0, -0x1.07562p-1, 0x1.a063e4p+0, 0x1.d65ff582f77e9p-1, -0x1.4a477d2fd7e1cp-2,
        0x1.a520c03eb2918p-3, -0x1.92e108c74ed2p-4, -0x1.1e55f6140433fp+1, 0x1.265bc5d383d6cp+0,
        0x1.e2f4264fe6674p-2, 0x1.a671d75bd433ap-2, -0x1.1502cc4c7d703p+0, -0x1.e5e853f35692p-5,
        -0x1.0249c8p+22, -0x1.371e7p+21, -0x1.214c38p+22, 0x1.4171bp+20, 0x1.82ebap+20, 0x1.0b38ap+21,
        -0x1.055d68p+13, -0x1.8f2aap+11, -0x1.763e6p+10, -0x1.df9aep+13, -0x1.f8caa4p+13, 0x1.3b88ccp+13,
        -0x1.183be5d05dd57p+3, -0x1.2421a88cc57bbp+3, -0x1.68eca3619167fp+3, 0x1.b84adc0904d24p+2,
        0x1.1fc37310fc0bcp+2, 0x1.775255968d581p+1,
    -0x1.7a5978p+39, 0x1.8ab58p+38, 0x1.b0decp+36, -0x1.a64a207452298p-1, 0x1.368f6b1ecd55fp-2,
        -0x1.d84f72e982f2bp-1, -0x1.8aab9821cf9d3p+0, 0x1.a35e68p-1, -0x1.16ceep-3, 0x1.63ddcp-3,
        0x1.e05b2p-3, -0x1.68bbep-1, -0x1.cbd33cp+0, -0x1.c483b8p+43, -0x1.ed35p+38, -0x1.bdd86p+43,
        0x1.f8f3ep+41, -0x1.ca174p+40, 0x1.bc5528p+42, 0x1.67f6p+3, 0x1.7f7ed8p+6, 0x1.1db6ap+7,
        -0x1.046708p+7, 0x1.7c0718p+7, -0x1.8e30bp+7,
};

static const auv6_real numbers_generalized[] =
{
    0x1.51fae45d6853p-1, -0x1.7c75b6483a307p-1, 0x1.c1fb8ff509d0ap-4, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.61b9bc2c87c39p-1, 0x1.50e740352e2f6p-1, 0x1.32b6d68561744p-2, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.2df04c2ae2ca2p-2, -0x1.f2fd639430ecep-4, 0x1.e53e797b45421p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, -0x1.7c75b6483a306p-1, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.50e740352e2f6p-1,
        0x1.74d3de83abd05p-3, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.cacb962289016p-1, -0x1.40e47ef55edb9p-2, -0x1.41eb2b256d86dp-2, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.89dcb053a080ep-5, 0x1.8b90c93cf4e25p-1, -0x1.4423837f393f5p-1, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.c3dcd0d4cf554p-2, 0x1.1ab7899d74451p-1, 0x1.6a2c9b8a90f54p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, -0x1.40e47ef55edbap-2, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.8b90c93cf4e25p-1,
        -0x1.29b66a16d6469p-1, 0x0p+0, 0x0p+0, 0x0p+0,
};

static const auv6_real numbers_prepare[] =
{
    0x1.6e581cdp+5, 0x1.65c8a434656d2p-6, 0x1.11e5923a302p+1, 0x1.1e74e4e778f15p-2, -0x1.8740f3619ce19p-1,
        0x1.cb70d970c1ee1p-1, 0x1.27f73a55ad4f8p+2, 0x1.18514e2bea5c4p+2, -0x1.72d18c9da3d2ep-5,
        0x1.6dbad243d7c6cp-4, 0x1.42e41cfad645dp-6, 0x1.de581cdp+5, 0x1.2f2c0e68p+6, 0x1.3f2c0e68p+6, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.12030bd7cfd2ap-6, 0x1.b055d687dadd2p-7, 0x1.9aa997777633p-7, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.ccccccccccccdp-1, 0x0p+0, 0x1.999999999999ap-1,
        0x0p+0,
    0x1.73062f1p+5, 0x1.61455319b3465p-6, 0x1.15654ec2c909p+1, 0x1.221db4a5da50bp-2, -0x1.8c407c14e6fbfp-1,
        0x1.cfacc64fd5706p-1, 0x1.2ad8e7bfcd836p+2, 0x1.1b29ab1ae9d05p+2, -0x1.778e40d6524fbp-5,
        0x1.7266e21e68144p-4, 0x1.470413eeb1f8p-6, 0x1.e3062f1p+5, 0x1.31831788p+6, 0x1.41831788p+6, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.0f5b66477ae09p-6, 0x1.ad0621ee837ap-7, 0x1.97ac73dc9f906p-7, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.ccccccccccccdp-1, 0x0p+0, 0x1.999999999999ap-1,
        0x0p+0,
    0x1.9p+5, 0x1.47ae147ae147bp-6, 0x1.2b0f3a7706a75p+1, 0x1.38c5f0e7946bp-2, -0x1.ab32ac9d0ebfap-1,
        0x1.e9e3dc1d120dcp-1, 0x1.3cb0357a568a5p+2, 0x1.2cc74d67664abp+2, -0x1.94e2aad31dc39p-5,
        0x1.8f544230ab2bep-4, 0x1.608e0bbb6481p-6, 0x1p+6, 0x1.4p+6, 0x1.5p+6, 0x0p+0, 0x0p+0, 0x0p+0, 0x1p-6,
        0x1.999999999999ap-7, 0x1.8618618618619p-7, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, -0x1.ccccccccccccdp-1, 0x0p+0, 0x1.999999999999ap-1, 0x0p+0,
};

static const auv6_real numbers_mounts[] =
{
    0x1.c418097a30718p+4, -0x1.ca005b8bb1002p+8, -0x1.2d8ae0b234c8ap+7, 0x1.073fdd37c56e7p-6,
        -0x1.3147b925cf8afp-1, 0x1.9d96e1e0855bbp+0, 0x1.dfc075f6a645p+4, -0x1.bdbfaf170b13ap+4,
        0x1.5df9d8368a7c8p+4, -0x1.b82885c1eb1ddp+0, 0x1.3edafd47aadfcp-7, 0x1.8ebfa0555f47cp-4,
        0x1.06ac1f8f6f2e8p+4, 0x1.347d16f36fee3p+8, 0x1.cb490abde3cd4p+8, 0x1.0db3af3564accp+0,
        0x1.b3a3615bdeb94p+0, 0x1.ff524ff3f326p-3, 0x1.d80825c30f5ep+4, -0x1.e72ff1defddc2p+8,
        0x1.dc94d712e5ffp+8, -0x1.d5df58e951db9p-1, 0x1.29e5c2ac21316p+1, 0x1.e2a2c4f6f5644p+0,
        0x1.8488b35801fdap+4, -0x1.32978f248ff49p+5, 0x1.1b9d8119a3b54p+2, 0x1.caae57bf5aaf5p-1,
        -0x1.546350cccfe6ep-3, 0x1.449a83afb2e58p-3, 0x1.3dd676db67aacp+4, 0x1.baa1230e6ff89p+4,
    -0x1.44405581432a2p+10, -0x1.b4749708baed4p+18, -0x1.09ae67842258bp+19, 0x1.508e37f4003f2p-3,
        -0x1.491d94054397ap+10, 0x1.c3ed2f42c120ep+10, -0x1.0a016cf3cd4bp+8, -0x1.7051ca0af06dp+16,
        -0x1.7d3ff7a37a033p+15, -0x1.7eb7f726f89dp-1, -0x1.b4e5656b4579fp+6, 0x1.c6ac60f07bc76p+7,
        -0x1.15202b013ec8bp+4, -0x1.8ac3dd9c34efcp+13, 0x1.4693a6b4b134ep+14, -0x1.fcc637777267p-1,
        0x1.28199d627a394p+3, 0x1.50dc4116a36f2p+4, -0x1.e88d9fc365269p+9, -0x1.4efd25bc3aeeap+21,
        0x1.463fa18f1f5a5p+18, -0x1.569cad17266aep-1, 0x1.d62e1f847c5c2p+9, 0x1.f2ced304821ccp+12,
        0x1.f0638540dbf25p+9, -0x1.31e3a332499e5p+21, 0x1.036a41e20003cp+21, -0x1.c9ec9edbd7e86p+0,
        0x1.ade9e804791d5p+11, 0x1.1ccda6f8f3c8ap+12, 0x1.717d5aa3afe06p+10, -0x1.7e6a1104a6c8p+13,
};

static const auv6_real numbers_prepare_mounts[] =
{
    0x1.5fb0bf8p+0, -0x1.682188b439581p-10, 0x1.0e1926872b021p-7, 0x1.0e1926872b021p-8, 0x1.883e1fc60029fp-9,
        0x1.09e58f2c5197bp-9, 0x1.ed7fdf6d117b5p-10, 0x1.bd9a21fafc8b1p-16, 0x1.1494a25529fe1p-18,
        -0x1.05370b178b37p-16, -0x1.3333333333333p-2, 0x1.999999999999ap-4, 0x1.47ae147ae147bp-6,
        0x1.fd7583bc82ebap-1, -0x1.9791363065df3p-4, 0x0p+0, 0x1.9791363065df3p-4, 0x1.fd7583bc82ebap-1,
        0x0p+0, -0x0p+0, 0x0p+0, 0x1p+0, 0x1.5fb0bf8p+0, 0x0p+0, 0x1.291baa617c1bep-7, 0x1.8c24e32ca57a8p-9,
        0x1.94610bd47892bp-9, 0x1.10e3f52bd875fp-9, 0x1.fe446758f38c4p-10, 0x1.3c87f85bc6d03p-16, 0x0p+0,
        -0x1.60cb3e910a53ep-17,
    0x1.642ee58p+0, -0x1.6cbb49374bc6bp-10, 0x1.118c76e978d5p-7, 0x1.118c76e978d5p-8, 0x1.8d40e470110a1p-9,
        0x1.0d4b2201259ap-9, 0x1.f3cdc91be6e65p-10, 0x1.c34b67903211ep-16, 0x1.181d25cc42636p-18,
        -0x1.088d4e5d5b24fp-16, -0x1.3333333333333p-2, 0x1.999999999999ap-4, 0x1.47ae147ae147bp-6,
        0x1.fd7583bc82ebap-1, -0x1.9791363065df3p-4, 0x0p+0, 0x1.9791363065df3p-4, 0x1.fd7583bc82ebap-1,
        0x0p+0, -0x0p+0, 0x0p+0, 0x1p+0, 0x1.642ee58p+0, 0x0p+0, 0x1.2ce74f9a6b50bp-7, 0x1.91346a2339c0fp-9,
        0x1.998b813243492p-9, 0x1.14606738629cfp-9, 0x1.0264938a4d766p-9, 0x1.409322b9686bfp-16, 0x0p+0,
        -0x1.654d006d383cap-17,
};

static const auv6_real numbers_center_of_mass_velocity[] =
{
    0x1.23d3c0748932fp-1, -0x1.8f0ca845944c8p-3, 0x1.4da776609921bp+1,
    0x1.371da6a7f363ap+1, 0x1.4ac9b196df39p+1, -0x1.13b77dbe021b8p+3,
};

typedef struct function {
    const char *name;
    size_t size;  /* of its results, bytes */
    auv6_status (*call)(void);
    void (*take)(tally *sum, auv6_status status);
    const auv6_real *numbers;
    answer answers[CASES];
    uint32_t swept;  /* hash of the first SWEPT states of a sweep */
} function;

static const function functions[FUNCTIONS] =
{
    { "forward", sizeof results.forward,
      call_forward, take_forward_results, numbers_forward,
      { { 0, 0xbb05d8b3u, 6 }, { 0, 0xdc321129u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x0a419437u },
    { "wrench", sizeof results.wrench,
      call_wrench, take_wrench_results, numbers_wrench,
      { { 0, 0xf6ef5e7du, 6 }, { 0, 0x2a6be32fu, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x04e8e553u },
    { "matrices", sizeof results.matrices,
      call_matrices, take_matrices_results, numbers_matrices,
      { { 0, 0x2b307f44u, 32 }, { 0, 0x61a6ee8cu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xabdffa86u },
    { "momentum", sizeof results.momentum,
      call_momentum, take_momentum_results, numbers_momentum,
      { { 0, 0x847cacdfu, 16 }, { 0, 0x1b6b7908u, 16 }, { -2, 0x8e5b0aa0u, 0 } },
      0x1f44b2c0u },
    { "torque", sizeof results.torque,
      call_torque, take_torque_results, numbers_torque,
      { { 0, 0x4f9088aau, 6 }, { 0, 0x5f03079bu, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0xfa6c7131u },
    { "coupled", sizeof results.coupled,
      call_coupled, take_coupled_results, numbers_coupled,
      { { 0, 0x4b6d4eb4u, 12 }, { 0, 0xd113b79du, 12 }, { -2, 0x8e5b0aa0u, 0 } },
      0xde6b4186u },
    { "step", sizeof results.step,
      call_step, take_step_results, numbers_step,
      { { 0, 0x57086a10u, 25 }, { 0, 0x590c4358u, 25 }, { -2, 0x8e5b0aa0u, 0 } },
      0xa3ae2e34u },
    { "step_driven", sizeof results.step_driven,
      call_step_driven, take_step_driven_results, numbers_step_driven,
      { { 0, 0xc91a10bau, 25 }, { 0, 0xda1c3de9u, 25 }, { -2, 0x8e5b0aa0u, 0 } },
      0xd14316b3u },
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
      { { 0, 0xd8c5f596u, 32 }, { 0, 0x6a4b0b2au, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x094b5603u },
    { "coupled_jacobian", sizeof results.coupled_jacobian,
      call_coupled_jacobian, take_coupled_jacobian_results, numbers_coupled_jacobian,
      { { 0, 0xd2c3ccf9u, 32 }, { 0, 0xab8ec340u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x79f0b109u },
    { "inverse", sizeof results.inverse,
      call_inverse, take_inverse_results, numbers_inverse,
      { { 0, 0x1214d48eu, 25 }, { 0, 0x9b0648d3u, 25 }, { -2, 0x8e5b0aa0u, 0 } },
      0xfb5276ceu },
    { "inverse_fast", sizeof results.inverse_fast,
      call_inverse_fast, take_inverse_fast_results, numbers_inverse_fast,
      { { 0, 0x99a04ba3u, 6 }, { 0, 0x72660ea7u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x516c534cu },
    { "points", sizeof results.points,
      call_points, take_points_results, numbers_points,
      { { 0, 0x5d0ae681u, 24 }, { 0, 0x79777c4eu, 24 }, { -2, 0x8e5b0aa0u, 0 } },
      0x13d91ca9u },
    { "quaternion", sizeof results.quaternion,
      call_quaternion, take_quaternion_results, numbers_quaternion,
      { { 0, 0xcdc117bdu, 4 }, { 0, 0xdf1ec7e8u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0x15657920u },
    { "state_from_coordinates", sizeof results.state_from_coordinates,
      call_state_from_coordinates, take_state_from_coordinates_results, numbers_state_from_coordinates,
      { { 0, 0x65c14606u, 31 }, { 0, 0x4d40cc5fu, 31 }, { -2, 0x054a767bu, 25 } },
      0x2b77723fu },
    { "generalized", sizeof results.generalized,
      call_generalized, take_generalized_results, numbers_generalized,
      { { 0, 0xc5951b52u, 32 }, { 0, 0xc56758b4u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xc052ac6eu },
    { "prepare", sizeof results.prepare,
      call_prepare, take_prepare_results, numbers_prepare,
      { { 0, 0x75bc9b91u, 32 }, { 0, 0xa3e0e14cu, 32 }, { -2, 0xb25f73e4u, 32 } },
      0xce5408e7u },
    { "mounts", sizeof results.mounts,
      call_mounts, take_mounts_results, numbers_mounts,
      { { 0, 0xf350c984u, 32 }, { 0, 0xbd37ae03u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x6f6a26eau },
    { "prepare_mounts", sizeof results.prepare_mounts,
      call_prepare_mounts, take_prepare_mounts_results, numbers_prepare_mounts,
      { { 0, 0x1e8c1beau, 32 }, { 0, 0x15fd76e7u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x46a5bbc6u },
    { "center_of_mass_velocity", sizeof results.center_of_mass_velocity,
      call_center_of_mass_velocity, take_center_of_mass_velocity_results, numbers_center_of_mass_velocity,
      { { 0, 0x36d9eb67u, 3 }, { 0, 0x0db9b20fu, 3 }, { -2, 0x8e5b0aa0u, 0 } },
      0x3e089d03u },
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
static auv6_real draw_real(uint32_t *seed, auv6_real largest)
{
    const int32_t part = (int32_t)(draw_word(seed) >> 8) - 8388608;
    return largest * ((auv6_real)part / 8388608.0);
}

static void draw_reals(uint32_t *seed, auv6_real *values, int count, auv6_real largest)
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
static void draw_attitude(uint32_t *seed, auv6_real attitude[4], int refused)
{
    const uint32_t word = draw_word(seed);
    const int32_t a = 2 * (int32_t)(word >> 25) - 127;  /* odd: not all are 0 */
    const int32_t b = (int32_t)((word >> 16) & 0xffu) - 128;
    const int32_t c = (int32_t)((word >> 8) & 0xffu) - 128;
    const int32_t d = (int32_t)(word & 0xffu) - 128;
    const auv6_real norm = (auv6_real)(a * a + b * b + c * c + d * d);
    const auv6_real factor = refused != 0 ? 2.0 : 1.0;
    attitude[0] = factor * ((auv6_real)(a * a - b * b - c * c - d * d) / norm);
    attitude[1] = factor * ((auv6_real)(2 * a * b) / norm);
    attitude[2] = factor * ((auv6_real)(2 * a * c) / norm);
    attitude[3] = factor * ((auv6_real)(2 * a * d) / norm);
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
static auv6_real draw_step(const uint32_t *seed)
{
    (void)seed;
    return 0x1p-14;
}

static auv6_real draw_factor(uint32_t *seed, auv6_real largest)
{
    return 1.0 + draw_real(seed, largest);
}

static void draw_inputs(uint32_t *seed, unsigned long state)
{
    const auv6_real fast = state % 4ul == 3ul ? 32.0 : 1.0;
    const int refused = state % 16ul == 15ul ? 1 : 0;
    draw_reals(seed, in.x.position, 3, 2.0);
    draw_attitude(seed, in.x.attitude, refused);
    draw_reals(seed, in.x.V, 6, 2.0);
    draw_reals(seed, in.x.phi, AUV6_N, 16.0 * fast);
    draw_reals(seed, in.x.phi_dot, AUV6_N, 256.0 * fast);
    draw_reals(seed, in.phi_ddot, AUV6_N, 512.0);
    draw_reals(seed, in.V_dot, 6, 16.0);
    draw_reals(seed, in.tau, AUV6_N, 2.0);
    draw_flags(seed, in.locked, AUV6_N);
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
    parameters = auv6_default_parameters;
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
    for (int i = 0; i < AUV6_N; ++i) {
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
    auv6_status found;
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
    const auv6_real *numbers = f->numbers;
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
int auv6_selftest(void (*print)(const char *text), unsigned long sweep)
{
    int failures = 0;
    length = 0u;
    (void)auv6_prepare_mounts(&auv6_default_parameters, &mounting);
    add_text("mahovik selftest auv6 structure 192ea446 physics 002b2abc real double");
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

#ifndef AUV6_SELFTEST_NO_MAIN
static void print_text(const char *text)
{
    (void)fputs(text, stdout);
}

int main(void)
{
    return auv6_selftest(print_text, AUV6_SELFTEST_SWEEP) != 0;
}
#endif
