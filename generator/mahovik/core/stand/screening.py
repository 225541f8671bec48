"""Samples whose bodies surely can be, and stands that surely have inertia in every motion: arrays, no eigenvalues.

A test that is sufficient, not necessary: what it doubts, `physical` decides, on the stand of that sample alone.

Bodies: second moments about the centre of mass, P = tr(J)/2 E - J, are positive semidefinite, to less than what
`physical` allows. Stands: the Schur complement S of the mass matrix, flywheels eliminated, is at least the inertia of
the carrier; scaled by a bound of the diagonal it is above `_FIXED`. Then the mass matrix at unit diagonal is above
`_FIXED` / 50: with x = (u, w), x^T M x = u^T S u + |w + B^T u|^2, where |B|^2 <= 18, as nonnegative harmonics up to the
second are at most three times their mean.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.columns import Column, numbers
from mahovik.core.stand.masses import mount_of
from mahovik.core.stand.model import Body, Carrier, Flywheel, Instrument, Stand
from mahovik.core.stand.physical import LARGEST, LEAST_EIGENVALUE, RELATIVE

Array = NDArray[Any]
Matrix = list[list[Any]]

_FIXED = 1000 * LEAST_EIGENVALUE


def doubtful_samples(stand: Stand, n: int) -> NDArray[np.bool_]:
    """Samples, of a stand with columns, that are not surely in order."""
    sure = np.ones(n, dtype=np.bool_)
    with np.errstate(all="ignore"):
        varied = [body for body in stand.bodies if any(isinstance(x, Column) for x in numbers(body))]
        for body in varied:
            sure &= _possible(body)
        if varied:
            sure &= _moved_everywhere(stand)
    if stand.tasks and any(isinstance(x, Column) for x in _places_of_tasks(stand)):
        sure[:] = False
    return ~sure


def _places_of_tasks(stand: Stand) -> Iterator[Any]:
    """Numbers of where the rows of tasks are: whether these go together, only `task` says."""
    named = {row.of for task in stand.tasks for row in task.rows}
    yield from (x for body in stand.instruments for x in numbers((body.position, body.angles)))
    yield from (x for p in stand.points if p.name in named for x in numbers((p.position, p.angles)))


def _plain(value: Any) -> Any:
    """Numbers of all samples as an array, one for all as it is; lists of them."""
    if isinstance(value, tuple | list):
        return [_plain(each) for each in value]
    return value.values if isinstance(value, Column) else value


def _possible(body: Body) -> Any:
    sure: Any = True
    for x in numbers(body):
        sure = sure & (np.abs(_plain(x)) <= LARGEST)
    J, central, scale = _tensors(body)
    half = (central[0][0] + central[1][1] + central[2][2]) / 2
    moments = [[(half if i == j else 0.0) - central[i][j] for j in range(3)] for i in range(3)]
    for i in range(3):
        moments[i][i] = moments[i][i] + 0.4 * RELATIVE * scale
    sure = sure & ((scale == 0.0) | _definite(moments))
    if isinstance(body, Flywheel):
        sure = sure & (J[0][0] > RELATIVE * scale) & (scale > 0.0)
    if isinstance(body, Carrier | Instrument) and any(isinstance(x, Column) for x in numbers(body.added_mass)):
        sure = sure & _is_semidefinite(_plain(body.added_mass))
    return sure


def _tensors(body: Body) -> tuple[Matrix, Matrix, Any]:
    """Inertia about the origin, about the centre of mass, and the size of both."""
    m, c, given = _plain(body.mass), _plain(body.center_of_mass), _plain(body.inertia)
    square = c[0] * c[0] + c[1] * c[1] + c[2] * c[2]
    shift = [[m * ((square if i == j else 0.0) - c[i] * c[j]) for j in range(3)] for i in range(3)]
    sign = 1.0 if body.inertia_about == "center_of_mass" else -1.0
    other = [[given[i][j] + sign * shift[i][j] for j in range(3)] for i in range(3)]
    J, central = (given, other) if sign < 0 else (other, given)
    scale: Any = 0.0
    for tensor in (given, central):
        for row in tensor:
            for x in row:
                scale = np.maximum(scale, np.abs(x))
    return J, central, scale


def _definite(matrix: Matrix) -> Any:
    """Is it positive definite? L D L^T, sample by sample."""
    size = len(matrix)
    L: Matrix = [[0.0] * size for _ in range(size)]
    D: list[Any] = []
    sure: Any = True
    for i in range(size):
        rest = matrix[i][i]
        for j in range(i):
            entry = matrix[i][j]
            for k in range(j):
                entry = entry - L[i][k] * D[k] * L[j][k]
            L[i][j] = entry / D[j]
            rest = rest - L[i][j] * entry
        sure = sure & (rest > 0.0)
        D.append(rest)
    return sure


def _is_semidefinite(added: Matrix) -> Any:
    """Is added mass surely positive semidefinite? Rows without any number are left out."""
    kept = [i for i in range(6) if not all(isinstance(x, float) and x == 0.0 for x in added[i])]
    rows = [[added[i][j] * (1.0 + 0.4 * RELATIVE if i == j else 1.0) for j in kept] for i in kept]
    return _definite(rows)


def _moved_everywhere(stand: Stand) -> Any:
    """Has every motion of the carrier inertia by the carrier alone, for all phases?"""
    mass: Any = 0.0
    moment: Any = 0.0
    for body in stand.bodies:
        m, c, (_, central, _) = _plain(body.mass), _plain(body.center_of_mass), _tensors(body)
        reach = _length(c)
        if isinstance(body, Instrument | Flywheel):
            reach = reach + _length(_plain(body.position))
        mount = mount_of(stand, body) if isinstance(body, Flywheel) else None
        if mount is not None:
            reach = reach + _length(_plain(mount.position))
        mass = mass + m
        moment = moment + (np.abs(central[0][0]) + np.abs(central[1][1]) + np.abs(central[2][2])) + m * reach * reach
    force, turn = [mass] * 3, [moment] * 3
    fixed_bodies: tuple[Carrier | Instrument, ...] = (stand.carrier, *stand.instruments)
    for fixed in fixed_bodies:
        if fixed.added_mass is not None:
            diagonal = [np.abs(_plain(fixed.added_mass[i][i])) for i in range(6)]
            force = [force[i] + diagonal[i] for i in range(3)]
            turn = [turn[i] + diagonal[i + 3] for i in range(3)]
    scale = [1.0 / np.sqrt(x) for x in (*force, *turn)]
    m, c = _plain(stand.carrier.mass), _plain(stand.carrier.center_of_mass)
    J, _, _ = _tensors(stand.carrier)
    x, y, z = (m * each for each in c)
    cross = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
    theta: Matrix = [[0.0] * 6 for _ in range(6)]
    for i in range(3):
        theta[i][i] = m
        for j in range(3):
            theta[3 + i][j], theta[j][3 + i] = cross[i][j], cross[i][j]
            theta[3 + i][3 + j] = J[i][j]
    scaled = [[theta[i][j] * scale[i] * scale[j] - (_FIXED if i == j else 0.0) for j in range(6)] for i in range(6)]
    return _definite(scaled)


def _length(vector: list[Any]) -> Any:
    return np.sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2])
