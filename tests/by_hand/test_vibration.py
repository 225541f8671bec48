"""Vibration of a free mass of 20 kg by what makers say of its wheels, with nothing but algebra.

A force of amplitude `c W^2` that turns with order `h` of the wheel's speed `W` gives the free mass `m` the acceleration
`a = c W^2 / m` at `h W / 2 pi` Hz, along x and along y. A flat density `S` of a radial force from `f1` to `f2`, per
axis, gives the mean square `S (f2 - f1) / m^2`. Sums of two lines and noise of RMS `s`:

    rms^2 = (a1^2 + a2^2) / 2 + s^2,        peak = worst = a1 + a2 + 3 s.

Moments about x and y, written as `M = M_x + i M_y`, turn the carrier by `theta = theta_x + i theta_y`, with `J` across
and the momentum `H = J_spin W` of the wheel: `J theta'' - i H theta' = M`. A moment that turns with the wheel, at
`omega`, has `M = exp(i omega t)`; against it, `-omega`. The rotor on its bearings lets through

    (k^2 + 2 i z k w) / (k^2 + 2 i z k w - w^2 + g W w),  w = omega or -omega.

Noise along two axes is half of each whirl.
"""

from __future__ import annotations

from dataclasses import replace
from math import pi, sqrt
from pathlib import Path

import numpy as np
import pytest

from by_hand.stands import ACROSS, SPIN, stand, wheel
from mahovik.out.commands.vibration import vibration
from mahovik.out.result import Result
from mahovik.use.vibration.chain import integral, left_out_of
from mahovik.use.vibration.lines import Sums, read_requirements
from mahovik.use.vibration.plant import Scene
from mahovik.use.vibration.speeds import read_speeds
from mahovik.use.vibration.steady import quasiperiodic
from mahovik.use.vibration.study import Resonances, mattering
from mahovik.use.vibration.study import vibration as find
from mahovik.use.vibration.view import find_view

M = 20.0
W = 300.0
A1, A2 = 2e-5 * W**2 / M, 5e-5 * W**2 / M  # m/s2, of the orders 1 and 2.5
F1, F2 = W / (2 * pi), 2.5 * W / (2 * pi)  # Hz: 47.7 and 119
S_OF_A, S_OF_B = 0.02, 0.05  # N2/Hz, from 20 to 60 Hz and from 40 to 80 Hz
GRID = 4e-3
"""Relative: noise is summed by trapezoids on a grid of 0.25 %, and a density ends within one of its cells."""


def noise_between(low: float, high: float) -> float:
    """Mean square of the acceleration by noise from `low` to `high` Hz."""
    of_a = max(0.0, min(high, 60.0) - max(low, 20.0)) * S_OF_A
    of_b = max(0.0, min(high, 80.0) - max(low, 40.0)) * S_OF_B
    return (of_a + of_b) / M**2


@pytest.fixture(scope="module")
def shaken(tmp_path_factory: pytest.TempPathFactory) -> Result:
    """Acceleration of the mass by two orders of wheel `a`, and noise of both wheels."""
    folder = tmp_path_factory.mktemp("makers")
    orders, of_a, of_b = folder / "orders.csv", folder / "a.csv", folder / "b.csv"
    orders.write_text("order,radial force [N/(rad/s)^2],tolerance\n1,2e-5,0.1\n2.5,5e-5,0.2\n")
    of_a.write_text(f"frequency [Hz],radial force [N^2/Hz]\n20,{S_OF_A}\n60,{S_OF_A}\n")
    of_b.write_text(f"frequency [Hz],radial force [N^2/Hz]\n40,{S_OF_B}\n80,{S_OF_B}\n")
    return vibration(
        stand(wheel("a"), wheel("b")),
        speed={"a": W, "b": 0.0},
        at="carrier",
        quantity="acceleration",
        harmonics={"a": orders},
        noise={"a": of_a, "b": of_b},
        require=["rms 0.1 m/s2 40..60Hz", "worst 1 m/s2", "rms 0.1 m/s2 70..200Hz"],
    )


def test_sums_of_lines_and_noise(shaken: Result) -> None:
    noise = noise_between(0, 200)
    rms, worst = sqrt((A1**2 + A2**2) / 2 + noise), A1 + A2 + 3 * sqrt(noise)
    assert shaken["rms"] == pytest.approx([rms, rms, 0.0], rel=GRID)
    assert [*shaken["peak"], *shaken["worst"]] == pytest.approx(2 * [worst, worst, 0.0], rel=GRID)
    lines = dict(zip(shaken["order"], zip(shaken["frequency"], shaken["amplitude"], strict=True), strict=True))
    assert lines[1][0] == pytest.approx(F1) and lines[1][1] == pytest.approx([A1, A1, 0.0])
    assert lines[2.5][0] == pytest.approx(F2) and lines[2.5][1] == pytest.approx([A2, A2, 0.0])


