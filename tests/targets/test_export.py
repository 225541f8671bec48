"""An exported project is complete: plain `make` builds it, the emulator says that nothing failed."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from cli.run import DEMO3, refused, run
from mahovik.stands import path
from toolchain.tools import require, target

EYE4 = str(path("eye4"))


KINDS: dict[str, tuple[str, ...]] = {"target": (), "attitude": ("--attitude", "pointing")}


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "stand"), [("target", DEMO3), ("attitude", EYE4)])
@pytest.mark.parametrize(
    ("name", "real"), [("m4", "float"), ("m7", "double"), ("rv64gc", "double"), ("host", "double")]
)
def test_make_builds_and_the_board_finds_no_failure(
    kind: str, stand: str, name: str, real: str, tmp_path: Path
) -> None:
    target(name)
    make, folder = require("make", "make"), tmp_path / "project"
    for _ in range(2):  # the second time over its own files
        result = run("generate", stand, *KINDS[kind], "--project", name, "-o", str(folder))
        assert result.exit_code == 0, result.output
    goal = "compare" if kind == "attitude" and name != "host" else "run"
    for command in ([make], [make, "-s", goal]):
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines()[-1] == "failures 0"
    readme = (folder / "README.md").read_text()
    assert real in readme
    for file in folder.rglob("*"):
        if file.suffix in (".c", ".S", ".ld", ".h") and file.stem != "link":
            assert f"{file.name}`" in readme, f"{file.name} is not in the README"


def test_an_attitude_loop_is_exported_with_its_settings(tmp_path: Path) -> None:
    """Over its own files; the page names the command that made it."""
    for _ in range(2):
        result = run("generate", EYE4, "--attitude", "momentum=0.5", "--project", "m7", "-o", str(tmp_path / "project"))
        assert result.exit_code == 0, result.output
    page = (tmp_path / "project" / "README.md").read_text()
    assert "generate STAND.toml --attitude task=pointing --attitude momentum=0.5 --project m7 --real double`" in page
    assert "eye4_inverse(" not in (tmp_path / "project" / "eye4.h").read_text()
    assert result.output.splitlines()[-1] == "attitude loop: momentum is dumped by at most 0.05 N m"


@pytest.mark.parametrize("kind", ["target", "attitude"])
def test_what_is_not_ours_is_not_overwritten(kind: str, tmp_path: Path) -> None:
    (tmp_path / "main.c").write_text("int main(void) { return 0; }\n")
    options = (*KINDS[kind], "--project", "m7", "-o", str(tmp_path))
    assert "was not written by mahovik" in refused("generate", EYE4, *options)
    assert [file.name for file in tmp_path.iterdir()] == ["main.c"]


@pytest.mark.parametrize(
    ("kind", "options", "message"),
    [
        ("target", ("--project", "m77"), 'did you mean "m7"'),
        ("target", ("--project", "m7-clang"), "choose m7 instead"),
        ("attitude", ("--project", "m77", "--attitude", "pointing"), 'did you mean "m7"'),
        ("attitude", ("--attitude", "pont"), 'stand "eye4" has no such task'),
        ("attitude", ("--attitude", "rate=-1"), "--attitude rate -1: expected a number above 0"),
        ("attitude", ("--attitude", "failure=explodes"), "explodes"),
        ("attitude", ("--attitude", "momentum=5"), "expected at most 1.38 N m s"),
    ],
)
def test_what_cannot_be_exported_is_refused(kind: str, options: tuple[str, ...], message: str, tmp_path: Path) -> None:
    assert message in refused("generate", EYE4, *options, "-o", str(tmp_path / "project"))
    assert not (tmp_path / "project").exists()
