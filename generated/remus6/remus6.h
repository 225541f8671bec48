/* remus6.h: motion of the stand "remus6": carrier, 1 instrument, 6 flywheels.
 * mahovik 0.1.0; structure 3687deee, physics 5f25aea2. Generated: change the stand file instead.
 *
 * C99, no libm, no allocation, stack only, constant globals: any core may call any function at any time.
 * Compile with -ffp-contract=off (no fused multiply-add): then every processor with IEEE 754 arithmetic gives
 * the same bits.
 * Also needed: for 32-bit x86 -msse2 -mfpmath=sse; with gcc 12 for x86-64 with FMA
 * and for a Cortex-M55 -fno-tree-vectorize. gcc may call memcpy, memmove and memset.
 * Never with -ffast-math, -Ofast, -funsafe-math-optimizations or parts of them: wrong results with status OK.
 * The source refuses what the compiler shows of them; clang does not show all.
 * REMUS6_SQRT, defined for the source, takes the square root of a processor in the place of its own:
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
#ifndef REMUS6_H
#define REMUS6_H

/* The linker sees names that end in the kind of the reals and a hash of this header: a caller with the
 * header of another stand, element type, choice of functions or version does not link. Define
 * REMUS6_PLAIN_NAMES for all files, and it sees the names as they are, as dlsym, --wrap and other
 * languages need them. */
#ifndef REMUS6_PLAIN_NAMES
#define remus6_default_parameters     remus6_default_parameters_f64_460929de
#define remus6_default                remus6_default_f64_460929de
#define remus6_default_options        remus6_default_options_f64_460929de
#define remus6_forward                remus6_forward_f64_460929de
#define remus6_matrices               remus6_matrices_f64_460929de
#define remus6_momentum               remus6_momentum_f64_460929de
#define remus6_torque                 remus6_torque_f64_460929de
#define remus6_coupled                remus6_coupled_f64_460929de
#define remus6_step                   remus6_step_f64_460929de
#define remus6_step_driven            remus6_step_driven_f64_460929de
#define remus6_wrap                   remus6_wrap_f64_460929de
#define remus6_phase_of_counts        remus6_phase_of_counts_f64_460929de
#define remus6_speed_of_counts        remus6_speed_of_counts_f64_460929de
#define remus6_accumulate             remus6_accumulate_f64_460929de
#define remus6_forward_jacobian       remus6_forward_jacobian_f64_460929de
#define remus6_coupled_jacobian       remus6_coupled_jacobian_f64_460929de
#define remus6_inverse                remus6_inverse_f64_460929de
#define remus6_inverse_fast           remus6_inverse_fast_f64_460929de
#define remus6_points                 remus6_points_f64_460929de
#define remus6_quaternion             remus6_quaternion_f64_460929de
#define remus6_state_from_coordinates remus6_state_from_coordinates_f64_460929de
#define remus6_generalized            remus6_generalized_f64_460929de
#define remus6_prepare                remus6_prepare_f64_460929de
#define remus6_mounts                 remus6_mounts_f64_460929de
#define remus6_prepare_mounts         remus6_prepare_mounts_f64_460929de
#define remus6_step_carried           remus6_step_carried_f64_460929de
#define remus6_step_driven_carried    remus6_step_driven_carried_f64_460929de
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define REMUS6_STRUCTURE 0x3687deeeu  /* hash of the stand's names, counts and kinds of wrench */
#define REMUS6_PHYSICS   0x5f25aea2u  /* hash of its structure and all numbers */
#define REMUS6_TABLE_HASH 0x742e2d85u /* FNV-1a of all numbers of the default table but its stream */
#define REMUS6_REAL_BYTES 8           /* bytes of a remus6_real */
#define REMUS6_VERSION_MAJOR 0        /* of the mahovik that wrote this */
#define REMUS6_VERSION_MINOR 1
#define REMUS6_VERSION_PATCH 0

typedef double remus6_real;

/* ---- ranges of inputs: magnitudes ---- */

