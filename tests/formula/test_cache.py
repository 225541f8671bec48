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
GENERATED = Path(__file__).resolve().parents[2] / "generated"


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


def mahovik(*arguments: str, cwd: Path, **env: str) -> subprocess.CompletedProcess[str]:
    """A command in its own process; says at last whether SymPy was imported."""
    return subprocess.run(
        [sys.executable, "-c", CODE, *arguments],
        cwd=cwd,
        env={**os.environ, **env},
        capture_output=True,
        text=True,
        check=False,
    )


def test_what_was_derived_is_not_derived_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    warnings: list[str] = []
    first = remembered(warnings)
    monkeypatch.setattr("mahovik.core.formula.derived._derive", lambda *_: pytest.fail("derived again"))
    assert remembered(warnings) == first == remembered(warnings)
    assert warnings == []
    assert len(list(folder.iterdir())) == 1


def test_without_a_command_nothing_is_kept(folder: Path) -> None:
    carrier.momentum(True)
    assert not folder.exists()


def truncated(file: Path) -> None:
    file.write_bytes(file.read_bytes()[:-20])


def empty(file: Path) -> None:
    file.write_bytes(b"")


def binary(file: Path) -> None:
    file.write_bytes(bytes(range(256)))


def list_(file: Path) -> None:
    file.write_text("[1, 2]")


def deep(file: Path) -> None:
    file.write_text("[" * 100_000 + "]" * 100_000)


def other_formula(file: Path) -> None:
    text = file.read_text()
    assert '"mu[0]"' in text
    file.write_text(text.replace('"mu[0]"', '"mu[1]"', 1))


def no_entries(file: Path) -> None:
    file.write_text(json.dumps(json.loads(file.read_text()) | {"entries": None}))


def other_source(file: Path) -> None:
    file.write_text(json.dumps(json.loads(file.read_text()) | {"source": "0" * 64}))


DAMAGE = (truncated, empty, binary, list_, deep, other_formula, no_entries, other_source)


@pytest.mark.parametrize("damage", DAMAGE)
def test_a_damaged_cache_is_made_anew_with_one_warning(folder: Path, damage: Callable[[Path], None]) -> None:
    expected = remembered([])
    (file,) = folder.iterdir()
    whole = file.read_bytes()
    damage(file)
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


PLACES = ("contract", "core/derive", "core/formula", "core/stand", "core/motion", "core/lower", "laws/leg")


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


def test_a_folder_that_cannot_be_written_is_no_failure(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Not even for root, who may write anywhere: a file is in the place of the folder."""
    (tmp_path / "file").write_text("")
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path / "file" / "cache"))
    warnings: list[str] = []
    assert remembered(warnings) == carrier.momentum(True)
    assert warnings == []


def test_a_read_only_folder_is_no_failure(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The error is raised by hand, since root may write anywhere."""

    def refused(*_: object) -> None:
        raise PermissionError(13, "Permission denied", str(folder))

    folder.mkdir()
    monkeypatch.setattr("mahovik.writing._create", refused)
    warnings: list[str] = []
    assert remembered(warnings) == carrier.momentum(True)
    assert list(folder.iterdir()) == []
    assert warnings == []


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


def test_no_home_means_no_cache(monkeypatch: pytest.MonkeyPatch) -> None:
    def homeless() -> Path:
        raise RuntimeError

    monkeypatch.delenv("MAHOVIK_CACHE")
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(Path, "home", homeless)
    monkeypatch.setattr(sys, "platform", "linux")
    assert cache.folder() is None
    assert remembered([]) == carrier.momentum(True)


@pytest.mark.slow
def test_processes_side_by_side(tmp_path: Path) -> None:
    """All start without a cache, of different stands; afterwards the cache is whole and serves all of them."""
    env = {**os.environ, cache.VARIABLE: str(tmp_path / "cache")}
    command = [sys.executable, "-m", "mahovik", "generate"]
    names = ("sat4", "shaker2", "sat4")
    running = [
        subprocess.Popen([*command, str(stands.path(n)), "-o", str(tmp_path / str(k))], env=env, stderr=subprocess.PIPE)
        for k, n in enumerate(names)
    ]
    assert [process.communicate()[1] for process in running] == [b""] * 3
    assert [process.returncode for process in running] == [0] * 3
    (file,) = (tmp_path / "cache").iterdir()
    assert cache._read(file)
    for name in sorted(set(names)):
        done = mahovik("generate", str(stands.path(name)), cwd=tmp_path, MAHOVIK_CACHE=str(tmp_path / "cache"))
        assert (done.returncode, done.stderr) == (0, "")


QUICK = ("demo3",)


@pytest.mark.slow
@pytest.mark.parametrize("name", [n if n in QUICK else pytest.param(n, marks=pytest.mark.slow) for n in stands.names()])
def test_the_bytes_of_generated_do_not_depend_on_it(name: str, tmp_path: Path) -> None:
    """Derived without a cache, derived into an empty one, and read from it: each is what is committed."""
    stand, committed = str(stands.path(name)), str(GENERATED / name)
    empty = {cache.VARIABLE: str(tmp_path / "cache")}
    runs = [
        mahovik("generate", stand, "-o", committed, "--check", *flags, cwd=tmp_path, **empty)
        for flags in (["--no-cache"], [], [])
    ]
    assert [(run.returncode, run.stderr) for run in runs] == [(0, "")] * 3
    assert [run.stdout.split()[-1] for run in runs] == ["True", "True", "False"]  # whether SymPy was imported
    assert len(list((tmp_path / "cache").iterdir())) == 1


@pytest.mark.slow
def test_no_cache_neither_reads_nor_writes(tmp_path: Path) -> None:
    folder = tmp_path / "cache"
    folder.mkdir()
    done = mahovik("generate", str(stands.path("sat4")), "--no-cache", cwd=tmp_path, MAHOVIK_CACHE=str(folder))
    assert (done.returncode, done.stderr) == (0, "")
    assert list(folder.iterdir()) == []


@pytest.mark.slow
def test_generate_warns_in_one_line(tmp_path: Path) -> None:
    env = {cache.VARIABLE: str(tmp_path / "cache")}
    stand = str(stands.path("sat4"))
    assert mahovik("generate", stand, "-o", "one", cwd=tmp_path, **env).stderr == ""
    (file,) = (tmp_path / "cache").iterdir()
    truncated(file)
    done = mahovik("generate", stand, "-o", "two", cwd=tmp_path, **env)
    assert done.returncode == 0
    assert done.stderr.startswith("warning: ")
    assert done.stderr.count("\n") == 1
    assert mahovik("generate", stand, "-o", "three", cwd=tmp_path, **env).stderr == ""
    texts = [{f.name: f.read_bytes() for f in (tmp_path / n).iterdir()} for n in ("one", "two", "three")]
    assert texts[0] == texts[1] == texts[2]
