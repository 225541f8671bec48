"""The file of an FMU: its description, judged by fmpy and the stand file, its sources, and its command."""

from __future__ import annotations

import json
import math
import re
import subprocess
import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import fmpy
import pytest
from fmpy.build import build_platform_binary

from cli.run import DEMO3, refused, run
from export.fmu import fmus
from export.fmu.fmus import COMBINATIONS
from mahovik import stands
from mahovik.core.lower import units
from mahovik.core.lower.fmu_variables import Inputs, Kind
from mahovik.core.stand.model import rest_state
from mahovik.core.toolchain.compiler import STRICT, WARNINGS
from mahovik.laws.suspension.law import Suspension
from mahovik.out.export.fmu import export_fmu
from toolchain.quick import quick
from toolchain.tools import require

DRY = ("generate", DEMO3, "--project", "fmu", "--fmu", "binary=no")


def test_file_and_what_is_said(tmp_path: Path) -> None:
    (tmp_path / "S.json").write_text(json.dumps({"position": [0, 0, 0.5], "phi_dot": [10, 20, -30]}))
    target = tmp_path / "new" / "demo.fmu"
    values = (f"start={tmp_path / 'S.json'}", "dt=0.002")
    settings = [word for one in values for word in ("--fmu", one)]
    result = run(*DRY, *settings, "-o", str(target))
    assert result.exit_code == 0, result.output
    lines = result.stdout.splitlines()
    token = next(line for line in lines if line.startswith("FMI 2.0, co-simulation; {"))
    assert str(target) in result.stdout and lines[-1] == "no binary, only sources"
    with zipfile.ZipFile(target) as file:
        assert file.testzip() is None
        names = file.namelist()
    assert names[0] == "modelDescription.xml"
    assert {"sources/demo3.c", "sources/demo3_model.c"} <= set(names)
    read = fmpy.read_model_description(str(target))
    starts = {v.name: v.start for v in read.modelVariables}
    wheels = [v for v in starts if v.endswith(".phi_dot")]
    assert [float(starts[w]) for w in wheels] == [10.0, 20.0, -30.0]
    assert (float(starts["carrier.position[3]"]), float(starts["dt"])) == (0.5, 0.002)
    assert read.guid in token


