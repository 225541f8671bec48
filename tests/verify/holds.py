"""Holds of every kind, random stands that are held so, and the comparison of two answers at a state of them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.stand.hold import FREEDOMS, twist_of
from mahovik.core.stand.model import Freedom, Hold, Stand, State
from mahovik.core.stand.random import BARE, EVERYTHING, Features, random_stand, random_state
from mahovik.proof.verify.backends import NumpyBackend

PIVOT = (0.3, -0.2, 0.15)
HOLDS: dict[str, tuple[Freedom, ...]] = {
    "clamped": (),
    "hinge": (Freedom("turn", (1.0, -2.0, 0.5)),),
    "knife edge": tuple(
        Freedom("twist", twist=twist) for twist in ((1.0, 0.2, 0.0, 0.0, 0.0, 0.3), (-0.2, -0.3, 0.0, 0.0, 0.0, 1.0))
    ),
    "ball joint": (FREEDOMS["roll"], FREEDOMS["pitch"], FREEDOMS["yaw"]),
    "all but one": tuple(FREEDOMS[name] for name in ("z", "x", "y", "pitch", "roll")),
    "free": tuple(FREEDOMS.values()),
}
DRY = replace(BARE, gravity=True, instruments=1, points=1, wrench_inputs=True)
WET = replace(EVERYTHING, tasks=0)

PENDULUM = """
schema = 1
name = "pendulum"
gravity = [0, 0, -9.81]
[hold]
freedoms = ["pitch"]
pivot = [0, 0, -0.2]
[carrier]
mass = 2
inertia = [0.02, 0.02, 0.01]
[[flywheel]]
name = "w1"
axis = [0, 1, 0]
zero = [0, 0, 1]
mass = 0.5
spin_inertia = 0.001
transverse_inertia = 0.0006
[[point]]
name = "tip"
position = [0, 0, 0.1]
"""


def random_held_stand(name: str, seed: int, features: Features = DRY, flywheels: int = 3) -> Stand:
    """A random stand that is held so."""
    return held_by(HOLDS[name], seed, features, flywheels)


def held_by(freedoms: tuple[Freedom, ...], seed: int, features: Features = DRY, flywheels: int = 3) -> Stand:
    """A random stand with these freedoms."""
    stand = random_stand(np.random.default_rng(seed), flywheels, features)
    return replace(stand, hold=Hold(freedoms, PIVOT, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)))


def state_of(stand: Stand, seed: int) -> State:
    """A moderate state of a held stand."""
    assert stand.hold is not None
    rng = np.random.default_rng(seed)
    u, u_dot = (tuple(rng.normal(size=len(stand.hold.freedoms)).tolist()) for _ in range(2))
    state = replace(random_state(stand, rng, phase_limit=3.0), u=u, u_dot=u_dot)
    return replace(state, V=twist_of(stand.hold, u), V_dot=twist_of(stand.hold, u_dot))


def worst(answer: dict[str, Any], other: dict[str, Any]) -> float:
    """Largest difference of two answers, by the largest number of each quantity; of a screw, of each half."""
    off = 0.0
    for name in answer.keys() & other.keys():
        a, b = np.array(answer[name]), np.array(other[name])
        assert a.shape == b.shape, name
        for one, two in zip(np.split(a, 2), np.split(b, 2), strict=True) if a.shape == (6,) else ((a, b),):
            scale = float(np.abs(two).max(initial=0.0))
            off = max(off, float(np.abs(one - two).max(initial=0.0)) / scale if scale else float(np.any(one)))
    return off


def agree(stand: Stand, state: State, backend: Any, judge: Any, want: str, most: float) -> None:
    """Both answers to a want are equal; a reaction by what it balances, which may be far larger: K V*."""
    answer, other = backend.evaluate(state, [want]), judge.evaluate(state, [want])
    assert answer.keys() == other.keys()
    for name, reading in answer.pop("points", {}).items():
        assert worst(reading, other["points"][name]) < most
    if "reaction" in answer:
        K = NumpyBackend(stand).evaluate(state, ["matrices"])["K"]
        left = answer.pop("reaction") - np.array(other.pop("reaction"))
        for half in (slice(0, 3), slice(3, 6)):
            scale = float(np.abs(K[half]) @ np.abs(other.get("V_dot", state.V_dot)) @ np.ones(3))
            assert np.abs(left[half]).max() <= most * max(scale, 1.0), (want, "reaction")
    assert not answer or worst(answer, other) < most, want
