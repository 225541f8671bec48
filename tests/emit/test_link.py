"""Object files whose headers do not belong together do not link; those that do are no byte larger for it."""

from __future__ import annotations

import re
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from cli.run import refused
from cli.run import run as cli
from emit.stands import stand, write
from mahovik.core.emit.generate import generate
from mahovik.stands import path
from toolchain.quick import quick
from toolchain.tools import compile_c, require

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


def objects(folder: Path, files: dict[str, str], compiler: str, *flags: str) -> tuple[Path, Path]:
    """Object files of the C and of a caller that includes its header."""
    called = caller_of(folder, files, compiler, *flags)
    made = folder / "stand.o"
    compile_c(compiler, folder / "shaker2.c", "-c", *FLAGS, *flags, "-o", made)
    return made, called


def caller_of(folder: Path, files: dict[str, str], compiler: str, *flags: str) -> Path:
    """Object file of a caller that includes the header."""
    folder.mkdir()
    write(files, folder)
    caller, called = folder / "caller.c", folder / "caller.o"
    caller.write_text(CALLER)
    compile_c(compiler, caller, "-c", *FLAGS, *flags, f"-I{folder}", "-o", called)
    return called


def linked(compiler: str, *given: Path | str) -> str:
    """Messages of the linker."""
    command = [compiler, *map(str, given), "-Wl,--gc-sections", "-o", str(Path(str(given[0])).parent / "program")]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=60).stderr


@pytest.mark.slow
@pytest.mark.parametrize(("compiler", "lto"), quick(1, [("gcc", ("-flto",)), ("gcc", ()), ("clang", ())]))
def test_a_caller_with_another_header_does_not_link(compiler: str, lto: tuple[str, ...], tmp_path: Path) -> None:
    compiler = require(compiler, compiler)
    plain = stand("shaker2")
    heavier = replace(plain, carrier=replace(plain.carrier, mass=plain.carrier.mass * 2))
    source, caller = objects(tmp_path / "double", generate(plain), compiler, *lto)
    assert linked(compiler, source, caller, *lto) == ""
    others = {"float": generate(plain, "float"), "stand": generate(heavier)}
    for what, files in others.items():
        other = caller_of(tmp_path / what, files, compiler, *lto)
        said = linked(compiler, source, other, *lto)
        assert re.search(r"undefined (reference|symbol).*shaker2_link_(double|float)_v", said), (what, said)
    assert "shaker2_link_float_v" in linked(compiler, source, tmp_path / "float" / "caller.o", *lto)


@pytest.mark.slow
def test_float_and_double_lie_in_one_image_under_two_names(tmp_path: Path) -> None:
    assert cli("generate", str(path("shaker2")), "-o", str(tmp_path)).exit_code == 0
    given = ("--real", "float", "--prefix", "shaker2f", "-o", str(tmp_path / "f"))
    assert cli("generate", str(path("shaker2")), *given).exit_code == 0
    assert cli("generate", str(path("shaker2")), *given, "--check").exit_code == 0
    (tmp_path / "main.c").write_text("""#include "shaker2.h"
#include "f/shaker2f.h"
int main(void)
{
    shaker2_real a;
    shaker2f_real b;
    typedef char two_types[sizeof a == 8 && sizeof b == 4 ? 1 : -1];
    (void)sizeof(two_types);
    return (int)shaker2_wrap(1, &a) + (int)shaker2f_wrap(1, &b);
}
""")
    compile_c("gcc", tmp_path / "main.c", tmp_path / "shaker2.c", tmp_path / "f" / "shaker2f.c", "-o", tmp_path / "two")
    subprocess.run([tmp_path / "two"], check=True, timeout=60)
    assert "--prefix 2f: " in refused("generate", str(path("shaker2")), "--prefix", "2f")


@pytest.mark.slow
def test_the_check_takes_no_memory_and_can_be_left_out(tmp_path: Path) -> None:
    compiler = require("gcc", "gcc")
    checked = objects(tmp_path / "with", generate(stand("shaker2")), compiler)
    without = objects(tmp_path / "without", generate(stand("shaker2")), compiler, "-DSHAKER2_NO_LINK_CHECK")
    sizes = [
        subprocess.run(["size", *map(str, two)], capture_output=True, text=True, check=True)
        for two in (checked, without)
    ]
    figures = [[line.split()[:4] for line in done.stdout.splitlines()] for done in sizes]
    assert figures[0] == figures[1]
    wide = caller_of(tmp_path / "float", generate(stand("shaker2"), "float"), compiler, "-DSHAKER2_NO_LINK_CHECK")
    assert linked(compiler, checked[0], wide) == ""


@pytest.mark.slow
def test_the_linker_of_aarch64_takes_it(tmp_path: Path) -> None:
    """It refuses an address of a number in the object that defines it."""
    compiler = require("aarch64-linux-gnu-gcc", "gcc-aarch64-linux-gnu")
    source, caller = objects(tmp_path / "double", generate(stand("shaker2")), compiler)
    assert linked(compiler, source, caller) == ""
