"""A fault of the dictionary: its words, and what it changes between the stages of the literal reference."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from mahovik.core.stand.model import Body, Flywheel, Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pose import Pose

Stage = Literal["stand", "state", "attitude", "bodies", "pieces", "values"]
"""Stages of the reference, in order. What a change of each takes, before the Case, and gives:

stand     the Stand
state     the State
attitude  C (3x3) of the carrier, except in the matrices of the generalized coordinates
bodies    `reference.bodies.Bodies`: where each body is, and its inertia
pieces    `reference.Pieces` of the state
values    the values of a want; it takes the Pieces as well
"""


@dataclass(frozen=True)
class Case:
    """The question in which a fault shows: stand and state as the program reads them, and what is wanted.

    wrong  whether the program is wrong about this body
    """

    stand: Stand
    state: State
    want: str
    wrong: Callable[[Body], bool]


@dataclass(frozen=True)
class Edit:
    """One change at one stage."""

    stage: Stage
    change: Callable[..., Any]


@dataclass(frozen=True, eq=False)
class Fault:
    """One row of the dictionary.

    name      short, for tables and `--json`
    equation  where the wrong term stands
    bodies    the bodies that the program is wrong about
    edits     what the fault changes
    words     what the program does, a sentence without its full stop
    look      what to look at in the equation
    """

    name: str
    equation: str
    bodies: Literal["flywheels", "fixed", "all"]
    edits: Sequence[Edit]
    words: str
    look: str

    @property
    def of_flywheels(self) -> bool:
        """Whether it may be a fault of one flywheel alone."""
        return self.bodies == "flywheels"

    def concerns(self, body: Body, wheel: str | None) -> bool:
        """Whether the program is wrong about this body; `wheel`: the only flywheel with the fault, or None for all."""
        if self.bodies != "all" and isinstance(body, Flywheel) != (self.bodies == "flywheels"):
            return False
        return wheel is None or wheel == body.name


@dataclass(frozen=True)
class LawFault:
    """One wrong form of a law.

    name    short, for tables and `--json`
    words   what the program does, a sentence
    look    what to look at in the law
    wrench  what the program has instead (6; N, N m), on the carrier about O1 in E1
    """

    name: str
    words: str
    look: str
    wrench: Callable[[Stand, State, Pose], Array]
