"""Models for tests, each compiled once a run, and states for them."""

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

import mahovik
from mahovik.core.stand import Stand, State
from mahovik.core.stand.random import BARE, EVERYTHING, Features, random_stand, random_state
from mahovik.core.toolchain.compiled import Real
from mahovik.proof.verify.c_backend import CBackend

Arrays = dict[str, NDArray[Any]]


@cache
def stand(name: str) -> Stand:
    """A stand by name: of some kinds of wrench, of all of them, a rigid body, or an example."""
    rng = np.random.default_rng(5)
    if name == "general":
        return random_stand(
            rng, 2, Features("aircraft", 1, True, False, False, 1, True, False, {"suspension": 0, "leg": 0}), name
        )
    if name == "everything":
        return replace(random_stand(rng, 2, EVERYTHING, name), angles="euler")
    if name == "rigid":
        return random_stand(rng, 0, BARE, name)
    return mahovik.example(name)


@cache
def model(name: str, real: Real = "double") -> mahovik.Model:
    """The model of a stand by name, compiled once a run."""
    return mahovik.build(stand(name), real=real)


@cache
def backend(name: str) -> CBackend:
    """The C of a stand by name, called for one state after the other."""
    return CBackend(stand(name))


def random_states(name: str, count: int, seed: int = 1) -> list[State]:
    """Random states of the evaluation contract."""
    rng = np.random.default_rng(seed)
    return [random_state(stand(name), rng) for _ in range(count)]


def api_inputs(name: str, states: list[State]) -> tuple[mahovik.States, Arrays, Arrays | None]:
    """States, inputs and run-time wrenches of the Python interface, from states of the evaluation contract."""
    m = model(name)
    attitudes: list[dict[str, Any]] = [
        {"angles": s.angles} if s.angles else {"attitude": s.quaternion} if s.quaternion else {} for s in states
    ]
    parts = [
        m.state(position=s.position, V=s.V, phi=s.phi, phi_dot=s.phi_dot, **attitude).array
        for s, attitude in zip(states, attitudes, strict=True)
    ]
    inputs = {key: np.array([getattr(s, key) for s in states]) for key in ("V_dot", "phi_ddot", "tau")}
    wrench = {body: np.array([s.wrench[body] for s in states]) for body in m.wrenches}
    return m.states_of(np.array(parts)), inputs, wrench or None
