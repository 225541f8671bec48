"""Object files whose headers do not belong together do not link."""

from __future__ import annotations

import re
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from emit.stands import stand, write
from mahovik.core.emit.generate import generate, generate_all
from toolchain.tools import compile_c, require, run

CALLER = """
#include "shaker2.h"
int main(void)
{
    shaker2_state x = { .attitude = { 1 } };
    shaker2_real wrapped;
    return (int)shaker2_wrap(x.phi[0], &wrapped) + (int)x.V[0];
}
"""
FLAGS = ("-O2", "-ffunction-sections", "-fdata-sections")


def caller_of(folder: Path, files: dict[str, str], compiler: str, *flags: str) -> Path:
    """Object file of a caller that includes the header."""
    folder.mkdir()
    write(files, folder)
    caller, called = folder / "caller.c", folder / "caller.o"
    caller.write_text(CALLER)
    compile_c(compiler, caller, "-c", *FLAGS, *flags, f"-I{folder}", "-o", called)
    return called


def linked(compiler: str, *sources: Path | str) -> str:
    """Messages of the linker."""
    command = [compiler, *map(str, sources), "-Wl,--gc-sections", "-o", str(Path(str(sources[0])).parent / "program")]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=60).stderr


@pytest.mark.slow
@pytest.mark.parametrize("flag", ["-fuse-ld=lld", "-flto"])
def test_a_caller_with_another_header_does_not_link(flag: str, tmp_path: Path) -> None:
    """Every linker refuses it, without debugging information too."""
    require("gcc", "gcc")
    require("ld.lld", "lld")
    compiled = ("-flto",) if flag == "-flto" else ()
    plain = stand("shaker2")
    heavier = replace(plain, carrier=replace(plain.carrier, mass=plain.carrier.mass * 2))
    caller = caller_of(tmp_path / "double", generate(plain), "gcc", *compiled)
    source = tmp_path / "double" / "stand.o"
    compile_c("gcc", tmp_path / "double" / "shaker2.c", "-c", *FLAGS, *compiled, "-o", source)
    assert linked("gcc", source, caller, flag) == ""
    changes = {
        "float": generate(plain, "float"),
        "stand": generate(heavier),
        "part": generate_all(plain, only=("wrap", "prepare")).files,
    }
    for what, files in changes.items():
        other = caller_of(tmp_path / what, files, "gcc", *compiled)
        if not compiled:
            run("strip", "-g", other)
        said = linked("gcc", source, other, flag)
        assert re.search(r"undefined (reference|symbol).*shaker2_wrap_f(32|64)_[0-9a-f]{8}", said), (what, said)


@pytest.mark.slow
def test_a_mock_takes_the_place_of_the_source(tmp_path: Path) -> None:
    """A file that includes the header and defines the functions that are called links with the caller."""
    caller = caller_of(tmp_path / "double", generate(stand("shaker2")), "gcc")
    mock = tmp_path / "double" / "mock.c"
    mock.write_text("""#include "shaker2.h"
shaker2_status shaker2_wrap(shaker2_real phi, shaker2_real *wrapped)
{
    *wrapped = phi;
    return SHAKER2_OK;
}
""")
    compile_c("gcc", mock, "-c", "-o", mock.with_suffix(".o"))
    assert linked("gcc", caller, mock.with_suffix(".o")) == ""
    compile_c("gcc", mock, "-DSHAKER2_PLAIN_NAMES", "-c", "-o", mock.with_suffix(".o"))
    assert " T shaker2_wrap\n" in run(require("nm", "binutils"), mock.with_suffix(".o"))
