/* eye4_recorder.c: flight recorder of the stand "eye4". What a log holds: eye4_recorder.h.
 * mahovik 0.1.0; structure 59c20951, physics 7b9ac829. Generated: change the stand file instead. */
#include "eye4_recorder.h"

#if EYE4_STRUCTURE != 0x59c20951u || EYE4_PHYSICS != 0x7b9ac829u
#error "eye4.h and eye4_recorder.c are of different stands"
#endif

#include <float.h>
#include <limits.h>

/* Other numbers than those of IEEE 754, and fast math, which leaves out roundings that the code relies on,
 * give wrong results with status OK. What the compiler shows of them is refused here; clang does not show
 * -funsafe-math-optimizations. */
#if FLT_RADIX != 2 || DBL_MANT_DIG != 53
#error "wrong results: eye4 needs a double of 64 bits, 53 of them significant"
#endif
#if INT_MAX < 2147483647
#error "wrong counts: eye4 needs an int of 32 bits"
#endif
#ifndef EYE4_ALLOW_FAST_MATH
#if defined __FAST_MATH__ || defined __ASSOCIATIVE_MATH__ || defined __RECIPROCAL_MATH__ || defined _M_FP_FAST
#error "wrong results: compile eye4 without -ffast-math, -Ofast and -funsafe-math-optimizations"
#elif FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1 && FLT_EVAL_METHOD != 16
#error "wrong results: x87 keeps more digits: compile eye4 with -msse2 -mfpmath=sse"
#endif
#if defined __FINITE_MATH_ONLY__ && __FINITE_MATH_ONLY__ == 1
#error "inputs that are NaN would pass: compile eye4 without -ffinite-math-only"
#endif
#endif

#ifndef EYE4_CODE
#define EYE4_CODE
#endif

/* Header and recorder use the same real type: otherwise this array has a negative size. */
typedef char eye4_recorder_real[(sizeof(eye4_real) == 8) ? 1 : -1];

typedef uint64_t eye4_record_word;  /* the bits of a real */

/* Sizes in bytes, and the first byte of a step's record. */
enum {
    EYE4_RECORD_STEP = 0x53,
    EYE4_RECORD_REAL_BYTES = 8,
    EYE4_RECORD_TABLE_BYTES = 1624,
    EYE4_RECORD_LOCKS_A_BYTE = 8
};

/* FNV-1a, 32 bits. */
#define EYE4_RECORD_BASIS 2166136261u
#define EYE4_RECORD_PRIME 16777619u

/* A record being written: the bytes that wait for write, and their hash so far. Without a log nothing is written. */
typedef struct eye4_page {
    eye4_recorder *log;
    uint32_t check;
    size_t used;
    unsigned char bytes[EYE4_RECORD_BYTES];
} eye4_page;

static const unsigned char eye4_record_magic[] = { 0x89, 0x4d, 0x48, 0x56, 0x4b, 0x0d, 0x0a, 0x1a };
static const unsigned char eye4_record_name[] = {
    0x65, 0x79, 0x65, 0x34
};

EYE4_CODE
static eye4_record_word eye4_record_bits(eye4_real value)
{
    union { eye4_real real; eye4_record_word word; } both;
    both.real = value;
    return both.word;
}

EYE4_CODE
static void eye4_record_begin(eye4_page *page, eye4_recorder *log)
{
    page->log = log;
    page->check = EYE4_RECORD_BASIS;
    page->used = 0;
}

EYE4_CODE
static void eye4_record_flush(eye4_page *page)
{
    if (page->log != NULL && page->used > 0 && page->log->write(page->log->context, page->bytes, page->used) != 0) {
        ++page->log->lost;
    }
    page->used = 0;
}

