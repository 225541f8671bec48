/* auv6.h: motion of the stand "auv6": carrier, 1 instrument, 6 flywheels.
 * mahovik 0.1.0; structure 192ea446, physics 002b2abc. Generated: change the stand file instead.
 *
 * C99, no libm, no allocation, stack only, constant globals: any core may call any function at any time.
 * Compile with -ffp-contract=off (no fused multiply-add): then every processor with IEEE 754 arithmetic gives
 * the same bits.
 * Also needed: for 32-bit x86 -msse2 -mfpmath=sse; with gcc 12 for x86-64 with FMA
 * and for a Cortex-M55 -fno-tree-vectorize. gcc may call memcpy, memmove and memset.
 * Never with -ffast-math, -Ofast, -funsafe-math-optimizations or parts of them: wrong results with status OK.
 * The source refuses what the compiler shows of them; clang does not show all.
 * AUV6_SQRT, defined for the source, takes the square root of a processor in the place of its own:
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
#ifndef AUV6_H
#define AUV6_H

/* The linker sees names that end in the kind of the reals and a hash of this header: a caller with the
 * header of another stand, element type, choice of functions or version does not link. Define
 * AUV6_PLAIN_NAMES for all files, and it sees the names as they are, as dlsym, --wrap and other languages
 * need them. */
#ifndef AUV6_PLAIN_NAMES
#define auv6_default_parameters     auv6_default_parameters_f64_2f78b58b
#define auv6_default                auv6_default_f64_2f78b58b
#define auv6_default_options        auv6_default_options_f64_2f78b58b
#define auv6_forward                auv6_forward_f64_2f78b58b
#define auv6_matrices               auv6_matrices_f64_2f78b58b
#define auv6_momentum               auv6_momentum_f64_2f78b58b
#define auv6_torque                 auv6_torque_f64_2f78b58b
#define auv6_coupled                auv6_coupled_f64_2f78b58b
#define auv6_step                   auv6_step_f64_2f78b58b
#define auv6_step_driven            auv6_step_driven_f64_2f78b58b
#define auv6_wrap                   auv6_wrap_f64_2f78b58b
#define auv6_phase_of_counts        auv6_phase_of_counts_f64_2f78b58b
#define auv6_speed_of_counts        auv6_speed_of_counts_f64_2f78b58b
#define auv6_accumulate             auv6_accumulate_f64_2f78b58b
#define auv6_forward_jacobian       auv6_forward_jacobian_f64_2f78b58b
#define auv6_coupled_jacobian       auv6_coupled_jacobian_f64_2f78b58b
#define auv6_inverse                auv6_inverse_f64_2f78b58b
#define auv6_inverse_fast           auv6_inverse_fast_f64_2f78b58b
#define auv6_points                 auv6_points_f64_2f78b58b
#define auv6_quaternion             auv6_quaternion_f64_2f78b58b
#define auv6_state_from_coordinates auv6_state_from_coordinates_f64_2f78b58b
#define auv6_generalized            auv6_generalized_f64_2f78b58b
#define auv6_prepare                auv6_prepare_f64_2f78b58b
#define auv6_mounts                 auv6_mounts_f64_2f78b58b
#define auv6_prepare_mounts         auv6_prepare_mounts_f64_2f78b58b
#define auv6_step_carried           auv6_step_carried_f64_2f78b58b
#define auv6_step_driven_carried    auv6_step_driven_carried_f64_2f78b58b
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define AUV6_STRUCTURE 0x192ea446u  /* hash of the stand's names, counts and kinds of wrench */
#define AUV6_PHYSICS   0x002b2abcu  /* hash of its structure and all numbers */
#define AUV6_TABLE_HASH 0xc7c2c8e4u /* FNV-1a of all numbers of the default table but its stream */
#define AUV6_REAL_BYTES 8           /* bytes of a auv6_real */
#define AUV6_VERSION_MAJOR 0        /* of the mahovik that wrote this */
#define AUV6_VERSION_MINOR 1
#define AUV6_VERSION_PATCH 0

