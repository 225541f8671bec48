/* bench8.h: motion of the stand "bench8": carrier, 0 instruments, 8 flywheels.
 * mahovik 0.1.0; structure 309d41a6, physics 139422e0. Generated: change the stand file instead.
 *
 * C99, no libm, no allocation, stack only, constant globals: any core may call any function at any time.
 * Compile with -ffp-contract=off (no fused multiply-add): then every processor with IEEE 754 arithmetic gives
 * the same bits.
 * Also needed: for 32-bit x86 -msse2 -mfpmath=sse; with gcc 12 for x86-64 with FMA
 * and for a Cortex-M55 -fno-tree-vectorize. gcc may call memcpy, memmove and memset.
 * Never with -ffast-math, -Ofast, -funsafe-math-optimizations or parts of them: wrong results with status OK.
 * The source refuses what the compiler shows of them; clang does not show all.
 * BENCH8_SQRT, defined for the source, takes the square root of a processor in the place of its own:
 * the bits are the same if it rounds correctly.
 * -ffunction-sections and -Wl,--gc-sections leave out what is not called.
 * Stack: what a function states is an upper bound with all that it calls, from its locals along the
 * deepest chain of calls and an allowance for registers: for gcc and clang at -O1 to -O3 and -Os, 32 and 64
 * bits. The routines of the compiler's library (memcpy, arithmetic without an FPU) come on top.
 * `mahovik verify --cost` measures.
 * Inputs are checked; of the table nothing:
 * pass one that prepare made, or a copy of the default.
 * A result must not overlap an input, unless its function says that it may.
 *
 * SI units. E0 is inertial, E1 the carrier with origin O1, Es a flywheel. Six numbers are the linear part,
 * then the angular part, in axes of E1 about O1 unless said otherwise. Equation numbers: README.md
 * of the delivered folder.
 *
 * The equation of motion, (8):  K V_dot + M V + sum over flywheels s (I_s phi_ddot_s + J_s phi_dot_s) = F
 *   V         twist of the carrier: velocity of O1, angular velocity
 *   phi_s     angle of flywheel s about its axis
 *   K         (6x6) inertia of all bodies, with added mass; M = Phi(V) K + K_dot
 *   I_s, J_s  (6) how the acceleration and the speed of flywheel s act on the carrier
 *   F         wrench of all that acts from outside, (7)
 */
#ifndef BENCH8_H
#define BENCH8_H

/* The linker sees names that end in the kind of the reals and a hash of this header: a caller with the
 * header of another stand, element type, choice of functions or version does not link. Define
 * BENCH8_PLAIN_NAMES for all files, and it sees the names as they are, as dlsym, --wrap and other
 * languages need them. */
#ifndef BENCH8_PLAIN_NAMES
#define bench8_default_parameters bench8_default_parameters_f64_f5a668f0
#define bench8_default            bench8_default_f64_f5a668f0
#define bench8_default_options    bench8_default_options_f64_f5a668f0
#define bench8_forward            bench8_forward_f64_f5a668f0
#define bench8_momentum           bench8_momentum_f64_f5a668f0
#define bench8_torque             bench8_torque_f64_f5a668f0
#define bench8_coupled            bench8_coupled_f64_f5a668f0
#define bench8_step               bench8_step_f64_f5a668f0
#define bench8_inverse            bench8_inverse_f64_f5a668f0
#define bench8_inverse_fast       bench8_inverse_fast_f64_f5a668f0
#define bench8_prepare            bench8_prepare_f64_f5a668f0
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define BENCH8_STRUCTURE 0x309d41a6u  /* hash of the stand's names, counts and kinds of wrench */
#define BENCH8_PHYSICS   0x139422e0u  /* hash of its structure and all numbers */
#define BENCH8_REAL_BYTES 8           /* bytes of a bench8_real */
#define BENCH8_VERSION_MAJOR 0        /* of the mahovik that wrote this */
#define BENCH8_VERSION_MINOR 1
#define BENCH8_VERSION_PATCH 0

