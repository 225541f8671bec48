"""The description of an FMU, judged by fmpy and compared with the stand file."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from xml.etree import ElementTree

import fmpy
import pytest

from export.fmu import fmus
from export.fmu.fmus import COMBINATIONS
from mahovik.core.lower import units
from mahovik.core.lower.fmu.variables import Inputs, Kind
from mahovik.core.stand.state import rest_state
from mahovik.laws.suspension.data import Suspension
from mahovik.out.export.fmu import export_fmu

QUICK = [("bench8", *COMBINATIONS[4]), ("driven", *COMBINATIONS[2]), ("driven", *COMBINATIONS[5])]
QUICK += [("rigid", *COMBINATIONS[2])]
NAME = re.compile(r"(der\()?[A-Za-z_]\w*(\[\d+(,\d)?\])?(\.[A-Za-z_]\w*(\[\d(,\d)?\])?)*\)?")


@pytest.mark.parametrize(("name", "version", "kind", "inputs"), QUICK)
def test_the_checker_finds_nothing_but_for_names(name: str, version: str, kind: Kind, inputs: Inputs) -> None:
    """Schema, structure, start values, causalities, units; names by a pattern, as the checker's grammar is slow."""
    file = fmus.path(name, version, kind, inputs, binary=False)
    read = fmpy.read_model_description(file, validate=True, validate_model_structure=True)
    assert all(NAME.fullmatch(v.name) for v in read.modelVariables)
    assert read.variableNamingConvention == "structured"


def test_start_values_are_those_of_the_stand() -> None:
    found = fmus.stand("bench8")
    read = fmpy.read_model_description(fmus.path("bench8", "3.0", "cs", "torque", binary=False))
    variables = {v.name: v for v in read.modelVariables}
    assert float(variables["carrier.mass"].start) == found.carrier.mass
    assert [float(variables[f"gravity[{i}]"].start) for i in (1, 2, 3)] == list(found.gravity)
    w3 = found.flywheels[2]
    assert float(variables["w3.mass"].start) == w3.mass
    assert [float(variables[f"w3.center_of_mass[{i}]"].start) for i in (1, 2, 3)] == list(w3.center_of_mass)
    held = found.law(Suspension)
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
        text = fmus.fmu_of(name, "2.0", "me", "torque", binary=False).files["modelDescription.xml"]
        for unit in ElementTree.fromstring(text).iterfind("UnitDefinitions/Unit"):
            above, _, below = unit.attrib["name"].partition("/")
            expected = powers(above, 1)
            if below:
                expected = [a + b for a, b in zip(expected, powers(below, -1), strict=True)]
            exponents = unit.find("BaseUnit")
            assert exponents is not None
            found = [int(exponents.attrib.get(b, 0)) for b in ("kg", "m", "s", "rad", "A")]
            assert found == expected, unit.attrib["name"]
            seen.add(unit.attrib["name"])
            for display in unit.iterfind("DisplayUnit"):
                factors = {"deg": 180 / math.pi, "rpm": 30 / math.pi, "mm": 1e3, "g": 1e3}
                factor = factors[display.attrib["name"].partition("/")[0]]
                assert float(display.attrib["factor"]) == pytest.approx(factor, rel=1e-15)
    assert {"N.m", "kg.m2", "N.s2/rad2", "rad/s2"} <= seen
    assert units.law(5, (1, 5)).name == "N.s2/rad"
    assert units.law(1, (0, 5)).name == "N.s2/(m.rad)"


def test_bytes_are_the_same_twice_and_tell_stands_apart() -> None:
    found, made = fmus.stand("rigid"), fmus.generated("rigid")
    first, again = (
        export_fmu(found, "3.0", "cs", start=rest_state(found), binary=False, generated=made) for _ in range(2)
    )
    assert first.content == again.content
    assert not re.search(
        rb"20\d\d-\d\d-\d\d", b"".join(str(x).encode() for n, x in first.files.items() if "fmi3" not in n)
    )
    other = replace(found, gravity=(0.0, 0.0, -1.62))
    moon = export_fmu(other, "3.0", "cs", start=rest_state(other), binary=False)
    assert moon.lines[0] != first.lines[0]