def test_requirements_with_tolerances_within_their_bands(shaken: Result) -> None:
    wanted = [
        sqrt((1.1 * A1) ** 2 / 2 + noise_between(40, 60)),
        1.1 * A1 + 1.2 * A2 + 3 * sqrt(noise_between(0, 200)),
        sqrt((1.2 * A2) ** 2 / 2 + noise_between(70, 200)),
    ]
    assert [verdict["value"] for verdict in shaken["requirements"]] == pytest.approx(wanted, rel=GRID)
    assert [verdict["limit"] for verdict in shaken["requirements"]] == [0.1, 1.0, 0.1]
    assert [verdict["met"] for verdict in shaken["requirements"]] == [True, True, False] and not shaken.ok


def test_a_density_is_integrated_within_a_band() -> None:
    """2 + f over a band that begins and ends between frequencies; a density ends where its table does."""
    f = np.array([10.0, 20.0, 40.0])
    density = np.tile((2.0 + f)[None, :, None], (1, 1, 3))
    for low, high in ((12.0, 33.0), (0.0, 15.0), (25.0, 100.0), (50.0, 60.0)):
        a, b = max(low, 10.0), max(min(high, 40.0), low, 10.0)
        whole = 2.0 * (b - a) + (b * b - a * a) / 2.0 if a < 40.0 else 0.0
        assert integral(f, density, (low, high))[0] == pytest.approx([whole] * 3)


def test_noise_is_half_of_each_whirl(tmp_path: Path) -> None:
    """Noise in a band of 2 Hz about the forward whirl is that of one whirl, which passes ten times the other."""
    natural, damping, polar, f, S = 2 * pi * 60.0, 0.05, 1.5, 40.0, 0.01
    (tmp_path / "noise.csv").write_text(f"frequency [Hz],radial moment [N^2 m^2/Hz]\n{f - 1},{S}\n{f + 1},{S}\n")
    (tmp_path / "inner.csv").write_text("mode,frequency [Hz],damping,polar ratio\nrocking,60,0.05,1.5\n")
    turned = vibration(
        stand(wheel("a")),
        speed={"a": W},
        at="carrier",
        quantity="angle",
        noise={"a": tmp_path / "noise.csv"},
        inner_modes={"a": tmp_path / "inner.csv"},
    )

    def gain(w: float) -> float:
        through = natural**2 + 2j * damping * natural * w
        return abs(through / (through - w**2 + polar * W * w) / (-ACROSS * w**2 + SPIN * W * w)) ** 2

    grid = 2 * pi * np.linspace(f - 1, f + 1, 201)
    forward, backward = (float(np.mean([gain(sign * w) for w in grid])) for sign in (1, -1))
    assert max(forward, backward) > 5 * min(forward, backward)
    wanted = sqrt(S * 2.0 * (forward + backward) / 2)
    assert turned["rms"] == pytest.approx([wanted, wanted, 0.0], rel=GRID)


def test_requirements_count_what_a_solution_leaves_out() -> None:
    """What order 2 leaves out of a wheel off the middle is what order 4 has at orders 3 and 4."""
    carrier = stand(wheel("a", position=[0.5, 0, 0], unbalance={"static": "100 g m"}))
    scene, seen = Scene.of(carrier), find_view(carrier, "carrier", "displacement")
    solutions = find(scene, read_speeds(carrier, W), seen)
    high, low = (quasiperiodic(scene, [W], order=order) for order in (4, 2))
    above = np.abs(high.torus.coefficients(seen.full(high.full()))[3:]).sum(axis=0)
    left = left_out_of(low, seen)
    assert left == pytest.approx(above, rel=0.1, abs=1e-3 * above.max()) and left.max() > 0.0
    solution = solutions.whole[0]._replace(left_out=left)
    (limit,) = read_requirements(["worst 1 um"], seen.name, seen.measure.unit)
    verdict = replace(solutions, whole={0: solution}).judge(limit)
    assert verdict.value == pytest.approx((solutions.sums().worst[0] + left).max(), rel=1e-9)


def test_resonances_of_tables_matter_where_a_sum_can_be_largest() -> None:
    """Sums of 1 to 3 at three speeds; lines of 0.1 beside 1, of 0.1 beside 3, of 2 beside 1, two of 1 that add up."""
    sums = np.array([1.0, 1.0, 3.0])[:, None] * np.ones(3)
    at = np.array([0.5, 1.5, 0.25, 0.75, 0.75])
    met = Resonances(at, np.full(5, 1e-3), np.zeros(5, dtype=int), np.ones(5))
    size = np.array([0.1, 0.1, 2.0, 0.95, 0.95])[:, None] * np.ones(3)
    kept = mattering(np.arange(3.0), Sums(sums, sums, sums), met, size)
    assert kept.tolist() == [False, True, True, True, True]
