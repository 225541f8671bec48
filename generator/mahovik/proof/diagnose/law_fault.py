"""A fault in a law of `laws/`: the wrench that a wrong program has instead, and the words that say so."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pose import Pose


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
