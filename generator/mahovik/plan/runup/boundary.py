"""The boundary-value problem of a run-up or run-down: where the carrier starts and where it has to end."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.motion.programme import Programme
from mahovik.motion.required import RequiredMotion
from mahovik.plan.array import Array
from mahovik.plan.forward import (
    Carrier,
    Equilibrium,
    apart,
    carrier_at,
    drive,
    equilibrium,
    linearise,
    sensitivity,
    simulate,
)
from mahovik.plan.residual import Mechanics
from mahovik.plan.residual.norm import able_at
from mahovik.plan.runup.fade import SPLINES, Fade, fade


@dataclass(frozen=True, eq=False)
class Amplitude:
    """What errors are shares of: the motion's largest displacement and twist in the norm |root x| of the inertia.

    root    6x6: x^T K0 x = |root x|^2
    """

    root: Array
    displacement: float
    twist: float

    def shares(self, x: Array) -> Array:
        """(M, 12) of displacements and differences of twists (M, 12), dimensionless."""
        return np.hstack([x[:, :6] @ (self.root.T / self.displacement), x[:, 6:] @ (self.root.T / self.twist)])


def amplitude_of(mechanics: Mechanics, motion: RequiredMotion, bias: Array) -> Amplitude:
    """Of a periodic motion; of a carrier held still, what the flywheels can do at the period's frequency."""
    root = np.linalg.cholesky(mechanics.mean_inertia).T
    M = max(64, 16 * max(motion.harmonics, default=1))
    course = motion.at(motion.span * np.arange(M) / M, bias)
    at = carrier_at(mechanics.stand, course)
    mean = mean_pose(mechanics, motion, bias)
    largest = [
        float(np.linalg.norm(x @ root.T, axis=1).max())
        for x in (apart(at, Carrier(*(np.repeat(y, M, axis=0) for y in mean)))[:, :6], at.V)
    ]
    if np.any(course.q_dot):
        return Amplitude(root, *largest)
    Omega = 2.0 * np.pi / motion.span
    able = able_at(mechanics, Omega)
    return Amplitude(root, able / Omega**2, able / Omega)


@dataclass(frozen=True, eq=False)
class _Still:
    """One pose without motion, as coordinates."""

    q: Array
    q_dot: Array
    q_ddot: Array


def mean_pose(mechanics: Mechanics, motion: RequiredMotion, bias: Array) -> Carrier:
    """The one pose mean + bias, at rest."""
    zero = np.zeros((1, 6))
    return carrier_at(mechanics.stand, _Still((motion.mean + bias)[None], zero, zero))


@dataclass(frozen=True, eq=False)
class Course:
    """What B choices of the unknowns lead to: states (n + 1, B), terminal error (B, 12), rests (B)."""

    states: Carrier
    error: Array
    rests: tuple[Equilibrium, ...]


@dataclass(frozen=True, eq=False)
class Boundary:
    """Run-up (`up`) or run-down between rest and the programme's t = 0, simulated in n steps.

    family     at 2 n + 1 times: ends and middles of the steps
    joint      (1 state): the required motion at t = 0
    near       (1 state): mean pose, where rest is looked for
    """

    mechanics: Mechanics
    amplitude: Amplitude
    family: Fade
    joint: Carrier
    near: Carrier
    up: bool

    @property
    def n(self) -> int:
        """Steps; even."""
        return (len(self.family.t) - 1) // 2

    @property
    def step(self) -> float:
        """Of the simulation, s."""
        return float(self.family.t[2] - self.family.t[0])

    def courses(self, c: Array) -> Course:
        """Simulate B choices of the unknowns c (B, N, P). CheckError: there is no rest."""
        angles = self.family.angles(c)
        given = drive(self.mechanics, *angles)
        at_rest = angles[0][0 if self.up else -1]
        rests = tuple(equilibrium(self.mechanics, phi, self.near) for phi in at_rest)
        rest = Carrier(*(np.concatenate(x) for x in zip(*(r.state for r in rests), strict=True)))
        joint = Carrier(*(np.repeat(x, len(c), axis=0) for x in self.joint))
        start, end = (rest, joint) if self.up else (joint, rest)
        with np.errstate(all="ignore"):  # a wild choice may leave the range of numbers: its error is then not finite
            states = simulate(self.mechanics, given, start, self.step)
        final = states[-1]
        error = np.full((len(c), 12), np.inf)
        finite = np.isfinite(final.V).all(axis=1) & np.isfinite(final.C).all(axis=(1, 2))
        error[finite] = self.amplitude.shares(apart(final[finite], end[finite]))
        return Course(states, error, rests)

    def jacobian(self, c: Array, course: Course) -> tuple[Array, Array]:
        """Derivatives of the terminal error (12, N P) by c (N, P), and of displacements (n/2 + 1, 6, N P; in E1).

        By the linearised equations along the simulated course, the whole course at once.
        """
        phi, phi_dot, phi_ddot = (x[::2, 0] for x in self.family.angles(c[None]))
        given = drive(self.mechanics, phi, phi_dot, phi_ddot)
        found = linearise(self.mechanics, given, course.states[:, 0], phi_ddot)
        basis = self.family.basis[:, ::2]
        N, P = c.shape
        push = sum(
            B[:, :, :, None] * b[:, None, None, :]
            for B, b in zip((found.by_phi, found.by_phi_dot, found.by_phi_ddot), basis, strict=True)
        )
        at_rest = course.rests[0].by_phi[:, :, None] * basis[0, 0 if self.up else -1][None, None, :]
        rest = np.vstack([at_rest.reshape(6, N * P), np.zeros((6, N * P))])
        start = rest if self.up else np.zeros_like(rest)
        x = sensitivity(found, np.asarray(push).reshape(-1, 6, N * P), start, 2.0 * self.step)
        end = x[-1] if self.up else x[-1] - rest
        return self.amplitude.shares(end.T).T, x[:, :6]


def boundary(
    mechanics: Mechanics,
    motion: RequiredMotion,
    programme: Programme,
    duration: float,
    steps: int,
    *,
    up: bool,
    splines: int = SPLINES,
) -> Boundary:
    """The problem of a programme for a motion, in an even number of `steps`."""
    t = np.linspace(0.0, duration, 2 * steps + 1)
    return Boundary(
        mechanics,
        amplitude_of(mechanics, motion, programme.bias),
        fade(programme, duration, t, up=up, splines=splines),
        carrier_at(mechanics.stand, motion.at(np.zeros(1), programme.bias)),
        mean_pose(mechanics, motion, programme.bias),
        up,
    )
