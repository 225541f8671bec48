"""Writes SymPy's C of K and the right side of (8): python -m mahovik_bench.write_sympy FOLDER N.

Literal expressions, `cse`, `ccode`; the six equations are solved in native/sympy_peer.c.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp

from mahovik.proof.reference.bodies import spatial_inertia
from mahovik.proof.reference.rotation import flywheel_mounting
from mahovik_bench.cases import case

HEAD = """#include <math.h>
void literal(const double *V, const double *phi, const double *phi_dot, const double *phi_ddot, double *K, double *b)
{
"""


def cross(a: Any) -> Any:
    """<a>."""
    return sp.Matrix([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def blocks(a: Any, b: Any, c: Any, d: Any) -> Any:
    """[[a, b], [c, d]]."""
    return sp.Matrix(sp.BlockMatrix([[a, b], [c, d]]))


def phi_of(V: Any) -> Any:
    """Phi(V)."""
    return blocks(cross(V[3:]), sp.zeros(3), cross(V[:3]), cross(V[3:]))


def exact(array: Any) -> Any:
    """Numbers as SymPy's; zeros are left out of products."""
    return sp.Matrix(array).applyfunc(lambda x: sp.Integer(0) if x == 0 else sp.Float(x, 17))


def equations(N: int) -> tuple[Any, Any]:
    """K and F - M V - J phi' - I phi'' of (8)."""
    stand = case(N).stand
    V, phi, speed, acceleration = (
        [sp.Symbol(f"{name}[{i}]", real=True) for i in range(n)]
        for name, n in (("V", 6), ("phi", N), ("phi_dot", N), ("phi_ddot", N))
    )
    f = sp.Matrix([0, 0, 0, 1, 0, 0])
    e1 = sp.Matrix([1, 0, 0])
    spin = blocks(cross(e1), sp.zeros(3), sp.zeros(3), cross(e1))
    K, K_dot, rest = exact(spatial_inertia(stand.carrier)), sp.zeros(6), sp.zeros(6, 1)
    for s, angle, rate, rate_dot in zip(stand.flywheels, phi, speed, acceleration, strict=True):
        c, z = sp.cos(angle), sp.sin(angle)
        C = exact(flywheel_mounting(s)) * sp.Matrix([[1, 0, 0], [0, c, -z], [0, z, c]])
        L = blocks(C, sp.zeros(3), cross(exact(np.array(s.position))) * C, C)
        Theta = exact(spatial_inertia(s))
        K += L * Theta * L.T
        K_dot += L * (spin * Theta - Theta * spin) * L.T * rate
        rest += L * Theta * f * rate_dot + (phi_of(V) * L + L * spin * rate) * Theta * f * rate
    V_ = sp.Matrix(V)
    return K, -(phi_of(V) * K + K_dot) * V_ - rest


def main() -> None:
    """Writes literal.c."""
    folder, N = Path(sys.argv[1]), int(sys.argv[2])
    parts, results = sp.cse(equations(N), symbols=sp.numbered_symbols("x"))
    lines = [f"    const double {name} = {sp.ccode(e)};" for name, e in parts]
    for name, matrix in zip("Kb", results, strict=True):
        lines += [f"    {name}[{i}] = {sp.ccode(e)};" for i, e in enumerate(matrix)]
    (folder / "literal.c").write_text(HEAD + "\n".join(lines) + "\n}\n", encoding="ascii")


if __name__ == "__main__":
    main()
