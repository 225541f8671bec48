"""Speeds and phases: the momentum stays, limits hold, jitter falls as the exact steady state and the C say."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from cli.run import refused
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import rest_state
from mahovik.errors import CheckError, UsageError
from mahovik.proof import reference
from mahovik.proof.reference.momentum import momentum
from mahovik.stands import path
from mahovik.use.vibration.band import rms
from mahovik.use.vibration.periodic import periodic_response
from mahovik.use.vibration.quiet import QuietOptions, QuietResult, quiet
from mahovik.use.vibration.quiet.search import Search, SpeedChoice
from mahovik.use.vibration.view import find_view
from study.test_response_held import table

RPM = math.pi / 30.0
BAND = (20.0, 200.0)
AWAY = tuple(RPM * x for x in (3040.0, 3022.0, 3040.0, 3022.0))
SAT4 = QuietOptions("acc1", BAND, (0.0, 0.0, 14.0), AWAY)


@pytest.fixture(scope="module")
def sat4() -> Stand:
    return load(path("sat4"))


def quiet_result(stand: Stand, wish: QuietOptions = SAT4, **changed: Any) -> QuietResult:
    """The plan of a stand."""
    return quiet(stand, replace(wish, **changed))


def test_the_momentum_is_that_of_the_literal_reference(sat4: Stand) -> None:
    """Z of (2), mean over phase: nothing of the search is used."""
    got = quiet_result(sat4, speeds=(200.0, -100.0, 150.0, 60.0), momentum=(1.0, -0.7, 2.0))
    mean = np.zeros(3)
    for turn in range(4):
        phi = tuple(got.after.phases + turn * math.pi / 2)
        state = replace(rest_state(sat4), phi=phi, phi_dot=tuple(got.after.speeds.tolist()))
        mean += momentum(reference.pieces(sat4, state))[3:] / 4
    assert mean == pytest.approx([1.0, -0.7, 2.0], abs=1e-12)


def test_limits_hold(sat4: Stand) -> None:
    """Least and largest speed, change, avoided orders, each where it binds."""
    wish = replace(SAT4, momentum=(2.0, 1.0, 5.0), speeds=None)
    bound = 3000.0 * RPM
    got = quiet_result(sat4, wish, limit=bound, least=100.0 * RPM, avoid=((14.0, 22.0),))
    sizes = np.abs(got.after.speeds)
    assert np.all(sizes <= bound * (1 + 1e-8))
    assert np.all(sizes >= 100.0 * RPM * (1 - 1e-8))
    turns = sizes / (2 * math.pi)
    for order in (1, 2):
        assert not np.any((order * turns > 14.0 * (1 + 1e-8)) & (order * turns < 22.0 * (1 - 1e-8)))
    held = quiet_result(sat4, wish, change=20.0 * RPM)
    assert np.abs(held.after.speeds - held.before.speeds).max() <= 20.0 * RPM * (1 + 1e-8)


def test_small_differences_of_speed_make_sat4_ten_times_quieter(sat4: Stand) -> None:
    """All orders in the band by collocation over a common period; momentum stays."""
    got = quiet(sat4, SAT4)
    exact = periodic_response(sat4, got.after.speeds.tolist(), got.after.phases.tolist())
    values = rms(exact.harmonics(find_view(sat4, "acc1")), exact.frequencies, BAND)
    assert float(np.linalg.norm(values)) == pytest.approx(got.after.rms, rel=1e-3)
    assert got.before.free / float(np.linalg.norm(values)) >= 10.0
    assert np.abs(got.after.speeds - AWAY).max() < 10.0 * RPM
    assert got.momentum_error < 1e-13
    assert got.agrees and got.after.full == pytest.approx(float(np.linalg.norm(values)), rel=1e-6)
    assert got.before.full == pytest.approx(got.before.rms, rel=1e-3)


def test_what_binds_is_said(sat4: Stand) -> None:
    """Limits that exclude each other, momentum beyond the motors."""
    with pytest.raises(CheckError, match=r"needs 1\.4\d* times the speed limits, at best rw\d at 8660"):
        quiet_result(sat4, momentum=(0.0, 0.0, 40.0))
    with pytest.raises(CheckError, match=r"without (the avoided frequencies or )?--change"):
        quiet_result(sat4, change=0.1, avoid=((50.0, 51.0),))


def test_time_and_interrupts_cut_the_search(sat4: Stand, monkeypatch: pytest.MonkeyPatch) -> None:
    """No time: nothing is found, which is said. Ctrl-C after the third look: the best so far."""
    with pytest.raises(CheckError, match="--time ended the search before"):
        quiet(sat4, SAT4, seconds=1e-9)
    look = Search.evaluate

    def third(self: Search, *arguments: Any) -> SpeedChoice:
        if self.looked_at == 2:
            raise KeyboardInterrupt
        return look(self, *arguments)

    monkeypatch.setattr(Search, "evaluate", third)
    got = quiet(sat4, SAT4)
    assert (got.interrupted, got.looked_at, got.after.full) == (True, 2, None)
    assert got.after.rms <= got.before.free


def test_stands_that_have_nothing_free_are_refused(sat4: Stand) -> None:
    """Three flywheels for three axes; two of one axis hold nothing across it."""
    few = replace(sat4, flywheels=sat4.flywheels[:3])
    with pytest.raises(UsageError, match="3 flywheels with spin axes of rank 3 leave no speeds free"):
        quiet_result(few, speeds=None)
    one = replace(sat4.flywheels[0], name="other")
    pair = replace(sat4, flywheels=(sat4.flywheels[0], one))
    with pytest.raises(UsageError, match="perpendicular to all spin axes"):
        quiet_result(pair, speeds=None)


HELD = Path(__file__).parents[2] / "docs" / "held"
START = {"up": "3000rpm", "down": "2987rpm"}


def force_table() -> Stand:
    """Two wheels about z on a clamped carrier, of 72 and 60 g mm at angles 0 and 30 degrees."""
    document = table()
    first = document["flywheel"][0] | {"name": "up", "unbalance": {"static": "72 g mm"}}
    second = first | {"name": "down", "position": [0, 0, -0.1]}
    document["flywheel"] = [first, second | {"unbalance": {"static": "60 g mm", "static_at": "30 deg"}}]
    return mahovik.Stand.from_dict(document)


def test_two_wheels_cancel_on_a_force_table() -> None:
    """Together they leave the difference of the unbalances, half a turn apart; no momentum has to be kept."""
    choice = mahovik.quiet(force_table(), "hold.reaction", BAND, speeds=START, change="20 rpm")
    one, other = choice.speeds
    assert one == pytest.approx(other, rel=1e-12) and abs(one - 2993.5 * RPM) < 14.0 * RPM
    assert np.exp(1j * (choice.phases[1] - choice.phases[0] + math.radians(30.0))) == pytest.approx(-1.0, abs=1e-6)
    after = choice.result.after
    assert after.rms == pytest.approx(12e-6 * one**2, rel=1e-6)  # of x and y together
    assert len(choice.result.wheels.axes) == 0
    assert after.full == pytest.approx(after.rms, rel=1e-6)


@pytest.mark.parametrize(
    ("stand", "words", "expected"),
    [
        ("force_table", ["--point", "hold.reaction", "--speeds", "10 rpm"], "one flywheel has nothing to cancel its"),
        ("force_table", ["--point", "carrier", "--speeds", "10 rpm"], "force_table is clamped, and no point moves"),
        ("linear_shaker", ["--point", "hold.reaction", "--momentum", "0 0 1"], "linear_shaker turns about nothing"),
        ("air_table", ["--point", "hold.reaction", "--momentum", "0 0 1"], "spin axes of rank 3 leave no speeds free"),
        ("air_table", ["--point", "hold.reacton", "--momentum", "0 0 1"], 'did you mean "hold.reaction"?'),
        ("air_table", ["--point", "hold.reaction", "--momentum", "0 0 1", "--measure", "rate"], "--measure rate"),
    ],
)  # fmt: skip
def test_refusals_of_held_carriers(stand: str, words: list[str], expected: str) -> None:
    text = refused("quiet", str(HELD / f"{stand}.toml"), "--band", "20..200Hz", *words)
    assert expected in text and len(text.splitlines()) == 1