typedef double auv6_real;

/* ---- ranges of inputs: magnitudes ---- */

#define AUV6_MAX_POSITION        1.0e6     /* m; each component of the position of O1 */
#define AUV6_MAX_VELOCITY        1.0e4     /* m/s; each component of v */
#define AUV6_MAX_SPEED           1.0e5     /* rad/s; each component of omega, each phi_dot */
#define AUV6_MAX_PHASE           1.0e7     /* rad; each phase and attitude angle */
#define AUV6_MAX_ACCELERATION    1.0e9     /* rad/s2; each phi_ddot */
#define AUV6_MAX_WRENCH          1.0e9     /* N, N m; each component of a run-time wrench */
#define AUV6_MAX_STEP            10.0      /* s; a time step */
#define AUV6_MAX_PARAMETER       1.0e15    /* SI; each mass, length and moment of inertia */
#define AUV6_MAX_WEIGHT          1.0e6     /* the weight of a flywheel in inverse; at least its inverse */
#define AUV6_MAX_ROUNDING        1.0       /* SI; each number of a carry */
#define AUV6_MAX_TURN_4          1.0       /* rad; turn in a step of order 4; beyond: COARSE */
#define AUV6_MAX_TURN_2          0.1       /* rad; turn in a step of order 2; beyond: COARSE */
#define AUV6_LARGEST             1.7976931348623157e308  /* largest finite number */

/* ---- status of every function: negative: refused, outputs untouched; positive: bits, outputs valid ---- */

typedef int auv6_status;  /* not the enum, whose size compilers choose */

enum {
    AUV6_OK = 0,                          /* success */
    AUV6_NEAR_SINGULAR = 1,               /* least singular value below `near_singular` times the largest */
    AUV6_DAMPED = 2,                      /* damping was applied */
    AUV6_LIMITED = 4,                     /* a limit was reached; `limited` says by which flywheels */
    AUV6_UNREACHABLE = 8,                 /* wanted motion not reached: residual above 1e-9 of the demand */
    AUV6_RANK_DEFICIENT = 16,             /* fewer than min(6, N) singular values above 1e-9 of the largest */
    AUV6_COARSE = 32,                     /* step too long: more than MAX_TURN_4 or MAX_TURN_2 turned in it */
    AUV6_EXCESSIVE = 64,                  /* more than a motor's torque or speed, or than `most` */
    AUV6_NOT_FINITE = -1,                 /* an input is NaN or infinite */
    AUV6_RANGE = -2,                      /* out of range, quaternion off unit length */
    AUV6_NOT_POSITIVE_DEFINITE = -3,      /* no mass, no spin inertia, or a pivot failed */
    AUV6_SINGULAR_ATTITUDE = -4,          /* attitude angles within 1e-6 of their singularity */
    AUV6_BAD_ARGUMENT = -5                /* a null pointer, a count, an index, a step or an option */
};

/* ---- numbers of bodies ---- */

/* flywheels, in the order of the stand file */
enum { AUV6_W1, AUV6_W2, AUV6_W3, AUV6_W4, AUV6_W5, AUV6_W6, AUV6_N = 6 };
/* instruments and points: those of the function points */
enum { AUV6_SENSOR_SONAR, AUV6_SENSORS = 1 };

/* ---- data ---- */

/* State of the whole system. */
typedef struct auv6_state {
    auv6_real position[3];      /* m; position of O1, in E0 */
    auv6_real attitude[4];      /* unit quaternion, w first: x0 = C x1 */
    auv6_real V[6];             /* m/s, rad/s; twist of the carrier relative to E0, in E1 */
    auv6_real phi[AUV6_N];      /* rad; phases */
    auv6_real phi_dot[AUV6_N];  /* rad/s; speeds relative to the mount */
} auv6_state;

