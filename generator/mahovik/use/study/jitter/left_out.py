"""Error of a motion on the torus: its difference from the literal reference at random phases."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mahovik.proof.reference import pieces
from mahovik.proof.reference.motion import forward, reaction
from mahovik.proof.reference.pieces import Pieces
from mahovik.use.plan.array import Array, Complex
from mahovik.use.study.jitter.torus import Torus
from mahovik.use.study.jitter.torus_motion import (
    ROUNDING,
    Balance,
    gyration_radius,
    rounding_rates,
    rounding_wrench,
    state_at,
)
from mahovik.use.study.response.scene import Scene

SAMPLES = 64
"""Random phases at which the literal reference is evaluated."""

REACTION_ROUNDING = 1e-9
"""Part of the reaction below which what varies of it is not judged: beside a weight the rest is rounding."""


def left_out(found: Balance) -> float:
    """Largest difference of V*, of the pose's rate and of the reaction from the reference, each part of its largest."""
    scene, turning = found.scene, len(found.turning)
    theta = np.random.default_rng(1).uniform(0.0, 2.0 * np.pi, (SAMPLES, turning))
    y, y_dot = found.states(theta)
    phi, phi_dot = found.motions(theta)
    given = scene.drive(phi, phi_dot)
    pushed = (scene.effect_of_wrench(given) @ found.torus.at(found.h, theta)[:, :, None])[:, scene.count :, 0]
    at = [pieces(scene.stand, state_at(scene, y[i], phi[i], found.speeds)) for i in range(len(theta))]
    exact = np.array([forward(each, np.zeros(phi.shape[1])) for each in at])
    left = y_dot[:, 6:] - exact - scene.twist(pushed)
    pose = y_dot[:, :6] - scene.chart.rate(given, y)[:, :6]
    parts = [_largest(found, a, b) for a, b in ((left, exact), (pose, y_dot[:, :6]))]
    if scene.stand.hold is not None:
        parts.append(_reaction_left_out(scene, found, theta, at, y_dot[:, 6:]))
    return max(parts)


def reactions(scene: Scene, found: Balance, torus: Torus, c: Complex, h: Complex) -> Array:
    """Reaction (M, 6) at the nodes of a torus, without the wrench that keeps the mean place; c, h: its coefficients."""
    given = scene.drive(*found.motions(torus.nodes))
    pushed = torus.values(h) @ scene.wrench.T
    return np.asarray(scene.reaction(given, *found.at_nodes(torus, c)) - pushed)


def _reaction_left_out(scene: Scene, found: Balance, theta: Array, at: Sequence[Pieces], V_dot: Array) -> float:
    """Largest difference between the reaction's lines and the literal reference, part of the largest that varies."""
    lines = found.torus.coefficients(reactions(scene, found, found.torus, found.c, found.h))
    still = np.zeros(len(found.speeds))
    exact = np.array([reaction(each, V, still) for each, V in zip(at, V_dot, strict=True)])
    exact -= found.torus.at(found.h, theta) @ scene.wrench.T
    scale = np.repeat([1.0, 1.0 / gyration_radius(scene)], 3)
    left, whole, varying = (
        float(np.linalg.norm(each * scale, axis=1).max())
        for each in (found.torus.at(lines, theta) - exact, exact, exact - lines[0].real)
    )
    most = max(varying, REACTION_ROUNDING * whole)
    return left / most if most > np.linalg.norm(rounding_wrench(scene, found.speeds) * scale) else 0.0


def _largest(found: Balance, off: Array, whole: Array) -> float:
    """Largest of off (M, 6) as a part of the largest of `whole`, rotations times the radius of gyration."""
    scene = found.scene
    scale = np.repeat([1.0, gyration_radius(scene)], 3)
    most = float(np.linalg.norm(whole * scale, axis=1).max())
    least = max(ROUNDING, scene.noise, float(np.linalg.norm(scene.twist(rounding_rates(scene, found.speeds)) * scale)))
    return float(np.linalg.norm(off * scale, axis=1).max()) / most if most > least else 0.0
