"""Emitted C under the strict warnings of several compilers, what is left in its objects, and choices by macros."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from emit.stands import generated, stand, write
from mahovik.core.emit.delivery import delivery
from mahovik.core.emit.generate import generate, generate_all
from mahovik.core.emit.log_format import RECORDED
from mahovik.core.emit.recorder import recorder_files
from mahovik.core.stand.random import BARE, EVERYTHING, Features, random_stand
from toolchain.quick import quick
from toolchain.tools import compile_c, compile_elsewhere, require, run, symbols_of

CASES = ("everything6 double", "hung5 float", "everything6 float", "bare0 float", "everything0 double", "held3 double")
"""Stands and element types."""
ARM = ("arm-none-eabi-gcc", "gcc-arm-none-eabi libnewlib-arm-none-eabi")
RISCV = ("riscv64-unknown-elf-gcc", "gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf")


@pytest.fixture(scope="module", params=quick(1, CASES))
def source(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The C file of a stand, its header and its recorder beside it."""
    name, real = request.param.split()
    made = generate_all(stand(name), real)
    return write(made.files | recorder_files(stand(name), made), tmp_path_factory.mktemp(name))


def recorder_of(source: Path) -> Path:
    return source.parent / "verification" / f"{source.stem}_recorder.c"


def test_no_warning_and_bare_objects(source: Path, tmp_path: Path) -> None:
    """gcc -O2 warns of nothing; objects need no library, have constants alone, and all names are the stand's."""
    name, header = source.stem, source.with_suffix(".h").read_text()
    listed = [(kind, symbol) for kind, symbol in symbols_of(source, tmp_path) if not symbol.startswith(".")]
    assert {symbol for kind, symbol in listed if kind == "U"} <= {"memcpy", "memmove", "memset"}
    defined = [(kind, symbol) for kind, symbol in listed if kind != "U"]
    assert defined and {kind for kind, _ in defined} <= set("TtRr")
    assert [symbol for _, symbol in defined if not symbol.startswith(f"{name}_")] == []
    assert [s for kind, s in defined if kind in "TR" and not re.search(rf"\b{s}\b", header)] == []
    recorder = symbols_of(recorder_of(source), tmp_path)
    assert {s for kind, s in recorder if kind == "U"} <= {*(f"{name}_{step}" for step in RECORDED), "memcpy", "memset"}
    assert {kind for kind, _ in recorder} <= set("UTtRr")


def test_clang_and_32_bits(source: Path) -> None:
    compile_elsewhere(source)
    compile_elsewhere(recorder_of(source))


def test_headers_twice_in_c_and_cpp(source: Path, tmp_path: Path) -> None:
    twice = f'#include "{source.stem}.h"\n#include "verification/{source.stem}_recorder.h"\n' * 2
    user = tmp_path / "user.c"
    user.write_text(twice)
    compile_c(require("gcc", "gcc"), user, f"-I{source.parent}", "-fsyntax-only")
    flags = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror", f"-I{source.parent}")
    run(require("g++", "g++"), *flags, "-fsyntax-only", "-x", "c++", user)


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_after_complex_and_tgmath(source: Path, compiler: str) -> None:
    """Macros of the standard library, such as I, replace no word of header or source."""
    macros = ("-include", "complex.h", "-include", "tgmath.h")
    compile_c(require(compiler, compiler), source, *macros, "-fsyntax-only")


def test_a_header_of_another_stand_is_refused(tmp_path: Path) -> None:
    source = write(generated("bench8").files, tmp_path)
    header = source.with_suffix(".h")
    header.write_text(re.sub(r"(PHYSICS +0x)[0-9a-f]{8}", r"\g<1>00000001", header.read_text()))
    with pytest.raises(AssertionError, match="are of different stands"):
        compile_c(require("gcc", "gcc"), source, "-fsyntax-only")


CLASHES = """
n N ok range h structure physics w1 W1 w1_1 W1_1 max_phase largest not_finite code const_ real
wrenches wrench_carrier w wrench_w WRENCH_W WRENCHES_0 x stand status phi s c V F out i j k
NULL EOF INT32_MAX errno main abs uint64_t
"""
"""Names of flywheels: like our own, like one another in capitals, like variables of the C, like names of libc."""


