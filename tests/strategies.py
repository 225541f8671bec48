"""Hypothesis strategies of random general physical stands and their states: the one place for them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np
from hypothesis import strategies as st

from mahovik.contract.laws import LAWS
from mahovik.core.stand import Stand, State
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Freedom, Hold
from mahovik.core.stand.random import (
    EXTREMES,
    MAX_PHASE,
    SEQUENCES,
    Features,
    extreme_state,
    random_stand,
    random_state,
)

_SEEDS = st.integers(0, 2**32 - 1)


def features(
    *,
    fluid: bool | None = None,
    gravity: bool | None = None,
    stream: bool | None = None,
    instruments: int | None = None,
    points: int | None = None,
    wrench_inputs: bool | None = None,
    motors: bool | None = None,
    laws: Mapping[str, int] = MappingProxyType({}),
) -> st.SearchStrategy[Features]:
    """Strategy for the kinds of wrench and body of a stand; those not given are drawn and shrink to absent."""

    def flag(wanted: bool | None) -> st.SearchStrategy[bool]:
        return st.booleans() if wanted is None else st.just(wanted)

    def count(wanted: int | None) -> st.SearchStrategy[int]:
        return st.integers(0, 2) if wanted is None else st.just(wanted)

    return st.builds(
        Features,
        angles=st.sampled_from(SEQUENCES),
        instruments=count(instruments),
        gravity=flag(gravity),
        stream=flag(stream),
        fluid=flag(fluid),
        points=count(points),
        wrench_inputs=flag(wrench_inputs),
        motors=flag(motors),
        laws=st.fixed_dictionaries({law: count(laws.get(law)) for law in LAWS}),
    )


@st.composite
def stands(draw: st.DrawFn, /, min_flywheels: int = 0, max_flywheels: int = 8, **options: Any) -> Stand:
    """General stands; what `features` takes is drawn if not given. Every body is a cloud of points off its origin."""
    has = draw(features(**options))
    flywheels = draw(st.integers(min_flywheels, max_flywheels))
    return random_stand(np.random.default_rng(draw(_SEEDS)), flywheels, has)


@st.composite
def held_stands(draw: st.DrawFn, min_flywheels: int = 0, max_flywheels: int = 4, *, clamped: bool = True) -> Stand:
    """General stands with a hold of every kind: named freedoms, an axis, a rail, any basis, and clamped if allowed."""
    stand = draw(stands(min_flywheels, max_flywheels))
    rng = np.random.default_rng(draw(_SEEDS))
    a, b, c = rng.normal(size=3).tolist()
    kind = draw(st.sampled_from(("named", "axis", "slide", "basis")))
    if kind == "named":
        names = draw(st.lists(st.sampled_from(tuple(FREEDOMS)), min_size=0 if clamped else 1, unique=True))
        freedoms = tuple(FREEDOMS[name] for name in names)
    elif kind == "basis":
        rows = rng.normal(size=(draw(st.integers(1, 3)), 6)).tolist()
        freedoms = tuple(Freedom("twist", twist=tuple(row)) for row in rows)
    else:
        freedoms = (Freedom("turn" if kind == "axis" else "slide", (a, b, c)),)
    turns = any(freedom.kind == "turn" for freedom in freedoms)
    x, y, z = rng.normal(scale=0.3, size=3).tolist()
    still = (0.0, 0.0, 0.0)
    return replace(stand, tasks=(), hold=Hold(freedoms, (x, y, z) if turns else still, still, still))


def states(stand: Stand, *, extreme: bool = False, phase_limit: float = MAX_PHASE) -> st.SearchStrategy[State]:
    """States of `stand` with inputs; with `extreme`, of every kind in EXTREMES as well."""

    def build(seed: int, kind: str | None) -> State:
        rng = np.random.default_rng(seed)
        return random_state(stand, rng) if kind is None else extreme_state(stand, rng, kind, phase_limit)

    kinds = st.sampled_from((None, *EXTREMES)) if extreme else st.none()
    return st.builds(build, _SEEDS, kinds)
