"""Vibration of a free mass of 20 kg by what makers say of its wheels, with nothing but algebra.

A force of amplitude `c W^2` that turns with order `h` of the wheel's speed `W` gives the free mass `m` the acceleration
`a = c W^2 / m` at `h W / 2 pi` Hz, along x and along y. A flat density `S` of a radial force from `f1` to `f2`, per
axis, gives the mean square `S (f2 - f1) / m^2`. Sums of two lines and noise of RMS `s`:

    rss^2 = (a1^2 + a2^2) / 2 + s^2,        worst = a1 + a2 + 3 s.

Moments about x and y, written as `M = M_x + i M_y`, turn the carrier by `theta = theta_x + i theta_y`, with `J` across
and the momentum `H = J_spin W` of the wheel: `J theta'' - i H theta' = M`. A moment that turns with the wheel, at
`omega`, has `M = exp(i omega t)`; against it, `-omega`. The rotor on its bearings lets through

    (k^2 + 2 i z k w) / (k^2 + 2 i z k w - w^2 + g W w),  w = omega or -omega.

Noise along two axes is half of each whirl.
"""

from __future__ import annotations

from math import pi, sqrt
from pathlib import Path

import numpy as np
import pytest

import mahovik
from by_hand.stands import ACROSS, SPIN, stand, wheel
from mahovik.out.functions.jitter import Jitter

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
def shaken(tmp_path_factory: pytest.TempPathFactory) -> Jitter:
    """Acceleration of the mass by two orders of wheel `a`, and noise of both wheels."""
    folder = tmp_path_factory.mktemp("makers")
    orders, of_a, of_b = folder / "orders.csv", folder / "a.csv", folder / "b.csv"
    orders.write_text("order,radial force [N/(rad/s)^2],tolerance\n1,2e-5,0.1\n2.5,5e-5,0.2\n")
    of_a.write_text(f"frequency [Hz],radial force [N^2/Hz]\n20,{S_OF_A}\n60,{S_OF_A}\n")
    of_b.write_text(f"frequency [Hz],radial force [N^2/Hz]\n40,{S_OF_B}\n80,{S_OF_B}\n")
    return mahovik.jitter(
        stand(wheel("a"), wheel("b")),
        {"a": W, "b": 0.0},
        "carrier",
        quantity="acceleration",
        harmonics={"a": orders},
        noise={"a": of_a, "b": of_b},
        require=["rms 0.1 m/s2 40..60Hz", "worst 1 m/s2", "rss 0.1 m/s2 70..200Hz"],
    )


def test_sums_of_lines_and_noise(shaken: Jitter) -> None:
    noise = noise_between(0, 200)
    rss = sqrt((A1**2 + A2**2) / 2 + noise)
    assert shaken.rss[0] == pytest.approx([rss, rss, 0.0], rel=GRID)
    assert shaken.rms[0] == pytest.approx([rss, rss, 0.0], rel=GRID)
    worst = A1 + A2 + 3 * sqrt(noise)
    assert shaken.worst[0] == pytest.approx([worst, worst, 0.0], rel=GRID)
    lines = {line["order"]: (line["frequency"], line["amplitude"]) for line in shaken.orders}
    assert lines[1][0] == pytest.approx(F1) and lines[1][1] == pytest.approx([A1, A1, 0.0])
    assert lines[2.5][0] == pytest.approx(F2) and lines[2.5][1] == pytest.approx([A2, A2, 0.0])


def test_requirements_with_tolerances_within_their_bands(shaken: Jitter) -> None:
    wanted = [
        sqrt((1.1 * A1) ** 2 / 2 + noise_between(40, 60)),
        1.1 * A1 + 1.2 * A2 + 3 * sqrt(noise_between(0, 200)),
        sqrt((1.2 * A2) ** 2 / 2 + noise_between(70, 200)),
    ]
    assert [verdict["value"] for verdict in shaken.requirements] == pytest.approx(wanted, rel=GRID)
    assert [verdict["limit"] for verdict in shaken.requirements] == [0.1, 1.0, 0.1]
    assert [verdict["met"] for verdict in shaken.requirements] == [True, True, False]
    margins = [verdict["margin"] for verdict in shaken.requirements]
    assert margins == pytest.approx([0.1 / wanted[0] - 1, 1.0 / wanted[1] - 1, 0.1 / wanted[2] - 1], rel=0.02)


def test_budget_cumulative_and_density(shaken: Jitter) -> None:
    made = shaken.to_dict()
    budget = {(share["wheel"], share["what"]): share["rms"][0] for share in made["budget"]}
    assert budget == {
        ("a", "order 1"): pytest.approx(A1 / sqrt(2)),
        ("a", "order 2.5"): pytest.approx(A2 / sqrt(2)),
        ("a", "noise"): pytest.approx(sqrt(40 * S_OF_A) / M, rel=GRID),
        ("b", "noise"): pytest.approx(sqrt(40 * S_OF_B) / M, rel=GRID),
    }
    frequency, rms = np.array(made["cumulative"]["frequency"]), np.array(made["cumulative"]["rms"])[:, 0]
    for line, lines in ((F1, A1**2 / 2), (F2, (A1**2 + A2**2) / 2)):
        at = int(np.argmin(np.abs(frequency - line)))
        assert frequency[at] == pytest.approx(line)
        assert rms[at] == pytest.approx(sqrt(lines + noise_between(0, line)), rel=GRID)
    density = np.array(made["psd"]["density"])[:, 0]  # mean over every Hz from 0
    flat = (S_OF_A + S_OF_B) / M**2
    assert density[[30, 50, 70]] == pytest.approx([S_OF_A / M**2, flat, S_OF_B / M**2], rel=GRID)
    assert density[[47, 119]] == pytest.approx([A1**2 / 2 + flat, A2**2 / 2], rel=GRID)


def test_noise_is_half_of_each_whirl(tmp_path: Path) -> None:
    """A band of 2 Hz about the forward whirl, where one whirl passes ten times the other."""
    natural, damping, polar, f, S = 2 * pi * 60.0, 0.05, 1.5, 40.0, 0.01
    (tmp_path / "noise.csv").write_text(f"frequency [Hz],radial moment [N^2 m^2/Hz]\n{f - 1},{S}\n{f + 1},{S}\n")
    (tmp_path / "inner.csv").write_text("mode,frequency [Hz],damping,polar ratio\nrocking,60,0.05,1.5\n")
    turned = mahovik.jitter(
        stand(wheel("a")),
        {"a": W},
        "carrier",
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
    assert turned.rms[0] == pytest.approx([wanted, wanted, 0.0], rel=GRID)


def test_requirements_count_what_a_low_order_leaves_out() -> None:
    """A wheel off the middle: what order 1 leaves out is what order 4 has at orders 2 to 4."""
    unbalanced = wheel("a", position=[0.5, 0, 0], unbalance={"static": "100 g m"})
    low, high = (
        mahovik.jitter(
            stand(unbalanced), {"a": W}, "carrier", quantity="displacement", order=order, require=["worst 1 um"]
        )
        for order in (1, 4)
    )
    above = np.sum([line["amplitude"] for line in high.orders if line["order"] > 1], axis=0)
    assert above.max() > 1e-3 * low.worst[0].max()
    assert low.remainder[0] == pytest.approx(above, rel=0.1, abs=1e-3 * above.max())
    assert low.requirements[0]["value"] == pytest.approx((low.worst[0] + low.remainder[0]).max(), rel=1e-9)