/* What rounding took from a state: kept from step to step, all zero at first. */
typedef struct auv6_step_carry {
    auv6_real rounding[25];  /* SI; of each number of the state, in its order */
} auv6_step_carry;

/* Mass properties of one body, in its own frame. */
typedef struct auv6_body {
    auv6_real mass;                 /* kg */
    auv6_real center_of_mass[3];    /* m; rc, from the body's origin, in its own axes */
    auv6_real inertia[6];           /* kg m2; J11, J22, J33, J12, J13, J23 about the body's origin */
    auv6_real displaced_mass;       /* kg; mass of the displaced fluid */
    auv6_real displaced_center[3];  /* m; centre of buoyancy, in the body's frame */
} auv6_body;

/* An instrument fixed on the carrier. */
typedef struct auv6_instrument {
    auv6_body body;
    auv6_real position[3];  /* m; Op, in E1 */
    auv6_real axis[3];      /* first axis of Ep in E1, any length */
    auv6_real zero[3];      /* its component perpendicular to the first axis is the second axis of Ep */
} auv6_instrument;

/* Mass properties of a flywheel, in its own frame. */
typedef struct auv6_dry_body {
    auv6_real mass;               /* kg */
    auv6_real center_of_mass[3];  /* m; rc, from the body's origin, in its own axes */
    auv6_real inertia[6];         /* kg m2; J11, J22, J33, J12, J13, J23 about the body's origin */
} auv6_dry_body;

/* A flywheel and how it is mounted. */
typedef struct auv6_flywheel {
    auv6_dry_body body;
    auv6_real position[3];  /* m; Os, in the frame of the mount */
    auv6_real axis[3];      /* spin axis in the frame of the mount, any length */
    auv6_real zero[3];      /* its component perpendicular to the axis is the second axis of Es at phi = 0 */
    int mount;              /* index of the instrument it is mounted on; -1: the carrier */
} auv6_flywheel;

/* Masses, inertias and mountings, of which the table is made. */
typedef struct auv6_parameters {
    auv6_body carrier;
    auv6_real added_mass[6][6];      /* kg, kg m, kg m2; Lambda of all bodies, about O1 in E1 */
    auv6_instrument instrument[1];
    auv6_flywheel flywheel[AUV6_N];
} auv6_parameters;

/* Table of one flywheel: harmonics of its terms in (8), in E1 about O1. */
typedef struct auv6_row {
    auv6_real mu_c[3];        /* kg m; first moment about O1: cos phi */
    auv6_real mu_s[3];        /* kg m; sin phi */
    auv6_real J_c[6];         /* kg m2; inertia about O1, 11 22 33 12 13 23: cos phi */
    auv6_real J_s[6];         /* kg m2; sin phi */
    auv6_real J_2c[6];        /* kg m2; cos 2 phi */
    auv6_real J_2s[6];        /* kg m2; sin 2 phi */
    auv6_real t_0[3];         /* kg m2; moment part of I: constant */
    auv6_real t_c[3];         /* kg m2; cos phi */
    auv6_real t_s[3];         /* kg m2; sin phi */
    auv6_real spin;           /* kg m2; Theta_ff: inertia about the spin axis */
    auv6_real spin_inv;       /* 1/(kg m2) */
    auv6_real spin_root_inv;  /* 1/(kg m2)^0.5; 1/sqrt(spin): scales the unknowns of (12) */
} auv6_row;

/* Pose of an instrument or a point. */
typedef struct auv6_sensor {
    auv6_real origin[3];  /* m; in E1 */
    auv6_real axes[9];    /* own axes to E1, row by row */
} auv6_sensor;

/* Damping of one body, in its own frame. */
typedef struct auv6_damper {
    auv6_real linear[6][6];     /* SI; wrench -= linear V */
    auv6_real quadratic[6][6];  /* SI; wrench -= quadratic (V |V|) */
} auv6_damper;

