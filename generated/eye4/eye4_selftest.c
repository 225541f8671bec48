/* eye4_selftest.c: does eye4.c give the right bits on this machine?
 * With -ffast-math or its parts it gives wrong results with status OK: this test fails.
 * mahovik 0.1.0; structure 59c20951, physics 2efca783. Generated: change the stand file instead.
 *
 * Compile it with eye4.c as firmware is compiled (-std=c99 -ffp-contract=off; -fno-tree-vectorize as well by gcc
 * for x86-64 with FMA and for a Cortex-M55, or bits differ) and run it; on a board, define
 * EYE4_SELFTEST_NO_MAIN and call eye4_selftest with a function that prints a text, such as to a serial port.
 * Golden vectors: inputs and answers of the generator's interpreter as hexadecimal constants; each bit must agree.
 * Sweep: states drawn by an integer generator; one hash per function of all its answers is printed, to be
 * compared between machines. The log of a board is judged by `mahovik judge-log STAND.toml --log LOG`. It reads:
 *
 *     wrong results: compiled with ...   only if that is so: first, and then functions FAIL
 *     mahovik selftest eye4 structure 59c20951 physics 2efca783 real double
 *     generator mahovik 0.1.0
 *     forward PASS cases 4 worst 0 ulp      one line per function; FAIL gives the number of wrong cases and
 *                                        what is wrong of them, such as "(status, numbers)"; with numbers worst is
 *                                        their largest distance, or "more than 1000000"
 *     sweep 100                          states
 *     forward 0123abcd                   one line per function: FNV-1a hash of its statuses and outputs
 *     failures 0                         functions that failed; the last line
 *
 * No allocation. It keeps inputs and results in static memory: one caller at a time. */
#include "eye4.h"

#include <stddef.h>
#include <stdint.h>
#ifndef EYE4_SELFTEST_NO_MAIN
#include <stdio.h>
#endif

#if EYE4_STRUCTURE != 0x59c20951u || EYE4_PHYSICS != 0x2efca783u
#error "eye4.h and eye4_selftest.c are of different stands"
#endif
#if EYE4_LANES != 1
#error "eye4.h and eye4_selftest.c were generated for different numbers of lanes"
#endif

#ifndef EYE4_SELFTEST_SWEEP
#define EYE4_SELFTEST_SWEEP 100ul  /* states of the sweep that main runs */
#endif

int eye4_selftest(void (*print)(const char *text), unsigned long sweep);

typedef uint64_t real_bits;

enum { CASES = 3, FUNCTIONS = 29, SWEPT = 1 };

#define FAR ((real_bits)1000000u)  /* ulp: a worse distance is not printed as a number */

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
static eye4_mount_table mounting;

static union {
    struct { eye4_real V_dot[6]; } forward;
    struct { eye4_real F[6]; } wrench;
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
    struct { eye4_real center_of_mass_velocity[3]; } center_of_mass_velocity;
    unsigned char bytes[1];
} results;

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

static void untouched(tally *sum, const void *place, size_t size)
{
    const unsigned char *bytes = place;
    for (size_t i = 0; i < size; ++i) {
        sum->touched += bytes[i] != (unsigned char)UNTOUCHED ? 1 : 0;
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
    return eye4_forward(&eye4_default, &in.x, in.phi_ddot, in.wrench, results.forward.V_dot);
}

static void take_forward_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.forward.V_dot, sizeof results.forward.V_dot);
        return;
    }
    take_reals(sum, results.forward.V_dot, 6);
}

static eye4_status call_wrench(void)
{
    return eye4_wrench(&in.x, in.wrench, results.wrench.F);
}

static void take_wrench_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.wrench.F, sizeof results.wrench.F);
        return;
    }
    take_reals(sum, results.wrench.F, 6);
}

static eye4_status call_matrices(void)
{
    return eye4_matrices(&eye4_default, &in.x, in.wrench, &results.matrices.out);
}

static void take_matrices_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.matrices.out, sizeof results.matrices.out);
        return;
    }
    take_matrices_result(sum, &results.matrices.out);
}

static eye4_status call_momentum(void)
{
    return eye4_momentum(&eye4_default, &in.x, &results.momentum.out);
}

static void take_momentum_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.momentum.out, sizeof results.momentum.out);
        return;
    }
    take_momentum_result(sum, &results.momentum.out);
}

static eye4_status call_torque(void)
{
    return eye4_torque(&eye4_default, &in.x, in.V_dot, in.phi_ddot, in.wrench, results.torque.tau);
}

static void take_torque_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.torque.tau, sizeof results.torque.tau);
        return;
    }
    take_reals(sum, results.torque.tau, EYE4_N);
}

static eye4_status call_coupled(void)
{
    return eye4_coupled(&eye4_default, &in.x, in.tau, in.locked, in.wrench, results.coupled.V_dot,
        results.coupled.phi_ddot);
}

static void take_coupled_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.coupled.V_dot, sizeof results.coupled.V_dot);
        untouched(sum, &results.coupled.phi_ddot, sizeof results.coupled.phi_ddot);
        return;
    }
    take_reals(sum, results.coupled.V_dot, 6);
    take_reals(sum, results.coupled.phi_ddot, EYE4_N);
}

static eye4_status call_step(void)
{
    return eye4_step(&eye4_default, &in.x, in.tau, in.locked, in.wrench, in.dt, in.order, &results.step.next);
}

static void take_step_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.step.next, sizeof results.step.next);
        return;
    }
    take_state(sum, &results.step.next);
}

static eye4_status call_step_driven(void)
{
    return eye4_step_driven(&eye4_default, &in.x, in.phi_ddot, in.wrench, in.dt, in.order,
        &results.step_driven.next);
}

static void take_step_driven_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.step_driven.next, sizeof results.step_driven.next);
        return;
    }
    take_state(sum, &results.step_driven.next);
}

static eye4_status call_wrap(void)
{
    return eye4_wrap(in.phi, &results.wrap.wrapped);
}

static void take_wrap_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.wrap.wrapped, sizeof results.wrap.wrapped);
        return;
    }
    take_reals(sum, &results.wrap.wrapped, 1);
}

static eye4_status call_phase_of_counts(void)
{
    return eye4_phase_of_counts(in.count, in.per_turn, in.zero, &results.phase_of_counts.phi);
}

static void take_phase_of_counts_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.phase_of_counts.phi, sizeof results.phase_of_counts.phi);
        return;
    }
    take_reals(sum, &results.phase_of_counts.phi, 1);
}

static eye4_status call_speed_of_counts(void)
{
    return eye4_speed_of_counts(in.moved, in.per_turn, in.dt, &results.speed_of_counts.phi_dot);
}

static void take_speed_of_counts_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.speed_of_counts.phi_dot, sizeof results.speed_of_counts.phi_dot);
        return;
    }
    take_reals(sum, &results.speed_of_counts.phi_dot, 1);
}

static eye4_status call_accumulate(void)
{
    results.accumulate.encoder = in.encoder;
    return eye4_accumulate(&results.accumulate.encoder, in.counter, in.bits, in.per_turn);
}

static void take_accumulate_results(tally *sum, eye4_status status)
{
    (void)status;
    take_encoder(sum, &results.accumulate.encoder);
}

static eye4_status call_forward_jacobian(void)
{
    return eye4_forward_jacobian(&eye4_default, &in.x, in.phi_ddot, in.wrench, &results.forward_jacobian.out);
}

static void take_forward_jacobian_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.forward_jacobian.out, sizeof results.forward_jacobian.out);
        return;
    }
    take_forward_jacobian_result(sum, &results.forward_jacobian.out);
}

