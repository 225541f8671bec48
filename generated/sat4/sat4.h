/* sat4.h: motion of the stand "sat4": carrier, 0 instruments, 4 flywheels.
 * mahovik 0.1.0; structure f28a1ef8, physics e77ec5a4. Generated: change the stand file instead.
 *
 * C99, no libm, no allocation, stack only, constant globals: any core may call any function at any time.
 * Compile with -ffp-contract=off (no fused multiply-add): then every processor with IEEE 754 arithmetic gives
 * the same bits.
 * Also needed: for 32-bit x86 -msse2 -mfpmath=sse; with gcc 12 for x86-64 with FMA
 * and for a Cortex-M55 -fno-tree-vectorize. gcc may call memcpy, memmove and memset.
 * Never with -ffast-math, -Ofast, -funsafe-math-optimizations or parts of them: wrong results with status OK.
 * The source refuses what the compiler shows of them; clang does not show all.
 * SAT4_SQRT, defined for the source, takes the square root of a processor in the place of its own:
 * the bits are the same if it rounds correctly.
 * -ffunction-sections and -Wl,--gc-sections leave out what is not called.
 * Stack: what a function states is an upper bound with all that it calls, from its locals along the
 * deepest chain of calls and an allowance for registers: for gcc and clang at -O1 to -O3 and -Os, 32 and 64
 * bits. The routines of the compiler's library (memcpy, arithmetic without an FPU) come on top.
 * `mahovik cost` measures.
 * Inputs are checked; of the table its stream alone: pass one that prepare made, or a copy of the default.
 * A result must not overlap an input, unless its function says that it may.
 *
 * SI units. E0 is inertial, E1 the carrier with origin O1, Es a flywheel. Six numbers are the linear part,
 * then the angular part, in axes of E1 about O1 unless said otherwise. Equation numbers: README.md
 * of the delivered folder. */
#ifndef SAT4_H
#define SAT4_H

/* The linker sees names that end in the kind of the reals and a hash of this header: a caller with the
 * header of another stand, element type, choice of functions or version does not link. Define
 * SAT4_PLAIN_NAMES for all files, and it sees the names as they are, as dlsym, --wrap and other languages
 * need them. */
#ifndef SAT4_PLAIN_NAMES
#define sat4_default_parameters     sat4_default_parameters_f64_6172d9f7
#define sat4_default                sat4_default_f64_6172d9f7
#define sat4_default_options        sat4_default_options_f64_6172d9f7
#define sat4_forward                sat4_forward_f64_6172d9f7
#define sat4_matrices               sat4_matrices_f64_6172d9f7
#define sat4_momentum               sat4_momentum_f64_6172d9f7
#define sat4_torque                 sat4_torque_f64_6172d9f7
#define sat4_coupled                sat4_coupled_f64_6172d9f7
#define sat4_step                   sat4_step_f64_6172d9f7
#define sat4_step_driven            sat4_step_driven_f64_6172d9f7
#define sat4_wrap                   sat4_wrap_f64_6172d9f7
#define sat4_phase_of_counts        sat4_phase_of_counts_f64_6172d9f7
#define sat4_speed_of_counts        sat4_speed_of_counts_f64_6172d9f7
#define sat4_accumulate             sat4_accumulate_f64_6172d9f7
#define sat4_forward_jacobian       sat4_forward_jacobian_f64_6172d9f7
#define sat4_coupled_jacobian       sat4_coupled_jacobian_f64_6172d9f7
#define sat4_inverse                sat4_inverse_f64_6172d9f7
#define sat4_inverse_fast           sat4_inverse_fast_f64_6172d9f7
#define sat4_inverse_pointing       sat4_inverse_pointing_f64_6172d9f7
#define sat4_inverse_fast_pointing  sat4_inverse_fast_pointing_f64_6172d9f7
#define sat4_torque_for_pointing    sat4_torque_for_pointing_f64_6172d9f7
#define sat4_points                 sat4_points_f64_6172d9f7
#define sat4_quaternion             sat4_quaternion_f64_6172d9f7
#define sat4_state_from_coordinates sat4_state_from_coordinates_f64_6172d9f7
#define sat4_generalized            sat4_generalized_f64_6172d9f7
#define sat4_prepare                sat4_prepare_f64_6172d9f7
#define sat4_mounts                 sat4_mounts_f64_6172d9f7
#define sat4_prepare_mounts         sat4_prepare_mounts_f64_6172d9f7
#define sat4_step_carried           sat4_step_carried_f64_6172d9f7
#define sat4_step_driven_carried    sat4_step_driven_carried_f64_6172d9f7
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define SAT4_STRUCTURE 0xf28a1ef8u  /* hash of the stand's names, counts and kinds of wrench */
#define SAT4_PHYSICS   0xe77ec5a4u  /* hash of its structure and all numbers */
#define SAT4_TABLE_HASH 0xc11ef45fu /* FNV-1a of all numbers of the default table but its stream */
#define SAT4_REAL_BYTES 8           /* bytes of a sat4_real */
#define SAT4_VERSION_MAJOR 0        /* of the mahovik that wrote this */
#define SAT4_VERSION_MINOR 1
#define SAT4_VERSION_PATCH 0

typedef double sat4_real;

/* ---- ranges of inputs: magnitudes ---- */

