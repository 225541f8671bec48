/* remus6.c: motion of the stand "remus6". What each function does and takes: remus6.h.
 * mahovik 0.1.0; structure 3687deee, physics 5f25aea2. Generated: change the stand file instead. */
#include "remus6.h"

#include <stddef.h>
#include <stdint.h>

#if REMUS6_STRUCTURE != 0x3687deeeu || REMUS6_PHYSICS != 0x5f25aea2u
#error "remus6.h and remus6.c are of different stands"
#endif
#if REMUS6_REAL_BYTES != 8
#error "remus6.h and remus6.c were generated for different element types"
#endif
#if REMUS6_VERSION_MAJOR != 0 || REMUS6_VERSION_MINOR != 1 || REMUS6_VERSION_PATCH != 0
#error "remus6.h and remus6.c are of different versions of mahovik"
#endif

#include <float.h>
#include <limits.h>

/* Other numbers than those of IEEE 754, and fast math, which leaves out roundings that the code relies on,
 * give wrong results with status OK. What the compiler shows of them is refused here; clang does not show
 * -funsafe-math-optimizations. */
#if FLT_RADIX != 2 || DBL_MANT_DIG != 53
#error "wrong results: remus6 needs a double of 64 bits, 53 of them significant"
#endif
#if INT_MAX < 2147483647
#error "wrong counts: remus6 needs an int of 32 bits"
#endif
#ifndef REMUS6_ALLOW_FAST_MATH
#if defined __FAST_MATH__ || defined __ASSOCIATIVE_MATH__ || defined __RECIPROCAL_MATH__ || defined _M_FP_FAST
#error "wrong results: compile remus6 without -ffast-math, -Ofast and -funsafe-math-optimizations"
#elif FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1 && FLT_EVAL_METHOD != 16
#error "wrong results: x87 keeps more digits: compile remus6 with -msse2 -mfpmath=sse"
#endif
#if defined __FINITE_MATH_ONLY__ && __FINITE_MATH_ONLY__ == 1
#error "inputs that are NaN would pass: compile remus6 without -ffinite-math-only"
#endif
#endif

/* Attributes for sections, such as fast memory: define them to place code and tables. */
#ifndef REMUS6_CODE
#define REMUS6_CODE
#endif
#ifndef REMUS6_CONST
#define REMUS6_CONST
#endif

/* Seldom called: one copy takes less code than one in each caller. */
#ifdef __GNUC__
#define REMUS6_APART __attribute__((noinline))
#else
#define REMUS6_APART
#endif

/* On desktop processors copies in the callers are faster; elsewhere they take too much code. */
#if defined __GNUC__ && !defined __OPTIMIZE_SIZE__ && (defined __x86_64__ || defined __aarch64__)
#define REMUS6_COPIED inline __attribute__((always_inline))
#else
#define REMUS6_COPIED
#endif

/* Sums over all bodies at one state. */
typedef struct remus6_sums {
    remus6_real mu[3];      /* kg m; first moment of all bodies about O1 */
    remus6_real mu_dot[3];  /* kg m/s; its rate in E1 */
    remus6_real J[6];       /* kg m2; inertia about O1 */
    remus6_real J_dot[6];   /* kg m2/s; its rate in E1 */
    remus6_real h_rel[3];   /* kg m2/s; moment part of sum I phi' */
    remus6_real g_rel[3];   /* N m; d/dt of the moment part */
    remus6_real a_rel[3];   /* N; d/dt of the force part */
} remus6_sums;

/* A symmetric 3x3 matrix factored, L D L^T. */
typedef struct remus6_factors3 {
    remus6_real r1;   /* 1 / D, of the last D itself */
    remus6_real r2;
    remus6_real d3;
    remus6_real l21;  /* L below its diagonal */
    remus6_real l31;
    remus6_real l32;
} remus6_factors3;

/* K of the carrier factored. */
typedef struct remus6_carrier_factor {
    remus6_real U[9];   /* m; A^-1 B^T */
    remus6_factors3 L;  /* what is left of the inertia */
} remus6_carrier_factor;

/* How one flywheel's drive torque depends on the motion: I . V* + Theta_ff phi'' + bias. */
typedef struct remus6_coupling {
    remus6_real I_[6];  /* kg m, kg m2; column of I (9) */
    remus6_real bias;   /* N m; drive torque at V* = 0, phi'' = 0 */
} remus6_coupling;

/* K with free flywheels eliminated: K - sum I I^T / Theta_ff. */
typedef struct remus6_schur {
    remus6_real A[6];  /* kg; force by v*: 11 22 33 12 13 23 */
    remus6_real B[9];  /* kg m; moment by v*, row by row */
    remus6_real D[6];  /* kg m2; moment by omega*: 11 22 33 12 13 23 */
} remus6_schur;

/* K with free flywheels eliminated, factored. */
typedef struct remus6_schur_factor {
    remus6_real A_inv[6];  /* 1/kg */
    remus6_real U[9];      /* m; A^-1 B^T */
    remus6_factors3 L;     /* D - B A^-1 B^T */
} remus6_schur_factor;

/* Scratch of inverse. */
typedef struct remus6_inverse_work {
    remus6_real I_[6][REMUS6_N];  /* kg m, kg m2; flywheel coupling (9) */
    remus6_real W[6][REMUS6_N];   /* scaled: G^-1 I D^-1; then with orthogonal rows */
    remus6_real U[6][6];          /* rotations of the rows */
    remus6_real G[6][6];          /* Cholesky factor of K, lower triangle */
    remus6_real b[6];             /* N, N m; the wrench demanded of the flywheels */
    remus6_real r[6];             /* scaled: G^-1 b; then U^T r */
    remus6_real sigma[6];         /* singular values */
    remus6_real scale[REMUS6_N];  /* D^-1 */
} remus6_inverse_work;

typedef uint64_t remus6_word;  /* the bits of a real */

REMUS6_CODE
static remus6_word remus6_bits_of(remus6_real value)
{
    union { remus6_real real; remus6_word word; } both;
    both.real = value;
    return both.word;
}

REMUS6_CODE
static remus6_real remus6_real_of(remus6_word word)
{
    union { remus6_real real; remus6_word word; } both;
    both.word = word;
    return both.real;
}

/* What null stands for. */
REMUS6_CONST
static const int remus6_none_locked[REMUS6_N] = { 0 };

/* Sine and cosine of an angle.
 * |x| <= 1e+07, which the caller checks. Error at most 1 unit in the last place
 * for |x| <= 8 pi, and 1e-16 absolute beyond. Other x give meaningless results, but the call is safe. */
REMUS6_CODE
static void remus6_sincos(remus6_real x, remus6_real *restrict sine, remus6_real *restrict cosine)
{
    /* k = x/(pi/2), rounded: adding the large constant leaves the integer k in the last bits of the sum. */
    const remus6_real shifted = x * 0.6366197723675814 + 6755399441055744.0;
    const remus6_word quadrant = remus6_bits_of(shifted);  /* mod 4: its last two bits */
    const remus6_real k = shifted - 6755399441055744.0;
    /* r = r_hi - r_tail = x - k pi/2, pi/2 in three parts: the product with the first is exact. */
    const remus6_real rest = x - k * 1.570796325802803;
    const remus6_real second = k * 9.920935796805365e-10;
    const remus6_real r_hi = rest - second;
    /* rounding error of r_hi, and the third part */
    const remus6_real r_tail = r_hi - rest + second + k * 3.9455541665632055e-24;
    const remus6_real z = r_hi * r_hi;
    /* cos r_hi = 1 - z/2 + z^2 C(z); the rounding error of 1 - z/2 is added back. */
    const remus6_real half_z = z * 0.5;
    const remus6_real flat = 1.0 - half_z;
    const remus6_real cos_fit = 0.0416666666666666
        + z * (-0.001388888888887447 + z * (2.4801587289666868e-5
        + z * (-2.755731439924032e-7 + z * (2.087572898867696e-9 + z * -1.1359916930271879e-11))));
    const remus6_real cos_r = flat + (1.0 - flat - half_z + (z * z * cos_fit + r_hi * r_tail));
    /* sin r_hi = r_hi - r_hi^3 S(z), S with positive sign so that sin(-0) = -0. */
    const remus6_real sin_fit = 0.1666666666666663
        + z * (-0.00833333333332184 + z * (0.00019841269829358541
        + z * (-2.7557313538526495e-6 + z * (2.5050734392488434e-8 + z * -1.5895433551463968e-10))));
    const remus6_real sin_r = r_hi - (z * r_hi * sin_fit + flat * r_tail);
    /* Odd quadrants exchange sine and cosine; quadrants 2, 3 negate the sine, 1, 2 the cosine. */
    const remus6_word sin_bits = remus6_bits_of(sin_r);
    const remus6_word cos_bits = remus6_bits_of(cos_r);
    const remus6_word exchange = (sin_bits ^ cos_bits) & (0u - (quadrant & 1u));
    const remus6_word sine_sign = (quadrant << 62u) & 0x8000000000000000u;
    const remus6_word cosine_sign = ((quadrant + 1u) << 62u) & 0x8000000000000000u;
    *sine = remus6_real_of(sin_bits ^ exchange ^ sine_sign);
    *cosine = remus6_real_of(cos_bits ^ exchange ^ cosine_sign);
}

/* Square root, correctly rounded.
 * x >= 0 and finite, which the caller checks; subnormals are exact too, sqrt(0) = 0. */
REMUS6_CODE
static remus6_real remus6_sqrt(remus6_real x)
{
#ifdef REMUS6_SQRT
    return REMUS6_SQRT(x);  /* correctly rounded as well, or the bits differ */
#else
    /* x = m 4^j with m in [1, 4), taken from its bits; subnormals are scaled up first. */
    const int subnormal = x < 2.2250738585072014e-308;
    const remus6_real lift = (subnormal) ? 1.8014398509481984e16 : 1.0;
    const remus6_word lowered = (subnormal) ? 27u : 0u;
    const remus6_word bits = remus6_bits_of(x * lift);
    const remus6_word exponent = bits >> 52u;
    const remus6_word odd = (exponent & 1u) ^ 1u;  /* the exponent's bias is odd */
    const remus6_word fraction = bits & 0xfffffffffffffu;
    const remus6_word m_bits = fraction + ((odd + 1023u) << 52u);
    const remus6_real m = remus6_real_of(m_bits);
    const remus6_real half_m = m * 0.5;
    /* y = 1/sqrt(m): a shift of the bits gives a first guess, Newton steps refine it. */
    const remus6_real y0 = remus6_real_of(0x5fe6eb50c7b537a9u - (m_bits >> 1u));
    const remus6_real y1 = y0 * (1.5 - half_m * y0 * y0);
    const remus6_real y2 = y1 * (1.5 - half_m * y1 * y1);
    const remus6_real y3 = y2 * (1.5 - half_m * y2 * y2);
    const remus6_real s = m * y3;
    const remus6_real close = s + (m - s * s) * (y3 * 0.5);  /* within 1.5 units in the last place */
    /* The last bit, exactly, in integers modulo 2^width: compare d = m - s^2 with s, in units of the last
     * place. */
    const remus6_word root = remus6_bits_of(close) - 0x3fe0000000000000u;  /* s as an integer */
    const remus6_word d = ((fraction + 0x10000000000000u) << odd << 52u) - root * root;
    const remus6_word up = (root - d) >> 63u;  /* 1 if d > s: the next larger number is nearer */
    const remus6_word down = (d + root - 1u) >> 63u;  /* 1 if d <= -s: the next smaller number is nearer */
    const remus6_word halved = ((exponent + 1023u - odd) >> 1u) - lowered;
    const remus6_real result = remus6_real_of(root + up - down + ((halved - 1u) << 52u));
    return (x > 0.0) ? result : x;
#endif
}

/* Removes k turns, phi - k 2 pi, with 2 pi in three parts: the product with the first is exact. */
REMUS6_CODE
static remus6_real remus6_unwound(remus6_real phi, remus6_real k)
{
    return phi - k * 6.283185303211212 - k * 3.968374318722146e-9 - k * 1.5782216666252822e-23;
}

/* The angle wrapped to within half a turn of zero.
 * |phi| <= 1e+07: beyond this the result is meaningless, but the call is safe. */
REMUS6_CODE
static remus6_real remus6_wrapped(remus6_real phi)
{
    /* k = phi / (2 pi), rounded: adding the large constant leaves the integer k in the last bits of the
     * sum. */
    const remus6_real k = phi * 0.15915494309189535 + 6755399441055744.0 - 6755399441055744.0;  /* turns */
    return remus6_unwound(phi, k);
}

/* Are all values finite, and none larger in magnitude than the limit? A NaN fails every comparison. */
REMUS6_CODE REMUS6_APART
static remus6_status remus6_within(const remus6_real values[], int count, remus6_real limit)
{
    for (int i = 0; i < count; ++i) {
        if (!(values[i] >= -limit && values[i] <= limit)) {
            if (values[i] >= -REMUS6_LARGEST && values[i] <= REMUS6_LARGEST) { return REMUS6_RANGE; }
            return REMUS6_NOT_FINITE;
        }
    }
    return REMUS6_OK;
}