static eye4_status call_coupled_jacobian(void)
{
    return eye4_coupled_jacobian(&eye4_default, &in.x, in.tau, in.locked, in.wrench,
        &results.coupled_jacobian.out);
}

static void take_coupled_jacobian_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.coupled_jacobian.out, sizeof results.coupled_jacobian.out);
        return;
    }
    take_coupled_jacobian_result(sum, &results.coupled_jacobian.out);
}

static eye4_status call_inverse(void)
{
    return eye4_inverse(&eye4_default, &in.x, in.V_dot, &eye4_default_options, in.wrench,
        &results.inverse.out);
}

static void take_inverse_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.inverse.out, sizeof results.inverse.out);
        return;
    }
    take_inverse_result(sum, &results.inverse.out);
}

static eye4_status call_inverse_fast(void)
{
    return eye4_inverse_fast(&eye4_default, &in.x, in.V_dot, &eye4_default_options, in.wrench,
        results.inverse_fast.phi_ddot);
}

static void take_inverse_fast_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.inverse_fast.phi_ddot, sizeof results.inverse_fast.phi_ddot);
        return;
    }
    take_reals(sum, results.inverse_fast.phi_ddot, EYE4_N);
}

static eye4_status call_inverse_pointing(void)
{
    return eye4_inverse_pointing(&eye4_default, &in.x, in.demand, &eye4_default_options, in.wrench,
        &results.inverse_pointing.out);
}

static void take_inverse_pointing_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.inverse_pointing.out, sizeof results.inverse_pointing.out);
        return;
    }
    take_inverse_pointing_result(sum, &results.inverse_pointing.out);
}

static eye4_status call_inverse_fast_pointing(void)
{
    return eye4_inverse_fast_pointing(&eye4_default, &in.x, in.demand, &eye4_default_options, in.wrench,
        results.inverse_fast_pointing.phi_ddot);
}

static void take_inverse_fast_pointing_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.inverse_fast_pointing.phi_ddot,
            sizeof results.inverse_fast_pointing.phi_ddot);
        return;
    }
    take_reals(sum, results.inverse_fast_pointing.phi_ddot, EYE4_N);
}

static eye4_status call_torque_for_pointing(void)
{
    return eye4_torque_for_pointing(&eye4_default, &in.x, in.demand, &eye4_default_options, in.locked,
        in.wrench, &results.torque_for_pointing.out);
}

static void take_torque_for_pointing_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.torque_for_pointing.out, sizeof results.torque_for_pointing.out);
        return;
    }
    take_torque_for_pointing_result(sum, &results.torque_for_pointing.out);
}

static eye4_status call_points(void)
{
    return eye4_points(&eye4_default, &in.x, in.V_dot, results.points.out);
}

static void take_points_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.points.out, sizeof results.points.out);
        return;
    }
    for (int i = 0; i < EYE4_SENSORS; ++i) {
        take_points_result(sum, &results.points.out[i]);
    }
}

static eye4_status call_quaternion(void)
{
    return eye4_quaternion(in.angles, results.quaternion.attitude);
}

static void take_quaternion_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.quaternion.attitude, sizeof results.quaternion.attitude);
        return;
    }
    take_reals(sum, results.quaternion.attitude, 4);
}

static eye4_status call_state_from_coordinates(void)
{
    results.state_from_coordinates.x = in.x;
    return eye4_state_from_coordinates(in.position, in.angles, in.q_dot, in.q_ddot,
        &results.state_from_coordinates.x, results.state_from_coordinates.V_dot);
}

static void take_state_from_coordinates_results(tally *sum, eye4_status status)
{
    take_state(sum, &results.state_from_coordinates.x);
    if (status < 0) {
        untouched(sum, &results.state_from_coordinates.V_dot, sizeof results.state_from_coordinates.V_dot);
        return;
    }
    take_reals(sum, results.state_from_coordinates.V_dot, 6);
}

static eye4_status call_generalized(void)
{
    return eye4_generalized(&eye4_default, &in.x, in.angles, in.phi_ddot, in.wrench,
        &results.generalized.out);
}

static void take_generalized_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.generalized.out, sizeof results.generalized.out);
        return;
    }
    take_generalized_result(sum, &results.generalized.out);
}

static eye4_status call_prepare(void)
{
    results.prepare.table = eye4_default;
    return eye4_prepare(&parameters, &results.prepare.table);
}

static void take_prepare_results(tally *sum, eye4_status status)
{
    (void)status;
    take_table(sum, &results.prepare.table);
}

static eye4_status call_mounts(void)
{
    return eye4_mounts(&mounting, &in.x, in.V_dot, in.phi_ddot, in.wrench, results.mounts.mount_wrench);
}

static void take_mounts_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.mounts.mount_wrench, sizeof results.mounts.mount_wrench);
        return;
    }
    take_reals(sum, results.mounts.mount_wrench, 24);
}

static eye4_status call_prepare_mounts(void)
{
    return eye4_prepare_mounts(&parameters, &results.prepare_mounts.mounting);
}

static void take_prepare_mounts_results(tally *sum, eye4_status status)
{
    if (status < 0) {
        untouched(sum, &results.prepare_mounts.mounting, sizeof results.prepare_mounts.mounting);
        return;
    }
    take_mount_table(sum, &results.prepare_mounts.mounting);
}

static eye4_status call_step_carried(void)
{
    results.step_carried.carry = in.carry;
    return eye4_step_carried(&eye4_default, &in.x, in.tau, in.locked, in.wrench, in.dt, in.order,
        &results.step_carried.carry, &results.step_carried.next);
}

static void take_step_carried_results(tally *sum, eye4_status status)
{
    take_step_carry(sum, &results.step_carried.carry);
    if (status < 0) {
        untouched(sum, &results.step_carried.next, sizeof results.step_carried.next);
        return;
    }
    take_state(sum, &results.step_carried.next);
}

static eye4_status call_step_driven_carried(void)
{
    results.step_driven_carried.carry = in.carry;
    return eye4_step_driven_carried(&eye4_default, &in.x, in.phi_ddot, in.wrench, in.dt, in.order,
        &results.step_driven_carried.carry, &results.step_driven_carried.next);
}

static void take_step_driven_carried_results(tally *sum, eye4_status status)
{
    take_step_carry(sum, &results.step_driven_carried.carry);
    if (status < 0) {
        untouched(sum, &results.step_driven_carried.next, sizeof results.step_driven_carried.next);
        return;
    }
    take_state(sum, &results.step_driven_carried.next);
}

static eye4_status call_center_of_mass_velocity(void)
{
    return eye4_center_of_mass_velocity(&eye4_default, &in.x,
        results.center_of_mass_velocity.center_of_mass_velocity);
}

static void take_center_of_mass_velocity_results(tally *sum, eye4_status status)
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
    0x1.03577d0a6ac49p+0, 0x1.5033710c7cab3p-2, -0x1.547ccf1bac2c4p+1, -0x1.91517203b1de9p-2,
        0x1.7dd9b9e2c8fa6p-4, -0x1.3d291456b8a13p-1,
    -0x1.b164c4bb0e0f1p+5, 0x1.496fd3be4c36ap+4, 0x1.5b5c1cd0e9079p+5, 0x1.d77ad07c814bap+3,
        0x1.32051336f60abp+4, -0x1.fcec89235c0d3p+5,
};