/* The lowest bytes of a word, least significant first. */
EYE4_CODE
static void eye4_record_put(eye4_page *page, eye4_record_word value, int bytes)
{
    for (int i = 0; i < bytes; ++i) {
        const unsigned char byte = (unsigned char)(value & 0xffu);
        if (page->used == sizeof page->bytes) {
            eye4_record_flush(page);
        }
        page->bytes[page->used++] = byte;
        page->check = (page->check ^ byte) * EYE4_RECORD_PRIME;
        value >>= 8;
    }
}

EYE4_CODE
static void eye4_record_put_reals(eye4_page *page, const eye4_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        eye4_record_put(page, eye4_record_bits(values[i]), EYE4_RECORD_REAL_BYTES);
    }
}

EYE4_CODE
static void eye4_record_put_bytes(eye4_page *page, const unsigned char *bytes, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        eye4_record_put(page, bytes[i], 1);
    }
}

/* Appends the check and writes the waiting bytes. */
EYE4_CODE
static void eye4_record_end(eye4_page *page)
{
    eye4_record_put(page, page->check, 4);
    eye4_record_flush(page);
}

EYE4_CODE
static void eye4_record_put_row(eye4_page *page, const eye4_row *from)
{
    eye4_record_put_reals(page, from->mu_c, 3);
    eye4_record_put_reals(page, from->mu_s, 3);
    eye4_record_put_reals(page, from->J_c, 6);
    eye4_record_put_reals(page, from->J_s, 6);
    eye4_record_put_reals(page, from->J_2c, 6);
    eye4_record_put_reals(page, from->J_2s, 6);
    eye4_record_put_reals(page, from->t_0, 3);
    eye4_record_put_reals(page, from->t_c, 3);
    eye4_record_put_reals(page, from->t_s, 3);
    eye4_record_put_reals(page, &from->spin, 1);
    eye4_record_put_reals(page, &from->spin_inv, 1);
    eye4_record_put_reals(page, &from->spin_root_inv, 1);
}

EYE4_CODE
static void eye4_record_put_sensor(eye4_page *page, const eye4_sensor *from)
{
    eye4_record_put_reals(page, from->origin, 3);
    eye4_record_put_reals(page, from->axes, 9);
}

EYE4_CODE
static void eye4_record_put_table(eye4_page *page, const eye4_table *from)
{
    eye4_record_put_reals(page, &from->mass, 1);
    eye4_record_put_reals(page, &from->mass_inverse, 1);
    eye4_record_put_reals(page, from->first_moment, 3);
    eye4_record_put_reals(page, from->inertia, 6);
    for (int i = 0; i < EYE4_N; ++i) {
        eye4_record_put_row(page, &from->flywheel[i]);
    }
    for (int i = 0; i < EYE4_SENSORS; ++i) {
        eye4_record_put_sensor(page, &from->sensor[i]);
    }
}

/* The hash of a state so far, and one word more. */
EYE4_CODE
static uint32_t eye4_record_mix(uint32_t hash, uint32_t word)
{
    const uint32_t turned = ((hash << 5) & 0xffffffffu) | (hash >> 27);
    return (turned ^ word) * EYE4_RECORD_PRIME;
}

EYE4_CODE
static uint32_t eye4_record_hash(uint32_t hash, const eye4_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        const eye4_record_word word = eye4_record_bits(values[i]);
        hash = eye4_record_mix(hash, (uint32_t)(word & 0xffffffffu));
        hash = eye4_record_mix(hash, (uint32_t)(word >> 32));
    }
    return hash;
}

/* The flag where two rows of numbers differ in a bit. */
EYE4_CODE
static unsigned eye4_record_differs(const eye4_real *one, const eye4_real *other, int count, unsigned flag)
{
    eye4_record_word bits = 0;
    for (int i = 0; i < count; ++i) {
        bits |= eye4_record_bits(one[i]) ^ eye4_record_bits(other[i]);
    }
    return (bits != 0u) ? flag : 0u;
}

