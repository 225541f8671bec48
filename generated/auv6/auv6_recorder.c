/* auv6_recorder.c: flight recorder of the stand "auv6". What a log holds: auv6_recorder.h.
 * mahovik 0.1.0; structure 192ea446, physics 002b2abc. Generated: change the stand file instead. */
#include "auv6_recorder.h"

#if AUV6_STRUCTURE != 0x192ea446u || AUV6_PHYSICS != 0x002b2abcu
#error "auv6.h and auv6_recorder.c are of different stands"
#endif

#include <float.h>
#include <limits.h>

/* Other numbers than those of IEEE 754, and fast math, which leaves out roundings that the code relies on,
 * give wrong results with status OK. What the compiler shows of them is refused here; clang does not show
 * -funsafe-math-optimizations. */
#if FLT_RADIX != 2 || DBL_MANT_DIG != 53
#error "wrong results: auv6 needs a double of 64 bits, 53 of them significant"
#endif
#if INT_MAX < 2147483647
#error "wrong counts: auv6 needs an int of 32 bits"
#endif
#ifndef AUV6_ALLOW_FAST_MATH
#if defined __FAST_MATH__ || defined __ASSOCIATIVE_MATH__ || defined __RECIPROCAL_MATH__ || defined _M_FP_FAST
#error "wrong results: compile auv6 without -ffast-math, -Ofast and -funsafe-math-optimizations"
#elif FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1 && FLT_EVAL_METHOD != 16
#error "wrong results: x87 keeps more digits: compile auv6 with -msse2 -mfpmath=sse"
#endif
#if defined __FINITE_MATH_ONLY__ && __FINITE_MATH_ONLY__ == 1
#error "inputs that are NaN would pass: compile auv6 without -ffinite-math-only"
#endif
#endif

#ifndef AUV6_CODE
#define AUV6_CODE
#endif

/* Header and recorder use the same real type: otherwise this array has a negative size. */
typedef char auv6_recorder_real[(sizeof(auv6_real) == 8) ? 1 : -1];

typedef uint64_t auv6_record_word;  /* the bits of a real */

/* Sizes in bytes, and the first byte of a step's record. */
enum {
    AUV6_RECORD_STEP = 0x53,
    AUV6_RECORD_REAL_BYTES = 8,
    AUV6_RECORD_TABLE_BYTES = 3000,
    AUV6_RECORD_LOCKS_A_BYTE = 8
};

/* FNV-1a, 32 bits. */
#define AUV6_RECORD_BASIS 2166136261u
#define AUV6_RECORD_PRIME 16777619u

/* A record being written: the bytes that wait for write, and their hash so far. Without a log nothing is written. */
typedef struct auv6_page {
    auv6_recorder *log;
    uint32_t check;
    size_t used;
    unsigned char bytes[AUV6_RECORD_BYTES];
} auv6_page;

static const unsigned char auv6_record_magic[] = { 0x89, 0x4d, 0x48, 0x56, 0x4b, 0x0d, 0x0a, 0x1a };
static const unsigned char auv6_record_name[] = {
    0x61, 0x75, 0x76, 0x36
};

AUV6_CODE
static auv6_record_word auv6_record_bits(auv6_real value)
{
    union { auv6_real real; auv6_record_word word; } both;
    both.real = value;
    return both.word;
}

AUV6_CODE
static void auv6_record_begin(auv6_page *page, auv6_recorder *log)
{
    page->log = log;
    page->check = AUV6_RECORD_BASIS;
    page->used = 0;
}

AUV6_CODE
static void auv6_record_flush(auv6_page *page)
{
    if (page->log != NULL && page->used > 0 && page->log->write(page->log->context, page->bytes, page->used) != 0) {
        ++page->log->lost;
    }
    page->used = 0;
}

/* The lowest bytes of a word, least significant first. */
AUV6_CODE
static void auv6_record_put(auv6_page *page, auv6_record_word value, int bytes)
{
    for (int i = 0; i < bytes; ++i) {
        const unsigned char byte = (unsigned char)(value & 0xffu);
        if (page->used == sizeof page->bytes) {
            auv6_record_flush(page);
        }
        page->bytes[page->used++] = byte;
        page->check = (page->check ^ byte) * AUV6_RECORD_PRIME;
        value >>= 8;
    }
}

AUV6_CODE
static void auv6_record_put_reals(auv6_page *page, const auv6_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        auv6_record_put(page, auv6_record_bits(values[i]), AUV6_RECORD_REAL_BYTES);
    }
}

AUV6_CODE
static void auv6_record_put_bytes(auv6_page *page, const unsigned char *bytes, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        auv6_record_put(page, bytes[i], 1);
    }
}