static const eye4_real numbers_wrench[] =
{
    -0x1.94148p-2, -0x1.f4583p+2, 0x1.9e47c8p+1, -0x1.39c4f8p+2, 0x1.44d50cp+2, -0x1.7d815p+1,
    0x1.a3f8a8p+2, 0x1.882d1p+0, 0x1.4d94ap+0, -0x1.c47ac4p+2, 0x1.1746e8p+2, 0x1.037d6p+1,
};

static const eye4_real numbers_matrices[] =
{
    0x1.4000000000001p+6, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.168b0d6840ce9p-4, 0x1.3c3521a6e8811p-2, 0x0p+0,
        0x1.4000000000001p+6, 0x0p+0, 0x1.168b0d6840ce9p-4, 0x0p+0, 0x1.8b4391f102b37p-2, 0x0p+0, 0x0p+0,
        0x1.4000000000001p+6, -0x1.3c3521a6e8811p-2, -0x1.8b4391f102b37p-2, 0x0p+0, 0x0p+0,
        0x1.168b0d6840ce9p-4, -0x1.3c3521a6e8811p-2, 0x1.b64c7f93cced5p+2, 0x1.f830b44deacfdp-5,
        -0x1.675413a9fba04p-5, -0x1.168b0d6840ce9p-4, 0x0p+0, -0x1.8b4391f102b37p-2, 0x1.f830b44deacfdp-5,
        0x1.ab76c52ddfd6bp+2, 0x1.b2eae198248f2p-5, 0x1.3c3521a6e8811p-2, 0x1.8b4391f102b37p-2,
    0x1.4000000000001p+6, 0x0p+0, 0x0p+0, 0x0p+0, -0x1.168a7d0461176p-4, 0x1.3c343cbbc4a16p-2, 0x0p+0,
        0x1.4000000000001p+6, 0x0p+0, 0x1.168a7d0461176p-4, 0x0p+0, 0x1.8b4237d2ce40dp-2, 0x0p+0, 0x0p+0,
        0x1.4000000000001p+6, -0x1.3c343cbbc4a16p-2, -0x1.8b4237d2ce40dp-2, 0x0p+0, 0x0p+0,
        0x1.168a7d0461176p-4, -0x1.3c343cbbc4a16p-2, 0x1.b64ca4508a99bp+2, 0x1.f82f25f32bf2fp-5,
        -0x1.675e1ec1385fbp-5, -0x1.168a7d0461176p-4, 0x0p+0, -0x1.8b4237d2ce40dp-2, 0x1.f82f25f32bf2fp-5,
        0x1.ab76a233de482p+2, 0x1.b2f8d9df1b4fdp-5, 0x1.3c343cbbc4a16p-2, 0x1.8b4237d2ce40dp-2,
};

static const eye4_real numbers_momentum[] =
{
    0x1.ffdda281baad3p+6, 0x1.30c133879919ap+7, 0x1.1f5389812c2aap+6, 0x1.aa058ef04c22p+3,
        0x1.ee813163eef23p+1, 0x1.250712db3914cp+2, 0x1.2f5e9c1538e01p+5, -0x1.42940e0cdb80ep+4,
        0x1.9e4adc09b283dp+7, 0x1.320012b2a8e5ap+8, 0x1.1f5a29b384e76p+7, -0x1.d615a6aea8c98p+4,
        0x1.870db957ec85ap+8, 0x1.3c360e5a688f8p-8, -0x1.f9ee9c3e40ce6p-9, -0x1.bdab48a6ce173p-11,
    -0x1.0ec09dae13418p+9, -0x1.4b1c729761d2ep+7, -0x1.b4c9f4e521d89p+8, 0x1.240ba06eff97fp+5,
        -0x1.b9a66ab5a8074p+1, 0x1.e94b421a92e38p+2, -0x1.9cb7effb267p+8, -0x1.23f7535b17c3bp+9,
        0x1.4b5c85e8b5fap+3, 0x1.0f81efac63957p+8, -0x1.f06b70bce33eep+6, 0x1.9baa1d0459d2ap+10,
        0x1.3626b6ea481fp+18, 0x1.3c34f97571cd6p-8, -0x1.f9ed2df93a9bbp-9, -0x1.bdaa61a09b588p-11,
};

static const eye4_real numbers_torque[] =
{
    -0x1.67026e8bf9f74p-1, 0x1.89cb971078225p-1, 0x1.2149f88f36603p-5, 0x1.f0749d481028ap-3,
    0x1.28c99d8cd5f3dp-2, -0x1.262c1ee507e7ap-2, 0x1.604e97bdc5011p-2, -0x1.3e1ee497be468p-1,
};

static const eye4_real numbers_coupled[] =
{
    0x1.0353cefe744a4p+0, 0x1.508cb76163aa2p-2, -0x1.54beb010b9d25p+1, -0x1.5beb535ee4708p-1,
        -0x1.38e9447d92e9p-4, -0x1.45cc0dbd13a1ep-1, 0x1.33a41243fdc9bp+10, -0x1.0faef894a4b83p+9, 0x0p+0,
        -0x1.9ff70fea9e5d6p+8,
    -0x1.b161d9ac176e9p+5, 0x1.497818416cab4p+4, 0x1.5b59672aa23a5p+5, 0x1.cef1799174399p+3,
        0x1.310e39e5852f1p+4, -0x1.ffde9d0bdaae1p+5, 0x1.2a72535dbd4ccp+10, 0x0p+0, 0x0p+0,
        0x1.cfa5a613be9f6p+8,
};

static const eye4_real numbers_step[] =
{
    -0x1.779a17a0fcb1p-1, 0x1.80b85a98a5a5fp+0, -0x1.10f68362c4defp-4, 0x1.23d5bc19f87b2p-1,
        -0x1.2f86cb52c128dp-5, -0x1.fa5f05462a0cep-2, -0x1.4f6e308ff74eap-1, 0x1.98d1c15b5bbbfp+0,
        0x1.e628985da8744p+0, 0x1.d113fc1d3f3cdp-1, 0x1.f3ecfc1a217f8p+0, 0x1.462ed3761a23ep-1,
        0x1.aacd80dae3153p-1, -0x1.0c625f4b38f26p-3, 0x1.481b27897ce2cp+1, -0x1.256d9c58p+1,
        -0x1.a3cc53dd5a709p-1, -0x1.cf77cb7da3c9fp+7, -0x1.e117c5df81bf6p+6, -0x1.c61c58p+7,
        -0x1.3caffdc3ee51fp+4,
    -0x1.f8df4ace9230fp+0, 0x1.3b6b71cb65fcbp+0, 0x1.8fd41f03b3675p-2, -0x1.cba1ff64db947p-1,
        0x1.e221d3dbfa0ebp-3, -0x1.e256f1eba30bfp-3, -0x1.2762010e338a6p-2, -0x1.b2fa2068e84b7p+2,
        -0x1.0c687894f9c26p+1, -0x1.5e286363165afp+2, 0x1.d5e3000dbbb48p+1, -0x1.6b2583284812p+2,
        0x1.4957059f8a40dp+2, -0x1.ca9b72efd327cp-3, 0x1.9ff73922f528dp+0, -0x1.28fa31c44739cp-1,
        0x1.51e376b62fb9fp+1, 0x1.33df6bef6972ap+13, -0x1.4256p+6, -0x1.923cb8p+13, -0x1.678227320bc53p+13,
};

