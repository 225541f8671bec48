"""The carrier's equations in sums: total-momentum form against (8) as printed, and the reduced solve, exactly."""

from __future__ import annotations

import pytest
import sympy as sp

from derive import table
from derive.exact import circle, remainders, rotation, trigonometric
from mahovik.core.derive import accumulate, carrier, flywheel
from mahovik.core.derive.document import in_mounting_axes, velocity_matrix
from mahovik.core.derive.order import SYMMETRIC
from mahovik.core.derive.screw import L, Phi, Theta, blocks, cross, elementary, f
from mahovik.core.derive.symbols import from_six, matrix, symmetric, vector

W = flywheel.generic()
PHI_DDOT = sp.Symbol("phi_ddot")
SO3 = (*circle(sp.Symbol("c"), sp.Symbol("s")), *rotation(W.R))
V = carrier.V
c, s = sp.symbols("c s")
DOUBLE_PHASE = {sp.Symbol("c2"): c * c - s * s, sp.Symbol("s2"): 2 * s * c}


def rigid() -> tuple[sp.Matrix, sp.Matrix]:
    """Spatial inertia of a general carrier and a general symmetric added mass, 6x6."""
    own = Theta(sp.Symbol("m1"), vector("b1"), symmetric("J1"))
    entries = {}
    for i in range(6):
        for j in range(i, 6):
            entries[i, j] = entries[j, i] = sp.Symbol(f"Lambda[{6 * i + j}]")
    return own, sp.Matrix(6, 6, lambda i, j: entries[i, j])


def sums_of_all(added_mass: bool) -> tuple[dict[sp.Symbol, sp.Expr], sp.Matrix]:
    """Carrier, one flywheel and added mass: the sums' values, and the constant part of K that is not a flywheel's."""
    own, Lambda = rigid()
    if not added_mass:
        Lambda = sp.zeros(6)
    one = table.sums(W)
    mass = own[0, 0] + W.m
    inertia = sp.Matrix([(own + Lambda)[3 + i, 3 + j] for i, j in SYMMETRIC])
    known = {sp.Symbol("m"): mass}
    known |= table.bind("A", sp.Matrix([(mass * sp.eye(3) + Lambda[:3, :3])[pair] for pair in SYMMETRIC]))
    known |= table.bind("G", sp.Matrix(list(Lambda[3:, :3])))
    known |= table.bind("mu", vector("b1") + one.mu) | table.bind("J", inertia + one.J)
    for name in ("mu_dot", "J_dot", "h_rel", "a_rel", "g_rel"):
        known |= table.bind(name, getattr(one, name))
    return known, own + Lambda


def literal() -> flywheel.Literal:
    """The flywheel's terms as printed, with c and s."""
    found = flywheel.literal(W, V)
    return flywheel.Literal(*(trigonometric(x, W.phi) for x in (found.K, found.K_dot, found.I, found.J)))


@pytest.mark.slow
@pytest.mark.parametrize("added_mass", [False, True])
def test_total_momentum_form_is_8(added_mass: bool) -> None:
    """F - Phi Z - K* V - (a_rel, g_rel) = F - M V - J phi' - I phi'' with M = Phi K + K*: a carrier and a flywheel."""
    known, rest = sums_of_all(added_mass)
    paper = literal()
    Z = carrier.momentum(added_mass)
    emitted = carrier.remainder().xreplace(table.bind("p", Z[:3, :]) | table.bind("h", Z[3:, :])).xreplace(known)
    M = Phi(V) * (rest + paper.K) + paper.K_dot
    printed = vector("F", 6) - M * V - paper.J * W.phi_dot - paper.I * PHI_DDOT
    assert remainders(emitted - printed, SO3) == []


@pytest.mark.slow
@pytest.mark.parametrize("added_mass", [False, True])
def test_momentum_is_2(added_mass: bool) -> None:
    """Z = K V + I_s phi', and the mass matrix of the sums is the sum of the bodies' matrices."""
    known, rest = sums_of_all(added_mass)
    paper = literal()
    K = rest + paper.K
    assert remainders(carrier.mass_matrix(added_mass).xreplace(known) - K, SO3) == []
    assert remainders(carrier.momentum(added_mass).xreplace(known) - K * V - paper.I * W.phi_dot, SO3) == []


