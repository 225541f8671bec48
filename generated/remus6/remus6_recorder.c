/* remus6_recorder.c: flight recorder of the stand "remus6". What a log holds: remus6_recorder.h.
 * mahovik 0.1.0; structure 3687deee, physics 5f25aea2. Generated: change the stand file instead. */
#include "remus6_recorder.h"

#if REMUS6_STRUCTURE != 0x3687deeeu || REMUS6_PHYSICS != 0x5f25aea2u
#error "remus6.h and remus6_recorder.c are of different stands"
#endif

#ifndef REMUS6_CODE
#define REMUS6_CODE
#endif

/* Header and recorder have the same real: else this array has no size. */
typedef char remus6_recorder_real[(sizeof(remus6_real) == 8) ? 1 : -1];

typedef uint64_t remus6_record_word;  /* the bits of a real */

/* A record on its way: the bytes that wait for write, and the check of all so far. Without a log nothing is written. */
typedef struct remus6_page {
    const remus6_recorder *log;
    uint32_t check;
    size_t used;
    unsigned char bytes[REMUS6_RECORD_BYTES];
} remus6_page;

static const unsigned char remus6_record_magic[8] = { 0x89, 0x4d, 0x48, 0x56, 0x4b, 0x0d, 0x0a, 0x1a };
static const unsigned char remus6_record_name[6] = {
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
static void remus6_begin(remus6_page *page, const remus6_recorder *log)
{
    page->log = log;
    page->check = 2166136261u;
    page->used = 0;
}

REMUS6_CODE
static void remus6_flush(remus6_page *page)
{
    if (page->log != NULL && page->used > 0) {
        page->log->write(page->log->context, page->bytes, page->used);
    }
    page->used = 0;
}

/* The lowest bytes of a word, least significant first. */
REMUS6_CODE
static void remus6_put(remus6_page *page, remus6_record_word value, int bytes)
{
    for (int i = 0; i < bytes; ++i) {
        const unsigned char byte = (unsigned char)(value & 0xffu);
        if (page->used == sizeof page->bytes) {
            remus6_flush(page);
        }
        page->bytes[page->used++] = byte;
        page->check = (page->check ^ byte) * 16777619u;
        value >>= 8;
    }
}

REMUS6_CODE
static void remus6_put_reals(remus6_page *page, const remus6_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        remus6_put(page, remus6_record_bits(values[i]), 8);
    }
}

/* The check, and out with what waits. */
REMUS6_CODE
static void remus6_close(remus6_page *page)
{
    remus6_put(page, page->check, 4);
    remus6_flush(page);
}

REMUS6_CODE
static void remus6_put_row(remus6_page *page, const remus6_row *from)
{
    remus6_put_reals(page, from->mu_c, 3);
    remus6_put_reals(page, from->mu_s, 3);
    remus6_put_reals(page, from->J_c, 6);
    remus6_put_reals(page, from->J_s, 6);
    remus6_put_reals(page, from->J_2c, 6);
    remus6_put_reals(page, from->J_2s, 6);
    remus6_put_reals(page, from->t_0, 3);
    remus6_put_reals(page, from->t_c, 3);
    remus6_put_reals(page, from->t_s, 3);
    remus6_put_reals(page, &from->spin, 1);
    remus6_put_reals(page, &from->spin_inv, 1);
}

REMUS6_CODE
static void remus6_put_sensor(remus6_page *page, const remus6_sensor *from)
{
    remus6_put_reals(page, from->origin, 3);
    remus6_put_reals(page, from->axes, 9);
}

REMUS6_CODE
static void remus6_put_damper(remus6_page *page, const remus6_damper *from)
{
    remus6_put(page, (remus6_record_word)from->first_term, 4);
    remus6_put(page, (remus6_record_word)from->last_term, 4);
}

REMUS6_CODE
static void remus6_put_term(remus6_page *page, const remus6_term *from)
{
    remus6_put(page, (remus6_record_word)from->wrench, 4);
    remus6_put(page, (remus6_record_word)from->first, 4);
    remus6_put(page, (remus6_record_word)from->second, 4);
    remus6_put_reals(page, &from->value, 1);
}