static const eye4_real numbers_step_driven[] =
{
    -0x1.779a17a1021a9p-1, 0x1.80b85a98a8502p+0, -0x1.10f68362a905bp-4, 0x1.23d5bc1ad0ba8p-1,
        -0x1.2f86cb309d388p-5, -0x1.fa5f05479f4bdp-2, -0x1.4f6e308ecd319p-1, 0x1.98d1c168d44aap+0,
        0x1.e62898067ddccp+0, 0x1.d11400370e71dp-1, 0x1.f3ee229fe3be6p+0, 0x1.46302edba4005p-1,
        0x1.aacda36dd894ep-1, -0x1.0c640424af9eep-3, 0x1.481b37656949fp+1, -0x1.256d9c0abb4p+1,
        -0x1.a3cc30902f33ep-1, -0x1.cfac66ac8p+7, -0x1.e0d8562dcp+6, -0x1.c61bbd768p+7, -0x1.3c22c917p+4,
    -0x1.f8df4ace90ec6p+0, 0x1.3b6b71cb63538p+0, 0x1.8fd41f03c71abp-2, -0x1.cba1ff6465a3cp-1,
        0x1.e221d3d218086p-3, -0x1.e256f1f29ac0cp-3, -0x1.2762011241daep-2, -0x1.b2fa20c699adep+2,
        -0x1.0c68799c54449p+1, -0x1.5e2863093334p+2, 0x1.d5e3872ee4f1p+1, -0x1.6b2573c747c16p+2,
        0x1.495762deb8b8ep+2, -0x1.ca9c733d5b858p-3, 0x1.9ff7343604c8dp+0, -0x1.28fa254ce4b9cp-1,
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
    -0x1.46cfa63923323p-57, 0x1.aad298p-1, -0x1.462f7p-1, 0x1.7c083bd0f3692p-9, -0x1.ca563e1c0d0d8p-1,
        0x1.e884eeb0865cap+0, -0x1.aad298p-1, 0x1.a598a4dbccf5ep-58, 0x1.f3efb4p+0, 0x1.c7e0d144692b8p-1,
        -0x1.3625223df761p-7, -0x1.9a5731ade7a74p+0, 0x1.462f7p-1, -0x1.f3efb4p+0, -0x1.d818c5384e41p-59,
        -0x1.e87867059c58ap+0, 0x1.99adcc9e873edp+0, -0x1.2da5af07168cdp-7, 0x1.cfefd8477925p-58,
        -0x1.1bb71c7ec6eep-57, -0x1.7c385a2f1eed4p-51, 0x1.d5e8b8476bcb2p-7, 0x1.46d978b49ae61p-2,
        0x1.9cdc11da6c3b9p-3, 0x1.5e9ba4353433fp-51, 0x1.d8714e2f62b45p-58, -0x1.381ed60407202p-53,
        -0x1.773c651ffb4b8p-2, 0x1.274f819b431d6p-8, -0x1.407b01c1e84f9p-1, 0x1.5e089c9a80364p-49,
        -0x1.54ed8251af862p-50,
    0x1.fceae70f5d7c4p-58, 0x1.499108p+2, 0x1.6b399ffffffffp+2, 0x1.93c4c49d2adep-8, 0x1.5b12ec7ff51bap+2,
        -0x1.05e34ac6ab44p+1, -0x1.499108p+2, -0x1.a07b0fb381153p-55, 0x1.d5b01p+1, -0x1.5c1fe8079e73ap+2,
        -0x1.b67191ba458b1p-6, 0x1.afc41c28a2076p+2, -0x1.6b399ffffffffp+2, -0x1.d5b01p+1,
        -0x1.288478e6180ep-55, 0x1.06170915fa002p+1, -0x1.b00e5ec3cc855p+2, -0x1.4a4a787f49a46p-5,
        -0x1.404194a4bdf89p-54, 0x1.035533583da38p-51, 0x1.09508c688eb23p-50, 0x1.a513c45447f7cp-7,
        0x1.c419440972a9ap+1, 0x1.8d344cdc3097ap+1, 0x1.f3ae6cf707fa2p-49, -0x1.b5513c1dd3b6dp-54,
        -0x1.0a9738701439p-47, -0x1.d74565daa6cd3p+1, -0x1.83b1c1cc5419ap-5, -0x1.5086faac7c2d3p+1,
        -0x1.26f1e3442e13p-50, 0x1.4e5365bb0c896p-47,
};

static const eye4_real numbers_coupled_jacobian[] =
{
    -0x1.448e1e8f4d604p-57, 0x1.aad297ffffffep-1, -0x1.462f6ffffffffp-1, 0x1.7c0b74de6b0d8p-9,
        -0x1.ca5647d6e0e07p-1, 0x1.e884f07a6147ap+0, -0x1.aad2980000002p-1, 0x1.a0cbb5a94e3a2p-58,
        0x1.f3efb40000002p+0, 0x1.c7e0d72826f16p-1, -0x1.3628a15281205p-7, -0x1.9a572e2ae2641p+0,
        0x1.462f700000002p-1, -0x1.f3efb40000002p+0, -0x1.db38910f92bf4p-59, -0x1.e8786c3af2866p+0,
        0x1.99add0ac04facp+0, -0x1.2da97ad043d6bp-7, 0x1.52316284a3f0dp-56, -0x1.6f5b3301d4753p-55,
        -0x1.7fab5e2c9f03dp-51, 0x1.d7005fcc6df65p-7, 0x1.46eef54797bd1p-2, 0x1.9d0e32c5f647dp-3,
        0x1.6ac653c5f9ab3p-51, -0x1.b50d652c17bb6p-56, -0x1.3730ec2c294e3p-53, -0x1.7753d0d0d2dc8p-2,
        0x1.262c6120a9b09p-8, -0x1.40910e72ff41p-1, 0x1.5c6af53d6439bp-49, -0x1.4f68a2425bcf1p-50,
    0x1.0b13bdd5625aap-57, 0x1.499108p+2, 0x1.6b399fffffffep+2, 0x1.942574e1a3918p-8, 0x1.5b12d6fed7e7cp+2,
        -0x1.05e3652b9a019p+1, -0x1.499108p+2, -0x1.a191664c7eb1dp-55, 0x1.d5b01p+1, -0x1.5c1fc4dc5b5a4p+2,
        -0x1.b68f06ef26208p-6, 0x1.afc40b816b71p+2, -0x1.6b399fffffffep+2, -0x1.d5b00fffffffep+1,
        -0x1.29094a27677d3p-55, 0x1.0616cebbcf704p+1, -0x1.b00e5100c8a41p+2, -0x1.4a4aff15c7a95p-5,
        0x1.fcda9ebd9d5b8p-56, 0x1.0436052f21ac3p-51, 0x1.06bc1eafd9771p-50, 0x1.81dc4b2875268p-7,
        0x1.c43664b52e412p+1, 0x1.8d4475e5740d7p+1, 0x1.ea2ad98aca84p-49, -0x1.69a3b60aea037p-54,
        -0x1.0ac03c92fd924p-47, -0x1.d757b2c5a2ffcp+1, -0x1.83ef32194966bp-5, -0x1.5094fedbb0a2bp+1,
        -0x1.44ad4dc4a1f05p-50, 0x1.4f31f7edd69e2p-47,
};