#define REMUS6_MAX_POSITION      1.0e6     /* m; each component of the position of O1 */
#define REMUS6_MAX_VELOCITY      1.0e4     /* m/s; each component of v */
#define REMUS6_MAX_SPEED         1.0e5     /* rad/s; each component of omega, each phi_dot */
#define REMUS6_MAX_PHASE         1.0e7     /* rad; each phase and attitude angle */
#define REMUS6_MAX_ACCELERATION  1.0e9     /* rad/s2; each phi_ddot */
#define REMUS6_MAX_WRENCH        1.0e9     /* N, N m; each component of a run-time wrench */
#define REMUS6_MAX_STEP          10.0      /* s; a time step */
#define REMUS6_MAX_PARAMETER     1.0e15    /* SI; each mass, length and moment of inertia */
#define REMUS6_MAX_WEIGHT        1.0e6     /* the weight of a flywheel in inverse; at least its inverse */
#define REMUS6_MAX_ROUNDING      1.0       /* SI; each number of a carry */
#define REMUS6_MAX_TURN_4        1.0       /* rad; turn in a step of order 4; beyond: COARSE */
#define REMUS6_MAX_TURN_2        0.1       /* rad; turn in a step of order 2; beyond: COARSE */
#define REMUS6_LARGEST           1.7976931348623157e308  /* largest finite number */

/* ---- status of every function: negative: refused, outputs untouched; positive: bits, outputs valid ---- */

typedef int remus6_status;  /* not the enum, whose size compilers choose */

enum {
    REMUS6_OK = 0,                        /* success */
    REMUS6_NEAR_SINGULAR = 1,             /* least singular value below `near_singular` times the largest */
    REMUS6_DAMPED = 2,                    /* damping was applied */
    REMUS6_LIMITED = 4,                   /* a limit was reached; `limited` says by which flywheels */
    REMUS6_UNREACHABLE = 8,               /* wanted motion not reached: residual above 1e-9 of the demand */
    REMUS6_RANK_DEFICIENT = 16,           /* fewer than min(6, N) singular values above 1e-9 of the largest */
    REMUS6_COARSE = 32,                   /* step too long: more than MAX_TURN_4 or MAX_TURN_2 turned in it */
    REMUS6_EXCESSIVE = 64,                /* more than a motor's torque or speed, or than `most` */
    REMUS6_NOT_FINITE = -1,               /* an input is NaN or infinite */
    REMUS6_RANGE = -2,                    /* out of range, quaternion off unit length */
    REMUS6_NOT_POSITIVE_DEFINITE = -3,    /* no mass, no spin inertia, or a pivot failed */
    REMUS6_SINGULAR_ATTITUDE = -4,        /* attitude angles within 1e-6 of their singularity */
    REMUS6_BAD_ARGUMENT = -5              /* a null pointer, a count, an index, a step or an option */
};

/* ---- numbers of bodies ---- */

/* flywheels, in the order of the stand file */
enum { REMUS6_W1, REMUS6_W2, REMUS6_W3, REMUS6_W4, REMUS6_W5, REMUS6_W6, REMUS6_N = 6 };
/* instruments and points: those of the function points */
enum { REMUS6_SENSOR_NOSE, REMUS6_SENSOR_IMU, REMUS6_SENSORS = 2 };

/* ---- data ---- */

/* State of the whole system. */
typedef struct remus6_state {
    remus6_real position[3];        /* m; position of O1, in E0 */
    remus6_real attitude[4];        /* unit quaternion, w first: x0 = C x1 */
    remus6_real V[6];               /* m/s, rad/s; twist of the carrier relative to E0, in E1 */
    remus6_real phi[REMUS6_N];      /* rad; phases */
    remus6_real phi_dot[REMUS6_N];  /* rad/s; speeds relative to the mount */
} remus6_state;

/* What rounding took from a state: kept from step to step, all zero at first. */
typedef struct remus6_step_carry {
    remus6_real rounding[25];  /* SI; of each number of the state, in its order */
} remus6_step_carry;

/* Mass properties of one body, in its own frame. */
typedef struct remus6_body {
    remus6_real mass;                 /* kg */
    remus6_real center_of_mass[3];    /* m; rc, from the body's origin, in its own axes */
    remus6_real inertia[6];           /* kg m2; J11, J22, J33, J12, J13, J23 about the body's origin */
    remus6_real displaced_mass;       /* kg; mass of the displaced fluid */
    remus6_real displaced_center[3];  /* m; centre of buoyancy, in the body's frame */
} remus6_body;

/* An instrument fixed on the carrier. */
typedef struct remus6_instrument {
    remus6_body body;
    remus6_real position[3];  /* m; Op, in E1 */
    remus6_real axis[3];      /* first axis of Ep in E1, any length */
    remus6_real zero[3];      /* its component perpendicular to the first axis is the second axis of Ep */
} remus6_instrument;

/* Mass properties of a flywheel, in its own frame. */
typedef struct remus6_dry_body {
    remus6_real mass;               /* kg */
    remus6_real center_of_mass[3];  /* m; rc, from the body's origin, in its own axes */
    remus6_real inertia[6];         /* kg m2; J11, J22, J33, J12, J13, J23 about the body's origin */
} remus6_dry_body;

