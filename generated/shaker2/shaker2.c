/* shaker2.c: motion of the stand "shaker2". What each function does and takes: shaker2.h.
 * mahovik 0.1.0; structure 94a85f4a, physics 2591b2a4. Generated: change the stand file instead. */
#include "shaker2.h"

#include <stddef.h>
#include <stdint.h>

#if SHAKER2_STRUCTURE != 0x94a85f4au || SHAKER2_PHYSICS != 0x2591b2a4u
#error "shaker2.h and shaker2.c are of different stands"
#endif
#if SHAKER2_REAL_BYTES != 8
#error "shaker2.h and shaker2.c were generated for different element types"
#endif
#if SHAKER2_VERSION_MAJOR != 0 || SHAKER2_VERSION_MINOR != 1 || SHAKER2_VERSION_PATCH != 0
#error "shaker2.h and shaker2.c are of different versions of mahovik"
#endif

#include <float.h>
#include <limits.h>

/* Other numbers than those of IEEE 754, and fast math, which leaves out roundings that the code relies on,
 * give wrong results with status OK. What the compiler shows of them is refused here; clang does not show
 * -funsafe-math-optimizations. */
#if FLT_RADIX != 2 || DBL_MANT_DIG != 53
#error "wrong results: shaker2 needs a double of 64 bits, 53 of them significant"
#endif
#if INT_MAX < 2147483647
#error "wrong counts: shaker2 needs an int of 32 bits"
#endif
#ifndef SHAKER2_ALLOW_FAST_MATH
#if defined __FAST_MATH__ || defined __ASSOCIATIVE_MATH__ || defined __RECIPROCAL_MATH__ || defined _M_FP_FAST
#error "wrong results: compile shaker2 without -ffast-math, -Ofast and -funsafe-math-optimizations"
#elif FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1 && FLT_EVAL_METHOD != 16
#error "wrong results: x87 keeps more digits: compile shaker2 with -msse2 -mfpmath=sse"
#endif
#if defined __FINITE_MATH_ONLY__ && __FINITE_MATH_ONLY__ == 1
#error "inputs that are NaN would pass: compile shaker2 without -ffinite-math-only"
#endif
#endif

/* Attributes for sections, such as fast memory: define them to place code and tables. */
#ifndef SHAKER2_CODE
#define SHAKER2_CODE
#endif
#ifndef SHAKER2_CONST
#define SHAKER2_CONST
#endif

/* Seldom called: one copy takes less code than one in each caller. */
#ifdef __GNUC__
#define SHAKER2_APART __attribute__((noinline))
#else
#define SHAKER2_APART
#endif

/* On desktop processors copies in the callers are faster; elsewhere they take too much code. */
#if defined __GNUC__ && !defined __OPTIMIZE_SIZE__ && (defined __x86_64__ || defined __aarch64__)
#define SHAKER2_COPIED inline __attribute__((always_inline))
#else
#define SHAKER2_COPIED
#endif

/* Sums over all bodies at one state. */
typedef struct shaker2_sums {
    shaker2_real mu[3];      /* kg m; first moment of all bodies about O1 */
    shaker2_real mu_dot[3];  /* kg m/s; its rate in E1 */
    shaker2_real J[6];       /* kg m2; inertia about O1 */
    shaker2_real J_dot[6];   /* kg m2/s; its rate in E1 */
    shaker2_real h_rel[3];   /* kg m2/s; moment part of sum I phi' */
    shaker2_real g_rel[3];   /* N m; d/dt of the moment part */
    shaker2_real a_rel[3];   /* N; d/dt of the force part */
} shaker2_sums;

/* A symmetric 3x3 matrix factored, L D L^T. */
typedef struct shaker2_factors3 {
    shaker2_real r1;   /* 1 / D, of the last D itself */
    shaker2_real r2;
    shaker2_real d3;
    shaker2_real l21;  /* L below its diagonal */
    shaker2_real l31;
    shaker2_real l32;
} shaker2_factors3;

/* K of the carrier factored. */
typedef struct shaker2_carrier_factor {
    shaker2_real rho[3];  /* m; mass centre from O1, in E1 */
    shaker2_factors3 L;   /* what is left of the inertia */
} shaker2_carrier_factor;

/* How one flywheel's drive torque depends on the motion: I . V* + Theta_ff phi'' + bias. */
typedef struct shaker2_coupling {
    shaker2_real I_[6];  /* kg m, kg m2; column of I (9) */
    shaker2_real bias;   /* N m; drive torque at V* = 0, phi'' = 0 */
} shaker2_coupling;

/* K with free flywheels eliminated: K - sum I I^T / Theta_ff. */
typedef struct shaker2_schur {
    shaker2_real A[6];  /* kg; force by v*: 11 22 33 12 13 23 */
    shaker2_real B[9];  /* kg m; moment by v*, row by row */
    shaker2_real D[6];  /* kg m2; moment by omega*: 11 22 33 12 13 23 */
} shaker2_schur;

/* K with free flywheels eliminated, factored. */
typedef struct shaker2_schur_factor {
    shaker2_real A_inv[6];  /* 1/kg */
    shaker2_real U[9];      /* m; A^-1 B^T */
    shaker2_factors3 L;     /* D - B A^-1 B^T */
} shaker2_schur_factor;

/* Scratch of inverse. */
typedef struct shaker2_inverse_work {
    shaker2_real I_[6][SHAKER2_N];  /* kg m, kg m2; flywheel coupling (9) */
    shaker2_real W[6][SHAKER2_N];   /* scaled: G^-1 I D^-1; then with orthogonal rows */
    shaker2_real U[6][6];           /* rotations of the rows */
    shaker2_real G[6][6];           /* Cholesky factor of K, lower triangle */
    shaker2_real b[6];              /* N, N m; the wrench demanded of the flywheels */
    shaker2_real r[6];              /* scaled: G^-1 b; then U^T r */
    shaker2_real sigma[6];          /* singular values */
    shaker2_real scale[SHAKER2_N];  /* D^-1 */
} shaker2_inverse_work;

typedef uint64_t shaker2_word;  /* the bits of a real */

SHAKER2_CODE
static shaker2_word shaker2_bits_of(shaker2_real value)
{
    union { shaker2_real real; shaker2_word word; } both;
    both.real = value;
    return both.word;
}

SHAKER2_CODE
static shaker2_real shaker2_real_of(shaker2_word word)
{
    union { shaker2_real real; shaker2_word word; } both;
    both.word = word;
    return both.real;
}

/* What null stands for. */
SHAKER2_CONST
static const int shaker2_none_locked[SHAKER2_N] = { 0 };

/* Sine and cosine of an angle.
 * |x| <= 1e+07, which the caller checks. Error at most 1 unit in the last place
 * for |x| <= 8 pi, and 1e-16 absolute beyond. Other x give meaningless results, but the call is safe. */
SHAKER2_CODE
static void shaker2_sincos(shaker2_real x, shaker2_real *restrict sine, shaker2_real *restrict cosine)
{
    /* k = x/(pi/2), rounded: adding the large constant leaves the integer k in the last bits of the sum. */
    const shaker2_real shifted = x * 0.6366197723675814 + 6755399441055744.0;
    const shaker2_word quadrant = shaker2_bits_of(shifted);  /* mod 4: its last two bits */
    const shaker2_real k = shifted - 6755399441055744.0;
    /* r = r_hi - r_tail = x - k pi/2, pi/2 in three parts: the product with the first is exact. */
    const shaker2_real rest = x - k * 1.570796325802803;
    const shaker2_real second = k * 9.920935796805365e-10;
    const shaker2_real r_hi = rest - second;
    /* rounding error of r_hi, and the third part */
    const shaker2_real r_tail = r_hi - rest + second + k * 3.9455541665632055e-24;
    const shaker2_real z = r_hi * r_hi;
    /* cos r_hi = 1 - z/2 + z^2 C(z); the rounding error of 1 - z/2 is added back. */
    const shaker2_real half_z = z * 0.5;
    const shaker2_real flat = 1.0 - half_z;
    const shaker2_real cos_fit = 0.0416666666666666
        + z * (-0.001388888888887447 + z * (2.4801587289666868e-5
        + z * (-2.755731439924032e-7 + z * (2.087572898867696e-9 + z * -1.1359916930271879e-11))));
    const shaker2_real cos_r = flat + (1.0 - flat - half_z + (z * z * cos_fit + r_hi * r_tail));
    /* sin r_hi = r_hi - r_hi^3 S(z), S with positive sign so that sin(-0) = -0. */
    const shaker2_real sin_fit = 0.1666666666666663
        + z * (-0.00833333333332184 + z * (0.00019841269829358541
        + z * (-2.7557313538526495e-6 + z * (2.5050734392488434e-8 + z * -1.5895433551463968e-10))));
    const shaker2_real sin_r = r_hi - (z * r_hi * sin_fit + flat * r_tail);
    /* Odd quadrants exchange sine and cosine; quadrants 2, 3 negate the sine, 1, 2 the cosine. */
    const shaker2_word sin_bits = shaker2_bits_of(sin_r);
    const shaker2_word cos_bits = shaker2_bits_of(cos_r);
    const shaker2_word exchange = (sin_bits ^ cos_bits) & (0u - (quadrant & 1u));
    const shaker2_word sine_sign = (quadrant << 62u) & 0x8000000000000000u;
    const shaker2_word cosine_sign = ((quadrant + 1u) << 62u) & 0x8000000000000000u;
    *sine = shaker2_real_of(sin_bits ^ exchange ^ sine_sign);
    *cosine = shaker2_real_of(cos_bits ^ exchange ^ cosine_sign);
}

/* Square root, correctly rounded.
 * x >= 0 and finite, which the caller checks; subnormals are exact too, sqrt(0) = 0. */
SHAKER2_CODE
static shaker2_real shaker2_sqrt(shaker2_real x)
{
#ifdef SHAKER2_SQRT
    return SHAKER2_SQRT(x);  /* correctly rounded as well, or the bits differ */
#else
    /* x = m 4^j with m in [1, 4), taken from its bits; subnormals are scaled up first. */
    const int subnormal = x < 2.2250738585072014e-308;
    const shaker2_real lift = (subnormal) ? 1.8014398509481984e16 : 1.0;
    const shaker2_word lowered = (subnormal) ? 27u : 0u;
    const shaker2_word bits = shaker2_bits_of(x * lift);
    const shaker2_word exponent = bits >> 52u;
    const shaker2_word odd = (exponent & 1u) ^ 1u;  /* the exponent's bias is odd */
    const shaker2_word fraction = bits & 0xfffffffffffffu;
    const shaker2_word m_bits = fraction + ((odd + 1023u) << 52u);
    const shaker2_real m = shaker2_real_of(m_bits);
    const shaker2_real half_m = m * 0.5;
    /* y = 1/sqrt(m): a shift of the bits gives a first guess, Newton steps refine it. */
    const shaker2_real y0 = shaker2_real_of(0x5fe6eb50c7b537a9u - (m_bits >> 1u));
    const shaker2_real y1 = y0 * (1.5 - half_m * y0 * y0);
    const shaker2_real y2 = y1 * (1.5 - half_m * y1 * y1);
    const shaker2_real y3 = y2 * (1.5 - half_m * y2 * y2);
    const shaker2_real s = m * y3;
    const shaker2_real close = s + (m - s * s) * (y3 * 0.5);  /* within 1.5 units in the last place */
    /* The last bit, exactly, in integers modulo 2^width: compare d = m - s^2 with s, in units of the last
     * place. */
    const shaker2_word root = shaker2_bits_of(close) - 0x3fe0000000000000u;  /* s as an integer */
    const shaker2_word d = ((fraction + 0x10000000000000u) << odd << 52u) - root * root;
    const shaker2_word up = (root - d) >> 63u;  /* 1 if d > s: the next larger number is nearer */
    const shaker2_word down = (d + root - 1u) >> 63u;  /* 1 if d <= -s: the next smaller number is nearer */
    const shaker2_word halved = ((exponent + 1023u - odd) >> 1u) - lowered;
    const shaker2_real result = shaker2_real_of(root + up - down + ((halved - 1u) << 52u));
    return (x > 0.0) ? result : x;
#endif
}

/* Angle of the vector (x, y), in [-pi, pi].
 * x and y finite. Error at most 2 units in the last place; signs of zeros as in C, atan2(0, 0) = 0. */
SHAKER2_CODE
static shaker2_real shaker2_atan2(shaker2_real y, shaker2_real x)
{
    const shaker2_real x_size = (x < 0.0) ? -x : x;
    const shaker2_real y_size = (y < 0.0) ? -y : y;
    const int steep = y_size > x_size;
    const shaker2_real larger = (steep) ? y_size : x_size;
    /* larger + smaller must not overflow */
    const shaker2_real scale = (larger > 2.247116418577895e307) ? 0.25 : 1.0;
    const shaker2_real major = larger * scale;
    const shaker2_real minor = ((steep) ? x_size : y_size) * scale;
    /* The angle of (major, minor) is atan(t), or pi/4 + atan(t) where minor > major/2; in both |t| <= 1/2. */
    const int beyond = minor + minor > major;
    const shaker2_real above = (beyond) ? minor - major : minor;
    const shaker2_real below = (beyond) ? minor + major : ((major > 0.0) ? major : 1.0);  /* 1 avoids 0/0 */
    const shaker2_real octant = (beyond) ? 1.0 : 0.0;
    /* Octants: |y| > |x| is pi/2 - angle, a negative x (or -0, as in C) pi - angle. */
    const shaker2_real above_1 = (steep) ? -above : above;
    const shaker2_real octant_1 = (steep) ? 2.0 - octant : octant;
    const int left = (shaker2_bits_of(x) & 0x8000000000000000u) != 0u;
    const shaker2_real t = ((left) ? -above_1 : above_1) / below;
    const shaker2_real octant_2 = (left) ? 4.0 - octant_1 : octant_1;
    const shaker2_real z = t * t;
    /* atan t = t + t^3 A(t^2) */
    const shaker2_real fitted = t * z * (-0.3333333333333298
        + z * (0.19999999999903115 + z * (-0.14285714276386494
        + z * (0.1111111065966467 + z * (-0.0909089624543797
        + z * (0.07692073923156066 + z * (-0.0666381072054367
        + z * (0.05858299583745059 + z * (-0.05122008614169068
        + z * (0.04186511848030717 + z * (-0.02743506477426233 + z * 0.010116924654437372)))))))))));
    /* octant pi/4 + atan t; pi/4 in two parts, so that its product with 3 is exact. */
    const shaker2_real base = octant_2 * 0.7853981633974483;
    const shaker2_real sum = base + t;  /* base is 0 or larger than t: */
    const shaker2_real lost = base - sum + t;  /* so this is the rounding error of the sum */
    const shaker2_real angle = sum + (lost + (fitted + octant_2 * 3.061616997868383e-17));
    return shaker2_real_of(shaker2_bits_of(angle) | (shaker2_bits_of(y) & 0x8000000000000000u));
}

/* Removes k turns, phi - k 2 pi, with 2 pi in three parts: the product with the first is exact. */
SHAKER2_CODE
static shaker2_real shaker2_unwound(shaker2_real phi, shaker2_real k)
{
    return phi - k * 6.283185303211212 - k * 3.968374318722146e-9 - k * 1.5782216666252822e-23;
}

/* The angle wrapped to within half a turn of zero.
 * |phi| <= 1e+07: beyond this the result is meaningless, but the call is safe. */
SHAKER2_CODE
static shaker2_real shaker2_wrapped(shaker2_real phi)
{
    /* k = phi / (2 pi), rounded: adding the large constant leaves the integer k in the last bits of the
     * sum. */
    const shaker2_real k = phi * 0.15915494309189535 + 6755399441055744.0 - 6755399441055744.0;  /* turns */
    return shaker2_unwound(phi, k);
}

/* Are all values finite, and none larger in magnitude than the limit? A NaN fails every comparison. */
SHAKER2_CODE SHAKER2_APART
static shaker2_status shaker2_within(const shaker2_real values[], int count, shaker2_real limit)
{
    for (int i = 0; i < count; ++i) {
        if (!(values[i] >= -limit && values[i] <= limit)) {
            if (values[i] >= -SHAKER2_LARGEST && values[i] <= SHAKER2_LARGEST) { return SHAKER2_RANGE; }
            return SHAKER2_NOT_FINITE;
        }
    }
    return SHAKER2_OK;
}

/* Is the state finite, in its ranges, and its quaternion within 1e-3 of unit length? */
SHAKER2_CODE
static shaker2_status shaker2_check_state(const shaker2_state *x)
{
    {
        shaker2_real position2, velocity2, speed2, phase2;
        position2 = 0.0;
        velocity2 = 0.0;
        speed2 = 0.0;
        phase2 = 0.0;
        for (int i = 0; i < 3; ++i) {
            const shaker2_real position = x->position[i];
            position2 += position * position;
            const shaker2_real velocity = x->V[i];
            velocity2 += velocity * velocity;
            const shaker2_real speed = x->V[i + 3];
            speed2 += speed * speed;
        }
        for (int s = 0; s < SHAKER2_N; ++s) {
            const shaker2_real phase = x->phi[s];
            phase2 += phase * phase;
            const shaker2_real speed = x->phi_dot[s];
            speed2 += speed * speed;
        }
        const shaker2_real norm2 = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
            + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
        if (norm2 >= 0.998001 && norm2 <= 1.002001 && position2 < SHAKER2_MAX_POSITION * SHAKER2_MAX_POSITION
            && velocity2 < SHAKER2_MAX_VELOCITY * SHAKER2_MAX_VELOCITY
            && speed2 < SHAKER2_MAX_SPEED * SHAKER2_MAX_SPEED
            && phase2 < SHAKER2_MAX_PHASE * SHAKER2_MAX_PHASE) { return SHAKER2_OK; }
    }
    shaker2_status status = shaker2_within(x->position, 3, SHAKER2_MAX_POSITION);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(x->attitude, 4, 2.0);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(x->V, 6, SHAKER2_MAX_SPEED);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(x->V, 3, SHAKER2_MAX_VELOCITY);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(x->phi, SHAKER2_N, SHAKER2_MAX_PHASE);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(x->phi_dot, SHAKER2_N, SHAKER2_MAX_SPEED);
    if (status != SHAKER2_OK) { return status; }
    const shaker2_real norm2 = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
        + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
    if (!(norm2 >= 0.998001 && norm2 <= 1.002001)) { return SHAKER2_RANGE; }
    return SHAKER2_OK;
}

/* The same of a state, and then: are values of the flywheels within a limit? */
SHAKER2_CODE
static shaker2_status shaker2_check_motion(const shaker2_state *x, const shaker2_real values[SHAKER2_N],
                                           shaker2_real limit)
{
    {
        shaker2_real position2, velocity2, speed2, phase2, given2;
        position2 = 0.0;
        velocity2 = 0.0;
        speed2 = 0.0;
        phase2 = 0.0;
        given2 = 0.0;
        for (int i = 0; i < 3; ++i) {
            const shaker2_real position = x->position[i];
            position2 += position * position;
            const shaker2_real velocity = x->V[i];
            velocity2 += velocity * velocity;
            const shaker2_real speed = x->V[i + 3];
            speed2 += speed * speed;
        }
        for (int s = 0; s < SHAKER2_N; ++s) {
            const shaker2_real phase = x->phi[s];
            phase2 += phase * phase;
            const shaker2_real given = values[s];
            given2 += given * given;
            const shaker2_real speed = x->phi_dot[s];
            speed2 += speed * speed;
        }
        const shaker2_real norm2 = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
            + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
        if (norm2 >= 0.998001 && norm2 <= 1.002001 && position2 < SHAKER2_MAX_POSITION * SHAKER2_MAX_POSITION
            && velocity2 < SHAKER2_MAX_VELOCITY * SHAKER2_MAX_VELOCITY
            && speed2 < SHAKER2_MAX_SPEED * SHAKER2_MAX_SPEED
            && phase2 < SHAKER2_MAX_PHASE * SHAKER2_MAX_PHASE
            && given2 < limit * limit) { return SHAKER2_OK; }
    }
    shaker2_status status = shaker2_within(x->position, 3, SHAKER2_MAX_POSITION);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(x->attitude, 4, 2.0);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(x->V, 6, SHAKER2_MAX_SPEED);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(x->V, 3, SHAKER2_MAX_VELOCITY);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(x->phi, SHAKER2_N, SHAKER2_MAX_PHASE);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(x->phi_dot, SHAKER2_N, SHAKER2_MAX_SPEED);
    if (status != SHAKER2_OK) { return status; }
    const shaker2_real norm2 = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
        + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
    if (!(norm2 >= 0.998001 && norm2 <= 1.002001)) { return SHAKER2_RANGE; }
    status = shaker2_within(values, SHAKER2_N, limit);
    if (status != SHAKER2_OK) { return status; }
    return SHAKER2_OK;
}

