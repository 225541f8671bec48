/* eye4_selftest.c: does eye4.c give the right bits on this machine?
 * With -ffast-math or its parts it gives wrong results with status OK: this test fails.
 * mahovik 0.1.0; structure 59c20951, physics 7b9ac829. Generated: change the stand file instead.
 *
 * Compile it with eye4.c as firmware is compiled (-std=c99 -ffp-contract=off; -fno-tree-vectorize as well by gcc
 * for x86-64 with FMA and for a Cortex-M55, or bits differ) and with
 * -DEYE4_SELFTEST_MAIN, and run it; on a board, without that macro, call eye4_selftest with a function that
 * prints a text, such as to a serial port.
 * Golden vectors: inputs and answers of the generator's interpreter as hexadecimal constants; each bit must agree.
 * Trials: the first of them with a few inputs changed: every status, wrong numbers, null pointers; known as well.
 * Sweep: states drawn by an integer generator; one hash per function of all its answers is printed, to be
 * compared between machines. The log of a board is judged by `mahovik judge-log STAND.toml --log LOG`. It reads:
 *
 *     wrong results: compiled with ...   only if that is so: first, and then functions FAIL
 *     mahovik selftest eye4 structure 59c20951 physics 7b9ac829 real double
 *     generator mahovik 0.1.0
 *     forward PASS cases 5 worst 0 ulp      one line per function; FAIL gives the number of wrong cases and
 *                                        what is wrong of them, such as "(status, numbers)"; with numbers worst is
 *                                        their largest distance, or "more than 1000000"
 *     sweep 100                          states
 *     forward 0123abcd                   one line per function: FNV-1a hash of its statuses and outputs
 *     failures 0                         functions that failed; the last line
 *
 * No allocation. It keeps inputs and results in static memory: one caller at a time. */
#include "../eye4.h"

#include <float.h>
#include <stddef.h>
#include <stdint.h>
#ifdef EYE4_SELFTEST_MAIN
#include <stdio.h>
#endif

#if EYE4_STRUCTURE != 0x59c20951u || EYE4_PHYSICS != 0x7b9ac829u
#error "eye4.h and eye4_selftest.c are of different stands"
#endif

#ifndef EYE4_SELFTEST_SWEEP
#define EYE4_SELFTEST_SWEEP 100ul  /* states of the sweep that main runs */
#endif

int eye4_selftest(void (*print)(const char *text), unsigned long sweep);

typedef uint64_t real_bits;

enum { CASES = 3, FUNCTIONS = 27, SWEPT = 4 };

#define FARTHEST ((real_bits)1000000u)  /* ulp: a worse distance is not printed as a number */

/* ---- inputs and results ---- */

/* Arguments of the functions, apart from the constants of the stand. */
typedef struct inputs {
    eye4_state x;
    eye4_real phi_ddot[EYE4_N];
    eye4_real wrench[6];
    eye4_real V_dot[6];
    eye4_real tau[EYE4_N];
    int locked[EYE4_N];
    eye4_real dt;
    int order;
    eye4_real phi;
    int count;
    int per_turn;
    eye4_real zero;
    int moved;
    eye4_encoder encoder;
    int counter;
    int bits;
    eye4_real demand[3];
    eye4_real angles[3];
    eye4_real position[3];
    eye4_real q_dot[6];
    eye4_real q_ddot[6];
    eye4_step_carry carry;
    eye4_real mass_factor;  /* multiplies all masses and inertias of the parameters */
} inputs;

static inputs in;
static eye4_parameters parameters;
static const eye4_table *table = &eye4_default;
static eye4_inverse_options options;
static int omitted;  /* the argument that is null, from 1; 0: none; -1: all that may be null */
static eye4_mount_table mounting;

static union {
    struct { eye4_real V_dot[6]; } forward;
    struct { eye4_matrices_result out; } matrices;
    struct { eye4_momentum_result out; } momentum;
    struct { eye4_real tau[EYE4_N]; } torque;
    struct { eye4_real V_dot[6]; eye4_real phi_ddot[EYE4_N]; } coupled;
    struct { eye4_state next; } step;
    struct { eye4_state next; } step_driven;
    struct { eye4_real wrapped; } wrap;
    struct { eye4_real phi; } phase_of_counts;
    struct { eye4_real phi_dot; } speed_of_counts;
    struct { eye4_encoder encoder; } accumulate;
    struct { eye4_forward_jacobian_result out; } forward_jacobian;
    struct { eye4_coupled_jacobian_result out; } coupled_jacobian;
    struct { eye4_inverse_result out; } inverse;
    struct { eye4_real phi_ddot[EYE4_N]; } inverse_fast;
    struct { eye4_inverse_pointing_result out; } inverse_pointing;
    struct { eye4_real phi_ddot[EYE4_N]; } inverse_fast_pointing;
    struct { eye4_torque_for_pointing_result out; } torque_for_pointing;
    struct { eye4_points_result out[EYE4_SENSORS]; } points;
    struct { eye4_real attitude[4]; } quaternion;
    struct { eye4_state x; eye4_real V_dot[6]; } state_from_coordinates;
    struct { eye4_generalized_result out; } generalized;
    struct { eye4_table table; } prepare;
    struct { eye4_real mount_wrench[24]; } mounts;
    struct { eye4_mount_table mounting; } prepare_mounts;
    struct { eye4_step_carry carry; eye4_state next; } step_carried;
    struct { eye4_step_carry carry; eye4_state next; } step_driven_carried;
    unsigned char bytes[1];
} results;

/* Numbers that no literal of C99 is. */
typedef union special { real_bits word; eye4_real real; } special;
static const special infinite = { 0x7ff0000000000000u };
static const special not_a_number = { 0x7ff8000000000000u };

enum { UNTOUCHED = 0x5a };  /* value of every byte of the results before a call */

/* ---- results: their hash, and their distance from the expected numbers ---- */

typedef struct tally {
    uint32_t hash;                /* FNV-1a of all bits so far, the lowest byte of a number first */
    const eye4_real *expected;  /* next expected numbers, `left` of them */
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

static real_bits bits_of(eye4_real value)
{
    union { eye4_real real; real_bits word; } both;
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

static void take_reals(tally *sum, const eye4_real *values, int count)
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

static void take_matrices_result(tally *sum, const eye4_matrices_result *value)
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
        take_reals(sum, value->I_[i], EYE4_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->J[i], EYE4_N);
    }
    take_reals(sum, value->F, 6);
}

static void take_momentum_result(tally *sum, const eye4_momentum_result *value)
{
    take_reals(sum, value->Z, 6);
    take_reals(sum, value->Z0, 6);
    take_reals(sum, &value->energy, 1);
    take_reals(sum, value->center_of_mass, 3);
    take_reals(sum, value->center_of_mass_velocity, 3);
}

static void take_state(tally *sum, const eye4_state *value)
{
    take_reals(sum, value->position, 3);
    take_reals(sum, value->attitude, 4);
    take_reals(sum, value->V, 6);
    take_reals(sum, value->phi, EYE4_N);
    take_reals(sum, value->phi_dot, EYE4_N);
}

static void take_encoder(tally *sum, const eye4_encoder *value)
{
    take_ints(sum, &value->counter, 1);
    take_ints(sum, &value->place, 1);
    take_ints(sum, &value->moved, 1);
}

static void take_forward_jacobian_result(tally *sum, const eye4_forward_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], EYE4_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], EYE4_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_ddot[i], EYE4_N);
    }
}

static void take_coupled_jacobian_result(tally *sum, const eye4_coupled_jacobian_result *value)
{
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_V[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi[i], EYE4_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_phi_dot[i], EYE4_N);
    }
    for (int i = 0; i < 6; ++i) {
        take_reals(sum, value->V_dot_tau[i], EYE4_N);
    }
    for (int i = 0; i < EYE4_N; ++i) {
        take_reals(sum, value->phi_ddot_V[i], 6);
    }
    for (int i = 0; i < EYE4_N; ++i) {
        take_reals(sum, value->phi_ddot_phi[i], EYE4_N);
    }
    for (int i = 0; i < EYE4_N; ++i) {
        take_reals(sum, value->phi_ddot_phi_dot[i], EYE4_N);
    }
    for (int i = 0; i < EYE4_N; ++i) {
        take_reals(sum, value->phi_ddot_tau[i], EYE4_N);
    }
}

static void take_inverse_result(tally *sum, const eye4_inverse_result *value)
{
    take_reals(sum, value->phi_ddot, EYE4_N);
    take_reals(sum, value->residual, 6);
    take_reals(sum, value->sigma, 4);
    take_ints(sum, &value->rank, 1);
    take_reals(sum, &value->damped_by, 1);
    take_ints(sum, value->limited, EYE4_N);
    take_reals(sum, value->hardest, 6);
}

static void take_inverse_pointing_result(tally *sum, const eye4_inverse_pointing_result *value)
{
    take_reals(sum, value->phi_ddot, EYE4_N);
    take_reals(sum, value->V_dot, 6);
    take_reals(sum, value->residual, 3);
    take_reals(sum, value->sigma, 3);
    take_ints(sum, &value->rank, 1);
    take_reals(sum, &value->damped_by, 1);
    take_ints(sum, value->limited, EYE4_N);
    take_reals(sum, value->hardest, 3);
}

static void take_torque_for_pointing_result(tally *sum, const eye4_torque_for_pointing_result *value)
{
    take_reals(sum, value->tau, EYE4_N);
    take_reals(sum, value->phi_ddot, EYE4_N);
    take_reals(sum, value->V_dot, 6);
    take_reals(sum, value->residual, 3);
    take_reals(sum, &value->share, 1);
    take_ints(sum, value->limited, EYE4_N);
}

static void take_points_result(tally *sum, const eye4_points_result *value)
{
    take_reals(sum, value->position, 3);
    for (int i = 0; i < 3; ++i) {
        take_reals(sum, value->C[i], 3);
    }
    take_reals(sum, value->twist, 6);
    take_reals(sum, value->specific_force, 3);
    take_reals(sum, value->angular_acceleration, 3);
}

static void take_generalized_result(tally *sum, const eye4_generalized_result *value)
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

static void take_row(tally *sum, const eye4_row *value)
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

static void take_sensor(tally *sum, const eye4_sensor *value)
{
    take_reals(sum, value->origin, 3);
    take_reals(sum, value->axes, 9);
}

static void take_table(tally *sum, const eye4_table *value)
{
    take_reals(sum, &value->mass, 1);
    take_reals(sum, &value->mass_inverse, 1);
    take_reals(sum, value->first_moment, 3);
    take_reals(sum, value->inertia, 6);
    for (int i = 0; i < EYE4_N; ++i) {
        take_row(sum, &value->flywheel[i]);
    }
    for (int i = 0; i < EYE4_SENSORS; ++i) {
        take_sensor(sum, &value->sensor[i]);
    }
}

static void take_mount(tally *sum, const eye4_mount *value)
{
    take_reals(sum, &value->mass, 1);
    take_reals(sum, value->first_moment, 3);
    take_reals(sum, value->inertia, 6);
    take_reals(sum, value->origin, 3);
    take_reals(sum, value->axes, 9);
}

static void take_mount_table(tally *sum, const eye4_mount_table *value)
{
    for (int i = 0; i < EYE4_N; ++i) {
        take_mount(sum, &value->flywheel[i]);
    }
}

static void take_step_carry(tally *sum, const eye4_step_carry *value)
{
    take_reals(sum, value->rounding, 21);
}

/* ---- every function is called with the inputs, and its results are hashed and compared ---- */

static eye4_status call_forward(void)
{
    return eye4_forward((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.phi_ddot, (omitted == 4) ? NULL : in.wrench, (omitted == 5) ? NULL : results.forward.V_dot);
}

static void take_forward_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.forward.V_dot, 6);
}

static eye4_status call_matrices(void)
{
    return eye4_matrices((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.wrench, (omitted == 4) ? NULL : &results.matrices.out);
}

static void take_matrices_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_matrices_result(sum, &results.matrices.out);
}

static eye4_status call_momentum(void)
{
    return eye4_momentum((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : &results.momentum.out);
}

static void take_momentum_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_momentum_result(sum, &results.momentum.out);
}

static eye4_status call_torque(void)
{
    return eye4_torque((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL : results.torque.tau);
}

static void take_torque_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.torque.tau, EYE4_N);
}

static eye4_status call_coupled(void)
{
    return eye4_coupled((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL : in.wrench, (omitted == 5) ? NULL
        : results.coupled.V_dot, (omitted == 6) ? NULL : results.coupled.phi_ddot);
}

static void take_coupled_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.coupled.V_dot, 6);
    take_reals(sum, results.coupled.phi_ddot, EYE4_N);
}

static eye4_status call_step(void)
{
    return eye4_step((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL : in.wrench, in.dt, in.order,
        (omitted == 5) ? NULL : &results.step.next);
}

static void take_step_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_state(sum, &results.step.next);
}

static eye4_status call_step_driven(void)
{
    return eye4_step_driven((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.phi_ddot, (omitted == 4) ? NULL : in.wrench, in.dt, in.order, (omitted == 5) ? NULL
        : &results.step_driven.next);
}

static void take_step_driven_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_state(sum, &results.step_driven.next);
}

static eye4_status call_wrap(void)
{
    return eye4_wrap(in.phi, (omitted == 1) ? NULL : &results.wrap.wrapped);
}

static void take_wrap_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.wrap.wrapped, 1);
}

static eye4_status call_phase_of_counts(void)
{
    return eye4_phase_of_counts(in.count, in.per_turn, in.zero, (omitted == 1) ? NULL
        : &results.phase_of_counts.phi);
}

static void take_phase_of_counts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.phase_of_counts.phi, 1);
}

static eye4_status call_speed_of_counts(void)
{
    return eye4_speed_of_counts(in.moved, in.per_turn, in.dt, (omitted == 1) ? NULL
        : &results.speed_of_counts.phi_dot);
}

static void take_speed_of_counts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, &results.speed_of_counts.phi_dot, 1);
}

static eye4_status call_accumulate(void)
{
    results.accumulate.encoder = in.encoder;
    return eye4_accumulate((omitted == 1) ? NULL : &results.accumulate.encoder, in.counter, in.bits,
        in.per_turn);
}

static void take_accumulate_results(tally *sum, int refused)
{
    (void)refused;
    take_encoder(sum, &results.accumulate.encoder);
}

static eye4_status call_forward_jacobian(void)
{
    return eye4_forward_jacobian((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.phi_ddot, (omitted == 4) ? NULL : in.wrench, (omitted == 5) ? NULL
        : &results.forward_jacobian.out);
}

static void take_forward_jacobian_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_forward_jacobian_result(sum, &results.forward_jacobian.out);
}

static eye4_status call_coupled_jacobian(void)
{
    return eye4_coupled_jacobian((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL : in.wrench, (omitted == 5)
        ? NULL : &results.coupled_jacobian.out);
}

static void take_coupled_jacobian_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_coupled_jacobian_result(sum, &results.coupled_jacobian.out);
}

static eye4_status call_inverse(void)
{
    return eye4_inverse((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL : in.wrench, (omitted == 6) ? NULL
        : &results.inverse.out);
}

static void take_inverse_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_inverse_result(sum, &results.inverse.out);
}

static eye4_status call_inverse_fast(void)
{
    return eye4_inverse_fast((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.V_dot, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL : in.wrench, (omitted == 6)
        ? NULL : results.inverse_fast.phi_ddot);
}

static void take_inverse_fast_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.inverse_fast.phi_ddot, EYE4_N);
}

static eye4_status call_inverse_pointing(void)
{
    return eye4_inverse_pointing((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.demand, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL : in.wrench,
        (omitted == 6) ? NULL : &results.inverse_pointing.out);
}

static void take_inverse_pointing_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_inverse_pointing_result(sum, &results.inverse_pointing.out);
}

static eye4_status call_inverse_fast_pointing(void)
{
    return eye4_inverse_fast_pointing((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
        (omitted == 3) ? NULL : in.demand, (omitted == 4) ? NULL : &options, (omitted == 5) ? NULL
        : in.wrench, (omitted == 6) ? NULL : results.inverse_fast_pointing.phi_ddot);
}

static void take_inverse_fast_pointing_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.inverse_fast_pointing.phi_ddot, EYE4_N);
}

static eye4_status call_torque_for_pointing(void)
{
    return eye4_torque_for_pointing((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
        (omitted == 3) ? NULL : in.demand, (omitted == 4) ? NULL : &options, (omitted < 0) ? NULL : in.locked,
        (omitted == 5) ? NULL : in.wrench, (omitted == 6) ? NULL : &results.torque_for_pointing.out);
}

static void take_torque_for_pointing_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_torque_for_pointing_result(sum, &results.torque_for_pointing.out);
}

static eye4_status call_points(void)
{
    return eye4_points((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : results.points.out);
}

static void take_points_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    for (int i = 0; i < EYE4_SENSORS; ++i) {
        take_points_result(sum, &results.points.out[i]);
    }
}

static eye4_status call_quaternion(void)
{
    return eye4_quaternion((omitted == 1) ? NULL : in.angles, (omitted == 2) ? NULL
        : results.quaternion.attitude);
}

static void take_quaternion_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.quaternion.attitude, 4);
}

static eye4_status call_state_from_coordinates(void)
{
    results.state_from_coordinates.x = in.x;
    return eye4_state_from_coordinates((omitted == 1) ? NULL : in.position, (omitted == 2) ? NULL : in.angles,
        (omitted == 3) ? NULL : in.q_dot, (omitted == 4) ? NULL : in.q_ddot, (omitted == 5) ? NULL
        : &results.state_from_coordinates.x, (omitted == 6) ? NULL : results.state_from_coordinates.V_dot);
}

static void take_state_from_coordinates_results(tally *sum, int refused)
{
    take_state(sum, &results.state_from_coordinates.x);
    if (refused != 0) { return; }
    take_reals(sum, results.state_from_coordinates.V_dot, 6);
}

