"""Orders and names that derivation and programs share, without SymPy."""

from __future__ import annotations

SYMMETRIC = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
"""Order of the six numbers of a symmetric 3x3 matrix: 11, 22, 33, 12, 13, 23."""

SEQUENCES = {"ship": (3, 2, 1), "aircraft": (2, 3, 1), "euler": (3, 1, 3)}
"""Axes of the three elementary rotations, outermost first: C = C_i(psi) C_j(theta) C_k(phi)."""

WEIGHTS = ("c", "s", "c2", "s2", "dc", "ds", "dc2", "ds2", "ddc", "dds", "phi_dot", "phi_ddot")
"""Names of the factors of a row's columns (accumulate.sums)."""
