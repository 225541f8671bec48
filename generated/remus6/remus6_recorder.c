/* remus6_recorder.c: flight recorder of the stand "remus6". What a log holds: remus6_recorder.h.
 * mahovik 0.1.0; structure 3687deee, physics 5f25aea2. Generated: change the stand file instead. */
#include "remus6_recorder.h"

#if REMUS6_STRUCTURE != 0x3687deeeu || REMUS6_PHYSICS != 0x5f25aea2u
#error "remus6.h and remus6_recorder.c are of different stands"
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

#ifndef REMUS6_CODE
#define REMUS6_CODE
#endif

/* Header and recorder use the same real type: otherwise this array has a negative size. */
typedef char remus6_recorder_real[(sizeof(remus6_real) == 8) ? 1 : -1];

typedef uint64_t remus6_record_word;  /* the bits of a real */

/* Sizes in bytes, and the first byte of a step's record. */
enum {
    REMUS6_RECORD_STEP = 0x53,
    REMUS6_RECORD_REAL_BYTES = 8,
    REMUS6_RECORD_TABLE_BYTES = 2728,
    REMUS6_RECORD_LOCKS_A_BYTE = 8
};

/* FNV-1a, 32 bits. */
#define REMUS6_RECORD_BASIS 2166136261u
#define REMUS6_RECORD_PRIME 16777619u

/* A record being written: the bytes that wait for write, and their hash so far. Without a log nothing is written. */
typedef struct remus6_page {
    remus6_recorder *log;
    uint32_t check;
    size_t used;
    unsigned char bytes[REMUS6_RECORD_BYTES];
} remus6_page;

static const unsigned char remus6_record_magic[] = { 0x89, 0x4d, 0x48, 0x56, 0x4b, 0x0d, 0x0a, 0x1a };
static const unsigned char remus6_record_name[] = {
    0x72, 0x65, 0x6d, 0x75, 0x73, 0x36
};

REMUS6_CODE
static remus6_record_word remus6_record_bits(remus6_real value)
{
    union { remus6_real real; remus6_record_word word; } both;
    both.real = value;
    return both.word;
}

REMUS6_CODE
static void remus6_record_begin(remus6_page *page, remus6_recorder *log)
{
    page->log = log;
    page->check = REMUS6_RECORD_BASIS;
    page->used = 0;
}

REMUS6_CODE
static void remus6_record_flush(remus6_page *page)
{
    if (page->log != NULL && page->used > 0 && page->log->write(page->log->context, page->bytes, page->used) != 0) {
        ++page->log->lost;
    }
    page->used = 0;
}

/* The lowest bytes of a word, least significant first. */
REMUS6_CODE
static void remus6_record_put(remus6_page *page, remus6_record_word value, int bytes)
{
    for (int i = 0; i < bytes; ++i) {
        const unsigned char byte = (unsigned char)(value & 0xffu);
        if (page->used == sizeof page->bytes) {
            remus6_record_flush(page);
        }
        page->bytes[page->used++] = byte;
        page->check = (page->check ^ byte) * REMUS6_RECORD_PRIME;
        value >>= 8;
    }
}

REMUS6_CODE
static void remus6_record_put_reals(remus6_page *page, const remus6_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        remus6_record_put(page, remus6_record_bits(values[i]), REMUS6_RECORD_REAL_BYTES);
    }
}

REMUS6_CODE
static void remus6_record_put_bytes(remus6_page *page, const unsigned char *bytes, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        remus6_record_put(page, bytes[i], 1);
    }
}

/* Appends the check and writes the waiting bytes. */
REMUS6_CODE
static void remus6_record_end(remus6_page *page)
{
    remus6_record_put(page, page->check, 4);
    remus6_record_flush(page);
}

REMUS6_CODE
static void remus6_record_put_row(remus6_page *page, const remus6_row *from)
{
    remus6_record_put_reals(page, from->mu_c, 3);
    remus6_record_put_reals(page, from->mu_s, 3);
    remus6_record_put_reals(page, from->J_c, 6);
    remus6_record_put_reals(page, from->J_s, 6);
    remus6_record_put_reals(page, from->J_2c, 6);
    remus6_record_put_reals(page, from->J_2s, 6);
    remus6_record_put_reals(page, from->t_0, 3);
    remus6_record_put_reals(page, from->t_c, 3);
    remus6_record_put_reals(page, from->t_s, 3);
    remus6_record_put_reals(page, &from->spin, 1);
    remus6_record_put_reals(page, &from->spin_inv, 1);
    remus6_record_put_reals(page, &from->spin_root_inv, 1);
}

