"""The paper's factors: <a>, C1 C2 C3, T, [C], L, Phi(V), f, [<e>], Theta. Linear part first everywhere.

Symbols of vectors and matrices have elements `name[i]`, as lowering finds them again.
"""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive import SYMMETRIC

E3 = sp.eye(3)
f = sp.Matrix([0, 0, 0, 1, 0, 0])
"""Every flywheel spins about its own first axis: f = (0, e1)."""


def cross(a: sp.Matrix) -> sp.Matrix:
    """<a>, 3x3: <a> b = a x b."""
    return sp.Matrix([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def elementary(axis: int, angle: sp.Expr) -> sp.Matrix:
    """Active elementary rotation C1, C2 or C3 (axis 1, 2, 3): columns are the turned axes."""
    c, s = sp.cos(angle), sp.sin(angle)
    i, j = axis % 3, (axis + 1) % 3
    turned = sp.eye(3)
    turned[i, i] = turned[j, j] = c
    turned[i, j], turned[j, i] = -s, s
    return turned


def blocks(upper_left: sp.Matrix, upper_right: sp.Matrix, lower_left: sp.Matrix, lower_right: sp.Matrix) -> sp.Matrix:
    """6x6 matrix of four 3x3 blocks."""
    return sp.Matrix(sp.BlockMatrix([[upper_left, upper_right], [lower_left, lower_right]]))


def T(O: sp.Matrix) -> sp.Matrix:
    """Shift of a wrench from the point O to the origin: [[E, 0], [<O>, E]]."""
    return blocks(E3, sp.zeros(3), cross(O), E3)


def bracket(C: sp.Matrix) -> sp.Matrix:
    """[C] = diag(C, C)."""
    return blocks(C, sp.zeros(3), sp.zeros(3), C)


def L(O: sp.Matrix, C: sp.Matrix) -> sp.Matrix:
    """L = T [C]: wrenches and momenta from a child frame to its parent; L^T carries twists back."""
    return T(O) * bracket(C)


def Phi(V: sp.Matrix) -> sp.Matrix:
    """Phi(V) = [[<omega>, 0], [<v>, <omega>]]."""
    v, omega = V[:3, :], V[3:, :]
    return blocks(cross(omega), sp.zeros(3), cross(v), cross(omega))


def e_bracket() -> sp.Matrix:
    """[<e>] = diag(<e1>, <e1>)."""
    return bracket(cross(sp.Matrix([1, 0, 0])))


def Theta(m: sp.Expr, b: sp.Matrix, J: sp.Matrix) -> sp.Matrix:
    """Spatial (Mises) inertia about the frame's origin, of mass m, first moment b = m rc, J about the origin."""
    return blocks(m * E3, -cross(b), cross(b), J)


def vector(name: str, size: int = 3) -> sp.Matrix:
    """Column of symbols name[0], name[1], ..."""
    return sp.Matrix([sp.Symbol(f"{name}[{i}]") for i in range(size)])


def matrix(name: str) -> sp.Matrix:
    """3x3 matrix of symbols name[0..8], row by row."""
    return sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"{name}[{3 * i + j}]"))


def symmetric(name: str) -> sp.Matrix:
    """Symmetric 3x3 matrix of symbols name[0..5] in the order 11, 22, 33, 12, 13, 23."""
    return from_six(vector(name, 6))


def from_six(six: sp.Matrix) -> sp.Matrix:
    """Symmetric 3x3 matrix from its six numbers."""
    index = {pair: k for k, pair in enumerate(SYMMETRIC)}
    return sp.Matrix(3, 3, lambda i, j: six[index[min(i, j), max(i, j)]])


def six_of(full: sp.Matrix) -> sp.Matrix:
    """The six numbers of a symmetric 3x3 matrix."""
    return sp.Matrix([full[pair] for pair in SYMMETRIC])
