"""All that acts on a stand, in words: gravity, fluid, laws of `laws/`, run-time wrenches; places."""

from __future__ import annotations

from markupsafe import Markup

from mahovik.contract import laws
from mahovik.core.derive.order import SEQUENCES
from mahovik.core.stand.hold import words
from mahovik.core.stand.model import Carrier, Instrument, Stand
from mahovik.out.report.stand.markup import Cell, figure, vector_cell


def surroundings(stand: Stand) -> dict[str, Cell]:
    """Terms with their values; absent parts read `none`."""
    turns = " ".join(f"C{axis}({'ψθφ'[i]})" for i, axis in enumerate(SEQUENCES[stand.angles]))
    hold: dict[str, Cell] = {} if stand.hold is None else {"Hold": words(stand.hold)}
    found: dict[str, Cell] = {
        **hold,
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
    acting = [(text.NAME, text.bearers(stand)) for text in laws.parts("text", laws.BODY_LAWS)]
    for what, names in (("added mass", added), *acting):
        if names:
            parts.append(Markup("{} of {}").format(what, ", ".join(names)))
    if stand.stream is not None:
        still = "still, unless it is set at run time"
        parts.append(Markup("stream {}").format(vector_cell(stand.stream, "m/s", still)))
    if stand.profile is not None:
        stations = [
            Markup("{} at {}").format(vector_cell(u, "m/s", "0"), Markup("{} m").format(figure(depth)))
            for depth, u in zip(stand.profile.depth, stand.profile.velocity, strict=True)
        ]
        parts.append(Markup("and by depth {}").format(Markup(", ").join(stations)))
    parts += [words for note in laws.of_bodies("report", "note") if (words := note(stand))]
    return Markup("; ").join(parts) if parts else Markup("none")


def _places(stand: Stand) -> Markup:
    """Instruments and points with the frame that each stands in."""
    found = [
        Markup("{} at {} of carrier").format(p.name, vector_cell(p.position, "m", "O₁")) for p in stand.instruments
    ]
    found += [Markup("{} at {} of {}").format(p.name, vector_cell(p.position, "m", "the origin"), p.mount)
              for p in stand.points]  # fmt: skip
    return Markup("; ").join(found) if found else Markup("none")
