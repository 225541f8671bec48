"""The row of one generic flywheel, made as `prepare` makes it: harmonics of Theta(phi), carried to E1 about O1."""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive import accumulate, flywheel
from mahovik.core.derive.screw import matrix, symmetric, vector

Binding = dict[sp.Symbol, sp.Expr]


def bind(name: str, values: sp.Matrix) -> Binding:
    """name[0], name[1], ... by values."""
    return {sp.Symbol(f"{name}[{i}]"): value for i, value in enumerate(values)}


def carried(w: flywheel.Generic, part: flywheel.Inertia) -> tuple[sp.Matrix, sp.Matrix, sp.Matrix]:
    """mu, six of J, and t of one harmonic, in E1 about O1."""
    b = w.R * part.b
    first, second = flywheel.rotated_tensor(symmetric("part"), matrix("R"))
    J = second.xreplace(bind("RJ", first)).xreplace(bind("part", part.J))
    moved_mu, moved_J = flywheel.shifted_inertia(sp.Symbol("part_mass"), vector("b_E1"), symmetric("J_E1"), w.O)
    known = bind("b_E1", b) | bind("J_E1", J) | {sp.Symbol("part_mass"): part.m}
    mu = moved_mu.xreplace(known)
    axis = bind("axis", w.R[:, 0])
    t = flywheel.spin_momentum(vector("b_E1"), symmetric("J_E1"), w.O).xreplace(known | axis)
    return mu, moved_J.xreplace(bind("mu", mu) | known), t


def row(w: flywheel.Generic) -> Binding:
    """Columns mu_0 .. t_s of one flywheel in its symbols."""
    binding: Binding = {}
    for harmonic, part in flywheel.spun_inertia(w).items():
        mu, J, t = carried(w, part)
        binding |= bind(f"mu_{harmonic}", mu) | bind(f"J_{harmonic}", J) | bind(f"t_{harmonic}", t)
    return binding


def weights() -> Binding:
    """c2 ... dds in c, s, phi_dot, phi_ddot."""
    binding: Binding = {}
    for name, value in accumulate.weights().items():
        binding[sp.Symbol(name)] = value.xreplace(binding)
    return binding


def sums(w: flywheel.Generic) -> accumulate.Sums:
    """Terms of one flywheel alone, with its constant harmonic, in its own symbols, c, s, phi_dot and phi_ddot."""
    columns, by_phase = row(w), weights()
    raw = accumulate.sums()

    def substituted(part: sp.Matrix) -> sp.Matrix:
        return part.xreplace(by_phase).xreplace(columns)

    return accumulate.Sums(
        mu=substituted(raw.mu + vector("mu_0")),
        mu_dot=substituted(raw.mu_dot),
        J=substituted(raw.J + vector("J_0", 6)),
        J_dot=substituted(raw.J_dot),
        h_rel=substituted(raw.h_rel),
        a_rel=substituted(raw.a_rel),
        g_rel=substituted(raw.g_rel),
    )


def columns(w: flywheel.Generic) -> accumulate.Columns:
    """I_s and dI_s/dphi of the table in the flywheel's own symbols, c and s."""
    raw, known = accumulate.columns(), row(w)
    return accumulate.Columns(raw.I.xreplace(known), raw.I_prime.xreplace(known))
