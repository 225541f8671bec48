"""Whether the equations of a stand with terms wrong still have one acceleration.

"All of X is missing" is true of every wrong program: its error is K V_r* less the right-hand side, and both are sums
of the products. But a program that answers has a mass matrix.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import rest_state
from mahovik.proof import reference
from mahovik.proof.diagnose.terms.directions import along_freedoms
from mahovik.proof.diagnose.terms.monomials import harmonics

SOLVABLE = 1e-6
"""Least singular value of the mass matrix of a program, scaled to unit diagonal of the right one."""

PHASES = 0.3, 1.1
"""Phase of the first flywheel, and from one to the next, at which the matrix is looked at: no harmonic is zero, rad."""


def has_mass_matrix(stand: Stand, errors: Iterable[tuple[str, str, float]]) -> bool:
    """Whether K of the stand, S^T K S of a held carrier, is regular with these errors of factors: component of the
    equations along what is free, product as it is written, error in SI; others than of accelerations do not matter."""
    along = along_freedoms(stand)
    if not along.components:
        return True
    names = [each.name for each in stand.flywheels]
    phi = np.array([PHASES[0] + PHASES[1] * i for i in range(len(names))])
    right = reference.pieces(stand, replace(rest_state(stand), phi=tuple(phi.tolist()))).K
    K = along.mass(right) @ along.freedoms
    waves = {" ".join(wave): float(values[0]) for wave, values in harmonics(names, phi[None, :])}
    wrong = K.copy()
    for component, term, error in errors:
        first, _, wave = term.partition(" ")
        if component in along.components and first in along.rates:
            rates = along.freedoms[along.rates.index(first)]
            wrong[along.components.index(component)] -= error * waves[wave] * rates
    size = np.sqrt(np.diag(K))
    return bool(np.linalg.svd(wrong / np.outer(size, size), compute_uv=False)[-1] > SOLVABLE)