static const eye4_real numbers_inverse[] =
{
    -0x1.bad6c75ea86c5p+24, 0x1.b992ce90c078p+24, -0x1.bad378c5bae98p+24, 0x1.b9ef5061655dbp+24,
        -0x1.3924f3c826e53p+10, -0x1.218c5fa56e97ep+10, -0x1.e8aa1c7a89ab4p+8, 0x1.1db59b5bd8p+0,
        0x1.839524dcacp+1, -0x1.4e5ee247e38p+3, 0x1.5acedf7a3fc03p-6, 0x1.24a3f04bac516p-6,
        0x1.1ffdbd1edb71cp-6, 0x1.56ec8713aea89p-17, 0x0p+0, -0x1.940c24ab70c6bp+2, -0x1.759a09756ab43p+2,
        -0x1.3b4281234fc99p+1, 0x1.70a5fb45962b3p-8, 0x1.f4182eaa19dbep-7, -0x1.af6f7f8654943p-5,
    0x1.c8f93bd1fcb2p+26, -0x1.c93f6e63298fcp+26, 0x1.c89343a7d8b64p+26, -0x1.caae54342f1cdp+26,
        -0x1.0c1a85fff2p+13, 0x1.7fe76f7d3628ep+12, -0x1.120b61701f74ep+9, 0x1.c3f52c876p+2,
        0x1.fd30756fbcp+2, -0x1.fd1f18bfdp+1, 0x1.5ac97a20d53b4p-6, 0x1.2477e10fd3de5p-6,
        0x1.20268e9c98c9ep-6, 0x1.cbe27f45d3e5cp-18, 0x0p+0, -0x1.d0cfe7e0cd048p+2, 0x1.4cc9b1f387eeap+2,
        -0x1.db1c9efb20bf8p-2, 0x1.87c7c23318373p-8, 0x1.b9643fe7fd5aep-8, -0x1.b95533059be6dp-9,
};

static const eye4_real numbers_inverse_fast[] =
{
    -0x1.bad6c75d1818fp+24, 0x1.b992ce8f306a8p+24, -0x1.bad378c42a29dp+24, 0x1.b9ef505fd5516p+24,
    0x1.c8f93bd194456p+26, -0x1.c93f6e62c11bcp+26, 0x1.c89343a770435p+26, -0x1.caae5433c68c6p+26,
};

static const eye4_real numbers_inverse_pointing[] =
{
    -0x1.8925539d79c91p+11, -0x1.9dfd243ca9dc5p+14, 0x1.62be0adeb4a9bp+11, 0x1.993cf8c8722a1p+14,
        0x1.04940806dcf77p+0, 0x1.53ff7ca45752bp-2, -0x1.52a805f1b7ba3p+1, -0x1.b60767fffffffp+2,
        0x1.06bc6c0000001p+3, -0x1.3b163fffffffdp-1, -0x1p-50, -0x1p-49, -0x1.8p-52, 0x1.5acede18f21f9p-6,
        0x1.24a3e7cd81c8bp-6, 0x1.1ffdbb3fe02abp-6, 0x0p+0, 0x1.70a279f5d1b4bp-2, 0x1.033091c0adbb6p-3,
        -0x1.4a4ba49be83a5p-8,
    -0x1.7558e1eca6466p+14, -0x1.3df62749f2b51p+16, -0x1.c70acee8c9f4p+16, -0x1.cc421d2d474fp+15,
        -0x1.b32bdc8de32fcp+5, 0x1.455a7cb039406p+4, 0x1.5a7268bd11e14p+5, -0x1.521380000001bp-2,
        0x1.26f5600000016p+3, -0x1.28b66fffffffep+3, 0x1.bp-50, -0x1.6p-45, -0x1p-48, 0x1.5ac9753299127p-6,
        0x1.2477dca3cdd81p-6, 0x1.20268b1f7522fp-6, 0x0p+0, 0x1.772ddc9f06608p-2, 0x1.b4d7bfce901cp-4,
        -0x1.31fd96200a85cp-8,
};

static const eye4_real numbers_inverse_fast_pointing[] =
{
    -0x1.8925539d79c94p+11, -0x1.9dfd243ca9dc2p+14, 0x1.62be0adeb4aa2p+11, 0x1.993cf8c8722a2p+14,
    -0x1.7558e1eca6464p+14, -0x1.3df62749f2b52p+16, -0x1.c70acee8c9f43p+16, -0x1.cc421d2d474eep+15,
};

static const eye4_real numbers_torque_for_pointing[] =
{
    -0x1.027be5a8f688bp-4, -0x1.4b37365d190fdp-4, 0x0p+0, 0x1.999999999999ap-4, -0x1.38af819afdbb1p+5,
        -0x1.96983209488fcp+5, 0x0p+0, 0x1.fc131e04b6da2p+5, 0x1.034cde104b5e8p+0, 0x1.5018eaa05a1f6p-2,
        -0x1.548c101dc813bp+1, -0x1.0459aba348019p-1, 0x1.834a6e89b859bp-4, -0x1.2880e017d6285p-1,
        -0x1.957c328b96ffdp+2, 0x1.03b5d722ec8f5p+3, -0x1.2955fe829d7bp-5, 0x1p+0,
    -0x1.999999999999ap-4, 0x0p+0, 0x0p+0, -0x0p+0, -0x1.6e1c90165d30ep+5, 0x0p+0, 0x0p+0,
        0x1.3afad17a66fd2p+5, -0x1.b164544941764p+5, 0x1.4970e9ec63d63p+4, 0x1.5b5c49702574fp+5,
        0x1.d6209e1f6bf0cp+3, 0x1.32c77fc65b433p+4, -0x1.fd4821ccdcd28p+5, -0x1.e0b13a1f6bf0cp+3,
        -0x1.3e999f8cb6866p+3, 0x1.b31a85ccdcd28p+5, 0x1p+0,
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
        -0x1.ebd468b439578p-5, 0x1.82fa6997ce3bp+2, 0x1.79695085faf22p+2, 0x1.0c0b677856dfap+2,
        0x1.bd22843ac929cp-5, -0x1.3d3aec7e7c06fp-5, 0x1.7ff96f7fcfc3fp-5, -0x1.4f2ca2f700b6p-19,
        0x1.4f2ca2f700b6p-19, 0x0p+0, -0x1.8306a8f96ef38p-20, -0x1.8306a8f96ef38p-20, 0x1.8306a8f96ef38p-19,
        0x1.a415cfa9a1516p-21, -0x1.8055510d9396ap-21, -0x1.1e03f4e06dd58p-24, 0x1.1e03f4e06dd58p-25,
        -0x1.9b25b0029de2bp-21, 0x1.894570b497055p-21, -0x1.2a029178623b8p-19, -0x1.1a876bfdc431cp-19,
        -0x1.d06e645e85243p-21, 0x1.d06e645e85243p-22, -0x1.dfe989d9232dfp-21, -0x1.c0f33ee3e71a7p-21,
        -0x1.59a18468f77fep-20, -0x1.59a18468f77fep-20, 0x1.59a18468f78p-19,
    0x1.65f8514000002p+6, 0x1.6e27523f59799p-7, 0x1.ba2a1eba5e356p-2, -0x1.61bb4bc84b5ddp-2,
        -0x1.3793bb74bc698p-4, 0x1.ea4e553a8bda5p+2, 0x1.de2f4be5982efp+2, 0x1.539d9bb2fac5dp+2,
        0x1.19fedea2b9d3dp-4, -0x1.91ef36f0307f4p-5, 0x1.e68007a99fa1p-5, -0x1.a8ab80f8909bap-19,
        0x1.a8ab80f8909bap-19, 0x0p+0, -0x1.ea5dd9cb63877p-20, -0x1.ea5dd9cb63877p-20, 0x1.ea5dd9cb63877p-19,
        0x1.0a2061e37283ap-20, -0x1.e6f471c0dc6e3p-21, -0x1.6a62903044c9p-24, 0x1.6a62903044c9p-25,
        -0x1.0476d7a2b1708p-20, 0x1.f24786425e947p-21, -0x1.799510a968cc2p-19, -0x1.65f7b607ac7fp-19,
        -0x1.26384f7a08847p-20, 0x1.26384f7a08847p-21, -0x1.3006fccae6abp-20, -0x1.1c69a2292a5dep-20,
        -0x1.b5eb24c8366a9p-20, -0x1.b5eb24c8366a9p-20, 0x1.b5eb24c8366aap-19,
    0x1.4000000000001p+6, 0x1.9999999999998p-7, 0x1.8b4395810624ep-2, -0x1.3c36113404ea5p-2,
        -0x1.16872b020c494p-4, 0x1.b64c90517161dp+2, 0x1.ab76aad72ea59p+2, 0x1.2f97af33b4b87p+2,
        0x1.f82b1f687b13ap-5, -0x1.674d1633482bep-5, 0x1.b2e59af9ebe9ep-5, -0x1.7ba004188699p-19,
        0x1.7ba004188699p-19, 0x0p+0, -0x1.b65a6f833b148p-20, -0x1.b65a6f833b148p-20, 0x1.b65a6f833b148p-19,
        0x1.dbcbf77ae622cp-21, -0x1.b34dabf329b2ep-21, -0x1.43f25c3de37fcp-24, 0x1.43f25c3de37f8p-25,
        -0x1.d1ac6498f706dp-21, 0x1.bd6d3ed518cedp-21, -0x1.5188320653e44p-19, -0x1.3fff753e84ba8p-19,
        -0x1.07030fb52372bp-20, 0x1.07030fb52372bp-21, -0x1.0fc76e190b07ap-20, -0x1.fc7d62a277bbap-21,
        -0x1.8777e75094fa8p-20, -0x1.8777e75094fa8p-20, 0x1.8777e75094fabp-19,
};

