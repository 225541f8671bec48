"""The pieces put together at a state, with the wrenches (7) that act there; answers to the wants of `eval`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import numpy as np

from mahovik.contract.functions import TASK_CONFLICTS, TASK_TAKERS, want_fault
from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.stand.model import Body, Stand, State, Vec6
from mahovik.errors import StateError, count_numbers
from mahovik.proof.reference import coordinates, inverse, motion
from mahovik.proof.reference.algebra import (
    Array,
    E,
    Phi,
    Pose,
    Values,
    blocks,
    carrier_rotation,
    cross,
    f,
    stack,
    times,
    transpose,
    twists,
    vector,
    wrench_to_parent,
    zero,
)
from mahovik.proof.reference.motion import forward, mounts_on_flywheels
from mahovik.proof.reference.pieces import (
    Bodies,
    BodyReference,
    CarrierReference,
    Kinds,
    Pieces,
    bodies_of,
    body_wrench,
    center_of_mass,
    center_of_mass_velocity,
    coupling,
    kinetic_energy,
    mass_matrix,
    mass_matrix_rates,
    momentum,
    momentum_in_E0,
    stream_at,
)

# -- the pieces at a state, and (7) ------------------------------------------------------------------------------------


def pieces(stand: Stand, state: State, bodies: Bodies | None = None) -> Pieces:
    """The pieces of `stand` at `state`. StateError where a law is undefined.

    `bodies`: `bodies_of` the stand, where the caller has them already.
    """
    C, V = carrier_rotation(stand, state), vector(state.V)
    u = C.T @ stream_at(stand, state.position)
    V_r = V - np.concatenate([u, np.zeros(3)])
    k = (bodies or bodies_of(stand)).at_phases(state.phi, state.phi_dot)
    s = k.flywheels
    K_bodies, Lambda, K_dot = mass_matrix(k), k.Lambda.sum(axis=0), mass_matrix_rates(s).sum(axis=0)
    K, gravity, pose = K_bodies + Lambda, C.T @ vector(stand.gravity), Pose(vector(state.position), C, V)
    terms = external_wrenches(stand, state, pose, gravity, V_r, k)
    P = {name: body_wrench(kinds) for name, kinds in terms.items()}
    return Pieces(
        C=C,
        L1=wrench_to_parent(pose.O1, C),
        S=twists(stand.hold),
        V=V,
        V_r=V_r,
        bodies=k,
        K_bodies=K_bodies,
        Lambda=Lambda,
        K=K,
        K_dot=K_dot,
        I=coupling(s),
        terms=terms,
        P=P,
        F=times(k.L, stack(list(P.values()), 6)).sum(axis=0),  # (7)
        gravity=gravity,
        u=u,
    )


def external_wrenches(
    stand: Stand, state: State, at: Pose, gravity: Array, V_r: Array, bodies: Bodies
) -> dict[str, Kinds]:
    """Every wrench of (7) by body name and kind. The laws between E0 and the carrier count among the carrier's.

    `gravity` (3) and `V_r` (6, twist of E1 relative to the fluid) in E1.
    """
    P: dict[str, Kinds] = {}
    gravities, weights = transpose(bodies.L[:, :3, :3]) @ gravity, weights_of(bodies, gravity)
    for body, weight, gravity_there, V_r_there in zip(
        bodies.bodies, weights, gravities, bodies.twists(V_r), strict=True
    ):
        of_laws, run_time = body_wrenches(body, gravity_there, V_r_there), run_time_wrench(state, body)
        P[body.name] = {"weight": weight, **of_laws, "run-time": run_time}
    for law in parts("reference", CarrierReference):
        P[stand.carrier.name] = {**P[stand.carrier.name], **law.wrenches(stand, state, at)}
    return P


def weights_of(bodies: Bodies, gravity: Array) -> Array:
    """Theta (g, 0) = (m g, m rc x g) of every body (nx6; N, N m), in its frame; `gravity` (3, m/s2) in E1."""
    there = transpose(bodies.L[:, :3, :3]) @ gravity
    return times(bodies.Theta, np.hstack([there, np.zeros_like(there)]))


def body_wrenches(body: Body, gravity: Array, V_r: Array) -> dict[str, Array]:
    """Wrenches of the laws of one body by kind. `gravity` (3, m/s2), `V_r` (6, relative to the fluid) in its frame."""
    kinds: dict[str, Array] = {}
    data = {type(law): law for law in body.laws}
    for law in parts("reference", BodyReference, BODY_LAWS) if data else ():
        if law.data in data:
            kinds |= law.wrenches(body, data[law.data], gravity, V_r)
    return kinds


def run_time_wrench(state: State, body: Body) -> Array:
    """The caller's wrench (6; N, N m) on a body, in its own frame about its origin."""
    return vector(state.wrench.get(body.name, (0.0,) * 6))