/* A flywheel and how it is mounted. */
typedef struct remus6_flywheel {
    remus6_dry_body body;
    remus6_real position[3];  /* m; Os, in the frame of the mount */
    remus6_real axis[3];      /* spin axis in the frame of the mount, any length */
    remus6_real zero[3];      /* its component perpendicular to the axis is the second axis of Es at phi =
                               * 0 */
    int mount;                /* index of the instrument it is mounted on; -1: the carrier */
} remus6_flywheel;

/* A sensor or a place of interest. */
typedef struct remus6_point {
    remus6_real position[3];  /* m; in the frame of the mount */
    remus6_real axis[3];      /* first axis in the frame of the mount, any length */
    remus6_real zero[3];      /* its component perpendicular to the first axis is the second axis */
    int mount;                /* index of the instrument it is mounted on; -1: the carrier */
} remus6_point;

/* Masses, inertias and mountings, of which the table is made. */
typedef struct remus6_parameters {
    remus6_body carrier;
    remus6_real added_mass[6][6];        /* kg, kg m, kg m2; Lambda of all bodies, about O1 in E1 */
    remus6_instrument instrument[1];
    remus6_flywheel flywheel[REMUS6_N];
    remus6_point point[1];
} remus6_parameters;

/* Table of one flywheel: harmonics of its terms in (8), in E1 about O1. */
typedef struct remus6_row {
    remus6_real mu_c[3];        /* kg m; first moment about O1: cos phi */
    remus6_real mu_s[3];        /* kg m; sin phi */
    remus6_real J_c[6];         /* kg m2; inertia about O1, 11 22 33 12 13 23: cos phi */
    remus6_real J_s[6];         /* kg m2; sin phi */
    remus6_real J_2c[6];        /* kg m2; cos 2 phi */
    remus6_real J_2s[6];        /* kg m2; sin 2 phi */
    remus6_real t_0[3];         /* kg m2; moment part of I: constant */
    remus6_real t_c[3];         /* kg m2; cos phi */
    remus6_real t_s[3];         /* kg m2; sin phi */
    remus6_real spin;           /* kg m2; Theta_ff: inertia about the spin axis */
    remus6_real spin_inv;       /* 1/(kg m2) */
    remus6_real spin_root_inv;  /* 1/(kg m2)^0.5; 1/sqrt(spin): scales the unknowns of (12) */
} remus6_row;

/* Pose of an instrument or a point. */
typedef struct remus6_sensor {
    remus6_real origin[3];  /* m; in E1 */
    remus6_real axes[9];    /* own axes to E1, row by row */
} remus6_sensor;

/* Damping of one body, in its own frame. */
typedef struct remus6_damper {
    int first_term;  /* terms first_term .. last_term - 1 of the table */
    int last_term;
} remus6_damper;

/* A hydrodynamic derivative. */
typedef struct remus6_term {
    int wrench;         /* component of the wrench, 0..5 = X Y Z K M N */
    int first;          /* 0..5 = u v w p q r, 6..11 their magnitudes */
    int second;         /* likewise */
    remus6_real value;  /* SI; wrench += value * first * second */
} remus6_term;

/* The constants of the equations, made of the parameters; the laws at the end (gravity, ...) are as given. */
typedef struct remus6_table {
    remus6_real mass;                      /* kg; mass of all bodies */
    remus6_real mass_inverse;              /* 1/kg */
    remus6_real first_moment[3];           /* kg m; mu about O1, constant part */
    remus6_real inertia[6];                /* kg m2; J about O1, 11 22 33 12 13 23, constant part, with
                                            * added mass */
    remus6_real A[6];                      /* kg; m E + Lambda_11: 11 22 33 12 13 23 */
    remus6_real A_inv[6];                  /* 1/kg */
    remus6_real G[9];                      /* kg m; Lambda_21, row by row */
    remus6_real weight_mass;               /* kg; mass minus displaced mass */
    remus6_real displaced_moment[3];       /* kg m; first moment of displaced fluid, constant part */
    remus6_row flywheel[REMUS6_N];
    remus6_sensor sensor[REMUS6_SENSORS];
    remus6_real gravity[3];                /* m/s2; in E0 */
    remus6_real stream[3];                 /* m/s; velocity of the fluid, in E0 */
    remus6_damper damper;                  /* of the carrier */
    remus6_term term[10];
} remus6_table;

