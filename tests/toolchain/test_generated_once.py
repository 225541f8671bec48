"""A result of the generator is given again only while the generator is as it was."""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType, SimpleNamespace

import pytest

from conftest import GENERATOR
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import load
from mahovik.stands import path
from toolchain.generated_once import Trust, Unchanged, once

DEMO3 = load(path("demo3"))


@pytest.fixture
def module(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """A module with a name, a table and a class, and one that nobody has seen beside it."""
    found = ModuleType("some.module")
    exec("number, table = 1.5, {'key': 2.5}\nclass Law:\n    size = 3.5\n", vars(found))
    monkeypatch.setitem(sys.modules, "some.module", found)
    return found


def test_each_kind_of_change_is_noticed_and_forgotten_when_taken_back(module: ModuleType) -> None:
    unchanged = Unchanged(("some.",))
    assert not unchanged.holds(("some.",))  # never seen
    unchanged.look()
    assert unchanged.holds(("some.",))
    for change in ("number", "Law.size"):
        with pytest.MonkeyPatch.context() as patch:
            place = module.Law if "." in change else module
            patch.setattr(place, change.rpartition(".")[2], object())
            assert not unchanged.holds(("some.",)), change
        assert unchanged.holds(("some.",)), change
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(module.table, "key", object())
        assert not unchanged.holds(("some.",))


def test_equal_arguments_are_made_once_where_that_may_be() -> None:
    calls: list[tuple[int, str]] = []
    may = [True]

    def make(number: int, *, name: str = "") -> SimpleNamespace:
        calls.append((number, name))
        return SimpleNamespace(number=number)

    made = once(make, lambda: may[0])
    assert made(1).number == made(1).number == 1
    assert (made(2).number, made(1, name="x").number) == (2, 1)
    assert calls == [(1, ""), (2, ""), (1, "x")]
    may[0] = False
    made(1)
    assert calls[3:] == [(1, "")]


def test_what_is_called_on_the_way_does_not_look_again() -> None:
    looks: list[str] = []

    def look(name: str) -> bool:
        looks.append(name)
        return True

    def fail(number: int) -> int:
        raise ValueError(number)

    trust = Trust()
    inner = once(lambda number: number + 1, lambda: look("inner"), trust)
    outer = once(lambda number: 2 * inner(number), lambda: look("outer"), trust)
    assert outer(1) == 4
    with pytest.raises(ValueError, match="1"):
        once(fail, lambda: look("fail"), trust)(1)
    assert inner(5) == 6
    assert looks == ["outer", "fail", "inner"]  # nothing is trusted after the end, also where it is an error


def test_the_generator_is_unchanged_by_its_use() -> None:
    """Else everything would be generated again, and nobody would notice."""
    generate_all(DEMO3)
    GENERATOR.look()
    generate_all(DEMO3)
    assert GENERATOR.holds()


def test_files_are_the_caller_s_own_and_a_fault_is_no_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    GENERATOR.look()
    right = generate_all(DEMO3).files["demo3.c"]
    generate_all(DEMO3).files["demo3.c"] = "tampered with"
    assert generate_all(DEMO3).files["demo3.c"] == right
    module = import_module("mahovik.core.emit.generate")  # the package has a function of that name
    monkeypatch.setattr(module, "identities", lambda _: SimpleNamespace(structure="x", physics="y"))
    assert generate_all(DEMO3).files["demo3.c"] != right