REMUS6_CODE
static void remus6_put_table(remus6_page *page, const remus6_table *from)
{
    remus6_put_reals(page, &from->mass, 1);
    remus6_put_reals(page, &from->mass_inverse, 1);
    remus6_put_reals(page, from->first_moment, 3);
    remus6_put_reals(page, from->inertia, 6);
    remus6_put_reals(page, from->A, 6);
    remus6_put_reals(page, from->A_inv, 6);
    remus6_put_reals(page, from->G, 9);
    remus6_put_reals(page, &from->weight_mass, 1);
    remus6_put_reals(page, from->displaced_moment, 3);
    for (int i = 0; i < 6; ++i) {
        remus6_put_row(page, &from->flywheel[i]);
    }
    for (int i = 0; i < 2; ++i) {
        remus6_put_sensor(page, &from->sensor[i]);
    }
    remus6_put_reals(page, from->gravity, 3);
    remus6_put_damper(page, &from->damper);
    for (int i = 0; i < 10; ++i) {
        remus6_put_term(page, &from->term[i]);
    }
}

REMUS6_CODE
static uint32_t remus6_record_hash(const remus6_real *values, int count)
{
    uint32_t hash = 2166136261u;
    for (int i = 0; i < count; ++i) {
        remus6_record_word word = remus6_record_bits(values[i]);
        for (int k = 0; k < 8; ++k) {
            hash = (hash ^ (uint32_t)(word & 0xffu)) * 16777619u;
            word >>= 8;
        }
    }
    return hash;
}

/* A hash of each member of a state. */
REMUS6_CODE
static void remus6_look(const remus6_state *x, uint32_t seen[5])
{
    seen[0] = remus6_record_hash(x->position, 3);
    seen[1] = remus6_record_hash(x->attitude, 4);
    seen[2] = remus6_record_hash(x->V, 6);
    seen[3] = remus6_record_hash(x->phi, 6);
    seen[4] = remus6_record_hash(x->phi_dot, 6);
}

REMUS6_CODE
remus6_status remus6_recorder_start(remus6_recorder *log, const remus6_table *stand, const remus6_state *x)
{
    remus6_page page;
    uint32_t table;
    if (log == NULL || stand == NULL || x == NULL || log->write == NULL) {
        return REMUS6_BAD_ARGUMENT;
    }
    remus6_begin(&page, NULL);
    remus6_put_table(&page, stand);
    table = page.check;
    remus6_begin(&page, log);
    for (int i = 0; i < 8; ++i) {
        remus6_put(&page, remus6_record_magic[i], 1);
    }
    remus6_put(&page, REMUS6_RECORDER_FORMAT, 1);
    remus6_put(&page, 8, 1);
    remus6_put(&page, 6, 1);
    for (int i = 0; i < 6; ++i) {
        remus6_put(&page, remus6_record_name[i], 1);
    }
    remus6_put(&page, REMUS6_STRUCTURE, 4);
    remus6_put(&page, REMUS6_PHYSICS, 4);
    remus6_put(&page, REMUS6_RECORDER_SOURCE, 4);
    remus6_put(&page, 6, 2);
    remus6_put(&page, 0, 2);
    remus6_put(&page, table, 4);
    remus6_put(&page, log->count, 4);
    remus6_put_reals(&page, x->position, 3);
    remus6_put_reals(&page, x->attitude, 4);
    remus6_put_reals(&page, x->V, 6);
    remus6_put_reals(&page, x->phi, 6);
    remus6_put_reals(&page, x->phi_dot, 6);
    if (table == REMUS6_RECORDER_TABLE) {
        remus6_put(&page, 0, 4);
    } else {
        remus6_put(&page, 2680, 4);
        remus6_put_table(&page, stand);
    }
    remus6_close(&page);
    remus6_look(x, log->seen);
    log->fresh = 1;
    return REMUS6_OK;
}