typedef double bench8_real;

/* ---- ranges of inputs: magnitudes ---- */

#define BENCH8_MAX_POSITION      1.0e6     /* m; each component of the position of O1 */
#define BENCH8_MAX_VELOCITY      1.0e4     /* m/s; each component of v */
#define BENCH8_MAX_SPEED         1.0e5     /* rad/s; each component of omega, each phi_dot */
#define BENCH8_MAX_PHASE         1.0e7     /* rad; each phase and attitude angle */
#define BENCH8_MAX_ACCELERATION  1.0e9     /* rad/s2; each phi_ddot */
#define BENCH8_MAX_WRENCH        1.0e9     /* N, N m; each component of a run-time wrench */
#define BENCH8_MAX_STEP          10.0      /* s; a time step */
#define BENCH8_MAX_PARAMETER     1.0e15    /* SI; each mass, length and moment of inertia */
#define BENCH8_MAX_WEIGHT        1.0e6     /* the weight of a flywheel in inverse; at least its inverse */
#define BENCH8_MAX_ROUNDING      1.0       /* SI; each number of a carry */
#define BENCH8_MAX_TURN_4        1.0       /* rad; turn in a step of order 4; beyond: COARSE */
#define BENCH8_MAX_TURN_2        0.1       /* rad; turn in a step of order 2; beyond: COARSE */
#define BENCH8_LARGEST           1.7976931348623157e308  /* largest finite number */

/* ---- constants ---- */

#define BENCH8_SMALLEST          2.2250738585072014e-308  /* smallest number with all digits */
#define BENCH8_MIN_NORM2         0.998001  /* square of the length of a quaternion, or of sine and cosine */
#define BENCH8_MAX_NORM2         1.002001  /* the same: within 1e-3 of unit length */
#define BENCH8_EPS_RANK          1.0e-9    /* of singular values over the largest: below, one is zero */
#define BENCH8_EPS_REACHED2      1.0e-18   /* of residual over demand, both squared: above, UNREACHABLE */
#define BENCH8_SETTLED           0.999999999  /* of squared residuals of two passes: above, no gain */
#define BENCH8_MIN_WEIGHT        1.0e-6    /* the weight of a flywheel in inverse; 1/MAX_WEIGHT */
#define BENCH8_EPS_REGULAR       1.0e-12   /* on diagonals that limits may have left singular */
#define BENCH8_EPS_PIVOT         1.0e-13   /* of a pivot over its diagonal: below, rounding */
#define BENCH8_EPS_PARALLEL2     2.5e-19   /* sine between `axis` and `zero`, squared: below, parallel */
#define BENCH8_EPS_MASS          1.0e-30   /* kg, kg m2; masses and spin inertias: below, none */
#define BENCH8_EPS_INERTIA       1.0e-9    /* how far below 0 rounding may take an eigenvalue */
#define BENCH8_MAX_INERTIA       1.0e60    /* kg m2; sum of all moments of inertia about O1 */
#define BENCH8_EPS_SQUARE        1.0e-30   /* square of a length: below, it has no direction */
#define BENCH8_ROUNDER           6755399441055744.0  /* added and taken off: to a whole number */
#define BENCH8_TURNS_A_RADIAN    0.15915494309189535  /* 1 / (2 pi) */

/* ---- status of every function: negative: refused, outputs untouched; positive: bits, outputs valid ---- */

typedef int bench8_status;  /* not the enum, whose size compilers choose */

