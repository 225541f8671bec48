/* sat4_recorder.c: flight recorder of the stand "sat4". What a log holds: sat4_recorder.h.
 * mahovik 0.1.0; structure f28a1ef8, physics e77ec5a4. Generated: change the stand file instead. */
#include "sat4_recorder.h"

#if SAT4_STRUCTURE != 0xf28a1ef8u || SAT4_PHYSICS != 0xe77ec5a4u
#error "sat4.h and sat4_recorder.c are of different stands"
#endif

#include <float.h>
#include <limits.h>

/* Other numbers than those of IEEE 754, and fast math, which leaves out roundings that the code relies on,
 * give wrong results with status OK. What the compiler shows of them is refused here; clang does not show
 * -funsafe-math-optimizations. */
#if FLT_RADIX != 2 || DBL_MANT_DIG != 53
#error "wrong results: sat4 needs a double of 64 bits, 53 of them significant"
#endif
#if INT_MAX < 2147483647
#error "wrong counts: sat4 needs an int of 32 bits"
#endif
#ifndef SAT4_ALLOW_FAST_MATH
#if defined __FAST_MATH__ || defined __ASSOCIATIVE_MATH__ || defined __RECIPROCAL_MATH__ || defined _M_FP_FAST
#error "wrong results: compile sat4 without -ffast-math, -Ofast and -funsafe-math-optimizations"
#elif FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1 && FLT_EVAL_METHOD != 16
#error "wrong results: x87 keeps more digits: compile sat4 with -msse2 -mfpmath=sse"
#endif
#if defined __FINITE_MATH_ONLY__ && __FINITE_MATH_ONLY__ == 1
#error "inputs that are NaN would pass: compile sat4 without -ffinite-math-only"
#endif
#endif

#ifndef SAT4_CODE
#define SAT4_CODE
#endif

/* Header and recorder use the same real type: otherwise this array has a negative size. */
typedef char sat4_recorder_real[(sizeof(sat4_real) == 8) ? 1 : -1];

typedef uint64_t sat4_record_word;  /* the bits of a real */

/* Sizes in bytes, and the first byte of a step's record. */
enum {
    SAT4_RECORD_STEP = 0x53,
    SAT4_RECORD_REAL_BYTES = 8,
    SAT4_RECORD_TABLE_BYTES = 1528,
    SAT4_RECORD_LOCKS_A_BYTE = 8
};

/* FNV-1a, 32 bits. */
#define SAT4_RECORD_BASIS 2166136261u
#define SAT4_RECORD_PRIME 16777619u

/* A record being written: the bytes that wait for write, and their hash so far. Without a log nothing is written. */
typedef struct sat4_page {
    sat4_recorder *log;
    uint32_t check;
    size_t used;
    unsigned char bytes[SAT4_RECORD_BYTES];
} sat4_page;

static const unsigned char sat4_record_magic[] = { 0x89, 0x4d, 0x48, 0x56, 0x4b, 0x0d, 0x0a, 0x1a };
static const unsigned char sat4_record_name[] = {
    0x73, 0x61, 0x74, 0x34
};

SAT4_CODE
static sat4_record_word sat4_record_bits(sat4_real value)
{
    union { sat4_real real; sat4_record_word word; } both;
    both.real = value;
    return both.word;
}

SAT4_CODE
static void sat4_record_begin(sat4_page *page, sat4_recorder *log)
{
    page->log = log;
    page->check = SAT4_RECORD_BASIS;
    page->used = 0;
}

SAT4_CODE
static void sat4_record_flush(sat4_page *page)
{
    if (page->log != NULL && page->used > 0 && page->log->write(page->log->context, page->bytes, page->used) != 0) {
        ++page->log->lost;
    }
    page->used = 0;
}

/* The lowest bytes of a word, least significant first. */
SAT4_CODE
static void sat4_record_put(sat4_page *page, sat4_record_word value, int bytes)
{
    for (int i = 0; i < bytes; ++i) {
        const unsigned char byte = (unsigned char)(value & 0xffu);
        if (page->used == sizeof page->bytes) {
            sat4_record_flush(page);
        }
        page->bytes[page->used++] = byte;
        page->check = (page->check ^ byte) * SAT4_RECORD_PRIME;
        value >>= 8;
    }
}

SAT4_CODE
static void sat4_record_put_reals(sat4_page *page, const sat4_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        sat4_record_put(page, sat4_record_bits(values[i]), SAT4_RECORD_REAL_BYTES);
    }
}

