"""Stand files: reading, checking, identities. The Stand itself is raw data in SI (`mahovik.core.stand.model`)."""

from mahovik.core.stand.identity import Identities, identities
from mahovik.core.stand.model import Stand
from mahovik.core.stand.read import load, loads
from mahovik.core.stand.state import State, rest_state
from mahovik.core.stand.structure import structure
from mahovik.core.stand.structure_facts import Structure
from mahovik.core.stand.write import dumps

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