static eye4_status call_generalized(void)
{
    return eye4_generalized((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.angles, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL : in.wrench,
        (omitted == 6) ? NULL : &results.generalized.out);
}

static void take_generalized_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_generalized_result(sum, &results.generalized.out);
}

static eye4_status call_prepare(void)
{
    results.prepare.table = eye4_default;
    return eye4_prepare((omitted == 1) ? NULL : &parameters, (omitted == 2) ? NULL : &results.prepare.table);
}

static void take_prepare_results(tally *sum, int refused)
{
    (void)refused;
    take_table(sum, &results.prepare.table);
}

static eye4_status call_mounts(void)
{
    return eye4_mounts((omitted == 1) ? NULL : &mounting, (omitted == 2) ? NULL : &in.x, (omitted == 3) ? NULL
        : in.V_dot, (omitted == 4) ? NULL : in.phi_ddot, (omitted == 5) ? NULL : results.mounts.mount_wrench);
}

static void take_mounts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_reals(sum, results.mounts.mount_wrench, 24);
}

static eye4_status call_prepare_mounts(void)
{
    return eye4_prepare_mounts((omitted == 1) ? NULL : &parameters, (omitted == 2) ? NULL
        : &results.prepare_mounts.mounting);
}

static void take_prepare_mounts_results(tally *sum, int refused)
{
    if (refused != 0) { return; }
    take_mount_table(sum, &results.prepare_mounts.mounting);
}

static eye4_status call_step_carried(void)
{
    results.step_carried.carry = in.carry;
    return eye4_step_carried((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x, (omitted == 3)
        ? NULL : in.tau, (omitted < 0) ? NULL : in.locked, (omitted == 4) ? NULL : in.wrench, in.dt, in.order,
        (omitted == 5) ? NULL : &results.step_carried.carry, (omitted == 6) ? NULL
        : &results.step_carried.next);
}

static void take_step_carried_results(tally *sum, int refused)
{
    take_step_carry(sum, &results.step_carried.carry);
    if (refused != 0) { return; }
    take_state(sum, &results.step_carried.next);
}

static eye4_status call_step_driven_carried(void)
{
    results.step_driven_carried.carry = in.carry;
    return eye4_step_driven_carried((omitted == 1) ? NULL : table, (omitted == 2) ? NULL : &in.x,
        (omitted == 3) ? NULL : in.phi_ddot, (omitted == 4) ? NULL : in.wrench, in.dt, in.order,
        (omitted == 5) ? NULL : &results.step_driven_carried.carry, (omitted == 6) ? NULL
        : &results.step_driven_carried.next);
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
            .phi = { -0x1.95dd5cp+3, 0x1.e462ap+3, -0x1.23a78p+1, -0x1.c68578p+2 },
            .phi_dot = { -0x1.cf9e4p+7, -0x1.e0f5dp+6, -0x1.c61c58p+7, -0x1.3c48p+4 },
        },
        .phi_ddot = { -0x1.c4d59p+8, 0x1.d79d24p+8, 0x1.3513p+4, 0x1.29b748p+7 },
        .wrench = { -0x1.94148p-2, -0x1.f4583p+2, 0x1.9e47c8p+1, -0x1.39c4f8p+2, 0x1.44d50cp+2,
            -0x1.7d815p+1 },
        .V_dot = { 0x1.e558ecp+3, 0x1.edaa68p+3, 0x1.656c1p+2, 0x1.e86b8p-2, 0x1.eac5dp+2, 0x1.a2918cp+3 },
        .tau = { 0x1.f50954p+0, -0x1.bac6b8p-1, -0x1.8dc0ep+0, -0x1.538698p-1 },
        .locked = { 0, 0, 1, 0 },
        .dt = 0x1p-14,
        .order = 4,
        .phi = -0x1.23054p-1,
        .count = -491914,
        .per_turn = 4061,
        .zero = 0x1.af406cp-1,
        .moved = 422,
        .encoder = {
            .counter = -22053,
            .place = 916,
            .moved = 206,
        },
        .counter = -29187,
        .bits = 16,
        .demand = { -0x1.b60768p+2, 0x1.06bc6cp+3, -0x1.3b164p-1 },
        .angles = { 0x1.c0aac8p-1, -0x1.51bd7p-3, -0x1.ace304p-1 },
        .position = { 0x1.76eb1p-2, -0x1.5944dp-2, 0x1.f3e8ep-2 },
        .q_dot = { 0x1.35894p-2, 0x1.d3fc6p-1, -0x1.23b5c4p+0, 0x1.cf1ac8p-1, 0x1.30188p-3, 0x1.942a08p-1 },
        .q_ddot = { -0x1.92f53p+2, 0x1.c0d28p+2, 0x1.9f33ep+2, 0x1.c06e04p+3, 0x1.6815p-1, -0x1.7e8e7p+1 },
        .carry = {
            .rounding = { 0x1.bc58ep-25, -0x1.58a2bp-25, 0x1.554cc8p-26, 0x1.55fcep-26, -0x1.9f3ap-31,
                0x1.9b4488p-26, 0x1.0a9aap-28, -0x1.9c2068p-26, -0x1.9ed4ep-28, -0x1.085ab8p-26,
                0x1.968a6p-26, 0x1.cdc694p-25, -0x1.0249c8p-25, -0x1.371e7p-26, -0x1.214c38p-25,
                0x1.4171bp-27, 0x1.82ebap-27, 0x1.0b38ap-26, -0x1.055d68p-25, -0x1.8f2aap-27,
                -0x1.763e6p-28 },
        },
        .mass_factor = 0x1.c40ca4p-1,
    },
    {   /* fast flywheels, large phases */
        .x = {
            .position = { -0x1.f8caa4p+0, 0x1.3b88ccp+0, 0x1.8fd1ep-2 },
            .attitude = { -0x1.cb9f2198a357p-1, 0x1.e2841fd736912p-3, -0x1.e2841fd736912p-3,
                -0x1.273942a3ad2dp-2 },
            .V = { -0x1.b2c408p+2, -0x1.0c99cp+1, -0x1.5e586p+2, 0x1.d5b01p+1, -0x1.6b39ap+2, 0x1.499108p+2 },
            .phi = { -0x1.859fdp+22, 0x1.fdeeap+22, 0x1.1fb6fp+22, -0x1.2794p+15 },
            .phi_dot = { 0x1.33ded8p+13, -0x1.4256p+6, -0x1.923cb8p+13, -0x1.67826p+13 },
        },
        .phi_ddot = { 0x1.512658p+7, -0x1.3b3c18p+7, 0x1.8eec5p+7, -0x1.bb3d38p+8 },
        .wrench = { 0x1.a3f8a8p+2, 0x1.882d1p+0, 0x1.4d94ap+0, -0x1.c47ac4p+2, 0x1.1746e8p+2, 0x1.037d6p+1 },
        .V_dot = { 0x1.a1c0ecp+5, -0x1.cf6e3p+5, 0x1.56ea88p+5, 0x1.f688fp+4, -0x1.0f622p+5, 0x1.a26cfp+4 },
        .tau = { 0x1.df44a8p+0, 0x1.670cp-5, -0x1.23708p-4, 0x1.598328p-1 },
        .locked = { 0, 1, 1, 0 },
        .dt = 0x1p-14,
        .order = 2,
        .phi = -0x1.bdbb3p+22,
        .count = -852592,
        .per_turn = 4025,
        .zero = -0x1.ed3ccp-2,
        .moved = -140,
        .encoder = {
            .counter = 31860,
            .place = 1497,
            .moved = -62,
        },
        .counter = -7948,
        .bits = 16,
        .demand = { -0x1.52138p-2, 0x1.26f56p+3, -0x1.28b67p+3 },
        .angles = { -0x1.7a5978p-2, 0x1.8ab58p-3, 0x1.b0decp-5 },
        .position = { 0x1.7660dcp+0, 0x1.a35e68p-1, -0x1.16ceep-3 },
        .q_dot = { 0x1.63ddcp-3, 0x1.e05b2p-3, -0x1.68bbep-1, -0x1.cbd33cp+0, -0x1.c483b8p+0, -0x1.ed35p-5 },
        .q_ddot = { -0x1.bdd86p+3, 0x1.f8f3ep+1, -0x1.ca174p+0, 0x1.bc5528p+2, 0x1.67f6p-1, 0x1.7f7ed8p+2 },
        .carry = {
            .rounding = { 0x1.1db6ap-25, -0x1.046708p-25, 0x1.7c0718p-25, -0x1.8e30bp-25, 0x1.c57048p-26,
                -0x1.b7cac8p-26, -0x1.74596p-25, 0x1.a5f084p-25, 0x1.107154p-25, 0x1.9703bp-27,
                -0x1.0a47f8p-26, -0x1.3b6cap-27, -0x1.997158p-25, 0x1.caa508p-25, 0x1.64ac8p-29,
                0x1.49a318p-26, 0x1.c85dp-28, 0x1.c55c48p-26, 0x1.ebfa1p-25, -0x1.afa2dp-27,
                -0x1.3dbc3cp-25 },
        },
        .mass_factor = 0x1.1e6041p+0,
    },
    {   /* out of range */
        .x = {
            .position = { 0x1.efbb3cp+40, -0x1.fcd4p+38, -0x1.05219cp+40 },
            .attitude = { -0x1.ff3e78e9ad8ecp+0, -0x1.36735e7995b3ep-4, -0x1.224aa17ba9e76p-6,
                -0x1.36735e7995b3ep-4 },
            .V = { -0x1.0b842cp+0, 0x1.7eee2p-2, -0x1.093c78p+0, -0x1.8ed23cp+0, -0x1.027accp+0,
                0x1.313078p+0 },
            .phi = { 0x1.f09e08p+42, -0x1.f2802p+43, -0x1.31426p+40, 0x1.947958p+42 },
            .phi_dot = { 0x1.5360e8p+6, -0x1.bc3c4p+7, 0x1.4b5d2p+7, -0x1.e1ea1p+6 },
        },
        .phi_ddot = { 0x1.43f77p+6, -0x1.7eaadp+8, 0x1.9d9098p+7, 0x1.2190ap+8 },
        .wrench = { 0x1.881898p+2, 0x1.f82364p+2, -0x1.f67078p+1, 0x1.ef22p+0, 0x1.9d4d4p-2, -0x1.125cp+2 },
        .V_dot = { -0x1.02414p+0, 0x1.bf9368p+3, 0x1.82c238p+3, 0x1.7c810cp+3, -0x1.0c3e8p+3,
            -0x1.482048p+3 },
        .tau = { 0x1.504548p+0, -0x1.247d8cp+0, 0x1.c8244p-3, 0x1.a2090cp+0 },
        .locked = { 0, 0, 0, 1 },
        .dt = 0x0p+0,
        .order = 4,
        .phi = -0x1.e7c7ep+40,
        .count = -975144,
        .per_turn = 0,
        .zero = -0x1.67b038p+38,
        .moved = 12,
        .encoder = {
            .counter = 17327,
            .place = 3502,
            .moved = 444,
        },
        .counter = 6205,
        .bits = 16,
        .demand = { -0x1.9c3facp+3, -0x1.6771dp+2, -0x1.b1380cp+3 },
        .angles = { 0x1.77166p+38, -0x1.92b278p+39, 0x1.74d58p+37 },
        .position = { 0x1.ae2418p+39, 0x1.29377p+38, -0x1.8574p+37 },
        .q_dot = { -0x1.e60618p+0, 0x1.bd62p+0, -0x1.a79a1cp+0, -0x1.88b3dcp+0, 0x1.866584p+0,
            -0x1.ec054p-4 },
        .q_ddot = { -0x1.74a658p+3, -0x1.8b2564p+3, 0x1.c553b4p+3, 0x1.ce86e8p+3, -0x1.2c24fp+2,
            0x1.c63afp+3 },
        .carry = {
            .rounding = { 0x1.9ff9b8p-25, -0x1.12f4p-27, 0x1.69a1c8p-26, -0x1.62c19p-27, 0x1.852fp-26,
                0x1.8344dp-27, -0x1.7420b4p-25, 0x1.2adb4p-25, -0x1.e9f6ccp-25, 0x1.2b6874p-25,
                0x1.2b38a8p-26, 0x1.f96c5p-26, 0x1.0100d8p-25, -0x1.a83864p-25, -0x1.d00b7p-25,
                -0x1.f6d9a8p-26, 0x1.41229cp-25, -0x1.6e7b7p-26, -0x1.8f755p-26, 0x1.f1e5fp-25,
                0x1.661b5p-26 },
        },
        .mass_factor = -0x1.1cc741p+0,
    },
};

typedef struct answer {
    int status;
    uint32_t hash;  /* hash of the status and all outputs */
    int listed;     /* outputs whose numbers are given, at most 32 */
} answer;

static const eye4_real numbers_forward[] =
{
    0x1.003af17245732p+0, 0x1.480253271f788p-2, -0x1.50c5cea963e11p+1, -0x1.c009b8304f5b2p-2,
        0x1.28af0154edb3bp-3, -0x1.45ea62e816ce9p-1,
    -0x1.7ef3de22414cap+5, 0x1.206548a27cca9p+4, 0x1.675a5d7b153e7p+5, 0x1.4a36cd18f8d11p+2,
        -0x1.cee7e410eca74p+3, -0x1.7229e7ecc7055p+5,
};

static const eye4_real numbers_matrices[] =
{
    0x1.4000000000001p+6, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.f7ce5cc9c09a9p-2, 0x1.3c35996d76b5cp-2, 0x0p+0,
        0x1.4000000000001p+6, 0x0p+0, -0x1.f7ce5cc9c09a9p-2, 0x0p+0, 0x1.8b4393b9046c1p-2, 0x0p+0, 0x0p+0,
        0x1.4000000000001p+6, -0x1.3c35996d76b5cp-2, -0x1.8b4393b9046c1p-2, 0x0p+0, 0x0p+0,
        -0x1.f7ce5cc9c09a9p-2, -0x1.3c35996d76b5cp-2, 0x1.a5b8fcdc9468ep+2, 0x1.f82ee5cdc7246p-5,
        -0x1.6754b83b4da16p-5, 0x1.f7ce5cc9c09a9p-2, 0x0p+0, -0x1.8b4393b9046c1p-2, 0x1.f82ee5cdc7246p-5,
        0x1.9ae34b622f19ap+2, 0x1.b2e853d9555c4p-5, 0x1.3c35996d76b5cp-2, 0x1.8b4393b9046c1p-2,
    0x1.4000000000001p+6, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.f7ce6ed63c917p-2, 0x1.3c3526f7e4c5dp-2, 0x0p+0,
        0x1.4000000000001p+6, 0x0p+0, -0x1.f7ce6ed63c917p-2, 0x0p+0, 0x1.8b42e6a9ea32ep-2, 0x0p+0, 0x0p+0,
        0x1.4000000000001p+6, -0x1.3c3526f7e4c5dp-2, -0x1.8b42e6a9ea32ep-2, 0x0p+0, 0x0p+0,
        -0x1.f7ce6ed63c917p-2, -0x1.3c3526f7e4c5dp-2, 0x1.a5b923efa9928p+2, 0x1.f8302bd50e3f5p-5,
        -0x1.675ad08b2d66bp-5, 0x1.f7ce6ed63c917p-2, 0x0p+0, -0x1.8b42e6a9ea32ep-2, 0x1.f8302bd50e3f5p-5,
        0x1.9ae328a05d922p+2, 0x1.b2f45cccbfb14p-5, 0x1.3c3526f7e4c5dp-2, 0x1.8b42e6a9ea32ep-2,
};

static const eye4_real numbers_momentum[] =
{
    0x1.00a52a72674bfp+7, 0x1.2e9151dc9b65fp+7, 0x1.1f540030bbc44p+6, 0x1.77cee31714507p+3,
        0x1.25f10826da8cfp+2, 0x1.214a729c868eap+2, 0x1.2785e6b1186c1p+5, -0x1.490c228c8f5e4p+4,
        0x1.9d67851af5e3dp+7, 0x1.3273f85b1ef41p+8, 0x1.212eadabe900ap+7, -0x1.c2882bf2106d2p+4,
        0x1.84f9c5c3f70abp+8, 0x1.3c360fc736bccp-8, -0x1.f9ef5be257891p-9, 0x1.930b7d6e33aecp-8,
        0x1.d8d63de827135p-2, -0x1.073ce87072b1cp-2, 0x1.4ab93748c4b63p+1,
    -0x1.1055e90f86259p+9, -0x1.4f4db09a58d92p+7, -0x1.b4d4d7ad238f6p+8, 0x1.25b35b5082847p+5,
        -0x1.728ab3f4c10afp+2, 0x1.d1e7770fa0953p+2, -0x1.9db391e9812acp+8, -0x1.256114b0fd52ep+9,
        0x1.963070eb905ap+3, 0x1.150227051981ap+8, -0x1.e6c130c072e48p+6, 0x1.9d6db5400b1adp+10,
        0x1.362b8600d4098p+18, 0x1.3c358554bb5bdp-8, -0x1.f9eea4bfd46f9p-9, 0x1.930b8bde96daap-8,
        -0x1.4af60e5467554p+2, -0x1.d568211b2eeaep+2, 0x1.44f38d894046p-3,
};

static const eye4_real numbers_torque[] =
{
    -0x1.6702100612cb3p-1, 0x1.89cf7b2c9a103p-1, 0x1.21292a4867d27p-5, 0x1.f0611354f617p-3,
    0x1.28e82d52e45bep-2, -0x1.26017cfe20afdp-2, 0x1.604369f9419eap-2, -0x1.3e1c3d49faad5p-1,
};

static const eye4_real numbers_coupled[] =
{
    0x1.008729c21fbf5p+0, 0x1.463811ea2b7f8p-2, -0x1.5108db46128abp+1, -0x1.7915a35ec31d2p-1,
        -0x1.029af94879738p-5, -0x1.4ebcb1e34c26fp-1, 0x1.33a563c5f7747p+10, -0x1.0fb51077f4815p+9, 0x0p+0,
        -0x1.9fe5dcd3d1c0ap+8,
    -0x1.7ef0037324a6p+5, 0x1.2065b5d853a5dp+4, 0x1.675781bdf1ae9p+5, 0x1.388e0f3ca15dp+2,
        -0x1.d1161c5f940e9p+3, -0x1.752369524b805p+5, 0x1.2e30b54ce1a66p+10, 0x0p+0, 0x0p+0,
        0x1.b7c00f45f471ep+8,
};

