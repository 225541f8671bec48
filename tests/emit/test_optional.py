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
#include "shaker2_recorder.h"

enum { N = SHAKER2_N };

static int kept(void *context, const unsigned char *bytes, size_t count)
{
    unsigned long *sum = context;
    for (size_t i = 0; i < count; ++i) { *sum = *sum * 31u + bytes[i]; }
    return 0;
}

/* The same bytes for null and for zeros? */
static int alike(const char *what, const void *a, const void *b, size_t size)
{
    const int same = memcmp(a, b, size) == 0;
    printf("%s %s\n", what, same ? "alike" : "different");
    return same;
}

int main(void)
{
    static const int none[N] = { 0 };
    static shaker2_coupled_jacobian_result slopes[2];
    shaker2_state x = { .attitude = { 1 }, .V = { 1, 2, 3, 0.1, 0.2, 0.3 }, .phi = { 1, 2 }, .phi_dot = { 30, -40 } };
    shaker2_state next[2] = { x, x }, logged[2] = { x, x };
    const shaker2_real tau[N] = { 0.01, -0.02 };
    shaker2_real V_dot[2][6], phi_ddot[2][N], many[2][6], spun[2][N];
    shaker2_status status[2][1];
    unsigned long logs[2] = { 0, 0 };
    int good = 1;
    for (int i = 0; i < 2; ++i) {
        const int *locked = i == 0 ? none : NULL;
        shaker2_recorder log = { .write = kept, .context = &logs[i] };
        good &= shaker2_coupled(&shaker2_default, &x, tau, locked, V_dot[i], phi_ddot[i]) == 0;
        good &= shaker2_step(&shaker2_default, &x, tau, locked, 1e-3, 4, &next[i]) == 0;
        good &= shaker2_coupled_jacobian(&shaker2_default, &x, tau, locked, &slopes[i]) == 0;
        good &= shaker2_coupled_batch(&shaker2_default, 1, (const shaker2_real *)&x, tau, locked, many[i], spun[i],
                                      status[i]) == 0;
        good &= shaker2_recorder_start(&log, &shaker2_default, &logged[i]) == 0;
        good &= shaker2_recorder_step(&log, &shaker2_default, &logged[i], tau, locked, 1e-3, 4) == 0;
    }
    good &= alike("V_dot", V_dot[0], V_dot[1], sizeof V_dot[0]);
    good &= alike("phi_ddot", phi_ddot[0], phi_ddot[1], sizeof phi_ddot[0]);
    good &= alike("next", &next[0], &next[1], sizeof next[0]);
    good &= alike("slopes", &slopes[0], &slopes[1], sizeof slopes[0]);
    good &= alike("batch", many[0], many[1], sizeof many[0]);
    good &= alike("batch", many[0], V_dot[0], sizeof many[0]);
    good &= alike("logged", &logged[0], &logged[1], sizeof logged[0]);
    good &= alike("logs", &logs[0], &logs[1], sizeof logs[0]);
    const unsigned char *bytes = (const unsigned char *)&shaker2_default;
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < sizeof shaker2_default; ++i) { hash = (hash ^ bytes[i]) * 16777619u; }
    printf("table %s\n", hash == SHAKER2_TABLE_HASH ? "intact" : "changed");
    return !(good && hash == SHAKER2_TABLE_HASH);
}
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    "flags", [("-fsanitize=address,undefined", "-fno-sanitize-recover=all"), pytest.param((), marks=pytest.mark.slow)]
)
def test_null_is_no_lock_and_the_table_has_its_hash(flags: tuple[str, ...], tmp_path: Path) -> None:
    """The table of shaker2 has reals only, so that its memory is what the hash is of."""
    made = generate_all(stand("shaker2"))
    write({**made.files, **batch_files(stand("shaker2"), made), **recorder_files(stand("shaker2"), made)}, tmp_path)
    (tmp_path / "caller.c").write_text(CALLER)
    sources = [tmp_path / name for name in ("caller.c", "shaker2.c", "shaker2_batch.c", "shaker2_recorder.c")]
    program = tmp_path / "caller"
    compile_c(require("gcc", "gcc"), *sources, f"-I{tmp_path}", *flags, "-o", program)
    run(program)
