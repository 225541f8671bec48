"""One generic flywheel: terms as printed, their harmonics, and what a row gives at its phase."""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive import accumulate
from mahovik.core.derive import flywheel as derived
from mahovik.core.derive.carrier import V, omega, v
from mahovik.core.derive.document.parts import Formula, Section, Table, Text
from mahovik.core.derive.order import SYMMETRIC
from mahovik.core.derive.symbols import from_six, symmetric, vector

c, s, c2, s2 = sp.symbols("c s c2 s2")
PHASES = {"0": sp.S.One, "c": c, "s": s, "2c": c2, "2s": s2}
"""Factor of each harmonic."""

HEAD = ("1", "cos phi", "sin phi", "cos 2 phi", "sin 2 phi")


def in_mounting_axes() -> derived.Literal:
    """The literal terms where `E_1` stands in the flywheel's mounting axes: O = 0, R = E. In c, s (K* also in c2, s2).

    K_dot is divided by phi_dot.
    """
    w = derived.generic()
    own = derived.Generic(w.m, w.b, w.J, sp.zeros(3, 1), sp.eye(3), w.phi, w.phi_dot)
    found = derived.literal(own, V)

    def shown(x: sp.Expr) -> sp.Expr:
        expanded = sp.expand(x.subs({sp.cos(w.phi): c, sp.sin(w.phi): s}))
        if not expanded.has(c**2) or not expanded.has(s**2):
            return expanded
        reduced = sp.expand(sp.rem(expanded, s**2 + c**2 - 1, s))
        return reduced if len(sp.Add.make_args(reduced)) < len(sp.Add.make_args(expanded)) else expanded

    def by_harmonics(x: sp.Expr) -> sp.Expr:
        parts = derived.harmonics(x, w.phi)
        return sum((sp.factor_terms(parts[k]) * PHASES[k] for k in derived.HARMONICS), sp.S.Zero)

    velocities = [*v, *omega, w.phi_dot]
    return derived.Literal(
        K=found.K.applyfunc(shown),
        K_dot=(found.K_dot / w.phi_dot).applyfunc(by_harmonics),
        I=found.I.applyfunc(shown),
        J=found.J.applyfunc(lambda x: sp.collect(shown(x), velocities)),
    )


def literal_terms() -> Section:
    """Terms of one flywheel in (8), as printed."""
    own = in_mounting_axes()
    return Section(
        "One flywheel, as printed",
        "(2), (6), (9)",
        (
            Text(
                "A flywheel has its origin at `O_s` and its axes along `C_s = R C_1(phi_s)`, where `R` holds the "
                "mounting axes (those at `phi_s = 0`): `R = C_3(psi_s) C_2(theta_s) C_1(phi_0)`, turned by `C_p` "
                "where an instrument bears the flywheel. Since `dot(L)_s = L_s [<e>] dot(phi)_s`:"
            ),
            Formula(("K_s = L_s Theta_s L_s^T",), "2"),
            Formula(("K*_s = L_s ([<e>] Theta_s - Theta_s [<e>]) L_s^T dot(phi)_s",), "6"),
            Formula(('I_s = L_s Theta_s f, "   "J_s = (Phi L_s + L_s [<e>] dot(phi)_s) Theta_s f',), "9"),
            Text(
                "Written out for mounting axes that are those of the carrier (`O_s = 0`, `R = E`), with `c = cos phi`, "
                "`s = sin phi`, `c_2 = cos 2 phi`, `s_2 = sin 2 phi`; the index of the flywheel is left out:"
            ),
            Formula(("K_s =", own.K), "2"),
            Formula(("K*_s = dot(phi)", own.K_dot), "6"),
            Formula(("I_s =", own.I), "9"),
            Formula(("J_s =", own.J), "9"),
        ),
    )


def harmonics() -> Section:
    """The table of harmonics of Theta(phi), and how it is carried to E1."""
    w = derived.generic()
    parts = derived.spun_inertia(w)
    labels = [f"b_{i + 1}(phi)" for i in range(3)] + [f"J_{{{i + 1}{j + 1}}}(phi)" for i, j in SYMMETRIC]
    columns = {k: [*parts[k].b, *parts[k].J] for k in derived.HARMONICS}
    rows = [("m", *(parts[k].m for k in derived.HARMONICS))]
    rows += [(label, *(columns[k][i] for k in derived.HARMONICS)) for i, label in enumerate(labels)]
    moved_mu, moved_J = derived.shifted_inertia(w.m, w.b, symmetric("J"), w.O)
    moment = derived.spin_momentum(w.b, symmetric("J"), w.O)
    return Section(
        "Its harmonics",
        "(2), (9)",
        (
            Text(
                "The flywheel turns about one fixed axis, so its inertia in mounting axes, `Theta(phi) = [C_1] "
                "Theta [C_1]^T`, is a Fourier polynomial of second order. Each row is the sum of its cells times "
                "the heads of the columns:"
            ),
            Table("Inertia of a flywheel in its mounting axes about its own origin", ("", *HEAD), tuple(rows)),
            Text(
                "The constant `L_0 = T(O_s) [R]` carries every column `k` to the carrier by itself, "
                "`K_s = L_0 Theta(phi) L_0^T`. First it is turned, `b^k = R b_s^k` and `J^k = R J_s^k R^T`, then it is "
                "shifted by `T(O)` (the mass is in the column of 1 only):"
            ),
            Formula(("mu^k =", moved_mu)),
            Formula(("J_1^k = J^k - <O> <b^k> - <mu^k> <O>",)),
            Formula(("J_1^k =", from_six(moved_J))),
            Text("The moment part of `I_s`, for the spin axis `a = R e_1`:"),
            Formula(
                ("t^k = (J^k - <O> <b^k>) a =", moment.xreplace(dict(zip(vector("axis"), vector("a"), strict=True))))
            ),
        ),
    )


def row_at_a_phase() -> Section:
    """The polynomials of a row, their rates, and the terms of (8) in them."""
    sums, columns, weights = accumulate.sums(), accumulate.columns(), accumulate.weights()
    return Section(
        "A row at its phase",
        "(2), (5), (6), (9)",
        (
            Text(
                "So a flywheel is a row of constants in `E_1` about `O_1`; the column of 1 is summed over all bodies "
                "beforehand. At a phase the rest of the row adds to first moment and inertia, and to their rates:"
            ),
            Formula(("mu(phi) =", sums.mu)),
            Formula(("J(phi) =", from_six(sums.J))),
            Table(
                "Weights of the columns, with c and s given",
                ("weight", "value"),
                tuple((sp.Symbol(name), value) for name, value in weights.items()),
            ),
            Formula(('K_s = {m E, -<mu>; <mu>, J}, "   "K*_s = {0, -<dot(mu)>; <dot(mu)>, dot(J)}',), "2, 6"),
            Formula(("I_s =", columns.I, ', "   "I\'_s =', columns.I_prime), "9"),
            Text(
                "The force part of `I_s` is the derivative of the first moment by the phase, `mu'`. With its moment "
                "part `t`, (9) becomes:"
            ),
            Formula(("J_s = Phi I_s + dot(phi) I'_s = {omega × mu'; v × mu' + omega × t} + dot(phi) {mu''; t'}",), "9"),
            Text("Sums that the momentum form needs, `I_s dot(phi) = (dot(mu), h^{rel})` and its derivative:"),
            Formula(("h^{rel} =", sums.h_rel, ', "   "a^{rel} =', sums.a_rel, ', "   "g^{rel} =', sums.g_rel), "5"),
        ),
    )
