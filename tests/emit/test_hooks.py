"""Choices of a compiler or processor: the square root, by NAME_SQRT, and the size of enums."""

from __future__ import annotations

from pathlib import Path

import pytest

from emit.stands import stand, write
from mahovik.core.emit.delivery import firmware
from toolchain.tools import compile_c, require, run


@pytest.mark.slow
@pytest.mark.parametrize(("real", "root"), [("double", "__builtin_sqrt"), ("float", "__builtin_sqrtf")])
def test_the_root_of_the_processor_gives_the_same_bits(real: str, root: str, tmp_path: Path) -> None:
    """All golden vectors and sweeps of the self-test; a root that is one unit too large is noticed."""
    source = write(firmware(stand("shaker2"), real), tmp_path)
    test, program = tmp_path / "verification/shaker2_selftest.c", tmp_path / "program"
    for macro in (root, f"1.0000001{'F' if real == 'float' else ''} * {root}"):
        compile_c(
            require("gcc", "gcc"),
            source,
            test,
            "-O2",
            "-ffp-contract=off",
            "-DSHAKER2_SELFTEST_MAIN",
            f"-DSHAKER2_SQRT={macro}",
            "-fno-math-errno",
            "-o",
            program,
        )
        if macro == root:
            assert run(program).splitlines()[-1] == "failures 0"
        else:
            with pytest.raises(AssertionError, match="program"):
                run(program)


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_a_status_is_an_int_where_enums_are_short(compiler: str, tmp_path: Path) -> None:
    write(firmware(stand("shaker2")), tmp_path)
    (tmp_path / "user.c").write_text("""#include "shaker2.h"
typedef char as_an_int[sizeof(shaker2_status) == sizeof(int) ? 1 : -1];
typedef char rows_too[sizeof(shaker2_status[3]) == 3 * sizeof(int) ? 1 : -1];
""")
    compile_c(require(compiler, compiler), tmp_path / "user.c", "-fshort-enums", "-fsyntax-only")