def test_relative_rates_are_the_last_sums_of_5() -> None:
    """(a_rel, g_rel) = Ls Theta_s f phi'' + Ls [<e>] Theta_s f phi'^2: the speed is squared."""
    found, paper = table.sums(W), literal()
    squared = (trigonometric(flywheel.literal(W, sp.zeros(6, 1)).J, W.phi)) * W.phi_dot
    assert remainders(found.a_rel.col_join(found.g_rel) - paper.I * PHI_DDOT - squared, SO3) == []


@pytest.mark.slow
def test_kinetic_energy_is_that_of_the_bodies() -> None:
    """T = V_s . Theta_s V_s / 2 with V_s = Ls^T V + f phi', of one flywheel."""
    Ls = L(W.O, W.R * elementary(1, W.phi))
    own_twist = trigonometric(Ls.T * V + f * W.phi_dot, W.phi)
    energy = (own_twist.T * Theta(W.m, W.b, W.J) * own_twist)[0] / 2
    known = table.bind("mu", table.sums(W).mu) | table.bind("J", table.sums(W).J) | {sp.Symbol("m"): W.m}
    for name in ("mu_dot", "h_rel"):
        known |= table.bind(name, getattr(table.sums(W), name))
    Z = carrier.momentum(False).xreplace(known)
    spin = W.phi_dot * (table.columns(W).I.dot(V) + W.J[0, 0] * W.phi_dot)
    found = carrier.kinetic_energy().xreplace(table.bind("p", Z[:3, :]) | table.bind("h", Z[3:, :]))
    assert remainders([found.xreplace({sp.Symbol("spin"): spin}) - energy], SO3) == []


class Reduced:
    """The 3x3 solve with its constants bound: with added mass A^-1 = adj A / det A, without it A = m E."""

    def __init__(self, added_mass: bool) -> None:
        self.added_mass = added_mass
        if added_mass:
            adjugate, determinant = carrier.inverse_of_symmetric()
            reciprocal = sp.Symbol("reciprocal")
            det = determinant.xreplace(table.bind("cofactor", adjugate))
            self.relations: tuple[sp.Expr, ...] = (reciprocal * det - 1,)
            constants = table.bind("A_inv", reciprocal * adjugate)
            B = carrier.coupling_block(True)
            U = carrier.schur_coupling(True).xreplace(constants | table.bind("B", sp.Matrix(list(B))))
            self.known = constants | table.bind("U", sp.Matrix(list(U))) | table.bind("B", sp.Matrix(list(B)))
        else:
            self.relations = (sp.Symbol("m_inverse") * sp.Symbol("m") - 1,)
            self.known = table.bind("rho", carrier.centre_offset())

    def __call__(self, expression: sp.Matrix) -> sp.Matrix:
        return expression.xreplace(self.known)

    def coupling(self) -> sp.Matrix:
        """U as the solve uses it."""
        return self(matrix("U") if self.added_mass else cross(vector("rho")).T)


@pytest.mark.parametrize("added_mass", [False, True])
def test_reduced_solve_is_K_y_equal_F(added_mass: bool) -> None:
    """For any omega* and v* = A^-1 f - U omega*: K y - F = (0, S omega* - (n - U^T f)). So S omega* = n - U^T f is all
    that is left of K y = F, and nothing is lost: the identity holds in both directions."""
    reduced = Reduced(added_mass)
    angular = vector("omega_dot")
    y = reduced(carrier.linear_part(added_mass)).col_join(angular)
    F = vector("f").col_join(vector("n"))
    S = from_six(reduced(carrier.reduced_inertia(added_mass)))
    left = S * angular - reduced(carrier.reduced_moment(added_mass))
    residual = carrier.mass_matrix(added_mass) * y - F
    assert remainders(residual - sp.zeros(3, 1).col_join(left), reduced.relations) == []


