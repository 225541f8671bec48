"""The contract: rows of public functions are what programs have; ranges and statuses are those promised."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest

from mahovik.contract.functions import FUNCTIONS, PublicFunction
from mahovik.contract.quantities import QUANTITIES, SINGULAR_BELOW, UNIT_LENGTH
from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.core.lower.program import lower
from mahovik.core.program.function import Function
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Hold
from mahovik.core.stand.stand_file import load
from mahovik.proof.verify.backends import with_all_inputs
from mahovik.stands import path


def public_functions() -> Iterator[Function]:
    """Public functions of example stands, free and held, with phases and with their sines and cosines as input."""
    for name in ("demo3", "sat4"):
        for phase_input in ("angle", "sincos"):
            stand = replace(with_all_inputs(load(path(name))), phase_input=phase_input, tasks=())
            held = replace(stand, hold=Hold((FREEDOMS["yaw"],), (0.0,) * 3, (0.0,) * 3, (0.0,) * 3))
            for part in (stand, held):
                yield from (f for f in lower(part, DOUBLE).functions if f.public)
    ball = Hold(tuple(FREEDOMS[way] for way in ("roll", "pitch", "yaw")), (0.0,) * 3, (0.0,) * 3, (0.0,) * 3)
    yield from (f for f in lower(replace(load(path("demo3")), hold=ball), DOUBLE).functions if f.public)


@pytest.fixture(scope="module")
def programs() -> list[Function]:
    return list(public_functions())


def test_every_public_function_has_a_row_and_every_row_a_function(programs: list[Function]) -> None:
    assert {f.name for f in programs} == set(FUNCTIONS)


def test_rows_have_arguments_and_equations_of_the_programs(programs: list[Function]) -> None:
    seen: dict[str, set[str]] = {}
    for f in programs:
        row = FUNCTIONS[f.name]
        taken = [a.name for a in f.arguments if a.direction != "out"]
        assert [name for name in row.takes if name in taken] == taken, f.name
        assert row.equation, f.name
        assert f.equation == (row.equation if row.equation.startswith("(") else ""), f.name
        seen.setdefault(row.name, set()).update(taken)
    assert {name: taken for name, taken in seen.items() if taken != set(FUNCTIONS[name].takes)} == {}


def test_a_want_without_a_referee_is_refused() -> None:
    with pytest.raises(ValueError, match="a want needs a judge"):
        PublicFunction("momentum_rate", "", ("x",), ("Z_dot",), ("exact",), want=True)
    with pytest.raises(ValueError, match="expected judges among"):
        PublicFunction("momentum_rate", "", ("x",), ("Z_dot",), ())


PROMISED = {
    "position": (1e6,),
    "angles": (1e7,),
    "V": (1e4, 1e4, 1e4, 1e5, 1e5, 1e5),
    "phi": (1e7,),
    "phi_dot": (1e5,),
    "phi_ddot": (1e9,),
    "V_dot": (1e9,),
    "tau": (1e9,),
    "wrench": (1e9,),
}
"""Largest magnitudes in double, SI."""

PROMISED_IN_FLOAT = PROMISED | {"angles": (1e3,), "phi": (1e3,)}


@pytest.mark.parametrize(("real", "promised"), [("double", PROMISED), ("float", PROMISED_IN_FLOAT)])
def test_ranges_are_those_promised(real: str, promised: dict[str, tuple[float, ...]]) -> None:
    assert {row.symbol: row.limits(real) for row in QUANTITIES.values() if row.input} == promised


def test_lengths_and_angles_are_those_promised() -> None:
    assert (UNIT_LENGTH, SINGULAR_BELOW) == (1e-3, 1e-6)


def test_statuses_are_those_promised() -> None:
    assert STATUS_VALUES == {
        "OK": 0,
        "NEAR_SINGULAR": 1,
        "DAMPED": 2,
        "LIMITED": 4,
        "UNREACHABLE": 8,
        "RANK_DEFICIENT": 16,
        "COARSE": 32,
        "EXCESSIVE": 64,
        "NOT_FINITE": -1,
        "RANGE": -2,
        "NOT_POSITIVE_DEFINITE": -3,
        "SINGULAR_ATTITUDE": -4,
        "BAD_ARGUMENT": -5,
    }
    assert status_words(0) == "OK"
    assert status_words(-2) == "RANGE"
    assert status_words(21) == "NEAR_SINGULAR|LIMITED|RANK_DEFICIENT"
