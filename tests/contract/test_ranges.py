"""Ranges and statuses that the evaluation contract promises, written out: the data cannot drift from them unseen."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import Any

import pytest

import mahovik
from mahovik.contract.functions import CONFLICTS, TASK_WANTS, WANTS
from mahovik.contract.quantities import BOUNDS, QUANTITIES, SINGULAR_BELOW, UNIT_LENGTH
from mahovik.contract.status import STATUS_VALUES, status_words

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


def test_two_wants_that_contradict_each_other_are_those_promised() -> None:
    plain = {found for found in CONFLICTS if found[1] not in TASK_WANTS}
    reactions = {(name, "reaction", "reaction") for name in ("forward", "coupled")}
    assert plain == {("forward", "coupled", "V_dot"), ("coupled", "inverse", "phi_ddot"), *reactions}
    of_tasks = {found[:2] for found in CONFLICTS if found[1] in TASK_WANTS}
    assert of_tasks == {(first, "torque_for") for first in ("forward", "torque", "coupled", "inverse")}
    assert len(WANTS) == len(set(WANTS))


LIMITED = (
    "core/lower/layout.py", "core/lower/servo/form.py", "core/stand/physical.py", "core/stand/schema.py",
    "use/control/servo.py", "use/simulate/case.py",
)  # fmt: skip
"""Modules that refuse, wrap or describe values by bounds of the contract."""


@pytest.mark.parametrize("module", LIMITED)
def test_bounds_are_written_in_the_contract_only(module: str) -> None:
    """No number of a bound stands in these modules, nor in their texts of the C."""
    values = {bound.value for bound in BOUNDS.values() if bound.value >= 1e4}
    values.add(1 / BOUNDS["MAX_WEIGHT"].value)
    tree = ast.parse((Path(mahovik.__file__).parent / module).read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant):
            words: list[Any] = node.value.replace(":", " ").split() if isinstance(node.value, str) else [node.value]
            found = {float(word) for word in words if isinstance(word, float) or str(word).startswith(("1e", "1E"))}
            assert not found & values, (module, node.lineno, node.value)