SAT4_CODE
static void sat4_record_put_bytes(sat4_page *page, const unsigned char *bytes, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        sat4_record_put(page, bytes[i], 1);
    }
}

/* Appends the check and writes the waiting bytes. */
SAT4_CODE
static void sat4_record_end(sat4_page *page)
{
    sat4_record_put(page, page->check, 4);
    sat4_record_flush(page);
}

SAT4_CODE
static void sat4_record_put_row(sat4_page *page, const sat4_row *from)
{
    sat4_record_put_reals(page, from->mu_c, 3);
    sat4_record_put_reals(page, from->mu_s, 3);
    sat4_record_put_reals(page, from->J_c, 6);
    sat4_record_put_reals(page, from->J_s, 6);
    sat4_record_put_reals(page, from->J_2c, 6);
    sat4_record_put_reals(page, from->J_2s, 6);
    sat4_record_put_reals(page, from->t_0, 3);
    sat4_record_put_reals(page, from->t_c, 3);
    sat4_record_put_reals(page, from->t_s, 3);
    sat4_record_put_reals(page, &from->spin, 1);
    sat4_record_put_reals(page, &from->spin_inv, 1);
    sat4_record_put_reals(page, &from->spin_root_inv, 1);
}

SAT4_CODE
static void sat4_record_put_sensor(sat4_page *page, const sat4_sensor *from)
{
    sat4_record_put_reals(page, from->origin, 3);
    sat4_record_put_reals(page, from->axes, 9);
}

SAT4_CODE
static void sat4_record_put_table(sat4_page *page, const sat4_table *from)
{
    sat4_record_put_reals(page, &from->mass, 1);
    sat4_record_put_reals(page, &from->mass_inverse, 1);
    sat4_record_put_reals(page, from->first_moment, 3);
    sat4_record_put_reals(page, from->inertia, 6);
    for (int i = 0; i < SAT4_N; ++i) {
        sat4_record_put_row(page, &from->flywheel[i]);
    }
    for (int i = 0; i < SAT4_SENSORS; ++i) {
        sat4_record_put_sensor(page, &from->sensor[i]);
    }
}

/* The hash of a state so far, and one word more. */
SAT4_CODE
static uint32_t sat4_record_mix(uint32_t hash, uint32_t word)
{
    const uint32_t turned = ((hash << 5) & 0xffffffffu) | (hash >> 27);
    return (turned ^ word) * SAT4_RECORD_PRIME;
}

SAT4_CODE
static uint32_t sat4_record_hash(uint32_t hash, const sat4_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        const sat4_record_word word = sat4_record_bits(values[i]);
        hash = sat4_record_mix(hash, (uint32_t)(word & 0xffffffffu));
        hash = sat4_record_mix(hash, (uint32_t)(word >> 32));
    }
    return hash;
}

/* The flag where two rows of numbers differ in a bit. */
SAT4_CODE
static unsigned sat4_record_differs(const sat4_real *one, const sat4_real *other, int count, unsigned flag)
{
    sat4_record_word bits = 0;
    for (int i = 0; i < count; ++i) {
        bits |= sat4_record_bits(one[i]) ^ sat4_record_bits(other[i]);
    }
    return (bits != 0u) ? flag : 0u;
}