#define SAT4_MAX_POSITION        1.0e6     /* m; each component of the position of O1 */
#define SAT4_MAX_VELOCITY        1.0e4     /* m/s; each component of v */
#define SAT4_MAX_SPEED           1.0e5     /* rad/s; each component of omega, each phi_dot */
#define SAT4_MAX_PHASE           1.0e7     /* rad; each phase and attitude angle */
#define SAT4_MAX_ACCELERATION    1.0e9     /* rad/s2; each phi_ddot */
#define SAT4_MAX_WRENCH          1.0e9     /* N, N m; each component of a run-time wrench */
#define SAT4_MAX_STEP            10.0      /* s; a time step */
#define SAT4_MAX_PARAMETER       1.0e15    /* SI; each mass, length and moment of inertia */
#define SAT4_MAX_WEIGHT          1.0e6     /* the weight of a flywheel in inverse; at least its inverse */
#define SAT4_MAX_ROUNDING        1.0       /* SI; each number of a carry */
#define SAT4_MAX_TURN_4          1.0       /* rad; turn in a step of order 4; beyond: COARSE */
#define SAT4_MAX_TURN_2          0.1       /* rad; turn in a step of order 2; beyond: COARSE */
#define SAT4_LARGEST             1.7976931348623157e308  /* largest finite number */

/* ---- status of every function: negative: refused, outputs untouched; positive: bits, outputs valid ---- */

typedef int sat4_status;  /* not the enum, whose size compilers choose */

enum {
    SAT4_OK = 0,                          /* success */
    SAT4_NEAR_SINGULAR = 1,               /* least singular value below `near_singular` times the largest */
    SAT4_DAMPED = 2,                      /* damping was applied */
    SAT4_LIMITED = 4,                     /* a limit was reached; `limited` says by which flywheels */
    SAT4_UNREACHABLE = 8,                 /* wanted motion not reached: residual above 1e-9 of the demand */
    SAT4_RANK_DEFICIENT = 16,             /* fewer than min(6, N) singular values above 1e-9 of the largest */
    SAT4_COARSE = 32,                     /* step too long: more than MAX_TURN_4 or MAX_TURN_2 turned in it */
    SAT4_EXCESSIVE = 64,                  /* more than a motor's torque or speed, or than `most` */
    SAT4_NOT_FINITE = -1,                 /* an input is NaN or infinite */
    SAT4_RANGE = -2,                      /* out of range, quaternion off unit length */
    SAT4_NOT_POSITIVE_DEFINITE = -3,      /* no mass, no spin inertia, or a pivot failed */
    SAT4_SINGULAR_ATTITUDE = -4,          /* attitude angles within 1e-6 of their singularity */
    SAT4_BAD_ARGUMENT = -5                /* a null pointer, a count, an index, a step or an option */
};

/* ---- numbers of bodies ---- */

/* flywheels, in the order of the stand file */
enum { SAT4_RW1, SAT4_RW2, SAT4_RW3, SAT4_RW4, SAT4_N = 4 };
/* instruments and points: those of the function points */
enum { SAT4_SENSOR_ACC1, SAT4_SENSORS = 1 };

/* ---- data ---- */

/* State of the whole system. */
typedef struct sat4_state {
    sat4_real position[3];      /* m; position of O1, in E0 */
    sat4_real attitude[4];      /* unit quaternion, w first: x0 = C x1 */
    sat4_real V[6];             /* m/s, rad/s; twist of the carrier relative to E0, in E1 */
    sat4_real phi[SAT4_N];      /* rad; phases */
    sat4_real phi_dot[SAT4_N];  /* rad/s; speeds relative to the mount */
} sat4_state;

/* What rounding took from a state: kept from step to step, all zero at first. */
typedef struct sat4_step_carry {
    sat4_real rounding[21];  /* SI; of each number of the state, in its order */
} sat4_step_carry;

/* Mass properties of one body, in its own frame. */
typedef struct sat4_body {
    sat4_real mass;               /* kg */
    sat4_real center_of_mass[3];  /* m; rc, from the body's origin, in its own axes */
    sat4_real inertia[6];         /* kg m2; J11, J22, J33, J12, J13, J23 about the body's origin */
} sat4_body;

/* A flywheel and how it is mounted. */
typedef struct sat4_flywheel {
    sat4_body body;
    sat4_real position[3];  /* m; Os, in the frame of the mount */
    sat4_real axis[3];      /* spin axis in the frame of the mount, any length */
    sat4_real zero[3];      /* its component perpendicular to the axis is the second axis of Es at phi = 0 */
} sat4_flywheel;

/* A sensor or a place of interest. */
typedef struct sat4_point {
    sat4_real position[3];  /* m; in the frame of the mount */
    sat4_real axis[3];      /* first axis in the frame of the mount, any length */
    sat4_real zero[3];      /* its component perpendicular to the first axis is the second axis */
} sat4_point;

/* Masses, inertias and mountings, of which the table is made. */
typedef struct sat4_parameters {
    sat4_body carrier;
    sat4_flywheel flywheel[SAT4_N];
    sat4_point point[1];
} sat4_parameters;

/* Table of one flywheel: harmonics of its terms in (8), in E1 about O1. */
typedef struct sat4_row {
    sat4_real mu_c[3];        /* kg m; first moment about O1: cos phi */
    sat4_real mu_s[3];        /* kg m; sin phi */
    sat4_real J_c[6];         /* kg m2; inertia about O1, 11 22 33 12 13 23: cos phi */
    sat4_real J_s[6];         /* kg m2; sin phi */
    sat4_real J_2c[6];        /* kg m2; cos 2 phi */
    sat4_real J_2s[6];        /* kg m2; sin 2 phi */
    sat4_real t_0[3];         /* kg m2; moment part of I: constant */
    sat4_real t_c[3];         /* kg m2; cos phi */
    sat4_real t_s[3];         /* kg m2; sin phi */
    sat4_real spin;           /* kg m2; Theta_ff: inertia about the spin axis */
    sat4_real spin_inv;       /* 1/(kg m2) */
    sat4_real spin_root_inv;  /* 1/(kg m2)^0.5; 1/sqrt(spin): scales the unknowns of (12) */
} sat4_row;