/* The matrices of (8). */
typedef struct remus6_matrices_result {
    remus6_real K[6][6];          /* kg, kg m, kg m2; mass matrix (2) */
    remus6_real K_dot[6][6];      /* per s; its rate (6) */
    remus6_real M[6][6];          /* per s; velocity matrix (9), at V relative to the stream */
    remus6_real I_[6][REMUS6_N];  /* kg m, kg m2; flywheel coupling (9), one column per flywheel */
    remus6_real J[6][REMUS6_N];   /* per s; its velocity part (9) */
    remus6_real F[6];             /* N, N m; total external wrench (7) */
} remus6_matrices_result;

/* Momentum, energy, mass centre and its velocity. */
typedef struct remus6_momentum_result {
    remus6_real Z[6];                        /* kg m/s, kg m2/s; momentum screw in E1 about O1 (2) */
    remus6_real Z0[6];                       /* kg m/s, kg m2/s; momentum screw in E0 about its origin (1) */
    remus6_real energy;                      /* J; kinetic energy */
    remus6_real center_of_mass[3];           /* m; mass centre of all bodies, in E1 */
    remus6_real center_of_mass_velocity[3];  /* m/s; of the mass centre relative to E0, in E0 */
} remus6_momentum_result;

/* The equations in generalized coordinates q = (O1 in E0; psi, theta, phi). */
typedef struct remus6_generalized_result {
    remus6_real A[6][6];    /* V = A q' (10) */
    remus6_real D[6][6];    /* 1/s; A' along the motion (10) */
    remus6_real I0[6][6];   /* K A (11) */
    remus6_real J0[6][6];   /* K D + M A (11) */
    remus6_real q_dot[6];   /* m/s, rad/s; O1 in E0, then psi, theta, phi */
    remus6_real q_ddot[6];  /* m/s2, rad/s2; solution of (11) for the given phi_ddot */
} remus6_generalized_result;

/* One flywheel and its mounting; used by mounts only. */
typedef struct remus6_mount {
    remus6_real mass;             /* kg */
    remus6_real first_moment[3];  /* kg m; m rc, in Es */
    remus6_real inertia[6];       /* kg m2; about Os in Es, 11 22 33 12 13 23 */
    remus6_real origin[3];        /* m; Os in E1 */
    remus6_real axes[9];          /* axes of Es in E1 at phi = 0, row by row */
} remus6_mount;

/* Second table, which the function mounts needs. Made by prepare_mounts. */
typedef struct remus6_mount_table {
    remus6_mount flywheel[REMUS6_N];
} remus6_mount_table;

/* Motion at an instrument or a point. */
typedef struct remus6_points_result {
    remus6_real position[3];              /* m; in E0 */
    remus6_real C[3][3];                  /* own axes to E0 */
    remus6_real twist[6];                 /* m/s, rad/s; relative to E0, in own axes; the last three are
                                           * the gyro's reading */
    remus6_real specific_force[3];        /* m/s2; acceleration minus gravity, in own axes: the
                                           * accelerometer's reading */
    remus6_real angular_acceleration[3];  /* rad/s2; in own axes */
} remus6_points_result;

/* An encoder whose counter wraps. Updated by accumulate. */
typedef struct remus6_encoder {
    int counter;  /* last reading */
    int place;    /* counts within the turn, 0 to |per_turn| - 1 */
    int moved;    /* counts between the last two readings */
} remus6_encoder;

/* Options of inverse: how it distributes a demand, and what it does near a singularity. */
typedef struct remus6_inverse_options {
    remus6_real weight[REMUS6_N];               /* weight of each flywheel in the norm of phi'': 1e-6 to
                                                 * 1e6, 1 by default */
    remus6_real limit[REMUS6_N];                /* rad/s2; largest magnitude of each phi''; greater than 0;
                                                 * infinity: no limit */
    remus6_real most[REMUS6_N];                 /* rad/s2; EXCESSIVE above this |phi''|; greater than 0 */
    remus6_real motor_torque[REMUS6_N];         /* N m; EXCESSIVE if the drive torque is larger; not
                                                 * negative; infinity: no limit */
    remus6_real motor_speed[REMUS6_N];          /* rad/s; no-load speed, where the torque that drives has
                                                 * fallen to 0; greater than 0; infinity: none */
    remus6_real motor_viscous[REMUS6_N];        /* N m s; viscous friction, which the motor bears; 0: none */
    remus6_real motor_coulomb[REMUS6_N];        /* N m; dry friction, which the motor bears; 0: none */
    remus6_real motor_coulomb_speed[REMUS6_N];  /* rad/s; speed at which three quarters of the dry friction
                                                 * act; greater than 0 */
    remus6_real near_singular;                  /* status NEAR_SINGULAR below this fraction of the largest
                                                 * singular value, 0..1 */
    remus6_real damping;                        /* damping of small singular values, as a fraction of the
                                                 * largest, 0..1; 0: none */
} remus6_inverse_options;

