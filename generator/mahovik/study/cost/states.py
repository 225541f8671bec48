"""The states on which functions are measured: ordinary ones, the same for every target."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.emit.generate import Generated
from mahovik.program.interpret import Interpreter
from mahovik.stand.model import Stand
from mahovik.stand.random_state import random_state

STATES = 4
"""How many; the dearest of them is reported."""

_STEP = 1e-3
"""s; of `step`."""


def measuring_states(stand: Stand, generated: Generated) -> list[dict[str, Any]]:
    """Arguments of the public functions by name, a dict a state. The states are random, seed 1."""
    rng = np.random.default_rng(1)
    program = Interpreter(generated.program)
    found = []
    for _ in range(STATES):
        state = random_state(stand, rng)
        angles = state.angles or (0.3, 0.2, -0.4)
        attitude = state.quaternion or program.run("quaternion", {"angles": angles})[1]["attitude"]
        x = {"position": state.position, "attitude": attitude, "V": state.V, "phi": state.phi}
        x |= {"phi_dot": state.phi_dot, "sine": np.sin(state.phi), "cosine": np.cos(state.phi)}
        wrench = [number for body in generated.layout.inputs for number in state.wrench[body]]
        found.append(
            {
                "x": x,
                "phi_ddot": state.phi_ddot,
                "V_dot": state.V_dot,
                "tau": state.tau,
                "wrench": wrench,
                "locked": [0] * len(state.phi),
                "angles": angles,
                "position": state.position,
                "dt": _STEP,
                "q_dot": state.V,
                "q_ddot": state.V_dot,
            }
        )
    return found