/* Pose of an instrument or a point. */
typedef struct sat4_sensor {
    sat4_real origin[3];  /* m; in E1 */
    sat4_real axes[9];    /* own axes to E1, row by row */
} sat4_sensor;

/* The constants of the equations, made of the parameters; the laws at the end (gravity, ...) are as given. */
typedef struct sat4_table {
    sat4_real mass;                    /* kg; mass of all bodies */
    sat4_real mass_inverse;            /* 1/kg */
    sat4_real first_moment[3];         /* kg m; mu about O1, constant part */
    sat4_real inertia[6];              /* kg m2; J about O1, 11 22 33 12 13 23, constant part */
    sat4_row flywheel[SAT4_N];
    sat4_sensor sensor[SAT4_SENSORS];
} sat4_table;

/* The matrices of (8). */
typedef struct sat4_matrices_result {
    sat4_real K[6][6];        /* kg, kg m, kg m2; mass matrix (2) */
    sat4_real K_dot[6][6];    /* per s; its rate (6) */
    sat4_real M[6][6];        /* per s; velocity matrix (9) */
    sat4_real I_[6][SAT4_N];  /* kg m, kg m2; flywheel coupling (9), one column per flywheel */
    sat4_real J[6][SAT4_N];   /* per s; its velocity part (9) */
    sat4_real F[6];           /* N, N m; total external wrench (7) */
} sat4_matrices_result;

/* Momentum, energy, mass centre and its velocity. */
typedef struct sat4_momentum_result {
    sat4_real Z[6];                        /* kg m/s, kg m2/s; momentum screw in E1 about O1 (2) */
    sat4_real Z0[6];                       /* kg m/s, kg m2/s; momentum screw in E0 about its origin (1) */
    sat4_real energy;                      /* J; kinetic energy */
    sat4_real center_of_mass[3];           /* m; mass centre of all bodies, in E1 */
    sat4_real center_of_mass_velocity[3];  /* m/s; of the mass centre relative to E0, in E0 */
} sat4_momentum_result;

/* The equations in generalized coordinates q = (O1 in E0; psi, theta, phi). */
typedef struct sat4_generalized_result {
    sat4_real A[6][6];    /* V = A q' (10) */
    sat4_real D[6][6];    /* 1/s; A' along the motion (10) */
    sat4_real I0[6][6];   /* K A (11) */
    sat4_real J0[6][6];   /* K D + M A (11) */
    sat4_real q_dot[6];   /* m/s, rad/s; O1 in E0, then psi, theta, phi */
    sat4_real q_ddot[6];  /* m/s2, rad/s2; solution of (11) for the given phi_ddot */
} sat4_generalized_result;

/* One flywheel and its mounting; used by mounts only. */
typedef struct sat4_mount {
    sat4_real mass;             /* kg */
    sat4_real first_moment[3];  /* kg m; m rc, in Es */
    sat4_real inertia[6];       /* kg m2; about Os in Es, 11 22 33 12 13 23 */
    sat4_real origin[3];        /* m; Os in E1 */
    sat4_real axes[9];          /* axes of Es in E1 at phi = 0, row by row */
} sat4_mount;

/* Second table, which the function mounts needs. Made by prepare_mounts. */
typedef struct sat4_mount_table {
    sat4_mount flywheel[SAT4_N];
} sat4_mount_table;

/* Motion at an instrument or a point. */
typedef struct sat4_points_result {
    sat4_real position[3];              /* m; in E0 */
    sat4_real C[3][3];                  /* own axes to E0 */
    sat4_real twist[6];                 /* m/s, rad/s; relative to E0, in own axes; the last three are the
                                         * gyro's reading */
    sat4_real specific_force[3];        /* m/s2; acceleration minus gravity, in own axes: the
                                         * accelerometer's reading */
    sat4_real angular_acceleration[3];  /* rad/s2; in own axes */
} sat4_points_result;

/* An encoder whose counter wraps. Updated by accumulate. */
typedef struct sat4_encoder {
    int counter;  /* last reading */
    int place;    /* counts within the turn, 0 to |per_turn| - 1 */
    int moved;    /* counts between the last two readings */
} sat4_encoder;

