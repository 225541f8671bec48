"""The states of a verification: ordinary and extreme ones, the same for the same seed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np

from mahovik.contract.laws import parts
from mahovik.contract.limits import PERTURBATION
from mahovik.contract.quantities import limits_of
from mahovik.core.stand.hold import twist_of
from mahovik.core.stand.model import Stand, State
from mahovik.core.stand.random import EXTREMES, extreme_state, random_state
from mahovik.errors import UsageError, whole_number
from mahovik.proof.reference.pieces import CarrierReference
from mahovik.proof.verify.scales import Scales
from mahovik.proof.verify.states import HELD_KEYS, INPUTS, actuators_of

TURNED = 8.0
"""Least distance from a half turn, rad, over the change by which scales are measured: no neighbour is beyond it, where
a law turns back in the other sense."""

LEAST_EXPONENT = {"double": -310, "float": -43}
"""Least decimal exponent of a number in a state; below 1e-308, in float 1e-38, numbers are subnormal."""

REDRAWN = 3
"""How often a state is drawn anew where rounding decides a word of its answer."""


def draw(stand: Stand, seed: int, count: int, real: str = "double") -> list[tuple[str, State]]:
    """`count` states with their names, `KIND NUMBER`: two ordinary, one extreme, and so on.

    For float every number is one of float, but for the quaternion: it has unit length in double.
    """
    check_drawing(seed, count, real)
    rng = np.random.default_rng(seed)
    kinds = zip(range(count), _state_kinds(), strict=False)
    return [(f"{kind} {number}", _draw_one(stand, rng, kind, real)) for number, kind in kinds]


def _draw_one(stand: Stand, rng: np.random.Generator, kind: str, real: str) -> State:
    """A state that is near no branch, as the element type has it."""
    state = _draw_state(stand, rng, kind, real)
    while _near_a_branch(stand, state, TURNED * PERTURBATION[real]):
        state = _draw_state(stand, rng, "random", real)
    return round_to_float(stand, state) if real == "float" else state


def check_drawing(seed: int, count: int, real: str) -> None:
    """Raises UsageError: no states can be drawn so."""
    whole_number("states", count)
    whole_number("seed", seed, 0)
    if real not in PERTURBATION:
        raise UsageError(f"real: unknown {real!r}, expected one of {', '.join(PERTURBATION)}")


def draw_decided(stand: Stand, scales: Scales, seed: int, count: int, real: str = "double") -> list[tuple[str, State]]:
    """The states of `draw`; one where rounding decides a word of `inverse` is drawn anew, up to REDRAWN times."""
    rng, result = np.random.default_rng((seed, 1)), []
    for name, state in draw(stand, seed, count, real):
        chosen = state
        for _ in range(REDRAWN):
            measured = scales.want(chosen, "inverse")
            if measured is None or not measured.undecided:
                break
            chosen = _draw_one(stand, rng, "random", real)
        result.append((name, chosen))
    return result


def _state_kinds() -> Iterator[str]:
    yield "rest"
    extremes = [kind for kind in EXTREMES if kind != "rest"]
    number = 0
    while True:
        yield from ("random", "random")
        yield extremes[number % len(extremes)]
        number += 1


def _draw_state(stand: Stand, rng: np.random.Generator, kind: str, real: str) -> State:
    if kind in EXTREMES:
        return extreme_state(stand, rng, kind, limits_of("phi", real)[0], LEAST_EXPONENT[real])
    return random_state(stand, rng)


def with_drawn_actuators(stand: Stand, state: State, rng: np.random.Generator) -> State:
    """The state with deflections and speeds of their usual size; itself where the stand has neither."""
    known = actuators_of(stand)
    if not known:
        return state
    sizes = rng.uniform(0.3, 1.0, len(known)) * rng.choice([-1.0, 1.0], len(known))
    settings = {name: float(size * actuator.usual) for (name, actuator), size in zip(known.items(), sizes, strict=True)}
    return replace(state, actuators=MappingProxyType(settings))


def round_to_float(stand: Stand, state: State) -> State:
    """The state with every number but the quaternion rounded to the nearest float, V, V_dot of a held carrier by u."""
    rounded: dict[str, Any] = {}
    for key in (*INPUTS, *HELD_KEYS):
        value = getattr(state, key)
        rounded[key] = None if value is None else _floats(value)
    if stand.hold is not None:
        rounded |= {twist: twist_of(stand.hold, rounded[key]) for key, twist in HELD_KEYS.items()}
    return replace(state, **rounded, wrench=MappingProxyType({name: _floats(w) for name, w in state.wrench.items()}))


def _floats(numbers: Sequence[float]) -> Any:
    return tuple(np.array(numbers, dtype=np.float32).astype(np.float64).tolist())


def _near_a_branch(stand: Stand, state: State, cut: float) -> bool:
    """Whether some law is nearer than `cut` (rad) to a state with two right answers."""
    margins = (law.margin for law in parts("reference", CarrierReference))
    return any(margin(stand, state) < cut for margin in margins if margin is not None)
