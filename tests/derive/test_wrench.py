"""Factors and wrenches of (7): each expression against the mechanics it stands for, exactly."""

from __future__ import annotations

import pytest
import sympy as sp

from derive.exact import remainders, trigonometric
from mahovik.core.derive import carrying as derived
from mahovik.core.derive.screw import L, Phi, bracket, cross, e_bracket, elementary, f, matrix, vector


def cross_product(a: sp.Matrix, b: sp.Matrix) -> sp.Matrix:
    """a x b by SymPy's own."""
    return a.cross(b)


@pytest.mark.parametrize("axis", [1, 2, 3])
def test_elementary_rotations_are_active_and_right_handed(axis: int) -> None:
    """C' = <e> C and C(0) = E: this and nothing else is the rotation about e."""
    phi = sp.Symbol("phi")
    C = elementary(axis, phi)
    e = sp.Matrix([1 if k == axis else 0 for k in (1, 2, 3)])
    assert C.subs(phi, 0) == sp.eye(3)
    assert remainders(trigonometric(C.diff(phi) - cross(e) * C, phi)) == []


def test_L_carries_wrenches_to_the_parent_and_twists_back() -> None:
    """L (f, n) = (C f, C n + O x C f); L^T (v, omega) = C^T (v + omega x O, omega)."""
    O, C = vector("O"), matrix("C")
    force, moment, v, omega = (vector(n) for n in ("f", "n", "v", "omega"))
    wrench = (C * force).col_join(C * moment + cross_product(O, C * force))
    twist = (C.T * (v + cross_product(omega, O))).col_join(C.T * omega)
    assert remainders(L(O, C) * force.col_join(moment) - wrench) == []
    assert remainders(L(O, C).T * v.col_join(omega) - twist) == []


def test_Phi_is_the_rate_of_a_momentum_fixed_in_E1() -> None:
    """Phi(V) (p, h) = (omega x p, v x p + omega x h)."""
    v, omega, p, h = (vector(n) for n in ("v", "omega", "p", "h"))
    wanted = cross_product(omega, p).col_join(cross_product(v, p) + cross_product(omega, h))
    assert remainders(Phi(v.col_join(omega)) * p.col_join(h) - wanted) == []


def test_rate_of_L_along_a_turning_flywheel() -> None:
    """Ls* = Ls [<e>] phi', and f is the unit spin about the first axis: L^T f' = (O..., R e1)."""
    O, R, phi = vector("O"), matrix("R"), sp.Symbol("phi")
    Ls = L(O, R * elementary(1, phi))
    assert remainders(trigonometric(Ls.diff(phi) - Ls * e_bracket(), phi)) == []
    assert f == sp.Matrix([0, 0, 0, 1, 0, 0])
    assert bracket(R) * f == sp.zeros(3, 1).col_join(R[:, 0])


def test_weight_acts_at_the_mass_centre_of_all_bodies() -> None:
    """(m g, mu x g); buoyancy takes away the displaced mass at its centre."""
    g, mu, displaced = vector("g"), vector("mu"), vector("displaced_moment")
    plain = derived.weight(False)
    assert remainders(plain - (sp.Symbol("m") * g).col_join(cross_product(mu, g))) == []
    wanted = (sp.Symbol("weight_mass") * g).col_join(cross_product(mu, g) - cross_product(displaced, g))
    assert remainders(derived.weight(True) - wanted) == []


def test_cross() -> None:
    """<a> b = a x b."""
    a, b = vector("a"), vector("b")
    assert remainders(cross(a) * b - cross_product(a, b)) == []
