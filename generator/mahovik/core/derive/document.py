"""The derivation as a document: sections of paragraphs, equations and tables, in LaTeX with amsmath."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import sympy as sp

from mahovik.core.derive import SEQUENCES, SYMMETRIC, accumulate, carrier, flywheel
from mahovik.core.derive.attitude import ANGLES, attitude, kinematics
from mahovik.core.derive.carrier import V, omega, v
from mahovik.core.derive.screw import Phi, T, Theta, blocks, cross, elementary, f, from_six, matrix, symmetric, vector

HEAD = ("1", r"\cos\varphi", r"\sin\varphi", r"\cos 2\varphi", r"\sin 2\varphi")
"""Heads of the columns of a Fourier polynomial."""


@dataclass(frozen=True)
class Formula:
    """A displayed equation; `number` of the paper, without parentheses."""

    tex: str
    number: str = ""


@dataclass(frozen=True)
class Table:
    """Cells of mathematics under a head of mathematics; the first column names the row."""

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Section:
    """A title, the paper's equations it is about, and blocks: a text is a paragraph, with mathematics between $."""

    title: str
    equations: str
    blocks: tuple[str | Formula | Table, ...]


# -- expressions -------------------------------------------------------------------------------------------------------

_SIX = re.compile(r"J|A|S|A_inv|J_\w+")
_NINE = re.compile(r"R|C|G|U|B|RJ")
_GREEK = {"psi", "theta", "omega", "mu", "rho", "tau", "Phi", "Theta", "Lambda"}
_NAMES = {
    "c2": "c_2", "s2": "s_2", "omega_dot": r"\omega^*", "weight_mass": "m^w", "displaced_moment": r"\mu^d",
    "m_inverse": "m^{-1}", "A_inv": "(A^{-1})", "phi": r"\varphi",
}  # fmt: skip
"""Names that do not follow the rules of `symbol`."""


def tex(value: sp.Expr | sp.MatrixBase) -> str:
    """An expression or a matrix, by SymPy's own printer."""
    names = {free: symbol(free.name) for free in sp.sympify(value).free_symbols}
    text = str(sp.latex(value, symbol_names=names, mat_str="bmatrix", mat_delim="", fold_short_frac=True))
    return re.sub(r"\\(cos|sin)\{\\left\((\w+|\\\w+) \\right\)\}", r"\\\1 \2", text)


def symbol(name: str) -> str:
    """mu[0], J_2c[3], phi_dot, c_psi, dds as letters with indices, harmonics above, dots for rates."""
    base, index = (match[1], int(match[2])) if (match := re.fullmatch(r"(\w+)\[(\d+)\]", name)) else (name, -1)
    if index < 0:
        return _base(base)
    if _SIX.fullmatch(base):
        return f"{_base(base)}_{{{''.join(str(k + 1) for k in SYMMETRIC[index])}}}"
    if _NINE.fullmatch(base):
        return f"{_base(base)}_{{{index // 3 + 1}{index % 3 + 1}}}"
    return f"{_base(base)}_{{{index + (base != 'q')}}}"  # of a quaternion w is 0


def _base(name: str) -> str:
    if name in _NAMES:
        return _NAMES[name]
    if rate := re.fullmatch(r"(d+)([cs])(2?)", name):
        return rf"\{rate[1]}ot{{{rate[2]}}}" + (f"_{rate[3]}" if rate[3] else "")
    letter, _, tail = name.partition("_")
    letter = _NAMES.get(letter, rf"\{letter}" if letter in _GREEK else letter)
    if tail in ("dot", "ddot"):
        return rf"\{tail}{{{letter}}}"
    return letter + (f"_{_base(tail)}" if tail in ("psi", "theta", "phi") else f"^{{{tail}}}" if tail else "")


def _equal(name: str, *values: sp.Expr | sp.MatrixBase, number: str = "") -> Formula:
    """`name = value = value`."""
    return Formula(" = ".join([name, *map(tex, values)]), number)


