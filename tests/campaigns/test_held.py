"""Campaigns of held carriers: reactions of a force table by closed formulas, a pendulum sample by sample."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import mahovik
from campaigns.computing import computation, tables_of
from cli.test_eval_held import TEXT
from identify.test_held import table
from mahovik.core.stand.read import loads
from mahovik.errors import UsageError
from mahovik.out.api.stands import Stand
from study.test_response_held import shaker


def forces(run: dict[str, Any], statistic: str = "peak") -> Any:
    """The static unbalances (kg m) of five samples, and the force along x that is found."""
    stand = table([], first={"static": "1 g mm"}, second={"static": "0 g mm", "dynamic": "1 g mm^2"})
    own = computation(stand, run, {"x": {statistic: "force", "of": "hold", "axis": "x"}})
    unbalance = np.linspace(1e-5, 9e-5, 5)
    found, reasons = own.values(tables_of(own, {"first.unbalance.static": unbalance}))
    assert not any(reasons) and own.units == {"x": "N"}
    return unbalance, found["x"]


@pytest.mark.slow
def test_a_force_table_reads_the_unbalance_of_each_sample() -> None:
    """U w^2, seen within the cosine of half a step of phase."""
    speed = 50.0 * np.pi
    unbalance, found = forces(
        {"regime": {"flywheel": {"first": {"speed": speed}}, "default": {"hold": True}}, "until": 0.08}
    )
    assert found == pytest.approx(unbalance * speed**2, rel=1.0 - np.cos(speed * 5e-4) + 1e-9)


def test_constant_speeds_need_no_run_in_time() -> None:
    speed = 50.0 * np.pi
    unbalance, found = forces({"speeds": {"first": speed, "second": 0.0}}, "rms")
    assert found == pytest.approx(unbalance * speed**2 / np.sqrt(2.0), rel=1e-9)


@pytest.mark.slow
def test_points_over_constant_speeds_are_an_oscillator() -> None:
    """m e w^2 / (k - M w^2 + i c w) of a shaker on its rail, for each mass; the reaction across it."""
    stand, w = mahovik.Stand.from_dict(shaker(True) | {"point": [{"name": "eye", "position": [0.1, 0.2, 0.3]}]}), 24.0
    wanted = {
        "moved": {"peak": "displacement", "at": "eye", "axis": "z"},
        "shaken": {"rms": "acceleration", "at": "carrier"},
        "turned": {"rms": "rate", "at": "eye"},
        "force": {"rms": "force", "of": "hold"},
    }
    own = computation(stand, {"speeds": {"w": w}}, wanted)
    mass = np.array([40.0, 60.0, 90.0])
    found, reasons = own.values(tables_of(own, {"carrier.mass": mass}))
    assert not any(reasons) and own.units == {"moved": "m", "shaken": "m/s2", "turned": "rad/s", "force": "N"}
    z = 0.16 * w**2 / np.abs(4e4 - (mass + 8.0) * w**2 + 300j * w)
    assert found["moved"] == pytest.approx(z, rel=0.02)  # seen at the nodes
    assert found["shaken"] == pytest.approx(z * w**2 / np.sqrt(2.0), rel=1e-9)
    assert found["force"] == pytest.approx(0.16 * w**2 / np.sqrt(2.0), rel=1e-9)
    assert np.all(found["turned"] == 0.0)


def test_a_mount_over_constant_speeds_is_refused() -> None:
    with pytest.raises(UsageError, match="over speeds only that of the hold is known, found first"):
        computation(table([], first={"static": "1 g mm"}, second={}), {"speeds": {"first": 10.0}},
                    {"x": {"peak": "force", "of": "first"}})  # fmt: skip


@pytest.mark.slow
def test_samples_of_a_pendulum_are_their_own_stands() -> None:
    """Peak of the force of the pivot and the last speed of the tip, of a stick whose friction and mass vary."""
    stand = Stand.of(loads(TEXT + "\n[[hold.friction]]\nviscous = 0.01\n"))
    start = {"angles": [0.0, 0.4, 0.0], "u": [0.3]}
    regime = {"default": {"speed": 100}}
    run = {"regime": regime, "until": 0.1, "dt": 1e-3, "every": 5e-3, "start": start}
    wanted = {
        "force": {"peak": "force", "of": "hold"},
        "moment": {"end": "moment", "of": "hold", "axis": "y"},
        "tip": {"end": "velocity", "at": "tip", "axis": "x"},
    }
    own = computation(stand, run, wanted)
    changes = {"carrier.mass": np.array([1.0, 2.0, 4.0]), "hold.friction.0.viscous": np.array([0.001, 0.01, 0.1])}
    found, reasons = own.values(tables_of(own, changes))
    assert not any(reasons)
    for j in range(3):
        one = stand.replace({path: float(values[j]) for path, values in changes.items()})
        seen = mahovik.simulate(one, 0.1, regime=regime, start=start, dt=1e-3, every=5e-3)
        force = np.stack([seen[f"hold.reaction.{axis}"] for axis in "xyz"])
        assert found["force"][j] == pytest.approx(np.linalg.norm(force, axis=0).max(), rel=1e-12)
        assert found["moment"][j] == pytest.approx(seen["hold.reaction.m"][-1], rel=1e-11)
    assert len(set(found["tip"].tolist())) == 3


def test_samples_begin_at_their_own_rest() -> None:
    """A pendulum that hangs with its mass off its axis: its force is its weight, and it does not move."""
    hanging = TEXT.replace("pivot = [0, 0, -0.2]", "pivot = [0, 0, 0.2]")
    stand = Stand.of(loads(hanging)).replace({"carrier.inertia_about": "center_of_mass"})
    own = computation(
        stand,
        {"regime": {"default": {"hold": True}}, "until": 0.05, "start": "rest"},
        {"force": {"peak": "force", "of": "hold"}, "rate": {"peak": "rate", "at": "tip"}},
    )
    off = np.array([0.0, 0.01, 0.05])
    found, reasons = own.values(tables_of(own, {"carrier.center_of_mass": np.outer(off, [1.0, 0.0, 0.0])}))
    assert not any(reasons)
    assert found["force"] == pytest.approx(np.full(3, 2.5 * 9.81), rel=1e-9)
    assert np.all(found["rate"] < 1e-9)