/* Options of inverse: how it distributes a demand, and what it does near a singularity. */
typedef struct sat4_inverse_options {
    sat4_real weight[SAT4_N];               /* weight of each flywheel in the norm of phi'': 1e-6 to 1e6, 1
                                             * by default */
    sat4_real limit[SAT4_N];                /* rad/s2; largest magnitude of each phi''; greater than 0;
                                             * infinity: no limit */
    sat4_real most[SAT4_N];                 /* rad/s2; EXCESSIVE above this |phi''|; greater than 0 */
    sat4_real motor_torque[SAT4_N];         /* N m; EXCESSIVE if the drive torque is larger; not negative;
                                             * infinity: no limit */
    sat4_real motor_speed[SAT4_N];          /* rad/s; no-load speed, where the torque that drives has
                                             * fallen to 0; greater than 0; infinity: none */
    sat4_real motor_viscous[SAT4_N];        /* N m s; viscous friction, which the motor bears; 0: none */
    sat4_real motor_coulomb[SAT4_N];        /* N m; dry friction, which the motor bears; 0: none */
    sat4_real motor_coulomb_speed[SAT4_N];  /* rad/s; speed at which three quarters of the dry friction
                                             * act; greater than 0 */
    sat4_real near_singular;                /* status NEAR_SINGULAR below this fraction of the largest
                                             * singular value, 0..1 */
    sat4_real damping;                      /* damping of small singular values, as a fraction of the
                                             * largest, 0..1; 0: none */
    int use_pointing[3];                    /* rows of the task pointing: 0: free */
    sat4_real motor_power[SAT4_N];          /* W; most that torque_for drives with; infinity: no limit */
    sat4_real target_speed[SAT4_N];         /* rad/s; speed that torque_for approaches with what the demand
                                             * leaves free */
    sat4_real target_rate;                  /* 1/s; part of what is missing to it, wanted a second; 0:
                                             * least torque */
    sat4_real avoid_speed;                  /* rad/s; no wanted speed lies nearer to 0 than this; 0: none
                                             * is avoided */
    int keep_direction;                     /* 1: a demand out of reach is made smaller, 0: least error */
} sat4_inverse_options;

/* Result of inverse and its quality. */
typedef struct sat4_inverse_result {
    sat4_real phi_ddot[SAT4_N];  /* rad/s2; flywheel accelerations */
    sat4_real residual[6];       /* N, N m; F - K V* - M V - J phi' - I phi'' */
    sat4_real sigma[4];          /* singular values of K^-1/2 I Theta_ff^-1/2, descending */
    int rank;                    /* number of singular values above the rank threshold */
    sat4_real damped_by;         /* largest damping lambda applied, in units of sigma; 0: none */
    int limited[SAT4_N];         /* 1 if the flywheel reached its limit */
    sat4_real hardest[6];        /* the unreachable wrench, or the one hardest to reach; a unit vector in
                                  * the norm of K^-1 */
} sat4_inverse_result;

/* Result of inverse_pointing and its quality. */
typedef struct sat4_inverse_pointing_result {
    sat4_real phi_ddot[SAT4_N];  /* rad/s2; flywheel accelerations */
    sat4_real V_dot[6];          /* m/s2, rad/s2; motion of the carrier that results */
    sat4_real residual[3];       /* m/s2, rad/s2; demand minus reached; 0 of a free row */
    sat4_real sigma[3];          /* singular values of (S K^-1 S^T)^-1/2 S K^-1 I Theta_ff^-1/2, descending */
    int rank;                    /* number of singular values above the rank threshold */
    sat4_real damped_by;         /* largest damping lambda applied, in units of sigma; 0: none */
    int limited[SAT4_N];         /* 1 if the flywheel reached its limit */
    sat4_real hardest[3];        /* m/s2, rad/s2; the unreachable part of the demand, or the one hardest to
                                  * reach; a unit in its norm */
} sat4_inverse_pointing_result;

/* Result of torque_for_pointing and its quality. */
typedef struct sat4_torque_for_pointing_result {
    sat4_real tau[SAT4_N];       /* N m; drive torques */
    sat4_real phi_ddot[SAT4_N];  /* rad/s2; flywheel accelerations that result */
    sat4_real V_dot[6];          /* m/s2, rad/s2; motion of the carrier that results */
    sat4_real residual[3];       /* m/s2, rad/s2; demand minus reached; 0 of a free row */
    sat4_real share;             /* part of the demand that is met, with keep_direction; else 1 */
    int limited[SAT4_N];         /* 1 if the torque is at its limit */
} sat4_torque_for_pointing_result;

/* Derivatives of coupled. */
typedef struct sat4_coupled_jacobian_result {
    sat4_real V_dot_V[6][6];                     /* of V* by V: row i, column j */
    sat4_real V_dot_phi[6][SAT4_N];              /* of V* by the phases */
    sat4_real V_dot_phi_dot[6][SAT4_N];          /* by the speeds */
    sat4_real V_dot_tau[6][SAT4_N];              /* by the drive torques */
    sat4_real phi_ddot_V[SAT4_N][6];             /* of phi'' by V: row s, column j */
    sat4_real phi_ddot_phi[SAT4_N][SAT4_N];      /* of phi'' by the phases */
    sat4_real phi_ddot_phi_dot[SAT4_N][SAT4_N];  /* by the speeds */
    sat4_real phi_ddot_tau[SAT4_N][SAT4_N];      /* by the drive torques */
} sat4_coupled_jacobian_result;

/* Derivatives of forward. */
typedef struct sat4_forward_jacobian_result {
    sat4_real V_dot_V[6][6];              /* of V* by V: row i, column j */
    sat4_real V_dot_phi[6][SAT4_N];       /* of V* by the phases */
    sat4_real V_dot_phi_dot[6][SAT4_N];   /* by the speeds */
    sat4_real V_dot_phi_ddot[6][SAT4_N];  /* by the accelerations */
} sat4_forward_jacobian_result;

extern const sat4_parameters sat4_default_parameters;             /* of the stand file */
extern const sat4_table sat4_default;                             /* made of them */
extern const sat4_inverse_options sat4_default_options;           /* of inverse, by the stand file */

/* ---- functions ---- */

/* forward: acceleration of the carrier for given accelerations of the flywheels: K V* = F - M V - sum(I
 * phi'' + J phi'), (8).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   phi_ddot[4]  rad/s2; flywheel accelerations
 *   V_dot[6]     out: m/s2, rad/s2; derivative of the components of V; may overlap any input
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 1329 operations on reals, 3 of them divisions. Stack: at most 1600 bytes. */
sat4_status sat4_forward(const sat4_table *table, const sat4_state *x, const sat4_real phi_ddot[SAT4_N],
                         sat4_real V_dot[6]);

