"""Held stands with friction and stops of every kind of freedom, for tests of these laws."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core.lower.law_arrays import LawArrays
from mahovik.core.stand import Stand, dumps, loads
from mahovik.core.stand.model import Law, State
from mahovik.core.stand.random import random_state
from mahovik.errors import StandError
from mahovik.proof import reference
from mahovik.proof.verify.c_backend import CBackend
from second.agreement import AGREEMENT, worst_difference

BODIES = """
schema = 1
name = "held"
gravity = [0, 0, -9.81]
[carrier]
mass = 2.0
center_of_mass = [0, 0.01, 0.05]
inertia = [0.02, 0.03, 0.01]
inertia_about = "center_of_mass"
[[flywheel]]
name = "w1"
axis = [0, 1, 0]
zero = [0, 0, 1]
mass = 0.5
spin_inertia = 1e-3
transverse_inertia = 6e-4
unbalance = { static = "4 g cm", dynamic = "9 g cm^2" }
"""

POSE = "pivot = [0.1, -0.2, 0.3]\nposition = [0.3, 0.1, 0.2]\nangles = [0.1, 0.2, 0.3]\n"

HOLDS = {
    "rail": 'freedoms = ["x"]\nposition = [0.3, 0.1, 0.2]\nangles = [0.1, 0.2, 0.3]\n',
    "skew rail": "slide = [1, -2, 2]\n",
    "hinge": 'freedoms = ["pitch"]\n' + POSE,
    "skew hinge": "axis = [1, 2, 4]\n" + POSE,
    "plane": 'freedoms = ["x", "z", "pitch"]\n' + POSE,
    "cylinder": 'freedoms = ["y", "pitch"]\n' + POSE,
    "ball": 'freedoms = ["roll", "pitch", "yaw"]\n' + POSE,
    "basis": "basis = [[1, 0.2, 0, 0, 0, 1], [0, 1, 1, 0.3, 0, 0]]\n",
}


def held_stand(hold: str, tables: str = "") -> Stand:
    """A stand with one flywheel; `hold` names one of HOLDS or is text of its own."""
    return loads(f"{BODIES}[hold]\n{HOLDS.get(hold, hold)}{tables}")


def table(kind: str, **keys: Any) -> str:
    """A table of the hold as text."""
    lines = (f'{key} = "{value}"' if isinstance(value, str) else f"{key} = {value}" for key, value in keys.items())
    return f"[[hold.{kind}]]\n" + "\n".join(lines) + "\n"


FRICTION = {
    "rail": table("friction", viscous="3 N s/m", coulomb="2 N", breakaway=3, stribeck_speed="50 mm/s"),
    "skew rail": table("friction", coulomb=2),
    "hinge": table("friction", viscous="0.2 N m s/rad", coulomb="1 N m", smoothing="1 rpm"),
    "skew hinge": table("friction", freedom="1", breakaway=3, stribeck_speed=0.5),
    "plane": table("friction", freedom="z", viscous=0.2) + table("friction", freedom="pitch", coulomb=0.7),
    "cylinder": table("friction", freedom="pitch", breakaway=1, stribeck_speed=2),
    "ball": table("friction", freedom="yaw", viscous=0.01, coulomb=0.2),
    "basis": table("friction", freedom="2", viscous=0.4, coulomb=0.3, breakaway=0.6, stribeck_speed=0.3),
}
"""Tables of friction for each hold of HOLDS."""

STOPS = {
    "rail": table("stop", at="-10 mm", stiffness="10 N/mm", damping=100) + table("stop", at="10 mm", stiffness=900),
    "skew rail": table("stop", at=0.0, side="above", stiffness=30),
    "hinge": table("stop", at="-20 deg", side="above", stiffness="5 N m/deg", damping=3)
    + table("stop", at="-120 deg", stiffness=4),
    "skew hinge": table("stop", at=2, side="below", stiffness=7, damping=0.3) + table("stop", at=2.5, stiffness=9),
    "plane": table("stop", freedom="pitch", at="10 deg", side="above", stiffness=40)
    + table("stop", freedom="3", at="-150 deg", stiffness=30),
    "cylinder": table("stop", freedom="y", at=0.1, stiffness=50, damping=3)
    + table("stop", freedom="pitch", at=-0.1, stiffness=20)
    + table("stop", freedom="pitch", at=2.9, stiffness=10, damping=1),
}
"""Tables of stops for each hold that has a coordinate."""


def agree(stand: Stand, seeds: Sequence[int]) -> None:
    """The literal reference, the second derivation and the compiled C answer alike, and the file comes back."""
    from mahovik.proof.second import Second

    assert loads(dumps(stand)) == stand
    backend, second = CBackend(stand), Second(stand)
    for seed in seeds:
        state = random_state(stand, np.random.default_rng(seed))
        assert worst_difference(stand, state, second.evaluate, backend.evaluate) <= AGREEMENT


def enclosed(stand: Stand, state: State) -> None:
    """F of (7) in balls is that of the literal reference."""
    from mahovik.proof.verify import rigorous
    from rigorous.balls import middles

    F = rigorous.evaluate(rigorous.exact_at(stand, state), "matrices")["F"]
    np.testing.assert_allclose(middles(F), reference.pieces(stand, state).F, rtol=1e-9, atol=1e-12)


def moved(document: dict[str, Any], speed: float, until: float, **more: Any) -> Any:
    """A run of a stand of one freedom from the home pose at a speed, in short steps."""
    import mahovik
    from simulate.runs import columns

    stand = mahovik.Stand.from_dict(document)
    return columns(stand, until, start={"u": [speed]}, **{"dt": 1e-4, "every": 0.01, **more})


def rail(mass: float, **hold: Any) -> dict[str, Any]:
    """A mass on a rail along x, without weight."""
    return {
        "schema": 1,
        "name": "rail",
        "carrier": {"mass": mass, "inertia": [0.1, 0.1, 0.1]},
        "hold": {"freedoms": ["x"], **hold},
    }


def refused(hold: str, tables: str, words: str) -> None:
    """The stand is refused in one line, which names the place and what was found."""
    with pytest.raises(StandError) as caught:
        held_stand(hold, tables)
    assert words in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


def compare_slopes(stand: Stand, law: type[Law], kind: str, seed: int, slower: float = 1.0) -> Any:
    """The wrench of a law on arrays is the literal one, and its slopes are differences of it over small steps.

    `kind` is how its terms in the reference begin. The slopes (6, 12) are compared, and returned, at the pose of a
    random state and at its twist divided by `slower`.
    """
    laws = LawArrays(replace(stand, laws=tuple(one for one in stand.laws if isinstance(one, law))))
    pieces = reference.pieces(stand, state := random_state(stand, np.random.default_rng(seed)))
    place, V = np.array(state.position), pieces.V / slower

    def pose_of(shift: Any, turned: Any, V: Any) -> Any:
        C = pieces.C @ Rotation.from_rotvec(turned).as_matrix()
        return (place + pieces.C @ shift)[None], C[None], V[None]

    zero = np.zeros(3)
    slopes = laws.tied_slopes(*pose_of(zero, zero, V))[0]
    kinds = pieces.terms["carrier"]
    one = sum(wrench for name, wrench in kinds.items() if name.startswith(kind))
    np.testing.assert_allclose(laws.tied(*pose_of(zero, zero, pieces.V))[0], one, rtol=1e-12, atol=1e-13)
    for k, step in enumerate(1e-6 * np.eye(6)):
        ends = [laws.tied(*pose_of(s * step[:3], s * step[3:], V))[0] for s in (1, -1)]
        np.testing.assert_allclose(slopes[:, k], (ends[0] - ends[1]) / 2e-6, rtol=1e-6, atol=1e-7)
        ends = [laws.tied(*pose_of(zero, zero, V + s * step))[0] for s in (1, -1)]
        np.testing.assert_allclose(slopes[:, 6 + k], (ends[0] - ends[1]) / 2e-6, rtol=1e-6, atol=1e-7)
    return slopes