# -- the regressor -----------------------------------------------------------------------------------------------------


def _unit(i: int, j: int, size: int) -> Array:
    """Symmetric matrix with 1 at i, j."""
    unit = np.zeros((size, size))
    unit[i, j] = unit[j, i] = 1.0
    return unit


_MOMENTS = [_unit(i, j, 3) for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]

UNIT_BODIES = np.stack(
    [blocks(E, zero, zero, zero)]
    + [blocks(zero, -cross(axis), cross(axis), zero) for axis in E]
    + [blocks(zero, zero, zero, moment) for moment in _MOMENTS]
)
"""Theta (10x6x6) of bodies with one number: mass, first moment, moments of inertia 11, 22, 33, 12, 13, 23."""

UNIT_ADDED_MASSES = np.stack([_unit(i, j, 6) for i in range(6) for j in range(i, 6)])
"""Lambda (21x6x6) with one number of the upper half, row by row; both halves change together."""


def body_columns(at: Pieces, state: State) -> tuple[Array, Array]:
    """Columns of every body (nx6x10, and nx10 of its drive): what UNIT_BODIES in its place take by (4), besides weight.

    The wrench of the mount on it, carried to E1 about O1, and its part along the spin axis.
    """
    k = at.bodies
    phi_ddot = np.concatenate([np.zeros(len(k.bodies) - len(state.phi_ddot)), vector(state.phi_ddot)])
    alone = replace(k, Theta=UNIT_BODIES[:, None])
    wrenches = mounts_on_flywheels(alone, weights_of(alone, at.gravity), at.V, vector(state.V_dot), phi_ddot)
    return np.moveaxis(times(k.L, wrenches), 0, -1), (wrenches @ f).T


def answer_regressor(at: Pieces, stand: Stand, state: State) -> Values:
    """Columns by the names of the C; those of the added mass, Lambda V_r* + Phi(V_r) Lambda V_r, if the stand has it.

    Linear damping A of the carrier takes A V_r, quadratic damping A (V_r |V_r|): row i has A[i][j] times number j.
    """
    columns, drives = body_columns(at, state)
    values: Values = {"Y_carrier": columns[0]}
    if count := len(stand.flywheels):
        values |= {"Y_flywheel": columns[-count:], "Y_drive": drives[-count:]}
    if stand.carrier.added_mass is not None or any(p.added_mass is not None for p in stand.instruments):
        inertial = UNIT_ADDED_MASSES @ at.V_r_dot(vector(state.V_dot))
        values["Y_added_mass"] = (inertial + UNIT_ADDED_MASSES @ at.V_r @ Phi(at.V_r).T).T
    return values | {"Y_linear": at.V_r, "Y_quadratic": at.V_r * np.abs(at.V_r)}


# Recursive least squares of static unbalances, in the covariance form.


def slopes(at: Pieces, state: State) -> Array:
    """-K^-1 Y (6x2N): K V* = F - ... - Y u, so that an unbalance u changes V* by this."""
    columns = body_columns(at, state)[0][-len(state.phi) :, :, 2:4]
    return np.asarray(-np.linalg.solve(at.K, np.hstack(list(columns))))


def identify_step(at: Pieces, state: State, noise: Array, unbalance: Array, covariance: Array) -> tuple[Array, Array]:
    """Static unbalances (2N; kg m) and their covariance (2Nx2N) after one sample, from those before it.

    m rc along axes 2 and 3 of each flywheel, to be added. V_dot of the state is measured, with independent standard
    deviations `noise` (6); a component with 0 is not used. The covariance is Joseph's sum of squares, component by
    component, as a difference of covariances loses digits.
    """
    H, P = slopes(at, state), covariance
    excess = vector(state.V_dot) - forward(at, vector(state.phi_ddot))
    for h, deviation, measured in zip(H, noise, excess, strict=True):
        if deviation:
            gain = P @ h / (h @ P @ h + deviation**2)
            unbalance = unbalance + gain * (measured - h @ unbalance)
            rest = np.eye(len(P)) - np.outer(gain, h)
            P = rest @ P @ rest.T + deviation**2 * np.outer(gain, gain)
    return unbalance, P