# -- sections ----------------------------------------------------------------------------------------------------------


def sections(sequence: str, *, added_mass: bool, weight: sp.Matrix | None, displaces: bool) -> tuple[Section, ...]:
    """All sections as one reads them: of an attitude sequence, with added mass, weight and buoyancy or without.

    `weight`: that of all bodies, as the law derives it; None without gravity.
    """
    return (
        factors(), literal_terms(), harmonics(), row_at_a_phase(), equation(added_mass, weight, displaces),
        solution(added_mass), generalized(sequence),
    )  # fmt: skip


def factors() -> Section:
    """The paper's factors, written out."""
    w = flywheel.generic()
    psi, theta, phi = sp.symbols("psi theta phi")
    turns = ((1, phi, r"C_1(\varphi)"), (2, theta, r"C_2(\theta)"), (3, psi, r"C_3(\psi)"))
    return Section(
        "Factors",
        "",
        (
            "Six numbers are the linear part, then the angular part, about the origin of the frame they are written "
            "in. $E_1$ is the carrier with origin $O_1$, $E_s$ a flywheel with origin $O_s$; $E$ is the unit matrix. "
            "Where nothing else is said, a matrix is in axes of $E_1$ about $O_1$.",
            Formula(rf"\langle a\rangle = {tex(cross(vector('a')))},\quad \langle a\rangle b = a\times b"),
            Formula(r",\quad ".join(f"{name} = {tex(elementary(axis, angle))}" for axis, angle, name in turns)),
            "$L = T[C]$ carries wrenches and momenta from a frame to its parent, $L^T$ carries twists back:",
            _equal(r"T(O) = \begin{bmatrix}E & 0\\ \langle O\rangle & E\end{bmatrix}", T(w.O)),
            Formula(
                r"[C] = \begin{bmatrix}C & 0\\ 0 & C\end{bmatrix},\quad "
                r"L = T[C] = \begin{bmatrix}C & 0\\ \langle O\rangle C & C\end{bmatrix}"
            ),
            "Inertia of a body about its own origin: mass $m$, first moment $b = m r_c$ and moments of inertia $J$, "
            "also about that origin. Every flywheel spins about its own first axis:",
            _equal(
                r"\Theta = \begin{bmatrix}m E & -\langle b\rangle\\ \langle b\rangle & J\end{bmatrix}",
                Theta(w.m, w.b, w.J),
            ),
            Formula(
                rf"f^T = {tex(f.T)},\quad "
                r"[\langle e\rangle] = \begin{bmatrix}\langle e_1\rangle & 0\\ 0 & \langle e_1\rangle\end{bmatrix}"
            ),
            r"The twist of the carrier is $V = (v, \omega)$:",
            _equal(
                r"\Phi(V) = \begin{bmatrix}\langle\omega\rangle & 0\\ \langle v\rangle & "
                r"\langle\omega\rangle\end{bmatrix}",
                Phi(V),
            ),
        ),
    )


c, s, c2, s2 = sp.symbols("c s c2 s2")
PHASES = {"0": sp.S.One, "c": c, "s": s, "2c": c2, "2s": s2}
"""Factor of each harmonic."""


def in_mounting_axes() -> flywheel.Literal:
    """The literal terms where `E_1` stands in the flywheel's mounting axes: O = 0, R = E. In c, s (K* also in c2, s2).

    K_dot is divided by phi_dot.
    """
    w = flywheel.generic()
    generic = flywheel.Generic(w.m, w.b, w.J, sp.zeros(3, 1), sp.eye(3), w.phi, w.phi_dot)
    literal = flywheel.literal(generic, V)

    def shown(x: sp.Expr) -> sp.Expr:
        expanded = sp.expand(x.subs({sp.cos(w.phi): c, sp.sin(w.phi): s}))
        if not expanded.has(c**2) or not expanded.has(s**2):
            return expanded
        reduced = sp.expand(sp.rem(expanded, s**2 + c**2 - 1, s))
        return reduced if len(sp.Add.make_args(reduced)) < len(sp.Add.make_args(expanded)) else expanded

    def by_harmonics(x: sp.Expr) -> sp.Expr:
        parts = flywheel.harmonics(x, w.phi)
        return sum((sp.factor_terms(parts[k]) * PHASES[k] for k in flywheel.HARMONICS), sp.S.Zero)

    velocities = [*v, *omega, w.phi_dot]
    return flywheel.Literal(
        K=literal.K.applyfunc(shown),
        K_dot=(literal.K_dot / w.phi_dot).applyfunc(by_harmonics),
        I=literal.I.applyfunc(shown),
        J=literal.J.applyfunc(lambda x: sp.collect(shown(x), velocities)),
    )


