"""Programmes for measurement of held carriers: on a force table, on a pivot, by gyros and by the reaction."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import mahovik
from identify.experiments import check_predicted_errors
from identify.test_held import START, TRUE, table
from mahovik.errors import UsageError
from mahovik.out.api.model import build
from mahovik.out.api.stands import Stand
from mahovik.out.identify.channels import chosen_channels
from mahovik.out.identify.excite import face
from mahovik.out.identify.excite.bounds import bounds_of
from mahovik.out.identify.excite.course import Courses
from mahovik.out.identify.excite.information import Experiment
from mahovik.out.identify.excite.noise import noise_of_channels
from mahovik.out.identify.free import Free

STICK: dict[str, Any] = {
    "schema": 1, "name": "stick", "gravity": [0, 0, -9.81],
    "carrier": {"mass": 0.4, "center_of_mass": [0, 0, -0.15], "inertia": [3e-3] * 3, "inertia_about": "center_of_mass"},
    "hold": {"freedoms": ["pitch"], "friction": [{"viscous": "0.004 N m s/rad"}]},
    "flywheel": [{"name": "wheel", "axis": [0, 1, 0], "zero": [0, 0, 1], "mass": 0.1, "spin_inertia": 1e-4,
                  "transverse_inertia": 6e-5}],
    "point": [{"name": "gyro", "position": [0, 0, -0.3]}],
}  # fmt: skip
QUICK: dict[str, Any] = {"speed": "1000 rpm", "duration": 0.5, "rate": 500.0}


@pytest.fixture(autouse=True)
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    """A search of some programmes."""
    monkeypatch.setattr(face, "EVALUATIONS", 4)


@pytest.mark.parametrize("name", ["first", "second"])
def test_on_a_force_table_errors_are_those_of_a_closed_formula(name: str) -> None:
    """A static unbalance U turns with a force U w^2 in two directions: T samples tell each of its two parts to
    sigma / (w^2 sqrt T).
    """
    found = mahovik.excite(
        TRUE, free=f"{name}.unbalance.static,{name}.unbalance.static_at", channels=["hold.reaction.[xyz]"],
        noise={"force": "50 mN"}, harmonics=0, **QUICK,
    )  # fmt: skip
    (static, at), (U, _) = found["error"], found["value"]
    speed = found.found.peaks.speed[[wheel.name for wheel in TRUE.flywheels].index(name)]
    assert static == pytest.approx(0.05 / speed**2 / np.sqrt(250.0), rel=1e-3)
    assert at == pytest.approx(static / U, rel=1e-3)


def test_each_channel_adds_to_what_is_known() -> None:
    """A gyro tells mass and friction of a pendulum that a changing speed moves; a table under it adds information."""
    stand = Stand.from_dict(STICK)
    free = Free(build(stand), ["carrier.mass", "hold.friction[0].viscous"])
    own = Courses(stand, bounds_of(stand, 60.0, None, None, None, 1.0), 1.0, 2)
    programme = own.programme(np.array([[0.5, 0.9, 0.2, 0.7, 0.4]]))

    def information(*patterns: str) -> Any:
        read = chosen_channels(stand, patterns)
        quality = Experiment(stand, free, read, noise_of_channels(read, {}), 200.0, 60.0).quality(programme)
        return quality.information

    alone, both = information("gyro.rate.*"), information("gyro.rate.*", "hold.reaction.*")
    assert np.linalg.eigvalsh(alone)[0] > 100.0 and np.linalg.eigvalsh(both - alone)[0] > 1.0


@pytest.mark.slow
@pytest.mark.parametrize("freedoms", [[], ["pitch"], ["x", "z", "pitch"]])
def test_predicted_errors_are_those_of_the_estimation(freedoms: list[str]) -> None:
    """An estimate from data with this noise states the same covariance."""
    stand = table(freedoms, **START)
    channels = chosen_channels(stand, ())
    check_predicted_errors(stand, ["*.unbalance"], channels, noise_of_channels(channels, {}))


def test_a_free_carrier_has_no_reaction() -> None:
    free = {key: value for key, value in STICK.items() if key != "hold"}
    with pytest.raises(UsageError, match=r'no channel of stick is called "hold.reaction.x"'):
        mahovik.excite(Stand.from_dict(free), channels=["hold.reaction.x"], **QUICK)
