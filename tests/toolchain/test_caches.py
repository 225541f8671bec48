"""What tests share is taken only where making it again would give the same: libraries of C, and generated C."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

from conftest import GENERATOR
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import load
from mahovik.stands import path
from toolchain.build_cache import caching
from toolchain.generated_once import Unchanged

FLAGS = ("-ffp-contract=off", "-O2")


def test_whatever_the_compiler_sees_is_in_the_key(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[Path] = []

    def build(source: Path, library: Path, how: Sequence[str]) -> None:
        calls.append(source)
        library.write_text(str(len(calls)), encoding="ascii")

    (tmp_path / "kept").mkdir()
    cached = caching(build, tmp_path / "kept")

    def built(source: str = "int x;\n", header: str = "", flags: Sequence[str] = FLAGS) -> str:
        (tmp_path / "x.h").write_text(header, encoding="ascii")
        (tmp_path / "x.c").write_text(source, encoding="ascii")
        cached(tmp_path / "x.c", tmp_path / "x.so", flags)
        return (tmp_path / "x.so").read_text(encoding="ascii")

    found = [built(), built("int y;\n"), built(header="int z;\n"), built(flags=("-O0",))]
    native = [built(flags=("-march=native",)) for _ in range(2)]  # for another processor it is another
    monkeypatch.setenv("CC", "gcc -g0")
    found += [built(), *native]
    assert len(set(found)) == len(calls) == 7
    assert built() == found[4]


def test_each_kind_of_change_is_noticed_and_forgotten_when_taken_back(monkeypatch: pytest.MonkeyPatch) -> None:
    module = ModuleType("some.module")
    exec("number, table = 1.5, {'key': 2.5}\nclass Law:\n    size = 3.5\n", vars(module))
    monkeypatch.setitem(sys.modules, "some.module", module)
    unchanged = Unchanged(("some.",))
    assert not unchanged.holds(("some.",))  # never seen
    unchanged.look()
    assert unchanged.holds(("some.",))
    for place, name in ((module, "number"), (module.Law, "size")):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(place, name, object())
            assert not unchanged.holds(("some.",)), name
        assert unchanged.holds(("some.",)), name
    module.table["key"] = object()
    assert not unchanged.holds(("some.",))


def test_use_leaves_the_generator_as_it_was_and_a_fault_is_no_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    demo3 = load(path("demo3"))
    generate_all(demo3)
    GENERATOR.look()
    right = generate_all(demo3).files["demo3.c"]
    generate_all(demo3).files["demo3.c"] = "tampered with"
    assert GENERATOR.holds()
    assert generate_all(demo3).files["demo3.c"] == right
    module = import_module("mahovik.core.emit.generate")  # the package has a function of that name
    monkeypatch.setattr(module, "identities", lambda _: SimpleNamespace(structure="x", physics="y"))
    assert generate_all(demo3).files["demo3.c"] != right