def literal_terms() -> Section:
    """Terms of one flywheel in (8), as printed."""
    literal = in_mounting_axes()
    return Section(
        "One flywheel, as printed",
        "(2), (6), (9)",
        (
            r"A flywheel has its origin at $O_s$ and its axes along $C_s = R\,C_1(\varphi_s)$, where $R$ holds the "
            r"mounting axes (those at $\varphi_s = 0$): $R = C_3(\psi_s)\,C_2(\theta_s)\,C_1(\varphi_0)$, turned by "
            r"$C_p$ where an instrument bears the flywheel. Since $\dot{L}_s = L_s[\langle e\rangle]\dot{\varphi}_s$:",
            Formula(r"K_s = L_s\Theta_s L_s^T", "2"),
            Formula(
                r"K^*_s = L_s\left([\langle e\rangle]\Theta_s - \Theta_s[\langle e\rangle]\right)L_s^T\dot{\varphi}_s",
                "6",
            ),
            Formula(
                r"I_s = L_s\Theta_s f,\quad J_s = \left(\Phi L_s + L_s[\langle "
                r"e\rangle]\dot{\varphi}_s\right)\Theta_s f",
                "9",
            ),
            r"Written out for mounting axes that are those of the carrier ($O_s = 0$, $R = E$), with $c = "
            r"\cos\varphi$, "
            r"$s = \sin\varphi$, $c_2 = \cos 2\varphi$, $s_2 = \sin 2\varphi$; the index of the flywheel is left out:",
            _equal("K_s", literal.K, number="2"),
            Formula(rf"K^*_s = \dot{{\varphi}}{tex(literal.K_dot)}", "6"),
            _equal("I_s", literal.I, number="9"),
            _equal("J_s", literal.J, number="9"),
        ),
    )


def harmonics() -> Section:
    """The table of harmonics of Theta(phi), and how it is carried to E1."""
    w = flywheel.generic()
    parts = flywheel.spun_inertia(w)
    labels = [rf"b_{i + 1}(\varphi)" for i in range(3)]
    labels += [rf"J_{{{i + 1}{j + 1}}}(\varphi)" for i, j in SYMMETRIC]
    columns = [[*parts[k].b, *parts[k].J] for k in flywheel.HARMONICS]
    rows = [("m", *(tex(parts[k].m) for k in flywheel.HARMONICS))]
    rows += [(label, *(tex(column[i]) for column in columns)) for i, label in enumerate(labels)]
    moved_mu, moved_J = flywheel.shifted_inertia(w.m, w.b, symmetric("J"), w.O)
    moment = flywheel.spin_momentum(w.b, symmetric("J"), w.O)
    return Section(
        "Its harmonics",
        "(2), (9)",
        (
            r"The flywheel turns about one fixed axis, so its inertia in mounting axes, $\Theta(\varphi) = "
            r"[C_1]\Theta[C_1]^T$, is a Fourier polynomial of second order. Each row is the sum of its cells times "
            "the heads of the columns:",
            Table("Inertia of a flywheel in its mounting axes about its own origin", ("", *HEAD), tuple(rows)),
            "The constant $L_0 = T(O_s)[R]$ carries every column $k$ to the carrier by itself, $K_s = "
            r"L_0\Theta(\varphi) L_0^T$. First it is turned, $b^k = R b_s^k$ and $J^k = R J_s^k R^T$, then it is "
            "shifted by $T(O)$ (the mass is in the column of 1 only):",
            _equal(r"\mu^k", moved_mu),
            Formula(
                rf"J_1^k = J^k - \langle O\rangle\langle b^k\rangle - \langle\mu^k\rangle\langle O\rangle = "
                rf"{tex(from_six(moved_J))}"
            ),
            "The moment part of $I_s$, for the spin axis $a = R e_1$:",
            _equal(
                r"t^k = \left(J^k - \langle O\rangle\langle b^k\rangle\right)a",
                moment.xreplace(dict(zip(vector("axis"), vector("a"), strict=True))),
            ),
        ),
    )


