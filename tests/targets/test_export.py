"""An exported project is complete: plain `make` builds it, the emulator says that nothing failed."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from cli.run import DEMO3, refused, run
from targets.boards import target
from toolchain.quick import quick
from toolchain.tools import require


@pytest.mark.parametrize(("name", "real"), quick(0, [("m4", "float"), ("rv64gc", "double"), ("host", "double")]))
def test_make_builds_and_the_board_finds_no_failure(name: str, real: str, tmp_path: Path) -> None:
    target(name)
    make = require("make", "make")
    folder = tmp_path / "project"
    result = run("export", "target", DEMO3, "--target", name, "-o", str(folder))
    assert result.exit_code == 0, result.output
    built = subprocess.run([make], cwd=folder, capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stderr
    assert built.stderr == ""
    done = subprocess.run([make, "-s", "run"], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert lines[0].endswith(f"real {real}")
    assert lines[-1] == "failures 0"
    readme = (folder / "README.md").read_text()
    for file in folder.rglob("*"):
        if file.suffix in (".c", ".S", ".ld", ".h") and file.stem not in ("link",):
            assert f"`{file.name}`" in readme, f"{file.name} is not in the README"
    run("export", "target", DEMO3, "--target", name, "-o", str(folder))  # again, over its own files
    assert subprocess.run([make, "clean"], cwd=folder, capture_output=True, check=False).returncode == 0


def test_what_is_not_ours_is_not_overwritten(tmp_path: Path) -> None:
    (tmp_path / "main.c").write_text("int main(void) { return 0; }\n")
    before = sorted(tmp_path.iterdir())
    assert "was not written by mahovik" in refused("export", "target", DEMO3, "--target", "m7", "-o", str(tmp_path))
    assert sorted(tmp_path.iterdir()) == before


def test_targets_that_cannot_be_exported() -> None:
    assert 'did you mean "m7"' in refused("export", "target", DEMO3, "--target", "m77")
    assert "export m7 instead" in refused("export", "target", DEMO3, "--target", "m7-clang")
