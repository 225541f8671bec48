/* auv6_selftest.c: does auv6.c give the right bits on this machine?
 * With -ffast-math or its parts it gives wrong results with status OK: this test fails.
 * mahovik 0.1.0; structure 192ea446, physics 002b2abc. Generated: change the stand file instead.
 *
 * Compile it with auv6.c as firmware is compiled (-std=c99 -ffp-contract=off; -fno-tree-vectorize as well by gcc
 * for x86-64 with FMA and for a Cortex-M55, or bits differ) and with
 * -DAUV6_SELFTEST_MAIN, and run it; on a board, without that macro, call auv6_selftest with a function that
 * prints a text, such as to a serial port.
 * Golden vectors: inputs and answers of the generator's interpreter as hexadecimal constants; each bit must agree.
 * Trials: the first of them with a few inputs changed: every status, wrong numbers, null pointers; known as well.
 * Sweep: states drawn by an integer generator; one hash per function of all its answers is printed, to be
 * compared between machines. The log of a board is judged by `mahovik judge-log STAND.toml --log LOG`. It reads:
 *
 *     wrong results: compiled with ...   only if that is so: first, and then functions FAIL
 *     mahovik selftest auv6 structure 192ea446 physics 002b2abc real double
 *     generator mahovik 0.1.0
 *     forward PASS cases 5 worst 0 ulp      one line per function; FAIL gives the number of wrong cases and
 *                                        what is wrong of them, such as "(status, numbers)"; with numbers worst is
 *                                        their largest distance, or "more than 1000000"
 *     sweep 100                          states
 *     forward 0123abcd                   one line per function: FNV-1a hash of its statuses and outputs
 *     failures 0                         functions that failed; the last line
 *
 * No allocation. It keeps inputs and results in static memory: one caller at a time. */
#include "../auv6.h"

#include <float.h>
#include <stddef.h>
#include <stdint.h>
#ifdef AUV6_SELFTEST_MAIN
#include <stdio.h>
#endif

#if AUV6_STRUCTURE != 0x192ea446u || AUV6_PHYSICS != 0x002b2abcu
#error "auv6.h and auv6_selftest.c are of different stands"
#endif

#ifndef AUV6_SELFTEST_SWEEP
#define AUV6_SELFTEST_SWEEP 100ul  /* states of the sweep that main runs */
#endif

int auv6_selftest(void (*print)(const char *text), unsigned long sweep);

typedef uint64_t real_bits;

enum { CASES = 3, FUNCTIONS = 24, SWEPT = 4 };

#define FARTHEST ((real_bits)1000000u)  /* ulp: a worse distance is not printed as a number */

/* ---- inputs and results ---- */

/* Arguments of the functions, apart from the constants of the stand. */
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
    auv6_step_carry carry;
    auv6_real mass_factor;  /* multiplies all masses and inertias of the parameters */
} inputs;

static inputs in;
static auv6_parameters parameters;
static const auv6_table *table = &auv6_default;
static auv6_inverse_options options;
static int omitted;  /* the argument that is null, from 1; 0: none; -1: all that may be null */
static auv6_mount_table mounting;

static union {
    struct { auv6_real V_dot[6]; } forward;
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
    struct { auv6_step_carry carry; auv6_state next; } step_carried;
    struct { auv6_step_carry carry; auv6_state next; } step_driven_carried;
    unsigned char bytes[1];
} results;

/* Numbers that no literal of C99 is. */
typedef union special { real_bits word; auv6_real real; } special;
static const special infinite = { 0x7ff0000000000000u };
static const special not_a_number = { 0x7ff8000000000000u };

enum { UNTOUCHED = 0x5a };  /* value of every byte of the results before a call */

/* ---- results: their hash, and their distance from the expected numbers ---- */

typedef struct tally {
    uint32_t hash;                /* FNV-1a of all bits so far, the lowest byte of a number first */
    const auv6_real *expected;  /* next expected numbers, `left` of them */
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

static real_bits bits_of(auv6_real value)
{
    union { auv6_real real; real_bits word; } both;
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
        take_reals(sum, value->I_[i], AUV6_N);
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
    take_reals(sum, value->center_of_mass_velocity, 3);
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
    take_reals(sum, &value->spin_root_inv, 1);
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

static void take_step_carry(tally *sum, const auv6_step_carry *value)
{
    take_reals(sum, value->rounding, 25);
}

/* ---- every function is called with the inputs, and its results are hashed and compared ---- */

static auv6_status call_forward(void)
{
    return auv6_forward((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.phi_ddot, (omitted == 4) ? NULL : results.forward.V_dot);
}

static void take_forward_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.forward.V_dot, 6);
}

static auv6_status call_matrices(void)
{
    return auv6_matrices((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : &results.matrices.out);
}

static void take_matrices_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_matrices_result(sum, &results.matrices.out);
}

static auv6_status call_momentum(void)
{
    return auv6_momentum((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : &results.momentum.out);
}

static void take_momentum_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_momentum_result(sum, &results.momentum.out);
}

static auv6_status call_torque(void)
{
    return auv6_torque((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL : results.torque.tau);
}

static void take_torque_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.torque.tau, AUV6_N);
}

static auv6_status call_coupled(void)
{
    return auv6_coupled((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL : results.coupled.V_dot,
        (omitted == 5) ? NULL : results.coupled.phi_ddot);
}

static void take_coupled_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.coupled.V_dot, 6);
    take_reals(sum, results.coupled.phi_ddot, AUV6_N);
}

static auv6_status call_step(void)
{
    return auv6_step((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.tau, (omitted < 0) ? NULL : in.locked, in.dt, in.order, (omitted == 4) ? NULL
        : &results.step.next);
}

static void take_step_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_state(sum, &results.step.next);
}

static auv6_status call_step_driven(void)
{
    return auv6_step_driven((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.phi_ddot, in.dt, in.order, (omitted == 4) ? NULL : &results.step_driven.next);
}

static void take_step_driven_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_state(sum, &results.step_driven.next);
}

static auv6_status call_wrap(void)
{
    return auv6_wrap(in.phi, (omitted == 1) ? NULL : &results.wrap.wrapped);
}

static void take_wrap_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.wrap.wrapped, 1);
}

static auv6_status call_phase_of_counts(void)
{
    return auv6_phase_of_counts(in.count, in.per_turn, in.zero, (omitted == 1) ? NULL
        : &results.phase_of_counts.phi);
}

static void take_phase_of_counts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.phase_of_counts.phi, 1);
}

static auv6_status call_speed_of_counts(void)
{
    return auv6_speed_of_counts(in.moved, in.per_turn, in.dt, (omitted == 1) ? NULL
        : &results.speed_of_counts.phi_dot);
}

static void take_speed_of_counts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.speed_of_counts.phi_dot, 1);
}

static auv6_status call_accumulate(void)
{
    results.accumulate.encoder = in.encoder;
    return auv6_accumulate((omitted == 1) ? NULL : &results.accumulate.encoder, in.counter, in.bits,
        in.per_turn);
}

static void take_accumulate_results(tally *sum, int refused)
{
    (void)refused;
    take_encoder(sum, &results.accumulate.encoder);
}

static auv6_status call_forward_jacobian(void)
{
    return auv6_forward_jacobian((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.phi_ddot, (omitted == 4) ? NULL : &results.forward_jacobian.out);
}

static void take_forward_jacobian_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_forward_jacobian_result(sum, &results.forward_jacobian.out);
}

static auv6_status call_coupled_jacobian(void)
{
    return auv6_coupled_jacobian((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL
        : &results.coupled_jacobian.out);
}

static void take_coupled_jacobian_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_coupled_jacobian_result(sum, &results.coupled_jacobian.out);
}

static auv6_status call_inverse(void)
{
    return auv6_inverse((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL : &results.inverse.out);
}

static void take_inverse_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_inverse_result(sum, &results.inverse.out);
}

static auv6_status call_inverse_fast(void)
{
    return auv6_inverse_fast((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.V_dot, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL
        : results.inverse_fast.phi_ddot);
}

static void take_inverse_fast_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.inverse_fast.phi_ddot, AUV6_N);
}

static auv6_status call_points(void)
{
    return auv6_points((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : results.points.out);
}

static void take_points_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    for (int i = 0; i < AUV6_SENSORS; ++i) {
        take_points_result(sum, &results.points.out[i]);
    }
}

static auv6_status call_quaternion(void)
{
    return auv6_quaternion((omitted == 1) ? NULL : in.angles, (omitted == 2) ? NULL
        : results.quaternion.attitude);
}

static void take_quaternion_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.quaternion.attitude, 4);
}

static auv6_status call_state_from_coordinates(void)
{
    results.state_from_coordinates.x = in.x;
    return auv6_state_from_coordinates((omitted == 1) ? NULL : in.position, (omitted == 2) ? NULL : in.angles,
        (omitted == 3) ? NULL : in.q_dot, (omitted == 4) ? NULL : in.q_ddot, (omitted == 5) ? NULL
        : &results.state_from_coordinates.x, (omitted == 6) ? NULL : results.state_from_coordinates.V_dot);
}

static void take_state_from_coordinates_results(tally *sum, int refused)
{
    take_state(sum, &results.state_from_coordinates.x);
    if (refused != 0) { return; }
    take_reals(sum, results.state_from_coordinates.V_dot, 6);
}

static auv6_status call_generalized(void)
{
    return auv6_generalized((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.angles, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL
        : &results.generalized.out);
}

static void take_generalized_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_generalized_result(sum, &results.generalized.out);
}

static auv6_status call_prepare(void)
{
    results.prepare.table = auv6_default;
    return auv6_prepare((omitted == 1) ? NULL : &parameters, (omitted == 2) ? NULL : &results.prepare.table);
}

static void take_prepare_results(tally *sum, int refused)
{
    (void)refused;
    take_table(sum, &results.prepare.table);
}

static auv6_status call_mounts(void)
{
    return auv6_mounts((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &mounting, (omitted == 3) ? NULL
        : &in.x, (omitted == 4) ? NULL : in.V_dot, (omitted == 5) ? NULL : in.phi_ddot, (omitted == 6) ? NULL
        : results.mounts.mount_wrench);
}

static void take_mounts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.mounts.mount_wrench, 36);
}

static auv6_status call_prepare_mounts(void)
{
    return auv6_prepare_mounts((omitted == 1) ? NULL : &parameters, (omitted == 2) ? NULL
        : &results.prepare_mounts.mounting);
}

static void take_prepare_mounts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_mount_table(sum, &results.prepare_mounts.mounting);
}

