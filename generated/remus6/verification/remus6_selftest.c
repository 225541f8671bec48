/* remus6_selftest.c: does remus6.c give the right bits on this machine?
 * With -ffast-math or its parts it gives wrong results with status OK: this test fails.
 * mahovik 0.1.0; structure 3687deee, physics 5f25aea2. Generated: change the stand file instead.
 *
 * Compile it with remus6.c as firmware is compiled (-std=c99 -ffp-contract=off; -fno-tree-vectorize as well by gcc
 * for x86-64 with FMA and for a Cortex-M55, or bits differ) and with
 * -DREMUS6_SELFTEST_MAIN, and run it; on a board, without that macro, call remus6_selftest with a function that
 * prints a text, such as to a serial port.
 * Golden vectors: inputs and answers of the generator's interpreter as hexadecimal constants; each bit must agree.
 * Trials: the first of them with a few inputs changed: every status, wrong numbers, null pointers; known as well.
 * Sweep: states drawn by an integer generator; one hash per function of all its answers is printed, to be
 * compared between machines. The log of a board is judged by `mahovik judge-log STAND.toml --log LOG`. It reads:
 *
 *     wrong results: compiled with ...   only if that is so: first, and then functions FAIL
 *     mahovik selftest remus6 structure 3687deee physics 5f25aea2 real double
 *     generator mahovik 0.1.0
 *     forward PASS cases 5 worst 0 ulp      one line per function; FAIL gives the number of wrong cases and
 *                                        what is wrong of them, such as "(status, numbers)"; with numbers worst is
 *                                        their largest distance, or "more than 1000000"
 *     sweep 100                          states
 *     forward 0123abcd                   one line per function: FNV-1a hash of its statuses and outputs
 *     failures 0                         functions that failed; the last line
 *
 * No allocation. It keeps inputs and results in static memory: one caller at a time. */
#include "../remus6.h"

#include <float.h>
#include <stddef.h>
#include <stdint.h>
#ifdef REMUS6_SELFTEST_MAIN
#include <stdio.h>
#endif

#if REMUS6_STRUCTURE != 0x3687deeeu || REMUS6_PHYSICS != 0x5f25aea2u
#error "remus6.h and remus6_selftest.c are of different stands"
#endif

#ifndef REMUS6_SELFTEST_SWEEP
#define REMUS6_SELFTEST_SWEEP 100ul  /* states of the sweep that main runs */
#endif

int remus6_selftest(void (*print)(const char *text), unsigned long sweep);

typedef uint64_t real_bits;

enum { CASES = 3, FUNCTIONS = 24, SWEPT = 4 };

#define FARTHEST ((real_bits)1000000u)  /* ulp: a worse distance is not printed as a number */

/* ---- inputs and results ---- */

/* Arguments of the functions, apart from the constants of the stand. */
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
    remus6_step_carry carry;
    remus6_real mass_factor;  /* multiplies all masses and inertias of the parameters */
} inputs;

static inputs in;
static remus6_parameters parameters;
static const remus6_table *table = &remus6_default;
static remus6_inverse_options options;
static int omitted;  /* the argument that is null, from 1; 0: none; -1: all that may be null */
static remus6_mount_table mounting;

static union {
    struct { remus6_real V_dot[6]; } forward;
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
    struct { remus6_step_carry carry; remus6_state next; } step_carried;
    struct { remus6_step_carry carry; remus6_state next; } step_driven_carried;
    unsigned char bytes[1];
} results;

/* Numbers that no literal of C99 is. */
typedef union special { real_bits word; remus6_real real; } special;
static const special infinite = { 0x7ff0000000000000u };
static const special not_a_number = { 0x7ff8000000000000u };

enum { UNTOUCHED = 0x5a };  /* value of every byte of the results before a call */

/* ---- results: their hash, and their distance from the expected numbers ---- */

typedef struct tally {
    uint32_t hash;                /* FNV-1a of all bits so far, the lowest byte of a number first */
    const remus6_real *expected;  /* next expected numbers, `left` of them */
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

static real_bits bits_of(remus6_real value)
{
    union { remus6_real real; real_bits word; } both;
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
        take_reals(sum, value->I_[i], REMUS6_N);
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
    take_reals(sum, value->center_of_mass_velocity, 3);
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
    take_reals(sum, &value->spin_root_inv, 1);
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

static void take_step_carry(tally *sum, const remus6_step_carry *value)
{
    take_reals(sum, value->rounding, 25);
}

/* ---- every function is called with the inputs, and its results are hashed and compared ---- */

static remus6_status call_forward(void)
{
    return remus6_forward((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.phi_ddot, (omitted == 4) ? NULL : results.forward.V_dot);
}

static void take_forward_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.forward.V_dot, 6);
}

static remus6_status call_matrices(void)
{
    return remus6_matrices((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : &results.matrices.out);
}

static void take_matrices_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_matrices_result(sum, &results.matrices.out);
}

static remus6_status call_momentum(void)
{
    return remus6_momentum((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : &results.momentum.out);
}

static void take_momentum_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_momentum_result(sum, &results.momentum.out);
}

static remus6_status call_torque(void)
{
    return remus6_torque((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL : results.torque.tau);
}

static void take_torque_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.torque.tau, REMUS6_N);
}

static remus6_status call_coupled(void)
{
    return remus6_coupled((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL : results.coupled.V_dot,
        (omitted == 5) ? NULL : results.coupled.phi_ddot);
}

static void take_coupled_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.coupled.V_dot, 6);
    take_reals(sum, results.coupled.phi_ddot, REMUS6_N);
}

static remus6_status call_step(void)
{
    return remus6_step((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.tau, (omitted < 0) ? NULL : in.locked, in.dt, in.order, (omitted == 4) ? NULL
        : &results.step.next);
}

static void take_step_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_state(sum, &results.step.next);
}

static remus6_status call_step_driven(void)
{
    return remus6_step_driven((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.phi_ddot, in.dt, in.order, (omitted == 4) ? NULL : &results.step_driven.next);
}

static void take_step_driven_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_state(sum, &results.step_driven.next);
}

static remus6_status call_wrap(void)
{
    return remus6_wrap(in.phi, (omitted == 1) ? NULL : &results.wrap.wrapped);
}

static void take_wrap_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.wrap.wrapped, 1);
}

static remus6_status call_phase_of_counts(void)
{
    return remus6_phase_of_counts(in.count, in.per_turn, in.zero, (omitted == 1) ? NULL
        : &results.phase_of_counts.phi);
}

static void take_phase_of_counts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.phase_of_counts.phi, 1);
}

static remus6_status call_speed_of_counts(void)
{
    return remus6_speed_of_counts(in.moved, in.per_turn, in.dt, (omitted == 1) ? NULL
        : &results.speed_of_counts.phi_dot);
}

static void take_speed_of_counts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.speed_of_counts.phi_dot, 1);
}

static remus6_status call_accumulate(void)
{
    results.accumulate.encoder = in.encoder;
    return remus6_accumulate((omitted == 1) ? NULL : &results.accumulate.encoder, in.counter, in.bits,
        in.per_turn);
}

static void take_accumulate_results(tally *sum, int refused)
{
    (void)refused;
    take_encoder(sum, &results.accumulate.encoder);
}

static remus6_status call_forward_jacobian(void)
{
    return remus6_forward_jacobian((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
        (omitted == 3) ? NULL : in.phi_ddot, (omitted == 4) ? NULL : &results.forward_jacobian.out);
}

static void take_forward_jacobian_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_forward_jacobian_result(sum, &results.forward_jacobian.out);
}

static remus6_status call_coupled_jacobian(void)
{
    return remus6_coupled_jacobian((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
        (omitted == 3) ? NULL : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL
        : &results.coupled_jacobian.out);
}

static void take_coupled_jacobian_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_coupled_jacobian_result(sum, &results.coupled_jacobian.out);
}

static remus6_status call_inverse(void)
{
    return remus6_inverse((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL : &results.inverse.out);
}

static void take_inverse_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_inverse_result(sum, &results.inverse.out);
}

static remus6_status call_inverse_fast(void)
{
    return remus6_inverse_fast((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.V_dot, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL
        : results.inverse_fast.phi_ddot);
}

static void take_inverse_fast_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.inverse_fast.phi_ddot, REMUS6_N);
}

static remus6_status call_points(void)
{
    return remus6_points((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : results.points.out);
}

static void take_points_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    for (int i = 0; i < REMUS6_SENSORS; ++i) {
        take_points_result(sum, &results.points.out[i]);
    }
}

