"""The matrices of (8)-(11) at a state, with lines between blocks and shades by magnitude and sign."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, cast

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from mahovik.core.stand.hold import freedom_names, has_coordinates, no_coordinates, numbered_freedoms, numbers_in_words
from mahovik.core.stand.model import Hold, Stand, Vec3
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.out.report.stand.markup import Cell, align, figure, markup_of, math_text, sentence, table
from mahovik.out.report.stand.material import Material, Section
from mahovik.proof import reference
from mahovik.proof.reference.hold import held_forward
from mahovik.proof.reference.motion import forward
from mahovik.proof.verify.judges import SEQUENCES
from mahovik.proof.verify.scales import scales_of

Array = NDArray[np.float64]

DIGITS = 4

SHADES = 6
"""Steps of shading; the darkest is the largest of its block."""

DECADES = 3.0
"""Below the largest of its block by as many powers of ten, an element has the lightest shade."""

ROUNDING = 1e-13
"""Part of the natural scale below which a number is rounding, and shown as such."""


@dataclass(frozen=True)
class Side:
    """Meaning of the rows or columns of a matrix: groups with a heading, each with the names of its lines."""

    groups: tuple[tuple[Cell, tuple[str, ...]], ...]

    @property
    def starts(self) -> tuple[int, ...]:
        """Index of the first line of each group, and one past the last."""
        found = [0]
        for _, names in self.groups:
            found.append(found[-1] + len(names))
        return tuple(found)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all lines."""
        return tuple(name for _, names in self.groups for name in names)


def matrix(caption: Cell, values: Array, scale: Array, rows: Side, columns: Side) -> Markup:
    """A figure with the matrix `values`; `scale`, of its shape: the natural scale, which tells rounding from numbers.

    A dot is a zero, "≈0" rounding. Blocks are those of the groups of rows and columns; each has its own shades, since
    it has its own unit.
    """
    assert values.shape == scale.shape == (len(rows.names), len(columns.names))
    edges = ["edge" if j > 0 and j in columns.starts else "" for j in range(values.shape[1])]
    largest = np.zeros_like(values)
    for top, bottom in pairwise(rows.starts):
        for left, right in pairwise(columns.starts):
            block = np.s_[top:bottom, left:right]
            largest[block] = np.abs(values[block]).max(initial=0.0)
    cells = [
        [_cell(x, size, most, edge) for x, size, most, edge in zip(*row, edges, strict=True)]
        for row in zip(values, scale, largest, strict=True)
    ]
    for k in range(values.shape[1]):
        for row, text in zip(cells, align([row[k][1] for row in cells]), strict=True):
            row[k] = (row[k][0], text)
    groups = [
        (heading, names, cells[start : start + len(names)])
        for (heading, names), start in zip(rows.groups, rows.starts, strict=False)
    ]
    return markup_of("matrix", caption=caption, columns=columns, edges=edges, groups=groups)


def shade(value: float, largest: float) -> int:
    """0 for nothing; 1, light, to SHADES for the largest of the block."""
    if value == 0.0 or largest == 0.0:
        return 0
    part = 1.0 + math.log10(abs(value) / largest) / DECADES
    return max(1, math.ceil(SHADES * part))


def _cell(value: float, scale: float, largest: float, edge: str) -> tuple[str, Cell]:
    """Classes of a cell, and its text."""
    if value == 0.0:
        kind, text = "none", Markup("·")
    elif abs(value) <= ROUNDING * scale:
        kind, text = "none", Markup("≈0")
    else:
        kind, text = f"{'n' if value < 0 else 'p'}{shade(value, largest)}", figure(value, DIGITS)
    return f"{edge} {kind}".strip(), text


MANY = 13
"""Flywheels from which on `I` and `J` are shown transposed, one row per flywheel: a page is as long as it has to be."""

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

