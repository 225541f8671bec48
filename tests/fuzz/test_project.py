"""The text of the fuzz harness: every public function is in it, and what a function keeps may be no number."""

from __future__ import annotations

import re

from cli.run import DEMO3
from export.held_servos import pendulum
from mahovik.core.stand import load
from mahovik.core.toolchain.fuzzing import fuzz_project


def test_every_public_function_is_fuzzed() -> None:
    """The recorder's functions are included, and a new function is included without further work."""
    texts = fuzz_project(load(DEMO3), "double")
    header = texts["demo3.h"] + texts["verification/demo3_recorder.h"]
    declared = re.findall(r"^demo3_status (demo3_\w+)\(", header, re.MULTILINE)
    assert len(declared) > 20
    assert [name for name in declared if f"{name}(" not in texts["demo3_fuzz.c"]] == []


def test_numbers_that_a_function_keeps_may_be_nan_and_others_not() -> None:
    """`state_from_coordinates` keeps phases and speeds: those of the state that was drawn, after the table."""
    text = fuzz_project(pendulum(), "double")["hinge_fuzz.c"]
    body = text.partition("static void fuzz_state_from_coordinates")[2].partition("\n}\n")[0]
    lines = [line.strip() for line in body.splitlines()]
    at = lines.index("const int kept = unreal;  /* what stays as it was given may be NaN */")
    assert lines[at - 1] == "draw_argument_x(from);"
    assert next(line for line in lines if line.startswith("draw_")) == "draw_argument_tables(from);"
    assert not any("draw_argument_x" in line for line in lines[at:])
