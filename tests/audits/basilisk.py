"""Basilisk: its spacecraft with a reaction wheel, in three models, and with a spinning body of one degree of freedom.

Every effector adds to the matrices of the hub's translation and rotation what is left when its own equation
phi'' = a . r'' + b . omega' + c is put in (back-substitution).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from audits.audit import Answer, Array, Audit, cross, terms
from mahovik.core.stand.state import State

HUB = 12.0  # kg
HUB_CENTER = np.array([0.02, -0.01, 0.03])
HUB_INERTIA = np.array([[0.9, 0.01, -0.02], [0.01, 1.1, 0.03], [-0.02, 0.03, 1.3]])  # about its mass centre

WHEEL_MASS, JS, JT, JG = 0.8, 0.004, 0.0023, 0.0023
STATIC, DYNAMIC = 0.003, 0.0002  # kg m, kg m2
PLACE = np.array([0.15, 0.1, -0.05])
AXES = np.array([[0.0, 0.0, 1.0], [0.6, 0.8, 0.0], [-0.8, 0.6, 0.0]]).T  # columns gs, w2, w3 at theta = 0


@dataclass
class Effector:
    """Mass, mass centre and its rate, inertia about the hub's origin and its rate, all in the hub's axes; a, b, c and
    the column that phi'' has in translation and rotation."""

    mass: float
    center: Array
    center_rate: Array
    inertia: Array
    inertia_rate: Array
    a: Array
    b: Array
    c: float
    force: Array
    moment: Array
    translation: Array
    rotation: Array
    own: float

    def torque(self, r_ddot: Array, omega_dot: Array, phi_ddot: float, tau: float) -> float:
        """The drive torque at which its equation gives phi'' instead of the one for tau."""
        return float(tau + self.own * (phi_ddot - self.a @ r_ddot - self.b @ omega_dot - self.c))


def move(effector: Effector, V: Array, phi_ddot: float | None) -> tuple[Array, float]:
    """V_dot (6) and phi''; `phi_ddot`: given, or None: as the effector's equation has it."""
    v, w = V[:3], V[3:]
    e = effector
    mass = HUB + e.mass
    center = (HUB * HUB_CENTER + e.mass * e.center) / mass
    rate = e.mass * e.center_rate / mass
    inertia = HUB_INERTIA - HUB * cross(HUB_CENTER) @ cross(HUB_CENTER) + e.inertia
    a, b, c = (e.a, e.b, e.c) if phi_ddot is None else (np.zeros(3), np.zeros(3), phi_ddot)
    A = mass * np.eye(3) + np.outer(e.translation, a)
    B = -mass * cross(center) + np.outer(e.translation, b)
    C = mass * cross(center) + np.outer(e.rotation, a)
    D = inertia + np.outer(e.rotation, b)
    force = -2 * mass * np.cross(w, rate) - mass * np.cross(w, np.cross(w, center)) + e.force - e.translation * c
    moment = -np.cross(w, inertia @ w) - e.inertia_rate @ w + e.moment - e.rotation * c
    found = np.linalg.solve(np.block([[A, B], [C, D]]), np.concatenate([force, moment]))
    r_ddot, omega_dot = found[:3], found[3:]
    V_dot = np.concatenate([r_ddot - np.cross(w, v), omega_dot])
    return V_dot, float(a @ r_ddot + b @ omega_dot + c)


Model = Callable[[Array, float, float, float], Effector]
"""The effector at omega, phi, phi', tau."""


def program(model: Model) -> Answer:
    """The spacecraft with this effector."""

    def answer(state: State, want: str) -> Mapping[str, Any]:
        V = np.array(state.V)
        effector = model(V[3:], state.phi[0], state.phi_dot[0], state.tau[0])
        if want == "forward":
            return {"V_dot": move(effector, V, state.phi_ddot[0])[0]}
        if want == "torque":
            V_dot = np.array(state.V_dot)
            r_ddot = V_dot[:3] + np.cross(V[3:], V[:3])
            return {"tau": [effector.torque(r_ddot, V_dot[3:], state.phi_ddot[0], state.tau[0])]}
        V_dot, phi_ddot = move(effector, V, None)
        return {"V_dot": V_dot, "phi_ddot": [phi_ddot]}

    return answer


