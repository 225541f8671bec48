"""Held carriers: unbalances from the channels of a force table, and numbers of a pendulum that swings freely."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from identify.data import identified
from mahovik.core.stand.model import State
from mahovik.errors import UsageError
from mahovik.out.api.stands import Stand
from mahovik.proof import reference
from mahovik.use.measured.read import read_recordings
from mahovik.use.simulate.held import home

Array = Any
LETTERS = "xyzkmn"
SPEEDS = (74.0, -91.0)
NOISE = np.repeat([0.02, 0.002], 3)
"""N, N m."""


def table(freedoms: list[str], **unbalance: Any) -> Stand:
    """A force table with two wheels whose axes are across, or the same on other freedoms."""
    wheels = [
        {
            "name": name, "position": [0.02, -0.03, 0.12], "axis": axis, "zero": [0, 0, 1], "mass": 0.25,
            "spin_inertia": 4e-4, "transverse_inertia": 2.2e-4, "unbalance": unbalance[name],
        }
        for name, axis in (("first", [0, 1, 0]), ("second", [1, 0, 0]))
    ]  # fmt: skip
    carrier = {"mass": 5.0, "inertia": [0.05, 0.05, 0.05]}
    keys = {"schema": 1, "name": "held", "gravity": [0, 0, -9.81], "carrier": carrier, "flywheel": wheels}
    return Stand.from_dict({**keys, "hold": {"freedoms": freedoms}})


TRUE = table(
    [],
    first={"static": "72 g mm", "static_at": "40 deg", "dynamic": "30 g cm^2", "dynamic_at": "110 deg"},
    second={"static": "50 g mm", "static_at": "-70 deg", "dynamic": "20 g cm^2", "dynamic_at": "-20 deg"},
)
START: dict[str, Any] = {"first": {"static": "1 g mm"}, "second": {"static": "1 g mm"}}


STICK: dict[str, Any] = {
    "schema": 1, "name": "stick", "gravity": [0, 0, -9.81],
    "carrier": {"mass": 0.4, "center_of_mass": [0, 0, -0.15], "inertia": [3e-3] * 3, "inertia_about": "center_of_mass"},
    "hold": {"freedoms": ["pitch"], "friction": [{"viscous": "0.004 N m s/rad"}]},
    "flywheel": [{"name": "wheel", "axis": [0, 1, 0], "zero": [0, 0, 1], "mass": 0.1, "spin_inertia": 1e-4,
                  "transverse_inertia": 6e-5}],
    "point": [{"name": "gyro", "position": [0, 0, -0.3]}],
}  # fmt: skip
"""A stick with a rate gyro that swings about its upper end, with friction."""


def readings(stand: Stand) -> Array:
    """Time, six components of the reaction and phases (T, 9) at SPEEDS, by the literal reference."""
    rows = []
    for t in np.arange(0.0, 0.9, 3e-3).tolist():
        phi = tuple(0.4 + speed * t for speed in SPEEDS)
        still = home(stand)
        state = State(
            still.position, None, still.quaternion, (0.0,) * 6, phi, SPEEDS, (0.0, 0.0), (0.0,) * 6, (0.0, 0.0)
        )
        rows.append([t, *reference.evaluate(stand, state, ["reaction"])["reaction"], *phi])
    return np.array(rows)


def write(file: Path, rows: Array, swap: bool = False) -> Path:
    """The file of these rows; `swap`: the first two forces are exchanged."""
    order = "yxzkmn" if swap else LETTERS
    channels = [f"hold.reaction.{letter} [{'N' if letter in 'xyz' else 'N m'}]" for letter in order]
    names = ["time [s]", *channels, "first.phase [rad]", "second.phase [rad]"]
    np.savetxt(file, rows, delimiter=",", header=",".join(names), comments="")
    return file


def with_noise(rows: Array, seed: int) -> Array:
    noisy = rows.copy()
    noisy[:, 1:7] += NOISE * np.random.default_rng(seed).normal(size=(len(rows), 6))
    return noisy


@pytest.fixture(scope="module")
def exact() -> Array:
    return readings(TRUE)


def test_a_force_table_tells_all_unbalances_of_its_wheels(tmp_path: Path, exact: Array) -> None:
    """Each is within four standard errors, which are those of the noise."""
    file = write(tmp_path / "run.csv", with_noise(exact, 1))
    numbers, result = identified(table([], **START), file, ["*.unbalance"])
    wanted, _ = identified(TRUE, file, ["*.unbalance"])
    assert not result["unobservable"] and not result.messages
    for path, number in numbers.items():
        assert abs(number.value - wanted[path].before) < 4.0 * number.standard_error, path
        assert number.value == pytest.approx(wanted[path].value, rel=1e-6)
    # a static unbalance U is an order of U w^2 in the two directions across the axis, read by T samples each
    static = numbers["first.unbalance.static"]
    assert static.standard_error < NOISE[0] / SPEEDS[0] ** 2 * np.sqrt(1.0 / len(exact)) * 1.5


@pytest.mark.slow
def test_standard_errors_are_those_of_many_recordings(tmp_path: Path, exact: Array) -> None:
    """The mean square of error over standard error, 8 numbers in 4 recordings, is 1 within its spread."""
    squares = []
    for seed in range(4):
        numbers, _ = identified(TRUE, write(tmp_path / "run.csv", with_noise(exact, seed)), ["*.unbalance"])
        squares += [((number.value - number.before) / number.standard_error) ** 2 for number in numbers.values()]
    assert abs(np.mean(squares) - 1.0) < 4.0 * np.sqrt(2.0 / len(squares))


def test_exchanged_columns_are_told(tmp_path: Path, exact: Array) -> None:
    file = write(tmp_path / "run.csv", with_noise(exact, 1), swap=True)
    _, result = identified(TRUE, file, ["first.unbalance.static"])
    assert any("hold.reaction.x: the stand leaves" in note and "an axis" in note for note in result.messages)
    assert not result.ok


def test_channels_of_a_hold_need_one(tmp_path: Path, exact: Array) -> None:
    free = Stand.from_dict({key: value for key, value in TRUE.to_dict().items() if key != "hold"})
    (recording,) = read_recordings([write(tmp_path / "run.csv", exact)], free)
    assert sum("the carrier is free, expected a stand with [hold]" in note for note in recording.notes) == 6
    with pytest.raises(UsageError, match=r"no channel of a sensor, expected such as acc1.acceleration.x"):
        identified(free, tmp_path / "run.csv", ["first.unbalance.static"])
    np.savetxt(tmp_path / "other.csv", exact[:, [0, 7, 8]], delimiter=",", comments="",
               header="time [s],first.phase [rad],second.phase [rad]")  # fmt: skip
    with pytest.raises(UsageError, match=r"no channel of a sensor, expected such as hold.reaction.x \[N\]"):
        identified(TRUE, tmp_path / "other.csv", ["first.unbalance.static"])


@pytest.mark.slow
def test_friction_and_mass_of_a_pendulum_are_told_by_its_swing(tmp_path: Path) -> None:
    """A stick with a rate gyro swings freely from an unknown angle; its pivot is on a table that reads the force."""
    true = Stand.from_dict(STICK)
    braked = {"default": {"hold": True}}
    start = {"angles": [0, 0.5, 0], "u": [0.2]}
    run = mahovik.simulate(true, until=3.0, regime=braked, start=start, every=0.01, backend="scipy")  # the reference
    noise = np.random.default_rng(2).normal(size=(run.count, 3)) * [0.01, 0.02, 0.02]
    columns = [run["t"], run["gyro_y gyro"], run["hold.reaction.x"], run["hold.reaction.z"]]
    rows = np.column_stack([columns[0], *(np.array(columns[1:]) + noise.T), run["phi wheel"]])
    header = "time [s],gyro.rate.y [rad/s],hold.reaction.x [N],hold.reaction.z [N],wheel.phase [rad]"
    np.savetxt(tmp_path / "swing.csv", rows, delimiter=",", header=header, comments="")
    guess = true.replace({"carrier.mass": 0.5, "hold.friction.0.viscous": 0.01})
    numbers, result = identified(guess, tmp_path / "swing.csv", ["carrier.mass", "hold.friction[0].viscous"])
    mass, friction = numbers.values()
    assert result["unit"].tolist() == ["kg", "N m s/rad"]
    assert abs(mass.value - 0.4) < 4.0 * mass.standard_error < 0.02
    assert abs(friction.value - 0.004) < 4.0 * friction.standard_error < 4e-4


@pytest.mark.slow
def test_the_end_of_a_ramp_is_a_corner_of_the_phases(tmp_path: Path) -> None:
    """The torque about the axis falls to nothing there; without noise all is found to rounding."""
    laws = {"first": {"ramp": {"to": "600 rpm", "duration": "0.3 s"}}, "second": {"speed": "-300 rpm"}}
    run = mahovik.simulate(TRUE, until=0.6, regime={"flywheel": laws}, every=1e-3)
    columns = ["t", *(f"hold.reaction.{letter}" for letter in LETTERS), "phi first", "phi second"]
    file = write(tmp_path / "ramp.csv", np.column_stack([run[name] for name in columns]))
    guess = TRUE.replace({"first.unbalance.static": "60 g mm"})
    numbers, _ = identified(guess, file, ["first.unbalance.static"])
    (number,) = numbers.values()
    assert number.value == pytest.approx(72e-6, rel=1e-6)
    assert number.standard_error < 1e-6 * number.value
