"""What the literal reference, and the search for wrong terms of a program, take of a law of `laws/`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from mahovik.core.stand.model import Body, Stand, State
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.rotation import Pose


@dataclass(frozen=True)
class BodyReference:
    """A law of bodies.

    wrenches  on a body (6; N, N m) by kind, by its data of the law, `gravity` (3, m/s2) and V_r (6), all in its frame
    data      class of these data: bodies without them bear no such wrench; None: every body does, and there are none
    """

    wrenches: Callable[[Body, Any, Array, Array], dict[str, Array]]
    data: type[Any] | None = None


@dataclass(frozen=True)
class CarrierReference:
    """A law between E0 and the carrier.

    wrenches  on the carrier about O1 in E1 (6; N, N m), by their names in (7)
    margin    angle (rad) from a state to one with two right answers
    """

    wrenches: Callable[[Stand, State, Pose], dict[str, Array]]
    margin: Callable[[Stand, State], float] | None = None


@dataclass(frozen=True, eq=False)
class LawTerm:
    """A part of the wrench of a law that is proportional to one coefficient.

    detail       0: the coarsest parts of the law; parts of one detail are looked for together
    term         what the coefficient stands before, in words; the coefficient itself, if there are none
    coefficient  its path in the stand file
    value        the right one, SI
    wrench       (n, 6; N, N m) where the coefficient is one, in the body's frame, at n states; of a column: one
                 component (n) of it on the carrier
    """

    detail: int
    term: str
    coefficient: str
    value: float
    wrench: Array


@dataclass(frozen=True)
class LawParts:
    """Coarse parts of a law, LAW of `faults` of its folder: of one body at n states, with its twists V_r (n, 6)."""

    law: type[Any]
    terms: Callable[[Sequence[Body], Array], Iterable[LawTerm]]