/* Rotation matrix of a quaternion of any length: no square root is needed. */
SHAKER2_CODE
static void shaker2_rotation(const shaker2_real q[4], shaker2_real *restrict C /* [9] */)
{
    const shaker2_real k = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
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
SHAKER2_CODE
static void shaker2_rotate_back(const shaker2_real C[9], const shaker2_real a[3],
                                shaker2_real *restrict out /* [3] */)
{
    out[0] = C[0] * a[0] + C[3] * a[1] + C[6] * a[2];
    out[1] = C[1] * a[0] + C[4] * a[1] + C[7] * a[2];
    out[2] = C[2] * a[0] + C[5] * a[1] + C[8] * a[2];
}

/* Sines and cosines of all phases.
 * |x| <= 1e+07, which the caller checks. Error at most 1 unit in the last place
 * for |x| <= 8 pi, and 1e-16 absolute beyond. Other x give meaningless results, but the call is safe. */
SHAKER2_CODE
static void shaker2_sincos_each(const shaker2_real x[SHAKER2_N],
                                shaker2_real *restrict sine /* [SHAKER2_N] */,
                                shaker2_real *restrict cosine /* [SHAKER2_N] */)
{
    for (int s = 0; s < SHAKER2_N; ++s) {
        /* k = x/(pi/2), rounded: adding the large constant leaves the integer k in the last bits of the
         * sum. */
        const shaker2_real shifted = x[s] * 0.6366197723675814 + 6755399441055744.0;
        const shaker2_word quadrant = shaker2_bits_of(shifted);  /* mod 4: its last two bits */
        const shaker2_real k = shifted - 6755399441055744.0;
        /* r = r_hi - r_tail = x - k pi/2, pi/2 in three parts: the product with the first is exact. */
        const shaker2_real rest = x[s] - k * 1.570796325802803;
        const shaker2_real second = k * 9.920935796805365e-10;
        const shaker2_real r_hi = rest - second;
        /* rounding error of r_hi, and the third part */
        const shaker2_real r_tail = r_hi - rest + second + k * 3.9455541665632055e-24;
        const shaker2_real z = r_hi * r_hi;
        /* cos r_hi = 1 - z/2 + z^2 C(z); the rounding error of 1 - z/2 is added back. */
        const shaker2_real half_z = z * 0.5;
        const shaker2_real flat = 1.0 - half_z;
        const shaker2_real cos_fit = 0.0416666666666666
            + z * (-0.001388888888887447 + z
            * (2.4801587289666868e-5 + z * (-2.755731439924032e-7
            + z * (2.087572898867696e-9 + z * -1.1359916930271879e-11))));
        const shaker2_real cos_r = flat + (1.0 - flat - half_z + (z * z * cos_fit + r_hi * r_tail));
        /* sin r_hi = r_hi - r_hi^3 S(z), S with positive sign so that sin(-0) = -0. */
        const shaker2_real sin_fit = 0.1666666666666663
            + z * (-0.00833333333332184 + z * (0.00019841269829358541
            + z * (-2.7557313538526495e-6 + z * (2.5050734392488434e-8 + z * -1.5895433551463968e-10))));
        const shaker2_real sin_r = r_hi - (z * r_hi * sin_fit + flat * r_tail);
        /* Odd quadrants exchange sine and cosine; quadrants 2, 3 negate the sine, 1, 2 the cosine. */
        const shaker2_word sin_bits = shaker2_bits_of(sin_r);
        const shaker2_word cos_bits = shaker2_bits_of(cos_r);
        const shaker2_word exchange = (sin_bits ^ cos_bits) & (0u - (quadrant & 1u));
        const shaker2_word sine_sign = (quadrant << 62u) & 0x8000000000000000u;
        const shaker2_word cosine_sign = ((quadrant + 1u) << 62u) & 0x8000000000000000u;
        sine[s] = shaker2_real_of(sin_bits ^ exchange ^ sine_sign);
        cosine[s] = shaker2_real_of(cos_bits ^ exchange ^ cosine_sign);
    }
}

/* First moment and inertia of all bodies, and their rates in E1; w = phi', (2), (6). */
SHAKER2_CODE
static void shaker2_sum_mass(const shaker2_table *table, const shaker2_real sine[SHAKER2_N],
                             const shaker2_real cosine[SHAKER2_N], const shaker2_real phi_dot[SHAKER2_N],
                             shaker2_sums *restrict sum)
{
    sum->J[0] = table->inertia[0];  sum->J[1] = table->inertia[1];  sum->J[2] = table->inertia[2];
    sum->J[3] = table->inertia[3];  sum->J[4] = table->inertia[4];  sum->J[5] = table->inertia[5];
    sum->J_dot[0] = 0.0;  sum->J_dot[1] = 0.0;  sum->J_dot[2] = 0.0;
    sum->J_dot[3] = 0.0;  sum->J_dot[4] = 0.0;  sum->J_dot[5] = 0.0;
    sum->mu[0] = table->first_moment[0];
    sum->mu[1] = table->first_moment[1];
    sum->mu[2] = table->first_moment[2];
    sum->mu_dot[0] = 0.0;  sum->mu_dot[1] = 0.0;  sum->mu_dot[2] = 0.0;
    for (int k = 0; k < SHAKER2_N; ++k) {
        const shaker2_real s = sine[k];
        const shaker2_real c = cosine[k];
        const shaker2_real w = phi_dot[k];
        const shaker2_real c2 = 1.0 - 2.0 * (s * s);  /* cos 2 phi, then sin 2 phi */
        const shaker2_real s2 = 2.0 * c * s;
        const shaker2_real dc = -w * s;  /* time derivatives: d(cos phi)/dt, ... */
        const shaker2_real ds = w * c;
        const shaker2_real dc2 = -2.0 * w * s2;
        const shaker2_real ds2 = 2.0 * w * c2;
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
SHAKER2_CODE
static SHAKER2_COPIED void shaker2_sum_steady_spin(const shaker2_table *table,
                                                   const shaker2_real sine[SHAKER2_N],
                                                   const shaker2_real cosine[SHAKER2_N],
                                                   const shaker2_real phi_dot[SHAKER2_N],
                                                   shaker2_sums *restrict sum)
{
    sum->h_rel[0] = 0.0;  sum->h_rel[1] = 0.0;  sum->h_rel[2] = 0.0;
    sum->g_rel[0] = 0.0;  sum->g_rel[1] = 0.0;  sum->g_rel[2] = 0.0;
    sum->a_rel[0] = 0.0;  sum->a_rel[1] = 0.0;  sum->a_rel[2] = 0.0;
    for (int k = 0; k < SHAKER2_N; ++k) {
        const shaker2_real s = sine[k];
        const shaker2_real c = cosine[k];
        const shaker2_real w = phi_dot[k];
        const shaker2_real dc = -w * s;  /* time derivatives: d(cos phi)/dt, ... */
        const shaker2_real ds = w * c;
        const shaker2_real ddc = -w * ds;  /* second time derivatives */
        const shaker2_real dds = w * dc;
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
SHAKER2_CODE
static SHAKER2_COPIED void shaker2_sum_spin(const shaker2_table *table, const shaker2_real sine[SHAKER2_N],
                                            const shaker2_real cosine[SHAKER2_N],
                                            const shaker2_real phi_dot[SHAKER2_N],
                                            const shaker2_real phi_ddot[SHAKER2_N],
                                            shaker2_sums *restrict sum)
{
    sum->h_rel[0] = 0.0;  sum->h_rel[1] = 0.0;  sum->h_rel[2] = 0.0;
    sum->g_rel[0] = 0.0;  sum->g_rel[1] = 0.0;  sum->g_rel[2] = 0.0;
    sum->a_rel[0] = 0.0;  sum->a_rel[1] = 0.0;  sum->a_rel[2] = 0.0;
    for (int k = 0; k < SHAKER2_N; ++k) {
        const shaker2_real s = sine[k];
        const shaker2_real c = cosine[k];
        const shaker2_real w = phi_dot[k];
        const shaker2_real a = phi_ddot[k];
        const shaker2_real dc = -w * s;  /* time derivatives: d(cos phi)/dt, ... */
        const shaker2_real ds = w * c;
        const shaker2_real ddc = -w * ds - a * s;  /* second time derivatives */
        const shaker2_real dds = a * c + w * dc;
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

/* Rotation vector of a quaternion of about unit length; its length is at most pi. */
SHAKER2_CODE
static void shaker2_rotation_vector(const shaker2_real q[4], shaker2_real *restrict r /* [3] */)
{
    /* q and -q are the same rotation: take the one of the smaller angle */
    const shaker2_real side = (q[0] < 0.0) ? -1.0 : 1.0;
    const shaker2_real square = q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    shaker2_real ratio;  /* rotation angle, then divided by the length of the vector part */
    shaker2_real divisor;
    if (square > 1.0e-30) {
        divisor = shaker2_sqrt(square);
        ratio = 2.0 * shaker2_atan2(divisor, side * q[0]);
    } else {
        /* |w| is near 1 here; the test only prevents a division by zero for other q */
        divisor = (side * q[0] > 0.5) ? side * q[0] : 1.0;
        ratio = 2.0;
    }
    ratio = ratio / divisor;
    r[0] = side * ratio * q[1];  r[1] = side * ratio * q[2];  r[2] = side * ratio * q[3];
}

/* Adds the suspension: -(stiffness x + damping V), x = (C^T (O1 - position), rotation vector of C_eq^T C),
 * (7). */
SHAKER2_CODE
static void shaker2_suspend(const shaker2_suspension *law, const shaker2_state *x, const shaker2_real C[9],
                            shaker2_real *restrict F /* [6] */)
{
    shaker2_real shift[3];
    shaker2_real shift1[3];  /* C^T (O1 - position) */
    shaker2_real turn[4];  /* quaternion of C_eq^T C */
    shaker2_real angle[3];  /* its rotation vector */
    shift[0] = x->position[0] - law->position[0];
    shift[1] = x->position[1] - law->position[1];
    shift[2] = x->position[2] - law->position[2];
    shaker2_rotate_back(C, shift, shift1);
    turn[0] = x->attitude[0] * law->attitude[0] + x->attitude[1] * law->attitude[1]
        + x->attitude[2] * law->attitude[2] + x->attitude[3] * law->attitude[3];
    turn[1] = x->attitude[1] * law->attitude[0] + x->attitude[2] * law->attitude[3]
        - x->attitude[0] * law->attitude[1] - x->attitude[3] * law->attitude[2];
    turn[2] = x->attitude[2] * law->attitude[0] + x->attitude[3] * law->attitude[1]
        - x->attitude[0] * law->attitude[2] - x->attitude[1] * law->attitude[3];
    turn[3] = x->attitude[1] * law->attitude[2] + x->attitude[3] * law->attitude[0]
        - x->attitude[0] * law->attitude[3] - x->attitude[2] * law->attitude[1];
    shaker2_rotation_vector(turn, angle);
    for (int i = 0; i < 6; ++i) {
        F[i] -= x->V[0] * law->damping[i][0] + x->V[1] * law->damping[i][1] + x->V[2] * law->damping[i][2]
            + x->V[3] * law->damping[i][3] + x->V[4] * law->damping[i][4] + x->V[5] * law->damping[i][5]
            + law->stiffness[i][0] * shift1[0] + law->stiffness[i][1] * shift1[1]
            + law->stiffness[i][2] * shift1[2] + law->stiffness[i][3] * angle[0]
            + law->stiffness[i][4] * angle[1] + law->stiffness[i][5] * angle[2];
    }
}

/* Total external wrench of weight, suspension, from checked inputs, (7). */
SHAKER2_CODE
static void shaker2_external(const shaker2_table *table, const shaker2_state *x, const shaker2_sums *sum,
                             const shaker2_real C[9], const shaker2_real g[3],
                             shaker2_real *restrict F /* [6] */)
{
    F[0] = 0.0;  F[1] = 0.0;  F[2] = 0.0;
    F[3] = 0.0;  F[4] = 0.0;  F[5] = 0.0;
    /* weight of all bodies: its line of action moves with the flywheels */
    F[0] += g[0] * table->mass;  F[1] += g[1] * table->mass;  F[2] += g[2] * table->mass;
    F[3] += g[2] * sum->mu[1] - g[1] * sum->mu[2];
    F[4] += g[0] * sum->mu[2] - g[2] * sum->mu[0];
    F[5] += g[1] * sum->mu[0] - g[0] * sum->mu[1];
    shaker2_suspend(&table->suspension, x, C, F);
}

/* Momentum screw Z = K V + sum I phi' of the sums, (2). */
SHAKER2_CODE
static void shaker2_momentum_screw(const shaker2_table *table, const shaker2_sums *sum,
                                   const shaker2_real V[6], shaker2_real *restrict Z /* [6] */)
{
    Z[0] = table->mass * V[0] + sum->mu[2] * V[4] + sum->mu_dot[0] - sum->mu[1] * V[5];
    Z[1] = table->mass * V[1] + sum->mu[0] * V[5] + sum->mu_dot[1] - sum->mu[2] * V[3];
    Z[2] = table->mass * V[2] + sum->mu[1] * V[3] + sum->mu_dot[2] - sum->mu[0] * V[4];
    Z[3] = sum->J[0] * V[3] + sum->J[3] * V[4] + sum->J[4] * V[5] + sum->h_rel[0] + sum->mu[1] * V[2]
        - sum->mu[2] * V[1];
    Z[4] = sum->J[1] * V[4] + sum->J[3] * V[3] + sum->J[5] * V[5] + sum->h_rel[1] + sum->mu[2] * V[0]
        - sum->mu[0] * V[2];
    Z[5] = sum->J[2] * V[5] + sum->J[4] * V[3] + sum->J[5] * V[4] + sum->h_rel[2] + sum->mu[0] * V[1]
        - sum->mu[1] * V[0];
}

/* Turns F into the right-hand side of (8): F - Phi Z - K* V - the flywheels' terms, (2), (4), (5). */
SHAKER2_CODE
static void shaker2_subtract_rates(const shaker2_table *table, const shaker2_sums *sum,
                                   const shaker2_real V[6], shaker2_real *restrict F /* [6] */)
{
    /* momentum screw Z = K V + sum I phi' */
    const shaker2_real Z1 = table->mass * V[0] + sum->mu[2] * V[4] + sum->mu_dot[0] - sum->mu[1] * V[5];
    const shaker2_real Z2 = table->mass * V[1] + sum->mu[0] * V[5] + sum->mu_dot[1] - sum->mu[2] * V[3];
    const shaker2_real Z3 = table->mass * V[2] + sum->mu[1] * V[3] + sum->mu_dot[2] - sum->mu[0] * V[4];
    const shaker2_real Z4 = sum->J[0] * V[3] + sum->J[3] * V[4] + sum->J[4] * V[5] + sum->h_rel[0]
        + sum->mu[1] * V[2] - sum->mu[2] * V[1];
    const shaker2_real Z5 = sum->J[1] * V[4] + sum->J[3] * V[3] + sum->J[5] * V[5] + sum->h_rel[1]
        + sum->mu[2] * V[0] - sum->mu[0] * V[2];
    const shaker2_real Z6 = sum->J[2] * V[5] + sum->J[4] * V[3] + sum->J[5] * V[4] + sum->h_rel[2]
        + sum->mu[0] * V[1] - sum->mu[1] * V[0];
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
SHAKER2_CODE
static inline shaker2_status shaker2_factor3(const shaker2_real S[6], shaker2_factors3 *restrict L)
{
    if (!(S[0] >= 2.2250738585072014e-308)) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
    const shaker2_real r1 = 1.0 / S[0];
    const shaker2_real l21 = S[3] * r1;
    const shaker2_real l31 = S[4] * r1;
    const shaker2_real d2 = S[1] - l21 * S[3];
    if (!(d2 >= 2.2250738585072014e-308)) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
    const shaker2_real r2 = 1.0 / d2;
    const shaker2_real p32 = S[5] - l31 * S[3];
    const shaker2_real l32 = p32 * r2;
    const shaker2_real d3 = S[2] - l31 * S[4] - l32 * p32;
    if (!(d3 >= 2.2250738585072014e-308)) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
    L->r1 = r1;
    L->r2 = r2;
    L->d3 = d3;
    L->l21 = l21;
    L->l31 = l31;
    L->l32 = l32;
    return SHAKER2_OK;
}

/* Solves S y = b by S = L D L^T. */
SHAKER2_CODE
static inline void shaker2_solve3(const shaker2_factors3 *L, const shaker2_real b[3],
                                  shaker2_real *restrict y /* [3] */)
{
    /* L z = b, then L^T y = D^-1 z */
    const shaker2_real z2 = b[1] - L->l21 * b[0];
    const shaker2_real y3 = (b[2] - L->l31 * b[0] - L->l32 * z2) / L->d3;
    const shaker2_real y2 = z2 * L->r2 - L->l32 * y3;
    y[0] = b[0] * L->r1 - L->l21 * y2 - L->l31 * y3;
    y[1] = y2;  y[2] = y3;
}

/* Factors K: its translational block is constant, so that a 3x3 matrix is left, (8). */
SHAKER2_CODE
static shaker2_status shaker2_factor_carrier(const shaker2_table *table, const shaker2_sums *sum,
                                             shaker2_carrier_factor *restrict K)
{
    shaker2_status status;
    K->rho[0] = table->mass_inverse * sum->mu[0];
    K->rho[1] = table->mass_inverse * sum->mu[1];
    K->rho[2] = table->mass_inverse * sum->mu[2];
    shaker2_real S[6];  /* inertia about the mass centre */
    S[0] = sum->J[0] - sum->mu[1] * K->rho[1] - sum->mu[2] * K->rho[2];
    S[1] = sum->J[1] - sum->mu[0] * K->rho[0] - sum->mu[2] * K->rho[2];
    S[2] = sum->J[2] - sum->mu[0] * K->rho[0] - sum->mu[1] * K->rho[1];
    S[3] = sum->J[3] + sum->mu[1] * K->rho[0];
    S[4] = sum->J[4] + sum->mu[2] * K->rho[0];
    S[5] = sum->J[5] + sum->mu[2] * K->rho[1];
    status = shaker2_factor3(S, &K->L);
    if (status != SHAKER2_OK) { return status; }
    return SHAKER2_OK;
}

/* Solves K y = F by the factors of K, (8). */
SHAKER2_CODE
static void shaker2_solve_carrier(const shaker2_table *table, const shaker2_carrier_factor *K,
                                  const shaker2_real F[6], shaker2_real *restrict y /* [6] */)
{
    shaker2_real moment[3];  /* about the mass centre */
    shaker2_real omega_dot[3];
    moment[0] = F[1] * K->rho[2] + F[3] - F[2] * K->rho[1];
    moment[1] = F[2] * K->rho[0] + F[4] - F[0] * K->rho[2];
    moment[2] = F[0] * K->rho[1] + F[5] - F[1] * K->rho[0];
    shaker2_solve3(&K->L, moment, omega_dot);
    y[0] = F[0] * table->mass_inverse + omega_dot[2] * K->rho[1] - omega_dot[1] * K->rho[2];
    y[1] = F[1] * table->mass_inverse + omega_dot[0] * K->rho[2] - omega_dot[2] * K->rho[0];
    y[2] = F[2] * table->mass_inverse + omega_dot[1] * K->rho[0] - omega_dot[0] * K->rho[1];
    y[3] = omega_dot[0];  y[4] = omega_dot[1];  y[5] = omega_dot[2];
}

/* Solves K y = F where no other right-hand side follows: factors of K as factor_carrier finds them, (8). */
SHAKER2_CODE
static shaker2_status shaker2_solve_carrier_once(const shaker2_table *table, const shaker2_sums *sum,
                                                 const shaker2_real F[6], shaker2_real y[6])
{
    shaker2_real rho[3];  /* mass centre from O1, in E1 */
    rho[0] = table->mass_inverse * sum->mu[0];
    rho[1] = table->mass_inverse * sum->mu[1];
    rho[2] = table->mass_inverse * sum->mu[2];
    shaker2_real S[6];  /* inertia about the mass centre */
    S[0] = sum->J[0] - sum->mu[1] * rho[1] - sum->mu[2] * rho[2];
    S[1] = sum->J[1] - sum->mu[0] * rho[0] - sum->mu[2] * rho[2];
    S[2] = sum->J[2] - sum->mu[0] * rho[0] - sum->mu[1] * rho[1];
    S[3] = sum->J[3] + sum->mu[1] * rho[0];
    S[4] = sum->J[4] + sum->mu[2] * rho[0];
    S[5] = sum->J[5] + sum->mu[2] * rho[1];
    if (!(S[0] >= 2.2250738585072014e-308)) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
    const shaker2_real r1 = 1.0 / S[0];
    const shaker2_real l21 = S[3] * r1;
    const shaker2_real l31 = S[4] * r1;
    const shaker2_real d2 = S[1] - l21 * S[3];
    if (!(d2 >= 2.2250738585072014e-308)) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
    const shaker2_real r2 = 1.0 / d2;
    const shaker2_real p32 = S[5] - l31 * S[3];
    const shaker2_real l32 = p32 * r2;
    const shaker2_real d3 = S[2] - l31 * S[4] - l32 * p32;
    if (!(d3 >= 2.2250738585072014e-308)) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
    shaker2_real moment[3];  /* about the mass centre */
    moment[0] = F[1] * rho[2] + F[3] - F[2] * rho[1];
    moment[1] = F[2] * rho[0] + F[4] - F[0] * rho[2];
    moment[2] = F[0] * rho[1] + F[5] - F[1] * rho[0];
    /* L z = b, then L^T y = D^-1 z */
    const shaker2_real z2 = moment[1] - l21 * moment[0];
    const shaker2_real y3 = (moment[2] - l31 * moment[0] - l32 * z2) / d3;
    const shaker2_real y2 = z2 * r2 - l32 * y3;
    const shaker2_real y1 = moment[0] * r1 - l21 * y2 - l31 * y3;
    const shaker2_real v1_dot = F[0] * table->mass_inverse + y3 * rho[1] - y2 * rho[2];
    const shaker2_real v2_dot = F[1] * table->mass_inverse + y1 * rho[2] - y3 * rho[0];
    const shaker2_real v3_dot = F[2] * table->mass_inverse + y2 * rho[0] - y1 * rho[1];
    y[0] = v1_dot;  y[1] = v2_dot;  y[2] = v3_dot;
    y[3] = y1;      y[4] = y2;      y[5] = y3;
    return SHAKER2_OK;
}

/* K V* = F - M V - sum(I phi'' + J phi') from checked inputs; V_dot is written where the status is OK,
 * (8). */
SHAKER2_CODE
static shaker2_status shaker2_accelerate(const shaker2_table *table, const shaker2_state *x,
                                         const shaker2_real sine[SHAKER2_N],
                                         const shaker2_real cosine[SHAKER2_N],
                                         const shaker2_real phi_ddot[SHAKER2_N], shaker2_real V_dot[6])
{
    shaker2_status status;
    shaker2_real C[9];  /* attitude */
    shaker2_rotation(x->attitude, C);
    shaker2_real g[3];  /* gravity in E1 */
    shaker2_rotate_back(C, table->gravity, g);
    shaker2_sums sum;
    shaker2_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    shaker2_sum_spin(table, sine, cosine, x->phi_dot, phi_ddot, &sum);
    shaker2_real F[6];  /* wrench (7); then the right-hand side of (8) */
    shaker2_external(table, x, &sum, C, g, F);
    shaker2_subtract_rates(table, &sum, x->V, F);
    status = shaker2_solve_carrier_once(table, &sum, F, V_dot);
    if (status != SHAKER2_OK) { return status; }
    return SHAKER2_OK;
}

/* (8) */
SHAKER2_CODE
shaker2_status shaker2_forward(const shaker2_table *table, const shaker2_state *x,
                               const shaker2_real phi_ddot[SHAKER2_N], shaker2_real V_dot[6])
{
    if (table == NULL || x == NULL || phi_ddot == NULL || V_dot == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status = shaker2_check_motion(x, phi_ddot, SHAKER2_MAX_ACCELERATION);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real sine[SHAKER2_N];
    shaker2_real cosine[SHAKER2_N];
    shaker2_sincos_each(x->phi, sine, cosine);
    status = shaker2_accelerate(table, x, sine, cosine, phi_ddot, V_dot);
    if (status != SHAKER2_OK) { return status; }
    return SHAKER2_OK;
}

/* M = Phi K + K*, (9). */
SHAKER2_CODE
static void shaker2_velocity_matrix(const shaker2_real V[6], shaker2_matrices_result *restrict out)
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
SHAKER2_CODE
shaker2_status shaker2_matrices(const shaker2_table *table, const shaker2_state *x,
                                shaker2_matrices_result *out)
{
    if (table == NULL || x == NULL || out == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status = shaker2_check_state(x);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real C[9];  /* attitude */
    shaker2_rotation(x->attitude, C);
    shaker2_real g[3];  /* gravity in E1 */
    shaker2_rotate_back(C, table->gravity, g);
    shaker2_sums sum;
    shaker2_real sine[SHAKER2_N];
    shaker2_real cosine[SHAKER2_N];
    shaker2_sincos_each(x->phi, sine, cosine);
    shaker2_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    shaker2_real F[6];
    shaker2_external(table, x, &sum, C, g, F);
    out->F[0] = F[0];  out->F[1] = F[1];  out->F[2] = F[2];
    out->F[3] = F[3];  out->F[4] = F[4];  out->F[5] = F[5];
    /* K (2) and its rate (6) */
    out->K[0][0] = table->mass;  out->K[0][1] = 0.0;          out->K[0][2] = 0.0;
    out->K[0][3] = 0.0;          out->K[0][4] = sum.mu[2];    out->K[0][5] = -sum.mu[1];
    out->K[1][0] = 0.0;          out->K[1][1] = table->mass;  out->K[1][2] = 0.0;
    out->K[1][3] = -sum.mu[2];   out->K[1][4] = 0.0;          out->K[1][5] = sum.mu[0];
    out->K[2][0] = 0.0;          out->K[2][1] = 0.0;          out->K[2][2] = table->mass;
    out->K[2][3] = sum.mu[1];    out->K[2][4] = -sum.mu[0];   out->K[2][5] = 0.0;
    out->K[3][0] = 0.0;         out->K[3][1] = -sum.mu[2];  out->K[3][2] = sum.mu[1];
    out->K[3][3] = sum.J[0];    out->K[3][4] = sum.J[3];    out->K[3][5] = sum.J[4];
    out->K[4][0] = sum.mu[2];   out->K[4][1] = 0.0;         out->K[4][2] = -sum.mu[0];
    out->K[4][3] = sum.J[3];    out->K[4][4] = sum.J[1];    out->K[4][5] = sum.J[5];
    out->K[5][0] = -sum.mu[1];  out->K[5][1] = sum.mu[0];   out->K[5][2] = 0.0;
    out->K[5][3] = sum.J[4];    out->K[5][4] = sum.J[5];    out->K[5][5] = sum.J[2];
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
    shaker2_velocity_matrix(x->V, out);
    shaker2_real column[6];  /* I_s */
    shaker2_real rate[6];  /* dI_s / dphi */
    for (int s = 0; s < SHAKER2_N; ++s) {
        const shaker2_real s_phi = sine[s];
        const shaker2_real c_phi = cosine[s];
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
        out->J[0][s] = column[2] * x->V[4] - column[1] * x->V[5] + rate[0] * x->phi_dot[s];
        out->I_[1][s] = column[1];
        out->J[1][s] = column[0] * x->V[5] - column[2] * x->V[3] + rate[1] * x->phi_dot[s];
        out->I_[2][s] = column[2];
        out->J[2][s] = column[1] * x->V[3] - column[0] * x->V[4] + rate[2] * x->phi_dot[s];
        out->I_[3][s] = column[3];
        out->J[3][s] = column[2] * x->V[1] + column[5] * x->V[4] - column[1] * x->V[2] - column[4] * x->V[5]
            + rate[3] * x->phi_dot[s];
        out->I_[4][s] = column[4];
        out->J[4][s] = column[0] * x->V[2] + column[3] * x->V[5] - column[2] * x->V[0] - column[5] * x->V[3]
            + rate[4] * x->phi_dot[s];
        out->I_[5][s] = column[5];
        out->J[5][s] = column[1] * x->V[0] + column[4] * x->V[3] - column[0] * x->V[1] - column[3] * x->V[4]
            + rate[5] * x->phi_dot[s];
    }
    return SHAKER2_OK;
}

/* (1), (2) */
SHAKER2_CODE
shaker2_status shaker2_momentum(const shaker2_table *table, const shaker2_state *x,
                                shaker2_momentum_result *out)
{
    if (table == NULL || x == NULL || out == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status = shaker2_check_state(x);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real C[9];  /* attitude */
    shaker2_rotation(x->attitude, C);
    shaker2_sums sum;
    shaker2_real sine[SHAKER2_N];
    shaker2_real cosine[SHAKER2_N];
    shaker2_sincos_each(x->phi, sine, cosine);
    shaker2_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    shaker2_sum_steady_spin(table, sine, cosine, x->phi_dot, &sum);
    shaker2_real Z[6];  /* momentum screw (2) */
    shaker2_momentum_screw(table, &sum, x->V, Z);
    shaker2_real spin = 0.0;  /* sum phi' (I^T V + Theta_ff phi') */
    for (int s = 0; s < SHAKER2_N; ++s) {
        const shaker2_real s_phi = sine[s];
        const shaker2_real c_phi = cosine[s];
        /* I_s . V */
        const shaker2_real along = (table->flywheel[s].mu_s[0] * c_phi - table->flywheel[s].mu_c[0] * s_phi)
            * x->V[0] + (table->flywheel[s].mu_s[1] * c_phi - table->flywheel[s].mu_c[1] * s_phi) * x->V[1]
            + (table->flywheel[s].mu_s[2] * c_phi - table->flywheel[s].mu_c[2] * s_phi) * x->V[2]
            + (table->flywheel[s].t_c[0] * c_phi + table->flywheel[s].t_s[0] * s_phi
            + table->flywheel[s].t_0[0]) * x->V[3]
            + (table->flywheel[s].t_c[1] * c_phi + table->flywheel[s].t_s[1] * s_phi
            + table->flywheel[s].t_0[1]) * x->V[4]
            + (table->flywheel[s].t_c[2] * c_phi + table->flywheel[s].t_s[2] * s_phi
            + table->flywheel[s].t_0[2]) * x->V[5];
        spin += x->phi_dot[s] * (along + table->flywheel[s].spin * x->phi_dot[s]);
    }
    shaker2_real energy = 0.5 * Z[3] * x->V[3] + 0.5 * Z[4] * x->V[4] + 0.5 * Z[5] * x->V[5]
        + 0.5 * Z[0] * x->V[0] + 0.5 * Z[1] * x->V[1] + 0.5 * Z[2] * x->V[2] + 0.5 * spin;
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
    shaker2_real v[3];  /* of the mass centre in E1, from the momentum of the bodies, without the fluid's */
    v[0] = Z[0] * table->mass_inverse;  v[1] = Z[1] * table->mass_inverse;  v[2] = Z[2] * table->mass_inverse;
    out->center_of_mass_velocity[0] = C[0] * v[0] + C[1] * v[1] + C[2] * v[2];
    out->center_of_mass_velocity[1] = C[3] * v[0] + C[4] * v[1] + C[5] * v[2];
    out->center_of_mass_velocity[2] = C[6] * v[0] + C[7] * v[1] + C[8] * v[2];
    return SHAKER2_OK;
}

/* Column of I of one flywheel, and its drive torque at V* = 0, phi'' = 0, (9). */
SHAKER2_CODE
static SHAKER2_COPIED void shaker2_couple(const shaker2_row *row, shaker2_real s, shaker2_real c,
                                          const shaker2_real origin_acceleration[3],
                                          const shaker2_real spun[6], shaker2_coupling *restrict out)
{
    const shaker2_real two_c2 = 2.0 - 4.0 * (s * s);  /* twice the cosine and sine of the double phase */
    const shaker2_real two_s2 = 4.0 * c * s;
    out->I_[0] = row->mu_s[0] * c - row->mu_c[0] * s;
    out->I_[1] = row->mu_s[1] * c - row->mu_c[1] * s;
    out->I_[2] = row->mu_s[2] * c - row->mu_c[2] * s;
    out->I_[3] = row->t_c[0] * c + row->t_s[0] * s + row->t_0[0];
    out->I_[4] = row->t_c[1] * c + row->t_s[1] * s + row->t_0[1];
    out->I_[5] = row->t_c[2] * c + row->t_s[2] * s + row->t_0[2];
    /* dJ / dphi */
    const shaker2_real J_p1 = row->J_2s[0] * two_c2 + row->J_s[0] * c - row->J_2c[0] * two_s2
        - row->J_c[0] * s;
    const shaker2_real J_p2 = row->J_2s[1] * two_c2 + row->J_s[1] * c - row->J_2c[1] * two_s2
        - row->J_c[1] * s;
    const shaker2_real J_p3 = row->J_2s[2] * two_c2 + row->J_s[2] * c - row->J_2c[2] * two_s2
        - row->J_c[2] * s;
    const shaker2_real J_p4 = row->J_2s[3] * two_c2 + row->J_s[3] * c - row->J_2c[3] * two_s2
        - row->J_c[3] * s;
    const shaker2_real J_p5 = row->J_2s[4] * two_c2 + row->J_s[4] * c - row->J_2c[4] * two_s2
        - row->J_c[4] * s;
    const shaker2_real J_p6 = row->J_2s[5] * two_c2 + row->J_s[5] * c - row->J_2c[5] * two_s2
        - row->J_c[5] * s;
    out->bias = J_p1 * spun[0] + J_p2 * spun[1] + J_p3 * spun[2] + J_p4 * spun[3] + J_p5 * spun[4]
        + J_p6 * spun[5] + out->I_[0] * origin_acceleration[0] + out->I_[1] * origin_acceleration[1]
        + out->I_[2] * origin_acceleration[2];
}

/* Eliminates one free flywheel: K - I I^T / Theta_ff, F - I rate. */
SHAKER2_CODE
static void shaker2_eliminate(const shaker2_real column[6], shaker2_real spin_inv, shaker2_real rate,
                              shaker2_schur *restrict K, shaker2_real *restrict F /* [6] */)
{
    shaker2_real scaled[6];  /* I / Theta_ff */
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
SHAKER2_CODE
static void shaker2_balance(const shaker2_table *table, const shaker2_state *x,
                            const shaker2_real sine[SHAKER2_N], const shaker2_real cosine[SHAKER2_N],
                            const shaker2_real V_dot[6], const shaker2_real phi_ddot[SHAKER2_N],
                            shaker2_real *restrict tau /* [SHAKER2_N] */)
{
    shaker2_real C[9];  /* attitude */
    shaker2_rotation(x->attitude, C);
    shaker2_real g[3];  /* gravity in E1 */
    shaker2_rotate_back(C, table->gravity, g);
    shaker2_real origin_acceleration[3];  /* acceleration of O1 at V* = 0, minus gravity */
    origin_acceleration[0] = x->V[4] * x->V[2] - g[0] - x->V[5] * x->V[1];
    origin_acceleration[1] = x->V[5] * x->V[0] - g[1] - x->V[3] * x->V[2];
    origin_acceleration[2] = x->V[3] * x->V[1] - g[2] - x->V[4] * x->V[0];
    shaker2_real spun[6];  /* six numbers: J . spun = -omega . J omega / 2 for every inertia J */
    spun[0] = -0.5 * (x->V[3] * x->V[3]);
    spun[1] = -0.5 * (x->V[4] * x->V[4]);
    spun[2] = -0.5 * (x->V[5] * x->V[5]);
    spun[3] = -x->V[3] * x->V[4];  spun[4] = -x->V[3] * x->V[5];  spun[5] = -x->V[4] * x->V[5];
    shaker2_coupling drive;
    for (int s = 0; s < SHAKER2_N; ++s) {
        shaker2_couple(&table->flywheel[s], sine[s], cosine[s], origin_acceleration, spun, &drive);
        tau[s] = V_dot[0] * drive.I_[0] + V_dot[1] * drive.I_[1] + V_dot[2] * drive.I_[2]
            + V_dot[3] * drive.I_[3] + V_dot[4] * drive.I_[4] + V_dot[5] * drive.I_[5]
            + table->flywheel[s].spin * phi_ddot[s] + drive.bias;
    }
}

/* Drive torques for a given motion: tau = f^T (Theta V_s* + Phi(V_s) Z_s - P_s). */
SHAKER2_CODE
shaker2_status shaker2_torque(const shaker2_table *table, const shaker2_state *x,
                              const shaker2_real V_dot[6], const shaker2_real phi_ddot[SHAKER2_N],
                              shaker2_real tau[SHAKER2_N])
{
    if (table == NULL || x == NULL || V_dot == NULL || phi_ddot == NULL
        || tau == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status = shaker2_check_motion(x, phi_ddot, SHAKER2_MAX_ACCELERATION);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(V_dot, 6, SHAKER2_MAX_ACCELERATION);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real C[9];  /* attitude */
    shaker2_rotation(x->attitude, C);
    shaker2_real g[3];  /* gravity in E1 */
    shaker2_rotate_back(C, table->gravity, g);
    shaker2_real sine[SHAKER2_N];
    shaker2_real cosine[SHAKER2_N];
    shaker2_sincos_each(x->phi, sine, cosine);
    shaker2_real origin_acceleration[3];  /* acceleration of O1 at V* = 0, minus gravity */
    origin_acceleration[0] = x->V[4] * x->V[2] - g[0] - x->V[5] * x->V[1];
    origin_acceleration[1] = x->V[5] * x->V[0] - g[1] - x->V[3] * x->V[2];
    origin_acceleration[2] = x->V[3] * x->V[1] - g[2] - x->V[4] * x->V[0];
    shaker2_real spun[6];  /* six numbers: J . spun = -omega . J omega / 2 for every inertia J */
    spun[0] = -0.5 * (x->V[3] * x->V[3]);
    spun[1] = -0.5 * (x->V[4] * x->V[4]);
    spun[2] = -0.5 * (x->V[5] * x->V[5]);
    spun[3] = -x->V[3] * x->V[4];  spun[4] = -x->V[3] * x->V[5];  spun[5] = -x->V[4] * x->V[5];
    shaker2_coupling drive;
    for (int s = 0; s < SHAKER2_N; ++s) {
        shaker2_couple(&table->flywheel[s], sine[s], cosine[s], origin_acceleration, spun, &drive);
        tau[s] = V_dot[0] * drive.I_[0] + V_dot[1] * drive.I_[1] + V_dot[2] * drive.I_[2]
            + V_dot[3] * drive.I_[3] + V_dot[4] * drive.I_[4] + V_dot[5] * drive.I_[5]
            + table->flywheel[s].spin * phi_ddot[s] + drive.bias;
    }
    return SHAKER2_OK;
}

/* Factors [A B^T; B D], symmetric positive definite, by blocks of 3x3. */
SHAKER2_CODE
static shaker2_status shaker2_factor_schur(const shaker2_schur *K, shaker2_schur_factor *restrict factor)
{
    shaker2_status status;
    const shaker2_real c11 = K->A[1] * K->A[2] - K->A[5] * K->A[5];
    const shaker2_real c22 = K->A[0] * K->A[2] - K->A[4] * K->A[4];
    const shaker2_real c33 = K->A[0] * K->A[1] - K->A[3] * K->A[3];
    const shaker2_real c12 = K->A[4] * K->A[5] - K->A[2] * K->A[3];
    const shaker2_real c13 = K->A[3] * K->A[5] - K->A[1] * K->A[4];
    const shaker2_real c23 = K->A[3] * K->A[4] - K->A[0] * K->A[5];
    const shaker2_real det = K->A[0] * c11 + K->A[3] * c12 + K->A[4] * c13;
    if (!(K->A[0] > 0.0 && c33 > 0.0 && (det >= 2.2250738585072014e-308
        && det <= SHAKER2_LARGEST))) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
    const shaker2_real r = 1.0 / det;
    factor->A_inv[0] = c11 * r;  factor->A_inv[1] = c22 * r;  factor->A_inv[2] = c33 * r;
    factor->A_inv[3] = c12 * r;  factor->A_inv[4] = c13 * r;  factor->A_inv[5] = c23 * r;
    shaker2_real S[6];  /* D - B A^-1 B^T */
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
    status = shaker2_factor3(S, &factor->L);
    if (status != SHAKER2_OK) { return status; }
    return SHAKER2_OK;
}

/* Solves [A B^T; B D] y = F by the factors. */
SHAKER2_CODE
static void shaker2_solve_schur(const shaker2_schur_factor *factor, const shaker2_real F[6],
                                shaker2_real *restrict y /* [6] */)
{
    shaker2_real moment[3];  /* n - B A^-1 f */
    shaker2_real omega_dot[3];
    moment[0] = F[3] - factor->U[0] * F[0] - factor->U[3] * F[1] - factor->U[6] * F[2];
    moment[1] = F[4] - factor->U[1] * F[0] - factor->U[4] * F[1] - factor->U[7] * F[2];
    moment[2] = F[5] - factor->U[2] * F[0] - factor->U[5] * F[1] - factor->U[8] * F[2];
    shaker2_solve3(&factor->L, moment, omega_dot);
    y[0] = factor->A_inv[0] * F[0] + factor->A_inv[3] * F[1] + factor->A_inv[4] * F[2]
        - factor->U[0] * omega_dot[0] - factor->U[1] * omega_dot[1] - factor->U[2] * omega_dot[2];
    y[1] = factor->A_inv[1] * F[1] + factor->A_inv[3] * F[0] + factor->A_inv[5] * F[2]
        - factor->U[3] * omega_dot[0] - factor->U[4] * omega_dot[1] - factor->U[5] * omega_dot[2];
    y[2] = factor->A_inv[2] * F[2] + factor->A_inv[4] * F[0] + factor->A_inv[5] * F[1]
        - factor->U[6] * omega_dot[0] - factor->U[7] * omega_dot[1] - factor->U[8] * omega_dot[2];
    y[3] = omega_dot[0];  y[4] = omega_dot[1];  y[5] = omega_dot[2];
}

/* V* and phi'' for given drive torques, from checked inputs; results are written where the status is OK. */
SHAKER2_CODE
static shaker2_status shaker2_solve_coupled(const shaker2_table *table, const shaker2_state *x,
                                            const shaker2_real sine[SHAKER2_N],
                                            const shaker2_real cosine[SHAKER2_N],
                                            const shaker2_real tau[SHAKER2_N], const int locked[SHAKER2_N],
                                            shaker2_real *restrict V_dot /* [6] */,
                                            shaker2_real *restrict phi_ddot /* [SHAKER2_N] */)
{
    shaker2_status status;
    shaker2_real C[9];  /* attitude */
    shaker2_rotation(x->attitude, C);
    shaker2_real g[3];  /* gravity in E1 */
    shaker2_rotate_back(C, table->gravity, g);
    shaker2_sums sum;
    shaker2_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    shaker2_sum_steady_spin(table, sine, cosine, x->phi_dot, &sum);
    shaker2_real F[6];  /* wrench (7); then the right-hand side of K V* + I phi'' = F */
    shaker2_external(table, x, &sum, C, g, F);
    shaker2_subtract_rates(table, &sum, x->V, F);
    shaker2_schur K;  /* mass matrix with free flywheels eliminated */
    K.A[0] = table->mass;  K.A[1] = table->mass;  K.A[2] = table->mass;
    K.A[3] = 0.0;          K.A[4] = 0.0;          K.A[5] = 0.0;
    K.B[0] = 0.0;         K.B[1] = -sum.mu[2];  K.B[2] = sum.mu[1];
    K.B[3] = sum.mu[2];   K.B[4] = 0.0;         K.B[5] = -sum.mu[0];
    K.B[6] = -sum.mu[1];  K.B[7] = sum.mu[0];   K.B[8] = 0.0;
    K.D[0] = sum.J[0];  K.D[1] = sum.J[1];  K.D[2] = sum.J[2];
    K.D[3] = sum.J[3];  K.D[4] = sum.J[4];  K.D[5] = sum.J[5];
    shaker2_coupling drive[SHAKER2_N];
    shaker2_real origin_acceleration[3];  /* acceleration of O1 at V* = 0, minus gravity */
    origin_acceleration[0] = x->V[4] * x->V[2] - g[0] - x->V[5] * x->V[1];
    origin_acceleration[1] = x->V[5] * x->V[0] - g[1] - x->V[3] * x->V[2];
    origin_acceleration[2] = x->V[3] * x->V[1] - g[2] - x->V[4] * x->V[0];
    shaker2_real spun[6];  /* six numbers: J . spun = -omega . J omega / 2 for every inertia J */
    spun[0] = -0.5 * (x->V[3] * x->V[3]);
    spun[1] = -0.5 * (x->V[4] * x->V[4]);
    spun[2] = -0.5 * (x->V[5] * x->V[5]);
    spun[3] = -x->V[3] * x->V[4];  spun[4] = -x->V[3] * x->V[5];  spun[5] = -x->V[4] * x->V[5];
    shaker2_real rate[SHAKER2_N];  /* accelerations at V* = 0 */
    for (int s = 0; s < SHAKER2_N; ++s) {
        if (locked[s] == 0) {
            shaker2_couple(&table->flywheel[s], sine[s], cosine[s], origin_acceleration, spun, &drive[s]);
            rate[s] = (tau[s] - drive[s].bias) * table->flywheel[s].spin_inv;
            shaker2_eliminate(drive[s].I_, table->flywheel[s].spin_inv, rate[s], &K, F);
        } else {
            drive[s].I_[0] = 0.0;  drive[s].I_[1] = 0.0;  drive[s].I_[2] = 0.0;
            drive[s].I_[3] = 0.0;  drive[s].I_[4] = 0.0;  drive[s].I_[5] = 0.0;
            rate[s] = 0.0;
        }
    }
    shaker2_schur_factor factor;
    status = shaker2_factor_schur(&K, &factor);
    if (status != SHAKER2_OK) { return status; }
    shaker2_solve_schur(&factor, F, V_dot);
    for (int s = 0; s < SHAKER2_N; ++s) {
        phi_ddot[s] = 0.0;
        if (locked[s] == 0) {
            phi_ddot[s] = rate[s] - (V_dot[0] * drive[s].I_[0] + V_dot[1] * drive[s].I_[1]
                + V_dot[2] * drive[s].I_[2] + V_dot[3] * drive[s].I_[3] + V_dot[4] * drive[s].I_[4]
                + V_dot[5] * drive[s].I_[5]) * table->flywheel[s].spin_inv;
        }
    }
    return SHAKER2_OK;
}

/* Motion of the whole system under given drive torques: V* and phi'' together, flywheels eliminated first. */
SHAKER2_CODE
shaker2_status shaker2_coupled(const shaker2_table *table, const shaker2_state *x,
                               const shaker2_real tau[SHAKER2_N], const int locked[SHAKER2_N],
                               shaker2_real V_dot[6], shaker2_real phi_ddot[SHAKER2_N])
{
    if (table == NULL || x == NULL || tau == NULL || V_dot == NULL
        || phi_ddot == NULL) { return SHAKER2_BAD_ARGUMENT; }
    if (locked == NULL) { locked = shaker2_none_locked; }
    shaker2_status status = shaker2_check_motion(x, tau, SHAKER2_MAX_WRENCH);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real V_result[6];
    shaker2_real phi_result[SHAKER2_N];
    shaker2_real sine[SHAKER2_N];
    shaker2_real cosine[SHAKER2_N];
    shaker2_sincos_each(x->phi, sine, cosine);
    status = shaker2_solve_coupled(table, x, sine, cosine, tau, locked, V_result, phi_result);
    if (status != SHAKER2_OK) { return status; }
    V_dot[0] = V_result[0];  V_dot[1] = V_result[1];  V_dot[2] = V_result[2];
    V_dot[3] = V_result[3];  V_dot[4] = V_result[4];  V_dot[5] = V_result[5];
    for (int s = 0; s < SHAKER2_N; ++s) {
        phi_ddot[s] = phi_result[s];
    }
    return SHAKER2_OK;
}

/* Sets to = x + h rate, after wrapping the phases to within half a turn. */
SHAKER2_CODE
static void shaker2_advance(const shaker2_state *x, const shaker2_state *rate, shaker2_real h,
                            shaker2_state *restrict to)
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
    for (int i = 0; i < SHAKER2_N; ++i) {
        to->phi[i] = shaker2_wrapped(x->phi[i]) + h * rate->phi[i];
    }
    for (int i = 0; i < SHAKER2_N; ++i) {
        to->phi_dot[i] = x->phi_dot[i] + h * rate->phi_dot[i];
    }
}

/* Normalizes the quaternion and wraps the phases to [-pi, pi]; RANGE if the state is out of range. */
SHAKER2_CODE
static shaker2_status shaker2_finish(shaker2_state *restrict x)
{
    shaker2_status status;
    const shaker2_real square = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
        + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
    if (!(square > 0.5 && square < 2.0)) { return SHAKER2_RANGE; }
    const shaker2_real inverse = 1.0 / shaker2_sqrt(square);
    x->attitude[0] = x->attitude[0] * inverse;
    x->attitude[1] = x->attitude[1] * inverse;
    x->attitude[2] = x->attitude[2] * inverse;
    x->attitude[3] = x->attitude[3] * inverse;
    status = shaker2_check_motion(x, x->phi_dot, SHAKER2_MAX_SPEED);
    if (status != SHAKER2_OK) { return status; }
    for (int s = 0; s < SHAKER2_N; ++s) {
        x->phi[s] = shaker2_wrapped(x->phi[s]);
    }
    return SHAKER2_OK;
}

/* Time derivatives of the state under drive torques. */
SHAKER2_CODE
static shaker2_status shaker2_rate(const shaker2_table *table, const shaker2_state *x,
                                   const shaker2_real tau[SHAKER2_N], const int locked[SHAKER2_N],
                                   shaker2_state *restrict rate)
{
    shaker2_status status;
    shaker2_real C[9];  /* attitude */
    shaker2_real sine[SHAKER2_N];
    shaker2_real cosine[SHAKER2_N];
    shaker2_sincos_each(x->phi, sine, cosine);
    status = shaker2_solve_coupled(table, x, sine, cosine, tau, locked, rate->V, rate->phi_dot);
    if (status != SHAKER2_OK) { return status; }
    shaker2_rotation(x->attitude, C);
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
    for (int s = 0; s < SHAKER2_N; ++s) {
        rate->phi[s] = x->phi_dot[s];
    }
    return SHAKER2_OK;
}

/* Evaluations of one step: the sum of the rates at its stages. A stage without an answer is RANGE. */
SHAKER2_CODE
static shaker2_status shaker2_stages(const shaker2_table *table, const shaker2_state *x,
                                     const shaker2_real tau[SHAKER2_N], const int locked[SHAKER2_N],
                                     shaker2_real h, int order, shaker2_state *restrict y,
                                     shaker2_state *restrict total)
{
    shaker2_status status;
    shaker2_state k;  /* time derivatives at a stage */
    status = shaker2_rate(table, x, tau, locked, &k);
    if (status != SHAKER2_OK) { return status; }
    const shaker2_real half = 0.5 * h;
    if (order == 2) {
        shaker2_advance(x, &k, half, y);
        status = shaker2_rate(table, y, tau, locked, total);
        if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
    } else {
        *total = k;
        shaker2_advance(x, &k, half, y);
        status = shaker2_rate(table, y, tau, locked, &k);
        if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
        for (int i = 0; i < 3; ++i) {
            total->position[i] += 2.0 * k.position[i];
        }
        for (int i = 0; i < 4; ++i) {
            total->attitude[i] += 2.0 * k.attitude[i];
        }
        for (int i = 0; i < 6; ++i) {
            total->V[i] += 2.0 * k.V[i];
        }
        for (int i = 0; i < SHAKER2_N; ++i) {
            total->phi[i] += 2.0 * k.phi[i];
        }
        for (int i = 0; i < SHAKER2_N; ++i) {
            total->phi_dot[i] += 2.0 * k.phi_dot[i];
        }
        shaker2_advance(x, &k, half, y);
        status = shaker2_rate(table, y, tau, locked, &k);
        if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
        for (int i = 0; i < 3; ++i) {
            total->position[i] += 2.0 * k.position[i];
        }
        for (int i = 0; i < 4; ++i) {
            total->attitude[i] += 2.0 * k.attitude[i];
        }
        for (int i = 0; i < 6; ++i) {
            total->V[i] += 2.0 * k.V[i];
        }
        for (int i = 0; i < SHAKER2_N; ++i) {
            total->phi[i] += 2.0 * k.phi[i];
        }
        for (int i = 0; i < SHAKER2_N; ++i) {
            total->phi_dot[i] += 2.0 * k.phi_dot[i];
        }
        shaker2_advance(x, &k, h, y);
        status = shaker2_rate(table, y, tau, locked, &k);
        if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
        for (int i = 0; i < 3; ++i) {
            total->position[i] += k.position[i];
        }
        for (int i = 0; i < 4; ++i) {
            total->attitude[i] += k.attitude[i];
        }
        for (int i = 0; i < 6; ++i) {
            total->V[i] += k.V[i];
        }
        for (int i = 0; i < SHAKER2_N; ++i) {
            total->phi[i] += k.phi[i];
        }
        for (int i = 0; i < SHAKER2_N; ++i) {
            total->phi_dot[i] += k.phi_dot[i];
        }
    }
    return SHAKER2_OK;
}

/* State after one time step; drive torques and wrenches are held constant. */
SHAKER2_CODE
shaker2_status shaker2_step(const shaker2_table *table, const shaker2_state *x,
                            const shaker2_real tau[SHAKER2_N], const int locked[SHAKER2_N], shaker2_real dt,
                            int order, shaker2_state *next)
{
    if (table == NULL || x == NULL || tau == NULL || next == NULL) { return SHAKER2_BAD_ARGUMENT; }
    if (locked == NULL) { locked = shaker2_none_locked; }
    shaker2_status status = shaker2_check_motion(x, tau, SHAKER2_MAX_WRENCH);
    if (status != SHAKER2_OK) { return status; }
    if (!(dt >= -SHAKER2_MAX_STEP && dt <= SHAKER2_MAX_STEP)) {
        if (dt >= -SHAKER2_LARGEST && dt <= SHAKER2_LARGEST) { return SHAKER2_RANGE; }
        return SHAKER2_NOT_FINITE;
    }
    if (!(dt > 0.0)) { return SHAKER2_BAD_ARGUMENT; }
    if (!(order == 4 || order == 2)) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_state y;  /* state of a stage; then the new state */
    shaker2_state total;  /* sum of the rates at the stages */
    status = shaker2_stages(table, x, tau, locked, dt, order, &y, &total);
    if (status != SHAKER2_OK) { return status; }
    const shaker2_real over = (order == 2) ? dt : dt / 6.0;  /* times the sum: the increment */
    /* square of the fastest turning, (rad/s)^2 */
    shaker2_real fastest = x->V[3] * x->V[3] + x->V[4] * x->V[4] + x->V[5] * x->V[5];
    for (int s = 0; s < SHAKER2_N; ++s) {
        const shaker2_real square = x->phi_dot[s] * x->phi_dot[s];
        fastest = (square > fastest) ? square : fastest;
    }
    shaker2_advance(x, &total, over, &y);
    status = shaker2_finish(&y);
    if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
    *next = y;
    const shaker2_real most = (order == 2) ? SHAKER2_MAX_TURN_2 : SHAKER2_MAX_TURN_4;  /* rad */
    if (dt * dt * fastest > most * most) { return SHAKER2_COARSE; }
    return SHAKER2_OK;
}

/* Time derivatives of the state under given flywheel accelerations. */
SHAKER2_CODE
static shaker2_status shaker2_rate_driven(const shaker2_table *table, const shaker2_state *x,
                                          const shaker2_real phi_ddot[SHAKER2_N],
                                          shaker2_state *restrict rate)
{
    shaker2_status status;
    shaker2_real C[9];  /* attitude */
    shaker2_real sine[SHAKER2_N];
    shaker2_real cosine[SHAKER2_N];
    shaker2_sincos_each(x->phi, sine, cosine);
    status = shaker2_accelerate(table, x, sine, cosine, phi_ddot, rate->V);
    if (status != SHAKER2_OK) { return status; }
    shaker2_rotation(x->attitude, C);
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
    for (int s = 0; s < SHAKER2_N; ++s) {
        rate->phi[s] = x->phi_dot[s];
        rate->phi_dot[s] = phi_ddot[s];
    }
    return SHAKER2_OK;
}

/* Evaluations of one step: the sum of the rates at its stages. A stage without an answer is RANGE. */
SHAKER2_CODE
static shaker2_status shaker2_stages_driven(const shaker2_table *table, const shaker2_state *x,
                                            const shaker2_real phi_ddot[SHAKER2_N], shaker2_real h,
                                            int order, shaker2_state *restrict y,
                                            shaker2_state *restrict total)
{
    shaker2_status status;
    shaker2_state k;  /* time derivatives at a stage */
    status = shaker2_rate_driven(table, x, phi_ddot, &k);
    if (status != SHAKER2_OK) { return status; }
    const shaker2_real half = 0.5 * h;
    if (order == 2) {
        shaker2_advance(x, &k, half, y);
        status = shaker2_rate_driven(table, y, phi_ddot, total);
        if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
    } else {
        *total = k;
        shaker2_advance(x, &k, half, y);
        status = shaker2_rate_driven(table, y, phi_ddot, &k);
        if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
        for (int i = 0; i < 3; ++i) {
            total->position[i] += 2.0 * k.position[i];
        }
        for (int i = 0; i < 4; ++i) {
            total->attitude[i] += 2.0 * k.attitude[i];
        }
        for (int i = 0; i < 6; ++i) {
            total->V[i] += 2.0 * k.V[i];
        }
        for (int i = 0; i < SHAKER2_N; ++i) {
            total->phi[i] += 2.0 * k.phi[i];
        }
        for (int i = 0; i < SHAKER2_N; ++i) {
            total->phi_dot[i] += 2.0 * k.phi_dot[i];
        }
        shaker2_advance(x, &k, half, y);
        status = shaker2_rate_driven(table, y, phi_ddot, &k);
        if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
        for (int i = 0; i < 3; ++i) {
            total->position[i] += 2.0 * k.position[i];
        }
        for (int i = 0; i < 4; ++i) {
            total->attitude[i] += 2.0 * k.attitude[i];
        }
        for (int i = 0; i < 6; ++i) {
            total->V[i] += 2.0 * k.V[i];
        }
        for (int i = 0; i < SHAKER2_N; ++i) {
            total->phi[i] += 2.0 * k.phi[i];
        }
        for (int i = 0; i < SHAKER2_N; ++i) {
            total->phi_dot[i] += 2.0 * k.phi_dot[i];
        }
        shaker2_advance(x, &k, h, y);
        status = shaker2_rate_driven(table, y, phi_ddot, &k);
        if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
        for (int i = 0; i < 3; ++i) {
            total->position[i] += k.position[i];
        }
        for (int i = 0; i < 4; ++i) {
            total->attitude[i] += k.attitude[i];
        }
        for (int i = 0; i < 6; ++i) {
            total->V[i] += k.V[i];
        }
        for (int i = 0; i < SHAKER2_N; ++i) {
            total->phi[i] += k.phi[i];
        }
        for (int i = 0; i < SHAKER2_N; ++i) {
            total->phi_dot[i] += k.phi_dot[i];
        }
    }
    return SHAKER2_OK;
}

/* State after one time step; given flywheel accelerations and wrenches are held constant. */
SHAKER2_CODE
shaker2_status shaker2_step_driven(const shaker2_table *table, const shaker2_state *x,
                                   const shaker2_real phi_ddot[SHAKER2_N], shaker2_real dt, int order,
                                   shaker2_state *next)
{
    if (table == NULL || x == NULL || phi_ddot == NULL || next == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status = shaker2_check_motion(x, phi_ddot, SHAKER2_MAX_ACCELERATION);
    if (status != SHAKER2_OK) { return status; }
    if (!(dt >= -SHAKER2_MAX_STEP && dt <= SHAKER2_MAX_STEP)) {
        if (dt >= -SHAKER2_LARGEST && dt <= SHAKER2_LARGEST) { return SHAKER2_RANGE; }
        return SHAKER2_NOT_FINITE;
    }
    if (!(dt > 0.0)) { return SHAKER2_BAD_ARGUMENT; }
    if (!(order == 4 || order == 2)) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_state y;  /* state of a stage; then the new state */
    shaker2_state total;  /* sum of the rates at the stages */
    status = shaker2_stages_driven(table, x, phi_ddot, dt, order, &y, &total);
    if (status != SHAKER2_OK) { return status; }
    const shaker2_real over = (order == 2) ? dt : dt / 6.0;  /* times the sum: the increment */
    /* square of the fastest turning, (rad/s)^2 */
    shaker2_real fastest = x->V[3] * x->V[3] + x->V[4] * x->V[4] + x->V[5] * x->V[5];
    for (int s = 0; s < SHAKER2_N; ++s) {
        const shaker2_real square = x->phi_dot[s] * x->phi_dot[s];
        fastest = (square > fastest) ? square : fastest;
    }
    shaker2_advance(x, &total, over, &y);
    status = shaker2_finish(&y);
    if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
    *next = y;
    const shaker2_real most = (order == 2) ? SHAKER2_MAX_TURN_2 : SHAKER2_MAX_TURN_4;  /* rad */
    if (dt * dt * fastest > most * most) { return SHAKER2_COARSE; }
    return SHAKER2_OK;
}

/* The angle wrapped to [-pi, pi] (pi rounded to the nearest real). */
SHAKER2_CODE
shaker2_status shaker2_wrap(shaker2_real phi, shaker2_real *wrapped)
{
    if (wrapped == NULL) { return SHAKER2_BAD_ARGUMENT; }
    if (!(phi >= -SHAKER2_MAX_PHASE && phi <= SHAKER2_MAX_PHASE)) {
        if (phi >= -SHAKER2_LARGEST && phi <= SHAKER2_LARGEST) { return SHAKER2_RANGE; }
        return SHAKER2_NOT_FINITE;
    }
    shaker2_real k;  /* nearest number of turns; may be off by one next to an odd multiple of pi */
    shaker2_real angle;
    k = phi * 0.15915494309189535 + 6755399441055744.0 - 6755399441055744.0;
    angle = shaker2_unwound(phi, k);
    if (angle > 3.141592653589793 || angle < -3.141592653589793) {
        angle = shaker2_unwound(phi, (angle > 3.141592653589793) ? k + 1.0 : k - 1.0);
    }
    *wrapped = (angle > 3.141592653589793) ? 3.141592653589793
        : ((angle < -3.141592653589793) ? -3.141592653589793 : angle);
    return SHAKER2_OK;
}

/* Phase for a count of an encoder. */
SHAKER2_CODE
shaker2_status shaker2_phase_of_counts(int count, int per_turn, shaker2_real zero, shaker2_real *phi)
{
    if (phi == NULL) { return SHAKER2_BAD_ARGUMENT; }
    if (per_turn < -1073741824 || per_turn > 1073741824 || per_turn == 0) { return SHAKER2_BAD_ARGUMENT; }
    const int turn = (per_turn < 0) ? -per_turn : per_turn;  /* counts */
    const shaker2_real size = (shaker2_real)turn;
    if (!(zero >= -size && zero <= size)) {
        if (zero >= -SHAKER2_LARGEST && zero <= SHAKER2_LARGEST) { return SHAKER2_RANGE; }
        return SHAKER2_NOT_FINITE;
    }
    const int rest = count - count / turn * turn;  /* whole turns removed */
    /* counts from phi = 0; then reduced to within half a turn */
    shaker2_real place = (shaker2_real)rest - zero;
    const shaker2_real half = size * 0.5;
    for (int i = 0; i < 2; ++i) {
        place = (place > half) ? place - size : ((place < -half) ? place + size : place);
    }
    *phi = place / (shaker2_real)per_turn * 6.283185307179586;
    return SHAKER2_OK;
}

/* Mean speed of a flywheel from the counts of one interval. */
SHAKER2_CODE
shaker2_status shaker2_speed_of_counts(int moved, int per_turn, shaker2_real dt, shaker2_real *phi_dot)
{
    if (phi_dot == NULL) { return SHAKER2_BAD_ARGUMENT; }
    if (per_turn < -1073741824 || per_turn > 1073741824 || per_turn == 0) { return SHAKER2_BAD_ARGUMENT; }
    if (!(dt >= -SHAKER2_MAX_STEP && dt <= SHAKER2_MAX_STEP)) {
        if (dt >= -SHAKER2_LARGEST && dt <= SHAKER2_LARGEST) { return SHAKER2_RANGE; }
        return SHAKER2_NOT_FINITE;
    }
    if (!(dt > 0.0)) { return SHAKER2_BAD_ARGUMENT; }
    const shaker2_real turns = (shaker2_real)moved / (shaker2_real)per_turn;
    const shaker2_real speed = turns * 6.283185307179586 / dt;
    if (!(speed >= -SHAKER2_MAX_SPEED && speed <= SHAKER2_MAX_SPEED)) { return SHAKER2_RANGE; }
    *phi_dot = speed;
    return SHAKER2_OK;
}

/* Takes one reading of an encoder's counter, which may wrap: place in the turn and counts moved, both
 * exact. */
SHAKER2_CODE
shaker2_status shaker2_accumulate(shaker2_encoder *encoder, int counter, int bits, int per_turn)
{
    if (encoder == NULL) { return SHAKER2_BAD_ARGUMENT; }
    if (per_turn < -1073741824 || per_turn > 1073741824 || per_turn == 0) { return SHAKER2_BAD_ARGUMENT; }
    const int turn = (per_turn < 0) ? -per_turn : per_turn;  /* counts */
    if (!(encoder->place >= 0 && encoder->place < turn)) { return SHAKER2_BAD_ARGUMENT; }
    int moved;  /* counts since the last reading, in the shorter direction */
    if (bits == 0) {
        if (!(counter >= 0 && counter < turn
            && (encoder->counter >= 0 && encoder->counter < turn))) { return SHAKER2_BAD_ARGUMENT; }
        moved = counter - encoder->counter;
        const int half = turn / 2;
        moved = (moved > half) ? moved - turn : ((moved < -half) ? moved + turn : moved);
    } else {
        if (!(bits >= 2 && bits <= 32)) { return SHAKER2_BAD_ARGUMENT; }
        const shaker2_word mask = (shaker2_word)0xffffffffu >> (shaker2_word)(32 - bits);
        /* counts forwards */
        const shaker2_word up = ((shaker2_word)counter - (shaker2_word)encoder->counter) & mask;
        const shaker2_word down = mask - up;  /* counts backwards, less one */
        moved = (up > down) ? -1 - (int)down : (int)up;
    }
    int place = encoder->place + (moved - moved / turn * turn);
    encoder->place = (place < 0) ? place + turn : ((place < turn) ? place : place - turn);
    encoder->counter = counter;
    encoder->moved = moved;
    return SHAKER2_OK;
}

/* Change of what suspend gives, with the change of V, (7). */
SHAKER2_CODE
static void shaker2_suspend_by_V(const shaker2_suspension *law, const shaker2_real d_V[6],
                                 shaker2_real *restrict d_F /* [6] */)
{
    for (int i = 0; i < 6; ++i) {
        d_F[i] -= d_V[0] * law->damping[i][0] + d_V[1] * law->damping[i][1] + d_V[2] * law->damping[i][2]
            + d_V[3] * law->damping[i][3] + d_V[4] * law->damping[i][4] + d_V[5] * law->damping[i][5];
    }
}

/* Change of what external gives, with the change of V, (7). */
SHAKER2_CODE
static void shaker2_external_by_V(const shaker2_table *table, const shaker2_real d_V[6],
                                  shaker2_real *restrict d_F /* [6] */)
{
    d_F[0] = 0.0;  d_F[1] = 0.0;  d_F[2] = 0.0;
    d_F[3] = 0.0;  d_F[4] = 0.0;  d_F[5] = 0.0;
    shaker2_suspend_by_V(&table->suspension, d_V, d_F);
}

/* Derivative of F - Phi Z - K* V by the twist, (8). */
SHAKER2_CODE
static void shaker2_twist_slope(const shaker2_table *table, const shaker2_real Z[6],
                                const shaker2_matrices_result *m, shaker2_real *restrict slope /* [36] */)
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
        shaker2_real change[6];  /* unit twist */
        shaker2_real F[6];  /* change of the wrench */
        for (int i = 0; i < 6; ++i) {
            change[i] = 0.0;
        }
        change[j] = 1.0;
        shaker2_external_by_V(table, change, F);
        for (int i = 0; i < 6; ++i) {
            slope[i * 6 + j] += F[i];
        }
    }
}

/* Change of F - Phi Z - K* V - (a, g) - K V* with the harmonic weights of one flywheel, (8). */
SHAKER2_CODE
static void shaker2_row_slope(const shaker2_row *row, const shaker2_real weight[12], const shaker2_real V[6],
                              const shaker2_real V_dot[6], const shaker2_real g[3],
                              shaker2_real *restrict out /* [6] */)
{
    shaker2_sums change;  /* change of the sums */
    shaker2_real Z[6];  /* change of the momentum screw */
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
SHAKER2_CODE
shaker2_status shaker2_forward_jacobian(const shaker2_table *table, const shaker2_state *x,
                                        const shaker2_real phi_ddot[SHAKER2_N],
                                        shaker2_forward_jacobian_result *out)
{
    if (table == NULL || x == NULL || phi_ddot == NULL || out == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status = shaker2_check_motion(x, phi_ddot, SHAKER2_MAX_ACCELERATION);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real C[9];  /* attitude */
    shaker2_rotation(x->attitude, C);
    shaker2_real g[3];  /* gravity in E1 */
    shaker2_rotate_back(C, table->gravity, g);
    shaker2_sums sum;
    shaker2_real sine[SHAKER2_N];
    shaker2_real cosine[SHAKER2_N];
    shaker2_sincos_each(x->phi, sine, cosine);
    shaker2_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    shaker2_sum_spin(table, sine, cosine, x->phi_dot, phi_ddot, &sum);
    shaker2_real F[6];  /* right-hand side of (8) */
    shaker2_real Z[6];  /* momentum screw (2) */
    shaker2_real V_result[6];  /* V_r* */
    shaker2_real rhs[6];
    shaker2_real y[6];
    shaker2_external(table, x, &sum, C, g, F);
    shaker2_momentum_screw(table, &sum, x->V, Z);
    shaker2_subtract_rates(table, &sum, x->V, F);
    shaker2_carrier_factor K;
    status = shaker2_factor_carrier(table, &sum, &K);
    if (status != SHAKER2_OK) { return status; }
    shaker2_solve_carrier(table, &K, F, V_result);
    shaker2_matrices_result m;
    m.K[0][0] = table->mass;  m.K[0][1] = 0.0;          m.K[0][2] = 0.0;
    m.K[0][3] = 0.0;          m.K[0][4] = sum.mu[2];    m.K[0][5] = -sum.mu[1];
    m.K[1][0] = 0.0;          m.K[1][1] = table->mass;  m.K[1][2] = 0.0;
    m.K[1][3] = -sum.mu[2];   m.K[1][4] = 0.0;          m.K[1][5] = sum.mu[0];
    m.K[2][0] = 0.0;          m.K[2][1] = 0.0;          m.K[2][2] = table->mass;
    m.K[2][3] = sum.mu[1];    m.K[2][4] = -sum.mu[0];   m.K[2][5] = 0.0;
    m.K[3][0] = 0.0;         m.K[3][1] = -sum.mu[2];  m.K[3][2] = sum.mu[1];
    m.K[3][3] = sum.J[0];    m.K[3][4] = sum.J[3];    m.K[3][5] = sum.J[4];
    m.K[4][0] = sum.mu[2];   m.K[4][1] = 0.0;         m.K[4][2] = -sum.mu[0];
    m.K[4][3] = sum.J[3];    m.K[4][4] = sum.J[1];    m.K[4][5] = sum.J[5];
    m.K[5][0] = -sum.mu[1];  m.K[5][1] = sum.mu[0];   m.K[5][2] = 0.0;
    m.K[5][3] = sum.J[4];    m.K[5][4] = sum.J[5];    m.K[5][5] = sum.J[2];
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
    shaker2_velocity_matrix(x->V, &m);
    shaker2_real slope[36];  /* derivative by V, row by row */
    shaker2_twist_slope(table, Z, &m, slope);
    for (int j = 0; j < 6; ++j) {
        for (int i = 0; i < 6; ++i) {
            rhs[i] = slope[i * 6 + j];
        }
        shaker2_solve_carrier(table, &K, rhs, y);
        for (int i = 0; i < 6; ++i) {
            out->V_dot_V[i][j] = y[i];
        }
    }
    shaker2_real change[12];  /* changes of the harmonic weights of a flywheel */
    for (int s = 0; s < SHAKER2_N; ++s) {
        const shaker2_real s_phi = sine[s];
        const shaker2_real c_phi = cosine[s];
        const shaker2_real c2 = 1.0 - 2.0 * (s_phi * s_phi);  /* cos 2 phi, then sin 2 phi */
        const shaker2_real s2 = 2.0 * c_phi * s_phi;
        const shaker2_real dc = -x->phi_dot[s] * s_phi;  /* time derivatives: d(cos phi)/dt, ... */
        const shaker2_real ds = x->phi_dot[s] * c_phi;
        const shaker2_real dc2 = -2.0 * x->phi_dot[s] * s2;
        const shaker2_real ds2 = 2.0 * x->phi_dot[s] * c2;
        const shaker2_real ddc = -x->phi_dot[s] * ds - phi_ddot[s] * s_phi;  /* second time derivatives */
        const shaker2_real dds = phi_ddot[s] * c_phi + x->phi_dot[s] * dc;
        {
            change[0] = -s_phi;      change[1] = c_phi;       change[2] = -2.0 * s2;
            change[3] = 2.0 * c2;    change[4] = -ds;         change[5] = dc;
            change[6] = -2.0 * ds2;  change[7] = 2.0 * dc2;   change[8] = -dds;
            change[9] = ddc;         change[10] = 0.0;        change[11] = 0.0;
            shaker2_row_slope(&table->flywheel[s], change, x->V, V_result, g, rhs);
            shaker2_solve_carrier(table, &K, rhs, y);
            for (int i = 0; i < 6; ++i) {
                out->V_dot_phi[i][s] = y[i];
            }
        }
        {
            change[0] = 0.0;        change[1] = 0.0;        change[2] = 0.0;
            change[3] = 0.0;        change[4] = -s_phi;     change[5] = c_phi;
            change[6] = -2.0 * s2;  change[7] = 2.0 * c2;   change[8] = -2.0 * ds;
            change[9] = 2.0 * dc;   change[10] = 1.0;       change[11] = 0.0;
            shaker2_row_slope(&table->flywheel[s], change, x->V, V_result, g, rhs);
            shaker2_solve_carrier(table, &K, rhs, y);
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
        shaker2_solve_carrier(table, &K, rhs, y);
        for (int i = 0; i < 6; ++i) {
            out->V_dot_phi_ddot[i][s] = y[i];
        }
    }
    return SHAKER2_OK;
}

/* Derivatives of coupled by V, phi, phi' and tau, at fixed position and attitude. */
SHAKER2_CODE
shaker2_status shaker2_coupled_jacobian(const shaker2_table *table, const shaker2_state *x,
                                        const shaker2_real tau[SHAKER2_N], const int locked[SHAKER2_N],
                                        shaker2_coupled_jacobian_result *out)
{
    if (table == NULL || x == NULL || tau == NULL || out == NULL) { return SHAKER2_BAD_ARGUMENT; }
    if (locked == NULL) { locked = shaker2_none_locked; }
    shaker2_status status = shaker2_check_motion(x, tau, SHAKER2_MAX_WRENCH);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real V_result[6];  /* V*, then V_r* */
    shaker2_real phi_result[SHAKER2_N];  /* phi'' */
    shaker2_real sine[SHAKER2_N];
    shaker2_real cosine[SHAKER2_N];
    shaker2_sincos_each(x->phi, sine, cosine);
    shaker2_real C[9];  /* attitude */
    shaker2_rotation(x->attitude, C);
    shaker2_real g[3];  /* gravity in E1 */
    shaker2_rotate_back(C, table->gravity, g);
    shaker2_sums sum;
    shaker2_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    shaker2_sum_steady_spin(table, sine, cosine, x->phi_dot, &sum);
    shaker2_real F[6];  /* wrench (7); then the right-hand side of K V* + I phi'' = F */
    shaker2_external(table, x, &sum, C, g, F);
    shaker2_subtract_rates(table, &sum, x->V, F);
    shaker2_schur K;  /* mass matrix with free flywheels eliminated */
    K.A[0] = table->mass;  K.A[1] = table->mass;  K.A[2] = table->mass;
    K.A[3] = 0.0;          K.A[4] = 0.0;          K.A[5] = 0.0;
    K.B[0] = 0.0;         K.B[1] = -sum.mu[2];  K.B[2] = sum.mu[1];
    K.B[3] = sum.mu[2];   K.B[4] = 0.0;         K.B[5] = -sum.mu[0];
    K.B[6] = -sum.mu[1];  K.B[7] = sum.mu[0];   K.B[8] = 0.0;
    K.D[0] = sum.J[0];  K.D[1] = sum.J[1];  K.D[2] = sum.J[2];
    K.D[3] = sum.J[3];  K.D[4] = sum.J[4];  K.D[5] = sum.J[5];
    shaker2_coupling drive[SHAKER2_N];
    shaker2_real origin_acceleration[3];  /* acceleration of O1 at V* = 0, minus gravity */
    origin_acceleration[0] = x->V[4] * x->V[2] - g[0] - x->V[5] * x->V[1];
    origin_acceleration[1] = x->V[5] * x->V[0] - g[1] - x->V[3] * x->V[2];
    origin_acceleration[2] = x->V[3] * x->V[1] - g[2] - x->V[4] * x->V[0];
    shaker2_real spun[6];  /* six numbers: J . spun = -omega . J omega / 2 for every inertia J */
    spun[0] = -0.5 * (x->V[3] * x->V[3]);
    spun[1] = -0.5 * (x->V[4] * x->V[4]);
    spun[2] = -0.5 * (x->V[5] * x->V[5]);
    spun[3] = -x->V[3] * x->V[4];  spun[4] = -x->V[3] * x->V[5];  spun[5] = -x->V[4] * x->V[5];
    shaker2_real rate[SHAKER2_N];  /* accelerations at V* = 0 */
    for (int s = 0; s < SHAKER2_N; ++s) {
        if (locked[s] == 0) {
            shaker2_couple(&table->flywheel[s], sine[s], cosine[s], origin_acceleration, spun, &drive[s]);
            rate[s] = (tau[s] - drive[s].bias) * table->flywheel[s].spin_inv;
            shaker2_eliminate(drive[s].I_, table->flywheel[s].spin_inv, rate[s], &K, F);
        } else {
            drive[s].I_[0] = 0.0;  drive[s].I_[1] = 0.0;  drive[s].I_[2] = 0.0;
            drive[s].I_[3] = 0.0;  drive[s].I_[4] = 0.0;  drive[s].I_[5] = 0.0;
            rate[s] = 0.0;
        }
    }
    shaker2_schur_factor factor;
    status = shaker2_factor_schur(&K, &factor);
    if (status != SHAKER2_OK) { return status; }
    shaker2_solve_schur(&factor, F, V_result);
    for (int s = 0; s < SHAKER2_N; ++s) {
        phi_result[s] = 0.0;
        if (locked[s] == 0) {
            phi_result[s] = rate[s] - (V_result[0] * drive[s].I_[0] + V_result[1] * drive[s].I_[1]
                + V_result[2] * drive[s].I_[2] + V_result[3] * drive[s].I_[3] + V_result[4] * drive[s].I_[4]
                + V_result[5] * drive[s].I_[5]) * table->flywheel[s].spin_inv;
        }
    }
    shaker2_real Z[6];  /* momentum screw (2) */
    shaker2_momentum_screw(table, &sum, x->V, Z);
    shaker2_matrices_result m;
    m.K[0][0] = table->mass;  m.K[0][1] = 0.0;          m.K[0][2] = 0.0;
    m.K[0][3] = 0.0;          m.K[0][4] = sum.mu[2];    m.K[0][5] = -sum.mu[1];
    m.K[1][0] = 0.0;          m.K[1][1] = table->mass;  m.K[1][2] = 0.0;
    m.K[1][3] = -sum.mu[2];   m.K[1][4] = 0.0;          m.K[1][5] = sum.mu[0];
    m.K[2][0] = 0.0;          m.K[2][1] = 0.0;          m.K[2][2] = table->mass;
    m.K[2][3] = sum.mu[1];    m.K[2][4] = -sum.mu[0];   m.K[2][5] = 0.0;
    m.K[3][0] = 0.0;         m.K[3][1] = -sum.mu[2];  m.K[3][2] = sum.mu[1];
    m.K[3][3] = sum.J[0];    m.K[3][4] = sum.J[3];    m.K[3][5] = sum.J[4];
    m.K[4][0] = sum.mu[2];   m.K[4][1] = 0.0;         m.K[4][2] = -sum.mu[0];
    m.K[4][3] = sum.J[3];    m.K[4][4] = sum.J[1];    m.K[4][5] = sum.J[5];
    m.K[5][0] = -sum.mu[1];  m.K[5][1] = sum.mu[0];   m.K[5][2] = 0.0;
    m.K[5][3] = sum.J[4];    m.K[5][4] = sum.J[5];    m.K[5][5] = sum.J[2];
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
    shaker2_velocity_matrix(x->V, &m);
    shaker2_real slope[36];  /* derivative by V, row by row */
    shaker2_twist_slope(table, Z, &m, slope);
    shaker2_real rhs[6];  /* right-hand side of the carrier */
    shaker2_real drive_rhs[SHAKER2_N];  /* right-hand sides of the drives */
    shaker2_real y[6];
    rhs[0] = 0.0;  rhs[1] = 0.0;  rhs[2] = 0.0;
    rhs[3] = 0.0;  rhs[4] = 0.0;  rhs[5] = 0.0;
    shaker2_real drive_slope[SHAKER2_N][6];  /* derivatives of the bias torques by V */
    shaker2_real J_p[6];  /* dJ / dphi */
    shaker2_real turned[3];  /* J' omega */
    for (int s = 0; s < SHAKER2_N; ++s) {
        const shaker2_real s_phi = sine[s];
        const shaker2_real c_phi = cosine[s];
        const shaker2_real two_c2 = 2.0 - 4.0 * (s_phi * s_phi);
        const shaker2_real two_s2 = 4.0 * c_phi * s_phi;
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
        turned[0] = J_p[0] * x->V[3] + J_p[3] * x->V[4] + J_p[4] * x->V[5];
        turned[1] = J_p[1] * x->V[4] + J_p[3] * x->V[3] + J_p[5] * x->V[5];
        turned[2] = J_p[2] * x->V[5] + J_p[4] * x->V[3] + J_p[5] * x->V[4];
        drive_slope[s][0] = drive[s].I_[1] * x->V[5] - drive[s].I_[2] * x->V[4];
        drive_slope[s][1] = drive[s].I_[2] * x->V[3] - drive[s].I_[0] * x->V[5];
        drive_slope[s][2] = drive[s].I_[0] * x->V[4] - drive[s].I_[1] * x->V[3];
        drive_slope[s][3] = drive[s].I_[2] * x->V[1] - drive[s].I_[1] * x->V[2] - turned[0];
        drive_slope[s][4] = drive[s].I_[0] * x->V[2] - drive[s].I_[2] * x->V[0] - turned[1];
        drive_slope[s][5] = drive[s].I_[1] * x->V[0] - drive[s].I_[0] * x->V[1] - turned[2];
    }
    for (int j = 0; j < 6; ++j) {
        for (int i = 0; i < 6; ++i) {
            rhs[i] = slope[i * 6 + j];
        }
        for (int s = 0; s < SHAKER2_N; ++s) {
            drive_rhs[s] = -drive_slope[s][j];
        }
        for (int t = 0; t < SHAKER2_N; ++t) {
            if (locked[t] == 0) {
                const shaker2_real share = drive_rhs[t] * table->flywheel[t].spin_inv;
                for (int i = 0; i < 6; ++i) {
                    rhs[i] -= drive[t].I_[i] * share;
                }
            }
        }
        shaker2_solve_schur(&factor, rhs, y);
        for (int i = 0; i < 6; ++i) {
            out->V_dot_V[i][j] = y[i];
        }
        for (int t = 0; t < SHAKER2_N; ++t) {
            out->phi_ddot_V[t][j] = 0.0;
            if (locked[t] == 0) {
                out->phi_ddot_V[t][j] = (drive_rhs[t]
                    - (y[0] * drive[t].I_[0] + y[1] * drive[t].I_[1] + y[2] * drive[t].I_[2]
                    + y[3] * drive[t].I_[3] + y[4] * drive[t].I_[4] + y[5] * drive[t].I_[5]))
                    * table->flywheel[t].spin_inv;
            }
        }
    }
    shaker2_real change[12];  /* changes of the harmonic weights of a flywheel */
    for (int s = 0; s < SHAKER2_N; ++s) {
        const shaker2_real s_phi = sine[s];
        const shaker2_real c_phi = cosine[s];
        const shaker2_real c2 = 1.0 - 2.0 * (s_phi * s_phi);  /* cos 2 phi, then sin 2 phi */
        const shaker2_real s2 = 2.0 * c_phi * s_phi;
        const shaker2_real dc = -x->phi_dot[s] * s_phi;  /* time derivatives: d(cos phi)/dt, ... */
        const shaker2_real ds = x->phi_dot[s] * c_phi;
        const shaker2_real dc2 = -2.0 * x->phi_dot[s] * s2;
        const shaker2_real ds2 = 2.0 * x->phi_dot[s] * c2;
        const shaker2_real ddc = -x->phi_dot[s] * ds - phi_result[s] * s_phi;  /* second time derivatives */
        const shaker2_real dds = phi_result[s] * c_phi + x->phi_dot[s] * dc;
        {
            change[0] = -s_phi;      change[1] = c_phi;       change[2] = -2.0 * s2;
            change[3] = 2.0 * c2;    change[4] = -ds;         change[5] = dc;
            change[6] = -2.0 * ds2;  change[7] = 2.0 * dc2;   change[8] = -dds;
            change[9] = ddc;         change[10] = 0.0;        change[11] = 0.0;
            shaker2_row_slope(&table->flywheel[s], change, x->V, V_result, g, rhs);
            shaker2_real mu_pp[3];  /* d2 mu / dphi2 */
            shaker2_real J_pp[6];  /* d2 J / dphi2 */
            shaker2_real I_p[6];  /* dI / dphi */
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
            const shaker2_real side = -(V_result[0] * I_p[0] + V_result[1] * I_p[1] + V_result[2] * I_p[2]
                + V_result[3] * I_p[3] + V_result[4] * I_p[4] + V_result[5] * I_p[5]
                + (mu_pp[0] * origin_acceleration[0] + mu_pp[1] * origin_acceleration[1]
                + mu_pp[2] * origin_acceleration[2]
                - 0.5 * (J_pp[0] * x->V[3] + J_pp[3] * x->V[4] + J_pp[4] * x->V[5]) * x->V[3]
                - 0.5 * (J_pp[1] * x->V[4] + J_pp[3] * x->V[3] + J_pp[5] * x->V[5]) * x->V[4]
                - 0.5 * (J_pp[2] * x->V[5] + J_pp[4] * x->V[3] + J_pp[5] * x->V[4]) * x->V[5]));
            if (locked[s] == 0) {
                const shaker2_real share = side * table->flywheel[s].spin_inv;
                for (int i = 0; i < 6; ++i) {
                    rhs[i] -= drive[s].I_[i] * share;
                }
            }
            shaker2_solve_schur(&factor, rhs, y);
            for (int i = 0; i < 6; ++i) {
                out->V_dot_phi[i][s] = y[i];
            }
            for (int t = 0; t < SHAKER2_N; ++t) {
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
            shaker2_row_slope(&table->flywheel[s], change, x->V, V_result, g, rhs);
            shaker2_solve_schur(&factor, rhs, y);
            for (int i = 0; i < 6; ++i) {
                out->V_dot_phi_dot[i][s] = y[i];
            }
            for (int t = 0; t < SHAKER2_N; ++t) {
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
        const shaker2_real side = 1.0;
        if (locked[s] == 0) {
            const shaker2_real share = side * table->flywheel[s].spin_inv;
            for (int i = 0; i < 6; ++i) {
                rhs[i] -= drive[s].I_[i] * share;
            }
        }
        shaker2_solve_schur(&factor, rhs, y);
        for (int i = 0; i < 6; ++i) {
            out->V_dot_tau[i][s] = y[i];
        }
        for (int t = 0; t < SHAKER2_N; ++t) {
            out->phi_ddot_tau[t][s] = 0.0;
            if (locked[t] == 0) {
                out->phi_ddot_tau[t][s] = (((t == s) ? side : 0.0)
                    - (y[0] * drive[t].I_[0] + y[1] * drive[t].I_[1] + y[2] * drive[t].I_[2]
                    + y[3] * drive[t].I_[3] + y[4] * drive[t].I_[4] + y[5] * drive[t].I_[5]))
                    * table->flywheel[t].spin_inv;
            }
        }
    }
    return SHAKER2_OK;
}

/* One-sided Jacobi rotations make the rows of W orthogonal: singular values without squaring the
 * condition. */
SHAKER2_CODE
static void shaker2_orthogonalise(shaker2_inverse_work *restrict work)
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
                shaker2_real a, b, g;
                a = 0.0;
                b = 0.0;
                g = 0.0;
                for (int j = 0; j < SHAKER2_N; ++j) {
                    a += work->W[p][j] * work->W[p][j];
                    b += work->W[q][j] * work->W[q][j];
                    g += work->W[p][j] * work->W[q][j];
                }
                /* tangent of the smaller angle that makes the rows orthogonal */
                const shaker2_real size = ((b - a < 0.0) ? -(b - a) : b - a) + 2.0 * ((g < 0.0) ? -g : g);
                /* scaled to size 1, so that no square underflows */
                const shaker2_real unit = (size > 0.0) ? size : 1.0;
                const shaker2_real d = (b - a) / unit;
                const shaker2_real h = 2.0 * g / unit;
                const shaker2_real root = shaker2_sqrt(d * d + h * h);
                const shaker2_real below = (d < 0.0) ? d - root : d + root;
                const shaker2_real t = (((below < 0.0) ? -below : below) > 0.0)
                    ? h / ((((below < 0.0) ? -below : below) > 0.0) ? below : 1.0) : 0.0;
                const shaker2_real c = 1.0 / shaker2_sqrt(1.0 + t * t);
                const shaker2_real s = c * t;
                for (int j = 0; j < SHAKER2_N; ++j) {
                    const shaker2_real x = work->W[p][j];
                    const shaker2_real y = work->W[q][j];
                    work->W[p][j] = c * x - s * y;
                    work->W[q][j] = s * x + c * y;
                }
                for (int j = 0; j < 6; ++j) {
                    const shaker2_real x = work->U[j][p];
                    const shaker2_real y = work->U[j][q];
                    work->U[j][p] = c * x - s * y;  work->U[j][q] = s * x + c * y;
                }
                const shaker2_real x = work->r[p];
                const shaker2_real y = work->r[q];
                work->r[p] = c * x - s * y;  work->r[q] = s * x + c * y;
            }
        }
    }
    for (int i = 0; i < 6; ++i) {
        shaker2_real total = 0.0;
        for (int j = 0; j < SHAKER2_N; ++j) {
            total += work->W[i][j] * work->W[i][j];
        }
        work->sigma[i] = shaker2_sqrt(total);
    }
}

/* Cholesky factor of the mass matrix, in place: K = G G^T. */
SHAKER2_CODE
static shaker2_status shaker2_factor(shaker2_inverse_work *restrict work)
{
    for (int j = 0; j < 6; ++j) {
        shaker2_real pivot = work->G[j][j];
        for (int k = 0; k < j; ++k) {
            pivot -= work->G[j][k] * work->G[j][k];
        }
        if (!(pivot > 0.0)) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
        const shaker2_real root = shaker2_sqrt(pivot);
        work->G[j][j] = root;
        for (int i = j + 1; i < 6; ++i) {
            shaker2_real rest = work->G[i][j];
            for (int k = 0; k < j; ++k) {
                rest -= work->G[i][k] * work->G[j][k];
            }
            work->G[i][j] = rest / root;
        }
    }
    return SHAKER2_OK;
}

/* Matrix and right-hand side of (12) at a state: I, b, and both scaled to W, r, (12). */
SHAKER2_CODE
static shaker2_status shaker2_demand(const shaker2_table *table, const shaker2_state *x,
                                     const shaker2_real sine[SHAKER2_N],
                                     const shaker2_real cosine[SHAKER2_N], const shaker2_real V_dot[6],
                                     shaker2_inverse_work *restrict work)
{
    shaker2_status status;
    shaker2_real C[9];  /* attitude */
    shaker2_rotation(x->attitude, C);
    shaker2_real g[3];  /* gravity in E1 */
    shaker2_rotate_back(C, table->gravity, g);
    shaker2_sums sum;
    shaker2_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    shaker2_sum_steady_spin(table, sine, cosine, x->phi_dot, &sum);
    shaker2_real F[6];  /* wrench (7); then the right-hand side of K V* + I phi'' = F */
    shaker2_external(table, x, &sum, C, g, F);
    shaker2_subtract_rates(table, &sum, x->V, F);
    work->G[0][0] = table->mass;  work->G[0][1] = 0.0;          work->G[0][2] = 0.0;
    work->G[0][3] = 0.0;          work->G[0][4] = sum.mu[2];    work->G[0][5] = -sum.mu[1];
    work->G[1][0] = 0.0;          work->G[1][1] = table->mass;  work->G[1][2] = 0.0;
    work->G[1][3] = -sum.mu[2];   work->G[1][4] = 0.0;          work->G[1][5] = sum.mu[0];
    work->G[2][0] = 0.0;          work->G[2][1] = 0.0;          work->G[2][2] = table->mass;
    work->G[2][3] = sum.mu[1];    work->G[2][4] = -sum.mu[0];   work->G[2][5] = 0.0;
    work->G[3][0] = 0.0;         work->G[3][1] = -sum.mu[2];  work->G[3][2] = sum.mu[1];
    work->G[3][3] = sum.J[0];    work->G[3][4] = sum.J[3];    work->G[3][5] = sum.J[4];
    work->G[4][0] = sum.mu[2];   work->G[4][1] = 0.0;         work->G[4][2] = -sum.mu[0];
    work->G[4][3] = sum.J[3];    work->G[4][4] = sum.J[1];    work->G[4][5] = sum.J[5];
    work->G[5][0] = -sum.mu[1];  work->G[5][1] = sum.mu[0];   work->G[5][2] = 0.0;
    work->G[5][3] = sum.J[4];    work->G[5][4] = sum.J[5];    work->G[5][5] = sum.J[2];
    /* b = F - K V*: the wrench demanded of the flywheels */
    for (int i = 0; i < 6; ++i) {
        const shaker2_real demanded = F[i] - work->G[i][0] * V_dot[0] - work->G[i][1] * V_dot[1]
            - work->G[i][2] * V_dot[2] - work->G[i][3] * V_dot[3] - work->G[i][4] * V_dot[4]
            - work->G[i][5] * V_dot[5];
        work->b[i] = demanded;
        work->r[i] = demanded;
    }
    status = shaker2_factor(work);
    if (status != SHAKER2_OK) { return status; }
    for (int s = 0; s < SHAKER2_N; ++s) {
        const shaker2_real s_phi = sine[s];
        const shaker2_real c_phi = cosine[s];
        const shaker2_real scale = table->flywheel[s].spin_root_inv;
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
        const shaker2_real inverse = 1.0 / work->G[i][i];
        shaker2_real rest;
        for (int s = 0; s < SHAKER2_N; ++s) {
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
    return SHAKER2_OK;
}

/* Solves gram z = z for a symmetric positive definite matrix by its Cholesky factor, in place. */
SHAKER2_CODE
static void shaker2_solve_gram(shaker2_real (*restrict gram)[6] /* [6][6] */,
                               shaker2_real *restrict z /* [6] */, shaker2_real least)
{
    for (int j = 0; j < 6; ++j) {
        for (int k = 0; k < j; ++k) {
            gram[j][j] -= gram[j][k] * gram[j][k];
        }
        const shaker2_real pivot = (gram[j][j] > least) ? gram[j][j] : least;
        gram[j][j] = shaker2_sqrt(pivot);
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
SHAKER2_CODE
static void shaker2_allocate(const shaker2_inverse_work *work, const shaker2_inverse_options *options,
                             int rank, shaker2_real *restrict phi_ddot /* [SHAKER2_N] */,
                             int *restrict limited /* [SHAKER2_N] */)
{
    shaker2_real share[SHAKER2_N];  /* 1/weight */
    shaker2_real give[SHAKER2_N];  /* 1/weight of a free flywheel, 0 for one held at its limit */
    shaker2_real step[SHAKER2_N];  /* increment of the free flywheels */
    shaker2_real row[6];  /* factor of each row; 0: the row is left out */
    shaker2_real gram[6][6];
    shaker2_real z[6];
    int going, weighted;
    int settled;  /* 1 after a whole step that gains nothing and frees nobody */
    shaker2_real square_before;  /* square of the residual after the last whole step */
    going = 1;
    weighted = 1;
    square_before = 1.7976931348623157e308;
    /* until the end phi_ddot holds y = D phi'' */
    for (int s = 0; s < SHAKER2_N; ++s) {
        phi_ddot[s] = 0.0;
        limited[s] = 0;
        share[s] = 1.0 / options->weight[s];
    }
    for (int pass = 0; pass < 16; ++pass) {
        if (going > 0) {
            shaker2_real most = 0.0;
            for (int s = 0; s < SHAKER2_N; ++s) {
                give[s] = (limited[s] > 0) ? 0.0 : share[s];
                most = (give[s] > most) ? give[s] : most;
            }
            const shaker2_real regular = 1.0e-12 * most;
            /* lower bound that keeps the diagonal positive */
            const shaker2_real least = (most > 0.0) ? regular : 1.0;
            for (int i = 0; i < 6; ++i) {
                row[i] = 0.0;
                if (i < rank) {
                    row[i] = 1.0 / ((pass < 1) ? work->sigma[i] : work->sigma[0]);
                }
            }
            for (int i = 0; i < 6; ++i) {
                shaker2_real left = work->r[i];
                for (int s = 0; s < SHAKER2_N; ++s) {
                    left -= work->W[i][s] * phi_ddot[s];
                }
                z[i] = row[i] * left;
            }
            shaker2_real weighed[SHAKER2_N];  /* a row of W Omega^-1 */
            for (int i = 0; i < 6; ++i) {
                for (int s = 0; s < SHAKER2_N; ++s) {
                    weighed[s] = work->W[i][s] * give[s];
                }
                for (int j = 0; j < i + 1; ++j) {
                    shaker2_real total = 0.0;
                    for (int s = 0; s < SHAKER2_N; ++s) {
                        total += weighed[s] * work->W[j][s];
                    }
                    gram[i][j] = row[i] * row[j] * total;
                }
                gram[i][i] += least;
            }
            shaker2_solve_gram(gram, z, least);
            for (int i = 0; i < 6; ++i) {
                z[i] = row[i] * z[i];
            }
            for (int s = 0; s < SHAKER2_N; ++s) {
                shaker2_real total = 0.0;
                for (int i = 0; i < 6; ++i) {
                    total += work->W[i][s] * z[i];
                }
                step[s] = give[s] * total;
            }
            settled = 0;
            if (pass < 1) {
                for (int s = 0; s < SHAKER2_N; ++s) {
                    phi_ddot[s] = step[s];
                    if (((step[s] < 0.0) ? -step[s] : step[s]) * work->scale[s] > options->limit[s]) {
                        const shaker2_real bound = options->limit[s] / work->scale[s];
                        phi_ddot[s] = (step[s] < 0.0) ? -bound : bound;
                        limited[s] = 1;
                    }
                }
            } else {
                /* go as far as all limits allow; hold the flywheel that reaches its limit */
                shaker2_real length = 1.0;
                int stopped = -1;
                for (int s = 0; s < SHAKER2_N; ++s) {
                    const shaker2_real moved = (phi_ddot[s] + step[s]) * work->scale[s];
                    if (limited[s] == 0 && ((moved < 0.0) ? -moved : moved) > options->limit[s]
                        && ((step[s] < 0.0) ? -step[s] : step[s]) > 0.0) {
                        const shaker2_real room = options->limit[s] / work->scale[s]
                            - ((moved < 0.0) ? -phi_ddot[s] : phi_ddot[s]);
                        const shaker2_real part = room / ((step[s] < 0.0) ? -step[s] : step[s]);
                        if (part < length) {
                            length = (part > 0.0) ? part : 0.0;
                            stopped = s;
                        }
                    }
                }
                for (int s = 0; s < SHAKER2_N; ++s) {
                    phi_ddot[s] += length * step[s];
                    if (stopped == s) {
                        const shaker2_real bound = options->limit[s] / work->scale[s];
                        phi_ddot[s] = (step[s] < 0.0) ? -bound : bound;
                        limited[s] = 1;
                    }
                }
                /* after a full step, release the held flywheel that would lower the residual most */
                if (stopped < 0) {
                    shaker2_real left[6];
                    shaker2_real wanted;
                    shaker2_real square;  /* of the residual */
                    wanted = 0.0;
                    square = 0.0;
                    for (int i = 0; i < 6; ++i) {
                        wanted += work->r[i] * work->r[i];
                        left[i] = (i < rank) ? work->r[i] : 0.0;
                        if (i < rank) {
                            for (int s = 0; s < SHAKER2_N; ++s) {
                                left[i] -= work->W[i][s] * phi_ddot[s];
                            }
                        }
                        square += left[i] * left[i];
                    }
                    shaker2_real best = 1.0e-18 * wanted;  /* smaller gains are ignored */
                    int freed = -1;
                    for (int s = 0; s < SHAKER2_N; ++s) {
                        if (limited[s] > 0) {
                            shaker2_real slope = 0.0;
                            shaker2_real size = 0.0;
                            for (int i = 0; i < 6; ++i) {
                                slope += work->W[i][s] * left[i];
                                size += work->W[i][s] * work->W[i][s];
                            }
                            const shaker2_real inward = (phi_ddot[s] > 0.0) ? -slope : slope;
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
            if (pass >= 4 && (settled > 0 || pass == 8)) {
                going = weighted;
                weighted = 0;
                for (int s = 0; s < SHAKER2_N; ++s) {
                    share[s] = 1.0;
                }
            }
        }
    }
    /* the product may round an answer that just reaches its limit beyond it; what overflows is refused
     * later */
    for (int s = 0; s < SHAKER2_N; ++s) {
        const shaker2_real found = phi_ddot[s] * work->scale[s];
        phi_ddot[s] = found;
        if (limited[s] > 0 || (((found < 0.0) ? -found : found) > options->limit[s]
            && ((found < 0.0) ? -found : found) <= SHAKER2_LARGEST)) {
            phi_ddot[s] = (found < 0.0) ? -options->limit[s] : options->limit[s];
        }
    }
}

/* Does a motor lack the torque tau, with its friction, at this speed? Its no-load speed is above 0. */
SHAKER2_CODE
static int shaker2_motor_lacks(const shaker2_inverse_options *options, int number, shaker2_real tau,
                               shaker2_real speed)
{
    /* of the motor itself, which bears the friction */
    shaker2_real own = tau + options->motor_viscous[number] * speed;
    if (options->motor_coulomb[number] > 0.0 && options->motor_coulomb_speed[number] > 0.0) {
        const shaker2_real ratio = speed / options->motor_coulomb_speed[number];
        const shaker2_real y = (ratio > 3.0) ? 3.0 : ((ratio < -3.0) ? -3.0 : ratio);  /* tanh y to 0.024 */
        const shaker2_real square = y * y;
        own += options->motor_coulomb[number] * (y * (27.0 + square) / (27.0 + 9.0 * square));
    }
    /* driving, the torque falls linearly to zero at the no-load speed; braking has all of it */
    shaker2_real share = 1.0;
    if (own * speed > 0.0) {
        share = 1.0 - ((speed < 0.0) ? -speed : speed) / options->motor_speed[number];
    }
    return (share <= 0.0 || ((own < 0.0) ? -own : own) > options->motor_torque[number] * share) ? 1 : 0;
}

/* Does a motion need more than a motor's torque or speed, or a larger phi'' than `most`? Of checked
 * inputs. */
SHAKER2_CODE
static void shaker2_excessive(const shaker2_table *table, const shaker2_state *x,
                              const shaker2_real sine[SHAKER2_N], const shaker2_real cosine[SHAKER2_N],
                              const shaker2_real V_dot[6], const shaker2_real phi_ddot[SHAKER2_N],
                              const shaker2_inverse_options *options, int *restrict flags)
{
    int motors;  /* flywheels whose motor has a limit */
    int found;
    motors = 0;
    found = 0;
    for (int s = 0; s < SHAKER2_N; ++s) {
        if (((phi_ddot[s] < 0.0) ? -phi_ddot[s] : phi_ddot[s]) > options->most[s]) {
            found = SHAKER2_EXCESSIVE;
        }
        if (options->motor_torque[s] < SHAKER2_LARGEST || options->motor_speed[s] < SHAKER2_LARGEST) {
            motors = motors + 1;
        }
    }
    if (motors > 0) {
        shaker2_real tau[SHAKER2_N];  /* drive torques */
        shaker2_balance(table, x, sine, cosine, V_dot, phi_ddot, tau);
        for (int s = 0; s < SHAKER2_N; ++s) {
            if (shaker2_motor_lacks(options, s, tau[s], x->phi_dot[s]) != 0) {
                found = SHAKER2_EXCESSIVE;
            }
        }
    }
    *flags = found;
}

/* (12) */
SHAKER2_CODE
shaker2_status shaker2_inverse(const shaker2_table *table, const shaker2_state *x,
                               const shaker2_real V_dot[6], const shaker2_inverse_options *options,
                               shaker2_inverse_result *out)
{
    if (table == NULL || x == NULL || V_dot == NULL || options == NULL
        || out == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status = shaker2_check_state(x);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(V_dot, 6, SHAKER2_MAX_ACCELERATION);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(options->weight, SHAKER2_N, SHAKER2_MAX_WEIGHT);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real shares[2];
    shares[0] = options->near_singular;
    shares[1] = options->damping;
    status = shaker2_within(shares, 2, SHAKER2_LARGEST);
    if (status != SHAKER2_OK) { return status; }
    if (!(shares[0] >= 0.0 && shares[0] <= 1.0)) { return SHAKER2_BAD_ARGUMENT; }
    if (!(shares[1] >= 0.0 && shares[1] <= 1.0)) { return SHAKER2_BAD_ARGUMENT; }
    for (int s = 0; s < SHAKER2_N; ++s) {
        if (!(options->weight[s] >= 1.0e-6)) { return SHAKER2_RANGE; }
    }
    for (int s = 0; s < SHAKER2_N; ++s) {
        if (!(options->limit[s] > 0.0 || options->limit[s] <= 0.0)) { return SHAKER2_NOT_FINITE; }
        if (options->limit[s] <= 0.0) { return SHAKER2_BAD_ARGUMENT; }
        if (!(options->most[s] > 0.0 || options->most[s] <= 0.0)) { return SHAKER2_NOT_FINITE; }
        if (!(options->motor_torque[s] > 0.0
            || options->motor_torque[s] <= 0.0)) { return SHAKER2_NOT_FINITE; }
        if (!(options->motor_speed[s] > 0.0 || options->motor_speed[s] <= 0.0)) { return SHAKER2_NOT_FINITE; }
        if (options->most[s] <= 0.0 || options->motor_torque[s] < 0.0
            || options->motor_speed[s] <= 0.0) { return SHAKER2_BAD_ARGUMENT; }
        if (!(options->motor_viscous[s] > 0.0
            || options->motor_viscous[s] <= 0.0)) { return SHAKER2_NOT_FINITE; }
        if (!(options->motor_coulomb[s] > 0.0
            || options->motor_coulomb[s] <= 0.0)) { return SHAKER2_NOT_FINITE; }
        if (!(options->motor_coulomb_speed[s] > 0.0
            || options->motor_coulomb_speed[s] <= 0.0)) { return SHAKER2_NOT_FINITE; }
        if (options->motor_viscous[s] < 0.0 || options->motor_coulomb[s] < 0.0
            || options->motor_coulomb_speed[s] <= 0.0) { return SHAKER2_BAD_ARGUMENT; }
    }
    shaker2_inverse_work work;
    shaker2_real answer[SHAKER2_N];  /* phi'' */
    int limited[SHAKER2_N];
    shaker2_real residual[6];
    shaker2_real sine[SHAKER2_N];
    shaker2_real cosine[SHAKER2_N];
    shaker2_sincos_each(x->phi, sine, cosine);
    status = shaker2_demand(table, x, sine, cosine, V_dot, &work);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real wanted = 0.0;
    for (int i = 0; i < 6; ++i) {
        wanted += work.r[i] * work.r[i];
    }
    shaker2_orthogonalise(&work);
    /* sort the singular values in descending order, by exchanging neighbours */
    for (int pass = 0; pass < 5; ++pass) {
        for (int i = 0; i < 5; ++i) {
            if (work.sigma[i] < work.sigma[i + 1]) {
                const shaker2_real kept_sigma = work.sigma[i];
                work.sigma[i] = work.sigma[i + 1];  work.sigma[i + 1] = kept_sigma;
                const shaker2_real kept_r = work.r[i];
                work.r[i] = work.r[i + 1];  work.r[i + 1] = kept_r;
                for (int j = 0; j < SHAKER2_N; ++j) {
                    const shaker2_real kept = work.W[i][j];
                    work.W[i][j] = work.W[i + 1][j];
                    work.W[i + 1][j] = kept;
                }
                for (int j = 0; j < 6; ++j) {
                    const shaker2_real kept = work.U[j][i];
                    work.U[j][i] = work.U[j][i + 1];  work.U[j][i + 1] = kept;
                }
            }
        }
    }
    int flags, rank;
    shaker2_real damping;
    flags = 0;
    rank = 0;
    damping = 0.0;
    for (int i = 0; i < 6; ++i) {
        if (work.sigma[i] > 1.0e-9 * work.sigma[0]) {
            rank = rank + 1;
            const shaker2_real ratio = work.sigma[i] / work.sigma[0];
            if (ratio < options->near_singular) {
                flags = flags | SHAKER2_NEAR_SINGULAR;
                if (options->damping > 0.0) {
                    flags = flags | SHAKER2_DAMPED;
                    const shaker2_real lambda = options->damping * work.sigma[0]
                        * (1.0 - ratio / options->near_singular);
                    const shaker2_real square = work.sigma[i] * work.sigma[i];
                    work.r[i] = work.r[i] * (square / (square + lambda * lambda));
                    damping = (lambda > damping) ? lambda : damping;
                }
            }
        }
    }
    shaker2_allocate(&work, options, rank, answer, limited);
    for (int s = 0; s < SHAKER2_N; ++s) {
        if (limited[s] > 0) {
            flags = flags | SHAKER2_LIMITED;
        }
    }
    if (rank < 2) {
        flags = flags | SHAKER2_RANK_DEFICIENT;
    }
    shaker2_real moved[6];  /* V* that results: V_dot + K^-1 residual */
    shaker2_real left;
    shaker2_real z[6];  /* G^-1 residual */
    left = 0.0;
    for (int i = 0; i < 6; ++i) {
        residual[i] = work.b[i];
        for (int s = 0; s < SHAKER2_N; ++s) {
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
        flags = flags | SHAKER2_UNREACHABLE;
    }
    for (int t = 0; t < 6; ++t) {
        const int i = 5 - t;
        for (int k = i + 1; k < 6; ++k) {
            z[i] -= work.G[k][i] * z[k];
        }
        z[i] = z[i] / work.G[i][i];
        moved[i] = V_dot[i] + z[i];
    }
    status = shaker2_within(answer, SHAKER2_N, SHAKER2_LARGEST);
    if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
    status = shaker2_within(residual, 6, SHAKER2_LARGEST);
    if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
    int lacking;
    shaker2_excessive(table, x, sine, cosine, moved, answer, options, &lacking);
    flags = flags | lacking;
    for (int s = 0; s < SHAKER2_N; ++s) {
        out->phi_ddot[s] = answer[s];
        out->limited[s] = limited[s];
    }
    for (int i = 0; i < 6; ++i) {
        out->residual[i] = residual[i];
    }
    /* unreachable: the demand's part in the rows left out; if no row is left out, the last row */
    shaker2_real part[6];
    for (int i = 0; i < 6; ++i) {
        part[i] = (i < rank) ? 0.0 : work.r[i];
    }
    shaker2_real largest = 0.0;
    for (int i = 0; i < 6; ++i) {
        const shaker2_real size = (part[i] < 0.0) ? -part[i] : part[i];
        largest = (size > largest) ? size : largest;
    }
    if (!(largest > 0.0)) {
        part[5] = 1.0;
        largest = 1.0;
    }
    shaker2_real square = 0.0;
    for (int i = 0; i < 6; ++i) {
        part[i] = part[i] / largest;
        square += part[i] * part[i];
    }
    const shaker2_real length = shaker2_sqrt(square);
    shaker2_real u[6];  /* U part: a unit vector in the norm of K^-1; its wrench is G u */
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
    for (int i = 0; i < 2; ++i) {
        out->sigma[i] = work.sigma[i];
    }
    return (shaker2_status)flags;
}

/* (12) */
SHAKER2_CODE
shaker2_status shaker2_inverse_fast(const shaker2_table *table, const shaker2_state *x,
                                    const shaker2_real V_dot[6], const shaker2_inverse_options *options,
                                    shaker2_real phi_ddot[SHAKER2_N])
{
    if (table == NULL || x == NULL || V_dot == NULL || options == NULL
        || phi_ddot == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status = shaker2_check_state(x);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(V_dot, 6, SHAKER2_MAX_ACCELERATION);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(options->weight, SHAKER2_N, SHAKER2_MAX_WEIGHT);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real shares[1];
    shares[0] = options->damping;
    status = shaker2_within(shares, 1, SHAKER2_LARGEST);
    if (status != SHAKER2_OK) { return status; }
    if (!(shares[0] >= 0.0 && shares[0] <= 1.0)) { return SHAKER2_BAD_ARGUMENT; }
    for (int s = 0; s < SHAKER2_N; ++s) {
        if (!(options->weight[s] >= 1.0e-6)) { return SHAKER2_RANGE; }
    }
    shaker2_inverse_work work;
    shaker2_real sine[SHAKER2_N];
    shaker2_real cosine[SHAKER2_N];
    shaker2_sincos_each(x->phi, sine, cosine);
    status = shaker2_demand(table, x, sine, cosine, V_dot, &work);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real answer[SHAKER2_N];
    /* normal equations: W^T W y = W^T r */
    shaker2_real gram[SHAKER2_N][SHAKER2_N];
    shaker2_real z[SHAKER2_N];
    shaker2_real trace = 0.0;
    for (int s = 0; s < SHAKER2_N; ++s) {
        for (int t = 0; t < s + 1; ++t) {
            shaker2_real total = 0.0;
            for (int i = 0; i < 6; ++i) {
                total += work.W[i][s] * work.W[i][t];
            }
            gram[s][t] = total;
        }
        trace += gram[s][s];
        shaker2_real side = 0.0;
        for (int i = 0; i < 6; ++i) {
            side += work.W[i][s] * work.r[i];
        }
        z[s] = side;
    }
    const shaker2_real lambda2 = options->damping * options->damping * trace;  /* square of the damping */
    for (int s = 0; s < SHAKER2_N; ++s) {
        gram[s][s] += lambda2;
    }
    for (int j = 0; j < 2; ++j) {
        shaker2_real pivot = gram[j][j];
        const shaker2_real least = 1.0e-13 * pivot;  /* a pivot below this is rounding error */
        shaker2_real rest = z[j];
        for (int k = 0; k < j; ++k) {
            pivot -= gram[j][k] * gram[k][j];
            rest -= gram[k][j] * z[k];
        }
        z[j] = rest;
        if (!(pivot > least)) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
        gram[j][j] = pivot;
        for (int i = j + 1; i < 2; ++i) {
            shaker2_real below = gram[i][j];
            for (int k = 0; k < j; ++k) {
                below -= gram[i][k] * gram[k][j];
            }
            gram[i][j] = below;
            gram[j][i] = below / pivot;
        }
    }
    for (int t = 0; t < 2; ++t) {
        const int i = 1 - t;
        shaker2_real rest = z[i] / gram[i][i];
        for (int k = i + 1; k < 2; ++k) {
            rest -= gram[i][k] * z[k];
        }
        z[i] = rest;
    }
    for (int s = 0; s < SHAKER2_N; ++s) {
        answer[s] = z[s] * work.scale[s];
    }
    status = shaker2_within(answer, SHAKER2_N, SHAKER2_LARGEST);
    if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
    int flags = 0;
    for (int s = 0; s < SHAKER2_N; ++s) {
        if (flags == 0 && options->motor_speed[s] > 0.0) {
            const shaker2_real v = x->phi_dot[s];
            const shaker2_real spin = table->flywheel[s].spin;
            const shaker2_real size = (answer[s] < 0.0) ? -answer[s] : answer[s];
            /* at most */
            const shaker2_real needed = spin * size + options->motor_viscous[s] * ((v < 0.0) ? -v : v)
                + options->motor_coulomb[s];
            /* at least: when driving */
            const shaker2_real has = options->motor_torque[s]
                * (1.0 - ((v < 0.0) ? -v : v) / options->motor_speed[s]);
            if (!(size <= options->most[s] && needed <= has)) {
                if (size > options->most[s] || shaker2_motor_lacks(options, s, spin * answer[s], v) != 0) {
                    flags = SHAKER2_EXCESSIVE;
                }
            }
        }
    }
    for (int s = 0; s < SHAKER2_N; ++s) {
        phi_ddot[s] = answer[s];
    }
    return (shaker2_status)flags;
}

/* Attitude quaternion of three angles. */
SHAKER2_CODE
shaker2_status shaker2_quaternion(const shaker2_real angles[3], shaker2_real attitude[4])
{
    if (angles == NULL || attitude == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status;
    if (!(angles[0] * angles[0] + angles[1] * angles[1]
        + angles[2] * angles[2] < SHAKER2_MAX_PHASE * SHAKER2_MAX_PHASE)) {
        status = shaker2_within(angles, 3, SHAKER2_MAX_PHASE);
        if (status != SHAKER2_OK) { return status; }
    }
    shaker2_real s_psi, c_psi;
    shaker2_sincos(0.5 * angles[0], &s_psi, &c_psi);
    shaker2_real s_theta, c_theta;
    shaker2_sincos(0.5 * angles[1], &s_theta, &c_theta);
    shaker2_real s_phi, c_phi;
    shaker2_sincos(0.5 * angles[2], &s_phi, &c_phi);
    attitude[0] = c_phi * c_psi * c_theta + s_phi * s_psi * s_theta;
    attitude[1] = c_psi * c_theta * s_phi - c_phi * s_psi * s_theta;
    attitude[2] = c_phi * c_psi * s_theta + c_theta * s_phi * s_psi;
    attitude[3] = c_phi * c_theta * s_psi - c_psi * s_phi * s_theta;
    return SHAKER2_OK;
}

/* (10) */
SHAKER2_CODE
shaker2_status shaker2_state_from_coordinates(const shaker2_real position[3], const shaker2_real angles[3],
                                              const shaker2_real q_dot[6], const shaker2_real q_ddot[6],
                                              shaker2_state *x, shaker2_real V_dot[6])
{
    if (position == NULL || angles == NULL || q_dot == NULL || q_ddot == NULL || x == NULL
        || V_dot == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status;
    if (!(position[0] * position[0] + position[1] * position[1]
        + position[2] * position[2] < SHAKER2_MAX_POSITION * SHAKER2_MAX_POSITION)) {
        status = shaker2_within(position, 3, SHAKER2_MAX_POSITION);
        if (status != SHAKER2_OK) { return status; }
    }
    status = shaker2_within(q_dot, 6, SHAKER2_MAX_SPEED);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(q_ddot, 6, SHAKER2_MAX_ACCELERATION);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real attitude[4];
    shaker2_real C[9];
    shaker2_real v[3];  /* C^T r' */
    shaker2_real a[3];  /* C^T r'' */
    shaker2_real omega[3];  /* B (psi', theta', phi') */
    status = shaker2_quaternion(angles, attitude);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real s_theta, c_theta;
    shaker2_sincos(angles[1], &s_theta, &c_theta);
    shaker2_real s_phi, c_phi;
    shaker2_sincos(angles[2], &s_phi, &c_phi);
    const shaker2_real singular = c_theta;
    if (((singular < 0.0) ? -singular : singular) < 1.0e-6) { return SHAKER2_SINGULAR_ATTITUDE; }
    shaker2_rotation(attitude, C);
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
    return SHAKER2_OK;
}

/* I0 = K A, J0 = K D + M A, (11). */
SHAKER2_CODE
static void shaker2_products(const shaker2_matrices_result *m, shaker2_generalized_result *restrict out)
{
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
            shaker2_real I0, J0;
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
SHAKER2_CODE
shaker2_status shaker2_generalized(const shaker2_table *table, const shaker2_state *x,
                                   const shaker2_real angles[3], const shaker2_real phi_ddot[SHAKER2_N],
                                   shaker2_generalized_result *out)
{
    if (table == NULL || x == NULL || angles == NULL || phi_ddot == NULL
        || out == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status;
    shaker2_state y;  /* the state with the attitude of the angles */
    shaker2_real V_dot[6];
    shaker2_matrices_result m;
    y = *x;
    status = shaker2_quaternion(angles, y.attitude);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real s_theta, c_theta;
    shaker2_sincos(angles[1], &s_theta, &c_theta);
    shaker2_real s_phi, c_phi;
    shaker2_sincos(angles[2], &s_phi, &c_phi);
    const shaker2_real singular = c_theta;  /* A has no inverse where this is 0 */
    status = shaker2_forward(table, &y, phi_ddot, V_dot);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_matrices(table, &y, &m);
    if (status != SHAKER2_OK) { return status; }
    if (((singular < 0.0) ? -singular : singular) < 1.0e-6) { return SHAKER2_SINGULAR_ATTITUDE; }
    shaker2_real C[9];
    shaker2_rotation(y.attitude, C);
    const shaker2_real singular_inv = 1.0 / singular;
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
    shaker2_real rest[6];  /* V* - D q' */
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
    shaker2_products(&m, out);
    return SHAKER2_OK;
}

/* Rotation matrix whose first axis is along `axis`, the second along the part of `zero` across it. */
SHAKER2_CODE
static shaker2_status shaker2_frame_of_axes(const shaker2_real axis[3], const shaker2_real zero[3],
                                            shaker2_real *restrict R /* [9] */)
{
    shaker2_status status;
    if (!(axis[0] * axis[0] + axis[1] * axis[1]
        + axis[2] * axis[2] < SHAKER2_MAX_PARAMETER * SHAKER2_MAX_PARAMETER)) {
        status = shaker2_within(axis, 3, SHAKER2_MAX_PARAMETER);
        if (status != SHAKER2_OK) { return status; }
    }
    if (!(zero[0] * zero[0] + zero[1] * zero[1]
        + zero[2] * zero[2] < SHAKER2_MAX_PARAMETER * SHAKER2_MAX_PARAMETER)) {
        status = shaker2_within(zero, 3, SHAKER2_MAX_PARAMETER);
        if (status != SHAKER2_OK) { return status; }
    }
    shaker2_real e1[3];
    shaker2_real e2[3];
    const shaker2_real axis2 = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
    if (!(axis2 > 1.0e-30)) { return SHAKER2_RANGE; }
    const shaker2_real axis2_root = 1.0 / shaker2_sqrt(axis2);
    e1[0] = axis[0] * axis2_root;  e1[1] = axis[1] * axis2_root;  e1[2] = axis[2] * axis2_root;
    const shaker2_real zero2 = zero[0] * zero[0] + zero[1] * zero[1] + zero[2] * zero[2];
    if (!(zero2 > 1.0e-30)) { return SHAKER2_RANGE; }
    /* of zero along the axis */
    const shaker2_real along = e1[0] * zero[0] + e1[1] * zero[1] + e1[2] * zero[2];
    shaker2_real across[3];
    across[0] = zero[0] - along * e1[0];
    across[1] = zero[1] - along * e1[1];
    across[2] = zero[2] - along * e1[2];
    const shaker2_real across2 = across[0] * across[0] + across[1] * across[1] + across[2] * across[2];
    if (!(across2 > 2.5e-19 * zero2)) { return SHAKER2_RANGE; }
    const shaker2_real across2_root = 1.0 / shaker2_sqrt(across2);
    e2[0] = across[0] * across2_root;  e2[1] = across[1] * across2_root;  e2[2] = across[2] * across2_root;
    R[0] = e1[0];  R[1] = e2[0];
    R[2] = e1[1] * e2[2] - e1[2] * e2[1];
    R[3] = e1[1];  R[4] = e2[1];
    R[5] = e1[2] * e2[0] - e1[0] * e2[2];
    R[6] = e1[2];  R[7] = e2[2];
    R[8] = e1[0] * e2[1] - e1[1] * e2[0];
    return SHAKER2_OK;
}

/* Carries one harmonic of a spatial inertia from a body's frame to E1 about O1, (2). */
SHAKER2_CODE
static void shaker2_carry(shaker2_real m, const shaker2_real b[3], const shaker2_real J[6],
                          const shaker2_real O[3], const shaker2_real R[9],
                          shaker2_real *restrict mu /* [3] */, shaker2_real *restrict J1 /* [6] */,
                          int spins, shaker2_real *restrict t /* [3] */)
{
    shaker2_real b1[3];  /* R b */
    shaker2_real RJ[9];  /* R J */
    shaker2_real Jr[6];  /* R J R^T */
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
SHAKER2_CODE
static shaker2_status shaker2_check_inertia(shaker2_real mass, const shaker2_real c[3],
                                            const shaker2_real J[6])
{
    shaker2_real size = 0.0;  /* largest element of J */
    for (int k = 0; k < 6; ++k) {
        size = (((J[k] < 0.0) ? -J[k] : J[k]) > size) ? ((J[k] < 0.0) ? -J[k] : J[k]) : size;
    }
    const shaker2_real b1 = mass * c[0];
    const shaker2_real b2 = mass * c[1];
    const shaker2_real b3 = mass * c[2];
    /* P = tr(J)/2 E - J - m c c^T + t |J| E */
    const shaker2_real P11 = 0.5 * (J[1] + J[2] - J[0]) - b1 * c[0] + 1.0e-9 * size;
    const shaker2_real P22 = 0.5 * (J[2] + J[0] - J[1]) - b2 * c[1] + 1.0e-9 * size;
    const shaker2_real P33 = 0.5 * (J[0] + J[1] - J[2]) - b3 * c[2] + 1.0e-9 * size;
    const shaker2_real P12 = -J[3] - b1 * c[1];
    const shaker2_real P13 = -J[4] - b1 * c[2];
    const shaker2_real P23 = -J[5] - b2 * c[2];
    /* a point mass at the origin has no inertia, nor has a body so small that its tolerance underflows */
    if (size + (((b1 * c[0] < 0.0) ? -(b1 * c[0]) : b1 * c[0])
        + ((b2 * c[1] < 0.0) ? -(b2 * c[1]) : b2 * c[1]) + ((b3 * c[2] < 0.0) ? -(b3 * c[2]) : b3 * c[2]))
        > 2.225073858507201e-299) {
        if (!(P11 > 0.0)) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
        const shaker2_real l21 = P12 / P11;
        const shaker2_real l31 = P13 / P11;
        const shaker2_real d2 = P22 - l21 * P12;
        if (!(d2 > 0.0)) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
        const shaker2_real p32 = P23 - l31 * P12;
        const shaker2_real d3 = P33 - l31 * P13 - p32 / d2 * p32;
        if (!(d3 > 0.0)) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
    }
    return SHAKER2_OK;
}

/* Are the mass properties finite and physically possible? */
SHAKER2_CODE
static shaker2_status shaker2_check_body(const shaker2_body *body)
{
    shaker2_status status;
    shaker2_real masses[1];
    masses[0] = body->mass;
    status = shaker2_within(masses, 1, SHAKER2_MAX_PARAMETER);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(body->center_of_mass, 3, SHAKER2_MAX_PARAMETER);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(body->inertia, 6, SHAKER2_MAX_PARAMETER);
    if (status != SHAKER2_OK) { return status; }
    if (body->mass < 0.0) { return SHAKER2_RANGE; }
    return shaker2_check_inertia(body->mass, body->center_of_mass, body->inertia);
}

/* Origin and axes (at phi = 0) of a flywheel in E1. */
SHAKER2_CODE
static shaker2_status shaker2_place_flywheel(const shaker2_flywheel *w, shaker2_real *restrict O /* [3] */,
                                             shaker2_real *restrict R /* [9] */)
{
    shaker2_status status;
    if (!(w->position[0] * w->position[0] + w->position[1] * w->position[1]
        + w->position[2] * w->position[2] < SHAKER2_MAX_PARAMETER * SHAKER2_MAX_PARAMETER)) {
        status = shaker2_within(w->position, 3, SHAKER2_MAX_PARAMETER);
        if (status != SHAKER2_OK) { return status; }
    }
    status = shaker2_frame_of_axes(w->axis, w->zero, R);
    if (status != SHAKER2_OK) { return status; }
    O[0] = w->position[0];  O[1] = w->position[1];  O[2] = w->position[2];
    return SHAKER2_OK;
}

/* Are the parameters finite and in range, the axes nonzero, and the bodies physically possible? */
SHAKER2_CODE
static shaker2_status shaker2_check_parameters(const shaker2_parameters *parameters)
{
    shaker2_status status;
    shaker2_real mass;
    /* largest moment of inertia that products in the equations can reach; it must not overflow */
    shaker2_real size;
    shaker2_real O[3];
    shaker2_real R[9];
    status = shaker2_check_body(&parameters->carrier);
    if (status != SHAKER2_OK) { return status; }
    mass = parameters->carrier.mass;
    size = parameters->carrier.inertia[0] + parameters->carrier.inertia[1] + parameters->carrier.inertia[2];
    for (int s = 0; s < SHAKER2_N; ++s) {
        status = shaker2_check_body(&parameters->flywheel[s].body);
        if (status != SHAKER2_OK) { return status; }
        if (!(parameters->flywheel[s].body.inertia[0] >= 1.0e-30)) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
        status = shaker2_place_flywheel(&parameters->flywheel[s], O, R);
        if (status != SHAKER2_OK) { return status; }
        mass += parameters->flywheel[s].body.mass;
        size += parameters->flywheel[s].body.inertia[0] + parameters->flywheel[s].body.inertia[1]
            + parameters->flywheel[s].body.inertia[2]
            + parameters->flywheel[s].body.mass * (O[0] * O[0] + O[1] * O[1] + O[2] * O[2]);
    }
    if (!(mass >= 1.0e-30)) { return SHAKER2_NOT_POSITIVE_DEFINITE; }
    if (!(size <= 1.0e60)) { return SHAKER2_RANGE; }
    return SHAKER2_OK;
}

/* (2) */
SHAKER2_CODE
shaker2_status shaker2_prepare(const shaker2_parameters *parameters, shaker2_table *table)
{
    if (parameters == NULL || table == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status = shaker2_check_parameters(parameters);
    if (status != SHAKER2_OK) { return status; }
    /* all checks passed: from here on the table is written and nothing can fail */
    shaker2_real mass;
    shaker2_real first_moment[3];
    shaker2_real inertia[6];
    mass = 0.0;
    first_moment[0] = 0.0;  first_moment[1] = 0.0;  first_moment[2] = 0.0;
    inertia[0] = 0.0;  inertia[1] = 0.0;  inertia[2] = 0.0;
    inertia[3] = 0.0;  inertia[4] = 0.0;  inertia[5] = 0.0;
    /* carrier: its frame is E1 */
    shaker2_real O[3];  /* origin of a body in E1 */
    shaker2_real R[9];  /* axes of a body in E1 */
    shaker2_real b[3];  /* first moment in the body's frame */
    shaker2_real mu[3];
    shaker2_real J1[6];
    shaker2_real t[3];
    O[0] = 0.0;  O[1] = 0.0;  O[2] = 0.0;
    R[0] = 1.0;  R[1] = 0.0;  R[2] = 0.0;
    R[3] = 0.0;  R[4] = 1.0;  R[5] = 0.0;
    R[6] = 0.0;  R[7] = 0.0;  R[8] = 1.0;
    b[0] = parameters->carrier.mass * parameters->carrier.center_of_mass[0];
    b[1] = parameters->carrier.mass * parameters->carrier.center_of_mass[1];
    b[2] = parameters->carrier.mass * parameters->carrier.center_of_mass[2];
    shaker2_carry(parameters->carrier.mass, b, parameters->carrier.inertia, O, R, mu, J1, 0, t);
    mass += parameters->carrier.mass;
    first_moment[0] += mu[0];  first_moment[1] += mu[1];  first_moment[2] += mu[2];
    inertia[0] += J1[0];  inertia[1] += J1[1];  inertia[2] += J1[2];
    inertia[3] += J1[3];  inertia[4] += J1[4];  inertia[5] += J1[5];
    /* flywheels: constant part to the totals, harmonics to the row */
    for (int s = 0; s < SHAKER2_N; ++s) {
        (void)shaker2_place_flywheel(&parameters->flywheel[s], O, R);
        b[0] = parameters->flywheel[s].body.mass * parameters->flywheel[s].body.center_of_mass[0];
        b[1] = parameters->flywheel[s].body.mass * parameters->flywheel[s].body.center_of_mass[1];
        b[2] = parameters->flywheel[s].body.mass * parameters->flywheel[s].body.center_of_mass[2];
        shaker2_real bh[3];  /* first moment of one harmonic, in mounting axes */
        shaker2_real Jh[6];  /* its inertia */
        /* harmonic 0 of Theta(phi) */
        bh[0] = b[0];  bh[1] = 0.0;   bh[2] = 0.0;
        Jh[0] = parameters->flywheel[s].body.inertia[0];
        Jh[1] = 0.5 * (parameters->flywheel[s].body.inertia[1] + parameters->flywheel[s].body.inertia[2]);
        Jh[2] = 0.5 * (parameters->flywheel[s].body.inertia[1] + parameters->flywheel[s].body.inertia[2]);
        Jh[3] = 0.0;  Jh[4] = 0.0;  Jh[5] = 0.0;
        shaker2_carry(parameters->flywheel[s].body.mass, bh, Jh, O, R, mu, J1, 1, table->flywheel[s].t_0);
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
        shaker2_carry(0.0, bh, Jh, O, R, table->flywheel[s].mu_c, table->flywheel[s].J_c, 1,
            table->flywheel[s].t_c);
        /* harmonic s of Theta(phi) */
        bh[0] = 0.0;    bh[1] = -b[2];  bh[2] = b[1];
        Jh[0] = 0.0;  Jh[1] = 0.0;  Jh[2] = 0.0;
        Jh[3] = -parameters->flywheel[s].body.inertia[4];
        Jh[4] = parameters->flywheel[s].body.inertia[3];
        Jh[5] = 0.0;
        shaker2_carry(0.0, bh, Jh, O, R, table->flywheel[s].mu_s, table->flywheel[s].J_s, 1,
            table->flywheel[s].t_s);
        /* harmonic 2c of Theta(phi) */
        bh[0] = 0.0;  bh[1] = 0.0;  bh[2] = 0.0;
        Jh[0] = 0.0;
        Jh[1] = 0.5 * (parameters->flywheel[s].body.inertia[1] - parameters->flywheel[s].body.inertia[2]);
        Jh[2] = 0.5 * (parameters->flywheel[s].body.inertia[2] - parameters->flywheel[s].body.inertia[1]);
        Jh[3] = 0.0;  Jh[4] = 0.0;
        Jh[5] = parameters->flywheel[s].body.inertia[5];
        shaker2_carry(0.0, bh, Jh, O, R, mu, table->flywheel[s].J_2c, 0, t);
        /* harmonic 2s of Theta(phi) */
        bh[0] = 0.0;  bh[1] = 0.0;  bh[2] = 0.0;
        Jh[0] = 0.0;
        Jh[1] = -parameters->flywheel[s].body.inertia[5];
        Jh[2] = parameters->flywheel[s].body.inertia[5];
        Jh[3] = 0.0;  Jh[4] = 0.0;
        Jh[5] = 0.5 * (parameters->flywheel[s].body.inertia[1] - parameters->flywheel[s].body.inertia[2]);
        shaker2_carry(0.0, bh, Jh, O, R, mu, table->flywheel[s].J_2s, 0, t);
        table->flywheel[s].spin = parameters->flywheel[s].body.inertia[0];
        table->flywheel[s].spin_inv = 1.0 / parameters->flywheel[s].body.inertia[0];
        table->flywheel[s].spin_root_inv = 1.0 / shaker2_sqrt(parameters->flywheel[s].body.inertia[0]);
    }
    table->mass = mass;
    table->mass_inverse = 1.0 / mass;
    table->first_moment[0] = first_moment[0];
    table->first_moment[1] = first_moment[1];
    table->first_moment[2] = first_moment[2];
    table->inertia[0] = inertia[0];  table->inertia[1] = inertia[1];  table->inertia[2] = inertia[2];
    table->inertia[3] = inertia[3];  table->inertia[4] = inertia[4];  table->inertia[5] = inertia[5];
    return SHAKER2_OK;
}

/* L^T V: a twist carried to Os, in mounting axes. */
SHAKER2_CODE
static void shaker2_carry_twist(const shaker2_mount *mount, const shaker2_real V[6],
                                shaker2_real *restrict U /* [6] */)
{
    shaker2_real velocity[3];  /* velocity of Os */
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
SHAKER2_CODE
static void shaker2_mount_wrench(const shaker2_mount *mount, shaker2_real s, shaker2_real c,
                                 shaker2_real phi_dot, shaker2_real phi_ddot, const shaker2_real V[6],
                                 const shaker2_real V_dot[6], const shaker2_real g[3],
                                 shaker2_real *restrict W /* [6] */)
{
    shaker2_real U[6];  /* twist of the mount at Os */
    shaker2_real turned[6];  /* in Es */
    shaker2_real turned_dot[6];
    shaker2_real V_s[6];  /* twist of the flywheel, in Es */
    shaker2_real V_s_dot[6];
    shaker2_real Z_s[6];  /* its momentum screw */
    shaker2_carry_twist(mount, V, U);
    turned[0] = U[0];                 turned[1] = U[1] * c + U[2] * s;  turned[2] = U[2] * c - U[1] * s;
    turned[3] = U[3];                 turned[4] = U[4] * c + U[5] * s;  turned[5] = U[5] * c - U[4] * s;
    shaker2_carry_twist(mount, V_dot, U);
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
    shaker2_real g_mounting[3];  /* gravity in mounting axes */
    shaker2_real g_s[3];  /* gravity in Es */
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
    shaker2_real own[6];  /* in Es */
    own[0] = W[0];  own[1] = W[1];  own[2] = W[2];
    own[3] = W[3];  own[4] = W[4];  own[5] = W[5];
    W[0] = own[0];                   W[1] = own[1] * c - own[2] * s;  W[2] = own[1] * s + own[2] * c;
    W[3] = own[3];                   W[4] = own[4] * c - own[5] * s;  W[5] = own[4] * s + own[5] * c;
}

/* Wrench of the mount on each flywheel: the bearing loads. Their opposites shake the structure. */
SHAKER2_CODE
shaker2_status shaker2_mounts(const shaker2_table *table, const shaker2_mount_table *mounting,
                              const shaker2_state *x, const shaker2_real V_dot[6],
                              const shaker2_real phi_ddot[SHAKER2_N], shaker2_real mount_wrench[12])
{
    if (table == NULL || mounting == NULL || x == NULL || V_dot == NULL || phi_ddot == NULL
        || mount_wrench == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status = shaker2_check_motion(x, phi_ddot, SHAKER2_MAX_ACCELERATION);
    if (status != SHAKER2_OK) { return status; }
    status = shaker2_within(V_dot, 6, SHAKER2_MAX_ACCELERATION);
    if (status != SHAKER2_OK) { return status; }
    shaker2_real C[9];  /* attitude */
    shaker2_rotation(x->attitude, C);
    shaker2_real g[3];  /* gravity in E1 */
    shaker2_rotate_back(C, table->gravity, g);
    shaker2_real sine[SHAKER2_N];
    shaker2_real cosine[SHAKER2_N];
    shaker2_sincos_each(x->phi, sine, cosine);
    shaker2_real W[6];
    for (int s = 0; s < SHAKER2_N; ++s) {
        W[0] = 0.0;  W[1] = 0.0;  W[2] = 0.0;
        W[3] = 0.0;  W[4] = 0.0;  W[5] = 0.0;
        shaker2_mount_wrench(&mounting->flywheel[s], sine[s], cosine[s], x->phi_dot[s], phi_ddot[s], x->V,
            V_dot, g, W);
        for (int j = 0; j < 6; ++j) {
            mount_wrench[s * 6 + j] = W[j];
        }
    }
    return SHAKER2_OK;
}

/* Makes the second table, which the function mounts needs. */
SHAKER2_CODE
shaker2_status shaker2_prepare_mounts(const shaker2_parameters *parameters, shaker2_mount_table *mounting)
{
    if (parameters == NULL || mounting == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status = shaker2_check_parameters(parameters);
    if (status != SHAKER2_OK) { return status; }
    for (int s = 0; s < SHAKER2_N; ++s) {
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
        (void)shaker2_place_flywheel(&parameters->flywheel[s], mounting->flywheel[s].origin,
            mounting->flywheel[s].axes);
    }
    return SHAKER2_OK;
}

/* Sets to = x + h rate with phases in [-pi, pi], and keeps in the carry what rounding takes from the sums. */
SHAKER2_CODE
static void shaker2_advance_carried(const shaker2_state *x, const shaker2_state *rate, shaker2_real h,
                                    shaker2_step_carry *restrict carry, shaker2_state *restrict to)
{
    for (int i = 0; i < 3; ++i) {
        const shaker2_real step = h * rate->position[i] + carry->rounding[i];
        const shaker2_real sum = x->position[i] + step;
        const shaker2_real sum_b = sum - x->position[i];
        carry->rounding[i] = x->position[i] - (sum - sum_b) + (step - sum_b);
        to->position[i] = sum;
    }
    for (int i = 0; i < 4; ++i) {
        const shaker2_real step = h * rate->attitude[i] + carry->rounding[i + 3];
        const shaker2_real sum = x->attitude[i] + step;
        const shaker2_real sum_b = sum - x->attitude[i];
        carry->rounding[i + 3] = x->attitude[i] - (sum - sum_b) + (step - sum_b);
        to->attitude[i] = sum;
    }
    for (int i = 0; i < 6; ++i) {
        const shaker2_real step = h * rate->V[i] + carry->rounding[i + 7];
        const shaker2_real sum = x->V[i] + step;
        const shaker2_real sum_b = sum - x->V[i];
        carry->rounding[i + 7] = x->V[i] - (sum - sum_b) + (step - sum_b);
        to->V[i] = sum;
    }
    for (int i = 0; i < SHAKER2_N; ++i) {
        const shaker2_real start = shaker2_wrapped(x->phi[i]);
        const shaker2_real step = h * rate->phi[i] + carry->rounding[i + 13];
        const shaker2_real sum = start + step;
        const shaker2_real sum_b = sum - start;
        /* turns */
        const shaker2_real k = sum * 0.15915494309189535 + 6755399441055744.0 - 6755399441055744.0;
        const shaker2_real left = sum - k * 6.283185303211212;
        const shaker2_real within = left + -(k * 3.968374318722146e-9);
        const shaker2_real within_b = within - left;
        carry->rounding[i + 13] = start - (sum - sum_b) + (step - sum_b)
            + (left - (within - within_b) + (-(k * 3.968374318722146e-9) - within_b)
            - k * 1.5782216666252822e-23);
        to->phi[i] = within;
    }
    for (int i = 0; i < SHAKER2_N; ++i) {
        const shaker2_real step = h * rate->phi_dot[i] + carry->rounding[i + 15];
        const shaker2_real sum = x->phi_dot[i] + step;
        const shaker2_real sum_b = sum - x->phi_dot[i];
        carry->rounding[i + 15] = x->phi_dot[i] - (sum - sum_b) + (step - sum_b);
        to->phi_dot[i] = sum;
    }
}

/* Normalizes the quaternion, rounding kept in the carry; RANGE if the state is out of range. */
SHAKER2_CODE
static shaker2_status shaker2_finish_carried(shaker2_state *restrict x, shaker2_step_carry *restrict carry)
{
    shaker2_status status;
    const shaker2_real square = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
        + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
    if (!(square > 0.5 && square < 2.0)) { return SHAKER2_RANGE; }
    /* 1/|q| - 1, without the digits that the difference would lose */
    const shaker2_real excess = (1.0 - square) / (shaker2_sqrt(square) + square);
    for (int i = 0; i < 4; ++i) {
        const shaker2_real step = x->attitude[i] * excess + carry->rounding[i + 3];
        const shaker2_real sum = x->attitude[i] + step;
        const shaker2_real sum_b = sum - x->attitude[i];
        carry->rounding[i + 3] = x->attitude[i] - (sum - sum_b) + (step - sum_b);
        x->attitude[i] = sum;
    }
    status = shaker2_check_motion(x, x->phi_dot, SHAKER2_MAX_SPEED);
    if (status != SHAKER2_OK) { return status; }
    return SHAKER2_OK;
}

/* State after one time step under drive torques and wrenches, held constant; sums are compensated by a
 * carry. */
SHAKER2_CODE
shaker2_status shaker2_step_carried(const shaker2_table *table, const shaker2_state *x,
                                    const shaker2_real tau[SHAKER2_N], const int locked[SHAKER2_N],
                                    shaker2_real dt, int order, shaker2_step_carry *carry,
                                    shaker2_state *next)
{
    if (table == NULL || x == NULL || tau == NULL || carry == NULL
        || next == NULL) { return SHAKER2_BAD_ARGUMENT; }
    if (locked == NULL) { locked = shaker2_none_locked; }
    shaker2_status status = shaker2_check_motion(x, tau, SHAKER2_MAX_WRENCH);
    if (status != SHAKER2_OK) { return status; }
    if (!(dt >= -SHAKER2_MAX_STEP && dt <= SHAKER2_MAX_STEP)) {
        if (dt >= -SHAKER2_LARGEST && dt <= SHAKER2_LARGEST) { return SHAKER2_RANGE; }
        return SHAKER2_NOT_FINITE;
    }
    if (!(dt > 0.0)) { return SHAKER2_BAD_ARGUMENT; }
    if (!(order == 4 || order == 2)) { return SHAKER2_BAD_ARGUMENT; }
    status = shaker2_within(carry->rounding, 17, SHAKER2_MAX_ROUNDING);
    if (status != SHAKER2_OK) { return status; }
    shaker2_state y;  /* state of a stage; then the new state */
    shaker2_state total;  /* sum of the rates at the stages */
    status = shaker2_stages(table, x, tau, locked, dt, order, &y, &total);
    if (status != SHAKER2_OK) { return status; }
    const shaker2_real over = (order == 2) ? dt : dt / 6.0;  /* times the sum: the increment */
    /* square of the fastest turning, (rad/s)^2 */
    shaker2_real fastest = x->V[3] * x->V[3] + x->V[4] * x->V[4] + x->V[5] * x->V[5];
    for (int s = 0; s < SHAKER2_N; ++s) {
        const shaker2_real square = x->phi_dot[s] * x->phi_dot[s];
        fastest = (square > fastest) ? square : fastest;
    }
    shaker2_step_carry kept;  /* the new carry */
    kept = *carry;
    shaker2_advance_carried(x, &total, over, &kept, &y);
    status = shaker2_finish_carried(&y, &kept);
    if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
    *carry = kept;
    *next = y;
    const shaker2_real most = (order == 2) ? SHAKER2_MAX_TURN_2 : SHAKER2_MAX_TURN_4;  /* rad */
    if (dt * dt * fastest > most * most) { return SHAKER2_COARSE; }
    return SHAKER2_OK;
}

/* State after one time step under given flywheel accelerations and wrenches, held constant; sums are
 * compensated by a carry. */
SHAKER2_CODE
shaker2_status shaker2_step_driven_carried(const shaker2_table *table, const shaker2_state *x,
                                           const shaker2_real phi_ddot[SHAKER2_N], shaker2_real dt,
                                           int order, shaker2_step_carry *carry, shaker2_state *next)
{
    if (table == NULL || x == NULL || phi_ddot == NULL || carry == NULL
        || next == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_status status = shaker2_check_motion(x, phi_ddot, SHAKER2_MAX_ACCELERATION);
    if (status != SHAKER2_OK) { return status; }
    if (!(dt >= -SHAKER2_MAX_STEP && dt <= SHAKER2_MAX_STEP)) {
        if (dt >= -SHAKER2_LARGEST && dt <= SHAKER2_LARGEST) { return SHAKER2_RANGE; }
        return SHAKER2_NOT_FINITE;
    }
    if (!(dt > 0.0)) { return SHAKER2_BAD_ARGUMENT; }
    if (!(order == 4 || order == 2)) { return SHAKER2_BAD_ARGUMENT; }
    status = shaker2_within(carry->rounding, 17, SHAKER2_MAX_ROUNDING);
    if (status != SHAKER2_OK) { return status; }
    shaker2_state y;  /* state of a stage; then the new state */
    shaker2_state total;  /* sum of the rates at the stages */
    status = shaker2_stages_driven(table, x, phi_ddot, dt, order, &y, &total);
    if (status != SHAKER2_OK) { return status; }
    const shaker2_real over = (order == 2) ? dt : dt / 6.0;  /* times the sum: the increment */
    /* square of the fastest turning, (rad/s)^2 */
    shaker2_real fastest = x->V[3] * x->V[3] + x->V[4] * x->V[4] + x->V[5] * x->V[5];
    for (int s = 0; s < SHAKER2_N; ++s) {
        const shaker2_real square = x->phi_dot[s] * x->phi_dot[s];
        fastest = (square > fastest) ? square : fastest;
    }
    shaker2_step_carry kept;  /* the new carry */
    kept = *carry;
    shaker2_advance_carried(x, &total, over, &kept, &y);
    status = shaker2_finish_carried(&y, &kept);
    if (status != SHAKER2_OK) { return SHAKER2_RANGE; }
    *carry = kept;
    *next = y;
    const shaker2_real most = (order == 2) ? SHAKER2_MAX_TURN_2 : SHAKER2_MAX_TURN_4;  /* rad */
    if (dt * dt * fastest > most * most) { return SHAKER2_COARSE; }
    return SHAKER2_OK;
}

/* ---- tables ---- */

SHAKER2_CONST
const shaker2_parameters shaker2_default_parameters =
{
    .carrier = {
        .mass = 6.0,
        .center_of_mass = { 0.0, 0.0, 0.0 },
        .inertia = { 0.05, 0.06, 0.07, 0.0, 0.0, 0.0 },
    },
    .flywheel = {
        {  /* left */
            .body = {
                .mass = 0.5,
                .center_of_mass = { 0.0, 0.004, 0.0 },
                .inertia = { 0.000908, 0.0006, 0.0006079999999999999, 0.0, 0.0, 0.0 },
            },
            .position = { 0.0, 0.08, 0.0 },
            .axis = { 1.0, 0.0, -0.0 },
            .zero = { 0.0, 1.0, 0.0 },
        },
        {  /* right */
            .body = {
                .mass = 0.5,
                .center_of_mass = { 0.0, 0.004, 0.0 },
                .inertia = { 0.000908, 0.0006, 0.0006079999999999999, 0.0, 0.0, 0.0 },
            },
            .position = { 0.0, -0.08, 0.0 },
            .axis = { 1.0, 0.0, -0.0 },
            .zero = { 0.0, 1.0, 0.0 },
        },
    },
};

SHAKER2_CONST
const shaker2_table shaker2_default =
{
    .mass = 7.0,
    .mass_inverse = 0.14285714285714285,
    .first_moment = { 0.0, 0.0, 0.0 },
    .inertia = { 0.058216000000000004, 0.061208, 0.07760800000000001, 0.0, 0.0, 0.0 },
    .flywheel = {
        {  /* left */
            .mu_c = { 0.0, 0.002, 0.0 },
            .mu_s = { 0.0, 0.0, 0.002 },
            .J_c = { 0.00032, 0.0, 0.00032, 0.0, 0.0, 0.0 },
            .J_s = { 0.0, 0.0, 0.0, 0.0, 0.0, -0.00016 },
            .J_2c = { 0.0, -3.999999999999989e-6, 3.999999999999989e-6, 0.0, 0.0, 0.0 },
            .J_2s = { 0.0, 0.0, 0.0, 0.0, 0.0, -3.999999999999989e-6 },
            .t_0 = { 0.000908, 0.0, 0.0 },
            .t_c = { 0.00016, 0.0, 0.0 },
            .t_s = { 0.0, 0.0, 0.0 },
            .spin = 0.000908,
            .spin_inv = 1101.3215859030838,
            .spin_root_inv = 33.1861655799986,
        },
        {  /* right */
            .mu_c = { 0.0, 0.002, 0.0 },
            .mu_s = { 0.0, 0.0, 0.002 },
            .J_c = { -0.00032, 0.0, -0.00032, 0.0, 0.0, 0.0 },
            .J_s = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.00016 },
            .J_2c = { 0.0, -3.999999999999989e-6, 3.999999999999989e-6, 0.0, 0.0, 0.0 },
            .J_2s = { 0.0, 0.0, 0.0, 0.0, 0.0, -3.999999999999989e-6 },
            .t_0 = { 0.000908, 0.0, 0.0 },
            .t_c = { -0.00016, 0.0, 0.0 },
            .t_s = { 0.0, 0.0, 0.0 },
            .spin = 0.000908,
            .spin_inv = 1101.3215859030838,
            .spin_root_inv = 33.1861655799986,
        },
    },
    .gravity = { 0.0, 0.0, -9.81 },
    .suspension = {
        .stiffness = {
            { 1105.398,      0.0,      0.0,      0.0,      0.0,      0.0 },
            {      0.0, 1105.398,      0.0,      0.0,      0.0,      0.0 },
            {      0.0,      0.0, 1105.398,      0.0,      0.0,      0.0 },
            {      0.0,      0.0,      0.0,     30.0,      0.0,      0.0 },
            {      0.0,      0.0,      0.0,      0.0,     30.0,      0.0 },
            {      0.0,      0.0,      0.0,      0.0,      0.0,     30.0 },
        },
        .damping = {
            { 10.0,  0.0,  0.0,  0.0,  0.0,  0.0 },
            {  0.0, 10.0,  0.0,  0.0,  0.0,  0.0 },
            {  0.0,  0.0, 10.0,  0.0,  0.0,  0.0 },
            {  0.0,  0.0,  0.0,  0.3,  0.0,  0.0 },
            {  0.0,  0.0,  0.0,  0.0,  0.3,  0.0 },
            {  0.0,  0.0,  0.0,  0.0,  0.0,  0.3 },
        },
        .position = { 0.0, 0.0, 0.062122421 },
        .attitude = { 1.0, 0.0, 0.0, 0.0 },
    },
};

SHAKER2_CONST
const shaker2_inverse_options shaker2_default_options =
{
    .weight = { 1.0, 1.0 },
    .limit = { 1.7976931348623157e308, 1.7976931348623157e308 },
    .most = { 1.0e4, 1.0e4 },
    .motor_torque = { 1.7976931348623157e308, 1.7976931348623157e308 },
    .motor_speed = { 1.7976931348623157e308, 1.7976931348623157e308 },
    .motor_viscous = { 0.0, 0.0 },
    .motor_coulomb = { 0.0, 0.0 },
    .motor_coulomb_speed = { 1.0, 1.0 },
    .near_singular = 1.0e-6,
    .damping = 0.0,
};
