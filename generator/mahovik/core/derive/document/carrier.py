"""The carrier's equation (8): as printed, in the total-momentum form that is emitted, and its solution."""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive import carrier as derived
from mahovik.core.derive.document.parts import Block, Formula, Section, Text
from mahovik.core.derive.screw import Phi, blocks
from mahovik.core.derive.symbols import from_six, matrix

BLOCKS = ((0, 0), (0, 3), (3, 0), (3, 3))


def velocity_matrix(added_mass: bool) -> sp.Matrix:
    """M = Phi K + K* of (9), written out; with added mass in the symbols of B."""
    K = derived.mass_matrix(added_mass)
    if added_mass:
        B = matrix("B")
        K = blocks(K[:3, :3], B.T, B, K[3:, 3:])
    return (Phi(derived.V) * K + derived.mass_matrix_rate()).applyfunc(sp.expand)


def equation(added_mass: bool, weight: sp.Matrix | None, displaces: bool) -> Section:
    """(2), (4), (7)-(9) with the sums of all bodies; `weight`: that of all bodies, None without gravity."""
    rate = derived.mass_matrix_rate()
    M = velocity_matrix(added_mass)
    named = [f"M_{{{1 + i // 3}{1 + j // 3}}} =" for i, j in BLOCKS]
    content: list[Block] = [
        Text(
            "Over all bodies: `K` from carrier, instruments, flywheels and added mass, a column of `I` and `J` a "
            "flywheel."
        ),
        Formula(("K = Theta_1 + sum_p L_p Theta_p L_p^T + sum_s L_s Theta_s L_s^T + Lambda_1 + sum_p Lambda_p",), "2"),
        Formula(("Z = K V + sum_s I_s dot(phi)_s",), "2"),
        Formula(("Z* + Phi Z = F",), "4"),
        Formula(("F = P_1 + sum_p L_p P_p + sum_s L_s P_s",), "7"),
        Formula(("K V* + M V + sum_s (I_s ddot(phi)_s + J_s dot(phi)_s) = F",), "8"),
        Formula(("M = Phi K + K*",), "9"),
        Text(_sums(added_mass)),
        Formula(("K =", derived.mass_matrix(added_mass)), "2"),
        Formula(("K* =", rate), "6"),
        Text("The velocity matrix, `M = {M_{11}, M_{12}; M_{21}, M_{22}}`, block by block:"),
        *(Formula((name, M[i : i + 3, j : j + 3]), "9") for name, (i, j) in zip(named, BLOCKS, strict=True)),
    ]
    if weight is not None:
        content += [
            Text(
                "Weight of all bodies at once, in (7): the force `m g` acts at the mass centre, and `mu` moves with "
                "the "
                "flywheels"
                + (
                    "; `m^w` is the mass less that of the displaced fluid, `mu^d` its first moment."
                    if displaces
                    else "."
                )
            ),
            Formula(("F_g =", weight), "7"),
        ]
    content += [
        Text(
            "The emitted code never forms `M`, `I` and `J` to solve (8). It takes the momentum of the whole system, "
            "and the rates of its parts in `E_1`:"
        ),
        Formula(("Z = {p; h} =", derived.momentum(added_mass)), "2"),
        Text("Then `F - M V - sum_s (I_s ddot(phi)_s + J_s dot(phi)_s)`, which `K V*` has to equal, is"),
        Formula(("F - Phi Z - K* V - {a^{rel}; g^{rel}} =", derived.remainder()), "4, 5"),
    ]
    return Section("The carrier", "(2), (4)-(9)", tuple(content))


def _sums(added_mass: bool) -> str:
    """Names of the sums."""
    text = "With the sums over all bodies, mass `m`, first moment `mu` and moments of inertia `J` about `O_1`"
    if not added_mass:
        return f"{text}:"
    return (
        f"{text} (`J` with `Lambda_{{22}}`), and the blocks of the added mass in `A = m E + Lambda_{{11}}`, "
        "`G = Lambda_{21}`, `B = <mu> + G`:"
    )


def solution(added_mass: bool) -> Section:
    """K y = F with the constant translational block eliminated."""
    if added_mass:
        elimination: tuple[Block, ...] = (
            Text("`A` is constant: it is inverted once, when the stand is prepared."),
            Formula(('K = {A, B^T; B, J}, "   "U = A^{-1} B^T',)),
            Formula(("S = J - B U =", from_six(derived.reduced_inertia(True)))),
        )
        linear = "v* = A^{-1} r_1 - U omega*"
    else:
        elimination = (
            Text("The translational block is `m E`: no inverse is needed, and `U` is a cross-product matrix."),
            Formula(('K = {m E, -<mu>; <mu>, J}, "   "rho = mu / m, "   "U = -<rho>',)),
            Formula(("S = J - <mu> U =", from_six(derived.reduced_inertia(False)))),
        )
        linear = "v* = r_1 / m - U omega*"
    return Section(
        "Solution for the acceleration",
        "(8)",
        (
            *elimination,
            Text(
                "With `(r_1, r_2)` for the right-hand side, three unknowns are left; `S` is symmetric and positive "
                "definite:"
            ),
            Formula((f'S omega* = r_2 - U^T r_1, "   "{linear}',), "8"),
        ),
    )
