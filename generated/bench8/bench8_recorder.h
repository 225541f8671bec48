/* bench8_recorder.h: flight recorder of the stand "bench8". It logs the raw inputs of every step, so that
 * `mahovik replay` repeats the run on the desk bit for bit.
 * mahovik 0.1.0; structure 309d41a6, physics 139422e0. Generated: change the stand file instead.
 *
 * C99, no allocation, no stdio, no globals but const. Bytes leave through a function of the caller. Use:
 *
 *     bench8_recorder log = { .write = my_write, .context = &my_device };
 *     bench8_recorder_start(&log, &bench8_default, &x);
 *     for (;;) { bench8_recorder_step(&log, &bench8_default, &x, ...); }
 *
 * What else writes the state between two steps (measured phases, an observer's correction) is noticed and logged by
 * itself. Another table needs a new start. start may be called again at any time: a log can be replayed from each
 * start on, so a ring buffer wants one every now and then.
 *
 * A write that fails (storage full, a link down) is counted in `lost`, and the steps go on: the log has a gap there, which
 * replay names. Where `lost` has grown, call start again, and the log can be replayed from there.
 *
 * A log is a sequence of records, little-endian; a real is its bits, 8 bytes; every record ends in
 * u32 check, the FNV-1a hash of its bytes before.
 *   start  89 4d 48 56 4b 0d 0a 1a, u8 format, u8 bytes of a real, u8 length of name, name, u32 structure, u32 physics,
 *          u32 source, u16 N, u16 wrenches, u32 table hash, u32 count, the state, u32 length of table, table if any
 *   step   53, u16 flags, u32 count; where flagged: dt and i32 order, members of the state, stream; tau or phi_ddot;
 *          where flagged: bits of the locks, wrench; i8 status, u32 hash of the state after the step
 * The table is there where it is not the default, member by member, a real or an i32 each, without the stream. */
#ifndef BENCH8_RECORDER_H
#define BENCH8_RECORDER_H

#include <stddef.h>
#include <stdint.h>

#include "bench8.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BENCH8_RECORDER_FORMAT 1u           /* of the log */
#define BENCH8_RECORDER_SOURCE 0xc5c5cc8eu  /* of the texts of bench8.h and bench8.c: FNV-1a */
#define BENCH8_RECORDER_TABLE  0x35f7de05u  /* hash of the default table */
#define BENCH8_RECORD_BYTES    325  /* longest record of a step; most have 80 */
#define BENCH8_RECORD_MEMBERS  5  /* of a state */

/* Bits of the flags of a step: members of the state that were written since the last step, and what else is there. */
enum {
    BENCH8_RECORD_POSITION = 1,               /* position was written */
    BENCH8_RECORD_ATTITUDE = 2,               /* attitude was written */
    BENCH8_RECORD_V = 4,                      /* V was written */
    BENCH8_RECORD_PHI = 8,                    /* phi was written */
    BENCH8_RECORD_PHI_DOT = 16,               /* phi_dot was written */
    BENCH8_RECORD_SETTINGS = 32,              /* dt and order, when they change */
    BENCH8_RECORD_STREAM = 64,                /* the table's stream, when it changes */
    BENCH8_RECORD_DRIVEN = 128,               /* by step_driven: phi_ddot instead of tau */
    BENCH8_RECORD_LOCKS = 256,                /* any flywheel is locked: a bit each */
    BENCH8_RECORD_WRENCH = 512                /* any run-time wrench is not zero */
};

/* A log in progress. The first two members are the caller's; the rest begins as zero. */
typedef struct bench8_recorder {
    int (*write)(void *context, const unsigned char *bytes, size_t count);  /* stores or sends, one call a step; 0: good */
    void *context;          /* passed to write */
    uint32_t lost;          /* writes that were not good; the caller may set it to 0 */
    uint32_t count;         /* number of the next step, modulo 2^32 */
    uint32_t seen[BENCH8_RECORD_MEMBERS];  /* hash of each member of the state as it was left */
    uint64_t dt;            /* bits of the last time step */
    int order;              /* the last order */
    int fresh;              /* not 0: no step since the last start */
} bench8_recorder;

/* recorder_start: writes a start record: identities, the state, and the table where it is not the default.
 *   log    its write and context are set; in and out
 *   table  the prepared table
 *   x      state before the next step
 * Returns OK, also where a write was lost; BAD_ARGUMENT. Calls write several times; hashes the whole table once. */
bench8_status bench8_recorder_start(bench8_recorder *log, const bench8_table *table, const bench8_state *x);

/* recorder_step: step, and a record of it.
 *   log  a log that was started
 *   x    in and out: state, the step after it
 *   The others are those of step; also a step that is refused is logged.
 * Returns what step returns; BAD_ARGUMENT without a record where a pointer is null.
 * Stack: BENCH8_RECORD_BYTES and less than 200 bytes more than step. */
bench8_status bench8_recorder_step(bench8_recorder *log, const bench8_table *table, bench8_state *x,
                                   const bench8_real tau[BENCH8_N], const int locked[BENCH8_N],
                                   bench8_real dt, int order);

/* recorder_step_driven: step_driven, and a record of it.
 *   log  a log that was started
 *   x    in and out: state, the step after it
 *   The others are those of step_driven; also a step that is refused is logged.
 * Returns what step_driven returns; BAD_ARGUMENT without a record where a pointer is null.
 * Stack: BENCH8_RECORD_BYTES and less than 200 bytes more than step_driven. */
bench8_status bench8_recorder_step_driven(bench8_recorder *log, const bench8_table *table, bench8_state *x,
                                          const bench8_real phi_ddot[BENCH8_N], bench8_real dt, int order);

#ifdef __cplusplus
}
#endif

#endif
