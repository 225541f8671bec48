"""Equations (2)-(11) derived with SymPy from the paper's own factors, and reduced to tables of harmonics.

Symbols are named like the places of the emitted C they become: `mu[0]`, `J[3]`. Nothing here knows numbers of a
stand, programs or C.
"""

from __future__ import annotations

SYMMETRIC = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
"""Order of the six numbers of a symmetric 3x3 matrix: 11, 22, 33, 12, 13, 23."""

SEQUENCES = {"ship": (3, 2, 1), "aircraft": (2, 3, 1), "euler": (3, 1, 3)}
"""Axes of the three elementary rotations, outermost first: C = C_i(psi) C_j(theta) C_k(phi)."""