/* Appends the check and writes the waiting bytes. */
AUV6_CODE
static void auv6_record_end(auv6_page *page)
{
    auv6_record_put(page, page->check, 4);
    auv6_record_flush(page);
}

AUV6_CODE
static void auv6_record_put_row(auv6_page *page, const auv6_row *from)
{
    auv6_record_put_reals(page, from->mu_c, 3);
    auv6_record_put_reals(page, from->mu_s, 3);
    auv6_record_put_reals(page, from->J_c, 6);
    auv6_record_put_reals(page, from->J_s, 6);
    auv6_record_put_reals(page, from->J_2c, 6);
    auv6_record_put_reals(page, from->J_2s, 6);
    auv6_record_put_reals(page, from->t_0, 3);
    auv6_record_put_reals(page, from->t_c, 3);
    auv6_record_put_reals(page, from->t_s, 3);
    auv6_record_put_reals(page, &from->spin, 1);
    auv6_record_put_reals(page, &from->spin_inv, 1);
    auv6_record_put_reals(page, &from->spin_root_inv, 1);
}

AUV6_CODE
static void auv6_record_put_sensor(auv6_page *page, const auv6_sensor *from)
{
    auv6_record_put_reals(page, from->origin, 3);
    auv6_record_put_reals(page, from->axes, 9);
}