static auv6_status call_step_carried(void)
{
    results.step_carried.carry = in.carry;
    return auv6_step_carried((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.tau, (omitted < 0) ? NULL : in.locked, in.dt, in.order, (omitted == 4) ? NULL
        : &results.step_carried.carry, (omitted == 5) ? NULL : &results.step_carried.next);
}

static void take_step_carried_results(tally *sum, int refused)
{
    take_step_carry(sum, &results.step_carried.carry);
    if (refused != 0) { return; }
    take_state(sum, &results.step_carried.next);
}

static auv6_status call_step_driven_carried(void)
{
    results.step_driven_carried.carry = in.carry;
    return auv6_step_driven_carried((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
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
        .carry = {
            .rounding = { -0x1.58a2bp-25, 0x1.554cc8p-26, 0x1.55fcep-26, -0x1.9f3ap-31, 0x1.9b4488p-26,
                0x1.0a9aap-28, -0x1.9c2068p-26, -0x1.9ed4ep-28, -0x1.085ab8p-26, 0x1.968a6p-26,
                0x1.cdc694p-25, -0x1.0249c8p-25, -0x1.371e7p-26, -0x1.214c38p-25, 0x1.4171bp-27,
                0x1.82ebap-27, 0x1.0b38ap-26, -0x1.055d68p-25, -0x1.8f2aap-27, -0x1.763e6p-28, -0x1.df9aep-25,
                -0x1.f8caa4p-25, 0x1.3b88ccp-25, 0x1.8fd1ep-27, -0x1.0659ap-26 },
        },
        .mass_factor = 0x1.c9a77fp-1,
    },
    {   /* fast flywheels, large phases */
        .x = {
            .position = { -0x1.0c99cp-1, -0x1.5e586p+0, 0x1.d5b01p-1 },
            .attitude = { 0x1.40325e37170c4p-5, 0x1.cddb5927e983ap-1, -0x1.189f32ee1fb47p-2,
                -0x1.5315b2dfbba4bp-2 },
            .V = { 0x1.499108p+2, -0x1.859fdp+2, 0x1.fdeeap+2, 0x1.1fb6fp+2, -0x1.2794p-5, 0x1.33ded8p+2 },
            .phi = { -0x1.4256p+15, -0x1.923cb8p+22, -0x1.67826p+22, 0x1.512658p+21, -0x1.3b3c18p+21,
                0x1.8eec5p+21 },
            .phi_dot = { -0x1.bb3d38p+13, 0x1.a3f8a8p+13, 0x1.882d1p+11, 0x1.4d94ap+11, -0x1.c47ac4p+13,
                0x1.1746e8p+13 },
        },
        .phi_ddot = { 0x1.037d6p+7, 0x1.a1c0ecp+8, -0x1.cf6e3p+8, 0x1.56ea88p+8, 0x1.f688fp+7,
            -0x1.0f622p+8 },
        .V_dot = { 0x1.a26cfp+4, 0x1.df44a8p+5, 0x1.670cp+0, -0x1.23708p+1, 0x1.598328p+4, -0x1.466428p+4 },
        .tau = { -0x1.3db6a8p+0, -0x1.3d4554p+0, -0x1.07562p-1, 0x1.a063e4p+0, -0x1.bdbb3p+0, 0x1.d98bf4p+0 },
        .locked = { 0, 0, 0, 0, 1, 1 },
        .dt = 0x1p-14,
        .order = 2,
        .phi = 0x1.70ed48p+21,
        .count = 776494,
        .per_turn = 4052,
        .zero = -0x1.28b67p-1,
        .moved = -213,
        .encoder = {
            .counter = -10237,
            .place = 1974,
            .moved = 262,
        },
        .counter = 19962,
        .bits = 16,
        .angles = { 0x1.63ddcp-4, 0x1.e05b2p-4, -0x1.68bbep-2 },
        .position = { -0x1.cbd33cp+0, -0x1.c483b8p+0, -0x1.ed35p-5 },
        .q_dot = { -0x1.bdd86p+0, 0x1.f8f3ep-2, -0x1.ca174p-3, 0x1.bc5528p-1, 0x1.67f6p-4, 0x1.7f7ed8p-1 },
        .q_ddot = { 0x1.1db6ap+3, -0x1.046708p+3, 0x1.7c0718p+3, -0x1.8e30bp+3, 0x1.c57048p+2,
            -0x1.b7cac8p+2 },
        .carry = {
            .rounding = { -0x1.74596p-25, 0x1.a5f084p-25, 0x1.107154p-25, 0x1.9703bp-27, -0x1.0a47f8p-26,
                -0x1.3b6cap-27, -0x1.997158p-25, 0x1.caa508p-25, 0x1.64ac8p-29, 0x1.49a318p-26, 0x1.c85dp-28,
                0x1.c55c48p-26, 0x1.ebfa1p-25, -0x1.afa2dp-27, -0x1.3dbc3cp-25, 0x1.e6041p-25, 0x1.efbb3cp-25,
                -0x1.fcd4p-27, -0x1.05219cp-25, -0x1.1937p-30, -0x1.0b842cp-25, 0x1.7eee2p-27,
                -0x1.093c78p-25, -0x1.8ed23cp-25, -0x1.027accp-25 },
        },
        .mass_factor = 0x1.1313078p+0,
    },
    {   /* out of range */
        .x = {
            .position = { 0x1.f09e08p+39, -0x1.f2802p+40, -0x1.31426p+37 },
            .attitude = { -0x1.805ca6359016fp+0, 0x1.2c532da016609p-3, -0x1.a975d5f81fb37p-1,
                -0x1.04481679acfe6p+0 },
            .V = { 0x1.5360e8p-1, -0x1.bc3c4p+0, 0x1.4b5d2p+0, -0x1.e1ea1p-1, 0x1.43f77p-2, -0x1.7eaadp+0 },
            .phi = { 0x1.9d9098p+42, 0x1.2190ap+43, 0x1.881898p+43, 0x1.f82364p+43, -0x1.f67078p+42,
                0x1.ef22p+41 },
            .phi_dot = { 0x1.9d4d4p+3, -0x1.125cp+7, -0x1.02414p+4, 0x1.bf9368p+7, 0x1.82c238p+7,
                0x1.7c810cp+7 },
        },
        .phi_ddot = { -0x1.0c3e8p+8, -0x1.482048p+8, 0x1.504548p+8, -0x1.247d8cp+8, 0x1.c8244p+5,
            0x1.a2090cp+8 },
        .V_dot = { 0x1.e1a7c8p+2, -0x1.e5e79p+2, -0x1.db3bp+0, -0x1.378368p+3, -0x1.c1742cp+3,
            -0x1.e7c7ep+0 },
        .tau = { -0x1.4df71p-1, 0x1.1b7a98p+0, -0x1.67b038p-1, 0x1.ad1878p+0, -0x1.1e24f4p+0, 0x1.81a498p+0 },
        .locked = { 0, 0, 0, 1, 0, 1 },
        .dt = 0x0p+0,
        .order = 2,
        .phi = -0x1.92b278p+43,
        .count = -174072,
        .per_turn = 0,
        .zero = 0x1.29377p+37,
        .moved = -308,
        .encoder = {
            .counter = -1430,
            .place = 2707,
            .moved = -10,
        },
        .counter = -30267,
        .bits = 16,
        .angles = { -0x1.ec054p+35, -0x1.74a658p+39, -0x1.8b2564p+39 },
        .position = { 0x1.c553b4p+40, 0x1.ce86e8p+40, -0x1.2c24fp+39 },
        .q_dot = { 0x1.c63afp+0, 0x1.9ff9b8p+0, -0x1.12f4p-2, 0x1.69a1c8p-1, -0x1.62c19p-2, 0x1.852fp-1 },
        .q_ddot = { 0x1.8344dp+1, -0x1.7420b4p+3, 0x1.2adb4p+3, -0x1.e9f6ccp+3, 0x1.2b6874p+3,
            0x1.2b38a8p+2 },
        .carry = {
            .rounding = { 0x1.f96c5p-26, 0x1.0100d8p-25, -0x1.a83864p-25, -0x1.d00b7p-25, -0x1.f6d9a8p-26,
                0x1.41229cp-25, -0x1.6e7b7p-26, -0x1.8f755p-26, 0x1.f1e5fp-25, 0x1.661b5p-26, 0x1.cc741p-25,
                -0x1.782598p-25, 0x1.30eddp-26, -0x1.1eb5b4p-25, -0x1.40e19cp-25, -0x1.e0cfc8p-26,
                0x1.8f7858p-25, -0x1.f2c714p-25, -0x1.f53a1p-26, 0x1.3b55cp-29, 0x1.bb9c28p-25,
                0x1.ea3264p-25, -0x1.1e9248p-26, 0x1.8d7fc8p-26, 0x1.f0fd5p-27 },
        },
        .mass_factor = -0x1.144e058p+0,
    },
};

typedef struct answer {
    int status;
    uint32_t hash;  /* hash of the status and all outputs */
    int listed;     /* outputs whose numbers are given, at most 32 */
} answer;

static const auv6_real numbers_forward[] =
{
    0x1.5f9edd0a1ca3cp+0, 0x1.58170c8bb7f58p+2, -0x1.b3d23d2b0fea6p+2, -0x1.d3d0b775e4a0cp+0,
        0x1.85c390f37fcc3p+4, -0x1.bc2b3437591e6p+5,
    0x1.b5fc4c510eaa5p+14, -0x1.314f0bc31cbfp+14, -0x1.e1eb327b47a72p+14, -0x1.5604eea9de3dp+16,
        0x1.0fd82ba30e306p+17, 0x1.091bcf3ea428dp+18,
};

static const auv6_real numbers_matrices[] =
{
    0x1p+6, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.b458bc544e0ap-1, -0x1.4985c403dcb73p-2, 0x0p+0, 0x1.4p+6, 0x0p+0,
        0x1.b458bc544e0ap-1, 0x0p+0, 0x1.947975fb0e5a2p+1, 0x0p+0, 0x0p+0, 0x1.5p+6, 0x1.4985c403dcb73p-2,
        -0x1.a14642c7db26fp+1, 0x0p+0, 0x0p+0, 0x1.b458bc544e0ap-1, 0x1.4985c403dcb73p-2,
        0x1.eaf7e104f87abp-1, -0x1.a0723ddfe02e8p-5, 0x1.af4746ea13278p-4, -0x1.b458bc544e0ap-1, 0x0p+0,
        -0x1.a14642c7db26fp+1, -0x1.a0723ddfe02e8p-5, 0x1.3d096d40298a8p+2, 0x1.60f6a3485dcc5p-6,
        -0x1.4985c403dcb73p-2, 0x1.947975fb0e5a2p+1,
    0x1p+6, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.b533d6d88fc87p-1, -0x1.35e60d56f380dp-2, 0x0p+0, 0x1.4p+6, 0x0p+0,
        0x1.b533d6d88fc87p-1, 0x0p+0, 0x1.9330d67a4bffep+1, 0x0p+0, 0x0p+0, 0x1.5p+6, 0x1.35e60d56f380dp-2,
        -0x1.9ffda34718ccap+1, 0x0p+0, 0x0p+0, 0x1.b533d6d88fc87p-1, 0x1.35e60d56f380dp-2,
        0x1.e7ea585b164f8p-1, -0x1.d1786536b4427p-5, 0x1.a07ecbd40e942p-4, -0x1.b533d6d88fc87p-1, 0x0p+0,
        -0x1.9ffda34718ccap+1, -0x1.d1786536b4427p-5, 0x1.3cae79d7944e2p+2, 0x1.6447318b0851bp-6,
        -0x1.35e60d56f380dp-2, 0x1.9330d67a4bffep+1,
};

static const auv6_real numbers_momentum[] =
{
    0x1.8cad2267cf2b4p+6, 0x1.3b1c2e115e59cp+7, 0x1.2c9cfbd22d614p+6, 0x1.91ca08a1193bfp+1,
        -0x1.d5eab371089ep+0, 0x1.298252530fdb5p+3, 0x1.9233d76202a95p+5, 0x1.a68c09cf986ap+1,
        0x1.84ad8521601d6p+7, 0x1.1cf5e95cea38bp+8, 0x1.1e4b322189747p+7, -0x1.21c44c785779dp+6,
        0x1.1402db0dd4301p+9, 0x1.82a7c205f5b2ep-5, 0x1.a5c9f0a8c8989p-8, -0x1.174307e408fc3p-6,
        0x1.23d3c0748932fp-1, -0x1.8f0ca845944c8p-3, 0x1.4da776609921bp+1,
    0x1.af20335b71f62p+8, -0x1.9350f380984aep+7, 0x1.620d194587fb7p+9, 0x1.92cb7983d2192p+4,
        -0x1.6a903942411cbp+4, 0x1.1bce9e0aa64d6p+6, -0x1.1f950682d0fbp+6, 0x1.905668338fdf4p+4,
        -0x1.a8e597d593b38p+9, 0x1.18a682bcf2b72p+10, -0x1.f1cd3e2054548p+8, -0x1.75cecf74bf43p+7,
        0x1.266ce9bf5b278p+20, 0x1.81031ed1c9ba3p-5, 0x1.8cab9631db863p-8, -0x1.17cf41d2478a8p-6,
        -0x1.568d6742ecacp-1, -0x1.3071faccdb982p+1, -0x1.619d6deee94b2p+3,
};

static const auv6_real numbers_torque[] =
{
    0x1.073fdd37c5716p-6, -0x1.b82885c1eb1ddp+0, 0x1.0db3af3564accp+0, -0x1.d5df58e951dc8p-1,
        0x1.caae57bf5aafp-1, -0x1.25cc2a170a7f2p-2,
    0x1.8935712badb38p-1, 0x1.b228b3652928ep+0, -0x1.d68b83799c8a8p-1, 0x1.337683622b518p+0,
        0x1.cd1818ef28eaep-4, -0x1.bd09ed1b52f02p-1,
};

static const auv6_real numbers_coupled[] =
{
    0x1.5de80a6945e9p+0, 0x1.56ce9a64e5327p+2, -0x1.b38f7687cb0f2p+2, -0x1.6fbd8baef6f5ep+1,
        0x1.86d344bb01354p+4, -0x1.bffebf29f2d8ep+5, 0x0p+0, -0x1.0e4c2386cdaefp+8, 0x0p+0,
        -0x1.b20ae8929640ap+7, 0x1.fe8f53b1b2ec8p+7, 0x1.604f6dbba85acp+7,
    0x1.b65e61d8af0bcp+14, -0x1.3131ec8e0928p+14, -0x1.e23ec4d90abfap+14, -0x1.56ca684031c56p+16,
        0x1.0fe49a26d3cdbp+17, 0x1.093cb63f7cec3p+18, 0x1.3883caf5ff3dfp+16, -0x1.7c2d1ff2135d1p+16,
        -0x1.b21755577152dp+17, 0x1.0f8e6fd88a633p+17, 0x0p+0, 0x0p+0,
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
    -0x1.0c852d7e06074p-1, -0x1.5e4b1e70caf45p+0, 0x1.d55b34bcb36bcp-1, 0x1.4128edfac0df2p-5,
        0x1.cdd2d73c5d7dep-1, -0x1.190138be82cddp-2, -0x1.52ef38001df8ep-2, 0x1.d6035457c2b94p+2,
        -0x1.a21998ab39a1bp+2, 0x1.9254fb83db8a8p+2, 0x1.130abb24c79ccp+3, 0x1.36fe6c77c1d7bp+3,
        0x1.5df3b7c391c45p+4, 0x1.cff6d0568a1ecp+0, -0x1.296ba931f3b8p+1, -0x1.4e1355b1e7f6dp+1,
        -0x1.2b3a0f7e88938p-6, -0x1.13fbfe1929fa8p+1, -0x1.85b6fd6f200ep-2, -0x1.bb7bed74f182dp+13,
        0x1.a3de3e54f37fbp+13, 0x1.85fef0a349879p+11, 0x1.4dec20cc0fc7ep+11, -0x1.c47ac4p+13, 0x1.1746e8p+13,
};

static const auv6_real numbers_step_driven[] =
{
    -0x1.779a17411af43p-1, 0x1.80b85a8584cf1p+0, -0x1.10f682cf59088p-4, 0x1.23d5bb59c6e35p-1,
        -0x1.2f86b656c683fp-5, -0x1.fa5f04772dbd5p-2, -0x1.4f6e319849407p-1, 0x1.98d2f1a875bd7p+0,
        0x1.e63ce0214901ap+0, 0x1.d0f2c31341529p-1, 0x1.f3e494a70429ap+0, 0x1.46efa942d2542p-1,
        0x1.a916e7f849ed8p-1, -0x1.0bcb7abf9d9eep-3, 0x1.48e41a1d93f9fp+1, -0x1.256c5253707p+1,
        -0x1.9bcfb4ea38f3ep-1, -0x1.ebcda9574113ep+0, -0x1.3a2eb99cf9f9fp+0, -0x1.c61d220a4p+7,
        -0x1.3cc5160cp+4, -0x1.c4cf16e0ep+7, 0x1.d79355d84p+7, 0x1.35b56a86p+3, 0x1.29ab5bf58p+6,
    -0x1.0c852f0d9cbc2p-1, -0x1.5e4b1dc6d266bp+0, 0x1.d55b347d5967ap-1, 0x1.41287bb7bc014p-5,
        0x1.cdd2d8592c608p-1, -0x1.19013578f7fdcp-2, -0x1.52ef36574be4bp-2, 0x1.d5f5465f8ac76p+2,
        -0x1.a22e2469a2e8dp+2, 0x1.92724eee333cfp+2, 0x1.125dd5f57946ap+3, 0x1.372c06fe4f7d5p+3,
        0x1.5dd3877e0255fp+4, 0x1.cfed104627eecp+0, -0x1.2965b1f6703fbp+1, -0x1.4e05cc34f5fb4p+1,
        -0x1.2f759b68dabdp-6, -0x1.13fbfa2c181a8p+1, -0x1.85b71f5b640ep-2, -0x1.bb3d27c82ap+13,
        0x1.a3f8dc381d8p+13, 0x1.882c2848e8p+11, 0x1.4d954b7544p+11, -0x1.c47aa49771p+13, 0x1.1746c613bcp+13,
};

static const auv6_real numbers_wrap[] =
{
    -0x1.87dc0f9990e92p+1,
    -0x1.a9ea3d19013a9p-1,
};

static const auv6_real numbers_phase_of_counts[] =
{
    0x1.44ea670a66a78p+1,
    -0x1.279f66c7ce19p+1,
};

static const auv6_real numbers_speed_of_counts[] =
{
    -0x1.2df624deb7b68p+6,
    -0x1.5236779ab50a2p+12,
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
    -0x1.7042053d57c8dp+1, 0x1.7d8cf263e3674p+2, 0x1.b122f3ece6e69p-3, 0x1.e054d8a14c1c8p-2,
        -0x1.7a47dd93cc24cp+3, 0x1.2d358f8a5f3ebp+0, -0x1.28f2a22bf9edbp+2, -0x1.17e328cf7fbd9p+3,
        0x1.1aea40bf985cbp+2, 0x1.3ccad5243c31fp+3, -0x1.2eb523bb38c9cp-1, -0x1.61dc97dc82072p+2,
        0x1.3b02c1317b742p+0, -0x1.0c2c4a72c5228p+2, -0x1.a79c26760aa06p+3, 0x1.19f3e580ed365p-1,
        0x1.6cfb1fa8d8b8ep+2, 0x1.0d509823ba278p-6, -0x1.93a69a1ecd93fp-1, -0x1.885606c63f4bbp+4,
        0x1.e1fc75069e77fp+4, -0x1.d695f6c3c4f1dp+4, 0x1.7d27c1af5dc7ep+4, -0x1.39878244539c8p+3,
        0x1.0388cf856d177p+5, 0x1.3518b61d3f136p-4, 0x1.8fee228cd9a39p+3, 0x1.04ba543dd39d8p+5,
        -0x1.d794d2a04b0bdp+3, 0x1.eee41e73b274ep+1, 0x1.4505e97e50c4dp+4, -0x1.626e0b72370d1p+3,
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
    -0x1.7039fcbcc6f12p+1, 0x1.7d58f3e9625b6p+2, 0x1.ab429bf389b4p-3, 0x1.dd4e03e8b3248p-2,
        -0x1.7a4beef9655cdp+3, 0x1.2d37d776c5f11p+0, -0x1.28de9205dbf22p+2, -0x1.17ecd4e4b24c9p+3,
        0x1.1ace0c69ea9a9p+2, 0x1.3cc906a6ca02ap+3, -0x1.2f0178adb09c6p-1, -0x1.61d946473ce02p+2,
        0x1.3c0e634bc2879p+0, -0x1.0c086b513fa77p+2, -0x1.a82a2340e4fp+3, 0x1.194876bb14bddp-1,
        0x1.6cbf9c0c95736p+2, 0x1.368dfd8243a9ep-6, -0x1.ad9205a468c5ap-1, -0x1.89a77c25b26a9p+4,
        0x1.e4382e797f9c6p+4, -0x1.d78029a4bc5ccp+4, 0x1.7e382cc91cb4dp+4, -0x1.39e6f45ceadc1p+3,
        0x1.03bcfabf876d6p+5, 0x1.4b9fda36d911p-4, 0x1.8f1f678c678fp+3, 0x1.04e37f7079394p+5,
        -0x1.d80a5dc81038cp+3, 0x1.ef65d0c0c3519p+1, 0x1.4508a98c4a40ep+4, -0x1.62ae60ec126b1p+3,
};

static const auv6_real numbers_inverse[] =
{
    -0x1.11b401f18de42p+15, 0x1.1616efbe39a7ep+17, -0x1.c54d0c9bca623p+17, 0x1.64cf295bc7443p+15,
        -0x1.7d6696a6eb298p+13, 0x1.3d7e94c4a1a0cp+15, -0x1.1p-43, 0x1.4p-41, -0x1.3p-41, -0x1.cp-44, 0x1p-46,
        0x1p-41, 0x1.9603d60f2a47dp-4, 0x1.1328aa6250c37p-4, 0x1.86ab3fa840608p-5, 0x1.c1ed78bcc5ae4p-6,
        0x1.3e37c0a1f0911p-6, 0x1.095aa165a35bcp-7, 0x0p+0, 0x1.81fad808c4be9p+2, -0x1.54f84f5454175p-1,
        0x1.082ed3dfff25bp+2, -0x1.eeda581ae9fb4p-3, 0x1.322e20e512c1bp-1, 0x1.7f285556d02e4p-3,
    0x1.059ee00b194c3p+27, 0x1.4155b21b76acep+27, 0x1.2e7132d75234ep+29, -0x1.56062a5928591p+24,
        0x1.97505ec17544bp+28, -0x1.3e6f077305e5ep+26, -0x1.4p-31, -0x1.cp-30, 0x1.dp-30, 0x1.8p-32,
        -0x1.ep-31, 0x1.4p-30, 0x1.4b0e5aff949abp-4, 0x1.bed46ca974b2ap-5, 0x1.1a8deb5a67126p-5,
        0x1.cb86d2a996fbbp-6, 0x1.54724900797acp-6, 0x1.001eb82cb3732p-7, 0x0p+0, 0x1.771a74f20573fp+1,
        -0x1.e871d247fb6cp+2, 0x1.a2764f2743f7ap-1, 0x1.e6f57b80ad6fcp-4, 0x1.880be899e3786p-3,
        0x1.1d6da053f08f7p-2,
};

static const auv6_real numbers_inverse_fast[] =
{
    -0x1.11b401f18de42p+15, 0x1.1616efbe39a7ap+17, -0x1.c54d0c9bca61dp+17, 0x1.64cf295bc743ap+15,
        -0x1.7d6696a6eb278p+13, 0x1.3d7e94c4a1a01p+15,
    0x1.059ee00b194d8p+27, 0x1.4155b21b76acap+27, 0x1.2e7132d752359p+29, -0x1.56062a59284e9p+24,
        0x1.97505ec17545bp+28, -0x1.3e6f077305e64p+26,
};

static const auv6_real numbers_points[] =
{
    -0x1.b27ad6b934e39p-1, 0x1.26c966bf0b66ep+0, 0x1.9038013e3165cp-3, -0x1.75528ec2c5e43p-2,
        0x1.94d99c7ca2f6p-1, -0x1.f7944b4c299e6p-2, -0x1.156d140a36993p-1, 0x1.feafcd95c6c4ap-3,
        0x1.9af2d3ed806dap-1, 0x1.83bb78cad8f6bp-1, 0x1.1e4097315bbe5p-1, 0x1.59a49bb6ffe39p-2,
        0x1.df8f657b68c6ap+0, 0x1.1bd2623d2b9adp+1, 0x1.78d84603c7bfep-3, 0x1.10f0800304694p+1,
        0x1.d6519a25f13f2p-2, 0x1.95632b55aa5c4p-2, 0x1.74f8d040535b3p+4, 0x1.987b8f765f6bap+4,
        0x1.3fed0172c8cd2p+2, 0x1.e8338488dc2f1p+1, 0x1.06712dd3aaba4p+3, 0x1.85b6190c19053p+3,
    -0x1.c128ffe88e11cp-3, -0x1.a00a1373d3569p+0, 0x1.6777ac6018f1p-1, 0x1.c8c24dbe5785p-2,
        -0x1.210c1deee3de3p-1, -0x1.6394f367a65afp-1, -0x1.22e879538afa7p-1, -0x1.8e6bd30dfe5f5p-1,
        0x1.120f021b6653bp-2, -0x1.620fa5f228f66p-1, 0x1.19d2f3a6c5e2ep-2, -0x1.55f2b899c86a9p-1,
        0x1.8afd682ac994cp+2, -0x1.ea42222473688p+1, 0x1.cbfe33b84848ep+2, 0x1.55825c6c9714cp+2,
        -0x1.2be06a6a7d06ap-2, 0x1.ec4c65ac2c488p+1, 0x1.0fd8eac206b08p+5, 0x1.190d35b9339dfp+5,
        -0x1.4e4ff79a2655p+5, -0x1.0a40bc0da5839p+2, 0x1.4b04cdf5a39f2p+4, -0x1.50804f066fc29p+4,
};

static const auv6_real numbers_quaternion[] =
{
    0x1.cea2e1e8cac71p-1, 0x1.dd7fc12bd7767p-4, -0x1.caa7a5f2114cbp-4, -0x1.96430663f2734p-2,
    0x1.f6f71ff4c1fbap-1, -0x1.60c9057394c5ep-3, 0x1.099a4637e0cc9p-5, 0x1.0b382214e7ae9p-4,
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
    -0x1.cbd33cp+0, -0x1.c483b8p+0, -0x1.ed35p-5, 0x1.f6f71ff4c1fbap-1, -0x1.60c9057394c5ep-3,
        0x1.099a4637e0cc9p-5, 0x1.0b382214e7ae9p-4, -0x1.a56855d27a30bp+0, 0x1.8ddf0e73835d3p-1,
        -0x1.cdd55267c417cp-4, 0x1.b37c26c20dc02p-1, 0x1.8ea7f00e3086bp-1, 0x1.84fb1d8abb888p-2,
        -0x1.4256p+15, -0x1.923cb8p+22, -0x1.67826p+22, 0x1.512658p+21, -0x1.3b3c18p+21, 0x1.8eec5p+21,
        -0x1.bb3d38p+13, 0x1.a3f8a8p+13, 0x1.882d1p+11, 0x1.4d94ap+11, -0x1.c47ac4p+13, 0x1.1746e8p+13,
        0x1.cf6fada9d2f1fp+2, -0x1.889cb3a7f33ccp+3, 0x1.b21d1673b76d4p+2, -0x1.0810167509355p+3,
        -0x1.b88f4a65f313ep+3, 0x1.ccb4a10280d27p+0,
    0x1.f09e08p+39, -0x1.f2802p+40, -0x1.31426p+37, -0x1.805ca6359016fp+0, 0x1.2c532da016609p-3,
        -0x1.a975d5f81fb37p-1, -0x1.04481679acfe6p+0, 0x1.5360e8p-1, -0x1.bc3c4p+0, 0x1.4b5d2p+0,
        -0x1.e1ea1p-1, 0x1.43f77p-2, -0x1.7eaadp+0, 0x1.9d9098p+42, 0x1.2190ap+43, 0x1.881898p+43,
        0x1.f82364p+43, -0x1.f67078p+42, 0x1.ef22p+41, 0x1.9d4d4p+3, -0x1.125cp+7, -0x1.02414p+4,
        0x1.bf9368p+7, 0x1.82c238p+7, 0x1.7c810cp+7,
};

static const auv6_real numbers_generalized[] =
{
    0x1.51fae45d6853p-1, -0x1.7c75b6483a307p-1, 0x1.c1fb8ff509d0ap-4, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.61b9bc2c87c39p-1, 0x1.50e740352e2f6p-1, 0x1.32b6d68561744p-2, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.2df04c2ae2ca2p-2, -0x1.f2fd639430ecep-4, 0x1.e53e797b45421p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, -0x1.7c75b6483a306p-1, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.50e740352e2f6p-1,
        0x1.74d3de83abd05p-3, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.fa90b6b00d9e4p-1, 0x1.df41714e6bf8ep-4, -0x1.60fa3641888e4p-4, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.1d614eb1f29c7p-3, 0x1.dd41b0a4ef505p-1, -0x1.563a66c5e624dp-2, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.51b568e2d1f5dp-5, 0x1.5ee457e8a4b05p-2, 0x1.e089d87031364p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.df41714e6bf8ep-4, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.dd41b0a4ef505p-1,
        -0x1.61519edf18a5p-2, 0x0p+0, 0x0p+0, 0x0p+0,
};

static const auv6_real numbers_prepare[] =
{
    0x1.658adb38p+5, 0x1.6e976b2c1a1dfp-6, 0x1.0b50ed5516438p+1, 0x1.1792ffabe0c3ep-2, -0x1.7dda7c108eb55p-1,
        0x1.c37a458e4331ep-1, 0x1.228bd9e60c1cbp+2, 0x1.12f77250c6878p+2, -0x1.69e8c5d6614c9p-5,
        0x1.64f1581d6e139p-4, 0x1.3b221f40d2bd8p-6, 0x1.d58adb38p+5, 0x1.2ac56d9cp+6, 0x1.3ac56d9cp+6, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.1725fbe59c58p-6, 0x1.b6b41e8b91e52p-7, 0x1.a0676ef953db1p-7, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.ccccccccccccdp-1, 0x0p+0, 0x1.999999999999ap-1,
        0x0p+0,
    0x1.adcdbbb8p+5, 0x1.30f53650ad561p-6, 0x1.415796b22531bp+1, 0x1.5013e1a3722dcp-2, -0x1.cb0730b3828e8p-1,
        0x1.026d55fb5ecp+0, 0x1.4f09fe8a5968ep+2, 0x1.3ee5c543db86ap+2, -0x1.b30d96301aa56p-5,
        0x1.ad15320e296d4p-4, 0x1.7ad2cb795537p-6, 0x1.0ee6dddcp+6, 0x1.4ee6dddcp+6, 0x1.5ee6dddcp+6, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.e3d5f6f350e85p-7, 0x1.875fd8afb4aap-7, 0x1.75876b3dfbdf2p-7, 0x0p+0, 0x0p+0,
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
    -0x1.4d0b7547f3616p+5, 0x1.edeb199dd15d6p+20, -0x1.daea70c72cp+6, 0x1.8935712bae448p-1,
        -0x1.fa404d5a91384p+10, -0x1.5febb0eb96f7bp+12, 0x1.ac5b6febc7586p+9, 0x1.b4d7835859b16p+20,
        0x1.2130e73693e28p+19, 0x1.b228b365292bcp+0, 0x1.b20dba39af74ap+7, -0x1.b8e6e4007e52p+11,
        0x1.923eeaf3f7bc7p+6, 0x1.6dedfd4eab723p+16, 0x1.ae786872a3a54p+15, -0x1.d68b83799c7e1p-1,
        -0x1.de63d80dc360cp+4, -0x1.a22f3d57e816bp+6, -0x1.e4249188d4b7cp+6, -0x1.44f7c618321b3p+16,
        0x1.10bcd6ad06f07p+13, 0x1.337683622b46cp+0, 0x1.6e5b087a561eep+6, 0x1.0822306aa1efdp+8,
        0x1.1673e8b39e765p+11, -0x1.5de03b2bfa45p+19, 0x1.366d6410f01dcp+21, 0x1.cd1818ef24b17p-4,
        0x1.078b65381612bp+12, 0x1.26744374f1d8ep+10, 0x1.0e81d3c2f18b1p+9, -0x1.0dfdbda199985p+19,
};

static const auv6_real numbers_prepare_mounts[] =
{
    0x1.573d9f4p+0, -0x1.5f7a7e353f7cfp-10, 0x1.079bdea7ef9dbp-7, 0x1.079bdea7ef9dbp-8, 0x1.7ed193465e892p-9,
        0x1.03821ee3e6c4dp-9, 0x1.e1a4873acd5b7p-10, 0x1.b2e563800218fp-16, 0x1.0def7b8d3f185p-18,
        -0x1.fde0ccee5abc1p-17, -0x1.3333333333333p-2, 0x1.999999999999ap-4, 0x1.47ae147ae147bp-6,
        0x1.fd7583bc82ebap-1, -0x1.9791363065df3p-4, 0x0p+0, 0x1.9791363065df3p-4, 0x1.fd7583bc82ebap-1,
        0x0p+0, -0x0p+0, 0x0p+0, 0x1p+0, 0x1.573d9f4p+0, 0x0p+0, 0x1.21f841b8bac71p-7, 0x1.82a057a0f9097p-9,
        0x1.8aa9d9baccfp-9, 0x1.0a5580c48be09p-9, 0x1.f201ed47af6c2p-10, 0x1.34ed18c6a062ep-16, 0x0p+0,
        -0x1.585154c7828bp-17,
    0x1.9c9c8b4p+0, -0x1.a683a10624dd3p-10, 0x1.3ce2b8c49ba5ep-7, 0x1.3ce2b8c49ba5ep-8, 0x1.cc303820ee8d1p-9,
        0x1.37f4d0100e6b1p-9, 0x1.217e1cf6837f8p-9, 0x1.05653b57c4e3p-15, 0x1.447daac53b082p-18,
        -0x1.3276af81626b3p-16, -0x1.3333333333333p-2, 0x1.999999999999ap-4, 0x1.47ae147ae147bp-6,
        0x1.fd7583bc82ebap-1, -0x1.9791363065df3p-4, 0x0p+0, 0x1.9791363065df3p-4, 0x1.fd7583bc82ebap-1,
        0x0p+0, -0x0p+0, 0x0p+0, 0x1p+0, 0x1.9c9c8b4p+0, 0x0p+0, 0x1.5c92fe71de69bp-7, 0x1.d0c3fded288cfp-9,
        0x1.da6d5563850a9p-9, 0x1.402959b5230cep-9, 0x1.2b542994550c3p-9, 0x1.735c9e75a16cdp-16, 0x0p+0,
        -0x1.9de7f9af58f38p-17,
};

static const auv6_real numbers_step_carried[] =
{
    0x1.9ep-55, -0x1.eb6p-56, -0x1.5cp-58, 0x1.61b9cp-59, 0x1.7e52d6p-59, -0x1.ea2b7cp-57, -0x1.6c87dcp-57,
        -0x1.388p-55, 0x1.5cp-55, -0x1.ffp-55, 0x1.54p-58, 0x1.2p-55, -0x1.88p-55, -0x1p-56, 0x1.ccp-55,
        0x0p+0, -0x1.3p-55, 0x1.29p-54, 0x1.68p-55, 0x1p-47, 0x1.7fp-50, -0x1p-47, -0x1.e4p-52, -0x1.dbp-51,
        -0x1.78p-50, -0x1.779a1899fdc59p-1, 0x1.80b85adae0a98p+0, -0x1.10f67d79342cap-4, 0x1.23d5bb13a1123p-1,
        -0x1.2f86a96592e8ap-5, -0x1.fa5f03bf3316dp-2, -0x1.4f6e322676654p-1,
    0x1.c7p-56, 0x1.a48p-56, -0x1.18p-57, -0x1.0c6414p-59, -0x1.e80b9p-57, -0x1.bb3cdp-58, 0x1.a018c4p-56,
        0x0p+0, 0x1p-53, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1p-53, 0x1.659d9cceba3f9p-52, 0x1.4p-53, 0x0p+0,
        0x1p-52, 0x0p+0, 0x1.d58p-41, 0x1.8b4p-41, -0x1.b8p-43, -0x1.2bp-43, 0x1.c4p-41, 0x1.34p-41,
        -0x1.0c852ef25f674p-1, -0x1.5e4b1d9dd2b25p+0, 0x1.d55b35cd24bfcp-1, 0x1.4128f43d0e899p-5,
        0x1.cdd2d69230c7ap-1, -0x1.19013945b0654p-2, -0x1.52ef3b17d2b23p-2,
    0x1.f96c5p-26, 0x1.0100d8p-25, -0x1.a83864p-25, -0x1.d00b7p-25, -0x1.f6d9a8p-26, 0x1.41229cp-25,
        -0x1.6e7b7p-26, -0x1.8f755p-26, 0x1.f1e5fp-25, 0x1.661b5p-26, 0x1.cc741p-25, -0x1.782598p-25,
        0x1.30eddp-26, -0x1.1eb5b4p-25, -0x1.40e19cp-25, -0x1.e0cfc8p-26, 0x1.8f7858p-25, -0x1.f2c714p-25,
        -0x1.f53a1p-26, 0x1.3b55cp-29, 0x1.bb9c28p-25, 0x1.ea3264p-25, -0x1.1e9248p-26, 0x1.8d7fc8p-26,
        0x1.f0fd5p-27,
};

static const auv6_real numbers_step_driven_carried[] =
{
    0x1.9aa8p-55, 0x1.c63p-56, 0x1.1ep-58, -0x1.1750f8p-59, -0x1.ee3de3p-59, -0x1.d2fdecp-57, -0x1.1e0f11p-55,
        -0x1.4dep-54, -0x1.ap-54, 0x1.9fp-55, -0x1.e08p-55, 0x1.4p-60, 0x1.7p-55, -0x1p-56, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x1p-47, 0x0p+0, -0x1p-47, -0x1p-47, 0x0p+0, 0x0p+0, -0x1.779a1899bda43p-1,
        0x1.80b85adad8011p+0, -0x1.10f67d7765888p-4, 0x1.23d5bb162f2bfp-1, -0x1.2f86a93d14cacp-5,
        -0x1.fa5f03ca80ca9p-2, -0x1.4f6e32201dda9p-1,
    0x1.5cp-55, -0x1.3f8p-56, -0x1.2p-57, -0x1.59dfp-61, -0x1.276288p-56, -0x1.55ebap-57, 0x1.4b86bp-56,
        0x0p+0, 0x1p-53, 0x0p+0, 0x1p-50, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.cb3b399d747f2p-53, 0x0p+0, 0x0p+0,
        0x1p-52, 0x0p+0, -0x1.b8p-41, -0x1.6p-44, -0x1.ep-43, -0x1.ep-43, 0x1.c4p-41, 0x1.34p-41,
        -0x1.0c853081f61c2p-1, -0x1.5e4b1cf3da24bp+0, 0x1.d55b358dcabbap-1, 0x1.412881fa09b69p-5,
        0x1.cdd2d7aeffac8p-1, -0x1.190136002596ep-2, -0x1.52ef396f009fep-2,
    0x1.f96c5p-26, 0x1.0100d8p-25, -0x1.a83864p-25, -0x1.d00b7p-25, -0x1.f6d9a8p-26, 0x1.41229cp-25,
        -0x1.6e7b7p-26, -0x1.8f755p-26, 0x1.f1e5fp-25, 0x1.661b5p-26, 0x1.cc741p-25, -0x1.782598p-25,
        0x1.30eddp-26, -0x1.1eb5b4p-25, -0x1.40e19cp-25, -0x1.e0cfc8p-26, 0x1.8f7858p-25, -0x1.f2c714p-25,
        -0x1.f53a1p-26, 0x1.3b55cp-29, 0x1.bb9c28p-25, 0x1.ea3264p-25, -0x1.1e9248p-26, 0x1.8d7fc8p-26,
        0x1.f0fd5p-27,
};

typedef struct function {
    const char *name;
    int pointers;  /* arguments that must not be null */
    size_t size;  /* bytes of its results */
    size_t kept;  /* bytes of those that are also inputs: the first ones, the only ones that a refused call may have */
    auv6_status (*call)(void);
    void (*take)(tally *sum, int refused);
    const auv6_real *numbers;
    answer answers[CASES];
    uint32_t swept;  /* hash of the first SWEPT states of a sweep */
} function;

static const function functions[FUNCTIONS] =
{
    { "forward", 4, sizeof results.forward, 0u,
      call_forward, take_forward_results, numbers_forward,
      { { 0, 0xbb05d8b3u, 6 }, { 0, 0x6304d620u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0xcccf1295u },
    { "matrices", 3, sizeof results.matrices, 0u,
      call_matrices, take_matrices_results, numbers_matrices,
      { { 0, 0x2b307f44u, 32 }, { 0, 0x502f7e75u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x8ec560b9u },
    { "momentum", 3, sizeof results.momentum, 0u,
      call_momentum, take_momentum_results, numbers_momentum,
      { { 0, 0xbb29a2a1u, 19 }, { 0, 0xd2b84d59u, 19 }, { -2, 0x8e5b0aa0u, 0 } },
      0xcfa1f660u },
    { "torque", 5, sizeof results.torque, 0u,
      call_torque, take_torque_results, numbers_torque,
      { { 0, 0x4f9088aau, 6 }, { 0, 0xee48dffeu, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x5336ef07u },
    { "coupled", 5, sizeof results.coupled, 0u,
      call_coupled, take_coupled_results, numbers_coupled,
      { { 0, 0x4b6d4eb4u, 12 }, { 0, 0xf65cfce5u, 12 }, { -2, 0x8e5b0aa0u, 0 } },
      0x3a2acc09u },
    { "step", 4, sizeof results.step, 0u,
      call_step, take_step_results, numbers_step,
      { { 0, 0x57086a10u, 25 }, { 32, 0x474adf92u, 25 }, { -2, 0x8e5b0aa0u, 0 } },
      0xd874fa49u },
    { "step_driven", 4, sizeof results.step_driven, 0u,
      call_step_driven, take_step_driven_results, numbers_step_driven,
      { { 0, 0xc91a10bau, 25 }, { 32, 0x0500a715u, 25 }, { -2, 0x8e5b0aa0u, 0 } },
      0x4581a158u },
    { "wrap", 1, sizeof results.wrap, 0u,
      call_wrap, take_wrap_results, numbers_wrap,
      { { 0, 0x3f5b19b4u, 1 }, { 0, 0x47688450u, 1 }, { -2, 0x8e5b0aa0u, 0 } },
      0xb1cdec2bu },
    { "phase_of_counts", 1, sizeof results.phase_of_counts, 0u,
      call_phase_of_counts, take_phase_of_counts_results, numbers_phase_of_counts,
      { { 0, 0x9a384185u, 1 }, { 0, 0x9e337ecdu, 1 }, { -5, 0x2107376du, 0 } },
      0xd24e5021u },
    { "speed_of_counts", 1, sizeof results.speed_of_counts, 0u,
      call_speed_of_counts, take_speed_of_counts_results, numbers_speed_of_counts,
      { { 0, 0x208714f1u, 1 }, { 0, 0x222d4c64u, 1 }, { -5, 0x2107376du, 0 } },
      0xe29eca7du },
    { "accumulate", 1, sizeof results.accumulate, sizeof results.accumulate.encoder,
      call_accumulate, take_accumulate_results, numbers_accumulate,
      { { 0, 0xe9416429u, 0 }, { 0, 0x3cc1e79fu, 0 }, { -5, 0xce17516bu, 0 } },
      0x5ba9f541u },
    { "forward_jacobian", 4, sizeof results.forward_jacobian, 0u,
      call_forward_jacobian, take_forward_jacobian_results, numbers_forward_jacobian,
      { { 0, 0xd8c5f596u, 32 }, { 0, 0xf6a2d9bbu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xc181072bu },
    { "coupled_jacobian", 4, sizeof results.coupled_jacobian, 0u,
      call_coupled_jacobian, take_coupled_jacobian_results, numbers_coupled_jacobian,
      { { 0, 0xd2c3ccf9u, 32 }, { 0, 0x917905f8u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x60f052f9u },
    { "inverse", 5, sizeof results.inverse, 0u,
      call_inverse, take_inverse_results, numbers_inverse,
      { { 64, 0x4f67ca4eu, 25 }, { 64, 0x865f193du, 25 }, { -2, 0x8e5b0aa0u, 0 } },
      0x864cca61u },
    { "inverse_fast", 5, sizeof results.inverse_fast, 0u,
      call_inverse_fast, take_inverse_fast_results, numbers_inverse_fast,
      { { 64, 0x55d1b847u, 6 }, { 64, 0xce2615d5u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x0c4be254u },
    { "points", 4, sizeof results.points, 0u,
      call_points, take_points_results, numbers_points,
      { { 0, 0x5d0ae681u, 24 }, { 0, 0x948644ebu, 24 }, { -2, 0x8e5b0aa0u, 0 } },
      0x557d1547u },
    { "quaternion", 2, sizeof results.quaternion, 0u,
      call_quaternion, take_quaternion_results, numbers_quaternion,
      { { 0, 0xcdc117bdu, 4 }, { 0, 0xb40ee1d0u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0x527d25c3u },
    { "state_from_coordinates", 6, sizeof results.state_from_coordinates, sizeof results.state_from_coordinates.x,
      call_state_from_coordinates, take_state_from_coordinates_results, numbers_state_from_coordinates,
      { { 0, 0x65c14606u, 31 }, { 0, 0xaad962d4u, 31 }, { -2, 0x249e3b21u, 25 } },
      0xb7bd738bu },
    { "generalized", 5, sizeof results.generalized, 0u,
      call_generalized, take_generalized_results, numbers_generalized,
      { { 0, 0xc5951b52u, 32 }, { 0, 0xe277f0e1u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xe78d355eu },
    { "prepare", 2, sizeof results.prepare, sizeof results.prepare.table,
      call_prepare, take_prepare_results, numbers_prepare,
      { { 0, 0x8883abb5u, 32 }, { 0, 0xd6eeb54au, 32 }, { -2, 0xffc58281u, 32 } },
      0x3ca0e762u },
    { "mounts", 6, sizeof results.mounts, 0u,
      call_mounts, take_mounts_results, numbers_mounts,
      { { 0, 0xf350c984u, 32 }, { 0, 0x665b890bu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xbf892b71u },
    { "prepare_mounts", 2, sizeof results.prepare_mounts, 0u,
      call_prepare_mounts, take_prepare_mounts_results, numbers_prepare_mounts,
      { { 0, 0x7843cc07u, 32 }, { 0, 0xe90358b0u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xc3ea01d4u },
    { "step_carried", 5, sizeof results.step_carried, sizeof results.step_carried.carry,
      call_step_carried, take_step_carried_results, numbers_step_carried,
      { { 0, 0x5fa7e220u, 32 }, { 32, 0xb4834821u, 32 }, { -2, 0xd062397fu, 25 } },
      0x58d3ab4eu },
    { "step_driven_carried", 5, sizeof results.step_driven_carried, sizeof results.step_driven_carried.carry,
      call_step_driven_carried, take_step_driven_carried_results, numbers_step_driven_carried,
      { { 0, 0x011e052cu, 32 }, { 32, 0x7d200266u, 32 }, { -2, 0xd062397fu, 25 } },
      0x8e963a60u },
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

/* The square of a quaternion of integers, divided by its length: a unit quaternion; to be refused: of length 2. */
static void draw_attitude(uint32_t *seed, auv6_real attitude[4], int refused)
{
    const uint32_t word = draw_word(seed);
    const int32_t a = 2 * (int32_t)(word >> 25) - 127;  /* odd, so that not all are 0 */
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

/* A step short enough for light flywheels with strong damping. */
static auv6_real draw_step(const uint32_t *seed)
{
    (void)seed;
    return 0x1p-14;
}

static auv6_real draw_factor(uint32_t *seed, auv6_real largest)
{
    return 1.0 + draw_real(seed, largest);
}

static void draw_powers(uint32_t *seed, auv6_real *values, int count, auv6_real least)
{
    for (int i = 0; i < count; ++i) {
        values[i] = least;
        for (uint32_t k = draw_word(seed) >> 27; k > 0u; --k) {
            values[i] = values[i] * 2.0;
        }
    }
}

static auv6_real draw_share(uint32_t *seed)
{
    const auv6_real share = draw_real(seed, 1.0);
    return share < 0.0 ? -share : share;
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
    draw_reals(seed, in.carry.rounding, 25, 5.960464477539063e-8);
    in.mass_factor = draw_factor(seed, 0.125);
}

static void draw_options(uint32_t *seed)
{
    draw_powers(seed, options.weight, AUV6_N, 0.0009765625);
    draw_powers(seed, options.limit, AUV6_N, 1.0);
    draw_powers(seed, options.most, AUV6_N, 1.0);
    draw_powers(seed, options.motor_torque, AUV6_N, 1.52587890625e-5);
    draw_powers(seed, options.motor_speed, AUV6_N, 0.00390625);
    draw_powers(seed, options.motor_viscous, AUV6_N, 9.313225746154785e-10);
    draw_powers(seed, options.motor_coulomb, AUV6_N, 9.5367431640625e-7);
    draw_powers(seed, options.motor_coulomb_speed, AUV6_N, 0.00390625);
    options.near_singular = draw_share(seed);
    options.damping = draw_share(seed);
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

/* Calls one function, then hashes and compares its results. */
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
    f->take(sum, *status < 0 ? 1 : 0);
    for (size_t i = f->kept; *status < 0 && i < f->size; ++i) {
        sum->touched += bytes[i] != (unsigned char)UNTOUCHED ? 1 : 0;
    }
}

/* The inputs of a golden case. */
static void reset(int number)
{
    in = golden[number];
    table = &auv6_default;
    options = auv6_default_options;
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
        in.x.phi[5] = infinite.real;
        break;
    case 14:
        in.x.phi[0] = 0x1p+60;
        break;
    case 15:
        in.x.phi[5] = -0x1p+60;
        break;
    case 16:
        in.x.phi_dot[0] = not_a_number.real;
        break;
    case 17:
        in.x.phi_dot[5] = infinite.real;
        break;
    case 18:
        in.x.phi_dot[0] = 0x1p+60;
        break;
    case 19:
        in.x.phi_dot[5] = -0x1p+60;
        break;
    case 20:
        in.phi_ddot[0] = not_a_number.real;
        break;
    case 21:
        in.phi_ddot[5] = infinite.real;
        break;
    case 22:
        in.phi_ddot[0] = 0x1p+60;
        break;
    case 23:
        in.phi_ddot[5] = -0x1p+60;
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
        in.tau[5] = infinite.real;
        break;
    case 30:
        in.tau[0] = 0x1p+60;
        break;
    case 31:
        in.tau[5] = -0x1p+60;
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
        in.carry.rounding[24] = infinite.real;
        break;
    case 77:
        in.carry.rounding[0] = 0x1p+60;
        break;
    case 78:
        in.carry.rounding[24] = -0x1p+60;
        break;
    case 79:
        options.weight[0] = not_a_number.real;
        break;
    case 80:
        options.weight[5] = infinite.real;
        break;
    case 81:
        options.weight[0] = 0x1p+60;
        break;
    case 82:
        options.weight[5] = -0x1p+60;
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
        options.limit[5] = -0x1p+60;
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
        options.most[5] = -0x1p+60;
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
        options.motor_torque[5] = -0x1p+60;
        break;
    case 96:
        options.motor_torque[0] = -0x1p+0;
        break;
    case 97:
        options.motor_speed[0] = not_a_number.real;
        break;
    case 98:
        options.motor_speed[5] = -0x1p+60;
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
        options.motor_viscous[5] = -0x1p+60;
        break;
    case 103:
        options.motor_viscous[0] = -0x1p+0;
        break;
    case 104:
        options.motor_coulomb[0] = not_a_number.real;
        break;
    case 105:
        options.motor_coulomb[5] = -0x1p+60;
        break;
    case 106:
        options.motor_coulomb[0] = -0x1p+0;
        break;
    case 107:
        options.motor_coulomb_speed[0] = not_a_number.real;
        break;
    case 108:
        options.motor_coulomb_speed[5] = -0x1p+60;
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
        parameters.carrier.displaced_mass = not_a_number.real;
        break;
    case 142:
        parameters.carrier.displaced_mass = infinite.real;
        break;
    case 143:
        parameters.carrier.displaced_mass = 0x1p+60;
        break;
    case 144:
        parameters.carrier.displaced_mass = -0x1p+60;
        break;
    case 145:
        parameters.carrier.displaced_center[0] = not_a_number.real;
        break;
    case 146:
        parameters.carrier.displaced_center[2] = infinite.real;
        break;
    case 147:
        parameters.carrier.displaced_center[0] = 0x1p+60;
        break;
    case 148:
        parameters.carrier.displaced_center[2] = -0x1p+60;
        break;
    case 149:
        parameters.added_mass[0][0] = not_a_number.real;
        break;
    case 150:
        parameters.added_mass[5][5] = infinite.real;
        break;
    case 151:
        parameters.added_mass[0][0] = 0x1p+60;
        break;
    case 152:
        parameters.added_mass[5][5] = -0x1p+60;
        break;
    case 153:
        parameters.instrument[0].body.mass = not_a_number.real;
        break;
    case 154:
        parameters.instrument[0].body.mass = infinite.real;
        break;
    case 155:
        parameters.instrument[0].body.mass = 0x1p+60;
        break;
    case 156:
        parameters.instrument[0].body.mass = -0x1p+60;
        break;
    case 157:
        parameters.instrument[0].body.mass = -0x1p+0;
        break;
    case 158:
        parameters.instrument[0].body.center_of_mass[0] = not_a_number.real;
        break;
    case 159:
        parameters.instrument[0].body.center_of_mass[2] = infinite.real;
        break;
    case 160:
        parameters.instrument[0].body.center_of_mass[0] = 0x1p+60;
        break;
    case 161:
        parameters.instrument[0].body.center_of_mass[2] = -0x1p+60;
        break;
    case 162:
        parameters.instrument[0].body.inertia[0] = not_a_number.real;
        break;
    case 163:
        parameters.instrument[0].body.inertia[5] = infinite.real;
        break;
    case 164:
        parameters.instrument[0].body.inertia[0] = 0x1p+60;
        break;
    case 165:
        parameters.instrument[0].body.inertia[5] = -0x1p+60;
        break;
    case 166:
        parameters.instrument[0].body.inertia[0] = 0x1p+30;
        break;
    case 167:
        parameters.instrument[0].body.inertia[3] = 0x1p+30;
        break;
    case 168:
        parameters.instrument[0].body.inertia[0] = -0x1p+0;
        break;
    case 169:
        parameters.instrument[0].body.inertia[1] = -0x1p+0;
        break;
    case 170:
        parameters.instrument[0].body.inertia[2] = -0x1p+0;
        break;
    case 171:
        parameters.instrument[0].body.displaced_mass = not_a_number.real;
        break;
    case 172:
        parameters.instrument[0].body.displaced_mass = infinite.real;
        break;
    case 173:
        parameters.instrument[0].body.displaced_mass = 0x1p+60;
        break;
    case 174:
        parameters.instrument[0].body.displaced_mass = -0x1p+60;
        break;
    case 175:
        parameters.instrument[0].body.displaced_center[0] = not_a_number.real;
        break;
    case 176:
        parameters.instrument[0].body.displaced_center[2] = infinite.real;
        break;
    case 177:
        parameters.instrument[0].body.displaced_center[0] = 0x1p+60;
        break;
    case 178:
        parameters.instrument[0].body.displaced_center[2] = -0x1p+60;
        break;
    case 179:
        parameters.instrument[0].position[0] = not_a_number.real;
        break;
    case 180:
        parameters.instrument[0].position[2] = infinite.real;
        break;
    case 181:
        parameters.instrument[0].position[0] = 0x1p+60;
        break;
    case 182:
        parameters.instrument[0].position[2] = -0x1p+60;
        break;
    case 183:
        parameters.instrument[0].axis[0] = not_a_number.real;
        break;
    case 184:
        parameters.instrument[0].axis[2] = infinite.real;
        break;
    case 185:
        parameters.instrument[0].axis[0] = 0x1p+60;
        break;
    case 186:
        parameters.instrument[0].axis[2] = -0x1p+60;
        break;
    case 187:
        parameters.instrument[0].axis[0] = 0x0p+0;
        parameters.instrument[0].axis[1] = 0x0p+0;
        parameters.instrument[0].axis[2] = 0x0p+0;
        break;
    case 188:
        parameters.instrument[0].axis[0] = 0x1p+0;
        parameters.instrument[0].axis[1] = 0x0p+0;
        parameters.instrument[0].axis[2] = 0x0p+0;
        parameters.instrument[0].zero[0] = 0x1p+0;
        parameters.instrument[0].zero[1] = 0x0p+0;
        parameters.instrument[0].zero[2] = 0x0p+0;
        break;
    case 189:
        parameters.instrument[0].zero[0] = not_a_number.real;
        break;
    case 190:
        parameters.instrument[0].zero[2] = infinite.real;
        break;
    case 191:
        parameters.instrument[0].zero[0] = 0x1p+60;
        break;
    case 192:
        parameters.instrument[0].zero[2] = -0x1p+60;
        break;
    case 193:
        parameters.instrument[0].zero[0] = 0x0p+0;
        parameters.instrument[0].zero[1] = 0x0p+0;
        parameters.instrument[0].zero[2] = 0x0p+0;
        break;
    case 194:
        parameters.instrument[0].zero[0] = 0x1p+0;
        parameters.instrument[0].zero[1] = 0x0p+0;
        parameters.instrument[0].zero[2] = 0x0p+0;
        parameters.instrument[0].axis[0] = 0x1p+0;
        parameters.instrument[0].axis[1] = 0x0p+0;
        parameters.instrument[0].axis[2] = 0x0p+0;
        break;
    case 195:
        parameters.flywheel[0].body.mass = not_a_number.real;
        break;
    case 196:
        parameters.flywheel[0].body.mass = infinite.real;
        break;
    case 197:
        parameters.flywheel[0].body.mass = 0x1p+60;
        break;
    case 198:
        parameters.flywheel[0].body.mass = -0x1p+60;
        break;
    case 199:
        parameters.flywheel[0].body.mass = -0x1p+0;
        break;
    case 200:
        parameters.flywheel[0].body.center_of_mass[0] = not_a_number.real;
        break;
    case 201:
        parameters.flywheel[0].body.center_of_mass[2] = infinite.real;
        break;
    case 202:
        parameters.flywheel[0].body.center_of_mass[0] = 0x1p+60;
        break;
    case 203:
        parameters.flywheel[0].body.center_of_mass[2] = -0x1p+60;
        break;
    case 204:
        parameters.flywheel[0].body.inertia[0] = not_a_number.real;
        break;
    case 205:
        parameters.flywheel[0].body.inertia[5] = infinite.real;
        break;
    case 206:
        parameters.flywheel[0].body.inertia[0] = 0x1p+60;
        break;
    case 207:
        parameters.flywheel[0].body.inertia[5] = -0x1p+60;
        break;
    case 208:
        parameters.flywheel[0].body.inertia[0] = 0x1p+30;
        break;
    case 209:
        parameters.flywheel[0].body.inertia[3] = 0x1p+30;
        break;
    case 210:
        parameters.flywheel[0].body.inertia[0] = -0x1p+0;
        break;
    case 211:
        parameters.flywheel[0].body.inertia[1] = -0x1p+0;
        break;
    case 212:
        parameters.flywheel[0].body.inertia[2] = -0x1p+0;
        break;
    case 213:
        parameters.flywheel[0].position[0] = not_a_number.real;
        break;
    case 214:
        parameters.flywheel[0].position[2] = infinite.real;
        break;
    case 215:
        parameters.flywheel[0].position[0] = 0x1p+60;
        break;
    case 216:
        parameters.flywheel[0].position[2] = -0x1p+60;
        break;
    case 217:
        parameters.flywheel[0].axis[0] = not_a_number.real;
        break;
    case 218:
        parameters.flywheel[0].axis[2] = infinite.real;
        break;
    case 219:
        parameters.flywheel[0].axis[0] = 0x1p+60;
        break;
    case 220:
        parameters.flywheel[0].axis[2] = -0x1p+60;
        break;
    case 221:
        parameters.flywheel[0].axis[0] = 0x0p+0;
        parameters.flywheel[0].axis[1] = 0x0p+0;
        parameters.flywheel[0].axis[2] = 0x0p+0;
        break;
    case 222:
        parameters.flywheel[0].axis[0] = 0x1p+0;
        parameters.flywheel[0].axis[1] = 0x0p+0;
        parameters.flywheel[0].axis[2] = 0x0p+0;
        parameters.flywheel[0].zero[0] = 0x1p+0;
        parameters.flywheel[0].zero[1] = 0x0p+0;
        parameters.flywheel[0].zero[2] = 0x0p+0;
        break;
    case 223:
        parameters.flywheel[0].zero[0] = not_a_number.real;
        break;
    case 224:
        parameters.flywheel[0].zero[2] = infinite.real;
        break;
    case 225:
        parameters.flywheel[0].zero[0] = 0x1p+60;
        break;
    case 226:
        parameters.flywheel[0].zero[2] = -0x1p+60;
        break;
    case 227:
        parameters.flywheel[0].zero[0] = 0x0p+0;
        parameters.flywheel[0].zero[1] = 0x0p+0;
        parameters.flywheel[0].zero[2] = 0x0p+0;
        break;
    case 228:
        parameters.flywheel[0].zero[0] = 0x1p+0;
        parameters.flywheel[0].zero[1] = 0x0p+0;
        parameters.flywheel[0].zero[2] = 0x0p+0;
        parameters.flywheel[0].axis[0] = 0x1p+0;
        parameters.flywheel[0].axis[1] = 0x0p+0;
        parameters.flywheel[0].axis[2] = 0x0p+0;
        break;
    case 229:
        in.dt = 0x1p-3;
        in.order = 2;
        break;
    case 230:
        in.dt = 0x1p-3;
        in.order = 4;
        break;
    case 231:
        in.dt = 0x1p+3;
        in.order = 2;
        break;
    case 232:
        in.dt = 0x1p+3;
        in.order = 4;
        break;
    case 233:
        in.phi = 0x1.8p+1;
        break;
    case 234:
        in.phi = -0x1.8p+1;
        break;
    case 235:
        in.phi = 0x1.921fb54442d18p+1;
        break;
    case 236:
        in.phi = -0x1.921fb54442d18p+1;
        break;
    case 237:
        in.phi = 0x1.cp+1;
        break;
    case 238:
        in.phi = -0x1.cp+1;
        break;
    case 239:
        in.phi = 0x1.2d97c7f3321d2p+3;
        break;
    case 240:
        in.phi = -0x1.2d97c7f3321d2p+3;
        break;
    case 241:
        in.phi = 0x1.f4p+9;
        break;
    case 242:
        in.phi = -0x1.f4p+9;
        break;
    case 243:
        in.bits = 0;
        in.encoder.counter = 0;
        in.counter = 4090;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 244:
        in.bits = 0;
        in.encoder.counter = 0;
        in.counter = 4090;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 245:
        in.bits = 0;
        in.encoder.counter = 4090;
        in.counter = 0;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 246:
        in.bits = 0;
        in.encoder.counter = 4090;
        in.counter = 0;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 247:
        in.bits = 0;
        in.encoder.counter = 100;
        in.counter = 200;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 248:
        in.bits = 0;
        in.encoder.counter = 100;
        in.counter = 200;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 249:
        in.bits = 0;
        in.encoder.counter = -1;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 250:
        in.bits = 0;
        in.encoder.counter = -1;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 251:
        in.bits = 0;
        in.encoder.counter = 4096;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 252:
        in.bits = 0;
        in.encoder.counter = 4096;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 253:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = -1;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 254:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = -1;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 255:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = 4096;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 256:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = 4096;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 257:
        in.bits = 16;
        in.encoder.counter = 32767;
        in.counter = -32768;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 258:
        in.bits = 16;
        in.encoder.counter = 32767;
        in.counter = -32768;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 259:
        in.bits = 16;
        in.encoder.counter = -32768;
        in.counter = 32767;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 260:
        in.bits = 16;
        in.encoder.counter = -32768;
        in.counter = 32767;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 261:
        in.bits = 16;
        in.encoder.counter = 0;
        in.counter = 30000;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 262:
        in.bits = 16;
        in.encoder.counter = 0;
        in.counter = 30000;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 263:
        in.bits = 32;
        in.encoder.counter = 2147483647;
        in.counter = -2147483647;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 264:
        in.bits = 32;
        in.encoder.counter = 2147483647;
        in.counter = -2147483647;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 265:
        in.bits = 32;
        in.encoder.counter = -2147483647;
        in.counter = 2147483647;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 266:
        in.bits = 32;
        in.encoder.counter = -2147483647;
        in.counter = 2147483647;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 267:
        options.near_singular = 0x1p+0;
        break;
    case 268:
        options.near_singular = 0x1p+0;
        options.damping = 0x1p-1;
        break;
    case 269:
        for (int s = 0; s < AUV6_N; ++s) { options.limit[s] = 0x1.53f9c974d7c9ap+17; }
        break;
    case 270:
        for (int s = 0; s < AUV6_N; ++s) { options.limit[s] = 0x1.c54d0c9bca623p+15; }
        break;
    case 271:
        for (int s = 0; s < AUV6_N; ++s) { options.limit[s] = 0x1.c54d0c9bca623p+7; }
        break;
    case 272:
        for (int s = 0; s < AUV6_N; ++s) { options.weight[s] = 0x1p+2; }
        break;
    case 273:
        for (int s = 0; s < AUV6_N; ++s) { options.most[s] = 0x1p-10; }
        break;
    case 274:
        for (int s = 0; s < AUV6_N; ++s) { options.motor_torque[s] = 0x1p-10; }
        break;
    case 275:
        for (int s = 0; s < AUV6_N; ++s) { options.motor_speed[s] = 0x1p-10; }
        break;
    case 276:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < AUV6_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.V_dot[0] = 0x1p-12;
        in.V_dot[1] = -0x1p-12;
        in.V_dot[2] = 0x1p-12;
        in.V_dot[3] = -0x1p-12;
        in.V_dot[4] = 0x1p-12;
        in.V_dot[5] = -0x1p-12;
        break;
    case 277:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < AUV6_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.V_dot[0] = 0x1p-6;
        in.V_dot[1] = -0x1p-6;
        in.V_dot[2] = 0x1p-6;
        in.V_dot[3] = -0x1p-6;
        in.V_dot[4] = 0x1p-6;
        in.V_dot[5] = -0x1p-6;
        break;
    case 278:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < AUV6_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.V_dot[0] = 0x1p+0;
        in.V_dot[1] = -0x1p+0;
        in.V_dot[2] = 0x1p+0;
        in.V_dot[3] = -0x1p+0;
        in.V_dot[4] = 0x1p+0;
        in.V_dot[5] = -0x1p+0;
        break;
    case 279:
        for (int s = 0; s < AUV6_N; ++s) { options.motor_viscous[s] = 0x1p-1; }
        for (int s = 0; s < AUV6_N; ++s) { options.motor_coulomb[s] = 0x1p-1; }
        for (int s = 0; s < AUV6_N; ++s) { options.motor_coulomb_speed[s] = 0x1p-1; }
        break;
    case 280:
        for (int s = 0; s < AUV6_N; ++s) { parameters.flywheel[s].axis[0] = 0x1p+0; }
        for (int s = 0; s < AUV6_N; ++s) { parameters.flywheel[s].axis[1] = 0x0p+0; }
        for (int s = 0; s < AUV6_N; ++s) { parameters.flywheel[s].axis[2] = 0x0p+0; }
        for (int s = 0; s < AUV6_N; ++s) { parameters.flywheel[s].zero[0] = 0x0p+0; }
        for (int s = 0; s < AUV6_N; ++s) { parameters.flywheel[s].zero[1] = 0x1p+0; }
        for (int s = 0; s < AUV6_N; ++s) { parameters.flywheel[s].body.center_of_mass[1] = 0x0p+0; }
        for (int s = 0; s < AUV6_N; ++s) { parameters.flywheel[s].body.center_of_mass[2] = 0x0p+0; }
        for (int s = 0; s < AUV6_N; ++s) { parameters.flywheel[s].body.inertia[3] = 0x0p+0; }
        for (int s = 0; s < AUV6_N; ++s) { parameters.flywheel[s].body.inertia[4] = 0x0p+0; }
        break;
    case 281:
        for (int s = 0; s < AUV6_N; ++s) { options.limit[s] = 0x1.53f9c974d7c96p+17; }
        break;
    case 282:
        for (int s = 0; s < AUV6_N; ++s) { options.limit[s] = 0x1.c54d0c9bca61dp+15; }
        break;
    case 283:
        for (int s = 0; s < AUV6_N; ++s) { options.limit[s] = 0x1.c54d0c9bca61dp+7; }
        break;
    case 284:
        in.angles[1] = 0x0p+0;
        break;
    case 285:
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
    { 0, -1, 0, 0x00000000u, { 0xd4f87fu } },
    { 1, -1, 0, 0x00000000u, { 0xd4f87fu } },
    { 2, -2, 0, 0x00000000u, { 0xd4f87fu } },
    { 3, -2, 0, 0x00000000u, { 0xd4f87fu } },
    { 4, -1, 0, 0x00000000u, { 0xd0f87fu } },
    { 5, -1, 0, 0x00000000u, { 0xd0f87fu } },
    { 6, -2, 0, 0x00000000u, { 0xd0f87fu } },
    { 7, -2, 0, 0x00000000u, { 0xd0f87fu } },
    { 8, -1, 0, 0x00000000u, { 0xd4f87fu } },
    { 9, -1, 0, 0x00000000u, { 0xd4f87fu } },
    { 10, -2, 0, 0x00000000u, { 0xd4f87fu } },
    { 11, -2, 0, 0x00000000u, { 0xd4f87fu } },
    { 12, -1, 0, 0x00000000u, { 0xd4f87fu } },
    { 13, -1, 0, 0x00000000u, { 0xd4f87fu } },
    { 14, -2, 0, 0x00000000u, { 0xd4f87fu } },
    { 15, -2, 0, 0x00000000u, { 0xd4f87fu } },
    { 16, -1, 0, 0x00000000u, { 0xd4f87fu } },
    { 17, -1, 0, 0x00000000u, { 0xd4f87fu } },
    { 18, -2, 0, 0x00000000u, { 0xd4f87fu } },
    { 19, -2, 0, 0x00000000u, { 0xd4f87fu } },
    { 20, -1, 0, 0x00000000u, { 0x940849u } },
    { 21, -1, 0, 0x00000000u, { 0x940849u } },
    { 22, -2, 0, 0x00000000u, { 0x940849u } },
    { 23, -2, 0, 0x00000000u, { 0x940849u } },
    { 24, -1, 0, 0x00000000u, { 0x10e008u } },
    { 25, -1, 0, 0x00000000u, { 0x10e008u } },
    { 26, -2, 0, 0x00000000u, { 0x10e008u } },
    { 27, -2, 0, 0x00000000u, { 0x10e008u } },
    { 28, -1, 0, 0x00000000u, { 0x401030u } },
    { 29, -1, 0, 0x00000000u, { 0x401030u } },
    { 30, -2, 0, 0x00000000u, { 0x401030u } },
    { 31, -2, 0, 0x00000000u, { 0x401030u } },
    { 32, -1, 0, 0x00000000u, { 0xc00260u } },
    { 33, -1, 0, 0x00000000u, { 0xc00260u } },
    { 34, -2, 0, 0x00000000u, { 0xc00260u } },
    { 35, -2, 0, 0x00000000u, { 0xc00260u } },
    { 36, -5, 0, 0x00000000u, { 0xc00260u } },
    { 37, -5, 0, 0x00000000u, { 0xc00260u } },
    { 38, -5, 0, 0x00000000u, { 0xc00060u } },
    { 39, -5, 0, 0x00000000u, { 0xc00060u } },
    { 40, -5, 0, 0x00000000u, { 0xc00060u } },
    { 41, -5, 0, 0x00000000u, { 0xc00060u } },
    { 42, -5, 0, 0x00000000u, { 0xc00060u } },
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
    { 59, -1, 0, 0x00000000u, { 0x70000u } },
    { 60, -1, 0, 0x00000000u, { 0x70000u } },
    { 61, -2, 0, 0x00000000u, { 0x70000u } },
    { 62, -2, 0, 0x00000000u, { 0x70000u } },
    { 63, -1, 0, 0x00000000u, { 0x20000u } },
    { 64, -1, 0, 0x00000000u, { 0x20000u } },
    { 65, -2, 0, 0x00000000u, { 0x20000u } },
    { 66, -2, 0, 0x00000000u, { 0x20000u } },
    { 67, -1, 0, 0x00000000u, { 0x20000u } },
    { 68, -1, 0, 0x00000000u, { 0x20000u } },
    { 69, -2, 0, 0x00000000u, { 0x20000u } },
    { 70, -2, 0, 0x00000000u, { 0x20000u } },
    { 71, -1, 0, 0x00000000u, { 0x20000u } },
    { 72, -1, 0, 0x00000000u, { 0x20000u } },
    { 73, -2, 0, 0x00000000u, { 0x20000u } },
    { 74, -2, 0, 0x00000000u, { 0x20000u } },
    { 75, -1, 0, 0x00000000u, { 0xc00000u } },
    { 76, -1, 0, 0x00000000u, { 0xc00000u } },
    { 77, -2, 0, 0x00000000u, { 0xc00000u } },
    { 78, -2, 0, 0x00000000u, { 0xc00000u } },
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
    { 123, -1, 0, 0x00000000u, { 0x280000u } },
    { 124, -1, 0, 0x00000000u, { 0x280000u } },
    { 125, -2, 0, 0x00000000u, { 0x280000u } },
    { 126, -2, 0, 0x00000000u, { 0x280000u } },
    { 127, -2, 0, 0x00000000u, { 0x280000u } },
    { 128, -1, 0, 0x00000000u, { 0x280000u } },
    { 129, -1, 0, 0x00000000u, { 0x280000u } },
    { 130, -2, 0, 0x00000000u, { 0x280000u } },
    { 131, -2, 0, 0x00000000u, { 0x280000u } },
    { 132, -1, 0, 0x00000000u, { 0x280000u } },
    { 133, -1, 0, 0x00000000u, { 0x280000u } },
    { 134, -2, 0, 0x00000000u, { 0x280000u } },
    { 135, -2, 0, 0x00000000u, { 0x280000u } },
    { 136, -3, 0, 0x00000000u, { 0x280000u } },
    { 137, -3, 0, 0x00000000u, { 0x280000u } },
    { 138, -3, 0, 0x00000000u, { 0x280000u } },
    { 139, -3, 0, 0x00000000u, { 0x280000u } },
    { 140, -3, 0, 0x00000000u, { 0x280000u } },
    { 141, -1, 0, 0x00000000u, { 0x280000u } },
    { 142, -1, 0, 0x00000000u, { 0x280000u } },
    { 143, -2, 0, 0x00000000u, { 0x280000u } },
    { 144, -2, 0, 0x00000000u, { 0x280000u } },
    { 145, -1, 0, 0x00000000u, { 0x280000u } },
    { 146, -1, 0, 0x00000000u, { 0x280000u } },
    { 147, -2, 0, 0x00000000u, { 0x280000u } },
    { 148, -2, 0, 0x00000000u, { 0x280000u } },
    { 149, -1, 0, 0x00000000u, { 0x280000u } },
    { 150, -1, 0, 0x00000000u, { 0x280000u } },
    { 151, -2, 0, 0x00000000u, { 0x280000u } },
    { 152, -2, 0, 0x00000000u, { 0x280000u } },
    { 153, -1, 0, 0x00000000u, { 0x280000u } },
    { 154, -1, 0, 0x00000000u, { 0x280000u } },
    { 155, -2, 0, 0x00000000u, { 0x280000u } },
    { 156, -2, 0, 0x00000000u, { 0x280000u } },
    { 157, -2, 0, 0x00000000u, { 0x280000u } },
    { 158, -1, 0, 0x00000000u, { 0x280000u } },
    { 159, -1, 0, 0x00000000u, { 0x280000u } },
    { 160, -2, 0, 0x00000000u, { 0x280000u } },
    { 161, -2, 0, 0x00000000u, { 0x280000u } },
    { 162, -1, 0, 0x00000000u, { 0x280000u } },
    { 163, -1, 0, 0x00000000u, { 0x280000u } },
    { 164, -2, 0, 0x00000000u, { 0x280000u } },
    { 165, -2, 0, 0x00000000u, { 0x280000u } },
    { 166, -3, 0, 0x00000000u, { 0x280000u } },
    { 167, -3, 0, 0x00000000u, { 0x280000u } },
    { 168, -3, 0, 0x00000000u, { 0x280000u } },
    { 169, -3, 0, 0x00000000u, { 0x280000u } },
    { 170, -3, 0, 0x00000000u, { 0x280000u } },
    { 171, -1, 0, 0x00000000u, { 0x280000u } },
    { 172, -1, 0, 0x00000000u, { 0x280000u } },
    { 173, -2, 0, 0x00000000u, { 0x280000u } },
    { 174, -2, 0, 0x00000000u, { 0x280000u } },
    { 175, -1, 0, 0x00000000u, { 0x280000u } },
    { 176, -1, 0, 0x00000000u, { 0x280000u } },
    { 177, -2, 0, 0x00000000u, { 0x280000u } },
    { 178, -2, 0, 0x00000000u, { 0x280000u } },
    { 179, -1, 0, 0x00000000u, { 0x280000u } },
    { 180, -1, 0, 0x00000000u, { 0x280000u } },
    { 181, -2, 0, 0x00000000u, { 0x280000u } },
    { 182, -2, 0, 0x00000000u, { 0x280000u } },
    { 183, -1, 0, 0x00000000u, { 0x280000u } },
    { 184, -1, 0, 0x00000000u, { 0x280000u } },
    { 185, -2, 0, 0x00000000u, { 0x280000u } },
    { 186, -2, 0, 0x00000000u, { 0x280000u } },
    { 187, -2, 0, 0x00000000u, { 0x280000u } },
    { 188, -2, 0, 0x00000000u, { 0x280000u } },
    { 189, -1, 0, 0x00000000u, { 0x280000u } },
    { 190, -1, 0, 0x00000000u, { 0x280000u } },
    { 191, -2, 0, 0x00000000u, { 0x280000u } },
    { 192, -2, 0, 0x00000000u, { 0x280000u } },
    { 193, -2, 0, 0x00000000u, { 0x280000u } },
    { 194, -2, 0, 0x00000000u, { 0x280000u } },
    { 195, -1, 0, 0x00000000u, { 0x280000u } },
    { 196, -1, 0, 0x00000000u, { 0x280000u } },
    { 197, -2, 0, 0x00000000u, { 0x280000u } },
    { 198, -2, 0, 0x00000000u, { 0x280000u } },
    { 199, -2, 0, 0x00000000u, { 0x280000u } },
    { 200, -1, 0, 0x00000000u, { 0x280000u } },
    { 201, -1, 0, 0x00000000u, { 0x280000u } },
    { 202, -2, 0, 0x00000000u, { 0x280000u } },
    { 203, -2, 0, 0x00000000u, { 0x280000u } },
    { 204, -1, 0, 0x00000000u, { 0x280000u } },
    { 205, -1, 0, 0x00000000u, { 0x280000u } },
    { 206, -2, 0, 0x00000000u, { 0x280000u } },
    { 207, -2, 0, 0x00000000u, { 0x280000u } },
    { 208, -3, 0, 0x00000000u, { 0x280000u } },
    { 209, -3, 0, 0x00000000u, { 0x280000u } },
    { 210, -3, 0, 0x00000000u, { 0x280000u } },
    { 211, -3, 0, 0x00000000u, { 0x280000u } },
    { 212, -3, 0, 0x00000000u, { 0x280000u } },
    { 213, -1, 0, 0x00000000u, { 0x280000u } },
    { 214, -1, 0, 0x00000000u, { 0x280000u } },
    { 215, -2, 0, 0x00000000u, { 0x280000u } },
    { 216, -2, 0, 0x00000000u, { 0x280000u } },
    { 217, -1, 0, 0x00000000u, { 0x280000u } },
    { 218, -1, 0, 0x00000000u, { 0x280000u } },
    { 219, -2, 0, 0x00000000u, { 0x280000u } },
    { 220, -2, 0, 0x00000000u, { 0x280000u } },
    { 221, -2, 0, 0x00000000u, { 0x280000u } },
    { 222, -2, 0, 0x00000000u, { 0x280000u } },
    { 223, -1, 0, 0x00000000u, { 0x280000u } },
    { 224, -1, 0, 0x00000000u, { 0x280000u } },
    { 225, -2, 0, 0x00000000u, { 0x280000u } },
    { 226, -2, 0, 0x00000000u, { 0x280000u } },
    { 227, -2, 0, 0x00000000u, { 0x280000u } },
    { 228, -2, 0, 0x00000000u, { 0x280000u } },
    { 229, 32, 0, 0x92276f6eu, { 0x20u } },
    { 230, 32, 0, 0xc4a6b7c8u, { 0x20u } },
    { 231, -2, 0, 0x00000000u, { 0x20u } },
    { 232, -2, 0, 0x00000000u, { 0x20u } },
    { 229, 32, 0, 0x1f35270fu, { 0x40u } },
    { 230, 32, 0, 0x27374c97u, { 0x40u } },
    { 231, -2, 0, 0x00000000u, { 0x40u } },
    { 232, -2, 0, 0x00000000u, { 0x40u } },
    { 233, 0, 0, 0x72282aadu, { 0x80u } },
    { 234, 0, 0, 0xf227612du, { 0x80u } },
    { 235, 0, 0, 0x6dbc9d0bu, { 0x80u } },
    { 236, 0, 0, 0xedbbd38bu, { 0x80u } },
    { 237, 0, 0, 0x4b2a4c63u, { 0x80u } },
    { 238, 0, 0, 0xcb2982e3u, { 0x80u } },
    { 239, 0, 0, 0xaf14ed94u, { 0x80u } },
    { 240, 0, 0, 0x2f142414u, { 0x80u } },
    { 241, 0, 0, 0xe25220bbu, { 0x80u } },
    { 242, 0, 0, 0x6252ea3bu, { 0x80u } },
    { 243, 0, 0, 0x45f6a788u, { 0x400u } },
    { 244, 0, 0, 0x66f2bedfu, { 0x400u } },
    { 245, 0, 0, 0x4efed8e5u, { 0x400u } },
    { 246, 0, 0, 0x778bb7c6u, { 0x400u } },
    { 247, 0, 0, 0x20f0410du, { 0x400u } },
    { 248, 0, 0, 0x7d84e86au, { 0x400u } },
    { 249, -5, 0, 0x00000000u, { 0x400u } },
    { 250, -5, 0, 0x00000000u, { 0x400u } },
    { 251, -5, 0, 0x00000000u, { 0x400u } },
    { 252, -5, 0, 0x00000000u, { 0x400u } },
    { 253, -5, 0, 0x00000000u, { 0x400u } },
    { 254, -5, 0, 0x00000000u, { 0x400u } },
    { 255, -5, 0, 0x00000000u, { 0x400u } },
    { 256, -5, 0, 0x00000000u, { 0x400u } },
    { 257, 0, 0, 0x8010280bu, { 0x400u } },
    { 258, 0, 0, 0x3d19090au, { 0x400u } },
    { 259, 0, 0, 0x8c9f1d9du, { 0x400u } },
    { 260, 0, 0, 0x2c5df8dcu, { 0x400u } },
    { 261, 0, 0, 0x20aa110eu, { 0x400u } },
    { 262, 0, 0, 0x5194e811u, { 0x400u } },
    { 263, 0, 0, 0x0be66f74u, { 0x400u } },
    { 264, 0, 0, 0xef360c97u, { 0x400u } },
    { 265, 0, 0, 0x37e41a43u, { 0x400u } },
    { 266, 0, 0, 0x651f6e64u, { 0x400u } },
    { 267, 65, 0, 0xf8f22f5fu, { 0x2000u } },
    { 268, 75, 0, 0xcd746071u, { 0x2000u } },
    { 269, 76, 0, 0xbba3ec04u, { 0x2000u } },
    { 270, 76, 0, 0x84c5f6f3u, { 0x2000u } },
    { 271, 12, 0, 0xabe0a380u, { 0x2000u } },
    { 272, 64, 0, 0x4f67ca4eu, { 0x2000u } },
    { 273, 64, 0, 0x4f67ca4eu, { 0x2000u } },
    { 274, 64, 0, 0x4f67ca4eu, { 0x2000u } },
    { 275, 64, 0, 0x4f67ca4eu, { 0x2000u } },
    { 276, 0, 0, 0xc2770a1bu, { 0x2000u } },
    { 277, 0, 0, 0x32b79e9du, { 0x2000u } },
    { 278, 0, 0, 0x8f7d5420u, { 0x2000u } },
    { 279, 64, 0, 0x4f67ca4eu, { 0x2000u } },
    { 280, 88, 1, 0x4c3722fcu, { 0x2000u } },
    { 267, 64, 0, 0x55d1b847u, { 0x4000u } },
    { 268, 64, 0, 0x649c8f5eu, { 0x4000u } },
    { 281, 64, 0, 0x55d1b847u, { 0x4000u } },
    { 282, 64, 0, 0x55d1b847u, { 0x4000u } },
    { 283, 64, 0, 0x55d1b847u, { 0x4000u } },
    { 272, 64, 0, 0x55d1b847u, { 0x4000u } },
    { 273, 64, 0, 0x55d1b847u, { 0x4000u } },
    { 274, 64, 0, 0x55d1b847u, { 0x4000u } },
    { 275, 64, 0, 0x55d1b847u, { 0x4000u } },
    { 276, 0, 0, 0x98706e46u, { 0x4000u } },
    { 277, 0, 0, 0x2c5c6ba4u, { 0x4000u } },
    { 278, 0, 0, 0xf7681c72u, { 0x4000u } },
    { 279, 64, 0, 0x55d1b847u, { 0x4000u } },
    { 280, -3, 1, 0x00000000u, { 0x4000u } },
    { 284, 0, 0, 0x8f7eb80bu, { 0x10000u } },
    { 285, 0, 0, 0xe1723529u, { 0x10000u } },
    { 284, 0, 0, 0x1ad45dcfu, { 0x20000u } },
    { 285, -4, 0, 0x00000000u, { 0x20000u } },
    { 284, 0, 0, 0x7cda3cabu, { 0x40000u } },
    { 285, -4, 0, 0x00000000u, { 0x40000u } },
    { 229, 32, 0, 0xdf4210bcu, { 0x400000u } },
    { 230, 32, 0, 0x6fae5b82u, { 0x400000u } },
    { 231, -2, 0, 0x00000000u, { 0x400000u } },
    { 232, -2, 0, 0x00000000u, { 0x400000u } },
    { 229, 32, 0, 0xd4e4af95u, { 0x800000u } },
    { 230, 32, 0, 0x8d8bad04u, { 0x800000u } },
    { 231, -2, 0, 0x00000000u, { 0x800000u } },
    { 232, -2, 0, 0x00000000u, { 0x800000u } },
};

/* Makes all trials of one function, and leaves out each pointer in turn; returns how many are wrong. */
static uint32_t run_trials(int number)
{
    static auv6_table prepared;
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
                prepared = auv6_default;  /* prepare keeps what is not of the bodies */
                (void)auv6_prepare(&parameters, &prepared);
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
        if (status != (int)AUV6_BAD_ARGUMENT || sum.touched != 0) {
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
    volatile auv6_real x = 0.7;
    const auv6_real whole = (x + 6755399441055744.0) - 6755399441055744.0;
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
    const auv6_real *numbers = f->numbers;
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
int auv6_selftest(void (*print)(const char *text), unsigned long sweep)
{
    int failures = 0;
    length = 0u;
    (void)auv6_prepare_mounts(&auv6_default_parameters, &mounting);
    if (EXCESS != 0 || rounds_to_integer() == 0) {
        add_text("wrong results: compiled with ");
        add_text(EXCESS != 0 ? "x87 arithmetic, without -msse2 -mfpmath=sse"
                             : "-ffast-math, -Ofast, -funsafe-math-optimizations or a part of them");
        end_line(print);
    }
    add_text("mahovik selftest auv6 structure 192ea446 physics 002b2abc real double");
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

#ifdef AUV6_SELFTEST_MAIN
static void print_text(const char *text)
{
    (void)fputs(text, stdout);
}

int main(void)
{
    return auv6_selftest(print_text, AUV6_SELFTEST_SWEEP) != 0;
}
#endif