/* Is the state finite, in its ranges, and its quaternion within 1e-3 of unit length? */
REMUS6_CODE
static remus6_status remus6_check_state(const remus6_state *x)
{
    {
        remus6_real position2, velocity2, speed2, phase2;
        position2 = 0.0;
        velocity2 = 0.0;
        speed2 = 0.0;
        phase2 = 0.0;
        for (int i = 0; i < 3; ++i) {
            const remus6_real position = x->position[i];
            position2 += position * position;
            const remus6_real velocity = x->V[i];
            velocity2 += velocity * velocity;
            const remus6_real speed = x->V[i + 3];
            speed2 += speed * speed;
        }
        for (int s = 0; s < REMUS6_N; ++s) {
            const remus6_real phase = x->phi[s];
            phase2 += phase * phase;
            const remus6_real speed = x->phi_dot[s];
            speed2 += speed * speed;
        }
        const remus6_real norm2 = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
            + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
        if (norm2 >= 0.998001 && norm2 <= 1.002001 && position2 < REMUS6_MAX_POSITION * REMUS6_MAX_POSITION
            && velocity2 < REMUS6_MAX_VELOCITY * REMUS6_MAX_VELOCITY
            && speed2 < REMUS6_MAX_SPEED * REMUS6_MAX_SPEED
            && phase2 < REMUS6_MAX_PHASE * REMUS6_MAX_PHASE) { return REMUS6_OK; }
    }
    remus6_status status = remus6_within(x->position, 3, REMUS6_MAX_POSITION);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(x->attitude, 4, 2.0);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(x->V, 6, REMUS6_MAX_SPEED);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(x->V, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(x->phi, REMUS6_N, REMUS6_MAX_PHASE);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(x->phi_dot, REMUS6_N, REMUS6_MAX_SPEED);
    if (status != REMUS6_OK) { return status; }
    const remus6_real norm2 = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
        + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
    if (!(norm2 >= 0.998001 && norm2 <= 1.002001)) { return REMUS6_RANGE; }
    return REMUS6_OK;
}

/* Rotation matrix of a quaternion of any length: no square root is needed. */
REMUS6_CODE
static void remus6_rotation(const remus6_real q[4], remus6_real *restrict C /* [9] */)
{
    const remus6_real k = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    C[0] = 1.0 + k * (-(q[2] * q[2]) - q[3] * q[3]);
    C[1] = k * (q[1] * q[2] - q[0] * q[3]);
    C[2] = k * (q[0] * q[2] + q[1] * q[3]);
    C[3] = k * (q[0] * q[3] + q[1] * q[2]);
    C[4] = 1.0 + k * (-(q[1] * q[1]) - q[3] * q[3]);
    C[5] = k * (q[2] * q[3] - q[0] * q[1]);
    C[6] = k * (q[1] * q[3] - q[0] * q[2]);
    C[7] = k * (q[0] * q[1] + q[2] * q[3]);
    C[8] = 1.0 + k * (-(q[1] * q[1]) - q[2] * q[2]);
}

/* C^T a: components from the outer axes to the rotated axes. */
REMUS6_CODE
static void remus6_rotate_back(const remus6_real C[9], const remus6_real a[3],
                               remus6_real *restrict out /* [3] */)
{
    out[0] = C[0] * a[0] + C[3] * a[1] + C[6] * a[2];
    out[1] = C[1] * a[0] + C[4] * a[1] + C[7] * a[2];
    out[2] = C[2] * a[0] + C[5] * a[1] + C[8] * a[2];
}

/* Sines and cosines of all phases.
 * |x| <= 1e+07, which the caller checks. Error at most 1 unit in the last place
 * for |x| <= 8 pi, and 1e-16 absolute beyond. Other x give meaningless results, but the call is safe. */
REMUS6_CODE
static void remus6_sincos_each(const remus6_real x[REMUS6_N], remus6_real *restrict sine /* [REMUS6_N] */,
                               remus6_real *restrict cosine /* [REMUS6_N] */)
{
    for (int s = 0; s < REMUS6_N; ++s) {
        /* k = x/(pi/2), rounded: adding the large constant leaves the integer k in the last bits of the
         * sum. */
        const remus6_real shifted = x[s] * 0.6366197723675814 + 6755399441055744.0;
        const remus6_word quadrant = remus6_bits_of(shifted);  /* mod 4: its last two bits */
        const remus6_real k = shifted - 6755399441055744.0;
        /* r = r_hi - r_tail = x - k pi/2, pi/2 in three parts: the product with the first is exact. */
        const remus6_real rest = x[s] - k * 1.570796325802803;
        const remus6_real second = k * 9.920935796805365e-10;
        const remus6_real r_hi = rest - second;
        /* rounding error of r_hi, and the third part */
        const remus6_real r_tail = r_hi - rest + second + k * 3.9455541665632055e-24;
        const remus6_real z = r_hi * r_hi;
        /* cos r_hi = 1 - z/2 + z^2 C(z); the rounding error of 1 - z/2 is added back. */
        const remus6_real half_z = z * 0.5;
        const remus6_real flat = 1.0 - half_z;
        const remus6_real cos_fit = 0.0416666666666666
            + z * (-0.001388888888887447 + z
            * (2.4801587289666868e-5 + z * (-2.755731439924032e-7
            + z * (2.087572898867696e-9 + z * -1.1359916930271879e-11))));
        const remus6_real cos_r = flat + (1.0 - flat - half_z + (z * z * cos_fit + r_hi * r_tail));
        /* sin r_hi = r_hi - r_hi^3 S(z), S with positive sign so that sin(-0) = -0. */
        const remus6_real sin_fit = 0.1666666666666663
            + z * (-0.00833333333332184 + z * (0.00019841269829358541
            + z * (-2.7557313538526495e-6 + z * (2.5050734392488434e-8 + z * -1.5895433551463968e-10))));
        const remus6_real sin_r = r_hi - (z * r_hi * sin_fit + flat * r_tail);
        /* Odd quadrants exchange sine and cosine; quadrants 2, 3 negate the sine, 1, 2 the cosine. */
        const remus6_word sin_bits = remus6_bits_of(sin_r);
        const remus6_word cos_bits = remus6_bits_of(cos_r);
        const remus6_word exchange = (sin_bits ^ cos_bits) & (0u - (quadrant & 1u));
        const remus6_word sine_sign = (quadrant << 62u) & 0x8000000000000000u;
        const remus6_word cosine_sign = ((quadrant + 1u) << 62u) & 0x8000000000000000u;
        sine[s] = remus6_real_of(sin_bits ^ exchange ^ sine_sign);
        cosine[s] = remus6_real_of(cos_bits ^ exchange ^ cosine_sign);
    }
}

/* First moment and inertia of all bodies, and their rates in E1; w = phi', (2), (6). */
REMUS6_CODE
static void remus6_sum_mass(const remus6_table *table, const remus6_real sine[REMUS6_N],
                            const remus6_real cosine[REMUS6_N], const remus6_real phi_dot[REMUS6_N],
                            remus6_sums *restrict sum)
{
    sum->J[0] = table->inertia[0];  sum->J[1] = table->inertia[1];  sum->J[2] = table->inertia[2];
    sum->J[3] = table->inertia[3];  sum->J[4] = table->inertia[4];  sum->J[5] = table->inertia[5];
    sum->J_dot[0] = 0.0;  sum->J_dot[1] = 0.0;  sum->J_dot[2] = 0.0;
    sum->J_dot[3] = 0.0;  sum->J_dot[4] = 0.0;  sum->J_dot[5] = 0.0;
    sum->mu[0] = table->first_moment[0];
    sum->mu[1] = table->first_moment[1];
    sum->mu[2] = table->first_moment[2];
    sum->mu_dot[0] = 0.0;  sum->mu_dot[1] = 0.0;  sum->mu_dot[2] = 0.0;
    for (int k = 0; k < REMUS6_N; ++k) {
        const remus6_real s = sine[k];
        const remus6_real c = cosine[k];
        const remus6_real w = phi_dot[k];
        const remus6_real c2 = 1.0 - 2.0 * (s * s);  /* cos 2 phi, then sin 2 phi */
        const remus6_real s2 = 2.0 * c * s;
        const remus6_real dc = -w * s;  /* time derivatives: d(cos phi)/dt, ... */
        const remus6_real ds = w * c;
        const remus6_real dc2 = -2.0 * w * s2;
        const remus6_real ds2 = 2.0 * w * c2;
        /* inertia */
        sum->J[0] += table->flywheel[k].J_2c[0] * c2 + table->flywheel[k].J_2s[0] * s2
            + table->flywheel[k].J_c[0] * c + table->flywheel[k].J_s[0] * s;
        sum->J[1] += table->flywheel[k].J_2c[1] * c2 + table->flywheel[k].J_2s[1] * s2
            + table->flywheel[k].J_c[1] * c + table->flywheel[k].J_s[1] * s;
        sum->J[2] += table->flywheel[k].J_2c[2] * c2 + table->flywheel[k].J_2s[2] * s2
            + table->flywheel[k].J_c[2] * c + table->flywheel[k].J_s[2] * s;
        sum->J[3] += table->flywheel[k].J_2c[3] * c2 + table->flywheel[k].J_2s[3] * s2
            + table->flywheel[k].J_c[3] * c + table->flywheel[k].J_s[3] * s;
        sum->J[4] += table->flywheel[k].J_2c[4] * c2 + table->flywheel[k].J_2s[4] * s2
            + table->flywheel[k].J_c[4] * c + table->flywheel[k].J_s[4] * s;
        sum->J[5] += table->flywheel[k].J_2c[5] * c2 + table->flywheel[k].J_2s[5] * s2
            + table->flywheel[k].J_c[5] * c + table->flywheel[k].J_s[5] * s;
        /* its rate: K_dot of (6) */
        sum->J_dot[0] += table->flywheel[k].J_2c[0] * dc2 + table->flywheel[k].J_2s[0] * ds2
            + table->flywheel[k].J_c[0] * dc + table->flywheel[k].J_s[0] * ds;
        sum->J_dot[1] += table->flywheel[k].J_2c[1] * dc2 + table->flywheel[k].J_2s[1] * ds2
            + table->flywheel[k].J_c[1] * dc + table->flywheel[k].J_s[1] * ds;
        sum->J_dot[2] += table->flywheel[k].J_2c[2] * dc2 + table->flywheel[k].J_2s[2] * ds2
            + table->flywheel[k].J_c[2] * dc + table->flywheel[k].J_s[2] * ds;
        sum->J_dot[3] += table->flywheel[k].J_2c[3] * dc2 + table->flywheel[k].J_2s[3] * ds2
            + table->flywheel[k].J_c[3] * dc + table->flywheel[k].J_s[3] * ds;
        sum->J_dot[4] += table->flywheel[k].J_2c[4] * dc2 + table->flywheel[k].J_2s[4] * ds2
            + table->flywheel[k].J_c[4] * dc + table->flywheel[k].J_s[4] * ds;
        sum->J_dot[5] += table->flywheel[k].J_2c[5] * dc2 + table->flywheel[k].J_2s[5] * ds2
            + table->flywheel[k].J_c[5] * dc + table->flywheel[k].J_s[5] * ds;
        /* first moment and its rate */
        sum->mu[0] += table->flywheel[k].mu_c[0] * c + table->flywheel[k].mu_s[0] * s;
        sum->mu[1] += table->flywheel[k].mu_c[1] * c + table->flywheel[k].mu_s[1] * s;
        sum->mu[2] += table->flywheel[k].mu_c[2] * c + table->flywheel[k].mu_s[2] * s;
        sum->mu_dot[0] += table->flywheel[k].mu_c[0] * dc + table->flywheel[k].mu_s[0] * ds;
        sum->mu_dot[1] += table->flywheel[k].mu_c[1] * dc + table->flywheel[k].mu_s[1] * ds;
        sum->mu_dot[2] += table->flywheel[k].mu_c[2] * dc + table->flywheel[k].mu_s[2] * ds;
    }
}

/* Terms of the flywheels' turning in momentum and forces; w = phi' is constant, (2), (5). */
REMUS6_CODE
static REMUS6_COPIED void remus6_sum_steady_spin(const remus6_table *table, const remus6_real sine[REMUS6_N],
                                                 const remus6_real cosine[REMUS6_N],
                                                 const remus6_real phi_dot[REMUS6_N],
                                                 remus6_sums *restrict sum)
{
    sum->h_rel[0] = 0.0;  sum->h_rel[1] = 0.0;  sum->h_rel[2] = 0.0;
    sum->g_rel[0] = 0.0;  sum->g_rel[1] = 0.0;  sum->g_rel[2] = 0.0;
    sum->a_rel[0] = 0.0;  sum->a_rel[1] = 0.0;  sum->a_rel[2] = 0.0;
    for (int k = 0; k < REMUS6_N; ++k) {
        const remus6_real s = sine[k];
        const remus6_real c = cosine[k];
        const remus6_real w = phi_dot[k];
        const remus6_real dc = -w * s;  /* time derivatives: d(cos phi)/dt, ... */
        const remus6_real ds = w * c;
        const remus6_real ddc = -w * ds;  /* second time derivatives */
        const remus6_real dds = w * dc;
        /* I phi'' + Ls [<e>] Theta f phi'^2, the last two sums of (5) */
        sum->a_rel[0] += table->flywheel[k].mu_c[0] * ddc + table->flywheel[k].mu_s[0] * dds;
        sum->a_rel[1] += table->flywheel[k].mu_c[1] * ddc + table->flywheel[k].mu_s[1] * dds;
        sum->a_rel[2] += table->flywheel[k].mu_c[2] * ddc + table->flywheel[k].mu_s[2] * dds;
        /* moment part of I phi' (its force part is mu_dot) */
        sum->h_rel[0] += table->flywheel[k].t_c[0] * ds + w * table->flywheel[k].t_0[0]
            - table->flywheel[k].t_s[0] * dc;
        sum->h_rel[1] += table->flywheel[k].t_c[1] * ds + w * table->flywheel[k].t_0[1]
            - table->flywheel[k].t_s[1] * dc;
        sum->h_rel[2] += table->flywheel[k].t_c[2] * ds + w * table->flywheel[k].t_0[2]
            - table->flywheel[k].t_s[2] * dc;
        sum->g_rel[0] += table->flywheel[k].t_c[0] * dds - table->flywheel[k].t_s[0] * ddc;
        sum->g_rel[1] += table->flywheel[k].t_c[1] * dds - table->flywheel[k].t_s[1] * ddc;
        sum->g_rel[2] += table->flywheel[k].t_c[2] * dds - table->flywheel[k].t_s[2] * ddc;
    }
}

/* Terms of the flywheels' turning in momentum and forces; w = phi', a = phi'', (2), (5). */
REMUS6_CODE
static REMUS6_COPIED void remus6_sum_spin(const remus6_table *table, const remus6_real sine[REMUS6_N],
                                          const remus6_real cosine[REMUS6_N],
                                          const remus6_real phi_dot[REMUS6_N],
                                          const remus6_real phi_ddot[REMUS6_N], remus6_sums *restrict sum)
{
    sum->h_rel[0] = 0.0;  sum->h_rel[1] = 0.0;  sum->h_rel[2] = 0.0;
    sum->g_rel[0] = 0.0;  sum->g_rel[1] = 0.0;  sum->g_rel[2] = 0.0;
    sum->a_rel[0] = 0.0;  sum->a_rel[1] = 0.0;  sum->a_rel[2] = 0.0;
    for (int k = 0; k < REMUS6_N; ++k) {
        const remus6_real s = sine[k];
        const remus6_real c = cosine[k];
        const remus6_real w = phi_dot[k];
        const remus6_real a = phi_ddot[k];
        const remus6_real dc = -w * s;  /* time derivatives: d(cos phi)/dt, ... */
        const remus6_real ds = w * c;
        const remus6_real ddc = -w * ds - a * s;  /* second time derivatives */
        const remus6_real dds = a * c + w * dc;
        /* moment part of I phi' (its force part is mu_dot) */
        sum->h_rel[0] += table->flywheel[k].t_c[0] * ds + w * table->flywheel[k].t_0[0]
            - table->flywheel[k].t_s[0] * dc;
        sum->h_rel[1] += table->flywheel[k].t_c[1] * ds + w * table->flywheel[k].t_0[1]
            - table->flywheel[k].t_s[1] * dc;
        sum->h_rel[2] += table->flywheel[k].t_c[2] * ds + w * table->flywheel[k].t_0[2]
            - table->flywheel[k].t_s[2] * dc;
        sum->g_rel[0] += table->flywheel[k].t_c[0] * dds + a * table->flywheel[k].t_0[0]
            - table->flywheel[k].t_s[0] * ddc;
        sum->g_rel[1] += table->flywheel[k].t_c[1] * dds + a * table->flywheel[k].t_0[1]
            - table->flywheel[k].t_s[1] * ddc;
        sum->g_rel[2] += table->flywheel[k].t_c[2] * dds + a * table->flywheel[k].t_0[2]
            - table->flywheel[k].t_s[2] * ddc;
        /* I phi'' + Ls [<e>] Theta f phi'^2, the last two sums of (5) */
        sum->a_rel[0] += table->flywheel[k].mu_c[0] * ddc + table->flywheel[k].mu_s[0] * dds;
        sum->a_rel[1] += table->flywheel[k].mu_c[1] * ddc + table->flywheel[k].mu_s[1] * dds;
        sum->a_rel[2] += table->flywheel[k].mu_c[2] * ddc + table->flywheel[k].mu_s[2] * dds;
    }
}

/* Adds the damping of one body to its wrench, both in the body's own frame, (7). */
REMUS6_CODE
static void remus6_damp(const remus6_table *table, const remus6_damper *damper, const remus6_real V[6],
                        remus6_real *restrict P /* [6] */)
{
    remus6_real x[12];  /* u v w p q r and their magnitudes */
    x[0] = V[0];  x[1] = V[1];  x[2] = V[2];
    x[3] = V[3];  x[4] = V[4];  x[5] = V[5];
    x[6] = (V[0] < 0.0) ? -V[0] : V[0];
    x[7] = (V[1] < 0.0) ? -V[1] : V[1];
    x[8] = (V[2] < 0.0) ? -V[2] : V[2];
    x[9] = (V[3] < 0.0) ? -V[3] : V[3];
    x[10] = (V[4] < 0.0) ? -V[4] : V[4];
    x[11] = (V[5] < 0.0) ? -V[5] : V[5];
    for (int t = damper->first_term; t < damper->last_term; ++t) {
        P[table->term[t].wrench] += table->term[t].value * x[table->term[t].first] * x[table->term[t].second];
    }
}

/* Total external wrench of weight, buoyancy, damping, from checked inputs, (7). */
REMUS6_CODE
static void remus6_external(const remus6_table *table, const remus6_sums *sum, const remus6_real V[6],
                            const remus6_real g[3], remus6_real *restrict F /* [6] */)
{
    F[0] = 0.0;  F[1] = 0.0;  F[2] = 0.0;
    F[3] = 0.0;  F[4] = 0.0;  F[5] = 0.0;
    /* weight of all bodies: its line of action moves with the flywheels */
    F[0] += g[0] * table->weight_mass;  F[1] += g[1] * table->weight_mass;  F[2] += g[2] * table->weight_mass;
    F[3] += (sum->mu[1] - table->displaced_moment[1]) * g[2]
        + (table->displaced_moment[2] - sum->mu[2]) * g[1];
    F[4] += (table->displaced_moment[0] - sum->mu[0]) * g[2]
        + (sum->mu[2] - table->displaced_moment[2]) * g[0];
    F[5] += (sum->mu[0] - table->displaced_moment[0]) * g[1]
        + (table->displaced_moment[1] - sum->mu[1]) * g[0];
    remus6_damp(table, &table->damper, V, F);
}

/* Momentum screw Z = K V + sum I phi' of the sums, (2). */
REMUS6_CODE
static void remus6_momentum_screw(const remus6_table *table, const remus6_sums *sum, const remus6_real V[6],
                                  remus6_real *restrict Z /* [6] */)
{
    Z[0] = table->A[0] * V[0] + table->A[3] * V[1] + table->A[4] * V[2] + table->G[0] * V[3]
        + (table->G[3] + sum->mu[2]) * V[4] + (table->G[6] - sum->mu[1]) * V[5] + sum->mu_dot[0];
    Z[1] = table->A[1] * V[1] + table->A[3] * V[0] + table->A[5] * V[2] + (table->G[1] - sum->mu[2]) * V[3]
        + table->G[4] * V[4] + (table->G[7] + sum->mu[0]) * V[5] + sum->mu_dot[1];
    Z[2] = table->A[2] * V[2] + table->A[4] * V[0] + table->A[5] * V[1] + (table->G[2] + sum->mu[1]) * V[3]
        + (table->G[5] - sum->mu[0]) * V[4] + table->G[8] * V[5] + sum->mu_dot[2];
    Z[3] = table->G[0] * V[0] + (table->G[1] - sum->mu[2]) * V[1] + (table->G[2] + sum->mu[1]) * V[2]
        + sum->J[0] * V[3] + sum->J[3] * V[4] + sum->J[4] * V[5] + sum->h_rel[0];
    Z[4] = (table->G[3] + sum->mu[2]) * V[0] + table->G[4] * V[1] + (table->G[5] - sum->mu[0]) * V[2]
        + sum->J[1] * V[4] + sum->J[3] * V[3] + sum->J[5] * V[5] + sum->h_rel[1];
    Z[5] = (table->G[6] - sum->mu[1]) * V[0] + (table->G[7] + sum->mu[0]) * V[1] + table->G[8] * V[2]
        + sum->J[2] * V[5] + sum->J[4] * V[3] + sum->J[5] * V[4] + sum->h_rel[2];
}

/* Turns F into the right-hand side of (8): F - Phi Z - K* V - the flywheels' terms, (2), (4), (5). */
REMUS6_CODE
static void remus6_subtract_rates(const remus6_table *table, const remus6_sums *sum, const remus6_real V[6],
                                  remus6_real *restrict F /* [6] */)
{
    /* momentum screw Z = K V + sum I phi' */
    const remus6_real Z1 = table->A[0] * V[0] + table->A[3] * V[1] + table->A[4] * V[2] + table->G[0] * V[3]
        + (table->G[3] + sum->mu[2]) * V[4] + (table->G[6] - sum->mu[1]) * V[5] + sum->mu_dot[0];
    const remus6_real Z2 = table->A[1] * V[1] + table->A[3] * V[0] + table->A[5] * V[2]
        + (table->G[1] - sum->mu[2]) * V[3] + table->G[4] * V[4] + (table->G[7] + sum->mu[0]) * V[5]
        + sum->mu_dot[1];
    const remus6_real Z3 = table->A[2] * V[2] + table->A[4] * V[0] + table->A[5] * V[1]
        + (table->G[2] + sum->mu[1]) * V[3] + (table->G[5] - sum->mu[0]) * V[4] + table->G[8] * V[5]
        + sum->mu_dot[2];
    const remus6_real Z4 = table->G[0] * V[0] + (table->G[1] - sum->mu[2]) * V[1]
        + (table->G[2] + sum->mu[1]) * V[2] + sum->J[0] * V[3] + sum->J[3] * V[4] + sum->J[4] * V[5]
        + sum->h_rel[0];
    const remus6_real Z5 = (table->G[3] + sum->mu[2]) * V[0] + table->G[4] * V[1]
        + (table->G[5] - sum->mu[0]) * V[2] + sum->J[1] * V[4] + sum->J[3] * V[3] + sum->J[5] * V[5]
        + sum->h_rel[1];
    const remus6_real Z6 = (table->G[6] - sum->mu[1]) * V[0] + (table->G[7] + sum->mu[0]) * V[1]
        + table->G[8] * V[2] + sum->J[2] * V[5] + sum->J[4] * V[3] + sum->J[5] * V[4] + sum->h_rel[2];
    F[0] = F[0] + sum->mu_dot[1] * V[5] + V[5] * Z2 - sum->a_rel[0] - sum->mu_dot[2] * V[4] - V[4] * Z3;
    F[1] = F[1] + sum->mu_dot[2] * V[3] + V[3] * Z3 - sum->a_rel[1] - sum->mu_dot[0] * V[5] - V[5] * Z1;
    F[2] = F[2] + sum->mu_dot[0] * V[4] + V[4] * Z1 - sum->a_rel[2] - sum->mu_dot[1] * V[3] - V[3] * Z2;
    F[3] = F[3] + Z5 * V[5] + sum->mu_dot[2] * V[1] + Z2 * V[2] - sum->J_dot[0] * V[3] - sum->J_dot[3] * V[4]
        - sum->J_dot[4] * V[5] - sum->g_rel[0] - Z6 * V[4] - sum->mu_dot[1] * V[2] - Z3 * V[1];
    F[4] = F[4] + Z6 * V[3] + sum->mu_dot[0] * V[2] + Z3 * V[0] - sum->J_dot[1] * V[4] - sum->J_dot[3] * V[3]
        - sum->J_dot[5] * V[5] - sum->g_rel[1] - Z4 * V[5] - sum->mu_dot[2] * V[0] - Z1 * V[2];
    F[5] = F[5] + Z4 * V[4] + sum->mu_dot[1] * V[0] + Z1 * V[1] - sum->J_dot[2] * V[5] - sum->J_dot[4] * V[3]
        - sum->J_dot[5] * V[4] - sum->g_rel[2] - Z5 * V[3] - sum->mu_dot[0] * V[1] - Z2 * V[0];
}

/* Factors a symmetric positive definite 3x3 matrix: S = L D L^T. */
REMUS6_CODE
static remus6_status remus6_factor3(const remus6_real S[6], remus6_factors3 *restrict L)
{
    if (!(S[0] >= 2.2250738585072014e-308)) { return REMUS6_NOT_POSITIVE_DEFINITE; }
    const remus6_real r1 = 1.0 / S[0];
    const remus6_real l21 = S[3] * r1;
    const remus6_real l31 = S[4] * r1;
    const remus6_real d2 = S[1] - l21 * S[3];
    if (!(d2 >= 2.2250738585072014e-308)) { return REMUS6_NOT_POSITIVE_DEFINITE; }
    const remus6_real r2 = 1.0 / d2;
    const remus6_real p32 = S[5] - l31 * S[3];
    const remus6_real l32 = p32 * r2;
    const remus6_real d3 = S[2] - l31 * S[4] - l32 * p32;
    if (!(d3 >= 2.2250738585072014e-308)) { return REMUS6_NOT_POSITIVE_DEFINITE; }
    L->r1 = r1;
    L->r2 = r2;
    L->d3 = d3;
    L->l21 = l21;
    L->l31 = l31;
    L->l32 = l32;
    return REMUS6_OK;
}

/* Solves S y = b by S = L D L^T. */
REMUS6_CODE
static inline void remus6_solve3(const remus6_factors3 *L, const remus6_real b[3],
                                 remus6_real *restrict y /* [3] */)
{
    /* L z = b, then L^T y = D^-1 z */
    const remus6_real z2 = b[1] - L->l21 * b[0];
    const remus6_real y3 = (b[2] - L->l31 * b[0] - L->l32 * z2) / L->d3;
    const remus6_real y2 = z2 * L->r2 - L->l32 * y3;
    y[0] = b[0] * L->r1 - L->l21 * y2 - L->l31 * y3;
    y[1] = y2;  y[2] = y3;
}

/* Factors K: its translational block is constant, so that a 3x3 matrix is left, (8). */
REMUS6_CODE
static remus6_status remus6_factor_carrier(const remus6_table *table, const remus6_sums *sum,
                                           remus6_carrier_factor *restrict K)
{
    remus6_status status;
    remus6_real B[9];  /* <mu> + Lambda_21: lower left block of K */
    B[0] = table->G[0];               B[1] = table->G[1] - sum->mu[2];  B[2] = table->G[2] + sum->mu[1];
    B[3] = table->G[3] + sum->mu[2];  B[4] = table->G[4];               B[5] = table->G[5] - sum->mu[0];
    B[6] = table->G[6] - sum->mu[1];  B[7] = table->G[7] + sum->mu[0];  B[8] = table->G[8];
    K->U[0] = table->A_inv[0] * B[0] + table->A_inv[3] * B[1] + table->A_inv[4] * B[2];
    K->U[1] = table->A_inv[0] * B[3] + table->A_inv[3] * B[4] + table->A_inv[4] * B[5];
    K->U[2] = table->A_inv[0] * B[6] + table->A_inv[3] * B[7] + table->A_inv[4] * B[8];
    K->U[3] = table->A_inv[1] * B[1] + table->A_inv[3] * B[0] + table->A_inv[5] * B[2];
    K->U[4] = table->A_inv[1] * B[4] + table->A_inv[3] * B[3] + table->A_inv[5] * B[5];
    K->U[5] = table->A_inv[1] * B[7] + table->A_inv[3] * B[6] + table->A_inv[5] * B[8];
    K->U[6] = table->A_inv[2] * B[2] + table->A_inv[4] * B[0] + table->A_inv[5] * B[1];
    K->U[7] = table->A_inv[2] * B[5] + table->A_inv[4] * B[3] + table->A_inv[5] * B[4];
    K->U[8] = table->A_inv[2] * B[8] + table->A_inv[4] * B[6] + table->A_inv[5] * B[7];
    remus6_real S[6];  /* J - B A^-1 B^T */
    S[0] = sum->J[0] - B[0] * K->U[0] - B[1] * K->U[3] - B[2] * K->U[6];
    S[1] = sum->J[1] - B[3] * K->U[1] - B[4] * K->U[4] - B[5] * K->U[7];
    S[2] = sum->J[2] - B[6] * K->U[2] - B[7] * K->U[5] - B[8] * K->U[8];
    S[3] = sum->J[3] - B[0] * K->U[1] - B[1] * K->U[4] - B[2] * K->U[7];
    S[4] = sum->J[4] - B[0] * K->U[2] - B[1] * K->U[5] - B[2] * K->U[8];
    S[5] = sum->J[5] - B[3] * K->U[2] - B[4] * K->U[5] - B[5] * K->U[8];
    status = remus6_factor3(S, &K->L);
    if (status != REMUS6_OK) { return status; }
    return REMUS6_OK;
}

/* Solves K y = F by the factors of K, (8). */
REMUS6_CODE
static void remus6_solve_carrier(const remus6_table *table, const remus6_carrier_factor *K,
                                 const remus6_real F[6], remus6_real *restrict y /* [6] */)
{
    remus6_real moment[3];  /* n - B A^-1 f */
    remus6_real omega_dot[3];
    moment[0] = F[3] - K->U[0] * F[0] - K->U[3] * F[1] - K->U[6] * F[2];
    moment[1] = F[4] - K->U[1] * F[0] - K->U[4] * F[1] - K->U[7] * F[2];
    moment[2] = F[5] - K->U[2] * F[0] - K->U[5] * F[1] - K->U[8] * F[2];
    remus6_solve3(&K->L, moment, omega_dot);
    y[0] = table->A_inv[0] * F[0] + table->A_inv[3] * F[1] + table->A_inv[4] * F[2] - K->U[0] * omega_dot[0]
        - K->U[1] * omega_dot[1] - K->U[2] * omega_dot[2];
    y[1] = table->A_inv[1] * F[1] + table->A_inv[3] * F[0] + table->A_inv[5] * F[2] - K->U[3] * omega_dot[0]
        - K->U[4] * omega_dot[1] - K->U[5] * omega_dot[2];
    y[2] = table->A_inv[2] * F[2] + table->A_inv[4] * F[0] + table->A_inv[5] * F[1] - K->U[6] * omega_dot[0]
        - K->U[7] * omega_dot[1] - K->U[8] * omega_dot[2];
    y[3] = omega_dot[0];  y[4] = omega_dot[1];  y[5] = omega_dot[2];
}

/* K V* = F - M V - sum(I phi'' + J phi') from checked inputs; V_dot is written where the status is OK,
 * (8). */
REMUS6_CODE
static remus6_status remus6_accelerate(const remus6_table *table, const remus6_state *x,
                                       const remus6_real sine[REMUS6_N], const remus6_real cosine[REMUS6_N],
                                       const remus6_real phi_ddot[REMUS6_N],
                                       remus6_real *restrict V_dot /* [6] */)
{
    remus6_status status;
    remus6_real C[9];  /* attitude */
    remus6_rotation(x->attitude, C);
    remus6_real u[3];  /* stream in E1 */
    remus6_rotate_back(C, table->stream, u);
    remus6_real V[6];  /* V relative to the stream: the fluid's frame is inertial as well */
    V[0] = x->V[0] - u[0];  V[1] = x->V[1] - u[1];  V[2] = x->V[2] - u[2];
    V[3] = x->V[3];         V[4] = x->V[4];         V[5] = x->V[5];
    remus6_real g[3];  /* gravity in E1 */
    remus6_rotate_back(C, table->gravity, g);
    remus6_sums sum;
    remus6_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    remus6_sum_spin(table, sine, cosine, x->phi_dot, phi_ddot, &sum);
    remus6_real F[6];  /* wrench (7); then the right-hand side of (8) */
    remus6_carrier_factor K;
    remus6_external(table, &sum, V, g, F);
    remus6_subtract_rates(table, &sum, V, F);
    status = remus6_factor_carrier(table, &sum, &K);
    if (status != REMUS6_OK) { return status; }
    remus6_solve_carrier(table, &K, F, V_dot);
    /* V* = V_r* - (omega x C^T u, 0) */
    remus6_real drift[3];  /* omega x C^T u */
    drift[0] = u[2] * x->V[4] - u[1] * x->V[5];
    drift[1] = u[0] * x->V[5] - u[2] * x->V[3];
    drift[2] = u[1] * x->V[3] - u[0] * x->V[4];
    V_dot[0] = V_dot[0] - drift[0];  V_dot[1] = V_dot[1] - drift[1];  V_dot[2] = V_dot[2] - drift[2];
    return REMUS6_OK;
}

/* (8) */
REMUS6_CODE
remus6_status remus6_forward(const remus6_table *table, const remus6_state *x,
                             const remus6_real phi_ddot[REMUS6_N], remus6_real V_dot[6])
{
    if (table == NULL || x == NULL || phi_ddot == NULL || V_dot == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(phi_ddot, REMUS6_N, REMUS6_MAX_ACCELERATION);
    if (status != REMUS6_OK) { return status; }
    remus6_real result[6];
    remus6_real sine[REMUS6_N];
    remus6_real cosine[REMUS6_N];
    remus6_sincos_each(x->phi, sine, cosine);
    status = remus6_accelerate(table, x, sine, cosine, phi_ddot, result);
    if (status != REMUS6_OK) { return status; }
    V_dot[0] = result[0];  V_dot[1] = result[1];  V_dot[2] = result[2];
    V_dot[3] = result[3];  V_dot[4] = result[4];  V_dot[5] = result[5];
    return REMUS6_OK;
}

/* M = Phi K + K*, (9). */
REMUS6_CODE
static void remus6_velocity_matrix(const remus6_real V[6], remus6_matrices_result *restrict out)
{
    for (int j = 0; j < 6; ++j) {  /* Phi acts on each column */
        out->M[0][j] = out->K[2][j] * V[4] - out->K[1][j] * V[5] + out->K_dot[0][j];
        out->M[1][j] = out->K[0][j] * V[5] - out->K[2][j] * V[3] + out->K_dot[1][j];
        out->M[2][j] = out->K[1][j] * V[3] - out->K[0][j] * V[4] + out->K_dot[2][j];
        out->M[3][j] = out->K[2][j] * V[1] + out->K[5][j] * V[4] - out->K[1][j] * V[2] - out->K[4][j] * V[5]
            + out->K_dot[3][j];
        out->M[4][j] = out->K[0][j] * V[2] + out->K[3][j] * V[5] - out->K[2][j] * V[0] - out->K[5][j] * V[3]
            + out->K_dot[4][j];
        out->M[5][j] = out->K[1][j] * V[0] + out->K[4][j] * V[3] - out->K[0][j] * V[1] - out->K[3][j] * V[4]
            + out->K_dot[5][j];
    }
}

/* (2), (6)-(9) */
REMUS6_CODE
remus6_status remus6_matrices(const remus6_table *table, const remus6_state *x, remus6_matrices_result *out)
{
    if (table == NULL || x == NULL || out == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    remus6_real C[9];  /* attitude */
    remus6_rotation(x->attitude, C);
    remus6_real u[3];  /* stream in E1 */
    remus6_rotate_back(C, table->stream, u);
    remus6_real V[6];  /* V relative to the stream: the fluid's frame is inertial as well */
    V[0] = x->V[0] - u[0];  V[1] = x->V[1] - u[1];  V[2] = x->V[2] - u[2];
    V[3] = x->V[3];         V[4] = x->V[4];         V[5] = x->V[5];
    remus6_real g[3];  /* gravity in E1 */
    remus6_rotate_back(C, table->gravity, g);
    remus6_sums sum;
    remus6_real sine[REMUS6_N];
    remus6_real cosine[REMUS6_N];
    remus6_sincos_each(x->phi, sine, cosine);
    remus6_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    remus6_real F[6];
    remus6_external(table, &sum, V, g, F);
    out->F[0] = F[0];  out->F[1] = F[1];  out->F[2] = F[2];
    out->F[3] = F[3];  out->F[4] = F[4];  out->F[5] = F[5];
    /* K (2) and its rate (6) */
    out->K[0][0] = table->A[0];  out->K[0][1] = table->A[3];  out->K[0][2] = table->A[4];
    out->K[0][3] = table->G[0];
    out->K[0][4] = table->G[3] + sum.mu[2];
    out->K[0][5] = table->G[6] - sum.mu[1];
    out->K[1][0] = table->A[3];  out->K[1][1] = table->A[1];  out->K[1][2] = table->A[5];
    out->K[1][3] = table->G[1] - sum.mu[2];
    out->K[1][4] = table->G[4];
    out->K[1][5] = table->G[7] + sum.mu[0];
    out->K[2][0] = table->A[4];  out->K[2][1] = table->A[5];  out->K[2][2] = table->A[2];
    out->K[2][3] = table->G[2] + sum.mu[1];
    out->K[2][4] = table->G[5] - sum.mu[0];
    out->K[2][5] = table->G[8];
    out->K[3][0] = table->G[0];
    out->K[3][1] = table->G[1] - sum.mu[2];
    out->K[3][2] = table->G[2] + sum.mu[1];
    out->K[3][3] = sum.J[0];  out->K[3][4] = sum.J[3];  out->K[3][5] = sum.J[4];
    out->K[4][0] = table->G[3] + sum.mu[2];
    out->K[4][1] = table->G[4];
    out->K[4][2] = table->G[5] - sum.mu[0];
    out->K[4][3] = sum.J[3];  out->K[4][4] = sum.J[1];  out->K[4][5] = sum.J[5];
    out->K[5][0] = table->G[6] - sum.mu[1];
    out->K[5][1] = table->G[7] + sum.mu[0];
    out->K[5][2] = table->G[8];  out->K[5][3] = sum.J[4];     out->K[5][4] = sum.J[5];
    out->K[5][5] = sum.J[2];
    out->K_dot[0][0] = 0.0;             out->K_dot[0][1] = 0.0;             out->K_dot[0][2] = 0.0;
    out->K_dot[0][3] = 0.0;             out->K_dot[0][4] = sum.mu_dot[2];   out->K_dot[0][5] = -sum.mu_dot[1];
    out->K_dot[1][0] = 0.0;             out->K_dot[1][1] = 0.0;             out->K_dot[1][2] = 0.0;
    out->K_dot[1][3] = -sum.mu_dot[2];  out->K_dot[1][4] = 0.0;             out->K_dot[1][5] = sum.mu_dot[0];
    out->K_dot[2][0] = 0.0;             out->K_dot[2][1] = 0.0;             out->K_dot[2][2] = 0.0;
    out->K_dot[2][3] = sum.mu_dot[1];   out->K_dot[2][4] = -sum.mu_dot[0];  out->K_dot[2][5] = 0.0;
    out->K_dot[3][0] = 0.0;             out->K_dot[3][1] = -sum.mu_dot[2];  out->K_dot[3][2] = sum.mu_dot[1];
    out->K_dot[3][3] = sum.J_dot[0];    out->K_dot[3][4] = sum.J_dot[3];    out->K_dot[3][5] = sum.J_dot[4];
    out->K_dot[4][0] = sum.mu_dot[2];   out->K_dot[4][1] = 0.0;             out->K_dot[4][2] = -sum.mu_dot[0];
    out->K_dot[4][3] = sum.J_dot[3];    out->K_dot[4][4] = sum.J_dot[1];    out->K_dot[4][5] = sum.J_dot[5];
    out->K_dot[5][0] = -sum.mu_dot[1];  out->K_dot[5][1] = sum.mu_dot[0];   out->K_dot[5][2] = 0.0;
    out->K_dot[5][3] = sum.J_dot[4];    out->K_dot[5][4] = sum.J_dot[5];    out->K_dot[5][5] = sum.J_dot[2];
    remus6_velocity_matrix(V, out);
    remus6_real column[6];  /* I_s */
    remus6_real rate[6];  /* dI_s / dphi */
    for (int s = 0; s < REMUS6_N; ++s) {
        const remus6_real s_phi = sine[s];
        const remus6_real c_phi = cosine[s];
        column[0] = table->flywheel[s].mu_s[0] * c_phi - table->flywheel[s].mu_c[0] * s_phi;
        column[1] = table->flywheel[s].mu_s[1] * c_phi - table->flywheel[s].mu_c[1] * s_phi;
        column[2] = table->flywheel[s].mu_s[2] * c_phi - table->flywheel[s].mu_c[2] * s_phi;
        column[3] = table->flywheel[s].t_c[0] * c_phi + table->flywheel[s].t_s[0] * s_phi
            + table->flywheel[s].t_0[0];
        column[4] = table->flywheel[s].t_c[1] * c_phi + table->flywheel[s].t_s[1] * s_phi
            + table->flywheel[s].t_0[1];
        column[5] = table->flywheel[s].t_c[2] * c_phi + table->flywheel[s].t_s[2] * s_phi
            + table->flywheel[s].t_0[2];
        rate[0] = -table->flywheel[s].mu_c[0] * c_phi - table->flywheel[s].mu_s[0] * s_phi;
        rate[1] = -table->flywheel[s].mu_c[1] * c_phi - table->flywheel[s].mu_s[1] * s_phi;
        rate[2] = -table->flywheel[s].mu_c[2] * c_phi - table->flywheel[s].mu_s[2] * s_phi;
        rate[3] = table->flywheel[s].t_s[0] * c_phi - table->flywheel[s].t_c[0] * s_phi;
        rate[4] = table->flywheel[s].t_s[1] * c_phi - table->flywheel[s].t_c[1] * s_phi;
        rate[5] = table->flywheel[s].t_s[2] * c_phi - table->flywheel[s].t_c[2] * s_phi;
        out->I_[0][s] = column[0];
        out->J[0][s] = column[2] * V[4] - column[1] * V[5] + rate[0] * x->phi_dot[s];
        out->I_[1][s] = column[1];
        out->J[1][s] = column[0] * V[5] - column[2] * V[3] + rate[1] * x->phi_dot[s];
        out->I_[2][s] = column[2];
        out->J[2][s] = column[1] * V[3] - column[0] * V[4] + rate[2] * x->phi_dot[s];
        out->I_[3][s] = column[3];
        out->J[3][s] = column[2] * V[1] + column[5] * V[4] - column[1] * V[2] - column[4] * V[5]
            + rate[3] * x->phi_dot[s];
        out->I_[4][s] = column[4];
        out->J[4][s] = column[0] * V[2] + column[3] * V[5] - column[2] * V[0] - column[5] * V[3]
            + rate[4] * x->phi_dot[s];
        out->I_[5][s] = column[5];
        out->J[5][s] = column[1] * V[0] + column[4] * V[3] - column[0] * V[1] - column[3] * V[4]
            + rate[5] * x->phi_dot[s];
    }
    return REMUS6_OK;
}

/* (1), (2) */
REMUS6_CODE
remus6_status remus6_momentum(const remus6_table *table, const remus6_state *x, remus6_momentum_result *out)
{
    if (table == NULL || x == NULL || out == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    remus6_real C[9];  /* attitude */
    remus6_rotation(x->attitude, C);
    remus6_real u[3];  /* stream in E1 */
    remus6_rotate_back(C, table->stream, u);
    remus6_real V[6];  /* V relative to the stream: the fluid's frame is inertial as well */
    V[0] = x->V[0] - u[0];  V[1] = x->V[1] - u[1];  V[2] = x->V[2] - u[2];
    V[3] = x->V[3];         V[4] = x->V[4];         V[5] = x->V[5];
    remus6_sums sum;
    remus6_real sine[REMUS6_N];
    remus6_real cosine[REMUS6_N];
    remus6_sincos_each(x->phi, sine, cosine);
    remus6_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    remus6_sum_steady_spin(table, sine, cosine, x->phi_dot, &sum);
    remus6_real Z[6];  /* momentum screw (2) */
    remus6_momentum_screw(table, &sum, V, Z);
    remus6_real spin = 0.0;  /* sum phi' (I^T V + Theta_ff phi') */
    for (int s = 0; s < REMUS6_N; ++s) {
        const remus6_real s_phi = sine[s];
        const remus6_real c_phi = cosine[s];
        /* I_s . V */
        const remus6_real along = (table->flywheel[s].mu_s[0] * c_phi - table->flywheel[s].mu_c[0] * s_phi)
            * V[0] + (table->flywheel[s].mu_s[1] * c_phi - table->flywheel[s].mu_c[1] * s_phi) * V[1]
            + (table->flywheel[s].mu_s[2] * c_phi - table->flywheel[s].mu_c[2] * s_phi) * V[2]
            + (table->flywheel[s].t_c[0] * c_phi + table->flywheel[s].t_s[0] * s_phi
            + table->flywheel[s].t_0[0]) * V[3]
            + (table->flywheel[s].t_c[1] * c_phi + table->flywheel[s].t_s[1] * s_phi
            + table->flywheel[s].t_0[1]) * V[4]
            + (table->flywheel[s].t_c[2] * c_phi + table->flywheel[s].t_s[2] * s_phi
            + table->flywheel[s].t_0[2]) * V[5];
        spin += x->phi_dot[s] * (along + table->flywheel[s].spin * x->phi_dot[s]);
    }
    remus6_real energy = 0.5 * Z[3] * V[3] + 0.5 * Z[4] * V[4] + 0.5 * Z[5] * V[5] + 0.5 * Z[0] * V[0]
        + 0.5 * Z[1] * V[1] + 0.5 * Z[2] * V[2] + 0.5 * spin;
    /* bodies at V, added mass at V relative to the stream */
    remus6_real p[3];  /* momentum of the bodies relative to the stream */
    p[0] = table->mass * V[0] + sum.mu[2] * V[4] + sum.mu_dot[0] - sum.mu[1] * V[5];
    p[1] = table->mass * V[1] + sum.mu[0] * V[5] + sum.mu_dot[1] - sum.mu[2] * V[3];
    p[2] = table->mass * V[2] + sum.mu[1] * V[3] + sum.mu_dot[2] - sum.mu[0] * V[4];
    energy += p[0] * u[0] + p[1] * u[1] + p[2] * u[2]
        + 0.5 * table->mass * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    Z[0] += table->mass * u[0];  Z[1] += table->mass * u[1];  Z[2] += table->mass * u[2];
    Z[3] += sum.mu[1] * u[2] - sum.mu[2] * u[1];
    Z[4] += sum.mu[2] * u[0] - sum.mu[0] * u[2];
    Z[5] += sum.mu[0] * u[1] - sum.mu[1] * u[0];
    out->Z[0] = Z[0];  out->Z[1] = Z[1];  out->Z[2] = Z[2];
    out->Z[3] = Z[3];  out->Z[4] = Z[4];  out->Z[5] = Z[5];
    /* Z0 = L1 Z of (1) */
    out->Z0[0] = C[0] * Z[0] + C[1] * Z[1] + C[2] * Z[2];
    out->Z0[1] = C[3] * Z[0] + C[4] * Z[1] + C[5] * Z[2];
    out->Z0[2] = C[6] * Z[0] + C[7] * Z[1] + C[8] * Z[2];
    out->Z0[3] = C[0] * Z[3] + C[1] * Z[4] + C[2] * Z[5] + out->Z0[2] * x->position[1]
        - out->Z0[1] * x->position[2];
    out->Z0[4] = C[3] * Z[3] + C[4] * Z[4] + C[5] * Z[5] + out->Z0[0] * x->position[2]
        - out->Z0[2] * x->position[0];
    out->Z0[5] = C[6] * Z[3] + C[7] * Z[4] + C[8] * Z[5] + out->Z0[1] * x->position[0]
        - out->Z0[0] * x->position[1];
    out->energy = energy;
    out->center_of_mass[0] = sum.mu[0] * table->mass_inverse;
    out->center_of_mass[1] = sum.mu[1] * table->mass_inverse;
    out->center_of_mass[2] = sum.mu[2] * table->mass_inverse;
    remus6_real v[3];  /* of the mass centre in E1, from the momentum of the bodies, without the fluid's */
    v[0] = table->mass * x->V[0] + sum.mu[2] * x->V[4] + sum.mu_dot[0] - sum.mu[1] * x->V[5];
    v[1] = table->mass * x->V[1] + sum.mu[0] * x->V[5] + sum.mu_dot[1] - sum.mu[2] * x->V[3];
    v[2] = table->mass * x->V[2] + sum.mu[1] * x->V[3] + sum.mu_dot[2] - sum.mu[0] * x->V[4];
    v[0] = v[0] * table->mass_inverse;  v[1] = v[1] * table->mass_inverse;  v[2] = v[2] * table->mass_inverse;
    out->center_of_mass_velocity[0] = C[0] * v[0] + C[1] * v[1] + C[2] * v[2];
    out->center_of_mass_velocity[1] = C[3] * v[0] + C[4] * v[1] + C[5] * v[2];
    out->center_of_mass_velocity[2] = C[6] * v[0] + C[7] * v[1] + C[8] * v[2];
    return REMUS6_OK;
}

/* Column of I of one flywheel, and its drive torque at V* = 0, phi'' = 0, (9). */
REMUS6_CODE
static REMUS6_COPIED void remus6_couple(const remus6_row *row, remus6_real s, remus6_real c,
                                        const remus6_real origin_acceleration[3], const remus6_real spun[6],
                                        remus6_coupling *restrict out)
{
    const remus6_real two_c2 = 2.0 - 4.0 * (s * s);  /* twice the cosine and sine of the double phase */
    const remus6_real two_s2 = 4.0 * c * s;
    out->I_[0] = row->mu_s[0] * c - row->mu_c[0] * s;
    out->I_[1] = row->mu_s[1] * c - row->mu_c[1] * s;
    out->I_[2] = row->mu_s[2] * c - row->mu_c[2] * s;
    out->I_[3] = row->t_c[0] * c + row->t_s[0] * s + row->t_0[0];
    out->I_[4] = row->t_c[1] * c + row->t_s[1] * s + row->t_0[1];
    out->I_[5] = row->t_c[2] * c + row->t_s[2] * s + row->t_0[2];
    /* dJ / dphi */
    const remus6_real J_p1 = row->J_2s[0] * two_c2 + row->J_s[0] * c - row->J_2c[0] * two_s2
        - row->J_c[0] * s;
    const remus6_real J_p2 = row->J_2s[1] * two_c2 + row->J_s[1] * c - row->J_2c[1] * two_s2
        - row->J_c[1] * s;
    const remus6_real J_p3 = row->J_2s[2] * two_c2 + row->J_s[2] * c - row->J_2c[2] * two_s2
        - row->J_c[2] * s;
    const remus6_real J_p4 = row->J_2s[3] * two_c2 + row->J_s[3] * c - row->J_2c[3] * two_s2
        - row->J_c[3] * s;
    const remus6_real J_p5 = row->J_2s[4] * two_c2 + row->J_s[4] * c - row->J_2c[4] * two_s2
        - row->J_c[4] * s;
    const remus6_real J_p6 = row->J_2s[5] * two_c2 + row->J_s[5] * c - row->J_2c[5] * two_s2
        - row->J_c[5] * s;
    out->bias = J_p1 * spun[0] + J_p2 * spun[1] + J_p3 * spun[2] + J_p4 * spun[3] + J_p5 * spun[4]
        + J_p6 * spun[5] + out->I_[0] * origin_acceleration[0] + out->I_[1] * origin_acceleration[1]
        + out->I_[2] * origin_acceleration[2];
}

/* Eliminates one free flywheel: K - I I^T / Theta_ff, F - I rate. */
REMUS6_CODE
static void remus6_eliminate(const remus6_real column[6], remus6_real spin_inv, remus6_real rate,
                             remus6_schur *restrict K, remus6_real *restrict F /* [6] */)
{
    remus6_real scaled[6];  /* I / Theta_ff */
    scaled[0] = column[0] * spin_inv;  scaled[1] = column[1] * spin_inv;  scaled[2] = column[2] * spin_inv;
    scaled[3] = column[3] * spin_inv;  scaled[4] = column[4] * spin_inv;  scaled[5] = column[5] * spin_inv;
    K->A[0] -= column[0] * scaled[0];  K->A[1] -= column[1] * scaled[1];  K->A[2] -= column[2] * scaled[2];
    K->A[3] -= column[0] * scaled[1];  K->A[4] -= column[0] * scaled[2];  K->A[5] -= column[1] * scaled[2];
    K->B[0] -= column[3] * scaled[0];  K->B[1] -= column[3] * scaled[1];  K->B[2] -= column[3] * scaled[2];
    K->B[3] -= column[4] * scaled[0];  K->B[4] -= column[4] * scaled[1];  K->B[5] -= column[4] * scaled[2];
    K->B[6] -= column[5] * scaled[0];  K->B[7] -= column[5] * scaled[1];  K->B[8] -= column[5] * scaled[2];
    K->D[0] -= column[3] * scaled[3];  K->D[1] -= column[4] * scaled[4];  K->D[2] -= column[5] * scaled[5];
    K->D[3] -= column[3] * scaled[4];  K->D[4] -= column[3] * scaled[5];  K->D[5] -= column[4] * scaled[5];
    F[0] -= column[0] * rate;  F[1] -= column[1] * rate;  F[2] -= column[2] * rate;
    F[3] -= column[3] * rate;  F[4] -= column[4] * rate;  F[5] -= column[5] * rate;
}

/* Drive torques for a given motion, from checked inputs. */
REMUS6_CODE
static void remus6_balance(const remus6_table *table, const remus6_state *x,
                           const remus6_real sine[REMUS6_N], const remus6_real cosine[REMUS6_N],
                           const remus6_real V_dot[6], const remus6_real phi_ddot[REMUS6_N],
                           remus6_real *restrict tau /* [REMUS6_N] */)
{
    remus6_real C[9];  /* attitude */
    remus6_rotation(x->attitude, C);
    remus6_real u[3];  /* stream in E1 */
    remus6_rotate_back(C, table->stream, u);
    remus6_real V[6];  /* V relative to the stream: the fluid's frame is inertial as well */
    V[0] = x->V[0] - u[0];  V[1] = x->V[1] - u[1];  V[2] = x->V[2] - u[2];
    V[3] = x->V[3];         V[4] = x->V[4];         V[5] = x->V[5];
    remus6_real g[3];  /* gravity in E1 */
    remus6_rotate_back(C, table->gravity, g);
    remus6_real drift[3];  /* omega x C^T u */
    drift[0] = u[2] * x->V[4] - u[1] * x->V[5];
    drift[1] = u[0] * x->V[5] - u[2] * x->V[3];
    drift[2] = u[1] * x->V[3] - u[0] * x->V[4];
    remus6_real V_r_dot[6];  /* V_r* = V* + (omega x C^T u, 0) */
    V_r_dot[0] = V_dot[0] + drift[0];  V_r_dot[1] = V_dot[1] + drift[1];  V_r_dot[2] = V_dot[2] + drift[2];
    V_r_dot[3] = V_dot[3];             V_r_dot[4] = V_dot[4];             V_r_dot[5] = V_dot[5];
    remus6_real origin_acceleration[3];  /* acceleration of O1 at V* = 0, minus gravity */
    origin_acceleration[0] = V[4] * V[2] - g[0] - V[5] * V[1];
    origin_acceleration[1] = V[5] * V[0] - g[1] - V[3] * V[2];
    origin_acceleration[2] = V[3] * V[1] - g[2] - V[4] * V[0];
    remus6_real spun[6];  /* six numbers: J . spun = -omega . J omega / 2 for every inertia J */
    spun[0] = -0.5 * (V[3] * V[3]);  spun[1] = -0.5 * (V[4] * V[4]);  spun[2] = -0.5 * (V[5] * V[5]);
    spun[3] = -V[3] * V[4];          spun[4] = -V[3] * V[5];          spun[5] = -V[4] * V[5];
    remus6_coupling drive;
    for (int s = 0; s < REMUS6_N; ++s) {
        remus6_couple(&table->flywheel[s], sine[s], cosine[s], origin_acceleration, spun, &drive);
        tau[s] = V_r_dot[0] * drive.I_[0] + V_r_dot[1] * drive.I_[1] + V_r_dot[2] * drive.I_[2]
            + V_r_dot[3] * drive.I_[3] + V_r_dot[4] * drive.I_[4] + V_r_dot[5] * drive.I_[5]
            + table->flywheel[s].spin * phi_ddot[s] + drive.bias;
    }
}

/* Drive torques for a given motion: tau = f^T (Theta V_s* + Phi(V_s) Z_s - P_s). */
REMUS6_CODE
remus6_status remus6_torque(const remus6_table *table, const remus6_state *x, const remus6_real V_dot[6],
                            const remus6_real phi_ddot[REMUS6_N], remus6_real tau[REMUS6_N])
{
    if (table == NULL || x == NULL || V_dot == NULL || phi_ddot == NULL
        || tau == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(phi_ddot, REMUS6_N, REMUS6_MAX_ACCELERATION);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(V_dot, 6, REMUS6_MAX_ACCELERATION);
    if (status != REMUS6_OK) { return status; }
    remus6_real C[9];  /* attitude */
    remus6_rotation(x->attitude, C);
    remus6_real u[3];  /* stream in E1 */
    remus6_rotate_back(C, table->stream, u);
    remus6_real V[6];  /* V relative to the stream: the fluid's frame is inertial as well */
    V[0] = x->V[0] - u[0];  V[1] = x->V[1] - u[1];  V[2] = x->V[2] - u[2];
    V[3] = x->V[3];         V[4] = x->V[4];         V[5] = x->V[5];
    remus6_real g[3];  /* gravity in E1 */
    remus6_rotate_back(C, table->gravity, g);
    remus6_real sine[REMUS6_N];
    remus6_real cosine[REMUS6_N];
    remus6_sincos_each(x->phi, sine, cosine);
    remus6_real drift[3];  /* omega x C^T u */
    drift[0] = u[2] * x->V[4] - u[1] * x->V[5];
    drift[1] = u[0] * x->V[5] - u[2] * x->V[3];
    drift[2] = u[1] * x->V[3] - u[0] * x->V[4];
    remus6_real V_r_dot[6];  /* V_r* = V* + (omega x C^T u, 0) */
    V_r_dot[0] = V_dot[0] + drift[0];  V_r_dot[1] = V_dot[1] + drift[1];  V_r_dot[2] = V_dot[2] + drift[2];
    V_r_dot[3] = V_dot[3];             V_r_dot[4] = V_dot[4];             V_r_dot[5] = V_dot[5];
    remus6_real origin_acceleration[3];  /* acceleration of O1 at V* = 0, minus gravity */
    origin_acceleration[0] = V[4] * V[2] - g[0] - V[5] * V[1];
    origin_acceleration[1] = V[5] * V[0] - g[1] - V[3] * V[2];
    origin_acceleration[2] = V[3] * V[1] - g[2] - V[4] * V[0];
    remus6_real spun[6];  /* six numbers: J . spun = -omega . J omega / 2 for every inertia J */
    spun[0] = -0.5 * (V[3] * V[3]);  spun[1] = -0.5 * (V[4] * V[4]);  spun[2] = -0.5 * (V[5] * V[5]);
    spun[3] = -V[3] * V[4];          spun[4] = -V[3] * V[5];          spun[5] = -V[4] * V[5];
    remus6_coupling drive;
    for (int s = 0; s < REMUS6_N; ++s) {
        remus6_couple(&table->flywheel[s], sine[s], cosine[s], origin_acceleration, spun, &drive);
        tau[s] = V_r_dot[0] * drive.I_[0] + V_r_dot[1] * drive.I_[1] + V_r_dot[2] * drive.I_[2]
            + V_r_dot[3] * drive.I_[3] + V_r_dot[4] * drive.I_[4] + V_r_dot[5] * drive.I_[5]
            + table->flywheel[s].spin * phi_ddot[s] + drive.bias;
    }
    return REMUS6_OK;
}

/* Factors [A B^T; B D], symmetric positive definite, by blocks of 3x3. */
REMUS6_CODE
static remus6_status remus6_factor_schur(const remus6_schur *K, remus6_schur_factor *restrict factor)
{
    remus6_status status;
    const remus6_real c11 = K->A[1] * K->A[2] - K->A[5] * K->A[5];
    const remus6_real c22 = K->A[0] * K->A[2] - K->A[4] * K->A[4];
    const remus6_real c33 = K->A[0] * K->A[1] - K->A[3] * K->A[3];
    const remus6_real c12 = K->A[4] * K->A[5] - K->A[2] * K->A[3];
    const remus6_real c13 = K->A[3] * K->A[5] - K->A[1] * K->A[4];
    const remus6_real c23 = K->A[3] * K->A[4] - K->A[0] * K->A[5];
    const remus6_real det = K->A[0] * c11 + K->A[3] * c12 + K->A[4] * c13;
    if (!(K->A[0] > 0.0 && c33 > 0.0 && (det >= 2.2250738585072014e-308
        && det <= REMUS6_LARGEST))) { return REMUS6_NOT_POSITIVE_DEFINITE; }
    const remus6_real r = 1.0 / det;
    factor->A_inv[0] = c11 * r;  factor->A_inv[1] = c22 * r;  factor->A_inv[2] = c33 * r;
    factor->A_inv[3] = c12 * r;  factor->A_inv[4] = c13 * r;  factor->A_inv[5] = c23 * r;
    remus6_real S[6];  /* D - B A^-1 B^T */
    factor->U[0] = factor->A_inv[0] * K->B[0] + factor->A_inv[3] * K->B[1] + factor->A_inv[4] * K->B[2];
    factor->U[1] = factor->A_inv[0] * K->B[3] + factor->A_inv[3] * K->B[4] + factor->A_inv[4] * K->B[5];
    factor->U[2] = factor->A_inv[0] * K->B[6] + factor->A_inv[3] * K->B[7] + factor->A_inv[4] * K->B[8];
    factor->U[3] = factor->A_inv[1] * K->B[1] + factor->A_inv[3] * K->B[0] + factor->A_inv[5] * K->B[2];
    factor->U[4] = factor->A_inv[1] * K->B[4] + factor->A_inv[3] * K->B[3] + factor->A_inv[5] * K->B[5];
    factor->U[5] = factor->A_inv[1] * K->B[7] + factor->A_inv[3] * K->B[6] + factor->A_inv[5] * K->B[8];
    factor->U[6] = factor->A_inv[2] * K->B[2] + factor->A_inv[4] * K->B[0] + factor->A_inv[5] * K->B[1];
    factor->U[7] = factor->A_inv[2] * K->B[5] + factor->A_inv[4] * K->B[3] + factor->A_inv[5] * K->B[4];
    factor->U[8] = factor->A_inv[2] * K->B[8] + factor->A_inv[4] * K->B[6] + factor->A_inv[5] * K->B[7];
    S[0] = K->D[0] - K->B[0] * factor->U[0] - K->B[1] * factor->U[3] - K->B[2] * factor->U[6];
    S[1] = K->D[1] - K->B[3] * factor->U[1] - K->B[4] * factor->U[4] - K->B[5] * factor->U[7];
    S[2] = K->D[2] - K->B[6] * factor->U[2] - K->B[7] * factor->U[5] - K->B[8] * factor->U[8];
    S[3] = K->D[3] - K->B[0] * factor->U[1] - K->B[1] * factor->U[4] - K->B[2] * factor->U[7];
    S[4] = K->D[4] - K->B[0] * factor->U[2] - K->B[1] * factor->U[5] - K->B[2] * factor->U[8];
    S[5] = K->D[5] - K->B[3] * factor->U[2] - K->B[4] * factor->U[5] - K->B[5] * factor->U[8];
    status = remus6_factor3(S, &factor->L);
    if (status != REMUS6_OK) { return status; }
    return REMUS6_OK;
}

/* Solves [A B^T; B D] y = F by the factors. */
REMUS6_CODE
static void remus6_solve_schur(const remus6_schur_factor *factor, const remus6_real F[6],
                               remus6_real *restrict y /* [6] */)
{
    remus6_real moment[3];  /* n - B A^-1 f */
    remus6_real omega_dot[3];
    moment[0] = F[3] - factor->U[0] * F[0] - factor->U[3] * F[1] - factor->U[6] * F[2];
    moment[1] = F[4] - factor->U[1] * F[0] - factor->U[4] * F[1] - factor->U[7] * F[2];
    moment[2] = F[5] - factor->U[2] * F[0] - factor->U[5] * F[1] - factor->U[8] * F[2];
    remus6_solve3(&factor->L, moment, omega_dot);
    y[0] = factor->A_inv[0] * F[0] + factor->A_inv[3] * F[1] + factor->A_inv[4] * F[2]
        - factor->U[0] * omega_dot[0] - factor->U[1] * omega_dot[1] - factor->U[2] * omega_dot[2];
    y[1] = factor->A_inv[1] * F[1] + factor->A_inv[3] * F[0] + factor->A_inv[5] * F[2]
        - factor->U[3] * omega_dot[0] - factor->U[4] * omega_dot[1] - factor->U[5] * omega_dot[2];
    y[2] = factor->A_inv[2] * F[2] + factor->A_inv[4] * F[0] + factor->A_inv[5] * F[1]
        - factor->U[6] * omega_dot[0] - factor->U[7] * omega_dot[1] - factor->U[8] * omega_dot[2];
    y[3] = omega_dot[0];  y[4] = omega_dot[1];  y[5] = omega_dot[2];
}

/* V* and phi'' for given drive torques, from checked inputs; results are written where the status is OK. */
REMUS6_CODE
static remus6_status remus6_solve_coupled(const remus6_table *table, const remus6_state *x,
                                          const remus6_real sine[REMUS6_N],
                                          const remus6_real cosine[REMUS6_N],
                                          const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                                          remus6_real *restrict V_dot /* [6] */,
                                          remus6_real *restrict phi_ddot /* [REMUS6_N] */)
{
    remus6_status status;
    remus6_real C[9];  /* attitude */
    remus6_rotation(x->attitude, C);
    remus6_real u[3];  /* stream in E1 */
    remus6_rotate_back(C, table->stream, u);
    remus6_real V[6];  /* V relative to the stream: the fluid's frame is inertial as well */
    V[0] = x->V[0] - u[0];  V[1] = x->V[1] - u[1];  V[2] = x->V[2] - u[2];
    V[3] = x->V[3];         V[4] = x->V[4];         V[5] = x->V[5];
    remus6_real g[3];  /* gravity in E1 */
    remus6_rotate_back(C, table->gravity, g);
    remus6_sums sum;
    remus6_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    remus6_sum_steady_spin(table, sine, cosine, x->phi_dot, &sum);
    remus6_real F[6];  /* wrench (7); then the right-hand side of K V* + I phi'' = F */
    remus6_external(table, &sum, V, g, F);
    remus6_subtract_rates(table, &sum, V, F);
    remus6_schur K;  /* mass matrix with free flywheels eliminated */
    K.A[0] = table->A[0];  K.A[1] = table->A[1];  K.A[2] = table->A[2];
    K.A[3] = table->A[3];  K.A[4] = table->A[4];  K.A[5] = table->A[5];
    K.B[0] = table->G[0];              K.B[1] = table->G[1] - sum.mu[2];  K.B[2] = table->G[2] + sum.mu[1];
    K.B[3] = table->G[3] + sum.mu[2];  K.B[4] = table->G[4];              K.B[5] = table->G[5] - sum.mu[0];
    K.B[6] = table->G[6] - sum.mu[1];  K.B[7] = table->G[7] + sum.mu[0];  K.B[8] = table->G[8];
    K.D[0] = sum.J[0];  K.D[1] = sum.J[1];  K.D[2] = sum.J[2];
    K.D[3] = sum.J[3];  K.D[4] = sum.J[4];  K.D[5] = sum.J[5];
    remus6_coupling drive[REMUS6_N];
    remus6_real origin_acceleration[3];  /* acceleration of O1 at V* = 0, minus gravity */
    origin_acceleration[0] = V[4] * V[2] - g[0] - V[5] * V[1];
    origin_acceleration[1] = V[5] * V[0] - g[1] - V[3] * V[2];
    origin_acceleration[2] = V[3] * V[1] - g[2] - V[4] * V[0];
    remus6_real spun[6];  /* six numbers: J . spun = -omega . J omega / 2 for every inertia J */
    spun[0] = -0.5 * (V[3] * V[3]);  spun[1] = -0.5 * (V[4] * V[4]);  spun[2] = -0.5 * (V[5] * V[5]);
    spun[3] = -V[3] * V[4];          spun[4] = -V[3] * V[5];          spun[5] = -V[4] * V[5];
    remus6_real rate[REMUS6_N];  /* accelerations at V* = 0 */
    for (int s = 0; s < REMUS6_N; ++s) {
        if (locked[s] == 0) {
            remus6_couple(&table->flywheel[s], sine[s], cosine[s], origin_acceleration, spun, &drive[s]);
            rate[s] = (tau[s] - drive[s].bias) * table->flywheel[s].spin_inv;
            remus6_eliminate(drive[s].I_, table->flywheel[s].spin_inv, rate[s], &K, F);
        } else {
            drive[s].I_[0] = 0.0;  drive[s].I_[1] = 0.0;  drive[s].I_[2] = 0.0;
            drive[s].I_[3] = 0.0;  drive[s].I_[4] = 0.0;  drive[s].I_[5] = 0.0;
            rate[s] = 0.0;
        }
    }
    remus6_schur_factor factor;
    status = remus6_factor_schur(&K, &factor);
    if (status != REMUS6_OK) { return status; }
    remus6_solve_schur(&factor, F, V_dot);
    for (int s = 0; s < REMUS6_N; ++s) {
        phi_ddot[s] = 0.0;
        if (locked[s] == 0) {
            phi_ddot[s] = rate[s] - (V_dot[0] * drive[s].I_[0] + V_dot[1] * drive[s].I_[1]
                + V_dot[2] * drive[s].I_[2] + V_dot[3] * drive[s].I_[3] + V_dot[4] * drive[s].I_[4]
                + V_dot[5] * drive[s].I_[5]) * table->flywheel[s].spin_inv;
        }
    }
    /* V* = V_r* - (omega x C^T u, 0) */
    remus6_real drift[3];  /* omega x C^T u */
    drift[0] = u[2] * x->V[4] - u[1] * x->V[5];
    drift[1] = u[0] * x->V[5] - u[2] * x->V[3];
    drift[2] = u[1] * x->V[3] - u[0] * x->V[4];
    V_dot[0] = V_dot[0] - drift[0];  V_dot[1] = V_dot[1] - drift[1];  V_dot[2] = V_dot[2] - drift[2];
    return REMUS6_OK;
}

/* Motion of the whole system under given drive torques: V* and phi'' together, flywheels eliminated first. */
REMUS6_CODE
remus6_status remus6_coupled(const remus6_table *table, const remus6_state *x,
                             const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                             remus6_real V_dot[6], remus6_real phi_ddot[REMUS6_N])
{
    if (table == NULL || x == NULL || tau == NULL || V_dot == NULL
        || phi_ddot == NULL) { return REMUS6_BAD_ARGUMENT; }
    if (locked == NULL) { locked = remus6_none_locked; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(tau, REMUS6_N, REMUS6_MAX_WRENCH);
    if (status != REMUS6_OK) { return status; }
    remus6_real V_result[6];
    remus6_real phi_result[REMUS6_N];
    remus6_real sine[REMUS6_N];
    remus6_real cosine[REMUS6_N];
    remus6_sincos_each(x->phi, sine, cosine);
    status = remus6_solve_coupled(table, x, sine, cosine, tau, locked, V_result, phi_result);
    if (status != REMUS6_OK) { return status; }
    V_dot[0] = V_result[0];  V_dot[1] = V_result[1];  V_dot[2] = V_result[2];
    V_dot[3] = V_result[3];  V_dot[4] = V_result[4];  V_dot[5] = V_result[5];
    for (int s = 0; s < REMUS6_N; ++s) {
        phi_ddot[s] = phi_result[s];
    }
    return REMUS6_OK;
}

/* Sets to = x + h rate, after wrapping the phases to within half a turn. */
REMUS6_CODE
static void remus6_advance(const remus6_state *x, const remus6_state *rate, remus6_real h,
                           remus6_state *restrict to)
{
    for (int i = 0; i < 3; ++i) {
        to->position[i] = x->position[i] + h * rate->position[i];
    }
    for (int i = 0; i < 4; ++i) {
        to->attitude[i] = x->attitude[i] + h * rate->attitude[i];
    }
    for (int i = 0; i < 6; ++i) {
        to->V[i] = x->V[i] + h * rate->V[i];
    }
    for (int i = 0; i < REMUS6_N; ++i) {
        to->phi[i] = remus6_wrapped(x->phi[i]) + h * rate->phi[i];
    }
    for (int i = 0; i < REMUS6_N; ++i) {
        to->phi_dot[i] = x->phi_dot[i] + h * rate->phi_dot[i];
    }
}

/* Normalizes the quaternion and wraps the phases to [-pi, pi]; RANGE if the state is out of range. */
REMUS6_CODE
static remus6_status remus6_finish(remus6_state *restrict x)
{
    remus6_status status;
    const remus6_real square = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
        + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
    if (!(square > 0.5 && square < 2.0)) { return REMUS6_RANGE; }
    const remus6_real inverse = 1.0 / remus6_sqrt(square);
    x->attitude[0] = x->attitude[0] * inverse;
    x->attitude[1] = x->attitude[1] * inverse;
    x->attitude[2] = x->attitude[2] * inverse;
    x->attitude[3] = x->attitude[3] * inverse;
    status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    for (int s = 0; s < REMUS6_N; ++s) {
        x->phi[s] = remus6_wrapped(x->phi[s]);
    }
    return REMUS6_OK;
}

/* Time derivatives of the state under drive torques. */
REMUS6_CODE
static remus6_status remus6_rate(const remus6_table *table, const remus6_state *x,
                                 const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                                 remus6_state *restrict rate)
{
    remus6_status status;
    remus6_real C[9];  /* attitude */
    remus6_real sine[REMUS6_N];
    remus6_real cosine[REMUS6_N];
    remus6_sincos_each(x->phi, sine, cosine);
    status = remus6_solve_coupled(table, x, sine, cosine, tau, locked, rate->V, rate->phi_dot);
    if (status != REMUS6_OK) { return status; }
    remus6_rotation(x->attitude, C);
    rate->position[0] = C[0] * x->V[0] + C[1] * x->V[1] + C[2] * x->V[2];
    rate->position[1] = C[3] * x->V[0] + C[4] * x->V[1] + C[5] * x->V[2];
    rate->position[2] = C[6] * x->V[0] + C[7] * x->V[1] + C[8] * x->V[2];
    rate->attitude[0] = -0.5 * x->V[3] * x->attitude[1] - 0.5 * x->V[4] * x->attitude[2]
        - 0.5 * x->V[5] * x->attitude[3];
    rate->attitude[1] = 0.5 * x->V[3] * x->attitude[0] + 0.5 * x->V[5] * x->attitude[2]
        - 0.5 * x->V[4] * x->attitude[3];
    rate->attitude[2] = 0.5 * x->V[3] * x->attitude[3] + 0.5 * x->V[4] * x->attitude[0]
        - 0.5 * x->V[5] * x->attitude[1];
    rate->attitude[3] = 0.5 * x->V[4] * x->attitude[1] + 0.5 * x->V[5] * x->attitude[0]
        - 0.5 * x->V[3] * x->attitude[2];
    for (int s = 0; s < REMUS6_N; ++s) {
        rate->phi[s] = x->phi_dot[s];
    }
    return REMUS6_OK;
}

/* Evaluations of one step: the sum of the rates at its stages. A stage without an answer is RANGE. */
REMUS6_CODE
static remus6_status remus6_stages(const remus6_table *table, const remus6_state *x,
                                   const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                                   remus6_real h, int order, remus6_state *restrict y,
                                   remus6_state *restrict total)
{
    remus6_status status;
    remus6_state k;  /* time derivatives at a stage */
    status = remus6_rate(table, x, tau, locked, &k);
    if (status != REMUS6_OK) { return status; }
    const remus6_real half = 0.5 * h;
    if (order == 2) {
        remus6_advance(x, &k, half, y);
        status = remus6_rate(table, y, tau, locked, total);
        if (status != REMUS6_OK) { return REMUS6_RANGE; }
    } else {
        *total = k;
        remus6_advance(x, &k, half, y);
        status = remus6_rate(table, y, tau, locked, &k);
        if (status != REMUS6_OK) { return REMUS6_RANGE; }
        for (int i = 0; i < 3; ++i) {
            total->position[i] += 2.0 * k.position[i];
        }
        for (int i = 0; i < 4; ++i) {
            total->attitude[i] += 2.0 * k.attitude[i];
        }
        for (int i = 0; i < 6; ++i) {
            total->V[i] += 2.0 * k.V[i];
        }
        for (int i = 0; i < REMUS6_N; ++i) {
            total->phi[i] += 2.0 * k.phi[i];
        }
        for (int i = 0; i < REMUS6_N; ++i) {
            total->phi_dot[i] += 2.0 * k.phi_dot[i];
        }
        remus6_advance(x, &k, half, y);
        status = remus6_rate(table, y, tau, locked, &k);
        if (status != REMUS6_OK) { return REMUS6_RANGE; }
        for (int i = 0; i < 3; ++i) {
            total->position[i] += 2.0 * k.position[i];
        }
        for (int i = 0; i < 4; ++i) {
            total->attitude[i] += 2.0 * k.attitude[i];
        }
        for (int i = 0; i < 6; ++i) {
            total->V[i] += 2.0 * k.V[i];
        }
        for (int i = 0; i < REMUS6_N; ++i) {
            total->phi[i] += 2.0 * k.phi[i];
        }
        for (int i = 0; i < REMUS6_N; ++i) {
            total->phi_dot[i] += 2.0 * k.phi_dot[i];
        }
        remus6_advance(x, &k, h, y);
        status = remus6_rate(table, y, tau, locked, &k);
        if (status != REMUS6_OK) { return REMUS6_RANGE; }
        for (int i = 0; i < 3; ++i) {
            total->position[i] += k.position[i];
        }
        for (int i = 0; i < 4; ++i) {
            total->attitude[i] += k.attitude[i];
        }
        for (int i = 0; i < 6; ++i) {
            total->V[i] += k.V[i];
        }
        for (int i = 0; i < REMUS6_N; ++i) {
            total->phi[i] += k.phi[i];
        }
        for (int i = 0; i < REMUS6_N; ++i) {
            total->phi_dot[i] += k.phi_dot[i];
        }
    }
    return REMUS6_OK;
}

/* State after one time step; drive torques and wrenches are held constant. */
REMUS6_CODE
remus6_status remus6_step(const remus6_table *table, const remus6_state *x, const remus6_real tau[REMUS6_N],
                          const int locked[REMUS6_N], remus6_real dt, int order, remus6_state *next)
{
    if (table == NULL || x == NULL || tau == NULL || next == NULL) { return REMUS6_BAD_ARGUMENT; }
    if (locked == NULL) { locked = remus6_none_locked; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(tau, REMUS6_N, REMUS6_MAX_WRENCH);
    if (status != REMUS6_OK) { return status; }
    if (!(dt >= -REMUS6_MAX_STEP && dt <= REMUS6_MAX_STEP)) {
        if (dt >= -REMUS6_LARGEST && dt <= REMUS6_LARGEST) { return REMUS6_RANGE; }
        return REMUS6_NOT_FINITE;
    }
    if (!(dt > 0.0)) { return REMUS6_BAD_ARGUMENT; }
    if (!(order == 4 || order == 2)) { return REMUS6_BAD_ARGUMENT; }
    remus6_state y;  /* state of a stage; then the new state */
    remus6_state total;  /* sum of the rates at the stages */
    status = remus6_stages(table, x, tau, locked, dt, order, &y, &total);
    if (status != REMUS6_OK) { return status; }
    const remus6_real over = (order == 2) ? dt : dt / 6.0;  /* times the sum: the increment */
    /* square of the fastest turning, (rad/s)^2 */
    remus6_real fastest = x->V[3] * x->V[3] + x->V[4] * x->V[4] + x->V[5] * x->V[5];
    for (int s = 0; s < REMUS6_N; ++s) {
        const remus6_real square = x->phi_dot[s] * x->phi_dot[s];
        fastest = (square > fastest) ? square : fastest;
    }
    remus6_advance(x, &total, over, &y);
    status = remus6_finish(&y);
    if (status != REMUS6_OK) { return REMUS6_RANGE; }
    *next = y;
    const remus6_real most = (order == 2) ? REMUS6_MAX_TURN_2 : REMUS6_MAX_TURN_4;  /* rad */
    if (dt * dt * fastest > most * most) { return REMUS6_COARSE; }
    return REMUS6_OK;
}

/* Time derivatives of the state under given flywheel accelerations. */
REMUS6_CODE
static remus6_status remus6_rate_driven(const remus6_table *table, const remus6_state *x,
                                        const remus6_real phi_ddot[REMUS6_N], remus6_state *restrict rate)
{
    remus6_status status;
    remus6_real C[9];  /* attitude */
    remus6_real sine[REMUS6_N];
    remus6_real cosine[REMUS6_N];
    remus6_sincos_each(x->phi, sine, cosine);
    status = remus6_accelerate(table, x, sine, cosine, phi_ddot, rate->V);
    if (status != REMUS6_OK) { return status; }
    remus6_rotation(x->attitude, C);
    rate->position[0] = C[0] * x->V[0] + C[1] * x->V[1] + C[2] * x->V[2];
    rate->position[1] = C[3] * x->V[0] + C[4] * x->V[1] + C[5] * x->V[2];
    rate->position[2] = C[6] * x->V[0] + C[7] * x->V[1] + C[8] * x->V[2];
    rate->attitude[0] = -0.5 * x->V[3] * x->attitude[1] - 0.5 * x->V[4] * x->attitude[2]
        - 0.5 * x->V[5] * x->attitude[3];
    rate->attitude[1] = 0.5 * x->V[3] * x->attitude[0] + 0.5 * x->V[5] * x->attitude[2]
        - 0.5 * x->V[4] * x->attitude[3];
    rate->attitude[2] = 0.5 * x->V[3] * x->attitude[3] + 0.5 * x->V[4] * x->attitude[0]
        - 0.5 * x->V[5] * x->attitude[1];
    rate->attitude[3] = 0.5 * x->V[4] * x->attitude[1] + 0.5 * x->V[5] * x->attitude[0]
        - 0.5 * x->V[3] * x->attitude[2];
    for (int s = 0; s < REMUS6_N; ++s) {
        rate->phi[s] = x->phi_dot[s];
        rate->phi_dot[s] = phi_ddot[s];
    }
    return REMUS6_OK;
}

/* Evaluations of one step: the sum of the rates at its stages. A stage without an answer is RANGE. */
REMUS6_CODE
static remus6_status remus6_stages_driven(const remus6_table *table, const remus6_state *x,
                                          const remus6_real phi_ddot[REMUS6_N], remus6_real h, int order,
                                          remus6_state *restrict y, remus6_state *restrict total)
{
    remus6_status status;
    remus6_state k;  /* time derivatives at a stage */
    status = remus6_rate_driven(table, x, phi_ddot, &k);
    if (status != REMUS6_OK) { return status; }
    const remus6_real half = 0.5 * h;
    if (order == 2) {
        remus6_advance(x, &k, half, y);
        status = remus6_rate_driven(table, y, phi_ddot, total);
        if (status != REMUS6_OK) { return REMUS6_RANGE; }
    } else {
        *total = k;
        remus6_advance(x, &k, half, y);
        status = remus6_rate_driven(table, y, phi_ddot, &k);
        if (status != REMUS6_OK) { return REMUS6_RANGE; }
        for (int i = 0; i < 3; ++i) {
            total->position[i] += 2.0 * k.position[i];
        }
        for (int i = 0; i < 4; ++i) {
            total->attitude[i] += 2.0 * k.attitude[i];
        }
        for (int i = 0; i < 6; ++i) {
            total->V[i] += 2.0 * k.V[i];
        }
        for (int i = 0; i < REMUS6_N; ++i) {
            total->phi[i] += 2.0 * k.phi[i];
        }
        for (int i = 0; i < REMUS6_N; ++i) {
            total->phi_dot[i] += 2.0 * k.phi_dot[i];
        }
        remus6_advance(x, &k, half, y);
        status = remus6_rate_driven(table, y, phi_ddot, &k);
        if (status != REMUS6_OK) { return REMUS6_RANGE; }
        for (int i = 0; i < 3; ++i) {
            total->position[i] += 2.0 * k.position[i];
        }
        for (int i = 0; i < 4; ++i) {
            total->attitude[i] += 2.0 * k.attitude[i];
        }
        for (int i = 0; i < 6; ++i) {
            total->V[i] += 2.0 * k.V[i];
        }
        for (int i = 0; i < REMUS6_N; ++i) {
            total->phi[i] += 2.0 * k.phi[i];
        }
        for (int i = 0; i < REMUS6_N; ++i) {
            total->phi_dot[i] += 2.0 * k.phi_dot[i];
        }
        remus6_advance(x, &k, h, y);
        status = remus6_rate_driven(table, y, phi_ddot, &k);
        if (status != REMUS6_OK) { return REMUS6_RANGE; }
        for (int i = 0; i < 3; ++i) {
            total->position[i] += k.position[i];
        }
        for (int i = 0; i < 4; ++i) {
            total->attitude[i] += k.attitude[i];
        }
        for (int i = 0; i < 6; ++i) {
            total->V[i] += k.V[i];
        }
        for (int i = 0; i < REMUS6_N; ++i) {
            total->phi[i] += k.phi[i];
        }
        for (int i = 0; i < REMUS6_N; ++i) {
            total->phi_dot[i] += k.phi_dot[i];
        }
    }
    return REMUS6_OK;
}

/* State after one time step; given flywheel accelerations and wrenches are held constant. */
REMUS6_CODE
remus6_status remus6_step_driven(const remus6_table *table, const remus6_state *x,
                                 const remus6_real phi_ddot[REMUS6_N], remus6_real dt, int order,
                                 remus6_state *next)
{
    if (table == NULL || x == NULL || phi_ddot == NULL || next == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(phi_ddot, REMUS6_N, REMUS6_MAX_ACCELERATION);
    if (status != REMUS6_OK) { return status; }
    if (!(dt >= -REMUS6_MAX_STEP && dt <= REMUS6_MAX_STEP)) {
        if (dt >= -REMUS6_LARGEST && dt <= REMUS6_LARGEST) { return REMUS6_RANGE; }
        return REMUS6_NOT_FINITE;
    }
    if (!(dt > 0.0)) { return REMUS6_BAD_ARGUMENT; }
    if (!(order == 4 || order == 2)) { return REMUS6_BAD_ARGUMENT; }
    remus6_state y;  /* state of a stage; then the new state */
    remus6_state total;  /* sum of the rates at the stages */
    status = remus6_stages_driven(table, x, phi_ddot, dt, order, &y, &total);
    if (status != REMUS6_OK) { return status; }
    const remus6_real over = (order == 2) ? dt : dt / 6.0;  /* times the sum: the increment */
    /* square of the fastest turning, (rad/s)^2 */
    remus6_real fastest = x->V[3] * x->V[3] + x->V[4] * x->V[4] + x->V[5] * x->V[5];
    for (int s = 0; s < REMUS6_N; ++s) {
        const remus6_real square = x->phi_dot[s] * x->phi_dot[s];
        fastest = (square > fastest) ? square : fastest;
    }
    remus6_advance(x, &total, over, &y);
    status = remus6_finish(&y);
    if (status != REMUS6_OK) { return REMUS6_RANGE; }
    *next = y;
    const remus6_real most = (order == 2) ? REMUS6_MAX_TURN_2 : REMUS6_MAX_TURN_4;  /* rad */
    if (dt * dt * fastest > most * most) { return REMUS6_COARSE; }
    return REMUS6_OK;
}

/* The angle wrapped to [-pi, pi] (pi rounded to the nearest real). */
REMUS6_CODE
remus6_status remus6_wrap(remus6_real phi, remus6_real *wrapped)
{
    if (wrapped == NULL) { return REMUS6_BAD_ARGUMENT; }
    if (!(phi >= -REMUS6_MAX_PHASE && phi <= REMUS6_MAX_PHASE)) {
        if (phi >= -REMUS6_LARGEST && phi <= REMUS6_LARGEST) { return REMUS6_RANGE; }
        return REMUS6_NOT_FINITE;
    }
    remus6_real k;  /* nearest number of turns; may be off by one next to an odd multiple of pi */
    remus6_real angle;
    k = phi * 0.15915494309189535 + 6755399441055744.0 - 6755399441055744.0;
    angle = remus6_unwound(phi, k);
    if (angle > 3.141592653589793 || angle < -3.141592653589793) {
        angle = remus6_unwound(phi, (angle > 3.141592653589793) ? k + 1.0 : k - 1.0);
    }
    *wrapped = (angle > 3.141592653589793) ? 3.141592653589793
        : ((angle < -3.141592653589793) ? -3.141592653589793 : angle);
    return REMUS6_OK;
}

/* Phase for a count of an encoder. */
REMUS6_CODE
remus6_status remus6_phase_of_counts(int count, int per_turn, remus6_real zero, remus6_real *phi)
{
    if (phi == NULL) { return REMUS6_BAD_ARGUMENT; }
    if (per_turn < -1073741824 || per_turn > 1073741824 || per_turn == 0) { return REMUS6_BAD_ARGUMENT; }
    const int turn = (per_turn < 0) ? -per_turn : per_turn;  /* counts */
    const remus6_real size = (remus6_real)turn;
    if (!(zero >= -size && zero <= size)) {
        if (zero >= -REMUS6_LARGEST && zero <= REMUS6_LARGEST) { return REMUS6_RANGE; }
        return REMUS6_NOT_FINITE;
    }
    const int rest = count - count / turn * turn;  /* whole turns removed */
    /* counts from phi = 0; then reduced to within half a turn */
    remus6_real place = (remus6_real)rest - zero;
    const remus6_real half = size * 0.5;
    for (int i = 0; i < 2; ++i) {
        place = (place > half) ? place - size : ((place < -half) ? place + size : place);
    }
    *phi = place / (remus6_real)per_turn * 6.283185307179586;
    return REMUS6_OK;
}

/* Mean speed of a flywheel from the counts of one interval. */
REMUS6_CODE
remus6_status remus6_speed_of_counts(int moved, int per_turn, remus6_real dt, remus6_real *phi_dot)
{
    if (phi_dot == NULL) { return REMUS6_BAD_ARGUMENT; }
    if (per_turn < -1073741824 || per_turn > 1073741824 || per_turn == 0) { return REMUS6_BAD_ARGUMENT; }
    if (!(dt >= -REMUS6_MAX_STEP && dt <= REMUS6_MAX_STEP)) {
        if (dt >= -REMUS6_LARGEST && dt <= REMUS6_LARGEST) { return REMUS6_RANGE; }
        return REMUS6_NOT_FINITE;
    }
    if (!(dt > 0.0)) { return REMUS6_BAD_ARGUMENT; }
    const remus6_real turns = (remus6_real)moved / (remus6_real)per_turn;
    const remus6_real speed = turns * 6.283185307179586 / dt;
    if (!(speed >= -REMUS6_MAX_SPEED && speed <= REMUS6_MAX_SPEED)) { return REMUS6_RANGE; }
    *phi_dot = speed;
    return REMUS6_OK;
}

/* Takes one reading of an encoder's counter, which may wrap: place in the turn and counts moved, both
 * exact. */
REMUS6_CODE
remus6_status remus6_accumulate(remus6_encoder *encoder, int counter, int bits, int per_turn)
{
    if (encoder == NULL) { return REMUS6_BAD_ARGUMENT; }
    if (per_turn < -1073741824 || per_turn > 1073741824 || per_turn == 0) { return REMUS6_BAD_ARGUMENT; }
    const int turn = (per_turn < 0) ? -per_turn : per_turn;  /* counts */
    if (!(encoder->place >= 0 && encoder->place < turn)) { return REMUS6_BAD_ARGUMENT; }
    int moved;  /* counts since the last reading, in the shorter direction */
    if (bits == 0) {
        if (!(counter >= 0 && counter < turn
            && (encoder->counter >= 0 && encoder->counter < turn))) { return REMUS6_BAD_ARGUMENT; }
        moved = counter - encoder->counter;
        const int half = turn / 2;
        moved = (moved > half) ? moved - turn : ((moved < -half) ? moved + turn : moved);
    } else {
        if (!(bits >= 2 && bits <= 32)) { return REMUS6_BAD_ARGUMENT; }
        const remus6_word mask = (remus6_word)0xffffffffu >> (remus6_word)(32 - bits);
        /* counts forwards */
        const remus6_word up = ((remus6_word)counter - (remus6_word)encoder->counter) & mask;
        const remus6_word down = mask - up;  /* counts backwards, less one */
        moved = (up > down) ? -1 - (int)down : (int)up;
    }
    int place = encoder->place + (moved - moved / turn * turn);
    encoder->place = (place < 0) ? place + turn : ((place < turn) ? place : place - turn);
    encoder->counter = counter;
    encoder->moved = moved;
    return REMUS6_OK;
}

/* Change of what damp gives, with the change of V, (7). */
REMUS6_CODE
static void remus6_damp_by_V(const remus6_table *table, const remus6_damper *damper, const remus6_real V[6],
                             const remus6_real d_V[6], remus6_real *restrict d_P /* [6] */)
{
    remus6_real x[12];  /* u v w p q r and their magnitudes */
    remus6_real d_x[12];
    x[0] = V[0];
    d_x[0] = d_V[0];
    x[1] = V[1];
    d_x[1] = d_V[1];
    x[2] = V[2];
    d_x[2] = d_V[2];
    x[3] = V[3];
    d_x[3] = d_V[3];
    x[4] = V[4];
    d_x[4] = d_V[4];
    x[5] = V[5];
    d_x[5] = d_V[5];
    x[6] = (V[0] < 0.0) ? -V[0] : V[0];
    d_x[6] = (V[0] < 0.0) ? -d_V[0] : d_V[0];
    x[7] = (V[1] < 0.0) ? -V[1] : V[1];
    d_x[7] = (V[1] < 0.0) ? -d_V[1] : d_V[1];
    x[8] = (V[2] < 0.0) ? -V[2] : V[2];
    d_x[8] = (V[2] < 0.0) ? -d_V[2] : d_V[2];
    x[9] = (V[3] < 0.0) ? -V[3] : V[3];
    d_x[9] = (V[3] < 0.0) ? -d_V[3] : d_V[3];
    x[10] = (V[4] < 0.0) ? -V[4] : V[4];
    d_x[10] = (V[4] < 0.0) ? -d_V[4] : d_V[4];
    x[11] = (V[5] < 0.0) ? -V[5] : V[5];
    d_x[11] = (V[5] < 0.0) ? -d_V[5] : d_V[5];
    for (int t = damper->first_term; t < damper->last_term; ++t) {
        d_P[table->term[t].wrench] += table->term[t].value * d_x[table->term[t].first]
            * x[table->term[t].second] + table->term[t].value * x[table->term[t].first]
            * d_x[table->term[t].second];
    }
}

/* Change of what external gives, with the change of V, (7). */
REMUS6_CODE
static void remus6_external_by_V(const remus6_table *table, const remus6_real V[6], const remus6_real d_V[6],
                                 remus6_real *restrict d_F /* [6] */)
{
    d_F[0] = 0.0;  d_F[1] = 0.0;  d_F[2] = 0.0;
    d_F[3] = 0.0;  d_F[4] = 0.0;  d_F[5] = 0.0;
    remus6_damp_by_V(table, &table->damper, V, d_V, d_F);
}

/* Derivative of F - Phi Z - K* V by the twist, (8). */
REMUS6_CODE
static void remus6_twist_slope(const remus6_table *table, const remus6_real V[6], const remus6_real Z[6],
                               const remus6_matrices_result *m, remus6_real *restrict slope /* [36] */)
{
    slope[0] = 0.0;     slope[1] = 0.0;     slope[2] = 0.0;
    slope[3] = 0.0;     slope[4] = -Z[2];   slope[5] = Z[1];
    slope[6] = 0.0;     slope[7] = 0.0;     slope[8] = 0.0;
    slope[9] = Z[2];    slope[10] = 0.0;    slope[11] = -Z[0];
    slope[12] = 0.0;    slope[13] = 0.0;    slope[14] = 0.0;
    slope[15] = -Z[1];  slope[16] = Z[0];   slope[17] = 0.0;
    slope[18] = 0.0;    slope[19] = -Z[2];  slope[20] = Z[1];
    slope[21] = 0.0;    slope[22] = -Z[5];  slope[23] = Z[4];
    slope[24] = Z[2];   slope[25] = 0.0;    slope[26] = -Z[0];
    slope[27] = Z[5];   slope[28] = 0.0;    slope[29] = -Z[3];
    slope[30] = -Z[1];  slope[31] = Z[0];   slope[32] = 0.0;
    slope[33] = -Z[4];  slope[34] = Z[3];   slope[35] = 0.0;
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
            slope[i * 6 + j] -= m->M[i][j];
        }
    }
    for (int j = 0; j < 6; ++j) {
        remus6_real change[6];  /* unit twist */
        remus6_real F[6];  /* change of the wrench */
        for (int i = 0; i < 6; ++i) {
            change[i] = 0.0;
        }
        change[j] = 1.0;
        remus6_external_by_V(table, V, change, F);
        for (int i = 0; i < 6; ++i) {
            slope[i * 6 + j] += F[i];
        }
    }
}

/* Change of F - Phi Z - K* V - (a, g) - K V* with the harmonic weights of one flywheel, (8). */
REMUS6_CODE
static void remus6_row_slope(const remus6_row *row, const remus6_real weight[12], const remus6_real V[6],
                             const remus6_real V_dot[6], const remus6_real g[3],
                             remus6_real *restrict out /* [6] */)
{
    remus6_sums change;  /* change of the sums */
    remus6_real Z[6];  /* change of the momentum screw */
    change.mu[0] = row->mu_c[0] * weight[0] + row->mu_s[0] * weight[1];
    change.mu[1] = row->mu_c[1] * weight[0] + row->mu_s[1] * weight[1];
    change.mu[2] = row->mu_c[2] * weight[0] + row->mu_s[2] * weight[1];
    change.mu_dot[0] = row->mu_c[0] * weight[4] + row->mu_s[0] * weight[5];
    change.mu_dot[1] = row->mu_c[1] * weight[4] + row->mu_s[1] * weight[5];
    change.mu_dot[2] = row->mu_c[2] * weight[4] + row->mu_s[2] * weight[5];
    change.J[0] = row->J_2c[0] * weight[2] + row->J_2s[0] * weight[3] + row->J_c[0] * weight[0]
        + row->J_s[0] * weight[1];
    change.J[1] = row->J_2c[1] * weight[2] + row->J_2s[1] * weight[3] + row->J_c[1] * weight[0]
        + row->J_s[1] * weight[1];
    change.J[2] = row->J_2c[2] * weight[2] + row->J_2s[2] * weight[3] + row->J_c[2] * weight[0]
        + row->J_s[2] * weight[1];
    change.J[3] = row->J_2c[3] * weight[2] + row->J_2s[3] * weight[3] + row->J_c[3] * weight[0]
        + row->J_s[3] * weight[1];
    change.J[4] = row->J_2c[4] * weight[2] + row->J_2s[4] * weight[3] + row->J_c[4] * weight[0]
        + row->J_s[4] * weight[1];
    change.J[5] = row->J_2c[5] * weight[2] + row->J_2s[5] * weight[3] + row->J_c[5] * weight[0]
        + row->J_s[5] * weight[1];
    change.J_dot[0] = row->J_2c[0] * weight[6] + row->J_2s[0] * weight[7] + row->J_c[0] * weight[4]
        + row->J_s[0] * weight[5];
    change.J_dot[1] = row->J_2c[1] * weight[6] + row->J_2s[1] * weight[7] + row->J_c[1] * weight[4]
        + row->J_s[1] * weight[5];
    change.J_dot[2] = row->J_2c[2] * weight[6] + row->J_2s[2] * weight[7] + row->J_c[2] * weight[4]
        + row->J_s[2] * weight[5];
    change.J_dot[3] = row->J_2c[3] * weight[6] + row->J_2s[3] * weight[7] + row->J_c[3] * weight[4]
        + row->J_s[3] * weight[5];
    change.J_dot[4] = row->J_2c[4] * weight[6] + row->J_2s[4] * weight[7] + row->J_c[4] * weight[4]
        + row->J_s[4] * weight[5];
    change.J_dot[5] = row->J_2c[5] * weight[6] + row->J_2s[5] * weight[7] + row->J_c[5] * weight[4]
        + row->J_s[5] * weight[5];
    change.h_rel[0] = row->t_c[0] * weight[5] + weight[10] * row->t_0[0] - row->t_s[0] * weight[4];
    change.h_rel[1] = row->t_c[1] * weight[5] + weight[10] * row->t_0[1] - row->t_s[1] * weight[4];
    change.h_rel[2] = row->t_c[2] * weight[5] + weight[10] * row->t_0[2] - row->t_s[2] * weight[4];
    change.g_rel[0] = row->t_c[0] * weight[9] + weight[11] * row->t_0[0] - row->t_s[0] * weight[8];
    change.g_rel[1] = row->t_c[1] * weight[9] + weight[11] * row->t_0[1] - row->t_s[1] * weight[8];
    change.g_rel[2] = row->t_c[2] * weight[9] + weight[11] * row->t_0[2] - row->t_s[2] * weight[8];
    change.a_rel[0] = row->mu_c[0] * weight[8] + row->mu_s[0] * weight[9];
    change.a_rel[1] = row->mu_c[1] * weight[8] + row->mu_s[1] * weight[9];
    change.a_rel[2] = row->mu_c[2] * weight[8] + row->mu_s[2] * weight[9];
    Z[0] = change.mu[2] * V[4] + change.mu_dot[0] - change.mu[1] * V[5];
    Z[1] = change.mu[0] * V[5] + change.mu_dot[1] - change.mu[2] * V[3];
    Z[2] = change.mu[1] * V[3] + change.mu_dot[2] - change.mu[0] * V[4];
    Z[3] = change.J[0] * V[3] + change.J[3] * V[4] + change.J[4] * V[5] + change.h_rel[0]
        + change.mu[1] * V[2] - change.mu[2] * V[1];
    Z[4] = change.J[1] * V[4] + change.J[3] * V[3] + change.J[5] * V[5] + change.h_rel[1]
        + change.mu[2] * V[0] - change.mu[0] * V[2];
    Z[5] = change.J[2] * V[5] + change.J[4] * V[3] + change.J[5] * V[4] + change.h_rel[2]
        + change.mu[0] * V[1] - change.mu[1] * V[0];
    out[0] = change.mu[1] * V_dot[5] + change.mu_dot[1] * V[5] + V[5] * Z[1] - change.a_rel[0]
        - change.mu[2] * V_dot[4] - change.mu_dot[2] * V[4] - V[4] * Z[2];
    out[1] = change.mu[2] * V_dot[3] + change.mu_dot[2] * V[3] + V[3] * Z[2] - change.a_rel[1]
        - change.mu[0] * V_dot[5] - change.mu_dot[0] * V[5] - V[5] * Z[0];
    out[2] = change.mu[0] * V_dot[4] + change.mu_dot[0] * V[4] + V[4] * Z[0] - change.a_rel[2]
        - change.mu[1] * V_dot[3] - change.mu_dot[1] * V[3] - V[3] * Z[1];
    out[3] = g[2] * change.mu[1] + Z[4] * V[5] + change.mu[2] * V_dot[1] + change.mu_dot[2] * V[1]
        + Z[1] * V[2] - change.J[0] * V_dot[3] - change.J[3] * V_dot[4] - change.J[4] * V_dot[5]
        - change.J_dot[0] * V[3] - change.J_dot[3] * V[4] - change.J_dot[4] * V[5] - g[1] * change.mu[2]
        - change.g_rel[0] - Z[5] * V[4] - change.mu[1] * V_dot[2] - change.mu_dot[1] * V[2] - Z[2] * V[1];
    out[4] = g[0] * change.mu[2] + Z[5] * V[3] + change.mu[0] * V_dot[2] + change.mu_dot[0] * V[2]
        + Z[2] * V[0] - change.J[1] * V_dot[4] - change.J[3] * V_dot[3] - change.J[5] * V_dot[5]
        - change.J_dot[1] * V[4] - change.J_dot[3] * V[3] - change.J_dot[5] * V[5] - g[2] * change.mu[0]
        - change.g_rel[1] - Z[3] * V[5] - change.mu[2] * V_dot[0] - change.mu_dot[2] * V[0] - Z[0] * V[2];
    out[5] = g[1] * change.mu[0] + Z[3] * V[4] + change.mu[1] * V_dot[0] + change.mu_dot[1] * V[0]
        + Z[0] * V[1] - change.J[2] * V_dot[5] - change.J[4] * V_dot[3] - change.J[5] * V_dot[4]
        - change.J_dot[2] * V[5] - change.J_dot[4] * V[3] - change.J_dot[5] * V[4] - g[0] * change.mu[1]
        - change.g_rel[2] - Z[4] * V[3] - change.mu[0] * V_dot[1] - change.mu_dot[0] * V[1] - Z[1] * V[0];
}

/* (8) */
REMUS6_CODE
remus6_status remus6_forward_jacobian(const remus6_table *table, const remus6_state *x,
                                      const remus6_real phi_ddot[REMUS6_N],
                                      remus6_forward_jacobian_result *out)
{
    if (table == NULL || x == NULL || phi_ddot == NULL || out == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(phi_ddot, REMUS6_N, REMUS6_MAX_ACCELERATION);
    if (status != REMUS6_OK) { return status; }
    remus6_real C[9];  /* attitude */
    remus6_rotation(x->attitude, C);
    remus6_real u[3];  /* stream in E1 */
    remus6_rotate_back(C, table->stream, u);
    remus6_real V[6];  /* V relative to the stream: the fluid's frame is inertial as well */
    V[0] = x->V[0] - u[0];  V[1] = x->V[1] - u[1];  V[2] = x->V[2] - u[2];
    V[3] = x->V[3];         V[4] = x->V[4];         V[5] = x->V[5];
    remus6_real g[3];  /* gravity in E1 */
    remus6_rotate_back(C, table->gravity, g);
    remus6_sums sum;
    remus6_real sine[REMUS6_N];
    remus6_real cosine[REMUS6_N];
    remus6_sincos_each(x->phi, sine, cosine);
    remus6_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    remus6_sum_spin(table, sine, cosine, x->phi_dot, phi_ddot, &sum);
    remus6_real F[6];  /* right-hand side of (8) */
    remus6_real Z[6];  /* momentum screw (2) */
    remus6_real V_result[6];  /* V_r* */
    remus6_real rhs[6];
    remus6_real y[6];
    remus6_external(table, &sum, V, g, F);
    remus6_momentum_screw(table, &sum, V, Z);
    remus6_subtract_rates(table, &sum, V, F);
    remus6_carrier_factor K;
    status = remus6_factor_carrier(table, &sum, &K);
    if (status != REMUS6_OK) { return status; }
    remus6_solve_carrier(table, &K, F, V_result);
    remus6_matrices_result m;
    m.K[0][0] = table->A[0];  m.K[0][1] = table->A[3];  m.K[0][2] = table->A[4];
    m.K[0][3] = table->G[0];
    m.K[0][4] = table->G[3] + sum.mu[2];
    m.K[0][5] = table->G[6] - sum.mu[1];
    m.K[1][0] = table->A[3];  m.K[1][1] = table->A[1];  m.K[1][2] = table->A[5];
    m.K[1][3] = table->G[1] - sum.mu[2];
    m.K[1][4] = table->G[4];
    m.K[1][5] = table->G[7] + sum.mu[0];
    m.K[2][0] = table->A[4];  m.K[2][1] = table->A[5];  m.K[2][2] = table->A[2];
    m.K[2][3] = table->G[2] + sum.mu[1];
    m.K[2][4] = table->G[5] - sum.mu[0];
    m.K[2][5] = table->G[8];
    m.K[3][0] = table->G[0];
    m.K[3][1] = table->G[1] - sum.mu[2];
    m.K[3][2] = table->G[2] + sum.mu[1];
    m.K[3][3] = sum.J[0];  m.K[3][4] = sum.J[3];  m.K[3][5] = sum.J[4];
    m.K[4][0] = table->G[3] + sum.mu[2];
    m.K[4][1] = table->G[4];
    m.K[4][2] = table->G[5] - sum.mu[0];
    m.K[4][3] = sum.J[3];  m.K[4][4] = sum.J[1];  m.K[4][5] = sum.J[5];
    m.K[5][0] = table->G[6] - sum.mu[1];
    m.K[5][1] = table->G[7] + sum.mu[0];
    m.K[5][2] = table->G[8];  m.K[5][3] = sum.J[4];     m.K[5][4] = sum.J[5];
    m.K[5][5] = sum.J[2];
    m.K_dot[0][0] = 0.0;             m.K_dot[0][1] = 0.0;             m.K_dot[0][2] = 0.0;
    m.K_dot[0][3] = 0.0;             m.K_dot[0][4] = sum.mu_dot[2];   m.K_dot[0][5] = -sum.mu_dot[1];
    m.K_dot[1][0] = 0.0;             m.K_dot[1][1] = 0.0;             m.K_dot[1][2] = 0.0;
    m.K_dot[1][3] = -sum.mu_dot[2];  m.K_dot[1][4] = 0.0;             m.K_dot[1][5] = sum.mu_dot[0];
    m.K_dot[2][0] = 0.0;             m.K_dot[2][1] = 0.0;             m.K_dot[2][2] = 0.0;
    m.K_dot[2][3] = sum.mu_dot[1];   m.K_dot[2][4] = -sum.mu_dot[0];  m.K_dot[2][5] = 0.0;
    m.K_dot[3][0] = 0.0;             m.K_dot[3][1] = -sum.mu_dot[2];  m.K_dot[3][2] = sum.mu_dot[1];
    m.K_dot[3][3] = sum.J_dot[0];    m.K_dot[3][4] = sum.J_dot[3];    m.K_dot[3][5] = sum.J_dot[4];
    m.K_dot[4][0] = sum.mu_dot[2];   m.K_dot[4][1] = 0.0;             m.K_dot[4][2] = -sum.mu_dot[0];
    m.K_dot[4][3] = sum.J_dot[3];    m.K_dot[4][4] = sum.J_dot[1];    m.K_dot[4][5] = sum.J_dot[5];
    m.K_dot[5][0] = -sum.mu_dot[1];  m.K_dot[5][1] = sum.mu_dot[0];   m.K_dot[5][2] = 0.0;
    m.K_dot[5][3] = sum.J_dot[4];    m.K_dot[5][4] = sum.J_dot[5];    m.K_dot[5][5] = sum.J_dot[2];
    remus6_velocity_matrix(V, &m);
    remus6_real slope[36];  /* derivative by V, row by row */
    remus6_twist_slope(table, V, Z, &m, slope);
    for (int j = 0; j < 6; ++j) {
        for (int i = 0; i < 6; ++i) {
            rhs[i] = slope[i * 6 + j];
        }
        remus6_solve_carrier(table, &K, rhs, y);
        for (int i = 0; i < 6; ++i) {
            out->V_dot_V[i][j] = y[i];
        }
    }
    /* V* = V_r* - (omega x C^T u, 0) */
    out->V_dot_V[0][4] -= u[2];  out->V_dot_V[0][5] += u[1];
    out->V_dot_V[1][5] -= u[0];  out->V_dot_V[1][3] += u[2];
    out->V_dot_V[2][3] -= u[1];  out->V_dot_V[2][4] += u[0];
    remus6_real change[12];  /* changes of the harmonic weights of a flywheel */
    for (int s = 0; s < REMUS6_N; ++s) {
        const remus6_real s_phi = sine[s];
        const remus6_real c_phi = cosine[s];
        const remus6_real c2 = 1.0 - 2.0 * (s_phi * s_phi);  /* cos 2 phi, then sin 2 phi */
        const remus6_real s2 = 2.0 * c_phi * s_phi;
        const remus6_real dc = -x->phi_dot[s] * s_phi;  /* time derivatives: d(cos phi)/dt, ... */
        const remus6_real ds = x->phi_dot[s] * c_phi;
        const remus6_real dc2 = -2.0 * x->phi_dot[s] * s2;
        const remus6_real ds2 = 2.0 * x->phi_dot[s] * c2;
        const remus6_real ddc = -x->phi_dot[s] * ds - phi_ddot[s] * s_phi;  /* second time derivatives */
        const remus6_real dds = phi_ddot[s] * c_phi + x->phi_dot[s] * dc;
        {
            change[0] = -s_phi;      change[1] = c_phi;       change[2] = -2.0 * s2;
            change[3] = 2.0 * c2;    change[4] = -ds;         change[5] = dc;
            change[6] = -2.0 * ds2;  change[7] = 2.0 * dc2;   change[8] = -dds;
            change[9] = ddc;         change[10] = 0.0;        change[11] = 0.0;
            remus6_row_slope(&table->flywheel[s], change, V, V_result, g, rhs);
            remus6_solve_carrier(table, &K, rhs, y);
            for (int i = 0; i < 6; ++i) {
                out->V_dot_phi[i][s] = y[i];
            }
        }
        {
            change[0] = 0.0;        change[1] = 0.0;        change[2] = 0.0;
            change[3] = 0.0;        change[4] = -s_phi;     change[5] = c_phi;
            change[6] = -2.0 * s2;  change[7] = 2.0 * c2;   change[8] = -2.0 * ds;
            change[9] = 2.0 * dc;   change[10] = 1.0;       change[11] = 0.0;
            remus6_row_slope(&table->flywheel[s], change, V, V_result, g, rhs);
            remus6_solve_carrier(table, &K, rhs, y);
            for (int i = 0; i < 6; ++i) {
                out->V_dot_phi_dot[i][s] = y[i];
            }
        }
        rhs[0] = table->flywheel[s].mu_c[0] * s_phi - table->flywheel[s].mu_s[0] * c_phi;
        rhs[1] = table->flywheel[s].mu_c[1] * s_phi - table->flywheel[s].mu_s[1] * c_phi;
        rhs[2] = table->flywheel[s].mu_c[2] * s_phi - table->flywheel[s].mu_s[2] * c_phi;
        rhs[3] = -table->flywheel[s].t_c[0] * c_phi - table->flywheel[s].t_s[0] * s_phi
            - table->flywheel[s].t_0[0];
        rhs[4] = -table->flywheel[s].t_c[1] * c_phi - table->flywheel[s].t_s[1] * s_phi
            - table->flywheel[s].t_0[1];
        rhs[5] = -table->flywheel[s].t_c[2] * c_phi - table->flywheel[s].t_s[2] * s_phi
            - table->flywheel[s].t_0[2];
        remus6_solve_carrier(table, &K, rhs, y);
        for (int i = 0; i < 6; ++i) {
            out->V_dot_phi_ddot[i][s] = y[i];
        }
    }
    return REMUS6_OK;
}

/* Derivatives of coupled by V, phi, phi' and tau, at fixed position and attitude. */
REMUS6_CODE
remus6_status remus6_coupled_jacobian(const remus6_table *table, const remus6_state *x,
                                      const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                                      remus6_coupled_jacobian_result *out)
{
    if (table == NULL || x == NULL || tau == NULL || out == NULL) { return REMUS6_BAD_ARGUMENT; }
    if (locked == NULL) { locked = remus6_none_locked; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(tau, REMUS6_N, REMUS6_MAX_WRENCH);
    if (status != REMUS6_OK) { return status; }
    remus6_real V_result[6];  /* V*, then V_r* */
    remus6_real phi_result[REMUS6_N];  /* phi'' */
    remus6_real sine[REMUS6_N];
    remus6_real cosine[REMUS6_N];
    remus6_sincos_each(x->phi, sine, cosine);
    remus6_real C[9];  /* attitude */
    remus6_rotation(x->attitude, C);
    remus6_real u[3];  /* stream in E1 */
    remus6_rotate_back(C, table->stream, u);
    remus6_real V[6];  /* V relative to the stream: the fluid's frame is inertial as well */
    V[0] = x->V[0] - u[0];  V[1] = x->V[1] - u[1];  V[2] = x->V[2] - u[2];
    V[3] = x->V[3];         V[4] = x->V[4];         V[5] = x->V[5];
    remus6_real g[3];  /* gravity in E1 */
    remus6_rotate_back(C, table->gravity, g);
    remus6_sums sum;
    remus6_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    remus6_sum_steady_spin(table, sine, cosine, x->phi_dot, &sum);
    remus6_real F[6];  /* wrench (7); then the right-hand side of K V* + I phi'' = F */
    remus6_external(table, &sum, V, g, F);
    remus6_subtract_rates(table, &sum, V, F);
    remus6_schur K;  /* mass matrix with free flywheels eliminated */
    K.A[0] = table->A[0];  K.A[1] = table->A[1];  K.A[2] = table->A[2];
    K.A[3] = table->A[3];  K.A[4] = table->A[4];  K.A[5] = table->A[5];
    K.B[0] = table->G[0];              K.B[1] = table->G[1] - sum.mu[2];  K.B[2] = table->G[2] + sum.mu[1];
    K.B[3] = table->G[3] + sum.mu[2];  K.B[4] = table->G[4];              K.B[5] = table->G[5] - sum.mu[0];
    K.B[6] = table->G[6] - sum.mu[1];  K.B[7] = table->G[7] + sum.mu[0];  K.B[8] = table->G[8];
    K.D[0] = sum.J[0];  K.D[1] = sum.J[1];  K.D[2] = sum.J[2];
    K.D[3] = sum.J[3];  K.D[4] = sum.J[4];  K.D[5] = sum.J[5];
    remus6_coupling drive[REMUS6_N];
    remus6_real origin_acceleration[3];  /* acceleration of O1 at V* = 0, minus gravity */
    origin_acceleration[0] = V[4] * V[2] - g[0] - V[5] * V[1];
    origin_acceleration[1] = V[5] * V[0] - g[1] - V[3] * V[2];
    origin_acceleration[2] = V[3] * V[1] - g[2] - V[4] * V[0];
    remus6_real spun[6];  /* six numbers: J . spun = -omega . J omega / 2 for every inertia J */
    spun[0] = -0.5 * (V[3] * V[3]);  spun[1] = -0.5 * (V[4] * V[4]);  spun[2] = -0.5 * (V[5] * V[5]);
    spun[3] = -V[3] * V[4];          spun[4] = -V[3] * V[5];          spun[5] = -V[4] * V[5];
    remus6_real rate[REMUS6_N];  /* accelerations at V* = 0 */
    for (int s = 0; s < REMUS6_N; ++s) {
        if (locked[s] == 0) {
            remus6_couple(&table->flywheel[s], sine[s], cosine[s], origin_acceleration, spun, &drive[s]);
            rate[s] = (tau[s] - drive[s].bias) * table->flywheel[s].spin_inv;
            remus6_eliminate(drive[s].I_, table->flywheel[s].spin_inv, rate[s], &K, F);
        } else {
            drive[s].I_[0] = 0.0;  drive[s].I_[1] = 0.0;  drive[s].I_[2] = 0.0;
            drive[s].I_[3] = 0.0;  drive[s].I_[4] = 0.0;  drive[s].I_[5] = 0.0;
            rate[s] = 0.0;
        }
    }
    remus6_schur_factor factor;
    status = remus6_factor_schur(&K, &factor);
    if (status != REMUS6_OK) { return status; }
    remus6_solve_schur(&factor, F, V_result);
    for (int s = 0; s < REMUS6_N; ++s) {
        phi_result[s] = 0.0;
        if (locked[s] == 0) {
            phi_result[s] = rate[s] - (V_result[0] * drive[s].I_[0] + V_result[1] * drive[s].I_[1]
                + V_result[2] * drive[s].I_[2] + V_result[3] * drive[s].I_[3] + V_result[4] * drive[s].I_[4]
                + V_result[5] * drive[s].I_[5]) * table->flywheel[s].spin_inv;
        }
    }
    remus6_real Z[6];  /* momentum screw (2) */
    remus6_momentum_screw(table, &sum, V, Z);
    remus6_matrices_result m;
    m.K[0][0] = table->A[0];  m.K[0][1] = table->A[3];  m.K[0][2] = table->A[4];
    m.K[0][3] = table->G[0];
    m.K[0][4] = table->G[3] + sum.mu[2];
    m.K[0][5] = table->G[6] - sum.mu[1];
    m.K[1][0] = table->A[3];  m.K[1][1] = table->A[1];  m.K[1][2] = table->A[5];
    m.K[1][3] = table->G[1] - sum.mu[2];
    m.K[1][4] = table->G[4];
    m.K[1][5] = table->G[7] + sum.mu[0];
    m.K[2][0] = table->A[4];  m.K[2][1] = table->A[5];  m.K[2][2] = table->A[2];
    m.K[2][3] = table->G[2] + sum.mu[1];
    m.K[2][4] = table->G[5] - sum.mu[0];
    m.K[2][5] = table->G[8];
    m.K[3][0] = table->G[0];
    m.K[3][1] = table->G[1] - sum.mu[2];
    m.K[3][2] = table->G[2] + sum.mu[1];
    m.K[3][3] = sum.J[0];  m.K[3][4] = sum.J[3];  m.K[3][5] = sum.J[4];
    m.K[4][0] = table->G[3] + sum.mu[2];
    m.K[4][1] = table->G[4];
    m.K[4][2] = table->G[5] - sum.mu[0];
    m.K[4][3] = sum.J[3];  m.K[4][4] = sum.J[1];  m.K[4][5] = sum.J[5];
    m.K[5][0] = table->G[6] - sum.mu[1];
    m.K[5][1] = table->G[7] + sum.mu[0];
    m.K[5][2] = table->G[8];  m.K[5][3] = sum.J[4];     m.K[5][4] = sum.J[5];
    m.K[5][5] = sum.J[2];
    m.K_dot[0][0] = 0.0;             m.K_dot[0][1] = 0.0;             m.K_dot[0][2] = 0.0;
    m.K_dot[0][3] = 0.0;             m.K_dot[0][4] = sum.mu_dot[2];   m.K_dot[0][5] = -sum.mu_dot[1];
    m.K_dot[1][0] = 0.0;             m.K_dot[1][1] = 0.0;             m.K_dot[1][2] = 0.0;
    m.K_dot[1][3] = -sum.mu_dot[2];  m.K_dot[1][4] = 0.0;             m.K_dot[1][5] = sum.mu_dot[0];
    m.K_dot[2][0] = 0.0;             m.K_dot[2][1] = 0.0;             m.K_dot[2][2] = 0.0;
    m.K_dot[2][3] = sum.mu_dot[1];   m.K_dot[2][4] = -sum.mu_dot[0];  m.K_dot[2][5] = 0.0;
    m.K_dot[3][0] = 0.0;             m.K_dot[3][1] = -sum.mu_dot[2];  m.K_dot[3][2] = sum.mu_dot[1];
    m.K_dot[3][3] = sum.J_dot[0];    m.K_dot[3][4] = sum.J_dot[3];    m.K_dot[3][5] = sum.J_dot[4];
    m.K_dot[4][0] = sum.mu_dot[2];   m.K_dot[4][1] = 0.0;             m.K_dot[4][2] = -sum.mu_dot[0];
    m.K_dot[4][3] = sum.J_dot[3];    m.K_dot[4][4] = sum.J_dot[1];    m.K_dot[4][5] = sum.J_dot[5];
    m.K_dot[5][0] = -sum.mu_dot[1];  m.K_dot[5][1] = sum.mu_dot[0];   m.K_dot[5][2] = 0.0;
    m.K_dot[5][3] = sum.J_dot[4];    m.K_dot[5][4] = sum.J_dot[5];    m.K_dot[5][5] = sum.J_dot[2];
    remus6_velocity_matrix(V, &m);
    remus6_real slope[36];  /* derivative by V, row by row */
    remus6_twist_slope(table, V, Z, &m, slope);
    remus6_real rhs[6];  /* right-hand side of the carrier */
    remus6_real drive_rhs[REMUS6_N];  /* right-hand sides of the drives */
    remus6_real y[6];
    rhs[0] = 0.0;  rhs[1] = 0.0;  rhs[2] = 0.0;
    rhs[3] = 0.0;  rhs[4] = 0.0;  rhs[5] = 0.0;
    remus6_real drive_slope[REMUS6_N][6];  /* derivatives of the bias torques by V */
    remus6_real J_p[6];  /* dJ / dphi */
    remus6_real turned[3];  /* J' omega */
    for (int s = 0; s < REMUS6_N; ++s) {
        const remus6_real s_phi = sine[s];
        const remus6_real c_phi = cosine[s];
        const remus6_real two_c2 = 2.0 - 4.0 * (s_phi * s_phi);
        const remus6_real two_s2 = 4.0 * c_phi * s_phi;
        J_p[0] = table->flywheel[s].J_2s[0] * two_c2 + table->flywheel[s].J_s[0] * c_phi
            - table->flywheel[s].J_2c[0] * two_s2 - table->flywheel[s].J_c[0] * s_phi;
        J_p[1] = table->flywheel[s].J_2s[1] * two_c2 + table->flywheel[s].J_s[1] * c_phi
            - table->flywheel[s].J_2c[1] * two_s2 - table->flywheel[s].J_c[1] * s_phi;
        J_p[2] = table->flywheel[s].J_2s[2] * two_c2 + table->flywheel[s].J_s[2] * c_phi
            - table->flywheel[s].J_2c[2] * two_s2 - table->flywheel[s].J_c[2] * s_phi;
        J_p[3] = table->flywheel[s].J_2s[3] * two_c2 + table->flywheel[s].J_s[3] * c_phi
            - table->flywheel[s].J_2c[3] * two_s2 - table->flywheel[s].J_c[3] * s_phi;
        J_p[4] = table->flywheel[s].J_2s[4] * two_c2 + table->flywheel[s].J_s[4] * c_phi
            - table->flywheel[s].J_2c[4] * two_s2 - table->flywheel[s].J_c[4] * s_phi;
        J_p[5] = table->flywheel[s].J_2s[5] * two_c2 + table->flywheel[s].J_s[5] * c_phi
            - table->flywheel[s].J_2c[5] * two_s2 - table->flywheel[s].J_c[5] * s_phi;
        turned[0] = J_p[0] * V[3] + J_p[3] * V[4] + J_p[4] * V[5];
        turned[1] = J_p[1] * V[4] + J_p[3] * V[3] + J_p[5] * V[5];
        turned[2] = J_p[2] * V[5] + J_p[4] * V[3] + J_p[5] * V[4];
        drive_slope[s][0] = drive[s].I_[1] * V[5] - drive[s].I_[2] * V[4];
        drive_slope[s][1] = drive[s].I_[2] * V[3] - drive[s].I_[0] * V[5];
        drive_slope[s][2] = drive[s].I_[0] * V[4] - drive[s].I_[1] * V[3];
        drive_slope[s][3] = drive[s].I_[2] * V[1] - drive[s].I_[1] * V[2] - turned[0];
        drive_slope[s][4] = drive[s].I_[0] * V[2] - drive[s].I_[2] * V[0] - turned[1];
        drive_slope[s][5] = drive[s].I_[1] * V[0] - drive[s].I_[0] * V[1] - turned[2];
    }
    for (int j = 0; j < 6; ++j) {
        for (int i = 0; i < 6; ++i) {
            rhs[i] = slope[i * 6 + j];
        }
        for (int s = 0; s < REMUS6_N; ++s) {
            drive_rhs[s] = -drive_slope[s][j];
        }
        for (int t = 0; t < REMUS6_N; ++t) {
            if (locked[t] == 0) {
                const remus6_real share = drive_rhs[t] * table->flywheel[t].spin_inv;
                for (int i = 0; i < 6; ++i) {
                    rhs[i] -= drive[t].I_[i] * share;
                }
            }
        }
        remus6_solve_schur(&factor, rhs, y);
        for (int i = 0; i < 6; ++i) {
            out->V_dot_V[i][j] = y[i];
        }
        for (int t = 0; t < REMUS6_N; ++t) {
            out->phi_ddot_V[t][j] = 0.0;
            if (locked[t] == 0) {
                out->phi_ddot_V[t][j] = (drive_rhs[t]
                    - (y[0] * drive[t].I_[0] + y[1] * drive[t].I_[1] + y[2] * drive[t].I_[2]
                    + y[3] * drive[t].I_[3] + y[4] * drive[t].I_[4] + y[5] * drive[t].I_[5]))
                    * table->flywheel[t].spin_inv;
            }
        }
    }
    /* V* = V_r* - (omega x C^T u, 0) */
    out->V_dot_V[0][4] -= u[2];  out->V_dot_V[0][5] += u[1];
    out->V_dot_V[1][5] -= u[0];  out->V_dot_V[1][3] += u[2];
    out->V_dot_V[2][3] -= u[1];  out->V_dot_V[2][4] += u[0];
    remus6_real change[12];  /* changes of the harmonic weights of a flywheel */
    for (int s = 0; s < REMUS6_N; ++s) {
        const remus6_real s_phi = sine[s];
        const remus6_real c_phi = cosine[s];
        const remus6_real c2 = 1.0 - 2.0 * (s_phi * s_phi);  /* cos 2 phi, then sin 2 phi */
        const remus6_real s2 = 2.0 * c_phi * s_phi;
        const remus6_real dc = -x->phi_dot[s] * s_phi;  /* time derivatives: d(cos phi)/dt, ... */
        const remus6_real ds = x->phi_dot[s] * c_phi;
        const remus6_real dc2 = -2.0 * x->phi_dot[s] * s2;
        const remus6_real ds2 = 2.0 * x->phi_dot[s] * c2;
        const remus6_real ddc = -x->phi_dot[s] * ds - phi_result[s] * s_phi;  /* second time derivatives */
        const remus6_real dds = phi_result[s] * c_phi + x->phi_dot[s] * dc;
        {
            change[0] = -s_phi;      change[1] = c_phi;       change[2] = -2.0 * s2;
            change[3] = 2.0 * c2;    change[4] = -ds;         change[5] = dc;
            change[6] = -2.0 * ds2;  change[7] = 2.0 * dc2;   change[8] = -dds;
            change[9] = ddc;         change[10] = 0.0;        change[11] = 0.0;
            remus6_row_slope(&table->flywheel[s], change, V, V_result, g, rhs);
            remus6_real mu_pp[3];  /* d2 mu / dphi2 */
            remus6_real J_pp[6];  /* d2 J / dphi2 */
            remus6_real I_p[6];  /* dI / dphi */
            mu_pp[0] = -table->flywheel[s].mu_c[0] * c_phi - table->flywheel[s].mu_s[0] * s_phi;
            mu_pp[1] = -table->flywheel[s].mu_c[1] * c_phi - table->flywheel[s].mu_s[1] * s_phi;
            mu_pp[2] = -table->flywheel[s].mu_c[2] * c_phi - table->flywheel[s].mu_s[2] * s_phi;
            J_pp[0] = -4.0 * table->flywheel[s].J_2c[0] * c2 - 4.0 * table->flywheel[s].J_2s[0] * s2
                - table->flywheel[s].J_c[0] * c_phi - table->flywheel[s].J_s[0] * s_phi;
            J_pp[1] = -4.0 * table->flywheel[s].J_2c[1] * c2 - 4.0 * table->flywheel[s].J_2s[1] * s2
                - table->flywheel[s].J_c[1] * c_phi - table->flywheel[s].J_s[1] * s_phi;
            J_pp[2] = -4.0 * table->flywheel[s].J_2c[2] * c2 - 4.0 * table->flywheel[s].J_2s[2] * s2
                - table->flywheel[s].J_c[2] * c_phi - table->flywheel[s].J_s[2] * s_phi;
            J_pp[3] = -4.0 * table->flywheel[s].J_2c[3] * c2 - 4.0 * table->flywheel[s].J_2s[3] * s2
                - table->flywheel[s].J_c[3] * c_phi - table->flywheel[s].J_s[3] * s_phi;
            J_pp[4] = -4.0 * table->flywheel[s].J_2c[4] * c2 - 4.0 * table->flywheel[s].J_2s[4] * s2
                - table->flywheel[s].J_c[4] * c_phi - table->flywheel[s].J_s[4] * s_phi;
            J_pp[5] = -4.0 * table->flywheel[s].J_2c[5] * c2 - 4.0 * table->flywheel[s].J_2s[5] * s2
                - table->flywheel[s].J_c[5] * c_phi - table->flywheel[s].J_s[5] * s_phi;
            I_p[0] = -table->flywheel[s].mu_c[0] * c_phi - table->flywheel[s].mu_s[0] * s_phi;
            I_p[1] = -table->flywheel[s].mu_c[1] * c_phi - table->flywheel[s].mu_s[1] * s_phi;
            I_p[2] = -table->flywheel[s].mu_c[2] * c_phi - table->flywheel[s].mu_s[2] * s_phi;
            I_p[3] = table->flywheel[s].t_s[0] * c_phi - table->flywheel[s].t_c[0] * s_phi;
            I_p[4] = table->flywheel[s].t_s[1] * c_phi - table->flywheel[s].t_c[1] * s_phi;
            I_p[5] = table->flywheel[s].t_s[2] * c_phi - table->flywheel[s].t_c[2] * s_phi;
            const remus6_real side = -(V_result[0] * I_p[0] + V_result[1] * I_p[1] + V_result[2] * I_p[2]
                + V_result[3] * I_p[3] + V_result[4] * I_p[4] + V_result[5] * I_p[5]
                + (mu_pp[0] * origin_acceleration[0] + mu_pp[1] * origin_acceleration[1]
                + mu_pp[2] * origin_acceleration[2]
                - 0.5 * (J_pp[0] * V[3] + J_pp[3] * V[4] + J_pp[4] * V[5]) * V[3]
                - 0.5 * (J_pp[1] * V[4] + J_pp[3] * V[3] + J_pp[5] * V[5]) * V[4]
                - 0.5 * (J_pp[2] * V[5] + J_pp[4] * V[3] + J_pp[5] * V[4]) * V[5]));
            if (locked[s] == 0) {
                const remus6_real share = side * table->flywheel[s].spin_inv;
                for (int i = 0; i < 6; ++i) {
                    rhs[i] -= drive[s].I_[i] * share;
                }
            }
            remus6_solve_schur(&factor, rhs, y);
            for (int i = 0; i < 6; ++i) {
                out->V_dot_phi[i][s] = y[i];
            }
            for (int t = 0; t < REMUS6_N; ++t) {
                out->phi_ddot_phi[t][s] = 0.0;
                if (locked[t] == 0) {
                    out->phi_ddot_phi[t][s] = (((t == s) ? side : 0.0)
                        - (y[0] * drive[t].I_[0] + y[1] * drive[t].I_[1] + y[2] * drive[t].I_[2]
                        + y[3] * drive[t].I_[3] + y[4] * drive[t].I_[4] + y[5] * drive[t].I_[5]))
                        * table->flywheel[t].spin_inv;
                }
            }
        }
        {
            change[0] = 0.0;        change[1] = 0.0;        change[2] = 0.0;
            change[3] = 0.0;        change[4] = -s_phi;     change[5] = c_phi;
            change[6] = -2.0 * s2;  change[7] = 2.0 * c2;   change[8] = -2.0 * ds;
            change[9] = 2.0 * dc;   change[10] = 1.0;       change[11] = 0.0;
            remus6_row_slope(&table->flywheel[s], change, V, V_result, g, rhs);
            remus6_solve_schur(&factor, rhs, y);
            for (int i = 0; i < 6; ++i) {
                out->V_dot_phi_dot[i][s] = y[i];
            }
            for (int t = 0; t < REMUS6_N; ++t) {
                out->phi_ddot_phi_dot[t][s] = 0.0;
                if (locked[t] == 0) {
                    out->phi_ddot_phi_dot[t][s] = (0.0
                        - (y[0] * drive[t].I_[0] + y[1] * drive[t].I_[1] + y[2] * drive[t].I_[2]
                        + y[3] * drive[t].I_[3] + y[4] * drive[t].I_[4] + y[5] * drive[t].I_[5]))
                        * table->flywheel[t].spin_inv;
                }
            }
        }
        rhs[0] = 0.0;  rhs[1] = 0.0;  rhs[2] = 0.0;
        rhs[3] = 0.0;  rhs[4] = 0.0;  rhs[5] = 0.0;
        const remus6_real side = 1.0;
        if (locked[s] == 0) {
            const remus6_real share = side * table->flywheel[s].spin_inv;
            for (int i = 0; i < 6; ++i) {
                rhs[i] -= drive[s].I_[i] * share;
            }
        }
        remus6_solve_schur(&factor, rhs, y);
        for (int i = 0; i < 6; ++i) {
            out->V_dot_tau[i][s] = y[i];
        }
        for (int t = 0; t < REMUS6_N; ++t) {
            out->phi_ddot_tau[t][s] = 0.0;
            if (locked[t] == 0) {
                out->phi_ddot_tau[t][s] = (((t == s) ? side : 0.0)
                    - (y[0] * drive[t].I_[0] + y[1] * drive[t].I_[1] + y[2] * drive[t].I_[2]
                    + y[3] * drive[t].I_[3] + y[4] * drive[t].I_[4] + y[5] * drive[t].I_[5]))
                    * table->flywheel[t].spin_inv;
            }
        }
    }
    return REMUS6_OK;
}

/* One-sided Jacobi rotations make the rows of W orthogonal: singular values without squaring the
 * condition. */
REMUS6_CODE
static void remus6_orthogonalise(remus6_inverse_work *restrict work)
{
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
            work->U[i][j] = 0.0;
        }
        work->U[i][i] = 1.0;
    }
    for (int sweep = 0; sweep < 9; ++sweep) {
        for (int p = 0; p < 5; ++p) {
            for (int q = p + 1; q < 6; ++q) {
                remus6_real a, b, g;
                a = 0.0;
                b = 0.0;
                g = 0.0;
                for (int j = 0; j < REMUS6_N; ++j) {
                    a += work->W[p][j] * work->W[p][j];
                    b += work->W[q][j] * work->W[q][j];
                    g += work->W[p][j] * work->W[q][j];
                }
                /* tangent of the smaller angle that makes the rows orthogonal */
                const remus6_real size = ((b - a < 0.0) ? -(b - a) : b - a) + 2.0 * ((g < 0.0) ? -g : g);
                /* scaled to size 1, so that no square underflows */
                const remus6_real unit = (size > 0.0) ? size : 1.0;
                const remus6_real d = (b - a) / unit;
                const remus6_real h = 2.0 * g / unit;
                const remus6_real root = remus6_sqrt(d * d + h * h);
                const remus6_real below = (d < 0.0) ? d - root : d + root;
                const remus6_real t = (((below < 0.0) ? -below : below) > 0.0)
                    ? h / ((((below < 0.0) ? -below : below) > 0.0) ? below : 1.0) : 0.0;
                const remus6_real c = 1.0 / remus6_sqrt(1.0 + t * t);
                const remus6_real s = c * t;
                for (int j = 0; j < REMUS6_N; ++j) {
                    const remus6_real x = work->W[p][j];
                    const remus6_real y = work->W[q][j];
                    work->W[p][j] = c * x - s * y;
                    work->W[q][j] = s * x + c * y;
                }
                for (int j = 0; j < 6; ++j) {
                    const remus6_real x = work->U[j][p];
                    const remus6_real y = work->U[j][q];
                    work->U[j][p] = c * x - s * y;  work->U[j][q] = s * x + c * y;
                }
                const remus6_real x = work->r[p];
                const remus6_real y = work->r[q];
                work->r[p] = c * x - s * y;  work->r[q] = s * x + c * y;
            }
        }
    }
    for (int i = 0; i < 6; ++i) {
        remus6_real total = 0.0;
        for (int j = 0; j < REMUS6_N; ++j) {
            total += work->W[i][j] * work->W[i][j];
        }
        work->sigma[i] = remus6_sqrt(total);
    }
}

/* Cholesky factor of the mass matrix, in place: K = G G^T. */
REMUS6_CODE
static remus6_status remus6_factor(remus6_inverse_work *restrict work)
{
    for (int j = 0; j < 6; ++j) {
        remus6_real pivot = work->G[j][j];
        for (int k = 0; k < j; ++k) {
            pivot -= work->G[j][k] * work->G[j][k];
        }
        if (!(pivot > 0.0)) { return REMUS6_NOT_POSITIVE_DEFINITE; }
        const remus6_real root = remus6_sqrt(pivot);
        work->G[j][j] = root;
        for (int i = j + 1; i < 6; ++i) {
            remus6_real rest = work->G[i][j];
            for (int k = 0; k < j; ++k) {
                rest -= work->G[i][k] * work->G[j][k];
            }
            work->G[i][j] = rest / root;
        }
    }
    return REMUS6_OK;
}

/* Matrix and right-hand side of (12) at a state: I, b, and both scaled to W, r, (12). */
REMUS6_CODE
static remus6_status remus6_demand(const remus6_table *table, const remus6_state *x,
                                   const remus6_real sine[REMUS6_N], const remus6_real cosine[REMUS6_N],
                                   const remus6_real V_dot[6], remus6_inverse_work *restrict work)
{
    remus6_status status;
    remus6_real C[9];  /* attitude */
    remus6_rotation(x->attitude, C);
    remus6_real u[3];  /* stream in E1 */
    remus6_rotate_back(C, table->stream, u);
    remus6_real V[6];  /* V relative to the stream: the fluid's frame is inertial as well */
    V[0] = x->V[0] - u[0];  V[1] = x->V[1] - u[1];  V[2] = x->V[2] - u[2];
    V[3] = x->V[3];         V[4] = x->V[4];         V[5] = x->V[5];
    remus6_real g[3];  /* gravity in E1 */
    remus6_rotate_back(C, table->gravity, g);
    remus6_sums sum;
    remus6_real drift[3];  /* omega x C^T u */
    drift[0] = u[2] * x->V[4] - u[1] * x->V[5];
    drift[1] = u[0] * x->V[5] - u[2] * x->V[3];
    drift[2] = u[1] * x->V[3] - u[0] * x->V[4];
    remus6_real V_r_dot[6];  /* V_r* = V* + (omega x C^T u, 0) */
    V_r_dot[0] = V_dot[0] + drift[0];  V_r_dot[1] = V_dot[1] + drift[1];  V_r_dot[2] = V_dot[2] + drift[2];
    V_r_dot[3] = V_dot[3];             V_r_dot[4] = V_dot[4];             V_r_dot[5] = V_dot[5];
    remus6_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    remus6_sum_steady_spin(table, sine, cosine, x->phi_dot, &sum);
    remus6_real F[6];  /* wrench (7); then the right-hand side of K V* + I phi'' = F */
    remus6_external(table, &sum, V, g, F);
    remus6_subtract_rates(table, &sum, V, F);
    work->G[0][0] = table->A[0];  work->G[0][1] = table->A[3];  work->G[0][2] = table->A[4];
    work->G[0][3] = table->G[0];
    work->G[0][4] = table->G[3] + sum.mu[2];
    work->G[0][5] = table->G[6] - sum.mu[1];
    work->G[1][0] = table->A[3];  work->G[1][1] = table->A[1];  work->G[1][2] = table->A[5];
    work->G[1][3] = table->G[1] - sum.mu[2];
    work->G[1][4] = table->G[4];
    work->G[1][5] = table->G[7] + sum.mu[0];
    work->G[2][0] = table->A[4];  work->G[2][1] = table->A[5];  work->G[2][2] = table->A[2];
    work->G[2][3] = table->G[2] + sum.mu[1];
    work->G[2][4] = table->G[5] - sum.mu[0];
    work->G[2][5] = table->G[8];
    work->G[3][0] = table->G[0];
    work->G[3][1] = table->G[1] - sum.mu[2];
    work->G[3][2] = table->G[2] + sum.mu[1];
    work->G[3][3] = sum.J[0];  work->G[3][4] = sum.J[3];  work->G[3][5] = sum.J[4];
    work->G[4][0] = table->G[3] + sum.mu[2];
    work->G[4][1] = table->G[4];
    work->G[4][2] = table->G[5] - sum.mu[0];
    work->G[4][3] = sum.J[3];  work->G[4][4] = sum.J[1];  work->G[4][5] = sum.J[5];
    work->G[5][0] = table->G[6] - sum.mu[1];
    work->G[5][1] = table->G[7] + sum.mu[0];
    work->G[5][2] = table->G[8];  work->G[5][3] = sum.J[4];     work->G[5][4] = sum.J[5];
    work->G[5][5] = sum.J[2];
    /* b = F - K V*: the wrench demanded of the flywheels */
    for (int i = 0; i < 6; ++i) {
        const remus6_real demanded = F[i] - work->G[i][0] * V_r_dot[0] - work->G[i][1] * V_r_dot[1]
            - work->G[i][2] * V_r_dot[2] - work->G[i][3] * V_r_dot[3] - work->G[i][4] * V_r_dot[4]
            - work->G[i][5] * V_r_dot[5];
        work->b[i] = demanded;
        work->r[i] = demanded;
    }
    status = remus6_factor(work);
    if (status != REMUS6_OK) { return status; }
    for (int s = 0; s < REMUS6_N; ++s) {
        const remus6_real s_phi = sine[s];
        const remus6_real c_phi = cosine[s];
        const remus6_real scale = table->flywheel[s].spin_root_inv;
        work->scale[s] = scale;
        work->I_[0][s] = table->flywheel[s].mu_s[0] * c_phi - table->flywheel[s].mu_c[0] * s_phi;
        work->I_[1][s] = table->flywheel[s].mu_s[1] * c_phi - table->flywheel[s].mu_c[1] * s_phi;
        work->I_[2][s] = table->flywheel[s].mu_s[2] * c_phi - table->flywheel[s].mu_c[2] * s_phi;
        work->I_[3][s] = table->flywheel[s].t_c[0] * c_phi + table->flywheel[s].t_s[0] * s_phi
            + table->flywheel[s].t_0[0];
        work->I_[4][s] = table->flywheel[s].t_c[1] * c_phi + table->flywheel[s].t_s[1] * s_phi
            + table->flywheel[s].t_0[1];
        work->I_[5][s] = table->flywheel[s].t_c[2] * c_phi + table->flywheel[s].t_s[2] * s_phi
            + table->flywheel[s].t_0[2];
        for (int i = 0; i < 6; ++i) {
            work->W[i][s] = work->I_[i][s] * scale;
        }
    }
    /* W = G^-1 I D^-1, r = G^-1 b: forward substitution */
    for (int i = 0; i < 6; ++i) {
        const remus6_real inverse = 1.0 / work->G[i][i];
        remus6_real rest;
        for (int s = 0; s < REMUS6_N; ++s) {
            rest = work->W[i][s];
            for (int k = 0; k < i; ++k) {
                rest -= work->G[i][k] * work->W[k][s];
            }
            work->W[i][s] = rest * inverse;
        }
        rest = work->r[i];
        for (int k = 0; k < i; ++k) {
            rest -= work->G[i][k] * work->r[k];
        }
        work->r[i] = rest * inverse;
    }
    return REMUS6_OK;
}

/* Solves gram z = z for a symmetric positive definite matrix by its Cholesky factor, in place. */
REMUS6_CODE
static void remus6_solve_gram(remus6_real (*restrict gram)[6] /* [6][6] */,
                              remus6_real *restrict z /* [6] */, remus6_real least)
{
    for (int j = 0; j < 6; ++j) {
        for (int k = 0; k < j; ++k) {
            gram[j][j] -= gram[j][k] * gram[j][k];
        }
        const remus6_real pivot = (gram[j][j] > least) ? gram[j][j] : least;
        gram[j][j] = remus6_sqrt(pivot);
        for (int i = j + 1; i < 6; ++i) {
            for (int k = 0; k < j; ++k) {
                gram[i][j] -= gram[i][k] * gram[j][k];
            }
            gram[i][j] = gram[i][j] / gram[j][j];
        }
        for (int k = 0; k < j; ++k) {
            z[j] -= gram[j][k] * z[k];
        }
        z[j] = z[j] / gram[j][j];
    }
    for (int t = 0; t < 6; ++t) {
        const int i = 5 - t;
        for (int k = i + 1; k < 6; ++k) {
            z[i] -= gram[k][i] * z[k];
        }
        z[i] = z[i] / gram[i][i];
    }
}

/* Distributes a demand among the flywheels: least weighted norm; what one at its limit lacks, the others
 * share, (12). */
REMUS6_CODE
static void remus6_allocate(const remus6_inverse_work *work, const remus6_inverse_options *options, int rank,
                            remus6_real *restrict phi_ddot /* [REMUS6_N] */,
                            int *restrict limited /* [REMUS6_N] */)
{
    remus6_real share[REMUS6_N];  /* 1/weight */
    remus6_real give[REMUS6_N];  /* 1/weight of a free flywheel, 0 for one held at its limit */
    remus6_real step[REMUS6_N];  /* increment of the free flywheels */
    remus6_real row[6];  /* factor of each row; 0: the row is left out */
    remus6_real gram[6][6];
    remus6_real z[6];
    int going, weighted;
    int settled;  /* 1 after a whole step that gains nothing and frees nobody */
    remus6_real square_before;  /* square of the residual after the last whole step */
    going = 1;
    weighted = 1;
    square_before = 1.7976931348623157e308;
    /* until the end phi_ddot holds y = D phi'' */
    for (int s = 0; s < REMUS6_N; ++s) {
        phi_ddot[s] = 0.0;
        limited[s] = 0;
        share[s] = 1.0 / options->weight[s];
    }
    for (int pass = 0; pass < 40; ++pass) {
        if (going > 0) {
            remus6_real most = 0.0;
            for (int s = 0; s < REMUS6_N; ++s) {
                give[s] = (limited[s] > 0) ? 0.0 : share[s];
                most = (give[s] > most) ? give[s] : most;
            }
            const remus6_real regular = 1.0e-12 * most;
            /* lower bound that keeps the diagonal positive */
            const remus6_real least = (most > 0.0) ? regular : 1.0;
            for (int i = 0; i < 6; ++i) {
                row[i] = 0.0;
                if (i < rank) {
                    row[i] = 1.0 / ((pass < 1) ? work->sigma[i] : work->sigma[0]);
                }
            }
            for (int i = 0; i < 6; ++i) {
                remus6_real left = work->r[i];
                for (int s = 0; s < REMUS6_N; ++s) {
                    left -= work->W[i][s] * phi_ddot[s];
                }
                z[i] = row[i] * left;
            }
            remus6_real weighed[REMUS6_N];  /* a row of W Omega^-1 */
            for (int i = 0; i < 6; ++i) {
                for (int s = 0; s < REMUS6_N; ++s) {
                    weighed[s] = work->W[i][s] * give[s];
                }
                for (int j = 0; j < i + 1; ++j) {
                    remus6_real total = 0.0;
                    for (int s = 0; s < REMUS6_N; ++s) {
                        total += weighed[s] * work->W[j][s];
                    }
                    gram[i][j] = row[i] * row[j] * total;
                }
                gram[i][i] += least;
            }
            remus6_solve_gram(gram, z, least);
            for (int i = 0; i < 6; ++i) {
                z[i] = row[i] * z[i];
            }
            for (int s = 0; s < REMUS6_N; ++s) {
                remus6_real total = 0.0;
                for (int i = 0; i < 6; ++i) {
                    total += work->W[i][s] * z[i];
                }
                step[s] = give[s] * total;
            }
            settled = 0;
            if (pass < 1) {
                for (int s = 0; s < REMUS6_N; ++s) {
                    phi_ddot[s] = step[s];
                    if (((step[s] < 0.0) ? -step[s] : step[s]) * work->scale[s] > options->limit[s]) {
                        const remus6_real bound = options->limit[s] / work->scale[s];
                        phi_ddot[s] = (step[s] < 0.0) ? -bound : bound;
                        limited[s] = 1;
                    }
                }
            } else {
                /* go as far as all limits allow; hold the flywheel that reaches its limit */
                remus6_real length = 1.0;
                int stopped = -1;
                for (int s = 0; s < REMUS6_N; ++s) {
                    const remus6_real moved = (phi_ddot[s] + step[s]) * work->scale[s];
                    if (limited[s] == 0 && ((moved < 0.0) ? -moved : moved) > options->limit[s]
                        && ((step[s] < 0.0) ? -step[s] : step[s]) > 0.0) {
                        const remus6_real room = options->limit[s] / work->scale[s]
                            - ((moved < 0.0) ? -phi_ddot[s] : phi_ddot[s]);
                        const remus6_real part = room / ((step[s] < 0.0) ? -step[s] : step[s]);
                        if (part < length) {
                            length = (part > 0.0) ? part : 0.0;
                            stopped = s;
                        }
                    }
                }
                for (int s = 0; s < REMUS6_N; ++s) {
                    phi_ddot[s] += length * step[s];
                    if (stopped == s) {
                        const remus6_real bound = options->limit[s] / work->scale[s];
                        phi_ddot[s] = (step[s] < 0.0) ? -bound : bound;
                        limited[s] = 1;
                    }
                }
                /* after a full step, release the held flywheel that would lower the residual most */
                if (stopped < 0) {
                    remus6_real left[6];
                    remus6_real wanted;
                    remus6_real square;  /* of the residual */
                    wanted = 0.0;
                    square = 0.0;
                    for (int i = 0; i < 6; ++i) {
                        wanted += work->r[i] * work->r[i];
                        left[i] = (i < rank) ? work->r[i] : 0.0;
                        if (i < rank) {
                            for (int s = 0; s < REMUS6_N; ++s) {
                                left[i] -= work->W[i][s] * phi_ddot[s];
                            }
                        }
                        square += left[i] * left[i];
                    }
                    remus6_real best = 1.0e-18 * wanted;  /* smaller gains are ignored */
                    int freed = -1;
                    for (int s = 0; s < REMUS6_N; ++s) {
                        if (limited[s] > 0) {
                            remus6_real slope = 0.0;
                            remus6_real size = 0.0;
                            for (int i = 0; i < 6; ++i) {
                                slope += work->W[i][s] * left[i];
                                size += work->W[i][s] * work->W[i][s];
                            }
                            const remus6_real inward = (phi_ddot[s] > 0.0) ? -slope : slope;
                            if (inward > 0.0 && inward * inward > best * size) {
                                best = inward * inward / size;
                                freed = s;
                            }
                        }
                    }
                    if (freed >= 0) {
                        limited[freed] = 0;
                    } else {
                        if (!(square > best && square < square_before * 0.999999999)) {
                            settled = 1;
                        }
                    }
                    square_before = square;
                }
            }
            if (pass >= 8 && (settled > 0 || pass == 20)) {
                going = weighted;
                weighted = 0;
                for (int s = 0; s < REMUS6_N; ++s) {
                    share[s] = 1.0;
                }
            }
        }
    }
    /* the product may round an answer that just reaches its limit beyond it; what overflows is refused
     * later */
    for (int s = 0; s < REMUS6_N; ++s) {
        const remus6_real found = phi_ddot[s] * work->scale[s];
        phi_ddot[s] = found;
        if (limited[s] > 0 || (((found < 0.0) ? -found : found) > options->limit[s]
            && ((found < 0.0) ? -found : found) <= REMUS6_LARGEST)) {
            phi_ddot[s] = (found < 0.0) ? -options->limit[s] : options->limit[s];
        }
    }
}

/* Does a motor lack the torque tau, with its friction, at this speed? Its no-load speed is above 0. */
REMUS6_CODE
static int remus6_motor_lacks(const remus6_inverse_options *options, int number, remus6_real tau,
                              remus6_real speed)
{
    /* of the motor itself, which bears the friction */
    remus6_real own = tau + options->motor_viscous[number] * speed;
    if (options->motor_coulomb[number] > 0.0 && options->motor_coulomb_speed[number] > 0.0) {
        const remus6_real ratio = speed / options->motor_coulomb_speed[number];
        const remus6_real y = (ratio > 3.0) ? 3.0 : ((ratio < -3.0) ? -3.0 : ratio);  /* tanh y to 0.024 */
        const remus6_real square = y * y;
        own += options->motor_coulomb[number] * (y * (27.0 + square) / (27.0 + 9.0 * square));
    }
    /* driving, the torque falls linearly to zero at the no-load speed; braking has all of it */
    remus6_real share = 1.0;
    if (own * speed > 0.0) {
        share = 1.0 - ((speed < 0.0) ? -speed : speed) / options->motor_speed[number];
    }
    return (share <= 0.0 || ((own < 0.0) ? -own : own) > options->motor_torque[number] * share) ? 1 : 0;
}

/* Does a motion need more than a motor's torque or speed, or a larger phi'' than `most`? Of checked
 * inputs. */
REMUS6_CODE
static void remus6_excessive(const remus6_table *table, const remus6_state *x,
                             const remus6_real sine[REMUS6_N], const remus6_real cosine[REMUS6_N],
                             const remus6_real V_dot[6], const remus6_real phi_ddot[REMUS6_N],
                             const remus6_inverse_options *options, int *restrict flags)
{
    int motors;  /* flywheels whose motor has a limit */
    int found;
    motors = 0;
    found = 0;
    for (int s = 0; s < REMUS6_N; ++s) {
        if (((phi_ddot[s] < 0.0) ? -phi_ddot[s] : phi_ddot[s]) > options->most[s]) {
            found = REMUS6_EXCESSIVE;
        }
        if (options->motor_torque[s] < REMUS6_LARGEST || options->motor_speed[s] < REMUS6_LARGEST) {
            motors = motors + 1;
        }
    }
    if (motors > 0) {
        remus6_real tau[REMUS6_N];  /* drive torques */
        remus6_balance(table, x, sine, cosine, V_dot, phi_ddot, tau);
        for (int s = 0; s < REMUS6_N; ++s) {
            if (remus6_motor_lacks(options, s, tau[s], x->phi_dot[s]) != 0) {
                found = REMUS6_EXCESSIVE;
            }
        }
    }
    *flags = found;
}

/* (12) */
REMUS6_CODE
remus6_status remus6_inverse(const remus6_table *table, const remus6_state *x, const remus6_real V_dot[6],
                             const remus6_inverse_options *options, remus6_inverse_result *out)
{
    if (table == NULL || x == NULL || V_dot == NULL || options == NULL
        || out == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(V_dot, 6, REMUS6_MAX_ACCELERATION);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(options->weight, REMUS6_N, REMUS6_MAX_WEIGHT);
    if (status != REMUS6_OK) { return status; }
    remus6_real shares[2];
    shares[0] = options->near_singular;
    shares[1] = options->damping;
    status = remus6_within(shares, 2, REMUS6_LARGEST);
    if (status != REMUS6_OK) { return status; }
    if (!(shares[0] >= 0.0 && shares[0] <= 1.0)) { return REMUS6_BAD_ARGUMENT; }
    if (!(shares[1] >= 0.0 && shares[1] <= 1.0)) { return REMUS6_BAD_ARGUMENT; }
    for (int s = 0; s < REMUS6_N; ++s) {
        if (!(options->weight[s] >= 1.0e-6)) { return REMUS6_RANGE; }
    }
    for (int s = 0; s < REMUS6_N; ++s) {
        if (!(options->limit[s] > 0.0 || options->limit[s] <= 0.0)) { return REMUS6_NOT_FINITE; }
        if (options->limit[s] <= 0.0) { return REMUS6_BAD_ARGUMENT; }
        if (!(options->most[s] > 0.0 || options->most[s] <= 0.0)) { return REMUS6_NOT_FINITE; }
        if (!(options->motor_torque[s] > 0.0
            || options->motor_torque[s] <= 0.0)) { return REMUS6_NOT_FINITE; }
        if (!(options->motor_speed[s] > 0.0 || options->motor_speed[s] <= 0.0)) { return REMUS6_NOT_FINITE; }
        if (options->most[s] <= 0.0 || options->motor_torque[s] < 0.0
            || options->motor_speed[s] <= 0.0) { return REMUS6_BAD_ARGUMENT; }
        if (!(options->motor_viscous[s] > 0.0
            || options->motor_viscous[s] <= 0.0)) { return REMUS6_NOT_FINITE; }
        if (!(options->motor_coulomb[s] > 0.0
            || options->motor_coulomb[s] <= 0.0)) { return REMUS6_NOT_FINITE; }
        if (!(options->motor_coulomb_speed[s] > 0.0
            || options->motor_coulomb_speed[s] <= 0.0)) { return REMUS6_NOT_FINITE; }
        if (options->motor_viscous[s] < 0.0 || options->motor_coulomb[s] < 0.0
            || options->motor_coulomb_speed[s] <= 0.0) { return REMUS6_BAD_ARGUMENT; }
    }
    remus6_inverse_work work;
    remus6_real answer[REMUS6_N];  /* phi'' */
    int limited[REMUS6_N];
    remus6_real residual[6];
    remus6_real sine[REMUS6_N];
    remus6_real cosine[REMUS6_N];
    remus6_sincos_each(x->phi, sine, cosine);
    status = remus6_demand(table, x, sine, cosine, V_dot, &work);
    if (status != REMUS6_OK) { return status; }
    remus6_real wanted = 0.0;
    for (int i = 0; i < 6; ++i) {
        wanted += work.r[i] * work.r[i];
    }
    remus6_orthogonalise(&work);
    /* sort the singular values in descending order, by exchanging neighbours */
    for (int pass = 0; pass < 5; ++pass) {
        for (int i = 0; i < 5; ++i) {
            if (work.sigma[i] < work.sigma[i + 1]) {
                const remus6_real kept_sigma = work.sigma[i];
                work.sigma[i] = work.sigma[i + 1];  work.sigma[i + 1] = kept_sigma;
                const remus6_real kept_r = work.r[i];
                work.r[i] = work.r[i + 1];  work.r[i + 1] = kept_r;
                for (int j = 0; j < REMUS6_N; ++j) {
                    const remus6_real kept = work.W[i][j];
                    work.W[i][j] = work.W[i + 1][j];
                    work.W[i + 1][j] = kept;
                }
                for (int j = 0; j < 6; ++j) {
                    const remus6_real kept = work.U[j][i];
                    work.U[j][i] = work.U[j][i + 1];  work.U[j][i + 1] = kept;
                }
            }
        }
    }
    int flags, rank;
    remus6_real damping;
    flags = 0;
    rank = 0;
    damping = 0.0;
    for (int i = 0; i < 6; ++i) {
        if (work.sigma[i] > 1.0e-9 * work.sigma[0]) {
            rank = rank + 1;
            const remus6_real ratio = work.sigma[i] / work.sigma[0];
            if (ratio < options->near_singular) {
                flags = flags | REMUS6_NEAR_SINGULAR;
                if (options->damping > 0.0) {
                    flags = flags | REMUS6_DAMPED;
                    const remus6_real lambda = options->damping * work.sigma[0]
                        * (1.0 - ratio / options->near_singular);
                    const remus6_real square = work.sigma[i] * work.sigma[i];
                    work.r[i] = work.r[i] * (square / (square + lambda * lambda));
                    damping = (lambda > damping) ? lambda : damping;
                }
            }
        }
    }
    remus6_allocate(&work, options, rank, answer, limited);
    for (int s = 0; s < REMUS6_N; ++s) {
        if (limited[s] > 0) {
            flags = flags | REMUS6_LIMITED;
        }
    }
    if (rank < 6) {
        flags = flags | REMUS6_RANK_DEFICIENT;
    }
    remus6_real moved[6];  /* V* that results: V_dot + K^-1 residual */
    remus6_real left;
    remus6_real z[6];  /* G^-1 residual */
    left = 0.0;
    for (int i = 0; i < 6; ++i) {
        residual[i] = work.b[i];
        for (int s = 0; s < REMUS6_N; ++s) {
            residual[i] -= work.I_[i][s] * answer[s];
        }
    }
    for (int i = 0; i < 6; ++i) {
        z[i] = residual[i];
        for (int k = 0; k < i; ++k) {
            z[i] -= work.G[i][k] * z[k];
        }
        z[i] = z[i] / work.G[i][i];
        left += z[i] * z[i];
    }
    if (left > 1.0e-18 * wanted) {
        flags = flags | REMUS6_UNREACHABLE;
    }
    for (int t = 0; t < 6; ++t) {
        const int i = 5 - t;
        for (int k = i + 1; k < 6; ++k) {
            z[i] -= work.G[k][i] * z[k];
        }
        z[i] = z[i] / work.G[i][i];
        moved[i] = V_dot[i] + z[i];
    }
    status = remus6_within(answer, REMUS6_N, REMUS6_LARGEST);
    if (status != REMUS6_OK) { return REMUS6_RANGE; }
    status = remus6_within(residual, 6, REMUS6_LARGEST);
    if (status != REMUS6_OK) { return REMUS6_RANGE; }
    int lacking;
    remus6_excessive(table, x, sine, cosine, moved, answer, options, &lacking);
    flags = flags | lacking;
    for (int s = 0; s < REMUS6_N; ++s) {
        out->phi_ddot[s] = answer[s];
        out->limited[s] = limited[s];
    }
    for (int i = 0; i < 6; ++i) {
        out->residual[i] = residual[i];
    }
    /* unreachable: the demand's part in the rows left out; if no row is left out, the last row */
    remus6_real part[6];
    for (int i = 0; i < 6; ++i) {
        part[i] = (i < rank) ? 0.0 : work.r[i];
    }
    remus6_real largest = 0.0;
    for (int i = 0; i < 6; ++i) {
        const remus6_real size = (part[i] < 0.0) ? -part[i] : part[i];
        largest = (size > largest) ? size : largest;
    }
    if (!(largest > 0.0)) {
        part[5] = 1.0;
        largest = 1.0;
    }
    remus6_real square = 0.0;
    for (int i = 0; i < 6; ++i) {
        part[i] = part[i] / largest;
        square += part[i] * part[i];
    }
    const remus6_real length = remus6_sqrt(square);
    remus6_real u[6];  /* U part: a unit vector in the norm of K^-1; its wrench is G u */
    for (int k = 0; k < 6; ++k) {
        u[k] = 0.0;
        for (int i = 0; i < 6; ++i) {
            u[k] += work.U[k][i] * part[i];
        }
        u[k] = u[k] / length;
    }
    for (int i = 0; i < 6; ++i) {
        out->hardest[i] = 0.0;
        for (int k = 0; k < i + 1; ++k) {
            out->hardest[i] += work.G[i][k] * u[k];
        }
    }
    out->rank = rank;
    out->damped_by = damping;
    for (int i = 0; i < 6; ++i) {
        out->sigma[i] = work.sigma[i];
    }
    return (remus6_status)flags;
}

/* (12) */
REMUS6_CODE
remus6_status remus6_inverse_fast(const remus6_table *table, const remus6_state *x,
                                  const remus6_real V_dot[6], const remus6_inverse_options *options,
                                  remus6_real phi_ddot[REMUS6_N])
{
    if (table == NULL || x == NULL || V_dot == NULL || options == NULL
        || phi_ddot == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(V_dot, 6, REMUS6_MAX_ACCELERATION);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(options->weight, REMUS6_N, REMUS6_MAX_WEIGHT);
    if (status != REMUS6_OK) { return status; }
    remus6_real shares[1];
    shares[0] = options->damping;
    status = remus6_within(shares, 1, REMUS6_LARGEST);
    if (status != REMUS6_OK) { return status; }
    if (!(shares[0] >= 0.0 && shares[0] <= 1.0)) { return REMUS6_BAD_ARGUMENT; }
    for (int s = 0; s < REMUS6_N; ++s) {
        if (!(options->weight[s] >= 1.0e-6)) { return REMUS6_RANGE; }
    }
    remus6_inverse_work work;
    remus6_real sine[REMUS6_N];
    remus6_real cosine[REMUS6_N];
    remus6_sincos_each(x->phi, sine, cosine);
    status = remus6_demand(table, x, sine, cosine, V_dot, &work);
    if (status != REMUS6_OK) { return status; }
    remus6_real answer[REMUS6_N];
    /* normal equations: W Omega^-1 W^T z = r, y = Omega^-1 W^T z; I has had its use, W Omega^-1 is there */
    for (int s = 0; s < REMUS6_N; ++s) {
        const remus6_real give = 1.0 / options->weight[s];
        for (int i = 0; i < 6; ++i) {
            work.I_[i][s] = work.W[i][s] * give;
        }
    }
    remus6_real gram[6][6];
    remus6_real z[6];
    remus6_real trace = 0.0;
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < i + 1; ++j) {
            remus6_real total = 0.0;
            for (int s = 0; s < REMUS6_N; ++s) {
                total += work.I_[i][s] * work.W[j][s];
            }
            gram[i][j] = total;
        }
        trace += gram[i][i];
        z[i] = work.r[i];
    }
    const remus6_real lambda2 = options->damping * options->damping * trace;  /* square of the damping */
    for (int i = 0; i < 6; ++i) {
        gram[i][i] += lambda2;
    }
    for (int j = 0; j < 6; ++j) {
        remus6_real pivot = gram[j][j];
        const remus6_real least = 1.0e-13 * pivot;  /* a pivot below this is rounding error */
        remus6_real rest = z[j];
        for (int k = 0; k < j; ++k) {
            pivot -= gram[j][k] * gram[k][j];
            rest -= gram[k][j] * z[k];
        }
        z[j] = rest;
        if (!(pivot > least)) { return REMUS6_NOT_POSITIVE_DEFINITE; }
        gram[j][j] = pivot;
        for (int i = j + 1; i < 6; ++i) {
            remus6_real below = gram[i][j];
            for (int k = 0; k < j; ++k) {
                below -= gram[i][k] * gram[k][j];
            }
            gram[i][j] = below;
            gram[j][i] = below / pivot;
        }
    }
    for (int t = 0; t < 6; ++t) {
        const int i = 5 - t;
        remus6_real rest = z[i] / gram[i][i];
        for (int k = i + 1; k < 6; ++k) {
            rest -= gram[i][k] * z[k];
        }
        z[i] = rest;
    }
    for (int s = 0; s < REMUS6_N; ++s) {
        remus6_real y = 0.0;
        for (int i = 0; i < 6; ++i) {
            y += work.I_[i][s] * z[i];
        }
        answer[s] = y * work.scale[s];
    }
    status = remus6_within(answer, REMUS6_N, REMUS6_LARGEST);
    if (status != REMUS6_OK) { return REMUS6_RANGE; }
    int flags = 0;
    for (int s = 0; s < REMUS6_N; ++s) {
        if (flags == 0 && options->motor_speed[s] > 0.0) {
            const remus6_real v = x->phi_dot[s];
            const remus6_real spin = table->flywheel[s].spin;
            const remus6_real size = (answer[s] < 0.0) ? -answer[s] : answer[s];
            /* at most */
            const remus6_real needed = spin * size + options->motor_viscous[s] * ((v < 0.0) ? -v : v)
                + options->motor_coulomb[s];
            /* at least: when driving */
            const remus6_real has = options->motor_torque[s]
                * (1.0 - ((v < 0.0) ? -v : v) / options->motor_speed[s]);
            if (!(size <= options->most[s] && needed <= has)) {
                if (size > options->most[s] || remus6_motor_lacks(options, s, spin * answer[s], v) != 0) {
                    flags = REMUS6_EXCESSIVE;
                }
            }
        }
    }
    for (int s = 0; s < REMUS6_N; ++s) {
        phi_ddot[s] = answer[s];
    }
    return (remus6_status)flags;
}

/* Reading of an accelerometer and a gyro at one instrument or point. */
REMUS6_CODE
static void remus6_sense(const remus6_sensor *sensor, const remus6_real r[3], const remus6_real V[6],
                         const remus6_real V_dot[6], const remus6_real C[9], const remus6_real g[3],
                         remus6_points_result *restrict out)
{
    remus6_real velocity[3];  /* in E1 */
    remus6_real force[3];  /* acceleration minus gravity, in E1 */
    velocity[0] = sensor->origin[2] * V[4] + V[0] - sensor->origin[1] * V[5];
    velocity[1] = sensor->origin[0] * V[5] + V[1] - sensor->origin[2] * V[3];
    velocity[2] = sensor->origin[1] * V[3] + V[2] - sensor->origin[0] * V[4];
    force[0] = sensor->origin[2] * V_dot[4] + V[4] * velocity[2] + V_dot[0] - sensor->origin[1] * V_dot[5]
        - g[0] - V[5] * velocity[1];
    force[1] = sensor->origin[0] * V_dot[5] + V[5] * velocity[0] + V_dot[1] - sensor->origin[2] * V_dot[3]
        - g[1] - V[3] * velocity[2];
    force[2] = sensor->origin[1] * V_dot[3] + V[3] * velocity[1] + V_dot[2] - sensor->origin[0] * V_dot[4]
        - g[2] - V[4] * velocity[0];
    out->position[0] = C[0] * sensor->origin[0] + C[1] * sensor->origin[1] + C[2] * sensor->origin[2] + r[0];
    out->position[1] = C[3] * sensor->origin[0] + C[4] * sensor->origin[1] + C[5] * sensor->origin[2] + r[1];
    out->position[2] = C[6] * sensor->origin[0] + C[7] * sensor->origin[1] + C[8] * sensor->origin[2] + r[2];
    out->C[0][0] = C[0] * sensor->axes[0] + C[1] * sensor->axes[3] + C[2] * sensor->axes[6];
    out->C[0][1] = C[0] * sensor->axes[1] + C[1] * sensor->axes[4] + C[2] * sensor->axes[7];
    out->C[0][2] = C[0] * sensor->axes[2] + C[1] * sensor->axes[5] + C[2] * sensor->axes[8];
    out->C[1][0] = C[3] * sensor->axes[0] + C[4] * sensor->axes[3] + C[5] * sensor->axes[6];
    out->C[1][1] = C[3] * sensor->axes[1] + C[4] * sensor->axes[4] + C[5] * sensor->axes[7];
    out->C[1][2] = C[3] * sensor->axes[2] + C[4] * sensor->axes[5] + C[5] * sensor->axes[8];
    out->C[2][0] = C[6] * sensor->axes[0] + C[7] * sensor->axes[3] + C[8] * sensor->axes[6];
    out->C[2][1] = C[6] * sensor->axes[1] + C[7] * sensor->axes[4] + C[8] * sensor->axes[7];
    out->C[2][2] = C[6] * sensor->axes[2] + C[7] * sensor->axes[5] + C[8] * sensor->axes[8];
    out->twist[0] = sensor->axes[0] * velocity[0] + sensor->axes[3] * velocity[1]
        + sensor->axes[6] * velocity[2];
    out->twist[1] = sensor->axes[1] * velocity[0] + sensor->axes[4] * velocity[1]
        + sensor->axes[7] * velocity[2];
    out->twist[2] = sensor->axes[2] * velocity[0] + sensor->axes[5] * velocity[1]
        + sensor->axes[8] * velocity[2];
    out->twist[3] = sensor->axes[0] * V[3] + sensor->axes[3] * V[4] + sensor->axes[6] * V[5];
    out->twist[4] = sensor->axes[1] * V[3] + sensor->axes[4] * V[4] + sensor->axes[7] * V[5];
    out->twist[5] = sensor->axes[2] * V[3] + sensor->axes[5] * V[4] + sensor->axes[8] * V[5];
    out->specific_force[0] = sensor->axes[0] * force[0] + sensor->axes[3] * force[1]
        + sensor->axes[6] * force[2];
    out->specific_force[1] = sensor->axes[1] * force[0] + sensor->axes[4] * force[1]
        + sensor->axes[7] * force[2];
    out->specific_force[2] = sensor->axes[2] * force[0] + sensor->axes[5] * force[1]
        + sensor->axes[8] * force[2];
    out->angular_acceleration[0] = sensor->axes[0] * V_dot[3] + sensor->axes[3] * V_dot[4]
        + sensor->axes[6] * V_dot[5];
    out->angular_acceleration[1] = sensor->axes[1] * V_dot[3] + sensor->axes[4] * V_dot[4]
        + sensor->axes[7] * V_dot[5];
    out->angular_acceleration[2] = sensor->axes[2] * V_dot[3] + sensor->axes[5] * V_dot[4]
        + sensor->axes[8] * V_dot[5];
}

/* Readings of an accelerometer and a gyro at each instrument and point. */
REMUS6_CODE
remus6_status remus6_points(const remus6_table *table, const remus6_state *x, const remus6_real V_dot[6],
                            remus6_points_result out[REMUS6_SENSORS])
{
    if (table == NULL || x == NULL || V_dot == NULL || out == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(V_dot, 6, REMUS6_MAX_ACCELERATION);
    if (status != REMUS6_OK) { return status; }
    remus6_real C[9];  /* attitude */
    remus6_rotation(x->attitude, C);
    remus6_real g[3];  /* gravity in E1 */
    remus6_rotate_back(C, table->gravity, g);
    for (int k = 0; k < REMUS6_SENSORS; ++k) {
        remus6_sense(&table->sensor[k], x->position, x->V, V_dot, C, g, &out[k]);
    }
    return REMUS6_OK;
}

/* Attitude quaternion of three angles. */
REMUS6_CODE
remus6_status remus6_quaternion(const remus6_real angles[3], remus6_real attitude[4])
{
    if (angles == NULL || attitude == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status;
    if (!(angles[0] * angles[0] + angles[1] * angles[1]
        + angles[2] * angles[2] < REMUS6_MAX_PHASE * REMUS6_MAX_PHASE)) {
        status = remus6_within(angles, 3, REMUS6_MAX_PHASE);
        if (status != REMUS6_OK) { return status; }
    }
    remus6_real s_psi, c_psi;
    remus6_sincos(0.5 * angles[0], &s_psi, &c_psi);
    remus6_real s_theta, c_theta;
    remus6_sincos(0.5 * angles[1], &s_theta, &c_theta);
    remus6_real s_phi, c_phi;
    remus6_sincos(0.5 * angles[2], &s_phi, &c_phi);
    attitude[0] = c_phi * c_psi * c_theta + s_phi * s_psi * s_theta;
    attitude[1] = c_psi * c_theta * s_phi - c_phi * s_psi * s_theta;
    attitude[2] = c_phi * c_psi * s_theta + c_theta * s_phi * s_psi;
    attitude[3] = c_phi * c_theta * s_psi - c_psi * s_phi * s_theta;
    return REMUS6_OK;
}

/* (10) */
REMUS6_CODE
remus6_status remus6_state_from_coordinates(const remus6_real position[3], const remus6_real angles[3],
                                            const remus6_real q_dot[6], const remus6_real q_ddot[6],
                                            remus6_state *x, remus6_real V_dot[6])
{
    if (position == NULL || angles == NULL || q_dot == NULL || q_ddot == NULL || x == NULL
        || V_dot == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status;
    if (!(position[0] * position[0] + position[1] * position[1]
        + position[2] * position[2] < REMUS6_MAX_POSITION * REMUS6_MAX_POSITION)) {
        status = remus6_within(position, 3, REMUS6_MAX_POSITION);
        if (status != REMUS6_OK) { return status; }
    }
    status = remus6_within(q_dot, 6, REMUS6_MAX_SPEED);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(q_ddot, 6, REMUS6_MAX_ACCELERATION);
    if (status != REMUS6_OK) { return status; }
    remus6_real attitude[4];
    remus6_real C[9];
    remus6_real v[3];  /* C^T r' */
    remus6_real a[3];  /* C^T r'' */
    remus6_real omega[3];  /* B (psi', theta', phi') */
    status = remus6_quaternion(angles, attitude);
    if (status != REMUS6_OK) { return status; }
    remus6_real s_theta, c_theta;
    remus6_sincos(angles[1], &s_theta, &c_theta);
    remus6_real s_phi, c_phi;
    remus6_sincos(angles[2], &s_phi, &c_phi);
    const remus6_real singular = c_theta;
    if (((singular < 0.0) ? -singular : singular) < 1.0e-6) { return REMUS6_SINGULAR_ATTITUDE; }
    remus6_rotation(attitude, C);
    v[0] = C[0] * q_dot[0] + C[3] * q_dot[1] + C[6] * q_dot[2];
    v[1] = C[1] * q_dot[0] + C[4] * q_dot[1] + C[7] * q_dot[2];
    v[2] = C[2] * q_dot[0] + C[5] * q_dot[1] + C[8] * q_dot[2];
    a[0] = C[0] * q_ddot[0] + C[3] * q_ddot[1] + C[6] * q_ddot[2];
    a[1] = C[1] * q_ddot[0] + C[4] * q_ddot[1] + C[7] * q_ddot[2];
    a[2] = C[2] * q_ddot[0] + C[5] * q_ddot[1] + C[8] * q_ddot[2];
    omega[0] = q_dot[5] - q_dot[3] * s_theta;
    omega[1] = q_dot[3] * c_theta * s_phi + q_dot[4] * c_phi;
    omega[2] = q_dot[3] * c_phi * c_theta - q_dot[4] * s_phi;
    /* V* = A q'' + D q': v* = C^T r'' - omega x v */
    V_dot[0] = v[1] * omega[2] + a[0] - v[2] * omega[1];
    V_dot[1] = v[2] * omega[0] + a[1] - v[0] * omega[2];
    V_dot[2] = v[0] * omega[1] + a[2] - v[1] * omega[0];
    V_dot[3] = q_ddot[5] - q_ddot[3] * s_theta - q_dot[3] * c_theta * q_dot[4];
    V_dot[4] = q_ddot[3] * c_theta * s_phi + q_ddot[4] * c_phi
        + q_dot[3] * (c_phi * c_theta * q_dot[5] - s_phi * s_theta * q_dot[4]) - q_dot[4] * q_dot[5] * s_phi;
    V_dot[5] = q_ddot[3] * c_phi * c_theta
        + q_dot[3] * (-c_phi * s_theta * q_dot[4] - c_theta * q_dot[5] * s_phi) - q_ddot[4] * s_phi
        - q_dot[4] * c_phi * q_dot[5];
    x->position[0] = position[0];  x->position[1] = position[1];  x->position[2] = position[2];
    x->attitude[0] = attitude[0];  x->attitude[1] = attitude[1];  x->attitude[2] = attitude[2];
    x->attitude[3] = attitude[3];
    x->V[0] = v[0];      x->V[3] = omega[0];  x->V[1] = v[1];
    x->V[4] = omega[1];  x->V[2] = v[2];      x->V[5] = omega[2];
    return REMUS6_OK;
}

/* I0 = K A, J0 = K D + M A, (11). */
REMUS6_CODE
static void remus6_products(const remus6_matrices_result *m, remus6_generalized_result *restrict out)
{
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
            remus6_real I0, J0;
            I0 = 0.0;
            J0 = 0.0;
            for (int k = 0; k < 6; ++k) {
                I0 += m->K[i][k] * out->A[k][j];
                J0 += m->K[i][k] * out->D[k][j] + m->M[i][k] * out->A[k][j];
            }
            out->I0[i][j] = I0;
            out->J0[i][j] = J0;
        }
    }
}

/* (10), (11) */
REMUS6_CODE
remus6_status remus6_generalized(const remus6_table *table, const remus6_state *x,
                                 const remus6_real angles[3], const remus6_real phi_ddot[REMUS6_N],
                                 remus6_generalized_result *out)
{
    if (table == NULL || x == NULL || angles == NULL || phi_ddot == NULL
        || out == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status;
    remus6_state y;  /* the state with the attitude of the angles */
    remus6_real V_dot[6];
    remus6_matrices_result m;
    y = *x;
    status = remus6_quaternion(angles, y.attitude);
    if (status != REMUS6_OK) { return status; }
    remus6_real s_theta, c_theta;
    remus6_sincos(angles[1], &s_theta, &c_theta);
    remus6_real s_phi, c_phi;
    remus6_sincos(angles[2], &s_phi, &c_phi);
    const remus6_real singular = c_theta;  /* A has no inverse where this is 0 */
    status = remus6_forward(table, &y, phi_ddot, V_dot);
    if (status != REMUS6_OK) { return status; }
    status = remus6_matrices(table, &y, &m);
    if (status != REMUS6_OK) { return status; }
    if (((singular < 0.0) ? -singular : singular) < 1.0e-6) { return REMUS6_SINGULAR_ATTITUDE; }
    /* J0 of (11) holds M at V itself, not relative to the stream */
    remus6_velocity_matrix(x->V, &m);
    remus6_real C[9];
    remus6_rotation(y.attitude, C);
    const remus6_real singular_inv = 1.0 / singular;
    /* q' = A^-1 V */
    out->q_dot[0] = C[0] * x->V[0] + C[1] * x->V[1] + C[2] * x->V[2];
    out->q_dot[1] = C[3] * x->V[0] + C[4] * x->V[1] + C[5] * x->V[2];
    out->q_dot[2] = C[6] * x->V[0] + C[7] * x->V[1] + C[8] * x->V[2];
    out->q_dot[3] = x->V[4] * s_phi * singular_inv + x->V[5] * c_phi * singular_inv;
    out->q_dot[4] = x->V[4] * c_phi - x->V[5] * s_phi;
    out->q_dot[5] = x->V[3] + x->V[4] * s_phi * s_theta * singular_inv
        + x->V[5] * c_phi * s_theta * singular_inv;
    out->A[0][0] = C[0];  out->A[0][1] = C[3];  out->A[0][2] = C[6];
    out->A[0][3] = 0.0;   out->A[0][4] = 0.0;   out->A[0][5] = 0.0;
    out->A[1][0] = C[1];  out->A[1][1] = C[4];  out->A[1][2] = C[7];
    out->A[1][3] = 0.0;   out->A[1][4] = 0.0;   out->A[1][5] = 0.0;
    out->A[2][0] = C[2];  out->A[2][1] = C[5];  out->A[2][2] = C[8];
    out->A[2][3] = 0.0;   out->A[2][4] = 0.0;   out->A[2][5] = 0.0;
    out->A[3][0] = 0.0;       out->A[3][1] = 0.0;       out->A[3][2] = 0.0;
    out->A[3][3] = -s_theta;  out->A[3][4] = 0.0;       out->A[3][5] = 1.0;
    out->A[4][0] = 0.0;              out->A[4][1] = 0.0;              out->A[4][2] = 0.0;
    out->A[4][3] = c_theta * s_phi;  out->A[4][4] = c_phi;            out->A[4][5] = 0.0;
    out->A[5][0] = 0.0;              out->A[5][1] = 0.0;              out->A[5][2] = 0.0;
    out->A[5][3] = c_phi * c_theta;  out->A[5][4] = -s_phi;           out->A[5][5] = 0.0;
    out->D[0][0] = C[1] * x->V[5] - C[2] * x->V[4];
    out->D[0][1] = C[4] * x->V[5] - C[5] * x->V[4];
    out->D[0][2] = C[7] * x->V[5] - C[8] * x->V[4];
    out->D[0][3] = 0.0;  out->D[0][4] = 0.0;  out->D[0][5] = 0.0;
    out->D[1][0] = C[2] * x->V[3] - C[0] * x->V[5];
    out->D[1][1] = C[5] * x->V[3] - C[3] * x->V[5];
    out->D[1][2] = C[8] * x->V[3] - C[6] * x->V[5];
    out->D[1][3] = 0.0;  out->D[1][4] = 0.0;  out->D[1][5] = 0.0;
    out->D[2][0] = C[0] * x->V[4] - C[1] * x->V[3];
    out->D[2][1] = C[3] * x->V[4] - C[4] * x->V[3];
    out->D[2][2] = C[6] * x->V[4] - C[7] * x->V[3];
    out->D[2][3] = 0.0;  out->D[2][4] = 0.0;  out->D[2][5] = 0.0;
    out->D[3][0] = 0.0;  out->D[3][1] = 0.0;  out->D[3][2] = 0.0;
    out->D[3][3] = -c_theta * out->q_dot[4];
    out->D[3][4] = 0.0;  out->D[3][5] = 0.0;
    out->D[4][0] = 0.0;  out->D[4][1] = 0.0;  out->D[4][2] = 0.0;
    out->D[4][3] = c_phi * c_theta * out->q_dot[5] - s_phi * s_theta * out->q_dot[4];
    out->D[4][4] = -out->q_dot[5] * s_phi;
    out->D[4][5] = 0.0;
    out->D[5][0] = 0.0;  out->D[5][1] = 0.0;  out->D[5][2] = 0.0;
    out->D[5][3] = -c_phi * s_theta * out->q_dot[4] - c_theta * out->q_dot[5] * s_phi;
    out->D[5][4] = -c_phi * out->q_dot[5];
    out->D[5][5] = 0.0;
    remus6_real rest[6];  /* V* - D q' */
    for (int i = 0; i < 6; ++i) {
        rest[i] = V_dot[i] - out->D[i][0] * out->q_dot[0] - out->D[i][1] * out->q_dot[1]
            - out->D[i][2] * out->q_dot[2] - out->D[i][3] * out->q_dot[3] - out->D[i][4] * out->q_dot[4]
            - out->D[i][5] * out->q_dot[5];
    }
    /* q'' = A^-1 (V* - D q') */
    out->q_ddot[0] = C[0] * rest[0] + C[1] * rest[1] + C[2] * rest[2];
    out->q_ddot[1] = C[3] * rest[0] + C[4] * rest[1] + C[5] * rest[2];
    out->q_ddot[2] = C[6] * rest[0] + C[7] * rest[1] + C[8] * rest[2];
    out->q_ddot[3] = rest[4] * s_phi * singular_inv + rest[5] * c_phi * singular_inv;
    out->q_ddot[4] = rest[4] * c_phi - rest[5] * s_phi;
    out->q_ddot[5] = rest[3] + rest[4] * s_phi * s_theta * singular_inv
        + rest[5] * c_phi * s_theta * singular_inv;
    remus6_products(&m, out);
    return REMUS6_OK;
}

/* Rotation matrix whose first axis is along `axis`, the second along the part of `zero` across it. */
REMUS6_CODE
static remus6_status remus6_frame_of_axes(const remus6_real axis[3], const remus6_real zero[3],
                                          remus6_real *restrict R /* [9] */)
{
    remus6_status status;
    if (!(axis[0] * axis[0] + axis[1] * axis[1]
        + axis[2] * axis[2] < REMUS6_MAX_PARAMETER * REMUS6_MAX_PARAMETER)) {
        status = remus6_within(axis, 3, REMUS6_MAX_PARAMETER);
        if (status != REMUS6_OK) { return status; }
    }
    if (!(zero[0] * zero[0] + zero[1] * zero[1]
        + zero[2] * zero[2] < REMUS6_MAX_PARAMETER * REMUS6_MAX_PARAMETER)) {
        status = remus6_within(zero, 3, REMUS6_MAX_PARAMETER);
        if (status != REMUS6_OK) { return status; }
    }
    remus6_real e1[3];
    remus6_real e2[3];
    const remus6_real axis2 = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
    if (!(axis2 > 1.0e-30)) { return REMUS6_RANGE; }
    const remus6_real axis2_root = 1.0 / remus6_sqrt(axis2);
    e1[0] = axis[0] * axis2_root;  e1[1] = axis[1] * axis2_root;  e1[2] = axis[2] * axis2_root;
    const remus6_real zero2 = zero[0] * zero[0] + zero[1] * zero[1] + zero[2] * zero[2];
    if (!(zero2 > 1.0e-30)) { return REMUS6_RANGE; }
    /* of zero along the axis */
    const remus6_real along = e1[0] * zero[0] + e1[1] * zero[1] + e1[2] * zero[2];
    remus6_real across[3];
    across[0] = zero[0] - along * e1[0];
    across[1] = zero[1] - along * e1[1];
    across[2] = zero[2] - along * e1[2];
    const remus6_real across2 = across[0] * across[0] + across[1] * across[1] + across[2] * across[2];
    if (!(across2 > 2.5e-19 * zero2)) { return REMUS6_RANGE; }
    const remus6_real across2_root = 1.0 / remus6_sqrt(across2);
    e2[0] = across[0] * across2_root;  e2[1] = across[1] * across2_root;  e2[2] = across[2] * across2_root;
    R[0] = e1[0];  R[1] = e2[0];
    R[2] = e1[1] * e2[2] - e1[2] * e2[1];
    R[3] = e1[1];  R[4] = e2[1];
    R[5] = e1[2] * e2[0] - e1[0] * e2[2];
    R[6] = e1[2];  R[7] = e2[2];
    R[8] = e1[0] * e2[1] - e1[1] * e2[0];
    return REMUS6_OK;
}

/* Carries one harmonic of a spatial inertia from a body's frame to E1 about O1, (2). */
REMUS6_CODE
static void remus6_carry(remus6_real m, const remus6_real b[3], const remus6_real J[6],
                         const remus6_real O[3], const remus6_real R[9], remus6_real *restrict mu /* [3] */,
                         remus6_real *restrict J1 /* [6] */, int spins, remus6_real *restrict t /* [3] */)
{
    remus6_real b1[3];  /* R b */
    remus6_real RJ[9];  /* R J */
    remus6_real Jr[6];  /* R J R^T */
    b1[0] = R[0] * b[0] + R[1] * b[1] + R[2] * b[2];
    b1[1] = R[3] * b[0] + R[4] * b[1] + R[5] * b[2];
    b1[2] = R[6] * b[0] + R[7] * b[1] + R[8] * b[2];
    RJ[0] = J[0] * R[0] + J[3] * R[1] + J[4] * R[2];
    RJ[1] = J[1] * R[1] + J[3] * R[0] + J[5] * R[2];
    RJ[2] = J[2] * R[2] + J[4] * R[0] + J[5] * R[1];
    RJ[3] = J[0] * R[3] + J[3] * R[4] + J[4] * R[5];
    RJ[4] = J[1] * R[4] + J[3] * R[3] + J[5] * R[5];
    RJ[5] = J[2] * R[5] + J[4] * R[3] + J[5] * R[4];
    RJ[6] = J[0] * R[6] + J[3] * R[7] + J[4] * R[8];
    RJ[7] = J[1] * R[7] + J[3] * R[6] + J[5] * R[8];
    RJ[8] = J[2] * R[8] + J[4] * R[6] + J[5] * R[7];
    Jr[0] = RJ[0] * R[0] + RJ[1] * R[1] + RJ[2] * R[2];
    Jr[1] = RJ[3] * R[3] + RJ[4] * R[4] + RJ[5] * R[5];
    Jr[2] = RJ[6] * R[6] + RJ[7] * R[7] + RJ[8] * R[8];
    Jr[3] = RJ[0] * R[3] + RJ[1] * R[4] + RJ[2] * R[5];
    Jr[4] = RJ[0] * R[6] + RJ[1] * R[7] + RJ[2] * R[8];
    Jr[5] = RJ[3] * R[6] + RJ[4] * R[7] + RJ[5] * R[8];
    /* T Theta T^T: about O1 */
    mu[0] = O[0] * m + b1[0];  mu[1] = O[1] * m + b1[1];  mu[2] = O[2] * m + b1[2];
    J1[0] = Jr[0] + O[1] * b1[1] + O[1] * mu[1] + O[2] * b1[2] + O[2] * mu[2];
    J1[1] = Jr[1] + O[0] * b1[0] + O[0] * mu[0] + O[2] * b1[2] + O[2] * mu[2];
    J1[2] = Jr[2] + O[0] * b1[0] + O[0] * mu[0] + O[1] * b1[1] + O[1] * mu[1];
    J1[3] = Jr[3] - O[0] * mu[1] - O[1] * b1[0];
    J1[4] = Jr[4] - O[0] * mu[2] - O[2] * b1[0];
    J1[5] = Jr[5] - O[1] * mu[2] - O[2] * b1[1];
    if (spins != 0) {
        t[0] = (Jr[0] + O[1] * b1[1] + O[2] * b1[2]) * R[0] + (Jr[3] - O[1] * b1[0]) * R[3]
            + (Jr[4] - O[2] * b1[0]) * R[6];
        t[1] = (Jr[1] + O[0] * b1[0] + O[2] * b1[2]) * R[3] + (Jr[3] - O[0] * b1[1]) * R[0]
            + (Jr[5] - O[2] * b1[1]) * R[6];
        t[2] = (Jr[2] + O[0] * b1[0] + O[1] * b1[1]) * R[6] + (Jr[4] - O[0] * b1[2]) * R[0]
            + (Jr[5] - O[1] * b1[2]) * R[3];
    }
}

/* Are the second moments about the centre of mass positive semidefinite? Then a body can have this
 * inertia. */
REMUS6_CODE
static remus6_status remus6_check_inertia(remus6_real mass, const remus6_real c[3], const remus6_real J[6])
{
    remus6_real size = 0.0;  /* largest element of J */
    for (int k = 0; k < 6; ++k) {
        size = (((J[k] < 0.0) ? -J[k] : J[k]) > size) ? ((J[k] < 0.0) ? -J[k] : J[k]) : size;
    }
    const remus6_real b1 = mass * c[0];
    const remus6_real b2 = mass * c[1];
    const remus6_real b3 = mass * c[2];
    /* P = tr(J)/2 E - J - m c c^T + t |J| E */
    const remus6_real P11 = 0.5 * (J[1] + J[2] - J[0]) - b1 * c[0] + 1.0e-9 * size;
    const remus6_real P22 = 0.5 * (J[2] + J[0] - J[1]) - b2 * c[1] + 1.0e-9 * size;
    const remus6_real P33 = 0.5 * (J[0] + J[1] - J[2]) - b3 * c[2] + 1.0e-9 * size;
    const remus6_real P12 = -J[3] - b1 * c[1];
    const remus6_real P13 = -J[4] - b1 * c[2];
    const remus6_real P23 = -J[5] - b2 * c[2];
    /* a point mass at the origin has no inertia, nor has a body so small that its tolerance underflows */
    if (size + (((b1 * c[0] < 0.0) ? -(b1 * c[0]) : b1 * c[0])
        + ((b2 * c[1] < 0.0) ? -(b2 * c[1]) : b2 * c[1]) + ((b3 * c[2] < 0.0) ? -(b3 * c[2]) : b3 * c[2]))
        > 2.225073858507201e-299) {
        if (!(P11 > 0.0)) { return REMUS6_NOT_POSITIVE_DEFINITE; }
        const remus6_real l21 = P12 / P11;
        const remus6_real l31 = P13 / P11;
        const remus6_real d2 = P22 - l21 * P12;
        if (!(d2 > 0.0)) { return REMUS6_NOT_POSITIVE_DEFINITE; }
        const remus6_real p32 = P23 - l31 * P12;
        const remus6_real d3 = P33 - l31 * P13 - p32 / d2 * p32;
        if (!(d3 > 0.0)) { return REMUS6_NOT_POSITIVE_DEFINITE; }
    }
    return REMUS6_OK;
}

/* Are the mass properties finite and physically possible? */
REMUS6_CODE
static remus6_status remus6_check_body(const remus6_body *body)
{
    remus6_status status;
    remus6_real masses[2];
    masses[0] = body->mass;            masses[1] = body->displaced_mass;
    status = remus6_within(masses, 2, REMUS6_MAX_PARAMETER);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(body->center_of_mass, 3, REMUS6_MAX_PARAMETER);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(body->inertia, 6, REMUS6_MAX_PARAMETER);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(body->displaced_center, 3, REMUS6_MAX_PARAMETER);
    if (status != REMUS6_OK) { return status; }
    if (body->mass < 0.0) { return REMUS6_RANGE; }
    if (body->displaced_mass < 0.0) { return REMUS6_RANGE; }
    return remus6_check_inertia(body->mass, body->center_of_mass, body->inertia);
}

/* Are the mass properties finite and physically possible? */
REMUS6_CODE
static remus6_status remus6_check_dry_body(const remus6_dry_body *body)
{
    remus6_status status;
    remus6_real masses[1];
    masses[0] = body->mass;
    status = remus6_within(masses, 1, REMUS6_MAX_PARAMETER);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(body->center_of_mass, 3, REMUS6_MAX_PARAMETER);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(body->inertia, 6, REMUS6_MAX_PARAMETER);
    if (status != REMUS6_OK) { return status; }
    if (body->mass < 0.0) { return REMUS6_RANGE; }
    return remus6_check_inertia(body->mass, body->center_of_mass, body->inertia);
}

/* Origin and axes (at phi = 0) of a flywheel in E1. */
REMUS6_CODE
static remus6_status remus6_place_flywheel(const remus6_parameters *parameters, const remus6_flywheel *w,
                                           remus6_real *restrict O /* [3] */,
                                           remus6_real *restrict R /* [9] */)
{
    remus6_status status;
    if (!(w->position[0] * w->position[0] + w->position[1] * w->position[1]
        + w->position[2] * w->position[2] < REMUS6_MAX_PARAMETER * REMUS6_MAX_PARAMETER)) {
        status = remus6_within(w->position, 3, REMUS6_MAX_PARAMETER);
        if (status != REMUS6_OK) { return status; }
    }
    status = remus6_frame_of_axes(w->axis, w->zero, R);
    if (status != REMUS6_OK) { return status; }
    O[0] = w->position[0];  O[1] = w->position[1];  O[2] = w->position[2];
    if (!(w->mount >= -1 && w->mount < 1)) { return REMUS6_BAD_ARGUMENT; }
    if (w->mount >= 0) {
        /* Ls = Lp L_s in p */
        remus6_real Rp[9];  /* axes of the instrument in E1 */
        remus6_real Rs[9];  /* own axes in the instrument */
        remus6_real at[3];
        status = remus6_frame_of_axes(parameters->instrument[w->mount].axis,
            parameters->instrument[w->mount].zero, Rp);
        if (status != REMUS6_OK) { return status; }
        Rs[0] = R[0];  Rs[1] = R[1];  Rs[2] = R[2];
        Rs[3] = R[3];  Rs[4] = R[4];  Rs[5] = R[5];
        Rs[6] = R[6];  Rs[7] = R[7];  Rs[8] = R[8];
        R[0] = Rp[0] * Rs[0] + Rp[1] * Rs[3] + Rp[2] * Rs[6];
        R[1] = Rp[0] * Rs[1] + Rp[1] * Rs[4] + Rp[2] * Rs[7];
        R[2] = Rp[0] * Rs[2] + Rp[1] * Rs[5] + Rp[2] * Rs[8];
        R[3] = Rp[3] * Rs[0] + Rp[4] * Rs[3] + Rp[5] * Rs[6];
        R[4] = Rp[3] * Rs[1] + Rp[4] * Rs[4] + Rp[5] * Rs[7];
        R[5] = Rp[3] * Rs[2] + Rp[4] * Rs[5] + Rp[5] * Rs[8];
        R[6] = Rp[6] * Rs[0] + Rp[7] * Rs[3] + Rp[8] * Rs[6];
        R[7] = Rp[6] * Rs[1] + Rp[7] * Rs[4] + Rp[8] * Rs[7];
        R[8] = Rp[6] * Rs[2] + Rp[7] * Rs[5] + Rp[8] * Rs[8];
        at[0] = Rp[0] * w->position[0] + Rp[1] * w->position[1] + Rp[2] * w->position[2];
        at[1] = Rp[3] * w->position[0] + Rp[4] * w->position[1] + Rp[5] * w->position[2];
        at[2] = Rp[6] * w->position[0] + Rp[7] * w->position[1] + Rp[8] * w->position[2];
        O[0] = parameters->instrument[w->mount].position[0] + at[0];
        O[1] = parameters->instrument[w->mount].position[1] + at[1];
        O[2] = parameters->instrument[w->mount].position[2] + at[2];
    }
    return REMUS6_OK;
}

/* Origin and axes of a point in E1. */
REMUS6_CODE
static remus6_status remus6_place_point(const remus6_parameters *parameters, const remus6_point *w,
                                        remus6_real *restrict O /* [3] */, remus6_real *restrict R /* [9] */)
{
    remus6_status status;
    if (!(w->position[0] * w->position[0] + w->position[1] * w->position[1]
        + w->position[2] * w->position[2] < REMUS6_MAX_PARAMETER * REMUS6_MAX_PARAMETER)) {
        status = remus6_within(w->position, 3, REMUS6_MAX_PARAMETER);
        if (status != REMUS6_OK) { return status; }
    }
    status = remus6_frame_of_axes(w->axis, w->zero, R);
    if (status != REMUS6_OK) { return status; }
    O[0] = w->position[0];  O[1] = w->position[1];  O[2] = w->position[2];
    if (!(w->mount >= -1 && w->mount < 1)) { return REMUS6_BAD_ARGUMENT; }
    if (w->mount >= 0) {
        /* Ls = Lp L_s in p */
        remus6_real Rp[9];  /* axes of the instrument in E1 */
        remus6_real Rs[9];  /* own axes in the instrument */
        remus6_real at[3];
        status = remus6_frame_of_axes(parameters->instrument[w->mount].axis,
            parameters->instrument[w->mount].zero, Rp);
        if (status != REMUS6_OK) { return status; }
        Rs[0] = R[0];  Rs[1] = R[1];  Rs[2] = R[2];
        Rs[3] = R[3];  Rs[4] = R[4];  Rs[5] = R[5];
        Rs[6] = R[6];  Rs[7] = R[7];  Rs[8] = R[8];
        R[0] = Rp[0] * Rs[0] + Rp[1] * Rs[3] + Rp[2] * Rs[6];
        R[1] = Rp[0] * Rs[1] + Rp[1] * Rs[4] + Rp[2] * Rs[7];
        R[2] = Rp[0] * Rs[2] + Rp[1] * Rs[5] + Rp[2] * Rs[8];
        R[3] = Rp[3] * Rs[0] + Rp[4] * Rs[3] + Rp[5] * Rs[6];
        R[4] = Rp[3] * Rs[1] + Rp[4] * Rs[4] + Rp[5] * Rs[7];
        R[5] = Rp[3] * Rs[2] + Rp[4] * Rs[5] + Rp[5] * Rs[8];
        R[6] = Rp[6] * Rs[0] + Rp[7] * Rs[3] + Rp[8] * Rs[6];
        R[7] = Rp[6] * Rs[1] + Rp[7] * Rs[4] + Rp[8] * Rs[7];
        R[8] = Rp[6] * Rs[2] + Rp[7] * Rs[5] + Rp[8] * Rs[8];
        at[0] = Rp[0] * w->position[0] + Rp[1] * w->position[1] + Rp[2] * w->position[2];
        at[1] = Rp[3] * w->position[0] + Rp[4] * w->position[1] + Rp[5] * w->position[2];
        at[2] = Rp[6] * w->position[0] + Rp[7] * w->position[1] + Rp[8] * w->position[2];
        O[0] = parameters->instrument[w->mount].position[0] + at[0];
        O[1] = parameters->instrument[w->mount].position[1] + at[1];
        O[2] = parameters->instrument[w->mount].position[2] + at[2];
    }
    return REMUS6_OK;
}

/* Is the added mass finite, symmetric to the bit and positive semidefinite? */
REMUS6_CODE
static remus6_status remus6_check_added_mass(const remus6_real added_mass[6][6])
{
    remus6_status status;
    remus6_real factor[6][6];  /* L below the diagonal, D on it */
    for (int i = 0; i < 6; ++i) {
        status = remus6_within(added_mass[i], 6, REMUS6_MAX_PARAMETER);
        if (status != REMUS6_OK) { return status; }
    }
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < i; ++j) {
            if (added_mass[i][j] < added_mass[j][i]
                || added_mass[i][j] > added_mass[j][i]) { return REMUS6_NOT_POSITIVE_DEFINITE; }
        }
    }
    /* rows of zeros (directions without added mass) are left out */
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
            if ((added_mass[i][j] < 0.0 || added_mass[i][j] > 0.0)
                && !(added_mass[i][i] > 0.0)) { return REMUS6_NOT_POSITIVE_DEFINITE; }
        }
        remus6_real diagonal = added_mass[i][i] + 1.0e-9 * added_mass[i][i];
        for (int j = 0; j < i; ++j) {
            remus6_real entry = added_mass[i][j];  /* L_ij D_j */
            for (int k = 0; k < j; ++k) {
                entry -= factor[i][k] * factor[k][k] * factor[j][k];
            }
            factor[i][j] = entry / factor[j][j];
            diagonal -= factor[i][j] * entry;
        }
        if (added_mass[i][i] > 0.0) {
            if (!(diagonal > 0.0)) { return REMUS6_NOT_POSITIVE_DEFINITE; }
        }
        factor[i][i] = (added_mass[i][i] > 0.0) ? diagonal : 1.0;
    }
    return REMUS6_OK;
}

/* Constant translational block of K with added mass, A = m E + Lambda_11, and its inverse, (2). */
REMUS6_CODE
static remus6_status remus6_translation_block(const remus6_parameters *parameters, remus6_real mass,
                                              remus6_real *restrict A /* [6] */,
                                              remus6_real *restrict A_inv /* [6] */)
{
    A[0] = mass + parameters->added_mass[0][0];
    A[1] = mass + parameters->added_mass[1][1];
    A[2] = mass + parameters->added_mass[2][2];
    A[3] = parameters->added_mass[0][1];
    A[4] = parameters->added_mass[0][2];
    A[5] = parameters->added_mass[1][2];
    const remus6_real c11 = A[1] * A[2] - A[5] * A[5];
    const remus6_real c22 = A[0] * A[2] - A[4] * A[4];
    const remus6_real c33 = A[0] * A[1] - A[3] * A[3];
    const remus6_real c12 = A[4] * A[5] - A[2] * A[3];
    const remus6_real c13 = A[3] * A[5] - A[1] * A[4];
    const remus6_real c23 = A[3] * A[4] - A[0] * A[5];
    const remus6_real det = A[0] * c11 + A[3] * c12 + A[4] * c13;
    if (!(A[0] > 0.0 && c33 > 0.0 && (det >= 2.2250738585072014e-308
        && det <= REMUS6_LARGEST))) { return REMUS6_NOT_POSITIVE_DEFINITE; }
    const remus6_real r = 1.0 / det;
    A_inv[0] = c11 * r;  A_inv[1] = c22 * r;  A_inv[2] = c33 * r;
    A_inv[3] = c12 * r;  A_inv[4] = c13 * r;  A_inv[5] = c23 * r;
    return REMUS6_OK;
}

/* Are the parameters finite and in range, the axes nonzero, and the bodies physically possible? */
REMUS6_CODE
static remus6_status remus6_check_parameters(const remus6_parameters *parameters)
{
    remus6_status status;
    remus6_real mass;
    /* largest moment of inertia that products in the equations can reach; it must not overflow */
    remus6_real size;
    remus6_real O[3];
    remus6_real R[9];
    status = remus6_check_body(&parameters->carrier);
    if (status != REMUS6_OK) { return status; }
    mass = parameters->carrier.mass;
    size = parameters->carrier.inertia[0] + parameters->carrier.inertia[1] + parameters->carrier.inertia[2];
    for (int k = 0; k < 1; ++k) {
        status = remus6_check_body(&parameters->instrument[k].body);
        if (status != REMUS6_OK) { return status; }
        if (!(parameters->instrument[k].position[0] * parameters->instrument[k].position[0]
            + parameters->instrument[k].position[1] * parameters->instrument[k].position[1]
            + parameters->instrument[k].position[2] * parameters->instrument[k].position[2]
            < REMUS6_MAX_PARAMETER * REMUS6_MAX_PARAMETER)) {
            status = remus6_within(parameters->instrument[k].position, 3, REMUS6_MAX_PARAMETER);
            if (status != REMUS6_OK) { return status; }
        }
        status = remus6_frame_of_axes(parameters->instrument[k].axis, parameters->instrument[k].zero, R);
        if (status != REMUS6_OK) { return status; }
        mass += parameters->instrument[k].body.mass;
        size += parameters->instrument[k].body.inertia[0] + parameters->instrument[k].body.inertia[1]
            + parameters->instrument[k].body.inertia[2]
            + parameters->instrument[k].body.mass
            * (parameters->instrument[k].position[0] * parameters->instrument[k].position[0]
            + parameters->instrument[k].position[1] * parameters->instrument[k].position[1]
            + parameters->instrument[k].position[2] * parameters->instrument[k].position[2]);
    }
    for (int s = 0; s < REMUS6_N; ++s) {
        status = remus6_check_dry_body(&parameters->flywheel[s].body);
        if (status != REMUS6_OK) { return status; }
        if (!(parameters->flywheel[s].body.inertia[0] >= 1.0e-30)) { return REMUS6_NOT_POSITIVE_DEFINITE; }
        status = remus6_place_flywheel(parameters, &parameters->flywheel[s], O, R);
        if (status != REMUS6_OK) { return status; }
        mass += parameters->flywheel[s].body.mass;
        size += parameters->flywheel[s].body.inertia[0] + parameters->flywheel[s].body.inertia[1]
            + parameters->flywheel[s].body.inertia[2]
            + parameters->flywheel[s].body.mass * (O[0] * O[0] + O[1] * O[1] + O[2] * O[2]);
    }
    for (int k = 0; k < 1; ++k) {
        status = remus6_place_point(parameters, &parameters->point[k], O, R);
        if (status != REMUS6_OK) { return status; }
    }
    if (!(mass >= 1.0e-30)) { return REMUS6_NOT_POSITIVE_DEFINITE; }
    if (!(size <= 1.0e60)) { return REMUS6_RANGE; }
    remus6_real A[6];
    remus6_real A_inv[6];
    status = remus6_check_added_mass(parameters->added_mass);
    if (status != REMUS6_OK) { return status; }
    status = remus6_translation_block(parameters, mass, A, A_inv);
    if (status != REMUS6_OK) { return status; }
    return REMUS6_OK;
}

/* (2) */
REMUS6_CODE
remus6_status remus6_prepare(const remus6_parameters *parameters, remus6_table *table)
{
    if (parameters == NULL || table == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status = remus6_check_parameters(parameters);
    if (status != REMUS6_OK) { return status; }
    /* all checks passed: from here on the table is written and nothing can fail */
    remus6_real mass;
    remus6_real first_moment[3];
    remus6_real inertia[6];
    mass = 0.0;
    first_moment[0] = 0.0;  first_moment[1] = 0.0;  first_moment[2] = 0.0;
    inertia[0] = 0.0;  inertia[1] = 0.0;  inertia[2] = 0.0;
    inertia[3] = 0.0;  inertia[4] = 0.0;  inertia[5] = 0.0;
    remus6_real weight_mass;
    remus6_real displaced[3];
    weight_mass = 0.0;
    displaced[0] = 0.0;  displaced[1] = 0.0;  displaced[2] = 0.0;
    /* carrier: its frame is E1 */
    remus6_real O[3];  /* origin of a body in E1 */
    remus6_real R[9];  /* axes of a body in E1 */
    remus6_real b[3];  /* first moment in the body's frame */
    remus6_real mu[3];
    remus6_real J1[6];
    remus6_real t[3];
    O[0] = 0.0;  O[1] = 0.0;  O[2] = 0.0;
    R[0] = 1.0;  R[1] = 0.0;  R[2] = 0.0;
    R[3] = 0.0;  R[4] = 1.0;  R[5] = 0.0;
    R[6] = 0.0;  R[7] = 0.0;  R[8] = 1.0;
    b[0] = parameters->carrier.mass * parameters->carrier.center_of_mass[0];
    b[1] = parameters->carrier.mass * parameters->carrier.center_of_mass[1];
    b[2] = parameters->carrier.mass * parameters->carrier.center_of_mass[2];
    remus6_carry(parameters->carrier.mass, b, parameters->carrier.inertia, O, R, mu, J1, 0, t);
    mass += parameters->carrier.mass;
    first_moment[0] += mu[0];  first_moment[1] += mu[1];  first_moment[2] += mu[2];
    inertia[0] += J1[0];  inertia[1] += J1[1];  inertia[2] += J1[2];
    inertia[3] += J1[3];  inertia[4] += J1[4];  inertia[5] += J1[5];
    weight_mass += parameters->carrier.mass - parameters->carrier.displaced_mass;
    displaced[0] += parameters->carrier.displaced_mass
        * (O[0] + (R[0] * parameters->carrier.displaced_center[0]
        + (R[1] * parameters->carrier.displaced_center[1] + R[2] * parameters->carrier.displaced_center[2])));
    displaced[1] += parameters->carrier.displaced_mass
        * (O[1] + (R[3] * parameters->carrier.displaced_center[0]
        + (R[4] * parameters->carrier.displaced_center[1] + R[5] * parameters->carrier.displaced_center[2])));
    displaced[2] += parameters->carrier.displaced_mass
        * (O[2] + (R[6] * parameters->carrier.displaced_center[0]
        + (R[7] * parameters->carrier.displaced_center[1] + R[8] * parameters->carrier.displaced_center[2])));
    /* instruments */
    for (int k = 0; k < 1; ++k) {
        (void)remus6_frame_of_axes(parameters->instrument[k].axis, parameters->instrument[k].zero, R);
        O[0] = parameters->instrument[k].position[0];
        O[1] = parameters->instrument[k].position[1];
        O[2] = parameters->instrument[k].position[2];
        b[0] = parameters->instrument[k].body.mass * parameters->instrument[k].body.center_of_mass[0];
        b[1] = parameters->instrument[k].body.mass * parameters->instrument[k].body.center_of_mass[1];
        b[2] = parameters->instrument[k].body.mass * parameters->instrument[k].body.center_of_mass[2];
        remus6_carry(parameters->instrument[k].body.mass, b, parameters->instrument[k].body.inertia, O, R, mu,
            J1, 0, t);
        mass += parameters->instrument[k].body.mass;
        first_moment[0] += mu[0];  first_moment[1] += mu[1];  first_moment[2] += mu[2];
        inertia[0] += J1[0];  inertia[1] += J1[1];  inertia[2] += J1[2];
        inertia[3] += J1[3];  inertia[4] += J1[4];  inertia[5] += J1[5];
        weight_mass += parameters->instrument[k].body.mass - parameters->instrument[k].body.displaced_mass;
        displaced[0] += parameters->instrument[k].body.displaced_mass
            * (O[0] + (R[0] * parameters->instrument[k].body.displaced_center[0]
            + (R[1] * parameters->instrument[k].body.displaced_center[1]
            + R[2] * parameters->instrument[k].body.displaced_center[2])));
        displaced[1] += parameters->instrument[k].body.displaced_mass
            * (O[1] + (R[3] * parameters->instrument[k].body.displaced_center[0]
            + (R[4] * parameters->instrument[k].body.displaced_center[1]
            + R[5] * parameters->instrument[k].body.displaced_center[2])));
        displaced[2] += parameters->instrument[k].body.displaced_mass
            * (O[2] + (R[6] * parameters->instrument[k].body.displaced_center[0]
            + (R[7] * parameters->instrument[k].body.displaced_center[1]
            + R[8] * parameters->instrument[k].body.displaced_center[2])));
    }
    /* flywheels: constant part to the totals, harmonics to the row */
    for (int s = 0; s < REMUS6_N; ++s) {
        (void)remus6_place_flywheel(parameters, &parameters->flywheel[s], O, R);
        b[0] = parameters->flywheel[s].body.mass * parameters->flywheel[s].body.center_of_mass[0];
        b[1] = parameters->flywheel[s].body.mass * parameters->flywheel[s].body.center_of_mass[1];
        b[2] = parameters->flywheel[s].body.mass * parameters->flywheel[s].body.center_of_mass[2];
        remus6_real bh[3];  /* first moment of one harmonic, in mounting axes */
        remus6_real Jh[6];  /* its inertia */
        /* harmonic 0 of Theta(phi) */
        bh[0] = b[0];  bh[1] = 0.0;   bh[2] = 0.0;
        Jh[0] = parameters->flywheel[s].body.inertia[0];
        Jh[1] = 0.5 * (parameters->flywheel[s].body.inertia[1] + parameters->flywheel[s].body.inertia[2]);
        Jh[2] = 0.5 * (parameters->flywheel[s].body.inertia[1] + parameters->flywheel[s].body.inertia[2]);
        Jh[3] = 0.0;  Jh[4] = 0.0;  Jh[5] = 0.0;
        remus6_carry(parameters->flywheel[s].body.mass, bh, Jh, O, R, mu, J1, 1, table->flywheel[s].t_0);
        mass += parameters->flywheel[s].body.mass;
        first_moment[0] += mu[0];  first_moment[1] += mu[1];  first_moment[2] += mu[2];
        inertia[0] += J1[0];  inertia[1] += J1[1];  inertia[2] += J1[2];
        inertia[3] += J1[3];  inertia[4] += J1[4];  inertia[5] += J1[5];
        /* harmonic c of Theta(phi) */
        bh[0] = 0.0;   bh[1] = b[1];  bh[2] = b[2];
        Jh[0] = 0.0;  Jh[1] = 0.0;  Jh[2] = 0.0;
        Jh[3] = parameters->flywheel[s].body.inertia[3];
        Jh[4] = parameters->flywheel[s].body.inertia[4];
        Jh[5] = 0.0;
        remus6_carry(0.0, bh, Jh, O, R, table->flywheel[s].mu_c, table->flywheel[s].J_c, 1,
            table->flywheel[s].t_c);
        /* harmonic s of Theta(phi) */
        bh[0] = 0.0;    bh[1] = -b[2];  bh[2] = b[1];
        Jh[0] = 0.0;  Jh[1] = 0.0;  Jh[2] = 0.0;
        Jh[3] = -parameters->flywheel[s].body.inertia[4];
        Jh[4] = parameters->flywheel[s].body.inertia[3];
        Jh[5] = 0.0;
        remus6_carry(0.0, bh, Jh, O, R, table->flywheel[s].mu_s, table->flywheel[s].J_s, 1,
            table->flywheel[s].t_s);
        /* harmonic 2c of Theta(phi) */
        bh[0] = 0.0;  bh[1] = 0.0;  bh[2] = 0.0;
        Jh[0] = 0.0;
        Jh[1] = 0.5 * (parameters->flywheel[s].body.inertia[1] - parameters->flywheel[s].body.inertia[2]);
        Jh[2] = 0.5 * (parameters->flywheel[s].body.inertia[2] - parameters->flywheel[s].body.inertia[1]);
        Jh[3] = 0.0;  Jh[4] = 0.0;
        Jh[5] = parameters->flywheel[s].body.inertia[5];
        remus6_carry(0.0, bh, Jh, O, R, mu, table->flywheel[s].J_2c, 0, t);
        /* harmonic 2s of Theta(phi) */
        bh[0] = 0.0;  bh[1] = 0.0;  bh[2] = 0.0;
        Jh[0] = 0.0;
        Jh[1] = -parameters->flywheel[s].body.inertia[5];
        Jh[2] = parameters->flywheel[s].body.inertia[5];
        Jh[3] = 0.0;  Jh[4] = 0.0;
        Jh[5] = 0.5 * (parameters->flywheel[s].body.inertia[1] - parameters->flywheel[s].body.inertia[2]);
        remus6_carry(0.0, bh, Jh, O, R, mu, table->flywheel[s].J_2s, 0, t);
        table->flywheel[s].spin = parameters->flywheel[s].body.inertia[0];
        table->flywheel[s].spin_inv = 1.0 / parameters->flywheel[s].body.inertia[0];
        table->flywheel[s].spin_root_inv = 1.0 / remus6_sqrt(parameters->flywheel[s].body.inertia[0]);
        weight_mass += parameters->flywheel[s].body.mass;
    }
    (void)remus6_translation_block(parameters, mass, table->A, table->A_inv);
    table->G[0] = parameters->added_mass[3][0];
    table->G[1] = parameters->added_mass[3][1];
    table->G[2] = parameters->added_mass[3][2];
    table->G[3] = parameters->added_mass[4][0];
    table->G[4] = parameters->added_mass[4][1];
    table->G[5] = parameters->added_mass[4][2];
    table->G[6] = parameters->added_mass[5][0];
    table->G[7] = parameters->added_mass[5][1];
    table->G[8] = parameters->added_mass[5][2];
    inertia[0] += parameters->added_mass[3][3];
    inertia[1] += parameters->added_mass[4][4];
    inertia[2] += parameters->added_mass[5][5];
    inertia[3] += parameters->added_mass[3][4];
    inertia[4] += parameters->added_mass[3][5];
    inertia[5] += parameters->added_mass[4][5];
    table->mass = mass;
    table->mass_inverse = 1.0 / mass;
    table->first_moment[0] = first_moment[0];
    table->first_moment[1] = first_moment[1];
    table->first_moment[2] = first_moment[2];
    table->inertia[0] = inertia[0];  table->inertia[1] = inertia[1];  table->inertia[2] = inertia[2];
    table->inertia[3] = inertia[3];  table->inertia[4] = inertia[4];  table->inertia[5] = inertia[5];
    table->weight_mass = weight_mass;
    table->displaced_moment[0] = displaced[0];
    table->displaced_moment[1] = displaced[1];
    table->displaced_moment[2] = displaced[2];
    /* poses of instruments and points */
    for (int k = 0; k < 1; ++k) {
        (void)remus6_frame_of_axes(parameters->instrument[k].axis, parameters->instrument[k].zero, R);
        O[0] = parameters->instrument[k].position[0];
        O[1] = parameters->instrument[k].position[1];
        O[2] = parameters->instrument[k].position[2];
        table->sensor[k].origin[0] = O[0];  table->sensor[k].origin[1] = O[1];
        table->sensor[k].origin[2] = O[2];
        table->sensor[k].axes[0] = R[0];  table->sensor[k].axes[1] = R[1];  table->sensor[k].axes[2] = R[2];
        table->sensor[k].axes[3] = R[3];  table->sensor[k].axes[4] = R[4];  table->sensor[k].axes[5] = R[5];
        table->sensor[k].axes[6] = R[6];  table->sensor[k].axes[7] = R[7];  table->sensor[k].axes[8] = R[8];
    }
    for (int k = 0; k < 1; ++k) {
        (void)remus6_place_point(parameters, &parameters->point[k], O, R);
        table->sensor[k + 1].origin[0] = O[0];
        table->sensor[k + 1].origin[1] = O[1];
        table->sensor[k + 1].origin[2] = O[2];
        table->sensor[k + 1].axes[0] = R[0];
        table->sensor[k + 1].axes[1] = R[1];
        table->sensor[k + 1].axes[2] = R[2];
        table->sensor[k + 1].axes[3] = R[3];
        table->sensor[k + 1].axes[4] = R[4];
        table->sensor[k + 1].axes[5] = R[5];
        table->sensor[k + 1].axes[6] = R[6];
        table->sensor[k + 1].axes[7] = R[7];
        table->sensor[k + 1].axes[8] = R[8];
    }
    return REMUS6_OK;
}

/* L^T V: a twist carried to Os, in mounting axes. */
REMUS6_CODE
static void remus6_carry_twist(const remus6_mount *mount, const remus6_real V[6],
                               remus6_real *restrict U /* [6] */)
{
    remus6_real velocity[3];  /* velocity of Os */
    velocity[0] = mount->origin[2] * V[4] + V[0] - mount->origin[1] * V[5];
    velocity[1] = mount->origin[0] * V[5] + V[1] - mount->origin[2] * V[3];
    velocity[2] = mount->origin[1] * V[3] + V[2] - mount->origin[0] * V[4];
    U[0] = mount->axes[0] * velocity[0] + mount->axes[3] * velocity[1] + mount->axes[6] * velocity[2];
    U[1] = mount->axes[1] * velocity[0] + mount->axes[4] * velocity[1] + mount->axes[7] * velocity[2];
    U[2] = mount->axes[2] * velocity[0] + mount->axes[5] * velocity[1] + mount->axes[8] * velocity[2];
    U[3] = mount->axes[0] * V[3] + mount->axes[3] * V[4] + mount->axes[6] * V[5];
    U[4] = mount->axes[1] * V[3] + mount->axes[4] * V[4] + mount->axes[7] * V[5];
    U[5] = mount->axes[2] * V[3] + mount->axes[5] * V[4] + mount->axes[8] * V[5];
}

/* Wrench of the mount on one flywheel: diag(C1, C1) (Theta V_s* + Phi(V_s) Z_s - P_s). */
REMUS6_CODE
static void remus6_mount_wrench(const remus6_mount *mount, remus6_real s, remus6_real c, remus6_real phi_dot,
                                remus6_real phi_ddot, const remus6_real V[6], const remus6_real V_dot[6],
                                const remus6_real g[3], remus6_real *restrict W /* [6] */)
{
    remus6_real U[6];  /* twist of the mount at Os */
    remus6_real turned[6];  /* in Es */
    remus6_real turned_dot[6];
    remus6_real V_s[6];  /* twist of the flywheel, in Es */
    remus6_real V_s_dot[6];
    remus6_real Z_s[6];  /* its momentum screw */
    remus6_carry_twist(mount, V, U);
    turned[0] = U[0];                 turned[1] = U[1] * c + U[2] * s;  turned[2] = U[2] * c - U[1] * s;
    turned[3] = U[3];                 turned[4] = U[4] * c + U[5] * s;  turned[5] = U[5] * c - U[4] * s;
    remus6_carry_twist(mount, V_dot, U);
    turned_dot[0] = U[0];
    turned_dot[1] = U[1] * c + U[2] * s;
    turned_dot[2] = U[2] * c - U[1] * s;
    turned_dot[3] = U[3];
    turned_dot[4] = U[4] * c + U[5] * s;
    turned_dot[5] = U[5] * c - U[4] * s;
    V_s[0] = turned[0];            V_s[1] = turned[1];            V_s[2] = turned[2];
    V_s[3] = turned[3] + phi_dot;  V_s[4] = turned[4];            V_s[5] = turned[5];
    V_s_dot[0] = turned_dot[0];
    V_s_dot[1] = phi_dot * turned[2] + turned_dot[1];
    V_s_dot[2] = turned_dot[2] - phi_dot * turned[1];
    V_s_dot[3] = phi_ddot + turned_dot[3];
    V_s_dot[4] = phi_dot * turned[5] + turned_dot[4];
    V_s_dot[5] = turned_dot[5] - phi_dot * turned[4];
    Z_s[0] = V_s[0] * mount->mass + V_s[4] * mount->first_moment[2] - V_s[5] * mount->first_moment[1];
    Z_s[1] = V_s[1] * mount->mass + V_s[5] * mount->first_moment[0] - V_s[3] * mount->first_moment[2];
    Z_s[2] = V_s[2] * mount->mass + V_s[3] * mount->first_moment[1] - V_s[4] * mount->first_moment[0];
    Z_s[3] = mount->inertia[0] * V_s[3] + mount->inertia[3] * V_s[4] + mount->inertia[4] * V_s[5]
        + V_s[2] * mount->first_moment[1] - V_s[1] * mount->first_moment[2];
    Z_s[4] = mount->inertia[1] * V_s[4] + mount->inertia[3] * V_s[3] + mount->inertia[5] * V_s[5]
        + V_s[0] * mount->first_moment[2] - V_s[2] * mount->first_moment[0];
    Z_s[5] = mount->inertia[2] * V_s[5] + mount->inertia[4] * V_s[3] + mount->inertia[5] * V_s[4]
        + V_s[1] * mount->first_moment[0] - V_s[0] * mount->first_moment[1];
    W[0] += V_s[4] * Z_s[2] + V_s_dot[0] * mount->mass + V_s_dot[4] * mount->first_moment[2] - V_s[5] * Z_s[1]
        - V_s_dot[5] * mount->first_moment[1];
    W[1] += V_s[5] * Z_s[0] + V_s_dot[1] * mount->mass + V_s_dot[5] * mount->first_moment[0] - V_s[3] * Z_s[2]
        - V_s_dot[3] * mount->first_moment[2];
    W[2] += V_s[3] * Z_s[1] + V_s_dot[2] * mount->mass + V_s_dot[3] * mount->first_moment[1] - V_s[4] * Z_s[0]
        - V_s_dot[4] * mount->first_moment[0];
    W[3] += mount->inertia[0] * V_s_dot[3] + mount->inertia[3] * V_s_dot[4] + mount->inertia[4] * V_s_dot[5]
        + V_s[1] * Z_s[2] + V_s[4] * Z_s[5] + V_s_dot[2] * mount->first_moment[1] - V_s[2] * Z_s[1]
        - V_s[5] * Z_s[4] - V_s_dot[1] * mount->first_moment[2];
    W[4] += mount->inertia[1] * V_s_dot[4] + mount->inertia[3] * V_s_dot[3] + mount->inertia[5] * V_s_dot[5]
        + V_s[2] * Z_s[0] + V_s[5] * Z_s[3] + V_s_dot[0] * mount->first_moment[2] - V_s[0] * Z_s[2]
        - V_s[3] * Z_s[5] - V_s_dot[2] * mount->first_moment[0];
    W[5] += mount->inertia[2] * V_s_dot[5] + mount->inertia[4] * V_s_dot[3] + mount->inertia[5] * V_s_dot[4]
        + V_s[0] * Z_s[1] + V_s[3] * Z_s[4] + V_s_dot[1] * mount->first_moment[0] - V_s[1] * Z_s[0]
        - V_s[4] * Z_s[3] - V_s_dot[0] * mount->first_moment[1];
    remus6_real g_mounting[3];  /* gravity in mounting axes */
    remus6_real g_s[3];  /* gravity in Es */
    g_mounting[0] = mount->axes[0] * g[0] + mount->axes[3] * g[1] + mount->axes[6] * g[2];
    g_mounting[1] = mount->axes[1] * g[0] + mount->axes[4] * g[1] + mount->axes[7] * g[2];
    g_mounting[2] = mount->axes[2] * g[0] + mount->axes[5] * g[1] + mount->axes[8] * g[2];
    g_s[0] = g_mounting[0];
    g_s[1] = g_mounting[1] * c + g_mounting[2] * s;
    g_s[2] = g_mounting[2] * c - g_mounting[1] * s;
    W[0] += -g_s[0] * mount->mass;  W[1] += -g_s[1] * mount->mass;  W[2] += -g_s[2] * mount->mass;
    W[3] += g_s[1] * mount->first_moment[2] - g_s[2] * mount->first_moment[1];
    W[4] += g_s[2] * mount->first_moment[0] - g_s[0] * mount->first_moment[2];
    W[5] += g_s[0] * mount->first_moment[1] - g_s[1] * mount->first_moment[0];
    remus6_real own[6];  /* in Es */
    own[0] = W[0];  own[1] = W[1];  own[2] = W[2];
    own[3] = W[3];  own[4] = W[4];  own[5] = W[5];
    W[0] = own[0];                   W[1] = own[1] * c - own[2] * s;  W[2] = own[1] * s + own[2] * c;
    W[3] = own[3];                   W[4] = own[4] * c - own[5] * s;  W[5] = own[4] * s + own[5] * c;
}

/* Wrench of the mount on each flywheel: the bearing loads. Their opposites shake the structure. */
REMUS6_CODE
remus6_status remus6_mounts(const remus6_table *table, const remus6_mount_table *mounting,
                            const remus6_state *x, const remus6_real V_dot[6],
                            const remus6_real phi_ddot[REMUS6_N], remus6_real mount_wrench[36])
{
    if (table == NULL || mounting == NULL || x == NULL || V_dot == NULL || phi_ddot == NULL
        || mount_wrench == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(phi_ddot, REMUS6_N, REMUS6_MAX_ACCELERATION);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(V_dot, 6, REMUS6_MAX_ACCELERATION);
    if (status != REMUS6_OK) { return status; }
    remus6_real C[9];  /* attitude */
    remus6_rotation(x->attitude, C);
    remus6_real u[3];  /* stream in E1 */
    remus6_rotate_back(C, table->stream, u);
    remus6_real V[6];  /* V relative to the stream: the fluid's frame is inertial as well */
    V[0] = x->V[0] - u[0];  V[1] = x->V[1] - u[1];  V[2] = x->V[2] - u[2];
    V[3] = x->V[3];         V[4] = x->V[4];         V[5] = x->V[5];
    remus6_real g[3];  /* gravity in E1 */
    remus6_rotate_back(C, table->gravity, g);
    remus6_real sine[REMUS6_N];
    remus6_real cosine[REMUS6_N];
    remus6_sincos_each(x->phi, sine, cosine);
    remus6_real drift[3];  /* omega x C^T u */
    drift[0] = u[2] * x->V[4] - u[1] * x->V[5];
    drift[1] = u[0] * x->V[5] - u[2] * x->V[3];
    drift[2] = u[1] * x->V[3] - u[0] * x->V[4];
    remus6_real V_r_dot[6];  /* V_r* = V* + (omega x C^T u, 0) */
    V_r_dot[0] = V_dot[0] + drift[0];  V_r_dot[1] = V_dot[1] + drift[1];  V_r_dot[2] = V_dot[2] + drift[2];
    V_r_dot[3] = V_dot[3];             V_r_dot[4] = V_dot[4];             V_r_dot[5] = V_dot[5];
    remus6_real W[6];
    for (int s = 0; s < REMUS6_N; ++s) {
        W[0] = 0.0;  W[1] = 0.0;  W[2] = 0.0;
        W[3] = 0.0;  W[4] = 0.0;  W[5] = 0.0;
        remus6_mount_wrench(&mounting->flywheel[s], sine[s], cosine[s], x->phi_dot[s], phi_ddot[s], V,
            V_r_dot, g, W);
        for (int j = 0; j < 6; ++j) {
            mount_wrench[s * 6 + j] = W[j];
        }
    }
    return REMUS6_OK;
}

/* Makes the second table, which the function mounts needs. */
REMUS6_CODE
remus6_status remus6_prepare_mounts(const remus6_parameters *parameters, remus6_mount_table *mounting)
{
    if (parameters == NULL || mounting == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status = remus6_check_parameters(parameters);
    if (status != REMUS6_OK) { return status; }
    for (int s = 0; s < REMUS6_N; ++s) {
        mounting->flywheel[s].mass = parameters->flywheel[s].body.mass;
        mounting->flywheel[s].first_moment[0] = parameters->flywheel[s].body.mass
            * parameters->flywheel[s].body.center_of_mass[0];
        mounting->flywheel[s].first_moment[1] = parameters->flywheel[s].body.mass
            * parameters->flywheel[s].body.center_of_mass[1];
        mounting->flywheel[s].first_moment[2] = parameters->flywheel[s].body.mass
            * parameters->flywheel[s].body.center_of_mass[2];
        mounting->flywheel[s].inertia[0] = parameters->flywheel[s].body.inertia[0];
        mounting->flywheel[s].inertia[1] = parameters->flywheel[s].body.inertia[1];
        mounting->flywheel[s].inertia[2] = parameters->flywheel[s].body.inertia[2];
        mounting->flywheel[s].inertia[3] = parameters->flywheel[s].body.inertia[3];
        mounting->flywheel[s].inertia[4] = parameters->flywheel[s].body.inertia[4];
        mounting->flywheel[s].inertia[5] = parameters->flywheel[s].body.inertia[5];
        (void)remus6_place_flywheel(parameters, &parameters->flywheel[s], mounting->flywheel[s].origin,
            mounting->flywheel[s].axes);
    }
    return REMUS6_OK;
}

/* Sets to = x + h rate with phases in [-pi, pi], and keeps in the carry what rounding takes from the sums. */
REMUS6_CODE
static void remus6_advance_carried(const remus6_state *x, const remus6_state *rate, remus6_real h,
                                   remus6_step_carry *restrict carry, remus6_state *restrict to)
{
    for (int i = 0; i < 3; ++i) {
        const remus6_real step = h * rate->position[i] + carry->rounding[i];
        const remus6_real sum = x->position[i] + step;
        const remus6_real sum_b = sum - x->position[i];
        carry->rounding[i] = x->position[i] - (sum - sum_b) + (step - sum_b);
        to->position[i] = sum;
    }
    for (int i = 0; i < 4; ++i) {
        const remus6_real step = h * rate->attitude[i] + carry->rounding[i + 3];
        const remus6_real sum = x->attitude[i] + step;
        const remus6_real sum_b = sum - x->attitude[i];
        carry->rounding[i + 3] = x->attitude[i] - (sum - sum_b) + (step - sum_b);
        to->attitude[i] = sum;
    }
    for (int i = 0; i < 6; ++i) {
        const remus6_real step = h * rate->V[i] + carry->rounding[i + 7];
        const remus6_real sum = x->V[i] + step;
        const remus6_real sum_b = sum - x->V[i];
        carry->rounding[i + 7] = x->V[i] - (sum - sum_b) + (step - sum_b);
        to->V[i] = sum;
    }
    for (int i = 0; i < REMUS6_N; ++i) {
        const remus6_real start = remus6_wrapped(x->phi[i]);
        const remus6_real step = h * rate->phi[i] + carry->rounding[i + 13];
        const remus6_real sum = start + step;
        const remus6_real sum_b = sum - start;
        /* turns */
        const remus6_real k = sum * 0.15915494309189535 + 6755399441055744.0 - 6755399441055744.0;
        const remus6_real left = sum - k * 6.283185303211212;
        const remus6_real within = left + -(k * 3.968374318722146e-9);
        const remus6_real within_b = within - left;
        carry->rounding[i + 13] = start - (sum - sum_b) + (step - sum_b)
            + (left - (within - within_b) + (-(k * 3.968374318722146e-9) - within_b)
            - k * 1.5782216666252822e-23);
        to->phi[i] = within;
    }
    for (int i = 0; i < REMUS6_N; ++i) {
        const remus6_real step = h * rate->phi_dot[i] + carry->rounding[i + 19];
        const remus6_real sum = x->phi_dot[i] + step;
        const remus6_real sum_b = sum - x->phi_dot[i];
        carry->rounding[i + 19] = x->phi_dot[i] - (sum - sum_b) + (step - sum_b);
        to->phi_dot[i] = sum;
    }
}

/* Normalizes the quaternion, rounding kept in the carry; RANGE if the state is out of range. */
REMUS6_CODE
static remus6_status remus6_finish_carried(remus6_state *restrict x, remus6_step_carry *restrict carry)
{
    remus6_status status;
    const remus6_real square = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
        + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
    if (!(square > 0.5 && square < 2.0)) { return REMUS6_RANGE; }
    /* 1/|q| - 1, without the digits that the difference would lose */
    const remus6_real excess = (1.0 - square) / (remus6_sqrt(square) + square);
    for (int i = 0; i < 4; ++i) {
        const remus6_real step = x->attitude[i] * excess + carry->rounding[i + 3];
        const remus6_real sum = x->attitude[i] + step;
        const remus6_real sum_b = sum - x->attitude[i];
        carry->rounding[i + 3] = x->attitude[i] - (sum - sum_b) + (step - sum_b);
        x->attitude[i] = sum;
    }
    status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    return REMUS6_OK;
}

/* State after one time step under drive torques and wrenches, held constant; sums are compensated by a
 * carry. */
REMUS6_CODE
remus6_status remus6_step_carried(const remus6_table *table, const remus6_state *x,
                                  const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                                  remus6_real dt, int order, remus6_step_carry *carry, remus6_state *next)
{
    if (table == NULL || x == NULL || tau == NULL || carry == NULL
        || next == NULL) { return REMUS6_BAD_ARGUMENT; }
    if (locked == NULL) { locked = remus6_none_locked; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(tau, REMUS6_N, REMUS6_MAX_WRENCH);
    if (status != REMUS6_OK) { return status; }
    if (!(dt >= -REMUS6_MAX_STEP && dt <= REMUS6_MAX_STEP)) {
        if (dt >= -REMUS6_LARGEST && dt <= REMUS6_LARGEST) { return REMUS6_RANGE; }
        return REMUS6_NOT_FINITE;
    }
    if (!(dt > 0.0)) { return REMUS6_BAD_ARGUMENT; }
    if (!(order == 4 || order == 2)) { return REMUS6_BAD_ARGUMENT; }
    status = remus6_within(carry->rounding, 25, REMUS6_MAX_ROUNDING);
    if (status != REMUS6_OK) { return status; }
    remus6_state y;  /* state of a stage; then the new state */
    remus6_state total;  /* sum of the rates at the stages */
    status = remus6_stages(table, x, tau, locked, dt, order, &y, &total);
    if (status != REMUS6_OK) { return status; }
    const remus6_real over = (order == 2) ? dt : dt / 6.0;  /* times the sum: the increment */
    /* square of the fastest turning, (rad/s)^2 */
    remus6_real fastest = x->V[3] * x->V[3] + x->V[4] * x->V[4] + x->V[5] * x->V[5];
    for (int s = 0; s < REMUS6_N; ++s) {
        const remus6_real square = x->phi_dot[s] * x->phi_dot[s];
        fastest = (square > fastest) ? square : fastest;
    }
    remus6_step_carry kept;  /* the new carry */
    kept = *carry;
    remus6_advance_carried(x, &total, over, &kept, &y);
    status = remus6_finish_carried(&y, &kept);
    if (status != REMUS6_OK) { return REMUS6_RANGE; }
    *carry = kept;
    *next = y;
    const remus6_real most = (order == 2) ? REMUS6_MAX_TURN_2 : REMUS6_MAX_TURN_4;  /* rad */
    if (dt * dt * fastest > most * most) { return REMUS6_COARSE; }
    return REMUS6_OK;
}

/* State after one time step under given flywheel accelerations and wrenches, held constant; sums are
 * compensated by a carry. */
REMUS6_CODE
remus6_status remus6_step_driven_carried(const remus6_table *table, const remus6_state *x,
                                         const remus6_real phi_ddot[REMUS6_N], remus6_real dt, int order,
                                         remus6_step_carry *carry, remus6_state *next)
{
    if (table == NULL || x == NULL || phi_ddot == NULL || carry == NULL
        || next == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_status status = remus6_check_state(x);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(table->stream, 3, REMUS6_MAX_VELOCITY);
    if (status != REMUS6_OK) { return status; }
    status = remus6_within(phi_ddot, REMUS6_N, REMUS6_MAX_ACCELERATION);
    if (status != REMUS6_OK) { return status; }
    if (!(dt >= -REMUS6_MAX_STEP && dt <= REMUS6_MAX_STEP)) {
        if (dt >= -REMUS6_LARGEST && dt <= REMUS6_LARGEST) { return REMUS6_RANGE; }
        return REMUS6_NOT_FINITE;
    }
    if (!(dt > 0.0)) { return REMUS6_BAD_ARGUMENT; }
    if (!(order == 4 || order == 2)) { return REMUS6_BAD_ARGUMENT; }
    status = remus6_within(carry->rounding, 25, REMUS6_MAX_ROUNDING);
    if (status != REMUS6_OK) { return status; }
    remus6_state y;  /* state of a stage; then the new state */
    remus6_state total;  /* sum of the rates at the stages */
    status = remus6_stages_driven(table, x, phi_ddot, dt, order, &y, &total);
    if (status != REMUS6_OK) { return status; }
    const remus6_real over = (order == 2) ? dt : dt / 6.0;  /* times the sum: the increment */
    /* square of the fastest turning, (rad/s)^2 */
    remus6_real fastest = x->V[3] * x->V[3] + x->V[4] * x->V[4] + x->V[5] * x->V[5];
    for (int s = 0; s < REMUS6_N; ++s) {
        const remus6_real square = x->phi_dot[s] * x->phi_dot[s];
        fastest = (square > fastest) ? square : fastest;
    }
    remus6_step_carry kept;  /* the new carry */
    kept = *carry;
    remus6_advance_carried(x, &total, over, &kept, &y);
    status = remus6_finish_carried(&y, &kept);
    if (status != REMUS6_OK) { return REMUS6_RANGE; }
    *carry = kept;
    *next = y;
    const remus6_real most = (order == 2) ? REMUS6_MAX_TURN_2 : REMUS6_MAX_TURN_4;  /* rad */
    if (dt * dt * fastest > most * most) { return REMUS6_COARSE; }
    return REMUS6_OK;
}

/* ---- tables ---- */

REMUS6_CONST
const remus6_parameters remus6_default_parameters =
{
    .carrier = {
        .mass = 28.18,
        .center_of_mass = { -0.0180437, -1.33e-5, 0.0195422 },
        .inertia = { 0.1734562, 3.1692378, 3.1696413, 0.0027724, 0.0057263, 2.27e-5 },
        .displaced_mass = 31.193,
        .displaced_center = { 0.0, 0.0, 0.0 },
    },
    .added_mass = {
        {   0.93,    0.0,    0.0,    0.0,    0.0,    0.0 },
        {    0.0,   35.5,    0.0,    0.0,    0.0,  -1.93 },
        {    0.0,    0.0,   35.5,    0.0,   1.93,    0.0 },
        {    0.0,    0.0,    0.0, 0.0704,    0.0,    0.0 },
        {    0.0,    0.0,   1.93,    0.0,   4.88,    0.0 },
        {    0.0,  -1.93,    0.0,    0.0,    0.0,   4.88 },
    },
    .instrument = {
        {  /* nose */
            .body = {
                .mass = 0.8,
                .center_of_mass = { 0.012, 0.0, -0.004 },
                .inertia = { 0.0009128, 0.0012280000000000001, 0.0012152, 0.0, 3.8400000000000005e-5, 0.0 },
                .displaced_mass = 0.0,
                .displaced_center = { 0.0, 0.0, 0.0 },
            },
            .position = { 0.48, 0.0, 0.01 },
            .axis = { 0.984807753012208, 0.0, 0.17364817766693033 },
            .zero = { -0.0, 1.0, 0.0 },
        },
    },
    .flywheel = {
        {  /* w1 */
            .body = {
                .mass = 0.25,
                .center_of_mass = { 0.0, 0.0008, 0.0 },
                .inertia = { 0.00015, 8.5e-5, 9.0e-5, -3.6739403974420596e-23, -6.0e-7, 0.0 },
            },
            .position = { 0.22, 0.035, 0.02 },
            .axis = { 0.0, 1.0, 0.0 },
            .zero = { 0.0, 0.0, 1.0 },
            .mount = -1,
        },
        {  /* w2 */
            .body = {
                .mass = 0.25,
                .center_of_mass = { 0.0, 0.00084, 0.0 },
                .inertia = { 0.00015, 8.5e-5, 8.8e-5, -2.4999999999999994e-7, -4.3301270189221934e-7, 0.0 },
            },
            .position = { -0.22, -0.035, 0.02 },
            .axis = { 0.0, 1.0, 0.0 },
            .zero = { 0.0, 0.0, -1.0 },
            .mount = -1,
        },
        {  /* w3 */
            .body = {
                .mass = 0.25,
                .center_of_mass = { 0.0, 0.00076, 0.0 },
                .inertia = { 0.00015, 8.6e-5, 9.0e-5, -4.0e-7, 0.0, 0.0 },
            },
            .position = { 0.12, -0.02, 0.03 },
            .axis = { 0.0, 0.3, 1.0 },
            .zero = { 0.0, 1.0, 0.0 },
            .mount = -1,
        },
        {  /* w4 */
            .body = {
                .mass = 0.25,
                .center_of_mass = { 0.0, 0.0007727406610312546, 0.00020705523608201664 },
                .inertia = { 0.00015, 8.4e-5, 8.9e-5, 0.0, 0.0, 0.0 },
            },
            .position = { -0.12, 0.02, 0.03 },
            .axis = { 0.0, -0.3, 1.0 },
            .zero = { 0.0, -1.0, 0.0 },
            .mount = -1,
        },
        {  /* w5 */
            .body = {
                .mass = 0.25,
                .center_of_mass = { 0.0, 0.0008, 0.0 },
                .inertia = { 0.00015, 8.5e-5, 9.0e-5, -2.5980762113533156e-7, 1.5000000000000002e-7, 0.0 },
            },
            .position = { 0.0, 0.0, 0.04 },
            .axis = { 1.0, 0.0, 0.2 },
            .zero = { 0.0, 1.0, 0.0 },
            .mount = -1,
        },
        {  /* w6 */
            .body = {
                .mass = 0.25,
                .center_of_mass = { 0.0, 0.00072, 0.0 },
                .inertia = { 0.00015, 8.5e-5, 9.0e-5, 3.000000000000001e-7, -5.196152422706631e-7, 0.0 },
            },
            .position = { -0.02, 0.0, 0.015 },
            .axis = { 0.9, 0.1, 0.5 },
            .zero = { 0.0, 1.0, 0.0 },
            .mount = 0,
        },
    },
    .point = {
        {
            .position = { 0.15, 0.0, -0.03 },
            .axis = { 1.0, 0.0, -0.0 },
            .zero = { 0.0, 1.0, 0.0 },
            .mount = -1,
        },
    },
};

REMUS6_CONST
const remus6_table remus6_default =
{
    .mass = 30.48,
    .mass_inverse = 0.03280839895013123,
    .first_moment = { -3.685683386059346e-5, -0.0003747939999999995, 0.5975396218814244 },
    .inertia = { 0.2474121440199002, 8.330041529814594, 8.330040192799752, 0.0001270699935097979,
        8.822837475413233e-5, 2.6076216923620165e-5 },
    .A = { 31.41, 65.98, 65.98, 0.0, 0.0, 0.0 },
    .A_inv = { 0.03183699458771092, 0.015156107911488331, 0.015156107911488331, 0.0, 0.0, 0.0 },
    .G = { 0.0, 0.0, 0.0, 0.0, 0.0, 1.93, 0.0, -1.93, 0.0 },
    .weight_mass = -0.7130000000000019,
    .displaced_moment = { 0.0, 0.0, 0.0 },
    .flywheel = {
        {  /* w1 */
            .mu_c = { 0.0, 0.0, 0.0002 },
            .mu_s = { 0.0002, 0.0, 0.0 },
            .J_c = { 8.000000000000001e-6, 8.000000000000001e-6, 0.0, -6.0e-7, -4.4000000000000006e-5,
                -7.000000000000001e-6 },
            .J_s = { 0.0, 8.800000000000001e-5, 8.800000000000001e-5, -7.000000000000001e-6,
                -4.000000000000001e-6, 6.0e-7 },
            .J_2c = { 2.4999999999999998e-6, 0.0, -2.4999999999999998e-6, 0.0, 0.0, 0.0 },
            .J_2s = { 0.0, 0.0, 0.0, 0.0, -2.4999999999999998e-6, 0.0 },
            .t_0 = { 0.0, 0.00015, 0.0 },
            .t_c = { -6.0e-7, 4.000000000000001e-6, -7.000000000000001e-6 },
            .t_s = { -7.000000000000001e-6, 4.4000000000000006e-5, 6.0e-7 },
            .spin = 0.00015,
            .spin_inv = 6666.666666666667,
            .spin_root_inv = 81.64965809277261,
        },
        {  /* w2 */
            .mu_c = { 0.0, 0.0, -0.00021 },
            .mu_s = { -0.00021, 0.0, 0.0 },
            .J_c = { -8.400000000000001e-6, -8.400000000000001e-6, 0.0, 4.3301270189221934e-7,
                -4.6200000000000005e-5, -7.100000000000001e-6 },
            .J_s = { 0.0, 9.240000000000001e-5, 9.240000000000001e-5, -7.100000000000001e-6,
                4.2000000000000004e-6, -4.3301270189221934e-7 },
            .J_2c = { 1.4999999999999958e-6, 0.0, -1.4999999999999958e-6, 0.0, 0.0, 0.0 },
            .J_2s = { 0.0, 0.0, 0.0, 0.0, -1.4999999999999958e-6, 0.0 },
            .t_0 = { 0.0, 0.00015, 0.0 },
            .t_c = { 4.3301270189221934e-7, -4.2000000000000004e-6, -7.100000000000001e-6 },
            .t_s = { -7.100000000000001e-6, 4.6200000000000005e-5, -4.3301270189221934e-7 },
            .spin = 0.00015,
            .spin_inv = 6666.666666666667,
            .spin_root_inv = 81.64965809277261,
        },
        {  /* w3 */
            .mu_c = { 0.0, 0.0001819869941920188, -5.459609825760563e-5 },
            .mu_s = { -0.00019, 0.0, 0.0 },
            .J_c = { -1.055524566313709e-5, -3.4959493816948696e-6, -7.0592962814422205e-6,
                -2.1838439303042257e-5, 6.551531790912675e-6, -6.885476745041117e-6 },
            .J_s = { 0.0, -4.5600000000000004e-5, -4.5600000000000004e-5, -3.6850608457734625e-6,
                6.083130514088461e-6, 0.0 },
            .J_2c = { 2.000000000000001e-6, -1.8348623853211026e-6, -1.6513761467889914e-7, 0.0, 0.0,
                5.504587155963307e-7 },
            .J_2s = { 0.0, 0.0, 0.0, 1.9156525704423043e-6, -5.746957711326911e-7, 0.0 },
            .t_0 = { 0.0, 4.3102182834951804e-5, 0.00014367394278317266 },
            .t_c = { 0.0, -6.083130514088461e-6, -3.685060845773462e-6 },
            .t_s = { 4.7676878606084506e-6, -6.551531790912676e-6, -2.1838439303042253e-5 },
            .spin = 0.00015,
            .spin_inv = 6666.666666666667,
            .spin_root_inv = 81.64965809277261,
        },
        {  /* w4 */
            .mu_c = { 5.176380902050416e-5, -0.00018503782919872591, -5.551134875961776e-5 },
            .mu_s = { 0.00019318516525781366, 4.9580736903006636e-5, 1.4874221070901985e-5 },
            .J_c = { -1.0732194093526102e-5, -1.5753995090498062e-5, -1.9824827332870034e-5,
                -2.3239815684257194e-5, -8.214276121769256e-6, 6.661361851154133e-6 },
            .J_s = { 2.875682740374385e-6, -4.5471986397621155e-5, -4.438121018575502e-5,
                2.0859851232045232e-6, -4.010648429226172e-6, -1.7849065285082388e-6 },
            .J_2c = { 2.4999999999999998e-6, -2.2935779816513764e-6, -2.0642201834862379e-7, 0.0, 0.0,
                -6.880733944954128e-7 },
            .J_2s = { 0.0, 0.0, 0.0, 2.3945657130528785e-6, 7.183697139158634e-7, 0.0 },
            .t_0 = { 0.0, -4.3102182834951804e-5, 0.00014367394278317263 },
            .t_c = { -1.1899376856721588e-6, 7.580461486242648e-6, -9.813391733517068e-6 },
            .t_s = { -4.440907900769421e-6, 5.108447580539007e-6, -2.116926332343702e-5 },
            .spin = 0.00015,
            .spin_inv = 6666.666666666667,
            .spin_root_inv = 81.64965809277261,
        },
        {  /* w5 */
            .mu_c = { 0.0, 0.0002, 0.0 },
            .mu_s = { -3.922322702763681e-5, 0.0, 0.00019611613513818404 },
            .J_c = { -5.76923076923077e-8, 0.0, 5.76923076923077e-8, -2.54762332682534e-7,
                1.3846153846153846e-7, -8.050952466536508e-6 },
            .J_s = { 1.5789216819183695e-5, 1.5689290811054723e-5, -9.992600812897368e-8,
                -1.4708710135363802e-7, 1.3291066615959356e-6, -2.941742027072761e-8 },
            .J_2c = { 9.615384615384617e-8, -2.4999999999999998e-6, 2.4038461538461535e-6, 0.0,
                -4.807692307692307e-7, 0.0 },
            .J_2s = { 0.0, 0.0, 0.0, 4.902903378454601e-7, 0.0, -2.4514516892273e-6 },
            .t_0 = { 0.00014708710135363798, 0.0, 2.9417420270727602e-5 },
            .t_c = { -2.9417420270727608e-8, -1.828736702240804e-6, 1.4708710135363802e-7 },
            .t_s = { 8.050952466536508e-6, -1.5e-7, -2.5476233268253394e-7 },
            .spin = 0.00015,
            .spin_inv = 6666.666666666667,
            .spin_root_inv = 81.64965809277261,
        },
        {  /* w6 */
            .mu_c = { -1.3512873805140461e-5, 0.00017915690403018868, -1.0963848769665967e-5 },
            .mu_s = { -0.00011341093352635507, 1.2490009027033012e-21, 0.00013977825351849506 },
            .J_c = { 4.228378223622281e-9, -1.2778969833748272e-5, -1.289866322289885e-5,
                -8.173969852574897e-5, 5.1711462346589714e-6, -3.6694133986843315e-6 },
            .J_s = { 5.601829405287051e-6, -9.776185708667751e-5, -0.00010356367775738655,
                3.776898295141705e-7, -6.154822757347233e-5, 3.4379119769943453e-7 },
            .J_2c = { 9.783520127195736e-7, -2.476635514018691e-6, 1.4982835012991177e-6,
                1.8679974039194442e-7, -1.2346092070261717e-6, 1.5156243841269663e-7 },
            .J_2s = { -2.3649809149148292e-7, -3.453196525605468e-23, 2.3649809149148292e-7,
                1.5677740535305014e-6, 4.9798269790799174e-8, -1.932271539438302e-6 },
            .t_0 = { 0.00011593629236629821, 1.4501047335684955e-5, 9.406644321183016e-5 },
            .t_c = { 3.0486770866053853e-7, -6.609334590423563e-5, -4.2177814276157097e-7 },
            .t_s = { 3.5878637345064282e-6, -4.213149761627226e-6, -8.179864387340778e-5 },
            .spin = 0.00015,
            .spin_inv = 6666.666666666667,
            .spin_root_inv = 81.64965809277261,
        },
    },
    .sensor = {
        {  /* nose */
            .origin = { 0.48, 0.0, 0.01 },
            .axes = { 0.9848077530122082, -0.0, -0.17364817766693036, 0.0, 1.0, -0.0, 0.17364817766693036,
                0.0, 0.9848077530122082 },
        },
        {  /* imu */
            .origin = { 0.15, 0.0, -0.03 },
            .axes = { 1.0, 0.0, 0.0, 0.0, 1.0, -0.0, -0.0, 0.0, 1.0 },
        },
    },
    .gravity = { 0.0, 0.0, 9.81 },
    .stream = { 0.0, 0.0, 0.0 },
    .damper = {
        .first_term = 0,
        .last_term = 10,
    },
    .term = {
        {
            .wrench = 0,
            .first = 0,
            .second = 6,
            .value = -1.62,
        },
        {
            .wrench = 1,
            .first = 1,
            .second = 7,
            .value = -1310.0,
        },
        {
            .wrench = 1,
            .first = 5,
            .second = 11,
            .value = 0.632,
        },
        {
            .wrench = 2,
            .first = 2,
            .second = 8,
            .value = -131.0,
        },
        {
            .wrench = 2,
            .first = 4,
            .second = 10,
            .value = -0.632,
        },
        {
            .wrench = 3,
            .first = 3,
            .second = 9,
            .value = -0.13,
        },
        {
            .wrench = 4,
            .first = 2,
            .second = 8,
            .value = 3.18,
        },
        {
            .wrench = 4,
            .first = 4,
            .second = 10,
            .value = -188.0,
        },
        {
            .wrench = 5,
            .first = 1,
            .second = 7,
            .value = -3.18,
        },
        {
            .wrench = 5,
            .first = 5,
            .second = 11,
            .value = -94.0,
        },
    },
};

REMUS6_CONST
const remus6_inverse_options remus6_default_options =
{
    .weight = { 1.0, 1.0, 1.0, 1.0, 1.0, 1.0 },
    .limit = { 1.7976931348623157e308, 1.7976931348623157e308, 1.7976931348623157e308, 1.7976931348623157e308,
        1.7976931348623157e308, 1.7976931348623157e308 },
    .most = { 1.0e4, 1.0e4, 1.0e4, 1.0e4, 1.0e4, 1.0e4 },
    .motor_torque = { 1.7976931348623157e308, 1.7976931348623157e308, 1.7976931348623157e308,
        1.7976931348623157e308, 1.7976931348623157e308, 1.7976931348623157e308 },
    .motor_speed = { 1.7976931348623157e308, 1.7976931348623157e308, 1.7976931348623157e308,
        1.7976931348623157e308, 1.7976931348623157e308, 1.7976931348623157e308 },
    .motor_viscous = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 },
    .motor_coulomb = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 },
    .motor_coulomb_speed = { 1.0, 1.0, 1.0, 1.0, 1.0, 1.0 },
    .near_singular = 1.0e-6,
    .damping = 0.0,
};
