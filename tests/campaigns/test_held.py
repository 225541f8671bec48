"""Campaigns of held carriers: closed formulas, samples as their own stands, programmes with servos and without."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from campaigns.sections import Keys, computation, tables_of
from export.held_servos import FRICTION, PERIOD, SWAY, hung, programme
from identify.test_held import table
from mahovik.core.motion.motion_file import read_motion
from mahovik.core.motion.programme import programme_text
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.stand.read import loads
from mahovik.out.api.stands import Stand
from mahovik.out.commands.simulate import following_case
from mahovik.use.control.errors import errors_of
from mahovik.use.control.loop import close_loop
from mahovik.use.plan import PlanOptions, plan_motion
from plan.held_stands import stand, wheel
from verify.holds import PENDULUM as TEXT

PENDULUM = stand('freedoms = ["pitch"]\npivot = [0, 0, "120 mm"]', wheel(1, [0, 1, 0]))
SHAKER = stand(
    'freedoms = ["z"]',
    wheel(1, [1, 0, 0], 40, (0, -0.1, 0)) + wheel(2, [-1, 0, 0], 40, (0, 0.1, 0)),
    "[suspension]\nstiffness = [0, 0, 20000, 0, 0, 0]",
)
CYCLE, A = 0.05, 1e-3
SHAKE: dict[str, Any] = {"period": CYCLE, "winding": "spin", "harmonics": [{"k": 1, "cos": [A]}]}
RUN = {"programme": "p.json", "motion": "m.json", "dt": 2e-4, "periods": 2}
SERVO = 'schema = 1\nsample_period = "10 ms"\nlatency = "2 ms"\nbandwidth = "4 Hz"\n'
SERVO_RUN: dict[str, Any] = {"programme": "p.json", "motion": "m.json", "servo": "s.toml", "periods": 11}


def write_files(folder: Path, own: CoreStand, keys: dict[str, Any]) -> None:
    """The motion m.json, its programme p.json and the servos s.toml."""
    text = json.dumps({"schema": 1, "type": "periodic", **keys})
    (folder / "m.json").write_text(text, encoding="utf-8")
    (folder / "p.json").write_text(planned(own, text), encoding="utf-8")
    (folder / "s.toml").write_text(SERVO, encoding="utf-8")


@cache
def planned(own: CoreStand, text: str) -> str:
    """Text of the programme of a motion file's text."""
    options = PlanOptions(steps=60, enough=1, verify=False)
    return programme_text(plan_motion(own, read_motion(text, own, "m.json"), options).programmes[0])


@pytest.mark.slow
def test_constant_speeds_need_no_run_in_time() -> None:
    """A force table reads U w^2 of the static unbalance U of each sample."""
    speed, unbalance = 50.0 * np.pi, np.linspace(1e-5, 9e-5, 5)
    of = table([], first={"static": "1 g mm"}, second={"static": "0 g mm", "dynamic": "1 g mm^2"})
    own = computation(
        of, {"speeds": {"first": speed, "second": 0.0}}, {"x": {"rms": "force", "of": "hold", "axis": "x"}}
    )
    found, reasons = own.values(tables_of(own, {"first.unbalance.static": unbalance}))
    assert not any(reasons) and own.units == {"x": "N"}
    assert found["x"] == pytest.approx(unbalance * speed**2 / np.sqrt(2.0), rel=1e-9)


PLACES: dict[str, Any] = {
    "hold.pivot": np.array([[0.0, 0.0, -0.2], [0.02, 0.0, -0.15], [0.0, 0.1, 0.25]]),
    "hold.position": np.array([[0.0, 0.0, 0.0], [1.0, -2.0, 0.5], [0.1, 0.0, 0.0]]),
    "hold.angles": np.array([[0.0, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, -0.2, 0.0]]),
    "carrier.mass": np.array([1.0, 2.0, 4.0]),
    "hold.friction.0.viscous": np.array([0.001, 0.01, 0.1]),
}


@pytest.mark.slow
def test_samples_of_a_pendulum_are_their_own_stands() -> None:
    """Force of the pivot and speed of the tip, where mass, friction, pivot and place of each sample differ."""
    of = Stand.of(loads(TEXT + "\n[[hold.friction]]\nviscous = 0.01\n"))
    regime = {"default": {"speed": 100}}
    run = {"regime": regime, "until": 0.1, "dt": 1e-3, "every": 5e-3, "start": {"angles": [0.0, 0.4, 0.0], "u": [0.3]}}
    wanted = {
        "force": {"peak": "force", "of": "hold"},
        "moment": {"end": "moment", "of": "hold", "axis": "y"},
        "tip": {"end": "velocity", "at": "tip", "axis": "x"},
    }
    own = computation(of, run, wanted)
    found, reasons = own.values(tables_of(own, PLACES))
    assert not any(reasons)
    for j in range(3):
        one = of.replace({path: values[j].tolist() for path, values in PLACES.items()})
        start = {"angles": [0.0, 0.4 + float(PLACES["hold.angles"][j, 1]), 0.0], "u": [0.3]}
        seen = mahovik.simulate(one, until=0.1, regime=regime, start=start, dt=1e-3, every=5e-3)
        force = np.stack([seen[f"hold.reaction.{axis}"] for axis in "xyz"])
        assert found["force"][j] == pytest.approx(np.linalg.norm(force, axis=0).max(), rel=1e-9)
        assert found["moment"][j] == pytest.approx(seen["hold.reaction.m"][-1], rel=1e-9)
    assert len(set(found["tip"].tolist())) == 3