static const eye4_real numbers_mounts[] =
{
    0x1.c04dab80fcb83p+3, 0x1.a10ad52631109p+1, -0x1.2ca89dd27a0f3p+1, -0x1.67026e8bf9f74p-1,
        0x1.2ad46a024858ep-3, -0x1.59ba029d7220ap-2, 0x1.4fbd30830f1c2p+2, -0x1.5a82c85788cd8p+3,
        0x1.5bca58e0a9b1dp+2, 0x1.89cb971078224p-1, -0x1.e86531fe933e6p-3, -0x1.61ddcae7b66cdp-2,
        -0x1.ab597b7dd8056p+2, -0x1.4d3fac95ea62p-3, 0x1.ab421736743bbp+3, 0x1.2149f88f36638p-5,
        -0x1.47c33c7e30531p-1, 0x1.6766a0465ee64p-2, 0x1.7c56fea9c43e4p+0, 0x1.e782b3422579p+3,
        0x1.8e621caf29eb3p+2, 0x1.f0749d4810289p-3, 0x1.1783842a75a6p-10, 0x1.165bd9c9ae4ep-4,
    0x1.01e590927152ep+4, -0x1.4e0a481655712p+8, 0x1.216899b804ba8p+8, 0x1.28c99d8cd5f5ap-2,
        0x1.5267f388c42dep+6, 0x1.893fed381e4a6p+6, -0x1.01256dd7077e7p+6, -0x1.33f0bd16e88fbp+4,
        0x1.7e683aac78b85p+5, -0x1.262c1ee507ebfp-2, -0x1.0bb29401bdc74p+0, 0x1.caf51a8369f42p-3,
        -0x1.8aed48be5e0bfp+4, 0x1.420f8928c158bp+9, 0x1.708cf676e82bap+8, 0x1.604e97bdc4fb2p-2,
        -0x1.c55d10528f4a4p+5, 0x1.081aece3a65fep+7, 0x1.065a30d18f1e5p+6, 0x1.979112248eec9p+8,
        -0x1.8b2341e5f7908p+8, -0x1.3e1ee497be45ep-1, -0x1.b10a7367f3aap+2, -0x1.2535a179d1d9ap+5,
};

static const eye4_real numbers_prepare_mounts[] =
{
    0x1.3c6f3f9999999p-1, 0x0p+0, 0x1.da0214ad362e8p-19, 0x0p+0, 0x1.7059fdf15a4adp-10, 0x1.953062383bdbap-11,
        0x1.993d46c576c22p-11, -0x1.4ea193fdec813p-78, -0x1.2f5d7ddf7ed62p-24, 0x0p+0, 0x1.3333333333333p-3,
        0x1.3333333333333p-3, -0x1.3333333333333p-2, 0x1.279a74590331dp-1, -0x1.6a09e667f3bccp-1,
        -0x1.a20bd700c2c3ep-2, 0x1.279a74590331dp-1, 0x1.6a09e667f3bccp-1, -0x1.a20bd700c2c3ep-2,
        0x1.279a74590331dp-1, 0x0p+0, 0x1.a20bd700c2c3ep-1, 0x1.3c6f3f9999999p-1, 0x0p+0,
        -0x1.443d9b9d89395p-20, 0x1.bd6c0443c3502p-19, 0x1.7059fdf15a4adp-10, 0x1.953062383bdbap-11,
        0x1.993d46c576c22p-11, -0x1.f10123ad4fe3dp-25, 0x1.5c019a715c811p-25, 0x0p+0,
    0x1.90ed27cccccccp-1, 0x0p+0, 0x1.2c49784ec636bp-18, 0x0p+0, 0x1.d2b4afdb6e504p-10, 0x1.00b08d9cff54bp-10,
        0x1.03416e542ba65p-10, -0x1.a7fb50a52b66ap-78, -0x1.805e0aa24564cp-24, 0x0p+0, 0x1.3333333333333p-3,
        0x1.3333333333333p-3, -0x1.3333333333333p-2, 0x1.279a74590331dp-1, -0x1.6a09e667f3bccp-1,
        -0x1.a20bd700c2c3ep-2, 0x1.279a74590331dp-1, 0x1.6a09e667f3bccp-1, -0x1.a20bd700c2c3ep-2,
        0x1.279a74590331dp-1, 0x0p+0, 0x1.a20bd700c2c3ep-1, 0x1.90ed27cccccccp-1, 0x0p+0,
        -0x1.9ad119d0e4816p-20, 0x1.1a2d6eb4eb35dp-18, 0x1.d2b4afdb6e504p-10, 0x1.00b08d9cff54bp-10,
        0x1.03416e542ba65p-10, -0x1.3adaf4f61c3a1p-24, 0x1.b8ed9894b72dp-25, 0x0p+0,
};

