/* remus6.h: motion of the stand "remus6": carrier, 1 instrument, 6 flywheels.
 * mahovik 0.1.0; structure 3687deee, physics 5f25aea2. Generated: change the stand file instead.
 *
 * C99, no libm, no allocation, no globals but const: any core may call any function at any time. Stack only.
 * Compile with -ffp-contract=off (no fused multiply-add) and without -ffast-math: then every processor gives
 * the same bits (32-bit x86 needs -msse2 -mfpmath=sse as well, gcc 12 for x86-64 with FMA and Cortex-M55
 * -fno-tree-vectorize). gcc may call memcpy, memmove and memset.
 * Inputs are checked. The table is trusted, but for its stream: what prepare made, or a copy of the default.
 * A result must not overlap an input, unless its function says that it may.
 *
 * SI units. E0 is inertial, E1 the carrier with origin O1, Es a flywheel. Six numbers are the linear part,
 * then the angular part, in axes of E1 about O1 unless said otherwise. Equation numbers: README.md
 * of the delivered folder. */
#ifndef REMUS6_H
#define REMUS6_H

#ifdef __cplusplus
extern "C" {
#endif

#define REMUS6_STRUCTURE 0x3687deeeu  /* of the stand: names, counts, kinds of wrench */
#define REMUS6_PHYSICS   0x5f25aea2u  /* of the stand: structure and all numbers */
#define REMUS6_LANES     1            /* flywheels side by side in the table; 1: one after the other */

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
#define REMUS6_MAX_WEIGHT        1.0e6     /* the weight of a flywheel in inverse */
#define REMUS6_LARGEST           1.7976931348623157e308  /* largest finite number */

/* ---- status of every function: negative: refused, outputs untouched; positive: bits, outputs valid ---- */

typedef enum remus6_status {
    REMUS6_OK = 0,                        /* good */
    REMUS6_NEAR_SINGULAR = 1,             /* least singular value below `near` of the largest */
    REMUS6_DAMPED = 2,                    /* damping was applied */
    REMUS6_LIMITED = 4,                   /* a limit was reached; the mask says whose */
    REMUS6_UNREACHABLE = 8,               /* least squares: residual above 1e-9 of the demand */
    REMUS6_RANK_DEFICIENT = 16,           /* fewer than min(6, N) singular values above 1e-9 of the largest */
    REMUS6_NOT_FINITE = -1,               /* an input is NaN or infinite */
    REMUS6_RANGE = -2,                    /* out of range, quaternion off unit length */
    REMUS6_NOT_POSITIVE_DEFINITE = -3,    /* no mass, no spin inertia, or a pivot failed */
    REMUS6_SINGULAR_ATTITUDE = -4,        /* attitude angles within 1e-6 of their singularity */
    REMUS6_BAD_ARGUMENT = -5              /* a null pointer, a count, an index, a step or an option */
} remus6_status;

/* ---- numbers of bodies ---- */

/* flywheels, in the order of the stand file */
enum { REMUS6_W1, REMUS6_W2, REMUS6_W3, REMUS6_W4, REMUS6_W5, REMUS6_W6, REMUS6_N = 6 };
/* instruments and points, which measure reads */
enum { REMUS6_SENSOR_NOSE, REMUS6_SENSOR_IMU, REMUS6_SENSORS = 2 };

/* ---- data ---- */

/* State of the whole system. */
typedef struct remus6_state {
    remus6_real position[3];        /* m; of O1, in E0 */
    remus6_real attitude[4];        /* unit quaternion, w first: x0 = C x1 */
    remus6_real V[6];               /* m/s, rad/s; twist of the carrier relative to E0, in E1 */
    remus6_real phi[REMUS6_N];      /* rad; phases */
    remus6_real phi_dot[REMUS6_N];  /* rad/s; speeds relative to the mount */
} remus6_state;

/* Mass properties of one body, in its own frame. */
typedef struct remus6_body {
    remus6_real mass;                 /* kg */
    remus6_real center_of_mass[3];    /* m; rc, from the body's origin, in its own axes */
    remus6_real inertia[6];           /* kg m2; J11, J22, J33, J12, J13, J23 about the body's origin */
    remus6_real displaced_mass;       /* kg; of fluid */
    remus6_real displaced_center[3];  /* m; centre of buoyancy, in the body's frame */
} remus6_body;

/* An instrument fixed on the carrier. */
typedef struct remus6_instrument {
    remus6_body body;
    remus6_real position[3];  /* m; Op, in E1 */
    remus6_real axis[3];      /* first axis of Ep in E1, any length */
    remus6_real zero[3];      /* its part across the first axis is the second axis of Ep */
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
    remus6_real zero[3];      /* its part across the axis is the second axis of Es at phi = 0 */
    int mount;                /* number of the instrument that bears it; -1: the carrier */
} remus6_flywheel;

/* A sensor or a place of interest. */
typedef struct remus6_point {
    remus6_real position[3];  /* m; in the frame of the mount */
    remus6_real axis[3];      /* first axis in the frame of the mount, any length */
    remus6_real zero[3];      /* its part across the first axis is the second axis */
    int mount;                /* number of the instrument that bears it; -1: the carrier */
} remus6_point;

/* Input of prepare: masses, inertias and mountings. */
typedef struct remus6_parameters {
    remus6_body carrier;
    remus6_real added_mass[6][6];        /* kg, kg m, kg m2; Lambda of all bodies, about O1 in E1 */
    remus6_instrument instrument[1];
    remus6_flywheel flywheel[REMUS6_N];
    remus6_point point[1];
} remus6_parameters;

/* Table of one flywheel: harmonics of what it adds to (8), in E1 about O1. */
typedef struct remus6_row {
    remus6_real mu_c[3];   /* kg m; first moment about O1: cos phi */
    remus6_real mu_s[3];   /* kg m; sin phi */
    remus6_real J_c[6];    /* kg m2; inertia about O1, 11 22 33 12 13 23: cos phi */
    remus6_real J_s[6];    /* kg m2; sin phi */
    remus6_real J_2c[6];   /* kg m2; cos 2 phi */
    remus6_real J_2s[6];   /* kg m2; sin 2 phi */
    remus6_real t_0[3];    /* kg m2; moment part of I: constant */
    remus6_real t_c[3];    /* kg m2; cos phi */
    remus6_real t_s[3];    /* kg m2; sin phi */
    remus6_real spin;      /* kg m2; Theta_ff: inertia about the spin axis */
    remus6_real spin_inv;  /* 1/(kg m2) */
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

/* The stand as the equations need it. Made by prepare, but for the laws at the end. */
typedef struct remus6_table {
    remus6_real mass;                      /* kg; of all bodies */
    remus6_real mass_inverse;              /* 1/kg */
    remus6_real first_moment[3];           /* kg m; mu about O1, constant part */
    remus6_real inertia[6];                /* kg m2; J about O1, 11 22 33 12 13 23, constant part, with
                                            * added mass */
    remus6_real A[6];                      /* kg; m E + Lambda_11: 11 22 33 12 13 23 */
    remus6_real A_inv[6];                  /* 1/kg */
    remus6_real G[9];                      /* kg m; Lambda_21, row by row */
    remus6_real weight_mass;               /* kg; mass less displaced mass */
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
    remus6_real K[6][6];         /* kg, kg m, kg m2; mass matrix (2) */
    remus6_real K_dot[6][6];     /* per s; its rate (6) */
    remus6_real M[6][6];         /* per s; velocity matrix (9), at V relative to the stream */
    remus6_real I[6][REMUS6_N];  /* kg m, kg m2; flywheel coupling (9), a column a flywheel */
    remus6_real J[6][REMUS6_N];  /* per s; its velocity part (9) */
    remus6_real F[6];            /* N, N m; total external wrench (7) */
} remus6_matrices_result;

/* Momentum, energy and mass centre. */
typedef struct remus6_momentum_result {
    remus6_real Z[6];               /* kg m/s, kg m2/s; momentum screw in E1 about O1 (2) */
    remus6_real Z0[6];              /* kg m/s, kg m2/s; in E0 about its origin (1) */
    remus6_real energy;             /* J; kinetic */
    remus6_real center_of_mass[3];  /* m; of all bodies, in E1 */
} remus6_momentum_result;

/* The equations in generalized coordinates q = (O1 in E0; psi, theta, phi). */
typedef struct remus6_generalized_result {
    remus6_real A[6][6];    /* V = A q' (10) */
    remus6_real D[6][6];    /* 1/s; A' along the motion (10) */
    remus6_real I0[6][6];   /* K A (11) */
    remus6_real J0[6][6];   /* K D + M A (11) */
    remus6_real q_dot[6];   /* m/s, rad/s; O1 in E0, then psi, theta, phi */
    remus6_real q_ddot[6];  /* m/s2, rad/s2; by (11) for the given phi_ddot */
} remus6_generalized_result;

/* One flywheel and its mounting; used by mounts only. */
typedef struct remus6_mount {
    remus6_real mass;             /* kg */
    remus6_real first_moment[3];  /* kg m; m rc, in Es */
    remus6_real inertia[6];       /* kg m2; about Os in Es, 11 22 33 12 13 23 */
    remus6_real origin[3];        /* m; Os in E1 */
    remus6_real axes[9];          /* of Es in E1 at phi = 0, row by row */
} remus6_mount;

/* Second table that mounts needs. Made by prepare_mounts. */
typedef struct remus6_mount_table {
    remus6_mount flywheel[REMUS6_N];
} remus6_mount_table;

/* Motion at an instrument or a point. */
typedef struct remus6_points_result {
    remus6_real position[3];              /* m; in E0 */
    remus6_real C[3][3];                  /* own axes to E0 */
    remus6_real twist[6];                 /* m/s, rad/s; relative to E0, in own axes: a gyro reads the last
                                           * three */
    remus6_real specific_force[3];        /* m/s2; acceleration less gravity, in own axes: an accelerometer */
    remus6_real angular_acceleration[3];  /* rad/s2; in own axes */
} remus6_points_result;

/* An encoder whose counter wraps. Kept by accumulate. */
typedef struct remus6_encoder {
    int counter;  /* last reading */
    int place;    /* counts in the turn, 0 to |per_turn| - 1 */
    int moved;    /* counts between the last two readings */
} remus6_encoder;

/* How inverse chooses among flywheels, and near singularity. */
typedef struct remus6_inverse_options {
    remus6_real weight[REMUS6_N];  /* of each flywheel in the norm of phi'': 1e-6 to 1e6, 1 by default */
    remus6_real limit[REMUS6_N];   /* rad/s2; magnitude of each phi''; greater than 0, infinity for none */
    remus6_real near;              /* NEAR_SINGULAR below this part of the largest singular value, 0..1 */
    remus6_real damping;           /* part of the largest singular value that damps those near zero, 0..1;
                                    * 0: none */
} remus6_inverse_options;

/* Answer of inverse, and how good it is. */
typedef struct remus6_inverse_result {
    remus6_real phi_ddot[REMUS6_N];  /* rad/s2; flywheel accelerations */
    remus6_real residual[6];         /* N, N m; F - K V* - M V - J phi' - I phi'' */
    remus6_real sigma[6];            /* singular values of K^-1/2 I Theta_ff^-1/2, descending */
    int rank;                        /* of them that count */
    remus6_real damped_by;           /* largest lambda applied, in units of sigma; 0: none */
    int limited[REMUS6_N];           /* 1 where the limit of a flywheel was reached */
    remus6_real hardest[6];          /* wrench out of reach, or hardest to reach; of unit size in the norm
                                      * of K^-1 */
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
extern const remus6_table remus6_default;                         /* what prepare makes of them */
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
 * At most 2044 operations on reals, 4 of them divisions. */
remus6_status remus6_forward(const remus6_table *table, const remus6_state *x,
                             const remus6_real phi_ddot[REMUS6_N], remus6_real V_dot[6]);

/* wrench: total external wrench of all bodies at a state, (7).
 *   table  the prepared table
 *   x      state; its attitude within 1e-3 of unit length
 *   F[6]   out: N, N m; total external wrench on the carrier, in E1 about O1
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 1671 operations on reals, 1 of them a division. */
remus6_status remus6_wrench(const remus6_table *table, const remus6_state *x, remus6_real F[6]);

/* matrices: the matrices of K V* + M V + I phi'' + J phi' = F at a state, (2), (6)-(9).
 *   table  the prepared table
 *   x      state; its attitude within 1e-3 of unit length
 *   out    out: K, K_dot, M, I, J, F
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 2385 operations on reals, 1 of them a division. */
remus6_status remus6_matrices(const remus6_table *table, const remus6_state *x, remus6_matrices_result *out);

/* momentum: momentum screw, kinetic energy and mass centre of the whole system, (1), (2).
 *   table  the prepared table
 *   x      state; its attitude within 1e-3 of unit length
 *   out    out: Z, Z0, energy, mass centre
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 2004 operations on reals, 1 of them a division. */
remus6_status remus6_momentum(const remus6_table *table, const remus6_state *x, remus6_momentum_result *out);

/* torque: drive torques for a given motion: tau = f^T (Theta V_s* + Phi(V_s) Z_s - P_s).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   V_dot[6]     m/s2, rad/s2; derivative of the components of V
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   tau[6]       out: N m; drive torques, mount on flywheel, about the spin axis
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 1170 operations on reals, 1 of them a division. */
remus6_status remus6_torque(const remus6_table *table, const remus6_state *x, const remus6_real V_dot[6],
                            const remus6_real phi_ddot[REMUS6_N], remus6_real tau[REMUS6_N]);

/* coupled: motion of the whole system under given drive torques: V* and phi'' together, flywheels
 * eliminated first.
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   tau[6]       N m; drive torques, mount on flywheel
 *   locked[6]    not 0: a lock holds phi'' = 0, whatever its tau
 *   V_dot[6]     out: m/s2, rad/s2; derivative of the components of V
 *   phi_ddot[6]  out: rad/s2; flywheel accelerations
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 3059 operations on reals, 5 of them divisions. */
remus6_status remus6_coupled(const remus6_table *table, const remus6_state *x,
                             const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                             remus6_real V_dot[6], remus6_real phi_ddot[REMUS6_N]);

/* step: state a time step later, under drive torques and wrenches held constant.
 *   table      the prepared table
 *   x          state; its attitude within 1e-3 of unit length
 *   tau[6]     N m; drive torques, mount on flywheel
 *   locked[6]  not 0: a lock holds phi'' = 0, whatever its tau
 *   dt         s; time step, greater than 0
 *   order      4: Runge-Kutta, four evaluations; 2: midpoint rule, two
 *   next       out: state after the step; may be x itself
 * RANGE also where the new state would leave its ranges.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 12902 operations on reals, 26 of them divisions. */
remus6_status remus6_step(const remus6_table *table, const remus6_state *x, const remus6_real tau[REMUS6_N],
                          const int locked[REMUS6_N], remus6_real dt, int order, remus6_state *next);

/* step_driven: state a time step later, under given flywheel accelerations and wrenches held constant.
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   dt           s; time step, greater than 0
 *   order        4: Runge-Kutta, four evaluations; 2: midpoint rule, two
 *   next         out: state after the step; may be x itself
 * RANGE also where the new state would leave its ranges.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 8842 operations on reals, 22 of them divisions. */
remus6_status remus6_step_driven(const remus6_table *table, const remus6_state *x,
                                 const remus6_real phi_ddot[REMUS6_N], remus6_real dt, int order,
                                 remus6_state *next);

/* wrap: the equal angle in [-pi, pi] (pi as the nearest real).
 *   phi      rad; any angle within MAX_PHASE
 *   wrapped  out: rad; the equal angle, in [-pi, pi]
 * Error below 5e-16 rad, modulo a turn.
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 29 operations on reals, no division. */
remus6_status remus6_wrap(remus6_real phi, remus6_real *wrapped);

/* phase_of_counts: phase of an encoder's count.
 *   count     of the encoder, any; or `place` of accumulate
 *   per_turn  counts a turn, negative where phi falls as they rise; to 1073741824
 *   zero      count at phi = 0, at most a turn
 *   phi       out: rad; phase, in [-pi, pi] (pi as the nearest real)
 * Error at most 2 units in the last place for whole `zero`, whatever the count: nothing drifts.
 * RANGE where |zero| is more than a turn.
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 20 operations on reals, 1 of them a division. */
remus6_status remus6_phase_of_counts(int count, int per_turn, remus6_real zero, remus6_real *phi);

/* speed_of_counts: mean speed of a flywheel from the counts of one interval.
 *   moved     counts in the time dt: `moved` of accumulate
 *   per_turn  counts a turn, negative where phi falls as they rise; to 1073741824
 *   dt        s; greater than 0
 *   phi_dot   out: rad/s; mean speed in this time
 * RANGE also where the speed is beyond MAX_SPEED. One count more or less is 2 pi/(per_turn dt).
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 10 operations on reals, 2 of them divisions. */
remus6_status remus6_speed_of_counts(int moved, int per_turn, remus6_real dt, remus6_real *phi_dot);

/* accumulate: one reading of an encoder's counter, which may wrap: its place in the turn and the counts
 * moved, exactly.
 *   encoder   in and out: begin with the first reading, place: counts within the turn
 *   counter   as it is read; of 32 bits: as signed
 *   bits      of the counter, 2 to 32; 0: it counts 0 to per_turn - 1
 *   per_turn  counts a turn, negative where phi falls as they rise; to 1073741824
 * Read it before the counter has moved by half its range (where bits is 0: half a turn).
 * The phase is phase_of_counts of `place`, the speed speed_of_counts of `moved`. Nothing drifts.
 * Returns OK, BAD_ARGUMENT. Nothing is written when the status is negative.
 * No operation on reals. */
remus6_status remus6_accumulate(remus6_encoder *encoder, int counter, int bits, int per_turn);

/* forward_jacobian: derivatives of forward by V, phi, phi' and phi'', at fixed position and attitude, (8).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   out          out: derivatives of V*
 * Where a damping law with magnitudes has a kink, the slope of one of its sides is given.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 10894 operations on reals, 76 of them divisions. */
remus6_status remus6_forward_jacobian(const remus6_table *table, const remus6_state *x,
                                      const remus6_real phi_ddot[REMUS6_N],
                                      remus6_forward_jacobian_result *out);

/* coupled_jacobian: derivatives of coupled by V, phi, phi' and tau, at fixed position and attitude.
 *   table      the prepared table
 *   x          state; its attitude within 1e-3 of unit length
 *   tau[6]     N m; drive torques, mount on flywheel
 *   locked[6]  not 0: a lock holds phi'' = 0, whatever its tau
 *   out        out: derivatives of V* and phi''
 * Where a damping law with magnitudes has a kink, the slope of one of its sides is given.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 19624 operations on reals, 102 of them divisions. */
remus6_status remus6_coupled_jacobian(const remus6_table *table, const remus6_state *x,
                                      const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                                      remus6_coupled_jacobian_result *out);

/* inverse: flywheel accelerations for a wanted motion of the carrier: I phi'' = F - K V* - M V - J phi'.
 * Least residual in the norm of K^-1, then least weighted phi''. What a flywheel at its limit cannot give
 * is shared among the others, (12).
 *   table     the prepared table
 *   x         state; its attitude within 1e-3 of unit length
 *   V_dot[6]  m/s2, rad/s2; wanted derivative of the components of V
 *   options   weights, limits, damping; default_options has those of the stand
 *   out       out: phi_ddot and how good it is
 * Positive statuses are bits that may come together.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT, NEAR_SINGULAR, DAMPED, LIMITED,
 * UNREACHABLE, RANK_DEFICIENT. Nothing is written when the status is negative.
 * At most 42649 operations on reals, 1180 of them divisions. */
remus6_status remus6_inverse(const remus6_table *table, const remus6_state *x, const remus6_real V_dot[6],
                             const remus6_inverse_options *options, remus6_inverse_result *out);

/* inverse_fast: flywheel accelerations for a wanted motion of the carrier, without diagnostics: normal
 * equations, (12).
 *   table        the prepared table
 *   x            state; its attitude within 1e-3 of unit length
 *   V_dot[6]     m/s2, rad/s2; wanted derivative of the components of V
 *   options      weights and damping; near and limits are not read
 *   phi_ddot[6]  out: rad/s2; flywheel accelerations
 * Squares the condition: as good as inverse where singular values are within some thousands of one
 * another;
 * NOT_POSITIVE_DEFINITE where they are not and damping is 0. Damping is relative to the norm of W.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 3553 operations on reals, 97 of them divisions. */
remus6_status remus6_inverse_fast(const remus6_table *table, const remus6_state *x,
                                  const remus6_real V_dot[6], const remus6_inverse_options *options,
                                  remus6_real phi_ddot[REMUS6_N]);

/* points: what an accelerometer and a gyro read at each instrument and point.
 *   table     the prepared table
 *   x         state; its attitude within 1e-3 of unit length
 *   V_dot[6]  m/s2, rad/s2; derivative of the components of V
 *   out[2]    out: a reading each
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 543 operations on reals, 1 of them a division. */
remus6_status remus6_points(const remus6_table *table, const remus6_state *x, const remus6_real V_dot[6],
                            remus6_points_result out[REMUS6_SENSORS]);

/* quaternion: attitude quaternion of three angles.
 *   angles[3]    rad; psi, theta, phi of C = C3(psi) C2(theta) C1(phi) (ship)
 *   attitude[4]  out: unit quaternion, w first
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 176 operations on reals, no division. */
remus6_status remus6_quaternion(const remus6_real angles[3], remus6_real attitude[4]);

/* state_from_coordinates: state and V* of a wanted motion in generalized coordinates: V = A q', V* = A q''
 * + D q', (10).
 *   position[3]  m; of O1, in E0
 *   angles[3]    rad; psi, theta, phi of C = C3(psi) C2(theta) C1(phi) (ship)
 *   q_dot[6]     m/s, rad/s; rates of position and of the angles
 *   q_ddot[6]    m/s2, rad/s2; their rates
 *   x            in and out: its position, attitude and V are written; phases stay
 *   V_dot[6]     out: m/s2, rad/s2; derivative of the components of V
 * Returns OK, NOT_FINITE, RANGE, SINGULAR_ATTITUDE, BAD_ARGUMENT. Nothing is written when the status is
 * negative.
 * At most 465 operations on reals, 1 of them a division. */
remus6_status remus6_state_from_coordinates(const remus6_real position[3], const remus6_real angles[3],
                                            const remus6_real q_dot[6], const remus6_real q_ddot[6],
                                            remus6_state *x, remus6_real V_dot[6]);

/* generalized: the equations in generalized coordinates: A, D, I0, J0, q', and q'' for given phi'', (10),
 * (11).
 *   table        the prepared table
 *   x            state; its attitude is not read, the angles take its place
 *   angles[3]    rad; psi, theta, phi of C = C3(psi) C2(theta) C1(phi) (ship)
 *   phi_ddot[6]  rad/s2; flywheel accelerations
 *   out          out: A, D, I0, J0, q_dot, q_ddot
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, SINGULAR_ATTITUDE, BAD_ARGUMENT. Nothing is
 * written when the status is negative.
 * At most 6438 operations on reals, 7 of them divisions. */
remus6_status remus6_generalized(const remus6_table *table, const remus6_state *x,
                                 const remus6_real angles[3], const remus6_real phi_ddot[REMUS6_N],
                                 remus6_generalized_result *out);

/* prepare: makes the table of a stand from masses, centres of mass, inertias and mountings, (2).
 *   parameters  masses, inertias, mountings
 *   table       in and out: begin with a copy of the default: its laws (gravity, damping, ...) stay
 * The same operations made the table of the generator: for the parameters of the stand file, equal bits.
 * RANGE also where a mass is negative or axes have no direction.
 * NOT_POSITIVE_DEFINITE where no body is such: moments of inertia about the centre of mass that are
 * negative or break the triangle inequality, added mass that is not symmetric and positive semidefinite
 * (to 1e-09 of the largest element); a flywheel without spin inertia; no mass at all.
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 12196 operations on reals, 110 of them divisions. */
remus6_status remus6_prepare(const remus6_parameters *parameters, remus6_table *table);

/* mounts: wrench of the mount on each flywheel: bearing loads, and what shakes the structure.
 *   table             the prepared table
 *   mounting          made once by prepare_mounts
 *   x                 state; its attitude within 1e-3 of unit length
 *   V_dot[6]          m/s2, rad/s2; derivative of the components of V
 *   phi_ddot[6]       rad/s2; flywheel accelerations
 *   mount_wrench[36]  out: N, N m; of the mount on each flywheel, six numbers each, about Os in the axes
 *                     of Es at phi = 0; the fourth is tau
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 2325 operations on reals, 1 of them a division. */
remus6_status remus6_mounts(const remus6_table *table, const remus6_mount_table *mounting,
                            const remus6_state *x, const remus6_real V_dot[6],
                            const remus6_real phi_ddot[REMUS6_N], remus6_real mount_wrench[36]);

/* prepare_mounts: makes the second table that mounts needs.
 *   parameters  masses, inertias, mountings
 *   mounting    out: what mounts needs
 * Returns OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT. Nothing is written when the status
 * is negative.
 * At most 5919 operations on reals, 94 of them divisions. */
remus6_status remus6_prepare_mounts(const remus6_parameters *parameters, remus6_mount_table *mounting);

/* center_of_mass_velocity: velocity of the mass centre of all bodies, rotation of the flywheels included.
 *   table                       the prepared table
 *   x                           state; its attitude within 1e-3 of unit length
 *   center_of_mass_velocity[3]  out: m/s; relative to E0, in E0
 * Returns OK, NOT_FINITE, RANGE, BAD_ARGUMENT. Nothing is written when the status is negative.
 * At most 1608 operations on reals, 1 of them a division. */
remus6_status remus6_center_of_mass_velocity(const remus6_table *table, const remus6_state *x,
                                             remus6_real center_of_mass_velocity[3]);

#ifdef __cplusplus
}
#endif

#endif
