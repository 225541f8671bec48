"""Threads, processes and the store of compiled stands."""

from __future__ import annotations

import hashlib
import json
import os
import pickle
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import mahovik
from api.models import model, stand
from mahovik.core.stand.structure import structure
from mahovik.core.toolchain import compiled, compiler, store

if TYPE_CHECKING:
    from mahovik.core.emit.arrays import LibraryKind


def test_threads_of_python_do_not_disturb_one_another() -> None:
    m = model("bench8")
    rng = np.random.default_rng(1)
    batches = [m.states(V=rng.normal(size=(2000, 6)), phi_dot=rng.normal(size=(2000, 8))) for _ in range(8)]
    expected = [m.forward(x).V_dot for x in batches]
    with ThreadPoolExecutor(8) as pool:
        for _ in range(5):
            for V_dot, right in zip(pool.map(lambda x: m.forward(x).V_dot, batches), expected, strict=True):
                assert np.array_equal(V_dot, right)


def test_a_pickled_model_is_the_same_model() -> None:
    again = pickle.loads(pickle.dumps(model("bench8")))
    x = again.states(4, V=np.eye(6)[:4])
    assert np.array_equal(again.forward(x).V_dot, model("bench8").forward(x).V_dot)


@pytest.mark.slow
def test_threads_of_openmp_give_the_same_bits() -> None:
    one, many = mahovik.build(stand("demo3")), mahovik.build(stand("demo3"), threads=2)
    x = one.states(phi=np.random.default_rng(1).normal(size=(999, 3)), phi_dot=50.0)
    for function in ("forward", "coupled", "matrices", "momentum"):
        for key, value in getattr(one, function)(x).items():
            assert np.array_equal(value, getattr(many, function)(x)[key])


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of stands compiled from now on; what comes out lay in the store before."""
    model("bench8")
    bench8 = structure(stand("bench8")), "double", tuple(compiler.find_compiler()), False
    key = store.library_key(*bench8)
    entry = store.find(key)
    assert entry is not None
    library, facts = entry[0].read_bytes(), entry[1]
    compiled_names: list[str] = []

    def copied(source: compiled.Source, kind: LibraryKind, scratch: Path) -> tuple[Path, dict[str, Any]]:
        compiled_names.append(source.stand.name)
        (scratch / "copy.so").write_bytes(library)
        return scratch / "copy.so", facts

    monkeypatch.setattr(compiled, "_compile", copied)
    return compiled_names


def works(m: mahovik.Model) -> bool:
    """Whether the model gives what the model of bench8 gives."""
    x = m.states(3, V=np.eye(6)[:3])
    return np.array_equal(m.forward(x).V_dot, model("bench8").forward(x).V_dot)


def test_the_second_build_compiles_nothing(made: list[str]) -> None:
    assert works(mahovik.build(stand("bench8"))) and made == []


def store_entry_is_whole(library: Path) -> bool:
    """Whether the bytes are those whose hash lies beside them."""
    facts = json.loads(library.with_suffix(".json").read_text(encoding="ascii"))
    return bool(facts["digest"] == hashlib.sha256(library.read_bytes()).hexdigest())


AT_ONCE = """
import mahovik, numpy as np
m = mahovik.build(mahovik.example("demo3"))
tables = m.tables({"carrier.mass": np.array([4.0, 5.0])})
print(m.forward(m.state(phi_dot=9.0), 1.0, tables=tables).V_dot.tobytes().hex())
"""


@pytest.mark.slow
def test_processes_that_compile_at_once_and_one_that_is_killed_leave_whole_libraries(tmp_path: Path) -> None:
    (tmp_path / "scratch").mkdir()
    env = {**os.environ, "MAHOVIK_CACHE": str(tmp_path), "TMPDIR": str(tmp_path / "scratch")}
    started = [subprocess.Popen([sys.executable, "-c", AT_ONCE], env=env, stdout=subprocess.PIPE) for _ in range(3)]
    time.sleep(2.0)
    started[0].kill()
    printed = [process.communicate(timeout=50)[0] for process in started]
    assert printed[1] == printed[2] != b""
    libraries = sorted((tmp_path / "models").glob("*.so"))
    assert len(libraries) == 2 and all(store_entry_is_whole(library) for library in libraries)
    again = subprocess.run([sys.executable, "-c", AT_ONCE], env=env, capture_output=True, check=True)
    assert again.stdout == printed[1]


@pytest.mark.parametrize("damage", ["truncated", "no facts", "other facts"])
def test_what_is_damaged_is_made_anew(
    damage: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, made: list[str]
) -> None:
    monkeypatch.setenv("MAHOVIK_CACHE", str(tmp_path))
    mahovik.build(stand("bench8"))
    (library,), (facts,) = (tmp_path / "models").glob("*.so"), (tmp_path / "models").glob("*.json")
    if damage == "truncated":
        library.unlink()  # another file: this process has that one loaded
        library.write_bytes(b"\x7fELF" + bytes(5000))
    else:
        facts.write_text({"no facts": "", "other facts": "{}"}[damage], encoding="utf-8")
    assert works(mahovik.build(stand("bench8"))) and made == ["bench8"] * 2


@pytest.mark.parametrize("cache", ["", "file/in/the/way"])
def test_without_a_cache_it_works_and_leaves_nothing(
    cache: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, made: list[str]
) -> None:
    (tmp_path / "file").write_text("", encoding="ascii")
    monkeypatch.setenv("MAHOVIK_CACHE", cache and str(tmp_path / cache))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert works(mahovik.build(stand("bench8"))) and made == ["bench8"]
    assert os.listdir(tmp_path) == ["file"]


@pytest.mark.parametrize("changed", ["contract/laws.py", "core/formula/derived.json", "laws/leg/program.py"])
def test_another_generator_has_other_entries(changed: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def key() -> str:
        store._generator.cache_clear()
        return store.numbers_key(stand("demo3"), "double")

    installed = key()
    for part in ("contract", "core", "laws"):
        shutil.copytree(store._PACKAGE / part, tmp_path / part, ignore=shutil.ignore_patterns("*.pyc"))
    with monkeypatch.context() as patch:
        patch.setattr(store, "_PACKAGE", tmp_path)
        assert key() == installed
        with (tmp_path / changed).open("a") as file:
            file.write("\n")
        assert key() != installed
    assert key() == installed


@pytest.mark.parametrize(
    ("env", "expected"),
    [
        ({"MAHOVIK_CACHE": "here", "XDG_CACHE_HOME": "/x", "HOME": "/h"}, "here/models"),
        ({"MAHOVIK_CACHE": "", "HOME": "/h"}, None),
        ({"XDG_CACHE_HOME": "/x", "HOME": "/h"}, "/x/mahovik/models"),
        ({"XDG_CACHE_HOME": "x", "HOME": "/h"}, "/h/.cache/mahovik/models"),
        ({"HOME": "/h"}, "/h/.cache/mahovik/models"),
    ],
    ids=str,
)
def test_where_the_store_is(env: dict[str, str], expected: str | None, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("MAHOVIK_CACHE", "XDG_CACHE_HOME", "HOME"):
        monkeypatch.delenv(name, raising=False)
    for name, value in env.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(sys, "platform", "linux")
    assert store.folder() == (None if expected is None else Path(expected))
