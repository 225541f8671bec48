"""The matrix of a trim is judged from its definition: wrong numbers of the C, wrong constants of the design, fail."""

from __future__ import annotations

import numpy as np
import pytest

import mahovik.use.control.trim as design_module
from export.programmes import motion, spin, stand
from export.servos import HEAD
from mahovik.core.motion.servo import read_servo
from mahovik.proof.verify.servo.tables import MATRIX
from mahovik.proof.verify.servo.trim_matrix import trim_matrix
from mahovik.use.control.trim import design_trim


def difference() -> float:
    """Largest difference of the design from the judge for shaker2 with a programme, in the judge's scale."""
    text = '[trim]\ncoordinates = ["z", "phi"]\nharmonics = 2\nsettling = 60\ngain = 0.3\n'
    trim = read_servo(HEAD + text, stand()).trim
    assert trim is not None
    expected, scale = trim_matrix(stand(), motion(), spin(), trim)
    found = design_trim(stand(), motion(), spin(), trim)
    return float((np.abs(found.matrix - expected) / scale).max())


def test_the_judge_agrees_with_the_design() -> None:
    assert difference() < MATRIX


@pytest.mark.parametrize(("constant", "changed"), [("BEYOND", 1), ("SPILL", 31.0), ("REACH", 0.3)])
def test_every_constant_of_the_design_is_judged(constant: str, changed: float, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(design_module, constant, changed)
    assert difference() > MATRIX
