"""A programme: speeds, required and achieved motion, residual."""

from __future__ import annotations

from mahovik.errors import StateError
from mahovik.out.report.plot.inline import charts
from mahovik.out.report.plot.programme import panels
from mahovik.out.report.stand.markup import figure, paragraph
from mahovik.out.report.stand.material import Material, Section

TIMES = 200
"""Number of times at which the reference evaluates (12)."""


def section(material: Material) -> Section | None:
    """The section; None without a programme."""
    programme = material.programme
    if programme is None:
        return None
    span = "period" if programme.periodic else "duration"
    words = f"{programme.motion}: {span} {programme.span:.6g} s"
    if programme.periodic:
        turns = ", ".join(f"{name} {figure(n)}" for name, n in zip(programme.flywheels, programme.winding, strict=True))
        words += f", turns a {span}: {turns}"
    words += ". "
    if material.motion is None:
        words += "With ``--motion`` its carrier's motion, torques and the residual of (12) are shown as well."
    else:
        words += (
            "The carrier as (8) moves it from the required state at t = 0 under the programme, and as it is required. "
            f"Residual of (12) by the literal reference at {TIMES} times; ``mahovik verify-programme`` looks closer."
        )
    try:
        shown = panels(programme, material.stand, material.motion, TIMES)
    except StateError as error:
        line = f"programme: {error}"
        shown = panels(programme)
        return Section("programme", "Programme", paragraph(words) + charts(shown), (line,))
    summary = f"{programme.motion}, {span} {programme.span:.6g} s"
    return Section("programme", "Programme", paragraph(words) + charts(shown), summary=summary)
