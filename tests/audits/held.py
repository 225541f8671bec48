"""Models whose carrier is held: Cubli on a corner, reaction-wheel pendulum, vibrating screen of two exciters."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from audits.audit import Array, Audit, stand_of, terms, to_body
from mahovik.core.stand.state import State, rest_state

STATES = 100
G = 9.81


def _states(document: Mapping[str, Any], freedoms: int, turn: float | None) -> tuple[State, ...]:
    """Seeded states; `turn`: largest angle about the axis of the last freedom, None: any attitude."""
    rng = np.random.default_rng(1)
    rest = rest_state(stand_of(document, "held"))
    wheels = len(rest.phi)
    found = []
    slides = freedoms == 3 and turn is not None
    for _ in range(STATES):
        q = rng.normal(size=4)
        angle = rng.uniform(-1.0, 1.0) * (turn or 0.0)
        place = 0.01 * rng.normal(size=3) * slides
        found.append(
            replace(
                rest,
                position=tuple(place.tolist()),
                quaternion=tuple((q / np.linalg.norm(q)).tolist()) if turn is None else None,
                angles=None if turn is None else _angles(freedoms, angle),
                u=tuple(rng.normal(size=freedoms).tolist()),
                phi=tuple(rng.uniform(-math.pi, math.pi, wheels).tolist()),
                phi_dot=tuple((5 * rng.normal(size=wheels)).tolist()),
                phi_ddot=tuple((5 * rng.normal(size=wheels)).tolist()),
                tau=tuple((0.1 * rng.normal(size=wheels)).tolist()),
            )
        )
    return tuple(found)


def _driven_from_outside(states: tuple[State, ...]) -> tuple[State, ...]:
    """The states with motors beside the carrier: it gets back the torques that it gives about z."""
    return tuple(replace(each, wrench={"carrier": (0.0, 0.0, 0.0, 0.0, 0.0, sum(each.tau))}) for each in states)


def _angles(freedoms: int, angle: float) -> tuple[float, float, float]:
    """psi, theta, phi: the pendulum turns about x, the screen about z."""
    return (0.0, 0.0, angle) if freedoms == 1 else (angle, 0.0, 0.0)


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
    found = np.linalg.solve(D, [first * G * math.sin(q1), state.tau[0]])
    return {"u_dot": found[:1], "phi_ddot": found[1:]}


# Vibrating screen: M x'' + f x' + k x = sum m r (phi'^2 cos phi + phi'' sin phi), and so on; phi relative to space

SCREEN, EXCITER, RADIUS, ARM, HEIGHT = 120.0, 3.5, 0.06, 0.5, 0.15
SCREEN_INERTIA, ROTOR = 22.0, 0.02  # about z; of the rotor about its axis, kg m2
K_X, K_Y, K_TURN = 24e3, 24e3, 9e3
F_X, F_Y, F_TURN = 160.0, 160.0, 60.0
WHERE = np.array([[-ARM, HEIGHT], [ARM, HEIGHT]])
BODY_CENTER = -EXCITER * WHERE.sum(axis=0) / SCREEN

SCREEN_STAND: Mapping[str, Any] = {
    "hold": {"freedoms": ["x", "y", "yaw"]},
    "carrier": {
        "wrench_input": True,
        "mass": SCREEN,
        "center_of_mass": [*BODY_CENTER.tolist(), 0.0],
        "inertia": [SCREEN_INERTIA / 2, SCREEN_INERTIA / 2, SCREEN_INERTIA],
        "inertia_about": "center_of_mass",
    },
    "suspension": {
        "stiffness": [K_X, K_Y, 0.0, 0.0, 0.0, K_TURN],
        "damping": [F_X, F_Y, 0.0, 0.0, 0.0, F_TURN],
    },
    "flywheel": [
        {
            "name": f"e{i + 1}",
            "position": [*WHERE[i].tolist(), 0.0],
            "axis": [0, 0, 1],
            "zero": [1, 0, 0],
            "mass": EXCITER,
            "center_of_mass": [0.0, RADIUS, 0.0],
            "inertia": [ROTOR, 0.012, 0.02],
            "inertia_about": "origin",
        }
        for i in range(2)
    ],
}


def screen(state: State, _: str) -> Mapping[str, Any]:
    """Equations of x, y, psi and both exciters; a small angle psi is left out of the arms."""
    assert state.angles is not None
    psi = state.angles[0]
    v, turn = np.array(state.u[:2]), state.u[2]
    mass = SCREEN + 2 * EXCITER
    J = SCREEN_INERTIA + SCREEN * BODY_CENTER @ BODY_CENTER + EXCITER * float((WHERE**2).sum())
    matrix = np.diag([mass, mass, J, ROTOR, ROTOR])
    spring = np.array([K_X, K_Y]) * np.array(state.position[:2]) + np.array([F_X, F_Y]) * v
    right = np.concatenate([-spring, [-K_TURN * psi - F_TURN * turn], state.tau])
    for i, arm in enumerate(WHERE):
        phi, speed = state.phi[i] + psi, state.phi_dot[i] + turn
        e, across = np.array([math.cos(phi), math.sin(phi)]), np.array([-math.sin(phi), math.cos(phi)])
        side = np.array([-arm[1], arm[0]])  # d arm / d psi at psi = 0
        moved = np.concatenate([across, [side @ across]])
        matrix[:3, 3 + i] = matrix[3 + i, :3] = EXCITER * RADIUS * moved
        right[:3] += EXCITER * RADIUS * speed**2 * np.concatenate([e, [side @ e]])
        right[3 + i] += EXCITER * RADIUS * turn**2 * arm @ across
    found = np.linalg.solve(matrix, right)
    return {"u_dot": _in_body(found[:3], state), "phi_ddot": found[3:] - found[2]}


def _in_body(found: Array, state: State) -> Array:
    """x'', y'' of E0 as derivatives of the components in E1, which turns."""
    assert state.angles is not None
    psi, turn = state.angles[0], state.u[2]
    C = np.array([[math.cos(psi), -math.sin(psi)], [math.sin(psi), math.cos(psi)]])
    v = np.array(state.u[:2])
    return np.array([*(C.T @ found[:2] - turn * np.array([-v[1], v[0]])), found[2]])


SCREEN_SOURCE = (
    "The planar equations common in the literature on self-synchronization of exciters; not compared with one paper "
    "line by line"
)
SCREEN_SCOPE = (
    "x, y, turn and both exciters, with springs and dampers at the mass centre; motors beside the screen, for the "
    "equation of turning lacks their reaction"
)

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
    Audit(
        "screen",
        "Vibrating screen of two exciters, not turned",
        SCREEN_SOURCE,
        f"{SCREEN_SCOPE}; at angle zero",
        SCREEN_STAND,
        ("coupled",),
        screen,
        terms(""),
        "Right at angle zero.",
        states=_driven_from_outside(_states(SCREEN_STAND, 3, 0.0)),
    ),
    Audit(
        "screen_turned",
        "Vibrating screen of two exciters, turned by up to 3 degrees",
        SCREEN_SOURCE,
        SCREEN_SCOPE,
        SCREEN_STAND,
        ("coupled",),
        screen,
        None,
        "The arms of the exciters do not turn with the screen, an error of first order in the angle.",
        states=_driven_from_outside(_states(SCREEN_STAND, 3, math.radians(3.0))),
    ),
)
