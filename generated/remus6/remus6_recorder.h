/* remus6_recorder.h: flight recorder of the stand "remus6". It logs the raw inputs of every step, so that
 * `mahovik replay` repeats the run on the desk bit for bit.
 * mahovik 0.1.0; structure 3687deee, physics 5f25aea2. Generated: change the stand file instead.
 *
 * C99, no allocation, no stdio, no globals but const. Bytes leave through a function of the caller. Use:
 *
 *     remus6_recorder log = { .write = my_write, .context = &my_device };
 *     remus6_recorder_start(&log, &remus6_default, &x);
 *     for (;;) { remus6_recorder_step(&log, &remus6_default, &x, ...); }
 *
 * If other code writes the state between two steps (measured phases, an observer's correction), this is noticed and
 * logged. A changed table needs a new start. start may be called again at any time: a log can be replayed from each
 * start, so call it now and then if the log is a ring buffer.
 *
 * A write that fails (storage full, a link down) is counted in `lost`, and the steps continue: the log then has a gap, which
 * replay reports. If `lost` has grown, call start again: the log can be replayed from there.
 *
 * A log is a sequence of records, little-endian; a real is its bits, 8 bytes; every record ends in
 * u32 check, the FNV-1a hash of its bytes before.
 *   start  89 4d 48 56 4b 0d 0a 1a, u8 format, u8 bytes of a real, u8 length of name, name, u32 structure, u32 physics,
 *          u32 source, u16 N, u16 wrenches, u32 table hash, u32 count, the state, u32 length of table, table if any
 *   step   53, u16 flags, u32 count; if flagged: dt and i32 order, members of the state, stream, carry; tau or phi_ddot;
 *          if flagged: bits of the locks, wrench; i8 status, u32 hash of the state (and carry) after the step
 * The hash of a state goes over its reals in 32-bit words, the low word first: h = (h turned left by 5 ^ word) * 16777619,
 * modulo 2^32, from 2166136261.
 * The table is written if it is not the default: member by member, a real or an i32 each, without the stream. */
#ifndef REMUS6_RECORDER_H
#define REMUS6_RECORDER_H

#include <stddef.h>
#include <stdint.h>

#include "remus6.h"

/* The linker sees names that end in the kind of the reals and a hash of this header: a caller with the
 * header of another stand, element type, choice of functions or version does not link. Define
 * REMUS6_PLAIN_NAMES for all files, and it sees the names as they are, as dlsym, --wrap and other
 * languages need them. */
#ifndef REMUS6_PLAIN_NAMES
#define remus6_recorder_start               remus6_recorder_start_f64_78add70c
#define remus6_recorder_step                remus6_recorder_step_f64_78add70c
#define remus6_recorder_step_driven         remus6_recorder_step_driven_f64_78add70c
#define remus6_recorder_step_carried        remus6_recorder_step_carried_f64_78add70c
#define remus6_recorder_step_driven_carried remus6_recorder_step_driven_carried_f64_78add70c
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define REMUS6_RECORDER_FORMAT 3u           /* version of the log format */
#define REMUS6_RECORDER_SOURCE 0x8b2c9a7cu  /* FNV-1a hash of the texts of remus6.h and remus6.c */
#define REMUS6_RECORD_BYTES    501  /* longest record of a step; most have 64 */

/* Flags of a step: members of the state that were written since the last step, and optional parts of its record. */
enum {
    REMUS6_RECORD_POSITION = 1,               /* position was written */
    REMUS6_RECORD_ATTITUDE = 2,               /* attitude was written */
    REMUS6_RECORD_V = 4,                      /* V was written */
    REMUS6_RECORD_PHI = 8,                    /* phi was written */
    REMUS6_RECORD_PHI_DOT = 16,               /* phi_dot was written */
    REMUS6_RECORD_SETTINGS = 32,              /* dt and order, when they change */
    REMUS6_RECORD_STREAM = 64,                /* the table's stream, when it changes */
    REMUS6_RECORD_DRIVEN = 128,               /* by step_driven: phi_ddot instead of tau */
    REMUS6_RECORD_LOCKS = 256,                /* any flywheel is locked: a bit each */
    REMUS6_RECORD_WRENCH = 512,               /* any run-time wrench is not zero */
    REMUS6_RECORD_CARRIED = 1024,             /* by a step with a carry: the hash goes over the carry too */
    REMUS6_RECORD_CARRY = 2048                /* the carry, when it is not as it was left */
};