EYE4_CODE
eye4_status eye4_recorder_start(eye4_recorder *log, const eye4_table *table, const eye4_state *x)
{
    eye4_page page;
    uint32_t check;
    if (log == NULL || table == NULL || x == NULL || log->write == NULL) {
        return EYE4_BAD_ARGUMENT;
    }
    eye4_record_begin(&page, NULL);
    eye4_record_put_table(&page, table);
    check = page.check;
    eye4_record_begin(&page, log);
    eye4_record_put_bytes(&page, eye4_record_magic, sizeof eye4_record_magic);
    eye4_record_put(&page, EYE4_RECORDER_FORMAT, 1);
    eye4_record_put(&page, EYE4_RECORD_REAL_BYTES, 1);
    eye4_record_put(&page, sizeof eye4_record_name, 1);
    eye4_record_put_bytes(&page, eye4_record_name, sizeof eye4_record_name);
    eye4_record_put(&page, EYE4_STRUCTURE, 4);
    eye4_record_put(&page, EYE4_PHYSICS, 4);
    eye4_record_put(&page, EYE4_RECORDER_SOURCE, 4);
    eye4_record_put(&page, EYE4_N, 2);
    eye4_record_put(&page, EYE4_WRENCHES, 2);
    eye4_record_put(&page, check, 4);
    eye4_record_put(&page, log->count, 4);
    eye4_record_put_reals(&page, x->position, 3);
    eye4_record_put_reals(&page, x->attitude, 4);
    eye4_record_put_reals(&page, x->V, 6);
    eye4_record_put_reals(&page, x->phi, EYE4_N);
    eye4_record_put_reals(&page, x->phi_dot, EYE4_N);
    if (check == EYE4_TABLE_HASH) {
        eye4_record_put(&page, 0, 4);
    } else {
        eye4_record_put(&page, EYE4_RECORD_TABLE_BYTES, 4);
        eye4_record_put_table(&page, table);
    }
    eye4_record_end(&page);
    log->seen = *x;
    for (int i = 0; i < 21; ++i) {
        log->carry.rounding[i] = (eye4_real)0;
    }
    log->fresh = 1;
    return EYE4_OK;
}

/* Flags of what changed since the last step: members of the state, dt and order. The log remembers the new values. */
EYE4_CODE
static unsigned eye4_notice_changes(eye4_recorder *log, const eye4_state *x,
                                  eye4_real dt, int order)
{
    const eye4_record_word step = eye4_record_bits(dt);
    unsigned flags = 0;
    flags |= eye4_record_differs(x->position, log->seen.position, 3, EYE4_RECORD_POSITION);
    flags |= eye4_record_differs(x->attitude, log->seen.attitude, 4, EYE4_RECORD_ATTITUDE);
    flags |= eye4_record_differs(x->V, log->seen.V, 6, EYE4_RECORD_V);
    flags |= eye4_record_differs(x->phi, log->seen.phi, EYE4_N, EYE4_RECORD_PHI);
    flags |= eye4_record_differs(x->phi_dot, log->seen.phi_dot, EYE4_N, EYE4_RECORD_PHI_DOT);
    if (log->fresh || step != log->dt || order != log->order) {
        flags |= EYE4_RECORD_SETTINGS;
    }
    log->fresh = 0;
    log->dt = step;
    log->order = order;
    return flags;
}

