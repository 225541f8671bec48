"""Programmes, servos and attitude loops are compiled by the project of their folder, whatever was written first."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from cli.run import refused, run
from export.test_cmake import build, call, ctest
from mahovik import stands
from toolchain.tools import require, target

SERVO = """schema = 1
name = "drive"
sample_period = "0.5 ms"
latency = "0.1 ms"
bandwidth = "20 Hz"
"""


def invoked(*arguments: str) -> None:
    """Run a command that must not fail."""
    result = run(*arguments)
    assert result.exit_code == 0, result.output


@pytest.fixture(scope="module")
def planned(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, ...]:
    """A stand with a programme, its motion and servos: the stand file, then the options."""
    folder = tmp_path_factory.mktemp("planned")
    stand, programme, servo = folder / "mine.toml", folder / "programme.json", folder / "servo.toml"
    invoked("new", "shaker2", "-o", str(stand))
    motion = str(folder / "mine_spin.motion.json")
    invoked("plan", str(stand), "--motion", motion, "-o", str(programme))
    servo.write_text(SERVO)
    return str(stand), "--programme", str(programme), "--motion", motion, "--servo", str(servo)


def sources_of(folder: Path) -> list[str]:
    """What the library of a CMake project is compiled of."""
    listed = re.search(r"^mine_library\(mine (.*)\)$", (folder / "CMakeLists.txt").read_text(), re.MULTILINE)
    assert listed is not None
    return listed[1].split()


def test_the_target_has_what_lies_in_the_folder(planned: tuple[str, ...], tmp_path: Path) -> None:
    """In one step or two, and again without the programme, which stays."""
    stand, *options = planned
    once, twice = tmp_path / "once", tmp_path / "twice"
    invoked("generate", stand, "--project", "cmake", *options, "-o", str(once))
    invoked("generate", stand, "--project", "cmake", "-o", str(twice))
    assert sources_of(twice) == ["mine.c"]
    invoked("generate", stand, "--project", "cmake", "-o", str(twice), "--check")
    invoked("generate", stand, *options, "-o", str(twice))
    written = [{path.name: path.read_bytes() for path in folder.rglob("*.*")} for folder in (once, twice)]
    assert written[0] == written[1]
    assert sources_of(once) == ["mine.c", "mine_programme.c", "mine_servo.c"]
    for more in ((), tuple(options)):
        invoked("generate", stand, "--project", "cmake", *more, "-o", str(once), "--check")
    assert "`mine_servo.c`" in (once / "README.md").read_text()


@pytest.mark.slow
def test_cmake_tests_programme_and_servos(planned: tuple[str, ...], tmp_path: Path) -> None:
    stand, *options = planned
    invoked("generate", stand, "--project", "cmake", *options, "-o", str(tmp_path / "mine"))
    assert ctest(build(tmp_path / "mine")) == 3


@pytest.mark.slow
def test_cmake_runs_an_attitude_loop(tmp_path: Path) -> None:
    invoked("generate", str(stands.path("eye4")), "--attitude", "pointing", "--project", "cmake", "-o", str(tmp_path))
    assert ctest(build(tmp_path)) == 2
    assert "eye4_attitude.c" in (tmp_path / "CMakeLists.txt").read_text()


@pytest.mark.parametrize("name", ["host", pytest.param("m4", marks=pytest.mark.slow)])
def test_a_board_links_programme_and_servos(name: str, planned: tuple[str, ...], tmp_path: Path) -> None:
    """In the element type of its FPU."""
    target(name)
    stand, *options = planned
    invoked("generate", stand, "--project", name, *options, "-o", str(tmp_path))
    (tmp_path / "main.c").write_text(
        '#include "board.h"\nint mine_selftest(void (*print)(const char *text), unsigned long sweep);\n'
        "int mine_programme_test(void (*print)(const char *text));\n"
        "int main(void) { return mine_selftest(board_print, 1uL) + mine_programme_test(board_print); }\n"
    )
    makefile = tmp_path / "Makefile"
    assert {"mine_programme.o", "mine_servo.o"} <= {*makefile.read_text().split()}
    objects = "verification/mine_programme_test.o"
    makefile.write_text(makefile.read_text().replace("OBJECTS = ", f"OBJECTS = {objects} "))
    assert call(require("make", "make"), "-s", "-C", tmp_path, "run").splitlines()[-1] == "failures 0"


@pytest.mark.parametrize("project", ["cmake", "m7"])
def test_an_untouched_project_is_as_the_stand_file_gives_it(project: str, tmp_path: Path) -> None:
    stand = str(stands.path("demo3"))
    for only in ((), ("--only", "forward")):
        folder = str(tmp_path / "-".join([project, *only]))
        invoked("generate", stand, "--project", project, *only, "-o", folder)
        invoked("generate", stand, "--project", project, "-o", folder, "--check")


@pytest.mark.parametrize(
    ("name", "project", "options"),
    [
        ("shaker2", ("--project", "simulink"), ("--fmu", "dt=1ms", "--fmu", "start=start.json")),
        ("shaker2", ("--project", "basilisk"), ("--fmu", "dt=2ms")),
        ("eye4", ("--project", "m7"), ("--attitude", "momentum=0.5", "--attitude", "rate=40")),
        ("eye4", (), ("--attitude", "pointing")),
    ],
)
def test_settings_of_blocks_and_loops_are_those_of_the_folder(
    name: str, project: tuple[str, ...], options: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The file of the start may be gone."""
    monkeypatch.chdir(tmp_path)
    Path("start.json").write_text('{"position": [0, 0, 0.01]}')
    stand = str(stands.path(name))
    invoked("generate", stand, *project, *options, "-o", "made")
    Path("start.json").unlink()
    for more in ((), project):
        invoked("generate", stand, *more, "-o", "made", "--check")
    other = ("--fmu", "dt=3ms", *project) if "--fmu" in options else ("--attitude", "momentum=0.3", *project)
    assert "is not what the generator" in refused("generate", stand, *other, "-o", "made", "--check", status=1)


@pytest.mark.parametrize(
    ("project", "more", "words"),
    [
        ("fmu", (), "--programme: not allowed with --project fmu"),
        ("simulink", (), "--programme: not allowed with --project simulink"),
        ("cmake", ("--attitude", "pointing"), "--attitude: not allowed with --programme FILE"),
    ],
)
def test_what_plays_no_programme_is_refused(
    project: str, more: tuple[str, ...], words: str, planned: tuple[str, ...], tmp_path: Path
) -> None:
    stand, *options = planned
    assert words in refused("generate", stand, "--project", project, *more, *options, "-o", str(tmp_path / "x"))


def test_a_folder_of_an_attitude_loop_takes_no_programme(planned: tuple[str, ...], tmp_path: Path) -> None:
    folder = str(tmp_path / "loop")
    invoked("generate", str(stands.path("eye4")), "--attitude", "pointing", "-o", folder)
    assert "attitude-host, which cannot play it" in refused("generate", planned[0], *planned[1:], "-o", folder)
    assert run("check", planned[0]).exit_code == 0
