/* bench8_recorder.c: flight recorder of the stand "bench8". What a log holds: bench8_recorder.h.
 * mahovik 0.1.0; structure 309d41a6, physics 139422e0. Generated: change the stand file instead. */
#include "bench8_recorder.h"

#if BENCH8_STRUCTURE != 0x309d41a6u || BENCH8_PHYSICS != 0x139422e0u
#error "bench8.h and bench8_recorder.c are of different stands"
#endif

#include <float.h>
#include <limits.h>

/* Other numbers than those of IEEE 754, and fast math, which leaves out roundings that the code relies on,
 * give wrong results with status OK. What the compiler shows of them is refused here; clang does not show
 * -funsafe-math-optimizations. */
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

#ifndef BENCH8_CODE
#define BENCH8_CODE
#endif

/* Header and recorder use the same real type: otherwise this array has a negative size. */
typedef char bench8_recorder_real[(sizeof(bench8_real) == 8) ? 1 : -1];

typedef uint64_t bench8_record_word;  /* the bits of a real */

/* Sizes in bytes, and the first byte of a step's record. */
enum {
    BENCH8_RECORD_STEP = 0x53,
    BENCH8_RECORD_REAL_BYTES = 8,
    BENCH8_RECORD_TABLE_BYTES = 3432,
    BENCH8_RECORD_LOCKS_A_BYTE = 8
};

/* FNV-1a, 32 bits. */
#define BENCH8_RECORD_BASIS 2166136261u
#define BENCH8_RECORD_PRIME 16777619u

/* A record being written: the bytes that wait for write, and their hash so far. Without a log nothing is written. */
typedef struct bench8_page {
    bench8_recorder *log;
    uint32_t check;
    size_t used;
    unsigned char bytes[BENCH8_RECORD_BYTES];
} bench8_page;

static const unsigned char bench8_record_magic[] = { 0x89, 0x4d, 0x48, 0x56, 0x4b, 0x0d, 0x0a, 0x1a };
static const unsigned char bench8_record_name[] = {
    0x62, 0x65, 0x6e, 0x63, 0x68, 0x38
};

BENCH8_CODE
static bench8_record_word bench8_record_bits(bench8_real value)
{
    union { bench8_real real; bench8_record_word word; } both;
    both.real = value;
    return both.word;
}

BENCH8_CODE
static void bench8_record_begin(bench8_page *page, bench8_recorder *log)
{
    page->log = log;
    page->check = BENCH8_RECORD_BASIS;
    page->used = 0;
}

BENCH8_CODE
static void bench8_record_flush(bench8_page *page)
{
    if (page->log != NULL && page->used > 0 && page->log->write(page->log->context, page->bytes, page->used) != 0) {
        ++page->log->lost;
    }
    page->used = 0;
}

/* The lowest bytes of a word, least significant first. */
BENCH8_CODE
static void bench8_record_put(bench8_page *page, bench8_record_word value, int bytes)
{
    for (int i = 0; i < bytes; ++i) {
        const unsigned char byte = (unsigned char)(value & 0xffu);
        if (page->used == sizeof page->bytes) {
            bench8_record_flush(page);
        }
        page->bytes[page->used++] = byte;
        page->check = (page->check ^ byte) * BENCH8_RECORD_PRIME;
        value >>= 8;
    }
}

BENCH8_CODE
static void bench8_record_put_reals(bench8_page *page, const bench8_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        bench8_record_put(page, bench8_record_bits(values[i]), BENCH8_RECORD_REAL_BYTES);
    }
}

BENCH8_CODE
static void bench8_record_put_bytes(bench8_page *page, const unsigned char *bytes, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        bench8_record_put(page, bytes[i], 1);
    }
}

/* Appends the check and writes the waiting bytes. */
BENCH8_CODE
static void bench8_record_end(bench8_page *page)
{
    bench8_record_put(page, page->check, 4);
    bench8_record_flush(page);
}

