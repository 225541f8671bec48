"""generate: a folder that stands alone, whole or not at all, and never over what is somebody else's."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import stat
from collections.abc import Iterator
from pathlib import Path

import pytest

from cli.run import DEMO3, refused, run
from mahovik.core.emit import delivery
from mahovik.core.stand import identities, load
from mahovik.core.stand.model import Stand
from mahovik.proof.verify.delivery import PROVENANCE

FILES = {
    "README.md",
    "demo3.c",
    "demo3.h",
    "verification/demo3_eva.c",
    "verification/demo3_eva.sh",
    "demo3_recorder.c",
    "demo3_recorder.h",
    "verification/demo3_selftest.c",
    "manifest.json",
}


@pytest.fixture(scope="module", autouse=True)
def generated_once() -> Iterator[None]:
    """Each stand is generated once: what is tried here is what happens to the files."""
    original = delivery.delivery
    known: dict[tuple[object, ...], dict[str, str]] = {}

    def once(
        stand: Stand,
        real: str = "double",
        batch: bool = False,
        only: tuple[str, ...] = (),
    ) -> dict[str, str]:
        key = (stand.name, real, batch, only)
        known[key] = known.get(key) or original(stand, real, batch, only)
        return dict(known[key])

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(delivery, "delivery", once)
        yield


@pytest.fixture(scope="module")
def delivered(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of demo3, not to be changed."""
    folder = tmp_path_factory.mktemp("delivered")
    assert run("generate", DEMO3, "-o", str(folder)).exit_code == 0
    return folder


@pytest.fixture
def folder(delivered: Path, tmp_path: Path) -> Path:
    """A copy of it."""
    return Path(shutil.copytree(delivered, tmp_path / "out"))


def names_in(folder: Path) -> set[str]:
    """Names of all files in a folder and below it."""
    return {p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file() and p.name != PROVENANCE}


def contents(folder: Path) -> dict[str, bytes]:
    """Everything in a folder by name."""
    return {name: (folder / name).read_bytes() for name in names_in(folder)}


def sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def test_the_manifest_has_the_hash_of_every_file(delivered: Path) -> None:
    manifest = json.loads((delivered / "manifest.json").read_text())
    assert manifest["files"] == {name: sha256(delivered / name) for name in sorted(FILES - {"manifest.json"})}
    found = identities(load(DEMO3))
    assert (manifest["stand"], manifest["real"]) == ("demo3", "double")
    assert (manifest["structure"], manifest["physics"]) == (found.structure, found.physics)
    keys = {"format", "generator", "stand", "structure", "physics", "real", "files"}
    assert set(manifest) == keys  # no date


def test_batches_are_added_where_they_are_asked_for_and_taken_away_again(folder: Path) -> None:
    before = contents(folder)
    assert run("generate", DEMO3, "-o", str(folder), "--batch").exit_code == 0
    found = contents(folder)
    assert set(found) == FILES | {"demo3_batch.c", "demo3_batch.h"}
    assert {name for name in FILES if found[name] != before[name]} == {"README.md", "manifest.json"}
    assert {"demo3_batch.c", "demo3_batch.h"} < set(json.loads(found["manifest.json"])["files"])
    assert "demo3_batch.h" in found["README.md"].decode()
    assert run("generate", DEMO3, "-o", str(folder), "--batch", "--check").exit_code == 0
    assert run("generate", DEMO3, "-o", str(folder), "--check").exit_code == 0
    assert "demo3_batch.c was removed" in run("generate", DEMO3, "-o", str(folder)).output
    assert contents(folder) == before


def test_again_touches_nothing_that_is_the_same(folder: Path) -> None:
    before = {name: (folder / name).stat().st_mtime_ns for name in names_in(folder)}
    (folder / "demo3.h").unlink()
    run("generate", DEMO3, "-o", str(folder))
    after = {name: (folder / name).stat().st_mtime_ns for name in names_in(folder)}
    assert {name for name in FILES if after[name] != before[name]} == {"demo3.h"}
    assert set(after) == FILES
    assert stat.S_IMODE((folder / "demo3.h").stat().st_mode) & stat.S_IRUSR


# ---- what is somebody else's ----


@pytest.mark.parametrize("name", ["README.md", "demo3.c", "verification/demo3_selftest.c", "manifest.json"])
def test_a_file_of_others_is_not_overwritten(name: str, tmp_path: Path) -> None:
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text("mine\n")
    words = refused("generate", DEMO3, "-o", str(tmp_path))
    assert words.startswith(f"error: {tmp_path / name}: ")
    assert words.endswith("nothing was written\n")
    assert contents(tmp_path) == {name: b"mine\n"}


# ---- whole or not at all ----


@pytest.mark.parametrize("fault", [KeyboardInterrupt, OSError])
@pytest.mark.parametrize("after", [0, 2, 5])
def test_an_interrupted_run_leaves_the_old_folder(
    fault: type[BaseException], after: int, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = contents(folder)
    real, calls = os.replace, []

    def replace(source: Path, target: Path) -> None:
        calls.append(target)
        if len(calls) == after + 1:
            raise fault("stopped")
        real(source, target)

    monkeypatch.setattr("mahovik.writing.os.replace", replace)
    result = run("generate", DEMO3, "-o", str(folder), "--real", "float")
    assert result.exit_code != 0
    assert contents(folder) == before
    assert len(calls) > after


# ---- COST.md ----


# ---- cost.json ----


# ---- a project of `export target` ----


def test_a_project_and_a_delivered_folder_are_not_mixed(folder: Path, tmp_path: Path) -> None:
    before = contents(folder)
    said = refused("export", "target", DEMO3, "--target", "host", "-o", str(folder))
    assert said.startswith(f"error: {folder}: holds what `mahovik generate` delivers: ")
    assert contents(folder) == before
    project = tmp_path / "project"
    assert run("export", "target", DEMO3, "--target", "host", "-o", str(project)).exit_code == 0
    before = contents(project)
    assert "holds the project of target host" in refused("generate", DEMO3, "-o", str(project))
    assert contents(project) == before
    assert run("export", "target", DEMO3, "--target", "host", "-o", str(project)).exit_code == 0


def test_a_program_of_the_user_stays_in_a_project(tmp_path: Path) -> None:
    project, own = tmp_path / "project", "int main(void) { return 0; }\n"
    export = ("export", "target", DEMO3, "--target", "host", "-o", str(project))
    assert run(*export).exit_code == 0
    before = contents(project)
    (project / "main.c").write_text(own)
    for _ in range(2):
        (project / "demo3.h").unlink()
        done = run(*export)
        assert done.exit_code == 0 and f"{project / 'main.c'} is yours and stays as it is" in done.output
        assert contents(project) == before | {"main.c": own.encode()}
    (project / "verification/board.c").write_text(own)
    assert "board.c: was changed by hand" in refused(*export)
    assert contents(project) == before | {"main.c": own.encode(), "verification/board.c": own.encode()}


# ---- --check ----
