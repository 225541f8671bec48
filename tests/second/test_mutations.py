"""Every deliberate mistake in the second derivation is seen by the comparison with the reference."""

import importlib
import shutil
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import mahovik.proof.second
from mahovik.contract import laws
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import EVERYTHING, SEQUENCES, random_stand
from mahovik.core.stand.state import State
from mahovik.proof.second import force
from mahovik.proof.verify.draw import draw
from second.agreement import AGREEMENT, differences, expectations
from toolchain.quick import quick

SOURCE = Path(mahovik.proof.second.__file__).parent

# file, what is there once, what is put in its place
MUTATIONS = {
    "rotation to the first order only": ("chart", " + cross(xi) @ cross(xi) / 2", ""),
    "components of V* taken as an acceleration": ("chart", "V_dot[:3] + rate(V[:3], V[3:])", "V_dot[:3]"),
    "rate along q'' only": ("chart", "self.rate(expression) + directional_derivative(", "directional_derivative("),
    "angular velocity doubled": ("chart", "S[1, 0] - S[0, 1]) / 2", "S[1, 0] - S[0, 1])"),
    "dT/dq left out": ("lagrange", " - ca.gradient(T, chart.q)", ""),
    "parallel axes the wrong way": ("bodies", "J - body.mass *", "J + body.mass *"),
    "inertia about the centre taken as about the origin": ("bodies", "== \"center_of_mass\"", "!= \"center_of_mass\""),
    "flywheel on an instrument placed on the carrier": ("bodies", "found[s.mount]", "found['carrier']"),
    "mounting the other way round": ("bodies", "axes, 3, 3) @ ele", "axes, 3, 3).T @ ele"),
    "phi the other way": ("rotation", "1: ((1, 0, 0), (0, c, -s), (0, s, c))", "1: ((1, 0, 0), (0, c, s), (0, -s, c))"),
    "aircraft sequence as ship": ("rotation", '"aircraft": (2, 3, 1)', '"aircraft": (3, 2, 1)'),
    "stream the other way": ("lagrange", "chart.q_dot[:3] - stream", "chart.q_dot[:3] + stream"),
    "energy of rotation left out": ("lagrange", " + ca.dot(omega, body.central_inertia @ omega) / 2", ""),
    "buoyancy pulls down": ("laws.buoyancy", "return displaced_mass *", "return -displaced_mass *"),
    "weight at the origin": ("laws.weight", "body.place(body.center_of_mass)", "body.place(ca.SX.zeros(3))"),
    "damping relative to E0": ("force", "ca.SX.zeros(3))) - stream", "ca.SX.zeros(3)))"),
    "legs without damping": ("laws.leg", " - ca.gradient(rayleigh, chart.q_dot)", ""),
    "legs push where they should pull": ("laws.leg", "here(-ca.gradient(potential", "here(ca.gradient(potential"),
    "quadratic damping without sign": ("laws.damping", "(V_r * ca.fabs(V_r))", "(V_r * V_r)"),
    "damping term with one factor": ("laws.damping", "term.value * first * second", "term.value * first"),
    "suspension turned from E1 to E0": (
        "laws.suspension", "vector(equilibrium.T @ C)]", "vector(C.T @ equilibrium)]",
    ),
    "suspension away in E0": ("laws.suspension", "C.T @ away", "away"),
    "added mass without inertia": ("system", "Z + fluid_Z, K + self.Lambda", "Z + fluid_Z, K"),
    "drive torque the other way": ("problems", "applied + drive - still", "applied - drive - still"),
    "moment of momentum about O1": ("problems", "motion[:3] + ca.cross(motion[3:], r)", "motion[:3]"),
    "gravity added to what an accelerometer reads": ("points", "(acceleration - gravity)", "(acceleration + gravity)"),
    "D without the motion": ("kinematics", "(angles, q_dot)[1]", "(angles, 0 * q_dot)[1]"),
}  # fmt: skip


@cache
def cases() -> list[tuple[Stand, State, Any]]:
    """Stands of every sequence with every kind of wrench, states of them, and what the reference gives there."""
    found = []
    for seed, angles in enumerate(SEQUENCES):
        stand = random_stand(np.random.default_rng(seed), 3, replace(EVERYTHING, angles=angles))
        _, state = draw(stand, seed, 2)[1]
        state = replace(state, quaternion=None, angles=(0.3, 0.7, -0.2))
        found.append((stand, state, expectations(stand, state)))
    return found


def worst(package: ModuleType) -> float:
    """Largest difference of a package's Second to the reference; infinite where a result is missing."""
    return max(
        off
        for stand, state, expected in cases()
        for off in differences(package.Second(stand).evaluate, state, expected).values()
    )


def with_one_changed(law: str, there: str, instead: str) -> Callable[[str, str], ModuleType | None]:
    """`laws.part` with the second derivation of one law changed."""
    original = laws.part
    text = Path(original(law, "second").__file__).read_text(encoding="utf-8")
    assert text.count(there) == 1, f"{there!r} is not there once"
    changed = ModuleType("changed")
    exec(compile(text.replace(there, instead), "changed", "exec"), vars(changed))
    return lambda each, name: changed if (each, name) == (law, "second") else original(each, name)


def test_without_a_mutation_there_is_no_difference() -> None:
    assert worst(mahovik.proof.second) <= AGREEMENT


@pytest.mark.parametrize("name", quick(6, MUTATIONS))
def test_mutations_are_noticed(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    module, there, instead = MUTATIONS[name]
    if module.startswith("laws."):
        monkeypatch.setattr(laws, "part", with_one_changed(module.removeprefix("laws."), there, instead))
        monkeypatch.setattr(force, "body_force", force.body_force.__wrapped__)  # not the one that is kept
        assert worst(mahovik.proof.second) > 1e-6
        return
    package = "mutated_" + "".join(c if c.isalnum() else "_" for c in name)
    shutil.copytree(SOURCE, tmp_path / package, ignore=shutil.ignore_patterns("__pycache__"))
    for path in (tmp_path / package).glob("*.py"):
        text = path.read_text(encoding="utf-8").replace("mahovik.proof.second", package)
        if path.stem == module:
            assert text.count(there) == 1, f"{there!r} is not there once"
            text = text.replace(there, instead)
        path.write_text(text, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    try:
        assert worst(importlib.import_module(package)) > 1e-6
    finally:
        for loaded in [m for m in sys.modules if m.split(".")[0] == package]:
            del sys.modules[loaded]
