"""The fuzz harness of held carriers: what their functions keep, and a run in which nothing is found."""

from __future__ import annotations

from pathlib import Path

import pytest

from cli.run import run
from export.held_servos import pendulum
from mahovik.core.toolchain.fuzz_project import fuzz_project
from mahovik.core.toolchain.fuzzing import compile_harness, fuzz
from toolchain.tools import require

STAND = Path(__file__).resolve().parents[2] / "docs" / "held" / "pendulum.toml"


def test_numbers_that_a_function_keeps_may_be_nan_and_others_not() -> None:
    """`state_from_coordinates` keeps phases and speeds: those of the state that was drawn, after the table."""
    text = fuzz_project(pendulum(), "double")["hinge_fuzz.c"]
    body = text.partition("static void fuzz_state_from_coordinates")[2].partition("\n}\n")[0]
    lines = [line.strip() for line in body.splitlines()]
    at = lines.index("const int kept = unreal;  /* what stays as it was given may be NaN */")
    assert lines[at - 1] == "draw_argument_x(from);"
    assert next(line for line in lines if line.startswith("draw_")) == "draw_argument_tables(from);"
    assert not any("draw_argument_x" in line for line in lines[at:])


@pytest.mark.fuzz
def test_nothing_is_found_in_the_c_of_a_pendulum(tmp_path: Path) -> None:
    require("clang", "clang libclang-rt-14-dev")
    folder = tmp_path / "project"
    assert run("export", "fuzz", str(STAND), "-o", str(folder)).exit_code == 0
    program = compile_harness(folder, ("-O0", *(f"pendulum{part}.c" for part in ("", "_fuzz", "_recorder"))))
    assert fuzz(program, tmp_path / "corpus", runs=20_000).executions >= 20_000
