"""The CMake project: used as a folder and installed, from C and from C++, with the bits of a plain build."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from cli.run import AUV6, BENCH8, DEMO3, refused, run
from mahovik.core.stand import load
from mahovik.out.export.cmake import cmake_project
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
        if (bench8_step(&bench8_default, &x, tau, locked, 1e-3, 4, &x) != BENCH8_OK) { return 1; }
    }
    if (bench8_coupled(&bench8_default, &x, tau, locked, V_dot, phi_ddot) != BENCH8_OK) { return 1; }
    for (int i = 0; i < 6; ++i) { printf("%a %a\\n", V_dot[i], x.V[i]); }
    for (int i = 0; i < BENCH8_N; ++i) { printf("%a\\n", phi_ddot[i]); }
    return 0;
}
"""

IN_CPP = """#include <bench8.hpp>
#include <cstdio>
namespace stand = mahovik::bench8;
int main()
{
    stand::State x;
    stand::Reals<stand::N> tau{}, phi_ddot{};
    stand::Reals<6> V_dot{};
    const stand::Ints<stand::N> locked{};
    for (std::size_t i = 0; i < stand::N; ++i) {
        const double k = static_cast<double>(i);
        tau[i] = 0.01 * (k + 1), x.phi[i] = 0.3 * k, x.phi_dot[i] = 90.1 - 31.7 * k;
    }
    for (int i = 0; i < 6; ++i) { x.V[i] = 0.1 * i; }
    for (int i = 0; i < 100; ++i) {
        if (stand::step(stand::default_table, x, tau, locked, 1e-3, 4, x) != stand::Status::ok) { return 1; }
    }
    if (stand::coupled(stand::default_table, x, tau, locked, V_dot, phi_ddot) != stand::Status::ok) { return 1; }
    for (std::size_t i = 0; i < 6; ++i) { std::printf("%a %a\\n", V_dot[i], x.V[i]); }
    for (const double each : phi_ddot) { std::printf("%a\\n", each); }
    return 0;
}
"""

PROJECT = """cmake_minimum_required(VERSION 3.15)
project(mine C CXX)
{how}
add_executable(in_c main.c)
target_link_libraries(in_c PRIVATE mahovik::bench8)
add_executable(in_cpp main.cpp)
target_compile_features(in_cpp PRIVATE cxx_std_17)
target_link_libraries(in_cpp PRIVATE mahovik::bench8)
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
    found = re.search(r"^100% tests passed(?:, 0 tests failed)? out of (\d+)$", said, re.MULTILINE)
    assert found is not None, said
    return int(found[1])


def user(folder: Path, how: str) -> Path:
    """A project that uses bench8 from C and from C++."""
    folder.mkdir()
    (folder / "CMakeLists.txt").write_text(PROJECT.format(how=how))
    (folder / "main.c").write_text(IN_C)
    (folder / "main.cpp").write_text(IN_CPP)
    return folder


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The project of bench8."""
    folder = tmp_path_factory.mktemp("cmake") / "bench8"
    result = run("export", "cmake", BENCH8, "-o", str(folder))
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
@pytest.mark.parametrize("flags", ["-O2 -march=native -ffast-math", ""])
def test_as_a_folder_of_a_project(exported: Path, plain: str, flags: str, tmp_path: Path) -> None:
    """The C is compiled with its own flags, independent of those of the project."""
    made = build(
        user(tmp_path / "mine", f'add_subdirectory("{exported}" bench8)'),
        f"-DCMAKE_C_FLAGS={flags}",
        "-G",
        "Unix Makefiles",
    )
    assert call(made / "in_c") == plain
    assert call(made / "in_cpp") == plain
    assert not list(made.rglob("*selftest*")), "the tests are of the top level alone"


@pytest.mark.slow
def test_installed_and_found(exported: Path, plain: str, tmp_path: Path) -> None:
    made = build(exported, "-DCMAKE_BUILD_TYPE=Release", where=str(tmp_path / "made"))
    assert ctest(made) == 2
    call(cmake(), "--install", made, "--prefix", tmp_path / "prefix")
    shutil.rmtree(made)
    mine = user(tmp_path / "mine", "find_package(bench8 0.1 CONFIG REQUIRED)")
    used = build(mine, f"-DCMAKE_PREFIX_PATH={tmp_path / 'prefix'}")
    assert call(used / "in_c") == plain
    assert call(used / "in_cpp") == plain
    assert str(exported) not in "".join(p.read_text() for p in (tmp_path / "prefix").rglob("*.cmake"))


