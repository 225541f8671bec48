"""Stand files: reading, checking, identities. The Stand itself is raw data in SI (`mahovik.core.stand.model`)."""

from mahovik.core.stand.model import Stand, State, Structure, rest_state
from mahovik.core.stand.stand_file import dumps, load, loads
from mahovik.core.stand.structure import Identities, identities, structure

__all__ = [
    "Identities",
    "Stand",
    "State",
    "Structure",
    "dumps",
    "identities",
    "load",
    "loads",
    "rest_state",
    "structure",
]