SAT4_CODE
sat4_status sat4_recorder_start(sat4_recorder *log, const sat4_table *table, const sat4_state *x)
{
    sat4_page page;
    uint32_t check;
    if (log == NULL || table == NULL || x == NULL || log->write == NULL) {
        return SAT4_BAD_ARGUMENT;
    }
    sat4_record_begin(&page, NULL);
    sat4_record_put_table(&page, table);
    check = page.check;
    sat4_record_begin(&page, log);
    sat4_record_put_bytes(&page, sat4_record_magic, sizeof sat4_record_magic);
    sat4_record_put(&page, SAT4_RECORDER_FORMAT, 1);
    sat4_record_put(&page, SAT4_RECORD_REAL_BYTES, 1);
    sat4_record_put(&page, sizeof sat4_record_name, 1);
    sat4_record_put_bytes(&page, sat4_record_name, sizeof sat4_record_name);
    sat4_record_put(&page, SAT4_STRUCTURE, 4);
    sat4_record_put(&page, SAT4_PHYSICS, 4);
    sat4_record_put(&page, SAT4_RECORDER_SOURCE, 4);
    sat4_record_put(&page, SAT4_N, 2);
    sat4_record_put(&page, 0, 2);
    sat4_record_put(&page, check, 4);
    sat4_record_put(&page, log->count, 4);
    sat4_record_put_reals(&page, x->position, 3);
    sat4_record_put_reals(&page, x->attitude, 4);
    sat4_record_put_reals(&page, x->V, 6);
    sat4_record_put_reals(&page, x->phi, SAT4_N);
    sat4_record_put_reals(&page, x->phi_dot, SAT4_N);
    if (check == SAT4_TABLE_HASH) {
        sat4_record_put(&page, 0, 4);
    } else {
        sat4_record_put(&page, SAT4_RECORD_TABLE_BYTES, 4);
        sat4_record_put_table(&page, table);
    }
    sat4_record_end(&page);
    log->seen = *x;
    for (int i = 0; i < 21; ++i) {
        log->carry.rounding[i] = (sat4_real)0;
    }
    log->fresh = 1;
    return SAT4_OK;
}

/* Flags of what changed since the last step: members of the state, dt and order. The log remembers the new values. */
SAT4_CODE
static unsigned sat4_notice_changes(sat4_recorder *log, const sat4_state *x,
                                  sat4_real dt, int order)
{
    const sat4_record_word step = sat4_record_bits(dt);
    unsigned flags = 0;
    flags |= sat4_record_differs(x->position, log->seen.position, 3, SAT4_RECORD_POSITION);
    flags |= sat4_record_differs(x->attitude, log->seen.attitude, 4, SAT4_RECORD_ATTITUDE);
    flags |= sat4_record_differs(x->V, log->seen.V, 6, SAT4_RECORD_V);
    flags |= sat4_record_differs(x->phi, log->seen.phi, SAT4_N, SAT4_RECORD_PHI);
    flags |= sat4_record_differs(x->phi_dot, log->seen.phi_dot, SAT4_N, SAT4_RECORD_PHI_DOT);
    if (log->fresh || step != log->dt || order != log->order) {
        flags |= SAT4_RECORD_SETTINGS;
    }
    log->fresh = 0;
    log->dt = step;
    log->order = order;
    return flags;
}

/* The head of a step's record: flags, and what changed. */
SAT4_CODE
static void sat4_record_head(sat4_page *page, sat4_recorder *log, const sat4_state *x, unsigned flags)
{
    sat4_record_begin(page, log);
    sat4_record_put(page, SAT4_RECORD_STEP, 1);
    sat4_record_put(page, flags, 2);
    sat4_record_put(page, log->count, 4);
    if (flags & SAT4_RECORD_SETTINGS) {
        sat4_record_put(page, log->dt, SAT4_RECORD_REAL_BYTES);
        sat4_record_put(page, (sat4_record_word)log->order, 4);
    }
    if (flags & SAT4_RECORD_POSITION) {
        sat4_record_put_reals(page, x->position, 3);
    }
    if (flags & SAT4_RECORD_ATTITUDE) {
        sat4_record_put_reals(page, x->attitude, 4);
    }
    if (flags & SAT4_RECORD_V) {
        sat4_record_put_reals(page, x->V, 6);
    }
    if (flags & SAT4_RECORD_PHI) {
        sat4_record_put_reals(page, x->phi, SAT4_N);
    }
    if (flags & SAT4_RECORD_PHI_DOT) {
        sat4_record_put_reals(page, x->phi_dot, SAT4_N);
    }
    if (flags & SAT4_RECORD_CARRY) {
        sat4_record_put_reals(page, log->carry.rounding, 21);
    }
}

/* The tail: status and the hash of the state after the step, and of its carry if there is one. */
SAT4_CODE
static void sat4_record_result(sat4_page *page, sat4_recorder *log,
                              const sat4_state *x, const sat4_step_carry *carry, sat4_status status)
{
    uint32_t hash = SAT4_RECORD_BASIS;
    hash = sat4_record_hash(hash, x->position, 3);
    hash = sat4_record_hash(hash, x->attitude, 4);
    hash = sat4_record_hash(hash, x->V, 6);
    hash = sat4_record_hash(hash, x->phi, SAT4_N);
    hash = sat4_record_hash(hash, x->phi_dot, SAT4_N);
    if (carry != NULL) {
        hash = sat4_record_hash(hash, carry->rounding, 21);
        log->carry = *carry;
    }
    log->seen = *x;
    sat4_record_put(page, (sat4_record_word)status, 1);
    sat4_record_put(page, hash, 4);
    sat4_record_end(page);
    ++log->count;
}