def fully_coupled(Jt: float, Jg: float) -> Model:
    """JitterFullyCoupled with these transverse moments of inertia."""

    def model(w: Array, phi: float, speed: float, tau: float) -> Effector:
        turn = np.array([[1.0, 0.0, 0.0], [0.0, np.cos(phi), -np.sin(phi)], [0.0, np.sin(phi), np.cos(phi)]])
        axes = AXES @ turn
        gs, w2, w3 = axes.T
        d, m = STATIC / WHEEL_MASS, WHEEL_MASS
        I = axes @ np.array([[JS, 0.0, DYNAMIC], [0.0, Jt, 0.0], [DYNAMIC, 0.0, Jg]]) @ axes.T
        rate = speed * axes @ np.array([[0.0, -DYNAMIC, 0.0], [-DYNAMIC, 0.0, 0.0], [0.0, 0.0, 0.0]]) @ axes.T
        center, center_rate = PLACE + d * w2, d * speed * w3
        own = JS + m * d**2
        c = (
            -m * d**2 * (w2 @ w) * (w3 @ w)
            - DYNAMIC * (w2 @ w) * (gs @ w)
            - m * d * w3 @ np.cross(w, np.cross(w, PLACE))
            + tau
        ) / own
        along = I @ gs + m * d * np.cross(center, w3)
        return Effector(
            m,
            center,
            center_rate,
            I - m * cross(center) @ cross(center),
            rate - m * (cross(center_rate) @ cross(center) + cross(center) @ cross(center_rate)),
            -m * d / own * w3,
            -(own * gs + DYNAMIC * w3 + m * d * np.cross(PLACE, w3)) / own,
            c,
            m * d * speed**2 * w2,
            m * d * speed**2 * np.cross(center, w2)
            - rate @ gs * speed
            - np.cross(w, I @ gs * speed + m * np.cross(center, center_rate)),
            m * d * w3,
            along,
            own,
        )

    return model


def simple(static: float, dynamic: float) -> Model:
    """JitterSimple: a balanced wheel that is part of the hub, and the forces of its unbalance on the hub."""

    def model(w: Array, phi: float, speed: float, tau: float) -> Effector:
        gs = AXES[:, 0]
        w2 = AXES @ np.array([0.0, np.cos(phi), np.sin(phi)])
        m = WHEEL_MASS
        I = AXES @ np.diag([JS, JT, JG]) @ AXES.T
        force = static * speed**2 * w2
        return Effector(
            m,
            PLACE,
            np.zeros(3),
            I - m * cross(PLACE) @ cross(PLACE),
            np.zeros((3, 3)),
            np.zeros(3),
            -gs,
            tau / JS,
            force,
            -JS * speed * np.cross(w, gs) + np.cross(PLACE, force) + dynamic * speed**2 * w2,
            np.zeros(3),
            JS * gs,
            JS,
        )

    return model


ROTOR_MASS = 1.3
ROTOR_CENTER = np.array([0.03, 0.05, -0.02])  # in its own axes, from a point of the axis
ROTOR_INERTIA = np.array([[0.008, 0.0005, -0.0003], [0.0005, 0.006, 0.0004], [-0.0003, 0.0004, 0.009]])


def spinning_body(w: Array, phi: float, speed: float, tau: float) -> Effector:
    """SpinningBodyOneDOFStateEffector without spring, damper and attached forces."""
    turn = np.array([[1.0, 0.0, 0.0], [0.0, np.cos(phi), -np.sin(phi)], [0.0, np.sin(phi), np.cos(phi)]])
    axes = AXES @ turn
    s, m = axes[:, 0], ROTOR_MASS
    own_center = axes @ ROTOR_CENTER
    center = own_center + PLACE
    I = axes @ ROTOR_INERTIA @ axes.T
    about_axis = I - m * cross(own_center) @ cross(own_center)
    spin = speed * s
    own_rate = np.cross(spin, own_center)
    across = np.cross(own_center, s)
    own = float(s @ about_axis @ s)
    whole = w + spin
    c = (
        tau
        - s
        @ (
            np.cross(whole, about_axis @ whole)
            + about_axis @ np.cross(w, spin)
            + m * np.cross(own_center, np.cross(w, np.cross(w, PLACE)))
        )
    ) / own
    W = cross(spin)
    return Effector(
        m,
        center,
        own_rate,
        I - m * cross(center) @ cross(center),
        W @ I - I @ W - m * (cross(own_rate) @ cross(center) + cross(center) @ cross(own_rate)),
        m * across / own,
        -(about_axis @ s - m * np.cross(PLACE, across)) / own,
        c,
        -m * np.cross(spin, own_rate),
        -np.cross(whole, I @ spin)
        - m * np.cross(w, np.cross(center, own_rate))
        - m * np.cross(center, np.cross(spin, own_rate)),
        -m * across,
        I @ s - m * np.cross(center, across),
        own,
    )


