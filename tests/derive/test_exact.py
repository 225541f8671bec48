"""The proofs can fail: a wrong term leaves a remainder, a relation is used only where it is given."""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sympy as sp

from derive import table
from derive.exact import circle, remainders, rotation, trigonometric
from mahovik.core.derive import carrier, flywheel
from mahovik.core.derive.screw import L, Theta, e_bracket, elementary
from toolchain.quick import quick

W = flywheel.generic()
c, s = sp.symbols("c s")
SO3 = (*circle(c, s), *rotation(W.R))
Ls = L(W.O, W.R * elementary(1, W.phi))
OWN = Theta(W.m, W.b, W.J)
e = e_bracket()


def test_relations_are_used_and_needed() -> None:
    """c^2 + s^2 - 1 is 0 modulo the circle and nothing else."""
    assert remainders([c**2 + s**2 - 1], circle(c, s)) == []
    assert remainders([c**2 + s**2 - 1]) == [c**2 + s**2 - 1]
    assert remainders([c + s - 1], circle(c, s)) != []


def test_only_polynomials() -> None:
    """What cannot be proved here is an error, not a pass."""
    with pytest.raises(TypeError, match="no polynomial"):
        remainders([sp.sin(c)])
    with pytest.raises(TypeError, match="no polynomial"):
        remainders([sp.Float(0.5) * c])


WRONG_K_DOT: dict[str, Callable[[], sp.Matrix]] = {
    "order of the commutator": lambda: Ls * (OWN * e - e * OWN) * Ls.T * W.phi_dot,
    "one half of the commutator": lambda: Ls * (e * OWN) * Ls.T * W.phi_dot,
    "speed left out": lambda: Ls * (e * OWN - OWN * e) * Ls.T,
    "phase of the wrong sign": lambda: (Ls * (e * OWN - OWN * e) * Ls.T * W.phi_dot).subs(W.phi, -W.phi),
    "asymmetry dropped": lambda: (Ls * (e * OWN - OWN * e) * Ls.T * W.phi_dot).subs(W.J[2, 2], W.J[1, 1]),
    "product of inertia dropped": lambda: (Ls * (e * OWN - OWN * e) * Ls.T * W.phi_dot).subs(W.J[1, 2], 0),
}


@pytest.mark.parametrize("fault", quick(3, WRONG_K_DOT))
def test_a_wrong_K_dot_leaves_a_remainder(fault: str) -> None:
    """Each fault of (6) is seen by the proof."""
    raw = table.sums(W)
    found = carrier.mass_matrix_rate().xreplace(table.bind("mu_dot", raw.mu_dot) | table.bind("J_dot", raw.J_dot))
    assert remainders(trigonometric(WRONG_K_DOT[fault](), W.phi) - found, SO3) != []