BENCH8_CODE
static void bench8_record_put_row(bench8_page *page, const bench8_row *from)
{
    bench8_record_put_reals(page, from->mu_c, 3);
    bench8_record_put_reals(page, from->mu_s, 3);
    bench8_record_put_reals(page, from->J_c, 6);
    bench8_record_put_reals(page, from->J_s, 6);
    bench8_record_put_reals(page, from->J_2c, 6);
    bench8_record_put_reals(page, from->J_2s, 6);
    bench8_record_put_reals(page, from->t_0, 3);
    bench8_record_put_reals(page, from->t_c, 3);
    bench8_record_put_reals(page, from->t_s, 3);
    bench8_record_put_reals(page, &from->spin, 1);
    bench8_record_put_reals(page, &from->spin_inv, 1);
    bench8_record_put_reals(page, &from->spin_root_inv, 1);
}

BENCH8_CODE
static void bench8_record_put_suspension(bench8_page *page, const bench8_suspension *from)
{
    for (int i = 0; i < 6; ++i) {
        bench8_record_put_reals(page, from->stiffness[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        bench8_record_put_reals(page, from->damping[i], 6);
    }
    bench8_record_put_reals(page, from->position, 3);
    bench8_record_put_reals(page, from->attitude, 4);
}

BENCH8_CODE
static void bench8_record_put_table(bench8_page *page, const bench8_table *from)
{
    bench8_record_put_reals(page, &from->mass, 1);
    bench8_record_put_reals(page, &from->mass_inverse, 1);
    bench8_record_put_reals(page, from->first_moment, 3);
    bench8_record_put_reals(page, from->inertia, 6);
    for (int i = 0; i < BENCH8_N; ++i) {
        bench8_record_put_row(page, &from->flywheel[i]);
    }
    bench8_record_put_reals(page, from->gravity, 3);
    bench8_record_put_suspension(page, &from->suspension);
}

/* The hash of a state so far, and one word more. */
BENCH8_CODE
static uint32_t bench8_record_mix(uint32_t hash, uint32_t word)
{
    const uint32_t turned = ((hash << 5) & 0xffffffffu) | (hash >> 27);
    return (turned ^ word) * BENCH8_RECORD_PRIME;
}

BENCH8_CODE
static uint32_t bench8_record_hash(uint32_t hash, const bench8_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        const bench8_record_word word = bench8_record_bits(values[i]);
        hash = bench8_record_mix(hash, (uint32_t)(word & 0xffffffffu));
        hash = bench8_record_mix(hash, (uint32_t)(word >> 32));
    }
    return hash;
}

/* The flag where two rows of numbers differ in a bit. */
BENCH8_CODE
static unsigned bench8_record_differs(const bench8_real *one, const bench8_real *other, int count, unsigned flag)
{
    bench8_record_word bits = 0;
    for (int i = 0; i < count; ++i) {
        bits |= bench8_record_bits(one[i]) ^ bench8_record_bits(other[i]);
    }
    return (bits != 0u) ? flag : 0u;
}

BENCH8_CODE
bench8_status bench8_recorder_start(bench8_recorder *log, const bench8_table *table, const bench8_state *x)
{
    bench8_page page;
    uint32_t check;
    if (log == NULL || table == NULL || x == NULL || log->write == NULL) {
        return BENCH8_BAD_ARGUMENT;
    }
    bench8_record_begin(&page, NULL);
    bench8_record_put_table(&page, table);
    check = page.check;
    bench8_record_begin(&page, log);
    bench8_record_put_bytes(&page, bench8_record_magic, sizeof bench8_record_magic);
    bench8_record_put(&page, BENCH8_RECORDER_FORMAT, 1);
    bench8_record_put(&page, BENCH8_RECORD_REAL_BYTES, 1);
    bench8_record_put(&page, sizeof bench8_record_name, 1);
    bench8_record_put_bytes(&page, bench8_record_name, sizeof bench8_record_name);
    bench8_record_put(&page, BENCH8_STRUCTURE, 4);
    bench8_record_put(&page, BENCH8_PHYSICS, 4);
    bench8_record_put(&page, BENCH8_RECORDER_SOURCE, 4);
    bench8_record_put(&page, BENCH8_N, 2);
    bench8_record_put(&page, 0, 2);
    bench8_record_put(&page, check, 4);
    bench8_record_put(&page, log->count, 4);
    bench8_record_put_reals(&page, x->position, 3);
    bench8_record_put_reals(&page, x->attitude, 4);
    bench8_record_put_reals(&page, x->V, 6);
    bench8_record_put_reals(&page, x->phi, BENCH8_N);
    bench8_record_put_reals(&page, x->phi_dot, BENCH8_N);
    if (check == BENCH8_TABLE_HASH) {
        bench8_record_put(&page, 0, 4);
    } else {
        bench8_record_put(&page, BENCH8_RECORD_TABLE_BYTES, 4);
        bench8_record_put_table(&page, table);
    }
    bench8_record_end(&page);
    log->seen = *x;
    for (int i = 0; i < 29; ++i) {
        log->carry.rounding[i] = (bench8_real)0;
    }
    log->fresh = 1;
    return BENCH8_OK;
}

/* Flags of what changed since the last step: members of the state, dt and order. The log remembers the new values. */
BENCH8_CODE
static unsigned bench8_notice_changes(bench8_recorder *log, const bench8_state *x,
                                  bench8_real dt, int order)
{
    const bench8_record_word step = bench8_record_bits(dt);
    unsigned flags = 0;
    flags |= bench8_record_differs(x->position, log->seen.position, 3, BENCH8_RECORD_POSITION);
    flags |= bench8_record_differs(x->attitude, log->seen.attitude, 4, BENCH8_RECORD_ATTITUDE);
    flags |= bench8_record_differs(x->V, log->seen.V, 6, BENCH8_RECORD_V);
    flags |= bench8_record_differs(x->phi, log->seen.phi, BENCH8_N, BENCH8_RECORD_PHI);
    flags |= bench8_record_differs(x->phi_dot, log->seen.phi_dot, BENCH8_N, BENCH8_RECORD_PHI_DOT);
    if (log->fresh || step != log->dt || order != log->order) {
        flags |= BENCH8_RECORD_SETTINGS;
    }
    log->fresh = 0;
    log->dt = step;
    log->order = order;
    return flags;
}

/* The head of a step's record: flags, and what changed. */
BENCH8_CODE
static void bench8_record_head(bench8_page *page, bench8_recorder *log, const bench8_state *x, unsigned flags)
{
    bench8_record_begin(page, log);
    bench8_record_put(page, BENCH8_RECORD_STEP, 1);
    bench8_record_put(page, flags, 2);
    bench8_record_put(page, log->count, 4);
    if (flags & BENCH8_RECORD_SETTINGS) {
        bench8_record_put(page, log->dt, BENCH8_RECORD_REAL_BYTES);
        bench8_record_put(page, (bench8_record_word)log->order, 4);
    }
    if (flags & BENCH8_RECORD_POSITION) {
        bench8_record_put_reals(page, x->position, 3);
    }
    if (flags & BENCH8_RECORD_ATTITUDE) {
        bench8_record_put_reals(page, x->attitude, 4);
    }
    if (flags & BENCH8_RECORD_V) {
        bench8_record_put_reals(page, x->V, 6);
    }
    if (flags & BENCH8_RECORD_PHI) {
        bench8_record_put_reals(page, x->phi, BENCH8_N);
    }
    if (flags & BENCH8_RECORD_PHI_DOT) {
        bench8_record_put_reals(page, x->phi_dot, BENCH8_N);
    }
    if (flags & BENCH8_RECORD_CARRY) {
        bench8_record_put_reals(page, log->carry.rounding, 29);
    }
}

/* The tail: status and the hash of the state after the step, and of its carry if there is one. */
BENCH8_CODE
static void bench8_record_result(bench8_page *page, bench8_recorder *log,
                              const bench8_state *x, const bench8_step_carry *carry, bench8_status status)
{
    uint32_t hash = BENCH8_RECORD_BASIS;
    hash = bench8_record_hash(hash, x->position, 3);
    hash = bench8_record_hash(hash, x->attitude, 4);
    hash = bench8_record_hash(hash, x->V, 6);
    hash = bench8_record_hash(hash, x->phi, BENCH8_N);
    hash = bench8_record_hash(hash, x->phi_dot, BENCH8_N);
    if (carry != NULL) {
        hash = bench8_record_hash(hash, carry->rounding, 29);
        log->carry = *carry;
    }
    log->seen = *x;
    bench8_record_put(page, (bench8_record_word)status, 1);
    bench8_record_put(page, hash, 4);
    bench8_record_end(page);
    ++log->count;
}

BENCH8_CODE
bench8_status bench8_recorder_step(bench8_recorder *log, const bench8_table *table, bench8_state *x,
                                   const bench8_real tau[BENCH8_N], const int locked[BENCH8_N],
                                   bench8_real dt, int order)
{
    bench8_page page;
    bench8_status status;
    unsigned flags = 0;
    if (log == NULL || table == NULL || x == NULL || tau == NULL
        || log->write == NULL) { return BENCH8_BAD_ARGUMENT; }
    for (int s = 0; s < BENCH8_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? BENCH8_RECORD_LOCKS : 0u;
    }
    flags |= bench8_notice_changes(log, x, dt, order);
    bench8_record_head(&page, log, x, flags);
    bench8_record_put_reals(&page, tau, BENCH8_N);
    if ((flags & BENCH8_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < BENCH8_N; first += BENCH8_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < BENCH8_N && s < first + BENCH8_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            bench8_record_put(&page, mask, 1);
        }
    }
    status = bench8_step(table, x, tau, locked, dt, order, x);
    bench8_record_result(&page, log, x, NULL, status);
    return status;
}

BENCH8_CODE
bench8_status bench8_recorder_step_driven(bench8_recorder *log, const bench8_table *table, bench8_state *x,
                                          const bench8_real phi_ddot[BENCH8_N], bench8_real dt, int order)
{
    bench8_page page;
    bench8_status status;
    unsigned flags = BENCH8_RECORD_DRIVEN;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL
        || log->write == NULL) { return BENCH8_BAD_ARGUMENT; }
    flags |= bench8_notice_changes(log, x, dt, order);
    bench8_record_head(&page, log, x, flags);
    bench8_record_put_reals(&page, phi_ddot, BENCH8_N);
    status = bench8_step_driven(table, x, phi_ddot, dt, order, x);
    bench8_record_result(&page, log, x, NULL, status);
    return status;
}

