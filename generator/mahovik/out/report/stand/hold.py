"""The hold of a held carrier: its freedoms, the equilibrium, modes along the freedoms, motion and reaction."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from markupsafe import Markup

from mahovik.core.stand.hold import (
    freedom_names,
    freedom_words,
    has_coordinates,
    is_closed,
    no_coordinates,
    numbered_freedoms,
    twists,
    words,
)
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.state import State
from mahovik.errors import CheckError
from mahovik.out.report.stand.markup import Cell, figure, math_text, message, paragraph, sentence, table
from mahovik.out.report.stand.material import Material, Section
from mahovik.out.report.stand.matrices import Side, matrix, named_freedoms
from mahovik.proof import reference
from mahovik.proof.reference.coordinates import coordinates_at
from mahovik.proof.verify.scales import scales_of
from mahovik.use.plan.array import Array
from mahovik.use.study.linear import linear_model, modes
from mahovik.use.study.linear.words import shape_words
from mahovik.use.study.rest import Rest, rest

TWIST: tuple[Cell, ...] = ("u>", "v>", "w>", "p>", "q>", "r>")
"""Components of a column of S."""

RATES = {"slide": "m/s", "turn": "rad/s", "twist": "1/s"}
COORDINATES = {"slide": "way, m", "turn": "angle, rad"}

SEARCH = (
    "The search begins in the home pose, and from one that the carrier would leave it goes on to one where it stays, "
    "if there is one. ``mahovik rest`` takes other phases of the flywheels."
)

ROUNDING = 1e-12
"""Part of the largest of its kind below which a number is rounding."""


def section(material: Material) -> Section | None:
    """The section; None of a free carrier."""
    stand, hold = material.stand, material.stand.hold
    if hold is None:
        return None
    parts = [paragraph(_introduction(hold))]
    if hold.freedoms:
        parts.append(_freedoms(hold))
    parts += [Markup("<h3>Equilibrium</h3>\n"), *_equilibrium(stand, hold)]
    parts += [Markup("<h3>Motion and reaction at a state</h3>\n"), *_motion(material, hold)]
    parts += [Markup("<h3>Left out on this page</h3>\n"), paragraph(_left_out(stand, hold))]
    return Section("hold", "Hold", Markup("").join(parts), summary=words(hold).partition(";")[0])


def _introduction(hold: Hold) -> str:
    turned = ", ".join(str(figure(math.degrees(x))) for x in hold.angles)
    at = ", ".join(str(figure(x)) for x in hold.position)
    found = (
        f"{sentence(words(hold))}. In the home pose `O_1` is in `E_0` at ({at}) m, turned by ψ, θ, φ = ({turned}) deg. "
    )
    if any(freedom.kind == "turn" for freedom in hold.freedoms):
        place = ", ".join(str(figure(1e3 * x)) for x in hold.pivot)
        found += f"What turns, turns about the pivot, in `E_1` at ({place}) mm. "
    found += "The carrier moves as `V = S u`, and (8) has the wrench `R` of the hold on the carrier beside `F`. "
    if not hold.freedoms:
        return found + "A force table under it reads the reverse of `R`."
    return found + "`R` does no work in what is free: `S^T R = 0`."


def _freedoms(hold: Hold) -> Markup:
    """Each freedom with its coordinate and its column of S."""
    numbered = numbered_freedoms(hold) if has_coordinates(hold) else []
    S, rows = twists(hold), list[list[Cell]]()
    for k, (name, what, freedom) in enumerate(
        zip(freedom_names(hold), freedom_words(hold), hold.freedoms, strict=True)
    ):
        whole = "orientation" if has_coordinates(hold) else "none"
        coordinate = COORDINATES[freedom.kind] if k in numbered else whole
        column = [figure(_clean(float(x))) for x in S[:, k]]
        rows.append([name, what if what != name else _direction(name), coordinate, RATES[freedom.kind], *column])
    head = ("freedom", "how it moves", "coordinate", "its speed, unit", *TWIST)
    found = paragraph(
        "Columns of `S` as rows: the twist of `O_1` on the axes of `E_1` at speed 1, three velocities and three "
        "angular velocities."
    ) + table(head, [rows])
    if not has_coordinates(hold):
        return found + paragraph(f"{sentence(no_coordinates(hold))}.")
    if len(numbered) < len(hold.freedoms):
        return found + paragraph("Three turns have one coordinate together: the unit quaternion from the home pose.")
    return found


def _direction(name: str) -> str:
    """How a freedom moves that the file gives by its name."""
    turn = {"roll": "x", "pitch": "y", "yaw": "z"}
    return f"turning about {turn[name]} of E1" if name in turn else f"sliding along {name} of E1"


def _equilibrium(stand: Stand, hold: Hold) -> list[Markup]:
    """Pose, reaction and modes at rest; or why there is no equilibrium."""
    try:
        found = rest(stand)
    except CheckError as error:
        return [paragraph(f"{message(error)}.")]
    state = found.state
    rows: list[list[Cell]] = [["O₁ in E₀, m", *_cells(np.array(state.position)), ""]]
    rows.append(["quaternion, w first", *(figure(_clean(x)) for x in state.quaternion or (1.0, 0.0, 0.0, 0.0))])
    if has_coordinates(hold):
        rows += _coordinates(stand, hold, state)
    shown = [paragraph(SEARCH)] if hold.freedoms else []
    shown += [table(("at rest, flywheels at phase zero", "1>", "2>", "3>", "4>"), [rows])]
    answer = reference.evaluate(stand, _still(stand, state), ["forward"])
    shown.append(_wrench("Reaction at rest", answer["reaction"]))
    if not hold.freedoms:
        return shown
    if found.unstable:
        shown.append(paragraph("Unstable: the carrier would leave this pose."))
    return [*shown, Markup("<h3>Modes along the freedoms</h3>\n"), *_modes(stand, hold, found)]


def _coordinates(stand: Stand, hold: Hold, state: State) -> list[list[Cell]]:
    """Rows of the coordinates at a state."""
    here, names = coordinates_at(stand, state), freedom_names(hold)
    rows: list[list[Cell]] = []
    for k, x in zip(numbered_freedoms(hold), here.q.tolist(), strict=True):
        unit = "m" if hold.freedoms[k].kind == "slide" else "rad"
        rows.append([f"q {names[k]}, {unit}", figure(_clean(x)), "", "", ""])
    if here.orientation is not None:
        rows.append(["orientation from the home pose", *_cells(here.orientation)])
    return rows


def _modes(stand: Stand, hold: Hold, at: Rest) -> list[Markup]:
    """Small motions about rest with flywheels that keep their motion, as under a stiff servo."""
    found = modes(linear_model(stand, at.state, [], locked=True))
    rows: list[list[Cell]] = []
    for number, mode in enumerate(found.modes, start=1):
        free = mode.kind == "free"
        frequency = Markup("–") if free else figure(mode.frequency)
        kind = "" if mode.kind == "oscillation" else f"{mode.kind}, "
        damping = Markup("–") if free else figure(mode.damping, 4)
        rows.append([str(number), frequency, damping, kind + shape_words(found, mode.shape)])
    note = "Flywheels are at rest and keep their angles. Without a frequency: nothing brings the carrier back. "
    return [
        paragraph(note + named_freedoms(hold)),
        table(("mode", "frequency, Hz>", "damping ratio>", "shape"), [rows]),
    ]


def _motion(material: Material, hold: Hold) -> list[Markup]:
    """What `forward` answers at the state of the matrices, and the mass matrix of the freedoms there."""
    stand, state = material.stand, material.state
    with np.errstate(all="ignore"):
        found = reference.evaluate(stand, state, ["forward"])
        at = reference.pieces(stand, state)
        natural = scales_of(stand, state, "forward")
    words_ = (
        f"{sentence(material.state_words)}: what ``forward`` answers there, flywheels keeping their accelerations. "
    )
    if not hold.freedoms:
        words_ += "The carrier does not accelerate. "
    shown = [paragraph(words_)]
    if hold.freedoms:
        rows: list[list[Cell]] = [
            [name, figure(u), figure(_without_rounding(x, size)), f"{RATES[freedom.kind]}²"]
            for name, freedom, u, x, size in zip(
                freedom_names(hold),
                hold.freedoms,
                state.u,
                found["u_dot"],
                natural["u_dot"],
                strict=True,
            )
        ]
        shown.append(table(("freedom", "u>", Markup("u∗>"), "unit of u∗"), [rows]))
        S, K = twists(hold), scales_of(stand, state, "matrices")["K"]
        side = Side((("freedoms", tuple(freedom_names(hold))),))
        caption = Markup("<b>{}</b>, mass matrix of the freedoms, SI").format(math_text("S^T K S"))
        shown.append(matrix(caption, S.T @ at.K @ S, np.abs(S).T @ K @ np.abs(S), side, side))
        shown.append(_wrench("V∗, in E₁", found["V_dot"], natural["V_dot"], ("m/s²", "rad/s²")))
    shown.append(_wrench("Reaction R, in E₁ about O₁", found["reaction"], natural["reaction"]))
    return shown


def _left_out(stand: Stand, hold: Hold) -> str:
    found = []
    if stand.flywheels and is_closed(hold):
        points = ", and ``--at`` with a point that of the point" if hold.freedoms else ""
        found.append(
            "The page has no jitter of a held carrier: ``mahovik jitter --at hold.reaction`` gives that of the "
            f"reaction{points}."
        )
    if not hold.freedoms:
        found.append(
            "A clamped carrier has no modes, no natural frequencies against speed, and no singular values of (12): "
            "nothing moves that flywheels could drive."
        )
    own = "a held carrier has those of its freedoms in their place" if has_coordinates(hold) else no_coordinates(hold)
    found.append(f"The generalized coordinates of (10) and (11) are six; {own}.")
    return " ".join(found)


def _wrench(what: str, values: Array, scale: Array | None = None, units: tuple[str, str] = ("N", "N m")) -> Markup:
    """Six numbers in a row."""
    largest = np.abs(values.reshape(2, 3)).max(axis=1)
    sizes = np.repeat(largest, 3) if scale is None else scale
    cells = [figure(_without_rounding(x, size)) for x, size in zip(values, sizes, strict=True)]
    first, second = units
    names = ("force", "moment") if first == "N" else ("linear", "angular")
    head = ("", f"{names[0]} 1, {first}>", "2>", "3>", f"{names[1]} 1, {second}>", "2>", "3>")
    return table(head, [[[what, *cells]]])


def _cells(values: Array) -> list[Markup]:
    return [figure(_clean(float(x))) for x in values]


def _clean(x: float) -> float:
    """A number of the order of 1; zero where it is rounding."""
    return 0.0 if abs(x) < ROUNDING else x


def _without_rounding(x: float, size: float) -> float:
    return 0.0 if abs(x) <= ROUNDING * size else float(x)


def _still(stand: Stand, state: State) -> State:
    """The state at rest with zero rates, as the reference takes it."""
    none = (0.0,) * len(stand.hold.freedoms if stand.hold is not None else ())
    return replace(state, u=none, u_dot=none)