/* Result of inverse and its quality. */
typedef struct remus6_inverse_result {
    remus6_real phi_ddot[REMUS6_N];  /* rad/s2; flywheel accelerations */
    remus6_real residual[6];         /* N, N m; F - K V* - M V - J phi' - I phi'' */
    remus6_real sigma[6];            /* singular values of K^-1/2 I Theta_ff^-1/2, descending */
    int rank;                        /* number of singular values above the rank threshold */
    remus6_real damped_by;           /* largest damping lambda applied, in units of sigma; 0: none */
    int limited[REMUS6_N];           /* 1 if the flywheel reached its limit */
    remus6_real hardest[6];          /* the unreachable wrench, or the one hardest to reach; a unit vector
                                      * in the norm of K^-1 */
} remus6_inverse_result;

/* Derivatives of coupled. */
typedef struct remus6_coupled_jacobian_result {
    remus6_real V_dot_V[6][6];                         /* of V* by V: row i, column j */
    remus6_real V_dot_phi[6][REMUS6_N];                /* of V* by the phases */
    remus6_real V_dot_phi_dot[6][REMUS6_N];            /* by the speeds */
    remus6_real V_dot_tau[6][REMUS6_N];                /* by the drive torques */
    remus6_real phi_ddot_V[REMUS6_N][6];               /* of phi'' by V: row s, column j */
    remus6_real phi_ddot_phi[REMUS6_N][REMUS6_N];      /* of phi'' by the phases */
    remus6_real phi_ddot_phi_dot[REMUS6_N][REMUS6_N];  /* by the speeds */
    remus6_real phi_ddot_tau[REMUS6_N][REMUS6_N];      /* by the drive torques */
} remus6_coupled_jacobian_result;

/* Derivatives of forward. */
typedef struct remus6_forward_jacobian_result {
    remus6_real V_dot_V[6][6];                /* of V* by V: row i, column j */
    remus6_real V_dot_phi[6][REMUS6_N];       /* of V* by the phases */
    remus6_real V_dot_phi_dot[6][REMUS6_N];   /* by the speeds */
    remus6_real V_dot_phi_ddot[6][REMUS6_N];  /* by the accelerations */
} remus6_forward_jacobian_result;

extern const remus6_parameters remus6_default_parameters;         /* of the stand file */
extern const remus6_table remus6_default;                         /* made of them */
extern const remus6_inverse_options remus6_default_options;       /* of inverse, by the stand file */

/* ---- functions ---- */

/* forward: acceleration of the carrier for given accelerations of the flywheels: K V* = F - M V - sum(I
 * phi'' + J phi'), (8).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   V_dot[6]     out: m/s2, rad/s2; derivative of the components of V; may overlap any input
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 2115 operations on reals, 4 of them divisions. Stack: at most 2128 bytes. */
remus6_status remus6_forward(const remus6_table *table, const remus6_state *x,
                             const remus6_real phi_ddot[REMUS6_N], remus6_real V_dot[6]);

/* matrices: the matrices of K V* + M V + I phi'' + J phi' = F at a state, (2), (6)-(9).
 *   table  the prepared table
 *   x      state; its attitude within 1e-3 of unit length
 *   out    out: K, K_dot, M, I, J, F
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 2120 operations on reals, 1 of them a division. Stack: at most 1840 bytes. */
remus6_status remus6_matrices(const remus6_table *table, const remus6_state *x, remus6_matrices_result *out);

/* momentum: momentum screw, kinetic energy, mass centre of the whole system and its velocity, (1), (2).
 *   table  the prepared table
 *   x      state; its attitude within 1e-3 of unit length
 *   out    out: Z, Z0, energy, mass centre and its velocity
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 2051 operations on reals, 1 of them a division. Stack: at most 1744 bytes. */
remus6_status remus6_momentum(const remus6_table *table, const remus6_state *x, remus6_momentum_result *out);

/* torque: drive torques for a given motion: tau = f^T (Theta V_s* + Phi(V_s) Z_s - P_s).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   V_dot[6]     m/s2, rad/s2; derivative of the components of V
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   tau[6]       out: N m; drive torques, mount on flywheel, about the spin axis
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 1229 operations on reals, 1 of them a division. Stack: at most 1600 bytes. */
remus6_status remus6_torque(const remus6_table *table, const remus6_state *x, const remus6_real V_dot[6],
                            const remus6_real phi_ddot[REMUS6_N], remus6_real tau[REMUS6_N]);