/* The constants of the equations, made of the parameters; the laws at the end (gravity, ...) are as given. */
typedef struct auv6_table {
    auv6_real mass;                    /* kg; mass of all bodies */
    auv6_real mass_inverse;            /* 1/kg */
    auv6_real first_moment[3];         /* kg m; mu about O1, constant part */
    auv6_real inertia[6];              /* kg m2; J about O1, 11 22 33 12 13 23, constant part, with added
                                        * mass */
    auv6_real A[6];                    /* kg; m E + Lambda_11: 11 22 33 12 13 23 */
    auv6_real A_inv[6];                /* 1/kg */
    auv6_real G[9];                    /* kg m; Lambda_21, row by row */
    auv6_real weight_mass;             /* kg; mass minus displaced mass */
    auv6_real displaced_moment[3];     /* kg m; first moment of displaced fluid, constant part */
    auv6_row flywheel[AUV6_N];
    auv6_sensor sensor[AUV6_SENSORS];
    auv6_real gravity[3];              /* m/s2; in E0 */
    auv6_real stream[3];               /* m/s; velocity of the fluid, in E0 */
    auv6_damper damper;                /* of the carrier */
} auv6_table;

/* The matrices of (8). */
typedef struct auv6_matrices_result {
    auv6_real K[6][6];        /* kg, kg m, kg m2; mass matrix (2) */
    auv6_real K_dot[6][6];    /* per s; its rate (6) */
    auv6_real M[6][6];        /* per s; velocity matrix (9), at V relative to the stream */
    auv6_real I_[6][AUV6_N];  /* kg m, kg m2; flywheel coupling (9), one column per flywheel */
    auv6_real J[6][AUV6_N];   /* per s; its velocity part (9) */
    auv6_real F[6];           /* N, N m; total external wrench (7) */
} auv6_matrices_result;

/* Momentum, energy, mass centre and its velocity. */
typedef struct auv6_momentum_result {
    auv6_real Z[6];                        /* kg m/s, kg m2/s; momentum screw in E1 about O1 (2) */
    auv6_real Z0[6];                       /* kg m/s, kg m2/s; momentum screw in E0 about its origin (1) */
    auv6_real energy;                      /* J; kinetic energy */
    auv6_real center_of_mass[3];           /* m; mass centre of all bodies, in E1 */
    auv6_real center_of_mass_velocity[3];  /* m/s; of the mass centre relative to E0, in E0 */
} auv6_momentum_result;

/* The equations in generalized coordinates q = (O1 in E0; psi, theta, phi). */
typedef struct auv6_generalized_result {
    auv6_real A[6][6];    /* V = A q' (10) */
    auv6_real D[6][6];    /* 1/s; A' along the motion (10) */
    auv6_real I0[6][6];   /* K A (11) */
    auv6_real J0[6][6];   /* K D + M A (11) */
    auv6_real q_dot[6];   /* m/s, rad/s; O1 in E0, then psi, theta, phi */
    auv6_real q_ddot[6];  /* m/s2, rad/s2; solution of (11) for the given phi_ddot */
} auv6_generalized_result;

/* One flywheel and its mounting; used by mounts only. */
typedef struct auv6_mount {
    auv6_real mass;             /* kg */
    auv6_real first_moment[3];  /* kg m; m rc, in Es */
    auv6_real inertia[6];       /* kg m2; about Os in Es, 11 22 33 12 13 23 */
    auv6_real origin[3];        /* m; Os in E1 */
    auv6_real axes[9];          /* axes of Es in E1 at phi = 0, row by row */
} auv6_mount;

/* Second table, which the function mounts needs. Made by prepare_mounts. */
typedef struct auv6_mount_table {
    auv6_mount flywheel[AUV6_N];
} auv6_mount_table;

