"""Torquers with small errors of measurement."""

from __future__ import annotations

from dataclasses import replace

from mahovik.core.stand.model import LawData
from mahovik.laws.torquer.data import Torquers
from mahovik.use.control.measurement import Errors


def with_mismatch(draw: Errors, law: LawData) -> Torquers | None:
    """Dipoles as vectors; the field as it is."""
    if not isinstance(law, Torquers):
        return None
    return replace(law, torquers=tuple(replace(t, dipole=draw.vector(t.dipole)) for t in law.torquers))
