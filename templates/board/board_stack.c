/* Painted stack: how deep it was. For boards whose linker script says where the stack lies. */
#include <stdint.h>

#include "board.h"

extern uint32_t board_stack_bottom[]; /* of the linker script */

#define PATTERN 0x5AA5C33Cu

#if defined(__riscv)
#define READ_SP "mv %0, sp"
#else
#define READ_SP "mov %0, sp"
#endif

static uintptr_t painted_from; /* stack pointer of the caller of board_paint_stack */

void board_paint_stack(void)
{
    volatile uint32_t *word = board_stack_bottom;
    uintptr_t          sp;

    __asm__ volatile(READ_SP : "=r"(sp)); /* below it nothing is in use */
    painted_from = (uintptr_t)__builtin_dwarf_cfa();
    while ((uintptr_t)word < sp) {
        *word = PATTERN;
        ++word;
    }
}

unsigned long board_stack_used(void)
{
    const volatile uint32_t *word = board_stack_bottom;

    while ((uintptr_t)word < painted_from && *word == PATTERN) {
        ++word;
    }
    return (unsigned long)(painted_from - (uintptr_t)word);
}