/* Motion at an instrument or a point. */
typedef struct auv6_points_result {
    auv6_real position[3];              /* m; in E0 */
    auv6_real C[3][3];                  /* own axes to E0 */
    auv6_real twist[6];                 /* m/s, rad/s; relative to E0, in own axes; the last three are the
                                         * gyro's reading */
    auv6_real specific_force[3];        /* m/s2; acceleration minus gravity, in own axes: the
                                         * accelerometer's reading */
    auv6_real angular_acceleration[3];  /* rad/s2; in own axes */
} auv6_points_result;

/* An encoder whose counter wraps. Updated by accumulate. */
typedef struct auv6_encoder {
    int counter;  /* last reading */
    int place;    /* counts within the turn, 0 to |per_turn| - 1 */
    int moved;    /* counts between the last two readings */
} auv6_encoder;

/* Options of inverse: how it distributes a demand, and what it does near a singularity. */
typedef struct auv6_inverse_options {
    auv6_real weight[AUV6_N];               /* weight of each flywheel in the norm of phi'': 1e-6 to 1e6, 1
                                             * by default */
    auv6_real limit[AUV6_N];                /* rad/s2; largest magnitude of each phi''; greater than 0;
                                             * infinity: no limit */
    auv6_real most[AUV6_N];                 /* rad/s2; EXCESSIVE above this |phi''|; greater than 0 */
    auv6_real motor_torque[AUV6_N];         /* N m; EXCESSIVE if the drive torque is larger; not negative;
                                             * infinity: no limit */
    auv6_real motor_speed[AUV6_N];          /* rad/s; no-load speed, where the torque that drives has
                                             * fallen to 0; greater than 0; infinity: none */
    auv6_real motor_viscous[AUV6_N];        /* N m s; viscous friction, which the motor bears; 0: none */
    auv6_real motor_coulomb[AUV6_N];        /* N m; dry friction, which the motor bears; 0: none */
    auv6_real motor_coulomb_speed[AUV6_N];  /* rad/s; speed at which three quarters of the dry friction
                                             * act; greater than 0 */
    auv6_real near_singular;                /* status NEAR_SINGULAR below this fraction of the largest
                                             * singular value, 0..1 */
    auv6_real damping;                      /* damping of small singular values, as a fraction of the
                                             * largest, 0..1; 0: none */
} auv6_inverse_options;

/* Result of inverse and its quality. */
typedef struct auv6_inverse_result {
    auv6_real phi_ddot[AUV6_N];  /* rad/s2; flywheel accelerations */
    auv6_real residual[6];       /* N, N m; F - K V* - M V - J phi' - I phi'' */
    auv6_real sigma[6];          /* singular values of K^-1/2 I Theta_ff^-1/2, descending */
    int rank;                    /* number of singular values above the rank threshold */
    auv6_real damped_by;         /* largest damping lambda applied, in units of sigma; 0: none */
    int limited[AUV6_N];         /* 1 if the flywheel reached its limit */
    auv6_real hardest[6];        /* the unreachable wrench, or the one hardest to reach; a unit vector in
                                  * the norm of K^-1 */
} auv6_inverse_result;

/* Derivatives of coupled. */
typedef struct auv6_coupled_jacobian_result {
    auv6_real V_dot_V[6][6];                     /* of V* by V: row i, column j */
    auv6_real V_dot_phi[6][AUV6_N];              /* of V* by the phases */
    auv6_real V_dot_phi_dot[6][AUV6_N];          /* by the speeds */
    auv6_real V_dot_tau[6][AUV6_N];              /* by the drive torques */
    auv6_real phi_ddot_V[AUV6_N][6];             /* of phi'' by V: row s, column j */
    auv6_real phi_ddot_phi[AUV6_N][AUV6_N];      /* of phi'' by the phases */
    auv6_real phi_ddot_phi_dot[AUV6_N][AUV6_N];  /* by the speeds */
    auv6_real phi_ddot_tau[AUV6_N][AUV6_N];      /* by the drive torques */
} auv6_coupled_jacobian_result;

