"""Finite motions, from rest to rest: (12) by collocation over splines."""

from mahovik.use.plan.finite.search import FiniteProblem, FiniteSearch, Solved, search_finite, table_of

__all__ = ["FiniteProblem", "FiniteSearch", "Solved", "search_finite", "table_of"]
