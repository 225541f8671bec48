"""States side by side sum over the flywheels in loops of their own, which keep their sums in vector registers."""

from __future__ import annotations

from functools import cache

import mahovik
from mahovik.core.emit.generate import generate_all
from mahovik.core.lower.batch import batches
from mahovik.core.lower.flywheels import APART
from mahovik.core.program.function import Program
from mahovik.core.program.statement import Set
from mahovik.core.program.walk import statements


@cache
def program() -> Program:
    """The program of demo3."""
    return generate_all(mahovik.example("demo3")).program


def written(functions: tuple[str, ...]) -> list[tuple[str, int]]:
    """Elements of the sums that functions write, each as often as it is written."""
    every = {f.name: f for f in (*program().functions, *program().spare)}
    places = [s.place for name in functions for s in statements(every[name].body) if isinstance(s, Set)]
    return sorted((str(place.path[0]), int(place.path[1].value)) for place in places)  # type: ignore[union-attr]


def test_they_write_what_the_calls_write_for_which_they_stand() -> None:
    for pair, apart in APART.items():
        assert written(pair) == written(apart)
        assert len(written(pair)) == 2 * 27, "each is set to its start, then added to"


def test_no_batch_has_the_calls_for_one_state_one_after_another() -> None:
    names = {f.name for f in batches(program()).program.functions}
    assert {"sum_inertia_wide", "sum_turning_wide", "sum_steady_turning_wide"} <= names
    assert not {"sum_spin_wide", "sum_steady_spin_wide"} & names
    assert "sum_mass_wide" in names, "matrices need no other sum"


def test_c_for_one_state_has_none_of_them() -> None:
    assert not {f.name for f in program().functions} & {name for apart in APART.values() for name in apart}
