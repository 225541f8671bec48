"""The parameters of a stand in which (8) and the drive torques are linear, in the order of the columns of Y."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.lower.units import added_mass as added_mass_unit
from mahovik.core.lower.units import law as damping_unit
from mahovik.core.stand.model import WRENCH_LETTERS, Stand
from mahovik.proof.reference.bodies import bodies_of, spatial_inertia
from mahovik.proof.reference.pieces import mass_matrix

Array = NDArray[np.float64]

BODY = (
    ("mass", "kg"),
    *((f"first_moment.{axis}", "kg m") for axis in "xyz"),
    *((f"inertia.J{place}", "kg m2") for place in ("11", "22", "33", "12", "13", "23")),
)
"""The ten parameters of a body, in its own frame about its origin, with their units."""

UPPER = tuple((i, j) for i in range(6) for j in range(i, 6))
"""Places of the 21 numbers of the added mass, row by row."""


@dataclass(frozen=True)
class Parameter:
    """A column of Y: `name`, unit, and the value that the stand file gives.

    The carrier's are those of all that is fixed in E1, instruments among it, in E1 about O1: only their sum acts.
    """

    name: str
    unit: str
    value: float


def parameters(stand: Stand) -> tuple[Parameter, ...]:
    """The columns of Y for a stand: carrier, flywheels, and where the stand has them added mass and damping."""
    return tuple(_parameters(stand))


def row_names(stand: Stand) -> tuple[str, ...]:
    """The rows of Y: the wrench on the carrier X Y Z K M N, then `tau NAME` of each flywheel."""
    return (*WRENCH_LETTERS, *(f"tau {s.name}" for s in stand.flywheels))


def _parameters(stand: Stand) -> Iterator[Parameter]:
    fixed = bodies_of(replace(stand, flywheels=()))
    yield from _ten(stand.carrier.name, mass_matrix(fixed))
    for s in stand.flywheels:
        yield from _ten(s.name, spatial_inertia(s))
    if _has_added_mass(stand):
        Lambda = fixed.Lambda.sum(axis=0)
        for i, j in UPPER:
            yield Parameter(f"added_mass[{i + 1},{j + 1}]", _plain(added_mass_unit(i, j).name), float(Lambda[i, j]))
    for name, matrix in _damping(stand).items():
        factors = 1 if name == "linear" else 2
        for i, row in enumerate(matrix):
            for j, value in enumerate(row):
                unit = _plain(damping_unit(i, (j,) * factors).name)
                yield Parameter(f"carrier.damping.{name}[{i + 1},{j + 1}]", unit, float(value))


def _ten(name: str, Theta: Array) -> Iterator[Parameter]:
    J = Theta[3:, 3:]
    moments = (J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[0, 2], J[1, 2])
    values = (Theta[0, 0], Theta[5, 1], Theta[3, 2], Theta[4, 0], *moments)
    for (what, unit), value in zip(BODY, values, strict=True):
        yield Parameter(f"{name}.{what}", unit, float(value))


def _plain(unit: str) -> str:
    """The unit as pages write it: `kg m` for `kg.m`."""
    return unit.replace(".", " ")


def _has_added_mass(stand: Stand) -> bool:
    return stand.carrier.added_mass is not None or any(p.added_mass is not None for p in stand.instruments)


def _damping(stand: Stand) -> Mapping[str, Any]:
    """Matrices of the carrier's damping, by name."""
    return {name: rows for law in stand.carrier.laws for name, rows in law.matrices.items()}


def assemble(stand: Stand, columns: Mapping[str, Array]) -> Array:
    """Y (n, 6 + N, P) of the columns of n states, as the C gives them by group."""
    carrier = columns["Y_carrier"]
    n, N = len(carrier), len(stand.flywheels)
    blocks = [_with_torques(carrier, N)]
    for s in range(N):
        block = _with_torques(columns["Y_flywheel"][:, s], N)
        block[:, 6 + s] = columns["Y_drive"][:, s]
        blocks.append(block)
    if _has_added_mass(stand):
        blocks.append(_with_torques(columns["Y_added_mass"], N))
    for name in _damping(stand):
        block = np.zeros((n, 6 + N, 6, 6))
        for i in range(6):
            block[:, i, i] = columns[f"Y_{name}"]
        blocks.append(block.reshape(n, 6 + N, 36))
    return np.concatenate(blocks, axis=2)


def _with_torques(wrench: Array, flywheels: int) -> Array:
    """Columns (n, 6, k) with rows of drive torques, all zero."""
    n, _, k = wrench.shape
    return np.concatenate([wrench, np.zeros((n, flywheels, k))], axis=1)