HELD_EQUATIONS = (
    (
        "8 of a held carrier",
        'V = S u, "   "K V* + M V + sum_s (I_s ddot(phi)_s + J_s dot(phi)_s) = F + R, "   "S^T R = 0',
    ),
)
"""Equations of a held carrier, in place of (10) and (11)."""

_THREE = ("1", "2", "3")
_ANGLES = ("ψ", "θ", "φ")
_ROWS = Side((("force", _THREE), ("moment", _THREE)))


def section(material: Material) -> Section | None:
    """The equations, the state, K, K*, M, I, J, then A, D, I0, J0, and the terms of (8)."""
    stand, state = material.stand, with_angles(material.stand, material.state)
    at = reference.pieces(stand, state)
    natural = scales_of(stand, state, "matrices")
    carrier = [
        _square("K", "2", at.K, natural["K"], _twist("v∗, m/s²", "ω∗, rad/s²")),
        _square("K*", "6", at.K_dot, natural["K_dot"], _twist("v, m/s", "ω, rad/s")),
        _square("M", "9", at.M, natural["M"], _twist("v, m/s", "ω, rad/s")),
    ]
    flywheels = []
    if stand.flywheels:
        flywheels = [
            _wheels(stand, "I", at.I, natural["I"], "φ″, rad/s²"),
            _wheels(stand, "J", at.J, natural["J"], "φ′, rad/s"),
        ]
    html = markup_of(
        "matrices",
        equations=EQUATIONS if stand.hold is None else (*EQUATIONS[:5], *HELD_EQUATIONS),
        held=stand.hold is not None,
        state_words=sentence(material.state_words),
        state=_state(stand, state),
        carrier=carrier,
        flywheels=flywheels,
        **_reach(stand, state),
        **(_generalized_form(stand, state, at) if stand.hold is None else _coordinates(stand, stand.hold, state)),
        balance=_balance(at, state, stand.hold),
        stream=at.u.any(),
    )
    return Section("matrices", "Matrices at a state", html)


def with_angles(stand: Stand, state: State) -> State:
    """The state with its attitude as angles of the stand's sequence; as it is where it has no quaternion."""
    if state.quaternion is None:
        return state
    turn = Rotation.from_quat(state.quaternion, scalar_first=True)
    angles = turn.as_euler(SEQUENCES[stand.angles], suppress_warnings=True)
    return replace(state, quaternion=None, angles=cast(Vec3, tuple(float(x) for x in angles)))


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


def _reach(stand: Stand, state: State) -> dict[str, Any]:
    """Singular values of I as (12) takes them, and their rank; () and 0 where (12) is not defined."""
    try:
        found = reference.evaluate(stand, state, ["inverse"])
    except (StateError, np.linalg.LinAlgError):
        return {"sigma": (), "rank": 0}
    return {"sigma": [figure(float(x), 4) for x in found["sigma"]], "rank": found["rank"]}


def _generalized_form(stand: Stand, state: State, at: reference.Pieces) -> dict[str, Any]:
    """A, D of (10), I0, J0 of (11); or why there are none: the attitude is singular."""
    try:
        found = reference.evaluate(stand, state, ["generalized"], at)
        natural = scales_of(stand, state, "generalized")
    except StateError as error:
        return {"generalized": [], "refused": str(error)}
    rates, accelerations = (("O₁′, m/s", "angles′, rad/s"), ("O₁″, m/s²", "angles″, rad/s²"))
    shown: tuple[tuple[str, str, str, Side, tuple[str, str]], ...] = (
        ("A", "10", "without dimension", _twist("v, m/s", "ω, rad/s"), rates),
        ("D", "10", "1/s", _twist("v∗, m/s²", "ω∗, rad/s²"), rates),
        ("I_0", "11", "kg, kg m, kg m²", _ROWS, accelerations),
        ("J_0", "11", "kg/s, kg m/s, kg m²/s", _ROWS, rates),
    )
    matrices = []
    for name, equation, units, rows, (linear, angular) in shown:
        key = name.replace("_", "")
        columns = Side(((linear, _THREE), (angular, _ANGLES)))
        values: Any = found[key]
        matrices.append(matrix(_caption(name, equation, units), values, natural[key], rows, columns))
    return {"generalized": matrices, "refused": ""}