/* A log in progress. The caller sets the first two members; the others begin as zero. */
typedef struct remus6_recorder {
    int (*write)(void *context, const unsigned char *bytes, size_t count);  /* stores or sends; one call per step; 0: success */
    void *context;          /* passed to write */
    uint32_t lost;          /* failed writes; the caller may set it to 0 */
    uint32_t count;         /* number of the next step, modulo 2^32 */
    remus6_state seen;  /* the state as it was left */
    uint64_t dt;            /* bits of the last time step */
    uint64_t stream[3];     /* bits of the last stream */
    remus6_step_carry carry;   /* the carry as it was left; all zero after a start */
    int order;              /* the last order */
    int fresh;              /* not 0: no step since the last start */
} remus6_recorder;

/* recorder_start: writes a start record: identities, the state, and the table if it is not the default.
 *   log    in and out; write and context must be set
 *   table  the prepared table
 *   x      state before the next step
 * Returns OK, even if a write was lost; BAD_ARGUMENT. Calls write several times and hashes the whole table once.
 * Stack: at most 864 bytes, and that of write. */
remus6_status remus6_recorder_start(remus6_recorder *log, const remus6_table *table, const remus6_state *x);

/* recorder_step: calls step and writes a record of it.
 *   log  a log that was started
 *   x    in and out: state, the step after it
 *   The other arguments are those of step. A refused step is logged too.
 * Returns what step returns; BAD_ARGUMENT without a record if a pointer is null.
 * Stack: at most 5152 bytes, and that of write. */
remus6_status remus6_recorder_step(remus6_recorder *log, const remus6_table *table, remus6_state *x,
                                   const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                                   remus6_real dt, int order);

/* recorder_step_driven: calls step_driven and writes a record of it.
 *   log  a log that was started
 *   x    in and out: state, the step after it
 *   The other arguments are those of step_driven. A refused step is logged too.
 * Returns what step_driven returns; BAD_ARGUMENT without a record if a pointer is null.
 * Stack: at most 4272 bytes, and that of write. */
remus6_status remus6_recorder_step_driven(remus6_recorder *log, const remus6_table *table, remus6_state *x,
                                          const remus6_real phi_ddot[REMUS6_N], remus6_real dt, int order);

/* recorder_step_carried: calls step_carried and writes a record of it.
 *   log  a log that was started
 *   x    in and out: state, the step after it
 *   The other arguments are those of step_carried. A refused step is logged too.
 * Returns what step_carried returns; BAD_ARGUMENT without a record if a pointer is null.
 * Stack: at most 5424 bytes, and that of write. */
remus6_status remus6_recorder_step_carried(remus6_recorder *log, const remus6_table *table, remus6_state *x,
                                           const remus6_real tau[REMUS6_N], const int locked[REMUS6_N],
                                           remus6_real dt, int order, remus6_step_carry *carry);

/* recorder_step_driven_carried: calls step_driven_carried and writes a record of it.
 *   log  a log that was started
 *   x    in and out: state, the step after it
 *   The other arguments are those of step_driven_carried. A refused step is logged too.
 * Returns what step_driven_carried returns; BAD_ARGUMENT without a record if a pointer is null.
 * Stack: at most 4528 bytes, and that of write. */
remus6_status remus6_recorder_step_driven_carried(remus6_recorder *log, const remus6_table *table,
                                                  remus6_state *x, const remus6_real phi_ddot[REMUS6_N],
                                                  remus6_real dt, int order, remus6_step_carry *carry);

#ifdef __cplusplus
}
#endif

#endif
