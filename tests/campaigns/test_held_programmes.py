"""Campaigns of held carriers over programmes: reached motion and reaction by closed formulas, refusals."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from campaigns.computing import Keys, computation, tables_of
from mahovik.core.motion.programme import programme_text
from mahovik.core.motion.required import read_motion
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.errors import MahovikError
from mahovik.out.api.stands import Stand
from mahovik.use.plan import plan_motion
from plan.held_stands import stand, wheel
from plan.test_held import PENDULUM, QUICK, SHAKER

PERIOD, A = 0.05, 1e-3
RUN = {"programme": "p.json", "motion": "m.json", "dt": 2e-4, "periods": 2}
SHAKE: dict[str, Any] = {"period": PERIOD, "winding": "spin", "harmonics": [{"k": 1, "cos": [A]}]}
SWING: dict[str, Any] = {"period": 1.0, "winding": "rock", "harmonics": [{"k": 1, "cos": [0.3]}]}


def write_files(folder: Path, own: CoreStand, keys: dict[str, Any]) -> None:
    """The motion m.json and its programme p.json."""
    text = json.dumps({"schema": 1, "type": "periodic", **keys})
    (folder / "m.json").write_text(text, encoding="utf-8")
    (folder / "p.json").write_text(planned(own, text), encoding="utf-8")


@cache
def planned(own: CoreStand, text: str) -> str:
    """Text of the programme of a motion file's text."""
    return programme_text(
        plan_motion(own, read_motion(text, own, "m.json"), replace(QUICK, verify=False)).programmes[0]
    )


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
    w, k, m = 2 * np.pi / PERIOD, 20000.0, 3.0 + d
    w0, t = np.sqrt(k / m), 2 * PERIOD
    B = d * A * w**2 / (k - m * w**2)
    expected = B * (np.cos(w * t) - np.cos(w0 * t)) - d * 9.81 / k * (1 - np.cos(w0 * t))
    assert found["z"] == pytest.approx(expected, rel=1e-6, abs=1e-7 * A)
    assert found["share"][0] < 1e-6 and 3e-3 < found["share"][1] < found["share"][2]
    assert found["across"] == pytest.approx(found["across"][0], rel=1e-9)


@pytest.mark.slow
def test_a_pendulum_keeps_its_programme_or_not(tmp_path: Path) -> None:
    """The planned motion is reached by the stand it was planned for, a smaller spin inertia gives less swing."""
    write_files(tmp_path, PENDULUM, SWING)
    own = computation(
        Stand.of(PENDULUM), {**RUN, "periods": 1, "dt": 1e-3}, {"pitch": {"peak": "error", "axis": "pitch"}},
        folder=tmp_path,
    )  # fmt: skip
    found, reasons = own.values(tables_of(own, {"w1.inertia.0.0": np.array([0.01, 0.0099])}))
    assert not any(reasons) and own.units == {"pitch": "rad"}
    assert found["pitch"][0] < 1e-6 and found["pitch"][1] > 5e-4


@pytest.mark.parametrize(
    ("own", "wanted", "words"),
    [
        (SHAKER, {"peak": "error", "axis": "x"}, "axis: x: expected one of z"),
        (SHAKER, {"peak": "error", "axis": "phi"}, "axis: phi: expected one of z"),
        (stand("freedoms = []", wheel(1, [1, 0, 0], 40)), {"peak": "error"}, "clamped, the carrier makes no motion"),
        (PENDULUM, {"peak": "error"}, "over: programme: p.json: programme of another stand: "),
    ],
)
def test_what_makes_no_sense_is_refused_in_a_line(tmp_path: Path, own: CoreStand, wanted: Keys, words: str) -> None:
    write_files(tmp_path, SHAKER, SHAKE)
    with pytest.raises(MahovikError) as refused:
        computation(Stand.of(own), RUN, {"e": wanted}, folder=tmp_path)
    assert words in str(refused.value) and "\n" not in str(refused.value)