def row_at_a_phase() -> Section:
    """The polynomials of a row, their rates, and the terms of (8) in them."""
    sums, columns = accumulate.sums(), accumulate.columns()
    weights = tuple((symbol(name), tex(value)) for name, value in accumulate.weights().items())
    return Section(
        "A row at its phase",
        "(2), (5), (6), (9)",
        (
            "So a flywheel is a row of constants in $E_1$ about $O_1$; the column of 1 is summed over all bodies "
            "beforehand. At a phase the rest of the row adds to first moment and inertia, and to their rates:",
            _equal(r"\mu(\varphi)", sums.mu),
            _equal(r"J(\varphi)", from_six(sums.J)),
            Table("Weights of the columns, with c and s given", ("weight", "value"), weights),
            Formula(
                r"K_s = \begin{bmatrix}m E & -\langle\mu\rangle\\ \langle\mu\rangle & J\end{bmatrix},\quad K^*_s = "
                r"\begin{bmatrix}0 & -\langle\dot{\mu}\rangle\\ \langle\dot{\mu}\rangle & \dot{J}\end{bmatrix}",
                "2, 6",
            ),
            Formula(rf"I_s = {tex(columns.I)},\quad I'_s = {tex(columns.I_prime)}", "9"),
            r"The force part of $I_s$ is the derivative of the first moment by the phase, $\mu'$. With its moment "
            "part $t$, (9) becomes:",
            Formula(
                r"J_s = \Phi I_s + \dot{\varphi}I'_s = \begin{bmatrix}\omega\times\mu'\\ v\times\mu' + \omega\times t"
                r"\end{bmatrix} + \dot{\varphi}\begin{bmatrix}\mu''\\ t'\end{bmatrix}",
                "9",
            ),
            r"Sums that the momentum form needs, $I_s\dot{\varphi} = (\dot{\mu}, h^{rel})$ and its derivative:",
            Formula(
                rf"h^{{rel}} = {tex(sums.h_rel)},\quad a^{{rel}} = {tex(sums.a_rel)},\quad g^{{rel}} = "
                rf"{tex(sums.g_rel)}",
                "5",
            ),
        ),
    )


BLOCKS = ((0, 0), (0, 3), (3, 0), (3, 3))


def velocity_matrix(added_mass: bool) -> sp.Matrix:
    """M = Phi K + K* of (9), written out; with added mass in the symbols of B."""
    K = carrier.mass_matrix(added_mass)
    if added_mass:
        B = matrix("B")
        K = blocks(K[:3, :3], B.T, B, K[3:, 3:])
    return (Phi(carrier.V) * K + carrier.mass_matrix_rate()).applyfunc(sp.expand)


