"""Regressor: what (8) and the drive torques take of each mass, first moment and moment of inertia; `identify_step`.

Both are linear in them, so a column is the literal answer for a stand on which one parameter is 1 and all others are 0.
A first moment without a mass cannot be written as a centre of mass: its column is that of a body of 1 kg with its
centre at 1 m, less that of the same body with its centre at the origin.
"""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType
from typing import Any, TypeVar

import numpy as np

from mahovik.core.stand.model import Body, Stand, State
from mahovik.proof.reference.array import Array, Values, vector
from mahovik.proof.reference.assembly import pieces
from mahovik.proof.reference.motion import forward, reaction, torque
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.screw import E, zero

_MOMENTS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
"""Order of the moments of inertia: 11, 22, 33, 12, 13, 23."""

AnyBody = TypeVar("AnyBody", bound=Body)


def required_loads(stand: Stand, state: State) -> Array:
    """K V_r* + M V_r + I phi'' + J phi' - F, and tau (6 + N): what the motion of the state takes besides F."""
    at, V_dot, phi_ddot = pieces(stand, state), vector(state.V_dot), vector(state.phi_ddot)
    return np.concatenate([reaction(at, V_dot, phi_ddot), torque(at, V_dot, phi_ddot)])


def _one_body(stand: Stand, name: str, mass: float, center: Array, J: Array, Lambda: Array | None = None) -> Stand:
    """The stand with its places alone, but for one body's mass, centre and J (3x3) about its origin, or added mass.

    No law acts but weight; nothing holds the carrier.
    """

    def bare(body: AnyBody) -> AnyBody:
        m, rc, inertia = (mass, center, J) if body.name == name else (0.0, zero[0], zero)
        numbers = {"mass": m, "center_of_mass": _nested(rc), "inertia": _nested(inertia)}
        return replace(body, laws=(), inertia_about="origin", **numbers)

    return replace(
        stand,
        laws=(),
        carrier=replace(bare(stand.carrier), added_mass=None if Lambda is None else _nested(Lambda)),
        instruments=tuple(replace(bare(p), added_mass=None) for p in stand.instruments),
        flywheels=tuple(bare(s) for s in stand.flywheels),
        hold=None,
    )


def _nested(numbers: Array) -> Any:
    """A vector or a matrix as the stand has it."""
    return tuple(tuple(row.tolist()) if row.ndim else float(row) for row in numbers)


def _unit(i: int, j: int, size: int) -> Array:
    """Symmetric matrix with 1 at i, j."""
    unit = np.zeros((size, size))
    unit[i, j] = unit[j, i] = 1.0
    return unit


def body_columns(stand: Stand, state: State, name: str) -> Array:
    """The ten columns of a body (6 + N x 10): mass, first moment, J about its origin, in its own frame."""

    def loads(mass: float, center: Array, J: Array) -> Array:
        return required_loads(_one_body(stand, name, mass, center, J), state)

    mass = loads(1.0, zero[0], zero)
    first = [loads(1.0, axis, zero) - mass for axis in E]
    return np.column_stack([mass, *first, *(loads(0.0, zero[0], _unit(i, j, 3)) for i, j in _MOMENTS)])


def added_mass_columns(stand: Stand, state: State) -> Array:
    """Columns of the upper half of the added mass (6 x 21), row by row; both halves change together."""
    units = [_unit(i, j, 6) for i in range(6) for j in range(i, 6)]
    return np.column_stack(
        [required_loads(_one_body(stand, stand.carrier.name, 0.0, zero[0], zero, L), state)[:6] for L in units]
    )


def answer_regressor(at: Pieces, stand: Stand, state: State) -> Values:
    """Columns by the names of the C; those of the added mass only if the stand has it.

    Linear damping A of the carrier takes A V_r, quadratic damping A (V_r |V_r|): row i has A[i][j] times number j.
    """
    state = replace(state, wrench=MappingProxyType({}))
    values: Values = {"Y_carrier": body_columns(stand, state, stand.carrier.name)[:6]}
    if stand.flywheels:
        columns = np.stack([body_columns(stand, state, s.name) for s in stand.flywheels])
        values["Y_flywheel"] = columns[:, :6]
        values["Y_drive"] = np.array([of_wheel[6 + s] for s, of_wheel in enumerate(columns)])
    if stand.carrier.added_mass is not None or any(p.added_mass is not None for p in stand.instruments):
        values["Y_added_mass"] = added_mass_columns(stand, state)
    return values | {"Y_linear": at.V_r, "Y_quadratic": at.V_r * np.abs(at.V_r)}


# Recursive least squares of static unbalances, in the covariance form, all channels at once.


def slopes(stand: Stand, state: State) -> Array:
    """-K^-1 Y (6x2N): K V* = F - ... - Y u, so that an unbalance u changes V* by this."""
    columns = [body_columns(stand, state, s.name)[:6, 2:4] for s in stand.flywheels]
    return np.asarray(-np.linalg.solve(pieces(stand, state).K, np.hstack(columns)))


def identify_step(
    stand: Stand, state: State, noise: Array, forget: float, unbalance: Array, covariance: Array
) -> tuple[Array, Array]:
    """Static unbalances (2N; kg m) and their covariance (2Nx2N) after one sample, from those before it.

    m rc along axes 2 and 3 of each flywheel, to be added. V_dot of the state is measured, with standard deviations
    `noise` (6).
    """
    H = slopes(stand, state)
    excess = vector(state.V_dot) - forward(pieces(stand, state), vector(state.phi_ddot))
    P = covariance * (1.0 + forget)
    gain = P @ H.T @ np.linalg.inv(H @ P @ H.T + np.diag(noise**2))
    return unbalance + gain @ (excess - H @ unbalance), P - gain @ H @ P