/* coupled: motion of the whole system under given drive torques: V* and phi'' together, flywheels
 * eliminated first.
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   tau[6]       N m; drive torques, mount on flywheel
 *   locked[6]    not 0: a lock holds phi'' = 0, whatever its tau; null: no lock
 *   V_dot[6]     out: m/s2, rad/s2; derivative of the components of V
 *   phi_ddot[6]  out: rad/s2; flywheel accelerations
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 3070 operations on reals, 5 of them divisions. Stack: at most 3088 bytes. */
remus6_status remus6_coupled(const remus6_table *table, const remus6_state *x,
                             const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                             remus6_real V_dot[6], remus6_real phi_ddot[REMUS6_N]);

/* step: state after one time step; drive torques and wrenches are held constant.
 *   table      the prepared table
 *   x          state; its attitude within 1e-3 of unit length
 *   tau[6]     N m; drive torques, mount on flywheel
 *   locked[6]  not 0: a lock holds phi'' = 0, whatever its tau; null: no lock
 *   dt         s; time step, greater than 0
 *   order      4: Runge-Kutta, four evaluations; 2: midpoint rule, two
 *   next       out: state after the step; may be x itself
 * RANGE also if a stage of the step or the new state is out of range.
 * COARSE: dt times the fastest of |phi_dot| and |omega| is above MAX_TURN_4 rad (order 2: MAX_TURN_2). At
 * this bound the vibration of an unbalance is wrong by 3e-4 of its size after a turn, one of twice the
 * speed (asymmetry) by 4e-3 (order 2: 1e-3). Errors grow with dt^4 (dt^2), beyond twice the bound faster.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, COARSE. Nothing is written when the
 * status is negative.
 * At most 12857 operations on reals, 26 of them divisions. Stack: at most 4288 bytes. */
remus6_status remus6_step(const remus6_table *table, const remus6_state *x, const remus6_real tau[REMUS6_N],
                          const int locked[REMUS6_N], remus6_real dt, int order, remus6_state *next);

/* step_driven: state after one time step; given flywheel accelerations and wrenches are held constant.
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   dt           s; time step, greater than 0
 *   order        4: Runge-Kutta, four evaluations; 2: midpoint rule, two
 *   next         out: state after the step; may be x itself
 * RANGE also if a stage of the step or the new state is out of range.
 * COARSE: dt times the fastest of |phi_dot| and |omega| is above MAX_TURN_4 rad (order 2: MAX_TURN_2). At
 * this bound the vibration of an unbalance is wrong by 3e-4 of its size after a turn, one of twice the
 * speed (asymmetry) by 4e-3 (order 2: 1e-3). Errors grow with dt^4 (dt^2), beyond twice the bound faster.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, COARSE. Nothing is written when the
 * status is negative.
 * At most 9037 operations on reals, 22 of them divisions. Stack: at most 3408 bytes. */
remus6_status remus6_step_driven(const remus6_table *table, const remus6_state *x,
                                 const remus6_real phi_ddot[REMUS6_N], remus6_real dt, int order,
                                 remus6_state *next);

/* wrap: the angle wrapped to [-pi, pi] (pi rounded to the nearest real).
 *   phi      rad; any angle within MAX_PHASE
 *   wrapped  out: rad; the same angle in [-pi, pi]
 * Error below 5e-16 rad, modulo one turn.
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 29 operations on reals, no division. Stack: at most 544 bytes. */
remus6_status remus6_wrap(remus6_real phi, remus6_real *wrapped);

/* phase_of_counts: phase for a count of an encoder.
 *   count     any count of the encoder; or `place` of accumulate
 *   per_turn  counts per turn, at most 1073741824 in magnitude; negative if phi falls as counts rise
 *   zero      count at phi = 0, at most one turn in magnitude
 *   phi       out: rad; phase, in [-pi, pi] (pi rounded to the nearest real)
 * Error at most 2 units in the last place for a whole `zero` and every count: the phase does not drift.
 * Also returns RANGE if |zero| is more than one turn.
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 20 operations on reals, 1 of them a division. Stack: at most 448 bytes. */
remus6_status remus6_phase_of_counts(int count, int per_turn, remus6_real zero, remus6_real *phi);