enum {
    BENCH8_OK = 0,                        /* success */
    BENCH8_NEAR_SINGULAR = 1,             /* least singular value below `near_singular` times the largest */
    BENCH8_DAMPED = 2,                    /* damping was applied */
    BENCH8_LIMITED = 4,                   /* a limit was reached; `limited` says by which flywheels */
    BENCH8_UNREACHABLE = 8,               /* wanted motion not reached: residual above 1e-9 of the demand */
    BENCH8_RANK_DEFICIENT = 16,           /* fewer than min(m, N) singular values above 1e-9 of the
                                           * largest; m of the demand */
    BENCH8_COARSE = 32,                   /* step too long: more than MAX_TURN_4 or MAX_TURN_2 turned in it */
    BENCH8_EXCESSIVE = 64,                /* more than a motor's torque or speed, or than `most` */
    BENCH8_NOT_FINITE = -1,               /* an input is NaN or infinite */
    BENCH8_RANGE = -2,                    /* out of range, quaternion off unit length */
    BENCH8_NOT_POSITIVE_DEFINITE = -3,    /* no mass, no spin inertia, or a pivot failed */
    BENCH8_BAD_ARGUMENT = -5              /* a null pointer, a count, an index, a step or an option */
};

/* ---- numbers of bodies ---- */

/* flywheels, in the order of the stand file */
enum { BENCH8_W1, BENCH8_W2, BENCH8_W3, BENCH8_W4, BENCH8_W5, BENCH8_W6, BENCH8_W7, BENCH8_W8, BENCH8_N = 8 };

/* ---- data ---- */

/* State of the whole system. */
typedef struct bench8_state {
    bench8_real position[3];        /* m; position of O1, in E0 */
    bench8_real attitude[4];        /* unit quaternion, w first: x0 = C x1 */
    bench8_real V[6];               /* m/s, rad/s; twist of the carrier relative to E0, in E1 */
    bench8_real phi[BENCH8_N];      /* rad; phases */
    bench8_real phi_dot[BENCH8_N];  /* rad/s; speeds relative to the mount */
} bench8_state;

/* Mass properties of one body, in its own frame. */
typedef struct bench8_body {
    bench8_real mass;               /* kg */
    bench8_real center_of_mass[3];  /* m; rc, from the body's origin, in its own axes */
    bench8_real inertia[6];         /* kg m2; J11, J22, J33, J12, J13, J23 about the body's origin */
} bench8_body;

/* A flywheel and how it is mounted. */
typedef struct bench8_flywheel {
    bench8_body body;
    bench8_real position[3];  /* m; Os, in the frame of the mount */
    bench8_real axis[3];      /* spin axis in the frame of the mount, any length */
    bench8_real zero[3];      /* its component perpendicular to the axis is the second axis of Es at phi =
                               * 0 */
} bench8_flywheel;

/* Masses, inertias and mountings, of which the table is made. */
typedef struct bench8_parameters {
    bench8_body carrier;
    bench8_flywheel flywheel[BENCH8_N];
} bench8_parameters;

/* Table of one flywheel: harmonics of its terms in (8), in E1 about O1. */
typedef struct bench8_row {
    bench8_real mu_c[3];        /* kg m; first moment about O1: cos phi */
    bench8_real mu_s[3];        /* kg m; sin phi */
    bench8_real J_c[6];         /* kg m2; inertia about O1, 11 22 33 12 13 23: cos phi */
    bench8_real J_s[6];         /* kg m2; sin phi */
    bench8_real J_2c[6];        /* kg m2; cos 2 phi */
    bench8_real J_2s[6];        /* kg m2; sin 2 phi */
    bench8_real t_0[3];         /* kg m2; moment part of I: constant */
    bench8_real t_c[3];         /* kg m2; cos phi */
    bench8_real t_s[3];         /* kg m2; sin phi */
    bench8_real spin;           /* kg m2; Theta_ff: inertia about the spin axis */
    bench8_real spin_inv;       /* 1/(kg m2) */
    bench8_real spin_root_inv;  /* 1/(kg m2)^0.5; 1/sqrt(spin): scales the unknowns of (12) */
} bench8_row;