/* Derivatives of forward. */
typedef struct auv6_forward_jacobian_result {
    auv6_real V_dot_V[6][6];              /* of V* by V: row i, column j */
    auv6_real V_dot_phi[6][AUV6_N];       /* of V* by the phases */
    auv6_real V_dot_phi_dot[6][AUV6_N];   /* by the speeds */
    auv6_real V_dot_phi_ddot[6][AUV6_N];  /* by the accelerations */
} auv6_forward_jacobian_result;

extern const auv6_parameters auv6_default_parameters;             /* of the stand file */
extern const auv6_table auv6_default;                             /* made of them */
extern const auv6_inverse_options auv6_default_options;           /* of inverse, by the stand file */

/* ---- functions ---- */

/* forward: acceleration of the carrier for given accelerations of the flywheels: K V* = F - M V - sum(I
 * phi'' + J phi'), (8).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   V_dot[6]     out: m/s2, rad/s2; derivative of the components of V; may overlap any input
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 2265 operations on reals, 4 of them divisions. Stack: at most 2128 bytes. */
auv6_status auv6_forward(const auv6_table *table, const auv6_state *x, const auv6_real phi_ddot[AUV6_N],
                         auv6_real V_dot[6]);

/* matrices: the matrices of K V* + M V + I phi'' + J phi' = F at a state, (2), (6)-(9).
 *   table  the prepared table
 *   x      state; its attitude within 1e-3 of unit length
 *   out    out: K, K_dot, M, I, J, F
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 2270 operations on reals, 1 of them a division. Stack: at most 1840 bytes. */
auv6_status auv6_matrices(const auv6_table *table, const auv6_state *x, auv6_matrices_result *out);

/* momentum: momentum screw, kinetic energy, mass centre of the whole system and its velocity, (1), (2).
 *   table  the prepared table
 *   x      state; its attitude within 1e-3 of unit length
 *   out    out: Z, Z0, energy, mass centre and its velocity
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 2051 operations on reals, 1 of them a division. Stack: at most 1744 bytes. */
auv6_status auv6_momentum(const auv6_table *table, const auv6_state *x, auv6_momentum_result *out);

/* torque: drive torques for a given motion: tau = f^T (Theta V_s* + Phi(V_s) Z_s - P_s).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   V_dot[6]     m/s2, rad/s2; derivative of the components of V
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   tau[6]       out: N m; drive torques, mount on flywheel, about the spin axis
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 1229 operations on reals, 1 of them a division. Stack: at most 1600 bytes. */
auv6_status auv6_torque(const auv6_table *table, const auv6_state *x, const auv6_real V_dot[6],
                        const auv6_real phi_ddot[AUV6_N], auv6_real tau[AUV6_N]);

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
 * At most 3220 operations on reals, 5 of them divisions. Stack: at most 3088 bytes. */
auv6_status auv6_coupled(const auv6_table *table, const auv6_state *x, const auv6_real tau[AUV6_N],
                         const int locked[AUV6_N], auv6_real V_dot[6], auv6_real phi_ddot[AUV6_N]);

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
 * At most 13457 operations on reals, 26 of them divisions. Stack: at most 4288 bytes. */
auv6_status auv6_step(const auv6_table *table, const auv6_state *x, const auv6_real tau[AUV6_N],
                      const int locked[AUV6_N], auv6_real dt, int order, auv6_state *next);

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
 * At most 9637 operations on reals, 22 of them divisions. Stack: at most 3408 bytes. */
auv6_status auv6_step_driven(const auv6_table *table, const auv6_state *x, const auv6_real phi_ddot[AUV6_N],
                             auv6_real dt, int order, auv6_state *next);

/* wrap: the angle wrapped to [-pi, pi] (pi rounded to the nearest real).
 *   phi      rad; any angle within MAX_PHASE
 *   wrapped  out: rad; the same angle in [-pi, pi]
 * Error below 5e-16 rad, modulo one turn.
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 29 operations on reals, no division. Stack: at most 544 bytes. */
auv6_status auv6_wrap(auv6_real phi, auv6_real *wrapped);