static const eye4_real numbers_step[] =
{
    -0x1.779a17a14aa81p-1, 0x1.80b85a98dbadep+0, -0x1.10f6836285bcdp-4, 0x1.23d5bc1a0a23dp-1,
        -0x1.2f86cb520a4d4p-5, -0x1.fa5f05452b2bap-2, -0x1.4f6e309048c84p-1, 0x1.98d1b6254cfa2p+0,
        0x1.e6288e0a5f243p+0, 0x1.d1143782bb7c8p-1, 0x1.f3ecc1ce9295fp+0, 0x1.462f2f60220afp-1,
        0x1.aacd5d0ac7284p-1, -0x1.0c625f49e7ee3p-3, 0x1.481b27894c227p+1, -0x1.256d9c58p+1,
        -0x1.a3cc53dc472e4p-1, -0x1.cf77cb538b2e5p+7, -0x1.e117c6a285618p+6, -0x1.c61c58p+7,
        -0x1.3caff976c3878p+4,
    -0x1.f8df4a99c2b87p+0, 0x1.3b6b71d7c72f2p+0, 0x1.8fd41ecfda573p-2, -0x1.cba1ff6a160b3p-1,
        0x1.e221d33675935p-3, -0x1.e256ee50a5affp-3, -0x1.276202a9fe673p-2, -0x1.b2f3db80a40fdp+2,
        -0x1.0c719bd820ff7p+1, -0x1.5e292e536418bp+2, 0x1.d5bcc0dff8614p+1, -0x1.6b47968a76edp+2,
        0x1.496452f2c87c4p+2, -0x1.ca9b6f3171388p-3, 0x1.9ff73922f528dp+0, -0x1.28fa31c44739cp-1,
        0x1.51e37656995ebp+1, 0x1.33df6ed286cafp+13, -0x1.4256p+6, -0x1.923cb8p+13, -0x1.6782293c6cba3p+13,
};

static const eye4_real numbers_step_driven[] =
{
    -0x1.779a17a147b52p-1, 0x1.80b85a98e0c2cp+0, -0x1.10f68362584dp-4, 0x1.23d5bc1aeaa05p-1,
        -0x1.2f86cb2e8635cp-5, -0x1.fa5f0546aee15p-2, -0x1.4f6e308f13497p-1, 0x1.98d1b4f342966p+0,
        0x1.e6288fd6ad3e7p+0, 0x1.d1143baf163acp-1, 0x1.f3edf3efbf664p+0, 0x1.463098b8469f6p-1,
        0x1.aacd8058bf9b3p-1, -0x1.0c640424af9eep-3, 0x1.481b37656949fp+1, -0x1.256d9c0abb4p+1,
        -0x1.a3cc30902f33ep-1, -0x1.cfac66ac8p+7, -0x1.e0d8562dcp+6, -0x1.c61bbd768p+7, -0x1.3c22c917p+4,
    -0x1.f8df4a99c48d1p+0, 0x1.3b6b71d7c70f1p+0, 0x1.8fd41ecfec18ap-2, -0x1.cba1ff699e944p-1,
        0x1.e221d32c5bcd7p-3, -0x1.e256ee57f3f34p-3, -0x1.276202ae099e4p-2, -0x1.b2f3dbfcbb4efp+2,
        -0x1.0c719be495784p+1, -0x1.5e292df6108f5p+2, 0x1.d5bd4dd90830bp+1, -0x1.6b4785218b6ebp+2,
        0x1.4964b1ef285f2p+2, -0x1.ca9c733d5b858p-3, 0x1.9ff7343604c8dp+0, -0x1.28fa254ce4b9cp-1,
        0x1.51e3688aa441ap+1, 0x1.33deed12658p+13, -0x1.425fd9e0cp+6, -0x1.923c9f113bp+13,
        -0x1.67829767a7p+13,
};

static const eye4_real numbers_wrap[] =
{
    -0x1.23054p-1,
    -0x1.ae9b7301586a4p+0,
};

static const eye4_real numbers_phase_of_counts[] =
{
    -0x1.a6e4700d9d7f2p-1,
    0x1.1b20b9f533f4fp+0,
};

static const eye4_real numbers_speed_of_counts[] =
{
    0x1.4e4b6759567fep+13,
    -0x1.bf94d2a9791eap+11,
};

static const eye4_real numbers_accumulate[] =
{
    0.0
};

static const eye4_real numbers_forward_jacobian[] =
{
    -0x1.bc35a97d5e732p-58, 0x1.aad298p-1, -0x1.462f7p-1, -0x1.ce250e5cccf98p-12, -0x1.ca5c7f3d1f0e8p-1,
        0x1.e6174f333ad21p+0, -0x1.aad298p-1, -0x1.f660e425e74c3p-57, 0x1.f3efb4p+0, 0x1.c7efc068f9654p-1,
        -0x1.aed72ff22bb07p-7, -0x1.9b22913253f03p+0, 0x1.462f7p-1, -0x1.f3efb4p+0, -0x1.7b7a7d7e63739p-58,
        -0x1.e1751a112f6cap+0, 0x1.9bf22e3461bdbp+0, -0x1.29f97b3e9309bp-7, 0x1.f1e4ecb35ca39p-57,
        -0x1.0d3e0b1a7f596p-50, 0x1.d1e0f99e861bap-51, 0x1.e054b9c9c2ebcp-7, 0x1.3a88a3664753ap-2,
        0x1.85bd439afd1ap-3, -0x1.da71f635f0981p-52, 0x1.17d1932e23f52p-55, -0x1.ed921cb17eff8p-50,
        -0x1.6b948bc0236acp-2, 0x1.148d7332f9692p-8, -0x1.2ff70a7385786p-1, 0x1.3f41d0d38fb03p-49,
        0x1.d6423413f0053p-50,
    0x1.ad08f9866e5eep-56, 0x1.499108p+2, 0x1.6b399ffffffffp+2, -0x1.ec1ff6ca51288p-9, 0x1.5b288f45ce1e5p+2,
        -0x1.06f38c5707f8fp+1, -0x1.499108p+2, 0x1.3c0e66c41490ap-56, 0x1.d5b01p+1, -0x1.5c27f3fe7c617p+2,
        -0x1.3a0f41c69bdebp-5, 0x1.b3cafee17621p+2, -0x1.6b399ffffffffp+2, -0x1.d5b01p+1,
        0x1.54bdcf256a295p-57, 0x1.0cccee973f5c3p+1, -0x1.b520fc1edb5ccp+2, -0x1.413f07141b1adp-5,
        0x1.14ccc7f9ff1dep-53, 0x1.7768626f6ada4p-50, -0x1.a5465e92a3b91p-51, 0x1.3a3a0d3e5f8b4p-7,
        0x1.c24a202a2c45fp+1, 0x1.b17f51274c18ap+1, -0x1.aba6279ad1644p-49, 0x1.4c997e17b8d34p-54,
        0x1.681da3eba651cp-49, -0x1.d65d510869eb5p+1, -0x1.d440a301ce1bbp-5, -0x1.50435b478f52bp+1,
        -0x1.75fedc04d01e2p-50, -0x1.108091fe735a2p-49,
};

static const eye4_real numbers_coupled_jacobian[] =
{
    -0x1.bbad4300f912p-58, 0x1.aad298p-1, -0x1.462f6ffffffffp-1, -0x1.cd648359d9a61p-12,
        -0x1.ca5c851eee851p-1, 0x1.e617641b53983p+0, -0x1.aad297ffffffep-1, -0x1.ff3b9854de7f4p-57,
        0x1.f3efb3fffffffp+0, 0x1.c7efcddb4bd3bp-1, -0x1.aed5e43101e1dp-7, -0x1.9b228301cd71cp+0,
        0x1.462f7p-1, -0x1.f3efb40000003p+0, -0x1.7fba1be3b8398p-58, -0x1.e1751f4c2e364p+0,
        0x1.9bf23239f869cp+0, -0x1.29fd374040971p-7, 0x1.dc5ab97c834dap-55, -0x1.16fafbb9e2326p-50,
        0x1.c3acd9c3d65cep-51, 0x1.e16ddf140bebep-7, 0x1.3a9e397f71cb8p-2, 0x1.85ee9307b8242p-3,
        -0x1.dac15c0ae363cp-52, 0x1.1c4dafb864482p-55, -0x1.eb54085853a28p-50, -0x1.6bac4c6a9ca97p-2,
        0x1.136ed3a23db64p-8, -0x1.300cde06570fap-1, 0x1.3f0c959a973e5p-49, 0x1.d82e8db5300ffp-50,
    0x1.b2fe015a7b793p-56, 0x1.499107fffffffp+2, 0x1.6b39ap+2, -0x1.ead52bab434b8p-9, 0x1.5b287aa1c56acp+2,
        -0x1.06f38ee04fb69p+1, -0x1.499108p+2, 0x1.3381de6a17068p-56, 0x1.d5b01p+1, -0x1.5c27f0f27c22cp+2,
        -0x1.3a1096473e694p-5, 0x1.b3cafd22845e2p+2, -0x1.6b39ap+2, -0x1.d5b0100000001p+1,
        0x1.548a9d5eabf4cp-57, 0x1.0cccb1eca241ep+1, -0x1.b520edc294c3ep+2, -0x1.413f21117d24cp-5,
        0x1.eac6acdd5eadfp-55, 0x1.6df18203ddc8cp-50, -0x1.93a307d3990c9p-51, 0x1.151122c695ab8p-7,
        0x1.c268831215c4fp+1, 0x1.b191a033a0839p+1, -0x1.b5a36980a9cbbp-49, 0x1.991660284fca4p-59,
        0x1.646cd05896489p-49, -0x1.d6705201cf8c6p+1, -0x1.d4825e77d4514p-5, -0x1.505205f572c51p+1,
        -0x1.6e4676c4252eap-50, -0x1.08b105c83238p-49,
};

static const eye4_real numbers_inverse[] =
{
    -0x1.b09c6301d1632p+25, 0x1.afffd2b1133adp+25, -0x1.b077e4268c627p+25, 0x1.b0320dbbae058p+25,
        -0x1.39c1e8cc292aep+10, -0x1.21e6ca2453958p+10, -0x1.ea2e651c585b2p+8, 0x1.24102aca83p+3,
        -0x1.62c32bda62p+2, -0x1.4e7895ae8fp+3, 0x1.5d589f69e5ec1p-6, 0x1.2a6619b9b9642p-6,
        0x1.25aebcbf1b675p-6, 0x1.56d69492302a4p-18, 0x0p+0, -0x1.9423a71fe10adp+2, -0x1.75694cc4b7c64p+2,
        -0x1.3bb12b998c00ep+1, 0x1.783215b6d77aep-5, -0x1.c8f4c8b6c4ed2p-6, -0x1.aed1d4b9c04cbp-5,
    0x1.18dc6272b906cp+28, -0x1.190064302a0e1p+28, 0x1.18e7a39e8266bp+28, -0x1.193deffe34a54p+28,
        -0x1.f8072f2f6dad1p+12, 0x1.72fdd340824f8p+12, -0x1.0f9fb094f3718p+9, -0x1.14426fb17ap+5,
        -0x1.7f0d8cc5dcp+5, -0x1.5b7911024p+1, 0x1.5d5743c65f95fp-6, 0x1.2a5ed80e0ed86p-6,
        0x1.25b5bcfdf392ep-6, 0x1.cbc7958da4cd3p-19, 0x0p+0, -0x1.cc5665f4832c4p+2, 0x1.52d53a12b8bd5p+2,
        -0x1.f02847f7a1981p-2, -0x1.f8a0087ad1279p-6, -0x1.5dd94c8328834p-5, -0x1.3d5a5d4925f14p-9,
};

static const eye4_real numbers_inverse_fast[] =
{
    -0x1.b09c62fe81255p+25, 0x1.afffd2adc343cp+25, -0x1.b077e4233bf82p+25, 0x1.b0320db85e045p+25,
    0x1.18dc6277cdc96p+28, -0x1.190064353ef2fp+28, 0x1.18e7a3a3974p+28, -0x1.193df00349f52p+28,
};

static const eye4_real numbers_inverse_pointing[] =
{
    -0x1.7a7554a26e7bbp+11, -0x1.8ba012826c6c2p+14, 0x1.5168b18848f82p+11, 0x1.867b71c3e2e0dp+14,
        0x1.e684ee94bef83p-1, 0x1.1eb2f2e2974fbp-2, -0x1.4ef435d141f32p+1, -0x1.b60767ffffffcp+2,
        0x1.06bc6bffffffep+3, -0x1.3b16400000031p-1, -0x1p-48, 0x1p-48, 0x1.88p-48, 0x1.5d589f1243feap-6,
        0x1.2a6617a568e75p-6, 0x1.25aebc48c566dp-6, 0x0p+0, 0x1.7b4039daeab6fp-2, 0x1.e8641de2557c4p-4,
        -0x1.47a9c124f13adp-8,
    -0x1.360ba8e978589p+16, -0x1.827fa82c8bf2ap+16, -0x1.e5e4fbe1a88aap+13, 0x1.f7d8bbbb90cbcp+11,
        -0x1.81492243ea0fdp+5, 0x1.1d01ec8a8f706p+4, 0x1.6817091ef5d42p+5, -0x1.52138000000eap-2,
        0x1.26f55ffffffe5p+3, -0x1.28b66fffffff5p+3, 0x1.d4p-47, 0x1.bp-45, -0x1.6p-46, 0x1.5d57428cd831p-6,
        0x1.2a5ed6ff21d99p-6, 0x1.25b5bc1c98bf3p-6, 0x0p+0, 0x1.7c765d19de5a7p-2, 0x1.d917640fcd34ap-4,
        -0x1.3e91f124b3d3p-8,
};

static const eye4_real numbers_inverse_fast_pointing[] =
{
    -0x1.7a7554a26e7c1p+11, -0x1.8ba012826c6c4p+14, 0x1.5168b18848f83p+11, 0x1.867b71c3e2e0dp+14,
    -0x1.360ba8e97858bp+16, -0x1.827fa82c8bf28p+16, -0x1.e5e4fbe1a88a8p+13, 0x1.f7d8bbbb90cbp+11,
};

static const eye4_real numbers_torque_for_pointing[] =
{
    -0x1.027be5a8f688bp-4, -0x1.4b37365d190fdp-4, 0x0p+0, 0x1.999999999999ap-4, -0x1.38967459bf2e7p+5,
        -0x1.96faf46b64151p+5, 0x0p+0, 0x1.fc9bdff1b39f9p+5, 0x1.002fc80b707a7p+0, 0x1.470a7059ca0ccp-2,
        -0x1.50d546196f0a1p+1, -0x1.1e13b546b384p-1, 0x1.2b930a427e761p-3, -0x1.30f89179d18f2p-1,
        -0x1.9244f157298f8p+2, 0x1.020e1fd6f6062p+3, -0x1.43b5d0c5ce1cp-6, 0x1p+0,
    -0x1.999999999999ap-4, 0x0p+0, 0x0p+0, -0x0p+0, -0x1.ecc9ca96e037ep+4, 0x0p+0, 0x0p+0,
        0x1.ef0bc7942bf09p+3, -0x1.7ef412c1e6196p+5, 0x1.20651892992e1p+4, 0x1.675a7ac1af0b6p+5,
        0x1.477b6d2973fc6p+2, -0x1.cd80b0645758dp+3, -0x1.72833c5c7c4bdp+5, -0x1.5c9ca52973fc6p+2,
        0x1.7a3b08322bac6p+4, 0x1.2855a05c7c4bdp+5, 0x1p+0,
};

static const eye4_real numbers_points[] =
{
    -0x1.cc015f811ceeap-1, 0x1.b9443c0b2a10fp+0, 0x1.888b7dd92254p-4, -0x1.63e0ba9aa6dfcp-2,
        0x1.912b11fecedaep-1, -0x1.07b720737a69bp-1, -0x1.6b9cae0a9fcf9p-1, 0x1.1c1c20f7c4e6cp-3,
        0x1.61642a45c6e9dp-1, 0x1.397a31b09f257p-1, 0x1.361a10e978325p-1, 0x1.04378628d168dp-1,
        0x1.ccfe40ccccccdp+0, 0x1.462c7f0a3d70ap+0, 0x1.d12948p-1, 0x1.f3efb4p+0, 0x1.462f7p-1, 0x1.aad298p-1,
        0x1.1233ac88f223dp+4, 0x1.e00b4201531c4p+3, 0x1.bb3e72c478914p+2, 0x1.e86b8p-2, 0x1.eac5dp+2,
        0x1.a2918cp+3, -0x1.ede0abb3a7b85p-1, 0x1.8dbc3cf4d160cp+0, 0x1.c350acb7edbd8p-3,
        0x1.09a170e92b16cp-4, 0x1.912b11fecedaep-1, -0x1.3c6504db5ed6p-1, -0x1.f9b2d13e0e67ep-1,
        0x1.1c1c20f7c4e6cp-3,
    -0x1.e144a6a7c212ep+0, 0x1.6950cb2c591bap+0, 0x1.475f1b094f399p-1, 0x1.720b62258df39p-1,
        -0x1.41dcf3a695c47p-1, 0x1.260adecf0613ep-2, 0x1.a05c74475ab0bp-2, 0x1.720b62258df39p-1,
        0x1.1e21fad52cec8p-1, -0x1.1e21fad52cec8p-1, -0x1.260adecf0613ep-2, 0x1.8e51467d1793fp-1,
        -0x1.137fb73333333p+3, -0x1.a2e691eb851ecp+1, -0x1.5e586p+2, 0x1.d5b01p+1, -0x1.6b39ap+2,
        0x1.499108p+2, 0x1.6523196f225ecp+6, -0x1.70e7821e4727p+6, -0x1.2017494c3a7aep+4, 0x1.f688fp+4,
        -0x1.0f622p+5, 0x1.a26cfp+4, -0x1.ba0892bbb3c5p+0, 0x1.7d5aa8a90553ap+0, 0x1.0074b97bbfcp-1,
        0x1.79ef254b83364p-2, -0x1.41dcf3a695c47p-1, 0x1.5e7c1b88d0a18p-1, -0x1.8726ed3285bbp-5,
        0x1.720b62258df39p-1,
};

