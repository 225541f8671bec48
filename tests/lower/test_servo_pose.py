"""Coordinates that a trim takes from a pose are those of the reference's rotations."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.lower.layout import Layout
from mahovik.core.lower.servo.form import ServoForm, TrimForm
from mahovik.core.lower.servo.program import lower_servo
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand import load
from mahovik.core.stand.model import Sequence
from mahovik.core.stand.structure import structure
from mahovik.proof.reference.rotation import attitude, quaternion_rotation
from mahovik.stands import path

STAND = load(path("shaker2"))


@pytest.mark.parametrize("sequence", ["ship", "aircraft", "euler"])
def test_angles_give_the_attitude_back(sequence: Sequence) -> None:
    rng = np.random.default_rng(4)
    layout = Layout(structure(replace(STAND, angles=sequence)), DOUBLE)
    run = Interpreter(lower_servo(layout, ServoForm(layout.count, TrimForm((0, 2, 3, 4, 5), 1)))).run
    for _ in range(50):
        quaternion, position = rng.normal(size=4), rng.normal(size=3)
        quaternion /= np.linalg.norm(quaternion)
        inputs = {"position": position.tolist(), "attitude": (1.0005 * quaternion).tolist()}
        status, found = run("trim_coordinates", inputs)
        assert status == 0
        assert found["q"][:2] == [position[0], position[2]]
        assert np.allclose(attitude(sequence, *found["q"][2:]), quaternion_rotation(*quaternion), atol=1e-13)


def test_what_is_no_attitude_is_refused() -> None:
    layout = Layout(structure(STAND), DOUBLE)
    run = Interpreter(lower_servo(layout, ServoForm(layout.count, TrimForm((1, 4), 1)))).run
    for wrong, status in (([1.0, 0.1, 0.0, 0.0], -2), ([float("nan"), 0, 0, 1], -1), ([0.0] * 4, -2)):
        assert run("trim_coordinates", {"position": [0.0] * 3, "attitude": wrong})[0] == status