AUV6_CODE
static void auv6_record_put_damper(auv6_page *page, const auv6_damper *from)
{
    for (int i = 0; i < 6; ++i) {
        auv6_record_put_reals(page, from->linear[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        auv6_record_put_reals(page, from->quadratic[i], 6);
    }
}

AUV6_CODE
static void auv6_record_put_table(auv6_page *page, const auv6_table *from)
{
    auv6_record_put_reals(page, &from->mass, 1);
    auv6_record_put_reals(page, &from->mass_inverse, 1);
    auv6_record_put_reals(page, from->first_moment, 3);
    auv6_record_put_reals(page, from->inertia, 6);
    auv6_record_put_reals(page, from->A, 6);
    auv6_record_put_reals(page, from->A_inv, 6);
    auv6_record_put_reals(page, from->G, 9);
    auv6_record_put_reals(page, &from->weight_mass, 1);
    auv6_record_put_reals(page, from->displaced_moment, 3);
    for (int i = 0; i < AUV6_N; ++i) {
        auv6_record_put_row(page, &from->flywheel[i]);
    }
    for (int i = 0; i < AUV6_SENSORS; ++i) {
        auv6_record_put_sensor(page, &from->sensor[i]);
    }
    auv6_record_put_reals(page, from->gravity, 3);
    auv6_record_put_damper(page, &from->damper);
}

/* The hash of a state so far, and one word more. */
AUV6_CODE
static uint32_t auv6_record_mix(uint32_t hash, uint32_t word)
{
    const uint32_t turned = ((hash << 5) & 0xffffffffu) | (hash >> 27);
    return (turned ^ word) * AUV6_RECORD_PRIME;
}

AUV6_CODE
static uint32_t auv6_record_hash(uint32_t hash, const auv6_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        const auv6_record_word word = auv6_record_bits(values[i]);
        hash = auv6_record_mix(hash, (uint32_t)(word & 0xffffffffu));
        hash = auv6_record_mix(hash, (uint32_t)(word >> 32));
    }
    return hash;
}

/* The flag where two rows of numbers differ in a bit. */
AUV6_CODE
static unsigned auv6_record_differs(const auv6_real *one, const auv6_real *other, int count, unsigned flag)
{
    auv6_record_word bits = 0;
    for (int i = 0; i < count; ++i) {
        bits |= auv6_record_bits(one[i]) ^ auv6_record_bits(other[i]);
    }
    return (bits != 0u) ? flag : 0u;
}

AUV6_CODE
auv6_status auv6_recorder_start(auv6_recorder *log, const auv6_table *table, const auv6_state *x)
{
    auv6_page page;
    uint32_t check;
    if (log == NULL || table == NULL || x == NULL || log->write == NULL) {
        return AUV6_BAD_ARGUMENT;
    }
    auv6_record_begin(&page, NULL);
    auv6_record_put_table(&page, table);
    check = page.check;
    auv6_record_begin(&page, log);
    auv6_record_put_bytes(&page, auv6_record_magic, sizeof auv6_record_magic);
    auv6_record_put(&page, AUV6_RECORDER_FORMAT, 1);
    auv6_record_put(&page, AUV6_RECORD_REAL_BYTES, 1);
    auv6_record_put(&page, sizeof auv6_record_name, 1);
    auv6_record_put_bytes(&page, auv6_record_name, sizeof auv6_record_name);
    auv6_record_put(&page, AUV6_STRUCTURE, 4);
    auv6_record_put(&page, AUV6_PHYSICS, 4);
    auv6_record_put(&page, AUV6_RECORDER_SOURCE, 4);
    auv6_record_put(&page, AUV6_N, 2);
    auv6_record_put(&page, 0, 2);
    auv6_record_put(&page, check, 4);
    auv6_record_put(&page, log->count, 4);
    auv6_record_put_reals(&page, x->position, 3);
    auv6_record_put_reals(&page, x->attitude, 4);
    auv6_record_put_reals(&page, x->V, 6);
    auv6_record_put_reals(&page, x->phi, AUV6_N);
    auv6_record_put_reals(&page, x->phi_dot, AUV6_N);
    if (check == AUV6_TABLE_HASH) {
        auv6_record_put(&page, 0, 4);
    } else {
        auv6_record_put(&page, AUV6_RECORD_TABLE_BYTES, 4);
        auv6_record_put_table(&page, table);
    }
    auv6_record_end(&page);
    log->seen = *x;
    for (int i = 0; i < 25; ++i) {
        log->carry.rounding[i] = (auv6_real)0;
    }
    log->fresh = 1;
    return AUV6_OK;
}

/* Flags of what changed since the last step: members of the state, dt and order, stream. The log remembers the new values. */
AUV6_CODE
static unsigned auv6_notice_changes(auv6_recorder *log, const auv6_table *table, const auv6_state *x,
                                  auv6_real dt, int order)
{
    const auv6_record_word step = auv6_record_bits(dt);
    unsigned flags = 0;
    flags |= auv6_record_differs(x->position, log->seen.position, 3, AUV6_RECORD_POSITION);
    flags |= auv6_record_differs(x->attitude, log->seen.attitude, 4, AUV6_RECORD_ATTITUDE);
    flags |= auv6_record_differs(x->V, log->seen.V, 6, AUV6_RECORD_V);
    flags |= auv6_record_differs(x->phi, log->seen.phi, AUV6_N, AUV6_RECORD_PHI);
    flags |= auv6_record_differs(x->phi_dot, log->seen.phi_dot, AUV6_N, AUV6_RECORD_PHI_DOT);
    if (log->fresh || step != log->dt || order != log->order) {
        flags |= AUV6_RECORD_SETTINGS;
    }
    for (int i = 0; i < 3; ++i) {
        const auv6_record_word now = auv6_record_bits(table->stream[i]);
        flags |= (log->fresh || now != log->stream[i]) ? AUV6_RECORD_STREAM : 0u;
        log->stream[i] = now;
    }
    log->fresh = 0;
    log->dt = step;
    log->order = order;
    return flags;
}

/* The head of a step's record: flags, and what changed. */
AUV6_CODE
static void auv6_record_head(auv6_page *page, auv6_recorder *log, const auv6_state *x, unsigned flags)
{
    auv6_record_begin(page, log);
    auv6_record_put(page, AUV6_RECORD_STEP, 1);
    auv6_record_put(page, flags, 2);
    auv6_record_put(page, log->count, 4);
    if (flags & AUV6_RECORD_SETTINGS) {
        auv6_record_put(page, log->dt, AUV6_RECORD_REAL_BYTES);
        auv6_record_put(page, (auv6_record_word)log->order, 4);
    }
    if (flags & AUV6_RECORD_POSITION) {
        auv6_record_put_reals(page, x->position, 3);
    }
    if (flags & AUV6_RECORD_ATTITUDE) {
        auv6_record_put_reals(page, x->attitude, 4);
    }
    if (flags & AUV6_RECORD_V) {
        auv6_record_put_reals(page, x->V, 6);
    }
    if (flags & AUV6_RECORD_PHI) {
        auv6_record_put_reals(page, x->phi, AUV6_N);
    }
    if (flags & AUV6_RECORD_PHI_DOT) {
        auv6_record_put_reals(page, x->phi_dot, AUV6_N);
    }
    if (flags & AUV6_RECORD_STREAM) {
        for (int i = 0; i < 3; ++i) {
            auv6_record_put(page, log->stream[i], AUV6_RECORD_REAL_BYTES);
        }
    }
    if (flags & AUV6_RECORD_CARRY) {
        auv6_record_put_reals(page, log->carry.rounding, 25);
    }
}

/* The tail: status and the hash of the state after the step, and of its carry if there is one. */
AUV6_CODE
static void auv6_record_result(auv6_page *page, auv6_recorder *log,
                              const auv6_state *x, const auv6_step_carry *carry, auv6_status status)
{
    uint32_t hash = AUV6_RECORD_BASIS;
    hash = auv6_record_hash(hash, x->position, 3);
    hash = auv6_record_hash(hash, x->attitude, 4);
    hash = auv6_record_hash(hash, x->V, 6);
    hash = auv6_record_hash(hash, x->phi, AUV6_N);
    hash = auv6_record_hash(hash, x->phi_dot, AUV6_N);
    if (carry != NULL) {
        hash = auv6_record_hash(hash, carry->rounding, 25);
        log->carry = *carry;
    }
    log->seen = *x;
    auv6_record_put(page, (auv6_record_word)status, 1);
    auv6_record_put(page, hash, 4);
    auv6_record_end(page);
    ++log->count;
}

AUV6_CODE
auv6_status auv6_recorder_step(auv6_recorder *log, const auv6_table *table, auv6_state *x,
                               const auv6_real tau[AUV6_N], const int locked[AUV6_N], auv6_real dt,
                               int order)
{
    auv6_page page;
    auv6_status status;
    unsigned flags = 0;
    if (log == NULL || table == NULL || x == NULL || tau == NULL
        || log->write == NULL) { return AUV6_BAD_ARGUMENT; }
    for (int s = 0; s < AUV6_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? AUV6_RECORD_LOCKS : 0u;
    }
    flags |= auv6_notice_changes(log, table, x, dt, order);
    auv6_record_head(&page, log, x, flags);
    auv6_record_put_reals(&page, tau, AUV6_N);
    if ((flags & AUV6_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < AUV6_N; first += AUV6_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < AUV6_N && s < first + AUV6_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            auv6_record_put(&page, mask, 1);
        }
    }
    status = auv6_step(table, x, tau, locked, dt, order, x);
    auv6_record_result(&page, log, x, NULL, status);
    return status;
}

AUV6_CODE
auv6_status auv6_recorder_step_driven(auv6_recorder *log, const auv6_table *table, auv6_state *x,
                                      const auv6_real phi_ddot[AUV6_N], auv6_real dt, int order)
{
    auv6_page page;
    auv6_status status;
    unsigned flags = AUV6_RECORD_DRIVEN;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL
        || log->write == NULL) { return AUV6_BAD_ARGUMENT; }
    flags |= auv6_notice_changes(log, table, x, dt, order);
    auv6_record_head(&page, log, x, flags);
    auv6_record_put_reals(&page, phi_ddot, AUV6_N);
    status = auv6_step_driven(table, x, phi_ddot, dt, order, x);
    auv6_record_result(&page, log, x, NULL, status);
    return status;
}

