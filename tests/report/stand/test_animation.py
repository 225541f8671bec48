"""Data of the animation: the motion in few numbers, without visible loss."""

from __future__ import annotations

import base64
import json
import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from pytest import approx

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion, load_motion
from mahovik.core.stand import load
from mahovik.out.report.stand.animation import (
    BYTES,
    Motion,
    magnifications,
    motion_of,
    reference_pose,
    rows_from_reference,
    section,
    thin_motion,
)
from mahovik.out.report.stand.material import Material, gather
from mahovik.out.report.stand.run import Run
from mahovik.stands import path


def vibration(rows: int, span: float, frequency: float, amplitude: float = 1e-5, N: int = 2) -> Motion:
    """The carrier on a circle of `amplitude` and turning as much; flywheels at even speed."""
    t = np.linspace(0.0, span, rows)
    angle = 2 * np.pi * frequency * t
    place = amplitude * np.stack([np.cos(angle), np.sin(angle), 0 * t], axis=1) + [1.0, 2.0, 3.0]
    half = amplitude * np.sin(angle) / 2
    turn = np.stack([np.cos(half), np.sin(half), 0 * t, 0 * t], axis=1)
    return Motion("made", t, place, turn, np.outer(t, np.linspace(200.0, 300.0, N)) + 50.0, True)


def data_of(html: str) -> dict[str, Any]:
    """Data that the page gives to the canvas."""
    script = re.search(r'id="moving-data">(.*?)</script>', html, re.DOTALL)
    assert script is not None
    found: dict[str, Any] = json.loads(script[1])
    return found


def html_of(material: Material) -> str:
    """The section of the report with the animation."""
    found = section(material)
    assert found is not None
    return found.html


def test_a_slow_motion_is_thinned_over_the_whole() -> None:
    """Enough rows remain for straight lines between them; the last row is one of them."""
    motion = vibration(20_000, 20.0, 2.0)
    found, words = thin_motion(motion, 1500)
    assert len(found.t) <= 1500
    assert found.t[-1] == motion.t[-1]
    assert found.t[0] < 0.02
    assert words == "every 14th row"


def test_of_a_fast_motion_the_end_is_kept_instead() -> None:
    """A vibration at 90 Hz cannot be seen in rows 20 ms apart."""
    motion = vibration(20_000, 20.0, 90.0)
    found, words = thin_motion(motion, 1000)
    assert len(found.t) <= 1000
    assert np.diff(found.t).max() < 1 / (90.0 * 5)
    assert found.t[-1] == motion.t[-1]
    assert "of the end, from" in words


def test_what_fits_is_left_alone() -> None:
    """No words, every row."""
    motion = vibration(500, 1.0, 90.0)
    assert thin_motion(motion, 500) == (motion, "")


def test_rows_give_the_motion_back() -> None:
    """Single precision keeps a vibration of 10 um three metres from the origin."""
    motion = vibration(300, 1.0, 5.0)
    position, quaternion = reference_pose(motion)
    rows, moved, turned = rows_from_reference(motion, position, quaternion)
    few = rows.astype(np.float32).astype(np.float64)
    assert few[:, 1:4] + position == approx(motion.position, abs=1e-11)
    assert few[:, 4:7] == approx(rows[:, 4:7], abs=1e-12)
    assert moved == approx(1e-5, rel=1e-2)
    assert turned == approx(1e-5, rel=2e-2)
    assert np.diff(few[:, 7:], axis=0) == approx(np.diff(motion.phi, axis=0), abs=1e-4)


def test_an_attitude_and_its_negative_are_one() -> None:
    """A run whose quaternion changes sign does not turn."""
    motion = vibration(10, 1.0, 5.0)
    sign = np.where(np.arange(10) % 2, -1.0, 1.0)[:, None]
    turned = rows_from_reference(replace(motion, quaternion=sign * motion.quaternion), *reference_pose(motion))[2]
    assert turned < 1e-4


@pytest.mark.parametrize(("moved", "turned"), [(1e-6, 1e-7), (3e-4, 0.0), (0.0, 1e-9), (2e-3, 1e-3)])
def test_magnified_motion_is_seen_and_stays_in_sight(moved: float, turned: float) -> None:
    """Steps of 1, 2, 5; begins where motion is a part of the stand; ends before it is larger than that."""
    steps, begin = magnifications(moved, turned, 0.4)
    assert steps[0] == 1.0
    assert steps == sorted(set(steps))
    assert 0.005 < max(steps[begin] * moved / 0.4, steps[begin] * turned) <= 0.3
    assert steps[-1] * moved <= 0.4 * (1 + 1e-9)
    assert steps[-1] * turned <= np.pi / 2 * (1 + 1e-9)


def test_large_motion_is_not_magnified() -> None:
    """Nor one that is not there."""
    assert magnifications(0.3, 0.0, 0.4) == ([1.0], 0)
    assert magnifications(0.0, 0.0, 0.4) == ([1.0], 0)


