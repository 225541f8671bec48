"""What residuals and errors are measured by: norms that no choice of units, origin or axes changes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.forward import bias
from mahovik.proof.verify.programme.along import pieces_at, twist, twist_rate

_PHASES = 2 * np.pi * np.arange(4) / 4
"""K and F are sums over the flywheels of harmonics up to the second: these four phases give their means exactly."""


@dataclass(frozen=True, eq=False)
class Scale:
    """K0 (6x6): mean of K over the phases. `wrench`: max of |K0^-1/2 (P - mean P)|; `amplitude`, `speed`: max of
    |K0^1/2 x| for displacements from the mean pose and for twists along the motion.
    """

    K0: Array
    wrench: float
    amplitude: float
    speed: float

    def of_wrench(self, R: Array) -> float:
        """|K0^-1/2 R| of a wrench (6), as a share."""
        return math.sqrt(max(float(R @ np.linalg.solve(self.K0, R)), 0.0)) / self.wrench

    def of_displacement(self, x: Array) -> float:
        """|K0^1/2 x| of a small displacement (6; m, rad; in E1 about O1), as a share."""
        return norm(self.K0, x) / self.amplitude

    def of_twist(self, V: Array) -> float:
        """|K0^1/2 V| of a twist (6), as a share."""
        return norm(self.K0, V) / self.speed

    def lengths(self) -> tuple[float, float]:
        """A displacement in m and a turn in rad that are each the whole amplitude."""
        return self.amplitude / math.sqrt(self.K0[0, 0]), self.amplitude / math.sqrt(np.trace(self.K0[3:, 3:]) / 3)


def norm(K0: Array, x: Array) -> float:
    """|K0^1/2 x|."""
    return math.sqrt(max(float(x @ K0 @ x), 0.0))


def scale_of(stand: Stand, motion: RequiredMotion, programme: Programme) -> Scale:
    """The scales of a required motion. For a carrier held still they are those of the flywheels' own unbalance."""
    fastest = max(motion.harmonics, default=1) if motion.periodic else 12
    M = min(max(32, 16 * fastest), 512)
    t = motion.span * np.arange(M) / M
    course = motion.at(t, programme.bias)
    mean = course.q.mean(axis=0)
    N = len(stand.flywheels)
    locked = [pieces_at(stand, mean, np.zeros(6), np.full(N, phase), np.zeros(N)) for phase in _PHASES]
    K0 = np.mean([at.K for at in locked], axis=0)
    still = not np.any(course.q_dot)
    if still:
        I = np.mean([np.abs(at.I) for at in locked], axis=0)
        omega = 2 * math.pi * max(1, *(abs(n) for n in programme.winding)) / motion.span
        m = math.sqrt(K0[0, 0])
        first_moments = sum(s.mass * math.hypot(*s.center_of_mass[1:]) for s in stand.flywheels)
        wrench = first_moments * omega**2 / m or max(norm(np.linalg.inv(K0), each) for each in I.T) * omega**2
        return Scale(K0, wrench, wrench / omega**2, wrench / omega)
    P = []
    amplitude = speed = 0.0
    for q, q_dot, q_ddot in zip(*course, strict=True):
        V, V_dot = twist(stand, q, q_dot), twist_rate(stand, q, q_dot, q_ddot)
        needed = [pieces_at(stand, q, V, np.full(N, phase), np.zeros(N)) for phase in _PHASES]
        P.append(np.mean([at.F - at.K @ at.V_r_dot(V_dot) - bias(at) for at in needed], axis=0))
        amplitude = max(amplitude, norm(K0, twist(stand, q, q - mean)))
        speed = max(speed, norm(K0, V))
    K0_inverse = np.linalg.inv(K0)
    wrench = max(norm(K0_inverse, each) for each in np.array(P) - np.mean(P, axis=0))
    return Scale(K0, wrench, amplitude, speed)
