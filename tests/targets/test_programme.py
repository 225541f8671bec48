"""A programme has the interpreter's bits on the emulated targets: its own self-test says so."""

from __future__ import annotations

from pathlib import Path

import pytest

from export.programmes import exported, stand_files
from mahovik.core.toolchain.board import build, run
from targets.boards import EMBEDDED, target

MAIN = """#include "board.h"
int shaker2_programme_test(void (*print)(const char *text));
int main(void) { return shaker2_programme_test(board_print) != 0; }
"""
PASSED = ["programme_at PASS cases 8 wrong 0", "refusals PASS wrong 0", "clock PASS wrong 0", "failures 0"]


def printed(name: str, real: str, programme: str, kind: str, folder: Path) -> list[str]:
    """Output of the self-test on a target."""
    made = target(name)
    sources = {n: t for n, t in exported(programme, kind, real).files.items() if n.endswith((".c", ".h"))}
    sources |= {"shaker2.h": stand_files(real)["shaker2.h"], "main.c": MAIN}
    elf = build(made, sources, folder)
    return run(made, elf).splitlines()


@pytest.mark.slow
def test_a_float_processor(tmp_path: Path) -> None:
    """The Cortex-M4 alone, in its element type, with a run-up."""
    lines = printed("m4", "float", "started", "quintic", tmp_path)
    assert [line for line in lines if line in PASSED] == PASSED
    assert "programme_runup_at PASS cases 8 wrong 0" in lines


@pytest.mark.slow
@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize("kind", ["quintic", "fourier"])
@pytest.mark.parametrize("name", EMBEDDED)
def test_every_target(name: str, kind: str, real: str, tmp_path: Path) -> None:
    lines = printed(name, real, "swaying", kind, tmp_path)
    assert [line for line in lines if line in PASSED] == PASSED
