/* demo3_recorder.c: flight recorder of the stand "demo3". What a log holds: demo3_recorder.h.
 * mahovik 0.1.0; structure 055bf547, physics fdeb29e7. Generated: change the stand file instead. */
#include "demo3_recorder.h"

#if DEMO3_STRUCTURE != 0x055bf547u || DEMO3_PHYSICS != 0xfdeb29e7u
#error "demo3.h and demo3_recorder.c are of different stands"
#endif

#ifndef DEMO3_CODE
#define DEMO3_CODE
#endif

/* Header and recorder have the same real: else this array has no size. */
typedef char demo3_recorder_real[(sizeof(demo3_real) == 8) ? 1 : -1];

typedef uint64_t demo3_record_word;  /* the bits of a real */

/* A record on its way: the bytes that wait for write, and the check of all so far. Without a log nothing is written. */
typedef struct demo3_page {
    const demo3_recorder *log;
    uint32_t check;
    size_t used;
    unsigned char bytes[DEMO3_RECORD_BYTES];
} demo3_page;

static const unsigned char demo3_record_magic[8] = { 0x89, 0x4d, 0x48, 0x56, 0x4b, 0x0d, 0x0a, 0x1a };
static const unsigned char demo3_record_name[5] = {
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
static void demo3_begin(demo3_page *page, const demo3_recorder *log)
{
    page->log = log;
    page->check = 2166136261u;
    page->used = 0;
}

DEMO3_CODE
static void demo3_flush(demo3_page *page)
{
    if (page->log != NULL && page->used > 0) {
        page->log->write(page->log->context, page->bytes, page->used);
    }
    page->used = 0;
}

/* The lowest bytes of a word, least significant first. */
DEMO3_CODE
static void demo3_put(demo3_page *page, demo3_record_word value, int bytes)
{
    for (int i = 0; i < bytes; ++i) {
        const unsigned char byte = (unsigned char)(value & 0xffu);
        if (page->used == sizeof page->bytes) {
            demo3_flush(page);
        }
        page->bytes[page->used++] = byte;
        page->check = (page->check ^ byte) * 16777619u;
        value >>= 8;
    }
}

DEMO3_CODE
static void demo3_put_reals(demo3_page *page, const demo3_real *values, int count)
{
    for (int i = 0; i < count; ++i) {
        demo3_put(page, demo3_record_bits(values[i]), 8);
    }
}

/* The check, and out with what waits. */
DEMO3_CODE
static void demo3_close(demo3_page *page)
{
    demo3_put(page, page->check, 4);
    demo3_flush(page);
}

DEMO3_CODE
static void demo3_put_row(demo3_page *page, const demo3_row *from)
{
    demo3_put_reals(page, from->mu_c, 3);
    demo3_put_reals(page, from->mu_s, 3);
    demo3_put_reals(page, from->J_c, 6);
    demo3_put_reals(page, from->J_s, 6);
    demo3_put_reals(page, from->J_2c, 6);
    demo3_put_reals(page, from->J_2s, 6);
    demo3_put_reals(page, from->t_0, 3);
    demo3_put_reals(page, from->t_c, 3);
    demo3_put_reals(page, from->t_s, 3);
    demo3_put_reals(page, &from->spin, 1);
    demo3_put_reals(page, &from->spin_inv, 1);
}

DEMO3_CODE
static void demo3_put_table(demo3_page *page, const demo3_table *from)
{
    demo3_put_reals(page, &from->mass, 1);
    demo3_put_reals(page, &from->mass_inverse, 1);
    demo3_put_reals(page, from->first_moment, 3);
    demo3_put_reals(page, from->inertia, 6);
    for (int i = 0; i < 3; ++i) {
        demo3_put_row(page, &from->flywheel[i]);
    }
}

DEMO3_CODE
static uint32_t demo3_record_hash(const demo3_real *values, int count)
{
    uint32_t hash = 2166136261u;
    for (int i = 0; i < count; ++i) {
        demo3_record_word word = demo3_record_bits(values[i]);
        for (int k = 0; k < 8; ++k) {
            hash = (hash ^ (uint32_t)(word & 0xffu)) * 16777619u;
            word >>= 8;
        }
    }
    return hash;
}

/* A hash of each member of a state. */
DEMO3_CODE
static void demo3_look(const demo3_state *x, uint32_t seen[5])
{
    seen[0] = demo3_record_hash(x->position, 3);
    seen[1] = demo3_record_hash(x->attitude, 4);
    seen[2] = demo3_record_hash(x->V, 6);
    seen[3] = demo3_record_hash(x->phi, 3);
    seen[4] = demo3_record_hash(x->phi_dot, 3);
}

DEMO3_CODE
demo3_status demo3_recorder_start(demo3_recorder *log, const demo3_table *stand, const demo3_state *x)
{
    demo3_page page;
    uint32_t table;
    if (log == NULL || stand == NULL || x == NULL || log->write == NULL) {
        return DEMO3_BAD_ARGUMENT;
    }
    demo3_begin(&page, NULL);
    demo3_put_table(&page, stand);
    table = page.check;
    demo3_begin(&page, log);
    for (int i = 0; i < 8; ++i) {
        demo3_put(&page, demo3_record_magic[i], 1);
    }
    demo3_put(&page, DEMO3_RECORDER_FORMAT, 1);
    demo3_put(&page, 8, 1);
    demo3_put(&page, 5, 1);
    for (int i = 0; i < 5; ++i) {
        demo3_put(&page, demo3_record_name[i], 1);
    }
    demo3_put(&page, DEMO3_STRUCTURE, 4);
    demo3_put(&page, DEMO3_PHYSICS, 4);
    demo3_put(&page, DEMO3_RECORDER_SOURCE, 4);
    demo3_put(&page, 3, 2);
    demo3_put(&page, 0, 2);
    demo3_put(&page, table, 4);
    demo3_put(&page, log->count, 4);
    demo3_put_reals(&page, x->position, 3);
    demo3_put_reals(&page, x->attitude, 4);
    demo3_put_reals(&page, x->V, 6);
    demo3_put_reals(&page, x->phi, 3);
    demo3_put_reals(&page, x->phi_dot, 3);
    if (table == DEMO3_RECORDER_TABLE) {
        demo3_put(&page, 0, 4);
    } else {
        demo3_put(&page, 1072, 4);
        demo3_put_table(&page, stand);
    }
    demo3_close(&page);
    demo3_look(x, log->seen);
    log->fresh = 1;
    return DEMO3_OK;
}

/* The head of a step's record: flags, and what changed since the last one. */
DEMO3_CODE
static void demo3_open(demo3_page *page, demo3_recorder *log, const demo3_table *stand,
                     const demo3_state *x, demo3_real dt, int order, unsigned flags)
{
    const demo3_record_word step = demo3_record_bits(dt);
    uint32_t seen[5];
    demo3_look(x, seen);
    for (int i = 0; i < 5; ++i) {
        flags |= (seen[i] != log->seen[i]) ? (1u << i) : 0u;
    }
    if (log->fresh || step != log->dt || order != log->order) {
        flags |= DEMO3_RECORD_SETTINGS;
    }
    (void)stand;
    log->fresh = 0;
    log->dt = step;
    log->order = order;
    demo3_begin(page, log);
    demo3_put(page, 0x53, 1);
    demo3_put(page, flags, 2);
    demo3_put(page, log->count, 4);
    if (flags & DEMO3_RECORD_SETTINGS) {
        demo3_put(page, step, 8);
        demo3_put(page, (demo3_record_word)order, 4);
    }
    if (flags & DEMO3_RECORD_POSITION) {
        demo3_put_reals(page, x->position, 3);
    }
    if (flags & DEMO3_RECORD_ATTITUDE) {
        demo3_put_reals(page, x->attitude, 4);
    }
    if (flags & DEMO3_RECORD_V) {
        demo3_put_reals(page, x->V, 6);
    }
    if (flags & DEMO3_RECORD_PHI) {
        demo3_put_reals(page, x->phi, 3);
    }
    if (flags & DEMO3_RECORD_PHI_DOT) {
        demo3_put_reals(page, x->phi_dot, 3);
    }
}

/* The tail: status and the hash of the state after the step. */
DEMO3_CODE
static void demo3_finish_record(demo3_page *page, demo3_recorder *log,
                              const demo3_state *x, demo3_status status)
{
    uint32_t hash = 2166136261u;
    demo3_look(x, log->seen);
    for (int i = 0; i < 5; ++i) {
        hash = (hash ^ log->seen[i]) * 16777619u;
    }
    demo3_put(page, (demo3_record_word)status, 1);
    demo3_put(page, hash, 4);
    demo3_close(page);
    ++log->count;
}

DEMO3_CODE
demo3_status demo3_recorder_step(demo3_recorder *log, const demo3_table *stand, demo3_state *x,
                                 const demo3_real tau[DEMO3_N], const int locked[DEMO3_N], demo3_real dt,
                                 int order)
{
    demo3_page page;
    demo3_status status;
    unsigned flags = 0;
    if (log == NULL || stand == NULL || x == NULL || tau == NULL || locked == NULL
        || log->write == NULL) { return DEMO3_BAD_ARGUMENT; }
    for (int s = 0; s < DEMO3_N; ++s) {
        flags |= (locked[s] != 0) ? DEMO3_RECORD_LOCKS : 0u;
    }
    demo3_open(&page, log, stand, x, dt, order, flags);
    demo3_put_reals(&page, tau, DEMO3_N);
    if (flags & DEMO3_RECORD_LOCKS) {
        for (int first = 0; first < DEMO3_N; first += 8) {
            unsigned mask = 0;
            for (int s = first; s < DEMO3_N && s < first + 8; ++s) {
                mask |= (locked[s] != 0) ? (1u << (s - first)) : 0u;
            }
            demo3_put(&page, mask, 1);
        }
    }
    status = demo3_step(stand, x, tau, locked, dt, order, x);
    demo3_finish_record(&page, log, x, status);
    return status;
}

DEMO3_CODE
demo3_status demo3_recorder_step_driven(demo3_recorder *log, const demo3_table *stand, demo3_state *x,
                                        const demo3_real phi_ddot[DEMO3_N], demo3_real dt, int order)
{
    demo3_page page;
    demo3_status status;
    unsigned flags = DEMO3_RECORD_DRIVEN;
    if (log == NULL || stand == NULL || x == NULL || phi_ddot == NULL
        || log->write == NULL) { return DEMO3_BAD_ARGUMENT; }
    demo3_open(&page, log, stand, x, dt, order, flags);
    demo3_put_reals(&page, phi_ddot, DEMO3_N);
    status = demo3_step_driven(stand, x, phi_ddot, dt, order, x);
    demo3_finish_record(&page, log, x, status);
    return status;
}
