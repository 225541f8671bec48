"""No double in the C of a float stand, checked in the objects: `-Wdouble-promotion` alone misses conversions."""

import re
from pathlib import Path

import pytest

from emit.stands import float_texts, stand, write
from toolchain.quick import quick
from toolchain.tools import compile_c, require, run

NAMES = ("everything6", "bench8")
ARM = ("arm-none-eabi-gcc", "gcc-arm-none-eabi libnewlib-arm-none-eabi")
RISCV = ("riscv64-unknown-elf-gcc", "gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf")
SINGLE = {
    "m4": ("-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"),
    "m33": ("-mcpu=cortex-m33", "-mfpu=fpv5-sp-d16", "-mfloat-abi=hard"),
}
HELPERS = r"__aeabi_(c?d|[a-z]+2d)"  # double arithmetic, comparisons and conversions of the Arm run-time ABI


@pytest.fixture(scope="module", params=quick(1, NAMES))
def source(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write(float_texts(stand(request.param))[3], tmp_path_factory.mktemp(request.param))


def undefined(source: Path, tmp_path: Path, tool: str, *flags: str) -> tuple[list[str], Path]:
    """Undefined symbols of the object, and the object."""
    thing = tmp_path / "stand.o"
    run(tool, "-std=c99", "-O2", "-ffp-contract=off", *flags, "-c", source, "-o", thing)
    return run(require("nm", "binutils"), "-u", "-f", "posix", thing).split("\n"), thing


@pytest.mark.slow
@pytest.mark.parametrize("name", quick(1, SINGLE))
def test_no_helpers_of_double_where_the_fpu_is_single(name: str, source: Path, tmp_path: Path) -> None:
    wanted, _ = undefined(source, tmp_path, require(*ARM), "-mthumb", *SINGLE[name])
    assert {line.split()[0] for line in wanted if line} <= {"memcpy", "memmove", "memset"}


@pytest.mark.slow
def test_soft_float_calls_single_helpers_only(source: Path, tmp_path: Path) -> None:
    wanted, _ = undefined(source, tmp_path, require(*ARM), "-mthumb", "-mcpu=cortex-m3", "-mfloat-abi=soft")
    assert any("__aeabi_fadd" in line for line in wanted)  # the pattern does look at such names
    assert [line for line in wanted if re.search(HELPERS, line)] == []


@pytest.mark.slow
def test_no_double_on_risc_v_without_an_fpu(source: Path, tmp_path: Path) -> None:
    flags = ("-march=rv32imac", "-mabi=ilp32", "--specs=picolibc.specs")
    wanted, _ = undefined(source, tmp_path, require(*RISCV), *flags)
    assert any("__addsf3" in line for line in wanted)
    assert [line for line in wanted if re.search(r"__.*df", line)] == []


@pytest.mark.slow
def test_no_instruction_of_double_on_the_m7(source: Path, tmp_path: Path) -> None:
    flags = ("-mthumb", "-mcpu=cortex-m7", "-mfpu=fpv5-d16", "-mfloat-abi=hard")
    _, thing = undefined(source, tmp_path, require(*ARM), *flags)
    listing = run(require("arm-none-eabi-objdump", "binutils-arm-none-eabi"), "-d", "--no-show-raw-insn", thing)
    assert ".f32" in listing
    assert re.findall(r"\S*\.f64\S*", listing) == []


def test_clang_sees_no_conversion_to_double(source: Path) -> None:
    compile_c(require("clang", "clang"), source, "-Wdouble-promotion", "-Wimplicit-float-conversion", "-fsyntax-only")


def test_every_literal_is_a_float(source: Path) -> None:
    for path in (source, source.with_suffix(".h")):
        text = re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.DOTALL)
        assert not re.search(r"\bdouble\b", text)
        assert [n for n in re.findall(r"(?<![\w.])\d+\.\d+(?:e[-+]?\d+)?\w*", text) if not n.endswith("F")] == []
