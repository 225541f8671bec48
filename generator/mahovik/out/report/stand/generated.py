"""The C of a stand, generated once for all sections."""

from __future__ import annotations

from functools import lru_cache

from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.stand.model import Stand


@lru_cache(maxsize=4)
def generated(stand: Stand, real: str = "double") -> Generated:
    """Program, numbers and C text of a stand by element type. Raises StandError."""
    return generate_all(stand, real)