/* The head of a step's record: flags, and what changed since the last one. */
REMUS6_CODE
static void remus6_open(remus6_page *page, remus6_recorder *log, const remus6_table *stand,
                     const remus6_state *x, remus6_real dt, int order, unsigned flags)
{
    const remus6_record_word step = remus6_record_bits(dt);
    uint32_t seen[5];
    remus6_look(x, seen);
    for (int i = 0; i < 5; ++i) {
        flags |= (seen[i] != log->seen[i]) ? (1u << i) : 0u;
    }
    if (log->fresh || step != log->dt || order != log->order) {
        flags |= REMUS6_RECORD_SETTINGS;
    }
    for (int i = 0; i < 3; ++i) {
        const remus6_record_word now = remus6_record_bits(stand->stream[i]);
        flags |= (log->fresh || now != log->stream[i]) ? REMUS6_RECORD_STREAM : 0u;
        log->stream[i] = now;
    }
    log->fresh = 0;
    log->dt = step;
    log->order = order;
    remus6_begin(page, log);
    remus6_put(page, 0x53, 1);
    remus6_put(page, flags, 2);
    remus6_put(page, log->count, 4);
    if (flags & REMUS6_RECORD_SETTINGS) {
        remus6_put(page, step, 8);
        remus6_put(page, (remus6_record_word)order, 4);
    }
    if (flags & REMUS6_RECORD_POSITION) {
        remus6_put_reals(page, x->position, 3);
    }
    if (flags & REMUS6_RECORD_ATTITUDE) {
        remus6_put_reals(page, x->attitude, 4);
    }
    if (flags & REMUS6_RECORD_V) {
        remus6_put_reals(page, x->V, 6);
    }
    if (flags & REMUS6_RECORD_PHI) {
        remus6_put_reals(page, x->phi, 6);
    }
    if (flags & REMUS6_RECORD_PHI_DOT) {
        remus6_put_reals(page, x->phi_dot, 6);
    }
    if (flags & REMUS6_RECORD_STREAM) {
        remus6_put_reals(page, stand->stream, 3);
    }
}

/* The tail: status and the hash of the state after the step. */
REMUS6_CODE
static void remus6_finish_record(remus6_page *page, remus6_recorder *log,
                              const remus6_state *x, remus6_status status)
{
    uint32_t hash = 2166136261u;
    remus6_look(x, log->seen);
    for (int i = 0; i < 5; ++i) {
        hash = (hash ^ log->seen[i]) * 16777619u;
    }
    remus6_put(page, (remus6_record_word)status, 1);
    remus6_put(page, hash, 4);
    remus6_close(page);
    ++log->count;
}

REMUS6_CODE
remus6_status remus6_recorder_step(remus6_recorder *log, const remus6_table *stand, remus6_state *x,
                                   const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                                   remus6_real dt, int order)
{
    remus6_page page;
    remus6_status status;
    unsigned flags = 0;
    if (log == NULL || stand == NULL || x == NULL || tau == NULL || locked == NULL
        || log->write == NULL) { return REMUS6_BAD_ARGUMENT; }
    for (int s = 0; s < REMUS6_N; ++s) {
        flags |= (locked[s] != 0) ? REMUS6_RECORD_LOCKS : 0u;
    }
    remus6_open(&page, log, stand, x, dt, order, flags);
    remus6_put_reals(&page, tau, REMUS6_N);
    if (flags & REMUS6_RECORD_LOCKS) {
        for (int first = 0; first < REMUS6_N; first += 8) {
            unsigned mask = 0;
            for (int s = first; s < REMUS6_N && s < first + 8; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            remus6_put(&page, mask, 1);
        }
    }
    status = remus6_step(stand, x, tau, locked, dt, order, x);
    remus6_finish_record(&page, log, x, status);
    return status;
}

REMUS6_CODE
remus6_status remus6_recorder_step_driven(remus6_recorder *log, const remus6_table *stand, remus6_state *x,
                                          const remus6_real phi_ddot[REMUS6_N], remus6_real dt, int order)
{
    remus6_page page;
    remus6_status status;
    unsigned flags = REMUS6_RECORD_DRIVEN;
    if (log == NULL || stand == NULL || x == NULL || phi_ddot == NULL
        || log->write == NULL) { return REMUS6_BAD_ARGUMENT; }
    remus6_open(&page, log, stand, x, dt, order, flags);
    remus6_put_reals(&page, phi_ddot, REMUS6_N);
    status = remus6_step_driven(stand, x, phi_ddot, dt, order, x);
    remus6_finish_record(&page, log, x, status);
    return status;
}
