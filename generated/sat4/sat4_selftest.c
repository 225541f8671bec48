/* sat4_selftest.c: does sat4.c give the right bits on this machine?
 * With -ffast-math or its parts it gives wrong results with status OK: this test fails.
 * mahovik 0.1.0; structure 60e5c883, physics 347c0b3b. Generated: change the stand file instead.
 *
 * Compile it with sat4.c as firmware is compiled (-std=c99 -ffp-contract=off; -fno-tree-vectorize as well by gcc
 * for x86-64 with FMA and for a Cortex-M55, or bits differ) and run it; on a board, define
 * SAT4_SELFTEST_NO_MAIN and call sat4_selftest with a function that prints a text, such as to a serial port.
 * Golden vectors: inputs and answers of the generator's interpreter as hexadecimal constants; each bit must agree.
 * Sweep: states drawn by an integer generator; one hash per function of all its answers is printed, to be
 * compared between machines. The log of a board is judged by `mahovik judge-log STAND.toml --log LOG`. It reads:
 *
 *     mahovik selftest sat4 structure 60e5c883 physics 347c0b3b real double
 *     generator mahovik 0.1.0
 *     forward PASS cases 4 worst 0 ulp      one line per function; FAIL gives the number of wrong cases
 *                                        (a distance above 1000000 ulp: worst more than 1000000 ulp)
 *     sweep 100                          states
 *     forward 0123abcd                   one line per function: FNV-1a hash of its statuses and outputs
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

enum { CASES = 3, FUNCTIONS = 25, SWEPT = 1 };

#define FAR ((real_bits)1000000u)  /* ulp: a worse distance is not printed as a number */

/* ---- inputs and results ---- */

/* Arguments of the functions, apart from the constants of the stand. */
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
    sat4_step_carry carry;
    sat4_real mass_factor;  /* multiplies all masses and inertias of the parameters */
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
    struct { sat4_step_carry carry; sat4_state next; } step_carried;
    struct { sat4_step_carry carry; sat4_state next; } step_driven_carried;
    struct { sat4_real center_of_mass_velocity[3]; } center_of_mass_velocity;
    unsigned char bytes[1];
} results;

enum { UNTOUCHED = 0x5a };  /* value of every byte of the results before a call */

/* ---- results: their hash, and their distance from the expected numbers ---- */