/* speed_of_counts: mean speed of a flywheel from the counts of one interval.
 *   moved     counts during dt: `moved` of accumulate
 *   per_turn  counts per turn, at most 1073741824 in magnitude; negative if phi falls as counts rise
 *   dt        s; greater than 0
 *   phi_dot   out: rad/s; mean speed during dt
 * Also returns RANGE if the speed is beyond MAX_SPEED. Resolution: one count is 2 pi/(per_turn dt).
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 10 operations on reals, 2 of them divisions. Stack: at most 336 bytes. */
remus6_status remus6_speed_of_counts(int moved, int per_turn, remus6_real dt, remus6_real *phi_dot);

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
remus6_status remus6_accumulate(remus6_encoder *encoder, int counter, int bits, int per_turn);

/* forward_jacobian: derivatives of forward by V, phi, phi' and phi'', at fixed position and attitude, (8).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   out          out: derivatives of V*
 * At a kink of a damping law with magnitudes, the derivative from one side is returned.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 8637 operations on reals, 28 of them divisions. Stack: at most 4992 bytes. */
remus6_status remus6_forward_jacobian(const remus6_table *table, const remus6_state *x,
                                      const remus6_real phi_ddot[REMUS6_N],
                                      remus6_forward_jacobian_result *out);

/* coupled_jacobian: derivatives of coupled by V, phi, phi' and tau, at fixed position and attitude.
 *   table      the prepared table
 *   x          state; its attitude within 1e-3 of unit length
 *   tau[6]     N m; drive torques, mount on flywheel
 *   locked[6]  not 0: a lock holds phi'' = 0, whatever its tau; null: no lock
 *   out        out: derivatives of V* and phi''
 * At a kink of a damping law with magnitudes, the derivative from one side is returned.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 13264 operations on reals, 29 of them divisions. Stack: at most 6768 bytes. */
remus6_status remus6_coupled_jacobian(const remus6_table *table, const remus6_state *x,
                                      const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                                      remus6_coupled_jacobian_result *out);

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
 * At most 81569 operations on reals, 2909 of them divisions. Stack: at most 5200 bytes. */
remus6_status remus6_inverse(const remus6_table *table, const remus6_state *x, const remus6_real V_dot[6],
                             const remus6_inverse_options *options, remus6_inverse_result *out);

/* inverse_fast: flywheel accelerations for a wanted motion of the carrier, without diagnostics: normal
 * equations, (12).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   V_dot[6]     m/s2, rad/s2; wanted derivative of the components of V
 *   options      weights and damping; `near_singular` and `limit` are ignored
 *   phi_ddot[6]  out: rad/s2; flywheel accelerations
 * Squares the condition number: as accurate as inverse if singular values differ by a factor of at most
 * some thousand; returns NOT_POSITIVE_DEFINITE if they differ by more and damping is 0.
 * Damping is relative to the norm of W.
 * EXCESSIVE counts Theta_ff phi'' and the friction of the motor. The torque that the carrier's motion adds
 * is left out: `torque` and `inverse` have it. What the options say of motors is not checked; it decides
 * this bit alone.
 * RANGE also where the answer is no finite number.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, EXCESSIVE. Nothing is written when
 * the status is negative.
 * At most 3492 operations on reals, 73 of them divisions. Stack: at most 4656 bytes. */
remus6_status remus6_inverse_fast(const remus6_table *table, const remus6_state *x,
                                  const remus6_real V_dot[6], const remus6_inverse_options *options,
                                  remus6_real phi_ddot[REMUS6_N]);

/* points: readings of an accelerometer and a gyro at each instrument and point.
 *   table     the prepared table
 *   x         state; its attitude within 1e-3 of unit length
 *   V_dot[6]  m/s2, rad/s2; derivative of the components of V
 *   out[2]    out: one reading for each instrument, then for each point
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 602 operations on reals, 1 of them a division. Stack: at most 1136 bytes. */
remus6_status remus6_points(const remus6_table *table, const remus6_state *x, const remus6_real V_dot[6],
                            remus6_points_result out[REMUS6_SENSORS]);

/* quaternion: attitude quaternion of three angles.
 *   angles[3]    rad; psi, theta, phi of C = C3(psi) C2(theta) C1(phi) (ship)
 *   attitude[4]  out: unit quaternion, w first
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 183 operations on reals, no division. Stack: at most 1008 bytes. */
remus6_status remus6_quaternion(const remus6_real angles[3], remus6_real attitude[4]);

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
remus6_status remus6_state_from_coordinates(const remus6_real position[3], const remus6_real angles[3],
                                            const remus6_real q_dot[6], const remus6_real q_ddot[6],
                                            remus6_state *x, remus6_real V_dot[6]);