@pytest.mark.parametrize(("name", "features"), quick(1, [("B", EVERYTHING), ("x_", BARE)]))
def test_names_that_clash(name: str, features: Features, tmp_path: Path) -> None:
    names = CLASHES.split()
    stand = random_stand(np.random.default_rng(5), len(names), features, name)
    wheels = zip(stand.flywheels, names, strict=True)
    stand = replace(stand, flywheels=tuple(replace(w, name=n, wrench_input=features is EVERYTHING) for w, n in wheels))
    source = write(generate(stand), tmp_path)
    compile_c(require("gcc", "gcc"), source, "-fsyntax-only")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("tool", "flags", "symbol"),
    [
        (ARM, ("-mthumb", "-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"), r"__aeabi_"),
        (ARM, ("-mthumb", "-mcpu=cortex-m3", "-mfloat-abi=soft"), r"__aeabi_(c?d|[a-z]+2d)"),
        (RISCV, ("-march=rv32imac", "-mabi=ilp32", "--specs=picolibc.specs"), r"__.*df"),
    ],
    ids=["m4", "m3", "rv32imac"],
)
def test_float_calls_no_helper_of_double(
    tool: tuple[str, str], flags: tuple[str, ...], symbol: str, tmp_path: Path
) -> None:
    """`-Wdouble-promotion` alone misses conversions."""
    source = write(generate(stand("everything6"), "float"), tmp_path)
    thing = tmp_path / "stand.o"
    run(require(*tool), "-std=c99", "-O2", "-ffp-contract=off", *flags, "-c", source, "-o", thing)
    wanted = run(require("nm", "binutils"), "-u", "-f", "posix", thing).split("\n")
    assert [line for line in wanted if re.search(symbol, line)] == []


@pytest.mark.slow
def test_float_has_no_instruction_of_double_on_the_m7(tmp_path: Path) -> None:
    source = write(generate(stand("everything6"), "float"), tmp_path)
    flags = ("-mthumb", "-mcpu=cortex-m7", "-mfpu=fpv5-d16", "-mfloat-abi=hard", "-ffp-contract=off")
    run(require(*ARM), "-std=c99", "-O2", *flags, "-c", source, "-o", tmp_path / "stand.o")
    objdump = require("arm-none-eabi-objdump", "binutils-arm-none-eabi")
    listing = run(objdump, "-d", "--no-show-raw-insn", tmp_path / "stand.o")
    assert ".f32" in listing
    assert re.findall(r"\S*\.f64\S*", listing) == []


@pytest.mark.slow
@pytest.mark.parametrize(("real", "root"), [("double", "__builtin_sqrt"), ("float", "__builtin_sqrtf")])
def test_the_root_of_the_processor_gives_the_same_bits(real: str, root: str, tmp_path: Path) -> None:
    """NAME_SQRT: the self-test passes, and notices a root that is one unit too large."""
    source = write(delivery(stand("shaker2"), real, additions=("selftest",)), tmp_path)
    test, program = tmp_path / "verification/shaker2_selftest.c", tmp_path / "program"
    flags = ("-O2", "-ffp-contract=off", "-fno-math-errno", "-DSHAKER2_SELFTEST_MAIN")
    for macro in (root, f"1.0000001{'F' if real == 'float' else ''} * {root}"):
        compile_c(require("gcc", "gcc"), source, test, *flags, f"-DSHAKER2_SQRT={macro}", "-o", program)
        if macro == root:
            assert run(program).splitlines()[-1] == "failures 0"
        else:
            with pytest.raises(AssertionError, match="program"):
                run(program)


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_a_status_is_an_int_where_enums_are_short(compiler: str, tmp_path: Path) -> None:
    write(generated("shaker2").files, tmp_path)
    (tmp_path / "user.c").write_text("""#include "shaker2.h"
typedef char as_an_int[sizeof(shaker2_status) == sizeof(int) ? 1 : -1];
typedef char rows_too[sizeof(shaker2_status[3]) == 3 * sizeof(int) ? 1 : -1];
""")
    compile_c(require(compiler, compiler), tmp_path / "user.c", "-fshort-enums", "-fsyntax-only")