AUV6_CODE
auv6_status auv6_recorder_step_carried(auv6_recorder *log, const auv6_table *table, auv6_state *x,
                                       const auv6_real tau[AUV6_N], const int locked[AUV6_N], auv6_real dt,
                                       int order, auv6_step_carry *carry)
{
    auv6_page page;
    auv6_status status;
    unsigned flags = AUV6_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || tau == NULL || carry == NULL
        || log->write == NULL) { return AUV6_BAD_ARGUMENT; }
    for (int s = 0; s < AUV6_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? AUV6_RECORD_LOCKS : 0u;
    }
    flags |= auv6_notice_changes(log, table, x, dt, order);
    flags |= auv6_record_differs(carry->rounding, log->carry.rounding, 25, AUV6_RECORD_CARRY);
    log->carry = *carry;
    auv6_record_head(&page, log, x, flags);
    auv6_record_put_reals(&page, tau, AUV6_N);
    if ((flags & AUV6_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < AUV6_N; first += AUV6_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < AUV6_N && s < first + AUV6_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            auv6_record_put(&page, mask, 1);
        }
    }
    status = auv6_step_carried(table, x, tau, locked, dt, order, carry, x);
    auv6_record_result(&page, log, x, carry, status);
    return status;
}

AUV6_CODE
auv6_status auv6_recorder_step_driven_carried(auv6_recorder *log, const auv6_table *table, auv6_state *x,
                                              const auv6_real phi_ddot[AUV6_N], auv6_real dt, int order,
                                              auv6_step_carry *carry)
{
    auv6_page page;
    auv6_status status;
    unsigned flags = AUV6_RECORD_DRIVEN | AUV6_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL || carry == NULL
        || log->write == NULL) { return AUV6_BAD_ARGUMENT; }
    flags |= auv6_notice_changes(log, table, x, dt, order);
    flags |= auv6_record_differs(carry->rounding, log->carry.rounding, 25, AUV6_RECORD_CARRY);
    log->carry = *carry;
    auv6_record_head(&page, log, x, flags);
    auv6_record_put_reals(&page, phi_ddot, AUV6_N);
    status = auv6_step_driven_carried(table, x, phi_ddot, dt, order, carry, x);
    auv6_record_result(&page, log, x, carry, status);
    return status;
}
