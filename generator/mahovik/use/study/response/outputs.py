"""Outputs of a sweep of speeds: points of the carrier; of a held one also its freedoms and the reaction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from mahovik.core.stand.hold import freedom_names
from mahovik.core.stand.model import Hold, Stand
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.use.study.linear.model import places
from mahovik.use.study.response.periodic import QUANTITIES, UNITS
from mahovik.use.study.response.scene import REACTION

AXES = ("x", "y", "z")

_REACTION_UNITS = {"force": "N", "moment": "N m"}
_OF_TURNS = {"angle": "displacement", "rate": "velocity", "acceleration": "acceleration"}
"""Quantities of a freedom that turns, and the motions of `HeldMotion` that they are."""
_LENGTHS = {"slide": "m", "turn": "rad", "twist": "1"}


@dataclass(frozen=True)
class Output:
    """A quantity of a point, a freedom (`hold.pitch`) or the reaction (`hold.reaction`), with its axes and unit."""

    name: str
    quantity: str
    axes: tuple[str, ...]
    unit: str

    @property
    def motion(self) -> str:
        """The quantity's name among those of a motion, where an angle is a displacement."""
        return _OF_TURNS.get(self.quantity, self.quantity)

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
    freedoms = freedom_names(stand.hold)
    known = [REACTION, *(f"hold.{each}" for each in freedoms)]
    freedom = freedom_of(stand.hold, name)
    if name != REACTION and freedom is None:
        raise UsageError(f'unknown output "{name}"{suggestion(name, known)}; expected one of {", ".join(known)}')
    if freedom is None:
        chosen = _choose(name, quantity, tuple(_REACTION_UNITS), "force")
        return Output(name, chosen, AXES, _REACTION_UNITS[chosen])
    own, kind = freedoms[freedom], stand.hold.freedoms[freedom].kind
    chosen = _choose(name, quantity, tuple(_OF_TURNS) if kind == "turn" else QUANTITIES, "acceleration")
    found = Output(f"hold.{own}", chosen, (own,), _LENGTHS[kind])
    rate = {"displacement": "", "velocity": "/s", "acceleration": "/s2"}[found.motion]
    return replace(found, unit=found.unit + rate)


def freedom_of(hold: Hold, name: str) -> int | None:
    """Place of the freedom that an output such as `hold.pitch` or `hold.1` is; None where it is none."""
    own, names = name.removeprefix("hold."), freedom_names(hold)
    return next((k for k, each in enumerate(names) if own in (each, str(k + 1))), None)


def _choose(name: str, quantity: str | None, known: Sequence[str], usual: str) -> str:
    if quantity is not None and quantity not in known:
        raise UsageError(f"--quantity {quantity}: {name} has none; expected one of {', '.join(known)}")
    return quantity or usual
