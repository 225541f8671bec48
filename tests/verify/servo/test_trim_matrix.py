"""The matrix of a trim is judged from its definition: wrong numbers of the C, wrong constants of the design, fail."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

import mahovik.use.control.trim as design_module
from export.programmes import motion, spin, stand
from export.servos import HEAD
from mahovik.core.motion.programme import Fourier
from mahovik.core.motion.required import read_motion
from mahovik.core.motion.servo import Trim, read_servo
from mahovik.core.stand import loads
from mahovik.proof.verify.servo.tables import MATRIX
from mahovik.proof.verify.servo.trim_matrix import trim_matrix
from mahovik.use.control.trim import design_trim
from toolchain.quick import quick
from verify.programme.programmes import Case, programme_of

TILTED = """
schema = 1
name = "tilted"
[carrier]
mass = 5.0
center_of_mass = [0.02, -0.01, 0.03]
inertia = [0.05, 0.06, 0.07]
inertia_about = "center_of_mass"
[suspension]
stiffness = [400, 300, 500, 20, 25, 15]
damping = [4, 5, 6, 0.2, 0.3, 0.4]
"""


@cache
def tilted() -> Case:
    """A carrier at rest with three balanced wheels about axes of their own, whose constant speeds do not move it."""
    wheel = (
        "mass = 0.5\nposition = [0, {0}, 0.1]\naxis = [{0}, 0.3, {1}]\nzero = [{1}, 0, {2}]\n"
        "inertia = [1e-3, 6e-4, 6e-4]\n"
    )
    axes = ((0.2, 1.0), (1.0, 0.4), (-0.5, 0.7))
    wheels = (f'[[flywheel]]\nname = "w{i}"\n{wheel.format(a, c, -a)}' for i, (a, c) in enumerate(axes))
    given = loads(TILTED + "".join(wheels))
    still = read_motion('{"schema": 1, "name": "still", "type": "periodic", "period": 0.1, "harmonics": []}', given)
    course = Fourier(np.array([0.3, 1.0, 2.0]), np.zeros((0, 3)), np.zeros((0, 3)))
    return given, still, programme_of(given, still, course, (1, -2, 3), np.zeros(6))


CASES: dict[str, Callable[[], Case]] = {"spinning": lambda: (stand(), motion(), spin()), "tilted": tilted}
MEASURED = {"spinning": '["z", "phi"]', "tilted": '["psi", "theta", "x"]'}
"""Coordinates that the trim of a case measures."""


def trim_of(case: Case, coordinates: str, harmonics: int = 2) -> Trim:
    """A trim of a few coordinates."""
    text = f"[trim]\ncoordinates = {coordinates}\nharmonics = {harmonics}\nsettling = 60\ngain = 0.3\n"
    found = read_servo(HEAD + text, case[0]).trim
    assert found is not None
    return found


@cache
def judge(name: str) -> tuple[np.ndarray, np.ndarray]:
    """The judge's matrix for a case, with its scale."""
    return trim_matrix(*CASES[name](), trim_of(CASES[name](), MEASURED[name]))


def difference(name: str) -> float:
    """Largest difference of the design from the judge, in the judge's scale."""
    expected, scale = judge(name)
    found = design_trim(*CASES[name](), trim_of(CASES[name](), MEASURED[name]))
    return float((np.abs(found.matrix - expected) / scale).max())


@pytest.mark.parametrize("name", quick(1, ["spinning", "tilted"]))
def test_the_judge_agrees_with_the_design(name: str) -> None:
    assert difference(name) < MATRIX


@pytest.mark.parametrize(("constant", "changed"), [("BEYOND", 1), ("SPILL", 31.0), ("REACH", 0.3)])
def test_every_constant_of_the_design_is_judged(constant: str, changed: float, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(design_module, constant, changed)
    assert difference("spinning") > MATRIX