/* Suspension of the carrier to E0. */
typedef struct bench8_suspension {
    bench8_real stiffness[6][6];  /* SI; wrench -= stiffness x */
    bench8_real damping[6][6];    /* SI; wrench -= damping V */
    bench8_real position[3];      /* m; equilibrium of O1, in E0 */
    bench8_real attitude[4];      /* quaternion of the equilibrium attitude */
} bench8_suspension;

/* The constants of the equations, made of the parameters; the laws at the end (gravity, ...) are as given. */
typedef struct bench8_table {
    bench8_real mass;               /* kg; mass of all bodies */
    bench8_real mass_inverse;       /* 1/kg */
    bench8_real first_moment[3];    /* kg m; mu about O1, constant part */
    bench8_real inertia[6];         /* kg m2; J about O1, 11 22 33 12 13 23, constant part */
    bench8_row flywheel[BENCH8_N];
    bench8_real gravity[3];         /* m/s2; in E0 */
    bench8_suspension suspension;
} bench8_table;

/* Momentum, energy, mass centre and its velocity. */
typedef struct bench8_momentum_result {
    bench8_real Z[6];                        /* kg m/s, kg m2/s; momentum screw in E1 about O1 (2) */
    bench8_real Z0[6];                       /* kg m/s, kg m2/s; momentum screw in E0 about its origin (1) */
    bench8_real energy;                      /* J; kinetic energy */
    bench8_real center_of_mass[3];           /* m; mass centre of all bodies, in E1 */
    bench8_real center_of_mass_velocity[3];  /* m/s; of the mass centre relative to E0, in E0 */
} bench8_momentum_result;

/* What rounding took from a state: kept from step to step, all zero at first. */
typedef struct bench8_step_carry {
    bench8_real rounding[29];  /* SI; of each number of the state, in its order */
} bench8_step_carry;

/* Options of inverse: how it distributes a demand, and what it does near a singularity. */
typedef struct bench8_inverse_options {
    bench8_real weight[BENCH8_N];               /* weight of each flywheel in the norm of phi_ddot: 1e-6 to
                                                 * 1e6; else 1 */
    bench8_real limit[BENCH8_N];                /* rad/s2; largest magnitude of each phi_ddot; greater than
                                                 * 0; infinity: no limit */
    bench8_real most[BENCH8_N];                 /* rad/s2; EXCESSIVE above this |phi_ddot|; greater than 0 */
    bench8_real motor_torque[BENCH8_N];         /* N m; EXCESSIVE if the drive torque is larger; not
                                                 * negative; infinity: no limit */
    bench8_real motor_speed[BENCH8_N];          /* rad/s; no-load speed, where the torque that drives has
                                                 * fallen to 0; greater than 0; infinity: none */
    bench8_real motor_viscous[BENCH8_N];        /* N m s; viscous friction, which the motor bears; 0: none */
    bench8_real motor_coulomb[BENCH8_N];        /* N m; dry friction, which the motor bears; 0: none */
    bench8_real motor_coulomb_speed[BENCH8_N];  /* rad/s; speed at which three quarters of the dry friction
                                                 * act; greater than 0 */
    bench8_real near_singular;                  /* status NEAR_SINGULAR below this fraction of the largest
                                                 * singular value, 0..1 */
    bench8_real damping;                        /* damping of small singular values, as a fraction of the
                                                 * largest, 0..1; 0: none */
} bench8_inverse_options;

/* Result of inverse and its quality. */
typedef struct bench8_inverse_result {
    bench8_real phi_ddot[BENCH8_N];  /* rad/s2; flywheel accelerations */
    bench8_real residual[6];         /* N, N m; F - K V_dot - M V - J phi_dot - I phi_ddot */
    bench8_real sigma[6];            /* singular values of K^-1/2 I Theta_ff^-1/2, descending */
    int rank;                        /* number of singular values above the rank threshold */
    bench8_real damped_by;           /* largest damping lambda applied, in units of sigma; 0: none */
    int limited[BENCH8_N];           /* 1 if the flywheel reached its limit */
    bench8_real hardest[6];          /* the unreachable wrench, or the one hardest to reach; a unit vector
                                      * in the norm of K^-1 */
} bench8_inverse_result;

