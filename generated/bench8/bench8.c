/* bench8.c: motion of the stand "bench8". What each function does and takes: bench8.h.
 * mahovik 0.1.0; structure 309d41a6, physics 139422e0. Generated: change the stand file instead. */
#include "bench8.h"

#include <stddef.h>
#include <stdint.h>

#if BENCH8_STRUCTURE != 0x309d41a6u || BENCH8_PHYSICS != 0x139422e0u
#error "bench8.h and bench8.c are of different stands"
#endif
#if BENCH8_REAL_BYTES != 8
#error "bench8.h and bench8.c were generated for different element types"
#endif
#if BENCH8_VERSION_MAJOR != 0 || BENCH8_VERSION_MINOR != 1 || BENCH8_VERSION_PATCH != 0
#error "bench8.h and bench8.c are of different versions of mahovik"
#endif

#include <float.h>
#include <limits.h>

/* Other numbers than those of IEEE 754, and fast math, give wrong results with status OK. Refused here is
 * what the compiler shows of them; clang does not show -funsafe-math-optimizations. */
#if FLT_RADIX != 2 || DBL_MANT_DIG != 53
#error "wrong results: bench8 needs a double of 64 bits, 53 of them significant"
#endif
#if INT_MAX < 2147483647
#error "wrong counts: bench8 needs an int of 32 bits"
#endif
#ifndef BENCH8_ALLOW_FAST_MATH
#if defined __FAST_MATH__ || defined __ASSOCIATIVE_MATH__ || defined __RECIPROCAL_MATH__ || defined _M_FP_FAST
#error "wrong results: compile bench8 without -ffast-math, -Ofast and -funsafe-math-optimizations"
#elif FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1 && FLT_EVAL_METHOD != 16
#error "wrong results: x87 keeps more digits: compile bench8 with -msse2 -mfpmath=sse"
#endif
#if defined __FINITE_MATH_ONLY__ && __FINITE_MATH_ONLY__ == 1
#error "inputs that are NaN would pass: compile bench8 without -ffinite-math-only"
#endif
#endif

/* Attributes for sections, such as fast memory: define them to place code and tables. */
#ifndef BENCH8_CODE
#define BENCH8_CODE
#endif
#ifndef BENCH8_CONST
#define BENCH8_CONST
#endif

/* Seldom called: one copy takes less code than one in each caller. */
#ifdef __GNUC__
#define BENCH8_APART __attribute__((noinline))
#else
#define BENCH8_APART
#endif

/* On desktop processors copies in the callers are faster; elsewhere they take too much code. */
#if defined __GNUC__ && !defined __OPTIMIZE_SIZE__ && (defined __x86_64__ || defined __aarch64__)
#define BENCH8_COPIED inline __attribute__((always_inline))
#else
#define BENCH8_COPIED
#endif

/* Sums over all bodies at one state. */
typedef struct bench8_sums {
    bench8_real mu[3];      /* kg m; first moment of all bodies about O1 */
    bench8_real mu_dot[3];  /* kg m/s; its rate in E1 */
    bench8_real J[6];       /* kg m2; inertia about O1 */
    bench8_real J_dot[6];   /* kg m2/s; its rate in E1 */
    bench8_real h_rel[3];   /* kg m2/s; moment part of sum I phi_dot */
    bench8_real g_rel[3];   /* N m; d/dt of the moment part */
    bench8_real a_rel[3];   /* N; d/dt of the force part */
} bench8_sums;

/* A symmetric 3x3 matrix factored, L D L^T. */
typedef struct bench8_factors3 {
    bench8_real r1;   /* 1 / D, of the last D itself */
    bench8_real r2, d3;
    bench8_real l21;  /* L below its diagonal */
    bench8_real l31, l32;
} bench8_factors3;

/* One flywheel's drive torque by the motion: I . V_dot + Theta_ff phi_ddot + bias. */
typedef struct bench8_coupling {
    bench8_real I_[6];  /* kg m, kg m2; column of I (9) */
    bench8_real bias;   /* N m; drive torque at V_dot = 0, phi_ddot = 0 */
} bench8_coupling;

/* K with free flywheels eliminated: K - sum I I^T / Theta_ff. */
typedef struct bench8_schur {
    bench8_real A[6];  /* kg; force by v_dot: 11 22 33 12 13 23 */
    bench8_real B[9];  /* kg m; moment by v_dot, row by row */
    bench8_real D[6];  /* kg m2; moment by omega_dot: 11 22 33 12 13 23 */
} bench8_schur;

/* K with free flywheels eliminated, factored. */
typedef struct bench8_schur_factor {
    bench8_real A_inv[6];  /* 1/kg */
    bench8_real U[9];      /* m; A^-1 B^T */
    bench8_factors3 L;     /* D - B A^-1 B^T */
} bench8_schur_factor;

/* Scratch of inverse. */
typedef struct bench8_inverse_work {
    bench8_real I_[6][BENCH8_N];  /* kg m, kg m2; flywheel coupling (9) */
    bench8_real W[6][BENCH8_N];   /* scaled: G^-1 I D^-1; then with orthogonal rows */
    bench8_real U[6][6];          /* rotations of the rows */
    bench8_real G[6][6];          /* Cholesky factor of K, lower triangle */
    bench8_real b[6];             /* N, N m; the wrench demanded of the flywheels */
    bench8_real r[6];             /* scaled: G^-1 b; then U^T r */
    bench8_real sigma[6];         /* singular values */
    bench8_real scale[BENCH8_N];  /* D^-1 */
} bench8_inverse_work;

typedef uint64_t bench8_word;  /* the bits of a real */

BENCH8_CODE static bench8_word bench8_bits_of(bench8_real value)
{
    union { bench8_real real; bench8_word word; } both;
    both.real = value;
    return both.word;
}

BENCH8_CODE static bench8_real bench8_real_of(bench8_word word)
{
    union { bench8_real real; bench8_word word; } both;
    both.word = word;
    return both.real;
}

/* What null stands for. */
BENCH8_CONST static const int bench8_none_locked[BENCH8_N] = { 0 };

/* Square root, correctly rounded.
 * x >= 0 and finite, which the caller checks; subnormals are exact too, sqrt(0) = 0. */
BENCH8_CODE static bench8_real bench8_sqrt(bench8_real x)
{
#ifdef BENCH8_SQRT
    return BENCH8_SQRT(x);  /* correctly rounded as well, or the bits differ */
#else
    /* x = m 4^j with m in [1, 4), taken from its bits; subnormals are scaled up first. */
    const int subnormal = x < 2.2250738585072014e-308;
    const bench8_real lift = (subnormal) ? 1.8014398509481984e16 : 1.0;
    const bench8_word lowered = (subnormal) ? 27u : 0u;
    const bench8_word bits = bench8_bits_of(x * lift);
    const bench8_word exponent = bits >> 52u;
    const bench8_word odd = (exponent & 1u) ^ 1u;  /* the exponent's bias is odd */
    const bench8_word fraction = bits & 0xfffffffffffffu;
    const bench8_word m_bits = fraction + ((odd + 1023u) << 52u);
    const bench8_real m = bench8_real_of(m_bits);
    const bench8_real half_m = m * 0.5;
    /* y = 1/sqrt(m): a shift of the bits gives a first guess, Newton steps refine it. */
    const bench8_real y0 = bench8_real_of(0x5fe6eb50c7b537a9u - (m_bits >> 1u));
    const bench8_real y1 = y0 * (1.5 - half_m * y0 * y0);
    const bench8_real y2 = y1 * (1.5 - half_m * y1 * y1);
    const bench8_real y3 = y2 * (1.5 - half_m * y2 * y2);
    const bench8_real s = m * y3;
    const bench8_real close = s + (m - s * s) * (y3 * 0.5);  /* within 1.5 units in the last place */
    /* The last bit, exactly, in integers modulo 2^width: d = m - s^2 against s, in last places. */
    const bench8_word root = bench8_bits_of(close) - 0x3fe0000000000000u;  /* s as an integer */
    const bench8_word d = ((fraction + 0x10000000000000u) << odd << 52u) - root * root;
    const bench8_word up = (root - d) >> 63u;  /* 1 if d > s: the next larger number is nearer */
    const bench8_word down = (d + root - 1u) >> 63u;  /* 1 if d <= -s: the next smaller number is nearer */
    const bench8_word halved = ((exponent + 1023u - odd) >> 1u) - lowered;
    const bench8_real result = bench8_real_of(root + up - down + ((halved - 1u) << 52u));
    return (x > 0.0) ? result : x;
#endif
}

/* Angle of the vector (x, y), in [-pi, pi].
 * x and y finite. Error at most 2 units in the last place; signs of zeros as in C, atan2(0, 0) = 0. */
BENCH8_CODE static bench8_real bench8_atan2(bench8_real y, bench8_real x)
{
    const bench8_real x_size = (x < 0.0) ? -x : x;
    const bench8_real y_size = (y < 0.0) ? -y : y;
    const int steep = y_size > x_size;
    const bench8_real larger = (steep) ? y_size : x_size;
    /* larger + smaller must not overflow */
    const bench8_real scale = (larger > 2.247116418577895e307) ? 0.25 : 1.0;
    const bench8_real major = larger * scale;
    const bench8_real minor = ((steep) ? x_size : y_size) * scale;
    /* The angle of (major, minor) is atan(t), or pi/4 + atan(t) where minor > major/2; in both |t| <= 1/2. */
    const int beyond = minor + minor > major;
    const bench8_real above = (beyond) ? minor - major : minor;
    const bench8_real below = (beyond) ? minor + major : ((major > 0.0) ? major : 1.0);  /* 1 avoids 0/0 */
    const bench8_real octant = (beyond) ? 1.0 : 0.0;
    /* Octants: |y| > |x| is pi/2 - angle, a negative x (or -0, as in C) pi - angle. */
    const bench8_real above_1 = (steep) ? -above : above;
    const bench8_real octant_1 = (steep) ? 2.0 - octant : octant;
    const int left = (bench8_bits_of(x) & 0x8000000000000000u) != 0u;
    const bench8_real t = ((left) ? -above_1 : above_1) / below;
    const bench8_real octant_2 = (left) ? 4.0 - octant_1 : octant_1;
    const bench8_real z = t * t;
    /* atan t = t + t^3 A(t^2) */
    const bench8_real fitted = t * z * (-0.3333333333333298
        + z * (0.19999999999903115 + z * (-0.14285714276386494
        + z * (0.1111111065966467 + z * (-0.0909089624543797
        + z * (0.07692073923156066 + z * (-0.0666381072054367
        + z * (0.05858299583745059 + z * (-0.05122008614169068
        + z * (0.04186511848030717 + z * (-0.02743506477426233 + z * 0.010116924654437372)))))))))));
    /* octant pi/4 + atan t; pi/4 in two parts, so that its product with 3 is exact. */
    const bench8_real base = octant_2 * 0.7853981633974483;
    const bench8_real sum = base + t;  /* base is 0 or larger than t: */
    const bench8_real lost = base - sum + t;  /* so this is the rounding error of the sum */
    const bench8_real angle = sum + (lost + (fitted + octant_2 * 3.061616997868383e-17));
    return bench8_real_of(bench8_bits_of(angle) | (bench8_bits_of(y) & 0x8000000000000000u));
}

/* Removes k turns, phi - k 2 pi, with 2 pi in three parts: the product with the first is exact. */
BENCH8_CODE static bench8_real bench8_unwound(bench8_real phi, bench8_real k)
{
    return phi - k * 6.283185303211212 - k * 3.968374318722146e-9 - k * 1.5782216666252822e-23;
}

/* The angle wrapped to within half a turn of zero.
 * |phi| <= 1e7: beyond this the result is meaningless, but the call is safe. */
BENCH8_CODE static bench8_real bench8_wrapped(bench8_real phi)
{
    /* k = phi / (2 pi), rounded: adding the large constant leaves the integer k in the last bits. */
    const bench8_real k = phi * BENCH8_TURNS_A_RADIAN + BENCH8_ROUNDER - BENCH8_ROUNDER;  /* turns */
    return bench8_unwound(phi, k);
}

/* Are all values finite, and none larger in magnitude than the limit? A NaN fails every comparison. */
BENCH8_CODE BENCH8_APART static bench8_status bench8_within(
    const bench8_real values[], int count, bench8_real limit)
{
    for (int i = 0; i < count; ++i) {
        if (!(values[i] >= -limit && values[i] <= limit)) {
            if (values[i] >= -BENCH8_LARGEST && values[i] <= BENCH8_LARGEST) { return BENCH8_RANGE; }
            return BENCH8_NOT_FINITE;
        }
    }
    return BENCH8_OK;
}

/* Looks at a state number by number, where sums of squares do not show that it is within its limits. */
BENCH8_CODE BENCH8_APART static bench8_status bench8_check_numbers(const bench8_state *x)
{
    bench8_status status = bench8_within(x->position, 3, BENCH8_MAX_POSITION);
    if (status != BENCH8_OK) { return status; }
    status = bench8_within(x->attitude, 4, 2.0);
    if (status != BENCH8_OK) { return status; }
    status = bench8_within(x->V, 6, BENCH8_MAX_SPEED);
    if (status != BENCH8_OK) { return status; }
    status = bench8_within(x->V, 3, BENCH8_MAX_VELOCITY);
    if (status != BENCH8_OK) { return status; }
    status = bench8_within(x->phi, BENCH8_N, BENCH8_MAX_PHASE);
    if (status != BENCH8_OK) { return status; }
    status = bench8_within(x->phi_dot, BENCH8_N, BENCH8_MAX_SPEED);
    if (status != BENCH8_OK) { return status; }
    const bench8_real norm2 = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
        + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
    if (!(norm2 >= BENCH8_MIN_NORM2 && norm2 <= BENCH8_MAX_NORM2)) { return BENCH8_RANGE; }
    return BENCH8_OK;
}

/* Is the state finite, in its ranges, and its quaternion within 1e-3 of unit length? */
BENCH8_CODE static bench8_status bench8_check_state(const bench8_state *x)
{
    bench8_real position2 = 0.0;
    bench8_real velocity2 = 0.0;
    bench8_real speed2 = 0.0;
    bench8_real phase2 = 0.0;
    for (int i = 0; i < 3; ++i) {
        const bench8_real position = x->position[i];
        position2 += position * position;
        const bench8_real velocity = x->V[i];
        velocity2 += velocity * velocity;
        const bench8_real speed = x->V[i + 3];
        speed2 += speed * speed;
    }
    for (int s = 0; s < BENCH8_N; ++s) {
        const bench8_real phase = x->phi[s];
        phase2 += phase * phase;
        const bench8_real speed = x->phi_dot[s];
        speed2 += speed * speed;
    }
    const bench8_real norm2 = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
        + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
    if (norm2 >= BENCH8_MIN_NORM2 && norm2 <= BENCH8_MAX_NORM2
        && position2 < BENCH8_MAX_POSITION * BENCH8_MAX_POSITION
        && velocity2 < BENCH8_MAX_VELOCITY * BENCH8_MAX_VELOCITY
        && speed2 < BENCH8_MAX_SPEED * BENCH8_MAX_SPEED
        && phase2 < BENCH8_MAX_PHASE * BENCH8_MAX_PHASE) { return BENCH8_OK; }
    return bench8_check_numbers(x);
}

/* Is the state as check_state demands, and are values of the flywheels within a limit? */
BENCH8_CODE static bench8_status bench8_check_motion(
    const bench8_state *x, const bench8_real values[BENCH8_N], bench8_real limit)
{
    bench8_real position2 = 0.0;
    bench8_real velocity2 = 0.0;
    bench8_real speed2 = 0.0;
    bench8_real phase2 = 0.0;
    bench8_real value2 = 0.0;
    for (int i = 0; i < 3; ++i) {
        const bench8_real position = x->position[i];
        position2 += position * position;
        const bench8_real velocity = x->V[i];
        velocity2 += velocity * velocity;
        const bench8_real speed = x->V[i + 3];
        speed2 += speed * speed;
    }
    for (int s = 0; s < BENCH8_N; ++s) {
        const bench8_real phase = x->phi[s];
        phase2 += phase * phase;
        const bench8_real value = values[s];
        value2 += value * value;
        const bench8_real speed = x->phi_dot[s];
        speed2 += speed * speed;
    }
    const bench8_real norm2 = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
        + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
    if (norm2 >= BENCH8_MIN_NORM2 && norm2 <= BENCH8_MAX_NORM2
        && position2 < BENCH8_MAX_POSITION * BENCH8_MAX_POSITION
        && velocity2 < BENCH8_MAX_VELOCITY * BENCH8_MAX_VELOCITY
        && speed2 < BENCH8_MAX_SPEED * BENCH8_MAX_SPEED && phase2 < BENCH8_MAX_PHASE * BENCH8_MAX_PHASE
        && value2 < limit * limit) { return BENCH8_OK; }
    bench8_status status = bench8_check_numbers(x);
    if (status != BENCH8_OK) { return status; }
    return bench8_within(values, BENCH8_N, limit);
}