/* matrices: the matrices of K V* + M V + I phi'' + J phi' = F at a state, (2), (6)-(9).
 *   table  the prepared table
 *   x      state; its attitude within 1e-3 of unit length
 *   out    out: K, K_dot, M, I, J, F
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 1408 operations on reals, no division. Stack: at most 1552 bytes. */
sat4_status sat4_matrices(const sat4_table *table, const sat4_state *x, sat4_matrices_result *out);

/* momentum: momentum screw, kinetic energy, mass centre of the whole system and its velocity, (1), (2).
 *   table  the prepared table
 *   x      state; its attitude within 1e-3 of unit length
 *   out    out: Z, Z0, energy, mass centre and its velocity
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 1373 operations on reals, 1 of them a division. Stack: at most 1584 bytes. */
sat4_status sat4_momentum(const sat4_table *table, const sat4_state *x, sat4_momentum_result *out);

/* torque: drive torques for a given motion: tau = f^T (Theta V_s* + Phi(V_s) Z_s - P_s).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   V_dot[6]     m/s2, rad/s2; derivative of the components of V
 *   phi_ddot[4]  rad/s2; flywheel accelerations
 *   tau[4]       out: N m; drive torques, mount on flywheel, about the spin axis
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 808 operations on reals, no division. Stack: at most 1296 bytes. */
sat4_status sat4_torque(const sat4_table *table, const sat4_state *x, const sat4_real V_dot[6],
                        const sat4_real phi_ddot[SAT4_N], sat4_real tau[SAT4_N]);

/* coupled: motion of the whole system under given drive torques: V* and phi'' together, flywheels
 * eliminated first.
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   tau[4]       N m; drive torques, mount on flywheel
 *   locked[4]    not 0: a lock holds phi'' = 0, whatever its tau; null: no lock
 *   V_dot[6]     out: m/s2, rad/s2; derivative of the components of V
 *   phi_ddot[4]  out: rad/s2; flywheel accelerations
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 2065 operations on reals, 4 of them divisions. Stack: at most 2624 bytes. */
sat4_status sat4_coupled(const sat4_table *table, const sat4_state *x, const sat4_real tau[SAT4_N],
                         const int locked[SAT4_N], sat4_real V_dot[6], sat4_real phi_ddot[SAT4_N]);

/* step: state after one time step; drive torques and wrenches are held constant.
 *   table      the prepared table
 *   x          state; its attitude within 1e-3 of unit length
 *   tau[4]     N m; drive torques, mount on flywheel
 *   locked[4]  not 0: a lock holds phi'' = 0, whatever its tau; null: no lock
 *   dt         s; time step, greater than 0
 *   order      4: Runge-Kutta, four evaluations; 2: midpoint rule, two
 *   next       out: state after the step; may be x itself
 * RANGE also if a stage of the step or the new state is out of range.
 * COARSE: dt times the fastest of |phi_dot| and |omega| is above MAX_TURN_4 rad (order 2: MAX_TURN_2). At
 * this bound the vibration of an unbalance is wrong by 3e-4 of its size after a turn, one of twice the
 * speed (asymmetry) by 4e-3 (order 2: 1e-3). Errors grow with dt^4 (dt^2), beyond twice the bound faster.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, COARSE. Nothing is written when the
 * status is negative.
 * At most 8793 operations on reals, 22 of them divisions. Stack: at most 3728 bytes. */
sat4_status sat4_step(const sat4_table *table, const sat4_state *x, const sat4_real tau[SAT4_N],
                      const int locked[SAT4_N], sat4_real dt, int order, sat4_state *next);

/* step_driven: state after one time step; given flywheel accelerations and wrenches are held constant.
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   phi_ddot[4]  rad/s2; flywheel accelerations
 *   dt           s; time step, greater than 0
 *   order        4: Runge-Kutta, four evaluations; 2: midpoint rule, two
 *   next         out: state after the step; may be x itself
 * RANGE also if a stage of the step or the new state is out of range.
 * COARSE: dt times the fastest of |phi_dot| and |omega| is above MAX_TURN_4 rad (order 2: MAX_TURN_2). At
 * this bound the vibration of an unbalance is wrong by 3e-4 of its size after a turn, one of twice the
 * speed (asymmetry) by 4e-3 (order 2: 1e-3). Errors grow with dt^4 (dt^2), beyond twice the bound faster.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, COARSE. Nothing is written when the
 * status is negative.
 * At most 5849 operations on reals, 18 of them divisions. Stack: at most 2816 bytes. */
sat4_status sat4_step_driven(const sat4_table *table, const sat4_state *x, const sat4_real phi_ddot[SAT4_N],
                             sat4_real dt, int order, sat4_state *next);

/* wrap: the angle wrapped to [-pi, pi] (pi rounded to the nearest real).
 *   phi      rad; any angle within MAX_PHASE
 *   wrapped  out: rad; the same angle in [-pi, pi]
 * Error below 5e-16 rad, modulo one turn.
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 29 operations on reals, no division. Stack: at most 544 bytes. */
sat4_status sat4_wrap(sat4_real phi, sat4_real *wrapped);

