"""A programme: speeds, required and achieved motion, residual."""

from __future__ import annotations

from mahovik.report.stand.material import Material
from mahovik.report.stand.section import Section


def section(material: Material) -> Section | None:
    """The section, or None where there is nothing to show."""
    return None
