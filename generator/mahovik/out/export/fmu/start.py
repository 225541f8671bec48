"""The state that an FMU begins in unless it is told another."""

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
"""Of an equilibrium: it is sought by linear algebra, whose last bits are those of a machine."""


def start_of(stand: Stand, state: State | None, generated: Generated) -> Start:
    """That of a state; without one the static equilibrium, flywheels at rest. Raises CheckError where there is none."""
    if state is not None:
        return Start(state.position, _unit(state, generated), state.V, state.phi, state.phi_dot)
    try:
        found = rest(stand).state
    except CheckError as error:
        raise CheckError(f"{error}; give a state to begin with by --start") from None
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