@pytest.mark.parametrize("added_mass", [False, True])
def test_schur_coupling_is_the_one_the_solve_uses(added_mass: bool) -> None:
    """U = A^-1 B^T, i.e. A U = B^T; S = J - B U is symmetric, so that six numbers hold it."""
    reduced = Reduced(added_mass)
    A, B = carrier.translation_block(added_mass), carrier.coupling_block(added_mass)
    U = reduced.coupling()
    assert remainders(A * U - B.T, reduced.relations) == []
    assert remainders(U - reduced(carrier.schur_coupling(added_mass)), reduced.relations) == []
    full = symmetric("J") - B * U
    assert remainders(full - full.T, reduced.relations) == []
    assert remainders(full - from_six(reduced(carrier.reduced_inertia(added_mass))), reduced.relations) == []


def test_weights_are_derivatives_along_the_motion() -> None:
    """c2, s2 are those of the double phase, and twice those; dc ... dds the first and second rates, for any phi(t)."""
    time = sp.Symbol("t")
    phi = sp.Function("phi")(time)
    of = {"c": sp.cos(phi), "s": sp.sin(phi), "c2": sp.cos(2 * phi), "s2": sp.sin(2 * phi)}
    wanted = {k: of[k] for k in ("c2", "s2")} | {f"d{k}": of[k].diff(time) for k in of}
    wanted |= {f"two_{k}": 2 * of[k] for k in ("c2", "s2")}
    wanted |= {"ddc": of["c"].diff(time, 2), "dds": of["s"].diff(time, 2)}
    names = {
        phi.diff(time, 2): PHI_DDOT,
        phi.diff(time): W.phi_dot,
        sp.cos(phi): sp.Symbol("c"),
        sp.sin(phi): sp.Symbol("s"),
    }
    found = table.weights()
    assert set(wanted) == {s.name for s in found} == set(accumulate.weights())
    for name, value in wanted.items():
        named = sp.expand_trig(value).subs(names)
        assert remainders([found[sp.Symbol(name)] - named], SO3[:1]) == [], name


def test_momentum_in_E0_is_1() -> None:
    """Z0 = L1 Z, with the force part written once."""
    C, Z = matrix("C"), vector("p").col_join(vector("h"))
    found = carrier.momentum_in_E0()
    named = found.xreplace(table.bind("p0", found[:3, :]))
    assert remainders(named - L(vector("r"), C) * Z) == []


def test_inverse_of_symmetric() -> None:
    """A adj(A) = det(A) E, with the determinant by its first row."""
    adjugate, determinant = carrier.inverse_of_symmetric()
    A = symmetric("A")
    det = determinant.xreplace(table.bind("cofactor", adjugate))
    assert remainders(A * from_six(adjugate) - det * sp.eye(3)) == []
    assert remainders([det - A.det()]) == []


def test_velocity_column_is_a_column_of_9() -> None:
    """Column by column, Phi(V) times a matrix is Phi K of (9)."""
    K = carrier.mass_matrix(True)
    columns = [carrier.velocity_column().xreplace(table.bind("column", K[:, j])) for j in range(6)]
    assert remainders(sp.Matrix.hstack(*columns) - Phi(V) * K) == []


def test_terms_in_mounting_axes_are_the_literal_ones() -> None:
    """K, K*, I, J for O = 0, R = E; K* without its factor phi', in the double phase."""
    w = flywheel.generic()
    own = flywheel.Generic(w.m, w.b, w.J, sp.zeros(3, 1), sp.eye(3), w.phi, w.phi_dot)
    literal, shown = flywheel.literal(own, carrier.V), in_mounting_axes()
    K_dot = shown.K_dot.xreplace(DOUBLE_PHASE) * w.phi_dot
    for printed, form in ((literal.K, shown.K), (literal.K_dot, K_dot), (literal.I, shown.I), (literal.J, shown.J)):
        assert remainders(trigonometric(printed, w.phi) - form, circle(c, s)) == []


@pytest.mark.parametrize("added_mass", [False, True])
def test_velocity_matrix_is_9(added_mass: bool) -> None:
    """M = Phi K + K*, with B for the lower left block of K."""
    K = carrier.mass_matrix(added_mass)
    M = velocity_matrix(added_mass)
    if added_mass:
        B = matrix("B")
        K = blocks(K[:3, :3], B.T, B, K[3:, 3:])
    assert remainders(M - Phi(carrier.V) * K - carrier.mass_matrix_rate()) == []
