/* Cortex-M with a debugger or an emulator: console by Arm semihosting, instructions by SysTick.
 *
 * QEMU with -icount shift=0 executes one instruction a nanosecond, and SysTick counts the processor's clock: so
 * instructions = ticks * 1000 / MHz. On silicon SysTick counts cycles: there give BOARD_MHZ 1000 and read cycles. */
#include <stdint.h>

#include "board.h"

#ifndef BOARD_MHZ
#error "compile with -DBOARD_MHZ=..., the clock of the emulated processor, or 1000 for raw ticks"
#endif

#define SYST_CSR (*(volatile uint32_t *)0xE000E010u)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014u)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018u)
#define SCB_ICSR (*(volatile uint32_t *)0xE000ED04u)
#define TICKS_A_TURN 0x1000000u /* a counter of 24 bits */
#define SYSTICK_PENDING 0x4000000u

void board_exit(int status);
void board_systick(void);

static volatile uint32_t turns;

/* Arm semihosting: operation in r0, its argument in r1, result in r0. */
static int semihosting(int operation, const void *argument)
{
    register int         r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;

    __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

void board_print(const char *text)
{
    (void)semihosting(0x04, text); /* SYS_WRITE0 */
}

void board_exit(int status)
{
    const uint32_t block[2] = { 0x20026u, (uint32_t)status }; /* ADP_Stopped_ApplicationExit */

    (void)semihosting(0x20, block); /* SYS_EXIT_EXTENDED */
    for (;;) {
    }
}

void board_systick(void)
{
    turns = turns + 1u;
}

unsigned long board_ticks(void)
{
    uint32_t turn, left;

    if ((SYST_CSR & 1u) == 0u) { /* the first call starts the counter */
        SYST_RVR = TICKS_A_TURN - 1u;
        SYST_CVR = 0u;
        SYST_CSR = 7u; /* processor clock, interrupt, on */
        while (SYST_CVR == 0u) { /* loaded at the next tick */
        }
    }
    do { /* a turn may end between the two readings, or before its interrupt has counted it */
        turn = turns;
        left = SYST_CVR;
    } while (turn != turns || (SCB_ICSR & SYSTICK_PENDING) != 0u);
    return (unsigned long)(((uint64_t)turn * TICKS_A_TURN + (TICKS_A_TURN - 1u - left)) * 1000u / BOARD_MHZ);
}
