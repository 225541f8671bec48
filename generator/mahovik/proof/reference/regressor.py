"""Regressor: what (8) and the drive torques take of each mass, first moment and moment of inertia; `identify_step`.

Both are linear in them, so a column is the literal answer for a stand on which one parameter is 1 and all others are 0.
A first moment without a mass cannot be written as a centre of mass: its column is that of a body of 1 kg with its
centre at 1 m, less that of the same body with its centre at the origin.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TypeVar, cast

import numpy as np

from mahovik.core.stand.model import Body, Mat3, Mat6, Stand, Vec3
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array, Values, vector
from mahovik.proof.reference.motion import bias, forward, torque
from mahovik.proof.reference.pieces import Pieces, pieces

_MOMENTS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
"""Order of the moments of inertia: 11, 22, 33, 12, 13, 23."""

AnyBody = TypeVar("AnyBody", bound=Body)


@dataclass(frozen=True, eq=False)
class Column:
    """Wrench on the carrier (6; N, N m by the parameter's unit) and drive torques (N) by one parameter."""

    wrench: Array
    tau: Array

    def __sub__(self, other: Column) -> Column:
        return Column(self.wrench - other.wrench, self.tau - other.tau)


def required_loads(stand: Stand, state: State) -> Column:
    """K V_r* + M V_r + I phi'' + J phi' - F (6), and tau (N): what the motion of the state takes besides F."""
    at = pieces(stand, state)
    V_dot, phi_ddot = vector(state.V_dot), vector(state.phi_ddot)
    wrench = at.K @ at.V_r_dot(V_dot) + bias(at) + at.I @ phi_ddot - at.F
    return Column(wrench, torque(at, V_dot, phi_ddot))


def massless(stand: Stand) -> Stand:
    """The stand with its places alone: no mass, no law but weight, no stiffness, no added mass, no run-time wrench."""

    def bare(body: AnyBody) -> AnyBody:
        return with_inertia(replace(body, laws=()), 0.0, (0.0, 0.0, 0.0), np.zeros((3, 3)))

    return replace(
        stand,
        laws=(),
        carrier=replace(bare(stand.carrier), added_mass=None),
        instruments=tuple(replace(bare(p), added_mass=None) for p in stand.instruments),
        flywheels=tuple(bare(s) for s in stand.flywheels),
        hold=None,
    )


def with_inertia(body: AnyBody, mass: float, center: Vec3, J: Array) -> AnyBody:
    """The body with mass (kg), centre of mass (m) and J about its origin (3x3, kg m2)."""
    inertia = cast(Mat3, tuple(tuple(row) for row in J.tolist()))
    return replace(body, mass=mass, center_of_mass=center, inertia=inertia, inertia_about="origin")


def units() -> Iterator[tuple[tuple[float, Vec3, Array], tuple[float, Vec3, Array] | None]]:
    """Mass, centre and inertia of the body of each of the ten columns, and of the body that is taken from it."""
    none, still = np.zeros((3, 3)), (0.0, 0.0, 0.0)
    yield (1.0, still, none), None
    for k in range(3):
        yield (1.0, cast(Vec3, tuple(np.eye(3)[k].tolist())), none), (1.0, still, none)
    for i, j in _MOMENTS:
        J = np.zeros((3, 3))
        J[i, j] = J[j, i] = 1.0
        yield (0.0, still, J), None


def body_columns(stand: Stand, state: State, name: str) -> list[Column]:
    """The ten columns of a body: mass, first moment, J about its origin, in its own frame."""
    bare, found = massless(stand), []
    for given, taken in units():
        column = required_loads(_with_body(bare, name, *given), state)
        found.append(column if taken is None else column - required_loads(_with_body(bare, name, *taken), state))
    return found


def _with_body(stand: Stand, name: str, mass: float, center: Vec3, J: Array) -> Stand:
    """The stand with other inertia of one body."""

    def change_body(body: AnyBody) -> AnyBody:
        return with_inertia(body, mass, center, J) if body.name == name else body

    return replace(
        stand,
        carrier=change_body(stand.carrier),
        instruments=tuple(map(change_body, stand.instruments)),
        flywheels=tuple(map(change_body, stand.flywheels)),
    )


def added_mass_columns(stand: Stand, state: State) -> list[Column]:
    """Columns of the upper half of the added mass, row by row; both halves change together."""
    bare, found = massless(stand), []
    for i in range(6):
        for j in range(i, 6):
            Lambda = np.zeros((6, 6))
            Lambda[i, j] = Lambda[j, i] = 1.0
            given = cast(Mat6, tuple(tuple(row) for row in Lambda.tolist()))
            found.append(required_loads(replace(bare, carrier=replace(bare.carrier, added_mass=given)), state))
    return found


def answer_regressor(at: Pieces, stand: Stand, state: State) -> Values:
    """Columns by the names of the C; those of the added mass only if the stand has it.

    Linear damping A of the carrier takes A V_r, quadratic damping A (V_r |V_r|): row i has A[i][j] times number j.
    """
    state = replace(state, wrench=MappingProxyType({}))
    values: Values = {"Y_carrier": wrenches(body_columns(stand, state, stand.carrier.name))}
    if stand.flywheels:
        own = [body_columns(stand, state, s.name) for s in stand.flywheels]
        values["Y_flywheel"] = np.stack([wrenches(columns) for columns in own])
        values["Y_drive"] = np.array([[column.tau[s] for column in columns] for s, columns in enumerate(own)])
    if stand.carrier.added_mass is not None or any(p.added_mass is not None for p in stand.instruments):
        values["Y_added_mass"] = wrenches(added_mass_columns(stand, state))
    return values | {"Y_linear": at.V_r, "Y_quadratic": at.V_r * np.abs(at.V_r)}


def wrenches(columns: list[Column]) -> Array:
    """Wrenches of columns, side by side (6xn)."""
    return np.column_stack([column.wrench for column in columns])


# Recursive least squares of static unbalances, in the covariance form, all channels at once.


@dataclass(frozen=True, eq=False)
class Estimate:
    """Static unbalances (2N; kg m): m rc along axes 2 and 3 of each flywheel, to be added; their covariance (2Nx2N)."""

    unbalance: Array
    covariance: Array


@dataclass(frozen=True, eq=False)
class Sample:
    """Measured less modelled V* (6), its slopes by the unbalances (6x2N), and the gain of the step (2Nx6)."""

    excess: Array
    slopes: Array
    gain: Array


def slopes(stand: Stand, state: State) -> Array:
    """-K^-1 Y (6x2N): K V* = F - ... - Y u, so that an unbalance u changes V* by this."""
    columns = [body_columns(stand, state, s.name)[k].wrench for s in stand.flywheels for k in (2, 3)]
    return np.asarray(-np.linalg.solve(pieces(stand, state).K, np.column_stack(columns)))


def identify_step(stand: Stand, state: State, noise: Array, forget: float, before: Estimate) -> tuple[Estimate, Sample]:
    """The estimate after one sample: V_dot of the state is measured, with standard deviations `noise` (6)."""
    H = slopes(stand, state)
    excess = vector(state.V_dot) - forward(pieces(stand, state), vector(state.phi_ddot))
    P = before.covariance * (1.0 + forget)
    gain = P @ H.T @ np.linalg.inv(H @ P @ H.T + np.diag(noise**2))
    unbalance = before.unbalance + gain @ (excess - H @ before.unbalance)
    return Estimate(unbalance, P - gain @ H @ P), Sample(excess, H, gain)
