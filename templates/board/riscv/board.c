/* RISC-V with a debugger or an emulator: console by semihosting, instructions by minstret. */
#include <stdint.h>

#include "board.h"

long board_semihosting(unsigned long operation, const void *argument); /* startup.S */
void board_exit(int status);

void board_print(const char *text)
{
    (void)board_semihosting(0x04u, text); /* SYS_WRITE0 */
}

void board_exit(int status)
{
    const unsigned long block[2] = { 0x20026u, (unsigned long)status }; /* ADP_Stopped_ApplicationExit */

    (void)board_semihosting(0x20u, block); /* SYS_EXIT_EXTENDED */
    for (;;) {
    }
}

unsigned long board_ticks(void)
{
    unsigned long count;

    __asm__ volatile(".option push\n\t.option arch, +zicsr\n\tcsrr %0, minstret\n\t.option pop" : "=r"(count));
    return count & 0xFFFFFFFFu;
}
