/* Cortex-M from reset to main: vector table, FPU on, variables set up. Nothing of a C library is needed. */
#include <stdint.h>

int  main(void);
void board_exit(int status);
void board_systick(void);
void board_reset(void);
void board_fault(void);

extern uint32_t board_data_load[], board_data_begin[], board_data_end[]; /* of the linker script */
extern uint32_t board_bss_begin[], board_bss_end[];
extern void     board_stack_top(void); /* no function, but the table wants its address as one */

#define CPACR (*(volatile uint32_t *)0xE000ED88u)

__attribute__((section(".vectors"), used)) static void (*const vectors[16])(void) = {
    board_stack_top, board_reset, board_fault, board_fault, board_fault, board_fault, board_fault, board_fault,
    board_fault,     board_fault, board_fault, board_fault, board_fault, board_fault, board_fault, board_systick,
};

/* Registers of the FPU are out of bounds until it is on. */
__attribute__((target("general-regs-only"))) void board_reset(void)
{
    const uint32_t    *from = board_data_load;
    volatile uint32_t *to;

    CPACR |= 0xFu << 20; /* CP10, CP11: full access. No effect where there is no FPU */
    __asm__ volatile("dsb\n\tisb" : : : "memory");
    for (to = board_data_begin; to != board_data_end; ++to) {
        *to = *from;
        ++from;
    }
    for (to = board_bss_begin; to != board_bss_end; ++to) {
        *to = 0;
    }
    board_exit(main());
}

/* A crash ends the program with a status of its own instead of hanging. */
void board_fault(void)
{
    board_exit(99);
}
