"""External wrenches, (7): each body's own, in its frame about its origin, and the carrier's ties to E0."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from mahovik.core.stand.model import Body, Damping, Leg, Stand, Suspension
from mahovik.core.stand.model import Sequence as Angles
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Fixed, Placed, Spinning
from mahovik.proof.reference.rotation import attitude, rotation_vector
from mahovik.proof.reference.screw import force_at

SHORTEST_LEG = 1e-9  # m; a shorter leg has no direction

Kinds = Mapping[str, Array]  # wrench (6) by its kind


def weight(body: Body, gravity: Array) -> Array:
    """Weight (6; N, N m): m g at the centre of mass; `gravity` (3, m/s2) in the body's frame."""
    return force_at(body.mass * gravity, np.array(body.center_of_mass))


def buoyancy(body: Body, gravity: Array) -> Array:
    """Archimedes force (6; N, N m): -displaced_mass g at the centre of buoyancy; `gravity` (3) in its frame."""
    if body.buoyancy is None:
        return np.zeros(6)
    return force_at(-body.buoyancy.displaced_mass * gravity, np.array(body.buoyancy.center))


def linear_damping(damping: Damping, V_r: Array) -> Array:
    """-(linear V_r) (6; N, N m), V_r the body's twist relative to the fluid, all in the body's frame."""
    return np.zeros(6) if damping.linear is None else -np.array(damping.linear) @ V_r


def quadratic_damping(damping: Damping, V_r: Array) -> Array:
    """-(quadratic (V_r |V_r|)) (6; N, N m), product element by element, all in the body's frame."""
    return np.zeros(6) if damping.quadratic is None else -np.array(damping.quadratic) @ (V_r * np.abs(V_r))


def damping_terms(damping: Damping, V_r: Array) -> Array:
    """Sum of hydrodynamic derivatives (6; N, N m): component `wrench` += value * product of two."""
    P = np.zeros(6)
    for term in damping.terms:
        first, second = (abs(V_r[a.component]) if a.absolute else V_r[a.component] for a in term.of)
        P[term.wrench] += term.value * first * second
    return P


def body_wrenches(body: Body, gravity: Array, V_r: Array, given: Array) -> Kinds:
    """Wrenches (6; N, N m) on one body by kind, in its own frame about its origin; their sum is P of (7).

    `gravity` (3, m/s2), `V_r` (6, twist relative to the fluid) in its frame; `given` (6) is the run-time wrench.
    """
    kinds = {"weight": weight(body, gravity), "buoyancy": buoyancy(body, gravity), "run-time": given}
    if body.damping is not None:
        kinds["linear damping"] = linear_damping(body.damping, V_r)
        kinds["quadratic damping"] = quadratic_damping(body.damping, V_r)
        kinds["damping terms"] = damping_terms(body.damping, V_r)
    return kinds


def suspension_displacement(suspension: Suspension, sequence: Angles, O1: Array, C: Array) -> Array:
    """x = (C^T (O1 - position), rotation vector of C_eq^T C of length <= pi) (6; m, rad)."""
    C_eq = attitude(sequence, *suspension.angles)
    displacement = C.T @ (O1 - np.array(suspension.position))
    return np.concatenate([displacement, rotation_vector(C_eq.T @ C)])


def suspension_wrench(suspension: Suspension, sequence: Angles, O1: Array, C: Array, V: Array) -> Array:
    """-(stiffness x + damping V) (6; N, N m) on the carrier about O1 in E1; V is relative to E0."""
    x = suspension_displacement(suspension, sequence, O1, C)
    stiffness, damping = np.array(suspension.stiffness), np.array(suspension.damping)
    return np.asarray(-(stiffness @ x + damping @ V))


def leg_vector(leg: Leg, O1: Array, C: Array) -> Array:
    """From the leg's ground point to its carrier point (3, m), in E0."""
    return np.asarray(O1 + C @ np.array(leg.carrier) - np.array(leg.ground))


def leg_wrench(leg: Leg, O1: Array, C: Array, V: Array) -> Array:
    """Wrench (6; N, N m) of a spring-damper leg on the carrier about O1 in E1. StateError where it has no length."""
    d = leg_vector(leg, O1, C)
    length = math.hypot(*d)
    if length < SHORTEST_LEG:
        raise StateError(f"leg between ground {leg.ground} and carrier {leg.carrier}: length {length:.3g} m is zero")
    point = np.array(leg.carrier)
    direction = C.T @ d / length  # in E1, from the ground
    length_rate = direction @ (V[:3] + np.cross(V[3:], point))
    tension = leg.stiffness * (length - leg.length) + leg.damping * length_rate
    return force_at(-tension * direction, point)


def run_time_wrench(state: State, body: Body) -> Array:
    """The caller's wrench (6; N, N m) on a body, in its own frame about its origin."""
    return np.array(state.wrench.get(body.name, (0.0,) * 6))


def external_wrenches(
    stand: Stand,
    state: State,
    *,
    C: Array,
    V: Array,
    V_r: Array,
    fixed: Sequence[Fixed],
    flywheels: Sequence[Spinning],
) -> dict[str, Kinds]:
    """Every wrench of (7) by body name and kind, (6; N, N m) each in its body's frame about its origin.

    V, V_r (6): twists of E1 relative to E0 and to the fluid. Suspension and legs count among the carrier's.
    """
    O1, gravity = np.array(state.position), C.T @ np.array(stand.gravity)  # gravity in E1
    P: dict[str, Kinds] = {}
    bodies: tuple[Placed, ...] = (*fixed, *flywheels)
    for k in bodies:
        C_k = k.L[:3, :3]
        P[k.body.name] = body_wrenches(k.body, C_k.T @ gravity, k.twist(V_r), run_time_wrench(state, k.body))
    ties: dict[str, Array] = {}
    if stand.suspension is not None:
        ties["suspension"] = suspension_wrench(stand.suspension, stand.angles, O1, C, V)
    for number, leg in enumerate(stand.legs):
        ties[f"leg {number}"] = leg_wrench(leg, O1, C, V)
    P[stand.carrier.name] = {**P[stand.carrier.name], **ties}
    return P


def body_wrench(kinds: Kinds) -> Array:
    """P_k (6; N, N m): the sum over the kinds of wrench on one body, in its frame about its origin."""
    return np.asarray(sum(kinds.values(), np.zeros(6)))


def total_wrench(P: Mapping[str, Array], fixed: Sequence[Fixed], flywheels: Sequence[Spinning]) -> Array:
    """F = P_1 + sum_p Lp P_p + sum_s Ls P_s (6; N, N m), in E1 about O1, (7)."""
    bodies: tuple[Placed, ...] = (*fixed, *flywheels)
    return np.asarray(sum((k.L @ P[k.body.name] for k in bodies), np.zeros(6)))
