"""Rigorous enclosures: (1)-(9) literally in ball arithmetic (Arb, by python-flint), to be read beside the paper.

Every number is a ball, a midpoint and a radius, and every operation gives a ball that holds the exact result for all
numbers of its operands. So the balls found hold the exact answer to the numbers of stand and state, which are taken
as the binary numbers that they are. The precision is doubled until the balls are as narrow as was asked.

Formula code is shared with none of the derivations. Needs python-flint: the extra `rigorous`.
Source: F. Johansson, "Arb: efficient arbitrary-precision midpoint-radius interval arithmetic", 2017.
"""

from mahovik.proof.rigorous.evaluate import enclose, evaluate, pieces_at
from mahovik.proof.rigorous.pieces import Pieces

__all__ = ["Pieces", "enclose", "evaluate", "pieces_at"]