static remus6_status call_quaternion(void)
{
    return remus6_quaternion((omitted == 1) ? NULL : in.angles, (omitted == 2) ? NULL
        : results.quaternion.attitude);
}

static void take_quaternion_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.quaternion.attitude, 4);
}

static remus6_status call_state_from_coordinates(void)
{
    results.state_from_coordinates.x = in.x;
    return remus6_state_from_coordinates((omitted == 1) ? NULL : in.position, (omitted == 2) ? NULL
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

static remus6_status call_generalized(void)
{
    return remus6_generalized((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.angles, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL
        : &results.generalized.out);
}

static void take_generalized_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_generalized_result(sum, &results.generalized.out);
}

static remus6_status call_prepare(void)
{
    results.prepare.table = remus6_default;
    return remus6_prepare((omitted == 1) ? NULL : &parameters, (omitted == 2) ? NULL
        : &results.prepare.table);
}

static void take_prepare_results(tally *sum, int refused)
{
    (void)refused;
    take_table(sum, &results.prepare.table);
}

static remus6_status call_mounts(void)
{
    return remus6_mounts((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &mounting, (omitted == 3)
        ? NULL : &in.x, (omitted == 4) ? NULL : in.V_dot, (omitted == 5) ? NULL : in.phi_ddot, (omitted == 6)
        ? NULL : results.mounts.mount_wrench);
}

static void take_mounts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.mounts.mount_wrench, 36);
}

static remus6_status call_prepare_mounts(void)
{
    return remus6_prepare_mounts((omitted == 1) ? NULL : &parameters, (omitted == 2) ? NULL
        : &results.prepare_mounts.mounting);
}

static void take_prepare_mounts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_mount_table(sum, &results.prepare_mounts.mounting);
}