/* phase_of_counts: phase for a count of an encoder.
 *   count     any count of the encoder; or `place` of accumulate
 *   per_turn  counts per turn, at most 1073741824 in magnitude; negative if phi falls as counts rise
 *   zero      count at phi = 0, at most one turn in magnitude
 *   phi       out: rad; phase, in [-pi, pi] (pi rounded to the nearest real)
 * Error at most 2 units in the last place for a whole `zero` and every count: the phase does not drift.
 * Also returns RANGE if |zero| is more than one turn.
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 20 operations on reals, 1 of them a division. Stack: at most 448 bytes. */
auv6_status auv6_phase_of_counts(int count, int per_turn, auv6_real zero, auv6_real *phi);

/* speed_of_counts: mean speed of a flywheel from the counts of one interval.
 *   moved     counts during dt: `moved` of accumulate
 *   per_turn  counts per turn, at most 1073741824 in magnitude; negative if phi falls as counts rise
 *   dt        s; greater than 0
 *   phi_dot   out: rad/s; mean speed during dt
 * Also returns RANGE if the speed is beyond MAX_SPEED. Resolution: one count is 2 pi/(per_turn dt).
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 10 operations on reals, 2 of them divisions. Stack: at most 336 bytes. */
auv6_status auv6_speed_of_counts(int moved, int per_turn, auv6_real dt, auv6_real *phi_dot);

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
auv6_status auv6_accumulate(auv6_encoder *encoder, int counter, int bits, int per_turn);

/* forward_jacobian: derivatives of forward by V, phi, phi' and phi'', at fixed position and attitude, (8).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   out          out: derivatives of V*
 * At a kink of a damping law with magnitudes, the derivative from one side is returned.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 9939 operations on reals, 28 of them divisions. Stack: at most 5008 bytes. */
auv6_status auv6_forward_jacobian(const auv6_table *table, const auv6_state *x,
                                  const auv6_real phi_ddot[AUV6_N], auv6_forward_jacobian_result *out);

/* coupled_jacobian: derivatives of coupled by V, phi, phi' and tau, at fixed position and attitude.
 *   table      the prepared table
 *   x          state; its attitude within 1e-3 of unit length
 *   tau[6]     N m; drive torques, mount on flywheel
 *   locked[6]  not 0: a lock holds phi'' = 0, whatever its tau; null: no lock
 *   out        out: derivatives of V* and phi''
 * At a kink of a damping law with magnitudes, the derivative from one side is returned.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 14566 operations on reals, 29 of them divisions. Stack: at most 6784 bytes. */
auv6_status auv6_coupled_jacobian(const auv6_table *table, const auv6_state *x, const auv6_real tau[AUV6_N],
                                  const int locked[AUV6_N], auv6_coupled_jacobian_result *out);

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
 * At most 81719 operations on reals, 2909 of them divisions. Stack: at most 5200 bytes. */
auv6_status auv6_inverse(const auv6_table *table, const auv6_state *x, const auv6_real V_dot[6],
                         const auv6_inverse_options *options, auv6_inverse_result *out);

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
 * At most 3642 operations on reals, 73 of them divisions. Stack: at most 4656 bytes. */
auv6_status auv6_inverse_fast(const auv6_table *table, const auv6_state *x, const auv6_real V_dot[6],
                              const auv6_inverse_options *options, auv6_real phi_ddot[AUV6_N]);

/* points: readings of an accelerometer and a gyro at each instrument and point.
 *   table     the prepared table
 *   x         state; its attitude within 1e-3 of unit length
 *   V_dot[6]  m/s2, rad/s2; derivative of the components of V
 *   out[1]    out: one reading for each instrument, then for each point
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 440 operations on reals, 1 of them a division. Stack: at most 1136 bytes. */
auv6_status auv6_points(const auv6_table *table, const auv6_state *x, const auv6_real V_dot[6],
                        auv6_points_result out[AUV6_SENSORS]);

