"""Correction weights from vibration: influence coefficients, least squares, min-max, weights and holes."""

from mahovik.use.balance.influence import Influence, read_influence
from mahovik.use.balance.pieces import Made, choose_pieces
from mahovik.use.balance.solve import METHODS, Solution, solve

__all__ = ["METHODS", "Influence", "Made", "Solution", "choose_pieces", "read_influence", "solve"]
