"""Cases of a test that are tried in every run, and those that only the slow tests try."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest


def quick(count: int, cases: Iterable[Any]) -> list[Any]:
    """Cases of a parametrized test, or parameters of a fixture: all after the first `count` are marked slow."""
    return [case if n < count else _slow(case) for n, case in enumerate(cases)]


def _slow(case: Any) -> Any:
    if isinstance(case, type(pytest.param())):  # keeps its name and its own marks
        return pytest.param(*case.values, marks=[*case.marks, pytest.mark.slow], id=case.id)
    values = case if isinstance(case, tuple) else (case,)
    return pytest.param(*values, marks=pytest.mark.slow)
