"""The sample of slow cases: at least one of each test, the same for the same seed, and sooner or later every one."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from docs.pages import ROOT
from toolchain.sampled import SHARE, Case, choose
from toolchain.test_makefile import recipe

CASES = [Case("a.py", test, f"{n}") for test in ("one", "two") for n in range(13)] + [Case("a.py", "alone", "")]


def test_a_share_of_each_test_runs() -> None:
    chosen = choose(CASES, "seed", 4)
    for test in ("one", "two"):
        assert len([case for case in chosen if case.test == test]) == 4
    assert Case("a.py", "alone", "") in chosen
    assert choose(CASES, "seed", 4) == choose(CASES[::-1], "seed", 4) == chosen


def test_tests_of_a_file_have_the_same_cases() -> None:
    chosen = choose(CASES, "seed", 4)
    one, two = ({case.parameters for case in chosen if case.test == test} for test in ("one", "two"))
    assert one == two


def test_one_in_one_is_all() -> None:
    assert choose(CASES, "seed", 1) == set(CASES)


def test_every_case_comes_with_some_commit() -> None:
    found = [choose(CASES, str(seed), 4) for seed in range(40)]
    assert set().union(*found) == set(CASES)
    assert len({frozenset(chosen) for chosen in found}) > 35


HOOK = "from toolchain.sampled import pytest_collection_modifyitems\n"
TESTS = """
import pytest

@pytest.mark.slow
@pytest.mark.parametrize("n", range(8))
def test_slow(n): pass

@pytest.mark.slow
def test_alone(): pass

@pytest.mark.parametrize("n", range(8))
def test_quick(n): pass
"""


@pytest.mark.parametrize(("share", "count"), [("4", 2 + 1 + 8), ("", 8 + 1 + 8)])
def test_quick_tests_and_tests_without_parameters_all_run(share: str, count: int, tmp_path: Path) -> None:
    (tmp_path / "conftest.py").write_text(HOOK, encoding="ascii")
    (tmp_path / "test_few.py").write_text(TESTS, encoding="ascii")
    (tmp_path / "pytest.ini").write_text("[pytest]\nmarkers = slow\n", encoding="ascii")
    command = [sys.executable, "-m", "pytest", "-q", "--collect-only", "-p", "no:cacheprovider", str(tmp_path)]
    env = {**os.environ, "PYTEST_ADDOPTS": "", "PYTHONPATH": str(ROOT / "tests"), SHARE: share}
    shown = subprocess.run(command, cwd=tmp_path, env=env, capture_output=True, text=True, check=True).stdout
    assert shown.count("::test_") == count, shown


def test_make_test_slow_runs_a_share_and_make_test_all_runs_all() -> None:
    slow, everything = recipe("test-slow"), recipe("test-all")
    assert f"{SHARE}=5" in slow and "-m slow" in slow
    assert SHARE not in everything and "-m 'not fuzz'" in everything
