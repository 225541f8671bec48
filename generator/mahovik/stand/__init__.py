"""Stand files: reading, checking, identities. The Stand itself is raw data in SI (`mahovik.stand.model`)."""

from mahovik.stand.identity import Identities, identities
from mahovik.stand.model import Stand
from mahovik.stand.read import load, loads
from mahovik.stand.state import State, rest_state
from mahovik.stand.structure import Structure, structure
from mahovik.stand.write import dumps

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