/* generalized: the equations in generalized coordinates: A, D, I0, J0, q', and q'' for given phi'', (10),
 * (11).
 *   table        the prepared table
 *   x            state; its attitude is ignored, `angles` replaces it
 *   angles[3]    rad; psi, theta, phi of C = C3(psi) C2(theta) C1(phi) (ship)
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   out          out: A, D, I0, J0, q_dot, q_ddot
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, SINGULAR_ATTITUDE, BAD_ARGUMENT. Nothing is
 * written when the status is negative.
 * At most 6251 operations on reals, 7 of them divisions. Stack: at most 4640 bytes. */
remus6_status remus6_generalized(const remus6_table *table, const remus6_state *x,
                                 const remus6_real angles[3], const remus6_real phi_ddot[REMUS6_N],
                                 remus6_generalized_result *out);

/* prepare: makes the table of a stand from masses, centres of mass, inertias and mountings, (2).
 *   parameters  masses, inertias, mountings
 *   table       in and out: start with a copy of the default; its laws (gravity, damping, ...) are kept
 * The generator makes the default table by the same operations: the default parameters give its bits.
 * Also returns RANGE if a mass is negative or an axis has no direction.
 * NOT_POSITIVE_DEFINITE: no such body exists. Moments of inertia about the centre of mass are negative or
 * break the triangle inequality, added mass that is not symmetric and positive semidefinite (to 1e-09 of
 * the largest element); a flywheel without spin inertia; no mass at all.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 12885 operations on reals, 116 of them divisions. Stack: at most 2448 bytes. */
remus6_status remus6_prepare(const remus6_parameters *parameters, remus6_table *table);

/* mounts: wrench of the mount on each flywheel: the bearing loads. Their opposites shake the structure.
 *   table             the prepared table
 *   mounting          made once by prepare_mounts
 *   x                 state; its attitude within 1e-3 of unit length
 *   V_dot[6]          m/s2, rad/s2; derivative of the components of V
 *   phi_ddot[6]       rad/s2; flywheel accelerations
 *   mount_wrench[36]  out: N, N m; of the mount on each flywheel, six numbers each, about Os in the axes
 *                     of Es at phi = 0; the fourth is tau
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 2384 operations on reals, 1 of them a division. Stack: at most 1968 bytes. */
remus6_status remus6_mounts(const remus6_table *table, const remus6_mount_table *mounting,
                            const remus6_state *x, const remus6_real V_dot[6],
                            const remus6_real phi_ddot[REMUS6_N], remus6_real mount_wrench[36]);

/* prepare_mounts: makes the second table, which the function mounts needs.
 *   parameters  masses, inertias, mountings
 *   mounting    out: table for the function mounts
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 6395 operations on reals, 94 of them divisions. Stack: at most 1920 bytes. */
remus6_status remus6_prepare_mounts(const remus6_parameters *parameters, remus6_mount_table *mounting);

/* step_carried: state after one time step under drive torques and wrenches, held constant; sums are
 * compensated by a carry.
 *   table      the prepared table
 *   x          state; its attitude within 1e-3 of unit length
 *   tau[6]     N m; drive torques, mount on flywheel
 *   locked[6]  not 0: a lock holds phi'' = 0, whatever its tau; null: no lock
 *   dt         s; time step, greater than 0
 *   order      4: Runge-Kutta, four evaluations; 2: midpoint rule, two
 *   carry      in and out: of the step before; at first all zero
 *   next       out: state after the step; may be x itself
 * Statuses as of step. A carry belongs to its state: where another state is set, set the carry to zero.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, COARSE. Nothing is written when the
 * status is negative.
 * At most 13179 operations on reals, 26 of them divisions. Stack: at most 4560 bytes. */
remus6_status remus6_step_carried(const remus6_table *table, const remus6_state *x,
                                  const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                                  remus6_real dt, int order, remus6_step_carry *carry, remus6_state *next);

/* step_driven_carried: state after one time step under given flywheel accelerations and wrenches, held
 * constant; sums are compensated by a carry.
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   dt           s; time step, greater than 0
 *   order        4: Runge-Kutta, four evaluations; 2: midpoint rule, two
 *   carry        in and out: of the step before; at first all zero
 *   next         out: state after the step; may be x itself
 * Statuses as of step_driven. A carry belongs to its state: where another state is set, set the carry to
 * zero.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, COARSE. Nothing is written when the
 * status is negative.
 * At most 9359 operations on reals, 22 of them divisions. Stack: at most 3664 bytes. */
remus6_status remus6_step_driven_carried(const remus6_table *table, const remus6_state *x,
                                         const remus6_real phi_ddot[REMUS6_N], remus6_real dt, int order,
                                         remus6_step_carry *carry, remus6_state *next);

#ifdef __cplusplus
}
#endif

#endif