extern const bench8_parameters bench8_default_parameters;         /* of the stand file */
extern const bench8_table bench8_default;                         /* made of them */
extern const bench8_inverse_options bench8_default_options;       /* of inverse, by the stand file */

/* ---- functions ---- */

/* forward: acceleration of the carrier for given accelerations of the flywheels: K V_dot = F - M V - sum(I
 * phi_ddot + J phi_dot), (8).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   phi_ddot[8]  rad/s2; flywheel accelerations
 *   V_dot[6]     out: m/s2, rad/s2; derivative of the components of V; may overlap any input
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 2708 operations on reals, 6 of them divisions. Stack: at most 2208 bytes. */
bench8_status bench8_forward(const bench8_table *table, const bench8_state *x,
                             const bench8_real phi_ddot[BENCH8_N], bench8_real V_dot[6]);

/* momentum: momentum screw, kinetic energy, mass centre of the whole system and its velocity, (1), (2).
 *   table  the prepared table
 *   x      state; its attitude within 1e-3 of unit length
 *   out    out: Z, Z0, energy, mass centre and its velocity
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 2461 operations on reals, 1 of them a division. Stack: at most 1728 bytes. */
bench8_status bench8_momentum(const bench8_table *table, const bench8_state *x, bench8_momentum_result *out);

/* torque: drive torques for a given motion: tau = f^T (Theta V_s_dot + Phi(V_s) Z_s - P_s).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   V_dot[6]     m/s2, rad/s2; derivative of the components of V
 *   phi_ddot[8]  rad/s2; flywheel accelerations
 *   tau[8]       out: N m; drive torques, mount on flywheel, about the spin axis
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 1529 operations on reals, 1 of them a division. Stack: at most 1584 bytes. */
bench8_status bench8_torque(const bench8_table *table, const bench8_state *x, const bench8_real V_dot[6],
                            const bench8_real phi_ddot[BENCH8_N], bench8_real tau[BENCH8_N]);

/* coupled: motion of the whole system under drive torques: V_dot, phi_ddot together, flywheels eliminated
 * first.
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   tau[8]       N m; drive torques, mount on flywheel
 *   locked[8]    not 0: a lock holds phi_ddot = 0, whatever its tau; null: no lock
 *   V_dot[6]     out: m/s2, rad/s2; derivative of the components of V
 *   phi_ddot[8]  out: rad/s2; flywheel accelerations
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 4047 operations on reals, 7 of them divisions. Stack: at most 3568 bytes. */
bench8_status bench8_coupled(const bench8_table *table, const bench8_state *x,
                             const bench8_real tau[BENCH8_N], const int locked[BENCH8_N],
                             bench8_real V_dot[6], bench8_real phi_ddot[BENCH8_N]);

/* step: state after one time step; drive torques and wrenches are held constant.
 *   table      the prepared table
 *   x          state; its attitude within 1e-3 of unit length
 *   tau[8]     N m; drive torques, mount on flywheel
 *   locked[8]  not 0: a lock holds phi_ddot = 0, whatever its tau; null: no lock
 *   dt         s; time step, greater than 0
 *   order      4: Runge-Kutta, four evaluations; 2: midpoint rule, two
 *   carry      in and out: of the step before; at first all zero; null: what rounding takes is lost
 *   next       out: state after the step; may be x itself
 * RANGE also if a stage of the step or the new state is out of range.
 * COARSE: dt times the fastest of |phi_dot| and |omega| is above MAX_TURN_4 rad (order 2: MAX_TURN_2). At
 * this bound the vibration of an unbalance is wrong by 3e-4 of its size after a turn, one of twice the
 * speed (asymmetry) by 4e-3 (order 2: 1e-3). Errors grow with dt^4 (dt^2), beyond twice the bound faster.
 * A carry belongs to its state: where another state is set, set the carry to zero.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, COARSE. Nothing is written when the
 * status is negative.
 * At most 17249 operations on reals, 34 of them divisions. Stack: at most 4896 bytes. */
