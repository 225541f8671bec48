"""The paper's factors, written out."""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.carrier import V
from mahovik.core.derive.document.parts import Formula, Section, Text
from mahovik.core.derive.flywheel import generic
from mahovik.core.derive.screw import Phi, T, Theta, cross, elementary, f
from mahovik.core.derive.symbols import vector


def factors() -> Section:
    """`<a>`, C1, C2, C3, T, [C], L, Theta, f, [<e>], Phi."""
    w = generic()
    psi, theta, phi = sp.symbols("psi theta phi")
    return Section(
        "Factors",
        "",
        (
            Text(
                "Six numbers are the linear part, then the angular part, about the origin of the frame they are "
                "written in. `E_1` is the carrier with origin `O_1`, `E_s` a flywheel with origin `O_s`; `E` is the "
                "unit matrix. Where nothing else is said, a matrix is in axes of `E_1` about `O_1`."
            ),
            Formula(("<a> =", cross(vector("a")), ', "   "<a> b = a × b')),
            Formula(
                (
                    "C_1(phi) =",
                    elementary(1, phi),
                    ', "   "C_2(theta) =',
                    elementary(2, theta),
                    ', "   "C_3(psi) =',
                    elementary(3, psi),
                )
            ),
            Text("`L = T [C]` carries wrenches and momenta from a frame to its parent, `L^T` carries twists back:"),
            Formula(("T(O) = {E, 0; <O>, E} = ", T(w.O))),
            Formula(('[C] = {C, 0; 0, C}, "   "L = T [C] = {C, 0; <O> C, C}',)),
            Text(
                "Inertia of a body about its own origin: mass `m`, first moment `b = m r_c` and moments of inertia "
                "`J`, also about that origin. Every flywheel spins about its own first axis:"
            ),
            Formula(("Theta = {m E, -<b>; <b>, J} = ", Theta(w.m, w.b, w.J))),
            Formula(('f = {0; e_1}, "   "f^T =', f.T, ', "   "[<e>] = {<e_1>, 0; 0, <e_1>}')),
            Text("The twist of the carrier is `V = (v, omega)`:"),
            Formula(("Phi(V) = {<omega>, 0; <v>, <omega>} = ", Phi(V))),
        ),
    )