/* Rotation matrix of a quaternion of any length: no square root is needed. */
BENCH8_CODE static void bench8_rotation(const bench8_real q[4], bench8_real *restrict C /* [9] */)
{
    const bench8_real k = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
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
BENCH8_CODE static void bench8_rotate_back(
    const bench8_real C[9], const bench8_real a[3], bench8_real *restrict out /* [3] */)
{
    out[0] = C[0] * a[0] + C[3] * a[1] + C[6] * a[2];
    out[1] = C[1] * a[0] + C[4] * a[1] + C[7] * a[2];
    out[2] = C[2] * a[0] + C[5] * a[1] + C[8] * a[2];
}

/* Sines and cosines of all phases.
 * |x| <= 1e7, which the caller checks. Error at most 1 unit in the last place
 * for |x| <= 8 pi, and 1e-16 absolute beyond. Other x give meaningless results, but the call is safe. */
BENCH8_CODE static void bench8_sincos_each(
    const bench8_real x[BENCH8_N], bench8_real *restrict sine /* [BENCH8_N] */,
    bench8_real *restrict cosine /* [BENCH8_N] */)
{
    for (int s = 0; s < BENCH8_N; ++s) {
        /* k = x/(pi/2), rounded: adding the large constant leaves the integer k in the last bits. */
        const bench8_real shifted = x[s] * 0.6366197723675814 + BENCH8_ROUNDER;
        const bench8_word quadrant = bench8_bits_of(shifted);  /* mod 4: its last two bits */
        const bench8_real k = shifted - BENCH8_ROUNDER;
        /* r = r_hi - r_tail = x - k pi/2, pi/2 in three parts: the product with the first is exact. */
        const bench8_real rest = x[s] - k * 1.570796325802803;
        const bench8_real second = k * 9.920935796805365e-10;
        const bench8_real r_hi = rest - second;
        /* rounding error of r_hi, and the third part */
        const bench8_real r_tail = r_hi - rest + second + k * 3.9455541665632055e-24;
        const bench8_real z = r_hi * r_hi;
        /* cos r_hi = 1 - z/2 + z^2 C(z); the rounding error of 1 - z/2 is added back. */
        const bench8_real half_z = z * 0.5;
        const bench8_real flat = 1.0 - half_z;
        const bench8_real cos_fit = 0.0416666666666666
            + z * (-0.001388888888887447 + z
            * (2.4801587289666868e-5 + z * (-2.755731439924032e-7
            + z * (2.087572898867696e-9 + z * -1.1359916930271879e-11))));
        const bench8_real cos_r = flat + (1.0 - flat - half_z + (z * z * cos_fit + r_hi * r_tail));
        /* sin r_hi = r_hi - r_hi^3 S(z), S with positive sign so that sin(-0) = -0. */
        const bench8_real sin_fit = 0.1666666666666663
            + z * (-0.00833333333332184 + z * (0.00019841269829358541
            + z * (-2.7557313538526495e-6 + z * (2.5050734392488434e-8 + z * -1.5895433551463968e-10))));
        const bench8_real sin_r = r_hi - (z * r_hi * sin_fit + flat * r_tail);
        /* Odd quadrants exchange sine and cosine; quadrants 2, 3 negate the sine, 1, 2 the cosine. */
        const bench8_word sin_bits = bench8_bits_of(sin_r);
        const bench8_word cos_bits = bench8_bits_of(cos_r);
        const bench8_word exchange = (sin_bits ^ cos_bits) & (0u - (quadrant & 1u));
        const bench8_word sine_sign = (quadrant << 62u) & 0x8000000000000000u;
        const bench8_word cosine_sign = ((quadrant + 1u) << 62u) & 0x8000000000000000u;
        sine[s] = bench8_real_of(sin_bits ^ exchange ^ sine_sign);
        cosine[s] = bench8_real_of(cos_bits ^ exchange ^ cosine_sign);
    }
}

/* First moment and inertia of all bodies, and their rates in E1; w = phi_dot, (2), (6). */
BENCH8_CODE static void bench8_sum_mass(
    const bench8_table *table, const bench8_real sine[BENCH8_N], const bench8_real cosine[BENCH8_N],
    const bench8_real phi_dot[BENCH8_N], bench8_sums *restrict sum)
{
    sum->J[0] = table->inertia[0];  sum->J[1] = table->inertia[1];  sum->J[2] = table->inertia[2];
    sum->J[3] = table->inertia[3];  sum->J[4] = table->inertia[4];  sum->J[5] = table->inertia[5];
    sum->J_dot[0] = 0.0;  sum->J_dot[1] = 0.0;  sum->J_dot[2] = 0.0;
    sum->J_dot[3] = 0.0;  sum->J_dot[4] = 0.0;  sum->J_dot[5] = 0.0;
    sum->mu[0] = table->first_moment[0];
    sum->mu[1] = table->first_moment[1];
    sum->mu[2] = table->first_moment[2];
    sum->mu_dot[0] = 0.0;  sum->mu_dot[1] = 0.0;  sum->mu_dot[2] = 0.0;
    for (int k = 0; k < BENCH8_N; ++k) {
        const bench8_row *row = &table->flywheel[k];
        const bench8_real s = sine[k];
        const bench8_real c = cosine[k];
        const bench8_real w = phi_dot[k];
        const bench8_real c2 = 1.0 - 2.0 * (s * s);  /* cos 2 phi, then sin 2 phi */
        const bench8_real s2 = 2.0 * c * s;
        const bench8_real dc = -w * s;  /* time derivatives: d(cos phi)/dt, ... */
        const bench8_real ds = w * c;
        const bench8_real dc2 = -2.0 * w * s2;
        const bench8_real ds2 = 2.0 * w * c2;
        /* inertia */
        sum->J[0] += row->J_2c[0] * c2 + row->J_2s[0] * s2 + row->J_c[0] * c + row->J_s[0] * s;
        sum->J[1] += row->J_2c[1] * c2 + row->J_2s[1] * s2 + row->J_c[1] * c + row->J_s[1] * s;
        sum->J[2] += row->J_2c[2] * c2 + row->J_2s[2] * s2 + row->J_c[2] * c + row->J_s[2] * s;
        sum->J[3] += row->J_2c[3] * c2 + row->J_2s[3] * s2 + row->J_c[3] * c + row->J_s[3] * s;
        sum->J[4] += row->J_2c[4] * c2 + row->J_2s[4] * s2 + row->J_c[4] * c + row->J_s[4] * s;
        sum->J[5] += row->J_2c[5] * c2 + row->J_2s[5] * s2 + row->J_c[5] * c + row->J_s[5] * s;
        /* its rate: K_dot of (6) */
        sum->J_dot[0] += row->J_2c[0] * dc2 + row->J_2s[0] * ds2 + row->J_c[0] * dc + row->J_s[0] * ds;
        sum->J_dot[1] += row->J_2c[1] * dc2 + row->J_2s[1] * ds2 + row->J_c[1] * dc + row->J_s[1] * ds;
        sum->J_dot[2] += row->J_2c[2] * dc2 + row->J_2s[2] * ds2 + row->J_c[2] * dc + row->J_s[2] * ds;
        sum->J_dot[3] += row->J_2c[3] * dc2 + row->J_2s[3] * ds2 + row->J_c[3] * dc + row->J_s[3] * ds;
        sum->J_dot[4] += row->J_2c[4] * dc2 + row->J_2s[4] * ds2 + row->J_c[4] * dc + row->J_s[4] * ds;
        sum->J_dot[5] += row->J_2c[5] * dc2 + row->J_2s[5] * ds2 + row->J_c[5] * dc + row->J_s[5] * ds;
        /* first moment and its rate */
        sum->mu[0] += row->mu_c[0] * c + row->mu_s[0] * s;
        sum->mu[1] += row->mu_c[1] * c + row->mu_s[1] * s;
        sum->mu[2] += row->mu_c[2] * c + row->mu_s[2] * s;
        sum->mu_dot[0] += row->mu_c[0] * dc + row->mu_s[0] * ds;
        sum->mu_dot[1] += row->mu_c[1] * dc + row->mu_s[1] * ds;
        sum->mu_dot[2] += row->mu_c[2] * dc + row->mu_s[2] * ds;
    }
}

/* Terms of the flywheels' turning in momentum and forces; w = phi_dot is constant, (2), (5). */
BENCH8_CODE static BENCH8_COPIED void bench8_sum_steady_spin(
    const bench8_table *table, const bench8_real sine[BENCH8_N], const bench8_real cosine[BENCH8_N],
    const bench8_real phi_dot[BENCH8_N], bench8_sums *restrict sum)
{
    sum->h_rel[0] = 0.0;  sum->h_rel[1] = 0.0;  sum->h_rel[2] = 0.0;
    sum->g_rel[0] = 0.0;  sum->g_rel[1] = 0.0;  sum->g_rel[2] = 0.0;
    sum->a_rel[0] = 0.0;  sum->a_rel[1] = 0.0;  sum->a_rel[2] = 0.0;
    for (int k = 0; k < BENCH8_N; ++k) {
        const bench8_row *row = &table->flywheel[k];
        const bench8_real s = sine[k];
        const bench8_real c = cosine[k];
        const bench8_real w = phi_dot[k];
        const bench8_real dc = -w * s;  /* time derivatives: d(cos phi)/dt, ... */
        const bench8_real ds = w * c;
        const bench8_real ddc = -w * ds;  /* second time derivatives */
        const bench8_real dds = w * dc;
        /* I phi_ddot + Ls [<e>] Theta f phi_dot^2, the last two sums of (5) */
        sum->a_rel[0] += row->mu_c[0] * ddc + row->mu_s[0] * dds;
        sum->a_rel[1] += row->mu_c[1] * ddc + row->mu_s[1] * dds;
        sum->a_rel[2] += row->mu_c[2] * ddc + row->mu_s[2] * dds;
        /* moment part of I phi_dot (its force part is mu_dot) */
        sum->h_rel[0] += row->t_c[0] * ds + w * row->t_0[0] - row->t_s[0] * dc;
        sum->h_rel[1] += row->t_c[1] * ds + w * row->t_0[1] - row->t_s[1] * dc;
        sum->h_rel[2] += row->t_c[2] * ds + w * row->t_0[2] - row->t_s[2] * dc;
        sum->g_rel[0] += row->t_c[0] * dds - row->t_s[0] * ddc;
        sum->g_rel[1] += row->t_c[1] * dds - row->t_s[1] * ddc;
        sum->g_rel[2] += row->t_c[2] * dds - row->t_s[2] * ddc;
    }
}

/* Terms of the flywheels' turning in momentum and forces; w = phi_dot, a = phi_ddot, (2), (5). */
BENCH8_CODE static BENCH8_COPIED void bench8_sum_spin(
    const bench8_table *table, const bench8_real sine[BENCH8_N], const bench8_real cosine[BENCH8_N],
    const bench8_real phi_dot[BENCH8_N], const bench8_real phi_ddot[BENCH8_N], bench8_sums *restrict sum)
{
    sum->h_rel[0] = 0.0;  sum->h_rel[1] = 0.0;  sum->h_rel[2] = 0.0;
    sum->g_rel[0] = 0.0;  sum->g_rel[1] = 0.0;  sum->g_rel[2] = 0.0;
    sum->a_rel[0] = 0.0;  sum->a_rel[1] = 0.0;  sum->a_rel[2] = 0.0;
    for (int k = 0; k < BENCH8_N; ++k) {
        const bench8_row *row = &table->flywheel[k];
        const bench8_real s = sine[k];
        const bench8_real c = cosine[k];
        const bench8_real w = phi_dot[k];
        const bench8_real a = phi_ddot[k];
        const bench8_real dc = -w * s;  /* time derivatives: d(cos phi)/dt, ... */
        const bench8_real ds = w * c;
        const bench8_real ddc = -w * ds - a * s;  /* second time derivatives */
        const bench8_real dds = a * c + w * dc;
        /* moment part of I phi_dot (its force part is mu_dot) */
        sum->h_rel[0] += row->t_c[0] * ds + w * row->t_0[0] - row->t_s[0] * dc;
        sum->h_rel[1] += row->t_c[1] * ds + w * row->t_0[1] - row->t_s[1] * dc;
        sum->h_rel[2] += row->t_c[2] * ds + w * row->t_0[2] - row->t_s[2] * dc;
        sum->g_rel[0] += row->t_c[0] * dds + a * row->t_0[0] - row->t_s[0] * ddc;
        sum->g_rel[1] += row->t_c[1] * dds + a * row->t_0[1] - row->t_s[1] * ddc;
        sum->g_rel[2] += row->t_c[2] * dds + a * row->t_0[2] - row->t_s[2] * ddc;
        /* I phi_ddot + Ls [<e>] Theta f phi_dot^2, the last two sums of (5) */
        sum->a_rel[0] += row->mu_c[0] * ddc + row->mu_s[0] * dds;
        sum->a_rel[1] += row->mu_c[1] * ddc + row->mu_s[1] * dds;
        sum->a_rel[2] += row->mu_c[2] * ddc + row->mu_s[2] * dds;
    }
}

/* Rotation vector of a quaternion of about unit length; its length is at most pi. */
BENCH8_CODE static void bench8_rotation_vector(const bench8_real q[4], bench8_real *restrict r /* [3] */)
{
    /* q and -q are the same rotation: take the one of the smaller angle */
    const bench8_real side = (q[0] < 0.0) ? -1.0 : 1.0;
    const bench8_real square = q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    bench8_real ratio;  /* rotation angle, then divided by the length of the vector part */
    bench8_real divisor;
    if (square > BENCH8_EPS_SQUARE) {
        divisor = bench8_sqrt(square);
        ratio = 2.0 * bench8_atan2(divisor, side * q[0]);
    } else {
        /* |w| is near 1 here; the test only prevents a division by zero for other q */
        divisor = (side * q[0] > 0.5) ? side * q[0] : 1.0;
        ratio = 2.0;
    }
    ratio = ratio / divisor;
    r[0] = side * ratio * q[1];  r[1] = side * ratio * q[2];  r[2] = side * ratio * q[3];
}

/* Adds the suspension: -(stiffness x + damping V), x: C^T (O1 - position), rotation vector of C_eq^T C,
 * (7). */
BENCH8_CODE static void bench8_suspend(
    const bench8_suspension *law, const bench8_state *x, const bench8_real C[9],
    bench8_real *restrict F /* [6] */)
{
    bench8_real shift[3];
    bench8_real shift1[3];  /* C^T (O1 - position) */
    bench8_real turn[4];  /* quaternion of C_eq^T C */
    bench8_real angle[3];  /* its rotation vector */
    shift[0] = x->position[0] - law->position[0];
    shift[1] = x->position[1] - law->position[1];
    shift[2] = x->position[2] - law->position[2];
    bench8_rotate_back(C, shift, shift1);
    turn[0] = x->attitude[0] * law->attitude[0] + x->attitude[1] * law->attitude[1]
        + x->attitude[2] * law->attitude[2] + x->attitude[3] * law->attitude[3];
    turn[1] = x->attitude[1] * law->attitude[0] + x->attitude[2] * law->attitude[3]
        - x->attitude[0] * law->attitude[1] - x->attitude[3] * law->attitude[2];
    turn[2] = x->attitude[2] * law->attitude[0] + x->attitude[3] * law->attitude[1]
        - x->attitude[0] * law->attitude[2] - x->attitude[1] * law->attitude[3];
    turn[3] = x->attitude[1] * law->attitude[2] + x->attitude[3] * law->attitude[0]
        - x->attitude[0] * law->attitude[3] - x->attitude[2] * law->attitude[1];
    bench8_rotation_vector(turn, angle);
    for (int i = 0; i < 6; ++i) {
        F[i] -= x->V[0] * law->damping[i][0] + x->V[1] * law->damping[i][1] + x->V[2] * law->damping[i][2]
            + x->V[3] * law->damping[i][3] + x->V[4] * law->damping[i][4] + x->V[5] * law->damping[i][5]
            + law->stiffness[i][0] * shift1[0] + law->stiffness[i][1] * shift1[1]
            + law->stiffness[i][2] * shift1[2] + law->stiffness[i][3] * angle[0]
            + law->stiffness[i][4] * angle[1] + law->stiffness[i][5] * angle[2];
    }
}

/* Total external wrench of weight, suspension, from checked inputs, (7). */
BENCH8_CODE static void bench8_external(
    const bench8_table *table, const bench8_state *x, const bench8_sums *sum, const bench8_real C[9],
    const bench8_real g[3], bench8_real *restrict F /* [6] */)
{
    F[0] = 0.0;  F[1] = 0.0;  F[2] = 0.0;
    F[3] = 0.0;  F[4] = 0.0;  F[5] = 0.0;
    /* weight of all bodies: its line of action moves with the flywheels */
    F[0] += g[0] * table->mass;  F[1] += g[1] * table->mass;  F[2] += g[2] * table->mass;
    F[3] += g[2] * sum->mu[1] - g[1] * sum->mu[2];
    F[4] += g[0] * sum->mu[2] - g[2] * sum->mu[0];
    F[5] += g[1] * sum->mu[0] - g[0] * sum->mu[1];
    bench8_suspend(&table->suspension, x, C, F);
}

/* Momentum screw Z = K V + sum I phi_dot of the sums, (2). */
BENCH8_CODE static void bench8_momentum_screw(
    const bench8_table *table, const bench8_sums *sum, const bench8_real V[6],
    bench8_real *restrict Z /* [6] */)
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

/* Turns F into the right-hand side of (8): F - Phi Z - K_dot V - the flywheels' terms, (2), (4), (5). */
BENCH8_CODE static void bench8_subtract_rates(
    const bench8_table *table, const bench8_sums *sum, const bench8_real V[6],
    bench8_real *restrict F /* [6] */)
{
    /* momentum screw Z = K V + sum I phi_dot */
    const bench8_real Z1 = table->mass * V[0] + sum->mu[2] * V[4] + sum->mu_dot[0] - sum->mu[1] * V[5];
    const bench8_real Z2 = table->mass * V[1] + sum->mu[0] * V[5] + sum->mu_dot[1] - sum->mu[2] * V[3];
    const bench8_real Z3 = table->mass * V[2] + sum->mu[1] * V[3] + sum->mu_dot[2] - sum->mu[0] * V[4];
    const bench8_real Z4 = sum->J[0] * V[3] + sum->J[3] * V[4] + sum->J[4] * V[5] + sum->h_rel[0]
        + sum->mu[1] * V[2] - sum->mu[2] * V[1];
    const bench8_real Z5 = sum->J[1] * V[4] + sum->J[3] * V[3] + sum->J[5] * V[5] + sum->h_rel[1]
        + sum->mu[2] * V[0] - sum->mu[0] * V[2];
    const bench8_real Z6 = sum->J[2] * V[5] + sum->J[4] * V[3] + sum->J[5] * V[4] + sum->h_rel[2]
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
BENCH8_CODE static inline bench8_status bench8_factor3(const bench8_real S[6], bench8_factors3 *restrict L)
{
    if (!(S[0] >= BENCH8_SMALLEST)) { return BENCH8_NOT_POSITIVE_DEFINITE; }
    const bench8_real r1 = 1.0 / S[0];
    const bench8_real l21 = S[3] * r1;
    const bench8_real l31 = S[4] * r1;
    const bench8_real d2 = S[1] - l21 * S[3];
    if (!(d2 >= BENCH8_SMALLEST)) { return BENCH8_NOT_POSITIVE_DEFINITE; }
    const bench8_real r2 = 1.0 / d2;
    const bench8_real p32 = S[5] - l31 * S[3];
    const bench8_real l32 = p32 * r2;
    const bench8_real d3 = S[2] - l31 * S[4] - l32 * p32;
    if (!(d3 >= BENCH8_SMALLEST)) { return BENCH8_NOT_POSITIVE_DEFINITE; }
    L->r1 = r1;
    L->r2 = r2;
    L->d3 = d3;
    L->l21 = l21;
    L->l31 = l31;
    L->l32 = l32;
    return BENCH8_OK;
}

/* Solves S y = b by S = L D L^T. */
BENCH8_CODE static inline void bench8_solve3(
    const bench8_factors3 *L, const bench8_real b[3], bench8_real *restrict y /* [3] */)
{
    /* L z = b, then L^T y = D^-1 z */
    const bench8_real z2 = b[1] - L->l21 * b[0];
    const bench8_real y3 = (b[2] - L->l31 * b[0] - L->l32 * z2) / L->d3;
    const bench8_real y2 = z2 * L->r2 - L->l32 * y3;
    y[0] = b[0] * L->r1 - L->l21 * y2 - L->l31 * y3;
    y[1] = y2;  y[2] = y3;
}

/* Solves K y = F where no other right-hand side follows: factors of K as factor_carrier finds them, (8). */
BENCH8_CODE static bench8_status bench8_solve_carrier_once(
    const bench8_table *table, const bench8_sums *sum, const bench8_real F[6], bench8_real y[6])
{
    bench8_real rho[3];  /* mass centre from O1, in E1 */
    rho[0] = table->mass_inverse * sum->mu[0];
    rho[1] = table->mass_inverse * sum->mu[1];
    rho[2] = table->mass_inverse * sum->mu[2];
    bench8_real S[6];  /* inertia about the mass centre */
    S[0] = sum->J[0] - sum->mu[1] * rho[1] - sum->mu[2] * rho[2];
    S[1] = sum->J[1] - sum->mu[0] * rho[0] - sum->mu[2] * rho[2];
    S[2] = sum->J[2] - sum->mu[0] * rho[0] - sum->mu[1] * rho[1];
    S[3] = sum->J[3] + sum->mu[1] * rho[0];
    S[4] = sum->J[4] + sum->mu[2] * rho[0];
    S[5] = sum->J[5] + sum->mu[2] * rho[1];
    if (!(S[0] >= BENCH8_SMALLEST)) { return BENCH8_NOT_POSITIVE_DEFINITE; }
    const bench8_real r1 = 1.0 / S[0];
    const bench8_real l21 = S[3] * r1;
    const bench8_real l31 = S[4] * r1;
    const bench8_real d2 = S[1] - l21 * S[3];
    if (!(d2 >= BENCH8_SMALLEST)) { return BENCH8_NOT_POSITIVE_DEFINITE; }
    const bench8_real r2 = 1.0 / d2;
    const bench8_real p32 = S[5] - l31 * S[3];
    const bench8_real l32 = p32 * r2;
    const bench8_real d3 = S[2] - l31 * S[4] - l32 * p32;
    if (!(d3 >= BENCH8_SMALLEST)) { return BENCH8_NOT_POSITIVE_DEFINITE; }
    bench8_real moment[3];  /* about the mass centre */
    moment[0] = F[1] * rho[2] + F[3] - F[2] * rho[1];
    moment[1] = F[2] * rho[0] + F[4] - F[0] * rho[2];
    moment[2] = F[0] * rho[1] + F[5] - F[1] * rho[0];
    /* L z = b, then L^T y = D^-1 z */
    const bench8_real z2 = moment[1] - l21 * moment[0];
    const bench8_real y3 = (moment[2] - l31 * moment[0] - l32 * z2) / d3;
    const bench8_real y2 = z2 * r2 - l32 * y3;
    const bench8_real y1 = moment[0] * r1 - l21 * y2 - l31 * y3;
    const bench8_real v1_dot = F[0] * table->mass_inverse + y3 * rho[1] - y2 * rho[2];
    const bench8_real v2_dot = F[1] * table->mass_inverse + y1 * rho[2] - y3 * rho[0];
    const bench8_real v3_dot = F[2] * table->mass_inverse + y2 * rho[0] - y1 * rho[1];
    y[0] = v1_dot;  y[1] = v2_dot;  y[2] = v3_dot;
    y[3] = y1;      y[4] = y2;      y[5] = y3;
    return BENCH8_OK;
}

/* K V_dot = F - M V - sum(I phi_ddot + J phi_dot) of checked inputs; written where the status is OK, (8). */
BENCH8_CODE static bench8_status bench8_accelerate(
    const bench8_table *table, const bench8_state *x, const bench8_real sine[BENCH8_N],
    const bench8_real cosine[BENCH8_N], const bench8_real phi_ddot[BENCH8_N], bench8_real V_dot[6])
{
    bench8_real C[9];  /* attitude */
    bench8_rotation(x->attitude, C);
    bench8_real g[3];  /* gravity in E1 */
    bench8_rotate_back(C, table->gravity, g);
    bench8_sums sum;
    bench8_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    bench8_sum_spin(table, sine, cosine, x->phi_dot, phi_ddot, &sum);
    bench8_real F[6];  /* wrench (7); then the right-hand side of (8) */
    bench8_external(table, x, &sum, C, g, F);
    bench8_subtract_rates(table, &sum, x->V, F);
    return bench8_solve_carrier_once(table, &sum, F, V_dot);
}

BENCH8_CODE bench8_status bench8_forward(
    const bench8_table *table, const bench8_state *x, const bench8_real phi_ddot[BENCH8_N],
    bench8_real V_dot[6])
{
    if (table == NULL || x == NULL || phi_ddot == NULL || V_dot == NULL) { return BENCH8_BAD_ARGUMENT; }
    bench8_status status = bench8_check_motion(x, phi_ddot, BENCH8_MAX_ACCELERATION);
    if (status != BENCH8_OK) { return status; }
    bench8_real sine[BENCH8_N], cosine[BENCH8_N];
    bench8_sincos_each(x->phi, sine, cosine);
    return bench8_accelerate(table, x, sine, cosine, phi_ddot, V_dot);
}

BENCH8_CODE bench8_status bench8_momentum(
    const bench8_table *table, const bench8_state *x, bench8_momentum_result *out)
{
    if (table == NULL || x == NULL || out == NULL) { return BENCH8_BAD_ARGUMENT; }
    bench8_status status = bench8_check_state(x);
    if (status != BENCH8_OK) { return status; }
    bench8_real C[9];  /* attitude */
    bench8_rotation(x->attitude, C);
    bench8_sums sum;
    bench8_real sine[BENCH8_N], cosine[BENCH8_N];
    bench8_sincos_each(x->phi, sine, cosine);
    bench8_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    bench8_sum_steady_spin(table, sine, cosine, x->phi_dot, &sum);
    bench8_real Z[6];  /* momentum screw (2) */
    bench8_momentum_screw(table, &sum, x->V, Z);
    bench8_real spin = 0.0;  /* sum phi_dot (I^T V + Theta_ff phi_dot) */
    for (int s = 0; s < BENCH8_N; ++s) {
        const bench8_row *row = &table->flywheel[s];
        const bench8_real s_phi = sine[s];
        const bench8_real c_phi = cosine[s];
        /* I_s . V */
        const bench8_real along = (row->mu_s[0] * c_phi - row->mu_c[0] * s_phi) * x->V[0]
            + (row->mu_s[1] * c_phi - row->mu_c[1] * s_phi) * x->V[1]
            + (row->mu_s[2] * c_phi - row->mu_c[2] * s_phi) * x->V[2]
            + (row->t_c[0] * c_phi + row->t_s[0] * s_phi + row->t_0[0]) * x->V[3]
            + (row->t_c[1] * c_phi + row->t_s[1] * s_phi + row->t_0[1]) * x->V[4]
            + (row->t_c[2] * c_phi + row->t_s[2] * s_phi + row->t_0[2]) * x->V[5];
        spin += x->phi_dot[s] * (along + row->spin * x->phi_dot[s]);
    }
    bench8_real energy = 0.5 * Z[3] * x->V[3] + 0.5 * Z[4] * x->V[4] + 0.5 * Z[5] * x->V[5]
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
    bench8_real v[3];  /* of the mass centre in E1, from the momentum of the bodies, without the fluid's */
    v[0] = Z[0] * table->mass_inverse;  v[1] = Z[1] * table->mass_inverse;  v[2] = Z[2] * table->mass_inverse;
    out->center_of_mass_velocity[0] = C[0] * v[0] + C[1] * v[1] + C[2] * v[2];
    out->center_of_mass_velocity[1] = C[3] * v[0] + C[4] * v[1] + C[5] * v[2];
    out->center_of_mass_velocity[2] = C[6] * v[0] + C[7] * v[1] + C[8] * v[2];
    return BENCH8_OK;
}

/* Column of I of one flywheel, and its drive torque at V_dot = 0, phi_ddot = 0, (9). */
BENCH8_CODE static BENCH8_COPIED void bench8_couple(
    const bench8_row *row, bench8_real s, bench8_real c, const bench8_real origin_acceleration[3],
    const bench8_real spun[6], bench8_coupling *restrict out)
{
    const bench8_real two_c2 = 2.0 - 4.0 * (s * s);  /* twice the cosine and sine of the double phase */
    const bench8_real two_s2 = 4.0 * c * s;
    out->I_[0] = row->mu_s[0] * c - row->mu_c[0] * s;
    out->I_[1] = row->mu_s[1] * c - row->mu_c[1] * s;
    out->I_[2] = row->mu_s[2] * c - row->mu_c[2] * s;
    out->I_[3] = row->t_c[0] * c + row->t_s[0] * s + row->t_0[0];
    out->I_[4] = row->t_c[1] * c + row->t_s[1] * s + row->t_0[1];
    out->I_[5] = row->t_c[2] * c + row->t_s[2] * s + row->t_0[2];
    /* dJ / dphi */
    const bench8_real J_p1 = row->J_2s[0] * two_c2 + row->J_s[0] * c - row->J_2c[0] * two_s2
        - row->J_c[0] * s;
    const bench8_real J_p2 = row->J_2s[1] * two_c2 + row->J_s[1] * c - row->J_2c[1] * two_s2
        - row->J_c[1] * s;
    const bench8_real J_p3 = row->J_2s[2] * two_c2 + row->J_s[2] * c - row->J_2c[2] * two_s2
        - row->J_c[2] * s;
    const bench8_real J_p4 = row->J_2s[3] * two_c2 + row->J_s[3] * c - row->J_2c[3] * two_s2
        - row->J_c[3] * s;
    const bench8_real J_p5 = row->J_2s[4] * two_c2 + row->J_s[4] * c - row->J_2c[4] * two_s2
        - row->J_c[4] * s;
    const bench8_real J_p6 = row->J_2s[5] * two_c2 + row->J_s[5] * c - row->J_2c[5] * two_s2
        - row->J_c[5] * s;
    out->bias = J_p1 * spun[0] + J_p2 * spun[1] + J_p3 * spun[2] + J_p4 * spun[3] + J_p5 * spun[4]
        + J_p6 * spun[5] + out->I_[0] * origin_acceleration[0] + out->I_[1] * origin_acceleration[1]
        + out->I_[2] * origin_acceleration[2];
}

/* Eliminates one free flywheel: K - I I^T / Theta_ff, F - I rate. */
BENCH8_CODE static void bench8_eliminate(
    const bench8_real column[6], bench8_real spin_inv, bench8_real rate, bench8_schur *restrict K,
    bench8_real *restrict F /* [6] */)
{
    bench8_real scaled[6];  /* I / Theta_ff */
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
BENCH8_CODE static void bench8_balance(
    const bench8_table *table, const bench8_state *x, const bench8_real sine[BENCH8_N],
    const bench8_real cosine[BENCH8_N], const bench8_real V_dot[6], const bench8_real phi_ddot[BENCH8_N],
    bench8_real *restrict tau /* [BENCH8_N] */)
{
    bench8_real C[9];  /* attitude */
    bench8_rotation(x->attitude, C);
    bench8_real g[3];  /* gravity in E1 */
    bench8_rotate_back(C, table->gravity, g);
    bench8_real origin_acceleration[3];  /* acceleration of O1 at V_dot = 0, minus gravity */
    origin_acceleration[0] = x->V[4] * x->V[2] - g[0] - x->V[5] * x->V[1];
    origin_acceleration[1] = x->V[5] * x->V[0] - g[1] - x->V[3] * x->V[2];
    origin_acceleration[2] = x->V[3] * x->V[1] - g[2] - x->V[4] * x->V[0];
    bench8_real spun[6];  /* six numbers: J . spun = -omega . J omega / 2 for every inertia J */
    spun[0] = -0.5 * (x->V[3] * x->V[3]);
    spun[1] = -0.5 * (x->V[4] * x->V[4]);
    spun[2] = -0.5 * (x->V[5] * x->V[5]);
    spun[3] = -x->V[3] * x->V[4];  spun[4] = -x->V[3] * x->V[5];  spun[5] = -x->V[4] * x->V[5];
    bench8_coupling drive;
    for (int s = 0; s < BENCH8_N; ++s) {
        bench8_couple(&table->flywheel[s], sine[s], cosine[s], origin_acceleration, spun, &drive);
        tau[s] = V_dot[0] * drive.I_[0] + V_dot[1] * drive.I_[1] + V_dot[2] * drive.I_[2]
            + V_dot[3] * drive.I_[3] + V_dot[4] * drive.I_[4] + V_dot[5] * drive.I_[5]
            + table->flywheel[s].spin * phi_ddot[s] + drive.bias;
    }
}

BENCH8_CODE bench8_status bench8_torque(
    const bench8_table *table, const bench8_state *x, const bench8_real V_dot[6],
    const bench8_real phi_ddot[BENCH8_N], bench8_real tau[BENCH8_N])
{
    if (table == NULL || x == NULL || V_dot == NULL || phi_ddot == NULL
        || tau == NULL) { return BENCH8_BAD_ARGUMENT; }
    bench8_status status = bench8_check_motion(x, phi_ddot, BENCH8_MAX_ACCELERATION);
    if (status != BENCH8_OK) { return status; }
    status = bench8_within(V_dot, 6, BENCH8_MAX_ACCELERATION);
    if (status != BENCH8_OK) { return status; }
    bench8_real C[9];  /* attitude */
    bench8_rotation(x->attitude, C);
    bench8_real g[3];  /* gravity in E1 */
    bench8_rotate_back(C, table->gravity, g);
    bench8_real sine[BENCH8_N], cosine[BENCH8_N];
    bench8_sincos_each(x->phi, sine, cosine);
    bench8_real origin_acceleration[3];  /* acceleration of O1 at V_dot = 0, minus gravity */
    origin_acceleration[0] = x->V[4] * x->V[2] - g[0] - x->V[5] * x->V[1];
    origin_acceleration[1] = x->V[5] * x->V[0] - g[1] - x->V[3] * x->V[2];
    origin_acceleration[2] = x->V[3] * x->V[1] - g[2] - x->V[4] * x->V[0];
    bench8_real spun[6];  /* six numbers: J . spun = -omega . J omega / 2 for every inertia J */
    spun[0] = -0.5 * (x->V[3] * x->V[3]);
    spun[1] = -0.5 * (x->V[4] * x->V[4]);
    spun[2] = -0.5 * (x->V[5] * x->V[5]);
    spun[3] = -x->V[3] * x->V[4];  spun[4] = -x->V[3] * x->V[5];  spun[5] = -x->V[4] * x->V[5];
    bench8_coupling drive;
    for (int s = 0; s < BENCH8_N; ++s) {
        bench8_couple(&table->flywheel[s], sine[s], cosine[s], origin_acceleration, spun, &drive);
        tau[s] = V_dot[0] * drive.I_[0] + V_dot[1] * drive.I_[1] + V_dot[2] * drive.I_[2]
            + V_dot[3] * drive.I_[3] + V_dot[4] * drive.I_[4] + V_dot[5] * drive.I_[5]
            + table->flywheel[s].spin * phi_ddot[s] + drive.bias;
    }
    return BENCH8_OK;
}

/* Factors [A B^T; B D], symmetric positive definite, by blocks of 3x3. */
BENCH8_CODE static bench8_status bench8_factor_schur(
    const bench8_schur *K, bench8_schur_factor *restrict factor)
{
    const bench8_real c11 = K->A[1] * K->A[2] - K->A[5] * K->A[5];
    const bench8_real c22 = K->A[0] * K->A[2] - K->A[4] * K->A[4];
    const bench8_real c33 = K->A[0] * K->A[1] - K->A[3] * K->A[3];
    const bench8_real c12 = K->A[4] * K->A[5] - K->A[2] * K->A[3];
    const bench8_real c13 = K->A[3] * K->A[5] - K->A[1] * K->A[4];
    const bench8_real c23 = K->A[3] * K->A[4] - K->A[0] * K->A[5];
    const bench8_real det = K->A[0] * c11 + K->A[3] * c12 + K->A[4] * c13;
    if (!(K->A[0] > 0.0 && c33 > 0.0 && (det >= BENCH8_SMALLEST
        && det <= BENCH8_LARGEST))) { return BENCH8_NOT_POSITIVE_DEFINITE; }
    const bench8_real r = 1.0 / det;
    factor->A_inv[0] = c11 * r;  factor->A_inv[1] = c22 * r;  factor->A_inv[2] = c33 * r;
    factor->A_inv[3] = c12 * r;  factor->A_inv[4] = c13 * r;  factor->A_inv[5] = c23 * r;
    bench8_real S[6];  /* D - B A^-1 B^T */
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
    return bench8_factor3(S, &factor->L);
}

/* Solves [A B^T; B D] y = F by the factors. */
BENCH8_CODE static void bench8_solve_schur(
    const bench8_schur_factor *factor, const bench8_real F[6], bench8_real *restrict y /* [6] */)
{
    bench8_real moment[3];  /* n - B A^-1 f */
    bench8_real omega_dot[3];
    moment[0] = F[3] - factor->U[0] * F[0] - factor->U[3] * F[1] - factor->U[6] * F[2];
    moment[1] = F[4] - factor->U[1] * F[0] - factor->U[4] * F[1] - factor->U[7] * F[2];
    moment[2] = F[5] - factor->U[2] * F[0] - factor->U[5] * F[1] - factor->U[8] * F[2];
    bench8_solve3(&factor->L, moment, omega_dot);
    y[0] = factor->A_inv[0] * F[0] + factor->A_inv[3] * F[1] + factor->A_inv[4] * F[2]
        - factor->U[0] * omega_dot[0] - factor->U[1] * omega_dot[1] - factor->U[2] * omega_dot[2];
    y[1] = factor->A_inv[1] * F[1] + factor->A_inv[3] * F[0] + factor->A_inv[5] * F[2]
        - factor->U[3] * omega_dot[0] - factor->U[4] * omega_dot[1] - factor->U[5] * omega_dot[2];
    y[2] = factor->A_inv[2] * F[2] + factor->A_inv[4] * F[0] + factor->A_inv[5] * F[1]
        - factor->U[6] * omega_dot[0] - factor->U[7] * omega_dot[1] - factor->U[8] * omega_dot[2];
    y[3] = omega_dot[0];  y[4] = omega_dot[1];  y[5] = omega_dot[2];
}

/* V_dot, phi_ddot for given drive torques, from checked inputs; written where the status is OK. */
BENCH8_CODE static bench8_status bench8_solve_coupled(
    const bench8_table *table, const bench8_state *x, const bench8_real sine[BENCH8_N],
    const bench8_real cosine[BENCH8_N], const bench8_real tau[BENCH8_N], const int locked[BENCH8_N],
    bench8_real *restrict V_dot /* [6] */, bench8_real *restrict phi_ddot /* [BENCH8_N] */)
{
    bench8_real C[9];  /* attitude */
    bench8_rotation(x->attitude, C);
    bench8_real g[3];  /* gravity in E1 */
    bench8_rotate_back(C, table->gravity, g);
    bench8_sums sum;
    bench8_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    bench8_sum_steady_spin(table, sine, cosine, x->phi_dot, &sum);
    bench8_real F[6];  /* wrench (7); then the right-hand side of K V_dot + I phi_ddot = F */
    bench8_external(table, x, &sum, C, g, F);
    bench8_subtract_rates(table, &sum, x->V, F);
    bench8_schur K;  /* mass matrix with free flywheels eliminated */
    K.A[0] = table->mass;  K.A[1] = table->mass;  K.A[2] = table->mass;
    K.A[3] = 0.0;          K.A[4] = 0.0;          K.A[5] = 0.0;
    K.B[0] = 0.0;         K.B[1] = -sum.mu[2];  K.B[2] = sum.mu[1];
    K.B[3] = sum.mu[2];   K.B[4] = 0.0;         K.B[5] = -sum.mu[0];
    K.B[6] = -sum.mu[1];  K.B[7] = sum.mu[0];   K.B[8] = 0.0;
    K.D[0] = sum.J[0];  K.D[1] = sum.J[1];  K.D[2] = sum.J[2];
    K.D[3] = sum.J[3];  K.D[4] = sum.J[4];  K.D[5] = sum.J[5];
    bench8_coupling drive[BENCH8_N];
    bench8_real origin_acceleration[3];  /* acceleration of O1 at V_dot = 0, minus gravity */
    origin_acceleration[0] = x->V[4] * x->V[2] - g[0] - x->V[5] * x->V[1];
    origin_acceleration[1] = x->V[5] * x->V[0] - g[1] - x->V[3] * x->V[2];
    origin_acceleration[2] = x->V[3] * x->V[1] - g[2] - x->V[4] * x->V[0];
    bench8_real spun[6];  /* six numbers: J . spun = -omega . J omega / 2 for every inertia J */
    spun[0] = -0.5 * (x->V[3] * x->V[3]);
    spun[1] = -0.5 * (x->V[4] * x->V[4]);
    spun[2] = -0.5 * (x->V[5] * x->V[5]);
    spun[3] = -x->V[3] * x->V[4];  spun[4] = -x->V[3] * x->V[5];  spun[5] = -x->V[4] * x->V[5];
    bench8_real rate[BENCH8_N];  /* accelerations at V_dot = 0 */
    for (int s = 0; s < BENCH8_N; ++s) {
        const bench8_row *row = &table->flywheel[s];
        if (locked[s] == 0) {
            bench8_couple(row, sine[s], cosine[s], origin_acceleration, spun, &drive[s]);
            rate[s] = (tau[s] - drive[s].bias) * row->spin_inv;
            bench8_eliminate(drive[s].I_, row->spin_inv, rate[s], &K, F);
        } else {
            drive[s].I_[0] = 0.0;  drive[s].I_[1] = 0.0;  drive[s].I_[2] = 0.0;
            drive[s].I_[3] = 0.0;  drive[s].I_[4] = 0.0;  drive[s].I_[5] = 0.0;
            rate[s] = 0.0;
        }
    }
    bench8_schur_factor factor;
    bench8_status status = bench8_factor_schur(&K, &factor);
    if (status != BENCH8_OK) { return status; }
    bench8_solve_schur(&factor, F, V_dot);
    for (int s = 0; s < BENCH8_N; ++s) {
        phi_ddot[s] = 0.0;
        if (locked[s] == 0) {
            phi_ddot[s] = rate[s] - (V_dot[0] * drive[s].I_[0] + V_dot[1] * drive[s].I_[1]
                + V_dot[2] * drive[s].I_[2] + V_dot[3] * drive[s].I_[3] + V_dot[4] * drive[s].I_[4]
                + V_dot[5] * drive[s].I_[5]) * table->flywheel[s].spin_inv;
        }
    }
    return BENCH8_OK;
}

BENCH8_CODE bench8_status bench8_coupled(
    const bench8_table *table, const bench8_state *x, const bench8_real tau[BENCH8_N],
    const int locked[BENCH8_N], bench8_real V_dot[6], bench8_real phi_ddot[BENCH8_N])
{
    if (table == NULL || x == NULL || tau == NULL || V_dot == NULL
        || phi_ddot == NULL) { return BENCH8_BAD_ARGUMENT; }
    if (locked == NULL) { locked = bench8_none_locked; }
    bench8_status status = bench8_check_motion(x, tau, BENCH8_MAX_WRENCH);
    if (status != BENCH8_OK) { return status; }
    bench8_real V_result[6], phi_result[BENCH8_N], sine[BENCH8_N], cosine[BENCH8_N];
    bench8_sincos_each(x->phi, sine, cosine);
    status = bench8_solve_coupled(table, x, sine, cosine, tau, locked, V_result, phi_result);
    if (status != BENCH8_OK) { return status; }
    V_dot[0] = V_result[0];  V_dot[1] = V_result[1];  V_dot[2] = V_result[2];
    V_dot[3] = V_result[3];  V_dot[4] = V_result[4];  V_dot[5] = V_result[5];
    for (int s = 0; s < BENCH8_N; ++s) { phi_ddot[s] = phi_result[s]; }
    return BENCH8_OK;
}

/* Sets to = x + h rate, after wrapping the phases to within half a turn. */
BENCH8_CODE static void bench8_advance(
    const bench8_state *x, const bench8_state *rate, bench8_real h, bench8_state *restrict to)
{
    for (int i = 0; i < 3; ++i) { to->position[i] = x->position[i] + h * rate->position[i]; }
    for (int i = 0; i < 4; ++i) { to->attitude[i] = x->attitude[i] + h * rate->attitude[i]; }
    for (int i = 0; i < 6; ++i) { to->V[i] = x->V[i] + h * rate->V[i]; }
    for (int i = 0; i < BENCH8_N; ++i) { to->phi[i] = bench8_wrapped(x->phi[i]) + h * rate->phi[i]; }
    for (int i = 0; i < BENCH8_N; ++i) { to->phi_dot[i] = x->phi_dot[i] + h * rate->phi_dot[i]; }
}

/* Normalizes the quaternion and wraps the phases to [-pi, pi]; RANGE if the state is out of range. */
BENCH8_CODE static bench8_status bench8_finish(bench8_state *restrict x)
{
    const bench8_real square = x->attitude[0] * x->attitude[0] + x->attitude[1] * x->attitude[1]
        + x->attitude[2] * x->attitude[2] + x->attitude[3] * x->attitude[3];
    if (!(square > 0.5 && square < 2.0)) { return BENCH8_RANGE; }
    const bench8_real inverse = 1.0 / bench8_sqrt(square);
    x->attitude[0] = x->attitude[0] * inverse;
    x->attitude[1] = x->attitude[1] * inverse;
    x->attitude[2] = x->attitude[2] * inverse;
    x->attitude[3] = x->attitude[3] * inverse;
    bench8_status status = bench8_check_motion(x, x->phi_dot, BENCH8_MAX_SPEED);
    if (status != BENCH8_OK) { return status; }
    for (int s = 0; s < BENCH8_N; ++s) { x->phi[s] = bench8_wrapped(x->phi[s]); }
    return BENCH8_OK;
}

/* Sets to = x + h rate with phases in [-pi, pi] and a quaternion of unit length, and keeps in the carry
 * what rounding takes from the sums; RANGE if the state is out of range. */
BENCH8_CODE static bench8_status bench8_carry_over(
    const bench8_state *x, const bench8_state *rate, bench8_real h, bench8_step_carry *restrict carry,
    bench8_state *restrict to)
{
    bench8_step_carry kept = *carry;  /* the new carry */
    for (int i = 0; i < 3; ++i) {
        const bench8_real step = h * rate->position[i] + kept.rounding[i];
        const bench8_real sum = x->position[i] + step;
        const bench8_real sum_b = sum - x->position[i];
        kept.rounding[i] = x->position[i] - (sum - sum_b) + (step - sum_b);
        to->position[i] = sum;
    }
    for (int i = 0; i < 4; ++i) {
        const bench8_real step = h * rate->attitude[i] + kept.rounding[i + 3];
        const bench8_real sum = x->attitude[i] + step;
        const bench8_real sum_b = sum - x->attitude[i];
        kept.rounding[i + 3] = x->attitude[i] - (sum - sum_b) + (step - sum_b);
        to->attitude[i] = sum;
    }
    for (int i = 0; i < 6; ++i) {
        const bench8_real step = h * rate->V[i] + kept.rounding[i + 7];
        const bench8_real sum = x->V[i] + step;
        const bench8_real sum_b = sum - x->V[i];
        kept.rounding[i + 7] = x->V[i] - (sum - sum_b) + (step - sum_b);
        to->V[i] = sum;
    }
    for (int i = 0; i < BENCH8_N; ++i) {
        const bench8_real start = bench8_wrapped(x->phi[i]);
        const bench8_real step = h * rate->phi[i] + kept.rounding[i + 13];
        const bench8_real sum = start + step;
        const bench8_real sum_b = sum - start;
        const bench8_real k = sum * BENCH8_TURNS_A_RADIAN + BENCH8_ROUNDER - BENCH8_ROUNDER;  /* turns */
        const bench8_real left = sum - k * 6.283185303211212;
        const bench8_real within = left + -(k * 3.968374318722146e-9);
        const bench8_real within_b = within - left;
        kept.rounding[i + 13] = start - (sum - sum_b) + (step - sum_b)
            + (left - (within - within_b) + (-(k * 3.968374318722146e-9) - within_b)
            - k * 1.5782216666252822e-23);
        to->phi[i] = within;
    }
    for (int i = 0; i < BENCH8_N; ++i) {
        const bench8_real step = h * rate->phi_dot[i] + kept.rounding[i + 21];
        const bench8_real sum = x->phi_dot[i] + step;
        const bench8_real sum_b = sum - x->phi_dot[i];
        kept.rounding[i + 21] = x->phi_dot[i] - (sum - sum_b) + (step - sum_b);
        to->phi_dot[i] = sum;
    }
    const bench8_real square = to->attitude[0] * to->attitude[0] + to->attitude[1] * to->attitude[1]
        + to->attitude[2] * to->attitude[2] + to->attitude[3] * to->attitude[3];
    if (!(square > 0.5 && square < 2.0)) { return BENCH8_RANGE; }
    /* 1/|q| - 1, without the digits that the difference would lose */
    const bench8_real excess = (1.0 - square) / (bench8_sqrt(square) + square);
    for (int i = 0; i < 4; ++i) {
        const bench8_real step = to->attitude[i] * excess + kept.rounding[i + 3];
        const bench8_real sum = to->attitude[i] + step;
        const bench8_real sum_b = sum - to->attitude[i];
        kept.rounding[i + 3] = to->attitude[i] - (sum - sum_b) + (step - sum_b);
        to->attitude[i] = sum;
    }
    bench8_status status = bench8_check_motion(to, to->phi_dot, BENCH8_MAX_SPEED);
    if (status != BENCH8_OK) { return status; }
    *carry = kept;
    return BENCH8_OK;
}

/* Time derivatives of the state under drive torques. */
BENCH8_CODE static bench8_status bench8_rate(
    const bench8_table *table, const bench8_state *x, const bench8_real tau[BENCH8_N],
    const int locked[BENCH8_N], bench8_state *restrict rate)
{
    bench8_real C[9];  /* attitude */
    bench8_real sine[BENCH8_N], cosine[BENCH8_N];
    bench8_sincos_each(x->phi, sine, cosine);
    bench8_status status = bench8_solve_coupled(table, x, sine, cosine, tau, locked, rate->V, rate->phi_dot);
    if (status != BENCH8_OK) { return status; }
    bench8_rotation(x->attitude, C);
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
    for (int s = 0; s < BENCH8_N; ++s) { rate->phi[s] = x->phi_dot[s]; }
    return BENCH8_OK;
}

/* Evaluations of one step: the sum of the rates at its stages. A stage without an answer is RANGE. */
BENCH8_CODE static bench8_status bench8_stages(
    const bench8_table *table, const bench8_state *x, const bench8_real tau[BENCH8_N],
    const int locked[BENCH8_N], bench8_real h, int order, bench8_state *restrict y,
    bench8_state *restrict total)
{
    bench8_state k;  /* time derivatives at a stage */
    bench8_status status = bench8_rate(table, x, tau, locked, &k);
    if (status != BENCH8_OK) { return status; }
    const bench8_real half = 0.5 * h;
    if (order == 2) {
        bench8_advance(x, &k, half, y);
        status = bench8_rate(table, y, tau, locked, total);
        if (status != BENCH8_OK) { return BENCH8_RANGE; }
    } else {
        *total = k;
        bench8_advance(x, &k, half, y);
        status = bench8_rate(table, y, tau, locked, &k);
        if (status != BENCH8_OK) { return BENCH8_RANGE; }
        for (int i = 0; i < 3; ++i) { total->position[i] += 2.0 * k.position[i]; }
        for (int i = 0; i < 4; ++i) { total->attitude[i] += 2.0 * k.attitude[i]; }
        for (int i = 0; i < 6; ++i) { total->V[i] += 2.0 * k.V[i]; }
        for (int i = 0; i < BENCH8_N; ++i) { total->phi[i] += 2.0 * k.phi[i]; }
        for (int i = 0; i < BENCH8_N; ++i) { total->phi_dot[i] += 2.0 * k.phi_dot[i]; }
        bench8_advance(x, &k, half, y);
        status = bench8_rate(table, y, tau, locked, &k);
        if (status != BENCH8_OK) { return BENCH8_RANGE; }
        for (int i = 0; i < 3; ++i) { total->position[i] += 2.0 * k.position[i]; }
        for (int i = 0; i < 4; ++i) { total->attitude[i] += 2.0 * k.attitude[i]; }
        for (int i = 0; i < 6; ++i) { total->V[i] += 2.0 * k.V[i]; }
        for (int i = 0; i < BENCH8_N; ++i) { total->phi[i] += 2.0 * k.phi[i]; }
        for (int i = 0; i < BENCH8_N; ++i) { total->phi_dot[i] += 2.0 * k.phi_dot[i]; }
        bench8_advance(x, &k, h, y);
        status = bench8_rate(table, y, tau, locked, &k);
        if (status != BENCH8_OK) { return BENCH8_RANGE; }
        for (int i = 0; i < 3; ++i) { total->position[i] += k.position[i]; }
        for (int i = 0; i < 4; ++i) { total->attitude[i] += k.attitude[i]; }
        for (int i = 0; i < 6; ++i) { total->V[i] += k.V[i]; }
        for (int i = 0; i < BENCH8_N; ++i) { total->phi[i] += k.phi[i]; }
        for (int i = 0; i < BENCH8_N; ++i) { total->phi_dot[i] += k.phi_dot[i]; }
    }
    return BENCH8_OK;
}

BENCH8_CODE bench8_status bench8_step(
    const bench8_table *table, const bench8_state *x, const bench8_real tau[BENCH8_N],
    const int locked[BENCH8_N], bench8_real dt, int order, bench8_step_carry *carry, bench8_state *next)
{
    if (table == NULL || x == NULL || tau == NULL || next == NULL) { return BENCH8_BAD_ARGUMENT; }
    if (locked == NULL) { locked = bench8_none_locked; }
    bench8_status status = bench8_check_motion(x, tau, BENCH8_MAX_WRENCH);
    if (status != BENCH8_OK) { return status; }
    if (!(dt >= -BENCH8_MAX_STEP && dt <= BENCH8_MAX_STEP)) {
        if (dt >= -BENCH8_LARGEST && dt <= BENCH8_LARGEST) { return BENCH8_RANGE; }
        return BENCH8_NOT_FINITE;
    }
    if (!(dt > 0.0)) { return BENCH8_BAD_ARGUMENT; }
    if (!(order == 4 || order == 2)) { return BENCH8_BAD_ARGUMENT; }
    if (carry != NULL) {
        status = bench8_within(carry->rounding, 29, BENCH8_MAX_ROUNDING);
        if (status != BENCH8_OK) { return status; }
    }
    bench8_state y;  /* state of a stage; then the new state */
    bench8_state total;  /* sum of the rates at the stages */
    status = bench8_stages(table, x, tau, locked, dt, order, &y, &total);
    if (status != BENCH8_OK) { return status; }
    const bench8_real over = (order == 2) ? dt : dt / 6.0;  /* times the sum: the increment */
    /* square of the fastest turning, (rad/s)^2 */
    bench8_real fastest = x->V[3] * x->V[3] + x->V[4] * x->V[4] + x->V[5] * x->V[5];
    for (int s = 0; s < BENCH8_N; ++s) {
        const bench8_real square = x->phi_dot[s] * x->phi_dot[s];
        fastest = (square > fastest) ? square : fastest;
    }
    if (carry != NULL) {
        status = bench8_carry_over(x, &total, over, carry, &y);
        if (status != BENCH8_OK) { return BENCH8_RANGE; }
    } else {
        bench8_advance(x, &total, over, &y);
        status = bench8_finish(&y);
        if (status != BENCH8_OK) { return BENCH8_RANGE; }
    }
    *next = y;
    const bench8_real most = (order == 2) ? BENCH8_MAX_TURN_2 : BENCH8_MAX_TURN_4;  /* rad */
    if (dt * dt * fastest > most * most) { return BENCH8_COARSE; }
    return BENCH8_OK;
}

/* Makes the rows of W orthogonal by one-sided Jacobi rotations: the condition is not squared. */
BENCH8_CODE static void bench8_orthogonalise(bench8_inverse_work *restrict work)
{
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) { work->U[i][j] = 0.0; }
        work->U[i][i] = 1.0;
    }
    for (int sweep = 0; sweep < 9; ++sweep) {  /* enough: they converge quadratically */
        for (int p = 0; p < 5; ++p) {
            for (int q = p + 1; q < 6; ++q) {
                bench8_real a = 0.0;
                bench8_real b = 0.0;
                bench8_real g = 0.0;
                for (int j = 0; j < BENCH8_N; ++j) {
                    a += work->W[p][j] * work->W[p][j];
                    b += work->W[q][j] * work->W[q][j];
                    g += work->W[p][j] * work->W[q][j];
                }
                /* tangent of the smaller angle that makes the rows orthogonal */
                const bench8_real size = ((b - a < 0.0) ? -(b - a) : b - a) + 2.0 * ((g < 0.0) ? -g : g);
                /* scaled to size 1, so that no square underflows */
                const bench8_real unit = (size > 0.0) ? size : 1.0;
                const bench8_real d = (b - a) / unit;
                const bench8_real h = 2.0 * g / unit;
                const bench8_real root = bench8_sqrt(d * d + h * h);
                const bench8_real below = (d < 0.0) ? d - root : d + root;
                const bench8_real t = (((below < 0.0) ? -below : below) > 0.0)
                    ? h / ((((below < 0.0) ? -below : below) > 0.0) ? below : 1.0) : 0.0;
                const bench8_real c = 1.0 / bench8_sqrt(1.0 + t * t);
                const bench8_real s = c * t;
                for (int j = 0; j < BENCH8_N; ++j) {
                    const bench8_real x = work->W[p][j];
                    const bench8_real y = work->W[q][j];
                    work->W[p][j] = c * x - s * y;
                    work->W[q][j] = s * x + c * y;
                }
                for (int j = 0; j < 6; ++j) {
                    const bench8_real x = work->U[j][p];
                    const bench8_real y = work->U[j][q];
                    work->U[j][p] = c * x - s * y;  work->U[j][q] = s * x + c * y;
                }
                const bench8_real x = work->r[p];
                const bench8_real y = work->r[q];
                work->r[p] = c * x - s * y;  work->r[q] = s * x + c * y;
            }
        }
    }
    for (int i = 0; i < 6; ++i) {
        bench8_real total = 0.0;
        for (int j = 0; j < BENCH8_N; ++j) { total += work->W[i][j] * work->W[i][j]; }
        work->sigma[i] = bench8_sqrt(total);
    }
}

/* Cholesky factor of the mass matrix, in place: K = G G^T. */
BENCH8_CODE static bench8_status bench8_factor(bench8_inverse_work *restrict work)
{
    for (int j = 0; j < 6; ++j) {
        bench8_real pivot = work->G[j][j];
        for (int k = 0; k < j; ++k) { pivot -= work->G[j][k] * work->G[j][k]; }
        if (!(pivot > 0.0)) { return BENCH8_NOT_POSITIVE_DEFINITE; }
        const bench8_real root = bench8_sqrt(pivot);
        work->G[j][j] = root;
        for (int i = j + 1; i < 6; ++i) {
            bench8_real rest = work->G[i][j];
            for (int k = 0; k < j; ++k) { rest -= work->G[i][k] * work->G[j][k]; }
            work->G[i][j] = rest / root;
        }
    }
    return BENCH8_OK;
}

/* Matrix and right-hand side of (12) at a state: I, b, and both scaled to W, r, (12). */
BENCH8_CODE static bench8_status bench8_demand(
    const bench8_table *table, const bench8_state *x, const bench8_real sine[BENCH8_N],
    const bench8_real cosine[BENCH8_N], const bench8_real V_dot[6], bench8_inverse_work *restrict work)
{
    bench8_real C[9];  /* attitude */
    bench8_rotation(x->attitude, C);
    bench8_real g[3];  /* gravity in E1 */
    bench8_rotate_back(C, table->gravity, g);
    bench8_sums sum;
    bench8_sum_mass(table, sine, cosine, x->phi_dot, &sum);
    bench8_sum_steady_spin(table, sine, cosine, x->phi_dot, &sum);
    bench8_real F[6];  /* wrench (7); then the right-hand side of K V_dot + I phi_ddot = F */
    bench8_external(table, x, &sum, C, g, F);
    bench8_subtract_rates(table, &sum, x->V, F);
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
    /* b = F - K V_dot: the wrench demanded of the flywheels */
    for (int i = 0; i < 6; ++i) {
        const bench8_real demanded = F[i] - work->G[i][0] * V_dot[0] - work->G[i][1] * V_dot[1]
            - work->G[i][2] * V_dot[2] - work->G[i][3] * V_dot[3] - work->G[i][4] * V_dot[4]
            - work->G[i][5] * V_dot[5];
        work->b[i] = demanded;
        work->r[i] = demanded;
    }
    bench8_status status = bench8_factor(work);
    if (status != BENCH8_OK) { return status; }
    for (int s = 0; s < BENCH8_N; ++s) {
        const bench8_row *row = &table->flywheel[s];
        const bench8_real s_phi = sine[s];
        const bench8_real c_phi = cosine[s];
        const bench8_real scale = row->spin_root_inv;
        work->scale[s] = scale;
        work->I_[0][s] = row->mu_s[0] * c_phi - row->mu_c[0] * s_phi;
        work->I_[1][s] = row->mu_s[1] * c_phi - row->mu_c[1] * s_phi;
        work->I_[2][s] = row->mu_s[2] * c_phi - row->mu_c[2] * s_phi;
        work->I_[3][s] = row->t_c[0] * c_phi + row->t_s[0] * s_phi + row->t_0[0];
        work->I_[4][s] = row->t_c[1] * c_phi + row->t_s[1] * s_phi + row->t_0[1];
        work->I_[5][s] = row->t_c[2] * c_phi + row->t_s[2] * s_phi + row->t_0[2];
        for (int i = 0; i < 6; ++i) { work->W[i][s] = work->I_[i][s] * scale; }
    }
    /* W = G^-1 I D^-1, r = G^-1 b: forward substitution */
    for (int i = 0; i < 6; ++i) {
        const bench8_real inverse = 1.0 / work->G[i][i];
        bench8_real rest;
        for (int s = 0; s < BENCH8_N; ++s) {
            rest = work->W[i][s];
            for (int k = 0; k < i; ++k) { rest -= work->G[i][k] * work->W[k][s]; }
            work->W[i][s] = rest * inverse;
        }
        rest = work->r[i];
        for (int k = 0; k < i; ++k) { rest -= work->G[i][k] * work->r[k]; }
        work->r[i] = rest * inverse;
    }
    return BENCH8_OK;
}

/* Shares a demand among the flywheels: least weighted norm; others make up for one at its limit, (12). */
BENCH8_CODE static void bench8_allocate(
    const bench8_inverse_work *work, const bench8_inverse_options *options, int rank,
    bench8_real *restrict phi_ddot /* [BENCH8_N] */, int *restrict limited /* [BENCH8_N] */)
{
    bench8_real share[BENCH8_N];  /* 1/weight */
    bench8_real give[BENCH8_N];  /* 1/weight of a free flywheel, 0 for one held at its limit */
    bench8_real step[BENCH8_N];  /* increment of the free flywheels */
    bench8_real row[6];  /* factor of each row; 0: the row is left out */
    bench8_real gram[6][6], z[6];
    int settled;  /* 1 after a whole step that gains nothing and frees nobody */
    int going = 1;
    int weighted = 1;
    bench8_real square_before = BENCH8_LARGEST;  /* square of the residual after the last whole step */
    /* until the end phi_ddot holds y = D phi_ddot */
    for (int s = 0; s < BENCH8_N; ++s) {
        phi_ddot[s] = 0.0;
        limited[s] = 0;
        share[s] = 1.0 / options->weight[s];
    }
    for (int pass = 0; pass < 52; ++pass) {  /* at most: each flywheel is held and freed again */
        if (going > 0) {
            bench8_real most = 0.0;
            for (int s = 0; s < BENCH8_N; ++s) {
                give[s] = (limited[s] > 0) ? 0.0 : share[s];
                most = (give[s] > most) ? give[s] : most;
            }
            const bench8_real regular = BENCH8_EPS_REGULAR * most;
            const bench8_real least = (most > 0.0) ? regular : 1.0;  /* keeps the diagonal positive */
            for (int i = 0; i < 6; ++i) {
                row[i] = 0.0;
                if (i < rank) { row[i] = 1.0 / ((pass < 1) ? work->sigma[i] : work->sigma[0]); }
            }
            for (int i = 0; i < 6; ++i) {
                bench8_real left = work->r[i];
                for (int s = 0; s < BENCH8_N; ++s) { left -= work->W[i][s] * phi_ddot[s]; }
                z[i] = row[i] * left;
            }
            bench8_real weighed[BENCH8_N];  /* a row of W Omega^-1 */
            for (int i = 0; i < 6; ++i) {
                for (int s = 0; s < BENCH8_N; ++s) { weighed[s] = work->W[i][s] * give[s]; }
                for (int j = 0; j < i + 1; ++j) {
                    bench8_real total = 0.0;
                    for (int s = 0; s < BENCH8_N; ++s) { total += weighed[s] * work->W[j][s]; }
                    gram[i][j] = row[i] * row[j] * total;
                }
                gram[i][i] += least;
            }
            for (int j = 0; j < 6; ++j) {
                bench8_real pivot = gram[j][j];
                bench8_real rest = z[j];
                for (int k = 0; k < j; ++k) {
                    pivot -= gram[j][k] * gram[k][j];
                    rest -= gram[k][j] * z[k];
                }
                z[j] = rest;
                pivot = (pivot > least) ? pivot : least;
                gram[j][j] = pivot;
                for (int i = j + 1; i < 6; ++i) {
                    bench8_real below = gram[i][j];
                    for (int k = 0; k < j; ++k) { below -= gram[i][k] * gram[k][j]; }
                    gram[i][j] = below;
                    gram[j][i] = below / pivot;
                }
            }
            for (int t = 0; t < 6; ++t) {
                const int i = 5 - t;
                bench8_real rest = z[i] / gram[i][i];
                for (int k = i + 1; k < 6; ++k) { rest -= gram[i][k] * z[k]; }
                z[i] = rest;
            }
            for (int i = 0; i < 6; ++i) { z[i] = row[i] * z[i]; }
            for (int s = 0; s < BENCH8_N; ++s) {
                bench8_real total = 0.0;
                for (int i = 0; i < 6; ++i) { total += work->W[i][s] * z[i]; }
                step[s] = give[s] * total;
            }
            settled = 0;
            if (pass < 1) {
                for (int s = 0; s < BENCH8_N; ++s) {
                    phi_ddot[s] = step[s];
                    if (((step[s] < 0.0) ? -step[s] : step[s]) * work->scale[s] > options->limit[s]) {
                        const bench8_real bound = options->limit[s] / work->scale[s];
                        phi_ddot[s] = (step[s] < 0.0) ? -bound : bound;
                        limited[s] = 1;
                    }
                }
            } else {
                /* go as far as all limits allow; hold the flywheel that reaches its limit */
                bench8_real length = 1.0;
                int stopped = -1;
                for (int s = 0; s < BENCH8_N; ++s) {
                    const bench8_real moved = (phi_ddot[s] + step[s]) * work->scale[s];
                    if (limited[s] == 0 && ((moved < 0.0) ? -moved : moved) > options->limit[s]
                        && ((step[s] < 0.0) ? -step[s] : step[s]) > 0.0) {
                        const bench8_real room = options->limit[s] / work->scale[s]
                            - ((moved < 0.0) ? -phi_ddot[s] : phi_ddot[s]);
                        const bench8_real part = room / ((step[s] < 0.0) ? -step[s] : step[s]);
                        if (part < length) {
                            length = (part > 0.0) ? part : 0.0;
                            stopped = s;
                        }
                    }
                }
                for (int s = 0; s < BENCH8_N; ++s) {
                    phi_ddot[s] += length * step[s];
                    if (stopped == s) {
                        const bench8_real bound = options->limit[s] / work->scale[s];
                        phi_ddot[s] = (step[s] < 0.0) ? -bound : bound;
                        limited[s] = 1;
                    }
                }
                /* after a full step, release the held flywheel that would lower the residual most */
                if (stopped < 0) {
                    bench8_real left[6];
                    bench8_real wanted = 0.0;
                    bench8_real square = 0.0;  /* of the residual */
                    for (int i = 0; i < 6; ++i) {
                        wanted += work->r[i] * work->r[i];
                        left[i] = (i < rank) ? work->r[i] : 0.0;
                        if (i < rank) {
                            for (int s = 0; s < BENCH8_N; ++s) { left[i] -= work->W[i][s] * phi_ddot[s]; }
                        }
                        square += left[i] * left[i];
                    }
                    bench8_real best = BENCH8_EPS_REACHED2 * wanted;  /* smaller gains are ignored */
                    int freed = -1;
                    for (int s = 0; s < BENCH8_N; ++s) {
                        if (limited[s] > 0) {
                            bench8_real slope = 0.0;
                            bench8_real size = 0.0;
                            for (int i = 0; i < 6; ++i) {
                                slope += work->W[i][s] * left[i];
                                size += work->W[i][s] * work->W[i][s];
                            }
                            const bench8_real inward = (phi_ddot[s] > 0.0) ? -slope : slope;
                            if (inward > 0.0 && inward * inward > best * size) {
                                best = inward * inward / size;
                                freed = s;
                            }
                        }
                    }
                    if (freed >= 0) {
                        limited[freed] = 0;
                    } else if (!(square > best && square < square_before * BENCH8_SETTLED)) { settled = 1; }
                    square_before = square;
                }
            }
            /* the weights are left out when each flywheel may have been held, or after half of all passes */
            if (pass >= 10 && (settled > 0 || pass == 26)) {
                going = weighted;
                weighted = 0;
                for (int s = 0; s < BENCH8_N; ++s) { share[s] = 1.0; }
            }
        }
    }
    /* rounding may take an answer that just reaches its limit beyond it; what overflows is refused later */
    for (int s = 0; s < BENCH8_N; ++s) {
        const bench8_real answer = phi_ddot[s] * work->scale[s];
        phi_ddot[s] = answer;
        if (limited[s] > 0 || (((answer < 0.0) ? -answer : answer) > options->limit[s]
            && ((answer < 0.0) ? -answer : answer) <= BENCH8_LARGEST)) {
            phi_ddot[s] = (answer < 0.0) ? -options->limit[s] : options->limit[s];
        }
    }
}

/* Does a motor lack the torque tau, with its friction, at this speed? Its no-load speed is above 0. */
BENCH8_CODE static int bench8_motor_lacks(
    const bench8_inverse_options *options, int number, bench8_real tau, bench8_real speed)
{
    /* of the motor itself, which bears the friction */
    bench8_real needed = tau + options->motor_viscous[number] * speed;
    if (options->motor_coulomb[number] > 0.0 && options->motor_coulomb_speed[number] > 0.0) {
        const bench8_real ratio = speed / options->motor_coulomb_speed[number];
        const bench8_real y = (ratio > 3.0) ? 3.0 : ((ratio < -3.0) ? -3.0 : ratio);  /* tanh y to 0.024 */
        const bench8_real square = y * y;
        needed += options->motor_coulomb[number] * (y * (27.0 + square) / (27.0 + 9.0 * square));
    }
    /* driving, the torque falls linearly to zero at the no-load speed; braking has all of it */
    bench8_real share = 1.0;
    if (needed * speed > 0.0) {
        share = 1.0 - ((speed < 0.0) ? -speed : speed) / options->motor_speed[number];
    }
    return (share <= 0.0 || ((needed < 0.0) ? -needed : needed) > options->motor_torque[number] * share) ? 1
        : 0;
}

/* Does a motion need more than a motor's torque or speed, or a larger phi_ddot than `most`? */
BENCH8_CODE static void bench8_excessive(
    const bench8_table *table, const bench8_state *x, const bench8_real sine[BENCH8_N],
    const bench8_real cosine[BENCH8_N], const bench8_real V_dot[6], const bench8_real phi_ddot[BENCH8_N],
    const bench8_inverse_options *options, int *restrict flags)
{
    int motors = 0;  /* flywheels whose motor has a limit */
    int excess = 0;
    for (int s = 0; s < BENCH8_N; ++s) {
        if (((phi_ddot[s] < 0.0) ? -phi_ddot[s] : phi_ddot[s]) > options->most[s]) {
            excess = BENCH8_EXCESSIVE;
        }
        if (options->motor_torque[s] < BENCH8_LARGEST || options->motor_speed[s] < BENCH8_LARGEST) {
            motors = motors + 1;
        }
    }
    if (motors > 0) {
        bench8_real tau[BENCH8_N];  /* drive torques */
        bench8_balance(table, x, sine, cosine, V_dot, phi_ddot, tau);
        for (int s = 0; s < BENCH8_N; ++s) {
            if (bench8_motor_lacks(options, s, tau[s], x->phi_dot[s]) != 0) { excess = BENCH8_EXCESSIVE; }
        }
    }
    *flags = excess;
}

BENCH8_CODE bench8_status bench8_inverse(
    const bench8_table *table, const bench8_state *x, const bench8_real V_dot[6],
    const bench8_inverse_options *options, bench8_inverse_result *out)
{
    if (table == NULL || x == NULL || V_dot == NULL || options == NULL
        || out == NULL) { return BENCH8_BAD_ARGUMENT; }
    bench8_status status = bench8_check_state(x);
    if (status != BENCH8_OK) { return status; }
    status = bench8_within(V_dot, 6, BENCH8_MAX_ACCELERATION);
    if (status != BENCH8_OK) { return status; }
    status = bench8_within(options->weight, BENCH8_N, BENCH8_MAX_WEIGHT);
    if (status != BENCH8_OK) { return status; }
    bench8_real shares[2];
    shares[0] = options->near_singular;
    shares[1] = options->damping;
    status = bench8_within(shares, 2, BENCH8_LARGEST);
    if (status != BENCH8_OK) { return status; }
    if (!(shares[0] >= 0.0 && shares[0] <= 1.0)) { return BENCH8_BAD_ARGUMENT; }
    if (!(shares[1] >= 0.0 && shares[1] <= 1.0)) { return BENCH8_BAD_ARGUMENT; }
    for (int s = 0; s < BENCH8_N; ++s) {
        if (!(options->weight[s] >= BENCH8_MIN_WEIGHT)) { return BENCH8_RANGE; }
    }
    for (int s = 0; s < BENCH8_N; ++s) {
        if (!(options->limit[s] > 0.0 || options->limit[s] <= 0.0)) { return BENCH8_NOT_FINITE; }
        if (options->limit[s] <= 0.0) { return BENCH8_BAD_ARGUMENT; }
        if (!(options->most[s] > 0.0 || options->most[s] <= 0.0)) { return BENCH8_NOT_FINITE; }
        if (!(options->motor_torque[s] > 0.0
            || options->motor_torque[s] <= 0.0)) { return BENCH8_NOT_FINITE; }
        if (!(options->motor_speed[s] > 0.0 || options->motor_speed[s] <= 0.0)) { return BENCH8_NOT_FINITE; }
        if (options->most[s] <= 0.0 || options->motor_torque[s] < 0.0
            || options->motor_speed[s] <= 0.0) { return BENCH8_BAD_ARGUMENT; }
        if (!(options->motor_viscous[s] > 0.0
            || options->motor_viscous[s] <= 0.0)) { return BENCH8_NOT_FINITE; }
        if (!(options->motor_coulomb[s] > 0.0
            || options->motor_coulomb[s] <= 0.0)) { return BENCH8_NOT_FINITE; }
        if (!(options->motor_coulomb_speed[s] > 0.0
            || options->motor_coulomb_speed[s] <= 0.0)) { return BENCH8_NOT_FINITE; }
        if (options->motor_viscous[s] < 0.0 || options->motor_coulomb[s] < 0.0
            || options->motor_coulomb_speed[s] <= 0.0) { return BENCH8_BAD_ARGUMENT; }
    }
    bench8_inverse_work work;
    bench8_real answer[BENCH8_N];  /* phi_ddot */
    int limited[BENCH8_N];
    bench8_real residual[6], sine[BENCH8_N], cosine[BENCH8_N];
    bench8_sincos_each(x->phi, sine, cosine);
    status = bench8_demand(table, x, sine, cosine, V_dot, &work);
    if (status != BENCH8_OK) { return status; }
    bench8_real wanted = 0.0;
    for (int i = 0; i < 6; ++i) { wanted += work.r[i] * work.r[i]; }
    bench8_orthogonalise(&work);
    /* sort the singular values in descending order, by exchanging neighbours */
    for (int pass = 0; pass < 5; ++pass) {
        for (int i = 0; i < 5; ++i) {
            if (work.sigma[i] < work.sigma[i + 1]) {
                const bench8_real kept_sigma = work.sigma[i];
                work.sigma[i] = work.sigma[i + 1];  work.sigma[i + 1] = kept_sigma;
                const bench8_real kept_r = work.r[i];
                work.r[i] = work.r[i + 1];  work.r[i + 1] = kept_r;
                for (int j = 0; j < BENCH8_N; ++j) {
                    const bench8_real kept = work.W[i][j];
                    work.W[i][j] = work.W[i + 1][j];
                    work.W[i + 1][j] = kept;
                }
                for (int j = 0; j < 6; ++j) {
                    const bench8_real kept = work.U[j][i];
                    work.U[j][i] = work.U[j][i + 1];  work.U[j][i + 1] = kept;
                }
            }
        }
    }
    int flags = 0;
    int rank = 0;
    bench8_real damping = 0.0;
    for (int i = 0; i < 6; ++i) {
        if (work.sigma[i] > BENCH8_EPS_RANK * work.sigma[0]) {
            rank = rank + 1;
            const bench8_real ratio = work.sigma[i] / work.sigma[0];
            if (ratio < options->near_singular) {
                flags = flags | BENCH8_NEAR_SINGULAR;
                if (options->damping > 0.0) {
                    flags = flags | BENCH8_DAMPED;
                    const bench8_real lambda = options->damping * work.sigma[0]
                        * (1.0 - ratio / options->near_singular);
                    const bench8_real square = work.sigma[i] * work.sigma[i];
                    work.r[i] = work.r[i] * (square / (square + lambda * lambda));
                    damping = (lambda > damping) ? lambda : damping;
                }
            }
        }
    }
    bench8_allocate(&work, options, rank, answer, limited);
    for (int s = 0; s < BENCH8_N; ++s) {
        if (limited[s] > 0) { flags = flags | BENCH8_LIMITED; }
    }
    if (rank < 6) { flags = flags | BENCH8_RANK_DEFICIENT; }
    bench8_real moved[6];  /* V_dot that results: V_dot + K^-1 residual */
    bench8_real z[6];  /* G^-1 residual */
    bench8_real left = 0.0;
    for (int i = 0; i < 6; ++i) {
        residual[i] = work.b[i];
        for (int s = 0; s < BENCH8_N; ++s) { residual[i] -= work.I_[i][s] * answer[s]; }
    }
    for (int i = 0; i < 6; ++i) {
        z[i] = residual[i];
        for (int k = 0; k < i; ++k) { z[i] -= work.G[i][k] * z[k]; }
        z[i] = z[i] / work.G[i][i];
        left += z[i] * z[i];
    }
    if (left > BENCH8_EPS_REACHED2 * wanted) { flags = flags | BENCH8_UNREACHABLE; }
    for (int t = 0; t < 6; ++t) {
        const int i = 5 - t;
        for (int k = i + 1; k < 6; ++k) { z[i] -= work.G[k][i] * z[k]; }
        z[i] = z[i] / work.G[i][i];
        moved[i] = V_dot[i] + z[i];
    }
    status = bench8_within(answer, BENCH8_N, BENCH8_LARGEST);
    if (status != BENCH8_OK) { return BENCH8_RANGE; }
    status = bench8_within(residual, 6, BENCH8_LARGEST);
    if (status != BENCH8_OK) { return BENCH8_RANGE; }
    int lacking;
    bench8_excessive(table, x, sine, cosine, moved, answer, options, &lacking);
    flags = flags | lacking;
    for (int s = 0; s < BENCH8_N; ++s) {
        out->phi_ddot[s] = answer[s];
        out->limited[s] = limited[s];
    }
    for (int i = 0; i < 6; ++i) { out->residual[i] = residual[i]; }
    /* unreachable: the demand's part in the rows left out; if no row is left out, the last row */
    bench8_real part[6];
    for (int i = 0; i < 6; ++i) { part[i] = (i < rank) ? 0.0 : work.r[i]; }
    bench8_real largest = 0.0;
    for (int i = 0; i < 6; ++i) {
        const bench8_real size = (part[i] < 0.0) ? -part[i] : part[i];
        largest = (size > largest) ? size : largest;
    }
    if (!(largest > 0.0)) {
        part[5] = 1.0;
        largest = 1.0;
    }
    bench8_real square = 0.0;
    for (int i = 0; i < 6; ++i) {
        part[i] = part[i] / largest;
        square += part[i] * part[i];
    }
    const bench8_real length = bench8_sqrt(square);
    bench8_real u[6];  /* U part: a unit vector in the norm of K^-1; its wrench is G u */
    for (int k = 0; k < 6; ++k) {
        u[k] = 0.0;
        for (int i = 0; i < 6; ++i) { u[k] += work.U[k][i] * part[i]; }
        u[k] = u[k] / length;
    }
    for (int i = 0; i < 6; ++i) {
        out->hardest[i] = 0.0;
        for (int k = 0; k < i + 1; ++k) { out->hardest[i] += work.G[i][k] * u[k]; }
    }
    out->rank = rank;
    out->damped_by = damping;
    for (int i = 0; i < 6; ++i) { out->sigma[i] = work.sigma[i]; }
    return (bench8_status)flags;
}

BENCH8_CODE bench8_status bench8_inverse_fast(
    const bench8_table *table, const bench8_state *x, const bench8_real V_dot[6],
    const bench8_inverse_options *options, bench8_real phi_ddot[BENCH8_N])
{
    if (table == NULL || x == NULL || V_dot == NULL || options == NULL
        || phi_ddot == NULL) { return BENCH8_BAD_ARGUMENT; }
    bench8_status status = bench8_check_state(x);
    if (status != BENCH8_OK) { return status; }
    status = bench8_within(V_dot, 6, BENCH8_MAX_ACCELERATION);
    if (status != BENCH8_OK) { return status; }
    status = bench8_within(options->weight, BENCH8_N, BENCH8_MAX_WEIGHT);
    if (status != BENCH8_OK) { return status; }
    bench8_real shares[1];
    shares[0] = options->damping;
    status = bench8_within(shares, 1, BENCH8_LARGEST);
    if (status != BENCH8_OK) { return status; }
    if (!(shares[0] >= 0.0 && shares[0] <= 1.0)) { return BENCH8_BAD_ARGUMENT; }
    for (int s = 0; s < BENCH8_N; ++s) {
        if (!(options->weight[s] >= BENCH8_MIN_WEIGHT)) { return BENCH8_RANGE; }
    }
    bench8_inverse_work work;
    bench8_real sine[BENCH8_N], cosine[BENCH8_N];
    bench8_sincos_each(x->phi, sine, cosine);
    status = bench8_demand(table, x, sine, cosine, V_dot, &work);
    if (status != BENCH8_OK) { return status; }
    bench8_real answer[BENCH8_N];
    /* normal equations: W Omega^-1 W^T z = r, y = Omega^-1 W^T z; `I` now holds W Omega^-1 */
    for (int s = 0; s < BENCH8_N; ++s) {
        const bench8_real give = 1.0 / options->weight[s];
        for (int i = 0; i < 6; ++i) { work.I_[i][s] = work.W[i][s] * give; }
    }
    bench8_real gram[6][6], z[6];
    bench8_real trace = 0.0;
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < i + 1; ++j) {
            bench8_real total = 0.0;
            for (int s = 0; s < BENCH8_N; ++s) { total += work.I_[i][s] * work.W[j][s]; }
            gram[i][j] = total;
        }
        trace += gram[i][i];
        z[i] = work.r[i];
    }
    const bench8_real lambda2 = options->damping * options->damping * trace;  /* square of the damping */
    for (int i = 0; i < 6; ++i) { gram[i][i] += lambda2; }
    for (int j = 0; j < 6; ++j) {
        bench8_real pivot = gram[j][j];
        const bench8_real least = BENCH8_EPS_PIVOT * pivot;  /* a pivot below this is rounding error */
        bench8_real rest = z[j];
        for (int k = 0; k < j; ++k) {
            pivot -= gram[j][k] * gram[k][j];
            rest -= gram[k][j] * z[k];
        }
        z[j] = rest;
        if (!(pivot > least)) { return BENCH8_NOT_POSITIVE_DEFINITE; }
        gram[j][j] = pivot;
        for (int i = j + 1; i < 6; ++i) {
            bench8_real below = gram[i][j];
            for (int k = 0; k < j; ++k) { below -= gram[i][k] * gram[k][j]; }
            gram[i][j] = below;
            gram[j][i] = below / pivot;
        }
    }
    for (int t = 0; t < 6; ++t) {
        const int i = 5 - t;
        bench8_real rest = z[i] / gram[i][i];
        for (int k = i + 1; k < 6; ++k) { rest -= gram[i][k] * z[k]; }
        z[i] = rest;
    }
    for (int s = 0; s < BENCH8_N; ++s) {
        bench8_real y = 0.0;
        for (int i = 0; i < 6; ++i) { y += work.I_[i][s] * z[i]; }
        answer[s] = y * work.scale[s];
    }
    status = bench8_within(answer, BENCH8_N, BENCH8_LARGEST);
    if (status != BENCH8_OK) { return BENCH8_RANGE; }
    int flags = 0;
    for (int s = 0; s < BENCH8_N; ++s) {
        if (flags == 0 && options->motor_speed[s] > 0.0) {
            const bench8_real v = x->phi_dot[s];
            const bench8_real spin = table->flywheel[s].spin;
            const bench8_real size = (answer[s] < 0.0) ? -answer[s] : answer[s];
            /* at most */
            const bench8_real needed = spin * size + options->motor_viscous[s] * ((v < 0.0) ? -v : v)
                + options->motor_coulomb[s];
            /* at least: when driving */
            const bench8_real available = options->motor_torque[s]
                * (1.0 - ((v < 0.0) ? -v : v) / options->motor_speed[s]);
            if (!(size <= options->most[s] && needed <= available)
                && (size > options->most[s] || bench8_motor_lacks(options, s, spin * answer[s], v) != 0)) {
                flags = BENCH8_EXCESSIVE;
            }
        }
    }
    for (int s = 0; s < BENCH8_N; ++s) { phi_ddot[s] = answer[s]; }
    return (bench8_status)flags;
}

