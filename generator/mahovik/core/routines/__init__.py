"""Elementary functions as program data, which firmware would otherwise take from libm.

Every operation is an IEEE operation rounded to nearest, none is assumed to be fused with another, and the order
is the order of the tree: so the results are the same bits on every machine.
"""

from mahovik.core.routines.arc_tangent import atan2
from mahovik.core.routines.bounded_least_squares import bounded_least_squares
from mahovik.core.routines.exponential import exponential
from mahovik.core.routines.jacobi import orthogonalise
from mahovik.core.routines.largest_share import largest_share
from mahovik.core.routines.sincos import sincos, sincos_each
from mahovik.core.routines.square_root import square_root
from mahovik.core.routines.wrap import turns_of_angle, unwind, wrap

__all__ = [
    "atan2",
    "bounded_least_squares",
    "exponential",
    "largest_share",
    "orthogonalise",
    "sincos",
    "sincos_each",
    "square_root",
    "turns_of_angle",
    "unwind",
    "wrap",
]