static const eye4_real numbers_quaternion[] =
{
    0x1.ad65b9889a8cbp-1, -0x1.5725881b3a05ap-2, -0x1.ebb8014e041e8p-3, 0x1.6c7cd171978c1p-2,
    0x1.f489f378ce6bap-1, 0x1.6479ae5eeb3b6p-5, 0x1.6f79165d3f988p-4, -0x1.7b711f85ee4d9p-3,
};

static const eye4_real numbers_state_from_coordinates[] =
{
    0x1.76eb1p-2, -0x1.5944dp-2, 0x1.f3e8ep-2, 0x1.ad65b9889a8cbp-1, -0x1.5725881b3a05ap-2,
        -0x1.ebb8014e041e8p-3, 0x1.6c7cd171978c1p-2, 0x1.64a41a3fcc782p-1, 0x1.2e39513e53218p+0,
        -0x1.2d518f4712672p-1, 0x1.e030a6c596c5ap-1, -0x1.20952436fb634p-1, 0x1.6a32157d48aa3p-1,
        -0x1.95dd5cp+3, 0x1.e462ap+3, -0x1.23a78p+1, -0x1.c68578p+2, -0x1.cf9e4p+7, -0x1.e0f5dp+6,
        -0x1.c61c58p+7, -0x1.3c48p+4, 0x1.7459f789fd48ep+1, 0x1.369ac0875a8fbp-1, 0x1.320813dc276eap+3,
        -0x1.a430385fa44fap-1, -0x1.284b969fff679p+3, 0x1.477301be91286p+3,
    0x1.7660dcp+0, 0x1.a35e68p-1, -0x1.16ceep-3, 0x1.f489f378ce6bap-1, 0x1.6479ae5eeb3b6p-5,
        0x1.6f79165d3f988p-4, -0x1.7b711f85ee4d9p-3, 0x1.afd2b63460a2ep-3, 0x1.f673c886c67b8p-3,
        -0x1.619958835bd77p-1, 0x1.22a52c174518ep-2, -0x1.dbb82b121fd64p+0, -0x1.aac8192b521efp+0,
        -0x1.859fdp+22, 0x1.fdeeap+22, 0x1.1fb6fp+22, -0x1.2794p+15, 0x1.33ded8p+13, -0x1.4256p+6,
        -0x1.923cb8p+13, -0x1.67826p+13, -0x1.effe111f6426cp+3, -0x1.6f1dac32dd0b3p+0, -0x1.39b08eb429fa4p+2,
        0x1.8bcd2994b3d28p+0, 0x1.2155c2652bfeap+0, 0x1.831817e3a4fb5p+2,
    0x1.efbb3cp+40, -0x1.fcd4p+38, -0x1.05219cp+40, -0x1.ff3e78e9ad8ecp+0, -0x1.36735e7995b3ep-4,
        -0x1.224aa17ba9e76p-6, -0x1.36735e7995b3ep-4, -0x1.0b842cp+0, 0x1.7eee2p-2, -0x1.093c78p+0,
        -0x1.8ed23cp+0, -0x1.027accp+0, 0x1.313078p+0, 0x1.f09e08p+42, -0x1.f2802p+43, -0x1.31426p+40,
        0x1.947958p+42, 0x1.5360e8p+6, -0x1.bc3c4p+7, 0x1.4b5d2p+7, -0x1.e1ea1p+6,
};

static const eye4_real numbers_generalized[] =
{
    0x1.433b7e4e27a9dp-1, 0x1.8412744a0fc8fp-1, 0x1.503611b411b96p-3, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.be9718313d664p-2, 0x1.0b45cdd3f47b7p-1, -0x1.774c4bf3a5b7dp-1, 0x0p+0, 0x0p+0, 0x0p+0,
        -0x1.4855daa649af7p-1, 0x1.908be743cf6d1p-2, 0x1.51fae45d6853p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, 0x1.503611b411b98p-3, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.774c4bf3a5b7dp-1,
        0x1.56a0e9632375bp-1, 0x0p+0, 0x0p+0, 0x0p+0,
    0x1.d49b8c0d337acp-1, -0x1.6af3e8c6ead27p-2, -0x1.88451d2854491p-3, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.7af18133f9313p-2, 0x1.dae91b03fb39cp-1, 0x1.a8a86dd00239dp-5, 0x0p+0, 0x0p+0, 0x0p+0,
        0x1.463967d01d1eep-3, -0x1.e4a989cf6c1ccp-4, 0x1.f5d1abbb9bab8p-1, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0,
        0x0p+0, 0x0p+0, -0x1.88451d285449p-3, 0x0p+0, 0x1p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1.a8a86dd002399p-5,
        0x1.ff490ec3933dap-1, 0x0p+0, 0x0p+0, 0x0p+0,
};

static const eye4_real numbers_prepare[] =
{
    0x1.1a87e67ffffffp+6, 0x1.cfebc6c470839p-7, 0x1.5cfb6c2d0e56p-2, -0x1.172f89bda511ap-2,
        0x1.bcd10bdf3b646p-2, 0x1.7457d3c58068p+2, 0x1.6ac6bab3ad1f2p+2, 0x1.0816d0466b5a6p+2,
        0x1.bd22843ac929bp-5, -0x1.3d3aec7e7c06fp-5, 0x1.7ff96f7fcfc4p-5, -0x1.4f2ca2f700b6p-20,
        0x1.4f2ca2f700b6p-20, 0x0p+0, -0x1.8306a8f96ef38p-21, -0x1.8306a8f96ef38p-21, 0x1.8306a8f96ef38p-20,
        0x1.174fdd232b426p-22, -0x1.00f78e01a2adap-22, -0x1.6584f218894bp-26, 0x1.6584f218894bp-27,
        -0x1.174fdd232b425p-23, 0x1.00f78e01a2adbp-23, -0x1.e3c85337cab06p-22, -0x1.bd1475853f98p-22,
        -0x1.359eed9458c2dp-22, 0x1.359eed9458c2dp-23, -0x1.e3c85337cab06p-23, -0x1.bd1475853f98p-23,
        -0x1.59a18468f77fep-20, -0x1.59a18468f77fep-20, 0x1.59a18468f78p-19,
    0x1.65f8514000002p+6, 0x1.6e27523f59799p-7, 0x1.ba2a1eba5e354p-2, -0x1.61bb4bc84b5ddp-2,
        0x1.19cb42020c49dp-1, 0x1.d7c35d4ed594dp+2, 0x1.cba453f9e1e97p+2, 0x1.4e9aa4cd38369p+2,
        0x1.19fedea2b9d3dp-4, -0x1.91ef36f0307f3p-5, 0x1.e68007a99fa12p-5, -0x1.a8ab80f8909bap-20,
        0x1.a8ab80f8909bap-20, 0x0p+0, -0x1.ea5dd9cb63877p-21, -0x1.ea5dd9cb63877p-21, 0x1.ea5dd9cb63877p-20,
        0x1.61e440cf232c6p-22, -0x1.45948d8b5dccap-22, -0x1.c4fb343c55fcp-26, 0x1.c4fb343c55fbp-27,
        -0x1.61e440cf232c6p-23, 0x1.45948d8b5dccap-23, -0x1.327aa81f1e34bp-21, -0x1.19f5f6d4f2d45p-21,
        -0x1.884b14a2b606p-22, 0x1.884b14a2b606p-23, -0x1.327aa81f1e34bp-22, -0x1.19f5f6d4f2d45p-22,
        -0x1.b5eb24c8366a9p-20, -0x1.b5eb24c8366a9p-20, 0x1.b5eb24c8366aap-19,
    0x1.4000000000001p+6, 0x1.9999999999998p-7, 0x1.8b4395810624ep-2, -0x1.3c36113404ea5p-2,
        0x1.f7ced916872b3p-2, 0x1.a5b91b9506e2dp+2, 0x1.9ae3361ac4269p+2, 0x1.2b1ccdec06a3fp+2,
        0x1.f82b1f687b13ap-5, -0x1.674d1633482bfp-5, 0x1.b2e59af9ebe9ep-5, -0x1.7ba004188699p-20,
        0x1.7ba004188699p-20, 0x0p+0, -0x1.b65a6f833b148p-21, -0x1.b65a6f833b148p-21, 0x1.b65a6f833b148p-20,
        0x1.3c5aae14702a2p-22, -0x1.230bbedf9a644p-22, -0x1.94eef34d5c5fp-26, 0x1.94eef34d5c5fp-27,
        -0x1.3c5aae14702a2p-23, 0x1.230bbedf9a643p-23, -0x1.11f885b204ecep-21, -0x1.f81b337083f13p-22,
        -0x1.5eaebf9c2f43ap-22, 0x1.5eaebf9c2f43ap-23, -0x1.11f885b204ecep-22, -0x1.f81b337083f13p-23,
        -0x1.8777e75094fa8p-20, -0x1.8777e75094fa8p-20, 0x1.8777e75094fabp-19,
};

static const eye4_real numbers_mounts[] =
{
    0x1.d2d23f160ea56p+3, 0x1.e298923a25119p+0, -0x1.a3920fe0a33d3p+1, -0x1.6702100612cb2p-1,
        0x1.24ec7c332a5d7p-3, -0x1.595d8205341e5p-2, 0x1.0b6eb12d08ed2p+2, -0x1.8fc88c858fb7bp+3,
        0x1.48a17e3cd4876p+2, 0x1.89cf7b2c9a102p-1, -0x1.e9e4bb9a0477p-3, -0x1.6227c317d1708p-2,
        -0x1.f3e78faa34ea1p+2, 0x1.ce2ce062baa2p-3, 0x1.aa032d7bdaedcp+3, 0x1.21292a4867d3dp-5,
        -0x1.465face9f7545p-1, 0x1.685e984519ccap-2, 0x1.194e52ee2c411p+1, 0x1.edb3406ff70a2p+3,
        0x1.53272a860d9ap+2, 0x1.f0611354f6172p-3, 0x1.12bbf80bd5a2p-10, 0x1.165803ba23132p-4,
    0x1.0b74fe621e4bcp+3, -0x1.a12896d71d31ap+7, 0x1.1c859b1dfbb4fp+7, 0x1.28e82d52e45cap-2,
        0x1.43ea5f6d0f836p+6, 0x1.98f1a9d22ae03p+6, -0x1.15f5dbc813bb4p+6, -0x1.932ddf285181cp+3,
        0x1.6e7fd449560a4p+5, -0x1.26017cfe20b3ap-2, -0x1.0bcc3d00ee284p+0, 0x1.cba9c6f87f86cp-3,
        -0x1.2b1405b5dde0ep+4, 0x1.6d60d47a86014p+8, 0x1.705a43872e134p+7, 0x1.604369f941a44p-2,
        -0x1.0547fe851beep+6, 0x1.0dccd672e935dp+7, 0x1.071686b1516b9p+6, 0x1.9f2e1d883271p+7,
        -0x1.be6d4cfb65c02p+7, -0x1.3e1c3d49faad5p-1, -0x1.bd0c61e11bbfbp+2, -0x1.d62989626b8bep+4,
};

static const eye4_real numbers_prepare_mounts[] =
{
    0x1.3c6f3f9999999p-1, 0x0p+0, 0x1.da0214ad362e8p-20, 0x0p+0, 0x1.7059fdf15a4adp-10, 0x1.953062383bdbap-11,
        0x1.993d46c576c22p-11, -0x1.a249f8fd67a17p-80, -0x1.7b34dd575e8bap-26, 0x0p+0, 0x1.999999999999ap-4,
        0x1.999999999999ap-4, -0x1.999999999999ap-4, 0x1.279a74590331dp-1, -0x1.6a09e667f3bccp-1,
        -0x1.a20bd700c2c3ep-2, 0x1.279a74590331dp-1, 0x1.6a09e667f3bccp-1, -0x1.a20bd700c2c3ep-2,
        0x1.279a74590331dp-1, 0x0p+0, 0x1.a20bd700c2c3ep-1, 0x1.3c6f3f9999999p-1, 0x0p+0,
        -0x1.443d9b9d89395p-21, 0x1.bd6c0443c3502p-20, 0x1.7059fdf15a4adp-10, 0x1.953062383bdbap-11,
        0x1.993d46c576c22p-11, -0x1.36a0b64c51ee7p-26, 0x1.b302010db3a13p-27, 0x0p+0,
    0x1.90ed27cccccccp-1, 0x0p+0, 0x1.2c49784ec636bp-19, 0x0p+0, 0x1.d2b4afdb6e504p-10, 0x1.00b08d9cff54bp-10,
        0x1.03416e542ba65p-10, -0x1.08fd12673b202p-79, -0x1.e0758d4ad6bdep-26, 0x0p+0, 0x1.999999999999ap-4,
        0x1.999999999999ap-4, -0x1.999999999999ap-4, 0x1.279a74590331dp-1, -0x1.6a09e667f3bccp-1,
        -0x1.a20bd700c2c3ep-2, 0x1.279a74590331dp-1, 0x1.6a09e667f3bccp-1, -0x1.a20bd700c2c3ep-2,
        0x1.279a74590331dp-1, 0x0p+0, 0x1.a20bd700c2c3ep-1, 0x1.90ed27cccccccp-1, 0x0p+0,
        -0x1.9ad119d0e4816p-21, 0x1.1a2d6eb4eb35dp-19, 0x1.d2b4afdb6e504p-10, 0x1.00b08d9cff54bp-10,
        0x1.03416e542ba65p-10, -0x1.8991b233a3489p-26, 0x1.13947f5cf27c1p-26, 0x0p+0,
};

static const eye4_real numbers_step_carried[] =
{
    0x1.e7dp-56, -0x1.54b2p-54, 0x1.3p-60, 0x1.e7acfdp-56, -0x1.41c75b6p-59, -0x1.ec9f1p-60, -0x1.c1d72fp-55,
        -0x1.61ap-55, 0x1.b7e8p-54, -0x1.34p-55, -0x1.3f2p-55, 0x1.2607p-55, -0x1.08p-58, 0x1.cp-57,
        0x1.28p-53, 0x0p+0, 0x1.acp-55, -0x1.47p-47, -0x1.76p-49, -0x1p-46, 0x1.38p-53, -0x1.779a15e4f1c81p-1,
        0x1.80b859ec8a55ep+0, -0x1.10f67e0d529cdp-4, 0x1.23d5bcd3bf502p-1, -0x1.2f86cbc926713p-5,
        -0x1.fa5f03c36e691p-2, -0x1.4f6e307fdee16p-1, 0x1.98d1b5be44e02p+0, 0x1.e6288df071d63p+0,
        0x1.d11436fe8e208p-1, 0x1.f3ecc234352dfp+0,
    0x1.24cp-54, -0x1.66cp-54, 0x1.7dp-56, 0x1.7632d8p-55, -0x1.6f73dp-58, 0x1.d028a8p-57, 0x1.801ed4p-56,
        0x1.e68p-52, -0x1.d9p-54, -0x1.4p-52, 0x1.98p-54, 0x1.62p-56, -0x1.06p-54, 0x0p+0, 0x0p+0, 0x1p-55,
        0x1.a62633145c07p-56, 0x1.6c04p-41, 0x0p+0, -0x1.68p-42, -0x1.e65b8p-41, -0x1.f8df4a0ae7687p+0,
        0x1.3b6b715593ab2p+0, 0x1.8fd421c7e8873p-2, -0x1.cba1fef88b983p-1, 0x1.e221d4a88e4dcp-3,
        -0x1.e256efa7384a8p-3, -0x1.27620449d406ep-2, -0x1.b2f3db4be5ff5p+2, -0x1.0c719b9404aa7p+1,
        -0x1.5e292e46abfb3p+2, 0x1.d5bcc0beaf624p+1,
    0x1.9ff9b8p-25, -0x1.12f4p-27, 0x1.69a1c8p-26, -0x1.62c19p-27, 0x1.852fp-26, 0x1.8344dp-27,
        -0x1.7420b4p-25, 0x1.2adb4p-25, -0x1.e9f6ccp-25, 0x1.2b6874p-25, 0x1.2b38a8p-26, 0x1.f96c5p-26,
        0x1.0100d8p-25, -0x1.a83864p-25, -0x1.d00b7p-25, -0x1.f6d9a8p-26, 0x1.41229cp-25, -0x1.6e7b7p-26,
        -0x1.8f755p-26, 0x1.f1e5fp-25, 0x1.661b5p-26,
};