BENCH8_CODE
bench8_status bench8_recorder_step_carried(bench8_recorder *log, const bench8_table *table, bench8_state *x,
                                           const bench8_real tau[BENCH8_N], const int locked[BENCH8_N],
                                           bench8_real dt, int order, bench8_step_carry *carry)
{
    bench8_page page;
    bench8_status status;
    unsigned flags = BENCH8_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || tau == NULL || carry == NULL
        || log->write == NULL) { return BENCH8_BAD_ARGUMENT; }
    for (int s = 0; s < BENCH8_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? BENCH8_RECORD_LOCKS : 0u;
    }
    flags |= bench8_notice_changes(log, x, dt, order);
    flags |= bench8_record_differs(carry->rounding, log->carry.rounding, 29, BENCH8_RECORD_CARRY);
    log->carry = *carry;
    bench8_record_head(&page, log, x, flags);
    bench8_record_put_reals(&page, tau, BENCH8_N);
    if ((flags & BENCH8_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < BENCH8_N; first += BENCH8_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < BENCH8_N && s < first + BENCH8_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            bench8_record_put(&page, mask, 1);
        }
    }
    status = bench8_step_carried(table, x, tau, locked, dt, order, carry, x);
    bench8_record_result(&page, log, x, carry, status);
    return status;
}

BENCH8_CODE
bench8_status bench8_recorder_step_driven_carried(bench8_recorder *log, const bench8_table *table,
                                                  bench8_state *x, const bench8_real phi_ddot[BENCH8_N],
                                                  bench8_real dt, int order, bench8_step_carry *carry)
{
    bench8_page page;
    bench8_status status;
    unsigned flags = BENCH8_RECORD_DRIVEN | BENCH8_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL || carry == NULL
        || log->write == NULL) { return BENCH8_BAD_ARGUMENT; }
    flags |= bench8_notice_changes(log, x, dt, order);
    flags |= bench8_record_differs(carry->rounding, log->carry.rounding, 29, BENCH8_RECORD_CARRY);
    log->carry = *carry;
    bench8_record_head(&page, log, x, flags);
    bench8_record_put_reals(&page, phi_ddot, BENCH8_N);
    status = bench8_step_driven_carried(table, x, phi_ddot, dt, order, carry, x);
    bench8_record_result(&page, log, x, carry, status);
    return status;
}
