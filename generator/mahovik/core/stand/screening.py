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

from mahovik.core.stand.columns import Column, numbers, values_of
from mahovik.core.stand.masses import mount_of
from mahovik.core.stand.model import Body, Carrier, Flywheel, Instrument, Stand
from mahovik.core.stand.physical import LARGEST, LEAST_EIGENVALUE, RELATIVE

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_FIXED = 1000 * LEAST_EIGENVALUE


def doubtful_samples(stand: Stand, n: int) -> Flags:
    """Samples, of a stand with columns, that are not surely in order."""
    sure = np.ones(n, dtype=np.bool_)
    with np.errstate(all="ignore"):
        varied = [body for body in stand.bodies if _vary(body)]
        for body in varied:
            sure &= _possible(body, n)
        if varied:
            sure &= _moved_everywhere(stand, n)
    if stand.tasks and any(isinstance(x, Column) for x in _places_of_tasks(stand)):
        sure[:] = False
    return ~sure


def _vary(value: Any) -> bool:
    return any(isinstance(x, Column) for x in numbers(value))


def _places_of_tasks(stand: Stand) -> Iterator[Any]:
    """Numbers of where the rows of tasks are: whether these go together, only `task` says."""
    named = {row.of for task in stand.tasks for row in task.rows}
    yield from (x for body in stand.instruments for x in numbers((body.position, body.angles)))
    yield from (x for p in stand.points if p.name in named for x in numbers((p.position, p.angles)))


def _samples(value: Any, n: int) -> Array:
    """Numbers of all samples (n), vectors (n, 3) or matrices (n, 3, 3)."""
    if isinstance(value, tuple | list):
        return np.stack([_samples(entry, n) for entry in value], axis=1)
    return values_of(value, n)


def _possible(body: Body, n: int) -> Flags:
    sure = np.ones(n, dtype=np.bool_)
    for x in numbers(body):
        sure &= np.abs(values_of(x, n)) <= LARGEST
    J, central, scale = _tensors(body, n)
    half = np.trace(central, axis1=1, axis2=2) / 2 + 0.4 * RELATIVE * scale
    sure &= (scale == 0.0) | _definite(half[:, None, None] * np.eye(3) - central)
    if isinstance(body, Flywheel):
        sure &= (J[:, 0, 0] > RELATIVE * scale) & (scale > 0.0)
    if isinstance(body, Carrier | Instrument) and _vary(body.added_mass):
        added = _samples(body.added_mass, n)
        kept = np.flatnonzero(added.any(axis=(0, 2)))  # rows without any number are left out
        sure &= _definite((added * (1.0 + 0.4 * RELATIVE * np.eye(6)))[:, kept][:, :, kept])
    return sure


def _tensors(body: Body, n: int) -> tuple[Array, Array, Array]:
    """Inertia about the origin (n, 3, 3), about the centre of mass, and the size of both (n)."""
    m, c, typed = _samples(body.mass, n), _samples(body.center_of_mass, n), _samples(body.inertia, n)
    outer = c[:, :, None] * c[:, None, :]
    shift = m[:, None, None] * (np.trace(outer, axis1=1, axis2=2)[:, None, None] * np.eye(3) - outer)
    about_center = body.inertia_about == "center_of_mass"
    J, central = (typed + shift, typed) if about_center else (typed, typed - shift)
    return J, central, np.maximum(np.abs(typed).max(axis=(1, 2)), np.abs(central).max(axis=(1, 2)))


def _definite(matrices: Array) -> Flags:
    """Are symmetric matrices (n, k, k) positive definite? By the pivots of elimination."""
    sure = np.ones(len(matrices), dtype=np.bool_)
    for i in range(matrices.shape[1]):
        pivot = matrices[:, i, i]
        sure &= pivot > 0.0
        matrices = matrices - matrices[:, :, i, None] * matrices[:, None, i] / pivot[:, None, None]
    return sure


def _moved_everywhere(stand: Stand, n: int) -> Flags:
    """Has every motion of the carrier inertia by the carrier alone, for all phases?"""
    diagonal = np.zeros((n, 6))
    for body in stand.bodies:
        m, (_, central, _) = _samples(body.mass, n), _tensors(body, n)
        mount = mount_of(stand, body) if isinstance(body, Flywheel) else None
        places = (getattr(placed, "position", (0.0,) * 3) for placed in (body, mount))
        reach = sum(np.linalg.norm(_samples(place, n), axis=1) for place in (body.center_of_mass, *places))
        moment = np.abs(np.diagonal(central, axis1=1, axis2=2)).sum(axis=1) + m * reach**2
        diagonal += np.repeat(np.stack([m, moment], axis=1), 3, axis=1)
        if isinstance(body, Carrier | Instrument) and body.added_mass is not None:
            diagonal += np.abs(np.diagonal(_samples(body.added_mass, n), axis1=1, axis2=2))
    scale = 1.0 / np.sqrt(diagonal)
    m, c = _samples(stand.carrier.mass, n), _samples(stand.carrier.center_of_mass, n)
    theta = np.zeros((n, 6, 6))
    theta[:, :3, :3] = m[:, None, None] * np.eye(3)
    theta[:, 3:, :3] = m[:, None, None] * np.cross(np.eye(3), c[:, None, :])
    theta[:, :3, 3:] = np.swapaxes(theta[:, 3:, :3], 1, 2)
    theta[:, 3:, 3:] = _tensors(stand.carrier, n)[0]
    return _definite(theta * scale[:, :, None] * scale[:, None, :] - _FIXED * np.eye(6))