/* The head of a step's record: flags, and what changed. */
EYE4_CODE
static void eye4_record_head(eye4_page *page, eye4_recorder *log, const eye4_state *x, unsigned flags)
{
    eye4_record_begin(page, log);
    eye4_record_put(page, EYE4_RECORD_STEP, 1);
    eye4_record_put(page, flags, 2);
    eye4_record_put(page, log->count, 4);
    if (flags & EYE4_RECORD_SETTINGS) {
        eye4_record_put(page, log->dt, EYE4_RECORD_REAL_BYTES);
        eye4_record_put(page, (eye4_record_word)log->order, 4);
    }
    if (flags & EYE4_RECORD_POSITION) {
        eye4_record_put_reals(page, x->position, 3);
    }
    if (flags & EYE4_RECORD_ATTITUDE) {
        eye4_record_put_reals(page, x->attitude, 4);
    }
    if (flags & EYE4_RECORD_V) {
        eye4_record_put_reals(page, x->V, 6);
    }
    if (flags & EYE4_RECORD_PHI) {
        eye4_record_put_reals(page, x->phi, EYE4_N);
    }
    if (flags & EYE4_RECORD_PHI_DOT) {
        eye4_record_put_reals(page, x->phi_dot, EYE4_N);
    }
    if (flags & EYE4_RECORD_CARRY) {
        eye4_record_put_reals(page, log->carry.rounding, 21);
    }
}

/* The tail: status and the hash of the state after the step, and of its carry if there is one. */
EYE4_CODE
static void eye4_record_result(eye4_page *page, eye4_recorder *log,
                              const eye4_state *x, const eye4_step_carry *carry, eye4_status status)
{
    uint32_t hash = EYE4_RECORD_BASIS;
    hash = eye4_record_hash(hash, x->position, 3);
    hash = eye4_record_hash(hash, x->attitude, 4);
    hash = eye4_record_hash(hash, x->V, 6);
    hash = eye4_record_hash(hash, x->phi, EYE4_N);
    hash = eye4_record_hash(hash, x->phi_dot, EYE4_N);
    if (carry != NULL) {
        hash = eye4_record_hash(hash, carry->rounding, 21);
        log->carry = *carry;
    }
    log->seen = *x;
    eye4_record_put(page, (eye4_record_word)status, 1);
    eye4_record_put(page, hash, 4);
    eye4_record_end(page);
    ++log->count;
}

/* The flag of a wrench that is not zero. */
EYE4_CODE
static unsigned eye4_wrench_flag(const eye4_real wrench[6 * EYE4_WRENCHES])
{
    for (int i = 0; i < 6 * EYE4_WRENCHES; ++i) {
        if (eye4_record_bits(wrench[i]) != 0u) {
            return EYE4_RECORD_WRENCH;
        }
    }
    return 0;
}

EYE4_CODE
eye4_status eye4_recorder_step(eye4_recorder *log, const eye4_table *table, eye4_state *x,
                               const eye4_real tau[EYE4_N], const int locked[EYE4_N],
                               const eye4_real wrench[6], eye4_real dt, int order)
{
    eye4_page page;
    eye4_status status;
    unsigned flags = 0;
    if (log == NULL || table == NULL || x == NULL || tau == NULL || wrench == NULL
        || log->write == NULL) { return EYE4_BAD_ARGUMENT; }
    for (int s = 0; s < EYE4_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? EYE4_RECORD_LOCKS : 0u;
    }
    flags |= eye4_wrench_flag(wrench);
    flags |= eye4_notice_changes(log, x, dt, order);
    eye4_record_head(&page, log, x, flags);
    eye4_record_put_reals(&page, tau, EYE4_N);
    if ((flags & EYE4_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < EYE4_N; first += EYE4_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < EYE4_N && s < first + EYE4_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            eye4_record_put(&page, mask, 1);
        }
    }
    if (flags & EYE4_RECORD_WRENCH) {
        eye4_record_put_reals(&page, wrench, 6 * EYE4_WRENCHES);
    }
    status = eye4_step(table, x, tau, locked, wrench, dt, order, x);
    eye4_record_result(&page, log, x, NULL, status);
    return status;
}

