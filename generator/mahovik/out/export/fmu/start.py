"""Default initial state of an FMU."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mahovik.core.emit.generate import Generated
from mahovik.core.lower.fmu.variables import Start
from mahovik.core.program.interpret import Interpreter
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import CheckError
from mahovik.use.study.rest import rest

_DECIMALS = 12
"""Decimals kept of an equilibrium: its last bits depend on the machine's linear algebra."""


def start_of(stand: Stand, state: State | None, generated: Generated) -> Start:
    """Start of a state; without one, the static equilibrium with flywheels at rest. CheckError: there is none."""
    if state is not None:
        return Start(state.position, _unit(state, generated), state.V, state.phi, state.phi_dot)
    try:
        found = rest(stand).state
    except CheckError as error:
        raise CheckError(f"{error}; give an initial state by --start") from None
    position, attitude = _rounded(found.position), _rounded(_unit(found, generated))
    return Start(position, attitude, found.V, found.phi, found.phi_dot)


def _unit(state: State, generated: Generated) -> list[float]:
    """The attitude as a quaternion, w first, of unit length."""
    quaternion: Sequence[float] | None = state.quaternion
    if quaternion is None:
        angles = state.angles or (0.0, 0.0, 0.0)
        quaternion = Interpreter(generated.program).run("quaternion", {"angles": angles})[1]["attitude"]
    length = math.hypot(*quaternion)
    return [float(c) / length for c in quaternion]


def _rounded(values: Sequence[float]) -> list[float]:
    return [round(float(x), _DECIMALS) + 0.0 for x in values]
