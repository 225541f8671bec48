/* shaker2_recorder.c: flight recorder of the stand "shaker2". What a log holds: shaker2_recorder.h.
 * mahovik 0.1.0; structure 94a85f4a, physics 2591b2a4. Generated: change the stand file instead. */
#include "shaker2_recorder.h"

#if SHAKER2_STRUCTURE != 0x94a85f4au || SHAKER2_PHYSICS != 0x2591b2a4u
#error "shaker2.h and shaker2_recorder.c are of different stands"
#endif

#ifndef SHAKER2_CODE
#define SHAKER2_CODE
#endif

/* Header and recorder have the same real: else this array has no size. */
typedef char shaker2_recorder_real[(sizeof(shaker2_real) == 8) ? 1 : -1];

typedef uint64_t shaker2_record_word;  /* the bits of a real */

/* A record on its way: the bytes that wait for write, and the check of all so far. Without a log nothing is written. */
typedef struct shaker2_page {
    const shaker2_recorder *log;
    uint32_t check;
    size_t used;
    unsigned char bytes[SHAKER2_RECORD_BYTES];
} shaker2_page;

static const unsigned char shaker2_record_magic[8] = { 0x89, 0x4d, 0x48, 0x56, 0x4b, 0x0d, 0x0a, 0x1a };
static const unsigned char shaker2_record_name[7] = {
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
static void shaker2_begin(shaker2_page *page, const shaker2_recorder *log)
{
    page->log = log;
    page->check = 2166136261u;
    page->used = 0;
}

SHAKER2_CODE
static void shaker2_flush(shaker2_page *page)
{
    if (page->log != NULL && page->used > 0) {
        page->log->write(page->log->context, page->bytes, page->used);
    }
    page->used = 0;
}

/* The lowest bytes of a word, least significant first. */
SHAKER2_CODE
static void shaker2_put(shaker2_page *page, shaker2_record_word value, int bytes)
{
    for (int i = 0; i < bytes; ++i) {
        const unsigned char byte = (unsigned char)(value & 0xffu);
        if (page->used == sizeof page->bytes) {
            shaker2_flush(page);
        }
        page->bytes[page->used++] = byte;
        page->check = (page->check ^ byte) * 16777619u;
        value >>= 8;
    }
}

SHAKER2_CODE
static void shaker2_put_reals(shaker2_page *page, const shaker2_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        shaker2_put(page, shaker2_record_bits(values[i]), 8);
    }
}

/* The check, and out with what waits. */
SHAKER2_CODE
static void shaker2_close(shaker2_page *page)
{
    shaker2_put(page, page->check, 4);
    shaker2_flush(page);
}

SHAKER2_CODE
static void shaker2_put_row(shaker2_page *page, const shaker2_row *from)
{
    shaker2_put_reals(page, from->mu_c, 3);
    shaker2_put_reals(page, from->mu_s, 3);
    shaker2_put_reals(page, from->J_c, 6);
    shaker2_put_reals(page, from->J_s, 6);
    shaker2_put_reals(page, from->J_2c, 6);
    shaker2_put_reals(page, from->J_2s, 6);
    shaker2_put_reals(page, from->t_0, 3);
    shaker2_put_reals(page, from->t_c, 3);
    shaker2_put_reals(page, from->t_s, 3);
    shaker2_put_reals(page, &from->spin, 1);
    shaker2_put_reals(page, &from->spin_inv, 1);
}

SHAKER2_CODE
static void shaker2_put_suspension(shaker2_page *page, const shaker2_suspension *from)
{
    for (int i = 0; i < 6; ++i) {
        shaker2_put_reals(page, from->stiffness[i], 6);
    }
    for (int i = 0; i < 6; ++i) {
        shaker2_put_reals(page, from->damping[i], 6);
    }
    shaker2_put_reals(page, from->position, 3);
    shaker2_put_reals(page, from->attitude, 4);
}