/* quaternion: attitude quaternion of three angles.
 *   angles[3]    rad; psi, theta, phi of C = C2(psi) C3(theta) C1(phi) (aircraft)
 *   attitude[4]  out: unit quaternion, w first
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 183 operations on reals, no division. Stack: at most 1008 bytes. */
auv6_status auv6_quaternion(const auv6_real angles[3], auv6_real attitude[4]);

/* state_from_coordinates: state and V* of a wanted motion in generalized coordinates: V = A q', V* = A q''
 * + D q', (10).
 *   position[3]  m; position of O1, in E0
 *   angles[3]    rad; psi, theta, phi of C = C2(psi) C3(theta) C1(phi) (aircraft)
 *   q_dot[6]     m/s, rad/s; rates of position and of the angles
 *   q_ddot[6]    m/s2, rad/s2; rates of q_dot
 *   x            in and out: its position, attitude and V are written; phases and speeds are kept
 *   V_dot[6]     out: m/s2, rad/s2; derivative of the components of V
 * Returns OK, NOT_FINITE, RANGE, SINGULAR_ATTITUDE, BAD_ARGUMENT. Nothing is written when the status is
 * negative.
 * At most 479 operations on reals, 1 of them a division. Stack: at most 1408 bytes. */
auv6_status auv6_state_from_coordinates(const auv6_real position[3], const auv6_real angles[3],
                                        const auv6_real q_dot[6], const auv6_real q_ddot[6], auv6_state *x,
                                        auv6_real V_dot[6]);

/* generalized: the equations in generalized coordinates: A, D, I0, J0, q', and q'' for given phi'', (10),
 * (11).
 *   table        the prepared table
 *   x            state; its attitude is ignored, `angles` replaces it
 *   angles[3]    rad; psi, theta, phi of C = C2(psi) C3(theta) C1(phi) (aircraft)
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   out          out: A, D, I0, J0, q_dot, q_ddot
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, SINGULAR_ATTITUDE, BAD_ARGUMENT. Nothing is
 * written when the status is negative.
 * At most 6551 operations on reals, 7 of them divisions. Stack: at most 4640 bytes. */
auv6_status auv6_generalized(const auv6_table *table, const auv6_state *x, const auv6_real angles[3],
                             const auv6_real phi_ddot[AUV6_N], auv6_generalized_result *out);

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
 * At most 12189 operations on reals, 108 of them divisions. Stack: at most 2416 bytes. */
auv6_status auv6_prepare(const auv6_parameters *parameters, auv6_table *table);

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
auv6_status auv6_mounts(const auv6_table *table, const auv6_mount_table *mounting, const auv6_state *x,
                        const auv6_real V_dot[6], const auv6_real phi_ddot[AUV6_N],
                        auv6_real mount_wrench[36]);

/* prepare_mounts: makes the second table, which the function mounts needs.
 *   parameters  masses, inertias, mountings
 *   mounting    out: table for the function mounts
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 6047 operations on reals, 90 of them divisions. Stack: at most 1904 bytes. */
auv6_status auv6_prepare_mounts(const auv6_parameters *parameters, auv6_mount_table *mounting);

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
 * At most 13779 operations on reals, 26 of them divisions. Stack: at most 4560 bytes. */
auv6_status auv6_step_carried(const auv6_table *table, const auv6_state *x, const auv6_real tau[AUV6_N],
                              const int locked[AUV6_N], auv6_real dt, int order, auv6_step_carry *carry,
                              auv6_state *next);

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
 * At most 9959 operations on reals, 22 of them divisions. Stack: at most 3664 bytes. */
auv6_status auv6_step_driven_carried(const auv6_table *table, const auv6_state *x,
                                     const auv6_real phi_ddot[AUV6_N], auv6_real dt, int order,
                                     auv6_step_carry *carry, auv6_state *next);

#ifdef __cplusplus
}
#endif

#endif
