/* shaker2_recorder.c: flight recorder of the stand "shaker2". What a log holds: shaker2_recorder.h.
 * mahovik 0.1.0; structure 94a85f4a, physics 2591b2a4. Generated: change the stand file instead. */
#include "shaker2_recorder.h"

#if SHAKER2_STRUCTURE != 0x94a85f4au || SHAKER2_PHYSICS != 0x2591b2a4u
#error "shaker2.h and shaker2_recorder.c are of different stands"
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

#ifndef SHAKER2_CODE
#define SHAKER2_CODE
#endif

/* Header and recorder use the same real type: otherwise this array has a negative size. */
typedef char shaker2_recorder_real[(sizeof(shaker2_real) == 8) ? 1 : -1];

typedef uint64_t shaker2_record_word;  /* the bits of a real */

/* Sizes in bytes, and the first byte of a step's record. */
enum {
    SHAKER2_RECORD_STEP = 0x53,
    SHAKER2_RECORD_REAL_BYTES = 8,
    SHAKER2_RECORD_TABLE_BYTES = 1416,
    SHAKER2_RECORD_LOCKS_A_BYTE = 8
};

/* FNV-1a, 32 bits. */
#define SHAKER2_RECORD_BASIS 2166136261u
#define SHAKER2_RECORD_PRIME 16777619u

/* A record being written: the bytes that wait for write, and their hash so far. Without a log nothing is written. */
typedef struct shaker2_page {
    shaker2_recorder *log;
    uint32_t check;
    size_t used;
    unsigned char bytes[SHAKER2_RECORD_BYTES];
} shaker2_page;

static const unsigned char shaker2_record_magic[] = { 0x89, 0x4d, 0x48, 0x56, 0x4b, 0x0d, 0x0a, 0x1a };
static const unsigned char shaker2_record_name[] = {
    0x73, 0x68, 0x61, 0x6b, 0x65, 0x72, 0x32
};

SHAKER2_CODE
static shaker2_record_word shaker2_record_bits(shaker2_real value)
{
    union { shaker2_real real; shaker2_record_word word; } both;
    both.real = value;
    return both.word;
}

SHAKER2_CODE
static void shaker2_record_begin(shaker2_page *page, shaker2_recorder *log)
{
    page->log = log;
    page->check = SHAKER2_RECORD_BASIS;
    page->used = 0;
}

SHAKER2_CODE
static void shaker2_record_flush(shaker2_page *page)
{
    if (page->log != NULL && page->used > 0 && page->log->write(page->log->context, page->bytes, page->used) != 0) {
        ++page->log->lost;
    }
    page->used = 0;
}

/* The lowest bytes of a word, least significant first. */
SHAKER2_CODE
static void shaker2_record_put(shaker2_page *page, shaker2_record_word value, int bytes)
{
    for (int i = 0; i < bytes; ++i) {
        const unsigned char byte = (unsigned char)(value & 0xffu);
        if (page->used == sizeof page->bytes) {
            shaker2_record_flush(page);
        }
        page->bytes[page->used++] = byte;
        page->check = (page->check ^ byte) * SHAKER2_RECORD_PRIME;
        value >>= 8;
    }
}

SHAKER2_CODE
static void shaker2_record_put_reals(shaker2_page *page, const shaker2_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        shaker2_record_put(page, shaker2_record_bits(values[i]), SHAKER2_RECORD_REAL_BYTES);
    }
}

SHAKER2_CODE
static void shaker2_record_put_bytes(shaker2_page *page, const unsigned char *bytes, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        shaker2_record_put(page, bytes[i], 1);
    }
}

/* Appends the check and writes the waiting bytes. */
SHAKER2_CODE
static void shaker2_record_end(shaker2_page *page)
{
    shaker2_record_put(page, page->check, 4);
    shaker2_record_flush(page);
}

SHAKER2_CODE
static void shaker2_record_put_row(shaker2_page *page, const shaker2_row *from)
{
    shaker2_record_put_reals(page, from->mu_c, 3);
    shaker2_record_put_reals(page, from->mu_s, 3);
    shaker2_record_put_reals(page, from->J_c, 6);
    shaker2_record_put_reals(page, from->J_s, 6);
    shaker2_record_put_reals(page, from->J_2c, 6);
    shaker2_record_put_reals(page, from->J_2s, 6);
    shaker2_record_put_reals(page, from->t_0, 3);
    shaker2_record_put_reals(page, from->t_c, 3);
    shaker2_record_put_reals(page, from->t_s, 3);
    shaker2_record_put_reals(page, &from->spin, 1);
    shaker2_record_put_reals(page, &from->spin_inv, 1);
    shaker2_record_put_reals(page, &from->spin_root_inv, 1);
}

