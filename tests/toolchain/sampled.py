"""A share of the cases of every slow test, chosen by a seed: `make test-slow` runs it, `make test-all` runs all cases.

A slow test without parameters always runs, and of one with parameters at least one case. Tests of one file that
have equal cases get the same ones, so that what they share, such as a compiled library, is made once.
"""

from __future__ import annotations

import hashlib
import os
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import pytest

SHARE = "MAHOVIK_SAMPLE_SHARE"
"""Variable of the environment: one case in this many is run, all where it is not set."""

SEED = "MAHOVIK_SAMPLE_SEED"
"""Variable of the environment: another text chooses other cases."""

DEFAULT_SEED = "18"


@dataclass(frozen=True)
class Case:
    """A test with one set of its parameters."""

    file: str
    test: str
    parameters: str
    """Text in brackets in the name of the test; empty for a test without parameters."""


def choose(cases: Sequence[Case], seed: str, share: int) -> set[Case]:
    """Return the cases that a run takes: of each test a share, rounded up, first by a hash with the seed."""
    tests: dict[tuple[str, str], list[Case]] = defaultdict(list)
    for case in cases:
        tests[case.file, case.test].append(case)
    chosen: set[Case] = set()
    for found in tests.values():
        found.sort(key=lambda case: hashlib.sha256(f"{seed} {case.file} {case.parameters}".encode()).digest())
        chosen.update(found[: -(-len(found) // share)])
    return chosen


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out the slow cases that this run does not take."""
    every = int(os.environ.get(SHARE) or 1)
    slow = {_case(item): item for item in items if item.get_closest_marker("slow")}
    chosen = choose(list(slow), os.environ.get(SEED, DEFAULT_SEED), every)
    left = {id(item) for case, item in slow.items() if case not in chosen}
    config.hook.pytest_deselected(items=[item for item in items if id(item) in left])
    items[:] = [item for item in items if id(item) not in left]


def _case(item: pytest.Item) -> Case:
    file, _, test = item.nodeid.partition("::")
    name, _, parameters = test.partition("[")
    return Case(file, name, parameters)
