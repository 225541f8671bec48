"""Writes SymForce's C++ of K and the right side of (8): python -m mahovik_bench.write_symforce FOLDER N.

Literal expressions through its `Codegen`; the six equations are solved in native/symforce_peer.cpp.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import symforce

symforce.set_epsilon_to_number()

# SymForce wants its epsilon before anything of it is used, here or by an import: so these come second.
import symforce.symbolic as sf  # noqa: E402 - after the epsilon
from symforce import codegen, values  # noqa: E402 - after the epsilon

from mahovik.proof.reference.algebra import flywheel_mounting  # noqa: E402 - after the epsilon
from mahovik.proof.reference.pieces import spatial_inertia  # noqa: E402 - after the epsilon
from mahovik_bench.cases import case  # noqa: E402 - after the epsilon

ZERO = sf.Matrix(3, 3)


def cross(a: Any) -> Any:
    """<a>."""
    return sf.Matrix([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def blocks(a: Any, b: Any, c: Any, d: Any) -> Any:
    """[[a, b], [c, d]]."""
    return sf.Matrix.block_matrix([[a, b], [c, d]])


def phi_of(V: Any) -> Any:
    """Phi(V)."""
    return blocks(cross(V[3:]), ZERO, cross(V[:3]), cross(V[3:]))


def exact(array: Any) -> Any:
    """Numbers; zeros are left out of products."""
    rows = np.atleast_2d(array).tolist()
    return sf.Matrix([[0 if x == 0 else x for x in row] for row in rows])


def equations(N: int, V: Any, phi: Any, phi_dot: Any, phi_ddot: Any) -> tuple[Any, Any]:
    """K and F - M V - J phi' - I phi'' of (8)."""
    stand = case(N).stand
    f = sf.Matrix([0, 0, 0, 1, 0, 0])
    e1 = [1, 0, 0]
    spin = blocks(cross(e1), ZERO, ZERO, cross(e1))
    K, K_dot, rest = exact(spatial_inertia(stand.carrier)), sf.Matrix(6, 6), sf.Matrix(6, 1)
    for i, s in enumerate(stand.flywheels):
        c, z = sf.cos(phi[i]), sf.sin(phi[i])
        C = exact(flywheel_mounting(s)) * sf.Matrix([[1, 0, 0], [0, c, -z], [0, z, c]])
        L = blocks(C, ZERO, cross(s.position) * C, C)
        Theta = exact(spatial_inertia(s))
        K = K + L * Theta * L.T
        K_dot = K_dot + L * (spin * Theta - Theta * spin) * L.T * phi_dot[i]
        rest = rest + L * Theta * f * phi_ddot[i] + (phi_of(V) * L + L * spin * phi_dot[i]) * Theta * f * phi_dot[i]
    return K, -(phi_of(V) * K + K_dot) * V - rest


def main() -> None:
    """Writes literal.h."""
    folder, N = Path(sys.argv[1]), int(sys.argv[2])
    lengths = {"V": 6, "phi": N, "phi_dot": N, "phi_ddot": N}
    symbols = values.Values(**{name: sf.Matrix(n, 1).symbolic(name) for name, n in lengths.items()})
    K, b = equations(N, *(symbols[name] for name in lengths))
    written = codegen.Codegen(
        inputs=symbols, outputs=values.Values(K=K, b=b), config=codegen.CppConfig(), name="literal"
    )
    written.generate_function(output_dir=folder, skip_directory_nesting=True)


if __name__ == "__main__":
    main()
