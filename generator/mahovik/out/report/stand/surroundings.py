"""What acts on a stand, in words: gravity, fluid, suspension, legs, wrenches given at run time; places of interest."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from markupsafe import Markup

from mahovik.core.derive.order import SEQUENCES
from mahovik.core.stand.model import Carrier, Instrument, Leg, Stand, Suspension
from mahovik.out.report.stand.markup import Cell, figure


def surroundings(stand: Stand) -> dict[str, Cell]:
    """Terms and what is said of them; what the stand has not is said to be none."""
    turns = " ".join(f"C{axis}({'ψθφ'[i]})" for i, axis in enumerate(SEQUENCES[stand.angles]))
    found: dict[str, Cell] = {
        "Attitude angles": f"{stand.angles}, C = {turns}",
        "Gravity": _vector(stand.gravity, "m/s²", "none") + (Markup(", axes of E₀") if any(stand.gravity) else ""),
        "Fluid": _fluid(stand),
        "Suspension": "none" if stand.suspension is None else _suspension(stand.suspension),
        "Legs": _legs(stand.legs),
        "Instruments, points": _places(stand),
        "Wrenches at run time": ", ".join(body.name for body in stand.bodies if body.wrench_input) or "none",
    }
    return found


def _vector(numbers: Sequence[float], unit: str, nothing: str) -> Markup:
    if not any(numbers):
        return Markup(nothing)
    return Markup("({}) {}").format(Markup(", ").join(figure(x) for x in numbers), unit)


def _fluid(stand: Stand) -> Markup:
    parts = []
    bearers: list[Carrier | Instrument] = [stand.carrier, *stand.instruments]
    added = [body.name for body in bearers if body.added_mass is not None]
    floating = [body.name for body in stand.bodies if body.buoyancy is not None]
    damped = [body.name for body in stand.bodies if body.damping is not None]
    for what, names in (("added mass of", added), ("buoyancy of", floating), ("damping of", damped)):
        if names:
            parts.append(Markup("{} {}").format(what, ", ".join(names)))
    if stand.stream is not None:
        still = "still, unless it is set at run time"
        parts.append(Markup("stream {}").format(_vector(stand.stream, "m/s", still)))
    if any(stand.gravity) and floating:
        parts.append(_balance(stand))
    return Markup("; ").join(parts) if parts else Markup("none")


def _balance(stand: Stand) -> Markup:
    """Weight against Archimedes' force."""
    mass = math.fsum(body.mass for body in stand.bodies)
    displaced = math.fsum(body.buoyancy.displaced_mass for body in stand.bodies if body.buoyancy)
    if abs(displaced - mass) <= 1e-9 * mass:
        return Markup("neutrally buoyant")
    light = displaced > mass
    return Markup("{} by {} kg").format("light" if light else "heavy", figure(abs(displaced - mass), 4))


def _suspension(given: Suspension) -> Markup:
    parts = []
    for words, matrix, units in (
        ("stiffness", given.stiffness, ("N/m", "N m/rad")),
        ("damping", given.damping, ("N s/m", "N m s/rad")),
    ):
        values = np.array(matrix)
        diagonal = np.diag(values)
        linear, angular = (Markup(", ").join(figure(x, 4) for x in diagonal[i : i + 3]) for i in (0, 3))
        text = Markup("{} ({}) {} and ({}) {}").format(words, linear, units[0], angular, units[1])
        if np.any(values - np.diag(diagonal)):
            text += Markup(", coupled")
        parts.append(text)
    parts.append(Markup("equilibrium of O₁ at {}").format(_vector(given.position, "m", "the origin of E₀")))
    if any(given.angles):
        parts.append(Markup("turned by {}").format(_vector(given.angles, "rad", "")))
    return Markup("; ").join(parts)


def _legs(legs: Sequence[Leg]) -> Markup:
    if not legs:
        return Markup("none")
    lines = [
        Markup("from {} of E₀ to {} of E₁: length {} mm, {} N/m, {} N s/m").format(
            _vector(leg.ground, "m", "the origin"), _vector(leg.carrier, "m", "O₁"), figure(1e3 * leg.length),
            figure(leg.stiffness), figure(leg.damping),
        )
        for leg in legs
    ]  # fmt: skip
    return Markup("<br>").join(lines)


def _places(stand: Stand) -> Markup:
    """Instruments and points with the frame that each stands in."""
    found = [Markup("{} at {} of carrier").format(p.name, _vector(p.position, "m", "O₁")) for p in stand.instruments]
    found += [Markup("{} at {} of {}").format(p.name, _vector(p.position, "m", "the origin"), p.mount)
              for p in stand.points]  # fmt: skip
    return Markup("; ").join(found) if found else Markup("none")
