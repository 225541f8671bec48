"""Outputs of a sweep of speeds: points of the carrier; of a held one also its freedoms and the reaction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mahovik.core.stand.hold import freedom_names
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.use.study.linear.model import places
from mahovik.use.study.response.held import REACTION
from mahovik.use.study.response.periodic import QUANTITIES, UNITS

AXES = ("x", "y", "z")

_REACTION_UNITS = {"force": "N", "moment": "N m"}
_LENGTHS = {"slide": "m", "turn": "rad", "twist": "1"}


@dataclass(frozen=True)
class Output:
    """A quantity of a point, a freedom (`hold.pitch`) or the reaction (`hold.reaction`), with its axes and unit."""

    name: str
    quantity: str
    axes: tuple[str, ...]
    unit: str

    @property
    def points(self) -> list[str]:
        """Points of the stand that have to be seen for it."""
        return [] if self.name.startswith("hold.") else [self.name]


def output_of(stand: Stand, name: str, quantity: str | None) -> Output:
    """The output of a name; quantity None: acceleration, of the reaction force. Raises UsageError."""
    if not name.startswith("hold.") and name != "hold":
        places(stand, [name])
        chosen = _choose(name, quantity, QUANTITIES, "acceleration")
        return Output(name, chosen, AXES, UNITS[chosen])
    if stand.hold is None:
        raise UsageError(f'--at {name}: {stand.name} has no [hold]; expected a point, an instrument or "carrier"')
    freedoms = dict(zip(freedom_names(stand.hold), stand.hold.freedoms, strict=True))
    known = [REACTION, *(f"hold.{each}" for each in freedoms)]
    if name not in known:
        raise UsageError(f'unknown output "{name}"{suggestion(name, known)}; expected one of {", ".join(known)}')
    if name == REACTION:
        chosen = _choose(name, quantity, tuple(_REACTION_UNITS), "force")
        return Output(name, chosen, AXES, _REACTION_UNITS[chosen])
    freedom = name.removeprefix("hold.")
    chosen = _choose(name, quantity, QUANTITIES, "acceleration")
    rate = {"displacement": "", "velocity": "/s", "acceleration": "/s2"}[chosen]
    return Output(name, chosen, (freedom,), _LENGTHS[freedoms[freedom].kind] + rate)


def _choose(name: str, quantity: str | None, known: Sequence[str], usual: str) -> str:
    if quantity is not None and quantity not in known:
        raise UsageError(f"--quantity {quantity}: {name} has none; expected one of {', '.join(known)}")
    return quantity or usual