def _coordinates(stand: Stand, hold: Hold, state: State) -> dict[str, Any]:
    """Coordinates of the freedoms and their rates; or why there are none."""
    if not has_coordinates(hold):
        return {"generalized": [], "refused": no_coordinates(hold)}
    found = reference.evaluate(stand, state, ["generalized"])
    numbered, q = numbered_freedoms(hold), iter(found.get("q", ()))
    rows: list[list[Cell]] = []
    for k, (name, freedom) in enumerate(zip(freedom_names(hold), hold.freedoms, strict=True)):
        place = figure(next(q)) if k in numbered else Markup("")
        unit = "m" if freedom.kind == "slide" else "rad"
        rows.append([name, unit, place, *(figure(float(found[key][k])) for key in ("q_dot", "q_ddot"))])
    head = ("freedom", "unit", "q>", Markup("q′, 1/s>"), Markup("q″, 1/s²>"))
    shown = [table(head, [rows])]
    if "orientation" in found:
        turned = [figure(float(x)) for x in found["orientation"]]
        shown.append(table(("", "w>", "x>", "y>", "z>"), [[["orientation from the home pose", *turned]]]))
    return {"generalized": shown, "refused": "", "coordinates": named_freedoms(hold)}


def named_freedoms(hold: Hold) -> str:
    """A sentence on what freedoms are whose names are numbers; empty where all have names."""
    numbers = numbers_in_words(hold)
    return f"Of the freedoms {numbers}. " if numbers else ""


def _state(stand: Stand, state: State) -> list[Markup]:
    """Tables of place, attitude and twist; then of the flywheels."""
    angles = state.angles or (0.0, 0.0, 0.0)
    carrier: list[tuple[str, tuple[float, ...]]] = [
        ("O₁ in E₀, m", state.position),
        ("ψ, θ, φ, rad", angles),
        ("v, m/s", state.V[:3]),
        ("ω, rad/s", state.V[3:]),
    ]
    rows: list[list[Cell]] = [[name, *(figure(x) for x in values)] for name, values in carrier]
    found = [table(("carrier", "1>", "2>", "3>"), [rows])]
    if stand.flywheels:
        numbers = zip(stand.flywheels, state.phi, state.phi_dot, state.phi_ddot, strict=True)
        wheels: list[list[Cell]] = [[s.name, *(figure(x) for x in values)] for s, *values in numbers]
        found.append(table(("flywheel", "φ, rad>", "φ′, rad/s>", "φ″, rad/s²>"), [wheels]))
    return found


def _balance(at: reference.Pieces, state: State, hold: Hold | None) -> Markup:
    """What stands in (8) at the state, and the acceleration that makes it hold; of a held carrier the reaction too."""
    acceleration = np.array(state.phi_ddot, dtype=np.float64)
    moved = None if hold is None else held_forward(at, hold, acceleration)
    V_dot = forward(at, acceleration) if moved is None else moved.V_dot
    terms: list[tuple[str, Array]] = [
        ("F", at.F),
        ("-M V", -at.M @ at.V_r),
        ("-J dot(phi)", -at.J @ at.phi_dot),
        ("-I ddot(phi)", -at.I @ acceleration),
    ]
    terms += [] if moved is None else [("R", moved.reaction)]
    groups = [
        [[math_text(name), *(figure(float(x), 4) for x in values)] for name, values in group]
        for group in (terms, [("K V*", at.K @ at.V_r_dot(V_dot))], [("V*", V_dot)])
    ]
    return table(("", "force 1, N>", "2>", "3>", "moment 1, N m>", "2>", "3>"), groups)
