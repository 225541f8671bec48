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

from cli.run import BENCH8, DEMO3, process, refused, run
from mahovik.core.emit import delivery
from mahovik.core.emit.generate import generate
from mahovik.core.stand import identities, load
from mahovik.core.stand.model import Stand
from mahovik.proof.verify.delivery import PROVENANCE, add_to_delivery

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


def test_it_writes_a_folder_and_needs_no_compiler(tmp_path: Path) -> None:
    done = process("generate", DEMO3, cwd=tmp_path, PATH="")
    assert done.returncode == 0
    assert names_in(tmp_path / "demo3") == FILES
    for name, text in generate(load(DEMO3)).items():
        assert (tmp_path / "demo3" / name).read_bytes() == text.encode()
        assert f"{name}   {text.count(chr(10))} lines" in done.stdout


def test_the_manifest_has_the_hash_of_every_file(delivered: Path) -> None:
    manifest = json.loads((delivered / "manifest.json").read_text())
    assert manifest["files"] == {name: sha256(delivered / name) for name in sorted(FILES - {"manifest.json"})}
    found = identities(load(DEMO3))
    assert (manifest["stand"], manifest["real"]) == ("demo3", "double")
    assert (manifest["structure"], manifest["physics"]) == (found.structure, found.physics)
    keys = {"format", "generator", "stand", "structure", "physics", "real", "files"}
    assert set(manifest) == keys  # no date


def test_float_takes_the_place_of_double(folder: Path) -> None:
    assert run("generate", DEMO3, "-o", str(folder), "--real", "float").exit_code == 0
    assert json.loads((folder / "manifest.json").read_text())["real"] == "float"
    assert "typedef float demo3_real;" in (folder / "demo3.h").read_text()
    assert run("generate", DEMO3, "-o", str(folder), "--real", "float", "--check").exit_code == 0
    assert run("generate", DEMO3, "-o", str(folder), "--check").exit_code == 0
    assert run("generate", DEMO3, "-o", str(folder), "--real", "double", "--check").exit_code == 1


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


def test_flywheels_side_by_side_and_bits_that_differ_are_no_options() -> None:
    for command in ("generate", "verify"):
        for option in ("--lanes", "--fast"):
            assert f"No such option '{option}'" in refused(command, DEMO3, option)


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


def test_a_file_that_was_changed_by_hand_is_not_overwritten(folder: Path) -> None:
    (folder / "demo3.c").write_text((folder / "demo3.c").read_text() + "/* mine */\n")
    before = contents(folder)
    assert "demo3.c: was changed by hand" in refused("generate", DEMO3, "-o", str(folder))
    assert contents(folder) == before


def test_the_folder_of_another_stand_is_refused(folder: Path) -> None:
    before = contents(folder)
    assert 'holds the C of stand "demo3"' in refused("generate", BENCH8, "-o", str(folder))
    assert contents(folder) == before


def test_c_of_a_generator_without_manifests_is_taken_over(folder: Path) -> None:
    for name in FILES - {"demo3.h", "demo3.c"}:
        (folder / name).unlink()
    (folder / "demo3.c").write_text((folder / "demo3.c").read_text().replace("0.1", "0.2"))
    (folder / "notes.txt").write_text("mine")
    assert run("generate", DEMO3, "-o", str(folder)).exit_code == 0
    assert names_in(folder) == FILES | {"notes.txt"}
    assert run("generate", DEMO3, "-o", str(folder), "--check").exit_code == 0


def test_what_is_no_longer_delivered_is_removed(folder: Path) -> None:
    add_to_delivery(folder, {"old.h": "once delivered\n"})
    add_to_delivery(folder, {"kept.h": "once delivered\n"})
    (folder / "kept.h").write_text("changed by hand\n")
    result = run("generate", DEMO3, "-o", str(folder))
    assert f"{folder / 'old.h'} was removed: it is no longer delivered" in result.output
    assert names_in(folder) == FILES | {"kept.h"}


# ---- whole or not at all ----


def test_a_folder_in_the_place_of_a_file(tmp_path: Path) -> None:
    (tmp_path / "demo3.h").mkdir()
    assert "demo3.h: is a directory" in refused("generate", DEMO3, "-o", str(tmp_path))
    assert [p.name for p in tmp_path.iterdir()] == ["demo3.h"]


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


