"""Null in the place of the array `locked`, and the hash of the table: what a caller's own C program finds."""

from __future__ import annotations

from pathlib import Path

import pytest

from emit.stands import stand, write
from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.recorder import recorder_files
from toolchain.tools import compile_c, require, run

CALLER = r"""
#include <stdio.h>
#include <string.h>
#include "shaker2_batch.h"
#include "verification/shaker2_recorder.h"

enum { N = SHAKER2_N };

static int kept(void *context, const unsigned char *bytes, size_t count)
{
    unsigned long *sum = context;
    for (size_t i = 0; i < count; ++i) { *sum = *sum * 31u + bytes[i]; }
    return 0;
}

typedef struct {
    shaker2_real V_dot[6], phi_ddot[N], many[6], spun[N];
    shaker2_state next, logged;
    shaker2_coupled_jacobian_result slopes;
    unsigned long log;
} answers;

int main(void)
{
    static const int none[N] = { 0 };
    static answers given[2];
    const shaker2_state x = { .attitude = { 1 }, .V = { 1, 2, 3, 0.1, 0.2, 0.3 }, .phi_dot = { 30, -40 } };
    const shaker2_real tau[N] = { 0.01, -0.02 };
    int good = 1;
    for (int i = 0; i < 2; ++i) {
        answers *a = &given[i];
        const int *locked = i == 0 ? none : NULL;
        shaker2_recorder log = { .write = kept, .context = &a->log };
        shaker2_status status[1];
        a->logged = x;
        good &= shaker2_coupled(&shaker2_default, &x, tau, locked, a->V_dot, a->phi_ddot) == 0;
        good &= shaker2_step(&shaker2_default, &x, tau, locked, 1e-3, 4, NULL, &a->next) == 0;
        good &= shaker2_coupled_jacobian(&shaker2_default, &x, tau, locked, &a->slopes) == 0;
        good &= shaker2_coupled_batch(&shaker2_default, 1, (const shaker2_real *)&x, tau, locked, a->many, a->spun,
                                      status) == 0;
        good &= shaker2_recorder_start(&log, &shaker2_default, &a->logged) == 0;
        good &= shaker2_recorder_step(&log, &shaker2_default, &a->logged, tau, locked, 1e-3, 4, NULL) == 0;
    }
    good &= memcmp(&given[0], &given[1], sizeof given[0]) == 0;
    const unsigned char *bytes = (const unsigned char *)&shaker2_default;
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < sizeof shaker2_default; ++i) { hash = (hash ^ bytes[i]) * 16777619u; }
    return !(good && hash == SHAKER2_TABLE_HASH);
}
"""


@pytest.mark.slow
def test_null_is_no_lock_and_the_table_has_its_hash(tmp_path: Path) -> None:
    """The table of shaker2 has reals only, so that its memory is what the hash is of."""
    made = generate_all(stand("shaker2"))
    write({**made.files, **batch_files(stand("shaker2"), made), **recorder_files(stand("shaker2"), made)}, tmp_path)
    (tmp_path / "caller.c").write_text(CALLER)
    sources = [
        tmp_path / name for name in ("caller.c", "shaker2.c", "shaker2_batch.c", "verification/shaker2_recorder.c")
    ]
    program = tmp_path / "caller"
    compile_c(
        require("gcc", "gcc"),
        *sources,
        f"-I{tmp_path}",
        "-fsanitize=address,undefined",
        "-fno-sanitize-recover=all",
        "-o",
        program,
    )
    run(program)
