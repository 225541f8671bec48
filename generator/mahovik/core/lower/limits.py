"""Ranges that the emitted C accepts (stand.md, *Evaluation*), as named constants of the program."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.program.expression import Const
from mahovik.core.program.types import Kind, Precision


@dataclass(frozen=True)
class Limit:
    """A named bound on the magnitude of an input."""

    name: str
    value: float
    unit: str
    comment: str

    @property
    def expression(self) -> Const:
        return Const(self.value, Kind.REAL, self.name)


def limits(precision: Precision) -> dict[str, Limit]:
    """All bounds by name. Phases: a float has no digits left for large angles, wrap them first."""
    table = [
        Limit("MAX_POSITION", 1e6, "m", "each component of the position of O1"),
        Limit("MAX_VELOCITY", 1e4, "m/s", "each component of v"),
        Limit("MAX_SPEED", 1e5, "rad/s", "each component of omega, each phi_dot"),
        Limit("MAX_PHASE", precision.max_phase, "rad", "each phase and attitude angle"),
        Limit("MAX_ACCELERATION", 1e9, "rad/s2", "each phi_ddot"),
        Limit("MAX_WRENCH", 1e9, "N, N m", "each component of a run-time wrench"),
        Limit("MAX_STEP", 10.0, "s", "a time step"),
        Limit("MAX_PARAMETER", 1e15, "SI", "each mass, length and moment of inertia"),
        Limit("MAX_WEIGHT", 1e6, "", "the weight of a flywheel in inverse"),
        Limit("LARGEST", precision.largest, "", "largest finite number"),
    ]
    return {limit.name: limit for limit in table}


BOUND_OF = {
    "position": "MAX_POSITION",
    "V": "MAX_VELOCITY",
    "phi": "MAX_PHASE",
    "angles": "MAX_PHASE",
    "phi_dot": "MAX_SPEED",
    "phi_ddot": "MAX_ACCELERATION",
    "V_dot": "MAX_ACCELERATION",
    "tau": "MAX_WRENCH",
    "wrench": "MAX_WRENCH",
    "q_dot": "MAX_VELOCITY",
    "q_ddot": "MAX_ACCELERATION",
    "dt": "MAX_STEP",
    "stream": "MAX_VELOCITY",
    "weight": "MAX_WEIGHT",
    "limit": "MAX_ACCELERATION",
}
"""Inputs by name, and the bound of each component in `limits`; the angular half of V has MAX_SPEED."""

UNIT_SQUARE_MIN = 0.998001
UNIT_SQUARE_MAX = 1.002001
"""Square of a length within 1e-3 of 1: of a quaternion, or of (sine, cosine)."""

SINGULAR_BELOW = 1e-6
"""|cos theta| (Euler: |sin theta|) below which A of (10) is refused as singular."""

ZERO_LENGTH = 1e-9
"""m; a leg shorter than this has no direction."""

SMALL_SQUARE = 1e-30
"""Square of a length or half angle below which its direction is taken from a series, or refused."""
