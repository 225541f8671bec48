"""A result of the generator is given again for equal arguments, and its files are the caller's own."""

from __future__ import annotations

from types import SimpleNamespace

from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import load
from mahovik.stands import path
from toolchain.generated_once import once


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


def test_files_are_the_caller_s_own() -> None:
    demo3 = load(path("demo3"))
    right = generate_all(demo3).files["demo3.c"]
    generate_all(demo3).files["demo3.c"] = "tampered with"
    assert generate_all(demo3).files["demo3.c"] == right
