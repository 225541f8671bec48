"""Changes of what a program reads: stand, state, attitude."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.stand.model import Flywheel, Stand
from mahovik.core.stand.state import State
from mahovik.proof.diagnose.fault import Case, Edit
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.rotation import carrier_rotation


def body(change: Callable[[Any], Any]) -> Edit:
    """A body of the stand."""

    def edit(stand: Stand, case: Case) -> Stand:
        def read(each: Any) -> Any:
            return change(each) if case.wrong(each) else each

        carrier, instruments, flywheels = read(stand.carrier), map(read, stand.instruments), map(read, stand.flywheels)
        return replace(stand, carrier=carrier, instruments=tuple(instruments), flywheels=tuple(flywheels))

    return Edit("stand", edit)


def stand(**values: Any) -> Edit:
    """Some values of the stand."""
    return Edit("stand", lambda right, case: replace(right, **values))


def vector(key: str, change: Callable[[Array, Array], Array]) -> Edit:
    """`gravity` or `stream` (3) of the stand, in E0; `change` takes the right one and C (3x3)."""

    def edit(stand: Stand, case: Case) -> Stand:
        right = getattr(stand, key)
        if right is None:
            return stand
        values: dict[str, Any] = {key: tuple(change(np.array(right), carrier_rotation(stand, case.state)))}
        return replace(stand, **values)

    return Edit("stand", edit)


def state(change: Callable[[State], State]) -> Edit:
    """The state."""
    return Edit("state", lambda right, case: change(right))


def twist(change: Callable[[Array, Case], Array]) -> Edit:
    """V (6) of the state."""
    return Edit("state", lambda right, case: replace(right, V=tuple(change(np.array(right.V), case))))


def wheel(key: str, change: Callable[[float], float]) -> Edit:
    """`phi`, `phi_dot` or `phi_ddot` of a flywheel."""
    return wheel_at(key, lambda right, s, case: change(right))


def wheel_at(key: str, change: Callable[[float, Flywheel, Case], float]) -> Edit:
    """The same, where the change depends on the flywheel and the state."""

    def edit(state: State, case: Case) -> State:
        pairs = zip(getattr(state, key), case.stand.flywheels, strict=True)
        values: dict[str, Any] = {key: tuple(change(x, s, case) if case.wrong(s) else x for x, s in pairs)}
        return replace(state, **values)

    return Edit("state", edit)


def attitude(change: Callable[[Array, State], Array]) -> Edit:
    """C (3x3) of the carrier."""
    return Edit("attitude", lambda C, case: change(C, case.state))