def test_samples_with_other_pivots_begin_at_their_own_rest() -> None:
    """The pivot of a pendulum off its axis: it hangs there with its weight on the pivot, and does not move."""
    own = computation(
        Stand.of(loads(TEXT.replace("pivot = [0, 0, -0.2]", "pivot = [0, 0, 0.2]"))),
        {"regime": {"default": {"hold": True}}, "until": 0.05, "start": "rest"},
        {
            "force": {"peak": "force", "of": "hold"}, "rate": {"peak": "rate", "at": "tip"},
            "moment": {"peak": "moment", "of": "hold", "axis": "y"},
        },
    )  # fmt: skip
    pivots = np.array([[0.0, 0.0, 0.2], [0.01, 0.0, 0.2], [0.08, 0.0, 0.2]])
    found, reasons = own.values(tables_of(own, {"hold.pivot": pivots}))
    assert not any(reasons)
    assert found["force"] == pytest.approx(np.full(3, 2.5 * 9.81), rel=1e-9)
    assert np.all(found["rate"] < 1e-9) and np.all(found["moment"] < 1e-9)  # about O1, the centre of mass


def test_a_heavier_shaker_misses_its_motion_by_the_closed_formula(tmp_path: Path) -> None:
    """The wheels turn as planned, so the error obeys (m + d) e'' + k e = -d (g + z''), at rest at t = 0; across the
    rail the hold bears the force of the wheels that is left, which is the same for any mass.
    """
    write_files(tmp_path, SHAKER, SHAKE)
    wanted: dict[str, Keys] = {
        "share": {"peak": "error"}, "z": {"end": "error", "axis": "z"}, "across": {"peak": "force", "of": "hold"},
    }  # fmt: skip
    own = computation(Stand.of(SHAKER), RUN, wanted, folder=tmp_path)
    assert own.units == {"share": "", "z": "m", "across": "N"}
    d = np.array([0.0, 0.01, 0.05])
    found, reasons = own.values(tables_of(own, {"carrier.mass": 2.0 + d}))
    assert not any(reasons)
    w, k, m = 2 * np.pi / CYCLE, 20000.0, 3.0 + d
    w0, t = np.sqrt(k / m), 2 * CYCLE
    B = d * A * w**2 / (k - m * w**2)
    expected = B * (np.cos(w * t) - np.cos(w0 * t)) - d * 9.81 / k * (1 - np.cos(w0 * t))
    assert found["z"] == pytest.approx(expected, rel=1e-6, abs=1e-7 * A)
    assert found["share"][0] < 1e-6 and 3e-3 < found["share"][1] < found["share"][2]
    assert found["across"] == pytest.approx(found["across"][0], rel=1e-9)


@pytest.mark.slow
def test_a_pendulum_with_servos_is_that_of_follow(tmp_path: Path) -> None:
    """No sample has C of its own. The first is the stand of the programme; the second has more friction; the third is
    held at an angle from which its own is counted, so it hangs as the first does and reads less by that angle.
    """
    motion = {"schema": 1, "name": "sway", "type": "periodic", "period": PERIOD, "winding": "rock"}
    (tmp_path / "p.json").write_text(programme_text(programme(hung())), encoding="utf-8")
    (tmp_path / "m.json").write_text(json.dumps({**motion, "harmonics": [{"k": 1, "cos": [SWAY]}]}), encoding="utf-8")
    (tmp_path / "s.toml").write_text(SERVO, encoding="utf-8")
    wanted: dict[str, Keys] = {
        "share": {"peak": "error"},
        "pitch": {"rms": "error", "axis": "pitch"},
        "mean": {"mean": "error", "axis": "pitch"},
        "tau": {"peak": "torque", "of": "w"},
    }
    of, turned = Stand.of(hung()), 0.02
    own = computation(of, SERVO_RUN, wanted, folder=tmp_path)
    assert own.units == {"share": "", "pitch": "rad", "mean": "rad", "tau": "N m"}
    friction = "hold.friction.0.viscous"
    changes = {friction: np.array([FRICTION, 1.2 * FRICTION, FRICTION]), "hold.angles.1": np.array([0.0, 0.0, turned])}
    tables = tables_of(own, changes)
    values, reasons = own.values(tables)
    assert reasons == [""] * 3
    files = [tmp_path / name for name in ("m.json", "p.json", "s.toml")]
    found = mahovik.simulate(of, motion=files[0], programme=files[1], servo=files[2], periods=11)
    assert (values["share"][0], values["pitch"][0]) == (found["error"], found["coordinates"]["rms"][0])
    assert values["tau"][0] == max(found["peak_torque"])
    case = following_case(of, *files, 0.0, 1, 11, None, 128, "c")
    stiff = close_loop(replace(case, real=of.replace({friction: 1.2 * FRICTION})))
    assert values["share"][1] == pytest.approx(errors_of(stiff).share, rel=1e-9)
    assert values["share"][1] > 100 * values["share"][0]
    assert values["mean"][2] - values["mean"][0] == pytest.approx(-turned, rel=1e-6)
    assert values["pitch"][2] == pytest.approx(values["pitch"][0], rel=1e-4)
