/* demo3_recorder.c: flight recorder of the stand "demo3". What a log holds: demo3_recorder.h.
 * mahovik 0.1.0; structure 055bf547, physics fdeb29e7. Generated: change the stand file instead. */
#include "demo3_recorder.h"

#if DEMO3_STRUCTURE != 0x055bf547u || DEMO3_PHYSICS != 0xfdeb29e7u
#error "demo3.h and demo3_recorder.c are of different stands"
#endif

#include <float.h>
#include <limits.h>

/* Other numbers than those of IEEE 754, and fast math, which leaves out roundings that the code relies on,
 * give wrong results with status OK. What the compiler shows of them is refused here; clang does not show
 * -funsafe-math-optimizations. */
#if FLT_RADIX != 2 || DBL_MANT_DIG != 53
#error "wrong results: demo3 needs a double of 64 bits, 53 of them significant"
#endif
#if INT_MAX < 2147483647
#error "wrong counts: demo3 needs an int of 32 bits"
#endif
#ifndef DEMO3_ALLOW_FAST_MATH
#if defined __FAST_MATH__ || defined __ASSOCIATIVE_MATH__ || defined __RECIPROCAL_MATH__ || defined _M_FP_FAST
#error "wrong results: compile demo3 without -ffast-math, -Ofast and -funsafe-math-optimizations"
#elif FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1 && FLT_EVAL_METHOD != 16
#error "wrong results: x87 keeps more digits: compile demo3 with -msse2 -mfpmath=sse"
#endif
#if defined __FINITE_MATH_ONLY__ && __FINITE_MATH_ONLY__ == 1
#error "inputs that are NaN would pass: compile demo3 without -ffinite-math-only"
#endif
#endif

#ifndef DEMO3_CODE
#define DEMO3_CODE
#endif

/* Header and recorder use the same real type: otherwise this array has a negative size. */
typedef char demo3_recorder_real[(sizeof(demo3_real) == 8) ? 1 : -1];

typedef uint64_t demo3_record_word;  /* the bits of a real */

/* Sizes in bytes, and the first byte of a step's record. */
enum {
    DEMO3_RECORD_STEP = 0x53,
    DEMO3_RECORD_REAL_BYTES = 8,
    DEMO3_RECORD_TABLE_BYTES = 1096,
    DEMO3_RECORD_LOCKS_A_BYTE = 8
};

/* FNV-1a, 32 bits. */
#define DEMO3_RECORD_BASIS 2166136261u
#define DEMO3_RECORD_PRIME 16777619u

/* A record being written: the bytes that wait for write, and their hash so far. Without a log nothing is written. */
typedef struct demo3_page {
    demo3_recorder *log;
    uint32_t check;
    size_t used;
    unsigned char bytes[DEMO3_RECORD_BYTES];
} demo3_page;

static const unsigned char demo3_record_magic[] = { 0x89, 0x4d, 0x48, 0x56, 0x4b, 0x0d, 0x0a, 0x1a };
static const unsigned char demo3_record_name[] = {
    0x64, 0x65, 0x6d, 0x6f, 0x33
};

DEMO3_CODE
static demo3_record_word demo3_record_bits(demo3_real value)
{
    union { demo3_real real; demo3_record_word word; } both;
    both.real = value;
    return both.word;
}

DEMO3_CODE
static void demo3_record_begin(demo3_page *page, demo3_recorder *log)
{
    page->log = log;
    page->check = DEMO3_RECORD_BASIS;
    page->used = 0;
}

DEMO3_CODE
static void demo3_record_flush(demo3_page *page)
{
    if (page->log != NULL && page->used > 0 && page->log->write(page->log->context, page->bytes, page->used) != 0) {
        ++page->log->lost;
    }
    page->used = 0;
}

/* The lowest bytes of a word, least significant first. */
DEMO3_CODE
static void demo3_record_put(demo3_page *page, demo3_record_word value, int bytes)
{
    for (int i = 0; i < bytes; ++i) {
        const unsigned char byte = (unsigned char)(value & 0xffu);
        if (page->used == sizeof page->bytes) {
            demo3_record_flush(page);
        }
        page->bytes[page->used++] = byte;
        page->check = (page->check ^ byte) * DEMO3_RECORD_PRIME;
        value >>= 8;
    }
}

