"""Motion in time: a stand under a regime, by the generated C or, to judge it, by SciPy and the literal reference."""

from mahovik.use.simulate.case import Case
from mahovik.use.simulate.run import Run, simulate

__all__ = ["Case", "Run", "simulate"]