static const eye4_real numbers_step_driven_carried[] =
{
    -0x1.158p-57, 0x1.32ap-55, 0x1.c2p-58, -0x1.911523ep-55, -0x1.64b5198p-61, 0x1.36cc09p-58, 0x1.65def9p-56,
        0x1.6e8p-54, 0x1.60c8p-54, -0x1.62p-55, -0x1.4368p-54, -0x1.f9p-58, -0x1.60ap-56, -0x1p-56, 0x0p+0,
        0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1p-46, 0x0p+0, -0x1.779a15e4eed52p-1, 0x1.80b859ec8f6acp+0,
        -0x1.10f67e0d252dp-4, 0x1.23d5bcd49fccbp-1, -0x1.2f86cba5a259bp-5, -0x1.fa5f03c4f21edp-2,
        -0x1.4f6e307ea9629p-1, 0x1.98d1b48c3a7c6p+0, 0x1.e6288fbcbff07p+0, 0x1.d1143b2ae8decp-1,
        0x1.f3edf45561fe4p+0,
    -0x1.18p-54, 0x1.7cp-57, 0x1.6p-60, 0x1.6cfc3p-57, 0x1.082eap-58, 0x1.42d82p-58, -0x1.2322p-59,
        0x1.93p-52, 0x1.338p-53, -0x1.b1p-52, 0x1.1p-53, 0x1.d9ap-52, 0x1.88p-52, 0x0p+0, 0x0p+0, 0x1p-55,
        -0x1.cb3b399d747f2p-53, -0x1.dcp-41, 0x0p+0, -0x1.68p-42, -0x1.ep-44, -0x1.f8df4a0ae93d1p+0,
        0x1.3b6b7155938b1p+0, 0x1.8fd421c7fa48ap-2, -0x1.cba1fef814214p-1, 0x1.e221d49e7488p-3,
        -0x1.e256efae868ddp-3, -0x1.2762044ddf3dfp-2, -0x1.b2f3dbc7fd3e7p+2, -0x1.0c719ba079234p+1,
        -0x1.5e292de95871dp+2, 0x1.d5bd4db7bf31bp+1,
    0x1.9ff9b8p-25, -0x1.12f4p-27, 0x1.69a1c8p-26, -0x1.62c19p-27, 0x1.852fp-26, 0x1.8344dp-27,
        -0x1.7420b4p-25, 0x1.2adb4p-25, -0x1.e9f6ccp-25, 0x1.2b6874p-25, 0x1.2b38a8p-26, 0x1.f96c5p-26,
        0x1.0100d8p-25, -0x1.a83864p-25, -0x1.d00b7p-25, -0x1.f6d9a8p-26, 0x1.41229cp-25, -0x1.6e7b7p-26,
        -0x1.8f755p-26, 0x1.f1e5fp-25, 0x1.661b5p-26,
};

typedef struct function {
    const char *name;
    int pointers;  /* arguments that must not be null */
    size_t size;  /* bytes of its results */
    size_t kept;  /* bytes of those that are also inputs: the first ones, the only ones that a refused call may have */
    eye4_status (*call)(void);
    void (*take)(tally *sum, int refused);
    const eye4_real *numbers;
    answer answers[CASES];
    uint32_t swept;  /* hash of the first SWEPT states of a sweep */
} function;