def equation(added_mass: bool, weight: sp.Matrix | None, displaces: bool) -> Section:
    """(2), (4), (7)-(9) with the sums of all bodies; `weight`: that of all bodies, None without gravity."""
    M = velocity_matrix(added_mass)
    sums = r"With the sums over all bodies, mass $m$, first moment $\mu$ and moments of inertia $J$ about $O_1$"
    sums += (
        r" ($J$ with $\Lambda_{22}$), and the blocks of the added mass in $A = m E + \Lambda_{11}$, $G = "
        r"\Lambda_{21}$, "
        r"$B = \langle\mu\rangle + G$:"
        if added_mass
        else ":"
    )
    weighed: list[str | Formula | Table] = []
    if weight is not None:
        fluid = r"; $m^w$ is the mass less that of the displaced fluid, $\mu^d$ its first moment" if displaces else ""
        weighed = [
            r"Weight of all bodies at once, in (7): the force $m g$ acts at the mass centre, and $\mu$ moves with the "
            f"flywheels{fluid}.",
            _equal("F_g", weight, number="7"),
        ]
    return Section(
        "The carrier",
        "(2), (4)-(9)",
        (
            "Over all bodies: $K$ from carrier, instruments, flywheels and added mass, a column of $I$ and $J$ a "
            "flywheel.",
            Formula(
                r"K = \Theta_1 + \sum_p L_p\Theta_p L_p^T + \sum_s L_s\Theta_s L_s^T + \Lambda_1 + \sum_p\Lambda_p", "2"
            ),
            Formula(r"Z = K V + \sum_s I_s\dot{\varphi}_s", "2"),
            Formula(r"Z^* + \Phi Z = F", "4"),
            Formula(r"F = P_1 + \sum_p L_p P_p + \sum_s L_s P_s", "7"),
            Formula(r"K V^* + M V + \sum_s\left(I_s\ddot{\varphi}_s + J_s\dot{\varphi}_s\right) = F", "8"),
            Formula(r"M = \Phi K + K^*", "9"),
            sums,
            _equal("K", carrier.mass_matrix(added_mass), number="2"),
            _equal("K^*", carrier.mass_matrix_rate(), number="6"),
            r"The velocity matrix, $M = \begin{bmatrix}M_{11} & M_{12}\\ M_{21} & M_{22}\end{bmatrix}$, block by "
            r"block:",
            *(_equal(f"M_{{{1 + i // 3}{1 + j // 3}}}", M[i : i + 3, j : j + 3], number="9") for i, j in BLOCKS),
            *weighed,
            "The emitted code never forms $M$, $I$ and $J$ to solve (8). It takes the momentum of the whole system, "
            "and the rates of its parts in $E_1$:",
            _equal(r"Z = \begin{bmatrix}p\\ h\end{bmatrix}", carrier.momentum(added_mass), number="2"),
            r"Then $F - M V - \sum_s(I_s\ddot{\varphi}_s + J_s\dot{\varphi}_s)$, which $K V^*$ has to equal, is",
            _equal(
                r"F - \Phi Z - K^* V - \begin{bmatrix}a^{rel}\\ g^{rel}\end{bmatrix}",
                carrier.remainder(),
                number="4, 5",
            ),
        ),
    )


def solution(added_mass: bool) -> Section:
    """K y = F with the constant translational block eliminated."""
    if added_mass:
        words = "$A$ is constant: it is inverted once, when the stand is prepared."
        K, U, linear = r"A & B^T\\ B & J", "U = A^{-1}B^T", "A^{-1}r_1"
        S = r"S = J - B U"
    else:
        words = r"The translational block is $m E$: no inverse is needed, and $U$ is a cross-product matrix."
        K, U, linear = (
            r"m E & -\langle\mu\rangle\\ \langle\mu\rangle & J", r"\rho = \mu/m,\quad U = -\langle\rho\rangle", "r_1/m",
        )  # fmt: skip
        S = r"S = J - \langle\mu\rangle U"
    return Section(
        "Solution for the acceleration",
        "(8)",
        (
            words,
            Formula(rf"K = \begin{{bmatrix}}{K}\end{{bmatrix}},\quad {U}"),
            _equal(S, from_six(carrier.reduced_inertia(added_mass))),
            "With $(r_1, r_2)$ for the right-hand side, three unknowns are left; $S$ is symmetric and positive "
            "definite:",
            Formula(rf"S\omega^* = r_2 - U^T r_1,\quad v^* = {linear} - U\omega^*", "8"),
        ),
    )


