"""Matrices of (8)-(11) at a state, with numbers, and the balance of (8) there."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

import numpy as np
from markupsafe import Markup
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Stand, Vec3
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.out.report.stand.markup import Cell, figure, math_text, paragraph, sentence, table
from mahovik.out.report.stand.material import Material
from mahovik.out.report.stand.matrix import Array, Side, matrix
from mahovik.out.report.stand.section import Section
from mahovik.proof import reference
from mahovik.proof.reference.forward import forward
from mahovik.proof.verify.judges.rigid import SEQUENCES
from mahovik.proof.verify.scales import scales

MANY = 13
"""Flywheels from which on `I` and `J` are shown transposed, a row a flywheel: a page is as long as it has to be."""

EQUATIONS = (
    ("2", "K = Theta_1 + sum_p L_p Theta_p L_p^T + sum_s L_s Theta_s L_s^T + Lambda_1 + sum_p Lambda_p"),
    ("6", "K* = sum_s L_s ([<e>] Theta_s - Theta_s [<e>]) L_s^T dot(phi)_s"),
    ("7", "F = P_1 + sum_p L_p P_p + sum_s L_s P_s"),
    ("8", "K V* + M V + sum_s (I_s ddot(phi)_s + J_s dot(phi)_s) = F"),
    ("9", 'M = Phi K + K*, "   "I_s = L_s Theta_s f, "   "J_s = (Phi L_s + L_s [<e>] dot(phi)_s) Theta_s f'),
    ("10", 'V = A dot(q), "   "V* = A ddot(q) + D dot(q), "   "A = {C^T, 0; 0, B}'),
    ("11", 'I_0 ddot(q) + J_0 dot(q) + I ddot(phi) + J dot(phi) = F, "   "I_0 = K A, "   "J_0 = K D + M A'),
)
"""Equations in the notation of docs/model.md."""

_THREE = ("1", "2", "3")
_ANGLES = ("ψ", "θ", "φ")
_ROWS = Side((("force", _THREE), ("moment", _THREE)))


def section(material: Material) -> Section | None:
    """The equations, the state, K, K*, M, I, J, then A, D, I0, J0, and the terms of (8)."""
    stand, state = material.stand, with_angles(material.stand, material.state)
    at = reference.pieces(stand, state)
    natural = scales(stand, state, at, "matrices")
    parts = [
        paragraph(
            "Numbers by the literal reference, in axes of `E_1` about `O_1`. Rows are components of a force, N, and of "
            "a moment, N m; columns are multiplied by what stands above them. A dot is a zero, ≈0 rounding; the shade "
            "tells the magnitude within its block, over three powers of ten, blue above zero and orange below."
        ),
        _equations(),
        Markup("<h3>State</h3>\n<p>{}.</p>\n").format(sentence(material.state_words)),
        _state(stand, state),
        Markup("<h3>Carrier, (2), (6), (9)</h3>\n"),
        Markup('<div class="side">\n'),
        _square("K", "2", at.K, natural["K"], _twist("v∗, m/s²", "ω∗, rad/s²")),
        _square("K*", "6", at.K_dot, natural["K_dot"], _twist("v, m/s", "ω, rad/s")),
        _square("M", "9", at.M, natural["M"], _twist("v, m/s", "ω, rad/s")),
        Markup("</div>\n"),
    ]
    if stand.flywheels:
        parts += [
            Markup("<h3>Flywheels, (9)</h3>\n"),
            _wheels(stand, "I", at.I, natural["I"], "φ″, rad/s²"),
            _wheels(stand, "J", at.J, natural["J"], "φ′, rad/s"),
            _reach(stand, state),
        ]
    parts += [_generalized(stand, state, at), _balance(at, state)]
    return Section("matrices", "Matrices at a state", Markup("").join(parts))


def with_angles(stand: Stand, state: State) -> State:
    """The state with its attitude as angles of the stand's sequence; as it is where it has no quaternion."""
    if state.quaternion is None:
        return state
    turn = Rotation.from_quat(state.quaternion, scalar_first=True)
    angles = turn.as_euler(SEQUENCES[stand.angles], suppress_warnings=True)
    return replace(state, quaternion=None, angles=cast(Vec3, tuple(float(x) for x in angles)))


def _equations() -> Markup:
    """Each with its number, by which captions name it."""
    lines = [
        Markup('<div class="formula" id="equation-{}"><div tabindex="0">{}</div><span>({})</span></div>\n').format(
            number, math_text(notation, display=True), number
        )
        for number, notation in EQUATIONS
    ]
    return Markup("").join(lines)


def _caption(name: str, equation: str, units: str) -> Markup:
    return Markup('<b>{}</b> <a href="#equation-{}">({})</a>, {}').format(math_text(name), equation, equation, units)


def _twist(linear: str, angular: str) -> Side:
    return Side(((linear, _THREE), (angular, _THREE)))


_UNITS = {"K": "kg, kg m, kg m²", "K*": "kg/s, kg m/s, kg m²/s", "M": "kg/s, kg m/s, kg m²/s"}


def _square(name: str, equation: str, values: Array, scale: Array, columns: Side) -> Markup:
    return matrix(_caption(name, equation, _UNITS[name]), values, scale, _ROWS, columns)


