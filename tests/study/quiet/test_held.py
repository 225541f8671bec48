"""Quiet speeds and phases of held carriers: closed formulas, the free carrier, the periodic response, the C."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from cli.run import refused
from mahovik import stands
from mahovik.core.stand import Stand, load
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Hold
from mahovik.use.study.quiet import QuietOptions
from mahovik.use.study.quiet.held_lines import HeldAmplitudes
from mahovik.use.study.quiet.lines import Amplitudes
from mahovik.use.study.quiet.options import Wheels
from mahovik.use.study.rest import rest
from study.test_response_held import shaker, table

HELD = Path(__file__).parents[3] / "docs" / "held"
RPM = math.pi / 30.0
ZERO = (0.0, 0.0, 0.0)
BAND = (20.0, 200.0)
START = {"up": "3000rpm", "down": "2987rpm"}


def force_table() -> Stand:
    """Two wheels about z on a clamped carrier, of 72 and 60 g mm at angles 0 and 30 degrees."""
    document = table()
    first = document["flywheel"][0] | {"name": "up", "unbalance": {"static": "72 g mm"}}
    second = first | {"name": "down", "position": [0, 0, -0.1]}
    document["flywheel"] = [first, second | {"unbalance": {"static": "60 g mm", "static_at": "30 deg"}}]
    return mahovik.Stand.from_dict(document)


def on_rail() -> Stand:
    """Two exciters on a damped rail along z, of 160 and 140 g m, and a point."""
    document: dict[str, Any] = shaker(False) | {"point": [{"name": "eye", "position": [0.1, 0.0, 0.2]}]}
    first = document["flywheel"][0]
    document["flywheel"].append(first | {"name": "v", "unbalance": {"static": "140 g m", "static_at": "70 deg"}})
    return mahovik.Stand.from_dict(document)


@pytest.mark.parametrize("backend", [None, pytest.param("c", marks=pytest.mark.slow)])
def test_two_wheels_cancel_on_a_force_table(backend: str | None) -> None:
    """Together they leave the difference of the unbalances, half a turn apart; no momentum has to be kept."""
    found = mahovik.quiet(force_table(), "hold.reaction", BAND, speeds=START, change="20 rpm", backend=backend)
    one, other = found.speeds
    assert one == pytest.approx(other, rel=1e-12) and abs(one - 2993.5 * RPM) < 14.0 * RPM
    assert np.exp(1j * (found.phases[1] - found.phases[0] + math.radians(30.0))) == pytest.approx(-1.0, abs=1e-6)
    after = found.result.after
    assert after.rms == pytest.approx(12e-6 * one**2, rel=1e-6)  # of x and y together
    assert len(found.result.wheels.axes) == 0
    if backend is not None:
        assert after.simulated == pytest.approx(after.rms, rel=1e-3)
        assert found.result.agrees


@pytest.mark.parametrize("backend", [None, pytest.param("c", marks=pytest.mark.slow)])
def test_two_exciters_cancel_at_a_point_on_a_rail(backend: str | None) -> None:
    """They leave m e w^2 / (k - M w^2 + i c w) of 20 g m; the motion begins on the steady motion, on the rail."""
    stand = on_rail()
    words: dict[str, Any] = {"speeds": {"w": "601rpm", "v": "599rpm"}, "change": "5 rpm", "backend": backend}
    found = mahovik.quiet(stand, "eye", (5.0, 50.0), measure="displacement", **words)
    w = float(found.speeds[0])
    z = 0.02 * w**2 / abs(4e4 - 76.0 * w**2 + 300j * w)
    after = found.result.after
    assert after.rms == pytest.approx(z / math.sqrt(2.0), rel=1e-6)
    start = after.start
    assert start.position[:2] == (0.0, 0.0) and abs(start.position[2]) <= z * (1.0 + 1e-6)
    assert len(start.u) == 1
    if backend is not None:
        assert found.result.agrees and after.simulated == pytest.approx(after.rms, rel=1e-2)


def test_with_six_freedoms_the_amplitudes_are_those_of_the_free_carrier() -> None:
    free = load(stands.path("eye4"))
    held = replace(free, hold=Hold(tuple(FREEDOMS.values()), (0.1, -0.2, 0.3), ZERO, ZERO))
    speeds = np.array([60.0, -40.0, 20.0, 35.0])
    for measure in ("acceleration", "displacement", "rate"):
        options = QuietOptions("telescope", BAND, speeds=tuple(speeds.tolist()), measure=measure)
        one = Amplitudes.of(free, options, rest(free).state).at(speeds)
        other = HeldAmplitudes.of(held, options).at(speeds)
        assert np.abs(one - other).max() < 1e-6 * np.abs(one).max()
        momenta = [Wheels.of(each, options).axes for each in (free, held)]
        assert momenta[1] == pytest.approx(momenta[0], abs=1e-15)


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
def test_refusals(stand: str, words: list[str], expected: str) -> None:
    text = refused("quiet", str(HELD / f"{stand}.toml"), "--band", "20..200Hz", *words)
    assert expected in text and len(text.splitlines()) == 1