# -- answers -----------------------------------------------------------------------------------------------------------

ANSWERS: Mapping[str, Callable[[Pieces, Stand, State], Values]] = {
    "matrices": lambda at, stand, state: {name: getattr(at, name) for name in ("K", "K_dot", "M", "I", "J", "F")},
    "momentum": lambda at, stand, state: {
        "Z": momentum(at),
        "Z0": momentum_in_E0(at),
        "energy": kinetic_energy(at),
        "center_of_mass": center_of_mass(at),
        "center_of_mass_velocity": center_of_mass_velocity(at, stand),
    },
    "forward": motion.answer_forward,
    "torque": lambda at, stand, state: {"tau": motion.torque(at, vector(state.V_dot), vector(state.phi_ddot))},
    "mounts": lambda at, stand, state: {"mount_wrench": motion.mounts(at, vector(state.V_dot), vector(state.phi_ddot))},
    "coupled": motion.answer_coupled,
    "reaction": motion.answer_reaction,
    "points": lambda at, stand, state: {"points": motion.points(at, stand, vector(state.V_dot))},
    "generalized": coordinates.answer_generalized,
    "regressor": answer_regressor,
}
"""The answer to each want by the pieces, the stand and the state: values by the names of the contract."""

CHOSEN = ("inverse", "torque_for")
"""Wants that choose accelerations or torques, by thresholds; of a state with a task they answer this."""


def held_state(stand: Stand, state: State) -> State:
    """The state with V = S u, V* = S u*; as it is where the carrier is free. StateError: u of another length."""
    if stand.hold is None:
        return state
    S = twists(stand.hold)
    for name, rates in (("u", state.u), ("u_dot", state.u_dot)):
        if len(rates) != S.shape[1]:
            raise StateError(f"{name}: expected {count_numbers(S.shape[1])}, found {len(rates)}")
    V, V_dot = (cast(Vec6, tuple((S @ vector(rates)).tolist())) for rates in (state.u, state.u_dot))
    return replace(state, V=V, V_dot=V_dot)


def check_task_want(want: Sequence[str], task: str) -> None:
    """StateError where `want` asks for another motion beside that of the task, or for one of a task without a task."""
    if not task and "torque_for" in want:
        raise StateError("want: 'torque_for' needs a task and its demand")
    for name in TASK_CONFLICTS if task else ():
        if name in want:
            raise StateError(f"want: {name!r} and the task both give 'V_dot'; ask for them in two states")


def finite(value: Any) -> bool:
    """Whether every number of a result, however nested, is finite; floats only."""
    if isinstance(value, dict):
        return all(finite(part) for part in value.values())
    if isinstance(value, str):
        return True
    numbers = np.asarray(value)
    return numbers.dtype == object or bool(np.isfinite(numbers).all())


def evaluate(
    stand: Stand, state: State, want: Sequence[str], at: Pieces | None = None, cuts: inverse.Cuts = inverse.CUTS
) -> Values:
    """What `want` names, under the names of the contract: arrays, floats; status a string, rank an int.

    Of a task, other wants take the motion that results of `torque_for` where this is asked, else of `inverse`.

    `at`: the pieces of this stand and state, which then is that of `held_state`. `cuts`: thresholds of `inverse`.

    A held carrier moves with the state's u, u_dot, whatever its V, V_dot.

    StateError: `want` is empty, unknown, of a task without one, or gives one name two values; a law is undefined;
    `generalized` with a quaternion or at a singular attitude; `momentum` of a stand without mass; a result that is not
    finite.
    """
    if fault := want_fault(want):
        raise StateError(fault)
    values: Values = {}
    with np.errstate(all="ignore"):  # what overflows is not finite, and is reported below
        if at is None:
            state = held_state(stand, state)
            at = pieces(stand, state)
        check_task_want(want, state.task)
        moved, choose = state, inverse.answer_inverse
        if state.task:
            choose = inverse.answer_torque_for if "torque_for" in want else inverse.answer_task
        chosen = choose(at, stand, state, cuts) if state.task or "inverse" in want else {}
        if state.task:
            moved = replace(state, V_dot=tuple(chosen["V_dot"]), phi_ddot=tuple(chosen["phi_ddot"]))
        for name in want:
            asked = moved if name in TASK_TAKERS else state
            values |= chosen if name in CHOSEN else ANSWERS[name](at, stand, asked)
    for name, value in values.items():
        if not finite(value):
            raise StateError(f"{name}: not finite at this state")
    return values