@pytest.mark.slow
def test_batches_floats_and_two_stands_in_one_project(tmp_path: Path) -> None:
    """Also with clang and shared libraries."""
    clang, other = require("clang", "clang"), require("clang++", "clang")
    for stand_file, *options in ((DEMO3, "--batch"), (AUV6, "--real", "float")):
        name = Path(stand_file).stem
        result = run("export", "cmake", stand_file, "-o", str(tmp_path / name), *options)
        assert result.exit_code == 0, result.output
    (tmp_path / "CMakeLists.txt").write_text("""cmake_minimum_required(VERSION 3.15)
project(both C)
add_subdirectory(demo3)
add_subdirectory(auv6)
enable_testing()
add_executable(both both.c)
target_link_libraries(both PRIVATE mahovik::demo3_batch mahovik::auv6)
""")
    (tmp_path / "both.c").write_text("""#include "auv6.h"
#include "demo3_batch.h"
int main(void) { return sizeof(auv6_real) == 4 && sizeof(demo3_real) == 8 ? demo3_wrap(7, &(demo3_real){ 0 }) : 1; }
""")
    tests = ("-DDEMO3_TESTS=ON", "-DAUV6_TESTS=ON", "-DDEMO3_EXAMPLE=ON", "-DAUV6_EXAMPLE=ON")
    made = build(
        tmp_path, *tests, "-DBUILD_SHARED_LIBS=ON", f"-DCMAKE_C_COMPILER={clang}", f"-DCMAKE_CXX_COMPILER={other}"
    )
    call(made / "both")
    assert ctest(made) == 4


@pytest.mark.slow
def test_threads_of_batches_are_found_with_the_package(tmp_path: Path) -> None:
    folder = tmp_path / "demo3"
    assert run("export", "cmake", DEMO3, "-o", str(folder), "--batch").exit_code == 0
    made = build(
        folder,
        "-DDEMO3_OPENMP=ON",
        "-DDEMO3_TESTS=OFF",
        "-DDEMO3_EXAMPLE=OFF",
        f"-DCMAKE_C_COMPILER={require('gcc', 'gcc')}",
    )
    call(cmake(), "--install", made, "--prefix", tmp_path / "prefix")
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "CMakeLists.txt").write_text("""cmake_minimum_required(VERSION 3.15)
project(mine C)
find_package(demo3 CONFIG REQUIRED)
add_executable(main main.c)
target_link_libraries(main PRIVATE mahovik::demo3_batch)
""")
    (mine / "main.c").write_text("""#include "demo3_batch.h"
int main(void)
{
    demo3_real x[13 + 2 * DEMO3_N] = { 0 }, phi_ddot[DEMO3_N] = { 0 }, V_dot[6];
    demo3_status status[1];
    x[3] = 1;
    return demo3_forward_batch(&demo3_default, 1, x, phi_ddot, V_dot, status);
}
""")
    call(build(mine, f"-DCMAKE_PREFIX_PATH={tmp_path / 'prefix'}", "-DCMAKE_C_COMPILER=gcc") / "main")


@pytest.mark.slow
def test_cross_compiled(exported: Path, tmp_path: Path) -> None:
    """For a Cortex-M7: no C++ compiler of this machine is asked."""
    require("arm-none-eabi-gcc", "gcc-arm-none-eabi")
    chain = tmp_path / "m7.cmake"
    chain.write_text("""set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_C_FLAGS_INIT "-mcpu=cortex-m7 -mfpu=fpv5-d16 -mfloat-abi=hard --specs=nosys.specs")
""")
    made = build(exported, f"-DCMAKE_TOOLCHAIN_FILE={chain}", where=str(tmp_path / "made"))
    image = (made / "libmahovik_bench8.a").read_bytes()
    assert b"bench8_forward" in image
    assert not (made / "mahovik_bench8_example").exists()


@pytest.mark.slow
def test_without_a_compiler_for_cpp(exported: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Firmware has C alone: the example is left out, nothing fails."""
    monkeypatch.setenv("CXX", "no-such-compiler")
    assert ctest(build(exported, where=str(tmp_path / "made"))) == 1


@pytest.mark.slow
def test_again_and_where_it_may_not_be(exported: Path, tmp_path: Path) -> None:
    before = {path: path.read_bytes() for path in exported.iterdir()}
    assert run("export", "cmake", BENCH8, "-o", str(exported)).exit_code == 0
    assert {path: path.read_bytes() for path in exported.iterdir()} == before
    readme = (exported / "README.md").read_text()
    assert [name for name in (p.name for p in before if p.is_file()) if name not in readme] == ["README.md"]
    delivered = tmp_path / "bench8"
    assert run("generate", BENCH8, "-o", str(delivered)).exit_code == 0
    assert "holds what `mahovik generate` delivers" in refused("export", "cmake", BENCH8, "-o", str(delivered))
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "CMakeLists.txt").write_text("project(mine)\n")
    assert "was not written by mahovik" in refused("export", "cmake", BENCH8, "-o", str(tmp_path / "mine"))
    assert [p.name for p in (tmp_path / "mine").iterdir()] == ["CMakeLists.txt"]


def test_a_part_under_another_name_has_neither_recorder_nor_example() -> None:
    """Options of `generate` are those of the project; what calls functions that are not there is left out."""
    files = cmake_project(replace(load(path("demo3")), name="fw"), "float", only=("torque",))
    assert not [name for name in files if "recorder" in name or "example" in name]
    assert "fw_recorder" not in files["CMakeLists.txt"] + files["README.md"]
    assert "fw_example" not in files["CMakeLists.txt"]
    assert "--real float --only torque" in files["README.md"]
    assert "fw_forward(" not in files["fw.h"]