REMUS6_CODE
static void remus6_record_put_sensor(remus6_page *page, const remus6_sensor *from)
{
    remus6_record_put_reals(page, from->origin, 3);
    remus6_record_put_reals(page, from->axes, 9);
}

REMUS6_CODE
static void remus6_record_put_damper(remus6_page *page, const remus6_damper *from)
{
    remus6_record_put(page, (remus6_record_word)from->first_term, 4);
    remus6_record_put(page, (remus6_record_word)from->last_term, 4);
}

REMUS6_CODE
static void remus6_record_put_term(remus6_page *page, const remus6_term *from)
{
    remus6_record_put(page, (remus6_record_word)from->wrench, 4);
    remus6_record_put(page, (remus6_record_word)from->first, 4);
    remus6_record_put(page, (remus6_record_word)from->second, 4);
    remus6_record_put_reals(page, &from->value, 1);
}

REMUS6_CODE
static void remus6_record_put_table(remus6_page *page, const remus6_table *from)
{
    remus6_record_put_reals(page, &from->mass, 1);
    remus6_record_put_reals(page, &from->mass_inverse, 1);
    remus6_record_put_reals(page, from->first_moment, 3);
    remus6_record_put_reals(page, from->inertia, 6);
    remus6_record_put_reals(page, from->A, 6);
    remus6_record_put_reals(page, from->A_inv, 6);
    remus6_record_put_reals(page, from->G, 9);
    remus6_record_put_reals(page, &from->weight_mass, 1);
    remus6_record_put_reals(page, from->displaced_moment, 3);
    for (int i = 0; i < REMUS6_N; ++i) {
        remus6_record_put_row(page, &from->flywheel[i]);
    }
    for (int i = 0; i < REMUS6_SENSORS; ++i) {
        remus6_record_put_sensor(page, &from->sensor[i]);
    }
    remus6_record_put_reals(page, from->gravity, 3);
    remus6_record_put_damper(page, &from->damper);
    for (int i = 0; i < 10; ++i) {
        remus6_record_put_term(page, &from->term[i]);
    }
}

/* The hash of a state so far, and one word more. */
REMUS6_CODE
static uint32_t remus6_record_mix(uint32_t hash, uint32_t word)
{
    const uint32_t turned = ((hash << 5) & 0xffffffffu) | (hash >> 27);
    return (turned ^ word) * REMUS6_RECORD_PRIME;
}

REMUS6_CODE
static uint32_t remus6_record_hash(uint32_t hash, const remus6_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        const remus6_record_word word = remus6_record_bits(values[i]);
        hash = remus6_record_mix(hash, (uint32_t)(word & 0xffffffffu));
        hash = remus6_record_mix(hash, (uint32_t)(word >> 32));
    }
    return hash;
}

/* The flag where two rows of numbers differ in a bit. */
REMUS6_CODE
static unsigned remus6_record_differs(const remus6_real *one, const remus6_real *other, int count, unsigned flag)
{
    remus6_record_word bits = 0;
    for (int i = 0; i < count; ++i) {
        bits |= remus6_record_bits(one[i]) ^ remus6_record_bits(other[i]);
    }
    return (bits != 0u) ? flag : 0u;
}

REMUS6_CODE
remus6_status remus6_recorder_start(remus6_recorder *log, const remus6_table *table, const remus6_state *x)
{
    remus6_page page;
    uint32_t check;
    if (log == NULL || table == NULL || x == NULL || log->write == NULL) {
        return REMUS6_BAD_ARGUMENT;
    }
    remus6_record_begin(&page, NULL);
    remus6_record_put_table(&page, table);
    check = page.check;
    remus6_record_begin(&page, log);
    remus6_record_put_bytes(&page, remus6_record_magic, sizeof remus6_record_magic);
    remus6_record_put(&page, REMUS6_RECORDER_FORMAT, 1);
    remus6_record_put(&page, REMUS6_RECORD_REAL_BYTES, 1);
    remus6_record_put(&page, sizeof remus6_record_name, 1);
    remus6_record_put_bytes(&page, remus6_record_name, sizeof remus6_record_name);
    remus6_record_put(&page, REMUS6_STRUCTURE, 4);
    remus6_record_put(&page, REMUS6_PHYSICS, 4);
    remus6_record_put(&page, REMUS6_RECORDER_SOURCE, 4);
    remus6_record_put(&page, REMUS6_N, 2);
    remus6_record_put(&page, 0, 2);
    remus6_record_put(&page, check, 4);
    remus6_record_put(&page, log->count, 4);
    remus6_record_put_reals(&page, x->position, 3);
    remus6_record_put_reals(&page, x->attitude, 4);
    remus6_record_put_reals(&page, x->V, 6);
    remus6_record_put_reals(&page, x->phi, REMUS6_N);
    remus6_record_put_reals(&page, x->phi_dot, REMUS6_N);
    if (check == REMUS6_TABLE_HASH) {
        remus6_record_put(&page, 0, 4);
    } else {
        remus6_record_put(&page, REMUS6_RECORD_TABLE_BYTES, 4);
        remus6_record_put_table(&page, table);
    }
    remus6_record_end(&page);
    log->seen = *x;
    for (int i = 0; i < 25; ++i) {
        log->carry.rounding[i] = (remus6_real)0;
    }
    log->fresh = 1;
    return REMUS6_OK;
}

