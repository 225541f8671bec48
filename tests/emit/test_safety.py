"""Emitted C that a compiler must refuse: fast math, and a header that is not that of the source."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from emit.stands import float_texts, generated, stand, write
from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.delivery import selftest_files
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.names import RESERVED
from mahovik.core.lower.limits import constants, limits
from mahovik.core.program.types import DOUBLE
from mahovik.core.toolchain.compiler import BITS
from mahovik.proof.verify.selftest import problems, read_log
from toolchain.tools import require

LEAVE = "-DBENCH8_ALLOW_FAST_MATH"


def complaint(compiler: str, source: Path, *flags: str) -> str:
    """Complaint of a compiler that must refuse a source, empty if it takes it."""
    command = [require(compiler, compiler), "-std=c99", "-Wundef", "-fsyntax-only", *flags, str(source)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode != 0) == ("#error" in done.stderr or "error:" in done.stderr)
    return done.stderr


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """C of bench8 with its batches."""
    made = tmp_path_factory.mktemp("bench8")
    write({**generated("bench8").files, **batch_files(stand("bench8"), generated("bench8"))}, made)
    return made


@pytest.mark.parametrize("source", ["bench8.c", "bench8_batch.c"])
@pytest.mark.parametrize(
    ("compiler", "flag"),
    [
        ("gcc", "-ffast-math"),
        ("clang", "-Ofast"),
        ("gcc", "-funsafe-math-optimizations"),
        ("gcc", "-freciprocal-math"),
    ],
)
def test_fast_math_is_refused_without_leave(folder: Path, source: str, compiler: str, flag: str) -> None:
    assert "wrong results" in complaint(compiler, folder / source, flag)
    assert complaint(compiler, folder / source, flag, LEAVE) == ""


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_checks_of_numbers_are_not_compiled_away(folder: Path, compiler: str) -> None:
    assert "NaN would pass" in complaint(compiler, folder / "bench8.c", "-ffinite-math-only")


@pytest.mark.slow
@pytest.mark.parametrize("real", ["double", "float"])
def test_what_clang_does_not_show_fails_in_the_self_test(real: str, tmp_path: Path) -> None:
    """The answers are wrong and the statuses OK: the header says so, and the self-test in its first line."""
    made = generate_all(stand("bench8"), real)
    write({**made.files, **selftest_files(stand("bench8"), made)}, tmp_path)
    program = tmp_path / "selftest"
    sources = [str(tmp_path / name) for name in ("bench8.c", "verification/bench8_selftest.c")]
    flags = ("-O2", *BITS, "-funsafe-math-optimizations", "-DBENCH8_SELFTEST_MAIN")
    subprocess.run(
        [require("clang", "clang"), "-std=c99", *flags, *sources, "-o", str(program)], check=True, capture_output=True
    )
    done = subprocess.run([program], capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 1
    assert "forward FAIL" in done.stdout
    first, second, *_ = done.stdout.splitlines()
    assert first == "wrong results: compiled with -ffast-math, -Ofast, -funsafe-math-optimizations or a part of them"
    assert second.startswith("mahovik selftest bench8 ")
    (log,) = read_log(done.stdout, "selftest")
    assert problems(log)[0] == first
    for name in ("bench8.h", "verification/bench8_selftest.c"):
        assert "wrong results with status ok" in (tmp_path / name).read_text().lower()


def test_header_and_source_of_different_element_types(tmp_path: Path) -> None:
    text = generated("bench8").files
    single = float_texts(stand("bench8"))[3]
    source = write({"bench8.h": single["bench8.h"], "bench8.c": text["bench8.c"]}, tmp_path)
    assert "different element types" in complaint("gcc", source)


def test_header_and_source_of_different_versions(tmp_path: Path) -> None:
    text = generated("bench8").files
    header = re.sub(r"(VERSION_MINOR )\d+", r"\g<1>99", text["bench8.h"])
    source = write({"bench8.h": header, "bench8.c": text["bench8.c"]}, tmp_path)
    assert "different versions" in complaint("gcc", source)


def test_every_macro_of_the_files_is_reserved(folder: Path) -> None:
    """It finds macros with the stand's name in header and source, but for limits, counts and the recorder's."""
    macros = set()
    for path in folder.iterdir():
        defined = re.findall(r"#(?:define|ifndef|ifdef) BENCH8_(\w+)", path.read_text())
        macros |= {name for name in defined if name not in {*limits(DOUBLE), *(x.name for x in constants(DOUBLE))}}
    assert macros >= {"BATCH_H", "REAL_BYTES", "ALLOW_FAST_MATH"}
    assert macros <= RESERVED