def test_into_what_is_no_folder(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    assert "is a file, expected a folder" in refused("generate", DEMO3, "-o", str(tmp_path / "file"))
    assert "error: " in refused("generate", DEMO3, "-o", str(tmp_path / "file" / "deeper"))


def test_into_a_folder_that_may_not_be_written(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    folder = str(tmp_path) if os.geteuid() else "/sys"  # root may write anywhere but there
    words = refused("generate", DEMO3, "-o", folder)
    assert any(reason in words for reason in ("Permission denied", "Read-only file system", "not permitted")), words


def test_into_a_folder_that_cannot_be() -> None:
    assert refused("generate", DEMO3, "-o", "/proc/none/here").startswith("error: /proc/none/here: cannot be made")


# ---- COST.md ----


def test_the_cost_of_the_same_c_is_kept_and_listed(folder: Path) -> None:
    add_to_delivery(folder, {"COST.md": f"# Cost\n\nof the source `{sha256(folder / 'demo3.c')}`\n"})
    before = contents(folder)
    assert run("generate", DEMO3, "-o", str(folder)).exit_code == 0
    assert contents(folder) == before
    assert json.loads(before["manifest.json"])["files"]["COST.md"] == sha256(folder / "COST.md")
    assert run("generate", DEMO3, "-o", str(folder), "--check").exit_code == 0


@pytest.mark.parametrize("listed", [True, False])
def test_the_cost_of_other_c_is_removed(listed: bool, folder: Path) -> None:
    text = f"# Cost\n\nof the source `{'0' * 64}`\n"
    if listed:
        add_to_delivery(folder, {"COST.md": text})
    else:
        (folder / "COST.md").write_text(text)
    assert "COST.md: was measured on other C" in refused("generate", DEMO3, "-o", str(folder), "--check", status=1)
    result = run("generate", DEMO3, "-o", str(folder))
    assert f"{folder / 'COST.md'} was removed: it was measured on other C" in result.output
    assert names_in(folder) == FILES
    assert run("generate", DEMO3, "-o", str(folder), "--check").exit_code == 0


def test_a_cost_of_somebody_else_stays(folder: Path) -> None:
    (folder / "COST.md").write_text("what we paid\n")
    assert run("generate", DEMO3, "-o", str(folder)).exit_code == 0
    assert (folder / "COST.md").read_text() == "what we paid\n"
    assert "COST.md" not in json.loads((folder / "manifest.json").read_text())["files"]


# ---- cost.json ----

FIGURES = '{"stand": "demo3", "targets": []}'


def test_accepted_figures_are_kept_and_listed(folder: Path) -> None:
    (folder / "cost.json").write_text(FIGURES)  # of a generator that did not list it
    assert "cost.json: is not what manifest.json lists" in refused(
        "generate", DEMO3, "-o", str(folder), "--check", status=1
    )
    assert run("generate", DEMO3, "-o", str(folder)).exit_code == 0
    assert (folder / "cost.json").read_text() == FIGURES
    assert json.loads((folder / "manifest.json").read_text())["files"]["cost.json"] == sha256(folder / "cost.json")
    assert run("generate", DEMO3, "-o", str(folder), "--check").exit_code == 0
    assert run("generate", DEMO3, "-o", str(folder), "--real", "float").exit_code == 0  # other C: that is their use
    assert (folder / "cost.json").read_text() == FIGURES


def test_edited_or_lost_figures_are_found(folder: Path) -> None:
    add_to_delivery(folder, {"cost.json": FIGURES})
    assert run("generate", DEMO3, "-o", str(folder), "--check").exit_code == 0
    (folder / "cost.json").write_text(FIGURES + " ")
    said = refused("generate", DEMO3, "-o", str(folder), "--check", status=1)
    assert f"{folder / 'cost.json'}: is not what manifest.json lists" in said
    before = contents(folder)
    assert "cost.json: was changed by hand" in refused("generate", DEMO3, "-o", str(folder))
    assert contents(folder) == before
    (folder / "cost.json").unlink()
    assert "does not list these files" in refused("generate", DEMO3, "-o", str(folder), "--check", status=1)


@pytest.mark.parametrize("text", ["what we paid\n", '{"stand": "bench8", "targets": []}', "[]"])
def test_figures_of_somebody_else_stay_unlisted(text: str, folder: Path) -> None:
    (folder / "cost.json").write_text(text)
    assert run("generate", DEMO3, "-o", str(folder)).exit_code == 0
    assert (folder / "cost.json").read_text() == text
    assert "cost.json" not in json.loads((folder / "manifest.json").read_text())["files"]


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


def test_check_writes_nothing(folder: Path) -> None:
    before = contents(folder)
    result = run("generate", DEMO3, "-o", str(folder), "--check")
    assert (result.exit_code, result.output) == (0, f"{folder}   as the stand file gives it\n")
    assert contents(folder) == before
    assert "is missing" in refused("generate", DEMO3, "-o", str(folder / "none"), "--check", status=1)
    assert not (folder / "none").exists()


@pytest.mark.parametrize("name", sorted(FILES))
def test_check_finds_what_was_changed_or_lost(name: str, folder: Path) -> None:
    (folder / name).write_bytes((folder / name).read_bytes() + b" ")
    assert f"{folder / name}: " in refused("generate", DEMO3, "-o", str(folder), "--check", status=1)
    (folder / name).unlink()
    assert f"{folder / name}: is missing" in refused("generate", DEMO3, "-o", str(folder), "--check", status=1)


def test_check_of_the_other_element_type_is_one_line(folder: Path) -> None:
    said = refused("generate", DEMO3, "--real", "float", "-o", str(folder), "--check", status=1)
    assert said == f"error: {folder}: its C is double, expected float: give --real double, or generate it again\n"


def test_the_page_of_another_prefix_says_of_what_stand_file_it_is(tmp_path: Path) -> None:
    """A copy of the stand file with that name makes the same folder."""
    assert run("generate", DEMO3, "--prefix", "other", "-o", str(tmp_path / "c")).exit_code == 0
    assert "the stand file whose `name` is `other`" in (tmp_path / "c" / "README.md").read_text()
    copy = tmp_path / "other.toml"
    copy.write_text(Path(DEMO3).read_text().replace('name = "demo3"', 'name = "other"', 1))
    assert run("generate", str(copy), "-o", str(tmp_path / "c"), "--check").exit_code == 0