/* Flags of what changed since the last step: members of the state, dt and order, stream. The log remembers the new values. */
REMUS6_CODE
static unsigned remus6_notice_changes(remus6_recorder *log, const remus6_table *table, const remus6_state *x,
                                  remus6_real dt, int order)
{
    const remus6_record_word step = remus6_record_bits(dt);
    unsigned flags = 0;
    flags |= remus6_record_differs(x->position, log->seen.position, 3, REMUS6_RECORD_POSITION);
    flags |= remus6_record_differs(x->attitude, log->seen.attitude, 4, REMUS6_RECORD_ATTITUDE);
    flags |= remus6_record_differs(x->V, log->seen.V, 6, REMUS6_RECORD_V);
    flags |= remus6_record_differs(x->phi, log->seen.phi, REMUS6_N, REMUS6_RECORD_PHI);
    flags |= remus6_record_differs(x->phi_dot, log->seen.phi_dot, REMUS6_N, REMUS6_RECORD_PHI_DOT);
    if (log->fresh || step != log->dt || order != log->order) {
        flags |= REMUS6_RECORD_SETTINGS;
    }
    for (int i = 0; i < 3; ++i) {
        const remus6_record_word now = remus6_record_bits(table->stream[i]);
        flags |= (log->fresh || now != log->stream[i]) ? REMUS6_RECORD_STREAM : 0u;
        log->stream[i] = now;
    }
    log->fresh = 0;
    log->dt = step;
    log->order = order;
    return flags;
}

/* The head of a step's record: flags, and what changed. */
REMUS6_CODE
static void remus6_record_head(remus6_page *page, remus6_recorder *log, const remus6_state *x, unsigned flags)
{
    remus6_record_begin(page, log);
    remus6_record_put(page, REMUS6_RECORD_STEP, 1);
    remus6_record_put(page, flags, 2);
    remus6_record_put(page, log->count, 4);
    if (flags & REMUS6_RECORD_SETTINGS) {
        remus6_record_put(page, log->dt, REMUS6_RECORD_REAL_BYTES);
        remus6_record_put(page, (remus6_record_word)log->order, 4);
    }
    if (flags & REMUS6_RECORD_POSITION) {
        remus6_record_put_reals(page, x->position, 3);
    }
    if (flags & REMUS6_RECORD_ATTITUDE) {
        remus6_record_put_reals(page, x->attitude, 4);
    }
    if (flags & REMUS6_RECORD_V) {
        remus6_record_put_reals(page, x->V, 6);
    }
    if (flags & REMUS6_RECORD_PHI) {
        remus6_record_put_reals(page, x->phi, REMUS6_N);
    }
    if (flags & REMUS6_RECORD_PHI_DOT) {
        remus6_record_put_reals(page, x->phi_dot, REMUS6_N);
    }
    if (flags & REMUS6_RECORD_STREAM) {
        for (int i = 0; i < 3; ++i) {
            remus6_record_put(page, log->stream[i], REMUS6_RECORD_REAL_BYTES);
        }
    }
    if (flags & REMUS6_RECORD_CARRY) {
        remus6_record_put_reals(page, log->carry.rounding, 25);
    }
}

/* The tail: status and the hash of the state after the step, and of its carry if there is one. */
REMUS6_CODE
static void remus6_record_result(remus6_page *page, remus6_recorder *log,
                              const remus6_state *x, const remus6_step_carry *carry, remus6_status status)
{
    uint32_t hash = REMUS6_RECORD_BASIS;
    hash = remus6_record_hash(hash, x->position, 3);
    hash = remus6_record_hash(hash, x->attitude, 4);
    hash = remus6_record_hash(hash, x->V, 6);
    hash = remus6_record_hash(hash, x->phi, REMUS6_N);
    hash = remus6_record_hash(hash, x->phi_dot, REMUS6_N);
    if (carry != NULL) {
        hash = remus6_record_hash(hash, carry->rounding, 25);
        log->carry = *carry;
    }
    log->seen = *x;
    remus6_record_put(page, (remus6_record_word)status, 1);
    remus6_record_put(page, hash, 4);
    remus6_record_end(page);
    ++log->count;
}

