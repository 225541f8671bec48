"""The literal reference: (1)-(13) in plain NumPy, slow, to be read beside the paper."""

from mahovik.proof.reference.evaluate import evaluate, held_state, pieces
from mahovik.proof.reference.pieces import Pieces

__all__ = ["Pieces", "evaluate", "held_state", "pieces"]
