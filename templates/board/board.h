/* board.h: all that a test program wants of the board it runs on. */
#ifndef BOARD_H
#define BOARD_H

#ifdef __cplusplus
extern "C" {
#endif

/* Zero-terminated text to the semihosting console, or to stdout of a hosted board. */
void board_print(const char *text);

/* Instructions since the first call or before, modulo 2^32, where the emulator counts them (QEMU with -icount shift=0); else 0. */
unsigned long board_ticks(void);

/* Fills the free stack with a pattern. */
void board_paint_stack(void);

/* Bytes of stack used since board_paint_stack(), below the frame of its caller: the deepest word that lost its
 * pattern. 0 where the board does not know its stack. */
unsigned long board_stack_used(void);

#ifdef __cplusplus
}
#endif

#endif