SHAKER2_CODE
static void shaker2_put_table(shaker2_page *page, const shaker2_table *from)
{
    shaker2_put_reals(page, &from->mass, 1);
    shaker2_put_reals(page, &from->mass_inverse, 1);
    shaker2_put_reals(page, from->first_moment, 3);
    shaker2_put_reals(page, from->inertia, 6);
    for (int i = 0; i < 2; ++i) {
        shaker2_put_row(page, &from->flywheel[i]);
    }
    shaker2_put_reals(page, from->gravity, 3);
    shaker2_put_suspension(page, &from->suspension);
}

SHAKER2_CODE
static uint32_t shaker2_record_hash(const shaker2_real *values, int count)
{
    uint32_t hash = 2166136261u;
    for (int i = 0; i < count; ++i) {
        shaker2_record_word word = shaker2_record_bits(values[i]);
        for (int k = 0; k < 8; ++k) {
            hash = (hash ^ (uint32_t)(word & 0xffu)) * 16777619u;
            word >>= 8;
        }
    }
    return hash;
}

/* A hash of each member of a state. */
SHAKER2_CODE
static void shaker2_look(const shaker2_state *x, uint32_t seen[5])
{
    seen[0] = shaker2_record_hash(x->position, 3);
    seen[1] = shaker2_record_hash(x->attitude, 4);
    seen[2] = shaker2_record_hash(x->V, 6);
    seen[3] = shaker2_record_hash(x->phi, 2);
    seen[4] = shaker2_record_hash(x->phi_dot, 2);
}

SHAKER2_CODE
shaker2_status shaker2_recorder_start(shaker2_recorder *log, const shaker2_table *stand,
                                      const shaker2_state *x)
{
    shaker2_page page;
    uint32_t table;
    if (log == NULL || stand == NULL || x == NULL || log->write == NULL) {
        return SHAKER2_BAD_ARGUMENT;
    }
    shaker2_begin(&page, NULL);
    shaker2_put_table(&page, stand);
    table = page.check;
    shaker2_begin(&page, log);
    for (int i = 0; i < 8; ++i) {
        shaker2_put(&page, shaker2_record_magic[i], 1);
    }
    shaker2_put(&page, SHAKER2_RECORDER_FORMAT, 1);
    shaker2_put(&page, 8, 1);
    shaker2_put(&page, 7, 1);
    for (int i = 0; i < 7; ++i) {
        shaker2_put(&page, shaker2_record_name[i], 1);
    }
    shaker2_put(&page, SHAKER2_STRUCTURE, 4);
    shaker2_put(&page, SHAKER2_PHYSICS, 4);
    shaker2_put(&page, SHAKER2_RECORDER_SOURCE, 4);
    shaker2_put(&page, 2, 2);
    shaker2_put(&page, 0, 2);
    shaker2_put(&page, table, 4);
    shaker2_put(&page, log->count, 4);
    shaker2_put_reals(&page, x->position, 3);
    shaker2_put_reals(&page, x->attitude, 4);
    shaker2_put_reals(&page, x->V, 6);
    shaker2_put_reals(&page, x->phi, 2);
    shaker2_put_reals(&page, x->phi_dot, 2);
    if (table == SHAKER2_RECORDER_TABLE) {
        shaker2_put(&page, 0, 4);
    } else {
        shaker2_put(&page, 1400, 4);
        shaker2_put_table(&page, stand);
    }
    shaker2_close(&page);
    shaker2_look(x, log->seen);
    log->fresh = 1;
    return SHAKER2_OK;
}

