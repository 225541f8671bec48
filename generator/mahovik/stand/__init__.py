"""Stand files: reading, checking, identities. The Stand itself is raw data in SI (`mahovik.stand.model`)."""

from mahovik.stand.model import Stand
from mahovik.stand.read import load, loads
from mahovik.stand.state import State, rest_state

__all__ = ["Stand", "State", "load", "loads", "rest_state"]