SAT4_CODE
sat4_status sat4_recorder_step(sat4_recorder *log, const sat4_table *table, sat4_state *x,
                               const sat4_real tau[SAT4_N], const int locked[SAT4_N], sat4_real dt,
                               int order)
{
    sat4_page page;
    sat4_status status;
    unsigned flags = 0;
    if (log == NULL || table == NULL || x == NULL || tau == NULL
        || log->write == NULL) { return SAT4_BAD_ARGUMENT; }
    for (int s = 0; s < SAT4_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? SAT4_RECORD_LOCKS : 0u;
    }
    flags |= sat4_notice_changes(log, x, dt, order);
    sat4_record_head(&page, log, x, flags);
    sat4_record_put_reals(&page, tau, SAT4_N);
    if ((flags & SAT4_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < SAT4_N; first += SAT4_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < SAT4_N && s < first + SAT4_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            sat4_record_put(&page, mask, 1);
        }
    }
    status = sat4_step(table, x, tau, locked, dt, order, x);
    sat4_record_result(&page, log, x, NULL, status);
    return status;
}

SAT4_CODE
sat4_status sat4_recorder_step_driven(sat4_recorder *log, const sat4_table *table, sat4_state *x,
                                      const sat4_real phi_ddot[SAT4_N], sat4_real dt, int order)
{
    sat4_page page;
    sat4_status status;
    unsigned flags = SAT4_RECORD_DRIVEN;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL
        || log->write == NULL) { return SAT4_BAD_ARGUMENT; }
    flags |= sat4_notice_changes(log, x, dt, order);
    sat4_record_head(&page, log, x, flags);
    sat4_record_put_reals(&page, phi_ddot, SAT4_N);
    status = sat4_step_driven(table, x, phi_ddot, dt, order, x);
    sat4_record_result(&page, log, x, NULL, status);
    return status;
}

SAT4_CODE
sat4_status sat4_recorder_step_carried(sat4_recorder *log, const sat4_table *table, sat4_state *x,
                                       const sat4_real tau[SAT4_N], const int locked[SAT4_N], sat4_real dt,
                                       int order, sat4_step_carry *carry)
{
    sat4_page page;
    sat4_status status;
    unsigned flags = SAT4_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || tau == NULL || carry == NULL
        || log->write == NULL) { return SAT4_BAD_ARGUMENT; }
    for (int s = 0; s < SAT4_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? SAT4_RECORD_LOCKS : 0u;
    }
    flags |= sat4_notice_changes(log, x, dt, order);
    flags |= sat4_record_differs(carry->rounding, log->carry.rounding, 21, SAT4_RECORD_CARRY);
    log->carry = *carry;
    sat4_record_head(&page, log, x, flags);
    sat4_record_put_reals(&page, tau, SAT4_N);
    if ((flags & SAT4_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < SAT4_N; first += SAT4_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < SAT4_N && s < first + SAT4_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            sat4_record_put(&page, mask, 1);
        }
    }
    status = sat4_step_carried(table, x, tau, locked, dt, order, carry, x);
    sat4_record_result(&page, log, x, carry, status);
    return status;
}

SAT4_CODE
sat4_status sat4_recorder_step_driven_carried(sat4_recorder *log, const sat4_table *table, sat4_state *x,
                                              const sat4_real phi_ddot[SAT4_N], sat4_real dt, int order,
                                              sat4_step_carry *carry)
{
    sat4_page page;
    sat4_status status;
    unsigned flags = SAT4_RECORD_DRIVEN | SAT4_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL || carry == NULL
        || log->write == NULL) { return SAT4_BAD_ARGUMENT; }
    flags |= sat4_notice_changes(log, x, dt, order);
    flags |= sat4_record_differs(carry->rounding, log->carry.rounding, 21, SAT4_RECORD_CARRY);
    log->carry = *carry;
    sat4_record_head(&page, log, x, flags);
    sat4_record_put_reals(&page, phi_ddot, SAT4_N);
    status = sat4_step_driven_carried(table, x, phi_ddot, dt, order, carry, x);
    sat4_record_result(&page, log, x, carry, status);
    return status;
}