SHAKER2_CODE
static void shaker2_record_put_suspension(shaker2_page *page, const shaker2_suspension *from)
{
    for (int i = 0; i < 6; ++i) {
        shaker2_record_put_reals(page, from->stiffness[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        shaker2_record_put_reals(page, from->damping[i], 6);
    }
    shaker2_record_put_reals(page, from->position, 3);
    shaker2_record_put_reals(page, from->attitude, 4);
}

SHAKER2_CODE
static void shaker2_record_put_table(shaker2_page *page, const shaker2_table *from)
{
    shaker2_record_put_reals(page, &from->mass, 1);
    shaker2_record_put_reals(page, &from->mass_inverse, 1);
    shaker2_record_put_reals(page, from->first_moment, 3);
    shaker2_record_put_reals(page, from->inertia, 6);
    for (int i = 0; i < SHAKER2_N; ++i) {
        shaker2_record_put_row(page, &from->flywheel[i]);
    }
    shaker2_record_put_reals(page, from->gravity, 3);
    shaker2_record_put_suspension(page, &from->suspension);
}

/* The hash of a state so far, and one word more. */
SHAKER2_CODE
static uint32_t shaker2_record_mix(uint32_t hash, uint32_t word)
{
    const uint32_t turned = ((hash << 5) & 0xffffffffu) | (hash >> 27);
    return (turned ^ word) * SHAKER2_RECORD_PRIME;
}

SHAKER2_CODE
static uint32_t shaker2_record_hash(uint32_t hash, const shaker2_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        const shaker2_record_word word = shaker2_record_bits(values[i]);
        hash = shaker2_record_mix(hash, (uint32_t)(word & 0xffffffffu));
        hash = shaker2_record_mix(hash, (uint32_t)(word >> 32));
    }
    return hash;
}

/* The flag where two rows of numbers differ in a bit. */
SHAKER2_CODE
static unsigned shaker2_record_differs(const shaker2_real *one, const shaker2_real *other, int count, unsigned flag)
{
    shaker2_record_word bits = 0;
    for (int i = 0; i < count; ++i) {
        bits |= shaker2_record_bits(one[i]) ^ shaker2_record_bits(other[i]);
    }
    return (bits != 0u) ? flag : 0u;
}

SHAKER2_CODE
shaker2_status shaker2_recorder_start(shaker2_recorder *log, const shaker2_table *table,
                                      const shaker2_state *x)
{
    shaker2_page page;
    uint32_t check;
    if (log == NULL || table == NULL || x == NULL || log->write == NULL) {
        return SHAKER2_BAD_ARGUMENT;
    }
    shaker2_record_begin(&page, NULL);
    shaker2_record_put_table(&page, table);
    check = page.check;
    shaker2_record_begin(&page, log);
    shaker2_record_put_bytes(&page, shaker2_record_magic, sizeof shaker2_record_magic);
    shaker2_record_put(&page, SHAKER2_RECORDER_FORMAT, 1);
    shaker2_record_put(&page, SHAKER2_RECORD_REAL_BYTES, 1);
    shaker2_record_put(&page, sizeof shaker2_record_name, 1);
    shaker2_record_put_bytes(&page, shaker2_record_name, sizeof shaker2_record_name);
    shaker2_record_put(&page, SHAKER2_STRUCTURE, 4);
    shaker2_record_put(&page, SHAKER2_PHYSICS, 4);
    shaker2_record_put(&page, SHAKER2_RECORDER_SOURCE, 4);
    shaker2_record_put(&page, SHAKER2_N, 2);
    shaker2_record_put(&page, 0, 2);
    shaker2_record_put(&page, check, 4);
    shaker2_record_put(&page, log->count, 4);
    shaker2_record_put_reals(&page, x->position, 3);
    shaker2_record_put_reals(&page, x->attitude, 4);
    shaker2_record_put_reals(&page, x->V, 6);
    shaker2_record_put_reals(&page, x->phi, SHAKER2_N);
    shaker2_record_put_reals(&page, x->phi_dot, SHAKER2_N);
    if (check == SHAKER2_TABLE_HASH) {
        shaker2_record_put(&page, 0, 4);
    } else {
        shaker2_record_put(&page, SHAKER2_RECORD_TABLE_BYTES, 4);
        shaker2_record_put_table(&page, table);
    }
    shaker2_record_end(&page);
    log->seen = *x;
    for (int i = 0; i < 17; ++i) {
        log->carry.rounding[i] = (shaker2_real)0;
    }
    log->fresh = 1;
    return SHAKER2_OK;
}

/* Flags of what changed since the last step: members of the state, dt and order. The log remembers the new values. */
SHAKER2_CODE
static unsigned shaker2_notice_changes(shaker2_recorder *log, const shaker2_state *x,
                                  shaker2_real dt, int order)
{
    const shaker2_record_word step = shaker2_record_bits(dt);
    unsigned flags = 0;
    flags |= shaker2_record_differs(x->position, log->seen.position, 3, SHAKER2_RECORD_POSITION);
    flags |= shaker2_record_differs(x->attitude, log->seen.attitude, 4, SHAKER2_RECORD_ATTITUDE);
    flags |= shaker2_record_differs(x->V, log->seen.V, 6, SHAKER2_RECORD_V);
    flags |= shaker2_record_differs(x->phi, log->seen.phi, SHAKER2_N, SHAKER2_RECORD_PHI);
    flags |= shaker2_record_differs(x->phi_dot, log->seen.phi_dot, SHAKER2_N, SHAKER2_RECORD_PHI_DOT);
    if (log->fresh || step != log->dt || order != log->order) {
        flags |= SHAKER2_RECORD_SETTINGS;
    }
    log->fresh = 0;
    log->dt = step;
    log->order = order;
    return flags;
}

/* The head of a step's record: flags, and what changed. */
SHAKER2_CODE
static void shaker2_record_head(shaker2_page *page, shaker2_recorder *log, const shaker2_state *x, unsigned flags)
{
    shaker2_record_begin(page, log);
    shaker2_record_put(page, SHAKER2_RECORD_STEP, 1);
    shaker2_record_put(page, flags, 2);
    shaker2_record_put(page, log->count, 4);
    if (flags & SHAKER2_RECORD_SETTINGS) {
        shaker2_record_put(page, log->dt, SHAKER2_RECORD_REAL_BYTES);
        shaker2_record_put(page, (shaker2_record_word)log->order, 4);
    }
    if (flags & SHAKER2_RECORD_POSITION) {
        shaker2_record_put_reals(page, x->position, 3);
    }
    if (flags & SHAKER2_RECORD_ATTITUDE) {
        shaker2_record_put_reals(page, x->attitude, 4);
    }
    if (flags & SHAKER2_RECORD_V) {
        shaker2_record_put_reals(page, x->V, 6);
    }
    if (flags & SHAKER2_RECORD_PHI) {
        shaker2_record_put_reals(page, x->phi, SHAKER2_N);
    }
    if (flags & SHAKER2_RECORD_PHI_DOT) {
        shaker2_record_put_reals(page, x->phi_dot, SHAKER2_N);
    }
    if (flags & SHAKER2_RECORD_CARRY) {
        shaker2_record_put_reals(page, log->carry.rounding, 17);
    }
}

/* The tail: status and the hash of the state after the step, and of its carry if there is one. */
SHAKER2_CODE
static void shaker2_record_result(shaker2_page *page, shaker2_recorder *log,
                              const shaker2_state *x, const shaker2_step_carry *carry, shaker2_status status)
{
    uint32_t hash = SHAKER2_RECORD_BASIS;
    hash = shaker2_record_hash(hash, x->position, 3);
    hash = shaker2_record_hash(hash, x->attitude, 4);
    hash = shaker2_record_hash(hash, x->V, 6);
    hash = shaker2_record_hash(hash, x->phi, SHAKER2_N);
    hash = shaker2_record_hash(hash, x->phi_dot, SHAKER2_N);
    if (carry != NULL) {
        hash = shaker2_record_hash(hash, carry->rounding, 17);
        log->carry = *carry;
    }
    log->seen = *x;
    shaker2_record_put(page, (shaker2_record_word)status, 1);
    shaker2_record_put(page, hash, 4);
    shaker2_record_end(page);
    ++log->count;
}

SHAKER2_CODE
shaker2_status shaker2_recorder_step(shaker2_recorder *log, const shaker2_table *table, shaker2_state *x,
                                     const shaker2_real tau[SHAKER2_N], const int locked[SHAKER2_N],
                                     shaker2_real dt, int order)
{
    shaker2_page page;
    shaker2_status status;
    unsigned flags = 0;
    if (log == NULL || table == NULL || x == NULL || tau == NULL
        || log->write == NULL) { return SHAKER2_BAD_ARGUMENT; }
    for (int s = 0; s < SHAKER2_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? SHAKER2_RECORD_LOCKS : 0u;
    }
    flags |= shaker2_notice_changes(log, x, dt, order);
    shaker2_record_head(&page, log, x, flags);
    shaker2_record_put_reals(&page, tau, SHAKER2_N);
    if ((flags & SHAKER2_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < SHAKER2_N; first += SHAKER2_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < SHAKER2_N && s < first + SHAKER2_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            shaker2_record_put(&page, mask, 1);
        }
    }
    status = shaker2_step(table, x, tau, locked, dt, order, x);
    shaker2_record_result(&page, log, x, NULL, status);
    return status;
}

SHAKER2_CODE
shaker2_status shaker2_recorder_step_driven(shaker2_recorder *log, const shaker2_table *table,
                                            shaker2_state *x, const shaker2_real phi_ddot[SHAKER2_N],
                                            shaker2_real dt, int order)
{
    shaker2_page page;
    shaker2_status status;
    unsigned flags = SHAKER2_RECORD_DRIVEN;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL
        || log->write == NULL) { return SHAKER2_BAD_ARGUMENT; }
    flags |= shaker2_notice_changes(log, x, dt, order);
    shaker2_record_head(&page, log, x, flags);
    shaker2_record_put_reals(&page, phi_ddot, SHAKER2_N);
    status = shaker2_step_driven(table, x, phi_ddot, dt, order, x);
    shaker2_record_result(&page, log, x, NULL, status);
    return status;
}

