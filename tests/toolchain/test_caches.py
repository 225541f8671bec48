"""What tests share is taken only where making it again would give the same: libraries of C, and generated C."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace

import pytest

from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import load
from mahovik.core.toolchain import library
from mahovik.stands import path
from toolchain.generated_once import once

FLAGS = ("-ffp-contract=off", "-O2")


def test_whatever_the_compiler_sees_is_in_the_key(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MAHOVIK_CACHE", str(tmp_path / "cache"))
    made: list[str] = []

    def compile_nothing(command: Sequence[str], what: str) -> None:
        made.append(what)
        Path(command[-1]).write_text(str(len(made)), encoding="ascii")

    monkeypatch.setattr(library, "run_compiler", compile_nothing)

    def built(source: str = "int x;\n", header: str = "", flags: Sequence[str] = FLAGS) -> str:
        (tmp_path / "x.h").write_text(header, encoding="ascii")
        (tmp_path / "x.c").write_text(source, encoding="ascii")
        return library.load_compiled(tmp_path / "x.c", flags, lambda file: Path(file).read_text(encoding="ascii"))

    libraries = [built(), built("int y;\n"), built(header="int z;\n"), built(flags=("-O0",))]
    monkeypatch.setenv("CC", "gcc -g0")
    libraries += [built()]
    assert len(set(libraries)) == len(made) == 5
    assert built() == libraries[4]


def test_equal_arguments_are_made_once() -> None:
    calls: list[tuple[int, str]] = []

    def make(number: int, *, name: str = "") -> SimpleNamespace:
        calls.append((number, name))
        return SimpleNamespace(number=number)

    made = once(make)
    assert made(1).number == made(1).number == 1
    assert (made(2).number, made(1, name="x").number) == (2, 1)
    assert calls == [(1, ""), (2, ""), (1, "x")]


def test_generated_files_are_the_caller_s_own() -> None:
    demo3 = load(path("demo3"))
    right = generate_all(demo3).files["demo3.c"]
    generate_all(demo3).files["demo3.c"] = "tampered with"
    assert generate_all(demo3).files["demo3.c"] == right
