"""Whether the equations of a stand with terms wrong still have one acceleration.

"All of X is missing" is true of every wrong program: its error is K V_r* less the right-hand side, and both are sums
of the products. But a program that answers has a mass matrix.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import WRENCH_LETTERS, Stand
from mahovik.core.stand.state import rest_state
from mahovik.proof import reference
from mahovik.proof.diagnose.terms.monomials import ACCELERATIONS, harmonics

SOLVABLE = 1e-6
"""Least singular value of the mass matrix of a program, scaled to unit diagonal of the right one."""

PHASES = 0.3, 1.1
"""Phase of the first flywheel, and from one to the next, at which the matrix is looked at: no harmonic is zero, rad."""


def has_mass_matrix(stand: Stand, errors: Iterable[tuple[str, str, float]]) -> bool:
    """Whether K of the stand is regular with these errors of factors: component of the wrench on the carrier (a letter
    of SNAME), product as it is written, error in SI; others than of accelerations do not matter."""
    names = [each.name for each in stand.flywheels]
    phi = np.array([PHASES[0] + PHASES[1] * i for i in range(len(names))])
    K = reference.pieces(stand, replace(rest_state(stand), phi=tuple(phi.tolist()))).K
    waves = {" ".join(wave): float(values[0]) for wave, values in harmonics(names, phi[None, :])}
    wrong = K.copy()
    for component, term, error in errors:
        first, _, wave = term.partition(" ")
        if component in WRENCH_LETTERS and first in ACCELERATIONS:
            wrong[WRENCH_LETTERS.index(component), ACCELERATIONS.index(first)] -= error * waves[wave]
    size = np.sqrt(np.diag(K))
    return bool(np.linalg.svd(wrong / np.outer(size, size), compute_uv=False)[-1] > SOLVABLE)
