"""Models whose carrier is held: Cubli on a corner, reaction-wheel pendulum."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from audits.audit import Array, Audit, stand_of, terms, to_body
from mahovik.core.stand.model import State, rest_state

STATES = 100
G = 9.81


def _states(document: Mapping[str, Any], freedoms: int, turn: float | None) -> tuple[State, ...]:
    """Seeded states; `turn`: largest angle about x, None: any attitude."""
    rng = np.random.default_rng(1)
    rest = rest_state(stand_of(document, "held"))
    wheels = len(rest.phi)
    states = []
    for _ in range(STATES):
        q = rng.normal(size=4)
        angle = rng.uniform(-1.0, 1.0) * (turn or 0.0)
        states.append(
            replace(
                rest,
                quaternion=tuple((q / np.linalg.norm(q)).tolist()) if turn is None else None,
                angles=None if turn is None else (0.0, 0.0, angle),
                u=tuple(rng.normal(size=freedoms).tolist()),
                phi=tuple(rng.uniform(-math.pi, math.pi, wheels).tolist()),
                phi_dot=tuple((5 * rng.normal(size=wheels)).tolist()),
                phi_ddot=tuple((5 * rng.normal(size=wheels)).tolist()),
                tau=tuple((0.1 * rng.normal(size=wheels)).tolist()),
            )
        )
    return tuple(states)


# Cubli: p_h' = -omega x p_h + m x g, p_w' = tau, omega = (Theta_0 - Theta_w)^-1 (p_h - p_w)

HOUSING, WHEEL, EDGE = 0.77, 0.2, 0.15
CUBLI_CENTER = np.array([0.5, 0.5, 0.5]) * EDGE
CUBLI_BODY = np.array([[3.6e-3, 1e-4, -5e-5], [1e-4, 3.7e-3, 2e-5], [-5e-5, 2e-5, 3.5e-3]])
SPIN, ACROSS = 5e-4, 2.6e-4
FACES = EDGE * (0.5 - 0.4 * np.eye(3))

CUBLI: Mapping[str, Any] = {
    "gravity": [0.0, 0.0, -G],
    "hold": {"freedoms": ["roll", "pitch", "yaw"]},
    "carrier": {
        "mass": HOUSING,
        "center_of_mass": CUBLI_CENTER.tolist(),
        "inertia": CUBLI_BODY.tolist(),
        "inertia_about": "center_of_mass",
    },
    "flywheel": [
        {
            "name": f"w{i + 1}",
            "position": FACES[i].tolist(),
            "axis": np.eye(3)[i].tolist(),
            "zero": np.roll(np.eye(3)[i], 1).tolist(),
            "mass": WHEEL,
            "inertia": [SPIN, ACROSS, ACROSS],
        }
        for i in range(3)
    ],
}


def _steiner(mass: float, arm: Array) -> Array:
    return np.asarray(mass * (float(arm @ arm) * np.eye(3) - np.outer(arm, arm)))


def cubli(state: State, _: str) -> Mapping[str, Any]:
    """Momenta of the whole about the corner and of the wheels about their axes."""
    Theta = CUBLI_BODY + _steiner(HOUSING, CUBLI_CENTER)
    m = HOUSING * CUBLI_CENTER
    for axis, place in zip(np.eye(3), FACES, strict=True):
        Theta = Theta + ACROSS * np.eye(3) + (SPIN - ACROSS) * np.outer(axis, axis) + _steiner(WHEEL, place)
        m = m + WHEEL * place
    without = Theta - SPIN * np.eye(3)
    w, tau = np.array(state.u), np.array(state.tau)
    p_w = SPIN * (w + np.array(state.phi_dot))
    p_h = without @ w + p_w
    g = to_body(AUDITS[0].stand, state, [0.0, 0.0, -G])
    omega_dot = np.linalg.solve(without, -np.cross(w, p_h) + np.cross(m, g) - tau)
    return {"u_dot": omega_dot, "phi_ddot": tau / SPIN - omega_dot}


# Reaction-wheel pendulum, angle from the upright position

M1, M2, L1, LC1, I1, I2 = 0.02, 0.3, 0.123, 0.063, 47e-6, 32e-6

PENDULUM: Mapping[str, Any] = {
    "gravity": [0.0, 0.0, -G],
    "hold": {"freedoms": ["roll"]},
    "carrier": {
        "mass": M1,
        "center_of_mass": [0.0, 0.0, LC1],
        "inertia": [I1, I1, 2e-6],
        "inertia_about": "center_of_mass",
    },
    "flywheel": [
        {"name": "w1", "position": [0.0, 0.0, L1], "axis": [1, 0, 0], "zero": [0, 1, 0], "mass": M2,
         "inertia": [I2, 0.6 * I2, 0.6 * I2]}
    ],
}  # fmt: skip


def pendulum(state: State, _: str) -> Mapping[str, Any]:
    """D q'' + (-m g sin q1, 0) = (0, tau)."""
    assert state.angles is not None
    q1 = state.angles[2]
    D = np.array([[M1 * LC1**2 + M2 * L1**2 + I1 + I2, I2], [I2, I2]])
    first = M1 * LC1 + M2 * L1
    u_dot = np.linalg.solve(D, [first * G * math.sin(q1), state.tau[0]])
    return {"u_dot": u_dot[:1], "phi_ddot": u_dot[1:]}


AUDITS = (
    Audit(
        "cubli",
        "Cubli on a corner",
        "M. Muehlebach, G. Mohanarajah, R. D'Andrea, CDC 2013; "
        "github.com/michal-jasinski/Cubli-Optimization-Project, CubliSim/rhs.m, b0dbe433",
        "Turning about the corner and three wheels, with weight",
        CUBLI,
        ("coupled",),
        cubli,
        terms(""),
        "Right.",
        states=_states(CUBLI, 3, None),
    ),
    Audit(
        "reaction_wheel_pendulum",
        "Reaction-wheel pendulum",
        "I. Fantoni, R. Lozano, Non-linear Control for Underactuated Mechanical Systems, Springer 2002, chapter 7",
        "Turning about the pivot and the wheel, with weight",
        PENDULUM,
        ("coupled",),
        pendulum,
        terms(""),
        "Right.",
        states=_states(PENDULUM, 1, math.pi),
    ),
)
