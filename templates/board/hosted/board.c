/* A program under an operating system: console is stdout; instructions and stack are not counted here. */
#include <stdio.h>

#include "board.h"

void board_print(const char *text)
{
    (void)fputs(text, stdout);
}

unsigned long board_ticks(void)
{
    return 0;
}

void board_paint_stack(void)
{
}

unsigned long board_stack_used(void)
{
    return 0;
}