static remus6_status call_step_carried(void)
{
    results.step_carried.carry = in.carry;
    return remus6_step_carried((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.tau, (omitted < 0) ? NULL : in.locked, in.dt, in.order, (omitted == 4) ? NULL
        : &results.step_carried.carry, (omitted == 5) ? NULL : &results.step_carried.next);
}

static void take_step_carried_results(tally *sum, int refused)
{
    take_step_carry(sum, &results.step_carried.carry);
    if (refused != 0) { return; }
    take_state(sum, &results.step_carried.next);
}

static remus6_status call_step_driven_carried(void)
{
    results.step_driven_carried.carry = in.carry;
    return remus6_step_driven_carried((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
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

static const remus6_real numbers_forward[] =
{
    0x1.c909c8b922322p+0, -0x1.2683c46877af1p+6, -0x1.2bb77d5c0069dp+2, -0x1.81500d0b80d0ep+7,
        -0x1.5b73d4b5b0f7fp-1, -0x1.40699ec6bf47ap+5,
    0x1.d30728ab1e99dp+9, 0x1.da14760ee3eccp+9, -0x1.bd934b429b04ep+9, -0x1.4e0564eb947b5p+13,
        0x1.6d2b4345ffc55p+11, 0x1.f29bff1e42c81p+8,
};

static const remus6_real numbers_matrices[] =
{
    0x1.f68f5c28f5c29p+4, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.31f6456b1a65cp-1, 0x1.5c999b52447ecp-11, 0x0p+0,
        0x1.07eb851eb851fp+6, 0x0p+0, -0x1.31f6456b1a65cp-1, 0x0p+0, -0x1.ee143310c6fe4p+0, 0x0p+0, 0x0p+0,
        0x1.07eb851eb851fp+6, -0x1.5c999b52447ecp-11, 0x1.ee143310c6fe4p+0, 0x0p+0, 0x0p+0,
        -0x1.31f6456b1a65cp-1, -0x1.5c999b52447ecp-11, 0x1.fab033c920266p-3, 0x1.8a8c07a072ccbp-14,
        0x1.1b1d319638fa9p-13, 0x1.31f6456b1a65cp-1, 0x0p+0, 0x1.ee143310c6fe4p+0, 0x1.8a8c07a072ccbp-14,
        0x1.0a9144f0c3be1p+3, 0x1.2cb567136080bp-15, 0x1.5c999b52447ecp-11, -0x1.ee143310c6fe4p+0,
    0x1.f68f5c28f5c29p+4, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.31cbf3e30aa7cp-1, 0x1.2b43a1b128d19p-11, 0x0p+0,
        0x1.07eb851eb851fp+6, 0x0p+0, -0x1.31cbf3e30aa7cp-1, 0x0p+0, -0x1.ee03fc3abec29p+0, 0x0p+0, 0x0p+0,
        0x1.07eb851eb851fp+6, -0x1.2b43a1b128d19p-11, 0x1.ee03fc3abec29p+0, 0x0p+0, 0x0p+0,
        -0x1.31cbf3e30aa7cp-1, -0x1.2b43a1b128d19p-11, 0x1.faac8fa807ccp-3, 0x1.2d05d87c269f8p-14,
        0x1.b78bbb9a26f52p-13, 0x1.31cbf3e30aa7cp-1, 0x0p+0, 0x1.ee03fc3abec29p+0, 0x1.2d05d87c269f8p-14,
        0x1.0a9092f725a1dp+3, 0x1.adb712bacde2bp-15, 0x1.2b43a1b128d19p-11, -0x1.ee03fc3abec29p+0,
};

static const remus6_real numbers_momentum[] =
{
    0x1.93febe69a1267p+5, 0x1.e9ed4c5d7bf18p+6, 0x1.e95a24d783e1cp+5, -0x1.482a7c86091b4p-1,
        0x1.fd2b5b101fac2p+2, 0x1.a5a9063063bb5p+1, 0x1.774b13663af54p+5, 0x1.758fd5cff6309p+4,
        0x1.10616ed7b2b78p+7, 0x1.a5fac55614549p+7, 0x1.927252d7020a4p+6, -0x1.461cdf76ba24ep+6,
        0x1.8fe4b2a58d2b4p+7, 0x1.2d9542b730807p-23, -0x1.6dfbf9be84622p-16, 0x1.41384e4168fbfp-6,
        0x1.b87df8aaeaf0cp-2, -0x1.0746fda4efbc8p-2, 0x1.4944de9517948p+1,
    0x1.4f4820b3f3188p+7, -0x1.9ee718b4bb866p+8, 0x1.075a02ece4b22p+9, 0x1.e1b7e911c5182p+1,
        0x1.1bde64ef82f72p+4, 0x1.ad5fbbce8e1d2p+5, -0x1.9daaede8228ep+4, 0x1.428b56e315ee2p+8,
        -0x1.315a415ca7b71p+9, 0x1.f4bab46d6d3acp+8, -0x1.631fe06984bd2p+8, -0x1.e80d8f6c3f45p+7,
        0x1.b22fa60f3eb2p+15, 0x1.1513a9927a735p-17, -0x1.3a3028bf5e978p-16, 0x1.410be0781b5p-6,
        0x1.5449eb94adb74p+0, 0x1.afaeec1f0dd5cp+1, -0x1.5bc1e095a900cp+3,
};

static const remus6_real numbers_torque[] =
{
    -0x1.1665f6604fc6ep-10, -0x1.2620a30d45a4bp-4, 0x1.24d34aba9a5dap-5, -0x1.7051763f7f778p-5,
        0x1.a009b9e8a601ap-5, -0x1.9912b305fbc79p-6,
    0x1.d0d0b58e6dfd4p-7, 0x1.470132dc16ccbp-4, -0x1.d9cb9b8fdd1b6p-5, 0x1.f553ac2017d05p-5,
        0x1.66ccb96e7abdcp-5, -0x1.5dd49446bb9e8p-5,
};

static const remus6_real numbers_coupled[] =
{
    0x1.d678bba07e73bp+0, -0x1.26c8ef13b211fp+6, -0x1.2b2b5e5914186p+2, -0x1.8a1b2256a489bp+7,
        -0x1.2e83a7841005ap-1, -0x1.406fc0ee1aa1ap+5, 0x0p+0, -0x1.67d24fc4abbd6p+12, 0x0p+0,
        -0x1.14b308c8647b6p+12, 0x1.65f654262a4e6p+12, 0x1.1f9bb187cc471p+11,
    0x1.d305d6feeb054p+9, 0x1.da14ad2cfb99ap+9, -0x1.bd97a0b468834p+9, -0x1.4e0690eb1fbacp+13,
        0x1.6d3d088f39a35p+11, 0x1.f295fe2e045e5p+8, -0x1.5b19a6d369508p+13, -0x1.8c6845d74b09p+13,
        -0x1.a2581a97e3a1dp+12, 0x1.2f8010d7ad386p+13, 0x0p+0, 0x0p+0,
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
    -0x1.0c9039389b246p-1, -0x1.5e4b1b2d86e25p+0, 0x1.d55a96c9ecf95p-1, 0x1.3fa8dcd1f169ap-5,
        0x1.cdd6c74155d11p-1, -0x1.18cd0cfa464c1p-2, -0x1.530aaa1d72478p-2, 0x1.50a0b93b00a7cp+2,
        -0x1.82b8ee3e3ba39p+2, 0x1.faff374bb3524p+2, 0x1.05693aa725b78p+2, 0x1.c730d87fb555ap-4,
        0x1.36376da588cb6p+2, 0x1.cfebb11e8b9b6p+0, -0x1.29667eb196db5p+1, -0x1.4e062d8d43e14p+1,
        -0x1.2f2c6939b4d18p-6, -0x1.13fbfe1929fa8p+1, -0x1.85b6fd6f200ep-2, -0x1.bb42731f7e4dp+13,
        0x1.a3f23a578add2p+13, 0x1.881e42b4cc326p+11, 0x1.4da4dca562b2bp+11, -0x1.c47ac4p+13, 0x1.1746e8p+13,
};

static const remus6_real numbers_step_driven[] =
{
    -0x1.779a1b324ec4cp-1, 0x1.80b85a37260dep+0, -0x1.10f69a06b75a7p-4, 0x1.23d5bb1075f7ep-1,
        -0x1.2f86f86b13c19p-5, -0x1.fa5efd89c06f4p-2, -0x1.4f6e343993d16p-1, 0x1.98d4ce46d54a8p+0,
        0x1.e50171a515253p+0, 0x1.d103f13d0af4dp-1, 0x1.f0eed4f5dd53p+0, 0x1.4629f361efa37p-1,
        0x1.a992db09b751p-1, -0x1.0bcb7abf9d9eep-3, 0x1.48e41a1d93f9fp+1, -0x1.256c5253707p+1,
        -0x1.9bcfb4ea38f3ep-1, -0x1.ebcda9574113ep+0, -0x1.3a2eb99cf9f9fp+0, -0x1.c61d220a4p+7,
        -0x1.3cc5160cp+4, -0x1.c4cf16e0ep+7, 0x1.d79355d84p+7, 0x1.35b56a86p+3, 0x1.29ab5bf58p+6,
    -0x1.0c903938d31d7p-1, -0x1.5e4b1b2d873f6p+0, 0x1.d55a96c967143p-1, 0x1.3fa8dcae899aep-5,
        0x1.cdd6c73fdbc33p-1, -0x1.18cd0cfbbc6d6p-2, -0x1.530aaa24cddeep-2, 0x1.50a0af62d7b7ap+2,
        -0x1.82b8ef517e6b5p+2, 0x1.faff54e3d601fp+2, 0x1.0569393b247a6p+2, 0x1.c70e441b1d7bcp-4,
        0x1.3637696cd99f9p+2, 0x1.cfed104627eecp+0, -0x1.2965b1f6703fbp+1, -0x1.4e05cc34f5fb4p+1,
        -0x1.2f759b68dabdp-6, -0x1.13fbfa2c181a8p+1, -0x1.85b71f5b640ep-2, -0x1.bb3d27c82ap+13,
        0x1.a3f8dc381d8p+13, 0x1.882c2848e8p+11, 0x1.4d954b7544p+11, -0x1.c47aa49771p+13, 0x1.1746c613bcp+13,
};

static const remus6_real numbers_wrap[] =
{
    -0x1.87dc0f9990e92p+1,
    -0x1.a9ea3d19013a9p-1,
};

static const remus6_real numbers_phase_of_counts[] =
{
    0x1.44ea670a66a78p+1,
    -0x1.279f66c7ce19p+1,
};

static const remus6_real numbers_speed_of_counts[] =
{
    -0x1.2df624deb7b68p+6,
    -0x1.5236779ab50a2p+12,
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
    -0x1.2a8bdf86ddd82p+0, 0x1.43a2739e37aa8p+3, -0x1.2e9451eca1afap-1, -0x1.7bdeca248a96ap-3,
        -0x1.0cb4ebd31c304p+4, -0x1.b46da79d0bb3fp+3, -0x1.7494041a88822p+0, -0x1.f34d21d85081p+7,
        0x1.1fa9cb3202be9p+2, 0x1.fd972cd3d5f81p+2, -0x1.7bcf9bdbffae2p-4, -0x1.6dc0c20e7f48cp+2,
        -0x1.fc7a6045dc3aap-1, -0x1.1f583f2145677p+2, -0x1.0550d9d81adf3p+5, 0x1.8d04a9de2ca46p+2,
        0x1.51c535b21bcf6p+1, -0x1.fbe5b9d1d479p-7, 0x1.021a9263c6e72p+3, -0x1.2d4fb64a5e945p+9,
        -0x1.66496e704146cp-4, -0x1.2587d28bc479ap+2, -0x1.5ac57cfdd7c8cp+2, -0x1.838660aba8cp-8,
        0x1.0af7968f43b34p+5, -0x1.80e063755ec51p-2, 0x1.18861bd39b007p+5, 0x1.3c69ac0935e72p+2,
        -0x1.4b8f1a47fc91ep-2, 0x1.41a17d7d65f4ap+2, 0x1.a0a9ee06be8f4p+4, -0x1.4f5922ac42a2dp+6,
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
    -0x1.2a799995c7367p+0, 0x1.4395bb9cfe20fp+3, -0x1.2ea3f8c587935p-1, -0x1.7bdc5ebe2a4dbp-3,
        -0x1.0cb64d7d6af04p+4, -0x1.b479ed6a9131dp+3, -0x1.748fe1fe60b7p+0, -0x1.f34d4bec7ba8fp+7,
        0x1.1fa9f6772d78dp+2, 0x1.fd9733c83d706p+2, -0x1.7bf32c8a89f76p-4, -0x1.6dc4edec74e34p+2,
        -0x1.fc88d19fc43dp-1, -0x1.1f57566dafa7ep+2, -0x1.0551251213969p+5, 0x1.8d04703332affp+2,
        0x1.51c4d10d9af4ep+1, -0x1.fb8974211a5bp-7, 0x1.0215af6bfc389p+3, -0x1.2d4fa65af94adp+9,
        -0x1.6952664c542b5p-4, -0x1.2588f50f4659ap+2, -0x1.5ac66a558ae75p+2, -0x1.75523ec4bf4p-8,
        0x1.0afadd015e138p+5, -0x1.815b680a4d856p-2, 0x1.188a3894f768ep+5, 0x1.3c6d32d4605bcp+2,
        -0x1.4b92796c9e58bp-2, 0x1.41a0a347adf1p+2, 0x1.a0ae1ea96d95ap+4, -0x1.4f5e1eedff4e7p+6,
};

static const remus6_real numbers_inverse[] =
{
    0x1.138725b4df949p+27, -0x1.988d4e59d3523p+26, -0x1.5a44480b73958p+25, -0x1.b1c1a27dec95p+21,
        -0x1.acb001413046ap+25, 0x1.e82cfd61d56f9p+25, 0x1.8p-39, 0x1p-38, -0x1p-38, -0x1.cp-38, -0x1.68p-38,
        0x1p-37, 0x1.f5089e134331bp-6, 0x1.0f4d9066313fep-7, 0x1.c109ee5e1e8cp-8, 0x1.5491a0ecf1e2cp-9,
        0x1.8c928f6b316b7p-10, 0x1.655947a50128p-13, 0x0p+0, 0x1.01c10c2f66506p+1, 0x1.10ff889ddf18cp+2,
        0x1.64bb644cc5c3ap+2, -0x1.7c4550f90fc1ep-5, -0x1.7c68d88805aafp-1, -0x1.f485ea701dac5p-2,
    0x1.bf8941db1bb9cp+26, -0x1.edd658d6662bdp+28, 0x1.ef72b60d2d60bp+29, -0x1.7585a906c9a07p+28,
        0x1.1b39b382b15b5p+29, -0x1.6346670db16a9p+29, -0x1p-34, 0x1.4p-34, 0x1p-34, 0x1p-34, 0x1.cp-35,
        -0x1p-35, 0x1.f4f82acb2368p-6, 0x1.fabf5202886f5p-8, 0x1.ba7776e3daf4ep-8, 0x1.0a294e0dbd82fp-8,
        0x1.25fdecbbfced5p-11, 0x1.1f543f9351f74p-12, 0x0p+0, -0x1.ad8130c27602fp-2, 0x1.8f77ae1075d2ep+2,
        0x1.468d8d0dbc7e7p+2, -0x1.86fbe38d023a4p-4, 0x1.29c6bdc99d0e4p-2, -0x1.e5522ffefe6b2p-3,
};

static const remus6_real numbers_inverse_fast[] =
{
    0x1.138725b4df9b5p+27, -0x1.988d4e59d35d1p+26, -0x1.5a44480b739d8p+25, -0x1.b1c1a27decc11p+21,
        -0x1.acb001413051dp+25, 0x1.e82cfd61d57f6p+25,
    0x1.bf8941db1bc65p+26, -0x1.edd658d66629cp+28, 0x1.ef72b60d2d5c4p+29, -0x1.7585a906c997fp+28,
        0x1.1b39b382b15bap+29, -0x1.6346670db16a1p+29,
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
    -0x1.d34643324b5f6p-3, -0x1.9dfece0eedd6bp+0, 0x1.44268a30a1b86p-1, 0x1.06e3bccfeb5eap-1,
        -0x1.dfc543388119dp-2, -0x1.70164c08d3603p-1, -0x1.f8f5294583464p-2, -0x1.b188597040842p-1,
        0x1.98dc3084e596fp-3, -0x1.6790d23f9a838p-1, 0x1.020eee92a12a6p-2, -0x1.54e495c765322p-1,
        0x1.9d473781247b2p+2, -0x1.e9727947ae148p+1, 0x1.be0d54d1d015fp+2, 0x1.50ce01eaba77dp+2, -0x1.2794p-5,
        0x1.fa76d8d5919p+1, 0x1.716d251cf76ep+5, 0x1.245223d85f7e8p+5, -0x1.ac38c323ccfa8p+4,
        -0x1.723702fda7b12p+2, 0x1.598328p+4, -0x1.3b1b4bf66df74p+4, -0x1.a558b2bc13e86p-2,
        -0x1.732d4cbab86ccp+0, 0x1.b5656a3486c76p-1, 0x1.42d03900db045p-1, -0x1.dfc543388119dp-2,
        -0x1.3cd840126d1e9p-1, -0x1.0a647f06392eep-1, -0x1.b188597040842p-1,
};

static const remus6_real numbers_quaternion[] =
{
    0x1.d1c580c9de08fp-1, 0x1.987cd3fe2cc46p-5, -0x1.a458e2ae68224p-2, -0x1.3651b35238a8ap-5,
    0x1.f68238403821p-1, -0x1.6b0c56560d266p-3, 0x1.99f99ad082726p-5, 0x1.b1b175e9eda29p-5,
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
    -0x1.cbd33cp+0, -0x1.c483b8p+0, -0x1.ed35p-5, 0x1.f68238403821p-1, -0x1.6b0c56560d266p-3,
        0x1.99f99ad082726p-5, 0x1.b1b175e9eda29p-5, -0x1.a788ba24b2dbap+0, 0x1.7eebf59c02b64p-1,
        -0x1.61ada365e592fp-3, 0x1.4b81893df23fep-1, -0x1.b81b472340288p-3, 0x1.adb4bfb1c8e5dp-1,
        -0x1.4256p+15, -0x1.923cb8p+22, -0x1.67826p+22, 0x1.512658p+21, -0x1.3b3c18p+21, 0x1.8eec5p+21,
        -0x1.bb3d38p+13, 0x1.a3f8a8p+13, 0x1.882d1p+11, 0x1.4d94ap+11, -0x1.c47ac4p+13, 0x1.1746e8p+13,
        0x1.d5589bdab9efap+2, -0x1.6eb4d101b0039p+3, 0x1.18d5938b09e72p+3, -0x1.5f756315ed956p+2,
        0x1.71752d8d6d63ap+3, -0x1.200f6d0c3c38ep+3,
    0x1.f09e08p+39, -0x1.f2802p+40, -0x1.31426p+37, -0x1.805ca6359016fp+0, 0x1.2c532da016609p-3,
        -0x1.a975d5f81fb37p-1, -0x1.04481679acfe6p+0, 0x1.5360e8p-1, -0x1.bc3c4p+0, 0x1.4b5d2p+0,
        -0x1.e1ea1p-1, 0x1.43f77p-2, -0x1.7eaadp+0, 0x1.9d9098p+42, 0x1.2190ap+43, 0x1.881898p+43,
        0x1.f82364p+43, -0x1.f67078p+42, 0x1.ef22p+41, 0x1.9d4d4p+3, -0x1.125cp+7, -0x1.02414p+4,
        0x1.bf9368p+7, 0x1.82c238p+7, 0x1.7c810cp+7,
};

static const remus6_real numbers_generalized[] =
{
    0x1.51fae45d6853p-1, -0x1.c1fb8ff509d0ap-4, 0x1.7c75b6483a306p-1, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.ca78feff694fap-6, 0x1.fbfc07e709aabp-1, 0x1.f2fd639430ecfp-4, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.80540954e8e0ep-1, -0x1.e870fe184e90ap-5, 0x1.50e740352e2f7p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.7c75b6483a306p-1, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.f2fd639430ecfp-4,
        0x1.f771d1d15770ap-1, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.fa90b6b00d9e4p-1, 0x1.60fa3641888e5p-4, -0x1.df41714e6bf9p-4, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.f2546260ad78cp-4, 0x1.dcf3865d167ebp-1, -0x1.5ee457e8a4b06p-2, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.457e8f1c83dd7p-4, 0x1.69be856db65dap-2, 0x1.dd41b0a4ef505p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, -0x1.df41714e6bf8ep-4, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.5ee457e8a4b04p-2,
        0x1.e08eb43e33601p-1, 0x0p+0, 0x0p+0, 0x0p+0,
};

static const remus6_real numbers_prepare[] =
{
    0x1.b3ea6b870a3d7p+4, 0x1.2cae96ba589cfp-5, -0x1.145c35e3d08p-15, -0x1.5f491097af11p-12,
        0x1.117770e517bd2p-1, 0x1.d4387d55562bcp-3, 0x1.fdaf8f969d5f7p+2, 0x1.fdaf8a9363204p+2,
        0x1.dc660afb41142p-14, 0x1.4ac6ffdd32cep-14, 0x1.870cbe9f20fb5p-16, 0x1.c2cbb3351eb85p+4,
        0x1.f5f535c3851ecp+5, 0x1.f5f535c3851ecp+5, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.22c1c9d68985cp-5,
        0x1.051f1c4d2de26p-6, 0x1.051f1c4d2de26p-6, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x1.ee147ae147ae1p+0, 0x0p+0, -0x1.ee147ae147ae1p+0, 0x0p+0,
    0x1.0602201a8f5c2p+5, 0x1.f4424afd4a08ep-6, -0x1.4c36cda3db8p-15, -0x1.a648360b82aep-12,
        0x1.48bc51fdc7a4bp-1, 0x1.0adb07f11830dp-2, 0x1.12c9882d93661p+3, 0x1.12c9852a49d6ap+3,
        0x1.1e57356eaededp-13, 0x1.8da11453dbb2p-14, 0x1.d615424081cb4p-16, 0x1.0d72c3f199999p+5,
        0x1.1101100d47ae1p+6, 0x1.1101100d47ae1p+6, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.e672212a13b0ep-6,
        0x1.e01c236ed643bp-7, 0x1.e01c236ed643bp-7, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
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
    0x1.7193b0b4b166dp+4, 0x1.191cc3a9493cp+15, -0x1.18f2d964524d5p+14, 0x1.d0d0b58e6e549p-7,
        -0x1.d43cf1ad858dep+6, 0x1.00b468afb8226p+6, 0x1.41be145bee285p+5, 0x1.28586c7e3e88bp+15,
        -0x1.7e14ec6494d14p+6, 0x1.470132dc16c25p-4, -0x1.5bf5a1630aba2p+6, 0x1.b9bb4223095b4p+5,
        0x1.1030fa641ce39p+1, 0x1.bd0379137cccap+10, 0x1.31ed6524349a1p+9, -0x1.d9cb9b8fdd35bp-5,
        -0x1.b34ce705425edp+1, 0x1.1c05efc1bb639p+2, -0x1.202cf85ac1421p+3, -0x1.66b41d0d2b827p+10,
        -0x1.899b754a59e66p+6, 0x1.f553ac2017d4ep-5, 0x1.bfd67bdf80848p+0, 0x1.2b15363d53b1p-1,
        0x1.1d7c01662166dp+5, -0x1.80989c0d3b07bp+13, 0x1.38cf8bd173f62p+15, 0x1.66ccb96e7a938p-5,
        -0x1.17533abaa9bd5p+6, 0x1.b9781d950696ep+3, 0x1.0ff6d861fd8c8p+2, -0x1.0e2112e8c8793p+13,
};

static const remus6_real numbers_prepare_mounts[] =
{
    0x1.c9a77fp-3, 0x0p+0, 0x1.76e90f27bb2ffp-13, 0x0p+0, 0x1.192ecb5dcc63fp-13, 0x1.3eac8014f8b59p-14,
        0x1.516b5a708ede6p-14, -0x1.3d9b4064c0ca4p-75, -0x1.1fee61a7bac49p-21, 0x0p+0, 0x1.c28f5c28f5c29p-3,
        0x1.1eb851eb851ecp-5, 0x1.47ae147ae147bp-6, 0x0p+0, 0x0p+0, 0x1p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1p+0, 0x0p+0, 0x1.c9a77fp-3, 0x0p+0, 0x1.89a7e9835158cp-13, 0x0p+0, 0x1.192ecb5dcc63fp-13,
        0x1.3eac8014f8b59p-14, 0x1.49ebcfe586013p-14, -0x1.dfe2a2c237477p-23, -0x1.9f97c57df30c4p-22, 0x0p+0,
    0x1.1313078p-2, 0x0p+0, 0x1.c2ae89a027526p-13, 0x0p+0, 0x1.5202e7381d7dbp-13, 0x1.7f145b61bb06p-14,
        0x1.959d157689ca2p-14, -0x1.7dcbe2150009ep-75, -0x1.5a1fa516a55dfp-21, 0x0p+0, 0x1.c28f5c28f5c29p-3,
        0x1.1eb851eb851ecp-5, 0x1.47ae147ae147bp-6, 0x0p+0, 0x0p+0, 0x1p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1p+0, 0x0p+0, 0x1.1313078p-2, 0x0p+0, 0x1.d93743b4f6167p-13, 0x0p+0, 0x1.5202e7381d7dbp-13,
        0x1.7f145b61bb06p-14, 0x1.8c9997d49d7bap-14, -0x1.206fb43d89ce3p-22, -0x1.f3961e7a5e62dp-22, 0x0p+0,
};

static const remus6_real numbers_step_carried[] =
{
    -0x1.7ap-60, -0x1.bd5ap-54, -0x1.18p-58, 0x1.ff13698p-55, -0x1.25723ap-59, 0x1.0417fcp-56, 0x1.8facp-63,
        -0x1.527p-54, -0x1p-57, -0x1.ed8p-55, -0x1.ap-56, -0x1.1d4p-56, -0x1.1p-56, -0x1p-56, -0x1.558p-53,
        0x0p+0, 0x1p-59, 0x1.468p-54, 0x1.9p-56, 0x1p-47, -0x1.ap-50, -0x1p-47, 0x1.68p-47, 0x1.8p-51,
        -0x1.4p-53, -0x1.779a1c8c26818p-1, 0x1.80b85a8c25976p+0, -0x1.10f694af4b603p-4, 0x1.23d5bacbe58aep-1,
        -0x1.2f86ec8a955bbp-5, -0x1.fa5efcae30f91p-2, -0x1.4f6e34d2d730dp-1,
    0x1.62p-55, -0x1.05p-54, 0x1.e2p-56, 0x1.bd422a4p-59, 0x1.889881p-56, -0x1.1dbcbap-59, -0x1.10d814p-59,
        -0x1.cp-52, 0x1p-54, -0x1.1p-52, -0x1p-54, 0x0p+0, -0x1.5p-53, -0x1p-53, 0x1.9676733ae8fe4p-54,
        0x1.cp-53, 0x0p+0, 0x1p-52, 0x0p+0, -0x1.966p-41, -0x1.1fap-42, 0x1.b88p-43, -0x1.8ap-45, 0x1.c4p-41,
        0x1.34p-41, -0x1.0c903aacf4846p-1, -0x1.5e4b1a5a8ea05p+0, 0x1.d55a97da5e4d5p-1, 0x1.3fa8e3145d2ccp-5,
        0x1.cdd6c69727bcfp-1, -0x1.18cd0d81776fep-2, -0x1.530aad35240b4p-2,
    0x1.f96c5p-26, 0x1.0100d8p-25, -0x1.a83864p-25, -0x1.d00b7p-25, -0x1.f6d9a8p-26, 0x1.41229cp-25,
        -0x1.6e7b7p-26, -0x1.8f755p-26, 0x1.f1e5fp-25, 0x1.661b5p-26, 0x1.cc741p-25, -0x1.782598p-25,
        0x1.30eddp-26, -0x1.1eb5b4p-25, -0x1.40e19cp-25, -0x1.e0cfc8p-26, 0x1.8f7858p-25, -0x1.f2c714p-25,
        -0x1.f53a1p-26, 0x1.3b55cp-29, 0x1.bb9c28p-25, 0x1.ea3264p-25, -0x1.1e9248p-26, 0x1.8d7fc8p-26,
        0x1.f0fd5p-27,
};

static const remus6_real numbers_step_driven_carried[] =
{
    0x1.1f4p-58, -0x1.3a2ap-54, -0x1.6p-58, -0x1.f04be7p-56, 0x1.8c7cba8p-59, 0x1.f94108p-57, -0x1.293d18p-58,
        0x1.724p-55, -0x1.7p-55, -0x1.d28p-55, -0x1p-53, 0x1.918p-58, 0x1.ap-56, -0x1p-56, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x1p-47, 0x0p+0, -0x1p-47, -0x1p-47, 0x0p+0, 0x0p+0, -0x1.779a1c8af174cp-1,
        0x1.80b85a8c793fep+0, -0x1.10f694aec3da7p-4, 0x1.23d5baccde40ep-1, -0x1.2f86eb5161faep-5,
        -0x1.fa5efcdd137e6p-2, -0x1.4f6e34c1686b4p-1,
    -0x1.88p-58, -0x1.c3p-56, 0x1.5ap-55, 0x1.1c04d1p-59, -0x1.f22ed5p-56, 0x1.2e63b3p-58, 0x1.efd13d8p-57,
        0x1.cp-52, -0x1.bp-53, 0x1.fp-53, -0x1.cp-52, 0x0p+0, 0x1.8p-56, 0x0p+0, 0x1.cb3b399d747f2p-53,
        0x0p+0, 0x0p+0, 0x1p-52, 0x0p+0, -0x1.b8p-41, -0x1.6p-44, -0x1.ep-43, -0x1.ep-43, 0x1.c4p-41,
        0x1.34p-41, -0x1.0c903aad2c7d7p-1, -0x1.5e4b1a5a8efd6p+0, 0x1.d55a97d9d8683p-1, 0x1.3fa8e2f0f55ep-5,
        0x1.cdd6c695adaf1p-1, -0x1.18cd0d82ed912p-2, -0x1.530aad3c7fa2ap-2,
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
    remus6_status (*call)(void);
    void (*take)(tally *sum, int refused);
    const remus6_real *numbers;
    answer answers[CASES];
    uint32_t swept;  /* hash of the first SWEPT states of a sweep */
} function;

static const function functions[FUNCTIONS] =
{
    { "forward", 4, sizeof results.forward, 0u,
      call_forward, take_forward_results, numbers_forward,
      { { 0, 0x1c432034u, 6 }, { 0, 0xe20a71e3u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x6b0912c5u },
    { "matrices", 3, sizeof results.matrices, 0u,
      call_matrices, take_matrices_results, numbers_matrices,
      { { 0, 0xe2460fbfu, 32 }, { 0, 0x1628a993u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xe9b50527u },
    { "momentum", 3, sizeof results.momentum, 0u,
      call_momentum, take_momentum_results, numbers_momentum,
      { { 0, 0x8344d83eu, 19 }, { 0, 0x383ce2beu, 19 }, { -2, 0x8e5b0aa0u, 0 } },
      0xfd934e29u },
    { "torque", 5, sizeof results.torque, 0u,
      call_torque, take_torque_results, numbers_torque,
      { { 0, 0xa33fdd42u, 6 }, { 0, 0x23da9ddcu, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x42996544u },
    { "coupled", 5, sizeof results.coupled, 0u,
      call_coupled, take_coupled_results, numbers_coupled,
      { { 0, 0xd7c991bbu, 12 }, { 0, 0xcac511c4u, 12 }, { -2, 0x8e5b0aa0u, 0 } },
      0x29d21441u },
    { "step", 4, sizeof results.step, 0u,
      call_step, take_step_results, numbers_step,
      { { 0, 0xb0c15179u, 25 }, { 32, 0xdf26e291u, 25 }, { -2, 0x8e5b0aa0u, 0 } },
      0xf7a550beu },
    { "step_driven", 4, sizeof results.step_driven, 0u,
      call_step_driven, take_step_driven_results, numbers_step_driven,
      { { 0, 0x4f70ddb5u, 25 }, { 32, 0x43b030f6u, 25 }, { -2, 0x8e5b0aa0u, 0 } },
      0xc665ae86u },
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
      { { 0, 0x272d9789u, 32 }, { 0, 0xf8aad72bu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x27e287c1u },
    { "coupled_jacobian", 4, sizeof results.coupled_jacobian, 0u,
      call_coupled_jacobian, take_coupled_jacobian_results, numbers_coupled_jacobian,
      { { 0, 0xde793f08u, 32 }, { 0, 0x65862584u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x62ce16b0u },
    { "inverse", 5, sizeof results.inverse, 0u,
      call_inverse, take_inverse_results, numbers_inverse,
      { { 64, 0x072e5b27u, 25 }, { 64, 0xf29dea30u, 25 }, { -2, 0x8e5b0aa0u, 0 } },
      0x2fab2c84u },
    { "inverse_fast", 5, sizeof results.inverse_fast, 0u,
      call_inverse_fast, take_inverse_fast_results, numbers_inverse_fast,
      { { 64, 0x78c9f6beu, 6 }, { 64, 0x10d57d0fu, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0xbc48f9ceu },
    { "points", 4, sizeof results.points, 0u,
      call_points, take_points_results, numbers_points,
      { { 0, 0x529ea787u, 32 }, { 0, 0x73557e8eu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xaa4eadd6u },
    { "quaternion", 2, sizeof results.quaternion, 0u,
      call_quaternion, take_quaternion_results, numbers_quaternion,
      { { 0, 0x13a20f40u, 4 }, { 0, 0x631a0e67u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0x4e387b30u },
    { "state_from_coordinates", 6, sizeof results.state_from_coordinates, sizeof results.state_from_coordinates.x,
      call_state_from_coordinates, take_state_from_coordinates_results, numbers_state_from_coordinates,
      { { 0, 0x4ff18024u, 31 }, { 0, 0x7b5e9777u, 31 }, { -2, 0x249e3b21u, 25 } },
      0xf0f03c04u },
    { "generalized", 5, sizeof results.generalized, 0u,
      call_generalized, take_generalized_results, numbers_generalized,
      { { 0, 0x2e9f5fdcu, 32 }, { 0, 0x540287eau, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x91a56388u },
    { "prepare", 2, sizeof results.prepare, sizeof results.prepare.table,
      call_prepare, take_prepare_results, numbers_prepare,
      { { 0, 0xb071ddf8u, 32 }, { 0, 0x31f5733au, 32 }, { -2, 0xb77c2610u, 32 } },
      0x974dacfau },
    { "mounts", 6, sizeof results.mounts, 0u,
      call_mounts, take_mounts_results, numbers_mounts,
      { { 0, 0xfcdfa476u, 32 }, { 0, 0xf0d20713u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x0261c3efu },
    { "prepare_mounts", 2, sizeof results.prepare_mounts, 0u,
      call_prepare_mounts, take_prepare_mounts_results, numbers_prepare_mounts,
      { { 0, 0xd0c5eb5au, 32 }, { 0, 0x64b18ae0u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x3bb6d17bu },
    { "step_carried", 5, sizeof results.step_carried, sizeof results.step_carried.carry,
      call_step_carried, take_step_carried_results, numbers_step_carried,
      { { 0, 0x11493f28u, 32 }, { 32, 0xde78bf88u, 32 }, { -2, 0xd062397fu, 25 } },
      0x2722838fu },
    { "step_driven_carried", 5, sizeof results.step_driven_carried, sizeof results.step_driven_carried.carry,
      call_step_driven_carried, take_step_driven_carried_results, numbers_step_driven_carried,
      { { 0, 0x11dfee7du, 32 }, { 32, 0xd8366f8au, 32 }, { -2, 0xd062397fu, 25 } },
      0xf8ff74e7u },
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

/* The square of a quaternion of integers, divided by its length: a unit quaternion; to be refused: of length 2. */
static void draw_attitude(uint32_t *seed, remus6_real attitude[4], int refused)
{
    const uint32_t word = draw_word(seed);
    const int32_t a = 2 * (int32_t)(word >> 25) - 127;  /* odd, so that not all are 0 */
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

/* A step short enough for light flywheels with strong damping. */
static remus6_real draw_step(const uint32_t *seed)
{
    (void)seed;
    return 0x1p-14;
}

static remus6_real draw_factor(uint32_t *seed, remus6_real largest)
{
    return 1.0 + draw_real(seed, largest);
}

static void draw_powers(uint32_t *seed, remus6_real *values, int count, remus6_real least)
{
    for (int i = 0; i < count; ++i) {
        values[i] = least;
        for (uint32_t k = draw_word(seed) >> 27; k > 0u; --k) {
            values[i] = values[i] * 2.0;
        }
    }
}

static remus6_real draw_share(uint32_t *seed)
{
    const remus6_real share = draw_real(seed, 1.0);
    return share < 0.0 ? -share : share;
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
    draw_reals(seed, in.carry.rounding, 25, 5.960464477539063e-8);
    in.mass_factor = draw_factor(seed, 0.125);
}

static void draw_options(uint32_t *seed)
{
    draw_powers(seed, options.weight, REMUS6_N, 0.0009765625);
    draw_powers(seed, options.limit, REMUS6_N, 1.0);
    draw_powers(seed, options.most, REMUS6_N, 1.0);
    draw_powers(seed, options.motor_torque, REMUS6_N, 1.52587890625e-5);
    draw_powers(seed, options.motor_speed, REMUS6_N, 0.00390625);
    draw_powers(seed, options.motor_viscous, REMUS6_N, 9.313225746154785e-10);
    draw_powers(seed, options.motor_coulomb, REMUS6_N, 9.5367431640625e-7);
    draw_powers(seed, options.motor_coulomb_speed, REMUS6_N, 0.00390625);
    options.near_singular = draw_share(seed);
    options.damping = draw_share(seed);
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

/* Calls one function, then hashes and compares its results. */
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
    f->take(sum, *status < 0 ? 1 : 0);
    for (size_t i = f->kept; *status < 0 && i < f->size; ++i) {
        sum->touched += bytes[i] != (unsigned char)UNTOUCHED ? 1 : 0;
    }
}

/* The inputs of a golden case. */
static void reset(int number)
{
    in = golden[number];
    table = &remus6_default;
    options = remus6_default_options;
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
        parameters.point[0].position[0] = not_a_number.real;
        break;
    case 230:
        parameters.point[0].position[2] = infinite.real;
        break;
    case 231:
        parameters.point[0].position[0] = 0x1p+60;
        break;
    case 232:
        parameters.point[0].position[2] = -0x1p+60;
        break;
    case 233:
        parameters.point[0].axis[0] = not_a_number.real;
        break;
    case 234:
        parameters.point[0].axis[2] = infinite.real;
        break;
    case 235:
        parameters.point[0].axis[0] = 0x1p+60;
        break;
    case 236:
        parameters.point[0].axis[2] = -0x1p+60;
        break;
    case 237:
        parameters.point[0].axis[0] = 0x0p+0;
        parameters.point[0].axis[1] = 0x0p+0;
        parameters.point[0].axis[2] = 0x0p+0;
        break;
    case 238:
        parameters.point[0].axis[0] = 0x1p+0;
        parameters.point[0].axis[1] = 0x0p+0;
        parameters.point[0].axis[2] = 0x0p+0;
        parameters.point[0].zero[0] = 0x1p+0;
        parameters.point[0].zero[1] = 0x0p+0;
        parameters.point[0].zero[2] = 0x0p+0;
        break;
    case 239:
        parameters.point[0].zero[0] = not_a_number.real;
        break;
    case 240:
        parameters.point[0].zero[2] = infinite.real;
        break;
    case 241:
        parameters.point[0].zero[0] = 0x1p+60;
        break;
    case 242:
        parameters.point[0].zero[2] = -0x1p+60;
        break;
    case 243:
        parameters.point[0].zero[0] = 0x0p+0;
        parameters.point[0].zero[1] = 0x0p+0;
        parameters.point[0].zero[2] = 0x0p+0;
        break;
    case 244:
        parameters.point[0].zero[0] = 0x1p+0;
        parameters.point[0].zero[1] = 0x0p+0;
        parameters.point[0].zero[2] = 0x0p+0;
        parameters.point[0].axis[0] = 0x1p+0;
        parameters.point[0].axis[1] = 0x0p+0;
        parameters.point[0].axis[2] = 0x0p+0;
        break;
    case 245:
        in.dt = 0x1p-3;
        in.order = 2;
        break;
    case 246:
        in.dt = 0x1p-3;
        in.order = 4;
        break;
    case 247:
        in.dt = 0x1p+3;
        in.order = 2;
        break;
    case 248:
        in.dt = 0x1p+3;
        in.order = 4;
        break;
    case 249:
        in.phi = 0x1.8p+1;
        break;
    case 250:
        in.phi = -0x1.8p+1;
        break;
    case 251:
        in.phi = 0x1.921fb54442d18p+1;
        break;
    case 252:
        in.phi = -0x1.921fb54442d18p+1;
        break;
    case 253:
        in.phi = 0x1.cp+1;
        break;
    case 254:
        in.phi = -0x1.cp+1;
        break;
    case 255:
        in.phi = 0x1.2d97c7f3321d2p+3;
        break;
    case 256:
        in.phi = -0x1.2d97c7f3321d2p+3;
        break;
    case 257:
        in.phi = 0x1.f4p+9;
        break;
    case 258:
        in.phi = -0x1.f4p+9;
        break;
    case 259:
        in.bits = 0;
        in.encoder.counter = 0;
        in.counter = 4090;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 260:
        in.bits = 0;
        in.encoder.counter = 0;
        in.counter = 4090;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 261:
        in.bits = 0;
        in.encoder.counter = 4090;
        in.counter = 0;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 262:
        in.bits = 0;
        in.encoder.counter = 4090;
        in.counter = 0;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 263:
        in.bits = 0;
        in.encoder.counter = 100;
        in.counter = 200;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 264:
        in.bits = 0;
        in.encoder.counter = 100;
        in.counter = 200;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 265:
        in.bits = 0;
        in.encoder.counter = -1;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 266:
        in.bits = 0;
        in.encoder.counter = -1;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 267:
        in.bits = 0;
        in.encoder.counter = 4096;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 268:
        in.bits = 0;
        in.encoder.counter = 4096;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 269:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = -1;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 270:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = -1;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 271:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = 4096;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 272:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = 4096;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 273:
        in.bits = 16;
        in.encoder.counter = 32767;
        in.counter = -32768;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 274:
        in.bits = 16;
        in.encoder.counter = 32767;
        in.counter = -32768;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 275:
        in.bits = 16;
        in.encoder.counter = -32768;
        in.counter = 32767;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 276:
        in.bits = 16;
        in.encoder.counter = -32768;
        in.counter = 32767;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 277:
        in.bits = 16;
        in.encoder.counter = 0;
        in.counter = 30000;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 278:
        in.bits = 16;
        in.encoder.counter = 0;
        in.counter = 30000;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 279:
        in.bits = 32;
        in.encoder.counter = 2147483647;
        in.counter = -2147483647;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 280:
        in.bits = 32;
        in.encoder.counter = 2147483647;
        in.counter = -2147483647;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 281:
        in.bits = 32;
        in.encoder.counter = -2147483647;
        in.counter = 2147483647;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 282:
        in.bits = 32;
        in.encoder.counter = -2147483647;
        in.counter = 2147483647;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 283:
        options.near_singular = 0x1p+0;
        break;
    case 284:
        options.near_singular = 0x1p+0;
        options.damping = 0x1p-1;
        break;
    case 285:
        for (int s = 0; s < REMUS6_N; ++s) { options.limit[s] = 0x1.9d4ab88f4f5eep+26; }
        break;
    case 286:
        for (int s = 0; s < REMUS6_N; ++s) { options.limit[s] = 0x1.138725b4df949p+25; }
        break;
    case 287:
        for (int s = 0; s < REMUS6_N; ++s) { options.limit[s] = 0x1.138725b4df949p+17; }
        break;
    case 288:
        for (int s = 0; s < REMUS6_N; ++s) { options.weight[s] = 0x1p+2; }
        break;
    case 289:
        for (int s = 0; s < REMUS6_N; ++s) { options.most[s] = 0x1p-10; }
        break;
    case 290:
        for (int s = 0; s < REMUS6_N; ++s) { options.motor_torque[s] = 0x1p-10; }
        break;
    case 291:
        for (int s = 0; s < REMUS6_N; ++s) { options.motor_speed[s] = 0x1p-10; }
        break;
    case 292:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < REMUS6_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.V_dot[0] = 0x1p-12;
        in.V_dot[1] = -0x1p-12;
        in.V_dot[2] = 0x1p-12;
        in.V_dot[3] = -0x1p-12;
        in.V_dot[4] = 0x1p-12;
        in.V_dot[5] = -0x1p-12;
        break;
    case 293:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < REMUS6_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.V_dot[0] = 0x1p-6;
        in.V_dot[1] = -0x1p-6;
        in.V_dot[2] = 0x1p-6;
        in.V_dot[3] = -0x1p-6;
        in.V_dot[4] = 0x1p-6;
        in.V_dot[5] = -0x1p-6;
        break;
    case 294:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < REMUS6_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.V_dot[0] = 0x1p+0;
        in.V_dot[1] = -0x1p+0;
        in.V_dot[2] = 0x1p+0;
        in.V_dot[3] = -0x1p+0;
        in.V_dot[4] = 0x1p+0;
        in.V_dot[5] = -0x1p+0;
        break;
    case 295:
        for (int s = 0; s < REMUS6_N; ++s) { options.motor_viscous[s] = 0x1p-1; }
        for (int s = 0; s < REMUS6_N; ++s) { options.motor_coulomb[s] = 0x1p-1; }
        for (int s = 0; s < REMUS6_N; ++s) { options.motor_coulomb_speed[s] = 0x1p-1; }
        break;
    case 296:
        for (int s = 0; s < REMUS6_N; ++s) { parameters.flywheel[s].axis[0] = 0x1p+0; }
        for (int s = 0; s < REMUS6_N; ++s) { parameters.flywheel[s].axis[1] = 0x0p+0; }
        for (int s = 0; s < REMUS6_N; ++s) { parameters.flywheel[s].axis[2] = 0x0p+0; }
        for (int s = 0; s < REMUS6_N; ++s) { parameters.flywheel[s].zero[0] = 0x0p+0; }
        for (int s = 0; s < REMUS6_N; ++s) { parameters.flywheel[s].zero[1] = 0x1p+0; }
        for (int s = 0; s < REMUS6_N; ++s) { parameters.flywheel[s].body.center_of_mass[1] = 0x0p+0; }
        for (int s = 0; s < REMUS6_N; ++s) { parameters.flywheel[s].body.center_of_mass[2] = 0x0p+0; }
        for (int s = 0; s < REMUS6_N; ++s) { parameters.flywheel[s].body.inertia[3] = 0x0p+0; }
        for (int s = 0; s < REMUS6_N; ++s) { parameters.flywheel[s].body.inertia[4] = 0x0p+0; }
        break;
    case 297:
        for (int s = 0; s < REMUS6_N; ++s) { options.limit[s] = 0x1.9d4ab88f4f69p+26; }
        break;
    case 298:
        for (int s = 0; s < REMUS6_N; ++s) { options.limit[s] = 0x1.138725b4df9b5p+25; }
        break;
    case 299:
        for (int s = 0; s < REMUS6_N; ++s) { options.limit[s] = 0x1.138725b4df9b5p+17; }
        break;
    case 300:
        in.angles[1] = 0x0p+0;
        break;
    case 301:
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
    { 229, -1, 0, 0x00000000u, { 0x280000u } },
    { 230, -1, 0, 0x00000000u, { 0x280000u } },
    { 231, -2, 0, 0x00000000u, { 0x280000u } },
    { 232, -2, 0, 0x00000000u, { 0x280000u } },
    { 233, -1, 0, 0x00000000u, { 0x280000u } },
    { 234, -1, 0, 0x00000000u, { 0x280000u } },
    { 235, -2, 0, 0x00000000u, { 0x280000u } },
    { 236, -2, 0, 0x00000000u, { 0x280000u } },
    { 237, -2, 0, 0x00000000u, { 0x280000u } },
    { 238, -2, 0, 0x00000000u, { 0x280000u } },
    { 239, -1, 0, 0x00000000u, { 0x280000u } },
    { 240, -1, 0, 0x00000000u, { 0x280000u } },
    { 241, -2, 0, 0x00000000u, { 0x280000u } },
    { 242, -2, 0, 0x00000000u, { 0x280000u } },
    { 243, -2, 0, 0x00000000u, { 0x280000u } },
    { 244, -2, 0, 0x00000000u, { 0x280000u } },
    { 245, 32, 0, 0x726ad72fu, { 0x20u } },
    { 246, -2, 0, 0x00000000u, { 0x20u } },
    { 247, -2, 0, 0x00000000u, { 0x20u } },
    { 248, -2, 0, 0x00000000u, { 0x20u } },
    { 245, 32, 0, 0xef4708c4u, { 0x40u } },
    { 246, -2, 0, 0x00000000u, { 0x40u } },
    { 247, -2, 0, 0x00000000u, { 0x40u } },
    { 248, -2, 0, 0x00000000u, { 0x40u } },
    { 249, 0, 0, 0x72282aadu, { 0x80u } },
    { 250, 0, 0, 0xf227612du, { 0x80u } },
    { 251, 0, 0, 0x6dbc9d0bu, { 0x80u } },
    { 252, 0, 0, 0xedbbd38bu, { 0x80u } },
    { 253, 0, 0, 0x4b2a4c63u, { 0x80u } },
    { 254, 0, 0, 0xcb2982e3u, { 0x80u } },
    { 255, 0, 0, 0xaf14ed94u, { 0x80u } },
    { 256, 0, 0, 0x2f142414u, { 0x80u } },
    { 257, 0, 0, 0xe25220bbu, { 0x80u } },
    { 258, 0, 0, 0x6252ea3bu, { 0x80u } },
    { 259, 0, 0, 0x45f6a788u, { 0x400u } },
    { 260, 0, 0, 0x66f2bedfu, { 0x400u } },
    { 261, 0, 0, 0x4efed8e5u, { 0x400u } },
    { 262, 0, 0, 0x778bb7c6u, { 0x400u } },
    { 263, 0, 0, 0x20f0410du, { 0x400u } },
    { 264, 0, 0, 0x7d84e86au, { 0x400u } },
    { 265, -5, 0, 0x00000000u, { 0x400u } },
    { 266, -5, 0, 0x00000000u, { 0x400u } },
    { 267, -5, 0, 0x00000000u, { 0x400u } },
    { 268, -5, 0, 0x00000000u, { 0x400u } },
    { 269, -5, 0, 0x00000000u, { 0x400u } },
    { 270, -5, 0, 0x00000000u, { 0x400u } },
    { 271, -5, 0, 0x00000000u, { 0x400u } },
    { 272, -5, 0, 0x00000000u, { 0x400u } },
    { 273, 0, 0, 0x8010280bu, { 0x400u } },
    { 274, 0, 0, 0x3d19090au, { 0x400u } },
    { 275, 0, 0, 0x8c9f1d9du, { 0x400u } },
    { 276, 0, 0, 0x2c5df8dcu, { 0x400u } },
    { 277, 0, 0, 0x20aa110eu, { 0x400u } },
    { 278, 0, 0, 0x5194e811u, { 0x400u } },
    { 279, 0, 0, 0x0be66f74u, { 0x400u } },
    { 280, 0, 0, 0xef360c97u, { 0x400u } },
    { 281, 0, 0, 0x37e41a43u, { 0x400u } },
    { 282, 0, 0, 0x651f6e64u, { 0x400u } },
    { 283, 65, 0, 0xb20e340au, { 0x2000u } },
    { 284, 75, 0, 0x5ce8ac77u, { 0x2000u } },
    { 285, 76, 0, 0x948aba76u, { 0x2000u } },
    { 286, 76, 0, 0x80778a52u, { 0x2000u } },
    { 287, 76, 0, 0xcbf8799du, { 0x2000u } },
    { 288, 64, 0, 0x072e5b27u, { 0x2000u } },
    { 289, 64, 0, 0x072e5b27u, { 0x2000u } },
    { 290, 64, 0, 0x072e5b27u, { 0x2000u } },
    { 291, 64, 0, 0x072e5b27u, { 0x2000u } },
    { 292, 64, 0, 0xaee971e2u, { 0x2000u } },
    { 293, 64, 0, 0xe9a05f3cu, { 0x2000u } },
    { 294, 64, 0, 0x9af6c73eu, { 0x2000u } },
    { 295, 64, 0, 0x072e5b27u, { 0x2000u } },
    { 296, 88, 1, 0x48faeb04u, { 0x2000u } },
    { 283, 64, 0, 0x78c9f6beu, { 0x4000u } },
    { 284, 64, 0, 0x965d6739u, { 0x4000u } },
    { 297, 64, 0, 0x78c9f6beu, { 0x4000u } },
    { 298, 64, 0, 0x78c9f6beu, { 0x4000u } },
    { 299, 64, 0, 0x78c9f6beu, { 0x4000u } },
    { 288, 64, 0, 0x78c9f6beu, { 0x4000u } },
    { 289, 64, 0, 0x78c9f6beu, { 0x4000u } },
    { 290, 64, 0, 0x78c9f6beu, { 0x4000u } },
    { 291, 64, 0, 0x78c9f6beu, { 0x4000u } },
    { 292, 64, 0, 0xae9c5eeau, { 0x4000u } },
    { 293, 64, 0, 0xfff9e69cu, { 0x4000u } },
    { 294, 64, 0, 0x48afc18eu, { 0x4000u } },
    { 295, 64, 0, 0x78c9f6beu, { 0x4000u } },
    { 296, -3, 1, 0x00000000u, { 0x4000u } },
    { 300, 0, 0, 0x1806aa63u, { 0x10000u } },
    { 301, 0, 0, 0xe17af342u, { 0x10000u } },
    { 300, 0, 0, 0xede7362eu, { 0x20000u } },
    { 301, -4, 0, 0x00000000u, { 0x20000u } },
    { 300, 0, 0, 0x66c76ea2u, { 0x40000u } },
    { 301, -4, 0, 0x00000000u, { 0x40000u } },
    { 245, 32, 0, 0x835547cdu, { 0x400000u } },
    { 246, -2, 0, 0x00000000u, { 0x400000u } },
    { 247, -2, 0, 0x00000000u, { 0x400000u } },
    { 248, -2, 0, 0x00000000u, { 0x400000u } },
    { 245, 32, 0, 0x56dd36d2u, { 0x800000u } },
    { 246, -2, 0, 0x00000000u, { 0x800000u } },
    { 247, -2, 0, 0x00000000u, { 0x800000u } },
    { 248, -2, 0, 0x00000000u, { 0x800000u } },
};

/* Makes all trials of one function, and leaves out each pointer in turn; returns how many are wrong. */
static uint32_t run_trials(int number)
{
    static remus6_table prepared;
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
                prepared = remus6_default;  /* prepare keeps what is not of the bodies */
                (void)remus6_prepare(&parameters, &prepared);
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
        if (status != (int)REMUS6_BAD_ARGUMENT || sum.touched != 0) {
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
    volatile remus6_real x = 0.7;
    const remus6_real whole = (x + 6755399441055744.0) - 6755399441055744.0;
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
    const remus6_real *numbers = f->numbers;
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
int remus6_selftest(void (*print)(const char *text), unsigned long sweep)
{
    int failures = 0;
    length = 0u;
    (void)remus6_prepare_mounts(&remus6_default_parameters, &mounting);
    if (EXCESS != 0 || rounds_to_integer() == 0) {
        add_text("wrong results: compiled with ");
        add_text(EXCESS != 0 ? "x87 arithmetic, without -msse2 -mfpmath=sse"
                             : "-ffast-math, -Ofast, -funsafe-math-optimizations or a part of them");
        end_line(print);
    }
    add_text("mahovik selftest remus6 structure 3687deee physics 5f25aea2 real double");
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

#ifdef REMUS6_SELFTEST_MAIN
static void print_text(const char *text)
{
    (void)fputs(text, stdout);
}

int main(void)
{
    return remus6_selftest(print_text, REMUS6_SELFTEST_SWEEP) != 0;
}
#endif
