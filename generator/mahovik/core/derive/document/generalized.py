"""The generalized-coordinate form (10), (11) for an attitude sequence."""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.attitude import ANGLES, attitude, kinematics
from mahovik.core.derive.document.parts import Formula, Section, Text
from mahovik.core.derive.order import SEQUENCES


def generalized(sequence: str) -> Section:
    """C, B, A, D of the sequence; I0, J0."""
    found = attitude(sequence)
    _, D = kinematics(sequence)
    turns = " ".join(f"C_{axis}({angle})" for axis, angle in zip(SEQUENCES[sequence], ANGLES, strict=True))
    inverse = found.B_inverse.xreplace({sp.Symbol("singular_inv"): 1 / found.singular})
    where = "cos theta = 0" if str(found.singular).startswith("c") else "sin theta = 0"
    return Section(
        "Generalized coordinates",
        "(10), (11)",
        (
            Text(
                f"Attitude sequence {sequence}: `q` is the position of `O_1` in `E_0`, then `psi`, `theta`, `phi`; "
                "`c_psi = cos psi`, `s_psi = sin psi` and so on; `x_0 = C x_1`."
            ),
            Formula((f"C = {turns} =", found.C)),
            Formula(('omega = B {dot(psi); dot(theta); dot(phi)}, "   "B =', found.B)),
            Formula(('V = A dot(q), "   "V* = A ddot(q) + D dot(q)',), "10"),
            Formula(('A = {C^T, 0; 0, B}, "   "D = dot(A) = {-<omega> C^T, 0; 0, dot(B)}',), "10"),
            Formula(("-<omega> C^T =", D[:3, :3])),
            Formula(("dot(B) =", found.B_dot)),
            Text(f"`A` has no inverse where `{where}`; elsewhere `dot(q) = A^{{-1}} V` with"),
            Formula(("B^{-1} =", inverse)),
            Formula(("I_0 ddot(q) + J_0 dot(q) + I ddot(phi) + J dot(phi) = F",), "11"),
            Formula(
                ('I_0 = K A, "   "J_0 = K D + M A, "   "I = {I_2, "..." , I_m}, "   "J = {J_2, "..." , J_m}',), "11"
            ),
            Text("Since `K` cancels, the emitted code takes `ddot(q) = A^{-1} (V* - D dot(q))` with `V*` of (8)."),
        ),
    )
