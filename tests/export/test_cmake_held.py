"""The CMake project of a held carrier: it builds, and its example begins in the home pose with an allowed twist."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cli.run import run
from export.test_cmake import build, call, ctest
from mahovik.core.stand import load
from mahovik.core.stand.hold import twist_of
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.use.simulate.held import home
from toolchain.quick import quick
from toolchain.tools import require

HEAD = """schema = 1
name = "arm"
gravity = [0, 0, -9.81]

[carrier]
mass = 2.0
inertia = [0.02, 0.03, 0.04]
inertia_about = "center_of_mass"
center_of_mass = [0.02, 0, 0.05]

[[flywheel]]
name = "w1"
mass = 0.4
inertia = [[2e-3, 1e-5, 0], [1e-5, 1.1e-3, 0], [0, 0, 1.2e-3]]
inertia_about = "center_of_mass"
center_of_mass = [0, 1e-3, 0]
position = [0.1, 0, 0]

[hold]
position = [0.1, 0.2, 0.3]
angles = ["30 deg", 0.1, "-20 deg"]
"""
HOLDS = {
    "hinge": "axis = [1, -2, 0.5]\npivot = [0.1, 0, 0.2]",
    "screw": "basis = [[0, 0.2, 0.01, 0.3, 0, 1]]",
    "ball joint": 'freedoms = ["roll", "pitch", "yaw"]',
    "clamped": "freedoms = []",
}


def project(name: str, folder: Path, *options: str) -> Path:
    """The stand file of a hold; its project is in `folder`/arm."""
    folder.mkdir(exist_ok=True)
    (folder / "arm.toml").write_text(HEAD + HOLDS[name])
    result = run("export", "cmake", str(folder / "arm.toml"), "-o", str(folder / "arm"), *options)
    assert result.exit_code == 0, result.output
    return folder / "arm.toml"


def expected(file: Path) -> list[float]:
    """V_dot at the state of the example, by the reference: w1 at 100 rad/s, u = 1 of the first freedom."""
    stand = load(str(file))
    assert stand.hold is not None
    u = tuple(float(k == 0) for k in range(len(stand.hold.freedoms)))
    state = replace(home(stand), u=u, V=twist_of(stand.hold, u), phi_dot=(100.0,))
    return list(np.array(NumpyBackend(stand).evaluate(state, ["forward"])["V_dot"]))


@pytest.mark.parametrize("name", quick(1, ["screw", "hinge", "ball joint", "clamped"]))
def test_the_example_answers_what_the_reference_does(name: str, tmp_path: Path) -> None:
    file = project(name, tmp_path)
    folder, program = tmp_path / "arm", tmp_path / "example"
    call(
        require("gcc", "gcc"), "-std=c99", "-ffp-contract=off", "-O0", "-c", folder / "arm.c", "-o", tmp_path / "arm.o"
    )
    call(require("g++", "g++"), "-std=c++17", "-Wall", "-Wextra", "-Werror",
         folder / "example.cpp", tmp_path / "arm.o", "-o", program)  # fmt: skip
    found = [float(x) for x in call(program).split()]
    assert found == pytest.approx(expected(file), rel=6e-9, abs=1e-11)  # nine digits: off by up to 5e-9
    assert any(found) == (name != "clamped")


@pytest.mark.slow
@pytest.mark.parametrize("name", HOLDS)
def test_it_builds_and_its_tests_pass(name: str, tmp_path: Path) -> None:
    """With float elements, with batches, and from a folder of another project."""
    require("gcc", "gcc")
    project(name, tmp_path)
    assert ctest(build(tmp_path / "arm", where=str(tmp_path / "made"))) == 2
    project(name, tmp_path / "other", "--real", "float", "--batch")
    (tmp_path / "other" / "CMakeLists.txt").write_text("""cmake_minimum_required(VERSION 3.15)
project(mine C)
add_subdirectory(arm)
add_executable(main main.c)
target_link_libraries(main PRIVATE mahovik::arm_batch)
""")
    (tmp_path / "other" / "main.c").write_text("""#include "arm_batch.h"
int main(void) { return sizeof(arm_real) == 4 ? arm_wrap(7, &(arm_real){ 0 }) : 1; }
""")
    call(build(tmp_path / "other") / "main")