@pytest.mark.parametrize(
    ("arguments", "status", "expected"),
    [
        ((*DRY, "--fmu", "dt=0"), 2, "--fmu dt 0: out of range, expected 1e-09 to 10 s"),
        ((*DRY, "--fmu", "dt=20 s"), 2, "--fmu dt 20 s: out of range, expected 1e-09 to 10 s"),
        ((*DRY, "--fmu", "kind=me", "--fmu", "dt=0.001"), 2, "--fmu dt: model exchange has no internal step"),
        ((*DRY, "--fmu", "start=none.json"), 2, "none.json: no such file"),
        ((*DRY, "--fmu", "version=2.0"), 2, 'unknown "version"'),
        (("generate", "none.toml", "--project", "fmu"), 2, "none.toml"),
        (("generate", str(stands.path("remus6")), *DRY[2:]), 1, "give an initial state by --fmu start=STATE.json"),
    ],
)
def test_refusals(
    arguments: tuple[str, ...], status: int, expected: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert expected in refused(*arguments, status=status)
    assert list(tmp_path.iterdir()) == []


CHECKED = [("rigid", *COMBINATIONS[2]), ("driven", *COMBINATIONS[1])]
CHECKED += [("driven", *COMBINATIONS[2]), ("bench8", *COMBINATIONS[0])]
NAME = re.compile(r"(der\()?[A-Za-z_]\w*(\[\d+(,\d)?\])?(\.[A-Za-z_]\w*(\[\d(,\d)?\])?)*\)?")


@pytest.mark.parametrize(("name", "kind", "inputs"), quick(2, CHECKED))
def test_the_checker_finds_nothing_but_for_names(name: str, kind: Kind, inputs: Inputs) -> None:
    """Schema, structure, start values, causalities, units; names by a pattern, as the checker's grammar is slow."""
    file = fmus.path(name, kind, inputs, binary=False)
    read = fmpy.read_model_description(file, validate=True, validate_model_structure=True)
    assert all(NAME.fullmatch(v.name) for v in read.modelVariables)
    assert read.variableNamingConvention == "structured"


def test_start_values_are_those_of_the_stand() -> None:
    stand = fmus.stand("bench8")
    read = fmpy.read_model_description(fmus.path("bench8", "cs", "torque", binary=False))
    variables = {v.name: v for v in read.modelVariables}
    assert float(variables["carrier.mass"].start) == stand.carrier.mass
    assert [float(variables[f"gravity[{i}]"].start) for i in (1, 2, 3)] == list(stand.gravity)
    w3 = stand.flywheels[2]
    assert float(variables["w3.mass"].start) == w3.mass
    assert [float(variables[f"w3.center_of_mass[{i}]"].start) for i in (1, 2, 3)] == list(w3.center_of_mass)
    held = stand.law(Suspension)
    assert held is not None
    assert float(variables["suspension.stiffness[4,4]"].start) == held.stiffness[3][3]
    for name in ("carrier.mass", "w3.position[2]", "suspension.damping[1,1]"):
        assert (variables[name].causality, variables[name].variability) == ("parameter", "tunable")
    assert variables["w3.tau"].causality == "input"
    assert float(variables["carrier.attitude[1]"].start) == pytest.approx(1.0, abs=1e-3)  # of the equilibrium


def test_units_are_what_their_exponents_say() -> None:
    """Names of units are products of powers: each is multiplied out on its own."""
    base = {"kg": (1, 0, 0, 0, 0), "m": (0, 1, 0, 0, 0), "s": (0, 0, 1, 0, 0), "rad": (0, 0, 0, 1, 0)}
    base |= {"A": (0, 0, 0, 0, 1), "N": (1, 1, -2, 0, 0), "J": (1, 2, -2, 0, 0), "T": (1, 0, -2, 0, -1)}
    base |= {"1": (0, 0, 0, 0, 0)}

    def powers(text: str, sign: int) -> list[int]:
        total = [0, 0, 0, 0, 0]
        for part in text.strip("()").split("."):
            matched = re.fullmatch(r"([A-Za-z]+|1)(\d?)", part)
            assert matched, text
            count = sign * int(matched[2] or 1)
            total = [t + count * b for t, b in zip(total, base[matched[1]], strict=True)]
        return total

    seen = set()
    for name in ("driven", "rigid"):
        text = fmus.fmu_of(name, "me", "torque", binary=False).files["modelDescription.xml"]
        for unit in ElementTree.fromstring(text).iterfind("UnitDefinitions/Unit"):
            above, _, below = unit.attrib["name"].partition("/")
            expected = powers(above, 1)
            if below:
                expected = [a + b for a, b in zip(expected, powers(below, -1), strict=True)]
            exponents = unit.find("BaseUnit")
            assert exponents is not None
            listed = [int(exponents.attrib.get(b, 0)) for b in ("kg", "m", "s", "rad", "A")]
            assert listed == expected, unit.attrib["name"]
            seen.add(unit.attrib["name"])
            for display in unit.iterfind("DisplayUnit"):
                factors = {"deg": 180 / math.pi, "rpm": 30 / math.pi, "mm": 1e3, "g": 1e3}
                factor = factors[display.attrib["name"].partition("/")[0]]
                assert float(display.attrib["factor"]) == pytest.approx(factor, rel=1e-15)
    assert {"N.m", "kg.m2", "N.s2/rad2", "rad/s2"} <= seen
    assert units.law(5, (1, 5)).name == "N.s2/rad"
    assert units.law(1, (0, 5)).name == "N.s2/(m.rad)"


def test_bytes_are_the_same_twice_and_tell_stands_apart() -> None:
    stand, made = fmus.stand("rigid"), fmus.generated("rigid")
    first, again = (export_fmu(stand, "cs", start=rest_state(stand), binary=False, generated=made) for _ in range(2))
    assert first.content == again.content
    assert not re.search(
        rb"20\d\d-\d\d-\d\d", b"".join(str(x).encode() for n, x in first.files.items() if "fmi2" not in n)
    )
    other = replace(stand, gravity=(0.0, 0.0, -1.62))
    moon = export_fmu(other, "cs", start=rest_state(other), binary=False)
    assert moon.lines[0] != first.lines[0]


def unpacked(name: str, kind: Kind, inputs: Inputs, folder: Path) -> list[Path]:
    """The sources in a folder; those that are compiled, but for the stand's own C, which others test."""
    with zipfile.ZipFile(fmus.path(name, kind, inputs, binary=False)) as file:
        file.extractall(folder)
    return sorted(p for p in (folder / "sources").glob("*.c") if p.name != f"{name}.c")


def compile_strictly(command: list[str], sources: list[Path]) -> None:
    """No warning, of any."""
    require(command[0], command[0])
    flags = [*WARNINGS, *STRICT, "-fsyntax-only"]
    done = subprocess.run([*command, *flags, *map(str, sources)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[:2000]


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize(("kind", "inputs"), [COMBINATIONS[1], COMBINATIONS[2]])
def test_no_warning(kind: Kind, inputs: Inputs, compiler: str, tmp_path: Path) -> None:
    compile_strictly([compiler], unpacked("driven", kind, inputs, tmp_path))


@pytest.mark.slow
@pytest.mark.parametrize("kind", fmus.KINDS)
def test_sources_alone_are_enough(kind: Kind, tmp_path: Path) -> None:
    """fmpy builds the binary from description and sources, and it moves as ours does."""
    unpacked("driven", kind, "torque", tmp_path)
    (tmp_path / "build").mkdir()
    build_platform_binary(tmp_path, tmp_path / "build")
    seen = ["carrier.position[3]", "w1.phi", "energy"]
    options = {"stop_time": 0.02, "output_interval": 0.01, "output": seen, "start_values": {"w1.phi_dot": 30.0}}
    theirs = fmpy.simulate_fmu(str(tmp_path), **options)
    ours = fmpy.simulate_fmu(fmus.path("driven", kind, "torque"), **options)
    assert theirs.tolist() == ours.tolist()