/* phase_of_counts: phase for a count of an encoder.
 *   count     any count of the encoder; or `place` of accumulate
 *   per_turn  counts per turn, at most 1073741824 in magnitude; negative if phi falls as counts rise
 *   zero      count at phi = 0, at most one turn in magnitude
 *   phi       out: rad; phase, in [-pi, pi] (pi rounded to the nearest real)
 * Error at most 2 units in the last place for a whole `zero` and every count: the phase does not drift.
 * Also returns RANGE if |zero| is more than one turn.
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 20 operations on reals, 1 of them a division. Stack: at most 448 bytes. */
sat4_status sat4_phase_of_counts(int count, int per_turn, sat4_real zero, sat4_real *phi);

/* speed_of_counts: mean speed of a flywheel from the counts of one interval.
 *   moved     counts during dt: `moved` of accumulate
 *   per_turn  counts per turn, at most 1073741824 in magnitude; negative if phi falls as counts rise
 *   dt        s; greater than 0
 *   phi_dot   out: rad/s; mean speed during dt
 * Also returns RANGE if the speed is beyond MAX_SPEED. Resolution: one count is 2 pi/(per_turn dt).
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 10 operations on reals, 2 of them divisions. Stack: at most 336 bytes. */
sat4_status sat4_speed_of_counts(int moved, int per_turn, sat4_real dt, sat4_real *phi_dot);

/* accumulate: takes one reading of an encoder's counter, which may wrap: place in the turn and counts
 * moved, both exact.
 *   encoder   in and out: start with counter = first reading, place = its counts within the turn
 *   counter   counter as read; a 32-bit counter as a signed number
 *   bits      width of the counter, 2 to 32; 0: it counts 0 to per_turn - 1
 *   per_turn  counts per turn, at most 1073741824 in magnitude; negative if phi falls as counts rise
 * Call it before the counter has moved by half its range (by half a turn if bits is 0).
 * phase_of_counts makes a phase of `place`, speed_of_counts a speed of `moved`; the phase does not drift.
 * Returns OK, BAD_ARGUMENT. Nothing is written when the status is negative.
 * No operation on reals. Stack: at most 304 bytes. */
sat4_status sat4_accumulate(sat4_encoder *encoder, int counter, int bits, int per_turn);

/* forward_jacobian: derivatives of forward by V, phi, phi' and phi'', at fixed position and attitude, (8).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   phi_ddot[4]  rad/s2; flywheel accelerations
 *   out          out: derivatives of V*
 * At a kink of a damping law with magnitudes, the derivative from one side is returned.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 4993 operations on reals, 21 of them divisions. Stack: at most 4144 bytes. */
sat4_status sat4_forward_jacobian(const sat4_table *table, const sat4_state *x,
                                  const sat4_real phi_ddot[SAT4_N], sat4_forward_jacobian_result *out);

/* coupled_jacobian: derivatives of coupled by V, phi, phi' and tau, at fixed position and attitude.
 *   table      the prepared table
 *   x          state; its attitude within 1e-3 of unit length
 *   tau[4]     N m; drive torques, mount on flywheel
 *   locked[4]  not 0: a lock holds phi'' = 0, whatever its tau; null: no lock
 *   out        out: derivatives of V* and phi''
 * At a kink of a damping law with magnitudes, the derivative from one side is returned.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 8281 operations on reals, 22 of them divisions. Stack: at most 5664 bytes. */
sat4_status sat4_coupled_jacobian(const sat4_table *table, const sat4_state *x, const sat4_real tau[SAT4_N],
                                  const int locked[SAT4_N], sat4_coupled_jacobian_result *out);

/* inverse: flywheel accelerations for a wanted motion of the carrier: I phi'' = F - K V* - M V - J phi'.
 * Least residual in the norm of K^-1, then least weighted norm of phi''. What a flywheel at its limit
 * cannot give is shared among the others, (12).
 *   table     the prepared table
 *   x         state; its attitude within 1e-3 of unit length
 *   V_dot[6]  m/s2, rad/s2; wanted derivative of the components of V
 *   options   weights, limits, damping; default_options holds those of the stand file
 *   out       out: phi_ddot and its quality
 * Positive statuses are bits and may be combined.
 * RANGE also where the answer is no finite number.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, NEAR_SINGULAR, DAMPED, LIMITED,
 * UNREACHABLE, RANK_DEFICIENT, EXCESSIVE. Nothing is written when the status is negative.
 * At most 53874 operations on reals, 1991 of them divisions. Stack: at most 4784 bytes. */
sat4_status sat4_inverse(const sat4_table *table, const sat4_state *x, const sat4_real V_dot[6],
                         const sat4_inverse_options *options, sat4_inverse_result *out);

/* inverse_fast: flywheel accelerations for a wanted motion of the carrier, without diagnostics: normal
 * equations, (12).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   V_dot[6]     m/s2, rad/s2; wanted derivative of the components of V
 *   options      weights and damping; `near_singular` and `limit` are ignored
 *   phi_ddot[4]  out: rad/s2; flywheel accelerations
 * Squares the condition number: as accurate as inverse if singular values differ by a factor of at most
 * some thousand; returns NOT_POSITIVE_DEFINITE if they differ by more and damping is 0.
 * Damping is relative to the norm of W.
 * EXCESSIVE counts Theta_ff phi'' and the friction of the motor. The torque that the carrier's motion adds
 * is left out: `torque` and `inverse` have it. What the options say of motors is not checked; it decides
 * this bit alone.
 * RANGE also where the answer is no finite number.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, EXCESSIVE. Nothing is written when
 * the status is negative.
 * At most 2275 operations on reals, 47 of them divisions. Stack: at most 3776 bytes. */