/* The head of a step's record: flags, and what changed since the last one. */
SHAKER2_CODE
static void shaker2_open(shaker2_page *page, shaker2_recorder *log, const shaker2_table *stand,
                     const shaker2_state *x, shaker2_real dt, int order, unsigned flags)
{
    const shaker2_record_word step = shaker2_record_bits(dt);
    uint32_t seen[5];
    shaker2_look(x, seen);
    for (int i = 0; i < 5; ++i) {
        flags |= (seen[i] != log->seen[i]) ? (1u << i) : 0u;
    }
    if (log->fresh || step != log->dt || order != log->order) {
        flags |= SHAKER2_RECORD_SETTINGS;
    }
    (void)stand;
    log->fresh = 0;
    log->dt = step;
    log->order = order;
    shaker2_begin(page, log);
    shaker2_put(page, 0x53, 1);
    shaker2_put(page, flags, 2);
    shaker2_put(page, log->count, 4);
    if (flags & SHAKER2_RECORD_SETTINGS) {
        shaker2_put(page, step, 8);
        shaker2_put(page, (shaker2_record_word)order, 4);
    }
    if (flags & SHAKER2_RECORD_POSITION) {
        shaker2_put_reals(page, x->position, 3);
    }
    if (flags & SHAKER2_RECORD_ATTITUDE) {
        shaker2_put_reals(page, x->attitude, 4);
    }
    if (flags & SHAKER2_RECORD_V) {
        shaker2_put_reals(page, x->V, 6);
    }
    if (flags & SHAKER2_RECORD_PHI) {
        shaker2_put_reals(page, x->phi, 2);
    }
    if (flags & SHAKER2_RECORD_PHI_DOT) {
        shaker2_put_reals(page, x->phi_dot, 2);
    }
}

/* The tail: status and the hash of the state after the step. */
SHAKER2_CODE
static void shaker2_finish_record(shaker2_page *page, shaker2_recorder *log,
                              const shaker2_state *x, shaker2_status status)
{
    uint32_t hash = 2166136261u;
    shaker2_look(x, log->seen);
    for (int i = 0; i < 5; ++i) {
        hash = (hash ^ log->seen[i]) * 16777619u;
    }
    shaker2_put(page, (shaker2_record_word)status, 1);
    shaker2_put(page, hash, 4);
    shaker2_close(page);
    ++log->count;
}

SHAKER2_CODE
shaker2_status shaker2_recorder_step(shaker2_recorder *log, const shaker2_table *stand, shaker2_state *x,
                                     const shaker2_real tau[SHAKER2_N], const int locked[SHAKER2_N],
                                     shaker2_real dt, int order)
{
    shaker2_page page;
    shaker2_status status;
    unsigned flags = 0;
    if (log == NULL || stand == NULL || x == NULL || tau == NULL || locked == NULL
        || log->write == NULL) { return SHAKER2_BAD_ARGUMENT; }
    for (int s = 0; s < SHAKER2_N; ++s) {
        flags |= (locked[s] != 0) ? SHAKER2_RECORD_LOCKS : 0u;
    }
    shaker2_open(&page, log, stand, x, dt, order, flags);
    shaker2_put_reals(&page, tau, SHAKER2_N);
    if (flags & SHAKER2_RECORD_LOCKS) {
        for (int first = 0; first < SHAKER2_N; first += 8) {
            unsigned mask = 0;
            for (int s = first; s < SHAKER2_N && s < first + 8; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            shaker2_put(&page, mask, 1);
        }
    }
    status = shaker2_step(stand, x, tau, locked, dt, order, x);
    shaker2_finish_record(&page, log, x, status);
    return status;
}

SHAKER2_CODE
shaker2_status shaker2_recorder_step_driven(shaker2_recorder *log, const shaker2_table *stand,
                                            shaker2_state *x, const shaker2_real phi_ddot[SHAKER2_N],
                                            shaker2_real dt, int order)
{
    shaker2_page page;
    shaker2_status status;
    unsigned flags = SHAKER2_RECORD_DRIVEN;
    if (log == NULL || stand == NULL || x == NULL || phi_ddot == NULL
        || log->write == NULL) { return SHAKER2_BAD_ARGUMENT; }
    shaker2_open(&page, log, stand, x, dt, order, flags);
    shaker2_put_reals(&page, phi_ddot, SHAKER2_N);
    status = shaker2_step_driven(stand, x, phi_ddot, dt, order, x);
    shaker2_finish_record(&page, log, x, status);
    return status;
}