static const function functions[FUNCTIONS] =
{
    { "forward", 5, sizeof results.forward, 0u,
      call_forward, take_forward_results, numbers_forward,
      { { 0, 0xd637289bu, 6 }, { 0, 0xf3cfefc0u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x5ecd1418u },
    { "matrices", 4, sizeof results.matrices, 0u,
      call_matrices, take_matrices_results, numbers_matrices,
      { { 0, 0xfc29a080u, 32 }, { 0, 0x7e19f6a0u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xfa7e33eeu },
    { "momentum", 3, sizeof results.momentum, 0u,
      call_momentum, take_momentum_results, numbers_momentum,
      { { 0, 0x547379d5u, 19 }, { 0, 0x4cee37d2u, 19 }, { -2, 0x8e5b0aa0u, 0 } },
      0x19b3df6du },
    { "torque", 5, sizeof results.torque, 0u,
      call_torque, take_torque_results, numbers_torque,
      { { 0, 0xbbfa64dfu, 4 }, { 0, 0x7bb50a99u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0x4d46fd3du },
    { "coupled", 6, sizeof results.coupled, 0u,
      call_coupled, take_coupled_results, numbers_coupled,
      { { 0, 0x3ed72d98u, 10 }, { 0, 0x5978550bu, 10 }, { -2, 0x8e5b0aa0u, 0 } },
      0x12e52f28u },
    { "step", 5, sizeof results.step, 0u,
      call_step, take_step_results, numbers_step,
      { { 0, 0x09e6b617u, 21 }, { 32, 0x430d3ca2u, 21 }, { -2, 0x8e5b0aa0u, 0 } },
      0xd8c5c45cu },
    { "step_driven", 5, sizeof results.step_driven, 0u,
      call_step_driven, take_step_driven_results, numbers_step_driven,
      { { 0, 0xd000651du, 21 }, { 32, 0xe5f2e05cu, 21 }, { -2, 0x8e5b0aa0u, 0 } },
      0xe3053367u },
    { "wrap", 1, sizeof results.wrap, 0u,
      call_wrap, take_wrap_results, numbers_wrap,
      { { 0, 0x51af2eaau, 1 }, { 0, 0x368177bdu, 1 }, { -2, 0x8e5b0aa0u, 0 } },
      0x8c8de70bu },
    { "phase_of_counts", 1, sizeof results.phase_of_counts, 0u,
      call_phase_of_counts, take_phase_of_counts_results, numbers_phase_of_counts,
      { { 0, 0x0b1392edu, 1 }, { 0, 0x705907a4u, 1 }, { -5, 0x2107376du, 0 } },
      0xa1a9abb4u },
    { "speed_of_counts", 1, sizeof results.speed_of_counts, 0u,
      call_speed_of_counts, take_speed_of_counts_results, numbers_speed_of_counts,
      { { 0, 0xfff00da6u, 1 }, { 0, 0x46441124u, 1 }, { -5, 0x2107376du, 0 } },
      0x398bee12u },
    { "accumulate", 1, sizeof results.accumulate, sizeof results.accumulate.encoder,
      call_accumulate, take_accumulate_results, numbers_accumulate,
      { { 0, 0x29b175bcu, 0 }, { 0, 0xc515186cu, 0 }, { -5, 0xea238159u, 0 } },
      0x36b359d4u },
    { "forward_jacobian", 5, sizeof results.forward_jacobian, 0u,
      call_forward_jacobian, take_forward_jacobian_results, numbers_forward_jacobian,
      { { 0, 0xe28bafadu, 32 }, { 0, 0x7bc197f6u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x6385b6e2u },
    { "coupled_jacobian", 5, sizeof results.coupled_jacobian, 0u,
      call_coupled_jacobian, take_coupled_jacobian_results, numbers_coupled_jacobian,
      { { 0, 0x7dbd80d4u, 32 }, { 0, 0xf80d6e18u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x91da2c97u },
    { "inverse", 6, sizeof results.inverse, 0u,
      call_inverse, take_inverse_results, numbers_inverse,
      { { 72, 0xe5a1cfb4u, 21 }, { 72, 0xefca2204u, 21 }, { -2, 0x8e5b0aa0u, 0 } },
      0x52e39b32u },
    { "inverse_fast", 6, sizeof results.inverse_fast, 0u,
      call_inverse_fast, take_inverse_fast_results, numbers_inverse_fast,
      { { 64, 0xe537b84cu, 4 }, { 64, 0x8a677bf3u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0x348c9eabu },
    { "inverse_pointing", 6, sizeof results.inverse_pointing, 0u,
      call_inverse_pointing, take_inverse_pointing_results, numbers_inverse_pointing,
      { { 64, 0x573ce38fu, 20 }, { 64, 0x9b596688u, 20 }, { -2, 0x8e5b0aa0u, 0 } },
      0xf2ff6559u },
    { "inverse_fast_pointing", 6, sizeof results.inverse_fast_pointing, 0u,
      call_inverse_fast_pointing, take_inverse_fast_pointing_results, numbers_inverse_fast_pointing,
      { { 64, 0x486d7f4cu, 4 }, { 64, 0x61f8649du, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0xca657c79u },
    { "torque_for_pointing", 6, sizeof results.torque_for_pointing, 0u,
      call_torque_for_pointing, take_torque_for_pointing_results, numbers_torque_for_pointing,
      { { 12, 0xab92c901u, 18 }, { 12, 0x3afe9cf7u, 18 }, { -2, 0x8e5b0aa0u, 0 } },
      0x9afab5e0u },
    { "points", 4, sizeof results.points, 0u,
      call_points, take_points_results, numbers_points,
      { { 0, 0x1c1b2f6bu, 32 }, { 0, 0xa1ca769du, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x38987390u },
    { "quaternion", 2, sizeof results.quaternion, 0u,
      call_quaternion, take_quaternion_results, numbers_quaternion,
      { { 0, 0xc4b31f96u, 4 }, { 0, 0x8793f69au, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0x0feaab39u },
    { "state_from_coordinates", 6, sizeof results.state_from_coordinates, sizeof results.state_from_coordinates.x,
      call_state_from_coordinates, take_state_from_coordinates_results, numbers_state_from_coordinates,
      { { 0, 0x15ec35ffu, 27 }, { 0, 0xdea526d3u, 27 }, { -2, 0x924274d2u, 21 } },
      0x64e68f06u },
    { "generalized", 6, sizeof results.generalized, 0u,
      call_generalized, take_generalized_results, numbers_generalized,
      { { 0, 0xf18eb099u, 32 }, { 0, 0x6b4e6090u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x21db4663u },
    { "prepare", 2, sizeof results.prepare, sizeof results.prepare.table,
      call_prepare, take_prepare_results, numbers_prepare,
      { { 0, 0x776d2a86u, 32 }, { 0, 0x64f62edeu, 32 }, { -2, 0x0a5a2a2eu, 32 } },
      0x7b4a00a5u },
    { "mounts", 5, sizeof results.mounts, 0u,
      call_mounts, take_mounts_results, numbers_mounts,
      { { 0, 0x9be6e0b0u, 24 }, { 0, 0x862764a3u, 24 }, { -2, 0x8e5b0aa0u, 0 } },
      0xe47f1315u },
    { "prepare_mounts", 2, sizeof results.prepare_mounts, 0u,
      call_prepare_mounts, take_prepare_mounts_results, numbers_prepare_mounts,
      { { 0, 0xc979471fu, 32 }, { 0, 0x865faf92u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xeee22cb8u },
    { "step_carried", 6, sizeof results.step_carried, sizeof results.step_carried.carry,
      call_step_carried, take_step_carried_results, numbers_step_carried,
      { { 0, 0xe63f10ecu, 32 }, { 32, 0x5e5dd470u, 32 }, { -2, 0x3b24efdeu, 21 } },
      0xa9849d3eu },
    { "step_driven_carried", 6, sizeof results.step_driven_carried, sizeof results.step_driven_carried.carry,
      call_step_driven_carried, take_step_driven_carried_results, numbers_step_driven_carried,
      { { 0, 0xc97575cfu, 32 }, { 32, 0x89a5b0b3u, 32 }, { -2, 0x3b24efdeu, 21 } },
      0x5b8093c9u },
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
static eye4_real draw_real(uint32_t *seed, eye4_real largest)
{
    const int32_t part = (int32_t)(draw_word(seed) >> 8) - 8388608;
    return largest * ((eye4_real)part / 8388608.0);
}

static void draw_reals(uint32_t *seed, eye4_real *values, int count, eye4_real largest)
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
static void draw_attitude(uint32_t *seed, eye4_real attitude[4], int refused)
{
    const uint32_t word = draw_word(seed);
    const int32_t a = 2 * (int32_t)(word >> 25) - 127;  /* odd, so that not all are 0 */
    const int32_t b = (int32_t)((word >> 16) & 0xffu) - 128;
    const int32_t c = (int32_t)((word >> 8) & 0xffu) - 128;
    const int32_t d = (int32_t)(word & 0xffu) - 128;
    const eye4_real norm = (eye4_real)(a * a + b * b + c * c + d * d);
    const eye4_real factor = refused != 0 ? 2.0 : 1.0;
    attitude[0] = factor * ((eye4_real)(a * a - b * b - c * c - d * d) / norm);
    attitude[1] = factor * ((eye4_real)(2 * a * b) / norm);
    attitude[2] = factor * ((eye4_real)(2 * a * c) / norm);
    attitude[3] = factor * ((eye4_real)(2 * a * d) / norm);
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
static eye4_real draw_step(const uint32_t *seed)
{
    (void)seed;
    return 0x1p-14;
}

static eye4_real draw_factor(uint32_t *seed, eye4_real largest)
{
    return 1.0 + draw_real(seed, largest);
}

static void draw_powers(uint32_t *seed, eye4_real *values, int count, eye4_real least)
{
    for (int i = 0; i < count; ++i) {
        values[i] = least;
        for (uint32_t k = draw_word(seed) >> 27; k > 0u; --k) {
            values[i] = values[i] * 2.0;
        }
    }
}

static eye4_real draw_share(uint32_t *seed)
{
    const eye4_real share = draw_real(seed, 1.0);
    return share < 0.0 ? -share : share;
}

static void draw_inputs(uint32_t *seed, unsigned long state)
{
    const eye4_real fast = state % 4ul == 3ul ? 32.0 : 1.0;
    const int refused = state % 16ul == 15ul ? 1 : 0;
    draw_reals(seed, in.x.position, 3, 2.0);
    draw_attitude(seed, in.x.attitude, refused);
    draw_reals(seed, in.x.V, 6, 2.0);
    draw_reals(seed, in.x.phi, EYE4_N, 16.0 * fast);
    draw_reals(seed, in.x.phi_dot, EYE4_N, 256.0 * fast);
    draw_reals(seed, in.phi_ddot, EYE4_N, 512.0);
    draw_reals(seed, in.wrench, 6, 8.0);
    draw_reals(seed, in.V_dot, 6, 16.0);
    draw_reals(seed, in.tau, EYE4_N, 2.0);
    draw_flags(seed, in.locked, EYE4_N);
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
    draw_reals(seed, in.demand, 3, 16.0);
    draw_reals(seed, in.angles, 3, 1.0);
    draw_reals(seed, in.position, 3, 2.0);
    draw_reals(seed, in.q_dot, 6, 2.0);
    draw_reals(seed, in.q_ddot, 6, 16.0);
    draw_reals(seed, in.carry.rounding, 21, 5.960464477539063e-8);
    in.mass_factor = draw_factor(seed, 0.125);
}

static void draw_options(uint32_t *seed)
{
    draw_powers(seed, options.weight, EYE4_N, 0.0009765625);
    draw_powers(seed, options.limit, EYE4_N, 1.0);
    draw_powers(seed, options.most, EYE4_N, 1.0);
    draw_powers(seed, options.motor_torque, EYE4_N, 1.52587890625e-5);
    draw_powers(seed, options.motor_speed, EYE4_N, 0.00390625);
    draw_powers(seed, options.motor_viscous, EYE4_N, 9.313225746154785e-10);
    draw_powers(seed, options.motor_coulomb, EYE4_N, 9.5367431640625e-7);
    draw_powers(seed, options.motor_coulomb_speed, EYE4_N, 0.00390625);
    options.near_singular = draw_share(seed);
    options.damping = draw_share(seed);
    draw_flags(seed, options.use_pointing, 3);
    draw_powers(seed, options.motor_power, EYE4_N, 1.52587890625e-5);
    draw_reals(seed, options.target_speed, EYE4_N, 256.0);
    options.target_rate = draw_share(seed);
    options.avoid_speed = draw_share(seed);
    draw_flags(seed, &options.keep_direction, 1);
}

/* The parameters of the stand file with all masses and inertias multiplied. */
static void scale_parameters(void)
{
    parameters = eye4_default_parameters;
    parameters.carrier.mass = parameters.carrier.mass * in.mass_factor;
    for (int i = 0; i < 6; ++i) {
        parameters.carrier.inertia[i] = parameters.carrier.inertia[i] * in.mass_factor;
    }
    for (int i = 0; i < EYE4_N; ++i) {
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
    eye4_status found;
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
    table = &eye4_default;
    options = eye4_default_options;
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
        in.x.phi[3] = infinite.real;
        break;
    case 14:
        in.x.phi[0] = 0x1p+60;
        break;
    case 15:
        in.x.phi[3] = -0x1p+60;
        break;
    case 16:
        in.x.phi_dot[0] = not_a_number.real;
        break;
    case 17:
        in.x.phi_dot[3] = infinite.real;
        break;
    case 18:
        in.x.phi_dot[0] = 0x1p+60;
        break;
    case 19:
        in.x.phi_dot[3] = -0x1p+60;
        break;
    case 20:
        in.phi_ddot[0] = not_a_number.real;
        break;
    case 21:
        in.phi_ddot[3] = infinite.real;
        break;
    case 22:
        in.phi_ddot[0] = 0x1p+60;
        break;
    case 23:
        in.phi_ddot[3] = -0x1p+60;
        break;
    case 24:
        in.wrench[0] = not_a_number.real;
        break;
    case 25:
        in.wrench[5] = infinite.real;
        break;
    case 26:
        in.wrench[0] = 0x1p+60;
        break;
    case 27:
        in.wrench[5] = -0x1p+60;
        break;
    case 28:
        in.V_dot[0] = not_a_number.real;
        break;
    case 29:
        in.V_dot[5] = infinite.real;
        break;
    case 30:
        in.V_dot[0] = 0x1p+60;
        break;
    case 31:
        in.V_dot[5] = -0x1p+60;
        break;
    case 32:
        in.tau[0] = not_a_number.real;
        break;
    case 33:
        in.tau[3] = infinite.real;
        break;
    case 34:
        in.tau[0] = 0x1p+60;
        break;
    case 35:
        in.tau[3] = -0x1p+60;
        break;
    case 36:
        in.dt = not_a_number.real;
        break;
    case 37:
        in.dt = infinite.real;
        break;
    case 38:
        in.dt = 0x1p+60;
        break;
    case 39:
        in.dt = -0x1p+60;
        break;
    case 40:
        in.dt = 0x0p+0;
        break;
    case 41:
        in.dt = -0x1.0624dd2f1a9fcp-10;
        break;
    case 42:
        in.order = -2;
        break;
    case 43:
        in.order = 0;
        break;
    case 44:
        in.order = 1;
        break;
    case 45:
        in.order = 3;
        break;
    case 46:
        in.order = 5;
        break;
    case 47:
        in.phi = not_a_number.real;
        break;
    case 48:
        in.phi = infinite.real;
        break;
    case 49:
        in.phi = 0x1p+60;
        break;
    case 50:
        in.phi = -0x1p+60;
        break;
    case 51:
        in.per_turn = 0;
        break;
    case 52:
        in.per_turn = 2147483647;
        break;
    case 53:
        in.per_turn = -2147483647;
        break;
    case 54:
        in.zero = not_a_number.real;
        break;
    case 55:
        in.zero = infinite.real;
        break;
    case 56:
        in.zero = 0x1p+60;
        break;
    case 57:
        in.zero = -0x1p+60;
        break;
    case 58:
        in.encoder.place = -1;
        break;
    case 59:
        in.encoder.place = 4097;
        break;
    case 60:
        in.bits = -1;
        break;
    case 61:
        in.bits = 1;
        break;
    case 62:
        in.bits = 33;
        break;
    case 63:
        in.demand[0] = not_a_number.real;
        break;
    case 64:
        in.demand[2] = infinite.real;
        break;
    case 65:
        in.demand[0] = 0x1p+60;
        break;
    case 66:
        in.demand[2] = -0x1p+60;
        break;
    case 67:
        in.angles[0] = not_a_number.real;
        break;
    case 68:
        in.angles[2] = infinite.real;
        break;
    case 69:
        in.angles[0] = 0x1p+60;
        break;
    case 70:
        in.angles[2] = -0x1p+60;
        break;
    case 71:
        in.position[0] = not_a_number.real;
        break;
    case 72:
        in.position[2] = infinite.real;
        break;
    case 73:
        in.position[0] = 0x1p+60;
        break;
    case 74:
        in.position[2] = -0x1p+60;
        break;
    case 75:
        in.q_dot[0] = not_a_number.real;
        break;
    case 76:
        in.q_dot[5] = infinite.real;
        break;
    case 77:
        in.q_dot[0] = 0x1p+60;
        break;
    case 78:
        in.q_dot[5] = -0x1p+60;
        break;
    case 79:
        in.q_ddot[0] = not_a_number.real;
        break;
    case 80:
        in.q_ddot[5] = infinite.real;
        break;
    case 81:
        in.q_ddot[0] = 0x1p+60;
        break;
    case 82:
        in.q_ddot[5] = -0x1p+60;
        break;
    case 83:
        in.carry.rounding[0] = not_a_number.real;
        break;
    case 84:
        in.carry.rounding[20] = infinite.real;
        break;
    case 85:
        in.carry.rounding[0] = 0x1p+60;
        break;
    case 86:
        in.carry.rounding[20] = -0x1p+60;
        break;
    case 87:
        options.weight[0] = not_a_number.real;
        break;
    case 88:
        options.weight[3] = infinite.real;
        break;
    case 89:
        options.weight[0] = 0x1p+60;
        break;
    case 90:
        options.weight[3] = -0x1p+60;
        break;
    case 91:
        options.weight[0] = 0x0p+0;
        break;
    case 92:
        options.weight[0] = -0x1p+0;
        break;
    case 93:
        options.weight[0] = 0x1.ad7f29abcaf48p-24;
        break;
    case 94:
        options.limit[0] = not_a_number.real;
        break;
    case 95:
        options.limit[3] = -0x1p+60;
        break;
    case 96:
        options.limit[0] = 0x0p+0;
        break;
    case 97:
        options.limit[0] = -0x1p+0;
        break;
    case 98:
        options.most[0] = not_a_number.real;
        break;
    case 99:
        options.most[3] = -0x1p+60;
        break;
    case 100:
        options.most[0] = 0x0p+0;
        break;
    case 101:
        options.most[0] = -0x1p+0;
        break;
    case 102:
        options.motor_torque[0] = not_a_number.real;
        break;
    case 103:
        options.motor_torque[3] = -0x1p+60;
        break;
    case 104:
        options.motor_torque[0] = -0x1p+0;
        break;
    case 105:
        options.motor_speed[0] = not_a_number.real;
        break;
    case 106:
        options.motor_speed[3] = -0x1p+60;
        break;
    case 107:
        options.motor_speed[0] = 0x0p+0;
        break;
    case 108:
        options.motor_speed[0] = -0x1p+0;
        break;
    case 109:
        options.motor_viscous[0] = not_a_number.real;
        break;
    case 110:
        options.motor_viscous[3] = -0x1p+60;
        break;
    case 111:
        options.motor_viscous[0] = -0x1p+0;
        break;
    case 112:
        options.motor_coulomb[0] = not_a_number.real;
        break;
    case 113:
        options.motor_coulomb[3] = -0x1p+60;
        break;
    case 114:
        options.motor_coulomb[0] = -0x1p+0;
        break;
    case 115:
        options.motor_coulomb_speed[0] = not_a_number.real;
        break;
    case 116:
        options.motor_coulomb_speed[3] = -0x1p+60;
        break;
    case 117:
        options.motor_coulomb_speed[0] = 0x0p+0;
        break;
    case 118:
        options.motor_coulomb_speed[0] = -0x1p+0;
        break;
    case 119:
        options.near_singular = not_a_number.real;
        break;
    case 120:
        options.near_singular = infinite.real;
        break;
    case 121:
        options.near_singular = 0x1p+60;
        break;
    case 122:
        options.near_singular = -0x1p+60;
        break;
    case 123:
        options.near_singular = -0x1.999999999999ap-4;
        break;
    case 124:
        options.near_singular = 0x1.8p+0;
        break;
    case 125:
        options.damping = not_a_number.real;
        break;
    case 126:
        options.damping = infinite.real;
        break;
    case 127:
        options.damping = 0x1p+60;
        break;
    case 128:
        options.damping = -0x1p+60;
        break;
    case 129:
        options.damping = -0x1.999999999999ap-4;
        break;
    case 130:
        options.damping = 0x1.8p+0;
        break;
    case 131:
        options.motor_power[0] = not_a_number.real;
        break;
    case 132:
        options.motor_power[3] = -0x1p+60;
        break;
    case 133:
        options.motor_power[0] = -0x1p+0;
        break;
    case 134:
        options.target_speed[0] = not_a_number.real;
        break;
    case 135:
        options.target_speed[3] = infinite.real;
        break;
    case 136:
        options.target_speed[0] = 0x1p+60;
        break;
    case 137:
        options.target_speed[3] = -0x1p+60;
        break;
    case 138:
        options.target_rate = not_a_number.real;
        break;
    case 139:
        options.target_rate = infinite.real;
        break;
    case 140:
        options.target_rate = 0x1p+60;
        break;
    case 141:
        options.target_rate = -0x1p+60;
        break;
    case 142:
        options.target_rate = -0x1p+0;
        break;
    case 143:
        options.avoid_speed = not_a_number.real;
        break;
    case 144:
        options.avoid_speed = infinite.real;
        break;
    case 145:
        options.avoid_speed = 0x1p+60;
        break;
    case 146:
        options.avoid_speed = -0x1p+60;
        break;
    case 147:
        options.avoid_speed = -0x1p+0;
        break;
    case 148:
        parameters.carrier.mass = not_a_number.real;
        break;
    case 149:
        parameters.carrier.mass = infinite.real;
        break;
    case 150:
        parameters.carrier.mass = 0x1p+60;
        break;
    case 151:
        parameters.carrier.mass = -0x1p+60;
        break;
    case 152:
        parameters.carrier.mass = -0x1p+0;
        break;
    case 153:
        parameters.carrier.center_of_mass[0] = not_a_number.real;
        break;
    case 154:
        parameters.carrier.center_of_mass[2] = infinite.real;
        break;
    case 155:
        parameters.carrier.center_of_mass[0] = 0x1p+60;
        break;
    case 156:
        parameters.carrier.center_of_mass[2] = -0x1p+60;
        break;
    case 157:
        parameters.carrier.inertia[0] = not_a_number.real;
        break;
    case 158:
        parameters.carrier.inertia[5] = infinite.real;
        break;
    case 159:
        parameters.carrier.inertia[0] = 0x1p+60;
        break;
    case 160:
        parameters.carrier.inertia[5] = -0x1p+60;
        break;
    case 161:
        parameters.carrier.inertia[0] = 0x1p+30;
        break;
    case 162:
        parameters.carrier.inertia[3] = 0x1p+30;
        break;
    case 163:
        parameters.carrier.inertia[0] = -0x1p+0;
        break;
    case 164:
        parameters.carrier.inertia[1] = -0x1p+0;
        break;
    case 165:
        parameters.carrier.inertia[2] = -0x1p+0;
        break;
    case 166:
        parameters.flywheel[0].body.mass = not_a_number.real;
        break;
    case 167:
        parameters.flywheel[0].body.mass = infinite.real;
        break;
    case 168:
        parameters.flywheel[0].body.mass = 0x1p+60;
        break;
    case 169:
        parameters.flywheel[0].body.mass = -0x1p+60;
        break;
    case 170:
        parameters.flywheel[0].body.mass = -0x1p+0;
        break;
    case 171:
        parameters.flywheel[0].body.center_of_mass[0] = not_a_number.real;
        break;
    case 172:
        parameters.flywheel[0].body.center_of_mass[2] = infinite.real;
        break;
    case 173:
        parameters.flywheel[0].body.center_of_mass[0] = 0x1p+60;
        break;
    case 174:
        parameters.flywheel[0].body.center_of_mass[2] = -0x1p+60;
        break;
    case 175:
        parameters.flywheel[0].body.inertia[0] = not_a_number.real;
        break;
    case 176:
        parameters.flywheel[0].body.inertia[5] = infinite.real;
        break;
    case 177:
        parameters.flywheel[0].body.inertia[0] = 0x1p+60;
        break;
    case 178:
        parameters.flywheel[0].body.inertia[5] = -0x1p+60;
        break;
    case 179:
        parameters.flywheel[0].body.inertia[0] = 0x1p+30;
        break;
    case 180:
        parameters.flywheel[0].body.inertia[3] = 0x1p+30;
        break;
    case 181:
        parameters.flywheel[0].body.inertia[0] = -0x1p+0;
        break;
    case 182:
        parameters.flywheel[0].body.inertia[1] = -0x1p+0;
        break;
    case 183:
        parameters.flywheel[0].body.inertia[2] = -0x1p+0;
        break;
    case 184:
        parameters.flywheel[0].position[0] = not_a_number.real;
        break;
    case 185:
        parameters.flywheel[0].position[2] = infinite.real;
        break;
    case 186:
        parameters.flywheel[0].position[0] = 0x1p+60;
        break;
    case 187:
        parameters.flywheel[0].position[2] = -0x1p+60;
        break;
    case 188:
        parameters.flywheel[0].axis[0] = not_a_number.real;
        break;
    case 189:
        parameters.flywheel[0].axis[2] = infinite.real;
        break;
    case 190:
        parameters.flywheel[0].axis[0] = 0x1p+60;
        break;
    case 191:
        parameters.flywheel[0].axis[2] = -0x1p+60;
        break;
    case 192:
        parameters.flywheel[0].axis[0] = 0x0p+0;
        parameters.flywheel[0].axis[1] = 0x0p+0;
        parameters.flywheel[0].axis[2] = 0x0p+0;
        break;
    case 193:
        parameters.flywheel[0].axis[0] = 0x1p+0;
        parameters.flywheel[0].axis[1] = 0x0p+0;
        parameters.flywheel[0].axis[2] = 0x0p+0;
        parameters.flywheel[0].zero[0] = 0x1p+0;
        parameters.flywheel[0].zero[1] = 0x0p+0;
        parameters.flywheel[0].zero[2] = 0x0p+0;
        break;
    case 194:
        parameters.flywheel[0].zero[0] = not_a_number.real;
        break;
    case 195:
        parameters.flywheel[0].zero[2] = infinite.real;
        break;
    case 196:
        parameters.flywheel[0].zero[0] = 0x1p+60;
        break;
    case 197:
        parameters.flywheel[0].zero[2] = -0x1p+60;
        break;
    case 198:
        parameters.flywheel[0].zero[0] = 0x0p+0;
        parameters.flywheel[0].zero[1] = 0x0p+0;
        parameters.flywheel[0].zero[2] = 0x0p+0;
        break;
    case 199:
        parameters.flywheel[0].zero[0] = 0x1p+0;
        parameters.flywheel[0].zero[1] = 0x0p+0;
        parameters.flywheel[0].zero[2] = 0x0p+0;
        parameters.flywheel[0].axis[0] = 0x1p+0;
        parameters.flywheel[0].axis[1] = 0x0p+0;
        parameters.flywheel[0].axis[2] = 0x0p+0;
        break;
    case 200:
        parameters.point[0].position[0] = not_a_number.real;
        break;
    case 201:
        parameters.point[0].position[2] = infinite.real;
        break;
    case 202:
        parameters.point[0].position[0] = 0x1p+60;
        break;
    case 203:
        parameters.point[0].position[2] = -0x1p+60;
        break;
    case 204:
        parameters.point[0].axis[0] = not_a_number.real;
        break;
    case 205:
        parameters.point[0].axis[2] = infinite.real;
        break;
    case 206:
        parameters.point[0].axis[0] = 0x1p+60;
        break;
    case 207:
        parameters.point[0].axis[2] = -0x1p+60;
        break;
    case 208:
        parameters.point[0].axis[0] = 0x0p+0;
        parameters.point[0].axis[1] = 0x0p+0;
        parameters.point[0].axis[2] = 0x0p+0;
        break;
    case 209:
        parameters.point[0].axis[0] = 0x1p+0;
        parameters.point[0].axis[1] = 0x0p+0;
        parameters.point[0].axis[2] = 0x0p+0;
        parameters.point[0].zero[0] = 0x1p+0;
        parameters.point[0].zero[1] = 0x0p+0;
        parameters.point[0].zero[2] = 0x0p+0;
        break;
    case 210:
        parameters.point[0].zero[0] = not_a_number.real;
        break;
    case 211:
        parameters.point[0].zero[2] = infinite.real;
        break;
    case 212:
        parameters.point[0].zero[0] = 0x1p+60;
        break;
    case 213:
        parameters.point[0].zero[2] = -0x1p+60;
        break;
    case 214:
        parameters.point[0].zero[0] = 0x0p+0;
        parameters.point[0].zero[1] = 0x0p+0;
        parameters.point[0].zero[2] = 0x0p+0;
        break;
    case 215:
        parameters.point[0].zero[0] = 0x1p+0;
        parameters.point[0].zero[1] = 0x0p+0;
        parameters.point[0].zero[2] = 0x0p+0;
        parameters.point[0].axis[0] = 0x1p+0;
        parameters.point[0].axis[1] = 0x0p+0;
        parameters.point[0].axis[2] = 0x0p+0;
        break;
    case 216:
        in.dt = 0x1p-3;
        in.order = 2;
        break;
    case 217:
        in.dt = 0x1p-3;
        in.order = 4;
        break;
    case 218:
        in.dt = 0x1p+3;
        in.order = 2;
        break;
    case 219:
        in.dt = 0x1p+3;
        in.order = 4;
        break;
    case 220:
        in.phi = 0x1.8p+1;
        break;
    case 221:
        in.phi = -0x1.8p+1;
        break;
    case 222:
        in.phi = 0x1.921fb54442d18p+1;
        break;
    case 223:
        in.phi = -0x1.921fb54442d18p+1;
        break;
    case 224:
        in.phi = 0x1.cp+1;
        break;
    case 225:
        in.phi = -0x1.cp+1;
        break;
    case 226:
        in.phi = 0x1.2d97c7f3321d2p+3;
        break;
    case 227:
        in.phi = -0x1.2d97c7f3321d2p+3;
        break;
    case 228:
        in.phi = 0x1.f4p+9;
        break;
    case 229:
        in.phi = -0x1.f4p+9;
        break;
    case 230:
        in.bits = 0;
        in.encoder.counter = 0;
        in.counter = 4090;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 231:
        in.bits = 0;
        in.encoder.counter = 0;
        in.counter = 4090;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 232:
        in.bits = 0;
        in.encoder.counter = 4090;
        in.counter = 0;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 233:
        in.bits = 0;
        in.encoder.counter = 4090;
        in.counter = 0;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 234:
        in.bits = 0;
        in.encoder.counter = 100;
        in.counter = 200;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 235:
        in.bits = 0;
        in.encoder.counter = 100;
        in.counter = 200;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 236:
        in.bits = 0;
        in.encoder.counter = -1;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 237:
        in.bits = 0;
        in.encoder.counter = -1;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 238:
        in.bits = 0;
        in.encoder.counter = 4096;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 239:
        in.bits = 0;
        in.encoder.counter = 4096;
        in.counter = 5;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 240:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = -1;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 241:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = -1;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 242:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = 4096;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 243:
        in.bits = 0;
        in.encoder.counter = 5;
        in.counter = 4096;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 244:
        in.bits = 16;
        in.encoder.counter = 32767;
        in.counter = -32768;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 245:
        in.bits = 16;
        in.encoder.counter = 32767;
        in.counter = -32768;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 246:
        in.bits = 16;
        in.encoder.counter = -32768;
        in.counter = 32767;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 247:
        in.bits = 16;
        in.encoder.counter = -32768;
        in.counter = 32767;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 248:
        in.bits = 16;
        in.encoder.counter = 0;
        in.counter = 30000;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 249:
        in.bits = 16;
        in.encoder.counter = 0;
        in.counter = 30000;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 250:
        in.bits = 32;
        in.encoder.counter = 2147483647;
        in.counter = -2147483647;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 251:
        in.bits = 32;
        in.encoder.counter = 2147483647;
        in.counter = -2147483647;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 252:
        in.bits = 32;
        in.encoder.counter = -2147483647;
        in.counter = 2147483647;
        in.per_turn = 4096;
        in.encoder.place = 0;
        break;
    case 253:
        in.bits = 32;
        in.encoder.counter = -2147483647;
        in.counter = 2147483647;
        in.per_turn = 4096;
        in.encoder.place = 4095;
        break;
    case 254:
        options.near_singular = 0x1p+0;
        break;
    case 255:
        options.near_singular = 0x1p+0;
        options.damping = 0x1p-1;
        break;
    case 256:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.44754a415d0a6p+25; }
        break;
    case 257:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.b09c6301d1632p+23; }
        break;
    case 258:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.b09c6301d1632p+15; }
        break;
    case 259:
        for (int s = 0; s < EYE4_N; ++s) { options.weight[s] = 0x1p+2; }
        break;
    case 260:
        for (int s = 0; s < EYE4_N; ++s) { options.most[s] = 0x1p-10; }
        break;
    case 261:
        for (int s = 0; s < EYE4_N; ++s) { options.motor_torque[s] = 0x1p-10; }
        break;
    case 262:
        for (int s = 0; s < EYE4_N; ++s) { options.motor_speed[s] = 0x1p-10; }
        break;
    case 263:
        for (int s = 0; s < EYE4_N; ++s) { options.motor_power[s] = 0x1p-10; }
        break;
    case 264:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < EYE4_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.wrench[0] = 0x0p+0;
        in.wrench[1] = 0x0p+0;
        in.wrench[2] = 0x0p+0;
        in.wrench[3] = 0x0p+0;
        in.wrench[4] = 0x0p+0;
        in.wrench[5] = 0x0p+0;
        in.V_dot[0] = 0x1p-12;
        in.V_dot[1] = -0x1p-12;
        in.V_dot[2] = 0x1p-12;
        in.V_dot[3] = -0x1p-12;
        in.V_dot[4] = 0x1p-12;
        in.V_dot[5] = -0x1p-12;
        break;
    case 265:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < EYE4_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.wrench[0] = 0x0p+0;
        in.wrench[1] = 0x0p+0;
        in.wrench[2] = 0x0p+0;
        in.wrench[3] = 0x0p+0;
        in.wrench[4] = 0x0p+0;
        in.wrench[5] = 0x0p+0;
        in.V_dot[0] = 0x1p-6;
        in.V_dot[1] = -0x1p-6;
        in.V_dot[2] = 0x1p-6;
        in.V_dot[3] = -0x1p-6;
        in.V_dot[4] = 0x1p-6;
        in.V_dot[5] = -0x1p-6;
        break;
    case 266:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < EYE4_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.wrench[0] = 0x0p+0;
        in.wrench[1] = 0x0p+0;
        in.wrench[2] = 0x0p+0;
        in.wrench[3] = 0x0p+0;
        in.wrench[4] = 0x0p+0;
        in.wrench[5] = 0x0p+0;
        in.V_dot[0] = 0x1p+0;
        in.V_dot[1] = -0x1p+0;
        in.V_dot[2] = 0x1p+0;
        in.V_dot[3] = -0x1p+0;
        in.V_dot[4] = 0x1p+0;
        in.V_dot[5] = -0x1p+0;
        break;
    case 267:
        options.avoid_speed = 0x1p+16;
        options.target_rate = 0x1p+0;
        for (int s = 0; s < EYE4_N; ++s) { options.target_speed[s] = -0x1p+0; }
        break;
    case 268:
        options.avoid_speed = 0x1p+16;
        options.target_rate = 0x1p+0;
        for (int s = 0; s < EYE4_N; ++s) { options.target_speed[s] = 0x0p+0; }
        break;
    case 269:
        options.avoid_speed = 0x1p+16;
        options.target_rate = 0x1p+0;
        for (int s = 0; s < EYE4_N; ++s) { options.target_speed[s] = 0x1p+0; }
        break;
    case 270:
        for (int s = 0; s < EYE4_N; ++s) { options.motor_viscous[s] = 0x1p-1; }
        for (int s = 0; s < EYE4_N; ++s) { options.motor_coulomb[s] = 0x1p-1; }
        for (int s = 0; s < EYE4_N; ++s) { options.motor_coulomb_speed[s] = 0x1p-1; }
        break;
    case 271:
        for (int s = 0; s < EYE4_N; ++s) { parameters.flywheel[s].axis[0] = 0x1p+0; }
        for (int s = 0; s < EYE4_N; ++s) { parameters.flywheel[s].axis[1] = 0x0p+0; }
        for (int s = 0; s < EYE4_N; ++s) { parameters.flywheel[s].axis[2] = 0x0p+0; }
        for (int s = 0; s < EYE4_N; ++s) { parameters.flywheel[s].zero[0] = 0x0p+0; }
        for (int s = 0; s < EYE4_N; ++s) { parameters.flywheel[s].zero[1] = 0x1p+0; }
        for (int s = 0; s < EYE4_N; ++s) { parameters.flywheel[s].body.center_of_mass[1] = 0x0p+0; }
        for (int s = 0; s < EYE4_N; ++s) { parameters.flywheel[s].body.center_of_mass[2] = 0x0p+0; }
        for (int s = 0; s < EYE4_N; ++s) { parameters.flywheel[s].body.inertia[3] = 0x0p+0; }
        for (int s = 0; s < EYE4_N; ++s) { parameters.flywheel[s].body.inertia[4] = 0x0p+0; }
        break;
    case 272:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.44754a3ee0dcp+25; }
        break;
    case 273:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.b09c62fe81255p+23; }
        break;
    case 274:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.b09c62fe81255p+15; }
        break;
    case 275:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.28b80de1d1512p+14; }
        break;
    case 276:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.8ba012826c6c2p+12; }
        break;
    case 277:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.8ba012826c6c2p+4; }
        break;
    case 278:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < EYE4_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.wrench[0] = 0x0p+0;
        in.wrench[1] = 0x0p+0;
        in.wrench[2] = 0x0p+0;
        in.wrench[3] = 0x0p+0;
        in.wrench[4] = 0x0p+0;
        in.wrench[5] = 0x0p+0;
        in.demand[0] = 0x1p-12;
        in.demand[1] = -0x1p-12;
        in.demand[2] = 0x1p-12;
        break;
    case 279:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < EYE4_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.wrench[0] = 0x0p+0;
        in.wrench[1] = 0x0p+0;
        in.wrench[2] = 0x0p+0;
        in.wrench[3] = 0x0p+0;
        in.wrench[4] = 0x0p+0;
        in.wrench[5] = 0x0p+0;
        in.demand[0] = 0x1p-6;
        in.demand[1] = -0x1p-6;
        in.demand[2] = 0x1p-6;
        break;
    case 280:
        in.x.V[0] = 0x0p+0;
        in.x.V[1] = 0x0p+0;
        in.x.V[2] = 0x0p+0;
        in.x.V[3] = 0x0p+0;
        in.x.V[4] = 0x0p+0;
        in.x.V[5] = 0x0p+0;
        for (int s = 0; s < EYE4_N; ++s) { in.x.phi_dot[s] = 0x1p-1; }
        in.wrench[0] = 0x0p+0;
        in.wrench[1] = 0x0p+0;
        in.wrench[2] = 0x0p+0;
        in.wrench[3] = 0x0p+0;
        in.wrench[4] = 0x0p+0;
        in.wrench[5] = 0x0p+0;
        in.demand[0] = 0x1p+0;
        in.demand[1] = -0x1p+0;
        in.demand[2] = 0x1p+0;
        break;
    case 281:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.28b80de1d1513p+14; }
        break;
    case 282:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.8ba012826c6c4p+12; }
        break;
    case 283:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.8ba012826c6c4p+4; }
        break;
    case 284:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.7d74e7f546b7bp+5; }
        break;
    case 285:
        for (int s = 0; s < EYE4_N; ++s) { options.motor_torque[s] = 0x1.3333333333334p-4; }
        break;
    case 286:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.fc9bdff1b39f9p+3; }
        break;
    case 287:
        for (int s = 0; s < EYE4_N; ++s) { options.motor_torque[s] = 0x1.999999999999ap-6; }
        break;
    case 288:
        for (int s = 0; s < EYE4_N; ++s) { options.limit[s] = 0x1.fc9bdff1b39f9p-5; }
        break;
    case 289:
        for (int s = 0; s < EYE4_N; ++s) { options.motor_torque[s] = 0x1.999999999999ap-14; }
        break;
    case 290:
        in.angles[1] = 0x0p+0;
        break;
    case 291:
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
    { 0, -1, 0, 0x00000000u, { 0x6a7f87fu } },
    { 1, -1, 0, 0x00000000u, { 0x6a7f87fu } },
    { 2, -2, 0, 0x00000000u, { 0x6a7f87fu } },
    { 3, -2, 0, 0x00000000u, { 0x6a7f87fu } },
    { 4, -1, 0, 0x00000000u, { 0x687f87fu } },
    { 5, -1, 0, 0x00000000u, { 0x687f87fu } },
    { 6, -2, 0, 0x00000000u, { 0x687f87fu } },
    { 7, -2, 0, 0x00000000u, { 0x687f87fu } },
    { 8, -1, 0, 0x00000000u, { 0x6a7f87fu } },
    { 9, -1, 0, 0x00000000u, { 0x6a7f87fu } },
    { 10, -2, 0, 0x00000000u, { 0x6a7f87fu } },
    { 11, -2, 0, 0x00000000u, { 0x6a7f87fu } },
    { 12, -1, 0, 0x00000000u, { 0x6a7f87fu } },
    { 13, -1, 0, 0x00000000u, { 0x6a7f87fu } },
    { 14, -2, 0, 0x00000000u, { 0x6a7f87fu } },
    { 15, -2, 0, 0x00000000u, { 0x6a7f87fu } },
    { 16, -1, 0, 0x00000000u, { 0x6a7f87fu } },
    { 17, -1, 0, 0x00000000u, { 0x6a7f87fu } },
    { 18, -2, 0, 0x00000000u, { 0x6a7f87fu } },
    { 19, -2, 0, 0x00000000u, { 0x6a7f87fu } },
    { 20, -1, 0, 0x00000000u, { 0x4a00849u } },
    { 21, -1, 0, 0x00000000u, { 0x4a00849u } },
    { 22, -2, 0, 0x00000000u, { 0x4a00849u } },
    { 23, -2, 0, 0x00000000u, { 0x4a00849u } },
    { 24, -1, 0, 0x00000000u, { 0x623f873u } },
    { 25, -1, 0, 0x00000000u, { 0x623f873u } },
    { 26, -2, 0, 0x00000000u, { 0x623f873u } },
    { 27, -2, 0, 0x00000000u, { 0x623f873u } },
    { 28, -1, 0, 0x00000000u, { 0x846008u } },
    { 29, -1, 0, 0x00000000u, { 0x846008u } },
    { 30, -2, 0, 0x00000000u, { 0x846008u } },
    { 31, -2, 0, 0x00000000u, { 0x846008u } },
    { 32, -1, 0, 0x00000000u, { 0x2001030u } },
    { 33, -1, 0, 0x00000000u, { 0x2001030u } },
    { 34, -2, 0, 0x00000000u, { 0x2001030u } },
    { 35, -2, 0, 0x00000000u, { 0x2001030u } },
    { 36, -1, 0, 0x00000000u, { 0x6000260u } },
    { 37, -1, 0, 0x00000000u, { 0x6000260u } },
    { 38, -2, 0, 0x00000000u, { 0x6000260u } },
    { 39, -2, 0, 0x00000000u, { 0x6000260u } },
    { 40, -5, 0, 0x00000000u, { 0x6000260u } },
    { 41, -5, 0, 0x00000000u, { 0x6000260u } },
    { 42, -5, 0, 0x00000000u, { 0x6000060u } },
    { 43, -5, 0, 0x00000000u, { 0x6000060u } },
    { 44, -5, 0, 0x00000000u, { 0x6000060u } },
    { 45, -5, 0, 0x00000000u, { 0x6000060u } },
    { 46, -5, 0, 0x00000000u, { 0x6000060u } },
    { 47, -1, 0, 0x00000000u, { 0x80u } },
    { 48, -1, 0, 0x00000000u, { 0x80u } },
    { 49, -2, 0, 0x00000000u, { 0x80u } },
    { 50, -2, 0, 0x00000000u, { 0x80u } },
    { 51, -5, 0, 0x00000000u, { 0x700u } },
    { 52, -5, 0, 0x00000000u, { 0x700u } },
    { 53, -5, 0, 0x00000000u, { 0x700u } },
    { 54, -1, 0, 0x00000000u, { 0x100u } },
    { 55, -1, 0, 0x00000000u, { 0x100u } },
    { 56, -2, 0, 0x00000000u, { 0x100u } },
    { 57, -2, 0, 0x00000000u, { 0x100u } },
    { 58, -5, 0, 0x00000000u, { 0x400u } },
    { 59, -5, 0, 0x00000000u, { 0x400u } },
    { 60, -5, 0, 0x00000000u, { 0x400u } },
    { 61, -5, 0, 0x00000000u, { 0x400u } },
    { 62, -5, 0, 0x00000000u, { 0x400u } },
    { 63, -1, 0, 0x00000000u, { 0x38000u } },
    { 64, -1, 0, 0x00000000u, { 0x38000u } },
    { 65, -2, 0, 0x00000000u, { 0x38000u } },
    { 66, -2, 0, 0x00000000u, { 0x38000u } },
    { 67, -1, 0, 0x00000000u, { 0x380000u } },
    { 68, -1, 0, 0x00000000u, { 0x380000u } },
    { 69, -2, 0, 0x00000000u, { 0x380000u } },
    { 70, -2, 0, 0x00000000u, { 0x380000u } },
    { 71, -1, 0, 0x00000000u, { 0x100000u } },
    { 72, -1, 0, 0x00000000u, { 0x100000u } },
    { 73, -2, 0, 0x00000000u, { 0x100000u } },
    { 74, -2, 0, 0x00000000u, { 0x100000u } },
    { 75, -1, 0, 0x00000000u, { 0x100000u } },
    { 76, -1, 0, 0x00000000u, { 0x100000u } },
    { 77, -2, 0, 0x00000000u, { 0x100000u } },
    { 78, -2, 0, 0x00000000u, { 0x100000u } },
    { 79, -1, 0, 0x00000000u, { 0x100000u } },
    { 80, -1, 0, 0x00000000u, { 0x100000u } },
    { 81, -2, 0, 0x00000000u, { 0x100000u } },
    { 82, -2, 0, 0x00000000u, { 0x100000u } },
    { 83, -1, 0, 0x00000000u, { 0x6000000u } },
    { 84, -1, 0, 0x00000000u, { 0x6000000u } },
    { 85, -2, 0, 0x00000000u, { 0x6000000u } },
    { 86, -2, 0, 0x00000000u, { 0x6000000u } },
    { 87, -1, 0, 0x00000000u, { 0x3e000u } },
    { 88, -1, 0, 0x00000000u, { 0x3e000u } },
    { 89, -2, 0, 0x00000000u, { 0x3e000u } },
    { 90, -2, 0, 0x00000000u, { 0x3e000u } },
    { 91, -2, 0, 0x00000000u, { 0x3e000u } },
    { 92, -2, 0, 0x00000000u, { 0x3e000u } },
    { 93, -2, 0, 0x00000000u, { 0x3e000u } },
    { 94, -1, 0, 0x00000000u, { 0xa000u } },
    { 95, -5, 0, 0x00000000u, { 0xa000u } },
    { 96, -5, 0, 0x00000000u, { 0xa000u } },
    { 97, -5, 0, 0x00000000u, { 0xa000u } },
    { 98, -1, 0, 0x00000000u, { 0x2a000u } },
    { 99, -5, 0, 0x00000000u, { 0x2a000u } },
    { 100, -5, 0, 0x00000000u, { 0x2a000u } },
    { 101, -5, 0, 0x00000000u, { 0x2a000u } },
    { 102, -1, 0, 0x00000000u, { 0x2a000u } },
    { 103, -5, 0, 0x00000000u, { 0x2a000u } },
    { 104, -5, 0, 0x00000000u, { 0x2a000u } },
    { 105, -1, 0, 0x00000000u, { 0x2a000u } },
    { 106, -5, 0, 0x00000000u, { 0x2a000u } },
    { 107, -5, 0, 0x00000000u, { 0x2a000u } },
    { 108, -5, 0, 0x00000000u, { 0x2a000u } },
    { 109, -1, 0, 0x00000000u, { 0xa000u } },
    { 110, -5, 0, 0x00000000u, { 0xa000u } },
    { 111, -5, 0, 0x00000000u, { 0xa000u } },
    { 112, -1, 0, 0x00000000u, { 0xa000u } },
    { 113, -5, 0, 0x00000000u, { 0xa000u } },
    { 114, -5, 0, 0x00000000u, { 0xa000u } },
    { 115, -1, 0, 0x00000000u, { 0xa000u } },
    { 116, -5, 0, 0x00000000u, { 0xa000u } },
    { 117, -5, 0, 0x00000000u, { 0xa000u } },
    { 118, -5, 0, 0x00000000u, { 0xa000u } },
    { 119, -1, 0, 0x00000000u, { 0xa000u } },
    { 120, -1, 0, 0x00000000u, { 0xa000u } },
    { 121, -5, 0, 0x00000000u, { 0xa000u } },
    { 122, -5, 0, 0x00000000u, { 0xa000u } },
    { 123, -5, 0, 0x00000000u, { 0xa000u } },
    { 124, -5, 0, 0x00000000u, { 0xa000u } },
    { 125, -1, 0, 0x00000000u, { 0x3e000u } },
    { 126, -1, 0, 0x00000000u, { 0x3e000u } },
    { 127, -5, 0, 0x00000000u, { 0x3e000u } },
    { 128, -5, 0, 0x00000000u, { 0x3e000u } },
    { 129, -5, 0, 0x00000000u, { 0x3e000u } },
    { 130, -5, 0, 0x00000000u, { 0x3e000u } },
    { 131, -1, 0, 0x00000000u, { 0x20000u } },
    { 132, -5, 0, 0x00000000u, { 0x20000u } },
    { 133, -5, 0, 0x00000000u, { 0x20000u } },
    { 134, -1, 0, 0x00000000u, { 0x20000u } },
    { 135, -1, 0, 0x00000000u, { 0x20000u } },
    { 136, -2, 0, 0x00000000u, { 0x20000u } },
    { 137, -2, 0, 0x00000000u, { 0x20000u } },
    { 138, -1, 0, 0x00000000u, { 0x20000u } },
    { 139, -1, 0, 0x00000000u, { 0x20000u } },
    { 140, -2, 0, 0x00000000u, { 0x20000u } },
    { 141, -2, 0, 0x00000000u, { 0x20000u } },
    { 142, -5, 0, 0x00000000u, { 0x20000u } },
    { 143, -1, 0, 0x00000000u, { 0x20000u } },
    { 144, -1, 0, 0x00000000u, { 0x20000u } },
    { 145, -2, 0, 0x00000000u, { 0x20000u } },
    { 146, -2, 0, 0x00000000u, { 0x20000u } },
    { 147, -5, 0, 0x00000000u, { 0x20000u } },
    { 148, -1, 0, 0x00000000u, { 0x1400000u } },
    { 149, -1, 0, 0x00000000u, { 0x1400000u } },
    { 150, -2, 0, 0x00000000u, { 0x1400000u } },
    { 151, -2, 0, 0x00000000u, { 0x1400000u } },
    { 152, -2, 0, 0x00000000u, { 0x1400000u } },
    { 153, -1, 0, 0x00000000u, { 0x1400000u } },
    { 154, -1, 0, 0x00000000u, { 0x1400000u } },
    { 155, -2, 0, 0x00000000u, { 0x1400000u } },
    { 156, -2, 0, 0x00000000u, { 0x1400000u } },
    { 157, -1, 0, 0x00000000u, { 0x1400000u } },
    { 158, -1, 0, 0x00000000u, { 0x1400000u } },
    { 159, -2, 0, 0x00000000u, { 0x1400000u } },
    { 160, -2, 0, 0x00000000u, { 0x1400000u } },
    { 161, -3, 0, 0x00000000u, { 0x1400000u } },
    { 162, -3, 0, 0x00000000u, { 0x1400000u } },
    { 163, -3, 0, 0x00000000u, { 0x1400000u } },
    { 164, -3, 0, 0x00000000u, { 0x1400000u } },
    { 165, -3, 0, 0x00000000u, { 0x1400000u } },
    { 166, -1, 0, 0x00000000u, { 0x1400000u } },
    { 167, -1, 0, 0x00000000u, { 0x1400000u } },
    { 168, -2, 0, 0x00000000u, { 0x1400000u } },
    { 169, -2, 0, 0x00000000u, { 0x1400000u } },
    { 170, -2, 0, 0x00000000u, { 0x1400000u } },
    { 171, -1, 0, 0x00000000u, { 0x1400000u } },
    { 172, -1, 0, 0x00000000u, { 0x1400000u } },
    { 173, -2, 0, 0x00000000u, { 0x1400000u } },
    { 174, -2, 0, 0x00000000u, { 0x1400000u } },
    { 175, -1, 0, 0x00000000u, { 0x1400000u } },
    { 176, -1, 0, 0x00000000u, { 0x1400000u } },
    { 177, -2, 0, 0x00000000u, { 0x1400000u } },
    { 178, -2, 0, 0x00000000u, { 0x1400000u } },
    { 179, -3, 0, 0x00000000u, { 0x1400000u } },
    { 180, -3, 0, 0x00000000u, { 0x1400000u } },
    { 181, -3, 0, 0x00000000u, { 0x1400000u } },
    { 182, -3, 0, 0x00000000u, { 0x1400000u } },
    { 183, -3, 0, 0x00000000u, { 0x1400000u } },
    { 184, -1, 0, 0x00000000u, { 0x1400000u } },
    { 185, -1, 0, 0x00000000u, { 0x1400000u } },
    { 186, -2, 0, 0x00000000u, { 0x1400000u } },
    { 187, -2, 0, 0x00000000u, { 0x1400000u } },
    { 188, -1, 0, 0x00000000u, { 0x1400000u } },
    { 189, -1, 0, 0x00000000u, { 0x1400000u } },
    { 190, -2, 0, 0x00000000u, { 0x1400000u } },
    { 191, -2, 0, 0x00000000u, { 0x1400000u } },
    { 192, -2, 0, 0x00000000u, { 0x1400000u } },
    { 193, -2, 0, 0x00000000u, { 0x1400000u } },
    { 194, -1, 0, 0x00000000u, { 0x1400000u } },
    { 195, -1, 0, 0x00000000u, { 0x1400000u } },
    { 196, -2, 0, 0x00000000u, { 0x1400000u } },
    { 197, -2, 0, 0x00000000u, { 0x1400000u } },
    { 198, -2, 0, 0x00000000u, { 0x1400000u } },
    { 199, -2, 0, 0x00000000u, { 0x1400000u } },
    { 200, -1, 0, 0x00000000u, { 0x1400000u } },
    { 201, -1, 0, 0x00000000u, { 0x1400000u } },
    { 202, -2, 0, 0x00000000u, { 0x1400000u } },
    { 203, -2, 0, 0x00000000u, { 0x1400000u } },
    { 204, -1, 0, 0x00000000u, { 0x1400000u } },
    { 205, -1, 0, 0x00000000u, { 0x1400000u } },
    { 206, -2, 0, 0x00000000u, { 0x1400000u } },
    { 207, -2, 0, 0x00000000u, { 0x1400000u } },
    { 208, -2, 0, 0x00000000u, { 0x1400000u } },
    { 209, -2, 0, 0x00000000u, { 0x1400000u } },
    { 210, -1, 0, 0x00000000u, { 0x1400000u } },
    { 211, -1, 0, 0x00000000u, { 0x1400000u } },
    { 212, -2, 0, 0x00000000u, { 0x1400000u } },
    { 213, -2, 0, 0x00000000u, { 0x1400000u } },
    { 214, -2, 0, 0x00000000u, { 0x1400000u } },
    { 215, -2, 0, 0x00000000u, { 0x1400000u } },
    { 216, 32, 0, 0x284fc517u, { 0x20u } },
    { 217, 32, 0, 0xc42f8f40u, { 0x20u } },
    { 218, -2, 0, 0x00000000u, { 0x20u } },
    { 219, -2, 0, 0x00000000u, { 0x20u } },
    { 216, 32, 0, 0xaec835e9u, { 0x40u } },
    { 217, 32, 0, 0x95075bc5u, { 0x40u } },
    { 218, -2, 0, 0x00000000u, { 0x40u } },
    { 219, -2, 0, 0x00000000u, { 0x40u } },
    { 220, 0, 0, 0x72282aadu, { 0x80u } },
    { 221, 0, 0, 0xf227612du, { 0x80u } },
    { 222, 0, 0, 0x6dbc9d0bu, { 0x80u } },
    { 223, 0, 0, 0xedbbd38bu, { 0x80u } },
    { 224, 0, 0, 0x4b2a4c63u, { 0x80u } },
    { 225, 0, 0, 0xcb2982e3u, { 0x80u } },
    { 226, 0, 0, 0xaf14ed94u, { 0x80u } },
    { 227, 0, 0, 0x2f142414u, { 0x80u } },
    { 228, 0, 0, 0xe25220bbu, { 0x80u } },
    { 229, 0, 0, 0x6252ea3bu, { 0x80u } },
    { 230, 0, 0, 0x45f6a788u, { 0x400u } },
    { 231, 0, 0, 0x66f2bedfu, { 0x400u } },
    { 232, 0, 0, 0x4efed8e5u, { 0x400u } },
    { 233, 0, 0, 0x778bb7c6u, { 0x400u } },
    { 234, 0, 0, 0x20f0410du, { 0x400u } },
    { 235, 0, 0, 0x7d84e86au, { 0x400u } },
    { 236, -5, 0, 0x00000000u, { 0x400u } },
    { 237, -5, 0, 0x00000000u, { 0x400u } },
    { 238, -5, 0, 0x00000000u, { 0x400u } },
    { 239, -5, 0, 0x00000000u, { 0x400u } },
    { 240, -5, 0, 0x00000000u, { 0x400u } },
    { 241, -5, 0, 0x00000000u, { 0x400u } },
    { 242, -5, 0, 0x00000000u, { 0x400u } },
    { 243, -5, 0, 0x00000000u, { 0x400u } },
    { 244, 0, 0, 0x8010280bu, { 0x400u } },
    { 245, 0, 0, 0x3d19090au, { 0x400u } },
    { 246, 0, 0, 0x8c9f1d9du, { 0x400u } },
    { 247, 0, 0, 0x2c5df8dcu, { 0x400u } },
    { 248, 0, 0, 0x20aa110eu, { 0x400u } },
    { 249, 0, 0, 0x5194e811u, { 0x400u } },
    { 250, 0, 0, 0x0be66f74u, { 0x400u } },
    { 251, 0, 0, 0xef360c97u, { 0x400u } },
    { 252, 0, 0, 0x37e41a43u, { 0x400u } },
    { 253, 0, 0, 0x651f6e64u, { 0x400u } },
    { 254, 73, 0, 0xafd2e059u, { 0x2000u } },
    { 255, 75, 0, 0x261dcf79u, { 0x2000u } },
    { 256, 76, 0, 0x7bbab766u, { 0x2000u } },
    { 257, 76, 0, 0x12579aa5u, { 0x2000u } },
    { 258, 76, 0, 0x40c5f86bu, { 0x2000u } },
    { 259, 72, 0, 0xe5a1cfb4u, { 0x2000u } },
    { 260, 72, 0, 0xe5a1cfb4u, { 0x2000u } },
    { 261, 72, 0, 0xe5a1cfb4u, { 0x2000u } },
    { 262, 72, 0, 0xe5a1cfb4u, { 0x2000u } },
    { 263, 72, 0, 0xe5a1cfb4u, { 0x2000u } },
    { 264, 72, 0, 0x8578e179u, { 0x2000u } },
    { 265, 72, 0, 0x805a3945u, { 0x2000u } },
    { 266, 72, 0, 0x4593773cu, { 0x2000u } },
    { 267, 72, 0, 0xe5a1cfb4u, { 0x2000u } },
    { 268, 72, 0, 0xe5a1cfb4u, { 0x2000u } },
    { 269, 72, 0, 0xe5a1cfb4u, { 0x2000u } },
    { 270, 72, 0, 0xe5a1cfb4u, { 0x2000u } },
    { 271, 88, 1, 0x20cb3941u, { 0x2000u } },
    { 254, 64, 0, 0xe537b84cu, { 0x4000u } },
    { 255, 64, 0, 0x5c2331ebu, { 0x4000u } },
    { 272, 64, 0, 0xe537b84cu, { 0x4000u } },
    { 273, 64, 0, 0xe537b84cu, { 0x4000u } },
    { 274, 64, 0, 0xe537b84cu, { 0x4000u } },
    { 259, 64, 0, 0xe537b84cu, { 0x4000u } },
    { 260, 64, 0, 0xe537b84cu, { 0x4000u } },
    { 261, 64, 0, 0xe537b84cu, { 0x4000u } },
    { 262, 64, 0, 0xe537b84cu, { 0x4000u } },
    { 263, 64, 0, 0xe537b84cu, { 0x4000u } },
    { 264, 64, 0, 0x4d79a8fbu, { 0x4000u } },
    { 265, 64, 0, 0x80c0203fu, { 0x4000u } },
    { 266, 64, 0, 0x58a04f87u, { 0x4000u } },
    { 267, 64, 0, 0xe537b84cu, { 0x4000u } },
    { 268, 64, 0, 0xe537b84cu, { 0x4000u } },
    { 269, 64, 0, 0xe537b84cu, { 0x4000u } },
    { 270, 64, 0, 0xe537b84cu, { 0x4000u } },
    { 271, -3, 1, 0x00000000u, { 0x4000u } },
    { 254, 65, 0, 0xc4ee25dau, { 0x8000u } },
    { 255, 75, 0, 0x800257b9u, { 0x8000u } },
    { 275, 76, 0, 0x7169fa61u, { 0x8000u } },
    { 276, 76, 0, 0x3d897c73u, { 0x8000u } },
    { 277, 12, 0, 0x2704705bu, { 0x8000u } },
    { 259, 64, 0, 0x573ce38fu, { 0x8000u } },
    { 260, 64, 0, 0x573ce38fu, { 0x8000u } },
    { 261, 64, 0, 0x573ce38fu, { 0x8000u } },
    { 262, 64, 0, 0x573ce38fu, { 0x8000u } },
    { 263, 64, 0, 0x573ce38fu, { 0x8000u } },
    { 278, 0, 0, 0xf0f4ce95u, { 0x8000u } },
    { 279, 64, 0, 0xf8ebd886u, { 0x8000u } },
    { 280, 64, 0, 0x9de2fa40u, { 0x8000u } },
    { 267, 64, 0, 0x573ce38fu, { 0x8000u } },
    { 268, 64, 0, 0x573ce38fu, { 0x8000u } },
    { 269, 64, 0, 0x573ce38fu, { 0x8000u } },
    { 270, 64, 0, 0x573ce38fu, { 0x8000u } },
    { 271, 88, 1, 0xbe242a4au, { 0x8000u } },
    { 254, 64, 0, 0x486d7f4cu, { 0x10000u } },
    { 255, 64, 0, 0xf0549bc6u, { 0x10000u } },
    { 281, 64, 0, 0x486d7f4cu, { 0x10000u } },
    { 282, 64, 0, 0x486d7f4cu, { 0x10000u } },
    { 283, 64, 0, 0x486d7f4cu, { 0x10000u } },
    { 259, 64, 0, 0x486d7f4cu, { 0x10000u } },
    { 260, 64, 0, 0x486d7f4cu, { 0x10000u } },
    { 261, 64, 0, 0x486d7f4cu, { 0x10000u } },
    { 262, 64, 0, 0x486d7f4cu, { 0x10000u } },
    { 263, 64, 0, 0x486d7f4cu, { 0x10000u } },
    { 278, 0, 0, 0xd38d50beu, { 0x10000u } },
    { 279, 64, 0, 0x91673aedu, { 0x10000u } },
    { 280, 64, 0, 0x2383a409u, { 0x10000u } },
    { 267, 64, 0, 0x486d7f4cu, { 0x10000u } },
    { 268, 64, 0, 0x486d7f4cu, { 0x10000u } },
    { 269, 64, 0, 0x486d7f4cu, { 0x10000u } },
    { 270, 64, 0, 0x486d7f4cu, { 0x10000u } },
    { 271, -3, 1, 0x00000000u, { 0x10000u } },
    { 254, 12, 0, 0xab92c901u, { 0x20000u } },
    { 255, 12, 0, 0xab92c901u, { 0x20000u } },
    { 284, 12, 0, 0xab92c901u, { 0x20000u } },
    { 285, 12, 0, 0x6074718au, { 0x20000u } },
    { 286, 12, 0, 0xab92c901u, { 0x20000u } },
    { 287, 12, 0, 0x732eaec1u, { 0x20000u } },
    { 288, 12, 0, 0xab92c901u, { 0x20000u } },
    { 289, 12, 0, 0x50e05482u, { 0x20000u } },
    { 259, 12, 0, 0xab92c901u, { 0x20000u } },
    { 260, 12, 0, 0xab92c901u, { 0x20000u } },
    { 261, 12, 0, 0xa451a809u, { 0x20000u } },
    { 262, 12, 0, 0xec0f3bdeu, { 0x20000u } },
    { 263, 12, 0, 0xc538653au, { 0x20000u } },
    { 278, 0, 0, 0x7dcd578bu, { 0x20000u } },
    { 279, 12, 0, 0x41a61babu, { 0x20000u } },
    { 280, 12, 0, 0x034a1c1fu, { 0x20000u } },
    { 267, 12, 0, 0xab92c901u, { 0x20000u } },
    { 268, 12, 0, 0xab92c901u, { 0x20000u } },
    { 269, 12, 0, 0xab92c901u, { 0x20000u } },
    { 270, 12, 0, 0xab92c901u, { 0x20000u } },
    { 271, 12, 1, 0x93bd0c16u, { 0x20000u } },
    { 290, 0, 0, 0x31f5db1fu, { 0x80000u } },
    { 291, 0, 0, 0x3d2a9dddu, { 0x80000u } },
    { 290, 0, 0, 0x5666b27fu, { 0x100000u } },
    { 291, -4, 0, 0x00000000u, { 0x100000u } },
    { 290, 0, 0, 0x5046956eu, { 0x200000u } },
    { 291, -4, 0, 0x00000000u, { 0x200000u } },
    { 216, 32, 0, 0x422ce762u, { 0x2000000u } },
    { 217, 32, 0, 0x193a5172u, { 0x2000000u } },
    { 218, -2, 0, 0x00000000u, { 0x2000000u } },
    { 219, -2, 0, 0x00000000u, { 0x2000000u } },
    { 216, 32, 0, 0x5cab1568u, { 0x4000000u } },
    { 217, 32, 0, 0x967df6a8u, { 0x4000000u } },
    { 218, -2, 0, 0x00000000u, { 0x4000000u } },
    { 219, -2, 0, 0x00000000u, { 0x4000000u } },
};

/* Makes all trials of one function, and leaves out each pointer in turn; returns how many are wrong. */
static uint32_t run_trials(int number)
{
    static eye4_table prepared;
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
                prepared = eye4_default;  /* prepare keeps what is not of the bodies */
                (void)eye4_prepare(&parameters, &prepared);
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
        if (status != (int)EYE4_BAD_ARGUMENT || sum.touched != 0) {
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
    volatile eye4_real x = 0.7;
    const eye4_real whole = (x + 6755399441055744.0) - 6755399441055744.0;
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
    const eye4_real *numbers = f->numbers;
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
int eye4_selftest(void (*print)(const char *text), unsigned long sweep)
{
    int failures = 0;
    length = 0u;
    (void)eye4_prepare_mounts(&eye4_default_parameters, &mounting);
    if (EXCESS != 0 || rounds_to_integer() == 0) {
        add_text("wrong results: compiled with ");
        add_text(EXCESS != 0 ? "x87 arithmetic, without -msse2 -mfpmath=sse"
                             : "-ffast-math, -Ofast, -funsafe-math-optimizations or a part of them");
        end_line(print);
    }
    add_text("mahovik selftest eye4 structure 59c20951 physics 7b9ac829 real double");
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

#ifdef EYE4_SELFTEST_MAIN
static void print_text(const char *text)
{
    (void)fputs(text, stdout);
}

int main(void)
{
    return eye4_selftest(print_text, EYE4_SELFTEST_SWEEP) != 0;
}
#endif
