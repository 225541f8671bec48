"""target and inverse_fast: (10) against the reference, and the cheap inverse against the careful one."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.stand.model import Sequence
from mahovik.core.stand.random import BARE, random_stand
from mahovik.proof.verify.c_backend import CBackend
from toolchain.quick import quick


@cache
def of_sequence(angles: Sequence) -> CBackend:
    """A small stand with that sequence of angles."""
    from dataclasses import replace

    return CBackend(replace(random_stand(np.random.default_rng(3), 1, BARE, name="turned"), angles=angles))


@pytest.mark.parametrize("theta", quick(1, [0.7, -2.5, 2.5, -0.7]))
@pytest.mark.parametrize("angles", ["ship", "aircraft", "euler"])
def test_state_from_coordinates_inverts_the_generalized_form(angles: str, theta: float) -> None:
    """The q' and q'' of V, V* lead back to V, V*, on both sides of the singularities."""
    c = of_sequence(angles)
    rng = np.random.default_rng(4)
    x = {"position": [1.0, 2.0, 3.0], "attitude": [1.0, 0, 0, 0], "V": list(rng.normal(size=6))}
    x |= {"phi": [0.3], "phi_dot": [10.0]}
    at = [0.4, theta, -0.2]
    inputs = {"table": c.library.default("default"), "x": x, "phi_ddot": [5.0]}
    generalized = c.call("generalized", inputs | {"angles": at})[1]["out"]
    quaternion = c.call("quaternion", {"angles": at})[1]["attitude"]
    forward = c.call("forward", inputs | {"x": x | {"attitude": quaternion}})[1]["V_dot"]
    asked = {
        "position": [4.0, 5.0, 6.0],
        "angles": at,
        "q_dot": generalized["q_dot"],
        "q_ddot": generalized["q_ddot"],
        "x": x,
    }
    status, out = c.library.run(c.program.function("state_from_coordinates"), asked)
    assert status == 0
    assert out["x"]["position"] == [4.0, 5.0, 6.0]
    assert out["x"]["attitude"] == quaternion
    assert out["x"]["phi"] == x["phi"]
    # one multiplication by A and its inverse: some units in the last place of numbers of order 1 to 100
    assert np.array(out["x"]["V"]) == pytest.approx(np.array(x["V"]), abs=1e-13)
    assert np.array(out["V_dot"]) == pytest.approx(np.array(forward), rel=1e-12, abs=1e-12 * np.abs(forward).max())


@pytest.mark.parametrize(("angles", "theta"), [("ship", np.pi / 2), ("aircraft", -np.pi / 2), ("euler", 0.0)])
def test_a_singular_attitude_is_refused(angles: str, theta: float) -> None:
    c = of_sequence(angles)
    x = {"position": [0.0] * 3, "attitude": [1.0, 0, 0, 0], "V": [0.0] * 6, "phi": [0.0], "phi_dot": [0.0]}
    asked = {"position": [0.0] * 3, "angles": [0.1, theta, 0.2], "q_dot": [0.0] * 6, "q_ddot": [0.0] * 6, "x": x}
    status, out = c.library.run(c.program.function("state_from_coordinates"), asked, fill=7.5)
    assert status == STATUS_VALUES["SINGULAR_ATTITUDE"]
    assert out["x"] == x
    assert out["V_dot"] == [7.5] * 6