DEMO3_CODE
static void demo3_record_put_reals(demo3_page *page, const demo3_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        demo3_record_put(page, demo3_record_bits(values[i]), DEMO3_RECORD_REAL_BYTES);
    }
}

DEMO3_CODE
static void demo3_record_put_bytes(demo3_page *page, const unsigned char *bytes, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        demo3_record_put(page, bytes[i], 1);
    }
}

/* Appends the check and writes the waiting bytes. */
DEMO3_CODE
static void demo3_record_end(demo3_page *page)
{
    demo3_record_put(page, page->check, 4);
    demo3_record_flush(page);
}

DEMO3_CODE
static void demo3_record_put_row(demo3_page *page, const demo3_row *from)
{
    demo3_record_put_reals(page, from->mu_c, 3);
    demo3_record_put_reals(page, from->mu_s, 3);
    demo3_record_put_reals(page, from->J_c, 6);
    demo3_record_put_reals(page, from->J_s, 6);
    demo3_record_put_reals(page, from->J_2c, 6);
    demo3_record_put_reals(page, from->J_2s, 6);
    demo3_record_put_reals(page, from->t_0, 3);
    demo3_record_put_reals(page, from->t_c, 3);
    demo3_record_put_reals(page, from->t_s, 3);
    demo3_record_put_reals(page, &from->spin, 1);
    demo3_record_put_reals(page, &from->spin_inv, 1);
    demo3_record_put_reals(page, &from->spin_root_inv, 1);
}

DEMO3_CODE
static void demo3_record_put_table(demo3_page *page, const demo3_table *from)
{
    demo3_record_put_reals(page, &from->mass, 1);
    demo3_record_put_reals(page, &from->mass_inverse, 1);
    demo3_record_put_reals(page, from->first_moment, 3);
    demo3_record_put_reals(page, from->inertia, 6);
    for (int i = 0; i < DEMO3_N; ++i) {
        demo3_record_put_row(page, &from->flywheel[i]);
    }
}

/* The hash of a state so far, and one word more. */
DEMO3_CODE
static uint32_t demo3_record_mix(uint32_t hash, uint32_t word)
{
    const uint32_t turned = ((hash << 5) & 0xffffffffu) | (hash >> 27);
    return (turned ^ word) * DEMO3_RECORD_PRIME;
}

DEMO3_CODE
static uint32_t demo3_record_hash(uint32_t hash, const demo3_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        const demo3_record_word word = demo3_record_bits(values[i]);
        hash = demo3_record_mix(hash, (uint32_t)(word & 0xffffffffu));
        hash = demo3_record_mix(hash, (uint32_t)(word >> 32));
    }
    return hash;
}

/* The flag where two rows of numbers differ in a bit. */
DEMO3_CODE
static unsigned demo3_record_differs(const demo3_real *one, const demo3_real *other, int count, unsigned flag)
{
    demo3_record_word bits = 0;
    for (int i = 0; i < count; ++i) {
        bits |= demo3_record_bits(one[i]) ^ demo3_record_bits(other[i]);
    }
    return (bits != 0u) ? flag : 0u;
}

DEMO3_CODE
demo3_status demo3_recorder_start(demo3_recorder *log, const demo3_table *table, const demo3_state *x)
{
    demo3_page page;
    uint32_t check;
    if (log == NULL || table == NULL || x == NULL || log->write == NULL) {
        return DEMO3_BAD_ARGUMENT;
    }
    demo3_record_begin(&page, NULL);
    demo3_record_put_table(&page, table);
    check = page.check;
    demo3_record_begin(&page, log);
    demo3_record_put_bytes(&page, demo3_record_magic, sizeof demo3_record_magic);
    demo3_record_put(&page, DEMO3_RECORDER_FORMAT, 1);
    demo3_record_put(&page, DEMO3_RECORD_REAL_BYTES, 1);
    demo3_record_put(&page, sizeof demo3_record_name, 1);
    demo3_record_put_bytes(&page, demo3_record_name, sizeof demo3_record_name);
    demo3_record_put(&page, DEMO3_STRUCTURE, 4);
    demo3_record_put(&page, DEMO3_PHYSICS, 4);
    demo3_record_put(&page, DEMO3_RECORDER_SOURCE, 4);
    demo3_record_put(&page, DEMO3_N, 2);
    demo3_record_put(&page, 0, 2);
    demo3_record_put(&page, check, 4);
    demo3_record_put(&page, log->count, 4);
    demo3_record_put_reals(&page, x->position, 3);
    demo3_record_put_reals(&page, x->attitude, 4);
    demo3_record_put_reals(&page, x->V, 6);
    demo3_record_put_reals(&page, x->phi, DEMO3_N);
    demo3_record_put_reals(&page, x->phi_dot, DEMO3_N);
    if (check == DEMO3_TABLE_HASH) {
        demo3_record_put(&page, 0, 4);
    } else {
        demo3_record_put(&page, DEMO3_RECORD_TABLE_BYTES, 4);
        demo3_record_put_table(&page, table);
    }
    demo3_record_end(&page);
    log->seen = *x;
    for (int i = 0; i < 19; ++i) {
        log->carry.rounding[i] = (demo3_real)0;
    }
    log->fresh = 1;
    return DEMO3_OK;
}

