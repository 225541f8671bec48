"""The Makefile: `make demo` needs the small environment only, whatever runs tests or judges needs the whole one."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from toolchain.tools import require

ROOT = Path(__file__).resolve().parents[2]
WHOLE, SMALL = "-e '.[test]'", "-e '.[report]'"


def recipe(target: str) -> str:
    """What `make` would run for a target in a fresh checkout."""
    require("make", "make")
    command = ["make", "--dry-run", "VENV=build/no-environment", "BENCH=build/no-bench", target]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout


def ci_targets() -> list[str]:
    return re.findall(r"^make ([a-z-]+)$", (ROOT / ".ci" / "run").read_text(encoding="utf-8"), re.MULTILINE)


@pytest.mark.parametrize("target", ["demo", "setup", "generated"])
def test_small_environment(target: str) -> None:
    text = recipe(target)
    assert SMALL in text
    assert WHOLE not in text


@pytest.mark.parametrize("target", sorted({*ci_targets(), "setup-test"} - {"generated"}))
def test_whole_environment(target: str) -> None:
    """After the small one, in the same place: nothing of it is installed twice."""
    text = recipe(target)
    assert 0 <= text.index(SMALL) < text.index(WHOLE)


def test_every_target_is_in_the_help() -> None:
    text = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"^([a-z-]+):", text, re.MULTILINE)) - {"help"}
    assert set(re.findall(r'@echo "make ([a-z-]+)', text)) == targets