typedef struct tally {
    uint32_t hash;                /* FNV-1a of all bits so far, the lowest byte of a number first */
    const sat4_real *expected;  /* next expected numbers, `left` of them */
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

static real_bits bits_of(sat4_real value)
{
    union { sat4_real real; real_bits word; } both;
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
        take_reals(sum, value->I_[i], SAT4_N);
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

static void take_step_carry(tally *sum, const sat4_step_carry *value)
{
    take_reals(sum, value->rounding, 21);
}

/* ---- every function is called with the inputs, and its results are hashed and compared ---- */

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

static sat4_status call_step_carried(void)
{
    results.step_carried.carry = in.carry;
    return sat4_step_carried(&sat4_default, &in.x, in.tau, in.locked, in.dt, in.order,
        &results.step_carried.carry, &results.step_carried.next);
}

static void take_step_carried_results(tally *sum, sat4_status status)
{
    take_step_carry(sum, &results.step_carried.carry);
    if (status < 0) {
        untouched(sum, &results.step_carried.next, sizeof results.step_carried.next);
        return;
    }
    take_state(sum, &results.step_carried.next);
}

static sat4_status call_step_driven_carried(void)
{
    results.step_driven_carried.carry = in.carry;
    return sat4_step_driven_carried(&sat4_default, &in.x, in.phi_ddot, in.dt, in.order,
        &results.step_driven_carried.carry, &results.step_driven_carried.next);
}

static void take_step_driven_carried_results(tally *sum, sat4_status status)
{
    take_step_carry(sum, &results.step_driven_carried.carry);
    if (status < 0) {
        untouched(sum, &results.step_driven_carried.next, sizeof results.step_driven_carried.next);
        return;
    }
    take_state(sum, &results.step_driven_carried.next);
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
        .carry = {
            .rounding = { 0x1.cf1ac8p-26, 0x1.30188p-28, 0x1.942a08p-26, -0x1.92f53p-26, 0x1.c0d28p-26,
                0x1.9f33ep-26, 0x1.c06e04p-25, 0x1.6815p-29, -0x1.7e8e7p-27, 0x1.bc58ep-25, -0x1.58a2bp-25,
                0x1.554cc8p-26, 0x1.55fcep-26, -0x1.9f3ap-31, 0x1.9b4488p-26, 0x1.0a9aap-28, -0x1.9c2068p-26,
                -0x1.9ed4ep-28, -0x1.085ab8p-26, 0x1.968a6p-26, 0x1.cdc694p-25 },
        },
        .mass_factor = 0x1.dfb6c7p-1,
    },
    {   /* fast flywheels, large phases */
        .x = {
            .position = { -0x1.371e7p-1, -0x1.214c38p+0, 0x1.4171bp-2 },
            .attitude = { -0x1.e4bebda68f6d2p-1, -0x1.6595a3f19c01dp-3, 0x1.f9d9ee2a14e36p-4,
                0x1.ecc4d88e82b16p-3 },
            .V = { 0x1.0b38ap+1, -0x1.055d68p+2, -0x1.8f2aap+0, -0x1.763e6p-1, -0x1.df9aep+2,
                -0x1.f8caa4p+2 },
            .phi = { 0x1.3b88ccp+22, 0x1.8fd1ep+20, -0x1.0659ap+21, -0x1.b2c408p+22 },
            .phi_dot = { -0x1.0c99cp+12, -0x1.5e586p+13, 0x1.d5b01p+12, -0x1.6b39ap+13 },
        },
        .phi_ddot = { 0x1.499108p+8, -0x1.859fdp+8, 0x1.fdeeap+8, 0x1.1fb6fp+8 },
        .V_dot = { -0x1.2794p-2, 0x1.33ded8p+5, -0x1.4256p-2, -0x1.923cb8p+5, -0x1.67826p+5, 0x1.512658p+4 },
        .tau = { -0x1.3b3c18p-1, 0x1.8eec5p-1, -0x1.bb3d38p+0, 0x1.a3f8a8p+0 },
        .locked = { 0, 0, 1, 0 },
        .dt = 0x1p-14,
        .order = 2,
        .phi = 0x1.a1c0ecp+22,
        .count = -756511,
        .per_turn = 4060,
        .zero = 0x1.f688fp-2,
        .moved = -283,
        .encoder = {
            .counter = 7800,
            .place = 281,
            .moved = -296,
        },
        .counter = -16782,
        .bits = 16,
        .angles = { -0x1.466428p-2, -0x1.3db6a8p-1, -0x1.3d4554p-1 },
        .position = { -0x1.07562p-1, 0x1.a063e4p+0, -0x1.bdbb3p+0 },
        .q_dot = { 0x1.d98bf4p+0, 0x1.3c586p-2, -0x1.ed3ccp-1, 0x1.297088p-1, 0x1.c53fp-4, -0x1.d0ae24p+0 },
        .q_ddot = { -0x1.70a96cp+3, -0x1.49e8p-1, 0x1.70ed48p+2, -0x1.52138p-2, 0x1.26f56p+3, -0x1.28b67p+3 },
        .carry = {
            .rounding = { -0x1.7a5978p-26, 0x1.8ab58p-27, 0x1.b0decp-29, 0x1.7660dcp-25, 0x1.a35e68p-26,
                -0x1.16ceep-28, 0x1.63ddcp-28, 0x1.e05b2p-28, -0x1.68bbep-26, -0x1.cbd33cp-25,
                -0x1.c483b8p-25, -0x1.ed35p-30, -0x1.bdd86p-25, 0x1.f8f3ep-27, -0x1.ca174p-28, 0x1.bc5528p-26,
                0x1.67f6p-29, 0x1.7f7ed8p-26, 0x1.1db6ap-25, -0x1.046708p-25, 0x1.7c0718p-25 },
        },
        .mass_factor = 0x1.ce39eap-1,
    },
    {   /* out of range */
        .x = {
            .position = { 0x1.c57048p+39, -0x1.b7cac8p+39, -0x1.74596p+40 },
            .attitude = { -0x1.2772fd7b62341p-4, -0x1.2cd22bfb4cb75p-4, -0x1.be87f94905e02p+0,
                0x1.f23c18d8370fap-1 },
            .V = { 0x1.107154p+0, 0x1.9703bp-2, -0x1.0a47f8p-1, -0x1.3b6cap-2, -0x1.997158p+0,
                0x1.caa508p+0 },
            .phi = { 0x1.64ac8p+39, 0x1.49a318p+42, 0x1.c85dp+40, 0x1.c55c48p+42 },
            .phi_dot = { 0x1.ebfa1p+7, -0x1.afa2dp+5, -0x1.3dbc3cp+7, 0x1.e6041p+7 },
        },
        .phi_ddot = { 0x1.efbb3cp+8, -0x1.fcd4p+6, -0x1.05219cp+8, -0x1.1937p+3 },
        .V_dot = { -0x1.0b842cp+3, 0x1.7eee2p+1, -0x1.093c78p+3, -0x1.8ed23cp+3, -0x1.027accp+3,
            0x1.313078p+3 },
        .tau = { 0x1.f09e08p-1, -0x1.f2802p+0, -0x1.31426p-3, 0x1.947958p-1 },
        .locked = { 0, 1, 0, 0 },
        .dt = 0x0p+0,
        .order = 4,
        .phi = -0x1.7eaadp+43,
        .count = 136185,
        .per_turn = 0,
        .zero = 0x1.881898p+39,
        .moved = -191,
        .encoder = {
            .counter = 29169,
            .place = 214,
            .moved = -188,
        },
        .counter = -32662,
        .bits = 16,
        .angles = { 0x1.bf9368p+39, 0x1.82c238p+39, 0x1.7c810cp+39 },
        .position = { -0x1.0c3e8p+40, -0x1.482048p+40, 0x1.504548p+40 },
        .q_dot = { -0x1.247d8cp+0, 0x1.c8244p-3, 0x1.a2090cp+0, 0x1.e1a7c8p-1, -0x1.e5e79p-1, -0x1.db3bp-3 },
        .q_ddot = { -0x1.378368p+3, -0x1.c1742cp+3, -0x1.e7c7ep+0, -0x1.4df71p+2, 0x1.1b7a98p+3,
            -0x1.67b038p+2 },
        .carry = {
            .rounding = { 0x1.ad1878p-25, -0x1.1e24f4p-25, 0x1.81a498p-25, -0x1.7e5fe8p-26, 0x1.60fa6p-25,
                -0x1.3e177p-27, -0x1.9c3facp-25, -0x1.6771dp-26, -0x1.b1380cp-25, 0x1.77166p-26,
                -0x1.92b278p-25, 0x1.74d58p-27, 0x1.ae2418p-26, 0x1.29377p-27, -0x1.8574p-28, -0x1.e60618p-25,
                0x1.bd62p-25, -0x1.a79a1cp-25, -0x1.88b3dcp-25, 0x1.866584p-25, -0x1.ec054p-29 },
        },
        .mass_factor = -0x1.d16b35p-1,
    },
};

typedef struct answer {
    int status;
    uint32_t hash;  /* hash of the status and all outputs */
    int listed;     /* outputs whose numbers are given, at most 32 */
} answer;

static const sat4_real numbers_forward[] =
{
    0x1.000a1557788acp+0, 0x1.a90eb3b17bc6ep-2, -0x1.5b34d2cc3cad7p+1, 0x1.2c90f83739035p+2,
        -0x1.52a2e2033093cp+2, 0x1.0af45ae014c6bp-1,
    0x1.76a31b1bd25fp+4, 0x1.e008938842344p+3, -0x1.3b2b882c8e078p+4, -0x1.ac5be6368ef9ap+7,
        -0x1.726a235e23bf2p+8, 0x1.b4a616f8edad9p+8,
};

static const sat4_real numbers_matrices[] =
{
    0x1.dffffffffffffp+5, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.4e3c2632b8461p-3, 0x1.35a812d8cc4f6p-3, 0x0p+0,
        0x1.dffffffffffffp+5, 0x0p+0, 0x1.4e3c2632b8461p-3, 0x0p+0, 0x1.9ce06834dabddp-3, 0x0p+0, 0x0p+0,
        0x1.dffffffffffffp+5, -0x1.35a812d8cc4f6p-3, -0x1.9ce06834dabddp-3, 0x0p+0, 0x0p+0,
        0x1.4e3c2632b8461p-3, -0x1.35a812d8cc4f6p-3, 0x1.530cc62fceed2p+1, 0x1.f5b29b4b3c14bp-6,
        -0x1.70108fe605c12p-6, -0x1.4e3c2632b8461p-3, 0x0p+0, -0x1.9ce06834dabddp-3, 0x1.f5b29b4b3c14bp-6,
        0x1.3fea5d4acd852p+1, 0x1.838281503a94ap-7, 0x1.35a812d8cc4f6p-3, 0x1.9ce06834dabddp-3,
    0x1.dffffffffffffp+5, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.4e3be5a3cfb97p-3, 0x1.35a8d4751473ep-3, 0x0p+0,
        0x1.dffffffffffffp+5, 0x0p+0, 0x1.4e3be5a3cfb97p-3, 0x0p+0, 0x1.9ce25308c0826p-3, 0x0p+0, 0x0p+0,
        0x1.dffffffffffffp+5, -0x1.35a8d4751473ep-3, -0x1.9ce25308c0826p-3, 0x0p+0, 0x0p+0,
        0x1.4e3be5a3cfb97p-3, -0x1.35a8d4751473ep-3, 0x1.530faf7ec85d3p+1, 0x1.f4a1de22b814bp-6,
        -0x1.6f2764a1aed5dp-6, -0x1.4e3be5a3cfb97p-3, 0x0p+0, -0x1.9ce25308c0826p-3, 0x1.f4a1de22b814bp-6,
        0x1.3fe9bf06ecd31p+1, 0x1.821100b747623p-7, 0x1.35a8d4751473ep-3, 0x1.9ce25308c0826p-3,
};

static const sat4_real numbers_momentum[] =
{
    0x1.7f57bde24bd04p+6, 0x1.c9b72cbd1f663p+6, 0x1.b0b2288198203p+5, 0x1.99b3ec96c94e2p+2,
        0x1.d9b4b02335b74p-5, -0x1.0de87e69624e5p+2, 0x1.c7e61fb52d548p+4, -0x1.db58b2ec935c8p+3,
        0x1.36f1445f4af54p+7, 0x1.d14b3b3973be2p+7, 0x1.a2d22569abc45p+6, -0x1.e1cc0cac54edp+4,
        0x1.53dad0bea6e47p+10, 0x1.b866d58db61fep-9, -0x1.4a4ce0e74054cp-9, -0x1.64846d02e6b13p-9,
    0x1.f51a256cedf52p+6, -0x1.ed84698f649d2p+7, -0x1.6fc0f16b3509cp+6, -0x1.1272ac997aedp+7,
        -0x1.2129b4f328b0cp+7, -0x1.d3d0793a35042p+7, 0x1.13215d873f23ep+5, -0x1.e160798c4b25ap+7,
        -0x1.4202cfa9dcf3cp+7, 0x1.3622f8aaed1e8p+7, -0x1.28c8719f45694p+6, -0x1.a15ffbe3f06c4p+6,
        0x1.87cdd5783a17cp+21, 0x1.b868e11a66f19p-9, -0x1.4a4daf6bd18ccp-9, -0x1.6484282632e8p-9,
};

static const sat4_real numbers_torque[] =
{
    -0x1.16bcb3650d251p+3, 0x1.252c5d36d9768p+3, 0x1.32a9575cbd926p-2, 0x1.47595a3de2ab2p+1,
    0x1.5e6958cf915a1p+2, -0x1.c9c214b2033d5p+2, 0x1.60dbb23e8b3cbp+3, 0x1.6aa31466f096cp+2,
};

static const sat4_real numbers_coupled[] =
{
    0x1.fe834f9c6d892p-1, 0x1.b2cdb491344e2p-2, -0x1.5cd23b79b9f62p+1, 0x1.8f900a97df163p+0,
        -0x1.ac0d2b17c189fp+2, 0x1.d2a772aac3b7cp-3, 0x1.985ef98a9248dp+6, 0x1.a6658dfc91379p+6,
        0x1.0ba35f194727p+5, -0x1.c80d825cb60bep+0,
    0x1.7635a172783b5p+4, 0x1.df37b806bbabcp+3, -0x1.3b51d8a8d5647p+4, -0x1.a73f84d1b0903p+7,
        -0x1.771e6b613c211p+8, 0x1.ba2caea67b2d2p+8, 0x1.9a7b5920e2a18p+5, -0x1.dfe558b750098p+6, 0x0p+0,
        -0x1.07ab0e66c46c1p+8,
};

static const sat4_real numbers_step[] =
{
    -0x1.779a179f2cf87p-1, 0x1.80b85a987ee0ap+0, -0x1.10f68360ae66ap-4, 0x1.23d5bc0501d52p-1,
        -0x1.2f86cd1081375p-5, -0x1.fa5f05996d5efp-2, -0x1.4f6e3081349dep-1, 0x1.98d1b14cc46e9p+0,
        0x1.e628faa527c54p+0, 0x1.d11379f6c6258p-1, 0x1.f3f5f157b0759p+0, 0x1.45f9ee84797a5p-1,
        0x1.aad469cb68c32p-1, -0x1.0c6379695484p-3, 0x1.481b31ad5a002p+1, -0x1.256d9bd22e8edp+1,
        -0x1.a3cc39fa681a4p-1, -0x1.cf9b0f40a4ac6p+7, -0x1.e0ef366b774d9p+6, -0x1.c61b4c5d5bb96p+7,
        -0x1.3c4871f634daap+4,
    -0x1.3719b09437317p-1, -0x1.215c23f23be16p+0, 0x1.41468a222b6ebp-2, -0x1.e4b3f69891fe6p-1,
        -0x1.657d214b1607cp-3, 0x1.fa8ba2dcd4b9ap-4, 0x1.ed5289e73ff99p-3, 0x1.0b6498e183542p+1,
        -0x1.054fa5da8ca5ep+2, -0x1.8f7cab3c0d59p+0, -0x1.7d10c09fbf24cp-1, -0x1.e10e7281937d8p+2,
        -0x1.f7102cc469ee5p+2, -0x1.15900a08a6638p+1, -0x1.56948dafd85cfp-1, -0x1.b94be7d5c9508p+0,
        0x1.f6d0005488252p-2, -0x1.0c99b2c3f13adp+12, -0x1.5e586fc35c61cp+13, 0x1.d5b01p+12,
        -0x1.6b39c0451c1dfp+13,
};

static const sat4_real numbers_step_driven[] =
{
    -0x1.779a179f6a7dp-1, 0x1.80b85a98898e5p+0, -0x1.10f683605be25p-4, 0x1.23d5bc0d006c1p-1,
        -0x1.2f86cbc92c42ep-5, -0x1.fa5f05ad61bccp-2, -0x1.4f6e3073e04cep-1, 0x1.98d1b4689baaep+0,
        0x1.e628f0f8e275bp+0, 0x1.d113939118d3bp-1, 0x1.f4027c3f20d1p+0, 0x1.46051b5eed609p-1,
        0x1.aad6c32e41045p-1, -0x1.0c640424af9eep-3, 0x1.481b37656949fp+1, -0x1.256d9c0abb4p+1,
        -0x1.a3cc30902f33ep-1, -0x1.cfac66ac8p+7, -0x1.e0d8562dcp+6, -0x1.c61bbd768p+7, -0x1.3c22c917p+4,
    -0x1.3719b093bad77p-1, -0x1.215c23f231684p+0, 0x1.41468a22e358bp-2, -0x1.e4b3f696258b2p-1,
        -0x1.657d2137c2cbbp-3, 0x1.fa8ba15aaf903p-4, 0x1.ed528a7e7a7adp-3, 0x1.0b64a6f986cd1p+1,
        -0x1.054f9f413e33p+2, -0x1.8f7ca19e09dafp+0, -0x1.7d24939179635p-1, -0x1.e109ca514855p+2,
        -0x1.f715b5652f369p+2, -0x1.159005af9ffp+1, -0x1.56949e8a3ffa1p-1, -0x1.b94bd7e654508p+0,
        0x1.f6d04540c7f2p-2, -0x1.0c996d9bbep+12, -0x1.5e5890b3fap+13, 0x1.d5b08f7ba8p+12,
        -0x1.6b397c0922p+13,
};

static const sat4_real numbers_wrap[] =
{
    0x1.f4c8ea22168c2p-1,
    0x1.76b37140b35eap-3,
};

static const sat4_real numbers_phase_of_counts[] =
{
    -0x1.861b1193a76cp+0,
    -0x1.0bb7b3108712ep+1,
};

static const sat4_real numbers_speed_of_counts[] =
{
    0x1.6a142831f01f5p+11,
    -0x1.c07a202ad63fbp+12,
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
    -0x1.96cc499b36978p-57, -0x1.f8caa40000001p+2, 0x1.df9ae00000001p+2, -0x1.ae5fd31a394f2p-2,
        0x1.a8d313f6ab1c4p+0, -0x1.fe521c400d22fp+1, 0x1.f8caa40000001p+2, 0x1.ebb6fd092c758p-60,
        -0x1.763e6p-1, -0x1.bb97f1cc124dap+0, -0x1.0d03337116bap-5, -0x1.eec2a7f79ce95p+0,
        -0x1.df9ae00000001p+2, 0x1.763e6p-1, -0x1.37ed09973ac63p-56, 0x1.ea9ec7d5f6af5p+1,
        0x1.278c6a84ee282p+1, 0x1.7fe639cda93aep-5, -0x1.ad9fede5fe63fp-55, -0x1.1e3ff5e301a84p-49,
        -0x1.71f81e45857d7p-48, 0x1.733fb1ff08bffp+0, 0x1.42283e15ce728p+6, -0x1.84e1fbfd75a08p+5,
        0x1.7fe5ba8e3a0ap-52, -0x1.44c029e115d68p-54, -0x1.54a0c30a38182p-50, -0x1.540b97cf5f048p+6,
        -0x1.384b0a651c93ep-1, 0x1.ba597962212a6p+5, 0x1.552f3585e43a2p-48, 0x1.408882356cf1bp-50,
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
    -0x1.b47d23d193d22p-57, -0x1.f8caa3fffffffp+2, 0x1.df9adfffffffep+2, -0x1.b08a3910d8ca2p-2,
        0x1.a8c1dda05db17p+0, -0x1.fe20d89e0f283p+1, 0x1.f8caa3fffffffp+2, 0x1.5dc2c0c28894fp-59,
        -0x1.763e5ffffffffp-1, -0x1.bc188ea20499p+0, -0x1.0e91ce380abcp-5, -0x1.ee6af5ed7726fp+0,
        -0x1.df9adffffffffp+2, 0x1.763e6p-1, -0x1.42ec050dd513fp-56, 0x1.ea84cff5956dap+1,
        0x1.2787972983b6bp+1, 0x1.84f15b14b944ep-5, 0x1.dbbe11afa6eep-55, -0x1.1ff0c7804f875p-49,
        -0x1.73f481c91ea59p-48, 0x1.d1dc99074cd53p+0, 0x1.43eb85f14a1cep+6, -0x1.88dba9064de6ep+5,
        0x1.f572da3579f1fp-52, 0x1.748486deb461cp-53, -0x1.81ce1401ac9dfp-50, -0x1.56194e19cf4b9p+6,
        -0x1.f7e450fa55823p-1, 0x1.becc44e702fc7p+5, 0x1.74208f1aa6a9dp-48, 0x1.06dfafcd2a981p-50,
};

static const sat4_real numbers_inverse[] =
{
    -0x1.1b7961b1a500cp+26, 0x1.1b793d1bb69e7p+26, -0x1.1b7b0e20f12fap+26, 0x1.1b7caf9bbb8acp+26,
        0x1.264720cb39e87p+6, 0x1.03db7e0ec8176p+10, -0x1.bb4d14a3d503p+7, 0x1.b1978000cp+1, 0x1.17b8f032p-1,
        0x1.d6c2a6fdp+1, 0x1.bd4cf6f0cd543p-4, 0x1.9df56e3d4a129p-4, 0x1.912d1c4dc66p-4,
        0x1.1da02f9a7bf4bp-19, 0x0p+0, 0x1.11e039d23e1bep-1, 0x1.e3aefb870a5acp+2, -0x1.9c9148a75536cp+0,
        0x1.93880699f7c74p-6, 0x1.04545e61f4b1cp-8, 0x1.b61f80c09342ep-6,
    -0x1.004c2aea83p+29, 0x1.004d58d0cae22p+29, -0x1.0044b071bea4dp+29, 0x1.004f01e2145c5p+29,
        0x1.b9e5aec1ad425p+7, -0x1.26c48e7b5a4e8p+10, -0x1.633fb8a5c9596p+10, 0x1.7e4236bp-2, 0x1.0aeee248p+2,
        -0x1.b30c0a32p+1, 0x1.bd503c13986a4p-4, 0x1.9df4e69a9eae8p-4, 0x1.912a8721437c9p-4,
        0x1.405f73876bb87p-20, 0x0p+0, 0x1.d734087f04efep-1, -0x1.3a51010f601ebp+2, -0x1.7acefe162f3ecp+2,
        0x1.979c0b706cf0ep-10, 0x1.1ca2c416fbc5fp-6, -0x1.cfe61747c1719p-7,
};

static const sat4_real numbers_inverse_fast[] =
{
    -0x1.1b795eb077ad1p+26, 0x1.1b793a1a86c5cp+26, -0x1.1b7b0b1fbe089p+26, 0x1.1b7cac9a8a99ap+26,
    -0x1.004c2557c6b3bp+29, 0x1.004d533e0a884p+29, -0x1.0044aadf04d5cp+29, 0x1.004efc4f564edp+29,
};

static const sat4_real numbers_points[] =
{
    -0x1.ac22be1e126eep-1, 0x1.b015d9a907a4bp+0, 0x1.6edf94c8925acp-4, 0x1.73e03e191f0fcp-4,
        0x1.b4642fa1014ebp-1, -0x1.07b720737a69dp-1, -0x1.17622e6d4d739p-1, 0x1.e6a29d8df443cp-2,
        0x1.61642a45c6eap-1, 0x1.aa87bd625342bp-1, 0x1.bf4502ef4b5acp-3, 0x1.04378628d168fp-1,
        0x1.18b98843cacp+1, 0x1.5c777b181f4c4p-2, 0x1.f927fa3d70a42p-1, 0x1.01407fafc5cdp+1,
        -0x1.b2e735bb92084p-2, 0x1.aad2980000003p-1, -0x1.5bfba51d70076p+2, -0x1.910624fa78bd6p+3,
        0x1.ec9042d707512p+2, -0x1.b543c29e9d4dap+1, 0x1.b632997706ab4p+3, -0x1.7d81500000003p+2,
    -0x1.58fc843cd6abfp-1, -0x1.2aeaf3ae0d9dbp+0, 0x1.21a727339be21p-1, 0x1.e422233e3c21cp-1,
        -0x1.1d3e305157188p-4, -0x1.45800cb5bb684p-2, -0x1.4c73dfc360dbp-6, 0x1.ecb4588cf1aecp-1,
        -0x1.15b16f2e81bp-2, 0x1.4c9253694a143p-2, 0x1.0d2f1495cc4fep-2, 0x1.d12a1eb7df8d5p-1,
        -0x1.8d94d33d9aab1p+0, -0x1.ccbc4340ad008p+1, -0x1.96a6c0a3d70a7p+0, -0x1.1850c825a35c9p+2,
        -0x1.87f5b9f2c43f1p+2, -0x1.f8caa40000004p+2, -0x1.fdc0bda2d9bap+1, 0x1.c2caf3471a7fap+5,
        0x1.f6cc0a773182dp+1, -0x1.080d16c345d06p+6, -0x1.b8e6fd557cef8p+3, 0x1.5126580000003p+4,
};

static const sat4_real numbers_quaternion[] =
{
    0x1.aa4a340f19d19p-1, 0x1.25fbc92e62904p-2, 0x1.25c321255aaafp-3, 0x1.ce42528bd4593p-2,
    0x1.c2e3b3da6d597p-1, -0x1.54cbc68fc41a9p-2, -0x1.ed98a0cdf34ecp-3, -0x1.e2fd23fddd089p-3,
};

static const sat4_real numbers_state_from_coordinates[] =
{
    0x1.e7f3ap-2, -0x1.100f98p-1, -0x1.ae09ap+0, 0x1.aa4a340f19d19p-1, 0x1.25fbc92e62904p-2,
        0x1.25c321255aaafp-3, 0x1.ce42528bd4593p-2, 0x1.88010a02f35bp-2, 0x1.edf30e4d09bfdp-1,
        -0x1.b0985ff9914c8p-1, -0x1.a3c1c31587097p+0, 0x1.9b14e61f53cd6p-1, 0x1.978e137457a19p+0,
        -0x1.95dd5cp+3, 0x1.e462ap+3, -0x1.23a78p+1, -0x1.c68578p+2, -0x1.cf9e4p+7, -0x1.e0f5dp+6,
        -0x1.c61c58p+7, -0x1.3c48p+4, 0x1.a89c20d45efb1p+0, 0x1.1dd29e0c17c3p-5, 0x1.d8ea47b774632p+2,
        -0x1.0fa43a0213ec1p+3, 0x1.26897d38d5a11p+2, -0x1.3010d51448adcp+0,
    -0x1.07562p-1, 0x1.a063e4p+0, -0x1.bdbb3p+0, 0x1.c2e3b3da6d597p-1, -0x1.54cbc68fc41a9p-2,
        -0x1.ed98a0cdf34ecp-3, -0x1.e2fd23fddd089p-3, 0x1.9495d99d94513p-1, 0x1.b9f6014c1fb03p+0,
        -0x1.d55717f597178p-1, -0x1.7a34443d0bc39p+0, -0x1.79aa421bb6c62p-3, 0x1.cbcc02d2cee41p-2,
        0x1.3b88ccp+22, 0x1.8fd1ep+20, -0x1.0659ap+21, -0x1.b2c408p+22, -0x1.0c99cp+12, -0x1.5e586p+13,
        0x1.d5b01p+12, -0x1.6b39ap+13, -0x1.31d2273f01cdfp+2, -0x1.1934f3f0775f5p+3, 0x1.1b516d340e6bcp+3,
        -0x1.308785e352f18p+3, 0x1.b4aa61677753bp+2, 0x1.35226e7b587d9p+2,
    0x1.c57048p+39, -0x1.b7cac8p+39, -0x1.74596p+40, -0x1.2772fd7b62341p-4, -0x1.2cd22bfb4cb75p-4,
        -0x1.be87f94905e02p+0, 0x1.f23c18d8370fap-1, 0x1.107154p+0, 0x1.9703bp-2, -0x1.0a47f8p-1,
        -0x1.3b6cap-2, -0x1.997158p+0, 0x1.caa508p+0, 0x1.64ac8p+39, 0x1.49a318p+42, 0x1.c85dp+40,
        0x1.c55c48p+42, 0x1.ebfa1p+7, -0x1.afa2dp+5, -0x1.3dbc3cp+7, 0x1.e6041p+7,
};

static const sat4_real numbers_generalized[] =
{
    0x1.1a419f4e7869dp-1, 0x1.ab0b55883a79bp-1, 0x1.4d659bd0cbp-6, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.56b505010e943p-1, 0x1.b5d91d5c2b14cp-2, 0x1.371361c707286p-1, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.fe023509c127cp-2, -0x1.64eda32199115p-2, 0x1.9687e78c3c88cp-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.4d659bd0cb012p-6, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.371361c707285p-1,
        0x1.969d754af8bedp-1, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.8b90c93cf4e24p-1, -0x1.0511626a8f0a9p-2, 0x1.29b66a16d646ap-1, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.26ce9851d9d1cp-1, 0x1.55a0a239e572bp-1, -0x1.e3d524a70a2ccp-2, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.11f07f99cf01ap-2, 0x1.6652c0d3860afp-1, 0x1.53193231ddfa5p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.29b66a16d6469p-1, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.e3d524a70a2cap-2,
        0x1.a0cdd6439e9f1p-1, 0x0p+0, 0x0p+0, 0x0p+0,
};

static const sat4_real numbers_prepare[] =
{
    0x1.c1bb5a9p+5, 0x1.2371dd104777p-6, 0x1.82d7629fbe76ep-3, -0x1.222189f7ced92p-3, -0x1.392843a5e353bp-3,
        0x1.3dae8d9f56757p+1, 0x1.2bbc21704ea4bp+1, 0x1.02b5927ca9bdp+1, 0x1.d5cf426e54717p-6,
        -0x1.582759b951c5bp-6, 0x1.6ab8db62c7756p-7, -0x1.0ac3caf2522cap-20, 0x1.0ac3caf2522cap-20, 0x0p+0,
        -0x1.340891e2cbd27p-21, -0x1.340891e2cbd27p-21, 0x1.340891e2cbd27p-20, 0x1.531674e218cfp-22,
        -0x1.04d63286893cap-23, -0x1.a156b73da8614p-23, 0x1.a156b73da8614p-24, -0x1.13106d22d1e3p-23,
        0x1.0994460ff6c93p-25, -0x1.00b1cee7a9da1p-21, -0x1.2fed2620a024fp-23, -0x1.0f11c80f42b94p-22,
        0x1.0f11c80f42b93p-23, -0x1.132d33d16e66bp-22, -0x1.79dab9c7b2577p-24, -0x1.13165182a9954p-16,
        -0x1.13165182a9954p-16, 0x1.13165182a9955p-15,
    0x1.b1564b6000001p+5, 0x1.2e78a23deaf85p-6, 0x1.74bd3e219652cp-3, -0x1.178dee9930bep-3,
        -0x1.2dbdc495182acp-3, 0x1.3219d4fcde20ap+1, 0x1.20cee59b890d4p+1, 0x1.f28e689d27808p+0,
        0x1.c4aed3cb8edf2p-6, -0x1.4b9b9594a1e32p-6, 0x1.5d7fcdcf96abcp-7, -0x1.010a3f620a0acp-20,
        0x1.010a3f620a0acp-20, 0x0p+0, -0x1.28cde4061f0ap-21, -0x1.28cde4061f0ap-21, 0x1.28cde4061f0ap-20,
        0x1.46b9f7d1f3bbcp-22, -0x1.f6a7f36a63485p-24, -0x1.921ff5eeb5d36p-23, 0x1.921ff5eeb5d36p-24,
        -0x1.09096dba6c341p-23, 0x1.ffcb96188a52ep-26, -0x1.eeac7c0a33bb5p-22, -0x1.24d8cc80eb6cep-23,
        -0x1.053010574e83cp-22, 0x1.053010574e83cp-23, -0x1.092527dc8220dp-22, -0x1.6c1473de8c79ap-24,
        -0x1.090f1b1d92ba9p-16, -0x1.090f1b1d92ba9p-16, 0x1.090f1b1d92baap-15,
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
    0x1.c30369ba4ec08p+2, 0x1.37f97a97383acp+6, 0x1.aea7fe9f07ecap+6, 0x1.5e6958cf9159ep+2,
        0x1.fcbb1fd549f3dp+7, -0x1.8b549aa80ad6cp+8, 0x1.2ae1019424ad2p+5, -0x1.b7c59678bb25dp+5,
        -0x1.2e491173302e9p+7, -0x1.c9c214b2033d6p+2, 0x1.838f8fd12b039p+9, 0x1.329a009ff7274p+10,
        0x1.13dac50403d4bp+2, -0x1.9716953083ac5p+6, -0x1.d86d5972107ap+1, 0x1.60dbb23e8b3ccp+3,
        -0x1.6271e0661ee28p+10, -0x1.527a63d3762e9p+9, -0x1.04fe144e65f93p+5, -0x1.3056c42c7740ep+7,
        0x1.f412f92b054d8p+7, 0x1.6aa31466f096ep+2, 0x1.febd6ea1cc766p+10, -0x1.3c815403616p+10,
};

static const sat4_real numbers_prepare_mounts[] =
{
    0x1.1fd411p+1, 0x0p+0, 0x1.79432df505d1p-20, 0x0p+0, 0x1.252f928f12c28p-6, 0x1.427d97c8f3237p-7,
        0x1.45b6dabd7b203p-7, -0x1.e846b69555bffp-77, -0x1.baa7921540d9fp-23, 0x0p+0, 0x1.c28f5c28f5c29p-4,
        0x1.c28f5c28f5c29p-4, -0x1.47ae147ae147bp-4, 0x1.279a74590331dp-1, -0x1.6a09e667f3bccp-1,
        -0x1.a20bd700c2c3ep-2, 0x1.279a74590331dp-1, 0x1.6a09e667f3bccp-1, -0x1.a20bd700c2c3ep-2,
        0x1.279a74590331dp-1, 0x0p+0, 0x1.a20bd700c2c3ep-1, 0x1.1fd411p+1, 0x0p+0, 0x1.02100cb56e3e3p-21,
        0x1.6282be0874496p-20, 0x1.252f928f12c28p-6, 0x1.427d97c8f3237p-7, 0x1.45b6dabd7b203p-7,
        -0x1.9ff590772574dp-23, 0x1.2ecb26ce0d4c4p-24, 0x0p+0,
    0x1.1555f2ccccccdp+1, 0x0p+0, 0x1.6b826e5471717p-20, 0x0p+0, 0x1.1a7f74f88fc94p-6, 0x1.36bbfea52ef91p-7,
        0x1.39d72bf687b14p-7, -0x1.d679f1a652337p-77, -0x1.aa848f1b6662ep-23, 0x0p+0, 0x1.c28f5c28f5c29p-4,
        0x1.c28f5c28f5c29p-4, -0x1.47ae147ae147bp-4, 0x1.279a74590331dp-1, -0x1.6a09e667f3bccp-1,
        -0x1.a20bd700c2c3ep-2, 0x1.279a74590331dp-1, 0x1.6a09e667f3bccp-1, -0x1.a20bd700c2c3ep-2,
        0x1.279a74590331dp-1, 0x0p+0, 0x1.a20bd700c2c3ep-1, 0x1.1555f2ccccccdp+1, 0x0p+0,
        0x1.f14f6e7d5b59bp-22, 0x1.55965225d9e1fp-20, 0x1.1a7f74f88fc94p-6, 0x1.36bbfea52ef91p-7,
        0x1.39d72bf687b14p-7, -0x1.90cbaee4bb61dp-23, 0x1.23c15f8a6560ep-24, 0x0p+0,
};

static const sat4_real numbers_step_carried[] =
{
    0x1.1c68p-55, -0x1.89ap-56, -0x1.8p-59, 0x1.97dc9p-57, -0x1.58f42cp-59, 0x1.c634c8p-56, -0x1.57e01cp-55,
        0x1.a32p-56, -0x1.0a4p-55, -0x1.4d8p-55, -0x1.c8p-57, -0x1.908p-55, 0x1.584p-56, 0x1p-56, -0x1.d2p-53,
        -0x1.2p-56, 0x1.ep-55, -0x1.bf8p-48, 0x1.9bdp-48, -0x1.2ep-53, 0x1.648p-56, -0x1.779a16b79f947p-1,
        0x1.80b85aab8068ap+0, -0x1.10f67d100646ap-4, 0x1.23d5bc63b1b6fp-1, -0x1.2f86c03df5201p-5,
        -0x1.fa5f05fc1c538p-2, -0x1.4f6e30152f283p-1, 0x1.98d1b15805169p+0, 0x1.e628fa7555f74p+0,
        0x1.d1137bb31f058p-1, 0x1.f3f5f0ab5f1d9p+0,
    -0x1.241p-55, 0x1.816p-54, -0x1.7p-60, 0x1.cb8378p-56, -0x1.2d02f8p-57, -0x1.291f8p-60, 0x1.e66ca4p-57,
        0x1.5e8p-53, 0x1.5cap-52, -0x1.82p-54, -0x1.4p-57, -0x1.bp-54, 0x1.98p-52, 0x1p-52, -0x1.fp-55,
        0x0p+0, 0x0p+0, 0x1.9e8fcp-42, -0x1.48f44p-41, 0x1.fp-42, 0x1.8489p-42, -0x1.3719b15163ed7p-1,
        -0x1.215c23c0e5316p+0, 0x1.41468a584746bp-2, -0x1.e4b3f68e4d1efp-1, -0x1.657d1f10e4f68p-3,
        0x1.fa8ba3428a4edp-4, 0x1.ed528c0bc46cap-3, 0x1.0b6498f0862d2p+1, -0x1.054fa5f11863ep+2,
        -0x1.8f7cac21f6f7p+0, -0x1.7d10c26442dccp-1,
    0x1.ad1878p-25, -0x1.1e24f4p-25, 0x1.81a498p-25, -0x1.7e5fe8p-26, 0x1.60fa6p-25, -0x1.3e177p-27,
        -0x1.9c3facp-25, -0x1.6771dp-26, -0x1.b1380cp-25, 0x1.77166p-26, -0x1.92b278p-25, 0x1.74d58p-27,
        0x1.ae2418p-26, 0x1.29377p-27, -0x1.8574p-28, -0x1.e60618p-25, 0x1.bd62p-25, -0x1.a79a1cp-25,
        -0x1.88b3dcp-25, 0x1.866584p-25, -0x1.ec054p-29,
};

static const sat4_real numbers_step_driven_carried[] =
{
    -0x1.3d2p-55, 0x1.f33p-54, -0x1.9p-60, -0x1.596d88p-56, -0x1.82c2dp-59, 0x1.8c9dep-58, -0x1.28cdp-60,
        -0x1.5b8p-57, 0x1.ae14p-54, -0x1.f1p-57, 0x1.edp-56, 0x1.8ep-55, -0x1.67ap-55, -0x1p-56, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1p-47, 0x1p-47, 0x0p+0, 0x0p+0, -0x1.779a16b7dd19p-1, 0x1.80b85aab8b165p+0,
        -0x1.10f67d0fb3c25p-4, 0x1.23d5bc6bb04dep-1, -0x1.2f86bef6a02a4p-5, -0x1.fa5f061010b15p-2,
        -0x1.4f6e3007dad72p-1, 0x1.98d1b473dc52ep+0, 0x1.e628f0c910a7bp+0, 0x1.d113954d71b3bp-1,
        0x1.f4027b92cf79p+0,
    0x1.a6ap-55, -0x1.82cp-55, -0x1.04p-56, -0x1.d2945p-55, 0x1.5d46f4p-57, 0x1.27be58p-59, 0x1.d9ef3p-57,
        0x1.97p-54, -0x1.14p-56, -0x1.b7p-54, -0x1.ep-56, -0x1.5cp-52, 0x1.2cp-52, -0x1p-52, -0x1.fp-55,
        0x0p+0, 0x0p+0, -0x1.28p-42, -0x1.6p-41, 0x1.fp-42, -0x1.dp-42, -0x1.3719b150e7937p-1,
        -0x1.215c23c0dab84p+0, 0x1.41468a58ff30bp-2, -0x1.e4b3f68be0ab8p-1, -0x1.657d1efd91ba6p-3,
        0x1.fa8ba1c065241p-4, 0x1.ed528ca2feee2p-3, 0x1.0b64a70889a61p+1, -0x1.054f9f57c9f1p+2,
        -0x1.8f7ca283f378fp+0, -0x1.7d249555fd1b5p-1,
    0x1.ad1878p-25, -0x1.1e24f4p-25, 0x1.81a498p-25, -0x1.7e5fe8p-26, 0x1.60fa6p-25, -0x1.3e177p-27,
        -0x1.9c3facp-25, -0x1.6771dp-26, -0x1.b1380cp-25, 0x1.77166p-26, -0x1.92b278p-25, 0x1.74d58p-27,
        0x1.ae2418p-26, 0x1.29377p-27, -0x1.8574p-28, -0x1.e60618p-25, 0x1.bd62p-25, -0x1.a79a1cp-25,
        -0x1.88b3dcp-25, 0x1.866584p-25, -0x1.ec054p-29,
};

static const sat4_real numbers_center_of_mass_velocity[] =
{
    0x1.e64acc7cfd271p-2, -0x1.fb094762bf524p-3, 0x1.4bac04a9e98e4p+1,
    0x1.2578ec4bff14fp-1, -0x1.00bbfc8f17031p+2, -0x1.577a771b96598p+1,
};

typedef struct function {
    const char *name;
    size_t size;  /* bytes of its results */
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
      { { 0, 0x0c4c5adbu, 6 }, { 0, 0x8847ac39u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x011f6d54u },
    { "matrices", sizeof results.matrices,
      call_matrices, take_matrices_results, numbers_matrices,
      { { 0, 0x3d3535c3u, 32 }, { 0, 0x0a90ecb2u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xc4e7e296u },
    { "momentum", sizeof results.momentum,
      call_momentum, take_momentum_results, numbers_momentum,
      { { 0, 0x69737d59u, 16 }, { 0, 0xaa726419u, 16 }, { -2, 0x8e5b0aa0u, 0 } },
      0x8062f212u },
    { "torque", sizeof results.torque,
      call_torque, take_torque_results, numbers_torque,
      { { 0, 0x4a5512f2u, 4 }, { 0, 0x1fe3d7ceu, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0xda4dcef4u },
    { "coupled", sizeof results.coupled,
      call_coupled, take_coupled_results, numbers_coupled,
      { { 0, 0xf32c8989u, 10 }, { 0, 0x78e4abb5u, 10 }, { -2, 0x8e5b0aa0u, 0 } },
      0xd93520cbu },
    { "step", sizeof results.step,
      call_step, take_step_results, numbers_step,
      { { 0, 0x4623e42bu, 21 }, { 32, 0x82b44c1bu, 21 }, { -2, 0x8e5b0aa0u, 0 } },
      0x226a3b26u },
    { "step_driven", sizeof results.step_driven,
      call_step_driven, take_step_driven_results, numbers_step_driven,
      { { 0, 0xe89b274bu, 21 }, { 32, 0x1d57ae0du, 21 }, { -2, 0x8e5b0aa0u, 0 } },
      0x37bf39b9u },
    { "wrap", sizeof results.wrap,
      call_wrap, take_wrap_results, numbers_wrap,
      { { 0, 0x34ef7e98u, 1 }, { 0, 0x4f739867u, 1 }, { -2, 0x8e5b0aa0u, 0 } },
      0x13690883u },
    { "phase_of_counts", sizeof results.phase_of_counts,
      call_phase_of_counts, take_phase_of_counts_results, numbers_phase_of_counts,
      { { 0, 0x53ece381u, 1 }, { 0, 0x06835769u, 1 }, { -5, 0x2107376du, 0 } },
      0x69e412fdu },
    { "speed_of_counts", sizeof results.speed_of_counts,
      call_speed_of_counts, take_speed_of_counts_results, numbers_speed_of_counts,
      { { 0, 0xd327e29au, 1 }, { 0, 0xb00ef5f7u, 1 }, { -5, 0x2107376du, 0 } },
      0xaf1b666eu },
    { "accumulate", sizeof results.accumulate,
      call_accumulate, take_accumulate_results, numbers_accumulate,
      { { 0, 0xe445cbdbu, 0 }, { 0, 0x575d45cdu, 0 }, { -5, 0x30487ea6u, 0 } },
      0x77ab77cdu },
    { "forward_jacobian", sizeof results.forward_jacobian,
      call_forward_jacobian, take_forward_jacobian_results, numbers_forward_jacobian,
      { { 0, 0x95573716u, 32 }, { 0, 0x34a371eau, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xf842bf7fu },
    { "coupled_jacobian", sizeof results.coupled_jacobian,
      call_coupled_jacobian, take_coupled_jacobian_results, numbers_coupled_jacobian,
      { { 0, 0x648e393fu, 32 }, { 0, 0xa6758084u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x3a5f669fu },
    { "inverse", sizeof results.inverse,
      call_inverse, take_inverse_results, numbers_inverse,
      { { 8, 0xa03a969fu, 21 }, { 8, 0x104cf09au, 21 }, { -2, 0x8e5b0aa0u, 0 } },
      0xba078ed8u },
    { "inverse_fast", sizeof results.inverse_fast,
      call_inverse_fast, take_inverse_fast_results, numbers_inverse_fast,
      { { 0, 0xb22a69c4u, 4 }, { 0, 0x40eeef33u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0x12bbf383u },
    { "points", sizeof results.points,
      call_points, take_points_results, numbers_points,
      { { 0, 0xb822e313u, 24 }, { 0, 0x356e01a7u, 24 }, { -2, 0x8e5b0aa0u, 0 } },
      0xa21f165fu },
    { "quaternion", sizeof results.quaternion,
      call_quaternion, take_quaternion_results, numbers_quaternion,
      { { 0, 0x2b4cc305u, 4 }, { 0, 0x306bed1au, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0x2d84727du },
    { "state_from_coordinates", sizeof results.state_from_coordinates,
      call_state_from_coordinates, take_state_from_coordinates_results, numbers_state_from_coordinates,
      { { 0, 0xa7ba7446u, 27 }, { 0, 0xa0dac0f7u, 27 }, { -2, 0x84baeef0u, 21 } },
      0x5440b662u },
    { "generalized", sizeof results.generalized,
      call_generalized, take_generalized_results, numbers_generalized,
      { { 0, 0x3b894d02u, 32 }, { 0, 0x84413cb8u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xa091c159u },
    { "prepare", sizeof results.prepare,
      call_prepare, take_prepare_results, numbers_prepare,
      { { 0, 0x32cdb802u, 32 }, { 0, 0xf484e976u, 32 }, { -2, 0x01eae4eau, 32 } },
      0xd252886du },
    { "mounts", sizeof results.mounts,
      call_mounts, take_mounts_results, numbers_mounts,
      { { 0, 0x9f3a3916u, 24 }, { 0, 0x46d6afd1u, 24 }, { -2, 0x8e5b0aa0u, 0 } },
      0x49091d40u },
    { "prepare_mounts", sizeof results.prepare_mounts,
      call_prepare_mounts, take_prepare_mounts_results, numbers_prepare_mounts,
      { { 0, 0x733496d2u, 32 }, { 0, 0xeb4e6421u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xf494643fu },
    { "step_carried", sizeof results.step_carried,
      call_step_carried, take_step_carried_results, numbers_step_carried,
      { { 0, 0x65e8dffau, 32 }, { 32, 0x519ac124u, 32 }, { -2, 0x596a7b76u, 21 } },
      0x524e8169u },
    { "step_driven_carried", sizeof results.step_driven_carried,
      call_step_driven_carried, take_step_driven_carried_results, numbers_step_driven_carried,
      { { 0, 0x2232cdadu, 32 }, { 32, 0x87afa0b6u, 32 }, { -2, 0x596a7b76u, 21 } },
      0x9ca8cb2bu },
    { "center_of_mass_velocity", sizeof results.center_of_mass_velocity,
      call_center_of_mass_velocity, take_center_of_mass_velocity_results, numbers_center_of_mass_velocity,
      { { 0, 0x2684d1adu, 3 }, { 0, 0x0ff29d2au, 3 }, { -2, 0x8e5b0aa0u, 0 } },
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

/* A random real in [-largest, largest) from 24 bits. */
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

/* The square of a quaternion of integers, divided by its length: a unit quaternion; to be refused: of length 2. */
static void draw_attitude(uint32_t *seed, sat4_real attitude[4], int refused)
{
    const uint32_t word = draw_word(seed);
    const int32_t a = 2 * (int32_t)(word >> 25) - 127;  /* odd, so that not all are 0 */
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

/* A step short enough for light flywheels with strong damping. */
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
    draw_reals(seed, in.carry.rounding, 21, 5.960464477539063e-8);
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

/* Calls one function, then hashes and compares its results. */
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

/* Tests the golden vectors of one function; returns 0 if all are right. */
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

/* Prints a hash of every function over a number of states. */
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

/* Runs all tests and prints one line per call of `print`; returns the number of functions that failed. */
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
