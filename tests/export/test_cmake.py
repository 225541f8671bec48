"""CMake projects: the bits of a plain build."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from cli.run import BENCH8, refused, run
from mahovik.core.stand import load
from mahovik.out.export.project import cmake_project
from mahovik.stands import path
from toolchain.tools import require

IN_C = """#include <stdio.h>
#include <bench8.h>
int main(void)
{
    bench8_state x = { .attitude = { 1 } };
    double tau[BENCH8_N], V_dot[6], phi_ddot[BENCH8_N];
    const int locked[BENCH8_N] = { 0 };
    for (int i = 0; i < BENCH8_N; ++i) {
        tau[i] = 0.01 * (i + 1), x.phi[i] = 0.3 * i, x.phi_dot[i] = 90.1 - 31.7 * i;
    }
    for (int i = 0; i < 6; ++i) { x.V[i] = 0.1 * i; }
    for (int i = 0; i < 100; ++i) {
        if (bench8_step(&bench8_default, &x, tau, locked, 1e-3, 4, NULL, &x) != BENCH8_OK) { return 1; }
    }
    if (bench8_coupled(&bench8_default, &x, tau, locked, V_dot, phi_ddot) != BENCH8_OK) { return 1; }
    for (int i = 0; i < 6; ++i) { printf("%a %a\\n", V_dot[i], x.V[i]); }
    for (int i = 0; i < BENCH8_N; ++i) { printf("%a\\n", phi_ddot[i]); }
    return 0;
}
"""


PROJECT = """cmake_minimum_required(VERSION 3.15)
project(mine C)
{how}
add_executable(in_c main.c)
target_link_libraries(in_c PRIVATE mahovik::bench8)
"""


def cmake() -> str:
    """The cmake of the environment, else of the system."""
    beside = Path(sys.executable).parent / "cmake"
    return str(beside) if beside.is_file() else require("cmake", "cmake")


def call(*command: str | Path) -> str:
    """Output of a command that must not fail."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    assert "Warning" not in done.stderr
    return done.stdout


def build(folder: Path, *options: str, where: str = "build") -> Path:
    """Configures and builds a project; the folder of what was made."""
    made = folder / where
    call(cmake(), "-S", folder, "-B", made, *options)
    call(cmake(), "--build", made)
    return made


def ctest(made: Path) -> int:
    """How many tests of a build passed; none failed."""
    said = call(str(Path(cmake()).with_name("ctest")), "--test-dir", made, "--output-on-failure", "--no-tests=error")
    match = re.search(r"^100% tests passed(?:, 0 tests failed)? out of (\d+)$", said, re.MULTILINE)
    assert match is not None, said
    return int(match[1])


def user(folder: Path, how: str) -> Path:
    """A project that uses bench8."""
    folder.mkdir()
    (folder / "CMakeLists.txt").write_text(PROJECT.format(how=how))
    (folder / "main.c").write_text(IN_C)
    return folder


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The project of bench8."""
    folder = tmp_path_factory.mktemp("cmake") / "bench8"
    result = run("generate", BENCH8, "--project", "cmake", "-o", str(folder))
    assert result.exit_code == 0, result.output
    return folder


@pytest.fixture(scope="module")
def plain(exported: Path, tmp_path_factory: pytest.TempPathFactory) -> str:
    """Output of the same program, compiled with the flags of the C's header."""
    folder = tmp_path_factory.mktemp("plain")
    (folder / "main.c").write_text(IN_C)
    program = folder / "main"
    call(require("gcc", "gcc"), "-std=c99", "-O2", "-ffp-contract=off", f"-I{exported}",
         folder / "main.c", exported / "bench8.c", "-o", program)  # fmt: skip
    printed = call(program)
    assert len(set(printed.split())) == 20
    return printed


@pytest.mark.slow
def test_as_a_folder_of_a_project(exported: Path, plain: str, tmp_path: Path) -> None:
    """The C is compiled with its own flags, whatever flags the project has."""
    made = build(
        user(tmp_path / "mine", f'add_subdirectory("{exported}" bench8)'),
        "-DCMAKE_C_FLAGS=-O2 -march=native -ffast-math",
        "-G",
        "Unix Makefiles",
    )
    assert call(made / "in_c") == plain
    assert not list(made.rglob("*selftest*")), "the tests are of the top level alone"


@pytest.mark.slow
def test_installed_and_found(exported: Path, plain: str, tmp_path: Path) -> None:
    made = build(exported, "-DCMAKE_BUILD_TYPE=Release", where=str(tmp_path / "made"))
    assert ctest(made) == 1
    call(cmake(), "--install", made, "--prefix", tmp_path / "prefix")
    shutil.rmtree(made)
    mine = user(tmp_path / "mine", "find_package(bench8 0.1 CONFIG REQUIRED)")
    used = build(mine, f"-DCMAKE_PREFIX_PATH={tmp_path / 'prefix'}")
    assert call(used / "in_c") == plain
    assert str(exported) not in "".join(p.read_text() for p in (tmp_path / "prefix").rglob("*.cmake"))


@pytest.mark.slow
def test_again_and_where_it_may_not_be(exported: Path, tmp_path: Path) -> None:
    before = {path: path.read_bytes() for path in exported.rglob("*") if path.is_file()}
    assert run("generate", BENCH8, "--project", "cmake", "-o", str(exported)).exit_code == 0
    assert {path: path.read_bytes() for path in exported.rglob("*") if path.is_file()} == before
    readme = (exported / "README.md").read_text()
    assert [path.name for path in before if path.name not in readme] == ["README.md"]
    delivered = tmp_path / "bench8"
    assert run("generate", BENCH8, "-o", str(delivered)).exit_code == 0
    assert "holds what `mahovik generate` delivers" in refused(
        "generate", BENCH8, "--project", "cmake", "-o", str(delivered)
    )
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "CMakeLists.txt").write_text("project(mine)\n")
    assert "was not written by mahovik" in refused(
        "generate", BENCH8, "--project", "cmake", "-o", str(tmp_path / "mine")
    )
    assert [p.name for p in (tmp_path / "mine").iterdir()] == ["CMakeLists.txt"]


def test_a_part_under_another_name_has_no_recorder() -> None:
    """Options of `generate` are those of the project; what calls functions that are not there is left out."""
    files = cmake_project(replace(load(path("demo3")), name="fw"), "float", only=("torque",))
    assert not [name for name in files if "recorder" in name]
    assert "fw_recorder" not in files["CMakeLists.txt"] + files["README.md"]
    assert "--real float --only torque" in files["README.md"]
    assert "fw_forward(" not in files["fw.h"]
