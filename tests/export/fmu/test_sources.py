"""The sources of an FMU: readable by strict compilers, enough to build it, unchanged headers of the standard."""

from __future__ import annotations

import subprocess
import zipfile
from pathlib import Path

import fmpy
import pytest
from fmpy.build import build_platform_binary

from export.fmu import fmus
from export.fmu.fmus import COMBINATIONS
from mahovik.core.lower.fmu.variables import Inputs, Kind
from mahovik.core.toolchain.compiler import WARNINGS
from mahovik.core.toolchain.module import STRICT
from toolchain.tools import require


def unpacked(name: str, version: str, kind: Kind, inputs: Inputs, folder: Path) -> list[Path]:
    """The sources in a folder; those that are compiled, but for the stand's own C, which others test."""
    with zipfile.ZipFile(fmus.path(name, version, kind, inputs, binary=False)) as file:
        file.extractall(folder)
    return sorted(p for p in (folder / "sources").glob("*.c") if p.name != f"{name}.c")


def compile_strictly(command: list[str], sources: list[Path]) -> None:
    """No warning, of any."""
    require(command[0], command[0])
    flags = [*WARNINGS, *STRICT, "-fsyntax-only"]
    done = subprocess.run([*command, *flags, *map(str, sources)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[:2000]


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize(
    ("version", "kind", "inputs"), [COMBINATIONS[1], COMBINATIONS[2], COMBINATIONS[4], COMBINATIONS[7]]
)
def test_no_warning(version: str, kind: Kind, inputs: Inputs, compiler: str, tmp_path: Path) -> None:
    compile_strictly([compiler], unpacked("driven", version, kind, inputs, tmp_path))


@pytest.mark.slow
@pytest.mark.parametrize(("version", "kind"), [("2.0", "cs"), ("3.0", "me")])
def test_sources_alone_are_enough(version: str, kind: Kind, tmp_path: Path) -> None:
    """fmpy builds the binary from description and sources, and it moves as ours does."""
    unpacked("driven", version, kind, "torque", tmp_path)
    (tmp_path / "build").mkdir()
    build_platform_binary(tmp_path, tmp_path / "build")
    seen = ["carrier.position[3]", "w1.phi", "energy"]
    given = {"stop_time": 0.02, "output_interval": 0.01, "output": seen, "start_values": {"w1.phi_dot": 30.0}}
    theirs = fmpy.simulate_fmu(str(tmp_path), **given)
    ours = fmpy.simulate_fmu(fmus.path("driven", version, kind, "torque"), **given)
    assert theirs.tolist() == ours.tolist()