REMUS6_CODE
remus6_status remus6_recorder_step(remus6_recorder *log, const remus6_table *table, remus6_state *x,
                                   const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                                   remus6_real dt, int order)
{
    remus6_page page;
    remus6_status status;
    unsigned flags = 0;
    if (log == NULL || table == NULL || x == NULL || tau == NULL
        || log->write == NULL) { return REMUS6_BAD_ARGUMENT; }
    for (int s = 0; s < REMUS6_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? REMUS6_RECORD_LOCKS : 0u;
    }
    flags |= remus6_notice_changes(log, table, x, dt, order);
    remus6_record_head(&page, log, x, flags);
    remus6_record_put_reals(&page, tau, REMUS6_N);
    if ((flags & REMUS6_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < REMUS6_N; first += REMUS6_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < REMUS6_N && s < first + REMUS6_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            remus6_record_put(&page, mask, 1);
        }
    }
    status = remus6_step(table, x, tau, locked, dt, order, x);
    remus6_record_result(&page, log, x, NULL, status);
    return status;
}

REMUS6_CODE
remus6_status remus6_recorder_step_driven(remus6_recorder *log, const remus6_table *table, remus6_state *x,
                                          const remus6_real phi_ddot[REMUS6_N], remus6_real dt, int order)
{
    remus6_page page;
    remus6_status status;
    unsigned flags = REMUS6_RECORD_DRIVEN;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL
        || log->write == NULL) { return REMUS6_BAD_ARGUMENT; }
    flags |= remus6_notice_changes(log, table, x, dt, order);
    remus6_record_head(&page, log, x, flags);
    remus6_record_put_reals(&page, phi_ddot, REMUS6_N);
    status = remus6_step_driven(table, x, phi_ddot, dt, order, x);
    remus6_record_result(&page, log, x, NULL, status);
    return status;
}

REMUS6_CODE
remus6_status remus6_recorder_step_carried(remus6_recorder *log, const remus6_table *table, remus6_state *x,
                                           const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                                           remus6_real dt, int order, remus6_step_carry *carry)
{
    remus6_page page;
    remus6_status status;
    unsigned flags = REMUS6_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || tau == NULL || carry == NULL
        || log->write == NULL) { return REMUS6_BAD_ARGUMENT; }
    for (int s = 0; s < REMUS6_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? REMUS6_RECORD_LOCKS : 0u;
    }
    flags |= remus6_notice_changes(log, table, x, dt, order);
    flags |= remus6_record_differs(carry->rounding, log->carry.rounding, 25, REMUS6_RECORD_CARRY);
    log->carry = *carry;
    remus6_record_head(&page, log, x, flags);
    remus6_record_put_reals(&page, tau, REMUS6_N);
    if ((flags & REMUS6_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < REMUS6_N; first += REMUS6_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < REMUS6_N && s < first + REMUS6_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            remus6_record_put(&page, mask, 1);
        }
    }
    status = remus6_step_carried(table, x, tau, locked, dt, order, carry, x);
    remus6_record_result(&page, log, x, carry, status);
    return status;
}

REMUS6_CODE
remus6_status remus6_recorder_step_driven_carried(remus6_recorder *log, const remus6_table *table,
                                                  remus6_state *x, const remus6_real phi_ddot[REMUS6_N],
                                                  remus6_real dt, int order, remus6_step_carry *carry)
{
    remus6_page page;
    remus6_status status;
    unsigned flags = REMUS6_RECORD_DRIVEN | REMUS6_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL || carry == NULL
        || log->write == NULL) { return REMUS6_BAD_ARGUMENT; }
    flags |= remus6_notice_changes(log, table, x, dt, order);
    flags |= remus6_record_differs(carry->rounding, log->carry.rounding, 25, REMUS6_RECORD_CARRY);
    log->carry = *carry;
    remus6_record_head(&page, log, x, flags);
    remus6_record_put_reals(&page, phi_ddot, REMUS6_N);
    status = remus6_step_driven_carried(table, x, phi_ddot, dt, order, carry, x);
    remus6_record_result(&page, log, x, carry, status);
    return status;
}
