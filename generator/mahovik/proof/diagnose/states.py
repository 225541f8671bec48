"""States at which faults look different from one another: everything at once, then one kind of motion at a time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import cast

import numpy as np
from scipy.linalg import qr

from mahovik.core.stand.model import Stand
from mahovik.core.stand.random_state import in_layer, random_state, random_wrenches
from mahovik.core.stand.state import Quaternion, State
from mahovik.proof.verify.draw import with_drawn_actuators
from mahovik.proof.verify.foreign import Program

FIRST = 3
"""Number of leading states with all features active: every visible fault shows in them, so they suffice to search."""

ALONE = 4
"""Largest number of flywheels that have a state in which they alone turn."""


def separating_states(stand: Stand, seed: int = 1, program: Program | None = None) -> list[tuple[str, State]]:
    """States with their names, the same for the same seed; without the extremes of `verify`, which rounding disturbs.

    `program`: that takes them, in the form in which it is given them.
    """
    rng = np.random.default_rng(seed)
    found = [
        ("all 1", _with_wrenches(stand, _by_angles(stand, rng), rng)),
        ("all 2", _with_wrenches(stand, _by_quaternion(stand, rng), rng)),
        ("all 3", _by_angles(stand, rng)),
    ]
    assert len(found) == FIRST
    N = len(stand.flywheels)
    zeros, zero6 = (0.0,) * N, (0.0,) * 6

    def quiet(state: State) -> State:
        return replace(state, phi_ddot=zeros, V_dot=zero6, tau=zeros)

    states = {
        "at rest": quiet(replace(_by_angles(stand, rng), V=zero6, phi_dot=zeros)),
        "flywheels turn": quiet(replace(_by_angles(stand, rng), V=zero6)),
        "flywheels accelerate": replace(_by_angles(stand, rng), V=zero6, phi_dot=zeros, V_dot=zero6),
        "carrier moves": quiet(replace(_by_angles(stand, rng), phi_dot=zeros)),
        "carrier accelerates": replace(_by_angles(stand, rng), V=zero6, phi_dot=zeros, phi_ddot=zeros),
        "no acceleration": quiet(_by_quaternion(stand, rng)),
    }
    found += states.items()
    for k in range(min(N, ALONE)):
        state = _by_angles(stand, rng)
        alone = tuple(x if i == k else 0.0 for i, x in enumerate(state.phi_dot))
        found.append((f"{stand.flywheels[k].name} turns", replace(state, phi_dot=alone)))
    if stand.profile is not None:  # layer by layer from the lowest
        layers = len(stand.profile.depth) - 1
        found = [(s[0], in_layer(stand, s[1], layers - 1 - k % layers, (0.7, 0.4)[k % 2])) for k, s in enumerate(found)]
    if stand.hold is not None:
        found = [(name, _in_freedoms(state)) for name, state in found]
    if program is not None and program.actuators:
        found = [(name, with_drawn_actuators(stand, state, rng)) for name, state in found]
    return found if program is None else [(name, program.state(stand, state)) for name, state in found]


def _in_freedoms(state: State) -> State:
    """The state of a held carrier with speeds and rates of its freedoms that are zero where V and V_dot are."""
    u, u_dot = state.u if any(state.V) else (0.0,) * len(state.u), state.u_dot
    return replace(state, u=u, u_dot=u_dot if any(state.V_dot) else (0.0,) * len(u_dot))


def _by_angles(stand: Stand, rng: np.random.Generator) -> State:
    """An ordinary state with attitude angles well off their singularity."""
    psi, phi = rng.uniform(-math.pi, math.pi, 2)
    theta = rng.uniform(0.3, 1.2) * rng.choice([-1.0, 1.0])
    return replace(_plain(stand, rng), angles=(float(psi), float(theta), float(phi)), quaternion=None)


def _by_quaternion(stand: Stand, rng: np.random.Generator) -> State:
    q = rng.normal(size=4)
    q /= np.linalg.norm(q)
    return replace(_plain(stand, rng), angles=None, quaternion=cast(Quaternion, tuple(map(float, q))))


def _plain(stand: Stand, rng: np.random.Generator) -> State:
    return replace(random_state(stand, rng), wrench=MappingProxyType({}))


def _with_wrenches(stand: Stand, state: State, rng: np.random.Generator) -> State:
    """The state with a run-time wrench on every body that takes one."""
    return replace(state, wrench=random_wrenches(rng, [body.name for body in stand.bodies if body.wrench_input]))


def spread_rows(states: Sequence[tuple[str, State]], count: int) -> list[tuple[str, State]]:
    """At most `count` rows of a log, spread evenly."""
    return [states[k] for k in np.linspace(0, len(states) - 1, min(count, len(states))).astype(int)]


def telling_rows(states: Sequence[tuple[str, State]], count: int) -> list[tuple[str, State]]:
    """The rows of a log, at most `count`, whose motions differ most from one another; the fullest motion first."""
    motions = np.array([(*s.V, *s.V_dot, *s.phi_dot, *s.phi_ddot) for _, s in states])
    size = np.sqrt(np.mean(motions**2, axis=0))
    scaled = motions / np.where(size > 0.0, size, 1.0)
    left, chosen = list(range(len(states))), list[int]()
    while left and len(chosen) < count:  # those that span all motions; then again of the rows that are left
        triangle, order = qr(scaled[left].T, mode="r", pivoting=True)
        lengths = np.abs(np.diag(triangle))
        rank = max(1, int((lengths > 1e-9 * lengths[0]).sum()))
        chosen += [left[i] for i in order[:rank]]
        left = [i for i in left if i not in chosen]
    fullest = np.minimum(np.abs(scaled[chosen[:count]]), 1.0).sum(axis=1)
    return [states[chosen[i]] for i in np.argsort(-fullest, kind="stable")]