sat4_status sat4_inverse_fast(const sat4_table *table, const sat4_state *x, const sat4_real V_dot[6],
                              const sat4_inverse_options *options, sat4_real phi_ddot[SAT4_N]);

/* inverse_pointing: flywheel accelerations for the task pointing: what no row names is free, found by the
 * dynamics. Least error in the norm of (S K^-1 S^T)^-1, then least weighted norm of phi''.
 *   table      the prepared table
 *   x          state; its attitude within 1e-3 of unit length
 *   demand[3]  m/s2, rad/s2; wanted: wx, wy, wz
 *   options    weights, limits, damping, rows; default_options holds those of the stand file
 *   out        out: phi_ddot, the motion and its quality
 * Positive statuses are bits and may be combined.
 * A row is free where its flag in the options is 0; its demand must be a number nevertheless.
 * RANGE also where the answer is no finite number.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, NEAR_SINGULAR, DAMPED, LIMITED,
 * UNREACHABLE, RANK_DEFICIENT, EXCESSIVE. Nothing is written when the status is negative.
 * At most 21346 operations on reals, 977 of them divisions. Stack: at most 4432 bytes. */
sat4_status sat4_inverse_pointing(const sat4_table *table, const sat4_state *x, const sat4_real demand[3],
                                  const sat4_inverse_options *options, sat4_inverse_pointing_result *out);

/* inverse_fast_pointing: flywheel accelerations for the task pointing, without diagnostics: normal
 * equations.
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   demand[3]    m/s2, rad/s2; wanted: wx, wy, wz
 *   options      weights, limits, damping, rows; default_options holds those of the stand file
 *   phi_ddot[4]  out: rad/s2; flywheel accelerations
 * Squares the condition number: as accurate as inverse_pointing if singular values differ by a factor of
 * at most some thousand; returns NOT_POSITIVE_DEFINITE if they differ by more and damping is 0.
 * Damping is relative to the norm of W.
 * EXCESSIVE counts Theta_ff phi'' and the friction of the motor. The torque that the carrier's motion adds
 * is left out: `torque` and `inverse` have it. What the options say of motors is not checked; it decides
 * this bit alone.
 * A row is free where its flag in the options is 0; its demand must be a number nevertheless.
 * RANGE also where the answer is no finite number.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, EXCESSIVE. Nothing is written when
 * the status is negative.
 * At most 2195 operations on reals, 65 of them divisions. Stack: at most 4112 bytes. */
sat4_status sat4_inverse_fast_pointing(const sat4_table *table, const sat4_state *x,
                                       const sat4_real demand[3], const sat4_inverse_options *options,
                                       sat4_real phi_ddot[SAT4_N]);

/* torque_for_pointing: drive torques for the task pointing, within what the motors have. Least error in
 * the norm of (S K_c^-1 S^T)^-1, K_c = K - sum I I^T / Theta_ff of the free flywheels; then torques
 * nearest to those of the preferred accelerations.
 *   table      the prepared table
 *   x          state; its attitude within 1e-3 of unit length
 *   demand[3]  m/s2, rad/s2; wanted: wx, wy, wz
 *   options    weights, limits, damping, rows; default_options holds those of the stand file
 *   locked[4]  not 0: a lock holds phi'' = 0, whatever its tau; null: no lock
 *   out        out: tau, the motion and its quality
 * With keep_direction a demand out of reach is made smaller, not turned: share is the part that is met.
 * A flywheel whose lock or failure is known goes into `locked`: the others do its part.
 * Directions in which torques move the carrier 1e-06 times less than in the strongest are given up in
 * part.
 * Positive statuses are bits and may be combined.
 * A row is free where its flag in the options is 0; its demand must be a number nevertheless.
 * RANGE also where the answer is no finite number.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, LIMITED, UNREACHABLE. Nothing is
 * written when the status is negative.
 * At most 48162 operations on reals, 6724 of them divisions. Stack: at most 5056 bytes. */
sat4_status sat4_torque_for_pointing(const sat4_table *table, const sat4_state *x, const sat4_real demand[3],
                                     const sat4_inverse_options *options, const int locked[SAT4_N],
                                     sat4_torque_for_pointing_result *out);

/* points: readings of an accelerometer and a gyro at each instrument and point.
 *   table     the prepared table
 *   x         state; its attitude within 1e-3 of unit length
 *   V_dot[6]  m/s2, rad/s2; derivative of the components of V
 *   out[1]    out: one reading for each instrument, then for each point
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 386 operations on reals, 1 of them a division. Stack: at most 1104 bytes. */
sat4_status sat4_points(const sat4_table *table, const sat4_state *x, const sat4_real V_dot[6],
                        sat4_points_result out[SAT4_SENSORS]);

/* quaternion: attitude quaternion of three angles.
 *   angles[3]    rad; psi, theta, phi of C = C3(psi) C2(theta) C1(phi) (ship)
 *   attitude[4]  out: unit quaternion, w first
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 183 operations on reals, no division. Stack: at most 1008 bytes. */
sat4_status sat4_quaternion(const sat4_real angles[3], sat4_real attitude[4]);

