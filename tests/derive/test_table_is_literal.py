"""The proof on which the emitted C rests: a row of harmonics gives exactly the literal K, K*, I, J of one flywheel.

The flywheel is general: nine symbols of R (its mounting axes in E1), position, mass, first moment, six moments of
inertia, phase and speed. The equalities hold modulo c^2 + s^2 = 1 and R in SO(3).
"""

from __future__ import annotations

import pytest
import sympy as sp
from formulas import derive_all

from derive import table
from derive.exact import circle, remainders, rotation, trigonometric
from mahovik.core.derive import accumulate, carrier, carrying, flywheel
from mahovik.core.derive.screw import Phi, T, Theta, bracket, elementary, from_six, six_of, symmetric, vector
from mahovik.core.formula.derived import FILE

W = flywheel.generic()
CIRCLE = circle(sp.Symbol("c"), sp.Symbol("s"))
SO3 = (*CIRCLE, *rotation(W.R))


@pytest.fixture(scope="module")
def literal() -> flywheel.Literal:
    """The paper's terms, with c and s."""
    sums = flywheel.literal(W, carrier.V)
    return flywheel.Literal(*(trigonometric(x, W.phi) for x in (sums.K, sums.K_dot, sums.I, sums.J)))


@pytest.fixture(scope="module")
def sums() -> accumulate.Sums:
    """The table's sums of the same flywheel."""
    return table.sums(W)


@pytest.fixture(scope="module")
def columns() -> accumulate.Columns:
    """The table's column of I and its derivative by the phase."""
    return table.columns(W)


def of_sums(matrix: sp.Matrix, sums: accumulate.Sums) -> sp.Matrix:
    """An expression of the carrier in the sums of one flywheel."""
    known = {sp.Symbol("m"): W.m}
    for name in ("mu", "mu_dot", "J", "J_dot", "h_rel", "a_rel", "g_rel"):
        known |= table.bind(name, getattr(sums, name))
    return matrix.xreplace(known)


def test_K(literal: flywheel.Literal, sums: accumulate.Sums) -> None:
    """K of (2): Ls Theta_s Ls^T."""
    assert remainders(literal.K - of_sums(carrier.mass_matrix(False), sums), SO3) == []


def test_K_dot(literal: flywheel.Literal, sums: accumulate.Sums) -> None:
    """K* of (6): Ls ([<e>] Theta_s - Theta_s [<e>]) Ls^T phi'."""
    assert remainders(literal.K_dot - of_sums(carrier.mass_matrix_rate(), sums), SO3) == []


def test_I(literal: flywheel.Literal, columns: accumulate.Columns) -> None:
    """I_s of (9): Ls Theta_s f."""
    assert remainders(literal.I - columns.I, SO3) == []


def test_J(literal: flywheel.Literal, columns: accumulate.Columns) -> None:
    """J_s of (9): (Phi Ls + Ls [<e>] phi') Theta_s f."""
    table_form = Phi(carrier.V) * columns.I + columns.I_prime * W.phi_dot
    assert remainders(literal.J - table_form, SO3) == []


@pytest.mark.slow
def test_literal_K_dot_is_the_derivative_of_K() -> None:
    """(6) is d/dt of (2) at the phase's rate, for the factors as they are printed: R needs no property at all."""
    sums = flywheel.literal(W, carrier.V)
    rate = sums.K.diff(W.phi) * W.phi_dot
    assert remainders(trigonometric(rate - sums.K_dot, W.phi), CIRCLE) == []


def test_spun_inertia_sums_to_the_turned_inertia() -> None:
    """The harmonics put together again are [C1] Theta [C1]^T, entry by entry."""
    parts = flywheel.spun_inertia(W)
    phases = {"0": 1, "c": sp.cos(W.phi), "s": sp.sin(W.phi), "2c": sp.cos(2 * W.phi), "2s": sp.sin(2 * W.phi)}
    total = sp.zeros(6)
    for harmonic, part in parts.items():
        total += phases[harmonic] * Theta(part.m, part.b, from_six(part.J))
    C1 = bracket(elementary(1, W.phi))
    difference = (total - C1 * Theta(W.m, W.b, W.J) * C1.T).applyfunc(sp.expand_trig)
    assert remainders(trigonometric(difference, W.phi), CIRCLE) == []


def test_inertia_about_the_origin_from_central() -> None:
    """J about the origin: Theta(m, 0, J) carried by T(rc), with b = m rc."""
    rc, J = vector("rc"), symmetric("J")
    moved = T(rc) * Theta(W.m, sp.zeros(3, 1), J) * T(rc).T
    named = carrying.central_to_origin().xreplace(dict(zip(vector("b"), W.m * rc, strict=True)))
    assert remainders(six_of(moved[3:, 3:]) - named) == []
    assert remainders(moved - Theta(W.m, W.m * rc, from_six(named))) == []


def test_the_proofs_can_fail(literal: flywheel.Literal, sums: accumulate.Sums) -> None:
    """A relation not given is not used, a wrong sign leaves a remainder, and sin c is no polynomial."""
    c, s = sp.symbols("c s")
    assert remainders([c**2 + s**2 - 1]) == [c**2 + s**2 - 1]
    assert remainders([c + s - 1], CIRCLE) != []
    assert remainders(literal.K_dot + of_sums(carrier.mass_matrix_rate(), sums), SO3) != []
    with pytest.raises(TypeError, match="no polynomial"):
        remainders([sp.sin(c)])


def test_the_file_of_formulas_is_what_the_derivation_gives() -> None:
    """`generate` reads the file, without SymPy."""
    assert derive_all() == FILE.read_text(encoding="ascii"), "run tools/formulas.py"