/* Rotation matrix whose first axis is along `axis`, the second along the part of `zero` across it. */
BENCH8_CODE static bench8_status bench8_frame_of_axes(
    const bench8_real axis[3], const bench8_real zero[3], bench8_real *restrict R /* [9] */)
{
    bench8_status status;
    if (!(axis[0] * axis[0] + axis[1] * axis[1]
        + axis[2] * axis[2] < BENCH8_MAX_PARAMETER * BENCH8_MAX_PARAMETER)) {
        status = bench8_within(axis, 3, BENCH8_MAX_PARAMETER);
        if (status != BENCH8_OK) { return status; }
    }
    if (!(zero[0] * zero[0] + zero[1] * zero[1]
        + zero[2] * zero[2] < BENCH8_MAX_PARAMETER * BENCH8_MAX_PARAMETER)) {
        status = bench8_within(zero, 3, BENCH8_MAX_PARAMETER);
        if (status != BENCH8_OK) { return status; }
    }
    bench8_real e1[3], e2[3];
    const bench8_real axis2 = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
    if (!(axis2 > BENCH8_EPS_SQUARE)) { return BENCH8_RANGE; }
    const bench8_real axis2_root = 1.0 / bench8_sqrt(axis2);
    e1[0] = axis[0] * axis2_root;  e1[1] = axis[1] * axis2_root;  e1[2] = axis[2] * axis2_root;
    const bench8_real zero2 = zero[0] * zero[0] + zero[1] * zero[1] + zero[2] * zero[2];
    if (!(zero2 > BENCH8_EPS_SQUARE)) { return BENCH8_RANGE; }
    /* of zero along the axis */
    const bench8_real along = e1[0] * zero[0] + e1[1] * zero[1] + e1[2] * zero[2];
    bench8_real across[3];
    across[0] = zero[0] - along * e1[0];
    across[1] = zero[1] - along * e1[1];
    across[2] = zero[2] - along * e1[2];
    const bench8_real across2 = across[0] * across[0] + across[1] * across[1] + across[2] * across[2];
    if (!(across2 > BENCH8_EPS_PARALLEL2 * zero2)) { return BENCH8_RANGE; }
    const bench8_real across2_root = 1.0 / bench8_sqrt(across2);
    e2[0] = across[0] * across2_root;  e2[1] = across[1] * across2_root;  e2[2] = across[2] * across2_root;
    R[0] = e1[0];  R[1] = e2[0];
    R[2] = e1[1] * e2[2] - e1[2] * e2[1];
    R[3] = e1[1];  R[4] = e2[1];
    R[5] = e1[2] * e2[0] - e1[0] * e2[2];
    R[6] = e1[2];  R[7] = e2[2];
    R[8] = e1[0] * e2[1] - e1[1] * e2[0];
    return BENCH8_OK;
}