def _wheels(stand: Stand, name: str, values: Array, scale: Array, heading: str) -> Markup:
    """A 6xN matrix; of many flywheels its transpose."""
    units = {"I": "kg m, kg m²", "J": "kg m/s, kg m²/s"}[name]
    wheels = Side(((heading, tuple(s.name for s in stand.flywheels)),))
    if len(stand.flywheels) < MANY:
        return matrix(_caption(name, "9", units), values, scale, _ROWS, wheels)
    return matrix(_caption(f"{name}^T", "9", f"{units}; transposed"), values.T, scale.T, wheels, _ROWS)


def _reach(stand: Stand, state: State) -> Markup:
    """Singular values of I as (12) takes them."""
    try:
        found = reference.evaluate(stand, state, ["inverse"])
    except (StateError, np.linalg.LinAlgError):
        return Markup("")
    values = Markup(", ").join(figure(float(x), 4) for x in found["sigma"])
    return Markup("<p>Singular values of {}, without dimension: {}; rank {}, of {} that could be.</p>\n").format(
        math_text("K^{-1/2} I Theta_{ff}^{-1/2}"), values, found["rank"], len(found["sigma"])
    )


def _generalized(stand: Stand, state: State, at: reference.Pieces) -> Markup:
    """A, D of (10), I0, J0 of (11); a sentence where the attitude is singular."""
    head = Markup("<h3>Generalized coordinates, (10), (11)</h3>\n")
    try:
        found = reference.evaluate(stand, state, ["generalized"], at)
        natural = scales(stand, state, at, "generalized")
    except StateError as error:
        return head + Markup("<p>Not shown: {}.</p>\n").format(str(error))
    rates, accelerations = (("O₁′, m/s", "angles′, rad/s"), ("O₁″, m/s²", "angles″, rad/s²"))
    twist = Side((("v, m/s", _THREE), ("ω, rad/s", _THREE)))
    change = Side((("v∗, m/s²", _THREE), ("ω∗, rad/s²", _THREE)))
    shown: tuple[tuple[str, str, str, Side, tuple[str, str]], ...] = (
        ("A", "10", "without dimension", twist, rates),
        ("D", "10", "1/s", change, rates),
        ("I_0", "11", "kg, kg m, kg m²", _ROWS, accelerations),
        ("J_0", "11", "kg/s, kg m/s, kg m²/s", _ROWS, rates),
    )
    parts = [head, paragraph("With `q` = (`O_1` in `E_0`; ψ, θ, φ)."), Markup('<div class="side">\n')]
    for name, equation, units, rows, (linear, angular) in shown:
        key = name.replace("_", "")
        columns = Side(((linear, _THREE), (angular, _ANGLES)))
        values: Any = found[key]
        parts.append(matrix(_caption(name, equation, units), values, natural[key], rows, columns))
    return Markup("").join([*parts, Markup("</div>\n")])


def _state(stand: Stand, state: State) -> Markup:
    """Place, attitude and twist; then the flywheels."""
    angles = state.angles or (0.0, 0.0, 0.0)
    carrier: list[tuple[str, tuple[float, ...]]] = [
        ("O₁ in E₀, m", state.position),
        ("ψ, θ, φ, rad", angles),
        ("v, m/s", state.V[:3]),
        ("ω, rad/s", state.V[3:]),
    ]
    rows: list[list[Cell]] = [[name, *(figure(x) for x in values)] for name, values in carrier]
    found = table(("carrier", "1>", "2>", "3>"), [rows])
    if stand.flywheels:
        numbers = zip(stand.flywheels, state.phi, state.phi_dot, state.phi_ddot, strict=True)
        wheels: list[list[Cell]] = [[s.name, *(figure(x) for x in values)] for s, *values in numbers]
        found += table(("flywheel", "φ, rad>", "φ′, rad/s>", "φ″, rad/s²>"), [wheels])
    return Markup('<div class="side">\n{}</div>\n').format(found)


def _balance(at: reference.Pieces, state: State) -> Markup:
    """What stands in (8) at the state, and the acceleration that makes it hold."""
    acceleration = np.array(state.phi_ddot, dtype=np.float64)
    V_dot = forward(at, acceleration)
    terms: list[tuple[str, Array]] = [
        ("F", at.F),
        ("-M V", -at.M @ at.V_r),
        ("-J dot(phi)", -at.J @ at.phi_dot),
        ("-I ddot(phi)", -at.I @ acceleration),
    ]
    rows = [[math_text(name), *(figure(float(x), 4) for x in values)] for name, values in terms]
    total = [[math_text("K V*"), *(figure(float(x), 4) for x in at.K @ at.V_r_dot(V_dot))]]
    solved = [[math_text("V*"), *(figure(float(x), 4) for x in V_dot)]]
    words = paragraph(
        "The terms of (8) with their signs on the right-hand side, for the accelerations of the flywheels above; what "
        "they sum to is `K V*`, hence the acceleration of the carrier, in m/s² and rad/s²."
        + (" Velocities are those relative to the stream." if at.u.any() else "")
    )
    head = (
        "", "force 1, N>", "2>", "3>", "moment 1, N m>", "2>", "3>",
    )  # fmt: skip
    return Markup("<h3>Balance of (8)</h3>\n") + words + table(head, [rows, total, solved])
