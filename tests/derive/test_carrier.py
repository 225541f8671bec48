"""The carrier's equations in sums: total-momentum form against (8) as printed, and the reduced solve, exactly."""

from __future__ import annotations

import pytest
import sympy as sp

from derive import table
from derive.exact import circle, remainders, rotation, trigonometric
from mahovik.core.derive import SYMMETRIC, accumulate, carrier, flywheel
from mahovik.core.derive.document import in_mounting_axes, velocity_matrix
from mahovik.core.derive.screw import Phi, Theta, blocks, cross, from_six, matrix, symmetric, vector

W = flywheel.generic()
PHI_DDOT = sp.Symbol("phi_ddot")
SO3 = (*circle(sp.Symbol("c"), sp.Symbol("s")), *rotation(W.R))
V = carrier.V
c, s = sp.symbols("c s")
DOUBLE_PHASE = {sp.Symbol("c2"): c * c - s * s, sp.Symbol("s2"): 2 * s * c}


def rigid() -> tuple[sp.Matrix, sp.Matrix]:
    """Spatial inertia of a general carrier and a general symmetric added mass, 6x6."""
    body = Theta(sp.Symbol("m1"), vector("b1"), symmetric("J1"))
    entries = {}
    for i in range(6):
        for j in range(i, 6):
            entries[i, j] = entries[j, i] = sp.Symbol(f"Lambda[{6 * i + j}]")
    return body, sp.Matrix(6, 6, lambda i, j: entries[i, j])


def sums_of_all(added_mass: bool) -> tuple[dict[sp.Symbol, sp.Expr], sp.Matrix]:
    """Carrier, one flywheel and added mass: the sums' values, and the constant part of K that is not a flywheel's."""
    body, Lambda = rigid()
    if not added_mass:
        Lambda = sp.zeros(6)
    one = table.sums(W)
    mass = body[0, 0] + W.m
    inertia = sp.Matrix([(body + Lambda)[3 + i, 3 + j] for i, j in SYMMETRIC])
    known = {sp.Symbol("m"): mass}
    known |= table.bind("A", sp.Matrix([(mass * sp.eye(3) + Lambda[:3, :3])[pair] for pair in SYMMETRIC]))
    known |= table.bind("G", sp.Matrix(list(Lambda[3:, :3])))
    known |= table.bind("mu", vector("b1") + one.mu) | table.bind("J", inertia + one.J)
    for name in ("mu_dot", "J_dot", "h_rel", "a_rel", "g_rel"):
        known |= table.bind(name, getattr(one, name))
    return known, body + Lambda


def literal() -> flywheel.Literal:
    """The flywheel's terms as printed, with c and s."""
    sums = flywheel.literal(W, V)
    return flywheel.Literal(*(trigonometric(x, W.phi) for x in (sums.K, sums.K_dot, sums.I, sums.J)))


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
    sums, paper = table.sums(W), literal()
    squared = (trigonometric(flywheel.literal(W, sp.zeros(6, 1)).J, W.phi)) * W.phi_dot
    assert remainders(sums.a_rel.col_join(sums.g_rel) - paper.I * PHI_DDOT - squared, SO3) == []


def test_reduced_inertia_is_the_schur_complement() -> None:
    """S = J - B A^-1 B^T: with rho = mu / m, and with U = A^-1 B^T in the symbols of U and B."""
    m, B = sp.Symbol("m"), cross(carrier.mu)
    S = from_six(carrier.reduced_inertia(False)).xreplace(table.bind("rho", carrier.mu / m))
    assert remainders((m * (S - symmetric("J")) + B * B.T).applyfunc(sp.expand)) == []
    S = from_six(carrier.reduced_inertia(True))
    upper = sp.Matrix(3, 3, lambda i, j: (S - symmetric("J") + matrix("B") * matrix("U"))[min(i, j), max(i, j)])
    assert [upper[pair] for pair in SYMMETRIC if sp.expand(upper[pair]) != 0] == []


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
    weights = table.weights()
    assert set(wanted) == {s.name for s in weights} == set(accumulate.weights())
    for name, value in wanted.items():
        named = sp.expand_trig(value).subs(names)
        assert remainders([weights[sp.Symbol(name)] - named], SO3[:1]) == [], name


def test_terms_in_mounting_axes_are_the_literal_ones() -> None:
    """K, K*, I, J for O = 0, R = E; K* without its factor phi', in the double phase."""
    w = flywheel.generic()
    along_axis = flywheel.Generic(w.m, w.b, w.J, sp.zeros(3, 1), sp.eye(3), w.phi, w.phi_dot)
    literal, shown = flywheel.literal(along_axis, carrier.V), in_mounting_axes()
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
