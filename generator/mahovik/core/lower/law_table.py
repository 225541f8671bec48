"""Struct members that a law of `laws/` adds to a stand's program."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mahovik.core.lower.member import Member
from mahovik.core.program.types import Field
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import Structure


class LawTable:
    """A law between E0 and the carrier, as far as structs are concerned.

    words        the law in the list of kinds of wrench
    placed       does its wrench depend on the place of O1?
    invalid      what of it may have a length that it must not have, for the list of statuses; "" for nothing
    quaternions  places in the table that must have unit length
    """

    words: str
    placed = True
    invalid = ""
    quaternions: tuple[str, ...] = ()

    def present(self, structure: Structure) -> bool:
        """Whether a stand has the law."""
        raise NotImplementedError

    def fields(self, structure: Structure) -> list[Field]:
        """Members that the law adds to the table."""
        raise NotImplementedError

    def values(self, stand: Stand, run: Any) -> dict[str, Any]:
        """The numbers of its members, by name; `run` runs a function of the program."""
        raise NotImplementedError

    def members(self, field: Field, value: Any) -> Iterator[Member]:
        """Every real of one of its members, depth first, for simulators."""
        raise NotImplementedError