bench8_status bench8_step(const bench8_table *table, const bench8_state *x, const bench8_real tau[BENCH8_N],
                          const int locked[BENCH8_N], bench8_real dt, int order, bench8_step_carry *carry,
                          bench8_state *next);

/* inverse: flywheel accelerations for a wanted motion of the carrier: I phi_ddot = F - K V_dot - M V - J
 * phi_dot. Least residual in the norm of K^-1, then least weighted norm of phi_ddot. What a flywheel at
 * its limit cannot give is shared among the others, (12).
 *   table     the prepared table
 *   x         state; its attitude within 1e-3 of unit length
 *   V_dot[6]  m/s2, rad/s2; wanted derivative of the components of V
 *   options   weights, limits, damping; default_options holds those of the stand file
 *   out       out: phi_ddot and its quality
 * Positive statuses are bits and may be combined.
 * RANGE also where the answer is no finite number.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, NEAR_SINGULAR, DAMPED, LIMITED,
 * UNREACHABLE, RANK_DEFICIENT, EXCESSIVE. Nothing is written when the status is negative.
 * At most 108138 operations on reals, 3707 of them divisions. Stack: at most 5264 bytes. */
bench8_status bench8_inverse(const bench8_table *table, const bench8_state *x, const bench8_real V_dot[6],
                             const bench8_inverse_options *options, bench8_inverse_result *out);

/* inverse_fast: flywheel accelerations for a wanted motion of the carrier, without diagnostics: normal
 * equations, (12).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   V_dot[6]     m/s2, rad/s2; wanted derivative of the components of V
 *   options      weights and damping; `near_singular` and `limit` are ignored
 *   phi_ddot[8]  out: rad/s2; flywheel accelerations
 * Squares the condition number: as accurate as inverse if singular values differ by a factor of at most
 * some thousand; returns NOT_POSITIVE_DEFINITE if they differ by more and damping is 0.
 * `damping` is in units of the root of the sum of squares of sigma, which inverse gives.
 * EXCESSIVE counts Theta_ff phi_ddot and the friction of the motor. What the carrier's motion adds is left
 * out: `torque` and `inverse` have it. What the options say of motors is not checked; it decides this bit
 * alone.
 * RANGE also where the answer is no finite number.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, EXCESSIVE. Nothing is written when
 * the status is negative.
 * At most 4477 operations on reals, 85 of them divisions. Stack: at most 5136 bytes. */
bench8_status bench8_inverse_fast(const bench8_table *table, const bench8_state *x,
                                  const bench8_real V_dot[6], const bench8_inverse_options *options,
                                  bench8_real phi_ddot[BENCH8_N]);

/* prepare: makes the table of a stand from masses, centres of mass, inertias and mountings, (2).
 *   parameters  masses, inertias, mountings
 *   table       in and out: start with a copy of the default; its laws (gravity, damping, ...) are kept
 * The generator makes the default table by the same operations: the default parameters give its bits.
 * Also returns RANGE if a mass is negative or an axis has no direction.
 * NOT_POSITIVE_DEFINITE: no such body exists. Moments of inertia about the centre of mass are negative or
 * break the triangle inequality (to 1e-9 of the largest element); a flywheel without spin inertia; no mass
 * at all.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 11227 operations on reals, 67 of them divisions. Stack: at most 2016 bytes. */
bench8_status bench8_prepare(const bench8_parameters *parameters, bench8_table *table);

#ifdef __cplusplus
}
#endif

#endif
