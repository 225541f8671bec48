"""What the literal reference takes of a law of `laws/`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from mahovik.core.stand.model import Body, Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.rotation import Pose


@dataclass(frozen=True)
class BodyReference:
    """A law of bodies: wrenches (6; N, N m) by kind of a body, of `gravity` (3, m/s2) and V_r (6), all in its frame."""

    wrenches: Callable[[Body, Array, Array], dict[str, Array]]


@dataclass(frozen=True)
class CarrierReference:
    """A law between E0 and the carrier.

    wrenches  on the carrier about O1 in E1 (6; N, N m), by their names in (7)
    margin    angle (rad) from a state to one with two right answers
    """

    wrenches: Callable[[Stand, State, Pose], dict[str, Array]]
    margin: Callable[[Stand, State], float] | None = None
