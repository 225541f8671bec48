/* RISC-V, machine mode, from reset to main: pointers, FPU on, .bss cleared; and the semihosting call. */
    .option arch, +zicsr

    .section .start, "ax"
    .globl  _start
_start:
    .option push
    .option norelax
    la      gp, __global_pointer$
    .option pop
    la      sp, board_stack_top
    la      t0, fault
    csrw    mtvec, t0
    li      t0, 0x2000          /* mstatus.FS = initial; no effect where there is no FPU */
    csrs    mstatus, t0
#ifdef __riscv_flen
    csrw    fcsr, zero          /* round to nearest, no flags */
#endif
    la      t0, board_bss_begin
    la      t1, board_bss_end
1:  bgeu    t0, t1, 2f
    sw      zero, 0(t0)
    addi    t0, t0, 4
    j       1b
2:  call    main
    j       board_exit          /* status of main in a0 */

    .balign 4
fault:                          /* a crash ends the program with a status of its own instead of hanging */
    li      a0, 99
    j       board_exit

    /* int board_semihosting(operation in a0, argument in a1): three uncompressed instructions on one page */
    .text
    .globl  board_semihosting
    .option push
    .option norvc
    .option norelax
    .balign 16
board_semihosting:
    slli    x0, x0, 0x1f
    ebreak
    srai    x0, x0, 7
    ret
    .option pop