/* Flags of what changed since the last step: members of the state, dt and order. The log remembers the new values. */
DEMO3_CODE
static unsigned demo3_notice_changes(demo3_recorder *log, const demo3_state *x,
                                  demo3_real dt, int order)
{
    const demo3_record_word step = demo3_record_bits(dt);
    unsigned flags = 0;
    flags |= demo3_record_differs(x->position, log->seen.position, 3, DEMO3_RECORD_POSITION);
    flags |= demo3_record_differs(x->attitude, log->seen.attitude, 4, DEMO3_RECORD_ATTITUDE);
    flags |= demo3_record_differs(x->V, log->seen.V, 6, DEMO3_RECORD_V);
    flags |= demo3_record_differs(x->phi, log->seen.phi, DEMO3_N, DEMO3_RECORD_PHI);
    flags |= demo3_record_differs(x->phi_dot, log->seen.phi_dot, DEMO3_N, DEMO3_RECORD_PHI_DOT);
    if (log->fresh || step != log->dt || order != log->order) {
        flags |= DEMO3_RECORD_SETTINGS;
    }
    log->fresh = 0;
    log->dt = step;
    log->order = order;
    return flags;
}

/* The head of a step's record: flags, and what changed. */
DEMO3_CODE
static void demo3_record_head(demo3_page *page, demo3_recorder *log, const demo3_state *x, unsigned flags)
{
    demo3_record_begin(page, log);
    demo3_record_put(page, DEMO3_RECORD_STEP, 1);
    demo3_record_put(page, flags, 2);
    demo3_record_put(page, log->count, 4);
    if (flags & DEMO3_RECORD_SETTINGS) {
        demo3_record_put(page, log->dt, DEMO3_RECORD_REAL_BYTES);
        demo3_record_put(page, (demo3_record_word)log->order, 4);
    }
    if (flags & DEMO3_RECORD_POSITION) {
        demo3_record_put_reals(page, x->position, 3);
    }
    if (flags & DEMO3_RECORD_ATTITUDE) {
        demo3_record_put_reals(page, x->attitude, 4);
    }
    if (flags & DEMO3_RECORD_V) {
        demo3_record_put_reals(page, x->V, 6);
    }
    if (flags & DEMO3_RECORD_PHI) {
        demo3_record_put_reals(page, x->phi, DEMO3_N);
    }
    if (flags & DEMO3_RECORD_PHI_DOT) {
        demo3_record_put_reals(page, x->phi_dot, DEMO3_N);
    }
    if (flags & DEMO3_RECORD_CARRY) {
        demo3_record_put_reals(page, log->carry.rounding, 19);
    }
}

/* The tail: status and the hash of the state after the step, and of its carry if there is one. */
DEMO3_CODE
static void demo3_record_result(demo3_page *page, demo3_recorder *log,
                              const demo3_state *x, const demo3_step_carry *carry, demo3_status status)
{
    uint32_t hash = DEMO3_RECORD_BASIS;
    hash = demo3_record_hash(hash, x->position, 3);
    hash = demo3_record_hash(hash, x->attitude, 4);
    hash = demo3_record_hash(hash, x->V, 6);
    hash = demo3_record_hash(hash, x->phi, DEMO3_N);
    hash = demo3_record_hash(hash, x->phi_dot, DEMO3_N);
    if (carry != NULL) {
        hash = demo3_record_hash(hash, carry->rounding, 19);
        log->carry = *carry;
    }
    log->seen = *x;
    demo3_record_put(page, (demo3_record_word)status, 1);
    demo3_record_put(page, hash, 4);
    demo3_record_end(page);
    ++log->count;
}

