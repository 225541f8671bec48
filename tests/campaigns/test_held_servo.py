"""Campaigns of held carriers with servos: the figures of `follow` along the freedoms, sample by sample."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from campaigns.computing import Keys, computation, tables_of
from export.held_servos import FRICTION, PERIOD, SWAY, hung, pendulum, programme
from mahovik.core.motion.programme import programme_text
from mahovik.errors import MahovikError
from mahovik.out.api.stands import Stand
from mahovik.use.control.loop import close_loop
from mahovik.use.control.record import following

SERVO = 'schema = 1\nsample_period = "10 ms"\nlatency = "2 ms"\nbandwidth = "4 Hz"\n'
RUN: dict[str, Any] = {"programme": "p.json", "motion": "m.json", "servo": "s.toml", "periods": 11}
WANTED: dict[str, Keys] = {
    "share": {"peak": "error"},
    "pitch": {"rms": "error", "axis": "pitch"},
    "mean": {"mean": "error", "axis": "pitch"},
    "tau": {"peak": "torque", "of": "w"},
}


def write_files(folder: Path) -> None:
    """Programme, motion and servos of the pendulum whose hinge has friction."""
    given = {"schema": 1, "name": "sway", "type": "periodic", "period": PERIOD, "winding": "rock"}
    (folder / "p.json").write_text(programme_text(programme(hung())), encoding="utf-8")
    (folder / "m.json").write_text(json.dumps({**given, "harmonics": [{"k": 1, "cos": [SWAY]}]}), encoding="utf-8")
    (folder / "s.toml").write_text(SERVO, encoding="utf-8")


@pytest.mark.slow
def test_a_pendulum_with_servos_is_that_of_follow(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No sample has C of its own. The first is the stand of the programme; the second has more friction; the third is
    held at an angle from which its own is counted, so it hangs as the first does and reads less by that angle.
    """
    write_files(tmp_path)
    stand, turned = Stand.of(hung()), 0.02
    own = computation(stand, RUN, WANTED, folder=tmp_path)
    assert own.units == {"share": "", "pitch": "rad", "mean": "rad", "tau": "N m"}
    friction = "hold.friction.0.viscous"
    changes = {friction: np.array([FRICTION, 1.2 * FRICTION, FRICTION]), "hold.angles.1": np.array([0.0, 0.0, turned])}
    tables = tables_of(own, changes)
    with monkeypatch.context() as patched:
        patched.setattr("mahovik.use.control.plant.compiled_backend", None)
        values, reasons = own.values(tables)
    assert reasons == [""] * 3
    files = (tmp_path / name for name in ("m.json", "p.json", "s.toml"))
    found = mahovik.follow(stand, *files, periods=11, causes=False)
    assert found.errors is not None
    assert (values["share"][0], values["pitch"][0]) == (found.errors.share, found.errors.rms[0])
    assert values["tau"][0] == np.abs(found.record.tau).max()
    stiff = close_loop(replace(found.case, real=stand.replace({friction: 1.2 * FRICTION})))
    assert values["share"][1] == pytest.approx(following(stiff, 10).share, rel=1e-9)
    assert values["share"][1] > 100 * values["share"][0]
    assert values["mean"][2] - values["mean"][0] == pytest.approx(-turned, rel=1e-6)
    assert values["pitch"][2] == pytest.approx(values["pitch"][0], rel=1e-4)


@pytest.mark.parametrize(
    ("wanted", "words"),
    [
        ({"peak": "error", "axis": "theta"}, "axis: theta: expected one of pitch"),
        ({"mean": "error"}, "axis: required with the mean of the error; expected one of pitch"),
        ({"peak": "force", "of": "hold"}, "no signal `force` over servo"),
    ],
)
def test_what_makes_no_sense_is_refused_in_a_line(tmp_path: Path, wanted: Keys, words: str) -> None:
    with pytest.raises(MahovikError) as refused:
        computation(Stand.of(pendulum()), RUN, {"e": wanted}, folder=tmp_path)
    assert words in str(refused.value) and "\n" not in str(refused.value)


def test_a_programme_of_another_hold_is_refused(tmp_path: Path) -> None:
    write_files(tmp_path)
    for stand in (pendulum(), replace(pendulum(), hold=None)):
        with pytest.raises(MahovikError, match=r"^over: p\.json: programme of another stand"):
            computation(Stand.of(stand), RUN, {"e": {"peak": "error"}}, folder=tmp_path)
