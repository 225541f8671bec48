"""Accepted differences of a verification, by kind of judge and element type; no check has one of its own.

A difference is a share of the scale of its quantity: how much the answer of the literal reference changes when every
number of stand and state changes by `PERTURBATION`, over this number. A relative error of the inputs moves an answer by
at most so many times its scale, whatever the condition of the equations.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Limits:
    """Accepted differences of what is judged, each a share of a scale.

    value        of a quantity from that of the literal reference
    second       of the second derivation from the reference, which both are double in any case
    derivative   of a Jacobian: it goes through K^-1 twice
    integration  of the change of a state in a motion, relative to the change
    rigorous     of a quantity from the exact answer, enclosed by balls: some hundred units in the last place
    optimality   of what the conditions of a least error leave, relative to its terms: solvers regularise
    law          of a servo's law, relative to its terms
    order        between the order with which errors of steps fall and that of the method
    promise      of an error over what the header promises
    exact        of words, bits, flags and counts: only equality is right
    real         element type
    floor        least scale: below it products of inputs are subnormal and have lost their digits
    """

    value: float
    second: float
    derivative: float
    integration: float
    rigorous: float
    optimality: float
    law: float
    order: float = 0.6
    promise: float = 1.0
    exact: float = 0.0
    real: str = "double"
    floor: float = 1e-290


DOUBLE = Limits(
    value=1e-12, second=1e-11, derivative=1e-11, integration=1e-10, rigorous=5e-14, optimality=1e-6,
    law=1e-12,
)  # fmt: skip
"""A sum of a hundred products is right to 1e-14 of its scale: two digits are left for stands of bad condition."""

FLOAT = Limits(
    value=1e-5, second=1e-11, derivative=1e-4, integration=2e-5, rigorous=1e-5, optimality=1e-3,
    law=1e-6, real="float", floor=1e-30,
)  # fmt: skip
"""A number of float is right to 6e-8: 160 such errors, the rounding of the parameters among them."""

LIMITS = {"double": DOUBLE, "float": FLOAT}

SERVO_PERIOD, SERVO_MATRIX = 1e-9, 1e-8
"""Largest relative errors of a servo: of what depends on its period, since samples and periods in it are whole numbers
below 2^31; of the matrix of a trim, by its largest number, since both sides solve the linear equations of a period."""

SMOOTH, KINKED, RUNUP, DRIFT = 1e-6, 1e-5, 1e-5, 20
"""Largest residuals of a programme as shares of its peaks: of smooth forces, of forces with V|V| (of class C1 only), of
a run-up. DRIFT: how often larger the drift of a floating carrier in a period may be than this share of its amplitude,
as a constant residual of it moves the carrier (2 pi)^2 / 2 amplitudes."""

OF_TABLE: Mapping[str, float] = {"double": 1e-6, "float": 1e-3}
"""Largest relative residual that the C of a programme's table may add, by element type."""

TABLE, JOINT, EXCEEDED = 0.03, 1e-6, 1 + 1e-9
"""Limits of the table of a programme. TABLE: difference of a row of phi', phi'' from what its neighbours predict, as a
share of the peak. JOINT: jump where two courses meet, likewise, of phi in rad. EXCEEDED: value over bound, which leaves
room for the rounding of the program that kept the bound."""

BEGIN, END, ALONG = 1e-9, 1.0, 1e-6
"""Largest errors of a slew: at its start (m, rad, s); at its end from the demanded attitude or line of sight (arcsec);
along it from the shortest turn (share of that) and of the rest at its end (share of the peak)."""

PERTURBATION: Mapping[str, float] = {"double": 2.0**-36, "float": 2.0**-18}
"""Relative change of every number of stand and state by which scales are measured.

Far above the rounding of the element type, so that a word (status, rank) which rounding may decide changes as well; far
below `rank` of the singular values, so that axes that are parallel in the file stay so.
"""

PERTURBATIONS = 6
"""How often: the largest change counts."""

RESTING = 2.0**-8
"""Least scale of a component, a part of the largest in its quantity: what symmetry makes zero is left with rounding."""

MOST_SKIPPED = 0.02
"""Part of the states of a check that may be left out, as no answer is right there or rounding decides its words."""

MOST_SCALE = 1e3
"""Largest scale, over the size of the quantity, both by their medians: beyond, a check would see no error."""


def uniform(tolerance: float) -> Limits:
    """Limits of a caller: the same for all quantities."""
    return replace(DOUBLE, value=tolerance, second=tolerance)
