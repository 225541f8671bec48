"""generate: a folder that stands alone, whole or not at all, never over what is others'; its parts and names."""

from __future__ import annotations

import hashlib
import json
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from cli.run import BENCH8, DEMO3, refused, run
from mahovik.contract.functions import DEFAULT
from mahovik.core.emit.delivered import PROVENANCE
from mahovik.core.stand import identities, load
from mahovik.core.toolchain.targets import TARGETS, build
from mahovik.core.toolchain.targets import run as run_program
from mahovik.stands import path
from targets.flight import flight
from toolchain.tools import compile_c, require


@pytest.fixture(scope="module")
def delivered(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of demo3, not to be changed."""
    folder = tmp_path_factory.mktemp("delivered")
    assert generate(folder) == ""
    return folder


@pytest.fixture
def folder(delivered: Path, tmp_path: Path) -> Path:
    """A copy of it."""
    return Path(shutil.copytree(delivered, tmp_path / "out"))


def generate(folder: Path, *options: str) -> str:
    """Writes C and self-test into the folder; returns what is said beside the list of files."""
    result = run("generate", DEMO3, "-o", str(folder), "--with", "selftest", *options, "--json")
    assert result.exit_code == 0, result.output
    return result.stderr + "".join(f"{line}\n" for line in json.loads(result.stdout)["messages"])


def contents(folder: Path) -> dict[str, bytes]:
    """Everything in a folder and below it by name, but for what made it."""
    files = [p for p in folder.rglob("*") if p.is_file() and p.name != PROVENANCE]
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in files}


def sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def test_the_manifest_has_the_hash_of_every_file(delivered: Path) -> None:
    manifest = json.loads((delivered / "manifest.json").read_text())
    assert manifest["files"] == {n: sha256(delivered / n) for n in sorted(contents(delivered)) if n != "manifest.json"}
    hashes = identities(load(DEMO3))
    assert (manifest["stand"], manifest["real"]) == ("demo3", "double")
    assert (manifest["structure"], manifest["physics"]) == (hashes.structure, hashes.physics)
    assert set(manifest) == {"format", "generator", "stand", "structure", "physics", "real", "only", "files"}  # no date
    assert manifest["only"] == [name for name in manifest["only"] if name in DEFAULT]
    assert set(manifest["only"]) == set(DEFAULT) and "demo3_mounts(" not in (delivered / "demo3.h").read_text()


def test_batches_are_added_where_they_are_asked_for_and_taken_away_again(folder: Path) -> None:
    before = contents(folder)
    generate(folder, "--batch")
    files = contents(folder)
    assert set(files) == set(before) | {"demo3_batch.c", "demo3_batch.h"}
    assert {name for name in before if files[name] != before[name]} == {"README.md", "manifest.json"}
    assert {"demo3_batch.c", "demo3_batch.h"} < set(json.loads(files["manifest.json"])["files"])
    generate(folder, "--check")
    assert "demo3_batch.c was removed" in generate(folder)
    assert contents(folder) == before


def test_again_touches_nothing_that_is_the_same(folder: Path) -> None:
    before = {name: (folder / name).stat().st_mtime_ns for name in contents(folder)}
    (folder / "demo3.h").unlink()
    generate(folder)
    assert {name for name in before if (folder / name).stat().st_mtime_ns != before[name]} == {"demo3.h"}


def test_check_finds_what_was_changed_or_lost_and_writes_nothing(folder: Path) -> None:
    """A folder of the other element type differs in every file: that is one line."""
    check = ("generate", DEMO3, "-o", str(folder), "--check")
    assert run(*check).output == f"{folder} is as the stand file gives it\n"
    said = refused(*check, "--real", "float", status=1)
    assert said == f"error: {folder}: its C is double, expected float: --real double is right, or generate it again\n"
    for name in ("demo3.c", "verification/demo3_selftest.c", "manifest.json"):
        text = (folder / name).read_text()
        (folder / name).write_text(text + " ")
        before = contents(folder)
        assert f"{folder / name}: " in refused(*check, status=1)
        assert contents(folder) == before
        (folder / name).unlink()
        assert f"{folder / name}: is missing" in refused(*check, status=1)
        (folder / name).write_text(text)
    said = refused("generate", DEMO3, "-o", str(folder / "none"), "--check", status=1)
    assert "manifest.json: is missing, expected what generate wrote, with the project that it was made with" in said
    assert not (folder / "none").exists()


def test_float_takes_the_place_of_double(folder: Path) -> None:
    generate(folder, "--real", "float")
    assert json.loads((folder / "manifest.json").read_text())["real"] == "float"
    assert "typedef float demo3_real;" in (folder / "demo3.h").read_text()
    generate(folder, "--check")
    refused("generate", DEMO3, "-o", str(folder), "--real", "double", "--check", status=1)


@pytest.mark.parametrize("name", ["README.md", "verification/demo3_selftest.c", "manifest.json"])
def test_a_file_of_others_is_not_overwritten(name: str, tmp_path: Path) -> None:
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text("mine\n")
    words = refused("generate", DEMO3, "-o", str(tmp_path), "--with", "selftest")
    assert words.startswith(f"error: {tmp_path / name}: ") and words.endswith("nothing was written\n")
    assert contents(tmp_path) == {name: b"mine\n"}


def test_what_was_changed_by_hand_or_is_of_another_stand_is_not_overwritten(folder: Path) -> None:
    assert 'holds the C of stand "demo3"' in refused("generate", BENCH8, "-o", str(folder))
    (folder / "demo3.c").write_text((folder / "demo3.c").read_text() + "/* mine */\n")
    before = contents(folder)
    assert "demo3.c: was changed by hand" in refused("generate", DEMO3, "-o", str(folder))
    assert contents(folder) == before


def test_what_is_no_longer_delivered_is_removed(folder: Path) -> None:
    before = set(contents(folder))
    listed = json.loads((folder / "manifest.json").read_text())
    listed["files"] |= dict.fromkeys(("old.h", "kept.h"), hashlib.sha256(b"once delivered\n").hexdigest())
    (folder / "manifest.json").write_text(json.dumps(listed))
    (folder / "old.h").write_text("once delivered\n")
    (folder / "kept.h").write_text("changed by hand\n")
    assert f"{folder / 'old.h'} was removed: it is no longer delivered" in generate(folder)
    assert set(contents(folder)) == before | {"kept.h"}
    run("generate", DEMO3, "-o", str(folder), "--only", "forward")
    assert not (folder / "verification").exists()


def test_a_page_of_cost_that_was_measured_on_other_c_is_removed_and_that_of_others_stays(folder: Path) -> None:
    before = set(contents(folder))
    (folder / "COST.md").write_text(
        f"# Cost of demo3\n\nWritten by `mahovik verify --cost`\n\nof the source `{'0' * 64}`\n"
    )
    assert "COST.md: was measured on other C" in refused("generate", DEMO3, "-o", str(folder), "--check", status=1)
    assert f"{folder / 'COST.md'} was removed: it was measured on other C" in generate(folder)
    assert set(contents(folder)) == before
    (folder / "COST.md").write_text("what we paid\n")
    generate(folder)
    assert (folder / "COST.md").read_text() == "what we paid\n"


def test_a_project_and_a_delivered_folder_are_not_mixed(folder: Path, tmp_path: Path) -> None:
    """The program of the user stays in a project."""
    before = contents(folder)
    said = refused("generate", DEMO3, "--project", "host", "-o", str(folder))
    assert said.startswith(f"error: {folder}: holds what `mahovik generate` delivers: ")
    assert contents(folder) == before
    project, program = tmp_path / "project", "int main(void) { return 0; }\n"
    export = ("generate", DEMO3, "--project", "host", "-o", str(project))
    assert run(*export).exit_code == 0
    before = contents(project)
    assert "holds the project of target host" in refused("generate", DEMO3, "-o", str(project))
    (project / "main.c").write_text(program)
    assert f"{project / 'main.c'} is yours and stays as it is" in run(*export).output
    assert contents(project) == before | {"main.c": program.encode()}
    (project / "verification/board.c").write_text(program)
    assert "board.c: was changed by hand" in refused(*export)


SHAKER2 = str(path("shaker2"))


def generated(folder: Path, *options: str) -> Path:
    """The folder of `generate` with these options."""
    assert run("generate", SHAKER2, *options, "-o", str(folder)).exit_code == 0
    return folder


@pytest.fixture(scope="module")
def part(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two functions of shaker2 under another name."""
    return generated(
        tmp_path_factory.mktemp("part") / "c", "--only", "forward,torque", "--prefix", "shakerp", "--with", "selftest"
    )


@pytest.fixture(scope="module")
def log(part: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Output of its self-test."""
    return self_test(part, "shakerp", tmp_path_factory.mktemp("log"))


def self_test(folder: Path, name: str, scratch: Path) -> Path:
    """Builds and runs the self-test of a folder; returns its log."""
    sources = folder / f"{name}.c", folder / f"verification/{name}_selftest.c"
    compile_c(
        require("gcc", "gcc"),
        *sources,
        "-O1",
        "-ffp-contract=off",
        f"-D{name.upper()}_SELFTEST_MAIN",
        "-o",
        scratch / "program",
    )
    printed = subprocess.run([scratch / "program"], capture_output=True, text=True, check=True, timeout=60).stdout
    (scratch / "board.log").write_text(printed)
    return scratch / "board.log"


def test_verify_judges_the_functions_that_are_there_under_their_name(part: Path) -> None:
    result = run("verify", SHAKER2, str(part), "--states", "9", "--json")
    assert result.exit_code == 0, result.output
    report = json.loads(result.stdout)
    assert report["stand"] == "shakerp"
    assert report["subject"] == f"C in {part}, only forward, torque"
    verdicts = {(row["judged"], row["quantity"]): row["verdict"] for row in report["rows"]}
    assert verdicts["forward", "V_dot"] == verdicts["torque", "tau"] == "ok"
    assert verdicts["", "interpreter = C, bit for bit"] == verdicts["", "bad inputs refused"] == "ok"
    absent = {want for (want, quantity), verdict in verdicts.items() if verdict == "not compared"}
    assert {"inverse", "step", "quaternion", "prepare"} <= absent
    assert not absent & {"forward", "torque", ""}
    assert {want for want, _ in verdicts} == absent | {"forward", "torque", ""}


@pytest.mark.parametrize(
    ("only", "status", "words"),
    [
        ("", 1, "C of some functions alone? name them: only forward,torque\n"),
        ("forward", 1, "unknown functions: torque"),
        ("forward,torque,wrap", 1, "no line PASS or FAIL of: wrap"),
        ("forwart", 2, '--only forwart: the C of shakerp has no such function, did you mean "forward"?'),
    ],
)
def test_the_log_of_a_part_gives_no_false_alarm(only: str, status: int, words: str, log: Path) -> None:
    options = ("--only", only) if only else ()
    message = refused("verify", SHAKER2, str(log), *options, status=status)
    assert words in message and "other bits" not in message


def test_the_stand_under_another_name_is_known_by_its_physics(part: Path, tmp_path: Path) -> None:
    """C of another stand is refused, and C of this one under two names in one folder."""
    message = refused("verify", DEMO3, str(part), status=1)
    assert re.search(r': holds the C of stand "shakerp", physics [0-9a-f]{8}, expected that of "\w+", also', message)
    folder = generated(tmp_path / "two", "--only", "wrap", "--prefix", "shakerq")
    for name in ("shakerp.h", "shakerp.c"):
        (folder / name).write_bytes((part / name).read_bytes())
    message = refused("verify", SHAKER2, str(folder), status=1)
    assert 'holds C of this stand under the names "shakerp" and "shakerq": move all but one' in message


@pytest.mark.slow
def test_a_flight_under_another_name_is_replayed(tmp_path: Path) -> None:
    texts = flight(replace(load(DEMO3), name="other"), "double", 20)
    flown = tmp_path / "flight.log"
    flown.write_text(run_program(TARGETS["host"], build(TARGETS["host"], texts, tmp_path)))
    result = run("replay", DEMO3, "--log", str(flown))
    assert result.exit_code == 0, result.output
    assert "all 20 steps bit for bit: other, double" in result.output


def test_settings_given_in_both_forms(tmp_path: Path) -> None:
    loop = (
        "generate",
        str(path("sat4")),
        "--attitude",
        "pointing",
        "--attitude",
        "rate=100",
        "-o",
        str(tmp_path / "a"),
    )
    assert run(*loop).exit_code == 0
    said = refused("generate", DEMO3, "--project", "fmu", "--fmu", "kind=cs", "--fmu", "dt")
    assert said.startswith('error: --fmu dt: ""')