def test_rounding_is_not_magnified_to_a_motion() -> None:
    """Nor hidden: the words say that the carrier stands still."""
    stand = load(path("demo3"))
    columns = {name: np.zeros(6) for name in (f"{a} [m]" for a in "xyz")}
    columns |= {"t [s]": np.arange(6.0), "qw": np.ones(6)} | {f"q{a}": np.zeros(6) for a in "xyz"}
    columns |= {f"phi {s.name} [rad]": np.arange(6.0) for s in stand.flywheels}
    for moved, still in ((1e-16, True), (1e-7, False)):
        columns["z [m]"] = moved * np.arange(6.0)
        run = Run("made.csv", tuple(s.name for s in stand.flywheels), columns)
        html = html_of(replace(gather(stand, "demo3.toml"), run=run))
        assert ("Shown: the run made.csv; its carrier stands still." in html) is still
        assert ('id="magnify"' in html) is not still


def test_rows_that_are_no_numbers_are_left_out() -> None:
    """An attitude that jumps from q to -q does not turn."""
    stand = load(path("demo3"))
    columns = {name: np.zeros(6) for name in (f"{a} [m]" for a in "xyz")}
    columns |= {"t [s]": np.arange(6.0), "qw": np.array([1.0, 1, -1, -1, 1, 1])} | {f"q{a}": np.zeros(6) for a in "xyz"}
    columns |= {f"phi {s.name} [rad]": np.array([0.0, 1, 2, np.nan, 4, 5]) for s in stand.flywheels}
    run = Run("made.csv", tuple(s.name for s in stand.flywheels), columns)
    found = motion_of(replace(gather(stand, "demo3.toml"), run=run))
    assert found.t.tolist() == [0.0, 1.0, 2.0, 4.0, 5.0]
    assert found.quaternion[:, 0].tolist() == [1.0] * 5
    one = Run("made.csv", run.flywheels, {name: values[:1] for name, values in columns.items()})
    found = motion_of(replace(gather(stand, "demo3.toml"), run=one))
    assert not found.moves
    assert "made.csv has less than two rows" in found.words


def test_without_a_run_flywheels_turn_in_a_carrier_at_rest_and_it_says_so() -> None:
    """Nothing is invented: the words say that no run was given, no control speaks of the carrier's motion."""
    html = html_of(gather(load(path("bench8")), "bench8.toml"))
    assert "no run was given" in html
    assert 'id="magnify"' not in html
    assert 'id="trace"' not in html


def test_a_programme_moves_the_carrier_as_its_motion_requires() -> None:
    """q of the motion file at the start of the rows; the phases wind."""
    stand = load(path("bench8"))
    motion = load_motion(path("bench8").with_name("bench8.motion.json"), stand)
    material = replace(
        gather(stand, "bench8.toml"),
        motion=motion,
        programme=cast(Programme, Constant(motion, 8)),
        programme_file="p.json",
    )
    found = motion_of(material)
    assert found.position[0] == approx(motion.at(np.zeros(1)).q[0, :3])
    assert found.quaternion[0, 0] > 0.99
    assert "p.json" in found.words
    assert not motion_of(replace(material, motion=None)).moves


class Constant:
    """The part of a programme that these tests need: flywheels that turn once a period."""

    def __init__(self, motion: RequiredMotion, N: int) -> None:
        self.span, self.periodic, self.bias, self.N = motion.span, True, np.zeros(6), N

    def at(self, t: np.ndarray) -> SimpleNamespace:
        """Phases, as a programme gives them."""
        return SimpleNamespace(phi=np.outer(2 * np.pi * t / self.span, np.ones(self.N)))


def test_a_long_run_stays_small() -> None:
    """Ten seconds of eight flywheels at a millisecond and the scene, in less than 1.5 MB."""
    stand = load(path("bench8"))
    motion = vibration(10_001, 10.0, 10.0, N=8)
    wheels = tuple(s.name for s in stand.flywheels)
    columns = {"t [s]": motion.t} | {f"{a} [m]": motion.position[:, i] for i, a in enumerate("xyz")}
    columns |= {f"q{a}": motion.quaternion[:, i] for i, a in enumerate("wxyz")}
    columns |= {f"phi {name} [rad]": motion.phi[:, i] for i, name in enumerate(wheels)}
    html = html_of(replace(gather(stand, "bench8.toml"), run=Run("made.csv", wheels, columns)))
    data = data_of(html)
    assert len(html) < 1_500_000
    rows = np.frombuffer(base64.b64decode(data["rows"]), dtype="<f4").reshape(-1, 15)
    assert rows.nbytes <= BYTES + 60
    assert rows[-1, 0] == approx(10.0)
    assert data["magnifications"][0] == 1.0
