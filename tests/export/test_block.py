"""Blocks of other simulators, run in the place of these: the motion is that of `Model.step`; wrong numbers are told."""

from __future__ import annotations

import json
import subprocess
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import mahovik
from cli.run import run as command
from mahovik import stands
from mahovik.core.stand import load
from mahovik.core.toolchain.compiler import BITS
from mahovik.out.export.fmu import with_wrench

HEADERS = Path(__file__).parent / "block"
SAMPLE, DT, SAMPLES = 0.01, 0.005, 20
TAU, WRENCH = (0.02, -0.03, 0.01), (0.5, -0.2, 0.1, 0.02, 0.03, -0.01)
START = {"position": [0.1, 0.2, -0.3], "V": [0.01, 0.0, 0.02, 0.1, -0.2, 0.3], "phi_dot": [50.0, -20.0, 5.0]}
STRICT = ("-Wall", "-Wextra", "-Werror", *BITS)


def run(program: Path, *numbers: float) -> list[str]:
    words = [str(program), *map(repr, numbers)]
    return subprocess.run(words, capture_output=True, text=True, check=True).stdout.splitlines()


def written(folder: Path, tool: str) -> list[str]:
    """The C files of a block in a folder, without its interface."""
    start = folder / "start.json"
    start.write_text(json.dumps(START))
    settings = ("--project", tool, "--fmu", f"start={start}", "--fmu", f"dt={DT}")
    done = command("generate", str(stands.path("demo3")), *settings, "-o", str(folder / tool))
    assert done.exit_code == 0, done.output
    return [str(file) for file in sorted((folder / tool).glob("*.c")) if "simulink" not in file.name]


@lru_cache
def motion() -> tuple[NDArray[np.float64], ...]:
    """Position, quaternion, V, phi, phi_dot, mass centre in E1 and its velocity at each sample, by the model."""
    model = mahovik.build(mahovik.Stand.of(with_wrench(load(stands.path("demo3")))))
    x, rows = model.states(1, **{name: [values] for name, values in START.items()}), []
    for k in range(SAMPLES + 1):
        if k:
            for _ in range(round(SAMPLE / DT)):
                x = model.step(x, DT, [TAU], wrench={"carrier": [WRENCH]})
        whole = model.momentum(x)
        state = [x.position[0], x.attitude[0], x.V[0], x.phi[0], x.phi_dot[0]]
        rows.append([*state, whole.center_of_mass[0], whole.center_of_mass_velocity[0]])
    return tuple(np.array(column) for column in zip(*rows, strict=True))


@pytest.fixture(scope="module")
def simulink(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("simulink")
    sources = written(folder, "simulink")
    address = "-fsanitize=address"  # notices a text in memory that is freed
    options = ["-std=c99", *STRICT, address, f"-I{HEADERS}", "-Wno-unused-value", "-c", "-o"]
    block: list[str | Path] = ["gcc", *options, folder / "block.o"]
    subprocess.run([*block, folder / "simulink" / "demo3_simulink.c"], check=True)
    subprocess.run(
        ["gcc", "-std=c99", *STRICT, address, *sources, folder / "block.o", "-o", folder / "run"], check=True
    )
    return folder / "run"


def test_the_block_of_simulink_moves_as_the_model_does(simulink: Path) -> None:
    rows = np.array([line.split() for line in run(simulink, SAMPLE, DT, SAMPLES, *TAU, *WRENCH)], dtype=float)
    expected = np.hstack(motion()[:5])
    expected[:, 13:16] += 2 * np.pi * np.round((rows[:, 13:16] - expected[:, 13:16]) / (2 * np.pi))  # turns counted
    assert rows == pytest.approx(expected, rel=1e-12, abs=1e-14)


def test_a_block_says_what_is_wrong(simulink: Path) -> None:
    lines = run(simulink, SAMPLE, -1.0, SAMPLES, *TAU, *WRENCH)
    assert lines == ["dt: found -1, expected 1e-09 to 10 s: set another value"]
    lines = run(simulink, SAMPLE, DT, SAMPLES, 1e300, *TAU[1:], *WRENCH)
    assert "w1.tau: found 1e+300" in lines[-1]


def test_the_module_of_basilisk_moves_as_the_model_does(tmp_path: Path) -> None:
    objects = []
    for source in written(tmp_path, "basilisk"):
        objects.append(source.removesuffix(".c") + ".o")
        subprocess.run(["gcc", "-std=c99", *STRICT, "-c", source, "-o", objects[-1]], check=True)
    names = ['-DMODULE="demo3_basilisk.h"', "-DCLASS=demo3_basilisk", f"-I{HEADERS}", f"-I{tmp_path / 'basilisk'}"]
    main = ["g++", "-std=c++17", *STRICT, *names, str(HEADERS / "run_basilisk.cpp"), *objects]
    subprocess.run([*main, "-o", tmp_path / "run"], check=True)
    few = subprocess.run(
        [*main, "-DMAX_EFF_CNT=2", "-o", tmp_path / "few"], check=False, capture_output=True, text=True
    )
    assert "demo3 has more wheels than a message of Basilisk holds" in few.stderr
    rows = np.array([line.split() for line in run(tmp_path / "run", SAMPLE, DT, SAMPLES, *TAU, *WRENCH)], dtype=float)
    position, attitude, V, phi, phi_dot, center, velocity = motion()
    C = Rotation.from_quat(attitude[:, [1, 2, 3, 0]])
    assert rows[:, :3] == pytest.approx(position, rel=1e-12, abs=1e-15)
    assert rows[:, 3:6] == pytest.approx(C.apply(V[:, :3]), rel=1e-12, abs=1e-15)
    assert rows[:, 6:9] == pytest.approx(C.as_mrp(), rel=1e-12, abs=1e-15)
    assert rows[:, 9:12] == pytest.approx(V[:, 3:], rel=1e-12, abs=1e-15)
    assert rows[:, 12:15] == pytest.approx(position + C.apply(center), rel=1e-12, abs=1e-15)
    assert rows[:, 15:18] == pytest.approx(velocity, rel=1e-12, abs=1e-15)
    assert rows[:, 19::2] == pytest.approx(phi_dot, rel=1e-12)
    assert np.cos(rows[:, 18::2] - phi) == pytest.approx(1.0, abs=1e-12)
