"""The fuzz harness notices what it says it asserts: faults are planted in the C, and each must be found in seconds."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest
from checks import compile_harness, fuzz, minimise

from cli.run import DEMO3, run
from mahovik.core.stand import load
from mahovik.core.toolchain.checks import fuzz_project, sources
from mahovik.errors import CheckError
from mahovik.writing import write_all
from toolchain.tools import compile_c, require

pytestmark = pytest.mark.fuzz

PENDULUM = Path(__file__).resolve().parents[2] / "docs" / "held" / "pendulum.toml"

RUNS = 400_000
"""Executions within which every planted fault is found; most in hundreds."""


@dataclass(frozen=True)
class Fault:
    """Replacements in the C of demo3, and the harness's finding for each."""

    name: str
    old: str
    new: str
    said: str


CHECKED = """    if (table == NULL || x == NULL || phi_ddot == NULL || V_dot == NULL) { return DEMO3_BAD_ARGUMENT; }
"""
NULL = "    if (wrapped == NULL) { return DEMO3_BAD_ARGUMENT; }\n"
LOOP = "for (int i = 0; i < count; ++i) {\n        if (!("
RANGE = "{ return DEMO3_RANGE; }\n            return"
WITHIN = "if (!(values[i] >= -limit && values[i] <= limit))"
DONE = "    status = demo3_finish(&y);\n"

FAULTS = (
    Fault("written before a check", CHECKED, f"{CHECKED}    V_dot[5] = 0.0;\n", "a result was written"),
    Fault("not written", "      y[5] = y3;", "", "not the same bits"),
    Fault("loop one too long", LOOP, LOOP.replace("<", "<=", 1), "insufficient space|buffer-overflow"),
    Fault("NaN let through", WITHIN, "if (values[i] < -limit || values[i] > limit)", "finite"),
    Fault("null let through", NULL, "", "null pointer"),
    Fault(
        "other status for null",
        NULL,
        NULL.replace("BAD_ARGUMENT", "NOT_POSITIVE_DEFINITE"),
        "status that is not documented",
    ),
    Fault("status of another cause", RANGE, RANGE.replace("RANGE", "NOT_FINITE"), "every argument is finite"),
    Fault("angle guard gone", "!(phi >= -DEMO3_MAX_PHASE && phi <= DEMO3_MAX_PHASE)", "phi > 1.0e300", "finite"),
    Fault("state written before its last check", DONE, f"    *next = y;\n{DONE}", "a result was written"),
)


@cache
def texts() -> dict[str, str]:
    """The fuzz project of demo3, which nobody changes."""
    return fuzz_project(load(DEMO3), "double")


@pytest.fixture(scope="module")
def harness(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """Objects of all but the C itself."""
    folder = tmp_path_factory.mktemp("harness")
    place(folder, None)
    parts = [source for source in sources("demo3") if source != "demo3.c"]
    return [str(compile_harness(folder, ("-c", source), f"{Path(source).stem}.o")) for source in parts]


def place(folder: Path, fault: Fault | None) -> None:
    """The project, its C with a fault."""
    placed = dict(texts())
    if fault is not None:
        assert fault.old in placed["demo3.c"], fault.name
        placed["demo3.c"] = placed["demo3.c"].replace(fault.old, fault.new, 1)
    write_all(folder, placed)


def build(folder: Path, fault: Fault | None, harness: list[str]) -> Path:
    """A program that fuzzes demo3 with a fault."""
    place(folder, fault)
    return compile_harness(folder, ("-O0", "demo3.c", *harness))  # quicker to compile


@pytest.fixture(autouse=True, scope="module")
def needed() -> None:
    require("clang", "clang libclang-rt-14-dev")


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.name)
def test_a_planted_fault_is_found(fault: Fault, harness: list[str], tmp_path: Path) -> None:
    with pytest.raises(CheckError) as failure:
        fuzz(build(tmp_path, fault, harness), tmp_path / "corpus", runs=RUNS)
    assert re.search(fault.said, str(failure.value))
    # AddressSanitizer ends the process itself, before the fuzzer writes the input.
    assert re.search("Test unit written|AddressSanitizer", str(failure.value))


def test_nothing_is_found_in_the_c_of_a_held_carrier(tmp_path: Path) -> None:
    folder = tmp_path / "project"
    assert run("generate", str(PENDULUM), "--project", "fuzz", "-o", str(folder)).exit_code == 0
    program = compile_harness(folder, ("-O0", *sources("pendulum")))
    assert fuzz(program, tmp_path / "corpus", runs=20_000).executions >= 20_000


def test_without_a_fault_nothing_is_found_and_the_corpus_is_kept_small(harness: list[str], tmp_path: Path) -> None:
    program = build(tmp_path, None, harness)
    corpus = tmp_path / "corpus"
    run_ = fuzz(program, corpus, runs=20_000)
    assert run_.executions >= 20_000
    assert run_.edges > 800
    many = len(list(corpus.iterdir()))
    minimise(program, corpus)
    assert 100 < len(list(corpus.iterdir())) < many


@pytest.mark.parametrize("real", ["double", "float"])
def test_the_harness_is_clean_c_and_runs_files_without_libfuzzer(real: str, tmp_path: Path) -> None:
    folder = tmp_path / "project"
    assert run("generate", DEMO3, "--project", "fuzz", "-o", str(folder), "--real", real).exit_code == 0
    for compiler in ("gcc", "clang"):
        compile_c(compiler, folder / "demo3_fuzz.c", "-I", folder, "-DDEMO3_FUZZ_MAIN", "-c", "-o", tmp_path / "fuzz.o")
    assert (folder / "Makefile").is_file()
