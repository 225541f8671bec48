"""Flywheels side by side: the bits of the interpreter from every compiler, with vectors and without."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from emit.selftests import generate_with_selftest, run_selftest
from emit.stands import stand, write
from mahovik.core.emit.delivery import selftest_files
from mahovik.core.emit.generate import LANES, generate_all, host_lanes
from mahovik.errors import UsageError
from toolchain.tools import FIRMWARE_WARNINGS, compile_c, require, run

NATIVE = ("-march=native", "-fno-tree-slp-vectorize")
"""gcc 12 fuses where it vectorises straight code; loops over lanes stay vectors."""

BUILDS = (
    ("gcc", "-O0"),
    ("gcc", "-O2"),
    ("gcc", "-O3"),
    ("gcc", "-O3", *NATIVE),
    ("clang", "-O2"),
    ("clang", "-O3", "-march=native"),
)

CASES = (
    ("everything1", 2, "double"),
    ("everything6", 4, "double"),
    ("everything6", 8, "float"),
    ("bare5", 2, "double"),
    ("bare5", 8, "float"),
    ("wet7", 4, "float"),
    ("wet7", 8, "double"),
    ("bench8", 2, "double"),
    ("bench8", 4, "double"),
    ("bench8", 8, "double"),
)
"""Full and padded blocks; fluid, buoyancy and run-time wrenches of flywheels; locked ones are in the cases."""


def passes(files: dict[str, str], name: str, folder: Path, compiler: str, *flags: str) -> None:
    """Every public function: golden vectors of the interpreter, all bits of all outputs."""
    require(compiler, compiler)
    status, printed = run_selftest(files, name, folder, compiler, *flags)
    assert status == 0, printed
    assert len(re.findall("^[a-z_]+ PASS ", printed, re.MULTILINE)) >= 15
    assert printed.endswith("failures 0\n")


@pytest.mark.slow
@pytest.mark.parametrize("build", [BUILDS[3], BUILDS[5]], ids=" ".join)
def test_bits_with_vectors(build: tuple[str, ...], tmp_path: Path) -> None:
    passes(generate_with_selftest("everything6", "double", 4)[1], "everything6", tmp_path, *build)


@pytest.mark.slow
@pytest.mark.parametrize("build", BUILDS, ids=" ".join)
@pytest.mark.parametrize(("name", "lanes", "real"), CASES)
def test_bits(name: str, lanes: int, real: str, build: tuple[str, ...], tmp_path: Path) -> None:
    passes(generate_with_selftest(name, real, lanes)[1], name, tmp_path, *build)


@pytest.mark.slow
@pytest.mark.parametrize("build", [BUILDS[1], BUILDS[3], BUILDS[5]], ids=" ".join)
@pytest.mark.parametrize("lanes", LANES[1:])
def test_bits_of_phases_given_by_sines(lanes: int, build: tuple[str, ...], tmp_path: Path) -> None:
    given = replace(stand("everything6"), phase_input="sincos")
    generated = generate_all(given, "double", lanes)
    passes({**generated.files, **selftest_files(given, generated)}, given.name, tmp_path, *build)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("march", "packed"), [("x86-64-v3", r"v(?:mul|add|sub)pd .*%ymm"), ("x86-64", r"(?:mul|add|sub)pd .*%xmm")]
)
def test_gcc_makes_vectors_of_the_lanes(march: str, packed: str, tmp_path: Path) -> None:
    """Nearly all sums and products of the loops over flywheels are packed: else lanes would be for nothing."""
    gcc, objdump = require("gcc", "gcc"), require("objdump", "binutils")
    if run(gcc, "-dumpmachine").split("-")[0] != "x86_64":
        pytest.skip("gcc here is not for x86-64: its vectors have other names")
    source = write(generate_all(stand("bench8"), "double", 4).files, tmp_path)
    compile_c(gcc, source, "-g", "-O3", f"-march={march}", "-c", "-o", tmp_path / "o")
    by_line = instructions_by_line(run(objdump, "-d", "-l", "--no-show-raw-insn", tmp_path / "o"), source.name)
    for function in ("add_block", "couple_block", "balance_block", "eliminate_block"):
        first, last = lines_of(source.read_text(encoding="ascii"), f"bench8_{function}")
        text = "\n".join(line for number in range(first, last + 1) for line in by_line.get(number, ()))
        assert len(re.findall(packed, text)) > 50, function
        assert len(re.findall(r"\bv?(?:mul|add|sub)sd ", text)) < 10, function


def instructions_by_line(disassembly: str, source: str) -> dict[int, list[str]]:
    """Instructions by line of the source that they come from, in whatever function gcc has inlined that line."""
    found: dict[int, list[str]] = {}
    number = 0
    for line in disassembly.splitlines():
        place = re.search(rf"{re.escape(source)}:(\d+)", line)
        if place:
            number = int(place[1])
        elif re.match(r" +[0-9a-f]+:\t", line):
            found.setdefault(number, []).append(line)
    return found


def lines_of(source: str, function: str) -> tuple[int, int]:
    """First and last line of the definition of a static function."""
    lines = source.splitlines()
    first = next(i for i, line in enumerate(lines, 1) if line.startswith("static") and f" {function}(" in line)
    return first, next(i for i, line in enumerate(lines, 1) if i > first and line == "}")


@pytest.mark.slow
@pytest.mark.parametrize(("there", "here"), [(1, 4), (4, 1), (4, 8)])
def test_header_and_sources_of_other_lanes_are_refused(there: int, here: int, tmp_path: Path) -> None:
    require("gcc", "gcc")
    files = dict(generate_with_selftest("demo3", "double", here)[1])
    files["demo3.h"] = generate_with_selftest("demo3", "double", there)[1]["demo3.h"]
    write(files, tmp_path)
    for name in ("demo3.c", "verification/demo3_selftest.c"):
        with pytest.raises(AssertionError, match="were generated for different numbers of lanes"):
            run("gcc", *FIRMWARE_WARNINGS, "-fsyntax-only", tmp_path / name)


def test_one_lane_is_the_code_without_blocks() -> None:
    text = generate_with_selftest("demo3")[1]["demo3.c"]
    assert "BLOCKS" not in text
    assert "#if DEMO3_LANES != 1\n" in text


def test_lanes_that_suit_a_desk() -> None:
    assert [host_lanes(n) for n in (0, 1, 2, 4, 5, 8, 24, 25, 28, 29, 32, 1000)] == [1, 1, 2, 2, 4, 4, 4, 4, 4, 8, 8, 8]


@pytest.mark.parametrize("lanes", [0, 3, 16])
def test_other_numbers_are_refused(lanes: int) -> None:
    with pytest.raises(UsageError, match=f"--lanes {lanes}: only 1, 2, 4, 8 can be generated"):
        generate_all(stand("demo3"), "double", lanes)