static const eye4_real numbers_step_carried[] =
{
    0x1.032p-56, -0x1.35d8p-55, 0x1.cap-58, 0x1.ec1fc66p-55, -0x1.d08e99ap-59, 0x1.237d458p-57,
        0x1.9ef7a1p-57, -0x1.90cp-56, -0x1.3ebp-54, 0x1.57p-56, -0x1.e548p-54, -0x1.7p-56, -0x1.f14p-55,
        0x1.cp-57, 0x1.b8p-55, 0x0p+0, 0x1.ep-55, 0x1.afp-48, -0x1.0ap-49, -0x1p-46, -0x1.54p-50,
        -0x1.779a15e4a3d1p-1, 0x1.80b859ec544dfp+0, -0x1.10f67e0d91befp-4, 0x1.23d5bcd3ada76p-1,
        -0x1.2f86cbc9dd4ccp-5, -0x1.fa5f03c46d4a5p-2, -0x1.4f6e307f8d67cp-1, 0x1.98d1c0f453a1fp+0,
        0x1.e6289843bb264p+0, 0x1.d113fb9911e0dp-1, 0x1.f3ecfc7fc4178p+0,
    -0x1.358p-54, 0x1.9c8p-55, 0x1.9cp-57, 0x1.9538acp-55, -0x1.27743p-58, 0x1.48065p-58, -0x1.d2162p-56,
        -0x1.abp-53, 0x1.bp-55, -0x1.eb8p-52, 0x1.d58p-53, 0x1.ed8p-52, -0x1.edp-53, 0x0p+0, 0x0p+0, 0x1p-55,
        -0x1.cb3b399d747f2p-53, 0x1.3188p-41, 0x0p+0, -0x1.68p-42, 0x1.b482p-41, -0x1.f8df4a3fb6e0fp+0,
        0x1.3b6b71493278bp+0, 0x1.8fd421fbc1975p-2, -0x1.cba1fef35121ap-1, 0x1.e221d54e12c89p-3,
        -0x1.e256f34235a2ap-3, -0x1.276202ae092bep-2, -0x1.b2fa20342a3afp+2, -0x1.0c687850dd6d6p+1,
        -0x1.5e2863565e3d7p+2, 0x1.d5e2ffec72b58p+1,
    0x1.9ff9b8p-25, -0x1.12f4p-27, 0x1.69a1c8p-26, -0x1.62c19p-27, 0x1.852fp-26, 0x1.8344dp-27,
        -0x1.7420b4p-25, 0x1.2adb4p-25, -0x1.e9f6ccp-25, 0x1.2b6874p-25, 0x1.2b38a8p-26, 0x1.f96c5p-26,
        0x1.0100d8p-25, -0x1.a83864p-25, -0x1.d00b7p-25, -0x1.f6d9a8p-26, 0x1.41229cp-25, -0x1.6e7b7p-26,
        -0x1.8f755p-26, 0x1.f1e5fp-25, 0x1.661b5p-26,
};

static const eye4_real numbers_step_driven_carried[] =
{
    -0x1.63bp-55, -0x1.e5b4p-55, -0x1.3p-59, -0x1.e4a0b4cp-55, 0x1.9a145e8p-59, 0x1.8a0b3ep-56,
        0x1.220d4ap-58, -0x1.ee6p-54, -0x1.44f8p-54, -0x1.fap-58, -0x1.518p-58, -0x1.cffep-55, -0x1.d3ap-55,
        -0x1p-56, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, -0x1p-46, 0x0p+0, -0x1.779a15e4a93a9p-1,
        0x1.80b859ec56f82p+0, -0x1.10f67e0d75e5bp-4, 0x1.23d5bcd485e6ep-1, -0x1.2f86cba7b95c8p-5,
        -0x1.fa5f03c5e2895p-2, -0x1.4f6e307e634abp-1, 0x1.98d1c101cc30ap+0, 0x1.e62897ec908ecp+0,
        0x1.d113ffb2e115dp-1, 0x1.f3ee230586566p+0,
    0x1.edp-55, -0x1.03p-54, 0x1.87p-56, -0x1.9b3218p-55, -0x1.4a3488p-57, 0x1.8283dp-57, 0x1.0ff7a8p-56,
        0x1.c1p-53, 0x1.0b8p-53, 0x1.f2p-52, -0x1.4fp-54, 0x1.318p-53, 0x1.14p-55, 0x0p+0, 0x0p+0, 0x1p-55,
        -0x1.cb3b399d747f2p-53, -0x1.dcp-41, 0x0p+0, -0x1.68p-42, -0x1.ep-44, -0x1.f8df4a3fb59c6p+0,
        0x1.3b6b71492fcf8p+0, 0x1.8fd421fbd54abp-2, -0x1.cba1fef2db30ep-1, 0x1.e221d54430c26p-3,
        -0x1.e256f3492d577p-3, -0x1.276202b2177c7p-2, -0x1.b2fa2091db9d6p+2, -0x1.0c68795837ef9p+1,
        -0x1.5e2862fc7b168p+2, 0x1.d5e3870d9bf2p+1,
    0x1.9ff9b8p-25, -0x1.12f4p-27, 0x1.69a1c8p-26, -0x1.62c19p-27, 0x1.852fp-26, 0x1.8344dp-27,
        -0x1.7420b4p-25, 0x1.2adb4p-25, -0x1.e9f6ccp-25, 0x1.2b6874p-25, 0x1.2b38a8p-26, 0x1.f96c5p-26,
        0x1.0100d8p-25, -0x1.a83864p-25, -0x1.d00b7p-25, -0x1.f6d9a8p-26, 0x1.41229cp-25, -0x1.6e7b7p-26,
        -0x1.8f755p-26, 0x1.f1e5fp-25, 0x1.661b5p-26,
};

static const eye4_real numbers_center_of_mass_velocity[] =
{
    0x1.e5642ceec1667p-2, -0x1.02100b3d7c67p-2, 0x1.4b6f166e28697p+1,
    -0x1.4a2cbffc1ebfep+2, -0x1.d325522b5939p+2, 0x1.0916d186f7fap-3,
};

typedef struct function {
    const char *name;
    size_t size;  /* bytes of its results */
    eye4_status (*call)(void);
    void (*take)(tally *sum, eye4_status status);
    const eye4_real *numbers;
    answer answers[CASES];
    uint32_t swept;  /* hash of the first SWEPT states of a sweep */
} function;