/* state_from_coordinates: state and V* of a wanted motion in generalized coordinates: V = A q', V* = A q''
 * + D q', (10).
 *   position[3]  m; position of O1, in E0
 *   angles[3]    rad; psi, theta, phi of C = C3(psi) C2(theta) C1(phi) (ship)
 *   q_dot[6]     m/s, rad/s; rates of position and of the angles
 *   q_ddot[6]    m/s2, rad/s2; rates of q_dot
 *   x            in and out: its position, attitude and V are written; phases and speeds are kept
 *   V_dot[6]     out: m/s2, rad/s2; derivative of the components of V
 * Returns OK, NOT_FINITE, RANGE, SINGULAR_ATTITUDE, BAD_ARGUMENT. Nothing is written when the status is
 * negative.
 * At most 479 operations on reals, 1 of them a division. Stack: at most 1408 bytes. */
sat4_status sat4_state_from_coordinates(const sat4_real position[3], const sat4_real angles[3],
                                        const sat4_real q_dot[6], const sat4_real q_ddot[6], sat4_state *x,
                                        sat4_real V_dot[6]);

/* generalized: the equations in generalized coordinates: A, D, I0, J0, q', and q'' for given phi'', (10),
 * (11).
 *   table        the prepared table
 *   x            state; its attitude is ignored, `angles` replaces it
 *   angles[3]    rad; psi, theta, phi of C = C3(psi) C2(theta) C1(phi) (ship)
 *   phi_ddot[4]  rad/s2; flywheel accelerations
 *   out          out: A, D, I0, J0, q_dot, q_ddot
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, SINGULAR_ATTITUDE, BAD_ARGUMENT. Nothing is
 * written when the status is negative.
 * At most 4537 operations on reals, 5 of them divisions. Stack: at most 3840 bytes. */
sat4_status sat4_generalized(const sat4_table *table, const sat4_state *x, const sat4_real angles[3],
                             const sat4_real phi_ddot[SAT4_N], sat4_generalized_result *out);

/* prepare: makes the table of a stand from masses, centres of mass, inertias and mountings, (2).
 *   parameters  masses, inertias, mountings
 *   table       in and out: start with a copy of the default; its laws (gravity, damping, ...) are kept
 * The generator makes the default table by the same operations: the default parameters give its bits.
 * Also returns RANGE if a mass is negative or an axis has no direction.
 * NOT_POSITIVE_DEFINITE: no such body exists. Moments of inertia about the centre of mass are negative or
 * break the triangle inequality (to 1e-09 of the largest element); a flywheel without spin inertia; no
 * mass at all.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 6073 operations on reals, 44 of them divisions. Stack: at most 2032 bytes. */
sat4_status sat4_prepare(const sat4_parameters *parameters, sat4_table *table);

/* mounts: wrench of the mount on each flywheel: the bearing loads. Their opposites shake the structure.
 *   mounting          made once by prepare_mounts
 *   x                 state; its attitude within 1e-3 of unit length
 *   V_dot[6]          m/s2, rad/s2; derivative of the components of V
 *   phi_ddot[4]       rad/s2; flywheel accelerations
 *   mount_wrench[24]  out: N, N m; of the mount on each flywheel, six numbers each, about Os in the axes
 *                     of Es at phi = 0; the fourth is tau
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 1418 operations on reals, no division. Stack: at most 1536 bytes. */
sat4_status sat4_mounts(const sat4_mount_table *mounting, const sat4_state *x, const sat4_real V_dot[6],
                        const sat4_real phi_ddot[SAT4_N], sat4_real mount_wrench[24]);

/* prepare_mounts: makes the second table, which the function mounts needs.
 *   parameters  masses, inertias, mountings
 *   mounting    out: table for the function mounts
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 2132 operations on reals, 33 of them divisions. Stack: at most 1568 bytes. */
sat4_status sat4_prepare_mounts(const sat4_parameters *parameters, sat4_mount_table *mounting);

/* step_carried: state after one time step under drive torques and wrenches, held constant; sums are
 * compensated by a carry.
 *   table      the prepared table
 *   x          state; its attitude within 1e-3 of unit length
 *   tau[4]     N m; drive torques, mount on flywheel
 *   locked[4]  not 0: a lock holds phi'' = 0, whatever its tau; null: no lock
 *   dt         s; time step, greater than 0
 *   order      4: Runge-Kutta, four evaluations; 2: midpoint rule, two
 *   carry      in and out: of the step before; at first all zero
 *   next       out: state after the step; may be x itself
 * Statuses as of step. A carry belongs to its state: where another state is set, set the carry to zero.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, COARSE. Nothing is written when the
 * status is negative.
 * At most 9061 operations on reals, 22 of them divisions. Stack: at most 3952 bytes. */
sat4_status sat4_step_carried(const sat4_table *table, const sat4_state *x, const sat4_real tau[SAT4_N],
                              const int locked[SAT4_N], sat4_real dt, int order, sat4_step_carry *carry,
                              sat4_state *next);

/* step_driven_carried: state after one time step under given flywheel accelerations and wrenches, held
 * constant; sums are compensated by a carry.
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   phi_ddot[4]  rad/s2; flywheel accelerations
 *   dt           s; time step, greater than 0
 *   order        4: Runge-Kutta, four evaluations; 2: midpoint rule, two
 *   carry        in and out: of the step before; at first all zero
 *   next         out: state after the step; may be x itself
 * Statuses as of step_driven. A carry belongs to its state: where another state is set, set the carry to
 * zero.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, COARSE. Nothing is written when the
 * status is negative.
 * At most 6117 operations on reals, 18 of them divisions. Stack: at most 3040 bytes. */
sat4_status sat4_step_driven_carried(const sat4_table *table, const sat4_state *x,
                                     const sat4_real phi_ddot[SAT4_N], sat4_real dt, int order,
                                     sat4_step_carry *carry, sat4_state *next);

#ifdef __cplusplus
}
#endif

#endif
