"""A library is taken from the cache only where the compiler would build the same one."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import pytest

from mahovik.core.toolchain import library
from mahovik.errors import ToolchainError
from toolchain.build_cache import KEPT, Build, caching, tidy

FLAGS = ("-ffp-contract=off", "-O2")


class Recorder:
    """A build that writes the number of its call."""

    def __init__(self) -> None:
        self.calls = 0

    def __call__(self, source: Path, library: Path, how: Sequence[str]) -> None:
        self.calls += 1
        if "refused" in source.read_text(encoding="ascii"):
            raise ToolchainError("refused")
        library.write_text(str(self.calls), encoding="ascii")


@pytest.fixture
def recorder() -> Recorder:
    return Recorder()


@pytest.fixture
def build(recorder: Recorder, tmp_path: Path) -> Build:
    """A build with an empty cache."""
    (tmp_path / "kept").mkdir()
    return caching(recorder, tmp_path / "kept")


def built(build: Build, folder: Path, source: str = "int x;\n", header: str = "", flags: Sequence[str] = FLAGS) -> str:
    """What lies in the library of a source with a header beside it."""
    folder.mkdir(exist_ok=True)
    (folder / "x.h").write_text(header, encoding="ascii")
    (folder / "x.c").write_text(source, encoding="ascii")
    build(folder / "x.c", folder / "x.so", flags)
    return (folder / "x.so").read_text(encoding="ascii")


def test_equal_sources_are_built_once(build: Build, recorder: Recorder, tmp_path: Path) -> None:
    assert [built(build, tmp_path / name) for name in ("one", "two")] == ["1", "1"]
    assert recorder.calls == 1


def test_whatever_the_compiler_sees_is_in_the_key(
    build: Build, recorder: Recorder, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = tmp_path / "one"
    found = [built(build, place), built(build, place, "int y;\n"), built(build, place, header="int z;\n")]
    found.append(built(build, place, flags=("-O0",)))
    monkeypatch.setenv("CC", "gcc -g0")
    found.append(built(build, place))
    assert len(set(found)) == recorder.calls == 5


def test_a_refusal_is_not_kept(build: Build, recorder: Recorder, tmp_path: Path) -> None:
    for _ in range(2):
        with pytest.raises(ToolchainError):
            built(build, tmp_path / "one", "refused")
    assert recorder.calls == 2


def test_code_for_this_processor_is_not_kept(build: Build, recorder: Recorder, tmp_path: Path) -> None:
    for _ in range(2):
        built(build, tmp_path / "one", flags=("-march=native",))
    assert recorder.calls == 2


def test_the_least_used_go(tmp_path: Path) -> None:
    for number in range(KEPT + 2):
        (tmp_path / f"{number}.so").touch()
    tidy(tmp_path)
    assert len(list(tmp_path.iterdir())) == KEPT


def test_libraries_of_this_process_are_built_without_optimisation() -> None:
    assert vars(library)["build_shared"].keywords == {"optimisation": "-O0"}


def test_commands_that_tests_start_keep_their_compiled_modules() -> None:
    assert "PYTHONDONTWRITEBYTECODE" not in os.environ