def turns(sequence: str) -> str:
    """C of an attitude sequence as a product."""
    return r"\,".join(f"C_{axis}({_base(angle)})" for axis, angle in zip(SEQUENCES[sequence], ANGLES, strict=True))


def generalized(sequence: str) -> Section:
    """C, B, A, D of an attitude sequence; I0, J0: the form (10), (11)."""
    made = attitude(sequence)
    _, D = kinematics(sequence)
    inverse = made.B_inverse.xreplace({sp.Symbol("singular_inv"): 1 / made.singular})
    where = r"\cos\theta = 0" if str(made.singular).startswith("c") else r"\sin\theta = 0"
    return Section(
        "Generalized coordinates",
        "(10), (11)",
        (
            rf"Attitude sequence {sequence}: $q$ is the position of $O_1$ in $E_0$, then $\psi$, $\theta$, $\varphi$; "
            r"$c_\psi = \cos\psi$, $s_\psi = \sin\psi$ and so on; $x_0 = C x_1$.",
            _equal(f"C = {turns(sequence)}", made.C),
            Formula(
                r"\omega = B\begin{bmatrix}\dot{\psi}\\ \dot{\theta}\\ \dot{\varphi}\end{bmatrix},\quad "
                f"B = {tex(made.B)}"
            ),
            Formula(r"V = A\dot{q},\quad V^* = A\ddot{q} + D\dot{q}", "10"),
            Formula(
                r"A = \begin{bmatrix}C^T & 0\\ 0 & B\end{bmatrix},\quad D = \dot{A} = "
                r"\begin{bmatrix}-\langle\omega\rangle C^T & 0\\ 0 & \dot{B}\end{bmatrix}",
                "10",
            ),
            _equal(r"-\langle\omega\rangle C^T", D[:3, :3]),
            _equal(r"\dot{B}", made.B_dot),
            rf"$A$ has no inverse where ${where}$; elsewhere $\dot{{q}} = A^{{-1}}V$ with",
            _equal("B^{-1}", inverse),
            Formula(r"I_0\ddot{q} + J_0\dot{q} + I\ddot{\varphi} + J\dot{\varphi} = F", "11"),
            Formula(r"I_0 = K A,\quad J_0 = K D + M A,\quad I = [I_2, \ldots, I_m],\quad J = [J_2, \ldots, J_m]", "11"),
            r"Since $K$ cancels, the emitted code takes $\ddot{q} = A^{-1}(V^* - D\dot{q})$ with $V^*$ of (8).",
        ),
    )


def held() -> tuple[str, Formula, Formula]:
    """How a held carrier moves, (8) without a stream."""
    forces = r"\sum_s\left(I_s\ddot{\varphi}_s + J_s\dot{\varphi}_s\right)"
    return (
        "The carrier is held: it moves as $V = S u$, with $S$ constant in $E_1$, and the hold exerts the wrench $R$, "
        "which has no power in any $u$:",
        Formula(rf"K\dot{{V}} + M V + {forces} - F = R,\quad S^T R = 0"),
        Formula(rf"S^T K S\dot{{u}} = S^T\left(F - M S u - {forces}\right)"),
    )


def numbers(matrix_of: Iterable[Any], noise: Iterable[Any]) -> str:
    """A matrix of numbers; what is not above its noise is zero."""
    rows = (" & ".join(map(number, *pair)) for pair in zip(matrix_of, noise, strict=True))
    return r"\begin{bmatrix}" + r" \\ ".join(rows) + r"\end{bmatrix}"


def number(value: float, noise: float = 0.0) -> str:
    """A number to six significant digits."""
    digits, _, exponent = f"{value if abs(value) > noise else 0.0:.6g}".partition("e")
    return digits + (rf"\cdot 10^{{{int(exponent)}}}" if exponent else "")
