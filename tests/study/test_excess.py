"""Stands on which (12) is singular in practice, and those on which it is not."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.stands import names, path
from mahovik.use.study.excess import excess


def example(name: str) -> Stand:
    return load(path(name))


@pytest.mark.parametrize("name", sorted(names()))
def test_of_the_examples_it_is_the_satellites_but_for_their_tasks(name: str) -> None:
    """A task names the rows that are asked, so that (12) as a whole is not."""
    stand = example(name)
    assert excess(stand) is None
    assert (excess(replace(stand, tasks=())) is not None) == (name in ("eye4", "sat4"))


def test_the_words_name_flywheel_and_task() -> None:
    found = excess(replace(example("sat4"), tasks=()))
    assert found is not None and found.share > 100
    assert "[task.pointing]" in str(found) and found.flywheel in str(found)


def test_without_motors_a_stated_acceleration_decides() -> None:
    sat = example("sat4")
    bare = replace(sat, flywheels=tuple(replace(s, motor=None) for s in sat.flywheels), tasks=())
    found = excess(bare)
    assert found is not None and found.share == pytest.approx(found.phi_ddot / bare.inverse_most)
    assert excess(replace(bare, inverse_most=1e9)) is None
    assert excess(replace(bare, flywheels=())) is None
