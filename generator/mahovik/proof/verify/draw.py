"""The states of a verification: ordinary and extreme ones, the same for the same seed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from mahovik import laws
from mahovik.contract.quantities import QUANTITIES, limits_of
from mahovik.core.stand.model import Stand, Vec6
from mahovik.core.stand.random_state import EXTREMES, extreme_state, random_state, random_wrenches
from mahovik.core.stand.state import State

CUT = {"double": 1e-6, "float": 1e-5}
"""rad; nearer than this to a half turn, rounding decides which way a law turns it back."""

LEAST_EXPONENT = {"double": -310, "float": -43}
"""Exponents of the tiniest numbers drawn; those below 1e-308, in float 1e-38, are subnormal."""


def draw(stand: Stand, seed: int, count: int, real: str = "double", wrenches: bool = True) -> list[tuple[str, State]]:
    """`count` states with their names, `KIND NUMBER`: two ordinary, one extreme, and so on.

    Every fourth ordinary one has a run-time wrench on every body, where `wrenches` allows it. For float every number
    is one of float, but for the quaternion: it has unit length in double.
    """
    found = []
    rng = np.random.default_rng(seed)
    for number, kind in zip(range(count), _kinds(), strict=False):
        state = _one(stand, rng, kind, real)
        while _near_a_branch(stand, state, CUT[real]):
            state = _one(stand, rng, "random", real)
        if not wrenches and kind == "wrenched":
            state = replace(state, wrench=MappingProxyType({}))
        found.append((f"{kind} {number}", rounded(state) if real == "float" else state))
    return found


def _kinds() -> Iterator[str]:
    yield "rest"
    extremes = [kind for kind in EXTREMES if kind != "rest"]
    number = 0
    while True:
        yield "random"
        yield "wrenched" if number % 2 else "random"
        yield extremes[number % len(extremes)]
        number += 1


def _one(stand: Stand, rng: np.random.Generator, kind: str, real: str) -> State:
    if kind in EXTREMES:
        return extreme_state(stand, rng, kind, limits_of("phi", real)[0], LEAST_EXPONENT[real])
    state = random_state(stand, rng)
    if kind == "wrenched":
        return replace(state, wrench=random_wrenches(rng, [body.name for body in stand.bodies]))
    return state


def rounded(state: State) -> State:
    """The state with every number but the quaternion rounded to the nearest float."""
    keys = [row.symbol for row in QUANTITIES.values() if row.input and row.symbol != "wrench"]
    given = {key: getattr(state, key) for key in keys}
    found: dict[str, Any] = {key: None if value is None else tuple(map(_float, value)) for key, value in given.items()}
    wrench = {name: cast(Vec6, tuple(map(_float, value))) for name, value in state.wrench.items()}
    return replace(state, **found, wrench=MappingProxyType(wrench))


def _float(number: float) -> float:
    return float(np.float32(number))


def _near_a_branch(stand: Stand, state: State, cut: float) -> bool:
    """Whether some law is nearer than `cut` (rad) to where two answers are equally right."""
    return any(law.margin(stand, state) < cut for law in laws.parts("reference") if hasattr(law, "margin"))
