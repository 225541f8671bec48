"""The rows of public functions are what the programs of stands have."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest

from mahovik.contract.functions import FUNCTIONS, PublicFunction, row_of, task_of
from mahovik.core.lower.program import lower
from mahovik.core.program.function import Function
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Hold, Task, TaskRow
from mahovik.core.stand.read import load
from mahovik.proof.verify.program_backend import with_all_inputs
from mahovik.stands import path


def public_functions() -> Iterator[Function]:
    """Public functions of example stands, free and held, with phases and with their sines and cosines as input."""
    for name in ("demo3", "sat4"):
        for phase_input in ("angle", "sincos"):
            stand = replace(with_all_inputs(load(path(name))), phase_input=phase_input, tasks=())
            held = replace(stand, hold=Hold((FREEDOMS["yaw"],), (0.0,) * 3, (0.0,) * 3, (0.0,) * 3))
            for each in (stand, held):
                yield from (f for f in lower(each, DOUBLE).functions if f.public)
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
        assert f.equation == (row.equation if row.equation.startswith("(") else ""), f.name
        seen.setdefault(row.name, set()).update(taken)
    assert {name: taken for name, taken in seen.items() if taken != set(FUNCTIONS[name].takes)} == {}


def test_functions_of_tasks_have_the_rows_of_their_forms() -> None:
    """No name of a task makes the name of another function: a task named `at_fast` is one, too."""
    rows = tuple(Task(name, (TaskRow("", "wz"),)) for name in ("pointing", "at_fast", "inverse"))
    stand = replace(load(path("sat4")), tasks=rows, phase_input="sincos")
    found = {f.name: f for f in lower(stand, DOUBLE).functions if f.public and f.name not in FUNCTIONS}
    forms = ("inverse_{}", "inverse_fast_{}", "inverse_fast_{}_at", "torque_for_{}")
    assert set(found) == {form.format(task.name) for form in forms for task in rows}
    for name, f in found.items():
        taken = [a.name for a in f.arguments if a.direction != "out"]
        assert [each for each in row_of(name).takes if each in taken] == taken
        assert "demand" in taken and "V_dot" not in taken
        assert task_of(name) in name and not row_of(name).want
    assert [task_of(name) for name in FUNCTIONS] == [""] * len(FUNCTIONS)
    with pytest.raises(KeyError):
        row_of("reverse_pointing")


def test_a_want_without_a_referee_is_refused() -> None:
    with pytest.raises(ValueError, match="a want needs a judge"):
        PublicFunction("momentum_rate", "", ("x",), ("Z_dot",), ("exact",), want=True)
    with pytest.raises(ValueError, match="expected judges among"):
        PublicFunction("momentum_rate", "", ("x",), ("Z_dot",), ())
