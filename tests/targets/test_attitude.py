"""The attitude loop on emulated boards, with its plant: the bits of this machine; the exported project makes itself."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from cli.run import refused, run
from mahovik.core.stand import load
from mahovik.core.toolchain import board
from mahovik.out.export.attitude import attitude_sources
from mahovik.stands import path
from mahovik.use.control.attitude import LoopOptions
from targets.boards import target
from toolchain.quick import quick
from toolchain.tools import require

EYE4 = str(path("eye4"))
SHORT = LoopOptions(rate=10.0, momentum=0.01)
FLAGS = ("-DSETTLE=100", "-DDUMP=300", "-DLAST=10", "-DARCSEC_MOST=100")
"""A slew with a failed flywheel, and a little momentum to dump."""


def printed(name: str, real: str, folder: Path) -> list[str]:
    """Lines of the example on a target, without those that count instructions."""
    folder.mkdir()
    chosen = target(name)
    made = attitude_sources(load(path("eye4")), SHORT, real)
    lines = board.run(chosen, board.build(chosen, made.files, folder, extra=FLAGS), timeout=300).splitlines()
    return [line for line in lines if not line.startswith("#")]


@pytest.mark.parametrize(
    ("name", "real"),
    quick(
        0,
        [
            ("m7", "double"),
            ("m4", "float"),
            ("m7", "float"),
            ("m33", "float"),
            ("rv64gc", "double"),
            ("rv32imac", "double"),
        ],
    ),
)
def test_a_board_has_the_bits_of_this_machine(name: str, real: str, tmp_path: Path) -> None:
    """Double by software on a Cortex-M has other bits in rare cases: test_soft_double.py."""
    here, there = printed("host", real, tmp_path / "host"), printed(name, real, tmp_path / "board")
    assert here == there
    assert any(line.startswith("hash ") for line in here)
    assert here[-1] == "failures 0"


@pytest.mark.slow
@pytest.mark.parametrize(("name", "real"), [("m7", "double"), ("m4", "float"), ("host", "double")])
def test_make_builds_runs_and_compares(name: str, real: str, tmp_path: Path) -> None:
    target(name)
    make = require("make", "make")
    folder = tmp_path / "project"
    result = run("export", "attitude", EYE4, "--target", name, "-o", str(folder))
    assert result.exit_code == 0, result.output
    goal = "run" if name == "host" else "compare"
    done = subprocess.run([make, "-s", goal], cwd=folder, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines()[-1] == "failures 0"
    first = (folder / ("target.txt" if goal == "compare" else "README.md")).read_text()
    assert real in first


def test_the_project_has_what_its_page_names(tmp_path: Path) -> None:
    folder = tmp_path / "project"
    for _ in range(2):  # the second time over its own files
        result = run("export", "attitude", EYE4, "--target", "m7", "--momentum", "0.5", "-o", str(folder))
        assert result.exit_code == 0, result.output
    page = (folder / "README.md").read_text()
    for file in folder.rglob("*"):
        if file.suffix in (".c", ".h", ".ld"):
            assert f"`{file.relative_to(folder).as_posix()}`" in page, file
    assert "mahovik export attitude STAND.toml --task pointing --target m7 --real double --momentum 0.5`" in page
    assert "eye4_inverse(" not in (folder / "eye4.h").read_text()
    assert result.output.splitlines()[-1] == "attitude loop: momentum is dumped by at most 0.05 N m"


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (("--target", "m77"), 'did you mean "m7"'),
        (("--task", "pont"), 'stand "eye4" has no such task'),
        (("--rate", "-1"), "--rate -1: expected a number above 0"),
        (("--failure", "explodes"), "explodes"),
        (("--momentum", "5"), "expected at most 1.38 N m s"),
    ],
)
def test_what_cannot_be_exported_is_refused_and_nothing_is_written(
    given: tuple[str, ...], message: str, tmp_path: Path
) -> None:
    assert message in refused("export", "attitude", EYE4, *given, "-o", str(tmp_path / "project"))
    assert not (tmp_path / "project").exists()


def test_a_file_of_others_stays(tmp_path: Path) -> None:
    (tmp_path / "main.c").write_text("int main(void) { return 0; }\n")
    assert "was not written by mahovik" in refused("export", "attitude", EYE4, "-o", str(tmp_path))
    assert [file.name for file in tmp_path.iterdir()] == ["main.c"]