/* Carries one harmonic of a spatial inertia from a body's frame to E1 about O1, (2). */
BENCH8_CODE static void bench8_carry(
    bench8_real m, const bench8_real b[3], const bench8_real J[6], const bench8_real O[3],
    const bench8_real R[9], bench8_real *restrict mu /* [3] */, bench8_real *restrict J1 /* [6] */,
    int spins, bench8_real *restrict t /* [3] */)
{
    bench8_real b1[3];  /* R b */
    bench8_real RJ[9];  /* R J */
    bench8_real Jr[6];  /* R J R^T */
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

/* Can a body have this inertia? Its second moments about the centre of mass are positive semidefinite. */
BENCH8_CODE static bench8_status bench8_check_inertia(
    bench8_real mass, const bench8_real c[3], const bench8_real J[6])
{
    bench8_real size = 0.0;  /* largest element of J */
    for (int k = 0; k < 6; ++k) {
        size = (((J[k] < 0.0) ? -J[k] : J[k]) > size) ? ((J[k] < 0.0) ? -J[k] : J[k]) : size;
    }
    const bench8_real b1 = mass * c[0];
    const bench8_real b2 = mass * c[1];
    const bench8_real b3 = mass * c[2];
    /* P = tr(J)/2 E - J - m c c^T + t |J| E */
    bench8_real P[6];
    P[0] = 0.5 * (J[1] + J[2] - J[0]) - b1 * c[0] + BENCH8_EPS_INERTIA * size;
    P[1] = 0.5 * (J[2] + J[0] - J[1]) - b2 * c[1] + BENCH8_EPS_INERTIA * size;
    P[2] = 0.5 * (J[0] + J[1] - J[2]) - b3 * c[2] + BENCH8_EPS_INERTIA * size;
    P[3] = -J[3] - b1 * c[1];  P[4] = -J[4] - b1 * c[2];  P[5] = -J[5] - b2 * c[2];
    /* a point mass at the origin has no inertia, nor has a body so small that its tolerance underflows */
    if (size + (((b1 * c[0] < 0.0) ? -(b1 * c[0]) : b1 * c[0])
        + ((b2 * c[1] < 0.0) ? -(b2 * c[1]) : b2 * c[1]) + ((b3 * c[2] < 0.0) ? -(b3 * c[2]) : b3 * c[2]))
        > 2.225073858507201e-299) {
        if (!(P[0] >= BENCH8_SMALLEST)) { return BENCH8_NOT_POSITIVE_DEFINITE; }
        const bench8_real r1 = 1.0 / P[0];
        const bench8_real l21 = P[3] * r1;
        const bench8_real l31 = P[4] * r1;
        const bench8_real d2 = P[1] - l21 * P[3];
        if (!(d2 >= BENCH8_SMALLEST)) { return BENCH8_NOT_POSITIVE_DEFINITE; }
        const bench8_real r2 = 1.0 / d2;
        const bench8_real p32 = P[5] - l31 * P[3];
        const bench8_real l32 = p32 * r2;
        const bench8_real d3 = P[2] - l31 * P[4] - l32 * p32;
        if (!(d3 >= BENCH8_SMALLEST)) { return BENCH8_NOT_POSITIVE_DEFINITE; }
    }
    return BENCH8_OK;
}

/* Are the mass properties finite and physically possible? */
BENCH8_CODE static bench8_status bench8_check_body(const bench8_body *body)
{
    bench8_real masses[1];
    masses[0] = body->mass;
    bench8_status status = bench8_within(masses, 1, BENCH8_MAX_PARAMETER);
    if (status != BENCH8_OK) { return status; }
    status = bench8_within(body->center_of_mass, 3, BENCH8_MAX_PARAMETER);
    if (status != BENCH8_OK) { return status; }
    status = bench8_within(body->inertia, 6, BENCH8_MAX_PARAMETER);
    if (status != BENCH8_OK) { return status; }
    if (body->mass < 0.0) { return BENCH8_RANGE; }
    return bench8_check_inertia(body->mass, body->center_of_mass, body->inertia);
}

/* Origin and axes (at phi = 0) of a flywheel in E1. */
BENCH8_CODE static bench8_status bench8_place_flywheel(
    const bench8_flywheel *w, bench8_real *restrict O /* [3] */, bench8_real *restrict R /* [9] */)
{
    bench8_status status;
    if (!(w->position[0] * w->position[0] + w->position[1] * w->position[1]
        + w->position[2] * w->position[2] < BENCH8_MAX_PARAMETER * BENCH8_MAX_PARAMETER)) {
        status = bench8_within(w->position, 3, BENCH8_MAX_PARAMETER);
        if (status != BENCH8_OK) { return status; }
    }
    status = bench8_frame_of_axes(w->axis, w->zero, R);
    if (status != BENCH8_OK) { return status; }
    O[0] = w->position[0];  O[1] = w->position[1];  O[2] = w->position[2];
    return BENCH8_OK;
}

/* Are the parameters finite and in range, the axes nonzero, and the bodies physically possible? */
BENCH8_CODE static bench8_status bench8_check_parameters(const bench8_parameters *parameters)
{
    bench8_real O[3], R[9];
    bench8_status status = bench8_check_body(&parameters->carrier);
    if (status != BENCH8_OK) { return status; }
    bench8_real mass = parameters->carrier.mass;
    /* largest moment of inertia in the equations: it must not overflow */
    bench8_real size = parameters->carrier.inertia[0] + parameters->carrier.inertia[1]
        + parameters->carrier.inertia[2];
    for (int s = 0; s < BENCH8_N; ++s) {
        const bench8_flywheel *flywheel = &parameters->flywheel[s];
        status = bench8_check_body(&flywheel->body);
        if (status != BENCH8_OK) { return status; }
        if (!(flywheel->body.inertia[0] >= BENCH8_EPS_MASS)) { return BENCH8_NOT_POSITIVE_DEFINITE; }
        status = bench8_place_flywheel(flywheel, O, R);
        if (status != BENCH8_OK) { return status; }
        mass += flywheel->body.mass;
        size += flywheel->body.inertia[0] + flywheel->body.inertia[1] + flywheel->body.inertia[2]
            + flywheel->body.mass * (O[0] * O[0] + O[1] * O[1] + O[2] * O[2]);
    }
    if (!(mass >= BENCH8_EPS_MASS)) { return BENCH8_NOT_POSITIVE_DEFINITE; }
    if (!(size <= BENCH8_MAX_INERTIA)) { return BENCH8_RANGE; }
    return BENCH8_OK;
}

BENCH8_CODE bench8_status bench8_prepare(const bench8_parameters *parameters, bench8_table *table)
{
    if (parameters == NULL || table == NULL) { return BENCH8_BAD_ARGUMENT; }
    bench8_status status = bench8_check_parameters(parameters);
    if (status != BENCH8_OK) { return status; }
    /* all checks passed: from here on the table is written and nothing can fail */
    bench8_real first_moment[3], inertia[6];
    bench8_real mass = 0.0;
    first_moment[0] = 0.0;  first_moment[1] = 0.0;  first_moment[2] = 0.0;
    inertia[0] = 0.0;  inertia[1] = 0.0;  inertia[2] = 0.0;
    inertia[3] = 0.0;  inertia[4] = 0.0;  inertia[5] = 0.0;
    /* carrier: its frame is E1 */
    bench8_real O[3];  /* origin of a body in E1 */
    bench8_real R[9];  /* axes of a body in E1 */
    bench8_real b[3];  /* first moment in the body's frame */
    bench8_real mu[3], J1[6], t[3];
    O[0] = 0.0;  O[1] = 0.0;  O[2] = 0.0;
    R[0] = 1.0;  R[1] = 0.0;  R[2] = 0.0;
    R[3] = 0.0;  R[4] = 1.0;  R[5] = 0.0;
    R[6] = 0.0;  R[7] = 0.0;  R[8] = 1.0;
    b[0] = parameters->carrier.mass * parameters->carrier.center_of_mass[0];
    b[1] = parameters->carrier.mass * parameters->carrier.center_of_mass[1];
    b[2] = parameters->carrier.mass * parameters->carrier.center_of_mass[2];
    bench8_carry(parameters->carrier.mass, b, parameters->carrier.inertia, O, R, mu, J1, 0, t);
    mass += parameters->carrier.mass;
    first_moment[0] += mu[0];  first_moment[1] += mu[1];  first_moment[2] += mu[2];
    inertia[0] += J1[0];  inertia[1] += J1[1];  inertia[2] += J1[2];
    inertia[3] += J1[3];  inertia[4] += J1[4];  inertia[5] += J1[5];
    /* flywheels: constant part to the totals, harmonics to the row */
    for (int s = 0; s < BENCH8_N; ++s) {
        const bench8_flywheel *flywheel = &parameters->flywheel[s];
        bench8_row *row = &table->flywheel[s];
        (void)bench8_place_flywheel(flywheel, O, R);
        b[0] = flywheel->body.mass * flywheel->body.center_of_mass[0];
        b[1] = flywheel->body.mass * flywheel->body.center_of_mass[1];
        b[2] = flywheel->body.mass * flywheel->body.center_of_mass[2];
        bench8_real bh[3];  /* first moment of one harmonic, in mounting axes */
        bench8_real Jh[6];  /* its inertia */
        /* harmonic 0 of Theta(phi) */
        bh[0] = b[0];  bh[1] = 0.0;   bh[2] = 0.0;
        Jh[0] = flywheel->body.inertia[0];
        Jh[1] = 0.5 * (flywheel->body.inertia[1] + flywheel->body.inertia[2]);
        Jh[2] = 0.5 * (flywheel->body.inertia[1] + flywheel->body.inertia[2]);
        Jh[3] = 0.0;  Jh[4] = 0.0;  Jh[5] = 0.0;
        bench8_carry(flywheel->body.mass, bh, Jh, O, R, mu, J1, 1, row->t_0);
        mass += flywheel->body.mass;
        first_moment[0] += mu[0];  first_moment[1] += mu[1];  first_moment[2] += mu[2];
        inertia[0] += J1[0];  inertia[1] += J1[1];  inertia[2] += J1[2];
        inertia[3] += J1[3];  inertia[4] += J1[4];  inertia[5] += J1[5];
        /* harmonic c of Theta(phi) */
        bh[0] = 0.0;   bh[1] = b[1];  bh[2] = b[2];
        Jh[0] = 0.0;                        Jh[1] = 0.0;
        Jh[2] = 0.0;                        Jh[3] = flywheel->body.inertia[3];
        Jh[4] = flywheel->body.inertia[4];  Jh[5] = 0.0;
        bench8_carry(0.0, bh, Jh, O, R, row->mu_c, row->J_c, 1, row->t_c);
        /* harmonic s of Theta(phi) */
        bh[0] = 0.0;    bh[1] = -b[2];  bh[2] = b[1];
        Jh[0] = 0.0;  Jh[1] = 0.0;  Jh[2] = 0.0;
        Jh[3] = -flywheel->body.inertia[4];
        Jh[4] = flywheel->body.inertia[3];  Jh[5] = 0.0;
        bench8_carry(0.0, bh, Jh, O, R, row->mu_s, row->J_s, 1, row->t_s);
        /* harmonic 2c of Theta(phi) */
        bh[0] = 0.0;  bh[1] = 0.0;  bh[2] = 0.0;
        Jh[0] = 0.0;
        Jh[1] = 0.5 * (flywheel->body.inertia[1] - flywheel->body.inertia[2]);
        Jh[2] = 0.5 * (flywheel->body.inertia[2] - flywheel->body.inertia[1]);
        Jh[3] = 0.0;                        Jh[4] = 0.0;
        Jh[5] = flywheel->body.inertia[5];
        bench8_carry(0.0, bh, Jh, O, R, mu, row->J_2c, 0, t);
        /* harmonic 2s of Theta(phi) */
        bh[0] = 0.0;  bh[1] = 0.0;  bh[2] = 0.0;
        Jh[0] = 0.0;
        Jh[1] = -flywheel->body.inertia[5];
        Jh[2] = flywheel->body.inertia[5];  Jh[3] = 0.0;
        Jh[4] = 0.0;
        Jh[5] = 0.5 * (flywheel->body.inertia[1] - flywheel->body.inertia[2]);
        bench8_carry(0.0, bh, Jh, O, R, mu, row->J_2s, 0, t);
        row->spin = flywheel->body.inertia[0];
        row->spin_inv = 1.0 / flywheel->body.inertia[0];
        row->spin_root_inv = 1.0 / bench8_sqrt(flywheel->body.inertia[0]);
    }
    table->mass = mass;
    table->mass_inverse = 1.0 / mass;
    table->first_moment[0] = first_moment[0];
    table->first_moment[1] = first_moment[1];
    table->first_moment[2] = first_moment[2];
    table->inertia[0] = inertia[0];  table->inertia[1] = inertia[1];  table->inertia[2] = inertia[2];
    table->inertia[3] = inertia[3];  table->inertia[4] = inertia[4];  table->inertia[5] = inertia[5];
    return BENCH8_OK;
}

/* ---- tables ---- */

BENCH8_CONST const bench8_parameters bench8_default_parameters = {
    .carrier = {
        .mass = 12.0,
        .center_of_mass = { 0.004, -0.003, 0.006 },
        .inertia = { 0.25, 0.31, 0.42, 0.004, -0.002, 0.003 },
    },
    .flywheel = {
        {  /* w1 */
            .body = {
                .mass = 0.8,
                .center_of_mass = { 0.0005, 0.006, -0.0008 },
                .inertia = { 0.001179312, 0.000780712, 0.000769, -3.24e-5, 3.2e-7, 1.184e-5 },
            },
            .position = { 0.0, 0.2, 0.06 },
            .axis = { 1.0, 0.0, -0.0 },
            .zero = { 0.0, 1.0, 0.0 },
        },
        {  /* w2 */
            .body = {
                .mass = 0.78,
                .center_of_mass = { -0.0005, 0.0056, 0.0 },
                .inertia = { 0.0011744608, 0.0008001950000000001, 0.0007546558, -1.7816e-5, 0.0, 8.0e-6 },
            },
            .position = { 0.0, -0.2, 0.06 },
            .axis = { -0.9889363528682537, 0.14834045293053713, -0.0 },
            .zero = { -0.14834045293053713, -0.9889363528682537, 0.0 },
        },
        {  /* w3 */
            .body = {
                .mass = 0.83,
                .center_of_mass = { 0.0005, 0.0063, 0.0008 },
                .inertia = { 0.0011834739, 0.0008207386999999999, 0.0007531502, -1.2614500000000001e-5,
                    -3.32e-7, 3.8168e-6 },
            },
            .position = { 0.2, 0.0, -0.06 },
            .axis = { -1.0341155355510722e-13, 1.0, -0.0 },
            .zero = { -1.0, -1.0341155355510722e-13, 0.0 },
        },
        {  /* w4 */
            .body = {
                .mass = 0.8,
                .center_of_mass = { -0.0005, 0.0058, -0.0008 },
                .inertia = { 0.001177424, 0.0008407120000000001, 0.000737112, 2.3200000000000002e-6, -3.2e-7,
                    1.1711999999999999e-5 },
            },
            .position = { -0.2, 0.0, -0.06 },
            .axis = { 0.09950371902073478, -0.9950371902100156, -0.0 },
            .zero = { 0.9950371902100156, 0.09950371902073478, 0.0 },
        },
        {  /* w5 */
            .body = {
                .mass = 0.76,
                .center_of_mass = { 0.0005, 0.0061, 0.0 },
                .inertia = { 0.0011782796, 0.0008601899999999999, 0.0007284695999999999, 7.682e-6, 0.0,
                    8.0e-6 },
            },
            .position = { 0.16, 0.16, 0.0 },
            .axis = { -1.0341155355510722e-13, -0.0, 1.0 },
            .zero = { -0.0, 1.0, -0.0 },
        },
        {  /* w6 */
            .body = {
                .mass = 0.81,
                .center_of_mass = { -0.0005, 0.0064, 0.0008 },
                .inertia = { 0.0011836960000000001, 0.0008807209000000001, 0.0007233801,
                    2.2592000000000003e-5, 3.2400000000000004e-7, 3.852799999999999e-6 },
            },
            .position = { -0.16, -0.16, 0.0 },
            .axis = { -1.0289834168445055e-14, 0.09950371902073478, -0.9950371902100156 },
            .zero = { -1.0, -1.0341155355510722e-13, 0.0 },
        },
        {  /* w7 */
            .body = {
                .mass = 0.79,
                .center_of_mass = { 0.0005, 0.0055, -0.0008 },
                .inertia = { 0.0011744031, 0.0009007031, 0.0007040950000000001, 2.78275e-5, 3.16e-7,
                    1.1476e-5 },
            },
            .position = { 0.16, -0.16, 0.02 },
            .axis = { 0.6509445549045109, 0.6509445549039271, 0.3905667329421394 },
            .zero = { -0.7071067811862305, 0.7071067811868645, 0.0 },
        },
        {  /* w8 */
            .body = {
                .mass = 0.82,
                .center_of_mass = { -0.0005, 0.006, 0.0 },
                .inertia = { 0.0011795199999999999, 0.000920205, 0.000699725, 4.2460000000000003e-5, 0.0,
                    8.0e-6 },
            },
            .position = { -0.16, 0.16, 0.02 },
            .axis = { -0.680413817439588, 0.6804138174400577, 0.27216552697565327 },
            .zero = { -0.7071067811867916, -0.7071067811863034, 0.0 },
        },
    },
};

BENCH8_CONST const bench8_table bench8_default = {
    .mass = 18.39,
    .mass_inverse = 0.0543773790103317,
    .first_moment = { 0.04248197645434773, -0.03450698347272574, 0.10202567605548718 },
    .inertia = { 0.41413639719348794, 0.4762779486313417, 0.7182722364586255, 0.004811849097258413,
        -0.0016169693316299355, 0.0028881320052902455 },
    .flywheel = {
        {  /* w1 */
            .mu_c = { 0.0, 0.0048000000000000004, -0.00064 },
            .mu_s = { 0.0, 0.00064, 0.0048000000000000004 },
            .J_c = { 0.0018432000000000001, -7.680000000000001e-5, 0.0019200000000000003, -3.24e-5, 3.2e-7,
                -0.00015999999999999999 },
            .J_s = { 0.0008320000000000001, 0.000576, 0.00025600000000000004, -3.2e-7, -3.24e-5,
                -0.0009984000000000002 },
            .J_2c = { 0.0, 5.855999999999993e-6, -5.855999999999993e-6, 0.0, 0.0, 1.184e-5 },
            .J_2s = { 0.0, -1.184e-5, 1.184e-5, 0.0, 0.0, 5.855999999999993e-6 },
            .t_0 = { 0.001179312, 0.0, 0.0 },
            .t_c = { 0.0009216000000000002, -3.24e-5, 3.2e-7 },
            .t_s = { 0.00041600000000000003, -3.2e-7, -3.24e-5 },
            .spin = 0.001179312,
            .spin_inv = 847.952026266162,
            .spin_root_inv = 29.119615833079973,
        },
        {  /* w2 */
            .mu_c = { -0.0006479510984005862, -0.004319673989328533, 0.0 },
            .mu_s = { 0.0, 0.0, 0.004368 },
            .J_c = { 0.0017226424074673445, 5.227188264068756e-6, 0.0017278695957314131,
                -0.00014662214144050534, 3.887706590403517e-5, 0.00025918043935971194 },
            .J_s = { 0.0005241600000000001, 0.0005241600000000001, 0.0, 0.0, 1.761889006270081e-5,
                0.0008709571664905897 },
            .J_2c = { 5.010425427892632e-7, 2.2268557457210788e-5, -2.2769600000000054e-5,
                3.340283618588353e-6, -1.186723623444297e-6, -7.911490822946029e-6 },
            .J_2s = { -1.760391198050952e-7, -7.823960880194904e-6, 8.0e-6, -1.173594132031602e-6,
                -3.377652777047166e-6, -2.251768518026904e-5 },
            .t_0 = { -0.0011614669801387316, 0.00017422004702116097, 0.0 },
            .t_c = { -0.0008709571664905898, 1.761889006270081e-5, 0.0 },
            .t_s = { -0.00025918043935971194, 3.887706590403518e-5, 0.00011177421968011724 },
            .spin = 0.0011744608,
            .spin_inv = 851.4545568485555,
            .spin_root_inv = 29.179694255570183,
        },
        {  /* w3 */
            .mu_c = { -0.005229, -5.407390135396556e-16, 0.000664 },
            .mu_s = { 0.000664, 6.866527156059119e-17, 0.005229 },
            .J_c = { -7.96800000000026e-5, -0.002171279999999998, -0.0020916000000000003,
                1.2614500000108148e-5, -0.00044654, -3.3200000003244433e-7 },
            .J_s = { -0.0006274799999999999, -0.0003618800000000001, 0.0002656, -3.3200000001373306e-7,
                -0.0010059599999999989, -1.2614499999995881e-5 },
            .J_2c = { 3.3794249999999945e-5, 3.6139399980431083e-31, -3.3794249999999945e-5,
                3.4947158937296765e-18, -3.8168e-6, -3.947012176091332e-19 },
            .J_2s = { -3.8168e-6, -4.081666610305291e-32, 3.8168e-6, -3.947012176091332e-19,
                -3.3794249999999945e-5, -3.4947158937296765e-18 },
            .t_0 = { -1.2238487459092162e-16, 0.0011834739, 0.0 },
            .t_c = { 1.2614500000004121e-5, -0.0010856399999999988, -3.3199999998626696e-7 },
            .t_s = { -3.319999999675557e-7, -0.00018094000000000007, -1.2614499999891853e-5 },
            .spin = 0.0011834739,
            .spin_inv = 844.9700496141063,
            .spin_root_inv = 29.068368540633756,
        },
        {  /* w4 */
            .mu_c = { 0.004616972562574473, 0.0004616972562562094, -0.00064 },
            .mu_s = { 0.00063682380173441, 6.368238017327027e-5, 0.00464 },
            .J_c = { 7.725940594059287e-5, -0.0017704484309703818, -0.0018467890250297892,
                9.006539184530105e-5, 0.00014898651256438169, 2.8020247276239767e-5 },
            .J_s = { -0.0005567366336633665, -0.0008115928870303976, -0.000254729520693764,
                1.2422812668317386e-5, 0.0009664402767321927, 1.5124565291089798e-6 },
            .J_2c = { 5.1287128712874023e-5, 5.128712871259901e-7, -5.180000000000001e-5,
                5.128712871273652e-6, 1.1653875571739701e-5, 1.1653875571708457e-6 },
            .J_2s = { -1.159603960396101e-5, -1.1596039603898831e-7, 1.1711999999999999e-5,
                -1.159603960392992e-6, 5.154292645287882e-5, 5.154292645274063e-6 },
            .t_0 = { 0.00011715806686426965, -0.0011715806686458377, 0.0 },
            .t_c = { 6.129429091683452e-6, 0.0008900214205240637, -1.3056476034654053e-5 },
            .t_s = { -2.7383423474505356e-5, 0.00040505019494455497, 9.465945125124189e-5 },
            .spin = 0.001177424,
            .spin_inv = 849.3117177839079,
            .spin_root_inv = 29.14295314109241,
        },
        {  /* w5 */
            .mu_c = { 0.0, 0.004636, 0.0 },
            .mu_s = { -0.004636, 0.0, -4.794159622814771e-16 },
            .J_c = { 0.00148352, 0.0, 0.00148352, -0.0007417600000000008, 0.0, 7.682e-6 },
            .J_s = { 1.5888151088206675e-18, -0.00148352, -0.0014835200000000016, 0.00074176,
                -7.681999999923293e-6, 7.670655396503633e-17 },
            .J_2c = { -6.586020000000001e-5, 6.586020000000001e-5, -7.043056468455999e-31, -8.0e-6,
                -6.810705599450073e-18, -8.272924284408578e-19 },
            .J_2s = { 8.0e-6, -8.0e-6, 8.555159526944648e-32, -6.586020000000001e-5, 8.272924284408578e-19,
                -6.810705599450073e-18 },
            .t_0 = { -1.218477239582903e-16, 0.0, 0.0011782796 },
            .t_c = { -7.670655396503634e-17, 7.682000000076708e-6, 0.00074176 },
            .t_s = { -7.682e-6, 0.0, -0.0007417600000000009 },
            .spin = 0.0011782796,
            .spin_inv = 848.6949956529843,
            .spin_root_inv = 29.13237023746925,
        },
        {  /* w6 */
            .mu_c = { -0.005184000000000067, 0.000644784099255554, 6.447840992543614e-5 },
            .mu_s = { 0.0006479999999994666, 0.005158272794048788, 0.0005158272794034891 },
            .J_c = { -0.00020633091176177682, 0.0016589441584158623, 0.0014524849298224026,
                -0.0007285225321392385, 3.279642578929449e-5, 9.998961429656231e-6 },
            .J_s = { -0.001650647294095612, -0.00020288633663350443, -0.0018624809574617662,
                0.0009290358862526829, 8.22099726549325e-5, 6.0387731041189514e-5 },
            .J_2c = { 7.867040000000085e-5, -7.789148514851983e-5, -7.789148514810139e-7,
                -3.833679286424956e-6, -3.8336792864228134e-7, -7.789148514831061e-6 },
            .J_2s = { -3.852799999983809e-6, 3.8146534653305463e-6, 3.814653465326282e-8,
                -7.827997376869885e-5, -7.827997376848858e-6, 3.8146534653284137e-7 },
            .t_0 = { -1.2180035545851739e-17, 0.00011778215418996768, -0.001177821541902835 },
            .t_c = { -0.0001051243647045583, 8.285475675418396e-5, -0.0007216114078429286 },
            .t_s = { 1.0640545588067458e-5, 1.2163334613154928e-5, 0.0009348534439010158 },
            .spin = 0.0011836960000000001,
            .spin_inv = 844.8115056568578,
            .spin_root_inv = 29.065641325400993,
        },
        {  /* w7 */
            .mu_c = { -0.0028978380167007196, 0.0032469199118102215, -0.0005818031585118294 },
            .mu_s = { -0.0016468605001396797, -0.0007530775287188075, 0.003999896714768827 },
            .J_c = { -0.0010880174047787315, -0.0009250766179845516, -0.001966095304164666,
                -0.0009832748850411453, 0.00014351535449725188, -0.00015018644068902622 },
            .J_s = { 0.0003912663180277532, -0.0003772956543654566, -0.00026600002819014864,
                -0.00015301053675960505, -0.0005932851367323204, 0.0006686316116177211 },
            .J_2c = { 4.6136402301782206e-5, 3.717211464739583e-5, -8.330851694917801e-5,
                -5.6649791525414974e-5, 1.7522315372662056e-5, 3.2462794796801285e-5 },
            .J_2s = { 3.353157977907837e-5, -4.325700350789491e-5, 9.725423728816534e-6, 6.613288135557307e-6,
                -6.690811319114671e-5, 6.107285895392004e-5 },
            .t_0 = { 0.0007644713032079777, 0.0007644713032072921, 0.0004586827819241205 },
            .t_c = { -0.0006446862082158728, -0.0006533309408861052, -0.0003836991830381021 },
            .t_s = { -3.561184843670005e-5, -4.304037782459309e-5, -3.0235813037950913e-5 },
            .spin = 0.0011744031,
            .spin_inv = 851.4963899533304,
            .spin_root_inv = 29.180411065530425,
        },
        {  /* w8 */
            .mu_c = { -0.0034789653634390147, -0.003478965363436613, 0.0 },
            .mu_s = { 0.0009468544414697708, -0.0009468544414704245, 0.004734272207355287 },
            .J_c = { -0.0010724117622500605, 0.001072411762250829, 7.684824998577255e-16,
                3.5605199344423966e-16, 6.140787645885463e-5, 6.140787645881224e-5 },
            .J_s = { -0.00012474244183896668, -0.00012474244183877282, -0.0005837470248155626,
                -0.0002918735124077813, 0.0007129706739633339, -0.0007129706739633033 },
            .J_2c = { 4.885971282128034e-5, 5.321436125280905e-5, -0.0001020740740740894,
                5.920296296295679e-5, -2.58581253543106e-5, 1.497150427528753e-5 },
            .J_2s = { -3.370723139750324e-5, 2.6299823990094716e-5, 7.407407407408519e-6,
                -4.296296296275026e-6, -7.352733775311225e-5, -7.649030071602089e-5 },
            .t_0 = { -0.0008025617059463428, 0.0008025617059468968, 0.00032102468237832257 },
            .t_c = { 0.0007463968880770633, 0.000746396888077071, 1.0457722876685768e-16 },
            .t_s = { -6.140787645881223e-5, 6.140787645885465e-5, -0.0010724117622504447 },
            .spin = 0.0011795199999999999,
            .spin_inv = 847.8024959305482,
            .spin_root_inv = 29.11704820084873,
        },
    },
    .gravity = { 0.0, 0.0, -9.81 },
    .suspension = {
        .stiffness = {
            { 1633.5,    0.0,    0.0,    0.0,    0.0,    0.0 },
            {    0.0, 1633.5,    0.0,    0.0,    0.0,    0.0 },
            {    0.0,    0.0, 1633.5,    0.0,    0.0,    0.0 },
            {    0.0,    0.0,    0.0,   60.0,    0.0,    0.0 },
            {    0.0,    0.0,    0.0,    0.0,   60.0,    0.0 },
            {    0.0,    0.0,    0.0,    0.0,    0.0,   60.0 },
        },
        .damping = {
            { 25.0,  0.0,  0.0,  0.0,  0.0,  0.0 },
            {  0.0, 25.0,  0.0,  0.0,  0.0,  0.0 },
            {  0.0,  0.0, 25.0,  0.0,  0.0,  0.0 },
            {  0.0,  0.0,  0.0,  0.8,  0.0,  0.0 },
            {  0.0,  0.0,  0.0,  0.0,  0.8,  0.0 },
            {  0.0,  0.0,  0.0,  0.0,  0.0,  0.8 },
        },
        .position = { 0.0, 0.0, 0.110441322 },
        .attitude = { 1.0, 0.0, 0.0, 0.0 },
    },
};

BENCH8_CONST const bench8_inverse_options bench8_default_options = {
    .weight = { 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0 },
    .limit = { BENCH8_LARGEST, BENCH8_LARGEST, BENCH8_LARGEST, BENCH8_LARGEST, BENCH8_LARGEST, BENCH8_LARGEST,
        BENCH8_LARGEST, BENCH8_LARGEST },
    .most = { 1.0e4, 1.0e4, 1.0e4, 1.0e4, 1.0e4, 1.0e4, 1.0e4, 1.0e4 },
    .motor_torque = { BENCH8_LARGEST, BENCH8_LARGEST, BENCH8_LARGEST, BENCH8_LARGEST, BENCH8_LARGEST,
        BENCH8_LARGEST, BENCH8_LARGEST, BENCH8_LARGEST },
    .motor_speed = { BENCH8_LARGEST, BENCH8_LARGEST, BENCH8_LARGEST, BENCH8_LARGEST, BENCH8_LARGEST,
        BENCH8_LARGEST, BENCH8_LARGEST, BENCH8_LARGEST },
    .motor_viscous = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 },
    .motor_coulomb = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 },
    .motor_coulomb_speed = { 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0 },
    .near_singular = 1.0e-6,
    .damping = 0.0,
};