EYE4_CODE
eye4_status eye4_recorder_step_driven(eye4_recorder *log, const eye4_table *table, eye4_state *x,
                                      const eye4_real phi_ddot[EYE4_N], const eye4_real wrench[6],
                                      eye4_real dt, int order)
{
    eye4_page page;
    eye4_status status;
    unsigned flags = EYE4_RECORD_DRIVEN;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL || wrench == NULL
        || log->write == NULL) { return EYE4_BAD_ARGUMENT; }
    flags |= eye4_wrench_flag(wrench);
    flags |= eye4_notice_changes(log, x, dt, order);
    eye4_record_head(&page, log, x, flags);
    eye4_record_put_reals(&page, phi_ddot, EYE4_N);
    if (flags & EYE4_RECORD_WRENCH) {
        eye4_record_put_reals(&page, wrench, 6 * EYE4_WRENCHES);
    }
    status = eye4_step_driven(table, x, phi_ddot, wrench, dt, order, x);
    eye4_record_result(&page, log, x, NULL, status);
    return status;
}

EYE4_CODE
eye4_status eye4_recorder_step_carried(eye4_recorder *log, const eye4_table *table, eye4_state *x,
                                       const eye4_real tau[EYE4_N], const int locked[EYE4_N],
                                       const eye4_real wrench[6], eye4_real dt, int order,
                                       eye4_step_carry *carry)
{
    eye4_page page;
    eye4_status status;
    unsigned flags = EYE4_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || tau == NULL || wrench == NULL || carry == NULL
        || log->write == NULL) { return EYE4_BAD_ARGUMENT; }
    for (int s = 0; s < EYE4_N; ++s) {
        flags |= (locked != NULL && locked[s] != 0) ? EYE4_RECORD_LOCKS : 0u;
    }
    flags |= eye4_wrench_flag(wrench);
    flags |= eye4_notice_changes(log, x, dt, order);
    flags |= eye4_record_differs(carry->rounding, log->carry.rounding, 21, EYE4_RECORD_CARRY);
    log->carry = *carry;
    eye4_record_head(&page, log, x, flags);
    eye4_record_put_reals(&page, tau, EYE4_N);
    if ((flags & EYE4_RECORD_LOCKS) && locked != NULL) {  /* flag implies pointer: no analyser sees it */
        for (int first = 0; first < EYE4_N; first += EYE4_RECORD_LOCKS_A_BYTE) {
            unsigned mask = 0;
            for (int s = first; s < EYE4_N && s < first + EYE4_RECORD_LOCKS_A_BYTE; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            eye4_record_put(&page, mask, 1);
        }
    }
    if (flags & EYE4_RECORD_WRENCH) {
        eye4_record_put_reals(&page, wrench, 6 * EYE4_WRENCHES);
    }
    status = eye4_step_carried(table, x, tau, locked, wrench, dt, order, carry, x);
    eye4_record_result(&page, log, x, carry, status);
    return status;
}

EYE4_CODE
eye4_status eye4_recorder_step_driven_carried(eye4_recorder *log, const eye4_table *table, eye4_state *x,
                                              const eye4_real phi_ddot[EYE4_N], const eye4_real wrench[6],
                                              eye4_real dt, int order, eye4_step_carry *carry)
{
    eye4_page page;
    eye4_status status;
    unsigned flags = EYE4_RECORD_DRIVEN | EYE4_RECORD_CARRIED;
    if (log == NULL || table == NULL || x == NULL || phi_ddot == NULL || wrench == NULL || carry == NULL
        || log->write == NULL) { return EYE4_BAD_ARGUMENT; }
    flags |= eye4_wrench_flag(wrench);
    flags |= eye4_notice_changes(log, x, dt, order);
    flags |= eye4_record_differs(carry->rounding, log->carry.rounding, 21, EYE4_RECORD_CARRY);
    log->carry = *carry;
    eye4_record_head(&page, log, x, flags);
    eye4_record_put_reals(&page, phi_ddot, EYE4_N);
    if (flags & EYE4_RECORD_WRENCH) {
        eye4_record_put_reals(&page, wrench, 6 * EYE4_WRENCHES);
    }
    status = eye4_step_driven_carried(table, x, phi_ddot, wrench, dt, order, carry, x);
    eye4_record_result(&page, log, x, carry, status);
    return status;
}
