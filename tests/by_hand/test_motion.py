"""Motion of a free mass of 20 kg under a force along x: in time, in quantities of a campaign, and its linear model.

A force `F = 20 t` N gives the acceleration `t`, the velocity `t^2 / 2`, the place `t^3 / 6`. Steps hold the force of
their middle, which sums a straight line exactly to the velocity. A force of 20 N gives the velocity `t`: from 0.5 to
1 s its mean is 0.75; of 101 times its mean over the last tenth, ten of them, is 0.955, and 0.75 is the last time that
is off it by more than 0.2005.

A moment `k` on a wheel about its axis, which lies along z in the middle and turns evenly, turns carrier and wheels by
`k / J_z`, with the moments of inertia of both. The drive has to give what the wheel takes of that, less the moment:
`tau = J_spin k / J_z - k`.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

import mahovik
from by_hand.stands import ALONG, SPIN, stand, wheel
from mahovik.core.stand import rest_state
from mahovik.out.campaign.file import load_campaign
from mahovik.use.study.linear import linear_model

PUSHED = stand(carrier={"mass": 20, "wrench_input": True})


def test_a_growing_force_acts_in_the_middle_of_a_step(tmp_path: Path) -> None:
    (tmp_path / "force.csv").write_text("t,X\n0,0\n1,20\n")
    regime = tmp_path / "regime.toml"
    regime.write_text('schema = 1\n[wrench]\ncarrier = "force.csv"\n')
    run = mahovik.simulate(PUSHED, until=1.0, regime=regime, start={}, dt=0.05, every=0.05)
    x, u = (run[name] for name in ("x", "v_x"))
    t = run["t"]
    assert u == pytest.approx(t**2 / 2, abs=1e-12)
    assert x == pytest.approx(t**3 / 6, abs=0.05**2 / 11)  # held within a step: h^2 t / 12


CAMPAIGN = """
schema = 1
stand = "hand.toml"
samples = 1
seed = 1
design = "random"
[vary]
"carrier.mass" = { normal = ["20 kg", "1e-9 kg"] }
[over]
regime = { wrench = { carrier = [20, 0, 0, 0, 0, 0] } }
start = { V = [0, 0, 0, 0, 0, 0] }
until = "1 s"
every = "10 ms"
dt = "10 ms"
"""

QUANTITY = """
[[quantity]]
name = "{name}"
what = "{what} velocity"
at = "carrier"
axis = "x"
{more}
"""


def test_quantities_after_a_time(tmp_path: Path) -> None:
    wanted = {
        "mean": ("mean", "", 0.5),
        "late": ("mean", 'after = "0.5 s"', 0.75),
        "least": ("least", 'after = "0.5 s"', 0.5),
    }
    tables = [QUANTITY.format(name=name, what=what, more=more) for name, (what, more, _) in wanted.items()]
    PUSHED.save(tmp_path / "hand.toml")
    (tmp_path / "C.toml").write_text(CAMPAIGN + "".join(tables))
    rows = load_campaign(tmp_path / "C.toml").rows(0, 1)
    for name, (*_, value) in wanted.items():
        assert float(rows[name][0]) == pytest.approx(value)


def test_the_nominal_torque_bears_a_run_time_wrench() -> None:
    k = 0.3
    turned = stand(wheel("a", wrench_input=True), wheel("b"))
    model = linear_model(turned, replace(rest_state(turned), wrench={"a": (0, 0, 0, k, 0, 0)}), [])
    J = ALONG + 2 * SPIN
    assert model.state.tau == pytest.approx((SPIN * k / J - k, SPIN * k / J))
