"""The cache of formulas: the same bytes with and without it, and no state of the disk that a user would notice."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from mahovik import stands
from mahovik.core.formula import cache
from mahovik.core.formula.derived import carrier, leave_cache, use_cache
from mahovik.core.formula.tree import Matrix
from mahovik.core.stand import load
from mahovik.out.api import store

CODE = """
import atexit, sys
from mahovik.out.cli import main
atexit.register(lambda: print('sympy' in sys.modules))
main()
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache."""
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path / "cache"))
    return tmp_path / "cache"


def remembered(warnings: list[str]) -> Matrix:
    """A formula as a command gets it."""
    use_cache(warnings.append)
    try:
        found = carrier.momentum(True)
    finally:
        leave_cache()
    assert isinstance(found, Matrix)
    return found


def test_what_was_derived_is_not_derived_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    warnings: list[str] = []
    first = remembered(warnings)
    monkeypatch.setattr("mahovik.core.formula.derived._derive", lambda *_: pytest.fail("derived again"))
    assert remembered(warnings) == first == remembered(warnings)
    assert warnings == []
    assert len(list(folder.iterdir())) == 1


def changed(file: Path, **members: object) -> str:
    """The text of a cache with other members."""
    return json.dumps(json.loads(file.read_text()) | members)


DAMAGE: dict[str, Callable[[Path], str]] = {
    "truncated": lambda file: file.read_text()[:-20],
    "empty": lambda file: "",
    "a list": lambda file: "[1, 2]",
    "too deep": lambda file: "[" * 100_000 + "]" * 100_000,
    "another formula": lambda file: file.read_text().replace('"mu[0]"', '"mu[1]"', 1),
    "another source": lambda file: changed(file, source="0" * 64),
    "no entries": lambda file: changed(file, entries=None),
    "code": lambda file: changed(file, entries={"x": "__import__('os')"}),
}


@pytest.mark.parametrize("damage", DAMAGE)
def test_a_damaged_cache_is_made_anew_with_one_warning(folder: Path, damage: str) -> None:
    expected = remembered([])
    (file,) = folder.iterdir()
    whole = file.read_bytes()
    file.write_text(DAMAGE[damage](file))
    warnings: list[str] = []
    assert remembered(warnings) == expected
    assert len(warnings) == 1
    assert "\n" not in warnings[0]
    assert str(file) in warnings[0]
    assert file.read_bytes() == whole
    assert remembered(warnings) == expected
    assert len(warnings) == 1


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A copy of the generator's sources, which the caches take for the installed one."""
    copied = tmp_path / "package"
    for part in ("contract", "core", "laws"):
        shutil.copytree(cache._PACKAGE / part, copied / part, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(cache, "_PACKAGE", copied)
    yield copied
    forget_sources()


def forget_sources() -> None:
    cache.source_hash.cache_clear()
    store._generator.cache_clear()


PLACES = ("contract", "core/derive", "laws/leg")


@pytest.mark.parametrize("changed", [*PLACES, "sympy", "python"])
def test_another_generator_has_other_files(
    changed: str, folder: Path, package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Formulas and compiled stands alike: a mended module of the model reaches those who compiled with the old one."""

    def keys() -> tuple[object, object]:
        forget_sources()
        return cache.file(), store.numbers_key(load(stands.path("demo3")), "double")

    forget_sources()
    installed = keys()
    assert keys() == installed
    if changed == "sympy":
        (tmp_path / "release.py").write_text('__version__ = "0.1"')
        monkeypatch.setattr(cache, "find_spec", lambda _: SimpleNamespace(origin=str(tmp_path / "__init__.py")))
    elif changed == "python":
        monkeypatch.setattr(sys, "version_info", (3, 99, 0))
    else:
        with sorted((package / changed).glob("*.py"))[-1].open("a") as module:
            module.write("# another line\n")
    assert all(now != before for now, before in zip(keys(), installed, strict=True))


def test_files_of_few_sources_stay(folder: Path) -> None:
    folder.mkdir()
    for number in range(cache.KEPT + 3):
        path = folder / f"formulas-{number:016x}.json"
        path.touch()
        os.utime(path, (number, number))
    remembered([])
    assert len(list(folder.iterdir())) == cache.KEPT
    kept = cache.file()
    assert kept is not None and kept.is_file()


@pytest.mark.parametrize(
    ("env", "expected"),
    [
        ({"MAHOVIK_CACHE": "here", "XDG_CACHE_HOME": "/x", "HOME": "/h"}, "here"),
        ({"MAHOVIK_CACHE": "", "HOME": "/h"}, None),
        ({"XDG_CACHE_HOME": "/x", "HOME": "/h"}, "/x/mahovik"),
        ({"XDG_CACHE_HOME": "x", "HOME": "/h"}, "/h/.cache/mahovik"),
        ({"HOME": "/h"}, "/h/.cache/mahovik"),
    ],
    ids=str,
)
def test_where_the_cache_is(env: dict[str, str], expected: str | None, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("MAHOVIK_CACHE", "XDG_CACHE_HOME", "HOME"):
        monkeypatch.delenv(name, raising=False)
    for name, value in env.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(sys, "platform", "linux")
    assert cache.folder() == (None if expected is None else Path(expected))


@pytest.mark.slow
def test_the_bytes_do_not_depend_on_it(tmp_path: Path) -> None:
    """Derived without a cache, which is left alone, derived by two at once into an empty one, and read from it."""
    env = {**os.environ, cache.VARIABLE: str(tmp_path / "cache")}
    command = [sys.executable, "-c", CODE, "generate", str(stands.path("demo3")), "-o"]

    def begin(name: str, *flags: str) -> subprocess.Popen[str]:
        pipe = subprocess.PIPE
        return subprocess.Popen([*command, str(tmp_path / name), *flags], env=env, stdout=pipe, stderr=pipe, text=True)

    derived = []
    for together in ([("none", "--no-cache")], [("one",), ("two",)], [("read",)]):
        ended = [process.communicate() for process in [begin(*each) for each in together]]
        assert {stderr for _, stderr in ended} == {""}
        derived.append([stdout.split()[-1] for stdout, _ in ended])  # whether SymPy was imported
        assert len(list((tmp_path / "cache").glob("*"))) == (0 if together[0][0] == "none" else 1)
    assert derived == [["True"], ["True", "True"], ["False"]]
    names = ("none", "one", "two", "read")
    texts = [{file.name: file.read_bytes() for file in (tmp_path / name).glob("*.[ch]")} for name in names]
    assert texts[0] and all(text == texts[0] for text in texts)