DEMO3_CODE
demo3_status demo3_recorder_step(demo3_recorder *log, const demo3_table *table, demo3_state *x,
                                 const demo3_real tau[DEMO3_N], const int locked[DEMO3_N], demo3_real dt,
                                 int order)
{
    demo3_page page;
    demo3_status status;
    unsigned flags = 0;
    if (log == NULL || table == NULL || x == NULL || tau == NULL
        || log->write == NULL) { return DEMO3_BAD_ARGUMENT; }
    for (int s = 0; s < DEMO3_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? DEMO3_RECORD_LOCKS : 0u;
    }
    flags |= demo3_notice_changes(log, x, dt, order);
    demo3_record_head(&page, log, x, flags);
    demo3_record_put_reals(&page, tau, DEMO3_N);
    if ((flags & DEMO3_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < DEMO3_N; first += DEMO3_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < DEMO3_N && s < first + DEMO3_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            demo3_record_put(&page, mask, 1);
        }
    }
    status = demo3_step(table, x, tau, locked, dt, order, x);
    demo3_record_result(&page, log, x, NULL, status);
    return status;
}

DEMO3_CODE
demo3_status demo3_recorder_step_driven(demo3_recorder *log, const demo3_table *table, demo3_state *x,
                                        const demo3_real phi_ddot[DEMO3_N], demo3_real dt, int order)
{
    demo3_page page;
    demo3_status status;
    unsigned flags = DEMO3_RECORD_DRIVEN;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL
        || log->write == NULL) { return DEMO3_BAD_ARGUMENT; }
    flags |= demo3_notice_changes(log, x, dt, order);
    demo3_record_head(&page, log, x, flags);
    demo3_record_put_reals(&page, phi_ddot, DEMO3_N);
    status = demo3_step_driven(table, x, phi_ddot, dt, order, x);
    demo3_record_result(&page, log, x, NULL, status);
    return status;
}

DEMO3_CODE
demo3_status demo3_recorder_step_carried(demo3_recorder *log, const demo3_table *table, demo3_state *x,
                                         const demo3_real tau[DEMO3_N], const int locked[DEMO3_N],
                                         demo3_real dt, int order, demo3_step_carry *carry)
{
    demo3_page page;
    demo3_status status;
    unsigned flags = DEMO3_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || tau == NULL || carry == NULL
        || log->write == NULL) { return DEMO3_BAD_ARGUMENT; }
    for (int s = 0; s < DEMO3_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? DEMO3_RECORD_LOCKS : 0u;
    }
    flags |= demo3_notice_changes(log, x, dt, order);
    flags |= demo3_record_differs(carry->rounding, log->carry.rounding, 19, DEMO3_RECORD_CARRY);
    log->carry = *carry;
    demo3_record_head(&page, log, x, flags);
    demo3_record_put_reals(&page, tau, DEMO3_N);
    if ((flags & DEMO3_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < DEMO3_N; first += DEMO3_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < DEMO3_N && s < first + DEMO3_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            demo3_record_put(&page, mask, 1);
        }
    }
    status = demo3_step_carried(table, x, tau, locked, dt, order, carry, x);
    demo3_record_result(&page, log, x, carry, status);
    return status;
}

DEMO3_CODE
demo3_status demo3_recorder_step_driven_carried(demo3_recorder *log, const demo3_table *table,
                                                demo3_state *x, const demo3_real phi_ddot[DEMO3_N],
                                                demo3_real dt, int order, demo3_step_carry *carry)
{
    demo3_page page;
    demo3_status status;
    unsigned flags = DEMO3_RECORD_DRIVEN | DEMO3_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL || carry == NULL
        || log->write == NULL) { return DEMO3_BAD_ARGUMENT; }
    flags |= demo3_notice_changes(log, x, dt, order);
    flags |= demo3_record_differs(carry->rounding, log->carry.rounding, 19, DEMO3_RECORD_CARRY);
    log->carry = *carry;
    demo3_record_head(&page, log, x, flags);
    demo3_record_put_reals(&page, phi_ddot, DEMO3_N);
    status = demo3_step_driven_carried(table, x, phi_ddot, dt, order, carry, x);
    demo3_record_result(&page, log, x, carry, status);
    return status;
}