SHAKER2_CODE
shaker2_status shaker2_recorder_step_carried(shaker2_recorder *log, const shaker2_table *table,
                                             shaker2_state *x, const shaker2_real tau[SHAKER2_N],
                                             const int locked[SHAKER2_N], shaker2_real dt, int order,
                                             shaker2_step_carry *carry)
{
    shaker2_page page;
    shaker2_status status;
    unsigned flags = SHAKER2_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || tau == NULL || carry == NULL
        || log->write == NULL) { return SHAKER2_BAD_ARGUMENT; }
    for (int s = 0; s < SHAKER2_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? SHAKER2_RECORD_LOCKS : 0u;
    }
    flags |= shaker2_notice_changes(log, x, dt, order);
    flags |= shaker2_record_differs(carry->rounding, log->carry.rounding, 17, SHAKER2_RECORD_CARRY);
    log->carry = *carry;
    shaker2_record_head(&page, log, x, flags);
    shaker2_record_put_reals(&page, tau, SHAKER2_N);
    if ((flags & SHAKER2_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < SHAKER2_N; first += SHAKER2_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < SHAKER2_N && s < first + SHAKER2_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            shaker2_record_put(&page, mask, 1);
        }
    }
    status = shaker2_step_carried(table, x, tau, locked, dt, order, carry, x);
    shaker2_record_result(&page, log, x, carry, status);
    return status;
}

SHAKER2_CODE
shaker2_status shaker2_recorder_step_driven_carried(shaker2_recorder *log, const shaker2_table *table,
                                                    shaker2_state *x, const shaker2_real phi_ddot[SHAKER2_N],
                                                    shaker2_real dt, int order, shaker2_step_carry *carry)
{
    shaker2_page page;
    shaker2_status status;
    unsigned flags = SHAKER2_RECORD_DRIVEN | SHAKER2_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL || carry == NULL
        || log->write == NULL) { return SHAKER2_BAD_ARGUMENT; }
    flags |= shaker2_notice_changes(log, x, dt, order);
    flags |= shaker2_record_differs(carry->rounding, log->carry.rounding, 17, SHAKER2_RECORD_CARRY);
    log->carry = *carry;
    shaker2_record_head(&page, log, x, flags);
    shaker2_record_put_reals(&page, phi_ddot, SHAKER2_N);
    status = shaker2_step_driven_carried(table, x, phi_ddot, dt, order, carry, x);
    shaker2_record_result(&page, log, x, carry, status);
    return status;
}
