"""The state that an FMU begins in unless it is told another."""

from __future__ import annotations

import math

from mahovik.emit.generate import Generated
from mahovik.errors import CheckError
from mahovik.lower.fmu.variables import Start
from mahovik.program.interpret import Interpreter
from mahovik.stand.model import Stand
from mahovik.stand.state import State
from mahovik.study.rest import rest


def start_of(stand: Stand, state: State | None, generated: Generated) -> Start:
    """That of a state; without one the static equilibrium, flywheels at rest. Raises CheckError where there is none."""
    if state is None:
        try:
            state = rest(stand).state
        except CheckError as error:
            raise CheckError(f"{error}; give a state to begin with by --start") from None
    attitude = state.quaternion
    if attitude is None:
        angles = state.angles or (0.0, 0.0, 0.0)
        attitude = Interpreter(generated.program).run("quaternion", {"angles": angles})[1]["attitude"]
    length = math.hypot(*attitude)
    unit = [float(c) / length for c in attitude]
    return Start(state.position, unit, state.V, state.phi, state.phi_dot)