static const function functions[FUNCTIONS] =
{
    { "forward", sizeof results.forward,
      call_forward, take_forward_results, numbers_forward,
      { { 0, 0xfb8534c6u, 6 }, { 0, 0x4b70177eu, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0x42c77652u },
    { "wrench", sizeof results.wrench,
      call_wrench, take_wrench_results, numbers_wrench,
      { { 0, 0x7946a8d5u, 6 }, { 0, 0x71eccb97u, 6 }, { -2, 0x8e5b0aa0u, 0 } },
      0xf06d56c9u },
    { "matrices", sizeof results.matrices,
      call_matrices, take_matrices_results, numbers_matrices,
      { { 0, 0x1cb23f90u, 32 }, { 0, 0xa9803d70u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xcb596331u },
    { "momentum", sizeof results.momentum,
      call_momentum, take_momentum_results, numbers_momentum,
      { { 0, 0xb32f59b4u, 16 }, { 0, 0x027ee38au, 16 }, { -2, 0x8e5b0aa0u, 0 } },
      0x844a5226u },
    { "torque", sizeof results.torque,
      call_torque, take_torque_results, numbers_torque,
      { { 0, 0x09532b30u, 4 }, { 0, 0x0bba7875u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0xbaf6a2f3u },
    { "coupled", sizeof results.coupled,
      call_coupled, take_coupled_results, numbers_coupled,
      { { 0, 0x5a53b38fu, 10 }, { 0, 0xe38eea46u, 10 }, { -2, 0x8e5b0aa0u, 0 } },
      0x6ae393beu },
    { "step", sizeof results.step,
      call_step, take_step_results, numbers_step,
      { { 0, 0x3628d82eu, 21 }, { 32, 0xf036c0b6u, 21 }, { -2, 0x8e5b0aa0u, 0 } },
      0x7d975f11u },
    { "step_driven", sizeof results.step_driven,
      call_step_driven, take_step_driven_results, numbers_step_driven,
      { { 0, 0xcaed5416u, 21 }, { 32, 0xae860f43u, 21 }, { -2, 0x8e5b0aa0u, 0 } },
      0xaa7a97f8u },
    { "wrap", sizeof results.wrap,
      call_wrap, take_wrap_results, numbers_wrap,
      { { 0, 0x51af2eaau, 1 }, { 0, 0x368177bdu, 1 }, { -2, 0x8e5b0aa0u, 0 } },
      0xf000679au },
    { "phase_of_counts", sizeof results.phase_of_counts,
      call_phase_of_counts, take_phase_of_counts_results, numbers_phase_of_counts,
      { { 0, 0x0b1392edu, 1 }, { 0, 0x705907a4u, 1 }, { -5, 0x2107376du, 0 } },
      0x1540621au },
    { "speed_of_counts", sizeof results.speed_of_counts,
      call_speed_of_counts, take_speed_of_counts_results, numbers_speed_of_counts,
      { { 0, 0xfff00da6u, 1 }, { 0, 0x46441124u, 1 }, { -5, 0x2107376du, 0 } },
      0x0bbcdfc7u },
    { "accumulate", sizeof results.accumulate,
      call_accumulate, take_accumulate_results, numbers_accumulate,
      { { 0, 0x29b175bcu, 0 }, { 0, 0xc515186cu, 0 }, { -5, 0xea238159u, 0 } },
      0x1472cd8bu },
    { "forward_jacobian", sizeof results.forward_jacobian,
      call_forward_jacobian, take_forward_jacobian_results, numbers_forward_jacobian,
      { { 0, 0xa933d9e2u, 32 }, { 0, 0xc561b3cau, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xf032c389u },
    { "coupled_jacobian", sizeof results.coupled_jacobian,
      call_coupled_jacobian, take_coupled_jacobian_results, numbers_coupled_jacobian,
      { { 0, 0x66ca318du, 32 }, { 0, 0x670cbc3bu, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x2b059328u },
    { "inverse", sizeof results.inverse,
      call_inverse, take_inverse_results, numbers_inverse,
      { { 72, 0xc99301c1u, 21 }, { 72, 0x46003fd2u, 21 }, { -2, 0x8e5b0aa0u, 0 } },
      0x1dcfc501u },
    { "inverse_fast", sizeof results.inverse_fast,
      call_inverse_fast, take_inverse_fast_results, numbers_inverse_fast,
      { { 0, 0x5134c633u, 4 }, { 0, 0x629db312u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0x87eab6a7u },
    { "inverse_pointing", sizeof results.inverse_pointing,
      call_inverse_pointing, take_inverse_pointing_results, numbers_inverse_pointing,
      { { 64, 0xe6cfdd2eu, 20 }, { 64, 0xcad5b334u, 20 }, { -2, 0x8e5b0aa0u, 0 } },
      0x41048c15u },
    { "inverse_fast_pointing", sizeof results.inverse_fast_pointing,
      call_inverse_fast_pointing, take_inverse_fast_pointing_results, numbers_inverse_fast_pointing,
      { { 0, 0x6b7bcac1u, 4 }, { 0, 0xaa7a41d2u, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0xe97f469du },
    { "torque_for_pointing", sizeof results.torque_for_pointing,
      call_torque_for_pointing, take_torque_for_pointing_results, numbers_torque_for_pointing,
      { { 12, 0xa0c9344cu, 18 }, { 12, 0x2bb606dfu, 18 }, { -2, 0x8e5b0aa0u, 0 } },
      0x7c541386u },
    { "points", sizeof results.points,
      call_points, take_points_results, numbers_points,
      { { 0, 0x1c1b2f6bu, 32 }, { 0, 0xa1ca769du, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x02344cfeu },
    { "quaternion", sizeof results.quaternion,
      call_quaternion, take_quaternion_results, numbers_quaternion,
      { { 0, 0xc4b31f96u, 4 }, { 0, 0x8793f69au, 4 }, { -2, 0x8e5b0aa0u, 0 } },
      0x0c6ae9ebu },
    { "state_from_coordinates", sizeof results.state_from_coordinates,
      call_state_from_coordinates, take_state_from_coordinates_results, numbers_state_from_coordinates,
      { { 0, 0x15ec35ffu, 27 }, { 0, 0xdea526d3u, 27 }, { -2, 0x924274d2u, 21 } },
      0x0df9e999u },
    { "generalized", sizeof results.generalized,
      call_generalized, take_generalized_results, numbers_generalized,
      { { 0, 0xebe817d2u, 32 }, { 0, 0x50ad6629u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0xa595d54fu },
    { "prepare", sizeof results.prepare,
      call_prepare, take_prepare_results, numbers_prepare,
      { { 0, 0x8cd54536u, 32 }, { 0, 0x54808ecbu, 32 }, { -2, 0x7bda45d6u, 32 } },
      0x8c5b9294u },
    { "mounts", sizeof results.mounts,
      call_mounts, take_mounts_results, numbers_mounts,
      { { 0, 0x955b1b56u, 24 }, { 0, 0x389ca45eu, 24 }, { -2, 0x8e5b0aa0u, 0 } },
      0xbdda1a82u },
    { "prepare_mounts", sizeof results.prepare_mounts,
      call_prepare_mounts, take_prepare_mounts_results, numbers_prepare_mounts,
      { { 0, 0x176806c7u, 32 }, { 0, 0xc1b853d8u, 32 }, { -2, 0x8e5b0aa0u, 0 } },
      0x45a116cbu },
    { "step_carried", sizeof results.step_carried,
      call_step_carried, take_step_carried_results, numbers_step_carried,
      { { 0, 0x32851571u, 32 }, { 32, 0x541bb165u, 32 }, { -2, 0x3b24efdeu, 21 } },
      0x86a1e390u },
    { "step_driven_carried", sizeof results.step_driven_carried,
      call_step_driven_carried, take_step_driven_carried_results, numbers_step_driven_carried,
      { { 0, 0x21b1d69du, 32 }, { 32, 0x7d549debu, 32 }, { -2, 0x3b24efdeu, 21 } },
      0xcbd57867u },
    { "center_of_mass_velocity", sizeof results.center_of_mass_velocity,
      call_center_of_mass_velocity, take_center_of_mass_velocity_results, numbers_center_of_mass_velocity,
      { { 0, 0x633965a5u, 3 }, { 0, 0xeca47ef6u, 3 }, { -2, 0x8e5b0aa0u, 0 } },
      0x8c832eb2u },
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
static int judge(const function *f, uint32_t swept, void (*print)(const char *text))
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
        in = golden[i];
        scale_parameters();
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
    add_text(f->name);
    add_text(wrong == 0u ? " PASS cases " : " FAIL cases ");
    add_decimal((uint64_t)CASES + 1u);
    if (wrong != 0u) {
        add_text(" wrong ");
        add_decimal(wrong);
        add_fault(statuses, "status", &first);
        add_fault(worst != 0u, "numbers", &first);
        add_fault(others, "other members", &first);
        add_fault(swept != f->swept, "sweep", &first);
        add_fault(written, "written though refused", &first);
        add_text(first != 0 ? "" : ")");
    }
    if (wrong == 0u || worst != 0u) {
        add_text(worst > FAR ? " worst more than " : " worst ");
        add_decimal(worst > FAR ? FAR : worst);
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
        draw_inputs(&seed, state);
        scale_parameters();
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
    if (rounds_to_integer() == 0) {
        add_text("wrong results: compiled with -ffast-math, -Ofast, -funsafe-math-optimizations or a part of them");
        end_line(print);
    }
    add_text("mahovik selftest eye4 structure 59c20951 physics 2efca783 real double");
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

#ifndef EYE4_SELFTEST_NO_MAIN
static void print_text(const char *text)
{
    (void)fputs(text, stdout);
}

int main(void)
{
    return eye4_selftest(print_text, EYE4_SELFTEST_SWEEP) != 0;
}
#endif