def document(mass: float, center: Array, inertia: Array) -> dict[str, Any]:
    """The stand: hub and rotor, its tensor about its mass centre."""
    return {
        "carrier": {
            "mass": HUB,
            "center_of_mass": HUB_CENTER.tolist(),
            "inertia": HUB_INERTIA.tolist(),
            "inertia_about": "center_of_mass",
        },
        "flywheel": [
            {
                "name": "w1",
                "position": PLACE.tolist(),
                "axis": AXES[:, 0].tolist(),
                "zero": AXES[:, 1].tolist(),
                "mass": mass,
                "center_of_mass": center.tolist(),
                "inertia": inertia.tolist(),
                "inertia_about": "center_of_mass",
            }
        ],
    }


def _wheel(Jt: float, Jg: float, static: float = STATIC, dynamic: float = DYNAMIC) -> dict[str, Any]:
    J = np.array([[JS, 0.0, dynamic], [0.0, Jt, 0.0], [dynamic, 0.0, Jg]])
    return document(WHEEL_MASS, np.array([0.0, static / WHEEL_MASS, 0.0]), J)


WHEEL_FILE = (
    "github.com/AVSLab/basilisk, src/simulation/dynamics/reactionWheels/reactionWheelStateEffector.cpp, 03217e14"
)
SCOPE = "A free spacecraft with one rotor, without friction, gravity and attached forces"
WANTS = ("forward", "torque", "coupled")
ASYMMETRIC = (0.0021, 0.0027)

AUDITS = (
    Audit(
        "basilisk_coupled",
        "Basilisk, reaction wheel, JitterFullyCoupled, Jt = Jg",
        WHEEL_FILE,
        SCOPE,
        _wheel(JT, JG),
        WANTS,
        program(fully_coupled(JT, JG)),
        terms(""),
        "Right.",
    ),
    Audit(
        "basilisk_asymmetric",
        "Basilisk, reaction wheel, JitterFullyCoupled, Jt and Jg differ",
        WHEEL_FILE,
        SCOPE,
        _wheel(*ASYMMETRIC),
        WANTS,
        program(fully_coupled(*ASYMMETRIC)),
        terms(
            "K: p w1.speed cos 2 w1, p w1.speed sin 2 w1, q w1.speed cos 2 w1, q w1.speed sin 2 w1; "
            "M: p w1.speed cos 2 w1, p w1.speed sin 2 w1, q w1.speed cos 2 w1, q w1.speed sin 2 w1; "
            "w1: p p cos 2 w1, p p sin 2 w1, p q cos 2 w1, p q sin 2 w1, q q cos 2 w1, q q sin 2 w1"
        ),
        "The rate of the inertia and the torque lack the terms in Jt - Jg.",
    ),
    Audit(
        "basilisk_simple",
        "Basilisk, reaction wheel, JitterSimple, balanced",
        WHEEL_FILE,
        SCOPE,
        _wheel(JT, JG, 0.0, 0.0),
        WANTS,
        program(simple(0.0, 0.0)),
        terms(""),
        "Right.",
    ),
    Audit(
        "basilisk_simple_unbalanced",
        "Basilisk, reaction wheel, JitterSimple, unbalanced",
        WHEEL_FILE,
        SCOPE,
        _wheel(JT, JG),
        WANTS,
        program(simple(STATIC, DYNAMIC)),
        None,
        "Only the forces in the square of the speed are there, not what couples unbalance and motion of the hub.",
    ),
    Audit(
        "basilisk_spinning_body",
        "Basilisk, spinning body of one degree of freedom",
        "github.com/AVSLab/basilisk, src/simulation/dynamics/spinningBodies/spinningBodiesOneDOF/"
        "spinningBodyOneDOFStateEffector.cpp, 01624928",
        f"{SCOPE}; a rotor of any shape",
        document(ROTOR_MASS, ROTOR_CENTER, ROTOR_INERTIA),
        WANTS,
        program(spinning_body),
        terms(""),
        "Right for a rotor of any shape and unbalance.",
    ),
)
