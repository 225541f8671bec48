"""All that acts on a stand, in words: gravity, fluid, laws of `laws/`, run-time wrenches; places."""

from __future__ import annotations

import math

from markupsafe import Markup

from mahovik import laws
from mahovik.core.derive.order import SEQUENCES
from mahovik.core.stand.model import Carrier, Instrument, Stand
from mahovik.out.report.stand.markup import Cell, figure, vector_cell


def surroundings(stand: Stand) -> dict[str, Cell]:
    """Terms with their values; absent parts read `none`."""
    turns = " ".join(f"C{axis}({'ψθφ'[i]})" for i, axis in enumerate(SEQUENCES[stand.angles]))
    found: dict[str, Cell] = {
        "Attitude angles": f"{stand.angles}, C = {turns}",
        "Gravity": vector_cell(stand.gravity, "m/s²", "none") + (Markup(", axes of E₀") if any(stand.gravity) else ""),
        "Fluid": _fluid(stand),
        **{law.TITLE: law.cell(stand) for law in laws.parts("report")},
        "Instruments, points": _places(stand),
        "Wrenches at run time": ", ".join(body.name for body in stand.bodies if body.wrench_input) or "none",
    }
    return found


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
        parts.append(Markup("stream {}").format(vector_cell(stand.stream, "m/s", still)))
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


def _places(stand: Stand) -> Markup:
    """Instruments and points with the frame that each stands in."""
    found = [
        Markup("{} at {} of carrier").format(p.name, vector_cell(p.position, "m", "O₁")) for p in stand.instruments
    ]
    found += [Markup("{} at {} of {}").format(p.name, vector_cell(p.position, "m", "the origin"), p.mount)
              for p in stand.points]  # fmt: skip
    return Markup("; ").join(found) if found else Markup("none")
